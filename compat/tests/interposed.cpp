// This library before an original: who serves which call. The original is in a module that is loaded for itself alone,
// as interpreters load their extensions (argument: the module), or linked after this library (no argument). A second
// argument says that refinement is left to the original.
#include <deldrift_tetgen.h>
#include <deldrift_triangle.h>

#include <dlfcn.h>

#include <cstring>
#include <string>

#include "check.hpp"

extern "C" int triangulate_of_cxx(char *, triangulateio *, triangulateio *, triangulateio *)
    __asm__("_Z11triangulatePcP13triangulateioS1_S1_");

namespace {

using Triangulate = int (*)(char *, triangulateio *, triangulateio *, triangulateio *);
using Tetrahedralize = void (*)(char *, tetgenio *, tetgenio *);

void call_directly(char *switches, tetgenio *in, tetgenio *out) { tetrahedralize(switches, in, out); }

struct Original {
    int *calls, *cxx_calls, *is_wrong, *returns, *copies_lists;
    Triangulate call_triangulate, call_triangulate_of_cxx;
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
    const auto number = [&symbol](const char *name) { return static_cast<int *>(symbol(name)); };
    Original original{number("original_calls"), number("original_cxx_calls"), number("original_is_wrong"),
                      number("original_returns"), number("original_copies_lists"), &triangulate, &triangulate_of_cxx, &call_directly};
    if (module == nullptr) return original;
    original.call_triangulate = reinterpret_cast<Triangulate>(symbol("call_triangulate"));
    original.call_triangulate_of_cxx = reinterpret_cast<Triangulate>(symbol("call_triangulate_of_cxx"));
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

// Each of the two names is served, and passed on to the original of that name.
void check_name_of_cxx(const Original &original, const Points &points) {
    triangulateio in{}, out{};
    in.pointlist = const_cast<double *>(points.data());
    in.numberofpoints = static_cast<int>(points.size() / 2);
    char unserved[] = "Qzu", plain[] = "Qz";
    const int before = *original.cxx_calls;
    *original.returns = 5;
    CHECK(original.call_triangulate_of_cxx(unserved, &in, &out, nullptr) == 5 && *original.cxx_calls == before + 1);
    original.call_triangulate(unserved, &in, &out, nullptr);
    CHECK(*original.cxx_calls == before + 1);
    for (int *array : {out.trianglelist, out.neighborlist}) std::free(array);
    triangulateio result{};
    CHECK(original.call_triangulate_of_cxx(plain, &in, &result, nullptr) == 0 && *original.cxx_calls == before + 1);
    CellSet cells;
    for (int c = 0; c < result.numberoftriangles; c++) insert_cell(cells, result.trianglelist + 3 * c, 3, 0);
    CHECK(cells == fresh_cells(2, points));
    for (int *array : {result.trianglelist, result.pointmarkerlist}) std::free(array);
    std::free(result.pointlist);
}

// With p the lists of the input are served, but for s with segments.
void check_lists_of_graph(const Original &original, const Points &points) {
    std::vector<int> segment{0, 1};
    std::vector<double> place{0.5, 0.5, 0, 0};
    triangulateio in{};
    in.pointlist = const_cast<double *>(points.data());
    in.numberofpoints = static_cast<int>(points.size() / 2);
    in.segmentlist = segment.data();
    in.holelist = in.regionlist = place.data();
    for (const auto count : {&triangulateio::numberofsegments, &triangulateio::numberofholes,
                             &triangulateio::numberofregions}) {
        for (const int n : {0, 1}) {
            in.*count = n;
            for (const char *switches : {"QpczNB", "QpczNBA", "QpsczNB"}) {
                const int before = *original.calls;
                std::string text(switches);
                triangulateio out{};
                original.call_triangulate(text.data(), &in, &out, nullptr);
                // What is served asks the original who frees the lists: one call as well.
                CHECK(*original.calls == before + 1);
                const bool is_passed_on = in.numberofsegments == 1 && text.find('s') != std::string::npos;
                CHECK((out.neighborlist != nullptr) == is_passed_on);
                for (int *array : {out.trianglelist, out.neighborlist, out.segmentlist}) std::free(array);
                std::free(out.triangleattributelist);
            }
        }
        in.*count = 0;
    }
}

// Lists of holes and regions in the output are whose the program takes them for: one that was made for Triangle 1.6 frees
// those of the input alone, one for a Triangle that copies them frees both. As the program is never told, each has what its
// own Triangle would have given it.
void check_who_frees_lists(const Original &original) {
    // A square in a square.
    Points points{0, 0, 4, 0, 4, 4, 0, 4, 1, 1, 3, 1, 3, 3, 1, 3};
    std::vector<int> segments{0, 1, 1, 2, 2, 3, 3, 0, 4, 5, 5, 6, 6, 7, 7, 4};
    for (const int copies : {0, 1, 0}) {
        *original.copies_lists = copies;
        for (const char *switches : {"Qzp", "Qzpq", "QzpA", "Qzpc", "Qzpj"}) {
            for (const int counts : {0, 1, 2, 3}) {
                triangulateio in{}, out{};
                in.pointlist = points.data();
                in.numberofpoints = in.numberofsegments = 8;
                in.segmentlist = segments.data();
                in.numberofholes = counts & 1;
                in.numberofregions = counts >> 1;
                // Of callers that have lists without entries, too.
                in.holelist = static_cast<double *>(std::malloc(2 * sizeof(double)));
                in.regionlist = static_cast<double *>(std::malloc(4 * sizeof(double)));
                const double hole[] = {2, 2}, region[] = {0.5, 0.5, 7, 0.25};
                std::copy_n(hole, 2, in.holelist);
                std::copy_n(region, 4, in.regionlist);
                std::string text(switches);
                CHECK(original.call_triangulate(text.data(), &in, &out, nullptr) == 0);
                CHECK(out.numberofholes == in.numberofholes && out.numberofregions == in.numberofregions);
                CHECK((out.holelist != in.holelist) == (copies == 1));
                CHECK((out.regionlist != in.regionlist) == (copies == 1));
                CHECK(std::equal(hole, hole + 2 * out.numberofholes, out.holelist));
                CHECK(std::equal(region, region + 4 * out.numberofregions, out.regionlist));
                for (double *list : {out.pointlist, out.pointattributelist, out.triangleattributelist}) std::free(list);
                for (int *list : {out.trianglelist, out.segmentlist, out.segmentmarkerlist, out.pointmarkerlist})
                    std::free(list);
                if (copies == 1) {
                    std::free(out.holelist);
                    std::free(out.regionlist);
                }
                std::free(in.holelist);
                std::free(in.regionlist);
            }
        }
    }
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
    CHECK(reaches_original(original, "Qzu", points, cells) && cells == expected);
    CHECK(reaches_original(original, "Qzq35", points, cells) && cells == expected);
    // Refined cells are not compared.
    const bool is_left = !is_default || count > 2;
    CHECK(reaches_original(original, "Qzq", points, cells) == is_left && (cells == expected) == is_left);
    *original.is_wrong = 1;
    reaches_original(original, "Qzn", points, cells);
    CHECK((cells == expected) == is_default);
    if (is_default) {
        check_name_of_cxx(original, points);
        check_lists_of_graph(original, points);
        *original.is_wrong = *original.returns = 0;
        check_who_frees_lists(original);
    }

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
