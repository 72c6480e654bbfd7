// The C++ wrapper: every member, exceptions, ownership.
#include "check.hpp"

#include <deldrift/research.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <type_traits>

using deldrift::Triangulation;

static_assert(!std::is_copy_constructible_v<Triangulation> && !std::is_copy_assignable_v<Triangulation>);
static_assert(std::is_nothrow_move_constructible_v<Triangulation> && std::is_nothrow_move_assignable_v<Triangulation>);
static_assert(sizeof(Triangulation) <= 2 * sizeof(void *) + sizeof(std::vector<double>));

static const std::vector<double> square{0, 0, 4, 0, 5, 5, 0, 4, 1, 2};

static void cells_are_spans() {
    const Triangulation t(2, square);
    const deldrift::Cells cells = t.cells();
    CHECK(cells.size() == 4 && cells.size() == t.cell_count() && cells.corners_per_cell() == 3);
    CHECK(cells.vertices().size() == 12 && cells.neighbours().size() == 12);
    std::size_t rows = 0, hull = 0;
    for (auto triangle : cells) {
        CHECK(triangle.size() == 3 && triangle.begin() + 3 == triangle.end());
        CHECK(std::memcmp(triangle.data(), cells.vertices().data() + 3 * rows, 3 * sizeof(std::uint32_t)) == 0);
        for (std::uint32_t other : cells.neighbours_of(rows)) hull += other == DELDRIFT_NONE;
        rows++;
    }
    CHECK(rows == 4 && hull == 4);
    CHECK(Triangulation(2, {}).cells().vertices().empty());
}

static void motion() {
    Triangulation t(2, square);
    CHECK(t.dimension() == 2 && t.vertex_count() == 5 && t.id_count() == 5 && t.timestamp() == 0);
    t.move_vertex(4, {2.0, 3.0});
    CHECK(t.staged_count() == 1);
    CHECK(t.commit_timestamp().moved == 1);
    CHECK((t.position(4) == std::vector<double>{2, 3}));
    t.move_vertices(square);
    t.discard_moves();
    t.move_vertices({0.0, 0.0});
    CHECK(t.staged_count() == 1);
    t.discard_moves();
    t.move_vertices({0, 4}, {0.5, 0.5, 1.0, 2.0});
    CHECK(t.commit_timestamp().timestamp == 2 && t.timestamp() == 2 && t.statistics().moved == 3);
    t.relocate_vertex(0, std::array<double, 2>{0, 0});
    CHECK(t.positions() == square);
    const std::uint32_t vertex = t.insert_vertex({3.0, 1.0});
    CHECK(vertex == 5 && t.is_present(5) && t.star(5).size() == 4);
    t.remove_vertex(vertex);
    CHECK(!t.is_present(5) && std::isnan(t.positions()[10]));
    t.remove_vertex(1);
    CHECK((t.compact() == std::vector<std::uint32_t>{0, DELDRIFT_NONE, 1, 2, 3, DELDRIFT_NONE}));
    CHECK(t.id_count() == 4 && (t.position(3) == std::vector<double>{1, 2}));
    CHECK(Triangulation(2, {}).compact().empty());
    t.validate(3);

    CHECK(t.take_changes().created_count == t.cell_count() && t.take_changes().created_count == 0);
    const std::size_t ids = t.id_count(), vertices = t.vertex_count();
    CHECK(t.stage_insertions({3.0, 1.0, 3.5, 2.0}) == ids);
    t.stage_removals({3});
    const deldrift_commit_report report = t.commit_timestamp();
    CHECK(report.inserted == 2 && report.removed == 1 && t.vertex_count() == vertices + 1);
    const deldrift_changes changes = t.take_changes();
    CHECK(changes.created_count > 0 && changes.removed_count > 0 && changes.stars[0] == 0);
    CHECK(t.commit_positions(t.positions()).moved == 0);
}

// A step is published, withdrawn, or withdrawn by the end of the block.
static void trials() {
    Triangulation t(2, square);
    const std::vector<unsigned char> saved = t.save();
    {
        deldrift::Trial trial(t);
        t.move_vertex(4, {2.0, 3.0});
        CHECK(trial.prepare().timestamp == 1 && t.timestamp() == 0);
        CHECK((t.position(4) == std::vector<double>{2, 3}));
        CHECK(t.stage_insertions({3.0, 1.0}) == 5);
        CHECK(trial.prepare().inserted == 1 && t.vertex_count() == 6);
        CHECK_THROWS(t.commit_timestamp(), DELDRIFT_PREPARED, "timestamp 1");
    }
    CHECK(t.save() == saved);
    {
        deldrift::Trial trial(t);
        t.move_vertex(4, {2.0, 3.0});
        trial.prepare();
        trial.withdraw();
        CHECK(t.save() == saved);
        t.move_vertex(4, {3.0, 2.0});
        trial.prepare();
        trial.publish();
    }
    CHECK(t.timestamp() == 1 && (t.position(4) == std::vector<double>{3, 2}));
    CHECK_THROWS(t.publish_timestamp(), DELDRIFT_NOT_PREPARED, "prepared");
    t.withdraw_timestamp();
    t.move_vertex(4, {1.0, 2.0});
    CHECK(t.prepare_timestamp().moved == 1);
    t.withdraw_timestamp();
    CHECK(t.prepare_timestamp().moved == 0);
    t.publish_timestamp();
    CHECK(t.timestamp() == 2 && (t.position(4) == std::vector<double>{3, 2}));
}

