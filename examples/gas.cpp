// A gas whose parcels are Voronoi cells of a square. Each has a mass; its pressure is the mass by the area of the cell.
// The parcels in a disk are heavier, and push the others away until all pressures are equal: the areas are as the
// masses then. A parcel goes where the energy falls, minus the sum of mass times the logarithm of area; its derivatives
// are those of the areas by positions. A step that does not make the energy less is made again with half the length.
//
//   gas [parcels [steps [picture.svg]]]
#include "svg.hpp"

#include <deldrift.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace {

using Numbers = std::vector<double>;

const Numbers low{0, 0}, high{1, 1};

struct Parcels {
    Numbers positions, masses;
    std::size_t size() const { return masses.size(); }
};

// One in each field of a chessboard, those in the disk four times as heavy.
Parcels parcels_in_square(int side) {
    Parcels parcels;
    std::mt19937 random(3);
    for (int k = 0; k < side * side; k++) {
        for (const int field : {k % side, k / side})
            parcels.positions.push_back((field + 0.3 + 0.4 * random() / 4294967296.0) / side);
        const double *const p = &parcels.positions[parcels.positions.size() - 2];
        parcels.masses.push_back(std::hypot(p[0] - 0.5, p[1] - 0.5) < 0.3 ? 4 : 1);
    }
    return parcels;
}

double sum(const Numbers &numbers) { return std::accumulate(numbers.begin(), numbers.end(), 0.0); }

double energy(const Numbers &masses, const Numbers &areas) {
    double energy = 0;
    for (std::size_t i = 0; i < masses.size(); i++) energy -= masses[i] * std::log(areas[i]);
    return energy;
}

struct State {
    deldrift::VoronoiCells cells;
    deldrift::VoronoiDerivatives facets;
    std::vector<std::uint32_t> edges;
    Numbers pressures;
};

State read(const deldrift::Triangulation &t, const Numbers &masses) {
    State state{t.voronoi_cells(low, high), t.voronoi_derivatives(low, high), t.edges(), masses};
    for (std::size_t i = 0; i < masses.size(); i++) state.pressures[i] /= state.cells.volumes[i];
    return state;
}

// Minus the derivatives of the energy. The area of a cell changes by its own vertex as the others lose.
Numbers forces(const State &state) {
    Numbers forces(2 * state.pressures.size(), 0);
    for (std::size_t k = 0; k < state.facets.measures.size(); k++) {
        const std::uint32_t i = state.edges[2 * k], j = state.edges[2 * k + 1];
        const double *const derivatives = &state.facets.derivatives[4 * k];
        const double more = state.pressures[i] - state.pressures[j];
        for (int axis = 0; axis < 2; axis++) {
            forces[2 * j + axis] += more * derivatives[axis];
            forces[2 * i + axis] -= more * derivatives[2 + axis];
        }
    }
    return forces;
}

// How much a force is off from the difference of energies, relatively.
double difference_from_forces(const Parcels &parcels, const Numbers &forces) {
    double worst = 0, greatest = 0;
    for (const double force : forces) greatest = std::max(greatest, std::abs(force));
    for (std::size_t k = 0; k < forces.size(); k += 97) {
        double energies[2];
        const double step = 1e-6;
        for (int side = 0; side < 2; side++) {
            Numbers positions = parcels.positions;
            positions[k] += side == 0 ? step : -step;
            const deldrift::Triangulation moved(2, positions);
            energies[side] = energy(parcels.masses, moved.voronoi_cells(low, high).volumes);
        }
        worst = std::max(worst, std::abs((energies[1] - energies[0]) / (2 * step) - forces[k]) / greatest);
    }
    return worst;
}

// A facet is as long as its measure, across its edge, with its centroid in the middle.
void draw(Picture &picture, const State &state, const Numbers &positions, double mean, const std::string &caption) {
    picture.panel(caption);
    for (std::size_t k = 0; k < state.facets.measures.size(); k++) {
        const double length = state.facets.measures[k], *const middle = &state.facets.centroids[2 * k];
        if (!(length > 0)) continue;
        const double *const ends[] = {&positions[2 * state.edges[2 * k]], &positions[2 * state.edges[2 * k + 1]]};
        const double x = ends[1][0] - ends[0][0], y = ends[1][1] - ends[0][1], half = length / (2 * std::hypot(x, y));
        const double from[] = {middle[0] - half * y, middle[1] + half * x};
        const double to[] = {middle[0] + half * y, middle[1] - half * x};
        for (int end = 0; end < 2; end++) {
            const double pressure = state.pressures[state.edges[2 * k + end]] / mean;
            picture.triangle((std::log2(pressure) + 1.75) / 4, ends[end], from, to);
        }
        picture.segment(from, to);
    }
}

}  // namespace

int main(int n_arguments, char **arguments) {
    const int side = static_cast<int>(std::sqrt(n_arguments > 1 ? std::atoi(arguments[1]) : 400));
    const int n_steps = n_arguments > 2 ? std::atoi(arguments[2]) : 4000, shown[] = {0, n_steps / 200, n_steps};
    Parcels parcels = parcels_in_square(side);
    const double mean = sum(parcels.masses);  // the square has area 1
    deldrift::Triangulation t(2, parcels.positions);
    Picture picture(Picture::Point{0, 0}, Picture::Point{1, 1}, 300, 3, "pressure 0.3 (by half octaves)", "4.8");
    State state = read(t, parcels.masses);
    Numbers push = forces(state);
    const double first = energy(parcels.masses, state.cells.volumes);
    double worst_sum = 0, last = first, off = 0, rate = 0.1;
    std::size_t n_rejected = 0;
    std::printf("%zu parcels, %d steps\n", parcels.size(), n_steps);
    std::printf("forces are differences of energy within %.1e\n", difference_from_forces(parcels, push));
    for (int step = 0;; step++) {
        worst_sum = std::max(worst_sum, std::abs(sum(state.cells.volumes) - 1));
        if (std::find(std::begin(shown), std::end(shown), step) != std::end(shown))
            draw(picture, state, parcels.positions, mean, "after " + std::to_string(step) + " steps");
        if (step == n_steps) break;
        // A step after which the energy is not less is too long.
        for (double now = last;; rate /= 2, n_rejected++) {
            Numbers positions = parcels.positions;
            for (std::size_t k = 0; k < push.size(); k++) positions[k] += rate * push[k] / mean;
            t.commit_positions(positions);
            state = read(t, parcels.masses);
            now = energy(parcels.masses, state.cells.volumes);
            if (!(now < last)) continue;
            last = now;
            parcels.positions = std::move(positions);
            break;
        }
        rate = std::min(1.05 * rate, 0.2);
        push = forces(state);
    }
    for (const double pressure : state.pressures) off = std::max(off, std::abs(pressure / mean - 1));
    std::printf("sum of areas within %.1e\n", worst_sum);
    std::printf("energy fell by %.6g, %zu steps were too long\n", first - last, n_rejected);
    std::printf("pressures within %.3g of their mean\n", off);
    if (n_arguments > 3 && !picture.save(arguments[3])) {
        std::fprintf(stderr, "%s cannot be written\n", arguments[3]);
        return 1;
    }
    return 0;
}
