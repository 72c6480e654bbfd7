#include "settings.hpp"

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "plain_locale.hpp"

namespace compat {

static Mode read_mode() {
    const char *value = std::getenv("DELDRIFT_COMPAT");
    if (value == nullptr || *value == '\0' || std::strcmp(value, "deldrift") == 0) return Mode::deldrift;
    if (std::strcmp(value, "original") == 0) return Mode::original;
    if (std::strcmp(value, "compare") == 0) return Mode::compare;
    std::fprintf(stderr, "deldrift: DELDRIFT_COMPAT is \"%s\": deldrift, original or compare was expected; "
                         "taken for deldrift\n", value);
    return Mode::deldrift;
}

Mode mode() {
    static const Mode chosen = read_mode();
    return chosen;
}

static bool is_set(const char *variable, const char *expected) {
    const char *value = std::getenv(variable);
    return value != nullptr && std::strcmp(value, expected) == 0;
}

bool sorted() {
    static const bool asked = is_set("DELDRIFT_COMPAT_SORTED", "1");
    return asked;
}

bool leaves_refinement() {
    static const bool asked = is_set("DELDRIFT_COMPAT_REFINE", "original");
    return asked;
}

void complain(const char *function, const char *format, ...) {
    char message[640];
    const PlainLocale plain;
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    std::fprintf(stderr, "deldrift: %s: %s\n", function, message);
}

double processor_time() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void Tally::Sums::add(double more_seconds, std::uint64_t n_points, std::uint64_t n_cells) {
    calls++;
    points += n_points;
    cells += n_cells;
    seconds += more_seconds;
}

void Tally::served(How how, double seconds, std::uint64_t n_points, std::uint64_t n_cells) {
    const std::lock_guard lock(mutex_);
    own_.add(seconds, n_points, n_cells);
    built_ += how == How::built;
    moved_ += how == How::moved;
    edited_ += how == How::edited;
}

void Tally::original_served(double seconds, std::uint64_t n_points, std::uint64_t n_cells) {
    const std::lock_guard lock(mutex_);
    original_.add(seconds, n_points, n_cells);
}

void Tally::passed_on() {
    const std::lock_guard lock(mutex_);
    passed_on_++;
}

bool Tally::compared(std::uint64_t n_cells, std::uint64_t n_different) {
    const std::lock_guard lock(mutex_);
    const bool first = different_ == 0 && n_different > 0;
    compared_ += n_cells;
    different_ += n_different;
    return first;
}

Tally::~Tally() {
    const char *path = std::getenv("DELDRIFT_COMPAT_REPORT");
    if (path == nullptr || *path == '\0' || own_.calls + original_.calls + passed_on_ == 0) return;
    std::FILE *file = std::fopen(path, "a");
    if (file == nullptr) {
        complain(function_, "the report cannot be written to %s", path);
        return;
    }
    const PlainLocale plain;
    const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    std::fprintf(file, "function=%s calls=%llu built=%llu moved=%llu edited=%llu points=%llu cells=%llu seconds=%.6f",
                 function_, number(own_.calls), number(built_), number(moved_), number(edited_), number(own_.points),
                 number(own_.cells), own_.seconds);
    std::fprintf(file, " original_calls=%llu original_cells=%llu original_seconds=%.6f passed_on=%llu",
                 number(original_.calls), number(original_.cells), original_.seconds, number(passed_on_));
    std::fprintf(file, " compared=%llu different=%llu\n", number(compared_), number(different_));
    std::fclose(file);
}

} // namespace compat
