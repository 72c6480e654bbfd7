// CGAL's names for deldrift: Delaunay_triangulation_2 and _3, Regular_triangulation_2 and _3, and
// Constrained_Delaunay_triangulation_2, with meshes and conforming triangulations of the latter, so far as common programs
// use them.
//
//     using K = deldrift::cgal::Kernel;  // or any kernel of CGAL's with coordinates in double
//     using Dt = deldrift::cgal::Delaunay_triangulation_2<K, unsigned>;  // unsigned: the info of vertices
//     Dt t(points.begin(), points.end());                                // points, or pairs of point and info
//     for (Dt::Face_handle f : t.finite_face_handles()) std::cout << f->vertex(0)->point() << '\n';
//
// It needs no CGAL. Points, handles, iterators, circulators and members are called as there, and mean the same; cells
// are oriented alike, and neighbor(i) is opposite vertex(i). docs/FROM_CGAL.md has the calls side by side, and
// docs/CGAL_EXAMPLES.md CGAL's examples that write the same. What differs:
//
// - Where points are cocircular or cospherical, and cells not unique, other cells may be chosen than CGAL chooses.
// - Handles are small values, not pointers. Those of vertices are valid until the vertex is removed; those of cells
//   until the triangulation changes. Cells have no info: what has changed is told by take_changes(). Faces of constrained
//   triangulations may have one, until the triangulation changes.
// - Vertices that weights hide keep their handles and infos, in space too. Vertices with weights can move, hidden or not.
// - Where the vertices are on a line (in space: in a plane), there are no faces or cells, and no edges or facets.
// - Cells in conflict with a point have it inside of their circle or sphere: what is on it exactly is not in conflict.
//   Only they can be given to star_hole and insert_in_hole.
// - A call that fails throws deldrift::Error and has no effect. Coordinates are finite and of magnitude up to 1e57,
//   weights up to 1e114.
// - Meshes have other vertices, and fulfil criteria that CGAL has itself: see meshing.hpp.
// - Constraints that cross are an exception, or, with Exact_predicates_tag, get a vertex there, rounded.
//
// Besides the functions of CGAL there are stage_move() and commit_timestamp(), by which many vertices move at the
// cost of what changes, and triangulation(), the arrays and queries of deldrift.hpp.
#ifndef DELDRIFT_CGAL_HPP
#define DELDRIFT_CGAL_HPP

#if __cplusplus < 201703L
#error "deldrift/cgal.hpp is for C++17 and later: compile with -std=c++17"
#elif !defined __cpp_exceptions
#error "deldrift/cgal.hpp throws exceptions, which are disabled: use deldrift.h, whose functions return a status"
#else

#include <array>
#include <cstddef>
#include <ostream>

#include "cgal/conforming.hpp"
#include "cgal/constrained.hpp"
#include "cgal/meshing.hpp"
#include "cgal/plane.hpp"
#include "cgal/regular.hpp"
#include "cgal/space.hpp"

namespace deldrift::cgal {

// A point, of which the names of CGAL's are those that read and write coordinates.
template <std::size_t D>
class Point {
public:
    Point() = default;
    Point(double x, double y) noexcept : x_{x, y} { static_assert(D == 2); }
    Point(double x, double y, double z) noexcept : x_{x, y, z} { static_assert(D == 3); }
    double x() const noexcept { return x_[0]; }
    double y() const noexcept { return x_[1]; }
    double z() const noexcept {
        static_assert(D == 3);
        return x_[2];
    }
    double operator[](int i) const noexcept { return x_[static_cast<std::size_t>(i)]; }
    static constexpr int dimension() noexcept { return static_cast<int>(D); }

    friend bool operator==(const Point &a, const Point &b) noexcept { return a.x_ == b.x_; }
    friend bool operator!=(const Point &a, const Point &b) noexcept { return a.x_ != b.x_; }
    friend bool operator<(const Point &a, const Point &b) noexcept { return a.x_ < b.x_; }
    friend std::ostream &operator<<(std::ostream &out, const Point &p) {
        for (std::size_t k = 0; k < D; k++) out << (k == 0 ? "" : " ") << p.x_[k];
        return out;
    }

private:
    std::array<double, D> x_{};
};

using Point_2 = Point<2>;
using Point_3 = Point<3>;

// A point with a weight, which are compared by the points alone, as in CGAL.
template <std::size_t D>
class Weighted_point {
public:
    Weighted_point() = default;
    explicit Weighted_point(const Point<D> &p) noexcept : point_(p) {}
    Weighted_point(const Point<D> &p, double weight) noexcept : point_(p), weight_(weight) {}
    Weighted_point(double x, double y) noexcept : point_(x, y) {}
    Weighted_point(double x, double y, double z) noexcept : point_(x, y, z) {}
    const Point<D> &point() const noexcept { return point_; }
    double weight() const noexcept { return weight_; }
    double x() const noexcept { return point_.x(); }
    double y() const noexcept { return point_.y(); }
    double z() const noexcept { return point_.z(); }
    double operator[](int i) const noexcept { return point_[i]; }
    static constexpr int dimension() noexcept { return static_cast<int>(D); }

    friend bool operator==(const Weighted_point &a, const Weighted_point &b) noexcept { return a.point_ == b.point_; }
    friend bool operator!=(const Weighted_point &a, const Weighted_point &b) noexcept { return !(a == b); }
    friend bool operator<(const Weighted_point &a, const Weighted_point &b) noexcept { return a.point_ < b.point_; }
    friend std::ostream &operator<<(std::ostream &out, const Weighted_point &p) {
        return out << p.point_ << ' ' << p.weight_;
    }

private:
    Point<D> point_{};
    double weight_ = 0;
};

using Weighted_point_2 = Weighted_point<2>;
using Weighted_point_3 = Weighted_point<3>;

struct Kernel {
    using FT = double;
    using Point_2 = cgal::Point_2;
    using Point_3 = cgal::Point_3;
    using Weighted_point_2 = cgal::Weighted_point_2;
    using Weighted_point_3 = cgal::Weighted_point_3;
    using Segment_2 = Simplex<Point_2, 2>;
    using Triangle_2 = Simplex<Point_2, 3>;
    using Segment_3 = Simplex<Point_3, 2>;
    using Triangle_3 = Simplex<Point_3, 3>;
    using Tetrahedron_3 = Simplex<Point_3, 4>;
};

}  // namespace deldrift::cgal

#endif  // __cpp_exceptions

#endif  // DELDRIFT_CGAL_HPP
