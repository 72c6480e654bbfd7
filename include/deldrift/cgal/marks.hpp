// Marks of cells in a refined triangulation: see cgal.hpp.
#ifndef DELDRIFT_CGAL_MARKS_HPP
#define DELDRIFT_CGAL_MARKS_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "../../deldrift.hpp"

namespace deldrift::cgal::detail {

// The pieces that refinement has made of segments, and where each is by its original one and the vertex that it begins at.
struct Pieces {
    Segments rows{};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> from{};
};
inline Pieces pieces_of(const Triangulation &refined) {
    Pieces pieces{refined.segments()};
    const std::vector<std::uint32_t> originals = refined.original_segments();
    for (std::size_t k = 0; k < pieces.rows.size(); k++) {
        pieces.from.emplace(std::make_pair(originals[k], pieces.rows.ends[k][0]), k);
    }
    return pieces;
}
// Calls `use` with each piece of a segment between these ends, which is one of an original one itself.
template <class Use>
void visit_pieces(const Pieces &pieces, std::uint32_t original, const Ends &ends, Use use) {
    for (std::uint32_t v = ends[0]; v != ends[1];) {
        const std::size_t piece = pieces.from.at({original, v});
        use(piece);
        v = pieces.rows.ends[piece][1];
    }
}

// For each cell of a refined triangulation the mark, 0 or 1, of the region that it is in, from the marks of the cells
// before. Regions are known by the segments around them: cells beside a piece are in those that were beside its segment.
// What no segment with a cell on that side bounds is outside, and has the mark 0.
inline std::vector<std::uint8_t> marks_after(const Triangulation &t, const std::vector<std::uint8_t> &marks,
                                             const Triangulation &refined) {
    const Pieces pieces = pieces_of(refined);
    const Segments segments = t.segments();
    const std::vector<std::uint32_t> originals = t.original_segments();
    const std::vector<Ends> beside = t.cells_of_segments(), beside_pieces = refined.cells_of_segments();
    const std::size_t n = refined.cell_count();
    std::vector<std::int32_t> labels(n);
    std::vector<std::uint8_t> is_known(n);
    for (std::size_t k = 0; k < segments.size(); k++) {
        visit_pieces(pieces, originals[k], segments.ends[k], [&](std::size_t piece) {
            for (std::size_t side = 0; side < 2; side++) {
                const std::uint32_t before = beside[k][side], after = beside_pieces[piece][side];
                if (after == DELDRIFT_NONE) continue;
                labels[after] = before == DELDRIFT_NONE ? 0 : marks[before];
                is_known[after] = 1;
            }
        });
    }
    std::vector<std::uint32_t> others;
    for (std::uint32_t cell = 0; cell < n; cell++) {
        if (is_known[cell] == 0) others.push_back(cell);
    }
    refined.update_labels(others, 0, labels);
    return {labels.begin(), labels.end()};
}

}  // namespace deldrift::cgal::detail

#endif  // DELDRIFT_CGAL_MARKS_HPP
