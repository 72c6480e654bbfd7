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
Usage usage_of(const EngineKind &kind, unsigned dimension, std::uint64_t seed, bool with_commit) {
    Series series = uniform_points(dimension, n_points, seed);
    const std::unique_ptr<Engine> engine = kind.make(dimension, 1);
    engine->prepare(series.frame(0), n_points);
    Usage usage{};
    usage.resident_before = resident_bytes();
    const double before = allocated_bytes();
    engine->build(series.frame(0), n_points);
    if (with_commit) {
        const double spacing = std::pow(static_cast<double>(n_points), -1.0 / dimension);
        Random random(seed + 1);
        for (double &coordinate : series.positions) coordinate += random.symmetric(displacement * spacing);
        engine->prepare(series.frame(0), n_points);
        engine->advance(series.frame(0));
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
        bool with_commit;
    };
    const Case cases[] = {{"cgal/rebuilding", false},  {"cgal/move", false},        {"deldrift/rebuilding", false},
                          {"deldrift/rebuilding", true}, {"deldrift/placement", true}, {"deldrift/auto", true}};

    std::vector<std::vector<std::string>> lines = {{"dimension", "n", "engine", "algorithm", "state",
                                                    "allocated_bytes_per_vertex", "reported_bytes_per_vertex",
                                                    "peak_resident_bytes_per_vertex"}};
    Progress progress;
    progress.begin("memory: a million points in both dimensions", 2 * std::size(cases));
    for (const unsigned dimension : {2u, 3u})
        for (const Case &one : cases) {
            const EngineKind &kind = engine_kind(one.engine);
            const auto outcome =
                run_in_child([&] { return usage_of(kind, dimension, options.seed, one.with_commit); });
            const Usage &usage = outcome.result;
            lines.push_back({std::to_string(dimension), std::to_string(n_points), kind.engine, kind.algorithm,
                             one.with_commit ? "after_commit" : "built", per_vertex(usage.allocated),
                             usage.reported > 0 ? per_vertex(usage.reported) : "",
                             per_vertex(static_cast<double>(outcome.peak_resident_bytes) - usage.resident_before)});
            progress.step(kind.name());
        }

    publish(options.results, "memory.csv", lines);
}

}  // namespace bench
