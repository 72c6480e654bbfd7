// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms.hpp"

#include <stdexcept>

namespace bench {

const std::vector<Algorithm> &algorithms() {
    static const std::vector<Algorithm> all = {
#define ALGORITHM(name, code, purpose, is_one_by_one, keeps_data) \
    {#name, static_cast<deldrift_algorithm>(code), Purpose::purpose, is_one_by_one, keeps_data},
#include "algorithms.inc"
#undef ALGORITHM
    };
    return all;
}

const Algorithm &algorithm_of(deldrift_algorithm code) {
    for (const Algorithm &algorithm : algorithms())
        if (algorithm.code == code) return algorithm;
    throw std::logic_error("deldrift.h and algorithms.inc do not go together");
}

}  // namespace bench
