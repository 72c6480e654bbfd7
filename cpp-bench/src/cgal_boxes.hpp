// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's periodic triangulations of the unit box in two and three dimensions under one set of names.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Periodic_2_Delaunay_triangulation_2.h>
#include <CGAL/Periodic_2_Delaunay_triangulation_traits_2.h>
#include <CGAL/Periodic_3_Delaunay_triangulation_3.h>
#include <CGAL/Periodic_3_Delaunay_triangulation_traits_3.h>

#include <array>
#include <cstddef>

namespace bench {

template <unsigned dimension>
struct CgalBox;

template <>
struct CgalBox<2> {
    using Traits =
        CGAL::Periodic_2_Delaunay_triangulation_traits_2<CGAL::Exact_predicates_inexact_constructions_kernel>;
    using Triangulation = CGAL::Periodic_2_Delaunay_triangulation_2<Traits>;
    using Point = Triangulation::Point;

    static Point point(const double *coordinates) { return {coordinates[0], coordinates[1]}; }
    static std::array<double, 2> coordinates(const Point &p) { return {p.x(), p.y()}; }
    static Triangulation::Iso_rectangle domain() { return {0, 0, 1, 1}; }

    /// Places of the corners, and by how many lengths of the box they are shifted.
    template <typename Visit>
    static void for_each_cell(const Triangulation &t, Visit visit) {
        for (auto face = t.faces_begin(); face != t.faces_end(); ++face) {
            std::array<Point, 3> corners;
            std::array<std::array<int, 2>, 3> shifts;
            for (int i = 0; i < 3; ++i) {
                const auto placed = t.periodic_point(face, i);
                corners[i] = placed.first;
                shifts[i] = {placed.second.x(), placed.second.y()};
            }
            visit(corners, shifts);
        }
    }
};

template <>
struct CgalBox<3> {
    using Traits =
        CGAL::Periodic_3_Delaunay_triangulation_traits_3<CGAL::Exact_predicates_inexact_constructions_kernel>;
    using Triangulation = CGAL::Periodic_3_Delaunay_triangulation_3<Traits>;
    using Point = Triangulation::Point;

    static Point point(const double *coordinates) { return {coordinates[0], coordinates[1], coordinates[2]}; }
    static std::array<double, 3> coordinates(const Point &p) { return {p.x(), p.y(), p.z()}; }
    static Triangulation::Iso_cuboid domain() { return {0, 0, 0, 1, 1, 1}; }

    template <typename Visit>
    static void for_each_cell(const Triangulation &t, Visit visit) {
        for (auto cell = t.cells_begin(); cell != t.cells_end(); ++cell) {
            std::array<Point, 4> corners;
            std::array<std::array<int, 3>, 4> shifts;
            for (int i = 0; i < 4; ++i) {
                const auto placed = t.periodic_point(cell, i);
                corners[i] = placed.first;
                shifts[i] = {placed.second.x(), placed.second.y(), placed.second.z()};
            }
            visit(corners, shifts);
        }
    }
};

}  // namespace bench
