// What the programs with CGAL's names for regular triangulations share: points with ties, and what each state has to be.
#ifndef REGULAR_HPP
#define REGULAR_HPP

#include "check.hpp"

#include <array>
#include <deldrift/cgal.hpp>
#include <map>
#include <random>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

using K = deldrift::cgal::Kernel;
using deldrift::cgal::Point_2;
using deldrift::cgal::Point_3;
using deldrift::cgal::Weighted_point_2;
using deldrift::cgal::Weighted_point_3;
using Rt2 = deldrift::cgal::Regular_triangulation_2<K, int>;
using Rt3 = deldrift::cgal::Regular_triangulation_3<K, int>;

static std::mt19937_64 engine(29);
inline int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine); }

// On a grid, with whole weights: ties, and vertices at one place, are common.
inline Weighted_point_2 drawn(const Weighted_point_2 *) {
    const double x = below(7), y = below(7);
    return {Point_2(x, y), double(below(13) - 4)};
}
inline Weighted_point_3 drawn(const Weighted_point_3 *) {
    const double x = below(4), y = below(4), z = below(4);
    return {Point_3(x, y, z), double(below(9) - 3)};
}
template <class Rt>
static typename Rt::Weighted_point drawn() {
    return drawn(static_cast<const typename Rt::Weighted_point *>(nullptr));
}
inline std::array<double, 2> numbers_of(const Weighted_point_2 &p) { return {p.x(), p.y()}; }
inline std::array<double, 3> numbers_of(const Weighted_point_3 &p) { return {p.x(), p.y(), p.z()}; }

inline auto cells_of(const Rt2 &t) { return t.finite_face_handles(); }
inline auto cells_of(const Rt3 &t) { return t.finite_cell_handles(); }
inline auto all_cells_of(const Rt2 &t) { return t.all_face_handles(); }
inline auto all_cells_of(const Rt3 &t) { return t.all_cell_handles(); }

// Positive where the cell is in conflict.
inline int side_of(const Rt2 &t, Rt2::Face_handle f, const Weighted_point_2 &p) { return t.power_test(f, p); }
inline int side_of(const Rt3 &t, Rt3::Cell_handle c, const Weighted_point_3 &p) { return t.side_of_power_sphere(c, p); }

template <class Rt>
static constexpr int dimension_of = std::is_same_v<Rt, Rt2> ? 2 : 3;
using Sets = std::set<std::set<int>>;

// The infos of the corners; that of the infinite vertex is -1.
template <class Rt, class Cell>
inline std::set<int> corners_of(const Rt &t, Cell c) {
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
inline std::set<int> hidden_of(const Rt &t) {
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

#endif  // REGULAR_HPP
