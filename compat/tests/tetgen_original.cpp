// TetGen's convention beside TetGen itself: every list, for points without ties, in which TetGen and deldrift have the
// same tetrahedra. Both orders are free, so everything is compared by the points that it is made of.
#include <tetgen.h>

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string>

#include "check.hpp"

namespace {

using Function = void (*)(char *, tetgenio *, tetgenio *, tetgenio *, tetgenio *);
using Key = std::vector<int>;

Key sorted(Key key) {
    std::sort(key.begin(), key.end());
    return key;
}

// The same for a sequence from wherever it begins.
Key rotated(Key key) {
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
    return key;
}

// One output, by the points of things.
struct Result {
    std::map<Key, Key> orientation;                    // of a tetrahedron: 0 or 1
    std::map<Key, std::map<int, Key>> neighbours;      // of a tetrahedron, by the point opposite
    std::map<Key, Key> faces;                          // markers; faces of the hull with their orientation
    std::map<Key, int> edges;                          // markers
    std::map<Key, std::vector<double>> centres;        // of tetrahedra
    std::map<Key, std::set<Key>> voronoi_edges;        // the tetrahedra of a face
    std::map<Key, std::vector<double>> rays;           // of faces
    std::map<Key, std::vector<Key>> voronoi_facets;    // the faces of an edge, in one of the two directions
    std::map<int, std::pair<std::set<Key>, bool>> voronoi_cells; // the edges of a point; whether it is unbounded
};

class Reader {
public:
    Reader(const tetgenio &io, int first, bool has_all_faces)
        : io_(io), first_(first), has_all_faces_(has_all_faces) {}

    Result read() {
        Result result;
        for (int t = 0; t < io_.numberoftetrahedra && io_.tetrahedronlist != nullptr; t++) read_tetrahedron(t, result);
        read_faces(result);
        for (int e = 0; e < io_.numberofedges; e++)
            result.edges[edge(e)] = io_.edgemarkerlist != nullptr ? io_.edgemarkerlist[e] : -9;
        if (io_.vpointlist != nullptr) read_voronoi(result);
        return result;
    }

private:
    Key tetrahedron(int t) const {
        if (t == -1) return {};
        const int *corners = io_.tetrahedronlist + 4 * (t - first_);
        return sorted({corners, corners + 4});
    }
    Key face(int f) const { return sorted({io_.trifacelist + 3 * f, io_.trifacelist + 3 * f + 3}); }
    Key edge(int e) const { return sorted({io_.edgelist + 2 * e, io_.edgelist + 2 * e + 2}); }

    void read_tetrahedron(int t, Result &result) const {
        const int *corners = io_.tetrahedronlist + 4 * t;
        int inversions = 0;
        for (int i = 0; i < 4; i++)
            for (int j = i + 1; j < 4; j++) inversions += corners[i] > corners[j];
        const Key key = tetrahedron(t + first_);
        CHECK(result.orientation.insert({key, {inversions % 2}}).second);
        for (int i = 0; i < 4 && io_.neighborlist != nullptr; i++)
            result.neighbours[key][corners[i]] = tetrahedron(io_.neighborlist[4 * t + i]);
        if (io_.vpointlist != nullptr)
            result.centres[key] = {io_.vpointlist + 3 * t, io_.vpointlist + 3 * t + 3};
    }

    void read_faces(Result &result) const {
        for (int f = 0; f < io_.numberoftrifaces; f++) {
            const int marker = io_.trifacemarkerlist != nullptr ? io_.trifacemarkerlist[f] : -9;
            Key value{marker};
            if (marker == 1 || !has_all_faces_) {
                const Key way = rotated({io_.trifacelist + 3 * f, io_.trifacelist + 3 * f + 3});
                value.insert(value.end(), way.begin(), way.end());
            }
            CHECK(result.faces.insert({face(f), value}).second);
        }
    }

