// SPDX-License-Identifier: GPL-3.0-or-later
#include "self_test.hpp"

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
#include "table.hpp"
#include "targets.hpp"
#include "tests.hpp"
#include "verify.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace bench {
namespace {

namespace fs = std::filesystem;

/// A folder that goes with the object.
class Folder {
public:
    Folder() : path_(fs::temp_directory_path() / ("deldrift-self-test-" + std::to_string(getpid()))) {
        fs::create_directories(path_);
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Folder(const Folder &) = delete;
    Folder &operator=(const Folder &) = delete;

    std::string file(const std::string &name) const { return (path_ / name).string(); }

private:
    fs::path path_;
};

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

void test_npy(Tests &tests) {
    const Folder folder;
    const std::string path = folder.file("series.npy");
    const NpyArray array{{2, 3, 2}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 1.0 / 3}};
    write_npy(path, array);
    const NpyArray read = read_npy(path);
    tests.expect(read.shape == array.shape && read.values == array.values, "npy: what is written is read");
    const std::string bytes = contents(path);
    tests.expect((bytes.size() - 12 * 8) % 64 == 0, "npy: data are aligned as the format asks");

    put(path, bytes.substr(0, bytes.size() - 1));
    tests.expect_error([&] { read_npy(path); }, "truncated: 12 numbers announced, 11 present", "npy: truncated data");
    put(path, bytes.substr(0, 40));
    tests.expect_error([&] { read_npy(path); }, "truncated inside its header", "npy: truncated header");
    put(path, "PK" + bytes.substr(2));
    tests.expect_error([&] { read_npy(path); }, "not a .npy file", "npy: wrong magic");
    put(path, replaced(bytes, "False", "True "));
    tests.expect_error([&] { read_npy(path); }, "not in C order", "npy: Fortran order");
    put(path, replaced(bytes, "<f8", "<i8"));
    tests.expect_error([&] { read_npy(path); }, "only '<f8' and '<f4'", "npy: integers");
    put(path, replaced(bytes, "<f8", ">f8"));
    tests.expect_error([&] { read_npy(path); }, "only '<f8' and '<f4'", "npy: big-endian numbers");
    tests.expect_error([&] { read_npy(folder.file("none.npy")); }, "cannot be opened", "npy: missing file");

    const float narrow[12] = {0.5f, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, -0.1f};
    put(path, replaced(bytes.substr(0, bytes.size() - 96), "<f8", "<f4") +
                  std::string(reinterpret_cast<const char *>(narrow), sizeof narrow));
    const NpyArray widened = read_npy(path);
    tests.expect(std::equal(widened.values.begin(), widened.values.end(), narrow, narrow + 12), "npy: f32 is widened");
}

void test_series_files(Tests &tests) {
    const Folder folder;
    const std::string path = folder.file("frames.npy");
    write_npy(path, {{2, 3, 2}, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 2}});
    const Series series = load_series(path);
    tests.expect(series.name == "frames" && series.dimension == 2 && series.n_points == 3 &&
                     series.n_timestamps() == 1 && series.frame(1)[5] == 2,
                 "series: frames, points and dimension come from the shape, the name from the file");
    write_npy(path, {{3, 4}, std::vector<double>(12, 0.0)});
    tests.expect_error([&] { load_series(path); }, "has shape 3 x 4", "series: four dimensions");
    write_npy(path, {{2, 0, 2}, {}});
    tests.expect_error([&] { load_series(path); }, "has shape 2 x 0 x 2", "series: no points");
    write_npy(path, {{1, 2, 2}, {0, 0, 1, std::nan("")}});
    tests.expect_error([&] { load_series(path); }, "frame 0, point 1", "series: a coordinate that is not a number");

