// One call on one set, timed in a process of its own, which may be ended when it takes too long.
#pragma once

#include <deldrift/research.h>
#include <time.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sets.hpp"

namespace costs {

using Ids = std::vector<std::uint32_t>;

/// What has been found out about one call.
struct Measured {
    /// Of all timed calls together.
    double seconds;
    /// Numbers read and written, in vertices and cells: what time should be in proportion to.
    double units;
    /// How often the callbacks were called, and the longest time within one timed call without.
    double asks, longest_gap;
    /// Vertices and cells there are afterwards, which memory should be in proportion to.
    double size;
    /// What the triangulation holds afterwards, and what the process had more at most than before.
    double held_bytes, peak_bytes;
};

/// Times calls, and the gaps between two calls of a callback.
class Meter {
public:
    /// Times `call`, which makes so many calls, alike and short ones if it is not one.
    template <typename Call>
    void time(Call call, std::size_t calls = 1) {
        const double start = now();
        last_ = start;
        call();
        const double end = now();
        seconds_ += end - start;
        gap_ = std::max(gap_, (end - last_) / double(calls));
    }
    void asked() {
        const double at = now();
        gap_ = std::max(gap_, at - last_);
        last_ = at;
        ++asks_;
    }
    void reset() { seconds_ = gap_ = asks_ = 0; }
    /// Further input or output of what is timed.
    void count(double units) { units_ += units; }
    double elapsed() const { return seconds_; }
    Measured measured() const { return {seconds_, units_, asks_, gap_, 0, 0, 0}; }

private:
    /// Of this thread on a processor, which other programs do not add to.
    static double now() {
        timespec at;
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &at);
        return double(at.tv_sec) + 1e-9 * double(at.tv_nsec);
    }

    double seconds_ = 0, gap_ = 0, asks_ = 0, units_ = 0;
    double last_ = now();
};

/// Ends the process where a call fails that must not.
inline void must(deldrift_status status) {
    if (status != DELDRIFT_OK) throw std::runtime_error(deldrift_last_error());
}

/// A set, its triangulation, and what calls need of both. Each call has a copy, in its own process.
struct Context {
    std::string folder;
    unsigned dimension;
    std::size_t n;
    Points points;
    deldrift_triangulation *t = nullptr;
    Meter meter;
    Random random{17};
    /// The length of the shortest edge of each vertex, 0 of hidden ones.
    std::vector<double> spacing;

