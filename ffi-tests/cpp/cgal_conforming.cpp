// Conforming triangulations under CGAL's names, checked in big integers; handles, infos, moves, copies, and failures.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deldrift/cgal.hpp>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "big.hpp"
#include "check.hpp"

namespace cgal = deldrift::cgal;

using K = cgal::Kernel;
using Point = K::Point_2;
using Cdt = cgal::Constrained_Delaunay_triangulation_2<K, int>;
using Conformer = cgal::Triangulation_conformer_2<Cdt>;
using Points = std::vector<Point>;
template class cgal::Triangulation_conformer_2<Cdt>;

static Big dot(const Place &p, const Place &a, const Place &b) {
    return (a.x - p.x) * (b.x - p.x) + (a.y - p.y) * (b.y - p.y);
}
// Positive if d is inside the circle of a counter-clockwise triangle.
static int in_circle(const Place &a, const Place &b, const Place &c, const Place &d) {
    const auto lift = [&](const Place &p) { return dot(d, p, p); };
    return (lift(a) * cross(d, b, c) + lift(b) * cross(d, c, a) + lift(c) * cross(d, a, b)).sign();
}

// What the conformer answers is so, by the definitions.
static void check_answers(Cdt &cdt) {
    const std::vector<Place> places = places_of(cdt.triangulation().positions());
    const auto at = [&](Cdt::Vertex_handle v) { return places[v->id()]; };
    bool is_Delaunay = true, is_Gabriel = true;
    int n_edges = 0;
    for (const auto &[f, i] : cdt.constrained_edges()) {
        n_edges++;
        const auto a = f->vertex(cdt.cw(i)), b = f->vertex(cdt.ccw(i)), p = f->vertex(i), q = cdt.mirror_vertex(f, i);
        for (const auto v : {p, q}) {
            if (!cdt.is_infinite(v) && dot(at(v), at(a), at(b)).sign() < 0) is_Gabriel = false;
        }
        if (cdt.is_infinite(p) || cdt.is_infinite(q)) continue;
        if (in_circle(at(a), at(p), at(b), at(q)) > 0) is_Delaunay = false;
    }
    const Conformer conformer(cdt);
    CHECK(conformer.is_conforming_Delaunay() == is_Delaunay && conformer.is_conforming_Gabriel() == is_Gabriel);
    CHECK(!is_Gabriel || is_Delaunay);
    CHECK(conformer.number_of_constrained_edges() == n_edges && cdt.is_valid());
}

// A comb in a square with a slit at a small angle to its side, and points in the way; times a factor, off by some
// distance.
static Cdt drawing(double factor = 1, double off = 0) {
    const auto at = [&](double x, double y) { return Point(x * factor + off, y * factor + off); };
    Cdt cdt;
    const Points square{at(0, 0), at(8, 0), at(8, 8), at(0, 8)};
    cdt.insert_constraint(square.begin(), square.end(), true);
    for (int i = 1; i < 8; i++) cdt.insert_constraint(at(i, 1 + 0.125 * i), at(i, 6));
    cdt.insert_constraint(at(0, 0), at(7.5, 0.25));
    for (int i = 1; i < 8; i++) cdt.insert(at(i - 0.0625, 4 - 0.25 * i));
    return cdt;
}

static void make(Cdt &cdt, bool is_Gabriel) {
    if (is_Gabriel) cgal::make_conforming_Gabriel_2(cdt);
    else cgal::make_conforming_Delaunay_2(cdt);
}

static void at_any_scale() {
    for (const auto &[factor, off] : {std::pair{1.0, 0.0}, {std::ldexp(1, -60), 0.0}, {1.0, std::ldexp(1, 20)}}) {
        std::size_t n_before = drawing(factor, off).number_of_vertices(), n_of_first = n_before;
        for (const bool is_Gabriel : {false, true}) {
            Cdt cdt = drawing(factor, off);
            check_answers(cdt);
            make(cdt, is_Gabriel);
            check_answers(cdt);
            Conformer conformer(cdt);
            CHECK(is_Gabriel ? conformer.is_conforming_Gabriel() : conformer.is_conforming_Delaunay());
            // Gabriel takes more vertices, and again nothing is done.
            const std::size_t n = cdt.number_of_vertices();
            CHECK(n > n_of_first && n < 40 * n_before);
            n_of_first = n;
            make(cdt, is_Gabriel);
            CHECK(cdt.number_of_vertices() == n);
            // A Gabriel one is Delaunay already; the other way round more is divided.
            make(cdt, !is_Gabriel);
            CHECK((cdt.number_of_vertices() == n) == is_Gabriel && conformer.is_conforming_Gabriel());
            check_answers(cdt);
        }
    }
}

