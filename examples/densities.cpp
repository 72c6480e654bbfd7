// Densities of particles: mass by the volume of the Voronoi cell. Particles that fill a square evenly flow together by
// a motion whose density is known, x = q + s sin(2 pi q) / (2 pi) along each axis. The volumes add up to the square's,
// so that no mass is lost, however unevenly the particles lie.
//
//   densities [particles [picture.svg]]
#include "svg.hpp"

#include <deldrift.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace {

constexpr double pi = 3.14159265358979323846;

// A square of points, one in each field of a chessboard.
std::vector<double> even_points(int side) {
    std::vector<double> points;
    std::mt19937 random(1);
    for (int k = 0; k < side * side; k++) {
        for (const int field : {k % side, k / side})
            points.push_back((field + 0.35 + 0.3 * random() / 4294967296.0) / side);
    }
    return points;
}

struct State {
    std::vector<double> positions, densities;
};

// Where the points have come, and how dense the motion makes them.
State moved(const std::vector<double> &start, double s) {
    State state{start, std::vector<double>(start.size() / 2, 1)};
    for (std::size_t i = 0; i < start.size(); i++) {
        state.positions[i] += s * std::sin(2 * pi * start[i]) / (2 * pi);
        state.densities[i / 2] /= 1 + s * std::cos(2 * pi * start[i]);
    }
    return state;
}

void draw(Picture &picture, const deldrift::Triangulation &t, const State &state, const std::vector<double> &densities,
          const std::string &caption) {
    picture.panel(caption);
    for (const auto cell : t.cells()) {
        double sum = 0;
        for (const std::uint32_t v : cell) sum += std::log2(densities[v]) / 3;
        picture.triangle((sum + 2) / 5, &state.positions[2 * cell[0]], &state.positions[2 * cell[1]],
                         &state.positions[2 * cell[2]]);
    }
}

}  // namespace

int main(int n_arguments, char **arguments) {
    const int side = static_cast<int>(std::sqrt(n_arguments > 1 ? std::atoi(arguments[1]) : 1225));
    const std::vector<double> start = even_points(side);
    const std::size_t n = start.size() / 2;
    const double mass = 1 / static_cast<double>(n), greatest = 0.7;
    const int n_steps = 30, n_panels = 3;
    deldrift::Triangulation t(2, start);
    Picture picture({0, 0}, {1, 1}, 300, n_panels, "density 1/4 (by octaves)", "8");
    double worst_sum = 0, error = 0;
    for (int step = 0; step <= n_steps; step++) {
        const State state = moved(start, greatest * step / n_steps);
        t.commit_positions(state.positions);
        const std::vector<double> volumes = t.voronoi_volumes({0.0, 0.0}, {1.0, 1.0});
        std::vector<double> densities(n);
        double sum = 0;
        error = 0;
        for (std::size_t v = 0; v < n; v++) {
            densities[v] = mass / volumes[v];
            sum += volumes[v];
            error += std::fabs(densities[v] / state.densities[v] - 1) / static_cast<double>(n);
        }
        worst_sum = std::max(worst_sum, std::fabs(sum - 1));
        if (step % (n_steps / (n_panels - 1)) != 0) continue;
        draw(picture, t, state, densities, "s = " + std::to_string(greatest * step / n_steps).substr(0, 4));
    }
    std::printf("%zu particles, %d steps; sum of volumes within %.1e, densities within %.1f %% on average\n",
                n, n_steps, worst_sum, 100 * error);
    if (n_arguments > 2 && !picture.save(arguments[2])) return 1;
    return worst_sum < 1e-12 && error < 0.1 ? 0 : 1;
}
