// A program with regular triangulations in the manner of CGAL's examples. With WITH_CGAL it uses CGAL; without it
// deldrift/cgal.hpp, with CGAL_KERNEL on CGAL's own points and data structures. It has to write the same. Points are in
// general position, so that the cells and the hidden vertices are unique; what has no order is sorted.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#ifdef WITH_CGAL
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Regular_triangulation_3.h>
namespace library = CGAL;
#else
#include <deldrift/cgal.hpp>
namespace library = deldrift::cgal;
#endif

#if defined(WITH_CGAL) || defined(CGAL_KERNEL)
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_face_base_2.h>
#include <CGAL/Regular_triangulation_vertex_base_2.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_data_structure_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
using K = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vb2 = CGAL::Triangulation_vertex_base_with_info_2<unsigned, K, CGAL::Regular_triangulation_vertex_base_2<K>>;
using Fb2 = CGAL::Regular_triangulation_face_base_2<K>;
using Vb3 = CGAL::Triangulation_vertex_base_with_info_3<unsigned, K, CGAL::Regular_triangulation_vertex_base_3<K>>;
using Cb3 = CGAL::Regular_triangulation_cell_base_3<K>;
using Info2 = CGAL::Triangulation_data_structure_2<Vb2, Fb2>;
using Info3 = CGAL::Triangulation_data_structure_3<Vb3, Cb3>;
#else
using K = library::Kernel;
using Info2 = unsigned;
using Info3 = unsigned;
#endif

using Rt2 = library::Regular_triangulation_2<K, Info2>;
using Rt3 = library::Regular_triangulation_3<K, Info3>;
using Point_2 = K::Point_2;
using Point_3 = K::Point_3;
using Weighted_point_2 = K::Weighted_point_2;
using Weighted_point_3 = K::Weighted_point_3;

static std::mt19937_64 engine(11);

static double anywhere() { return static_cast<double>(engine() >> 11) / 9007199254740992.0; }

// A vertex is named by its point and weight: where CGAL shows a hidden point in space again, its info is gone.
static std::string name(const Weighted_point_2 &p) {
    char text[64];
    std::snprintf(text, sizeof text, "%.3f/%.3f/%.4f", p.x(), p.y(), p.weight());
    return text;
}
static std::string name(const Weighted_point_3 &p) {
    char text[64];
    std::snprintf(text, sizeof text, "%.3f/%.3f/%.3f/%.4f", p.x(), p.y(), p.z(), p.weight());
    return text;
}
template <class Rt>
static std::string name(const Rt &t, typename Rt::Vertex_handle v) {
    return t.is_infinite(v) ? "infinite" : name(v->point());
}

using Lines = std::vector<std::string>;

static std::string sorted(Lines words) {
    std::sort(words.begin(), words.end());
    std::string line;
    for (const std::string &word : words) line += " " + word;
    return line;
}
static void show(const char *what, Lines lines) {
    std::sort(lines.begin(), lines.end());
    std::printf("%zu %s\n", lines.size(), what);
    for (const std::string &line : lines) std::printf(" %s\n", line.c_str());
}

template <int corners, class Rt, class Cell>
static std::string corners_of(const Rt &t, Cell c) {
    Lines words;
    for (int i = 0; i < corners; i++) words.push_back(name(t, c->vertex(i)));
    return sorted(words);
}
// The corners of a facet.
template <int corners, class Rt, class Facet>
static std::string facet_of(const Rt &t, const Facet &f) {
    Lines words;
    for (int i = 0; i < corners; i++) {
        if (i != f.second) words.push_back(name(t, f.first->vertex(i)));
    }
    return sorted(words);
}
// Rounded, and of cells that are not nearly flat.
template <class Point>
static std::string place(const Point &p) {
    char text[64] = " far";
    if (std::hypot(p.x(), p.y()) < 4) std::snprintf(text, sizeof text, " %.4f %.4f", p.x() + 9, p.y() + 9);
    return text;
}

// ------------------------------------------------------------------------------------------------------ plane

