// Positions in every arrangement, and cells, facets, stars and vertices with the algorithms of the standard library.
#include "check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deldrift.hpp>
#include <iterator>
#include <numeric>
#include <random>
#include <set>
#include <type_traits>
#ifdef __cpp_lib_span
#include <span>
#endif

using deldrift::Cells;
using deldrift::Positions;
using deldrift::Row;
using deldrift::Triangulation;

// ------------------------------------------------------------------------------------------------ categories

template <class Iterator>
using category = typename std::iterator_traits<Iterator>::iterator_category;

static_assert(std::is_same_v<category<Cells::iterator>, std::random_access_iterator_tag>);
static_assert(std::is_same_v<category<deldrift::Star::iterator>, std::random_access_iterator_tag>);
static_assert(std::is_same_v<category<deldrift::span<double>::iterator>, std::random_access_iterator_tag>);
static_assert(std::is_same_v<category<deldrift::Vertices::iterator>, std::bidirectional_iterator_tag>);
static_assert(std::is_same_v<category<Cells::facet_range<true>::iterator>, std::bidirectional_iterator_tag>);
static_assert(std::is_same_v<std::iterator_traits<Cells::iterator>::value_type, Row>);
static_assert(std::is_same_v<std::iterator_traits<Cells::iterator>::difference_type, std::ptrdiff_t>);
static_assert(std::is_default_constructible_v<Cells::iterator> && std::is_copy_assignable_v<Cells::iterator>);

#ifdef __cpp_lib_ranges
static_assert(std::ranges::random_access_range<Cells> && std::ranges::sized_range<Cells>);
static_assert(std::ranges::borrowed_range<Cells> && std::ranges::view<Cells>);
static_assert(std::ranges::random_access_range<deldrift::Star> && !std::ranges::borrowed_range<deldrift::Star>);
static_assert(std::ranges::bidirectional_range<deldrift::Vertices> && std::ranges::borrowed_range<deldrift::Vertices>);
static_assert(std::ranges::bidirectional_range<Cells::facet_range<true>>);
static_assert(std::ranges::borrowed_range<Cells::facet_range<false>>);
static_assert(std::ranges::contiguous_range<Row> && std::ranges::borrowed_range<Row> && std::ranges::view<Row>);
#endif

#ifdef __cpp_lib_span
static_assert(std::is_convertible_v<Row, std::span<const std::uint32_t>>);
static_assert(std::is_convertible_v<std::span<const std::uint32_t>, Row>);
static_assert(std::is_convertible_v<std::span<std::uint32_t>, Row>);
static_assert(std::is_convertible_v<std::span<const double, 3>, deldrift::span<const double>>);
static_assert(std::is_convertible_v<deldrift::span<double>, std::span<double>>);
static_assert(!std::is_convertible_v<std::span<const double>, deldrift::span<double>>);
#endif

// ------------------------------------------------------------------------------------------------- positions

static std::vector<double> random_numbers(std::size_t count) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> anywhere(-1, 1);
    std::vector<double> numbers(count);
    for (double &x : numbers) x = anywhere(random);
    return numbers;
}

// A program's own point, for which it has said what it looks like.
struct Point {
    double x, y, z;
};
template <>
struct deldrift::point_layout<Point> {
    using scalar = double;
    static constexpr std::uint32_t count = 3;
};

struct Particle {
    double mass;
    std::array<double, 3> position;
    float velocity[3];
    char name;
};

static const std::vector<double> flat = random_numbers(60);

// The positions that a triangulation has been given.
static std::vector<double> arrived(const Positions &positions) { return Triangulation(3, positions).positions(); }

