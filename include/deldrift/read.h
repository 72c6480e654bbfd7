/*
 * deldrift/read.h: What is where, and what is near: location, neighbours, values between vertices.
 *
 * A part of deldrift.h, the first page of which has the rules that hold for all functions.
 *
 * Made by `make header` from these files of src/capi: location.rs, near.rs, reach.rs, incidence.rs, interpolation.rs.
 * Change it there.
 *
 * Where points lie, and which vertices are near.
 *
 *     deldrift_locate: Where a point lies, exactly, to *location.
 *     deldrift_locate_points: Where count points lie, exactly, to locations, which has room for count.
 *     deldrift_locate_in_period: Where count points lie, exactly, to locations, and in which period, to shifts.
 *     deldrift_nearest_vertex: The vertex nearest to a point, to *vertex.
 *     deldrift_coincident_representative: The vertex that represents this one in cells, to *representative.
 *     deldrift_hidden_vertices: The vertices that are hidden by place, ascending, each with the one that represents it.
 *
 * What is near a place: the nearest vertices, those in a ball or a box, the cells that a new vertex would remove.
 *
 *     deldrift_nearest_vertices: The k vertices nearest to each of count positions: rows of k ids, by distance.
 *     deldrift_vertices_in_ball: The vertices in a closed ball, ascending by id, hidden ones included.
 *     deldrift_neighbour_lists: For each vertex the others that are near it, all in one call: the neighbour lists of
 *         particle codes.
 *     deldrift_vertices_in_box: The vertices in a closed box, ascending by id, hidden ones included.
 *     deldrift_conflicts: The cells that the insertion of a vertex at a position would remove, in no particular order.
 *
 * The cells, hull facets and vertices that a vertex in a box could change.
 *
 *     deldrift_cells_in_reach: The cells that a vertex at a place in one of some boxes could change.
 *     deldrift_hull_facets_in_reach: The facets of the convex hull that a place in one of some boxes is strictly
 *         beyond, exactly.
 *     deldrift_vertices_in_reach: For each of some boxes the vertices of the cells and hull facets in its reach.
 *
 * What meets what: edges, neighbours and cells of vertices, mirror indices, ordered stars.
 *
 *     deldrift_edges: The edges: rows of two vertex ids, the lower one first, each edge once, in lexicographic order.
 *     deldrift_vertex_neighbours: The neighbours of all vertices: for each id the vertices with which it shares an
 *         edge, ascending, one list after the other.
 *     deldrift_vertex_cells: The cells of all vertices: for each id the indices of the cells that have it as a corner,
 *         ascending, one list after the other.
 *     deldrift_cell_of_each_vertex: A cell of each vertex: for each id the index of the first cell of which the vertex
 *         is a corner.
 *     deldrift_find_simplices: Cells that have given vertices as corners: for each of count simplices the index of one,
 *         DELDRIFT_NONE if there is none.
 *     deldrift_mirror_indices: The mirror indices of all facets, in the order of deldrift_cells.
 *     deldrift_mirror_index: The mirror index of one facet, to *mirror: the corner of the neighbour beyond that is
 *         opposite the same facet, DELDRIFT_NONE on the hull.
 *     deldrift_ordered_star: The star of a vertex of the plane, counter-clockwise: the indices of the cells that have
 *         it as a corner.
 *
 * Values between vertices.
 *
 *     deldrift_interpolate: Interpolates values of the vertices at count positions.
 *     deldrift_barycentric: The barycentric coordinates of count positions, each in a cell that is given: rows of 3
 *         (2D) or 4 (3D) numbers, one for each corner in the order of deldrift_cells.
 */

#ifndef DELDRIFT_READ_H
#define DELDRIFT_READ_H

#include "core.h"

