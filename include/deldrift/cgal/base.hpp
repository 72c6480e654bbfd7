// What Delaunay_triangulation_2 and _3 have in common: see cgal.hpp.
#ifndef DELDRIFT_CGAL_BASE_HPP
#define DELDRIFT_CGAL_BASE_HPP

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "given.hpp"
#include "handles.hpp"

namespace deldrift::cgal::detail {

// The info of vertices: the parameter itself, or that of the vertices of one of CGAL's data structures.
template <class V, class = void>
struct Info_of_vertex {
    using type = void;
};
template <class V>
struct Info_of_vertex<V, std::void_t<typename V::Info>> {
    using type = typename V::Info;
};
template <class T, class = void>
struct Info_of {
    using type = T;
};
template <class T>
struct Info_of<T, std::void_t<typename T::Vertex>> : Info_of_vertex<typename T::Vertex> {};

template <std::uint32_t D, class P, class Info>
class Base {
protected:
    using Mesh = detail::Mesh<D, P, Info>;
    template <class Source>
    using handles = range<handle_iterator<Source>>;

public:
    using Point = P;
    using Vertex_handle = detail::Vertex_handle<Mesh, D>;
    using Vertex = Vertex_handle;
    using size_type = std::size_t;
    using difference_type = std::ptrdiff_t;
    using Finite_vertices_iterator = handle_iterator<Finite_vertices<Mesh, D>>;
    using Finite_vertex_handles = handles<Finite_vertices<Mesh, D>>;
    using Point_iterator = handle_iterator<detail::Points<Mesh, D>>;

    Base() : mesh_(std::make_unique<Mesh>()) {}
    // Vertices of a copy have the same ids, cells the same indices. Nothing is triangulated.
    Base(const Base &other) : mesh_(std::make_unique<Mesh>(*other.mesh_)) {}
    Base(Base &&) noexcept = default;
    Base &operator=(Base other) noexcept {
        swap(other);
        return *this;
    }

    void swap(Base &other) noexcept { mesh_.swap(other.mesh_); }
    void clear() { mesh_ = std::make_unique<Mesh>(); }

    // One vertex. At the place of another one nothing is inserted, and that one returned.
    template <class... Hint>
    Vertex_handle insert(const Point &p, Hint...) {
        return Vertex_handle(mesh_->insert(p, {}));
    }
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
    // At once. Where another vertex is at the place, that one is returned, and this one stays where it is.
    Vertex_handle move_if_no_collision(Vertex_handle v, const Point &p) {
        return Vertex_handle(mesh_->move_if_free(v.record_, p));
    }
    // Where another vertex is at the place, that one is returned, and this one removed.
    Vertex_handle move(Vertex_handle v, const Point &p) {
        const Vertex_handle there = move_if_no_collision(v, p);
        if (there != v) remove(v);
        return there;
    }

    // All staged moves are made together, which is the fast way to move many vertices; until then nothing changes. A
    // commit throws Error, and changes nothing, if two vertices would be at the same place.
    void stage_move(Vertex_handle v, const Point &p) { mesh_->stage_move(v.record_, p); }
    void discard_moves() { mesh_->discard_moves(); }
    deldrift_commit_report commit_timestamp() { return mesh_->commit_timestamp(); }
    // The triangulation itself: its arrays of cells, tolerances, statistics. Vertex_handle::id() is the id in it.
    const Triangulation &triangulation() const noexcept { return std::as_const(*mesh_).triangulation(); }
    // What has changed, by ids and indices of cells: see deldrift_take_changes.
    deldrift_changes take_changes() { return mesh_->triangulation().take_changes(); }

    size_type number_of_vertices() const { return triangulation().vertex_count(); }
    Vertex_handle infinite_vertex() const noexcept { return Vertex_handle(mesh_->infinite()); }
    bool is_infinite(Vertex_handle v) const noexcept { return v == infinite_vertex(); }
    bool is_vertex(const Point &p, Vertex_handle &v) const {
        v = nearest_vertex(p);
        return v != nullptr && numbers_of<D>(v.point()) == numbers_of<D>(p);
    }
    template <class... Hint>
    Vertex_handle nearest_vertex(const Point &p, Hint...) const {
        return Vertex_handle(mesh_->nearest(p));
    }
    // Whether it is the Delaunay triangulation of its vertices, decided exactly.
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
    Point_iterator points_begin() const { return {{mesh()}, 0, mesh_->by_id().size()}; }
    Point_iterator points_end() const { return {{mesh()}, mesh_->by_id().size(), mesh_->by_id().size()}; }
    range<Point_iterator> points() const { return {points_begin(), points_end()}; }

protected:
    using Cell = detail::Cell_handle<Mesh, D>;

