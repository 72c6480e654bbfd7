// Triangle's convention: every switch that is served, against a new triangulation, the definition, and Triangle's
// documentation of its output.
#include <deldrift_triangle.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "check.hpp"

namespace {

// A call with its output, which it frees.
class Call {
public:
    Call(const char *switches, const Points &points, int n_attributes = 0, const double *attributes = nullptr,
         const int *markers = nullptr) {
        in.pointlist = const_cast<double *>(points.data());
        in.numberofpoints = static_cast<int>(points.size() / 2);
        in.numberofpointattributes = n_attributes;
        in.pointattributelist = const_cast<double *>(attributes);
        in.pointmarkerlist = const_cast<int *>(markers);
        std::string text(switches);
        CHECK(triangulate(text.data(), &in, &out, &vorout) == 0);
    }
    Call(const Call &) = delete;
    Call &operator=(const Call &) = delete;
    ~Call() {
        for (triangulateio *each : {&out, &vorout}) {
            for (double *array : {each->pointlist, each->pointattributelist, each->normlist}) std::free(array);
            for (int *array : {each->pointmarkerlist, each->trianglelist, each->neighborlist}) std::free(array);
            for (int *array : {each->edgelist, each->edgemarkerlist}) std::free(array);
            for (int *array : {each->segmentlist, each->segmentmarkerlist}) std::free(array);
        }
    }
    CellSet cells(int first) const {
        CellSet set;
        for (int c = 0; c < out.numberoftriangles; c++) insert_cell(set, out.trianglelist + 3 * c, 3, first);
        return set;
    }
    const int *triangle(int c) const { return out.trianglelist + 3 * c; }

