// Switch r: the triangles of a mesh that is given, which is to be refined.
#pragma once

#include <deldrift_triangle.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_set>
#include <vector>

#include <deldrift.h>

#include "cells.hpp"

namespace compat {

// What is wrong with the triangles of an input, or an empty string. needs_areas: whether their greatest areas are
// wanted.
std::string what_is_wrong_with_triangles(const triangulateio &in, bool is_zero_based, bool needs_areas);

class GivenTriangles {
public:
    GivenTriangles(const triangulateio &in, bool is_zero_based);

    // Ends of the edges that have a triangle on their left alone, two each.
    const std::vector<std::uint32_t> &boundary() const { return boundary_; }

    // Finds which cells of t, the constrained triangulation of the points with the boundary among its segments, are
    // triangles that are given. t has to stay as it is.
    void find_in(const deldrift_triangulation *t, const Cells &cells);
    // Whether a cell is on the outer side of a boundary edge, opposite a corner.
    bool is_outside(const Cells &cells, std::size_t place) const;

    bool has_attributes() const { return in_.numberoftriangleattributes > 0; }
    double attribute_at(const double *place) const { return number_at(place, in_.triangleattributelist); }
    // 0 for any.
    double greatest_area_at(const double *place) const { return number_at(place, in_.trianglearealist); }

private:
    int orientation(std::uint32_t start, std::uint32_t end, const double *place) const;
    bool has_inside(std::size_t triangle, const double *place) const;
    std::uint32_t triangle_around(const double *place, const std::uint32_t *points) const;
    double number_at(const double *place, const double *numbers) const;

    triangulateio in_;
    // Of the triangles, counter-clockwise.
    std::vector<std::uint32_t> corners_;
    std::vector<std::uint32_t> boundary_;
    std::unordered_set<std::uint64_t> boundary_edges_;
    // The triangles at each point.
    std::vector<std::vector<std::uint32_t>> around_;
    const deldrift_triangulation *t_ = nullptr;
    Cells cells_;
    std::vector<std::uint32_t> of_cells_;
};

} // namespace compat
