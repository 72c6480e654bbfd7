// SPDX-License-Identifier: GPL-3.0-or-later
#include "replay.hpp"

#include <malloc.h>

#include <limits>

namespace bench {
namespace {

constexpr std::size_t most_blocks = 20;
/// An engine that takes a few microseconds for a timestamp needs many of them until what it finds in the caches is its
/// own.
constexpr std::size_t least_moves = 200'000;

}  // namespace

void keep_memory() {
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_ARENA_MAX, 1);
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

double median(std::vector<double> values) {
    const std::size_t half = values.size() / 2;
    std::nth_element(values.begin(), values.begin() + half, values.end());
    const double upper = values[half];
    if (values.size() % 2 == 1) return upper;
    return (upper + *std::max_element(values.begin(), values.begin() + half)) / 2;
}

std::size_t block_length(const Series &series) {
    const std::size_t least = least_moves / std::max<std::size_t>(1, series.n_points);
    return std::max<std::size_t>({1, series.n_timestamps() / most_blocks, least});
}

std::size_t n_blocks(const Series &series) {
    return (series.n_timestamps() + block_length(series) - 1) / block_length(series);
}

void Lane::restart(unsigned dimension) {
    engine = entrant->make(dimension);
    timestamp = nowhere;
}

std::vector<Lane> lanes_of(const std::vector<Entrant> &entrants) {
    std::vector<Lane> lanes(entrants.size());
    for (std::size_t i = 0; i < entrants.size(); ++i) lanes[i].entrant = &entrants[i];
    return lanes;
}

bool Replay::begins_segment(std::size_t timestamp) const {
    return std::any_of(series_.segments.begin(), series_.segments.end(),
                       [&](const Segment &segment) { return segment.begin == timestamp; });
}

void Replay::build(Engine &engine, std::size_t timestamp) {
    const double *positions = stage(timestamp);
    engine.prepare(positions, series_.n_points);
    engine.build(positions, series_.n_points);
}

double Replay::timed_advance(Engine &engine, std::size_t timestamp) {
    const double *positions = stage(timestamp);
    engine.prepare(positions, series_.n_points);
    const Stopwatch watch;
    if (series_.is_sequential)
        engine.advance_sequentially(positions);
    else
        engine.advance(positions);
    return watch.seconds();
}

/// The frame at one and the same place in memory, freshly written, as a solver would leave it.
const double *Replay::stage(std::size_t timestamp) {
    const double *frame = series_.frame(timestamp);
    std::copy(frame, frame + series_.frame_length(), staged_.begin());
    return staged_.data();
}

}  // namespace bench
