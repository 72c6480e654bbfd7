// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of domains by Delaunay refinement: deldrift's beside those of CGAL's Delaunay_mesher_2, of the same quality.
#pragma once

#include "options.hpp"
#include "progress.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bench {

/// Places, segments between them, and a place in each hole. The first `n_loops` segments are loops.
struct Outline {
    std::string name;
    std::vector<double> points;
    std::vector<std::array<std::uint32_t, 2>> segments;
    std::size_t n_loops = 0;
    std::vector<std::array<double, 2>> holes;

    std::size_t n_points() const { return points.size() / 2; }
};

/// Those of benches/refine/domains.rs: a square, one with a hole, a letter with small angles, a slit, an L and a ring.
std::vector<Outline> outlines();

/// A square with an elliptic hole, whose boundary turns.
Outline stirrer();

/// All turn about the centre of the stirrer by an angle: the hole with what is near it as a whole, the square not at all.
void stir(double angle, std::vector<double> &points);

/// The area of the domain, from its loops.
double area_of(const Outline &outline);

/// What cells must fulfil: a least angle, in degrees, and a greatest length of edges. These are the two bounds of CGAL's
/// Delaunay_mesh_size_criteria_2, and deldrift's least angle with one size at all vertices.
struct Quality {
    double least_angle;
    double greatest_length;
};

/// What cells are.
struct Mesh {
    std::size_t n_cells = 0;
    double least_angle = 180;
    double greatest_length = 0;
    double area = 0;

    void add(const std::array<const double *, 3> &corners);
};

/// One mesh, or step, on both sides.
struct MeshLine {
    std::string domain;
    Quality quality;
    std::string timed;
    Mesh reference;
    Mesh contender;
    double reference_seconds;
    double contender_seconds;
    double ratio;   // the median of those of each turn
    double wanted;  // of the ratio, 0 for none
};

struct MeshEfforts {
    std::size_t n_turns;
    std::size_t n_steps;     // of the moving loop that are not timed, so that it has found its way
    std::size_t n_measured;  // that are
    std::vector<double> lengths;
};

/// All meshes. Throws std::runtime_error where a mesh does not have the area of the domain, or an edge is too long.
std::vector<MeshLine> measure_meshes(const MeshEfforts &efforts, Progress &progress);

/// Table and meshes.csv.
void run_meshes(const Options &options);

}  // namespace bench
