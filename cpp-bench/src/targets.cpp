// SPDX-License-Identifier: GPL-3.0-or-later
#include "targets.hpp"

#include "lists.hpp"
#include "measure.hpp"
#include "random.hpp"
#include "referee.hpp"
#include "replay.hpp"
#include "scenarios.hpp"
#include "structured.hpp"
#include "table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <numeric>

namespace bench {
namespace {

/// How far from where they began points move, in spacings.
constexpr double still_displacement = 1e-6;
constexpr double converged_displacement = 1e-7;
/// So little that not one certificate among those of a million points is expected to fail.
constexpr double swept_displacement = 1e-10;

/// By so much that a little more than half of the vertices stay within their tolerance, in 2D and 3D.
constexpr double half_displacements[] = {0.012, 0.0013};

/// So much that no triangulation is worth mending, in spacings.
constexpr unsigned leaps[] = {1, 10};
/// Auto may take 1.1 times as long as rebuilding, which is to be twice as fast as CGAL's.
constexpr double wanted_of_leaps = 2;
constexpr double wanted_of_rebuilding = 1 / 1.1;

/// DELDRIFT_AUTO computes tolerances after a calm commit, or a calm
/// round of relocations, and uses them later.
constexpr std::size_t n_warm = 2;
/// Consecutive timestamps at a turn where the data fits into caches: it matters then what is in them.
constexpr std::size_t rounds_at_a_turn = 4;

constexpr double wanted_of_two_threads = 1.8;

/// Steps by which many cells change, in spacings, as recorded proteins and liquids have them.
constexpr double drifts[] = {0.03, 0.1, 0.3};
/// Mending is to be so much faster than rebuilding.
constexpr double wanted_of_drifts[] = {1.5, 1.5, 1 / 1.1};

/// Structured sets that points leave: every tenth of them, another tenth each time, or all by a shear.
constexpr const char *left_sets[] = {"grid", "face_centred", "layers", "sphere", "circle"};
constexpr std::size_t leaving_every = 10;
constexpr double leaving_displacement = 1e-4;
constexpr double leaving_shear = 1e-3;
/// Over the first ten timestamps auto may take 1.3 times as long as the best.
constexpr std::size_t n_left = 10;
constexpr double wanted_at_first = 1 / 1.3;

/// Shares of the vertices that leap anywhere in each timestamp, while all others move by so many spacings.
constexpr double leaping_shares[] = {0.001, 0.01, 0.1};
constexpr struct {
    const char *suffix;
    double step;
} others_of_leaping[] = {{"", 0}, {"_creeping", 1e-5}, {"_moving", 1e-3}};

/// From where points go to a random place close by.
enum class From { where_they_began, where_they_were };

/// Random points at unit density.
Series moving_points(const std::string &name, unsigned dimension, std::size_t n_points, From from,
                     double displacement, std::size_t n_timestamps, std::uint64_t seed) {
    Series series = uniform_points(dimension, n_points, seed);
    series.name = name + (dimension == 2 ? "_2d" : "_3d");
    const double side = std::pow(static_cast<double>(n_points), 1.0 / dimension);
    for (double &coordinate : series.positions) coordinate *= side;
    series.positions.resize((n_timestamps + 1) * series.frame_length());
    Random random(seed + 1);
    for (std::size_t at = series.frame_length(); at < series.positions.size(); at += dimension) {
        double *place = &series.positions[at];
        random.in_ball(dimension, displacement, place);
        const std::size_t centre =
            from == From::where_they_began ? at % series.frame_length() : at - series.frame_length();
        for (unsigned axis = 0; axis < dimension; ++axis) place[axis] += series.positions[centre + axis];
    }
    return series;
}

/// Random points at unit density of which some leap after the warm-up.
Series leaping_points(const std::string &name, unsigned dimension, std::size_t n_points, double share, double step,
                      std::uint64_t seed) {
    const std::size_t last = n_warm + n_left;
    Series series = moving_points(name, dimension, n_points, From::where_they_were, step, last, seed);
    const double side = std::pow(static_cast<double>(n_points), 1.0 / dimension);
    Random random(seed + 2);
    // How far the leaps so far have taken each point off its walk.
    std::vector<double> by(series.frame_length(), 0);
    for (std::size_t at = (n_warm + 1) * series.frame_length(); at < series.positions.size(); at += dimension) {
        const bool leaps = random.unit() < share;
        for (unsigned axis = 0; axis < dimension; ++axis) {
            double &moved = by[(at + axis) % series.frame_length()];
            double &coordinate = series.positions[at + axis];
            if (leaps) moved = side * random.unit() - coordinate;
            coordinate += moved;
        }
    }
    return series;
}

/// A structured set, at rest during the warm-up, that is left after it.
Series left_points(const std::string &name, const PointSet &set, std::size_t n_points, bool is_sheared,
                   std::uint64_t seed) {
    Random random(seed);
    const SolverPoints points = set.draw(set.dimension, n_points, random);
    Series series;
    series.name = fmt::format("{}_{}d", name, set.dimension);
    series.dimension = set.dimension;
    series.n_points = points.positions.size() / set.dimension;
    const std::size_t length = points.positions.size();
    std::vector<double> frame = points.positions;
    for (std::size_t timestamp = 0; timestamp <= n_warm + n_left; ++timestamp) {
        if (timestamp > n_warm && is_sheared)
            for (std::size_t at = 0; at < length; at += set.dimension) frame[at] += leaving_shear * frame[at + 1];
        if (timestamp > n_warm && !is_sheared)
            for (std::size_t i = timestamp % leaving_every; i < series.n_points; i += leaving_every) {
                double way[3];
                random.in_ball(set.dimension, leaving_displacement * points.spacing, way);
                for (unsigned axis = 0; axis < set.dimension; ++axis) frame[i * set.dimension + axis] += way[axis];
            }
        series.positions.insert(series.positions.end(), frame.begin(), frame.end());
    }
    return series;
}

Series trembling_points(const std::string &name, unsigned dimension, std::size_t n_points, double displacement,
                        std::size_t n_timestamps, std::uint64_t seed) {
    return moving_points(name, dimension, n_points, From::where_they_began, displacement, n_timestamps, seed);
}

Entrant entrant(const EngineKind &kind, unsigned n_threads, std::size_t n_timestamps) {
    Entrant entrant{&kind, n_threads, {}};
    const std::size_t first = kind.is_stateless ? n_warm + 1 : 1;
    for (std::size_t timestamp = first; timestamp <= n_timestamps; ++timestamp)
        entrant.timestamps.push_back(timestamp);
    return entrant;
}

Entrant entrant(const char *name, unsigned n_threads, std::size_t n_timestamps) {
    return entrant(engine_kind(name), n_threads, n_timestamps);
}

/// What an entrant did after the warm-up.
struct Outcome {
    std::string name;
    double ns;         // of an update, per vertex: the median
    double mean_ns;
    double n_changes;  // of an update
    double within;     // tolerance: share of the vertices, over all updates
};

/// Replays a series to the entrants in turns of so many timestamps, and compares their cells at the last one.
std::vector<Outcome> replay(const Series &series, const std::vector<Entrant> &entrants, std::size_t turn,
                            Checks &checks, Progress &progress) {
    const std::size_t last = series.n_timestamps();
    const auto go_on = [](std::size_t) {};
    Replay replay(series);
    std::vector<Lane> lanes = lanes_of(entrants);
    std::vector<Counts> before;
    progress.begin(fmt::format("{}: timing {} updates", series.name, last - n_warm), last - n_warm);
    for (Lane &lane : lanes) {
        lane.restart(series.dimension);
        replay.run_block(lane, 1, n_warm, go_on);
        before.push_back(lane.engine->counts());
        lane.seconds.clear();
    }
    for (std::size_t first = n_warm + 1; first <= last; first += turn) {
        for (std::size_t i = 0; i < lanes.size(); ++i)
            replay.run_block(lanes[(first + i) % lanes.size()], first, std::min(first + turn - 1, last), go_on);
        progress.step(fmt::format("timestamp {}", first));
    }

    progress.begin(series.name + ": checking cells", lanes.size() + 1);
    Referee referee(series, last, checks);
    progress.step();
    std::vector<Outcome> outcomes;
    for (std::size_t i = 0; i < lanes.size(); ++i) {
        referee.judge(*lanes[i].entrant, *lanes[i].engine);
        progress.step();
        std::vector<double> seconds;
        for (const auto &[timestamp, repeats] : lanes[i].seconds) seconds.push_back(repeats.front());
        const Counts after = lanes[i].engine->counts();
        const auto n_updates = static_cast<double>(last - n_warm);
        const auto n_points = static_cast<double>(series.n_points);
        const auto n_within = static_cast<double>(after.within_tolerance - before[i].within_tolerance);
        const double sum = std::accumulate(seconds.begin(), seconds.end(), 0.0);
        outcomes.push_back({lanes[i].entrant->name(), 1e9 * median(seconds) / n_points,
                            1e9 * sum / (n_points * static_cast<double>(seconds.size())),
                            static_cast<double>(after.changes - before[i].changes) / n_updates,
                            n_within / (n_updates * n_points)});
    }
    return outcomes;
}

/// As above, of builds from nothing.
std::vector<Outcome> build(const Series &series, const std::vector<Entrant> &entrants, unsigned n_repeats,
                           Checks &checks, Progress &progress) {
    const std::vector<Row> rows = measure_build(series, entrants, n_repeats, progress);
    progress.begin(series.name + ": checking cells", entrants.size() + 1);
    Referee referee(series, 0, checks);
    progress.step();
    std::vector<Outcome> outcomes;
    for (std::size_t i = 0; i < entrants.size(); ++i) {
        const std::unique_ptr<Engine> engine = entrants[i].make(series.dimension);
        engine->build(series.frame(0), series.n_points);
        referee.judge(entrants[i], *engine);
        progress.step();
        const double ns = rows[i].ns_per_vertex_timestamp();
        outcomes.push_back({entrants[i].name(), ns, ns, 0, 0});
    }
    return outcomes;
}

class Session {
public:
    Session(const TargetSizes &sizes, std::uint64_t seed, std::vector<Checks> &checks, Progress &progress)
        : sizes_(sizes), seed_(seed), checks_(checks), progress_(progress) {}

