// SPDX-License-Identifier: GPL-3.0-or-later
#include "table.hpp"

#include <fmt/ostream.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace bench {
namespace {

bool begins_like_a_number(const std::string &text) {
    return !text.empty() && (std::isdigit(static_cast<unsigned char>(text[0])) || text[0] == '-');
}

std::string speedup(const Row &row, int digits) {
    return row.speedup > 0 ? significant(row.speedup, digits) : std::string();
}

}  // namespace

// fmt's {:#.3g} takes to exponents as soon as a number has more digits, and ends in a point where it has as many.
std::string significant(double value, int digits) {
    const int magnitude = value == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::fabs(value))));
    if (magnitude < -6 || magnitude > 15) return fmt::format("{:.{}e}", value, digits - 1);
    return fmt::format("{:.{}f}", value, std::max(0, digits - 1 - magnitude));
}

// fmt pads entries; which width they are padded to, and to which side, it leaves to us.
void TextTable::print(std::ostream &out) const {
    const std::size_t n_columns = lines_.front().size();
    std::vector<std::size_t> widths(n_columns, 0);
    for (const auto &line : lines_)
        for (std::size_t column = 0; column < line.size(); ++column)
            widths[column] = std::max(widths[column], line[column].size());
    std::size_t total = 2 * (n_columns - 1);
    for (const std::size_t width : widths) total += width;

    for (std::size_t i = 0; i < lines_.size(); ++i) {
        if (lines_[i].empty()) {
            fmt::print(out, "{:-<{}}\n", "", total);
            continue;
        }
        std::string text;
        for (std::size_t column = 0; column < n_columns; ++column) {
            const bool right = lines_.size() > 1 && begins_like_a_number(lines_[lines_[1].empty() ? 2 : 1][column]);
            text += fmt::format(right ? "{:>{}}  " : "{:<{}}  ", lines_[i][column], widths[column]);
        }
        text.erase(text.find_last_not_of(' ') + 1);
        fmt::print(out, "{}\n", text);
    }
}

void print_rows(std::ostream &out, const std::vector<Row> &rows) {
    TextTable table({"scenario", "n", "timestamps", "engine", "algorithm", "timed", "threads", "seconds",
                     "ns/vertex/timestamp", "x CGAL rebuild"});
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row &row = rows[i];
        if (i == 0 || row.scenario != rows[i - 1].scenario || row.n != rows[i - 1].n) table.add({});
        table.add(line_of(row.scenario, row.n, row.timestamps, row.engine, row.algorithm, row.timed, row.threads,
                          significant(row.seconds, 3), significant(row.ns_per_vertex_timestamp(), 3),
                          speedup(row, 3)));
    }
    table.print(out);
}

void print_checks(std::ostream &out, const std::vector<Checks> &checks) {
    TextTable table({"cells checked", "n", "timestamps", "comparisons", "cells", "unlike CGAL, degenerate",
                     "coincident points"});
    for (const Checks &check : checks)
        table.add(line_of(check.scenario, check.n_points, check.n_timestamps, check.n_comparisons, check.n_cells,
                          check.n_degenerate, check.n_coincident));
    table.print(out);
}

void write_csv(const std::string &path, const std::vector<Row> &rows) {
    std::vector<std::vector<std::string>> lines = {{"scenario", "dimension", "n", "timestamps", "engine", "algorithm",
                                                    "threads", "seconds", "ns_per_vertex_timestamp",
                                                    "speedup_vs_cgal_rebuild", "timed"}};
    for (const Row &row : rows)
        lines.push_back(line_of(row.scenario, row.dimension, row.n, row.timestamps, row.engine, row.algorithm,
                                row.threads, significant(row.seconds, 6),
                                significant(row.ns_per_vertex_timestamp(), 5), speedup(row, 5), row.timed));
    write_csv(path, lines);
}

void write_csv(const std::string &path, const std::vector<std::vector<std::string>> &lines) {
    std::ofstream file(path);
    for (const auto &line : lines) fmt::print(file, "{}\n", fmt::join(line, ","));
    if (!file.flush()) throw std::runtime_error(path + " cannot be written");
}

void publish(const std::string &folder, const std::string &file,
             const std::vector<std::vector<std::string>> &lines) {
    TextTable table(lines.front());
    for (std::size_t i = 1; i < lines.size(); ++i) {
        if (i == 1 || lines[i][0] != lines[i - 1][0]) table.add({});
        table.add(lines[i]);
    }
    table.print(std::cout);
    std::filesystem::create_directories(folder);
    write_csv(folder + "/" + file, lines);
    std::cout << "\nwritten: " << folder << '/' << file << '\n';
}

}  // namespace bench
