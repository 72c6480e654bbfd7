// Orientations of points that belong to no triangulation.
#include "check.h"

static int sign_of(int64_t x) { return (x > 0) - (x < 0); }

static int32_t orientation(uint32_t dimension, const double *points) {
    int32_t sign = 7;
    OK(deldrift_orientation(dimension, points, &sign));
    return sign;
}

// Integers from -2^range to 2^range; the last one on the line or plane of the others in every second case, if that is
// an integer place.
static void of_integers(int range, uint64_t seed) {
    int64_t p[4][3];
    int n_of[3] = {0, 0, 0};
    for (int round = 0; round < 20000; round++) {
        for (int i = 0; i < 4; i++) {
            for (int k = 0; k < 3; k++) {
                p[i][k] = (int64_t)ldexp(next_random(&seed), range + 1) - ((int64_t)1 << range);
            }
        }
        for (uint32_t d = 2; d <= 3; d++) {
            if (round % 2 == 0) {
                for (uint32_t k = 0; k < d; k++) {
                    p[d][k] = p[0][k] + 3 * (p[1][k] - p[0][k]);
                    if (d == 3) p[d][k] -= p[2][k] - p[0][k];
                }
                p[d][0] += round % 3 - 1;
            }
            double points[12];
            int64_t u[3][3];
            for (uint32_t i = 0; i <= d; i++) {
                for (uint32_t k = 0; k < d; k++) {
                    points[d * i + k] = (double)p[i][k];
                    if (i > 0) u[i - 1][k] = p[i][k] - p[0][k];
                }
            }
            int64_t determinant;
            if (d == 2) {
                determinant = u[0][0] * u[1][1] - u[0][1] * u[1][0];
            } else {
                determinant = u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1]) -
                              u[0][1] * (u[1][0] * u[2][2] - u[1][2] * u[2][0]) +
                              u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0]);
            }
            const int32_t sign = orientation(d, points);
            CHECK(sign == sign_of(determinant));
            n_of[sign + 1]++;
        }
    }
    for (int i = 0; i < 3; i++) CHECK(n_of[i] > 1000);
}

// Where a determinant in doubles would be 0 or wrong.
static void close_to_a_line(void) {
    const double step = ldexp(1, -53);
    const double third[] = {0.5, 0.5, 12, 12, 24, 24 + ldexp(1, -48)}, first[] = {0.5, 0.5 + step, 12, 12, 24, 24};
    const double on[] = {0.5 + step, 0.5 + step, 12, 12, 24, 24}, tiny[] = {0, 0, 1, 5e-324, 2, 5e-324};
    CHECK(orientation(2, third) == 1 && orientation(2, first) == 1 && orientation(2, on) == 0);
    CHECK(orientation(2, tiny) == -1);
    const double far[] = {-1e57, -1e57, 0, 1e57, 1e57, 0, 0, 0, 0, 1, 1, 5e-324};
    CHECK(orientation(3, far) == 0);
}

static void bad_points(void) {
    double points[12] = {0, 0, 1, 0, 0, 1, 1, 1, 1, 1, 1, 1};
    int32_t sign = 7;
    CHECK_STATUS(deldrift_orientation(1, points, &sign), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_orientation(4, points, &sign), DELDRIFT_INVALID_DIMENSION);
    points[5] = NAN;
    CHECK_STATUS(deldrift_orientation(2, points, &sign), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("points[2], coordinate 1");
    CHECK_STATUS(deldrift_orientation(3, points, &sign), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("points[1], coordinate 2");
    points[5] = -INFINITY;
    CHECK_STATUS(deldrift_orientation(2, points, &sign), DELDRIFT_NOT_FINITE);
    points[5] = 2e57;
    CHECK_STATUS(deldrift_orientation(3, points, &sign), DELDRIFT_OUT_OF_RANGE);
    CHECK_MESSAGE("2e57");
    points[5] = 1e57;
    CHECK(sign == 7);
    // No more is read than the dimension says.
    points[6] = NAN;
    CHECK(orientation(2, points) == 1);
}

int main(void) {
    of_integers(3, 1);
    of_integers(15, 2);
    close_to_a_line();
    bad_points();
    return 0;
}
