// SPDX-License-Identifier: GPL-3.0-or-later
// The report's algorithms on CGAL's triangulations, written from the report: Algorithm 1 (tolerance),
// Algorithm 2 (safe region), both together, and rebuilding until a sample of vertices stays within tolerance.
//
// CGAL's vertices are at the fixed positions; moving positions are kept beside them. As in the report,
// delimiters and tolerances are in doubles with the error bounds of its section 4, and a vertex that leaves
// its region is moved by the placement of its section 3.2: if no certificate of its star fails, only its
// coordinates change; else flips in the plane, insertion and removal in space.
//
// Three things are not as in the report:
// - The inner loop of Algorithm 2 tests m_w; the report prints m_z there.
// - The report leaves the hull out. Here the bi-cells with infinite cells have tolerances too: half the least
// width
//   of their d + 1 finite points, the displacement that could make a cell on the hull flat or the hull reflex
//   at a ridge. Vertices in such bi-cells are held by them in every algorithm.
// - Outside a delimiter, the way from the fixed to the moving position must be outside as well: otherwise a
// vertex
//   could jump across a delimiter and invert a cell.
// What remains as the report has it: in space a standard delimiter does not always prove its bi-cell
// (Proposition 1 fails where the line through the opposing vertices misses the facet). `verify` tells such
// cells from defects.
#include "engine.hpp"
#include "random.hpp"
#include "report_space.hpp"
#include "report_tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace bench {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// When rebuilding gives way to the tolerance algorithm (report, end of section 5.2): at the first of every
/// four timestamps 40 vertices are sampled.
constexpr unsigned sample_period = 4;
constexpr unsigned sample_size = 40;
constexpr double sample_share(unsigned dimension) { return dimension == 2 ? 0.75 : 0.55; }

/// A standard delimiter, as squares that computed squared distances can be compared with: rounding is well
/// below `slack`. All comparisons fail where there is no certain delimiter.
template <unsigned dimension>
struct Delimiter {
    static constexpr double slack = 0x1p-45;

    Place<dimension> centre{};
    double inside = std::numeric_limits<double>::quiet_NaN();
    double outside = std::numeric_limits<double>::quiet_NaN();

    bool has_inside(const double *p) const { return squared_distance<dimension>(centre.data(), p) < inside; }

    /// By Stewart's theorem a segment is nowhere nearer to the centre, in squares, than its nearer end less a
    /// quarter of its squared length.
    bool has_way_outside(const double *from, const double *to) const {
        const double nearer = std::min(squared_distance<dimension>(centre.data(), from),
                                       squared_distance<dimension>(centre.data(), to));
        return nearer > outside + squared_distance<dimension>(from, to) / 4 * (1 + slack);
    }
};

template <unsigned dimension>
Delimiter<dimension> standard_delimiter(const BicellPoints<dimension> &bicell, CoordinateBound bound) {
    Delimiter<dimension> delimiter;
    const std::array<Bounded, dimension> centre = annulus_centre<dimension>(bicell, bound);
    for (unsigned axis = 0; axis < dimension; ++axis) delimiter.centre[axis] = centre[axis].value;
    const auto distance = [&](const Place<dimension> &p) {
        return std::sqrt(squared_distance<dimension>(delimiter.centre.data(), p.data()));
    };
    double inner = 0;
    for (const Place<dimension> &p : bicell.facet) inner = std::max(inner, distance(p));
    const double outer = std::min(distance(bicell.opposing[0]), distance(bicell.opposing[1]));
    const double radius = (inner + outer) / 2;
    // Whatever the centre, a sphere that has the points on their sides is a delimiter.
    if (inner < radius * (1 - 4 * delimiter.slack) && outer > radius * (1 + 4 * delimiter.slack)) {
        delimiter.inside = radius * radius * (1 - delimiter.slack);
        delimiter.outside = radius * radius * (1 + delimiter.slack);
    }
    return delimiter;
}

struct Stamped {
    std::uint32_t stamp = 0;
};

template <unsigned dimension>
struct StampedWithDelimiters : Stamped {
    std::array<Delimiter<dimension>, dimension + 1> delimiters;  // by the corner opposite the facet
};

