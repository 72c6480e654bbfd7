// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner.hpp"

#include "engine.hpp"
#include "lists.hpp"
#include "measure.hpp"
#include "npy.hpp"
#include "progress.hpp"
#include "replay.hpp"
#include "scenarios.hpp"
#include "step.hpp"
#include "step_table.hpp"
#include "structured.hpp"
#include "table.hpp"
#include "verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

namespace bench {
namespace {

constexpr std::size_t lloyd_points = 1'000;
constexpr std::size_t walk_points = 13'000;

/// Small builds are repeated until so many points have been inserted in all.
constexpr std::size_t least_built_points = 200'000;

/// `count` of the timestamps 1..n_timestamps, evenly spread, the last one included.
std::vector<std::size_t> spread(std::size_t n_timestamps, std::size_t count) {
    count = std::min(count, n_timestamps);
    std::vector<std::size_t> timestamps;
    for (std::size_t i = 1; i <= count; ++i) timestamps.push_back(i * n_timestamps / count);
    return timestamps;
}

struct Effort {
    std::size_t n_checks;
    std::size_t n_slow_timestamps;
};

class Session {
public:
    explicit Session(const Options &options) : options_(options) {}

    void run() {
        std::filesystem::create_directories(options_.results);
        for (const std::string &scenario : options_.scenarios) run_scenario(scenario);
        for (const SeriesFile &file : options_.series) run_file(file);
        if (options_.with_structured)
            structured_lines_ = measure_structured(options_.preset, {}, options_.seed, checks_, progress_);
    }

    void report() {
        print_rows(std::cout, rows_);
        std::cout << '\n';
        if (!step_lines_.empty()) {
            print_steps(std::cout, step_lines_);
            std::cout << '\n';
        }
        if (options_.with_structured) {
            print_structured(std::cout, structured_lines_);
            std::cout << '\n';
        }
        print_checks(std::cout, checks_);
        const std::string path = options_.results + "/bench.csv";
        write_csv(path, rows_);
        std::cout << "\nwritten: " << path << '\n';
        if (!options_.with_structured) return;
        std::cout << "written: " << write_structured(options_.results, options_.preset, structured_lines_) << '\n';
    }

private:
    void run_scenario(const std::string &scenario) {
        const Preset &preset = options_.preset;
        const Effort effort{preset.n_checks, preset.n_slow_timestamps};
        if (scenario == "lloyd_2d_uniform")
            replay(record_lloyd_2d_uniform(lloyd_points, preset.lloyd_timestamps, options_.seed, progress_), effort);
        else if (scenario == "walk_3d")
            replay(record_walk_3d(walk_points, preset.walk_timestamps, options_.seed, progress_), effort);
        else if (scenario == "step_2d" || scenario == "step_3d")
            for (const std::size_t size : preset.step_sizes) step(scenario == "step_2d" ? 2 : 3, size);
        else if (scenario == "lists_2d" || scenario == "lists_3d")
            for (const std::size_t size : preset.step_sizes)
                add(list_rows(scenario == "lists_2d" ? 2 : 3, size, options_.seed, progress_));
        else
            for (const std::size_t size : preset.static_sizes)
                build(uniform_points(scenario == "static_2d" ? 2 : 3, size, options_.seed));
    }

    void run_file(const SeriesFile &file) {
        Series series = file.displacement_path.empty()
                            ? load_series(file.path)
                            : load_displacement(file.path, file.displacement_path, file.n_steps);
        if (options_.snap > 0)
            std::cerr << series.name << ": " << snap(series, options_.snap) << " coordinates below " << options_.snap
                      << " became 0\n";
        if (series.n_timestamps() == 0)
            build(series);
        else
            replay(series, {options_.n_series_checks, options_.n_series_slow_timestamps});
    }

