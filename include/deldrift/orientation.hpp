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

// What a function of deldrift.h tells of so many points.
template <class Sign>
int sign_of(Sign function, std::uint32_t dimension, std::size_t n_points, const Positions &points) {
    std::vector<double> room;
    const span<const double> numbers = points.numbers("points", dimension, room);
    const std::size_t n_numbers = dimension * n_points;
    if ((dimension == 2 || dimension == 3) && numbers.size() != n_numbers) {
        throw Error(DELDRIFT_WRONG_COUNT, "points has " + std::to_string(numbers.size()) + " numbers, but must have " +
                                              std::to_string(n_numbers));
    }
    std::int32_t sign = 0;
    const deldrift_status status = function(dimension, numbers.data(), &sign);
    if (status != DELDRIFT_OK) throw Error(status);
    return sign;
}

}  // namespace detail

// The sign of the orientation of dimension + 1 points, exactly; see deldrift_orientation.
inline int orientation(std::uint32_t dimension, const Positions &points) {
    return detail::sign_of(deldrift_orientation, dimension, dimension + std::size_t{1}, points);
}

// On which side of the circle or sphere through dimension + 1 points another one is, exactly; see deldrift_in_sphere.
inline int in_sphere(std::uint32_t dimension, const Positions &points) {
    return detail::sign_of(deldrift_in_sphere, dimension, dimension + std::size_t{2}, points);
}

}  // namespace deldrift

#endif  // DELDRIFT_ORIENTATION_HPP