static Weighted_point_2 drawn_in_plane(double greatest) {
    const double x = anywhere(), y = anywhere();
    return Weighted_point_2(Point_2(x, y), greatest * (anywhere() - 0.2));
}

static std::string corners_of(const Rt2 &t, Rt2::Face_handle f) { return corners_of<3>(t, f); }

static void show_plane(const Rt2 &t) {
    std::printf("%zu vertices, %zu hidden, %zu faces, dimension %d, valid %d\n",
                static_cast<std::size_t>(t.number_of_vertices()),
                static_cast<std::size_t>(t.number_of_hidden_vertices()), static_cast<std::size_t>(t.number_of_faces()),
                t.dimension(), t.is_valid());
    Lines faces, infinite, edges, vertices, hidden, lists;
    for (Rt2::Finite_faces_iterator f = t.finite_faces_begin(); f != t.finite_faces_end(); ++f) {
        faces.push_back(corners_of(t, f) + place(t.dual(f)) + place(t.weighted_circumcenter(f)));
        Lines above;
        for (Rt2::Vertex_handle v : f->vertex_list()) above.push_back(name(t, v));
        if (!above.empty()) lists.push_back(corners_of(t, f) + ":" + sorted(above));
        for (int i = 0; i < 3; i++) {
            if (t.power_test(f, f->vertex(i)->point()) != 0) std::printf("a corner is not on the power circle\n");
            if (f->neighbor(i)->neighbor(t.mirror_index(f, i)) != Rt2::Face_handle(f)) std::printf("not mirrored\n");
        }
    }
    show("faces with their centres", faces);
    show("faces with hidden vertices", lists);
    for (Rt2::Face_handle f : t.all_face_handles()) {
        if (t.is_infinite(f)) infinite.push_back(corners_of(t, f));
    }
    show("infinite faces", infinite);
    for (Rt2::Finite_edges_iterator e = t.finite_edges_begin(); e != t.finite_edges_end(); ++e) {
        edges.push_back(facet_of<3>(t, *e));
    }
    show("edges", edges);
    for (Rt2::Vertex_handle v : t.finite_vertex_handles()) {
        std::size_t n_faces = 0;
        Rt2::Face_circulator f = t.incident_faces(v), first = f;
        do n_faces++;
        while (++f != first);
        if (v->is_hidden()) std::printf("hidden among those that are not\n");
        vertices.push_back(name(t, v) + " " + std::to_string(v->info()) + " " + std::to_string(n_faces) + " " +
                           std::to_string(t.degree(v)));
    }
    show("vertices", vertices);
    for (Rt2::Hidden_vertices_iterator v = t.hidden_vertices_begin(); v != t.hidden_vertices_end(); ++v) {
        const Rt2::Vertex_handle handle = v;
        if (!handle->is_hidden()) std::printf("not hidden\n");
        hidden.push_back(name(t, handle) + " " + std::to_string(handle->info()) + " by" +
                         corners_of(t, handle->face()));
    }
    show("hidden vertices", hidden);
}

static void ask_in_plane(const Rt2 &t) {
    for (int k = 0; k < 12; k++) {
        // Inside and outside, light and heavy.
        const Weighted_point_2 p(Point_2(1.4 * anywhere() - 0.2, 1.4 * anywhere() - 0.2), 0.08 * (anywhere() - 0.3));
        Lines faces, edges, hidden, sides;
        std::vector<Rt2::Face_handle> conflicts;
        std::vector<Rt2::Edge> boundary;
        std::vector<Rt2::Vertex_handle> vertices;
        t.get_conflicts_and_boundary_and_hidden_vertices(p, std::back_inserter(conflicts), std::back_inserter(boundary),
                                                         std::back_inserter(vertices));
        for (Rt2::Face_handle f : conflicts) faces.push_back(corners_of(t, f));
        for (const Rt2::Edge &e : boundary) edges.push_back(facet_of<3>(t, e) + " of" + corners_of(t, e.first));
        // CGAL has the infinite vertex among them where an infinite face is in conflict.
        for (Rt2::Vertex_handle v : vertices) {
            if (!t.is_infinite(v)) hidden.push_back(name(t, v));
        }
        show("faces in conflict", faces);
        show("edges around them", edges);
        show("vertices to be hidden", hidden);
        std::vector<Rt2::Face_handle> again;
        t.get_conflicts(p, std::back_inserter(again), t.infinite_face());
        std::size_t n_positive = 0;
        for (Rt2::Face_handle f : t.all_face_handles()) {
            n_positive += t.power_test(f, p) == library::ON_POSITIVE_SIDE;
        }
        std::printf("%d %zu of %zu\n", again.size() == conflicts.size(), n_positive, conflicts.size());
        std::printf("%d %d\n", t.power_test(p, Weighted_point_2(p.point(), 0)), t.power_test(p, p));
        std::printf("nearest %s\n", name(t, t.nearest_power_vertex(p.point())).c_str());
        Rt2::Locate_type lt;
        int li = 0;
        const Rt2::Face_handle f = t.locate(p, lt, li);
        // Outside it is in any infinite face whose edge it sees.
        std::printf("in%s, %d\n", t.is_infinite(f) ? " none" : corners_of(t, f).c_str(), static_cast<int>(lt));
    }
}

