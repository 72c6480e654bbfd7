// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices one at a time: the sequential loop beside CGAL's, and what single calls cost as triangulations grow.
#include "library.hpp"
#include "random.hpp"
#include "referee.hpp"
#include "replay.hpp"
#include "scenarios.hpp"
#include "targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace bench {
namespace {

/// Vertices go so many spacings, in random directions.
constexpr double loop_displacement = 0.001;

/// In space a visit may take a tenth of what it takes with CGAL, in the plane three tenths.
constexpr double wanted_of_loops[] = {1 / 0.3, 1 / 0.1};
/// A call may take eight times as long in the largest triangulation as in the smallest.
constexpr double wanted_of_growth = 1.0 / 8;

constexpr std::size_t most_warm = 64;
constexpr std::size_t n_turns = 3;
/// Enough for the caches, which the other engine has filled meanwhile, to matter little: a program has one engine.
constexpr std::size_t most_visits_at_a_turn = 20'000;
constexpr std::size_t most_calls = 1'000;

/// Cells of larger inputs are not compared.
constexpr std::size_t most_points_compared = 100'000;

/// Which vertex goes where next: in the order of the ids, which is random in space, and from the first one again.
class Walk {
public:
    Walk(unsigned dimension, std::size_t n_points, std::uint64_t seed)
        : dimension_(dimension), random_(seed + 1), series_(uniform_points(dimension, n_points, seed)) {
        const double side = std::pow(static_cast<double>(n_points), 1.0 / dimension);
        for (double &coordinate : series_.positions) coordinate *= side;
        series_.positions.resize(2 * series_.frame_length());
        std::copy_n(series_.positions.begin(), series_.frame_length(),
                    series_.positions.begin() + static_cast<std::ptrdiff_t>(series_.frame_length()));
    }

    struct Stop {
        std::uint32_t vertex;
        double place[3];
    };

    Stop next() {
        Stop stop{static_cast<std::uint32_t>(n_stops_++ % series_.n_points), {0, 0, 0}};
        do random_.in_ball(dimension_, loop_displacement, stop.place);
        while (length(stop.place) < loop_displacement / 1'000);
        const double scale = loop_displacement / length(stop.place);
        double *place = &series_.positions[series_.frame_length() + std::size_t{stop.vertex} * dimension_];
        for (unsigned axis = 0; axis < dimension_; ++axis) {
            place[axis] += scale * stop.place[axis];
            stop.place[axis] = place[axis];
        }
        return stop;
    }

    /// Where vertices began, and where they are.
    Series &series() { return series_; }

private:
    static double length(const double *place) { return std::hypot(place[0], place[1], place[2]); }

    unsigned dimension_;
    Random random_;
    Series series_;
    std::size_t n_stops_ = 0;
};

/// One engine's share of the loop.
struct Looping {
    std::unique_ptr<Engine> engine;
    double seconds = 0;
    double sum = 0;  // of all coordinates read

    double visit(const std::vector<Walk::Stop> &stops) {
        const Stopwatch watch;
        for (const Walk::Stop &stop : stops) sum += engine->visit(stop.vertex, stop.place);
        return watch.seconds();
    }
};

std::vector<Walk::Stop> stops_of(Walk &walk, std::size_t count) {
    std::vector<Walk::Stop> stops;
    for (std::size_t i = 0; i < count; ++i) stops.push_back(walk.next());
    return stops;
}

/// Some visits outside the clock, one by one, by all; how many of the slowest engine's go into a turn.
std::size_t warm_up(Walk &walk, std::vector<Looping> &all, double most_seconds) {
    const Stopwatch watch;
    std::size_t n_warm = 0;
    double slowest = 0;
    while (n_warm < 2 || (n_warm < most_warm && watch.seconds() < most_seconds / 2)) {
        const std::vector<Walk::Stop> stop = stops_of(walk, 1);
        slowest = 0;
        for (Looping &looping : all) slowest = std::max(slowest, looping.visit(stop));
        ++n_warm;
    }
    const double fitting = most_seconds / (n_turns * std::max(slowest, 1e-9));
    return static_cast<std::size_t>(std::clamp(fitting, 1.0, static_cast<double>(most_visits_at_a_turn)));
}

void compare_cells(Walk &walk, std::vector<Looping> &all, const std::vector<Entrant> &entrants,
                   std::vector<Checks> &checks) {
    if (walk.series().n_points > most_points_compared) return;
    checks.emplace_back();
    checks.back().scenario = walk.series().name;
    checks.back().n_points = walk.series().n_points;
    Referee referee(walk.series(), 1, checks.back());
    for (std::size_t i = 0; i < all.size(); ++i) referee.judge(entrants[i], *all[i].engine);
}

/// What the engines read must be the same, up to rounding of sums.
void compare_sums(const std::vector<Looping> &all, const std::string &scenario) {
    for (const Looping &looping : all)
        if (std::fabs(looping.sum - all.front().sum) > 1e-9 * std::fabs(all.front().sum))
            throw Mismatch(scenario + ": the stars that the engines read are not the same", 1);
}

Target loop(unsigned dimension, std::size_t n_points, const TargetSizes &sizes, std::uint64_t seed,
            std::vector<Checks> &checks, Progress &progress) {
    Walk walk(dimension, n_points, seed);
    walk.series().name = dimension == 2 ? "loop_2d" : "loop_3d";
    const std::vector<Entrant> entrants = {{&engine_kind("cgal/move"), 1, {1}},
                                           {&engine_kind("deldrift/auto"), 1, {1}}};
    progress.begin(fmt::format("{}: visiting vertices of {}", walk.series().name, n_points), n_turns + 2);
    std::vector<Looping> all(entrants.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i].engine = entrants[i].make(dimension);
        all[i].engine->build(walk.series().frame(0), n_points);
    }
    progress.step();
    const std::size_t n_visits = warm_up(walk, all, sizes.seconds);
    for (std::size_t turn = 0; turn < n_turns; ++turn) {
        const std::vector<Walk::Stop> stops = stops_of(walk, n_visits);
        for (Looping &looping : all) looping.seconds += looping.visit(stops);
        progress.step();
    }
    compare_sums(all, walk.series().name);
    compare_cells(walk, all, entrants, checks);
    progress.step();
    const double scale = 1e9 / static_cast<double>(n_turns * n_visits);
    return {"loop", dimension, n_points, entrants[0].name(), entrants[1].name(), scale * all[0].seconds,
            scale * all[1].seconds, wanted_of_loops[dimension - 2], 0, 0};
}

/// Calls of the library on one triangulation, each after a change that is not on the clock.
class Calls {
public:
    Calls(unsigned dimension, std::size_t n_points, std::uint64_t seed, double seconds)
        : walk_(dimension, n_points, seed), seconds_(seconds), triangulation_(nullptr, &deldrift_destroy) {
        deldrift_triangulation *triangulation = nullptr;
        deldrift_options options;
        deldrift_options_init(&options);
        options.threads = 1;
        require(deldrift_create(dimension, walk_.series().frame(0), n_points, &options, &triangulation),
                "deldrift_create");
        triangulation_.reset(triangulation);
    }

