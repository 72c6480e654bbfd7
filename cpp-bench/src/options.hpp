// SPDX-License-Identifier: GPL-3.0-or-later
// The command line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bench {

/// How much a preset does.
struct Preset {
    std::string name;
    std::size_t lloyd_timestamps;
    std::size_t walk_timestamps;
    std::size_t n_slow_timestamps;  // how many timestamps engines that are slow in 3D are timed at
    std::size_t n_checks;           // at how many timestamps cells are compared
    unsigned n_repeats;
    std::vector<std::size_t> static_sizes;
    std::vector<std::size_t> step_sizes;
    std::vector<std::size_t> structured_sizes;
    std::vector<std::size_t> domain_sizes;
    bool has_all_point_sets;  // of structured.hpp: else the most telling ones
};

struct SeriesFile {
    std::string path;
    std::string displacement_path;  // empty: the file has the frames
    std::size_t n_steps = 0;
};

enum class Task { run, report, memory, large, structured, domains, meshes, boxes, weights, targets, self_test, help };

struct Options {
    Task task = Task::run;
    std::string help;  // what Task::help prints
    Preset preset;
    std::vector<std::string> scenarios;
    std::vector<std::string> engines;     // empty: all
    std::vector<std::string> targets;     // empty: all
    std::vector<std::string> point_sets;  // of Task::structured; empty: the preset's
    std::vector<std::string> domains;     // of Task::domains; empty: all
    bool with_structured = false;         // Task::run ends with structured point sets and domains
    std::vector<SeriesFile> series;
    std::size_t n_series_checks = SIZE_MAX;           // as n_checks, for series files
    std::size_t n_series_slow_timestamps = SIZE_MAX;  // as n_slow_timestamps, for series files
    std::vector<unsigned> threads{1};
    double snap = 0;  // coordinates of series files below this magnitude become 0
    std::uint64_t seed = 1;
    std::string results = "results";  // the wrapper script names its own through DELDRIFT_BENCH_RESULTS
    std::string data = "data";        // where man.off is looked for; from DELDRIFT_BENCH_DATA
    std::string keep_failures;  // folder for positions at which a check failed; empty: not kept
    std::size_t report_timestamps = 0;  // of the inputs that iterate; 0: the preset's
    std::size_t large_points_2d = 50'000'000;
    std::size_t large_points_3d = 20'000'000;
};

/// Throws std::runtime_error with what is wrong.
Options parse_options(int n_arguments, char **arguments);

/// The inputs of the report, in the order of its tables and figures.
const std::vector<std::string> &report_scenario_names();

/// What targets are called.
const std::vector<std::string> &target_names();

}  // namespace bench
