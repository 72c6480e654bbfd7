// deldrift for C++17: deldrift.h with an owner, exceptions, ranges and spans.
//
//     const std::vector<std::array<double, 2>> square{{0, 0}, {4, 0}, {4, 3}, {0, 3}, {1, 1}};
//     deldrift::Triangulation t(2, square);
//     t.move_vertex(4, {3.0, 2.0});
//     t.commit_timestamp();
//     for (auto [a, b, c] : t.cells().rows<3>()) std::cout << a << ' ' << b << ' ' << c << '\n';
//
// A Triangulation owns a deldrift_triangulation and destroys it. Every member calls the function of the
// same name in deldrift.h, which describes shapes, errors and the life of views; const members may be called
// from several threads at once. A member that is not noexcept throws deldrift::Error, and has had no effect
// then. To do without exceptions, call the functions of deldrift.h on native(): they return a status. Where exceptions
// are disabled (-fno-exceptions) this header does not compile, and says so: use deldrift.h.
//
// Positions come from any contiguous container of double, float, std::array or a program's own points, or with a
// stride, or from arrays of x, y and z: see deldrift/positions.hpp. Cells, facets, stars and vertices are ranges with
// iterators for <algorithm> and <ranges>: see deldrift/cells.hpp. Ranges end like the views that they are made of, with
// the next change. Segments, and the error of a change that they refuse, are in deldrift/segments.hpp; the quality of
// cells that refine() works towards is in deldrift/refining.hpp.
// deldrift/cgal.hpp has the names of CGAL's Delaunay_triangulation_2 and _3, and of its regular triangulations.
#ifndef DELDRIFT_HPP
#define DELDRIFT_HPP

#if __cplusplus < 201703L
#error "deldrift.hpp is for C++17 and later: compile with -std=c++17, or use deldrift.h"
#elif !defined __cpp_exceptions
#error "deldrift.hpp throws exceptions, which are disabled here: use deldrift.h, whose functions return a status"
#else

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "deldrift.h"
#include "deldrift/cells.hpp"
#include "deldrift/orientation.hpp"
#include "deldrift/positions.hpp"
#include "deldrift/refining.hpp"
#include "deldrift/results.hpp"
#include "deldrift/segments.hpp"
#include "deldrift/span.hpp"
#include "deldrift/vertices.hpp"

namespace deldrift {

// The default options, to be changed and passed on.
inline deldrift_options default_options() noexcept {
    deldrift_options options;
    deldrift_options_init(&options);
    return options;
}

// A triangulation of moving points: can be moved, not copied.
class Triangulation {
public:
    // positions: dimension numbers for each point.
    Triangulation(std::uint32_t dimension, const Positions &positions,
                  const deldrift_options &options = default_options())
        : dimension_(dimension) {
        deldrift_triangulation *t = nullptr;
        const span<const double> numbers = gathered(positions);
        require_ok(deldrift_create(dimension, numbers.data(), count_of("positions", numbers), &options, &t));
        t_.reset(t);
    }
    // keys: an unsigned number of 64 bits for each point, by which ties are broken in place of ids. Equal keys are in the order
    // of x, then y, then z.
    //     const std::vector<std::uint64_t> tags = global_numbers_of(points);
    //     deldrift::Triangulation t(3, points, tags);
    Triangulation(std::uint32_t dimension, const Positions &positions, span<const std::uint64_t> keys,
                  const deldrift_options &options = default_options())
        : dimension_(dimension) {
        deldrift_triangulation *t = nullptr;
        const span<const double> numbers = gathered(positions);
        const std::size_t count = count_of("positions", numbers);
        expect("keys", keys.size(), count);
        require_ok(deldrift_create_with_keys(dimension, numbers.data(), keys.data(), count, &options, &t));
        t_.reset(t);
    }
    // Of points that repeat: box has the vectors of the box, one after the other, one for each direction at most.
    //     const std::vector<double> box{1, 0, 0.25, 1};
    //     deldrift::Triangulation t(2, points, deldrift::Periodic{box});
    Triangulation(std::uint32_t dimension, const Positions &positions, Periodic box,
                  const deldrift_options &options = default_options())
        : dimension_(dimension) {
        deldrift_triangulation *t = nullptr;
        const span<const double> numbers = gathered(positions);
        std::vector<double> room;
        const span<const double> vectors = box.vectors.numbers("vectors", dimension_, room);
        require_ok(deldrift_create_periodic(dimension, numbers.data(), count_of("positions", numbers),
                                            vectors.data(), count_of("vectors", vectors), &options, &t));
        t_.reset(t);
    }
    // Of points with weights that repeat.
    //     deldrift::Triangulation t(3, centres, deldrift::Weights(squared_radii), deldrift::Periodic{box});
    Triangulation(std::uint32_t dimension, const Positions &positions, Weights weights, Periodic box,
                  const deldrift_options &options = default_options())
        : dimension_(dimension) {
        deldrift_triangulation *t = nullptr;
        const span<const double> numbers = gathered(positions);
        const std::size_t count = count_of("positions", numbers);
        expect("weights", weights.numbers.size(), count);
        std::vector<double> room;
        const span<const double> vectors = box.vectors.numbers("vectors", dimension_, room);
        require_ok(deldrift_create_periodic_weighted(dimension, numbers.data(), weights.numbers.data(), count,
                                                     vectors.data(), count_of("vectors", vectors), &options, &t));
        t_.reset(t);
    }
    // Of vertices with weights, a number for each: the regular triangulation. keys: one for each, or none.
    //     const std::vector<double> radii = radii_of(atoms);
    //     deldrift::Triangulation t(3, centres, deldrift::Radii(radii));
    Triangulation(std::uint32_t dimension, const Positions &positions, Weights weights,
                  const deldrift_options &options = default_options())
        : Triangulation(dimension, positions, weights, span<const std::uint64_t>{}, options) {}
    Triangulation(std::uint32_t dimension, const Positions &positions, Weights weights, span<const std::uint64_t> keys,
                  const deldrift_options &options = default_options())
        : dimension_(dimension) {
        deldrift_triangulation *t = nullptr;
        const span<const double> numbers = gathered(positions);
        const std::size_t count = count_of("positions", numbers);
        expect("weights", weights.numbers.size(), count);
        if (!keys.empty()) expect("keys", keys.size(), count);
        require_ok(deldrift_create_weighted(dimension, numbers.data(), weights.numbers.data(),
                                            keys.empty() ? nullptr : keys.data(), count, &options, &t));
        t_.reset(t);
    }
    // Takes over what deldrift_create has made.
    explicit Triangulation(deldrift_triangulation *t) : t_(t) { require_ok(deldrift_dimension(t, &dimension_)); }

    // An independent triangulation that is as this one.
    Triangulation clone() const {
        deldrift_triangulation *t = nullptr;
        require_ok(deldrift_clone(native(), &t));
        return Triangulation(t);
    }
    std::vector<unsigned char> save() const {
        std::size_t count = 0;
        require_ok(deldrift_save(native(), nullptr, 0, &count));
        std::vector<unsigned char> bytes(count);
        require_ok(deldrift_save(native(), bytes.data(), count, &count));
        return bytes;
    }
    // Of bytes that save() gave.
    static Triangulation load(span<const unsigned char> bytes, const deldrift_options &options = default_options()) {
        deldrift_triangulation *t = nullptr;
        require_ok(deldrift_load(bytes.data(), bytes.size(), &options, &t));
        return Triangulation(t);
    }
    void save_file(const std::string &path) const { require_ok(deldrift_save_file(native(), path.c_str())); }
    static Triangulation load_file(const std::string &path, const deldrift_options &options = default_options()) {
        deldrift_triangulation *t = nullptr;
        require_ok(deldrift_load_file(path.c_str(), &options, &t));
        return Triangulation(t);
    }
    // For ParaView and VTK.
    void write_vtu(const std::string &path, const std::vector<Field> &vertex_fields = {},
                   const std::vector<Field> &cell_fields = {}) const {
        const std::vector<deldrift_field> vertices = fields_of(vertex_fields, id_count());
        const std::vector<deldrift_field> cells = fields_of(cell_fields, cell_count());
        require_ok(deldrift_write_vtu(native(), path.c_str(), vertices.data(), vertices.size(), cells.data(),
                                      cells.size()));
    }
    // For Mmg, FreeFem, Gmsh and others; the references of cells are numbers such as label_cells() gives, or 1.
    //
    //     t.write_medit("mesh.mesh", t.label_cells({0.5, 0.5}, {STEEL}, AIR));
    void write_medit(const std::string &path) const { require_ok(deldrift_write_medit(native(), path.c_str(), nullptr, 0)); }
    void write_medit(const std::string &path, span<const std::int32_t> references) const {
        expect("references", references.size(), cell_count());
        require_ok(deldrift_write_medit(native(), path.c_str(), references.data(), references.size()));
    }

