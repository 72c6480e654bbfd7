// SPDX-License-Identifier: GPL-3.0-or-later
// Point sets such as solvers have, and what becomes of them from one timestamp to the next.
#include "structured.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace bench {
namespace {

/// Of `layers`: from one to the next.
constexpr double layer_distance = 0.001;
constexpr double noise = 1e-12;
/// Radii of `graded` are between 10^-6 and 1.
constexpr double n_decades = 6;
constexpr std::size_t n_clusters = 50;
/// Of clusters in the unit cube.
constexpr double cluster_radius = 1e-4;
constexpr double far_away = 1e7;

/// Neither a symmetry of the lattice nor near one: an angle, and an axis of unit length.
constexpr double lattice_angle = 0.37;
constexpr double axis[3] = {0.36, 0.48, 0.8};

constexpr double rigid_shift = 0.001;
constexpr double shear_rate = 0.001;
constexpr double translation_length = 10;
constexpr double rotation_angle = 0.01;
constexpr std::size_t teleport_every = 100;
constexpr double half_displacement = 0.01;
constexpr double scaling_factor = 1.001;

const double pi = std::acos(-1.0);

/// Rotates points about the axis, in the plane about the origin.
void rotate(unsigned dimension, double angle, std::vector<double> &positions) {
    const double c = std::cos(angle), s = std::sin(angle);
    for (std::size_t at = 0; at < positions.size(); at += dimension) {
        double *p = &positions[at];
        if (dimension == 2) {
            const double x = c * p[0] - s * p[1], y = s * p[0] + c * p[1];
            p[0] = x, p[1] = y;
            continue;
        }
        const double along = (axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2]) * (1 - c);
        const double x = c * p[0] + s * (axis[1] * p[2] - axis[2] * p[1]) + along * axis[0];
        const double y = c * p[1] + s * (axis[2] * p[0] - axis[0] * p[2]) + along * axis[1];
        const double z = c * p[2] + s * (axis[0] * p[1] - axis[1] * p[0]) + along * axis[2];
        p[0] = x, p[1] = y, p[2] = z;
    }
}

/// Cubes of edge h row by row, in each the points of `basis`, in edges.
SolverPoints lattice(unsigned dimension, std::size_t n_points, double h,
                     const std::vector<std::array<double, 3>> &basis = {{0, 0, 0}}) {
    const double n_cubes = static_cast<double>(n_points) / static_cast<double>(basis.size());
    const auto side = static_cast<std::size_t>(std::lround(std::pow(n_cubes, 1.0 / dimension)));
    SolverPoints points{{}, h * std::pow(static_cast<double>(basis.size()), -1.0 / dimension), {}, {}};
    for (std::size_t k = 0; k < (dimension == 3 ? side : 1); ++k)
        for (std::size_t j = 0; j < side; ++j)
            for (std::size_t i = 0; i < side; ++i) {
                const std::array<double, 3> cube = {static_cast<double>(i), static_cast<double>(j),
                                                    static_cast<double>(k)};
                for (const std::array<double, 3> &point : basis)
                    for (unsigned axis = 0; axis < dimension; ++axis)
                        points.positions.push_back(h * (cube[axis] + point[axis]));
            }
    return points;
}

/// Voxels and structured meshes of hexahedra, in units of their edge.
SolverPoints grid(unsigned dimension, std::size_t n_points, Random &) { return lattice(dimension, n_points, 1); }

/// The same in metres: coordinates are not what they say, and ties are broken by rounding.
SolverPoints grid_of_tenths(unsigned dimension, std::size_t n_points, Random &) {
    return lattice(dimension, n_points, 0.1);
}

/// A part with a structured mesh, somewhere in an assembly.
SolverPoints rotated_grid(unsigned dimension, std::size_t n_points, Random &) {
    SolverPoints points = lattice(dimension, n_points, 0.1);
    rotate(dimension, lattice_angle, points.positions);
    return points;
}

/// Crystals of molecular dynamics.
SolverPoints face_centred(unsigned dimension, std::size_t n_points, Random &) {
    return lattice(dimension, n_points, 1, {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}});
}

/// Boundary layers of flows, plates, films, rolled sheets.
SolverPoints layers(unsigned dimension, std::size_t n_points, Random &) {
    SolverPoints points = lattice(dimension, n_points, 1);
    for (std::size_t at = dimension - 1; at < points.positions.size(); at += dimension)
        points.positions[at] *= layer_distance;
    return points;
}

