// SPDX-License-Identifier: GPL-3.0-or-later
#include "csv.hpp"

#include "table.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace bench {
namespace {

CsvFile::Line split(const std::string &text) {
    CsvFile::Line line;
    std::istringstream stream(text);
    for (std::string entry; std::getline(stream, entry, ',');) line.push_back(entry);
    if (!text.empty() && text.back() == ',') line.emplace_back();
    return line;
}

}  // namespace

CsvFile::CsvFile(std::string path, Line columns) : path_(std::move(path)), columns_(std::move(columns)) {
    std::ifstream file(path_);
    std::string text;
    if (!std::getline(file, text) || split(text) != columns_) return;
    while (std::getline(file, text)) lines_.push_back(split(text));
}

bool CsvFile::has(const Line &beginning) const {
    return std::any_of(lines_.begin(), lines_.end(), [&](const Line &line) {
        return line.size() >= beginning.size() &&
               std::equal(beginning.begin(), beginning.end(), line.begin());
    });
}

void CsvFile::save() const {
    std::vector<Line> all = {columns_};
    all.insert(all.end(), lines_.begin(), lines_.end());
    write_csv(path_ + ".new", all);
    if (std::rename((path_ + ".new").c_str(), path_.c_str()) != 0)
        throw std::runtime_error(path_ + " cannot be written");
}

}  // namespace bench