/// What the index of a deldrift_location refers to.
enum
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  deldrift_location_kind : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// At the place of a vertex: index is its id, the lowest one if several share the place.
    DELDRIFT_LOCATION_VERTEX = 0,
    /// In a cell or on its boundary, at no vertex: index is that of the cell.
    DELDRIFT_LOCATION_CELL = 1,
    /// Outside the convex hull: index is that of a cell with a hull facet that faces the place.
    DELDRIFT_LOCATION_OUTSIDE = 2,
    /// There are no cells, as the vertices do not span the dimension, and no vertex is at the place: index is
    /// DELDRIFT_NONE. At the place of a vertex the kind is DELDRIFT_LOCATION_VERTEX, with or without cells.
    DELDRIFT_LOCATION_NO_CELLS = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum deldrift_location_kind deldrift_location_kind;
#else
typedef uint32_t deldrift_location_kind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// How values between vertices follow from those at vertices.
enum
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  deldrift_interpolation : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// Linear in each cell.
    DELDRIFT_INTERPOLATION_LINEAR = 0,
    /// By the natural neighbours of a position, which are the vertices that would share an edge with it. The weight of
    /// each is the length or area of the Voronoi facet between the two over their distance (Laplace's, or non-Sibsonian
    /// interpolation). Smooth except at vertices and on the circles or spheres of cells.
    DELDRIFT_INTERPOLATION_NATURAL_NEIGHBOUR = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum deldrift_interpolation deldrift_interpolation;
#else
typedef uint32_t deldrift_interpolation;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// In how many lists of deldrift_neighbour_lists a pair of vertices is.
enum
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  deldrift_pairs : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /// In the list of each of the two in whose ball the other one is: full lists.
    DELDRIFT_PAIRS_FULL = 0,
    /// Each pair of which the full lists have one vertex or both, once: half lists.
    DELDRIFT_PAIRS_HALF = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum deldrift_pairs deldrift_pairs;
#else
typedef uint32_t deldrift_pairs;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// Where a point lies.
typedef struct deldrift_location {
    /// What index names.
    deldrift_location_kind kind;
    /// A vertex or a cell.
    uint32_t index;
} deldrift_location;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// ---------------------------------------------------------------------------------------------------------------------
// Where points lie, and which vertices are near.
// ---------------------------------------------------------------------------------------------------------------------

/// Where a point lies, exactly, to *location.
///
/// In a periodic triangulation the location is that of the translation of a vertex or a cell that is there;
/// deldrift_locate_in_period tells which one. A point can be outside only where the box is open in some direction.
///
/// Cost: the cells that a walk crosses from where an earlier one ended, or from a vertex that is near: a few for most
/// sets, m at most. While there are no cells, constant; n in a periodic one.
///
/// Errors: DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_locate(const deldrift_triangulation *t,
                                const double *position,
                                deldrift_location *location);

/// Where count points lie, exactly, to locations, which has room for count. It gives what count calls of
/// deldrift_locate give, and is faster if each point is near the one before it. deldrift_locate_in_period also tells in
/// which period of a periodic triangulation.
///
/// hint: where to begin to look for the first point, for example the last answer of the call before; NULL if nothing is
/// known. It only matters for speed: it may be far away, from before a change, or name nothing. It may be one of
/// locations.
///
/// Cost: count times that of deldrift_locate.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_locate_points(const deldrift_triangulation *t,
                                       const double *positions,
                                       size_t count,
                                       const deldrift_location *hint,
                                       deldrift_location *locations);

/// Where count points lie, exactly, to locations, and in which period, to shifts. It is deldrift_locate_points for
/// programs that need the places of the corners.
///
/// positions, hint, locations: as for deldrift_locate_points. shifts: receives a row of 2 (2D) or 3 (3D) whole numbers
/// for each point, multiples of the vectors, 0 beyond the last of these. Translated by them, the vertex is at the
/// point, or the cell of deldrift_cell_shifts has the point; where the point is outside, the cell then has a facet of
/// the hull that faces it. So a corner of the cell is at its position and the sum of these multiples and of its own.
///
/// All shifts are 0 where there are no cells or vertices at the point, and where the triangulation is not periodic.
///
/// Cost: count times that of deldrift_locate.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_locate_in_period(const deldrift_triangulation *t,
                                          const double *positions,
                                          size_t count,
                                          const deldrift_location *hint,
                                          deldrift_location *locations,
                                          int64_t *shifts);

