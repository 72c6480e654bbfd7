// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure.hpp"

#include "replay.hpp"

#include <fmt/format.h>

namespace bench {
namespace {

/// All timestamps once, all engines starting from the first frame.
void run_once(const Series &series, std::vector<Lane> &lanes, std::size_t first_lane, Progress &progress) {
    Replay replay(series);
    for (Lane &lane : lanes) lane.restart(series.dimension);
    for (std::size_t first = 1; first <= series.n_timestamps(); first += block_length(series)) {
        const std::size_t last = std::min(first + block_length(series) - 1, series.n_timestamps());
        for (std::size_t turn = 0; turn < lanes.size(); ++turn)
            replay.run_block(lanes[(first_lane + first + turn) % lanes.size()], first, last, [](std::size_t) {});
        progress.step(fmt::format("timestamp {}", last));
    }
}

double sum_of_medians(const Lane &lane, const std::vector<std::size_t> &timestamps) {
    double sum = 0;
    for (const std::size_t timestamp : timestamps) sum += median(lane.seconds.at(timestamp));
    return sum;
}

/// The first that does the same: an update, or a step.
const Lane &baseline_of(const Lane &lane, const std::vector<Lane> &lanes) {
    return *std::find_if(lanes.begin(), lanes.end(), [&](const Lane &other) {
        return other.entrant->kind->is_step == lane.entrant->kind->is_step;
    });
}

/// One row per lane; speed-ups are over the baseline at the same timestamps.
std::vector<Row> rows_of(const Series &series, const std::vector<Lane> &lanes) {
    std::vector<Row> rows;
    for (const Lane &lane : lanes) {
        const std::vector<std::size_t> &timestamps = lane.entrant->timestamps;
        Row row;
        row.scenario = series.name;
        row.dimension = series.dimension;
        row.n = series.n_points;
        row.timestamps = timestamps.size();
        row.engine = lane.entrant->kind->engine;
        row.algorithm = lane.entrant->kind->algorithm;
        row.threads = lane.entrant->n_threads;
        row.seconds = sum_of_medians(lane, timestamps);
        row.speedup = sum_of_medians(baseline_of(lane, lanes), timestamps) / row.seconds;
        if (lane.entrant->kind->is_step) row.timed = "step";
        rows.push_back(row);
    }
    return rows;
}

}  // namespace

std::vector<Row> measure(const Series &series, const std::vector<Entrant> &entrants, unsigned n_repeats,
                         Progress &progress) {
    std::vector<Lane> lanes = lanes_of(entrants);
    progress.begin(fmt::format("{}: timing {} timestamps, {} times over", series.name, series.n_timestamps(),
                               n_repeats),
                   n_repeats * n_blocks(series));
    for (unsigned repeat = 0; repeat < n_repeats; ++repeat) run_once(series, lanes, repeat, progress);
    return rows_of(series, lanes);
}

std::vector<Row> measure_build(const Series &series, const std::vector<Entrant> &entrants, unsigned n_repeats,
                               Progress &progress) {
    std::vector<Lane> lanes = lanes_of(entrants);
    progress.begin(fmt::format("{}: timing the build of {} points, {} times over", series.name, series.n_points,
                               n_repeats),
                   n_repeats);
    for (unsigned repeat = 0; repeat < n_repeats; ++repeat) {
        for (Lane &lane : lanes) {
            const std::unique_ptr<Engine> engine = lane.entrant->make(series.dimension);
            engine->prepare(series.frame(0), series.n_points);
            const Stopwatch watch;
            engine->build(series.frame(0), series.n_points);
            lane.seconds[lane.entrant->timestamps.front()].push_back(watch.seconds());
        }
        progress.step();
    }
    return rows_of(series, lanes);
}

}  // namespace bench
