// SPDX-License-Identifier: GPL-3.0-or-later
// Positions that the report alone has: see scenarios.hpp for those of the benchmark.
#pragma once

#include "progress.hpp"
#include "series.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bench {

/// Lloyd's iterations of random points in a ball at unit density. The centroid of a Voronoi cell inside the
/// ball is exact; that of a cell that reaches beyond is by quadrature over directions (ball_cell.hpp).
Series record_slloyd(std::size_t n_points, std::size_t n_timestamps, std::uint64_t seed, Progress &progress);

/// ODT in a ball at unit density, vertices moved one after another: the new place of a vertex is
/// the mean of its star's circumcentres, weighted by volume. A point per unit of area is on the
/// sphere (a spiral lattice) and stays; the others begin at random places inside. A vertex that
/// would leave the ball stays for this sweep.
Series record_snodt(std::size_t n_points, std::size_t n_timestamps, std::uint64_t seed, Progress &progress);

class Body;

/// The same in a body. Points on its surface are drawn evenly (best of ten candidates) and stay.
Series record_man(const Body &body, std::size_t n_points, std::size_t n_timestamps, std::uint64_t seed,
                  Progress &progress);

/// The new place of a vertex by ODT: `star` holds the other three corners of each of
/// its cells. False if the star has no volume.
bool odt_place(const double *vertex, const std::vector<const double *> &star, double *place);

}  // namespace bench
