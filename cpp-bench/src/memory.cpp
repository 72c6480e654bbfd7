// SPDX-License-Identifier: GPL-3.0-or-later
#include "child.hpp"
#include "engine.hpp"
#include "progress.hpp"
#include "random.hpp"
#include "resources.hpp"
#include "scenarios.hpp"
#include "table.hpp"

#include <malloc.h>

#include <cmath>
#include <fstream>

namespace bench {
namespace {

constexpr std::size_t n_points = 1'000'000;

/// Length of the displacement of the commit, as a share of the spacing.
constexpr double displacement = 0.01;

/// What has been done.
enum class State {
    built,
    after_commit,
    after_reading,  // the cells read, a commit, and the cells read again
    after_steps,    // likewise, with the changes taken
};

const char *const state_names[] = {"built", "after_commit", "after_reading", "after_steps"};

struct Usage {
    double allocated;  // by malloc, kept after the call
    double reported;   // by the library itself
    double resident_before;
};

double allocated_bytes() {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
}

double resident_bytes() {
    std::ifstream statm("/proc/self/statm");
    double total = 0;
    double resident = 0;
    if (!(statm >> total >> resident)) throw std::runtime_error("/proc/self/statm cannot be read");
    return resident * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

/// What the engine holds after the build, or after a commit that moves every point. The engine's own input is
/// laid out before counting begins: a user has it anyway.
Usage usage_of(const EngineKind &kind, unsigned dimension, std::uint64_t seed, State state) {
    Series series = uniform_points(dimension, n_points, seed);
    const std::unique_ptr<Engine> engine = kind.make(dimension, 1);
    engine->prepare(series.frame(0), n_points);
    Usage usage{};
    usage.resident_before = resident_bytes();
    const double before = allocated_bytes();
    const bool is_read = state == State::after_reading || state == State::after_steps;
    if (state == State::after_steps) engine->expect_readings();
    engine->build(series.frame(0), n_points);
    if (is_read) engine->read();
    if (state != State::built) {
        const double spacing = std::pow(static_cast<double>(n_points), -1.0 / dimension);
        Random random(seed + 1);
        for (double &coordinate : series.positions) coordinate += random.symmetric(displacement * spacing);
        engine->prepare(series.frame(0), n_points);
        engine->advance(series.frame(0));
        if (is_read) engine->read();
    }
    usage.allocated = allocated_bytes() - before;
    usage.reported = static_cast<double>(engine->reported_bytes());
    return usage;
}

std::string per_vertex(double bytes) { return significant(bytes / n_points, 4); }

}  // namespace

void run_memory(const Options &options) {
    struct Case {
        const char *engine;
        State state;
    };
    const Case cases[] = {
        {"cgal/rebuilding", State::built},          {"cgal/move", State::built},
        {"deldrift/rebuilding", State::built},      {"deldrift/rebuilding", State::after_commit},
        {"deldrift/placement", State::after_commit}, {"deldrift/auto", State::after_commit},
        {"deldrift/auto", State::after_reading},    {"deldrift/auto", State::after_steps},
    };

    std::vector<std::vector<std::string>> lines = {{"dimension", "n", "engine", "algorithm", "state",
                                                    "allocated_bytes_per_vertex", "reported_bytes_per_vertex",
                                                    "peak_resident_bytes_per_vertex"}};
    Progress progress;
    progress.begin("memory: a million points in both dimensions", 2 * std::size(cases));
    for (const unsigned dimension : {2u, 3u})
        for (const Case &one : cases) {
            const EngineKind &kind = engine_kind(one.engine);
            const auto outcome =
                run_in_child([&] { return usage_of(kind, dimension, options.seed, one.state); });
            const Usage &usage = outcome.result;
            lines.push_back(line_of(dimension, n_points, kind.engine, kind.algorithm,
                                    state_names[static_cast<std::size_t>(one.state)], per_vertex(usage.allocated),
                                    usage.reported > 0 ? per_vertex(usage.reported) : "",
                                    per_vertex(static_cast<double>(outcome.peak_resident_bytes) -
                                               usage.resident_before)));
            progress.step(kind.name());
        }

    publish(options.results, "memory.csv", lines);
}

}  // namespace bench
