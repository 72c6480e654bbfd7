// Triangle's entry point: decides who serves a call, and serves.
#include <deldrift_triangle.h>

#include <cstddef>
#include <cstdlib>
#include <initializer_list>
#include <mutex>
#include <new>
#include <optional>
#include <string>

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

struct Call {
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
            std::free(each->edgemarkerlist);
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
double write(const Call &call, const TriangleSwitches &switches, const Cells &cells) {
    std::optional<OwnedCells> in_order;
    if (sorted()) in_order = sorted_cells(cells);
    const double start = processor_time();
    write_triangulation(switches, in_order ? in_order->view() : cells, *call.in, *call.out, call.vorout);
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
    const Cells cells{3, view.count, view.vertices, view.neighbours};
    double seconds = processor_time() - start;
    int returned = done;
    if (compared == nullptr) {
        seconds += write(call, switches, cells);
    } else {
        const Original original(compared, switches, *call.in);
        const Difference found = difference(cells, original.cells(), representatives(triangulation.get(), n_points));
        if (tally.compared(cells.count, found.count)) report_difference(found, cells.count);
        tally.original_served(original.seconds(), n_points, original.cells().count);
        seconds += write(call, switches, original.cells());
        returned = original.returned();
    }
    tally.served(triangulation.how(), seconds, n_points, view.count);
    return returned;
}

// By the original, with its own output, or in sorted order.
int serve_by_original(const Call &call, const TriangleSwitches &switches, Function function) {
    if (sorted() && is_valid(call, switches)) {
        const Original original(function, switches, *call.in);
        write(call, switches, original.cells());
        tally.original_served(original.seconds(), static_cast<std::size_t>(call.in->numberofpoints),
                              original.cells().count);
        return original.returned();
    }
    const double start = processor_time();
    const int returned = function(call.switches, call.in, call.out, call.vorout);
    if (call.in != nullptr && call.out != nullptr)
        tally.original_served(processor_time() - start, static_cast<std::size_t>(call.in->numberofpoints),
                              static_cast<std::size_t>(call.out->numberoftriangles));
    return returned;
}

int pass_on(const Call &call, char unserved, Function original) {
    if (original == nullptr) {
        complain(name, "switch %c is not served by deldrift, and there is no Triangle to pass the call to", unserved);
        return give_nothing(call);
    }
    tally.passed_on();
    return original(call.switches, call.in, call.out, call.vorout);
}

int dispatch(const Call &call, const void *caller) {
    const TriangleSwitches switches(call.switches);
    Function original = nullptr;
    if (switches.unserved != '\0' || mode() != Mode::deldrift)
        original = reinterpret_cast<Function>(original_of(name, caller));
    if (switches.unserved != '\0') return pass_on(call, switches.unserved, original);
    if (mode() != Mode::deldrift && original == nullptr) {
        static std::once_flag once;
        std::call_once(once, complain, name, "DELDRIFT_COMPAT asks for Triangle, and there is none; deldrift serves");
    }
    if (mode() == Mode::original && original != nullptr) return serve_by_original(call, switches, original);
    return is_valid(call, switches) ? serve(call, switches, original) : give_nothing(call);
}

} // namespace

} // namespace compat

extern "C" [[gnu::visibility("default")]] int triangulate(char *switches, triangulateio *in, triangulateio *out,
                                                           triangulateio *vorout) {
    const compat::Call call{switches, in, out, vorout};
    if (switches == nullptr) {
        compat::complain(compat::name, "switches is NULL");
        return compat::give_nothing(call);
    }
    try {
        return compat::dispatch(call, __builtin_return_address(0));
    } catch (const std::bad_alloc &) {
        compat::complain(compat::name, "not enough memory");
        return compat::give_nothing(call);
    }
}
