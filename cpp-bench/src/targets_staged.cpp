// SPDX-License-Identifier: GPL-3.0-or-later
// Commits of few staged vertices: what auto chooses beside each of the algorithms for use.
#include "algorithms.hpp"
#include "cells.hpp"
#include "library.hpp"
#include "random.hpp"
#include "replay.hpp"
#include "scenarios.hpp"
#include "targets.hpp"
#include "verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>

namespace bench {
namespace {

/// Auto may take 1.1 times as long as the best, and 1.3 times over the first timestamps of a new number of vertices.
constexpr double wanted_of_auto = 1 / 1.1;
constexpr double wanted_at_first = 1 / 1.3;
constexpr std::size_t n_first = 10;

/// A vertex goes as far, in spacings.
constexpr double displacement = 0.01;

/// Rebuilding takes as long whatever is staged: it is timed so often.
constexpr std::size_t n_rebuilt = 3;

/// Of a hundred thousand vertices.
constexpr double staged_shares[] = {1e-5, 1e-4, 1e-3, 1e-2, 0.05, 0.2};

std::string target_name(double share) {
    return share < 0.05 ? fmt::format("staged_{:g}", 1e5 * share) : fmt::format("staged_{:g}%", 100 * share);
}

/// Vertices and where they go.
struct Moves {
    std::vector<std::uint32_t> ids;
    std::vector<double> positions;
};

/// A triangulation and what its commits have cost.
class Runner {
public:
    Runner(const Algorithm &algorithm, const Series &series)
        : algorithm_(algorithm),
          triangulation_(create_by(algorithm, series.dimension, series.frame(0), series.n_points, 1),
                         &deldrift_destroy) {}

    std::string name() const { return fmt::format("deldrift/{}", algorithm_.name); }
    bool is_auto() const { return algorithm_.code == DELDRIFT_AUTO; }
    bool is_done() const { return algorithm_.code == DELDRIFT_REBUILDING && seconds_.size() >= n_rebuilt; }

    void begin() { seconds_.clear(); }

    void commit(const Moves &moves) {
        const auto start = std::chrono::steady_clock::now();
        require(deldrift_move_vertices(triangulation_.get(), moves.ids.data(), moves.positions.data(), moves.ids.size()),
                "deldrift_move_vertices");
        require(deldrift_commit_timestamp(triangulation_.get(), nullptr), "deldrift_commit_timestamp");
        seconds_.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }

    /// Outside of what is timed.
    void catch_up(const std::vector<double> &positions, std::size_t n_points) {
        require(deldrift_move_vertices(triangulation_.get(), nullptr, positions.data(), n_points),
                "deldrift_move_vertices");
        require(deldrift_commit_timestamp(triangulation_.get(), nullptr), "deldrift_commit_timestamp");
    }

    /// The mean of the first ones; of rebuilding, of those that there are.
    double at_first() const {
        const std::size_t n = std::min(n_first, seconds_.size());
        return std::accumulate(seconds_.begin(), seconds_.begin() + n, 0.0) / static_cast<double>(n);
    }

    /// The median of the others.
    double later() const {
        const std::size_t n = is_done() ? 0 : std::min(n_first, seconds_.size() - 1);
        return median({seconds_.begin() + n, seconds_.end()});
    }

    CellSet cells(const std::vector<std::uint32_t> &representatives, unsigned dimension) const {
        deldrift_cells_view view;
        require(deldrift_cells(triangulation_.get(), &view), "deldrift_cells");
        return canonical(dimension, {view.vertices, view.vertices + view.count * view.corners_per_cell},
                         representatives);
    }

private:
    const Algorithm &algorithm_;
    std::unique_ptr<deldrift_triangulation, decltype(&deldrift_destroy)> triangulation_;
    std::vector<double> seconds_;
};

/// Vertices of a series that move, a few at a time.
class Staging {
public:
    Staging(const Series &series, std::uint64_t seed)
        : dimension_(series.dimension), n_points_(series.n_points), positions_(series.positions), random_(seed),
          order_(series.n_points) {
        std::iota(order_.begin(), order_.end(), 0u);
    }

