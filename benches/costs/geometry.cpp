// Calls that compute arrays of the cells: measures, lists, Voronoi cells, interpolation.
#include "measure.hpp"

namespace costs {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// One timed call of what fills arrays of all cells.
template <typename One>
void of_cells(Context &c, One one) {
    std::size_t count;
    const std::size_t n = c.cells();
    c.meter.time([&] { must(one(n, &count)); });
    c.meter.count(double(c.n + n));
}

/// ... for which one needs to know how many entries there are.
template <typename Number, typename One>
void counted(Context &c, std::size_t per_entry, One one) {
    std::size_t count;
    must(one(static_cast<Number *>(nullptr), 0, &count));
    std::vector<Number> room(count * per_entry + 1);
    c.meter.time([&] { must(one(room.data(), count, &count)); });
    c.meter.count(double(c.n + c.cells() + count));
}

std::vector<double> numbers(const Context &c, std::size_t per_cell) { return std::vector<double>(c.cells() * per_cell + 1); }

double median_radius(Context &c) {
    std::vector<double> radii = numbers(c, 1);
    std::size_t count;
    must(deldrift_circumcentres(c.t, nullptr, radii.data(), c.cells(), &count));
    std::nth_element(radii.begin(), radii.begin() + std::ptrdiff_t(count / 2), radii.end());
    return radii[count / 2];
}

Ids all_cells(const Context &c) {
    Ids cells;
    for (std::size_t i = c.cells(); i-- > 0;) cells.push_back(std::uint32_t(i));
    return cells;
}

Ids all_vertices(const Context &c) {
    Ids ids;
    for (std::size_t i = c.n; i-- > 0;) ids.push_back(std::uint32_t(i));
    return ids;
}

/// Makes a periodic triangulation of the vertices, in a box a little larger than that of all; its vectors.
std::vector<double> make_periodic(Context &c) {
    const auto [low, high] = c.box(0.05);
    std::vector<double> box(c.dimension * c.dimension);
    for (unsigned k = 0; k < c.dimension; ++k) box[k * (c.dimension + 1)] = std::max(high[k] - low[k], 1e-9);
    deldrift_destroy(c.t);
    c.t = nullptr;
    const deldrift_options options = c.options();
    c.meter.time([&] {
        must(deldrift_create_periodic(c.dimension, c.points.data(), c.n, box.data(), c.dimension, &options, &c.t));
    });
    c.meter.count(double(c.n + c.cells()));
    return box;
}

/// Within the box of all vertices, made so much larger on every side.
template <int percent>
void voronoi_volumes(Context &c) {
    const auto [low, high] = c.box(percent / 100.0);
    std::vector<double> volumes(c.n);
    std::size_t count;
    c.meter.time([&, low = low.data(), high = high.data()] {
        must(deldrift_voronoi_volumes(c.t, low, high, volumes.data(), c.n, &count));
    });
    c.meter.count(double(c.n + c.cells()));
}

template <int percent>
void voronoi_facets(Context &c) {
    const auto [low, high] = c.box(percent / 100.0);
    counted<double>(c, 1, [&, low = low.data(), high = high.data()](double *to, std::size_t room, std::size_t *count) {
        return deldrift_voronoi_facets(c.t, low, high, to, room, count);
    });
}

template <int percent>
void voronoi_cells(Context &c) {
    const auto [low, high] = c.box(percent / 100.0);
    std::vector<double> volumes(c.n), areas(c.n), centroids(c.n * c.dimension);
    std::size_t count;
    c.meter.time([&, low = low.data(), high = high.data()] {
        must(deldrift_voronoi_cells(c.t, low, high, nullptr, 0, volumes.data(), areas.data(), centroids.data(), c.n,
                                    &count));
    });
    c.meter.count(double(c.n + c.cells()));
}

/// An upright polygon of some sides, with a share of the diagonal of a box as its radius.
Points polygon_in(unsigned dimension, const Points &low, const Points &high, int sides, int percent) {
    Points half_spaces;
    for (int k = 0; k < sides; ++k) {
        const double angle = 2 * 3.14159265358979 * k / sides, normal[] = {std::cos(angle), std::sin(angle), 0};
        double offset = percent / 100.0 * std::hypot(high[0] - low[0], high[1] - low[1]);
        for (unsigned axis = 0; axis < dimension; ++axis) {
            half_spaces.push_back(normal[axis]);
            offset += normal[axis] * (low[axis] + high[axis]) / 2;
        }
        half_spaces.push_back(offset);
    }
    return half_spaces;
}

template <int sides, int percent>
void voronoi_cells_within(Context &c) {
    const auto [low, high] = c.box(0.1);
    const Points half_spaces = polygon_in(c.dimension, low, high, sides, percent);
    std::vector<double> volumes(c.n), areas(c.n), centroids(c.n * c.dimension);
    std::size_t count;
    c.meter.time([&, low = low.data(), high = high.data()] {
        must(deldrift_voronoi_cells_within(c.t, low, high, half_spaces.data(), sides, nullptr, 0, volumes.data(),
                                           areas.data(), centroids.data(), c.n, &count));
    });
    c.meter.count(double(c.n + c.cells()));
}

template <int percent>
void voronoi_derivatives(Context &c) {
    const auto [low, high] = c.box(percent / 100.0);
    counted<double>(c, 2 * c.dimension,
                    [&, low = low.data(), high = high.data()](double *to, std::size_t room, std::size_t *count) {
                        return deldrift_voronoi_derivatives(c.t, low, high, nullptr, 0, nullptr, nullptr, to, room, count);
                    });
}

template <int sides, int percent>
void voronoi_derivatives_within(Context &c) {
    const auto [low, high] = c.box(0.1);
    const Points half_spaces = polygon_in(c.dimension, low, high, sides, percent);
    counted<double>(c, 2 * c.dimension,
                    [&, low = low.data(), high = high.data()](double *to, std::size_t room, std::size_t *count) {
                        return deldrift_voronoi_derivatives_within(c.t, low, high, half_spaces.data(), sides, nullptr, 0,
                                                                   nullptr, nullptr, to, room, count);
                    });
}

template <int percent>
void voronoi_cells_and_facets(Context &c) {
    const auto [low, high] = c.box(percent / 100.0);
    std::vector<double> volumes(c.n), areas(c.n), centroids(c.n * c.dimension);
    std::size_t n_ids;
    counted<double>(c, 2 * c.dimension,
                    [&, low = low.data(), high = high.data()](double *to, std::size_t room, std::size_t *count) {
                        return deldrift_voronoi_cells_and_facets(c.t, low, high, nullptr, 0, nullptr, 0, volumes.data(),
                                                                 areas.data(), centroids.data(), c.n, &n_ids, nullptr,
                                                                 nullptr, to, room, count);
                    });
}

template <int percent>
void voronoi_weight_derivatives(Context &c) {
    const auto [low, high] = c.box(percent / 100.0);
    std::vector<double> volumes(c.n);
    std::size_t n_ids;
    counted<double>(c, 1, [&, low = low.data(), high = high.data()](double *to, std::size_t room, std::size_t *count) {
        return deldrift_voronoi_weight_derivatives(c.t, low, high, nullptr, 0, nullptr, 0, volumes.data(), c.n, &n_ids, to,
                                                   room, count);
    });
}

/// A place with natural neighbours costs what a vertex there would change: counted for some, by inserting it in a copy.
void count_natural_neighbours(Context &c, const Points &places) {
    const std::size_t count = places.size() / c.dimension, counted = std::min<std::size_t>(count, 16);
    double changed = 0;
    for (std::size_t i = 0; i < counted && c.cells() > 0; ++i) {
        deldrift_triangulation *copy;
        must(deldrift_clone(c.t, &copy));
        std::swap(c.t, copy);
        std::uint32_t v;
        const double before = double(c.cells());
        must(deldrift_insert_vertex(c.t, &places[i * (count / counted) * c.dimension], &v));
        const double created = double(c.star(v));
        changed += created + std::max(0.0, before + created - double(c.cells()));
        std::swap(c.t, copy);
        deldrift_destroy(copy);
    }
    c.meter.count(changed / double(counted) * double(count));
}

void interpolate(Context &c, deldrift_interpolation method, const Points &places) {
    const std::vector<double> values(c.n, 1.0);
    const std::size_t count = places.size() / c.dimension;
    std::vector<double> results(count);
    c.meter.time([&] {
        must(deldrift_interpolate(c.t, method, values.data(), c.n, 1, places.data(), count, nullptr, nullptr,
                                  results.data()));
    });
    c.meter.count(double(c.n + count));
    if (method == DELDRIFT_INTERPOLATION_NATURAL_NEIGHBOUR) count_natural_neighbours(c, places);
}

}  // namespace

