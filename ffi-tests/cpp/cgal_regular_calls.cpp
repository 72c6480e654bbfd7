// Regular triangulations under CGAL's names, where CGAL has less, where there are no cells, and where calls fail.
#include "regular.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>

// A vertex that is hidden keeps its handle, and shows again with its info.
static void handles_last() {
    const std::vector<std::pair<Weighted_point_3, int>> points{{Weighted_point_3(0, 0, 0), 1},
                                                               {Weighted_point_3(8, 0, 0), 2},
                                                               {Weighted_point_3(0, 8, 0), 3},
                                                               {Weighted_point_3(0, 0, 8), 4},
                                                               {Weighted_point_3(Point_3(1, 1, 1), 0.5), 5}};
    Rt3 t(points.begin(), points.end());
    const Rt3::Vertex_handle small = t.nearest_power_vertex(Point_3(1, 1, 1));
    CHECK(small->info() == 5 && !small->is_hidden() && small->point().weight() == 0.5 && t.number_of_vertices() == 5);
    const Rt3::Vertex_handle heavy = t.insert(Weighted_point_3(Point_3(1, 1, 2), 40), small->cell());
    CHECK(small->is_hidden() && t.number_of_vertices() == 5 && t.number_of_hidden_vertices() == 1);
    CHECK(t.is_vertex(small) && *t.hidden_vertices_begin() == small && small->cell()->vertex_list().size() == 1);
    CHECK(t.nearest_power_vertex(small->point().point()) == heavy && t.degree(small) == 0);
    // A hidden point that comes again is another vertex, as in CGAL; one that is not hidden is the same.
    CHECK(t.insert(small->point()) == nullptr && t.number_of_hidden_vertices() == 2);
    CHECK(t.insert(heavy->point()) == heavy);
    Rt3 other;
    t.swap(other);
    CHECK(t.number_of_vertices() == 0 && t.number_of_hidden_vertices() == 0 && other.is_vertex(small));
    other.remove(heavy);
    CHECK(!small->is_hidden() && small->info() == 5 && other.number_of_hidden_vertices() == 1 && other.is_valid());
    // In the plane there is a handle from the beginning.
    Rt2 plane;
    for (const Point_2 &p : {Point_2(0, 0), Point_2(9, 0), Point_2(0, 9)}) plane.insert(Weighted_point_2(p, 4));
    const Rt2::Vertex_handle v = plane.push_back(Weighted_point_2(Point_2(1, 1), -50));
    CHECK(v->is_hidden() && v->face()->vertex_list().begin()->id() == v.id() && plane.degree(v) == 0);
    CHECK(plane.incident_faces(v) == nullptr && plane.incident_vertices(v).is_empty());
    CHECK(plane.move(v, Weighted_point_2(Point_2(1, 1), 4)) == v && !v->is_hidden() && plane.degree(v) == 3);
    // Removed ids are taken back in time, with hidden ones among those that stay.
    std::vector<Weighted_point_2> many;
    for (int i = 0; i < 3000; i++) many.push_back(drawn<Rt2>());
    Rt2 full(many.begin(), many.end());
    const std::size_t n = full.number_of_vertices() + full.number_of_hidden_vertices();
    CHECK(n < 49 * 13 + 1 && full.number_of_vertices() <= 49);
    for (int i = 0; i < 4000; i++) {
        const Rt2::Vertex_handle w = full.insert(Weighted_point_2(Point_2(below(70), below(70)), -20 + below(9)));
        w->info() = i;
        full.remove(w);
    }
    CHECK(full.triangulation().id_count() < 3000 && full.is_valid());
    CHECK(n == full.number_of_vertices() + full.number_of_hidden_vertices());
}

