// SPDX-License-Identifier: GPL-3.0-or-later
// Commits in two phases beside those in one, and steps that are withdrawn beside those that a clone is kept for.
#include "cells.hpp"
#include "library.hpp"
#include "random.hpp"
#include "replay.hpp"
#include "scenarios.hpp"
#include "targets.hpp"
#include "verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace bench {
namespace {

/// To prepare and publish may take 1.05 times as long as to commit.
constexpr double wanted_of_publishing = 1 / 1.05;
constexpr double wanted_of_withdrawing = 1;

/// A vertex goes as far, in spacings.
constexpr double displacement = 0.001;

/// One of so many vertices is staged.
constexpr std::size_t strides[] = {1000, 1};

const char *name_of(std::size_t stride) { return stride == 1 ? "all" : "few"; }

/// The moves of one timestamp.
struct Round {
    std::vector<std::uint32_t> ids;
    std::vector<double> places;
};

class Phased {
public:
    explicit Phased(const Series &series) : dimension_(series.dimension) {
        deldrift_options options;
        deldrift_options_init(&options);
        options.threads = 1;
        deldrift_triangulation *t = nullptr;
        require(deldrift_create(dimension_, series.frame(0), series.n_points, &options, &t), "deldrift_create");
        t_.reset(t);
    }

    void commit(const Round &round) {
        stage(round);
        require(deldrift_commit_timestamp(t_.get(), nullptr), "deldrift_commit_timestamp");
    }
    void prepare(const Round &round) {
        stage(round);
        require(deldrift_prepare_timestamp(t_.get(), nullptr), "deldrift_prepare_timestamp");
    }
    void publish() { require(deldrift_publish_timestamp(t_.get()), "deldrift_publish_timestamp"); }
    void withdraw() { require(deldrift_withdraw_timestamp(t_.get()), "deldrift_withdraw_timestamp"); }

    /// What a program without two phases does: a clone is kept, and takes the place of what was committed.
    void commit_and_go_back(const Round &round) {
        deldrift_triangulation *kept = nullptr;
        require(deldrift_clone(t_.get(), &kept), "deldrift_clone");
        commit(round);
        t_.reset(kept);
    }

    /// The cells have been read once, so that every commit brings arrays up to date.
    CellSet cells(const std::vector<std::uint32_t> &representatives) const {
        deldrift_cells_view view;
        require(deldrift_cells(t_.get(), &view), "deldrift_cells");
        return canonical(dimension_, {view.vertices, view.vertices + view.count * view.corners_per_cell},
                         representatives);
    }

private:
    void stage(const Round &round) {
        require(deldrift_move_vertices(t_.get(), round.ids.data(), round.places.data(), round.ids.size()),
                "deldrift_move_vertices");
    }
    struct Destroy {
        void operator()(deldrift_triangulation *t) const noexcept { deldrift_destroy(t); }
    };

    unsigned dimension_;
    std::unique_ptr<deldrift_triangulation, Destroy> t_;
};

template <typename Call>
double seconds_of(Call call) {
    const Stopwatch watch;
    call();
    return watch.seconds();
}

Round draw(unsigned dimension, std::size_t n_points, std::size_t stride, Random &random, std::vector<double> &now) {
    Round round;
    const double length = displacement * std::pow(static_cast<double>(n_points), -1.0 / dimension);
    for (std::size_t id = 0; id < n_points; id += stride) {
        double way[3];
        random.in_ball(dimension, length, way);
        round.ids.push_back(static_cast<std::uint32_t>(id));
        for (unsigned axis = 0; axis < dimension; ++axis) round.places.push_back(now[id * dimension + axis] += way[axis]);
    }
    return round;
}

}  // namespace

std::vector<Target> phase_targets(unsigned dimension, const TargetSizes &sizes, std::uint64_t seed,
                                  Progress &progress) {
    std::vector<Target> targets;
    for (const std::size_t stride : strides) {
        const std::string published = fmt::format("published_{}", name_of(stride));
        const std::string withdrawn = fmt::format("withdrawn_{}", name_of(stride));
        if (!sizes.has(published) && !sizes.has(withdrawn)) continue;
        const Series series = uniform_points(dimension, sizes.n_stepped, seed);
        std::vector<double> now(series.frame(0), series.frame(0) + series.n_points * dimension);
        const auto same_place = representatives(dimension, now.data(), series.n_points);
        Random random(seed + 1);
        // Each way on a triangulation of its own.
        Phased commits(series), phases(series), clones(series), trials(series);
        Phased *const all[] = {&commits, &phases, &clones, &trials};
        for (const Phased *t : all) t->cells(same_place);
        const std::size_t n_rounds = sizes.n_rounds + 4;
        progress.begin(fmt::format("{} of {} points in {}D in two phases", series.n_points / stride, series.n_points,
                                   dimension),
                       n_rounds);
        std::vector<double> of_commits, of_phases, of_clones, of_trials;
        std::size_t n = 0;
        for (std::size_t k = 0; k < n_rounds; ++k) {
            std::vector<double> rejected = now;
            const Round far = draw(dimension, series.n_points, stride, random, rejected);
            const Round round = draw(dimension, series.n_points, stride, random, now);
            n = round.ids.size();
            const auto commit = [&] { of_commits.push_back(seconds_of([&] { commits.commit(round); })); };
            if (k % 2 == 0) commit();
            of_phases.push_back(seconds_of([&] {
                phases.prepare(round);
                phases.publish();
            }));
            if (k % 2 == 1) commit();
            of_clones.push_back(seconds_of([&] {
                clones.commit_and_go_back(far);
                clones.commit(round);
            }));
            of_trials.push_back(seconds_of([&] {
                trials.prepare(far);
                trials.withdraw();
                trials.prepare(round);
                trials.publish();
            }));
            const CellSet expected = commits.cells(same_place);
            for (const Phased *t : all)
                if (t->cells(same_place) != expected)
                    throw Mismatch("deldrift/in two phases: the cells are not those of a commit", 1);
            progress.step();
        }
        const double scale = 1e9 / static_cast<double>(n);
        const auto add = [&](const std::string &what, const char *reference, const std::vector<double> &reference_s,
                             const char *contender, const std::vector<double> &contender_s, double wanted) {
            if (!sizes.has(what)) return;
            targets.push_back({what, dimension, n, reference, contender, scale * median(reference_s),
                               scale * median(contender_s), wanted, 0, 0});
        };
        add(published, "deldrift/auto", of_commits, "deldrift/auto, published", of_phases, wanted_of_publishing);
        add(withdrawn, "deldrift/auto, cloned", of_clones, "deldrift/auto, withdrawn", of_trials, wanted_of_withdrawing);
    }
    return targets;
}

}  // namespace bench
