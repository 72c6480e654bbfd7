// SPDX-License-Identifier: GPL-3.0-or-later
// The report's inputs by steps: what a program pays that also reads the cells and what has changed.
#pragma once

#include "progress.hpp"
#include "replay_in_turns.hpp"
#include "series.hpp"

namespace bench {

struct ReportSteps {
    UpdateTimes deldrift;         // seconds of auto's step
    double cgal_reading_seconds;  // the median of what it takes after a rebuild to write both arrays
};

/// CGAL's rebuilding is not timed once more: its step is what that takes, and the writing of the arrays.
ReportSteps time_report_steps(const Series &series, unsigned n_repeats, Progress &progress);

}  // namespace bench
