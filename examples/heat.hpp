// Heat in a fluid that is stirred: linear finite elements whose vertices move with the fluid. The stirring keeps areas,
// so each vertex keeps its mass, and what remains is diffusion, by implicit Euler: (M + dt k L) u_new = M u.
//
// The rows of the sparse matrix name the neighbours of the vertices. They are updated for the vertices whose star has
// changed, as the change list says, not made again. The matrix keeps room in each row for that.
#pragma once

#include <Eigen/Geometry>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <deldrift.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

constexpr double pi = 3.14159265358979323846;

// Points in a disk: a sunflower, and the rim, far enough from it that no angle opposite a rim edge is obtuse.
inline Eigen::Matrix2Xd disk(int n) {
    const int n_rim = static_cast<int>(std::sqrt(4 * pi * n)), n_inside = n - n_rim;
    const double inside = 1 - 0.55 * 2 * pi / n_rim;
    Eigen::Matrix2Xd x(2, n);
    for (int i = 0; i < n; i++) {
        const bool is_inside = i < n_inside;
        const double r = is_inside ? inside * std::sqrt((i + 0.5) / n_inside) : 1;
        const double angle = is_inside ? pi * (3 - std::sqrt(5.0)) * i : 2 * pi * (i - n_inside) / n_rim;
        x.col(i) << r * std::cos(angle), r * std::sin(angle);
    }
    return x;
}

class Heat {
public:
    static constexpr double turns = 3;  // at the centre, while time goes from 0 to 1

    Heat(const Eigen::Matrix2Xd &start, double diffusivity)
        : diffusivity_(diffusivity), start_(start), x_(start), t_(2, x_), matrix_(start.cols(), start.cols()) {
        mass_.setZero(x_.cols());
        for (const auto cell : t_.cells())
            for (const std::uint32_t v : cell) mass_[v] += area(cell) / 3;
        matrix_.reserve(Eigen::VectorXi::Constant(x_.cols(), 12));
        follow();
    }

    void step(double dt, Eigen::VectorXd &u) {
        time_ += dt;
        for (Eigen::Index v = 0; v < x_.cols(); v++) {
            const double slow = 1 - start_.col(v).squaredNorm();
            x_.col(v) = Eigen::Rotation2Dd(2 * pi * turns * time_ * slow * slow) * start_.col(v);
        }
        t_.commit_positions(x_);
        const auto begin = Clock::now();
        follow();
        follow_seconds += std::chrono::duration<double>(Clock::now() - begin).count();
        assemble(dt);
        solver_.setTolerance(1e-14);
        u = solver_.compute(matrix_).solveWithGuess(mass_.cwiseProduct(u), u);
    }

    // Whether the rows are those that are made of all cells.
    bool rows_are_right() {
        const auto begin = Clock::now();
        std::vector<Eigen::Triplet<double>> entries;
        for (const auto cell : t_.cells())
            for (const std::uint32_t v : cell)
                for (const std::uint32_t w : cell) entries.emplace_back(v, w, 1);
        Matrix fresh(x_.cols(), x_.cols());
        fresh.setFromTriplets(entries.begin(), entries.end());
        fresh_seconds += std::chrono::duration<double>(Clock::now() - begin).count();
        for (Eigen::Index v = 0; v < x_.cols(); v++) {
            const int *row = fresh.innerIndexPtr() + fresh.outerIndexPtr()[v];
            const int n = fresh.outerIndexPtr()[v + 1] - fresh.outerIndexPtr()[v];
            if (n != matrix_.innerNonZeroPtr()[v] || !std::equal(row, row + n, row_of(v))) return false;
        }
        return true;
    }

    const Eigen::VectorXd &mass() const { return mass_; }
    const Eigen::Matrix2Xd &positions() const { return x_; }
    deldrift::Cells cells() const { return t_.cells(); }
    double time() const { return time_; }
    double follow_seconds = 0, fresh_seconds = 0;
    std::size_t n_rows_changed = 0;

private:
    using Clock = std::chrono::steady_clock;
    using Matrix = Eigen::SparseMatrix<double>;
    using Row = deldrift::Cells::Row;

    double area(Row cell) const {
        Eigen::Matrix2d edges;
        edges << x_.col(cell[1]) - x_.col(cell[0]), x_.col(cell[2]) - x_.col(cell[0]);
        return edges.determinant() / 2;
    }

    int *row_of(Eigen::Index v) { return matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[v]; }

    void follow() {
        const deldrift_changes changes = t_.take_changes();
        const deldrift::Cells cells = t_.cells();
        std::vector<std::uint32_t> row;
        for (std::size_t k = 0; k < changes.star_count; k++) {
            const std::uint32_t v = changes.stars[k];
            row.clear();
            for (const std::uint32_t cell : t_.star(v)) row.insert(row.end(), cells[cell].begin(), cells[cell].end());
            std::sort(row.begin(), row.end());
            row.erase(std::unique(row.begin(), row.end()), row.end());
            const int n = static_cast<int>(row.size()), *outer = matrix_.outerIndexPtr();
            if (n > outer[v + 1] - outer[v]) matrix_.reserve(Eigen::VectorXi::Constant(x_.cols(), n));
            std::copy(row.begin(), row.end(), row_of(v));
            matrix_.innerNonZeroPtr()[v] = n;
        }
        n_rows_changed += changes.star_count;
    }

    void assemble(double dt) {
        for (Eigen::Index v = 0; v < x_.cols(); v++)
            std::fill_n(matrix_.valuePtr() + matrix_.outerIndexPtr()[v], matrix_.innerNonZeroPtr()[v], 0.0);
        for (Eigen::Index v = 0; v < x_.cols(); v++) matrix_.coeffRef(v, v) = mass_[v];
        for (const auto cell : t_.cells()) {
            const double twice = 2 * area(cell);
            for (int i = 0; i < 3; i++) {
                const std::uint32_t a = cell[(i + 1) % 3], b = cell[(i + 2) % 3];
                // Half the cotangent of the angle opposite the edge.
                const double cosine = (x_.col(a) - x_.col(cell[i])).dot(x_.col(b) - x_.col(cell[i]));
                const double weight = dt * diffusivity_ * cosine / twice / 2;
                matrix_.coeffRef(a, b) -= weight, matrix_.coeffRef(b, a) -= weight;
                matrix_.coeffRef(a, a) += weight, matrix_.coeffRef(b, b) += weight;
            }
        }
    }

    double diffusivity_, time_ = 0;
    Eigen::Matrix2Xd start_, x_;
    deldrift::Triangulation t_;
    Matrix matrix_;  // symmetric, so its columns are its rows
    Eigen::VectorXd mass_;
    Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver_;
};
