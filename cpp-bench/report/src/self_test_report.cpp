// SPDX-License-Identifier: GPL-3.0-or-later
#include "arbiter.hpp"
#include "ball_cell.hpp"
#include "body.hpp"
#include "csv.hpp"
#include "disk_cell.hpp"
#include "engine.hpp"
#include "random.hpp"
#include "record.hpp"
#include "replay_in_turns.hpp"
#include "report_statistics.hpp"
#include "report_tolerance.hpp"
#include "report_scenarios.hpp"
#include "scenarios.hpp"
#include "solid.hpp"
#include "tests.hpp"
#include "verify.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <type_traits>

namespace bench {
namespace {

/// Centroid of a density over the part of a disk that is nearest to one site, by a fine lattice.
Point2 brute_force_centroid(const std::vector<Point2> &sites, std::size_t which, double radius,
                            const Density &density) {
    constexpr int n = 1500;
    double mass = 0, x = 0, y = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Point2 p{radius * (2 * (i + 0.5) / n - 1), radius * (2 * (j + 0.5) / n - 1)};
            if (p[0] * p[0] + p[1] * p[1] > radius * radius) continue;
            const auto squared = [&](const Point2 &q) {
                return std::pow(p[0] - q[0], 2) + std::pow(p[1] - q[1], 2);
            };
            if (std::any_of(sites.begin(), sites.end(),
                            [&](const Point2 &other) { return squared(other) < squared(sites[which]); }))
                continue;
            const double weight = density.value(p[0], p[1]);
            mass += weight;
            x += weight * p[0];
            y += weight * p[1];
        }
    return {x / mass, y / mass};
}

TEST_CASE("densities") {
    constexpr double radius = 3;
    Random random(11);
    std::vector<Point2> sites(9);
    for (Point2 &site : sites) random.in_ball(2, radius, site.data());
    for (const Density &density : lloyd_densities())
        for (const std::size_t which : {std::size_t{0}, std::size_t{4}}) {
            Polygon cell = square(2 * radius);
            for (std::size_t other = 0; other < sites.size(); ++other)
                if (other != which) clip_to_bisector(cell, sites[which], sites[other]);
            const AreaAndCentroid found = intersect_disk(cell, radius, sites[which], density.value);
            const Point2 wanted = brute_force_centroid(sites, which, radius, density);
            CAPTURE(density.name);
            CHECK(std::hypot(found.centroid[0] - wanted[0], found.centroid[1] - wanted[1]) < 3e-3);
        }
    const auto one = [](double, double) { return 1.0; };
    Polygon half = square(6);
    clip_to_bisector(half, {1, 0}, {-1, 0});
    const AreaAndCentroid exact = intersect_disk(half, 3);
    const AreaAndCentroid found = intersect_disk(half, 3, {1, 0.5}, one);
    // For density 1, quadrature gives the closed form.
    CHECK(std::fabs(found.area - exact.area) < 1e-9);
    CHECK(std::fabs(found.centroid[0] - exact.centroid[0]) < 1e-9);
}

TEST_CASE("ball cells") {
    BallCells cells(2, 20'000);
    const double pi = std::acos(-1.0);
    const double centre[3] = {0.5, 0.1, -0.2}, mirrored[3] = {-0.5, 0.1, -0.2};
    VolumeAndCentroid cell = cells.cell(centre, {});
    // A single cell is the ball.
    CHECK(std::fabs(cell.volume / (32 * pi / 3) - 1) < 1e-3);
    CHECK(std::fabs(cell.centroid[0]) < 1e-3);
    cell = cells.cell(centre, {mirrored});
    // The centroid of half a ball.
    CHECK(std::fabs(cell.volume / (16 * pi / 3) - 1) < 1e-3);
    CHECK(std::fabs(cell.centroid[0] - 0.75) < 2e-3);
}

/// The mean of circumcentres weighted by volumes, term by term.
Vector3 direct_odt(const Vector3 &vertex, const std::vector<const double *> &star) {
    Vector3 sum{};
    double volume = 0;
    for (std::size_t i = 0; i < star.size(); i += 3) {
        const std::array<Vector3, 4> corner = {vertex, vector(star[i]), vector(star[i + 1]),
                                               vector(star[i + 2])};
        const double part =
            std::fabs(dot(corner[1] - vertex, cross(corner[2] - vertex, corner[3] - vertex))) / 6;
        sum = sum + part * circumcentre(corner);
        volume += part;
    }
    return (1 / volume) * sum;
}

TEST_CASE("odt") {
    // A regular octahedron's corners around a vertex: its mean is the centre.
    const double corners[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    std::vector<const double *> star;
    for (const int x : {0, 1})
        for (const int y : {2, 3})
            for (const int z : {4, 5}) star.insert(star.end(), {corners[x], corners[y], corners[z]});
    const double off_centre[3] = {0.2, -0.1, 0.15};
    double place[3];
    CHECK_MESSAGE(odt_place(off_centre, star, place), "a star with volume has a place");
    const Vector3 direct = direct_odt(vector(off_centre), star);
    for (const int axis : {0, 1, 2}) CHECK(std::fabs(place[axis] - direct[axis]) < 1e-12);
    const double centre[3] = {0, 0, 0};
    odt_place(centre, star, place);
    for (const int axis : {0, 1, 2}) CHECK(std::fabs(place[axis]) < 1e-12);
    const double flat[3] = {2, 2, 2};
    CHECK_MESSAGE(!odt_place(flat, {flat, flat, flat}, place), "a star without volume has none");
}

double path_length(const Series &series, std::size_t timestamp) {
    double sum = 0;
    for (std::size_t i = 0; i < series.frame_length(); ++i)
        sum += std::fabs(series.frame(timestamp)[i] - series.frame(timestamp - 1)[i]);
    return sum;
}

TEST_CASE("recorded points come to rest and stay inside") {
    Progress progress(Progress::Output::silent);
    const Series slloyd = record_slloyd(300, 15, 5, progress);
    CHECK(path_length(slloyd, 15) < path_length(slloyd, 1) / 3);
    const Series snodt = record_snodt(300, 15, 5, progress);
    CHECK(path_length(snodt, 15) < path_length(snodt, 1) / 3);
    CHECK_MESSAGE(snodt.is_sequential, "vertices move one after another");
    CHECK_MESSAGE(record_snodt(300, 3, 5, progress).frame(3)[299] == snodt.frame(3)[299],
                  "the same seed gives the same positions");
    const double radius = unit_density_radius(3, 300);
    double farthest = 0;
    for (std::size_t i = 0; i < snodt.positions.size(); i += 3)
        farthest = std::max(farthest,
                            std::hypot(snodt.positions[i], snodt.positions[i + 1], snodt.positions[i + 2]));
    CHECK_MESSAGE(farthest < radius * (1 + 1e-12), "no point leaves the ball");

    const Series walk = record_segments("walk_2d", 2, 200, {0.01, 0.02}, 3, 5, progress);
    // All begin at the same points.
    REQUIRE(walk.segments.size() == 2);
    CHECK(walk.segments[1].begin == 8);
    CHECK(walk.segments[1].first == 11);
    CHECK(walk.segments[1].last == 13);
    CHECK(std::equal(walk.frame(0), walk.frame(1), walk.frame(7)));
    const double *from = walk.frame(7), *to = walk.frame(8);
    CHECK(std::fabs(std::hypot(to[0] - from[0], to[1] - from[1]) - 0.02) < 1e-12);
    for (const Density &density : lloyd_densities()) {
        const Series lloyd = record_lloyd_2d(density, 150, 20, 5, progress);
        CAPTURE(density.name);
        CHECK(path_length(lloyd, 20) < path_length(lloyd, 1) / 3);
    }
}

TEST_CASE("body") {
    Body body = Body::generate();
    body.scale_to_volume(500);
    CHECK_MESSAGE(std::fabs(body.volume() - 500) < 1e-9, "it has the volume it was given");
    Random random(3);
    std::size_t n_inside = 0, n = 0;
    double least[3] = {0, 0, 0}, greatest[3] = {0, 0, 0};
    for (const Vector3 &p : body.surface_points(400, random))
        for (int axis = 0; axis < 3; ++axis) {
            least[axis] = std::min(least[axis], p[axis]);
            greatest[axis] = std::max(greatest[axis], p[axis]);
        }
    for (; n < 40'000; ++n) {
        double p[3];
        for (int axis = 0; axis < 3; ++axis)
            p[axis] = least[axis] + random.unit() * (greatest[axis] - least[axis]);
        n_inside += body.contains(p);
    }
    const double box = (greatest[0] - least[0]) * (greatest[1] - least[1]) * (greatest[2] - least[2]);
    CHECK_MESSAGE(std::fabs(box * static_cast<double>(n_inside) / static_cast<double>(n) / 500 - 1) < 0.05,
                  "the share of a box inside is its volume");

    const Folder folder;
    const std::string path = folder.file("body.off");
    const std::string tetrahedron = "OFF # a comment\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
    std::ofstream(path) << tetrahedron << "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
    const Body small = Body::load(path);
    const double inside[3] = {0.2, 0.2, 0.2}, outside[3] = {0.5, 0.5, 0.5};
    // A tetrahedron from a file.
    CHECK(std::fabs(small.volume() - 1.0 / 6) < 1e-15);
    CHECK(small.contains(inside));
    CHECK(!small.contains(outside));
    std::ofstream(path) << tetrahedron << "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 2 1\n";
    CHECK_THROWS_WITH(Body::load(path), Contains("not closed"));
    std::ofstream(path) << tetrahedron << "3 0 2 1\n";
    CHECK_THROWS_WITH(Body::load(path), Contains("cut short"));
    CHECK_THROWS_WITH(Body::load(folder.file("none.off")), Contains("cannot be opened"));
}

TEST_CASE_TEMPLATE("tolerances", Dimension, std::integral_constant<unsigned, 2>, std::integral_constant<unsigned, 3>) {
    constexpr unsigned dimension = Dimension::value;
    Random random(5);
    const CoordinateBound bound(8);
    double greatest_excess = 0;
    std::size_t n_certain = 0, n_wide = 0;
    for (int i = 0; i < 20'000; ++i) {
        BicellPoints<dimension> bicell;
        const auto draw = [&](Place<dimension> &p) {
            for (double &coordinate : p) coordinate = 5 + random.symmetric(1.0);
        };
        for (auto &p : bicell.facet) draw(p);
        for (auto &p : bicell.opposing) draw(p);
        const std::array<Bounded, dimension> centre = annulus_centre<dimension>(bicell, bound);
        if (!std::isfinite(centre[0].error) || !std::isfinite(centre[dimension - 1].error)) continue;
        // The width seen from the computed centre, in long double, is right to the errors of the centre.
        const auto distance = [&](const Place<dimension> &p) {
            long double sum = 0;
            for (unsigned axis = 0; axis < dimension; ++axis) {
                const long double difference = static_cast<long double>(p[axis]) - centre[axis].value;
                sum += difference * difference;
            }
            return std::sqrt(sum);
        };
        const long double half = (distance(bicell.opposing[0]) - distance(bicell.facet[0])) / 2;
        const double lower = squared_half_annulus_width<dimension>(bicell, bound);
        if (half > 0.01L) ++n_wide;
        if (lower == 0) continue;
        ++n_certain;
        greatest_excess =
            std::max(greatest_excess, static_cast<double>(std::sqrt(static_cast<long double>(lower)) - half));
    }
    CHECK_MESSAGE(greatest_excess <= 0, "a lower bound of half the width");
    CHECK_MESSAGE(n_certain > n_wide * 9 / 10, "nearly every wide annulus is certain");
}

TEST_CASE("simplex widths") {
    const CoordinateBound bound(2);
    const double triangle = squared_half_simplex_width<2>({{{0, 0}, {1, 0}, {0.5, 0.3}}}, bound);
    CHECK_MESSAGE(std::fabs(std::sqrt(triangle) - 0.15) < 1e-9, "half the least height of a triangle");
    const double flat =
        squared_half_simplex_width<3>({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0.1}}}, bound);
    CHECK_MESSAGE(std::fabs(std::sqrt(flat) - 0.05) < 1e-9, "half the least height of a tetrahedron");
    // Two crossing edges, one above the other: nearer to each other than any corner to its facet.
    const double sliver =
        squared_half_simplex_width<3>({{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0.1}, {0, 1, 0.1}}}, bound);
    CHECK_MESSAGE(std::fabs(std::sqrt(sliver) - 0.05) < 1e-9, "half the distance of opposite edges");
    CHECK_MESSAGE(squared_half_simplex_width<2>({{{0, 0}, {1, 1}, {2, 2}}}, bound) == 0, "a flat triangle has none");
}

