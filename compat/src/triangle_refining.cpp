#include "triangle_refining.hpp"

#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "settings.hpp"
#include "triangle_carving.hpp"

namespace compat {

namespace {

void require(deldrift_status status) {
    if (status == DELDRIFT_OUT_OF_MEMORY) throw std::bad_alloc();
    if (status != DELDRIFT_OK) throw std::runtime_error(deldrift_last_error());
}

// What the pieces of a segment have from it.
struct Origin {
    int marker;
    std::int32_t left, right; // labels of the cells there
};

// The segments in force.
struct InForce {
    std::vector<std::uint32_t> ids, ends, originals, cells; // cells: to the left and right of each
    explicit InForce(const deldrift_triangulation *t) {
        std::size_t n = 0;
        require(deldrift_segments(t, nullptr, nullptr, nullptr, 0, &n));
        ids.resize(n);
        originals.resize(n);
        ends.resize(2 * n);
        cells.resize(2 * n);
        if (n == 0) return;
        require(deldrift_segments(t, ids.data(), ends.data(), nullptr, n, &n));
        require(deldrift_original_segments(t, originals.data(), n, &n));
        require(deldrift_cells_of_segments(t, cells.data(), n, &n));
    }
    std::size_t count() const { return ids.size(); }
};

Cells cells_of(const deldrift_triangulation *t) {
    deldrift_cells_view view{};
    require(deldrift_cells(t, &view));
    return {3, view.count, view.vertices, view.neighbours};
}

// Asks the program about triangles; what it throws comes out of the refinement.
class Asking {
public:
    // Both may be null. With the areas of triangles that are given, each has that of the one around its centroid.
    Asking(Unsuitable unsuitable, const GivenTriangles *areas) : unsuitable_(unsuitable), areas_(areas) {}
    void ask_for(deldrift_quality &quality) {
        if (unsuitable_ == nullptr && areas_ == nullptr) return;
        quality.is_too_large = is_too_large;
        quality.user_data = this;
    }
    void throw_again() const {
        if (thrown_ != nullptr) std::rethrow_exception(thrown_);
    }

private:
    static int is_too_large(void *self, const double *corners) {
        Asking &asking = *static_cast<Asking *>(self);
        double p[6];
        std::copy_n(corners, 6, p);
        const double area = 0.5 * ((p[2] - p[0]) * (p[5] - p[1]) - (p[3] - p[1]) * (p[4] - p[0]));
        try {
            if (asking.areas_ != nullptr) {
                const double centre[2] = {(p[0] + p[2] + p[4]) / 3, (p[1] + p[3] + p[5]) / 3};
                const double greatest = asking.areas_->greatest_area_at(centre);
                if (greatest > 0 && area > greatest) return 1;
            }
            return asking.unsuitable_ != nullptr && asking.unsuitable_(p, p + 2, p + 4, area) != 0 ? 1 : 0;
        } catch (...) {
            asking.thrown_ = std::current_exception();
            return -1;
        }
    }

    Unsuitable unsuitable_;
    const GivenTriangles *areas_;
    std::exception_ptr thrown_;
};

class Refiner {
public:
    Refiner(const TriangleSwitches &switches, const triangulateio &in, deldrift_triangulation *t, const Mesh &outline,
            const std::vector<std::int32_t> &labels, Unsuitable unsuitable, const GivenTriangles *given)
        : switches_(switches), t_(t), outline_(outline), labels_(labels), unsuitable_(unsuitable), given_(given) {
        outline_.own_points.assign(outline.points, outline.points + 2 * outline.n_points);
        if (outline.n_attributes > 0)
            outline_.own_attributes.assign(outline.attributes,
                                           outline.attributes + outline.n_attributes * outline.n_points);
        areas_.assign(static_cast<std::size_t>(in.numberofregions) + 1, 0);
        for (int i = 0; i < in.numberofregions && switches.has_region_areas; i++)
            areas_[static_cast<std::size_t>(i) + 1] = std::max(in.regionlist[std::ptrdiff_t{4} * i + 3], 0.0);
        const InForce segments(t);
        const auto label = [&](std::uint32_t cell) { return cell == no_cell ? eaten : labels_[cell]; };
        for (std::size_t i = 0; i < segments.count(); i++)
            origins_.push_back(
                {outline.segments.markers[i], label(segments.cells[2 * i]), label(segments.cells[2 * i + 1])});
    }

