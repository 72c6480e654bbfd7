// Triangle's entry point: decides who serves a call, and serves.
#include <deldrift_triangle.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "cells.hpp"
#include "kept.hpp"
#include "original.hpp"
#include "representatives.hpp"
#include "settings.hpp"
#include "triangle_carving.hpp"
#include "triangle_given.hpp"
#include "triangle_graph.hpp"
#include "triangle_mesh.hpp"
#include "triangle_original.hpp"
#include "triangle_refining.hpp"
#include "triangle_switches.hpp"
#include "triangle_writer.hpp"

static_assert(sizeof(triangulateio) == 168, "the layout of Triangle 1.6");
static_assert(offsetof(triangulateio, numberofpoints) == 24 && offsetof(triangulateio, trianglelist) == 32);
static_assert(offsetof(triangulateio, neighborlist) == 56 && offsetof(triangulateio, numberofcorners) == 68);
static_assert(offsetof(triangulateio, segmentlist) == 80 && offsetof(triangulateio, holelist) == 104);
static_assert(offsetof(triangulateio, edgelist) == 136 && offsetof(triangulateio, numberofedges) == 160);

// The program's own, where it is linked with this library.
extern "C" [[gnu::weak]] int triunsuitable(double *, double *, double *, double);

namespace compat {

namespace {

constexpr char name[] = "triangulate";
using Function = TriangleFunction;
Tally tally(name);

constexpr int done = 0, failed = 1;

struct Call {
    const char *symbol; // that the function was called by
    char *switches;
    triangulateio *in, *out, *vorout;
    const void *caller;
};

// Triangle itself, as far as the call would have come to it without this library; null if there is none.
Function original_for(const Call &call) { return reinterpret_cast<Function>(original_of(call.symbol, call.caller)); }

// What switch u asks; null if the program has no such function.
Unsuitable unsuitable_of(const Call &call) {
    if (&triunsuitable != nullptr) return &triunsuitable;
    for (const char *symbol : {"triunsuitable", "_Z13triunsuitablePdS_S_d"})
        if (void *found = original_of(symbol, call.caller)) return reinterpret_cast<Unsuitable>(found);
    return nullptr;
}

// Who frees the lists of holes and regions, if there are any, is for the Triangle to say that the program was made for.
bool wants_copies(const Call &call, const TriangleSwitches &switches) {
    const bool has_lists = call.in->holelist != nullptr || call.in->regionlist != nullptr;
    if (!has_lists || !switches.planar_graph || !switches.lists_segments()) return false;
    const Function original = original_for(call);
    return original != nullptr && copies_lists(original);
}

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
    if (!switches.wrong.empty()) return reject(switches.wrong.c_str());
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
    std::string wrong = switches.planar_graph ? what_is_wrong_with_graph(in) : "";
    if (wrong.empty() && switches.reconstructs)
        wrong = what_is_wrong_with_triangles(in, switches.zero_based, switches.has_region_areas);
    return wrong.empty() || reject(wrong.c_str());
}

// Writes the mesh, sorted if that was asked for. The seconds that writing took.
double write(const Call &call, const TriangleSwitches &switches, Mesh mesh) {
    if (sorted()) sort(mesh);
    const bool copies = wants_copies(call, switches);
    const double start = processor_time();
    write_triangulation(switches, mesh, *call.in, copies, *call.out, call.vorout);
    return processor_time() - start;
}

void report_difference(const Difference &difference, std::size_t n_cells) {
    complain(name, "%zu of %zu triangles differ from the original's; the first is %u %u %u, which %s has",
             difference.count, n_cells, difference.first[0], difference.first[1], difference.first[2],
             difference.first_is_own ? "deldrift" : "the original");
}

// A call that is served, from its input to its mesh.
class Served {
public:
    Served(const TriangleSwitches &switches, const triangulateio &in, Unsuitable unsuitable)
        : in_(with_graph_of(switches, in)), graph_(in_, switches.zero_based),
          triangulation_(2, in.pointlist, graph_.n_points(), graph_.ends()) {
        deldrift_cells_view view{};
        if (triangulation_.status() == DELDRIFT_OK) settle();
        else message_ = deldrift_last_error();
        if (!message_.empty()) return;
        if (deldrift_cells(triangulation_.get(), &view) != DELDRIFT_OK) {
            message_ = deldrift_last_error();
            return;
        }
        const Cells cells{3, view.count, view.vertices, view.neighbours};
        if (!switches.has_segments()) mesh_ = plain_mesh(cells);
        else if (switches.refines && cells.count > 0)
            message_ = refine(switches, in_, graph_, triangulation_.get(), unsuitable, given_.get(), refined_, mesh_);
        else mesh_ = carved_mesh(switches, cells);
    }

