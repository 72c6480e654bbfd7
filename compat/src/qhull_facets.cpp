#include "qhull_facets.hpp"

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace compat {

namespace {

class Closing {
public:
    Closing(const Cells &cells, const std::vector<bool> &is_flat) : n(cells.n_corners), cells_(cells) {
        result.n_corners = n;
        result.corners.reserve(cells.count * n + cells.count);
        result.neighbours.reserve(cells.count * n + cells.count);
        if (is_flat.empty()) {
            result.corners.assign(cells.vertices, cells.vertices + cells.count * n);
            result.neighbours.assign(cells.neighbours, cells.neighbours + cells.count * n);
            result.n_lower = cells.count;
        } else {
            copy_those_left(is_flat);
        }
    }

    // False if two facets above would have to be one.
    bool close(std::uint32_t apex) {
        std::vector<std::size_t> boundary;
        for (std::size_t slot = 0; slot < result.n_lower * n; slot++)
            if (result.neighbours[slot] == no_cell) boundary.push_back(slot);
        if (apex == no_cell) apex = point_of(boundary);
        if (apex == no_cell) return false;
        for (const std::size_t slot : boundary) add_above(slot, apex);
        for (const std::size_t slot : boundary)
            if (!join(slot, apex)) return false;
        return std::find(result.neighbours.begin(), result.neighbours.end(), no_cell) == result.neighbours.end();
    }

    QhullFacets result;

private:
    void copy_those_left(const std::vector<bool> &is_flat) {
        std::vector<std::uint32_t> index(cells_.count, no_cell);
        std::uint32_t count = 0;
        for (std::size_t cell = 0; cell < cells_.count; cell++)
            if (!is_flat[cell]) index[cell] = count++;
        result.n_lower = count;
        for (std::size_t slot = 0; slot < cells_.count * n; slot++) {
            if (is_flat[slot / n]) continue;
            const std::uint32_t neighbour = cells_.neighbours[slot];
            result.corners.push_back(cells_.vertices[slot]);
            result.neighbours.push_back(neighbour == no_cell ? no_cell : index[neighbour]);
        }
    }

    // A point of the boundary that is in no cell opposite a facet of the boundary: the facet above would have the
    // points of that cell. no_cell if there is none, which can be of few points in space.
    std::uint32_t point_of(const std::vector<std::size_t> &boundary) const {
        std::unordered_set<std::uint32_t> opposite;
        for (const std::size_t slot : boundary) opposite.insert(result.corners[slot]);
        for (const std::size_t slot : boundary)
            for (unsigned i = 1; i < n; i++) {
                const std::uint32_t point = result.corners[slot / n * n + (slot % n + i) % n];
                if (opposite.count(point) == 0) return point;
            }
        return no_cell;
    }

    bool has_corner(std::size_t facet, std::uint32_t point) const {
        const auto row = result.corners.begin() + static_cast<std::ptrdiff_t>(facet * n);
        return std::find(row, row + n, point) != row + n;
    }

    unsigned corner_of(std::size_t facet, std::uint32_t point) const {
        unsigned i = 0;
        while (result.corners[facet * n + i] != point) i++;
        return i;
    }

    // The facet of the boundary at this slot has the apex: there is nothing above it but what else has the apex.
    bool is_at_apex(std::size_t slot, std::uint32_t apex) const {
        return has_corner(slot / n, apex) && result.corners[slot] != apex;
    }

    // The row of the cell, with the apex in place of the corner that is not on the boundary.
    void add_above(std::size_t slot, std::uint32_t apex) {
        if (is_at_apex(slot, apex)) return;
        const std::size_t cell = slot / n, facet = result.count();
        for (unsigned i = 0; i < n; i++) {
            const std::uint32_t corner = result.corners[cell * n + i];
            result.corners.push_back(i == slot % n ? apex : corner);
            result.neighbours.push_back(i == slot % n ? static_cast<std::uint32_t>(cell) : no_cell);
        }
        result.neighbours[slot] = static_cast<std::uint32_t>(facet);
    }

    bool is_boundary(std::size_t slot) const {
        return result.neighbours[slot] == no_cell || result.neighbours[slot] >= result.n_lower;
    }

    // The slot of the other facet of the boundary that has all points of this one but corner j of the cell: the next
    // one around these points, through cells.
    std::size_t around(std::size_t slot, unsigned j) const {
        std::size_t cell = slot / n;
        unsigned inner = slot % n;
        while (!is_boundary(cell * n + j)) {
            const std::size_t next = result.neighbours[cell * n + j];
            const std::uint32_t pivot = result.corners[cell * n + inner];
            inner = 0;
            while (has_corner(cell, result.corners[next * n + inner])) inner++;
            j = corner_of(next, pivot);
            cell = next;
        }
        return cell * n + j;
    }

    // Neighbours of the facet above a facet of the boundary; if that has the apex, the facet above is that beyond the
    // points opposite the apex, whose neighbour this cell becomes.
    bool join(std::size_t slot, std::uint32_t apex) {
        const std::size_t cell = slot / n;
        if (is_at_apex(slot, apex)) return true;
        const std::size_t above = result.neighbours[slot];
        for (unsigned j = 0; j < n; j++) {
            if (j == slot % n) continue;
            const std::size_t other = around(cell * n + slot % n, j);
            if (!is_at_apex(other, apex)) {
                result.neighbours[above * n + j] = result.neighbours[other];
                continue;
            }
            if (result.neighbours[other] != no_cell) return false;
            result.neighbours[above * n + j] = static_cast<std::uint32_t>(other / n);
            result.neighbours[other] = static_cast<std::uint32_t>(above);
        }
        return true;
    }

    const unsigned n;
    const Cells &cells_;
};

// Whether a point that is in cells is in no facet.
bool has_lost_points(const Cells &cells, const QhullFacets &facets, std::size_t n_points) {
    std::vector<bool> is_there(n_points);
    for (std::size_t slot = 0; slot < facets.n_lower * facets.n_corners; slot++) is_there[facets.corners[slot]] = true;
    const std::uint32_t *end = cells.vertices + cells.count * cells.n_corners;
    return std::any_of(cells.vertices, end, [&](std::uint32_t point) { return !is_there[point]; });
}

} // namespace

QhullFacets closed_facets(const Cells &cells, const std::vector<bool> &is_flat, std::size_t n_points,
                          std::uint32_t apex) {
    Closing closing(cells, is_flat);
    const bool is_of_all = is_flat.empty() || !has_lost_points(cells, closing.result, n_points);
    if (!is_of_all || !closing.close(apex)) return {};
    return std::move(closing.result);
}

} // namespace compat
