// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's Delaunay triangulations in two and three dimensions under one set of names.
#pragma once

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace bench {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// What a CGAL vertex carries: the id of a point at its place, and the number of points there (CGAL holds one
/// vertex for coincident points).
struct VertexInfo {
    std::uint32_t id = 0;
    std::uint32_t n_sharers = 0;
};

/// What a triangulation of either dimension has under other names.
template <unsigned dimension, typename CgalTriangulation>
struct SpaceOf;

template <typename CgalTriangulation>
struct SpaceOf<2, CgalTriangulation> {
    using Triangulation = CgalTriangulation;
    using Point = typename Triangulation::Point;
    using Vertex = typename Triangulation::Vertex_handle;
    using Cell = typename Triangulation::Face_handle;
    using InputPoint = std::pair<Point, VertexInfo>;
    using SortTraits =
        CGAL::Spatial_sort_traits_adapter_2<CgalKernel, CGAL::First_of_pair_property_map<InputPoint>>;

    static Point point(const double *coordinates) { return {coordinates[0], coordinates[1]}; }

    /// A cell at the vertex, from which to walk.
    static Cell hint(Vertex vertex) { return vertex->face(); }

    template <typename Visit>
    static void for_each_cell(const Triangulation &triangulation, Visit visit) {
        if (triangulation.dimension() < 2) return;
        for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face)
            visit(std::array<Vertex, 3>{face->vertex(0), face->vertex(1), face->vertex(2)});
    }

    static auto all_cells_begin(const Triangulation &triangulation) { return triangulation.all_faces_begin(); }
    static auto all_cells_end(const Triangulation &triangulation) { return triangulation.all_faces_end(); }
    static std::size_t n_all_cells(const Triangulation &triangulation) { return triangulation.tds().faces().size(); }

    /// Finite ones.
    template <typename Visit>
    static void for_each_cell_at(const Triangulation &triangulation, Vertex vertex, std::vector<Cell> &, Visit visit) {
        if (triangulation.dimension() < 2) return;
        auto face = triangulation.incident_faces(vertex);
        const auto first = face;
        do {
            if (!triangulation.is_infinite(face)) visit(face);
        } while (++face != first);
    }
};

template <typename CgalTriangulation>
struct SpaceOf<3, CgalTriangulation> {
    using Triangulation = CgalTriangulation;
    using Point = typename Triangulation::Point;
    using Vertex = typename Triangulation::Vertex_handle;
    using Cell = typename Triangulation::Cell_handle;
    using InputPoint = std::pair<Point, VertexInfo>;
    using SortTraits =
        CGAL::Spatial_sort_traits_adapter_3<CgalKernel, CGAL::First_of_pair_property_map<InputPoint>>;

    static Point point(const double *coordinates) { return {coordinates[0], coordinates[1], coordinates[2]}; }

    static Cell hint(Vertex vertex) { return vertex->cell(); }

    template <typename Visit>
    static void for_each_cell(const Triangulation &triangulation, Visit visit) {
        if (triangulation.dimension() < 3) return;
        for (auto cell = triangulation.finite_cells_begin(); cell != triangulation.finite_cells_end(); ++cell)
            visit(std::array<Vertex, 4>{cell->vertex(0), cell->vertex(1), cell->vertex(2), cell->vertex(3)});
    }

    static auto all_cells_begin(const Triangulation &triangulation) { return triangulation.all_cells_begin(); }
    static auto all_cells_end(const Triangulation &triangulation) { return triangulation.all_cells_end(); }
    static std::size_t n_all_cells(const Triangulation &triangulation) { return triangulation.tds().cells().size(); }

    /// Finite ones. `room` is for them, and kept by the caller so that it need not be allocated each time.
    template <typename Visit>
    static void for_each_cell_at(const Triangulation &triangulation, Vertex vertex, std::vector<Cell> &room,
                                 Visit visit) {
        if (triangulation.dimension() < 3) return;
        room.clear();
        triangulation.finite_incident_cells(vertex, std::back_inserter(room));
        for (const Cell cell : room) visit(cell);
    }
};

using VertexBase2 = CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, CgalKernel>;
using VertexBase3 = CGAL::Triangulation_vertex_base_with_info_3<VertexInfo, CgalKernel>;
/// Cells carry their row in the arrays of a reading. It takes the place of padding: cells are as large without.
using CellBase2 = CGAL::Triangulation_face_base_with_info_2<std::uint32_t, CgalKernel>;
using CellBase3 = CGAL::Triangulation_cell_base_with_info_3<std::uint32_t, CgalKernel,
                                                            CGAL::Delaunay_triangulation_cell_base_3<CgalKernel>>;

template <unsigned dimension>
struct CgalSpace;

template <>
struct CgalSpace<2> : SpaceOf<2, CGAL::Delaunay_triangulation_2<
                                     CgalKernel, CGAL::Triangulation_data_structure_2<VertexBase2, CellBase2>>> {};

template <>
struct CgalSpace<3> : SpaceOf<3, CGAL::Delaunay_triangulation_3<
                                     CgalKernel, CGAL::Triangulation_data_structure_3<VertexBase3, CellBase3>>> {};

/// Points with their ids, in the order of the ids.
template <unsigned dimension>
std::vector<typename CgalSpace<dimension>::InputPoint> input_points(const double *positions,
                                                                    std::size_t n_points) {
    std::vector<typename CgalSpace<dimension>::InputPoint> input;
    input.reserve(n_points);
    for (std::size_t id = 0; id < n_points; ++id)
        input.emplace_back(CgalSpace<dimension>::point(positions + id * dimension),
                           VertexInfo{static_cast<std::uint32_t>(id), 0});
    return input;
}

/// What CGAL's range insertion of bare points does, with ids: the input is sorted spatially in place and
/// every point is inserted from the vertex before it. CGAL's own range insertion with info sorts indices
/// instead and reaches for the points through them, which is slower on large inputs.
template <typename Space>
void insert_sorted(typename Space::Triangulation &triangulation, std::vector<typename Space::InputPoint> &input) {
    CGAL::spatial_sort(input.begin(), input.end(), typename Space::SortTraits());
    typename Space::Vertex last;
    for (const auto &[point, info] : input) {
        last = last == typename Space::Vertex() ? triangulation.insert(point)
                                                : triangulation.insert(point, Space::hint(last));
        last->info() = info;
    }
}

template <unsigned dimension>
void insert_range(typename CgalSpace<dimension>::Triangulation &triangulation,
                  std::vector<typename CgalSpace<dimension>::InputPoint> &input) {
    insert_sorted<CgalSpace<dimension>>(triangulation, input);
}

/// Vertex ids of all finite cells, as the vertices carry them.
template <typename Space>
std::vector<std::uint32_t> ids_of_cells(const typename Space::Triangulation &triangulation) {
    std::vector<std::uint32_t> ids;
    Space::for_each_cell(triangulation, [&](const auto &vertices) {
        for (const auto vertex : vertices) ids.push_back(vertex->info().id);
    });
    return ids;
}

template <unsigned dimension>
std::vector<std::uint32_t> cell_ids(const typename CgalSpace<dimension>::Triangulation &triangulation) {
    return ids_of_cells<CgalSpace<dimension>>(triangulation);
}

}  // namespace bench
