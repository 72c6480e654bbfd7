// deldrift/cgal.hpp, where it does more than CGAL, and where calls fail. ffi-tests/cgal compares it with CGAL.
#include "check.hpp"

#include <algorithm>
#include <cmath>
#include <deldrift/cgal.hpp>
#include <iterator>
#include <random>
#include <set>
#include <thread>
#include <unordered_map>
#include <unordered_set>
#include <vector>

using K = deldrift::cgal::Kernel;
using deldrift::cgal::Point_2;
using deldrift::cgal::Point_3;
using Dt2 = deldrift::cgal::Delaunay_triangulation_2<K, int>;
using Dt3 = deldrift::cgal::Delaunay_triangulation_3<K>;

static std::mt19937_64 engine(3);

static double anywhere() { return std::uniform_real_distribution<double>(-1, 1)(engine); }

static std::vector<std::pair<Point_2, int>> random_points(int count) {
    std::vector<std::pair<Point_2, int>> points;
    for (int i = 0; i < count; i++) points.emplace_back(Point_2(anywhere(), anywhere()), i);
    return points;
}

// Sets of infos.
template <class Dt>
static std::vector<std::vector<int>> faces_of(const Dt &t) {
    std::vector<std::vector<int>> faces;
    for (typename Dt::Face_handle f : t.finite_face_handles()) {
        faces.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
        std::sort(faces.back().begin(), faces.back().end());
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

static void vertices_move_together() {
    auto points = random_points(200);
    Dt2 t(points.begin(), points.end());
    CHECK(t.take_changes().created_count == t.number_of_faces());
    std::vector<Dt2::Vertex_handle> handles(points.size());
    for (Dt2::Vertex_handle v : t.finite_vertex_handles()) handles[static_cast<std::size_t>(v->info())] = v;
    for (auto &[p, i] : points) {
        p = Point_2(p.x() + 0.01 * anywhere(), p.y() + 0.01 * anywhere());
        t.stage_move(handles[static_cast<std::size_t>(i)], p);
    }
    CHECK(handles[3]->point() != points[3].first && t.triangulation().staged_count() == 200);
    CHECK_THROWS(t.stage_move(handles[3], Point_2(0, 0)), DELDRIFT_DUPLICATE_MOVE, "vertex[0] is");
    CHECK(t.commit_timestamp().moved == 200 && t.take_changes().created_count > 0);
    CHECK(handles[3]->point() == points[3].first && t.is_valid());
    CHECK(faces_of(t) == faces_of(Dt2(points.begin(), points.end())));

    // Two at the same place: the commit has no effect.
    t.stage_move(handles[4], points[5].first);
    CHECK_THROWS(t.commit_timestamp(), DELDRIFT_COINCIDENT, "vert");
    CHECK(handles[4]->point() == points[4].first);
    t.discard_moves();
    // A vertex that is removed takes its move along, one that is inserted leaves the moves of others.
    t.stage_move(handles[6], Point_2(0.5, 0.5));
    t.stage_move(handles[7], Point_2(0.25, 0.5));
    t.remove(handles[6]);
    const std::vector<Point_2> two{Point_2(3, 3), Point_2(4, 4)};
    CHECK(t.insert(two.begin(), two.end()) == 2);
    t.commit_timestamp();
    CHECK(handles[7]->point() == Point_2(0.25, 0.5) && t.number_of_vertices() == 201 && t.is_valid());
}

static void one_vertex_for_each_place() {
    auto points = random_points(50);
    for (int i = 0; i < 50; i++) points.emplace_back(points[static_cast<std::size_t>(i % 7)].first, 100 + i);
    Dt2 t(points.begin(), points.end());
    CHECK(t.number_of_vertices() == 50 && t.is_valid());
    for (Dt2::Vertex_handle v : t.finite_vertex_handles()) CHECK(v->info() < 50);
    auto more = random_points(20);
    more.push_back(more[2]);
    more.push_back(points[1]);
    CHECK(t.insert(more.begin(), more.end()) == 20 && t.number_of_vertices() == 70);
    CHECK(t.insert(more.begin(), more.end()) == 0 && t.is_valid());
    Dt2::Vertex_handle v = t.insert(points[9].first), w;
    CHECK(v->info() == 9 && t.is_vertex(points[9].first, w) && v == w && !t.is_vertex(Point_2(7, 7), w));
    const Point_2 zero(0.0, -0.0), other_zero(-0.0, 0.0);
    CHECK(t.insert(zero) == t.insert(other_zero));
}

// Handles of vertices survive whatever happens to others, and memory does not grow.
static void handles_last() {
    auto points = random_points(60);
    Dt2 t(points.begin(), points.end());
    std::vector<Dt2::Vertex_handle> handles;
    for (Dt2::Vertex_handle v : t.finite_vertex_handles()) handles.push_back(v);
    std::vector<Dt2::Vertex_handle> passing;
    std::size_t bytes = 0;
    for (int round = 0; round < 6000; round++) {
        passing.push_back(t.insert(Point_2(anywhere(), anywhere())));
        passing.back()->info() = 1000 + round;
        if (passing.size() <= 40) continue;
        t.remove(passing.front());
        passing.erase(passing.begin());
        if (round == 2900) bytes = t.triangulation().memory_bytes();
    }
    CHECK(t.triangulation().memory_bytes() < 2 * bytes && t.triangulation().id_count() < 2000);
    for (const auto &[p, i] : points) {
        const Dt2::Vertex_handle v = handles[static_cast<std::size_t>(i)];
        CHECK(v->point() == p && v->info() == i && t.nearest_vertex(p) == v);
        CHECK(t.triangulation().position<2>(v->id())[0] == p.x() && t.triangulation().is_present(v.id()));
    }
    CHECK(t.remove(passing.begin(), passing.end()) == 40 && faces_of(t) == faces_of(Dt2(points.begin(), points.end())));
    CHECK(t.is_valid() && std::count(t.points_begin(), t.points_end(), points[8].first) == 1);
}

static void copies_are_independent() {
    auto points = random_points(30);
    Dt2 a(points.begin(), points.end());
    a.remove(*a.finite_vertices_begin());
    Dt2 b = a;
    CHECK(faces_of(a) == faces_of(b) && b.number_of_vertices() == 29);
    b.clear();
    CHECK(b.number_of_vertices() == 0 && a.number_of_vertices() == 29 && b.dimension() == -1);
    b = std::move(a);
    CHECK(b.number_of_vertices() == 29 && b.is_valid());
    Dt2 c;
    c = b;
    c.swap(b);
    const Dt2::Vertex_handle v = *b.finite_vertices_begin();
    Dt2 d = std::move(b);
    CHECK(d.nearest_vertex(v->point()) == v && v->face()->has_vertex(v));
}

// Nothing is triangulated: cells keep their indices, and the counts go on. Ids, infos and staged moves are there.
static void copies_are_as_the_original() {
    auto points = random_points(50);
    Dt2 a(points.begin(), points.end());
    a.remove(*std::next(a.finite_vertices_begin(), 7));
    const Dt2::Vertex_handle v = *std::next(a.finite_vertices_begin(), 11);
    a.stage_move(v, Point_2(0.125, 0.125));
    a.commit_timestamp();
    a.stage_move(v, Point_2(0.25, 0.5));
    Dt2 b(a);
    CHECK(b.triangulation().timestamp() == 1 && b.triangulation().staged_count() == 1);
    const auto cells = a.triangulation().cells().vertices(), others = b.triangulation().cells().vertices();
    CHECK(std::equal(cells.begin(), cells.end(), others.begin(), others.end()));
    std::vector<Dt2::Vertex_handle> copies(b.finite_vertices_begin(), b.finite_vertices_end());
    CHECK(copies.size() == 49);
    for (Dt2::Vertex_handle w : a.finite_vertex_handles()) {
        const Dt2::Vertex_handle copy = b.nearest_vertex(w->point());
        CHECK(copy != w && copy->id() == w->id() && copy->info() == w->info() && copy->point() == w->point());
    }
    const Dt2::Vertex_handle moved = b.nearest_vertex(v->point());
    b.commit_timestamp();
    CHECK(moved->point() == Point_2(0.25, 0.5) && v->point() == Point_2(0.125, 0.125) && b.is_valid());
    moved->info() = -1;
    CHECK(v->info() != -1 && a.triangulation().staged_count() == 1);
    a.commit_timestamp();
    CHECK(v->point() == moved->point() && faces_of(a).size() == faces_of(b).size());
    for (int i = 0; i < 60; i++) b.remove(b.insert(Point_2(anywhere(), anywhere())));
    CHECK(b.number_of_vertices() == 49 && b.is_valid() && a.number_of_vertices() == 49 && a.is_valid());
}

static void flat_sets() {
    Dt2 t;
    CHECK(t.dimension() == -1 && t.number_of_edges() == 0 && t.finite_faces_begin() == t.finite_faces_end());
    CHECK(t.nearest_vertex(Point_2(0, 0)) == nullptr && t.infinite_face() == nullptr);
    const Dt2::Vertex_handle a = t.insert(Point_2(0, 0));
    CHECK(t.dimension() == 0 && a->face() == nullptr && t.incident_faces(a) == nullptr && t.degree(a) == 0);
    t.insert(Point_2(1, 1));
    t.insert(Point_2(3, 3));
    CHECK(t.dimension() == 1 && t.number_of_edges() == 2 && t.number_of_faces() == 0);
    Dt2::Locate_type lt;
    int li = 0, lj = 0;
    CHECK(t.locate(Point_2(2, 2), lt, li) == nullptr && lt == Dt2::OUTSIDE_AFFINE_HULL);
    CHECK(t.locate(Point_2(1, 1), lt, li) == nullptr && lt == Dt2::VERTEX);
    t.insert(Point_2(2, 0));
    CHECK(t.dimension() == 2 && t.number_of_edges() == 5);
    CHECK(t.locate(Point_2(2, 2), lt, li) != nullptr && lt == Dt2::EDGE);
    CHECK(t.is_infinite(t.locate(Point_2(-1, 0))));

    Dt3 s;
    for (double x : {0.0, 1.0, 2.0}) s.insert(Point_3(x, x, 2 * x));
    CHECK(s.dimension() == 1);
    s.insert(Point_3(1, 0, 1));
    CHECK(s.dimension() == 2 && s.number_of_finite_edges() == 0 && s.number_of_cells() == 0);
    Dt3::Locate_type where;
    CHECK(s.locate(Point_3(1, 0, 1), where, li, lj) == nullptr && where == Dt3::VERTEX);
    s.insert(Point_3(0, 0, 5));
    CHECK(s.dimension() == 3 && s.infinite_cell()->has_vertex(s.infinite_vertex()) && s.is_valid());
}

// Of ghost cells and of finite ones.
static void neighbours_are_mutual() {
    std::vector<Point_3> points;
    // On a grid, where ties are broken, and facets of the hull lie in common planes.
    for (int i = 0; i < 64; i++) points.emplace_back(i % 4, i / 4 % 4, i / 16);
    const Dt3 t(points.begin(), points.end());
    std::size_t n_infinite = 0;
    for (Dt3::Cell_handle c : t.all_cell_handles()) {
        n_infinite += t.is_infinite(c);
        for (int i = 0; i < 4; i++) {
            const Dt3::Cell_handle other = c->neighbor(i);
            const int k = t.mirror_index(c, i);
            CHECK(other->neighbor(k) == c && other->index(c) == k && c->has_neighbor(other));
            CHECK(!c->has_vertex(other->vertex(k)));
            CHECK(t.mirror_vertex(c, i) == other->vertex(k) && t.mirror_facet({c, i}) == Dt3::Facet(other, k));
            for (int m = 0; m < 4; m++) CHECK(m == i || other->has_vertex(c->vertex(m)));
            CHECK(t.is_infinite(Dt3::Facet(c, i)) == (t.is_infinite(c) && !t.is_infinite(c->vertex(i))));
        }
    }
    CHECK(n_infinite == 9 * 6 * 2 && t.number_of_cells() == n_infinite + t.finite_cell_handles().size());
    // Around each edge, in either direction.
    for (Dt3::Finite_edges_iterator e = t.finite_edges_begin(); e != t.finite_edges_end(); ++e) {
        CHECK(!t.is_infinite(*e));
        Dt3::Cell_circulator c = t.incident_cells(*e), last = c;
        std::vector<Dt3::Cell_handle> forth, back;
        do forth.push_back(c);
        while (++c != last);
        do back.push_back(c--);
        while (c != last);
        std::reverse(back.begin() + 1, back.end());
        CHECK(forth == back && last != nullptr);
        Dt3::Facet_circulator f = t.incident_facets(*e);
        CHECK((f++)->first == forth[0] && f->first == forth[1] && (*--f).first == forth[0]);
        CHECK((f--)->first == forth[0] && f->first == forth.back() && f != nullptr && !(f == nullptr));
    }
    const auto length = [](auto first, auto last) { return static_cast<std::size_t>(std::distance(first, last)); };
    CHECK(length(t.finite_edges_begin(), t.finite_edges_end()) == t.number_of_finite_edges());
    CHECK(length(t.finite_facets_begin(), t.finite_facets_end()) == t.number_of_finite_facets());
    CHECK(length(t.finite_cells_begin(), t.finite_cells_end()) == t.number_of_finite_cells());
    CHECK(length(t.all_cells_begin(), t.all_cells_end()) == t.number_of_cells());
    CHECK(t.finite_facets().size() == t.number_of_finite_facets());
    CHECK(t.finite_edges().size() == t.number_of_finite_edges());
    const Dt3::Cell_handle c = *t.finite_cells_begin();
    CHECK(t.point(c, 2) == t.point(c->vertex(2)) && c.id() == 0 && !(c < c) && t.degree(c->vertex(0)) >= 4);
    const Point_3 centre = t.dual(c);
    CHECK(2 * centre.x() == std::round(2 * centre.x()) && centre[2] == centre.z() && Point_3::dimension() == 3);
}

static void circulators_and_sets() {
    auto points = random_points(40);
    const Dt2 t(points.begin(), points.end());
    std::unordered_set<Dt2::Vertex_handle> vertices(t.finite_vertices_begin(), t.finite_vertices_end());
    std::unordered_set<Dt2::Face_handle> faces;
    for (Dt2::All_faces_iterator f = t.all_faces_begin(); f != t.all_faces_end(); f++) faces.insert(f);
    CHECK(vertices.size() == 40 && faces.size() == 2 * (40 - 1) && t.infinite_vertex()->id() == DELDRIFT_NONE);
    std::size_t sum = 0;
    for (Dt2::Vertex_handle v : vertices) {
        sum += t.degree(v);
        Dt2::Face_circulator f = t.incident_faces(v, v->face()), end = f;
        CHECK(!f.is_empty() && *f == v->face() && f++ == end && f-- != end && f == end);
        --f;
        const Dt2::Face_handle before = *f;
        CHECK(before->neighbor(Dt2::ccw(before->index(v))) == *end && f->has_vertex(v));
        Dt2::Edge_circulator e = t.incident_edges(v);
        CHECK(t.mirror_edge(t.mirror_edge(*e)) == *e && t.is_infinite(e->first, e->second) == t.is_infinite(*e));
        CHECK(t.mirror_vertex(e->first, e->second) == t.mirror_edge(*e).first->vertex(t.mirror_edge(*e).second));
        Dt2::Vertex_circulator w = t.incident_vertices(v);
        CHECK(vertices.count(w) + t.is_infinite(*w) == 1);
    }
    // Each edge from either end, without those to the infinite vertex.
    CHECK(sum == 2 * t.number_of_edges() + t.degree(t.infinite_vertex()));
    CHECK(t.finite_edges().size() == t.number_of_edges() && t.finite_face_handles().size() == t.number_of_faces());
    std::size_t n_edges = 0;
    for (Dt2::Finite_edges_iterator e = t.finite_edges_begin(); e != t.finite_edges_end(); e++) {
        CHECK(!t.is_infinite(*e));
        n_edges++;
    }
    CHECK(n_edges == t.number_of_edges());
    const Dt2::Face_handle f = *t.finite_faces_begin();
    CHECK(t.circumcenter(f) == t.dual(f) && *std::prev(t.finite_faces_end()) != f && t.points().size() == 40);
}

// The first to read after a change brings the arrays up to date, whoever that is.
static void threads_read_at_once() {
    auto points = random_points(500);
    Dt2 t(points.begin(), points.end());
    std::vector<std::size_t> sums(4);
    std::vector<std::thread> threads;
    for (std::size_t &sum : sums) {
        threads.emplace_back([&t, &sum] {
            for (Dt2::Face_handle f : t.all_face_handles()) {
                for (int i = 0; i < 3; i++) sum += f->neighbor(i)->index(f) == t.mirror_index(f, i);
            }
        });
    }
    for (std::thread &thread : threads) thread.join();
    for (std::size_t sum : sums) CHECK(sum == 3 * 2 * (500 - 1));

    Dt3 s;
    for (int i = 0; i < 300; i++) s.insert(Point_3(anywhere(), anywhere(), anywhere()));
    std::vector<std::size_t> degrees(4);
    threads.clear();
    for (std::size_t &sum : degrees) {
        threads.emplace_back([&s, &sum] {
            for (Dt3::Vertex_handle v : s.finite_vertex_handles()) sum += s.degree(v);
        });
    }
    for (std::thread &thread : threads) thread.join();
    for (std::size_t sum : degrees) CHECK(sum == degrees[0] && sum > 2 * s.number_of_finite_edges());
}

static void large_stars_are_whole() {
    std::vector<Point_2> wheel{Point_2(0, 0)};
    for (int i = 0; i < 100; i++) wheel.emplace_back(std::cos(0.0625 * i), std::sin(0.0625 * i));
    const Dt2 t(wheel.begin(), wheel.end());
    CHECK(t.degree(t.nearest_vertex(Point_2(0, 0))) == 100);
}

// Stars and links against the edges, before and after changes, asked for one by one and for all.
static void neighbours_follow_changes() {
    std::vector<Point_3> points;
    // Two vertices with many neighbours among others, and all of it twice as far as the ring is wide.
    points.emplace_back(0, 0, -1e-3);
    points.emplace_back(0, 0, 1e-3);
    for (int i = 0; i < 120; i++) points.emplace_back(std::cos(i), std::sin(i), 1e-6 * i);
    for (int i = 0; i < 200; i++) points.emplace_back(4 * anywhere(), 4 * anywhere(), 4 * anywhere());
    Dt3 t(points.begin(), points.end());
    std::size_t greatest = 0;
    for (int round = 0; round < 4; round++) {
        std::unordered_map<Dt3::Vertex_handle, std::set<std::uint32_t>> links;
        std::unordered_map<Dt3::Vertex_handle, std::size_t> n_cells, n_on_hull;
        for (const Dt3::Edge &e : t.finite_edges()) {
            const Dt3::Vertex_handle v = e.first.vertex(e.second), w = e.first.vertex(e.third);
            links[v].insert(w.id());
            links[w].insert(v.id());
        }
        for (Dt3::Cell_handle c : t.all_cell_handles()) {
            for (int i = 0; i < 4; i++) (t.is_infinite(c) ? n_on_hull : n_cells)[c.vertex(i)]++;
        }
        for (Dt3::Vertex_handle v : t.finite_vertex_handles()) {
            std::vector<Dt3::Vertex_handle> link, whole;
            std::vector<Dt3::Cell_handle> star, all;
            t.finite_adjacent_vertices(v, std::back_inserter(link));
            t.adjacent_vertices(v, std::back_inserter(whole));
            std::set<std::uint32_t> ids;
            for (Dt3::Vertex_handle w : link) ids.insert(w.id());
            CHECK(ids == links[v] && ids.size() == link.size());
            const bool is_on_hull = n_on_hull.count(v) > 0;
            CHECK(t.degree(v) == link.size() + is_on_hull && whole.size() == t.degree(v));
            t.finite_incident_cells(v, std::back_inserter(star));
            t.incident_cells(v, std::back_inserter(all));
            CHECK(star.size() == n_cells[v] && all.size() == star.size() + (is_on_hull ? n_on_hull[v] : 0));
            greatest = std::max(greatest, star.size());
        }
        if (round == 1) t.insert(Point_3(anywhere(), anywhere(), anywhere()));
        for (int i = 0; i < 5; i++) {
            const Dt3::Vertex_handle v = *std::next(t.finite_vertices_begin(), 130 + 7 * i + round);
            const Point_3 &p = v->point();
            t.move(v, Point_3(p.y(), p.z(), p.x()));
        }
    }
    CHECK(greatest > 96);
}

static void failures_have_no_effect() {
    auto points = random_points(20);
    Dt2 t(points.begin(), points.end());
    const auto faces = faces_of(t);
    CHECK_THROWS(t.insert(Point_2(NAN, 0)), DELDRIFT_NOT_FINITE, "position");
    CHECK_THROWS(t.insert(Point_2(0, 2e57)), DELDRIFT_OUT_OF_RANGE, "2e57");
    points[7].first = Point_2(0, INFINITY);
    CHECK_THROWS(t.insert(points.begin(), points.end()), DELDRIFT_NOT_FINITE, "positions[7]");
    CHECK_THROWS(Dt2(points.begin(), points.end()), DELDRIFT_NOT_FINITE, "positions[7]");
    const Dt2::Vertex_handle v = *t.finite_vertices_begin();
    const Point_2 before = v->point();
    CHECK_THROWS(t.move(v, Point_2(0, NAN)), DELDRIFT_NOT_FINITE, "coordinate 1");
    CHECK_THROWS(t.stage_move(v, Point_2(0, NAN)), DELDRIFT_NOT_FINITE, "coordinate 1");
    Dt2::Locate_type lt;
    int li = 0;
    CHECK_THROWS(t.locate(Point_2(NAN, 0), lt, li), DELDRIFT_NOT_FINITE, "coordinate 0");
    CHECK_THROWS(t.nearest_vertex(Point_2(NAN, 0)), DELDRIFT_NOT_FINITE, "coordinate 0");
    CHECK(faces_of(t) == faces && v->point() == before && t.triangulation().staged_count() == 0 && t.is_valid());
    const Dt2::Vertex_handle w = t.insert(Point_2(2, 2));
    CHECK(w->point() == Point_2(2, 2) && w.id() == 20 && t.is_valid());
}

int main() {
    vertices_move_together();
    one_vertex_for_each_place();
    handles_last();
    copies_are_independent();
    copies_are_as_the_original();
    flat_sets();
    neighbours_are_mutual();
    circulators_and_sets();
    threads_read_at_once();
    large_stars_are_whole();
    neighbours_follow_changes();
    failures_have_no_effect();
}
