// Regular triangulations under CGAL's names: any history on a grid, where ties and vertices at one place are common.
// ffi-tests/cgal/regular.cpp compares them with CGAL where there are none.
#include "regular.hpp"

#include <algorithm>
#include <iterator>

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

static std::vector<Rt2::Vertex_handle> inner_vertices(const Rt2 &t, const Weighted_point_2 &p, Rt2::Face_handle hint) {
    std::vector<Rt2::Vertex_handle> vertices;
    t.get_hidden_vertices(p, std::back_inserter(vertices), hint);
    return vertices;
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
    CHECK(inner_vertices(t, p, t.infinite_face()) == inner);
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
    std::set_difference(before.begin(), before.end(), after.begin(), after.end(),
                        std::inserter(removed, removed.end()));
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
                if (!w->is_hidden() || !t.is_vertex(w->point(), there)) there = w;
                CHECK(t.move_if_no_collision(w, w->point()) == there);
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

int main() {
    histories<Rt2>();
    histories<Rt3>();
}
