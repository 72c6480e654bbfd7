// Orientations and in-sphere signs of points that belong to no triangulation.
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

static int32_t in_sphere(uint32_t dimension, const double *points) {
    int32_t sign = 7;
    OK(deldrift_in_sphere(dimension, points, &sign));
    return sign;
}

static int32_t in_power_sphere(uint32_t dimension, const double *points, const double *weights) {
    int32_t sign = 7;
    OK(deldrift_in_power_sphere(dimension, points, weights, &sign));
    return sign;
}

static int64_t determinant(uint32_t d, int64_t u[3][3]) {
    if (d == 2) return u[0][0] * u[1][1] - u[0][1] * u[1][0];
    return u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1]) - u[0][1] * (u[1][0] * u[2][2] - u[1][2] * u[2][0]) +
           u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0]);
}

// By the definition. Seen from the first point, of edges e to the others of the simplex the centre c solves 2 e c = e²,
// and a point q is inside if 2 q c - q² is positive. By Cramer's rule that is an integer over the determinant of the
// edges. With weights, squares are less by what the other weight is more than the first.
static int64_t by_definition(uint32_t d, int64_t p[5][3], const int64_t w[5]) {
    int64_t e[3][3] = {{0}}, squares[3] = {0}, own = w[0] - w[d + 1], sum = 0;
    for (uint32_t i = 0; i < d; i++) {
        squares[i] = w[0] - w[i + 1];
        for (uint32_t k = 0; k < d; k++) {
            e[i][k] = p[i + 1][k] - p[0][k];
            squares[i] += e[i][k] * e[i][k];
        }
    }
    for (uint32_t k = 0; k < d; k++) {
        int64_t replaced[3][3];
        memcpy(replaced, e, sizeof e);
        for (uint32_t i = 0; i < d; i++) replaced[i][k] = squares[i];
        const int64_t q = p[d + 1][k] - p[0][k];
        sum += q * determinant(d, replaced);
        own += q * q;
    }
    return sum - own * determinant(d, e);
}

// Integers from -2^range to 2^range; in every second case corners of a box, which are on a circle or sphere, the last
// one or a place beside it.
static void in_spheres_of_integers(int range, uint64_t seed) {
    int n_of[3] = {0, 0, 0};
    for (int round = 0; round < 20000; round++) {
        int64_t p[5][3];
        for (int i = 0; i < 5; i++) {
            for (int k = 0; k < 3; k++) p[i][k] = (int64_t)ldexp(next_random(&seed), range + 1) - ((int64_t)1 << range);
        }
        for (uint32_t d = 2; d <= 3; d++) {
            int64_t box[5][3];
            memcpy(box, p, sizeof p);
            if (round % 2 == 0) {
                // A corner, those beside it along the axes, and the one across.
                for (uint32_t i = 1; i <= d + 1; i++) {
                    for (uint32_t k = 0; k < d; k++) box[i][k] = i == k + 1 || i == d + 1 ? p[1][k] : p[0][k];
                }
                box[d + 1][0] += round % 3 - 1;
            }
            double points[15];
            int64_t edges[3][3];
            for (uint32_t i = 0; i <= d + 1; i++) {
                for (uint32_t k = 0; k < d; k++) {
                    points[d * i + k] = (double)box[i][k];
                    if (i > 0 && i <= d) edges[i - 1][k] = box[i][k] - box[0][k];
                }
            }
            const int32_t sign = in_sphere(d, points);
            static const int64_t none[5] = {0};
            CHECK(sign == sign_of(by_definition(d, box, none)));
            int64_t weights[5];
            double numbers[5];
            for (int i = 0; i < 5; i++) numbers[i] = (double)(weights[i] = (int64_t)(9 * next_random(&seed)) - 2);
            CHECK(in_power_sphere(d, points, numbers) == sign_of(by_definition(d, box, weights)));
            CHECK(orientation(d, points) == sign_of(determinant(d, edges)));
            n_of[sign + 1]++;
        }
    }
    for (int i = 0; i < 3; i++) CHECK(n_of[i] > 1000);
}

