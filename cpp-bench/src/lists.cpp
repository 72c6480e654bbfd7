// SPDX-License-Identifier: GPL-3.0-or-later
#include "lists.hpp"

#include "library.hpp"
#include "random.hpp"
#include "replay.hpp"
#include "verify.hpp"

#include <fmt/format.h>

#ifdef DELDRIFT_BENCH_NANOFLANN
#include <nanoflann.hpp>
#endif

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

namespace bench {
namespace {

/// Lists may take twice as long as by linked cells, with which they are neither exact nor in order, and as long as by a tree.
constexpr double wanted_of_cells = 0.5;
constexpr double wanted_of_tree = 1;
constexpr std::size_t n_turns = 3;
/// Neighbours that a vertex has in the mean, in 2D and 3D.
constexpr double n_neighbours[] = {19, 50};
/// A cluster is so many times as narrow as what it is in, and has fewer points, as by linked cells it takes their square.
constexpr double narrow = 1e-3;
constexpr std::size_t fewer = 10;
const char *const names[] = {"lists", "lists_lattice", "lists_cluster"};

struct Rows {
    std::vector<std::size_t> offsets;
    std::vector<std::uint32_t> entries;
};

struct Input {
    std::string name;
    unsigned dimension;
    std::vector<double> positions;
    double radius;
    std::size_t count() const { return positions.size() / dimension; }
};

/// Points with a spacing of 1 in the mean: random ones, a lattice that is shuffled, or random ones of which half are in a cluster.
Input input(const std::string &name, unsigned dimension, std::size_t n, std::uint64_t seed) {
    Random random(seed);
    const double side = std::ceil(std::pow(static_cast<double>(n), 1.0 / dimension));
    Input made{name, dimension, {}, 0};
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t rest = i;
        const bool is_in_cluster = name == "lists_cluster" && i % 2 == 0;
        for (unsigned axis = 0; axis < dimension; ++axis) {
            const auto step = static_cast<double>(rest % static_cast<std::size_t>(side));
            rest /= static_cast<std::size_t>(side);
            const double place = name == "lists_lattice" ? step : side * random.unit();
            made.positions.push_back(is_in_cluster ? side / 3 + narrow * place : place);
        }
    }
    const double measure = dimension == 2 ? M_PI : 4 * M_PI / 3;
    made.radius = std::pow(n_neighbours[dimension - 2] / measure, 1.0 / dimension);
    // In a cluster as many are near as elsewhere.
    if (name == "lists_cluster") made.radius *= narrow;
    for (std::size_t i = n; i > 1; --i) {
        const auto j = static_cast<std::size_t>(random.unit() * static_cast<double>(i));
        for (unsigned axis = 0; axis < dimension; ++axis)
            std::swap(made.positions[(i - 1) * dimension + axis], made.positions[j * dimension + axis]);
    }
    return made;
}

/// As molecular dynamics makes them: cells as wide as the radius, or wider where these would be more than there are points,
/// each with a list that is linked through the points in it.
template <unsigned dimension>
void by_linked_cells(const Input &input, Rows &rows) {
    const double *const p = input.positions.data();
    const std::size_t n = input.count();
    double low[dimension], extent = 0;
    for (unsigned axis = 0; axis < dimension; ++axis) {
        double high = low[axis] = p[axis];
        for (std::size_t i = 0; i < n; ++i) {
            low[axis] = std::min(low[axis], p[i * dimension + axis]);
            high = std::max(high, p[i * dimension + axis]);
        }
        extent = std::max(extent, high - low[axis]);
    }
    const double most = std::floor(std::pow(static_cast<double>(n), 1.0 / dimension)) + 1;
    const auto side = static_cast<std::size_t>(std::clamp(std::floor(extent / input.radius), 1.0, most));
    const double scale = static_cast<double>(side) / (extent * (1 + 1e-12));
    std::vector<std::int32_t> first(static_cast<std::size_t>(std::pow(side, dimension) + 0.5), -1), next(n);
    const auto step_of = [&](std::size_t i, unsigned axis) {
        return static_cast<std::int64_t>((p[i * dimension + axis] - low[axis]) * scale);
    };
    for (std::size_t i = n; i-- > 0;) {
        std::size_t cell = 0;
        for (unsigned axis = dimension; axis-- > 0;) cell = cell * side + static_cast<std::size_t>(step_of(i, axis));
        next[i] = first[cell];
        first[cell] = static_cast<std::int32_t>(i);
    }
    rows.offsets.assign(1, 0);
    rows.entries.clear();
    const double squared_radius = input.radius * input.radius;
    for (std::size_t i = 0; i < n; ++i) {
        std::int64_t from[3] = {0, 0, 0}, to[3] = {0, 0, 0};
        for (unsigned axis = 0; axis < dimension; ++axis) {
            from[axis] = std::max<std::int64_t>(step_of(i, axis) - 1, 0);
            to[axis] = std::min(step_of(i, axis) + 1, static_cast<std::int64_t>(side) - 1);
        }
        for (std::int64_t z = from[2]; z <= to[2]; ++z)
            for (std::int64_t y = from[1]; y <= to[1]; ++y)
                for (std::int64_t x = from[0]; x <= to[0]; ++x) {
                    const auto wide = static_cast<std::int64_t>(side);
                    for (std::int32_t j = first[static_cast<std::size_t>((z * wide + y) * wide + x)]; j >= 0; j = next[j]) {
                        double square = 0;
                        for (unsigned axis = 0; axis < dimension; ++axis) {
                            const double way = p[i * dimension + axis] - p[static_cast<std::size_t>(j) * dimension + axis];
                            square += way * way;
                        }
                        if (square <= squared_radius && static_cast<std::size_t>(j) != i)
                            rows.entries.push_back(static_cast<std::uint32_t>(j));
                    }
                }
        rows.offsets.push_back(rows.entries.size());
    }
}

#ifdef DELDRIFT_BENCH_NANOFLANN
template <unsigned dimension>
struct Cloud {
    const Input &input;
    std::size_t kdtree_get_point_count() const { return input.count(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const { return input.positions[i * dimension + axis]; }
    template <class Box> bool kdtree_get_bbox(Box &) const { return false; }
};

template <unsigned dimension>
void by_nanoflann(const Input &input, Rows &rows) {
    using Metric = nanoflann::L2_Simple_Adaptor<double, Cloud<dimension>>;
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud<dimension>, dimension, std::uint32_t>;
    const Cloud<dimension> cloud{input};
    Tree tree(dimension, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
    tree.buildIndex();
    rows.offsets.assign(1, 0);
    rows.entries.clear();
    std::vector<std::pair<std::uint32_t, double>> found;
    nanoflann::SearchParams unsorted;
    unsorted.sorted = false;
    for (std::size_t i = 0; i < input.count(); ++i) {
        tree.radiusSearch(&input.positions[i * dimension], input.radius * input.radius, found, unsorted);
        for (const auto &[j, square] : found)
            if (j != i) rows.entries.push_back(j);
        rows.offsets.push_back(rows.entries.size());
    }
}
#endif

/// The library's lists of a triangulation, into buffers of the step before.
class Ours {
public:
    explicit Ours(const Input &input) : triangulation_(nullptr, &deldrift_destroy), squared_radius_(input.radius * input.radius) {
        deldrift_triangulation *triangulation = nullptr;
        deldrift_options options;
        deldrift_options_init(&options);
        options.threads = 1;
        require(deldrift_create(input.dimension, input.positions.data(), input.count(), &options, &triangulation),
                "deldrift_create");
        triangulation_.reset(triangulation);
        rows.offsets.resize(input.count() + 1);
    }

    void list(deldrift_pairs pairs) {
        std::size_t count = 0;
        deldrift_status status;
        while ((status = deldrift_neighbour_lists(triangulation_.get(), &squared_radius_, 1, nullptr, 0, pairs,
                                                  rows.offsets.data(), rows.offsets.size(), rows.entries.data(), nullptr,
                                                  rows.entries.size(), &count)) == DELDRIFT_BUFFER_TOO_SMALL ||
               (status == DELDRIFT_OK && count > rows.entries.size()))
            rows.entries.resize(count + count / 8);
        require(status, "deldrift_neighbour_lists");
        n_entries = count;
    }

    Rows rows{};
    std::size_t n_entries = 0;

private:
    std::unique_ptr<deldrift_triangulation, decltype(&deldrift_destroy)> triangulation_;
    double squared_radius_;
};

/// The number of entries, and a sum of them that depends on whose they are.
std::uint64_t digest(const Rows &rows, std::size_t n_entries) {
    std::uint64_t sum = n_entries;
    for (std::size_t i = 0; i + 1 < rows.offsets.size(); ++i)
        for (std::size_t k = rows.offsets[i]; k < rows.offsets[i + 1]; ++k)
            sum += (i + 1) * 0x9e3779b97f4a7c15u ^ rows.entries[k] * std::uint64_t{0xff51afd7ed558ccd};
    return sum;
}

/// Seconds of each in turn, after one that does not count.
std::vector<double> race(const std::vector<std::function<void()>> &runners) {
    std::vector<double> seconds(runners.size(), 0);
    for (std::size_t turn = 0; turn <= n_turns; ++turn)
        for (std::size_t i = 0; i < runners.size(); ++i) {
            const Stopwatch watch;
            runners[i]();
            if (turn > 0) seconds[i] += watch.seconds();
        }
    return seconds;
}

/// What one way to make lists took, for all of `n_turns`.
struct Time {
    const char *engine;
    double seconds;
};

/// By linked cells, by the library, and by nanoflann where that is there.
template <unsigned dimension>
std::vector<Time> measure(const std::string &name, std::size_t n, std::uint64_t seed) {
    const Input points = input(name, dimension, n, seed);
    Ours ours(points);
    Rows cells;
    std::vector<Time> times = {{"linked cells", 0}, {"deldrift", 0}};
    std::vector<std::function<void()>> runners = {[&] { by_linked_cells<dimension>(points, cells); },
                                                  [&] { ours.list(DELDRIFT_PAIRS_FULL); }};
#ifdef DELDRIFT_BENCH_NANOFLANN
    Rows tree;
    times.push_back({"nanoflann", 0});
    runners.emplace_back([&] { by_nanoflann<dimension>(points, tree); });
#endif
    const std::vector<double> seconds = race(runners);
    if (digest(cells, cells.entries.size()) != digest(ours.rows, ours.n_entries))
        throw Mismatch(name + ": the lists are not the same", 1);
    for (std::size_t i = 0; i < times.size(); ++i) times[i].seconds = seconds[i];
    return times;
}

/// Measures all sets of about `n` points that are wanted, and tells what each took.
template <typename Wanted, typename Tell>
void for_sets(unsigned dimension, std::size_t n, std::uint64_t seed, Progress &progress, Wanted is_wanted, Tell tell) {
    for (const std::string name : names) {
        if (!is_wanted(name)) continue;
        const std::size_t count = name == "lists_cluster" ? n / fewer : n;
        progress.begin(fmt::format("{} of {} points, {}D", name, count, dimension), 1);
        tell(name, count, dimension == 2 ? measure<2>(name, count, seed) : measure<3>(name, count, seed));
        progress.step();
    }
}

}  // namespace

std::vector<Target> list_targets(unsigned dimension, const TargetSizes &sizes, std::uint64_t seed, Progress &progress) {
    std::vector<Target> targets;
    const auto is_wanted = [&](const std::string &name) { return sizes.has(name); };
    for_sets(dimension, sizes.n_tested, seed, progress, is_wanted,
             [&](const std::string &name, std::size_t n, const std::vector<Time> &times) {
                 const double scale = 1e9 / static_cast<double>(n_turns * n);
                 const auto add = [&](const Time &reference, double wanted) {
                     targets.push_back({name, dimension, n, reference.engine, "deldrift/neighbour_lists",
                                        scale * reference.seconds, scale * times[1].seconds, wanted, 0, 0});
                 };
                 add(times[0], wanted_of_cells);
                 if (times.size() > 2) add(times[2], wanted_of_tree);
             });
    return targets;
}

std::vector<Row> list_rows(unsigned dimension, std::size_t n, std::uint64_t seed, Progress &progress) {
    std::vector<Row> rows;
    for_sets(dimension, n, seed, progress, [](const std::string &) { return true; },
             [&](const std::string &name, std::size_t count, const std::vector<Time> &times) {
                 for (const Time &time : times) {
                     Row row{fmt::format("{}_{}d", name, dimension), dimension, count, n_turns, time.engine, "lists"};
                     row.seconds = time.seconds;
                     row.timed = "lists";
                     rows.push_back(row);
                 }
             });
    return rows;
}

}  // namespace bench