/// The vertex nearest to a point, to *vertex. Of several it is the one of the lowest id, or, where vertices have keys,
/// of the lowest key. It is DELDRIFT_NONE if the triangulation has no vertices.
///
/// In a periodic triangulation the distance is that of the nearest image of a vertex.
///
/// Cost: that of deldrift_locate, and the stars of the vertices on the way and of all that are nearest. While there are
/// no cells, n.
///
/// Errors: DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_nearest_vertex(const deldrift_triangulation *t,
                                        const double *position,
                                        uint32_t *vertex);

/// The vertex that represents this one in cells, to *representative. It is the one of the lowest id at the same place,
/// or, where vertices have keys, of the lowest key and then of the lowest id; with weights the heaviest one before these.
/// It is the vertex itself unless that is hidden.
///
/// Cost: constant; n for a hidden vertex of a triangulation with weights.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY if t has weights, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX.
deldrift_status deldrift_coincident_representative(const deldrift_triangulation *t,
                                                   uint32_t vertex,
                                                   uint32_t *representative);

/// The vertices that are hidden by place, ascending, each with the one that represents it. In a periodic triangulation vertices
/// share a place if they do in any period.
///
/// vertices, representatives: buffers with room for capacity ids each. count: receives the number of hidden vertices.
///
/// Cost: n; constant where there are none, and for the count alone; n for a periodic triangulation, and for one with
/// weights.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY if t is periodic or has weights.
deldrift_status deldrift_hidden_vertices(const deldrift_triangulation *t,
                                         uint32_t *vertices,
                                         uint32_t *representatives,
                                         size_t capacity,
                                         size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// What is near a place: the nearest vertices, those in a ball or a box, the cells that a new vertex would remove.
// ---------------------------------------------------------------------------------------------------------------------

/// The k vertices nearest to each of count positions: rows of k ids, by distance. At the same distance they are in the
/// order of ids, or of keys where vertices have keys. Entries beyond the number of vertices are DELDRIFT_NONE.
/// Distances are compared exactly. Hidden vertices count like others.
///
/// vertices: receives count rows of k ids, NULL if there are none.
///
/// It is fastest if each position is near the one before it. Without weights the first id of a row is that of
/// deldrift_nearest_vertex.
///
/// In a periodic triangulation each vertex comes once, by the distance of its nearest image (the minimum image); images
/// farther away do not count.
///
/// Cost: count times that of deldrift_nearest_vertex, the stars of the k vertices, and k log k; with k = 0 constant.
/// While there are no cells, and in a periodic triangulation with weights, count times n; n more in a periodic
/// triangulation with hidden vertices.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_nearest_vertices(const deldrift_triangulation *t,
                                          const double *positions,
                                          size_t count,
                                          size_t k,
                                          uint32_t *vertices);

/// The vertices in a closed ball, ascending by id, hidden ones included. They are those whose squared distance from
/// centre is at most squared_radius, exactly.
///
/// centre: 2 or 3 numbers. squared_radius: 0 or more; infinity is all vertices. vertices: a buffer with room for
/// capacity ids; deldrift_vertex_count is always enough. count: receives their number.
///
/// In a periodic triangulation a vertex is in the ball if any image of it is; each is told once. The ball may be larger
/// than the box.
///
/// Cost: that of deldrift_nearest_vertex, the stars of the vertices in the ball, and k log k for the k of them; n log n
/// at most but for the former. While there are no cells, and in a periodic triangulation with hidden vertices, n.
///
/// Errors: DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE for a squared radius that is negative or
/// NaN, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_vertices_in_ball(const deldrift_triangulation *t,
                                          const double *centre,
                                          double squared_radius,
                                          uint32_t *vertices,
                                          size_t capacity,
                                          size_t *count);

