//! Triangulations of vertices with weights: their creation, and what only they have.

use super::guard;
use super::handle::{Changing, Reading, deldrift_triangulation, hand_out, in_weighted};
use super::motion::deldrift_commit_report;
use super::options::{GivenOptions, deldrift_options};
use super::pointers::{Array, Buffer, Output, Point, Points, fill_all, given, write_all};
use super::status::{Failure, deldrift_status};
use crate::delaunay::Moving;
use crate::either::AnyWeighted;
use crate::error::Error;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::{MovingTriangulation, Options, PointPart};
use crate::predicates::PointArray;

/// Creates the regular triangulation of count points with weights in the plane or in space, at timestamp 0: the weighted
/// Delaunay triangulation, which is the dual of the power diagram.
///
/// The power distance of a place x from a vertex at p of weight w is |x - p|^2 - w. No vertex is at less power distance
/// from the power centre of a cell than its corners are. Where all weights are equal the cells are those of
/// deldrift_create. A vertex of little weight beside heavy ones may be a corner of no cell: it is hidden by weight, until
/// it or others change, see deldrift_hidden_by_weight. Ties are broken as without weights, by ids or keys. So the cells,
/// and who is hidden, depend on positions, weights and ids alone, and on nothing that happened before.
///
/// dimension: 2 or 3. positions: count points, as in deldrift_create. weights: count numbers, or NULL: then all are 0. Each
/// is finite and at most 1e114 in magnitude, and may be negative. For balls of radius r the weight is r^2. keys: count
/// keys, as in deldrift_create_with_keys, or NULL: then ids break ties. options: NULL for the defaults. out: receives the
/// triangulation.
///
/// Of vertices at one place that of the greatest weight represents the place; of these the one of the lowest key, or id. The
/// others are hidden by place, see deldrift_hidden_vertices, whether the one that represents it is hidden by weight or
/// not. Where vertices do not span the dimension there are no cells. Then it is the lower hull in the dimension that
/// they do span which says who is hidden by weight.
///
/// Calls that take positions take coordinates alone, as in any triangulation: a vertex that is moved keeps its weight,
/// and one that is inserted has weight 0 until it is given another one, unless it comes by
/// deldrift_insert_vertex_with_weight or deldrift_stage_insertions_with_weights. Circumcentres, and masks by
/// circumradius, are those of power spheres, of which the squared radius may be negative; Voronoi cells are power
/// cells, and that of a hidden vertex is empty. deldrift_nearest_vertex is the one of least power distance, and natural
/// neighbours are those of power cells. All else that is near is so by distance, hidden vertices included, and
/// deldrift_conflicts are those of a vertex of weight 0.
///
/// All functions serve a triangulation with weights but those of deldrift/segments.h and the following, which return
/// DELDRIFT_WEIGHTED: deldrift_research_annulus_widths, deldrift_research_standard_delimiter. The tolerance of a
/// vertex is of the root of the square of the way that it moves and of the magnitude by which its weight changes.
///
/// Cost: that of deldrift_create.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_INVALID_OPTIONS, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_COINCIDENT (if the options reject it), DELDRIFT_TOO_MANY_VERTICES,
/// DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_create_weighted(
    dimension: u32,
    positions: *const f64,
    weights: *const f64,
    keys: *const u64,
    count: usize,
    options: *const deldrift_options,
    out: *mut *mut deldrift_triangulation,
) -> deldrift_status {
    given!(positions[count]: Points, weights[count]: Array, keys[count]: Array, options: GivenOptions, out: Output);
    guard::enter(|| {
        let out = out.place()?;
        let (callbacks, options) = options.of_creation(dimension, count)?;
        let weights = weights.if_any()?;
        let keys = keys.if_any()?;
        let made = if dimension == 2 {
            AnyWeighted::Plane(build(positions, weights, keys, options)?)
        } else {
            AnyWeighted::Space(build(positions, weights, keys, options)?)
        };
        hand_out(out, memory::boxed(made)?, callbacks)
    })
}