/// Proposition 1's gap: five points, three cells around the edge of the first two, which is not Delaunay
/// where the others are far enough in.
TEST_CASE("gap") {
    std::vector<double> places = {0, 0, 1, 0, 0, -1};
    for (int i = 0; i < 3; ++i) {
        const double angle = 2 * std::acos(-1.0) * i / 3;
        places.insert(places.end(), {0.9 * std::cos(angle), 0.9 * std::sin(angle), 0});
    }
    const CellSet around_edge = {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 1, 3, 4}};
    const CellSet delaunay = {{0, 2, 3, 4}, {1, 2, 3, 4}};
    // Three cells around an edge that should not be there are explained.
    CHECK(gap_cells(places.data(), around_edge, delaunay).is_explained);
    CHECK(gap_cells(places.data(), around_edge, delaunay).n_cells == 3);
    for (std::size_t i = 6; i < places.size(); ++i) places[i] *= 1.3;
    CHECK_MESSAGE(!gap_cells(places.data(), delaunay, around_edge).is_explained,
                  "a facet that the opposing vertices see through is not");
    CHECK_MESSAGE(!gap_cells(places.data(), {around_edge[0], around_edge[1]}, around_edge).is_explained,
                  "a missing cell is not");
}

std::vector<std::size_t> timestamps_of(const Series &series) {
    std::vector<std::size_t> timestamps;
    for (const Segment &segment : series.segments)
        for (std::size_t t = segment.first; t <= segment.last; ++t) timestamps.push_back(t);
    if (series.segments.empty())
        for (std::size_t t = 1; t <= series.n_timestamps(); ++t) timestamps.push_back(t);
    return timestamps;
}

