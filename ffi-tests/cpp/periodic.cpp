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
    const deldrift::PeriodLocations at = t.locate_in_period(std::vector<double>{3.125, -7.75, 0.5, 0.5});
    CHECK(at.locations[0].kind == DELDRIFT_LOCATION_VERTEX && at.locations[0].index == 0);
    CHECK(at.shifts[0] == 5 && at.shifts[1] == -8 && at.locations[1].kind == DELDRIFT_LOCATION_CELL);
    CHECK(t.locate(std::vector<double>{3.125, -7.75}).index == 0);
    CHECK(t.nearest_vertex(std::vector<double>{3.125, -7.75}) == 0);
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
    const deldrift::VoronoiCells cells = t.voronoi_cells();
    CHECK(cells.volumes == t.voronoi_volumes() && cells.areas.size() == 4 && cells.centroids.size() == 8);
    // The last vertex is two lengths away from the box, and so is the centroid of its cell.
    CHECK(std::fabs(cells.centroids[6] - 2.5) < 1 && std::fabs(cells.centroids[7] + 0.25) < 1);
    const deldrift::VoronoiDerivatives facets = t.voronoi_derivatives({}, {}, std::vector<std::uint8_t>{1, 1, 1, 1});
    CHECK(facets.measures == t.voronoi_facets() && facets.derivatives.size() == 48);
    double around = 0, areas = 0;
    for (const double measure : facets.measures) around += 2 * measure;
    for (const double area : cells.areas) areas += area;
    CHECK(std::fabs(around - areas) < 1e-12);
    double all = 0;
    for (const double volume : t.volumes()) all += volume;
    CHECK(std::fabs(all - 1.5) < 1e-12 && t.hull_facets().cells.empty() && t.circumcentres().squared_radii.size() == 8);
    CHECK_THROWS(t.voronoi_cells(std::vector<double>{0, 0}, std::vector<double>{1, 1}), DELDRIFT_INVALID_VALUE,
                 "low[0] is 0, but must be -infinity");
    const double infinite = std::numeric_limits<double>::infinity();
    const Triangulation strip(2, points, deldrift::Periodic(std::vector<double>{1, 0}));
    const std::vector<double> low{-infinite, -0.5}, high{infinite, 3};
    double between = 0, within = 0;
    for (const double volume : strip.voronoi_volumes(low, high)) between += volume;
    for (const double volume : strip.voronoi_cells_within({}, {}, std::vector<double>{0, 2, 6, 0, -1, 0.5}).volumes) within += volume;
    CHECK(std::fabs(between - 3.5) < 1e-12 && std::fabs(within - 3.5) < 1e-12);
    CHECK(strip.voronoi_derivatives(low, high).measures == strip.voronoi_facets(low, high));
    const Triangulation copy = t.clone(), loaded = Triangulation::load(t.save());
    CHECK(copy.cell_shifts().corners == t.cell_shifts().corners && loaded.edge_shifts() == t.edge_shifts());
    CHECK(loaded.vectors() == t.vectors() && loaded.positions() == t.positions() && loaded.save() == t.save());
    CHECK(deldrift_validate(loaded.native(), 3) == DELDRIFT_OK && loaded.star(0).size() == loaded.vertex_neighbours().of_vertex(0).size());
    CHECK_THROWS(t.stage_vectors(std::vector<double>{1, 0}), DELDRIFT_WRONG_COUNT, "vector_count is 1");
    CHECK_THROWS(Triangulation(2, points, deldrift::Periodic(std::vector<double>{1, 1, 2, 2})),
                 DELDRIFT_DEPENDENT_VECTORS, "vectors[1]");
    CHECK(Triangulation(2, points).vectors().empty());
    return 0;
}
