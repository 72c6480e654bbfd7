// Calls that make or change a triangulation.
#include "measure.hpp"

namespace costs {
namespace {

/// Stages what `stage` does and times the commit, whose input is `input` and the cells of before and after.
template <typename Stage>
void commit(Context &c, double input, Stage stage) {
    const std::size_t before = c.cells();
    stage();
    c.meter.time([&] { must(deldrift_commit_timestamp(c.t, nullptr)); });
    c.meter.count(input + double(before + c.cells()));
}

void commit_all(Context &c, const Points &moved) {
    commit(c, double(c.n), [&] { must(deldrift_move_vertices(c.t, nullptr, moved.data(), c.n)); });
}

template <deldrift_algorithm algorithm>
void commit_with(Context &c) {
    must(deldrift_set_algorithm(c.t, algorithm));
    commit_all(c, c.all_nearby());
}

Ids some_vertices(const Context &c) {
    Ids ids;
    for (std::size_t i = 0; i < c.some(); ++i) ids.push_back(c.some_vertex(i));
    return ids;
}

/// One vertex in eight to other places, staged and committed one by one.
template <typename Place>
void commit_one_by_one(Context &c, Place place) {
    for (std::size_t i = 0; i < c.some(); ++i) {
        const std::uint32_t v = c.some_vertex(i);
        const Points p = place(v);
        const double before = double(c.star(v));
        must(deldrift_move_vertex(c.t, v, p.data()));
        c.meter.time([&] { must(deldrift_commit_timestamp(c.t, nullptr)); });
        c.meter.count(1 + before + double(c.star(v)));
    }
}

template <typename Place>
void relocate(Context &c, Place place) {
    for (std::size_t i = 0; i < c.some(); ++i) {
        const std::uint32_t v = c.some_vertex(i);
        const Points p = place(v);
        const double before = double(c.star(v));
        c.meter.time([&] { must(deldrift_relocate_vertex(c.t, v, p.data())); });
        c.meter.count(1 + before + double(c.star(v)));
    }
}

template <typename Place>
void insert(Context &c, Place place) {
    for (std::size_t i = 0; i < c.some(); ++i) {
        const Points p = place();
        const std::size_t before = c.cells();
        std::uint32_t v;
        c.meter.time([&] { must(deldrift_insert_vertex(c.t, p.data(), &v)); });
        // Cells created, and cells removed.
        const double created = double(c.star(v));
        c.meter.count(1 + created + std::max(0.0, double(before) + created - double(c.cells())));
    }
}

void remove(Context &c, const Ids &ids) {
    for (const std::uint32_t v : ids) {
        const double before = double(c.cells()), removed = double(c.star(v));
        c.meter.time([&] { must(deldrift_remove_vertex(c.t, v)); });
        c.meter.count(1 + removed + std::max(0.0, double(c.cells()) + removed - before));
    }
}

Points at_one_place(const Context &c, std::size_t count) {
    Points p;
    for (std::size_t i = 0; i < count; ++i) Context::append(p, Points(c.place(c.n / 2), c.place(c.n / 2) + c.dimension));
    return p;
}

/// As many vertices as there are, all at the place of one; their ids.
Ids put_at_one_place(Context &c) {
    std::uint32_t first;
    must(deldrift_stage_insertions(c.t, at_one_place(c, c.n).data(), c.n, &first));
    must(deldrift_commit_timestamp(c.t, nullptr));
    c.meter.reset();
    Ids ids;
    for (std::size_t i = 0; i < c.n; ++i) ids.push_back(first + std::uint32_t(i));
    return ids;
}

void stage_insertions(Context &c, const Points &p) {
    std::uint32_t first;
    must(deldrift_stage_insertions(c.t, p.data(), p.size() / c.dimension, &first));
}

void stage_removals(Context &c, const Ids &ids) { must(deldrift_stage_removals(c.t, ids.data(), ids.size())); }

/// Keys of which each is that of several vertices.
// Makes the triangulation of the vertices with weights up to a hundredth of the square of the mean way from each to the next one;
// the weights.
std::vector<double> make_weighted(Context &c) {
    deldrift_destroy(c.t);
    c.t = nullptr;
    const deldrift_options options = c.options();
    double square = 0;
    for (std::size_t i = c.dimension; i < c.points.size(); ++i) {
        const double step = c.points[i] - c.points[i - c.dimension];
        square += step * step / double(c.n);
    }
    std::vector<double> weights(c.n);
    for (std::size_t v = 0; v < c.n; ++v) weights[v] = 0.01 * square * double(v * 7919 % 1000) / 1000;
    c.meter.time([&] {
        must(deldrift_create_weighted(c.dimension, c.points.data(), weights.data(), nullptr, c.n, &options, &c.t));
    });
    c.meter.count(double(c.n + c.cells()));
    return weights;
}

std::vector<std::uint64_t> few_keys(std::size_t count) {
    std::vector<std::uint64_t> keys(count);
    for (std::size_t i = 0; i < count; ++i) keys[i] = i * 7 % 1009;
    return keys;
}

/// The vertex with the most cells.
std::uint32_t highest_degree(Context &c) {
    std::vector<std::size_t> degrees(c.n);
    const deldrift_cells_view view = c.view();
    for (std::size_t i = 0; i < view.count * c.corners(); ++i) ++degrees[view.vertices[i]];
    return std::uint32_t(std::max_element(degrees.begin(), degrees.end()) - degrees.begin());
}

}  // namespace

std::vector<Call> changing_calls() {
    return {
        {"deldrift_create", "", [](Context &c) {
             deldrift_destroy(c.t);
             c.t = nullptr;
             const deldrift_options options = c.options();
             c.meter.time([&] { c.t = c.create(options); });
             c.meter.count(double(c.n + c.cells()));
         }},
        {"deldrift_create", "coincident vertices rejected", [](Context &c) {
             deldrift_options options = c.options();
             options.coincidence = DELDRIFT_COINCIDENCE_REJECT;
             deldrift_triangulation *other = nullptr;
             c.meter.time([&] { deldrift_create(c.dimension, c.points.data(), c.n, &options, &other); });
             c.meter.count(double(c.n + c.cells()));
         }},
        {"deldrift_destroy", "", [](Context &c) {
             c.meter.count(double(c.n + c.cells()));
             c.meter.time([&] { deldrift_destroy(c.t); });
             c.t = nullptr;
         }},
        {"deldrift_set_algorithm", "", [](Context &c) {
             for (std::size_t i = 0; i < c.n; ++i)
                 c.meter.time([&] { must(deldrift_set_algorithm(c.t, i % 2 ? DELDRIFT_AUTO : DELDRIFT_REPAIR)); });
             c.meter.count(double(c.n));
         }},
        {"deldrift_research_set_algorithm", "", [](Context &c) {
             const deldrift_research_algorithm both[] = {DELDRIFT_RESEARCH_PLACEMENT, DELDRIFT_RESEARCH_SAFE_REGION};
             for (std::size_t i = 0; i < c.n; ++i)
                 c.meter.time([&] { must(deldrift_research_set_algorithm(c.t, both[i % 2], nullptr)); });
             c.meter.count(double(c.n));
         }},
        {"deldrift_move_vertex", "all, one by one", [](Context &c) {
             const Points moved = c.all_nearby();
             c.meter.time([&] {
                 for (std::uint32_t v = 0; v < c.n; ++v) must(deldrift_move_vertex(c.t, v, &moved[v * c.dimension]));
             }, c.n);
             c.meter.count(double(c.n));
         }},
        {"deldrift_move_vertices", "all", [](Context &c) {
             const Points moved = c.all_nearby();
             c.meter.time([&] { must(deldrift_move_vertices(c.t, nullptr, moved.data(), c.n)); });
             c.meter.count(double(c.n));
         }},
        {"deldrift_stage_insertions", "as many as there are", [](Context &c) {
             c.meter.time([&] { stage_insertions(c, c.points); });
             c.meter.count(double(c.n));
         }},
        {"deldrift_create_with_keys", "", [](Context &c) {
             deldrift_destroy(c.t);
             c.t = nullptr;
             const deldrift_options options = c.options();
             const std::vector<std::uint64_t> keys = few_keys(c.n);
             c.meter.time([&] {
                 must(deldrift_create_with_keys(c.dimension, c.points.data(), keys.data(), c.n, &options, &c.t));
             });
             c.meter.count(double(c.n + c.cells()));
         }},
        {"deldrift_create_weighted", "", [](Context &c) { make_weighted(c); }},
        {"deldrift_is_weighted", "of one with weights", [](Context &c) {
             make_weighted(c);
             bool is_weighted;
             c.meter.reset();
             c.meter.time([&] { must(deldrift_is_weighted(c.t, &is_weighted)); });
             c.meter.count(1);
         }},
        {"deldrift_weights", "of one with weights", [](Context &c) {
             std::vector<double> weights = make_weighted(c);
             std::size_t count;
             c.meter.reset();
             c.meter.time([&] { must(deldrift_weights(c.t, weights.data(), c.n, &count)); });
             c.meter.count(double(c.n));
         }},
        {"deldrift_stage_weights", "all", [](Context &c) {
             const std::vector<double> weights = make_weighted(c);
             c.meter.reset();
             c.meter.time([&] { must(deldrift_stage_weights(c.t, nullptr, weights.data(), c.n)); });
             c.meter.count(double(c.n));
         }},
        {"deldrift_commit_weighted", "weights nearby", [](Context &c) {
             std::vector<double> weights = make_weighted(c);
             for (std::size_t v = 0; v < c.n; ++v) weights[v] *= 1 + 1e-3 * double(v % 3);
             c.meter.reset();
             c.meter.time([&] { must(deldrift_commit_weighted(c.t, nullptr, weights.data(), c.n, nullptr)); });
             c.meter.count(double(c.n + c.cells()));
         }},
        {"deldrift_set_weight", "ten vertices", [](Context &c) {
             const std::vector<double> weights = make_weighted(c);
             c.meter.reset();
             c.meter.time([&] {
                 for (std::uint32_t k = 0; k < 10; ++k) {
                     const std::uint32_t v = std::uint32_t(k * 7919 % c.n);
                     must(deldrift_set_weight(c.t, v, weights[v] * 1.01));
                 }
             }, 10);
             c.meter.count(double(c.n));
         }},
        {"deldrift_insert_vertex_with_weight", "ten vertices", [](Context &c) {
             make_weighted(c);
             std::uint32_t v;
             c.meter.reset();
             c.meter.time([&] {
                 for (std::size_t k = 0; k < 10; ++k) {
                     must(deldrift_insert_vertex_with_weight(c.t, c.place(k * 7919 % c.n), 1e-3 * double(k), &v));
                 }
             }, 10);
             c.meter.count(double(c.n));
         }},
        {"deldrift_stage_insertions_with_weights", "as many as there are", [](Context &c) {
             const std::vector<double> weights = make_weighted(c);
             std::uint32_t first;
             c.meter.reset();
             c.meter.time([&] {
                 must(deldrift_stage_insertions_with_weights(c.t, c.points.data(), weights.data(), c.n, &first));
             });
             c.meter.count(double(c.n));
         }},
        {"deldrift_hidden_by_weight", "of one with weights", [](Context &c) {
             make_weighted(c);
             std::vector<std::uint32_t> vertices(c.n + 1), cells(c.n + 1);
             std::size_t count;
             c.meter.reset();
             c.meter.time([&] { must(deldrift_hidden_by_weight(c.t, vertices.data(), cells.data(), c.n, &count)); });
             c.meter.count(double(c.n));
         }},
        {"deldrift_stage_insertions_with_keys", "as many as there are", [](Context &c) {
             std::uint32_t first;
             const std::vector<std::uint64_t> keys = few_keys(c.n);
             c.meter.time([&] {
                 must(deldrift_stage_insertions_with_keys(c.t, c.points.data(), keys.data(), c.n, &first));
             });
             c.meter.count(double(c.n));
         }},
        {"deldrift_stage_insertions_at_free_ids", "as many as there are", [](Context &c) {
             Ids ids(c.n);
             const std::vector<std::uint64_t> keys = few_keys(c.n);
             c.meter.time([&] {
                 must(deldrift_stage_insertions_at_free_ids(c.t, c.points.data(), keys.data(), c.n, ids.data()));
             });
             c.meter.count(double(c.n));
         }},
        {"deldrift_insert_vertex_with_key", "the first of a triangulation", [](Context &c) {
             std::uint32_t v;
             c.meter.time([&] { must(deldrift_insert_vertex_with_key(c.t, c.place(c.n / 2), 7, &v)); });
             c.meter.count(double(c.n));
         }},
        {"deldrift_keys", "", [](Context &c) {
             std::vector<std::uint64_t> keys(c.n);
             std::size_t count;
             c.meter.time([&] { must(deldrift_keys(c.t, keys.data(), c.n, &count)); });
             c.meter.count(double(c.n));
         }},
        {"deldrift_stage_insertions", "as many, one by one", [](Context &c) {
             std::uint32_t v;
             c.meter.time([&] {
                 for (std::size_t i = 0; i < c.n; ++i) must(deldrift_stage_insertions(c.t, c.place(i), 1, &v));
             }, c.n);
             c.meter.count(double(c.n));
         }},
        {"deldrift_stage_removals", "all", [](Context &c) {
             Ids ids;
             for (std::uint32_t v = 0; v < c.n; ++v) ids.push_back(v);
             c.meter.time([&] { stage_removals(c, ids); });
             c.meter.count(double(c.n));
         }},
        {"deldrift_stage_removals", "all, one by one", [](Context &c) {
             c.meter.time([&] {
                 for (std::uint32_t v = 0; v < c.n; ++v) must(deldrift_stage_removals(c.t, &v, 1));
             }, c.n);
             c.meter.count(double(c.n));
         }},
        {"deldrift_discard_moves", "all moved, half as many inserted, some removed", [](Context &c) {
             must(deldrift_move_vertices(c.t, nullptr, c.all_nearby().data(), c.n));
             stage_insertions(c, Points(c.points.begin(), c.points.begin() + std::ptrdiff_t(c.n / 2 * c.dimension)));
             stage_removals(c, some_vertices(c));
             c.meter.time([&] { must(deldrift_discard_moves(c.t)); });
             c.meter.count(double(c.n));
         }},
        {"deldrift_discard_moves", "one of each, as often as there are vertices", [](Context &c) {
             for (std::uint32_t v = 0; v < c.n; ++v) {
                 const std::uint32_t other = (v + 1) % std::uint32_t(c.n);
                 must(deldrift_move_vertex(c.t, v, c.place(v)));
                 stage_insertions(c, c.nearby(v));
                 must(deldrift_stage_removals(c.t, &other, 1));
                 c.meter.time([&] { must(deldrift_discard_moves(c.t)); });
             }
             c.meter.count(double(c.n));
         }},
        {"deldrift_prepare_timestamp", "all nearby, and published", [](Context &c) {
             must(deldrift_move_vertices(c.t, nullptr, c.all_nearby().data(), c.n));
             c.meter.time([&] {
                 must(deldrift_prepare_timestamp(c.t, nullptr));
                 must(deldrift_publish_timestamp(c.t));
             });
             c.meter.count(double(c.n));
         }},
        {"deldrift_publish_timestamp", "nothing moved, as often as there are vertices", [](Context &c) {
             for (std::size_t i = 0; i < c.n; ++i) {
                 must(deldrift_prepare_timestamp(c.t, nullptr));
                 c.meter.time([&] { must(deldrift_publish_timestamp(c.t)); });
             }
             c.meter.count(double(c.n));
         }},
        {"deldrift_withdraw_timestamp", "all nearby", [](Context &c) {
             must(deldrift_move_vertices(c.t, nullptr, c.all_nearby().data(), c.n));
             must(deldrift_prepare_timestamp(c.t, nullptr));
             c.meter.time([&] { must(deldrift_withdraw_timestamp(c.t)); });
             c.meter.count(double(c.n));
         }},
        {"deldrift_withdraw_timestamp", "one moved, as often as there are vertices", [](Context &c) {
             for (std::uint32_t v = 0; v < c.n; ++v) {
                 must(deldrift_move_vertex(c.t, v, c.nearby(v).data()));
                 must(deldrift_prepare_timestamp(c.t, nullptr));
                 c.meter.time([&] { must(deldrift_withdraw_timestamp(c.t)); });
             }
             c.meter.count(double(c.n));
         }},
        {"deldrift_commit_timestamp", "nothing staged, as often as there are vertices", [](Context &c) {
             c.meter.time([&] {
                 for (std::size_t i = 0; i < c.n; ++i) must(deldrift_commit_timestamp(c.t, nullptr));
             }, c.n);
             c.meter.count(double(c.n));
         }},
        {"deldrift_commit_timestamp", "one vertex nearby, for one in eight",
         [](Context &c) { commit_one_by_one(c, [&](std::uint32_t v) { return c.nearby(v); }); }},
        {"deldrift_commit_timestamp", "one vertex far away, for one in eight",
         [](Context &c) { commit_one_by_one(c, [&](std::uint32_t) { return c.elsewhere(); }); }},
        {"deldrift_commit_timestamp", "one in eight nearby", [](Context &c) {
             Points p;
             for (const std::uint32_t v : some_vertices(c)) Context::append(p, c.nearby(v));
             commit(c, double(c.n), [&] { must(deldrift_move_vertices(c.t, some_vertices(c).data(), p.data(), c.some())); });
         }},
        {"deldrift_commit_timestamp", "one in eight far away", [](Context &c) {
             const Points p = c.many(c.some(), &Context::elsewhere);
             commit(c, double(c.n), [&] { must(deldrift_move_vertices(c.t, some_vertices(c).data(), p.data(), c.some())); });
         }},
        {"deldrift_commit_timestamp", "all nearby", [](Context &c) { commit_all(c, c.all_nearby()); }},
        {"deldrift_commit_timestamp", "all by one vector", [](Context &c) {
             Points moved = c.points;
             for (double &x : moved) x += 0.25;
             commit_all(c, moved);
         }},
        {"deldrift_commit_timestamp", "all far away", [](Context &c) {
             commit_all(c, c.many(c.n, &Context::elsewhere));
         }},
        {"deldrift_commit_timestamp", "all to one place", [](Context &c) { commit_all(c, at_one_place(c, c.n)); }},
        {"deldrift_commit_timestamp", "all to one place and back", [](Context &c) {
             commit_all(c, at_one_place(c, c.n));
             commit_all(c, c.points);
         }},
        {"deldrift_commit_timestamp", "all nearby, rebuilding", commit_with<DELDRIFT_REBUILDING>},
        {"deldrift_commit_timestamp", "all nearby, placement with flips", commit_with<DELDRIFT_PLACEMENT_FLIPS>},
        {"deldrift_commit_timestamp", "all nearby, tolerance", commit_with<DELDRIFT_TOLERANCE>},
        {"deldrift_commit_timestamp", "all nearby, repair", commit_with<DELDRIFT_REPAIR>},
        {"deldrift_commit_timestamp", "one in eight inserted", [](Context &c) {
             const Points p = c.many(c.some(), &Context::elsewhere);
             commit(c, double(c.some()), [&] { stage_insertions(c, p); });
         }},
        {"deldrift_commit_timestamp", "as many inserted, anywhere", [](Context &c) {
             const Points p = c.many(c.n, &Context::anywhere);
             commit(c, double(c.n), [&] { stage_insertions(c, p); });
         }},
        {"deldrift_commit_timestamp", "as many inserted, all at one place", [](Context &c) {
             commit(c, double(c.n), [&] { stage_insertions(c, at_one_place(c, c.n)); });
         }},
        {"deldrift_commit_timestamp", "one in eight removed",
         [](Context &c) { commit(c, double(c.n), [&] { stage_removals(c, some_vertices(c)); }); }},
        {"deldrift_commit_timestamp", "every second one removed", [](Context &c) {
             Ids ids;
             for (std::uint32_t v = 0; v < c.n; v += 2) ids.push_back(v);
             commit(c, double(c.n), [&] { stage_removals(c, ids); });
         }},
        {"deldrift_commit_timestamp", "the one of highest degree removed",
         [](Context &c) { commit(c, 1, [&] { stage_removals(c, {highest_degree(c)}); }); }},
        {"deldrift_commit_timestamp", "coincident ones removed", [](Context &c) {
             const Ids ids = put_at_one_place(c);
             commit(c, double(c.n), [&] { stage_removals(c, ids); });
         }},
        {"deldrift_commit_timestamp", "coincident ones move away", [](Context &c) {
             const Ids ids = put_at_one_place(c);
             const Points p = c.many(c.n, &Context::elsewhere);
             commit(c, double(c.n), [&] { must(deldrift_move_vertices(c.t, ids.data(), p.data(), c.n)); });
         }},
        {"deldrift_commit_timestamp", "ten commits: all nearby", [](Context &c) {
             for (int i = 0; i < 10; ++i) commit_all(c, c.all_nearby());
         }},
        {"deldrift_commit_positions", "nothing moves, ten times", [](Context &c) {
             for (int i = 0; i < 10; ++i)
                 c.meter.time([&] { must(deldrift_commit_positions(c.t, c.points.data(), c.n, nullptr)); });
             c.meter.count(10 * double(c.n) + double(c.cells()));
         }},
        {"deldrift_commit_positions", "all nearby", [](Context &c) {
             const Points moved = c.all_nearby();
             c.meter.time([&] { must(deldrift_commit_positions(c.t, moved.data(), c.n, nullptr)); });
             c.meter.count(double(c.n + c.cells()));
         }},
        {"deldrift_commit_positions", "all mirrored", [](Context &c) {
             Points moved = c.points;
             for (std::size_t i = 0; i < moved.size(); i += c.dimension) moved[i] = -moved[i];
             c.meter.time([&] { must(deldrift_commit_positions(c.t, moved.data(), c.n, nullptr)); });
             c.meter.count(double(c.n + c.cells()));
         }},
        {"deldrift_relocate_vertex", "nearby, one in eight",
         [](Context &c) { relocate(c, [&](std::uint32_t v) { return c.nearby(v); }); }},
        {"deldrift_relocate_vertex", "far away, one in eight",
         [](Context &c) { relocate(c, [&](std::uint32_t) { return c.elsewhere(); }); }},
        {"deldrift_relocate_vertex", "all to one place, one in eight", [](Context &c) {
             relocate(c, [&](std::uint32_t) { return at_one_place(c, 1); });
         }},
        {"deldrift_relocate_vertex", "the one of highest degree, away and back", [](Context &c) {
             const std::uint32_t v = highest_degree(c);
             for (const Points &p : {c.elsewhere(), Points(c.place(v), c.place(v) + c.dimension)}) {
                 const double before = double(c.star(v));
                 c.meter.time([&] { must(deldrift_relocate_vertex(c.t, v, p.data())); });
                 c.meter.count(1 + before + double(c.star(v)));
             }
         }},
        {"deldrift_insert_vertex", "at vertices, one in eight",
         [](Context &c) { insert(c, [&] { return c.elsewhere(); }); }},
        {"deldrift_insert_vertex", "anywhere, one in eight", [](Context &c) { insert(c, [&] { return c.anywhere(); }); }},
        {"deldrift_insert_vertex", "as many, all at one place", [](Context &c) {
             const Points p = at_one_place(c, 1);
             std::uint32_t v;
             for (std::size_t i = 0; i < c.n; ++i)
                 c.meter.time([&] { must(deldrift_insert_vertex(c.t, p.data(), &v)); });
             c.meter.count(double(c.n));
         }},
        {"deldrift_remove_vertex", "one in eight", [](Context &c) { remove(c, some_vertices(c)); }},
        {"deldrift_remove_vertex", "the one of highest degree", [](Context &c) { remove(c, {highest_degree(c)}); }},
        {"deldrift_remove_vertex", "coincident ones, the first ones first", [](Context &c) {
             const Ids ids = put_at_one_place(c);
             for (const std::uint32_t v : ids) c.meter.time([&] { must(deldrift_remove_vertex(c.t, v)); });
             c.meter.count(double(c.n));
         }},
        {"deldrift_compact", "one in eight removed", [](Context &c) {
             stage_removals(c, some_vertices(c));
             must(deldrift_commit_timestamp(c.t, nullptr));
             c.meter.reset();
             std::size_t count;
             c.meter.time([&] { must(deldrift_compact(c.t, nullptr, 0, &count)); });
             c.meter.count(double(c.n + c.cells()));
         }},
        {"deldrift_take_changes", "the first", [](Context &c) {
             deldrift_changes changes;
             c.meter.time([&] { must(deldrift_take_changes(c.t, &changes)); });
             c.meter.count(double(c.n + changes.created_count));
         }},
        {"deldrift_take_changes", "after each of some relocations", [](Context &c) {
             deldrift_changes changes;
             must(deldrift_take_changes(c.t, &changes));
             for (std::size_t i = 0; i < c.some(); ++i) {
                 must(deldrift_relocate_vertex(c.t, c.some_vertex(i), c.elsewhere().data()));
                 c.meter.time([&] { must(deldrift_take_changes(c.t, &changes)); });
                 c.meter.count(1 + double(changes.created_count + changes.removed_count + changes.renumbered_count));
                 c.meter.count(double(changes.star_count + changes.hidden_count + changes.shown_count));
             }
         }},
        {"deldrift_transfer_cells", "after each of some relocations", [](Context &c) {
             deldrift_changes changes;
             must(deldrift_take_changes(c.t, &changes));
             std::vector<double> values(2 * c.cells() + 1000);
             for (std::size_t i = 0; i < c.some(); ++i) {
                 const std::size_t before = c.cells();
                 must(deldrift_relocate_vertex(c.t, c.some_vertex(i), c.elsewhere().data()));
                 must(deldrift_take_changes(c.t, &changes));
                 values.resize(std::max(values.size(), c.cells()));
                 c.meter.time([&] {
                     must(deldrift_transfer_cells(c.t, nullptr, 0, DELDRIFT_TRANSFER_SECOND_ORDER, values.data(),
                                                  before, 1, values.size(), nullptr, nullptr, nullptr));
                 });
                 c.meter.count(1 + double(before + changes.created_count + changes.removed_count));
             }
         }},
        {"deldrift_take_changes", "after all have moved far away", [](Context &c) {
             deldrift_changes changes;
             must(deldrift_take_changes(c.t, &changes));
             must(deldrift_commit_positions(c.t, c.many(c.n, &Context::elsewhere).data(), c.n, nullptr));
             c.meter.reset();
             c.meter.time([&] { must(deldrift_take_changes(c.t, &changes)); });
             c.meter.count(double(c.n + changes.created_count + changes.removed_count + changes.renumbered_count));
         }},
    };
}

}  // namespace costs