    // For the functions of deldrift.h; null when moved from.
    deldrift_triangulation *native() noexcept { return t_.get(); }
    const deldrift_triangulation *native() const noexcept { return t_.get(); }
    std::uint32_t dimension() const noexcept { return dimension_; }

    void set_algorithm(deldrift_algorithm algorithm) { require_ok(deldrift_set_algorithm(native(), algorithm)); }
    deldrift_algorithm algorithm() const { return ask<deldrift_algorithm>(deldrift_get_algorithm); }

    void move_vertex(std::uint32_t vertex, span<const double> position) {
        require_ok(deldrift_move_vertex(native(), vertex, point(position)));
    }
    // positions: those of the first ids, as many as there are, or of the ids in vertices. Without ids, the entry of a
    // vertex whose insertion is staged is where it will be inserted.
    void move_vertices(const Positions &positions) {
        const span<const double> numbers = gathered(positions);
        require_ok(deldrift_move_vertices(native(), nullptr, numbers.data(), count_of("positions", numbers)));
    }
    void move_vertices(span<const std::uint32_t> vertices, const Positions &positions) {
        const span<const double> numbers = gathered(positions);
        expect("positions", numbers.size(), vertices.size() * dimension_);
        require_ok(deldrift_move_vertices(native(), vertices.data(), numbers.data(), vertices.size()));
    }
    // Edges that have to be there from the next commit on, each from a vertex to another; the id of the first one is returned,
    // which those of the others follow. In 2D, as all about segments. markers: one for each, or none.
    //     const std::vector<deldrift::Ends> walls{{0, 1}, {1, 2}, {2, 3}, {3, 0}};
    //     t.stage_segments(walls);
    //     t.commit_timestamp();  // throws deldrift::ConflictError if something is in the way
    std::uint32_t stage_segments(span<const Ends> ends, span<const std::int32_t> markers = {}) {
        static_assert(sizeof(Ends) == 2 * sizeof(std::uint32_t));
        if (!markers.empty()) expect("markers", markers.size(), ends.size());
        std::uint32_t first;
        require_ok(deldrift_stage_segments(native(), ends.empty() ? nullptr : ends.data()->data(), markers.data(),
                                           ends.size(), &first));
        return first;
    }
    void stage_segment_removals(span<const std::uint32_t> segments) {
        require_ok(deldrift_stage_segment_removals(native(), segments.data(), segments.size()));
    }
    // Throws what the commit would throw, as far as segments are concerned: a step can be cut until it does not.
    //     for (double step = 1;; step /= 2) {
    //         t.move_vertices(positions_after(step));
    //         try {
    //             t.check_staged();
    //             break;
    //         } catch (const deldrift::ConflictError &) {
    //             t.discard_moves();
    //         }
    //     }
    void check_staged() { require_change(deldrift_check_staged(native())); }
    // Throws PassingError if vertices would pass segments in a commit of what is staged, whatever the options say.
    void check_passings() { require_change(deldrift_check_passings(native())); }
    // Splits segments with vertices on them, and, with at most limit new vertices, those that cross: to be committed then.
    // Throws a ConflictError if more vertices are needed, or for ends that are removed or meet.
    //     t.stage_segments(roads);
    //     const deldrift_split_report split = t.stage_splits();
    //     t.commit_timestamp();
    //     for (std::uint32_t k = 0; k < split.inserted; k++) draw_crossing(t.position(split.first_vertex + k));
    deldrift_split_report stage_splits(std::size_t limit = SIZE_MAX) {
        deldrift_split_report report;
        require_change(deldrift_stage_splits(native(), limit, &report));
        return report;
    }
    // Other vectors for the box of a periodic triangulation, as many as there are, from the next commit on.
    void stage_vectors(const Positions &vectors) {
        const span<const double> numbers = vectors.numbers("vectors", dimension_, room_);
        require_ok(deldrift_stage_vectors(native(), numbers.data(), count_of("vectors", numbers)));
    }
    void discard_moves() { require_ok(deldrift_discard_moves(native())); }
    deldrift_commit_report commit_timestamp() {
        deldrift_commit_report report;
        require_change(deldrift_commit_timestamp(native(), &report));
        return report;
    }
    // The two phases of a commit: all that reads sees what is prepared, in one round or several, until it is published or
    // withdrawn. deldrift::Trial withdraws what has not been published at the end of a block.
    deldrift_commit_report prepare_timestamp() {
        deldrift_commit_report report;
        require_change(deldrift_prepare_timestamp(native(), &report));
        return report;
    }
    void publish_timestamp() { require_ok(deldrift_publish_timestamp(native())); }
    void withdraw_timestamp() { require_ok(deldrift_withdraw_timestamp(native())); }

    // positions: those of all ids, without moves staged before. A vertex whose insertion is staged is inserted at its
    // entry.
    deldrift_commit_report commit_positions(const Positions &positions) {
        const span<const double> numbers = gathered(positions);
        deldrift_commit_report report;
        require_change(deldrift_commit_positions(native(), numbers.data(), count_of("positions", numbers), &report));
        return report;
    }
    // Of vertices with weights. weights: those of the first ids, as many as there are, or of the ids in vertices. Staged
    // insertions may be among them: without this they have weight 0.
    void stage_weights(span<const double> weights) {
        require_ok(deldrift_stage_weights(native(), nullptr, weights.data(), weights.size()));
    }
    void stage_weights(span<const std::uint32_t> vertices, span<const double> weights) {
        expect("weights", weights.size(), vertices.size());
        require_ok(deldrift_stage_weights(native(), vertices.data(), weights.data(), vertices.size()));
    }
    void stage_weights(const Radii &radii) { stage_weights(radii.squares); }
    void stage_weights(span<const std::uint32_t> vertices, const Radii &radii) {
        stage_weights(vertices, radii.squares);
    }
    // Those of all ids, as for commit_positions(). None of positions, or of weights: these stay.
    //     const deldrift_commit_report report = t.commit_weighted({}, weights);
    //     if (report.newly_hidden > 0) shorten(step);
    deldrift_commit_report commit_weighted(const Positions &positions, span<const double> weights) {
        const span<const double> numbers = gathered(positions);
        std::size_t count = id_count();
        if (!numbers.empty()) count = count_of("positions", numbers);
        if (!weights.empty()) {
            if (!numbers.empty()) expect("weights", weights.size(), count);
            count = weights.size();
        }
        deldrift_commit_report report;
        require_ok(deldrift_commit_weighted(native(), numbers.empty() ? nullptr : numbers.data(),
                                            weights.empty() ? nullptr : weights.data(), count, &report));
        return report;
    }
    deldrift_commit_report commit_weighted(const Positions &positions, const Radii &radii) {
        return commit_weighted(positions, radii.squares);
    }
    // At once, without a commit.
    void set_weight(std::uint32_t vertex, double weight) { require_ok(deldrift_set_weight(native(), vertex, weight)); }
    bool is_weighted() const { return ask<bool>(deldrift_is_weighted); }
    // By id; NaN for removed vertices.
    std::vector<double> weights() const {
        std::size_t count = id_count();
        std::vector<double> weights(count);
        require_ok(deldrift_weights(native(), weights.data(), count, &count));
        return weights;
    }
    // For the next commit; returns the id of the first one, which those of the others follow.
    std::uint32_t stage_insertions(const Positions &positions) {
        const span<const double> numbers = gathered(positions);
        std::uint32_t first;
        require_ok(deldrift_stage_insertions(native(), numbers.data(), count_of("positions", numbers), &first));
        return first;
    }
    std::uint32_t stage_insertions(const Positions &positions, span<const std::uint64_t> keys) {
        const span<const double> numbers = gathered(positions);
        const std::size_t count = count_of("positions", numbers);
        expect("keys", keys.size(), count);
        std::uint32_t first;
        require_ok(deldrift_stage_insertions_with_keys(native(), numbers.data(), keys.data(), count, &first));
        return first;
    }
    std::uint32_t stage_insertions(const Positions &positions, Weights weights) {
        const span<const double> numbers = gathered(positions);
        const std::size_t count = count_of("positions", numbers);
        expect("weights", weights.numbers.size(), count);
        std::uint32_t first;
        const double *given = weights.numbers.data();
        require_ok(deldrift_stage_insertions_with_weights(native(), numbers.data(), given, count, &first));
        return first;
    }
    // For the next commit, under the ids of removed vertices, the lowest first, and then new ones; returns them. keys: one
    // for each, or none.
    std::vector<std::uint32_t> stage_insertions_at_free_ids(const Positions &positions,
                                                            span<const std::uint64_t> keys = {}) {
        const span<const double> numbers = gathered(positions);
        const std::size_t count = count_of("positions", numbers);
        if (!keys.empty()) expect("keys", keys.size(), count);
        std::vector<std::uint32_t> vertices(count);
        require_ok(deldrift_stage_insertions_at_free_ids(native(), numbers.data(), keys.empty() ? nullptr : keys.data(),
                                                         count, vertices.data()));
        return vertices;
    }
    void stage_removals(span<const std::uint32_t> vertices) {
        require_ok(deldrift_stage_removals(native(), vertices.data(), vertices.size()));
    }

