// The hidden vertices of a regular triangulation: see cgal.hpp.
#ifndef DELDRIFT_CGAL_HIDDEN_HPP
#define DELDRIFT_CGAL_HIDDEN_HPP

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "../../deldrift.hpp"

namespace deldrift::cgal::detail {

struct Hidden_ids {
    // By id; for those that are hidden the cell that each is above, DELDRIFT_NONE where there are no cells.
    std::vector<std::uint8_t> are_hidden{};
    std::vector<std::uint32_t> cells{};
    // All of them, by cell and then by id.
    std::vector<std::uint32_t> in_order{};

    // Those above a cell: from the first of these indices into in_order to before the second.
    std::pair<std::size_t, std::size_t> above(std::uint32_t cell) const {
        const auto is_before = [this](std::uint32_t id, std::uint32_t than) { return cells[id] < than; };
        const auto first = std::lower_bound(in_order.begin(), in_order.end(), cell, is_before);
        auto last = first;
        while (last != in_order.end() && cells[*last] == cell) ++last;
        return {static_cast<std::size_t>(first - in_order.begin()), static_cast<std::size_t>(last - in_order.begin())};
    }
};

// A vertex that is hidden by place is above the cell that the one which represents the place is above, or where that
// is not hidden, above the lowest of its cells.
inline Hidden_ids hidden_ids_of(const Triangulation &t) {
    Hidden_ids hidden;
    const HiddenByWeight by_weight = t.hidden_by_weight();
    const Hidden by_place = t.hidden_vertices();
    hidden.are_hidden.resize(t.id_count());
    hidden.cells.resize(t.id_count(), DELDRIFT_NONE);
    const auto hide = [&](std::uint32_t id, std::uint32_t cell) {
        hidden.are_hidden[id] = 1;
        hidden.cells[id] = cell;
        hidden.in_order.push_back(id);
    };
    for (std::size_t k = 0; k < by_weight.size(); k++) hide(by_weight.vertices[k], by_weight.cells[k]);
    for (std::size_t k = 0; k < by_place.size(); k++) {
        const std::uint32_t shown = by_place.representatives[k];
        std::uint32_t cell = hidden.cells[shown];
        if (hidden.are_hidden[shown] == 0) {
            const std::vector<std::uint32_t> star = t.star(shown);
            if (!star.empty()) cell = *std::min_element(star.begin(), star.end());
        }
        hide(by_place.vertices[k], cell);
    }
    std::sort(hidden.in_order.begin(), hidden.in_order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::make_pair(hidden.cells[a], a) < std::make_pair(hidden.cells[b], b);
    });
    return hidden;
}

}  // namespace deldrift::cgal::detail

#endif  // DELDRIFT_CGAL_HIDDEN_HPP
