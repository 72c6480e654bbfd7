// qhull's Delaunay triangulations on deldrift: qh_new_qhull, in place of that of libqhull_r.
#include <cstdint>
#include <new>
#include <string>
#include <vector>

#include "kept.hpp"
#include "original.hpp"
#include "qhull_flat.hpp"
#include "qhull_library.hpp"
#include "qhull_options.hpp"
#include "qhull_writer.hpp"
#include "representatives.hpp"
#include "settings.hpp"

namespace compat {

namespace {

Tally tally("qh_new_qhull");

// What deldrift has for a call: cells for comparing, and what is written.
struct Triangulated {
    QhullOutput output;
    std::vector<std::uint32_t> representative;
    How how = How::built;
};

// The points at the place of another, each with a facet that has this.
std::vector<CoplanarPoint> coplanar_points(const QhullFacets &facets,
                                           const std::vector<std::uint32_t> &representative) {
    std::vector<CoplanarPoint> result;
    if (representative.empty()) return result;
    std::vector<std::uint32_t> facet_of(representative.size());
    for (std::size_t slot = 0; slot < facets.n_lower * facets.n_corners; slot++)
        facet_of[facets.corners[slot]] = static_cast<std::uint32_t>(slot / facets.n_corners);
    for (std::uint32_t i = 0; i < representative.size(); i++)
        if (representative[i] != i) result.push_back({i, facet_of[representative[i]]});
    return result;
}

enum class Outcome {
    triangulated,
    for_original, // qhull has a message for points that do not span the dimension, or nearly do not
    refused,      // NaN or infinite: qhull may crash
};

Outcome triangulate_points(const QhullCall &call, const QhullOptions &options, Triangulated &result) {
    const auto dimension = static_cast<unsigned>(call.dimension);
    const auto n_points = static_cast<std::size_t>(call.n_points);
    const Borrowed triangulation(dimension, call.points, n_points);
    deldrift_cells_view view{};
    deldrift_status status = triangulation.status();
    if (status == DELDRIFT_OK) status = deldrift_cells(triangulation.get(), &view);
    if (status == DELDRIFT_NOT_FINITE) return Outcome::refused;
    if (status != DELDRIFT_OK && status != DELDRIFT_OUT_OF_RANGE)
        complain("qh_new_qhull", "%s; the call is passed on", deldrift_last_error());
    if (status != DELDRIFT_OK || view.count == 0) return Outcome::for_original;
    const Cells cells{view.corners_per_cell, view.count, view.vertices, view.neighbours};
    const auto is_flat = flat_cells(cells, call.points, flatness_tolerance(dimension, call.points, n_points));
    const std::uint32_t apex = options.has_infinity ? static_cast<std::uint32_t>(n_points) : no_cell;
    QhullOutput &output = result.output;
    output.facets = closed_facets(cells, is_flat, n_points, apex);
    if (output.facets.count() == 0) return Outcome::for_original;
    result.representative = representatives(triangulation.get(), n_points);
    if (options.keeps_coplanar) output.coplanar = coplanar_points(output.facets, result.representative);
    output.vertices.resize(n_points + 1);
    output.made.resize(output.facets.count());
    result.how = triangulation.how();
    return Outcome::triangulated;
}

// The cells that qhull has found.
std::vector<std::uint32_t> lower_facets(qhT *qh, unsigned n_corners) {
    std::vector<std::uint32_t> corners;
    const facetT *facet;
    FORALLfacets {
        if (facet->upperdelaunay) continue;
        for (unsigned i = 0; i < n_corners; i++) {
            const coordT *point = SETelemt_(facet->vertices, i, vertexT)->point;
            corners.push_back(static_cast<std::uint32_t>((point - qh->first_point) / qh->hull_dim));
        }
    }
    return corners;
}

std::size_t count_lower_facets(qhT *qh) {
    std::size_t count = 0;
    const facetT *facet;
    FORALLfacets count += !facet->upperdelaunay;
    return count;
}

void compare(const QhullCall &call, const Triangulated &own) {
    const unsigned n_corners = own.output.facets.n_corners;
    const std::vector<std::uint32_t> corners = lower_facets(call.qh, n_corners);
    const Cells other{n_corners, corners.size() / n_corners, corners.data(), nullptr};
    const Cells cells{n_corners, own.output.facets.n_lower, own.output.facets.corners.data(), nullptr};
    const Difference found = difference(cells, other, own.representative);
    if (!tally.compared(cells.count, found.count)) return;
    std::string first = std::to_string(found.first[0]);
    for (unsigned i = 1; i < n_corners; i++) first += " " + std::to_string(found.first[i]);
    complain("qh_new_qhull", "%zu of %zu cells differ from the original's; the first is %s, which %s has", found.count,
             cells.count, first.c_str(), found.first_is_own ? "deldrift" : "the original");
}

bool may_be_served(const QhullCall &call, QhullOptions &options) {
    if (call.dimension != 2 && call.dimension != 3) return false;
    if (call.points == nullptr || !read_qhull_command(call.command, options)) return false;
    return call.n_points + (options.has_infinity ? 1 : 0) >= call.dimension + 2;
}

// The call of the original, whose cells are counted, and compared with these if there are any.
int serve_by_original(NewQhull original, const QhullCall &call, const Triangulated *own) {
    const double start = processor_time();
    const int exit_code = original(call.qh, call.dimension, call.n_points, call.points, call.ismalloc, call.command,
                                   call.outfile, call.errfile);
    const double seconds = processor_time() - start;
    const std::size_t n_cells = exit_code == 0 ? count_lower_facets(call.qh) : 0;
    tally.original_served(seconds, static_cast<std::size_t>(call.n_points), n_cells);
    try {
        if (own != nullptr && exit_code == 0) compare(call, *own);
    } catch (const std::bad_alloc &) {
        complain("qh_new_qhull", "there is not enough memory to compare cells");
    }
    return exit_code;
}

// Whether the call has been served; then its exit code.
bool serve(NewQhull original, const QhullLibrary &library, const QhullCall &call, int &exit_code) {
    const double start = processor_time();
    Triangulated own;
    Outcome outcome = Outcome::for_original;
    QhullOptions options;
    try {
        if (!may_be_served(call, options)) return false;
        if (mode() != Mode::original) outcome = triangulate_points(call, options, own);
    } catch (const std::bad_alloc &) {
        complain("qh_new_qhull", "there is not enough memory; the call is passed on");
        return false;
    }
    if (outcome == Outcome::refused) {
        exit_code = refuse_call(library, call, deldrift_last_error());
    } else if (outcome == Outcome::triangulated && mode() == Mode::deldrift) {
        exit_code = write_qhull(library, call, own.output);
        tally.served(own.how, processor_time() - start, static_cast<std::size_t>(call.n_points),
                     own.output.facets.n_lower);
    } else if (mode() == Mode::deldrift) {
        return false;
    } else {
        exit_code = serve_by_original(original, call, outcome == Outcome::triangulated ? &own : nullptr);
    }
    return true;
}

} // namespace

} // namespace compat

