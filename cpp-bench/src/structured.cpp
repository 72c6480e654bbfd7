// SPDX-License-Identifier: GPL-3.0-or-later
#include "structured.hpp"

#include "cgal_space.hpp"
#include "library.hpp"
#include "measure.hpp"
#include "referee.hpp"
#include "replay.hpp"
#include "table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <map>
#include <numeric>

namespace bench {
namespace {

/// There and back, once outside the clock: DELDRIFT_AUTO finds out how points move.
constexpr std::size_t n_warm = 2;
/// There and back, so often against the clock, larger inputs less often.
constexpr std::size_t n_rounds = 3;
constexpr std::size_t n_rounds_of_large = 2;
/// No further commits after so many seconds of them, and none for the comparison.
constexpr double most_seconds = 20;
constexpr unsigned n_builds = 3;
/// Cells of larger inputs are not compared with CGAL's: exact arithmetic would take minutes to excuse all ties.
constexpr std::size_t most_points_compared = 50'000;

constexpr std::size_t points_of_small_set = 5;
constexpr std::size_t small_sets_at_a_turn = 100;
constexpr std::size_t n_turns_of_small_sets = 30;

class Measurement {
public:
    Measurement(const PointSet &set, std::size_t n_points, std::uint64_t seed, std::vector<Checks> &checks,
                Progress &progress)
        : set_(set), random_(seed), points_(set.draw(set.dimension, n_points, random_)), progress_(progress) {
        begin_.name = fmt::format("{}_{}d", set.name, set.dimension);
        begin_.dimension = set.dimension;
        begin_.n_points = points_.positions.size() / set.dimension;
        begin_.positions = points_.positions;
        if (begin_.n_points > most_points_compared) return;
        checks.emplace_back();
        checks_ = &checks.back();
        checks_->scenario = begin_.name;
        checks_->n_points = begin_.n_points;
    }

    std::vector<StructuredLine> run() {
        std::vector<StructuredLine> lines = {build()};
        for (const Motion motion : set_.motions) lines.push_back(move(motion));
        return lines;
    }

private:
    StructuredLine line(const char *timed, double cgal_seconds, double deldrift_seconds) const {
        const double scale = 1e9 / static_cast<double>(begin_.n_points);
        return {set_.dimension, set_.name,   begin_.n_points, timed, scale * cgal_seconds, scale * deldrift_seconds};
    }

    StructuredLine build() {
        const std::vector<Entrant> entrants = {{&engine_kind("cgal/rebuilding"), 1, {1}},
                                               {&engine_kind("deldrift/auto"), 1, {1}}};
        const std::vector<Row> rows = measure_build(begin_, entrants, n_builds, progress_);
        if (checks_ != nullptr) Referee(begin_, 0, *checks_);
        return line("build", rows[0].seconds, rows[1].seconds);
    }

    /// The last timestamp, which is there, is for the comparison.
    StructuredLine move(Motion motion) {
        const bool is_large = begin_.n_points > most_points_compared;
        const std::size_t last_timed = n_warm + 2 * (is_large ? n_rounds_of_large : n_rounds);
        const Series series = there_and_back(motion, last_timed + 1);
        const std::vector<Entrant> entrants = {
            {&engine_kind("cgal/rebuilding"), 1, timestamps_between(n_warm + 1, last_timed)},
            {&engine_kind("deldrift/auto"), 1, timestamps_between(1, last_timed + 1)}};
        std::vector<Lane> lanes = lanes_of(entrants);
        for (Lane &lane : lanes) lane.restart(series.dimension);
        Replay replay(series);
        progress_.begin(fmt::format("{}: timing commits ({})", series.name, name_of(motion)), 1);
        const bool is_slow = run_rounds(replay, lanes, last_timed);
        const StructuredLine result = line(name_of(motion), seconds_of(lanes[0]), seconds_of(lanes[1]));
        if (!is_slow) replay.run_block(lanes[1], last_timed + 1, last_timed + 1, [](std::size_t) {});
        check(series, lanes[1].timestamp, entrants[1], *lanes[1].engine);
        progress_.step();
        return result;
    }

    /// There and back in turns, until it is enough. Whether deldrift was too slow for that.
    bool run_rounds(Replay &replay, std::vector<Lane> &lanes, std::size_t last_timed) {
        const std::size_t turn = 2 * ((block_length(begin_) + 1) / 2);
        replay.run_block(lanes[1], 1, n_warm, [](std::size_t) {});
        for (std::size_t first = n_warm + 1; first <= last_timed; first += turn) {
            const std::size_t last = std::min(first + turn - 1, last_timed);
            const bool is_slow = total_seconds(lanes[1]) > most_seconds;
            if (first == n_warm + 1 || !is_slow) replay.run_block(lanes[0], first, last, [](std::size_t) {});
            if (is_slow) return true;
            replay.run_block(lanes[1], first, last, [](std::size_t) {});
        }
        return false;
    }

