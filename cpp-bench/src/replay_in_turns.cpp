// SPDX-License-Identifier: GPL-3.0-or-later
#include "replay_in_turns.hpp"

#include "referee.hpp"
#include "replay.hpp"

#include <fmt/format.h>

namespace bench {
namespace {

/// Compares cells at the timestamps to check, by one referee for each timestamp.
class Examination {
public:
    Examination(const Series &series, const std::vector<std::size_t> &timestamps, Checks &checks)
        : series_(series), timestamps_(timestamps), checks_(checks) {}

    void look_at(const Lane &lane, std::size_t timestamp) {
        if (!std::binary_search(timestamps_.begin(), timestamps_.end(), timestamp)) return;
        std::unique_ptr<Referee> &referee = referees_[timestamp];
        if (!referee) referee = std::make_unique<Referee>(series_, timestamp, checks_);
        referee->judge(*lane.entrant, *lane.engine);
    }

    /// No engine comes back to the timestamps so far.
    void go_on() { referees_.clear(); }

private:
    const Series &series_;
    const std::vector<std::size_t> &timestamps_;
    Checks &checks_;
    std::map<std::size_t, std::unique_ptr<Referee>> referees_;
};

/// All timestamps once.
void run_once(const Series &series, std::vector<Lane> &lanes, Examination *examination, Progress &progress) {
    Replay replay(series);
    for (Lane &lane : lanes) lane.restart(series.dimension);
    for (std::size_t first = 1; first <= series.n_timestamps(); first += block_length(series)) {
        const std::size_t last = std::min(first + block_length(series) - 1, series.n_timestamps());
        for (Lane &lane : lanes) {
            replay.run_block(lane, first, last, [&](std::size_t timestamp) {
                if (examination) examination->look_at(lane, timestamp);
            });
            progress.step(fmt::format("timestamp {}, {}", last, lane.entrant->name()));
        }
        if (examination) examination->go_on();
    }
}

UpdateTimes medians_of(const Lane &lane) {
    UpdateTimes times;
    for (const auto &[timestamp, seconds] : lane.seconds) times[timestamp] = median(seconds);
    return times;
}

}  // namespace

std::vector<std::size_t> all_timestamps(const Series &series, bool warms_up) {
    std::vector<std::size_t> timestamps;
    if (series.segments.empty())
        for (std::size_t t = 1; t <= series.n_timestamps(); ++t) timestamps.push_back(t);
    for (const Segment &segment : series.segments)
        for (std::size_t t = warms_up ? segment.begin : segment.first; t <= segment.last; ++t)
            timestamps.push_back(t);
    return timestamps;
}

void forget_warm_up(UpdateTimes &times, const Series &series) {
    for (const Segment &segment : series.segments)
        times.erase(times.lower_bound(segment.begin), times.lower_bound(segment.first));
}

std::vector<UpdateTimes> replay_in_turns(const Series &series, const std::vector<Entrant> &entrants,
                                       const std::vector<std::size_t> &check_timestamps, unsigned n_repeats,
                                       Checks &checks, Progress &progress) {
    std::vector<Lane> lanes = lanes_of(entrants);
    progress.begin(fmt::format("{}: timing {} timestamps, {} engines", series.name, series.n_timestamps(),
                               entrants.size()),
                   n_repeats * n_blocks(series) * lanes.size());
    Examination examination(series, check_timestamps, checks);
    for (unsigned repeat = 0; repeat < n_repeats; ++repeat)
        run_once(series, lanes, repeat == 0 ? &examination : nullptr, progress);
    std::vector<UpdateTimes> times;
    for (const Lane &lane : lanes) times.push_back(medians_of(lane));
    return times;
}

}  // namespace bench
