// Handles of vertices and cells, and iterators over them: see cgal.hpp.
#ifndef DELDRIFT_CGAL_HANDLES_HPP
#define DELDRIFT_CGAL_HANDLES_HPP

#include <cstddef>
#include <cstdint>
#include <functional>
#include <type_traits>
#include <utility>

#include "mesh.hpp"

namespace deldrift::cgal::detail {

template <class Mesh, std::uint32_t D>
class Cell_handle;
template <std::uint32_t D, class K, class Info, class Policy>
class Base;
template <class Source>
class handle_iterator;
template <class Mesh, std::uint32_t D>
struct Hidden_vertices;
template <class Mesh, std::uint32_t D>
struct Hidden_points;

// A vertex. As in CGAL, a handle is used like a pointer; here it leads to itself.
template <class Mesh, std::uint32_t D>
class Vertex_handle {
public:
    using value_type = Vertex_handle;
    using Record = typename Mesh::Record;
    using Point = typename Mesh::Point;
    using Info = typename Mesh::Given_info;
    using Cell_handle = detail::Cell_handle<Mesh, D>;
    using Face_handle = Cell_handle;

    Vertex_handle() = default;
    Vertex_handle(std::nullptr_t) noexcept {}
    explicit Vertex_handle(Record *record) noexcept : record_(record) {}
    const Vertex_handle *operator->() const noexcept { return this; }
    const Vertex_handle &operator*() const noexcept { return *this; }

    const Point &point() const noexcept { return record_->point; }
    Info &info() const noexcept { return record_->info; }
    // The id in deldrift's arrays, until a vertex is removed; DELDRIFT_NONE for the infinite vertex.
    std::uint32_t id() const noexcept { return record_->id; }
    // Of a regular triangulation: whether it is a corner of no cell, as others are heavier.
    bool is_hidden() const { return record_->mesh->is_hidden(id()); }
    // Some cell with this vertex; of a hidden one, the cell that hides it.
    Cell_handle cell() const;
    Cell_handle face() const { return cell(); }

    friend bool operator==(const Vertex_handle &a, const Vertex_handle &b) noexcept { return a.record_ == b.record_; }
    friend bool operator!=(const Vertex_handle &a, const Vertex_handle &b) noexcept { return !(a == b); }
    friend bool operator<(const Vertex_handle &a, const Vertex_handle &b) noexcept {
        return std::less<Record *>()(a.record_, b.record_);
    }
    friend bool operator>(const Vertex_handle &a, const Vertex_handle &b) noexcept { return b < a; }
    friend bool operator<=(const Vertex_handle &a, const Vertex_handle &b) noexcept { return !(b < a); }
    friend bool operator>=(const Vertex_handle &a, const Vertex_handle &b) noexcept { return !(a < b); }
    // For the containers of Boost.
    friend std::size_t hash_value(const Vertex_handle &v) noexcept { return std::hash<Vertex_handle>()(v); }

private:
    template <std::uint32_t E, class K, class Info, class Policy>
    friend class Base;
    friend struct std::hash<Vertex_handle>;
    Record *record_ = nullptr;
};

// A triangle or tetrahedron, or a ghost cell: the infinite vertex with a facet of the hull. A ghost cell is named by
// the finite cell with that facet and the corner opposite it. Its corners are those of the finite cell, with the
// infinite vertex at that corner and the next two exchanged, so that ghost cells are oriented like the others.
template <class Mesh, std::uint32_t D>
class Cell_handle {
public:
    using value_type = Cell_handle;
    using Vertex_handle = detail::Vertex_handle<Mesh, D>;
    using Vertex = Vertex_handle;
    static constexpr std::uint32_t corners = D + 1;

    Cell_handle() = default;
    Cell_handle(std::nullptr_t) noexcept {}
    Cell_handle(const Mesh *mesh, std::uint32_t cell, std::uint32_t hull_corner = corners) noexcept
        : mesh_(mesh), cell_(cell), hull_corner_(hull_corner) {}
    const Cell_handle *operator->() const noexcept { return this; }
    const Cell_handle &operator*() const noexcept { return *this; }

