// What the C++ programs share: checks that end the program and say where.
#ifndef CHECK_HPP
#define CHECK_HPP

#include <cstdlib>
#include <cstring>
#include <deldrift.hpp>
#include <iostream>

#define CHECK(condition)                                                                   \
    do {                                                                                   \
        if (!(condition)) {                                                                \
            std::cerr << __FILE__ << ":" << __LINE__ << ": not so: " << #condition << "\n"; \
            std::exit(1);                                                                  \
        }                                                                                  \
    } while (false)

#define CHECK_THROWS(statement, expected_status, part)                     \
    do {                                                                   \
        bool thrown = false;                                               \
        try {                                                              \
            statement;                                                     \
        } catch (const deldrift::Error &error) {                           \
            thrown = true;                                                 \
            CHECK(error.status() == (expected_status));                    \
            CHECK(std::strstr(error.what(), (part)) != nullptr);           \
        }                                                                  \
        CHECK(thrown);                                                     \
    } while (false)

#endif  // CHECK_HPP
