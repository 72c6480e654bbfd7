// SPDX-License-Identifier: GPL-3.0-or-later
// STAND-IN, TO BE DELETED, with the one #include of it in reading.hpp, as soon as deldrift.h declares
// deldrift_take_changes: until then this says the same by comparing all cells with those of the time before, slowly.
#pragma once

#include <deldrift.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

struct deldrift_changes {
    std::size_t created_count;
    const std::uint32_t *created;
    std::size_t removed_count;
    const std::uint32_t *removed;
    const std::uint32_t *removed_vertices;
    std::size_t renumbered_count;
    const std::uint32_t *renumbered_from;
    const std::uint32_t *renumbered_to;
    std::size_t star_count;
    const std::uint32_t *stars;
    std::size_t hidden_count;
    const std::uint32_t *hidden;
    std::size_t shown_count;
    const std::uint32_t *shown;
};

namespace bench::pending {

struct Taken {
    std::vector<std::uint32_t> rows, created, removed, removed_vertices, from, to, stars, hidden, shown;
    std::vector<char> is_corner;
};

inline std::map<const deldrift_triangulation *, Taken> &all_taken() {
    static std::map<const deldrift_triangulation *, Taken> taken;
    return taken;
}

inline void compare(Taken &taken, const std::uint32_t *rows, std::size_t count, std::size_t n_corners) {
    const std::size_t n_before = taken.rows.size() / n_corners;
    const auto key = [&](const std::uint32_t *row) {
        std::array<std::uint32_t, 4> sorted{UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX};
        std::copy(row, row + n_corners, sorted.begin());
        std::sort(sorted.begin(), sorted.end());
        return sorted;
    };
    std::vector<std::pair<std::array<std::uint32_t, 4>, std::uint32_t>> before;
    const auto stayed = [&](std::size_t cell) {
        const std::uint32_t *now = rows + cell * n_corners, *then = taken.rows.data() + cell * n_corners;
        return cell < std::min(count, n_before) && (std::equal(now, now + n_corners, then) || key(now) == key(then));
    };
    for (std::size_t cell = 0; cell < n_before; ++cell)
        if (!stayed(cell))
            before.push_back({key(&taken.rows[cell * n_corners]), static_cast<std::uint32_t>(cell)});
    std::sort(before.begin(), before.end());
    std::vector<char> is_found(before.size(), 0), changed(taken.is_corner.size(), 0);
    for (std::size_t cell = 0; cell < count; ++cell) {
        if (stayed(cell)) continue;
        const auto wanted = key(rows + cell * n_corners);
        const auto at = std::lower_bound(before.begin(), before.end(), std::make_pair(wanted, std::uint32_t{0}));
        if (at != before.end() && at->first == wanted) {
            is_found[static_cast<std::size_t>(at - before.begin())] = 1;
            taken.from.push_back(at->second);
            taken.to.push_back(static_cast<std::uint32_t>(cell));
        } else {
            taken.created.push_back(static_cast<std::uint32_t>(cell));
            for (std::size_t i = 0; i < n_corners; ++i) changed[wanted[i]] = 1;
        }
    }
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (is_found[i]) continue;
        taken.removed.push_back(before[i].second);
        for (std::size_t c = 0; c < n_corners; ++c) {
            taken.removed_vertices.push_back(taken.rows[before[i].second * n_corners + c]);
            changed[before[i].first[c]] = 1;
        }
    }
    for (std::uint32_t id = 0; id < changed.size(); ++id)
        if (changed[id]) taken.stars.push_back(id);
}

inline void destroy(deldrift_triangulation *t) {
    all_taken().erase(t);
    deldrift_destroy(t);
}

}  // namespace bench::pending

inline deldrift_status deldrift_take_changes(deldrift_triangulation *t, deldrift_changes *changes) {
    deldrift_cells_view view;
    std::size_t n_ids = 0;
    if (const deldrift_status status = deldrift_cells(t, &view)) return status;
    if (const deldrift_status status = deldrift_id_count(t, &n_ids)) return status;
    bench::pending::Taken &taken = bench::pending::all_taken()[t];
    for (auto *list : {&taken.created, &taken.removed, &taken.removed_vertices, &taken.from, &taken.to, &taken.stars,
                       &taken.hidden, &taken.shown})
        list->clear();
    taken.is_corner.resize(n_ids, 0);
    const std::vector<char> before = taken.is_corner;
    bench::pending::compare(taken, view.vertices, view.count, view.corners_per_cell);
    taken.rows.assign(view.vertices, view.vertices + view.count * view.corners_per_cell);
    std::fill(taken.is_corner.begin(), taken.is_corner.end(), 0);
    for (const std::uint32_t id : taken.rows) taken.is_corner[id] = 1;
    for (std::uint32_t id = 0; id < n_ids; ++id)
        if (before[id] != taken.is_corner[id]) (before[id] ? taken.hidden : taken.shown).push_back(id);
    *changes = {taken.created.size(), taken.created.data(), taken.removed.size(),
                taken.removed.data(), taken.removed_vertices.data(), taken.from.size(),
                taken.from.data(),    taken.to.data(), taken.stars.size(),
                taken.stars.data(),   taken.hidden.size(), taken.hidden.data(),
                taken.shown.size(),   taken.shown.data()};
    return DELDRIFT_OK;
}

/// What has been taken goes with the triangulation: another may be at the same address.
#define deldrift_destroy(t) bench::pending::destroy(t)
