// What is near, in C++: members against a pass over all vertices and cells.
#include "check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

using deldrift::Triangulation;
using Ids = std::vector<std::uint32_t>;

// A lattice of 13 steps each way, every fifth place taken twice: distances tie, and vertices are hidden.
static std::vector<double> lattice() {
    std::vector<double> points;
    for (int i = 0; i < 14 * 14; i++) {
        for (int times = 0; times <= (i % 5 == 0); times++) {
            points.push_back(i % 14);
            points.push_back(i / 14);
        }
    }
    return points;
}

static const std::vector<double> points = lattice();
static const std::uint32_t n = static_cast<std::uint32_t>(points.size() / 2);

static double square_from(double x, double y, std::uint32_t v) {
    return (points[2 * v] - x) * (points[2 * v] - x) + (points[2 * v + 1] - y) * (points[2 * v + 1] - y);
}

template <class Condition>
static Ids all_with(Condition condition) {
    Ids ids;
    for (std::uint32_t v = 0; v < n; v++) {
        if (condition(v)) ids.push_back(v);
    }
    return ids;
}

static void vertices_are_found() {
    const Triangulation t(2, points);
    const double infinity = std::numeric_limits<double>::infinity();
    for (double squared : {0.0, 1.0, 2.0, 25.0, 1e9}) {
        CHECK(t.vertices_in_ball({5.0, 6.0}, squared) ==
              all_with([&](std::uint32_t v) { return square_from(5, 6, v) <= squared; }));
    }
    CHECK(t.vertices_in_box({3.0, 2.0}, {7.5, 2.0}) == all_with([](std::uint32_t v) {
              return points[2 * v] >= 3 && points[2 * v] <= 7.5 && points[2 * v + 1] == 2;
          }));
    CHECK(t.vertices_in_box({-infinity, 12.5}, {infinity, infinity}) ==
          all_with([](std::uint32_t v) { return points[2 * v + 1] > 12.5; }));
    CHECK(t.vertices_in_box({1.0, 1.0}, {0.0, 2.0}).empty());

    Ids order = all_with([](std::uint32_t) { return true; });
    std::sort(order.begin(), order.end(), [](std::uint32_t v, std::uint32_t w) {
        return std::make_pair(square_from(5.5, 6.5, v), v) < std::make_pair(square_from(5.5, 6.5, w), w);
    });
    const Ids nearest = t.nearest_vertices({5.5, 6.5, 5.5, 6.5}, n + 1);
    CHECK(nearest.size() == 2 * std::size_t{n + 1});
    CHECK(std::equal(order.begin(), order.end(), nearest.begin()) && nearest[n] == DELDRIFT_NONE);
    CHECK(std::equal(order.begin(), order.end(), nearest.begin() + n + 1) && nearest.back() == DELDRIFT_NONE);

    deldrift::NeighbourLists lists = t.neighbour_lists({2.25});
    CHECK(lists.offsets.size() == n + 1 && lists.offsets.back() == lists.neighbours.size() && lists.shifts.empty());
    for (std::uint32_t v = 0; v < n; v++) {
        Ids ball = t.vertices_in_ball(t.position(v), 2.25);
        ball.erase(std::find(ball.begin(), ball.end(), v));
        CHECK(ball == Ids(lists.of_vertex(v).begin(), lists.of_vertex(v).end()));
    }
    const std::size_t full = lists.neighbours.size();
    t.neighbour_lists({2.25}, lists, DELDRIFT_PAIRS_HALF);
    CHECK(full > 0 && 2 * lists.neighbours.size() == full);
    std::vector<double> radii(n, 0.0);
    radii[1] = 1e9;
    std::vector<std::uint8_t> first(n, 0);
    first[1] = 1;
    t.neighbour_lists(radii, lists, DELDRIFT_PAIRS_FULL, first);
    CHECK(lists.neighbours.size() == n - 1 && lists.of_vertex(1).size() == n - 1);
    CHECK_THROWS(t.neighbour_lists({-1.0}), DELDRIFT_INVALID_VALUE, "squared_radii[0] is -1");
    CHECK_THROWS(t.neighbour_lists({1.0, 2.0}), DELDRIFT_WRONG_COUNT, "radius_count is 2");

    CHECK_THROWS(t.vertices_in_ball({5.0}, 1), DELDRIFT_WRONG_COUNT, "centre has 1 numbers");
    CHECK_THROWS(t.vertices_in_ball({5.0, 5.0}, -1), DELDRIFT_INVALID_VALUE, "squared_radius[0] is -1");
    CHECK_THROWS(t.vertices_in_box({5.0, NAN}, {6.0, 6.0}), DELDRIFT_INVALID_VALUE, "low[1] is NaN");
    CHECK_THROWS(t.nearest_vertices({1.0, NAN}, 3), DELDRIFT_NOT_FINITE, "positions[0]");
}

