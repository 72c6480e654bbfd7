// Refinement in C++: members beside what is measured here, values that are carried over, functions that throw.
#include "check.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

using deldrift::Corners;
using deldrift::Ends;
using deldrift::Quality;
using deldrift::Triangulation;

static const std::vector<std::array<double, 2>> corners{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {1, 2}, {2, 2}, {2, 1}};

// A square with a square hole.
static Triangulation domain() {
    Triangulation t(2, corners);
    std::vector<Ends> sides;
    std::vector<std::int32_t> markers;
    for (std::uint32_t k = 0; k < 8; k++) {
        sides.push_back({k, k - k % 4 + (k + 1) % 4});
        markers.push_back(10 + static_cast<std::int32_t>(k));
    }
    t.stage_segments(sides, markers);
    t.commit_timestamp();
    return t;
}

static double area_of(const Corners &c) {
    return ((c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) - (c[1][1] - c[0][1]) * (c[2][0] - c[0][0])) / 2;
}

static double length(const std::array<double, 2> &a, const std::array<double, 2> &b) {
    return std::hypot(a[0] - b[0], a[1] - b[1]);
}

static double longest_edge(const Corners &c) {
    return std::max({length(c[0], c[1]), length(c[1], c[2]), length(c[2], c[0])});
}

static double least_angle(const Corners &c) {
    double least = 180;
    for (std::size_t i = 0; i < 3; i++) {
        const auto &o = c[i], &a = c[(i + 1) % 3], &b = c[(i + 2) % 3];
        const double dot = (a[0] - o[0]) * (b[0] - o[0]) + (a[1] - o[1]) * (b[1] - o[1]);
        least = std::min(least, std::atan2(2 * area_of(c), dot) * 180 / std::acos(-1.0));
    }
    return least;
}

// The cells of an odd level.
static std::vector<Corners> cells_in_domain(const Triangulation &t) {
    const auto positions = t.positions<2>();
    const auto levels = t.nesting_levels();
    std::vector<Corners> cells;
    std::size_t cell = 0;
    for (const auto [a, b, c] : t.cells().rows<3>()) {
        if (levels[cell++] % 2 == 1) cells.push_back({positions[a], positions[b], positions[c]});
    }
    return cells;
}

template <class Measure>
static double greatest(const std::vector<Corners> &cells, Measure measure) {
    double most = -1e300;
    for (const Corners &c : cells) most = std::max(most, measure(c));
    return most;
}

static double sum_of_areas(const std::vector<Corners> &cells) {
    const auto add = [](double sum, const Corners &c) { return sum + area_of(c); };
    return std::accumulate(cells.begin(), cells.end(), 0.0, add);
}

static double linear(const std::array<double, 2> &p) { return 3 + 2 * p[0] - p[1]; }

static void cells_have_the_quality() {
    Triangulation t = domain();
    Quality quality;
    CHECK(t.refine(quality).inserted == 0 && t.made_vertices().empty() && t.refined_weights().empty());
    quality.least_angle = 30;
    quality.greatest_area = 0.05;
    quality.has_weights = true;
    std::vector<double> values, pairs;
    for (const auto &p : corners) {
        values.push_back(linear(p));
        pairs.insert(pairs.end(), {p[0], p[1]});
    }
    const deldrift_quality_report report = t.refine(quality);
    CHECK(report.inserted == t.id_count() - 8 && report.inserted > 200 && report.bad_cells == 0);
    std::vector<Corners> cells = cells_in_domain(t);
    CHECK(greatest(cells, area_of) <= 0.05 && std::abs(sum_of_areas(cells) - 15) < 1e-12);
    CHECK(greatest(cells, [](const Corners &c) { return -least_angle(c); }) <= -30);

    const deldrift::MadeVertices made = t.made_vertices();
    CHECK(made.size() == report.inserted && made.vertices.front() == 8 && made.vertices.back() + 1 == t.id_count());
    const auto is_on = [](std::uint32_t segment) { return segment != DELDRIFT_NONE; };
    const auto n_on = std::count_if(made.segments.begin(), made.segments.end(), is_on);
    CHECK(static_cast<std::uint64_t>(n_on) == report.on_segments);
    const std::vector<std::uint32_t> originals = t.original_segments();
    const deldrift::Segments segments = t.segments();
    CHECK(originals.size() == segments.size() && segments.size() == 8 + report.on_segments);
    for (std::size_t k = 0; k < originals.size(); k++) {
        CHECK(segments[k].marker == 10 + static_cast<std::int32_t>(originals[k]));
    }

    const deldrift::RefinedWeights rows = t.refined_weights();
    CHECK(rows.size() == report.inserted && !rows.empty());
    t.carry(values);
    t.carry(pairs, 2);
    const auto positions = t.positions<2>();
    CHECK(values.size() == positions.size() && pairs.size() == 2 * positions.size());
    for (std::size_t v = 0; v < positions.size(); v++) {
        CHECK(std::abs(values[v] - linear(positions[v])) < 1e-12);
        CHECK(std::abs(pairs[2 * v] - positions[v][0]) < 1e-12 && std::abs(pairs[2 * v + 1] - positions[v][1]) < 1e-12);
    }
    // Once more they are what they are.
    t.carry(pairs, 2);
    CHECK(pairs.size() == 2 * positions.size());
    CHECK_THROWS(t.carry(pairs), DELDRIFT_WRONG_COUNT, "values has ");
    std::vector<double> few(7);
    CHECK_THROWS(t.carry(few), DELDRIFT_WRONG_COUNT,
                 "values has 7 numbers, but must have 1 for each id that there was, from 8 to");
    // Nothing to insert, and nothing to carry over.
    CHECK(t.refine(quality).inserted == 0);
    t.carry(values);
    CHECK(values.size() == positions.size());

    quality.least_angle = 20;
    quality.greatest_area = 0.5;
    const std::uint64_t removed = t.coarsen(quality).removed;
    CHECK(removed > 100 && t.made_vertices().size() == report.inserted - removed);
    cells = cells_in_domain(t);
    CHECK(greatest(cells, area_of) <= 0.5 && std::abs(sum_of_areas(cells) - 15) < 1e-12);
}

