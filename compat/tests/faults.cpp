// Memory that is refused: for every allocation of a call, a call in which this one fails. The call then says so, has
// written nothing, and the next call works.
#include <deldrift_tetgen.h>
#include <deldrift_triangle.h>

#include <cerrno>
#include <cstring>

#include "check.hpp"

// How many allocations go before the one that fails; negative: none fails.
static long before_failure = -1;

static bool fails() { return before_failure >= 0 && before_failure-- == 0; }

// The allocator of glibc under its own names, so that all of a process can be refused: C++, Rust and C.
extern "C" {
void *__libc_malloc(std::size_t size);
void *__libc_calloc(std::size_t count, std::size_t size);
void *__libc_realloc(void *block, std::size_t size);
void *__libc_memalign(std::size_t alignment, std::size_t size);

void *malloc(std::size_t size) { return fails() ? nullptr : __libc_malloc(size); }
void *calloc(std::size_t count, std::size_t size) { return fails() ? nullptr : __libc_calloc(count, size); }
void *realloc(void *block, std::size_t size) { return fails() ? nullptr : __libc_realloc(block, size); }
int posix_memalign(void **block, std::size_t alignment, std::size_t size) {
    if (fails()) return ENOMEM;
    *block = __libc_memalign(alignment, size);
    return *block == nullptr ? ENOMEM : 0;
}
}

namespace {

// Calls with the n-th allocation refused; whether that was reached. A triangulation is kept from call to call.
// The last point is at the place of the first, and j leaves it out.
bool triangulate_fails_at(long n, Points points, std::size_t n_cells) {
    triangulateio in{}, out{}, vorout{};
    points.insert(points.end(), {points[0], points[1]});
    in.pointlist = points.data();
    in.numberofpoints = static_cast<int>(points.size() / 2);
    char switches[] = "Qznvecj";
    before_failure = n;
    const int returned = triangulate(switches, &in, &out, &vorout);
    const bool reached = before_failure < 0;
    before_failure = -1;
    CHECK(returned == (out.numberoftriangles == 0 ? 1 : 0));
    if (out.numberoftriangles == 0) {
        CHECK(reached && out.trianglelist == nullptr && vorout.pointlist == nullptr);
    } else {
        CHECK(static_cast<std::size_t>(out.numberoftriangles) == n_cells);
        CHECK(out.numberofpoints == in.numberofpoints - 1);
    }
    for (triangulateio *each : {&out, &vorout}) {
        for (double *array : {each->pointlist, each->pointattributelist, each->normlist}) std::free(array);
        for (int *array : {each->pointmarkerlist, each->trianglelist, each->neighborlist}) std::free(array);
        for (int *array : {each->edgelist, each->edgemarkerlist}) std::free(array);
        for (int *array : {each->segmentlist, each->segmentmarkerlist}) std::free(array);
    }
    return reached;
}

// With weights, if there are some: then the first attribute.
bool tetrahedra_fail_at(long n, const Points &points, const std::vector<double> &weights, std::size_t n_cells) {
    tetgenio in, out;
    in.pointlist = const_cast<double *>(points.data());
    in.numberofpoints = static_cast<int>(points.size() / 3);
    in.pointattributelist = weights.empty() ? nullptr : const_cast<double *>(weights.data());
    in.numberofpointattributes = weights.empty() ? 0 : 1;
    char plain[] = "Qznfev", weighted[] = "Qznfevw";
    char *switches = weights.empty() ? plain : weighted;
    int thrown = 0;
    before_failure = n;
    try {
        tetrahedralize(switches, &in, &out);
    } catch (int code) {
        thrown = code;
    }
    const bool reached = before_failure < 0;
    before_failure = -1;
    in.pointlist = in.pointattributelist = nullptr;
    if (thrown != 0) CHECK(reached && thrown == 1 && out.tetrahedronlist == nullptr && out.vcelllist == nullptr);
    else CHECK(static_cast<std::size_t>(out.numberoftetrahedra) == n_cells);
    return reached;
}

bool tetrahedralize_fails_at(long n, const Points &points, std::size_t n_cells) {
    return tetrahedra_fail_at(n, points, {}, n_cells);
}

// Some points are hidden, some are at the place of others, and some of these places are hidden.
bool weights_fail_at(long n) {
    Points points = random_points(3, 80, 4);
    points.insert(points.end(), points.begin(), points.begin() + 60);
    std::vector<double> weights = random_points(1, 100, 5);
    for (double &w : weights) w *= 0.2;
    deldrift_triangulation *t = nullptr;
    std::size_t n_cells = 0;
    CHECK(deldrift_create_weighted(3, points.data(), weights.data(), nullptr, 100, nullptr, &t) == DELDRIFT_OK);
    CHECK(deldrift_cell_count(t, &n_cells) == DELDRIFT_OK);
    deldrift_destroy(t);
    return tetrahedra_fail_at(n, points, weights, n_cells);
}

// Points that move, so that both the new and the kept triangulation are asked for memory.
template <class Call>
void refuse_each(unsigned dimension, Call call) {
    Points points = random_points(dimension, 80, dimension);
    unsigned seed = 0;
    long n = 0, n_reached = 0;
    for (bool reached = true; reached; n++) {
        points = moved(points, 0.01, seed++);
        const std::size_t n_cells = fresh_cells(dimension, points).size();
        reached = call(n, points, n_cells);
        n_reached += reached;
        call(-1, points, n_cells);
    }
    CHECK(n_reached > 10);
}

} // namespace

int main() {
    refuse_each(2, triangulate_fails_at);
    refuse_each(3, tetrahedralize_fails_at);
    long n_refused = 0;
    while (weights_fail_at(n_refused)) n_refused++;
    CHECK(n_refused > 10);
}
