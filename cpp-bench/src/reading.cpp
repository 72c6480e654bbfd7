// SPDX-License-Identifier: GPL-3.0-or-later
#include "reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace bench {
namespace {

[[noreturn]] void complain(const std::string &what, std::size_t index) {
    throw std::runtime_error(fmt::format("{} {}", what, index));
}

/// The corners of a cell without one of them, in ascending order.
std::vector<std::uint32_t> facet(const std::uint32_t *row, unsigned n_corners, unsigned opposite) {
    std::vector<std::uint32_t> corners;
    for (unsigned corner = 0; corner < n_corners; ++corner)
        if (corner != opposite) corners.push_back(row[corner]);
    std::sort(corners.begin(), corners.end());
    return corners;
}

bool is_in(const std::vector<char> &set, std::uint32_t id) { return id < set.size() && set[id]; }

void put_in(std::vector<char> &set, std::uint32_t id) {
    if (id >= set.size()) set.resize(id + std::size_t{1}, 0);
    set[id] = 1;
}

}  // namespace

void require_consistent(unsigned dimension, const Reading &reading) {
    const unsigned n_corners = dimension + 1;
    std::vector<std::vector<std::uint32_t>> hull;
    for (std::size_t cell = 0; cell < reading.n_cells; ++cell) {
        const std::uint32_t *row = reading.vertices + cell * n_corners;
        for (unsigned corner = 0; corner < n_corners; ++corner) {
            const std::vector<std::uint32_t> here = facet(row, n_corners, corner);
            const std::uint32_t other = reading.neighbours[cell * n_corners + corner];
            if (other == DELDRIFT_NONE) {
                hull.push_back(here);
                continue;
            }
            if (other >= reading.n_cells || other == cell) complain("there is no such neighbour of cell", cell);
            const std::uint32_t *back = reading.neighbours + std::size_t{other} * n_corners;
            const auto entry = std::find(back, back + n_corners, static_cast<std::uint32_t>(cell));
            if (entry == back + n_corners) complain("a neighbour does not know cell", cell);
            const std::uint32_t *there = reading.vertices + std::size_t{other} * n_corners;
            if (facet(there, n_corners, static_cast<unsigned>(entry - back)) != here)
                complain("a neighbour has not the facet of cell", cell);
        }
    }
    std::sort(hull.begin(), hull.end());
    if (std::adjacent_find(hull.begin(), hull.end()) != hull.end())
        throw std::runtime_error("two cells have the same facet and are not neighbours");
}

void CarriedData::begin(unsigned dimension, const Reading &reading) {
    n_corners_ = dimension + 1;
    data_.resize(reading.n_cells);
    for (std::size_t cell = 0; cell < reading.n_cells; ++cell)
        data_[cell] = sum_of(reading.vertices + cell * n_corners_);
    has_data_.assign(reading.n_cells, 1);
    is_corner_ = corners_of(reading.vertices, reading.n_cells);
}

void CarriedData::follow(const Reading &reading) {
    const deldrift_changes &changes = *reading.changes;
    std::vector<std::uint64_t> moving(changes.renumbered_count);
    for (std::size_t i = 0; i < moving.size(); ++i) {
        const std::uint32_t from = changes.renumbered_from[i];
        if (from >= data_.size()) complain("changes: there was no cell", from);
        moving[i] = data_[from];
    }
    leave(changes);
    if (data_.size() > reading.n_cells && std::find(has_data_.begin() + static_cast<std::ptrdiff_t>(reading.n_cells),
                                                    has_data_.end(), 1) != has_data_.end())
        throw std::runtime_error("changes: a cell is beyond the last one and neither removed nor renumbered");
    data_.resize(reading.n_cells);
    has_data_.resize(reading.n_cells, 0);
    arrive(changes, reading);
    for (std::size_t i = 0; i < moving.size(); ++i) data_[changes.renumbered_to[i]] = moving[i];
    compare_data(reading);
    compare_vertices(changes, reading);
}

