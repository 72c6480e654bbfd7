// A program in the manner of CGAL's examples. With WITH_CGAL it uses CGAL; without it deldrift/cgal.hpp, with
// CGAL_KERNEL on CGAL's own points and data structures. It has to write the same. Positions are in general position, so
// that the cells are unique; what has no order is sorted.
#include <algorithm>
#include <array>
#include <boost/iterator/counting_iterator.hpp>
#include <boost/iterator/transform_iterator.hpp>
#include <boost/iterator/zip_iterator.hpp>
#include <cstdio>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#ifdef WITH_CGAL
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
namespace library = CGAL;
#else
#include <deldrift/cgal.hpp>
namespace library = deldrift::cgal;
#endif

#if defined(WITH_CGAL) || defined(CGAL_KERNEL)
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_data_structure_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vb2 = CGAL::Triangulation_vertex_base_with_info_2<unsigned, K>;
using Vb3 = CGAL::Triangulation_vertex_base_with_info_3<unsigned, K>;
using Cb3 = CGAL::Delaunay_triangulation_cell_base_3<K>;
using Info2 = CGAL::Triangulation_data_structure_2<Vb2>;
using Info3 = CGAL::Triangulation_data_structure_3<Vb3, Cb3>;
#else
using K = library::Kernel;
using Info2 = unsigned;
using Info3 = unsigned;
#endif

using Dt2 = library::Delaunay_triangulation_2<K, Info2>;
using Dt3 = library::Delaunay_triangulation_3<K, Info3>;
using Point_2 = K::Point_2;
using Point_3 = K::Point_3;

static std::mt19937_64 engine(7);

static double anywhere() { return static_cast<double>(engine() >> 11) / 9007199254740992.0; }

// Rows of numbers, in ascending order, of which each begins with the lowest number: cells, however they are named.
template <std::size_t N>
using Rows = std::vector<std::array<unsigned, N>>;

template <std::size_t N>
static void show(const char *what, Rows<N> rows) {
    std::sort(rows.begin(), rows.end());
    std::printf("%s: %zu\n", what, rows.size());
    for (const auto &row : rows) {
        for (unsigned x : row) std::printf("%u ", x);
        std::printf("\n");
    }
}

// The vertices in the order of their infos.
template <class Dt>
static std::map<unsigned, typename Dt::Vertex_handle> by_info_of(const Dt &t) {
    std::map<unsigned, typename Dt::Vertex_handle> vertices;
    for (typename Dt::Finite_vertices_iterator v = t.finite_vertices_begin(); v != t.finite_vertices_end(); ++v) {
        vertices[v->info()] = v;
    }
    return vertices;
}

// ------------------------------------------------------------------------------------------------ the plane

// The info of a vertex; that of the infinite one is set to 9999.
static std::array<unsigned, 3> corners_of(Dt2::Face_handle f) {
    std::array<unsigned, 3> row{f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()};
    std::rotate(row.begin(), std::min_element(row.begin(), row.end()), row.end());
    return row;
}

static void show_plane(const Dt2 &t) {
    std::printf("%zu vertices, %zu faces, dimension %d, valid %d\n", static_cast<std::size_t>(t.number_of_vertices()),
                static_cast<std::size_t>(t.number_of_faces()), t.dimension(), t.is_valid());
    Rows<3> faces, all;
    for (Dt2::Finite_faces_iterator it = t.finite_faces_begin(); it != t.finite_faces_end(); ++it) {
        faces.push_back(corners_of(it));
        const Point_2 c = t.dual(Dt2::Face_handle(it));
        std::array<double, 4> squares{};
        for (int i = 0; i < 3; i++) {
            const Point_2 &p = it->vertex(i)->point();
            const double x = p.x() - c.x(), y = p.y() - c.y();
            squares[static_cast<std::size_t>(i)] = x * x + y * y;
        }
        if (squares[0] > 1.000001 * squares[1] || squares[0] < 0.999999 * squares[1]) std::printf("not the centre\n");
        for (int i = 0; i < 3; i++) {
            const Dt2::Face_handle g = it->neighbor(i);
            if (g->neighbor(t.mirror_index(it, i)) != Dt2::Face_handle(it)) std::printf("not the mirror index\n");
            if (g->has_vertex(it->vertex(i))) std::printf("not the opposite vertex\n");
            if (!g->has_vertex(it->vertex(Dt2::ccw(i)))) std::printf("not the edge\n");
            if (it->index(g) != i || it->index(it->vertex(i)) != i) std::printf("not the index\n");
        }
    }
    show("finite faces", faces);
    for (Dt2::Face_handle f : t.all_face_handles()) {
        if (t.is_infinite(f)) all.push_back(corners_of(f));
    }
    show("infinite faces", all);
    Rows<2> edges;
    for (Dt2::Finite_edges_iterator e = t.finite_edges_begin(); e != t.finite_edges_end(); ++e) {
        const unsigned a = e->first->vertex(t.cw(e->second))->info(), b = e->first->vertex(t.ccw(e->second))->info();
        edges.push_back({std::min(a, b), std::max(a, b)});
    }
    show("finite edges", edges);
}

