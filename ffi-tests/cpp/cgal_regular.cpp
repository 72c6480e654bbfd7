// Regular triangulations under CGAL's names, where CGAL has less or its answer is not unique, and where calls fail.
// ffi-tests/cgal/regular.cpp compares them with CGAL.
#include "check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deldrift/cgal.hpp>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

using K = deldrift::cgal::Kernel;
using deldrift::cgal::Point_2;
using deldrift::cgal::Point_3;
using deldrift::cgal::Weighted_point_2;
using deldrift::cgal::Weighted_point_3;
using Rt2 = deldrift::cgal::Regular_triangulation_2<K, int>;
using Rt3 = deldrift::cgal::Regular_triangulation_3<K, int>;

static std::mt19937_64 engine(29);
static int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine); }

// On a grid, with whole weights: ties, and vertices at one place, are common.
static Weighted_point_2 drawn(const Weighted_point_2 *) {
    const double x = below(7), y = below(7);
    return {Point_2(x, y), double(below(13) - 4)};
}
static Weighted_point_3 drawn(const Weighted_point_3 *) {
    const double x = below(4), y = below(4), z = below(4);
    return {Point_3(x, y, z), double(below(9) - 3)};
}
template <class Rt>
static typename Rt::Weighted_point drawn() {
    return drawn(static_cast<const typename Rt::Weighted_point *>(nullptr));
}
static std::array<double, 2> numbers_of(const Weighted_point_2 &p) { return {p.x(), p.y()}; }
static std::array<double, 3> numbers_of(const Weighted_point_3 &p) { return {p.x(), p.y(), p.z()}; }

static auto cells_of(const Rt2 &t) { return t.finite_face_handles(); }
static auto cells_of(const Rt3 &t) { return t.finite_cell_handles(); }
static auto all_cells_of(const Rt2 &t) { return t.all_face_handles(); }
static auto all_cells_of(const Rt3 &t) { return t.all_cell_handles(); }

// Positive where the cell is in conflict.
static int side_of(const Rt2 &t, Rt2::Face_handle f, const Weighted_point_2 &p) { return t.power_test(f, p); }
static int side_of(const Rt3 &t, Rt3::Cell_handle c, const Weighted_point_3 &p) { return t.side_of_power_sphere(c, p); }

template <class Rt>
static constexpr int dimension_of = std::is_same_v<Rt, Rt2> ? 2 : 3;
using Sets = std::set<std::set<int>>;

// The infos of the corners; that of the infinite vertex is -1.
template <class Rt, class Cell>
static std::set<int> corners_of(const Rt &t, Cell c) {
    std::set<int> infos;
    for (int i = 0; i <= dimension_of<Rt>; i++) infos.insert(t.is_infinite(c->vertex(i)) ? -1 : c->vertex(i)->info());
    return infos;
}
template <class Rt, class Cells>
static Sets sets_of(const Rt &t, const Cells &cells) {
    Sets sets;
    for (auto c : cells) sets.insert(corners_of(t, c));
    return sets;
}
template <class Rt>
static std::set<int> hidden_of(const Rt &t) {
    std::set<int> infos;
    for (auto v = t.hidden_vertices_begin(); v != t.hidden_vertices_end(); ++v) infos.insert((*v)->info());
    return infos;
}

