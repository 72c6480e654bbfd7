// SPDX-License-Identifier: GPL-3.0-or-later
#define DOCTEST_CONFIG_IMPLEMENT
#include "tests.hpp"

#include "arbiter.hpp"
#include "cells.hpp"
#include "disk_cell.hpp"
#include "engine.hpp"
#include "measure.hpp"
#include "npy.hpp"
#include "options.hpp"
#include "random.hpp"
#include "record.hpp"
#include "scenarios.hpp"
#include "self_test.hpp"
#include "table.hpp"
#include "verify.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace bench {
namespace {

std::string contents(const std::string &path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void put(const std::string &path, const std::string &bytes) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string replaced(std::string text, const std::string &from, const std::string &to) {
    return text.replace(text.find(from), from.size(), to);
}

TEST_CASE("npy") {
    const Folder folder;
    const std::string path = folder.file("series.npy");
    const NpyArray array{{2, 3, 2}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 1.0 / 3}};
    write_npy(path, array);
    const NpyArray read = read_npy(path);
    // What is written is read.
    CHECK(read.shape == array.shape);
    CHECK(read.values == array.values);
    const std::string bytes = contents(path);
    CHECK_MESSAGE((bytes.size() - 12 * 8) % 64 == 0, "data are aligned as the format asks");

    put(path, bytes.substr(0, bytes.size() - 1));
    CHECK_THROWS_WITH(read_npy(path), Contains("truncated: 12 numbers announced, 11 present"));
    put(path, bytes.substr(0, 40));
    CHECK_THROWS_WITH(read_npy(path), Contains("truncated inside its header"));
    put(path, "PK" + bytes.substr(2));
    CHECK_THROWS_WITH(read_npy(path), Contains("not a .npy file"));
    put(path, replaced(bytes, "False", "True "));
    CHECK_THROWS_WITH(read_npy(path), Contains("not in C order"));
    put(path, replaced(bytes, "<f8", "<i8"));
    CHECK_THROWS_WITH(read_npy(path), Contains("only '<f8' and '<f4'"));
    put(path, replaced(bytes, "<f8", ">f8"));
    CHECK_THROWS_WITH(read_npy(path), Contains("only '<f8' and '<f4'"));
    CHECK_THROWS_WITH(read_npy(folder.file("none.npy")), Contains("cannot be opened"));

    const float narrow[12] = {0.5f, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, -0.1f};
    put(path, replaced(bytes.substr(0, bytes.size() - 96), "<f8", "<f4") +
                  std::string(reinterpret_cast<const char *>(narrow), sizeof narrow));
    const NpyArray widened = read_npy(path);
    CHECK_MESSAGE(std::equal(widened.values.begin(), widened.values.end(), narrow, narrow + 12), "f32 is widened");
}

TEST_CASE("series files") {
    const Folder folder;
    const std::string path = folder.file("frames.npy");
    write_npy(path, {{2, 3, 2}, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 2}});
    const Series series = load_series(path);
    // Frames, points and dimension come from the shape, the name from the file.
    CHECK(series.name == "frames");
    CHECK(series.dimension == 2);
    CHECK(series.n_points == 3);
    CHECK(series.n_timestamps() == 1);
    CHECK(series.frame(1)[5] == 2);
    write_npy(path, {{3, 4}, std::vector<double>(12, 0.0)});
    CHECK_THROWS_WITH(load_series(path), Contains("has shape 3 x 4"));
    write_npy(path, {{2, 0, 2}, {}});
    CHECK_THROWS_WITH(load_series(path), Contains("has shape 2 x 0 x 2"));
    write_npy(path, {{1, 2, 2}, {0, 0, 1, std::nan("")}});
    CHECK_THROWS_WITH(load_series(path), Contains("frame 0, point 1"));

    const std::string displacement_path = folder.file("displacement.npy");
    write_npy(path, {{2, 3}, {0, 0, 0, 1, 1, 1}});
    write_npy(displacement_path, {{2, 3}, {4, 0, 0, 0, 0, -4}});
    const Series displaced = load_displacement(path, displacement_path, 4);
    // Displacements are applied in equal steps.
    CHECK(displaced.n_frames() == 5);
    CHECK(displaced.frame(1)[0] == 1);
    CHECK(displaced.frame(4)[5] == -3);
    Series tiny = displaced;
    tiny.positions[0] = -1e-64;
    tiny.positions[1] = 1e-42;
    // Coordinates below a magnitude become 0.
    CHECK(snap(tiny, 1e-42) == 1);
    CHECK(tiny.positions[0] == 0);
    CHECK(tiny.positions[1] == 1e-42);
    write_npy(displacement_path, {{3, 2}, std::vector<double>(6, 0.0)});
    CHECK_THROWS_WITH(load_displacement(path, displacement_path, 4), Contains("differ in shape"));
}

