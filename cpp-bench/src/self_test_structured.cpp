// SPDX-License-Identifier: GPL-3.0-or-later
// The structured point sets are what they are called, and so are their motions.
#include "structured.hpp"
#include "tests.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

namespace bench {
namespace {

const PointSet &point_set(const std::string &name, unsigned dimension) {
    return *std::find_if(point_sets().begin(), point_sets().end(), [&](const PointSet &set) {
        return set.name == name && set.dimension == dimension;
    });
}

SolverPoints drawn(const std::string &name, unsigned dimension, std::size_t n_points) {
    Random random(3);
    return point_set(name, dimension).draw(dimension, n_points, random);
}

double length(const double *vector, unsigned dimension) {
    return std::hypot(vector[0], vector[1], dimension == 3 ? vector[2] : 0);
}

double distance(const std::vector<double> &positions, std::size_t a, std::size_t b, unsigned dimension) {
    double difference[3] = {0, 0, 0};
    for (unsigned axis = 0; axis < dimension; ++axis)
        difference[axis] = positions[a * dimension + axis] - positions[b * dimension + axis];
    return length(difference, dimension);
}

std::vector<double> radii(const SolverPoints &points, unsigned dimension) {
    std::vector<double> radii;
    for (std::size_t at = 0; at < points.positions.size(); at += dimension)
        radii.push_back(length(&points.positions[at], dimension));
    return radii;
}

double greatest_difference(const std::vector<double> &a, const std::vector<double> &b) {
    double greatest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, std::fabs(a[i] - b[i]));
    return greatest;
}

/// How many of the points do not stay.
std::size_t n_moved(const std::vector<double> &from, const std::vector<double> &to, unsigned dimension) {
    std::size_t n = 0;
    for (std::size_t at = 0; at < from.size(); at += dimension)
        n += !std::equal(&from[at], &from[at] + dimension, &to[at]);
    return n;
}

TEST_CASE("lattices") {
    const std::vector<double> grid = drawn("grid", 3, 1'000).positions;
    REQUIRE(grid.size() == 3'000);
    std::set<std::vector<double>> places;
    for (std::size_t at = 0; at < grid.size(); at += 3) places.insert({grid[at], grid[at + 1], grid[at + 2]});
    CHECK_MESSAGE(places.size() == 1'000, "no place is taken twice");
    CHECK(std::all_of(grid.begin(), grid.end(), [](double x) { return x == std::floor(x) && x >= 0 && x <= 9; }));
    CHECK_MESSAGE(drawn("grid", 2, 1'000).positions.size() == 2 * 32 * 32, "the square number that is nearest");

    const SolverPoints tenths = drawn("grid_0.1", 3, 1'000);
    CHECK(tenths.spacing == 0.1);
    for (std::size_t i = 0; i < grid.size(); ++i) REQUIRE(tenths.positions[i] == 0.1 * grid[i]);

    const std::vector<double> rotated = drawn("grid_rotated", 3, 1'000).positions;
    // Distances stay, and no edge is along an axis.
    for (std::size_t i = 1; i < 1'000; ++i) {
        const double expected = distance(tenths.positions, 0, i, 3);
        REQUIRE(distance(rotated, 0, i, 3) == doctest::Approx(expected).epsilon(1e-12));
    }
    for (const std::size_t neighbour : {1, 10, 100})
        for (const unsigned axis : {0, 1, 2}) CHECK(std::fabs(rotated[3 * neighbour + axis] - rotated[axis]) > 0.001);

    const std::vector<double> noisy = drawn("grid_noise", 3, 1'000).positions;
    CHECK(greatest_difference(noisy, grid) < 1.01e-12);
    CHECK(n_moved(noisy, grid, 3) == 1'000);

    const SolverPoints cubic = drawn("face_centred", 3, 4'000);
    REQUIRE(cubic.positions.size() == 12'000);
    // A point inside has 12 neighbours, half a diagonal away.
    const std::size_t inside = 4 * 555;
    std::size_t n_neighbours = 0;
    for (std::size_t i = 0; i < 4'000; ++i) n_neighbours += distance(cubic.positions, inside, i, 3) < 0.8;
    CHECK(n_neighbours == 1 + 12);
}

TEST_CASE("layers") {
    for (const unsigned dimension : {2u, 3u}) {
        const std::vector<double> layers = drawn("layers", dimension, 1'000).positions;
        std::set<double> heights;
        for (std::size_t at = dimension - 1; at < layers.size(); at += dimension) heights.insert(layers[at]);
        const std::size_t side = dimension == 2 ? 32 : 10;
        CHECK_MESSAGE(heights.size() == side, "the points of a layer are coplanar");
        CHECK(*heights.rbegin() == doctest::Approx(0.001 * static_cast<double>(side - 1)));
    }
}

TEST_CASE("spheres and clouds") {
    for (const unsigned dimension : {2u, 3u}) {
        for (const double radius : radii(drawn(dimension == 2 ? "circle" : "sphere", dimension, 500), dimension))
            REQUIRE(std::fabs(radius - 1) < 1e-15);

        const SolverPoints graded = drawn("graded", dimension, 6'000);
        std::size_t by_decade[6] = {};
        for (const double radius : radii(graded, dimension)) ++by_decade[std::lround(-std::log10(radius) - 0.5)];
        for (const std::size_t n : by_decade) CHECK(std::fabs(static_cast<double>(n) - 1'000) < 150);

        const SolverPoints clusters = drawn("clusters", dimension, 1'000);
        for (std::size_t i = 50; i < 1'000; ++i) REQUIRE(distance(clusters.positions, i, i - 50, dimension) < 2e-4);
        CHECK(distance(clusters.positions, 0, 1, dimension) > 0.01);

        for (const SolverPoints *cloud : {&graded, &clusters}) {
            const std::size_t n_points = cloud->positions.size() / dimension;
            CHECK(cloud->local_spacings.size() == n_points);
            CHECK(cloud->elsewhere.size() == n_points / 100 * dimension);
        }
    }
    const std::vector<double> offset = drawn("offset", 3, 1'000).positions;
    CHECK(std::all_of(offset.begin(), offset.end(), [](double x) { return x >= 1e7 && x <= 1e7 + 10; }));
}

TEST_CASE("motions") {
    for (const unsigned dimension : {2u, 3u}) {
        const SolverPoints points = drawn("clusters", dimension, 1'000);
        const std::vector<double> &from = points.positions;
        Random random(4);
        const auto to = [&](Motion motion) { return moved(points, dimension, motion, random); };
        const auto go = [&](const std::vector<double> &there, std::size_t i) {
            double way[3] = {0, 0, 0};
            for (unsigned axis = 0; axis < dimension; ++axis)
                way[axis] = there[i * dimension + axis] - from[i * dimension + axis];
            return length(way, dimension);
        };
        CHECK(to(Motion::rest) == from);
        const std::vector<double> rigid = to(Motion::rigid), translated = to(Motion::translation);
        const std::vector<double> rotated = to(Motion::rotation), sheared = to(Motion::shear);
        for (std::size_t i = 0; i < 1'000; ++i) {
            REQUIRE(go(rigid, i) == doctest::Approx(0.001 * points.spacing));
            REQUIRE(go(translated, i) == doctest::Approx(10 * points.spacing));
            REQUIRE(go(sheared, i) == doctest::Approx(0.001 * from[i * dimension + 1]));
            const double expected = distance(from, 0, i, dimension);
            REQUIRE(std::fabs(distance(rotated, 0, i, dimension) - expected) < 1e-15);
        }
        CHECK(n_moved(rotated, from, dimension) == 1'000);
        CHECK(n_moved(to(Motion::teleport), from, dimension) == 10);
        const std::vector<double> half = to(Motion::half);
        CHECK(n_moved(half, from, dimension) == 500);
        CHECK(go(half, 998) == doctest::Approx(0.01 * points.local_spacings[998]));
        CHECK(to(Motion::scaling)[7] == 1.001 * from[7]);
    }
}

TEST_CASE("structured lines") {
    Progress progress(Progress::Output::silent);
    Preset preset{};
    preset.structured_sizes = {200};
    preset.has_all_point_sets = true;
    std::vector<Checks> checks;
    const std::vector<StructuredLine> lines = measure_structured(preset, {}, 1, checks, progress);
    std::size_t expected = 2;
    std::size_t n_comparisons = 0;
    for (const PointSet &set : point_sets()) expected += 1 + set.motions.size();
    for (const Checks &check : checks) n_comparisons += check.n_comparisons;
    CHECK(lines.size() == expected);
    CHECK_MESSAGE(n_comparisons == expected - 2 - point_sets().size(), "cells are compared after every motion");
    for (const StructuredLine &line : lines) {
        CAPTURE(line.points);
        CAPTURE(line.timed);
        CHECK(line.cgal_ns > 0);
        CHECK(line.deldrift_ns > 0);
    }

    std::ostringstream table;
    print_structured(table, lines);
    CHECK(table.str().find("3D layers") != std::string::npos);
    const Folder folder;
    CHECK(write_structured(folder.file(""), preset, lines) == folder.file("") + "/structured_full.csv");
    std::ifstream file(folder.file("structured_full.csv"));
    const auto n_lines = std::count(std::istreambuf_iterator<char>(file), {}, '\n');
    CHECK(static_cast<std::size_t>(n_lines) == 1 + expected);

    const std::size_t n_circle = 2 + point_set("circle", 2).motions.size() + 1;
    CHECK(measure_structured(preset, {"circle"}, 1, checks, progress).size() == n_circle);
}

}  // namespace
}  // namespace bench