    // Voronoi edge i is dual to face i, if all faces are listed, and Voronoi facet i to edge i.
    void read_voronoi(Result &result) const {
        CHECK(io_.numberofvedges == io_.numberoftrifaces && io_.numberofvfacets == io_.numberofedges);
        for (int f = 0; f < io_.numberofvedges; f++) {
            const tetgenio::voroedge &dual = io_.vedgelist[f];
            CHECK(dual.v1 != -1 && (dual.v2 == -1 || dual.v1 < dual.v2));
            result.voronoi_edges[face(f)] = {tetrahedron(dual.v1), tetrahedron(dual.v2)};
            result.rays[face(f)] = {dual.vnormal, dual.vnormal + 3};
        }
        for (int e = 0; e < io_.numberofvfacets; e++) {
            const tetgenio::vorofacet &dual = io_.vfacetlist[e];
            CHECK(sorted({dual.c1, dual.c2}) == edge(e));
            std::vector<Key> ring;
            for (int k = 1; k <= dual.elist[0]; k++)
                ring.push_back(dual.elist[k] == -1 ? Key{} : face(dual.elist[k] - first_));
            result.voronoi_facets[edge(e)] = one_way(ring);
        }
        const std::set<int> corners(io_.tetrahedronlist, io_.tetrahedronlist + 4 * io_.numberoftetrahedra);
        for (int c = 0; c < io_.numberofvcells; c++) {
            if (corners.count(c + first_) == 0) continue;
            auto &[edges, is_unbounded] = result.voronoi_cells[c + first_];
            const int *list = io_.vcelllist[c];
            for (int k = 1; k <= list[0]; k++) {
                if (list[k] == -1) CHECK(k == list[0]);
                if (list[k] == -1) is_unbounded = true;
                else CHECK(edges.insert(edge(list[k] - first_)).second);
            }
        }
    }

    // Of a ring the lowest face first, then its lower neighbour; of a row that ends in -1 the lower end first.
    static std::vector<Key> one_way(std::vector<Key> ring) {
        if (ring.back().empty()) {
            if (ring.front() > ring[ring.size() - 2]) std::reverse(ring.begin(), ring.end() - 1);
            return ring;
        }
        std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
        if (ring[1] > ring.back()) std::reverse(ring.begin() + 1, ring.end());
        return ring;
    }

