// Inputs on which CGAL's constrained triangulations have failed, rebuilt from its issues of these numbers. Afterwards the
// cells are those of a fresh build, and, in big integers, those of the definition.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deldrift/cgal.hpp>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "big.hpp"
#include "check.hpp"

using K = deldrift::cgal::Kernel;
using Point = K::Point_2;
using Cdt = deldrift::cgal::Constrained_Delaunay_triangulation_2<K, unsigned>;
using Rounding = deldrift::cgal::Constrained_Delaunay_triangulation_2<K, unsigned, deldrift::cgal::Exact_predicates_tag>;
// All that is no template compiles for any kernel.
template class deldrift::cgal::Constrained_Delaunay_triangulation_2<K, int>;
template class deldrift::cgal::Constrained_Delaunay_triangulation_2<K, deldrift::cgal::Infos<void, int>,
                                                                    deldrift::cgal::Exact_predicates_tag>;

using Constraints = std::vector<std::array<double, 4>>;

// Positive if p is inside of the circle through a, b and c, which are in counter-clockwise order.
static int side_of_circle(const Place &a, const Place &b, const Place &c, const Place &p) {
    const auto row = [&](const Place &q) {
        const Big x = q.x - p.x, y = q.y - p.y;
        return std::array<Big, 3>{x, y, x * x + y * y};
    };
    const auto [ax, ay, a2] = row(a);
    const auto [bx, by, b2] = row(b);
    const auto [cx, cy, c2] = row(c);
    return (a2 * (bx * cy - by * cx) - b2 * (ax * cy - ay * cx) + c2 * (ax * by - ay * bx)).sign();
}

template <class T>
static std::set<std::array<std::uint32_t, 3>> cells_of(const T &t) {
    std::set<std::array<std::uint32_t, 3>> cells;
    for (auto row : t.cells().template rows<3>()) {
        std::array<std::uint32_t, 3> cell{row[0], row[1], row[2]};
        std::sort(cell.begin(), cell.end());
        cells.insert(cell);
    }
    return cells;
}

// The triangulation of the same vertices and constraints, built at once.
template <class T>
static void check_against_fresh_build(const T &t) {
    const deldrift_triangulation *native = t.triangulation().native();
    std::size_t n = 0;
    deldrift_segments(native, nullptr, nullptr, nullptr, 0, &n);
    std::vector<std::uint32_t> ids(n), ends(2 * n);
    CHECK(deldrift_segments(native, ids.data(), ends.data(), nullptr, n, &n) == DELDRIFT_OK);
    deldrift::Triangulation fresh(2, t.triangulation().positions());
    std::uint32_t first = 0;
    CHECK(deldrift_stage_segments(fresh.native(), ends.data(), nullptr, n, &first) == DELDRIFT_OK);
    fresh.commit_timestamp();
    std::vector<std::uint32_t> removed;
    for (std::uint32_t v = 0; v < t.triangulation().id_count(); v++) {
        if (!t.triangulation().is_present(v)) removed.push_back(v);
    }
    CHECK(removed.empty());
    CHECK(cells_of(fresh) == cells_of(t.triangulation()));
}

// The definition: faces cover the convex hull, and no vertex beyond an edge that is no constraint is in the circle. (For
// a triangulation with all constraints that is the same as that no vertex in the circle is seen from the face.)
template <class T>
static void check_definition(const T &t) {
    const std::vector<Place> places = places_of(t.triangulation().positions());
    const auto at = [&](auto v) -> const Place & { return places[v->id()]; };
    std::size_t n_hull = 0;
    for (auto f : t.finite_face_handles()) {
        CHECK(cross(at(f->vertex(0)), at(f->vertex(1)), at(f->vertex(2))).sign() > 0);
        for (int i = 0; i < 3; i++) {
            const auto g = f->neighbor(i);
            const int k = t.mirror_index(f, i);
            CHECK(g->neighbor(k) == f && g->is_constrained(k) == f->is_constrained(i));
            if (t.is_infinite(g)) {
                n_hull++;
                const Place &a = at(f->vertex(t.ccw(i))), &b = at(f->vertex(t.cw(i)));
                for (const Place &p : places) CHECK(cross(a, b, p).sign() >= 0);
            } else if (!f->is_constrained(i)) {
                CHECK(side_of_circle(at(f->vertex(0)), at(f->vertex(1)), at(f->vertex(2)), at(g->vertex(k))) <= 0);
            }
        }
    }
    CHECK(t.number_of_faces() == 2 * t.number_of_vertices() - 2 - n_hull);
}

