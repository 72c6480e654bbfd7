// Delaunay_triangulation_3: see cgal.hpp.
#ifndef DELDRIFT_CGAL_SPACE_HPP
#define DELDRIFT_CGAL_SPACE_HPP

#include <algorithm>

#include "base.hpp"

namespace deldrift::cgal {

namespace detail {

// Three values, as CGAL names them.
template <class First, class Second, class Third>
struct Triple {
    First first;
    Second second;
    Third third;
    friend bool operator==(const Triple &a, const Triple &b) noexcept {
        return a.first == b.first && a.second == b.second && a.third == b.third;
    }
    friend bool operator!=(const Triple &a, const Triple &b) noexcept { return !(a == b); }
};

// For corners i and j, the corner k by which i, j, k and the fourth one, l, are an even permutation: from a cell one
// turns around the edge from i to j, counter-clockwise, through the facet opposite k.
inline int next_around_edge(int i, int j) noexcept {
    static constexpr signed char next[4][4] = {{-1, 2, 3, 1}, {3, -1, 0, 2}, {1, 3, -1, 0}, {2, 0, 1, -1}};
    return next[i][j];
}

// The cells around the edge from s to t, without an end. At gives what it stands for, from a cell and the corners of s
// and t in it.
template <class Cell_handle, class At>
class Edge_circulator_3 {
    using Vertex_handle = typename Cell_handle::Vertex;

public:
    using value_type = std::decay_t<decltype(std::declval<At>()(std::declval<Cell_handle>(), 0, 0))>;
    using reference = value_type;
    using pointer = arrow<value_type>;
    using difference_type = std::ptrdiff_t;
    using size_type = std::size_t;
    using iterator_category = std::bidirectional_iterator_tag;

    Edge_circulator_3() = default;
    Edge_circulator_3(Vertex_handle s, Vertex_handle t, Cell_handle c) : s_(s), t_(t), c_(c) {}
    value_type operator*() const { return At()(c_, c_.index(s_), c_.index(t_)); }
    pointer operator->() const { return pointer(**this); }
    operator value_type() const { return **this; }
    Edge_circulator_3 &operator++() {
        c_ = c_.neighbor(next_around_edge(c_.index(s_), c_.index(t_)));
        return *this;
    }
    Edge_circulator_3 &operator--() {
        c_ = c_.neighbor(next_around_edge(c_.index(t_), c_.index(s_)));
        return *this;
    }
    Edge_circulator_3 operator++(int) {
        Edge_circulator_3 before = *this;
        ++*this;
        return before;
    }
    Edge_circulator_3 operator--(int) {
        Edge_circulator_3 before = *this;
        --*this;
        return before;
    }
    friend bool operator==(const Edge_circulator_3 &a, const Edge_circulator_3 &b) noexcept { return a.c_ == b.c_; }
    friend bool operator!=(const Edge_circulator_3 &a, const Edge_circulator_3 &b) noexcept { return !(a == b); }
    friend bool operator==(const Edge_circulator_3 &a, std::nullptr_t) noexcept { return a.c_ == nullptr; }
    friend bool operator!=(const Edge_circulator_3 &a, std::nullptr_t) noexcept { return a.c_ != nullptr; }

private:
    Vertex_handle s_, t_;
    Cell_handle c_;
};

struct At_cell {
    template <class Cell_handle>
    Cell_handle operator()(Cell_handle c, int, int) const {
        return c;
    }
};
struct At_facet {
    template <class Cell_handle>
    std::pair<Cell_handle, int> operator()(Cell_handle c, int i, int j) const {
        return {c, next_around_edge(i, j)};
    }
};

// Asks for what is about to be read; cells around a vertex may lie anywhere.
inline void prefetch(const void *place) noexcept {
#ifdef __GNUC__
    __builtin_prefetch(place);
#else
    (void)place;
#endif
}

// The different ids of the corners of a star of few cells, without that of its vertex.
class Few_ids {
public:
    // There are two more corners than cells at most.
    static constexpr std::size_t max_cells = 96;