template <unsigned dimension, bool uses_tolerances, bool uses_regions>
class CgalReport : public Engine {
    using CellInfo = std::conditional_t<uses_regions, StampedWithDelimiters<dimension>, Stamped>;
    using Space = ReportSpace<dimension, CellInfo>;
    using Vertex = typename Space::Vertex;
    using Cell = typename Space::Cell;
    using InputPoint = typename Space::InputPoint;
    static constexpr unsigned n_corners = dimension + 1;

public:
    void prepare(const double *positions, std::size_t n_points) override {
        input_.clear();
        input_.reserve(n_points);
        // Of the positions before as well, as tolerances may be asked for there.
        greatest_ = std::exchange(greatest_laid_out_, 0);
        for (std::size_t id = 0; id < n_points; ++id) {
            input_.emplace_back(Space::point(positions + id * dimension),
                                VertexInfo{static_cast<std::uint32_t>(id), 0});
            for (unsigned axis = 0; axis < dimension; ++axis)
                greatest_laid_out_ =
                    std::max(greatest_laid_out_, std::fabs(positions[id * dimension + axis]));
        }
        greatest_ = std::max(greatest_, greatest_laid_out_);
    }

    void build(const double *positions, std::size_t n_points) override {
        rebuild();
        take_up(positions, n_points);
        compute_all();
    }

    void advance(const double *positions) override {
        // The static bounds hold for coordinates up to L only.
        if (greatest_ > bound_.value()) return build(positions, vertices_.size());
        for (std::size_t id = 0; id < vertices_.size(); ++id) relocate(id, positions + id * dimension);
    }

    std::vector<std::uint32_t> cells() override { return ids_of_cells<Space>(triangulation_); }

protected:
    /// CGAL's rebuilding, as the baseline does it.
    void rebuild() {
        triangulation_.clear();
        insert_sorted<Space>(triangulation_, input_);
    }

    /// Positions and vertices by id, after a rebuild. All vertices are at their fixed positions.
    void take_up(const double *positions, std::size_t n_points) {
        if (triangulation_.number_of_vertices() != n_points || triangulation_.dimension() != dimension)
            throw std::runtime_error(
                "two points at one place, or all in a plane: the report's algorithms know none");
        bound_ = CoordinateBound(greatest_);
        distance_error_ = squared_distance_error<dimension>(bound_);
        vertices_.assign(n_points, Vertex());
        for (auto vertex = triangulation_.finite_vertices_begin();
             vertex != triangulation_.finite_vertices_end(); ++vertex)
            vertices_[vertex->info().id] = vertex;
        fixed_.assign(positions, positions + n_points * dimension);
        moving_ = fixed_;
    }

    /// The pre-computations of either algorithm.
    void compute_all() {
        const std::size_t n_points = vertices_.size();
        displacement_.assign(n_points, 0);
        tolerance_.assign(n_points, infinity);
        hull_tolerance_.assign(uses_regions ? n_points : 0, infinity);
        is_queued_.assign(n_points, 0);
        made_.clear();
        Space::all_cells(triangulation_, made_);
        for (const Cell cell : made_) cell->info().stamp = 0;
        stamp_ = 0;
        for (const Cell cell : made_)
            for (unsigned corner = 0; corner < n_corners; ++corner)
                if (&*cell < &*cell->neighbor(corner)) update(cell, corner);
    }

    /// The square of a vertex's tolerance from its star alone, while all vertices are at their fixed
    /// positions.
    double squared_tolerance(Vertex vertex) {
        double least = infinity;
        Space::star(triangulation_, vertex, star_);
        for (const Cell cell : star_)
            for (unsigned corner = 0; corner < n_corners; ++corner)
                least = std::min(least, squared_tolerance(bicell(cell, corner)));
        return least;
    }

    const double *fixed(std::size_t id) const { return &fixed_[id * dimension]; }
    const double *moving(std::size_t id) const { return &moving_[id * dimension]; }

    typename Space::Triangulation triangulation_;
    std::vector<InputPoint> input_;
    std::vector<Vertex> vertices_;

private:
    /// A bi-cell's vertices by id. Of one with an infinite cell there are d + 1, all in `ids`.
    struct Bicell {
        std::array<std::uint32_t, dimension + 2> ids{};  // the facet's first, then the opposing ones
        unsigned n_ids = 0;
        bool is_finite() const { return n_ids == dimension + 2; }
    };

    Bicell bicell(Cell cell, unsigned corner) const {
        Bicell result;
        const Vertex infinite = triangulation_.infinite_vertex();
        const auto add = [&](Vertex vertex) {
            if (vertex != infinite) result.ids[result.n_ids++] = vertex->info().id;
        };
        for (unsigned i = 0; i < n_corners; ++i)
            if (i != corner) add(cell->vertex(i));
        const Cell other = cell->neighbor(corner);
        add(cell->vertex(corner));
        add(other->vertex(other->index(cell)));
        return result;
    }

    Place<dimension> place(std::uint32_t id) const {
        Place<dimension> place{};
        std::copy(fixed(id), fixed(id) + dimension, place.begin());
        return place;
    }

