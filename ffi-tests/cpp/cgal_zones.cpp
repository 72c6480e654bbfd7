// deldrift/cgal.hpp: which cells a point is in conflict with, which vertices have a common cell, iterators over all
// that is infinite. The oracle of conflicts is the insertion; points are on grids, so that ties are broken.
// ffi-tests/cgal compares it with CGAL.
#include "check.hpp"

#include <algorithm>
#include <deldrift/cgal.hpp>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <vector>

using K = deldrift::cgal::Kernel;
using deldrift::cgal::Point_2;
using deldrift::cgal::Point_3;
using Dt2 = deldrift::cgal::Delaunay_triangulation_2<K, int>;
using Dt3 = deldrift::cgal::Delaunay_triangulation_3<K>;

// All that is no template compiles for any kernel.
template class deldrift::cgal::Delaunay_triangulation_2<K, int>;
template class deldrift::cgal::Delaunay_triangulation_3<K, int>;

static std::mt19937_64 engine(5);

static int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine); }

static std::size_t length_of(std::ptrdiff_t n) { return static_cast<std::size_t>(n); }

// The ids of corners in ascending order, that of the infinite vertex last: cells before and after an insertion.
template <std::size_t N, class Cell>
static std::array<std::uint32_t, N> ids_of(Cell c) {
    std::array<std::uint32_t, N> ids;
    for (std::size_t i = 0; i < N; i++) ids[i] = c->vertex(static_cast<int>(i))->id();
    std::sort(ids.begin(), ids.end());
    return ids;
}
template <std::size_t N, class Handles>
static std::set<std::array<std::uint32_t, N>> ids_of_all(const Handles &cells) {
    std::set<std::array<std::uint32_t, N>> all;
    for (const auto &c : cells) all.insert(ids_of<N>(c));
    return all;
}

// On a grid, some between its points, inside, on the hull's edges, in their lines and outside.
static double somewhere() { return 0.5 * (below(15) - 3); }

// ------------------------------------------------------------------------------------------------ the plane

static Dt2 grid_in_plane(int n) {
    std::vector<std::pair<Point_2, int>> points;
    for (int i = 0; i < n * n; i++) points.emplace_back(Point_2(i % n, i / n), i);
    std::shuffle(points.begin(), points.end(), engine);
    return Dt2(points.begin(), points.end());
}

static void check_ring(const std::vector<Dt2::Edge> &ring, const std::vector<Dt2::Face_handle> &faces) {
    for (std::size_t k = 0; k < ring.size(); k++) {
        const auto &[f, i] = ring[k];
        const auto &[g, j] = ring[(k + 1) % ring.size()];
        CHECK(f->vertex(f->ccw(i)) == g->vertex(g->cw(j)));
        CHECK(std::count(faces.begin(), faces.end(), f) == 0 &&
              std::count(faces.begin(), faces.end(), f->neighbor(i)) == 1);
    }
}

// What goes is what is not there after the insertion.
static void faces_in_conflict_are_those_that_go() {
    std::size_t n_ghosts = 0, n_ties = 0;
    for (int round = 0; round < 300; round++) {
        Dt2 t = grid_in_plane(2 + round % 6);
        const Point_2 p(somewhere(), somewhere());
        std::vector<Dt2::Face_handle> faces, again;
        std::vector<Dt2::Edge> ring, ring_again;
        const Dt2::Face_handle hint = round % 2 == 0 ? Dt2::Face_handle() : *t.all_faces_begin();
        t.get_conflicts_and_boundary(p, std::back_inserter(faces), std::back_inserter(ring), hint);
        t.get_conflicts(p, std::back_inserter(again), hint);
        t.get_boundary_of_conflicts(p, std::back_inserter(ring_again), hint);
        CHECK(faces == again && ring == ring_again);
        check_ring(ring, faces);
        for (Dt2::Face_handle f : t.all_face_handles()) {
            const bool goes = std::count(faces.begin(), faces.end(), f) > 0;
            const auto side = t.side_of_oriented_circle(f, p);
            n_ghosts += goes && t.is_infinite(f);
            n_ties += side == deldrift::cgal::ON_ORIENTED_BOUNDARY;
            // At the place of a vertex there are none.
            CHECK(faces.empty() || goes == (side == deldrift::cgal::ON_POSITIVE_SIDE));
        }
        Dt2::Vertex_handle there;
        if (t.is_vertex(p, there)) {
            CHECK(faces.empty() && ring.empty());
            continue;
        }
        auto expected = ids_of_all<3>(t.all_face_handles());
        Dt2 other(t);
        other.insert(p);
        const auto after = ids_of_all<3>(other.all_face_handles());
        for (auto i = expected.begin(); i != expected.end();)
            i = after.count(*i) > 0 ? expected.erase(i) : std::next(i);
        CHECK(ids_of_all<3>(faces) == expected);

        const auto without = [&] {
            std::vector<Dt2::Face_handle> fewer(faces.begin() + 1, faces.end());
            return t.star_hole(p, ring.begin(), ring.end(), fewer.begin(), fewer.end());
        };
        CHECK_THROWS(without(), DELDRIFT_INVALID_VALUE, "cells are not the");
        const Dt2::Vertex_handle v = t.star_hole(p, ring.begin(), ring.end(), faces.begin(), faces.end());
        CHECK(v->point() == p && t.is_valid() && t.degree(v) == ring.size());
    }
    CHECK(n_ghosts > 50 && n_ties > 50);
    Dt2 flat;
    flat.insert(Point_2(0, 0));
    std::vector<Dt2::Face_handle> faces;
    flat.get_conflicts(Point_2(1, 1), std::back_inserter(faces));
    CHECK(faces.empty());
}

