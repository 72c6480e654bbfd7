// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's triangulations with something in every cell, and placement that tells which cells are new: what the
// report's algorithms and the recording of ODT need.
#pragma once

#include "cgal_space.hpp"

#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace bench {

template <unsigned dimension, typename CellInfo>
struct ReportSpace;

template <typename CellInfo>
using ReportTriangulation2 = CGAL::Delaunay_triangulation_2<
    CgalKernel, CGAL::Triangulation_data_structure_2<
                    VertexBase2, CGAL::Triangulation_face_base_with_info_2<CellInfo, CgalKernel>>>;
template <typename CellInfo>
using ReportTriangulation3 = CGAL::Delaunay_triangulation_3<
    CgalKernel, CGAL::Triangulation_data_structure_3<
                    VertexBase3, CGAL::Triangulation_cell_base_with_info_3<CellInfo, CgalKernel, CellBase3>>>;

template <typename CellInfo>
struct ReportSpace<2, CellInfo> : SpaceOf<2, ReportTriangulation2<CellInfo>> {
    using Base = SpaceOf<2, ReportTriangulation2<CellInfo>>;
    using typename Base::Cell;
    using typename Base::Point;
    using typename Base::Triangulation;
    using typename Base::Vertex;
    static constexpr int n_corners = 3;

    /// All cells with the vertex, infinite ones too.
    static void star(const Triangulation &triangulation, Vertex vertex, std::vector<Cell> &cells) {
        cells.clear();
        auto face = triangulation.incident_faces(vertex);
        const auto first = face;
        do cells.push_back(face);
        while (++face != first);
    }

    static void all_cells(const Triangulation &triangulation, std::vector<Cell> &cells) {
        for (auto cell = triangulation.all_faces_begin(); cell != triangulation.all_faces_end(); ++cell)
            cells.push_back(cell);
    }

    static bool is_positive(const Triangulation &triangulation, Cell cell) {
        return triangulation.orientation(cell->vertex(0)->point(), cell->vertex(1)->point(),
                                         cell->vertex(2)->point()) == CGAL::POSITIVE;
    }

    /// Ties as CGAL itself breaks them. An infinite cell's circle is the half-plane beyond its edge.
    static bool is_inside_circle(const Triangulation &triangulation, Cell cell, const Point &point) {
        return triangulation.side_of_oriented_circle(cell, point, true) == CGAL::ON_POSITIVE_SIDE;
    }

    /// The placement of section 3.2: flips where no triangle is inverted; else, and at the hull, insertion at
    /// the new place and removal at the old one. The vertex may be another afterwards.
    static Vertex place(Triangulation &triangulation, Vertex vertex, const Point &point,
                        std::vector<Cell> &made) {
        if (flip_around(triangulation, vertex, point, made)) return vertex;
        const auto n_before = triangulation.number_of_vertices();
        const VertexInfo info = vertex->info();
        const Vertex placed = triangulation.insert(point, vertex->face());
        if (triangulation.number_of_vertices() == n_before)
            throw std::runtime_error("two points at one place: the report's algorithms know none");
        std::vector<Vertex> link;
        auto neighbour = triangulation.incident_vertices(vertex);
        const auto first = neighbour;
        do link.push_back(neighbour);
        while (++neighbour != first);
        triangulation.remove(vertex);
        gather_within(triangulation, link, made);
        placed->info() = info;
        return placed;
    }

private:
    /// All faces that have their corners among these vertices: those that fill the star of a removed one,
    /// perhaps others around it.
    static void gather_within(const Triangulation &triangulation, const std::vector<Vertex> &vertices,
                              std::vector<Cell> &faces) {
        const auto is_among = [&](Vertex v) {
            return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
        };
        std::vector<Cell> star_of_one;
        for (const Vertex vertex : vertices) {
            star(triangulation, vertex, star_of_one);
            for (const Cell face : star_of_one)
                if (is_among(face->vertex(0)) && is_among(face->vertex(1)) && is_among(face->vertex(2)))
                    faces.push_back(face);
        }
    }

