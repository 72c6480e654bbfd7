// Triangle's entry point: decides who serves a call, and serves.
#include <deldrift_triangle.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "cells.hpp"
#include "kept.hpp"
#include "original.hpp"
#include "representatives.hpp"
#include "settings.hpp"
#include "triangle_switches.hpp"
#include "triangle_writer.hpp"

static_assert(sizeof(triangulateio) == 168, "the layout of Triangle 1.6");
static_assert(offsetof(triangulateio, numberofpoints) == 24 && offsetof(triangulateio, trianglelist) == 32);
static_assert(offsetof(triangulateio, neighborlist) == 56 && offsetof(triangulateio, numberofcorners) == 68);
static_assert(offsetof(triangulateio, segmentlist) == 80 && offsetof(triangulateio, holelist) == 104);
static_assert(offsetof(triangulateio, edgelist) == 136 && offsetof(triangulateio, numberofedges) == 160);

namespace compat {

namespace {

constexpr char name[] = "triangulate";
// Where the original returns nothing, its caller expects nothing, so what it leaves may be handed on.
using Function = int (*)(char *, triangulateio *, triangulateio *, triangulateio *);
Tally tally(name);

constexpr int done = 0, failed = 1;
constexpr std::uint32_t no_point = UINT32_MAX;

struct Call {
    const char *symbol; // that the function was called by
    char *switches;
    triangulateio *in, *out, *vorout;
};

// A result without triangles, for callers that take no notice of what is returned.
int give_nothing(const Call &call) {
    for (triangulateio *each : {call.out, call.vorout}) {
        if (each == nullptr) continue;
        each->numberofpoints = each->numberofpointattributes = each->numberoftriangles = 0;
        each->numberofsegments = each->numberofedges = 0;
    }
    return failed;
}

bool is_valid(const Call &call, const TriangleSwitches &switches) {
    const auto reject = [](const char *what) {
        complain(name, "%s", what);
        return false;
    };
    if (call.in == nullptr) return reject("in is NULL");
    if (call.out == nullptr) return reject("out is NULL");
    if (switches.voronoi && call.vorout == nullptr) return reject("vorout is NULL, and switch v needs it");
    const triangulateio &in = *call.in;
    if (in.numberofpoints < 3) {
        complain(name, "in has %d points, and three are needed", in.numberofpoints);
        return false;
    }
    if (in.pointlist == nullptr) return reject("in->pointlist is NULL");
    if (in.numberofpointattributes < 0) return reject("in->numberofpointattributes is negative");
    if (in.numberofpointattributes > 0 && in.pointattributelist == nullptr)
        return reject("in->pointattributelist is NULL");
    return true;
}

// The cells of the original, with an output of its own.
class Original {
public:
    Original(Function function, const TriangleSwitches &switches, const triangulateio &in) {
        triangulateio points{};
        points.pointlist = in.pointlist;
        points.numberofpoints = in.numberofpoints;
        std::string plain = switches.for_cells();
        const double start = processor_time();
        returned_ = function(plain.data(), &points, &out_, &vorout_);
        seconds_ = processor_time() - start;
    }
    Original(const Original &) = delete;
    Original &operator=(const Original &) = delete;
    ~Original() {
        for (triangulateio *each : {&out_, &vorout_}) {
            for (double *array : {each->pointlist, each->pointattributelist, each->normlist}) std::free(array);
            for (int *array : {each->pointmarkerlist, each->trianglelist, each->neighborlist, each->edgelist})
                std::free(array);
            for (int *array : {each->edgemarkerlist, each->segmentlist, each->segmentmarkerlist}) std::free(array);
        }
    }

