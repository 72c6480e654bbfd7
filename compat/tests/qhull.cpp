// qh_new_qhull as programs call it, with the library loaded before libqhull_r: cells, neighbours and points that are no
// vertices against those of qhull itself; what is passed on; errors; threads.
extern "C" {
#include <libqhull_r/qhull_ra.h>
}
#include <dlfcn.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <thread>

#include "check.hpp"

namespace {

using Function = decltype(&qh_new_qhull);

// qhull's own, and the one that programs get.
const Function original = reinterpret_cast<Function>(dlsym(dlopen(QHULL_LIBRARY, RTLD_NOW), "qh_new_qhull"));
const Function own = qh_new_qhull;

bool is_served_by_deldrift() {
    const char *mode = std::getenv("DELDRIFT_COMPAT");
    return mode == nullptr || std::strcmp(mode, "deldrift") == 0;
}

struct Found {
    int exit_code = -1;
    int n_facets = 0;
    CellSet cells;
    std::map<std::uint32_t, std::set<std::uint32_t>> coplanar; // points by the facet's corners, all of them
    std::string message;
};

// The first point at the place of each.
std::vector<std::uint32_t> first_at_place(unsigned dimension, const Points &points) {
    std::map<std::vector<double>, std::uint32_t> first;
    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i < points.size() / dimension; i++) {
        const auto *p = points.data() + i * dimension;
        result.push_back(first.emplace(std::vector<double>(p, p + dimension), i).first->second);
    }
    return result;
}

double orientation_of(coordT *const *corners, unsigned dimension) {
    double rows[3][3] = {};
    for (unsigned i = 0; i < dimension; i++)
        for (unsigned axis = 0; axis < dimension; axis++) rows[i][axis] = corners[i + 1][axis] - corners[0][axis];
    if (dimension == 2) return rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0];
    return rows[0][0] * (rows[1][1] * rows[2][2] - rows[1][2] * rows[2][1]) -
           rows[0][1] * (rows[1][0] * rows[2][2] - rows[1][2] * rows[2][0]) +
           rows[0][2] * (rows[1][0] * rows[2][1] - rows[1][1] * rows[2][0]);
}

// What programs read of a facet that is a cell.
void read_cell(qhT *qh, facetT *facet, unsigned dimension, bool has_exact_signs, bool is_own,
               const std::vector<std::uint32_t> &place, Found &found) {
    CHECK(facet->simplicial && facet->good && facet->normal != nullptr && facet->normal[dimension] < 1e-9);
    CHECK(qh_setsize(qh, facet->vertices) == static_cast<int>(dimension) + 1);
    CHECK(qh_setsize(qh, facet->neighbors) == static_cast<int>(dimension) + 1);
    std::uint32_t corners[4] = {};
    coordT *points[4] = {};
    unsigned k = 0;
    vertexT *vertex, **vertexp;
    FOREACHvertex_(facet->vertices) {
        corners[k] = place[static_cast<std::size_t>(qh_pointid(qh, vertex->point))];
        points[k++] = vertex->point;
        realT distance = 0;
        qh_distplane(qh, vertex->point, facet, &distance);
        CHECK(std::abs(distance) < 1e-9 * qh->MAXabs_coord);
        facetT *neighbor = SETelemt_(facet->neighbors, k - 1, facetT);
        CHECK(!qh_setin(neighbor->vertices, vertex) && qh_setin(neighbor->neighbors, facet));
    }
    // qhull triangulates facets of more corners in orientations of their own, and lists points near to a facet, too.
    if (has_exact_signs && is_own) CHECK((orientation_of(points, dimension) > 0) == (facet->toporient != 0));
    insert_cell(found.cells, corners, dimension + 1, 0u);
    pointT *point, **pointp;
    FOREACHpoint_(facet->coplanarset) {
        const auto at = place[static_cast<std::size_t>(qh_pointid(qh, point))];
        if (is_own) CHECK(std::find(corners, corners + dimension + 1, at) != corners + dimension + 1);
        found.coplanar[at].insert(static_cast<std::uint32_t>(qh_pointid(qh, point)));
    }
}

