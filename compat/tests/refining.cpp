// Triangle's refinement, against what the switches promise: a square with a hole, a region and a slit.
#include <deldrift_triangle.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "check.hpp"

namespace {

using Pair = std::pair<int, int>;
Pair pair_of(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

// What switch u asks: whether a triangle is too large for the distance of its centre from the corner (64, 64); a row
// for each triangle that it was asked about, which are counter-clockwise and of the area told. It may throw at some
// question.
int n_asked = 0, throws_at = -1;
bool are_asked_right = true;
double allowed(double x, double y) { return 0.5 + 0.25 * std::hypot(64 - x, 64 - y); }

} // namespace

extern "C" int triunsuitable(double *p, double *q, double *r, double area) {
    if (n_asked++ == throws_at) throw std::string("enough");
    const double own = 0.5 * ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
    are_asked_right = are_asked_right && area > 0 && std::abs(area - own) <= 1e-9;
    return area > allowed((p[0] + q[0] + r[0]) / 3, (p[1] + q[1] + r[1]) / 3) ? 1 : 0;
}

namespace {

// Whole numbers, so that halves of segments are exact. Segment i has marker 10 + i; those of the hole are 4 to 7, the
// slit is 8, and 9 cuts the square in two.
const Points places{0, 0, 64, 0, 64, 64, 0, 64, 8, 8, 16, 8, 16, 16, 8, 16, 8, 40, 24, 48, 32, 0, 32, 64};
const std::vector<int> segments{0, 10, 1, 2, 2, 11, 3, 0, 4, 5, 5, 6, 6, 7, 7, 4, 8, 9, 10, 11, 10, 1, 11, 3};
constexpr int n_points = 12, n_segments = 12;

class Refined {
public:
    explicit Refined(const char *switches) {
        triangulateio in{};
        points_ = places;
        segments_ = segments;
        for (int i = 0; i < n_segments; i++) markers_.push_back(10 + i);
        for (int i = 0; i < n_points; i++) attributes_.push_back(linear(&places[2 * static_cast<std::size_t>(i)]));
        in.pointlist = points_.data();
        in.numberofpoints = n_points;
        in.pointattributelist = attributes_.data();
        in.numberofpointattributes = 1;
        in.segmentlist = segments_.data();
        in.segmentmarkerlist = markers_.data();
        in.numberofsegments = n_segments;
        in.holelist = hole_;
        in.numberofholes = 1;
        in.regionlist = regions_;
        in.numberofregions = 2;
        std::string text(switches);
        CHECK(triangulate(text.data(), &in, &out, nullptr) == 0);
    }
    Refined(const char *switches, triangulateio in) {
        std::string text(switches);
        CHECK(triangulate(text.data(), &in, &out, nullptr) == 0);
    }
    Refined(const Refined &) = delete;
    Refined &operator=(const Refined &) = delete;
    ~Refined() {
        for (double *array : {out.pointlist, out.pointattributelist, out.triangleattributelist}) std::free(array);
        for (int *array : {out.pointmarkerlist, out.trianglelist, out.neighborlist, out.edgelist, out.edgemarkerlist,
                           out.segmentlist, out.segmentmarkerlist})
            std::free(array);
    }

    static double linear(const double *place) { return 3 * place[0] - place[1] + 1; }
    const double *at(int point) const { return out.pointlist + 2 * point; }
    const int *corners(int c) const { return out.trianglelist + 3 * c; }
    double area(int c) const {
        const double *p = at(corners(c)[0]), *q = at(corners(c)[1]), *r = at(corners(c)[2]);
        return 0.5 * ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
    }
    // Of the vectors from a point to two others, by their lengths.
    double cosine(int point, int a, int b) const {
        const double *p = at(point), *q = at(a), *r = at(b);
        const double x = q[0] - p[0], y = q[1] - p[1], other_x = r[0] - p[0], other_y = r[1] - p[1];
        return (x * other_x + y * other_y) / (std::hypot(x, y) * std::hypot(other_x, other_y));
    }
    std::map<Pair, int> pieces() const {
        std::map<Pair, int> result;
        for (int i = 0; i < out.numberofsegments; i++)
            result[pair_of(out.segmentlist[2 * i], out.segmentlist[2 * i + 1])] = out.segmentmarkerlist[i];
        return result;
    }