    Vertex vertex(int i) const {
        const auto k = static_cast<std::uint32_t>(i);
        if (k == hull_corner_) return Vertex(mesh_->infinite());
        return Vertex(mesh_->by_id()[row()[finite_corner(k)]]);
    }
    Cell_handle neighbor(int i) const {
        const auto k = static_cast<std::uint32_t>(i);
        if (k == hull_corner_) return {mesh_, cell_};
        if (is_infinite()) return next_on_hull(finite_corner(k));
        const std::uint32_t other = neighbours()[k];
        return other == DELDRIFT_NONE ? Cell_handle(mesh_, cell_, k) : Cell_handle(mesh_, other);
    }
    bool has_vertex(Vertex v, int &i) const {
        for (i = 0; i < static_cast<int>(corners); i++) {
            if (vertex(i) == v) return true;
        }
        return false;
    }
    bool has_vertex(Vertex v) const {
        int i = 0;
        return has_vertex(v, i);
    }
    bool has_neighbor(Cell_handle c, int &i) const {
        for (i = 0; i < static_cast<int>(corners); i++) {
            if (neighbor(i) == c) return true;
        }
        return false;
    }
    bool has_neighbor(Cell_handle c) const {
        int i = 0;
        return has_neighbor(c, i);
    }
    // Which corner the vertex is, or is opposite the neighbour.
    int index(Vertex v) const {
        int i = 0;
        has_vertex(v, i);
        return i;
    }
    int index(Cell_handle c) const {
        int i = 0;
        has_neighbor(c, i);
        return i;
    }
    // The corner of neighbor(i) that is opposite the facet they share.
    int mirror_index(int i) const {
        const Cell_handle other = neighbor(i);
        for (int k = 0; k < static_cast<int>(corners); k++) {
            if (!has_vertex(other.vertex(k))) return k;
        }
        return static_cast<int>(corners);
    }

    // In the plane: the corner after i in counter-clockwise and in clockwise order.
    static int ccw(int i) noexcept {
        static_assert(D == 2);
        return (i + 1) % 3;
    }
    static int cw(int i) noexcept {
        static_assert(D == 2);
        return (i + 2) % 3;
    }

    // In the plane: whether the edge opposite corner i is a constraint, or a piece of one.
    bool is_constrained(int i) const {
        static_assert(D == 2);
        if (is_infinite() && static_cast<std::uint32_t>(i) != hull_corner_) return false;
        return mesh_->segments_of_cells()[std::size_t{cell_} * corners + static_cast<std::uint32_t>(i)] != DELDRIFT_NONE;
    }
    // Of constrained triangulations: a value that the program gives to the face, until the triangulation changes.
    typename Mesh::Face_info &info() const { return mesh_->face_info(cell_, hull_corner_); }
    // In the plane: whether the face is in the domain of a mesh: see meshing.hpp. None is before a mesh is made; marks that
    // the program sets last until the triangulation changes.
    bool is_in_domain() const {
        static_assert(D == 2);
        return mesh_->is_marked(cell_, hull_corner_);
    }
    void set_in_domain(bool is_inside) const {
        static_assert(D == 2);
        mesh_->mark(cell_, hull_corner_, is_inside);
    }

    // Of a regular triangulation: the hidden vertices above the cell, and their points.
    range<handle_iterator<Hidden_vertices<Mesh, D>>> vertex_list() const { return above<Hidden_vertices>(); }
    range<handle_iterator<Hidden_points<Mesh, D>>> hidden_points() const { return above<Hidden_points>(); }
    handle_iterator<Hidden_points<Mesh, D>> hidden_points_begin() const { return hidden_points().begin(); }
    handle_iterator<Hidden_points<Mesh, D>> hidden_points_end() const { return hidden_points().end(); }

    bool is_infinite() const noexcept { return hull_corner_ < corners; }
    // The index in deldrift's arrays; of a ghost cell, that of the finite cell behind it.
    std::uint32_t id() const noexcept { return cell_; }

