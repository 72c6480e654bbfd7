// Geometry in C++: the members give what the functions of deldrift.h do.
#include <cmath>
#include <cstdlib>
#include <deldrift.hpp>
#include <iostream>
#include <numeric>

#define CHECK(condition)                                                                   \
    do {                                                                                   \
        if (!(condition)) {                                                                \
            std::cerr << __FILE__ << ":" << __LINE__ << ": not so: " << #condition << "\n"; \
            std::exit(1);                                                                  \
        }                                                                                  \
    } while (false)

using deldrift::Triangulation;
using Ids = std::vector<std::uint32_t>;

// A quadrilateral with a vertex inside.
static const std::vector<double> square{0, 0, 4, 0, 5, 5, 0, 4, 1, 2};

static void cells_have_measures() {
    const Triangulation t(2, square);
    const std::vector<double> volumes = t.volumes();
    CHECK(volumes.size() == 4 && std::fabs(std::accumulate(volumes.begin(), volumes.end(), 0.0) - 20) < 1e-13);
    const deldrift::Circumspheres spheres = t.circumcentres();
    CHECK(spheres.centres.size() == 8 && spheres.squared_radii.size() == 4);
    for (std::size_t cell = 0; cell < 4; cell++) {
        for (std::uint32_t vertex : t.cells()[cell]) {
            const double x = square[2 * vertex] - spheres.centres[2 * cell];
            const double y = square[2 * vertex + 1] - spheres.centres[2 * cell + 1];
            CHECK(std::fabs(x * x + y * y - spheres.squared_radii[cell]) < 1e-13);
        }
        const auto mask = t.mask_by_circumradius(spheres.squared_radii[cell] + 1e-9);
        CHECK(mask.size() == 4 && mask[cell] == 1);
    }
    CHECK(t.mask_by_circumradius(0) == std::vector<std::uint8_t>(4, 0));
    bool thrown = false;
    try {
        t.mask_by_circumradius(-1);
    } catch (const deldrift::Error &error) {
        thrown = error.status() == DELDRIFT_INVALID_VALUE;
    }
    CHECK(thrown);
}

static void masks_have_boundaries() {
    const Triangulation t(2, square);
    const deldrift::Facets hull = t.hull_facets(), all = t.mask_boundary(std::vector<std::uint8_t>(4, 1));
    CHECK(hull.size() == 4 && hull.vertices == all.vertices && hull.cells == all.cells && hull.corners == all.corners);
    for (std::size_t k = 0; k < hull.size(); k++) {
        CHECK(t.cells().neighbours_of(hull.cells[k])[hull.corners[k]] == DELDRIFT_NONE);
        CHECK(t.mirror_index(hull.cells[k], hull.corners[k]) == DELDRIFT_NONE);
        CHECK(t.mirror_indices()[3 * hull.cells[k] + hull.corners[k]] == 255);
        CHECK((hull.vertices[2 * k] + 1) % 4 == hull.vertices[2 * k + 1]);
    }
    CHECK(t.mask_boundary({1, 0, 0, 0}).size() == 3 && Triangulation(3, {}).mask_boundary({}).size() == 0);
}

static void vertices_have_lists() {
    const Triangulation t(2, square);
    CHECK((t.edges() == Ids{0, 1, 0, 3, 0, 4, 1, 2, 1, 4, 2, 3, 2, 4, 3, 4}));
    const deldrift::Lists neighbours = t.vertex_neighbours(), cells = t.vertex_cells();
    const auto middle = neighbours.of_vertex(4);
    CHECK((Ids(middle.begin(), middle.end()) == Ids{0, 1, 2, 3}) && neighbours.offsets.size() == 6);
    CHECK(cells.entries.size() == 12 && cells.of_vertex(4).size() == 4 && cells.of_vertex(0).size() == 2);
    CHECK(t.ordered_star(4).size() == 4 && t.ordered_star(4)[0] == 0);
    CHECK(Triangulation(3, {}).vertex_cells().offsets == Ids{0} && Triangulation(2, {}).edges().empty());
}