// Vertices on a line, where there are no faces, and at one place.
static void flat_sets() {
    std::vector<std::pair<Weighted_point_2, int>> points;
    for (int i = 0; i < 5; i++) points.emplace_back(Weighted_point_2(Point_2(i, 2 * i), i == 2 ? -100 : 1), i + 1);
    Rt2 t(points.begin(), points.end());
    CHECK(t.dimension() == 1 && t.number_of_faces() == 0 && t.number_of_vertices() == 4 && t.number_of_edges() == 3);
    check(t);
    const Rt2::Vertex_handle hidden = *t.hidden_vertices_begin();
    CHECK(hidden->info() == 3 && hidden->face() == nullptr && t.number_of_hidden_vertices() == 1);
    Rt2::Vertex_handle v;
    CHECK(!t.is_vertex(hidden->point(), v) && v == nullptr);
    CHECK(t.is_vertex(Weighted_point_2(Point_2(3, 6), 7), v) && v->info() == 4);
    Rt2::Locate_type lt;
    int li = 0;
    CHECK(t.locate(v->point(), lt, li) == nullptr && lt == Rt2::VERTEX);
    CHECK(t.locate(hidden->point(), lt, li) == nullptr && lt == Rt2::OUTSIDE_AFFINE_HULL);
    t.insert(Weighted_point_2(Point_2(4, 0), 1))->info() = 6;
    CHECK(t.dimension() == 2 && hidden->is_hidden());
    check(t);
    Rt3 at_one_place;
    for (int w : {3, 5, 5, 4}) at_one_place.insert(Weighted_point_3(Point_3(1, 1, 1), w));
    CHECK(at_one_place.number_of_vertices() == 1 && at_one_place.number_of_hidden_vertices() == 2);
    CHECK(at_one_place.dimension() == 0 && (*at_one_place.finite_vertices_begin())->point().weight() == 5);
}