template <class T>
static void check(const T &t) {
    CHECK(t.is_valid());
    check_against_fresh_build(t);
    if (t.number_of_faces() > 0) check_definition(t);
}

template <class T>
static std::size_t number_of_constraints(const T &t) {
    return t.constrained_edges().size();
}

// Whether a way of constraints leads from one place to the other that is off the straight one by rounding only.
template <class T>
static bool is_constrained_way(T &t, const Point &from, const Point &to) {
    const double x = to.x() - from.x(), y = to.y() - from.y();
    const auto is_near = [&](const Point &p) {
        return std::fabs(x * (p.y() - from.y()) - y * (p.x() - from.x())) <= 1e-9 * (x * x + y * y);
    };
    std::vector<typename T::Vertex_handle> way{t.nearest_vertex(from)};
    for (std::size_t k = 0; k < way.size(); k++) {
        std::vector<typename T::Edge> edges;
        t.incident_constraints(way[k], std::back_inserter(edges));
        for (const auto &[f, i] : edges) {
            const auto w = f->vertex(t.ccw(i)) == way[k] ? f->vertex(t.cw(i)) : f->vertex(t.ccw(i));
            if (is_near(w->point()) && std::find(way.begin(), way.end(), w) == way.end()) way.push_back(w);
        }
    }
    return std::find(way.begin(), way.end(), t.nearest_vertex(to)) != way.end();
}

// All vertices move and come back. Where rounding would put a vertex on a constraint, or two at one place, that is refused.
template <class T>
static void move_to_and_fro(T &t) {
    const auto before = cells_of(t.triangulation());
    for (double by : {1024.0, -1024.0}) {
        for (auto v : t.finite_vertex_handles()) t.stage_move(v, Point(v->point().x() + by, v->point().y()));
        try {
            t.commit_timestamp();
        } catch (const deldrift::Error &) {
            t.discard_moves();
            CHECK(by > 0 && cells_of(t.triangulation()) == before);
            check(t);
            return;
        }
        check(t);
    }
}

static std::vector<Point> points(const std::vector<std::array<double, 2>> &places) {
    std::vector<Point> points;
    for (const auto &[x, y] : places) points.emplace_back(x, y);
    return points;
}

// 3447: one chain, inserted twice.
static void inserted_twice() {
    Cdt t;
    for (const Point &p : points({{0, 0}, {10, 0}, {0, 10}, {10, 10}})) t.insert(p);
    const std::vector<Point> chain = points({{1, 2}, {2, 2}, {3, 2}});
    for (int i = 0; i < 2; i++) {
        t.insert_constraint(chain.begin(), chain.end());
        CHECK(t.number_of_vertices() == 7 && number_of_constraints(t) == 2);
        check(t);
    }
    t.insert_constraint(chain[0], chain[2]);
    t.insert_constraint(chain[2], chain[0]);
    CHECK(number_of_constraints(t) == 2);
    move_to_and_fro(t);
}

// 4010: inserted, removed, and inserted again.
static void restored() {
    Cdt t;
    const Cdt::Vertex_handle a = t.insert(Point(0, 0));
    t.insert(Point(0, 10));
    const Cdt::Vertex_handle c = t.insert(Point(10, 10));
    t.insert(Point(10, 0));
    for (int i = 0; i < 3; i++) {
        t.insert_constraint(a, c);
        Cdt::Face_handle f;
        int k = 0;
        CHECK(t.is_edge(a, c, f, k) && f->is_constrained(k) && number_of_constraints(t) == 1);
        check(t);
        t.remove_constraint(f, k);
        CHECK(number_of_constraints(t) == 0 && !t.are_there_incident_constraints(a));
        check(t);
    }
}

