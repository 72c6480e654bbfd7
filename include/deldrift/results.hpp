// What members of deldrift::Triangulation return or take that is more than numbers. Included by deldrift.hpp.
#ifndef DELDRIFT_RESULTS_HPP
#define DELDRIFT_RESULTS_HPP

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "positions.hpp"
#include "span.hpp"

namespace deldrift {

// For each cell; see deldrift_circumcentres.
struct Circumspheres {
    std::vector<double> centres;
    std::vector<double> squared_radii;
};

// What was met as means were transferred, and by component the content that was lost and gained; see
// deldrift_transfer_cells.
struct Transfer {
    deldrift_transfer_report report;
    std::vector<double> lost;
    std::vector<double> gained;
};

// Facets with the cell and the corner that each belongs to; see deldrift_mask_boundary.
struct Facets {
    std::vector<std::uint32_t> vertices;  // rows of as many as the dimension says
    std::vector<std::uint32_t> cells;
    std::vector<std::uint8_t> corners;
    std::size_t size() const noexcept { return cells.size(); }
};

// A list for each vertex; see deldrift_vertex_neighbours and deldrift_vertex_cells.
struct Lists {
    std::vector<std::uint32_t> offsets{};
    std::vector<std::uint32_t> entries{};
    span<const std::uint32_t> of_vertex(std::uint32_t vertex) const noexcept {
        return {entries.data() + offsets[vertex], std::size_t{offsets[vertex + 1]} - offsets[vertex]};
    }
};

// Vertices at the place of others, which represent them: see deldrift_hidden_vertices.
struct Hidden {
    std::vector<std::uint32_t> vertices;
    std::vector<std::uint32_t> representatives;
    std::size_t size() const noexcept { return vertices.size(); }
};

// A number for each vertex; see deldrift_create_weighted.
struct Weights {
    explicit Weights(span<const double> of) noexcept : numbers(of) {}
    span<const double> numbers;
};

// The radius of a ball for each vertex: the weights are their squares, each rounded once. In place of Weights, for as
// long as this lives.
struct Radii {
    explicit Radii(span<const double> of) : squares(of.begin(), of.end()) {
        for (std::size_t i = 0; i < squares.size(); i++) {
            if (!(squares[i] >= 0)) {
                const std::string what = "radii[" + std::to_string(i) + "] is " + std::to_string(squares[i]);
                throw Error(DELDRIFT_INVALID_VALUE, what + ", and must be 0 or more");
            }
            squares[i] *= squares[i];
        }
    }
    operator Weights() const noexcept { return Weights(squares); }
    std::vector<double> squares;
};

// Vertices that heavier ones hide, and the cell that each is above: see deldrift_hidden_by_weight.
struct HiddenByWeight {
    std::vector<std::uint32_t> vertices;
    std::vector<std::uint32_t> cells;
    std::size_t size() const noexcept { return vertices.size(); }
};

// What there is of Voronoi cells in a box, and maybe in half-spaces, by vertex id: see deldrift_voronoi_cells and
// deldrift_voronoi_cells_within. NaN where a mask has 0.
struct VoronoiCells {
    std::vector<double> volumes;
    std::vector<double> areas;
    // Rows of coordinates.
    std::vector<double> centroids;
};

// Voronoi facets in a box, in the order of the edges: see deldrift_voronoi_derivatives. NaN where a mask has 0.
struct VoronoiDerivatives {
    std::vector<double> measures;
    // Rows of coordinates.
    std::vector<double> centroids;
    // Two rows of coordinates for each edge.
    std::vector<double> derivatives;
};

// Volumes of Voronoi cells by vertex id, and for each edge the derivative of that of either end by the weight of the
// other one: see deldrift_voronoi_weight_derivatives. NaN where a mask has 0.
struct VoronoiWeightDerivatives {
    std::vector<double> volumes;
    std::vector<double> derivatives;
};

// The vectors of a periodic box, one after the other; see deldrift_create_periodic.
struct Periodic {
    explicit Periodic(const Positions &of) noexcept : vectors(of) {}
    Positions vectors;
};

// Rows of as many multiples of vectors as the dimension says, one for each corner of each cell; see deldrift_cell_shifts.
struct CellShifts {
    std::vector<std::int64_t> corners{};
    std::vector<std::int64_t> neighbours{};
};

// Where points lie, and rows of as many multiples of vectors as the dimension says, by which what is there is translated; see
// deldrift_locate_in_period.
struct PeriodLocations {
    std::vector<deldrift_location> locations{};
    std::vector<std::int64_t> shifts{};
};

// Rows of numbers of vectors, and of the multiples that they are; see deldrift_reduced_vectors.
struct ReducedVectors {
    std::vector<double> vectors{};
    std::vector<std::int64_t> multiples{};
    std::vector<std::uint32_t> greatest{};
};

// Positions in the box, and rows of multiples of vectors; see deldrift_wrap_positions.
struct WrappedPositions {
    std::vector<double> places{};
    std::vector<std::int64_t> shifts{};
};

// Cells that a vertex in a box could change, and balls that cover theirs; see deldrift_cells_in_reach.
struct InReach {
    std::vector<std::uint32_t> cells{};
    std::vector<double> centres{};  // rows of as many as the dimension says
    std::vector<double> radii{};
    std::size_t size() const noexcept { return cells.size(); }
};

// A list of vertices for each box; see deldrift_vertices_in_reach.
struct BoxLists {
    std::vector<std::size_t> offsets{};
    std::vector<std::uint32_t> vertices{};
    span<const std::uint32_t> of_box(std::size_t box) const noexcept {
        return {vertices.data() + offsets[box], offsets[box + 1] - offsets[box]};
    }
};

// For each vertex id the vertices that are near it, one list after the other. Of a triangulation that is periodic each has a row of
// shifts: in which period it is.
struct NeighbourLists {
    std::vector<std::size_t> offsets{};
    std::vector<std::uint32_t> neighbours{};
    std::vector<std::int64_t> shifts{};
    span<const std::uint32_t> of_vertex(std::size_t vertex) const noexcept {
        return {neighbours.data() + offsets[vertex], offsets[vertex + 1] - offsets[vertex]};
    }
};

// Numbers for each vertex id, or for each cell, that are written along with a mesh: components for each.
struct Field {
    std::string name;
    span<const double> values;
    std::size_t components = 1;
};

}  // namespace deldrift

#endif  // DELDRIFT_RESULTS_HPP