    void relocate_vertex(std::uint32_t vertex, span<const double> position) {
        require_change(deldrift_relocate_vertex(native(), vertex, point(position)));
    }
    std::uint32_t insert_vertex(span<const double> position) {
        std::uint32_t vertex;
        require_change(deldrift_insert_vertex(native(), point(position), &vertex));
        return vertex;
    }
    std::uint32_t insert_vertex_with_key(span<const double> position, std::uint64_t key) {
        std::uint32_t vertex;
        require_change(deldrift_insert_vertex_with_key(native(), point(position), key, &vertex));
        return vertex;
    }
    // Whom it hides is in take_changes().hidden, if they were taken before.
    std::uint32_t insert_vertex_with_weight(span<const double> position, double weight) {
        std::uint32_t vertex;
        require_change(deldrift_insert_vertex_with_weight(native(), point(position), weight, &vertex));
        return vertex;
    }
    // By id; 0 for removed vertices.
    std::vector<std::uint64_t> keys() const {
        std::size_t count = id_count();
        std::vector<std::uint64_t> keys(count);
        require_ok(deldrift_keys(native(), keys.data(), count, &count));
        return keys;
    }
    void remove_vertex(std::uint32_t vertex) { require_change(deldrift_remove_vertex(native(), vertex)); }
    // The new id of each old one, DELDRIFT_NONE for removed vertices.
    std::vector<std::uint32_t> compact() {
        std::size_t count = id_count();
        std::vector<std::uint32_t> map(count);
        require_ok(deldrift_compact(native(), map.data(), count, &count));
        return map;
    }
    // Renumbers arrays as well, of one entry or more for each id:
    //     t.compact(temperatures, velocities);
    template <class T, class... Others>
    std::vector<std::uint32_t> compact(std::vector<T> &values, std::vector<Others> &...others) {
        const std::size_t n = id_count();
        for (const std::size_t size : {values.size(), others.size()...}) {
            if (n == 0 ? size != 0 : size % n != 0) {
                throw Error(DELDRIFT_WRONG_COUNT, "an array has " + std::to_string(size) +
                                                      " entries, but must have as many for each of " +
                                                      std::to_string(n) + " ids");
            }
        }
        const std::vector<std::uint32_t> map = compact();
        detail::renumber(values, map);
        (detail::renumber(others, map), ...);
        return map;
    }

    std::size_t vertex_count() const { return ask<std::size_t>(deldrift_vertex_count); }
    std::size_t id_count() const { return ask<std::size_t>(deldrift_id_count); }
    std::size_t cell_count() const { return ask<std::size_t>(deldrift_cell_count); }
    std::size_t staged_count() const { return ask<std::size_t>(deldrift_staged_count); }
    std::size_t memory_bytes() const { return ask<std::size_t>(deldrift_memory_bytes); }
    std::uint64_t timestamp() const { return ask<std::uint64_t>(deldrift_timestamp); }
    deldrift_commit_report statistics() const { return ask<deldrift_commit_report>(deldrift_statistics); }
    bool is_present(std::uint32_t vertex) const { return ask<bool>(deldrift_is_present, vertex); }

    std::vector<double> position(std::uint32_t vertex) const {
        std::vector<double> position(dimension_);
        require_ok(deldrift_position(native(), vertex, position.data()));
        return position;
    }
    // As an array: t.position<3>(vertex).
    template <std::size_t D>
    std::array<double, D> position(std::uint32_t vertex) const {
        expect_dimension(D);
        std::array<double, D> position;
        require_ok(deldrift_position(native(), vertex, position.data()));
        return position;
    }
    std::vector<double> positions() const {
        std::size_t count = id_count();
        std::vector<double> positions(count * dimension_);
        require_ok(deldrift_copy_positions(native(), positions.data(), count, &count));
        return positions;
    }
    template <std::size_t D>
    std::vector<std::array<double, D>> positions() const {
        static_assert(sizeof(std::array<double, D>) == D * sizeof(double));
        expect_dimension(D);
        std::size_t count = id_count();
        std::vector<std::array<double, D>> positions(count);
        double *const numbers = count == 0 ? nullptr : positions.front().data();
        require_ok(deldrift_copy_positions(native(), numbers, count, &count));
        return positions;
    }
    // The ids of the vertices that are present, in ascending order.
    Vertices vertices() const { return Vertices(native(), id_count(), vertex_count()); }
    Cells cells() const { return Cells(ask<deldrift_cells_view>(deldrift_cells)); }
    // The arrays that cells() shows, handed over: what cells() has given since the last change is valid for as long as
    // the result lives. The triangulation goes on with copies.
    [[nodiscard]] ReleasedCells release_cells() {
        deldrift_released_cells *owner = nullptr;
        deldrift_cells_view view;
        require_ok(deldrift_release_cells(native(), &view, &owner));
        return {owner, view};
    }
    // Since the last call; all lists end with the next change.
    deldrift_changes take_changes() {
        deldrift_changes changes;
        require_ok(deldrift_take_changes(native(), &changes));
        return changes;
    }
    // Brings means in cells over, by the latest take_changes(): values, n_values for each cell that there was at the
    // one before, become those of the cells that there are. positions: by id, where vertices were at last, before any
    // was removed; none for where they are.
    Transfer transfer_cells(std::vector<double> &values, std::size_t n_values = 1,
                            const Positions &positions = {},
                            deldrift_transfer_order order = DELDRIFT_TRANSFER_SECOND_ORDER) const {
        std::vector<double> gathered;
        const span<const double> numbers = positions.numbers("positions", dimension_, gathered);
        const std::size_t now = cell_count(), before = n_values == 0 ? now : values.size() / n_values;
        const std::size_t room = before < now ? now : before;
        expect("values", values.size(), before * n_values);
        Transfer made{deldrift_transfer_report{}, std::vector<double>(n_values), std::vector<double>(n_values)};
        values.resize(room * n_values);
        const deldrift_status status = deldrift_transfer_cells(
            native(), numbers.empty() ? nullptr : numbers.data(), count_of("positions", numbers), order, values.data(),
            before, n_values, room, &made.report, made.lost.data(), made.gained.data());
        values.resize((status == DELDRIFT_OK ? now : before) * n_values);
        require_ok(status);
        return made;
    }
    std::vector<std::uint32_t> star(std::uint32_t vertex) const {
        return found([&](std::uint32_t *cells, std::size_t capacity, std::size_t *count) {
            return deldrift_star(native(), vertex, cells, capacity, count);
        });
    }
    // The cells of the star, with their vertices and neighbours.
    Star cells_of(std::uint32_t vertex) const {
        return {star(vertex), coincident_representative(vertex), ask<deldrift_cells_view>(deldrift_cells)};
    }
    double tolerance(std::uint32_t vertex) const { return ask<double>(deldrift_tolerance, vertex); }

