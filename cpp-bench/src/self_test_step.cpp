// SPDX-License-Identifier: GPL-3.0-or-later
// Readings and steps: what they tell is right, and what is wrong is found.
#include "cells.hpp"
#include "random.hpp"
#include "reading.hpp"
#include "scenarios.hpp"
#include "step.hpp"
#include "step_table.hpp"
#include "tests.hpp"
#include "verify.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <sstream>

namespace bench {
namespace {

/// Points that wander, over a grid where points are to be cocircular and coincident.
Series wandering_points(unsigned dimension, bool is_grid, double length) {
    Series series = uniform_points(dimension, 150, 11);
    Random random(12);
    for (std::size_t i = 0; i < 15 * series.n_points * dimension; ++i)
        series.positions.push_back(series.positions[i] + random.symmetric(length));
    if (is_grid)
        for (double &coordinate : series.positions) coordinate = std::floor(coordinate * 5);
    return series;
}

std::vector<std::size_t> every_timestamp(const Series &series) {
    std::vector<std::size_t> timestamps;
    for (std::size_t timestamp = 1; timestamp <= series.n_timestamps(); ++timestamp) timestamps.push_back(timestamp);
    return timestamps;
}

/// Every engine's arrays describe CGAL's cells, and what changes say leads from one reading to the next.
void test_readings(Tests &tests) {
    for (const unsigned dimension : {2u, 3u})
        for (const bool is_grid : {false, true})
            for (const double length : {0.0, 0.001, 0.1}) {
                const Series series = wandering_points(dimension, is_grid, length);
                const std::string what = "steps: " + series.name + (is_grid ? ", grid, " : ", random, ") +
                                         displacement_name(length);
                std::vector<EngineKind> kinds;
                for (const EngineKind &kind : engine_kinds())
                    if (!kind.is_reproduction) kinds.push_back(step_of(kind));
                std::vector<Entrant> entrants;
                for (const EngineKind &kind : kinds) entrants.push_back({&kind, 1, every_timestamp(series)});
                Progress progress(Progress::Output::silent);
                tests.expect_no_error(
                    [&] {
                        const Checks checks = verify(series, entrants, every_timestamp(series), progress);
                        tests.expect(checks.n_comparisons == entrants.size() * series.n_timestamps(),
                                     what + ": every reading is compared");
                    },
                    what);
            }
    tests.expect_error([] { engine_kind("cgal/tolerance").make(2, 1)->read(); }, "no readings",
                       "steps: the report's algorithms have none");
}

/// A square of two triangles.
struct Square {
    std::vector<std::uint32_t> vertices = {0, 1, 2, 0, 2, 3};
    std::vector<std::uint32_t> neighbours = {DELDRIFT_NONE, 1, DELDRIFT_NONE, DELDRIFT_NONE, DELDRIFT_NONE, 0};