TEST_CASE("cells") {
    const std::vector<double> places = {0, 0, 1, 0, 0, 1, 1, 0, -0.0, 0};
    const std::vector<std::uint32_t> lowest = representatives(2, places.data(), 5);
    CHECK_MESSAGE(lowest == std::vector<std::uint32_t>({0, 1, 2, 1, 0}), "coincident points have one representative");
    CHECK(canonical(2, {2, 4, 3}, lowest) == CellSet{{0, 1, 2, no_vertex}});
    CHECK_THROWS_WITH(canonical(2, {0, 1, 2, 4, 3, 2}, lowest), Contains("comes twice"));
    CHECK_THROWS_WITH(canonical(2, {0, 1, 3}, lowest), Contains("has a vertex twice"));
    CHECK_THROWS_WITH(canonical(2, {0, 1, 7}, lowest), Contains("vertex 7 of 5"));
    CHECK_THROWS_WITH(canonical(2, {0, 1}, lowest), Contains("incomplete"));
}

TEST_CASE("arbiter") {
    const CellSet diagonal_02 = {{0, 1, 2, no_vertex}, {0, 2, 3, no_vertex}};
    const CellSet diagonal_13 = {{0, 1, 3, no_vertex}, {1, 2, 3, no_vertex}};

    const std::vector<double> square = {0, 0, 1, 0, 1, 1, 0, 1};
    Verdict verdict = compare(2, square.data(), diagonal_02, "a", diagonal_13, "b");
    // Both diagonals of a square are right.
    CHECK(verdict.is_accepted);
    CHECK(verdict.n_degenerate == 2);
    verdict = compare(2, square.data(), diagonal_02, "a", {{0, 1, 2, no_vertex}}, "b");
    CHECK_MESSAGE(!verdict.is_accepted, "half of a square is not the square");

    std::vector<double> nearly = square;
    nearly[4] = std::nextafter(1.0, 2.0);
    verdict = compare(2, nearly.data(), diagonal_02, "a", diagonal_13, "b");
    // One unit in the last place decides the diagonal.
    CHECK(!verdict.is_accepted);
    CHECK(verdict.complaint.find("inside") != std::string::npos);

    const std::vector<double> grid = {0, 0, 1, 0, 1, 1, 0, 1, 2, 0, 2, 1};
    const CellSet whole = {{0, 1, 2, no_vertex}, {0, 2, 3, no_vertex}, {1, 2, 4, no_vertex}, {2, 4, 5, no_vertex}};
    const CellSet holed = {{0, 1, 3, no_vertex}, {1, 2, 3, no_vertex}, {1, 4, 5, no_vertex}};
    verdict = compare(2, grid.data(), holed, "a", whole, "b");
    CHECK_MESSAGE(!verdict.is_accepted, "a hole among cocircular points is found");

    const std::vector<double> cube = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    const CellSet five = {{0, 1, 2, 5}, {0, 2, 3, 7}, {0, 2, 5, 7}, {0, 4, 5, 7}, {2, 5, 6, 7}};
    const CellSet other_five = {{0, 1, 3, 4}, {1, 2, 3, 6}, {1, 3, 4, 6}, {1, 4, 5, 6}, {3, 4, 6, 7}};
    verdict = compare(3, cube.data(), five, "a", other_five, "b");
    // A cube has more than one triangulation.
    CHECK(verdict.is_accepted);
    CHECK(verdict.n_degenerate == 5);
    CellSet with_flat = other_five;
    with_flat.insert(with_flat.begin(), {0, 1, 2, 3});
    verdict = compare(3, cube.data(), five, "a", with_flat, "b");
    // A flat cell is not excused.
    CHECK(!verdict.is_accepted);
    CHECK(verdict.complaint.find("flat") != std::string::npos);
}

Series random_series(unsigned dimension, std::size_t n_points, std::size_t n_timestamps) {
    Series series = uniform_points(dimension, n_points, 7);
    Random random(8);
    for (std::size_t i = 0; i < n_timestamps * n_points * dimension; ++i)
        series.positions.push_back(series.positions[i] + random.symmetric(0.05));
    return series;
}