    static std::vector<std::size_t> timestamps_between(std::size_t first, std::size_t last) {
        std::vector<std::size_t> timestamps(last - first + 1);
        std::iota(timestamps.begin(), timestamps.end(), first);
        return timestamps;
    }

    Series there_and_back(Motion motion, std::size_t n_timestamps) {
        Series series = begin_;
        const std::vector<double> there = moved(points_, set_.dimension, motion, random_);
        for (std::size_t timestamp = 1; timestamp <= n_timestamps; ++timestamp) {
            const std::vector<double> &frame = timestamp % 2 == 1 ? there : begin_.positions;
            series.positions.insert(series.positions.end(), frame.begin(), frame.end());
        }
        return series;
    }

    void check(const Series &series, std::size_t timestamp, const Entrant &entrant, Engine &engine) {
        if (checks_ == nullptr)
            engine.validate();
        else
            Referee(series, timestamp, *checks_).judge(entrant, engine);
    }

    /// The mean of the way there and the way back, each a median; the warm-up's where there is nothing else.
    static double seconds_of(const Lane &lane) {
        std::vector<double> ways[2];
        const std::size_t n_left_out = lane.seconds.rbegin()->first > n_warm ? n_warm : 0;
        for (const auto &[timestamp, repeats] : lane.seconds)
            if (timestamp > n_left_out) ways[timestamp % 2].push_back(repeats.front());
        return (median(ways[0]) + median(ways[1])) / 2;
    }

    static double total_seconds(const Lane &lane) {
        double sum = 0;
        for (const auto &[timestamp, repeats] : lane.seconds) sum += repeats.front();
        return sum;
    }

    const PointSet &set_;
    Random random_;
    SolverPoints points_;
    Series begin_;
    Checks *checks_ = nullptr;
    Progress &progress_;
};

/// Sets of five random points, created and destroyed: what a triangulation costs that is as good as empty.
template <unsigned dimension>
StructuredLine measure_small_sets(std::uint64_t seed) {
    using Space = CgalSpace<dimension>;
    Random random(seed);
    deldrift_options options;
    deldrift_options_init(&options);
    options.threads = 1;
    const auto create_and_destroy = [&](const double *positions) {
        deldrift_triangulation *triangulation = nullptr;
        require(deldrift_create(dimension, positions, points_of_small_set, &options, &triangulation),
                "deldrift_create");
        deldrift_destroy(triangulation);
    };
    std::vector<double> cgal_seconds, deldrift_seconds;
    for (std::size_t turn = 0; turn < n_turns_of_small_sets; ++turn) {
        std::vector<std::vector<double>> sets(small_sets_at_a_turn);
        std::vector<std::vector<typename Space::InputPoint>> inputs;
        for (std::vector<double> &positions : sets) {
            for (std::size_t i = 0; i < points_of_small_set * dimension; ++i) positions.push_back(random.unit());
            inputs.push_back(input_points<dimension>(positions.data(), points_of_small_set));
        }
        const Stopwatch cgal_watch;
        for (auto &input : inputs) {
            typename Space::Triangulation triangulation;
            insert_range<dimension>(triangulation, input);
        }
        cgal_seconds.push_back(cgal_watch.seconds());
        const Stopwatch deldrift_watch;
        for (const std::vector<double> &positions : sets) create_and_destroy(positions.data());
        deldrift_seconds.push_back(deldrift_watch.seconds());
    }
    const double scale = 1e9 / small_sets_at_a_turn;
    return {dimension,        "random", points_of_small_set, "create_destroy", scale * median(cgal_seconds),
            scale * median(deldrift_seconds)};
}

/// The lines of one set, by what was timed.
struct Group {
    const StructuredLine *any;
    std::map<std::string, const StructuredLine *> lines;

    std::string title() const { return fmt::format("{}D {}", any->dimension, any->points); }

    /// Two entries of a table.
    void add_to(std::vector<std::string> &entries, const char *timed) const {
        const auto line = lines.find(timed);
        const bool is_there = line != lines.end();
        entries.push_back(is_there ? significant(line->second->deldrift_ns, 3) : "-");
        entries.push_back(is_there ? significant(line->second->ratio(), 3) : "-");
    }

