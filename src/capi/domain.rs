//! What segments divide the plane into: levels, labels, and boundaries in chains.

use super::handle::{Reading, deldrift_triangulation};
use super::listed::check_arrays;
use super::pointers::{Array, Buffer, Output, fill_all, given, write_all};
use super::status::{Failure, deldrift_status};
use crate::delaunay::Plane;
use crate::either::AnyTriangulation;
use crate::ids::{CellId, SegmentId};
use crate::motion::MovingTriangulation;

/// A triangulation of the plane.
pub(super) fn of_the_plane(t: &AnyTriangulation) -> Result<&MovingTriangulation<Plane>, Failure> {
    match t {
        AnyTriangulation::Plane(t) => Ok(t),
        AnyTriangulation::Space(_) => Err(Failure::NotOfThePlane),
    }
}

/// The segments at the edges of each cell, in the order of deldrift_cells: entry i of a row is the segment at the edge
/// opposite corner i. It is the lowest id if there are several, DELDRIFT_NONE if there is none. Ids are not places in
/// the lists of deldrift_segments once segments have been removed.
///
/// segments: a buffer with room for capacity rows of 3 ids. count: receives the number of cells.
///
/// Cost: m, and for each segment the cells around an end.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_segments_of_cells(
    t: *const deldrift_triangulation,
    segments: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    let segments = segments.cast::<[u32; 3]>();
    given!(t: Reading, segments[capacity]: Buffer, count: Output);
    t.read(|t| {
        let t = of_the_plane(t)?;
        segments.fill(count, t.cell_count(), || {
            Ok(t.segments_of_cells()?.into_iter().map(|row| row.map(SegmentId::get)))
        })
    })
}

/// The cells on both sides of each segment in force, in the order of deldrift_segments.
///
/// cells: a buffer with room for capacity rows of 2 cells: the one on the left of the segment, as seen from its first
/// end along it, and the one on its right. The outside is DELDRIFT_NONE, and so are both while there are no cells.
/// count: receives the number of segments.
///
/// Cost: for each segment the cells around an end.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_cells_of_segments(
    t: *const deldrift_triangulation,
    cells: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    let cells = cells.cast::<[u32; 2]>();
    given!(t: Reading, cells[capacity]: Buffer, count: Output);
    t.read(|t| {
        let t = of_the_plane(t)?;
        cells.fill(count, t.segments().count(), || {
            Ok(t.cells_of_segments()?.into_iter().map(|row| row.map(CellId::get)))
        })
    })
}

/// The nesting level of each cell, in the order of deldrift_cells: the least number of edges with segments on a path
/// from the cell to the outside.
///
/// Cells outside of all closed chains of segments have 0, those of a domain 1, those of its holes 2, those of islands
/// in these 3, and so on. The cells of the domain are those with an odd number. A segment with one region on both
/// sides, such as a slit or an open chain, divides nothing, and several at the same edge count once. No seed is needed,
/// and cells between the domain and the convex hull have 0. A domain that is divided in parts by further segments needs
/// deldrift_label_cells: parts that do not touch the outside would have a higher level.
///
/// deldrift_refine takes these levels by default. For them a segment is a wall, however often it has been drawn: a side
/// that two parts share, or an outline that is there twice, bounds what it would bound alone. deldrift_crossing_numbers
/// is for chains that are meant by the even-odd rule.
///
/// levels: a buffer with room for capacity numbers. count: receives the number of cells.
///
/// Exact. Cost: m, and for each segment the cells around an end.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_nesting_levels(
    t: *const deldrift_triangulation,
    levels: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, levels[capacity]: Buffer, count: Output);
    t.read(|t| {
        let t = of_the_plane(t)?;
        levels.fill(count, t.cell_count(), || Ok(t.nesting_levels()?))
    })
}