    // Of the cells, in the order of cells().
    Circumspheres circumcentres() const {
        std::size_t count = cell_count();
        Circumspheres spheres{std::vector<double>(count * dimension_), std::vector<double>(count)};
        require_ok(deldrift_circumcentres(native(), spheres.centres.data(), spheres.squared_radii.data(), count,
                                          &count));
        return spheres;
    }
    std::vector<double> volumes() const {
        std::size_t count = cell_count();
        std::vector<double> volumes(count);
        require_ok(deldrift_volumes(native(), volumes.data(), count, &count));
        return volumes;
    }
    std::vector<std::uint8_t> mask_by_circumradius(double squared_radius) const {
        std::size_t count = cell_count();
        std::vector<std::uint8_t> mask(count);
        require_ok(deldrift_mask_by_circumradius(native(), squared_radius, mask.data(), count, &count));
        return mask;
    }
    // Without the flat cells along the hull that the rounding of straight sides makes.
    std::vector<std::uint8_t> mask_without_flat_cells(double tolerance) const {
        std::size_t count = cell_count();
        std::vector<std::uint8_t> mask(count);
        require_ok(deldrift_mask_without_flat_cells(native(), tolerance, mask.data(), count, &count));
        return mask;
    }
    // Of the cells listed alone, in arrays for all cells that hold those of the others already.
    void update_circumcentres(span<const std::uint32_t> cells, Circumspheres &spheres) const {
        const std::size_t capacity = spheres.squared_radii.size();
        expect("centres", spheres.centres.size(), capacity * dimension_);
        require_ok(deldrift_update_circumcentres(native(), cells.data(), cells.size(), spheres.centres.data(),
                                                 spheres.squared_radii.data(), capacity));
    }
    void update_volumes(span<const std::uint32_t> cells, span<double> volumes) const {
        require_ok(deldrift_update_volumes(native(), cells.data(), cells.size(), volumes.data(), volumes.size()));
    }
    void update_mask_by_circumradius(span<const std::uint32_t> cells, double squared_radius,
                                     span<std::uint8_t> mask) const {
        require_ok(deldrift_update_mask_by_circumradius(native(), cells.data(), cells.size(), squared_radius,
                                                        mask.data(), mask.size()));
    }
    // Seen from outside. mask: a byte for each cell, 0 if it is not in the mask.
    Facets mask_boundary(span<const std::uint8_t> mask) const {
        return facets([&](std::uint32_t *vertices, std::uint32_t *cells, std::uint8_t *corners, std::size_t capacity,
                          std::size_t *count) {
            return deldrift_mask_boundary(native(), mask.data(), mask.size(), vertices, cells, corners, capacity,
                                          count);
        });
    }
    Facets hull_facets() const {
        return facets([&](std::uint32_t *vertices, std::uint32_t *cells, std::uint8_t *corners, std::size_t capacity,
                          std::size_t *count) {
            return deldrift_hull_facets(native(), vertices, cells, corners, capacity, count);
        });
    }

    Segments segments() const {
        std::size_t count = 0;
        require_ok(deldrift_segments(native(), nullptr, nullptr, nullptr, 0, &count));
        Segments segments{std::vector<std::uint32_t>(count), std::vector<Ends>(count), std::vector<std::int32_t>(count)};
        std::uint32_t *const ends = count == 0 ? nullptr : segments.ends.front().data();
        require_ok(deldrift_segments(native(), segments.ids.data(), ends, segments.markers.data(), count, &count));
        return segments;
    }
    // For which the latest change, or check, was refused; ConflictError has them, too.
    std::vector<deldrift_conflict> segment_conflicts() const {
        std::size_t count = 0;
        require_ok(deldrift_segment_conflicts(native(), nullptr, 0, &count));
        std::vector<deldrift_conflict> conflicts(count);
        require_ok(deldrift_segment_conflicts(native(), conflicts.data(), count, &count));
        return conflicts;
    }
    // In the step that was looked at last: with DELDRIFT_PASSING_TELL those that have passed in the latest commit.
    //     for (const auto [segment, vertex] : t.passings()) exchange_sides(vertex);
    std::vector<Passing> passings() const {
        std::size_t count = 0;
        require_ok(deldrift_passings(native(), nullptr, nullptr, 0, &count));
        std::vector<std::uint32_t> segments(count), vertices(count);
        require_ok(deldrift_passings(native(), segments.data(), vertices.data(), count, &count));
        std::vector<Passing> passings(count);
        for (std::size_t k = 0; k < count; ++k) passings[k] = {segments[k], vertices[k]};
        return passings;
    }
    // For each cell the segments opposite its corners, DELDRIFT_NONE where there is none.
    //     for (const auto &sides : t.segments_of_cells())
    //         for (const std::uint32_t segment : sides) n += segment != DELDRIFT_NONE;
    std::vector<std::array<std::uint32_t, 3>> segments_of_cells() const {
        std::size_t count = cell_count();
        std::vector<std::array<std::uint32_t, 3>> rows(count);
        std::uint32_t *const numbers = count == 0 ? nullptr : rows.front().data();
        require_ok(deldrift_segments_of_cells(native(), numbers, count, &count));
        return rows;
    }
    // For each segment the cells on its left and on its right, in the order of segments().
    std::vector<std::array<std::uint32_t, 2>> cells_of_segments() const {
        std::size_t count = 0;
        require_ok(deldrift_cells_of_segments(native(), nullptr, 0, &count));
        std::vector<std::array<std::uint32_t, 2>> rows(count);
        std::uint32_t *const numbers = count == 0 ? nullptr : rows.front().data();
        require_ok(deldrift_cells_of_segments(native(), numbers, count, &count));
        return rows;
    }
    // For each cell 0 if it is outside of all closed chains of segments, 1 in a domain, 2 in its holes.
    //     const std::vector<std::uint32_t> levels = t.nesting_levels();
    //     const auto is_in_domain = [&](std::size_t cell) { return levels[cell] % 2 == 1; };
    std::vector<std::uint32_t> nesting_levels() const {
        std::size_t count = cell_count();
        std::vector<std::uint32_t> levels(count);
        require_ok(deldrift_nesting_levels(native(), levels.data(), count, &count));
        return levels;
    }
    // For each cell the least number of segments on a path to the outside, each of several at one edge: an odd one is what the
    // even-odd rule fills.
    //     const std::vector<std::uint32_t> numbers = t.crossing_numbers();
    //     const auto is_filled = [&](std::size_t cell) { return numbers[cell] % 2 == 1; };
    std::vector<std::uint32_t> crossing_numbers() const {
        std::size_t count = cell_count();
        std::vector<std::uint32_t> numbers(count);
        require_ok(deldrift_crossing_numbers(native(), numbers.data(), count, &count));
        return numbers;
    }
    // For each cell the label of the first seed in its region, or the other one.
    //     const std::vector<std::int32_t> materials = t.label_cells({0.5, 0.5, 3.0, 1.0}, {STEEL, WATER}, AIR);
    std::vector<std::int32_t> label_cells(const Positions &seeds, span<const std::int32_t> labels,
                                          std::int32_t other) const {
        std::vector<double> room;
        const span<const double> numbers = seeds.numbers("seeds", dimension_, room);
        expect("labels", labels.size(), count_of("seeds", numbers));
        std::size_t count = cell_count();
        std::vector<std::int32_t> label_of(count);
        require_ok(deldrift_label_cells(native(), numbers.data(), labels.data(), labels.size(), other, label_of.data(),
                                        count, &count));
        return label_of;
    }
    // Labels that follow the regions from now on, one for each cell, such as label_cells() gives; none takes them away.
    //     t.set_regions(t.label_cells({0.5, 0.5, 3.0, 1.0}, {STEEL, WATER}, AIR));
    //     const std::vector<std::int32_t> materials = t.regions(AIR).labels;  // after any number of steps
    void set_regions(span<const std::int32_t> labels) {
        require_ok(deldrift_set_regions(native(), labels.size() == 0 ? nullptr : labels.data(), labels.size()));
    }
    // Labels of the sides of segments: on the left, as seen from the first end, and on the right.
    void set_segment_sides(span<const std::uint32_t> segments, span<const std::array<std::int32_t, 2>> sides) {
        expect("sides", sides.size(), segments.size());
        require_ok(deldrift_set_segment_sides(native(), segments.data(), sides.size() == 0 ? nullptr : sides.data()->data(),
                                              segments.size()));
    }
    // The label of the region of each cell, the other one where the sides of its segments have none, and of how many cells
    // these do not tell.
    Regions regions(std::int32_t other = 0) const {
        std::size_t count = cell_count();
        Regions found;
        found.labels.resize(count);
        require_ok(deldrift_regions(native(), other, found.labels.data(), count, &count, &found.undecided));
        return found;
    }
    // Of the cells listed alone, in an array for all cells: the label of those of the others that each is reached from without
    // crossing a segment, or the other one. Returns for how many labels cannot tell: if it is not 0, label anew. The cells
    // are those that take_changes() tells as created, and those whose rows list the corners in the other order around.
    std::size_t update_labels(span<const std::uint32_t> cells, std::int32_t other, span<std::int32_t> label_of) const {
        std::size_t undecided;
        require_ok(deldrift_update_labels(native(), cells.data(), cells.size(), other, label_of.data(), label_of.size(),
                                          &undecided));
        return undecided;
    }
    // The boundary of the cells in a mask, which are on the left of the edges of its chains.
    Chains boundary_chains(span<const std::uint8_t> mask) const {
        std::size_t count = 0;
        require_ok(deldrift_boundary_chains(native(), mask.data(), mask.size(), nullptr, nullptr, nullptr, nullptr, nullptr,
                                            0, &count));
        Chains chains;
        std::vector<std::uint32_t> chain_of(count);
        chains.vertices.resize(count);
        chains.segments.resize(count);
        chains.cells.resize(count);
        chains.corners.resize(count);
        require_ok(deldrift_boundary_chains(native(), mask.data(), mask.size(), chains.vertices.data(), chain_of.data(),
                                            chains.segments.data(), chains.cells.data(), chains.corners.data(), count,
                                            &count));
        for (std::size_t k = 1; k <= count; k++) {
            if (k == count || chain_of[k] != chain_of[k - 1]) chains.offsets.push_back(k);
        }
        return chains;
    }

