// deldrift/cgal.hpp with kernels of a program's own, and what handles are in the containers of others.
#include "check.hpp"

#include <algorithm>
#include <array>
#include <deldrift/cgal.hpp>
#include <iterator>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

using K = deldrift::cgal::Kernel;
using deldrift::cgal::Point_2;
using deldrift::cgal::Point_3;
using Dt2 = deldrift::cgal::Delaunay_triangulation_2<K, int>;
using Dt3 = deldrift::cgal::Delaunay_triangulation_3<K>;

static std::mt19937_64 engine(5);

static double anywhere() { return std::uniform_int_distribution<int>(0, 999)(engine); }

static void handles_are_in_order() {
    const std::vector<Point_2> points{Point_2(0, 0), Point_2(4, 0), Point_2(0, 3), Point_2(5, 5)};
    const Dt2 t(points.begin(), points.end());
    const Dt2::Vertex_handle v = *t.finite_vertices_begin(), w = *std::next(t.finite_vertices_begin());
    CHECK((v < w) != (v > w) && (v <= w) != (v >= w) && v >= v && v <= v && !(v > v));
    const Dt2::Face_handle f = *t.finite_faces_begin(), g = *std::next(t.finite_faces_begin());
    CHECK(g > f && g >= f && f <= g && f >= f && !(f > g));
    CHECK(hash_value(v) == std::hash<Dt2::Vertex_handle>()(v) && hash_value(f) == std::hash<Dt2::Face_handle>()(f));
    static_assert(std::is_same_v<Dt2::Vertex_handle::value_type, Dt2::Vertex>);
    static_assert(std::is_same_v<Dt2::All_faces_iterator::value_type, Dt2::Face_handle>);
    static_assert(std::is_same_v<Dt2::All_vertices_iterator::value_type, Dt2::Vertex_handle>);
    static_assert(std::is_same_v<Dt3::Cell_iterator::value_type, Dt3::Cell_handle>);
    static_assert(std::is_same_v<Dt2::Face::Vertex_handle, Dt2::Vertex_handle>);
    static_assert(std::is_same_v<Dt2::Vertex::Face_handle, Dt2::Face_handle>);
}

// A kernel of a program's own, with circumcentres that are known again.
struct Own_kernel {
    struct Point_2 {
        double a = 0, b = 0;
        Point_2() = default;
        Point_2(double x, double y) : a(x), b(y) {}
        double x() const { return a; }
        double y() const { return b; }
    };
    using FT = double;
    struct Circumcentre {
        double offset;
        Point_2 operator()(const Point_2 &, const Point_2 &, const Point_2 &) const { return {offset, -offset}; }
    };
    Circumcentre construct_circumcenter_2_object() const { return {offset}; }
    double offset = 0;
};

// One with all that Voronoi edges are made of; a line is a direction.
struct Voronoi_kernel {
    using FT = double;
    using Point_2 = deldrift::cgal::Point_2;
    struct Line {
        double x, y;
    };
    // What it is, where it begins, and where it ends or its direction.
    struct Object_2 {
        char kind = ' ';
        std::array<double, 4> numbers{};
        friend std::ostream &operator<<(std::ostream &out, const Object_2 &o) { return out << o.kind; }
    };
    struct Circumcentre {
        Point_2 operator()(const Point_2 &a, const Point_2 &b, const Point_2 &c) const {
            const double x = b.x() - a.x(), y = b.y() - a.y(), u = c.x() - a.x(), v = c.y() - a.y();
            const double p = x * x + y * y, q = u * u + v * v, scale = 2 * (x * v - y * u);
            return {a.x() + (v * p - y * q) / scale, a.y() + (x * q - u * p) / scale};
        }
    };
    struct Segment {
        Object_2 operator()(const Point_2 &a, const Point_2 &b) const { return {'s', {a.x(), a.y(), b.x(), b.y()}}; }
    };
    // Directed so that the first point is on the left.
    struct Bisector {
        Line operator()(const Point_2 &a, const Point_2 &b) const { return {a.y() - b.y(), b.x() - a.x()}; }
    };
    struct Ray {
        Object_2 operator()(const Point_2 &a, const Line &l) const { return {'r', {a.x(), a.y(), l.x, l.y}}; }
    };
    struct Same {
        Object_2 operator()(const Object_2 &o) const { return o; }
    };
    Circumcentre construct_circumcenter_2_object() const { return {}; }
    Segment construct_segment_2_object() const { return {}; }
    Bisector construct_bisector_2_object() const { return {}; }
    Ray construct_ray_2_object() const { return {}; }
    Same construct_object_2_object() const { return {}; }
};

static void voronoi_edges_are_between_circumcentres() {
    using Dt = deldrift::cgal::Delaunay_triangulation_2<Voronoi_kernel>;
    // Two triangles, with circumcentres (2, 1.5) and (2, -3.75).
    const std::vector<Point_2> points{Point_2(0, 0), Point_2(4, 0), Point_2(2, 4), Point_2(2, -8)};
    const Dt t(points.begin(), points.end());
    std::size_t n_rays = 0;
    for (const Dt::Edge &e : t.finite_edges()) {
        const Voronoi_kernel::Object_2 o = t.dual(e), mirrored = t.dual(t.mirror_edge(e));
        CHECK(o.kind == mirrored.kind && o.numbers[0] == 2);
        const Point_2 a = t.segment(e).source(), b = t.segment(e).target();
        // Of a ray: orthogonal to the edge, and away from the vertices.
        if (o.kind == 'r') {
            n_rays++;
            const double x = o.numbers[2], y = o.numbers[3];
            CHECK(x * (b.x() - a.x()) + y * (b.y() - a.y()) == 0 && o.numbers == mirrored.numbers);
            CHECK(x * (a.x() - 2) + y * a.y() > 0);
        } else {
            CHECK(a.y() == 0 && b.y() == 0 && o.numbers[2] == 2 && mirrored.numbers[1] == o.numbers[3]);
            CHECK(std::min(o.numbers[1], o.numbers[3]) == -3.75 && std::max(o.numbers[1], o.numbers[3]) == 1.5);
        }
    }
    std::ostringstream text;
    CHECK(&t.draw_dual(text) == &text);
    const std::string drawn = text.str();
    CHECK(n_rays == 4 && std::count(drawn.begin(), drawn.end(), 'r') == 4);
    CHECK(std::count(drawn.begin(), drawn.end(), 's') == 1);
}

