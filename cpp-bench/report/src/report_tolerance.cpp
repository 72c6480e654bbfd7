// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_tolerance.hpp"

#include <algorithm>

namespace bench {
namespace {

/// 1 / d by equation (7), d being off by at most `error`; nothing is certain where that is not well below
/// |d|.
Bounded reciprocal(double d, double error) {
    const double least = std::fabs(d) - error;
    if (!(least > error)) return {0, HUGE_VAL};
    return {1 / d, error / (least * least) + unit_roundoff / least};
}

/// The squared distance of a point, as given, from a centre that was computed.
template <unsigned dimension>
Bounded squared_distance_from(const std::array<Bounded, dimension> &centre, const Place<dimension> &point) {
    Bounded sum;
    for (unsigned axis = 0; axis < dimension; ++axis) {
        const Bounded difference = Bounded{point[axis], 0} - centre[axis];
        sum = axis == 0 ? difference * difference : sum + difference * difference;
    }
    return sum;
}

std::array<Bounded, 2> centre_of(const BicellPoints<2> &bicell, double L) {
    const auto &[p1, p4] = bicell.facet;
    const auto &[p2, p3] = bicell.opposing;
    const auto square = [](const Place<2> &p) { return p[0] * p[0] + p[1] * p[1]; };
    // Bisectors a x + b y + c = 0 of either pair of points.
    const double a1 = 2 * (p2[0] - p3[0]), b1 = 2 * (p2[1] - p3[1]), c1 = square(p3) - square(p2);
    const double a2 = 2 * (p1[0] - p4[0]), b2 = 2 * (p1[1] - p4[1]), c2 = square(p4) - square(p1);
    const double d = a1 * b2 - b1 * a2;
    const double error_of_d = 128 * L * L * unit_roundoff;
    const double error_of_n = 192 * L * L * L * unit_roundoff;
    const Bounded inverse = reciprocal(d, error_of_d);
    return {Bounded{b1 * c2 - b2 * c1, error_of_n} * inverse,
            Bounded{a2 * c1 - a1 * c2, error_of_n} * inverse};
}

std::array<Bounded, 3> centre_of(const BicellPoints<3> &bicell, double L) {
    const auto &[p2, p3, p4] = bicell.facet;
    const auto &[p1, p5] = bicell.opposing;
    const auto square = [](const Place<3> &p) { return p[0] * p[0] + p[1] * p[1] + p[2] * p[2]; };
    // Bisectors a x + b y + c z = d of three pairs of points.
    struct Bisector {
        double a, b, c, d;
    };
    const auto bisector = [&](const Place<3> &p, const Place<3> &q) {
        return Bisector{2 * (p[0] - q[0]), 2 * (p[1] - q[1]), 2 * (p[2] - q[2]), square(p) - square(q)};
    };
    const Bisector e = bisector(p1, p5), f = bisector(p2, p4), g = bisector(p4, p3);
    const auto minor = [](double a, double b, double c, double d) { return a * d - b * c; };
    const double x_ef = minor(e.b, e.c, f.b, f.c), x_eg = minor(e.b, e.c, g.b, g.c),
                 x_fg = minor(f.b, f.c, g.b, g.c);
    const double y_ef = minor(e.c, e.a, f.c, f.a), y_eg = minor(e.c, e.a, g.c, g.a),
                 y_fg = minor(f.c, f.a, g.c, g.a);
    const double z_ef = minor(e.a, e.b, f.a, f.b), z_eg = minor(e.a, e.b, g.a, g.b),
                 z_fg = minor(f.a, f.b, g.a, g.b);
    const double d = z_ef * g.c - z_eg * f.c + z_fg * e.c;
    const double error_of_d = 2944 * L * L * L * unit_roundoff;
    // The report has 5,568 here; its own inputs give 3 (128 * 6 + 22 * 32) + 8 * 6 * 32 = 5,952.
    const double error_of_n = 5952 * L * L * L * L * unit_roundoff;
    const Bounded inverse = reciprocal(d, error_of_d);
    return {Bounded{x_ef * g.d - x_eg * f.d + x_fg * e.d, error_of_n} * inverse,
            Bounded{y_ef * g.d - y_eg * f.d + y_fg * e.d, error_of_n} * inverse,
            Bounded{z_ef * g.d - z_eg * f.d + z_fg * e.d, error_of_n} * inverse};
}

double squared_norm(const Place<3> &v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

Place<3> cross(const Place<3> &a, const Place<3> &b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Place<3> minus(const Place<3> &a, const Place<3> &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// Numerators and norms are of a few dozen roundings each, which this more than covers.
constexpr double less_rounding = 1 - 0x1p-40;

}  // namespace

template <unsigned dimension>
std::array<Bounded, dimension> annulus_centre(const BicellPoints<dimension> &bicell, CoordinateBound bound) {
    return centre_of(bicell, bound.value());
}

template <unsigned dimension>
double squared_half_annulus_width(const BicellPoints<dimension> &bicell, CoordinateBound bound) {
    const std::array<Bounded, dimension> centre = annulus_centre<dimension>(bicell, bound);
    const Bounded inner = squared_distance_from<dimension>(centre, bicell.facet[0]);
    const Bounded outer = squared_distance_from<dimension>(centre, bicell.opposing[1]);
    // (sqrt(R^2) - sqrt(r^2))^2 is no width where the facet is outside.
    if (!(outer.value - outer.error > inner.value + inner.error)) return 0;
    const Bounded root = sqrt(inner * outer);
    const Bounded twice{2 * root.value, 2 * root.error};
    const Bounded width = inner + outer - twice;
    const double least = (width.value - width.error) / 4;
    return least > 0 ? least : 0;
}

template std::array<Bounded, 2> annulus_centre<2>(const BicellPoints<2> &, CoordinateBound);
template std::array<Bounded, 3> annulus_centre<3>(const BicellPoints<3> &, CoordinateBound);
template double squared_half_annulus_width<2>(const BicellPoints<2> &, CoordinateBound);
template double squared_half_annulus_width<3>(const BicellPoints<3> &, CoordinateBound);

template <>
double squared_half_simplex_width<2>(const std::array<Place<2>, 3> &p, CoordinateBound bound) {
    const double ux = p[1][0] - p[0][0], uy = p[1][1] - p[0][1];
    const double vx = p[2][0] - p[0][0], vy = p[2][1] - p[0][1];
    // Twice the area, less four times what two products of rounded differences can be off: 2 (2L)(2L) 3u
    // each.
    const double volume = std::fabs(ux * vy - uy * vx) - 128 * bound.value() * bound.value() * unit_roundoff;
    if (!(volume > 0)) return 0;
    const double longest =
        std::max({ux * ux + uy * uy, vx * vx + vy * vy, (vx - ux) * (vx - ux) + (vy - uy) * (vy - uy)});
    return volume * volume / (4 * longest) * less_rounding;
}

/// The width of a tetrahedron is its least height or the least distance of two opposite edges: in either case
/// six times the volume over the norm of a vector product.
template <>
double squared_half_simplex_width<3>(const std::array<Place<3>, 4> &p, CoordinateBound bound) {
    const Place<3> u = minus(p[1], p[0]), v = minus(p[2], p[0]), w = minus(p[3], p[0]);
    const Place<3> uv = cross(u, v);
    const double L = bound.value();
    const double volume =
        std::fabs(uv[0] * w[0] + uv[1] * w[1] + uv[2] * w[2]) - 1024 * L * L * L * unit_roundoff;
    if (!(volume > 0)) return 0;
    const double greatest =
        std::max({squared_norm(uv), squared_norm(cross(v, w)), squared_norm(cross(w, u)),
                  squared_norm(cross(minus(v, u), minus(w, u))),                             // heights
                  squared_norm(cross(u, minus(w, v))), squared_norm(cross(v, minus(w, u))),  // opposite edges
                  squared_norm(cross(w, minus(v, u)))});
    return volume * volume / (4 * greatest) * less_rounding;
}

}  // namespace bench
