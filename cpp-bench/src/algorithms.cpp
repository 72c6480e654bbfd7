// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms.hpp"
#include "library.hpp"

#include <stdexcept>

namespace bench {

const std::vector<Algorithm> &algorithms() {
    static const std::vector<Algorithm> all = {
#define ALGORITHM(name, code, purpose, is_one_by_one, keeps_data) \
    {#name, code, Purpose::purpose, is_one_by_one, keeps_data},
#include "algorithms.inc"
#undef ALGORITHM
    };
    return all;
}

const Algorithm &algorithm_of(std::uint32_t code) {
    for (const Algorithm &algorithm : algorithms())
        if (algorithm.code == code) return algorithm;
    throw std::logic_error("the headers and algorithms.inc do not go together");
}

deldrift_triangulation *create_by(const Algorithm &algorithm, unsigned dimension, const double *positions,
                                  std::size_t n_points, unsigned n_threads) {
    const bool is_for_use = algorithm.purpose == Purpose::for_use;
    deldrift_options options;
    deldrift_options_init(&options);
    options.threads = n_threads;
    if (is_for_use) options.algorithm = static_cast<deldrift_algorithm>(algorithm.code);
    deldrift_triangulation *t = nullptr;
    require(deldrift_create(dimension, positions, n_points, &options, &t), "deldrift_create");
    if (!is_for_use)
        require(deldrift_research_set_algorithm(t, static_cast<deldrift_research_algorithm>(algorithm.code), nullptr),
                "deldrift_research_set_algorithm");
    return t;
}

}  // namespace bench
