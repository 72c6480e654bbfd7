// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_statistics.hpp"

#include "csv.hpp"
#include "report_tolerance.hpp"
#include "table.hpp"

#include <deldrift/research.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <stdexcept>

namespace bench {
namespace {

constexpr std::size_t n_bins = 50;

void require(deldrift_status status) {
    if (status != DELDRIFT_OK) throw std::runtime_error(deldrift_last_error());
}

struct Destroy {
    void operator()(deldrift_triangulation *t) const { deldrift_destroy(t); }
};

/// The triangulation of one frame, with the widths of its bi-cells and the tolerances of its vertices.
class Measured {
public:
    Measured(const Series &series, std::size_t timestamp) : series_(series), timestamp_(timestamp) {
        deldrift_triangulation *t = nullptr;
        require(deldrift_create(series.dimension, series.frame(timestamp), series.n_points, nullptr, &t));
        t_.reset(t);
        require(deldrift_cells(t, &cells_));
        std::size_t count = 0;
        std::vector<double> all(cells_.count * cells_.corners_per_cell);
        require(deldrift_research_annulus_widths(t, all.data(), all.size(), &count));
        tolerances_.assign(series.n_points, std::numeric_limits<double>::infinity());
        widest_.assign(series.n_points, 0);
        is_uncertain_.assign(series.n_points, 0);
        double greatest = 0;
        for (std::size_t i = 0; i < series.frame_length(); ++i)
            greatest = std::max(greatest, std::fabs(series.frame(timestamp)[i]));
        bound_ = CoordinateBound(greatest);
        for (std::size_t cell = 0; cell < cells_.count; ++cell)
            for (unsigned corner = 0; corner < cells_.corners_per_cell; ++corner)
                take(cell, corner, all[cell * cells_.corners_per_cell + corner]);
    }

    const deldrift_cells_view &cells() const { return cells_; }

    /// Of every bi-cell once.
    const std::vector<double> &widths() const { return widths_; }

    /// Half the least width among a vertex's bi-cells: the report's tolerance.
    const std::vector<double> &tolerances() const { return tolerances_; }

    /// The greatest width among a vertex's bi-cells.
    const std::vector<double> &widest() const { return widest_; }

    double mean_certified_tolerance() const {
        double sum = 0;
        for (std::size_t id = 0; id < series_.n_points; ++id) {
            double tolerance = 0;
            require(deldrift_tolerance(t_.get(), static_cast<std::uint32_t>(id), &tolerance));
            sum += tolerance;
        }
        return sum / static_cast<double>(series_.n_points);
    }

    /// The share of vertices with a bi-cell of which the report's filters certify nothing.
    double share_uncertain() const {
        return static_cast<double>(std::count(is_uncertain_.begin(), is_uncertain_.end(), 1)) /
               static_cast<double>(series_.n_points);
    }

    double bicells_per_vertex() const {
        return static_cast<double>(n_memberships_) / static_cast<double>(series_.n_points);
    }

private:
    void take(std::size_t cell, unsigned corner, double width) {
        if (std::isnan(width)) return;
        const std::uint32_t *vertices = cells_.vertices + cell * cells_.corners_per_cell;
        // From either side come the facet's vertices and one of those opposite it.
        for (unsigned i = 0; i < cells_.corners_per_cell; ++i) {
            tolerances_[vertices[i]] = std::min(tolerances_[vertices[i]], width / 2);
            widest_[vertices[i]] = std::max(widest_[vertices[i]], width);
        }
        const std::uint32_t other = cells_.neighbours[cell * cells_.corners_per_cell + corner];
        if (cell < other) {
            widths_.push_back(width);
            n_memberships_ += cells_.corners_per_cell + 1;
            if (series_.dimension == 2)
                examine<2>(vertices, corner, opposite(other, static_cast<std::uint32_t>(cell)));
            else
                examine<3>(vertices, corner, opposite(other, static_cast<std::uint32_t>(cell)));
        }
    }

    /// The vertex of a cell that is opposite its neighbour.
    std::uint32_t opposite(std::uint32_t cell, std::uint32_t neighbour) const {
        const std::uint32_t *neighbours = cells_.neighbours + std::size_t{cell} * cells_.corners_per_cell;
        const auto corner =
            std::find(neighbours, neighbours + cells_.corners_per_cell, neighbour) - neighbours;
        return cells_
            .vertices[std::size_t{cell} * cells_.corners_per_cell + static_cast<std::size_t>(corner)];
    }

