// Delaunay_triangulation_3: see cgal.hpp.
#ifndef DELDRIFT_CGAL_SPACE_HPP
#define DELDRIFT_CGAL_SPACE_HPP

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include "base.hpp"
#include "edges.hpp"
#include "links.hpp"

namespace deldrift::cgal {

namespace detail {

// What Delaunay and regular triangulations in space have in common.
template <class K, class Info, class Policy>
class Space : public Base<3, K, Info, Policy> {
    using Base = detail::Base<3, K, Info, Policy>;
    template <class Source>
    using handles = typename Base::template handles<Source>;

protected:
    using typename Base::Mesh;

public:
    using typename Base::Bare_point;
    using typename Base::Point;
    using typename Base::size_type;
    using typename Base::Vertex_handle;
    using Cell_handle = typename Base::Cell;
    using Cell = Cell_handle;
    // The facet opposite a corner of a cell; the edge between two corners.
    using Facet = std::pair<Cell_handle, int>;
    using Edge = detail::Triple<Cell_handle, int, int>;
    enum Locate_type { VERTEX, EDGE, FACET, CELL, OUTSIDE_CONVEX_HULL, OUTSIDE_AFFINE_HULL };

    using Finite_cells_iterator = detail::handle_iterator<detail::Finite_cells<Mesh, 3>>;
    using Finite_cell_handles = handles<detail::Finite_cells<Mesh, 3>>;
    using All_cells_iterator = detail::handle_iterator<detail::All_cells<Mesh, 3>>;
    using All_cell_handles = handles<detail::All_cells<Mesh, 3>>;
    using Finite_facets_iterator = detail::handle_iterator<detail::Finite_facets<Mesh, 3>>;
    using Finite_facets = handles<detail::Finite_facets<Mesh, 3>>;
    using Finite_edges_iterator = detail::handle_iterator<detail::Finite_edges_3<Mesh, 3>>;
    using Finite_edges = handles<detail::Finite_edges_3<Mesh, 3>>;
    using Cell_circulator = detail::Edge_circulator_3<Cell_handle, detail::At_cell>;
    using Facet_circulator = detail::Edge_circulator_3<Cell_handle, detail::At_facet>;

    using All_facets_iterator = detail::handle_iterator<detail::All_facets<Mesh, 3>>;
    using All_facets = handles<detail::All_facets<Mesh, 3>>;
    using All_edges_iterator = detail::handle_iterator<detail::All_edges_3<Mesh, 3>>;
    using All_edges = handles<detail::All_edges_3<Mesh, 3>>;
    // All, infinite ones included.
    using Vertex_iterator = typename Base::All_vertices_iterator;
    using Cell_iterator = All_cells_iterator;
    using Facet_iterator = All_facets_iterator;
    using Edge_iterator = All_edges_iterator;
    using Segment = typename detail::Simplex_3<K, 2>::type;
    using Triangle = typename detail::Simplex_3<K, 3>::type;
    using Tetrahedron = typename detail::Simplex_3<K, 4>::type;
    using Bounded_side = typename detail::Sides<K>::Bounded;

    Space() = default;
    explicit Space(const K &traits) : Base(traits) {}
    // Of points, or pairs or tuples of point and info, each of which is read once.
    template <class Iterator, class End, class = std::enable_if_t<detail::Is_sequence<Iterator, End>::value>>
    Space(Iterator first, End last, const K &traits = K()) : Base(traits) {
        this->insert(std::move(first), std::move(last));
    }

    const Point &point(Vertex_handle v) const { return v.point(); }
    const Point &point(Cell_handle c, int i) const { return c.vertex(i).point(); }
    Segment segment(Cell_handle c, int i, int j) const { return Segment(bare(c, i), bare(c, j)); }
    Segment segment(const Edge &e) const { return segment(e.first, e.second, e.third); }
    // Its corners are counter-clockwise as seen from the cell.
    Triangle triangle(Cell_handle c, int i) const {
        const auto corner = [i](int k) { return vertex_triple_index(i, k); };
        return Triangle(bare(c, corner(0)), bare(c, corner(1)), bare(c, corner(2)));
    }
    Triangle triangle(const Facet &f) const { return triangle(f.first, f.second); }
    Tetrahedron tetrahedron(Cell_handle c) const {
        return Tetrahedron(bare(c, 0), bare(c, 1), bare(c, 2), bare(c, 3));
    }

    // The corner k by which i, j, k and the fourth one are an even permutation; the k-th corner of the facet opposite
    // i, counter-clockwise as seen from there, the lowest first.
    static int next_around_edge(int i, int j) noexcept { return detail::next_around_edge(i, j); }
    static int vertex_triple_index(int i, int k) noexcept { return detail::corner_of_facet(i, k); }