    Reading reading(const deldrift_changes *changes = nullptr) const {
        return {vertices.size() / 3, vertices.data(), neighbours.data(), changes};
    }
};

void test_consistency(Tests &tests) {
    tests.expect_no_error([] { require_consistent(2, Square().reading()); }, "reading: a square is consistent");
    const auto expect = [&](std::size_t entry, std::uint32_t value, const char *message, const char *what) {
        Square square;
        square.neighbours[entry] = value;
        tests.expect_error([&] { require_consistent(2, square.reading()); }, message, std::string("reading: ") + what);
    };
    expect(1, 2, "no such neighbour", "a neighbour that does not exist");
    expect(0, 1, "has not the facet", "a neighbour across another facet");
    expect(5, DELDRIFT_NONE, "does not know", "a neighbour on one side only");
    Square torn;
    torn.neighbours.assign(6, DELDRIFT_NONE);
    tests.expect_error([&] { require_consistent(2, torn.reading()); }, "same facet", "reading: torn cells");
}

/// The diagonal of a square is flipped, and one cell more is renumbered by the way; then one of the changes is wrong.
void test_carried_data(Tests &tests) {
    struct Change {
        std::vector<std::uint32_t> created = {0, 2}, removed = {0, 1}, removed_vertices = {0, 1, 2, 0, 2, 3},
                                   from = {2}, to = {1}, stars = {0, 1, 2, 3}, hidden, shown;
    };
    const std::vector<std::uint32_t> before = {0, 1, 2, 0, 2, 3, 2, 1, 4}, after = {0, 1, 3, 2, 1, 4, 1, 2, 3};
    const auto follow = [&](const std::function<void(Change &)> &spoil) {
        Change change;
        spoil(change);
        deldrift_changes changes{};
        const auto tell = [](const std::vector<std::uint32_t> &list, std::size_t &count, const std::uint32_t *&at) {
            count = list.size();
            at = list.data();
        };
        tell(change.created, changes.created_count, changes.created);
        tell(change.removed, changes.removed_count, changes.removed);
        changes.removed_vertices = change.removed_vertices.data();
        tell(change.from, changes.renumbered_count, changes.renumbered_from);
        changes.renumbered_to = change.to.data();
        tell(change.stars, changes.star_count, changes.stars);
        tell(change.hidden, changes.hidden_count, changes.hidden);
        tell(change.shown, changes.shown_count, changes.shown);
        CarriedData data;
        data.begin(2, {3, before.data(), nullptr, nullptr});
        data.follow({3, after.data(), nullptr, &changes});
    };
    tests.expect_no_error([&] { follow([](Change &) {}); }, "changes: a flip and a cell that is renumbered");
    const auto expect = [&](const char *message, const char *what, const std::function<void(Change &)> &spoil) {
        tests.expect_error([&] { follow(spoil); }, message, std::string("changes: ") + what);
    };
    expect("nothing is said of cell", "a created cell is missing", [](Change &c) { c.created.pop_back(); });
    expect("there is no, or already a, cell", "a cell is created twice", [](Change &c) { c.created.push_back(0); });
    expect("there is no, or already a, cell", "a removed cell is missing", [](Change &c) { c.removed.pop_back(); });
    expect("other vertices", "a removed cell with other vertices", [](Change &c) { c.removed_vertices[0] = 4; });
    expect("there was no", "a cell removed that never was", [](Change &c) { c.removed[0] = 7; });
    expect("there is no, or already a, cell", "a renumbered cell in another's place",
           [](Change &c) { std::swap(c.created[1], c.to[0]), c.to[0] = 0; });
    expect("not those of cell", "data of another cell", [](Change &c) {
        c.removed = {2, 1};
        c.removed_vertices = {2, 1, 4, 0, 2, 3};
        c.from = {0};
    });
    expect("nothing is said of the star", "a star is missing", [](Change &c) { c.stars.pop_back(); });
    expect("twice among the stars", "a star twice", [](Change &c) { c.stars.push_back(0); });
    expect("nothing happened to the star", "a star too many", [](Change &c) { c.stars.push_back(4); });
    expect("neither hidden nor shown", "a vertex hidden that is not", [](Change &c) { c.hidden.push_back(4); });
}

/// A real engine that tells something wrong from the third update on.
class Misleading final : public Engine {
public:
    explicit Misleading(std::unique_ptr<Engine> real, bool tells_wrong_changes)
        : real_(std::move(real)), tells_wrong_changes_(tells_wrong_changes) {}

