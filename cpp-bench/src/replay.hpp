// SPDX-License-Identifier: GPL-3.0-or-later
// Replaying a series against the clock. Engines take turns in blocks of consecutive timestamps: long enough
// that each works with the caches it would have if it were alone, short enough that a disturbance from
// outside falls on all of them alike.
#pragma once

#include "series.hpp"
#include "verify.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace bench {

/// From here on memory that is freed stays with the process. By default glibc gives back what was allocated
/// in large pieces, and engines that do so would pay for fresh pages at every repeat, those that do not at
/// the first one only. One arena serves all threads: those of others give back what they can.
void keep_memory();

class Stopwatch {
public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

double median(std::vector<double> values);

/// How many consecutive timestamps of a series an engine has at a turn, and how many turns that makes.
std::size_t block_length(const Series &series);
std::size_t n_blocks(const Series &series);

/// An engine, the timestamp it is at, and the seconds of each repeat by timestamp.
struct Lane {
    static constexpr std::size_t nowhere = SIZE_MAX;

    const Entrant *entrant;
    std::unique_ptr<Engine> engine;
    std::size_t timestamp = nowhere;
    std::map<std::size_t, std::vector<double>> seconds;

    /// Starts over, with an engine that has not seen the series.
    void restart(unsigned dimension);
};

std::vector<Lane> lanes_of(const std::vector<Entrant> &entrants);

class Replay {
public:
    explicit Replay(const Series &series) : series_(series), staged_(series.frame_length()) {}

    /// Times an engine at its timestamps from `first` to `last`; after each of them `look(timestamp)`.
    template <typename Look>
    void run_block(Lane &lane, std::size_t first, std::size_t last, Look look) {
        const std::vector<std::size_t> &timestamps = lane.entrant->timestamps;
        auto next = std::lower_bound(timestamps.begin(), timestamps.end(), first);
        for (; next != timestamps.end() && *next <= last; ++next) {
            if (lane.timestamp != *next - 1 || begins_segment(*next)) build(*lane.engine, *next - 1);
            lane.seconds[*next].push_back(timed_advance(*lane.engine, *next));
            lane.timestamp = *next;
            look(*next);
        }
    }

private:
    bool begins_segment(std::size_t timestamp) const;
    void build(Engine &engine, std::size_t timestamp);
    double timed_advance(Engine &engine, std::size_t timestamp);
    const double *stage(std::size_t timestamp);

    const Series &series_;
    std::vector<double> staged_;
};

}  // namespace bench
