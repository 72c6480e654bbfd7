// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify.hpp"

#include "referee.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace bench {
namespace {

constexpr std::size_t nowhere = SIZE_MAX;

struct Runner {
    const Entrant *entrant;
    std::unique_ptr<Engine> engine;
    std::size_t timestamp = nowhere;

    /// Brings the engine to the timestamp by the shortest honest way: one update from the timestamp before.
    void bring_to(const Series &series, std::size_t wanted) {
        if (timestamp != wanted - 1) build(series, wanted - 1);
        engine->prepare(series.frame(wanted), series.n_points);
        engine->advance(series.frame(wanted));
        timestamp = wanted;
    }

    void build(const Series &series, std::size_t wanted) {
        engine->prepare(series.frame(wanted), series.n_points);
        engine->build(series.frame(wanted), series.n_points);
        timestamp = wanted;
    }
};

bool contains(const std::vector<std::size_t> &ascending, std::size_t value) {
    return std::binary_search(ascending.begin(), ascending.end(), value);
}

/// An engine that takes part in every timestamp must live through all of them; one that is rebuilt in between
/// anyway, or whose state has no history, is brought to the checked ones alone.
bool must_live_through(const Entrant &entrant, const Series &series) {
    return !entrant.kind->is_stateless && entrant.timestamps.size() == series.n_timestamps();
}

}  // namespace

std::string Entrant::name() const {
    return kind->name() + (n_threads > 1 ? fmt::format(" on {} threads", n_threads) : "");
}

Checks verify(const Series &series, const std::vector<Entrant> &entrants,
              const std::vector<std::size_t> &check_timestamps, Progress &progress) {
    Checks checks;
    checks.scenario = series.name;
    checks.n_points = series.n_points;

    std::vector<Runner> runners;
    for (const Entrant &entrant : entrants) {
        runners.push_back({&entrant, entrant.make(series.dimension)});
        runners.back().engine->be_examined();
    }

    progress.begin(fmt::format("{}: checking cells at {} of {} timestamps", series.name, check_timestamps.size(),
                               series.n_timestamps()),
                   series.n_timestamps());
    for (std::size_t timestamp = 1; timestamp <= series.n_timestamps(); ++timestamp) {
        const bool is_checked = contains(check_timestamps, timestamp);
        std::unique_ptr<Referee> referee;
        if (is_checked) referee = std::make_unique<Referee>(series, timestamp, checks);
        for (Runner &runner : runners) {
            const bool takes_part = contains(runner.entrant->timestamps, timestamp);
            if (!takes_part || !(is_checked || must_live_through(*runner.entrant, series))) continue;
            runner.bring_to(series, timestamp);
            if (is_checked) referee->judge(*runner.entrant, *runner.engine);
        }
        progress.step(fmt::format("timestamp {}", timestamp));
    }
    return checks;
}

Checks verify_build(const Series &series, Progress &progress) {
    Checks checks;
    checks.scenario = series.name;
    checks.n_points = series.n_points;
    progress.begin(fmt::format("{}: checking the cells of {} points", series.name, series.n_points), 1);
    const Referee referee(series, 0, checks);
    checks.n_comparisons = 1;
    return checks;
}

}  // namespace bench
