#include "tetgen_writer.hpp"

#include <cmath>
#include <memory>

#include "circumcentre.hpp"
#include "skeleton.hpp"

namespace compat {

namespace {

template <class T>
class NewArray {
public:
    void allocate(std::size_t count) { data_.reset(new T[count]); }
    void hand_over(T *&slot) {
        if (data_ != nullptr) slot = data_.release();
    }
    explicit operator bool() const { return data_ != nullptr; }
    T &operator[](std::size_t i) const { return data_[i]; }

private:
    std::unique_ptr<T[]> data_;
};

// Rows of different lengths, each an array of its own, with its length first.
class Lists {
public:
    void allocate(std::size_t count) {
        rows_.reset(new int *[count]());
        count_ = count;
    }
    ~Lists() {
        for (std::size_t i = 0; rows_ != nullptr && i < count_; i++) delete[] rows_[i];
    }
    int *row(std::size_t i, std::size_t length) {
        rows_[i] = new int[length + 1];
        rows_[i][0] = static_cast<int>(length);
        return rows_[i] + 1;
    }
    int *release(std::size_t i) {
        int *row = rows_[i];
        rows_[i] = nullptr;
        return row;
    }
    int **release() { return rows_.release(); }
    explicit operator bool() const { return rows_ != nullptr; }

private:
    std::unique_ptr<int *[]> rows_;
    std::size_t count_ = 0;
};

// The points of the input, whatever its layout.
struct Points {
    template <class Io>
    Points(const Io &in, const std::vector<double> &of_points)
        : first_number(in.firstnumber), mesh_dimension(in.mesh_dim), count(static_cast<std::size_t>(in.numberofpoints)),
          n_attributes(static_cast<std::size_t>(in.numberofpointattributes)), positions(in.pointlist),
          attributes(in.pointattributelist), weights(of_points.empty() ? nullptr : of_points.data()),
          markers(in.pointmarkerlist) {
        if (n_attributes > 0 || weights == nullptr) return;
        n_attributes = 1;
        attributes = weights;
    }

    int first_number, mesh_dimension;
    std::size_t count, n_attributes;
    const double *positions, *attributes, *weights;
    const int *markers;
};

class Writer {
public:
    Writer(const TetgenSwitches &switches, const Cells &cells, const Points &in,
           const std::vector<std::uint32_t> &representative)
        : switches_(switches), cells_(cells), in_(in), first_(switches.zero_based ? 0 : in.first_number) {
        number_of_.resize(in.count);
        shown_.reserve(in.count);
        for (std::size_t i = 0; i < in.count; i++) {
            number_of_[i] = static_cast<int>(shown_.size()) + first_;
            const bool is_left_out = switches.jettison && !representative.empty() && representative[i] != i;
            if (!is_left_out) shown_.push_back(static_cast<std::uint32_t>(i));
        }
    }

    void make() {
        if (switches_.points) make_points();
        if (switches_.tetrahedra) make_tetrahedra();
        if (switches_.neighbours) make_neighbours();
        const bool lists_edges = switches_.edges && switches_.any_faces;
        if (!switches_.any_faces && !switches_.voronoi) return;
        const Faces faces(cells_);
        n_faces_ = faces.count();
        n_hull_ = faces.n_hull();
        if (switches_.any_faces) make_faces(faces);
        if (!lists_edges && !switches_.voronoi) return;
        const Edges edges(cells_, switches_.voronoi ? &faces : nullptr);
        n_edges_ = edges.count();
        if (lists_edges) make_edges(edges);
        if (switches_.voronoi) {
            make_centres();
            make_voronoi_edges(faces);
            make_voronoi_facets(edges);
            make_voronoi_cells(edges);
        }
    }

    template <class Io>
    void hand_over(Io &out) {
        out.firstnumber = in_.first_number;
        out.mesh_dim = in_.mesh_dimension;
        if (switches_.points) {
            out.numberofpoints = static_cast<int>(shown_.size());
            out.numberofpointattributes = static_cast<int>(in_.n_attributes);
        }
        points_.hand_over(out.pointlist);
        attributes_.hand_over(out.pointattributelist);
        markers_.hand_over(out.pointmarkerlist);
        out.numberofcorners = 4;
        if (switches_.tetrahedra) out.numberoftetrahedra = static_cast<int>(cells_.count);
        tetrahedra_.hand_over(out.tetrahedronlist);
        neighbours_.hand_over(out.neighborlist);
        if (face_list_) out.numberoftrifaces = static_cast<int>(switches_.faces ? n_faces_ : n_hull_);
        face_list_.hand_over(out.trifacelist);
        face_markers_.hand_over(out.trifacemarkerlist);
        if (edge_list_) out.numberofedges = static_cast<int>(n_edges_);
        edge_list_.hand_over(out.edgelist);
        edge_markers_.hand_over(out.edgemarkerlist);
        if (switches_.voronoi) hand_over_voronoi(out);
    }

private:
    template <class Io>
    void hand_over_voronoi(Io &out) {
        out.numberofvpoints = static_cast<int>(cells_.count);
        out.numberofvedges = static_cast<int>(n_faces_);
        out.numberofvfacets = static_cast<int>(n_edges_);
        out.numberofvcells = static_cast<int>(shown_.size());
        centres_.hand_over(out.vpointlist);
        voronoi_edges_.hand_over(out.vedgelist);
        for (std::size_t i = 0; i < n_edges_; i++) voronoi_facets_[i].elist = facet_lists_.release(i);
        voronoi_facets_.hand_over(out.vfacetlist);
        out.vcelllist = cell_lists_.release();
    }