/// Builds one of places and weights.
fn build<G: Moving>(
    positions: Points<'_>,
    weights: Option<&[f64]>,
    keys: Option<&[u64]>,
    options: Options,
) -> Result<MovingTriangulation<G>, Failure> {
    let points = positions.with_weights::<MovingTriangulation<G>>(weights)?;
    let mut t = MovingTriangulation::unbuilt(options);
    match keys {
        Some(keys) => t.build_first_with_keys(&points, keys)?,
        None => t.build_first(&points)?,
    }
    Ok(t)
}

/// Whether the triangulation has weights, to *weighted.
///
/// Cost: constant.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_is_weighted(
    t: *const deldrift_triangulation,
    weighted: *mut bool,
) -> deldrift_status {
    given!(t: Reading, weighted: Output);
    t.tell_any(weighted, |t| Ok(t.is_weighted()))
}

/// The weights of all ids, in their order: those of the current timestamp, or those that vertices whose insertion is staged
/// will have. The weight of a removed vertex is NaN.
///
/// weights: a buffer with room for capacity numbers. count: receives the number of ids.
///
/// Cost: n.
///
/// Errors: DELDRIFT_NOT_WEIGHTED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_weights(
    t: *const deldrift_triangulation,
    weights: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, weights[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        in_weighted!(t => {
            let n = t.id_count();
            let weight = |v: VertexId| t.position_or_goal(v).map_or(f64::NAN, |point| point.weight());
            weights.fill(count, n, || Ok(VertexId::range(0..n).map(weight)))
        })
    })
}

/// Stages other weights of count vertices for the next timestamp: all of them, or none if it fails. Positions stay, or are
/// those that are staged before or after this.
///
/// vertices: count ids, each at most once. NULL stands for 0, 1, ..., count - 1, as in deldrift_move_vertices. Vertices whose
/// insertion is staged may be among them, again and again: the last weight is the one that they are inserted with. weights:
/// count numbers, finite and at most 1e114 in magnitude. Both may be NULL if count is 0.
///
/// Cost: count.
///
/// Errors: DELDRIFT_NOT_WEIGHTED, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT, DELDRIFT_NO_SUCH_VERTEX,
/// DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX if its removal is staged, DELDRIFT_DUPLICATE_MOVE if a weight of the
/// vertex is staged already, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_stage_weights(
    t: *mut deldrift_triangulation,
    vertices: *const u32,
    weights: *const f64,
    count: usize,
) -> deldrift_status {
    given!(t: Changing, vertices[count]: Array, weights[count]: Array);
    t.change_any(|t| {
        let weights = weights.get()?;
        let vertices = vertices.if_any()?.map(VertexId::of_numbers);
        in_weighted!(t => Ok(t.move_parts(PointPart::Weight, vertices, weights)?))
    })
}

/// Moves all vertices, gives all other weights, or both, and makes that the next timestamp: deldrift_commit_positions for
/// vertices with weights.
///
/// positions: count points, one for each id; NULL: they stay. weights: count numbers, one for each id; NULL: they stay. count
/// must be deldrift_id_count, those of staged insertions included. report: receives what was done; may be NULL. Its
/// hidden_by_weight, newly_hidden and newly_shown tell who is hidden now before any cell is read.
///
/// Cost: as for deldrift_commit_positions.
///
/// Errors: DELDRIFT_NOT_WEIGHTED, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT if there are fewer or more,
/// DELDRIFT_DUPLICATE_MOVE if a move is staged, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_COINCIDENT (if the
/// options reject it), DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED. The triangulation then stays
/// at its timestamp, no move is staged, and insertions and removals are staged as before.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_commit_weighted(
    t: *mut deldrift_triangulation,
    positions: *const f64,
    weights: *const f64,
    count: usize,
    report: *mut deldrift_commit_report,
) -> deldrift_status {
    given!(t: Changing, positions[count]: Points, weights[count]: Array, report: Output);
    t.change_any(|t| {
        let report = report.if_any()?;
        let done = in_weighted!(t => {
            let wanted = t.id_count();
            if count != wanted {
                let coming = t.staged_edits().0;
                return Err(Error::WrongCount { argument: "count", given: count, wanted, coming }.into());
            }
            let weights = weights.if_any()?;
            t.commit_parts(positions.numbers_if_any(t)?, weights)?
        });
        if let Some(report) = report {
            report.write(done.into());
        }
        Ok(())
    })
}