    triangulateio out{};

private:
    Points points_;
    std::vector<double> attributes_;
    std::vector<int> segments_, markers_;
    double hole_[2] = {12, 12}, regions_[8] = {48, 32, 7, 20, 4, 4, 5, 0};
};

// Areas of the regions, 7 to the right and 5 to the left of the cut, and places, attributes and markers of points.
void check_domain(const Refined &mesh) {
    double sums[2] = {0, 0};
    for (int c = 0; c < mesh.out.numberoftriangles; c++) {
        CHECK(mesh.area(c) > 0);
        const bool is_right = mesh.out.triangleattributelist[c] == 7;
        CHECK(is_right || mesh.out.triangleattributelist[c] == 5);
        for (int i = 0; i < 3; i++) {
            const double x = mesh.at(mesh.corners(c)[i])[0];
            CHECK(is_right ? x >= 32 : x <= 32);
        }
        sums[is_right ? 0 : 1] += mesh.area(c);
    }
    CHECK(std::abs(sums[0] - 32 * 64) < 1e-9 && std::abs(sums[1] - (32 * 64 - 64)) < 1e-9);
    CHECK(std::equal(places.begin(), places.end(), mesh.out.pointlist));
    for (int i = 0; i < mesh.out.numberofpoints; i++)
        CHECK(std::abs(mesh.out.pointattributelist[i] - Refined::linear(mesh.at(i))) < 1e-9);
}

// The pieces with the marker of each segment are on it, and as long together; so are points with its marker.
void check_segments(const Refined &mesh, int n_whole, int n_before = n_points) {
    std::array<double, n_segments> lengths{};
    std::set<int> on_segments;
    int n_pieces = 0;
    for (const auto &[ends, marker] : mesh.pieces()) {
        const std::size_t segment = static_cast<std::size_t>(marker - 10);
        CHECK(segment < n_segments);
        const double *start = &places[2 * static_cast<std::size_t>(segments[2 * segment])];
        const double *end = &places[2 * static_cast<std::size_t>(segments[2 * segment + 1])];
        const double x = end[0] - start[0], y = end[1] - start[1];
        for (const int point : {ends.first, ends.second}) {
            const double *p = mesh.at(point);
            CHECK(std::abs(x * (p[1] - start[1]) - y * (p[0] - start[0])) < 1e-10);
            if (point >= n_before) CHECK(mesh.out.pointmarkerlist[point] == marker);
            on_segments.insert(point);
        }
        lengths[segment] += std::hypot(mesh.at(ends.second)[0] - mesh.at(ends.first)[0],
                                       mesh.at(ends.second)[1] - mesh.at(ends.first)[1]);
        n_pieces++;
    }
    for (std::size_t i = 0; i < n_segments; i++) {
        const double *start = &places[2 * static_cast<std::size_t>(segments[2 * i])];
        const double *end = &places[2 * static_cast<std::size_t>(segments[2 * i + 1])];
        CHECK(std::abs(lengths[i] - std::hypot(end[0] - start[0], end[1] - start[1])) < 1e-9);
    }
    for (int i = n_before; i < mesh.out.numberofpoints; i++)
        CHECK(on_segments.count(i) == 1 || mesh.out.pointmarkerlist[i] == 0);
    CHECK(n_whole < 0 || n_pieces == n_whole);
}

// Neighbours across corners, and edges with the markers of their segments.
void check_lists(const Refined &mesh) {
    std::map<Pair, int> sides;
    for (int c = 0; c < mesh.out.numberoftriangles; c++) {
        for (int i = 0; i < 3; i++) {
            const int a = mesh.corners(c)[(i + 1) % 3], b = mesh.corners(c)[(i + 2) % 3];
            sides[pair_of(a, b)]++;
            const int other = mesh.out.neighborlist[3 * c + i];
            if (other < 0) continue;
            const int *row = mesh.corners(other);
            CHECK(std::count(row, row + 3, a) == 1 && std::count(row, row + 3, b) == 1);
        }
    }
    CHECK(mesh.out.numberofedges == static_cast<int>(sides.size()));
    const std::map<Pair, int> pieces = mesh.pieces();
    for (int i = 0; i < mesh.out.numberofedges; i++) {
        const Pair edge = pair_of(mesh.out.edgelist[2 * i], mesh.out.edgelist[2 * i + 1]);
        CHECK(sides.count(edge) == 1);
        const auto piece = pieces.find(edge);
        CHECK(mesh.out.edgemarkerlist[i] == (piece == pieces.end() ? 0 : piece->second));
        CHECK(sides[edge] == 2 || piece != pieces.end());
    }
}

void check_quality(const Refined &mesh, double angle, double area, double area_of_region) {
    const double limit = std::cos(angle * std::acos(-1.0) / 180) + 1e-9;
    for (int c = 0; c < mesh.out.numberoftriangles; c++) {
        CHECK(mesh.area(c) <= area * (1 + 1e-12));
        if (mesh.out.triangleattributelist[c] == 7) CHECK(mesh.area(c) <= area_of_region * (1 + 1e-12));
        const int *row = mesh.corners(c);
        for (int i = 0; i < 3; i++) CHECK(mesh.cosine(row[i], row[(i + 1) % 3], row[(i + 2) % 3]) <= limit);
    }
}

// No corner opposite a segment is in the circle around it.
void check_conforming(const Refined &mesh) {
    const std::map<Pair, int> pieces = mesh.pieces();
    for (int c = 0; c < mesh.out.numberoftriangles; c++) {
        const int *row = mesh.corners(c);
        for (int i = 0; i < 3; i++) {
            const int a = row[(i + 1) % 3], b = row[(i + 2) % 3];
            if (pieces.count(pair_of(a, b)) == 1) CHECK(mesh.cosine(row[i], a, b) >= -1e-12);
        }
    }
}

void quality_is_reached() {
    constexpr double any = 1e9;
    const struct {
        const char *switches;
        double angle, area, area_of_region;
        int n_whole; // the number of pieces, where none is split
    } cases[] = {{"QzpAneq", 20, any, any, -1},        {"QzpAneq33", 33, any, any, -1},
                 {"QzpAnea10", 0, 10, any, -1},        {"QzpAneqa", 20, any, 20, -1},
                 {"QzpAneq30a5.5a", 30, 5.5, 5.5, -1}, {"QzpAneYYq0", 0, any, any, n_segments},
                 {"QzpAneD", 0, any, any, -1},         {"QzpAneq25a30D", 25, 30, any, -1}};
    for (const auto &each : cases) {
        const Refined mesh(each.switches);
        check_domain(mesh);
        check_segments(mesh, each.n_whole);
        check_lists(mesh);
        check_quality(mesh, each.angle, each.area, each.area_of_region);
        if (std::string(each.switches).find('D') != std::string::npos) check_conforming(mesh);
    }
}

void the_program_is_asked() {
    for (const char *switches : {"QzpAneu", "QzpAneuq25", "QzpAneuD", "QzpAneua20"}) {
        n_asked = 0;
        const Refined mesh(switches);
        check_domain(mesh);
        check_segments(mesh, -1);
        check_lists(mesh);
        check_quality(mesh, std::string(switches).find('q') == std::string::npos ? 0 : 25, 1e9, 1e9);
        CHECK(n_asked > mesh.out.numberoftriangles && are_asked_right && mesh.out.numberoftriangles > 300);
        for (int c = 0; c < mesh.out.numberoftriangles; c++) {
            const int *row = mesh.corners(c);
            const double *p = mesh.at(row[0]), *q = mesh.at(row[1]), *r = mesh.at(row[2]);
            CHECK(mesh.area(c) <= allowed((p[0] + q[0] + r[0]) / 3, (p[1] + q[1] + r[1]) / 3) + 1e-9);
        }
    }
    n_asked = 0;
    Refined without("QzpAneq25");
    CHECK(n_asked == 0);
    // What it throws comes out, and the next call is as if there had been none.
    for (const int question : {0, 100}) {
        throws_at = question;
        n_asked = 0;
        std::string thrown;
        try {
            const Refined mesh("QzpAneu");
        } catch (const std::string &what) {
            thrown = what;
        }
        throws_at = -1;
        CHECK(thrown == "enough" && n_asked == question + 1);
        check_lists(Refined("QzpAneu"));
    }
}

// L is what D was called.
void an_old_name_does_the_same() {
    for (const auto &[old, current] : {std::pair{"QzpAneL", "QzpAneD"}, {"QzpAneq25a30L", "QzpAneq25a30D"}}) {
        const Refined mesh(old), same(current);
        check_conforming(mesh);
        CHECK(mesh.out.numberofpoints == same.out.numberofpoints && mesh.out.numberofpoints > n_points);
        CHECK(std::equal(mesh.at(0), mesh.at(mesh.out.numberofpoints), same.at(0)));
    }
}

// A mesh, as the input of a call that refines it.
struct Given {
    triangulateio in{};
    std::vector<double> areas;