    triangulateio in{}, out{}, vorout{};
};

double cross(const double *a, const double *b, const double *c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

void cells_are_those_of_a_new_triangulation() {
    for (const Points &points : {random_points(2, 3, 1), random_points(2, 5000, 2), lattice_points(2, 300, 12, 3)}) {
        for (const char *switches : {"Qz", "Q", "QzP", "QPIz", "-Qz", "Qz{}", "zQiF", "VQXlz", "QzA", "QzS12YYsO",
                                     "zCghH"}) {
            const Call call(switches, points);
            const int first = std::strchr(switches, 'z') != nullptr ? 0 : 1;
            CHECK(call.cells(first) == fresh_cells(2, points));
            CHECK(call.out.numberofcorners == 3 && call.out.numberoftriangleattributes == 0);
            CHECK(call.out.neighborlist == nullptr && call.out.edgelist == nullptr && call.vorout.pointlist == nullptr);
        }
    }
}

void cells_satisfy_the_definition() {
    const Points points = lattice_points(2, 60, 9, 4);
    const Call call("Qz", points);
    CHECK(call.out.numberoftriangles > 50);
    for (int c = 0; c < call.out.numberoftriangles; c++) {
        const std::vector<std::size_t> corners(call.triangle(c), call.triangle(c) + 3);
        CHECK(orientation(points, 2, corners) > 0);
        for (std::size_t p = 0; p < points.size() / 2; p++) CHECK(in_sphere(points, 2, corners, p) <= 0);
    }
}

void neighbours_are_opposite_corners() {
    for (const int first : {0, 1}) {
        const Points points = random_points(2, 500, 5);
        const Call call(first == 0 ? "Qzn" : "Qn", points);
        int hull = 0;
        for (int c = 0; c < call.out.numberoftriangles; c++) {
            for (int i = 0; i < 3; i++) {
                const int neighbour = call.out.neighborlist[3 * c + i];
                if (neighbour == -1) {
                    hull++;
                    continue;
                }
                CHECK(neighbour >= first && neighbour < call.out.numberoftriangles + first);
                const int *other = call.triangle(neighbour - first);
                int shared = 0;
                for (int k = 0; k < 3; k++) shared += other[k] == call.triangle(c)[(i + 1) % 3];
                for (int k = 0; k < 3; k++) shared += other[k] == call.triangle(c)[(i + 2) % 3];
                CHECK(shared == 2);
            }
        }
        CHECK(hull == call.out.numberofsegments);
        CHECK(call.out.numberofedges == (3 * call.out.numberoftriangles + hull) / 2);
    }
}

void points_are_copied_with_attributes_and_markers() {
    const Points points = random_points(2, 200, 6), attributes = random_points(2, 200, 7);
    std::vector<int> markers(200, 0);
    for (std::size_t i = 0; i < 200; i += 3) markers[i] = 5;
    const Call call("Qzn", points, 2, attributes.data(), markers.data());
    CHECK(call.out.numberofpoints == 200 && call.out.numberofpointattributes == 2);
    CHECK(std::memcmp(call.out.pointlist, points.data(), 400 * sizeof(double)) == 0);
    CHECK(std::memcmp(call.out.pointattributelist, attributes.data(), 400 * sizeof(double)) == 0);
    std::vector<bool> on_hull(200);
    for (int c = 0; c < call.out.numberoftriangles; c++)
        for (int i = 0; i < 3; i++)
            for (int k : {1, 2})
                if (call.out.neighborlist[3 * c + i] == -1)
                    on_hull[static_cast<std::size_t>(call.triangle(c)[(i + k) % 3])] = true;
    for (std::size_t i = 0; i < 200; i++)
        CHECK(call.out.pointmarkerlist[i] == (markers[i] != 0 ? 5 : on_hull[i] ? 1 : 0));
}

void switches_leave_lists_out() {
    const Points points = random_points(2, 100, 8);
    const Call without_points("QzN", points);
    CHECK(without_points.out.pointlist == nullptr && without_points.out.pointmarkerlist == nullptr);
    CHECK(without_points.out.numberofpoints == 100 && without_points.out.trianglelist != nullptr);
    const Call without_markers("QzBe", points);
    CHECK(without_markers.out.pointmarkerlist == nullptr && without_markers.out.edgemarkerlist == nullptr);
    CHECK(without_markers.out.pointlist != nullptr && without_markers.out.edgelist != nullptr);
    const Call edges_only("QzeENB", points);
    CHECK(edges_only.out.trianglelist == nullptr && edges_only.out.pointlist == nullptr);
    CHECK(edges_only.out.numberoftriangles > 0 && edges_only.out.edgelist != nullptr);
}

void edges_come_once_with_their_triangle_on_the_left() {
    const Points points = random_points(2, 300, 9);
    const Call call("Qe", points);
    std::set<std::pair<int, int>> edges, sides;
    for (int c = 0; c < call.out.numberoftriangles; c++)
        for (int i = 0; i < 3; i++) sides.insert({call.triangle(c)[i], call.triangle(c)[(i + 1) % 3]});
    int hull = 0;
    for (int e = 0; e < call.out.numberofedges; e++) {
        const int start = call.out.edgelist[2 * e], end = call.out.edgelist[2 * e + 1];
        CHECK(edges.insert(std::minmax(start, end)).second && sides.count({start, end}) == 1);
        CHECK(call.out.edgemarkerlist[e] == (sides.count({end, start}) == 0));
        hull += call.out.edgemarkerlist[e];
    }
    CHECK(hull == call.out.numberofsegments && static_cast<std::size_t>(call.out.numberofedges) == edges.size());
}

void voronoi_vertices_are_circumcentres() {
    const Points points = random_points(2, 300, 10), attributes = random_points(1, 300, 11);
    const Call call("Qvez", points, 1, attributes.data());
    CHECK(call.vorout.numberofpoints == call.out.numberoftriangles && call.vorout.numberofpointattributes == 1);
    for (int c = 0; c < call.vorout.numberofpoints; c++) {
        const double *centre = call.vorout.pointlist + 2 * c;
        double distance[3], weight[3];
        for (int i = 0; i < 3; i++) {
            const double *corner = &points[2 * static_cast<std::size_t>(call.triangle(c)[i])];
            distance[i] = std::hypot(corner[0] - centre[0], corner[1] - centre[1]);
        }
        CHECK(std::abs(distance[0] - distance[1]) + std::abs(distance[0] - distance[2]) < 1e-9 * (1 + distance[0]));
        const double *p[3];
        for (int i = 0; i < 3; i++) p[i] = &points[2 * static_cast<std::size_t>(call.triangle(c)[i])];
        double expected = 0, size = 0;
        for (int i = 0; i < 3; i++) {
            weight[i] = cross(centre, p[(i + 1) % 3], p[(i + 2) % 3]) / cross(p[0], p[1], p[2]);
            expected += weight[i] * attributes[static_cast<std::size_t>(call.triangle(c)[i])];
            size += std::abs(weight[i]);
        }
        CHECK(std::abs(call.vorout.pointattributelist[c] - expected) < 1e-9 * size * size);
    }
    CHECK(call.vorout.pointmarkerlist == nullptr && call.vorout.edgemarkerlist == nullptr);
}

// Edge i of the Voronoi diagram is dual to edge i of the triangulation.
void voronoi_edges_are_dual() {
    const Points points = random_points(2, 300, 12);
    const Call call("Qven", points);
    CHECK(call.vorout.numberofedges == call.out.numberofedges);
    for (int e = 0; e < call.out.numberofedges; e++) {
        const int *ends = call.vorout.edgelist + 2 * e;
        const double *norm = call.vorout.normlist + 2 * e;
        const double *start = &points[2 * static_cast<std::size_t>(call.out.edgelist[2 * e] - 1)];
        const double *end = &points[2 * static_cast<std::size_t>(call.out.edgelist[2 * e + 1] - 1)];
        for (int side = 0; side < 2; side++) {
            if (ends[side] == -1) continue;
            int corners = 0;
            for (int i = 0; i < 3; i++)
                for (int k = 0; k < 2; k++)
                    corners += call.triangle(ends[side] - 1)[i] == call.out.edgelist[2 * e + k];
            CHECK(corners == 2);
        }
        CHECK((ends[1] == -1) == (call.out.edgemarkerlist[e] == 1));
        if (ends[1] != -1) {
            CHECK(norm[0] == 0 && norm[1] == 0);
            continue;
        }
        CHECK(norm[0] == end[1] - start[1] && norm[1] == start[0] - end[0]);
    }
}

// The segments of c are the edges of the hull, from the first point by x counter-clockwise, the end of each first.
void segments_enclose_the_hull() {
    for (const char *switches : {"Qczne", "Qpczne", "QpcAzne"}) {
        const Points points = lattice_points(2, 80, 9, 15);
        const Call call(switches, points), plain("Qzne", points);
        CHECK(call.cells(0) == plain.cells(0) && call.out.numberofsegments == plain.out.numberofsegments);
        CHECK(call.out.numberofholes == 0 && call.out.numberofregions == 0);
        const auto point = [&](int v) { return &points[2 * static_cast<std::size_t>(v)]; };
        const int n = call.out.numberofsegments, *segments = call.out.segmentlist;
        const double *first = point(segments[1]);
        for (std::size_t p = 0; p < points.size(); p += 2)
            CHECK(!std::lexicographical_compare(&points[p], &points[p] + 2, first, first + 2));
        std::set<std::pair<int, int>> hull, listed;
        for (int e = 0; e < call.out.numberofedges; e++)
            if (call.out.edgemarkerlist[e] == 1) hull.insert({call.out.edgelist[2 * e + 1], call.out.edgelist[2 * e]});
        for (int s = 0; s < n; s++) {
            CHECK(segments[2 * s] == segments[2 * ((s + 1) % n) + 1] && call.out.segmentmarkerlist[s] == 1);
            listed.insert({segments[2 * s], segments[2 * s + 1]});
        }
        CHECK(listed == hull && listed.size() == static_cast<std::size_t>(n));
    }
    const Points points = random_points(2, 30, 16);
    const Call unmarked("QcB", points), unlisted("QcP", points);
    CHECK(unmarked.out.segmentlist != nullptr && unmarked.out.segmentmarkerlist == nullptr);
    CHECK(unlisted.out.segmentlist == nullptr && unlisted.out.numberofsegments == unmarked.out.numberofsegments);
}

// Without segments nothing separates a triangle from the outside, so p leaves none, and j no point. Points on a line
// have no triangle to be taken away.
void graphs_without_segments_are_carved_away() {
    const Points points = random_points(2, 100, 17), line{0, 0, 1, 1, 2, 2, 3, 3, 3, 3};
    const std::vector<int> markers(100, 4);
    const Call call("Qzpnev", points, 0, nullptr, markers.data()), jettisoned("Qzpj", points), flat("Qzpj", line);
    CHECK(call.out.numberoftriangles == 0 && call.out.numberofsegments == 0 && call.out.numberofedges == 0);
    CHECK(call.out.numberofpoints == 100 && call.vorout.numberofpoints == 0 && call.out.segmentlist != nullptr);
    CHECK(std::equal(markers.begin(), markers.end(), call.out.pointmarkerlist));
    CHECK(jettisoned.out.numberofpoints == 0 && jettisoned.out.pointlist != nullptr);
    CHECK(flat.out.numberofpoints == 4);
}

// Of points at one place the first stays, and the numbers of those after the others close up.
void points_in_no_triangle_are_jettisoned() {
    Points unique = random_points(2, 60, 18), points = unique, attributes = random_points(1, 63, 19);
    points.insert(points.begin() + 40, points.begin() + 6, points.begin() + 12);
    std::vector<int> markers(63);
    for (int i = 0; i < 63; i++) markers[static_cast<std::size_t>(i)] = 100 + i;
    for (const int first : {0, 1}) {
        const Call call(first == 0 ? "Qjznec" : "Qjnec", points, 1, attributes.data(), markers.data());
        const Call plain(first == 0 ? "Qznec" : "Qnec", unique);
        CHECK(call.out.numberofpoints == 60 && call.cells(first) == fresh_cells(2, unique));
        CHECK(std::memcmp(call.out.pointlist, unique.data(), 120 * sizeof(double)) == 0);
        for (int i = 0; i < 60; i++) {
            const int from = i < 20 ? i : i + 3;
            CHECK(call.out.pointmarkerlist[i] == 100 + from);
            CHECK(call.out.pointattributelist[i] == attributes[static_cast<std::size_t>(from)]);
        }
        CHECK(call.out.numberofsegments == plain.out.numberofsegments);
        CHECK(std::equal(plain.out.segmentlist, plain.out.segmentlist + 2 * plain.out.numberofsegments,
                         call.out.segmentlist));
        const auto edges = [](const triangulateio &io) {
            std::set<std::pair<int, int>> set;
            for (const int *e = io.edgelist; e < io.edgelist + 2 * io.numberofedges; e += 2)
                set.insert(std::minmax(e[0], e[1]));
            return set;
        };
        CHECK(edges(call.out) == edges(plain.out));
    }
    const Call nothing_to_do("Qjz", unique);
    CHECK(nothing_to_do.out.numberofpoints == 60 && nothing_to_do.cells(0) == fresh_cells(2, unique));
    const Call flat("Qjz", {0, 0, 1, 1, 0, 0, 2, 2, 1, 1});
    CHECK(flat.out.numberofpoints == 3 && flat.out.pointlist[5] == 2);
}

// One structure may be input and output, with the arrays of the input.
void points_are_left_out_in_place() {
    Points unique = random_points(2, 40, 20), points = unique;
    points.insert(points.begin() + 20, points.begin(), points.begin() + 8);
    triangulateio io{};
    io.pointlist = points.data();
    io.numberofpoints = 44;
    char switches[] = "Qjz";
    CHECK(triangulate(switches, &io, &io, nullptr) == 0);
    CHECK(io.pointlist == points.data() && io.numberofpoints == 40);
    CHECK(std::equal(unique.begin(), unique.end(), points.begin()));
    CellSet cells;
    for (int c = 0; c < io.numberoftriangles; c++) insert_cell(cells, io.trianglelist + 3 * c, 3, 0);
    CHECK(cells == fresh_cells(2, unique));
    std::free(io.trianglelist);
    std::free(io.pointmarkerlist);
}

void given_arrays_are_filled() {
    const Points points = random_points(2, 50, 13);
    std::vector<int> room(3 * 100), neighbours(3 * 100);
    triangulateio in{}, out{};
    in.pointlist = const_cast<double *>(points.data());
    in.numberofpoints = 50;
    out.trianglelist = room.data();
    out.neighborlist = neighbours.data();
    char switches[] = "QznN";
    CHECK(triangulate(switches, &in, &out, nullptr) == 0);
    CHECK(out.trianglelist == room.data() && out.neighborlist == neighbours.data());
    CellSet cells;
    for (int c = 0; c < out.numberoftriangles; c++) insert_cell(cells, room.data() + 3 * c, 3, 0);
    CHECK(cells == fresh_cells(2, points));
}

void degenerate_input_has_no_triangles() {
    const Points line{0, 0, 1, 1, 2, 2, 3, 3, 4, 4}, place{1, 1, 1, 1, 1, 1};
    for (const Points &points : {line, place}) {
        const Call call("Qznev", points);
        CHECK(call.out.numberoftriangles == 0 && call.out.numberofedges == 0 && call.out.numberofsegments == 0);
        CHECK(static_cast<std::size_t>(call.out.numberofpoints) == points.size() / 2);
        CHECK(call.out.pointlist != nullptr && call.out.trianglelist != nullptr);
    }
}

// The centre of a triangle so flat that its area, 2^-61, is lost in doubles is far away, but a number.
void centres_of_flat_triangles_are_finite() {
    const Points points{0, 0, 1, 1 - 0x1p-30, 1 + 0x1p-30, 1};
    const Call call("Qzv", points);
    CHECK(call.out.numberoftriangles == 1);
    CHECK(std::hypot(call.vorout.pointlist[0], call.vorout.pointlist[1]) > 0x1p25);
    for (int i = 0; i < 2 * call.vorout.numberofpoints; i++) CHECK(std::isfinite(call.vorout.pointlist[i]));
}

void bad_input_gives_nothing() {
    const auto gives_nothing = [](const char *switches, triangulateio *in, bool with_vorout = true) {
        triangulateio out{}, vorout{};
        out.numberoftriangles = out.numberofedges = 7;
        std::string text(switches);
        const int returned = triangulate(text.data(), in, &out, with_vorout ? &vorout : nullptr);
        const bool nothing = out.numberoftriangles == 0 && out.numberofedges == 0 && out.trianglelist == nullptr;
        std::free(out.pointlist);
        std::free(out.pointmarkerlist);
        std::free(out.trianglelist);
        for (int *array : {out.segmentlist, out.segmentmarkerlist}) std::free(array);
        CHECK(returned == (nothing ? 1 : 0));
        return nothing;
    };
    Points points = random_points(2, 10, 14);
    triangulateio in{};
    in.pointlist = points.data();
    in.numberofpoints = 10;
    CHECK(!gives_nothing("Qz", &in));
    CHECK(gives_nothing("Qz", nullptr) && gives_nothing("Qzv", &in, false));
    for (const char *switches : {"Qzr", "Qzq34.5", "Qzo3", "Qzu", "Qzw", "QzpW", "Qzk", "Qza0", "Qzq30a0.0"})
        CHECK(gives_nothing(switches, &in));
    for (int triangulateio::*count : {&triangulateio::numberofsegments, &triangulateio::numberofholes,
                                      &triangulateio::numberofregions}) {
        in.*count = 1;
        CHECK(!gives_nothing("Qzc", &in) && gives_nothing("Qzp", &in) && gives_nothing("QzpcA", &in));
        in.*count = 0;
    }
    for (const int count : {0, 1, 2, -1}) {
        in.numberofpoints = count;
        CHECK(gives_nothing("Qz", &in));
    }
    in.numberofpoints = 10;
    in.numberofpointattributes = 1;
    CHECK(gives_nothing("Qz", &in));
    in.numberofpointattributes = 0;
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e60}) {
        const double good = points[7];
        points[7] = bad;
        CHECK(gives_nothing("Qz", &in));
        points[7] = good;
    }
    in.pointlist = nullptr;
    CHECK(gives_nothing("Qz", &in));
    CHECK(triangulate(nullptr, &in, &in, nullptr) == 1);
    char switches[] = "Qz";
    CHECK(triangulate(switches, &in, nullptr, nullptr) == 1);
}

} // namespace

int main() {
    cells_are_those_of_a_new_triangulation();
    cells_satisfy_the_definition();
    neighbours_are_opposite_corners();
    points_are_copied_with_attributes_and_markers();
    switches_leave_lists_out();
    edges_come_once_with_their_triangle_on_the_left();
    voronoi_vertices_are_circumcentres();
    voronoi_edges_are_dual();
    segments_enclose_the_hull();
    graphs_without_segments_are_carved_away();
    points_in_no_triangle_are_jettisoned();
    points_are_left_out_in_place();
    given_arrays_are_filled();
    degenerate_input_has_no_triangles();
    centres_of_flat_triangles_are_finite();
    bad_input_gives_nothing();
}
