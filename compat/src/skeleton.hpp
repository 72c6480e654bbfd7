// The faces and edges of cells in space, and the faces around each edge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cells.hpp"

namespace compat {

// Faces, each once: that of the cell of lower index.
class Faces {
public:
    explicit Faces(const Cells &cells);
    std::size_t count() const { return places_.size(); }
    std::size_t n_hull() const { return n_hull_; }
    std::uint32_t cell(std::size_t face) const { return places_[face] / 4; }
    // The face is opposite this corner of its cell.
    unsigned corner(std::size_t face) const { return places_[face] % 4; }
    // The face opposite a corner of any cell.
    std::uint32_t at(std::uint32_t cell, unsigned corner) const { return indices_[std::size_t{4} * cell + corner]; }

private:
    std::vector<std::uint32_t> places_, indices_;
    std::size_t n_hull_ = 0;
};

// Edges, each once, with the faces that it is on, in their order around it. Around an edge of the hull they begin and
// end with faces of the hull.
class Edges {
public:
    // Rings are left out where they are not wanted.
    Edges(const Cells &cells, const Faces *rings_of);
    std::size_t count() const { return ends_.size() / 2; }
    std::uint32_t start(std::size_t edge) const { return ends_[2 * edge]; }
    std::uint32_t end(std::size_t edge) const { return ends_[2 * edge + 1]; }
    bool is_on_hull(std::size_t edge) const { return on_hull_[edge] != 0; }
    std::size_t ring_size(std::size_t edge) const { return offsets_[edge + 1] - offsets_[edge]; }
    const std::uint32_t *ring(std::size_t edge) const { return faces_.data() + offsets_[edge]; }

private:
    friend class EdgeWalk;
    std::vector<std::uint32_t> ends_, faces_;
    std::vector<std::size_t> offsets_{0};
    std::vector<std::uint8_t> on_hull_;
};

} // namespace compat