/// For each vertex the others that are near it, all in one call: the neighbour lists of particle codes.
///
/// The list of a vertex has the vertices whose squared distance from it is at most its squared radius, exactly. They
/// are those that deldrift_vertices_in_ball finds around it, hidden ones included, but not the vertex itself. Hidden
/// vertices have lists, too. Those of removed and of staged vertices are empty. Each list ascends by id.
///
/// squared_radii: one number for all lists, radius_count being 1; or one for each id, radius_count being
/// deldrift_id_count. Each is 0 or more, and infinity is all vertices. Entries of vertices without a list are not
/// looked at. mask: an entry for each vertex id. Only vertices whose entry is not 0 have a list, which may have others
/// in it. NULL for all. mask_count: deldrift_id_count; without a mask it is not looked at. pairs: DELDRIFT_PAIRS_FULL,
/// or DELDRIFT_PAIRS_HALF for each pair once. Where radii differ, one vertex may be in the ball of another and not the
/// other way round. Half lists have each pair that full lists have one way or both: two vertices with lists are a pair
/// if their distance is at most the greater one of their radii. It is in the list of the lower id, or, if only one of
/// the two has a list, in that.
///
/// offsets: a buffer for offset_count numbers, which must be deldrift_id_count + 1. The list of vertex v begins in
/// neighbours at the index that is entry v of offsets, and ends before entry v + 1. neighbours: a buffer with room for
/// capacity ids. shifts: one with room for as many rows of 2 (2D) or 3 (3D) whole numbers: in which period each
/// neighbour is, as deldrift_edge_shifts has them. count: receives the number of entries. With NULL for neighbours and
/// shifts and capacity 0 offsets are filled, and nothing is kept. A program that asks again and again, as in each step,
/// keeps its buffers, with some room to spare, and so asks once.
///
/// In a periodic triangulation a list has every image that is near, each with its shift, ascending by id and by shift.
/// Where the radius is large beside the box, there are several images of one vertex, and images of the vertex itself.
/// Half lists have one of the two ways between two images. Of those from a vertex to itself it is the one whose shift
/// has a positive number as the first that is not 0. Radii are refused that are so large that places of images would be
/// rounded. Up to eight times the least distance between opposite sides of the reduced box is always possible. Where
/// the triangulation is not periodic, shifts are 0.
///
/// Runs on several threads, as the options allow. The lists do not depend on how many there are. Takes memory for the
/// places and for all lists while it runs, and writes nothing until all are known.
///
/// Cost: n log n, the entries, and k log k for the k of each list. With one radius for all, that is so for every set,
/// however unevenly it is spread. What is looked at besides is at most a constant times n and the entries, and mostly
/// some five times these. Where radii differ by powers of two of many sizes, what is looked at for each size is at most
/// n times the root of the number of entries.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT, DELDRIFT_INVALID_VALUE for a squared radius that is negative
/// or NaN, or too large for a periodic triangulation, and for other pairs, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
deldrift_status deldrift_neighbour_lists(const deldrift_triangulation *t,
                                         const double *squared_radii,
                                         size_t radius_count,
                                         const uint8_t *mask,
                                         size_t mask_count,
                                         deldrift_pairs pairs,
                                         size_t *offsets,
                                         size_t offset_count,
                                         uint32_t *neighbours,
                                         int64_t *shifts,
                                         size_t capacity,
                                         size_t *count);

/// The vertices in a closed box, ascending by id, hidden ones included. Each of their coordinates is at least that of
/// low and at most that of high.
///
/// low, high: 2 or 3 numbers each, which may be infinite. Where one of low is above that of high there are none.
/// vertices: a buffer with room for capacity ids; deldrift_vertex_count is always enough. count: receives their number.
///
/// In a periodic triangulation a vertex is in the box if any image of it is; each is told once. The box is not rounded,
/// and may be larger than the period. One that is 10^20 periods away is refused. Where vectors go along several axes,
/// as in a skewed box, there is a condition on one that is thousands of periods long, or infinite, along some of these
/// axes. It has to be as wide as all these vectors together along each, or infinite along all but one.
///
/// Cost: that of deldrift_locate, the cells whose bounding boxes meet the box, the facets of the hull that are seen
/// from it, and k log k for the k vertices in it; n log n at most but for the first. While there are no cells, n. In a
/// periodic triangulation that of deldrift_vertices_in_ball where the box is shorter than half of the shortest vector,
/// else n; and, where vectors go along several axes, the periods that the box meets, for each vertex.
///
/// Errors: DELDRIFT_INVALID_VALUE for NaN, or for a box that is too long, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_vertices_in_box(const deldrift_triangulation *t,
                                         const double *low,
                                         const double *high,
                                         uint32_t *vertices,
                                         size_t capacity,
                                         size_t *count);

