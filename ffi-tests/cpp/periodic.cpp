// Periodic triangulations in C++.
#include "check.hpp"

#include <cmath>

using deldrift::Triangulation;

static const std::vector<double> points{0.125, 0.25, 0.75, 0.5, 0.375, 0.875, 2.5, -0.25};
static const std::vector<double> box{1, 0, 0.25, 1};

// Cells have the area of the box, by the places of their corners.
static double area_of(const Triangulation &t) {
    const std::vector<double> vectors = t.vectors(), places = t.positions();
    const std::vector<std::int64_t> shifts = t.cell_shifts().corners;
    deldrift_cells_view view;
    CHECK(deldrift_cells(t.native(), &view) == DELDRIFT_OK);
    double sum = 0;
    for (std::size_t c = 0; c < t.cell_count(); c++) {
        double at[6];
        for (std::size_t i = 0; i < 6; i++) {
            const std::size_t corner = 3 * c + i / 2, axis = i % 2;
            at[i] = places[2 * view.vertices[corner] + axis];
            for (std::size_t k = 0; k < 2; k++) at[i] += double(shifts[2 * corner + k]) * vectors[2 * k + axis];
        }
        sum += ((at[2] - at[0]) * (at[5] - at[1]) - (at[3] - at[1]) * (at[4] - at[0])) / 2;
    }
    return sum;
}

int main() {
    Triangulation t(2, points, deldrift::Periodic(box));
    CHECK(t.vectors() == box && t.cell_count() == 8 && std::fabs(area_of(t) - 1) < 1e-12);
    CHECK(t.cell_shifts().neighbours.size() == 48 && t.edge_shifts().size() == 24 && t.edges().size() == 24);
    CHECK(t.reduced_vectors().vectors == box && t.reduced_vectors().multiples == (std::vector<std::int64_t>{1, 0, 0, 1}));
    const std::vector<double> previous(8, 0.5);
    CHECK(t.wrap_positions(points).places[6] == 0.75 && t.wrap_positions(points).shifts[7] == -1);
    CHECK(t.wrap_positions(points, previous).shifts == t.wrap_positions(points).shifts);
    CHECK_THROWS(t.wrap_positions(points, box), DELDRIFT_WRONG_COUNT, "previous has 4 numbers");
    t.stage_vectors(std::vector<double>{1, 0, 0, 1.5});
    t.commit_timestamp();
    CHECK(std::fabs(area_of(t) - 1.5) < 1e-12);
    double sum = 0;
    for (const double volume : t.voronoi_volumes()) sum += volume;
    CHECK(std::fabs(sum - 1.5) < 1e-12);
    CHECK_THROWS(t.clone(), DELDRIFT_PERIODIC, "t is periodic");
    CHECK_THROWS(t.stage_vectors(std::vector<double>{1, 0}), DELDRIFT_WRONG_COUNT, "vector_count is 1");
    CHECK_THROWS(Triangulation(2, points, deldrift::Periodic(std::vector<double>{1, 1, 2, 2})),
                 DELDRIFT_DEPENDENT_VECTORS, "vectors[1]");
    CHECK(Triangulation(2, points).vectors().empty());
    return 0;
}
