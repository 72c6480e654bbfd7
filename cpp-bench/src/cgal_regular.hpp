// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's regular triangulations in two and three dimensions under one set of names.
#pragma once

#include "cgal_space.hpp"

#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_face_base_2.h>
#include <CGAL/Regular_triangulation_vertex_base_2.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace bench {

using RegularVertexBase2 = CGAL::Triangulation_vertex_base_with_info_2<
    VertexInfo, CgalKernel, CGAL::Regular_triangulation_vertex_base_2<CgalKernel>>;
using RegularFaceBase2 = CGAL::Triangulation_face_base_with_info_2<std::uint32_t, CgalKernel,
                                                                   CGAL::Regular_triangulation_face_base_2<CgalKernel>>;
using RegularVertexBase3 = CGAL::Triangulation_vertex_base_with_info_3<
    VertexInfo, CgalKernel, CGAL::Regular_triangulation_vertex_base_3<CgalKernel>>;
using RegularCellBase3 = CGAL::Triangulation_cell_base_with_info_3<std::uint32_t, CgalKernel,
                                                                   CGAL::Regular_triangulation_cell_base_3<CgalKernel>>;

/// Where a point is, and its weight and id.
struct WeightAndId {
    double weight;
    std::uint32_t id;
};

template <unsigned dimension>
struct RegularSpace;

template <>
struct RegularSpace<2>
    : SpaceOf<2, CGAL::Regular_triangulation_2<
                     CgalKernel, CGAL::Triangulation_data_structure_2<RegularVertexBase2, RegularFaceBase2>>> {
    using WeightedInput = std::pair<CgalKernel::Point_2, WeightAndId>;
    using WeightedSortTraits =
        CGAL::Spatial_sort_traits_adapter_2<CgalKernel, CGAL::First_of_pair_property_map<WeightedInput>>;

    static CgalKernel::Point_2 place(const double *coordinates) { return {coordinates[0], coordinates[1]}; }

    /// Inserts a point; where to look for the next one.
    static Cell insert(Triangulation &triangulation, const WeightedInput &input, Cell hint) {
        const Vertex vertex = triangulation.insert(Point(input.first, input.second.weight), hint);
        vertex->info().id = input.second.id;
        return vertex->face();
    }

    static std::size_t n_hidden(const Triangulation &triangulation) {
        return triangulation.number_of_hidden_vertices();
    }
};

template <>
struct RegularSpace<3>
    : SpaceOf<3, CGAL::Regular_triangulation_3<
                     CgalKernel, CGAL::Triangulation_data_structure_3<RegularVertexBase3, RegularCellBase3>>> {
    using WeightedInput = std::pair<CgalKernel::Point_3, WeightAndId>;
    using WeightedSortTraits =
        CGAL::Spatial_sort_traits_adapter_3<CgalKernel, CGAL::First_of_pair_property_map<WeightedInput>>;

    static CgalKernel::Point_3 place(const double *coordinates) {
        return {coordinates[0], coordinates[1], coordinates[2]};
    }

    /// A point that is hidden is kept by a cell, without its id.
    static Cell insert(Triangulation &triangulation, const WeightedInput &input, Cell hint) {
        const Point point(input.first, input.second.weight);
        typename Triangulation::Locate_type type;
        int i, k;
        const Cell cell = triangulation.locate(point, type, i, k, hint);
        const Vertex vertex = triangulation.insert(point, type, cell, i, k);
        if (vertex == Vertex()) return cell;
        vertex->info().id = input.second.id;
        return vertex->cell();
    }

    static std::size_t n_hidden(const Triangulation &triangulation) {
        std::size_t n = 0;
        for (auto cell = triangulation.all_cells_begin(); cell != triangulation.all_cells_end(); ++cell)
            n += static_cast<std::size_t>(std::distance(cell->hidden_points_begin(), cell->hidden_points_end()));
        return n;
    }
};

/// What CGAL's range insertion of bare weighted points does, with ids: a spatial sort, and every point inserted from
/// the cell of the one before it.
template <unsigned dimension>
void insert_weighted(typename RegularSpace<dimension>::Triangulation &triangulation,
                     std::vector<typename RegularSpace<dimension>::WeightedInput> &input) {
    using Space = RegularSpace<dimension>;
    CGAL::spatial_sort(input.begin(), input.end(), typename Space::WeightedSortTraits());
    typename Space::Cell hint;
    for (const auto &one : input) hint = Space::insert(triangulation, one, hint);
}

}  // namespace bench
