// Regular_triangulation_2 and Regular_triangulation_3: see cgal.hpp.
#ifndef DELDRIFT_CGAL_REGULAR_HPP
#define DELDRIFT_CGAL_REGULAR_HPP

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "plane.hpp"
#include "space.hpp"

namespace deldrift::cgal {

namespace detail {

// What those in the plane and in space have in common, beside what Delaunay triangulations have. A vertex that is
// hidden keeps its handle, its info and its weight, and shows again as soon as the others let it. It is not among the
// finite vertices, and not counted with them.
template <class Common>
class Regular : public Common {
protected:
    using typename Common::Mesh;

public:
    using typename Common::Bare_point;
    using typename Common::size_type;
    using typename Common::Vertex_handle;
    using Weighted_point = typename Common::Point;
    using Weight = double;
    using Hidden_vertices_iterator = typename Common::template list_iterator<Hidden_vertices>;
    using Hidden_vertex_handles = range<Hidden_vertices_iterator>;
    using Hidden_points_iterator = typename Common::template list_iterator<Hidden_points>;
    using Common::Common;
    Regular() = default;

    size_type number_of_hidden_vertices() const { return this->mesh()->hidden().in_order.size(); }
    Hidden_vertices_iterator hidden_vertices_begin() const { return hidden_vertex_handles().begin(); }
    Hidden_vertices_iterator hidden_vertices_end() const { return hidden_vertex_handles().end(); }
    Hidden_vertex_handles hidden_vertex_handles() const {
        return this->template all<Hidden_vertices>(number_of_hidden_vertices());
    }
    Hidden_points_iterator hidden_points_begin() const { return hidden_points().begin(); }
    Hidden_points_iterator hidden_points_end() const { return hidden_points().end(); }
    range<Hidden_points_iterator> hidden_points() const {
        return this->template all<Hidden_points>(number_of_hidden_vertices());
    }

    // The vertex of least power distance, whose power cell has the point.
    template <class... Hint>
    Vertex_handle nearest_power_vertex(const Bare_point &p, Hint...) const {
        return this->nearest(Mesh::numbers_of(Weighted_point(p, 0)));
    }
};

}  // namespace detail

// K has Point_2 and Weighted_point_2. Info is as for Delaunay_triangulation_2.
template <class K, class Info = void>
class Regular_triangulation_2
    : public detail::Regular<
          detail::Plane<K, typename detail::Info_of<Info>::type, detail::Weighted_points<2, K>>> {
    using Base =
        detail::Regular<detail::Plane<K, typename detail::Info_of<Info>::type, detail::Weighted_points<2, K>>>;
    using typename Base::Mesh;

public:
    using typename Base::Bare_point;
    using typename Base::Face_handle;
    using typename Base::Oriented_side;
    using typename Base::Vertex_handle;
    using typename Base::Weighted_point;
    using Base::Base;
    Regular_triangulation_2() = default;

    // On the positive side of the power circle of a face are those points with which the face is in conflict, exactly;
    // of an infinite face that is beyond its edge of the hull.
    Oriented_side power_test(Face_handle f, const Weighted_point &p) const {
        return static_cast<Oriented_side>(detail::side_of_sphere(f, this->mesh(), p));
    }
    // Of two points at one place: the second one is on the positive side if it is heavier.
    Oriented_side power_test(const Weighted_point &p, const Weighted_point &q) const {
        const double before = Mesh::weight_of(p), after = Mesh::weight_of(q);
        return static_cast<Oriented_side>((before < after) - (after < before));
    }
    Bare_point weighted_circumcenter(Face_handle f) const { return this->dual(f); }

    // What get_conflicts_and_boundary has, with the vertices that p would hide.
    template <class Faces, class Edges, class Vertices>
    detail::Triple<Faces, Edges, Vertices> get_conflicts_and_boundary_and_hidden_vertices(
        const Weighted_point &p, Faces faces, Edges edges, Vertices vertices, Face_handle hint = {}) const {
        const auto [faces_end, edges_end] = this->get_conflicts_and_boundary(p, faces, edges, hint);
        return {faces_end, edges_end, get_hidden_vertices(p, vertices, hint)};
    }
    template <class Faces, class Vertices>
    std::pair<Faces, Vertices> get_conflicts_and_hidden_vertices(const Weighted_point &p, Faces faces,
                                                                 Vertices vertices, Face_handle hint = {}) const {
        return {this->get_conflicts(p, faces, hint), get_hidden_vertices(p, vertices, hint)};
    }
    template <class Edges, class Vertices>
    std::pair<Edges, Vertices> get_boundary_of_conflicts_and_hidden_vertices(const Weighted_point &p, Edges edges,
                                                                             Vertices vertices,
                                                                             Face_handle hint = {}) const {
        return {this->get_boundary_of_conflicts(p, edges, hint), get_hidden_vertices(p, vertices, hint)};
    }
    template <class Vertices>
    Vertices get_hidden_vertices(const Weighted_point &p, Vertices vertices, Face_handle hint = {}) const {
        const auto inner = typename Base::Zone(this->mesh(), p, hint).inner_vertices();
        return std::copy(inner.begin(), inner.end(), vertices);
    }
};

// K has Point_3 and Weighted_point_3. The others are as for Delaunay_triangulation_3.
template <class K, class Info = void, class = void, class = void>
class Regular_triangulation_3
    : public detail::Regular<
          detail::Space<K, typename detail::Info_of<Info>::type, detail::Weighted_points<3, K>>> {
    using Base =
        detail::Regular<detail::Space<K, typename detail::Info_of<Info>::type, detail::Weighted_points<3, K>>>;
    using typename Base::Mesh;

public:
    using typename Base::Bounded_side;
    using typename Base::Cell_handle;
    using typename Base::Facet;
    using typename Base::Vertex_handle;
    using typename Base::Weighted_point;
    using Base::Base;
    Regular_triangulation_3() = default;

    // On the bounded side of the power sphere of a cell are those points with which the cell is in conflict, exactly;
    // of an infinite cell that is beyond its facet.
    Bounded_side side_of_power_sphere(Cell_handle c, const Weighted_point &p) const {
        return static_cast<Bounded_side>(detail::side_of_sphere(c, this->mesh(), p));
    }
    // The same of the power circle of a finite facet, for a point in its plane; throws Error where it is not.
    Bounded_side side_of_power_circle(Cell_handle c, int i, const Weighted_point &p) const {
        const Facet other = this->mirror_facet({c, i});
        const auto [finite, corner] = c.is_infinite() ? other : Facet{c, i};
        const auto k = static_cast<std::uint32_t>(corner);
        if (finite.is_infinite() || detail::side_of_facet(finite, k, Mesh::numbers_of(p)) != 0) {
            throw Error(DELDRIFT_INVALID_VALUE, "the facet is infinite, or the point is not in its plane");
        }
        return side_of_power_sphere(finite, p);
    }
    Bounded_side side_of_power_circle(const Facet &f, const Weighted_point &p) const {
        return side_of_power_circle(f.first, f.second, p);
    }

    // The vertices that p would hide.
    template <class Output>
    Output vertices_inside_conflict_zone(const Weighted_point &p, Cell_handle hint, Output out) const {
        const auto inner = typename Base::Zone(this->mesh(), p, hint).inner_vertices();
        return std::copy(inner.begin(), inner.end(), out);
    }
};

}  // namespace deldrift::cgal

#endif  // DELDRIFT_CGAL_REGULAR_HPP
