/*
 * deldrift/files.h: Copies, saved data, and files for other programs.
 *
 * A part of deldrift.h, the first page of which has the rules that hold for all functions.
 *
 * Made by `make header` from these files of src/capi: saving.rs. Change it there.
 *
 * A triangulation as bytes, in memory or in a file, and a second one like it.
 *
 *     deldrift_clone: Makes an independent copy of the triangulation, to *out.
 *     deldrift_save: Saves the triangulation: writes bytes from which deldrift_load makes one like it, on this machine
 *         or any other.
 *     deldrift_load: Makes a triangulation of bytes that deldrift_save has written, to *out.
 *     deldrift_save_file: Saves the triangulation to a file, as deldrift_save does.
 *     deldrift_load_file: Makes a triangulation of a file that deldrift_save_file has written, to *out, as
 *         deldrift_load does.
 *     deldrift_write_vtu: Writes a file for ParaView and VTK: an unstructured grid of the cells, in VTK's XML format
 *         (.vtu).
 *     deldrift_write_medit: Writes a file for Mmg, FreeFem, Gmsh and others: MEDIT's text format (.mesh).
 */

#ifndef DELDRIFT_FILES_H
#define DELDRIFT_FILES_H

#include "core.h"

/// Numbers for each vertex, or for each cell, that deldrift_write_vtu writes along.
typedef struct deldrift_field {
    /// Its name: UTF-8, with a NUL at the end, without control characters, U+FFFE and U+FFFF, which XML does not have.
    /// Fields of vertices have different names, none of them "vertex". Fields of cells have different names, none of
    /// them "marker" if there are segments.
    const char *name;
    /// components numbers for each vertex, by id (those of removed vertices are not written), or for each cell, by
    /// index.
    const double *values;
    /// How many numbers each has, at least 1.
    size_t components;
} deldrift_field;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// ---------------------------------------------------------------------------------------------------------------------
// A triangulation as bytes, in memory or in a file, and a second one like it.
// ---------------------------------------------------------------------------------------------------------------------

/// Makes an independent copy of the triangulation, to *out.
///
/// All is as in t: positions, ids, segments, cells with their indices, hidden vertices, what is staged, the timestamp,
/// statistics, options, vectors, the changes that deldrift_take_changes has not given yet, and what the algorithm keeps
/// between commits. After the same calls both have the same cells. The callbacks of the options are called for either,
/// so what user_data points to must live as long as both. Views, and changes that have been taken, belong to t alone.
///
/// Takes a pass over the memory of t, and as much memory again; nothing is triangulated. If deldrift_cells has been
/// called before, this also does what the next deldrift_cells would do.
///
/// Cost: n + m.
///
/// Errors: DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_clone(const deldrift_triangulation *t,
                               deldrift_triangulation **out);

/// Saves the triangulation: writes bytes from which deldrift_load makes one like it, on this machine or any other.
///
/// Saved are positions, ids, segments, removed and hidden vertices, cells with their indices, staged moves, insertions
/// and removals, the timestamp and statistics. Of a periodic triangulation the vectors as deldrift_vectors tells them,
/// those that are staged, and the periods of vertices are saved, too, and all images with their cells. Not saved are
/// the options, what the algorithm keeps between commits, which changes have been taken, the answers of
/// deldrift_refined_weights, deldrift_refined_sizes and deldrift_refined_vertices, and what deldrift_segment_conflicts
/// and deldrift_passings tell. docs/FORMAT.md describes the bytes.
///
/// buffer: room for capacity bytes, with any alignment. count: receives the number of bytes. The count alone takes
/// constant time.
///
/// Takes a pass over what is saved.
///
/// Cost: n + m.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_save(const deldrift_triangulation *t,
                              void *buffer,
                              size_t capacity,
                              size_t *count);

/// Makes a triangulation of bytes that deldrift_save has written, to *out.
///
/// The triangulation is as the one that was saved, and gives the same cells after the same calls. Cells have the same
/// indices, except where it is periodic and changes had been taken; cells that are new after later calls may have
/// others. It has given no changes yet: the first deldrift_take_changes lists all cells as created. Like one whose
/// cells have been read, it keeps the arrays of deldrift_cells.
///
/// data: size bytes, with any alignment. options: as in deldrift_create, as they are not saved. NULL stands for the
/// defaults, whatever those of the triangulation that was saved.
///
/// Nothing is triangulated. It takes a sort of the vertices and a few passes over the data, and memory for at most 16
/// times as many bytes. This holds whatever the data are. What is not a Delaunay triangulation, exactly, is refused,
/// even if the checksum is right.
///
/// Data of a periodic triangulation give one. Its images count as vertices: all that is in the data is checked, and
/// that no image is missing. Where cells do not tell that at once, as after some commits, images are inserted into a
/// copy of the triangulation. That takes at most the time and the memory of creation, with data of any kind.
///
/// Cost: n log n + m, whatever the data are; of a periodic one that of creation at most.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_OPTIONS (also if the options reject coincidence and the data are of
/// a periodic one), DELDRIFT_INVALID_DATA, DELDRIFT_COINCIDENT (if vertices are hidden and the options reject it),
/// DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
deldrift_status deldrift_load(const void *data,
                              size_t size,
                              const deldrift_options *options,
                              deldrift_triangulation **out);

