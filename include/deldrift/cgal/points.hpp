// The points that a triangulation has, plain ones or points with weights: see cgal.hpp.
#ifndef DELDRIFT_CGAL_POINTS_HPP
#define DELDRIFT_CGAL_POINTS_HPP

#include <array>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "kernel.hpp"

namespace deldrift::cgal::detail {

// Whether a kernel gives the centres of power circles and power spheres itself.
template <class K, class = void>
struct Has_weighted_circumcenter_2 : std::false_type {};
template <class K>
struct Has_weighted_circumcenter_2<
    K, std::void_t<decltype(std::declval<const K &>().construct_weighted_circumcenter_2_object())>> : std::true_type {};
template <class K, class = void>
struct Has_weighted_circumcenter_3 : std::false_type {};
template <class K>
struct Has_weighted_circumcenter_3<
    K, std::void_t<decltype(std::declval<const K &>().construct_weighted_circumcenter_3_object())>> : std::true_type {};

// Those of a Delaunay triangulation: without weights.
template <std::uint32_t D, class K>
struct Plain_points {
    static constexpr bool are_weighted = false;
    static constexpr bool have_centres = D == 2 ? Has_circumcenter_2<K>::value : Has_circumcenter_3<K>::value;
    using Point = typename Coordinates<D, K>::Point;
    using Bare_point = Point;
    static const Bare_point &bare(const Point &p) noexcept { return p; }
    static std::array<double, D> of(const Point &p) { return Coordinates<D, K>::of(p); }
    static double weight_of(const Point &) noexcept { return 0; }
    static Point point(const std::array<double, D> &x, double = 0) { return Coordinates<D, K>::point(x); }

    // By the kernel: the centre of the circle or sphere through points, and the line as far from one as from another.
    template <class... Points>
    static Bare_point centre(const K &traits, const Points &...points) {
        if constexpr (D == 2) {
            return traits.construct_circumcenter_2_object()(points...);
        } else {
            return traits.construct_circumcenter_3_object()(points...);
        }
    }
    static auto bisector(const K &traits, const Point &p, const Point &q) {
        return traits.construct_bisector_2_object()(p, q);
    }
};

template <std::uint32_t D, class K>
struct Weighted_point_of {
    using type = typename K::Weighted_point_2;
};
template <class K>
struct Weighted_point_of<3, K> {
    using type = typename K::Weighted_point_3;
};

// Those of a regular triangulation.
template <std::uint32_t D, class K>
struct Weighted_points {
    static constexpr bool are_weighted = true;
    static constexpr bool have_centres =
        D == 2 ? Has_weighted_circumcenter_2<K>::value : Has_weighted_circumcenter_3<K>::value;
    using Point = typename Weighted_point_of<D, K>::type;
    using Bare_point = typename Coordinates<D, K>::Point;
    static Bare_point bare(const Point &p) { return p.point(); }
    static std::array<double, D> of(const Point &p) { return Coordinates<D, K>::of(p.point()); }
    static double weight_of(const Point &p) {
        static_assert(std::is_convertible_v<decltype(p.weight()), double>, "weights must be doubles");
        return static_cast<double>(p.weight());
    }
    static Point point(const std::array<double, D> &x, double weight = 0) {
        return Point(Coordinates<D, K>::point(x), weight);
    }

    template <class... Points>
    static Bare_point centre(const K &traits, const Points &...points) {
        if constexpr (D == 2) {
            return traits.construct_weighted_circumcenter_2_object()(points...);
        } else {
            return traits.construct_weighted_circumcenter_3_object()(points...);
        }
    }
    static auto bisector(const K &traits, const Point &p, const Point &q) {
        return traits.construct_radical_axis_2_object()(p, q);
    }
};

}  // namespace deldrift::cgal::detail

#endif  // DELDRIFT_CGAL_POINTS_HPP