    // Inserts vertices until cells are of a quality, in one commit: those in the mask, which has to end at segments, or,
    // if it is empty, those of an odd nesting level.
    //     for (;;) {
    //         t.commit_positions(positions_after_step());
    //         t.coarsen(quality);
    //         t.refine(quality);
    //         t.carry(temperatures);
    //     }
    deldrift_quality_report refine(const Quality &quality, span<const std::uint8_t> mask = {}) {
        return improve(deldrift_refine, quality, mask);
    }
    // Removes vertices that refine() has inserted and that are not needed any more.
    deldrift_quality_report coarsen(const Quality &quality, span<const std::uint8_t> mask = {}) {
        return improve(deldrift_coarsen, quality, mask);
    }
    MadeVertices made_vertices() const {
        std::size_t count = 0;
        require_ok(deldrift_made_vertices(native(), nullptr, nullptr, 0, &count));
        MadeVertices made{std::vector<std::uint32_t>(count), std::vector<std::uint32_t>(count)};
        require_ok(deldrift_made_vertices(native(), made.vertices.data(), made.segments.data(), count, &count));
        return made;
    }
    // For each of segments() the one that it is a piece of; itself if it is whole.
    std::vector<std::uint32_t> original_segments() const {
        std::size_t count = 0;
        require_ok(deldrift_original_segments(native(), nullptr, 0, &count));
        std::vector<std::uint32_t> originals(count);
        require_ok(deldrift_original_segments(native(), originals.data(), count, &count));
        return originals;
    }
    // None unless the quality of the last change, a refine(), asked for them.
    RefinedWeights refined_weights() const {
        std::size_t count = 0;
        require_ok(deldrift_refined_weights(native(), nullptr, nullptr, 0, &count));
        RefinedWeights rows;
        if (count == 0) return rows;
        rows.ids = refined_vertices();
        rows.vertices.resize(count);
        rows.weights.resize(count);
        require_ok(deldrift_refined_weights(native(), rows.vertices.front().data(), rows.weights.front().data(), count,
                                            &count));
        return rows;
    }
    // Those that the last change, a refine(), inserted, ascending.
    std::vector<std::uint32_t> refined_vertices() const {
        std::size_t count = 0;
        require_ok(deldrift_refined_vertices(native(), nullptr, 0, &count));
        std::vector<std::uint32_t> vertices(count);
        require_ok(deldrift_refined_vertices(native(), vertices.data(), count, &count));
        return vertices;
    }
    // The sizes of the vertices that the last change, a refine() with sizes, inserted: with those given a second one
    // finds nothing to do.
    std::vector<double> refined_sizes() const {
        std::size_t count = 0;
        require_ok(deldrift_refined_sizes(native(), nullptr, 0, &count));
        std::vector<double> sizes(count);
        require_ok(deldrift_refined_sizes(native(), sizes.data(), count, &count));
        return sizes;
    }
    // Enters into values, n_values numbers for each id that there was before the last refine(), those of the vertices
    // that it has inserted. Numbers that are linear in the position stay so, those from before a coarsen() ahead of it, too.
    void carry(std::vector<double> &values, std::size_t n_values = 1) const {
        const RefinedWeights rows = refined_weights();
        const std::size_t most = id_count();
        // Vertices that have new ids have the last ones.
        std::size_t least = most;
        for (std::size_t k = rows.size(); k-- > 0 && rows.ids[k] + 1 == least;) least--;
        if (values.size() < least * n_values || values.size() > most * n_values || values.size() % n_values != 0) {
            throw Error(DELDRIFT_WRONG_COUNT, "values has " + std::to_string(values.size()) +
                                                  " numbers, but must have " + std::to_string(n_values) + " for each id that there was, from " +
                                                  std::to_string(least) + " to " + std::to_string(most) +
                                                  ", as weights are known of " + std::to_string(rows.size()) +
                                                  " new vertices");
        }
        rows.carry(values, n_values);
    }

