#include "triangle_writer.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "array.hpp"
#include "circumcentre.hpp"

namespace compat {

namespace {

class Writer {
public:
    Writer(const TriangleSwitches &switches, const Mesh &mesh, const triangulateio &in, bool copies_lists)
        : switches_(switches), mesh_(mesh), cells_(mesh.cells), in_(in), copies_lists_(copies_lists), first_(switches.zero_based ? 0 : 1),
          n_points_(mesh.n_points), n_attributes_(mesh.n_attributes) {
        std::size_t n_hull = 0;
        for (std::size_t i = 0; i < 3 * cells_.count; i++) n_hull += cells_.neighbours[i] == no_cell;
        n_edges_ = (3 * cells_.count + n_hull) / 2;
        n_segments_ = mesh.has_segments ? mesh.segments.count() : n_hull;
        n_shown_ = n_points_;
        if (switches.jettison) leave_out(mesh.representative);
        if (switches.has_middles) n_middles_ = n_edges_;
    }

    void allocate(const triangulateio &out, const triangulateio *vorout) {
        if (switches_.points) {
            const std::size_t n = n_shown_ + n_middles_;
            points_.allocate(out.pointlist, 2 * n);
            if (n_attributes_ > 0) attributes_.allocate(out.pointattributelist, n * n_attributes_);
            if (switches_.markers) markers_.allocate(out.pointmarkerlist, n);
        }
        if (switches_.triangles) {
            triangles_.allocate(out.trianglelist, n_corners() * cells_.count);
            if (mesh_.has_cell_attributes) triangle_attributes_.allocate(out.triangleattributelist, cells_.count);
        }
        if (switches_.neighbours) neighbours_.allocate(out.neighborlist, 3 * cells_.count);
        if (switches_.lists_segments()) {
            segments_.allocate(out.segmentlist, 2 * n_segments_);
            if (switches_.markers) segment_markers_.allocate(out.segmentmarkerlist, n_segments_);
        }
        if (copies_lists_ && switches_.lists_segments() && switches_.planar_graph) {
            holes_.allocate(nullptr, 2 * mesh_.n_holes);
            regions_.allocate(nullptr, 4 * mesh_.n_regions);
        }
        if (switches_.edges) {
            edges_.allocate(out.edgelist, 2 * n_edges_);
            if (switches_.markers) edge_markers_.allocate(out.edgemarkerlist, n_edges_);
        }
        if (switches_.voronoi) {
            centres_.allocate(vorout->pointlist, 2 * cells_.count);
            centre_attributes_.allocate(vorout->pointattributelist, cells_.count * n_attributes_);
            voronoi_edges_.allocate(vorout->edgelist, 2 * n_edges_);
            norms_.allocate(vorout->normlist, 2 * n_edges_);
        }
    }

    void fill() {
        if (triangles_) number(cells_.vertices, triangles_.data());
        if (triangles_ && !number_of_.empty()) renumber(triangles_.data(), 3 * cells_.count);
        if (triangles_ && switches_.has_middles) add_middles_to_triangles();
        if (triangle_attributes_)
            std::copy(mesh_.cell_attributes.begin(), mesh_.cell_attributes.end(), triangle_attributes_.data());
        if (neighbours_) number(cells_.neighbours, neighbours_.data());
        if (segments_) fill_segments();
        if (holes_ && mesh_.n_holes > 0) std::copy_n(in_.holelist, 2 * mesh_.n_holes, holes_.data());
        if (regions_ && mesh_.n_regions > 0) std::copy_n(in_.regionlist, 4 * mesh_.n_regions, regions_.data());
        if (edges_) fill_edges();
        if (switches_.voronoi) {
            fill_centres();
            fill_voronoi_edges();
        }
        // Last, as the caller's array may be that of the input, from which points are left out then.
        if (points_) fill_points();
        if (points_ && switches_.has_middles) fill_middles();
    }

