// SPDX-License-Identifier: GPL-3.0-or-later
// What a test needs.
#pragma once

#include <cstdio>
#include <exception>
#include <string>

namespace bench {

class Tests {
public:
    void expect(bool holds, const std::string &what) {
        ++(holds ? n_passed_ : n_failed_);
        if (!holds) std::printf("FAILED: %s\n", what.c_str());
    }

    /// `action` must throw an error whose message contains `part`.
    template <typename Action>
    void expect_error(Action action, const std::string &part, const std::string &what) {
        try {
            action();
            expect(false, what + ": no error");
        } catch (const std::exception &error) {
            const std::string message = error.what();
            expect(message.find(part) != std::string::npos, what + ": the error is \"" + message + "\"");
        }
    }

    template <typename Action>
    void expect_no_error(Action action, const std::string &what) {
        try {
            action();
            expect(true, what);
        } catch (const std::exception &error) {
            expect(false, what + ": " + error.what());
        }
    }

    bool close() const {
        std::printf("%u passed, %u failed\n", n_passed_, n_failed_);
        return n_failed_ == 0 && n_passed_ > 0;
    }

private:
    unsigned n_passed_ = 0;
    unsigned n_failed_ = 0;
};

/// The part that concerns readings and steps.
void test_steps(Tests &tests);

/// The part that concerns the report RR-6750: its inputs, and its algorithms on CGAL.
void test_report(Tests &tests);

}  // namespace bench
