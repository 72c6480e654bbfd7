// Vertices with weights in C++: states are regular triangulations by the definition, in whole numbers.
#include "check.hpp"

#include <array>
#include <cmath>
#include <set>

using deldrift::HiddenByWeight;
using deldrift::Triangulation;
using deldrift::Weights;

// Which numbers come is the same on every machine.
static std::uint64_t state = 7;
static std::int64_t below(std::int64_t n) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::int64_t>((state >> 33) % static_cast<std::uint64_t>(n));
}

struct Model {
    std::vector<std::array<double, 2>> places{};
    std::vector<double> weights{};
};

static Model drawn(std::size_t n) {
    Model m;
    for (std::size_t v = 0; v < n; v++) {
        m.places.push_back({double(below(9)), double(below(9))});
        m.weights.push_back(double(below(21) - 6));
    }
    return m;
}

// The lifted place of a vertex, as seen from another one.
struct Lifted {
    std::int64_t x, y, height;
};
static Lifted lifted(const Model &m, std::size_t v, std::size_t from) {
    const auto height = [&](std::size_t of) {
        const auto [x, y] = m.places[of];
        return std::int64_t(x * x + y * y - m.weights[of]);
    };
    return {std::int64_t(m.places[v][0] - m.places[from][0]), std::int64_t(m.places[v][1] - m.places[from][1]),
            height(v) - height(from)};
}

// Positive where a vertex is below the plane of three lifted ones, which are counter-clockwise.
static std::int64_t depth_of(const Model &m, const std::array<std::uint32_t, 3> &corners, std::size_t v) {
    const Lifted a = lifted(m, corners[0], v), b = lifted(m, corners[1], v), c = lifted(m, corners[2], v);
    return a.height * (b.x * c.y - b.y * c.x) - b.height * (a.x * c.y - a.y * c.x) + c.height * (a.x * b.y - a.y * b.x);
}

using Sets = std::set<std::set<std::uint32_t>>;

// The cells of a triangulation that is right: no vertex is below one, and who is in none is hidden.
static Sets checked(const Triangulation &t, const Model &m) {
    t.validate(3);
    CHECK(t.is_weighted() && t.weights() == m.weights && t.positions<2>() == m.places);
    Sets sets;
    std::vector<bool> is_corner(m.places.size()), is_hidden(m.places.size());
    for (const std::array<std::uint32_t, 3> row : t.cells().rows<3>()) {
        for (std::size_t v = 0; v < m.places.size(); v++) CHECK(depth_of(m, row, v) <= 0);
        for (const std::uint32_t v : row) is_corner[v] = true;
        sets.insert({row.begin(), row.end()});
    }
    const deldrift::Hidden by_place = t.hidden_vertices();
    for (std::size_t k = 0; k < by_place.size(); k++) {
        const std::uint32_t v = by_place.vertices[k], w = by_place.representatives[k];
        CHECK(m.places[v] == m.places[w] && m.weights[v] <= m.weights[w] && t.coincident_representative(v) == w);
        is_hidden[v] = true;
    }
    const HiddenByWeight by_weight = t.hidden_by_weight();
    CHECK(by_weight.vertices.size() == by_weight.cells.size());
    for (std::size_t k = 0; k < by_weight.size(); k++) {
        const std::uint32_t v = by_weight.vertices[k];
        CHECK(!is_hidden[v] && by_weight.cells[k] < t.cell_count());
        is_hidden[v] = true;
    }
    for (std::size_t v = 0; v < m.places.size(); v++) CHECK(is_corner[v] != is_hidden[v]);
    const deldrift_commit_report sums = t.statistics();
    CHECK(sums.hidden_by_weight == by_weight.size() && sums.coincident == by_place.size());
    return sets;
}

// The same cells as a fresh build, and as copies.
static void check(const Triangulation &t, const Model &m) {
    const Sets sets = checked(t, m);
    CHECK(checked(Triangulation(2, m.places, Weights(m.weights)), m) == sets);
    CHECK(checked(t.clone(), m) == sets && checked(Triangulation::load(t.save()), m) == sets);
}

