// Segments, what is in their way, and boundaries in chains: see deldrift.hpp, which includes this.
#ifndef DELDRIFT_SEGMENTS_HPP
#define DELDRIFT_SEGMENTS_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "iterators.hpp"

namespace deldrift {

#ifdef __clang__
#pragma clang diagnostic push
// A class of a header alone has no file for its table of virtual functions.
#pragma clang diagnostic ignored "-Wweak-vtables"
#endif
// A change was refused, as something would be in the way of segments, or one would not have two ends: status() is that of
// the first conflict. All of them are told, in the order of deldrift_segment_conflicts:
//     try {
//         t.commit_timestamp();
//     } catch (const deldrift::ConflictError &error) {
//         for (const deldrift_conflict &conflict : error.conflicts()) blame(conflict.segment);
//         t.discard_moves();
//     }
class ConflictError : public Error {
public:
    ConflictError(deldrift_status status, const std::string &message, std::vector<deldrift_conflict> conflicts)
        : Error(status, message),
          conflicts_(std::make_shared<const std::vector<deldrift_conflict>>(std::move(conflicts))) {}
    const std::vector<deldrift_conflict> &conflicts() const noexcept { return *conflicts_; }

    // Whether it is the status of a conflict.
    static bool is_conflict(deldrift_status status) noexcept {
        return status == DELDRIFT_CROSSING || status == DELDRIFT_ON_SEGMENT || status == DELDRIFT_END_REMOVED ||
               status == DELDRIFT_ENDS_MEET;
    }

private:
    // Shared, as copies of an exception must not fail.
    std::shared_ptr<const std::vector<deldrift_conflict>> conflicts_;
};

// A vertex that passes a segment; see deldrift_passings.
struct Passing {
    std::uint32_t segment, vertex;
};

// A change was refused, as a vertex would pass a segment and the options refuse that, or it was asked whether one would.
// All that would are told, ascending by segment and vertex:
//     try {
//         t.commit_timestamp();
//     } catch (const deldrift::PassingError &error) {
//         for (const auto [segment, vertex] : error.passings()) blame(segment, vertex);
//         t.discard_moves();
//     }
class PassingError : public Error {
public:
    PassingError(const std::string &message, std::vector<Passing> passings)
        : Error(DELDRIFT_PASSES_SEGMENT, message),
          passings_(std::make_shared<const std::vector<Passing>>(std::move(passings))) {}
    const std::vector<Passing> &passings() const noexcept { return *passings_; }

private:
    std::shared_ptr<const std::vector<Passing>> passings_;
};
#ifdef __clang__
#pragma clang diagnostic pop
#endif

// Two vertices.
using Ends = std::array<std::uint32_t, 2>;

struct Segment {
    std::uint32_t id;
    Ends ends;
    std::int32_t marker;
};

// The segments in force, ascending by id; see deldrift_segments.
//     for (const auto [id, ends, marker] : t.segments()) draw(ends[0], ends[1], marker);
struct Segments {
    std::vector<std::uint32_t> ids{};
    std::vector<Ends> ends{};
    std::vector<std::int32_t> markers{};

    struct Rows {
        const Segments *of = nullptr;
        Segment operator()(std::size_t k) const noexcept { return (*of)[k]; }
    };
    std::size_t size() const noexcept { return ids.size(); }
    bool empty() const noexcept { return ids.empty(); }
    Segment operator[](std::size_t k) const noexcept { return {ids[k], ends[k], markers[k]}; }
    // They end with the object.
    indexed_iterator<Rows> begin() const noexcept { return {{this}, 0}; }
    indexed_iterator<Rows> end() const noexcept { return {{this}, size()}; }
};

// The labels of the regions of cells; see deldrift_regions.
struct Regions {
    // In the order of cells().
    std::vector<std::int32_t> labels{};
    // How many cells are in regions whose sides have no label, or several.
    std::size_t undecided = 0;
};

// An edge of the boundary of some cells: it goes from vertex to next, and the cell is on its left.
struct ChainEdge {
    std::uint32_t vertex, next;
    // At it, DELDRIFT_NONE if there is none.
    std::uint32_t segment;
    std::uint32_t cell;
    // Which corner of the cell is opposite.
    std::uint8_t corner;
};

// The boundary of some cells in closed chains; see deldrift_boundary_chains. A range of chains, which are ranges of edges:
//     for (const auto chain : t.boundary_chains(mask))
//         for (const deldrift::ChainEdge edge : chain) draw(edge.vertex, edge.next);
struct Chains {
    // For each edge; the edges of chain k are those from offsets[k] to offsets[k + 1].
    std::vector<std::uint32_t> vertices{}, segments{}, cells{};
    std::vector<std::uint8_t> corners{};
    std::vector<std::size_t> offsets{0};

    // The edges of one chain, from which the last one leads back to the first.
    struct Edges {
        const Chains *of = nullptr;
        std::size_t chain = 0;
        ChainEdge operator()(std::size_t k) const noexcept {
            const std::size_t from = of->offsets[chain], end = of->offsets[chain + 1], at = from + k;
            return {of->vertices[at], of->vertices[at + 1 < end ? at + 1 : from], of->segments[at], of->cells[at],
                    of->corners[at]};
        }
    };
    using Chain = range<indexed_iterator<Edges>>;
    struct All {
        const Chains *of = nullptr;
        Chain operator()(std::size_t k) const { return (*of)[k]; }
    };
    std::size_t size() const noexcept { return offsets.size() - 1; }
    bool empty() const noexcept { return size() == 0; }
    // Chains end with the object.
    Chain operator[](std::size_t k) const {
        return {{{this, k}, 0}, {{this, k}, offsets[k + 1] - offsets[k]}};
    }
    indexed_iterator<All> begin() const noexcept { return {{this}, 0}; }
    indexed_iterator<All> end() const noexcept { return {{this}, size()}; }
};

}  // namespace deldrift

#endif  // DELDRIFT_SEGMENTS_HPP
