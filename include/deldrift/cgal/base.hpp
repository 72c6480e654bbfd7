// What Delaunay and regular triangulations have in common: see cgal.hpp.
#ifndef DELDRIFT_CGAL_BASE_HPP
#define DELDRIFT_CGAL_BASE_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "given.hpp"
#include "handles.hpp"
#include "places.hpp"

namespace deldrift::cgal::detail {

template <std::uint32_t D, class K, class Info, class Policy>
class Base {
protected:
    using Mesh = detail::Mesh<D, Policy, Info>;
    template <class Source>
    using handles = range<handle_iterator<Source>>;
    template <template <class, std::uint32_t> class Source>
    using list_iterator = handle_iterator<Source<Mesh, D>>;

public:
    using Geom_traits = K;
    using Point = typename Mesh::Point;
    using Bare_point = typename Mesh::Bare_point;
    using Vertex_handle = detail::Vertex_handle<Mesh, D>;
    using Vertex = Vertex_handle;
    using size_type = std::size_t;
    using difference_type = std::ptrdiff_t;
    using Finite_vertices_iterator = handle_iterator<Finite_vertices<Mesh, D>>;
    using Finite_vertex_handles = handles<Finite_vertices<Mesh, D>>;
    using Point_iterator = handle_iterator<detail::Points<Mesh, D>>;

    using All_vertices_iterator = handle_iterator<All_vertices<Mesh, D>>;
    using All_vertex_handles = handles<All_vertices<Mesh, D>>;

    Base() : mesh_(std::make_unique<Mesh>()) {}
    explicit Base(const K &traits) : traits_(traits), mesh_(std::make_unique<Mesh>()) {}
    // Vertices of a copy have the same ids, cells the same indices. Nothing is triangulated.
    Base(const Base &other) : traits_(other.traits_), mesh_(std::make_unique<Mesh>(*other.mesh_)) {}
    Base(Base &&) noexcept = default;
    Base &operator=(Base other) noexcept {
        swap(other);
        return *this;
    }

    void swap(Base &other) noexcept {
        std::swap(traits_, other.traits_);
        mesh_.swap(other.mesh_);
    }
    const K &geom_traits() const noexcept { return traits_; }
    void clear() { mesh_ = std::make_unique<Mesh>(); }

    // One vertex. At the place of another one nothing is inserted, and that one returned; with weights, at that of one
    // of the same weight that is not hidden. In space there is no handle for one that is hidden at once.
    template <class... Hint>
    Vertex_handle insert(const Point &p, Hint...) {
        const Vertex_handle v(mesh_->insert(p, {}));
        if constexpr (D == 3) return mesh_->is_hidden_now(v.id()) ? Vertex_handle() : v;
        return v;
    }
    Vertex_handle push_back(const Point &p) { return insert(p); }
    // Points, or pairs or tuples of point and info, all at once; returns how many vertices there are more. Each element
    // is read once, in order, before anything is inserted. The end may be of another type than the iterator.
    template <class Iterator, class End, class = std::enable_if_t<Is_sequence<Iterator, End>::value>>
    std::ptrdiff_t insert(Iterator first, End last) {
        const auto before = static_cast<std::ptrdiff_t>(number_of_vertices());
        typename Mesh::Vertices vertices;
        for (; first != last; ++first) {
            vertices.push_back(point_and_info<Point, typename Mesh::Given_info>(*first));
        }
        mesh_->insert(std::move(vertices));
        return static_cast<std::ptrdiff_t>(number_of_vertices()) - before;
    }
    void remove(Vertex_handle v) { mesh_->remove(v.record_); }
    template <class Iterator>
    std::ptrdiff_t remove(Iterator first, Iterator last) {
        std::ptrdiff_t n = 0;
        for (; first != last; ++first, n++) remove(*first);
        return n;
    }
    // At once, with weights to another place, another weight, or both. Where another vertex is at the place, and not
    // hidden, that one is returned, and this one stays as it is.
    Vertex_handle move_if_no_collision(Vertex_handle v, const Point &p) {
        return Vertex_handle(mesh_->move_if_free(v.record_, p));
    }
    // The same, but where another one is returned, this one is removed.
    Vertex_handle move(Vertex_handle v, const Point &p) {
        const Vertex_handle there = move_if_no_collision(v, p);
        if (there != v) remove(v);
        return there;
    }

    // All staged moves are made together, which is the fast way to move many vertices; until then nothing changes. A
    // commit throws Error, and changes nothing, if two vertices without weights would be at the same place.
    void stage_move(Vertex_handle v, const Point &p) { mesh_->stage_move(v.record_, p); }
    void discard_moves() { mesh_->discard_moves(); }
    deldrift_commit_report commit_timestamp() { return mesh_->commit_timestamp(); }
    // The triangulation itself: its arrays of cells, tolerances, statistics. Vertex_handle::id() is the id in it.
    const Triangulation &triangulation() const noexcept { return std::as_const(*mesh_).triangulation(); }
    // What has changed, by ids and indices of cells: see deldrift_take_changes.
    deldrift_changes take_changes() { return mesh_->triangulation().take_changes(); }