/// Away with what is removed, or will be elsewhere.
void CarriedData::leave(const deldrift_changes &changes) {
    const auto take = [&](std::uint32_t cell) {
        if (cell >= data_.size() || !has_data_[cell]) complain("changes: there was no, or no longer a, cell", cell);
        has_data_[cell] = 0;
    };
    for (std::size_t i = 0; i < changes.removed_count; ++i) {
        take(changes.removed[i]);
        if (data_[changes.removed[i]] != sum_of(changes.removed_vertices + i * n_corners_))
            complain("changes: other vertices than those of the removed cell", changes.removed[i]);
    }
    for (std::size_t i = 0; i < changes.renumbered_count; ++i) take(changes.renumbered_from[i]);
}

void CarriedData::arrive(const deldrift_changes &changes, const Reading &reading) {
    const auto put = [&](std::uint32_t cell) {
        if (cell >= data_.size() || has_data_[cell]) complain("changes: there is no, or already a, cell", cell);
        has_data_[cell] = 1;
    };
    for (std::size_t i = 0; i < changes.created_count; ++i) {
        put(changes.created[i]);
        data_[changes.created[i]] = sum_of(reading.vertices + std::size_t{changes.created[i]} * n_corners_);
    }
    for (std::size_t i = 0; i < changes.renumbered_count; ++i) put(changes.renumbered_to[i]);
}

void CarriedData::compare_data(const Reading &reading) const {
    for (std::size_t cell = 0; cell < reading.n_cells; ++cell) {
        if (!has_data_[cell]) complain("changes: nothing is said of cell", cell);
        if (data_[cell] != sum_of(reading.vertices + cell * n_corners_))
            complain("changes: the data carried are not those of cell", cell);
    }
}

/// Stars are those of the corners of cells that came or went, and may be those of vertices that are no corner of any;
/// hidden and shown is who ceased to be a corner, or began. Without cells all of this means nothing.
void CarriedData::compare_vertices(const deldrift_changes &changes, const Reading &reading) {
    const std::vector<char> before = std::move(is_corner_);
    is_corner_ = corners_of(reading.vertices, reading.n_cells);
    std::vector<char> concerned = corners_of(changes.removed_vertices, changes.removed_count);
    for (std::size_t i = 0; i < changes.created_count; ++i)
        for (unsigned corner = 0; corner < n_corners_; ++corner)
            put_in(concerned, reading.vertices[std::size_t{changes.created[i]} * n_corners_ + corner]);
    std::vector<char> named;
    for (std::size_t i = 0; i < changes.star_count; ++i) {
        const std::uint32_t id = changes.stars[i];
        if (is_in(named, id)) complain("changes: twice among the stars is vertex", id);
        put_in(named, id);
        if (!is_in(concerned, id) && is_in(is_corner_, id)) complain("changes: nothing happened to the star of", id);
    }
    for (std::uint32_t id = 0; id < concerned.size(); ++id)
        if (concerned[id] && !is_in(named, id)) complain("changes: nothing is said of the star of", id);
    if (before.empty() || is_corner_.empty()) return;
    const auto require_turned = [&](const std::uint32_t *ids, std::size_t count, const std::vector<char> &from,
                                    const std::vector<char> &to) {
        for (std::size_t i = 0; i < count; ++i)
            if (!is_in(from, ids[i]) || is_in(to, ids[i])) complain("changes: neither hidden nor shown is", ids[i]);
        std::size_t n_turned = 0;
        for (std::uint32_t id = 0; id < from.size(); ++id) n_turned += from[id] && !is_in(to, id);
        if (n_turned != count) complain("changes: hidden or shown vertices are missing, there should be", n_turned);
    };
    require_turned(changes.hidden, changes.hidden_count, before, is_corner_);
    require_turned(changes.shown, changes.shown_count, is_corner_, before);
}

std::vector<char> CarriedData::corners_of(const std::uint32_t *rows, std::size_t n_rows) const {
    std::vector<char> corners;
    for (std::size_t i = 0; i < n_rows * n_corners_; ++i) put_in(corners, rows[i]);
    return corners;
}

std::uint64_t CarriedData::sum_of(const std::uint32_t *row) const {
    return std::accumulate(row, row + n_corners_, std::uint64_t{0});
}

}  // namespace bench