    // Rows of two ids, the lower one first, in lexicographic order.
    std::vector<std::uint32_t> edges() const {
        std::size_t count = 0;
        require_ok(deldrift_edges(native(), nullptr, 0, &count));
        std::vector<std::uint32_t> edges(2 * count);
        require_ok(deldrift_edges(native(), edges.data(), count, &count));
        return edges;
    }
    // The vectors of the box, one after the other; none of a triangulation that is not periodic.
    std::vector<double> vectors() const {
        std::size_t count = 0;
        require_ok(deldrift_vectors(native(), nullptr, 0, &count));
        std::vector<double> vectors(dimension_ * count);
        require_ok(deldrift_vectors(native(), vectors.data(), count, &count));
        return vectors;
    }
    // The shortest vectors of the lattice, the multiples of those of the box that each is the sum of, and how often the place
    // of a neighbour is translated by it at most.
    ReducedVectors reduced_vectors() const {
        std::size_t count = 0;
        require_ok(deldrift_reduced_vectors(native(), nullptr, nullptr, nullptr, 0, &count));
        ReducedVectors reduced{std::vector<double>(dimension_ * count), std::vector<std::int64_t>(dimension_ * count),
                               std::vector<std::uint32_t>(count)};
        require_ok(deldrift_reduced_vectors(native(), reduced.vectors.data(), reduced.multiples.data(),
                                            reduced.greatest.data(), count, &count));
        return reduced;
    }
    // Positions in the unit cell of the reduced vectors, or in the period that is nearest to an entry of previous, if given,
    // and by which multiples of the vectors of the box they are translated from there.
    WrappedPositions wrap_positions(const Positions &positions, const Positions &previous = {}) const {
        std::vector<double> room, room_of_previous;
        const span<const double> numbers = positions.numbers("positions", dimension_, room);
        const span<const double> before = previous.numbers("previous", dimension_, room_of_previous);
        const std::size_t count = count_of("positions", numbers);
        if (!before.empty()) expect("previous", before.size(), numbers.size());
        WrappedPositions wrapped{std::vector<double>(numbers.size()), std::vector<std::int64_t>(numbers.size())};
        require_ok(deldrift_wrap_positions(native(), numbers.data(), before.empty() ? nullptr : before.data(), count,
                                           wrapped.places.data(), wrapped.shifts.data()));
        return wrapped;
    }
    // Rows of multiples of the vectors, by which the corners of cells are translated from their positions, and by which the
    // neighbours opposite them are from where their own shifts have them.
    CellShifts cell_shifts() const {
        std::size_t count = cell_count();
        const std::size_t size = count * (dimension_ + 1) * dimension_;
        CellShifts shifts{std::vector<std::int64_t>(size), std::vector<std::int64_t>(size)};
        require_ok(deldrift_cell_shifts(native(), shifts.corners.data(), shifts.neighbours.data(), count, &count));
        return shifts;
    }
    // By which multiples of the vectors the second vertex of each edge is translated where the first one is at its position.
    std::vector<std::int64_t> edge_shifts() const {
        std::size_t count = 0;
        require_ok(deldrift_edge_shifts(native(), nullptr, 0, &count));
        std::vector<std::int64_t> shifts(dimension_ * count);
        require_ok(deldrift_edge_shifts(native(), shifts.data(), count, &count));
        return shifts;
    }
    Lists vertex_neighbours() const { return lists(deldrift_vertex_neighbours); }
    Lists vertex_cells() const { return lists(deldrift_vertex_cells); }
    // A cell of each id, DELDRIFT_NONE where there is none.
    std::vector<std::uint32_t> cell_of_each_vertex() const {
        std::size_t count = id_count();
        std::vector<std::uint32_t> cells(count);
        require_ok(deldrift_cell_of_each_vertex(native(), cells.data(), count, &count));
        return cells;
    }
    // For each row of vertices a cell that has all of them as corners, DELDRIFT_NONE where there is none.
    std::vector<std::uint32_t> find_simplices(std::uint32_t corners_per_simplex,
                                              span<const std::uint32_t> vertices) const {
        const std::size_t count = vertices.size() / (corners_per_simplex == 0 ? 1 : corners_per_simplex);
        expect("vertices", vertices.size(), count * corners_per_simplex);
        std::vector<std::uint32_t> cells(count);
        require_ok(deldrift_find_simplices(native(), corners_per_simplex, vertices.data(), count, cells.data()));
        return cells;
    }
    // Hidden vertices have the edges of those that represent them.
    bool is_edge(std::uint32_t vertex, std::uint32_t other) const {
        const std::uint32_t edge[] = {vertex, other};
        return find_simplices(2, edge)[0] != DELDRIFT_NONE;
    }
    // For each corner of each cell, 255 for facets of the hull.
    std::vector<std::uint8_t> mirror_indices() const {
        std::size_t count = cell_count();
        std::vector<std::uint8_t> mirrors(count * (dimension_ + std::size_t{1}));
        require_ok(deldrift_mirror_indices(native(), mirrors.data(), count, &count));
        return mirrors;
    }
    // DELDRIFT_NONE for a facet of the hull.
    std::uint32_t mirror_index(std::uint32_t cell, std::uint32_t corner) const {
        return ask<std::uint32_t>(deldrift_mirror_index, cell, corner);
    }
    // Counter-clockwise; in 2D.
    std::vector<std::uint32_t> ordered_star(std::uint32_t vertex) const {
        std::size_t count = 0;
        require_ok(deldrift_ordered_star(native(), vertex, nullptr, 0, &count));
        std::vector<std::uint32_t> star(count);
        require_ok(deldrift_ordered_star(native(), vertex, star.data(), count, &count));
        return star;
    }
    // Those with at least one of the vertices as a corner, in ascending order.
    std::vector<std::uint32_t> cells_around(span<const std::uint32_t> vertices) const {
        // Room for stars of common size, and for all cells at most.
        const std::size_t most = cell_count(), per_vertex = dimension_ == 2 ? 8 : 32;
        std::vector<std::uint32_t> cells(vertices.size() < most / per_vertex ? vertices.size() * per_vertex : most);
        std::size_t count = 0;
        deldrift_status status = around(vertices, cells, count);
        if (status == DELDRIFT_BUFFER_TOO_SMALL) {
            cells.resize(count);
            status = around(vertices, cells, count);
        }
        require_ok(status);
        cells.resize(count);
        return cells;
    }
    // Of all ids, within the box from low to high; without a box, infinite on the hull.
    std::vector<double> voronoi_volumes(span<const double> low = {}, span<const double> high = {}) const {
        std::size_t count = id_count();
        std::vector<double> volumes(count);
        require_ok(deldrift_voronoi_volumes(native(), corner("low", low), corner("high", high), volumes.data(), count,
                                            &count));
        return volumes;
    }
    // Of all edges, in their order.
    std::vector<double> voronoi_facets(span<const double> low = {}, span<const double> high = {}) const {
        std::size_t count = 0;
        require_ok(deldrift_edges(native(), nullptr, 0, &count));
        std::vector<double> measures(count);
        require_ok(deldrift_voronoi_facets(native(), corner("low", low), corner("high", high), measures.data(), count,
                                           &count));
        return measures;
    }
    // For each id 1 if its Voronoi cell may have changed by the changes taken last, as these vertices have moved; else 0.
    std::vector<std::uint8_t> voronoi_changed(span<const std::uint32_t> moved) const {
        std::size_t count = id_count();
        std::vector<std::uint8_t> mask(count);
        require_ok(deldrift_voronoi_changed(native(), moved.data(), moved.size(), mask.data(), count, &count));
        return mask;
    }
    // Of all ids, within the box from low to high; where the triangulation is periodic, these are infinite along axes along which
    // vectors go, or empty. With a mask, a byte for each id, of those where it is not 0 alone, NaN for the others.
    VoronoiCells voronoi_cells(span<const double> low = {}, span<const double> high = {},
                               span<const std::uint8_t> mask = {}) const {
        return voronoi_cells_within(low, high, {}, mask);
    }
    // Also within half-spaces: for each the coordinates of an outward normal, which is perpendicular to the vectors where the
    // triangulation is periodic, and an offset.
    VoronoiCells voronoi_cells_within(span<const double> low, span<const double> high, const Positions &half_spaces,
                                      span<const std::uint8_t> mask = {}) const {
        std::vector<double> room;
        const span<const double> numbers = half_spaces.rows("half_spaces", dimension_ + 1, room);
        const std::size_t rows = numbers.size() / (dimension_ + 1);
        expect("half_spaces", numbers.size(), rows * (dimension_ + 1));
        std::size_t count = id_count();
        const double nan = std::numeric_limits<double>::quiet_NaN();
        VoronoiCells cells{std::vector<double>(count, nan), std::vector<double>(count, nan),
                           std::vector<double>(count * dimension_, nan)};
        require_ok(deldrift_voronoi_cells_within(native(), corner("low", low), corner("high", high), numbers.data(),
                                                 rows, mask.empty() ? nullptr : mask.data(), mask.size(),
                                                 cells.volumes.data(), cells.areas.data(), cells.centroids.data(), count,
                                                 &count));
        return cells;
    }
    // Of all edges, in their order; with a mask, of those that have an end where it is not 0.
    VoronoiDerivatives voronoi_derivatives(span<const double> low = {}, span<const double> high = {},
                                           span<const std::uint8_t> mask = {}) const {
        return voronoi_derivatives_within(low, high, {}, mask);
    }
    // Also within half-spaces: for each the coordinates of an outward normal, and an offset.
    VoronoiDerivatives voronoi_derivatives_within(span<const double> low, span<const double> high,
                                                  const Positions &half_spaces,
                                                  span<const std::uint8_t> mask = {}) const {
        std::vector<double> room;
        const span<const double> numbers = half_spaces.rows("half_spaces", dimension_ + 1, room);
        const std::size_t rows = numbers.size() / (dimension_ + 1);
        expect("half_spaces", numbers.size(), rows * (dimension_ + 1));
        std::size_t count = 0;
        require_ok(deldrift_edges(native(), nullptr, 0, &count));
        const double nan = std::numeric_limits<double>::quiet_NaN();
        VoronoiDerivatives facets{std::vector<double>(count, nan), std::vector<double>(count * dimension_, nan),
                                  std::vector<double>(count * 2 * dimension_, nan)};
        require_ok(deldrift_voronoi_derivatives_within(native(), corner("low", low), corner("high", high),
                                                       numbers.data(), rows, mask.empty() ? nullptr : mask.data(),
                                                       mask.size(), facets.measures.data(), facets.centroids.data(),
                                                       facets.derivatives.data(), count, &count));
        return facets;
    }
    // Both, in one call, with circumcentres computed once.
    std::pair<VoronoiCells, VoronoiDerivatives> voronoi_cells_and_facets(span<const double> low = {},
                                                                         span<const double> high = {},
                                                                         span<const double> half_spaces = {},
                                                                         span<const std::uint8_t> mask = {}) const {
        const std::size_t rows = half_spaces.size() / (dimension_ + 1);
        expect("half_spaces", half_spaces.size(), rows * (dimension_ + 1));
        std::size_t count = id_count(), edges = 0;
        require_ok(deldrift_edges(native(), nullptr, 0, &edges));
        const double nan = std::numeric_limits<double>::quiet_NaN();
        VoronoiCells cells{std::vector<double>(count, nan), std::vector<double>(count, nan),
                           std::vector<double>(count * dimension_, nan)};
        VoronoiDerivatives facets{std::vector<double>(edges, nan), std::vector<double>(edges * dimension_, nan),
                                  std::vector<double>(edges * 2 * dimension_, nan)};
        require_ok(deldrift_voronoi_cells_and_facets(
            native(), corner("low", low), corner("high", high), half_spaces.data(), rows,
            mask.empty() ? nullptr : mask.data(), mask.size(), cells.volumes.data(), cells.areas.data(),
            cells.centroids.data(), count, &count, facets.measures.data(), facets.centroids.data(),
            facets.derivatives.data(), edges, &edges));
        return {std::move(cells), std::move(facets)};
    }
    // What Newton's method needs that looks for weights with which cells have prescribed volumes.
    VoronoiWeightDerivatives voronoi_weight_derivatives(span<const double> low = {}, span<const double> high = {},
                                                        const Positions &half_spaces = {},
                                                        span<const std::uint8_t> mask = {}) const {
        std::vector<double> room;
        const span<const double> numbers = half_spaces.rows("half_spaces", dimension_ + 1, room);
        const std::size_t rows = numbers.size() / (dimension_ + 1);
        expect("half_spaces", numbers.size(), rows * (dimension_ + 1));
        std::size_t count = id_count(), edges = 0;
        require_ok(deldrift_edges(native(), nullptr, 0, &edges));
        const double nan = std::numeric_limits<double>::quiet_NaN();
        VoronoiWeightDerivatives made{std::vector<double>(count, nan), std::vector<double>(edges, nan)};
        require_ok(deldrift_voronoi_weight_derivatives(native(), corner("low", low), corner("high", high),
                                                       numbers.data(), rows, mask.empty() ? nullptr : mask.data(),
                                                       mask.size(), made.volumes.data(), count, &count,
                                                       made.derivatives.data(), edges, &edges));
        return made;
    }
    // values: n_values numbers for each id. outside: those of positions outside the hull, NaN if there are none.
    std::vector<double> interpolate(deldrift_interpolation method, span<const double> values, std::size_t n_values,
                                    const Positions &positions, span<const double> outside = {},
                                    const deldrift_location *hint = nullptr) const {
        std::vector<double> room;
        const span<const double> numbers = positions.numbers("positions", dimension_, room);
        const std::size_t ids = id_count(), count = count_of("positions", numbers);
        expect("values", values.size(), ids * n_values);
        if (!outside.empty()) expect("outside", outside.size(), n_values);
        std::vector<double> results(count * n_values);
        require_ok(deldrift_interpolate(native(), method, values.data(), ids, n_values, numbers.data(), count, hint,
                                        outside.empty() ? nullptr : outside.data(), results.data()));
        return results;
    }