// Four points on a circle, of which the order of keys says which two are joined; an id that is given again.
static void keys() {
    const std::vector<double> corners{0, 0, 1, 0, 1, 1, 0, 1};
    const std::vector<std::uint64_t> ascending{10, 20, 30, 40}, other{20, 10, 40, 30};
    const auto rows = [](const Triangulation &t) {
        std::set<std::set<std::uint32_t>> all;
        for (const auto &row : t.cells().rows<3>()) all.insert({row[0], row[1], row[2]});
        return all;
    };
    const Triangulation plain(2, corners);
    Triangulation t(2, corners, ascending), turned(2, corners, other);
    CHECK(rows(t) == rows(plain) && rows(turned) != rows(plain));
    CHECK(t.keys() == ascending);
    t.remove_vertex(1);
    CHECK(t.stage_insertions_at_free_ids({0.5, 0.25, 0.5, 0.75}, std::vector<std::uint64_t>{7, 8}) ==
          (std::vector<std::uint32_t>{1, 4}));
    CHECK(t.stage_insertions({0.25, 0.5}, std::vector<std::uint64_t>{9}) == 5);
    CHECK(t.stage_insertions_at_free_ids({0.125, 0.5}) == (std::vector<std::uint32_t>{6}));
    t.commit_timestamp();
    CHECK(t.insert_vertex_with_key({0.75, 0.5}, 11) == 7);
    CHECK((t.keys() == std::vector<std::uint64_t>{10, 7, 30, 40, 8, 9, 6, 11}));
    t.validate(3);
}

static void queries() {
    Triangulation t(3, {0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 4.0, 0.5, 0.5, 0.75});
    CHECK(t.dimension() == 3 && t.star(4).size() == 4 && t.memory_bytes() > 0);
    CHECK(t.locate_points(std::array<double, 6>{0.25, 0.5, 0.5, 9, 9, 9}).at(1).kind == DELDRIFT_LOCATION_OUTSIDE);
    CHECK(t.locate({0.25, 0.5, 0.5}).kind == DELDRIFT_LOCATION_CELL && t.nearest_vertex({0.5, 0.5, 1.0}) == 4);
    CHECK(t.take_changes().created_count == t.cell_count());
    t.move_vertex(4, {0.0, 0.0, 4.0});
    t.commit_timestamp();
    CHECK(t.coincident_representative(4) == 3 && t.take_changes().created_count == 1);
    CHECK(t.algorithm() == DELDRIFT_AUTO);
    t.set_algorithm(DELDRIFT_PLACEMENT_FLIPS);
    CHECK(t.algorithm() == DELDRIFT_PLACEMENT_FLIPS);
}

// On what a wrapper owns, as everything else of deldrift/research.h.
static void tolerances() {
    Triangulation t(2, square);
    const deldrift::Cells cells = t.cells();
    std::size_t count = 0;
    double widths[12], least = INFINITY;
    CHECK(deldrift_research_annulus_widths(t.native(), widths, 12, &count) == DELDRIFT_OK && count == 12);
    for (std::uint32_t cell = 0; cell < cells.size(); cell++) {
        for (std::uint32_t corner = 0; corner < 3; corner++) {
            double centre[2], radius, tolerance;
            CHECK(deldrift_research_standard_delimiter(t.native(), cell, corner, centre, &radius, &tolerance) ==
                  DELDRIFT_OK);
            const double width = widths[3 * cell + corner];
            const bool is_hull = cells.neighbours_of(cell)[corner] == DELDRIFT_NONE;
            CHECK(is_hull == std::isnan(radius) && is_hull == std::isnan(width));
            if (is_hull) continue;
            const std::vector<double> opposite = t.position(cells[cell][corner]);
            const double x = opposite[0] - centre[0], y = opposite[1] - centre[1];
            CHECK(2 * tolerance == width);
            CHECK(std::fabs(std::hypot(x, y) - radius - width / 2) < 1e-13 * radius);
            least = std::fmin(least, tolerance);
        }
    }
    CHECK(t.tolerance(4) > 0 && t.tolerance(4) <= least);
    CHECK_THROWS(t.tolerance(9), DELDRIFT_NO_SUCH_VERTEX, "vertex[0] is 9");
}