static void failures_have_no_effect() {
    std::vector<Weighted_point_2> points;
    for (int i = 0; i < 30; i++) points.push_back(drawn<Rt2>());
    Rt2 t(points.begin(), points.end());
    int next = 1;
    name_all(t, next);
    const Sets faces = sets_of(t, t.all_face_handles());
    const std::set<int> hidden = hidden_of(t);
    const std::size_t n_ids = t.triangulation().id_count();
    const Rt2::Vertex_handle v = *t.finite_vertices_begin();
    const Weighted_point_2 before = v->point();
    const double infinity = INFINITY;
    const Point_2 p(0.5, 0.5);
    t.stage_move(v, before);
    for (int round = 0; round < 2; round++) {
        CHECK_THROWS(t.insert(Weighted_point_2(Point_2(NAN, 0), 1)), DELDRIFT_NOT_FINITE, "coordinate 0");
        CHECK_THROWS(t.insert(Weighted_point_2(Point_2(0, 2e57), -1)), DELDRIFT_OUT_OF_RANGE, "2e57");
        CHECK_THROWS(t.insert(Weighted_point_2(p, NAN)), DELDRIFT_NOT_FINITE, "NaN");
        CHECK_THROWS(t.insert(Weighted_point_2(p, infinity)), DELDRIFT_NOT_FINITE, "inf");
        CHECK_THROWS(t.insert(Weighted_point_2(p, 2e114)), DELDRIFT_OUT_OF_RANGE, "2e114");
        CHECK_THROWS(t.insert(Weighted_point_2(p, -2e114)), DELDRIFT_OUT_OF_RANGE, "2e114");
        CHECK(t.triangulation().staged_count() == (round == 0 ? 1 : 0));
        t.discard_moves();
    }
    std::vector<Weighted_point_2> bad{Weighted_point_2(p, 1), Weighted_point_2(Point_2(0.25, 0.5), NAN)};
    CHECK_THROWS(t.insert(bad.begin(), bad.end()), DELDRIFT_NOT_FINITE, "[");
    CHECK_THROWS(Rt2(bad.begin(), bad.end()), DELDRIFT_NOT_FINITE, "weights[1]");
    CHECK_THROWS(t.move(v, Weighted_point_2(Point_2(0, NAN), 1)), DELDRIFT_NOT_FINITE, "coordinate 1");
    CHECK_THROWS(t.move(v, Weighted_point_2(p, -infinity)), DELDRIFT_NOT_FINITE, "inf");
    CHECK_THROWS(t.stage_move(v, Weighted_point_2(Point_2(0, NAN), 1)), DELDRIFT_NOT_FINITE, "coordinate 1");
    const Rt2::Vertex_handle other = *std::next(t.finite_vertices_begin());
    t.stage_move(other, Weighted_point_2(p, 3));
    CHECK_THROWS(t.stage_move(v, Weighted_point_2(p, 3e114)), DELDRIFT_OUT_OF_RANGE, "3e114");
    CHECK_THROWS(t.stage_move(other, Weighted_point_2(p, 3)), DELDRIFT_DUPLICATE_MOVE, "vertex[0] is");
    // The other move still waits, alone.
    CHECK(t.triangulation().staged_count() == 1);
    t.discard_moves();
    CHECK_THROWS(t.nearest_power_vertex(Point_2(NAN, 0)), DELDRIFT_NOT_FINITE, "coordinate 0");
    std::vector<Rt2::Face_handle> conflicts;
    CHECK_THROWS(t.get_conflicts(Weighted_point_2(Point_2(1, NAN), 0), std::back_inserter(conflicts)),
                 DELDRIFT_NOT_FINITE, "coordinate 1");
    CHECK(sets_of(t, t.all_face_handles()) == faces && hidden_of(t) == hidden);
    CHECK(numbers_of(v->point()) == numbers_of(before) && v->point().weight() == before.weight());
    CHECK(t.triangulation().id_count() == n_ids && t.triangulation().staged_count() == 0 && t.is_valid());
    CHECK(t.insert(Weighted_point_2(p, 50)).id() == n_ids && t.is_valid());

    // A facet has a power circle for the points in its plane.
    std::vector<Weighted_point_3> corners;
    for (int k = 0; k < 4; k++) corners.emplace_back(k == 1 ? 4 : 0, k == 2 ? 4 : 0, k == 3 ? 4 : 0);
    const Rt3 space(corners.begin(), corners.end());
    const Rt3::Cell_handle c = *space.finite_cells_begin();
    for (int i = 0; i < 4; i++) {
        const Rt3::Facet f(c, i), mirrored = space.mirror_facet(f);
        if (c->vertex(i)->point().z() != 4) continue;
        // That of the facet with z = 0: its centre is (2, 2), the square of its radius 8.
        const Weighted_point_3 on(Point_3(4, 4, 0), 0), inside(Point_3(5, 5, 0), 10.5), outside(Point_3(5, 5, 0), 9.5);
        CHECK(space.side_of_power_circle(f, on) == deldrift::cgal::ON_BOUNDARY);
        CHECK(space.side_of_power_circle(c, i, inside) == deldrift::cgal::ON_BOUNDED_SIDE);
        CHECK(space.side_of_power_circle(mirrored, outside) == deldrift::cgal::ON_UNBOUNDED_SIDE);
        const Weighted_point_3 above(1, 1, 1);
        CHECK_THROWS(space.side_of_power_circle(f, above), DELDRIFT_INVALID_VALUE, "not in its plane");
        const Rt3::Facet infinite(mirrored.first, (mirrored.second + 1) % 4);
        CHECK_THROWS(space.side_of_power_circle(infinite, on), DELDRIFT_INVALID_VALUE, "the facet is infinite");
    }
}

