// SPDX-License-Identifier: GPL-3.0-or-later
#include "weights.hpp"

#include "cells.hpp"
#include "cgal_reading.hpp"
#include "cgal_regular.hpp"
#include "library.hpp"
#include "random.hpp"
#include "replay.hpp"
#include "table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <numeric>
#include <stdexcept>

namespace bench {
namespace {

/// In so many timestamps DELDRIFT_AUTO has found out how vertices move.
constexpr std::size_t n_warm = 3;

/// How far vertices go in a step, in spacings, and by how much their weights change, in squares of the spacing.
constexpr double step_length = 1e-3;

/// The greatest weights, in squares of the spacing, and those for which a ratio is wanted: there few are hidden.
constexpr double greatest_weights[] = {0.1, 1, 4};
constexpr double with_wanted = 0.1;

constexpr double wanted_of_builds[] = {3.5, 2.6};
constexpr double wanted_of_steps[] = {30, 25};

struct Destroy {
    void operator()(deldrift_triangulation *t) const noexcept { deldrift_destroy(t); }
};
using Owner = std::unique_ptr<deldrift_triangulation, Destroy>;

template <typename Call>
double seconds_of(Call call) {
    const Stopwatch watch;
    call();
    return watch.seconds();
}

template <unsigned dimension>
class Measurement {
    using Space = RegularSpace<dimension>;

public:
    Measurement(std::size_t n_points, double greatest, const WeightEfforts &efforts, std::uint64_t seed,
                WeightChecks &checks, Progress &progress)
        : n_(n_points), greatest_(greatest), efforts_(efforts), random_(seed), checks_(checks), progress_(progress) {
        spacing_ = std::pow(static_cast<double>(n_), -1.0 / dimension);
        positions_.resize(n_ * dimension);
        for (double &x : positions_) x = random_.unit();
        weights_.resize(n_);
        for (double &weight : weights_) weight = greatest * spacing_ * spacing_ * random_.unit();
    }

    std::vector<WeightLine> run() {
        progress_.begin(fmt::format("{}D, {} weights up to {:g}", dimension, n_, greatest_),
                        efforts_.n_builds + 2 * (n_warm + efforts_.n_steps));
        build();
        const double step_seconds = step("step", true);
        const double weights_seconds = step("weights", false);
        add("weights", "deldrift/step", step_seconds, weights_seconds, 1);
        for (WeightLine &line : lines_) line.hidden = static_cast<double>(n_hidden_) / static_cast<double>(n_);
        return lines_;
    }

private:
    Owner made() const {
        deldrift_options options;
        deldrift_options_init(&options);
        options.threads = 1;
        deldrift_triangulation *t = nullptr;
        require(deldrift_create_weighted(dimension, positions_.data(), weights_.data(), nullptr, n_, &options, &t),
                "deldrift_create_weighted");
        return Owner(t);
    }

    /// Lays the points out for CGAL, off the clock.
    void lay_out() {
        input_.clear();
        for (std::size_t id = 0; id < n_; ++id)
            input_.emplace_back(Space::place(&positions_[id * dimension]),
                                WeightAndId{weights_[id], static_cast<std::uint32_t>(id)});
    }

    void build() {
        std::vector<double> of_cgal, of_deldrift;
        for (std::size_t i = 0; i < efforts_.n_builds; ++i) {
            lay_out();
            cgal_ = std::make_unique<typename Space::Triangulation>();
            of_cgal.push_back(seconds_of([&] { insert_weighted<dimension>(*cgal_, input_); }));
            triangulation_.reset();
            of_deldrift.push_back(seconds_of([&] { triangulation_ = made(); }));
            progress_.step();
        }
        read_deldrift();
        of_cgal_ = reading_.write(*cgal_);
        compare("build");
        add("build", "cgal/regular", median(of_cgal), median(of_deldrift), wanted_of_builds[dimension - 2]);
    }

    /// Steps in which all weights change, and all places if `places` says so; the seconds that deldrift takes.
    double step(const char *timed, bool places) {
        std::vector<double> of_cgal, of_deldrift;
        for (std::size_t k = 0; k < n_warm + efforts_.n_steps; ++k) {
            if (places) move_places();
            for (double &weight : weights_) weight += random_.symmetric(step_length * spacing_ * spacing_);
            const double seconds = seconds_of([&] {
                require(deldrift_commit_weighted(triangulation_.get(), places ? positions_.data() : nullptr,
                                                 weights_.data(), n_, nullptr),
                        "deldrift_commit_weighted");
                read_deldrift();
            });
            if (k >= n_warm) {
                of_deldrift.push_back(seconds);
                lay_out();
                of_cgal.push_back(seconds_of([&] {
                    cgal_->clear();
                    insert_weighted<dimension>(*cgal_, input_);
                    of_cgal_ = reading_.write(*cgal_);
                }));
                compare(timed);
            }
            progress_.step();
        }
        add(timed, "cgal/regular", median(of_cgal), median(of_deldrift), places ? wanted_of_steps[dimension - 2] : 0);
        return median(of_deldrift);
    }

    /// Every vertex goes so far in a random direction.
    void move_places() {
        for (std::size_t id = 0; id < n_; ++id) {
            double way[dimension], squared;
            do {
                random_.in_ball(dimension, 1, way);
                squared = 0;
                for (const double x : way) squared += x * x;
            } while (squared == 0);
            const double scale = step_length * spacing_ / std::sqrt(squared);
            for (unsigned axis = 0; axis < dimension; ++axis) positions_[id * dimension + axis] += scale * way[axis];
        }
    }