    template <unsigned dimension>
    void examine(const std::uint32_t *vertices, unsigned corner, std::uint32_t other) {
        const auto place = [&](std::uint32_t id) {
            Place<dimension> p{};
            const double *coordinates = series_.frame(timestamp_) + std::size_t{id} * dimension;
            std::copy(coordinates, coordinates + dimension, p.begin());
            return p;
        };
        BicellPoints<dimension> bicell{};
        unsigned n = 0;
        for (unsigned i = 0; i <= dimension; ++i)
            if (i != corner) bicell.facet[n++] = place(vertices[i]);
        bicell.opposing = {place(vertices[corner]), place(other)};
        if (squared_half_annulus_width<dimension>(bicell, bound_) > 0) return;
        for (unsigned i = 0; i <= dimension; ++i) is_uncertain_[vertices[i]] = 1;
        is_uncertain_[other] = 1;
    }

    const Series &series_;
    std::size_t timestamp_;
    std::unique_ptr<deldrift_triangulation, Destroy> t_;
    deldrift_cells_view cells_{};
    std::vector<double> widths_;
    std::vector<double> tolerances_;
    std::vector<double> widest_;
    std::size_t n_memberships_ = 0;
    std::vector<char> is_uncertain_;
    CoordinateBound bound_;
};

double mean(const std::vector<double> &values) {
    double sum = 0;
    std::size_t n = 0;
    for (const double value : values)
        if (std::isfinite(value)) {
            sum += value;
            ++n;
        }
    return n == 0 ? 0 : sum / static_cast<double>(n);
}

double displacement(const Series &series, std::size_t timestamp, std::size_t id) {
    const double *from = series.frame(timestamp - 1) + id * series.dimension;
    const double *to = series.frame(timestamp) + id * series.dimension;
    double sum = 0;
    for (unsigned axis = 0; axis < series.dimension; ++axis)
        sum += (to[axis] - from[axis]) * (to[axis] - from[axis]);
    return std::sqrt(sum);
}

/// 0, then about ten for every factor of ten, up to the last but one (the displacement to the next belongs to
/// it) and the last.
std::vector<std::size_t> statistics_timestamps(const Series &series) {
    if (!series.segments.empty()) return {0};
    std::set<std::size_t> timestamps = {0, 1, 10, 100, series.n_timestamps()};
    for (double at = 1; at < static_cast<double>(series.n_timestamps()); at *= 1.26)
        timestamps.insert(static_cast<std::size_t>(at));
    timestamps.erase(timestamps.upper_bound(series.n_timestamps()), timestamps.end());
    return {timestamps.begin(), timestamps.end()};
}

/// The iterations whose points and distributions the report shows; the last one where there are fewer.
std::vector<std::size_t> shown_timestamps(const Series &series) {
    if (!series.segments.empty()) return {0};
    std::set<std::size_t> timestamps = {0, 1, 10, 100, std::min<std::size_t>(1000, series.n_timestamps())};
    timestamps.erase(timestamps.upper_bound(series.n_timestamps()), timestamps.end());
    return {timestamps.begin(), timestamps.end()};
}

/// The plane that is nearest to the points at the beginning, in squares: through their mean, orthogonal to
/// the axis of inertia along which they vary least.
class Section {
public:
    explicit Section(const Series &series) {
        for (std::size_t id = 0; id < series.n_points; ++id)
            mean_ = mean_ + (1 / static_cast<double>(series.n_points)) * vector(series.frame(0) + 3 * id);
        Matrix m{};
        for (std::size_t id = 0; id < series.n_points; ++id) {
            const Vector3 p = vector(series.frame(0) + 3 * id) - mean_;
            for (int i = 0; i < 3; ++i) m[i] = m[i] + p[i] * p;
        }
        // Powers of the matrix, and of the rest of it, turn anything to the axes of the greatest inertia.
        up_ = greatest_axis(m, {0.1, 0.2, 1});
        if (up_[2] < 0) up_ = -1 * up_;
        const Vector3 side = greatest_axis(m, cross(up_, {0.1, 1, 0.1}));
        right_ = side[0] < 0 ? -1 * side : side;
        normal_ = cross(right_, up_);
    }