    friend bool operator==(const Cell_handle &a, const Cell_handle &b) noexcept {
        return a.mesh_ == b.mesh_ && a.cell_ == b.cell_ && a.hull_corner_ == b.hull_corner_;
    }
    friend bool operator!=(const Cell_handle &a, const Cell_handle &b) noexcept { return !(a == b); }
    friend bool operator<(const Cell_handle &a, const Cell_handle &b) noexcept {
        return a.cell_ != b.cell_ ? a.cell_ < b.cell_ : a.hull_corner_ < b.hull_corner_;
    }
    friend bool operator>(const Cell_handle &a, const Cell_handle &b) noexcept { return b < a; }
    friend bool operator<=(const Cell_handle &a, const Cell_handle &b) noexcept { return !(b < a); }
    friend bool operator>=(const Cell_handle &a, const Cell_handle &b) noexcept { return !(a < b); }
    // For the containers of Boost.
    friend std::size_t hash_value(const Cell_handle &c) noexcept { return std::hash<Cell_handle>()(c); }

private:
    const std::uint32_t *row() const { return mesh_->cells().vertices + std::size_t{cell_} * corners; }
    const std::uint32_t *neighbours() const { return mesh_->cells().neighbours + std::size_t{cell_} * corners; }
    // The corner of the finite cell with the vertex at corner k of this one.
    std::uint32_t finite_corner(std::uint32_t k) const noexcept {
        if (!is_infinite()) return k;
        const std::uint32_t a = (hull_corner_ + 1) % corners, b = (hull_corner_ + 2) % corners;
        return k == a ? b : k == b ? a : k;
    }
    template <template <class, std::uint32_t> class Source>
    range<handle_iterator<Source<Mesh, D>>> above() const {
        const auto [first, last] = mesh_->hidden().above(is_infinite() ? DELDRIFT_NONE - 1 : cell_);
        return {{{mesh_}, first, last}, {{mesh_}, last, last}};
    }
    // The ghost cell beyond the ridge that this one's facet of the hull has opposite corner j of the finite cell:
    // around the ridge, from cell to cell, to the other facet on the hull.
    Cell_handle next_on_hull(std::uint32_t j) const {
        const deldrift_cells_view &cells = mesh_->cells();
        const auto at = [](const std::uint32_t *list, std::uint32_t value) {
            return static_cast<std::uint32_t>(std::find(list, list + corners, value) - list);
        };
        std::uint32_t cell = cell_, last = hull_corner_;
        for (;;) {
            const std::size_t first = std::size_t{cell} * corners;
            const std::uint32_t other = cells.neighbours[first + j];
            if (other == DELDRIFT_NONE) return {mesh_, cell, j};
            // The facet just crossed is the ridge with this vertex.
            const std::uint32_t vertex = cells.vertices[first + last];
            const std::size_t next = std::size_t{other} * corners;
            last = at(cells.neighbours + next, cell);
            j = at(cells.vertices + next, vertex);
            cell = other;
        }
    }

