// SPDX-License-Identifier: GPL-3.0-or-later
#include "referee.hpp"

#include "arbiter.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace bench {

Referee::Referee(const Series &series, std::size_t timestamp, Checks &checks)
    : series_(series),
      timestamp_(timestamp),
      checks_(checks),
      representatives_(representatives(series.dimension, series.frame(timestamp), series.n_points)),
      cgal_(fresh("cgal/rebuilding")),
      deldrift_(fresh("deldrift/rebuilding")) {
    checks_.n_degenerate += require_equivalent(deldrift_, "a fresh deldrift build");
    checks_.n_cells += deldrift_.size();
    ++checks_.n_timestamps;
    std::size_t n_coincident = 0;
    for (std::size_t id = 0; id < representatives_.size(); ++id) n_coincident += representatives_[id] != id;
    checks_.n_coincident = std::max(checks_.n_coincident, n_coincident);
}

void Referee::judge(const Entrant &entrant, Engine &engine) {
    const CellSet cells = cells_of(engine, entrant.name());
    if (entrant.kind->engine == "deldrift") {
        require_equal(cells, entrant.name());
    } else if (entrant.kind->is_reproduction && series_.dimension == 3 && cells != cgal_) {
        const GapVerdict verdict = gap_cells(series_.frame(timestamp_), cells, cgal_);
        if (verdict.is_explained)
            checks_.n_unproved[entrant.name()] += verdict.n_cells;
        else
            require_equivalent(cells, entrant.name());
    } else {
        require_equivalent(cells, entrant.name());
    }
    ++checks_.n_comparisons;
}

CellSet Referee::fresh(const std::string &name) {
    const std::unique_ptr<Engine> engine = engine_kind(name).make(series_.dimension, 1);
    engine->prepare(series_.frame(timestamp_), series_.n_points);
    engine->build(series_.frame(timestamp_), series_.n_points);
    return cells_of(*engine, "a fresh " + name);
}

CellSet Referee::cells_of(Engine &engine, const std::string &name) {
    try {
        engine.validate();
        return canonical(series_.dimension, engine.cells(), representatives_);
    } catch (const std::runtime_error &error) {
        fail(name + ": " + error.what());
    }
}

void Referee::require_equal(const CellSet &cells, const std::string &name) {
    if (cells == deldrift_) return;
    const CellSet extra = difference(cells, deldrift_);
    const CellSet missing = difference(deldrift_, cells);
    fail(fmt::format("{} has {} cells that a fresh deldrift build has not, and lacks {}, beginning with {}", name,
                     extra.size(), missing.size(), to_string(extra.empty() ? missing.front() : extra.front())));
}

std::size_t Referee::require_equivalent(const CellSet &cells, const std::string &name) {
    const Verdict verdict =
        compare(series_.dimension, series_.frame(timestamp_), cells, name, cgal_, "CGAL's rebuilding");
    if (!verdict.is_accepted) fail(verdict.complaint);
    return verdict.n_degenerate;
}

void Referee::fail(const std::string &what) const {
    throw Mismatch(fmt::format("{}, timestamp {}: {}", series_.name, timestamp_, what), timestamp_);
}

}  // namespace bench
