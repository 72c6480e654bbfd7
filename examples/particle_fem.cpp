// A column of fluid collapses in a tank: particle finite elements, with a mesh by deldrift.
//
//   particle_fem [time [spacing [picture.svg]]]
#include "particle_fem_mesh.hpp"
#include "svg.hpp"

#include <cstdio>
#include <cstdlib>

namespace {

// Area of the fluid, and its energy per density.
std::array<double, 2> area_and_energy(const DamBreak<DeldriftMesh> &dam) {
    const CellArrays cells = dam.mesh.cells();
    double total = 0, energy = 0;
    for (std::size_t c = 0; c < cells.count; c++) {
        if (!dam.f.is_fluid[c]) continue;
        const std::uint32_t *v = cells.vertices + 3 * c;
        const double area = Element(dam.f.x, v).area;
        total += area;
        for (int i = 0; i < 3; i++)
            energy += area / 3 * (dam.f.u.col(v[i]).squaredNorm() / 2 + Flow::gravity * dam.f.x(1, v[i]));
    }
    return {total, energy};
}

// Shaded by speed.
void draw(Picture &picture, const DamBreak<DeldriftMesh> &dam) {
    char caption[64];
    std::snprintf(caption, sizeof caption, "time %.1f", dam.time);
    picture.panel(caption);
    const auto place = [&](std::uint32_t v) { return dam.f.x.col(v).data(); };
    const CellArrays cells = dam.mesh.cells();
    for (std::size_t c = 0; c < cells.count; c++) {
        const std::uint32_t *v = cells.vertices + 3 * c;
        if (!dam.f.is_fluid[c]) continue;
        const double speed = (dam.f.u.col(v[0]) + dam.f.u.col(v[1]) + dam.f.u.col(v[2])).norm() / 3;
        picture.triangle(speed / 2.5, place(v[0]), place(v[1]), place(v[2]));
    }
    for (std::size_t k = 0; k < dam.surface.size(); k += 2)
        picture.segment(place(dam.surface[k]), place(dam.surface[k + 1]));
}

}  // namespace

int main(int n_arguments, char **arguments) {
    const double end = n_arguments > 1 ? std::atof(arguments[1]) : 3.6;
    const double spacing = n_arguments > 2 ? std::atof(arguments[2]) : 0.05;
    DamBreak<DeldriftMesh> dam(spacing);
    Picture picture({0, 0}, {dam.width, dam.height}, 400, 2, "speed 0", "2.5; orange: the free surface");
    const auto [area, energy] = area_and_energy(dam);
    const int n_frames = 4, n_steps = static_cast<int>(std::lround(end / dam.dt));
    for (int step = 1; step <= n_steps; step++) {
        dam.step();
        if (step * n_frames / n_steps > (step - 1) * n_frames / n_steps) draw(picture, dam);
    }
    const auto [area_now, energy_now] = area_and_energy(dam);
    double front = 0;
    for (const std::uint32_t v : dam.surface) front = std::max(front, dam.f.x(0, v));
    std::printf("%d steps, %zu particles came, %zu left; front at %.3f, area %.3f of the first, energy %.3f; "
                "mesh %.0f ns of %.0f ns per vertex and step\n",
                n_steps, dam.n_came, dam.n_left, front, area_now / area, energy_now / energy,
                1e9 * dam.mesh_seconds / static_cast<double>(dam.n_visits),
                1e9 * dam.seconds / static_cast<double>(dam.n_visits));
    return n_arguments <= 3 || picture.save(arguments[3]) ? 0 : 1;
}
