// SPDX-License-Identifier: GPL-3.0-or-later
// NumPy's .npy files, as far as recorded positions need them: little-endian f64 or f32, C order.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace bench {

struct NpyArray {
    std::vector<std::size_t> shape;
    std::vector<double> values;  // C order; f32 is widened
};

/// Throws std::runtime_error naming the file and what is wrong with it.
NpyArray read_npy(const std::string &path);

/// Writes f64 values; `values.size()` must be the product of `shape`.
void write_npy(const std::string &path, const NpyArray &array);

}  // namespace bench