// Vertices get free ids, and values are by id; a compaction renumbers arrays.
static void ids_are_given_again() {
    Triangulation t = domain();
    Quality fine;
    fine.greatest_area = 0.05;
    fine.has_weights = fine.reuses_ids = true;
    Quality coarse = fine;
    coarse.greatest_area = 0.5;
    std::vector<double> values;
    for (const auto &p : corners) values.push_back(linear(p));
    std::size_t most = 0;
    for (int round = 0; round < 5; round++) {
        const std::size_t before = t.id_count();
        const std::uint64_t inserted = t.refine(fine).inserted;
        const std::vector<std::uint32_t> ids = t.refined_vertices();
        CHECK(ids.size() == inserted && inserted > 50 && t.refined_weights().ids == ids);
        CHECK(round == 0 ? ids.front() == 8 && ids.size() == t.id_count() - 8 : ids.front() < before);
        t.carry(values);
        CHECK(values.size() == t.id_count());
        for (std::uint32_t v = 0; v < values.size(); v++) {
            if (t.is_present(v)) CHECK(std::abs(values[v] - linear(t.position<2>(v))) < 1e-12);
        }
        most = std::max(most, t.vertex_count());
        CHECK(t.coarsen(coarse).removed > 50 && t.refined_vertices().empty());
        // Values from before both, whether the mesh is made anew or not.
        t.refine(coarse);
        t.carry(values);
        CHECK(values.size() == t.id_count());
        for (std::uint32_t v = 0; v < values.size(); v++) {
            if (t.is_present(v)) CHECK(std::abs(values[v] - linear(t.position<2>(v))) < 1e-12);
        }
    }
    CHECK(t.id_count() <= most + most / 4);

    std::vector<std::uint64_t> twice;
    for (std::uint64_t v = 0; v < t.id_count(); v++) twice.insert(twice.end(), {v, v});
    std::vector<double> odd(t.id_count() + 1);
    CHECK_THROWS(t.compact(values, odd), DELDRIFT_WRONG_COUNT, "an array has ");
    const std::vector<std::uint32_t> map = t.compact(values, twice);
    CHECK(values.size() == t.vertex_count() && twice.size() == 2 * values.size() && map.size() > values.size());
    for (std::uint32_t v = 0; v < values.size(); v++) {
        CHECK(std::abs(values[v] - linear(t.position<2>(v))) < 1e-12);
        CHECK(map[twice[2 * v]] == v && twice[2 * v] == twice[2 * v + 1]);
    }
}