static std::map<unsigned, Rt2::Vertex_handle> by_info_of(const Rt2 &t) {
    std::map<unsigned, Rt2::Vertex_handle> by_info;
    for (Rt2::Vertex_handle v : t.finite_vertex_handles()) by_info[v->info()] = v;
    for (Rt2::Hidden_vertices_iterator v = t.hidden_vertices_begin(); v != t.hidden_vertices_end(); ++v) {
        const Rt2::Vertex_handle handle = v;
        by_info[handle->info()] = handle;
    }
    return by_info;
}

static void plane(double greatest) {
    std::vector<std::pair<Weighted_point_2, unsigned>> points;
    for (unsigned i = 0; i < 240; i++) points.emplace_back(drawn_in_plane(greatest), i);
    Rt2 t;
    const auto n = t.insert(points.begin(), points.begin() + 200);
    std::printf("%ld more\n", static_cast<long>(n));
    show_plane(t);
    // One after the other, with the face of the last one as a hint.
    Rt2::Face_handle near = t.infinite_face();
    for (unsigned i = 200; i < 240; i++) {
        const Rt2::Vertex_handle v = t.insert(points[i].first, near);
        v->info() = i;
        near = v->face();
        if (v->is_hidden()) std::printf("%u is hidden at once\n", i);
    }
    show_plane(t);
    ask_in_plane(t);
    // Some go, hidden ones among them; what they hid shows again.
    std::map<unsigned, Rt2::Vertex_handle> by_info = by_info_of(t);
    for (unsigned i = 0; i < 60; i++) t.remove(by_info[3 * i]);
    show_plane(t);
    by_info = by_info_of(t);
    // Moves: other places and other weights.
    for (unsigned i = 0; i < 40; i++) {
        const Weighted_point_2 p = drawn_in_plane(greatest);
        const Rt2::Vertex_handle v = by_info[3 * i + 1];
#ifdef WITH_CGAL
        t.remove(v);
        t.insert(p)->info() = 3 * i + 1;
#else
        if (t.move(v, p) != v || v->info() != 3 * i + 1) std::printf("another vertex\n");
#endif
    }
    show_plane(t);
    ask_in_plane(t);
    // The same place with the same and with a smaller weight.
    Rt2 other(t);
    by_info = by_info_of(other);
    const Rt2::Vertex_handle v = std::find_if(by_info.begin(), by_info.end(), [](const auto &each) {
                                     return !each.second->is_hidden();
                                 })->second;
    const Weighted_point_2 p = v->point();
    const auto count = [&] {
        std::printf("%zu and %zu\n", static_cast<std::size_t>(other.number_of_vertices()),
                    static_cast<std::size_t>(other.number_of_hidden_vertices()));
    };
    std::printf("%d\n", other.insert(p) == v);
    count();
    const Rt2::Vertex_handle lighter = other.insert(Weighted_point_2(p.point(), p.weight() - 1));
    std::printf("%d %d\n", lighter->is_hidden(), lighter->face()->has_vertex(v));
    count();
    std::printf("%d\n", other.insert(Weighted_point_2(p.point(), p.weight() + 1))->is_hidden());
    count();
    // A point at the place of a hidden one, with the same weight, is another vertex.
    const Rt2::Vertex_handle hidden = std::find_if(by_info.begin(), by_info.end(), [](const auto &each) {
                                          return each.second->is_hidden();
                                      })->second;
    std::printf("%d\n", other.insert(hidden->point()) == hidden);
    count();
    other.clear();
    count();
    show_plane(t);
    std::ostringstream text;
    text << Weighted_point_2(Point_2(1, 2), 3) << ' ' << (Weighted_point_2(Point_2(1, 2), 3) == Weighted_point_2(1, 2));
    std::printf("%s\n", text.str().c_str());
}

