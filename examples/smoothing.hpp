// Points in a disk or a ball that are smoothed: those on the boundary stay, and those inside go, all at once,
//
// - by Lloyd's iteration, to the centroid of their Voronoi cell;
// - by ODT, to the mean circumcentre of their star, weighted by volume.
#pragma once

#include <Eigen/LU>
#include <deldrift.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

enum class Scheme { lloyd, odt };

template <int d>
class Smoothing {
public:
    using Point = Eigen::Matrix<double, d, 1>;
    using Points = Eigen::Matrix<double, d, Eigen::Dynamic>;
    static constexpr double pi = 3.14159265358979323846;

    // Of n_inside points inside, at random places.
    explicit Smoothing(int n_inside) : x_(places(n_inside)), t_(d, x_) {}

    void step(Scheme scheme) {
        Points sums = Points::Zero(d, x_.cols());
        Eigen::VectorXd weights = Eigen::VectorXd::Zero(x_.cols());
        for (const auto cell : t_.cells()) {
            if (scheme == Scheme::odt) {
                const double volume = simplex(cell).determinant();
                const Point centre = circumcentre<d>(cell, all_corners());
                for (const std::uint32_t v : cell) sums.col(v) += volume * centre, weights[v] += volume;
            } else {
                add_voronoi_parts(cell, sums, weights);
            }
        }
        for (Eigen::Index v = n_fixed_; v < x_.cols(); v++) {
            x_.col(v) = sums.col(v) / weights[v];
            // A cell that reaches beyond the rim must not draw its vertex there.
            x_.col(v) *= std::min(1.0, (1 - h_ / 3) / x_.col(v).norm());
        }
        t_.commit_positions(x_);
    }

    // By cell: the radius of the inscribed ball by that of the circumscribed one, times the dimension. It is 1 for the
    // regular simplex, 0 for a flat one.
    std::vector<double> qualities() const {
        std::vector<double> qualities;
        for (const auto cell : t_.cells()) {
            const Eigen::Matrix<double, d, d> gradients = simplex(cell).inverse();  // of the shape functions, as rows
            double surface = gradients.colwise().sum().norm();
            for (int i = 0; i < d; i++) surface += gradients.row(i).norm();
            const double radius = (circumcentre<d>(cell, all_corners()) - x_.col(cell[0])).norm();
            qualities.push_back(d / surface / radius);
        }
        return qualities;
    }

    const Points &positions() const { return x_; }
    deldrift::Cells cells() const { return t_.cells(); }

private:
    using Row = deldrift::Cells::Row;
    using Corners = std::array<int, d + 1>;

    static Corners all_corners() {
        Corners corners;
        for (int i = 0; i <= d; i++) corners[i] = i;
        return corners;
    }

    Points places(int n_inside) {
        h_ = d == 2 ? std::sqrt(2 * pi / std::sqrt(3) / n_inside) : std::cbrt(4 * pi / 3 * std::sqrt(2) / n_inside);
        n_fixed_ = std::lround(d == 2 ? 2 * pi / h_ : 4 * pi / (std::sqrt(0.75) * h_ * h_));
        Points x(d, n_fixed_ + n_inside);
        for (Eigen::Index i = 0; i < n_fixed_; i++) {
            const double angle = d == 2 ? 2 * pi * i / n_fixed_ : pi * (3 - std::sqrt(5)) * i;
            const double height = d == 2 ? 0 : (2 * i + 1.0) / n_fixed_ - 1, r = std::sqrt(1 - height * height);
            x.col(i)[d - 1] = height;
            x.col(i).template head<2>() << r * std::cos(angle), r * std::sin(angle);
        }
        std::mt19937 random(1);
        for (Eigen::Index i = n_fixed_; i < x.cols(); i++) {
            do {
                for (double &coordinate : x.col(i)) coordinate = random() / 2147483648.0 - 1;
            } while (x.col(i).norm() > 1 - h_ / 2);
        }
        return x;
    }

    // The edges from the first vertex.
    Eigen::Matrix<double, d, d> simplex(Row cell) const {
        Eigen::Matrix<double, d, d> edges;
        for (int i = 0; i < d; i++) edges.col(i) = x_.col(cell[i + 1]) - x_.col(cell[0]);
        return edges;
    }

    // Of the face of the first k + 1 corners.
    template <int k>
    Point circumcentre(Row cell, const Corners &corners) const {
        Eigen::Matrix<double, d, k> edges;
        for (int i = 0; i < k; i++) edges.col(i) = x_.col(cell[corners[i + 1]]) - x_.col(cell[corners[0]]);
        const Eigen::Matrix<double, k, k> squares = edges.transpose() * edges;
        return x_.col(cell[corners[0]]) + edges * (squares.inverse() * squares.diagonal() / 2);
    }

    // A cell falls into signed simplices: of a vertex, and the circumcentres of an edge at it, ..., of the cell.
    void add_voronoi_parts(Row cell, Points &sums, Eigen::VectorXd &weights) const {
        Corners corners = all_corners();
        do {
            const Point vertex = x_.col(cell[corners[0]]);
            Eigen::Matrix<double, d, d> edges;
            edges.col(0) = circumcentre<1>(cell, corners) - vertex;
            edges.col(1) = circumcentre<2>(cell, corners) - vertex;
            if constexpr (d == 3) edges.col(2) = circumcentre<3>(cell, corners) - vertex;
            int n_inversions = 0;
            for (int i = 0; i <= d; i++)
                for (int j = 0; j < i; j++) n_inversions += corners[j] > corners[i];
            const double volume = n_inversions % 2 == 0 ? edges.determinant() : -edges.determinant();
            sums.col(cell[corners[0]]) += volume * (vertex + edges.rowwise().sum() / (d + 1));
            weights[cell[corners[0]]] += volume;
        } while (std::next_permutation(corners.begin(), corners.end()));
    }

    double h_ = 0;
    Eigen::Index n_fixed_ = 0;
    Points x_;
    deldrift::Triangulation t_;
};
