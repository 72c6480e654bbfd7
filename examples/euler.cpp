// An incompressible fluid by optimal transport: the scheme of Gallouet and Merigot (doi:10.1007/s10208-017-9355-y) for Euler's
// equations. The fluid is divided into pieces of one area, the power cells of particles; weights are looked for with which they have it
// (areas.hpp). A particle is drawn to the centroid of its piece by a spring, and so by the pressure: what it lacks to being
// where it is without compression. Each step is one commit of all places, with the weights of before, and a few commits of weights
// alone.
//
// The flow is a vortex in a square that stays as it is, which is known exactly. Half of the fluid is marked, and stirred.
//
//   euler [particles [picture.svg]]
#include "areas.hpp"

#include <deldrift.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

namespace {

using areas::Numbers;
using areas::Place;

constexpr double pi = 3.14159265358979323846, step = 0.01, end = 1.5;
// The time in which a spring swings, of a length of the flow: longer than a step, and short.
constexpr double swing = 0.05;

Place velocity_at(const Place &x) {
    return {-std::sin(pi * x[0]) * std::cos(pi * x[1]), std::cos(pi * x[0]) * std::sin(pi * x[1])};
}

struct Fluid {
    std::vector<Place> places, velocities;
    Numbers weights, areas;
    deldrift::Triangulation t;
    int searches = 0, commits = 0;

    explicit Fluid(const std::vector<Place> &at)
        : places(at), weights(at.size()), areas(at.size(), 1.0 / static_cast<double>(at.size())),
          t(2, at, deldrift::Weights{weights}) {
        for (const Place &x : places) velocities.push_back(velocity_at(x));
    }

    // The centroids of pieces of the fluid.
    std::vector<Place> centroids() {
        if (t.commit_weighted(places, weights).hidden_by_weight > 0 || !has_cells()) {
            // Where a particle has no cell by the weights of before. By these each has one in the square, at the place next to it.
            for (std::size_t v = 0; v < places.size(); v++) {
                const double x = places[v][0] - std::clamp(places[v][0], 0.0, 1.0), y = places[v][1] - std::clamp(places[v][1], 0.0, 1.0);
                weights[v] = x * x + y * y;
            }
            t.commit_weighted({}, weights);
        }
        const areas::Search search = areas::find_weights(t, weights, areas, 1e-5);
        searches++;
        commits += search.steps + search.halves + 1;
        const deldrift::VoronoiCells cells = t.voronoi_cells(areas::low, areas::high);
        std::vector<Place> middles;
        for (std::size_t v = 0; v < places.size(); v++) middles.push_back({cells.centroids[2 * v], cells.centroids[2 * v + 1]});
        return middles;
    }

    bool has_cells() const {
        const Numbers volumes = t.voronoi_volumes(areas::low, areas::high);
        return *std::min_element(volumes.begin(), volumes.end()) > areas[0] / 100;
    }

    // Moves by half a step, changes velocities by one, and moves by the other half. Returns the energy in the middle, that of springs
    // counted.
    double move() {
        drift();
        const std::vector<Place> middles = centroids();
        double energy = 0;
        for (std::size_t v = 0; v < places.size(); v++) {
            for (std::size_t k = 0; k < 2; k++) {
                const double pull = (middles[v][k] - places[v][k]) / swing, push = step * pull / swing;
                energy += areas[v] * (std::pow(velocities[v][k] + push / 2, 2) + pull * pull) / 2;
                velocities[v][k] += push;
            }
        }
        drift();
        return energy;
    }

    // A particle may leave the square for a moment; its piece does not.
    void drift() {
        for (std::size_t v = 0; v < places.size(); v++)
            for (std::size_t k = 0; k < 2; k++) places[v][k] += step / 2 * velocities[v][k];
    }
};

}  // namespace

int main(int n_arguments, char **arguments) {
    const int side = static_cast<int>(std::lround(std::sqrt(n_arguments > 1 ? std::atof(arguments[1]) : 1600)));
    std::vector<Place> start;
    std::mt19937 random(1);
    const auto shake = [&random] { return 0.5 + 0.1 * (static_cast<double>(random()) / 4294967296.0 - 0.5); };
    for (int i = 0; i < side * side; i++) start.push_back({(i % side + shake()) / side, (i / side + shake()) / side});
    Fluid fluid(start);
    // Pieces that are like the places: then nothing swings at first.
    fluid.places = fluid.centroids();
    Numbers marks;
    for (const Place &x : fluid.places) marks.push_back(x[1] < 0.5 ? 0.9 : 0.1);
    fluid.centroids();
    Picture picture({0, 0}, {1, 1}, 380, 2, "fluid from above", "from below");
    areas::draw(picture, "at first", fluid.places, fluid.weights, marks, fluid.t.edges());

    double first = 0, most = 0;
    const int steps = static_cast<int>(std::lround(end / step));
    for (int k = 0; k < steps; k++) {
        const double energy = fluid.move();
        if (k == 0) first = energy;
        most = std::max(most, std::abs(energy / first - 1));
    }
    fluid.centroids();
    areas::draw(picture, "at the time 1.5", fluid.places, fluid.weights, marks, fluid.t.edges());
    double off = 0, speed = 0;
    for (std::size_t v = 0; v < fluid.places.size(); v++) {
        const Place exact = velocity_at(fluid.places[v]);
        off += std::pow(fluid.velocities[v][0] - exact[0], 2) + std::pow(fluid.velocities[v][1] - exact[1], 2);
        speed += exact[0] * exact[0] + exact[1] * exact[1];
    }
    std::printf("%d particles, %d steps: %.1f commits a step; energy within %.4f; velocities off by %.3f of their mean\n",
                side * side, steps, static_cast<double>(fluid.commits) / fluid.searches, most, std::sqrt(off / speed));
    if (n_arguments > 2 && !picture.save(arguments[2])) {
        std::fprintf(stderr, "%s cannot be written\n", arguments[2]);
        return 1;
    }
    return 0;
}