    const std::string displacement_path = folder.file("displacement.npy");
    write_npy(path, {{2, 3}, {0, 0, 0, 1, 1, 1}});
    write_npy(displacement_path, {{2, 3}, {4, 0, 0, 0, 0, -4}});
    const Series displaced = load_displacement(path, displacement_path, 4);
    tests.expect(displaced.n_frames() == 5 && displaced.frame(1)[0] == 1 && displaced.frame(4)[5] == -3,
                 "series: displacements are applied in equal steps");
    Series tiny = displaced;
    tiny.positions[0] = -1e-64;
    tiny.positions[1] = 1e-42;
    tests.expect(snap(tiny, 1e-42) == 1 && tiny.positions[0] == 0 && tiny.positions[1] == 1e-42,
                 "series: coordinates below a magnitude become 0");
    write_npy(displacement_path, {{3, 2}, std::vector<double>(6, 0.0)});
    tests.expect_error([&] { load_displacement(path, displacement_path, 4); }, "differ in shape",
                       "series: displacements of another shape");
}

void test_cells(Tests &tests) {
    const std::vector<double> places = {0, 0, 1, 0, 0, 1, 1, 0, -0.0, 0};
    const std::vector<std::uint32_t> lowest = representatives(2, places.data(), 5);
    tests.expect(lowest == std::vector<std::uint32_t>({0, 1, 2, 1, 0}),
                 "cells: coincident points have one representative");
    tests.expect(canonical(2, {2, 4, 3}, lowest) == CellSet{{0, 1, 2, no_vertex}}, "cells: canonical form");
    tests.expect_error([&] { canonical(2, {0, 1, 2, 4, 3, 2}, lowest); }, "comes twice", "cells: one cell twice");
    tests.expect_error([&] { canonical(2, {0, 1, 3}, lowest); }, "has a vertex twice", "cells: a vertex twice");
    tests.expect_error([&] { canonical(2, {0, 1, 7}, lowest); }, "vertex 7 of 5", "cells: an id out of range");
    tests.expect_error([&] { canonical(2, {0, 1}, lowest); }, "incomplete", "cells: an incomplete cell");
}