/// Points of a small grid that wander from node to node: cocircular and coincident throughout, some unmoved.
Series grid_series(unsigned dimension, std::size_t n_points, std::size_t n_timestamps) {
    Series series = random_series(dimension, n_points, n_timestamps);
    for (double &coordinate : series.positions) coordinate = std::floor(coordinate * 6);
    return series;
}

TEST_CASE("engines agree") {
    for (const unsigned dimension : {2u, 3u})
        for (const bool is_grid : {false, true}) {
            const Series series = is_grid ? grid_series(dimension, 120, 12) : random_series(dimension, 120, 12);
            CAPTURE(dimension);
            CAPTURE(is_grid);
            std::vector<Entrant> entrants;
            // The report's algorithms know no coincident points.
            for (const EngineKind &kind : engine_kinds())
                if (!is_grid || !kind.is_reproduction) entrants.push_back({&kind, 1, every_timestamp(series)});
            Progress progress(Progress::Output::silent);
            const Checks checks = verify(series, entrants, every_timestamp(series), progress);
            CHECK(checks.n_timestamps == 12);
            CHECK(checks.n_comparisons == 12 * entrants.size());
            CHECK((checks.n_degenerate > 0) == is_grid);
            CHECK((checks.n_coincident > 0) == is_grid);
            CHECK(checks.n_cells > 12);
        }
}

enum class Fault { wrong_corner, missing_cell, stale_positions, failing_validation };

/// A real engine with one fault, at timestamp 3 and from then on.
template <Fault fault>
class Faulty final : public Engine {
public:
    explicit Faulty(std::unique_ptr<Engine> real) : real_(std::move(real)) {}

    void prepare(const double *positions, std::size_t n) override {
        if (!is_stale()) real_->prepare(positions, n);
    }
    void build(const double *positions, std::size_t n) override { real_->build(positions, n); }
    void advance(const double *positions) override {
        if (++n_advances_ < 3 || fault != Fault::stale_positions) real_->advance(positions);
    }
    void validate() override {
        if (fault == Fault::failing_validation && n_advances_ >= 3)
            throw std::runtime_error("facet 5 is not Delaunay");
    }
    std::vector<std::uint32_t> cells() override {
        std::vector<std::uint32_t> cells = real_->cells();
        if (n_advances_ < 3) return cells;
        if (fault == Fault::wrong_corner) replace_corner(cells);
        if (fault == Fault::missing_cell) cells.resize(cells.size() - cells.size() / n_cells(cells));
        return cells;
    }

private:
    bool is_stale() const { return fault == Fault::stale_positions && n_advances_ >= 2; }

    /// These tests are in the plane.
    static std::size_t n_cells(const std::vector<std::uint32_t> &cells) { return cells.size() / 3; }

    static void replace_corner(std::vector<std::uint32_t> &cells) {
        std::uint32_t other = 0;
        while (std::find(cells.begin(), cells.begin() + 3, other) != cells.begin() + 3) ++other;
        cells[1] = other;
    }

    std::unique_ptr<Engine> real_;
    unsigned n_advances_ = 0;
};

TEST_CASE_TEMPLATE("faults are found", FaultyEngine, Faulty<Fault::wrong_corner>, Faulty<Fault::missing_cell>,
                   Faulty<Fault::stale_positions>, Faulty<Fault::failing_validation>) {
    std::vector<EngineKind> kinds = {engine_kind("cgal/rebuilding"), engine_kind("deldrift/rebuilding")};
    for (EngineKind &kind : kinds) {
        kind.is_stateless = false;
        kind.make = [make = kind.make](unsigned dimension, unsigned n_threads) {
            return std::make_unique<FaultyEngine>(make(dimension, n_threads));
        };
    }
    const Series series = random_series(2, 100, 4);
    for (const EngineKind &kind : kinds) {
        CAPTURE(kind.engine);
        const std::vector<Entrant> entrants = {{&kind, 1, every_timestamp(series)}};
        Progress progress(Progress::Output::silent);
        CHECK_THROWS_WITH(verify(series, entrants, every_timestamp(series), progress),
                          Contains("static_2d, timestamp 3: "));
        CHECK_NOTHROW(verify(series, entrants, {1, 2}, progress));
    }
}

