// A program with constrained triangulations in the manner of CGAL's examples. With WITH_CGAL it uses CGAL; without it
// deldrift/cgal.hpp, with CGAL_KERNEL on CGAL's own points and data structures. It has to write the same. Positions are in
// general position, so that the cells are unique; what has no order is sorted.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <list>
#include <map>
#include <random>
#include <utility>
#include <vector>

#ifdef WITH_CGAL
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
namespace library = CGAL;
#else
#include <deldrift/cgal.hpp>
namespace library = deldrift::cgal;
#endif

#if defined(WITH_CGAL) || defined(CGAL_KERNEL)
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vb = CGAL::Triangulation_vertex_base_with_info_2<unsigned, K>;
using Fb = CGAL::Constrained_triangulation_face_base_2<K, CGAL::Triangulation_face_base_with_info_2<int, K>>;
using Data = CGAL::Triangulation_data_structure_2<Vb, Fb>;
#else
using K = library::Kernel;
using Data = library::Infos<unsigned, int>;
#endif

using Cdt = library::Constrained_Delaunay_triangulation_2<K, Data>;
using Rounding = library::Constrained_Delaunay_triangulation_2<K, Data, library::Exact_predicates_tag>;
using Point = K::Point_2;
using Vertices = std::vector<Cdt::Vertex_handle>;

static std::mt19937_64 engine(11);

// Of so few bits that the middle of two is exact.
static double anywhere() { return static_cast<double>(engine() >> 34) / 1073741824.0; }

static Point random_point() {
    const double x = anywhere();
    return Point(x, anywhere());
}

static Point middle(const Point &a, const Point &b) { return Point((a.x() + b.x()) / 2, (a.y() + b.y()) / 2); }

template <class Rows>
static void show(const char *what, Rows rows) {
    std::sort(rows.begin(), rows.end());
    std::printf("%s: %zu\n", what, rows.size());
    for (const auto &row : rows) {
        for (unsigned x : row) std::printf("%u ", x);
        std::printf("\n");
    }
}

#ifndef WITH_CGAL
template <class Face>
struct Map_of {
    std::map<Face, bool> *values;
    friend void put(const Map_of &map, Face f, bool value) { (*map.values)[f] = value; }
};
#endif

// What a program does that marks domains by itself: the level is in the info of faces.
template <class T>
static void mark(const T &t) {
    using Face = typename T::Face_handle;
    for (Face f : t.all_face_handles()) f->info() = -1;
    std::list<std::pair<Face, int>> next{{t.infinite_face(), 0}};
    while (!next.empty()) {
        const auto [start, level] = next.front();
        next.pop_front();
        std::list<Face> queue{start};
        while (!queue.empty()) {
            const Face f = queue.front();
            queue.pop_front();
            if (f->info() != -1) continue;
            f->info() = level;
            for (int i = 0; i < 3; i++) {
                const Face g = f->neighbor(i);
                if (g->info() != -1) continue;
                if (t.is_constrained(typename T::Edge(f, i))) {
                    next.emplace_back(g, level + 1);
                } else {
                    queue.push_back(g);
                }
            }
        }
    }
#ifndef WITH_CGAL
    const std::vector<std::uint32_t> levels = t.nesting_levels();
    std::map<Face, bool> is_in_domain;
    library::mark_domain_in_triangulation(t, Map_of<Face>{&is_in_domain});
    for (Face f : t.finite_face_handles()) {
        if (static_cast<int>(levels[f->id()]) != f->info()) std::printf("not the nesting level\n");
        if (is_in_domain.at(f) != (f->info() % 2 == 1)) std::printf("not in the domain\n");
    }
    if (is_in_domain.at(t.infinite_face())) std::printf("the outside in the domain\n");
#endif
}

