// Orientations of points that belong to no triangulation. Included by deldrift.hpp.
#ifndef DELDRIFT_ORIENTATION_HPP
#define DELDRIFT_ORIENTATION_HPP

#include <cstddef>
#include <cstdint>
#include <string>

#include "../deldrift.h"
#include "span.hpp"

namespace deldrift {

// The sign of the orientation of dimension + 1 points, exactly; see deldrift_orientation.
inline int orientation(std::uint32_t dimension, span<const double> points) {
    const std::size_t n_numbers = std::size_t{dimension} * (std::size_t{dimension} + 1);
    if ((dimension == 2 || dimension == 3) && points.size() != n_numbers) {
        throw Error(DELDRIFT_WRONG_COUNT, "points has " + std::to_string(points.size()) + " numbers, but must have " +
                                              std::to_string(n_numbers));
    }
    std::int32_t sign = 0;
    const deldrift_status status = deldrift_orientation(dimension, points.data(), &sign);
    if (status != DELDRIFT_OK) throw Error(status);
    return sign;
}

}  // namespace deldrift

#endif  // DELDRIFT_ORIENTATION_HPP
