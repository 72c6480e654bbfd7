// TetGen's convention in the layouts of tetgenio of 1.5.1 and 1.6, declared here: every list is that of a call in the
// layout of 1.5.0, which other tests compare with TetGen, and nothing else of the structure is written to.
//
// tetgen_layouts VERSION [MODULE]: VERSION is what the library can find out (1.5.1, 1.6, or neither), by the module,
// which stands in for that TetGen, or by DELDRIFT_COMPAT_TETGEN. Without a module there is no TetGen in the process.
#include <deldrift_tetgen.h>

#include <dlfcn.h>

#include <cstring>
#include <string>

#include "check.hpp"

namespace {

using Call = void (*)(char *, tetgenio *, tetgenio *);

struct Io151 {
    int firstnumber, mesh_dim, useindex;
    double *pointlist, *pointattributelist, *pointmtrlist;
    int *pointmarkerlist, *point2tetlist;
    void *pointparamlist;
    int numberofpoints, numberofpointattributes, numberofpointmtrs;
    int *tetrahedronlist;
    double *tetrahedronattributelist, *tetrahedronvolumelist;
    int *neighborlist, *tet2facelist, *tet2edgelist;
    int numberoftetrahedra, numberofcorners, numberoftetrahedronattributes;
    void *facetlist;
    int *facetmarkerlist, numberoffacets;
    double *holelist;
    int numberofholes;
    double *regionlist;
    int numberofregions;
    double *facetconstraintlist;
    int numberoffacetconstraints;
    double *segmentconstraintlist;
    int numberofsegmentconstraints;
    int *trifacelist, *trifacemarkerlist, *o2facelist, *face2tetlist, *face2edgelist;
    int numberoftrifaces;
    int *edgelist, *edgemarkerlist, *o2edgelist, *edge2tetlist;
    int numberofedges;
    double *vpointlist;
    tetgenio::voroedge *vedgelist;
    tetgenio::vorofacet *vfacetlist;
    int **vcelllist;
    int numberofvpoints, numberofvedges, numberofvfacets, numberofvcells;
    void *geomhandle, *callbacks[6];
};

struct Io16 {
    int firstnumber, mesh_dim, useindex;
    double *pointlist, *pointattributelist, *pointmtrlist;
    int *pointmarkerlist, *point2tetlist;
    void *pointparamlist;
    int numberofpoints, numberofpointattributes, numberofpointmtrs;
    int *tetrahedronlist;
    double *tetrahedronattributelist, *tetrahedronvolumelist;
    int *neighborlist, *tet2facelist, *tet2edgelist;
    int numberoftetrahedra, numberofcorners, numberoftetrahedronattributes;
    void *facetlist;
    int *facetmarkerlist, numberoffacets;
    double *holelist;
    int numberofholes;
    double *regionlist;
    int numberofregions;
    int *refine_elem_list;
    double *refine_elem_vol_list;
    int numberofrefineelems;
    double *facetconstraintlist;
    int numberoffacetconstraints;
    double *segmentconstraintlist;
    int numberofsegmentconstraints;
    int *trifacelist, *trifacemarkerlist, *o2facelist, *face2tetlist, *face2edgelist;
    int numberoftrifaces;
    int *edgelist, *edgemarkerlist, *o2edgelist, *edge2tetlist;
    int numberofedges;
    double *vpointlist;
    tetgenio::voroedge *vedgelist;
    tetgenio::vorofacet *vfacetlist;
    int **vcelllist;
    int numberofvpoints, numberofvedges, numberofvfacets, numberofvcells;
    void *geomhandle, *callbacks[6];
};

// A structure as its constructor leaves it, and what comes after it in memory.
template <class Io>
struct Guarded {
    Io io;
    unsigned char after[64];
    Guarded() {
        std::memset(static_cast<void *>(this), 0, sizeof *this);
        std::memset(after, 0x5a, sizeof after);
        io.mesh_dim = 3;
        io.useindex = 1;
        io.numberofcorners = 4;
    }
    tetgenio *pointer() { return reinterpret_cast<tetgenio *>(&io); }
};

struct Input {
    Points points = random_points(3, 150, 1), attributes = random_points(2, 150, 2);
    std::vector<int> markers = std::vector<int>(150, 3);
    Input() { std::copy(points.begin(), points.begin() + 6, points.begin() + 90); }