/// Saves the triangulation to a file, as deldrift_save does.
///
/// path: of a file that is made, or replaced. The bytes go to a new file in the same folder, which takes the place of
/// the old one when it is complete and stored. So after a failure or a crash there is one or the other. Only if the
/// process is killed the new file may be left behind. A file that is replaced keeps its mode. It keeps its owner, group
/// and POSIX access control list where the system allows that; where it does not, nobody is allowed more than before.
/// Other attributes are not kept. A symbolic link is replaced itself, and another hard link keeps what it has. A device
/// or a pipe is written at once; if it is full, the call waits. A named pipe that nobody reads is refused.
///
/// A pipe that is no longer read, and the limit on the size of files, are errors like any other. SIGPIPE and SIGXFSZ of
/// these writes do not reach the process, whose handlers stay as they are.
///
/// Cost: n + m.
///
/// Errors: DELDRIFT_IO_ERROR, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_save_file(const deldrift_triangulation *t,
                                   const char *path);

/// Makes a triangulation of a file that deldrift_save_file has written, to *out, as deldrift_load does.
///
/// Its header is read first, and the rest only if that is right and the file is as long as it says. Then it is read as
/// a whole, for which the call needs memory, too. Pipes, devices, sockets and directories are refused with
/// DELDRIFT_IO_ERROR.
///
/// Cost: that of deldrift_load.
///
/// Errors: DELDRIFT_INVALID_OPTIONS, DELDRIFT_IO_ERROR, DELDRIFT_INVALID_DATA, DELDRIFT_COINCIDENT,
/// DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
deldrift_status deldrift_load_file(const char *path,
                                   const deldrift_options *options,
                                   deldrift_triangulation **out);

/// Writes a file for ParaView and VTK: an unstructured grid of the cells, in VTK's XML format (.vtu).
///
/// Its points are the vertices that are present, hidden ones included, ascending by id; their ids are the point data
/// "vertex". In 2D the third coordinate is 0. Its cells are those of deldrift_cells, in that order. path: of a file
/// that is made, or replaced once the new one is complete, with what deldrift_save_file says of it.
///
/// If there are segments in force, those of deldrift_segments are lines behind these cells, in that order; an end that
/// is hidden is the vertex that represents it. Their markers are the cell data "marker", which is 0 for cells that are
/// no lines, and cell_fields are NaN for lines.
///
/// In a periodic triangulation the cells are where deldrift_cell_shifts has them. A vertex is a point for each period
/// in which a cell has it, ascending by id and by these shifts, all with its id and its numbers of fields. A vertex
/// that no cell has is a point at its position.
///
/// vertex_fields, cell_fields: numbers to be written along as point data and cell data, vertex_field_count and
/// cell_field_count of them.
///
/// Cost: n + m, and the numbers of the fields; m log m for a periodic triangulation.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_FIELD, DELDRIFT_IO_ERROR, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_write_vtu(const deldrift_triangulation *t,
                                   const char *path,
                                   const deldrift_field *vertex_fields,
                                   size_t vertex_field_count,
                                   const deldrift_field *cell_fields,
                                   size_t cell_field_count);

/// Writes a file for Mmg, FreeFem, Gmsh and others: MEDIT's text format (.mesh).
///
/// Its vertices are those that are present, hidden ones included, ascending by id and numbered from 1; the reference of
/// each is its id. Its triangles or tetrahedra are the cells, in the order of deldrift_cells. If there are segments in
/// force, those of deldrift_segments are its edges, in that order, behind the triangles. The reference of each is its
/// marker, and an end that is hidden is the vertex that represents it. Reading the numbers gives the same doubles. In a
/// periodic triangulation a vertex is there once for each period in which a cell has it, as in deldrift_write_vtu.
///
/// references: reference_count numbers, the reference of each cell in the order of deldrift_cells (reference_count must
/// be deldrift_cell_count), such as those of deldrift_label_cells; NULL with reference_count 0 for 1. path: of a file
/// that is made, or replaced once the new one is complete, with what deldrift_save_file says of it.
///
/// Cost: n + m; m log m for a periodic triangulation.
///
/// Errors: DELDRIFT_WRONG_COUNT, DELDRIFT_IO_ERROR, DELDRIFT_OUT_OF_MEMORY.
deldrift_status deldrift_write_medit(const deldrift_triangulation *t,
                                     const char *path,
                                     const int32_t *references,
                                     size_t reference_count);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif // DELDRIFT_FILES_H
