// SPDX-License-Identifier: GPL-3.0-or-later
// Every target is measured, or those that are chosen.
#include "targets.hpp"
#include "tests.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace bench {
namespace {

TEST_CASE("targets") {
    Progress progress(Progress::Output::silent);
    std::vector<Checks> checks;
    const std::vector<Target> targets = 
        measure_targets({300, 5, 300, 500, 2, {200, 300}, {200, 300, 400}, 300, 0.02}, 1, checks, progress);
    const auto is_measured = [](const Target &target) {
        return target.reference_ns > 0 && target.contender_ns > 0 && target.wanted >= 0.125;
    };
    // All are measured.
#ifdef DELDRIFT_BENCH_NANOFLANN
    CHECK(targets.size() == 194);
#else
    CHECK(targets.size() == 188);
#endif
    CHECK(std::all_of(targets.begin(), targets.end(), is_measured));
    std::size_t n_comparisons = 0;
    for (const Checks &check : checks) n_comparisons += check.n_comparisons;
    CHECK_MESSAGE(n_comparisons == 322, "the cells of all engines are compared");
    const auto is_swept_in_vain = [](const Target &target) { return target.what == "swept" && target.n_changes > 0; };
    CHECK_MESSAGE(std::none_of(targets.begin(), targets.end(), is_swept_in_vain),
                  "every certificate that is swept holds");
    const auto is_within_as_named = [](const Target &target) {
        return (target.what != "tolerance_test" || target.within == 1) &&
               (target.what != "half_within" || (target.within > 0.4 && target.within < 0.7));
    };
    CHECK_MESSAGE(std::all_of(targets.begin(), targets.end(), is_within_as_named),
                  "all vertices, or half of them, are within tolerance");
    for (const std::string &name : target_names()) {
        const auto has_name = [&](const Target &target) { return target.what == name; };
        CHECK_MESSAGE(std::any_of(targets.begin(), targets.end(), has_name), name);
    }
    Target target = {"", 2, 1, "", "", 30, 10, 3, 0, 0};
    CHECK_MESSAGE(target.verdict() == std::string("pass"), "reached");
    target.contender_ns = 10.1;
    CHECK_MESSAGE(target.verdict() == std::string("missed"), "missed by little");
}

TEST_CASE("chosen targets") {
    Progress progress(Progress::Output::silent);
    std::vector<Checks> checks;
    TargetSizes sizes = {300, 5, 300, 500, 2, {200}, {200, 300, 400}, 300, 0.02};
    sizes.chosen = {"leap_10", "threads_swept", "step_1e-2", "grown_star"};
    std::vector<std::string> names;
    for (const Target &target : measure_targets(sizes, 1, checks, progress))
        if (target.dimension == 2) names.push_back(target.what);
    CHECK(names == std::vector<std::string>({"threads_swept", "leap_10", "leap_10", "step_1e-2", "step_1e-2",
                                             "grown_star", "grown_star"}));
}

}  // namespace
}  // namespace bench
