// SPDX-License-Identifier: GPL-3.0-or-later
// Work in a process of its own, so that its memory is counted from a clean start.
#pragma once

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace bench {

template <typename Result>
struct ChildOutcome {
    Result result;
    std::size_t peak_resident_bytes;
};

/// Runs `work()` in a forked process and returns what it returned (plain data) and the greatest amount of
/// memory the process had resident. Throws std::runtime_error where it failed or was killed.
template <typename Work>
auto run_in_child(Work work) -> ChildOutcome<decltype(work())> {
    using Result = decltype(work());
    static_assert(std::is_trivially_copyable<Result>::value, "the result crosses a pipe");
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe to a child process");
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no child process");
    if (child == 0) {
        close(ends[0]);
        int status = 1;
        try {
            const Result result = work();
            status = write(ends[1], &result, sizeof result) == static_cast<ssize_t>(sizeof result) ? 0 : 1;
        } catch (const std::exception &error) {
            fmt::print(stderr, "\nerror: {}\n", error.what());
        }
        std::fflush(nullptr);
        _exit(status);
    }
    close(ends[1]);
    ChildOutcome<Result> outcome{};
    const ssize_t n_read = read(ends[0], &outcome.result, sizeof outcome.result);
    const bool has_result = n_read == static_cast<ssize_t>(sizeof outcome.result);
    close(ends[0]);
    int status = 0;
    rusage usage{};
    if (wait4(child, &status, 0, &usage) != child) throw std::runtime_error("the child process was lost");
    if (WIFSIGNALED(status))
        throw std::runtime_error(fmt::format("the child process was killed by signal {}{}", WTERMSIG(status),
                                             WTERMSIG(status) == SIGKILL ? " (out of memory?)" : ""));
    if (!has_result || WEXITSTATUS(status) != 0) throw std::runtime_error("the child process failed");
    outcome.peak_resident_bytes = static_cast<std::size_t>(usage.ru_maxrss) * 1024;
    return outcome;
}

}  // namespace bench