void test_arbiter(Tests &tests) {
    const CellSet diagonal_02 = {{0, 1, 2, no_vertex}, {0, 2, 3, no_vertex}};
    const CellSet diagonal_13 = {{0, 1, 3, no_vertex}, {1, 2, 3, no_vertex}};

    const std::vector<double> square = {0, 0, 1, 0, 1, 1, 0, 1};
    Verdict verdict = compare(2, square.data(), diagonal_02, "a", diagonal_13, "b");
    tests.expect(verdict.is_accepted && verdict.n_degenerate == 2, "arbiter: both diagonals of a square are right");
    verdict = compare(2, square.data(), diagonal_02, "a", {{0, 1, 2, no_vertex}}, "b");
    tests.expect(!verdict.is_accepted, "arbiter: half of a square is not the square");

    std::vector<double> nearly = square;
    nearly[4] = std::nextafter(1.0, 2.0);
    verdict = compare(2, nearly.data(), diagonal_02, "a", diagonal_13, "b");
    tests.expect(!verdict.is_accepted && verdict.complaint.find("inside") != std::string::npos,
                 "arbiter: one unit in the last place decides the diagonal");

    const std::vector<double> grid = {0, 0, 1, 0, 1, 1, 0, 1, 2, 0, 2, 1};
    const CellSet whole = {{0, 1, 2, no_vertex}, {0, 2, 3, no_vertex}, {1, 2, 4, no_vertex}, {2, 4, 5, no_vertex}};
    const CellSet holed = {{0, 1, 3, no_vertex}, {1, 2, 3, no_vertex}, {1, 4, 5, no_vertex}};
    verdict = compare(2, grid.data(), holed, "a", whole, "b");
    tests.expect(!verdict.is_accepted, "arbiter: a hole among cocircular points is found");

    const std::vector<double> cube = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    const CellSet five = {{0, 1, 2, 5}, {0, 2, 3, 7}, {0, 2, 5, 7}, {0, 4, 5, 7}, {2, 5, 6, 7}};
    const CellSet other_five = {{0, 1, 3, 4}, {1, 2, 3, 6}, {1, 3, 4, 6}, {1, 4, 5, 6}, {3, 4, 6, 7}};
    verdict = compare(3, cube.data(), five, "a", other_five, "b");
    tests.expect(verdict.is_accepted && verdict.n_degenerate == 5, "arbiter: a cube has more than one triangulation");
    CellSet with_flat = other_five;
    with_flat.insert(with_flat.begin(), {0, 1, 2, 3});
    verdict = compare(3, cube.data(), five, "a", with_flat, "b");
    tests.expect(!verdict.is_accepted && verdict.complaint.find("flat") != std::string::npos,
                 "arbiter: a flat cell is not excused");
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

std::vector<std::size_t> every_timestamp(const Series &series) {
    std::vector<std::size_t> timestamps;
    for (std::size_t timestamp = 1; timestamp <= series.n_timestamps(); ++timestamp) timestamps.push_back(timestamp);
    return timestamps;
}

void test_engines_agree(Tests &tests) {
    for (const unsigned dimension : {2u, 3u})
        for (const bool is_grid : {false, true}) {
            const Series series = is_grid ? grid_series(dimension, 120, 12) : random_series(dimension, 120, 12);
            const std::string what = series.name + (is_grid ? ", grid" : ", random");
            std::vector<Entrant> entrants;
            // The report's algorithms know no coincident points.
            for (const EngineKind &kind : engine_kinds())
                if (!is_grid || !kind.is_reproduction) entrants.push_back({&kind, 1, every_timestamp(series)});
            Progress progress(Progress::Output::silent);
            tests.expect_no_error(
                [&] {
                    const Checks checks = verify(series, entrants, every_timestamp(series), progress);
                    tests.expect(checks.n_timestamps == 12 && checks.n_comparisons == 12 * entrants.size(),
                                 what + ": every engine is compared at every timestamp");
                    tests.expect((checks.n_degenerate > 0) == is_grid,
                                 what + ": degenerate cells are on the grid only");
                    tests.expect((checks.n_coincident > 0) == is_grid, what + ": coincident points too");
                    tests.expect(checks.n_cells > 12, what + ": there are cells");
                },
                what);
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

template <Fault fault>
void test_fault(Tests &tests, const std::string &what) {
    std::vector<EngineKind> kinds = {engine_kind("cgal/rebuilding"), engine_kind("deldrift/rebuilding")};
    for (EngineKind &kind : kinds) {
        kind.is_stateless = false;
        kind.make = [make = kind.make](unsigned dimension, unsigned n_threads) {
            return std::make_unique<Faulty<fault>>(make(dimension, n_threads));
        };
    }
    const Series series = random_series(2, 100, 4);
    for (const EngineKind &kind : kinds) {
        const std::vector<Entrant> entrants = {{&kind, 1, every_timestamp(series)}};
        Progress progress(Progress::Output::silent);
        tests.expect_error([&] { verify(series, entrants, every_timestamp(series), progress); },
                           "static_2d, timestamp 3: ", "a faulty " + kind.engine + " engine, " + what);
        tests.expect_no_error([&] { verify(series, entrants, {1, 2}, progress); },
                              "the same engine before its fault, " + what);
    }
}

void test_faults_are_found(Tests &tests) {
    test_fault<Fault::wrong_corner>(tests, "a wrong corner");
    test_fault<Fault::missing_cell>(tests, "a missing cell");
    test_fault<Fault::stale_positions>(tests, "stale positions");
    test_fault<Fault::failing_validation>(tests, "a failing validation");
}

void test_disk_cells(Tests &tests) {
    const auto near = [](double a, double b) { return std::fabs(a - b) < 1e-12; };
    const double pi = std::acos(-1.0);
    AreaAndCentroid cell = intersect_disk(square(0.5), 1);
    tests.expect(near(cell.area, 1) && near(cell.centroid[0], 0), "disk: a square inside is itself");
    cell = intersect_disk(square(3), 2);
    tests.expect(near(cell.area, 4 * pi) && near(cell.centroid[1], 0), "disk: a square around it gives the disk");

    Polygon half = square(3);
    clip_to_bisector(half, {1, 0}, {-1, 0});
    cell = intersect_disk(half, 2);
    tests.expect(near(cell.area, 2 * pi) && near(cell.centroid[0], 8 / (3 * pi)) && near(cell.centroid[1], 0),
                 "disk: the centroid of half a disk");
    tests.expect(near(intersect_disk({{5, 5}, {6, 5}, {6, 6}}, 2).area, 0), "disk: a triangle outside has no area");

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
    tests.expect(near(area, 4 * pi) && near(moment[0], 0) && near(moment[1], 0),
                 "disk: Voronoi cells add up to the disk, their moments to its centre");
}

void test_generated_series(Tests &tests) {
    Progress progress(Progress::Output::silent);
    const Series lloyd = record_lloyd_2d_uniform(200, 30, 5, progress);
    const auto path_length = [&](std::size_t timestamp) {
        double sum = 0;
        for (std::size_t i = 0; i < lloyd.frame_length(); ++i)
            sum += std::fabs(lloyd.frame(timestamp)[i] - lloyd.frame(timestamp - 1)[i]);
        return sum;
    };
    tests.expect(path_length(30) < path_length(1) / 4, "lloyd: the points come to rest");
    const Series again = record_lloyd_2d_uniform(200, 30, 5, progress);
    const Series other = record_lloyd_2d_uniform(200, 30, 6, progress);
    tests.expect(again.positions == lloyd.positions, "lloyd: the same seed gives the same positions");
    tests.expect(other.positions != lloyd.positions, "lloyd: another seed gives others");
    const Series alone = record_lloyd_2d_uniform(1, 1, 5, progress);
    tests.expect(std::hypot(alone.frame(1)[0], alone.frame(1)[1]) < 1e-12, "lloyd: a single point goes to the centre");

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
    tests.expect(longest < walk_step * (1 + 1e-9) && shortest > walk_step * (1 - 1e-9) && farthest <= radius,
                 "walk: every step has its length and stays in the ball");
}

void test_measure(Tests &tests) {
    const Series series = random_series(2, 200, 10);
    const std::vector<Entrant> entrants = {{&engine_kind("cgal/rebuilding"), 1, every_timestamp(series)},
                                           {&engine_kind("cgal/move"), 1, {5, 10}}};
    Progress progress(Progress::Output::silent);
    const std::vector<Row> rows = measure(series, entrants, 2, progress);
    tests.expect(rows.size() == 2 && rows[0].timestamps == 10 && rows[1].timestamps == 2 && rows[0].seconds > 0 &&
                     rows[1].seconds > 0 && rows[0].speedup == 1 && rows[1].speedup > 0,
                 "measure: a row per engine, over the timestamps it was timed at");

    const Folder folder;
    write_csv(folder.file("bench.csv"), rows);
    const std::string csv = contents(folder.file("bench.csv"));
    tests.expect(csv.rfind("scenario,dimension,n,timestamps,engine,algorithm,threads,seconds,"
                           "ns_per_vertex_timestamp,speedup_vs_cgal_rebuild,timed\nstatic_2d,2,200,10,cgal,rebuilding,1,",
                           0) == 0,
                 "csv: header and first row");
    tests.expect_error([&] { write_csv(folder.file("none/bench.csv"), rows); }, "cannot be written",
                       "csv: a folder that is not there");
    tests.expect(significant(0.012345, 3) == "0.0123" && significant(12345, 3) == "12345" &&
                     significant(0, 3) == "0.00",
                 "table: significant digits");
}

void test_targets(Tests &tests) {
    Progress progress(Progress::Output::silent);
    std::vector<Checks> checks;
    const std::vector<Target> targets = 
        measure_targets({300, 5, 300, 500, 2, {200, 300}, {200, 300, 400}, 300, 0.02}, 1, checks, progress);
    const auto is_measured = [](const Target &target) {
        return target.reference_ns > 0 && target.contender_ns > 0 && target.wanted >= 0.125;
    };
    tests.expect(targets.size() == 58 && std::all_of(targets.begin(), targets.end(), is_measured),
                 "targets: all are measured");
    std::size_t n_comparisons = 0;
    for (const Checks &check : checks) n_comparisons += check.n_comparisons;
    tests.expect(n_comparisons == 74, "targets: the cells of all engines are compared");
    const auto is_swept_in_vain = [](const Target &target) { return target.what == "swept" && target.n_changes > 0; };
    tests.expect(std::none_of(targets.begin(), targets.end(), is_swept_in_vain),
                 "targets: every certificate that is swept holds");
    const auto is_within_as_named = [](const Target &target) {
        return (target.what != "tolerance_test" || target.within == 1) &&
               (target.what != "half_within" || (target.within > 0.4 && target.within < 0.7));
    };
    tests.expect(std::all_of(targets.begin(), targets.end(), is_within_as_named),
                 "targets: all vertices, or half of them, are within tolerance");
    Target target = {"", 2, 1, "", "", 30, 10, 3, 0, 0};
    tests.expect(target.verdict() == std::string("pass"), "targets: reached");
    target.contender_ns = 10.1;
    tests.expect(target.verdict() == std::string("missed"), "targets: missed by little");
}

void test_options(Tests &tests) {
    const auto parse = [](std::vector<std::string> words) {
        words.insert(words.begin(), "run");
        std::vector<char *> pointers;
        for (std::string &word : words) pointers.push_back(&word[0]);
        return parse_options(static_cast<int>(pointers.size()), pointers.data());
    };
    tests.expect(parse({}).scenarios.size() == 6, "options: all scenarios by default");
    tests.expect(parse({"--series", "x.npy"}).scenarios.empty(), "options: a series alone");
    tests.expect(parse({"--repeat", "7", "--preset", "full"}).preset.n_repeats == 7,
                 "options: the order of arguments does not matter");
    tests.expect(parse({"--preset", "full", "--preset", "smoke"}).preset.name == "smoke", "options: the last one counts");
    tests.expect(parse({"--engine", "cgal", "--engine", "deldrift/auto"}).engines.size() == 2,
                 "options: an option that may be repeated");
    const std::vector<SeriesFile> series =
        parse({"--series", "a", "--steps", "3", "--displacement", "d", "--series", "b"}).series;
    tests.expect(series.size() == 2 && series[0].displacement_path == "d" && series[0].n_steps == 3 &&
                     series[1].path == "b" && series[1].n_steps == 0,
                 "options: displacements belong to the series before them");
    tests.expect(parse({"--help"}).help.find("--series FILE.npy") != std::string::npos, "options: help lists them");
    tests.expect_error([&] { parse({"--memory", "--large"}); }, "--report,--memory,--large", "options: two tasks");
    tests.expect_error([&] { parse({"--engine", "cgal/magic"}); }, "--engine: cgal/magic not in",
                       "options: unknown engine");
    tests.expect_error([&] { parse({"--scenario", "x"}); }, "--scenario: x not in", "options: unknown scenario");
    tests.expect_error([&] { parse({"--repeat", "0"}); }, "--repeat: Value 0 not in range 1", "options: no repeats");
    tests.expect_error([&] { parse({"--seed", "-1"}); }, "--seed: Value -1 not in range", "options: a negative number");
    tests.expect_error([&] { parse({"--seed", "1x"}); }, "--seed: Value 1x not in range", "options: not a number");
    tests.expect_error([&] { parse({"--snap", "-1"}); }, "--snap: Value -1 not in range", "options: a negative magnitude");
    tests.expect_error([&] { parse({"--seed"}); }, "--seed: 1 required", "options: a missing value");
    tests.expect_error([&] { parse({"--displacement", "d.npy"}); }, "wants a --series",
                       "options: no series to displace");
    tests.expect_error([&] { parse({"--series", "x.npy", "--steps", "3"}); }, "go together", "options: steps alone");
    tests.expect_error([&] { parse({"--sead", "3"}); }, "not expected: 3 --sead", "options: a misspelt argument");
}

}  // namespace

bool run_self_test() {
    Tests tests;
    test_npy(tests);
    test_series_files(tests);
    test_cells(tests);
    test_arbiter(tests);
    test_disk_cells(tests);
    test_generated_series(tests);
    test_options(tests);
    test_measure(tests);
    test_targets(tests);
    test_engines_agree(tests);
    test_faults_are_found(tests);
    test_steps(tests);
    test_report(tests);
    return tests.close();
}

}  // namespace bench