    /// Different vertices, anywhere.
    Moves draw(std::size_t n) {
        const double spacing = std::pow(static_cast<double>(n_points_), -1.0 / dimension_);
        Moves moves;
        for (std::size_t i = 0; i < n; ++i) {
            const auto left = static_cast<double>(n_points_ - i);
            std::swap(order_[i], order_[i + static_cast<std::size_t>(left * random_.unit())]);
            double way[3];
            random_.in_ball(dimension_, displacement * spacing, way);
            moves.ids.push_back(order_[i]);
            for (unsigned axis = 0; axis < dimension_; ++axis)
                moves.positions.push_back(positions_[std::size_t{order_[i]} * dimension_ + axis] += way[axis]);
        }
        return moves;
    }

    const std::vector<double> &positions() const { return positions_; }

private:
    unsigned dimension_;
    std::size_t n_points_;
    std::vector<double> positions_;
    Random random_;
    std::vector<std::uint32_t> order_;
};

const Runner &best_of(const std::vector<Runner> &runners, double (Runner::*cost)() const) {
    const auto is_better = [cost](const Runner &a, const Runner &b) {
        return !a.is_auto() && (b.is_auto() || (a.*cost)() < (b.*cost)());
    };
    return *std::min_element(runners.begin(), runners.end(), is_better);
}

void compare(const std::vector<Runner> &runners, const Staging &staging, const Series &series) {
    const auto same_place = representatives(series.dimension, staging.positions().data(), series.n_points);
    const CellSet expected = runners.front().cells(same_place, series.dimension);
    for (const Runner &runner : runners)
        if (runner.cells(same_place, series.dimension) != expected)
            throw Mismatch(runner.name() + ": the cells are not those of " + runners.front().name(), 1);
}

}  // namespace

std::vector<Target> staged_targets(unsigned dimension, const TargetSizes &sizes, std::uint64_t seed,
                                   Progress &progress) {
    std::vector<double> shares;
    for (const double share : staged_shares)
        if (sizes.has(target_name(share))) shares.push_back(share);
    if (shares.empty()) return {};
    const Series series = uniform_points(dimension, sizes.n_stepped, seed);
    std::vector<Runner> runners;
    for (const Algorithm &algorithm : algorithms())
        if (algorithm.purpose == Purpose::for_use) runners.emplace_back(algorithm, series);
    Staging staging(series, seed + 1);
    // A program has moved all vertices before it moves few: its first commit of all fills arrays that the others have.
    const Moves all = staging.draw(series.n_points);
    for (Runner &runner : runners) runner.commit(all);
    std::vector<Target> targets;
    for (const double share : shares) {
        const auto n = std::max<std::size_t>(1, std::llround(share * static_cast<double>(series.n_points)));
        const std::size_t n_rounds = n_first + sizes.n_rounds;
        progress.begin(fmt::format("{} of {} points in {}D staged", n, series.n_points, dimension), n_rounds);
        for (Runner &runner : runners) runner.begin();
        for (std::size_t round = 0; round < n_rounds; ++round) {
            const Moves moves = staging.draw(n);
            for (std::size_t i = 0; i < runners.size(); ++i) {
                Runner &runner = runners[(round + i) % runners.size()];
                if (!runner.is_done()) runner.commit(moves);
            }
            progress.step();
        }
        const Runner &auto_ = *std::find_if(runners.begin(), runners.end(), [](const Runner &r) { return r.is_auto(); });
        const auto add = [&](const std::string &what, double (Runner::*cost)() const, double wanted) {
            const Runner &best = best_of(runners, cost);
            const double scale = 1e9 / static_cast<double>(n);
            targets.push_back({what, dimension, n, best.name(), auto_.name(), scale * (best.*cost)(),
                               scale * (auto_.*cost)(), wanted, 0, 0});
        };
        add(target_name(share), &Runner::later, wanted_of_auto);
        add(target_name(share), &Runner::at_first, wanted_at_first);
        for (Runner &runner : runners)
            if (runner.is_done()) runner.catch_up(staging.positions(), series.n_points);
    }
    compare(runners, staging, series);
    return targets;
}

}  // namespace bench
