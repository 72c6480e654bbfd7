// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes.hpp"

#include "cgal_space.hpp"
#include "library.hpp"
#include "replay.hpp"
#include "table.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesher_2.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace bench {
namespace {

constexpr double pi = 3.14159265358979323846;

/// CGAL's default: the squared sine of the least angle is 1/8.
const double angle_of_cgal = std::asin(std::sqrt(0.125)) * 180 / pi;
constexpr double larger_angle = 30;
/// Between the two, and with room for deldrift's margin of coarsening.
constexpr double moving_angle = 25;
/// What issue 47 asks of coarsening and refining a moving mesh, beside meshing anew.
constexpr double wanted_of_steps = 10;
/// By how much of the greatest length the ends of the hole go in a step.
constexpr double step_share = 0.05;
constexpr double half_length_of_hole = 0.5;

class CgalMesher {
    using Vertex = CGAL::Triangulation_vertex_base_2<CgalKernel>;
    using Face = CGAL::Delaunay_mesh_face_base_2<CgalKernel>;
    using Triangulation =
        CGAL::Constrained_Delaunay_triangulation_2<CgalKernel, CGAL::Triangulation_data_structure_2<Vertex, Face>>;
    using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;

public:
    explicit CgalMesher(const Outline &outline) {
        for (std::size_t k = 0; k < outline.n_points(); ++k)
            points_.emplace_back(outline.points[2 * k], outline.points[2 * k + 1]);
        for (const auto &place : outline.holes) holes_.emplace_back(place[0], place[1]);
        segments_ = outline.segments;
    }

    void mesh(const Quality &quality) {
        std::vector<Triangulation::Vertex_handle> vertices;
        for (const auto &point : points_) vertices.push_back(triangulation_.insert(point));
        for (const auto &[a, b] : segments_) triangulation_.insert_constraint(vertices[a], vertices[b]);
        const double sine = std::sin(quality.least_angle * pi / 180);
        CGAL::Delaunay_mesher_2<Triangulation, Criteria> mesher(triangulation_,
                                                                Criteria(sine * sine, quality.greatest_length));
        mesher.set_seeds(holes_.begin(), holes_.end());
        mesher.refine_mesh();
    }

    Mesh found() const {
        Mesh mesh;
        for (const auto face : triangulation_.finite_face_handles()) {
            if (!face->is_in_domain()) continue;
            double p[3][2];
            for (int i = 0; i < 3; ++i)
                for (int axis = 0; axis < 2; ++axis) p[i][axis] = face->vertex(i)->point()[axis];
            mesh.add({p[0], p[1], p[2]});
        }
        return mesh;
    }

private:
    std::vector<CgalKernel::Point_2> points_, holes_;
    std::vector<std::array<std::uint32_t, 2>> segments_;
    Triangulation triangulation_;
};

/// deldrift's mesh of an outline. The cells of the domain are those of odd nesting levels, which needs no seeds.
class DeldriftMesher {
public:
    explicit DeldriftMesher(const Outline &outline) : outline_(outline) {}

    void mesh(const Quality &quality) {
        quality_ = quality;
        deldrift_options options;
        deldrift_options_init(&options);
        options.threads = 1;
        deldrift_triangulation *t = nullptr;
        require(deldrift_create(2, outline_.points.data(), outline_.n_points(), &options, &t), "deldrift_create");
        t_.reset(t);
        std::uint32_t first = 0;
        require(deldrift_stage_segments(t, outline_.segments.front().data(), nullptr, outline_.segments.size(), &first),
                "deldrift_stage_segments");
        require(deldrift_commit_timestamp(t, nullptr), "deldrift_commit_timestamp");
        refine();
        require(deldrift_cells(t, &view_), "deldrift_cells");
    }
    void commit(const std::vector<double> &positions) {
        require(deldrift_commit_positions(t_.get(), positions.data(), positions.size() / 2, nullptr),
                "deldrift_commit_positions");
    }
    void coarsen() { require(deldrift_coarsen(t_.get(), quality(), nullptr, 0, nullptr), "deldrift_coarsen"); }
    void refine() { require(deldrift_refine(t_.get(), quality(), nullptr, 0, nullptr), "deldrift_refine"); }
    void read() { require(deldrift_cells(t_.get(), &view_), "deldrift_cells"); }
    /// Ids of vertices that coarsening has removed are used again once they are as many as the others.
    void compact() {
        if (2 * count_of(deldrift_vertex_count) > count_of(deldrift_id_count)) return;
        std::size_t count = 0;
        require(deldrift_compact(t_.get(), nullptr, 0, &count), "deldrift_compact");
    }

