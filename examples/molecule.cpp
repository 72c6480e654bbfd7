// The weighted alpha complex of a molecule while it moves: how many pieces its atoms make, how many tunnels go through
// them, and how many voids are between them.
//
// The molecule is made here, by a formula: the sixty carbon atoms of a fullerene, at the corners of a truncated
// icosahedron, and an atom of helium in their middle. It grows far beyond what it would endure, so that what has to
// come out is known, and its atoms tremble. A trajectory of any other molecule takes the same steps: places come in,
// and weights, the squares of radii by element, stay.
//
// The complex has the simplices of the regular triangulation whose balls have a place in common that is in no power
// cell of others. It has the pieces, tunnels and voids of the union of the balls (Edelsbrunner, 10.1007/BF02574053).
//
//   molecule [steps [picture.svg]]
#include "svg.hpp"

#include <deldrift.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using Place = std::array<double, 3>;

// In angstrom: van der Waals radii by element, the length of a bond, and how far the atoms tremble.
constexpr double carbon = 1.7, helium = 1.4, bond = 1.4327, tremor = 0.003;

// The corners of a truncated icosahedron, a bond apart from each other.
std::vector<Place> cage() {
    const double golden = (1 + std::sqrt(5.0)) / 2;
    const Place kinds[] = {{0, 1, 3 * golden}, {1, 2 + golden, 2 * golden}, {golden, 2, 2 * golden + 1}};
    std::vector<Place> corners;
    for (const Place &kind : kinds) {
        for (int signs = 0; signs < 8; signs++) {
            if ((signs & 1) != 0 && kind[0] == 0) continue;
            for (int turn = 0; turn < 3; turn++) {
                Place corner;
                for (int k = 0; k < 3; k++) {
                    corner[(k + turn) % 3] = bond / 2 * ((signs >> k & 1) != 0 ? -kind[k] : kind[k]);
                }
                corners.push_back(corner);
            }
        }
    }
    return corners;
}

