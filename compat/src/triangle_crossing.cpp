#include "triangle_crossing.hpp"

#include <algorithm>
#include <cmath>

#include "circumcentre.hpp"

namespace compat {

namespace {

// x y' - y x'; NaN where rounding may have taken more than the last digits of it.
double clear_cross(double x, double y, double other_x, double other_y) {
    const double plus = x * other_y, minus = y * other_x;
    const double terms = std::abs(plus) + std::abs(minus);
    // Below 1e-250 products may have underflowed.
    const bool is_clear = terms > 1e-250 && std::abs(plus - minus) >= lossy * terms;
    return is_clear ? plus - minus : std::nan("");
}

// From the exact determinants, of coordinates that are scaled by a power of two so that none of them underflows.
double exact_along(const double *const (&points)[4]) {
    double greatest = 0;
    for (const double *point : points) greatest = std::max({greatest, std::abs(point[0]), std::abs(point[1])});
    int exponent = 0;
    std::frexp(greatest, &exponent);
    double scaled[4][2];
    for (int i = 0; i < 4; i++)
        for (int axis = 0; axis < 2; axis++) scaled[i][axis] = std::ldexp(points[i][axis], -exponent);
    const double of_a = exact_determinant_2d(scaled[2], scaled[3], scaled[0]);
    const double of_b = exact_determinant_2d(scaled[2], scaled[3], scaled[1]);
    return of_a / (of_a - of_b);
}

} // namespace

double crossing_along(const double *a, const double *b, const double *c, const double *d) {
    const double along_x = b[0] - a[0], along_y = b[1] - a[1], across_x = d[0] - c[0], across_y = d[1] - c[1];
    const double part = clear_cross(a[0] - d[0], a[1] - d[1], across_x, across_y);
    const double whole = clear_cross(across_x, across_y, along_x, along_y);
    const double along = part / whole;
    // Not where an operand is NaN.
    if (along >= 0 && along <= 1) return along;
    const double *const points[4] = {a, b, c, d};
    return exact_along(points);
}

} // namespace compat
