// SPDX-License-Identifier: GPL-3.0-or-later
// The speeds that deldrift sets itself where almost nothing changes, of the test for tolerances, and what two threads
// must gain.
#pragma once

#include "options.hpp"
#include "progress.hpp"
#include "verify.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bench {

/// How much of everything: points, how often they move after the warm-up, and which targets.
struct TargetSizes {
    std::size_t n_relocated;  // points that are relocated one by one, at once
    std::size_t n_rounds;     // of all of them
    std::size_t n_tested;     // points that stay within their tolerance
    std::size_t n_committed;  // points that are committed, or built, together
    std::size_t n_commits;    // and builds
    std::vector<std::size_t> looped;  // inputs of which vertices are visited one after another
    std::vector<std::size_t> grown;   // inputs of which single calls are timed, in ascending order
    std::size_t n_stepped;            // points that go a step together
    double seconds;                   // most that an engine visits an input's vertices, or makes one kind of call
    std::vector<std::string> chosen = {};  // targets; empty: all

    bool has(const std::string &target) const {
        return chosen.empty() || std::find(chosen.begin(), chosen.end(), target) != chosen.end();
    }
};

/// A speed-up to be reached, and what was measured.
struct Target {
    std::string what;
    unsigned dimension;
    std::size_t n;
    std::string reference;
    std::string contender;
    double reference_ns;  // per vertex
    double contender_ns;
    double wanted;
    double n_changes;  // the contender's flips, placements and rebuilds, per update
    double within;     // share of the vertices that the contender finds within their tolerance

    double ratio() const { return reference_ns / contender_ns; }
    const char *verdict() const { return ratio() >= wanted ? "pass" : "missed"; }
};

/// The sequential loop: each vertex's star is read and the vertex put 0.001 spacings away at once.
std::vector<Target> loop_targets(unsigned dimension, const TargetSizes &sizes, std::uint64_t seed,
                                 std::vector<Checks> &checks, Progress &progress);

/// Single calls in small and in large triangulations: a target's reference is the smallest one.
std::vector<Target> growth_targets(unsigned dimension, const TargetSizes &sizes, std::uint64_t seed,
                                   Progress &progress);

/// Point location beside CGAL's, and insertions anywhere. The cells found are compared; throws Mismatch.
std::vector<Target> location_targets(unsigned dimension, const TargetSizes &sizes, std::uint64_t seed,
                                     Progress &progress);

/// Few vertices of many: auto beside the best of the algorithms for use, later and over the first ten timestamps, in ns
/// per staged vertex, of which there are `n`. Throws Mismatch.
std::vector<Target> staged_targets(unsigned dimension, const TargetSizes &sizes, std::uint64_t seed,
                                   Progress &progress);

/// Commits in two phases beside those in one, and steps that are withdrawn beside those that a clone is kept for. The
/// cells are compared; throws Mismatch.
std::vector<Target> phase_targets(unsigned dimension, const TargetSizes &sizes, std::uint64_t seed, Progress &progress);

/// Steps beside commits alone.
std::vector<Target> step_targets(unsigned dimension, const TargetSizes &sizes, std::uint64_t seed,
                                 std::vector<Checks> &checks, Progress &progress);

/// Measures every target and compares the cells of all engines concerned at the end of each input. Throws
/// Mismatch.
std::vector<Target> measure_targets(const TargetSizes &sizes, std::uint64_t seed, std::vector<Checks> &checks,
                                    Progress &progress);

/// Table and targets.csv.
void run_targets(const Options &options);

}  // namespace bench