/// Every engine has CGAL's cells at every timestamp of every kind of input.
TEST_CASE("replay") {
    Progress progress(Progress::Output::silent);
    const Series inputs[] = {
        record_lloyd_2d_uniform(200, 40, 5, progress),
        record_lloyd_2d(lloyd_densities()[1], 200, 40, 5, progress),
        record_slloyd(200, 12, 5, progress),
        record_snodt(200, 12, 5, progress),
        record_segments("share_2d", 2, 200, {0.001, 0.01, 0.1}, 4, 5, progress),
        record_segments("share_3d", 3, 200, {0.001, 0.01, 0.1}, 3, 5, progress),
    };
    for (const Series &series : inputs) {
        const std::vector<std::size_t> all = timestamps_of(series);
        std::vector<Entrant> entrants;
        for (const EngineKind &kind : engine_kinds()) entrants.push_back({&kind, 1, all});
        Checks checks;
        CAPTURE(series.name);
        const std::vector<UpdateTimes> times = replay_in_turns(series, entrants, all, 1, checks, progress);
        CHECK(times.size() == entrants.size());
        CHECK(times.at(3).size() == all.size());
        CHECK(checks.n_comparisons == all.size() * entrants.size());
    }
}

/// A file that grows.
TEST_CASE("csv") {
    const Folder folder;
    const std::string path = folder.file("growing.csv");
    CsvFile file(path, {"a", "b"});
    file.add({"x", ""});
    file.save();
    const CsvFile again(path, {"a", "b"});
    // What is saved is read.
    CHECK(again.lines() == std::vector<CsvFile::Line>{{"x", ""}});
    CHECK(again.has({"x"}));
    CHECK(!again.has({"y"}));
    CHECK_MESSAGE(CsvFile(path, {"a", "c"}).lines().empty(), "other columns are another file");
}

}  // namespace

}  // namespace bench