    /// To the right and upwards in the plane, and away from it.
    Vector3 place(const Vector3 &p) const {
        const Vector3 q = p - mean_;
        return {dot(q, right_), dot(q, up_), dot(q, normal_)};
    }

private:
    using Matrix = std::array<Vector3, 3>;

    /// Orthogonal to `up_`, as far as that is known.
    Vector3 greatest_axis(const Matrix &m, Vector3 axis) const {
        for (int i = 0; i < 200; ++i) {
            axis = axis - dot(axis, up_) * up_;
            axis = {dot(m[0], axis), dot(m[1], axis), dot(m[2], axis)};
            axis = (1 / std::sqrt(dot(axis, axis))) * axis;
        }
        return axis;
    }

    Vector3 mean_{}, up_{}, right_{}, normal_{};
};

class Writer {
public:
    Writer(const ReportInput &input, const std::string &results)
        : series_(input.series),
          body_(input.body),
          statistics_(results + "/report_statistics.csv",
                      {"scenario", "timestamp", "n", "mean_width", "mean_tolerance",
                       "mean_certified_tolerance", "mean_widest", "bicells_per_vertex", "mean_displacement",
                       "share_within_tolerance", "share_uncertain", "remark"}),
          segments_(results + "/report_segments.csv",
                    {"scenario", "first_timestamp", "last_timestamp", "displacement",
                     "displacement_per_tolerance", "share_within_tolerance"}),
          distributions_(results + "/report_distributions.csv",
                         {"scenario", "timestamp", "quantity", "from", "to", "share"}),
          points_(results + "/report_points.csv", {"scenario", "timestamp", "x", "y"}),
          sections_(results + "/report_sections.csv", {"scenario", "timestamp", "radius_ratio", "polygon"}) {}

    void run(Progress &progress) {
        if (statistics_.has({series_.name})) return;
        const std::vector<std::size_t> timestamps = statistics_timestamps(series_);
        const std::vector<std::size_t> shown = shown_timestamps(series_);
        progress.begin(series_.name + ": widths and tolerances", timestamps.size());
        for (const std::size_t timestamp : timestamps) {
            const Measured measured(series_, timestamp);
            add_statistics(measured, timestamp);
            if (std::binary_search(shown.begin(), shown.end(), timestamp)) show(measured, timestamp);
            if (!series_.segments.empty()) add_segments(measured);
            progress.step();
        }
        for (const CsvFile *file : {&distributions_, &points_, &sections_, &segments_, &statistics_})
            file->save();
    }

private:
    static std::string text(double value) { return significant(value, 6); }

    void add_statistics(const Measured &measured, std::size_t timestamp) {
        std::string displacement_text, share_text;
        if (series_.segments.empty() && timestamp < series_.n_timestamps()) {
            double sum = 0;
            std::size_t n_within = 0;
            for (std::size_t id = 0; id < series_.n_points; ++id) {
                const double length = displacement(series_, timestamp + 1, id);
                sum += length;
                n_within += length < measured.tolerances()[id];
            }
            displacement_text = text(sum / static_cast<double>(series_.n_points));
            share_text = text(static_cast<double>(n_within) / static_cast<double>(series_.n_points));
        }
        statistics_.add(line_of(series_.name, timestamp, series_.n_points, text(mean(measured.widths())),
                                text(mean(measured.tolerances())), text(measured.mean_certified_tolerance()),
                                text(mean(measured.widest())), text(measured.bicells_per_vertex()), displacement_text,
                                share_text, text(measured.share_uncertain()), series_.remark));
    }

    /// All segments begin at the frame that was measured.
    void add_segments(const Measured &measured) {
        const double average = mean(measured.tolerances());
        for (const Segment &segment : series_.segments) {
            std::size_t n_within = 0;
            for (const double tolerance : measured.tolerances()) n_within += segment.displacement < tolerance;
            segments_.add(line_of(series_.name, segment.first, segment.last, text(segment.displacement),
                                  text(segment.displacement / average),
                                  text(static_cast<double>(n_within) / static_cast<double>(series_.n_points))));
        }
    }

