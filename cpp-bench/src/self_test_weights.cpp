// SPDX-License-Identifier: GPL-3.0-or-later
// Points with weights are measured, and their cells and hidden vertices compared.
#include "tests.hpp"
#include "weights.hpp"

#include <algorithm>
#include <string>

namespace bench {
namespace {

TEST_CASE("points with weights") {
    for (const unsigned dimension : {2u, 3u}) {
        for (const double greatest : {0.1, 4.0}) {
            Progress progress(Progress::Output::silent);
            WeightChecks checks;
            const std::vector<WeightLine> lines =
                measure_weights(dimension, 600, greatest, {1, 2}, 3, checks, progress);
            CHECK(checks.n_comparisons == 5);
            CHECK(checks.n_cells > 5 * (dimension == 2 ? 600 : 1'500));
            CHECK(lines.size() == 4);
            CHECK(std::all_of(lines.begin(), lines.end(),
                              [](const WeightLine &line) { return line.reference_ns > 0 && line.contender_ns > 0; }));
            const auto is_wanted = [](const WeightLine &line) { return line.wanted > 0; };
            CHECK(std::count_if(lines.begin(), lines.end(), is_wanted) == (greatest == 0.1 ? 3 : 0));
            // Small weights hide hardly any vertex, great ones nearly half of all.
            CHECK((lines.front().hidden > 0.3) == (greatest == 4.0));
            CHECK(checks.n_hidden < 5 * 600 * (greatest == 4.0 ? 0.6 : 0.01));
        }
    }
}

}  // namespace
}  // namespace bench
