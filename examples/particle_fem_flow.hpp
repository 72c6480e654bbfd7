// One time step of a slightly compressible fluid, with linear finite elements for velocity and pressure on the fluid
// cells of a mesh whose vertices move with the fluid. Gravity and viscosity are explicit. Pressure is implicit: the
// motion limits the time step, not the speed of sound. It is zero on the free surface.
#pragma once

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

// Rows of three vertices, and of three neighbours.
struct CellArrays {
    std::size_t count;
    const std::uint32_t *vertices, *neighbours;
};

struct Fluid {
    std::size_t n_walls;                          // the first vertices, which stay
    Eigen::Matrix2Xd x, u;                        // by vertex: position, velocity
    Eigen::VectorXd p;                            // by vertex: pressure, the density being 1
    std::vector<char> is_present, is_on_surface;  // by vertex
    std::vector<std::uint8_t> is_fluid;           // by cell
    std::vector<double> strain;                   // by cell: how much the fluid there has been sheared so far
};

// A triangle and the gradients of its shape functions.
struct Element {
    double area;
    Eigen::Matrix<double, 2, 3> gradients;

    Element() = default;
    Element(const Eigen::Matrix2Xd &x, const std::uint32_t *v) {
        const Eigen::Vector2d a = x.col(v[1]) - x.col(v[0]), b = x.col(v[2]) - x.col(v[0]);
        const double twice = a.x() * b.y() - a.y() * b.x();
        area = twice / 2;
        gradients.col(1) << b.y() / twice, -b.x() / twice;
        gradients.col(2) << -a.y() / twice, a.x() / twice;
        gradients.col(0) = -gradients.col(1) - gradients.col(2);
    }
    double squared_edge(int opposite) const { return 4 * area * area * gradients.col(opposite).squaredNorm(); }
    double squared_circumradius() const {
        return squared_edge(0) * squared_edge(1) * squared_edge(2) / (16 * area * area);
    }
};

class Flow {
public:
    static constexpr double gravity = 1, viscosity = 1e-3, sound = 20;

    // New velocities and pressures, and the strain that goes with them.
    void step(Fluid &f, const CellArrays &cells, double dt) {
        const Eigen::Index n = f.x.cols(), n_walls = static_cast<Eigen::Index>(f.n_walls);
        f.u.row(1).rightCols(n - n_walls).array() -= dt * gravity;
        assemble(f, cells, dt);
        matrix_.resize(n, n);
        matrix_.setFromTriplets(entries_.begin(), entries_.end());
        solver_.setTolerance(1e-8);
        f.p = solver_.compute(matrix_).solveWithGuess(source_, f.p);
        add_forces(f, cells, dt);
        for (Eigen::Index v = n_walls; v < n; v++)
            if (mass_[v] > 0) f.u.col(v) += dt / mass_[v] * force_.col(v);
    }

    // Of the fluid cells, by cell, as they were in the latest step.
    const std::vector<Element> &elements() const { return elements_; }

private:
    // The lower half of (M / (c dt)^2 + L) p_new = M / (c dt)^2 p - div u / dt, with the lumped mass M.
    void assemble(Fluid &f, const CellArrays &cells, double dt) {
        const Eigen::Index n = f.x.cols();
        mass_.setZero(n), diagonal_.setZero(n), source_.setZero(n);
        entries_.clear(), elements_.resize(cells.count);
        for (std::size_t c = 0; c < cells.count; c++) {
            if (!f.is_fluid[c]) continue;
            const std::uint32_t *v = cells.vertices + 3 * c;
            const Element &e = elements_[c] = Element(f.x, v);
            double divergence = 0;
            for (int i = 0; i < 3; i++) divergence += f.u.col(v[i]).dot(e.gradients.col(i));
            for (int i = 0; i < 3; i++) {
                const std::uint32_t a = v[i], b = v[(i + 1) % 3];
                const double weight = -e.area * e.gradients.col(i).dot(e.gradients.col((i + 1) % 3));
                mass_[a] += e.area / 3, source_[a] -= e.area / 3 * divergence / dt;
                diagonal_[a] += weight, diagonal_[b] += weight;
                if (!f.is_on_surface[a] && !f.is_on_surface[b])
                    entries_.emplace_back(std::max(a, b), std::min(a, b), -weight);
            }
        }
        const double stiffness = 1 / (sound * sound * dt * dt);
        for (Eigen::Index v = 0; v < n; v++) {
            const bool is_free = mass_[v] == 0 || f.is_on_surface[static_cast<std::size_t>(v)];
            if (is_free) f.p[v] = 0;
            source_[v] = is_free ? 0 : source_[v] + stiffness * mass_[v] * f.p[v];
            entries_.emplace_back(v, v, is_free ? 1 : diagonal_[v] + stiffness * mass_[v]);
        }
    }

    void add_forces(Fluid &f, const CellArrays &cells, double dt) {
        force_.setZero(2, f.x.cols());
        for (std::size_t c = 0; c < cells.count; c++) {
            if (!f.is_fluid[c]) continue;
            const std::uint32_t *v = cells.vertices + 3 * c;
            const Element &e = elements_[c];
            Eigen::Vector2d dp = Eigen::Vector2d::Zero();
            Eigen::Matrix2d du = Eigen::Matrix2d::Zero();
            for (int i = 0; i < 3; i++) {
                dp += f.p[v[i]] * e.gradients.col(i);
                du += f.u.col(v[i]) * e.gradients.col(i).transpose();
            }
            for (int i = 0; i < 3; i++)
                force_.col(v[i]) -= e.area * (dp / 3 + viscosity * (du * e.gradients.col(i)));
            f.strain[c] += dt * (du + du.transpose()).norm() / std::sqrt(2.0);
        }
    }

    std::vector<Element> elements_;
    std::vector<Eigen::Triplet<double>> entries_;
    Eigen::SparseMatrix<double> matrix_;
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>> solver_;
    Eigen::VectorXd mass_, diagonal_, source_;
    Eigen::Matrix2Xd force_;
};