    size_type number_of_finite_cells() const { return this->n_cells(); }
    size_type number_of_cells() const { return this->n_cells() + n_hull_facets(); }
    size_type number_of_finite_facets() const { return (4 * this->n_cells() + n_hull_facets()) / 2; }
    // By Euler's relation; none where there are no cells.
    size_type number_of_finite_edges() const {
        const size_type n = this->n_cells();
        return n == 0 ? 0 : this->number_of_vertices() + number_of_finite_facets() - n - 1;
    }
    size_type number_of_facets() const { return 2 * number_of_cells(); }
    // Of the hull there are as many edges as half of its facets' sides, and by Euler's relation two more vertices.
    size_type number_of_edges() const {
        return this->n_cells() == 0 ? 0 : number_of_finite_edges() + n_hull_facets() / 2 + 2;
    }

    Finite_cells_iterator finite_cells_begin() const { return finite_cell_handles().begin(); }
    Finite_cells_iterator finite_cells_end() const { return finite_cell_handles().end(); }
    Finite_cell_handles finite_cell_handles() const {
        return this->template all<detail::Finite_cells>(this->n_cells());
    }
    All_cells_iterator all_cells_begin() const { return all_cell_handles().begin(); }
    All_cells_iterator all_cells_end() const { return all_cell_handles().end(); }
    All_cell_handles all_cell_handles() const {
        return this->template all<detail::All_cells>(this->n_cells() + this->n_facets_of_cells());
    }
    Finite_facets_iterator finite_facets_begin() const { return finite_facets().begin(); }
    Finite_facets_iterator finite_facets_end() const { return finite_facets().end(); }
    Finite_facets finite_facets() const { return this->template all<detail::Finite_facets>(this->n_facets_of_cells()); }
    Finite_edges_iterator finite_edges_begin() const { return finite_edges().begin(); }
    Finite_edges_iterator finite_edges_end() const { return finite_edges().end(); }
    Finite_edges finite_edges() const { return this->template all<detail::Finite_edges_3>(6 * this->n_cells()); }

    All_facets_iterator all_facets_begin() const { return all_facets().begin(); }
    All_facets_iterator all_facets_end() const { return all_facets().end(); }
    All_facets all_facets() const { return this->template all<detail::All_facets>(5 * this->n_facets_of_cells()); }
    All_edges_iterator all_edges_begin() const { return all_edges().begin(); }
    All_edges_iterator all_edges_end() const { return all_edges().end(); }
    All_edges all_edges() const { return this->template all<detail::All_edges_3>(22 * this->n_cells()); }
    Vertex_iterator vertices_begin() const { return this->all_vertices_begin(); }
    Vertex_iterator vertices_end() const { return this->all_vertices_end(); }
    Cell_iterator cells_begin() const { return all_cells_begin(); }
    Cell_iterator cells_end() const { return all_cells_end(); }
    Facet_iterator facets_begin() const { return all_facets_begin(); }
    Facet_iterator facets_end() const { return all_facets_end(); }
    Edge_iterator edges_begin() const { return all_edges_begin(); }
    Edge_iterator edges_end() const { return all_edges_end(); }

    // Of a vertex, to an output iterator, in no particular order; infinite ones included, except where the name says
    // otherwise. Those of the infinite vertex are found in a pass over all cells.
    template <class Output>
    Output incident_cells(Vertex_handle v, Output out) const {
        for (Cell_handle c : this->star(v, true)) *out++ = c;
        return out;
    }
    template <class Output>
    Output finite_incident_cells(Vertex_handle v, Output out) const {
        for (Cell_handle c : this->star(v, false)) *out++ = c;
        return out;
    }
    template <class Output>
    Output incident_vertices(Vertex_handle v, Output out) const {
        return adjacent_vertices(v, out);
    }
    template <class Output>
    Output incident_edges(Vertex_handle v, Output out) const {
        return edges_of(v, true, out);
    }
    template <class Output>
    Output finite_incident_edges(Vertex_handle v, Output out) const {
        return edges_of(v, false, out);
    }
    template <class Output>
    Output adjacent_vertices(Vertex_handle v, Output out) const {
        visit_link(v, true, [&](Vertex_handle w) { *out++ = w; });
        return out;
    }
    template <class Output>
    Output finite_adjacent_vertices(Vertex_handle v, Output out) const {
        visit_link(v, false, [&](Vertex_handle w) { *out++ = w; });
        return out;
    }
    template <class Output>
    Output incident_facets(Vertex_handle v, Output out) const {
        return facets_of(v, true, out);
    }
    template <class Output>
    Output finite_incident_facets(Vertex_handle v, Output out) const {
        return facets_of(v, false, out);
    }
    size_type degree(Vertex_handle v) const {
        size_type n = 0;
        visit_link(v, true, [&](Vertex_handle) { n++; });
        return n;
    }

