// Semi-discrete optimal transport: weights with which the power cells of given points in a square have prescribed areas. Of all ways
// to divide the square into pieces of these areas, one for each point, power cells have the least mean square of the distance to it.
// Newton's method finds the weights (areas.hpp). Nothing moves but these, and the triangulation follows them.
//
//   transport [points [picture.svg]]
#include "areas.hpp"

#include <deldrift.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

namespace {

using areas::Numbers;
using areas::Place;

// A square of points that lie closer where they are further to the left.
std::vector<Place> uneven_points(int count) {
    std::vector<Place> points;
    std::mt19937 random(1);
    const auto next = [&random] { return static_cast<double>(random()) / 4294967296.0; };
    for (int k = 0; k < count; k++) {
        const double x = next();
        points.push_back({0.02 + 0.96 * x * x, 0.02 + 0.96 * next()});
    }
    return points;
}

// Areas that are to be: large ones within a ring.
Numbers wanted_areas(const std::vector<Place> &points) {
    Numbers areas;
    double sum = 0;
    for (const auto &[x, y] : points) {
        areas.push_back(std::abs(std::hypot(x - 0.5, y - 0.5) - 0.3) < 0.1 ? 4 : 1);
        sum += areas.back();
    }
    for (double &area : areas) area /= sum;
    return areas;
}

}  // namespace

int main(int n_arguments, char **arguments) {
    const int count = n_arguments > 1 ? std::atoi(arguments[1]) : 300;
    const std::vector<Place> points = uneven_points(count);
    const Numbers wanted = wanted_areas(points);
    Numbers weights(points.size()), shades(wanted);
    const double most = *std::max_element(wanted.begin(), wanted.end());
    for (double &shade : shades) shade *= 0.8 / most;
    deldrift::Triangulation t(2, points, deldrift::Weights{weights});
    Picture picture({0, 0}, {1, 1}, 380, 2, "a small area is wanted", "a large one");
    areas::draw(picture, "equal weights: Voronoi cells", points, weights, shades, t.edges());
    const areas::Search search = areas::find_weights(t, weights, wanted, 1e-6);
    areas::draw(picture, "weights for which areas are as they are wanted", points, weights, shades, t.edges());
    double sum = 0;
    for (const double area : search.cells.volumes) sum += area;
    std::printf("%d points: areas within %.1e of their mean after %d steps, %d of them halved; sum of areas within %.1e\n",
                count, search.error, search.steps, search.halves, std::abs(sum - 1));
    if (n_arguments > 2 && !picture.save(arguments[2])) {
        std::fprintf(stderr, "%s cannot be written\n", arguments[2]);
        return 1;
    }
    return search.error < 1e-6 ? 0 : 1;
}