TEST_CASE("disk cells") {
    const auto near = [](double value) { return doctest::Approx(value).epsilon(1e-12); };
    const double pi = std::acos(-1.0);
    AreaAndCentroid cell = intersect_disk(square(0.5), 1);
    // A square inside is itself.
    CHECK(cell.area == near(1));
    CHECK(cell.centroid[0] == near(0));
    cell = intersect_disk(square(3), 2);
    // A square around it gives the disk.
    CHECK(cell.area == near(4 * pi));
    CHECK(cell.centroid[1] == near(0));

    Polygon half = square(3);
    clip_to_bisector(half, {1, 0}, {-1, 0});
    cell = intersect_disk(half, 2);
    // The centroid of half a disk.
    CHECK(cell.area == near(2 * pi));
    CHECK(cell.centroid[0] == near(8 / (3 * pi)));
    CHECK(cell.centroid[1] == near(0));
    // A triangle outside has no area.
    CHECK(intersect_disk({{5, 5}, {6, 5}, {6, 6}}, 2).area == near(0));

    Random random(3);
    std::vector<Point2> sites(20);
    for (Point2 &site : sites) random.in_ball(2, 2, site.data());
    double area = 0;
    Point2 moment{0, 0};
    for (const Point2 &site : sites) {
        Polygon polygon = square(4);
        for (const Point2 &other : sites)
            if (&other != &site) clip_to_bisector(polygon, site, other);
        cell = intersect_disk(polygon, 2);
        area += cell.area;
        for (const int axis : {0, 1}) moment[axis] += cell.area * cell.centroid[axis];
    }
    // Voronoi cells add up to the disk, their moments to its centre.
    CHECK(area == near(4 * pi));
    CHECK(moment[0] == near(0));
    CHECK(moment[1] == near(0));
}

TEST_CASE("generated series") {
    Progress progress(Progress::Output::silent);
    const Series lloyd = record_lloyd_2d_uniform(200, 30, 5, progress);
    const auto path_length = [&](std::size_t timestamp) {
        double sum = 0;
        for (std::size_t i = 0; i < lloyd.frame_length(); ++i)
            sum += std::fabs(lloyd.frame(timestamp)[i] - lloyd.frame(timestamp - 1)[i]);
        return sum;
    };
    CHECK_MESSAGE(path_length(30) < path_length(1) / 4, "the points come to rest");
    const Series again = record_lloyd_2d_uniform(200, 30, 5, progress);
    const Series other = record_lloyd_2d_uniform(200, 30, 6, progress);
    CHECK_MESSAGE(again.positions == lloyd.positions, "the same seed gives the same positions");
    CHECK_MESSAGE(other.positions != lloyd.positions, "another seed gives others");
    const Series alone = record_lloyd_2d_uniform(1, 1, 5, progress);
    CHECK_MESSAGE(std::hypot(alone.frame(1)[0], alone.frame(1)[1]) < 1e-12, "a single point goes to the centre");

    const Series walk = record_walk_3d(100, 20, 5, progress);
    const double radius = unit_density_radius(3, 100);
    double longest = 0, shortest = 1, farthest = 0;
    for (std::size_t i = walk.frame_length(); i < walk.positions.size(); i += 3) {
        const double *to = &walk.positions[i], *from = to - walk.frame_length();
        const double length = std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
        longest = std::max(longest, length);
        shortest = std::min(shortest, length);
        farthest = std::max(farthest, std::hypot(to[0], to[1], to[2]));
    }
    // Every step has its length and stays in the ball.
    CHECK(longest < walk_step * (1 + 1e-9));
    CHECK(shortest > walk_step * (1 - 1e-9));
    CHECK(farthest <= radius);
}

TEST_CASE("measure") {
    const Series series = random_series(2, 200, 10);
    const std::vector<Entrant> entrants = {{&engine_kind("cgal/rebuilding"), 1, every_timestamp(series)},
                                           {&engine_kind("cgal/move"), 1, {5, 10}}};
    Progress progress(Progress::Output::silent);
    const std::vector<Row> rows = measure(series, entrants, 2, progress);
    // A row per engine, over the timestamps it was timed at.
    REQUIRE(rows.size() == 2);
    CHECK(rows[0].timestamps == 10);
    CHECK(rows[1].timestamps == 2);
    CHECK(rows[0].seconds > 0);
    CHECK(rows[1].seconds > 0);
    CHECK(rows[0].speedup == 1);
    CHECK(rows[1].speedup > 0);

    const Folder folder;
    write_csv(folder.file("bench.csv"), rows);
    const std::string csv = contents(folder.file("bench.csv"));
    CHECK(csv.rfind("scenario,dimension,n,timestamps,engine,algorithm,threads,seconds,"
                    "ns_per_vertex_timestamp,speedup_vs_cgal_rebuild,timed\n"
                    "static_2d,2,200,10,cgal,rebuilding,1,",
                    0) == 0);
    CHECK_THROWS_WITH(write_csv(folder.file("none/bench.csv"), rows), Contains("cannot be written"));
    // Significant digits.
    CHECK(significant(0.012345, 3) == "0.0123");
    CHECK(significant(12345, 3) == "12345");
    CHECK(significant(0, 3) == "0.00");
}