    void read_deldrift() { require(deldrift_cells(triangulation_.get(), &view_), "deldrift_cells"); }

    /// Cells, and the ids of those that are hidden, must be CGAL's.
    void compare(const char *timed) {
        std::vector<std::uint32_t> all(n_);
        std::iota(all.begin(), all.end(), 0u);
        const std::vector<std::uint32_t> of_cgal = ids_of(of_cgal_.vertices, of_cgal_.n_cells);
        const CellSet ours = canonical(dimension, ids_of(view_.vertices, view_.count), all);
        if (ours != canonical(dimension, of_cgal, all)) refuse(timed, "cells");
        std::vector<bool> is_shown(n_);
        for (const std::uint32_t id : of_cgal) is_shown[id] = true;
        std::vector<std::uint32_t> hidden(n_);
        require(deldrift_hidden_by_weight(triangulation_.get(), hidden.data(), nullptr, n_, &n_hidden_),
                "deldrift_hidden_by_weight");
        hidden.resize(n_hidden_);
        all.erase(std::remove_if(all.begin(), all.end(), [&](std::uint32_t id) { return is_shown[id]; }), all.end());
        if (hidden != all || n_hidden_ != Space::n_hidden(*cgal_)) refuse(timed, "hidden vertices");
        ++checks_.n_comparisons;
        checks_.n_cells += view_.count;
        checks_.n_hidden += n_hidden_;
    }

    [[noreturn]] void refuse(const char *timed, const char *what) const {
        throw std::runtime_error(
            fmt::format("{}D {}, weights up to {:g}: other {} than CGAL's", dimension, timed, greatest_, what));
    }

    static std::vector<std::uint32_t> ids_of(const std::uint32_t *vertices, std::size_t n_cells) {
        return {vertices, vertices + n_cells * (dimension + 1)};
    }

    void add(const char *timed, const char *reference, double reference_seconds, double contender_seconds,
             double wanted) {
        const double scale = 1e9 / static_cast<double>(n_);
        lines_.push_back({dimension, n_, greatest_, 0, timed, reference, "deldrift", scale * reference_seconds,
                          scale * contender_seconds, greatest_ == with_wanted ? wanted : 0});
    }

    std::size_t n_;
    double greatest_;
    WeightEfforts efforts_;
    Random random_;
    WeightChecks &checks_;
    Progress &progress_;
    double spacing_ = 0;
    std::size_t n_hidden_ = 0;
    std::vector<double> positions_;
    std::vector<double> weights_;
    std::vector<typename Space::WeightedInput> input_;
    std::unique_ptr<typename Space::Triangulation> cgal_;
    CgalReading<dimension, Space> reading_;
    Reading of_cgal_;
    Owner triangulation_;
    deldrift_cells_view view_{};
    std::vector<WeightLine> lines_;
};

}  // namespace

std::vector<WeightLine> measure_weights(unsigned dimension, std::size_t n_points, double greatest,
                                        const WeightEfforts &efforts, std::uint64_t seed, WeightChecks &checks,
                                        Progress &progress) {
    if (dimension == 2) return Measurement<2>(n_points, greatest, efforts, seed, checks, progress).run();
    return Measurement<3>(n_points, greatest, efforts, seed, checks, progress).run();
}

void run_weights(const Options &options) {
    keep_memory();
    Progress progress;
    WeightChecks checks;
    const bool is_smoke = options.preset.name == "smoke", is_whole = options.task == Task::weights;
    const WeightEfforts efforts = is_smoke ? WeightEfforts{1, 1} : is_whole ? WeightEfforts{5, 5} : WeightEfforts{2, 2};
    std::vector<std::size_t> sizes = {is_smoke ? std::size_t{1'000} : std::size_t{20'000}};
    if (is_whole && !is_smoke) sizes.push_back(100'000);
    std::vector<std::vector<std::string>> lines = {{"dimension", "n", "weights", "hidden", "timed", "reference",
                                                    "reference_ns", "contender", "contender_ns", "ratio", "wanted",
                                                    "verdict"}};
    for (const unsigned dimension : {2u, 3u})
        for (const std::size_t n : sizes)
            for (const double greatest : greatest_weights)
                for (const WeightLine &line :
                     measure_weights(dimension, n, greatest, efforts, options.seed, checks, progress))
                    lines.push_back(line_of(line.dimension, line.n_points, significant(line.greatest, 2),
                                            significant(line.hidden, 2), line.timed, line.reference,
                                            significant(line.reference_ns, 4), line.contender,
                                            significant(line.contender_ns, 4), significant(line.ratio(), 3),
                                            line.wanted == 0 ? "" : significant(line.wanted, 3), line.verdict()));
    if (is_whole) {
        publish(options.results, "weights.csv", lines);
    } else {
        TextTable table(lines.front());
        std::for_each(lines.begin() + 1, lines.end(), [&](const auto &line) { table.add(line); });
        table.print(std::cout);
    }
    fmt::print("cells and hidden vertices compared with CGAL's: {} times, {} cells, {} hidden\n", checks.n_comparisons,
               checks.n_cells, checks.n_hidden);
}

}  // namespace bench