static void sizes_and_labels_are_taken() {
    Triangulation t = domain();
    Quality quality;
    for (const auto &p : corners) quality.sizes.push_back(0.2 + 0.1 * p[0]);
    quality.has_weights = true;
    // In two parts, between which the sizes are carried over.
    quality.limit = 50;
    CHECK(t.refine(quality).is_cut_short == 1);
    CHECK_THROWS(t.refine(quality), DELDRIFT_WRONG_COUNT, "quality.size_count is 8, but must be 58");
    const std::vector<double> sizes = t.refined_sizes();
    CHECK(sizes.size() == 50);
    quality.sizes.insert(quality.sizes.end(), sizes.begin(), sizes.end());
    quality.limit = Quality().limit;
    CHECK(t.refine(quality).inserted > 50);
    for (const Corners &c : cells_in_domain(t)) {
        CHECK(longest_edge(c) <= 0.2 + 0.1 * (c[0][0] + c[1][0] + c[2][0]) / 3 + 1e-9);
    }

    // The hole alone: its sides stay whole, and the first vertex is in the middle.
    t = domain();
    Quality in_hole;
    in_hole.labels = t.label_cells({1.5, 1.5}, {1}, -1);
    in_hole.areas = {0, 0.01};
    in_hole.keeps = DELDRIFT_KEPT_ALL;
    CHECK(t.refine(in_hole, std::vector<std::uint8_t>(t.cell_count(), 1)).bad_cells == 0);
    CHECK(t.segments().size() == 8 && t.position<2>(8) == (std::array<double, 2>{1.5, 1.5}));
    in_hole.labels = t.label_cells({1.5, 1.25}, {1}, -1);
    in_hole.areas = {0, 0.002};
    in_hole.keeps = DELDRIFT_KEPT_NONE;
    CHECK(t.refine(in_hole, std::vector<std::uint8_t>(t.cell_count(), 1)).inserted > 50);
    for (const std::array<double, 2> &p : t.positions<2>()) {
        const bool is_in_hole = p[0] >= 1 && p[0] <= 2 && p[1] >= 1 && p[1] <= 2;
        CHECK(is_in_hole || std::find(corners.begin(), corners.end(), p) != corners.end());
    }
    CHECK_THROWS(t.refine(in_hole, {1, 0}), DELDRIFT_WRONG_COUNT, "mask_count is 2");
    in_hole.labels.clear();
    in_hole.least_angle = 40;
    CHECK_THROWS(t.refine(in_hole), DELDRIFT_INVALID_VALUE, "quality.least_angle[0] is 40");
}

struct Broken {
    int after;
};

static void functions_are_asked_and_may_throw() {
    Triangulation t = domain();
    Quality quality;
    std::size_t n_asked = 0;
    quality.is_too_large = [&n_asked](const Corners &c) {
        n_asked++;
        return longest_edge(c) > 0.3 + std::min({c[0][1], c[1][1], c[2][1]}) / 4;
    };
    const std::uint64_t inserted = t.refine(quality).inserted;
    CHECK(n_asked > inserted && inserted > 50 && t.refine(quality).inserted == 0);
    for (const Corners &c : cells_in_domain(t)) CHECK(!quality.is_too_large(c));

    // All or nothing, also where other criteria would have been reached after the exception.
    for (const int after : {0, 5, 200}) {
        Triangulation other = domain();
        const std::vector<unsigned char> before = other.save();
        const deldrift_triangulation *const native = other.native();
        quality.greatest_area = 0.01;
        int left = after;
        quality.is_too_large = [&left, after](const Corners &) {
            if (left-- == 0) throw Broken{after};
            return true;
        };
        bool is_caught = false;
        try {
            other.refine(quality);
        } catch (const Broken &broken) {
            is_caught = broken.after == after && left == -1;
        }
        CHECK(is_caught && other.save() == before && other.id_count() == 8 && other.native() == native);
        other.validate(3);
        quality.is_too_large = nullptr;
        CHECK(other.refine(quality).inserted > 1000 && other.timestamp() == 2);
    }
}

static void cells_are_delaunay_on_request() {
    Triangulation t = domain();
    Quality quality;
    quality.is_conforming = true;
    CHECK(t.refine(quality).inserted > 0 && t.refine(quality).inserted == 0);
    const std::vector<std::array<std::uint32_t, 3>> sides = t.segments_of_cells();
    const auto levels = t.nesting_levels();
    const auto positions = t.positions<2>();
    std::size_t cell = 0, n_sides = 0;
    for (const auto row : t.cells().rows<3>()) {
        for (std::size_t i = 0; i < 3 && levels[cell] % 2 == 1; i++) {
            if (sides[cell][i] == DELDRIFT_NONE) continue;
            const auto &o = positions[row[i]], &a = positions[row[(i + 1) % 3]], &b = positions[row[(i + 2) % 3]];
            CHECK((a[0] - o[0]) * (b[0] - o[0]) + (a[1] - o[1]) * (b[1] - o[1]) >= 0);
            n_sides++;
        }
        cell++;
    }
    CHECK(n_sides == t.segments().size());
}

static void what_fails_has_no_effect() {
    Quality quality;
    quality.greatest_area = 0.01;
    Triangulation t(2, corners);
    t.stage_segments({Ends{0, 1}});
    CHECK_THROWS(t.refine(quality), DELDRIFT_STAGED_VERTEX, "segments");
    CHECK_THROWS(t.coarsen(quality), DELDRIFT_STAGED_VERTEX, "segments");
    Triangulation solid(3, std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
    CHECK_THROWS(solid.refine(quality), DELDRIFT_INVALID_DIMENSION, "must be 2");
    CHECK_THROWS(solid.made_vertices(), DELDRIFT_INVALID_DIMENSION, "must be 2");
    CHECK_THROWS(solid.original_segments(), DELDRIFT_INVALID_DIMENSION, "must be 2");
}

int main() {
    cells_have_the_quality();
    ids_are_given_again();
    sizes_and_labels_are_taken();
    functions_are_asked_and_may_throw();
    cells_are_delaunay_on_request();
    what_fails_has_no_effect();
    return 0;
}
