// Triangulation_conformer_2, make_conforming_Delaunay_2 and make_conforming_Gabriel_2: see cgal.hpp.
#ifndef DELDRIFT_CGAL_CONFORMING_HPP
#define DELDRIFT_CGAL_CONFORMING_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include "constrained.hpp"

namespace deldrift::cgal {

namespace detail {

// Finds on a copy of a triangulation where its segments are to be divided.
class Conforming {
    template <class Tr>
    friend class cgal::Triangulation_conformer_2;
    using Place = std::array<double, 2>;
    static constexpr std::uint32_t n_corners = 8;

    // With at most so many new vertices.
    explicit Conforming(const Triangulation &t, std::size_t limit = SIZE_MAX)
        : n_given_(t.id_count()), given_(t.segments()), copy_(t.clone()), limit_(limit) {
        copy_.discard_moves();
    }

    // Until no corner of a cell is inside the circle around a segment at it, by deldrift_refine: all cells are refined,
    // within a frame of sides that stay whole.
    void make_Gabriel() {
        if (copy_.cell_count() == 0) return;
        const std::uint32_t first = copy_.stage_insertions(frame());
        std::vector<std::uint32_t> corners(n_corners), sides(n_corners);
        std::iota(corners.begin(), corners.end(), first);
        std::vector<Ends> ends;
        for (std::uint32_t i = 0; i < n_corners; i++) ends.push_back({first + i, first + (i + 1) % n_corners});
        std::iota(sides.begin(), sides.end(), copy_.stage_segments(ends));
        copy_.commit_timestamp();
        Quality quality;
        quality.is_conforming = true;
        quality.keeps = DELDRIFT_KEPT_OUTER;
        quality.limit = limit_;
        const std::vector<std::uint8_t> all(copy_.cell_count(), 1);
        const deldrift_quality_report report = copy_.refine(quality, all);
        n_inserted_ = static_cast<std::size_t>(report.inserted);
        n_unsplit_ = static_cast<std::size_t>(report.unsplit);
        copy_.stage_segment_removals(sides);
        copy_.stage_removals(corners);
        copy_.commit_timestamp();
    }

    // Until both cells at each segment have the corner beyond it on their circle or outside: in rounds, each of which
    // divides all segments of which that does not hold. Such a segment has a corner inside of the circle around it.
    void make_Delaunay() {
        find_apexes();
        std::set<std::uint32_t> whole;
        while (n_inserted_ < limit_) {
            std::vector<std::uint32_t> wanted = not_locally_Delaunay(copy_);
            const auto is_whole = [&whole](std::uint32_t segment) { return whole.count(segment) > 0; };
            wanted.erase(std::remove_if(wanted.begin(), wanted.end(), is_whole), wanted.end());
            if (wanted.empty()) return;
            wanted.resize((std::min)(wanted.size(), limit_ - n_inserted_));
            if (split(wanted)) continue;
            // Rounded, some place is that of a vertex.
            for (std::uint32_t segment : wanted) {
                if (!split({segment})) whole.insert(segment);
            }
        }
    }

    std::size_t n_inserted() const noexcept { return n_inserted_; }
    // Segments that are to be divided and have no room for a vertex, after make_Gabriel().
    std::size_t n_unsplit() const noexcept { return n_unsplit_; }

    // What the triangulation needs: new vertices, pieces, with ids as these will have, and segments that leave.
    void tell(std::vector<Place> &places, std::vector<Ends> &pieces,
              std::vector<std::uint32_t> &removals) const {
        std::vector<std::uint32_t> id_of(copy_.id_count());
        for (std::uint32_t id = 0; id < id_of.size(); id++) {
            id_of[id] = id;
            if (id < n_given_ || !copy_.is_present(id)) continue;
            id_of[id] = static_cast<std::uint32_t>(n_given_ + places.size());
            places.push_back(copy_.position<2>(id));
        }
        const Segments segments = copy_.segments();
        for (std::size_t k = 0; k < segments.size(); k++) {
            const Ends &ends = segments.ends[k];
            if (!has(given_.ids, segments.ids[k])) pieces.push_back({id_of[ends[0]], id_of[ends[1]]});
        }
        for (std::uint32_t segment : given_.ids) {
            if (!has(segments.ids, segment)) removals.push_back(segment);
        }
    }

    // Segments beyond which a corner is inside the circle of a cell at them, ascending.
    static std::vector<std::uint32_t> not_locally_Delaunay(const Triangulation &t) {
        const Segments segments = t.segments();
        const std::vector<std::array<std::uint32_t, 2>> beside = t.cells_of_segments();
        const Cells cells = t.cells();
        std::vector<std::uint32_t> found;
        for (std::size_t k = 0; k < segments.size(); k++) {
            if (beside[k][0] == DELDRIFT_NONE || beside[k][1] == DELDRIFT_NONE) continue;
            std::array<std::array<double, 2>, 4> points;
            const Row corners = cells[beside[k][0]];
            for (std::size_t i = 0; i < 3; i++) points[i] = t.position<2>(corners[i]);
            for (std::uint32_t v : cells[beside[k][1]]) {
                if (std::find(corners.begin(), corners.end(), v) == corners.end()) points[3] = t.position<2>(v);
            }
            if (in_sphere(2, points) > 0) found.push_back(segments.ids[k]);
        }
        return found;
    }