    const Mesh *mesh_ = nullptr;
    std::uint32_t cell_ = 0, hull_corner_ = corners;
};

template <class Mesh, std::uint32_t D>
Cell_handle<Mesh, D> Vertex_handle<Mesh, D>::cell() const {
    const Mesh *mesh = record_->mesh;
    const deldrift_cells_view &cells = mesh->cells();
    if (cells.count == 0) return nullptr;
    if (id() == DELDRIFT_NONE) {
        const std::uint32_t *end = cells.neighbours + cells.count * (D + 1);
        const auto k = static_cast<std::size_t>(std::find(cells.neighbours, end, DELDRIFT_NONE) - cells.neighbours);
        return {mesh, static_cast<std::uint32_t>(k / (D + 1)), static_cast<std::uint32_t>(k % (D + 1))};
    }
    if constexpr (Mesh::is_weighted) {
        if (is_hidden()) return {mesh, mesh->hidden().cells[id()]};
    }
    return {mesh, *typename Mesh::Star(*mesh, id()).begin()};
}

// An iterator that stands for the handle it is at.
template <class Source>
class handle_iterator : public selecting_iterator<Source> {
    using Base = selecting_iterator<Source>;

public:
    using Base::Base;
    using typename Base::value_type;
    operator value_type() const { return **this; }
    handle_iterator &operator++() {
        Base::operator++();
        return *this;
    }
    handle_iterator &operator--() {
        Base::operator--();
        return *this;
    }
    handle_iterator operator++(int) {
        handle_iterator before = *this;
        ++*this;
        return before;
    }
    handle_iterator operator--(int) {
        handle_iterator before = *this;
        --*this;
        return before;
    }
};

template <class Mesh, std::uint32_t D>
struct Finite_vertices {
    const Mesh *mesh = nullptr;
    Vertex_handle<Mesh, D> operator()(std::size_t id) const { return Vertex_handle<Mesh, D>(mesh->by_id()[id]); }
    bool selects(std::size_t id) const { return mesh->shows(static_cast<std::uint32_t>(id)); }
};

// The infinite vertex first.
template <class Mesh, std::uint32_t D>
struct All_vertices {
    const Mesh *mesh = nullptr;
    Vertex_handle<Mesh, D> operator()(std::size_t i) const {
        return Vertex_handle<Mesh, D>(i == 0 ? mesh->infinite() : mesh->by_id()[i - 1]);
    }
    bool selects(std::size_t i) const { return i == 0 || mesh->shows(static_cast<std::uint32_t>(i - 1)); }
};

template <class Mesh, std::uint32_t D>
struct Hidden_vertices {
    const Mesh *mesh = nullptr;
    Vertex_handle<Mesh, D> operator()(std::size_t k) const {
        return Vertex_handle<Mesh, D>(mesh->by_id()[mesh->hidden().in_order[k]]);
    }
    bool selects(std::size_t) const noexcept { return true; }
};
template <class Mesh, std::uint32_t D>
struct Hidden_points {
    const Mesh *mesh = nullptr;
    typename Mesh::Point operator()(std::size_t k) const { return mesh->by_id()[mesh->hidden().in_order[k]]->point; }
    bool selects(std::size_t) const noexcept { return true; }
};

template <class Mesh, std::uint32_t D>
struct Points {
    const Mesh *mesh = nullptr;
    typename Mesh::Point operator()(std::size_t id) const { return mesh->by_id()[id]->point; }
    bool selects(std::size_t id) const { return mesh->shows(static_cast<std::uint32_t>(id)); }
};

template <class Mesh, std::uint32_t D>
struct Finite_cells {
    const Mesh *mesh = nullptr;
    Cell_handle<Mesh, D> operator()(std::size_t cell) const { return {mesh, static_cast<std::uint32_t>(cell)}; }
    bool selects(std::size_t) const noexcept { return true; }
};

// Finite cells first, then the facets of all cells, of which those on the hull stand for ghost cells.
template <class Mesh, std::uint32_t D>
struct All_cells {
    const Mesh *mesh = nullptr;
    Cell_handle<Mesh, D> operator()(std::size_t i) const {
        const std::size_t n = mesh->cells().count;
        if (i < n) return {mesh, static_cast<std::uint32_t>(i)};
        return {mesh, static_cast<std::uint32_t>((i - n) / (D + 1)), static_cast<std::uint32_t>((i - n) % (D + 1))};
    }
    bool selects(std::size_t i) const {
        const std::size_t n = mesh->cells().count;
        return i < n || mesh->cells().neighbours[i - n] == DELDRIFT_NONE;
    }
};

// Facets of finite cells, each one once: edges in the plane.
template <class Mesh, std::uint32_t D>
struct Finite_facets {
    const Mesh *mesh = nullptr;
    std::pair<Cell_handle<Mesh, D>, int> operator()(std::size_t k) const {
        return {{mesh, static_cast<std::uint32_t>(k / (D + 1))}, static_cast<int>(k % (D + 1))};
    }
    bool selects(std::size_t k) const {
        const std::uint32_t other = mesh->cells().neighbours[k];
        return other == DELDRIFT_NONE || k < std::size_t{other} * (D + 1);
    }
};

// Facets of finite cells, then those between two ghost cells, each one once.
template <class Mesh, std::uint32_t D>
struct All_facets {
    const Mesh *mesh = nullptr;
    std::pair<Cell_handle<Mesh, D>, int> operator()(std::size_t k) const {
        const std::size_t n = mesh->cells().count * (D + 1);
        if (k < n) return Finite_facets<Mesh, D>{mesh}(k);
        const std::size_t ghost = (k - n) / (D + 1);
        return {{mesh, static_cast<std::uint32_t>(ghost / (D + 1)), static_cast<std::uint32_t>(ghost % (D + 1))},
                static_cast<int>((k - n) % (D + 1))};
    }
    bool selects(std::size_t k) const {
        const deldrift_cells_view &cells = mesh->cells();
        const std::size_t n = cells.count * (D + 1);
        if (k < n) return Finite_facets<Mesh, D>{mesh}.selects(k);
        const std::size_t ghost = (k - n) / (D + 1), corner = (k - n) % (D + 1);
        if (cells.neighbours[ghost] != DELDRIFT_NONE || corner == ghost % (D + 1)) return false;
        const Cell_handle<Mesh, D> cell = (*this)(k).first;
        return cell < cell.neighbor(static_cast<int>(corner));
    }
};

}  // namespace deldrift::cgal::detail

template <class Mesh, std::uint32_t D>
struct std::hash<deldrift::cgal::detail::Vertex_handle<Mesh, D>> {
    std::size_t operator()(const deldrift::cgal::detail::Vertex_handle<Mesh, D> &v) const noexcept {
        return std::hash<const void *>()(v.record_);
    }
};
template <class Mesh, std::uint32_t D>
struct std::hash<deldrift::cgal::detail::Cell_handle<Mesh, D>> {
    std::size_t operator()(const deldrift::cgal::detail::Cell_handle<Mesh, D> &c) const noexcept {
        return std::hash<std::size_t>()(2 * std::size_t{c.id()} + (c.is_infinite() ? 1 : 0));
    }
};

#endif  // DELDRIFT_CGAL_HANDLES_HPP