    BicellPoints<dimension> points(const Bicell &bicell) const {
        BicellPoints<dimension> points{};
        for (unsigned i = 0; i < dimension; ++i) points.facet[i] = place(bicell.ids[i]);
        for (unsigned i = 0; i < 2; ++i) points.opposing[i] = place(bicell.ids[dimension + i]);
        return points;
    }

    double squared_tolerance(const Bicell &bicell) const {
        if (bicell.is_finite()) return squared_half_annulus_width<dimension>(points(bicell), bound_);
        std::array<Place<dimension>, n_corners> corners{};
        for (unsigned i = 0; i < n_corners; ++i) corners[i] = place(bicell.ids[i]);
        return squared_half_simplex_width<dimension>(corners, bound_);
    }

    /// One vertex goes to its next place: the "updating algorithm" of the report.
    void relocate(std::size_t id, const double *position) {
        displacement_[id] = squared_distance<dimension>(fixed(id), position) + distance_error_;
        if (uses_tolerances && displacement_[id] < tolerance_[id]) {
            std::copy(position, position + dimension, &moving_[id * dimension]);
            return;
        }
        if (std::equal(position, position + dimension, moving(id))) return;
        std::copy(position, position + dimension, &moving_[id * dimension]);
        if (uses_regions && is_in_safe_region(id)) return;
        enqueue(static_cast<std::uint32_t>(id));
        for (std::size_t head = 0; head < queue_.size(); ++head) fix(queue_[head]);
        queue_.clear();
    }

    void enqueue(std::uint32_t id) {
        if (is_queued_[id]) return;
        is_queued_[id] = 1;
        queue_.push_back(id);
    }

    /// The body of the loop over the queue: the fixed position becomes the moving one, and the bi-cells that
    /// are new lower the tolerances of their vertices.
    void fix(std::uint32_t id) {
        is_queued_[id] = 0;
        std::copy(moving(id), moving(id) + dimension, &fixed_[id * dimension]);
        displacement_[id] = 0;
        tolerance_[id] = infinity;
        if (uses_regions) hull_tolerance_[id] = infinity;

        made_.clear();
        const auto point = Space::point(fixed(id));
        if (!move_if_star_stays<Space>(triangulation_, vertices_[id], point, star_)) {
            vertices_[id] = Space::place(triangulation_, vertices_[id], point, made_);
            Space::star(triangulation_, vertices_[id], star_);
        }
        // All bi-cells of the vertex are new, and those of the cells where its old place was.
        made_.insert(made_.end(), star_.begin(), star_.end());
        ++stamp_;
        for (const Cell cell : made_) cell->info().stamp = stamp_;
        std::sort(made_.begin(), made_.end(), [](Cell a, Cell b) { return &*a < &*b; });
        made_.erase(std::unique(made_.begin(), made_.end()), made_.end());
        for (const Cell cell : made_)
            for (unsigned corner = 0; corner < n_corners; ++corner) {
                const Cell other = cell->neighbor(corner);
                if (other->info().stamp != stamp_ || &*cell < &*other) update(cell, corner);
            }
    }

    /// A new bi-cell lowers tolerances and gets its delimiter; vertices that are beyond are queued.
    void update(Cell cell, unsigned corner) {
        const Bicell b = bicell(cell, corner);
        if constexpr (uses_tolerances) lower(b, squared_tolerance(b), tolerance_);
        if constexpr (uses_regions) {
            if (!b.is_finite()) return lower(b, squared_tolerance(b), hull_tolerance_);
            const Delimiter<dimension> delimiter = standard_delimiter<dimension>(points(b), bound_);
            const Cell other = cell->neighbor(corner);
            cell->info().delimiters[corner] = delimiter;
            other->info().delimiters[other->index(cell)] = delimiter;
            for (unsigned i = 0; i < b.n_ids; ++i) {
                const std::uint32_t w = b.ids[i];
                if (displacement_[w] == 0 || (uses_tolerances && displacement_[w] < tolerance_[w])) continue;
                const bool is_safe = i < dimension ? delimiter.has_inside(moving(w))
                                                   : delimiter.has_way_outside(fixed(w), moving(w));
                if (!is_safe) enqueue(w);
            }
        }
    }

    void lower(const Bicell &bicell, double squared, std::vector<double> &tolerances) {
        for (unsigned i = 0; i < bicell.n_ids; ++i) {
            const std::uint32_t w = bicell.ids[i];
            if (tolerances[w] <= squared) continue;
            tolerances[w] = squared;
            // With regions, a vertex beyond its tolerance has its region; none is beyond what the hull
            // allows.
            const bool is_decisive = !uses_regions || &tolerances == &hull_tolerance_;
            if (is_decisive && displacement_[w] > 0 && displacement_[w] >= squared) enqueue(w);
        }
    }

