// SPDX-License-Identifier: GPL-3.0-or-later
// The report's inputs by name: how large, and recorded.
#pragma once

#include "body.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "series.hpp"

#include <optional>
#include <string>

namespace bench {

struct ReportInput {
    Series series;
    std::optional<Body> body;  // of `man`, in the series' scale
};

/// What a preset does with an input.
struct ReportEffort {
    std::size_t n_points;
    std::size_t n_timestamps;       // of a segment, where there are segments
    std::size_t n_slow_timestamps;  // of these, how many slow engines are timed at in 3D
    std::size_t n_checks;
    unsigned n_repeats;
};

ReportEffort report_effort(const std::string &scenario, const Options &options);

/// Records the input, or reads it from an earlier run with the same sizes and seed.
ReportInput report_input(const std::string &scenario, const Options &options, Progress &progress);

}  // namespace bench