    static bool has(const std::vector<std::uint32_t> &ids, std::uint32_t id) {
        return std::binary_search(ids.begin(), ids.end(), id);
    }
    static Place minus(const Place &p, const Place &q) { return {p[0] - q[0], p[1] - q[1]}; }
    static double dot(const Place &p, const Place &q) { return p[0] * q[0] + p[1] * q[1]; }

    // The corners of an octagon so far away that no circle around a side reaches what is inside, and none around a
    // segment inside reaches a corner.
    std::vector<Place> frame() const {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        Place low{infinity, infinity}, high{-infinity, -infinity};
        for (const auto &p : copy_.positions<2>()) {
            // The coordinates of removed vertices are no numbers.
            for (std::size_t k = 0; k < 2; k++) {
                if (p[k] < low[k]) low[k] = p[k];
                if (p[k] > high[k]) high[k] = p[k];
            }
        }
        const double x = 0.5 * low[0] + 0.5 * high[0], y = 0.5 * low[1] + 0.5 * high[1];
        const double inner = (std::max)(high[0] - low[0], high[1] - low[1]), outer = 2 * inner;
        return {{x + outer, y - inner}, {x + outer, y + inner}, {x + inner, y + outer}, {x - inner, y + outer},
                {x - outer, y + inner}, {x - outer, y - inner}, {x - inner, y - outer}, {x + inner, y - outer}};
    }

    // Segments with a smaller angle than 60 degrees between them are divided at round distances from the apex, so that
    // vertices of one are not inside the circles of the other. For each segment its apex, if one of its ends is one.
    void find_apexes() {
        std::map<std::uint32_t, std::vector<std::uint32_t>> beyond;
        for (const Ends &ends : given_.ends) {
            beyond[ends[0]].push_back(ends[1]);
            beyond[ends[1]].push_back(ends[0]);
        }
        for (const auto &[apex, others] : beyond) {
            for (std::uint32_t other : others) is_sharp_[{apex, other}] = is_sharp(apex, other, others);
        }
        for (std::size_t k = 0; k < given_.size(); k++) {
            const auto [a, b] = given_.ends[k];
            const bool is_sharp_at_a = is_sharp_[{a, b}], is_sharp_at_b = is_sharp_[{b, a}];
            if (is_sharp_at_a != is_sharp_at_b) apex_of_[given_.ids[k]] = is_sharp_at_a ? a : b;
        }
    }
    bool is_sharp(std::uint32_t apex, std::uint32_t other, const std::vector<std::uint32_t> &others) const {
        const Place p = copy_.position<2>(apex), u = minus(copy_.position<2>(other), p);
        return std::any_of(others.begin(), others.end(), [&](std::uint32_t third) {
            const Place v = minus(copy_.position<2>(third), p);
            const double cosine = dot(u, v) / std::sqrt(dot(u, u)) / std::sqrt(dot(v, v));
            return third != other && cosine > 0.5;
        });
    }

    // A number between two others, away from both by a quarter of their difference, that is a multiple of the greatest
    // power of two.
    static double round_between(double low, double high) {
        const double quarter = 0.25 * (high - low), least = low + quarter, most = high - quarter;
        for (double step = std::exp2(std::floor(std::log2(most))); step > 0.25 * quarter; step *= 0.5) {
            const double round = std::ceil(least / step) * step;
            if (round <= most) return round;
        }
        return 0.5 * (least + most);
    }
    // In the middle, or at a round distance from the apex.
    Place place_on(const Ends &ends, std::uint32_t apex) const {
        const Place p = copy_.position<2>(ends[0]), q = copy_.position<2>(ends[1]);
        double share = 0.5;
        if (apex != DELDRIFT_NONE) {
            const auto distance = [&](const Place &r) {
                const Place u = minus(r, copy_.position<2>(apex));
                return std::sqrt(dot(u, u));
            };
            const double d = distance(p), e = distance(q);
            if (d < e || e < d) share = (round_between((std::min)(d, e), (std::max)(d, e)) - d) / (e - d);
        }
        Place place{};
        for (std::size_t k = 0; k < 2; k++) place[k] = (1 - share) * p[k] + share * q[k];
        return place;
    }

