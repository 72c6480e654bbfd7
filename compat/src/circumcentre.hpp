// Circumcentres of cells: rounded, but with determinants that keep their sign and their leading digits, so that a cell
// of the triangulation, however flat, never gives a division by zero.
#pragma once

#include <cmath>

namespace compat {

// A determinant that is smaller than this share of its terms has lost digits, and is computed exactly. The rounding of
// the terms is below 2e-15 of them.
constexpr double lossy = 1e-10;

// The determinant of b - a, c - a, from the positions themselves, as differences are rounded.
double exact_determinant_2d(const double *a, const double *b, const double *c);

// a, b, c counter-clockwise; two numbers to centre. The determinant of b - a, c - a.
inline double circumcentre_2d(const double *a, const double *b, const double *c, double *centre) {
    const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
    const double plus = bx * cy, minus = by * cx;
    double determinant = plus - minus;
    if (std::abs(determinant) < lossy * (std::abs(plus) + std::abs(minus)))
        determinant = exact_determinant_2d(a, b, c);
    const double b_squared = bx * bx + by * by, c_squared = cx * cx + cy * cy;
    const double half = 0.5 / determinant;
    centre[0] = a[0] + (cy * b_squared - by * c_squared) * half;
    centre[1] = a[1] + (bx * c_squared - cx * b_squared) * half;
    return determinant;
}

// a, b, c, d in either orientation; three numbers to centre. weights: NULL, or those of the four points, for the centre
// of their power sphere.
void circumcentre_3d(const double *a, const double *b, const double *c, const double *d, const double *weights,
                     double *centre);

} // namespace compat