    // Rows of weights, one for each corner of the cell of each position; NaN where that is DELDRIFT_NONE.
    std::vector<double> barycentric(const Positions &positions, span<const std::uint32_t> cells) const {
        std::vector<double> room;
        const span<const double> numbers = positions.numbers("positions", dimension_, room);
        const std::size_t count = count_of("positions", numbers);
        expect("cells", cells.size(), count);
        std::vector<double> weights(count * (dimension_ + std::size_t{1}));
        require_ok(deldrift_barycentric(native(), numbers.data(), cells.data(), count, weights.data()));
        return weights;
    }

    deldrift_location locate(span<const double> position) const {
        return ask<deldrift_location>(deldrift_locate, point(position));
    }
    // Faster if each point is near the one before it, and the first one near the hint.
    std::vector<deldrift_location> locate_points(const Positions &positions,
                                                 const deldrift_location *hint = nullptr) const {
        // Not gathered(): several threads may be here.
        std::vector<double> room;
        const span<const double> numbers = positions.numbers("positions", dimension_, room);
        std::vector<deldrift_location> locations(count_of("positions", numbers));
        require_ok(deldrift_locate_points(native(), numbers.data(), locations.size(), hint, locations.data()));
        return locations;
    }
    // And in which period what is there is.
    PeriodLocations locate_in_period(const Positions &positions, const deldrift_location *hint = nullptr) const {
        std::vector<double> room;
        const span<const double> numbers = positions.numbers("positions", dimension_, room);
        const std::size_t count = count_of("positions", numbers);
        PeriodLocations found{std::vector<deldrift_location>(count), std::vector<std::int64_t>(count * dimension_)};
        require_ok(deldrift_locate_in_period(native(), numbers.data(), count, hint, found.locations.data(),
                                             found.shifts.data()));
        return found;
    }
    // DELDRIFT_NONE if there are no vertices.
    std::uint32_t nearest_vertex(span<const double> position) const {
        return ask<std::uint32_t>(deldrift_nearest_vertex, point(position));
    }
    // Rows of k ids for each position, by distance; DELDRIFT_NONE where there are no more vertices.
    std::vector<std::uint32_t> nearest_vertices(const Positions &positions, std::size_t k) const {
        std::vector<double> room;
        const span<const double> numbers = positions.numbers("positions", dimension_, room);
        const std::size_t count = count_of("positions", numbers);
        std::vector<std::uint32_t> vertices(count * k);
        require_ok(deldrift_nearest_vertices(native(), numbers.data(), count, k, vertices.data()));
        return vertices;
    }
    // In ascending order, hidden vertices included.
    std::vector<std::uint32_t> vertices_in_ball(span<const double> centre, double squared_radius) const {
        expect("centre", centre.size(), dimension_);
        return found([&](std::uint32_t *vertices, std::size_t capacity, std::size_t *count) {
            return deldrift_vertices_in_ball(native(), centre.data(), squared_radius, vertices, capacity, count);
        });
    }
    // For each vertex those near it, ascending: within the square of a radius, one for all or one for each id. A mask has an entry
    // for each id, and an empty one is none.
    NeighbourLists neighbour_lists(span<const double> squared_radii, deldrift_pairs pairs = DELDRIFT_PAIRS_FULL,
                                   span<const std::uint8_t> mask = {}) const {
        NeighbourLists lists;
        neighbour_lists(squared_radii, lists, pairs, mask);
        return lists;
    }
    // That, in the memory of lists that have been filled before: so a step takes one search.
    void neighbour_lists(span<const double> squared_radii, NeighbourLists &lists,
                         deldrift_pairs pairs = DELDRIFT_PAIRS_FULL, span<const std::uint8_t> mask = {}) const {
        const std::uint8_t *const chosen = mask.size() == 0 ? nullptr : mask.data();
        const std::size_t of_each = vectors().empty() ? 0 : dimension_;
        lists.offsets.resize(id_count() + 1);
        lists.neighbours.resize(lists.neighbours.capacity());
        for (std::size_t count = 0;;) {
            const std::size_t room = lists.neighbours.size();
            lists.shifts.resize(of_each * room);
            const deldrift_status status = deldrift_neighbour_lists(
                native(), squared_radii.data(), squared_radii.size(), chosen, mask.size(), pairs, lists.offsets.data(),
                lists.offsets.size(), room == 0 ? nullptr : lists.neighbours.data(),
                room == 0 || of_each == 0 ? nullptr : lists.shifts.data(), room, &count);
            if (status == DELDRIFT_BUFFER_TOO_SMALL || (status == DELDRIFT_OK && count > room)) {
                lists.neighbours.resize(count + count / 16);
                continue;
            }
            if (status != DELDRIFT_OK) lists = NeighbourLists{};
            require_ok(status);
            lists.neighbours.resize(count);
            lists.shifts.resize(of_each * count);
            return;
        }
    }
    // In ascending order, hidden vertices included; sides of the box may be infinite.
    std::vector<std::uint32_t> vertices_in_box(span<const double> low, span<const double> high) const {
        expect("low", low.size(), dimension_);
        expect("high", high.size(), dimension_);
        return found([&](std::uint32_t *vertices, std::size_t capacity, std::size_t *count) {
            return deldrift_vertices_in_box(native(), low.data(), high.data(), vertices, capacity, count);
        });
    }
    // The cells that a vertex at a place in a box could change, with balls that certainly cover their discs or balls. Corners
    // of boxes come one after the other, and may be infinite; a mask has an entry for each id, and an empty one is none.
    InReach cells_in_reach(const Positions &low, const Positions &high, span<const std::uint8_t> mask = {}) const {
        const Boxes boxes(low, high, dimension_);
        const std::uint8_t *const chosen = mask.size() == 0 ? nullptr : mask.data();
        InReach reach;
        reach.cells = found([&](std::uint32_t *cells, std::size_t capacity, std::size_t *count) {
            reach.centres.resize(capacity * dimension_);
            reach.radii.resize(capacity);
            return deldrift_cells_in_reach(native(), boxes.low.data(), boxes.high.data(), boxes.count, chosen,
                                           mask.size(), cells, reach.centres.data(), reach.radii.data(), capacity, count);
        });
        reach.centres.resize(reach.cells.size() * dimension_);
        reach.radii.resize(reach.cells.size());
        return reach;
    }
    // The facets of the convex hull that a place in a box is strictly beyond, without their vertices.
    Facets hull_facets_in_reach(const Positions &low, const Positions &high,
                                span<const std::uint8_t> mask = {}) const {
        const Boxes boxes(low, high, dimension_);
        const std::uint8_t *const chosen = mask.size() == 0 ? nullptr : mask.data();
        Facets facets{};
        facets.cells = found([&](std::uint32_t *cells, std::size_t capacity, std::size_t *count) {
            facets.corners.resize(capacity);
            return deldrift_hull_facets_in_reach(native(), boxes.low.data(), boxes.high.data(), boxes.count, chosen,
                                                 mask.size(), cells, facets.corners.data(), capacity, count);
        });
        facets.corners.resize(facets.cells.size());
        return facets;
    }
    // For each box the vertices of the cells and hull facets in its reach, in ascending order, hidden vertices included.
    BoxLists vertices_in_reach(const Positions &low, const Positions &high,
                               span<const std::uint8_t> mask = {}) const {
        const Boxes boxes(low, high, dimension_);
        const std::uint8_t *const chosen = mask.size() == 0 ? nullptr : mask.data();
        BoxLists lists;
        lists.offsets.resize(boxes.count + 1);
        lists.vertices = found([&](std::uint32_t *vertices, std::size_t capacity, std::size_t *count) {
            return deldrift_vertices_in_reach(native(), boxes.low.data(), boxes.high.data(), boxes.count, chosen,
                                              mask.size(), vertices, lists.offsets.data(), capacity, count);
        });
        return lists;
    }
    // The cells that the insertion of a vertex would remove.
    std::vector<std::uint32_t> conflicts(span<const double> position, const deldrift_location *hint = nullptr) const {
        return found([&](std::uint32_t *cells, std::size_t capacity, std::size_t *count) {
            return deldrift_conflicts(native(), point(position), hint, cells, capacity, count);
        });
    }
    Hidden hidden_vertices() const {
        std::size_t count = 0;
        require_ok(deldrift_hidden_vertices(native(), nullptr, nullptr, 0, &count));
        Hidden hidden{std::vector<std::uint32_t>(count), std::vector<std::uint32_t>(count)};
        require_ok(deldrift_hidden_vertices(native(), hidden.vertices.data(), hidden.representatives.data(), count,
                                            &count));
        return hidden;
    }
    // Vertices that are corners of no cell, as the weights of others are greater.
    HiddenByWeight hidden_by_weight() const {
        std::size_t count = 0;
        require_ok(deldrift_hidden_by_weight(native(), nullptr, nullptr, 0, &count));
        HiddenByWeight hidden{std::vector<std::uint32_t>(count), std::vector<std::uint32_t>(count)};
        require_ok(deldrift_hidden_by_weight(native(), hidden.vertices.data(), hidden.cells.data(), count, &count));
        return hidden;
    }
    std::uint32_t coincident_representative(std::uint32_t vertex) const {
        return ask<std::uint32_t>(deldrift_coincident_representative, vertex);
    }
    void validate(std::uint32_t level) const { require_ok(deldrift_validate(native(), level)); }

private:
    struct Destroy {
        void operator()(deldrift_triangulation *t) const noexcept { deldrift_destroy(t); }
    };

