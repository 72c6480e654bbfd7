// What the tests share: checks, points, and the definition of a Delaunay triangulation in exact arithmetic.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <set>
#include <vector>

#include <deldrift.h>

#define CHECK(condition)                                                                       \
    do {                                                                                       \
        if (!(condition)) {                                                                    \
            std::fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition);       \
            std::exit(1);                                                                      \
        }                                                                                      \
    } while (false)

using Points = std::vector<double>;

inline Points random_points(unsigned dimension, std::size_t n, unsigned seed) {
    std::mt19937_64 random(seed);
    Points points(n * dimension);
    for (double &x : points) x = static_cast<double>(random() >> 11) * 0x1p-53;
    return points;
}

// Every coordinate moves by at most this.
inline Points moved(Points points, double by, unsigned seed) {
    std::mt19937_64 random(seed);
    for (double &x : points) x += by * (static_cast<double>(random() >> 11) * 0x1p-52 - 1);
    return points;
}

// Points with integer coordinates from 0 to side - 1, many of them cocircular, some at the same place.
inline Points lattice_points(unsigned dimension, std::size_t n, unsigned side, unsigned seed) {
    std::mt19937_64 random(seed);
    Points points(n * dimension);
    for (double &x : points) x = static_cast<double>(random() % side);
    return points;
}

using CellSet = std::set<std::array<std::uint32_t, 4>>;

// The corners of a cell, ascending, in the order that std::set compares.
template <class T>
void insert_cell(CellSet &cells, const T *corners, unsigned n_corners, T first) {
    std::array<std::uint32_t, 4> row{};
    for (unsigned i = 0; i < n_corners; i++) row[i] = static_cast<std::uint32_t>(corners[i] - first);
    for (unsigned i = 1; i < n_corners; i++)
        for (unsigned j = i; j > 0 && row[j - 1] > row[j]; j--) std::swap(row[j - 1], row[j]);
    CHECK(cells.insert(row).second);
}

// The cells of a new triangulation.
inline CellSet fresh_cells(unsigned dimension, const Points &points) {
    deldrift_triangulation *t = nullptr;
    deldrift_cells_view view{};
    CHECK(deldrift_create(dimension, points.data(), points.size() / dimension, nullptr, &t) == DELDRIFT_OK);
    CHECK(deldrift_cells(t, &view) == DELDRIFT_OK);
    CellSet cells;
    for (std::size_t c = 0; c < view.count; c++)
        insert_cell(cells, view.vertices + c * (dimension + 1), dimension + 1, 0u);
    deldrift_destroy(t);
    return cells;
}

// Of integer coordinates of magnitude below 2^15 (2D) or 2^9 (3D), for which these are exact.
__extension__ typedef __int128 Integer;

inline Integer determinant(const std::vector<std::vector<Integer>> &rows) {
    const std::size_t n = rows.size();
    if (n == 1) return rows[0][0];
    Integer sum = 0;
    for (std::size_t k = 0; k < n; k++) {
        std::vector<std::vector<Integer>> minor;
        for (std::size_t i = 1; i < n; i++) {
            minor.emplace_back();
            for (std::size_t j = 0; j < n; j++)
                if (j != k) minor.back().push_back(rows[i][j]);
        }
        sum += (k % 2 == 0 ? 1 : -1) * rows[0][k] * determinant(minor);
    }
    return sum;
}

inline std::vector<Integer> difference_of(const Points &points, unsigned dimension, std::size_t p, std::size_t q) {
    std::vector<Integer> row;
    for (unsigned axis = 0; axis < dimension; axis++)
        row.push_back(static_cast<Integer>(points[p * dimension + axis] - points[q * dimension + axis]));
    return row;
}

// The determinant of the edges from the first corner: positive if deldrift's orientation.
inline Integer orientation(const Points &points, unsigned dimension, const std::vector<std::size_t> &corners) {
    std::vector<std::vector<Integer>> rows;
    for (unsigned i = 1; i <= dimension; i++) rows.push_back(difference_of(points, dimension, corners[i], corners[0]));
    return determinant(rows);
}

// Positive if the point is inside the sphere of a positively oriented cell, 0 if it is on it.
inline Integer in_sphere(const Points &points, unsigned dimension, const std::vector<std::size_t> &corners,
                         std::size_t point) {
    std::vector<std::vector<Integer>> rows;
    for (std::size_t corner : corners) {
        rows.push_back(difference_of(points, dimension, corner, point));
        Integer squared = 0;
        for (Integer x : rows.back()) squared += x * x;
        rows.back().push_back(squared);
    }
    return (dimension == 2 ? 1 : -1) * determinant(rows);
}