    template <class Io>
    void give_to(Io &io) {
        io.firstnumber = 1;
        io.pointlist = points.data();
        io.pointattributelist = attributes.data();
        io.pointmarkerlist = markers.data();
        io.numberofpoints = 150;
        io.numberofpointattributes = 2;
    }
};

// What is thrown, or 0.
int call(Call function, const char *switches, tetgenio *in, tetgenio *out) {
    std::string text(switches);
    try {
        function(text.data(), in, out);
    } catch (int code) {
        return code;
    }
    return 0;
}

void call_directly(char *switches, tetgenio *in, tetgenio *out) { tetrahedralize(switches, in, out); }

// The call in the layout of 1.5.0, which has its arrays.
struct Expected {
    tetgenio out;
    explicit Expected(const char *switches) {
        Input input;
        tetgenio in;
        input.give_to(in);
        CHECK(call(&call_directly, switches, &in, &out) == 0);
        in.pointlist = in.pointattributelist = nullptr;
        in.pointmarkerlist = nullptr;
    }
};

template <class T>
void check_list(const T *own, const T *other, int count) {
    CHECK((own == nullptr) == (other == nullptr));
    if (own != nullptr) CHECK(std::equal(own, own + count, other));
}

template <class Io>
void check_voronoi(const Io &own, const tetgenio &other) {
    CHECK(own.numberofvpoints == other.numberofvpoints && own.numberofvedges == other.numberofvedges);
    CHECK(own.numberofvfacets == other.numberofvfacets && own.numberofvcells == other.numberofvcells);
    check_list(own.vpointlist, other.vpointlist, 3 * own.numberofvpoints);
    for (int e = 0; e < own.numberofvedges; e++) {
        CHECK(own.vedgelist[e].v1 == other.vedgelist[e].v1 && own.vedgelist[e].v2 == other.vedgelist[e].v2);
        check_list(own.vedgelist[e].vnormal, other.vedgelist[e].vnormal, 3);
    }
    for (int f = 0; f < own.numberofvfacets; f++) {
        CHECK(own.vfacetlist[f].c1 == other.vfacetlist[f].c1 && own.vfacetlist[f].c2 == other.vfacetlist[f].c2);
        check_list(own.vfacetlist[f].elist, other.vfacetlist[f].elist, other.vfacetlist[f].elist[0] + 1);
    }
    for (int c = 0; c < own.numberofvcells; c++)
        check_list(own.vcelllist[c], other.vcelllist[c], other.vcelllist[c][0] + 1);
}

template <class Io>
void check_same(const Io &own, const tetgenio &other) {
    CHECK(own.firstnumber == other.firstnumber && own.mesh_dim == other.mesh_dim && own.numberofcorners == 4);
    CHECK(own.numberofpoints == other.numberofpoints && own.numberoftetrahedra == other.numberoftetrahedra);
    CHECK(own.numberofpointattributes == other.numberofpointattributes);
    CHECK(own.numberoftrifaces == other.numberoftrifaces && own.numberofedges == other.numberofedges);
    check_list(own.pointlist, other.pointlist, 3 * own.numberofpoints);
    check_list(own.pointattributelist, other.pointattributelist, 2 * own.numberofpoints);
    check_list(own.pointmarkerlist, other.pointmarkerlist, own.numberofpoints);
    check_list(own.tetrahedronlist, other.tetrahedronlist, 4 * own.numberoftetrahedra);
    check_list(own.neighborlist, other.neighborlist, 4 * own.numberoftetrahedra);
    check_list(own.trifacelist, other.trifacelist, 3 * own.numberoftrifaces);
    check_list(own.trifacemarkerlist, other.trifacemarkerlist, own.numberoftrifaces);
    check_list(own.edgelist, other.edgelist, 2 * own.numberofedges);
    check_list(own.edgemarkerlist, other.edgemarkerlist, own.numberofedges);
    CHECK((own.vpointlist == nullptr) == (other.vpointlist == nullptr));
    if (own.vpointlist != nullptr) check_voronoi(own, other);
}

// Deletes the output, as the destructor of TetGen's class does, and makes the members what they were.
template <class Io>
void take_back(Io &io) {
    for (double **list : {&io.pointlist, &io.pointattributelist, &io.vpointlist}) {
        delete[] *list;
        *list = nullptr;
    }
    for (int **list : {&io.pointmarkerlist, &io.tetrahedronlist, &io.neighborlist, &io.trifacelist,
                       &io.trifacemarkerlist, &io.edgelist, &io.edgemarkerlist}) {
        delete[] *list;
        *list = nullptr;
    }
    for (int f = 0; io.vfacetlist != nullptr && f < io.numberofvfacets; f++) delete[] io.vfacetlist[f].elist;
    for (int c = 0; io.vcelllist != nullptr && c < io.numberofvcells; c++) delete[] io.vcelllist[c];
    delete[] io.vedgelist;
    delete[] io.vfacetlist;
    delete[] io.vcelllist;
    io.vedgelist = nullptr;
    io.vfacetlist = nullptr;
    io.vcelllist = nullptr;
    for (int *number : {&io.firstnumber, &io.numberofpoints, &io.numberofpointattributes, &io.numberoftetrahedra,
                        &io.numberoftrifaces, &io.numberofedges, &io.numberofvpoints, &io.numberofvedges,
                        &io.numberofvfacets, &io.numberofvcells})
        *number = 0;
}

template <class Io>
void serves(Call function, const char *switches) {
    const Expected expected(switches);
    Input input;
    Guarded<Io> in, out;
    input.give_to(in.io);
    const Guarded<Io> before = out;
    CHECK(call(function, switches, in.pointer(), out.pointer()) == 0);
    check_same(out.io, expected.out);
    CHECK(out.io.tetrahedronlist != nullptr || std::strchr(switches, 'E') != nullptr);
    take_back(out.io);
    CHECK(std::memcmp(&before, &out, sizeof out) == 0);
}

template <class Io>
void refuses(Call function, const char *switches) {
    Input input;
    Guarded<Io> in, out;
    input.give_to(in.io);
    const Guarded<Io> before = out;
    CHECK(call(function, switches, in.pointer(), out.pointer()) == 10);
    CHECK(std::memcmp(&before, &out, sizeof out) == 0);
}

template <class Io>
void check_layout(Call function, bool is_known) {
    // Points and tetrahedra are at one place in both layouts.
    for (const char *switches : {"QF", "zQnFB", "QnJFe", "QFN", "QFE"}) serves<Io>(function, switches);
    for (const char *switches : {"Q", "Qznfev", "Qfe", "QzBNfe", "QFv", "QIe", "QJnfv"}) {
        if (is_known) serves<Io>(function, switches);
        else refuses<Io>(function, switches);
    }
}

// What is not served goes to the module's own function.
template <class Io>
void check_passed_on(Call function, const int *calls) {
    for (const char *switches : {"Qp", "Qq1.4", "Qnn"}) {
        Guarded<Io> in, out;
        const int before = *calls;
        CHECK(call(function, switches, in.pointer(), out.pointer()) == 0 && *calls == before + 1);
    }
}

} // namespace

int main(int count, char **arguments) {
    CHECK(count > 1);
    const bool is_1_6 = std::strcmp(arguments[1], "1.6") == 0, is_1_5_1 = std::strcmp(arguments[1], "1.5.1") == 0;
    Call function = &call_directly;
    const int *calls = nullptr;
    if (count > 2) {
        void *module = dlopen(arguments[2], RTLD_NOW | RTLD_LOCAL);
        CHECK(module != nullptr);
        function = reinterpret_cast<Call>(dlsym(module, "call_stand_in"));
        calls = static_cast<const int *>(dlsym(module, "stand_in_calls"));
        CHECK(function != nullptr && calls != nullptr);
    }
    if (!is_1_5_1) check_layout<Io16>(function, is_1_6);
    if (!is_1_6) check_layout<Io151>(function, is_1_5_1);
    if (calls == nullptr) return 0;
    CHECK(*calls == 0);
    if (is_1_6) check_passed_on<Io16>(function, calls);
    else check_passed_on<Io151>(function, calls);
}