    std::vector<Target> run() {
        for (const unsigned dimension : {2u, 3u}) {
            if (sizes_.has("tolerance_test")) test(dimension, dimension == 2 ? 100 : 500);
            if (sizes_.has("half_within")) stay_by_half(dimension);
            if (sizes_.has("immediate_still")) relocate(dimension, dimension == 2 ? 8 : 30);
            if (sizes_.has("converged")) converge(dimension, dimension == 2 ? 30 : 150);
            if (sizes_.has("swept") || sizes_.has("threads_swept")) sweep(dimension, dimension == 2 ? 12 : 22);
            for (const unsigned displacement : leaps)
                if (sizes_.has(leap_name(displacement))) leap(dimension, displacement);
            for (std::size_t i = 0; i < std::size(drifts); ++i)
                if (sizes_.has(drift_name(drifts[i]))) {
                    drift(dimension, sizes_.n_relocated, sizes_.n_rounds, drifts[i], wanted_of_drifts[i]);
                    // Where no cache holds all, every cell that changes takes longer.
                    drift(dimension, sizes_.n_committed, sizes_.n_commits, drifts[i], wanted_of_drifts[i]);
                }
            for (const double share : leaping_shares)
                for (const auto &others : others_of_leaping)
                    if (const std::string name = leaping_name(share, others.suffix); sizes_.has(name))
                        for (const std::size_t n_points : {sizes_.n_relocated, sizes_.n_tested})
                            add_beside_best(name,
                                            leaping_points(name, dimension, n_points, share, others.step, seed_));
            for (const PointSet &set : point_sets())
                if (set.dimension == dimension && is_left(set))
                    for (const char *way : {"tenth", "shear"})
                        if (sizes_.has(left_name(way, set))) leave(set, way);
            if (sizes_.has("threads_build")) build_anew(dimension);
            append(step_targets(dimension, sizes_, seed_, checks_, progress_));
            if (sizes_.has("loop")) append(loop_targets(dimension, sizes_, seed_, checks_, progress_));
            append(growth_targets(dimension, sizes_, seed_, progress_));
            append(location_targets(dimension, sizes_, seed_, progress_));
            append(list_targets(dimension, sizes_, seed_, progress_));
            append(staged_targets(dimension, sizes_, seed_, progress_));
            append(phase_targets(dimension, sizes_, seed_, progress_));
        }
        return targets_;
    }

private:
    void test(unsigned dimension, double wanted) {
        const std::size_t last = n_warm + sizes_.n_rounds;
        const EngineKind test_alone = {"deldrift", "tolerance staged", false, false,
                                       deldrift_staged_by(algorithm_of(DELDRIFT_TOLERANCE))};
        const Series series =
            trembling_points("tested", dimension, sizes_.n_tested, swept_displacement, last, seed_);
        const auto done =
            replay(series, {entrant("cgal/rebuilding", 1, last), entrant(test_alone, 1, last)}, sizes_.n_rounds,
                   checks_of(series), progress_);
        add("tolerance_test", series, done[0], done[1], wanted);
    }