static void edges_and_faces_by_their_vertices() {
    Dt2 t = grid_in_plane(4);
    const Dt2::Vertex_handle pushed = t.push_back(Point_2(0.25, 0.5));
    CHECK(pushed == t.nearest_vertex(Point_2(0.25, 0.5)));
    std::set<std::pair<Dt2::Vertex_handle, Dt2::Vertex_handle>> edges;
    for (Dt2::All_edges_iterator e = t.all_edges_begin(); e != t.all_edges_end(); ++e) {
        const Dt2::Vertex_handle a = e->first->vertex(t.cw(e->second)), b = e->first->vertex(t.ccw(e->second));
        CHECK(edges.emplace(a, b).second && edges.emplace(b, a).second);
    }
    const std::vector<Dt2::Vertex_handle> all(t.all_vertices_begin(), t.all_vertices_end());
    CHECK(all.size() == 18 && t.is_infinite(all[0]) && t.all_vertex_handles().size() == 18);
    CHECK(t.all_edges().size() == t.number_of_edges() + 12 &&
          length_of(std::distance(t.edges_begin(), t.edges_end())) == t.number_of_edges());
    CHECK(length_of(std::distance(t.vertices_begin(), t.vertices_end())) == 17);
    CHECK(length_of(std::distance(t.faces_begin(), t.faces_end())) == t.number_of_faces());
    for (Dt2::Vertex_handle a : all) {
        CHECK(t.is_vertex(a));
        for (Dt2::Vertex_handle b : all) {
            Dt2::Face_handle f;
            int i = -1;
            const bool is_edge = edges.count({a, b}) > 0;
            CHECK(t.is_edge(a, b) == is_edge && t.is_edge(a, b, f, i) == is_edge && (f == nullptr) == !is_edge);
            if (!is_edge) continue;
            CHECK(f->index(a) + f->index(b) + i == 3 && f->has_vertex(a) && f->has_vertex(b));
            Dt2::Face_handle g;
            CHECK(t.is_face(a, f->vertex(i), b, g) && g == f && t.is_face(b, a, t.mirror_vertex(f, i)));
            CHECK(!t.is_face(a, b, b, g));
        }
    }
    Dt2 other;
    CHECK(!other.is_vertex(all[1]) && !other.is_vertex(Dt2::Vertex_handle()));
    CHECK(!other.is_edge(other.insert(Point_2(0, 0)), other.infinite_vertex()));
}