    void hand_over(triangulateio &out, triangulateio *vorout) {
        points_.hand_over(out.pointlist);
        attributes_.hand_over(out.pointattributelist);
        markers_.hand_over(out.pointmarkerlist);
        triangles_.hand_over(out.trianglelist);
        triangle_attributes_.hand_over(out.triangleattributelist);
        neighbours_.hand_over(out.neighborlist);
        edges_.hand_over(out.edgelist);
        edge_markers_.hand_over(out.edgemarkerlist);
        segments_.hand_over(out.segmentlist);
        segment_markers_.hand_over(out.segmentmarkerlist);
        out.numberofpoints = static_cast<int>(n_shown_ + n_middles_);
        out.numberofpointattributes = in_.numberofpointattributes;
        out.numberoftriangles = static_cast<int>(cells_.count);
        out.numberofcorners = static_cast<int>(n_corners());
        out.numberoftriangleattributes = mesh_.has_cell_attributes;
        out.numberofedges = static_cast<int>(n_edges_);
        out.numberofsegments = static_cast<int>(n_segments_);
        if (switches_.lists_segments()) {
            out.numberofholes = static_cast<int>(mesh_.n_holes);
            out.numberofregions = static_cast<int>(mesh_.n_regions);
            out.holelist = switches_.planar_graph ? in_.holelist : nullptr;
            out.regionlist = switches_.planar_graph ? in_.regionlist : nullptr;
            holes_.hand_over(out.holelist);
            regions_.hand_over(out.regionlist);
        }
        if (vorout == nullptr) return;
        vorout->numberofpoints = static_cast<int>(cells_.count);
        vorout->numberofpointattributes = in_.numberofpointattributes;
        vorout->numberofedges = static_cast<int>(n_edges_);
        if (!switches_.voronoi) return;
        centres_.hand_over(vorout->pointlist);
        centre_attributes_.hand_over(vorout->pointattributelist);
        voronoi_edges_.hand_over(vorout->edgelist);
        norms_.hand_over(vorout->normlist);
        vorout->pointmarkerlist = nullptr;
        vorout->edgemarkerlist = nullptr;
    }

private:
    // Points that are in no triangle. Where all points are on a line, or all triangles have been taken away, there is
    // none to be in.
    void leave_out(const std::vector<std::uint32_t> &representative) {
        std::vector<std::uint8_t> is_shown(n_points_, 0);
        for (std::size_t i = 0; i < 3 * cells_.count; i++) is_shown[cells_.vertices[i]] = 1;
        for (std::size_t i = 0; cells_.count == 0 && i < n_points_; i++)
            is_shown[i] = representative.empty() || representative[i] == i;
        n_shown_ = 0;
        for (std::uint8_t shown : is_shown) n_shown_ += shown;
        if (n_shown_ == n_points_) return;
        number_of_.resize(n_points_);
        int next = first_;
        for (std::size_t i = 0; i < n_points_; i++) number_of_[i] = is_shown[i] != 0 ? next++ : left_out;
    }

    // Numbers of points to those without the points left out.
    void renumber(int *numbers, std::size_t count) const {
        for (std::size_t i = 0; i < count; i++) numbers[i] = number_of_[static_cast<std::size_t>(numbers[i] - first_)];
    }

    // Indices from zero to Triangle's numbers, in which no cell is -1 whatever the first number is.
    void number(const std::uint32_t *indices, int *numbers) const {
        static_assert(sizeof(int) == sizeof *indices && no_cell == UINT32_MAX);
        if (cells_.count == 0) return;
        std::memcpy(numbers, indices, 3 * cells_.count * sizeof(int));
        for (std::size_t i = 0; first_ != 0 && i < 3 * cells_.count; i++)
            if (numbers[i] >= 0) numbers[i] += first_;
    }

    const double *position(std::uint32_t vertex) const { return mesh_.points + std::size_t{2} * vertex; }
    int numbered(std::uint32_t index) const { return static_cast<int>(index + static_cast<std::uint32_t>(first_)); }

    int number_of_point(std::uint32_t vertex) const {
        return number_of_.empty() ? numbered(vertex) : number_of_[vertex];
    }

