// Heat in a fluid that is stirred, checked against an exact solution, and drawn.
//
//   heat [vertices [steps [picture.svg]]]
#include "heat.hpp"
#include "svg.hpp"

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

// A radial field is not touched by the stirring: this one decays, for nothing flows through the rim.
double exact(double r, double diffusivity, double time) {
    const double k = 3.8317059702075123;
    return 1 + std::cyl_bessel_j(0, k * r) * std::exp(-diffusivity * k * k * time);
}

// Whether the result is what it should be, within one percent of the greatest difference.
bool check(int n, int n_steps) {
    const double diffusivity = 0.05;
    Heat heat(disk(n), diffusivity);
    Eigen::VectorXd u(n), wanted(n);
    for (int v = 0; v < n; v++) {
        u[v] = exact(heat.positions().col(v).norm(), diffusivity, 0);
        wanted[v] = exact(heat.positions().col(v).norm(), diffusivity, 1);
    }
    const double before = heat.mass().dot(u), low = u.minCoeff(), high = u.maxCoeff();
    bool is_bounded = true, are_right = true;
    for (int step = 0; step < n_steps; step++) {
        heat.step(1.0 / n_steps, u);
        is_bounded &= low - 1e-9 < u.minCoeff() && u.maxCoeff() < high + 1e-9;
        are_right &= heat.rows_are_right();
    }
    const double error = (u - wanted).cwiseAbs().maxCoeff(), drift = std::fabs(heat.mass().dot(u) / before - 1);
    std::printf("%d steps, %zu of %d rows updated; heat drift %.1e, error %.1e, maximum principle %s, rows %s\n",
                n_steps, heat.n_rows_changed, n * n_steps, drift, error, is_bounded ? "kept" : "broken",
                are_right ? "right" : "wrong");
    std::printf("rows updated in %.2f ms a step, made of all cells in %.2f ms\n", 1e3 * heat.follow_seconds / n_steps,
                1e3 * heat.fresh_seconds / n_steps);
    return drift < 1e-9 && error < 0.02 && is_bounded && are_right;
}

bool draw(const char *path) {
    const int n = 1000, n_panels = 4, n_steps = 25;
    Heat heat(disk(n), 2e-3);
    Eigen::VectorXd u = (heat.positions().row(0).array() < 0).cast<double>();
    Picture picture({-1, -1}, {1, 1}, 250, n_panels, "temperature 0", "1");
    for (int panel = 0; panel < n_panels; panel++) {
        for (int step = 0; panel > 0 && step < n_steps; step++) heat.step(1.0 / (3 * n_steps), u);
        picture.panel("turns: " + std::to_string(panel));
        const auto place = [&](std::uint32_t v) { return heat.positions().col(v).data(); };
        for (const auto cell : heat.cells()) {
            const double mean = (u[cell[0]] + u[cell[1]] + u[cell[2]]) / 3;
            picture.triangle(mean, place(cell[0]), place(cell[1]), place(cell[2]));
        }
    }
    return picture.save(path);
}

}  // namespace

int main(int n_arguments, char **arguments) {
    const int n = n_arguments > 1 ? std::atoi(arguments[1]) : 4000;
    const int n_steps = n_arguments > 2 ? std::atoi(arguments[2]) : 100;
    const bool is_right = check(n, n_steps), is_drawn = n_arguments <= 3 || draw(arguments[3]);
    return is_right && is_drawn ? 0 : 1;
}
