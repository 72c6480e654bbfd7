// Whether a kept triangulation is one of almost the same points, and bringing it to them.
#pragma once

#include <cstddef>

#include <deldrift.h>

namespace compat {

// How far points are from the vertices of a triangulation of as many: the mean distance of a sample, in units of its
// extent. Infinite if it cannot be told.
double relative_distance(const deldrift_triangulation *t, unsigned dimension, const double *points,
                         std::size_t n_points);

// Sets that are not the same are further apart than this: random points of a square are at 0.4.
constexpr double nearness_limit = 0.125;

// Counts that may be those of one set before and after insertions and removals.
bool similar_counts(std::size_t before, std::size_t after);

enum class Outcome {
    brought, // vertex i is point i
    unlike,  // not almost the same points; nothing has been done
    failed,  // the triangulation must not be used any more
};

// Moves the vertices of a triangulation, whose ids are 0, 1, ..., to as many points.
Outcome move_to(deldrift_triangulation *t, const double *points, std::size_t n_points);

// Brings such a triangulation to points of which some are new and others gone, by removals, moves, and insertions at
// the end of the order, where the vertices that are left can be told.
Outcome edit_to(deldrift_triangulation *t, unsigned dimension, const double *points, std::size_t n_points);

} // namespace compat
