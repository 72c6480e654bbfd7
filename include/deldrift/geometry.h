/*
 * deldrift/geometry.h: Circumspheres, volumes, masks and boundaries of cells; exact signs.
 *
 * A part of deldrift.h, the first page of which has the rules that hold for all functions.
 *
 * Made by `make header` from these files of src/capi: geometry.rs, listed.rs, predicates.rs. Change it there.
 *
 * Geometry of the cells: circumspheres, volumes, masks by circumradius, and the facets around a mask.
 *
 *     deldrift_circumcentres: The circumcentres and squared circumradii of all cells, in the order of deldrift_cells.
 *     deldrift_volumes: The areas (2D) or volumes (3D) of all cells, in the order of deldrift_cells.
 *     deldrift_mask_by_circumradius: Which cells have a circumradius of at most a given one, as for an alpha shape, in
 *         the order of deldrift_cells.
 *     deldrift_mask_without_flat_cells: Which cells are more than what the rounding of a straight or flat side has
 *         made, in the order of deldrift_cells.
 *     deldrift_mask_boundary: The boundary of some of the cells: the facets between a cell in a mask and one that is
 *         not in it, or the outside.
 *     deldrift_hull_facets: The facets of the convex hull, in ascending order of cell and then of corner.
 *
 * Geometry of some of the cells: those around vertices, and entries of arrays that a program keeps for all cells.
 *
 *     deldrift_cells_around: The cells around some vertices: those that have at least one of the vertices as a corner,
 *         ascending, each once.
 *     deldrift_update_circumcentres: Computes circumcentres and squared circumradii of some cells again, in arrays that
 *         deldrift_circumcentres has filled.
 *     deldrift_update_volumes: Computes the areas (2D) or volumes (3D) of some cells again, in an array that
 *         deldrift_volumes has filled.
 *     deldrift_update_mask_by_circumradius: Decides for some cells again whether their circumradius is at most a given
 *         one, in a mask that deldrift_mask_by_circumradius has filled for the same one.
 *
 * Exact signs for points of the caller's own. They need no triangulation.
 *
 *     deldrift_orientation: The orientation of points, exactly, to *sign: 1, -1 or 0.
 *     deldrift_in_sphere: Whether a point is inside the circle or sphere through others, exactly, to *sign: 1 inside,
 *         -1 outside, 0 on it.
 *     deldrift_in_power_sphere: Whether a point with a weight is inside the power circle or power sphere of others,
 *         exactly, to *sign: 1 inside, -1 outside, 0 on it.
 */

#ifndef DELDRIFT_GEOMETRY_H
#define DELDRIFT_GEOMETRY_H

#include "core.h"

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// ---------------------------------------------------------------------------------------------------------------------
// Geometry of the cells: circumspheres, volumes, masks by circumradius, and the facets around a mask.
// ---------------------------------------------------------------------------------------------------------------------

/// The circumcentres and squared circumradii of all cells, in the order of deldrift_cells.
///
/// centres: a buffer with room for capacity points. squared_radii: a buffer with room for capacity numbers. count:
/// receives the number of cells.
///
/// Rounded: a coordinate of a centre is off by at most 1e-9 circumradii and its own rounding, a squared radius by 4e-9
/// of itself, however flat the cell. Unless the cell is nearly flat, they are off by a few last bits. What is too large
/// for a number is infinite; nothing is NaN. One pass over the cells; nearly flat ones take a microsecond each.
///
/// In a periodic triangulation a centre is that of the cell whose corner of the lowest id is at its own position, as
/// deldrift_cell_shifts has it. Its rounding may be twice that of its coordinates and of the position's.
///
/// Cost: m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_circumcentres(const deldrift_triangulation *t,
                                       double *centres,
                                       double *squared_radii,
                                       size_t capacity,
                                       size_t *count);

/// The areas (2D) or volumes (3D) of all cells, in the order of deldrift_cells.
///
/// volumes: a buffer with room for capacity numbers. count: receives the number of cells.
///
/// Rounded, with a relative error of at most 1e-9, and of a few last bits unless the cell is nearly flat: always
/// positive. (Below the least normal number, 2.2e-308, they are less accurate.) One pass over the cells; nearly flat
/// ones take up to a microsecond each.
///
/// Cost: m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_volumes(const deldrift_triangulation *t,
                                 double *volumes,
                                 size_t capacity,
                                 size_t *count);

/// Which cells have a circumradius of at most a given one, as for an alpha shape, in the order of deldrift_cells. It is
/// 1 for those whose squared circumradius is at most squared_radius, 0 for the others.
///
/// squared_radius: 0 or more, with weights any number; infinity is all cells. mask: a buffer with room for capacity
/// bytes. count: receives the number of cells.
///
/// Exact: squared_radius, as given, is compared exactly with the squared radius of the circle or sphere through the
/// positions. One pass over the cells; where the two nearly agree, a cell takes a microsecond.
///
/// Cost: m.
///
/// Errors: DELDRIFT_INVALID_VALUE for a squared radius that is negative or NaN, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_mask_by_circumradius(const deldrift_triangulation *t,
                                              double squared_radius,
                                              uint8_t *mask,
                                              size_t capacity,
                                              size_t *count);