/// The cells that the insertion of a vertex at a position would remove, in no particular order. Their circle or sphere
/// has the position inside, exactly, with ties broken as for a vertex of the highest id. At the place of a vertex, and
/// while there are no cells, there are none.
///
/// hint: where to begin to look for it, as for deldrift_locate_points; NULL if nothing is known. cells: a buffer with
/// room for capacity indices. count: receives their number.
///
/// A position outside the convex hull may be in the circle or sphere of no cell: then the insertion removes none, and
/// joins the vertex to the facets of the hull that it sees.
///
/// In a periodic triangulation a cell is told, once, if a translation of it is in conflict: it would be removed by the
/// insertion of the vertex with all of its images. A position outside the convex hull is refused, as facets without an
/// end are seen from there.
///
/// Cost: that of deldrift_locate, the cells found, and the facets of the hull that are seen from the position.
///
/// Errors: DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_PERIODIC outside the hull of a periodic triangulation,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_conflicts(const deldrift_triangulation *t,
                                   const double *position,
                                   const deldrift_location *hint,
                                   uint32_t *cells,
                                   size_t capacity,
                                   size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// The cells, hull facets and vertices that a vertex in a box could change.
// ---------------------------------------------------------------------------------------------------------------------

/// The cells that a vertex at a place in one of some boxes could change. With deldrift_hull_facets_in_reach, they are
/// what a process has to know of vertices that it does not have, given where these may be.
///
/// A cell is in reach of a box if its closed circumscribed disc or ball meets the closed box. Exactly these are told,
/// decided without rounding. A vertex that is inserted at, or moves to, a place in the box removes no other cell,
/// whatever its id. It joins no facet of the hull but those in reach, and those in whose line or plane its place is,
/// where the cell behind is in reach.
///
/// low, high: box_count rows of the least and the greatest coordinates of each box, which may be infinite. Places
/// beyond the range of coordinates, of magnitudes above 1e57, do not count. A box is empty, and nothing in reach of it,
/// where one of low is above that of high. It may be a place, or flat. The outside of a box is 4 (2D) or 6 (3D) boxes
/// with infinite sides. mask: an entry for each vertex id. Only cells count that have a corner at the place of a vertex
/// whose entry is not 0. NULL for all cells. mask_count: deldrift_id_count; without a mask it is not looked at.
///
/// cells, centres, radii: buffers with room for capacity cells. They receive the indices of those in reach of any of
/// the boxes, ascending and each once; points; and numbers. The closed ball with this centre and radius certainly has
/// the closed disc or ball of the cell in it. It is larger by some 1e-12 of the radius and last bits of the
/// coordinates, or by up to 4e-9 of the radius where the cell is nearly flat. Where numbers do not suffice, the radius
/// is infinite and the centre a corner of the cell. A ball may cover all vertices though few are in that of the cell,
/// if its radius is 1e8 times their extent: whether the cell is in reach does not depend on that. count: receives the
/// number of cells.
///
/// While there are no cells, none are told: then a vertex anywhere could change all there is. Where cells are
/// constrained by segments, those are told whose discs meet the box and that are connected, by such cells, with those
/// that have a place of the box. Segments between them do not count. All that the insertion of a vertex in the box
/// would remove are among them.
///
/// With weights a vertex in the box may have any weight up to the greatest that there is, or up to 0 if that is more: the cells told
/// are those in respect of which a place of the box has a power of at most this weight. Those that have a place of
/// the box are among them, and so is the cell that hides a vertex there. In a mask and in lists of vertices only those count
/// then that are corners.
///
/// Cost: for each box that of deldrift_locate, and the cells and hull facets in its reach, whether in the mask or not;
/// k log k for the k cells told. With weights n as well, once.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT for a mask of another length, DELDRIFT_INVALID_VALUE for NaN,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_cells_in_reach(const deldrift_triangulation *t,
                                        const double *low,
                                        const double *high,
                                        size_t box_count,
                                        const uint8_t *mask,
                                        size_t mask_count,
                                        uint32_t *cells,
                                        double *centres,
                                        double *radii,
                                        size_t capacity,
                                        size_t *count);

