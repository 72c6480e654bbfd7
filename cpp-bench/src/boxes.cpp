// SPDX-License-Identifier: GPL-3.0-or-later
#include "boxes.hpp"

#include "cgal_boxes.hpp"
#include "library.hpp"
#include "random.hpp"
#include "replay.hpp"
#include "table.hpp"

#ifdef DELDRIFT_BENCH_VOROPP
#include <voro++/voro++.hh>
#endif

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <stdexcept>

namespace bench {
namespace {

/// Beside an open triangulation of the same points a periodic one may take 1.3 times as long.
constexpr double wanted_of_open = 1 / 1.3;
constexpr double wanted_of_steps = 12;

/// In so many timestamps DELDRIFT_AUTO has found out how vertices move.
constexpr std::size_t n_warm = 3;
constexpr double step_lengths[] = {1e-4, 1e-3, 1e-2};

/// Places are multiples of this, so that nobody has to round them.
constexpr double grid = 0x1.0p-40;

/// A cell as the ids of its corners, ascending, and their shifts beside that of the first.
template <unsigned dimension>
using Class = std::array<std::int64_t, (dimension + 1) * (dimension + 1)>;

template <unsigned dimension, typename Shift>
Class<dimension> class_of(const std::uint32_t *ids, const Shift *shifts) {
    std::array<unsigned, dimension + 1> order;
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](unsigned i, unsigned k) { return ids[i] < ids[k]; });
    Class<dimension> cell;
    std::size_t at = 0;
    for (const unsigned i : order) {
        cell[at++] = ids[i];
        for (unsigned axis = 0; axis < dimension; ++axis) cell[at++] = shifts[i][axis] - shifts[order[0]][axis];
    }
    return cell;
}

struct Destroy {
    void operator()(deldrift_triangulation *t) const noexcept { deldrift_destroy(t); }
};
using Owner = std::unique_ptr<deldrift_triangulation, Destroy>;

deldrift_options options_of_one_thread() {
    deldrift_options options;
    deldrift_options_init(&options);
    options.threads = 1;
    return options;
}

template <typename Call>
double seconds_of(Call call) {
    const Stopwatch watch;
    call();
    return watch.seconds();
}

template <unsigned dimension>
class Measurement {
public:
    Measurement(std::size_t n_points, const BoxEfforts &efforts, std::uint64_t seed, BoxChecks &checks,
                Progress &progress)
        : n_(n_points), efforts_(efforts), random_(seed), checks_(checks), progress_(progress) {
        spacing_ = std::pow(static_cast<double>(n_), -1.0 / dimension);
        positions_.resize(n_ * dimension);
        for (double &x : positions_) x = std::floor(random_.unit() / grid) * grid;
    }

    std::vector<BoxLine> run() {
        progress_.begin(fmt::format("{}D box of {} vertices", dimension, n_),
                        efforts_.n_builds + std::size(step_lengths) * (n_warm + efforts_.n_steps));
        build();
        for (const double length : step_lengths) step(length);
        return lines_;
    }

private:
    using Box = CgalBox<dimension>;

    Owner periodic() const {
        double vectors[dimension * dimension] = {};
        for (unsigned axis = 0; axis < dimension; ++axis) vectors[axis * (dimension + 1)] = 1;
        const deldrift_options options = options_of_one_thread();
        deldrift_triangulation *t = nullptr;
        require(deldrift_create_periodic(dimension, positions_.data(), n_, vectors, dimension, &options, &t),
                "deldrift_create_periodic");
        return Owner(t);
    }
    Owner open() const {
        const deldrift_options options = options_of_one_thread();
        deldrift_triangulation *t = nullptr;
        require(deldrift_create(dimension, positions_.data(), n_, &options, &t), "deldrift_create");
        return Owner(t);
    }
    void commit(const Owner &t) const {
        require(deldrift_commit_positions(t.get(), positions_.data(), n_, nullptr), "deldrift_commit_positions");
    }

    /// CGAL, rebuilt by its bulk insertion: the points are laid out off the clock.
    double rebuild_cgal() {
        std::vector<typename Box::Point> points;
        for (std::size_t id = 0; id < n_; ++id) points.push_back(Box::point(&positions_[id * dimension]));
        return seconds_of([&] {
            cgal_ = std::make_unique<typename Box::Triangulation>(Box::domain());
            cgal_->insert(points.begin(), points.end(), true);
        });
    }