// Everything that a state tells of itself, and that it is as the triangulation that is made of its points at once.
template <class Rt>
static void check(const Rt &t) {
    constexpr int d = dimension_of<Rt>;
    CHECK(t.is_valid());
    std::map<std::uint32_t, typename Rt::Vertex_handle> by_id;
    std::size_t n_shown = 0, n_hidden = 0, n_above = 0;
    for (auto v : t.finite_vertex_handles()) {
        CHECK(!v->is_hidden() && t.is_vertex(v) && (t.dimension() < d || v->cell()->has_vertex(v)));
        by_id[v.id()] = v;
        n_shown++;
        typename Rt::Vertex_handle w;
        CHECK(t.is_vertex(v->point(), w) && w == v);
    }
    auto p = t.hidden_points_begin();
    for (auto v : t.hidden_vertex_handles()) {
        CHECK(v->is_hidden() && numbers_of(*p) == numbers_of(v->point()) && p->weight() == v->point().weight());
        ++p;
        by_id[v.id()] = v;
        n_hidden++;
        // The cell below has it in its list, and hides it.
        const auto c = v->cell();
        if (t.dimension() < d) {
            CHECK(c == nullptr);
            continue;
        }
        CHECK(!c->is_infinite() && !c->has_vertex(v));
        CHECK(side_of(t, c, v->point()) <= 0);
        std::size_t n = 0;
        for (auto w : c->vertex_list()) n += w == v;
        CHECK(n == 1);
    }
    CHECK(p == t.hidden_points_end() && t.hidden_points().size() == n_hidden);
    CHECK(n_shown == t.number_of_vertices() && n_hidden == t.number_of_hidden_vertices());
    CHECK(t.points().size() == n_shown && !t.infinite_vertex()->is_hidden());
    for (auto c : all_cells_of(t)) {
        const auto points = c->hidden_points();
        CHECK(points.size() == c->vertex_list().size());
        CHECK(points.begin() == c->hidden_points_begin() && points.end() == c->hidden_points_end());
        CHECK(!c->is_infinite() || points.empty());
        n_above += points.size();
    }
    CHECK(n_above == (t.dimension() < d ? 0 : n_hidden));
    // Ties are broken by ids, whose order is that of the points here.
    std::vector<std::array<double, d>> places;
    std::vector<double> weights;
    std::vector<int> infos;
    for (const auto &[id, v] : by_id) {
        places.push_back(numbers_of(v->point()));
        weights.push_back(v->point().weight());
        infos.push_back(v->info());
    }
    const deldrift::Triangulation fresh(d, places, deldrift::Weights(weights));
    Sets cells;
    for (const auto row : fresh.cells().template rows<d + 1>()) {
        std::set<int> corners;
        for (const std::uint32_t id : row) corners.insert(infos[id]);
        cells.insert(corners);
    }
    CHECK(sets_of(t, cells_of(t)) == cells);
    std::set<int> hidden;
    for (const std::uint32_t id : fresh.hidden_by_weight().vertices) hidden.insert(infos[id]);
    for (const std::uint32_t id : fresh.hidden_vertices().vertices) hidden.insert(infos[id]);
    CHECK(hidden_of(t) == hidden);
}

// Those that came without an info get one.
template <class Rt>
static void name_all(Rt &t, int &next) {
    for (auto v : t.finite_vertex_handles()) {
        if (v->info() == 0) v->info() = next++;
    }
    for (auto v : t.hidden_vertex_handles()) {
        if (v->info() == 0) v->info() = next++;
    }
}

// One that shows, or is hidden, whichever comes.
template <class Rt>
static typename Rt::Vertex_handle any_of(const Rt &t) {
    std::vector<typename Rt::Vertex_handle> all;
    for (auto v : t.finite_vertex_handles()) all.push_back(v);
    for (auto v : t.hidden_vertex_handles()) all.push_back(v);
    return all[static_cast<std::size_t>(below(static_cast<int>(all.size())))];
}
template <class Rt>
static bool has_same(const Rt &t, const typename Rt::Weighted_point &p) {
    typename Rt::Vertex_handle v;
    return t.is_vertex(p, v) && v->point().weight() == p.weight();
}