/// The facets of the convex hull that a place in one of some boxes is strictly beyond, exactly. A vertex there would be
/// joined to them.
///
/// low, high, box_count, mask, mask_count: as for deldrift_cells_in_reach; with a mask, only facets count that have a
/// corner at the place of a vertex of the mask. cells, corners: buffers with room for capacity numbers, which receive
/// the cell of each facet and which of its corners (0, 1, ...) is opposite, as deldrift_hull_facets has them, ascending
/// and each once. count: receives the number of facets.
///
/// While there are no cells, there are none.
///
/// Cost: that of deldrift_cells_in_reach.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT for a mask of another length, DELDRIFT_INVALID_VALUE for NaN,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_hull_facets_in_reach(const deldrift_triangulation *t,
                                              const double *low,
                                              const double *high,
                                              size_t box_count,
                                              const uint8_t *mask,
                                              size_t mask_count,
                                              uint32_t *cells,
                                              uint8_t *corners,
                                              size_t capacity,
                                              size_t *count);

/// For each of some boxes the vertices of the cells and hull facets in its reach. A process sends them to another one
/// whose vertices are in the box.
///
/// They are the corners of what deldrift_cells_in_reach and deldrift_hull_facets_in_reach tell for this box alone, and
/// the vertices hidden behind them; with a mask, those of which the entry is not 0. low, high, box_count, mask,
/// mask_count: as there.
///
/// vertices: a buffer with room for capacity ids, which receives a list for each box, ascending, one after the other.
/// offsets: a buffer with room for box_count + 1 numbers. The list of box k begins in vertices at the index that is
/// entry k of offsets, and ends before entry k + 1. count: receives the number of entries.
///
/// While there are no cells, a vertex anywhere could change all there is: all vertices of the mask are in reach of each
/// box that is not empty.
///
/// Cost: that of deldrift_cells_in_reach, and k log k for the k vertices of each list; while there are no cells, n for
/// each box.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT for a mask of another length, DELDRIFT_INVALID_VALUE for NaN,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_vertices_in_reach(const deldrift_triangulation *t,
                                           const double *low,
                                           const double *high,
                                           size_t box_count,
                                           const uint8_t *mask,
                                           size_t mask_count,
                                           uint32_t *vertices,
                                           size_t *offsets,
                                           size_t capacity,
                                           size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// What meets what: edges, neighbours and cells of vertices, mirror indices, ordered stars.
// ---------------------------------------------------------------------------------------------------------------------

/// The edges: rows of two vertex ids, the lower one first, each edge once, in lexicographic order. They depend on
/// positions and ids alone.
///
/// edges: a buffer with room for capacity rows. count: receives the number of edges. The count alone takes constant
/// time.
///
/// Takes some passes over the cells, and memory for the cells of each vertex while it runs.
///
/// Cost: n + m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_edges(const deldrift_triangulation *t,
                               uint32_t *edges,
                               size_t capacity,
                               size_t *count);

