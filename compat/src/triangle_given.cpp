#include "triangle_given.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <new>
#include <utility>

namespace compat {

namespace {

constexpr std::uint32_t none = UINT32_MAX;

std::uint64_t key_of(std::uint32_t start, std::uint32_t end) { return std::uint64_t{start} << 32 | end; }

std::array<std::uint32_t, 3> sorted(const std::uint32_t *corners) {
    std::array<std::uint32_t, 3> row{corners[0], corners[1], corners[2]};
    std::sort(row.begin(), row.end());
    return row;
}

} // namespace

std::string what_is_wrong_with_triangles(const triangulateio &in, bool is_zero_based, bool needs_areas) {
    char text[160];
    if (in.numberoftriangles <= 0 || in.trianglelist == nullptr)
        return "switch r needs triangles, and in->trianglelist has none";
    if (in.numberofcorners != 3) {
        std::snprintf(text, sizeof text, "in->numberofcorners is %d: 3 was expected", in.numberofcorners);
        return text;
    }
    if (in.numberoftriangleattributes < 0 || in.numberoftriangleattributes > 1) {
        std::snprintf(text, sizeof text, "in->numberoftriangleattributes is %d: 0 or 1 was expected",
                      in.numberoftriangleattributes);
        return text;
    }
    if (in.numberoftriangleattributes == 1 && in.triangleattributelist == nullptr)
        return "in->triangleattributelist is NULL";
    if (needs_areas && in.trianglearealist == nullptr) return "switch ra needs in->trianglearealist, which is NULL";
    const int first = is_zero_based ? 0 : 1;
    for (std::ptrdiff_t i = 0; i < std::ptrdiff_t{3} * in.numberoftriangles; i++) {
        const int corner = in.trianglelist[i];
        if (corner >= first && corner - first < in.numberofpoints) continue;
        std::snprintf(text, sizeof text, "in->trianglelist[%td] is %d, and points have the numbers %d to %d", i, corner,
                      first, first + in.numberofpoints - 1);
        return text;
    }
    return "";
}

GivenTriangles::GivenTriangles(const triangulateio &in, bool is_zero_based)
    : in_(in), around_(static_cast<std::size_t>(in.numberofpoints)) {
    std::unordered_set<std::uint64_t> edges;
    for (std::size_t k = 0; k < static_cast<std::size_t>(in.numberoftriangles); k++) {
        std::array<std::uint32_t, 3> row{};
        for (std::size_t i = 0; i < 3; i++)
            row[i] = static_cast<std::uint32_t>(in.trianglelist[3 * k + i] - (is_zero_based ? 0 : 1));
        if (orientation(row[0], row[1], in.pointlist + std::size_t{2} * row[2]) < 0) std::swap(row[1], row[2]);
        for (std::size_t i = 0; i < 3; i++) {
            corners_.push_back(row[i]);
            edges.insert(key_of(row[i], row[(i + 1) % 3]));
            around_[row[i]].push_back(static_cast<std::uint32_t>(k));
        }
    }
    for (std::size_t k = 0; k < corners_.size(); k++) {
        const std::uint32_t start = corners_[k], end = corners_[k - k % 3 + (k + 1) % 3];
        if (edges.count(key_of(end, start)) > 0) continue;
        boundary_.insert(boundary_.end(), {start, end});
        boundary_edges_.insert(key_of(start, end));
    }
}

bool GivenTriangles::is_outside(const Cells &cells, std::size_t place) const {
    const std::size_t row = place - place % 3;
    const std::uint32_t start = cells.vertices[row + (place + 1) % 3], end = cells.vertices[row + (place + 2) % 3];
    return boundary_edges_.count(key_of(end, start)) > 0;
}

void GivenTriangles::find_in(const deldrift_triangulation *t, const Cells &cells) {
    t_ = t;
    cells_ = cells;
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> index;
    for (std::size_t k = 0; k < corners_.size() / 3; k++)
        index.emplace(sorted(&corners_[3 * k]), static_cast<std::uint32_t>(k));
    of_cells_.assign(cells.count, none);
    for (std::size_t c = 0; c < cells.count; c++) {
        const auto found = index.find(sorted(cells.vertices + 3 * c));
        if (found != index.end()) of_cells_[c] = found->second;
    }
}

// One at one of three points, if there is one; otherwise any.
std::uint32_t GivenTriangles::triangle_around(const double *place, const std::uint32_t *points) const {
    for (int i = 0; i < 3; i++) {
        if (points[i] >= around_.size()) continue;
        for (const std::uint32_t k : around_[points[i]])
            if (has_inside(k, place)) return k;
    }
    for (std::uint32_t k = 0; k < corners_.size() / 3; k++)
        if (has_inside(k, place)) return k;
    return none;
}

bool GivenTriangles::has_inside(std::size_t triangle, const double *place) const {
    for (std::size_t i = 0; i < 3; i++)
        if (orientation(corners_[3 * triangle + i], corners_[3 * triangle + (i + 1) % 3], place) < 0) return false;
    return true;
}

// 0 for places that are no numbers, which nothing is made of.
int GivenTriangles::orientation(std::uint32_t start, std::uint32_t end, const double *place) const {
    const double *p = in_.pointlist + std::size_t{2} * start, *q = in_.pointlist + std::size_t{2} * end;
    const double points[6] = {p[0], p[1], q[0], q[1], place[0], place[1]};
    std::int32_t sign = 0;
    return deldrift_orientation(2, points, &sign) == DELDRIFT_OK ? sign : 0;
}

double GivenTriangles::number_at(const double *place, const double *numbers) const {
    deldrift_location found{};
    if (deldrift_locate(t_, place, &found) != DELDRIFT_OK) throw std::bad_alloc();
    if (found.kind != DELDRIFT_LOCATION_CELL) return 0;
    std::uint32_t triangle = of_cells_[found.index];
    if (triangle == none) triangle = triangle_around(place, cells_.vertices + std::size_t{3} * found.index);
    return triangle == none ? 0 : numbers[triangle];
}

} // namespace compat
