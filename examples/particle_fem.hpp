// Particle finite elements: a column of fluid collapses in a tank. The particles are the vertices of a Delaunay
// triangulation. Cells with a small circumradius are fluid, and the boundary of these is the free surface. In each step
// the particles move with the fluid, some are removed or inserted, and data of cells pass to the cells of the new mesh.
//
// The ids of particles that have left are not used again. A long run calls deldrift_compact now and then.
//
// The mesh is a parameter; particle_fem_mesh.hpp has that from deldrift.
#pragma once

#include "particle_fem_flow.hpp"

#include <array>
#include <ctime>
#include <random>

using Ids = std::vector<std::uint32_t>;

template <class Mesh>
class DamBreak {
public:
    static constexpr double width = 4, height = 3;  // of the tank; the column is 1 by 2

    explicit DamBreak(double spacing) : h(spacing), dt(spacing / 30), f(column(spacing)), mesh(f.x) {
        f.strain.assign(mesh.cells().count, 0);
        classify();
    }

    void step() {
        const std::clock_t start = std::clock();
        flow_.step(f, mesh.cells(), dt);
        move();
        const std::clock_t moved = std::clock();
        mesh.advance(f.x, leaving_);
        mesh.carry(f.strain);
        const std::clock_t meshed = std::clock();
        classify();
        time += dt;
        n_visits += static_cast<std::size_t>(f.x.cols()) - n_left;
        mesh_seconds += static_cast<double>(meshed - moved) / CLOCKS_PER_SEC;
        seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    }

    const double h, dt;
    double time = 0, mesh_seconds = 0, seconds = 0;  // of the flow; of the processor, for the mesh and for all
    std::size_t n_came = 0, n_left = 0, n_visits = 0;  // visits: vertices, summed over the steps
    Fluid f;
    Mesh mesh;
    Ids surface;  // the facets of the free surface, as pairs of vertices

private:
    // Walls first. Nothing is evenly spaced, so that the triangulation does not depend on how ties are broken.
    static Fluid column(double h) {
        std::vector<double> x;
        std::mt19937 random(1);
        const auto add = [&](double at_x, double at_y, double by_x, double by_y) {
            const double r = random() / 4294967296.0 - 0.5, s = random() / 4294967296.0 - 0.5;
            x.insert(x.end(), {at_x + 0.4 * h * by_x * r, at_y + 0.4 * h * by_y * s});
        };
        const int nx = static_cast<int>(std::lround(width / h)), ny = static_cast<int>(std::lround(height / h));
        for (int i = 0; i <= nx; i++) add(width * i / nx, 0, i % nx != 0, 0);
        for (int j = 1; j <= ny; j++) add(0, height * j / ny, 0, 1), add(width, height * j / ny, 0, 1);
        Fluid f;
        f.n_walls = x.size() / 2;
        for (int j = 1; j * h < 2; j++)
            for (int i = 1; i * h < 1; i++) add(i * h, j * h, 1, 1);
        f.x = Eigen::Map<Eigen::Matrix2Xd>(x.data(), 2, static_cast<Eigen::Index>(x.size() / 2));
        f.u.setZero(2, f.x.cols());
        f.p.setZero(f.x.cols());
        f.is_present.assign(x.size() / 2, 1);
        return f;
    }

    bool is_wall(std::uint32_t v) const { return v < f.n_walls; }

    // Which cells are fluid, and which facets are its free surface.
    void classify() {
        const CellArrays cells = mesh.cells();
        mesh.mask(1.2 * h, f.is_fluid);
        for (std::size_t c = 0; c < cells.count; c++) {
            const std::uint32_t *v = cells.vertices + 3 * c;
            if (is_wall(v[0]) && is_wall(v[1]) && is_wall(v[2])) f.is_fluid[c] = 0;
        }
        mesh.boundary(f.is_fluid, surface);
        std::size_t n = 0;
        f.is_on_surface.assign(f.is_present.size(), 0);
        for (std::size_t k = 0; k < surface.size(); k += 2) {
            const std::uint32_t a = surface[k], b = surface[k + 1];
            if (is_wall(a) && is_wall(b)) continue;
            f.is_on_surface[a] = f.is_on_surface[b] = 1;
            surface[n++] = a, surface[n++] = b;
        }
        surface.resize(n);
    }

    // Particles leave where they are outside of the tank or too close to one of lower id, and come to large cells.
    void move() {
        const CellArrays cells = mesh.cells();
        leaves_.assign(f.is_present.size(), 0);
        for (std::uint32_t v = static_cast<std::uint32_t>(f.n_walls); v < f.x.cols(); v++) {
            f.x.col(v) += dt * f.u.col(v);
            leaves_[v] = f.x(0, v) <= 0 || f.x(0, v) >= width || f.x(1, v) <= 0 || f.x(1, v) >= height;
        }
        for (std::size_t c = 0; c < cells.count; c++) {
            for (int i = 0; f.is_fluid[c] && i < 3; i++) {
                const std::uint32_t a = cells.vertices[3 * c + (i + 1) % 3], b = cells.vertices[3 * c + (i + 2) % 3];
                if (flow_.elements()[c].squared_edge(i) < 0.16 * h * h && !is_wall(std::max(a, b)))
                    leaves_[std::max(a, b)] = 1;
            }
        }
        std::vector<std::array<double, 5>> coming;
        for (std::size_t c = 0; c < cells.count; c++) {
            const std::uint32_t *v = cells.vertices + 3 * c;
            if (!f.is_fluid[c] || leaves_[v[0]] || leaves_[v[1]] || leaves_[v[2]]) continue;
            if (flow_.elements()[c].squared_circumradius() < h * h) continue;
            const Eigen::Vector2d x = (f.x.col(v[0]) + f.x.col(v[1]) + f.x.col(v[2])) / 3;
            const Eigen::Vector2d u = (f.u.col(v[0]) + f.u.col(v[1]) + f.u.col(v[2])) / 3;
            coming.push_back({x.x(), x.y(), u.x(), u.y(), (f.p[v[0]] + f.p[v[1]] + f.p[v[2]]) / 3});
        }
        exchange(coming);
    }

    // In the order of their places, so that ids do not depend on the order of the cells.
    void exchange(std::vector<std::array<double, 5>> &coming) {
        leaving_.clear();
        for (std::uint32_t v = 0; v < leaves_.size(); v++)
            if (leaves_[v] && f.is_present[v]) leaving_.push_back(v), f.is_present[v] = 0;
        std::sort(coming.begin(), coming.end());
        Eigen::Index v = f.x.cols(), n = v + static_cast<Eigen::Index>(coming.size());
        f.x.conservativeResize(2, n), f.u.conservativeResize(2, n), f.p.conservativeResize(n);
        f.is_present.resize(static_cast<std::size_t>(n), 1);
        for (const auto &[x, y, ux, uy, p] : coming) {
            f.x.col(v) << x, y;
            f.u.col(v) << ux, uy;
            f.p[v++] = p;
        }
        n_came += coming.size(), n_left += leaving_.size();
    }

    Flow flow_;
    Ids leaving_;
    std::vector<char> leaves_;
};