static void objects_of_the_plane() {
    const std::vector<Point_2> points{Point_2(0, 0), Point_2(4, 0), Point_2(0, 3)};
    const Dt2 t(points.begin(), points.end());
    const Dt2::Face_handle f = *t.finite_faces_begin();
    const Dt2::Triangle triangle = t.triangle(f);
    for (int i = 0; i < 3; i++) {
        const Dt2::Segment s = t.segment(f, i);
        CHECK(triangle.vertex(i) == t.point(f, i) && triangle[i] == t.point(f->vertex(i)));
        CHECK(s.source() == t.point(f, t.ccw(i)) && s.target() == s.vertex(1) && s == t.segment(Dt2::Edge(f, i)));
    }
    CHECK(t.oriented_side(f, Point_2(1, 1)) == deldrift::cgal::ON_POSITIVE_SIDE);
    CHECK(t.oriented_side(f, Point_2(2, 0)) == deldrift::cgal::ON_ORIENTED_BOUNDARY);
    CHECK(t.oriented_side(f, Point_2(5, 0)) == deldrift::cgal::ON_NEGATIVE_SIDE);
    CHECK(t.side_of_oriented_circle(f, Point_2(4, 3)) == deldrift::cgal::ON_ORIENTED_BOUNDARY);
    // In the line of an edge of the hull the circle behind it counts.
    for (Dt2::Face_handle g : t.all_face_handles()) {
        if (!t.is_infinite(g) || g->index(f) != g->index(t.infinite_vertex()) ||
            g->has_vertex(t.nearest_vertex(points[2]))) {
            continue;
        }
        CHECK(t.side_of_oriented_circle(g, Point_2(1, 0)) == 1 && t.side_of_oriented_circle(g, Point_2(5, 0)) == -1);
        CHECK(t.side_of_oriented_circle(g, Point_2(4, 0)) == 0 && t.side_of_oriented_circle(g, Point_2(9, -1)) == 1);
        CHECK(t.side_of_oriented_circle(g, Point_2(1, 1)) == -1);
    }
    std::ostringstream text;
    text << Dt2::Segment(points[0], points[1]);
    CHECK(text.str() == "0 0 4 0" && Dt2::Segment() != Dt2::Segment(points[0], points[1]));
    CHECK(&t.geom_traits() == &t.geom_traits());
}

// ------------------------------------------------------------------------------------------------------ space

static Dt3 grid_in_space(int n) {
    std::vector<Point_3> points;
    for (int i = 0; i < n * n * n; i++) points.emplace_back(i % n, i / n % n, i / n / n);
    std::shuffle(points.begin(), points.end(), engine);
    return Dt3(points.begin(), points.end());
}

static std::vector<Dt3::Facet> inner_facets(const Dt3 &t, const Point_3 &p, Dt3::Cell_handle hint) {
    std::vector<Dt3::Facet> boundary, interior;
    std::vector<Dt3::Cell_handle> cells;
    t.find_conflicts(p, hint, std::back_inserter(boundary), std::back_inserter(cells), std::back_inserter(interior));
    return interior;
}

static void check_facets(const Dt3 &t, const Point_3 &p, Dt3::Cell_handle hint,
                         const std::vector<Dt3::Cell_handle> &cells, const std::vector<Dt3::Facet> &facets) {
    const auto is_in = [&](Dt3::Cell_handle c) { return std::binary_search(cells.begin(), cells.end(), c); };
    std::size_t n_around = 0, n_within = 0;
    for (Dt3::Cell_handle c : cells) {
        for (int i = 0; i < 4; i++) (is_in(c->neighbor(i)) ? n_within : n_around)++;
    }
    std::set<Dt3::Vertex_handle> vertices;
    for (const auto &[c, i] : facets) {
        CHECK(is_in(c) && !is_in(c->neighbor(i)));
        for (int k = 0; k < 3; k++) vertices.insert(c->vertex(t.vertex_triple_index(i, k)));
    }
    const std::vector<Dt3::Facet> interior = inner_facets(t, p, hint);
    CHECK(facets.size() == n_around && 2 * interior.size() == n_within);
    for (const auto &[c, i] : interior) CHECK(is_in(c) && is_in(c->neighbor(i)));
    std::vector<Dt3::Vertex_handle> on_boundary;
    t.vertices_on_conflict_zone_boundary(p, hint, std::back_inserter(on_boundary));
    CHECK(std::equal(vertices.begin(), vertices.end(), on_boundary.begin(), on_boundary.end()));
}

static void cells_in_conflict_are_those_that_go() {
    std::size_t n_ghosts = 0, n_ties = 0, n_without_finite = 0;
    for (int round = 0; round < 200; round++) {
        Dt3 t = grid_in_space(2 + round % 3);
        const Point_3 p(somewhere(), somewhere(), somewhere());
        const Dt3::Cell_handle hint = round % 2 == 0 ? Dt3::Cell_handle() : t.locate(p);
        std::vector<Dt3::Cell_handle> cells;
        std::vector<Dt3::Facet> facets;
        t.find_conflicts(p, hint, std::back_inserter(facets), std::back_inserter(cells));
        check_facets(t, p, hint, cells, facets);
        std::size_t n_finite = 0;
        for (Dt3::Cell_handle c : t.all_cell_handles()) {
            const bool goes = std::binary_search(cells.begin(), cells.end(), c);
            const auto side = t.side_of_sphere(c, p);
            n_finite += goes && !t.is_infinite(c);
            n_ties += side == deldrift::cgal::ON_BOUNDARY;
            CHECK(cells.empty() || goes == (side == deldrift::cgal::ON_BOUNDED_SIDE));
        }
        n_ghosts += cells.size() - n_finite;
        n_without_finite += n_finite == 0 && !cells.empty();
        Dt3::Vertex_handle there;
        if (t.is_vertex(p, there)) {
            CHECK(cells.empty() && facets.empty());
            continue;
        }
        auto expected = ids_of_all<4>(t.all_cell_handles());
        Dt3 other(t);
        other.insert(p);
        const auto after = ids_of_all<4>(other.all_cell_handles());
        for (auto i = expected.begin(); i != expected.end();)
            i = after.count(*i) > 0 ? expected.erase(i) : std::next(i);
        CHECK(ids_of_all<4>(cells) == expected);
        const auto insert_in = [&](auto first, auto last) {
            return t.insert_in_hole(p, first, last, facets[0].first, facets[0].second);
        };
        CHECK_THROWS(insert_in(cells.begin(), cells.begin()), DELDRIFT_INVALID_VALUE, "0 cells are not the");
        const std::size_t n = t.number_of_vertices();
        std::shuffle(cells.begin(), cells.end(), engine);
        CHECK(insert_in(cells.begin(), cells.end())->point() == p && t.number_of_vertices() == n + 1 && t.is_valid());
    }
    CHECK(n_ghosts > 50 && n_ties > 50 && n_without_finite > 5);
}