    int returned() const { return returned_; }
    double seconds() const { return seconds_; }
    // int and uint32_t may be used for the same object, and -1 is no_cell.
    Cells cells() const {
        return {3, static_cast<std::size_t>(out_.numberoftriangles),
                reinterpret_cast<const std::uint32_t *>(out_.trianglelist),
                reinterpret_cast<const std::uint32_t *>(out_.neighborlist)};
    }

private:
    triangulateio out_{}, vorout_{};
    int returned_ = failed;
    double seconds_ = 0;
};

// Writes the cells, sorted if that was asked for. The seconds that writing took.
double write(const Call &call, const TriangleSwitches &switches, const Cells &cells,
             const std::vector<std::uint32_t> &representative) {
    std::optional<OwnedCells> in_order;
    if (sorted()) in_order = sorted_cells(cells);
    const double start = processor_time();
    write_triangulation(switches, in_order ? in_order->view() : cells, representative, *call.in, *call.out,
                        call.vorout);
    return processor_time() - start;
}

void report_difference(const Difference &difference, std::size_t n_cells) {
    complain(name, "%zu of %zu triangles differ from the original's; the first is %u %u %u, which %s has",
             difference.count, n_cells, difference.first[0], difference.first[1], difference.first[2],
             difference.first_is_own ? "deldrift" : "the original");
}

// Serves a call by deldrift, or compares with the original, which then gives the cells and what is returned.
int serve(const Call &call, const TriangleSwitches &switches, Function compared) {
    const std::size_t n_points = static_cast<std::size_t>(call.in->numberofpoints);
    const double start = processor_time();
    const Borrowed triangulation(2, call.in->pointlist, n_points);
    deldrift_cells_view view{};
    if (triangulation.status() != DELDRIFT_OK || deldrift_cells(triangulation.get(), &view) != DELDRIFT_OK) {
        complain(name, "%s", deldrift_last_error());
        return give_nothing(call);
    }
    const Cells cells{3, switches.carves_all() ? 0 : view.count, view.vertices, view.neighbours};
    std::vector<std::uint32_t> representative;
    if (switches.jettison || compared != nullptr) representative = representatives(triangulation.get(), n_points);
    // No point is in a triangle any more. Where there were none from the start, nothing has been taken away.
    if (switches.carves_all() && view.count > 0) representative.assign(n_points, no_point);
    double seconds = processor_time() - start;
    int returned = done;
    if (compared == nullptr) {
        seconds += write(call, switches, cells, representative);
    } else {
        const Original original(compared, switches, *call.in);
        const Difference found = difference(cells, original.cells(), representative);
        if (tally.compared(cells.count, found.count)) report_difference(found, cells.count);
        tally.original_served(original.seconds(), n_points, original.cells().count);
        seconds += write(call, switches, original.cells(), representative);
        returned = original.returned();
    }
    tally.served(triangulation.how(), seconds, n_points, cells.count);
    return returned;
}

// By the original, with its own output, or in sorted order.
int serve_by_original(const Call &call, const TriangleSwitches &switches, Function function) {
    if (sorted() && is_valid(call, switches)) {
        const Original original(function, switches, *call.in);
        if (original.cells().count > 0) {
            write(call, switches, original.cells(), {});
            tally.original_served(original.seconds(), static_cast<std::size_t>(call.in->numberofpoints),
                                  original.cells().count);
            return original.returned();
        }
    }
    const double start = processor_time();
    const int returned = function(call.switches, call.in, call.out, call.vorout);
    if (call.in != nullptr && call.out != nullptr)
        tally.original_served(processor_time() - start, static_cast<std::size_t>(call.in->numberofpoints),
                              static_cast<std::size_t>(call.out->numberoftriangles));
    return returned;
}

int pass_on(const Call &call, const std::string &unserved, Function original) {
    if (original == nullptr) {
        complain(name, "%s is not served by deldrift, and there is no Triangle to pass the call to", unserved.c_str());
        return give_nothing(call);
    }
    tally.passed_on();
    return original(call.switches, call.in, call.out, call.vorout);
}

// Empty if deldrift serves the call.
std::string what_is_unserved(const TriangleSwitches &switches, const triangulateio *in) {
    if (switches.unserved != '\0') return std::string("switch ") + switches.unserved;
    const char *of_input = in != nullptr ? switches.unserved_input(*in) : nullptr;
    return of_input != nullptr ? of_input : "";
}

int dispatch(const Call &call, const void *caller) {
    const TriangleSwitches switches(call.switches);
    const std::string unserved = what_is_unserved(switches, call.in);
    Function original = nullptr;
    if (!unserved.empty() || mode() != Mode::deldrift)
        original = reinterpret_cast<Function>(original_of(call.symbol, caller));
    if (!unserved.empty()) return pass_on(call, unserved, original);
    if (mode() != Mode::deldrift && original == nullptr) {
        static std::once_flag once;
        std::call_once(once, complain, name, "DELDRIFT_COMPAT asks for Triangle, and there is none; deldrift serves");
    }
    if (mode() == Mode::original && original != nullptr) return serve_by_original(call, switches, original);
    return is_valid(call, switches) ? serve(call, switches, original) : give_nothing(call);
}

int handle(const Call &call, const void *caller) {
    if (call.switches == nullptr) {
        complain(name, "switches is NULL");
        return give_nothing(call);
    }
    try {
        return dispatch(call, caller);
    } catch (const std::bad_alloc &) {
        complain(name, "not enough memory");
        return give_nothing(call);
    }
}

} // namespace

} // namespace compat

extern "C" [[gnu::visibility("default")]] int triangulate(char *switches, triangulateio *in, triangulateio *out,
                                                           triangulateio *vorout) {
    return compat::handle({compat::name, switches, in, out, vorout}, __builtin_return_address(0));
}

// The function by the name that it has where Triangle is compiled as C++, as libigl does.
#define MANGLED "_Z11triangulatePcP13triangulateioS1_S1_"
extern "C" int triangulate_of_cxx(char *, triangulateio *, triangulateio *, triangulateio *) __asm__(MANGLED);
extern "C" [[gnu::visibility("default")]] int triangulate_of_cxx(char *switches, triangulateio *in,
                                                                  triangulateio *out, triangulateio *vorout) {
    return compat::handle({MANGLED, switches, in, out, vorout}, __builtin_return_address(0));
}
