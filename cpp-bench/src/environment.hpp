// SPDX-License-Identifier: GPL-3.0-or-later
// What the figures were measured with: a text file beside each CSV file.
#pragma once

#include <string>

namespace bench {

/// `command` is the command line. Throws std::runtime_error where the file cannot be written.
void write_environment(const std::string &path, const std::string &command);

}  // namespace bench