/// Stages the insertion of count vertices with weights, as deldrift_stage_insertions does of vertices of weight 0: all
/// of them, or none if it fails. With keys as well it is deldrift_stage_insertions_with_keys, and then
/// deldrift_stage_weights.
///
/// weights: count numbers, in the order of positions, finite and at most 1e114 in magnitude; NULL: all are 0. The
/// others are as in deldrift_stage_insertions.
///
/// Cost: count, in the mean over many calls.
///
/// Errors: DELDRIFT_NOT_WEIGHTED, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_stage_insertions_with_weights(
    t: *mut deldrift_triangulation,
    positions: *const f64,
    weights: *const f64,
    count: usize,
    first_vertex: *mut u32,
) -> deldrift_status {
    given!(t: Changing, positions[count]: Points, weights[count]: Array, first_vertex: Output);
    t.change_any(|t| {
        let first_vertex = first_vertex.place()?;
        let first = in_weighted!(t => t.stage_insertions(&positions.with_weights_of(weights.if_any()?, t)?))?;
        first_vertex.write(first.get());
        Ok(())
    })
}

/// Inserts a vertex with a weight at once, as deldrift_insert_vertex does one of weight 0. deldrift_take_changes,
/// called before and after, tells whom it has hidden; it may be hidden itself.
///
/// out_vertex: receives its id, which is one above the highest ever given, or left by the latest deldrift_compact.
///
/// Cost: that of deldrift_insert_vertex.
///
/// Errors: DELDRIFT_NOT_WEIGHTED, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_COINCIDENT (if the options
/// reject it), DELDRIFT_STAGED_VERTEX (if t is periodic and insertions are staged, which have the next ids),
/// DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_insert_vertex_with_weight(
    t: *mut deldrift_triangulation,
    position: *const f64,
    weight: f64,
    out_vertex: *mut u32,
) -> deldrift_status {
    given!(t: Changing, position: Point, out_vertex: Output);
    t.change_any(|t| {
        let out_vertex = out_vertex.place()?;
        let inserted = in_weighted!(t => t.insert_vertex(&position.with_weight(weight, t)?))?;
        out_vertex.write(inserted.get());
        Ok(())
    })
}

/// Gives one vertex another weight at once, whatever is staged for others; it stays where it is.
///
/// Cost: as for deldrift_relocate_vertex.
///
/// Errors: DELDRIFT_NOT_WEIGHTED, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX,
/// DELDRIFT_DUPLICATE_MOVE, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY,
/// DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_set_weight(
    t: *mut deldrift_triangulation,
    vertex: u32,
    weight: f64,
) -> deldrift_status {
    given!(t: Changing);
    t.change_any(
        |t| in_weighted!(t => Ok(t.relocate_part(PointPart::Weight, VertexId::new(vertex), &[weight])?)),
    )
}

/// The vertices that are hidden by weight, ascending, each with the cell that it is above: at its place the power sphere of
/// this cell says that it is hidden. On the boundary of several cells it is one of them. Vertices that do not represent their
/// place are not among them.
///
/// vertices: a buffer with room for capacity ids. cells: one with room for as many indices into deldrift_cells,
/// DELDRIFT_NONE where there are no cells. Either may be NULL. count: receives the number of vertices.
///
/// Cost: the number of hidden vertices, and the corners of the cells below them. While there are no cells, that of
/// deldrift_create.
///
/// Errors: DELDRIFT_NOT_WEIGHTED, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_hidden_by_weight(
    t: *const deldrift_triangulation,
    vertices: *mut u32,
    cells: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, vertices[capacity]: Buffer, cells[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        let hidden = in_weighted!(t => t.hidden_by_weight()?);
        let needed = hidden.len();
        fill_all(count, needed, capacity, [vertices.offer(), cells.offer()], || {
            let (vertices, cells) = (vertices.places_if_any(needed)?, cells.places_if_any(needed)?);
            write_all(vertices, hidden.iter().map(|(vertex, _)| vertex.get()));
            write_all(cells, hidden.iter().map(|(_, cell)| cell.get()));
            Ok(())
        })
    })
}
