#include "matching.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace compat {

namespace {

constexpr std::size_t n_sampled = 64;

double squared_distance(unsigned dimension, const double *p, const double *q) {
    double sum = 0;
    for (unsigned axis = 0; axis < dimension; axis++) sum += (p[axis] - q[axis]) * (p[axis] - q[axis]);
    return sum;
}

// The diagonal of the box of a sample.
double extent_of(unsigned dimension, const double *points, std::size_t n_points, std::size_t stride) {
    double squared = 0;
    for (unsigned axis = 0; axis < dimension; axis++) {
        double low = points[axis], high = points[axis];
        for (std::size_t i = 0; i < n_points; i += stride) {
            low = std::min(low, points[i * dimension + axis]);
            high = std::max(high, points[i * dimension + axis]);
        }
        squared += (high - low) * (high - low);
    }
    return std::sqrt(squared);
}

// What becomes of the vertices of a triangulation: those that are left are the first points, in their order; further
// points are new.
struct Plan {
    std::vector<std::uint32_t> removed, left;
};

// Compares vertices and points in their order. A vertex that is not near the next point has moved far, if its successor
// is near that point's; otherwise it has been removed, if one of the vertices soon after it is near the point. Guesses
// that are wrong cost time, not correctness: any vertex may move to any place.
class Matching {
public:
    Matching(unsigned dimension, const std::vector<double> &before, const double *after, std::size_t n_after)
        : dimension_(dimension), before_(before.data()), n_before_(before.size() / dimension), after_(after),
          n_after_(n_after) {
        const double extent = extent_of(dimension, before_, n_before_, 1);
        const double spacing = extent / std::pow(static_cast<double>(n_before_), 1.0 / dimension);
        near_ = 0.25 * spacing * spacing;
    }

    // False if too much would be removed or inserted.
    bool plan(Plan &plan) const {
        std::size_t i = 0, j = 0;
        while (i < n_before_ && j < n_after_) {
            const bool stays = are_near(i, j) || are_near(i + 1, j + 1);
            const std::size_t skipped = stays ? 0 : vertices_before(i, j);
            if (skipped == none) break;
            for (std::size_t k = 0; k < skipped; k++) plan.removed.push_back(static_cast<std::uint32_t>(i++));
            plan.left.push_back(static_cast<std::uint32_t>(i++));
            j++;
        }
        for (; i < n_before_; i++) plan.removed.push_back(static_cast<std::uint32_t>(i));
        const std::size_t changes = plan.removed.size() + (n_after_ - plan.left.size());
        return changes <= n_before_ / 8;
    }

private:
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    static constexpr std::size_t window = 256;

    bool are_near(std::size_t i, std::size_t j) const {
        if (i >= n_before_ || j >= n_after_) return false;
        return squared_distance(dimension_, before_ + i * dimension_, after_ + j * dimension_) <= near_;
    }

    // How many vertices from i on are before the first that is near point j.
    std::size_t vertices_before(std::size_t i, std::size_t j) const {
        for (std::size_t k = 1; k < window && i + k < n_before_; k++)
            if (are_near(i + k, j)) return k;
        return none;
    }

    unsigned dimension_;
    const double *before_;
    std::size_t n_before_;
    const double *after_;
    std::size_t n_after_;
    double near_; // squared
};

bool edit(deldrift_triangulation *t, unsigned dimension, const double *points, std::size_t n_points, const Plan &plan) {
    const std::size_t n_left = plan.left.size();
    std::uint32_t first = 0;
    std::size_t n_ids = 0;
    return deldrift_stage_removals(t, plan.removed.data(), plan.removed.size()) == DELDRIFT_OK &&
           deldrift_move_vertices(t, plan.left.data(), points, n_left) == DELDRIFT_OK &&
           deldrift_stage_insertions(t, points + n_left * dimension, n_points - n_left, &first) == DELDRIFT_OK &&
           deldrift_commit_timestamp(t, nullptr) == DELDRIFT_OK &&
           deldrift_compact(t, nullptr, 0, &n_ids) == DELDRIFT_OK;
}

} // namespace

double relative_distance(const deldrift_triangulation *t, unsigned dimension, const double *points,
                         std::size_t n_points) {
    const std::size_t stride = (n_points + n_sampled - 1) / n_sampled;
    double sum = 0, position[3];
    std::size_t n = 0;
    for (std::size_t i = 0; i < n_points; i += stride, n++) {
        if (deldrift_position(t, static_cast<std::uint32_t>(i), position) != DELDRIFT_OK)
            return std::numeric_limits<double>::infinity();
        sum += std::sqrt(squared_distance(dimension, position, points + i * dimension));
    }
    const double mean = sum / static_cast<double>(n), extent = extent_of(dimension, points, n_points, stride);
    return extent > 0 && std::isfinite(mean) ? mean / extent : std::numeric_limits<double>::infinity();
}

bool similar_counts(std::size_t before, std::size_t after) {
    const std::size_t less = std::min(before, after), more = std::max(before, after);
    return more - less <= more / 8;
}

Outcome move_to(deldrift_triangulation *t, const double *points, std::size_t n_points) {
    const bool done = deldrift_commit_positions(t, points, n_points, nullptr) == DELDRIFT_OK;
    return done ? Outcome::brought : Outcome::failed;
}

Outcome edit_to(deldrift_triangulation *t, unsigned dimension, const double *points, std::size_t n_points) {
    std::size_t n_ids = 0;
    if (deldrift_id_count(t, &n_ids) != DELDRIFT_OK) return Outcome::failed;
    std::vector<double> before(n_ids * dimension);
    if (deldrift_copy_positions(t, before.data(), n_ids, &n_ids) != DELDRIFT_OK) return Outcome::failed;
    Plan plan;
    if (!Matching(dimension, before, points, n_points).plan(plan)) return Outcome::unlike;
    return edit(t, dimension, points, n_points, plan) ? Outcome::brought : Outcome::failed;
}

} // namespace compat
