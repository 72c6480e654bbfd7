// Vertices that share their place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <deldrift.h>

namespace compat {

// For each vertex the lowest one at its place; empty if no two vertices share one.
std::vector<std::uint32_t> representatives(const deldrift_triangulation *t, std::size_t n_points);

} // namespace compat