/// Which cells are more than what the rounding of a straight or flat side has made, in the order of deldrift_cells. It
/// is 0 for cells along the convex hull that are flat, 1 for the others.
///
/// tolerance: 0 or more, such as 1e-9; with 0 no cell is flat. A cell is flat if its least height is at most tolerance
/// times its longest edge. It has 0 if it is flat, and has a facet on the hull or on a cell that has 0. mask: a buffer
/// with room for capacity bytes. count: receives the number of cells.
///
/// Vertices that were meant to be on one line or plane are not, once their coordinates are rounded, and the hull goes
/// over flat cells from one to the other. Those cells are exactly Delaunay, and useless where a program divides by
/// areas or volumes. Where no vertices but those of a side are nearly in line with it, the mask leaves these cells out
/// and keeps all others: deldrift_mask_boundary then gives the sides as they were meant. Flat cells elsewhere are kept,
/// as leaving them out would leave holes.
///
/// Rounded: a cell may get either number if its quotient of height and edge differs from tolerance by less than
/// 1.1e-9 + 2e-15 / tolerance of it.
///
/// Cost: m.
///
/// Errors: DELDRIFT_INVALID_VALUE for a tolerance that is negative or NaN, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_mask_without_flat_cells(const deldrift_triangulation *t,
                                                 double tolerance,
                                                 uint8_t *mask,
                                                 size_t capacity,
                                                 size_t *count);

/// The boundary of some of the cells: the facets between a cell in a mask and one that is not in it, or the outside.
///
/// mask: mask_count bytes, one for each cell in the order of deldrift_cells (mask_count must be deldrift_cell_count). A
/// cell is in it if its byte is not 0. facets: a buffer with room for capacity rows of 2 (2D) or 3 (3D) vertex ids.
/// Facets are seen from outside. In 2D the cell in the mask is on the left of the edge from the first vertex to the
/// second. In 3D the vertices are in counter-clockwise order as seen from the side away from the cell. cells, corners:
/// buffers with room for capacity numbers, which receive that cell and which of its corners (0, 1, ...) is opposite the
/// facet. count: receives the number of facets.
///
/// Facets are in ascending order of cell and then of corner. Exact. Two passes over the cells. In a periodic
/// triangulation each is where deldrift_cell_shifts has its cell.
///
/// Cost: m.
///
/// Errors: DELDRIFT_WRONG_COUNT, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_mask_boundary(const deldrift_triangulation *t,
                                       const uint8_t *mask,
                                       size_t mask_count,
                                       uint32_t *facets,
                                       uint32_t *cells,
                                       uint8_t *corners,
                                       size_t capacity,
                                       size_t *count);

/// The facets of the convex hull, in ascending order of cell and then of corner.
///
/// facets, cells, corners: as for deldrift_mask_boundary, with all cells in the mask. count: receives the number of
/// facets.
///
/// Exact. One pass over the cells; the count alone takes constant time. A periodic triangulation has no facets unless
/// its box is open somewhere; counting them takes a pass over the cells.
///
/// Cost: m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_hull_facets(const deldrift_triangulation *t,
                                     uint32_t *facets,
                                     uint32_t *cells,
                                     uint8_t *corners,
                                     size_t capacity,
                                     size_t *count);

// ---------------------------------------------------------------------------------------------------------------------
// Geometry of some of the cells: those around vertices, and entries of arrays that a program keeps for all cells.
// ---------------------------------------------------------------------------------------------------------------------

/// The cells around some vertices: those that have at least one of the vertices as a corner, ascending, each once.
///
/// vertices: vertex_count ids, in any order, some maybe more than once; hidden vertices have no cells. cells: a buffer
/// with room for capacity indices; deldrift_cell_count is always enough. count: receives the number of indices.
///
/// After a commit, only two kinds of cells have changed their shape: those around the vertices that have moved, and
/// those that deldrift_take_changes lists as created. With the functions that follow, a program that keeps an array for
/// all cells updates those entries alone.
///
/// Cost: the cells of the stars, and k log k for the k of them; m at most, and for a periodic triangulation.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX,
/// DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_cells_around(const deldrift_triangulation *t,
                                      const uint32_t *vertices,
                                      size_t vertex_count,
                                      uint32_t *cells,
                                      size_t capacity,
                                      size_t *count);

