// SPDX-License-Identifier: GPL-3.0-or-later
// Voronoi cells in the plane clipped to a disk around the origin: area and centroid in closed form.
#pragma once

#include <array>
#include <functional>
#include <vector>

namespace bench {

using Point2 = std::array<double, 2>;

/// A convex polygon, counter-clockwise.
using Polygon = std::vector<Point2>;

/// The square [-half_width, half_width]^2.
Polygon square(double half_width);

/// Keeps the part of the polygon that is nearer to `site` than to `other`.
void clip_to_bisector(Polygon &polygon, const Point2 &site, const Point2 &other);

struct AreaAndCentroid {
    double area = 0;
    Point2 centroid{0, 0};
};

/// Of the polygon's intersection with the disk of radius `radius`. No quadrature: seen from
/// the disk's centre, every edge contributes signed triangles where it runs inside the disk
/// and signed sectors where it runs outside.
AreaAndCentroid intersect_disk(const Polygon &polygon, double radius);

/// Mass and centroid of a density on that intersection, by quadrature: it is swept by the segments from
/// `site`, a point of it, to its boundary, and Gauss' rule with 6 points is used along the segments and
/// along every straight or circular piece of the boundary (of at most half a radian). The shape is
/// exact, and so are polynomials of degree 8.
AreaAndCentroid intersect_disk(const Polygon &polygon, double radius, const Point2 &site,
                               const std::function<double(double, double)> &density);

}  // namespace bench