/// The neighbours of all vertices: for each id the vertices with which it shares an edge, ascending, one list after the
/// other. Removed and hidden vertices have none. The lists depend on positions and ids alone.
///
/// offsets: a buffer for offset_count numbers, which must be deldrift_id_count + 1. The list of vertex v begins in
/// neighbours at the index that is entry v of offsets, and ends before entry v + 1. neighbours: a buffer with room for
/// capacity ids. Where offsets is NULL, offset_count is not looked at; without neighbours capacity must be 0. count:
/// receives the number of entries, twice that of the edges. The count alone takes constant time.
///
/// In a periodic triangulation a vertex is listed once for each edge that leads to it: several times where edges lead
/// to it in several periods, and twice in its own list for each edge to itself.
///
/// Takes some passes over the cells, and while it runs memory for the lists and for the cells of each vertex.
///
/// Cost: n + m, and d log d for the d neighbours of each vertex; m log m for a periodic triangulation.
///
/// Errors: DELDRIFT_WRONG_COUNT, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_vertex_neighbours(const deldrift_triangulation *t,
                                           uint32_t *offsets,
                                           size_t offset_count,
                                           uint32_t *neighbours,
                                           size_t capacity,
                                           size_t *count);

/// The cells of all vertices: for each id the indices of the cells that have it as a corner, ascending, one list
/// after the other. Removed and hidden vertices have none.
///
/// offsets: a buffer for offset_count numbers, which must be deldrift_id_count + 1. The list of vertex v begins in
/// cells at the index that is entry v of offsets, and ends before entry v + 1. cells: a buffer with room for capacity
/// indices. Where offsets is NULL, offset_count is not looked at; without cells capacity must be 0. count: receives the
/// number of entries, 3 (2D) or 4 (3D) times that of the cells. The count alone takes constant time.
///
/// In a periodic triangulation a cell is listed once for each of its corners that is the vertex, in whatever period.
///
/// Takes two passes over the cells, and memory for the lists while it runs.
///
/// Cost: n + m; m log m for a periodic triangulation.
///
/// Errors: DELDRIFT_WRONG_COUNT, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_vertex_cells(const deldrift_triangulation *t,
                                      uint32_t *offsets,
                                      size_t offset_count,
                                      uint32_t *cells,
                                      size_t capacity,
                                      size_t *count);

/// A cell of each vertex: for each id the index of the first cell of which the vertex is a corner. Vertices that are
/// hidden or removed, or whose insertion is staged, have DELDRIFT_NONE, and so have all while there are no cells.
///
/// cells: a buffer with room for capacity indices. count: receives deldrift_id_count.
///
/// Cost: n + m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_cell_of_each_vertex(const deldrift_triangulation *t,
                                             uint32_t *cells,
                                             size_t capacity,
                                             size_t *count);

/// Cells that have given vertices as corners: for each of count simplices the index of one, DELDRIFT_NONE if there is
/// none. So it tells which edges of a list are in the triangulation, and which facets.
///
/// corners_per_simplex: 1 (a cell of each vertex), 2 (edges), 3 (triangles) or, in 3D, 4. vertices: count rows of as
/// many ids, in any order. A hidden vertex stands for the one that represents it. A simplex with two corners at the
/// same place is in no cell, unless t is periodic and a cell has them in different periods. cells: receives count
/// indices.
///
/// Cost: for each simplex the least number of cells that a corner of it has. Where there are more simplices than an
/// eighth of the vertices, also n + m.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_VALUE for another number of corners, DELDRIFT_NO_SUCH_VERTEX,
/// DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_find_simplices(const deldrift_triangulation *t,
                                        uint32_t corners_per_simplex,
                                        const uint32_t *vertices,
                                        size_t count,
                                        uint32_t *cells);

/// The mirror indices of all facets, in the order of deldrift_cells. Entry i of the row of a cell is about the facet
/// opposite corner i. It is the corner (0, 1, ...) of the neighbour beyond that is opposite the same facet, 255 on the
/// hull. In a periodic triangulation a cell may be its own neighbour.
///
/// mirrors: a buffer with room for capacity rows of 3 (2D) or 4 (3D) bytes. count: receives the number of cells.
///
/// Cost: m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_mirror_indices(const deldrift_triangulation *t,
                                        uint8_t *mirrors,
                                        size_t capacity,
                                        size_t *count);