/// Computes circumcentres and squared circumradii of some cells again, in arrays that deldrift_circumcentres has
/// filled. For each index in cells, the entry of this index becomes that of the cell. Other entries are not touched.
///
/// cells: cell_count indices into deldrift_cells, in any order, some maybe more than once. centres: an array with room
/// for capacity points. squared_radii: an array with room for capacity numbers. One that is NULL is not filled, but not
/// both. capacity: at least deldrift_cell_count.
///
/// After a change an array for all cells is brought up to date in three steps. Its entries follow renumbered cells as
/// deldrift_changes says. Then this is called for the created cells, and then for those that deldrift_cells_around
/// gives for the vertices that have moved. The values are then those of deldrift_circumcentres, with the same accuracy.
/// Their last bits may differ where a cell was removed and created again in between, as they depend on the order in
/// which the library keeps its corners. It pays while fewer than a tenth of the vertices move, or a third if they are
/// neighbours. Beyond that the pass of deldrift_circumcentres is faster.
///
/// Cost: cell_count.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_FACET for an index that is no cell's, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_update_circumcentres(const deldrift_triangulation *t,
                                              const uint32_t *cells,
                                              size_t cell_count,
                                              double *centres,
                                              double *squared_radii,
                                              size_t capacity);

/// Computes the areas (2D) or volumes (3D) of some cells again, in an array that deldrift_volumes has filled. Entries
/// are as for deldrift_update_circumcentres.
///
/// cells: cell_count indices into deldrift_cells, in any order, some maybe more than once. volumes: an array with room
/// for capacity numbers. capacity: at least deldrift_cell_count.
///
/// deldrift_update_circumcentres has the steps by which an array for all cells is brought up to date, and when that
/// pays. The values are then those of deldrift_volumes, with its accuracy; last bits may differ where a cell was
/// removed and created again.
///
/// Cost: cell_count.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_FACET for an index that is no cell's, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_update_volumes(const deldrift_triangulation *t,
                                        const uint32_t *cells,
                                        size_t cell_count,
                                        double *volumes,
                                        size_t capacity);

/// Decides for some cells again whether their circumradius is at most a given one, in a mask that
/// deldrift_mask_by_circumradius has filled for the same one. Entries are as for deldrift_update_circumcentres.
///
/// cells: cell_count indices into deldrift_cells, in any order, some maybe more than once. squared_radius: 0 or more,
/// with weights any number; infinity is all cells. mask: an array with room for capacity bytes. capacity: at least
/// deldrift_cell_count.
///
/// deldrift_update_circumcentres has the steps by which an array for all cells is brought up to date, and when that
/// pays.
///
/// Exact: a mask that is kept up to date is that of a full pass, byte by byte.
///
/// Cost: cell_count.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_VALUE for a squared radius that is negative or NaN,
/// DELDRIFT_NO_SUCH_FACET for an index that is no cell's, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_update_mask_by_circumradius(const deldrift_triangulation *t,
                                                     const uint32_t *cells,
                                                     size_t cell_count,
                                                     double squared_radius,
                                                     uint8_t *mask,
                                                     size_t capacity);

// ---------------------------------------------------------------------------------------------------------------------
// Exact signs for points of the caller's own. They need no triangulation.
// ---------------------------------------------------------------------------------------------------------------------

/// The orientation of points, exactly, to *sign: 1, -1 or 0.
///
/// dimension: 2 or 3. points: dimension + 1 points. For 3 points in the plane the sign is 1 if they are in
/// counter-clockwise order, -1 if they are in clockwise order, and 0 on a line. For 4 points a, b, c, d in space it is
/// the sign of the determinant of the rows b - a, c - a, d - a, and 0 on a plane. The cells of a triangulation have
/// orientation 1. With another point in the place of a corner it tells on which side of the opposite facet that point
/// lies: 1 on the side of the cell, 0 on the facet's line or plane.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE.
deldrift_status deldrift_orientation(uint32_t dimension,
                                     const double *points,
                                     int32_t *sign);

/// Whether a point is inside the circle or sphere through others, exactly, to *sign: 1 inside, -1 outside, 0 on it.
///
/// dimension: 2 or 3. points: dimension + 2 points: those that the circle or sphere goes through, of orientation 1
/// (deldrift_orientation), and the one that is asked about. If their orientation is -1, the sign is the opposite one.
/// If it is 0 there is no circle or sphere, and the sign has no meaning. Ties are not broken.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE.
deldrift_status deldrift_in_sphere(uint32_t dimension,
                                   const double *points,
                                   int32_t *sign);

/// Whether a point with a weight is inside the power circle or power sphere of others, exactly, to *sign: 1 inside, -1
/// outside, 0 on it.
///
/// The power of a place x to a point p of weight w is |x - p|^2 - w. The centre of the power sphere has one power to all
/// of its points, and a point is inside if the centre has a lower one to it. With equal weights this is
/// deldrift_in_sphere. It is the test of regular triangulations, of which power diagrams are the duals.
///
/// dimension: 2 or 3. points: dimension + 2 points, as deldrift_in_sphere takes them. weights: as many numbers, of
/// magnitude up to 1e114, negative ones included: the square of a radius for a circle or a sphere around its point.
/// Ties are not broken.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE for a weight.
deldrift_status deldrift_in_power_sphere(uint32_t dimension,
                                         const double *points,
                                         const double *weights,
                                         int32_t *sign);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif // DELDRIFT_GEOMETRY_H