    static void require_ok(deldrift_status status) {
        if (status != DELDRIFT_OK) throw Error(status);
    }
    // Of calls that segments may refuse.
    void require_change(deldrift_status status) const {
        if (status == DELDRIFT_PASSES_SEGMENT) {
            const std::string message = deldrift_last_error();
            throw PassingError(message, passings());
        }
        if (!ConflictError::is_conflict(status)) return require_ok(status);
        const std::string message = deldrift_last_error();
        throw ConflictError(status, message, segment_conflicts());
    }
    template <class Call>
    deldrift_quality_report improve(Call call, const Quality &quality, span<const std::uint8_t> mask) {
        detail::GivenQuality given(quality);
        deldrift_quality_report report;
        const deldrift_status status = call(native(), given.get(), mask.data(), mask.size(), &report);
        given.throw_again();
        require_change(status);
        return report;
    }
    static void expect(const char *argument, std::size_t given, std::size_t wanted) {
        if (given == wanted) return;
        throw Error(DELDRIFT_WRONG_COUNT, argument + (" has " + std::to_string(given)) + " numbers, but must have " +
                                              std::to_string(wanted));
    }
    // What C reads of fields for n vertices or cells.
    static std::vector<deldrift_field> fields_of(const std::vector<Field> &fields, std::size_t n) {
        std::vector<deldrift_field> read;
        for (const Field &field : fields) {
            expect(field.name.c_str(), field.values.size(), n * field.components);
            read.push_back({field.name.c_str(), field.values.data(), field.components});
        }
        return read;
    }
    void expect_dimension(std::size_t given) const {
        if (given == dimension_) return;
        throw Error(DELDRIFT_WRONG_COUNT, "positions of " + std::to_string(given) +
                                              " coordinates, but the dimension is " + std::to_string(dimension_));
    }
    // What a query writes to its last argument.
    template <class T, class Query, class... Arguments>
    T ask(Query query, Arguments... arguments) const {
        T answer{};
        require_ok(query(native(), arguments..., &answer));
        return answer;
    }
    // What a function finds, where there is room at once for a common number.
    template <class List>
    static std::vector<std::uint32_t> found(List list) {
        std::vector<std::uint32_t> found(64);
        std::size_t count = 0;
        deldrift_status status = list(found.data(), found.size(), &count);
        found.resize(count);
        if (status == DELDRIFT_BUFFER_TOO_SMALL) status = list(found.data(), count, &count);
        require_ok(status);
        return found;
    }
    // The facets that a function lists, of which it first tells the number.
    template <class List>
    Facets facets(List list) const {
        std::size_t count = 0;
        require_ok(list(nullptr, nullptr, nullptr, 0, &count));
        Facets facets{std::vector<std::uint32_t>(count * dimension_), std::vector<std::uint32_t>(count),
                      std::vector<std::uint8_t>(count)};
        require_ok(list(facets.vertices.data(), facets.cells.data(), facets.corners.data(), count, &count));
        return facets;
    }
    deldrift_status around(span<const std::uint32_t> vertices, span<std::uint32_t> cells, std::size_t &count) const {
        return deldrift_cells_around(native(), vertices.data(), vertices.size(), cells.data(), cells.size(), &count);
    }
    // Lists by vertex, of which a function first tells the number of entries.
    template <class List>
    Lists lists(List list) const {
        std::size_t count = 0;
        require_ok(list(native(), nullptr, 0, nullptr, 0, &count));
        Lists lists{std::vector<std::uint32_t>(id_count() + 1), std::vector<std::uint32_t>(count)};
        require_ok(list(native(), lists.offsets.data(), lists.offsets.size(), lists.entries.data(), count, &count));
        return lists;
    }
    // A corner of a box, or nothing.
    const double *corner(const char *argument, span<const double> position) const {
        if (position.empty()) return nullptr;
        expect(argument, position.size(), dimension_);
        return position.data();
    }
    // In the arrangement of deldrift.h, until the next call.
    span<const double> gathered(const Positions &positions) {
        return positions.numbers("positions", dimension_, room_);
    }
    const double *point(span<const double> position) const {
        expect("position", position.size(), dimension_);
        return position.data();
    }
    std::size_t count_of(const char *argument, span<const double> positions) const {
        return count_of(argument, positions, dimension_);
    }
    static std::size_t count_of(const char *argument, span<const double> positions, std::uint32_t dimension) {
        const std::size_t count = positions.size() / (dimension == 0 ? 1 : dimension);
        expect(argument, positions.size(), count * dimension);
        return count;
    }
    // Corners of boxes, one after the other.
    struct Boxes {
        Boxes(const Positions &lows, const Positions &highs, std::uint32_t dimension)
            : low(lows.numbers("low", dimension, room_of_low)), high(highs.numbers("high", dimension, room_of_high)),
              count(count_of("low", low, dimension)) {
            expect("high", high.size(), low.size());
        }
        Boxes(const Boxes &) = delete;
        Boxes &operator=(const Boxes &) = delete;
        std::vector<double> room_of_low{}, room_of_high{};
        span<const double> low, high;
        std::size_t count;
    };

    std::unique_ptr<deldrift_triangulation, Destroy> t_{};
    std::uint32_t dimension_ = 0;
    // For positions that have to be copied; kept, as they usually come once per timestamp.
    std::vector<double> room_{};
};

// A step that is tried: what its rounds have prepared is withdrawn at the end of the block, unless it has been published.
// The triangulation has to outlive it, and not to be moved meanwhile.
//     for (double step = 1;; step /= 2) {
//         deldrift::Trial trial(t);
//         t.move_vertices(positions_after(step));
//         trial.prepare();
//         if (is_good(t)) {
//             trial.publish();
//             break;
//         }
//     }
class Trial {
public:
    explicit Trial(Triangulation &t) noexcept : t_(t) {}
    Trial(const Trial &) = delete;
    Trial &operator=(const Trial &) = delete;
    ~Trial() {
        if (is_prepared_) deldrift_withdraw_timestamp(t_.native());
    }

    // Prepares what is staged: a round, after those before. One that throws leaves these in force.
    deldrift_commit_report prepare() {
        const deldrift_commit_report report = t_.prepare_timestamp();
        is_prepared_ = true;
        return report;
    }
    // Then another step may be tried.
    void publish() {
        t_.publish_timestamp();
        is_prepared_ = false;
    }
    void withdraw() {
        t_.withdraw_timestamp();
        is_prepared_ = false;
    }

private:
    Triangulation &t_;
    bool is_prepared_ = false;
};

}  // namespace deldrift

#endif  // __cpp_exceptions

#endif  // DELDRIFT_HPP
