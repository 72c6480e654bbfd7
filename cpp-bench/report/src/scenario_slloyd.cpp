// SPDX-License-Identifier: GPL-3.0-or-later
#include "ball_cell.hpp"
#include "record.hpp"
#include "report_space.hpp"
#include "report_scenarios.hpp"
#include "solid.hpp"

#include <algorithm>
#include <cmath>

namespace bench {
namespace {

constexpr std::size_t n_directions = 2048;

/// A Voronoi vertex.
struct Dual {
    Vector3 centre{};
    bool is_inside = false;  // the ball; never of an infinite cell
    std::uint32_t number = 0;  // of the cell
};

using Space = ReportSpace<3, Dual>;

class Iteration {
public:
    Iteration(const double *from, std::size_t n_points, double radius)
        : from_(from), moments_(n_points), is_inside_(n_points, 1) {
        std::vector<Space::InputPoint> input;
        for (std::size_t id = 0; id < n_points; ++id)
            input.emplace_back(Space::point(from + 3 * id), VertexInfo{static_cast<std::uint32_t>(id), 0});
        insert_sorted<Space>(triangulation_, input);
        find_duals(radius);
    }

    void run(BallCells &ball_cells, double *to) {
        add_exact_parts();
        for (auto vertex = triangulation_.finite_vertices_begin();
             vertex != triangulation_.finite_vertices_end(); ++vertex) {
            const std::uint32_t id = vertex->info().id;
            const Vector3 centroid = is_inside_[id] ? exact(id) : by_quadrature(ball_cells, vertex);
            std::copy(centroid.begin(), centroid.end(), to + 3 * std::size_t{id});
        }
    }

private:
    struct Moments {
        double volume = 0;
        Vector3 first{};  // from the site
    };

    Vector3 site(std::uint32_t id) const { return vector(from_ + 3 * std::size_t{id}); }

    void find_duals(double radius) {
        std::uint32_t n_cells = 0;
        for (auto cell = triangulation_.all_cells_begin(); cell != triangulation_.all_cells_end(); ++cell) {
            Dual &dual = cell->info();
            dual = {};
            dual.number = n_cells++;
            if (!triangulation_.is_infinite(cell)) {
                std::array<Vector3, 4> corner;
                for (int i = 0; i < 4; ++i) corner[i] = site(cell->vertex(i)->info().id);
                dual.centre = circumcentre(corner);
                dual.is_inside = dot(dual.centre, dual.centre) < radius * radius;
            }
            if (!dual.is_inside)
                for (int i = 0; i < 4; ++i)
                    if (cell->vertex(i) != triangulation_.infinite_vertex())
                        is_inside_[cell->vertex(i)->info().id] = 0;
        }
    }

    /// A facet of a Voronoi cell belongs to an edge, and the edge's midpoint is in its plane. An edge of the
    /// facet belongs to a triangle: with the midpoint it makes a (signed) triangle of the facet, and with
    /// either site a tetrahedron of that site's cell. The order of the sums shows in their last bits, and addresses
    /// change from run to run: cells are compared by their numbers.
    void add_exact_parts() {
        for (auto cell = triangulation_.finite_cells_begin(); cell != triangulation_.finite_cells_end();
             ++cell)
            for (int corner = 0; corner < 4; ++corner) {
                const auto other = cell->neighbor(corner);
                if (triangulation_.is_infinite(other) || cell->info().number > other->info().number) continue;
                // Counter-clockwise seen from the neighbour.
                const std::array<int, 3> facet =
                    corner % 2 == 0
                        ? std::array<int, 3>{(corner + 1) & 3, (corner + 2) & 3, (corner + 3) & 3}
                        : std::array<int, 3>{(corner + 1) & 3, (corner + 3) & 3, (corner + 2) & 3};
                for (int i = 0; i < 3; ++i)
                    add_part(cell->vertex(facet[i])->info().id, cell->vertex(facet[(i + 1) % 3])->info().id,
                             cell->info().centre, other->info().centre);
            }
    }

    void add_part(std::uint32_t v, std::uint32_t w, const Vector3 &below, const Vector3 &above) {
        if (is_inside_[v]) add_tetrahedron(v, w, below, above);
        if (is_inside_[w]) add_tetrahedron(w, v, above, below);
    }

    void add_tetrahedron(std::uint32_t v, std::uint32_t w, const Vector3 &a, const Vector3 &b) {
        const Vector3 origin = site(v);
        const Vector3 m = 0.5 * (site(w) - origin), p = a - origin, q = b - origin;
        const double volume = dot(m, cross(p, q)) / 6;
        Moments &moments = moments_[v];
        moments.volume += volume;
        moments.first = moments.first + (volume / 4) * (m + p + q);
    }

    Vector3 exact(std::uint32_t id) const {
        return site(id) + (1 / moments_[id].volume) * moments_[id].first;
    }

    Vector3 by_quadrature(BallCells &ball_cells, Space::Vertex vertex) {
        neighbours_.clear();
        triangulation_.finite_adjacent_vertices(vertex, std::back_inserter(neighbours_));
        others_.clear();
        for (const auto neighbour : neighbours_)
            others_.push_back(from_ + 3 * std::size_t{neighbour->info().id});
        return ball_cells.cell(from_ + 3 * std::size_t{vertex->info().id}, others_).centroid;
    }

    const double *from_;
    Space::Triangulation triangulation_;
    std::vector<Moments> moments_;
    std::vector<char> is_inside_;  // all of the cell is in the ball
    std::vector<Space::Vertex> neighbours_;
    std::vector<const double *> others_;
};

}  // namespace

Series record_slloyd(std::size_t n_points, std::size_t n_timestamps, std::uint64_t seed, Progress &progress) {
    const double radius = unit_density_radius(3, n_points);
    Random random(seed);
    BallCells ball_cells(radius, n_directions);
    return record("slloyd", 3, points_in_ball(3, n_points, random), n_timestamps, progress,
                  [&](const double *from, double *to) { Iteration(from, n_points, radius).run(ball_cells, to); });
}

}  // namespace bench