    explicit Few_ids(std::uint32_t vertex) noexcept {
        std::fill_n(table_, size, DELDRIFT_NONE);
        enter(vertex);
    }
    // Whether an id is new is random, so nothing branches on it.
    void enter(std::uint32_t id) noexcept {
        std::size_t at = id * 2654435769u >> 24;
        while (table_[at] != id && table_[at] != DELDRIFT_NONE) at = (at + 1) % size;
        ids_[n_] = id;
        n_ += table_[at] != id;
        table_[at] = id;
    }
    const std::uint32_t *begin() const noexcept { return ids_ + 1; }
    const std::uint32_t *end() const noexcept { return ids_ + n_; }

private:
    static constexpr std::size_t size = 256;
    std::uint32_t table_[size], ids_[max_cells + 4];
    std::size_t n_ = 0;
};

// Corners of the six edges of a cell.
inline constexpr int edge_corners[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

// Edges of finite cells, each one once: from the cell of the lowest index around it.
template <class Mesh, std::uint32_t D>
struct Finite_edges_3 {
    const Mesh *mesh = nullptr;
    Triple<Cell_handle<Mesh, D>, int, int> operator()(std::size_t k) const {
        return {{mesh, static_cast<std::uint32_t>(k / 6)}, edge_corners[k % 6][0], edge_corners[k % 6][1]};
    }
    bool selects(std::size_t k) const {
        const auto [first, i, j] = (*this)(k);
        Edge_circulator_3<Cell_handle<Mesh, D>, At_cell> around(first.vertex(i), first.vertex(j), first);
        while (*++around != first) {
            const Cell_handle<Mesh, D> c = *around;
            if (!c.is_infinite() && c < first) return false;
        }
        return true;
    }
};

}  // namespace detail

// K has Point_3. Info is that of vertices, or one of CGAL's data structures whose vertices have one.
template <class K, class Info = void>
class Delaunay_triangulation_3 : public detail::Base<3, typename K::Point_3, typename detail::Info_of<Info>::type> {
    using Base = detail::Base<3, typename K::Point_3, typename detail::Info_of<Info>::type>;
    using typename Base::Mesh;
    template <class Source>
    using handles = typename Base::template handles<Source>;

public:
    using Geom_traits = K;
    using typename Base::Point;
    using typename Base::size_type;
    using typename Base::Vertex_handle;
    using Cell_handle = typename Base::Cell;
    using Cell = Cell_handle;
    // The facet opposite a corner of a cell; the edge between two corners.
    using Facet = std::pair<Cell_handle, int>;
    using Edge = detail::Triple<Cell_handle, int, int>;
    enum Locate_type { VERTEX, EDGE, FACET, CELL, OUTSIDE_CONVEX_HULL, OUTSIDE_AFFINE_HULL };

    using Finite_cells_iterator = detail::handle_iterator<detail::Finite_cells<Mesh, 3>>;
    using Finite_cell_handles = handles<detail::Finite_cells<Mesh, 3>>;
    using All_cells_iterator = detail::handle_iterator<detail::All_cells<Mesh, 3>>;
    using All_cell_handles = handles<detail::All_cells<Mesh, 3>>;
    using Finite_facets_iterator = detail::handle_iterator<detail::Finite_facets<Mesh, 3>>;
    using Finite_facets = handles<detail::Finite_facets<Mesh, 3>>;
    using Finite_edges_iterator = detail::handle_iterator<detail::Finite_edges_3<Mesh, 3>>;
    using Finite_edges = handles<detail::Finite_edges_3<Mesh, 3>>;
    using Cell_circulator = detail::Edge_circulator_3<Cell_handle, detail::At_cell>;
    using Facet_circulator = detail::Edge_circulator_3<Cell_handle, detail::At_facet>;

    Delaunay_triangulation_3() = default;
    explicit Delaunay_triangulation_3(const K &) {}
    // Of points, or pairs or tuples of point and info, each of which is read once.
    template <class Iterator, class End, class = std::enable_if_t<detail::Is_sequence<Iterator, End>::value>>
    Delaunay_triangulation_3(Iterator first, End last) {
        this->insert(std::move(first), std::move(last));
    }

    const Point &point(Vertex_handle v) const { return v.point(); }
    const Point &point(Cell_handle c, int i) const { return c.vertex(i).point(); }

    size_type number_of_finite_cells() const { return this->n_cells(); }
    size_type number_of_cells() const { return this->n_cells() + n_hull_facets(); }
    size_type number_of_finite_facets() const { return (4 * this->n_cells() + n_hull_facets()) / 2; }
    // By Euler's relation; none where there are no cells.
    size_type number_of_finite_edges() const {
        const size_type n = this->n_cells();
        return n == 0 ? 0 : this->number_of_vertices() + number_of_finite_facets() - n - 1;
    }

