// SPDX-License-Identifier: GPL-3.0-or-later
// The results as rows, as an aligned table and as CSV.
#pragma once

#include "verify.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

namespace bench {

struct Row {
    std::string scenario;
    unsigned dimension = 0;
    std::size_t n = 0;
    std::size_t timestamps = 0;  // how many were timed
    std::string engine;
    std::string algorithm;
    unsigned threads = 1;
    double seconds = 0;  // all timed timestamps together
    double speedup = 0;  // over CGAL's rebuilding at the same timestamps, of a step over its step; 0: not known
    std::string timed = "update";  // or "step", or "lists"

    double ns_per_vertex_timestamp() const {
        return 1e9 * seconds / (static_cast<double>(n) * static_cast<double>(timestamps));
    }
};

/// Text in columns; a column is aligned to the right where its first entry after the title is a number.
class TextTable {
public:
    explicit TextTable(std::vector<std::string> titles) : lines_{std::move(titles)} {}

    /// An empty line is a rule between groups.
    void add(std::vector<std::string> line) { lines_.push_back(std::move(line)); }
    void print(std::ostream &out) const;

private:
    std::vector<std::vector<std::string>> lines_;
};

/// The values as text.
template <typename... Values>
std::vector<std::string> line_of(const Values &...values) {
    return {fmt::to_string(values)...};
}

void print_rows(std::ostream &out, const std::vector<Row> &rows);
void print_checks(std::ostream &out, const std::vector<Checks> &checks);

/// `bench.csv`. Throws std::runtime_error where the file cannot be written.
void write_csv(const std::string &path, const std::vector<Row> &rows);

/// The lines as they are, comma-separated, the first being the header.
void write_csv(const std::string &path, const std::vector<std::vector<std::string>> &lines);

/// The same to a file in a folder that is made where it is missing, and to standard output as an aligned
/// table, with a rule where the first column changes.
void publish(const std::string &folder, const std::string &file,
             const std::vector<std::vector<std::string>> &lines);

/// A number with so many significant digits, without an exponent where that is readable.
std::string significant(double value, int digits);

}  // namespace bench
