// SPDX-License-Identifier: GPL-3.0-or-later
#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bench {
namespace {

constexpr double seconds_between_updates = 0.1;
constexpr double seconds_before_plain_tenths = 5.0;  // short work gets its first line only
constexpr std::size_t greatest_length = 100;

double seconds_since(std::chrono::steady_clock::time_point time) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - time).count();
}

/// "about 3 min left", from the part that is done and how long that
/// took; nothing where it is too early to tell.
std::string time_left(double fraction, double seconds) {
    if (fraction < 0.05 || fraction >= 1 || seconds < 3) return {};
    const double left = seconds * (1 - fraction) / fraction;
    return left < 90 ? fmt::format(", about {:.0f} s left", std::ceil(left))
                     : fmt::format(", about {:.0f} min left", left / 60);
}

}  // namespace

Progress::Progress(Output output) : output_(output), is_terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() { wipe(); }

void Progress::begin(const std::string &what, std::size_t n_steps) {
    what_ = what;
    n_steps_ = static_cast<double>(std::max<std::size_t>(n_steps, 1));
    done_ = 0;
    shown_tenths_ = 0;
    begun_ = shown_at_ = std::chrono::steady_clock::now();
    if (output_ == Output::silent || is_terminal_)
        show({});
    else
        fmt::print(stderr, "{}\n", what);
}

void Progress::step(const std::string &detail) {
    done_ += 1;
    show(detail);
}

void Progress::set(double fraction) {
    done_ = fraction * n_steps_;
    show({});
}

void Progress::show(const std::string &detail) {
    if (output_ == Output::silent) return;
    const double fraction = done_ / n_steps_;
    if (is_terminal_) {
        if (done_ > 0 && done_ < n_steps_ && seconds_since(shown_at_) < seconds_between_updates) return;
        shown_at_ = std::chrono::steady_clock::now();
        std::string line = fmt::format("{:3.0f} %  {}{}  {}", 100 * fraction, what_,
                                       time_left(fraction, seconds_since(begun_)), detail);
        line.resize(std::min(line.size(), greatest_length));
        wipe();
        fmt::print(stderr, "\r{}", line);
        std::fflush(stderr);
        shown_length_ = line.size();
        return;
    }
    const int tenths = static_cast<int>(10 * fraction);
    if (tenths > shown_tenths_ && tenths < 10 && seconds_since(begun_) > seconds_before_plain_tenths) {
        shown_tenths_ = tenths;
        fmt::print(stderr, "{}: {} %{}\n", what_, 10 * tenths, time_left(fraction, seconds_since(begun_)));
    }
}

void Progress::wipe() {
    if (shown_length_ == 0) return;
    fmt::print(stderr, "\r{:{}}\r", "", shown_length_);
    std::fflush(stderr);
    shown_length_ = 0;
}

}  // namespace bench
