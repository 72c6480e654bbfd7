// What the environment asks for, messages, and what was done, reported at exit.
#pragma once

#include <cstdint>
#include <mutex>

namespace compat {

enum class Mode {
    deldrift, // serve what can be served
    original, // pass every call on
    compare,  // do both, report the first difference, return the cells of the original
};

// DELDRIFT_COMPAT: deldrift, the default, original or compare.
Mode mode();

// DELDRIFT_COMPAT_SORTED=1: cells in an order that depends on their vertices alone, and everything else computed from
// them by this library, so that runs with either can be compared bit by bit.
bool sorted();

// DELDRIFT_COMPAT_REFINE=original: refinement is the original's, where there is one, so that meshes stay what they
// were.
bool leaves_refinement();

// One line on stderr.
[[gnu::format(printf, 2, 3)]] void complain(const char *function, const char *format, ...);

// Processor time of the process, in seconds: unlike time on the clock it does not depend on what else runs.
double processor_time();

// How the triangulation of a point set was come by.
enum class How { built, moved, edited };

// What was done for the calls of one function. Where DELDRIFT_COMPAT_REPORT names a file, a line is added to it at
// exit. Any thread may add.
class Tally {
public:
    explicit Tally(const char *function) : function_(function) {}
    Tally(const Tally &) = delete;
    Tally &operator=(const Tally &) = delete;
    ~Tally();

    void served(How how, double seconds, std::uint64_t n_points, std::uint64_t n_cells);
    void original_served(double seconds, std::uint64_t n_points, std::uint64_t n_cells);
    void passed_on();
    // Two sets of cells for the same points; true for the first difference of all.
    bool compared(std::uint64_t n_cells, std::uint64_t n_different);

private:
    // Calls with switches that can be served, by either, and their points, cells and time.
    struct Sums {
        std::uint64_t calls = 0, points = 0, cells = 0;
        double seconds = 0;
        void add(double seconds, std::uint64_t n_points, std::uint64_t n_cells);
    };

    const char *function_;
    std::mutex mutex_;
    Sums own_, original_;
    std::uint64_t built_ = 0, moved_ = 0, edited_ = 0, passed_on_ = 0, compared_ = 0, different_ = 0;
};

} // namespace compat