    // Why the call cannot be served; empty if it was.
    const std::string &message() const { return message_; }
    How how() const { return triangulation_.how(); }
    std::vector<std::uint32_t> representative() const { return representatives(triangulation_.get(), mesh_.n_points); }
    Mesh &mesh() { return mesh_; }

private:
    // Without p the lists are not looked at. Of triangles that are given the boundary is added to the segments, and
    // there are no holes and regions.
    triangulateio with_graph_of(const TriangleSwitches &switches, triangulateio in) {
        if (!switches.planar_graph) in.numberofsegments = in.numberofholes = in.numberofregions = 0;
        if (!switches.reconstructs) return in;
        given_ = std::make_unique<GivenTriangles>(in, switches.zero_based);
        segments_.assign(in.segmentlist, in.segmentlist + std::ptrdiff_t{2} * in.numberofsegments);
        if (in.segmentmarkerlist != nullptr)
            markers_.assign(in.segmentmarkerlist, in.segmentmarkerlist + in.numberofsegments);
        for (const std::uint32_t point : given_->boundary())
            segments_.push_back(static_cast<int>(point) + (switches.zero_based ? 0 : 1));
        markers_.resize(segments_.size() / 2, 0);
        in.segmentlist = segments_.data();
        in.segmentmarkerlist = markers_.data();
        in.numberofsegments = static_cast<int>(markers_.size());
        in.numberofholes = in.numberofregions = 0;
        return in;
    }

    void settle() {
        std::size_t n_cells = 0;
        deldrift_cell_count(triangulation_.get(), &n_cells);
        if (n_cells == 0) graph_.clear();
        if (triangulation_.how() != How::moved) message_ = graph_.settle(triangulation_.change());
        if (message_.empty() && graph_.is_plain()) triangulation_.has_segments();
    }

    Mesh carved_mesh(const TriangleSwitches &switches, const Cells &cells) const {
        Carver carver(in_, outline_of(graph_, in_), triangulation_.get(), cells);
        if (switches.encloses()) carver.enclose();
        carver.carve(switches);
        return carver.finish(switches);
    }

    Mesh plain_mesh(const Cells &cells) const {
        Mesh mesh;
        mesh.n_points = graph_.n_points();
        mesh.n_attributes = static_cast<std::size_t>(in_.numberofpointattributes);
        mesh.points = in_.pointlist;
        mesh.attributes = in_.pointattributelist;
        mesh.cells = cells;
        if (cells.count == 0) mesh.representative = representatives(triangulation_.get(), mesh.n_points);
        return mesh;
    }

