// SPDX-License-Identifier: GPL-3.0-or-later
// Compares whatever is at one timestamp with the two references, which are built once for it.
#pragma once

#include "cells.hpp"
#include "series.hpp"
#include "verify.hpp"

#include <string>
#include <vector>

namespace bench {

class Referee {
public:
    /// Builds the references and compares them with each other; adds to `checks`, as `judge` does.
    Referee(const Series &series, std::size_t timestamp, Checks &checks);

    /// Throws Mismatch unless the engine's cells are the reference's. What CGAL's reproductions of the
    /// report's algorithms may differ by in space is counted instead: see `gap_cells`.
    void judge(const Entrant &entrant, Engine &engine);

private:
    CellSet fresh(const std::string &name);
    CellSet cells_of(Engine &engine, const std::string &name);
    void require_equal(const CellSet &cells, const std::string &name);
    std::size_t require_equivalent(const CellSet &cells, const std::string &name);
    [[noreturn]] void fail(const std::string &what) const;

    const Series &series_;
    std::size_t timestamp_;
    Checks &checks_;
    std::vector<std::uint32_t> representatives_;
    CellSet cgal_;
    CellSet deldrift_;
};

}  // namespace bench
