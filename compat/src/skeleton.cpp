#include "skeleton.hpp"

namespace compat {

// Where a value is in a row that has it. Without branches, which could not be predicted.
static unsigned index_in(const std::uint32_t *row, std::uint32_t value) {
    return (row[1] == value ? 1u : 0u) + (row[2] == value ? 2u : 0u) + (row[3] == value ? 3u : 0u);
}

Faces::Faces(const Cells &cells) : indices_(4 * cells.count) {
    places_.reserve(2 * cells.count + cells.count / 8);
    for (std::size_t c = 0; c < cells.count; c++) {
        for (unsigned corner = 0; corner < 4; corner++) {
            const std::size_t place = 4 * c + corner;
            const std::uint32_t neighbour = cells.neighbours[place];
            n_hull_ += neighbour == no_cell;
            if (neighbour < c) continue;
            indices_[place] = static_cast<std::uint32_t>(places_.size());
            places_.push_back(static_cast<std::uint32_t>(place));
            if (neighbour == no_cell) continue;
            const std::size_t other = std::size_t{4} * neighbour;
            indices_[other + index_in(cells.neighbours + other, static_cast<std::uint32_t>(c))] = indices_[place];
        }
    }
}

// Goes around edges from cell to cell.
class EdgeWalk {
public:
    EdgeWalk(const Cells &cells, const Faces *faces, Edges &edges)
        : cells_(cells), faces_(faces), edges_(edges), is_done_(6 * cells.count) {}

    // The edge between two corners of a cell, unless it was visited in another of its cells.
    void visit(std::uint32_t cell, unsigned i, unsigned j) {
        const unsigned pair = pairs[i][j];
        if (is_done_[std::size_t{6} * cell + pair] != 0) return;
        start_ = row(cell)[i];
        end_ = row(cell)[j];
        const std::size_t n_before = edges_.faces_.size();
        Step step{cell, other_corners[pair][0], other_corners[pair][1], pair};
        bool goes_on = true;
        do {
            pass(step);
            goes_on = leave(step);
        } while (goes_on && step.cell != cell);
        // On the hull the way goes back from the face that ended it, over all cells.
        if (!goes_on) {
            edges_.faces_.resize(n_before);
            step = {step.cell, step.stays, step.leaves, step.pair};
            add_face(step.cell, step.stays);
            do pass(step);
            while (leave(step));
        }
        edges_.ends_.push_back(start_);
        edges_.ends_.push_back(end_);
        edges_.on_hull_.push_back(goes_on ? 0 : 1);
        edges_.offsets_.push_back(edges_.faces_.size());
    }

private:
    // A cell with the edge, and its two corners that are not on it: the way out is opposite one of them.
    struct Step {
        std::uint32_t cell;
        unsigned leaves, stays, pair;
    };

    // Pairs of corners have numbers.
    static constexpr std::uint8_t pairs[4][4] = {{6, 0, 1, 2}, {0, 6, 3, 4}, {1, 3, 6, 5}, {2, 4, 5, 6}};
    static constexpr std::uint8_t other_corners[6][2] = {{2, 3}, {1, 3}, {1, 2}, {0, 3}, {0, 2}, {0, 1}};

    const std::uint32_t *row(std::uint32_t cell) const { return cells_.vertices + std::size_t{4} * cell; }

    void pass(const Step &step) {
        is_done_[std::size_t{6} * step.cell + step.pair] = 1;
        add_face(step.cell, step.leaves);
    }

    void add_face(std::uint32_t cell, unsigned corner) {
        if (faces_ != nullptr) edges_.faces_.push_back(faces_->at(cell, corner));
    }

    // Goes to the next cell around the edge, whose way out is opposite the vertex that stays; false, and stays, on the
    // hull.
    bool leave(Step &step) const {
        const std::uint32_t next = cells_.neighbours[std::size_t{4} * step.cell + step.leaves];
        if (next == no_cell) return false;
        const std::uint32_t *corners = row(next);
        const unsigned leaves = index_in(corners, row(step.cell)[step.stays]);
        const unsigned i = index_in(corners, start_), j = index_in(corners, end_);
        step = {next, leaves, 0 + 1 + 2 + 3 - leaves - i - j, pairs[i][j]};
        return true;
    }

    const Cells &cells_;
    const Faces *faces_;
    Edges &edges_;
    std::vector<std::uint8_t> is_done_;
    std::uint32_t start_ = 0, end_ = 0;
};

Edges::Edges(const Cells &cells, const Faces *rings_of) {
    // About seven edges for six cells; a face is on three.
    const std::size_t about = cells.count + cells.count / 4;
    ends_.reserve(2 * about);
    on_hull_.reserve(about);
    offsets_.reserve(about + 1);
    if (rings_of != nullptr) faces_.reserve(3 * rings_of->count());
    EdgeWalk walk(cells, rings_of, *this);
    for (std::size_t c = 0; c < cells.count; c++)
        for (unsigned i = 0; i < 4; i++)
            for (unsigned j = i + 1; j < 4; j++) walk.visit(static_cast<std::uint32_t>(c), i, j);
}

} // namespace compat
