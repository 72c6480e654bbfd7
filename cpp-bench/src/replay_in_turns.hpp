// SPDX-License-Identifier: GPL-3.0-or-later
// Replays an input to several engines in turns: every update is timed, and cells are compared right after.
#pragma once

#include "progress.hpp"
#include "series.hpp"
#include "verify.hpp"

#include <map>
#include <vector>

namespace bench {

/// Seconds of an update, by timestamp.
using UpdateTimes = std::map<std::size_t, double>;

/// All timestamps of a series, those of the warm-up of segments only for engines that remember.
std::vector<std::size_t> all_timestamps(const Series &series, bool warms_up);

void forget_warm_up(UpdateTimes &times, const Series &series);

/// Every entrant is replayed at its timestamps `n_repeats` times, of which the median counts. In the first of
/// them cells are compared at `check_timestamps`, outside the clock. Throws Mismatch.
std::vector<UpdateTimes> replay_in_turns(const Series &series, const std::vector<Entrant> &entrants,
                                       const std::vector<std::size_t> &check_timestamps, unsigned n_repeats,
                                       Checks &checks, Progress &progress);

}  // namespace bench