template <class T>
static void show_all(const char *what, const T &t) {
    std::printf("== %s: %zu vertices, %zu faces, dimension %d, valid %d\n", what,
                static_cast<std::size_t>(t.number_of_vertices()), static_cast<std::size_t>(t.number_of_faces()),
                t.dimension(), t.is_valid());
    mark(t);
    std::vector<std::array<unsigned, 5>> faces;
    for (typename T::Face_handle f : t.finite_face_handles()) {
        unsigned constrained = 0;
        std::array<unsigned, 3> row{};
        int least = 0;
        for (int i = 1; i < 3; i++) {
            if (f->vertex(i)->info() < f->vertex(least)->info()) least = i;
        }
        for (int k = 0; k < 3; k++) {
            const int i = (least + k) % 3;
            row[static_cast<std::size_t>(k)] = f->vertex(i)->info();
            if (f->is_constrained(i)) constrained |= 1u << k;
            const typename T::Face_handle g = f->neighbor(i);
            if (g->is_constrained(t.mirror_index(f, i)) != f->is_constrained(i)) std::printf("only on one side\n");
        }
        faces.push_back({row[0], row[1], row[2], constrained, static_cast<unsigned>(f->info())});
    }
    show("faces", faces);
    std::vector<std::array<unsigned, 2>> edges;
    for (typename T::Constrained_edges_iterator e = t.constrained_edges_begin(); e != t.constrained_edges_end(); ++e) {
        const auto [f, i] = *e;
        if (!t.is_constrained(*e)) std::printf("not constrained\n");
        const unsigned a = f->vertex(t.cw(i))->info(), b = f->vertex(t.ccw(i))->info();
        edges.push_back({std::min(a, b), std::max(a, b)});
    }
    show("constrained edges", edges);
    std::vector<std::array<unsigned, 3>> ends;
    for (typename T::Vertex_handle v : t.finite_vertex_handles()) {
        std::vector<typename T::Edge> around, again;
        t.incident_constraints(v, std::back_inserter(around));
        const bool is_there = t.are_there_incident_constraints(v, std::back_inserter(again));
        ends.push_back({v->info(), static_cast<unsigned>(around.size()), t.are_there_incident_constraints(v)});
        if (is_there != !around.empty() || again.size() != around.size()) std::printf("not the constraints\n");
    }
    show("ends", ends);
}

// What an insertion would change: constraints end it.
static void show_conflicts(const Cdt &t, double low, double high) {
    for (int i = 0; i < 20; i++) {
        const double x = low + (high - low) * anywhere();
        std::vector<Cdt::Face_handle> faces;
        t.get_conflicts(Point(x, low + (high - low) * anywhere()), std::back_inserter(faces));
        std::vector<std::array<unsigned, 3>> rows;
        for (Cdt::Face_handle f : faces) {
            rows.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
            std::sort(rows.back().begin(), rows.back().end());
        }
        show("in conflict", rows);
    }
}

template <class T>
static typename T::Edge edge_between(const T &t, typename T::Vertex_handle a, typename T::Vertex_handle b) {
    typename T::Face_handle f;
    int i = 0;
    if (!t.is_edge(a, b, f, i)) std::printf("no edge\n");
    return typename T::Edge(f, i);
}

static double side(const Point &a, const Point &b, const Point &p) {
    return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
}

static bool do_cross(const std::pair<Point, Point> &e, const std::pair<Point, Point> &f) {
    return side(e.first, e.second, f.first) * side(e.first, e.second, f.second) < 0 &&
           side(f.first, f.second, e.first) * side(f.first, f.second, e.second) < 0;
}

static std::vector<std::pair<Point, Point>> segments_that_do_not_cross(std::size_t n, double length) {
    std::vector<std::pair<Point, Point>> segments;
    while (segments.size() < n) {
        const Point a = random_point();
        const double x = a.x() + length * (anywhere() - 0.5);
        const std::pair<Point, Point> s(a, Point(x, a.y() + length * (anywhere() - 0.5)));
        if (std::none_of(segments.begin(), segments.end(), [&](const auto &other) { return do_cross(s, other); })) {
            segments.push_back(s);
        }
    }
    return segments;
}

// Infos in the order of places, for vertices that the triangulation has made.
template <class T>
static void number(T &t) {
    // Crossings are rounded in different ways.
    const auto rounded = [](double x) { return std::lround(1e9 * x); };
    std::map<std::pair<long, long>, typename T::Vertex_handle> by_place;
    for (typename T::Vertex_handle v : t.finite_vertex_handles()) {
        by_place[{rounded(v->point().x()), rounded(v->point().y())}] = v;
    }
    unsigned next = 0;
    for (auto &[place, v] : by_place) v->info() = next++;
    t.infinite_vertex()->info() = 9999;
}