std::vector<Call> geometry_calls() {
    return {
        {"deldrift_circumcentres", "", [](Context &c) {
             std::vector<double> centres = numbers(c, c.dimension), radii = numbers(c, 1);
             of_cells(c, [&](std::size_t n, std::size_t *count) {
                 return deldrift_circumcentres(c.t, centres.data(), radii.data(), n, count);
             });
         }},
        {"deldrift_volumes", "", [](Context &c) {
             std::vector<double> volumes = numbers(c, 1);
             of_cells(c, [&](std::size_t n, std::size_t *count) {
                 return deldrift_volumes(c.t, volumes.data(), n, count);
             });
         }},
        {"deldrift_mask_by_circumradius", "the median", [](Context &c) {
             const double radius = median_radius(c);
             std::vector<std::uint8_t> mask(c.cells() + 1);
             of_cells(c, [&](std::size_t n, std::size_t *count) {
                 return deldrift_mask_by_circumradius(c.t, radius < infinity ? radius : 1, mask.data(), n, count);
             });
         }},
        {"deldrift_mask_without_flat_cells", "a tolerance of 1e-9", [](Context &c) {
             std::vector<std::uint8_t> mask(c.cells() + 1);
             of_cells(c, [&](std::size_t n, std::size_t *count) {
                 return deldrift_mask_without_flat_cells(c.t, 1e-9, mask.data(), n, count);
             });
         }},
        {"deldrift_mask_without_flat_cells", "an infinite tolerance", [](Context &c) {
             std::vector<std::uint8_t> mask(c.cells() + 1);
             of_cells(c, [&](std::size_t n, std::size_t *count) {
                 return deldrift_mask_without_flat_cells(c.t, infinity, mask.data(), n, count);
             });
         }},
        {"deldrift_mask_boundary", "every second cell", [](Context &c) {
             std::vector<std::uint8_t> mask(c.cells() + 1);
             for (std::size_t i = 0; i < mask.size(); i += 2) mask[i] = 1;
             counted<std::uint32_t>(c, c.dimension, [&](std::uint32_t *to, std::size_t room, std::size_t *count) {
                 return deldrift_mask_boundary(c.t, mask.data(), c.cells(), to, nullptr, nullptr, room, count);
             });
         }},
        {"deldrift_hull_facets", "", [](Context &c) {
             counted<std::uint32_t>(c, c.dimension, [&](std::uint32_t *to, std::size_t room, std::size_t *count) {
                 return deldrift_hull_facets(c.t, to, nullptr, nullptr, room, count);
             });
         }},
        {"deldrift_edges", "", [](Context &c) {
             counted<std::uint32_t>(c, 2, [&](std::uint32_t *to, std::size_t room, std::size_t *count) {
                 return deldrift_edges(c.t, to, room, count);
             });
         }},
        {"deldrift_vertex_neighbours", "", [](Context &c) {
             Ids offsets(c.n + 1);
             counted<std::uint32_t>(c, 1, [&](std::uint32_t *to, std::size_t room, std::size_t *count) {
                 return deldrift_vertex_neighbours(c.t, to ? offsets.data() : nullptr, c.n + 1, to, room, count);
             });
         }},
        {"deldrift_vertex_cells", "", [](Context &c) {
             Ids offsets(c.n + 1);
             counted<std::uint32_t>(c, 1, [&](std::uint32_t *to, std::size_t room, std::size_t *count) {
                 return deldrift_vertex_cells(c.t, to ? offsets.data() : nullptr, c.n + 1, to, room, count);
             });
         }},
        {"deldrift_mirror_indices", "", [](Context &c) {
             std::vector<std::uint8_t> mirrors(c.cells() * c.corners() + 1);
             of_cells(c, [&](std::size_t n, std::size_t *count) {
                 return deldrift_mirror_indices(c.t, mirrors.data(), n, count);
             });
         }},
        {"deldrift_mirror_index", "one facet of each cell", [](Context &c) {
             std::uint32_t mirror;
             const auto n = std::uint32_t(c.cells());
             c.meter.time([&] {
                 for (std::uint32_t cell = 0; cell < n; ++cell) must(deldrift_mirror_index(c.t, cell, cell % 3, &mirror));
             }, n + 1);
             c.meter.count(double(c.n + n));
         }},
        {"deldrift_cells_around", "all vertices, one by one", [](Context &c) {
             Ids room(c.cells() + 1);
             std::size_t count;
             for (std::uint32_t v = 0; v < c.n; ++v) {
                 c.meter.time([&] { must(deldrift_cells_around(c.t, &v, 1, room.data(), room.size(), &count)); });
                 c.meter.count(1 + double(count));
             }
         }},
        {"deldrift_cells_around", "all vertices", [](Context &c) {
             const Ids ids = all_vertices(c);
             Ids room(c.cells() + 1);
             of_cells(c, [&](std::size_t, std::size_t *count) {
                 return deldrift_cells_around(c.t, ids.data(), ids.size(), room.data(), room.size(), count);
             });
         }},
        {"deldrift_cells_around", "one vertex, as often as there are vertices", [](Context &c) {
             const Ids ids(c.n, 0);
             Ids room(c.cells() + 1);
             std::size_t count;
             c.meter.time([&] {
                 must(deldrift_cells_around(c.t, ids.data(), ids.size(), room.data(), room.size(), &count));
             });
             c.meter.count(double(c.n + count));
         }},
        {"deldrift_update_circumcentres", "all", [](Context &c) {
             std::vector<double> centres = numbers(c, c.dimension), radii = numbers(c, 1);
             const Ids cells = all_cells(c);
             of_cells(c, [&](std::size_t n, std::size_t *) {
                 return deldrift_update_circumcentres(c.t, cells.data(), n, centres.data(), radii.data(), n);
             });
         }},
        {"deldrift_update_volumes", "all", [](Context &c) {
             std::vector<double> volumes = numbers(c, 1);
             const Ids cells = all_cells(c);
             of_cells(c, [&](std::size_t n, std::size_t *) {
                 return deldrift_update_volumes(c.t, cells.data(), n, volumes.data(), n);
             });
         }},
        {"deldrift_update_mask_by_circumradius", "all", [](Context &c) {
             std::vector<std::uint8_t> mask(c.cells() + 1);
             const Ids cells = all_cells(c);
             of_cells(c, [&](std::size_t n, std::size_t *) {
                 return deldrift_update_mask_by_circumradius(c.t, cells.data(), n, 1, mask.data(), n);
             });
         }},
        {"deldrift_voronoi_volumes", "without a box", [](Context &c) {
             std::vector<double> volumes(c.n);
             std::size_t count;
             c.meter.time([&] {
                 must(deldrift_voronoi_volumes(c.t, nullptr, nullptr, volumes.data(), c.n, &count));
             });
             c.meter.count(double(c.n + c.cells()));
         }},
        {"deldrift_voronoi_volumes", "in a box around all", voronoi_volumes<10>},
        {"deldrift_voronoi_volumes", "in a box inside", voronoi_volumes<-20>},
        {"deldrift_create_periodic", "in a box around all", [](Context &c) {
             make_periodic(c);
         }},
        {"deldrift_create_periodic_weighted", "in a box around all", [](Context &c) {
             const std::vector<double> box = make_periodic(c);
             deldrift_destroy(c.t);
             c.t = nullptr;
             const deldrift_options options = c.options();
             const double square = std::pow(box[0], 2) * std::pow(double(c.n), -2.0 / c.dimension);
             std::vector<double> weights(c.n);
             for (std::size_t v = 0; v < c.n; ++v) weights[v] = 0.1 * square * double(v * 7919 % 1000) / 1000;
             c.meter.reset();
             c.meter.time([&] {
                 must(deldrift_create_periodic_weighted(c.dimension, c.points.data(), weights.data(), c.n, box.data(),
                                                        c.dimension, &options, &c.t));
             });
             c.meter.count(double(c.n + c.cells()));
         }},
        {"deldrift_stage_vectors", "of a periodic one", [](Context &c) {
             const std::vector<double> box = make_periodic(c);
             c.meter.reset();
             c.meter.time([&] { must(deldrift_stage_vectors(c.t, box.data(), c.dimension)); });
             c.meter.count(1);
         }},
        {"deldrift_vectors", "of a periodic one", [](Context &c) {
             std::vector<double> box = make_periodic(c);
             std::size_t count;
             c.meter.reset();
             c.meter.time([&] { must(deldrift_vectors(c.t, box.data(), c.dimension, &count)); });
             c.meter.count(1);
         }},
        {"deldrift_reduced_vectors", "of a periodic one", [](Context &c) {
             std::vector<double> box = make_periodic(c);
             std::size_t count;
             c.meter.reset();
             c.meter.time([&] {
                 must(deldrift_reduced_vectors(c.t, box.data(), nullptr, nullptr, c.dimension, &count));
             });
             c.meter.count(1);
         }},
        {"deldrift_wrap_positions", "of a periodic one", [](Context &c) {
             make_periodic(c);
             std::vector<double> places(c.n * c.dimension + 1);
             std::vector<std::int64_t> shifts(c.n * c.dimension + 1);
             c.meter.reset();
             c.meter.time([&] {
                 must(deldrift_wrap_positions(c.t, c.points.data(), nullptr, c.n, places.data(), shifts.data()));
             });
             c.meter.count(double(c.n));
         }},
        {"deldrift_cell_shifts", "of a periodic one", [](Context &c) {
             make_periodic(c);
             std::vector<std::int64_t> shifts(c.cells() * 12 + 1);
             std::size_t count;
             c.meter.reset();
             c.meter.time([&] { must(deldrift_cell_shifts(c.t, shifts.data(), nullptr, c.cells(), &count)); });
             c.meter.count(double(c.n + count));
         }},
        {"deldrift_locate_in_period", "anywhere in a periodic one", [](Context &c) {
             make_periodic(c);
             const Points p = c.many(c.n, &Context::anywhere);
             std::vector<deldrift_location> locations(c.n + 1);
             std::vector<std::int64_t> shifts(c.n * c.dimension + 1);
             c.meter.reset();
             c.meter.time([&] {
                 must(deldrift_locate_in_period(c.t, p.data(), c.n, nullptr, locations.data(), shifts.data()));
             });
             c.meter.count(double(c.n));
         }},
        {"deldrift_edge_shifts", "of a periodic one", [](Context &c) {
             make_periodic(c);
             c.meter.reset();
             counted<std::int64_t>(c, c.dimension, [&](std::int64_t *to, std::size_t room, std::size_t *count) {
                 return deldrift_edge_shifts(c.t, to, room, count);
             });
         }},
        {"deldrift_voronoi_facets", "without a box", [](Context &c) {
             counted<double>(c, 1, [&](double *to, std::size_t room, std::size_t *count) {
                 return deldrift_voronoi_facets(c.t, nullptr, nullptr, to, room, count);
             });
         }},
        {"deldrift_voronoi_facets", "in a box around all", voronoi_facets<10>},
        {"deldrift_voronoi_facets", "in a box inside", voronoi_facets<-20>},
        {"deldrift_voronoi_cells", "in a box around all", voronoi_cells<10>},
        {"deldrift_voronoi_cells", "in a box inside", voronoi_cells<-20>},
        {"deldrift_voronoi_cells_within", "of 64 half-spaces, that contain all", voronoi_cells_within<64, 60>},
        {"deldrift_voronoi_cells_within", "of 64 half-spaces, that cut", voronoi_cells_within<64, 25>},
        {"deldrift_voronoi_derivatives_within", "of 64 half-spaces, that cut", voronoi_derivatives_within<64, 25>},
        {"deldrift_voronoi_changed", "one vertex, as often as there are vertices", [](Context &c) {
             deldrift_changes changes;
             must(deldrift_take_changes(c.t, &changes));
             must(deldrift_take_changes(c.t, &changes));
             const Ids ids(c.n, c.some_vertex(0));
             std::vector<std::uint8_t> mask(c.n);
             std::size_t count;
             c.meter.time([&] {
                 must(deldrift_voronoi_changed(c.t, ids.data(), ids.size(), mask.data(), mask.size(), &count));
             });
             c.meter.count(double(c.n + c.cells()));
         }},
        {"deldrift_voronoi_derivatives", "in a box around all", voronoi_derivatives<10>},
        {"deldrift_voronoi_derivatives", "in a box inside", voronoi_derivatives<-20>},
        {"deldrift_voronoi_weight_derivatives", "in a box around all", voronoi_weight_derivatives<10>},
        {"deldrift_voronoi_cells_and_facets", "in a box around all", voronoi_cells_and_facets<10>},
        {"deldrift_interpolate", "linear, anywhere, as many places as vertices", [](Context &c) {
             interpolate(c, DELDRIFT_INTERPOLATION_LINEAR, c.many(c.n, &Context::anywhere));
         }},
        {"deldrift_interpolate", "natural neighbours, anywhere, for one vertex in eight", [](Context &c) {
             interpolate(c, DELDRIFT_INTERPOLATION_NATURAL_NEIGHBOUR, c.many(c.some(), &Context::anywhere));
         }},
        {"deldrift_interpolate", "natural neighbours, at vertices, for one in eight", [](Context &c) {
             interpolate(c, DELDRIFT_INTERPOLATION_NATURAL_NEIGHBOUR, c.many(c.some(), &Context::elsewhere));
         }},
        {"deldrift_barycentric", "near vertices, in a cell of each", [](Context &c) {
             Ids cells(c.n);
             std::size_t count;
             must(deldrift_cell_of_each_vertex(c.t, cells.data(), c.n, &count));
             const Points p = c.all_nearby();
             std::vector<double> weights(c.n * c.corners());
             c.meter.time([&] { must(deldrift_barycentric(c.t, p.data(), cells.data(), c.n, weights.data())); });
             c.meter.count(double(c.n));
         }},
        {"deldrift_in_sphere", "on it", [](Context &c) {
             std::int32_t sign;
             Points p(c.dimension, 0.0);
             for (std::size_t i = 0; i <= c.dimension; ++i)
                 for (std::size_t k = 0; k < c.dimension; ++k) p.push_back(i == k || i == c.dimension ? 1.0 / 3 : 0.0);
             c.meter.time([&] {
                 for (std::size_t i = 0; i < c.n; ++i) must(deldrift_in_sphere(c.dimension, p.data(), &sign));
             }, c.n);
             c.meter.count(double(c.n));
         }},
        {"deldrift_in_power_sphere", "on it", [](Context &c) {
             std::int32_t sign;
             Points p(c.dimension, 0.0), weights(c.dimension + 2, 0.0);
             for (std::size_t i = 0; i <= c.dimension; ++i)
                 for (std::size_t k = 0; k < c.dimension; ++k) p.push_back(i == k ? 1.0 : i == c.dimension ? 2.0 : 0.0);
             // The power circle through 0 and the units has its centre at the halves: 2 of each is d (9 - 1) / 4 more away.
             weights.back() = 2.0 * double(c.dimension);
             c.meter.time([&] {
                 for (std::size_t i = 0; i < c.n; ++i)
                     must(deldrift_in_power_sphere(c.dimension, p.data(), weights.data(), &sign));
             }, c.n);
             c.meter.count(double(c.n));
         }},
        {"deldrift_orientation", "nearly flat", [](Context &c) {
             std::int32_t sign;
             Points p;
             for (std::size_t i = 0; i <= c.dimension; ++i) Context::append(p, Points(c.dimension, double(i) / 3));
             c.meter.time([&] {
                 for (std::size_t i = 0; i < c.n; ++i) must(deldrift_orientation(c.dimension, p.data(), &sign));
             }, c.n);
             c.meter.count(double(c.n));
         }},
    };
}

}  // namespace costs
