// SPDX-License-Identifier: GPL-3.0-or-later
// Section 4 of the report: tolerances and displacements in doubles, with bounds of their rounding errors that
// are static as far as a division or a square root allows. Written from the report's formulas.
#pragma once

#include <array>
#include <cmath>

namespace bench {

/// u = 2^-53, half of the report's ulp(1).
constexpr double unit_roundoff = 0x1p-53;

/// What the error bounds depend on: a power of two that no coordinate exceeds, in the report's words L.
class CoordinateBound {
public:
    CoordinateBound() = default;

    /// The least power of two above `magnitude`.
    explicit CoordinateBound(double magnitude) : value_(std::exp2(std::ceil(std::log2(magnitude)))) {}

    double value() const { return value_; }

private:
    double value_ = 1;
};

/// A computed value and a bound of its absolute error, first order in u as in section 4.1.
struct Bounded {
    double value = 0;
    double error = 0;
};

inline Bounded operator+(const Bounded &a, const Bounded &b) {
    const double sum = a.value + b.value;
    return {sum, a.error + b.error + std::fabs(sum) * unit_roundoff};
}

inline Bounded operator-(const Bounded &a, const Bounded &b) {
    const double difference = a.value - b.value;
    return {difference, a.error + b.error + std::fabs(difference) * unit_roundoff};
}

inline Bounded operator*(const Bounded &a, const Bounded &b) {
    const double product = a.value * b.value;
    return {product,
            a.error * std::fabs(b.value) + b.error * std::fabs(a.value) + std::fabs(product) * unit_roundoff};
}

/// Equation (8); the error is infinite where the filter fails.
inline Bounded sqrt(const Bounded &a) {
    const double root = std::sqrt(a.value);
    const double least = a.value - a.error;
    if (!(least > 0)) return {root, HUGE_VAL};
    return {root, a.error / (2 * std::sqrt(least)) + root * unit_roundoff};
}

template <unsigned dimension>
using Place = std::array<double, dimension>;

/// A bi-cell's points: the opposing vertices and those of the interior facet.
template <unsigned dimension>
struct BicellPoints {
    std::array<Place<dimension>, 2> opposing;
    std::array<Place<dimension>, dimension> facet;
};

template <unsigned dimension>
double squared_distance(const double *a, const double *b) {
    double sum = 0;
    for (unsigned axis = 0; axis < dimension; ++axis) sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
    return sum;
}

/// What to add to a computed squared distance for an upper bound: 32 L^2 u in the plane, 56 L^2 u in space.
template <unsigned dimension>
double squared_distance_error(CoordinateBound bound) {
    return (dimension == 2 ? 32 : 56) * bound.value() * bound.value() * unit_roundoff;
}

/// Centre of the annulus that generates the standard delimiter, each coordinate with its error; the errors
/// are infinite where the filter fails.
template <unsigned dimension>
std::array<Bounded, dimension> annulus_centre(const BicellPoints<dimension> &bicell, CoordinateBound bound);

/// A lower bound of the square of the bi-cell's tolerance, half the width of that annulus; 0 where the filter
/// fails.
template <unsigned dimension>
double squared_half_annulus_width(const BicellPoints<dimension> &bicell, CoordinateBound bound);

/// A lower bound of the square of half the least width of a simplex: no smaller displacement of its points
/// makes it flat. The report leaves the hull out; this is what its cells and ridges are held by here. 0 where
/// rounding errors might exceed the volume.
template <unsigned dimension>
double squared_half_simplex_width(const std::array<Place<dimension>, dimension + 1> &corners,
                                  CoordinateBound bound);

extern template std::array<Bounded, 2> annulus_centre<2>(const BicellPoints<2> &, CoordinateBound);
extern template std::array<Bounded, 3> annulus_centre<3>(const BicellPoints<3> &, CoordinateBound);
extern template double squared_half_annulus_width<2>(const BicellPoints<2> &, CoordinateBound);
extern template double squared_half_annulus_width<3>(const BicellPoints<3> &, CoordinateBound);
template <>
double squared_half_simplex_width<2>(const std::array<Place<2>, 3> &, CoordinateBound);
template <>
double squared_half_simplex_width<3>(const std::array<Place<3>, 4> &, CoordinateBound);

}  // namespace bench