// 4025: chains on a line and not, from which an inner vertex is taken out and put back; chains that go through their own
// vertices, or along themselves or each other.
static void through_own_vertices() {
    Cdt t;
    const std::vector<Point> straight = points({{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}});
    const std::vector<Point> bent = points({{1, 0}, {2, 1}, {4, 2}, {2, 3}, {4, 4}, {1, 5}});
    t.insert_constraint(straight.begin(), straight.end());
    t.insert_constraint(bent.begin(), bent.end());
    CHECK(number_of_constraints(t) == 10);
    check(t);
    t.remove_incident_constraints(t.insert(straight[2]));
    CHECK(number_of_constraints(t) == 8);
    // The vertex is still there, and on the way.
    t.insert_constraint(straight[1], straight[3]);
    CHECK(number_of_constraints(t) == 10);
    check(t);
    t.remove_incident_constraints(t.insert(bent[2]));
    t.insert_constraint(bent[1], bent[3]);
    CHECK(number_of_constraints(t) == 9);
    check(t);
    move_to_and_fro(t);

    const struct {
        std::vector<std::array<double, 2>> places;
        std::size_t n;
    } chains[] = {{{{0, 0}, {1, 0}, {1, 1}, {-1, -1}}, 4}, {{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {3, 0}}, 4}};
    for (const auto &chain : chains) {
        Cdt own;
        const std::vector<Point> places = points(chain.places);
        own.insert_constraint(places.begin(), places.end());
        CHECK(number_of_constraints(own) == chain.n);
        check(own);
    }
    Cdt two;
    for (const auto &chain : {points({{0, 0}, {1, 0}, {2, 0}, {3, 0}}), points({{0, 1}, {1, 0}, {2, 0}, {3, 1}})}) {
        two.insert_constraint(chain.begin(), chain.end());
    }
    CHECK(number_of_constraints(two) == 5);
    check(two);
}

// Constraints that cross close to their ends, nearly along each other: each crossing gets a vertex, and there is an end
// to it. Without rounding they are refused, and nothing has changed.
static void cross(const Constraints &constraints, bool do_cross) {
    Rounding t;
    Cdt strict;
    bool is_refused = false;
    for (const auto &[ax, ay, bx, by] : constraints) {
        t.insert_constraint(Point(ax, ay), Point(bx, by));
        check(t);
        const Cdt::Vertex_handle a = strict.insert(Point(ax, ay)), b = strict.insert(Point(bx, by));
        const auto before = cells_of(strict.triangulation());
        const std::size_t n = number_of_constraints(strict);
        try {
            strict.insert_constraint(a, b);
        } catch (const Cdt::Intersection_of_constraints_exception &) {
            is_refused = true;
            CHECK(cells_of(strict.triangulation()) == before && number_of_constraints(strict) == n);
        }
        check(strict);
    }
    CHECK(is_refused == do_cross);
    for (const auto &[ax, ay, bx, by] : constraints) CHECK(is_constrained_way(t, Point(ax, ay), Point(bx, by)));
    move_to_and_fro(t);
    move_to_and_fro(strict);
}

// 7328: a constraint is inserted in a copy.
static void in_a_copy() {
    Rounding t;
    std::vector<Rounding::Vertex_handle> v;
    for (const Point &p : points({{0.867732088229836496, -1.098635766973843797},
                                  {0.868834588233415861, -1.100000000000000533},
                                  {0.729063637498132522, -0.927047486193771419},
                                  {0.760857518227448626, -0.918203415668045420}})) {
        v.push_back(t.insert(p));
    }
    t.insert_constraint(v[0], v[2]);
    t.insert_constraint(v[0], v[3]);
    const auto before = cells_of(t.triangulation());
    Rounding copy(t), by_handles(t);
    copy.insert_constraint(v[1]->point(), v[2]->point());
    by_handles.insert_constraint(by_handles.insert(v[1]->point()), by_handles.insert(v[2]->point()));
    for (const Rounding *one : {&copy, &by_handles}) check(*one);
    CHECK(cells_of(copy.triangulation()) == cells_of(by_handles.triangulation()));
    CHECK(is_constrained_way(copy, v[1]->point(), v[2]->point()));
    CHECK(cells_of(t.triangulation()) == before && number_of_constraints(t) == 2);
    move_to_and_fro(copy);
}