// qhull's own check of lists, neighbours, orientations and vertices; its exit code.
int check_structure(qhT *qh) {
    const int exit_code = setjmp(qh->errexit);
    if (exit_code == 0) {
        qh->NOerrexit = False;
        qh_triangulate(qh);
        qh_checkpolygon(qh, qh->facet_list);
        qh_vertexneighbors(qh);
        qh_checkpolygon(qh, qh->facet_list);
    }
    qh->NOerrexit = True;
    return exit_code;
}

Found call(Function function, unsigned dimension, Points points, const char *command, bool has_exact_signs = true) {
    Found found;
    qhT storage;
    qhT *qh = &storage;
    char *message = nullptr;
    std::size_t length = 0;
    FILE *errfile = open_memstream(&message, &length);
    qh_zero(qh, errfile);
    const auto place = first_at_place(dimension, points);
    const int n_points = static_cast<int>(points.size() / dimension);
    std::string text = command;
    // qhull keeps points of its own: the caller's are of no use afterwards.
    found.exit_code = function(qh, static_cast<int>(dimension), n_points, points.data(), False, text.data(), nullptr,
                               errfile);
    std::fill(points.begin(), points.end(), 0.0);
    const bool is_own = function == own && is_served_by_deldrift();
    const bool has_cells = dimension < 4 && std::strstr(command, " d ") && std::strstr(command, " Qt") &&
                           !std::strstr(command, " Qu");
    facetT *facet;
    if (found.exit_code == 0) {
        FORALLfacets {
            found.n_facets++;
            if (!has_cells || facet->upperdelaunay) continue;
            read_cell(qh, facet, dimension, has_exact_signs, is_own, place, found);
        }
        CHECK(qh->num_facets == found.n_facets);
        CHECK(check_structure(qh) == 0);
    }
    qh_freeqhull(qh, !qh_ALL);
    int n_left = 0, bytes_left = 0;
    qh_memfreeshort(qh, &n_left, &bytes_left);
    CHECK(n_left == 0 && bytes_left == 0);
    std::fclose(errfile);
    found.message.assign(message, length);
    std::free(message);
    return found;
}

const char *const with_infinity = "qhull d Qt Qbb Qc Qz";
const char *const without_infinity = "qhull d Qbb Qt Qc";

// Cells, and points that are no vertices: of those at one place qhull may take another one for the vertex.
void check_same(unsigned dimension, const Points &points, const char *command) {
    const Found a = call(own, dimension, points, command), b = call(original, dimension, points, command);
    CHECK(a.exit_code == 0 && b.exit_code == 0);
    CHECK(a.cells == b.cells);
    CHECK(a.coplanar.size() == b.coplanar.size());
    for (const auto &[place, ids] : a.coplanar) CHECK(b.coplanar.at(place).size() == ids.size());
}

Points turned(Points points, unsigned dimension, double angle) {
    for (std::size_t i = 0; i < points.size(); i += dimension)
        for (unsigned axis = 0; axis + 1 < dimension; axis++) {
            double &x = points[i + axis], &y = points[i + axis + 1];
            const double before = x;
            x = std::cos(angle) * before - std::sin(angle) * y;
            y = std::sin(angle) * before + std::cos(angle) * y;
        }
    return points;
}

// Points in a box, on its faces and, in space, on its edges, with its corners.
Points box(unsigned dimension, std::size_t n, unsigned seed) {
    std::mt19937_64 random(seed);
    Points points;
    for (unsigned corner = 0; corner < 1u << dimension; corner++)
        for (unsigned axis = 0; axis < dimension; axis++) points.push_back(corner >> axis & 1);
    while (points.size() < n * dimension) {
        double place[3];
        for (double &x : place) x = static_cast<double>(random() >> 11) * 0x1p-53;
        const unsigned n_fixed = random() % dimension;
        for (unsigned i = 0, axis = random() % dimension; i < n_fixed; i++, axis++)
            place[axis % dimension] = random() % 2;
        points.insert(points.end(), place, place + dimension);
    }
    return points;
}

Points grid(unsigned dimension, unsigned side) {
    Points points;
    for (unsigned i = 0; i < (dimension == 2 ? side * side : side * side * side); i++)
        for (unsigned axis = 0, rest = i; axis < dimension; axis++, rest /= side) points.push_back(rest % side);
    return points;
}