// The neighbours of each vertex in counter-clockwise order, from the one of lowest info.
static void show_circulators(const Dt2 &t) {
    for (const auto &[info, v] : by_info_of(t)) {
        std::vector<unsigned> around;
        Dt2::Vertex_circulator w = t.incident_vertices(v), done = w;
        do around.push_back(w->info());
        while (++w != done);
        std::rotate(around.begin(), std::min_element(around.begin(), around.end()), around.end());
        std::size_t n_faces = 0, n_infinite = 0, n_infinite_edges = 0;
        Dt2::Face_circulator f = t.incident_faces(v), first = f;
        if (f != nullptr) {
            do n_faces++, n_infinite += t.is_infinite(f);
            while (++f != first);
        }
        Dt2::Edge_circulator e = t.incident_edges(v), end = e;
        do n_infinite_edges += t.is_infinite(*e);
        while (++e != end);
        if (info % 40 == 3 || n_infinite > 0) {
            std::printf("%u: %zu %zu %zu %zu:", info, n_faces, n_infinite, n_infinite_edges,
                        static_cast<std::size_t>(t.degree(v)));
            for (unsigned x : around) std::printf(" %u", x);
            std::printf("\n");
        }
    }
}

static void locate_in_plane(const Dt2 &t) {
    std::map<unsigned, Dt2::Vertex_handle> by_info = by_info_of(t);
    std::vector<Point_2> queries{Point_2(0.5, 0.5), Point_2(-1, 0.3), Point_2(5, 5), by_info[3]->point()};
    for (int i = 0; i < 50; i++) queries.push_back(Point_2(1.2 * anywhere(), 1.2 * anywhere()));
    Dt2::Face_handle near = Dt2::Face_handle();
    for (const Point_2 &q : queries) {
        Dt2::Locate_type lt;
        int li = 0;
        near = t.locate(q, lt, li, near);
        std::printf("%d %d nearest %u", static_cast<int>(lt), t.is_infinite(near), t.nearest_vertex(q)->info());
        if (lt == Dt2::FACE) {
            for (unsigned x : corners_of(near)) std::printf(" %u", x);
        } else if (lt == Dt2::VERTEX) {
            std::printf(" at %u", near->vertex(li)->info());
        }
        std::printf("\n");
    }
}

// Points on edges of a triangulation with coordinates that are exact.
static void locate_on_edges() {
    std::vector<std::pair<Point_2, unsigned>> points{{Point_2(0, 0), 0}, {Point_2(8, 0), 1}, {Point_2(0, 8), 2},
                                                     {Point_2(11, 10), 3}, {Point_2(3, 4), 4}};
    Dt2 t(points.begin(), points.end());
    t.infinite_vertex()->info() = 9999;
    for (const Point_2 &q :
         {Point_2(1.5, 2), Point_2(4, 0), Point_2(7, 7), Point_2(3, 4), Point_2(5.5, 2), Point_2(9, 0)}) {
        Dt2::Locate_type lt;
        int li = 0;
        const Dt2::Face_handle f = t.locate(q, lt, li);
        std::printf("%d", static_cast<int>(lt));
        if (lt == Dt2::EDGE) {
            const unsigned a = f->vertex(t.ccw(li))->info(), b = f->vertex(t.cw(li))->info();
            std::printf(" on %u %u", std::min(a, b), std::max(a, b));
        }
        std::printf("\n");
    }
}