    const tetgenio &io_;
    int first_;
    bool has_all_faces_;
};

bool are_close(const std::map<Key, std::vector<double>> &a, const std::map<Key, std::vector<double>> &b) {
    if (a.size() != b.size()) return false;
    for (const auto &[key, x] : a) {
        const auto found = b.find(key);
        if (found == b.end()) return false;
        for (std::size_t axis = 0; axis < 3; axis++)
            if (!(std::abs(x[axis] - found->second[axis]) <= 1e-6 * (1 + std::abs(x[axis])))) return false;
    }
    return true;
}

template <class T>
bool are_same(const T *a, const T *b, int count) {
    if (a == nullptr || b == nullptr) return a == b;
    return std::equal(a, a + count, b);
}

// TetGen computes weights again from the heights that it has made of them.
bool have_same_weights(const tetgenio &own, const tetgenio &other) {
    const int n = own.numberofpointattributes;
    for (int i = 0; i < n * own.numberofpoints; i++) {
        const double a = own.pointattributelist[i], b = other.pointattributelist[i];
        if (!(i % n == 0 ? std::abs(a - b) < 1e-14 : a == b)) return false;
    }
    return true;
}

void check_same(const tetgenio &own, const tetgenio &other, int first, bool has_all_faces, bool weighted) {
    CHECK(own.firstnumber == other.firstnumber && own.mesh_dim == other.mesh_dim);
    CHECK(own.numberofpoints == other.numberofpoints && own.numberofcorners == other.numberofcorners);
    CHECK(own.numberofpointattributes == other.numberofpointattributes);
    CHECK(are_same(own.pointlist, other.pointlist, 3 * own.numberofpoints));
    CHECK(are_same(own.pointmarkerlist, other.pointmarkerlist, own.numberofpoints));
    CHECK(weighted ? have_same_weights(own, other)
                   : are_same(own.pointattributelist, other.pointattributelist,
                              own.numberofpoints * own.numberofpointattributes));
    CHECK((own.tetrahedronlist == nullptr) == (other.tetrahedronlist == nullptr));
    CHECK((own.neighborlist == nullptr) == (other.neighborlist == nullptr));
    CHECK((own.trifacelist == nullptr) == (other.trifacelist == nullptr));
    CHECK((own.trifacemarkerlist == nullptr) == (other.trifacemarkerlist == nullptr));
    CHECK((own.edgelist == nullptr) == (other.edgelist == nullptr));
    CHECK((own.edgemarkerlist == nullptr) == (other.edgemarkerlist == nullptr));
    CHECK((own.vcelllist == nullptr) == (other.vcelllist == nullptr));
    CHECK(own.numberoftetrahedra == other.numberoftetrahedra && own.numberofedges == other.numberofedges);
    CHECK(own.numberoftrifaces == other.numberoftrifaces && own.numberofvpoints == other.numberofvpoints);
    CHECK(own.numberofvedges == other.numberofvedges && own.numberofvfacets == other.numberofvfacets);
    CHECK(own.numberofvcells == other.numberofvcells);
    const Result a = Reader(own, first, has_all_faces).read(), b = Reader(other, first, has_all_faces).read();
    CHECK(a.orientation == b.orientation && a.neighbours == b.neighbours);
    CHECK(a.faces == b.faces && a.edges == b.edges);
    CHECK(are_close(a.centres, b.centres) && are_close(a.rays, b.rays));
    CHECK(a.voronoi_edges == b.voronoi_edges && a.voronoi_facets == b.voronoi_facets);
    CHECK(a.voronoi_cells == b.voronoi_cells);
}

// TetGen 1.5.0 leaves the lists of points that their weights hide as the memory was, so that nothing may free them.
void leave_unset_lists(tetgenio &io, int first) {
    if (io.vcelllist == nullptr) return;
    const std::set<int> corners(io.tetrahedronlist, io.tetrahedronlist + 4 * io.numberoftetrahedra);
    for (int c = 0; c < io.numberofvcells; c++)
        if (corners.count(c + first) == 0) io.vcelllist[c] = nullptr;
}

bool has_all_by_original() {
    const char *mode = std::getenv("DELDRIFT_COMPAT");
    return mode != nullptr && std::strcmp(mode, "original") == 0;
}

// The weights, if they are some, are up to the greatest.
void call_both(Function original, const char *switches, int firstnumber, int n_attributes = 2, double greatest = 1) {
    constexpr int n = 120;
    Points points = random_points(3, n, 1), attributes = random_points(2, n, 2);
    for (double &x : attributes) x *= greatest;
    std::vector<int> markers(n);
    for (int i = 0; i < n; i++) markers[static_cast<std::size_t>(i)] = i % 7;
    tetgenio in, own, other;
    in.firstnumber = firstnumber;
    in.pointlist = points.data();
    in.numberofpoints = n;
    in.pointmarkerlist = markers.data();
    in.pointattributelist = attributes.data();
    in.numberofpointattributes = n_attributes;
    std::string text(switches);
    tetrahedralize(text.data(), &in, &own);
    original(text.data(), &in, &other, nullptr, nullptr);
    in.initialize();
    const auto has = [switches](char which) { return std::strchr(switches, which) != nullptr; };
    const int first = has('z') ? 0 : firstnumber;
    leave_unset_lists(other, first);
    if (has_all_by_original()) leave_unset_lists(own, first);
    check_same(own, other, first, has('f'), has('w'));
}

// The places of the corners of each tetrahedron.
std::set<std::set<std::array<double, 3>>> places_of(const tetgenio &io) {
    std::set<std::set<std::array<double, 3>>> tetrahedra;
    for (int t = 0; t < io.numberoftetrahedra; t++) {
        std::set<std::array<double, 3>> corners;
        for (int i = 0; i < 4; i++) {
            const double *p = io.pointlist + 3 * io.tetrahedronlist[4 * t + i];
            corners.insert({p[0], p[1], p[2]});
        }
        tetrahedra.insert(corners);
    }
    return tetrahedra;
}

// Where points share a place all but one are left out; which one stays is not the same.
void coincident_points(Function original) {
    Points points = random_points(3, 60, 3);
    std::copy(points.begin() + 60, points.begin() + 120, points.begin());
    for (const char *switches : {"Qz", "QzJ"}) {
        tetgenio in, own, other;
        in.pointlist = points.data();
        in.numberofpoints = 60;
        std::string text(switches);
        tetrahedralize(text.data(), &in, &own);
        original(text.data(), &in, &other, nullptr, nullptr);
        in.initialize();
        CHECK(own.numberofpoints == other.numberofpoints);
        CHECK(places_of(own) == places_of(other));
    }
}

// Not TetGen 1.6.0, which has lost the switch v, and makes tetrahedra with w in whose power spheres there are points.
bool makes_voronoi_diagrams(Function original) {
    Points points = random_points(3, 4, 4);
    tetgenio in, out;
    in.pointlist = points.data();
    in.numberofpoints = 4;
    char switches[] = "Qv";
    original(switches, &in, &out, nullptr, nullptr);
    in.initialize();
    return out.vpointlist != nullptr;
}

} // namespace