    void add_cgal_to(std::vector<std::string> &entries, const char *timed) const {
        entries.push_back(significant(lines.at(timed)->cgal_ns, 3));
    }
};

std::vector<Group> groups_of(const std::vector<StructuredLine> &lines) {
    std::vector<Group> groups;
    for (const StructuredLine &line : lines) {
        if (line.timed == "build" || line.timed == "create_destroy") groups.push_back({&line, {}});
        groups.back().lines[line.timed] = &line;
    }
    return groups;
}

}  // namespace

std::vector<StructuredLine> measure_point_set(const PointSet &set, std::size_t n_points, std::uint64_t seed,
                                              std::vector<Checks> &checks, Progress &progress) {
    return Measurement(set, n_points, seed, checks, progress).run();
}

std::vector<StructuredLine> measure_structured(const Preset &preset, const std::vector<std::string> &chosen,
                                               std::uint64_t seed, std::vector<Checks> &checks, Progress &progress) {
    std::vector<StructuredLine> all;
    for (const PointSet &set : point_sets()) {
        const bool is_wanted = chosen.empty() ? set.is_telling || preset.has_all_point_sets
                                              : std::find(chosen.begin(), chosen.end(), set.name) != chosen.end();
        if (!is_wanted) continue;
        for (const std::size_t n_points : preset.structured_sizes) {
            const std::vector<StructuredLine> lines = measure_point_set(set, n_points, seed, checks, progress);
            all.insert(all.end(), lines.begin(), lines.end());
        }
    }
    all.push_back(measure_small_sets<2>(seed));
    all.push_back(measure_small_sets<3>(seed));
    return all;
}

void print_structured(std::ostream &out, const std::vector<StructuredLine> &lines) {
    TextTable meshes({"structured, ns/vertex", "n", "CGAL build", "build", "x", "CGAL, shifted", "rigid", "x",
                      "CGAL, sheared", "shear", "x", "CGAL at rest", "rest", "x"});
    TextTable clouds({"bulk motion, ns/vertex", "n", "CGAL, moved", "translation", "x", "rotation", "x", "1 % teleport",
                      "x", "half by 0.01", "x", "scaling", "x"});
    TextTable small({"created and destroyed", "n", "CGAL, us/set", "deldrift", "x"});
    bool has_clouds = false;
    for (const Group &group : groups_of(lines)) {
        std::vector<std::string> entries = {group.title(), fmt::to_string(group.any->n)};
        if (group.any->timed == "create_destroy") {
            entries.push_back(significant(group.any->cgal_ns / 1'000, 3));
            entries.push_back(significant(group.any->deldrift_ns / 1'000, 3));
            entries.push_back(significant(group.any->ratio(), 3));
            small.add(entries);
            continue;
        }
        std::vector<std::string> cloud = entries;
        for (const char *timed : {"build", "rigid", "shear", "rest"}) {
            group.add_cgal_to(entries, timed);
            group.add_to(entries, timed);
        }
        meshes.add(entries);
        if (group.lines.count("translation") == 0) continue;
        group.add_cgal_to(cloud, "translation");
        for (const char *timed : {"translation", "rotation", "teleport", "half", "scaling"}) group.add_to(cloud, timed);
        clouds.add(cloud);
        has_clouds = true;
    }
    meshes.print(out);
    out << '\n';
    if (has_clouds) {
        clouds.print(out);
        out << '\n';
    }
    small.print(out);
}

std::string structured_name(const Preset &preset) {
    return preset.has_all_point_sets ? "structured_full" : "structured";
}

std::string write_structured(const std::string &folder, const Preset &preset,
                             const std::vector<StructuredLine> &lines) {
    std::vector<std::vector<std::string>> all = {
        {"dimension", "points", "n", "timed", "cgal_ns", "deldrift_ns", "ratio"}};
    for (const StructuredLine &line : lines)
        all.push_back(line_of(line.dimension, line.points, line.n, line.timed, significant(line.cgal_ns, 4),
                              significant(line.deldrift_ns, 4), significant(line.ratio(), 3)));
    const std::string path = folder + "/" + structured_name(preset) + ".csv";
    write_csv(path, all);
    return path;
}

void run_structured(const Options &options) {
    keep_memory();
    Progress progress;
    std::vector<Checks> checks;
    const std::vector<StructuredLine> lines =
        measure_structured(options.preset, options.point_sets, options.seed, checks, progress);
    print_structured(std::cout, lines);
    std::cout << '\n';
    print_checks(std::cout, checks);
    std::cout << '\n';
    std::filesystem::create_directories(options.results);
    std::cout << "written: " << write_structured(options.results, options.preset, lines) << '\n';
}

}  // namespace bench
