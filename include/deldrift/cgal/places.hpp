// Where a point is, and which cells it is in conflict with: see cgal.hpp.
#ifndef DELDRIFT_CGAL_PLACES_HPP
#define DELDRIFT_CGAL_PLACES_HPP

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "handles.hpp"

namespace deldrift::cgal::detail {

template <class Mesh, std::uint32_t D>
typename Mesh::Numbers numbers_of(Cell_handle<Mesh, D> c, std::uint32_t corner) {
    return Mesh::numbers_of(c.vertex(static_cast<int>(corner)).point());
}

// The orientation of a finite cell with a point in the place of a corner.
template <class Mesh, std::uint32_t D>
int side_of_facet(Cell_handle<Mesh, D> c, std::uint32_t corner, const typename Mesh::Numbers &p) {
    std::array<double, (D + 1) * D> points;
    for (std::uint32_t i = 0; i <= D; i++) {
        const auto x = i == corner ? p : numbers_of(c, i);
        std::copy(x.begin(), x.end(), points.begin() + i * D);
    }
    return orientation(D, points);
}

// Whether a point is in the circle or sphere of a cell, 1, or outside of it, -1, or on it, 0; with weights, whether the
// cell is in conflict with it by their power distances. That of a ghost cell is the half-space beyond its facet, and of
// the plane of that what is in the circle.
template <class Mesh, std::uint32_t D>
int side_of_sphere(Cell_handle<Mesh, D> c, const Mesh *mesh, const typename Mesh::Point &p) {
    if (c.is_infinite()) {
        const Cell_handle<Mesh, D> behind(mesh, c.id());
        const auto corner = static_cast<std::uint32_t>(behind.index(c));
        const int side = side_of_facet(behind, corner, Mesh::numbers_of(p));
        return side != 0 ? -side : side_of_sphere(behind, mesh, p);
    }
    std::array<double, (D + 2) * D> points;
    std::array<double, D + 2> weights;
    const auto give = [&](std::uint32_t i, const typename Mesh::Point &q) {
        const auto x = Mesh::numbers_of(q);
        std::copy(x.begin(), x.end(), points.begin() + i * D);
        weights[i] = Mesh::weight_of(q);
    };
    for (std::uint32_t i = 0; i <= D; i++) give(i, c.vertex(static_cast<int>(i)).point());
    give(D + 1, p);
    if constexpr (Mesh::is_weighted) return in_power_sphere(D, points, weights);
    return in_sphere(D, points);
}

// Where a point is: at a vertex; in a finite cell, on those facets that are marked; in a ghost cell; or there are no
// cells.
template <class Mesh, std::uint32_t D>
struct Place {
    deldrift_location_kind kind;
    Vertex_handle<Mesh, D> vertex;
    Cell_handle<Mesh, D> cell;
    std::array<bool, D + 1> on_facet;
};

template <class Mesh, std::uint32_t D>
Place<Mesh, D> place_of(const Mesh *mesh, const typename Mesh::Point &p, Cell_handle<Mesh, D> hint) {
    using Cell = Cell_handle<Mesh, D>;
    const typename Mesh::Numbers x = Mesh::numbers_of(p);
    const deldrift_location start{DELDRIFT_LOCATION_CELL, hint.id()};
    const bool is_hint = hint != nullptr;
    const deldrift_location found = mesh->triangulation().locate_points(x, is_hint ? &start : nullptr)[0];
    Place<Mesh, D> place{found.kind, nullptr, nullptr, {}};
    switch (found.kind) {
    case DELDRIFT_LOCATION_VERTEX:
        place.vertex = Vertex_handle<Mesh, D>(mesh->by_id()[found.index]);
        place.cell = place.vertex.cell();
        break;
    case DELDRIFT_LOCATION_CELL:
        place.cell = Cell(mesh, found.index);
        for (std::uint32_t i = 0; i <= D; i++) place.on_facet[i] = side_of_facet(place.cell, i, x) == 0;
        break;
    case DELDRIFT_LOCATION_OUTSIDE:
        for (std::uint32_t i = 0; i <= D; i++) {
            const Cell finite(mesh, found.index), ghost = finite.neighbor(static_cast<int>(i));
            if (ghost.is_infinite() && side_of_facet(finite, i, x) < 0) place.cell = ghost;
        }
        break;
    case DELDRIFT_LOCATION_NO_CELLS: break;
    }
    return place;
}

// The cells that go when a vertex is inserted, ghost cells included, and which facets they have in common with others.
template <class Mesh, std::uint32_t D>
class Zone {
public:
    using Cell = Cell_handle<Mesh, D>;
    using Facet = std::pair<Cell, int>;

