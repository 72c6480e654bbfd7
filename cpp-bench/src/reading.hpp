// SPDX-License-Identifier: GPL-3.0-or-later
// What a program has in hand after a step: the cells in two arrays, and what has changed in them where the engine
// tells. And what must be true of it.
#pragma once


#include <deldrift.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bench {

/// Valid until the next call of the engine that gave it.
struct Reading {
    std::size_t n_cells = 0;
    const std::uint32_t *vertices = nullptr;    // dimension + 1 ids of each cell
    const std::uint32_t *neighbours = nullptr;  // as many cells, opposite each corner; DELDRIFT_NONE on the hull
    const deldrift_changes *changes = nullptr;  // since the reading before; nullptr: the engine does not tell
};

/// Every neighbour must have the facet and name the cell in return, and every facet on the hull must be there once.
/// Throws std::runtime_error with the first violation.
void require_consistent(unsigned dimension, const Reading &reading);

/// Data that a program keeps for every cell, and carries along by the changes alone: the sum of the ids of its corners.
class CarriedData {
public:
    /// Anew, for the cells of a reading whatever it says of changes.
    void begin(unsigned dimension, const Reading &reading);

    /// Goes on by what the next reading says has changed. Throws std::runtime_error unless the data are then those of
    /// its cells, every cell is created, renumbered or left alone and no more than one of these, and the vertices
    /// named are those concerned.
    void follow(const Reading &reading);

private:
    void leave(const deldrift_changes &changes);
    void arrive(const deldrift_changes &changes, const Reading &reading);
    void compare_data(const Reading &reading) const;
    void compare_vertices(const deldrift_changes &changes, const Reading &reading);
    std::vector<char> corners_of(const std::uint32_t *rows, std::size_t n_rows) const;
    std::uint64_t sum_of(const std::uint32_t *row) const;

    unsigned n_corners_ = 0;
    std::vector<std::uint64_t> data_;
    std::vector<char> has_data_;    // by cell: gone cells, and those not yet there, have none
    std::vector<char> is_corner_;   // by vertex, of any cell
};

}  // namespace bench