double measure(unsigned dimension, const Points &points, const CellSet &cells) {
    double sum = 0;
    for (const auto &cell : cells) {
        coordT *corners[4] = {};
        for (unsigned i = 0; i <= dimension; i++)
            corners[i] = const_cast<double *>(points.data()) + cell[i] * dimension;
        sum += std::abs(orientation_of(corners, dimension));
    }
    return sum / (dimension == 2 ? 2 : 6);
}

void general_points(const char *command) {
    for (const unsigned dimension : {2u, 3u}) {
        for (const std::size_t n : {5u, 6u, 10u, 63u, 64u, 500u})
            for (unsigned seed = 0; seed < 5; seed++) check_same(dimension, random_points(dimension, n, seed), command);
        Points points = random_points(dimension, 300, 7);
        for (unsigned step = 0; step < 10; step++) {
            points = moved(points, 0.003, step);
            check_same(dimension, points, command);
            if (is_served_by_deldrift())
                CHECK(call(own, dimension, points, command).cells == fresh_cells(dimension, points));
        }
    }
}

// Cells along the hull that are flat but for rounding are dropped.
void turned_boxes() {
    for (const unsigned dimension : {2u, 3u})
        for (unsigned seed = 0; seed < 5; seed++)
            for (const double angle : {0.0, 0.3, 0.777, 2.1})
                check_same(dimension, turned(box(dimension, 300, seed), dimension, angle), with_infinity);
}

void lattices() {
    for (const double angle : {0.0, 0.3, 1.1}) {
        // Squares have either diagonal.
        const Points points = turned(grid(2, 30), 2, angle);
        const Found a = call(own, 2, points, with_infinity), b = call(original, 2, points, with_infinity);
        CHECK(a.exit_code == 0 && b.exit_code == 0);
        CHECK(a.cells.size() == b.cells.size() && a.cells.size() == 2 * 29 * 29);
        for (const auto &cell : a.cells) CHECK(std::abs(measure(2, points, {cell}) - 0.5) < 1e-12);
        const Points in_space = turned(grid(3, 6), 3, angle);
        const Found c = call(own, 3, in_space, with_infinity, angle == 0);
        CHECK(c.exit_code == 0 && std::abs(measure(3, in_space, c.cells) - 125) < 1e-9);
        if (is_served_by_deldrift() && angle == 0) {
            CHECK(a.cells == fresh_cells(2, points));
            CHECK(c.cells == fresh_cells(3, in_space));
        }
    }
}

// Few points, many of them cocircular, coplanar, at one place or nearly on a line.
void small_sets() {
    for (unsigned seed = 0; seed < 600; seed++) {
        std::mt19937_64 random(seed);
        const unsigned dimension = 2 + random() % 2;
        Points points = lattice_points(dimension, dimension + 1 + random() % 40, 2 + random() % 6, seed);
        if (random() % 2 == 0) points = turned(points, dimension, 0.1 * static_cast<double>(1 + random() % 30));
        const char *command = random() % 2 == 0 ? with_infinity : without_infinity;
        const Found a = call(own, dimension, points, command, false), b = call(original, dimension, points, command);
        // Points on one circle or sphere, which qhull refuses without the point at infinity.
        if (command == without_infinity && a.exit_code == 0 && b.exit_code == qh_ERRinput) continue;
        CHECK(a.exit_code == b.exit_code);
        const double covered = measure(dimension, points, a.cells);
        CHECK(std::abs(covered - measure(dimension, points, b.cells)) <= 1e-9 * covered);
    }
}

void coincident_points() {
    for (const unsigned dimension : {2u, 3u}) {
        Points points = random_points(dimension, 100, 3);
        points.insert(points.end(), points.begin(), points.begin() + 40 * dimension);
        points.insert(points.end(), points.begin(), points.begin() + 10 * dimension);
        check_same(dimension, points, with_infinity);
        check_same(dimension, points, without_infinity);
        const Found found = call(own, dimension, points, "qhull d Qt Qbb Qz");
        CHECK(found.exit_code == 0 && found.coplanar.empty());
    }
}