    /// Lawson's flips from the star outwards. False, and nothing done, where a triangle would be inverted or
    /// the vertex is on the hull.
    static bool flip_around(Triangulation &triangulation, Vertex vertex, const Point &point,
                            std::vector<Cell> &made) {
        star(triangulation, vertex, made);
        const Point old = vertex->point();
        vertex->set_point(point);
        for (const Cell face : made)
            if (triangulation.is_infinite(face) || !is_positive(triangulation, face)) {
                vertex->set_point(old);
                made.clear();
                return false;
            }
        std::vector<std::pair<Cell, int>> edges;
        for (const Cell face : made)
            for (int corner = 0; corner < 3; ++corner) edges.emplace_back(face, corner);
        while (!edges.empty()) {
            const auto [face, corner] = edges.back();
            edges.pop_back();
            const Cell other = face->neighbor(corner);
            if (triangulation.is_infinite(face) || triangulation.is_infinite(other)) continue;
            if (!is_inside_circle(triangulation, face, other->vertex(other->index(face))->point())) continue;
            triangulation.flip(face, corner);
            made.push_back(other);
            made.push_back(face);
            for (int i = 0; i < 3; ++i) {
                edges.emplace_back(face, i);
                edges.emplace_back(other, i);
            }
        }
        return true;
    }
};

template <typename CellInfo>
struct ReportSpace<3, CellInfo> : SpaceOf<3, ReportTriangulation3<CellInfo>> {
    using Base = SpaceOf<3, ReportTriangulation3<CellInfo>>;
    using typename Base::Cell;
    using typename Base::Point;
    using typename Base::Triangulation;
    using typename Base::Vertex;
    static constexpr int n_corners = 4;

    static void star(const Triangulation &triangulation, Vertex vertex, std::vector<Cell> &cells) {
        cells.clear();
        triangulation.incident_cells(vertex, std::back_inserter(cells));
    }

    static void all_cells(const Triangulation &triangulation, std::vector<Cell> &cells) {
        for (auto cell = triangulation.all_cells_begin(); cell != triangulation.all_cells_end(); ++cell)
            cells.push_back(cell);
    }

    static bool is_positive(const Triangulation &triangulation, Cell cell) {
        return triangulation.geom_traits().orientation_3_object()(
                   cell->vertex(0)->point(), cell->vertex(1)->point(), cell->vertex(2)->point(),
                   cell->vertex(3)->point()) == CGAL::POSITIVE;
    }

    static bool is_inside_circle(const Triangulation &triangulation, Cell cell, const Point &point) {
        return triangulation.side_of_sphere(cell, point, true) == CGAL::ON_BOUNDED_SIDE;
    }

    /// Insertion at the new place, removal at the old one. The vertex is another afterwards.
    static Vertex place(Triangulation &triangulation, Vertex vertex, const Point &point,
                        std::vector<Cell> &made) {
        const auto n_before = triangulation.number_of_vertices();
        const VertexInfo info = vertex->info();
        const Vertex placed = triangulation.insert(point, vertex->cell());
        if (triangulation.number_of_vertices() == n_before)
            throw std::runtime_error("two points at one place: the report's algorithms know none");
        triangulation.remove_and_give_new_cells(vertex, std::back_inserter(made));
        placed->info() = info;
        return placed;
    }
};

/// Whether the star of a vertex would do for it at another place: no certificate of the star fails. The
/// vertex is there afterwards if so, else where it was.
template <typename Space>
bool move_if_star_stays(const typename Space::Triangulation &triangulation, typename Space::Vertex vertex,
                        const typename Space::Point &point, std::vector<typename Space::Cell> &star) {
    Space::star(triangulation, vertex, star);
    const typename Space::Point old = vertex->point();
    vertex->set_point(point);
    const auto holds = [&](typename Space::Cell cell) {
        const int at = cell->index(vertex);
        const auto infinite = triangulation.infinite_vertex();
        int own_infinite = -1;
        if (cell->has_vertex(infinite, own_infinite)) {
            // Convex at its ridges; its finite neighbour's orientation does for the facet of the hull.
            for (int corner = 0; corner < Space::n_corners; ++corner) {
                if (corner == own_infinite) continue;
                const auto other = cell->neighbor(corner);
                const auto opposite = other->vertex(other->index(cell));
                if (opposite != infinite && Space::is_inside_circle(triangulation, cell, opposite->point()))
                    return false;
            }
            return true;
        }
        if (!Space::is_positive(triangulation, cell)) return false;
        for (int corner = 0; corner < Space::n_corners; ++corner) {
            const auto other = cell->neighbor(corner);
            const auto opposite = other->vertex(other->index(cell));
            if (opposite == infinite) continue;
            // A facet between two cells of the star is looked at from one of them.
            if (corner != at && &*other < &*cell) continue;
            if (Space::is_inside_circle(triangulation, cell, opposite->point())) return false;
        }
        return true;
    };
    for (const auto cell : star)
        if (!holds(cell)) {
            vertex->set_point(old);
            return false;
        }
    return true;
}

}  // namespace bench
