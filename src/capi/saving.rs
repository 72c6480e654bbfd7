//! A triangulation as bytes, in memory or in a file, and a second one like it.

use std::ffi::{c_char, c_void};
use std::mem::MaybeUninit;

use super::files::{NewFile, OldFile};
use super::geometry::cell_count_of;
use super::guard;
use super::handle::{Content, Reading, deldrift_triangulation, hand_out, in_any};
use super::options::{GivenOptions, deldrift_options};
use super::periodic::reject_coincidence;
use super::pointers::{Array, Buffer, Output, Text, given, write_all};
use super::status::{Failure, deldrift_status};
use crate::damage::LoadError;
use crate::either::{AnyTriangulation, AnyWeighted};
use crate::machine::memory;
use crate::motion::{Field, Saved};
use crate::periodic::{AnyPeriodic, SavedPeriodic};

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
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_clone(
    t: *const deldrift_triangulation,
    out: *mut *mut deldrift_triangulation,
) -> deldrift_status {
    given!(t: Reading, out: Output);
    t.read_with_callbacks(|t, callbacks| {
        let out = out.place()?;
        let monitor = callbacks.monitor()?;
        match t {
            Content::Open(t) => hand_out(out, t.try_clone(monitor)?, callbacks),
            Content::Weighted(t) => hand_out(out, memory::boxed(t.try_clone(monitor)?)?, callbacks),
            Content::Periodic(t) => hand_out(out, memory::boxed(t.try_clone(monitor)?)?, callbacks),
        }
    })
}

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
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_save(
    t: *const deldrift_triangulation,
    buffer: *mut c_void,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    let buffer = buffer.cast();
    given!(t: Reading, buffer[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        t.reject_prepared()?;
        in_any!(t => {
            buffer.fill_by(count, t.saved_size(), |places| {
                let mut rest = places;
                t.save(|bytes| {
                    rest = fill_front(std::mem::take(&mut rest), bytes);
                    Ok(())
                })
            })
        })
    })
}

/// Writes bytes to the beginning of a buffer, which has room for them; returns the rest of it.
fn fill_front<'b>(buffer: &'b mut [MaybeUninit<u8>], bytes: &[u8]) -> &'b mut [MaybeUninit<u8>] {
    let (front, rest) = buffer.split_at_mut(bytes.len());
    write_all(front, bytes.iter().copied());
    rest
}

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
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_load(
    data: *const c_void,
    size: usize,
    options: *const deldrift_options,
    out: *mut *mut deldrift_triangulation,
) -> deldrift_status {
    let data = data.cast();
    given!(data[size]: Array, options: GivenOptions, out: Output);
    guard::enter(|| {
        let out = out.place()?;
        load("data", data.get()?, options.read()?, out)
    })
}

/// Makes a triangulation of the bytes of an argument.
fn load(
    argument: &'static str,
    data: &[u8],
    options: deldrift_options,
    out: &mut MaybeUninit<*mut deldrift_triangulation>,
) -> Result<(), Failure> {
    let load = if SavedPeriodic::is_of(data, data.len() as u64) { load_periodic } else { load_open };
    load(argument, data, options, out)
}

/// Makes a periodic triangulation. No other call has room for one on the stack, as this is never a part of its caller.
#[inline(never)]
fn load_periodic(
    argument: &'static str,
    data: &[u8],
    options: deldrift_options,
    out: &mut MaybeUninit<*mut deldrift_triangulation>,
) -> Result<(), Failure> {
    let (callbacks, options) = (options.callbacks(), options.convert()?);
    let saved = SavedPeriodic::of(data).map_err(|damage| Failure::Data { argument, damage })?;
    reject_coincidence(&options)?;
    match AnyPeriodic::load(&saved, options) {
        Ok(made) => hand_out(out, made, callbacks),
        Err(error) => Err(of_load(argument, error)),
    }
}

/// Makes an open triangulation, by itself for the same reason.
#[inline(never)]
fn load_open(
    argument: &'static str,
    data: &[u8],
    options: deldrift_options,
    out: &mut MaybeUninit<*mut deldrift_triangulation>,
) -> Result<(), Failure> {
    let (callbacks, options) = (options.callbacks(), options.convert()?);
    let saved = Saved::of(data).map_err(|damage| Failure::Data { argument, damage })?;
    let of_load = |error| of_load(argument, error);
    if saved.is_weighted() {
        let made = AnyWeighted::load(&saved, options).map_err(of_load)?;
        return hand_out(out, memory::boxed(made)?, callbacks);
    }
    hand_out(out, AnyTriangulation::load(&saved, options).map_err(of_load)?, callbacks)
}

/// Why the bytes of an argument make no triangulation.
fn of_load(argument: &'static str, error: LoadError) -> Failure {
    match error {
        LoadError::Call(error) => Failure::Call(error),
        LoadError::Data(damage) => Failure::Data { argument, damage },
    }
}

