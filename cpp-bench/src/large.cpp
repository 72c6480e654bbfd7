// SPDX-License-Identifier: GPL-3.0-or-later
#include "child.hpp"
#include "progress.hpp"
#include "random.hpp"
#include "resources.hpp"
#include "scenarios.hpp"
#include "table.hpp"

#include <deldrift.h>

#include <chrono>
#include <cmath>

namespace bench {
namespace {

constexpr std::uint32_t full_validation = 3;

/// Length of the displacement of the commit, as a share of the spacing.
constexpr double displacement = 0.01;

struct Timings {
    double build;
    double validate;
    double commit;
    double validate_again;
    double n_cells;
    double reported_bytes;
};

class LargeRun {
public:
    LargeRun(unsigned dimension, std::size_t n_points, unsigned n_threads, std::uint64_t seed)
        : dimension_(dimension), n_threads_(n_threads), seed_(seed),
          title_(fmt::format("{} points in {}D: ", n_points, dimension)),
          series_(uniform_points(dimension, n_points, seed)) {}
    ~LargeRun() { deldrift_destroy(triangulation_); }
    LargeRun(const LargeRun &) = delete;
    LargeRun &operator=(const LargeRun &) = delete;

    Timings run() {
        Timings timings{};
        timings.build = timed("build", [&] { return build(); });
        timings.validate = timed("validate", [&] { return deldrift_validate(triangulation_, full_validation); });
        displace();
        timings.commit = timed("commit", [&] { return commit(); });
        timings.validate_again =
            timed("validate again", [&] { return deldrift_validate(triangulation_, full_validation); });
        std::size_t count = 0;
        require(deldrift_cell_count(triangulation_, &count));
        timings.n_cells = static_cast<double>(count);
        require(deldrift_memory_bytes(triangulation_, &count));
        timings.reported_bytes = static_cast<double>(count);
        return timings;
    }

private:
    static void require(deldrift_status status) {
        if (status != DELDRIFT_OK) throw std::runtime_error(deldrift_last_error());
    }

    static void show_progress(void *progress, double fraction) { static_cast<Progress *>(progress)->set(fraction); }

    deldrift_status build() {
        deldrift_options options;
        deldrift_options_init(&options);
        options.threads = n_threads_;
        options.progress = show_progress;
        options.user_data = &progress_;
        return deldrift_create(dimension_, series_.frame(0), series_.n_points, &options, &triangulation_);
    }

    deldrift_status commit() {
        const deldrift_status status =
            deldrift_move_vertices(triangulation_, nullptr, series_.frame(0), series_.n_points);
        return status == DELDRIFT_OK ? deldrift_commit_timestamp(triangulation_, nullptr) : status;
    }

    void displace() {
        const double spacing = std::pow(static_cast<double>(series_.n_points), -1.0 / dimension_);
        Random random(seed_ + 1);
        for (double &coordinate : series_.positions) coordinate += random.symmetric(displacement * spacing);
    }

    template <typename Step>
    double timed(const std::string &what, Step step) {
        progress_.begin(title_ + what, 1);
        const auto start = std::chrono::steady_clock::now();
        require(step());
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    unsigned dimension_;
    unsigned n_threads_;
    std::uint64_t seed_;
    std::string title_;
    Series series_;
    Progress progress_;
    deldrift_triangulation *triangulation_ = nullptr;
};

}  // namespace

void run_large(const Options &options) {
    std::vector<std::vector<std::string>> lines = {{"dimension", "n", "threads", "cells", "build_seconds",
                                                    "validate_seconds", "commit_seconds", "validate_again_seconds",
                                                    "reported_bytes_per_vertex", "peak_resident_gib"}};
    const auto gib = [](std::size_t bytes) { return static_cast<double>(bytes) / (1 << 30); };
    for (const unsigned dimension : {2u, 3u}) {
        const std::size_t n_points = dimension == 2 ? options.large_points_2d : options.large_points_3d;
        if (n_points == 0) continue;
        for (const unsigned n_threads : options.threads) {
            const auto outcome =
                run_in_child([&] { return LargeRun(dimension, n_points, n_threads, options.seed).run(); });
            const Timings &timings = outcome.result;
            lines.push_back(line_of(dimension, n_points, n_threads, static_cast<std::size_t>(timings.n_cells),
                                    significant(timings.build, 4), significant(timings.validate, 4),
                                    significant(timings.commit, 4), significant(timings.validate_again, 4),
                                    significant(timings.reported_bytes / static_cast<double>(n_points), 4),
                                    significant(gib(outcome.peak_resident_bytes), 4)));
        }
    }
    publish(options.results, "large.csv", lines);
}

}  // namespace bench