/// A structured mesh that has been through a solver, or a file with so many digits.
SolverPoints noisy_grid(unsigned dimension, std::size_t n_points, Random &random) {
    SolverPoints points = lattice(dimension, n_points, 1);
    for (double &coordinate : points.positions) coordinate += random.symmetric(noise);
    return points;
}

std::array<double, 3> random_direction(unsigned dimension, Random &random) {
    std::array<double, 3> direction{0, 0, 0};
    double length;
    do {
        random.in_ball(dimension, 1, direction.data());
        length = std::hypot(direction[0], direction[1], direction[2]);
    } while (length < 0.01);
    for (double &coordinate : direction) coordinate /= length;
    return direction;
}

/// Surface meshes of bearings, droplets and planets; in the plane, sections and holes.
SolverPoints sphere(unsigned dimension, std::size_t n_points, Random &random) {
    const double measure = dimension == 2 ? 2 * pi : 4 * pi;
    SolverPoints points{{}, std::pow(measure / static_cast<double>(n_points), 1.0 / (dimension - 1)), {}, {}};
    for (std::size_t i = 0; i < n_points; ++i) {
        const std::array<double, 3> direction = random_direction(dimension, random);
        points.positions.insert(points.positions.end(), direction.begin(), direction.begin() + dimension);
    }
    return points;
}

/// A cloud: points drawn one by one, `draw(i, place)` giving the spacing around the place of the i-th; a hundredth of
/// them once more, for places to go to.
template <typename Draw>
SolverPoints cloud(unsigned dimension, std::size_t n_points, double spacing, Draw draw) {
    SolverPoints points{{}, spacing, {}, {}};
    for (std::size_t i = 0; i < n_points + n_points / teleport_every; ++i) {
        double place[3];
        const double local_spacing = draw(i, place);
        std::vector<double> &positions = i < n_points ? points.positions : points.elsewhere;
        positions.insert(positions.end(), place, place + dimension);
        if (i < n_points) points.local_spacings.push_back(local_spacing);
    }
    return points;
}

/// Random points in a cube at unit density, one corner of which has these coordinates.
SolverPoints uniform_from(double corner, unsigned dimension, std::size_t n_points, Random &random) {
    const double side = std::pow(static_cast<double>(n_points), 1.0 / dimension);
    return cloud(dimension, n_points, 1, [&](std::size_t, double *place) {
        for (unsigned axis = 0; axis < dimension; ++axis) place[axis] = corner + side * random.unit();
        return 1.0;
    });
}

/// Particles, and what everything else is compared with.
SolverPoints uniform(unsigned dimension, std::size_t n_points, Random &random) {
    return uniform_from(0, dimension, n_points, random);
}

/// Coordinates on a map, in metres: most digits are those of the place of the whole.
SolverPoints offset(unsigned dimension, std::size_t n_points, Random &random) {
    return uniform_from(far_away, dimension, n_points, random);
}

/// Meshes that are graded to a crack's tip, a corner or a shock; the inner parts of galaxies. Each decade of radii has
/// as many points as any other.
SolverPoints graded(unsigned dimension, std::size_t n_points, Random &random) {
    const auto n = static_cast<double>(n_points);
    // Of the cube around all; and of the shell of radii from r to e r, in units of r.
    const double spacing = 2 * std::pow(n, -1.0 / dimension);
    const double shell = (dimension == 2 ? 2 * pi : 4 * pi) * n_decades * std::log(10.0);
    const double spacing_at_unit_radius = std::pow(shell / n, 1.0 / dimension);
    return cloud(dimension, n_points, spacing, [&, dimension](std::size_t, double *place) {
        const std::array<double, 3> direction = random_direction(dimension, random);
        const double radius = std::pow(10.0, -n_decades * random.unit());
        for (unsigned axis = 0; axis < dimension; ++axis) place[axis] = radius * direction[axis];
        return radius * spacing_at_unit_radius;
    });
}

/// Droplets, agglomerates, galaxies: small parts that are far from each other.
SolverPoints clusters(unsigned dimension, std::size_t n_points, Random &random) {
    const auto n = static_cast<double>(n_points);
    std::vector<double> centres(n_clusters * dimension);
    for (double &coordinate : centres) coordinate = random.unit();
    const double unit_ball = dimension == 2 ? pi : 4 * pi / 3;
    const double local_spacing = cluster_radius * std::pow(unit_ball * n_clusters / n, 1.0 / dimension);
    return cloud(dimension, n_points, std::pow(n, -1.0 / dimension), [&, dimension](std::size_t i, double *place) {
        random.in_ball(dimension, cluster_radius, place);
        for (unsigned axis = 0; axis < dimension; ++axis) place[axis] += centres[i % n_clusters * dimension + axis];
        return local_spacing;
    });
}

