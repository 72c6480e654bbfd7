// SPDX-License-Identifier: GPL-3.0-or-later
// Timing, apart from correctness: the same positions to every engine, in turns, only the update on the clock.
#pragma once

#include "progress.hpp"
#include "series.hpp"
#include "table.hpp"
#include "verify.hpp"

#include <vector>

namespace bench {

/// Times every entrant at its timestamps, `n_repeats` times over, and keeps the median of each timestamp. The
/// first entrant is the baseline, and of steps the first one among them; it must take part in every timestamp that
/// another one takes part in.
std::vector<Row> measure(const Series &series, const std::vector<Entrant> &entrants, unsigned n_repeats,
                         Progress &progress);

/// Times the triangulation of one frame from nothing, by the first frame of the series.
std::vector<Row> measure_build(const Series &series, const std::vector<Entrant> &entrants, unsigned n_repeats,
                               Progress &progress);

}  // namespace bench
