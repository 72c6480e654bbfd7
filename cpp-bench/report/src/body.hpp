// SPDX-License-Identifier: GPL-3.0-or-later
// A solid body bounded by triangles: the domain of `man`.
#pragma once

#include "solid.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bench {

class Random;

class Body {
public:
    /// A closed surface from a file of the OFF format. Throws std::runtime_error naming the file and what is
    /// wrong.
    static Body load(const std::string &path);

    /// A stand-in for a person where there is no file: a solid of revolution with head, neck, trunk and foot.
    static Body generate();

    const std::string &name() const { return name_; }
    double volume() const;
    double area() const;

    /// Enlarges the body to this volume.
    void scale_to_volume(double volume);

    /// Whether the place is inside: how often a ray along x crosses the surface.
    bool contains(const double *place) const;

    /// `count` points on the surface, each the one of ten random ones that is farthest from those before.
    std::vector<Vector3> surface_points(std::size_t count, Random &random) const;

    /// `count` random points inside.
    std::vector<Vector3> inner_points(std::size_t count, Random &random) const;

private:
    using Triangle = std::array<std::uint32_t, 3>;

    Body(std::string name, std::vector<Vector3> corners, std::vector<Triangle> triangles);
    Vector3 corner(const Triangle &triangle, int i) const { return corners_[triangle[i]]; }
    void sort_into_columns();
    void require_closed() const;

    std::string name_;
    std::vector<Vector3> corners_;
    std::vector<Triangle> triangles_;
    Vector3 least_{}, greatest_{};
    // Triangles by the squares of a lattice over y and z that they may reach into.
    std::vector<std::vector<std::uint32_t>> columns_;
};

}  // namespace bench
