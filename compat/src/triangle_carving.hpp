// What Triangle makes of a triangulation with segments: without the concavities and holes, with boundaries marked, and
// regions with their attributes.
#pragma once

#include <deldrift_triangle.h>

#include <cstdint>
#include <vector>

#include <deldrift.h>

#include "triangle_given.hpp"
#include "triangle_graph.hpp"
#include "triangle_mesh.hpp"
#include "triangle_switches.hpp"

namespace compat {

// Of cells: in a concavity or a hole; in no region. Regions count from 1, in the order of their list.
constexpr std::int32_t eaten = -1, without_region = 0;

// Points and pieces of a graph that has been brought into a triangulation, as a mesh without cells.
Mesh outline_of(const Graph &graph, const triangulateio &in);

class Carver {
public:
    // t has cells, and the segments of the outline, with their numbers or none of them. The mesh may refer to both
    // and to what the outline refers to.
    Carver(const triangulateio &in, Mesh outline, const deldrift_triangulation *t, const Cells &cells);

    // The edges of the hull become segments.
    void enclose();

    // Takes away, and spreads regions, as the switches say.
    void carve(const TriangleSwitches &switches);

    // Takes away what is beyond the boundary of triangles that are given.
    void keep(const GivenTriangles &given);
    // Gives the cells that are left the attributes of those.
    void give_attributes_of(const GivenTriangles &given);

    // Of each cell. With labels that are given, carve is not called.
    const std::vector<std::int32_t> &labels() const { return labels_; }
    void set_labels(std::vector<std::int32_t> labels) { labels_ = std::move(labels); }
    // Segments between what has been taken away and what is left, and their ends, are marked.
    void mark_boundary();
    const Mesh &outline() const { return mesh_; }

    Mesh finish(const TriangleSwitches &switches);

private:
    std::uint32_t &segment_at(std::uint32_t cell, unsigned corner) {
        return mesh_.segments.at[std::size_t{3} * cell + corner];
    }
    void find_sides_of_cells();
    void mark_as_boundary(std::uint32_t segment);
    void eat_concavities();
    void eat_holes();
    void spread_regions();
    std::uint32_t cell_at(const double *place) const;
    void flood(std::uint32_t cell, std::int32_t label);
    void give_attributes();
    void take_away(std::size_t n_left);
    void drop_segments();

    const triangulateio &in_;
    const deldrift_triangulation *t_;
    const Cells &cells_;
    std::vector<std::int32_t> labels_;
    std::vector<std::uint32_t> reached_;
    Mesh mesh_;
};

} // namespace compat
