// Every template of the headers, so that a compiler sees what is in it: compiled with all warnings, not run.
#include <deldrift/cgal.hpp>

#include <iterator>
#include <tuple>
#include <unordered_set>
#include <vector>

using deldrift::Positions;
using deldrift::cgal::Kernel;

template class deldrift::span<double>;
template class deldrift::span<const float>;
template class deldrift::range<deldrift::Cells::iterator>;
template class deldrift::indexed_iterator<deldrift::Cells::Rows>;
template class deldrift::selecting_iterator<deldrift::Cells::Facets<true>>;
template class deldrift::selecting_iterator<deldrift::Cells::Facets<false>>;
template class deldrift::selecting_iterator<deldrift::Vertices::Ids>;
template class deldrift::indexed_iterator<deldrift::Segments::Rows>;
template class deldrift::indexed_iterator<deldrift::Chains::All>;
template class deldrift::indexed_iterator<deldrift::Chains::Edges>;
template class deldrift::cgal::Delaunay_triangulation_2<Kernel>;
template class deldrift::cgal::Delaunay_triangulation_2<Kernel, unsigned>;
template class deldrift::cgal::Constrained_Delaunay_triangulation_2<Kernel>;
template class deldrift::cgal::Constrained_Delaunay_triangulation_2<Kernel, deldrift::cgal::Infos<int, int>,
                                                                    deldrift::cgal::Exact_predicates_tag>;
template class deldrift::cgal::Delaunay_mesher_2<deldrift::cgal::Constrained_Delaunay_triangulation_2<Kernel>>;
template class deldrift::cgal::Triangulation_conformer_2<deldrift::cgal::Constrained_Delaunay_triangulation_2<Kernel>>;
template class deldrift::cgal::Delaunay_triangulation_3<Kernel>;
template class deldrift::cgal::Delaunay_triangulation_3<Kernel, unsigned>;
template class deldrift::cgal::Regular_triangulation_2<Kernel>;
template class deldrift::cgal::Regular_triangulation_2<Kernel, unsigned>;
template class deldrift::cgal::Regular_triangulation_3<Kernel>;
template class deldrift::cgal::Regular_triangulation_3<Kernel, unsigned>;

namespace {

struct Particle {
    std::array<float, 3> place;
    double mass;
};

template <class T>
std::size_t size_of(const T &range) {
    std::size_t n = 0;
    for (auto i = range.begin(); i != range.end(); ++i) {
        const auto value = i.operator->();
        n += sizeof value;
    }
    return n;
}

std::size_t arrangements(const std::vector<Particle> &particles) {
    const std::vector<double> numbers{0, 0, 1, 0, 0, 1};
    const double rows[2][2] = {{0, 0}, {1, 1}};
    const float others[4] = {0, 0, 1, 1};
    deldrift::Triangulation t(2, numbers);
    t.commit_positions(Positions::strided(numbers.data(), 3, 16));
    t.commit_positions(Positions::strided(particles, &Particle::place));
    t.stage_insertions(rows);
    t.stage_insertions(others);
    t.stage_insertions({2.0, 3.0});
    const deldrift::span<const double> x(numbers.data(), 3);
    const deldrift::span<const float> y(others);
    t.move_vertices(Positions::separate(x, x));
    t.move_vertices(Positions::separate(x, x, x));
    t.move_vertices(Positions::separate(y, y));
    t.move_vertices(Positions::separate(y, y, y));
    return t.positions<2>().size() + t.positions<3>().size() + t.position<2>(0).size() + t.position<3>(0).size();
}

std::size_t ranges(const deldrift::Triangulation &t) {
    const deldrift::Cells cells = t.cells();
    return size_of(cells) + size_of(cells.rows<3>()) + size_of(cells.facets()) + size_of(cells.hull_facets()) +
           size_of(t.vertices()) + size_of(t.segments()) + size_of(t.boundary_chains({})) + size_of(t.cells_of(0)) + t.edges().size() + t.voronoi_volumes().size();
}

template <class Dt>
void insert_and_remove(Dt &t) {
    using Point = typename Dt::Point;
    std::vector<Point> points;
    t.insert(points.begin(), points.end());
    if constexpr (std::is_same_v<decltype(typename Dt::Vertex_handle()->info()), unsigned &>) {
        std::vector<std::pair<Point, unsigned>> pairs;
        std::vector<std::tuple<Point, unsigned>> tuples;
        t.insert(pairs.begin(), pairs.end());
        t.insert(tuples.begin(), tuples.end());
    }
    std::unordered_set<typename Dt::Vertex_handle> handles;
    for (const typename Dt::Vertex_handle v : t.finite_vertex_handles()) handles.insert(t.insert(v->point(), v));
    t.remove(handles.begin(), handles.end());
    size_of(t.points());
}

template <class Dt>
void plane() {
    const std::vector<typename Dt::Point> points;
    Dt t(points.begin(), points.end());
    insert_and_remove(t);
    size_of(t.finite_edges());
    size_of(t.all_face_handles());
}

template <class Dt>
void space() {
    const std::vector<typename Dt::Point> points;
    Dt t(points.begin(), points.end());
    insert_and_remove(t);
    std::vector<typename Dt::Vertex_handle> vertices;
    std::vector<typename Dt::Cell_handle> cells;
    std::vector<typename Dt::Facet> facets;
    const typename Dt::Vertex_handle v = *t.finite_vertices_begin();
    t.adjacent_vertices(v, std::back_inserter(vertices));
    t.finite_adjacent_vertices(v, std::back_inserter(vertices));
    t.incident_cells(v, std::back_inserter(cells));
    t.finite_incident_cells(v, std::back_inserter(cells));
    t.incident_facets(v, std::back_inserter(facets));
    t.finite_incident_facets(v, std::back_inserter(facets));
    size_of(t.finite_edges());
    size_of(t.finite_facets());
}

template <class Info>
void all() {
    using Dt2 = deldrift::cgal::Delaunay_triangulation_2<Kernel, Info>;
    using Dt3 = deldrift::cgal::Delaunay_triangulation_3<Kernel, Info>;
    using Rt2 = deldrift::cgal::Regular_triangulation_2<Kernel, Info>;
    using Rt3 = deldrift::cgal::Regular_triangulation_3<Kernel, Info>;
    plane<Dt2>();
    plane<Rt2>();
    space<Dt3>();
    space<Rt3>();
    Dt2().nearest_vertex({0, 0}, typename Dt2::Vertex_handle());
    Dt3().nearest_vertex({0, 0, 0}, typename Dt3::Vertex_handle());
    const Rt3 t;
    size_of(t.hidden_points());
    size_of(t.hidden_vertex_handles());
    size_of(t.infinite_cell().vertex_list());
    const std::vector<typename Rt3::Vertex_handle> vertices{t.nearest_power_vertex({0, 0, 0}, t.infinite_cell())};
    t.vertices_inside_conflict_zone(vertices[0]->point(), {}, std::vector<typename Rt3::Vertex_handle>().begin());
}

}  // namespace

int main() {
    all<void>();
    all<unsigned>();
    return arrangements({}) + ranges(deldrift::Triangulation(2, {})) == 0;
}