// Positions that move by less and less, by every algorithm: the cells are those of rebuilding.
static void algorithms(std::uint32_t dimension) {
    using Cell = std::vector<std::uint32_t>;
    const auto sorted = [](const Triangulation &t) {
        std::vector<Cell> all;
        for (auto cell : t.cells()) {
            all.emplace_back(cell.begin(), cell.end());
            std::sort(all.back().begin(), all.back().end());
        }
        std::sort(all.begin(), all.end());
        return all;
    };
    std::mt19937_64 random(18);
    std::uniform_real_distribution<double> anywhere(-1, 1);
    std::vector<double> positions(dimension * 200);
    for (double &x : positions) x = anywhere(random);
    const deldrift_research_options rule{sizeof rule, 0.5, 19, 100, 1};
    std::map<std::uint32_t, Triangulation> all;
    for (std::uint32_t algorithm : ALL_ALGORITHMS) {
        Triangulation &made = all.emplace(algorithm, Triangulation(dimension, positions)).first->second;
        if (algorithm < DELDRIFT_RESEARCH_PLACEMENT) {
            made.set_algorithm(static_cast<deldrift_algorithm>(algorithm));
        } else {
            const auto of_research = static_cast<deldrift_research_algorithm>(algorithm);
            CHECK(deldrift_research_set_algorithm(made.native(), of_research, &rule) == DELDRIFT_OK);
        }
        CHECK(made.algorithm() == algorithm);
    }
    for (double step = 0.2; step > 1e-4; step /= 2) {
        for (double &x : positions) x += step * anywhere(random);
        for (auto &[algorithm, t] : all) {
            t.move_vertices(positions);
            t.commit_timestamp();
        }
        const std::vector<Cell> wanted = sorted(all.at(DELDRIFT_REBUILDING));
        for (const auto &[algorithm, t] : all) CHECK(sorted(t) == wanted);
        all.at(DELDRIFT_RESEARCH_SAFE_REGION).validate(3);
    }
    const deldrift_commit_report sums = all.at(DELDRIFT_RESEARCH_REBUILDING_TOLERANCE).statistics();
    CHECK(sums.rebuilds > 0 && sums.rebuilds < sums.timestamp && sums.within_tolerance > 0);
}

// A wheel has a vertex with more cells than any first guess.
static void large_stars_are_whole() {
    std::vector<double> wheel{0, 0};
    for (int i = 0; i < 100; i++) {
        wheel.push_back(std::cos(0.0625 * i));
        wheel.push_back(std::sin(0.0625 * i));
    }
    const Triangulation t(2, wheel);
    CHECK(t.star(0).size() == 100);
}

static void failures_are_exceptions() {
    Triangulation t(2, square);
    CHECK_THROWS(Triangulation(4, square), DELDRIFT_WRONG_COUNT, "positions has 10 numbers, but must have 8");
    CHECK_THROWS(Triangulation(5, square), DELDRIFT_INVALID_DIMENSION, "dimension is 5");
    CHECK_THROWS(Triangulation(0, {}), DELDRIFT_INVALID_DIMENSION, "dimension is 0");
    CHECK_THROWS(Triangulation(2, {0.0, NAN}), DELDRIFT_NOT_FINITE, "positions[0]");
    CHECK_THROWS(t.move_vertex(9, {1.0, 1.0}), DELDRIFT_NO_SUCH_VERTEX, "vertex[0] is 9");
    CHECK_THROWS(t.move_vertex(4, {1.0, 1.0, 1.0}), DELDRIFT_WRONG_COUNT, "position has 3 numbers");
    CHECK_THROWS(t.move_vertices({0, 1}, {1.0, 1.0}), DELDRIFT_WRONG_COUNT, "must have 4");
    deldrift_options options = deldrift::default_options();
    options.passing = static_cast<deldrift_passing>(3);
    CHECK_THROWS(Triangulation(2, square, options), DELDRIFT_INVALID_OPTIONS, "options.passing is 3");
    CHECK_THROWS(t.star(9), DELDRIFT_NO_SUCH_VERTEX, "vertex[0] is 9");
    CHECK_THROWS(t.validate(9), DELDRIFT_INVALID_LEVEL, "level is 9");
    CHECK(t.timestamp() == 0 && t.staged_count() == 0);
}

static void ownership_moves() {
    Triangulation a(2, square);
    const std::uint32_t *vertices = a.cells().vertices().data();
    Triangulation b = std::move(a);
    CHECK(a.native() == nullptr && b.cells().vertices().data() == vertices);
    CHECK_THROWS(a.cell_count(), DELDRIFT_NULL_ARGUMENT, "t is NULL");
    a = std::move(b);
    CHECK(a.cell_count() == 4 && b.native() == nullptr);

    deldrift_triangulation *raw = nullptr;
    CHECK(deldrift_create(2, square.data(), 5, nullptr, &raw) == DELDRIFT_OK);
    Triangulation adopted(raw);
    CHECK(adopted.native() == raw && adopted.dimension() == 2);
    CHECK_THROWS(Triangulation(nullptr), DELDRIFT_NULL_ARGUMENT, "t is NULL");

    // Without exceptions: the functions of deldrift.h on what it owns.
    CHECK(deldrift_remove_vertex(adopted.native(), 77) == DELDRIFT_NO_SUCH_VERTEX);
}

int main() {
    cells_are_spans();
    motion();
    trials();
    keys();
    queries();
    tolerances();
    algorithms(2);
    algorithms(3);
    large_stars_are_whole();
    failures_are_exceptions();
    ownership_moves();
}
