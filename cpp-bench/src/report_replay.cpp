// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_replay.hpp"

#include "referee.hpp"

#include <algorithm>
#include <chrono>

namespace bench {
namespace {

constexpr std::size_t n_blocks = 20;
constexpr std::size_t nowhere = SIZE_MAX;

struct Lane {
    const Entrant *entrant;
    std::unique_ptr<Engine> engine;
    std::size_t timestamp = nowhere;
    std::map<std::size_t, std::vector<double>> seconds;
};

class Replay {
public:
    Replay(const Series &series, const std::vector<Entrant> &entrants,
           const std::vector<std::size_t> &check_timestamps, Checks &checks, Progress &progress)
        : series_(series),
          check_timestamps_(check_timestamps),
          checks_(checks),
          progress_(progress),
          staged_(series.frame_length()) {
        for (const Entrant &entrant : entrants) {
            lanes_.emplace_back();
            lanes_.back().entrant = &entrant;
        }
        n_steps_ = (series.n_timestamps() + block_length() - 1) / block_length() * lanes_.size();
    }

    std::size_t n_steps() const { return n_steps_; }

    /// All timestamps once. In blocks of consecutive ones, so that engines share what disturbs from outside.
    void run(bool is_checked) {
        for (Lane &lane : lanes_) {
            lane.engine = lane.entrant->make(series_.dimension);
            lane.timestamp = nowhere;
        }
        for (std::size_t first = 1; first <= series_.n_timestamps(); first += block_length()) {
            const std::size_t last = std::min(first + block_length() - 1, series_.n_timestamps());
            referees_.clear();
            for (Lane &lane : lanes_) {
                run_block(lane, first, last, is_checked);
                progress_.step("timestamp " + std::to_string(last) + ", " + lane.entrant->name());
            }
        }
    }

    std::vector<UpdateTimes> medians() const {
        std::vector<UpdateTimes> times;
        for (const Lane &lane : lanes_) {
            times.emplace_back();
            for (auto [timestamp, seconds] : lane.seconds) {
                std::nth_element(seconds.begin(), seconds.begin() + seconds.size() / 2, seconds.end());
                times.back()[timestamp] = seconds[seconds.size() / 2];
            }
        }
        return times;
    }

private:
    std::size_t block_length() const { return std::max<std::size_t>(1, series_.n_timestamps() / n_blocks); }

    void run_block(Lane &lane, std::size_t first, std::size_t last, bool is_checked) {
        const std::vector<std::size_t> &timestamps = lane.entrant->timestamps;
        auto next = std::lower_bound(timestamps.begin(), timestamps.end(), first);
        for (; next != timestamps.end() && *next <= last; ++next) {
            if (lane.timestamp != *next - 1 || begins_segment(*next)) build(lane, *next - 1);
            lane.seconds[*next].push_back(timed_advance(*lane.engine, *next));
            lane.timestamp = *next;
            if (is_checked && std::binary_search(check_timestamps_.begin(), check_timestamps_.end(), *next))
                referee(*next).judge(*lane.entrant, *lane.engine);
        }
    }

    bool begins_segment(std::size_t timestamp) const {
        return std::any_of(series_.segments.begin(), series_.segments.end(),
                           [&](const Segment &segment) { return segment.first == timestamp; });
    }

    Referee &referee(std::size_t timestamp) {
        std::unique_ptr<Referee> &referee = referees_[timestamp];
        if (!referee) referee = std::make_unique<Referee>(series_, timestamp, checks_);
        return *referee;
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
        const auto start = std::chrono::steady_clock::now();
        if (series_.is_sequential)
            engine.advance_sequentially(positions);
        else
            engine.advance(positions);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    const double *stage(std::size_t timestamp) {
        const double *frame = series_.frame(timestamp);
        std::copy(frame, frame + series_.frame_length(), staged_.begin());
        return staged_.data();
    }

    const Series &series_;
    const std::vector<std::size_t> &check_timestamps_;
    Checks &checks_;
    Progress &progress_;
    std::vector<double> staged_;
    std::vector<Lane> lanes_;
    std::size_t n_steps_ = 0;
    std::map<std::size_t, std::unique_ptr<Referee>> referees_;  // of the block
};

}  // namespace

std::vector<UpdateTimes> replay_report(const Series &series, const std::vector<Entrant> &entrants,
                                       const std::vector<std::size_t> &check_timestamps, unsigned n_repeats,
                                       Checks &checks, Progress &progress) {
    Replay replay(series, entrants, check_timestamps, checks, progress);
    progress.begin(series.name + ": timing " + std::to_string(series.n_timestamps()) + " timestamps, " +
                       std::to_string(entrants.size()) + " engines",
                   n_repeats * replay.n_steps());
    for (unsigned repeat = 0; repeat < n_repeats; ++repeat) replay.run(repeat == 0);
    return replay.medians();
}

}  // namespace bench