    Context(unsigned d, Points set)
        : dimension(d), n(set.size() / d), points(std::move(set)), low_(place(0), place(1)), high_(low_) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            low_[i % d] = std::min(low_[i % d], points[i]);
            high_[i % d] = std::max(high_[i % d], points[i]);
        }
    }

    /// Those of the table: one thread, and callbacks that are watched.
    deldrift_options options() {
        deldrift_options options;
        deldrift_options_init(&options);
        options.threads = 1;
        options.user_data = &meter;
        options.cancel = [](void *meter) { return static_cast<Meter *>(meter)->asked(), false; };
        options.progress = [](void *meter, double) { static_cast<Meter *>(meter)->asked(); };
        return options;
    }
    deldrift_triangulation *create(const deldrift_options &with) {
        deldrift_triangulation *made;
        must(deldrift_create(dimension, points.data(), n, &with, &made));
        return made;
    }
    void triangulate() {
        t = create(options());
        find_spacing();
        // The first search makes a tree for later ones.
        std::uint32_t nearest;
        must(deldrift_nearest_vertex(t, points.data(), &nearest));
    }

    std::size_t cells() const {
        std::size_t count;
        must(deldrift_cell_count(t, &count));
        return count;
    }
    std::size_t corners() const { return dimension + 1; }
    std::size_t star(std::uint32_t vertex) const {
        std::size_t count;
        must(deldrift_star(t, vertex, nullptr, 0, &count));
        return count;
    }
    std::size_t ids() const {
        std::size_t count;
        must(deldrift_id_count(t, &count));
        return count;
    }
    deldrift_cells_view view() const {
        deldrift_cells_view view;
        must(deldrift_cells(t, &view));
        return view;
    }

    /// How many times a call for one vertex or place is made: a part of n, so that what is proportional to n shows.
    std::size_t some() const { return std::max<std::size_t>(8, n / 8); }
    std::uint32_t some_vertex(std::size_t i) const { return std::uint32_t(i * (n / some())); }
    const double *place(std::size_t vertex) const { return &points[vertex * dimension]; }

    /// A thousandth of the shortest edge away.
    Points nearby(std::size_t vertex) { return around(vertex, 1e-3); }
    /// At another vertex: a third of that one's shortest edge away.
    Points elsewhere() { return around(random.below(n), 0.33); }
    /// Half of them between two vertices, half anywhere in the box of all.
    Points anywhere() {
        Points p(dimension);
        const double *a = place(random.below(n)), *b = place(random.below(n));
        const bool between = random.below(2) == 0;
        for (unsigned k = 0; k < dimension; ++k)
            p[k] = between ? a[k] / 2 + b[k] / 2 : low_[k] + random.unit() * (high_[k] - low_[k]);
        return p;
    }
    /// All vertices, each a little away from its place.
    Points all_nearby() {
        Points moved;
        for (std::size_t v = 0; v < n; ++v) append(moved, nearby(v));
        return moved;
    }
    Points many(std::size_t count, Points (Context::*one)()) {
        Points made;
        for (std::size_t i = 0; i < count; ++i) append(made, (this->*one)());
        return made;
    }
    /// The box of all vertices, wider by a share on every side, as low and high; it is no slab, however flat the set.
    std::pair<Points, Points> box(double share) const {
        Points low = low_, high = high_;
        double widest = 0;
        for (unsigned k = 0; k < dimension; ++k) widest = std::max(widest, high[k] - low[k]);
        for (unsigned k = 0; k < dimension; ++k) {
            const double middle = (low[k] + high[k]) / 2;
            const double half = std::max((0.5 + share) * (high[k] - low[k]), 0.1 * widest);
            low[k] = middle - half, high[k] = middle + half;
        }
        return {low, high};
    }

    static void append(Points &to, const Points &more) { to.insert(to.end(), more.begin(), more.end()); }

private:
    /// The least and the greatest coordinates.
    Points low_, high_;

    Points around(std::size_t vertex, double share) {
        Points p(place(vertex), place(vertex) + dimension);
        for (double &x : p) x += share * spacing[vertex] * random.sign();
        return p;
    }
    void find_spacing() {
        const deldrift_cells_view cells = view();
        spacing.assign(n, cells.count > 0 ? std::numeric_limits<double>::max() : 1.0 / double(n));
        for (std::size_t i = 0; i < cells.count * corners(); ++i)
            for (std::size_t j = i / corners() * corners(); j < i; ++j) {
                const std::uint32_t a = cells.vertices[i], b = cells.vertices[j];
                double length = 0;
                for (unsigned k = 0; k < dimension; ++k)
                    length = std::max(length, std::abs(place(a)[k] - place(b)[k]));
                spacing[a] = std::min(spacing[a], length);
                spacing[b] = std::min(spacing[b], length);
            }
        for (double &edge : spacing)
            if (edge == std::numeric_limits<double>::max()) edge = 0;
    }
};

/// A row of the table: a function, what it is called for, and how.
struct Call {
    const char *function;
    const char *what;
    /// Does and times it; whatever is not to be timed is outside of meter.time.
    void (*run)(Context &);
    /// The dimensions that have it: 2, 3, or 0 for both.
    unsigned dimension = 0;
};

/// By the files of these names.
std::vector<Call> changing_calls();
std::vector<Call> reading_calls();
std::vector<Call> geometry_calls();
std::vector<Call> segment_calls();
std::vector<Call> file_calls();

}  // namespace costs
