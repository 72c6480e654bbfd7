// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace bench {

/// Shows that the benchmark's checks fail where they must, and that its inputs are what they claim to be.
/// Prints every failure and a closing count; false where there was one.
bool run_self_test();

}  // namespace bench
