// SPDX-License-Identifier: GPL-3.0-or-later
// What a step costs beside a commit, and beside CGAL's step, by how far the vertices go.
#pragma once

#include "progress.hpp"
#include "table.hpp"
#include "verify.hpp"

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace bench {

/// Times in ns per vertex. Every vertex goes `displacement` spacings at each timestamp.
struct StepLine {
    unsigned dimension;
    std::size_t n;
    double displacement;
    std::size_t timestamps;
    double cgal_step;
    double commit;  // of a triangulation that is not read
    double step;
};

/// How often vertices go a displacement against the clock: small inputs more often.
std::size_t step_timestamps(std::size_t n_points);

/// One engine beside others, by displacement: random points in a disk or ball at unit density, from which every
/// displacement starts from a build. For each displacement and kind the median over the timestamps, in ns per vertex.
/// Cells are compared after the last timestamp of a displacement, of large inputs only after that of the last
/// displacement.
std::vector<std::vector<double>> replay_displacements(const std::string &name, unsigned dimension,
                                                      std::size_t n_points, const std::vector<double> &displacements,
                                                      const std::vector<const EngineKind *> &kinds,
                                                      unsigned n_repeats, std::uint64_t seed, Checks &checks,
                                                      Progress &progress);

/// CGAL's rebuilding, and auto without and with readings, at rest and by three displacements.
std::vector<StepLine> measure_steps(unsigned dimension, std::size_t n_points, unsigned n_repeats, std::uint64_t seed,
                                    Checks &checks, Progress &progress);

/// The three times of a line, for bench.csv: the scenario is as in `step_2d_1e-3`.
std::vector<Row> rows_of(const StepLine &line);

/// "0" or "1e-3".
std::string displacement_name(double displacement);

void print_steps(std::ostream &out, const std::vector<StepLine> &lines);

}  // namespace bench
