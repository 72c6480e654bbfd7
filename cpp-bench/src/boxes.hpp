// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes that repeat: deldrift's periodic triangulations beside CGAL's and beside open ones, Voronoi volumes beside voro++.
#pragma once

#include "options.hpp"
#include "progress.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bench {

/// Something timed on both sides, in ns per vertex.
struct BoxLine {
    unsigned dimension;
    std::size_t n_points;
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
struct BoxEfforts {
    std::size_t n_builds;
    std::size_t n_steps;  // of each length, after three that are not timed
};

/// What was compared.
struct BoxChecks {
    std::size_t n_comparisons = 0;
    std::size_t n_cells = 0;
};

/// Every figure of random points in the unit box. Cells are CGAL's at every timestamp, volumes add up to the box; throws
/// std::runtime_error where not.
std::vector<BoxLine> measure_box(unsigned dimension, std::size_t n_points, const BoxEfforts &efforts, std::uint64_t seed,
                                 BoxChecks &checks, Progress &progress);

/// Whether voro++ was there when the benchmark was built.
bool has_voropp();

/// Table and boxes.csv.
void run_boxes(const Options &options);

}  // namespace bench