/// The crossing number of each cell, in the order of deldrift_cells: the least number of segments on a path from the
/// cell to the outside, where each segment at an edge counts. Cells with an odd number are those that the even-odd rule
/// fills.
///
/// If segments form closed chains, an even number of them ends at each vertex, and any two paths from a cell differ by
/// an even number of crossings. So the number is odd exactly if a ray from the cell crosses an odd number of segments.
/// A notch that is given as a second chain along a side is then no part of the domain, and neither is anything if an
/// outline is given twice. With deldrift_nesting_levels, which differs only where an edge has several segments, both
/// are. The direction in which segments were given does not matter. Pieces of deldrift_stage_splits and deldrift_refine
/// count each, as the segments do that they come from. At open chains, as slits and interfaces that divide a domain,
/// the least number decides.
///
/// numbers: a buffer with room for capacity numbers. count: receives the number of cells.
///
/// Exact. Cost: m, s log s for s segments, and for each segment the cells around an end.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_crossing_numbers(
    t: *const deldrift_triangulation,
    numbers: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, numbers[capacity]: Buffer, count: Output);
    t.read(|t| {
        let t = of_the_plane(t)?;
        numbers.fill(count, t.cell_count(), || Ok(t.crossing_numbers()?))
    })
}

/// A label for each cell, in the order of deldrift_cells: the label of the first seed in its region. A region is a set
/// of cells that can be reached from each other without crossing a segment.
///
/// seeds: seed_count rows of 2 coordinates. labels: as many numbers, any. A seed outside of the convex hull labels
/// nothing. other: the label of cells in whose region no seed is. label_of: a buffer with room for capacity numbers.
/// count: receives the number of cells.
///
/// Holes are regions, too: give their seeds a label of their own. Without segments there is one region. A seed on a
/// segment with one region on both sides is in that region. The outside of the convex hull is a region like the others,
/// together with the regions from which it is reached without crossing a segment. So a seed on the hull, at a segment
/// that bounds a region or at a corner of such segments, is on the boundary of two regions.
///
/// Exact. Cost: m, for each segment the cells around an end, and for each seed that of deldrift_locate.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_AMBIGUOUS_SEED for one that is exactly on the boundary of several regions, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_label_cells(
    t: *const deldrift_triangulation,
    seeds: *const f64,
    labels: *const i32,
    seed_count: usize,
    other: i32,
    label_of: *mut i32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    let seeds = seeds.cast::<[f64; 2]>();
    given!(t: Reading, seeds[seed_count]: Array, labels[seed_count]: Array, label_of[capacity]: Buffer, count: Output);
    t.read(|t| {
        let t = of_the_plane(t)?;
        let (seeds, labels) = (seeds.get()?, labels.get()?);
        label_of.fill(count, t.cell_count(), || Ok(t.label_cells(seeds, labels, other)?))
    })
}

/// Computes the labels of some cells again, in an array that deldrift_label_cells has filled, or that is filled with
/// nesting levels. Each listed cell gets the label of the cells, not listed, from which it is reached without crossing
/// a segment. Other entries are not touched.
///
/// cells: cell_count indices into deldrift_cells, in any order, some maybe more than once: the created ones of
/// deldrift_take_changes, and those that have been turned over. A cell that was turned over is not in the change list;
/// its row lists its corners in the opposite order. It needs a label too: where the end of a segment goes to the other
/// side of two vertices, the cell of the three is now beyond the segment, though no vertex has passed one. other: the
/// label of the cells outside of all closed chains of segments, along the hull. For nesting levels it is 0, for labels
/// what deldrift_label_cells was given as other, or the label of a seed there. Three kinds of cells get it: those that
/// are reached from the outside of the hull alone, those that are reached from listed cells alone, and those that are
/// reached from cells of different labels. label_of: an array of capacity numbers, of which those of cells that are not
/// listed are read. capacity: at least deldrift_cell_count. undecided: receives the number of cells of the last two
/// kinds. If it is not 0, a region has listed cells only, or touches two labels, and it is time for
/// deldrift_label_cells.
///
/// deldrift_update_circumcentres has the steps by which an array for all cells is brought up to date. While segments
/// stay, and vertices move without passing any, labels stay with their regions, as deldrift_label_cells would have them
/// for seeds that move with these. Where a commit adds segments, both parts of a region have its label. Where it
/// removes segments between regions of different labels, either label may go on: label anew then.
///
/// Exact. Cost: of k cells k log k, and k log s for s segments.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_FACET for an index that is no
/// cell's, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_update_labels(
    t: *const deldrift_triangulation,
    cells: *const u32,
    cell_count: usize,
    other: i32,
    label_of: *mut i32,
    capacity: usize,
    undecided: *mut usize,
) -> deldrift_status {
    given!(t: Reading, cells[cell_count]: Array, label_of[capacity]: Buffer, undecided: Output);
    t.read(|t| {
        let t = of_the_plane(t)?;
        let undecided = undecided.place()?;
        check_arrays([label_of.offer()], capacity, t.cell_count())?;
        let places = label_of.places(t.cell_count())?;
        // SAFETY: the header has the caller promise that entries of cells that are not listed are numbers, and no others
        // are asked for.
        let known = |cell: CellId| unsafe { places[cell.index()].assume_init() };
        let (labels, n) = t.labels_of(CellId::of_numbers(cells.get()?), known, other)?;
        for (cell, label) in labels {
            places[cell.index()].write(label);
        }
        undecided.write(n);
        Ok(())
    })
}