    // Until the quality is reached.
    void run() {
        if (switches_.limit == 0) return;
        deldrift_quality quality{};
        require(deldrift_quality_init(&quality));
        quality.least_angle = switches_.least_angle;
        quality.greatest_area = switches_.greatest_area;
        quality.labels = labels_.data();
        quality.label_count = labels_.size();
        quality.areas = areas_.data();
        quality.area_count = areas_.size();
        quality.keeps = keeps();
        quality.has_weights = outline_.n_attributes > 0;
        quality.is_conforming = switches_.conforms;
        quality.limit = switches_.limit;
        std::vector<std::uint8_t> mask(labels_.size());
        for (std::size_t c = 0; c < mask.size(); c++) mask[c] = labels_[c] != eaten;
        Asking asking(switches_.asks ? unsuitable_ : nullptr, switches_.has_region_areas ? given_ : nullptr);
        asking.ask_for(quality);
        deldrift_quality_report report{};
        const deldrift_status status = deldrift_refine(t_, &quality, mask.data(), mask.size(), &report);
        asking.throw_again();
        require(status);
        if (switches_.conforms && report.unsplit > 0)
            complain("triangulate", "switch D: rounding leaves no room to split %llu pieces of segments",
                     static_cast<unsigned long long>(report.unsplit));
        if (report.inserted == 0) return;
        add_points(static_cast<std::size_t>(report.inserted));
        follow();
    }

    const std::vector<std::int32_t> &labels() const { return labels_; }

    // With segments numbered by row, not by id.
    Mesh outline() {
        const InForce segments(t_);
        std::unordered_map<std::uint32_t, std::uint32_t> row_of;
        row_of.reserve(segments.count());
        outline_.segments.markers.clear();
        for (std::size_t i = 0; i < segments.count(); i++) {
            row_of.emplace(segments.ids[i], static_cast<std::uint32_t>(i));
            outline_.segments.markers.push_back(origins_[segments.ids[i]].marker);
        }
        outline_.segments.ends = segments.ends;
        outline_.segments.at = sides_of_cells();
        for (std::uint32_t &segment : outline_.segments.at)
            if (segment != no_segment) segment = row_of.at(segment);
        outline_.n_points = outline_.own_points.size() / 2;
        outline_.points = outline_.own_points.data();
        outline_.attributes = outline_.own_attributes.data();
        return std::move(outline_);
    }

private:
    std::vector<std::uint32_t> sides_of_cells() const {
        std::size_t n = cells_of(t_).count;
        std::vector<std::uint32_t> at(3 * n);
        require(deldrift_segments_of_cells(t_, at.data(), n, &n));
        return at;
    }

    deldrift_kept keeps() const {
        const deldrift_kept kinds[] = {DELDRIFT_KEPT_NONE, DELDRIFT_KEPT_OUTER, DELDRIFT_KEPT_ALL};
        return kinds[std::min(switches_.n_kept, 2)];
    }

    // Places, attributes and markers of the points that were inserted last.
    void add_points(std::size_t n_inserted) {
        std::vector<double> &points = outline_.own_points;
        const std::size_t n_before = points.size() / 2;
        points.resize(points.size() + 2 * n_inserted);
        std::size_t n = 0;
        require(deldrift_copy_positions(t_, points.data(), n_before + n_inserted, &n));
        require(deldrift_made_vertices(t_, nullptr, nullptr, 0, &n));
        std::vector<std::uint32_t> made(n), segments(n);
        require(deldrift_made_vertices(t_, made.data(), segments.data(), n, &n));
        outline_.point_markers.resize(n_before + n_inserted, 0);
        for (std::size_t i = 0; i < n; i++)
            if (made[i] >= n_before && segments[i] != DELDRIFT_NONE)
                outline_.point_markers[made[i]] = origins_[segments[i]].marker;
        if (outline_.n_attributes > 0) interpolate(n_inserted);
    }

    void interpolate(std::size_t n) {
        std::vector<std::uint32_t> corners(3 * n);
        std::vector<double> weights(3 * n);
        require(deldrift_refined_weights(t_, corners.data(), weights.data(), n, &n));
        const std::size_t width = outline_.n_attributes;
        std::vector<double> &values = outline_.own_attributes;
        for (std::size_t i = 0; i < n; i++) {
            for (std::size_t k = 0; k < width; k++) {
                double sum = 0;
                for (std::size_t c = 3 * i; c < 3 * i + 3; c++) sum += weights[c] * values[corners[c] * width + k];
                values.push_back(sum);
            }
        }
    }

