// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_steps.hpp"

#include "replay.hpp"
#include "step.hpp"

namespace bench {
namespace {

constexpr std::size_t n_readings = 10;

/// At evenly spread timestamps, after one that takes the memory for the arrays.
double cgal_reading_seconds(const Series &series, Progress &progress) {
    const std::unique_ptr<Engine> engine = engine_kind("cgal/rebuilding").make(series.dimension, 1);
    std::vector<double> seconds;
    progress.begin(series.name + ": reading CGAL's cells", n_readings + 1);
    for (std::size_t i = 0; i <= n_readings; ++i) {
        const double *positions = series.frame(i * series.n_timestamps() / n_readings);
        engine->prepare(positions, series.n_points);
        engine->build(positions, series.n_points);
        const Stopwatch watch;
        engine->read();
        if (i > 0) seconds.push_back(watch.seconds());
        progress.step();
    }
    return median(seconds);
}

}  // namespace

ReportSteps time_report_steps(const Series &series, unsigned n_repeats, Progress &progress) {
    const std::vector<Entrant> entrants = {{&step_kind("deldrift/auto"), 1, all_timestamps(series, true)}};
    Checks checks;
    ReportSteps steps;
    steps.deldrift = replay_in_turns(series, entrants, {series.n_timestamps()}, n_repeats, checks, progress).front();
    steps.cgal_reading_seconds = cgal_reading_seconds(series, progress);
    return steps;
}

}  // namespace bench
