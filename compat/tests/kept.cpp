// Which triangulations are kept, and that they are brought to the points of every call: the cells are always those of a
// new triangulation. Uses the parts of the library that programs do not see.
#include "../src/kept.hpp"

#include <cmath>
#include <thread>

#include "check.hpp"

namespace {

using compat::Borrowed;
using compat::How;

// Takes the triangulation of the points, checks its cells, and keeps it; how it was come by.
How take(unsigned dimension, const Points &points) {
    const Borrowed borrowed(dimension, points.data(), points.size() / dimension);
    CHECK(borrowed.status() == DELDRIFT_OK);
    deldrift_cells_view view{};
    CHECK(deldrift_cells(borrowed.get(), &view) == DELDRIFT_OK);
    CellSet cells;
    for (std::size_t c = 0; c < view.count; c++)
        insert_cell(cells, view.vertices + c * (dimension + 1), dimension + 1, 0u);
    CHECK(cells == fresh_cells(dimension, points));
    return borrowed.how();
}

Points without(const Points &points, unsigned dimension, std::size_t first, std::size_t step) {
    Points result;
    for (std::size_t i = 0; i < points.size() / dimension; i++)
        if (i < first || (i - first) % step != 0)
            result.insert(result.end(), points.begin() + static_cast<std::ptrdiff_t>(i * dimension),
                          points.begin() + static_cast<std::ptrdiff_t>((i + 1) * dimension));
    return result;
}

void append(Points &points, const Points &more) { points.insert(points.end(), more.begin(), more.end()); }

void points_that_move_are_followed() {
    for (const unsigned dimension : {2u, 3u}) {
        Points points = random_points(dimension, 1000, dimension);
        CHECK(take(dimension, points) == How::built);
        for (unsigned step = 0; step < 5; step++) {
            points = moved(points, 0.002, step);
            CHECK(take(dimension, points) == How::moved);
        }
    }
}

void point_sets_that_alternate_are_kept_apart() {
    std::vector<Points> sets;
    for (unsigned seed = 0; seed < 4; seed++) sets.push_back(random_points(2, 800, 100 + seed));
    sets.push_back(random_points(3, 800, 110));
    for (const Points &points : sets) CHECK(take(points.size() == 2400 ? 3 : 2, points) == How::built);
    for (unsigned step = 0; step < 3; step++) {
        for (Points &points : sets) {
            points = moved(points, 0.001, step);
            CHECK(take(points.size() == 2400 ? 3 : 2, points) == How::moved);
        }
    }
}

void points_that_come_and_go_are_matched() {
    for (const unsigned dimension : {2u, 3u}) {
        Points points = random_points(dimension, 1500, 200 + dimension);
        CHECK(take(dimension, points) == How::built);
        points = moved(without(points, dimension, 7, 100), 0.001, 1);
        CHECK(take(dimension, points) == How::edited);
        append(points, random_points(dimension, 20, 300));
        CHECK(take(dimension, points) == How::edited);
        // As many as before, but not the same.
        points = without(points, dimension, 5, 30);
        append(points, random_points(dimension, 1505 - points.size() / dimension, 302));
        CHECK(take(dimension, points) == How::edited);
        points = moved(without(points, dimension, 3, 60), 0.001, 2);
        append(points, random_points(dimension, 50, 301));
        CHECK(take(dimension, points) == How::edited);
        // Afterwards its ids are 0, 1, ... again.
        CHECK(take(dimension, moved(points, 0.001, 3)) == How::moved);
    }
}

void point_sets_that_alternate_are_matched() {
    std::vector<Points> sets;
    for (unsigned seed = 0; seed < 3; seed++) {
        sets.push_back(random_points(2, 900 + seed, 900 + seed));
        CHECK(take(2, sets.back()) == How::built);
    }
    for (unsigned step = 0; step < 3; step++) {
        for (Points &points : sets) {
            points = moved(without(points, 2, 4, 300), 0.001, step);
            CHECK(take(2, points) == How::edited);
        }
    }
}

// On a lattice the cells follow from ties alone, which are broken by id.
void ties_do_not_depend_on_the_history() {
    Points points = lattice_points(2, 900, 40, 5);
    CHECK(take(2, points) == How::built);
    points = without(points, 2, 10, 90);
    take(2, points);
    append(points, lattice_points(2, 30, 40, 6));
    take(2, points);
    take(2, without(points, 2, 0, 45));
}

// A point in the middle would need an id between two others.
void an_insertion_in_the_middle_builds_again() {
    Points points = random_points(2, 700, 400);
    CHECK(take(2, points) == How::built);
    const Points more = random_points(2, 1, 401);
    points.insert(points.begin() + 600, more.begin(), more.end());
    CHECK(take(2, points) == How::built);
}

void other_points_build_again() {
    CHECK(take(2, random_points(2, 600, 500)) == How::built);
    CHECK(take(2, random_points(2, 600, 501)) == How::built);
    CHECK(take(2, random_points(2, 610, 502)) == How::built);
    CHECK(take(2, random_points(2, 20, 503)) == How::built);
    CHECK(take(2, random_points(2, 20, 503)) == How::built);
}

void what_was_not_used_for_longest_is_dropped() {
    for (unsigned seed = 0; seed < 9; seed++) take(2, random_points(2, 300, 600 + seed));
    CHECK(take(2, random_points(2, 300, 600)) == How::built);
    CHECK(take(2, random_points(2, 300, 608)) == How::moved);
}

void bad_points_leave_a_message() {
    Points points = random_points(2, 500, 700);
    take(2, points);
    points[33] = HUGE_VAL;
    const Borrowed borrowed(2, points.data(), 500);
    CHECK(borrowed.status() == DELDRIFT_NOT_FINITE);
}

void threads_have_triangulations_of_their_own() {
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < 4; t++)
        threads.emplace_back([t] {
            // Two threads with the same points, two with others.
            Points points = random_points(2, 500, 800 + t / 2);
            for (unsigned step = 0; step < 20; step++) {
                take(2, points);
                points = moved(points, 0.002, step);
            }
        });
    for (std::thread &thread : threads) thread.join();
}

} // namespace

int main() {
    points_that_move_are_followed();
    point_sets_that_alternate_are_kept_apart();
    points_that_come_and_go_are_matched();
    point_sets_that_alternate_are_matched();
    ties_do_not_depend_on_the_history();
    an_insertion_in_the_middle_builds_again();
    other_points_build_again();
    what_was_not_used_for_longest_is_dropped();
    bad_points_leave_a_message();
    threads_have_triangulations_of_their_own();
}