static void live(deldrift_algorithm algorithm) {
    Model m = drawn(50);
    deldrift_options options = deldrift::default_options();
    options.algorithm = algorithm;
    Triangulation t(2, m.places, Weights(m.weights), options);
    check(t, m);
    std::size_t n_hidden = t.hidden_by_weight().size();
    for (int round = 0; round < 6; round++) {
        // Weights alone, both, and positions alone; and nothing at all.
        const Model other = drawn(m.places.size());
        const std::vector<double> before = m.weights;
        m.weights = other.weights;
        deldrift_commit_report report = t.commit_weighted({}, m.weights);
        std::uint64_t reweighted = 0;
        for (std::size_t v = 0; v < before.size(); v++) reweighted += before[v] != m.weights[v];
        CHECK(report.moved == 0 && report.reweighted == reweighted);
        CHECK(report.hidden_by_weight == t.hidden_by_weight().size());
        check(t, m);
        n_hidden += t.hidden_by_weight().size();
        m = drawn(m.places.size());
        t.commit_weighted(m.places, m.weights);
        check(t, m);
        m.places = other.places;
        CHECK(t.commit_weighted(m.places, {}).reweighted == 0);
        check(t, m);
        report = t.commit_weighted({}, {});
        CHECK(report.moved == 0 && report.reweighted == 0 && report.newly_hidden == 0 && report.newly_shown == 0);
        // Staged, of some and of the first ones, with insertions.
        m.weights[0] = 3, m.weights[1] = -2, m.weights[9] = 12;
        t.stage_weights(std::vector<double>{3, -2});
        t.stage_weights(std::vector<std::uint32_t>{9}, std::vector<double>{12});
        const Model more = drawn(2);
        const std::uint32_t first = t.stage_insertions(more.places);
        t.stage_weights(std::vector<std::uint32_t>{first, first + 1}, more.weights);
        m.places.insert(m.places.end(), more.places.begin(), more.places.end());
        m.weights.insert(m.weights.end(), more.weights.begin(), more.weights.end());
        CHECK(t.commit_timestamp().inserted == 2);
        check(t, m);
        m.weights[5] = double(below(20));
        t.set_weight(5, m.weights[5]);
        check(t, m);
        const Model last = drawn(3);
        CHECK(t.insert_vertex_with_weight(last.places[0], last.weights[0]) == m.places.size());
        const std::vector<std::array<double, 2>> two{last.places[1], last.places[2]};
        CHECK(t.stage_insertions(two, Weights({last.weights[1], last.weights[2]})) == m.places.size() + 1);
        t.commit_timestamp();
        m.places.insert(m.places.end(), last.places.begin(), last.places.end());
        m.weights.insert(m.weights.end(), last.weights.begin(), last.weights.end());
        check(t, m);
    }
    CHECK(n_hidden > 0);
}

static void hides_and_shows() {
    // A heavy vertex at the centre of a square, and a light one beside it.
    const std::vector<std::array<double, 2>> places{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {4, 4}, {5, 4}};
    std::vector<double> weights{0, 0, 0, 0, 9, -1};
    const std::vector<std::uint64_t> keys{1, 2, 3, 4, 5, 6};
    Triangulation t(2, places, Weights(weights), keys);
    CHECK(t.keys() == keys && t.hidden_by_weight().vertices == std::vector<std::uint32_t>{5});
    const auto [a, b, c] = t.cells().rows<3>().begin()[t.hidden_by_weight().cells[0]];
    CHECK((std::set<std::uint32_t>{a, b, c} == std::set<std::uint32_t>{1, 2, 4}));
    weights[5] = 9;
    const deldrift_commit_report report = t.commit_weighted(places, weights);
    CHECK(report.newly_shown == 1 && report.newly_hidden == 0 && t.hidden_by_weight().size() == 0);
    t.remove_vertex(4);
    CHECK(std::isnan(t.weights()[4]) && t.weights()[5] == 9);
}

