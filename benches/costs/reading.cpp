// Calls that read what there is: states, cells, stars, places.
#include "measure.hpp"

namespace costs {
namespace {

/// A call in constant time, as often as there are vertices.
template <typename One>
void for_all(Context &c, One one) {
    c.meter.time([&] {
        for (std::uint32_t v = 0; v < c.n; ++v) one(v);
    }, c.n);
    c.meter.count(double(c.n));
}

/// A call that fills an array of `length` numbers; its input or output has `units` vertices and cells.
template <typename Number, typename One>
void fill(Context &c, std::size_t length, double units, One one) {
    std::vector<Number> room(std::max<std::size_t>(1, length));
    std::size_t count;
    c.meter.time([&] { must(one(room.data(), &count)); });
    c.meter.count(units);
}

/// Lists within a radius for which each vertex has so many neighbours, or within that of each.
void neighbour_lists(Context &c, double squared_radius) {
    Points own;
    for (std::uint32_t v = 0; v < c.n; ++v) own.push_back(c.spacing[v] * c.spacing[v]);
    const bool is_each = squared_radius < 0;
    std::vector<std::size_t> offsets(c.n + 1);
    std::size_t count = 0;
    const auto list = [&](Ids &into) {
        return deldrift_neighbour_lists(c.t, is_each ? own.data() : &squared_radius, is_each ? c.n : 1, nullptr, 0,
                                        DELDRIFT_PAIRS_FULL, offsets.data(), offsets.size(),
                                        into.empty() ? nullptr : into.data(), nullptr, into.size(), &count);
    };
    Ids found;
    must(list(found));
    found.resize(count);
    c.meter.time([&] { must(list(found)); });
    c.meter.count(double(c.n + count));
}

/// All changed by the same: one vertex after the other relocated, and `read` timed after each.
template <typename Read>
void after_relocations(Context &c, Read read) {
    for (std::size_t i = 0; i < c.some(); ++i) {
        const std::uint32_t v = c.some_vertex(i);
        const double before = double(c.star(v));
        must(deldrift_relocate_vertex(c.t, v, c.elsewhere().data()));
        c.meter.time([&] { read(v); });
        c.meter.count(1 + before + double(c.star(v)));
    }
}

template <std::uint32_t level>
void validate(Context &c) {
    c.meter.time([&] { must(deldrift_validate(c.t, level)); });
    c.meter.count(double(c.n + c.cells()));
}

void locate_points(Context &c, const Points &p) {
    std::vector<deldrift_location> locations(p.size() / c.dimension);
    c.meter.time([&] {
        must(deldrift_locate_points(c.t, p.data(), locations.size(), nullptr, locations.data()));
    });
    c.meter.count(double(locations.size()));
}

void nearest_vertices(Context &c, const Points &p) {
    constexpr std::size_t k = 8;
    const std::size_t count = p.size() / c.dimension;
    Ids found(count * k);
    c.meter.time([&] { must(deldrift_nearest_vertices(c.t, p.data(), count, k, found.data())); });
    // What is read are the stars of those that are found.
    double stars = 0;
    for (const std::uint32_t v : found)
        if (v != DELDRIFT_NONE) stars += double(c.star(v));
    c.meter.count(double(count) + stars);
}

/// A call about the neighbourhood of one vertex in eight, which finds few vertices; what is read are their stars.
template <typename One>
void in_parts(Context &c, One one) {
    Ids room(c.n);
    for (std::size_t i = 0; i < c.some(); ++i) {
        std::size_t count;
        c.meter.time([&] { must(one(c.some_vertex(i), room.data(), &count)); });
        double stars = 1;
        for (std::size_t k = 0; k < count; ++k) stars += double(c.star(room[k]));
        c.meter.count(stars);
    }
}

}  // namespace

std::vector<Call> reading_calls() {
    return {
        {"deldrift_status_string", "",
         [](Context &c) { for_all(c, [&](std::uint32_t v) { deldrift_status_string(deldrift_status(v % 30)); }); }},
        {"deldrift_last_error", "after a call that failed", [](Context &c) {
             for_all(c, [&](std::uint32_t) {
                 double p[3];
                 deldrift_position(c.t, DELDRIFT_NONE, p);
                 deldrift_last_error();
             });
         }},
        {"deldrift_version", "", [](Context &c) { for_all(c, [&](std::uint32_t) { deldrift_version(); }); }},
        {"deldrift_options_init", "", [](Context &c) {
             deldrift_options options;
             for_all(c, [&](std::uint32_t) { deldrift_options_init(&options); });
         }},
        {"deldrift_dimension", "", [](Context &c) {
             std::uint32_t dimension;
             for_all(c, [&](std::uint32_t) { must(deldrift_dimension(c.t, &dimension)); });
         }},
        {"deldrift_get_algorithm", "", [](Context &c) {
             deldrift_algorithm algorithm;
             for_all(c, [&](std::uint32_t) { must(deldrift_get_algorithm(c.t, &algorithm)); });
         }},
        {"deldrift_vertex_count", "", [](Context &c) {
             std::size_t count;
             for_all(c, [&](std::uint32_t) { must(deldrift_vertex_count(c.t, &count)); });
         }},
        {"deldrift_id_count", "", [](Context &c) {
             std::size_t count;
             for_all(c, [&](std::uint32_t) { must(deldrift_id_count(c.t, &count)); });
         }},
        {"deldrift_cell_count", "",
         [](Context &c) { for_all(c, [&](std::uint32_t) { c.cells(); }); }},
        {"deldrift_staged_count", "all are staged", [](Context &c) {
             std::size_t count;
             must(deldrift_move_vertices(c.t, nullptr, c.points.data(), c.n));
             for_all(c, [&](std::uint32_t) { must(deldrift_staged_count(c.t, &count)); });
         }},
        {"deldrift_memory_bytes", "", [](Context &c) {
             std::size_t bytes;
             for_all(c, [&](std::uint32_t) { must(deldrift_memory_bytes(c.t, &bytes)); });
         }},
        {"deldrift_timestamp", "", [](Context &c) {
             std::uint64_t timestamp;
             for_all(c, [&](std::uint32_t) { must(deldrift_timestamp(c.t, &timestamp)); });
         }},
        {"deldrift_statistics", "", [](Context &c) {
             deldrift_commit_report report;
             for_all(c, [&](std::uint32_t) { must(deldrift_statistics(c.t, &report)); });
         }},
        {"deldrift_research_within_safe_region", "", [](Context &c) {
             std::uint64_t count;
             for_all(c, [&](std::uint32_t) { must(deldrift_research_within_safe_region(c.t, &count)); });
         }},
        {"deldrift_is_present", "all", [](Context &c) {
             bool present;
             for_all(c, [&](std::uint32_t v) { must(deldrift_is_present(c.t, v, &present)); });
         }},
        {"deldrift_position", "all", [](Context &c) {
             double p[3];
             for_all(c, [&](std::uint32_t v) { must(deldrift_position(c.t, v, p)); });
         }},
        {"deldrift_coincident_representative", "all", [](Context &c) {
             std::uint32_t r;
             for_all(c, [&](std::uint32_t v) { must(deldrift_coincident_representative(c.t, v, &r)); });
         }},
        {"deldrift_copy_positions", "", [](Context &c) {
             fill<double>(c, c.n * c.dimension, double(c.n), [&](double *to, std::size_t *count) {
                 return deldrift_copy_positions(c.t, to, c.n, count);
             });
         }},
        {"deldrift_cells", "the first", [](Context &c) {
             deldrift_destroy(c.t);
             c.t = c.create(c.options());
             c.meter.reset();
             deldrift_cells_view view;
             c.meter.time([&] { must(deldrift_cells(c.t, &view)); });
             c.meter.count(double(c.n + view.count));
         }},
        {"deldrift_cells", "nothing has changed, as often as there are vertices",
         [](Context &c) { for_all(c, [&](std::uint32_t) { c.view(); }); }},
        {"deldrift_cells", "after each of some relocations",
         [](Context &c) { after_relocations(c, [&](std::uint32_t) { c.view(); }); }},
        {"deldrift_cells", "after all have moved far away", [](Context &c) {
             const double before = double(c.cells());
             must(deldrift_commit_positions(c.t, c.many(c.n, &Context::elsewhere).data(), c.n, nullptr));
             c.meter.reset();
             c.meter.time([&] { c.view(); });
             c.meter.count(before + double(c.n + c.cells()));
         }},
        {"deldrift_release_cells", "", [](Context &c) {
             deldrift_cells_view view;
             deldrift_released_cells *owner = nullptr;
             must(deldrift_cells(c.t, &view));
             c.meter.time([&] { must(deldrift_release_cells(c.t, &view, &owner)); });
             c.meter.count(double(view.count));
             deldrift_free_cells(owner);
         }},
        {"deldrift_free_cells", "", [](Context &c) {
             deldrift_cells_view view;
             deldrift_released_cells *owner = nullptr;
             must(deldrift_release_cells(c.t, &view, &owner));
             c.meter.time([&] { deldrift_free_cells(owner); });
             c.meter.count(double(view.count));
         }},
        {"deldrift_copy_cells", "", [](Context &c) {
             const std::size_t n = c.cells();
             Ids vertices(n * c.corners() + 1), neighbours(n * c.corners() + 1);
             std::size_t count;
             c.meter.time([&] { must(deldrift_copy_cells(c.t, vertices.data(), neighbours.data(), n, &count)); });
             c.meter.count(double(c.n + n));
         }},
        {"deldrift_star", "all", [](Context &c) {
             const std::size_t n = c.cells();
             Ids room(n + 1);
             std::size_t count;
             for_all(c, [&](std::uint32_t v) {
                 must(deldrift_star(c.t, v, room.data(), n, &count));
                 c.meter.count(double(count));
             });
         }},
        {"deldrift_star", "after each of some relocations", [](Context &c) {
             after_relocations(c, [&](std::uint32_t v) { c.star(v); });
         }},
        {"deldrift_ordered_star", "all", [](Context &c) {
             const std::size_t n = c.cells();
             Ids room(n + 1);
             std::size_t count;
             for_all(c, [&](std::uint32_t v) {
                 must(deldrift_ordered_star(c.t, v, room.data(), n, &count));
                 c.meter.count(double(count));
             });
         }, 2},
        {"deldrift_tolerance", "all", [](Context &c) {
             double tolerance;
             for_all(c, [&](std::uint32_t v) { must(deldrift_tolerance(c.t, v, &tolerance)); });
             c.meter.count(double(c.cells()));
         }},
        {"deldrift_research_annulus_widths", "", [](Context &c) {
             const std::size_t n = c.cells() * c.corners();
             fill<double>(c, n, double(c.n + c.cells()), [&](double *to, std::size_t *count) {
                 return deldrift_research_annulus_widths(c.t, to, n, count);
             });
         }},
        {"deldrift_research_standard_delimiter", "one facet of each cell", [](Context &c) {
             double centre[3], radius, tolerance;
             const auto n = std::uint32_t(c.cells());
             c.meter.time([&] {
                 for (std::uint32_t cell = 0; cell < n; ++cell)
                     deldrift_research_standard_delimiter(c.t, cell, cell % 3, centre, &radius, &tolerance);
             }, n + 1);
             c.meter.count(double(c.n + n));
         }},
        {"deldrift_locate", "anywhere, as many places as vertices", [](Context &c) {
             deldrift_location location;
             const Points p = c.many(c.n, &Context::anywhere);
             for_all(c, [&](std::uint32_t v) { must(deldrift_locate(c.t, &p[v * c.dimension], &location)); });
         }},
        {"deldrift_locate", "at vertices", [](Context &c) {
             deldrift_location location;
             for_all(c, [&](std::uint32_t v) { must(deldrift_locate(c.t, c.place(v), &location)); });
         }},
        {"deldrift_locate", "outside", [](Context &c) {
             deldrift_location location;
             for_all(c, [&](std::uint32_t v) {
                 Points p(c.place(v), c.place(v) + c.dimension);
                 for (double &x : p) x = 3 * x + 5;
                 must(deldrift_locate(c.t, p.data(), &location));
             });
         }},
        {"deldrift_locate_points", "anywhere", [](Context &c) { locate_points(c, c.many(c.n, &Context::anywhere)); }},
        {"deldrift_locate_points", "near vertices, by id", [](Context &c) { locate_points(c, c.all_nearby()); }},
        {"deldrift_nearest_vertex", "anywhere, as many places as vertices", [](Context &c) {
             std::uint32_t nearest;
             const Points p = c.many(c.n, &Context::anywhere);
             for_all(c, [&](std::uint32_t v) { must(deldrift_nearest_vertex(c.t, &p[v * c.dimension], &nearest)); });
         }},
        {"deldrift_nearest_vertex", "near vertices", [](Context &c) {
             std::uint32_t nearest;
             const Points p = c.all_nearby();
             for_all(c, [&](std::uint32_t v) { must(deldrift_nearest_vertex(c.t, &p[v * c.dimension], &nearest)); });
         }},
        {"deldrift_nearest_vertex", "outside", [](Context &c) {
             std::uint32_t nearest;
             for_all(c, [&](std::uint32_t v) {
                 Points p(c.place(v), c.place(v) + c.dimension);
                 for (double &x : p) x = 3 * x + 5;
                 must(deldrift_nearest_vertex(c.t, p.data(), &nearest));
             });
         }},
        {"deldrift_hidden_vertices", "", [](Context &c) {
             std::size_t n;
             must(deldrift_hidden_vertices(c.t, nullptr, nullptr, 0, &n));
             Ids vertices(n + 1), representatives(n + 1);
             c.meter.time([&] {
                 must(deldrift_hidden_vertices(c.t, vertices.data(), representatives.data(), n, &n));
             });
             c.meter.count(double(c.n));
         }},
        {"deldrift_cell_of_each_vertex", "", [](Context &c) {
             fill<std::uint32_t>(c, c.n, double(c.n), [&](std::uint32_t *to, std::size_t *count) {
                 return deldrift_cell_of_each_vertex(c.t, to, c.n, count);
             });
         }},
        {"deldrift_nearest_vertices", "8 of places anywhere, as many as vertices",
         [](Context &c) { nearest_vertices(c, c.many(c.n, &Context::anywhere)); }},
        {"deldrift_nearest_vertices", "8 near vertices, by id",
         [](Context &c) { nearest_vertices(c, c.all_nearby()); }},
        {"deldrift_vertices_in_ball", "to the next vertex, for one vertex in eight", [](Context &c) {
             in_parts(c, [&](std::uint32_t v, std::uint32_t *to, std::size_t *count) {
                 return deldrift_vertices_in_ball(c.t, c.place(v), c.spacing[v] * c.spacing[v], to, c.n, count);
             });
         }},
        {"deldrift_neighbour_lists", "to the next vertex, each its own", [](Context &c) { neighbour_lists(c, -1); }},
        {"deldrift_neighbour_lists", "to the next vertex of the first", [](Context &c) {
             neighbour_lists(c, c.spacing[0] * c.spacing[0]);
         }},
        {"deldrift_vertices_in_ball", "around all", [](Context &c) {
             fill<std::uint32_t>(c, c.n, double(c.n), [&](std::uint32_t *to, std::size_t *count) {
                 return deldrift_vertices_in_ball(c.t, c.points.data(), 1e300, to, c.n, count);
             });
         }},
        {"deldrift_vertices_in_box", "to the next vertex, for one vertex in eight", [](Context &c) {
             in_parts(c, [&](std::uint32_t v, std::uint32_t *to, std::size_t *count) {
                 Points low(c.place(v), c.place(v) + c.dimension), high(low);
                 for (unsigned k = 0; k < c.dimension; ++k) low[k] -= c.spacing[v], high[k] += c.spacing[v];
                 return deldrift_vertices_in_box(c.t, low.data(), high.data(), to, c.n, count);
             });
         }},
        {"deldrift_vertices_in_box", "all but the outermost", [](Context &c) {
             const auto [low, high] = c.box(-0.01);
             Ids room(c.n);
             std::size_t count;
             c.meter.time([&, low = low.data(), high = high.data()] {
                 must(deldrift_vertices_in_box(c.t, low, high, room.data(), c.n, &count));
             });
             c.meter.count(double(c.n));
         }},
        {"deldrift_cells_in_reach", "of boxes to the next vertex, for one vertex in eight", [](Context &c) {
             Ids room(c.cells() + 1);
             for (std::size_t i = 0; i < c.some(); ++i) {
                 const std::uint32_t v = c.some_vertex(i);
                 Points low(c.place(v), c.place(v) + c.dimension), high(low);
                 for (unsigned k = 0; k < c.dimension; ++k) low[k] -= c.spacing[v], high[k] += c.spacing[v];
                 std::size_t count, facets;
                 c.meter.time([&] {
                     must(deldrift_cells_in_reach(c.t, low.data(), high.data(), 1, nullptr, 0, room.data(), nullptr,
                                                  nullptr, room.size(), &count));
                 });
                 must(deldrift_hull_facets_in_reach(c.t, low.data(), high.data(), 1, nullptr, 0, nullptr, nullptr, 0,
                                                    &facets));
                 c.meter.count(1 + double(count + facets));
             }
         }},
        {"deldrift_cells_in_reach", "of everything, with balls", [](Context &c) {
             const auto [low, high] = c.box(1);
             Ids room(c.cells() + 1);
             Points centres(room.size() * c.dimension), radii(room.size());
             std::size_t count;
             c.meter.time([&, low = low.data(), high = high.data()] {
                 must(deldrift_cells_in_reach(c.t, low, high, 1, nullptr, 0, room.data(), centres.data(), radii.data(),
                                              room.size(), &count));
             });
             c.meter.count(double(c.n + c.cells()));
         }},
        {"deldrift_hull_facets_in_reach", "of everything", [](Context &c) {
             const auto [low, high] = c.box(1);
             Ids room(c.cells() * (c.dimension + 1) + 1);
             std::size_t count;
             c.meter.time([&, low = low.data(), high = high.data()] {
                 must(deldrift_hull_facets_in_reach(c.t, low, high, 1, nullptr, 0, room.data(), nullptr, room.size(),
                                                    &count));
             });
             c.meter.count(double(c.n + c.cells()));
         }},
        {"deldrift_vertices_in_reach", "of everything", [](Context &c) {
             const auto [low, high] = c.box(1);
             Ids room(c.n);
             std::size_t count, offsets[2];
             c.meter.time([&, low = low.data(), high = high.data()] {
                 must(deldrift_vertices_in_reach(c.t, low, high, 1, nullptr, 0, room.data(), offsets, c.n, &count));
             });
             c.meter.count(double(c.n + c.cells()));
         }},
        {"deldrift_conflicts", "near vertices, for one in eight", [](Context &c) {
             Ids room(c.cells() + 1);
             for (std::size_t i = 0; i < c.some(); ++i) {
                 const Points p = c.nearby(c.some_vertex(i));
                 std::size_t count;
                 c.meter.time([&] {
                     must(deldrift_conflicts(c.t, p.data(), nullptr, room.data(), room.size(), &count));
                 });
                 c.meter.count(1 + double(count));
             }
         }},
        {"deldrift_find_simplices", "edges, one vertex in eight and the next one, one by one", [](Context &c) {
             for (std::size_t i = 0; i < c.some(); ++i) {
                 const std::uint32_t edge[2] = {c.some_vertex(i), (c.some_vertex(i) + 1) % std::uint32_t(c.n)};
                 std::uint32_t cell;
                 c.meter.time([&] { must(deldrift_find_simplices(c.t, 2, edge, 1, &cell)); });
                 c.meter.count(1 + double(std::min(c.star(edge[0]), c.star(edge[1]))));
             }
         }},
        {"deldrift_find_simplices", "edges, all vertices and the next ones", [](Context &c) {
             Ids edges, cells(c.n);
             for (std::uint32_t v = 0; v < c.n; ++v) edges.insert(edges.end(), {v, (v + 1) % std::uint32_t(c.n)});
             double least = 0;
             for (std::uint32_t v = 0; v < c.n; ++v) least += double(std::min(c.star(v), c.star(edges[2 * v + 1])));
             c.meter.time([&] { must(deldrift_find_simplices(c.t, 2, edges.data(), c.n, cells.data())); });
             c.meter.count(double(c.n + c.cells()) + least);
         }},
        {"deldrift_validate", "level 1", validate<1>},
        {"deldrift_validate", "level 2", validate<2>},
        {"deldrift_validate", "level 3", validate<3>},
    };
}

}  // namespace costs
