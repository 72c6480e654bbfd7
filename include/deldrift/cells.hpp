// Cells, their facets and stars: see deldrift.hpp, which includes this.
#ifndef DELDRIFT_CELLS_HPP
#define DELDRIFT_CELLS_HPP

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "iterators.hpp"

namespace deldrift {

using Row = span<const std::uint32_t>;

// The ids of the vertices of a facet: two in the plane, three in space.
class FacetVertices {
public:
    FacetVertices(const std::array<std::uint32_t, 3> &ids, std::size_t size) noexcept : ids_(ids), size_(size) {}
    const std::uint32_t *data() const noexcept { return ids_.data(); }
    std::size_t size() const noexcept { return size_; }
    std::uint32_t operator[](std::size_t i) const noexcept { return ids_[i]; }
    const std::uint32_t *begin() const noexcept { return ids_.data(); }
    const std::uint32_t *end() const noexcept { return ids_.data() + size_; }

private:
    std::array<std::uint32_t, 3> ids_;
    std::size_t size_;
};

// A facet, as that of a cell opposite a corner.
class Facet {
public:
    Facet(Row row, std::uint32_t of_cell, std::uint32_t at_corner, std::uint32_t other) noexcept
        : cell(of_cell), corner(at_corner), neighbour(other), row_(row) {}
    bool is_on_hull() const noexcept { return neighbour == DELDRIFT_NONE; }
    // Seen from the other side of the facet they are in counter-clockwise order; in the plane the cell is to their
    // left.
    FacetVertices vertices() const noexcept {
        if (row_.size() == 3) return {{row_[(corner + 1) % 3], row_[(corner + 2) % 3], 0}, 2};
        static constexpr std::uint8_t order[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
        const std::uint8_t *k = order[corner];
        return {{row_[k[0]], row_[k[1]], row_[k[2]]}, 3};
    }

    std::uint32_t cell, corner;
    // The cell on the other side, DELDRIFT_NONE on the hull.
    std::uint32_t neighbour;

private:
    Row row_;
};

// The cells, without a copy, until the triangulation changes; see deldrift_cells_view.
class Cells {
public:
    using Row = deldrift::Row;

    // What iterators get their values from.
    struct Rows {
        const std::uint32_t *rows = nullptr;
        std::size_t corners = 0;
        Row operator()(std::size_t cell) const noexcept { return {rows + cell * corners, corners}; }
    };
    template <std::size_t N>
    struct Arrays {
        const std::uint32_t *rows = nullptr;
        std::array<std::uint32_t, N> operator()(std::size_t cell) const noexcept {
            std::array<std::uint32_t, N> row;
            std::copy_n(rows + cell * N, N, row.begin());
            return row;
        }
    };
    // Facet k is that opposite corner k % corners of cell k / corners. All facets: each one once, from the cell of the
    // lower index.
    template <bool all>
    struct Facets {
        deldrift_cells_view view{};
        Facet operator()(std::size_t k) const noexcept {
            const std::size_t cell = k / view.corners_per_cell;
            return {Rows{view.vertices, view.corners_per_cell}(cell), static_cast<std::uint32_t>(cell),
                    static_cast<std::uint32_t>(k % view.corners_per_cell), view.neighbours[k]};
        }
        bool selects(std::size_t k) const noexcept {
            const std::uint32_t other = view.neighbours[k];
            return other == DELDRIFT_NONE || (all && k < std::size_t{other} * view.corners_per_cell);
        }
    };

    using iterator = indexed_iterator<Rows>;
    using const_iterator = iterator;
    using value_type = Row;
    template <bool all>
    using facet_range = range<selecting_iterator<Facets<all>>>;

    explicit Cells(const deldrift_cells_view &view) noexcept : view_(view) {}
    std::size_t size() const noexcept { return view_.count; }
    bool empty() const noexcept { return size() == 0; }
    std::size_t corners_per_cell() const noexcept { return view_.corners_per_cell; }
    // The vertices of one cell, the cells across its facets, and all rows of either.
    Row operator[](std::size_t cell) const noexcept { return Rows{view_.vertices, corners_per_cell()}(cell); }
    Row neighbours_of(std::size_t cell) const noexcept { return Rows{view_.neighbours, corners_per_cell()}(cell); }
    Row vertices() const noexcept { return {view_.vertices, size() * corners_per_cell()}; }
    Row neighbours() const noexcept { return {view_.neighbours, size() * corners_per_cell()}; }