    void build() {
        std::vector<double> cgal, of_periodic, of_open;
        for (std::size_t i = 0; i < efforts_.n_builds; ++i) {
            cgal.push_back(rebuild_cgal());
            of_periodic.push_back(seconds_of([&] { periodic_ = periodic(); }));
            of_open.push_back(seconds_of([&] { open_ = open(); }));
            progress_.step();
        }
        compare("build");
        add("build", "cgal/periodic", median(cgal), "deldrift/periodic", median(of_periodic), 0);
        add("build", "deldrift/open", median(of_open), "deldrift/periodic", median(of_periodic), wanted_of_open);
    }

    /// Every vertex goes so far, and comes back on the other side of the box.
    void step(double length) {
        const std::string timed = fmt::format("step_{:g}", length);
        std::vector<double> cgal, of_periodic, of_open, volumes, of_voropp;
        for (std::size_t k = 0; k < n_warm + efforts_.n_steps; ++k) {
            std::vector<double> unwrapped(positions_.size());
            for (std::size_t id = 0; id < n_; ++id) {
                double way[dimension];
                do random_.in_ball(dimension, 1, way);
                while (norm(way) == 0);
                const double scale = length * spacing_ / norm(way);
                for (unsigned axis = 0; axis < dimension; ++axis) {
                    double &x = positions_[id * dimension + axis];
                    x = std::floor((x + scale * way[axis]) / grid) * grid;
                    x -= std::floor(x);
                }
            }
            const double in_periodic = seconds_of([&] { commit(periodic_); });
            // The open triangulation has no sides to come back on: few of its vertices leap.
            const double in_open = seconds_of([&] { commit(open_); });
            std::vector<double> numbers(n_);
            std::size_t count = 0;
            const double in_volumes = seconds_of([&] {
                require(deldrift_voronoi_volumes(periodic_.get(), nullptr, nullptr, numbers.data(), n_, &count),
                        "deldrift_voronoi_volumes");
            });
            check_sum(timed, numbers);
            if (k >= n_warm) {
                cgal.push_back(rebuild_cgal());
                of_periodic.push_back(in_periodic);
                of_open.push_back(in_open);
                volumes.push_back(in_volumes);
                if (has_voropp() && dimension == 3) of_voropp.push_back(run_voropp(numbers));
                compare(timed);
            }
            progress_.step();
        }
        add(timed, "cgal/periodic", median(cgal), "deldrift/periodic", median(of_periodic),
            length == 1e-3 ? wanted_of_steps : 0);
        add(timed, "deldrift/open", median(of_open), "deldrift/periodic", median(of_periodic), wanted_of_open);
        if (!of_voropp.empty()) {
            const double step_and_volumes = median(of_periodic) + median(volumes);
            add(timed + " and volumes", "voro++", median(of_voropp), "deldrift/periodic", step_and_volumes, 0);
        }
    }

    static double norm(const double *way) {
        double squared = 0;
        for (unsigned axis = 0; axis < dimension; ++axis) squared += way[axis] * way[axis];
        return std::sqrt(squared);
    }

    void check_sum(const std::string &timed, const std::vector<double> &volumes) const {
        const double sum = std::accumulate(volumes.begin(), volumes.end(), 0.0);
        if (!(std::abs(sum - 1) <= 1e-12))
            throw std::runtime_error(fmt::format("{}D {}: the volumes add up to 1 + {}", dimension, timed, sum - 1));
    }

    /// The seconds that voro++ takes for all volumes, which are those of deldrift.
    double run_voropp(const std::vector<double> &volumes) const {
#ifdef DELDRIFT_BENCH_VOROPP
        // Blocks of some five points are what voro++'s manual calls best.
        const int blocks = std::max(1, static_cast<int>(std::cbrt(static_cast<double>(n_) / 5)));
        std::vector<double> found(n_);
        const double seconds = seconds_of([&] {
            voro::container container(0, 1, 0, 1, 0, 1, blocks, blocks, blocks, true, true, true, 8);
            for (std::size_t id = 0; id < n_; ++id)
                container.put(static_cast<int>(id), positions_[3 * id], positions_[3 * id + 1], positions_[3 * id + 2]);
            voro::c_loop_all loop(container);
            voro::voronoicell cell;
            if (loop.start()) do
                if (container.compute_cell(cell, loop)) found[static_cast<std::size_t>(loop.pid())] = cell.volume();
            while (loop.inc());
        });
        for (std::size_t id = 0; id < n_; ++id)
            if (!(std::abs(found[id] - volumes[id]) <= 1e-6 / static_cast<double>(n_)))
                throw std::runtime_error(
                    fmt::format("the volume of vertex {} is {}, and {} by voro++", id, volumes[id], found[id]));
        return seconds;
#else
        (void)volumes;
        return 0;
#endif
    }

