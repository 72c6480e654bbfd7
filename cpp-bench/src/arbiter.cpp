// SPDX-License-Identifier: GPL-3.0-or-later
#include "arbiter.hpp"

#include "cgal_space.hpp"

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

namespace bench {
namespace {

using Facet = std::array<std::uint32_t, 3>;

template <unsigned dimension>
class Arbiter {
    using Space = CgalSpace<dimension>;
    using Point = typename Space::Point;
    static constexpr unsigned n_corners = dimension + 1;

public:
    explicit Arbiter(const double *positions) : positions_(positions) {}

    /// Empty if every cell of `differing`, a part of `all`, is excused; else the reason why one is not.
    std::string complaint(const CellSet &differing, const CellSet &all) const {
        const std::map<Facet, std::vector<std::uint32_t>> opposite = opposite_vertices(differing, all);
        for (const Cell &cell : differing) {
            const CGAL::Orientation orientation = orientation_of(cell);
            if (orientation == CGAL::ZERO) return "is flat: " + describe(cell);
            bool touches = false;
            for (unsigned corner = 0; corner < n_corners; ++corner) {
                for (const std::uint32_t vertex : opposite.at(facet(cell, corner))) {
                    if (vertex == cell[corner]) continue;
                    const int side = side_of_sphere(cell, vertex) * orientation;
                    if (side > 0)
                        return fmt::format("has its neighbours' vertex {} strictly inside its sphere: {}, {}", vertex,
                                           describe(cell), describe(vertex));
                    touches = touches || side == 0;
                }
            }
            if (!touches) return "is in general position with all its neighbours: " + describe(cell);
        }
        return {};
    }

    /// Sum of the absolute determinants of the cells (a multiple of their area or volume), exactly.
    CGAL::Exact_rational extent(const CellSet &cells) const {
        CGAL::Exact_rational sum = 0;
        for (const Cell &cell : cells) sum += CGAL::abs(determinant(cell));
        return sum;
    }

    std::string describe(const Cell &cell) const {
        std::string text = "cell " + to_string(cell);
        for (unsigned corner = 0; corner < n_corners; ++corner) text += ", " + describe(cell[corner]);
        return text;
    }

    /// Whether there are facets that are not Delaunay, and the line
    /// through the opposing vertices misses them all.
    bool has_only_missed_facets(const CellSet &cells) const {
        std::map<Facet, std::vector<std::pair<const Cell *, unsigned>>> sides;
        for (const Cell &cell : cells)
            for (unsigned corner = 0; corner < n_corners; ++corner)
                sides[facet(cell, corner)].push_back({&cell, corner});
        bool has_any = false;
        for (const auto &[facet, bicell] : sides) {
            if (bicell.size() != 2) continue;
            const Cell &cell = *bicell[0].first;
            const std::uint32_t other = (*bicell[1].first)[bicell[1].second];
            if (side_of_sphere(cell, other) * orientation_of(cell) <= 0) continue;
            has_any = true;
            if (passes(cell[bicell[0].second], other, facet)) return false;
        }
        return has_any;
    }

private:
    /// Whether the line through two points passes a triangle.
    bool passes(std::uint32_t a, std::uint32_t b, const Facet &triangle) const {
        int signs[3];
        for (int i = 0; i < 3; ++i)
            signs[i] = orientation_of({a, b, triangle[i], triangle[(i + 1) % 3]});
        return signs[0] == signs[1] && signs[1] == signs[2];
    }

    std::string describe(std::uint32_t vertex) const {
        std::array<double, dimension> place;
        for (unsigned axis = 0; axis < dimension; ++axis) place[axis] = coordinate(vertex, axis);
        return fmt::format("{} at ({:.17g})", vertex, fmt::join(place, ", "));
    }

    static Facet facet(const Cell &cell, unsigned opposite_corner) {
        Facet facet;
        facet.fill(no_vertex);
        unsigned length = 0;
        for (unsigned corner = 0; corner < n_corners; ++corner)
            if (corner != opposite_corner) facet[length++] = cell[corner];
        return facet;
    }

    /// For every facet of `differing`: the corners opposite it in all cells that have it.
    static std::map<Facet, std::vector<std::uint32_t>> opposite_vertices(const CellSet &differing,
                                                                         const CellSet &all) {
        std::map<Facet, std::vector<std::uint32_t>> opposite;
        for (const Cell &cell : differing)
            for (unsigned corner = 0; corner < n_corners; ++corner) opposite[facet(cell, corner)];
        for (const Cell &cell : all)
            for (unsigned corner = 0; corner < n_corners; ++corner) {
                const auto entry = opposite.find(facet(cell, corner));
                if (entry != opposite.end()) entry->second.push_back(cell[corner]);
            }
        return opposite;
    }

