// GetFEM's function, before libgetfem: cells against a new triangulation; other dimensions are GetFEM's own.
#include <getfem/bgeot_convex_ref.h>

#include "check.hpp"

static std::vector<bgeot::base_node> nodes_of(const Points &points, std::size_t dimension) {
    std::vector<bgeot::base_node> nodes;
    for (std::size_t i = 0; i < points.size(); i += dimension) {
        nodes.emplace_back(dimension);
        for (std::size_t axis = 0; axis < dimension; axis++) nodes.back()[axis] = points[i + axis];
    }
    return nodes;
}

int main() {
    gmm::dense_matrix<bgeot::size_type> simplexes;
    for (const unsigned dimension : {2u, 3u}) {
        Points points = random_points(dimension, 500, dimension);
        for (unsigned step = 0; step < 5; step++) {
            points = moved(points, 0.003, step);
            bgeot::qhull_delaunay(nodes_of(points, dimension), simplexes);
            CHECK(gmm::mat_nrows(simplexes) == dimension + 1);
            CellSet cells;
            for (std::size_t c = 0; c < gmm::mat_ncols(simplexes); c++) {
                std::uint32_t corners[4] = {};
                for (unsigned i = 0; i <= dimension; i++) corners[i] = static_cast<std::uint32_t>(simplexes(i, c));
                insert_cell(cells, corners, dimension + 1, 0u);
            }
            CHECK(cells == fresh_cells(dimension, points));
        }
    }
    // A simplex in four dimensions.
    const Points corners{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    bgeot::qhull_delaunay(nodes_of(corners, 4), simplexes);
    CHECK(gmm::mat_nrows(simplexes) == 5 && gmm::mat_ncols(simplexes) == 1);
    Points bad = random_points(2, 10, 9);
    bad[3] = 1e60;
    bool thrown = false;
    try {
        bgeot::qhull_delaunay(nodes_of(bad, 2), simplexes);
    } catch (const std::runtime_error &) {
        thrown = true;
    }
    CHECK(thrown);
}