    // Empty where there are no cells, and at the place of a vertex; with weights, of one that is not lighter.
    Zone(const Mesh *mesh, const typename Mesh::Point &p, Cell hint) : mesh_(mesh), p_(Mesh::numbers_of(p)) {
        const Place<Mesh, D> place = place_of(mesh, p, hint);
        if (place.kind == DELDRIFT_LOCATION_NO_CELLS) return;
        if constexpr (Mesh::is_weighted) {
            add_all(place.cell, p);
        } else if (place.kind != DELDRIFT_LOCATION_VERTEX) {
            add_finite(place);
            add_ghosts(place);
        }
    }
    Zone(const Zone &) = delete;
    Zone &operator=(const Zone &) = delete;
    const std::vector<Cell> &cells() const & noexcept { return cells_; }
    const std::vector<Cell> &cells() const && = delete;
    bool has(Cell c) const { return std::binary_search(cells_.begin(), cells_.end(), c); }
    // Of cells in the zone: those between it and others, and those between two of its cells, each one once.
    std::vector<Facet> boundary() const {
        return facets([this](Cell, Cell other) { return !has(other); });
    }
    std::vector<Facet> inner_facets() const {
        return facets([this](Cell c, Cell other) { return c < other && has(other); });
    }
    // The vertices that only these cells have: with weights, those that a vertex here would hide.
    std::vector<Vertex_handle<Mesh, D>> inner_vertices() const {
        std::set<Vertex_handle<Mesh, D>> vertices;
        for (Cell c : cells_) {
            for (int i = 0; i <= static_cast<int>(D); i++) vertices.insert(c.vertex(i));
        }
        vertices.erase(Vertex_handle<Mesh, D>(mesh_->infinite()));
        for (const auto &[c, i] : boundary()) {
            for (int k = 0; k <= static_cast<int>(D); k++) {
                if (k != i) vertices.erase(c.vertex(k));
            }
        }
        return {vertices.begin(), vertices.end()};
    }

private:
    // With a weight: from the cell that holds the point, from cell to cell.
    void add_all(Cell first, const typename Mesh::Point &p) {
        std::set<Cell> found;
        std::vector<Cell> to_see;
        const auto visit = [&](Cell c) {
            if (found.count(c) == 0 && side_of_sphere(c, mesh_, p) > 0) {
                found.insert(c);
                to_see.push_back(c);
            }
        };
        visit(first);
        while (!to_see.empty()) {
            const Cell c = to_see.back();
            to_see.pop_back();
            for (int i = 0; i <= static_cast<int>(D); i++) visit(c.neighbor(i));
        }
        cells_.assign(found.begin(), found.end());
    }
    void add_finite(const Place<Mesh, D> &place) {
        const deldrift_location hint{DELDRIFT_LOCATION_CELL, place.cell.id()};
        for (std::uint32_t cell : mesh_->triangulation().conflicts(p_, &hint)) cells_.emplace_back(mesh_, cell);
        std::sort(cells_.begin(), cells_.end());
    }
    // A ghost cell goes if its facet is seen from the point; a facet whose plane the point is on, if the cell behind it
    // goes. From those that are next to a cell that goes, or that hold the point, over the hull.
    void add_ghosts(const Place<Mesh, D> &place) {
        std::set<Cell> ghosts;
        std::vector<Cell> to_see;
        const auto visit = [&](Cell ghost) {
            if (ghosts.count(ghost) == 0 && goes(ghost)) {
                ghosts.insert(ghost);
                to_see.push_back(ghost);
            }
        };
        if (place.cell.is_infinite()) visit(place.cell);
        for (Cell c : cells_) {
            for (int i = 0; i <= static_cast<int>(D); i++) {
                const Cell other = c.neighbor(i);
                if (other.is_infinite()) visit(other);
            }
        }
        while (!to_see.empty()) {
            const Cell ghost = to_see.back();
            to_see.pop_back();
            for (int i = 0; i <= static_cast<int>(D); i++) {
                const Cell other = ghost.neighbor(i);
                if (other.is_infinite()) visit(other);
            }
        }
        cells_.insert(cells_.end(), ghosts.begin(), ghosts.end());
        std::sort(cells_.begin(), cells_.end());
    }
    // Cells are finite ones only while this is asked.
    bool goes(Cell ghost) const {
        const Cell behind(mesh_, ghost.id());
        const int side = side_of_facet(behind, static_cast<std::uint32_t>(behind.index(ghost)), p_);
        return side < 0 || (side == 0 && has(behind));
    }
    template <class Wanted>
    std::vector<Facet> facets(Wanted wanted) const {
        std::vector<Facet> found;
        for (Cell c : cells_) {
            for (int i = 0; i <= static_cast<int>(D); i++) {
                if (wanted(c, c.neighbor(i))) found.emplace_back(c, i);
            }
        }
        return found;
    }

    const Mesh *mesh_;
    typename Mesh::Numbers p_;
    // In ascending order.
    std::vector<Cell> cells_{};
};

}  // namespace deldrift::cgal::detail

#endif  // DELDRIFT_CGAL_PLACES_HPP