    Finite_cells_iterator finite_cells_begin() const { return finite_cell_handles().begin(); }
    Finite_cells_iterator finite_cells_end() const { return finite_cell_handles().end(); }
    Finite_cell_handles finite_cell_handles() const {
        return this->template all<detail::Finite_cells>(this->n_cells());
    }
    All_cells_iterator all_cells_begin() const { return all_cell_handles().begin(); }
    All_cells_iterator all_cells_end() const { return all_cell_handles().end(); }
    All_cell_handles all_cell_handles() const {
        return this->template all<detail::All_cells>(this->n_cells() + this->n_facets_of_cells());
    }
    Finite_facets_iterator finite_facets_begin() const { return finite_facets().begin(); }
    Finite_facets_iterator finite_facets_end() const { return finite_facets().end(); }
    Finite_facets finite_facets() const { return this->template all<detail::Finite_facets>(this->n_facets_of_cells()); }
    Finite_edges_iterator finite_edges_begin() const { return finite_edges().begin(); }
    Finite_edges_iterator finite_edges_end() const { return finite_edges().end(); }
    Finite_edges finite_edges() const { return this->template all<detail::Finite_edges_3>(6 * this->n_cells()); }

    // Of a finite vertex, to an output iterator, in no particular order; infinite ones included, except where the name
    // says otherwise.
    template <class Output>
    Output incident_cells(Vertex_handle v, Output out) const {
        for (Cell_handle c : star(v, true)) *out++ = c;
        return out;
    }
    template <class Output>
    Output finite_incident_cells(Vertex_handle v, Output out) const {
        for (Cell_handle c : star(v, false)) *out++ = c;
        return out;
    }
    template <class Output>
    Output adjacent_vertices(Vertex_handle v, Output out) const {
        visit_link(v, true, [&](Vertex_handle w) { *out++ = w; });
        return out;
    }
    template <class Output>
    Output finite_adjacent_vertices(Vertex_handle v, Output out) const {
        visit_link(v, false, [&](Vertex_handle w) { *out++ = w; });
        return out;
    }
    template <class Output>
    Output incident_facets(Vertex_handle v, Output out) const {
        return facets_of(v, true, out);
    }
    template <class Output>
    Output finite_incident_facets(Vertex_handle v, Output out) const {
        return facets_of(v, false, out);
    }
    size_type degree(Vertex_handle v) const {
        size_type n = 0;
        visit_link(v, true, [&](Vertex_handle) { n++; });
        return n;
    }

    // Around an edge, infinite cells included.
    Cell_circulator incident_cells(Cell_handle c, int i, int j) const { return {c.vertex(i), c.vertex(j), c}; }
    Cell_circulator incident_cells(const Edge &e) const { return incident_cells(e.first, e.second, e.third); }
    Facet_circulator incident_facets(Cell_handle c, int i, int j) const { return {c.vertex(i), c.vertex(j), c}; }
    Facet_circulator incident_facets(const Edge &e) const { return incident_facets(e.first, e.second, e.third); }

    using Base::is_infinite;
    bool is_infinite(Cell_handle c) const noexcept { return c.is_infinite(); }
    bool is_infinite(Cell_handle c, int i) const {
        const int at = c.is_infinite() ? c.index(this->infinite_vertex()) : i;
        return at != i;
    }
    bool is_infinite(Cell_handle c, int i, int j) const { return is_infinite(c.vertex(i)) || is_infinite(c.vertex(j)); }
    bool is_infinite(const Facet &f) const { return is_infinite(f.first, f.second); }
    bool is_infinite(const Edge &e) const { return is_infinite(e.first, e.second, e.third); }
    Cell_handle infinite_cell() const { return this->infinite_vertex().cell(); }
    int mirror_index(Cell_handle c, int i) const { return c.mirror_index(i); }
    Vertex_handle mirror_vertex(Cell_handle c, int i) const { return c.neighbor(i).vertex(c.mirror_index(i)); }
    Facet mirror_facet(const Facet &f) const { return {f.first.neighbor(f.second), f.first.mirror_index(f.second)}; }

    // The cell that p is in or on, or an infinite cell beyond a facet that faces it. li: the corner that p is at, or
    // opposite the facet that p is on, or of the infinite vertex; li and lj: the ends of the edge that p is on.
    // Vertices in a plane are on no facets here, so that another point is outside of their affine hull, wherever it
    // is.
    Cell_handle locate(const Point &p, Locate_type &lt, int &li, int &lj, Cell_handle hint = {}) const {
        const auto place = this->place_of(p, hint);
        li = lj = 0;
        lt = CELL;
        switch (place.kind) {
        case DELDRIFT_LOCATION_VERTEX:
            lt = VERTEX;
            li = place.cell == nullptr ? 0 : place.cell.index(place.vertex);
            break;
        case DELDRIFT_LOCATION_CELL: {
            int on[4], off[4], n_on = 0, n_off = 0;
            for (int i = 0; i < 4; i++) (place.on_facet[static_cast<std::size_t>(i)] ? on[n_on++] : off[n_off++]) = i;
            if (n_on == 1) {
                lt = FACET;
                li = on[0];
            } else if (n_on == 2) {
                lt = EDGE;
                li = off[0];
                lj = off[1];
            }
            break;
        }
        case DELDRIFT_LOCATION_OUTSIDE:
            lt = OUTSIDE_CONVEX_HULL;
            li = place.cell.index(this->infinite_vertex());
            break;
        case DELDRIFT_LOCATION_NO_CELLS: lt = OUTSIDE_AFFINE_HULL; break;
        }
        return place.cell;
    }
    Cell_handle locate(const Point &p, Cell_handle hint = {}) const { return this->place_of(p, hint).cell; }