// By the cells, whatever function is asked.
static void edges_facets_and_cells_by_their_vertices() {
    const Dt3 t = grid_in_space(3);
    std::map<std::pair<Dt3::Vertex_handle, Dt3::Vertex_handle>, std::set<Dt3::Cell_handle>> edges;
    for (Dt3::Cell_handle c : t.all_cell_handles()) {
        for (int i = 0; i < 4; i++) {
            for (int j = 0; j < 4; j++) {
                if (i != j) edges[{c->vertex(i), c->vertex(j)}].insert(c);
            }
        }
    }
    CHECK(2 * t.number_of_edges() == edges.size() && t.all_edges().size() == t.number_of_edges());
    CHECK(t.number_of_facets() == 2 * t.number_of_cells() && t.all_facets().size() == t.number_of_facets());
    for (Dt3::Vertex_handle a : t.all_vertex_handles()) {
        for (Dt3::Vertex_handle b : t.all_vertex_handles()) {
            Dt3::Cell_handle c;
            int i = -1, j = -1, k = -1, l = -1;
            const auto found = edges.find({a, b});
            CHECK(t.is_edge(a, b) == (found != edges.end()) && t.is_edge(a, b, c, i, j) == (found != edges.end()));
            if (found == edges.end()) continue;
            CHECK(found->second.count(c) == 1 && c->vertex(i) == a && c->vertex(j) == b);
            const int third = t.next_around_edge(i, j), fourth = 6 - i - j - third;
            const Dt3::Vertex_handle d = c->vertex(third), e = c->vertex(fourth);
            Dt3::Cell_handle other;
            CHECK(t.is_facet(d, a, b, other, k, i, j) && other->vertex(k) == d && other->vertex(i) == a);
            CHECK(t.is_cell(d, b, e, a, other) && other == c && t.is_cell(b, a, d, e, other, j, i, k, l) &&
                  l == fourth);
            CHECK(!t.is_facet(a, b, a, other, i, j, k) && !t.is_cell(a, b, d, d, other));
            const Dt3::Edge edge(c, c->index(a), c->index(b));
            for (Dt3::Cell_handle start : found->second) {
                Dt3::Cell_circulator around = t.incident_cells(edge, start);
                CHECK(*around == start && *t.incident_cells(c, edge.second, edge.third, start) == start);
                std::set<Dt3::Cell_handle> cells;
                do cells.insert(around);
                while (++around != t.incident_cells(edge, start));
                CHECK(cells == found->second);
                const Dt3::Facet facet = *t.incident_facets(start, start->index(a), start->index(b));
                CHECK(*t.incident_facets(edge, facet) == facet &&
                      *t.incident_facets(edge, t.mirror_facet(facet)) == facet);
                CHECK(*t.incident_facets(c, edge.second, edge.third, facet) == facet);
            }
        }
    }
    CHECK(Dt3::Edge() != Dt3::Edge(*t.cells_begin(), 0, 1) &&
          Dt3::Edge(*t.cells_begin(), 0, 1) < Dt3::Edge(*t.cells_begin(), 0, 2));
}