static void what_is_in_reach_is_found() {
    const Triangulation t(2, points);
    const double infinity = std::numeric_limits<double>::infinity();
    const deldrift::Circumspheres spheres = t.circumcentres();
    const std::vector<double> low = {7.25, 3.75, -infinity, 40.0}, high = {8.0, 5.5, infinity, infinity};
    const deldrift::InReach reach = t.cells_in_reach(low, high);
    const deldrift::Facets facets = t.hull_facets_in_reach(low, high), hull = t.hull_facets();
    CHECK(reach.size() > 0 && reach.centres.size() == 2 * reach.size() && reach.radii.size() == reach.size());
    for (std::size_t k = 0; k < reach.size(); k++) {
        const std::size_t cell = reach.cells[k];
        CHECK(k == 0 || reach.cells[k - 1] < cell);
        CHECK(reach.radii[k] * reach.radii[k] >= spheres.squared_radii[cell]);
    }
    CHECK(facets.size() > 0 && facets.size() < hull.size() && facets.corners.size() == facets.size());
    const deldrift::BoxLists lists = t.vertices_in_reach(low, high);
    CHECK(lists.offsets.size() == 3 && lists.offsets.back() == lists.vertices.size());
    CHECK(lists.of_box(0).size() > 0 && lists.of_box(1).size() > 0);
    const Ids inside = t.vertices_in_box({7.25, 3.75}, {8.0, 5.5});
    for (std::uint32_t v : inside) {
        CHECK(std::count(lists.of_box(0).begin(), lists.of_box(0).end(), v) == 1);
    }
    std::vector<std::uint8_t> mask(n, 0);
    CHECK(t.cells_in_reach(low, high, mask).size() == 0 && t.vertices_in_reach(low, high, mask).vertices.empty());
    mask.pop_back();
    CHECK_THROWS(t.cells_in_reach(low, high, mask), DELDRIFT_WRONG_COUNT, "mask_count is ");
    CHECK_THROWS(t.cells_in_reach({1.0}, {2.0}), DELDRIFT_WRONG_COUNT, "low has 1 numbers");
    CHECK_THROWS(t.vertices_in_reach(low, {2.0, 2.0}), DELDRIFT_WRONG_COUNT, "high has 2 numbers");
}

static void hidden_vertices_are_listed() {
    const Triangulation t(2, points);
    const deldrift::Hidden hidden = t.hidden_vertices();
    CHECK(hidden.vertices == all_with([&](std::uint32_t v) { return t.coincident_representative(v) != v; }));
    CHECK(hidden.size() == 40);
    for (std::size_t k = 0; k < hidden.size(); k++) {
        CHECK(t.coincident_representative(hidden.vertices[k]) == hidden.representatives[k]);
    }
    const Ids cells = t.cell_of_each_vertex();
    for (std::uint32_t v = 0; v < n; v++) {
        const Ids star = t.coincident_representative(v) == v ? t.star(v) : Ids{};
        CHECK(star.empty() ? cells[v] == DELDRIFT_NONE
                           : std::find(star.begin(), star.end(), cells[v]) != star.end());
    }
}

static void simplices_are_found() {
    const Triangulation t(2, points);
    const Ids edges = t.edges();
    for (std::uint32_t cell : t.find_simplices(2, edges)) CHECK(cell != DELDRIFT_NONE);
    for (std::size_t k = 0; k < edges.size(); k += 20) CHECK(t.is_edge(edges[k + 1], edges[k]));
    // The first vertex is at the place of the second one; the last one is far away.
    CHECK(!t.is_edge(0, 1) && !t.is_edge(0, n - 1) && t.is_edge(1, 2) == t.is_edge(0, 2));
    CHECK_THROWS(t.find_simplices(4, {0, 1, 2, 3}), DELDRIFT_INVALID_VALUE, "corners_per_simplex[0] is 4");
    CHECK_THROWS(t.find_simplices(2, {0, 1, 2}), DELDRIFT_WRONG_COUNT, "vertices has 3 numbers");
    CHECK_THROWS(t.is_edge(0, n), DELDRIFT_NO_SUCH_VERTEX, "vertices[1]");
}