    const Mesh *mesh() const noexcept { return mesh_.get(); }
    template <template <class, std::uint32_t> class Source>
    handles<Source<Mesh, D>> all(std::size_t n) const {
        return {{{mesh()}, 0, n}, {{mesh()}, n, n}};
    }
    std::size_t n_cells() const { return mesh_->cells().count; }
    std::size_t n_facets_of_cells() const { return mesh_->cells().count * (D + 1); }

    // The orientation of a finite cell with a point in the place of a corner.
    int side_of_facet(Cell c, std::uint32_t corner, const std::array<double, D> &p) const {
        std::array<double, (D + 1) * D> points;
        for (std::uint32_t i = 0; i <= D; i++) {
            const auto x = i == corner ? p : numbers_of<D>(c.vertex(static_cast<int>(i)).point());
            std::copy(x.begin(), x.end(), points.begin() + i * D);
        }
        return orientation(D, points);
    }

    // Where a point is: at a vertex; in a finite cell, on those facets that are marked; in a ghost cell; or there are
    // no cells.
    struct Place {
        deldrift_location_kind kind;
        Vertex_handle vertex;
        Cell cell;
        std::array<bool, D + 1> on_facet;
    };
    Place place_of(const Point &p, Cell hint) const {
        const std::array<double, D> x = numbers_of<D>(p);
        const deldrift_location start{DELDRIFT_LOCATION_CELL, hint.id()};
        const bool is_hint = hint != nullptr;
        const deldrift_location found = triangulation().locate_points(x, is_hint ? &start : nullptr)[0];
        Place place{found.kind, nullptr, nullptr, {}};
        switch (found.kind) {
        case DELDRIFT_LOCATION_VERTEX:
            place.vertex = Vertex_handle(mesh_->by_id()[found.index]);
            place.cell = place.vertex.cell();
            break;
        case DELDRIFT_LOCATION_CELL:
            place.cell = Cell(mesh(), found.index);
            for (std::uint32_t i = 0; i <= D; i++) place.on_facet[i] = side_of_facet(place.cell, i, x) == 0;
            break;
        case DELDRIFT_LOCATION_OUTSIDE:
            for (std::uint32_t i = 0; i <= D; i++) {
                const Cell finite(mesh(), found.index), ghost = finite.neighbor(static_cast<int>(i));
                if (ghost.is_infinite() && side_of_facet(finite, i, x) < 0) place.cell = ghost;
            }
            break;
        case DELDRIFT_LOCATION_NO_CELLS:
            if (is_vertex(p, place.vertex)) place.kind = DELDRIFT_LOCATION_VERTEX;
            break;
        }
        return place;
    }

    // The centre of the sphere through points, rounded: the solution of 2 (q - p) x = |q - p|^2 for the others q, by
    // Cramer's rule from the first one, p.
    static std::array<double, D> centre_of(const std::array<std::array<double, D>, D + 1> &points) {
        std::array<std::array<double, D>, D> u;
        std::array<double, D> squares{}, centre;
        for (std::size_t i = 0; i < D; i++) {
            for (std::size_t k = 0; k < D; k++) {
                u[i][k] = points[i + 1][k] - points[0][k];
                squares[i] += u[i][k] * u[i][k];
            }
        }
        const double scale = 2 * determinant(u);
        for (std::size_t k = 0; k < D; k++) {
            auto replaced = u;
            for (std::size_t i = 0; i < D; i++) replaced[i][k] = squares[i];
            centre[k] = points[0][k] + determinant(replaced) / scale;
        }
        return centre;
    }
    Point centre_of(Cell c) const {
        std::array<std::array<double, D>, D + 1> points;
        for (std::uint32_t i = 0; i <= D; i++) points[i] = numbers_of<D>(c.vertex(static_cast<int>(i)).point());
        return point_of<D, Point>(centre_of(points));
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
        const auto p = numbers_of<D>(*i), q = numbers_of<D>(*++i);
        while (++i != points_end()) {
            const auto r = numbers_of<D>(*i);
            for (std::uint32_t a = 0; a < D; a++) {
                for (std::uint32_t b = 0; b < a; b++) {
                    if (orientation(2, std::array<double, 6>{p[a], p[b], q[a], q[b], r[a], r[b]}) != 0) return false;
                }
            }
        }
        return true;
    }

    std::unique_ptr<Mesh> mesh_;
};

}  // namespace deldrift::cgal::detail

#endif  // DELDRIFT_CGAL_BASE_HPP