// ------------------------------------------------------------------------------------------------------ space

static Weighted_point_3 drawn_in_space(double greatest) {
    const double x = anywhere(), y = anywhere(), z = anywhere();
    return Weighted_point_3(Point_3(x, y, z), greatest * (anywhere() - 0.2));
}

static std::string corners_of(const Rt3 &t, Rt3::Cell_handle c) { return corners_of<4>(t, c); }

static void show_space(const Rt3 &t) {
    std::printf("%zu vertices, %zu cells, %zu finite, %zu facets, %zu edges, dimension %d, valid %d\n",
                static_cast<std::size_t>(t.number_of_vertices()), static_cast<std::size_t>(t.number_of_cells()),
                static_cast<std::size_t>(t.number_of_finite_cells()),
                static_cast<std::size_t>(t.number_of_finite_facets()),
                static_cast<std::size_t>(t.number_of_finite_edges()), t.dimension(), t.is_valid());
    Lines cells, infinite, hidden, vertices;
    std::size_t n_hidden = 0;
    for (Rt3::Finite_cells_iterator c = t.finite_cells_begin(); c != t.finite_cells_end(); ++c) {
        cells.push_back(corners_of(t, c) + place(t.dual(c)));
        Lines above;
        for (auto p = c->hidden_points_begin(); p != c->hidden_points_end(); ++p) above.push_back(name(*p));
        n_hidden += above.size();
        if (!above.empty()) hidden.push_back(corners_of(t, c) + ":" + sorted(above));
        for (int i = 0; i < 4; i++) {
            if (t.side_of_power_sphere(c, c->vertex(i)->point()) != library::ON_BOUNDARY) {
                std::printf("a corner is not on the power sphere\n");
            }
        }
    }
    show("cells with their centres", cells);
    show("cells with hidden points", hidden);
#ifndef WITH_CGAL
    if (t.number_of_hidden_vertices() != n_hidden) std::printf("%zu are hidden\n", n_hidden);
#endif
    for (Rt3::Cell_handle c : t.all_cell_handles()) {
        if (t.is_infinite(c)) infinite.push_back(corners_of(t, c));
    }
    show("infinite cells", infinite);
    for (Rt3::Vertex_handle v : t.finite_vertex_handles()) {
        std::vector<Rt3::Cell_handle> around;
        t.incident_cells(v, std::back_inserter(around));
        vertices.push_back(name(t, v) + " " + std::to_string(around.size()) + " " + std::to_string(t.degree(v)));
    }
    show("vertices", vertices);
}

