// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine.hpp"

#include <stdexcept>

namespace bench {

Reading Engine::read() { throw std::logic_error("this engine gives no readings"); }

double Engine::visit(std::uint32_t, const double *) { throw std::logic_error("this engine relocates no vertex"); }

namespace {

std::vector<EngineKind> make_engine_kinds() {
    std::vector<EngineKind> kinds = {
        // engine, algorithm, is_stateless, is_slow_in_3d, make, is_reproduction
        {"cgal", "rebuilding", true, false, make_cgal_rebuilding},
        {"cgal", "placement", false, true, make_cgal_placement},
        {"cgal", "move", false, true, make_cgal_move},
        {"cgal", "tolerance", false, true, make_cgal_tolerance, true},
        {"cgal", "safe_region", false, true, make_cgal_safe_region, true},
        {"cgal", "safe_region_tolerance", false, true, make_cgal_safe_region_tolerance, true},
        {"cgal", "rebuilding_tolerance", false, false, make_cgal_rebuilding_tolerance, true},
    };
    for (const Algorithm &algorithm : algorithms()) {
        EngineKind kind = {"deldrift", algorithm.name, false, algorithm.is_one_by_one, deldrift_by(algorithm)};
        kind.keeps_data = algorithm.keeps_data;
        kind.is_internal = algorithm.purpose == Purpose::internal;
        kinds.push_back(kind);
    }
    return kinds;
}

}  // namespace

const std::vector<EngineKind> &engine_kinds() {
    static const std::vector<EngineKind> kinds = make_engine_kinds();
    return kinds;
}

const EngineKind &engine_kind(const std::string &name) {
    for (const EngineKind &kind : engine_kinds())
        if (kind.name() == name) return kind;
    throw std::runtime_error("no engine is called " + name);
}

}  // namespace bench