// What a point would change, told before it is inserted.
static void zone_of(const Rt2 &t, const Weighted_point_2 &p, std::vector<Rt2::Face_handle> &cells,
                    std::vector<Rt2::Vertex_handle> &inner) {
    std::vector<Rt2::Edge> edges, again;
    std::vector<Rt2::Vertex_handle> vertices;
    t.get_conflicts_and_boundary_and_hidden_vertices(p, std::back_inserter(cells), std::back_inserter(edges),
                                                     std::back_inserter(inner));
    std::vector<Rt2::Face_handle> faces;
    t.get_conflicts_and_hidden_vertices(p, std::back_inserter(faces), std::back_inserter(vertices));
    CHECK(faces == cells && vertices == inner);
    vertices.clear();
    t.get_boundary_of_conflicts_and_hidden_vertices(p, std::back_inserter(again), std::back_inserter(vertices),
                                                    t.infinite_face());
    CHECK(again == edges && vertices == inner);
    for (const auto &[f, i] : edges) CHECK(side_of(t, f, p) <= 0 && side_of(t, f->neighbor(i), p) > 0);
}
static void zone_of(const Rt3 &t, const Weighted_point_3 &p, std::vector<Rt3::Cell_handle> &cells,
                    std::vector<Rt3::Vertex_handle> &inner) {
    std::vector<Rt3::Facet> facets;
    t.find_conflicts(p, t.infinite_cell(), std::back_inserter(facets), std::back_inserter(cells));
    t.vertices_inside_conflict_zone(p, {}, std::back_inserter(inner));
    for (const auto &[c, i] : facets) CHECK(side_of(t, c, p) > 0 && side_of(t, c->neighbor(i), p) <= 0);
}
static Rt2::Vertex_handle insert_in(Rt2 &t, const Weighted_point_2 &p, std::vector<Rt2::Face_handle> cells) {
    std::vector<Rt2::Edge> edges;
    return t.star_hole(p, edges.begin(), edges.end(), cells.begin(), cells.end());
}
static Rt3::Vertex_handle insert_in(Rt3 &t, const Weighted_point_3 &p, std::vector<Rt3::Cell_handle> cells) {
    return t.insert_in_hole(p, cells.begin(), cells.end(), cells.empty() ? nullptr : cells[0], 0);
}

template <class Rt>
static void insert_with_zone(Rt &t, int info) {
    const auto p = drawn<Rt>();
    const bool is_there = has_same(t, p);
    decltype(all_cells_of(t).begin()->vertex_list().size()) n_in_conflict = 0;
    std::vector<typename std::decay_t<decltype(all_cells_of(t))>::value_type> zone;
    std::vector<typename Rt::Vertex_handle> inner;
    zone_of(t, p, zone, inner);
    for (auto c : all_cells_of(t)) n_in_conflict += side_of(t, c, p) > 0;
    CHECK(n_in_conflict == zone.size());
    const Sets before = sets_of(t, all_cells_of(t)), gone = sets_of(t, zone);
    std::set<int> hidden = hidden_of(t);
    const std::size_t n = t.number_of_vertices() + t.number_of_hidden_vertices();
    if (zone.empty()) {
        CHECK_THROWS(insert_in(t, p, zone), DELDRIFT_INVALID_VALUE, "the 0 cells are not the 0");
        const auto v = t.insert(p);
        // In space there is no handle of a vertex that is hidden at once.
        CHECK(is_there || (dimension_of<Rt> == 3 ? v == nullptr : v->is_hidden()));
        CHECK(t.number_of_vertices() + t.number_of_hidden_vertices() == n + !is_there);
        if (is_there) return;
        for (auto w : t.hidden_vertex_handles()) {
            if (w.id() + 1 == t.triangulation().id_count()) w->info() = info;
        }
        hidden.insert(info);
        CHECK(hidden_of(t) == hidden && sets_of(t, all_cells_of(t)) == before);
        return;
    }
    for (auto v : inner) hidden.insert(v->info());
    std::vector<typename std::decay_t<decltype(all_cells_of(t))>::value_type> fewer(zone.begin() + 1, zone.end());
    CHECK_THROWS(insert_in(t, p, fewer), DELDRIFT_INVALID_VALUE, "in conflict with the point");
    const auto v = insert_in(t, p, zone);
    v->info() = info;
    const Sets after = sets_of(t, all_cells_of(t));
    Sets removed;
    std::set_difference(before.begin(), before.end(), after.begin(), after.end(), std::inserter(removed, removed.end()));
    CHECK(removed == gone && hidden_of(t) == hidden && !v->is_hidden());
}

