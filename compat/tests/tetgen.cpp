// TetGen's convention: cells against a new triangulation and the definition, coincident points, and what is thrown.
// Beside TetGen itself, tetgen_original.cpp compares every list.
#include <deldrift_tetgen.h>

#include <cmath>
#include <cstring>
#include <map>
#include <string>

#include "check.hpp"

namespace {

// Calls with points of the test's own, with weights or without; what is thrown, or 0.
int call(const char *switches, const Points &points, tetgenio &out, int firstnumber = 0,
         const std::vector<double> &weights = {}) {
    tetgenio in;
    in.firstnumber = firstnumber;
    in.pointlist = const_cast<double *>(points.data());
    in.numberofpoints = static_cast<int>(points.size() / 3);
    in.numberofpointattributes = weights.empty() ? 0 : 1;
    if (!weights.empty()) in.pointattributelist = const_cast<double *>(weights.data());
    std::string text(switches);
    int thrown = 0;
    try {
        tetrahedralize(text.data(), &in, &out);
    } catch (int code) {
        thrown = code;
    }
    in.pointlist = in.pointattributelist = nullptr;
    return thrown;
}

CellSet cells_of(const tetgenio &out, int first) {
    CellSet set;
    for (int c = 0; c < out.numberoftetrahedra; c++) insert_cell(set, out.tetrahedronlist + 4 * c, 4, first);
    return set;
}

void cells_are_those_of_a_new_triangulation() {
    for (const Points &points : {random_points(3, 4, 1), random_points(3, 3000, 2), lattice_points(3, 400, 16, 3)}) {
        for (const char *switches : {"QzJ", "QJ", "QzJnfev", "VJz"}) {
            for (const int firstnumber : {0, 1}) {
                tetgenio out;
                CHECK(call(switches, points, out, firstnumber) == 0);
                const int first = std::strchr(switches, 'z') != nullptr ? 0 : firstnumber;
                CHECK(cells_of(out, first) == fresh_cells(3, points));
                CHECK(static_cast<std::size_t>(out.numberofpoints) == points.size() / 3);
            }
        }
    }
}

void cells_satisfy_the_definition() {
    const Points points = lattice_points(3, 70, 6, 4);
    tetgenio out;
    CHECK(call("QzJ", points, out) == 0 && out.numberoftetrahedra > 100);
    for (int c = 0; c < out.numberoftetrahedra; c++) {
        const std::vector<std::size_t> corners(out.tetrahedronlist + 4 * c, out.tetrahedronlist + 4 * c + 4);
        CHECK(orientation(points, 3, corners) > 0);
        for (std::size_t p = 0; p < points.size() / 3; p++) CHECK(in_sphere(points, 3, corners, p) <= 0);
    }
}

// Without J, points at the place of another are left out, and the numbers of the others close up.
void coincident_points_are_left_out() {
    Points points = random_points(3, 50, 5), expected = points;
    points.insert(points.begin() + 30, points.begin() + 6, points.begin() + 9);
    tetgenio out;
    CHECK(call("Qznfev", points, out) == 0);
    CHECK(out.numberofpoints == 50 && std::memcmp(out.pointlist, expected.data(), sizeof(double) * 150) == 0);
    CHECK(cells_of(out, 0) == fresh_cells(3, expected));
    CHECK(out.numberofvcells == 50);
    for (int e = 0; e < 2 * out.numberofedges; e++) CHECK(out.edgelist[e] >= 0 && out.edgelist[e] < 50);
}

// Euler: of a ball cut into tetrahedra, points - edges + faces - tetrahedra is 1.
void lists_are_complete() {
    const Points points = random_points(3, 500, 6);
    tetgenio out;
    CHECK(call("Qznfev", points, out) == 0);
    CHECK(out.numberofpoints - out.numberofedges + out.numberoftrifaces - out.numberoftetrahedra == 1);
    CHECK(out.numberofvpoints == out.numberoftetrahedra && out.numberofvedges == out.numberoftrifaces);
    CHECK(out.numberofvfacets == out.numberofedges && out.numberofvcells == out.numberofpoints);
    for (int t = 0; t < out.numberoftetrahedra; t++) {
        const double *centre = out.vpointlist + 3 * t;
        double least = HUGE_VAL, most = 0;
        for (int i = 0; i < 4; i++) {
            const double *p = out.pointlist + 3 * out.tetrahedronlist[4 * t + i];
            const double distance = std::hypot(p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]);
            least = std::min(least, distance);
            most = std::max(most, distance);
        }
        CHECK(most - least <= 1e-8 * (1 + most));
    }
}