// What CGAL has for points in space that are projected, by its name alone.
struct Space {
    using Point_3 = deldrift::cgal::Point_3;
};



namespace CGAL {
template <class R>
class Projection_traits_xy_3 {
public:
    using Point_2 = typename R::Point_3;
};
template <class R>
class Projection_traits_xz_3 : public Projection_traits_xy_3<R> {};
template <class R>
class Projection_traits_yz_3 : public Projection_traits_xy_3<R> {};
}  // namespace CGAL

// CGAL's policies of location, and what else its class in space may be given, are passed over.
static void parameters_without_meaning() {
    using Policy = CGAL::Location_policy<int>;
    using Located = deldrift::cgal::Delaunay_triangulation_3<K, Policy>;
    using Locked = deldrift::cgal::Delaunay_triangulation_3<K, unsigned, Policy, int>;
    static_assert(std::is_same_v<Located::Vertex::Info, Dt3::Vertex::Info>);
    Locked t;
    t.insert(Point_3(1, 2, 3))->info() = 7;
    CHECK(t.nearest_vertex(Point_3(0, 0, 0))->info() == 7);
    // In a plane there are no cells, and nothing is in conflict.
    t.insert(Point_3(2, 2, 3));
    t.insert(Point_3(2, 4, 3));
    std::vector<Locked::Cell_handle> cells;
    std::vector<Locked::Facet> facets;
    t.find_conflicts(Point_3(0, 0, 0), nullptr, std::back_inserter(facets), std::back_inserter(cells));
    CHECK(cells.empty() && facets.empty() && t.number_of_edges() == 0 && t.number_of_facets() == 0);
    CHECK(t.all_edges().empty() && t.all_facets().empty() && t.all_vertex_handles().size() == 4);
    CHECK(!t.is_edge(t.infinite_vertex(), *t.finite_vertices_begin()));
    t.incident_cells(t.infinite_vertex(), std::back_inserter(cells));
    CHECK(cells.empty());
    CHECK_THROWS(t.insert_in_hole(Point_3(0, 0, 0), cells.begin(), cells.end(), nullptr, 0), DELDRIFT_INVALID_VALUE,
                 "the 0 cells are not the 0 that are in conflict");
}

// Of triples of ids in ascending order.
template <class Traits, class Points>
static std::set<std::array<std::uint32_t, 3>> faces_of(const Points &points) {
    const deldrift::cgal::Delaunay_triangulation_2<Traits> t(points.begin(), points.end());
    CHECK(t.is_valid() && t.number_of_vertices() == points.size());
    std::set<std::array<std::uint32_t, 3>> faces;
    for (const auto &f : t.finite_face_handles()) {
        std::array<std::uint32_t, 3> ids{f->vertex(0)->id(), f->vertex(1)->id(), f->vertex(2)->id()};
        std::sort(ids.begin(), ids.end());
        faces.insert(ids);
    }
    return faces;
}

static void kernels_say_what_points_are() {
    using Own = deldrift::cgal::Delaunay_triangulation_2<Own_kernel>;
    Own t(Own_kernel{7});
    t.insert(Own_kernel::Point_2(0, 0));
    t.insert(Own_kernel::Point_2(1, 0));
    t.insert(Own_kernel::Point_2(0, 1));
    Own copy(t), other;
    other.swap(copy);
    CHECK(t.dual(*t.finite_faces_begin()).x() == 7 && other.circumcenter(*other.finite_faces_begin()).y() == -7);
    CHECK(other.geom_traits().offset == 7 && copy.geom_traits().offset == 0);
    CHECK(t.triangle(*t.finite_faces_begin()).vertex(0).x() == t.point(*t.finite_faces_begin(), 0).x());

    std::vector<Point_3> points;
    for (int i = 0; i < 40; i++) points.emplace_back(anywhere(), anywhere(), anywhere());
    std::vector<Point_2> xy, xz, yz;
    for (const Point_3 &p : points) {
        xy.emplace_back(p.x(), p.y());
        xz.emplace_back(p.x(), p.z());
        yz.emplace_back(p.y(), p.z());
    }
    CHECK(faces_of<CGAL::Projection_traits_xy_3<Space>>(points) == faces_of<K>(xy));
    CHECK(faces_of<CGAL::Projection_traits_xz_3<Space>>(points) == faces_of<K>(xz));
    CHECK(faces_of<CGAL::Projection_traits_yz_3<Space>>(points) == faces_of<K>(yz));
    CHECK(faces_of<K>(xy) != faces_of<K>(yz));
    // Different heights at one place are one vertex, which keeps the first.
    deldrift::cgal::Delaunay_triangulation_2<CGAL::Projection_traits_xy_3<Space>> terrain;
    const auto v = terrain.insert(Point_3(1, 2, 3));
    CHECK(terrain.insert(Point_3(1, 2, 4)) == v && v->point().z() == 3);
}

int main() {
    handles_are_in_order();
    voronoi_edges_are_between_circumcentres();
    parameters_without_meaning();
    kernels_say_what_points_are();
}
