// Sets of points that are hard for a triangulation, each at any size, in the plane and in space.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace costs {

/// Random numbers that depend on the seed alone, on every machine (splitmix64).
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// From 0 to below 1.
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    /// From -1 to below 1.
    double sign() { return 2 * unit() - 1; }
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits() % n); }

private:
    std::uint64_t state_;
};

/// Coordinates, one point after the other.
using Points = std::vector<double>;

/// Makes a point of a set: its number, how many there are, the dimension, where the coordinates go (they are 0).
using Maker = void (*)(std::size_t i, std::size_t n, unsigned dimension, Random &random, double *p);

/// One set, and how many points it is measured with first; 0 where the dimension has no such set.
struct Set {
    const char *name;
    const char *description;
    std::size_t first_size[2];
    Maker make;
};

inline constexpr double tau = 6.283185307179586;

inline void on_sphere(std::size_t i, std::size_t n, unsigned dimension, double *p) {
    const double angle = dimension == 2 ? tau * double(i) / double(n) : 2.399963229728653 * double(i);
    const double height = dimension == 2 ? 0 : (2 * double(i) + 1) / double(n) - 1;
    const double radius = std::sqrt(1 - height * height);
    p[0] = radius * std::cos(angle);
    p[1] = radius * std::sin(angle);
    if (dimension == 3) p[2] = height;
}

inline void in_box(unsigned dimension, Random &random, double *p) {
    for (unsigned k = 0; k < dimension; ++k) p[k] = random.unit();
}

inline const std::vector<Set> &all_sets() {
    static const std::vector<Set> sets = {
        {"random", "uniform in a square or cube", {4000, 2000},
         [](std::size_t, std::size_t, unsigned dimension, Random &random, double *p) { in_box(dimension, random, p); }},
        {"lattice", "a grid", {4000, 2000},
         [](std::size_t i, std::size_t n, unsigned dimension, Random &, double *p) {
             const auto side = static_cast<std::size_t>(std::ceil(std::pow(double(n), 1.0 / dimension) - 1e-9));
             for (unsigned k = 0; k < dimension; ++k, i /= side) p[k] = double(i % side);
         }},
        {"moment", "the moment curve (t, t², t³), where every two vertices share an edge in space: n²/2 cells", {0, 100},
         [](std::size_t i, std::size_t n, unsigned, Random &, double *p) {
             const double t = double(i + 1) / double(n);
             p[0] = t, p[1] = t * t, p[2] = t * t * t;
         }},
        {"skew_lines", "two skew lines (in the plane two parallel ones): n²/4 cells in space", {4000, 150},
         [](std::size_t i, std::size_t n, unsigned dimension, Random &, double *p) {
             const double t = 2 * double(i / 2) / double(n) - 0.5;
             p[i % 2 && dimension == 3 ? 1 : 0] = t;
             p[dimension - 1] += double(i % 2);
         }},
        {"parabola", "a parabola, or a paraboloid over a spiral", {4000, 2000},
         [](std::size_t i, std::size_t n, unsigned dimension, Random &, double *p) {
             const double t = double(i) / double(n);
             p[0] = dimension == 2 ? t : std::sqrt(t) * std::cos(2.399963229728653 * double(i));
             if (dimension == 3) p[1] = std::sqrt(t) * std::sin(2.399963229728653 * double(i));
             p[dimension - 1] = dimension == 2 ? t * t : t;
         }},
        {"cross", "the axes of a coordinate system", {4000, 300},
         [](std::size_t i, std::size_t n, unsigned dimension, Random &, double *p) {
             const double t = double(i / dimension + 1) / double(n);
             p[i % dimension] = i / dimension % 2 ? t : -t;
         }},
        {"sphere", "a circle or sphere, but for rounding", {4000, 2000},
         [](std::size_t i, std::size_t n, unsigned dimension, Random &, double *p) { on_sphere(i, n, dimension, p); }},
        {"hub", "a circle or sphere around vertex 0, whose degree is n", {4000, 2000},
         [](std::size_t i, std::size_t n, unsigned dimension, Random &, double *p) {
             if (i > 0) on_sphere(i - 1, n - 1, dimension, p);
         }},
        {"magnitudes", "near a line, ten ladders of magnitudes from 1 down to 1e-60", {1000, 150},
         [](std::size_t i, std::size_t n, unsigned dimension, Random &, double *p) {
             Random direction(i % 10);
             p[0] = std::pow(10.0, -60.0 * double(i / 10) / double(std::max<std::size_t>(n / 10, 2) - 1));
             for (unsigned k = 1; k < dimension; ++k) p[k] = p[0] * 1e-3 * direction.sign();
         }},
        {"ulps", "at random places, ladders of 16 points one unit in the last place apart", {4000, 2000},
         [](std::size_t i, std::size_t, unsigned dimension, Random &, double *p) {
             Random place(i / 16), step(i);
             in_box(dimension, place, p);
             for (unsigned k = 0; k < dimension; ++k) {
                 p[k] += 1;
                 const double ulps = k == i / 16 % dimension ? double(i % 16) : double(step.below(2));
                 p[k] += ulps * std::numeric_limits<double>::epsilon();
             }
         }},
        {"coincident", "random, and half of all at one place", {4000, 2000},
         [](std::size_t i, std::size_t, unsigned dimension, Random &random, double *p) {
             if (i % 2) in_box(dimension, random, p);
             else for (unsigned k = 0; k < dimension; ++k) p[k] = 0.5;
         }},
        {"layers", "random in eight lines or planes", {4000, 2000},
         [](std::size_t i, std::size_t, unsigned dimension, Random &random, double *p) {
             in_box(dimension, random, p);
             p[dimension - 1] = double(i % 8) / 7;
         }},
        {"line", "a line: there are no cells", {4000, 4000},
         [](std::size_t i, std::size_t n, unsigned dimension, Random &, double *p) {
             for (unsigned k = 0; k < dimension; ++k) p[k] = double(k + 1) * double(i) / double(n);
         }},
    };
    return sets;
}

inline const Set &set_of(const std::string &name) {
    for (const Set &set : all_sets())
        if (name == set.name) return set;
    throw std::runtime_error("no set is called " + name);
}

inline Points points_of(const Set &set, std::size_t n, unsigned dimension) {
    Points points(n * dimension, 0.0);
    Random random(n);
    for (std::size_t i = 0; i < n; ++i) set.make(i, n, dimension, random, &points[i * dimension]);
    return points;
}

}  // namespace costs
