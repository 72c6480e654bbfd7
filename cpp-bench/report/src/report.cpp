// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.hpp"

#include "csv.hpp"
#include "engine.hpp"
#include "progress.hpp"
#include "report_input.hpp"
#include "replay_in_turns.hpp"
#include "report_statistics.hpp"
#include "report_steps.hpp"
#include "table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

namespace bench {
namespace {

namespace fs = std::filesystem;

const CsvFile::Line report_columns = {"scenario",
                                      "dimension",
                                      "n",
                                      "timestamps",
                                      "engine",
                                      "algorithm",
                                      "threads",
                                      "seconds",
                                      "ns_per_vertex_timestamp",
                                      "speedup_vs_cgal_rebuild",
                                      "first_timestamp",
                                      "last_timestamp"};
const CsvFile::Line curve_columns = {"scenario",
                                     "engine",
                                     "algorithm",
                                     "first_timestamp",
                                     "last_timestamp",
                                     "timestamps",
                                     "ns_per_vertex_timestamp"};
const CsvFile::Line step_columns = {"scenario",
                                    "dimension",
                                    "n",
                                    "timestamps",
                                    "engine",
                                    "algorithm",
                                    "ns_per_vertex_step",
                                    "cgal_ns_per_vertex_step",
                                    "speedup_vs_cgal_step",
                                    "first_timestamp",
                                    "last_timestamp"};
const CsvFile::Line check_columns = {"scenario", "engine", "algorithm", "compared_timestamps",
                                     "cells_wrongly_taken_for_delaunay"};

/// The rows that a reader compares with the report's Tables 1 and 2, and one for each segment.
std::vector<std::pair<std::size_t, std::size_t>> ranges_of(const Series &series) {
    if (series.segments.empty())
        return {{1, series.n_timestamps()},
                {std::max<std::size_t>(1, series.n_timestamps() / 2), series.n_timestamps()}};
    std::vector<std::pair<std::size_t, std::size_t>> ranges = {{1, series.n_timestamps()}};
    for (const Segment &segment : series.segments) ranges.emplace_back(segment.first, segment.last);
    return ranges;
}

/// `count` evenly spread ones of a whole series, the last included; the first `count` of every segment.
std::vector<std::size_t> sampled_timestamps(const Series &series, std::size_t count) {
    std::vector<std::size_t> timestamps;
    const std::size_t n = series.n_timestamps();
    if (series.segments.empty())
        for (std::size_t i = 1; i <= std::min(count, n); ++i)
            timestamps.push_back(i * n / std::min(count, n));
    for (const Segment &segment : series.segments)
        for (std::size_t t = segment.first; t <= segment.last && t < segment.first + count; ++t)
            timestamps.push_back(t);
    return timestamps;
}

/// Bins of about equal width on a logarithmic axis, beginning with single timestamps.
std::vector<std::pair<std::size_t, std::size_t>> bins_of(std::size_t n_timestamps) {
    std::vector<std::pair<std::size_t, std::size_t>> bins;
    for (std::size_t first = 1; first <= n_timestamps;) {
        const std::size_t last = std::min(
            n_timestamps, std::max(first, static_cast<std::size_t>(1.12 * static_cast<double>(first))));
        bins.emplace_back(first, last);
        first = last + 1;
    }
    return bins;
}

struct Sum {
    std::size_t n = 0;
    double seconds = 0;
    double baseline = 0;
};

/// Over the timestamps of a range at which the engine was timed.
Sum sum_over(const UpdateTimes &times, const UpdateTimes &baseline,
             std::pair<std::size_t, std::size_t> range) {
    Sum sum;
    for (auto at = times.lower_bound(range.first); at != times.end() && at->first <= range.second; ++at) {
        ++sum.n;
        sum.seconds += at->second;
        sum.baseline += baseline.at(at->first);
    }
    return sum;
}

class Report {
public:
    explicit Report(const Options &options) : options_(options), begun_(std::chrono::steady_clock::now()) {
        fs::create_directories(options.results + "/series");
        begin_anew_if_needed();
        report_ = std::make_unique<CsvFile>(options.results + "/report.csv", report_columns);
        curves_ = std::make_unique<CsvFile>(options.results + "/report_curves.csv", curve_columns);
        steps_ = std::make_unique<CsvFile>(options.results + "/report_steps.csv", step_columns);
        checks_ = std::make_unique<CsvFile>(options.results + "/report_checks.csv", check_columns);
    }