    size_type number_of_vertices() const { return mesh_->shown_count(); }
    Vertex_handle infinite_vertex() const noexcept { return Vertex_handle(mesh_->infinite()); }
    bool is_infinite(Vertex_handle v) const noexcept { return v == infinite_vertex(); }
    // Whether it is one of this triangulation.
    bool is_vertex(Vertex_handle v) const noexcept { return v != nullptr && v.record_->mesh == mesh(); }
    bool is_vertex(const Point &p, Vertex_handle &v) const {
        const Vertex_handle found(mesh_->at(p));
        if (found != nullptr) v = found;
        return found != nullptr;
    }
    // Whether it is the Delaunay or regular triangulation of its vertices, decided exactly.
    bool is_valid(bool = false, int = 0) const {
        const deldrift_status status = deldrift_validate(triangulation().native(), 3);
        if (status != DELDRIFT_OK && status != DELDRIFT_INVALID) throw Error(status);
        return status == DELDRIFT_OK;
    }
    // The dimension of what the vertices span; -1 if there are none. Only where it is that of the space are there
    // cells.
    int dimension() const {
        if (mesh_->cells().count > 0) return static_cast<int>(D);
        const std::size_t n = number_of_vertices();
        if (n < 2) return static_cast<int>(n) - 1;
        return is_on_a_line() ? 1 : 2;
    }

    Finite_vertices_iterator finite_vertices_begin() const { return {{mesh()}, 0, mesh_->by_id().size()}; }
    Finite_vertices_iterator finite_vertices_end() const {
        return {{mesh()}, mesh_->by_id().size(), mesh_->by_id().size()};
    }
    Finite_vertex_handles finite_vertex_handles() const { return {finite_vertices_begin(), finite_vertices_end()}; }
    All_vertices_iterator all_vertices_begin() const { return all_vertex_handles().begin(); }
    All_vertices_iterator all_vertices_end() const { return all_vertex_handles().end(); }
    All_vertex_handles all_vertex_handles() const { return all<All_vertices>(mesh_->by_id().size() + 1); }
    Point_iterator points_begin() const { return {{mesh()}, 0, mesh_->by_id().size()}; }
    Point_iterator points_end() const { return {{mesh()}, mesh_->by_id().size(), mesh_->by_id().size()}; }
    range<Point_iterator> points() const { return {points_begin(), points_end()}; }

protected:
    using Cell = detail::Cell_handle<Mesh, D>;

    const Mesh *mesh() const noexcept { return mesh_.get(); }
    Vertex_handle nearest(const typename Mesh::Numbers &place) const { return Vertex_handle(mesh_->nearest(place)); }
    Mesh &mesh_to_change() noexcept { return *mesh_; }
    static typename Mesh::Record *record_of(Vertex_handle v) noexcept { return v.record_; }
    template <template <class, std::uint32_t> class Source>
    handles<Source<Mesh, D>> all(std::size_t n) const {
        return {{{mesh()}, 0, n}, {{mesh()}, n, n}};
    }
    std::size_t n_cells() const { return mesh_->cells().count; }
    std::size_t n_facets_of_cells() const { return mesh_->cells().count * (D + 1); }

    using Zone = detail::Zone<Mesh, D>;
    // Of a point; near a cell, if one is given.
    detail::Place<Mesh, D> place_of(const Point &p, Cell hint) const {
        auto place = detail::place_of<Mesh, D>(mesh(), p, hint);
        if (place.kind == DELDRIFT_LOCATION_NO_CELLS && is_vertex(p, place.vertex)) {
            place.kind = DELDRIFT_LOCATION_VERTEX;
        }
        return place;
    }
    // The point is inserted if these are the cells that are in conflict with it.
    template <class Iterator>
    Vertex_handle insert_in_zone(const Point &p, Iterator first, Iterator last) {
        std::vector<Cell> given(first, last);
        std::sort(given.begin(), given.end());
        const Zone zone(mesh(), p, given.empty() ? Cell() : given.front());
        if (given.empty() || given != zone.cells()) {
            throw Error(DELDRIFT_INVALID_VALUE, "the " + std::to_string(given.size()) + " cells are not the " +
                                                    std::to_string(zone.cells().size()) +
                                                    " that are in conflict with the point");
        }
        return insert(p);
    }