    // Around an edge, infinite cells included; from the edge's cell, or another one, or one of its facets.
    Cell_circulator incident_cells(Cell_handle c, int i, int j) const { return {c.vertex(i), c.vertex(j), c}; }
    Cell_circulator incident_cells(const Edge &e) const { return incident_cells(e.first, e.second, e.third); }
    Cell_circulator incident_cells(Cell_handle c, int i, int j, Cell_handle start) const {
        return {c.vertex(i), c.vertex(j), start};
    }
    Cell_circulator incident_cells(const Edge &e, Cell_handle start) const {
        return incident_cells(e.first, e.second, e.third, start);
    }
    Facet_circulator incident_facets(Cell_handle c, int i, int j) const { return {c.vertex(i), c.vertex(j), c}; }
    Facet_circulator incident_facets(const Edge &e) const { return incident_facets(e.first, e.second, e.third); }
    Facet_circulator incident_facets(Cell_handle c, int i, int j, Cell_handle start, int k) const {
        const Vertex_handle s = c.vertex(i), t = c.vertex(j);
        // A facet is that of the cell from which one turns through it.
        const bool is_of_start = next_around_edge(start.index(s), start.index(t)) == k;
        return {s, t, is_of_start ? start : start.neighbor(k)};
    }
    Facet_circulator incident_facets(Cell_handle c, int i, int j, const Facet &start) const {
        return incident_facets(c, i, j, start.first, start.second);
    }
    Facet_circulator incident_facets(const Edge &e, const Facet &start) const {
        return incident_facets(e.first, e.second, e.third, start);
    }

    // Whether these vertices, of which one may be infinite, have a common edge, facet or cell; which corners they are
    // of a cell with it.
    bool is_edge(Vertex_handle a, Vertex_handle b, Cell_handle &c, int &i, int &j) const {
        return are_in_cell<2>({a, b}, c, {&i, &j});
    }
    bool is_edge(Vertex_handle a, Vertex_handle b) const { return this->template cell_with<2>({a, b}) != nullptr; }
    bool is_facet(Vertex_handle a, Vertex_handle b, Vertex_handle d, Cell_handle &c, int &i, int &j, int &k) const {
        return are_in_cell<3>({a, b, d}, c, {&i, &j, &k});
    }
    bool is_cell(Vertex_handle a, Vertex_handle b, Vertex_handle d, Vertex_handle e, Cell_handle &c, int &i, int &j,
                 int &k, int &l) const {
        return are_in_cell<4>({a, b, d, e}, c, {&i, &j, &k, &l});
    }
    bool is_cell(Vertex_handle a, Vertex_handle b, Vertex_handle d, Vertex_handle e, Cell_handle &c) const {
        int i = 0, j = 0, k = 0, l = 0;
        return is_cell(a, b, d, e, c, i, j, k, l);
    }

    using Base::is_infinite;
    bool is_infinite(Cell_handle c) const noexcept { return c.is_infinite(); }
    bool is_infinite(Cell_handle c, int i) const {
        const int at = c.is_infinite() ? c.index(this->infinite_vertex()) : i;
        return at != i;
    }
    bool is_infinite(Cell_handle c, int i, int j) const { return is_infinite(c.vertex(i)) || is_infinite(c.vertex(j)); }
    bool is_infinite(const Facet &f) const { return is_infinite(f.first, f.second); }
    bool is_infinite(const Edge &e) const { return is_infinite(e.first, e.second, e.third); }
    Cell_handle infinite_cell() const { return this->infinite_vertex().cell(); }
    int mirror_index(Cell_handle c, int i) const { return c.mirror_index(i); }
    Vertex_handle mirror_vertex(Cell_handle c, int i) const { return c.neighbor(i).vertex(c.mirror_index(i)); }
    Facet mirror_facet(const Facet &f) const { return {f.first.neighbor(f.second), f.first.mirror_index(f.second)}; }