std::vector<PointSet> make_point_sets() {
    const std::vector<Motion> mesh = {Motion::rigid, Motion::shear, Motion::rest};
    std::vector<Motion> cloud = mesh;
    cloud.insert(cloud.end(), {Motion::translation, Motion::rotation, Motion::teleport, Motion::half});
    std::vector<Motion> scaled = cloud;
    scaled.push_back(Motion::scaling);
    return {
        // name, dimension, is_telling, motions, draw
        {"random", 3, true, cloud, uniform},
        {"grid", 3, true, mesh, grid},
        {"grid_0.1", 3, false, mesh, grid_of_tenths},
        {"grid_rotated", 3, false, mesh, rotated_grid},
        {"face_centred", 3, false, mesh, face_centred},
        {"layers", 3, true, mesh, layers},
        {"grid_noise", 3, false, mesh, noisy_grid},
        {"sphere", 3, false, mesh, sphere},
        {"graded", 3, true, cloud, graded},
        {"clusters", 3, true, cloud, clusters},
        {"offset", 3, false, scaled, offset},
        {"random", 2, true, cloud, uniform},
        {"grid", 2, true, mesh, grid},
        {"circle", 2, true, mesh, sphere},
        {"layers", 2, false, mesh, layers},
        {"graded", 2, false, cloud, graded},
        {"clusters", 2, false, cloud, clusters},
    };
}

/// The middle of the box around the points.
std::array<double, 3> middle_of(unsigned dimension, const std::vector<double> &positions) {
    std::array<double, 3> middle{0, 0, 0};
    for (unsigned axis = 0; axis < dimension; ++axis) {
        double least = positions[axis], greatest = least;
        for (std::size_t at = axis; at < positions.size(); at += dimension) {
            least = std::min(least, positions[at]);
            greatest = std::max(greatest, positions[at]);
        }
        middle[axis] = (least + greatest) / 2;
    }
    return middle;
}

void add(unsigned dimension, const std::array<double, 3> &vector, double factor, std::vector<double> &positions) {
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] += factor * vector[i % dimension];
}

void rotate_about_middle(unsigned dimension, std::vector<double> &positions) {
    const std::array<double, 3> middle = middle_of(dimension, positions);
    add(dimension, middle, -1, positions);
    rotate(dimension, rotation_angle, positions);
    add(dimension, middle, 1, positions);
}

void displace_half(const SolverPoints &points, unsigned dimension, Random &random, std::vector<double> &positions) {
    for (std::size_t i = 0; i * dimension < positions.size(); i += 2) {
        const std::array<double, 3> direction = random_direction(dimension, random);
        const double spacing = points.local_spacings.empty() ? points.spacing : points.local_spacings[i];
        for (unsigned axis = 0; axis < dimension; ++axis)
            positions[i * dimension + axis] += half_displacement * spacing * direction[axis];
    }
}

}  // namespace

const char *name_of(Motion motion) {
    constexpr const char *names[] = {"rest",     "rigid",    "shear", "translation",
                                     "rotation", "teleport", "half",  "scaling"};
    return names[static_cast<std::size_t>(motion)];
}

const std::vector<PointSet> &point_sets() {
    static const std::vector<PointSet> sets = make_point_sets();
    return sets;
}

std::vector<std::string> point_set_names() {
    std::vector<std::string> names;
    for (const PointSet &set : point_sets())
        if (std::find(names.begin(), names.end(), set.name) == names.end()) names.push_back(set.name);
    return names;
}

std::vector<double> moved(const SolverPoints &points, unsigned dimension, Motion motion, Random &random) {
    std::vector<double> to = points.positions;
    switch (motion) {
        case Motion::rest: break;
        case Motion::rigid: add(dimension, {1, 0, 0}, rigid_shift * points.spacing, to); break;
        case Motion::shear:
            for (std::size_t at = 0; at < to.size(); at += dimension) to[at] += shear_rate * to[at + 1];
            break;
        case Motion::translation:
            add(dimension, random_direction(dimension, random), translation_length * points.spacing, to);
            break;
        case Motion::rotation: rotate_about_middle(dimension, to); break;
        case Motion::teleport:
            for (std::size_t i = 0; i < points.elsewhere.size() / dimension; ++i)
                std::copy_n(&points.elsewhere[i * dimension], dimension, &to[i * teleport_every * dimension]);
            break;
        case Motion::half: displace_half(points, dimension, random, to); break;
        case Motion::scaling:
            for (double &coordinate : to) coordinate *= scaling_factor;
            break;
    }
    return to;
}

}  // namespace bench