    // The centre of the sphere through the corners of a finite cell, rounded.
    Point dual(Cell_handle c) const { return this->centre_of(c); }

private:
    size_type n_hull_facets() const {
        const std::uint32_t *first = this->mesh()->cells().neighbours;
        return static_cast<size_type>(std::count(first, first + this->n_facets_of_cells(), DELDRIFT_NONE));
    }
    std::vector<Cell_handle> star(Vertex_handle v, bool with_infinite) const {
        const typename Mesh::Star star(*this->mesh(), v.id());
        const deldrift_cells_view &rows = this->mesh()->cells();
        std::vector<Cell_handle> cells;
        cells.reserve(star.size() + 8);
        for (std::uint32_t index : star) {
            const Cell_handle c(this->mesh(), index);
            cells.push_back(c);
            for (int i = 0; with_infinite && i < 4; i++) {
                const std::size_t k = std::size_t{index} * 4 + static_cast<std::size_t>(i);
                if (rows.neighbours[k] == DELDRIFT_NONE && rows.vertices[k] != v.id()) cells.push_back(c.neighbor(i));
            }
        }
        return cells;
    }
    // Calls visit with each neighbour of a vertex, once.
    template <class Visit>
    void visit_link(Vertex_handle v, bool with_infinite, Visit visit) const {
        const typename Mesh::Star star(*this->mesh(), v.id());
        const deldrift_cells_view &cells = this->mesh()->cells();
        const auto &by_id = this->mesh()->by_id();
        const bool are_few = star.size() <= detail::Few_ids::max_cells;
        if (are_few) {
            for (std::uint32_t cell : star) detail::prefetch(cells.vertices + std::size_t{cell} * 4);
            detail::Few_ids ids(v.id());
            for (std::uint32_t cell : star) {
                for (std::size_t i = 0; i < 4; i++) ids.enter(cells.vertices[std::size_t{cell} * 4 + i]);
            }
            for (std::uint32_t id : ids) visit(Vertex_handle(by_id[id]));
        } else {
            std::vector<std::uint32_t> ids;
            ids.reserve(4 * star.size());
            for (std::uint32_t cell : star) {
                const std::uint32_t *row = cells.vertices + std::size_t{cell} * 4;
                std::copy_if(row, row + 4, std::back_inserter(ids), [&](std::uint32_t id) { return id != v.id(); });
            }
            std::sort(ids.begin(), ids.end());
            ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
            for (std::uint32_t id : ids) visit(Vertex_handle(by_id[id]));
        }
        if (with_infinite && is_on_hull(v, star)) visit(this->infinite_vertex());
    }
    bool is_on_hull(Vertex_handle v, const typename Mesh::Star &star) const {
        const deldrift_cells_view &cells = this->mesh()->cells();
        bool is_on_hull = false;
        for (std::uint32_t cell : star) {
            const std::size_t first = std::size_t{cell} * 4;
            for (std::size_t k = first; k < first + 4; k++) {
                is_on_hull |= (cells.neighbours[k] == DELDRIFT_NONE) & (cells.vertices[k] != v.id());
            }
        }
        return is_on_hull;
    }
    // Each one once, from the lower of its two cells; if only finite ones are wanted, infinite cells have none.
    template <class Output>
    Output facets_of(Vertex_handle v, bool with_infinite, Output out) const {
        for (Cell_handle c : star(v, with_infinite)) {
            for (int i = 0; i < 4; i++) {
                if (c.vertex(i) == v) continue;
                const Cell_handle other = c.neighbor(i);
                const bool is_other_there = with_infinite || !other.is_infinite();
                if (!is_other_there || c < other) *out++ = Facet(c, i);
            }
        }
        return out;
    }
};

}  // namespace deldrift::cgal

#endif  // DELDRIFT_CGAL_SPACE_HPP
