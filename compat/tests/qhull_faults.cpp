// Memory that is refused: for every allocation of a call of qh_new_qhull, a call in which this one fails. The call then
// has qhull's exit code for that, or its cells are qhull's own; what there is can be freed, and the next call works.
extern "C" {
#include <libqhull_r/qhull_ra.h>
}
#include <cerrno>

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

// Calls with the n-th allocation refused; whether that was reached.
bool fails_at(long n, unsigned dimension, Points points, std::size_t n_cells, long &n_failed, std::FILE *errfile) {
    static qhT storage;
    qhT *qh = &storage;
    qh_zero(qh, errfile);
    char command[] = "qhull d Qt Qbb Qc Qz";
    before_failure = n;
    const int exit_code = qh_new_qhull(qh, static_cast<int>(dimension), static_cast<int>(points.size() / dimension),
                                       points.data(), False, command, nullptr, errfile);
    const bool reached = before_failure < 0;
    before_failure = -1;
    std::size_t count = 0;
    facetT *facet;
    if (exit_code == 0) FORALLfacets count += !facet->upperdelaunay;
    CHECK(exit_code == 0 ? count == n_cells : reached && exit_code == qh_ERRmem);
    n_failed += exit_code != 0;
    qh_freeqhull(qh, qh_ALL);
    return reached;
}

} // namespace

int main() {
    std::FILE *errfile = std::tmpfile();
    CHECK(errfile != nullptr && std::setvbuf(errfile, nullptr, _IONBF, 0) == 0);
    for (const unsigned dimension : {2u, 3u}) {
        Points points = random_points(dimension, 80, dimension);
        unsigned seed = 0;
        long n = 0, n_failed = 0;
        // A kept triangulation that is moved asks for memory more seldom than one that is built, so some calls end
        // before the allocation that later ones reach.
        for (long n_unreached = 0; n_unreached < 30; n++) {
            points = moved(points, n % 2 == 0 ? 0.01 : 1e-4, seed++);
            const std::size_t n_cells = fresh_cells(dimension, points).size();
            const bool reached = fails_at(n, dimension, points, n_cells, n_failed, errfile);
            n_unreached = reached ? 0 : n_unreached + 1;
            fails_at(-1, dimension, points, n_cells, n_failed, errfile);
        }
        std::printf("%uD: %ld calls, of which %ld failed\n", dimension, n, n_failed);
        CHECK(n > 10 && n_failed > 0);
    }
}