    // The cells with a vertex: of a finite one, ghost cells only if they are wanted; of the infinite one all that there
    // are.
    std::vector<Cell> star(Vertex_handle v, bool with_infinite) const {
        std::vector<Cell> cells;
        const deldrift_cells_view &rows = mesh_->cells();
        if (is_infinite(v)) {
            for (std::size_t k = 0; with_infinite && k < n_facets_of_cells(); k++) {
                if (rows.neighbours[k] == DELDRIFT_NONE) cells.push_back(All_cells<Mesh, D>{mesh()}(n_cells() + k));
            }
            return cells;
        }
        const typename Mesh::Star star(*mesh_, v.id());
        cells.reserve(star.size() + 8);
        for (std::uint32_t index : star) {
            const Cell c(mesh(), index);
            cells.push_back(c);
            for (std::uint32_t i = 0; with_infinite && i <= D; i++) {
                const std::size_t k = std::size_t{index} * (D + 1) + i;
                const bool is_ghost = rows.neighbours[k] == DELDRIFT_NONE && rows.vertices[k] != v.id();
                if (is_ghost) cells.push_back(c.neighbor(static_cast<int>(i)));
            }
        }
        return cells;
    }
    // A cell with all of these vertices, of which one may be infinite; none if there is none.
    template <std::size_t N>
    Cell cell_with(const std::array<Vertex_handle, N> &vertices) const {
        std::array<std::uint32_t, N> ids{};
        for (std::size_t i = 0; i < N; i++) ids[i] = vertices[i].id();
        if (std::count(ids.begin(), ids.end(), DELDRIFT_NONE) == 0) {
            const std::uint32_t cell = triangulation().find_simplices(N, ids)[0];
            return cell == DELDRIFT_NONE ? Cell() : Cell(mesh(), cell);
        }
        auto sorted = ids;
        std::sort(sorted.begin(), sorted.end());
        if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end() || n_cells() == 0) return nullptr;
        for (Cell c : star(vertices[ids[0] == DELDRIFT_NONE ? 1 : 0], true)) {
            if (std::all_of(vertices.begin(), vertices.end(), [&](auto v) { return c.has_vertex(v); })) return c;
        }
        return nullptr;
    }

    // The centre of the sphere through points, rounded: the solution of 2 (q - p) x = |q - p|^2 for the others q, by
    // Cramer's rule from the first one, p. With weights the weight of p is added there, and that of q taken away.
    static std::array<double, D> centre_of(const std::array<std::array<double, D>, D + 1> &points,
                                           const std::array<double, D + 1> &weights) {
        std::array<std::array<double, D>, D> u;
        std::array<double, D> squares{}, centre;
        for (std::size_t i = 0; i < D; i++) {
            for (std::size_t k = 0; k < D; k++) {
                u[i][k] = points[i + 1][k] - points[0][k];
                squares[i] += u[i][k] * u[i][k];
            }
            squares[i] += weights[0] - weights[i + 1];
        }
        const double scale = 2 * determinant(u);
        for (std::size_t k = 0; k < D; k++) {
            auto replaced = u;
            for (std::size_t i = 0; i < D; i++) replaced[i][k] = squares[i];
            centre[k] = points[0][k] + determinant(replaced) / scale;
        }
        return centre;
    }
    // By the kernel, if it can.
    Bare_point centre_of(Cell c) const {
        if constexpr (D == 2 && Policy::have_centres) {
            return Policy::centre(traits_, c.vertex(0).point(), c.vertex(1).point(), c.vertex(2).point());
        } else if constexpr (Policy::have_centres) {
            return Policy::centre(traits_, c.vertex(0).point(), c.vertex(1).point(), c.vertex(2).point(),
                                  c.vertex(3).point());
        } else {
            std::array<std::array<double, D>, D + 1> points;
            std::array<double, D + 1> weights;
            for (std::uint32_t i = 0; i <= D; i++) {
                points[i] = numbers_of(c, i);
                weights[i] = Mesh::weight_of(c.vertex(static_cast<int>(i)).point());
            }
            return Coordinates<D, K>::point(centre_of(points, weights));
        }
    }

private:
    static double determinant(const std::array<std::array<double, D>, D> &m) {
        if constexpr (D == 2) {
            return m[0][0] * m[1][1] - m[0][1] * m[1][0];
        } else {
            const auto minor = [&](std::size_t a, std::size_t b) { return m[1][a] * m[2][b] - m[1][b] * m[2][a]; };
            return m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1);
        }
    }
    // Whether all vertices, of which there are two or more, are on a line: whether they are in each projection.
    bool is_on_a_line() const {
        auto i = points_begin();
        const auto p = Mesh::numbers_of(*i), q = Mesh::numbers_of(*++i);
        while (++i != points_end()) {
            const auto r = Mesh::numbers_of(*i);
            for (std::uint32_t a = 0; a < D; a++) {
                for (std::uint32_t b = 0; b < a; b++) {
                    if (orientation(2, std::array<double, 6>{p[a], p[b], q[a], q[b], r[a], r[b]}) != 0) return false;
                }
            }
        }
        return true;
    }

    K traits_{};
    std::unique_ptr<Mesh> mesh_;
};

}  // namespace deldrift::cgal::detail

#endif  // DELDRIFT_CGAL_BASE_HPP