static void conflicts_are_what_an_insertion_removes() {
    for (const std::vector<double> &place : {std::vector<double>{4.25, 5.5}, {0, 0}, {-1, 3}, {6.5, 6.5}}) {
        Triangulation t(2, points);
        t.take_changes();
        Ids conflicts = t.conflicts(place);
        std::sort(conflicts.begin(), conflicts.end());
        t.insert_vertex(place);
        const deldrift_changes changes = t.take_changes();
        Ids removed(changes.removed, changes.removed + changes.removed_count);
        std::sort(removed.begin(), removed.end());
        CHECK(conflicts == removed);
    }
}

static void weights_reproduce_a_position() {
    const Triangulation t(2, points);
    const Ids cells{0, 5, DELDRIFT_NONE};
    const std::vector<double> places{3.25, 4.5, 20, -7, 1, 1};
    const std::vector<double> weights = t.barycentric(places, cells);
    for (std::size_t k = 0; k < 2; k++) {
        double x = 0, y = 0;
        for (std::size_t i = 0; i < 3; i++) {
            const std::uint32_t v = t.cells()[cells[k]][i];
            x += weights[3 * k + i] * points[2 * v];
            y += weights[3 * k + i] * points[2 * v + 1];
        }
        // Legs of cells are 1, so no weight is above 60.
        CHECK(std::fabs(x - places[2 * k]) < 1e-10 && std::fabs(y - places[2 * k + 1]) < 1e-10);
    }
    CHECK(std::isnan(weights[6]) && std::isnan(weights[8]));
    CHECK_THROWS(t.barycentric({1.0, 1.0}, {0, 1}), DELDRIFT_WRONG_COUNT, "cells has 2 numbers");
    CHECK_THROWS(t.barycentric({1.0, 1.0}, {77777}), DELDRIFT_NO_SUCH_FACET, "77777");
}

static void flat_cells_are_left_out() {
    std::vector<double> turned;
    for (int i = 0; i < 21 * 21; i++) {
        const double x = i % 21, y = i / 21;
        turned.push_back(std::cos(0.3) * x - std::sin(0.3) * y);
        turned.push_back(std::sin(0.3) * x + std::cos(0.3) * y);
    }
    const Triangulation t(2, turned);
    const std::vector<std::uint8_t> mask = t.mask_without_flat_cells(1e-9);
    CHECK(mask.size() == t.cell_count() && mask.size() > 800);
    CHECK(std::count(mask.begin(), mask.end(), 1) == 2 * 20 * 20 && t.mask_boundary(mask).size() == 80);
    CHECK_THROWS(t.mask_without_flat_cells(-1), DELDRIFT_INVALID_VALUE, "tolerance[0] is -1");
}

static void signs_are_exact() {
    CHECK(deldrift::in_sphere(2, {0, 0, 1, 0, 1, 1, 0, 1}) == 0);
    CHECK(deldrift::in_sphere(2, {0, 0, 1, 0, 1, 1, 0, std::nextafter(1.0, 0)}) == 1);
    CHECK(deldrift::in_sphere(2, {1, 0, 0, 0, 1, 1, 0, std::nextafter(1.0, 0)}) == -1);
    CHECK(deldrift::in_sphere(3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, std::nextafter(1.0, 2)}) == -1);
    const std::vector<double> weights{0, 0, 0, 8};
    CHECK(deldrift::in_power_sphere(2, {1, 0, 0, 1, -1, 0, 3, 0}, weights) == 0);
    CHECK(deldrift::in_power_sphere(2, {0, 1, 1, 0, -1, 0, 2, 0}, weights) == -1);
    CHECK_THROWS(deldrift::in_power_sphere(3, std::vector<double>(15), weights), DELDRIFT_WRONG_COUNT,
                 "weights has 4 numbers, but must have 5");
    CHECK_THROWS(deldrift::in_sphere(3, {0, 0, 0}), DELDRIFT_WRONG_COUNT, "points has 3 numbers");
    CHECK_THROWS(deldrift::in_sphere(4, {}), DELDRIFT_INVALID_DIMENSION, "dimension");
}

static void released_cells_stay() {
    Triangulation t(2, points);
    const std::uint32_t *shown = t.cells().vertices().data();
    const Ids before(t.cells().vertices().begin(), t.cells().vertices().end());
    const deldrift::ReleasedCells released = t.release_cells();
    t = Triangulation(2, {});
    CHECK(released.cells().vertices().data() == shown);
    CHECK(std::equal(before.begin(), before.end(), released.cells().vertices().begin()));
}

int main() {
    released_cells_stay();
    vertices_are_found();
    hidden_vertices_are_listed();
    simplices_are_found();
    what_is_in_reach_is_found();
    conflicts_are_what_an_insertion_removes();
    weights_reproduce_a_position();
    flat_cells_are_left_out();
    signs_are_exact();
}