    const double *position(std::uint32_t vertex) const { return in_.positions + std::size_t{3} * vertex; }
    int numbered(std::size_t index) const { return static_cast<int>(index) + first_; }

    void make_points() {
        const bool with_markers = switches_.markers && in_.markers != nullptr;
        points_.allocate(3 * shown_.size());
        const std::size_t n_attributes = in_.n_attributes;
        if (n_attributes > 0) attributes_.allocate(n_attributes * shown_.size());
        if (with_markers) markers_.allocate(shown_.size());
        for (std::size_t i = 0; i < shown_.size(); i++) {
            const std::size_t from = shown_[i];
            for (unsigned axis = 0; axis < 3; axis++) points_[3 * i + axis] = in_.positions[3 * from + axis];
            for (std::size_t k = 0; k < n_attributes; k++)
                attributes_[i * n_attributes + k] = in_.attributes[from * n_attributes + k];
            if (with_markers) markers_[i] = in_.markers[from];
        }
    }

    void make_tetrahedra() {
        tetrahedra_.allocate(4 * cells_.count);
        for (std::size_t c = 0; c < cells_.count; c++)
            for (unsigned i = 0; i < 4; i++)
                tetrahedra_[4 * c + i] = number_of_[cells_.vertices[4 * c + i]];
    }

    void make_neighbours() {
        neighbours_.allocate(4 * cells_.count);
        for (std::size_t c = 0; c < cells_.count; c++) {
            for (unsigned i = 0; i < 4; i++) {
                const std::uint32_t neighbour = cells_.neighbours[4 * c + i];
                neighbours_[4 * c + i] = neighbour == no_cell ? -1 : numbered(neighbour);
            }
        }
    }

    bool is_on_hull(const Faces &faces, std::size_t face) const {
        return cells_.neighbours[std::size_t{4} * faces.cell(face) + faces.corner(face)] == no_cell;
    }

    void make_faces(const Faces &faces) {
        // The corners of the face opposite each corner, counter-clockwise as seen from inside the cell; where only the
        // faces of the hull are listed, as seen from outside.
        static constexpr unsigned face_corners[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};
        const std::size_t n = switches_.faces ? faces.count() : faces.n_hull();
        face_list_.allocate(3 * n);
        if (switches_.faces && switches_.markers) face_markers_.allocate(n);
        std::size_t to = 0;
        for (std::size_t face = 0; face < faces.count(); face++) {
            const bool on_hull = is_on_hull(faces, face);
            if (!switches_.faces && !on_hull) continue;
            const std::uint32_t *v = cells_.vertices + std::size_t{4} * faces.cell(face);
            const unsigned *corners = face_corners[faces.corner(face)];
            for (unsigned i = 0; i < 3; i++)
                face_list_[3 * to + i] = number_of_[v[corners[switches_.faces ? i : 2 - i]]];
            if (face_markers_) face_markers_[to] = on_hull;
            to++;
        }
    }

    void make_edges(const Edges &edges) {
        edge_list_.allocate(2 * edges.count());
        if (switches_.markers) edge_markers_.allocate(edges.count());
        for (std::size_t e = 0; e < edges.count(); e++) {
            edge_list_[2 * e] = number_of_[edges.start(e)];
            edge_list_[2 * e + 1] = number_of_[edges.end(e)];
            if (edge_markers_) edge_markers_[e] = edges.is_on_hull(e);
        }
    }

    void make_centres() {
        centres_.allocate(3 * cells_.count);
        for (std::size_t c = 0; c < cells_.count; c++) {
            const std::uint32_t *v = cells_.vertices + 4 * c;
            const double *weights = in_.weights;
            double of_corners[4] = {};
            for (unsigned i = 0; i < 4 && weights != nullptr; i++) of_corners[i] = weights[v[i]];
            circumcentre_3d(position(v[0]), position(v[1]), position(v[2]), position(v[3]),
                            weights == nullptr ? nullptr : of_corners, &centres_[3 * c]);
        }
    }