// A kernel with all that edges of the power diagram are made of; a line is a direction.
struct Power_kernel {
    using FT = double;
    using Point_2 = deldrift::cgal::Point_2;
    using Weighted_point_2 = deldrift::cgal::Weighted_point_2;
    struct Line {
        double x, y;
    };
    struct Object_2 {
        char kind = ' ';
        std::array<double, 4> numbers{};
        friend std::ostream &operator<<(std::ostream &out, const Object_2 &o) { return out << o.kind; }
    };
    struct Centre {
        Point_2 operator()(const Weighted_point_2 &a, const Weighted_point_2 &, const Weighted_point_2 &c) const {
            return {a.weight() + c.weight(), 100};
        }
    };
    struct Segment {
        Object_2 operator()(const Point_2 &a, const Point_2 &b) const { return {'s', {a.x(), a.y(), b.x(), b.y()}}; }
    };
    struct Axis {
        Line operator()(const Weighted_point_2 &a, const Weighted_point_2 &b) const { return {a.weight(), b.weight()}; }
    };
    struct Ray {
        Object_2 operator()(const Point_2 &a, const Line &l) const { return {'r', {a.x(), a.y(), l.x, l.y}}; }
    };
    struct Same {
        Object_2 operator()(const Object_2 &o) const { return o; }
    };
    Centre construct_weighted_circumcenter_2_object() const { return {}; }
    Segment construct_segment_2_object() const { return {}; }
    Axis construct_radical_axis_2_object() const { return {}; }
    Ray construct_ray_2_object() const { return {}; }
    Same construct_object_2_object() const { return {}; }
};

static void power_diagrams_are_made_by_the_kernel() {
    using Rt = deldrift::cgal::Regular_triangulation_2<Power_kernel>;
    const std::vector<Weighted_point_2> points{{Point_2(0, 0), 1}, {Point_2(4, 0), 1}, {Point_2(2, 3), 1},
                                               {Point_2(2, -3), 1}};
    const Rt t(points.begin(), points.end(), Power_kernel());
    CHECK(t.dual(*t.finite_faces_begin()) == Point_2(2, 100));
    CHECK(t.weighted_circumcenter(*t.finite_faces_begin()) == Point_2(2, 100));
    std::size_t n_rays = 0;
    for (const Rt::Edge &e : t.finite_edges()) {
        const Power_kernel::Object_2 o = t.dual(e);
        n_rays += o.kind == 'r';
        CHECK(o.numbers[0] == 2 && (o.kind != 'r' || (o.numbers[2] == 1 && o.numbers[3] == 1)));
    }
    std::ostringstream text;
    t.draw_dual(text);
    const std::string drawn_edges = text.str();
    CHECK(n_rays == 4 && drawn_edges.size() == 5 && std::count(drawn_edges.begin(), drawn_edges.end(), 'r') == 4);
    // Without a kernel that can: of (0, 0), (4, 0) and (0, 4) with the weights 0, 8 and 0.
    const std::vector<Weighted_point_2> corner{{Point_2(0, 0), 0}, {Point_2(4, 0), 8}, {Point_2(0, 4), 0}};
    const Rt2 plane(corner.begin(), corner.end());
    CHECK(plane.dual(*plane.finite_faces_begin()) == Point_2(1, 2));
    CHECK(plane.segment(*plane.finite_edges_begin()).source() != plane.segment(*plane.finite_edges_begin()).target());
    const Weighted_point_3 p(1, 2, 3), q(Point_3(1, 2, 3));
    CHECK(p == q && !(p != q) && !(p < q) && p.weight() == 0 && p[2] == 3 && p.dimension() == 3);
    std::ostringstream written;
    written << Weighted_point_3(Point_3(1, 2, 3), 4);
    CHECK(written.str() == "1 2 3 4");
}

// What is asked first is made once, whoever asks.
static void threads_read_at_once() {
    std::vector<std::pair<Weighted_point_3, int>> points;
    for (int i = 0; i < 400; i++) points.emplace_back(drawn<Rt3>(), i + 1);
    const Rt3 t(points.begin(), points.end());
    std::array<std::size_t, 4> n_hidden{};
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < 4; k++) {
        threads.emplace_back([&, k] {
            for (auto c : t.finite_cell_handles()) n_hidden[k] += c->vertex_list().size();
        });
    }
    for (std::thread &thread : threads) thread.join();
    for (std::size_t n : n_hidden) CHECK(n == t.number_of_hidden_vertices() && n > 0);
}

int main() {
    handles_last();
    flat_sets();
    failures_have_no_effect();
    power_diagrams_are_made_by_the_kernel();
    threads_read_at_once();
}
