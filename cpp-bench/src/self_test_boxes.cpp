// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes that repeat are measured, and their cells compared.
#include "boxes.hpp"
#include "tests.hpp"

#include <algorithm>
#include <string>

namespace bench {
namespace {

TEST_CASE("boxes that repeat") {
    for (const unsigned dimension : {2u, 3u}) {
        Progress progress(Progress::Output::silent);
        BoxChecks checks;
        const std::vector<BoxLine> lines = measure_box(dimension, 600, {1, 2}, 3, checks, progress);
        CHECK(checks.n_comparisons == 7);
        CHECK(checks.n_cells > 7 * (dimension == 2 ? 1'199 : 3'600));
        CHECK(lines.size() == (dimension == 3 && has_voropp() ? 11 : 8));
        CHECK(std::all_of(lines.begin(), lines.end(),
                          [](const BoxLine &line) { return line.reference_ns > 0 && line.contender_ns > 0; }));
        const auto is_wanted = [](const BoxLine &line) {
            return line.timed == "step_0.001" && line.reference == std::string("cgal/periodic") && line.wanted == 12;
        };
        CHECK(std::count_if(lines.begin(), lines.end(), is_wanted) == 1);
    }
}

}  // namespace
}  // namespace bench
