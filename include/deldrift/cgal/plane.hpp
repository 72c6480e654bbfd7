// Delaunay_triangulation_2: see cgal.hpp.
#ifndef DELDRIFT_CGAL_PLANE_HPP
#define DELDRIFT_CGAL_PLANE_HPP

#include "base.hpp"

namespace deldrift::cgal {

namespace detail {

// Around a vertex in counter-clockwise order, without an end. At gives what it stands for, from a face and the corner
// of the vertex in it.
template <class Face_handle, class At>
class Circulator {
    using Vertex_handle = typename Face_handle::Vertex;

public:
    using value_type = std::decay_t<decltype(std::declval<At>()(std::declval<Face_handle>(), 0))>;
    using reference = value_type;
    using pointer = arrow<value_type>;
    using difference_type = std::ptrdiff_t;
    using size_type = std::size_t;
    using iterator_category = std::bidirectional_iterator_tag;

    Circulator() = default;
    Circulator(Vertex_handle v, Face_handle f) : v_(v), f_(f) {}
    value_type operator*() const { return At()(f_, f_.index(v_)); }
    pointer operator->() const { return pointer(**this); }
    operator value_type() const { return **this; }
    Circulator &operator++() {
        f_ = f_.neighbor((f_.index(v_) + 1) % 3);
        return *this;
    }
    Circulator &operator--() {
        f_ = f_.neighbor((f_.index(v_) + 2) % 3);
        return *this;
    }
    Circulator operator++(int) {
        Circulator before = *this;
        ++*this;
        return before;
    }
    Circulator operator--(int) {
        Circulator before = *this;
        --*this;
        return before;
    }
    bool is_empty() const noexcept { return f_ == nullptr; }
    friend bool operator==(const Circulator &a, const Circulator &b) noexcept { return a.v_ == b.v_ && a.f_ == b.f_; }
    friend bool operator!=(const Circulator &a, const Circulator &b) noexcept { return !(a == b); }
    friend bool operator==(const Circulator &a, std::nullptr_t) noexcept { return a.is_empty(); }
    friend bool operator!=(const Circulator &a, std::nullptr_t) noexcept { return !a.is_empty(); }

private:
    Vertex_handle v_;
    Face_handle f_;
};

struct At_face {
    template <class Face_handle>
    Face_handle operator()(Face_handle f, int) const {
        return f;
    }
};
struct At_vertex {
    template <class Face_handle>
    typename Face_handle::Vertex operator()(Face_handle f, int i) const {
        return f.vertex((i + 1) % 3);
    }
};
struct At_edge {
    template <class Face_handle>
    std::pair<Face_handle, int> operator()(Face_handle f, int i) const {
        return {f, (i + 1) % 3};
    }
};

}  // namespace detail

// K has Point_2. Info is that of vertices, or one of CGAL's data structures whose vertices have one.
template <class K, class Info = void>
class Delaunay_triangulation_2 : public detail::Base<2, typename K::Point_2, typename detail::Info_of<Info>::type> {
    using Base = detail::Base<2, typename K::Point_2, typename detail::Info_of<Info>::type>;
    using typename Base::Mesh;
    template <class Source>
    using handles = typename Base::template handles<Source>;

public:
    using Geom_traits = K;
    using typename Base::Point;
    using typename Base::size_type;
    using typename Base::Vertex_handle;
    using Face_handle = typename Base::Cell;
    using Face = Face_handle;
    // The edge opposite a corner of a face.
    using Edge = std::pair<Face_handle, int>;
    enum Locate_type { VERTEX, EDGE, FACE, OUTSIDE_CONVEX_HULL, OUTSIDE_AFFINE_HULL };

    using Finite_faces_iterator = detail::handle_iterator<detail::Finite_cells<Mesh, 2>>;
    using Finite_face_handles = handles<detail::Finite_cells<Mesh, 2>>;
    using All_faces_iterator = detail::handle_iterator<detail::All_cells<Mesh, 2>>;
    using All_face_handles = handles<detail::All_cells<Mesh, 2>>;
    using Finite_edges_iterator = detail::handle_iterator<detail::Finite_facets<Mesh, 2>>;
    using Finite_edges = handles<detail::Finite_facets<Mesh, 2>>;
    using Face_circulator = detail::Circulator<Face_handle, detail::At_face>;
    using Vertex_circulator = detail::Circulator<Face_handle, detail::At_vertex>;
    using Edge_circulator = detail::Circulator<Face_handle, detail::At_edge>;

    Delaunay_triangulation_2() = default;
    explicit Delaunay_triangulation_2(const K &) {}
    // Of points, or pairs or tuples of point and info, each of which is read once.
    template <class Iterator, class End, class = std::enable_if_t<detail::Is_sequence<Iterator, End>::value>>
    Delaunay_triangulation_2(Iterator first, End last) {
        this->insert(std::move(first), std::move(last));
    }