static void ask_in_space(const Rt3 &t) {
    for (int k = 0; k < 12; k++) {
        const Weighted_point_3 p(Point_3(1.4 * anywhere() - 0.2, 1.4 * anywhere() - 0.2, 1.4 * anywhere() - 0.2),
                                 0.3 * (anywhere() - 0.3));
        std::vector<Rt3::Facet> boundary, inner;
        std::vector<Rt3::Cell_handle> conflicts;
        std::vector<Rt3::Vertex_handle> around, inside;
        const Rt3::Cell_handle c = t.locate(p);
        t.find_conflicts(p, c, std::back_inserter(boundary), std::back_inserter(conflicts), std::back_inserter(inner));
        t.vertices_inside_conflict_zone(p, c, std::back_inserter(inside));
        t.vertices_on_conflict_zone_boundary(p, c, std::back_inserter(around));
        Lines cells, facets, vertices, on_boundary;
        for (Rt3::Cell_handle each : conflicts) cells.push_back(corners_of(t, each));
        for (const Rt3::Facet &f : boundary) facets.push_back(facet_of<4>(t, f));
        for (Rt3::Vertex_handle v : inside) vertices.push_back(name(t, v));
        for (Rt3::Vertex_handle v : around) on_boundary.push_back(name(t, v));
        show("cells in conflict", cells);
        show("facets around them", facets);
        show("vertices inside", vertices);
        show("vertices around", on_boundary);
        std::size_t n_inside = 0;
        for (Rt3::Cell_handle each : t.all_cell_handles()) {
            n_inside += t.side_of_power_sphere(each, p) == library::ON_BOUNDED_SIDE;
        }
        std::printf("%zu of %zu, %zu between them\n", n_inside, conflicts.size(), inner.size());
        std::printf("nearest %s, in%s\n", name(t, t.nearest_power_vertex(p.point())).c_str(),
                    t.is_infinite(c) ? " none" : corners_of(t, c).c_str());
    }
}

static std::vector<std::pair<std::string, Rt3::Vertex_handle>> by_name_of(const Rt3 &t) {
    std::map<std::string, Rt3::Vertex_handle> by_name;
    for (Rt3::Vertex_handle v : t.finite_vertex_handles()) by_name[name(t, v)] = v;
    return {by_name.begin(), by_name.end()};
}

static void space(double greatest) {
    std::vector<Weighted_point_3> points;
    for (unsigned i = 0; i < 140; i++) points.push_back(drawn_in_space(greatest));
    Rt3 t(points.begin(), points.begin() + 100);
    show_space(t);
    Rt3::Cell_handle near = t.infinite_cell();
    for (unsigned i = 100; i < 140; i++) {
        const Rt3::Vertex_handle v = t.insert(points[i], near);
        near = t.infinite_cell();
        if (v == Rt3::Vertex_handle()) std::printf("%u is hidden at once\n", i);
        else v->info() = i;
    }
    show_space(t);
    ask_in_space(t);
    // What they hid shows again.
    std::vector<Rt3::Vertex_handle> some;
    for (const auto &[text, v] : by_name_of(t)) {
        if (some.size() < 25) some.push_back(v);
    }
    t.remove(some.begin(), some.end());
    show_space(t);
    ask_in_space(t);
    // Of infos that come with points.
    std::vector<std::pair<Weighted_point_3, unsigned>> more;
    for (unsigned i = 0; i < 30; i++) more.emplace_back(drawn_in_space(greatest), 1000 + i);
    std::printf("%ld more\n", static_cast<long>(t.insert(more.begin(), more.end())));
    Lines infos, names;
    for (const auto &[p, info] : more) names.push_back(name(p));
    for (Rt3::Vertex_handle v : t.finite_vertex_handles()) {
        const bool has_info = std::count(names.begin(), names.end(), name(t, v)) > 0;
        if (has_info) infos.push_back(name(t, v) + " " + std::to_string(v->info()));
    }
    show("infos", infos);
    show_space(t);
    // Moves: other places and other weights. CGAL has them in space for vertices that hide none.
    for (std::size_t i = 0; i < 25; i++) {
        const Rt3::Vertex_handle v = by_name_of(t)[7 * i % t.number_of_vertices()].second;
        const Weighted_point_3 p = drawn_in_space(greatest);
#ifdef WITH_CGAL
        t.remove(v);
        t.insert(p);
#else
        if (t.move(v, p) != v) std::printf("another vertex\n");
#endif
    }
    show_space(t);
    ask_in_space(t);
    const Rt3 other(t);
    t.clear();
    std::printf("%zu and %zu\n", static_cast<std::size_t>(t.number_of_vertices()),
                static_cast<std::size_t>(other.number_of_vertices()));
}

int main() {
    plane(0.01);
    plane(0.1);
    space(0.05);
    space(0.3);
}
