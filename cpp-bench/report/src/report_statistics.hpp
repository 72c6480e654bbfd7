// SPDX-License-Identifier: GPL-3.0-or-later
// Widths and tolerances of recorded positions, and what the figures show of them: everything but time.
#pragma once

#include "progress.hpp"
#include "report_input.hpp"

#include <string>

namespace bench {

/// The average over all vertices of half the least width among their bi-cells, avg(eps(V)), of a frame.
double mean_tolerance(const Series &series, std::size_t timestamp);

/// Writes report_statistics.csv, report_distributions.csv, report_points.csv and report_sections.csv, as far
/// as the input has a part in them, unless it is there.
void write_report_statistics(const ReportInput &input, const std::string &results, Progress &progress);

}  // namespace bench
