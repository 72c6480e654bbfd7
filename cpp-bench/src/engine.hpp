// SPDX-License-Identifier: GPL-3.0-or-later
// An engine keeps one Delaunay triangulation of moving points up to date. The harness sees nothing else
// of it.
#pragma once

#include "algorithms.hpp"
#include "reading.hpp"

#include <deldrift.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace bench {

struct Counts {
    std::uint64_t changes = 0;  // flips, placements and rebuilds
    std::uint64_t within_tolerance = 0;
};

class Engine {
public:
    virtual ~Engine() = default;

    /// Lays positions out in the engine's own input type, before `build` or `advance` is called with the same
    /// ones. Never timed.
    virtual void prepare(const double * /*positions*/, std::size_t /*n_points*/) {}

    /// The triangulation of these positions from nothing, whatever was held before.
    virtual void build(const double *positions, std::size_t n_points) = 0;

    /// From the positions held to these, of the same points. This is what is timed.
    virtual void advance(const double *positions) = 0;

    /// The same where vertices move one after another, in the order of their ids, and the triangulation must
    /// be that of the positions so far after each of them. Engines that rebuild do so once for all.
    virtual void advance_sequentially(const double *positions) { advance(positions); }

    /// Before `build`: readings follow every update, and should say what has changed.
    virtual void expect_readings() {}

    /// The cells as arrays, written where the engine does not hold them so, and what has changed since the reading
    /// before where it tells. Throws std::logic_error for the report's algorithms.
    virtual Reading read();

    /// What a program does at each timestamp: it hands positions over, and reads.
    Reading step(const double *positions) {
        advance(positions);
        return read();
    }

    /// What a program does with each vertex in a sequential scheme: it reads the places of the corners of the
    /// vertex's cells, and puts the vertex at a new place at once. The sum of the coordinates read, by which no
    /// compiler can leave the reading out. Visits follow each other or a build. Throws std::logic_error where the
    /// engine relocates nothing.
    virtual double visit(std::uint32_t vertex, const double *place);

    /// From now on updates are not timed, and examined by the way: `validate` tells what was found.
    virtual void be_examined() {}

    /// Finite cells, dimension + 1 vertex ids each. Coincident points may appear under any of their ids.
    virtual std::vector<std::uint32_t> cells() = 0;

    /// The library's own examination of its state; throws std::runtime_error with the first violation.
    virtual void validate() {}

    /// What the library says it has allocated, or 0 where it does not say.
    virtual std::size_t reported_bytes() const { return 0; }

    /// What all updates so far have done, nothing where the library does not count it.
    virtual Counts counts() const { return {}; }
};

/// Makes an engine for a dimension and a number of threads, which CGAL's take no notice of.
using EngineMaker = std::function<std::unique_ptr<Engine>(unsigned dimension, unsigned n_threads)>;

/// What the tables call an engine and how the harness may treat it.
struct EngineKind {
    std::string engine;     // "cgal" or "deldrift"
    std::string algorithm;  // "rebuilding", "placement", ...
    bool is_stateless;      // the result does not depend on earlier timestamps: can be checked out of order
    bool is_slow_in_3d;     // relocates every vertex by itself: timed on a sample of the timestamps in 3D
    EngineMaker make;
    bool is_reproduction = false;  // the report's algorithm on CGAL: elsewhere it runs where it is named only
    bool is_step = false;          // an update ends with a reading: see step.hpp
    bool keeps_data = false;       // between updates, so that its cost depends on those before
    bool is_internal = false;      // a means of deldrift's auto: it runs where it is named in full only

    std::string base_name() const { return engine + "/" + algorithm; }
    std::string name() const { return base_name() + (is_step ? " step" : ""); }
};

/// Every engine there is; the first is the baseline, CGAL's rebuilding.
const std::vector<EngineKind> &engine_kinds();

/// The kind called `name` ("deldrift/auto"); throws std::runtime_error where there is none.
const EngineKind &engine_kind(const std::string &name);

std::unique_ptr<Engine> make_cgal_rebuilding(unsigned dimension, unsigned n_threads);
std::unique_ptr<Engine> make_cgal_placement(unsigned dimension, unsigned n_threads);
std::unique_ptr<Engine> make_cgal_move(unsigned dimension, unsigned n_threads);
std::unique_ptr<Engine> make_cgal_tolerance(unsigned dimension, unsigned n_threads);
std::unique_ptr<Engine> make_cgal_safe_region(unsigned dimension, unsigned n_threads);
std::unique_ptr<Engine> make_cgal_safe_region_tolerance(unsigned dimension, unsigned n_threads);
std::unique_ptr<Engine> make_cgal_rebuilding_tolerance(unsigned dimension, unsigned n_threads);

EngineMaker deldrift_by(const Algorithm &algorithm);

/// The same, but positions are staged by `prepare`: an update is the commit alone.
EngineMaker deldrift_staged_by(const Algorithm &algorithm);

}  // namespace bench