static void steps() {
    for (const bool is_Gabriel : {false, true}) {
        Cdt cdt = drawing();
        Conformer conformer(cdt);
        CHECK(conformer.is_conforming_done());
        if (is_Gabriel) conformer.init_Gabriel();
        else conformer.init_Delaunay();
        std::size_t n = cdt.number_of_vertices();
        for (bool other = false; !conformer.is_conforming_done(); other = !other) {
            bool has_inserted = false;
            if (is_Gabriel && other) has_inserted = conformer.try_one_step_conforming_Gabriel();
            if (is_Gabriel && !other) has_inserted = conformer.step_by_step_conforming_Gabriel();
            if (!is_Gabriel && other) has_inserted = conformer.try_one_step_conforming_Delaunay();
            if (!is_Gabriel && !other) has_inserted = conformer.step_by_step_conforming_Delaunay();
            CHECK(has_inserted && cdt.number_of_vertices() == ++n);
        }
        CHECK(!conformer.step_by_step_conforming_Delaunay());
        CHECK(!is_Gabriel || !conformer.step_by_step_conforming_Gabriel());
        check_answers(cdt);
    }
}

// Vertices stay with their infos, moves that are staged wait, constraints are known by their edges, and a copy is
// independent.
static void handles_and_moves() {
    for (const bool is_Gabriel : {false, true}) {
        Cdt cdt = drawing();
        cdt.remove(cdt.insert(Point(3.5, 7)));
        std::vector<std::pair<Cdt::Vertex_handle, Point>> before;
        for (const auto v : cdt.finite_vertex_handles()) {
            v->info() = 100 + static_cast<int>(before.size());
            before.emplace_back(v, v->point());
        }
        const auto moved = cdt.nearest_vertex(Point(4, 3));
        cdt.stage_move(moved, Point(4.25, 7));
        Cdt copy = cdt;
        make(cdt, is_Gabriel);
        CHECK(copy.number_of_vertices() == before.size() && cdt.triangulation().staged_count() == 1);
        for (std::size_t i = 0; i < before.size(); i++) {
            const auto &[v, p] = before[i];
            CHECK(v->point() == p && v->info() == 100 + static_cast<int>(i) && cdt.is_vertex(v));
        }
        std::size_t n_new = 0;
        for (const auto v : cdt.finite_vertex_handles()) {
            const auto x = cdt.triangulation().position<2>(v->id());
            CHECK(v->point() == Point(x[0], x[1]));
            n_new += v->info() == 0;
        }
        CHECK(n_new > 0 && n_new + before.size() == cdt.number_of_vertices());
        cdt.commit_timestamp();
        CHECK(moved->point() == Point(4.25, 7));
        check_answers(cdt);
        make(cdt, is_Gabriel);
        check_answers(cdt);
        const auto [f, i] = *cdt.constrained_edges_begin();
        const auto a = f->vertex(cdt.ccw(i)), b = f->vertex(cdt.cw(i));
        const int n = Conformer(cdt).number_of_constrained_edges();
        cdt.remove_constrained_edge(f, i);
        CHECK(Conformer(cdt).number_of_constrained_edges() == n - 1);
        cdt.insert_constraint(a, b);
        CHECK(Conformer(cdt).number_of_constrained_edges() == n);
        make(copy, is_Gabriel);
        check_answers(copy);
        cgal::refine_Delaunay_mesh_2(cdt);
        CHECK(cdt.is_valid());
    }
}

static void few_vertices() {
    for (const bool is_Gabriel : {false, true}) {
        Cdt cdt;
        make(cdt, is_Gabriel);
        cdt.insert_constraint(Point(0, 0), Point(2, 2));
        cdt.insert(Point(1, 1));
        make(cdt, is_Gabriel);
        CHECK(cdt.number_of_vertices() == 3 && Conformer(cdt).is_conforming_Delaunay());
        CHECK(Conformer(cdt).is_conforming_Gabriel());
        // A corner on the circle around an edge, and one a last place nearer.
        cdt.insert(Point(0, 1));
        make(cdt, is_Gabriel);
        CHECK(cdt.number_of_vertices() == 4);
        cdt.insert(Point(std::nextafter(1.0, 2.0), 2));
        make(cdt, is_Gabriel);
        check_answers(cdt);
    }
}

// An info that can be made so often.
struct Counted {
    static inline int n_left = std::numeric_limits<int>::max();
    Counted() {
        if (n_left-- <= 0) throw std::runtime_error("no more");
    }
};

static void an_info_that_throws() {
    using Counting = cgal::Constrained_Delaunay_triangulation_2<K, Counted>;
    Counting cdt;
    const Points sides{{0, 0}, {8, 0}, {8, 1}, {0, 1}};
    cdt.insert_constraint(sides.begin(), sides.end(), true);
    cdt.insert_constraint(Point(1, 0.5), Point(7, 0.75));
    for (const int limit : {0, 1, 3}) {
        Counted::n_left = limit;
        bool has_thrown = false;
        try {
            cgal::make_conforming_Gabriel_2(cdt);
        } catch (const std::runtime_error &) {
            has_thrown = true;
        }
        Counted::n_left = std::numeric_limits<int>::max();
        CHECK(has_thrown && cdt.number_of_vertices() == 6 && cdt.triangulation().id_count() == 6 && cdt.is_valid());
        CHECK(cdt.triangulation().segments().size() == 5);
    }
    cgal::make_conforming_Gabriel_2(cdt);
    CHECK(cgal::Triangulation_conformer_2<Counting>(cdt).is_conforming_Gabriel());
}

int main() {
    at_any_scale();
    steps();
    handles_and_moves();
    few_vertices();
    an_info_that_throws();
}