// Many through nearly one place, and along nearly one line, so that some are rounded to the same edges: each has one segment,
// and goes at once when its constraint is removed.
static void through_nearly_one_place() {
    Constraints star, bundle;
    for (int i = 0; i < 14; i++) {
        const double turn = 0.21 * i, x = std::cos(turn), y = std::sin(turn);
        star.push_back({1e6 + x, 1e6 + y, 1e6 - 1.5 * x, 1e6 - 1.25 * y});
        bundle.push_back({0, 1 + 2.5e-16 * (i % 4), 1 + 0.125 * i, 1 + 2.5e-16 * (i * 5 % 7)});
    }
    for (const Constraints &lines : {star, bundle}) {
        cross(lines, true);
        std::vector<std::pair<Point, Point>> given;
        for (const auto &[ax, ay, bx, by] : lines) given.emplace_back(Point(ax, ay), Point(bx, by));
        Rounding t;
        t.insert_constraints(given.begin(), given.end());
        check(t);
        std::set<std::array<std::uint32_t, 2>> edges;
        for (const auto [id, ends, marker] : t.triangulation().segments()) {
            CHECK(marker == 0 && edges.insert({std::min(ends[0], ends[1]), std::max(ends[0], ends[1])}).second);
        }
        for (std::size_t n = edges.size(); n > 0; n--) {
            CHECK(number_of_constraints(t) == n);
            const auto [f, i] = *t.constrained_edges_begin();
            t.remove_constrained_edge(f, i);
        }
        CHECK(number_of_constraints(t) == 0);
    }

    // A move that waits goes on waiting.
    Rounding t;
    const auto v = t.insert(Point(0, 0)), w = t.insert(Point(4, 4)), free = t.insert(Point(9, 1));
    t.insert_constraint(v, w);
    t.stage_move(free, Point(9, 2));
    t.insert_constraint(Point(0, 4), Point(4, 0));
    CHECK(t.number_of_vertices() == 6 && free->point() == Point(9, 1) && t.nearest_vertex(Point(2, 2))->info() == 0);
    CHECK(t.nearest_vertex(Point(2, 2))->point() == Point(2, 2));
    t.commit_timestamp();
    CHECK(free->point() == Point(9, 2) && number_of_constraints(t) == 4);
    check(t);
}

// Constraints that are none, as docs/FROM_CGAL.md says: CGAL inserts no points then, and has them as a precondition.
static void without_length() {
    Cdt cdt;
    const std::vector<Point> points{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    std::vector<std::pair<int, int>> pairs;
    CHECK(cdt.insert_constraints(points.begin(), points.end(), pairs.begin(), pairs.end()) == 4);
    CHECK(cdt.number_of_vertices() == 4 && cdt.number_of_faces() == 2);
    pairs = {{1, 1}, {0, 1}};
    CHECK(cdt.insert_constraints(points.begin(), points.end(), pairs.begin(), pairs.end()) == 0);
    const auto v = cdt.insert({1, 2});
    cdt.insert_constraint(v, v);
    cdt.insert_constraint(Point(1, 2), Point(1, 2));
    CHECK(cdt.triangulation().segments().size() == 1 && !cdt.are_there_incident_constraints(v));
    check(cdt);
}

int main() {
    without_length();
    through_nearly_one_place();
    inserted_twice();
    restored();
    through_own_vertices();
    in_a_copy();
    // 4405, and without its last one.
    const Constraints close = {{539.5294108288881, 332.45151278002265, 538.779296875, 329.10546875},
                               {539.74609375, 332.431640625, 539.5294108288881, 332.45151278002265},
                               {539.68266371486789, 333.13513011783971, 538.779296875, 329.10546875},
                               {539.74609375, 332.431640625, 539.52898179930912, 332.45155212665065}};
    cross(close, true);
    // 5055
    cross({{722.060172459952354984, 546.431441157868448499, 721.605164369421572701, 547.286947218267187054},
           {489.054338074482529919, 73.4795619763430352123, 488.992971641138979066, 70.6742393092105203323},
           {658.294921875, 494.029296875, 655.601638506381050320, 492.704923416975930195},
           {748.077080682167661507, 516.511846264136920581, 746.966796875, 516.37109375},
           {559.349064841414701732, 442.600717751872252848, 556.66015625, 441.27734375},
           {636.340512288503987293, 483.223199100345823354, 636.33984375, 483.224609375},
           {572.431981051620141443, 462.372208487347847949, 571.998046875, 461.55078125},
           {554.615246238433428516, 399.093747119970316817, 553.91015625, 396.1796875},
           {629.072265625, 477.775390625, 629.071750798135099103, 477.776482510548703431},
           {489.089689771187522638, 74.6450533344111875067, 489.006004028320262478, 71.4945312499999943157},
           {489.054338074482529919, 73.4795619763430352123, 488.992951403166102864, 70.6733141447368495847}},
          true);
    // 5080
    const double x = -1.5617169965001162502e-21, y = -0.0059749999999959748503;
    cross({{x, y, 1.8241074394927896017e-06, -0.0059800116939744598493},
           {x, y, 1.8241073772900120186e-06, -0.0059699883060029008269},
           {x, y, 5.0116939794452514324e-06, -0.00597682410742579346},
           {x, y, 5.0116939818259595034e-06, -0.0059731758925807469998},
           {0, -0.0060000000000000001249, 0, -0.00596}},
          true);
    return 0;
}
