// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of deldrift's C interface as exceptions.
#pragma once

#include <deldrift.h>

#include <stdexcept>
#include <string>

namespace bench {

/// Throws std::runtime_error unless the call did what it was asked to do.
inline void require(deldrift_status status, const char *call) {
    if (status != DELDRIFT_OK) throw std::runtime_error(std::string(call) + ": " + deldrift_last_error());
}

}  // namespace bench
