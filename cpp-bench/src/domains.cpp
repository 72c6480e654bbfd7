// SPDX-License-Identifier: GPL-3.0-or-later
#include "domains.hpp"

#include "cells.hpp"
#include "cgal_space.hpp"
#include "library.hpp"
#include "random.hpp"
#include "replay.hpp"
#include "table.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <numeric>
#include <stdexcept>

namespace bench {
namespace {

constexpr double wanted_of_builds = 2;
constexpr double wanted_of_steps = 15;
constexpr double wanted_at_rest = 1 / 1.2;
constexpr double wanted_of_checks = 1;
constexpr double wanted_of_passings = 1;
constexpr double wanted_of_moves = 1;

constexpr double step_length = 1e-3;
/// In so many timestamps DELDRIFT_AUTO has found out how vertices move.
constexpr std::size_t n_warm = 3;

/// CGAL, rebuilt at each timestamp: the points as by its bulk insertion, then one constraint after another.
class CgalDomain {
    using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, CgalKernel>;
    using FaceBase = CGAL::Constrained_triangulation_face_base_2<CgalKernel>;
    using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
    using Space = SpaceOf<2, CGAL::Constrained_Delaunay_triangulation_2<CgalKernel, Structure>>;

public:
    explicit CgalDomain(const Domain &domain) : domain_(domain), vertices_(domain.n_points()) {}

    /// Off the clock.
    void prepare(const std::vector<double> &positions) {
        input_.clear();
        for (std::uint32_t id = 0; id < domain_.n_points(); ++id)
            input_.emplace_back(Space::point(&positions[std::size_t{id} * 2]), VertexInfo{id, 1});
    }
    void build() {
        triangulation_.clear();
        insert_sorted<Space>(triangulation_, input_);
        for (auto v = triangulation_.finite_vertices_begin(); v != triangulation_.finite_vertices_end(); ++v)
            vertices_[v->info().id] = v;
        for (const auto &[a, b] : domain_.segments) triangulation_.insert_constraint(vertices_[a], vertices_[b]);
    }
    std::vector<std::uint32_t> cells() const { return ids_of_cells<Space>(triangulation_); }

private:
    const Domain &domain_;
    std::vector<Space::InputPoint> input_;
    std::vector<Space::Vertex> vertices_;
    Space::Triangulation triangulation_;
};

/// deldrift, with the segments or without.
class DeldriftDomain {
public:
    explicit DeldriftDomain(const Domain &domain, bool has_segments = true)
        : domain_(domain), has_segments_(has_segments) {}

    void build(const std::vector<double> &positions) {
        deldrift_options options;
        deldrift_options_init(&options);
        options.threads = 1;
        deldrift_triangulation *t = nullptr;
        require(deldrift_create(2, positions.data(), domain_.n_points(), &options, &t), "deldrift_create");
        t_.reset(t);
        if (!has_segments_) return;
        std::uint32_t first = 0;
        require(deldrift_stage_segments(t, domain_.segments.front().data(), nullptr, domain_.segments.size(), &first),
                "deldrift_stage_segments");
        commit_staged();
    }
    void commit(const std::vector<double> &positions) {
        require(deldrift_commit_positions(t_.get(), positions.data(), domain_.n_points(), nullptr),
                "deldrift_commit_positions");
    }
    void stage(const std::vector<double> &positions) {
        require(deldrift_move_vertices(t_.get(), nullptr, positions.data(), domain_.n_points()),
                "deldrift_move_vertices");
    }
    void check() { require(deldrift_check_staged(t_.get()), "deldrift_check_staged"); }
    void look_for_passings() { require(deldrift_check_passings(t_.get()), "deldrift_check_passings"); }
    void commit_staged() { require(deldrift_commit_timestamp(t_.get(), nullptr), "deldrift_commit_timestamp"); }

    std::vector<std::uint32_t> cells() const {
        deldrift_cells_view view;
        require(deldrift_cells(t_.get(), &view), "deldrift_cells");
        return {view.vertices, view.vertices + view.count * 3};
    }
    void give_up() { t_.reset(); }

private:
    struct Destroy {
        void operator()(deldrift_triangulation *t) const noexcept { deldrift_destroy(t); }
    };

