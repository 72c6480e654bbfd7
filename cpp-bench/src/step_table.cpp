// SPDX-License-Identifier: GPL-3.0-or-later
#include "step_table.hpp"

#include "replay.hpp"
#include "replay_in_turns.hpp"
#include "scenarios.hpp"
#include "step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace bench {
namespace {

const std::vector<double> table_displacements = {0, 1e-5, 1e-3, 1e-2};

/// Inputs of more points are replayed once only, ...
constexpr std::size_t most_points_repeated = 1'000;
/// ... and of those of more the cells are compared once only.
constexpr std::size_t most_points_checked = 10'000;

std::vector<Entrant> entrants_of(const Series &series, const std::vector<const EngineKind *> &kinds) {
    std::vector<Entrant> entrants;
    for (const EngineKind *kind : kinds) entrants.push_back({kind, 1, all_timestamps(series, !kind->is_stateless)});
    return entrants;
}

std::vector<std::size_t> checked_timestamps(const Series &series) {
    if (series.n_points > most_points_checked) return {series.segments.back().last};
    std::vector<std::size_t> timestamps;
    for (const Segment &segment : series.segments) timestamps.push_back(segment.last);
    return timestamps;
}

double median_of(const UpdateTimes &times, const Segment &segment) {
    std::vector<double> seconds;
    for (auto at = times.lower_bound(segment.first); at != times.end() && at->first <= segment.last; ++at)
        seconds.push_back(at->second);
    return median(seconds);
}

}  // namespace

std::size_t step_timestamps(std::size_t n_points) {
    return std::clamp<std::size_t>(100'000 / std::max<std::size_t>(1, n_points), 5, 50);
}

std::vector<std::vector<double>> replay_displacements(const std::string &name, unsigned dimension,
                                                      std::size_t n_points, const std::vector<double> &displacements,
                                                      const std::vector<const EngineKind *> &kinds,
                                                      unsigned n_repeats, std::uint64_t seed, Checks &checks,
                                                      Progress &progress) {
    const Series series = record_segments(name + (dimension == 2 ? "_2d" : "_3d"), dimension, n_points, displacements,
                                          step_timestamps(n_points), seed, progress);
    checks.scenario = series.name;
    checks.n_points = n_points;
    const std::vector<UpdateTimes> times =
        replay_in_turns(series, entrants_of(series, kinds), checked_timestamps(series),
                      n_points > most_points_repeated ? 1 : n_repeats, checks, progress);
    std::vector<std::vector<double>> ns;
    for (const Segment &segment : series.segments) {
        ns.emplace_back();
        for (const UpdateTimes &of_kind : times)
            ns.back().push_back(1e9 * median_of(of_kind, segment) / static_cast<double>(n_points));
    }
    return ns;
}

std::vector<StepLine> measure_steps(unsigned dimension, std::size_t n_points, unsigned n_repeats, std::uint64_t seed,
                                    Checks &checks, Progress &progress) {
    const auto ns = replay_displacements(
        "step", dimension, n_points, table_displacements,
        {&step_kind("cgal/rebuilding"), &engine_kind("deldrift/auto"), &step_kind("deldrift/auto")}, n_repeats, seed,
        checks, progress);
    std::vector<StepLine> lines;
    for (std::size_t i = 0; i < ns.size(); ++i)
        lines.push_back({dimension, n_points, table_displacements[i], step_timestamps(n_points), ns[i][0], ns[i][1],
                         ns[i][2]});
    return lines;
}

std::string displacement_name(double displacement) {
    return displacement == 0 ? "0" : fmt::format("1e-{}", std::lround(-std::log10(displacement)));
}

std::vector<Row> rows_of(const StepLine &line) {
    const auto row = [&](const EngineKind &kind, double ns) {
        Row row;
        row.scenario = (line.dimension == 2 ? "step_2d_" : "step_3d_") + displacement_name(line.displacement);
        row.dimension = line.dimension;
        row.n = line.n;
        row.timestamps = line.timestamps;
        row.engine = kind.engine;
        row.algorithm = kind.algorithm;
        row.seconds = 1e-9 * ns * static_cast<double>(line.n * line.timestamps);
        if (kind.is_step) row.timed = "step", row.speedup = line.cgal_step / ns;
        return row;
    };
    return {row(step_kind("cgal/rebuilding"), line.cgal_step), row(engine_kind("deldrift/auto"), line.commit),
            row(step_kind("deldrift/auto"), line.step)};
}

void print_steps(std::ostream &out, const std::vector<StepLine> &lines) {
    TextTable table({"dimension", "n", "step, spacings", "CGAL step, ns/vertex", "commit alone", "step",
                     "step / commit", "x CGAL step"});
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const StepLine &line = lines[i];
        if (i == 0 || line.dimension != lines[i - 1].dimension || line.n != lines[i - 1].n) table.add({});
        table.add(line_of(line.dimension, line.n, displacement_name(line.displacement), significant(line.cgal_step, 3),
                          significant(line.commit, 3), significant(line.step, 3),
                          significant(line.step / line.commit, 3), significant(line.cgal_step / line.step, 3)));
    }
    table.print(out);
}

}  // namespace bench