    // The cell that p is in or on, or an infinite cell beyond a facet that faces it. li: the corner that p is at, or
    // opposite the facet that p is on, or of the infinite vertex; li and lj: the ends of the edge that p is on.
    // Vertices in a plane are on no facets here, so that another point is outside of their affine hull, wherever it
    // is.
    Cell_handle locate(const Point &p, Locate_type &lt, int &li, int &lj, Cell_handle hint = {}) const {
        const auto place = this->place_of(p, hint);
        li = lj = 0;
        lt = CELL;
        switch (place.kind) {
        case DELDRIFT_LOCATION_VERTEX:
            lt = VERTEX;
            li = place.cell == nullptr ? 0 : place.cell.index(place.vertex);
            break;
        case DELDRIFT_LOCATION_CELL: {
            int on[4], off[4], n_on = 0, n_off = 0;
            for (int i = 0; i < 4; i++) (place.on_facet[static_cast<std::size_t>(i)] ? on[n_on++] : off[n_off++]) = i;
            if (n_on == 1) {
                lt = FACET;
                li = on[0];
            } else if (n_on == 2) {
                lt = EDGE;
                li = off[0];
                lj = off[1];
            }
            break;
        }
        case DELDRIFT_LOCATION_OUTSIDE:
            lt = OUTSIDE_CONVEX_HULL;
            li = place.cell.index(this->infinite_vertex());
            break;
        case DELDRIFT_LOCATION_NO_CELLS: lt = OUTSIDE_AFFINE_HULL; break;
        }
        return place.cell;
    }
    Cell_handle locate(const Point &p, Cell_handle hint = {}) const { return this->place_of(p, hint).cell; }

    // The centre of the sphere, or power sphere, of a finite cell, rounded; by the kernel's
    // construct_circumcenter_3_object or construct_weighted_circumcenter_3_object, if it has that.
    Bare_point dual(Cell_handle c) const { return this->centre_of(c); }

