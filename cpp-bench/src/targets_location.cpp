// SPDX-License-Identifier: GPL-3.0-or-later
// Point location beside CGAL: random places beside its hierarchies, a path beside walks from the last answer, and
// insertions anywhere.
#include "cgal_space.hpp"
#include "library.hpp"
#include "random.hpp"
#include "replay.hpp"
#include "scenarios.hpp"
#include "targets.hpp"
#include "verify.hpp"

#include <CGAL/Triangulation_hierarchy_2.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace bench {
namespace {

/// A random query may take 0.7 of what CGAL's hierarchies take, one on a path as long as CGAL's from the last answer.
constexpr double wanted_of_queries = 1 / 0.7;
constexpr double wanted_of_paths = 1;
constexpr double wanted_of_insertions = 1;

constexpr std::size_t n_turns = 3;
constexpr std::size_t most_places = 20'000;
/// A path goes so many spacings at a time.
constexpr double stride = 0.1;

using VertexBase = CGAL::Triangulation_hierarchy_vertex_base_2<CGAL::Triangulation_vertex_base_2<CgalKernel>>;
using Plane = CGAL::Delaunay_triangulation_2<CgalKernel>;
using Space = CGAL::Delaunay_triangulation_3<CgalKernel>;
using PlaneHierarchy = CGAL::Triangulation_hierarchy_2<
    CGAL::Delaunay_triangulation_2<CgalKernel, CGAL::Triangulation_data_structure_2<VertexBase>>>;
using SpaceHierarchy = CGAL::Delaunay_triangulation_3<CgalKernel, CGAL::Fast_location>;

template <unsigned dimension> struct Of;
template <> struct Of<2> {
    using Walking = Plane;
    using Jumping = PlaneHierarchy;
    using Point = Plane::Point;
    static Point point(const double *p) { return {p[0], p[1]}; }
};
template <> struct Of<3> {
    using Walking = Space;
    using Jumping = SpaceHierarchy;
    using Point = Space::Point;
    static Point point(const double *p) { return {p[0], p[1], p[2]}; }
};

/// Places one after the other.
struct Places {
    unsigned dimension;
    std::vector<double> coordinates = {};

    std::size_t count() const { return coordinates.size() / dimension; }
    const double *at(std::size_t i) const { return &coordinates[i * dimension]; }

    static Places anywhere(unsigned dimension, std::size_t count, Random &random) {
        Places places{dimension};
        for (std::size_t i = 0; i < count * dimension; ++i) places.coordinates.push_back(random.unit());
        return places;
    }

    /// A straight path through the middle of the unit box, and back at its ends.
    static Places along_a_path(unsigned dimension, std::size_t count, double step, Random &random) {
        Places places{dimension};
        double place[3] = {0.5, 0.5, 0.5}, direction[3] = {0, 0, 0};
        random.in_ball(dimension, 1, direction);
        const double scale = step / std::hypot(direction[0], direction[1], direction[2]);
        for (std::size_t i = 0; i < count; ++i)
            for (unsigned axis = 0; axis < dimension; ++axis) {
                const double next = place[axis] + scale * direction[axis];
                if (next < 0.1 || next > 0.9) direction[axis] = -direction[axis];
                place[axis] += scale * direction[axis];
                places.coordinates.push_back(place[axis]);
            }
        return places;
    }
};

/// The library's triangulation.
class Ours {
public:
    Ours(unsigned dimension, const Series &series) : triangulation_(nullptr, &deldrift_destroy), dimension_(dimension) {
        deldrift_triangulation *triangulation = nullptr;
        deldrift_options options;
        deldrift_options_init(&options);
        options.threads = 1;
        require(deldrift_create(dimension, series.frame(0), series.n_points, &options, &triangulation), "deldrift_create");
        triangulation_.reset(triangulation);
    }

    void locate(const Places &places) {
        found_.resize(places.count());
        for (std::size_t i = 0; i < places.count(); ++i)
            require(deldrift_locate(triangulation_.get(), places.at(i), &found_[i]), "deldrift_locate");
    }

    void follow(const Places &places) {
        found_.resize(places.count());
        require(deldrift_locate_points(triangulation_.get(), places.at(0), places.count(), nullptr, found_.data()),
                "deldrift_locate_points");
    }

    void insert(const Places &places) {
        std::uint32_t vertex;
        for (std::size_t i = 0; i < places.count(); ++i)
            require(deldrift_insert_vertex(triangulation_.get(), places.at(i), &vertex), "deldrift_insert_vertex");
    }

    /// Sum of the first coordinates of the corners of all cells found.
    double sum() const {
        deldrift_cells_view cells;
        require(deldrift_cells(triangulation_.get(), &cells), "deldrift_cells");
        double sum = 0, position[3];
        for (const deldrift_location &location : found_) {
            if (location.kind != DELDRIFT_LOCATION_CELL) continue;
            for (unsigned i = 0; i <= dimension_; ++i) {
                const std::uint32_t vertex = cells.vertices[location.index * (dimension_ + 1) + i];
                require(deldrift_position(triangulation_.get(), vertex, position), "deldrift_position");
                sum += position[0];
            }
        }
        return sum;
    }

private:
    std::unique_ptr<deldrift_triangulation, decltype(&deldrift_destroy)> triangulation_;
    unsigned dimension_;
    std::vector<deldrift_location> found_;
};

/// One of CGAL's, with a hint or without.
template <unsigned dimension, typename Triangulation>
class Theirs {
public:
    explicit Theirs(const Series &series) {
        std::vector<typename Of<dimension>::Point> points;
        for (std::size_t i = 0; i < series.n_points; ++i) points.push_back(point(series.frame(0) + i * dimension));
        triangulation_.insert(points.begin(), points.end());
    }