    // Dual to the faces. The vectors of rays are normal to faces of the hull, and point inwards as TetGen's do.
    void make_voronoi_edges(const Faces &faces) {
        voronoi_edges_.allocate(faces.count());
        for (std::size_t face = 0; face < faces.count(); face++) {
            const std::uint32_t cell = faces.cell(face);
            const std::uint32_t neighbour = cells_.neighbours[std::size_t{4} * cell + faces.corner(face)];
            tetgenio::voroedge &edge = voronoi_edges_[face];
            edge = {numbered(cell), neighbour == no_cell ? -1 : numbered(neighbour), {0, 0, 0}};
            if (neighbour == no_cell) inward_normal(cell, faces.corner(face), edge.vnormal);
        }
    }

    void inward_normal(std::uint32_t cell, unsigned corner, double *normal) const {
        const std::uint32_t *v = cells_.vertices + std::size_t{4} * cell;
        const double *inside = position(v[corner]), *a = position(v[(corner + 1) % 4]);
        const double *b = position(v[(corner + 2) % 4]), *c = position(v[(corner + 3) % 4]);
        double squared = 0, towards_inside = 0;
        for (unsigned axis = 0; axis < 3; axis++) {
            const unsigned next = (axis + 1) % 3, last = (axis + 2) % 3;
            normal[axis] = (b[next] - a[next]) * (c[last] - a[last]) - (b[last] - a[last]) * (c[next] - a[next]);
            squared += normal[axis] * normal[axis];
            towards_inside += normal[axis] * (inside[axis] - a[axis]);
        }
        const double scale = (towards_inside < 0 ? -1 : 1) / std::sqrt(squared);
        for (unsigned axis = 0; axis < 3; axis++) normal[axis] *= scale;
    }

    // Dual to the edges. An unbounded facet or cell has -1 at the end of its list.
    void make_voronoi_facets(const Edges &edges) {
        voronoi_facets_.allocate(edges.count());
        facet_lists_.allocate(edges.count());
        for (std::size_t e = 0; e < edges.count(); e++) {
            voronoi_facets_[e] = {number_of_[edges.start(e)], number_of_[edges.end(e)], nullptr};
            const bool on_hull = edges.is_on_hull(e);
            int *row = facet_lists_.row(e, edges.ring_size(e) + on_hull);
            if (on_hull) row[edges.ring_size(e)] = -1;
            for (std::size_t k = 0; k < edges.ring_size(e); k++) row[k] = numbered(edges.ring(e)[k]);
        }
    }

    // Dual to the points.
    void make_voronoi_cells(const Edges &edges) {
        const auto place = [this](std::uint32_t v) { return static_cast<std::size_t>(number_of_[v] - first_); };
        std::vector<std::size_t> lengths(shown_.size());
        std::vector<std::uint8_t> on_hull(shown_.size());
        for (std::size_t e = 0; e < edges.count(); e++) {
            for (std::uint32_t end : {edges.start(e), edges.end(e)}) {
                lengths[place(end)]++;
                if (edges.is_on_hull(e)) on_hull[place(end)] = 1;
            }
        }
        cell_lists_.allocate(shown_.size());
        std::vector<int *> to(shown_.size());
        for (std::size_t i = 0; i < shown_.size(); i++) {
            to[i] = cell_lists_.row(i, lengths[i] + on_hull[i]);
            if (on_hull[i] != 0) to[i][lengths[i]] = -1;
        }
        for (std::size_t e = 0; e < edges.count(); e++)
            for (std::uint32_t end : {edges.start(e), edges.end(e)}) *to[place(end)]++ = numbered(e);
    }

    const TetgenSwitches &switches_;
    const Cells &cells_;
    const Points in_;
    int first_;
    std::size_t n_faces_ = 0, n_hull_ = 0, n_edges_ = 0;
    std::vector<int> number_of_;       // of each point of in; points left out have that of the next
    std::vector<std::uint32_t> shown_; // points that are not left out
    NewArray<double> points_, attributes_, centres_;
    NewArray<int> markers_, tetrahedra_, neighbours_, face_list_, face_markers_, edge_list_, edge_markers_;
    NewArray<tetgenio::voroedge> voronoi_edges_;
    NewArray<tetgenio::vorofacet> voronoi_facets_;
    Lists facet_lists_, cell_lists_;
};

} // namespace

template <class Io>
void write_tetrahedra(const TetgenSwitches &switches, const Cells &cells, const Io &in, Io &out,
                      const std::vector<std::uint32_t> &representative, const std::vector<double> &weights) {
    Writer writer(switches, cells, Points(in, weights), representative);
    writer.make();
    writer.hand_over(out);
}

template void write_tetrahedra(const TetgenSwitches &, const Cells &, const TetgenIo150 &, TetgenIo150 &,
                               const std::vector<std::uint32_t> &, const std::vector<double> &);
template void write_tetrahedra(const TetgenSwitches &, const Cells &, const TetgenIo151 &, TetgenIo151 &,
                               const std::vector<std::uint32_t> &, const std::vector<double> &);
template void write_tetrahedra(const TetgenSwitches &, const Cells &, const TetgenIo16 &, TetgenIo16 &,
                               const std::vector<std::uint32_t> &, const std::vector<double> &);

} // namespace compat