static void means_are_brought_over() {
    Triangulation t(2, square);
    t.take_changes();
    std::vector<double> means = t.volumes(), before = means;
    double content = 0, found = 0;
    for (const double volume : t.volumes()) content += volume * volume;
    t.remove_vertex(4);
    t.insert_vertex({1.0, 2.5});
    int thrown = 0;
    for (int wrong = 0; wrong < 3; wrong++) {
        try {
            if (wrong == 0) t.transfer_cells(means);
            if (wrong == 1) t.take_changes(), t.transfer_cells(means);
            means.pop_back();
            if (wrong == 2) t.transfer_cells(means, 1, square);
        } catch (const deldrift::Error &error) {
            static const deldrift_status wanted[] = {DELDRIFT_CHANGES_NOT_TAKEN, DELDRIFT_REMOVED_VERTEX,
                                                     DELDRIFT_WRONG_COUNT};
            thrown += error.status() == wanted[wrong];
        }
        means = before;
    }
    CHECK(thrown == 3);
    const deldrift::Transfer made = t.transfer_cells(means, 1, square, DELDRIFT_TRANSFER_FIRST_ORDER);
    const std::vector<double> volumes = t.volumes();
    CHECK(means.size() == volumes.size() && made.report.gone == 4 && made.lost.size() == 1);
    for (std::size_t c = 0; c < means.size(); c++) found += means[c] * volumes[c];
    CHECK(std::abs(found - content) < 1e-12 && std::abs(made.lost[0]) + std::abs(made.gained[0]) < 1e-12);
}

static void arrays_are_kept() {
    Triangulation t(2, square);
    deldrift::Circumspheres spheres = t.circumcentres();
    std::vector<double> volumes = t.volumes();
    std::vector<std::uint8_t> mask = t.mask_by_circumradius(9);
    CHECK((t.cells_around({4}) == Ids{0, 1, 2, 3}) && t.cells_around({0, 0}).size() == 2);
    CHECK(t.cells_around({}).empty() && t.cells_around(Ids{0, 1, 2, 3, 4}).size() == 4);
    t.take_changes();
    t.move_vertex(4, {3.0, 2.5});
    t.commit_timestamp();
    const deldrift_changes changes = t.take_changes();
    CHECK(changes.created_count == 0 && changes.renumbered_count == 0);
    const Ids around = t.cells_around({4});
    t.update_circumcentres(around, spheres);
    t.update_volumes(around, volumes);
    t.update_mask_by_circumradius(around, 9, mask);
    CHECK(spheres.centres == t.circumcentres().centres && spheres.squared_radii == t.circumcentres().squared_radii);
    CHECK(volumes == t.volumes() && mask == t.mask_by_circumradius(9));
    int thrown = 0;
    for (int wrong = 0; wrong < 3; wrong++) {
        try {
            if (wrong == 0) t.update_volumes({0, 4}, volumes);
            if (wrong == 1) t.update_mask_by_circumradius({0}, -1, mask);
            spheres.centres.pop_back();
            if (wrong == 2) t.update_circumcentres({0}, spheres);
        } catch (const deldrift::Error &error) {
            static const deldrift_status wanted[] = {DELDRIFT_NO_SUCH_FACET, DELDRIFT_INVALID_VALUE,
                                                     DELDRIFT_WRONG_COUNT};
            thrown += error.status() == wanted[wrong];
        }
    }
    CHECK(thrown == 3);
    // Stars that are larger than usual.
    std::vector<double> wheel{0, 0};
    for (int k = 0; k < 50; k++) {
        wheel.push_back(std::cos(k * 0.1256));
        wheel.push_back(std::sin(k * 0.1256));
    }
    const Triangulation spokes(2, wheel);
    CHECK(spokes.cells_around({0}).size() == spokes.cell_count() && spokes.cell_count() > 40);
    deldrift::Circumspheres none;
    Triangulation(3, {}).update_circumcentres({}, none);
    CHECK(Triangulation(3, {}).cells_around({}).empty());
}