static void positions_in_every_arrangement() {
    std::vector<std::array<double, 3>> arrays(20);
    std::vector<Point> points(20);
    std::vector<Particle> particles(20);
    std::vector<double> axes[3];
    static double raw[20][3];
    for (std::size_t i = 0; i < 20; i++) {
        for (std::size_t k = 0; k < 3; k++) {
            const double x = flat[3 * i + k];
            arrays[i][k] = particles[i].position[k] = raw[i][k] = x;
            particles[i].velocity[k] = static_cast<float>(x);
            axes[k].push_back(x);
        }
        points[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
    }
    CHECK(arrived(flat) == flat && arrived(arrays) == flat && arrived(points) == flat && arrived(raw) == flat);
    CHECK(arrived(Positions::separate(axes[0], axes[1], axes[2])) == flat);
    CHECK(arrived(Positions::strided(particles, &Particle::position)) == flat);
    CHECK(arrived(Positions::strided(&particles[0].position[0], 20, sizeof(Particle))) == flat);
    CHECK(arrived(deldrift::span<const double>(flat)) == flat);
    // Every other point.
    std::vector<double> half;
    for (std::size_t i = 0; i < 60; i += 6) half.insert(half.end(), &flat[i], &flat[i] + 3);
    CHECK(arrived(Positions::strided(flat.data(), 10, 6 * sizeof(double))) == half);
#ifdef __cpp_lib_span
    CHECK(arrived(std::span(flat)) == flat && arrived(std::span(arrays)) == flat);
#endif
}

// Where double precision numbers lie one after the other there is no copy.
static void contiguous_positions_are_not_copied() {
    std::vector<std::array<double, 2>> arrays{{0, 1}, {2, 3}};
    std::vector<double> room;
    CHECK(Positions(arrays).numbers("positions", 2, room).data() == arrays[0].data() && room.empty());
    CHECK(Positions(flat).numbers("positions", 3, room).data() == flat.data() && room.empty());
    const Positions adjacent = Positions::strided(arrays[0].data(), 2, 16);
    CHECK(adjacent.numbers("positions", 2, room).data() == arrays[0].data() && room.empty());
}

static void single_precision_is_exact() {
    std::vector<float> numbers;
    std::vector<std::array<float, 3>> arrays;
    std::vector<double> wanted;
    std::vector<float> axes[3];
    for (std::size_t i = 0; i < 60; i++) {
        numbers.push_back(static_cast<float>(flat[i]));
        wanted.push_back(static_cast<double>(numbers.back()));
        axes[i % 3].push_back(numbers.back());
        if (i % 3 == 2) arrays.push_back({numbers[i - 2], numbers[i - 1], numbers[i]});
    }
    // Numbers that are subnormal in single precision are not in double.
    numbers[0] = axes[0][0] = arrays[0][0] = 1e-45f;
    wanted[0] = std::ldexp(1.0, -149);
    CHECK(arrived(numbers) == wanted && arrived(arrays) == wanted);
    CHECK(arrived(Positions::separate(axes[0], axes[1], axes[2])) == wanted);
    CHECK(arrived(Positions::strided(numbers.data(), 20, 3 * sizeof(float))) == wanted);

    Triangulation t(3, flat);
    t.move_vertices(numbers);
    t.commit_timestamp();
    CHECK(t.positions() == wanted);
    t.commit_positions(flat);
    t.move_vertices({3, 4}, std::vector<std::array<float, 3>>{arrays[3], arrays[4]});
    t.commit_timestamp();
    CHECK(t.position<3>(4)[1] == wanted[13] && t.position<3>(5)[1] == flat[16]);
    CHECK(t.stage_insertions(std::vector<float>{2, 3, 4}) == 20);
    t.commit_timestamp();
    CHECK((t.position<3>(20) == std::array<double, 3>{2, 3, 4}));
    CHECK(t.locate_points(arrays).size() == 20);
}

static void wrong_positions_are_refused() {
    std::vector<double> x(4), y(3), z(4);
    CHECK_THROWS(Positions::separate(x, y, z), DELDRIFT_WRONG_COUNT, "y has 3 numbers, but must have 4");
    CHECK_THROWS(Triangulation(3, Positions::separate(x, z)), DELDRIFT_WRONG_COUNT,
                 "positions have 2 coordinates each, but must have 3");
    CHECK_THROWS(Triangulation(2, std::vector<std::array<double, 3>>(3)), DELDRIFT_WRONG_COUNT, "must have 2");
    CHECK_THROWS(Triangulation(4, Positions::strided(x.data(), 1, 8)), DELDRIFT_INVALID_DIMENSION, "dimension is 4");
    CHECK_THROWS(Triangulation(2, std::vector<float>(5)), DELDRIFT_WRONG_COUNT, "positions has 5 numbers");
    const float *nowhere = nullptr;
    CHECK_THROWS(Triangulation(2, Positions::strided(nowhere, 1, 8)), DELDRIFT_NULL_ARGUMENT, "positions is NULL");
    CHECK_THROWS(Triangulation(2, std::array<float, 2>{1, NAN}), DELDRIFT_NOT_FINITE, "positions[0], coordinate 1");
    CHECK(Triangulation(2, Positions::strided(std::vector<Particle>(), &Particle::velocity)).vertex_count() == 0);
    const Triangulation t(3, flat);
    CHECK_THROWS(t.position<2>(0), DELDRIFT_WRONG_COUNT, "positions of 2 coordinates");
    CHECK_THROWS(t.positions<2>(), DELDRIFT_WRONG_COUNT, "the dimension is 3");
}

static void positions_as_arrays() {
    const Triangulation t(3, flat);
    const std::vector<std::array<double, 3>> positions = t.positions<3>();
    CHECK(positions.size() == 20 && positions[7][1] == flat[22] && t.position<3>(7) == positions[7]);
    CHECK(Triangulation(2, {}).positions<2>().empty());
}

// What is given as numbers one after the other, in rows: the same answers.
template <std::size_t N>
static std::vector<std::array<double, N>> in_rows(const std::vector<double> &numbers) {
    std::vector<std::array<double, N>> rows(numbers.size() / N);
    for (std::size_t i = 0; i < N * rows.size(); i++) rows[i / N][i % N] = numbers[i];
    return rows;
}

static void rows_go_wherever_numbers_do() {
    const Triangulation t(3, flat);
    const std::vector<double> values(20, 1.5), at{0.5, 0.25, 0.5, 0.25, 0.5, 0.5};
    const std::vector<float> floats(at.begin(), at.end());
    const std::vector<double> interpolated = t.interpolate(DELDRIFT_INTERPOLATION_LINEAR, values, 1, at, {7.0});
    CHECK(t.interpolate(DELDRIFT_INTERPOLATION_LINEAR, values, 1, in_rows<3>(at), {7.0}) == interpolated);
    CHECK(t.interpolate(DELDRIFT_INTERPOLATION_LINEAR, values, 1, floats, {7.0}) == interpolated);
    CHECK_THROWS(t.interpolate(DELDRIFT_INTERPOLATION_LINEAR, values, 1, in_rows<2>(at)), DELDRIFT_WRONG_COUNT,
                 "positions have 2 coordinates each");
    const std::vector<double> low{0, 0, 0, 0.5, 0.5, 0.5}, high{0.5, 0.5, 0.5, 2, 2, 2};
    CHECK(t.cells_in_reach(in_rows<3>(low), in_rows<3>(high)).cells == t.cells_in_reach(low, high).cells);
    CHECK(t.vertices_in_reach(in_rows<3>(low), high).vertices == t.vertices_in_reach(low, high).vertices);
    CHECK(t.hull_facets_in_reach(low, in_rows<3>(high)).cells == t.hull_facets_in_reach(low, high).cells);
    const std::vector<double> walls{1, 0, 0, 0.75, 0, -1, 0, 0};
    const auto within = [&](const Positions &half_spaces) {
        return t.voronoi_cells_within({-9, -9, -9}, {9, 9, 9}, half_spaces).volumes;
    };
    CHECK(within(in_rows<4>(walls)) == within(walls) && within(walls) != within({}));
    CHECK(t.voronoi_derivatives_within({-9, -9, -9}, {9, 9, 9}, in_rows<4>(walls)).measures ==
          t.voronoi_derivatives_within({-9, -9, -9}, {9, 9, 9}, walls).measures);
    CHECK_THROWS(within(in_rows<2>(walls)), DELDRIFT_WRONG_COUNT, "half_spaces have 2 coordinates each, but must have 4");
    const std::vector<std::array<double, 2>> corners{{0, 0}, {1, 0}, {0, 1}, {0.25, 0.25}};
    CHECK(deldrift::in_sphere(2, corners) == 1);
    CHECK(deldrift::orientation(2, std::vector<std::array<double, 2>>{{0, 0}, {0, 1}, {1, 0}}) == -1);
    const std::vector<std::array<double, 2>> box{{2, 0}, {0.5, 2}}, later{{3, 0}, {0, 2}};
    const std::vector<double> flat_near{2.125, 0, 1, 0, 0, 1, 0.25, 0.25};
    const std::vector<std::array<double, 2>> near = in_rows<2>(flat_near);
    Triangulation p(2, corners, deldrift::Periodic(box));
    CHECK(p.vectors() == std::vector<double>({2, 0, 0.5, 2}));
    CHECK(p.wrap_positions(corners).places == p.wrap_positions(std::vector<double>{0, 0, 1, 0, 0, 1, 0.25, 0.25}).places);
    CHECK(p.wrap_positions(corners, near).shifts == p.wrap_positions(corners, flat_near).shifts);
    CHECK(p.wrap_positions(corners, near).shifts != p.wrap_positions(corners).shifts);
    p.stage_vectors(later);
    p.commit_timestamp();
    CHECK(p.vectors() == std::vector<double>({3, 0, 0, 2}));
}

// ----------------------------------------------------------------------------------------------------- cells

static void cells_with_algorithms() {
    const Triangulation t(3, flat);
    const Cells cells = t.cells();
    const auto has = [](std::uint32_t v) {
        return [v](Row cell) { return std::find(cell.begin(), cell.end(), v) != cell.end(); };
    };
    CHECK(std::count_if(cells.begin(), cells.end(), has(7)) == static_cast<std::ptrdiff_t>(t.star(7).size()));
    CHECK(std::distance(cells.begin(), cells.end()) == static_cast<std::ptrdiff_t>(cells.size()));
    const auto found = std::find_if(t.cells().begin(), t.cells().end(), has(3));
    CHECK(has(3)(*found) && found->size() == 4 && found == cells.begin() + (found - cells.begin()));
    CHECK(std::all_of(std::make_reverse_iterator(cells.end()), std::make_reverse_iterator(found), has(3)) == false);

    // Whatever an iterator with random access can do.
    auto i = cells.begin();
    const auto first = i++;
    CHECK(i == first + 1 && i == 1 + first && i - first == 1 && first < i && i > first && first <= i && i >= first);
    CHECK(i-- == first + 1 && i == first && ++i != first && --i == first && first[2].data() == cells[2].data());
    CHECK(((i += 3) - first) == 3 && (i -= 2) == first + 1 && i - 1 == first);
    CHECK(!cells.empty() && cells.corners_per_cell() == 4);
    const std::vector<Row> rows(cells.begin(), cells.end());
    CHECK(rows.size() == cells.size() && rows.back().back() == cells.vertices().back());
    CHECK(rows.front().front() == cells.vertices()[0] && rows[1].subspan(1, 2)[0] == cells[1][1]);
    CHECK(*cells[0].rbegin() == cells[0][3] && std::distance(cells[0].rbegin(), cells[0].rend()) == 4);

    std::size_t n = 0;
    for (auto [a, b, c, d] : t.cells().rows<4>()) {
        CHECK(a == cells[n][0] && b == cells[n][1] && c == cells[n][2] && d == cells[n][3]);
        n++;
    }
    CHECK(n == cells.size() && cells.rows<4>().size() == n && cells.rows<4>().begin()[1] == *++cells.rows<4>().begin());
    CHECK_THROWS(cells.rows<3>(), DELDRIFT_WRONG_COUNT, "rows of 3 ids, but cells have 4 corners");
#ifdef __cpp_lib_ranges
    CHECK(std::ranges::count_if(t.cells(), has(7)) == static_cast<std::ptrdiff_t>(t.star(7).size()));
    auto last = t.cells() | std::views::filter(has(3)) | std::views::reverse | std::views::take(1);
    CHECK(has(3)(*last.begin()));
#endif
}

// Euler's relation counts the facets; the hull's are those that one cell has.
static void facets_are_each_there_once(std::uint32_t dimension) {
    const Triangulation t(dimension, flat);
    const Cells cells = t.cells();
    std::set<std::set<std::uint32_t>> facets, hull, wanted;
    for (const deldrift::Facet facet : cells.facets()) {
        const auto vertices = facet.vertices();
        CHECK(vertices.size() == dimension && vertices.data() == vertices.begin());
        CHECK(facets.emplace(vertices.begin(), vertices.end()).second);
        CHECK(facet.neighbour == cells.neighbours_of(facet.cell)[facet.corner]);
        if (facet.is_on_hull()) hull.emplace(vertices.begin(), vertices.end());
        // The corner is inside, the neighbour outside.
        std::vector<double> points;
        for (std::uint32_t v : vertices) {
            for (double x : t.position(v)) points.push_back(x);
        }
        for (double x : t.position(cells[facet.cell][facet.corner])) points.push_back(x);
        CHECK(deldrift::orientation(dimension, points) == (dimension == 2 ? 1 : -1));
    }
    for (Row cell : cells) {
        for (std::size_t k = 0; k <= dimension; k++) {
            std::set<std::uint32_t> facet(cell.begin(), cell.end());
            facet.erase(cell[k]);
            wanted.insert(facet);
        }
    }
    CHECK(facets == wanted);
    CHECK(2 * facets.size() == (dimension + 1) * cells.size() + hull.size());
    CHECK(cells.hull_facets().size() == hull.size() && !cells.hull_facets().empty());
    for (const auto &facet : cells.hull_facets()) {
        const auto vertices = cells.facet(facet.cell, facet.corner).vertices();
        CHECK(facet.is_on_hull() && hull.count({vertices.begin(), vertices.end()}) == 1);
        CHECK(vertices[0] == facet.vertices()[0]);
    }
    auto i = cells.facets().begin();
    const auto first = i++;
    CHECK(i != first && first->cell == 0 && std::next(first) == i && (*first).corner == 0);
    CHECK(--i == first && i++ == first && i-- != first && i == first);
    CHECK(Triangulation(dimension, {}).cells().facets().empty());
}

static void stars_and_vertices() {
    Triangulation t(2, flat);
    t.remove_vertex(0);
    t.remove_vertex(11);
    t.insert_vertex(t.position(5));
    std::size_t sum = 0;
    for (std::uint32_t v : t.vertices()) {
        const auto cells = t.cells_of(v);
        CHECK(!cells.empty() && cells.size() == t.star(v).size() && cells[0].cell == t.star(v)[0]);
        for (const auto cell : cells) {
            CHECK(cell.vertices[cell.corner] == t.coincident_representative(v));
            CHECK(cell.vertices.data() == t.cells()[cell.cell].data());
            CHECK(cell.neighbours.data() == t.cells().neighbours_of(cell.cell).data());
        }
        if (t.coincident_representative(v) == v) sum += cells.size();
        CHECK(std::all_of(cells.begin(), cells.end(), [](const auto &cell) { return cell.vertices.size() == 3; }));
    }
    CHECK(sum == 3 * t.cell_count());
    const auto vertices = t.vertices();
    const std::vector<std::uint32_t> ids(vertices.begin(), vertices.end());
    std::vector<std::uint32_t> wanted(31);
    std::iota(wanted.begin(), wanted.end(), 0u);
    wanted.erase(wanted.begin() + 11);
    wanted.erase(wanted.begin());
    CHECK(ids == wanted && vertices.size() == 29 && !vertices.empty());
    CHECK(Triangulation(2, {}).vertices().empty());
}

static void spans() {
    double values[] = {1, 2, 3};
    const deldrift::span<double> of_array(values);
    of_array[1] = 5;
    const deldrift::span<const double> constant = of_array;
    CHECK(constant.size() == 3 && constant[1] == 5 && constant.front() == 1 && constant.back() == 3);
#ifdef __cpp_lib_span
    const std::span<const double> standard = constant;
    const deldrift::span<const double> back = standard;
    CHECK(standard.data() == values && standard.size() == 3 && back.data() == values && back.size() == 3);
#endif
}

static void orientations() {
    CHECK(deldrift::orientation(2, {0.0, 0.0, 1.0, 0.0, 0.0, 1.0}) == 1);
    CHECK(deldrift::orientation(3, std::vector<double>(12)) == 0);
    CHECK_THROWS(deldrift::orientation(3, std::vector<double>(9)), DELDRIFT_WRONG_COUNT, "must have 12");
    CHECK_THROWS(deldrift::orientation(4, std::vector<double>(20)), DELDRIFT_INVALID_DIMENSION, "dimension is 4");
}

int main() {
    positions_in_every_arrangement();
    contiguous_positions_are_not_copied();
    single_precision_is_exact();
    wrong_positions_are_refused();
    positions_as_arrays();
    rows_go_wherever_numbers_do();
    cells_with_algorithms();
    facets_are_each_there_once(2);
    facets_are_each_there_once(3);
    stars_and_vertices();
    spans();
    orientations();
}
