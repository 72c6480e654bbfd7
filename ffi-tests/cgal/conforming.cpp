// Conforming triangulations by CGAL's conformer and, with the same names, by deldrift's. It writes how many vertices
// each inserts, and fails unless deldrift's are conforming by CGAL's own questions, which both answer alike at each
// stage, have the vertices that were there and pieces from end to end of each constraint, do not change when they are
// made again, and are about as small as CGAL's.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_conformer_2.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deldrift/cgal.hpp>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using With_cgal = CGAL::Constrained_Delaunay_triangulation_2<K>;
using With_deldrift = deldrift::cgal::Constrained_Delaunay_triangulation_2<K>;
using Point = K::Point_2;
using Constraints = std::vector<std::pair<Point, Point>>;

struct Input {
    std::string name;
    std::vector<Point> points;
    Constraints constraints;
};

static void require(bool holds, const std::string &what) {
    if (holds) return;
    std::fprintf(stderr, "%s\n", what.c_str());
    std::exit(1);
}

static bool do_meet(const std::pair<Point, Point> &a, const std::pair<Point, Point> &b) {
    const bool share = a.first == b.first || a.first == b.second || a.second == b.first || a.second == b.second;
    if (!share) return CGAL::do_intersect(K::Segment_2(a.first, a.second), K::Segment_2(b.first, b.second));
    return CGAL::collinear(a.first, a.second, b.first) && CGAL::collinear(a.first, a.second, b.second);
}

// Some points, and segments between them that neither cross nor touch.
static Input scattered(unsigned seed, int n_points, int n_tries, bool on_grid) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> anywhere(-4, 4);
    const auto coordinate = [&] { return on_grid ? std::round(anywhere(engine)) : anywhere(engine); };
    Input input{(on_grid ? "grid " : "scattered ") + std::to_string(seed), {}, {}};
    for (int i = 0; i < n_points; i++) {
        const double x = coordinate();
        input.points.emplace_back(x, coordinate());
    }
    for (int i = 0; i < n_tries; i++) {
        const std::pair<Point, Point> one(input.points[engine() % input.points.size()],
                                          input.points[engine() % input.points.size()]);
        bool is_free = one.first != one.second;
        for (const auto &other : input.constraints) is_free = is_free && !do_meet(one, other);
        for (const Point &p : input.points) {
            is_free = is_free && (p == one.first || p == one.second || !K::Segment_2(one.first, one.second).has_on(p));
        }
        if (is_free) input.constraints.push_back(one);
    }
    return input;
}

static std::vector<Input> inputs() {
    std::vector<Input> all;
    for (unsigned seed = 0; seed < 40; seed++) all.push_back(scattered(seed, 30, 60, seed % 2 == 1));
    for (unsigned seed = 40; seed < 44; seed++) all.push_back(scattered(seed, 400, 800, false));
    // Ends at an apex, at angles down to half a degree, and points beside them.
    for (const int n : {3, 12, 90, 720}) {
        Input fan{"fan " + std::to_string(n), {}, {}};
        for (int i = 0; i < 3; i++) {
            const double turn = 2 * std::acos(-1.0) * i / n;
            const double length = 3 + 0.3 * i;
            fan.constraints.emplace_back(Point(0, 0), Point(length * std::cos(turn), length * std::sin(turn)));
        }
        fan.points = {Point(1, -0.01), Point(-1, -1)};
        all.push_back(fan);
    }
    all.push_back({"comb", {}, {}});
    for (int i = 0; i < 40; i++) all.back().constraints.emplace_back(Point(i * 0.01, 0), Point(i * 0.01, 1));
    all.push_back({"hull", {Point(2, 0.01), Point(2, 3.5)}, {{Point(0, 0), Point(4, 0)}, {Point(4, 0), Point(4, 4)}}});
    all.push_back({"square", {}, {{Point(0, 0), Point(1, 1)}, {Point(0, 1), Point(0, 0)}, {Point(1, 0), Point(1, 1)}}});
    all.push_back({"none", {Point(0, 0), Point(3, 1), Point(1, 2), Point(1, 1)}, {}});
    return all;
}

template <class Cdt>
static Cdt triangulation_of(const Input &input) {
    Cdt cdt;
    cdt.insert(input.points.begin(), input.points.end());
    for (const auto &[p, q] : input.constraints) cdt.insert_constraint(p, q);
    return cdt;
}

// CGAL's triangulation of the vertices and constraints of deldrift's.
static With_cgal as_with_cgal(const With_deldrift &ours) {
    With_cgal cdt;
    for (const auto v : ours.finite_vertex_handles()) cdt.insert(v->point());
    for (const auto &[f, i] : ours.constrained_edges()) {
        cdt.insert_constraint(f->vertex(ours.cw(i))->point(), f->vertex(ours.ccw(i))->point());
    }
    return cdt;
}

// The pieces from end to end, off the constraint by some last places at most.
static void check_pieces(const With_deldrift &ours, const Input &input) {
    std::map<Point, std::vector<Point>> beside;
    for (const auto &[f, i] : ours.constrained_edges()) {
        const Point p = f->vertex(ours.cw(i))->point(), q = f->vertex(ours.ccw(i))->point();
        beside[p].push_back(q);
        beside[q].push_back(p);
    }
    for (const auto &[p, q] : input.constraints) {
        Point at = p;
        while (at != q) {
            Point next = at;
            double least = 1e-13;
            for (const Point &r : beside[at]) {
                const double off = std::fabs(K::Segment_2(p, q).supporting_line().a() * (r.x() - p.x()) +
                                             K::Segment_2(p, q).supporting_line().b() * (r.y() - p.y()));
                const bool is_on = CGAL::squared_distance(r, q) < CGAL::squared_distance(at, q) && off < least;
                if (is_on) next = r;
            }
            require(next != at, input.name + ": a constraint has a gap");
            at = next;
        }
    }
    for (const Point &p : input.points) require(ours.is_vertex(ours.nearest_vertex(p)), "a vertex is missing");
}

