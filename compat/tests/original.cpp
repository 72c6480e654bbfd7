// A stand-in for programs that bring Triangle and TetGen along: functions of these names, and calls of them. Its
// triangulations are deldrift's, but for one flipped edge where that is asked for.
#include <deldrift_tetgen.h>
#include <deldrift_triangle.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include <deldrift.h>

extern "C" {
int original_calls = 0;
int original_cxx_calls = 0; // of them, those by the name that Triangle has where it is compiled as C++
int original_is_wrong = 0;
int original_returns = 0;
int original_copies_lists = 0; // those of holes and regions, as cytriangle's Triangle does; Triangle 1.6 gives the input's
}

template <class To, class From>
static To *copy_of(const From *numbers, std::size_t count) {
    static_assert(sizeof(To) == sizeof(From));
    To *copy = static_cast<To *>(std::malloc(count * sizeof(To)));
    if (count > 0) std::memcpy(copy, numbers, count * sizeof(To));
    return copy;
}

static void give_lists(const triangulateio &in, triangulateio &out) {
    out.numberofholes = in.numberofholes;
    out.numberofregions = in.numberofregions;
    out.holelist = in.holelist;
    out.regionlist = in.regionlist;
    if (original_copies_lists == 0) return;
    out.holelist = copy_of<double>(in.holelist, std::size_t{2} * static_cast<std::size_t>(in.numberofholes));
    out.regionlist = copy_of<double>(in.regionlist, std::size_t{4} * static_cast<std::size_t>(in.numberofregions));
}

// The diagonal of triangle 0 and a neighbour, exchanged.
static void flip_an_edge(int *triangles, const int *neighbours) {
    int side = 0;
    while (neighbours[side] == -1) side++;
    int *first = triangles, *second = triangles + 3 * neighbours[side];
    const int a = first[side], b = first[(side + 1) % 3], c = first[(side + 2) % 3];
    int d = second[0];
    for (int i = 0; i < 3; i++)
        if (second[i] != b && second[i] != c) d = second[i];
    const int flipped[2][3] = {{a, b, d}, {a, d, c}};
    std::memcpy(first, flipped[0], sizeof flipped[0]);
    std::memcpy(second, flipped[1], sizeof flipped[1]);
}

extern "C" int triangulate(char *switches, triangulateio *in, triangulateio *out, triangulateio *) {
    original_calls++;
    deldrift_triangulation *t = nullptr;
    deldrift_cells_view view{};
    deldrift_create(2, in->pointlist, static_cast<std::size_t>(in->numberofpoints), nullptr, &t);
    deldrift_cells(t, &view);
    out->trianglelist = copy_of<int>(view.vertices, 3 * view.count);
    out->neighborlist = copy_of<int>(view.neighbours, 3 * view.count);
    out->numberoftriangles = static_cast<int>(view.count);
    deldrift_destroy(t);
    if (std::strchr(switches, 'p') != nullptr) give_lists(*in, *out);
    if (original_is_wrong != 0) flip_an_edge(out->trianglelist, out->neighborlist);
    return original_returns;
}

extern "C" int triangulate_of_cxx(char *, triangulateio *, triangulateio *, triangulateio *)
    __asm__("_Z11triangulatePcP13triangulateioS1_S1_");
extern "C" int triangulate_of_cxx(char *, triangulateio *, triangulateio *, triangulateio *) {
    original_calls++;
    original_cxx_calls++;
    return original_returns;
}

void tetrahedralize(char *, tetgenio *, tetgenio *out, tetgenio *, tetgenio *) {
    original_calls++;
    out->numberoftetrahedra = 0;
}

// The call returns here, so that its origin can be told; the next one need not.
extern "C" int call_triangulate(char *switches, triangulateio *in, triangulateio *out, triangulateio *vorout) {
    volatile int returned = triangulate(switches, in, out, vorout);
    return returned;
}

extern "C" int call_triangulate_of_cxx(char *switches, triangulateio *in, triangulateio *out, triangulateio *vorout) {
    volatile int returned = triangulate_of_cxx(switches, in, out, vorout);
    return returned;
}

extern "C" void call_tetrahedralize(char *switches, tetgenio *in, tetgenio *out) {
    tetrahedralize(switches, in, out, nullptr, nullptr);
}