    void replay(const Series &series, const Effort &effort) {
        const std::vector<std::size_t> all = spread(series.n_timestamps(), series.n_timestamps());
        const std::vector<std::size_t> sample = spread(series.n_timestamps(), effort.n_slow_timestamps);
        const auto timestamps_of = [&](const EngineKind &kind) {
            return kind.is_slow_in_3d && series.dimension == 3 ? sample : all;
        };
        std::vector<Entrant> entrants = entrants_with(engine_kinds(), timestamps_of);
        const std::vector<Entrant> steps = entrants_with(step_kinds(), timestamps_of);
        entrants.insert(entrants.end(), steps.begin(), steps.end());
        const std::vector<std::size_t> checked = spread(series.n_timestamps(), effort.n_checks);
        check(series, [&] { return verify(series, entrants, checked, progress_); });
        add(measure(series, entrants, options_.preset.n_repeats, progress_));
    }

    void build(const Series &series) {
        check(series, [&] { return verify_build(series, progress_); });
        std::vector<Entrant> entrants = 
            entrants_with(engine_kinds(), [](const EngineKind &) { return std::vector<std::size_t>{1}; });
        const auto is_not_a_build = [](const Entrant &entrant) { return entrant.kind->algorithm != "rebuilding"; };
        entrants.erase(std::remove_if(entrants.begin(), entrants.end(), is_not_a_build), entrants.end());
        const std::size_t n_repeats =
            std::max<std::size_t>(options_.preset.n_repeats, least_built_points / series.n_points);
        add(measure_build(series, entrants, static_cast<unsigned>(n_repeats), progress_));
    }

    void step(unsigned dimension, std::size_t n_points) {
        checks_.emplace_back();
        const std::vector<StepLine> lines =
            measure_steps(dimension, n_points, options_.preset.n_repeats, options_.seed, checks_.back(), progress_);
        for (const StepLine &line : lines) add(rows_of(line));
        step_lines_.insert(step_lines_.end(), lines.begin(), lines.end());
    }

    /// The first of the kinds is the baseline.
    template <typename TimestampsOf>
    std::vector<Entrant> entrants_with(const std::vector<EngineKind> &kinds, TimestampsOf timestamps_of) const {
        std::vector<Entrant> entrants;
        for (const EngineKind &kind : kinds) {
            const bool is_baseline = &kind == &kinds.front();
            if (!is_baseline && !is_wanted(kind)) continue;
            for (const unsigned n_threads : options_.threads) {
                entrants.push_back({&kind, kind.engine == "deldrift" ? n_threads : 1, timestamps_of(kind)});
                if (kind.engine != "deldrift") break;
            }
        }
        return entrants;
    }

    bool is_wanted(const EngineKind &kind) const {
        const auto &wanted = options_.engines;
        const bool is_meant = (wanted.empty() && !kind.is_reproduction) ||
                              std::find(wanted.begin(), wanted.end(), kind.engine) != wanted.end();
        return (is_meant && !kind.is_internal) ||
               std::find(wanted.begin(), wanted.end(), kind.base_name()) != wanted.end();
    }

    template <typename Check>
    void check(const Series &series, Check run_check) {
        try {
            checks_.push_back(run_check());
        } catch (const Mismatch &mismatch) {
            if (!options_.keep_failures.empty()) keep(series, mismatch.timestamp);
            throw;
        }
    }

    /// The frames around the failure as a series of its own.
    void keep(const Series &series, std::size_t timestamp) {
        const std::size_t first = timestamp == 0 ? 0 : timestamp - 1;
        NpyArray array;
        array.shape = {timestamp - first + 1, series.n_points, series.dimension};
        array.values.assign(series.frame(first), series.frame(timestamp) + series.frame_length());
        std::filesystem::create_directories(options_.keep_failures);
        const std::string path =
            fmt::format("{}/{}_at_{}.npy", options_.keep_failures, series.name, timestamp);
        write_npy(path, array);
        std::cerr << "positions kept: " << path << '\n';
    }

    void add(const std::vector<Row> &rows) { rows_.insert(rows_.end(), rows.begin(), rows.end()); }

    const Options &options_;
    Progress progress_;
    std::vector<Row> rows_;
    std::vector<StepLine> step_lines_;
    std::vector<StructuredLine> structured_lines_;
    std::vector<Checks> checks_;
};

}  // namespace

void run_scenarios(const Options &options) {
    keep_memory();
    Session session(options);
    session.run();
    session.report();
}

}  // namespace bench