    std::vector<Class<dimension>> cells_of_deldrift() const {
        deldrift_cells_view view;
        require(deldrift_cells(periodic_.get(), &view), "deldrift_cells");
        std::vector<std::array<std::int64_t, dimension>> shifts(view.count * (dimension + 1));
        std::size_t count = 0;
        require(deldrift_cell_shifts(periodic_.get(), shifts.front().data(), nullptr, view.count, &count),
                "deldrift_cell_shifts");
        std::vector<Class<dimension>> cells;
        for (std::size_t cell = 0; cell < view.count; ++cell)
            cells.push_back(class_of<dimension>(view.vertices + cell * (dimension + 1),
                                                shifts.data() + cell * (dimension + 1)));
        std::sort(cells.begin(), cells.end());
        return cells;
    }

    std::vector<Class<dimension>> cells_of_cgal() const {
        if (!cgal_->is_1_cover()) throw std::runtime_error("CGAL has several copies of the box");
        std::map<std::array<double, dimension>, std::uint32_t> ids;
        for (std::size_t id = 0; id < n_; ++id) {
            std::array<double, dimension> place;
            std::copy_n(&positions_[id * dimension], dimension, place.begin());
            ids.emplace(place, static_cast<std::uint32_t>(id));
        }
        std::vector<Class<dimension>> cells;
        Box::for_each_cell(*cgal_, [&](const auto &corners, const auto &shifts) {
            std::uint32_t of_corners[dimension + 1];
            for (unsigned i = 0; i <= dimension; ++i) of_corners[i] = ids.at(Box::coordinates(corners[i]));
            cells.push_back(class_of<dimension>(of_corners, shifts.data()));
        });
        std::sort(cells.begin(), cells.end());
        return cells;
    }

    void compare(const std::string &timed) {
        const auto ours = cells_of_deldrift(), theirs = cells_of_cgal();
        ++checks_.n_comparisons;
        checks_.n_cells += ours.size();
        if (ours != theirs)
            throw std::runtime_error(fmt::format("{}D {}: {} cells, and {} by CGAL, or others", dimension, timed,
                                                 ours.size(), theirs.size()));
    }

    void add(const std::string &timed, const char *reference, double reference_seconds, const char *contender,
             double contender_seconds, double wanted) {
        const double scale = 1e9 / static_cast<double>(n_);
        lines_.push_back({dimension, n_, timed, reference, contender, scale * reference_seconds,
                          scale * contender_seconds, wanted});
    }

    std::size_t n_;
    BoxEfforts efforts_;
    Random random_;
    BoxChecks &checks_;
    Progress &progress_;
    double spacing_ = 0;
    std::vector<double> positions_;
    std::unique_ptr<typename Box::Triangulation> cgal_;
    Owner periodic_;
    Owner open_;
    std::vector<BoxLine> lines_;
};

BoxEfforts efforts_of(const Preset &preset) {
    if (preset.name == "smoke") return {1, 1};
    return {3, 5};
}

}  // namespace

bool has_voropp() {
#ifdef DELDRIFT_BENCH_VOROPP
    return true;
#else
    return false;
#endif
}

std::vector<BoxLine> measure_box(unsigned dimension, std::size_t n_points, const BoxEfforts &efforts, std::uint64_t seed,
                                 BoxChecks &checks, Progress &progress) {
    if (dimension == 2) return Measurement<2>(n_points, efforts, seed, checks, progress).run();
    return Measurement<3>(n_points, efforts, seed, checks, progress).run();
}

void run_boxes(const Options &options) {
    keep_memory();
    Progress progress;
    BoxChecks checks;
    std::vector<std::vector<std::string>> lines = {{"dimension", "n", "timed", "reference", "reference_ns", "contender",
                                                    "contender_ns", "ratio", "wanted", "verdict"}};
    for (const unsigned dimension : {2u, 3u})
        for (const std::size_t n : options.preset.domain_sizes)
            for (const BoxLine &line :
                 measure_box(dimension, n, efforts_of(options.preset), options.seed, checks, progress))
                lines.push_back(line_of(line.dimension, line.n_points, line.timed, line.reference,
                                        significant(line.reference_ns, 4), line.contender,
                                        significant(line.contender_ns, 4), significant(line.ratio(), 3),
                                        line.wanted == 0 ? "" : significant(line.wanted, 3), line.verdict()));
    publish(options.results, "boxes.csv", lines);
    fmt::print("cells compared with CGAL's: {} times, {} cells\n", checks.n_comparisons, checks.n_cells);
    if (!has_voropp()) fmt::print("voro++ is left out: it was not there (on Debian: apt-get install voro++-dev)\n");
}

}  // namespace bench