    std::vector<int> segments_, markers_;
    std::unique_ptr<GivenTriangles> given_;
    triangulateio in_;
    Graph graph_;
    Borrowed triangulation_;
    Triangulation refined_;
    Mesh mesh_;
    std::string message_;
};

// Of the original: points and attributes are those of the input where it gives none.
Mesh mesh_of(const TriangleOriginal &original, const TriangleSwitches &switches, const triangulateio &in) {
    Mesh mesh = original.mesh();
    if (switches.has_segments()) return mesh;
    mesh.n_points = static_cast<std::size_t>(in.numberofpoints);
    mesh.n_attributes = static_cast<std::size_t>(in.numberofpointattributes);
    mesh.points = in.pointlist;
    mesh.attributes = in.pointattributelist;
    return mesh;
}

// Serves a call by deldrift, or compares with the original, which then gives the mesh and what is returned.
int serve(const Call &call, const TriangleSwitches &switches, Function compared) {
    const std::size_t n_points = static_cast<std::size_t>(call.in->numberofpoints);
    const double start = processor_time();
    Served served(switches, *call.in, switches.asks ? unsuitable_of(call) : nullptr);
    if (!served.message().empty()) {
        complain(name, "%s", served.message().c_str());
        return give_nothing(call);
    }
    double seconds = processor_time() - start;
    const std::size_t n_cells = served.mesh().cells.count;
    int returned = done;
    if (compared == nullptr) {
        seconds += write(call, switches, std::move(served.mesh()));
    } else {
        const TriangleOriginal original(compared, switches, *call.in);
        const Difference found = difference(served.mesh().cells, original.cells(), served.representative());
        if (tally.compared(n_cells, found.count)) report_difference(found, n_cells);
        tally.original_served(original.seconds(), n_points, original.cells().count);
        Mesh mesh = mesh_of(original, switches, *call.in);
        mesh.representative = std::move(served.mesh().representative);
        seconds += write(call, switches, std::move(mesh));
        returned = original.returned();
    }
    tally.served(served.how(), seconds, n_points, n_cells);
    return returned;
}

// By the original, with its own output, or in sorted order.
int serve_by_original(const Call &call, const TriangleSwitches &switches, Function function) {
    if (sorted() && is_valid(call, switches)) {
        const TriangleOriginal original(function, switches, *call.in);
        if (original.cells().count > 0) {
            write(call, switches, mesh_of(original, switches, *call.in));
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
std::string what_is_unserved(const TriangleSwitches &switches, const Call &call) {
    if (!switches.unserved.empty()) return switches.unserved;
    if (switches.asks && unsuitable_of(call) == nullptr) return "switch u without a function triunsuitable";
    const char *of_input = call.in != nullptr ? switches.unserved_input(*call.in) : nullptr;
    return of_input != nullptr ? of_input : "";
}

int dispatch(const Call &call) {
    const TriangleSwitches switches(call.switches);
    const std::string unserved = what_is_unserved(switches, call);
    Function original = nullptr;
    if (!unserved.empty() || mode() != Mode::deldrift || (switches.refines && leaves_refinement()))
        original = original_for(call);
    if (!unserved.empty()) return pass_on(call, unserved, original);
    if (mode() != Mode::deldrift && original == nullptr) {
        static std::once_flag once;
        std::call_once(once, complain, name, "DELDRIFT_COMPAT asks for Triangle, and there is none; deldrift serves");
    }
    // Refined cells of two libraries are never the same, so there is nothing to compare or to sort.
    if (switches.refines && original != nullptr) return pass_on(call, "", original);
    if (mode() == Mode::original && original != nullptr) return serve_by_original(call, switches, original);
    return is_valid(call, switches) ? serve(call, switches, original) : give_nothing(call);
}

int handle(const Call &call) {
    if (call.switches == nullptr) {
        complain(name, "switches is NULL");
        return give_nothing(call);
    }
    try {
        return dispatch(call);
    } catch (const std::bad_alloc &) {
        complain(name, "not enough memory");
        return give_nothing(call);
    }
}

} // namespace

} // namespace compat

extern "C" [[gnu::visibility("default")]] int triangulate(char *switches, triangulateio *in, triangulateio *out,
                                                           triangulateio *vorout) {
    return compat::handle({compat::name, switches, in, out, vorout, __builtin_return_address(0)});
}

// The function by the name that it has where Triangle is compiled as C++, as libigl does.
#define MANGLED "_Z11triangulatePcP13triangulateioS1_S1_"
extern "C" int triangulate_of_cxx(char *, triangulateio *, triangulateio *, triangulateio *) __asm__(MANGLED);
extern "C" [[gnu::visibility("default")]] int triangulate_of_cxx(char *switches, triangulateio *in,
                                                                  triangulateio *out, triangulateio *vorout) {
    return compat::handle({MANGLED, switches, in, out, vorout, __builtin_return_address(0)});
}

// Lists come from malloc, here and in Triangle.
extern "C" [[gnu::visibility("default")]] void trifree(void *list) { std::free(list); }
extern "C" void trifree_of_cxx(void *) __asm__("_Z7trifreePv");
extern "C" [[gnu::visibility("default")]] void trifree_of_cxx(void *list) { std::free(list); }
