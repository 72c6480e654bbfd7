// SPDX-License-Identifier: GPL-3.0-or-later
// Engines take turns in blocks of consecutive timestamps: long enough that each works with the caches it would
// have if it were alone, short enough that a disturbance from outside falls on all of them alike.
#include "measure.hpp"

#include <algorithm>
#include <chrono>
#include <map>

namespace bench {
namespace {

constexpr std::size_t n_blocks = 20;
constexpr std::size_t nowhere = SIZE_MAX;

class Stopwatch {
public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

double median(std::vector<double> values) {
    const std::size_t half = values.size() / 2;
    std::nth_element(values.begin(), values.begin() + half, values.end());
    const double upper = values[half];
    if (values.size() % 2 == 1) return upper;
    return (upper + *std::max_element(values.begin(), values.begin() + half)) / 2;
}

/// Seconds of every repeat, by timestamp.
using Times = std::map<std::size_t, std::vector<double>>;

struct Lane {
    const Entrant *entrant;
    std::unique_ptr<Engine> engine;
    std::size_t timestamp = nowhere;
    Times times;
};

class Replay {
public:
    Replay(const Series &series, std::vector<Lane> &lanes, Progress &progress)
        : series_(series), lanes_(lanes), progress_(progress), staged_(series.frame_length()) {}

    /// All timestamps once, all engines starting from the first frame.
    void run(std::size_t first_lane) {
        for (Lane &lane : lanes_) {
            lane.engine = lane.entrant->make(series_.dimension);
            lane.timestamp = nowhere;
        }
        const std::size_t length = std::max<std::size_t>(1, series_.n_timestamps() / n_blocks);
        for (std::size_t first = 1; first <= series_.n_timestamps(); first += length) {
            const std::size_t last = std::min(first + length - 1, series_.n_timestamps());
            for (std::size_t turn = 0; turn < lanes_.size(); ++turn)
                run_block(lanes_[(first_lane + first + turn) % lanes_.size()], first, last);
            progress_.step("timestamp " + std::to_string(last));
        }
    }

    static std::size_t n_blocks_of(const Series &series) {
        const std::size_t length = std::max<std::size_t>(1, series.n_timestamps() / n_blocks);
        return (series.n_timestamps() + length - 1) / length;
    }

private:
    void run_block(Lane &lane, std::size_t first, std::size_t last) {
        const std::vector<std::size_t> &timestamps = lane.entrant->timestamps;
        auto next = std::lower_bound(timestamps.begin(), timestamps.end(), first);
        for (; next != timestamps.end() && *next <= last; ++next) {
            if (lane.timestamp != *next - 1) build(lane, *next - 1);
            lane.times[*next].push_back(timed_advance(*lane.engine, *next));
            lane.timestamp = *next;
        }
    }

    void build(Lane &lane, std::size_t timestamp) {
        const double *positions = stage(timestamp);
        lane.engine->prepare(positions, series_.n_points);
        lane.engine->build(positions, series_.n_points);
        lane.timestamp = timestamp;
    }

    double timed_advance(Engine &engine, std::size_t timestamp) {
        const double *positions = stage(timestamp);
        engine.prepare(positions, series_.n_points);
        const Stopwatch watch;
        engine.advance(positions);
        return watch.seconds();
    }

    /// The frame at one and the same place in memory, freshly written, as a solver would leave it.
    const double *stage(std::size_t timestamp) {
        const double *frame = series_.frame(timestamp);
        std::copy(frame, frame + series_.frame_length(), staged_.begin());
        return staged_.data();
    }

    const Series &series_;
    std::vector<Lane> &lanes_;
    Progress &progress_;
    std::vector<double> staged_;
};

double sum_of_medians(const Lane &lane, const std::vector<std::size_t> &timestamps) {
    double sum = 0;
    for (const std::size_t timestamp : timestamps) sum += median(lane.times.at(timestamp));
    return sum;
}

/// One row per lane; speed-ups are over the first lane at the same timestamps.
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
        row.speedup = sum_of_medians(lanes.front(), timestamps) / row.seconds;
        rows.push_back(row);
    }
    return rows;
}

std::vector<Lane> lanes_of(const std::vector<Entrant> &entrants) {
    std::vector<Lane> lanes;
    for (const Entrant &entrant : entrants) {
        Lane lane;
        lane.entrant = &entrant;
        lanes.push_back(std::move(lane));
    }
    return lanes;
}

}  // namespace

std::vector<Row> measure(const Series &series, const std::vector<Entrant> &entrants, unsigned n_repeats,
                         Progress &progress) {
    std::vector<Lane> lanes = lanes_of(entrants);
    progress.begin(series.name + ": timing " + std::to_string(series.n_timestamps()) + " timestamps, " +
                       std::to_string(n_repeats) + " times over",
                   n_repeats * Replay::n_blocks_of(series));
    Replay replay(series, lanes, progress);
    for (unsigned repeat = 0; repeat < n_repeats; ++repeat) replay.run(repeat);
    return rows_of(series, lanes);
}

std::vector<Row> measure_build(const Series &series, const std::vector<Entrant> &entrants, unsigned n_repeats,
                               Progress &progress) {
    std::vector<Lane> lanes = lanes_of(entrants);
    progress.begin(series.name + ": timing the build of " + std::to_string(series.n_points) + " points, " +
                       std::to_string(n_repeats) + " times over",
                   n_repeats);
    for (unsigned repeat = 0; repeat < n_repeats; ++repeat) {
        for (Lane &lane : lanes) {
            const std::unique_ptr<Engine> engine = lane.entrant->make(series.dimension);
            engine->prepare(series.frame(0), series.n_points);
            const Stopwatch watch;
            engine->build(series.frame(0), series.n_points);
            lane.times[lane.entrant->timestamps.front()].push_back(watch.seconds());
        }
        progress.step();
    }
    return rows_of(series, lanes);
}

}  // namespace bench
