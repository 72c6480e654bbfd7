// SPDX-License-Identifier: GPL-3.0-or-later
// The algorithms of deldrift: those of its header, and those that only its own tests and this benchmark reach.
#pragma once

#include <deldrift.h>

#include <vector>

namespace bench {

enum class Purpose {
    for_use,
    for_comparison,
    internal,  // a means of auto's, without a name in deldrift.h
};

struct Algorithm {
    const char *name;
    deldrift_algorithm code;
    Purpose purpose;
    bool is_one_by_one;  // vertices are relocated one after the other
    bool keeps_data;     // between commits
};

const std::vector<Algorithm> &algorithms();

const Algorithm &algorithm_of(deldrift_algorithm code);

}  // namespace bench
