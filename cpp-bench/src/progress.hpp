// SPDX-License-Identifier: GPL-3.0-or-later
// What is going on, on standard error: one line that updates on a terminal, plain lines elsewhere.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace bench {

class Progress {
public:
    enum class Output { shown, silent };

    explicit Progress(Output output = Output::shown);
    ~Progress();
    Progress(const Progress &) = delete;
    Progress &operator=(const Progress &) = delete;

    /// A new piece of work of `n_steps` steps.
    void begin(const std::string &what, std::size_t n_steps);

    /// One step is done; `detail` is shown on a terminal only.
    void step(const std::string &detail = {});

    /// `fraction` of the work is done.
    void set(double fraction);

private:
    void show(const std::string &detail);
    void wipe();

    Output output_;
    bool is_terminal_;
    std::string what_;
    double n_steps_ = 0;
    double done_ = 0;
    int shown_tenths_ = 0;
    std::size_t shown_length_ = 0;
    std::chrono::steady_clock::time_point begun_;
    std::chrono::steady_clock::time_point shown_at_;
};

}  // namespace bench