TEST_CASE("options") {
    const auto parse = [](std::vector<std::string> words) {
        words.insert(words.begin(), "run");
        std::vector<char *> pointers;
        for (std::string &word : words) pointers.push_back(&word[0]);
        return parse_options(static_cast<int>(pointers.size()), pointers.data());
    };
    CHECK_MESSAGE(parse({}).scenarios.size() == 8, "all scenarios by default");
    CHECK_MESSAGE(parse({"--series", "x.npy"}).scenarios.empty(), "a series alone");
    CHECK_MESSAGE(parse({"--repeat", "7", "--preset", "full"}).preset.n_repeats == 7,
                  "the order of arguments does not matter");
    CHECK_MESSAGE(parse({"--preset", "full", "--preset", "smoke"}).preset.name == "smoke", "the last one counts");
    CHECK_MESSAGE(parse({"--engine", "cgal", "--engine", "deldrift/auto"}).engines.size() == 2,
                  "an option that may be repeated");
    const std::vector<SeriesFile> series =
        parse({"--series", "a", "--steps", "3", "--displacement", "d", "--series", "b"}).series;
    // Displacements belong to the series before them.
    REQUIRE(series.size() == 2);
    CHECK(series[0].displacement_path == "d");
    CHECK(series[0].n_steps == 3);
    CHECK(series[1].path == "b");
    CHECK(series[1].n_steps == 0);
    CHECK_MESSAGE(parse({"--help"}).help.find("--series FILE.npy") != std::string::npos, "help lists them");
    CHECK_THROWS_WITH(parse({"--memory", "--large"}), Contains("--report,--memory,--large"));
    CHECK_THROWS_WITH(parse({"--engine", "cgal/magic"}), Contains("--engine: cgal/magic not in"));
    CHECK_THROWS_WITH(parse({"--scenario", "x"}), Contains("--scenario: x not in"));
    CHECK_THROWS_WITH(parse({"--repeat", "0"}), Contains("--repeat: Value 0 not in range 1"));
    CHECK_THROWS_WITH(parse({"--seed", "-1"}), Contains("--seed: Value -1 not in range"));
    CHECK_THROWS_WITH(parse({"--seed", "1x"}), Contains("--seed: Value 1x not in range"));
    CHECK_THROWS_WITH(parse({"--snap", "-1"}), Contains("--snap: Value -1 not in range"));
    CHECK_THROWS_WITH(parse({"--seed"}), Contains("--seed: 1 required"));
    CHECK_THROWS_WITH(parse({"--displacement", "d.npy"}), Contains("wants a --series"));
    CHECK_THROWS_WITH(parse({"--series", "x.npy", "--steps", "3"}), Contains("go together"));
    CHECK_THROWS_WITH(parse({"--sead", "3"}), Contains("not expected: 3 --sead"));
    CHECK_MESSAGE(parse({"--targets", "--target", "loop", "--target", "swept"}).targets.size() == 2, "chosen targets");
    CHECK_THROWS_WITH(parse({"--targets", "--target", "magic"}), Contains("--target: magic not in"));
    CHECK_THROWS_WITH(parse({"--target", "loop"}), Contains("for runs with --targets"));
    CHECK(parse({"--structured", "--point-set-size", "700"}).preset.structured_sizes == std::vector<std::size_t>{700});
    CHECK_THROWS_WITH(parse({"--point-set", "grid"}), Contains("for runs with --structured"));
    // What does less than a record leaves it alone.
    const std::string records = parse({}).results;
    CHECK(parse({"--targets", "--preset", "full"}).results == records);
    CHECK(parse({"--targets", "--target", "loop"}).results == records + "/partial");
    CHECK(parse({"--preset", "smoke"}).results == records + "/partial");
    CHECK(parse({"--repeat", "3"}).results == records + "/partial");
    CHECK(parse({"--report", "--scenario", "man"}).results == records);
    CHECK(parse({"--preset", "smoke", "--results", "here"}).results == "here");
    CHECK_MESSAGE(parse({}).with_structured, "a whole run has the structured table");
    CHECK_MESSAGE(!parse({"--scenario", "walk_3d"}).with_structured, "a part of it has not");
}

}  // namespace

bool run_self_test() { return doctest::Context().run() == 0; }

}  // namespace bench
