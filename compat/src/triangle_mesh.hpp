// What is written to Triangle's output.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cells.hpp"

namespace compat {

constexpr std::uint32_t no_segment = UINT32_MAX;

// Segments, each an edge, with their markers.
struct Segments {
    std::vector<std::uint32_t> ends; // two points each
    std::vector<int> markers;
    std::vector<std::uint32_t> at; // for each cell and corner the segment at the edge opposite, or no_segment
    std::size_t count() const { return markers.size(); }
    void add(std::uint32_t start, std::uint32_t end, int marker) {
        ends.insert(ends.end(), {start, end});
        markers.push_back(marker);
    }
};

// Points and cells; with switch p or c also segments, and what belongs to them.
struct Mesh {
    std::size_t n_points = 0, n_attributes = 0; // the points given come first
    const double *points = nullptr, *attributes = nullptr;
    Cells cells;
    std::vector<std::uint32_t> representative; // where cells do not tell which points to leave out, see triangle_writer.hpp
    bool has_segments = false;
    std::vector<int> point_markers;
    Segments segments;
    std::size_t n_holes = 0, n_regions = 0;
    bool has_cell_attributes = false;
    std::vector<double> cell_attributes;

    // Where they are not someone else's.
    OwnedCells own;
    std::vector<double> own_points, own_attributes;
};

// Everything in an order that depends on points and their numbers alone.
void sort(Mesh &mesh);

// Segments::at, from the ends of the segments.
void find_sides(const Cells &cells, Segments &segments);

} // namespace compat
