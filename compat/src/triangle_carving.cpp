#include "triangle_carving.hpp"

#include <algorithm>
#include <new>
#include <utility>

#include "hull.hpp"
#include "representatives.hpp"

namespace compat {

Mesh outline_of(const Graph &graph, const triangulateio &in) {
    Mesh mesh;
    mesh.n_points = graph.n_points();
    mesh.n_attributes = static_cast<std::size_t>(in.numberofpointattributes);
    mesh.points = graph.points();
    mesh.attributes = graph.attributes();
    mesh.has_segments = true;
    mesh.point_markers = graph.point_markers();
    mesh.segments.ends = graph.ends();
    mesh.segments.markers = graph.markers();
    return mesh;
}

Carver::Carver(const triangulateio &in, Mesh outline, const deldrift_triangulation *t, const Cells &cells)
    : in_(in), t_(t), cells_(cells), labels_(cells.count, without_region), mesh_(std::move(outline)) {
    if (mesh_.segments.at.empty()) find_sides_of_cells();
}

void Carver::find_sides_of_cells() {
    std::vector<std::uint32_t> &at = mesh_.segments.at;
    at.assign(3 * cells_.count, no_segment);
    std::size_t n = 0;
    if (mesh_.segments.count() == 0 || cells_.count == 0) return;
    if (deldrift_segments_of_cells(t_, at.data(), cells_.count, &n) != DELDRIFT_OK) throw std::bad_alloc();
}

void Carver::enclose() {
    for_each_hull_edge(cells_, mesh_.points, [&](std::uint32_t cell, unsigned corner) {
        std::uint32_t &segment = segment_at(cell, corner);
        const std::uint32_t start = cells_.vertices[std::size_t{3} * cell + (corner + 1) % 3];
        const std::uint32_t end = cells_.vertices[std::size_t{3} * cell + (corner + 2) % 3];
        if (segment == no_segment) {
            segment = static_cast<std::uint32_t>(mesh_.segments.count());
            mesh_.segments.add(end, start, 0);
        }
        mark_as_boundary(segment);
    });
}

void Carver::carve(const TriangleSwitches &switches) {
    if (!switches.encloses()) eat_concavities();
    if (!switches.planar_graph) return;
    if (switches.holes) eat_holes();
    if ((switches.regions || switches.has_region_areas) && in_.numberofregions > 0) spread_regions();
}

void Carver::keep(const GivenTriangles &given) {
    eat_concavities();
    for (std::size_t place = 0; place < 3 * cells_.count; place++)
        if (given.is_outside(cells_, place)) flood(static_cast<std::uint32_t>(place / 3), eaten);
}

void Carver::give_attributes_of(const GivenTriangles &given) {
    mesh_.has_cell_attributes = true;
    mesh_.cell_attributes.assign(cells_.count, 0);
    for (std::size_t c = 0; c < cells_.count; c++) {
        double centre[2] = {0, 0};
        for (std::size_t i = 0; i < 6; i++)
            centre[i % 2] += mesh_.points[std::size_t{2} * cells_.vertices[3 * c + i / 2] + i % 2] / 3;
        if (labels_[c] != eaten) mesh_.cell_attributes[c] = given.attribute_at(centre);
    }
}

// What no segment separates from the outside. Segments of the hull are marked first, as in Triangle, where what they
// enclose may be eaten later.
void Carver::eat_concavities() {
    for (std::size_t place = 0; place < 3 * cells_.count; place++) {
        const std::uint32_t segment = mesh_.segments.at[place];
        if (cells_.neighbours[place] == no_cell && segment != no_segment) mark_as_boundary(segment);
    }
    for (std::size_t place = 0; place < 3 * cells_.count; place++)
        if (cells_.neighbours[place] == no_cell && mesh_.segments.at[place] == no_segment)
            flood(static_cast<std::uint32_t>(place / 3), eaten);
}

void Carver::eat_holes() {
    for (int i = 0; i < in_.numberofholes; i++) {
        const std::uint32_t cell = cell_at(in_.holelist + std::ptrdiff_t{2} * i);
        if (cell != no_cell) flood(cell, eaten);
    }
}

// A region that comes later goes over an earlier one. Those in what has been eaten do nothing.
void Carver::spread_regions() {
    for (int i = 0; i < in_.numberofregions; i++) {
        const std::uint32_t cell = cell_at(in_.regionlist + std::ptrdiff_t{4} * i);
        if (cell != no_cell && labels_[cell] != eaten) flood(cell, i + 1);
    }
}

// A cell that has the place inside or on its boundary, or no_cell outside of the hull.
std::uint32_t Carver::cell_at(const double *place) const {
    deldrift_location found{};
    if (deldrift_locate(t_, place, &found) != DELDRIFT_OK) throw std::bad_alloc();
    if (found.kind == DELDRIFT_LOCATION_CELL) return found.index;
    if (found.kind != DELDRIFT_LOCATION_VERTEX) return no_cell;
    const std::uint32_t *end = cells_.vertices + 3 * cells_.count;
    const std::uint32_t *first = std::find(cells_.vertices, end, found.index);
    return first == end ? no_cell : static_cast<std::uint32_t>((first - cells_.vertices) / 3);
}

// Labels what can be reached without crossing a segment.
void Carver::flood(std::uint32_t cell, std::int32_t label) {
    if (labels_[cell] == label) return;
    labels_[cell] = label;
    reached_.assign(1, cell);
    while (!reached_.empty()) {
        const std::size_t row = std::size_t{3} * reached_.back();
        reached_.pop_back();
        for (std::size_t place = row; place < row + 3; place++) {
            const std::uint32_t next = cells_.neighbours[place];
            if (next == no_cell || mesh_.segments.at[place] != no_segment || labels_[next] == label) continue;
            labels_[next] = label;
            reached_.push_back(next);
        }
    }
}

void Carver::mark_as_boundary(std::uint32_t segment) {
    if (mesh_.segments.markers[segment] == 0) mesh_.segments.markers[segment] = 1;
    for (int end = 0; end < 2; end++) {
        int &marker = mesh_.point_markers[mesh_.segments.ends[std::size_t{2} * segment + end]];
        if (marker == 0) marker = 1;
    }
}

void Carver::mark_boundary() {
    for (std::size_t place = 0; place < 3 * cells_.count; place++) {
        const std::uint32_t neighbour = cells_.neighbours[place];
        if (labels_[place / 3] != eaten && (neighbour == no_cell || labels_[neighbour] == eaten))
            mark_as_boundary(mesh_.segments.at[place]);
    }
}

Mesh Carver::finish(const TriangleSwitches &switches) {
    mark_boundary();
    const bool has_regions = switches.regions && !switches.reconstructs && in_.numberofregions > 0;
    if (switches.planar_graph && has_regions) give_attributes();
    const std::size_t n_eaten = static_cast<std::size_t>(std::count(labels_.begin(), labels_.end(), eaten));
    if (n_eaten > 0) take_away(cells_.count - n_eaten);
    else mesh_.cells = cells_;
    drop_segments();
    // Points are left out where they are in no cell. Without cells that is told here: those of no cells from the start
    // stay, but for those at the place of another.
    if (cells_.count == 0) mesh_.representative = representatives(t_, mesh_.n_points);
    else if (mesh_.cells.count == 0) mesh_.representative.assign(mesh_.n_points, no_cell);
    if (switches.planar_graph && cells_.count > 0) {
        mesh_.n_holes = static_cast<std::size_t>(in_.numberofholes);
        mesh_.n_regions = static_cast<std::size_t>(in_.numberofregions);
    }
    return std::move(mesh_);
}

void Carver::give_attributes() {
    mesh_.has_cell_attributes = true;
    mesh_.cell_attributes.assign(cells_.count, 0);
    for (std::size_t c = 0; c < cells_.count; c++)
        if (labels_[c] > 0) mesh_.cell_attributes[c] = in_.regionlist[std::ptrdiff_t{4} * labels_[c] - 2];
}

void Carver::take_away(std::size_t n_left) {
    std::vector<std::uint32_t> new_index(cells_.count, no_cell);
    std::uint32_t next = 0;
    for (std::size_t c = 0; c < cells_.count; c++)
        if (labels_[c] != eaten) new_index[c] = next++;
    OwnedCells &own = mesh_.own;
    own.n_corners = 3;
    own.vertices.reserve(3 * n_left);
    own.neighbours.reserve(3 * n_left);
    std::vector<std::uint32_t> &at = mesh_.segments.at;
    for (std::size_t c = 0; c < cells_.count; c++) {
        if (labels_[c] == eaten) continue;
        if (mesh_.has_cell_attributes) mesh_.cell_attributes[own.vertices.size() / 3] = mesh_.cell_attributes[c];
        for (std::size_t place = 3 * c; place < 3 * c + 3; place++) {
            const std::uint32_t neighbour = cells_.neighbours[place];
            at[own.vertices.size()] = at[place];
            own.vertices.push_back(cells_.vertices[place]);
            own.neighbours.push_back(neighbour == no_cell ? no_cell : new_index[neighbour]);
        }
    }
    at.resize(3 * n_left);
    if (mesh_.has_cell_attributes) mesh_.cell_attributes.resize(n_left);
    mesh_.cells = own.view();
}

// Segments at no cell that is left.
void Carver::drop_segments() {
    Segments &segments = mesh_.segments;
    std::vector<std::uint32_t> new_index(segments.count(), no_segment);
    for (std::uint32_t segment : segments.at)
        if (segment != no_segment) new_index[segment] = 0;
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < new_index.size(); i++) {
        if (new_index[i] == no_segment) continue;
        segments.markers[next] = segments.markers[i];
        std::copy_n(segments.ends.begin() + static_cast<std::ptrdiff_t>(2 * i), 2, segments.ends.begin() + 2 * next);
        new_index[i] = next++;
    }
    if (next == segments.count()) return;
    segments.markers.resize(next);
    segments.ends.resize(std::size_t{2} * next);
    for (std::uint32_t &segment : segments.at)
        if (segment != no_segment) segment = new_index[segment];
}

} // namespace compat