    bool is_in_safe_region(std::size_t id) {
        if constexpr (uses_regions) {
            if (!(displacement_[id] < hull_tolerance_[id])) return false;
            const Vertex vertex = vertices_[id];
            const Vertex infinite = triangulation_.infinite_vertex();
            Space::star(triangulation_, vertex, star_);
            for (const Cell cell : star_) {
                if (cell->has_vertex(infinite)) continue;
                for (unsigned corner = 0; corner < n_corners; ++corner) {
                    const Cell other = cell->neighbor(corner);
                    if (other->has_vertex(infinite)) continue;
                    const Delimiter<dimension> &delimiter = cell->info().delimiters[corner];
                    if (cell->vertex(corner) == vertex) {
                        if (!delimiter.has_way_outside(fixed(id), moving(id))) return false;
                    } else if (&*cell < &*other && !delimiter.has_inside(moving(id))) {
                        return false;
                    }
                }
            }
            return true;
        }
        return false;
    }

    CoordinateBound bound_;
    double distance_error_ = 0;
    double greatest_ = 0;  // coordinate of the positions last laid out, and of those before
    double greatest_laid_out_ = 0;
    std::vector<double> fixed_;
    std::vector<double> moving_;
    std::vector<double> displacement_;  // squares, upper bounds; 0 at the fixed position
    std::vector<double> tolerance_;     // squares, lower bounds
    std::vector<double>
        hull_tolerance_;  // of the bi-cells with infinite cells alone, where there are regions
    std::vector<std::uint32_t> queue_;
    std::vector<char> is_queued_;
    std::vector<Cell> made_;
    std::vector<Cell> star_;
    std::uint32_t stamp_ = 0;
};

/// Rebuilding for the first timestamps, then the tolerance algorithm for good.
template <unsigned dimension>
class CgalRebuildingTolerance final : public CgalReport<dimension, true, false> {
    using Base = CgalReport<dimension, true, false>;

public:
    void build(const double *, std::size_t n_points) override {
        this->rebuild();
        n_points_ = n_points;
        n_advances_ = 0;
        has_switched_ = false;
        random_ = Random(0);
        held_.clear();
    }

    void prepare(const double *positions, std::size_t n_points) override {
        // What the caller's array held at the timestamp before.
        held_.swap(next_);
        next_.assign(positions, positions + n_points * dimension);
        Base::prepare(positions, n_points);
    }

    void advance(const double *positions) override {
        if (!has_switched_ && n_advances_++ % sample_period == 0) try_to_switch(positions);
        if (has_switched_) return Base::advance(positions);
        this->rebuild();
    }

private:
    void try_to_switch(const double *positions) {
        this->take_up(held_.data(), n_points_);
        unsigned n_within = 0;
        for (unsigned i = 0; i < sample_size; ++i) {
            const std::size_t id = static_cast<std::size_t>(random_.unit() * static_cast<double>(n_points_));
            const double displacement =
                squared_distance<dimension>(this->fixed(id), positions + id * dimension);
            n_within += displacement < this->squared_tolerance(this->vertices_[id]);
        }
        if (n_within < sample_share(dimension) * sample_size) return;
        this->compute_all();
        has_switched_ = true;
    }

    std::size_t n_points_ = 0;
    std::size_t n_advances_ = 0;
    bool has_switched_ = false;
    Random random_{0};
    std::vector<double> held_;
    std::vector<double> next_;
};

template <template <unsigned> class Kind>
std::unique_ptr<Engine> make(unsigned dimension) {
    if (dimension == 2) return std::make_unique<Kind<2>>();
    return std::make_unique<Kind<3>>();
}

template <unsigned dimension>
using Tolerance = CgalReport<dimension, true, false>;
template <unsigned dimension>
using SafeRegion = CgalReport<dimension, false, true>;
template <unsigned dimension>
using SafeRegionTolerance = CgalReport<dimension, true, true>;

}  // namespace

std::unique_ptr<Engine> make_cgal_tolerance(unsigned dimension, unsigned) {
    return make<Tolerance>(dimension);
}

std::unique_ptr<Engine> make_cgal_safe_region(unsigned dimension, unsigned) {
    return make<SafeRegion>(dimension);
}

std::unique_ptr<Engine> make_cgal_safe_region_tolerance(unsigned dimension, unsigned) {
    return make<SafeRegionTolerance>(dimension);
}

std::unique_ptr<Engine> make_cgal_rebuilding_tolerance(unsigned dimension, unsigned) {
    return make<CgalRebuildingTolerance>(dimension);
}

}  // namespace bench
