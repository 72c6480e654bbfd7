// SPDX-License-Identifier: GPL-3.0-or-later
// Point sets such as solvers have (lattices, layers, surfaces, graded and clustered clouds) beside CGAL: built, moved
// and at rest.
#pragma once

#include "options.hpp"
#include "progress.hpp"
#include "random.hpp"
#include "verify.hpp"

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace bench {

/// Points, and what their motions need to know of them.
struct SolverPoints {
    std::vector<double> positions;
    double spacing;                      // of the whole: the unit of shifts and translations
    std::vector<double> local_spacings;  // around each point; empty: `spacing` everywhere
    std::vector<double> elsewhere;       // of clouds: places of further points like these
};

/// From where the points are to where they are after a commit.
enum class Motion {
    rest,
    rigid,        // 0.001 spacings along x
    shear,        // x += 0.001 y
    translation,  // 10 spacings
    rotation,     // by 0.01 about the middle
    teleport,     // every 100th vertex goes to a place of another point like these
    half,         // every second vertex goes 0.01 of its own spacing
    scaling,      // by 1.001, about the origin
};

/// "rest", "rigid", ...
const char *name_of(Motion motion);

struct PointSet {
    const char *name;
    unsigned dimension;
    bool is_telling;  // so that a quick run has it
    std::vector<Motion> motions;
    /// So many points, a lattice as many as come nearest.
    SolverPoints (*draw)(unsigned dimension, std::size_t n_points, Random &random);
};

/// Every set there is. What solvers have them is said with their generators.
const std::vector<PointSet> &point_sets();

/// The names, each once.
std::vector<std::string> point_set_names();

/// Where the points are after the motion.
std::vector<double> moved(const SolverPoints &points, unsigned dimension, Motion motion, Random &random);

/// One figure beside CGAL's, in ns per vertex; of sets of five points in ns a set.
struct StructuredLine {
    unsigned dimension;
    std::string points;
    std::size_t n;
    std::string timed;  // "build", "create_destroy", or the motion that a commit follows
    double cgal_ns;     // of CGAL's rebuilding at the same places
    double deldrift_ns;

    double ratio() const { return cgal_ns / deldrift_ns; }
};

/// Build and motions of one set. Cells are compared where `n_points` allows it. Throws Mismatch.
std::vector<StructuredLine> measure_point_set(const PointSet &set, std::size_t n_points, std::uint64_t seed,
                                              std::vector<Checks> &checks, Progress &progress);

/// Everything that a preset has, or the sets of these names at its sizes; and sets of five points.
std::vector<StructuredLine> measure_structured(const Preset &preset, const std::vector<std::string> &chosen,
                                               std::uint64_t seed, std::vector<Checks> &checks, Progress &progress);

/// The lines as tables.
void print_structured(std::ostream &out, const std::vector<StructuredLine> &lines);

/// What files of a preset's sets are called: structured, or structured_full of all sets.
std::string structured_name(const Preset &preset);

/// The file of that name in a folder that exists; returns its path.
std::string write_structured(const std::string &folder, const Preset &preset,
                             const std::vector<StructuredLine> &lines);

/// Measures, and does both.
void run_structured(const Options &options);

}  // namespace bench