// Radii are the roots of weights, wherever weights are given.
static void takes_radii() {
    using deldrift::Radii;
    const std::vector<std::array<double, 2>> places{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {4, 4}, {5, 4}};
    const std::vector<double> radii{0, 1, 2, 3, 4, 0.1};
    std::vector<double> squares;
    for (const double r : radii) squares.push_back(r * r);
    const std::vector<std::uint64_t> keys{6, 5, 4, 3, 2, 1};
    Triangulation t(2, places, Radii(radii)), keyed(2, places, Radii(radii), keys);
    CHECK(t.weights() == squares && keyed.weights() == squares && t.hidden_by_weight().size() == 1);
    t.commit_weighted({}, Radii({1, 1, 1, 1, 1, 1}));
    CHECK(t.hidden_by_weight().size() == 0);
    CHECK(t.commit_weighted(places, Radii(radii)).newly_hidden == 1);
    t.stage_weights(Radii({2}));
    t.stage_weights({3}, Radii({0.5}));
    CHECK(t.stage_insertions({2, 2}, Radii({3})) == 6);
    t.commit_timestamp();
    CHECK(t.weights()[0] == 4 && t.weights()[3] == 0.25 && t.weights()[6] == 9);
    t.take_changes();
    const std::uint32_t heavy = t.insert_vertex_with_weight({4, 5}, 100);
    const deldrift_changes changes = t.take_changes();
    const std::vector<std::uint32_t> hidden(changes.hidden, changes.hidden + changes.hidden_count);
    CHECK(heavy == 7 && !hidden.empty() && changes.shown_count == 0);
    t.remove_vertex(heavy);
    const deldrift_changes after = t.take_changes();
    const std::vector<std::uint32_t> shown(after.shown, after.shown + after.shown_count);
    CHECK(after.hidden_count == 0 && shown == hidden);
    CHECK_THROWS(Radii({1, -2}), DELDRIFT_INVALID_VALUE, "radii[1] is -2");
    CHECK_THROWS(Radii({NAN}), DELDRIFT_INVALID_VALUE, "radii[0] is nan");
    CHECK_THROWS(t.commit_weighted({}, Radii({1, 2})), DELDRIFT_WRONG_COUNT, "2");
    const std::vector<double> box{10, 0, 0, 10};
    const Triangulation repeated(2, places, Radii(radii), deldrift::Periodic{box});
    CHECK(repeated.weights() == squares);
}

// Power cells of a box fill it, and volumes follow weights as their derivatives say.
static void has_power_cells() {
    const std::vector<std::array<double, 2>> places{{1, 1}, {3, 1}, {1, 3}, {3, 3}, {2, 2}};
    std::vector<double> weights{0, 0.25, 0.5, 0, 1};
    Triangulation t(2, places, Weights(weights));
    const std::vector<double> low{0, 0}, high{4, 4};
    const deldrift::VoronoiWeightDerivatives before = t.voronoi_weight_derivatives(low, high);
    CHECK(before.volumes == t.voronoi_volumes(low, high) && before.derivatives.size() == t.edges().size() / 2);
    double sum = 0;
    for (const double volume : before.volumes) sum += volume;
    CHECK(std::fabs(sum - 16) < 1e-12);
    const double step = 1e-6;
    weights[4] += step;
    t.commit_weighted({}, weights);
    const std::vector<double> after = t.voronoi_volumes(low, high);
    const std::vector<std::uint32_t> edges = t.edges();
    double own = 0;
    for (std::size_t e = 0; 2 * e < edges.size(); e++) {
        if (edges[2 * e + 1] != 4) continue;
        const std::uint32_t other = edges[2 * e];
        CHECK(std::fabs((after[other] - before.volumes[other]) / step - before.derivatives[e]) < 1e-5);
        own -= before.derivatives[e];
    }
    CHECK(own > 0.5 && std::fabs((after[4] - before.volumes[4]) / step - own) < 1e-5);
    const std::vector<std::uint8_t> mask{1, 0, 0, 0, 0};
    const deldrift::VoronoiWeightDerivatives left = t.voronoi_weight_derivatives(low, high, {1.0, 0.0, 2.0}, mask);
    CHECK(left.volumes[0] > 0 && std::isnan(left.volumes[1]));
    CHECK_THROWS(t.voronoi_weight_derivatives(low, high, {1.0, 0.0}), DELDRIFT_WRONG_COUNT, "half_spaces has 2");
    CHECK(t.nearest_vertex(std::vector<double>{2.4, 2.4}) == 4);
    // All cells have the heaviest vertex for a corner, and so its place in reach.
    const std::vector<double> middle{2, 2}, far{40, 40};
    CHECK(t.cells_in_reach(middle, middle).cells.size() == 4 && t.cells_in_reach(far, far).cells.empty());
    CHECK(t.vertices_in_reach(middle, middle).vertices.size() == 5);
}

