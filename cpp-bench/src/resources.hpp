// SPDX-License-Identifier: GPL-3.0-or-later
// Memory per vertex, and the largest triangulations.
#pragma once

#include "options.hpp"

namespace bench {

/// Bytes per vertex of CGAL and deldrift at a million points in both dimensions: table and memory.csv.
void run_memory(const Options &options);

/// Build, validate and commit as many points as a machine holds: table and large.csv.
void run_large(const Options &options);

}  // namespace bench
