// SPDX-License-Identifier: GPL-3.0-or-later
// What the files of tests have in common.
#pragma once

#include "series.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <numeric>
#include <string>
#include <system_error>
#include <vector>

namespace bench {

using doctest::Contains;

/// A folder that goes with the object.
class Folder {
public:
    Folder() : path_(std::filesystem::temp_directory_path() / fmt::format("deldrift-self-test-{}", getpid())) {
        std::filesystem::create_directories(path_);
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder &) = delete;
    Folder &operator=(const Folder &) = delete;

    std::string file(const std::string &name) const { return (path_ / name).string(); }

private:
    std::filesystem::path path_;
};

inline std::vector<std::size_t> every_timestamp(const Series &series) {
    std::vector<std::size_t> timestamps(series.n_timestamps());
    std::iota(timestamps.begin(), timestamps.end(), 1);
    return timestamps;
}

}  // namespace bench