double dot(const Place &a, const Place &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Place minus(const Place &a, const Place &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

struct Sphere {
    Place centre;
    double square;  // of its radius, and negative where the balls have a place in common
};

using Simplex = std::vector<std::uint32_t>;

struct Complex {
    const std::vector<Place> &places;
    const std::vector<double> &weights;
    // The value from which on a simplex is in the complex, of simplices of each dimension.
    std::array<std::map<Simplex, double>, 4> values;

    double power(const Place &at, std::uint32_t v) const {
        const Place apart = minus(at, places[v]);
        return dot(apart, apart) - weights[v];
    }

    // The smallest sphere of one power in respect of all of up to three vertices.
    Sphere sphere(const Simplex &of) const {
        Place centre = places[of[0]];
        std::array<Place, 2> u{};
        std::array<double, 2> lift{};
        for (std::size_t i = 1; i < of.size(); i++) {
            u[i - 1] = minus(places[of[i]], centre);
            lift[i - 1] = (dot(u[i - 1], u[i - 1]) - weights[of[i]] + weights[of[0]]) / 2;
        }
        if (of.size() == 2) {
            for (int k = 0; k < 3; k++) centre[k] += lift[0] / dot(u[0], u[0]) * u[0][k];
        } else if (of.size() == 3) {
            const double aa = dot(u[0], u[0]), ab = dot(u[0], u[1]), bb = dot(u[1], u[1]), det = aa * bb - ab * ab;
            const double a = (lift[0] * bb - lift[1] * ab) / det, b = (lift[1] * aa - lift[0] * ab) / det;
            for (int k = 0; k < 3; k++) centre[k] += a * u[0][k] + b * u[1][k];
        }
        return {centre, power(centre, of[0])};
    }

    // Of cells the library has the values. A simplex has that of its own sphere, unless a vertex beside it is within
    // that: then it comes with the first simplex that it is a side of.
    Complex(const std::vector<Place> &places, const std::vector<double> &weights, const deldrift::Triangulation &t)
        : places(places), weights(weights) {
        const std::vector<double> squares = t.circumcentres().squared_radii;
        const deldrift::Cells cells = t.cells();
        for (std::size_t c = 0; c < cells.size(); c++) {
            Simplex cell(cells[c].begin(), cells[c].end());
            std::sort(cell.begin(), cell.end());
            values[3][cell] = squares[c];
        }
        for (int d = 2; d >= 0; d--) {
            // Whether a vertex is within, and the first simplex.
            std::map<Simplex, std::pair<bool, double>> sides;
            for (const auto &[simplex, value] : values[d + 1]) {
                for (std::size_t i = 0; i < simplex.size(); i++) {
                    Simplex side(simplex);
                    side.erase(side.begin() + static_cast<std::ptrdiff_t>(i));
                    const Sphere own = sphere(side);
                    const bool is_within = power(own.centre, simplex[i]) < own.square;
                    auto &[is_any_within, first] = sides.try_emplace(side, is_within, value).first->second;
                    is_any_within = is_any_within || is_within;
                    first = std::min(first, value);
                }
            }
            for (const auto &[side, known] : sides) values[d][side] = known.first ? known.second : sphere(side).square;
        }
    }

    bool has(const Simplex &simplex) const { return values[simplex.size() - 1].at(simplex) <= 0; }
};

// Sets that are united.
struct Sets {
    std::vector<std::size_t> parents;
    explicit Sets(std::size_t count) : parents(count) { std::iota(parents.begin(), parents.end(), std::size_t{0}); }
    std::size_t find(std::size_t k) {
        while (parents[k] != k) k = parents[k] = parents[parents[k]];
        return k;
    }
    void unite(std::size_t a, std::size_t b) { parents[find(a)] = find(b); }
};

struct Shape {
    int pieces = 0, tunnels = 0, voids = 0;
};

Shape shape_of(const Complex &complex, const deldrift::Cells &cells) {
    Shape shape;
    int euler = 0;
    for (int d = 0; d < 4; d++) {
        for (const auto &row : complex.values[d]) euler += row.second <= 0 ? (d % 2 == 0 ? 1 : -1) : 0;
    }
    Sets atoms(complex.places.size());
    for (const auto &[edge, value] : complex.values[1]) {
        if (value <= 0) atoms.unite(edge[0], edge[1]);
    }
    for (const auto &[vertex, value] : complex.values[0]) {
        shape.pieces += value <= 0 && atoms.find(vertex[0]) == vertex[0];
    }
    // What is not in the complex, cell by cell, with all that is outside.
    const std::size_t outside = cells.size();
    Sets gaps(outside + 1);
    const auto sorted = [](const deldrift::Row &row, std::size_t without) {
        Simplex simplex;
        for (std::size_t i = 0; i < row.size(); i++) {
            if (i != without) simplex.push_back(row[i]);
        }
        std::sort(simplex.begin(), simplex.end());
        return simplex;
    };
    for (std::size_t c = 0; c < cells.size(); c++) {
        for (std::size_t i = 0; i < 4; i++) {
            const std::uint32_t other = cells.neighbours_of(c)[i];
            if (!complex.has(sorted(cells[c], i))) gaps.unite(c, other == DELDRIFT_NONE ? outside : other);
        }
    }
    for (std::size_t c = 0; c < cells.size(); c++) {
        shape.voids += gaps.find(c) == c && gaps.find(outside) != c && !complex.has(sorted(cells[c], 4));
    }
    shape.tunnels = shape.pieces + shape.voids - euler;
    return shape;
}

// The triangles of the complex, darker where they are nearer to the eye, and its edges in front.
void draw(Picture &picture, const Complex &complex, const std::string &caption) {
    picture.panel(caption);
    // As it is seen a little from above, and from the side.
    std::vector<Place> seen;
    double depth = 0;
    for (const Place &p : complex.places) {
        const double x = 0.8 * p[0] + 0.6 * p[2], z = 0.8 * p[2] - 0.6 * p[0];
        seen.push_back({x, 0.96 * p[1] - 0.28 * z, 0.96 * z + 0.28 * p[1]});
        depth = std::max(depth, std::abs(seen.back()[2]));
    }
    const auto height = [&](const Simplex &of) {
        double sum = 0;
        for (const std::uint32_t v : of) sum += seen[v][2];
        return sum / static_cast<double>(of.size()) / depth;
    };
    for (const auto &[triangle, value] : complex.values[2]) {
        if (value > 0) continue;
        const double *a = seen[triangle[0]].data(), *b = seen[triangle[1]].data(), *c = seen[triangle[2]].data();
        // All the same way round, as those of one shade are filled together.
        if ((b[0] - a[0]) * (c[1] - a[1]) < (b[1] - a[1]) * (c[0] - a[0])) std::swap(b, c);
        picture.triangle((1 + height(triangle)) / 2, a, b, c);
    }
    for (const auto &[edge, value] : complex.values[1]) {
        if (value <= 0 && height(edge) > 0) picture.segment(seen[edge[0]].data(), seen[edge[1]].data());
    }
}

}  // namespace

int main(int n_arguments, char **arguments) {
    const int steps = n_arguments > 1 ? std::atoi(arguments[1]) : 34;
    std::mt19937 random(1);
    const auto trembling = [&random] { return tremor * (static_cast<double>(random()) / 2147483648.0 - 1); };
    const std::vector<Place> atoms = [] {
        std::vector<Place> atoms = cage();
        atoms.push_back({0, 0, 0});
        return atoms;
    }();
    std::vector<double> weights(atoms.size() - 1, carbon * carbon);
    weights.push_back(helium * helium);

    Picture picture({-7, -7}, {7, 7}, 250, 3, "behind", "in front");
    std::vector<Place> places(atoms);
    deldrift::Triangulation t(3, places, deldrift::Weights{weights});
    std::uint64_t moved = 0;
    Shape last;
    for (int step = 0; step <= steps; step++) {
        const double size = 0.8 + 1.7 * step / steps;
        for (std::size_t v = 0; v < atoms.size(); v++) {
            for (int k = 0; k < 3; k++) places[v][k] = size * atoms[v][k] + trembling();
        }
        // Weights stay, and whom they hide is told before any cell is read.
        const deldrift_commit_report report = t.commit_weighted(places, {});
        moved += report.moved;
        const Complex complex(places, weights, t);
        const Shape shape = shape_of(complex, t.cells());
        if (std::tie(shape.pieces, shape.tunnels, shape.voids) != std::tie(last.pieces, last.tunnels, last.voids)) {
            std::printf("%.2f times as large: pieces %d, tunnels %d, voids %d, hidden atoms %d\n", size, shape.pieces,
                        shape.tunnels, shape.voids, static_cast<int>(report.hidden_by_weight));
        }
        last = shape;
        for (const int percent : {100, 130, 180}) {
            if (std::abs(100 * size - percent) < 1e-6) {
                draw(picture, complex, std::to_string(percent) + " %: " + std::to_string(shape.tunnels) + " tunnels");
            }
        }
    }
    std::printf("%d steps, in which atoms have moved %d times\n", steps, static_cast<int>(moved));
    if (n_arguments > 2 && !picture.save(arguments[2])) {
        std::fprintf(stderr, "%s cannot be written\n", arguments[2]);
        return 1;
    }
    return last.pieces == static_cast<int>(atoms.size()) ? 0 : 1;
}
