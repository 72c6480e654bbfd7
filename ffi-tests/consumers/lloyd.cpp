// Smoothing as a mesh optimiser does it: inner vertices go to the mean of their neighbours, timestamp by
// timestamp, until the mesh hardly moves.
#include <cmath>
#include <cstdio>
#include <deldrift.hpp>

namespace {

constexpr std::size_t side = 12;

// A grid whose inner vertices have been displaced.
std::vector<double> disturbed_grid() {
    std::vector<double> positions;
    for (std::size_t y = 0; y < side; y++) {
        for (std::size_t x = 0; x < side; x++) {
            const bool is_inner = x % (side - 1) != 0 && y % (side - 1) != 0;
            const double by = is_inner ? 0.4 : 0.0, phase = static_cast<double>(3 * x + 5 * y);
            positions.push_back(static_cast<double>(x) + by * std::sin(phase));
            positions.push_back(static_cast<double>(y) + by * std::cos(2 * phase));
        }
    }
    return positions;
}

// The mean of the corners of the cells around each inner vertex, where it is already elsewhere.
std::vector<double> smoothed(const deldrift::Triangulation &t, const std::vector<double> &positions) {
    std::vector<double> sums(positions.size()), weights(positions.size() / 2);
    for (auto cell : t.cells()) {
        for (std::uint32_t v : cell) {
            for (std::uint32_t w : cell) {
                for (std::size_t k = 0; k < 2; k++) sums[2 * v + k] += positions[2 * w + k];
                weights[v] += 1;
            }
        }
    }
    std::vector<double> next = positions;
    for (std::size_t v = 0; v < weights.size(); v++) {
        const std::size_t x = v % side, y = v / side;
        if (x % (side - 1) == 0 || y % (side - 1) == 0) continue;
        for (std::size_t k = 0; k < 2; k++) next[2 * v + k] = sums[2 * v + k] / weights[v];
    }
    return next;
}

}  // namespace

int main() {
    std::vector<double> positions = disturbed_grid();
    deldrift::Triangulation t(2, positions);
    double largest = 1;
    while (largest > 1e-3) {
        std::vector<double> next = smoothed(t, positions);
        largest = 0;
        for (std::size_t i = 0; i < next.size(); i++) largest = std::fmax(largest, std::fabs(next[i] - positions[i]));
        t.move_vertices(next);
        t.commit_timestamp();
        positions = std::move(next);
    }
    t.validate(3);
    std::printf("%zu triangles\n", t.cell_count());
    return t.cell_count() == 2 * (side - 1) * (side - 1) ? 0 : 1;
}