    explicit Given(const Refined &mesh) : in(mesh.out) {
        for (int c = 0; c < in.numberoftriangles; c++) areas.push_back(c % 5 == 0 ? -1 : 2 + c % 7);
        in.trianglearealist = areas.data();
    }
    // The greatest area of the triangle around a place; on an edge the greater one.
    double area_at(double x, double y) const {
        double most = 0;
        for (int c = 0; c < in.numberoftriangles; c++) {
            bool is_inside = true;
            for (int i = 0; i < 3; i++) {
                const double *p = in.pointlist + 2 * in.trianglelist[3 * c + i];
                const double *q = in.pointlist + 2 * in.trianglelist[3 * c + (i + 1) % 3];
                is_inside = is_inside && (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]) >= -1e-9;
            }
            const double area = areas[static_cast<std::size_t>(c)];
            if (is_inside) most = std::max(most, area > 0 ? area : 1e9);
        }
        return most;
    }
};

// Regions, areas, markers and attributes of points are as for the mesh that has been refined. Without p segments inside
// are lost, and so are markers.
void a_given_mesh_is_refined() {
    for (const char *coarse : {"QzpAneqa60", "QzpAne", "QzpAneq33a20D"}) {
        const Refined given(coarse);
        const Given mesh(given);
        const int n_given = mesh.in.numberofpoints;
        for (const char *switches : {"Qzrpnea", "Qzrpneq25a", "Qzrpneu", "Qzrpneq20D", "Qzrpneq30a5", "QzrneAq30a"}) {
            const std::string text(switches);
            const Refined fine(switches, mesh.in);
            CHECK(fine.out.numberofpoints >= n_given);
            CHECK(std::equal(mesh.in.pointlist, mesh.in.pointlist + 2 * n_given, fine.out.pointlist));
            if (text.find('p') == std::string::npos) {
                CHECK(fine.out.segmentlist == nullptr);
            } else {
                check_domain(fine);
                check_segments(fine, -1, n_given);
                check_lists(fine);
            }
            if (text.find('D') != std::string::npos) check_conforming(fine);
            const std::size_t q = text.find('q');
            const double angle = q == std::string::npos ? 0 : std::stod(text.substr(q + 1));
            check_quality(fine, angle, text.find("a5") == std::string::npos ? 1e9 : 5, 1e9);
            double sum = 0;
            for (int c = 0; c < fine.out.numberoftriangles; c++) {
                const int *row = fine.corners(c);
                const double *a = fine.at(row[0]), *b = fine.at(row[1]), *d = fine.at(row[2]);
                const double most = mesh.area_at((a[0] + b[0] + d[0]) / 3, (a[1] + b[1] + d[1]) / 3);
                if (text.back() == 'a') CHECK(fine.area(c) <= most + 1e-9);
                sum += fine.area(c);
            }
            CHECK(std::abs(sum - (64 * 64 - 64)) < 1e-9);
            // At rest nothing is added.
            if (text != "Qzrpneq30a5") continue;
            const Refined again(switches, fine.out);
            CHECK(again.out.numberofpoints == fine.out.numberofpoints);
            CHECK(again.out.numberoftriangles == fine.out.numberoftriangles);
        }
    }
    // Any triangles, those of a grid, of which other diagonals are as good, and clockwise ones.
    Points grid;
    std::vector<int> corners;
    std::vector<double> numbers;
    for (int i = 0; i < 36; i++) grid.insert(grid.end(), {static_cast<double>(i % 6), static_cast<double>(i / 6)});
    for (int i = 0; i < 36; i++) {
        if (i % 6 == 5 || i / 6 == 5 || i == 14) continue;
        const bool other = (i % 6 + i / 6) % 2 == 0;
        for (int corner : {i, other ? i + 6 : i + 1, i + 7}) corners.push_back(1 + corner);
        for (int corner : {i, other ? i + 1 : i + 7, other ? i + 7 : i + 6}) corners.push_back(1 + corner);
        for (int k = 0; k < 2; k++) numbers.push_back(i);
    }
    triangulateio in{};
    in.pointlist = grid.data();
    in.numberofpoints = 36;
    in.trianglelist = corners.data();
    in.numberofcorners = 3;
    in.numberoftriangles = static_cast<int>(numbers.size());
    in.triangleattributelist = numbers.data();
    in.numberoftriangleattributes = 1;
    const Refined fine("Qrneq33a0.05", in);
    double sum = 0;
    for (int c = 0; c < fine.out.numberoftriangles; c++) {
        const int *row = fine.corners(c);
        double x = 0, y = 0;
        for (int i = 0; i < 3; i++) {
            x += fine.at(row[i] - 1)[0] / 3;
            y += fine.at(row[i] - 1)[1] / 3;
        }
        CHECK(fine.out.triangleattributelist[c] == std::floor(x) + 6 * std::floor(y));
        const double *p = fine.at(row[0] - 1), *q = fine.at(row[1] - 1), *r = fine.at(row[2] - 1);
        const double area = 0.5 * ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
        CHECK(area > 0 && area <= 0.05);
        sum += area;
    }
    CHECK(std::abs(sum - 24) < 1e-9);
    const auto is_refused = [&](const char *switches) {
        triangulateio out{};
        std::string text(switches);
        const int returned = triangulate(text.data(), &in, &out, nullptr);
        for (double *list : {out.pointlist, out.pointattributelist, out.triangleattributelist}) std::free(list);
        for (int *list : {out.pointmarkerlist, out.trianglelist}) std::free(list);
        return returned == 1 && out.numberoftriangles == 0;
    };
    CHECK(!is_refused("Qrq") && is_refused("Qr") && is_refused("Qrqa") && is_refused("Qzrq"));
    for (const int n_corners : {4, 6}) {
        in.numberofcorners = n_corners;
        CHECK(is_refused("Qrq"));
    }
    in.numberofcorners = 3;
    in.numberoftriangleattributes = 2;
    CHECK(is_refused("Qrq"));
    in.numberoftriangleattributes = 1;
    in.triangleattributelist = nullptr;
    CHECK(is_refused("Qrq"));
    in.numberoftriangleattributes = in.numberoftriangles = 0;
    CHECK(is_refused("Qrq"));
}

void limits_are_kept() {
    for (const auto &[switches, most] : {std::pair{"QzpAneqa1S0", 0}, {"QzpAneqa1S25", 25}, {"QzpAneqa1DS7", 7}}) {
        const Refined mesh(switches);
        check_domain(mesh);
        check_segments(mesh, -1);
        CHECK(mesh.out.numberofpoints == n_points + most);
    }
    const Refined outer_whole("QzpAneqa5Y"), all_whole("QzpAneqa5YY");
    check_segments(all_whole, n_segments);
    int n_inner = 0;
    for (const auto &[ends, marker] : outer_whole.pieces()) n_inner += marker == 18 || marker == 19;
    CHECK(n_inner > 2 && outer_whole.out.numberofsegments == n_segments - 2 + n_inner);
}

// A triangle with six points has the middle of the edge opposite each corner.
void middles_are_points() {
    const Refined mesh("QzpAneqo2");
    CHECK(mesh.out.numberofcorners == 6);
    for (int c = 0; c < mesh.out.numberoftriangles; c++) {
        const int *row = mesh.out.trianglelist + 6 * c;
        for (int i = 0; i < 3; i++)
            for (int axis = 0; axis < 2; axis++)
                CHECK(2 * mesh.at(row[3 + i])[axis] ==
                      mesh.at(row[(i + 1) % 3])[axis] + mesh.at(row[(i + 2) % 3])[axis]);
    }
    std::set<int> used(mesh.out.trianglelist, mesh.out.trianglelist + 6 * mesh.out.numberoftriangles);
    CHECK(static_cast<int>(used.size()) == mesh.out.numberofpoints);
}

// The triangulation that is kept is that of the points given, so that a call after a refinement has what the first has.
void calls_do_not_depend_on_earlier_ones() {
    const Points points = random_points(2, 500, 3);
    const auto cells = [&](const char *switches) {
        triangulateio in{}, out{};
        in.pointlist = const_cast<double *>(points.data());
        in.numberofpoints = 500;
        std::string text(switches);
        CHECK(triangulate(text.data(), &in, &out, nullptr) == 0);
        std::vector<int> rows(out.trianglelist, out.trianglelist + 3 * out.numberoftriangles);
        for (int *array : {out.trianglelist, out.pointmarkerlist}) std::free(array);
        std::free(out.pointlist);
        return rows;
    };
    const std::vector<int> plain = cells("Qz"), refined = cells("Qzq");
    CHECK(cells("Qz") == plain && cells("Qzq") == refined && refined.size() > plain.size());
}

} // namespace

int main() {
    quality_is_reached();
    the_program_is_asked();
    a_given_mesh_is_refined();
    an_old_name_does_the_same();
    limits_are_kept();
    middles_are_points();
    calls_do_not_depend_on_earlier_ones();
}
