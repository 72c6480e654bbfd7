// The quality of cells that refinement works towards, and what it has made: see deldrift.hpp, which includes this.
#ifndef DELDRIFT_REFINING_HPP
#define DELDRIFT_REFINING_HPP

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "span.hpp"

namespace deldrift {

// The corners of a cell of the plane, counter-clockwise.
using Corners = std::array<std::array<double, 2>, 3>;

class Triangulation;

// What Triangulation::refine and coarsen work towards, and how; deldrift_quality describes each. Without a criterion
// nothing is done.
//     deldrift::Quality quality;
//     quality.least_angle = 30;
//     quality.is_too_large = [](const deldrift::Corners &corners) { return corners[0][0] < 1 && is_wide(corners); };
//     t.refine(quality);
class Quality {
public:
    double least_angle = 0, greatest_area = 0;
    // For each cell, as label_cells() gives them; none for those of regions().
    std::vector<std::int32_t> labels{};
    // By label.
    std::vector<double> areas{};
    // By vertex id; refined_sizes() gives those of refined_vertices(), which are to be appended unless ids are reused.
    std::vector<double> sizes{};
    // What it throws comes out of refine() or coarsen(), which has had no effect then.
    std::function<bool(const Corners &)> is_too_large{};
    deldrift_kept keeps = DELDRIFT_KEPT_NONE;
    // Which cells are refined without a mask.
    deldrift_domain domain = DELDRIFT_DOMAIN_NESTING;
    // Whether refined_weights() and carry() are to know the vertices that refine() inserts.
    bool has_weights = false;
    // Whether segments are split until all cells are Delaunay, segments or not.
    bool is_conforming = false;
    // Whether refine() gives its vertices free ids: refined_vertices() tells which.
    bool reuses_ids = false;
    std::size_t limit;
    double margin, share, joins, growth;

    Quality() : Quality(defaults()) {}

private:
    explicit Quality(const deldrift_quality &given) noexcept
        : limit(given.limit), margin(given.margin), share(given.share), joins(given.joins), growth(given.growth) {}
    static deldrift_quality defaults() noexcept {
        deldrift_quality quality;
        deldrift_quality_init(&quality);
        return quality;
    }
};

// The vertices that refinement has inserted, and the original segment that each was put on, DELDRIFT_NONE if there is
// none; see deldrift_made_vertices.
struct MadeVertices {
    std::vector<std::uint32_t> vertices{};
    std::vector<std::uint32_t> segments{};
    std::size_t size() const noexcept { return vertices.size(); }
    bool empty() const noexcept { return vertices.empty(); }
};

// The vertices that the last refinement inserted, ascending, and for each three others and their weights; see
// deldrift_refined_weights.
struct RefinedWeights {
    std::vector<std::uint32_t> ids{};
    std::vector<std::array<std::uint32_t, 3>> vertices{};
    std::vector<std::array<double, 3>> weights{};
    std::size_t size() const noexcept { return vertices.size(); }
    bool empty() const noexcept { return vertices.empty(); }

    // Enters into values, n_values numbers for each id before, those of the vertices that came.
    void carry(std::vector<double> &values, std::size_t n_values) const {
        if (empty()) return;
        values.resize((std::max)(values.size(), (ids.back() + std::size_t{1}) * n_values));
        for (std::size_t k = 0; k < size(); k++) {
            for (std::size_t j = 0; j < n_values; j++) {
                double sum = 0;
                for (std::size_t i = 0; i < 3; i++) sum += weights[k][i] * values[vertices[k][i] * n_values + j];
                values[ids[k] * n_values + j] = sum;
            }
        }
    }
};

namespace detail {

// Gives the entries of an array by id, as many for each, their places by new ids, which ascend.
template <class T>
void renumber(std::vector<T> &values, const std::vector<std::uint32_t> &new_ids) {
    const std::size_t n_each = new_ids.empty() ? 0 : values.size() / new_ids.size();
    std::size_t n = 0;
    for (std::size_t k = 0; k < values.size(); k++) {
        if (new_ids[k / n_each] != DELDRIFT_NONE) values[n++] = values[k];
    }
    values.resize(n);
}

// A quality as C reads it, and the exception that its function has thrown.
class GivenQuality {
    friend Triangulation;

    explicit GivenQuality(const Quality &quality) : quality_(quality) {
        deldrift_quality_init(&given_);
        given_.least_angle = quality.least_angle;
        given_.greatest_area = quality.greatest_area;
        given_.labels = begin_of(quality.labels);
        given_.label_count = quality.labels.size();
        given_.areas = begin_of(quality.areas);
        given_.area_count = quality.areas.size();
        given_.sizes = begin_of(quality.sizes);
        given_.size_count = quality.sizes.size();
        given_.keeps = quality.keeps;
        given_.domain = quality.domain;
        given_.has_weights = quality.has_weights ? 1 : 0;
        given_.is_conforming = quality.is_conforming ? 1 : 0;
        given_.limit = quality.limit;
        given_.margin = quality.margin;
        given_.share = quality.share;
        given_.joins = quality.joins;
        given_.growth = quality.growth;
        given_.reuses_ids = quality.reuses_ids ? 1 : 0;
        if (quality_.is_too_large) {
            given_.is_too_large = ask;
            given_.user_data = this;
        }
    }
    const deldrift_quality *get() const noexcept { return &given_; }
    // What the function has thrown comes out of it.
    void throw_again() const {
        if (thrown_ != nullptr) std::rethrow_exception(thrown_);
    }
    // NULL for none, also where there is room for some.
    template <class T>
    static const T *begin_of(const std::vector<T> &values) noexcept {
        return values.empty() ? nullptr : values.data();
    }
    static int ask(void *self, const double *corners) noexcept {
        GivenQuality &given = *static_cast<GivenQuality *>(self);
        try {
            const double *c = corners;
            return given.quality_.is_too_large({{{c[0], c[1]}, {c[2], c[3]}, {c[4], c[5]}}}) ? 1 : 0;
        } catch (...) {
            given.thrown_ = std::current_exception();
            return -1;
        }
    }

    GivenQuality(const GivenQuality &) = delete;
    GivenQuality &operator=(const GivenQuality &) = delete;

    const Quality &quality_;
    deldrift_quality given_{};
    std::exception_ptr thrown_{};
};

}  // namespace detail

}  // namespace deldrift

#endif  // DELDRIFT_REFINING_HPP