using Conformer = deldrift::cgal::Triangulation_conformer_2<With_deldrift>;
using Their_conformer = CGAL::Triangulation_conformer_2<With_cgal>;

// What CGAL's conformer answers, but that a corner on a circle is not inside it: for CGAL the diagonal of a square is
// neither.
static bool is_conforming(const With_cgal &cdt, bool is_Gabriel) {
    for (auto e = cdt.finite_edges_begin(); e != cdt.finite_edges_end(); ++e) {
        const auto [f, i] = *e;
        if (!cdt.is_constrained(*e)) continue;
        const auto p = f->vertex(i), q = cdt.mirror_vertex(f, i);
        const Point &a = f->vertex(cdt.cw(i))->point(), &b = f->vertex(cdt.ccw(i))->point();
        for (const auto &v : {p, q}) {
            if (is_Gabriel && !cdt.is_infinite(v) && CGAL::angle(a, v->point(), b) == CGAL::OBTUSE) return false;
        }
        if (is_Gabriel || cdt.is_infinite(p) || cdt.is_infinite(q)) continue;
        if (CGAL::side_of_oriented_circle(a, p->point(), b, q->point()) == CGAL::ON_POSITIVE_SIDE) return false;
    }
    return true;
}

static void check_questions(With_deldrift &ours, const std::string &name) {
    With_cgal same = as_with_cgal(ours);
    Conformer asked(ours);
    Their_conformer theirs(same);
    require(asked.is_conforming_Delaunay() == is_conforming(same, false), name + ": another answer, Delaunay");
    require(asked.is_conforming_Gabriel() == is_conforming(same, true), name + ": another answer, Gabriel");
    require(asked.is_conforming_Delaunay() || !theirs.is_conforming_Delaunay(), name + ": less than CGAL, Delaunay");
    require(asked.is_conforming_Gabriel() || !theirs.is_conforming_Gabriel(), name + ": less than CGAL, Gabriel");
}

static std::size_t inserted(const Input &input, bool is_Gabriel) {
    With_deldrift ours = triangulation_of<With_deldrift>(input);
    const std::size_t before = ours.number_of_vertices();
    check_questions(ours, input.name);
    if (is_Gabriel) deldrift::cgal::make_conforming_Gabriel_2(ours);
    else deldrift::cgal::make_conforming_Delaunay_2(ours);
    check_questions(ours, input.name);
    Conformer conformer(ours);
    require(is_Gabriel ? conformer.is_conforming_Gabriel() : conformer.is_conforming_Delaunay(),
            input.name + ": not conforming");
    require(ours.is_valid(), input.name + ": not valid");
    check_pieces(ours, input);
    const std::size_t after = ours.number_of_vertices();
    if (is_Gabriel) conformer.make_conforming_Gabriel();
    else conformer.make_conforming_Delaunay();
    require(conformer.is_conforming_done() && ours.number_of_vertices() == after, input.name + ": not at rest");
    // By steps it is conforming as well.
    if (before < 100) {
        With_deldrift stepped = triangulation_of<With_deldrift>(input);
        Conformer steps(stepped);
        if (is_Gabriel) steps.init_Gabriel();
        else steps.init_Delaunay();
        std::size_t n = 0;
        while (!steps.is_conforming_done()) {
            require(is_Gabriel ? steps.step_by_step_conforming_Gabriel() : steps.step_by_step_conforming_Delaunay(),
                    input.name + ": a step does nothing");
            n++;
        }
        require(stepped.number_of_vertices() == before + n, input.name + ": a step is not one vertex");
        require(!(is_Gabriel ? steps.try_one_step_conforming_Gabriel() : steps.try_one_step_conforming_Delaunay()),
                input.name + ": a step too many");
        check_questions(stepped, input.name);
        require(is_Gabriel ? steps.is_conforming_Gabriel() : steps.is_conforming_Delaunay(), "steps do not conform");
        With_cgal same = as_with_cgal(stepped);
        require(Their_conformer(same).number_of_constrained_edges() == steps.number_of_constrained_edges(),
                input.name + ": other edges");
        check_pieces(stepped, input);
    }
    return after - before;
}

int main() {
    for (const bool is_Gabriel : {false, true}) {
        std::size_t n_ours = 0, n_theirs = 0;
        for (const Input &input : inputs()) {
            With_cgal cdt = triangulation_of<With_cgal>(input);
            const std::size_t before = cdt.number_of_vertices();
            if (is_Gabriel) CGAL::make_conforming_Gabriel_2(cdt);
            else CGAL::make_conforming_Delaunay_2(cdt);
            const std::size_t theirs = cdt.number_of_vertices() - before, ours = inserted(input, is_Gabriel);
            const char *kind = is_Gabriel ? "Gabriel" : "Delaunay";
            std::printf("%s, %s: %zu vertices, CGAL %zu\n", input.name.c_str(), kind, ours, theirs);
            n_ours += ours;
            n_theirs += theirs;
        }
        std::printf("all, %s: %zu vertices, CGAL %zu\n", is_Gabriel ? "Gabriel" : "Delaunay", n_ours, n_theirs);
        require(10 * n_ours <= 11 * n_theirs, "many more vertices than with CGAL");
    }
}
