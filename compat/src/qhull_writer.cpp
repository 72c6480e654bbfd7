#include "qhull_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>

namespace compat {

namespace {

// qhull leaves its functions by longjmp when they fail, so no local variable here may need a destructor.

using Vector = std::array<double, 4>;

Vector subtract(const coordT *to, const coordT *from, unsigned n) {
    Vector result{};
    for (unsigned axis = 0; axis < n; axis++) result[axis] = to[axis] - from[axis];
    return result;
}

double dot(const Vector &a, const Vector &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

double minor(const Vector &a, const Vector &b, const Vector &c, unsigned i, unsigned j, unsigned k) {
    return a[i] * (b[j] * c[k] - b[k] * c[j]) - a[j] * (b[i] * c[k] - b[k] * c[i]) +
           a[k] * (b[i] * c[j] - b[j] * c[i]);
}

// Orthogonal to n - 1 vectors.
Vector orthogonal(const Vector *vectors, unsigned n) {
    const Vector &a = vectors[0], &b = vectors[1], &c = vectors[2];
    if (n == 3) return {a[2] * b[1] - a[1] * b[2], a[0] * b[2] - a[2] * b[0], a[1] * b[0] - a[0] * b[1], 0};
    return {minor(a, b, c, 1, 2, 3), -minor(a, b, c, 0, 2, 3), minor(a, b, c, 0, 1, 3), -minor(a, b, c, 0, 1, 2)};
}

// The axis that is farthest from being spanned by count orthonormal vectors.
Vector axis_beside(const Vector *vectors, unsigned count, unsigned n) {
    unsigned best = 0;
    double least = 2;
    for (unsigned axis = 0; axis < n; axis++) {
        double part = 0;
        for (unsigned i = 0; i < count; i++) part += vectors[i][axis] * vectors[i][axis];
        if (part >= least) continue;
        least = part;
        best = axis;
    }
    Vector result{};
    result[best] = 1;
    return result;
}

// An orthonormal basis of what the vectors span, the longest first; of vectors that nearly depend on each other the
// last is any that is orthogonal.
void make_orthonormal(Vector *vectors, unsigned count, unsigned n) {
    for (unsigned i = 0; i < count; i++) {
        const auto is_shorter = [](const Vector &a, const Vector &b) { return dot(a, a) < dot(b, b); };
        std::swap(vectors[i], *std::max_element(vectors + i, vectors + count, is_shorter));
        // What rounding has left in the direction of those before is a part of a short vector.
        for (unsigned round = 0; round < 3; round++) {
            double length = std::sqrt(dot(vectors[i], vectors[i]));
            if (!(length > 0)) {
                vectors[i] = axis_beside(vectors, i, n);
                length = 1;
            }
            for (double &x : vectors[i]) x /= length;
            if (round == 2) break;
            for (unsigned j = 0; j < i; j++) {
                const double part = dot(vectors[i], vectors[j]);
                for (unsigned axis = 0; axis < 4; axis++) vectors[i][axis] -= part * vectors[j][axis];
            }
        }
        for (unsigned j = i + 1; j < count; j++) {
            const double part = dot(vectors[j], vectors[i]);
            for (unsigned axis = 0; axis < 4; axis++) vectors[j][axis] -= part * vectors[i][axis];
        }
    }
}

// The unit normal of the facet through these points, down where their order is that of a cell; of a facet that has
// collapsed in rounding one of those that are orthogonal to it.
Vector normal_of(coordT *const *points, unsigned n) {
    Vector edges[3] = {};
    double scale = 1;
    for (unsigned i = 0; i + 1 < n; i++) {
        edges[i] = subtract(points[i + 1], points[0], n);
        scale *= std::sqrt(dot(edges[i], edges[i]));
    }
    constexpr double enough = 1e-6;
    Vector normal = orthogonal(edges, n);
    double length = std::sqrt(dot(normal, normal));
    if (!(length > enough * scale)) {
        const bool is_up = normal[n - 1] > 0;
        make_orthonormal(edges, n - 1, n);
        normal = orthogonal(edges, n);
        length = std::sqrt(dot(normal, normal));
        if (is_up != (normal[n - 1] > 0)) length = -length;
    }
    for (double &x : normal) x /= length;
    return normal;
}

class Writer {
public:
    Writer(const QhullLibrary &library, const QhullCall &call, QhullOutput &output)
        : library_(library), call_(call), output_(output), qh(call.qh) {}

    // Points on the paraboloid, and the numbers that follow from their extent.
    void prepare() {
        library_.qh_initflags(qh, call_.command);
        qh->PROJECTdelaunay = True;
        library_.qh_init_B(qh, call_.points, call_.n_points, call_.dimension, call_.ismalloc);
        qh->furthest_id = qh_IDunknown;
        setT *extremes = library_.qh_maxmin(qh, qh->first_point, qh->num_points, qh->hull_dim);
        if (qh->SCALElast)
            library_.qh_scalelast(qh, qh->first_point, qh->num_points, qh->hull_dim, qh->MINlastcoord,
                                  qh->MAXlastcoord, qh->MAXabs_coord);
        library_.qh_detroundoff(qh);
        library_.qh_settempfree(qh, &extremes);
        qh->upper_threshold[qh->hull_dim - 1] = -qh->ANGLEround * qh_ZEROdelaunay;
        qh->SPLITthresholds = True;
    }

    void write() {
        qh->facet_list = qh->facet_tail = qh->facet_next = library_.qh_newfacet(qh);
        qh->vertex_list = qh->vertex_tail = library_.qh_newvertex(qh, nullptr);
        write_vertices();
        const std::size_t n_facets = output_.facets.count();
        for (std::size_t f = 0; f < n_facets; f++) {
            output_.made[f] = library_.qh_newfacet(qh);
            output_.made[f]->vertices = library_.qh_setnew(qh, qh->hull_dim);
            library_.qh_appendfacet(qh, output_.made[f]);
        }
        qh->facet_next = qh->facet_tail;
        for (std::size_t f = 0; f < n_facets; f++) write_facet(f);
        if (qh->KEEPcoplanar) write_coplanar();
        write_interior_point();
        qh->num_good = static_cast<int>(output_.facets.n_lower);
        qh->maxoutdone = True;
        qh->hasTriangulation = True;
        qh->QHULLfinished = True;
    }

private:
    coordT *point(std::uint32_t i) const {
        return qh->first_point + std::size_t{i} * static_cast<unsigned>(qh->hull_dim);
    }

    void write_vertices() {
        const QhullFacets &facets = output_.facets;
        vertexT *const is_used = qh->vertex_tail;
        for (const std::uint32_t corner : facets.corners) output_.vertices[corner] = is_used;
        for (std::size_t i = 0; i < output_.vertices.size(); i++) {
            if (output_.vertices[i] != is_used) continue;
            output_.vertices[i] = library_.qh_newvertex(qh, point(static_cast<std::uint32_t>(i)));
            library_.qh_appendvertex(qh, output_.vertices[i]);
            output_.vertices[i]->newfacet = False;
        }
    }

    static void fill(setT *set, void *const *elements, unsigned n) {
        for (unsigned i = 0; i < n; i++) SETelem_(set, i) = elements[i];
        SETelem_(set, n) = nullptr;
        if (static_cast<int>(n) < set->maxsize) SETsizeaddr_(set)->i = static_cast<int>(n) + 1;
    }

    void write_facet(std::size_t f) {
        const QhullFacets &facets = output_.facets;
        const unsigned n = facets.n_corners;
        const std::uint32_t *corners = facets.corners.data() + f * n, *neighbours = facets.neighbours.data() + f * n;
        facetT *const facet = output_.made[f];
        const bool is_upper = f >= facets.n_lower;
        unsigned order[4] = {0, 1, 2, 3};
        bool is_odd = false;
        // Vertices descend by id, and ids ascend with points.
        for (unsigned i = 1; i < n; i++)
            for (unsigned j = i; j > 0 && corners[order[j - 1]] < corners[order[j]]; j--) {
                std::swap(order[j - 1], order[j]);
                is_odd = !is_odd;
            }
        void *vertices[4] = {}, *around[4] = {};
        coordT *points[4] = {};
        for (unsigned i = 0; i < n; i++) {
            vertices[i] = output_.vertices[corners[order[i]]];
            around[i] = output_.made[neighbours[order[i]]];
            points[i] = point(corners[i]);
        }
        fill(facet->vertices, vertices, n);
        fill(facet->neighbors, around, n);
        facet->toporient = is_odd == is_upper;
        facet->upperdelaunay = is_upper;
        facet->good = !is_upper;
        facet->newfacet = False;
        facet->normal = static_cast<coordT *>(library_.qh_memalloc(qh, qh->normal_size));
        write_plane(facet, points, is_upper);
    }

    void write_plane(facetT *facet, coordT *const *points, bool is_upper) const {
        const unsigned n = output_.facets.n_corners;
        const Vector normal = normal_of(points, n);
        // A cell is seen from below, also where the rounding of a flat one has it the other way.
        const double sign = is_upper || normal[n - 1] > 0 ? -1 : 1;
        facet->offset = 0;
        for (unsigned axis = 0; axis < n; axis++) {
            facet->normal[axis] = sign * normal[axis];
            facet->offset -= facet->normal[axis] * points[0][axis];
        }
    }

    // The mean of all vertices. By a point inside qhull turns hyperplanes that rounding has left without a side.
    void write_interior_point() {
        qh->interior_point = static_cast<coordT *>(library_.qh_memalloc(qh, qh->normal_size));
        std::fill_n(qh->interior_point, qh->hull_dim, 0.0);
        const vertexT *vertex;
        FORALLvertices
            for (int axis = 0; axis < qh->hull_dim; axis++)
                qh->interior_point[axis] += vertex->point[axis] / qh->num_vertices;
    }

    // Each with a facet below that has the vertex at its place.
    void write_coplanar() {
        for (const CoplanarPoint &each : output_.coplanar)
            library_.qh_setappend(qh, &output_.made[each.facet]->coplanarset, point(each.point));
    }

    const QhullLibrary &library_;
    const QhullCall &call_;
    QhullOutput &output_;
    qhT *const qh;
};

} // namespace

// As qhull starts each call.
static void start(const QhullLibrary &library, const QhullCall &call) {
    FILE *const errfile = call.errfile != nullptr ? call.errfile : stderr;
    if (call.qh->qhmem.ferr == nullptr) library.qh_meminit(call.qh, errfile);
    else library.qh_memcheck(call.qh);
    library.qh_initqhull_start(call.qh, nullptr, call.outfile, errfile);
}

int write_qhull(const QhullLibrary &library, const QhullCall &call, QhullOutput &output) {
    qhT *const qh = call.qh;
    start(library, call);
    Writer writer(library, call, output);
    const int exit_code = setjmp(qh->errexit);
    if (exit_code == 0) {
        qh->NOerrexit = False;
        writer.prepare();
        writer.write();
    }
    qh->NOerrexit = True;
    return exit_code;
}

int refuse_call(const QhullLibrary &library, const QhullCall &call, const char *message) {
    start(library, call);
    std::fprintf(call.qh->ferr, "deldrift: qh_new_qhull: %s\n", message);
    return qh_ERRinput;
}

} // namespace compat
