// What is used of a kernel, CGAL's, deldrift's or a program's own: see cgal.hpp.
#ifndef DELDRIFT_CGAL_KERNEL_HPP
#define DELDRIFT_CGAL_KERNEL_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <type_traits>
#include <utility>

// Names of CGAL's that stand for something here, without its headers.
namespace CGAL {
template <class R>
class Projection_traits_xy_3;
template <class R>
class Projection_traits_xz_3;
template <class R>
class Projection_traits_yz_3;
template <class Tag>
struct Location_policy;
struct Default;
struct Exact_intersections_tag;
struct Exact_predicates_tag;
}  // namespace CGAL

namespace deldrift::cgal {

// Where a point is to a circle or sphere. The numbers are those of CGAL.
enum Oriented_side { ON_NEGATIVE_SIDE = -1, ON_ORIENTED_BOUNDARY = 0, ON_POSITIVE_SIDE = 1 };
enum Bounded_side { ON_UNBOUNDED_SIDE = -1, ON_BOUNDARY = 0, ON_BOUNDED_SIDE = 1 };

// A segment, triangle or tetrahedron, of N points.
template <class P, std::size_t N>
class Simplex {
public:
    using Point = P;
    Simplex() = default;
    template <class... Points, class = std::enable_if_t<sizeof...(Points) == N>>
    explicit Simplex(const Points &...points) : points_{points...} {}
    const Point &vertex(int i) const noexcept { return points_[static_cast<std::size_t>(i)]; }
    const Point &operator[](int i) const noexcept { return vertex(i); }
    const Point &source() const noexcept { return points_.front(); }
    const Point &target() const noexcept { return points_.back(); }

    friend bool operator==(const Simplex &a, const Simplex &b) noexcept { return a.points_ == b.points_; }
    friend bool operator!=(const Simplex &a, const Simplex &b) noexcept { return !(a == b); }
    friend std::ostream &operator<<(std::ostream &out, const Simplex &s) {
        for (std::size_t i = 0; i < N; i++) out << (i == 0 ? "" : " ") << s.points_[i];
        return out;
    }

private:
    std::array<Point, N> points_{};
};

// The infos of vertices and of faces, of which either may be void.
template <class Vertices, class Faces>
struct Infos {};

namespace detail {

// Those coordinates of a kernel's points that are triangulated.
template <std::uint32_t D, class K>
struct Coordinates;
template <class K>
struct Coordinates<2, K> {
    using Point = typename K::Point_2;
    static std::array<double, 2> of(const Point &p) {
        static_assert(std::is_constructible_v<Point, double, double>,
                      "points in space are projected by CGAL's Projection_traits_xy_3, _xz_3 and _yz_3 only");
        static_assert(std::is_convertible_v<decltype(p.x()), double>, "coordinates must be doubles");
        return {static_cast<double>(p.x()), static_cast<double>(p.y())};
    }
    static Point point(const std::array<double, 2> &x) { return Point(x[0], x[1]); }
};
template <class K>
struct Coordinates<3, K> {
    using Point = typename K::Point_3;
    static std::array<double, 3> of(const Point &p) {
        static_assert(std::is_convertible_v<decltype(p.x()), double>, "coordinates must be doubles");
        return {static_cast<double>(p.x()), static_cast<double>(p.y()), static_cast<double>(p.z())};
    }
    static Point point(const std::array<double, 3> &x) { return Point(x[0], x[1], x[2]); }
};
// Points in space, of which two coordinates are triangulated.
template <class R, std::size_t first, std::size_t second>
struct Projected {
    using Point = typename R::Point_3;
    static std::array<double, 2> of(const Point &p) {
        const std::array<double, 3> x = Coordinates<3, R>::of(p);
        return {x[first], x[second]};
    }
    static Point point(const std::array<double, 2> &x) {
        std::array<double, 3> in_space{};
        in_space[first] = x[0];
        in_space[second] = x[1];
        return Coordinates<3, R>::point(in_space);
    }
};
template <class R>
struct Coordinates<2, CGAL::Projection_traits_xy_3<R>> : Projected<R, 0, 1> {};
template <class R>
struct Coordinates<2, CGAL::Projection_traits_xz_3<R>> : Projected<R, 0, 2> {};
template <class R>
struct Coordinates<2, CGAL::Projection_traits_yz_3<R>> : Projected<R, 1, 2> {};

// Objects of a kernel, or those of this file where it has none.
template <class K, std::size_t N, class = void>
struct Simplex_2 {
    using type = Simplex<typename K::Point_2, N>;
};
template <class K>
struct Simplex_2<K, 2, std::void_t<typename K::Segment_2>> {
    using type = typename K::Segment_2;
};
template <class K>
struct Simplex_2<K, 3, std::void_t<typename K::Triangle_2>> {
    using type = typename K::Triangle_2;
};
template <class K, std::size_t N, class = void>
struct Simplex_3 {
    using type = Simplex<typename K::Point_3, N>;
};
template <class K>
struct Simplex_3<K, 2, std::void_t<typename K::Segment_3>> {
    using type = typename K::Segment_3;
};
template <class K>
struct Simplex_3<K, 3, std::void_t<typename K::Triangle_3>> {
    using type = typename K::Triangle_3;
};
template <class K>
struct Simplex_3<K, 4, std::void_t<typename K::Tetrahedron_3>> {
    using type = typename K::Tetrahedron_3;
};
template <class K, class = void>
struct Sides {
    using Oriented = Oriented_side;
    using Bounded = Bounded_side;
};
template <class K>
struct Sides<K, std::void_t<typename K::Oriented_side, typename K::Bounded_side>> {
    using Oriented = typename K::Oriented_side;
    using Bounded = typename K::Bounded_side;
};

// Whether a kernel gives circumcentres itself.
template <class K, class = void>
struct Has_circumcenter_2 : std::false_type {};
template <class K>
struct Has_circumcenter_2<K, std::void_t<decltype(std::declval<const K &>().construct_circumcenter_2_object())>>
    : std::true_type {};
template <class K, class = void>
struct Has_circumcenter_3 : std::false_type {};
template <class K>
struct Has_circumcenter_3<K, std::void_t<decltype(std::declval<const K &>().construct_circumcenter_3_object())>>
    : std::true_type {};

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
template <class Tag>
struct Info_of<CGAL::Location_policy<Tag>> {
    using type = void;
};
template <>
struct Info_of<CGAL::Default> {
    using type = void;
};

// That of faces, which only one of CGAL's data structures has.
template <class T, class = void>
struct Info_of_faces {
    using type = void;
};
template <class T>
struct Info_of_faces<T, std::void_t<typename T::Face>> : Info_of_vertex<typename T::Face> {};

// Infos, or that of vertices alone.
template <class Info>
struct Parts_of {
    using Vertices = Info;
    using Faces = void;
};
template <class V, class F>
struct Parts_of<Infos<V, F>> {
    using Vertices = V;
    using Faces = F;
};

}  // namespace detail

}  // namespace deldrift::cgal

#endif  // DELDRIFT_CGAL_KERNEL_HPP
