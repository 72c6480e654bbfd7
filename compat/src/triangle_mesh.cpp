#include "triangle_mesh.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace compat {

namespace {

std::uint64_t key_of(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax(a, b);
    return std::uint64_t{low} << 32 | high;
}

// The lower end first, ascending.
void sort_segments(Segments &segments) {
    std::vector<std::pair<std::uint64_t, int>> rows(segments.count());
    for (std::size_t i = 0; i < rows.size(); i++)
        rows[i] = {key_of(segments.ends[2 * i], segments.ends[2 * i + 1]), segments.markers[i]};
    std::sort(rows.begin(), rows.end());
    for (std::size_t i = 0; i < rows.size(); i++) {
        segments.ends[2 * i] = static_cast<std::uint32_t>(rows[i].first >> 32);
        segments.ends[2 * i + 1] = static_cast<std::uint32_t>(rows[i].first);
        segments.markers[i] = rows[i].second;
    }
}

} // namespace

void find_sides(const Cells &cells, Segments &segments) {
    std::unordered_map<std::uint64_t, std::uint32_t> index;
    index.reserve(segments.count());
    for (std::size_t i = 0; i < segments.count(); i++)
        index.emplace(key_of(segments.ends[2 * i], segments.ends[2 * i + 1]), static_cast<std::uint32_t>(i));
    segments.at.assign(3 * cells.count, no_segment);
    for (std::size_t c = 0; c < cells.count; c++) {
        const std::uint32_t *row = cells.vertices + 3 * c;
        for (unsigned corner = 0; corner < 3; corner++) {
            const auto found = index.find(key_of(row[(corner + 1) % 3], row[(corner + 2) % 3]));
            if (found != index.end()) segments.at[3 * c + corner] = found->second;
        }
    }
}

void sort(Mesh &mesh) {
    std::vector<std::uint32_t> order;
    OwnedCells sorted = sorted_cells(mesh.cells, &order);
    mesh.own = std::move(sorted);
    mesh.cells = mesh.own.view();
    if (!mesh.has_segments) return;
    if (mesh.has_cell_attributes) {
        std::vector<double> attributes(order.size());
        for (std::size_t i = 0; i < order.size(); i++) attributes[i] = mesh.cell_attributes[order[i]];
        mesh.cell_attributes = std::move(attributes);
    }
    sort_segments(mesh.segments);
    find_sides(mesh.cells, mesh.segments);
}

} // namespace compat