    void locate(const Places &places) {
        found_.resize(places.count());
        for (std::size_t i = 0; i < places.count(); ++i) found_[i] = triangulation_.locate(point(places.at(i)));
    }

    void follow(const Places &places) {
        found_.resize(places.count());
        auto last = triangulation_.locate(point(places.at(0)));
        for (std::size_t i = 0; i < places.count(); ++i)
            last = found_[i] = triangulation_.locate(point(places.at(i)), last);
    }

    void insert(const Places &places) {
        for (std::size_t i = 0; i < places.count(); ++i) triangulation_.insert(point(places.at(i)));
    }

    double sum() const {
        double sum = 0;
        for (const auto &cell : found_) {
            if (triangulation_.is_infinite(cell)) continue;
            for (unsigned i = 0; i <= dimension; ++i) sum += cell->vertex(static_cast<int>(i))->point().x();
        }
        return sum;
    }

private:
    static auto point(const double *p) { return Of<dimension>::point(p); }

    Triangulation triangulation_;
    std::vector<decltype(triangulation_.locate(point(nullptr)))> found_;
};

/// Nanoseconds per place of both, in turn; each is made ready by a turn that does not count.
template <typename Draw, typename Reference, typename Contender>
std::pair<double, double> race(Draw draw, Reference reference, Contender contender) {
    double seconds[2] = {0, 0};
    std::size_t n_places = 0;
    for (std::size_t turn = 0; turn <= n_turns; ++turn) {
        const Places places = draw();
        const Stopwatch first;
        reference(places);
        const double by_reference = first.seconds();
        const Stopwatch second;
        contender(places);
        if (turn == 0) continue;
        seconds[0] += by_reference;
        seconds[1] += second.seconds();
        n_places += places.count();
    }
    const double scale = 1e9 / static_cast<double>(n_places);
    return {scale * seconds[0], scale * seconds[1]};
}

void compare(double a, double b, const std::string &what) {
    if (std::fabs(a - b) > 1e-9 * std::fabs(a)) throw Mismatch(what + ": the cells found are not the same", 1);
}

template <unsigned dimension>
std::vector<Target> locate_in(std::size_t n_points, const TargetSizes &sizes, std::uint64_t seed, Progress &progress) {
    const Series series = uniform_points(dimension, n_points, seed);
    const std::size_t n_places = std::min(most_places, n_points);
    Random random(seed + 7);
    progress.begin(fmt::format("location among {} points, {}D", n_points, dimension), 3);
    std::vector<Target> targets;
    Ours ours(dimension, series);
    const auto anywhere = [&] { return Places::anywhere(dimension, n_places, random); };
    const auto add = [&](const char *what, const char *reference, const char *contender, std::pair<double, double> ns,
                         double wanted) {
        if (sizes.has(what))
            targets.push_back({what, dimension, n_points, reference, contender, ns.first, ns.second, wanted, 0, 0});
        progress.step();
    };
    if (sizes.has("locate_path")) {
        Theirs<dimension, typename Of<dimension>::Walking> walking(series);
        const double step = stride / std::pow(static_cast<double>(n_points), 1.0 / dimension);
        const auto path = [&] { return Places::along_a_path(dimension, n_places, step, random); };
        const auto ns = race(path, [&](const Places &p) { walking.follow(p); }, [&](const Places &p) { ours.follow(p); });
        compare(walking.sum(), ours.sum(), "locate_path");
        add("locate_path", "cgal/locate from the last", "deldrift/locate_points", ns, wanted_of_paths);
    }
    if (!sizes.has("locate") && !sizes.has("insert")) return targets;
    Theirs<dimension, typename Of<dimension>::Jumping> jumping(series);
    const auto ns = race(anywhere, [&](const Places &p) { jumping.locate(p); }, [&](const Places &p) { ours.locate(p); });
    compare(jumping.sum(), ours.sum(), "locate");
    add("locate", "cgal/hierarchy", "deldrift/locate", ns, wanted_of_queries);
    if (sizes.has("insert")) {
        const auto inserted =
            race(anywhere, [&](const Places &p) { jumping.insert(p); }, [&](const Places &p) { ours.insert(p); });
        add("insert", "cgal/hierarchy insert", "deldrift/insert_vertex", inserted, wanted_of_insertions);
        const Places places = anywhere();
        jumping.locate(places);
        ours.locate(places);
        compare(jumping.sum(), ours.sum(), "insert");
    }
    return targets;
}

}  // namespace

std::vector<Target> location_targets(unsigned dimension, const TargetSizes &sizes, std::uint64_t seed,
                                     Progress &progress) {
    std::vector<Target> targets;
    if (!sizes.has("locate") && !sizes.has("locate_path") && !sizes.has("insert")) return targets;
    for (const std::size_t n_points : sizes.grown) {
        const std::vector<Target> more = dimension == 2 ? locate_in<2>(n_points, sizes, seed, progress)
                                                        : locate_in<3>(n_points, sizes, seed, progress);
        targets.insert(targets.end(), more.begin(), more.end());
    }
    return targets;
}

}  // namespace bench