// All arguments as wide as registers: what calls the qh_new_qhull of libqhull, which has no qhT and so one argument
// less, is passed on with arguments that are pointers where they are numbers here.
using Word = std::uintptr_t;
using Forwarded = int (*)(Word, Word, Word, Word, Word, Word, Word, Word);
extern "C" [[gnu::visibility("default")]] int deldrift_qh_new_qhull(Word qh, Word dimension, Word n_points, Word points,
                                                                    Word ismalloc, Word command, Word outfile,
                                                                    Word errfile) __asm__("qh_new_qhull");

int deldrift_qh_new_qhull(Word qh, Word dimension, Word n_points, Word points, Word ismalloc, Word command,
                          Word outfile, Word errfile) {
    using namespace compat;
    void *original = nullptr;
    const QhullLibrary *library = nullptr;
    try {
        original = original_of("qh_new_qhull", __builtin_return_address(0));
        if (original != nullptr) library = find_qhull_library(original);
    } catch (const std::bad_alloc &) {
        complain("qh_new_qhull", "there is not enough memory");
    }
    if (original == nullptr) {
        complain("qh_new_qhull", "there is no libqhull_r to pass the call to");
        return qh_ERRqhull;
    }
    if (library != nullptr) {
        const QhullCall call{reinterpret_cast<qhT *>(qh),           static_cast<int>(dimension),
                             static_cast<int>(n_points),            reinterpret_cast<coordT *>(points),
                             static_cast<boolT>(ismalloc),          reinterpret_cast<char *>(command),
                             reinterpret_cast<FILE *>(outfile),     reinterpret_cast<FILE *>(errfile)};
        int exit_code = 0;
        if (serve(reinterpret_cast<NewQhull>(original), *library, call, exit_code)) return exit_code;
    }
    tally.passed_on();
    return reinterpret_cast<Forwarded>(original)(qh, dimension, n_points, points, ismalloc, command, outfile, errfile);
}