    // For each edge: its number, its first cell, and the corner opposite. The edge goes from the next corner to the one
    // after. Every place is visited, with the number of the next edge, and what is written there stays only if the
    // place is the edge's first: a branch could not be predicted.
    template <class Visit>
    void for_each_edge(Visit visit) const {
        std::size_t n = 0;
        for (std::size_t c = 0; n < n_edges_; c++) {
            // An edge goes first where Triangle's comes first: opposite the last corner.
            for (unsigned corner : {2u, 0u, 1u}) {
                const std::uint32_t neighbour = cells_.neighbours[3 * c + corner];
                visit(n, static_cast<std::uint32_t>(c), corner, neighbour);
                n += c < neighbour;
                if (n == n_edges_) break;
            }
        }
    }

    std::uint32_t edge_start(std::uint32_t cell, unsigned corner) const {
        return cells_.vertices[std::size_t{3} * cell + (corner + 1) % 3];
    }
    std::uint32_t edge_end(std::uint32_t cell, unsigned corner) const {
        return cells_.vertices[std::size_t{3} * cell + (corner + 2) % 3];
    }

    void fill_points() {
        copy_shown(mesh_.points, 2, points_.data());
        if (attributes_) copy_shown(mesh_.attributes, n_attributes_, attributes_.data());
        if (!markers_) return;
        if (mesh_.has_segments) copy_shown(mesh_.point_markers.data(), 1, markers_.data());
        else fill_markers();
    }

    // Without segments, points of the hull are marked 1, unless the caller has marked them.
    void fill_markers() {
        if (in_.pointmarkerlist != nullptr) copy_shown(in_.pointmarkerlist, 1, markers_.data());
        else std::fill_n(markers_.data(), n_shown_, 0);
        for (std::size_t c = 0; c < cells_.count; c++) {
            for (unsigned corner = 0; corner < 3; corner++) {
                if (cells_.neighbours[3 * c + corner] != no_cell) continue;
                const int number = number_of_point(edge_start(static_cast<std::uint32_t>(c), corner));
                int &marker = markers_[static_cast<std::size_t>(number - first_)];
                if (marker == 0) marker = 1;
            }
        }
    }

    // Rows of the points that are not left out.
    template <class T>
    void copy_shown(const T *from, std::size_t width, T *to) const {
        if (number_of_.empty()) std::copy_n(from, n_points_ * width, to);
        for (std::size_t i = 0; i < number_of_.size(); i++)
            if (number_of_[i] != left_out) to = std::copy_n(from + i * width, width, to);
    }

    std::size_t n_corners() const { return switches_.has_middles ? 6 : 3; }

    // Rows of three become rows of six, from the last one on: behind each the middle of the edge opposite each corner.
    // Middles have the numbers after those of points, in the order of edges.
    void add_middles_to_triangles() {
        for (std::size_t c = cells_.count; c-- > 0;)
            for (std::size_t i = 3; i-- > 0;) triangles_[6 * c + i] = triangles_[3 * c + i];
        for_each_edge([&](std::size_t n, std::uint32_t cell, unsigned corner, std::uint32_t neighbour) {
            if (neighbour < cell) return;
            const int number = numbered(static_cast<std::uint32_t>(n_shown_ + n));
            triangles_[std::size_t{6} * cell + 3 + corner] = number;
            if (neighbour == no_cell) return;
            unsigned across = 0;
            while (cells_.neighbours[std::size_t{3} * neighbour + across] != cell ||
                   edge_start(neighbour, across) != edge_end(cell, corner))
                across++;
            triangles_[std::size_t{6} * neighbour + 3 + across] = number;
        });
    }

    void fill_middles() {
        for_each_edge([&](std::size_t n, std::uint32_t cell, unsigned corner, std::uint32_t neighbour) {
            if (neighbour < cell) return;
            const std::uint32_t start = edge_start(cell, corner), end = edge_end(cell, corner);
            const std::size_t row = n_shown_ + n;
            for (std::size_t axis = 0; axis < 2; axis++)
                points_[2 * row + axis] = 0.5 * (position(start)[axis] + position(end)[axis]);
            for (std::size_t k = 0; attributes_ && k < n_attributes_; k++)
                attributes_[row * n_attributes_ + k] = 0.5 * (attribute(start, k) + attribute(end, k));
            if (markers_) markers_[row] = edge_marker(cell, corner, neighbour);
        });
    }

