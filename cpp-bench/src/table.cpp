// SPDX-License-Identifier: GPL-3.0-or-later
#include "table.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace bench {
namespace {

bool begins_like_a_number(const std::string &text) {
    return !text.empty() && (std::isdigit(static_cast<unsigned char>(text[0])) || text[0] == '-');
}

std::string timed(const Row &row) { return row.is_step ? "step" : "update"; }

std::string speedup(const Row &row, int digits) {
    return row.speedup > 0 ? significant(row.speedup, digits) : std::string();
}

}  // namespace

std::string significant(double value, int digits) {
    const int magnitude = value == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::fabs(value))));
    char text[64];
    if (magnitude < -6 || magnitude > 15)
        std::snprintf(text, sizeof text, "%.*e", digits - 1, value);
    else
        std::snprintf(text, sizeof text, "%.*f", std::max(0, digits - 1 - magnitude), value);
    return text;
}

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
            out << std::string(total, '-') << '\n';
            continue;
        }
        std::string text;
        for (std::size_t column = 0; column < n_columns; ++column) {
            const std::string &entry = lines_[i][column];
            const std::string padding(widths[column] - entry.size(), ' ');
            const bool right = lines_.size() > 1 && begins_like_a_number(lines_[lines_[1].empty() ? 2 : 1][column]);
            text += (column ? "  " : "") + (right ? padding + entry : entry + padding);
        }
        text.erase(text.find_last_not_of(' ') + 1);
        out << text << '\n';
    }
}

void print_rows(std::ostream &out, const std::vector<Row> &rows) {
    TextTable table({"scenario", "n", "timestamps", "engine", "algorithm", "timed", "threads", "seconds",
                     "ns/vertex/timestamp", "x CGAL rebuild"});
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row &row = rows[i];
        if (i == 0 || row.scenario != rows[i - 1].scenario || row.n != rows[i - 1].n) table.add({});
        table.add({row.scenario, std::to_string(row.n), std::to_string(row.timestamps), row.engine, row.algorithm,
                   timed(row), std::to_string(row.threads), significant(row.seconds, 3),
                   significant(row.ns_per_vertex_timestamp(), 3), speedup(row, 3)});
    }
    table.print(out);
}

void print_checks(std::ostream &out, const std::vector<Checks> &checks) {
    TextTable table({"cells checked", "n", "timestamps", "comparisons", "cells", "unlike CGAL, degenerate",
                     "coincident points"});
    for (const Checks &check : checks)
        table.add({check.scenario, std::to_string(check.n_points), std::to_string(check.n_timestamps),
                   std::to_string(check.n_comparisons), std::to_string(check.n_cells),
                   std::to_string(check.n_degenerate), std::to_string(check.n_coincident)});
    table.print(out);
}

void write_csv(const std::string &path, const std::vector<Row> &rows) {
    std::vector<std::vector<std::string>> lines = {{"scenario", "dimension", "n", "timestamps", "engine", "algorithm",
                                                    "threads", "seconds", "ns_per_vertex_timestamp",
                                                    "speedup_vs_cgal_rebuild", "timed"}};
    for (const Row &row : rows)
        lines.push_back({row.scenario, std::to_string(row.dimension), std::to_string(row.n),
                         std::to_string(row.timestamps), row.engine, row.algorithm, std::to_string(row.threads),
                         significant(row.seconds, 6), significant(row.ns_per_vertex_timestamp(), 5),
                         speedup(row, 5), timed(row)});
    write_csv(path, lines);
}

void write_csv(const std::string &path, const std::vector<std::vector<std::string>> &lines) {
    std::ofstream file(path);
    for (const auto &line : lines) {
        for (std::size_t column = 0; column < line.size(); ++column) file << (column ? "," : "") << line[column];
        file << '\n';
    }
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