    const Domain &domain_;
    bool has_segments_;
    std::unique_ptr<deldrift_triangulation, Destroy> t_;
};

/// Positions of all vertices.
using Frame = std::vector<double>;

template <typename Call>
double seconds_of(Call call) {
    const Stopwatch watch;
    call();
    return watch.seconds();
}

double mean(const std::vector<double> &values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Every vertex goes so far in a random direction.
void go(double length, Random &random, std::vector<double> &positions) {
    for (std::size_t at = 0; at < positions.size(); at += 2) {
        double way[2];
        do random.in_ball(2, 1, way);
        while (way[0] == 0 && way[1] == 0);
        const double scale = length / std::hypot(way[0], way[1]);
        positions[at] += scale * way[0];
        positions[at + 1] += scale * way[1];
    }
}

class Measurement {
public:
    Measurement(const Domain &domain, const DomainEfforts &efforts, std::uint64_t seed, DomainChecks &checks,
                Progress &progress)
        : domain_(domain), efforts_(efforts), random_(seed + 1), checks_(checks), progress_(progress), cgal_(domain),
          deldrift_(domain) {
        same_place_.resize(domain.n_points());
        std::iota(same_place_.begin(), same_place_.end(), 0u);
    }

    std::vector<DomainLine> run() {
        const std::size_t n_turns = efforts_.n_builds + 3 * n_warm + 2 * efforts_.n_steps + efforts_.n_moves;
        progress_.begin(fmt::format("{}: {} vertices, {} segments", domain_.name, domain_.n_points(),
                                    domain_.segments.size()),
                        n_turns);
        build();
        step();
        rest();
        check();
        move();
        return lines_;
    }

private:
    void build() {
        std::vector<double> cgal, deldrift;
        for (std::size_t i = 0; i < efforts_.n_builds; ++i) {
            CgalDomain fresh(domain_);
            fresh.prepare(domain_.positions);
            cgal.push_back(seconds_of([&] { fresh.build(); }));
            deldrift_.give_up();
            deldrift.push_back(seconds_of([&] { deldrift_.build(domain_.positions); }));
            progress_.step();
        }
        compare("build", 0, domain_.positions);
        add("build", "cgal/rebuilding", median(cgal), "deldrift/auto", median(deldrift), wanted_of_builds);
    }

    /// Steps of all vertices, beside those of a triangulation without segments.
    void step() {
        std::vector<double> positions = domain_.positions;
        const std::vector<Frame> frames = frames_of(n_warm + efforts_.n_steps, [&](std::size_t) -> const Frame & {
            go(step_length, random_, positions);
            return positions;
        });
        const double cgal = median(rebuild(frames)), ours = median(commits_of(deldrift_, frames));
        DeldriftDomain free(domain_, false);
        const double without = median(commits_of(free, frames));
        compare_all("step_1e-3", frames);
        add("step_1e-3", "cgal/rebuilding", cgal, "deldrift/auto", ours, wanted_of_steps);
        add("step_1e-3", "deldrift/auto without segments", without, "deldrift/auto", ours, 0);
    }

    /// Commits of all vertices where they are.
    void rest() {
        const std::vector<Frame> frames(n_warm + efforts_.n_steps, domain_.positions);
        const double ours = median(commits_of(deldrift_, frames));
        DeldriftDomain free(domain_, false);
        const double without = median(commits_of(free, frames));
        compare("rest", frames.size(), domain_.positions);
        add("rest", "deldrift/auto without segments", without, "deldrift/auto", ours, wanted_at_rest);
    }

    /// Checks of what is staged, and looks at what would pass segments, beside commits of what is staged, in turns.
    void check() {
        deldrift_.build(domain_.positions);
        std::vector<double> positions = domain_.positions, commits, checks, passings;
        for (std::size_t i = 1; i <= n_warm + efforts_.n_steps; ++i) {
            go(step_length, random_, positions);
            deldrift_.stage(positions);
            commits.push_back(seconds_of([&] { deldrift_.commit_staged(); }));
            go(step_length, random_, positions);
            deldrift_.stage(positions);
            checks.push_back(seconds_of([&] { deldrift_.check(); }));
            passings.push_back(seconds_of([&] { deldrift_.look_for_passings(); }));
            deldrift_.commit_staged();
            progress_.step();
        }
        compare("check", 2 * checks.size(), positions);
        add("check", "deldrift/auto commit", median(after_warm_up(commits)), "deldrift/auto check",
            median(after_warm_up(checks)), wanted_of_checks);
        add("passings", "deldrift/auto commit", median(after_warm_up(commits)), "deldrift/auto look for passings",
            median(after_warm_up(passings)), wanted_of_passings);
    }

    /// The domain's own motion; its timestamps differ, so that the mean counts.
    void move() {
        std::vector<double> positions;
        const std::vector<Frame> frames = frames_of(n_warm + efforts_.n_moves, [&](std::size_t i) -> const Frame & {
            domain_.move(i, positions);
            return positions;
        });
        const double cgal = mean(rebuild(frames)), ours = mean(commits_of(deldrift_, frames));
        compare_all("motion", frames);
        add("motion", "cgal/rebuilding", cgal, "deldrift/auto", ours, wanted_of_moves);
    }

    template <typename Next>
    static std::vector<Frame> frames_of(std::size_t n, Next next) {
        std::vector<Frame> frames;
        for (std::size_t i = 1; i <= n; ++i) frames.push_back(next(i));
        return frames;
    }
    static std::vector<double> after_warm_up(const std::vector<double> &seconds) {
        return {seconds.begin() + n_warm, seconds.end()};
    }

    /// CGAL at each frame, alone, so that it has the caches to itself; keeps its cells.
    std::vector<double> rebuild(const std::vector<Frame> &frames) {
        std::vector<double> seconds;
        cells_.clear();
        for (const Frame &frame : frames) {
            cgal_.prepare(frame);
            seconds.push_back(seconds_of([&] { cgal_.build(); }));
            cells_.push_back(cgal_.cells());
            progress_.step();
        }
        return after_warm_up(seconds);
    }
    /// From the beginning through all frames; the cells are not read.
    std::vector<double> commits_of(DeldriftDomain &deldrift, const std::vector<Frame> &frames) {
        std::vector<double> seconds;
        Frame staged = domain_.positions;
        deldrift.build(staged);
        for (const Frame &frame : frames) {
            // At the same place in memory, freshly written, as a solver leaves it.
            std::copy(frame.begin(), frame.end(), staged.begin());
            seconds.push_back(seconds_of([&] { deldrift.commit(staged); }));
        }
        return after_warm_up(seconds);
    }
    /// Through all frames again, with the cells of each beside those that CGAL had.
    void compare_all(const char *timed, const std::vector<Frame> &frames) {
        deldrift_.build(domain_.positions);
        for (std::size_t i = 0; i < frames.size(); ++i) {
            deldrift_.commit(frames[i]);
            compare_cells(timed, i + 1, cells_[i]);
        }
    }

    void compare(const char *timed, std::size_t timestamp, const std::vector<double> &positions) {
        cgal_.prepare(positions);
        cgal_.build();
        compare_cells(timed, timestamp, cgal_.cells());
    }
    void compare_cells(const char *timed, std::size_t timestamp, const std::vector<std::uint32_t> &cells) {
        const CellSet ours = canonical(2, deldrift_.cells(), same_place_), theirs = canonical(2, cells, same_place_);
        checks_.n_comparisons++;
        checks_.n_cells += ours.size();
        if (ours == theirs) return;
        const CellSet only_ours = difference(ours, theirs), only_theirs = difference(theirs, ours);
        throw std::runtime_error(fmt::format(
            "{} of {} vertices, {}, timestamp {}: deldrift has {} cells that CGAL has not, as {}, CGAL {}, as {}",
            domain_.name, domain_.n_points(), timed, timestamp, only_ours.size(),
            only_ours.empty() ? "none" : to_string(only_ours.front()), only_theirs.size(),
            only_theirs.empty() ? "none" : to_string(only_theirs.front())));
    }

    void add(const char *timed, const char *reference, double reference_seconds, const char *contender,
             double contender_seconds, double wanted) {
        const double scale = 1e9 / static_cast<double>(domain_.n_points());
        lines_.push_back({domain_.name, domain_.n_points(), domain_.segments.size(), timed, reference, contender,
                          scale * reference_seconds, scale * contender_seconds, wanted});
    }

    const Domain &domain_;
    DomainEfforts efforts_;
    Random random_;
    DomainChecks &checks_;
    Progress &progress_;
    CgalDomain cgal_;
    DeldriftDomain deldrift_;
    std::vector<std::uint32_t> same_place_;
    std::vector<std::vector<std::uint32_t>> cells_;  // CGAL's, of each frame
    std::vector<DomainLine> lines_;
};

/// Motions of large domains are cut short.
constexpr std::size_t most_moved = 2'000'000;

DomainEfforts efforts_of(const Preset &preset, std::size_t n_points) {
    if (preset.name == "smoke") return {1, 1, 5};
    return {5, 9, std::clamp<std::size_t>(most_moved / n_points, 1, domain_timestamps)};
}

}  // namespace

std::vector<DomainLine> measure_domain(const Domain &domain, const DomainEfforts &efforts, std::uint64_t seed,
                                       DomainChecks &checks, Progress &progress) {
    return Measurement(domain, efforts, seed, checks, progress).run();
}

void run_domains(const Options &options) {
    keep_memory();
    Progress progress;
    DomainChecks checks;
    std::vector<std::vector<std::string>> lines = {{"domain", "n", "segments", "timed", "reference", "reference_ns",
                                                    "contender", "contender_ns", "ratio", "wanted", "verdict"}};
    for (const std::string &name : domain_names()) {
        const bool is_chosen = options.domains.empty() || std::count(options.domains.begin(), options.domains.end(), name);
        for (const std::size_t n : options.preset.domain_sizes) {
            if (!is_chosen) continue;
            const Domain domain = make_domain(name, n, options.seed);
            for (const DomainLine &line :
                 measure_domain(domain, efforts_of(options.preset, n), options.seed, checks, progress))
                lines.push_back(line_of(line.domain, line.n_points, line.n_segments, line.timed, line.reference,
                                        significant(line.reference_ns, 4), line.contender,
                                        significant(line.contender_ns, 4), significant(line.ratio(), 3),
                                        line.wanted == 0 ? "" : significant(line.wanted, 3),
                                        line.wanted == 0 ? "" : line.verdict()));
        }
    }
    publish(options.results, "domains.csv", lines);
    fmt::print("cells compared with CGAL's: {} times, {} cells\n", checks.n_comparisons, checks.n_cells);
}

}  // namespace bench
