// Points that are hard on exact arithmetic: for tours (tour.h).
#ifndef SCATTERED_H
#define SCATTERED_H

#include "tour.h"

// What points are like.
typedef enum { ROUNDED, GRID, ANY_EXPONENTS, FEW_EXPONENTS, NEARLY_ON_SPHERE, HARDLY_ON_SPHERE, NEARLY_FLAT, LADDER,
    N_SHAPES } shape;

static const char *const SHAPES[N_SHAPES] = {"rounded", "grid", "any exponents", "few exponents", "nearly on a sphere",
    "hardly on a sphere", "nearly flat", "ladder"};

static double sign_of(uint64_t *state) {
    return next_random(state) < 0.5 ? -1 : 1;
}

// Of any magnitude that is accepted, down to the least.
static double of_any_exponent(uint64_t *state) {
    return sign_of(state) * ldexp(0.5 + next_random(state) / 2, (int)(next_random(state) * 1263) - 1074);
}

// Mostly a corner of a cube, whose corners are on a sphere; else this small.
static double of_a_corner(double small, uint64_t *state) {
    return sign_of(state) * (next_random(state) < 0.6 ? 1 : small * next_random(state));
}

static double coordinate(shape s, size_t vertex, uint32_t axis, uint64_t *state) {
    switch (s) {
        case ROUNDED: return next_random(state);
        case GRID: return (double)(vertex / (axis == 0 ? 1 : axis == 1 ? 4 : 16) % 4);
        case ANY_EXPONENTS: return of_any_exponent(state);
        case FEW_EXPONENTS: {
            const double units[] = {5e56, 1, 1e-30, 1e-41, 1e-60, 0x1p-1074};
            return units[(size_t)(next_random(state) * 6)] * (double)((int)(next_random(state) * 5) - 2);
        }
        // Differences that are beyond what fits 110 bits; of the latter, expansions would underflow.
        case NEARLY_ON_SPHERE: return of_a_corner(1e-38, state);
        case HARDLY_ON_SPHERE: return of_a_corner(1e-300, state);
        case NEARLY_FLAT: return axis == 0 ? 1e-39 * next_random(state) : (double)(int)(next_random(state) * 5);
        default: return ldexp(1 + next_random(state), -(int)vertex * 4) * (axis == 0 ? 1 : 1e-3);
    }
}

static void scatter(double *points, size_t n, uint32_t dimension, shape s, uint64_t seed) {
    for (size_t v = 0; v < n; v++) {
        for (uint32_t axis = 0; axis < dimension; axis++) points[v * dimension + axis] = coordinate(s, v, axis, &seed);
    }
}

// What a tour of this shape is given: all points go elsewhere, or only a little.
static places places_of(shape s, uint32_t dimension, deldrift_algorithm algorithm, uint64_t seed) {
    places p = {.dimension = dimension, .threads = 1, .algorithm = algorithm, .n = TOUR_POINTS - 4};
    bool is_little = seed % 2 == 0;
    scatter(p.at, TOUR_POINTS, dimension, s, seed);
    scatter(p.then, TOUR_POINTS, dimension, s, is_little ? seed : seed + 100);
    scatter(p.later, TOUR_POINTS, dimension, s, seed + 200);
    for (size_t i = 0; is_little && i < TOUR_POINTS * dimension; i++) p.then[i] *= 1 - 1e-9 * next_random(&seed);
    for (uint32_t axis = 0; axis < dimension; axis++) {
        p.low[axis] = -2;
        p.high[axis] = 5;
    }
    p.squared_radius = 0.5;
    return p;
}

#endif
