// Calls about segments, and about what they divide the plane into.
#include "measure.hpp"

namespace costs {
namespace {

/// One in eight of the edges, which are no conflicts.
Ids some_edges(const Context &c) {
    std::size_t count;
    must(deldrift_edges(c.t, nullptr, 0, &count));
    Ids edges(2 * count + 2), some;
    must(deldrift_edges(c.t, edges.data(), count, &count));
    for (std::size_t k = 0; k < count; k += 8) some.insert(some.end(), {edges[2 * k], edges[2 * k + 1]});
    return some;
}

void stage(const Context &c, const Ids &ends) {
    std::uint32_t first;
    must(deldrift_stage_segments(c.t, ends.data(), nullptr, ends.size() / 2, &first));
}

/// How many segments there are then.
std::size_t lay(Context &c) {
    const Ids ends = some_edges(c);
    stage(c, ends);
    must(deldrift_commit_timestamp(c.t, nullptr));
    c.view();
    c.meter.reset();
    return ends.size() / 2;
}

/// The hull becomes segments, where these do not conflict.
void bound(Context &c) {
    std::size_t count;
    must(deldrift_hull_facets(c.t, nullptr, nullptr, nullptr, 0, &count));
    Ids ends(2 * count + 2);
    must(deldrift_hull_facets(c.t, ends.data(), nullptr, nullptr, count, &count));
    ends.resize(2 * count);
    stage(c, ends);
    must(deldrift_commit_timestamp(c.t, nullptr));
    c.view();
    c.meter.reset();
}

/// With as many new vertices as there are others, at most.
deldrift_quality quality_of(const Context &c) {
    deldrift_quality quality;
    must(deldrift_quality_init(&quality));
    quality.least_angle = 20;
    quality.limit = c.n;
    quality.has_weights = 1;
    return quality;
}

/// A call that fills rows of so many numbers, one for each cell or segment, where there are segments.
template <std::size_t per_entry, typename Number, typename One>
void fill(Context &c, std::size_t entries, One one) {
    std::vector<Number> room(per_entry * entries + 1);
    std::size_t count;
    c.meter.time([&] { must(one(room.data(), entries, &count)); });
    c.meter.count(double(c.n + c.cells()));
}

Ids all(std::size_t count) {
    Ids ids(count);
    for (std::size_t k = 0; k < count; ++k) ids[k] = std::uint32_t(count - 1 - k);
    return ids;
}

}  // namespace

std::vector<Call> segment_calls() {
    return {
        {"deldrift_stage_segments", "one edge in eight", [](Context &c) {
             const Ids ends = some_edges(c);
             c.meter.time([&] { stage(c, ends); });
             c.meter.count(double(c.n));
         }, 2},
        {"deldrift_stage_segment_removals", "all of one edge in eight", [](Context &c) {
             const Ids segments = all(lay(c));
             c.meter.time([&] { must(deldrift_stage_segment_removals(c.t, segments.data(), segments.size())); });
             c.meter.count(double(segments.size()));
         }, 2},
        {"deldrift_commit_timestamp", "one edge in eight becomes a segment", [](Context &c) {
             stage(c, some_edges(c));
             c.meter.time([&] { must(deldrift_commit_timestamp(c.t, nullptr)); });
             c.meter.count(double(c.n + c.cells()));
         }, 2},
        {"deldrift_check_staged", "all nearby, with one edge in eight a segment", [](Context &c) {
             lay(c);
             must(deldrift_move_vertices(c.t, nullptr, c.all_nearby().data(), c.n));
             // Segments may cross where vertices are in lines.
             c.meter.time([&] { deldrift_check_staged(c.t); });
             c.meter.count(double(c.n + 2 * c.cells()));
         }, 2},
        {"deldrift_stage_splits", "a segment from one vertex in eight to the next crosses others", [](Context &c) {
             lay(c);
             Ids ends;
             for (std::size_t i = 0; i + 1 < c.some(); i += 2) ends.insert(ends.end(), {c.some_vertex(i), c.some_vertex(i + 1)});
             stage(c, ends);
             // Ends may be at one place.
             deldrift_split_report report{};
             c.meter.time([&] { deldrift_stage_splits(c.t, 8 * c.n, &report); });
             c.meter.count(double(c.n + 2 * c.cells() + report.pieces));
         }, 2},
        {"deldrift_segment_conflicts", "one vertex in eight is both ends of a segment", [](Context &c) {
             Ids ends;
             for (std::size_t i = 0; i < c.some(); ++i) ends.insert(ends.end(), 2, c.some_vertex(i));
             stage(c, ends);
             deldrift_check_staged(c.t);
             c.meter.reset();
             std::vector<deldrift_conflict> conflicts(c.some());
             std::size_t count;
             c.meter.time([&] { must(deldrift_segment_conflicts(c.t, conflicts.data(), conflicts.size(), &count)); });
             c.meter.count(double(count));
         }, 2},
        {"deldrift_check_passings", "all nearby, with one edge in eight a segment", [](Context &c) {
             lay(c);
             must(deldrift_move_vertices(c.t, nullptr, c.all_nearby().data(), c.n));
             // Some may pass.
             c.meter.time([&] { deldrift_check_passings(c.t); });
             c.meter.count(double(c.n));
         }, 2},
        {"deldrift_passings", "all change places, with one edge in eight a segment", [](Context &c) {
             lay(c);
             Points places = c.all_nearby();
             std::rotate(places.begin(), places.begin() + 2, places.end());
             must(deldrift_move_vertices(c.t, nullptr, places.data(), c.n));
             deldrift_check_passings(c.t);
             std::size_t count;
             must(deldrift_passings(c.t, nullptr, nullptr, 0, &count));
             Ids segments(count), vertices(count);
             c.meter.reset();
             c.meter.time([&] { must(deldrift_passings(c.t, segments.data(), vertices.data(), count, &count)); });
             c.meter.count(double(count));
         }, 2},
        {"deldrift_segments", "one edge in eight", [](Context &c) {
             fill<2, std::uint32_t>(c, lay(c), [&](std::uint32_t *to, std::size_t room, std::size_t *count) {
                 return deldrift_segments(c.t, nullptr, to, nullptr, room, count);
             });
         }, 2},
        {"deldrift_cells_of_segments", "one edge in eight", [](Context &c) {
             fill<2, std::uint32_t>(c, lay(c), [&](std::uint32_t *to, std::size_t room, std::size_t *count) {
                 return deldrift_cells_of_segments(c.t, to, room, count);
             });
         }, 2},
        {"deldrift_segments_of_cells", "one edge in eight", [](Context &c) {
             lay(c);
             fill<3, std::uint32_t>(c, c.cells(), [&](std::uint32_t *to, std::size_t room, std::size_t *count) {
                 return deldrift_segments_of_cells(c.t, to, room, count);
             });
         }, 2},
        {"deldrift_nesting_levels", "one edge in eight", [](Context &c) {
             lay(c);
             fill<1, std::uint32_t>(c, c.cells(), [&](std::uint32_t *to, std::size_t room, std::size_t *count) {
                 return deldrift_nesting_levels(c.t, to, room, count);
             });
         }, 2},
        {"deldrift_crossing_numbers", "one edge in eight", [](Context &c) {
             lay(c);
             fill<1, std::uint32_t>(c, c.cells(), [&](std::uint32_t *to, std::size_t room, std::size_t *count) {
                 return deldrift_crossing_numbers(c.t, to, room, count);
             });
         }, 2},
        {"deldrift_label_cells", "one edge in eight, and a seed within one cell in eight", [](Context &c) {
             lay(c);
             const deldrift_cells_view view = c.view();
             Points seeds;
             for (std::size_t cell = 0; cell < view.count; cell += 8) {
                 // Seeds at the corners of cells are not in one region.
                 Points middle(2);
                 for (std::size_t i = 0; i < 6; ++i) middle[i % 2] += c.place(view.vertices[3 * cell + i / 2])[i % 2] / 3;
                 deldrift_location location;
                 must(deldrift_locate(c.t, middle.data(), &location));
                 if (location.kind == DELDRIFT_LOCATION_CELL && location.index == cell) Context::append(seeds, middle);
             }
             const std::vector<std::int32_t> labels(seeds.size() / 2 + 1, 1);
             fill<1, std::int32_t>(c, c.cells(), [&](std::int32_t *to, std::size_t room, std::size_t *count) {
                 // In flat cells the middle may be on an edge.
                 const deldrift_status status =
                     deldrift_label_cells(c.t, seeds.data(), labels.data(), seeds.size() / 2, 0, to, room, count);
                 return status == DELDRIFT_AMBIGUOUS_SEED ? DELDRIFT_OK : status;
             });
         }, 2},
        {"deldrift_set_regions", "one edge in eight", [](Context &c) {
             lay(c);
             const std::vector<std::int32_t> labels(c.cells() + 1, 1);
             c.meter.time([&] { must(deldrift_set_regions(c.t, labels.data(), c.cells())); });
             c.meter.count(double(c.cells()));
         }, 2},
        {"deldrift_set_segment_sides", "one edge in eight", [](Context &c) {
             const std::size_t n = lay(c);
             Ids segments(n + 1);
             std::size_t count;
             must(deldrift_segments(c.t, segments.data(), nullptr, nullptr, n, &count));
             const std::vector<std::int32_t> sides(2 * n + 1, 1);
             c.meter.reset();
             c.meter.time([&] { must(deldrift_set_segment_sides(c.t, segments.data(), sides.data(), count)); });
             c.meter.count(double(count));
         }, 2},
        {"deldrift_regions", "one edge in eight", [](Context &c) {
             lay(c);
             const std::vector<std::int32_t> labels(c.cells() + 1, 1);
             must(deldrift_set_regions(c.t, labels.data(), c.cells()));
             fill<1, std::int32_t>(c, c.cells(), [&](std::int32_t *to, std::size_t room, std::size_t *count) {
                 return deldrift_regions(c.t, 0, to, room, count, nullptr);
             });
         }, 2},
        {"deldrift_update_labels", "one edge in eight, and one cell in eight", [](Context &c) {
             lay(c);
             std::vector<std::int32_t> labels(c.cells() + 1);
             Ids cells;
             for (std::size_t cell = 0; cell < c.cells(); cell += 8) cells.push_back(std::uint32_t(cell));
             std::size_t undecided;
             c.meter.time([&] {
                 must(deldrift_update_labels(c.t, cells.data(), cells.size(), 0, labels.data(), labels.size(), &undecided));
             });
             c.meter.count(double(cells.size()));
         }, 2},
        {"deldrift_quality_init", "", [](Context &c) {
             deldrift_quality quality;
             c.meter.time([&] { must(deldrift_quality_init(&quality)); });
             c.meter.count(1);
         }, 2},
        {"deldrift_refine", "all within the hull, until no angle is below 20 degrees, or as many vertices have come", [](Context &c) {
             bound(c);
             const deldrift_quality quality = quality_of(c);
             deldrift_quality_report report{};
             c.meter.time([&] { deldrift_refine(c.t, &quality, nullptr, 0, &report); });
             c.meter.count(double(c.n + 2 * c.cells()));
         }, 2},
        {"deldrift_coarsen", "all within the hull, with as many vertices that refinement has inserted", [](Context &c) {
             bound(c);
             const deldrift_quality quality = quality_of(c);
             deldrift_refine(c.t, &quality, nullptr, 0, nullptr);
             deldrift_quality coarser = quality;
             coarser.least_angle = 5;
             const std::size_t cells = c.cells();
             c.meter.reset();
             c.meter.time([&] { deldrift_coarsen(c.t, &coarser, nullptr, 0, nullptr); });
             c.meter.count(double(c.n + 2 * cells));
         }, 2},
        {"deldrift_made_vertices", "as many as there were", [](Context &c) {
             bound(c);
             const deldrift_quality quality = quality_of(c);
             deldrift_refine(c.t, &quality, nullptr, 0, nullptr);
             fill<1, std::uint32_t>(c, c.n, [&](std::uint32_t *to, std::size_t room, std::size_t *count) {
                 return deldrift_made_vertices(c.t, to, nullptr, room, count);
             });
         }, 2},
        {"deldrift_refined_weights", "as many vertices as there were", [](Context &c) {
             bound(c);
             const deldrift_quality quality = quality_of(c);
             deldrift_refine(c.t, &quality, nullptr, 0, nullptr);
             fill<3, std::uint32_t>(c, c.n, [&](std::uint32_t *to, std::size_t room, std::size_t *count) {
                 return deldrift_refined_weights(c.t, to, nullptr, room, count);
             });
         }, 2},
        {"deldrift_refined_sizes", "as many vertices as there were", [](Context &c) {
             bound(c);
             const std::vector<double> sizes(c.n, 1e300);
             deldrift_quality quality = quality_of(c);
             quality.sizes = sizes.data();
             quality.size_count = sizes.size();
             deldrift_refine(c.t, &quality, nullptr, 0, nullptr);
             fill<1, double>(c, c.n, [&](double *to, std::size_t room, std::size_t *count) {
                 return deldrift_refined_sizes(c.t, to, room, count);
             });
         }, 2},
        {"deldrift_refined_vertices", "as many vertices as there were", [](Context &c) {
             bound(c);
             const deldrift_quality quality = quality_of(c);
             deldrift_refine(c.t, &quality, nullptr, 0, nullptr);
             fill<1, std::uint32_t>(c, c.n, [&](std::uint32_t *to, std::size_t room, std::size_t *count) {
                 return deldrift_refined_vertices(c.t, to, room, count);
             });
         }, 2},
        {"deldrift_original_segments", "one edge in eight", [](Context &c) {
             fill<1, std::uint32_t>(c, lay(c), [&](std::uint32_t *to, std::size_t room, std::size_t *count) {
                 return deldrift_original_segments(c.t, to, room, count);
             });
         }, 2},
        {"deldrift_boundary_chains", "one edge in eight, and every second cell", [](Context &c) {
             lay(c);
             std::vector<std::uint8_t> mask(c.cells() + 1);
             for (std::size_t cell = 0; cell < mask.size(); cell += 2) mask[cell] = 1;
             fill<1, std::uint32_t>(c, 3 * c.cells(), [&](std::uint32_t *to, std::size_t room, std::size_t *count) {
                 return deldrift_boundary_chains(c.t, mask.data(), c.cells(), to, nullptr, nullptr, nullptr, nullptr, room,
                                                 count);
             });
         }, 2},
    };
}

}  // namespace costs