static void around_any_vertex() {
    const Dt3 t = grid_in_space(3);
    const auto length = [](auto first, auto last) { return length_of(std::distance(first, last)); };
    CHECK(length(t.vertices_begin(), t.vertices_end()) == 28 &&
          length(t.cells_begin(), t.cells_end()) == t.number_of_cells());
    CHECK(length(t.facets_begin(), t.facets_end()) == t.number_of_facets());
    CHECK(length(t.edges_begin(), t.edges_end()) == t.number_of_edges());
    CHECK(length(t.all_facets_begin(), t.all_facets_end()) == t.number_of_facets());
    CHECK(length(t.all_edges_begin(), t.all_edges_end()) == t.number_of_edges());
    for (Dt3::Vertex_handle v : t.all_vertex_handles()) {
        std::vector<Dt3::Cell_handle> cells;
        std::vector<Dt3::Edge> edges, finite;
        std::vector<Dt3::Vertex_handle> vertices;
        t.incident_cells(v, std::back_inserter(cells));
        t.incident_edges(v, std::back_inserter(edges));
        t.finite_incident_edges(v, std::back_inserter(finite));
        t.incident_vertices(v, std::back_inserter(vertices));
        std::set<Dt3::Vertex_handle> expected;
        std::size_t n = 0;
        for (Dt3::Cell_handle c : t.all_cell_handles()) {
            if (!c->has_vertex(v)) continue;
            n++;
            for (int i = 0; i < 4; i++) expected.insert(c->vertex(i));
        }
        expected.erase(v);
        CHECK(cells.size() == n && vertices.size() == expected.size() && t.degree(v) == expected.size());
        CHECK(std::set<Dt3::Vertex_handle>(vertices.begin(), vertices.end()) == expected);
        std::set<Dt3::Vertex_handle> ends;
        for (const Dt3::Edge &e : edges) {
            CHECK(e.first->vertex(e.second) == v);
            ends.insert(e.first->vertex(e.third));
        }
        CHECK(ends == expected && edges.size() == expected.size());
        const std::size_t n_infinite = expected.count(t.infinite_vertex());
        CHECK(finite.size() == (t.is_infinite(v) ? 0 : edges.size() - n_infinite));
    }
}

static void objects_of_space() {
    const Dt3 t = grid_in_space(2);
    for (Dt3::Cell_handle c : t.finite_cell_handles()) {
        const Dt3::Tetrahedron tetrahedron = t.tetrahedron(c);
        for (int i = 0; i < 4; i++) {
            CHECK(tetrahedron.vertex(i) == t.point(c, i));
            const Dt3::Triangle triangle = t.triangle(c, i);
            CHECK(triangle == t.triangle(Dt3::Facet(c, i)) && triangle.source() == triangle.vertex(0));
            std::vector<double> numbers;
            for (const Point_3 &p : {triangle.vertex(0), triangle.vertex(1), triangle.vertex(2), t.point(c, i)}) {
                numbers.insert(numbers.end(), {p.x(), p.y(), p.z()});
            }
            // Counter-clockwise as seen from the corner, of the lowest corner first.
            CHECK(deldrift::orientation(3, numbers) == 1 && triangle.vertex(0) == t.point(c, i == 0 ? 1 : 0));
            CHECK(t.segment(c, i, (i + 1) % 4).target() == t.segment(Dt3::Edge(c, (i + 1) % 4, i)).source());
        }
        CHECK(t.side_of_sphere(c, Point_3(0.5, 0.5, 0.5)) == deldrift::cgal::ON_BOUNDED_SIDE);
        CHECK(t.side_of_sphere(c, Point_3(1, 1, 0)) == deldrift::cgal::ON_BOUNDARY);
    }
    for (Dt3::Cell_handle c : t.all_cell_handles()) {
        if (!t.is_infinite(c)) continue;
        // In the plane of a facet of the hull, the sphere behind it counts; beyond it, none does.
        const int i = c->index(t.infinite_vertex());
        const Point_3 a = t.point(c, (i + 1) % 4), b = t.point(c, (i + 2) % 4);
        const Point_3 middle((a.x() + b.x()) / 2, (a.y() + b.y()) / 2, (a.z() + b.z()) / 2);
        const Point_3 far(a.x() + 9 * (b.x() - a.x()), a.y() + 9 * (b.y() - a.y()), a.z() + 9 * (b.z() - a.z()));
        CHECK(t.side_of_sphere(c, middle) == 1 && t.side_of_sphere(c, a) == 0 && t.side_of_sphere(c, far) == -1);
        CHECK(t.side_of_sphere(c, Point_3(0.5, 0.5, 0.5)) == -1);
    }
}

int main() {
    faces_in_conflict_are_those_that_go();
    edges_and_faces_by_their_vertices();
    objects_of_the_plane();
    cells_in_conflict_are_those_that_go();
    edges_facets_and_cells_by_their_vertices();
    around_any_vertex();
    objects_of_space();
}
