// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors in space, as far as recording needs them.
#pragma once

#include <array>

namespace bench {

using Vector3 = std::array<double, 3>;

inline Vector3 vector(const double *p) { return {p[0], p[1], p[2]}; }
inline Vector3 operator+(const Vector3 &a, const Vector3 &b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector3 operator-(const Vector3 &a, const Vector3 &b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector3 operator*(double s, const Vector3 &a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vector3 &a, const Vector3 &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Vector3 cross(const Vector3 &a, const Vector3 &b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Of the tetrahedron of the origin and these: six times its volume times twice its circumcentre. No
/// division, so that slivers do no harm.
inline Vector3 weighted_circumcentre(const Vector3 &b, const Vector3 &c, const Vector3 &d) {
    return dot(b, b) * cross(c, d) + dot(c, c) * cross(d, b) + dot(d, d) * cross(b, c);
}

inline Vector3 circumcentre(const std::array<Vector3, 4> &p) {
    const Vector3 b = p[1] - p[0], c = p[2] - p[0], d = p[3] - p[0];
    return p[0] + (0.5 / dot(b, cross(c, d))) * weighted_circumcentre(b, c, d);
}

}  // namespace bench