static void plane() {
    std::vector<std::pair<Point_2, unsigned>> points;
    for (unsigned i = 0; i < 300; i++) points.emplace_back(Point_2(anywhere(), anywhere()), i);
    Dt2 t;
    t.insert(points.begin(), points.begin() + 200);
    const auto n = t.insert(points.begin() + 150, points.end());
    std::printf("%ld more\n", static_cast<long>(n));
    t.infinite_vertex()->info() = 9999;
    std::map<unsigned, Dt2::Vertex_handle> by_info;
    for (Dt2::Vertex_handle v : t.finite_vertex_handles()) by_info[v->info()] = v;

    Dt2::Vertex_handle v = t.insert(Point_2(0.25, 0.125));
    v->info() = 300;
    by_info[300] = v;
    std::printf("again: %d\n", t.insert(Point_2(0.25, 0.125)) == v);
    for (unsigned i = 20; i < 40; i++) t.remove(by_info[i]);
    for (unsigned i = 100; i < 140; i++) {
        const Point_2 p = by_info[i]->point();
        const Point_2 q(p.x() + 0.1 * anywhere(), p.y() / 2);
        const Dt2::Vertex_handle moved = t.move_if_no_collision(by_info[i], q);
        if (moved != by_info[i]) std::printf("collision of %u\n", i);
    }
    std::printf("collision: %d", t.move_if_no_collision(by_info[5], by_info[6]->point()) == by_info[6]);
    std::printf(" %d\n", t.move(by_info[5], by_info[6]->point()) == by_info[6]);
    show_plane(t);
    show_circulators(t);
    locate_in_plane(t);
    Dt2 other(t);
    t.clear();
    std::printf("%zu and %zu", static_cast<std::size_t>(t.number_of_vertices()),
                static_cast<std::size_t>(other.number_of_vertices()));
    t.swap(other);
    std::printf(", then %zu and %zu\n", static_cast<std::size_t>(t.number_of_vertices()),
                static_cast<std::size_t>(other.number_of_vertices()));
}

// ------------------------------------------------------------------------------------------------------ space

static std::array<unsigned, 4> corners_of(Dt3::Cell_handle c) {
    std::array<unsigned, 4> row;
    for (int i = 0; i < 4; i++) row[static_cast<std::size_t>(i)] = c->vertex(i)->info();
    // An even permutation: two exchanges, or as many as put the lowest first and keep the orientation.
    const auto least = std::min_element(row.begin(), row.end());
    if (least != row.begin()) {
        std::iter_swap(row.begin(), least);
        std::swap(row[2], row[3]);
    }
    std::rotate(row.begin() + 1, std::min_element(row.begin() + 1, row.end()), row.end());
    return row;
}

