// SPDX-License-Identifier: GPL-3.0-or-later
// The step: an update and a reading of its result. An engine of a step's kind is a real one that does both where others
// do the update, so that everything that replays, times and compares does so with steps as well.
#pragma once

#include "engine.hpp"

#include <string>
#include <vector>

namespace bench {

/// The same engine, by steps. A build takes the first reading. Its cells are those of the latest reading, which
/// `validate` requires to be consistent. Under examination it also carries data along by the changes
/// that are told, and `validate` throws the first violation since the build.
EngineKind step_of(const EngineKind &kind);

/// The steps that are timed beside updates, CGAL's rebuilding first.
const std::vector<EngineKind> &step_kinds();

/// That of the engine called `name` ("deldrift/auto"); throws std::runtime_error where there is none.
const EngineKind &step_kind(const std::string &name);

}  // namespace bench