static void voronoi_cells_fill_a_box() {
    const Triangulation t(2, square);
    const std::vector<double> volumes = t.voronoi_volumes({-1.0, -2.0}, {7.0, 3.0});
    CHECK(volumes.size() == 5 && std::fabs(std::accumulate(volumes.begin(), volumes.end(), 0.0) - 40) < 1e-12);
    CHECK(std::isinf(t.voronoi_volumes()[0]) && t.voronoi_facets().size() == 8);
    CHECK(t.voronoi_facets({0.0, 0.0}, {1.0, 1.0})[0] >= 0);
    const deldrift::VoronoiCells cells = t.voronoi_cells({-1.0, -2.0}, {7.0, 3.0});
    for (std::size_t v = 0; v < 5; ++v) CHECK(std::fabs(cells.volumes[v] - volumes[v]) < 1e-12);
    const deldrift::VoronoiDerivatives facets = t.voronoi_derivatives({-1.0, -2.0}, {7.0, 3.0});
    CHECK(facets.measures.size() == 8 && facets.centroids.size() == 16 && facets.derivatives.size() == 32);
    const std::vector<std::uint8_t> mask{0, 0, 0, 0, 1};
    const deldrift::VoronoiCells one = t.voronoi_cells({-1.0, -2.0}, {7.0, 3.0}, mask);
    const deldrift::VoronoiCells half = t.voronoi_cells_within({-1.0, -2.0}, {7.0, 3.0}, {2.0, 0.0, 6.0});
    CHECK(std::fabs(std::accumulate(half.volumes.begin(), half.volumes.end(), 0.0) - 20) < 1e-12);
    const deldrift::VoronoiDerivatives left = t.voronoi_derivatives_within({-1.0, -2.0}, {7.0, 3.0}, {2.0, 0.0, 6.0});
    for (std::size_t e = 0; e < 8; ++e) CHECK(left.measures[e] <= facets.measures[e] + 1e-12);
    const auto both = t.voronoi_cells_and_facets({-1.0, -2.0}, {7.0, 3.0});
    CHECK(both.first.volumes == cells.volumes && both.first.areas == cells.areas && both.first.centroids == cells.centroids);
    CHECK(both.second.measures == facets.measures && both.second.derivatives == facets.derivatives);
    for (std::size_t i = 0; i < facets.centroids.size(); ++i) {
        const double middle = facets.centroids[i];
        CHECK(both.second.centroids[i] == middle || (std::isnan(both.second.centroids[i]) && std::isnan(middle)));
    }
    const auto open = t.voronoi_cells_and_facets();
    CHECK(open.first.volumes == t.voronoi_volumes() && open.second.measures == t.voronoi_facets());
    CHECK(t.voronoi_changed({4}) == std::vector<std::uint8_t>(5, 1));
    CHECK(std::isnan(one.volumes[0]) && one.volumes[4] == cells.volumes[4] && one.areas[4] == cells.areas[4]);
    bool thrown = false;
    try {
        t.voronoi_volumes({0.0}, {1.0, 1.0});
    } catch (const deldrift::Error &error) {
        thrown = error.status() == DELDRIFT_WRONG_COUNT;
    }
    CHECK(thrown);
    thrown = false;
    try {
        t.voronoi_cells_within({0.0, 0.0}, {1.0, 1.0}, {1.0, 1.0});
    } catch (const deldrift::Error &error) {
        thrown = error.status() == DELDRIFT_WRONG_COUNT;
    }
    CHECK(thrown);
}

static void values_are_interpolated() {
    const Triangulation t(2, square);
    for (auto method : {DELDRIFT_INTERPOLATION_LINEAR, DELDRIFT_INTERPOLATION_NATURAL_NEIGHBOUR}) {
        const auto at = t.interpolate(method, square, 2, std::vector<double>{2, 1, 9, 9}, {7.0, 8.0});
        CHECK(at.size() == 4 && std::fabs(at[0] - 2) < 1e-14 && std::fabs(at[1] - 1) < 1e-14);
        CHECK(at[2] == 7 && at[3] == 8);
        CHECK(std::isnan(t.interpolate(method, square, 2, std::vector<double>{9, 9})[0]));
    }
}

int main() {
    voronoi_cells_fill_a_box();
    values_are_interpolated();
    cells_have_measures();
    arrays_are_kept();
    means_are_brought_over();
    masks_have_boundaries();
    vertices_have_lists();
}