    void run() {
        double cost_left = 0, cost_done = 0;
        for (const std::string &scenario : options_.scenarios) cost_left += cost(scenario);
        for (const std::string &scenario : options_.scenarios) {
            announce(scenario, cost_done, cost_left);
            const bool is_done = run_scenario(scenario);
            cost_left -= cost(scenario);
            if (!is_done) cost_done += cost(scenario);
        }
        std::cout << "written: " << options_.results << "/report.csv and report_*.csv\n";
    }

private:
    /// Figures of different commits, presets or seeds do not go together.
    void begin_anew_if_needed() {
        const char *commit = std::getenv("DELDRIFT_BENCH_COMMIT");
        const std::string state =
            fmt::format("commit: {}\npreset: {}\nseed: {}\ntimestamps: {}\n", commit ? commit : "unknown",
                        options_.preset.name, options_.seed, options_.report_timestamps);
        const std::string path = options_.results + "/report_state.txt";
        std::ifstream file(path);
        std::ostringstream old;
        old << file.rdbuf();
        if (old.str() == state) return;
        if (!old.str().empty())
            std::cerr << "starting over: commit, preset or seed differ from last time\n";
        for (const auto &entry : fs::directory_iterator(options_.results))
            if (entry.path().filename().string().rfind("report", 0) == 0 &&
                entry.path().extension() == ".csv")
                fs::remove(entry.path());
        std::ofstream(path) << state;
    }

    double cost(const std::string &scenario) const {
        const ReportEffort effort = report_effort(scenario, options_);
        const double segments = scenario.rfind("share_", 0) == 0 || scenario.rfind("walk_", 0) == 0 ? 15 : 1;
        const bool is_plane = scenario.find("2d") != std::string::npos;
        return static_cast<double>(effort.n_points * effort.n_timestamps) * segments * effort.n_repeats *
               (is_plane ? 1 : 15);
    }

    void announce(const std::string &scenario, double cost_done, double cost_left) const {
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
        const double left = cost_done > 0 ? seconds * cost_left / cost_done : 0;
        const std::string remark = cost_done == 0 ? ""
                                   : left < 90    ? "; less than two minutes left in all"
                                                  : fmt::format("; about {:.0f} min left in all", left / 60);
        fmt::print(stderr, "[{}{}]\n", scenario, remark);
    }

    bool is_wanted(const EngineKind &kind) const {
        const auto &wanted = options_.engines;
        const bool is_meant =
            wanted.empty() || std::find(wanted.begin(), wanted.end(), kind.engine) != wanted.end();
        return (is_meant && !kind.is_internal) ||
               std::find(wanted.begin(), wanted.end(), kind.name()) != wanted.end();
    }

    std::string times_path(const std::string &scenario, const EngineKind &kind) const {
        return options_.results + "/series/times_" + scenario + "_" + kind.engine + "_" + kind.algorithm +
               ".csv";
    }

    bool has_rows(const std::string &scenario, const EngineKind &kind) const {
        return std::any_of(report_->lines().begin(), report_->lines().end(), [&](const CsvFile::Line &line) {
            return line.at(0) == scenario && line.at(4) == kind.engine && line.at(5) == kind.algorithm;
        });
    }

    /// True if there was nothing to do.
    bool run_scenario(const std::string &scenario) {
        const EngineKind &baseline = engine_kinds().front();
        std::vector<const EngineKind *> missing;
        for (const EngineKind &kind : engine_kinds())
            if ((&kind == &baseline || is_wanted(kind)) && !has_rows(scenario, kind))
                missing.push_back(&kind);
        if (missing.empty() && has_statistics(scenario) && !lacks_steps(scenario)) {
            std::cerr << scenario << ": all there\n";
            return true;
        }
        const ReportInput input = report_input(scenario, options_, progress_);
        write_report_statistics(input, options_.results, progress_);
        if (!missing.empty()) time_engines(input.series, missing);
        if (lacks_steps(scenario)) time_steps(input.series);
        return false;
    }

    /// Inputs of segments have none.
    bool lacks_steps(const std::string &scenario) const {
        const bool has_segments = scenario.rfind("share_", 0) == 0 || scenario.rfind("walk_", 0) == 0;
        return !has_segments && is_wanted(engine_kind("deldrift/auto")) && !steps_->has({scenario});
    }

    bool has_statistics(const std::string &scenario) const {
        std::ifstream file(options_.results + "/report_statistics.csv");
        for (std::string line; std::getline(file, line);)
            if (line.rfind(scenario + ",", 0) == 0) return true;
        return false;
    }

