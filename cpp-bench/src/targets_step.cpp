// SPDX-License-Identifier: GPL-3.0-or-later
// What it may cost to read, at each timestamp, the cells and what has changed.
#include "step.hpp"
#include "step_table.hpp"
#include "targets.hpp"

namespace bench {
namespace {

const std::vector<double> displacements = {0, 1e-5, 1e-4, 1e-3, 1e-2};

/// A commit alone over a step: a step may take 1.25 times as long, 1.05 where nothing has changed.
constexpr double wanted_of_steps = 1 / 1.25;
constexpr double wanted_at_rest = 1 / 1.05;
constexpr double wanted_of_rebuilding = 1 / 1.3;

constexpr unsigned n_repeats = 3;

std::string target_name(double displacement) { return "step_" + displacement_name(displacement); }

}  // namespace

std::vector<Target> step_targets(unsigned dimension, const TargetSizes &sizes, std::uint64_t seed,
                                 std::vector<Checks> &checks, Progress &progress) {
    std::vector<Target> targets;
    const auto measure = [&](const std::string &name, std::vector<double> lengths) {
        const auto is_not_chosen = [&](double length) { return !sizes.has(target_name(length)); };
        lengths.erase(std::remove_if(lengths.begin(), lengths.end(), is_not_chosen), lengths.end());
        if (lengths.empty()) return;
        checks.emplace_back();
        const EngineKind &commit = engine_kind(name), &step = step_kind(name);
        const auto ns = replay_displacements("step", dimension, sizes.n_stepped, lengths, {&commit, &step}, n_repeats,
                                             seed, checks.back(), progress);
        for (std::size_t i = 0; i < lengths.size(); ++i) {
            const double wanted = commit.algorithm == "rebuilding" ? wanted_of_rebuilding
                                  : lengths[i] == 0                ? wanted_at_rest
                                                                   : wanted_of_steps;
            targets.push_back({target_name(lengths[i]), dimension, sizes.n_stepped, commit.name(), step.name(),
                               ns[i][0], ns[i][1], wanted, 0, 0});
        }
    };
    measure("deldrift/auto", displacements);
    measure("deldrift/rebuilding", {displacements.back()});
    return targets;
}

}  // namespace bench