    double coordinate(std::uint32_t vertex, unsigned axis) const {
        return positions_[std::size_t{vertex} * dimension + axis];
    }

    Point point(std::uint32_t vertex) const { return Space::point(positions_ + std::size_t{vertex} * dimension); }

    CGAL::Orientation orientation_of(const Cell &cell) const {
        const CgalKernel kernel;
        if constexpr (dimension == 2)
            return kernel.orientation_2_object()(point(cell[0]), point(cell[1]), point(cell[2]));
        else
            return kernel.orientation_3_object()(point(cell[0]), point(cell[1]), point(cell[2]), point(cell[3]));
    }

    /// Positive inside the sphere of a positively oriented cell.
    CGAL::Oriented_side side_of_sphere(const Cell &cell, std::uint32_t vertex) const {
        const CgalKernel kernel;
        if constexpr (dimension == 2)
            return kernel.side_of_oriented_circle_2_object()(point(cell[0]), point(cell[1]), point(cell[2]),
                                                             point(vertex));
        else
            return kernel.side_of_oriented_sphere_3_object()(point(cell[0]), point(cell[1]), point(cell[2]),
                                                             point(cell[3]), point(vertex));
    }

    CGAL::Exact_rational determinant(const Cell &cell) const {
        std::array<std::array<CGAL::Exact_rational, dimension>, dimension> edge;
        for (unsigned row = 0; row < dimension; ++row)
            for (unsigned axis = 0; axis < dimension; ++axis)
                edge[row][axis] = CGAL::Exact_rational(coordinate(cell[row + 1], axis)) -
                                  CGAL::Exact_rational(coordinate(cell[0], axis));
        if constexpr (dimension == 2)
            return CGAL::determinant(edge[0][0], edge[0][1], edge[1][0], edge[1][1]);
        else
            return CGAL::determinant(edge[0][0], edge[0][1], edge[0][2], edge[1][0], edge[1][1], edge[1][2],
                                     edge[2][0], edge[2][1], edge[2][2]);
    }

    const double *positions_;
};

template <unsigned dimension>
Verdict compare_in(const double *positions, const CellSet &a, const std::string &name_a, const CellSet &b,
                   const std::string &name_b) {
    const CellSet only_a = difference(a, b);
    const CellSet only_b = difference(b, a);
    const Arbiter<dimension> arbiter(positions);

    Verdict verdict;
    verdict.n_degenerate = only_a.size();
    const std::pair<const CellSet *, const std::string *> sides[2] = {{&only_a, &name_a}, {&only_b, &name_b}};
    for (const auto &[only, name] : sides) {
        const std::string complaint = arbiter.complaint(*only, only == &only_a ? a : b);
        if (complaint.empty()) continue;
        verdict.is_accepted = false;
        verdict.complaint = "a cell of " + *name + " alone " + complaint;
        return verdict;
    }
    if (arbiter.extent(only_a) != arbiter.extent(only_b)) {
        verdict.is_accepted = false;
        verdict.complaint = "the cells that differ between " + name_a + " and " + name_b +
                            " do not fill the same space, beginning with " +
                            arbiter.describe(only_a.empty() ? only_b.front() : only_a.front());
    }
    return verdict;
}

}  // namespace

GapVerdict gap_cells(const double *positions, const CellSet &cells, const CellSet &reference) {
    const Arbiter<3> arbiter(positions);
    GapVerdict verdict;
    verdict.n_cells = difference(cells, reference).size();
    // Cells overlap or are inverted where absolute volumes add up to more.
    const CellSet extra = difference(cells, reference), missing = difference(reference, cells);
    verdict.is_explained =
        arbiter.has_only_missed_facets(cells) && arbiter.extent(extra) == arbiter.extent(missing);
    return verdict;
}

Verdict compare(unsigned dimension, const double *positions, const CellSet &a, const std::string &name_a,
                const CellSet &b, const std::string &name_b) {
    return dimension == 2 ? compare_in<2>(positions, a, name_a, b, name_b)
                          : compare_in<3>(positions, a, name_a, b, name_b);
}

}  // namespace bench
