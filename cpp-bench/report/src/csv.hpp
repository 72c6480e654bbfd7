// SPDX-License-Identifier: GPL-3.0-or-later
// A table in a file that grows: what is there stays when a run is continued.
#pragma once

#include <string>
#include <vector>

namespace bench {

class CsvFile {
public:
    using Line = std::vector<std::string>;

    /// Reads what is there; a file with other columns is taken for empty.
    CsvFile(std::string path, Line columns);

    const std::vector<Line> &lines() const { return lines_; }

    /// Whether a line begins with these entries.
    bool has(const Line &beginning) const;

    void add(Line line) { lines_.push_back(std::move(line)); }

    /// Writes a new file and puts it in the place of the old one. Throws std::runtime_error.
    void save() const;

private:
    std::string path_;
    Line columns_;
    std::vector<Line> lines_;
};

}  // namespace bench
