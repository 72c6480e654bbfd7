// TetGen's entry point: decides who serves a call, and serves.
#include <deldrift_tetgen.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cells.hpp"
#include "kept.hpp"
#include "original.hpp"
#include "representatives.hpp"
#include "settings.hpp"
#include "tetgen_behavior.hpp"
#include "tetgen_layout.hpp"
#include "tetgen_switches.hpp"
#include "tetgen_writer.hpp"

namespace compat {

namespace {

constexpr char name[] = "tetrahedralize";
constexpr char by_switches[] = "_Z14tetrahedralizePcP8tetgenioS1_S1_S1_";
constexpr char by_behavior[] = "_Z14tetrahedralizeP14tetgenbehaviorP8tetgenioS2_S2_S2_";
// The first argument is the switches, or what has them.
using Function = void (*)(void *, tetgenio *, tetgenio *, tetgenio *, tetgenio *);
Tally tally(name);

// What TetGen throws.
enum Failure { out_of_memory = 1, defect = 2, bad_input = 10 };

[[noreturn]] void fail(Failure failure, const char *why) {
    complain(name, "%s", why);
    throw static_cast<int>(failure);
}

struct Call {
    const char *symbol; // that the function was called by
    void *first;
    tetgenio *in, *out, *addin, *bgmin;
    const void *caller;
    bool has_behavior() const { return symbol == by_behavior; }
    Function original(const char *of) const { return reinterpret_cast<Function>(original_of(of, caller)); }
};

// While it lives, this thread is inside the original. Of TetGen's two functions the one that takes switches calls the other
// one by its name, which is this library's: such a call is passed straight on.
class Inside {
public:
    Inside() { depth_++; }
    Inside(const Inside &) = delete;
    Inside &operator=(const Inside &) = delete;
    ~Inside() { depth_--; }
    static bool is_inside() { return depth_ > 0; }

private:
    static thread_local int depth_;
};
thread_local int Inside::depth_ = 0;

void call_original(Function original, const Call &call) {
    const Inside inside;
    original(call.first, call.in, call.out, call.addin, call.bgmin);
}

template <class Io>
void check(const Io &in) {
    if (in.numberofpoints < 4) fail(bad_input, "in has fewer than four points");
    if (in.pointlist == nullptr) fail(bad_input, "in->pointlist is NULL");
    if (in.firstnumber != 0 && in.firstnumber != 1) fail(bad_input, "in->firstnumber is neither 0 nor 1");
    if (in.numberofpointattributes < 0) fail(bad_input, "in->numberofpointattributes is negative");
    if (in.numberofpointattributes > 0 && in.pointattributelist == nullptr)
        fail(bad_input, "in->pointattributelist is NULL");
}

// As TetGen has them: the first attribute of each point, or, where points have none, the greatest magnitude of its
// coordinates.
template <class Io>
std::vector<double> weights_of(const TetgenSwitches &switches, const Io &in) {
    if (!switches.weighted) return {};
    const std::size_t n = static_cast<std::size_t>(in.numberofpoints);
    const std::size_t n_attributes = static_cast<std::size_t>(in.numberofpointattributes);
    std::vector<double> weights(n);
    for (std::size_t i = 0; i < n; i++) {
        const double *p = in.pointlist + 3 * i;
        weights[i] = n_attributes > 0 ? in.pointattributelist[n_attributes * i]
                                      : std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    }
    return weights;
}

// The cells of the original, with an output of its own. Its input is numbered from 0: TetGen 1.5 and 1.6 write past the
// end of the markers of faces where z is given for points that are numbered from 1.
template <class Io>
class Original {
public:
    Original(Function function, const TetgenSwitches &switches, const Io &in) {
        struct Lent {
            Io io;
            ~Lent() { io.pointlist = io.pointattributelist = nullptr; }
        } lent;
        lent.io.pointlist = in.pointlist;
        lent.io.numberofpoints = in.numberofpoints;
        if (switches.weighted) {
            lent.io.pointattributelist = in.pointattributelist;
            lent.io.numberofpointattributes = in.numberofpointattributes;
        }
        std::string plain = switches.for_cells();
        const Inside inside;
        const double start = processor_time();
        function(plain.data(), reinterpret_cast<tetgenio *>(&lent.io), reinterpret_cast<tetgenio *>(&out_), nullptr,
                 nullptr);
        seconds_ = processor_time() - start;
    }
    double seconds() const { return seconds_; }
    Cells cells() const {
        return {4, static_cast<std::size_t>(out_.numberoftetrahedra),
                reinterpret_cast<const std::uint32_t *>(out_.tetrahedronlist),
                reinterpret_cast<const std::uint32_t *>(out_.neighborlist)};
    }

private:
    Io out_;
    double seconds_ = 0;
};

// Writes the cells, sorted if that was asked for. The seconds that writing took.
template <class Io>
double write(const TetgenSwitches &switches, const Cells &cells, const Io &in, Io &out,
             const std::vector<std::uint32_t> &representative, const std::vector<double> &weights) {
    std::optional<OwnedCells> in_order;
    if (sorted()) in_order = sorted_cells(cells);
    const double start = processor_time();
    write_tetrahedra(switches, in_order ? in_order->view() : cells, in, out, representative, weights);
    return processor_time() - start;
}

// The points that stay where the cells are the original's: each that is in one stands for itself. Of points at one
// place it need not be the first. With weights those stay, too, at whose places there is none in the cells.
template <class Io>
std::vector<std::uint32_t> representatives_in(const Cells &cells, const Io &in, bool weighted) {
    constexpr std::uint32_t none = UINT32_MAX;
    std::vector<std::uint32_t> representative(static_cast<std::size_t>(in.numberofpoints), none);
    for (std::size_t i = 0; i < 4 * cells.count; i++) representative[cells.vertices[i]] = cells.vertices[i];
    if (!weighted) return representative;
    const auto place = [&in](std::size_t i) {
        return std::array<double, 3>{in.pointlist[3 * i], in.pointlist[3 * i + 1], in.pointlist[3 * i + 2]};
    };
    std::set<std::array<double, 3>> shown;
    for (std::size_t i = 0; i < representative.size(); i++)
        if (representative[i] != none) shown.insert(place(i));
    for (std::size_t i = 0; i < representative.size(); i++)
        if (representative[i] == none && shown.count(place(i)) == 0) representative[i] = static_cast<std::uint32_t>(i);
    return representative;
}

void report_difference(const Difference &difference, std::size_t n_cells) {
    complain(name, "%zu of %zu tetrahedra differ from the original's; the first is %u %u %u %u, which %s has",
             difference.count, n_cells, difference.first[0], difference.first[1], difference.first[2],
             difference.first[3], difference.first_is_own ? "deldrift" : "the original");
}

void check_status(deldrift_status status) {
    if (status == DELDRIFT_OK) return;
    const bool of_input = status == DELDRIFT_NOT_FINITE || status == DELDRIFT_OUT_OF_RANGE ||
                          status == DELDRIFT_MISALIGNED_ARGUMENT || status == DELDRIFT_TOO_MANY_CELLS;
    fail(status == DELDRIFT_OUT_OF_MEMORY ? out_of_memory : of_input ? bad_input : defect, deldrift_last_error());
}

// Serves a call by deldrift, or compares with the original, whose cells are returned then.
template <class Io>
void serve(const TetgenSwitches &switches, Io &in, Io &out, Function compared) {
    check(in);
    const std::size_t n_points = static_cast<std::size_t>(in.numberofpoints);
    const double start = processor_time();
    const std::vector<double> weights = weights_of(switches, in);
    const Borrowed triangulation = switches.weighted ? Borrowed(in.pointlist, weights)
                                                     : Borrowed(3, in.pointlist, n_points);
    check_status(triangulation.status());
    deldrift_cells_view view{};
    check_status(deldrift_cells(triangulation.get(), &view));
    if (view.count == 0) fail(bad_input, "all points are in one plane");
    if (view.count > INT_MAX / 2) fail(bad_input, "there are more faces than an int can count");
    const Cells cells{4, view.count, view.vertices, view.neighbours};
    const std::vector<std::uint32_t> representative = representatives(triangulation.get(), n_points);
    double seconds = processor_time() - start;
    if (compared == nullptr) {
        seconds += write(switches, cells, in, out, representative, weights);
    } else {
        const Original<Io> original(compared, switches, in);
        const Difference found = difference(cells, original.cells(), representative);
        if (tally.compared(cells.count, found.count)) report_difference(found, cells.count);
        tally.original_served(original.seconds(), n_points, original.cells().count);
        const std::vector<std::uint32_t> shown = representatives_in(original.cells(), in, switches.weighted);
        seconds += write(switches, original.cells(), in, out, shown, weights);
    }
    tally.served(triangulation.how(), seconds, n_points, view.count);
}

// By the original, with its own output, or in sorted order.
template <class Io>
void serve_by_original(const Call &call, const TetgenSwitches &switches, Io &in, Io &out, Function function) {
    double seconds = 0;
    if (sorted()) {
        check(in);
        const Original<Io> original(function, switches, in);
        seconds = original.seconds();
        write(switches, original.cells(), in, out, representatives_in(original.cells(), in, switches.weighted),
              weights_of(switches, in));
    } else {
        const double start = processor_time();
        call_original(function, call);
        seconds = processor_time() - start;
    }
    tally.original_served(seconds, static_cast<std::size_t>(in.numberofpoints),
                          static_cast<std::size_t>(out.numberoftetrahedra));
}

void pass_on(const Call &call, const char *why, Function original) {
    if (original == nullptr) fail(bad_input, why);
    tally.passed_on();
    call_original(original, call);
}

template <class Io>
void serve_by_either(const Call &call, const TetgenSwitches &switches, Function original) {
    Io &in = *reinterpret_cast<Io *>(call.in), &out = *reinterpret_cast<Io *>(call.out);
    if (mode() == Mode::original && original != nullptr) serve_by_original(call, switches, in, out, original);
    else serve(switches, in, out, original);
}

void dispatch(const Call &call) {
    if (call.has_behavior() && Inside::is_inside()) {
        const Function original = call.original(by_behavior);
        if (original != nullptr) return original(call.first, call.in, call.out, call.addin, call.bgmin);
    }
    if (call.first == nullptr) fail(bad_input, call.has_behavior() ? "b is NULL" : "switches is NULL");
    if (call.in == nullptr) fail(bad_input, "in is NULL");
    if (call.out == nullptr) fail(bad_input, "out is NULL");
    Layout layout = layout_of(call.out);
    // A tetgenbehavior is of the version that the tetgenio is of.
    if (call.has_behavior() && layout != Layout::v1_5_0)
        return pass_on(call, "b is not the tetgenbehavior of TetGen 1.5.0, and there is no TetGen to pass the call to",
                       call.original(by_behavior));
    const TetgenSwitches switches(call.has_behavior() ? switches_of_behavior(call.first).c_str()
                                                      : static_cast<const char *>(call.first));
    // Where no list is asked for that has another place, one of the two is as good as the other.
    if (layout == Layout::v1_5_1_or_1_6 && !switches.lists_faces()) layout = Layout::v1_6;
    const bool is_known = layout != Layout::unknown && layout != Layout::v1_5_1_or_1_6;
    Function original = nullptr;
    if (switches.unserved != '\0' || !is_known || mode() != Mode::deldrift)
        original = call.original(call.symbol);
    if (layout == Layout::v1_5_1_or_1_6) layout = told_apart(reinterpret_cast<const void *>(original));
    if (switches.unserved != '\0') {
        char why[] = "switch ? is not served by deldrift, and there is no TetGen to pass the call to";
        why[7] = switches.unserved;
        return pass_on(call, why, original);
    }
    if (layout == Layout::unknown)
        return pass_on(call, "out is not a tetgenio of TetGen 1.5 or 1.6 that has been initialised", original);
    if (layout == Layout::v1_5_1_or_1_6)
        return pass_on(call, "out may be a tetgenio of TetGen 1.5.1 or 1.6, and there is no TetGen to tell which; "
                             "DELDRIFT_COMPAT_TETGEN=1.5.1 or 1.6 says it", original);
    if (mode() != Mode::deldrift && original == nullptr) {
        static std::once_flag once;
        std::call_once(once, complain, name, "DELDRIFT_COMPAT asks for TetGen, and there is none; deldrift serves");
    }
    Function asked = mode() == Mode::deldrift ? nullptr : original;
    // To compare, the original is called with switches of its own. To be put into order, too.
    const bool has_own_switches = mode() == Mode::compare || sorted();
    if (asked != nullptr && call.has_behavior() && has_own_switches) asked = call.original(by_switches);
    if (layout == Layout::v1_5_0) serve_by_either<TetgenIo150>(call, switches, asked);
    else if (layout == Layout::v1_5_1) serve_by_either<TetgenIo151>(call, switches, asked);
    else serve_by_either<TetgenIo16>(call, switches, asked);
}

void handle(const Call &call) {
    try {
        dispatch(call);
    } catch (const std::bad_alloc &) {
        fail(out_of_memory, "not enough memory");
    }
}

} // namespace

} // namespace compat

[[gnu::visibility("default")]] void tetrahedralize(char *switches, tetgenio *in, tetgenio *out, tetgenio *addin,
                                                   tetgenio *bgmin) {
    compat::handle({compat::by_switches, switches, in, out, addin, bgmin, __builtin_return_address(0)});
}

// TetGen's class, which programs have from TetGen's header.
class tetgenbehavior;
[[gnu::visibility("default")]] void tetrahedralize(tetgenbehavior *b, tetgenio *in, tetgenio *out, tetgenio *addin,
                                                   tetgenio *bgmin);
void tetrahedralize(tetgenbehavior *b, tetgenio *in, tetgenio *out, tetgenio *addin, tetgenio *bgmin) {
    compat::handle({compat::by_behavior, b, in, out, addin, bgmin, __builtin_return_address(0)});
}
