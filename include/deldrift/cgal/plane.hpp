// Delaunay_triangulation_2: see cgal.hpp.
#ifndef DELDRIFT_CGAL_PLANE_HPP
#define DELDRIFT_CGAL_PLANE_HPP

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

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

// What Delaunay and regular triangulations in the plane have in common.
template <class K, class Info, class Policy>
class Plane : public Base<2, K, Info, Policy> {
    using Base = detail::Base<2, K, Info, Policy>;
    template <class Source>
    using handles = typename Base::template handles<Source>;

protected:
    using typename Base::Mesh;

public:
    using typename Base::Bare_point;
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

    // Finite ones.
    using Vertex_iterator = typename Base::Finite_vertices_iterator;
    using Face_iterator = Finite_faces_iterator;
    using Edge_iterator = Finite_edges_iterator;
    using All_edges_iterator = detail::handle_iterator<detail::All_facets<Mesh, 2>>;
    using All_edges = handles<detail::All_facets<Mesh, 2>>;
    using Segment = typename detail::Simplex_2<K, 2>::type;
    using Triangle = typename detail::Simplex_2<K, 3>::type;
    using Oriented_side = typename detail::Sides<K>::Oriented;

    Plane() = default;
    explicit Plane(const K &traits) : Base(traits) {}
    // Of points, or pairs or tuples of point and info, each of which is read once.
    template <class Iterator, class End, class = std::enable_if_t<detail::Is_sequence<Iterator, End>::value>>
    Plane(Iterator first, End last, const K &traits = K()) : Base(traits) {
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
    All_edges_iterator all_edges_begin() const { return all_edges().begin(); }
    All_edges_iterator all_edges_end() const { return all_edges().end(); }
    All_edges all_edges() const { return this->template all<detail::All_facets>(4 * this->n_facets_of_cells()); }
    Vertex_iterator vertices_begin() const { return this->finite_vertices_begin(); }
    Vertex_iterator vertices_end() const { return this->finite_vertices_end(); }
    Face_iterator faces_begin() const { return finite_faces_begin(); }
    Face_iterator faces_end() const { return finite_faces_end(); }
    Edge_iterator edges_begin() const { return finite_edges_begin(); }
    Edge_iterator edges_end() const { return finite_edges_end(); }
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
    // Whether these vertices, of which one may be infinite, have a common edge or face; which it is.
    bool is_edge(Vertex_handle a, Vertex_handle b) const {
        Face_handle f;
        int i = 0;
        return is_edge(a, b, f, i);
    }
    bool is_edge(Vertex_handle a, Vertex_handle b, Face_handle &f, int &i) const {
        const Face_handle found = this->template cell_with<2>({a, b});
        if (found == nullptr) return false;
        f = found;
        i = 3 - f.index(a) - f.index(b);
        return true;
    }
    bool is_face(Vertex_handle a, Vertex_handle b, Vertex_handle c) const {
        Face_handle f;
        return is_face(a, b, c, f);
    }
    bool is_face(Vertex_handle a, Vertex_handle b, Vertex_handle c, Face_handle &f) const {
        const Face_handle found = this->template cell_with<3>({a, b, c});
        if (found != nullptr) f = found;
        return found != nullptr;
    }
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

    // The faces, infinite ones included, that go when p is inserted, decided exactly, and the edges around them in
    // counter-clockwise order, each by the face that stays. There are none at the place of a vertex, nor where there
    // are no faces. It is found fastest from a face nearby.
    template <class Faces, class Edges>
    std::pair<Faces, Edges> get_conflicts_and_boundary(const Point &p, Faces faces, Edges edges,
                                                       Face_handle hint = {}) const {
        const typename Base::Zone zone(this->mesh(), p, hint);
        const std::vector<Edge> ring = ring_of(zone);
        return {std::copy(zone.cells().begin(), zone.cells().end(), faces), std::copy(ring.begin(), ring.end(), edges)};
    }
    template <class Faces>
    Faces get_conflicts(const Point &p, Faces faces, Face_handle hint = {}) const {
        const typename Base::Zone zone(this->mesh(), p, hint);
        return std::copy(zone.cells().begin(), zone.cells().end(), faces);
    }
    template <class Edges>
    Edges get_boundary_of_conflicts(const Point &p, Edges edges, Face_handle hint = {}) const {
        const std::vector<Edge> ring = ring_of(typename Base::Zone(this->mesh(), p, hint));
        return std::copy(ring.begin(), ring.end(), edges);
    }
    // Inserts p, of which these are all faces and edges that get_conflicts_and_boundary gives; throws Error if they are
    // not.
    template <class Edges, class Faces>
    Vertex_handle star_hole(const Point &p, Edges, Edges, Faces first, Faces last) {
        return this->insert_in_zone(p, first, last);
    }

    // On which side of the boundary of a finite face.
    Oriented_side oriented_side(Face_handle f, const Point &p) const {
        int least = 1;
        for (std::uint32_t i = 0; i < 3; i++) {
            least = (std::min)(least, detail::side_of_facet<Mesh, 2>(f, i, Mesh::numbers_of(p)));
        }
        return static_cast<Oriented_side>(least);
    }

    const Point &point(Vertex_handle v) const { return v.point(); }
    const Point &point(Face_handle f, int i) const { return f.vertex(i).point(); }
    Triangle triangle(Face_handle f) const {
        return Triangle(Policy::bare(point(f, 0)), Policy::bare(point(f, 1)), Policy::bare(point(f, 2)));
    }
    Segment segment(Face_handle f, int i) const {
        return Segment(Policy::bare(point(f, ccw(i))), Policy::bare(point(f, cw(i))));
    }
    Segment segment(const Edge &e) const { return segment(e.first, e.second); }

    // The centre of the circle, or power circle, of a finite face, rounded; by the kernel's
    // construct_circumcenter_2_object or construct_weighted_circumcenter_2_object, if it has that.
    Bare_point dual(Face_handle f) const { return this->centre_of(f); }
    // The edge of the Voronoi or power diagram across a finite edge: a segment, or a ray. The kernel is one of CGAL's.
    template <class Traits = K>
    typename Traits::Object_2 dual(const Edge &e) const {
        typename Traits::Object_2 object;
        const auto keep = [&](const auto &of_voronoi) {
            object = this->geom_traits().construct_object_2_object()(of_voronoi);
        };
        visit_dual(e, keep);
        return object;
    }
    // `stream << edge` for each edge of that diagram.
    template <class Stream>
    Stream &draw_dual(Stream &stream) const {
        for (const Edge &e : finite_edges()) visit_dual(e, [&](const auto &of_voronoi) { stream << of_voronoi; });
        return stream;
    }

private:
    // From the edge whose first vertex is the lowest.
    static std::vector<Edge> ring_of(const typename Base::Zone &zone) {
        std::map<Vertex_handle, Edge> from;
        for (const auto &[f, i] : zone.boundary()) {
            from.emplace(f.vertex(ccw(i)), Edge(f.neighbor(i), f.mirror_index(i)));
        }
        std::vector<Edge> ring;
        for (auto at = from.begin(); ring.size() < from.size();) {
            const Edge &e = at->second;
            ring.push_back(e);
            at = from.find(e.first.vertex(ccw(e.second)));
        }
        return ring;
    }
    template <class Visit>
    void visit_dual(const Edge &e, Visit visit) const {
        const auto &traits = this->geom_traits();
        const Edge other = mirror_edge(e);
        if (!is_infinite(e.first) && !is_infinite(other.first)) {
            visit(traits.construct_segment_2_object()(dual(e.first), dual(other.first)));
        } else {
            const auto &[f, i] = is_infinite(e.first) ? other : e;
            const auto away = Policy::bisector(traits, point(f, cw(i)), point(f, ccw(i)));
            visit(traits.construct_ray_2_object()(dual(f), away));
        }
    }
    // A hidden vertex has no faces around it.
    static Face_handle first_face(Vertex_handle v, Face_handle f) {
        if (v.is_hidden()) return nullptr;
        return f == nullptr ? v.face() : f;
    }
};

}  // namespace detail

// K has Point_2. Info is that of vertices, or one of CGAL's data structures whose vertices have one.
template <class K, class Info = void>
class Delaunay_triangulation_2
    : public detail::Plane<K, typename detail::Info_of<Info>::type, detail::Plain_points<2, K>> {
    using Base = detail::Plane<K, typename detail::Info_of<Info>::type, detail::Plain_points<2, K>>;

public:
    using typename Base::Face_handle;
    using typename Base::Oriented_side;
    using typename Base::Point;
    using typename Base::Vertex_handle;
    using Base::Base;
    Delaunay_triangulation_2() = default;

    template <class... Hint>
    Vertex_handle nearest_vertex(const Point &p, Hint...) const {
        return this->nearest(detail::Coordinates<2, K>::of(p));
    }
    // On which side of the circle through the corners, decided exactly; of an infinite face, of its edge of the hull.
    Oriented_side side_of_oriented_circle(Face_handle f, const Point &p) const {
        return static_cast<Oriented_side>(detail::side_of_sphere(f, this->mesh(), p));
    }
    Point circumcenter(Face_handle f) const { return this->dual(f); }
};

}  // namespace deldrift::cgal

#endif  // DELDRIFT_CGAL_PLANE_HPP