    void stay_by_half(unsigned dimension) {
        const std::size_t last = n_warm + sizes_.n_rounds;
        const Series series = moving_points("half", dimension, sizes_.n_relocated, From::where_they_were,
                                            half_displacements[dimension - 2], last, seed_);
        const auto done = replay(series,
                                 {entrant("cgal/placement", 1, last), entrant("deldrift/placement", 1, last),
                                  entrant("deldrift/tolerance", 1, last)},
                                 1, checks_of(series), progress_);
        add("half_within", series, done[0], done[2], 1);
        add("half_within", series, done[1], done[2], 1);
    }

    void relocate(unsigned dimension, double wanted) {
        const std::size_t last = n_warm + sizes_.n_rounds;
        Series series =
            trembling_points("still", dimension, sizes_.n_relocated, still_displacement, last, seed_);
        series.is_sequential = true;
        const auto done = replay(series,
                                 {entrant("cgal/move", 1, last), entrant("deldrift/auto", 1, last),
                                  entrant("deldrift/placement_flips", 1, last)},
                                 rounds_at_a_turn, checks_of(series), progress_);
        add("immediate_still", series, done[0], done[1], wanted);
        add("immediate_still", series, done[0], done[2], wanted);
    }

    void converge(unsigned dimension, double wanted) {
        const std::size_t last = n_warm + sizes_.n_commits;
        const Series series =
            trembling_points("converged", dimension, sizes_.n_committed, converged_displacement, last, seed_);
        const auto done = replay(series, {entrant("cgal/rebuilding", 1, last), entrant("deldrift/auto", 1, last)},
                                 1, checks_of(series), progress_);
        add("converged", series, done[0], done[1], wanted);
    }