/// The bytes of a file that begins like that of a triangulation, and is as long as it says there; not if either is
/// wrong, so that no more is read than there is room for by its header.
fn bytes_of(file: &OldFile<'_>) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    file.read(&mut bytes, Saved::HEADER)?;
    let size = if SavedPeriodic::is_of(&bytes, file.size()) {
        // It is as long as it says there.
        Ok(usize::try_from(file.size()).unwrap_or(usize::MAX))
    } else {
        Saved::size_by(&bytes, file.size())
    };
    let size = size.map_err(|damage| Failure::Data { argument: "path", damage })?;
    // One more, which there is only if somebody writes to it.
    memory::reserve_exact(&mut bytes, size - Saved::HEADER + 1)?;
    file.read(&mut bytes, size - Saved::HEADER)?;
    file.read(&mut bytes, 1)?;
    Ok(bytes)
}

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
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_save_file(
    t: *const deldrift_triangulation,
    path: *const c_char,
) -> deldrift_status {
    given!(t: Reading, path: Text);
    t.read_any(|t| {
        t.reject_prepared()?;
        let mut file = NewFile::create(path.get()?)?;
        in_any!(t => t.save(|bytes| file.put(bytes)))?;
        Ok(file.finish()?)
    })
}

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
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_load_file(
    path: *const c_char,
    options: *const deldrift_options,
    out: *mut *mut deldrift_triangulation,
) -> deldrift_status {
    given!(path: Text, options: GivenOptions, out: Output);
    guard::enter(|| {
        let out = out.place()?;
        let options = options.read()?;
        let data = bytes_of(&OldFile::open(path.get()?)?)?;
        load("path", &data, options, out)
    })
}

/// Numbers for each vertex, or for each cell, that deldrift_write_vtu writes along.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct deldrift_field {
    /// Its name: UTF-8, with a NUL at the end, without control characters, U+FFFE and U+FFFF, which XML does not have.
    /// Fields of vertices have different names, none of them "vertex". Fields of cells have different names, none of
    /// them "marker" if there are segments.
    pub name: *const c_char,
    /// components numbers for each vertex, by id (those of removed vertices are not written), or for each cell, by
    /// index.
    pub values: *const f64,
    /// How many numbers each has, at least 1.
    pub components: usize,
}

/// Fields from C, each for `n` vertices or cells.
///
/// # Safety
/// Names are NULL or end in a NUL, and values are as many as the components of a field say, for each of `n`.
unsafe fn fields_of<'a>(
    argument: &'static str,
    fields: Array<'a, deldrift_field>,
    n: usize,
    has_lines: bool,
) -> Result<Vec<Field<'a>>, Failure> {
    let mut read = Vec::new();
    let fields = fields.get()?;
    memory::reserve_exact(&mut read, fields.len())?;
    for (index, field) in fields.iter().enumerate() {
        let bad = |part, wanted| Failure::Field { argument, index, part, wanted };
        if field.name.is_null() {
            return Err(bad("name", "not NULL"));
        }
        let n_values = n.saturating_mul(field.components);
        // SAFETY: the caller's promise.
        let (name, values) =
            unsafe { (Text::new("name", field.name), Array::new(argument, field.values, n_values)) };
        let name = name.get()?.to_str().map_err(|_| bad("name", "UTF-8"))?;
        if field.components == 0 {
            return Err(bad("components", "at least 1"));
        }
        let values = values.get().map_err(|failure| match failure {
            Failure::Pointer { argument, wrong } => Failure::ValuesOfField { argument, index, wrong },
            other => other,
        })?;
        read.push(Field { name, components: field.components, values });
    }
    Field::check_names(argument, &read, has_lines)?;
    Ok(read)
}

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
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_write_vtu(
    t: *const deldrift_triangulation,
    path: *const c_char,
    vertex_fields: *const deldrift_field,
    vertex_field_count: usize,
    cell_fields: *const deldrift_field,
    cell_field_count: usize,
) -> deldrift_status {
    given!(t: Reading, path: Text);
    given!(vertex_fields[vertex_field_count]: Array, cell_fields[cell_field_count]: Array);
    t.read_any(|t| {
        let n_cells = cell_count_of(t)?;
        in_any!(t => {
            let path = path.get()?;
            let has_lines = t.has_lines();
            // SAFETY: the header's conditions on fields.
            let (vertices, cells) = unsafe {
                (
                    fields_of("vertex_fields", vertex_fields, t.id_count(), has_lines)?,
                    fields_of("cell_fields", cell_fields, n_cells, has_lines)?,
                )
            };
            let mut file = NewFile::create(path)?;
            t.write_vtu(&vertices, &cells, |bytes| file.put(bytes))?;
            Ok(file.finish()?)
        })
    })
}

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
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_write_medit(
    t: *const deldrift_triangulation,
    path: *const c_char,
    references: *const i32,
    reference_count: usize,
) -> deldrift_status {
    let is_given = !references.is_null() || reference_count != 0;
    given!(t: Reading, path: Text, references[reference_count]: Array);
    t.read_any(|t| {
        let path = path.get()?;
        in_any!(t => {
            let references = if is_given {
                t.check_references(reference_count)?;
                Some(references.get()?)
            } else {
                None
            };
            let mut file = NewFile::create(path)?;
            t.write_medit(references, |bytes| file.put(bytes))?;
            Ok(file.finish()?)
        })
    })
}
