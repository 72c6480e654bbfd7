// SPDX-License-Identifier: GPL-3.0-or-later
// Points with weights: deldrift's triangulations of them, which move, beside CGAL's regular ones, which are rebuilt.
#pragma once

#include "options.hpp"
#include "progress.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bench {

/// Something timed on both sides, in ns per vertex.
struct WeightLine {
    unsigned dimension;
    std::size_t n_points;
    double greatest;  // weight at first, in squares of the spacing
    double hidden;    // share of the vertices that are hidden at the end
    std::string timed;
    std::string reference;
    std::string contender;
    double reference_ns;
    double contender_ns;
    double wanted;  // of the ratio; 0: nothing

    double ratio() const { return reference_ns / contender_ns; }
    const char *verdict() const { return wanted == 0 ? "" : ratio() >= wanted ? "pass" : "missed"; }
};

/// How often everything is timed.
struct WeightEfforts {
    std::size_t n_builds;
    std::size_t n_steps;  // of each kind, after three that are not timed
};

/// What was compared.
struct WeightChecks {
    std::size_t n_comparisons = 0;
    std::size_t n_cells = 0;
    std::size_t n_hidden = 0;
};

/// Every figure of random points in the unit square or cube, the weights of which are from 0 to so many squares of the
/// spacing. Cells and hidden vertices are CGAL's at every timestamp; throws std::runtime_error where not.
std::vector<WeightLine> measure_weights(unsigned dimension, std::size_t n_points, double greatest,
                                        const WeightEfforts &efforts, std::uint64_t seed, WeightChecks &checks,
                                        Progress &progress);

/// A table, of small sizes unless nothing else is to be done; then of all, and weights.csv.
void run_weights(const Options &options);

}  // namespace bench