    void expect_readings() override { real_->expect_readings(); }
    void build(const double *positions, std::size_t n) override { real_->build(positions, n); }
    void advance(const double *positions) override {
        real_->advance(positions);
        ++n_advances_;
    }
    std::vector<std::uint32_t> cells() override { return real_->cells(); }
    Reading read() override {
        Reading reading = real_->read();
        if (n_advances_ < 3) return reading;
        if (tells_wrong_changes_) {
            changes_ = *reading.changes;
            changes_.created_count -= changes_.created_count > 0;
            reading.changes = &changes_;
        } else {
            neighbours_.assign(reading.neighbours, reading.neighbours + 3 * reading.n_cells);
            std::swap(neighbours_[0], neighbours_[1]);
            reading.neighbours = neighbours_.data();
        }
        return reading;
    }

private:
    std::unique_ptr<Engine> real_;
    bool tells_wrong_changes_;
    unsigned n_advances_ = 0;
    deldrift_changes changes_{};
    std::vector<std::uint32_t> neighbours_;
};

void test_misleading_engines(Tests &tests) {
    const Series series = wandering_points(2, false, 0.1);
    for (const bool tells_wrong_changes : {false, true}) {
        EngineKind kind = engine_kind("deldrift/auto");
        kind.make = [make = kind.make, tells_wrong_changes](unsigned dimension, unsigned n_threads) {
            return std::make_unique<Misleading>(make(dimension, n_threads), tells_wrong_changes);
        };
        const EngineKind step = step_of(kind);
        const std::vector<Entrant> entrants = {{&step, 1, every_timestamp(series)}};
        Progress progress(Progress::Output::silent);
        const std::string what = tells_wrong_changes ? "steps: wrong changes" : "steps: wrong neighbours";
        tests.expect_no_error([&] { verify(series, entrants, {1, 2}, progress); }, what + ", before");
        tests.expect_error([&] { verify(series, entrants, {3}, progress); }, "static_2d, timestamp 3: ", what);
        if (tells_wrong_changes)
            tests.expect_error([&] { verify(series, entrants, {5}, progress); }, "nothing is said of cell",
                               what + ", found later");
    }
}

/// Engines read the same stars, vertex by vertex, and are at the same cells afterwards.
void test_visits(Tests &tests) {
    for (const unsigned dimension : {2u, 3u}) {
        const Series series = wandering_points(dimension, false, 0.1);
        const auto cgal = engine_kind("cgal/move").make(dimension, 1);
        const auto placement = engine_kind("cgal/placement").make(dimension, 1);
        const auto deldrift = engine_kind("deldrift/auto").make(dimension, 1);
        for (Engine *engine : {cgal.get(), placement.get(), deldrift.get()})
            engine->build(series.frame(0), series.n_points);
        bool agree = true;
        for (std::uint32_t id = 0; id < series.n_points; ++id) {
            const double *place = series.frame(1) + std::size_t{id} * dimension;
            const double sum = cgal->visit(id, place);
            for (Engine *engine : {placement.get(), deldrift.get()})
                agree = agree && std::fabs(engine->visit(id, place) - sum) < 1e-9 * (1 + std::fabs(sum));
        }
        tests.expect(agree, "visits: the same stars are read in " + series.name);
        const auto ids = representatives(dimension, series.frame(1), series.n_points);
        tests.expect(canonical(dimension, cgal->cells(), ids) == canonical(dimension, deldrift->cells(), ids),
                     "visits: the cells are the same afterwards in " + series.name);
    }
    const double place[] = {0, 0};
    tests.expect_error([&] { engine_kind("cgal/rebuilding").make(2, 1)->visit(0, place); }, "relocates no vertex",
                       "visits: rebuilding has none");
}

void test_step_table(Tests &tests) {
    Progress progress(Progress::Output::silent);
    Checks checks;
    const std::vector<StepLine> lines = measure_steps(2, 300, 1, 1, checks, progress);
    tests.expect(lines.size() == 4 && lines[0].displacement == 0 && lines[3].displacement == 1e-2 &&
                     std::all_of(lines.begin(), lines.end(),
                                 [](const StepLine &l) { return l.cgal_step > 0 && l.commit > 0 && l.step > 0; }),
                 "step table: all is measured");
    tests.expect(checks.n_comparisons == 12, "step table: every engine is compared after every displacement");
    const std::vector<Row> rows = rows_of({3, 1'000, 1e-3, 10, 400, 10, 20});
    tests.expect(rows.size() == 3 && rows[0].scenario == "step_3d_1e-3" && rows[0].is_step && rows[0].speedup == 1 &&
                     !rows[1].is_step && rows[1].speedup == 0 && rows[2].speedup == 20 &&
                     std::fabs(rows[2].ns_per_vertex_timestamp() - 20) < 1e-9,
                 "step table: its rows");
    std::ostringstream text;
    print_steps(text, lines);
    tests.expect(text.str().find("step / commit") != std::string::npos, "step table: it is printed");
}

}  // namespace

void test_steps(Tests &tests) {
    test_readings(tests);
    test_consistency(tests);
    test_carried_data(tests);
    test_misleading_engines(tests);
    test_visits(tests);
    test_step_table(tests);
}

}  // namespace bench