static void show_space(const Dt3 &t) {
    std::printf("%zu vertices, %zu cells, %zu finite, %zu facets, %zu edges, dimension %d, valid %d\n",
                static_cast<std::size_t>(t.number_of_vertices()), static_cast<std::size_t>(t.number_of_cells()),
                static_cast<std::size_t>(t.number_of_finite_cells()),
                static_cast<std::size_t>(t.number_of_finite_facets()),
                static_cast<std::size_t>(t.number_of_finite_edges()), t.dimension(), t.is_valid());
    Rows<4> cells, infinite;
    for (Dt3::Finite_cells_iterator c = t.finite_cells_begin(); c != t.finite_cells_end(); ++c) {
        cells.push_back(corners_of(Dt3::Cell_handle(c)));
        for (int i = 0; i < 4; i++) {
            const Dt3::Cell_handle g = c->neighbor(i);
            if (g->neighbor(t.mirror_index(c, i)) != Dt3::Cell_handle(c)) std::printf("not the mirror index\n");
            if (c->index(g) != i || g->has_vertex(c->vertex(i))) std::printf("not the neighbour\n");
            if (t.is_infinite(g) != g->has_vertex(t.infinite_vertex())) std::printf("not infinite\n");
            if (t.is_infinite(c, i)) std::printf("not finite\n");
        }
    }
    show("finite cells", cells);
    for (Dt3::Cell_handle c : t.all_cell_handles()) {
        if (t.is_infinite(c)) infinite.push_back(corners_of(c));
    }
    show("infinite cells", infinite);
    Rows<3> facets;
    for (Dt3::Finite_facets_iterator f = t.finite_facets_begin(); f != t.finite_facets_end(); ++f) {
        std::array<unsigned, 3> row;
        for (std::size_t k = 0; k < 3; k++) {
            row[k] = f->first->vertex((f->second + 1 + static_cast<int>(k)) % 4)->info();
        }
        std::sort(row.begin(), row.end());
        facets.push_back(row);
    }
    show("finite facets", facets);
    // Edges with the cells around them, in order, from the lowest.
    Rows<4> edges;
    for (Dt3::Finite_edges_iterator e = t.finite_edges_begin(); e != t.finite_edges_end(); ++e) {
        Dt3::Vertex_handle a = e->first->vertex(e->second), b = e->first->vertex(e->third);
        int i = e->second, j = e->third;
        if (a->info() > b->info()) std::swap(a, b), std::swap(i, j);
        // Of the vertices around, in the sense of the circulator: how many, and the one after the lowest.
        std::vector<unsigned> around;
        Dt3::Facet_circulator f = t.incident_facets(e->first, i, j), done = f;
        do {
            const Dt3::Facet facet = *f;
            for (int k = 0; k < 4; k++) {
                const Dt3::Vertex_handle v = facet.first->vertex(k);
                if (k != facet.second && v != a && v != b) around.push_back(v->info());
            }
        } while (++f != done);
        std::rotate(around.begin(), std::min_element(around.begin(), around.end()), around.end());
        std::size_t n_cells = 0;
        Dt3::Cell_circulator c = t.incident_cells(*e), first = c;
        do n_cells++;
        while (++c != first);
        if (n_cells != around.size()) std::printf("%zu cells, but %zu facets\n", n_cells, around.size());
        edges.push_back({a->info(), b->info(), static_cast<unsigned>(n_cells), around[1]});
    }
    show("finite edges", edges);
}

static void show_stars(const Dt3 &t) {
    for (const auto &[info, v] : by_info_of(t)) {
        std::vector<Dt3::Cell_handle> cells, finite;
        std::vector<Dt3::Vertex_handle> vertices, finite_vertices;
        std::vector<Dt3::Facet> facets, finite_facets;
        t.incident_cells(v, std::back_inserter(cells));
        t.finite_incident_cells(v, std::back_inserter(finite));
        t.adjacent_vertices(v, std::back_inserter(vertices));
        t.finite_adjacent_vertices(v, std::back_inserter(finite_vertices));
        t.incident_facets(v, std::back_inserter(facets));
        t.finite_incident_facets(v, std::back_inserter(finite_facets));
        std::set<unsigned> infos;
        for (Dt3::Vertex_handle w : vertices) infos.insert(w->info());
        std::printf("%u: %zu %zu %zu %zu %zu %zu %zu %d:", info, cells.size(), finite.size(), vertices.size(),
                    finite_vertices.size(), facets.size(), finite_facets.size(), static_cast<std::size_t>(t.degree(v)),
                    v->cell()->has_vertex(v));
        for (unsigned x : infos) std::printf(" %u", x);
        std::printf("\n");
    }
}

static void locate_in_space() {
    std::vector<Point_3> points{Point_3(0, 0, 0), Point_3(8, 0, 0), Point_3(0, 8, 0), Point_3(0, 0, 8),
                                Point_3(1, 2, 1.5)};
    Dt3 t(points.begin(), points.end());
    for (const Point_3 &q :
         {Point_3(1, 2, 1.5), Point_3(4, 4, 0), Point_3(0.5, 1, 0.75), Point_3(2, 2, 0), Point_3(3, 1, 1),
          Point_3(-1, 1, 1), Point_3(4.5, 1, 0.75), Point_3(3, 3, 2)}) {
        Dt3::Locate_type lt;
        int li = 0, lj = 0;
        const Dt3::Cell_handle c = t.locate(q, lt, li, lj);
        std::printf("%d %d", static_cast<int>(lt), t.is_infinite(c));
        if (lt == Dt3::VERTEX) std::printf(" %g", c->vertex(li)->point().y());
        if (lt == Dt3::EDGE) {
            const double a = c->vertex(li)->point().x(), b = c->vertex(lj)->point().x();
            std::printf(" %g %g", std::min(a, b), std::max(a, b));
        }
        if (lt == Dt3::FACET) {
            double sum = 0;
            for (int k = 1; k < 4; k++) {
                const Point_3 p = c->vertex((li + k) % 4)->point();
                sum += p.x() + p.z();
            }
            std::printf(" %g", sum);
        }
        std::printf("\n");
    }
}