    void sweep(unsigned dimension, double wanted) {
        const std::size_t last = n_warm + sizes_.n_commits;
        const Series series =
            trembling_points("swept", dimension, sizes_.n_committed, swept_displacement, last, seed_);
        const auto done = replay(series,
                                 {entrant("cgal/rebuilding", 1, last), entrant("deldrift/repair", 1, last),
                                  entrant("deldrift/repair", 2, last)},
                                 1, checks_of(series), progress_);
        add("swept", series, done[0], done[1], wanted);
        add("threads_swept", series, done[1], done[2], wanted_of_two_threads);
    }

    void leap(unsigned dimension, unsigned displacement) {
        const std::size_t last = n_warm + sizes_.n_rounds;
        const std::string name = leap_name(displacement);
        const Series series = moving_points(name, dimension, sizes_.n_relocated, From::where_they_began,
                                            displacement, last, seed_);
        auto done = replay(series,
                           {entrant("cgal/rebuilding", 1, last), entrant("deldrift/rebuilding", 1, last),
                            entrant("deldrift/auto", 1, last)},
                           1, checks_of(series), progress_);
        // Auto looks now and then whether mending has become worth it.
        for (Outcome &outcome : done) outcome.ns = outcome.mean_ns;
        add(name.c_str(), series, done[0], done[2], wanted_of_leaps);
        add(name.c_str(), series, done[1], done[2], wanted_of_rebuilding);
    }

    void drift(unsigned dimension, std::size_t n_points, std::size_t n_timestamps, double displacement,
               double wanted) {
        const std::size_t last = n_warm + n_timestamps;
        const std::string name = drift_name(displacement);
        const Series series =
            moving_points(name, dimension, n_points, From::where_they_were, displacement, last, seed_);
        auto done = replay(series,
                           {entrant("deldrift/rebuilding", 1, last), entrant("deldrift/auto", 1, last),
                            entrant("deldrift/rebuilding", 2, last), entrant("deldrift/auto", 2, last)},
                           1, checks_of(series), progress_);
        // Auto tries to mend now and then.
        for (Outcome &outcome : done) outcome.ns = outcome.mean_ns;
        add(name.c_str(), series, done[0], done[1], wanted);
        // Threads rebuild faster than they mend.
        add(name.c_str(), series, done[2], done[3], wanted_of_rebuilding);
    }

    void leave(const PointSet &set, const std::string &way) {
        const std::string name = left_name(way, set);
        add_beside_best(name, left_points(name, set, sizes_.n_relocated, way == "shear", seed_));
    }

