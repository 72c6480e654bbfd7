// SPDX-License-Identifier: GPL-3.0-or-later
// The algorithms of deldrift: those of its headers, and those that only its own tests and this benchmark reach.
#pragma once

#include <deldrift/research.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bench {

enum class Purpose {
    for_use,         // in deldrift.h
    for_comparison,  // in deldrift/research.h
    internal,        // a means of auto's, without a name
};

struct Algorithm {
    const char *name;
    std::uint32_t code;
    Purpose purpose;
    bool is_one_by_one;  // vertices are relocated one after the other
    bool keeps_data;     // between commits
};

const std::vector<Algorithm> &algorithms();

const Algorithm &algorithm_of(std::uint32_t code);

/// A triangulation whose commits are by an algorithm, for deldrift_destroy.
deldrift_triangulation *create_by(const Algorithm &algorithm, unsigned dimension, const double *positions,
                                  std::size_t n_points, unsigned n_threads);

}  // namespace bench
