// Vertices that share their place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <deldrift.h>

namespace compat {

// For each vertex the one that represents its place, the lowest one, or with weights the heaviest one, if that is in
// cells, and itself otherwise. Empty if no two vertices share a place.
std::vector<std::uint32_t> representatives(const deldrift_triangulation *t, std::size_t n_points);

} // namespace compat