/// The boundary of some of the cells of the plane, in closed chains of edges, which have these cells on their left. An
/// outer boundary goes counter-clockwise, that of a hole clockwise. With the mask of the cells that have an odd nesting
/// level it is the boundary of a domain, and the markers of its segments tell what holds there.
///
/// mask: mask_count bytes, one for each cell in the order of deldrift_cells (mask_count must be deldrift_cell_count); a
/// cell is in the set if its byte is not 0. The others are buffers with room for capacity entries, one for each edge.
/// vertices: where the edge begins. It ends where the next edge of its chain begins, the last one where the first of
/// its chain does. chains: the chain that it is in: 0, 1, ..., ascending. segments: the segment at it, the lowest id if
/// there are several, DELDRIFT_NONE if there is none. cells: the cell of the set beside it. corners: which of its
/// corners (0, 1, 2) is opposite. count: receives the number of edges.
///
/// No chain crosses another, or itself: where parts of the set touch in a vertex, each part has a chain of its own.
/// Each chain begins with its least edge, by the id of the vertex where an edge begins and then of that where it ends.
/// Chains are in the order of these edges. So vertices, chains and segments depend only on the set.
///
/// Exact. Cost: m, e log e for e edges, and for each segment the cells around an end.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_WRONG_COUNT, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_boundary_chains(
    t: *const deldrift_triangulation,
    mask: *const u8,
    mask_count: usize,
    vertices: *mut u32,
    chains: *mut u32,
    segments: *mut u32,
    cells: *mut u32,
    corners: *mut u8,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(
        t: Reading, mask[mask_count]: Array, vertices[capacity]: Buffer, chains[capacity]: Buffer,
        segments[capacity]: Buffer, cells[capacity]: Buffer, corners[capacity]: Buffer, count: Output
    );
    t.read(|t| {
        let t = of_the_plane(t)?;
        t.check_mask(mask_count)?;
        let edges = t.boundary_chains(mask.get()?)?;
        let n = edges.len();
        let offers = [vertices.offer(), chains.offer(), segments.offer(), cells.offer(), corners.offer()];
        fill_all(count, n, capacity, offers, || {
            // Each of them is looked at before one is written.
            let (vertices, chains) = (vertices.places_if_any(n)?, chains.places_if_any(n)?);
            let (segments, cells) = (segments.places_if_any(n)?, cells.places_if_any(n)?);
            let corners = corners.places_if_any(n)?;
            write_all(vertices, edges.iter().map(|edge| edge.vertex.get()));
            write_all(chains, edges.iter().map(|edge| edge.chain));
            write_all(segments, edges.iter().map(|edge| edge.segment.get()));
            write_all(cells, edges.iter().map(|edge| edge.cell.get()));
            write_all(corners, edges.iter().map(|edge| edge.corner as u8));
            Ok(())
        })
    })
}