    void fill_segments() {
        for (std::size_t i = 0; i < 2 * n_segments_; i++) segments_[i] = number_of_point(mesh_.segments.ends[i]);
        if (segment_markers_)
            std::copy(mesh_.segments.markers.begin(), mesh_.segments.markers.end(), segment_markers_.data());
    }

    void fill_edges() {
        for_each_edge([&](std::size_t n, std::uint32_t cell, unsigned corner, std::uint32_t neighbour) {
            edges_[2 * n] = number_of_point(edge_start(cell, corner));
            edges_[2 * n + 1] = number_of_point(edge_end(cell, corner));
            if (edge_markers_) edge_markers_[n] = edge_marker(cell, corner, neighbour);
        });
    }

    int edge_marker(std::uint32_t cell, unsigned corner, std::uint32_t neighbour) const {
        if (!mesh_.has_segments) return neighbour == no_cell;
        const std::uint32_t segment = mesh_.segments.at[std::size_t{3} * cell + corner];
        return segment == no_segment ? 0 : mesh_.segments.markers[segment];
    }

    void fill_centres() {
        for (std::size_t c = 0; c < cells_.count; c++) {
            const std::uint32_t *v = cells_.vertices + 3 * c;
            const double *p = position(v[0]), *q = position(v[1]), *r = position(v[2]);
            double *centre = centres_.data() + 2 * c;
            const double determinant = circumcentre_2d(p, q, r, centre);
            if (n_attributes_ == 0) continue;
            // Attributes are interpolated from the corners.
            const double x = centre[0] - p[0], y = centre[1] - p[1];
            const double of_q = ((r[1] - p[1]) * x - (r[0] - p[0]) * y) / determinant;
            const double of_r = ((q[0] - p[0]) * y - (q[1] - p[1]) * x) / determinant;
            for (std::size_t k = 0; k < n_attributes_; k++) {
                const double at_p = attribute(v[0], k);
                centre_attributes_[c * n_attributes_ + k] =
                    at_p + of_q * (attribute(v[1], k) - at_p) + of_r * (attribute(v[2], k) - at_p);
            }
        }
    }

    double attribute(std::uint32_t vertex, std::size_t k) const {
        return mesh_.attributes[vertex * n_attributes_ + k];
    }

    // Rays go outwards, at a right angle to the edge of the hull.
    void fill_voronoi_edges() {
        for_each_edge([&](std::size_t n, std::uint32_t cell, unsigned corner, std::uint32_t neighbour) {
            voronoi_edges_[2 * n] = numbered(cell);
            voronoi_edges_[2 * n + 1] = numbered(neighbour);
            norms_[2 * n] = norms_[2 * n + 1] = 0;
            if (neighbour != no_cell) return;
            const double *start = position(edge_start(cell, corner)), *end = position(edge_end(cell, corner));
            voronoi_edges_[2 * n + 1] = -1;
            norms_[2 * n] = end[1] - start[1];
            norms_[2 * n + 1] = start[0] - end[0];
        });
    }

    const TriangleSwitches &switches_;
    const Mesh &mesh_;
    const Cells &cells_;
    const triangulateio &in_;
    bool copies_lists_;
    int first_;
    std::size_t n_points_, n_attributes_, n_segments_ = 0, n_edges_ = 0, n_shown_ = 0, n_middles_ = 0;
    static constexpr int left_out = -1;
    std::vector<int> number_of_; // of each point in the output, or left_out; empty where none is left out
    MallocArray<double> points_, attributes_, centres_, centre_attributes_, norms_, triangle_attributes_, holes_,
        regions_;
    MallocArray<int> markers_, triangles_, neighbours_, segments_, segment_markers_;
    MallocArray<int> edges_, edge_markers_, voronoi_edges_;
};

} // namespace

void write_triangulation(const TriangleSwitches &switches, const Mesh &mesh, const triangulateio &in,
                         bool copies_lists, triangulateio &out, triangulateio *vorout) {
    // The caller may pass one structure as in and out.
    const triangulateio given = in;
    Writer writer(switches, mesh, given, copies_lists);
    writer.allocate(out, vorout);
    writer.fill();
    writer.hand_over(out, vorout);
}

} // namespace compat
