// SPDX-License-Identifier: GPL-3.0-or-later
// Correctness, apart from timing: at chosen timestamps every engine's cells are compared.
#pragma once

#include "engine.hpp"
#include "progress.hpp"
#include "series.hpp"

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace bench {

/// An engine and the timestamps it takes part in, ascending. Where the timestamp before is not among them,
/// the engine is built there from nothing, outside the clock.
struct Entrant {
    const EngineKind *kind = nullptr;
    unsigned n_threads = 1;
    std::vector<std::size_t> timestamps;

    std::string name() const;
    std::unique_ptr<Engine> make(unsigned dimension) const { return kind->make(dimension, n_threads); }
};

/// What was compared, for the closing summary.
struct Checks {
    std::string scenario;
    std::size_t n_points = 0;
    std::size_t n_timestamps = 0;   // at which cells were compared
    std::size_t n_comparisons = 0;  // of an engine's set of cells
    std::size_t n_cells = 0;        // in deldrift's sets, over those timestamps
    std::size_t n_degenerate = 0;   // of these, not CGAL's, but exactly cocircular or cospherical
    // Cells of the report's algorithms on CGAL that its Proposition 1 wrongly takes for Delaunay, by engine.
    std::map<std::string, std::size_t> n_unproved;
    std::size_t n_coincident = 0;   // points at the place of one with a lower id, greatest count
};

/// A difference that exact arithmetic does not excuse, or a failed validation.
struct Mismatch : std::runtime_error {
    Mismatch(const std::string &message, std::size_t at) : std::runtime_error(message), timestamp(at) {}
    std::size_t timestamp;
};

/// Replays the series to every entrant and compares at `check_timestamps`: deldrift's engines must have
/// exactly the cells of a fresh deldrift build; CGAL's engines and that fresh build must have those of CGAL's
/// rebuilding, up to exactly degenerate cells. Throws Mismatch.
Checks verify(const Series &series, const std::vector<Entrant> &entrants,
              const std::vector<std::size_t> &check_timestamps, Progress &progress);

/// Compares a fresh deldrift build of the first frame with CGAL's, up to
/// exactly degenerate cells. Throws Mismatch.
Checks verify_build(const Series &series, Progress &progress);

}  // namespace bench