    /// Auto beside the best of the algorithms that it chooses from.
    void add_beside_best(const std::string &name, const Series &series) {
        const std::size_t last = n_warm + n_left;
        auto done = replay(series,
                           {entrant("deldrift/rebuilding", 1, last), entrant("deldrift/repair", 1, last),
                            entrant("deldrift/placement_flips", 1, last), entrant("deldrift/auto", 1, last)},
                           1, checks_of(series), progress_);
        // The first timestamps differ from the others.
        for (Outcome &outcome : done) outcome.ns = outcome.mean_ns;
        const auto best = std::min_element(done.begin(), done.end() - 1,
                                           [](const Outcome &a, const Outcome &b) { return a.ns < b.ns; });
        add(name.c_str(), series, *best, done.back(), wanted_at_first);
    }

    void build_anew(unsigned dimension) {
        const Series series = uniform_points(dimension, sizes_.n_committed, seed_);
        const EngineKind &kind = engine_kind("deldrift/rebuilding");
        const auto done = build(series, {{&kind, 1, {1}}, {&kind, 2, {1}}},
                                static_cast<unsigned>(sizes_.n_commits), checks_of(series), progress_);
        add("threads_build", series, done[0], done[1], wanted_of_two_threads);
    }

    static std::string leap_name(unsigned displacement) { return fmt::format("leap_{}", displacement); }
    static bool is_left(const PointSet &set) {
        return std::find(std::begin(left_sets), std::end(left_sets), std::string(set.name)) != std::end(left_sets);
    }
    static std::string left_name(const std::string &way, const PointSet &set) {
        return fmt::format("{}_{}", way, set.name);
    }
    static std::string leaping_name(double share, const char *suffix) {
        return fmt::format("leaping_{:g}{}", share, suffix);
    }
    static std::string drift_name(double displacement) { return fmt::format("drift_{:g}", displacement); }

    void append(const std::vector<Target> &targets) {
        targets_.insert(targets_.end(), targets.begin(), targets.end());
    }

    Checks &checks_of(const Series &series) {
        checks_.emplace_back();
        checks_.back().scenario = series.name;
        checks_.back().n_points = series.n_points;
        return checks_.back();
    }

    void add(const char *what, const Series &series, const Outcome &reference, const Outcome &contender,
             double wanted) {
        if (!sizes_.has(what)) return;
        targets_.push_back({what, series.dimension, series.n_points, reference.name, contender.name,
                            reference.ns, contender.ns, wanted, contender.n_changes, contender.within});
    }

    TargetSizes sizes_;
    std::uint64_t seed_;
    std::vector<Checks> &checks_;
    Progress &progress_;
    std::vector<Target> targets_;
};

}  // namespace

std::vector<Target> measure_targets(const TargetSizes &sizes, std::uint64_t seed, std::vector<Checks> &checks,
                                    Progress &progress) {
    return Session(sizes, seed, checks, progress).run();
}

void run_targets(const Options &options) {
    TargetSizes whole = {10'000, 24, 100'000, 1'000'000, 7, {1'000, 10'000, 100'000, 1'000'000},
                               {10'000, 100'000, 1'000'000}, 100'000, 2};
    TargetSizes smoke = {1'000, 4, 1'000, 2'000, 3, {1'000}, {1'000, 2'000}, 1'000, 0.1};
    whole.chosen = smoke.chosen = options.targets;
    keep_memory();
    Progress progress;
    std::vector<Checks> checks;
    const std::vector<Target> targets =
        measure_targets(options.preset.name == "smoke" ? smoke : whole, options.seed, checks, progress);

    std::vector<std::vector<std::string>> lines = {{"dimension", "target", "n", "reference", "reference_ns",
                                                    "contender", "contender_ns", "ratio", "wanted", "verdict",
                                                    "changes", "within"}};
    for (const Target &target : targets)
        lines.push_back(line_of(target.dimension, target.what, target.n, target.reference,
                                significant(target.reference_ns, 4), target.contender,
                                significant(target.contender_ns, 4), significant(target.ratio(), 3),
                                significant(target.wanted, 3), target.verdict(), significant(target.n_changes, 3),
                                significant(target.within, 3)));
    print_checks(std::cout, checks);
    std::cout << '\n';
    publish(options.results, "targets.csv", lines);
}

}  // namespace bench