    void time_engines(const Series &series, const std::vector<const EngineKind *> &kinds) {
        const ReportEffort effort = report_effort(series.name, options_);
        std::vector<Entrant> entrants;
        for (const EngineKind *kind : kinds)
            entrants.push_back({kind, 1,
                                is_sampled(*kind, series)
                                    ? sampled_timestamps(series, effort.n_slow_timestamps)
                                    : all_timestamps(series, !kind->is_stateless)});
        Checks checks;
        std::vector<UpdateTimes> times = replay_in_turns(
            series, entrants, check_timestamps(series, effort), effort.n_repeats, checks, progress_);
        for (UpdateTimes &of_engine : times) forget_warm_up(of_engine, series);
        for (std::size_t i = 0; i < kinds.size(); ++i) save_times(series, *kinds[i], times[i]);
        const UpdateTimes baseline = load_times(series, engine_kinds().front());
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            add_rows(series, *kinds[i], times[i], baseline);
            add_curve(series, *kinds[i], times[i]);
            checks_->add(line_of(series.name, kinds[i]->engine, kinds[i]->algorithm, checks.n_timestamps,
                                 checks.n_unproved[kinds[i]->name()]));
        }
        checks_->save();
        curves_->save();
        report_->save();
    }

    void time_steps(const Series &series) {
        const ReportSteps steps =
            time_report_steps(series, report_effort(series.name, options_).n_repeats, progress_);
        UpdateTimes cgal = load_times(series, engine_kinds().front());
        for (auto &[timestamp, seconds] : cgal) seconds += steps.cgal_reading_seconds;
        for (const auto &range : ranges_of(series)) {
            const Sum sum = sum_over(steps.deldrift, cgal, range);
            const double scale = 1e9 / static_cast<double>(sum.n * series.n_points);
            steps_->add(line_of(series.name, series.dimension, series.n_points, sum.n, "deldrift", "auto",
                                significant(scale * sum.seconds, 5), significant(scale * sum.baseline, 5),
                                significant(sum.baseline / sum.seconds, 5), range.first, range.second));
        }
        steps_->save();
    }

    /// Engines that cannot get cheaper with smaller displacements and are far slower than rebuilding; those
    /// with tolerances live through all timestamps.
    static bool is_sampled(const EngineKind &kind, const Series &series) {
        const bool has_memory = kind.keeps_data || kind.is_reproduction;
        if (series.dimension == 2) return false;
        return kind.is_slow_in_3d && (!has_memory || !series.segments.empty());
    }

    static std::vector<std::size_t> check_timestamps(const Series &series, const ReportEffort &effort) {
        if (series.segments.empty()) return sampled_timestamps(series, effort.n_checks);
        // The end of what slow engines take part in, of every segment but the first.
        std::vector<std::size_t> timestamps;
        for (const Segment &segment : series.segments)
            timestamps.push_back(std::min(segment.last, segment.first + effort.n_slow_timestamps - 1));
        return timestamps;
    }

    void save_times(const Series &series, const EngineKind &kind, const UpdateTimes &times) const {
        std::vector<std::vector<std::string>> lines = {{"timestamp", "seconds"}};
        for (const auto &[timestamp, seconds] : times)
            lines.push_back(line_of(timestamp, significant(seconds, 9)));
        write_csv(times_path(series.name, kind), lines);
    }

    UpdateTimes load_times(const Series &series, const EngineKind &kind) const {
        UpdateTimes times;
        const CsvFile file(times_path(series.name, kind), {"timestamp", "seconds"});
        for (const CsvFile::Line &line : file.lines()) times[std::stoul(line.at(0))] = std::stod(line.at(1));
        return times;
    }

    void add_rows(const Series &series, const EngineKind &kind, const UpdateTimes &times,
                  const UpdateTimes &baseline) {
        for (const auto &range : ranges_of(series)) {
            const Sum sum = sum_over(times, baseline, range);
            if (sum.n == 0) continue;
            const double ns = 1e9 * sum.seconds / static_cast<double>(sum.n * series.n_points);
            report_->add(line_of(series.name, series.dimension, series.n_points, sum.n, kind.engine, kind.algorithm, 1,
                                 significant(sum.seconds, 6), significant(ns, 5),
                                 significant(sum.baseline / sum.seconds, 5), range.first, range.second));
        }
    }

    void add_curve(const Series &series, const EngineKind &kind, const UpdateTimes &times) {
        if (!series.segments.empty()) return;
        for (const auto &bin : bins_of(series.n_timestamps())) {
            const Sum sum = sum_over(times, times, bin);
            if (sum.n == 0) continue;
            const double ns = 1e9 * sum.seconds / static_cast<double>(sum.n * series.n_points);
            curves_->add(line_of(series.name, kind.engine, kind.algorithm, bin.first, bin.second, sum.n,
                                 significant(ns, 5)));
        }
    }

    const Options &options_;
    std::chrono::steady_clock::time_point begun_;
    Progress progress_;
    std::unique_ptr<CsvFile> report_;
    std::unique_ptr<CsvFile> curves_;
    std::unique_ptr<CsvFile> steps_;
    std::unique_ptr<CsvFile> checks_;
};

}  // namespace

void run_report(const Options &options) { Report(options).run(); }

}  // namespace bench