/// The mirror index of one facet, to *mirror: the corner of the neighbour beyond that is opposite the same facet,
/// DELDRIFT_NONE on the hull.
///
/// cell, corner: the facet opposite this corner (0, 1, ...) of this cell, an index into deldrift_cells.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_NO_SUCH_FACET, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_mirror_index(const deldrift_triangulation *t,
                                      uint32_t cell,
                                      uint32_t corner,
                                      uint32_t *mirror);

/// The star of a vertex of the plane, counter-clockwise: the indices of the cells that have it as a corner. Each cell
/// shares an edge with the next one, and the last one with the first one, unless the vertex is on the convex hull.
/// There the first cell is the one at the hull's edge that leaves the vertex when the hull is passed counter-clockwise.
/// Elsewhere it is the one of lowest index. A hidden vertex has the star of its representative.
///
/// cells: a buffer with room for capacity indices. count: receives their number.
///
/// Cost: the cells of the star.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_ordered_star(const deldrift_triangulation *t,
                                      uint32_t vertex,
                                      uint32_t *cells,
                                      size_t capacity,
                                      size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// Values between vertices.
// ---------------------------------------------------------------------------------------------------------------------

/// Interpolates values of the vertices at count positions.
///
/// values: value_count rows of n_values numbers, one for each id (value_count must be deldrift_id_count). Rows of
/// removed vertices are not used, and for a hidden vertex the row of its representative counts. hint: as for
/// deldrift_locate_points. It is fastest if each position is near the one before it. outside: what positions outside
/// the convex hull get, n_values numbers; NULL for NaN. While there are no cells, all positions but those of vertices
/// are outside. results: receives count rows of n_values numbers. values may also be NULL if n_values is 0.
///
/// At the place of a vertex the result is that of the vertex. Elsewhere it is rounded, and linear functions are
/// reproduced but for rounding, with either method. Which cell or which neighbours count is decided exactly. A position
/// takes as long as deldrift_locate_points, and with natural neighbours some microseconds more.
///
/// In a periodic triangulation an image of a vertex has the values of the vertex. Natural neighbours of a position are
/// images, several of one vertex in a small box.
///
/// Cost: count times that of deldrift_locate and n_values; with natural neighbours also the cells whose circle or
/// sphere has the position inside.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_VALUE for a method that this version does not have,
/// DELDRIFT_WRONG_COUNT, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE (of positions), DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_interpolate(const deldrift_triangulation *t,
                                     deldrift_interpolation method,
                                     const double *values,
                                     size_t value_count,
                                     size_t n_values,
                                     const double *positions,
                                     size_t count,
                                     const deldrift_location *hint,
                                     const double *outside,
                                     double *results);

/// The barycentric coordinates of count positions, each in a cell that is given: rows of 3 (2D) or 4 (3D) numbers, one
/// for each corner in the order of deldrift_cells. They are for programs that keep weights, to carry values with them
/// more than once. The weights of deldrift_interpolate may differ in last bits, and more where a cell is flat.
///
/// cells: count indices into deldrift_cells, as deldrift_locate_points gives them. DELDRIFT_NONE is no cell: its row is
/// NaN. weights: receives count rows. A position may be outside of its cell: then some of its coordinates are negative.
///
/// The sign of each is exact, and so is 0; the value has a relative error of at most 2.5e-13, however flat the cell.
/// (Where an area, a volume or the value itself is below the least normal number, 2.2e-308, it is less accurate.) What
/// is beyond the range of numbers is infinite. A row adds up to 1 but for these errors.
///
/// In a periodic triangulation the weights are those in the translation of the cell that has the position inside or on
/// its boundary; where there is none, the row is NaN.
///
/// Cost: count.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_NO_SUCH_FACET if there is no
/// cell of an index, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_barycentric(const deldrift_triangulation *t,
                                     const double *positions,
                                     const uint32_t *cells,
                                     size_t count,
                                     double *weights);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif // DELDRIFT_READ_H
