// What calls cost: measures rows of the table of exponents. `run` builds this program, has it measure all, and writes
// the table.
//
//     costs --sets                    the sets: name, size in 2D and in 3D (0: there is none), description
//     costs --calls                   the rows: function, what for
//     costs FOLDER LIMIT SET DIMENSION N
//                                     a line of CSV for each row that standard input has, as --calls prints them;
//                                     calls may take LIMIT seconds each, and write files to FOLDER
#include <malloc.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <set>

#include "measure.hpp"

namespace costs {
namespace {

/// More memory than this is refused to a call.
constexpr rlim_t most_memory = rlim_t(6) << 30;

std::vector<Call> all_calls() {
    std::vector<Call> calls;
    for (auto part : {changing_calls, reading_calls, geometry_calls, segment_calls, file_calls})
        for (const Call &call : part()) calls.push_back(call);
    return calls;
}

/// A line of /proc/self/status, in bytes; 0 where there is none.
double from_status(const std::string &name) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.compare(0, name.size(), name) == 0) return 1024 * std::atof(line.c_str() + name.size() + 1);
    return 0;
}

/// The work of the child.
Measured measure(Context &c, const Call &call) {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;
    const double before = from_status("VmRSS");
    call.run(c);
    Measured measured = c.meter.measured();
    measured.peak_bytes = std::max(0.0, from_status("VmHWM") - before);
    std::size_t held = 0;
    if (c.t) must(deldrift_memory_bytes(c.t, &held));
    measured.size = c.t ? double(c.ids() + c.cells()) : measured.units;
    measured.held_bytes = double(held);
    return measured;
}

/// How a child has ended.
struct Outcome {
    std::string status;
    Measured measured;
};

/// The process is ended when it has used a processor for so many seconds.
void limit_time(double limit) {
    const itimerval timer{{0, 0}, {time_t(limit), suseconds_t(1e6 * (limit - std::floor(limit)))}};
    setitimer(ITIMER_PROF, &timer, nullptr);
}

[[noreturn]] void be_child(Context &c, const Call &call, int to, double limit) {
    const rlimit memory{most_memory, most_memory};
    setrlimit(RLIMIT_AS, &memory);
    limit_time(limit);
    try {
        const Measured measured = measure(c, call);
        if (write(to, &measured, sizeof measured) == ssize_t(sizeof measured)) _exit(0);
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s (%s), n = %zu, %uD: %s\n", call.function, call.what, c.n, c.dimension, error.what());
    }
    _exit(1);
}

/// Runs a call in a process that is ended after `limit` seconds on a processor, or ten times that by the clock.
Outcome run_in_child(Context &c, const Call &call, double limit) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe to a child process");
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no child process");
    if (child == 0) {
        close(ends[0]);
        be_child(c, call, ends[1], limit);
    }
    close(ends[1]);
    pollfd ready{ends[0], POLLIN, 0};
    Outcome outcome{"ok", {}};
    if (poll(&ready, 1, int(10000 * limit)) == 0) {
        kill(child, SIGKILL);
        outcome.status = "too_long";
    } else if (read(ends[0], &outcome.measured, sizeof outcome.measured) != ssize_t(sizeof outcome.measured)) {
        outcome.status = "failed";
    }
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status) && outcome.status == "failed")
        outcome.status = WTERMSIG(status) == SIGPROF ? "too_long" : "signal_" + std::to_string(WTERMSIG(status));
    return outcome;
}

std::string row_of(const Call &call) { return std::string(call.function) + '\t' + call.what; }

void print(const std::string &set, const Context &c, const Call &call, const Outcome &outcome) {
    const Measured &m = outcome.measured;
    std::printf("%s,%u,%zu,%s,\"%s\",%s,%.9f,%.0f,%.0f,%.9f,%.0f,%.0f,%.0f\n", set.c_str(), c.dimension, c.n, call.function,
                call.what, outcome.status.c_str(), m.seconds, m.units, m.asks, m.longest_gap, m.size, m.held_bytes, m.peak_bytes);
    std::fflush(stdout);
}

/// Where the set cannot be triangulated in time there is but the row of that.
void measure_all(char **arguments) {
    std::set<std::string> wanted;
    for (std::string line; std::getline(std::cin, line);) wanted.insert(line);
    const double limit = std::atof(arguments[1]);
    const std::string set = arguments[2];
    const auto dimension = unsigned(std::atoi(arguments[3]));
    Context c(dimension, points_of(set_of(set), std::size_t(std::atoll(arguments[4])), dimension));
    c.folder = arguments[0];
    const std::vector<Call> calls = all_calls();
    const Outcome created = run_in_child(c, calls.front(), limit);
    if (created.status != "ok") return print(set, c, calls.front(), created);
    c.triangulate();
    for (const Call &call : calls) {
        if (wanted.count(row_of(call)) == 0 || (call.dimension != 0 && call.dimension != dimension)) continue;
        c.meter = Meter();
        print(set, c, call, run_in_child(c, call, limit));
    }
}

void list_sets() {
    for (const Set &set : all_sets())
        std::printf("%s\t%zu\t%zu\t%s\n", set.name, set.first_size[0], set.first_size[1], set.description);
}

void list_calls() {
    for (const Call &call : all_calls()) std::printf("%s\n", row_of(call).c_str());
}

}  // namespace
}  // namespace costs

int main(int count, char **arguments) {
    try {
        const std::string first = count > 1 ? arguments[1] : "";
        if (count == 2 && first == "--sets") return costs::list_sets(), 0;
        if (count == 2 && first == "--calls") return costs::list_calls(), 0;
        if (count != 6) throw std::runtime_error("arguments: --sets, --calls, or FOLDER LIMIT SET DIMENSION N");
        costs::measure_all(arguments + 1);
    } catch (const std::exception &error) {
        std::cerr << "error: " << error.what() << '\n';
        return 1;
    }
}
