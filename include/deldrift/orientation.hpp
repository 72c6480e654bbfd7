// Exact signs of points that belong to no triangulation. Included by deldrift.hpp.
#ifndef DELDRIFT_ORIENTATION_HPP
#define DELDRIFT_ORIENTATION_HPP

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "../deldrift.h"
#include "positions.hpp"
#include "span.hpp"

namespace deldrift {

namespace detail {

// That many numbers are there, in a dimension that there is.
inline void require_count(const char *name, std::uint32_t dimension, std::size_t given, std::size_t wanted) {
    if ((dimension == 2 || dimension == 3) && given != wanted) {
        throw Error(DELDRIFT_WRONG_COUNT, name + (" has " + std::to_string(given)) + " numbers, but must have " +
                                              std::to_string(wanted));
    }
}

// What a function of deldrift.h tells of so many points; call: with their numbers, and where the sign goes.
template <class Call>
int sign_of(std::uint32_t dimension, std::size_t n_points, const Positions &points, const Call &call) {
    std::vector<double> room;
    const span<const double> numbers = points.numbers("points", dimension, room);
    require_count("points", dimension, numbers.size(), dimension * n_points);
    std::int32_t sign = 0;
    const deldrift_status status = call(numbers.data(), &sign);
    if (status != DELDRIFT_OK) throw Error(status);
    return sign;
}

}  // namespace detail

// The sign of the orientation of dimension + 1 points, exactly; see deldrift_orientation.
inline int orientation(std::uint32_t dimension, const Positions &points) {
    return detail::sign_of(dimension, dimension + std::size_t{1}, points, [=](const double *numbers, std::int32_t *sign) {
        return deldrift_orientation(dimension, numbers, sign);
    });
}

// On which side of the circle or sphere through dimension + 1 points another one is, exactly; see deldrift_in_sphere.
inline int in_sphere(std::uint32_t dimension, const Positions &points) {
    return detail::sign_of(dimension, dimension + std::size_t{2}, points, [=](const double *numbers, std::int32_t *sign) {
        return deldrift_in_sphere(dimension, numbers, sign);
    });
}

// On which side of the power circle or power sphere of dimension + 1 weighted points another one is, exactly; see
// deldrift_in_power_sphere.
inline int in_power_sphere(std::uint32_t dimension, const Positions &points, span<const double> weights) {
    const std::size_t n_points = dimension + std::size_t{2};
    detail::require_count("weights", dimension, weights.size(), n_points);
    return detail::sign_of(dimension, n_points, points, [=](const double *numbers, std::int32_t *sign) {
        return deldrift_in_power_sphere(dimension, numbers, weights.data(), sign);
    });
}

}  // namespace deldrift

#endif  // DELDRIFT_ORIENTATION_HPP