    void show(const Measured &measured, std::size_t timestamp) {
        add_distribution(timestamp, "width", measured.widths(), 1.0);
        add_distribution(timestamp, "tolerance", measured.tolerances(), series_.dimension == 2 ? 0.25 : 0.1);
        if (series_.dimension == 2 && series_.segments.empty()) add_points(timestamp);
        if (body_) add_section(measured, timestamp);
    }

    /// Shares of equal bins from 0 on; the last one has all that is above as well.
    void add_distribution(std::size_t timestamp, const std::string &quantity,
                          const std::vector<double> &values, double end) {
        std::vector<std::size_t> counts(n_bins, 0);
        std::size_t n = 0;
        for (const double value : values) {
            if (!std::isfinite(value)) continue;
            ++counts[std::min(n_bins - 1, static_cast<std::size_t>(value / end * n_bins))];
            ++n;
        }
        for (std::size_t bin = 0; bin < n_bins; ++bin)
            distributions_.add(line_of(series_.name, timestamp, quantity, text(end * static_cast<double>(bin) / n_bins),
                                       text(end * static_cast<double>(bin + 1) / n_bins),
                                       text(static_cast<double>(counts[bin]) / static_cast<double>(n))));
    }

    void add_points(std::size_t timestamp) {
        for (std::size_t id = 0; id < series_.n_points; ++id) {
            const double *p = series_.frame(timestamp) + 2 * id;
            points_.add(line_of(series_.name, timestamp, significant(p[0], 5), significant(p[1], 5)));
        }
    }

    /// What the plane cuts of the cells that have their centre in the body.
    void add_section(const Measured &measured, std::size_t timestamp) {
        const deldrift_cells_view &cells = measured.cells();
        const Section section(series_);
        for (std::size_t cell = 0; cell < cells.count; ++cell) {
            std::array<Vector3, 4> corner;
            for (unsigned i = 0; i < 4; ++i)
                corner[i] = vector(series_.frame(timestamp) + 3 * std::size_t{cells.vertices[4 * cell + i]});
            const Vector3 centre = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]);
            for (Vector3 &p : corner) p = section.place(p);
            const std::vector<Vector3> polygon = cut(corner);
            if (polygon.size() < 3) continue;
            if (!body_->contains(centre.data())) continue;
            std::string text;
            for (const Vector3 &p : polygon)
                text += (text.empty() ? "" : " ") + significant(p[0], 4) + " " + significant(p[1], 4);
            sections_.add(line_of(series_.name, timestamp, significant(radius_ratio(corner), 3), text));
        }
    }

    static std::vector<Vector3> cut(const std::array<Vector3, 4> &corner) {
        std::vector<Vector3> below, above, polygon;
        for (const Vector3 &p : corner) (p[2] < 0 ? below : above).push_back(p);
        for (const Vector3 &a : below)
            for (const Vector3 &b : above) polygon.push_back(a + (a[2] / (a[2] - b[2])) * (b - a));
        // Two and two: the crossings of a quadrilateral, in order around it.
        if (polygon.size() == 4) std::swap(polygon[2], polygon[3]);
        return polygon;
    }

    /// Three times the inscribed over the circumscribed radius: 1 for a regular tetrahedron, 0 for a flat
    /// one.
    static double radius_ratio(const std::array<Vector3, 4> &p) {
        const Vector3 b = p[1] - p[0], c = p[2] - p[0], d = p[3] - p[0];
        const double sixfold = std::fabs(dot(b, cross(c, d)));
        const auto norm = [](const Vector3 &v) { return std::sqrt(dot(v, v)); };
        const double areas =
            norm(cross(b, c)) + norm(cross(c, d)) + norm(cross(d, b)) + norm(cross(c - b, d - b));
        const double circumradius = norm(weighted_circumcentre(b, c, d)) / (2 * sixfold);
        return sixfold == 0 ? 0 : 3 * (sixfold / areas) / circumradius;
    }

    const Series &series_;
    const std::optional<Body> &body_;
    CsvFile statistics_;
    CsvFile segments_;
    CsvFile distributions_;
    CsvFile points_;
    CsvFile sections_;
};

}  // namespace

double mean_tolerance(const Series &series, std::size_t timestamp) {
    return mean(Measured(series, timestamp).tolerances());
}

void write_report_statistics(const ReportInput &input, const std::string &results, Progress &progress) {
    Writer(input, results).run(progress);
}

}  // namespace bench
