// Triangles at segments in whose diametral circle their third corner is. Where there is none, all triangles are
// Delaunay, segments or not.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "cells.hpp"

namespace compat {

// Corners of triangles, which are told by their coordinates.
class Encroached {
public:
    // Adds a triangle if its corner that is not an end of the segment is in the circle.
    void add_if_encroached(const std::uint32_t *corners, const std::uint32_t *ends, const std::vector<double> &points) {
        double places[6];
        for (int i = 0; i < 3; i++) std::copy_n(&points[std::size_t{2} * corners[i]], 2, places + 2 * i);
        for (int i = 0; i < 3; i++)
            if (corners[i] != ends[0] && corners[i] != ends[1] && is_obtuse(places, i)) triangles_.insert(key(places));
    }

    std::size_t count() const { return triangles_.size(); }

    // As deldrift_quality has it; the first argument is the set.
    static bool has(void *encroached, const double *places) {
        return static_cast<const Encroached *>(encroached)->triangles_.count(key(places)) > 0;
    }

private:
    using Key = std::array<double, 6>;

    static bool is_obtuse(const double *places, int corner) {
        const double *p = places + 2 * corner;
        const double *a = places + 2 * ((corner + 1) % 3), *b = places + 2 * ((corner + 2) % 3);
        return (a[0] - p[0]) * (b[0] - p[0]) + (a[1] - p[1]) * (b[1] - p[1]) < 0;
    }

    // From the lowest corner on.
    static Key key(const double *places) {
        const double *lowest = places;
        for (const double *each = places + 2; each < places + 6; each += 2)
            if (std::lexicographical_compare(each, each + 2, lowest, lowest + 2)) lowest = each;
        Key result;
        std::copy_n(places, 6, result.begin());
        std::rotate(result.begin(), result.begin() + (lowest - places), result.end());
        return result;
    }

    std::set<Key> triangles_;
};

} // namespace compat