// Of corners that are in positive order, in negative order, and on a line or plane; at both ends of the range; next to
// a circle, where doubles would be 0 or wrong.
static void inside_is_positive(void) {
    static const double circle[] = {0, 0, 1, 0, 0, 1, 0.5, 0.5}, turned[] = {0, 0, 0, 1, 1, 0, 0.5, 0.5};
    static const double sphere[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5, 0.5, 0.5};
    static const double flat[] = {0, 0, 1, 0, 2, 0, 1, 5};
    CHECK(in_sphere(2, circle) == 1 && in_sphere(2, turned) == -1 && in_sphere(3, sphere) == 1);
    CHECK(in_sphere(2, flat) != 0);
    double near[8];
    memcpy(near, circle, sizeof near);
    near[6] = near[7] = 1;
    CHECK(in_sphere(2, near) == 0);
    near[7] = nextafter(1, 0);
    CHECK(in_sphere(2, near) == 1);
    near[7] = nextafter(1, 2);
    CHECK(in_sphere(2, near) == -1);
    static const double scales[] = {1e57, 5e-324, 1e-170, 1e57 / 3};
    for (size_t s = 0; s < sizeof scales / sizeof *scales; s++) {
        double cube[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
        for (int i = 0; i < 15; i++) cube[i] *= scales[s];
        CHECK(in_sphere(3, cube) == 0);
        cube[14] = nextafter(cube[14], 0);
        CHECK(in_sphere(3, cube) == (cube[14] == 0 ? 0 : 1));
        cube[14] = -cube[14] - 5e-324;
        CHECK(in_sphere(3, cube) == -1);
    }
}

static void bad_spheres(void) {
    double points[15] = {0, 0, 1, 0, 0, 1, 0.5, 0.5, 1, 1, 1, 1, 1, 1, 1};
    int32_t sign = 7;
    CHECK_STATUS(deldrift_in_sphere(1, points, &sign), DELDRIFT_INVALID_DIMENSION);
    CHECK_MESSAGE("dimension is 1");
    CHECK_STATUS(deldrift_in_sphere(4, points, &sign), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_in_sphere(2, NULL, &sign), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("points is NULL");
    CHECK_STATUS(deldrift_in_sphere(3, points, NULL), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("sign is NULL");
    points[14] = NAN;
    CHECK_STATUS(deldrift_in_sphere(3, points, &sign), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("points[4], coordinate 2");
    points[7] = INFINITY;
    CHECK_STATUS(deldrift_in_sphere(2, points, &sign), DELDRIFT_NOT_FINITE);
    CHECK_MESSAGE("points[3], coordinate 1");
    points[7] = -2e57;
    CHECK_STATUS(deldrift_in_sphere(2, points, &sign), DELDRIFT_OUT_OF_RANGE);
    CHECK_MESSAGE("-2e57");
    CHECK(sign == 7);
    // No more is read than the dimension says.
    points[7] = 0.5;
    points[8] = NAN;
    CHECK(in_sphere(2, points) == 1);
}

// The square 8 of a radius at 3 is on the unit circle's power circle, which it crosses at a right angle.
static void weights_are_squares_of_radii(void) {
    const double points[] = {1, 0, 0, 1, -1, 0, 3, 0};
    double weights[] = {0, 0, 0, 8};
    CHECK(in_power_sphere(2, points, weights) == 0);
    weights[3] = nextafter(8, 9);
    CHECK(in_power_sphere(2, points, weights) == 1);
    weights[3] = nextafter(8, 7);
    CHECK(in_power_sphere(2, points, weights) == -1);
    for (int i = 0; i < 4; i++) weights[i] = i < 3 ? -1e114 : 1e114;
    CHECK(in_power_sphere(2, points, weights) == 1);
    for (int i = 0; i < 4; i++) weights[i] = i < 3 ? 5e-324 : 0;
    CHECK(in_power_sphere(2, points, weights) == -1);
    const double corner[] = {1, 0, 0, 1, -1, 0, 0, -1};
    CHECK(in_power_sphere(2, corner, weights) == -1);
    weights[3] = 1e-323;
    CHECK(in_power_sphere(2, corner, weights) == 1);
}

static void bad_weights(void) {
    const double points[15] = {0, 0, 1, 0, 0, 1, 0.5, 0.5, 1, 1, 1, 1, 1, 1, 1};
    double weights[5] = {0, 1, 2, 3, NAN};
    int32_t sign = 7;
    CHECK_STATUS(deldrift_in_power_sphere(4, points, weights, &sign), DELDRIFT_INVALID_DIMENSION);
    CHECK_STATUS(deldrift_in_power_sphere(3, points, weights, &sign), DELDRIFT_INVALID_VALUE);
    CHECK_MESSAGE("weights[4] is NaN");
    CHECK_STATUS(deldrift_in_power_sphere(2, points, NULL, &sign), DELDRIFT_NULL_ARGUMENT);
    CHECK_MESSAGE("weights is NULL");
    weights[1] = -1.1e114;
    CHECK_STATUS(deldrift_in_power_sphere(2, points, weights, &sign), DELDRIFT_INVALID_VALUE);
    CHECK_MESSAGE("weights[1] is -11");
    CHECK(sign == 7);
    // No more is read than the dimension says.
    weights[1] = 1;
    OK(deldrift_in_power_sphere(2, points, weights, &sign));
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
    in_spheres_of_integers(2, 3);
    in_spheres_of_integers(9, 4);
    inside_is_positive();
    weights_are_squares_of_radii();
    bad_points();
    bad_spheres();
    bad_weights();
    return 0;
}
