// This library before an original: who serves which call. The original is in a module that is loaded for itself alone,
// as interpreters load their extensions (argument: the module), or linked after this library (no argument).
#include <deldrift_tetgen.h>
#include <deldrift_triangle.h>

#include <dlfcn.h>

#include <cstring>
#include <string>

#include "check.hpp"

namespace {

using Triangulate = int (*)(char *, triangulateio *, triangulateio *, triangulateio *);
using Tetrahedralize = void (*)(char *, tetgenio *, tetgenio *);

void call_directly(char *switches, tetgenio *in, tetgenio *out) { tetrahedralize(switches, in, out); }

struct Original {
    int *calls, *is_wrong, *returns;
    Triangulate call_triangulate;
    Tetrahedralize call_tetrahedralize;
};

Original find(const char *module) {
    void *handle = module != nullptr ? dlopen(module, RTLD_NOW | RTLD_LOCAL) : dlopen(nullptr, RTLD_NOW);
    CHECK(handle != nullptr);
    const auto symbol = [handle](const char *name) {
        void *found = dlsym(handle, name);
        CHECK(found != nullptr);
        return found;
    };
    Original original{static_cast<int *>(symbol("original_calls")), static_cast<int *>(symbol("original_is_wrong")),
                      static_cast<int *>(symbol("original_returns")), &triangulate, &call_directly};
    if (module == nullptr) return original;
    original.call_triangulate = reinterpret_cast<Triangulate>(symbol("call_triangulate"));
    original.call_tetrahedralize = reinterpret_cast<Tetrahedralize>(symbol("call_tetrahedralize"));
    return original;
}

// Calls with the points; whether the original was called, and the cells. What the call returns is the original's in a
// program that has one and asks for it, so that a failure of it is seen, and 0 from deldrift.
bool reaches_original(const Original &original, const char *switches, const Points &points, CellSet &cells) {
    const int before = *original.calls;
    triangulateio in{}, out{};
    in.pointlist = const_cast<double *>(points.data());
    in.numberofpoints = static_cast<int>(points.size() / 2);
    std::string text(switches);
    *original.returns = 7;
    const int returned = original.call_triangulate(text.data(), &in, &out, nullptr);
    CHECK(returned == (*original.calls == before ? 0 : 7));
    cells.clear();
    for (int c = 0; c < out.numberoftriangles; c++) insert_cell(cells, out.trianglelist + 3 * c, 3, 0);
    std::free(out.trianglelist);
    std::free(out.neighborlist);
    std::free(out.pointlist);
    std::free(out.pointmarkerlist);
    return *original.calls != before;
}

} // namespace

int main(int count, char **arguments) {
    const Original original = find(count > 1 ? arguments[1] : nullptr);
    const char *mode = std::getenv("DELDRIFT_COMPAT");
    const bool is_default = mode == nullptr || std::strcmp(mode, "deldrift") == 0;
    const Points points = random_points(2, 200, 1);
    const CellSet expected = fresh_cells(2, points);
    CellSet cells;
    // Own calls come from the original only where it was asked for; others always go to it.
    CHECK(reaches_original(original, "Qzn", points, cells) == !is_default && cells == expected);
    CHECK(reaches_original(original, "Qzp", points, cells) && cells == expected);
    *original.is_wrong = 1;
    reaches_original(original, "Qzn", points, cells);
    CHECK((cells == expected) == is_default);

    Points space = random_points(3, 50, 2);
    for (const char *switches : {"Qz", "Qzp", "Qzq1.4"}) {
        const int before = *original.calls;
        tetgenio in, out;
        in.pointlist = space.data();
        in.numberofpoints = 50;
        std::string text(switches);
        original.call_tetrahedralize(text.data(), &in, &out);
        in.pointlist = nullptr;
        const bool served = std::strcmp(switches, "Qz") == 0 && is_default;
        CHECK((*original.calls == before) == served && (out.numberoftetrahedra > 0) == served);
    }
}
