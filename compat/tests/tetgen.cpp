// TetGen's convention: cells against a new triangulation and the definition, coincident points, and what is thrown.
// Beside TetGen itself, tetgen_original.cpp compares every list.
#include <deldrift_tetgen.h>

#include <cmath>
#include <cstring>
#include <string>

#include "check.hpp"

namespace {

// Calls with points of the test's own; what is thrown, or 0.
int call(const char *switches, const Points &points, tetgenio &out, int firstnumber = 0) {
    tetgenio in;
    in.firstnumber = firstnumber;
    in.pointlist = const_cast<double *>(points.data());
    in.numberofpoints = static_cast<int>(points.size() / 3);
    std::string text(switches);
    int thrown = 0;
    try {
        tetrahedralize(text.data(), &in, &out);
    } catch (int code) {
        thrown = code;
    }
    in.pointlist = nullptr;
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
    for (const char *switches : {"Qzp", "pq1.4a0.1", "r", "Qznn", "QzD", "Qzw", "Qzo2", "Qzi", "Qzm", "QzC"})
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
    bad_input_throws();
}