    static int ccw(int i) noexcept { return (i + 1) % 3; }
    static int cw(int i) noexcept { return (i + 2) % 3; }

    size_type number_of_faces() const { return this->n_cells(); }
    // By Euler's relation, also where there are no faces: then the vertices are on a line.
    size_type number_of_edges() const {
        const size_type n = this->number_of_vertices();
        return n == 0 ? 0 : n + number_of_faces() - 1;
    }

    Finite_faces_iterator finite_faces_begin() const { return finite_face_handles().begin(); }
    Finite_faces_iterator finite_faces_end() const { return finite_face_handles().end(); }
    Finite_face_handles finite_face_handles() const {
        return this->template all<detail::Finite_cells>(this->n_cells());
    }
    All_faces_iterator all_faces_begin() const { return all_face_handles().begin(); }
    All_faces_iterator all_faces_end() const { return all_face_handles().end(); }
    All_face_handles all_face_handles() const {
        return this->template all<detail::All_cells>(this->n_cells() + this->n_facets_of_cells());
    }
    Finite_edges_iterator finite_edges_begin() const { return finite_edges().begin(); }
    Finite_edges_iterator finite_edges_end() const { return finite_edges().end(); }
    Finite_edges finite_edges() const { return this->template all<detail::Finite_facets>(this->n_facets_of_cells()); }

    // In counter-clockwise order, infinite ones included; from a face with v, if one is given.
    Face_circulator incident_faces(Vertex_handle v, Face_handle f = {}) const { return {v, first_face(v, f)}; }
    Edge_circulator incident_edges(Vertex_handle v, Face_handle f = {}) const { return {v, first_face(v, f)}; }
    Vertex_circulator incident_vertices(Vertex_handle v, Face_handle f = {}) const { return {v, first_face(v, f)}; }
    size_type degree(Vertex_handle v) const {
        const Face_circulator first = incident_faces(v);
        size_type n = 0;
        if (first.is_empty()) return n;
        Face_circulator f = first;
        do n++;
        while (++f != first);
        return n;
    }

    using Base::is_infinite;
    bool is_infinite(Face_handle f) const noexcept { return f.is_infinite(); }
    bool is_infinite(Face_handle f, int i) const {
        return is_infinite(f.vertex(ccw(i))) || is_infinite(f.vertex(cw(i)));
    }
    bool is_infinite(const Edge &e) const { return is_infinite(e.first, e.second); }
    Face_handle infinite_face() const { return this->infinite_vertex().face(); }
    int mirror_index(Face_handle f, int i) const { return f.mirror_index(i); }
    Vertex_handle mirror_vertex(Face_handle f, int i) const { return f.neighbor(i).vertex(f.mirror_index(i)); }
    Edge mirror_edge(const Edge &e) const { return {e.first.neighbor(e.second), e.first.mirror_index(e.second)}; }

    // The face that p is in or on, or an infinite face beyond an edge that faces it. li: the corner that p is at, or
    // opposite the edge that p is on, or of the infinite vertex. Vertices on a line are on no edges here, so that
    // another point is outside of their affine hull, wherever it is.
    Face_handle locate(const Point &p, Locate_type &lt, int &li, Face_handle hint = {}) const {
        const auto place = this->place_of(p, hint);
        li = 4;
        lt = FACE;
        switch (place.kind) {
        case DELDRIFT_LOCATION_VERTEX:
            lt = VERTEX;
            li = place.cell == nullptr ? 4 : place.cell.index(place.vertex);
            break;
        case DELDRIFT_LOCATION_CELL:
            for (int i = 0; i < 3; i++) {
                if (!place.on_facet[static_cast<std::size_t>(i)]) continue;
                lt = EDGE;
                li = i;
            }
            break;
        case DELDRIFT_LOCATION_OUTSIDE:
            lt = OUTSIDE_CONVEX_HULL;
            li = place.cell.index(this->infinite_vertex());
            break;
        case DELDRIFT_LOCATION_NO_CELLS: lt = OUTSIDE_AFFINE_HULL; break;
        }
        return place.cell;
    }
    Face_handle locate(const Point &p, Face_handle hint = {}) const { return this->place_of(p, hint).cell; }

    // The centre of the circle through the corners of a finite face, rounded.
    Point dual(Face_handle f) const { return this->centre_of(f); }
    Point circumcenter(Face_handle f) const { return this->centre_of(f); }

private:
    static Face_handle first_face(Vertex_handle v, Face_handle f) { return f == nullptr ? v.face() : f; }
};

}  // namespace deldrift::cgal

#endif  // DELDRIFT_CGAL_PLANE_HPP