    std::vector<double> positions() const {
        std::size_t count = count_of(deldrift_id_count);
        std::vector<double> positions(2 * count);
        require(deldrift_copy_positions(t_.get(), positions.data(), count, &count), "deldrift_copy_positions");
        return positions;
    }

    Mesh found() {
        read();
        Mesh mesh;
        std::vector<std::uint32_t> levels(view_.count);
        std::size_t count = 0;
        require(deldrift_nesting_levels(t_.get(), levels.data(), levels.size(), &count), "deldrift_nesting_levels");
        const std::vector<double> at = positions();
        for (std::size_t c = 0; c < view_.count; ++c) {
            const std::uint32_t *v = view_.vertices + 3 * c;
            if (levels[c] % 2 == 1) mesh.add({&at[2 * v[0]], &at[2 * v[1]], &at[2 * v[2]]});
        }
        return mesh;
    }

private:
    struct Destroy {
        void operator()(deldrift_triangulation *t) const noexcept { deldrift_destroy(t); }
    };

    std::size_t count_of(deldrift_status (*ask)(const deldrift_triangulation *, std::size_t *)) const {
        std::size_t count = 0;
        require(ask(t_.get(), &count), "a count");
        return count;
    }
    /// One size at all vertices is a bound on lengths.
    const deldrift_quality *quality() {
        deldrift_quality_init(&wanted_);
        sizes_.resize(count_of(deldrift_id_count), quality_.greatest_length);
        wanted_.least_angle = quality_.least_angle;
        wanted_.sizes = sizes_.data();
        wanted_.size_count = sizes_.size();
        return &wanted_;
    }

    const Outline &outline_;
    Quality quality_{};
    deldrift_quality wanted_{};
    std::vector<double> sizes_;
    deldrift_cells_view view_{};
    std::unique_ptr<deldrift_triangulation, Destroy> t_;
};

template <typename Call>
double seconds_of(Call call) {
    const Stopwatch watch;
    call();
    return watch.seconds();
}

/// What was asked for, but for angles, which small angles of the outline may stand against.
void check(const char *engine, const Outline &outline, const Quality &quality, const Mesh &mesh) {
    const double area = area_of(outline);
    if (std::fabs(mesh.area - area) > 1e-10 || mesh.greatest_length > quality.greatest_length * (1 + 1e-12))
        throw std::runtime_error(fmt::format("{} of {}, {}: the area is {}, not {}, and an edge {} long, of at most {}",
                                             engine, outline.name, quality.least_angle, mesh.area, area,
                                             mesh.greatest_length, quality.greatest_length));
}

/// Times of both sides, turn for turn.
struct Turns {
    std::vector<double> reference, contender, ratios;