// What the library reads of a tetgenbehavior of 1.5.0 by its place, set by name: the tetrahedra are those of the switches.
void by_behavior() {
    if (sizeof(tetgenio) != 392) return;
    Points points = random_points(3, 60, 9);
    const auto call = [&points](tetgenbehavior *b, char *switches) {
        tetgenio in, out;
        in.pointlist = points.data();
        in.numberofpoints = 60;
        if (b != nullptr) tetrahedralize(b, &in, &out);
        else tetrahedralize(switches, &in, &out);
        in.pointlist = nullptr;
        if (has_all_by_original()) leave_unset_lists(out, 0);
        CHECK(out.numberoftetrahedra > 0 && out.neighborlist != nullptr && out.pointmarkerlist == nullptr);
        CHECK((out.vpointlist != nullptr) == (b == nullptr || b->voroout == 1));
        CHECK(out.edgelist != nullptr && out.trifacelist != nullptr);
        const std::set<std::set<std::array<double, 3>>> places = places_of(out);
        CHECK(*std::min_element(out.tetrahedronlist, out.tetrahedronlist + 4 * out.numberoftetrahedra) == 0);
        return places;
    };
    tetgenbehavior b, of_weights, of_heights;
    b.zeroindex = b.neighout = b.facesout = b.edgesout = b.voroout = b.nobound = b.quiet = 1;
    char switches[] = "znfevBQ";
    CHECK(call(&b, nullptr) == call(nullptr, switches));
    of_weights = b;
    of_weights.weighted = 1;
    char weighted[] = "znfevBQw";
    CHECK(call(&of_weights, nullptr) == call(nullptr, weighted));
    CHECK(call(&of_weights, nullptr) != call(&b, nullptr));
    // TetGen's own answer.
    of_heights = of_weights;
    of_heights.weighted_param = 1;
    of_heights.voroout = 0;
    CHECK(call(&of_heights, nullptr) != call(&of_weights, nullptr));
}

int main() {
    void *handle = dlopen(TETGEN, RTLD_LAZY | RTLD_LOCAL);
    CHECK(handle != nullptr);
    const auto original = reinterpret_cast<Function>(dlsym(handle, "_Z14tetrahedralizePcP8tetgenioS1_S1_S1_"));
    CHECK(original != nullptr && original != static_cast<Function>(&tetrahedralize));
    const bool has_voronoi = makes_voronoi_diagrams(original);
    // Not z with numbers from 1 in the input: TetGen 1.5.0 puts the markers of faces one place off then. Nor E with n,
    // f or v: it reads numbers of tetrahedra that it has not set.
    for (const char *switches : {"Qznfev", "Qz", "Qze", "Qzn", "nJQF", "Qfe", "Qnfev", "QzB", "QBnfe", "QzN", "QzE",
                                 "QFen", "QzJX", "QNnf", "Qzee", "QzI", "QInfev"})
        for (const int firstnumber : {0, 1})
            if ((firstnumber == 0 || std::strchr(switches, 'z') == nullptr) &&
                (has_voronoi || std::strchr(switches, 'v') == nullptr))
                call_both(original, switches, firstnumber);
    // With few points hidden, with most of them, and with the weights that TetGen gives to points without attributes.
    for (const char *switches : {"Qznfevw", "Qzw", "Qzwe", "wnJQF", "Qfew0", "QzBw", "QzNw", "QzEw", "QzwJfe"})
        for (const double greatest : {1e-3, 0.02, 0.3})
            for (const int n_attributes : {0, 1, 2})
                if (has_voronoi) call_both(original, switches, 0, n_attributes, greatest);
    coincident_points(original);
    by_behavior();
}
