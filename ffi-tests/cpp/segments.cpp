// Segments and domains in C++: members beside the functions of deldrift.h, ranges, and the errors of conflicts.
#include "check.hpp"

#include <algorithm>
#include <cmath>
#include <set>

using deldrift::ConflictError;
using deldrift::Ends;
using deldrift::Triangulation;

static const std::vector<std::array<double, 2>> kite{{0, 0}, {5, -1}, {10, 0}, {5, 1}};

static void segments_are_kept() {
    Triangulation t(2, kite);
    CHECK(t.is_edge(1, 3) && t.segments().empty());
    CHECK(t.stage_segments({Ends{0, 2}}, {7}) == 0);
    t.check_staged();
    t.commit_timestamp();
    CHECK(t.is_edge(0, 2) && !t.is_edge(1, 3));
    const std::vector<Ends> more{{3, 2}, {2, 3}};
    CHECK(t.stage_segments(more) == 1);
    t.commit_timestamp();
    const deldrift::Segments segments = t.segments();
    CHECK(segments.size() == 3 && segments.begin() + 3 == segments.end());
    std::int32_t sum = 0;
    for (const auto [id, ends, marker] : segments) {
        CHECK(segments[id].ends == ends && segments.markers[id] == marker);
        sum += marker;
    }
    CHECK(sum == 7 && segments.ends[1] == more[0] && segments.begin()->id == 0);
    t.stage_segment_removals({0, 2});
    t.commit_timestamp();
    CHECK(t.is_edge(1, 3) && t.segments().ids == std::vector<std::uint32_t>{1});
    CHECK(t.stage_segments({}) == 3);
    CHECK_THROWS(t.stage_segment_removals({0}), DELDRIFT_NO_SUCH_SEGMENT, "segments[0] is 0");
    CHECK_THROWS(t.stage_segments({Ends{0, 9}}), DELDRIFT_NO_SUCH_VERTEX, "ends[1] is 9");
    CHECK_THROWS(t.stage_segments({Ends{0, 1}}, {1, 2}), DELDRIFT_WRONG_COUNT, "markers has 2 numbers");
    Triangulation solid(3, std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
    CHECK_THROWS(solid.stage_segments({Ends{0, 1}}), DELDRIFT_INVALID_DIMENSION, "must be 2");
}

// What a call throws for conflicts: a copy of it, made as programs make them.
template <class Call>
static ConflictError conflicts_of(Call call) {
    try {
        call();
    } catch (const ConflictError &error) {
        const ConflictError copy = error;
        return copy;
    }
    CHECK(!"a conflict");
    std::exit(1);
}

static void errors_tell_conflicts() {
    Triangulation t(2, kite);
    t.stage_segments({Ends{0, 2}});
    t.commit_timestamp();
    t.stage_segments({Ends{1, 3}, Ends{1, 1}});
    for (const ConflictError &error : {conflicts_of([&] { t.check_staged(); }), conflicts_of([&] { t.commit_timestamp(); })}) {
        CHECK(error.status() == DELDRIFT_CROSSING && error.conflicts().size() == 2);
        const deldrift_conflict first = error.conflicts()[0], second = error.conflicts()[1];
        CHECK(first.kind == DELDRIFT_CONFLICT_CROSSING && first.segment == 0 && first.other == 1);
        CHECK(second.kind == DELDRIFT_CONFLICT_ENDS_MEET && second.segment == 2 && second.other == DELDRIFT_NONE);
        CHECK(std::strstr(error.what(), "segments 0 and 1 cross, and there is one more conflict") != nullptr);
    }
    CHECK(ConflictError::is_conflict(DELDRIFT_CROSSING) && !ConflictError::is_conflict(DELDRIFT_COINCIDENT));
    CHECK(t.segment_conflicts().size() == 2);
    t.discard_moves();
    std::vector<double> positions = t.positions();
    positions[7] = 0;
    const auto status = [&](auto call) { return conflicts_of(call).conflicts().at(0).kind; };
    CHECK(status([&] { t.commit_positions(positions); }) == DELDRIFT_CONFLICT_ON_SEGMENT);
    CHECK(status([&] { t.relocate_vertex(3, {5.0, 0.0}); }) == DELDRIFT_CONFLICT_ON_SEGMENT);
    CHECK(status([&] { t.insert_vertex({5.0, 0.0}); }) == DELDRIFT_CONFLICT_ON_SEGMENT);
    CHECK(status([&] { t.remove_vertex(0); }) == DELDRIFT_CONFLICT_END_REMOVED);
    CHECK_THROWS(t.remove_vertex(0), DELDRIFT_END_REMOVED, "vertex 0, an end of segment 0, is removed");
    // Other errors are no conflicts.
    try {
        t.remove_vertex(9);
        CHECK(!"an error");
    } catch (const ConflictError &) {
        CHECK(!"another error");
    } catch (const deldrift::Error &error) {
        CHECK(error.status() == DELDRIFT_NO_SUCH_VERTEX);
    }
    t.relocate_vertex(3, {5.0, 0.5});
    CHECK(t.segment_conflicts().empty());
}

// What a call throws where vertices pass segments: a copy of it.
template <class Call>
static deldrift::PassingError passings_of(Call call) {
    try {
        call();
    } catch (const deldrift::PassingError &error) {
        const deldrift::PassingError copy = error;
        return copy;
    }
    CHECK(!"a vertex passes");
    std::exit(1);
}

static void errors_tell_passings() {
    deldrift_options options = deldrift::default_options();
    options.passing = DELDRIFT_PASSING_REFUSE;
    Triangulation t(2, kite, options);
    t.stage_segments({Ends{0, 2}});
    t.commit_timestamp();
    CHECK(t.passings().empty());
    t.check_passings();
    t.move_vertices({1, 3}, {5.0, 3.0, 5.0, -1.0});
    for (const auto &error : {passings_of([&] { t.check_passings(); }), passings_of([&] { t.check_staged(); }),
                              passings_of([&] { t.commit_timestamp(); })}) {
        CHECK(error.status() == DELDRIFT_PASSES_SEGMENT && error.passings().size() == 2);
        const auto [segment, vertex] = error.passings()[1];
        CHECK(segment == 0 && vertex == 3 && error.passings()[0].vertex == 1);
        CHECK(std::strstr(error.what(), "vertex 1 passes segment 0, and there is one more such pair") != nullptr);
    }
    t.discard_moves();
    std::vector<double> positions = t.positions();
    positions[7] = -0.5;
    CHECK(passings_of([&] { t.commit_positions(positions); }).passings()[0].vertex == 3);
    CHECK(passings_of([&] { t.relocate_vertex(3, {5.0, -0.5}); }).passings()[0].vertex == 3);
    options.passing = DELDRIFT_PASSING_TELL;
    Triangulation telling(2, kite, options);
    telling.stage_segments({Ends{0, 2}});
    telling.commit_timestamp();
    telling.commit_positions(positions);
    CHECK(telling.passings().size() == 1 && telling.passings()[0].vertex == 3 && telling.timestamp() == 2);
}

// What crosses is split, within a limit.
static void segments_are_split() {
    Triangulation t(2, kite);
    t.stage_segments({Ends{0, 2}, Ends{1, 3}}, {4, 5});
    const ConflictError error = conflicts_of([&] { t.stage_splits(0); });
    CHECK(error.status() == DELDRIFT_CROSSING && error.conflicts().size() == 1);
    const deldrift_split_report split = t.stage_splits();
    CHECK(split.inserted == 1 && split.pieces == 4 && split.first_vertex == 4 && split.first_piece == 2);
    CHECK(t.stage_splits().rounds == 0);
    t.commit_timestamp();
    const deldrift::Segments pieces = t.segments();
    CHECK(pieces.size() == 4 && pieces[1].id == 3 && pieces[1].ends == (Ends{4, 2}) && pieces[3].marker == 5);
}

// A step that would put a vertex on a segment is cut until it does not.
static void steps_are_cut() {
    Triangulation t(2, kite);
    t.stage_segments({Ends{0, 2}});
    t.commit_timestamp();
    int n_cuts = 0;
    double step = 1;
    for (;; step /= 2) {
        t.move_vertex(3, {5.0, 1 - step});
        try {
            t.check_staged();
            break;
        } catch (const ConflictError &error) {
            CHECK(error.conflicts().size() == 1 && error.conflicts()[0].other == 3);
            t.discard_moves();
            n_cuts++;
        }
    }
    t.commit_timestamp();
    CHECK(n_cuts == 1 && t.position<2>(3)[1] == 0.5);
}

// A square, a diamond in it, and what is between.
static void domains_are_known() {
    std::vector<double> points{0, 0, 4, 0, 4, 4, 0, 4, 2, 1, 3, 2, 2, 3, 1, 2, 2, 2, -1, 5, 0.5, 0.5, 3.5, 3.25};
    Triangulation t(2, points);
    std::vector<Ends> sides;
    std::vector<std::int32_t> markers;
    for (std::uint32_t k = 0; k < 8; k++) {
        sides.push_back({k, k < 4 ? (k + 1) % 4 : 4 + (k + 1) % 4});
        markers.push_back(k < 4 ? 1 : 2);
    }
    t.stage_segments(sides, markers);
    t.commit_timestamp();
    const std::vector<std::uint32_t> levels = t.nesting_levels();
    const std::vector<double> areas = t.volumes();
    const std::vector<std::int32_t> labels = t.label_cells({2.0, 2.5, 0.1, 0.1}, {20, 10}, -1);
    std::vector<std::uint8_t> mask;
    double area[3] = {0, 0, 0};
    for (std::size_t cell = 0; cell < levels.size(); cell++) {
        CHECK(labels[cell] == (levels[cell] == 0 ? -1 : levels[cell] == 1 ? 10 : 20));
        area[levels[cell]] += areas[cell];
        mask.push_back(levels[cell] == 1);
    }
    CHECK(std::abs(area[1] - 14) < 1e-12 && std::abs(area[2] - 2) < 1e-12 && area[0] > 0);
    CHECK(t.crossing_numbers() == levels);
    // The sides of the diamond once more: by the even-odd rule it is no hole any more.
    Triangulation twice = t.clone();
    twice.stage_segments(std::vector<Ends>(sides.begin() + 4, sides.end()));
    twice.commit_timestamp();
    const std::vector<std::uint32_t> numbers = twice.crossing_numbers();
    CHECK(twice.nesting_levels() == levels && numbers.size() == levels.size());
    for (std::size_t cell = 0; cell < numbers.size(); cell++) CHECK(numbers[cell] == (levels[cell] == 2 ? 3 : levels[cell]));

    const deldrift::Chains chains = t.boundary_chains(mask);
    CHECK(chains.size() == 2 && !chains.empty() && chains.begin() + 2 == chains.end() && chains.begin()->size() == 4);
    const auto beside = t.cells_of_segments();
    const auto at_edges = t.segments_of_cells();
    std::set<std::uint32_t> found;
    std::uint32_t k = 0;
    for (const auto chain : chains) {
        std::uint32_t at = chain.begin()->vertex;
        for (const deldrift::ChainEdge edge : chain) {
            CHECK(edge.vertex == at);
            CHECK(t.segments()[edge.segment].marker == (k == 0 ? 1 : 2) && t.is_edge(edge.vertex, edge.next));
            CHECK(at_edges[edge.cell][edge.corner] == edge.segment && mask[edge.cell] == 1);
            const Ends ends = sides[edge.segment];
            const bool is_along = ends[0] == edge.vertex && ends[1] == edge.next;
            CHECK(is_along || (ends[0] == edge.next && ends[1] == edge.vertex));
            CHECK(beside[edge.segment][is_along ? 0 : 1] == edge.cell);
            found.insert(edge.segment);
            at = edge.next;
        }
        CHECK(at == chains[k].begin()->vertex);
        k++;
    }
    CHECK(found.size() == 8 && t.boundary_chains(std::vector<std::uint8_t>(mask.size())).empty());
    CHECK_THROWS(t.label_cells({4.0, 2.0}, {1, 2}, 0), DELDRIFT_WRONG_COUNT, "labels has 2 numbers");
    CHECK_THROWS(t.label_cells({2.0, 1.0}, {1}, 0), DELDRIFT_AMBIGUOUS_SEED, "seeds[0]");
    CHECK_THROWS(t.boundary_chains({1, 0}), DELDRIFT_WRONG_COUNT, "mask_count is 2");
    // The labels of regions follow.
    const std::vector<std::int32_t> of_regions(levels.begin(), levels.end());
    t.set_regions(of_regions);
    CHECK(t.regions().labels == of_regions && t.regions().undecided == 0);
    const std::vector<std::array<std::int32_t, 2>> none(t.segments().size(), {DELDRIFT_NO_LABEL, DELDRIFT_NO_LABEL});
    t.set_segment_sides(t.segments().ids, none);
    CHECK(t.regions(-1).labels == std::vector<std::int32_t>(levels.size(), -1) && t.regions().undecided > 0);
    CHECK_THROWS(t.set_segment_sides({0u}, none), DELDRIFT_WRONG_COUNT, "sides has");
    CHECK_THROWS(t.set_regions({1}), DELDRIFT_WRONG_COUNT, "label_count is 1");
}

// Cells that come have the labels of those around, as if labelled anew.
static void labels_follow() {
    Triangulation t(2, {0, 0, 4, 0, 4, 4, 0, 4, 1, 1, 3, 2.5, 1, 2.5, 2, 0.5});
    const std::vector<Ends> sides{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {1, 3}};
    t.stage_segments(sides);
    t.commit_timestamp();
    std::vector<std::int32_t> labels = t.label_cells({1.0, 0.5, 3.0, 3.0}, {5, 6}, 0);
    t.take_changes();
    for (int step = 0; step < 12; step++) {
        const double x = 1 + 0.25 * (step % 4);
        const std::vector<std::uint32_t> moved{4, 5};
        t.move_vertices(moved, {x, 2 - x / 2, 4.5 - x, 3.25});
        t.commit_timestamp();
        const std::uint32_t inserted = t.insert_vertex(std::vector<double>{2.5 - x / 4, 0.25});
        if (step > 0) t.remove_vertex(inserted - 1);
        const deldrift_changes changes = t.take_changes();
        std::vector<std::int32_t> after(labels);
        after.resize(t.cell_count());
        for (std::size_t k = 0; k < changes.renumbered_count; k++) {
            after[changes.renumbered_to[k]] = labels[changes.renumbered_from[k]];
        }
        const std::vector<std::uint32_t> created(changes.created, changes.created + changes.created_count);
        CHECK(!created.empty() && t.update_labels(created, 0, after) == 0);
        CHECK(after == t.label_cells({0.1, 0.0625, 3.0, 3.5}, {5, 6}, 0));
        labels = after;
    }
    const std::vector<std::uint32_t> wrong{99};
    CHECK_THROWS(t.update_labels(wrong, 0, labels), DELDRIFT_NO_SUCH_FACET, "cells[0]");
    labels.pop_back();
    CHECK_THROWS(t.update_labels({}, 0, labels), DELDRIFT_BUFFER_TOO_SMALL, "capacity");
}

int main() {
    labels_follow();
    segments_are_kept();
    errors_tell_conflicts();
    errors_tell_passings();
    segments_are_split();
    steps_are_cut();
    domains_are_known();
    return 0;
}
