// SPDX-License-Identifier: GPL-3.0-or-later
// The benchmark proper: every scenario recorded, checked, timed; the table and bench.csv at the end.
#pragma once

#include "options.hpp"

namespace bench {

void run_scenarios(const Options &options);

}  // namespace bench
