// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_input.hpp"

#include "npy.hpp"
#include "report_scenarios.hpp"
#include "scenarios.hpp"
#include "report_statistics.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace bench {
namespace {

/// Raise this when a recording changes, so that older files are not taken for it.
constexpr unsigned recording_version = 1;

bool begins_with(const std::string &text, const std::string &beginning) {
    return text.compare(0, beginning.size(), beginning) == 0;
}

bool is_segmented(const std::string &scenario) {
    return begins_with(scenario, "share_") || begins_with(scenario, "walk_");
}

unsigned dimension_of(const std::string &scenario) {
    return begins_with(scenario, "lloyd_2d") || scenario == "share_2d" || scenario == "walk_2d" ? 2 : 3;
}

/// From far below to far above the tolerances of random points, which are about 0.01 in the plane and 0.002
/// in space.
std::vector<double> share_displacements(unsigned dimension) {
    std::vector<double> displacements;
    const double least = dimension == 2 ? 2e-5 : 2e-6;
    const double greatest = dimension == 2 ? 0.2 : 0.05;
    constexpr int n = 15;
    for (int i = 0; i < n; ++i) displacements.push_back(least * std::pow(greatest / least, i / (n - 1.0)));
    return displacements;
}

/// The report's percentages of the average tolerance.
const std::vector<double> walk_percentages = {2, 5, 10, 15, 20, 30, 40, 60, 80, 100, 150, 200, 300};

std::vector<double> walk_displacements(unsigned dimension, std::size_t n_points, std::uint64_t seed) {
    Progress silent(Progress::Output::silent);
    const Series start = record_segments("walk", dimension, n_points, {0.001}, 1, seed, silent);
    const double average = mean_tolerance(start, 0);
    std::vector<double> displacements;
    for (const double percentage : walk_percentages) displacements.push_back(percentage / 100 * average);
    return displacements;
}

Body load_body(const std::string &folder) {
    const std::string path = folder + "/man.off";
    if (std::filesystem::exists(path)) return Body::load(path);
    std::cerr << "man: " << path << " is missing (cpp-bench/report/fetch_man gets it from Debian's libcgal-demo); a "
              << "generated body takes its place\n";
    return Body::generate();
}

Series record(const std::string &scenario, const Options &options, const ReportEffort &effort,
              const std::optional<Body> &body, Progress &progress) {
    const std::size_t n = effort.n_points, length = effort.n_timestamps;
    const unsigned dimension = dimension_of(scenario);
    if (scenario == "lloyd_2d_uniform") return record_lloyd_2d_uniform(n, length, options.seed, progress);
    if (scenario == "slloyd") return record_slloyd(n, length, options.seed, progress);
    if (scenario == "snodt") return record_snodt(n, length, options.seed, progress);
    if (scenario == "man") return record_man(*body, n, length, options.seed, progress);
    if (begins_with(scenario, "share_"))
        return record_segments(scenario, dimension, n, share_displacements(dimension), length, options.seed,
                               progress);
    if (begins_with(scenario, "walk_"))
        return record_segments(scenario, dimension, n, walk_displacements(dimension, n, options.seed), length,
                               options.seed, progress);
    for (const Density &density : lloyd_densities())
        if (density.name == scenario) return record_lloyd_2d(density, n, length, options.seed, progress);
    throw std::runtime_error("no input is called " + scenario);
}

}  // namespace

ReportEffort report_effort(const std::string &scenario, const Options &options) {
    const bool is_full = options.preset.name == "full";
    const unsigned dimension = dimension_of(scenario);
    ReportEffort effort{};
    effort.n_checks = is_full ? 10 : 5;
    // Large inputs are replayed once: their updates are long enough for disturbances to even out.
    const bool is_large = dimension == 3 && (is_full || scenario == "share_3d") && scenario != "walk_3d";
    effort.n_repeats = is_large ? 1 : 3;
    effort.n_slow_timestamps = is_full ? 20 : 10;
    if (begins_with(scenario, "lloyd_2d")) {
        effort.n_points = 1'000;
        effort.n_timestamps = 1'000;
    } else if (begins_with(scenario, "share_")) {
        effort.n_points = is_full || dimension == 2 ? 10'000 : 3'000;
        effort.n_timestamps = is_full ? 10 : 3;
        effort.n_slow_timestamps = is_full ? 3 : 1;
    } else if (begins_with(scenario, "walk_")) {
        effort.n_points = 1'000;
        effort.n_timestamps = effort.n_slow_timestamps = 10;
    } else {
        effort.n_points =
            is_full ? (scenario == "man" ? 8'000 : 13'000) : (scenario == "man" ? 2'000 : 3'000);
        effort.n_timestamps = is_full ? 1'000 : 100;
    }
    if (options.preset.name == "smoke") {
        effort = {400, is_segmented(scenario) ? std::size_t{2} : std::size_t{12}, 2, 2, 1};
    }
    if (options.report_timestamps > 0 && !is_segmented(scenario))
        effort.n_timestamps = options.report_timestamps;
    return effort;
}

ReportInput report_input(const std::string &scenario, const Options &options, Progress &progress) {
    const ReportEffort effort = report_effort(scenario, options);
    ReportInput input;
    if (scenario == "man") input.body = load_body(options.data);

    const std::string body = input.body ? (input.body->name() == "man.off" ? "_man_off" : "_generated") : "";
    const std::string path = fmt::format("{}/series/{}{}_{}_{}_seed_{}_v{}.npy", options.results, scenario, body,
                                         effort.n_points, effort.n_timestamps, options.seed, recording_version);
    if (!is_segmented(scenario) && std::filesystem::exists(path)) {
        input.series = load_series(path);
        input.series.name = scenario;
        input.series.is_sequential = scenario == "snodt" || scenario == "man";
    } else {
        input.series = record(scenario, options, effort, input.body, progress);
        if (!is_segmented(scenario)) {
            std::filesystem::create_directories(options.results + "/series");
            write_npy(path + ".new",
                      {{input.series.n_frames(), input.series.n_points, input.series.dimension},
                       input.series.positions});
            std::filesystem::rename(path + ".new", path);
        }
    }
    if (input.body) {
        input.body->scale_to_volume(static_cast<double>(effort.n_points));
        input.series.remark = "body: " + input.body->name();
    }
    return input;
}

}  // namespace bench