    // Over the vertices of the cells: for (Row cell : t.cells()).
    iterator begin() const noexcept { return {{view_.vertices, corners_per_cell()}, 0}; }
    iterator end() const noexcept { return begin() + static_cast<std::ptrdiff_t>(size()); }
    // The same as arrays: for (auto [a, b, c] : t.cells().rows<3>()).
    template <std::size_t N>
    range<indexed_iterator<Arrays<N>>> rows() const {
        if (N != corners_per_cell()) {
            throw Error(DELDRIFT_WRONG_COUNT, "rows of " + std::to_string(N) + " ids, but cells have " +
                                                  std::to_string(corners_per_cell()) + " corners");
        }
        return {{{view_.vertices}, 0}, {{view_.vertices}, size()}};
    }
    // All facets, each one once, and those of the hull alone.
    facet_range<true> facets() const { return select<true>(); }
    facet_range<false> hull_facets() const { return select<false>(); }
    Facet facet(std::size_t cell, std::size_t corner) const noexcept {
        return Facets<true>{view_}(cell * corners_per_cell() + corner);
    }

private:
    template <bool all>
    facet_range<all> select() const {
        const std::size_t n = size() * corners_per_cell();
        return {{{view_}, 0, n}, {{view_}, n, n}};
    }
    deldrift_cells_view view_;
};

// A cell of a star.
struct StarCell {
    // Its index into the cells, and which of its corners the vertex is.
    std::uint32_t cell, corner;
    Row vertices, neighbours;
};

// The cells of a vertex, in no particular order, until the triangulation changes.
class Star {
public:
    struct Entries {
        const std::uint32_t *indices = nullptr;
        std::uint32_t vertex = 0;
        deldrift_cells_view view{};
        StarCell operator()(std::size_t i) const noexcept {
            const Cells cells(view);
            const Row row = cells[indices[i]];
            const auto corner = std::find(row.begin(), row.end(), vertex) - row.begin();
            return {indices[i], static_cast<std::uint32_t>(corner), row, cells.neighbours_of(indices[i])};
        }
    };
    using iterator = indexed_iterator<Entries>;
    using const_iterator = iterator;
    using value_type = StarCell;

    // vertex: the representative, which is a corner of the cells.
    Star(std::vector<std::uint32_t> indices, std::uint32_t vertex, const deldrift_cells_view &view) noexcept
        : indices_(std::move(indices)), vertex_(vertex), view_(view) {}
    std::size_t size() const noexcept { return indices_.size(); }
    bool empty() const noexcept { return indices_.empty(); }
    StarCell operator[](std::size_t i) const noexcept { return begin()[static_cast<std::ptrdiff_t>(i)]; }
    // Iterators end with the star, which owns the list.
    iterator begin() const noexcept { return {{indices_.data(), vertex_, view_}, 0}; }
    iterator end() const noexcept { return begin() + static_cast<std::ptrdiff_t>(size()); }

private:
    std::vector<std::uint32_t> indices_;
    std::uint32_t vertex_;
    deldrift_cells_view view_;
};

// Cells that stay as they are and valid for as long as this lives, whatever becomes of their triangulation; see
// deldrift_release_cells.
class ReleasedCells {
public:
    ReleasedCells(deldrift_released_cells *owner, const deldrift_cells_view &view) noexcept
        : owner_(owner), view_(view) {}
    // None of what has been moved from.
    Cells cells() const noexcept { return Cells(owner_ ? view_ : deldrift_cells_view{}); }

private:
    struct Free {
        void operator()(deldrift_released_cells *owner) const noexcept { deldrift_free_cells(owner); }
    };
    std::unique_ptr<deldrift_released_cells, Free> owner_;
    deldrift_cells_view view_;
};

}  // namespace deldrift

#ifdef __cpp_lib_ranges
template <>
inline constexpr bool std::ranges::enable_borrowed_range<deldrift::Cells> = true;
template <>
inline constexpr bool std::ranges::enable_view<deldrift::Cells> = true;
#endif

#endif  // DELDRIFT_CELLS_HPP
