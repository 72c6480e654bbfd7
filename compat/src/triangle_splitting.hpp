// Where segments are split so that triangles are Delaunay beside them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace compat {

class Splitting {
public:
    // Two ends of each segment, and the places of points. Both are to live as long.
    Splitting(const std::vector<std::uint32_t> &ends, const std::vector<double> &points) : ends_(ends), points_(points) {
        for (std::size_t i = 0; i < ends.size(); i++) at_.emplace(ends[i], ends[i ^ 1]);
    }

    // Whether a corner of a triangle is inside the circle around the segment, at which the triangle is.
    bool is_encroached(std::size_t segment, const std::uint32_t *corners) const {
        const std::uint32_t start = ends_[2 * segment], end = ends_[2 * segment + 1];
        for (int i = 0; i < 3; i++)
            if (corners[i] != start && corners[i] != end && dot(corners[i], start, end) < 0) return true;
        return false;
    }

    // Splits a segment, unless rounding leaves no room between its ends.
    void add(std::size_t segment) {
        const std::uint32_t start = ends_[2 * segment], end = ends_[2 * segment + 1];
        const double *from = at(start), *to = at(end);
        const double share = share_from(start, end);
        const double place[2] = {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])};
        for (const double *other : {from, to})
            if (place[0] == other[0] && place[1] == other[1]) return;
        segments_.push_back(segment);
        along_.push_back(share);
        places_.insert(places_.end(), place, place + 2);
    }

    std::size_t count() const { return segments_.size(); }
    const std::vector<std::size_t> &segments() const { return segments_; }
    const std::vector<double> &along() const { return along_; }
    const std::vector<double> &places() const { return places_; }

private:
    const double *at(std::uint32_t point) const { return points_.data() + std::size_t{2} * point; }

    // Of the vectors from a point to two others.
    double dot(std::uint32_t point, std::uint32_t a, std::uint32_t b) const {
        const double *p = at(point), *q = at(a), *r = at(b);
        return (q[0] - p[0]) * (r[0] - p[0]) + (q[1] - p[1]) * (r[1] - p[1]);
    }

    // Whether another segment makes an acute angle at the start.
    bool is_acute(std::uint32_t start, std::uint32_t end) const {
        const auto [first, last] = at_.equal_range(start);
        for (auto each = first; each != last; ++each)
            if (each->second != end && dot(start, each->second, end) > 0) return true;
        return false;
    }

    // In the middle. At an acute angle at a power of two from its apex: pieces of both segments that are as long do not
    // encroach each other (Ruppert's concentric circles, 10.1006/jagm.1995.1021).
    double share_from(std::uint32_t start, std::uint32_t end) const {
        const bool is_acute_at_end = is_acute(end, start);
        if (!is_acute_at_end && !is_acute(start, end)) return 0.5;
        const double length = std::hypot(at(end)[0] - at(start)[0], at(end)[1] - at(start)[1]);
        const double share = std::exp2(std::round(std::log2(length / 2))) / length;
        return is_acute_at_end ? 1 - share : share;
    }

    const std::vector<std::uint32_t> &ends_;
    const std::vector<double> &points_;
    std::unordered_multimap<std::uint32_t, std::uint32_t> at_; // the other ends of the segments at each point
    std::vector<std::size_t> segments_;
    std::vector<double> along_, places_;
};

} // namespace compat
