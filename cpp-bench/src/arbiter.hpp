// SPDX-License-Identifier: GPL-3.0-or-later
// Two triangulations of the same positions may differ where points are exactly cocircular or cospherical, and
// nowhere else. The arbiter decides by exact arithmetic which case it is.
#pragma once

#include "cells.hpp"

#include <cstddef>
#include <string>

namespace bench {

struct Verdict {
    bool is_accepted = true;
    std::size_t n_degenerate = 0;  // cells of the first set alone, every one of them excused
    std::string complaint;         // names a cell and its coordinates where not accepted
};

/// Compares two sets of cells of the same positions, named for the complaint. A cell that only one set has is
/// excused if, among the cells of its own set, no vertex opposite one of its facets lies inside its
/// circumscribed circle (sphere) and at least one lies exactly on it. Flat cells are never excused, and the
/// cells that differ must fill the same area (volume) on both sides, computed in rationals.
Verdict compare(unsigned dimension, const double *positions, const CellSet &a, const std::string &name_a,
                const CellSet &b, const std::string &name_b);

struct GapVerdict {
    bool is_explained = false;
    std::size_t n_cells = 0;  // of `cells` alone
};

/// In space, a bi-cell whose facet is inside a sphere and whose opposing vertices are outside need
/// not be Delaunay where the line through the opposing vertices misses the facet: Proposition 1 of
/// the report overlooks that. Explained are cells that are all positively oriented and fill what
/// `reference` fills, with at least one facet that is not Delaunay, and only facets of that kind
/// among these. All of it is decided exactly.
GapVerdict gap_cells(const double *positions, const CellSet &cells, const CellSet &reference);

}  // namespace bench
