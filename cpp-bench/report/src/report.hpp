// SPDX-License-Identifier: GPL-3.0-or-later
// The report RR-6750 repeated: its inputs, its algorithms on CGAL, and deldrift.
#pragma once

#include "options.hpp"

namespace bench {

void run_report(const Options &options);

}  // namespace bench