    // Carries origins over to the pieces that refinement has made, and labels to the cells.
    void follow() {
        const InForce segments(t_);
        for (std::size_t i = 0; i < segments.count(); i++) {
            const std::uint32_t id = segments.ids[i];
            if (id >= origins_.size()) origins_.resize(std::size_t{id} + 1, origins_[segments.originals[i]]);
            if (segments.originals[i] != id) origins_[id] = origins_[segments.originals[i]];
        }
        label(segments);
    }

    // Cells have the label that is beside the pieces around them.
    void label(const InForce &segments) {
        const Cells cells = cells_of(t_);
        const std::vector<std::uint32_t> at = sides_of_cells();
        std::vector<std::uint32_t> reached;
        constexpr std::int32_t unknown = INT32_MIN;
        labels_.assign(cells.count, unknown);
        for (std::size_t side = 0; side < 2 * segments.count(); side++) {
            const std::uint32_t first = segments.cells[side];
            if (first == no_cell || labels_[first] != unknown) continue;
            const Origin &origin = origins_[segments.ids[side / 2]];
            labels_[first] = side % 2 == 0 ? origin.left : origin.right;
            reached.push_back(first);
            while (!reached.empty()) {
                const std::uint32_t cell = reached.back();
                reached.pop_back();
                for (std::size_t place = std::size_t{3} * cell; place < std::size_t{3} * cell + 3; place++) {
                    const std::uint32_t next = cells.neighbours[place];
                    if (next == no_cell || at[place] != DELDRIFT_NONE || labels_[next] != unknown) continue;
                    labels_[next] = labels_[cell];
                    reached.push_back(next);
                }
            }
        }
        std::replace(labels_.begin(), labels_.end(), unknown, eaten);
    }

    const TriangleSwitches &switches_;
    deldrift_triangulation *t_;
    Mesh outline_;
    std::vector<std::int32_t> labels_;
    Unsuitable unsuitable_;
    const GivenTriangles *given_;
    std::vector<double> areas_;
    std::vector<Origin> origins_; // by the id of the segment
};

// Brings the segments of the outline that the hull has been given into the triangulation.
void bring_in_hull(deldrift_triangulation *t, const Graph &graph, const Mesh &outline) {
    const std::size_t n = outline.segments.count() - graph.count();
    std::uint32_t first = 0;
    if (n == 0) return;
    require(deldrift_stage_segments(t, outline.segments.ends.data() + 2 * graph.count(), nullptr, n, &first));
    require(deldrift_commit_timestamp(t, nullptr));
}

Mesh refined_mesh(const TriangleSwitches &switches, const triangulateio &in, const Graph &graph,
                  const deldrift_triangulation *t, Unsuitable unsuitable, GivenTriangles *given, Triangulation &copy) {
    deldrift_triangulation *cloned = nullptr;
    require(deldrift_clone(t, &cloned));
    copy.reset(cloned);
    Mesh outline = outline_of(graph, in);
    if (switches.encloses()) {
        const Cells cells = cells_of(cloned);
        Carver carver(in, std::move(outline), cloned, cells);
        carver.enclose();
        outline = carver.outline();
        bring_in_hull(cloned, graph, outline);
        outline.segments.at.clear();
    }
    Cells cells = cells_of(cloned);
    Carver carver(in, std::move(outline), cloned, cells);
    if (given != nullptr) {
        given->find_in(t, cells_of(t));
        carver.keep(*given);
    } else {
        carver.carve(switches);
    }
    const std::vector<std::int32_t> &labels = carver.labels();
    if (std::all_of(labels.begin(), labels.end(), [](std::int32_t label) { return label == eaten; }))
        return carver.finish(switches);
    carver.mark_boundary();
    Refiner refiner(switches, in, cloned, carver.outline(), labels, unsuitable, given);
    refiner.run();
    cells = cells_of(cloned);
    Carver refined(in, refiner.outline(), cloned, cells);
    refined.set_labels(refiner.labels());
    if (given != nullptr && given->has_attributes()) refined.give_attributes_of(*given);
    return refined.finish(switches);
}

} // namespace

std::string refine(const TriangleSwitches &switches, const triangulateio &in, const Graph &graph,
                   const deldrift_triangulation *t, Unsuitable unsuitable, GivenTriangles *given, Triangulation &copy,
                   Mesh &mesh) {
    try {
        mesh = refined_mesh(switches, in, graph, t, unsuitable, given, copy);
    } catch (const std::runtime_error &error) {
        return error.what();
    }
    return "";
}

} // namespace compat