    void add(double reference_seconds, double contender_seconds) {
        reference.push_back(reference_seconds);
        contender.push_back(contender_seconds);
        ratios.push_back(reference_seconds / contender_seconds);
    }
    MeshLine line(const Outline &outline, const Quality &quality, const char *timed, const Mesh &theirs,
                  const Mesh &ours, double wanted) const {
        return {outline.name,      quality,           timed,          theirs, ours, median(reference),
                median(contender), median(ratios),    wanted};
    }
};

MeshLine mesh_from_nothing(const Outline &outline, const Quality &quality, std::size_t n_turns, Progress &progress) {
    Turns turns;
    Mesh theirs, ours;
    for (std::size_t turn = 0; turn < n_turns; ++turn) {
        CgalMesher cgal(outline);
        DeldriftMesher deldrift(outline);
        const double reference = seconds_of([&] { cgal.mesh(quality); });
        turns.add(reference, seconds_of([&] { deldrift.mesh(quality); }));
        theirs = cgal.found();
        ours = deldrift.found();
        progress.step();
    }
    check("CGAL", outline, quality, theirs);
    check("deldrift", outline, quality, ours);
    return turns.line(outline, quality, "from nothing", theirs, ours, 0);
}

/// A step of the loop (move, commit, coarsen, refine, read) beside meshing what has moved anew.
void mesh_moving(const Quality &quality, const MeshEfforts &efforts, Progress &progress, std::vector<MeshLine> &lines) {
    Outline outline = stirrer();
    DeldriftMesher deldrift(outline);
    deldrift.mesh(quality);
    Turns whole, mending;
    Mesh theirs, ours;
    const double angle = step_share * quality.greatest_length / half_length_of_hole;
    for (std::size_t step = 0; step < efforts.n_steps + efforts.n_measured; ++step) {
        std::vector<double> positions = deldrift.positions();
        stir(angle, positions);
        stir(angle, outline.points);
        const double commit = seconds_of([&] { deldrift.commit(positions); });
        const double mend = seconds_of([&] {
            deldrift.coarsen();
            deldrift.refine();
        });
        const double read = seconds_of([&] {
            deldrift.read();
            deldrift.compact();
        });
        progress.step();
        if (step < efforts.n_steps) continue;
        CgalMesher cgal(outline);
        const double anew = seconds_of([&] { cgal.mesh(quality); });
        whole.add(anew, commit + mend + read);
        mending.add(anew, mend);
        theirs = cgal.found();
        ours = deldrift.found();
        check("CGAL", outline, quality, theirs);
        check("deldrift", outline, quality, ours);
    }
    lines.push_back(whole.line(outline, quality, "step", theirs, ours, 0));
    lines.push_back(mending.line(outline, quality, "coarsen and refine", theirs, ours, wanted_of_steps));
}

MeshEfforts efforts_of(const Preset &preset) {
    if (preset.name == "smoke") return {1, 2, 1, {0.1}};
    return {5, 200, 15, {0.1, 0.03, 0.01}};
}

}  // namespace

void Mesh::add(const std::array<const double *, 3> &corners) {
    n_cells++;
    for (std::size_t i = 0; i < 3; ++i) {
        const double *o = corners[i], *a = corners[(i + 1) % 3], *b = corners[(i + 2) % 3];
        const double u[2] = {a[0] - o[0], a[1] - o[1]}, w[2] = {b[0] - o[0], b[1] - o[1]};
        const double cross = u[0] * w[1] - u[1] * w[0];
        least_angle = std::min(least_angle, std::atan2(cross, u[0] * w[0] + u[1] * w[1]) * 180 / pi);
        greatest_length = std::max(greatest_length, std::hypot(u[0], u[1]));
        if (i == 0) area += cross / 2;
    }
}

std::vector<MeshLine> measure_meshes(const MeshEfforts &efforts, Progress &progress) {
    std::vector<MeshLine> lines;
    for (const Outline &outline : outlines()) {
        progress.begin(outline.name, 2 * efforts.lengths.size() * efforts.n_turns);
        for (const double angle : {angle_of_cgal, larger_angle})
            for (const double length : efforts.lengths)
                lines.push_back(mesh_from_nothing(outline, {angle, length}, efforts.n_turns, progress));
    }
    progress.begin("stirrer", efforts.lengths.size() * (efforts.n_steps + efforts.n_measured));
    for (const double length : efforts.lengths) mesh_moving({moving_angle, length}, efforts, progress, lines);
    return lines;
}

void run_meshes(const Options &options) {
    keep_memory();
    Progress progress;
    std::vector<std::vector<std::string>> rows = {{"domain", "angle", "length", "timed", "cgal_cells", "cgal_angle",
                                                   "cgal_seconds", "cgal_ns_per_cell", "cells", "least_angle", "seconds",
                                                   "ns_per_cell", "ratio", "wanted", "verdict"}};
    const auto ns = [](double seconds, const Mesh &mesh) { return 1e9 * seconds / static_cast<double>(mesh.n_cells); };
    for (const MeshLine &line : measure_meshes(efforts_of(options.preset), progress))
        rows.push_back(line_of(
            line.domain, significant(line.quality.least_angle, 4), line.quality.greatest_length, line.timed,
            line.reference.n_cells, significant(line.reference.least_angle, 4), significant(line.reference_seconds, 4),
            significant(ns(line.reference_seconds, line.reference), 4), line.contender.n_cells,
            significant(line.contender.least_angle, 4), significant(line.contender_seconds, 4),
            significant(ns(line.contender_seconds, line.contender), 4), significant(line.ratio, 3),
            line.wanted == 0 ? "" : significant(line.wanted, 3),
            line.wanted == 0 ? "" : line.ratio >= line.wanted ? "pass" : "missed"));
    publish(options.results, "meshes.csv", rows);
}

}  // namespace bench