// Calls that qhull refuses: the same exit code, and a message.
void refused() {
    const std::vector<std::pair<unsigned, Points>> refused = {
        {2, {0, 0, 1, 0, 0, 1}},
        {2, {0, 0}},
        {2, {0, 0, 1, 1, 2, 2, 3, 3, 5, 5}},
        {2, {1, 1, 1, 1, 1, 1, 1, 1, 1, 1}},
        {2, {1, 0, 0, 1, -1, 0, 0, -1}},
        {2, turned({0, 0, 1, 0, 2, 0, 3, 0, 5, 0, 9, 0}, 2, 0.3)},
        {3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0.3, 0.6, 0, 0.5, 0.1, 0}},
    };
    for (const char *command : {with_infinity, without_infinity})
        for (const auto &[dimension, points] : refused) {
            const Found a = call(own, dimension, points, command), b = call(original, dimension, points, command);
            CHECK(a.exit_code == b.exit_code && a.message.empty() == b.message.empty());
            CHECK(a.cells.size() == b.cells.size());
        }
    CHECK(call(own, 2, random_points(2, 20, 1), "d Qt Qbb Qz").exit_code != 0);
    CHECK(call(own, 2, random_points(2, 20, 1), "qhull d Qt Qbb Qw9z Qz").exit_code ==
          call(original, 2, random_points(2, 20, 1), "qhull d Qt Qbb Qw9z Qz").exit_code);
}

// qhull itself may crash on NaN.
void not_finite() {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        for (const unsigned dimension : {2u, 3u}) {
            Points points = random_points(dimension, 20, 1);
            points[11] = bad;
            const Found found = call(own, dimension, points, with_infinity);
            CHECK(found.exit_code == qh_ERRinput && found.message.find("deldrift: ") == 0);
        }
}

void passed_on() {
    const std::pair<unsigned, const char *> calls[] = {
        {3, "qhull Qt"}, {2, "qhull d Qbb Qc Qz"}, {2, "qhull v Qbb"}, {4, "qhull d Qt Qbb Qx"}, {2, "qhull d Qt Qu"},
        {2, "qhull d QJ Tv"}};
    for (const auto &[dimension, command] : calls) {
        const Points points = random_points(dimension, 60, 5);
        const Found a = call(own, dimension, points, command), b = call(original, dimension, points, command);
        CHECK(a.exit_code == 0 && a.exit_code == b.exit_code && a.n_facets == b.n_facets && a.n_facets > 0);
    }
}

// Points that qhull frees, and a qhT for two calls.
void used_twice() {
    qhT storage;
    qhT *qh = &storage;
    qh_zero(qh, stderr);
    for (unsigned seed = 0; seed < 2; seed++) {
        const Points points = random_points(2, 80, seed);
        auto *copy = static_cast<coordT *>(qh_malloc(points.size() * sizeof(coordT)));
        std::copy(points.begin(), points.end(), copy);
        char command[] = "qhull d Qt Qbb Qc Qz Q12 Pp";
        CHECK(own(qh, 2, 80, copy, True, command, nullptr, stderr) == 0);
        int n_cells = 0;
        facetT *facet;
        FORALLfacets n_cells += !facet->upperdelaunay;
        CHECK(n_cells == static_cast<int>(fresh_cells(2, points).size()));
        qh_freeqhull(qh, !qh_ALL);
    }
    int n_left = 0, bytes_left = 0;
    qh_memfreeshort(qh, &n_left, &bytes_left);
    CHECK(n_left == 0 && bytes_left == 0);
}

void threads() {
    std::vector<std::thread> running;
    for (unsigned t = 0; t < 4; t++)
        running.emplace_back([t] {
            const unsigned dimension = 2 + t % 2;
            Points points = random_points(dimension, 200, t);
            for (unsigned step = 0; step < 10; step++) {
                points = moved(points, 0.002, step);
                CHECK(call(own, dimension, points, with_infinity).cells == fresh_cells(dimension, points));
            }
        });
    for (std::thread &each : running) each.join();
}

} // namespace

int main() {
    CHECK(original != nullptr && own != original);
    general_points(with_infinity);
    general_points(without_infinity);
    turned_boxes();
    lattices();
    small_sets();
    coincident_points();
    refused();
    if (is_served_by_deldrift()) not_finite();
    passed_on();
    used_twice();
    threads();
}
