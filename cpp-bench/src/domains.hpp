// SPDX-License-Identifier: GPL-3.0-or-later
// Domains whose boundaries are segments, and move: deldrift's constrained triangulations beside CGAL's.
#pragma once

#include "options.hpp"
#include "progress.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace bench {

/// Vertices at about unit density (one spacing is 1), in general position, and segments between them. Vertices that are
/// ends come first. No vertex is closer to a segment than `domain_clearance`, its own ends aside.
struct Domain {
    std::string name;
    std::vector<double> positions;
    std::vector<std::array<std::uint32_t, 2>> segments;
    /// Where all vertices are so many timestamps after the beginning: the domain's own motion.
    std::function<void(std::size_t timestamp, std::vector<double> &positions)> move;

    std::size_t n_points() const { return positions.size() / 2; }
};

constexpr double domain_clearance = 0.1;

/// How many timestamps the motions of domains take.
constexpr std::size_t domain_timestamps = 110;

/// What domains are called, in the order of the table.
const std::vector<std::string> &domain_names();

/// About so many vertices. Throws std::runtime_error for a name that is not there.
Domain make_domain(const std::string &name, std::size_t n_points, std::uint64_t seed);

/// Something timed on both sides, in ns per vertex.
struct DomainLine {
    std::string domain;
    std::size_t n_points;
    std::size_t n_segments;
    std::string timed;
    std::string reference;
    std::string contender;
    double reference_ns;
    double contender_ns;
    double wanted;  // of the ratio

    double ratio() const { return reference_ns / contender_ns; }
    const char *verdict() const { return ratio() >= wanted ? "pass" : "missed"; }
};

/// How often everything is timed.
struct DomainEfforts {
    std::size_t n_builds;
    std::size_t n_steps;  // of each length, after three that are not timed
    std::size_t n_moves;  // of the domain's own motion, the first ones
};

/// What was compared.
struct DomainChecks {
    std::size_t n_comparisons = 0;
    std::size_t n_cells = 0;
};

/// Every figure of one domain. The cells are those of CGAL at every timestamp; throws std::runtime_error where not.
std::vector<DomainLine> measure_domain(const Domain &domain, const DomainEfforts &efforts, std::uint64_t seed,
                                       DomainChecks &checks, Progress &progress);

/// Table and domains.csv.
void run_domains(const Options &options);

}  // namespace bench