// Of vertices whose power sphere has no other inside, by whole numbers: with ties, and several points at one place.
void weighted_cells_satisfy_the_definition() {
    const Points points = lattice_points(3, 90, 5, 8);
    std::vector<double> weights = lattice_points(1, 90, 9, 9);
    for (double &w : weights) w -= 3;
    std::set<std::array<double, 3>> places, shown;
    tetgenio out, all;
    CHECK(call("Qznfevw", points, out, 0, weights) == 0 && call("QzwJ", points, all, 0, weights) == 0);
    CHECK(all.numberofpoints == 90 && all.numberoftetrahedra == out.numberoftetrahedra && out.numberoftetrahedra > 20);
    CHECK(std::equal(weights.begin(), weights.end(), all.pointattributelist));
    for (int c = 0; c < out.numberoftetrahedra; c++) {
        const int *corners = out.tetrahedronlist + 4 * c;
        const double *centre = out.vpointlist + 3 * c;
        double p[5][3], w[5];
        const auto take = [&](std::size_t at, const tetgenio &io, int i) {
            std::copy_n(io.pointlist + 3 * i, 3, p[at]);
            w[at] = io.pointattributelist[i];
            double power = -w[at];
            for (std::size_t k = 0; k < 3; k++) power += (p[at][k] - centre[k]) * (p[at][k] - centre[k]);
            return power;
        };
        const double radius = take(0, out, corners[0]);
        for (std::size_t i = 0; i < 4; i++) {
            CHECK(std::abs(take(i, out, corners[i]) - radius) < 1e-8 * (1 + std::abs(radius)));
            shown.insert({p[i][0], p[i][1], p[i][2]});
        }
        for (int i = 0; i < all.numberofpoints; i++) {
            int sign = 2;
            take(4, all, i);
            CHECK(deldrift_in_power_sphere(3, &p[0][0], w, &sign) == DELDRIFT_OK && sign <= 0);
        }
    }
    // Those that are hidden by weight stay, in no tetrahedron, and with an empty cell; of a place with tetrahedra the
    // heaviest one.
    std::map<std::array<double, 3>, std::pair<int, double>> given;
    for (std::size_t i = 0; i < 90; i++) {
        auto &[n, heaviest] = given[{points[3 * i], points[3 * i + 1], points[3 * i + 2]}];
        heaviest = n++ == 0 ? weights[i] : std::max(heaviest, weights[i]);
    }
    int n_left = 0, n_hidden = 0;
    for (const auto &[place, at] : given) n_left += shown.count(place) > 0 ? 1 : at.first;
    CHECK(out.numberofpoints == n_left && out.numberofvcells == n_left);
    for (int i = 0; i < out.numberofpoints; i++) {
        const double *q = out.pointlist + 3 * i;
        const std::array<double, 3> place{q[0], q[1], q[2]};
        const bool is_shown = shown.count(place) > 0;
        n_hidden += !is_shown;
        CHECK(!is_shown || out.pointattributelist[i] == given[place].second);
        CHECK((out.vcelllist[i][0] > 0) == is_shown);
    }
    CHECK(n_hidden > 0 && n_left < 90);
    // Without attributes the weight is the greatest magnitude of the coordinates, and comes out as the only attribute.
    tetgenio without;
    CHECK(call("Qzw", random_points(3, 30, 10), without) == 0 && without.numberofpointattributes == 1);
    for (int i = 0; i < without.numberofpoints; i++) {
        const double *q = without.pointlist + 3 * i;
        CHECK(without.pointattributelist[i] == std::max({q[0], q[1], q[2]}));
    }
}

void weights_that_are_no_numbers_throw() {
    const Points points = random_points(3, 20, 7);
    for (const double bad : {std::nan(""), HUGE_VAL, 1e115}) {
        std::vector<double> weights(20);
        weights[7] = bad;
        tetgenio out;
        CHECK(call("Qzw", points, out, 0, weights) == 10 && out.pointlist == nullptr && out.numberofpoints == 0);
        // Without w they are attributes like others.
        CHECK(call("Qz", points, out, 0, weights) == 0 && out.numberofpoints == 20);
    }
}

// The centre of a cell so flat that its volume, 2^-60 / 6, is lost in doubles is far away, but a number.
void centres_of_flat_cells_are_finite() {
    const Points points{0, 0, 0, 1, 1 - 0x1p-30, 0, 1 + 0x1p-30, 1, 0, 0, 0, 1};
    tetgenio out;
    CHECK(call("Qzv", points, out) == 0 && out.numberofvpoints == 1);
    for (int i = 0; i < 3 * out.numberofvpoints; i++) CHECK(std::isfinite(out.vpointlist[i]));
}

void bad_input_throws() {
    const Points good = random_points(3, 20, 7);
    const auto thrown = [](const char *switches, const Points &points) {
        tetgenio out;
        const int code = call(switches, points, out);
        CHECK(out.tetrahedronlist == nullptr && out.pointlist == nullptr && out.numberoftetrahedra == 0);
        return code;
    };
    for (const char *switches : {"Qzp", "pq1.4a0.1", "r", "Qznn", "QzD", "Qzw1", "Qzo2", "Qzi", "Qzm", "QzC"})
        CHECK(thrown(switches, good) == 10);
    for (const double bad : {std::nan(""), HUGE_VAL, 1e60}) {
        Points points = good;
        points[8] = bad;
        CHECK(thrown("Qz", points) == 10);
    }
    CHECK(thrown("Qz", Points(good.begin(), good.begin() + 9)) == 10 && thrown("Qz", {}) == 10);
    const Points plane{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 3, 0};
    CHECK(thrown("Qz", plane) == 10);
    tetgenio io;
    char switches[] = "Qz";
    const auto throws = [&](tetgenio *in, tetgenio *out, char *text) {
        try {
            tetrahedralize(text, in, out);
        } catch (int code) {
            return code == 10;
        }
        return false;
    };
    CHECK(throws(nullptr, &io, switches) && throws(&io, nullptr, switches) && throws(&io, &io, nullptr));
    // Not initialised, or of another layout.
    unsigned char other[512] = {};
    CHECK(throws(&io, reinterpret_cast<tetgenio *>(other), switches));
    other[100] = other[108] = 4;
    CHECK(throws(&io, reinterpret_cast<tetgenio *>(other), switches));
}

} // namespace

int main() {
    cells_are_those_of_a_new_triangulation();
    cells_satisfy_the_definition();
    coincident_points_are_left_out();
    lists_are_complete();
    centres_of_flat_cells_are_finite();
    weighted_cells_satisfy_the_definition();
    weights_that_are_no_numbers_throw();
    bad_input_throws();
}