static void space() {
    std::vector<std::pair<Point_3, unsigned>> points;
    for (unsigned i = 0; i < 150; i++) points.emplace_back(Point_3(anywhere(), anywhere(), anywhere()), i);
    Dt3 t(points.begin(), points.begin() + 100);
    t.infinite_vertex()->info() = 9999;
    t.insert(points.begin() + 50, points.end());
    std::map<unsigned, Dt3::Vertex_handle> by_info = by_info_of(t);
    const Dt3::Vertex_handle v = t.insert(Point_3(0.25, 0.125, 0.75), t.infinite_cell());
    v->info() = 150;
    for (unsigned i = 20; i < 40; i++) t.remove(by_info[i]);
    for (unsigned i = 60; i < 80; i++) {
        const Point_3 p = by_info[i]->point();
        t.move(by_info[i], Point_3(p.x(), p.y() + 0.1 * anywhere(), p.z() / 2));
    }
    show_space(t);
    show_stars(t);
    const Dt3::Cell_handle c = t.locate(Point_3(0.5, 0.5, 0.5));
    const Point_3 centre = t.dual(c);
    std::printf("%.4f %.4f %.4f, nearest %u\n", centre.x(), centre.y(), centre.z(),
                t.nearest_vertex(Point_3(0.1, 0.9, 0.5))->info());
}

#include "zones.hpp"

// ---------------------------------------------------------------------------- points from whatever gives them

// Coordinates as they are read from text.
template <class Point, std::size_t dimension>
struct Coordinates {
    std::array<double, dimension> x{};
    operator Point() const { return std::apply([](auto... each) { return Point(each...); }, x); }
    friend std::istream &operator>>(std::istream &in, Coordinates &c) {
        for (double &each : c.x) in >> each;
        return in;
    }
};

// The vertices, with their infos and how many neighbours each has.
template <class Dt>
static void show_vertices(const Dt &t) {
    for (const auto &[info, v] : by_info_of(t)) {
        std::printf("%u: %g %g, %zu\n", info, v->point().x(), v->point().y(),
                    static_cast<std::size_t>(t.degree(v)));
    }
}

// Infos come from how often the iterators have been read.
template <class Dt, std::size_t dimension>
static void sequences() {
    using Point = typename Dt::Point;
    std::vector<Point> points;
    for (unsigned i = 0; i < 30; i++) {
        Coordinates<Point, dimension> c;
        for (double &each : c.x) each = anywhere();
        points.push_back(c);
    }
    unsigned n_read = 0;
    const auto next = [&](unsigned i) { return std::pair<Point, unsigned>(points[i], 100 * n_read++); };
    const auto from = boost::make_transform_iterator(boost::counting_iterator<unsigned>(0), next);
    show_vertices(Dt(from, from + 30));
    std::printf("%u\n", n_read);

    std::vector<unsigned> infos;
    for (unsigned i = 0; i < 30; i++) infos.push_back(7 * i);
    Dt zipped;
    zipped.insert(boost::make_zip_iterator(boost::make_tuple(points.begin(), infos.begin())),
                  boost::make_zip_iterator(boost::make_tuple(points.end(), infos.end())));
    show_vertices(zipped);

    using Read = std::istream_iterator<Coordinates<Point, dimension>>;
    std::istringstream text("0 0 1 4 1 0 2 5 3 7 4 9 3 1 8 5 6 1");
    Dt read{Read(text), Read()};
    unsigned sum = 0;
    for (typename Dt::Vertex_handle v : read.finite_vertex_handles()) sum += static_cast<unsigned>(v->point().x());
    std::printf("%zu %u\n", static_cast<std::size_t>(read.number_of_vertices()), sum);
}

int main() {
    plane();
    locate_on_edges();
    space();
    locate_in_space();
    zones_in_plane();
    zones_in_space();
    sequences<Dt2, 2>();
    sequences<Dt3, 3>();
}