    // The cells, infinite ones included, that go when p is inserted, decided exactly, and the facets of these that they
    // have in common with others; then, if wanted, those that they have in common with each other. There are none at
    // the place of a vertex, nor where there are no cells. It is found fastest from a cell nearby.
    template <class Facets, class Cells>
    std::pair<Facets, Cells> find_conflicts(const Point &p, Cell_handle hint, Facets facets, Cells cells) const {
        const typename Base::Zone zone(this->mesh(), p, hint);
        for (const Facet &f : zone.boundary()) *facets++ = f;
        for (Cell_handle c : zone.cells()) *cells++ = c;
        return {facets, cells};
    }
    template <class Facets, class Cells, class Interior>
    detail::Triple<Facets, Cells, Interior> find_conflicts(const Point &p, Cell_handle hint, Facets facets, Cells cells,
                                                           Interior interior) const {
        const typename Base::Zone zone(this->mesh(), p, hint);
        for (const Facet &f : zone.boundary()) *facets++ = f;
        for (Cell_handle c : zone.cells()) *cells++ = c;
        for (const Facet &f : zone.inner_facets()) *interior++ = f;
        return {facets, cells, interior};
    }
    template <class Output>
    Output vertices_on_conflict_zone_boundary(const Point &p, Cell_handle hint, Output out) const {
        std::set<Vertex_handle> vertices;
        for (const auto &[c, i] : typename Base::Zone(this->mesh(), p, hint).boundary()) {
            for (int k = 1; k < 4; k++) vertices.insert(c.vertex((i + k) % 4));
        }
        return std::copy(vertices.begin(), vertices.end(), out);
    }
    // Inserts p, of which these are all cells that find_conflicts gives; throws Error if they are not.
    template <class Cells>
    Vertex_handle insert_in_hole(const Point &p, Cells first, Cells last, Cell_handle, int) {
        return this->insert_in_zone(p, first, last);
    }

private:
    static auto bare(Cell_handle c, int i) { return Policy::bare(c.vertex(i).point()); }
    template <std::size_t N>
    bool are_in_cell(const std::array<Vertex_handle, N> &vertices, Cell_handle &c,
                     const std::array<int *, N> &corners) const {
        const Cell_handle found = this->template cell_with<N>(vertices);
        if (found == nullptr) return false;
        c = found;
        for (std::size_t i = 0; i < N; i++) *corners[i] = c.index(vertices[i]);
        return true;
    }
    size_type n_hull_facets() const {
        const std::uint32_t *first = this->mesh()->cells().neighbours;
        return static_cast<size_type>(std::count(first, first + this->n_facets_of_cells(), DELDRIFT_NONE));
    }
    // Calls visit with each neighbour of a vertex, once.
    template <class Visit>
    void visit_link(Vertex_handle v, bool with_infinite, Visit visit) const {
        if (this->is_infinite(v)) {
            visit_hull(visit);
            return;
        }
        const typename Mesh::Star star(*this->mesh(), v.id());
        const deldrift_cells_view &cells = this->mesh()->cells();
        const auto &by_id = this->mesh()->by_id();
        const bool are_few = star.size() <= detail::Few_ids::max_cells;
        if (are_few) {
            for (std::uint32_t cell : star) detail::prefetch(cells.vertices + std::size_t{cell} * 4);
            detail::Few_ids ids(v.id());
            for (std::uint32_t cell : star) {
                for (std::size_t i = 0; i < 4; i++) ids.enter(cells.vertices[std::size_t{cell} * 4 + i]);
            }
            for (std::uint32_t id : ids) visit(Vertex_handle(by_id[id]));
        } else {
            std::vector<std::uint32_t> ids;
            ids.reserve(4 * star.size());
            for (std::uint32_t cell : star) {
                const std::uint32_t *row = cells.vertices + std::size_t{cell} * 4;
                std::copy_if(row, row + 4, std::back_inserter(ids), [&](std::uint32_t id) { return id != v.id(); });
            }
            std::sort(ids.begin(), ids.end());
            ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
            for (std::uint32_t id : ids) visit(Vertex_handle(by_id[id]));
        }
        if (with_infinite && is_on_hull(v, star)) visit(this->infinite_vertex());
    }
    template <class Visit>
    void visit_hull(Visit visit) const {
        std::set<Vertex_handle> vertices;
        for (Cell_handle c : this->star(this->infinite_vertex(), true)) {
            for (int i = 0; i < 4; i++) vertices.insert(c.vertex(i));
        }
        for (Vertex_handle v : vertices) {
            if (!this->is_infinite(v)) visit(v);
        }
    }
    // Each one once, of the first cell of the star that has it.
    template <class Output>
    Output edges_of(Vertex_handle v, bool with_infinite, Output out) const {
        std::set<Vertex_handle> others;
        for (Cell_handle c : this->star(v, with_infinite)) {
            for (int i = 0; i < 4; i++) {
                const bool is_new = c.vertex(i) != v && others.insert(c.vertex(i)).second;
                if (is_new && (with_infinite || !this->is_infinite(c.vertex(i)))) *out++ = Edge(c, c.index(v), i);
            }
        }
        return out;
    }
    bool is_on_hull(Vertex_handle v, const typename Mesh::Star &star) const {
        const deldrift_cells_view &cells = this->mesh()->cells();
        bool is_on_hull = false;
        for (std::uint32_t cell : star) {
            const std::size_t first = std::size_t{cell} * 4;
            for (std::size_t k = first; k < first + 4; k++) {
                is_on_hull |= (cells.neighbours[k] == DELDRIFT_NONE) & (cells.vertices[k] != v.id());
            }
        }
        return is_on_hull;
    }
    // Each one once, from the lower of its two cells; if only finite ones are wanted, infinite cells have none.
    template <class Output>
    Output facets_of(Vertex_handle v, bool with_infinite, Output out) const {
        for (Cell_handle c : this->star(v, with_infinite)) {
            for (int i = 0; i < 4; i++) {
                if (c.vertex(i) == v) continue;
                const Cell_handle other = c.neighbor(i);
                const bool is_other_there = with_infinite || !other.is_infinite();
                if (!is_other_there || c < other) *out++ = Facet(c, i);
            }
        }
        return out;
    }
};

}  // namespace detail

// K has Point_3. Info is that of vertices, or one of CGAL's data structures whose vertices have one. What CGAL has
// behind it, how to locate points and whether to lock, has no meaning here.
template <class K, class Info = void, class = void, class = void>
class Delaunay_triangulation_3
    : public detail::Space<K, typename detail::Info_of<Info>::type, detail::Plain_points<3, K>> {
    using Base = detail::Space<K, typename detail::Info_of<Info>::type, detail::Plain_points<3, K>>;

public:
    using typename Base::Bounded_side;
    using typename Base::Cell_handle;
    using typename Base::Point;
    using typename Base::Vertex_handle;
    using Base::Base;
    Delaunay_triangulation_3() = default;

    template <class... Hint>
    Vertex_handle nearest_vertex(const Point &p, Hint...) const {
        return this->nearest(detail::Coordinates<3, K>::of(p));
    }
    // Inside of the sphere of a finite cell, outside or on it, decided exactly; of an infinite one, beyond its facet.
    Bounded_side side_of_sphere(Cell_handle c, const Point &p) const {
        return static_cast<Bounded_side>(detail::side_of_sphere(c, this->mesh(), p));
    }
};

}  // namespace deldrift::cgal

#endif  // DELDRIFT_CGAL_SPACE_HPP
