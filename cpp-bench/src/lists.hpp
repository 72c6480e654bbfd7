// SPDX-License-Identifier: GPL-3.0-or-later
// Lists of what is near all vertices, beside linked cells, and nanoflann where that is installed.
#pragma once

#include "progress.hpp"
#include "table.hpp"
#include "targets.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bench {

/// Rows of bench.csv for sets of `n` points, fewer where half of them are in a cluster. The lists are compared; throws
/// Mismatch.
std::vector<Row> list_rows(unsigned dimension, std::size_t n, std::uint64_t seed, Progress &progress);

/// The same sets, beside the speed-ups wanted.
std::vector<Target> list_targets(unsigned dimension, const TargetSizes &sizes, std::uint64_t seed, Progress &progress);

}  // namespace bench