// Any history has the cells and the hidden vertices of a fresh triangulation.
template <class Rt>
static void histories() {
    int next = 1;
    for (int round = 0; round < 12; round++) {
        std::vector<std::pair<typename Rt::Weighted_point, int>> points;
        for (int i = 0; i < 20 + 5 * round; i++) points.emplace_back(drawn<Rt>(), next++);
        Rt t(points.begin(), points.end());
        check(t);
        for (int step = 0; step < 25; step++) {
            const int kind = below(7);
            if (t.number_of_vertices() < 8 || kind == 0) {
                points.clear();
                for (int i = 0; i < 8; i++) points.emplace_back(drawn<Rt>(), next++);
                const auto shown = static_cast<std::ptrdiff_t>(t.number_of_vertices());
                const std::ptrdiff_t more = t.insert(points.begin(), points.end());
                CHECK(shown + more == static_cast<std::ptrdiff_t>(t.number_of_vertices()));
            } else if (kind == 1 && t.dimension() == dimension_of<Rt>) {
                insert_with_zone(t, next++);
            } else if (kind == 2) {
                const auto v = any_of(t);
                t.remove(v);
                CHECK(!t.is_vertex(v));
            } else if (kind == 3) {
                const auto v = any_of(t);
                const auto p = drawn<Rt>();
                typename Rt::Vertex_handle there;
                const bool is_free = !t.is_vertex(p, there) || there == v;
                const auto w = t.move_if_no_collision(v, p);
                CHECK(is_free ? w == v && numbers_of(v->point()) == numbers_of(p) && v->point().weight() == p.weight()
                              : w == there);
                CHECK(t.move_if_no_collision(w, w->point()) == (w->is_hidden() && t.is_vertex(w->point(), there) ? there : w));
            } else if (kind == 4) {
                const auto v = any_of(t), w = t.move(v, drawn<Rt>());
                CHECK(w == v || !t.is_vertex(v));
            } else {
                std::set<typename Rt::Vertex_handle> moving;
                for (int k = 0; k < 6; k++) moving.insert(any_of(t));
                for (auto v : moving) t.stage_move(v, drawn<Rt>());
                // What is inserted meanwhile comes at once, and the moves wait.
                if (kind == 5) {
                    const auto light = drawn<Rt>();
                    const auto v = t.insert(light);
                    CHECK(t.triangulation().staged_count() == moving.size() && (v == nullptr || t.is_valid()));
                    name_all(t, next);
                    Rt copy(t);
                    copy.commit_timestamp();
                    check(copy);
                }
                t.commit_timestamp();
            }
            name_all(t, next);
            check(t);
            if (step % 8 == 0) check(Rt(t));
        }
    }
}

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
    CHECK(t.insert(small->point()) == nullptr && t.number_of_hidden_vertices() == 2 && t.insert(heavy->point()) == heavy);
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
    CHECK(sets_of(t, t.all_face_handles()) == faces && hidden_of(t) == hidden && numbers_of(v->point()) == numbers_of(before));
    CHECK(t.triangulation().id_count() == n_ids && t.triangulation().staged_count() == 0 && t.is_valid());
    CHECK(t.insert(Weighted_point_2(p, 50)).id() == n_ids && t.is_valid());

    // A facet has a power circle for the points in its plane.
    std::vector<Weighted_point_3> corners{Weighted_point_3(0, 0, 0), Weighted_point_3(4, 0, 0), Weighted_point_3(0, 4, 0),
                                          Weighted_point_3(0, 0, 4)};
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
        CHECK_THROWS(space.side_of_power_circle(f, Weighted_point_3(1, 1, 1)), DELDRIFT_INVALID_VALUE, "not in its plane");
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
    // Without a kernel that can: the centre of the power circle of (0, 0), (4, 0) and (0, 4) with the weights 0, 8 and 0.
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
    histories<Rt2>();
    histories<Rt3>();
    handles_last();
    flat_sets();
    failures_have_no_effect();
    power_diagrams_are_made_by_the_kernel();
    threads_read_at_once();
}