    // Divides each of some segments in two, and what rounding then has in the way of each other. Whether that could be
    // done.
    bool split(const std::vector<std::uint32_t> &wanted) {
        const Segments segments = copy_.segments();
        const std::size_t n = copy_.id_count();
        std::vector<Place> places;
        std::vector<Ends> pieces;
        std::vector<std::uint32_t> apexes;
        for (std::uint32_t segment : wanted) {
            const auto row = std::lower_bound(segments.ids.begin(), segments.ids.end(), segment) - segments.ids.begin();
            const Ends &ends = segments.ends[static_cast<std::size_t>(row)];
            const auto known = apex_of_.find(segment);
            const std::uint32_t apex = known == apex_of_.end() ? DELDRIFT_NONE : known->second;
            const auto v = static_cast<std::uint32_t>(n + places.size());
            places.push_back(place_on(ends, apex));
            for (std::size_t i = 0; i < 2; i++) {
                pieces.push_back(i == 0 ? Ends{ends[0], v} : Ends{v, ends[1]});
                // Of a segment between two apexes each half has its own.
                const bool is_own = apex == DELDRIFT_NONE && is_sharp_at(ends[i], ends[1 - i]);
                apexes.push_back(is_own ? ends[i] : apex);
            }
        }
        try {
            copy_.stage_insertions(places);
            const std::uint32_t first = copy_.stage_segments(pieces);
            copy_.stage_segment_removals(wanted);
            copy_.stage_splits();
            copy_.commit_timestamp();
            for (std::size_t k = 0; k < apexes.size(); k++) {
                if (apexes[k] != DELDRIFT_NONE) apex_of_[first + static_cast<std::uint32_t>(k)] = apexes[k];
            }
        } catch (const Error &error) {
            copy_.discard_moves();
            if (error.status() == DELDRIFT_COINCIDENT || ConflictError::is_conflict(error.status())) return false;
            throw;
        }
        n_inserted_ += copy_.id_count() - n;
        return true;
    }
    bool is_sharp_at(std::uint32_t apex, std::uint32_t other) const {
        const auto found = is_sharp_.find({apex, other});
        return found != is_sharp_.end() && found->second;
    }

    std::size_t n_given_;
    Segments given_;
    Triangulation copy_;
    std::size_t limit_, n_inserted_ = 0, n_unsplit_ = 0;
    // Whether an input segment between two vertices makes a small angle at the first one.
    std::map<Ends, bool> is_sharp_{};
    std::map<std::uint32_t, std::uint32_t> apex_of_{};
};

}  // namespace detail

// Divides the constrained edges of a triangulation until it is a conforming one:
// - Delaunay: no vertex is inside the circle of a face, constraints or not;
// - Gabriel: besides, the vertices opposite a constrained edge in its two faces are not inside the circle around it.
// Handles of vertices stay valid, and new vertices have infos of a constructor without arguments. A call that throws
// has no effect. An edge that has no room for a vertex, by rounding, stays as it is, and is_conforming_* tells.
template <class Tr>
class Triangulation_conformer_2 {
public:
    explicit Triangulation_conformer_2(Tr &t) : t_(t) {}

    bool is_conforming_Delaunay() const {
        return detail::Conforming::not_locally_Delaunay(t_.triangulation()).empty();
    }
    bool is_conforming_Gabriel() const {
        detail::Conforming conforming(t_.triangulation(), 1);
        conforming.make_Gabriel();
        return conforming.n_inserted() == 0 && conforming.n_unsplit() == 0;
    }
    void make_conforming_Delaunay() {
        init_Delaunay();
        divide(Kind::delaunay, SIZE_MAX);
    }
    void make_conforming_Gabriel() {
        init_Gabriel();
        divide(Kind::gabriel, SIZE_MAX);
    }

    // One vertex at a time, which takes about as long as all of them.
    void init_Delaunay() noexcept { kind_ = Kind::delaunay; }
    void init_Gabriel() noexcept { kind_ = Kind::gabriel; }
    // Whether a step of the kind that was initialized last would do nothing.
    bool is_conforming_done() const { return kind_ == Kind::none || found(kind_, 1).n_inserted() == 0; }
    // Whether a vertex has been inserted.
    bool step_by_step_conforming_Delaunay() { return divide(Kind::delaunay, 1); }
    bool step_by_step_conforming_Gabriel() { return divide(Kind::gabriel, 1); }
    bool try_one_step_conforming_Delaunay() { return step_by_step_conforming_Delaunay(); }
    bool try_one_step_conforming_Gabriel() { return step_by_step_conforming_Gabriel(); }

    int number_of_constrained_edges() const { return static_cast<int>(t_.triangulation().segments().size()); }

private:
    enum class Kind { none, delaunay, gabriel };

    detail::Conforming found(Kind kind, std::size_t limit) const {
        detail::Conforming conforming(t_.triangulation(), limit);
        if (kind == Kind::delaunay) conforming.make_Delaunay();
        else conforming.make_Gabriel();
        return conforming;
    }
    bool divide(Kind kind, std::size_t limit) {
        const detail::Conforming conforming = found(kind, limit);
        if (conforming.n_inserted() == 0) return false;
        std::vector<std::array<double, 2>> places;
        std::vector<Ends> pieces;
        std::vector<std::uint32_t> removals;
        conforming.tell(places, pieces, removals);
        t_.divide(places, pieces, removals);
        return true;
    }

    Tr &t_;
    Kind kind_ = Kind::none;
};

template <class Tr>
void make_conforming_Delaunay_2(Tr &t) {
    Triangulation_conformer_2<Tr>(t).make_conforming_Delaunay();
}
template <class Tr>
void make_conforming_Gabriel_2(Tr &t) {
    Triangulation_conformer_2<Tr>(t).make_conforming_Gabriel();
}

}  // namespace deldrift::cgal

#endif  // DELDRIFT_CGAL_CONFORMING_HPP