static void sticks() {
    std::vector<std::pair<Point, unsigned>> points;
    for (unsigned i = 0; i < 200; i++) points.emplace_back(random_point(), i);
    Cdt t;
    t.insert(points.begin(), points.end());
    const std::vector<std::pair<Point, Point>> segments = segments_that_do_not_cross(60, 0.4);
    for (std::size_t i = 0; i < 20; i++) t.insert_constraint(segments[i].first, segments[i].second);
    for (std::size_t i = 20; i < 30; i++) {
        const Cdt::Vertex_handle a = t.insert(segments[i].first), b = t.insert(segments[i].second);
        t.insert_constraint(a, b);
        t.insert_constraint(b, a);
    }
    std::printf("%ld more\n", static_cast<long>(t.insert_constraints(segments.begin() + 30, segments.begin() + 45)));
    std::vector<Point> ends;
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 45; i < 60; i++) {
        pairs.emplace_back(ends.size(), ends.size() + 1);
        ends.push_back(segments[i].first);
        ends.push_back(segments[i].second);
    }
    t.insert_constraints(ends.begin(), ends.end(), pairs.begin(), pairs.end());
    number(t);
    show_all("sticks", t);
    show_conflicts(t, -0.2, 1.2);

    // Vertices on constraints divide them.
    for (std::size_t i = 0; i < 10; i++) t.insert(middle(segments[i].first, segments[i].second));
    t.insert(middle(segments[20].first, middle(segments[20].first, segments[20].second)));
    number(t);
    show_all("divided", t);

    Cdt copy(t);
    for (std::size_t i = 0; i < 12; i++) {
        const Cdt::Vertex_handle a = copy.insert(segments[i].first), b = copy.insert(segments[i].second);
        if (i % 3 == 0) copy.remove_incident_constraints(a);
        if (i >= 10) {
            const Cdt::Edge e = edge_between(copy, a, b);
            copy.remove_constrained_edge(e.first, e.second);
            copy.remove(a);
        }
    }
    number(copy);
    show_all("removed", copy);
    number(t);
    show_all("copied from", t);

    // One that crosses others is refused.
    Cdt::Vertex_handle a = copy.insert(Point(-1, 0.5)), b = copy.insert(Point(2, 0.75));
    try {
        copy.insert_constraint(a, b);
        std::printf("not refused\n");
    } catch (const Cdt::Intersection_of_constraints_exception &) {
        std::printf("refused\n");
    }
}

// Chains that are closed and nested, with an island, a slit and a T-junction.
static void domains() {
    const auto ring = [](double x, double y, double size, unsigned n) {
        std::vector<Point> points;
        const double steps[][2] = {{0, 0}, {1, 0.03125}, {0.96875, 1}, {-0.0625, 0.9375}};
        for (unsigned i = 0; i < n; i++) {
            points.push_back(Point(x + size * steps[i][0] + anywhere() / 64, y + size * steps[i][1] + anywhere() / 64));
        }
        return points;
    };
    Cdt t;
    const std::vector<Point> outer = ring(0, 0, 8, 4), hole = ring(2, 2, 4, 4), island = ring(3, 3, 2, 4);
    t.insert_constraint(outer.begin(), outer.end(), true);
    t.insert_constraint(hole.begin(), hole.end(), true);
    t.insert_constraint(island.begin(), island.end(), true);
    t.insert_constraint(Point(3.5, 3.75), Point(4.25, 4.5));
    t.insert_constraint(outer[0], hole[0]);
    for (int i = 0; i < 60; i++) {
        const double x = 10 * anywhere() - 1;
        t.insert(Point(x, 10 * anywhere() - 1));
    }
    number(t);
    show_all("domains", t);
    show_conflicts(t, -2, 10);
    // Open chains bound nothing.
    const Cdt::Vertex_handle a = t.insert(island[0]), b = t.insert(island[1]);
    const Cdt::Edge e = edge_between(t, a, b);
    t.remove_constraint(e.first, e.second);
    show_all("opened", t);
}

// A constraint through vertices is as many edges as they make pieces of it, also on a line and along another one.
static void pieces() {
    Cdt t;
    std::vector<Point> line;
    for (int i = 0; i < 8; i++) line.push_back(Point(i, 2 * i));
    t.insert(line.begin(), line.end());
    t.insert_constraint(line[0], line[7]);
    std::printf("on a line: %d\n", t.are_there_incident_constraints(t.insert(line[3])));
    t.insert(Point(0.25, 5));
    t.insert(Point(6, 1.125));
    t.insert(Point(3.5, 7));
    t.insert_constraint(Point(-1, -2), Point(9, 18));
    t.insert_constraint(Point(2.5, 5), Point(20, 40));
    number(t);
    show_all("pieces", t);
}

// Constraints that cross, of coordinates for which the places are exact.
static void crossings() {
    Rounding t;
    for (int i = 1; i < 6; i++) t.insert_constraint(Point(0, i), Point(6 + i * i, i));
    for (int j = 1; j < 6; j++) t.insert_constraint(Point(j * j, 0), Point(j * j, 6 + j));
    t.insert_constraint(Point(0.5, 0.5), Point(4.5, 4.5));
    number(t);
    std::printf("crossings: %zu vertices, valid %d\n", static_cast<std::size_t>(t.number_of_vertices()), t.is_valid());
    std::vector<std::array<unsigned, 2>> edges;
    for (const Rounding::Edge &e : t.constrained_edges()) {
        const unsigned a = e.first->vertex(t.cw(e.second))->info(), b = e.first->vertex(t.ccw(e.second))->info();
        edges.push_back({std::min(a, b), std::max(a, b)});
    }
    show("constrained edges", edges);
}

int main() {
    sticks();
    domains();
    pieces();
    crossings();
    return 0;
}
