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

/// Every engine's arrays describe CGAL's cells, and what changes say leads from one reading to the next.
TEST_CASE("readings") {
    for (const unsigned dimension : {2u, 3u})
        for (const bool is_grid : {false, true})
            for (const double length : {0.0, 0.001, 0.1}) {
                const Series series = wandering_points(dimension, is_grid, length);
                CAPTURE(dimension);
                CAPTURE(is_grid);
                CAPTURE(length);
                std::vector<EngineKind> kinds;
                for (const EngineKind &kind : engine_kinds())
                    if (!kind.is_reproduction) kinds.push_back(step_of(kind));
                std::vector<Entrant> entrants;
                for (const EngineKind &kind : kinds) entrants.push_back({&kind, 1, every_timestamp(series)});
                Progress progress(Progress::Output::silent);
                const Checks checks = verify(series, entrants, every_timestamp(series), progress);
                CHECK(checks.n_comparisons == entrants.size() * series.n_timestamps());
            }
    CHECK_THROWS_WITH(engine_kind("cgal/tolerance").make(2, 1)->read(), Contains("no readings"));
}

/// A square of two triangles.
struct Square {
    std::vector<std::uint32_t> vertices = {0, 1, 2, 0, 2, 3};
    std::vector<std::uint32_t> neighbours = {DELDRIFT_NONE, 1, DELDRIFT_NONE, DELDRIFT_NONE, DELDRIFT_NONE, 0};

    Reading reading(const deldrift_changes *changes = nullptr) const {
        return {vertices.size() / 3, vertices.data(), neighbours.data(), changes};
    }
};

TEST_CASE("consistency") {
    CHECK_NOTHROW(require_consistent(2, Square().reading()));
    const auto expect = [&](std::size_t entry, std::uint32_t value, const char *message) {
        Square square;
        square.neighbours[entry] = value;
        CHECK_THROWS_WITH(require_consistent(2, square.reading()), Contains(message));
    };
    expect(1, 2, "no such neighbour");
    expect(0, 1, "has not the facet");
    expect(5, DELDRIFT_NONE, "does not know");
    Square torn;
    torn.neighbours.assign(6, DELDRIFT_NONE);
    CHECK_THROWS_WITH(require_consistent(2, torn.reading()), Contains("same facet"));
}

/// The diagonal of a square is flipped, and one cell more is renumbered by the way; then one of the changes is wrong.
TEST_CASE("carried data") {
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
    CHECK_NOTHROW(follow([](Change &) {}));
    const auto expect = [&](const char *message, const char *what, const std::function<void(Change &)> &spoil) {
        CAPTURE(what);
        CHECK_THROWS_WITH(follow(spoil), Contains(message));
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

TEST_CASE("misleading engines") {
    const Series series = wandering_points(2, false, 0.1);
    for (const bool tells_wrong_changes : {false, true}) {
        EngineKind kind = engine_kind("deldrift/auto");
        kind.make = [make = kind.make, tells_wrong_changes](unsigned dimension, unsigned n_threads) {
            return std::make_unique<Misleading>(make(dimension, n_threads), tells_wrong_changes);
        };
        const EngineKind step = step_of(kind);
        const std::vector<Entrant> entrants = {{&step, 1, every_timestamp(series)}};
        Progress progress(Progress::Output::silent);
        CAPTURE(tells_wrong_changes);
        CHECK_NOTHROW(verify(series, entrants, {1, 2}, progress));
        CHECK_THROWS_WITH(verify(series, entrants, {3}, progress), Contains("static_2d, timestamp 3: "));
        if (tells_wrong_changes)
            CHECK_THROWS_WITH(verify(series, entrants, {5}, progress),
                              Contains("nothing is said of cell"));
    }
}

/// Engines read the same stars, vertex by vertex, and are at the same cells afterwards.
TEST_CASE("visits") {
    for (const unsigned dimension : {2u, 3u}) {
        CAPTURE(dimension);
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
        CHECK_MESSAGE(agree, "the same stars are read");
        const auto ids = representatives(dimension, series.frame(1), series.n_points);
        CHECK_MESSAGE(canonical(dimension, cgal->cells(), ids) == canonical(dimension, deldrift->cells(), ids),
                      "the cells are the same afterwards");
    }
    const double place[] = {0, 0};
    CHECK_THROWS_WITH(engine_kind("cgal/rebuilding").make(2, 1)->visit(0, place), Contains("relocates no vertex"));
}

TEST_CASE("step table") {
    Progress progress(Progress::Output::silent);
    Checks checks;
    const std::vector<StepLine> lines = measure_steps(2, 300, 1, 1, checks, progress);
    REQUIRE(lines.size() == 4);
    CHECK(lines[0].displacement == 0);
    CHECK(lines[3].displacement == 1e-2);
    for (const StepLine &line : lines) CHECK(std::min({line.cgal_step, line.commit, line.step}) > 0);
    CHECK_MESSAGE(checks.n_comparisons == 12, "every engine is compared after every displacement");
    const std::vector<Row> rows = rows_of({3, 1'000, 1e-3, 10, 400, 10, 20});
    REQUIRE(rows.size() == 3);
    CHECK(rows[0].scenario == "step_3d_1e-3");
    CHECK(rows[0].timed == "step");
    CHECK(rows[0].speedup == 1);
    CHECK(rows[1].timed == "update");
    CHECK(rows[1].speedup == 0);
    CHECK(rows[2].speedup == 20);
    CHECK(std::fabs(rows[2].ns_per_vertex_timestamp() - 20) < 1e-9);
    std::ostringstream text;
    print_steps(text, lines);
    CHECK_MESSAGE(text.str().find("step / commit") != std::string::npos, "it is printed");
}

}  // namespace

}  // namespace bench