    /// Median seconds of the call.
    double time(const std::string &name) {
        if (name == "relocate_vertex") return median_of([&] { read_cells(); }, [&] { relocate(); });
        if (name == "cells") return median_of([&] { relocate(); }, [&] { read_cells(); });
        if (name == "star") return median_of([&] { relocate(); }, [&] { read_star(); });
        return median_of([&] { stage(); }, [&] { commit(); });
    }

private:
    double median_of(const std::function<void()> &change, const std::function<void()> &call) {
        const Stopwatch all;
        std::vector<double> seconds;
        for (std::size_t i = 0; i < most_calls && (i < 5 || all.seconds() < seconds_); ++i) {
            stop_ = walk_.next();
            change();
            const Stopwatch watch;
            call();
            if (i >= 2) seconds.push_back(watch.seconds());
        }
        return median(seconds);
    }

    void relocate() {
        require(deldrift_relocate_vertex(triangulation_.get(), stop_.vertex, stop_.place), "deldrift_relocate_vertex");
    }

    void stage() {
        require(deldrift_move_vertex(triangulation_.get(), stop_.vertex, stop_.place), "deldrift_move_vertex");
    }

    void commit() { require(deldrift_commit_timestamp(triangulation_.get(), nullptr), "deldrift_commit_timestamp"); }

    void read_cells() {
        deldrift_cells_view view;
        require(deldrift_cells(triangulation_.get(), &view), "deldrift_cells");
    }

    void read_star() {
        std::size_t n_cells = 0;
        require(deldrift_star(triangulation_.get(), stop_.vertex, star_.data(), star_.size(), &n_cells),
                "deldrift_star");
    }

    Walk walk_;
    double seconds_;
    std::unique_ptr<deldrift_triangulation, decltype(&deldrift_destroy)> triangulation_;
    Walk::Stop stop_{};
    std::vector<std::uint32_t> star_ = std::vector<std::uint32_t>(10'000);
};

}  // namespace

std::vector<Target> loop_targets(unsigned dimension, const TargetSizes &sizes, std::uint64_t seed,
                                 std::vector<Checks> &checks, Progress &progress) {
    std::vector<Target> targets;
    for (const std::size_t n_points : sizes.looped)
        targets.push_back(loop(dimension, n_points, sizes, seed, checks, progress));
    return targets;
}

std::vector<Target> growth_targets(unsigned dimension, const TargetSizes &sizes, std::uint64_t seed,
                                   Progress &progress) {
    std::vector<std::string> names = {"cells", "star", "relocate_vertex", "commit_one"};
    const auto is_not_chosen = [&](const std::string &name) { return !sizes.has("grown_" + name); };
    names.erase(std::remove_if(names.begin(), names.end(), is_not_chosen), names.end());
    if (names.empty()) return {};
    std::vector<std::vector<double>> ns(names.size());
    progress.begin(fmt::format("single calls, {}D", dimension), sizes.grown.size() * names.size());
    for (const std::size_t n_points : sizes.grown) {
        Calls calls(dimension, n_points, seed, sizes.seconds);
        for (std::size_t i = 0; i < names.size(); ++i) {
            ns[i].push_back(1e9 * calls.time(names[i]));
            progress.step();
        }
    }
    std::vector<Target> targets;
    for (std::size_t i = 0; i < names.size(); ++i)
        for (std::size_t size = 1; size < sizes.grown.size(); ++size)
            targets.push_back({"grown_" + names[i], dimension, sizes.grown[size],
                               fmt::format("deldrift/auto at {}", sizes.grown[0]), "deldrift/auto", ns[i][0],
                               ns[i][size], wanted_of_growth, 0, 0});
    return targets;
}

}  // namespace bench