static void refuses() {
    const std::vector<double> square{0, 0, 4, 0, 4, 4, 0, 4}, weights{1, 2, 3, 4}, few{1, 2, 3};
    const std::vector<double> heavy{0, 0, 1e115, 0};
    const std::vector<std::uint64_t> key{1};
    CHECK_THROWS(Triangulation(2, square, Weights(few)), DELDRIFT_WRONG_COUNT, "weights has 3 numbers, but");
    CHECK_THROWS(Triangulation(2, square, Weights(weights), key), DELDRIFT_WRONG_COUNT, "keys has 1 numbers");
    CHECK_THROWS(Triangulation(2, square, Weights(heavy)), DELDRIFT_OUT_OF_RANGE, "weights[2]");
    Triangulation t(2, square, Weights(weights)), plain(2, square);
    CHECK_THROWS(t.commit_weighted(square, few), DELDRIFT_WRONG_COUNT, "weights has 3 numbers, but must have 4");
    CHECK_THROWS(t.commit_weighted({}, few), DELDRIFT_WRONG_COUNT, "3");
    CHECK_THROWS(t.stage_weights(std::vector<std::uint32_t>{0, 1}, few), DELDRIFT_WRONG_COUNT, "weights has 3 numbers");
    CHECK_THROWS(t.set_weight(4, 1), DELDRIFT_NO_SUCH_VERTEX, "4");
    CHECK(!plain.is_weighted());
    CHECK_THROWS(plain.weights(), DELDRIFT_NOT_WEIGHTED, "weights");
    CHECK_THROWS(plain.stage_weights(weights), DELDRIFT_NOT_WEIGHTED, "weights");
    CHECK_THROWS(plain.commit_weighted({}, weights), DELDRIFT_NOT_WEIGHTED, "weights");
    CHECK_THROWS(plain.hidden_by_weight(), DELDRIFT_NOT_WEIGHTED, "weights");
    CHECK(t.weights() == weights && t.timestamp() == 0 && t.staged_count() == 0);
    Triangulation none(2, {}, Weights({}));
    CHECK(none.is_weighted() && none.weights().empty() && none.commit_weighted({}, {}).timestamp == 1);
}

// One vertex that repeats is heavy enough to hide all others, until they are as heavy.
static void weights_in_a_box() {
    const std::vector<double> places{0.125, 0.25, 0.5, 0.75, 0.875, 0.375}, box{1, 0, 0.25, 1}, none(3);
    std::vector<double> weights{2, 0, 0};
    Triangulation t(2, places, Weights(weights), deldrift::Periodic{box});
    CHECK(t.is_weighted() && t.cell_count() == 2 && t.hidden_by_weight().vertices == (std::vector<std::uint32_t>{1, 2}));
    const auto report = t.commit_weighted({}, none);
    CHECK(report.newly_shown == 2 && report.reweighted == 1 && t.cell_count() == 6);
    Triangulation plain(2, places, deldrift::Periodic{box});
    CHECK(t.voronoi_volumes() == plain.voronoi_volumes());
    CHECK_THROWS(Triangulation(2, places, Weights(box), deldrift::Periodic{box}), DELDRIFT_WRONG_COUNT, "weights has 4 numbers, but");
}

int main() {
    weights_in_a_box();
    live(DELDRIFT_AUTO);
    live(DELDRIFT_REBUILDING);
    live(DELDRIFT_PLACEMENT_FLIPS);
    live(DELDRIFT_TOLERANCE);
    live(DELDRIFT_REPAIR);
    hides_and_shows();
    takes_radii();
    has_power_cells();
    refuses();
    return 0;
}
