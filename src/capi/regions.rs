//! Labels of regions that follow: the sides of segments keep them.

use super::domain::of_the_plane;
use super::handle::{Changing, Reading, deldrift_triangulation};
use super::pointers::{Array, Buffer, Output, given};
use super::status::{Failure, deldrift_status};
use crate::either::AnyTriangulation;
use crate::error::Error;
use crate::ids::SegmentId;
use crate::motion::NO_LABEL;

/// No label.
pub const DELDRIFT_NO_LABEL: i32 = -2147483647 - 1;

const _: () = assert!(DELDRIFT_NO_LABEL == NO_LABEL);

/// Gives regions labels that follow them. A domain is described once, and deldrift_regions tells the label of each cell
/// from then on. A region is a set of cells that can be reached from each other without crossing a segment.
///
/// labels: a number for each cell, in the order of deldrift_cells, one for each region: those of deldrift_label_cells,
/// deldrift_nesting_levels or deldrift_crossing_numbers, or others. label_count: deldrift_cell_count. NULL and 0 take
/// all labels away.
///
/// Both sides of each segment in force get the label of the cell there, DELDRIFT_NO_LABEL beyond the hull. They keep it
/// while segments move with their ends, and hand it on to the pieces that deldrift_refine, deldrift_coarsen and
/// deldrift_stage_splits make. Clones have it, and so has what is saved and loaded. So labels follow through all calls,
/// as long as no vertex passes a segment (see deldrift_check_passings). A segment that is added later has no labels.
/// The regions on both sides keep theirs if they have other segments, or are given some by deldrift_set_segment_sides.
/// Ends no views.
///
/// Cost: m, and for each segment the cells around an end.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT, DELDRIFT_INVALID_VALUE for a
/// cell with another label than one of its region beside it, DELDRIFT_PREPARED, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_set_regions(
    t: *mut deldrift_triangulation,
    labels: *const i32,
    label_count: usize,
) -> deldrift_status {
    given!(t: Changing, labels[label_count]: Array);
    t.change(|t| {
        let AnyTriangulation::Plane(t) = t else { return Err(Failure::NotOfThePlane) };
        if labels.is_null() && label_count == 0 {
            return Ok(t.forget_regions()?);
        }
        let wanted = t.cell_count();
        if label_count != wanted {
            let (argument, given) = ("label_count", label_count);
            return Err(Error::WrongCount { argument, given, wanted, coming: 0 }.into());
        }
        Ok(t.set_regions(labels.get()?)?)
    })
}

/// Gives labels to the sides of segments; deldrift_set_regions does so for all of them, by labels of cells. It is for a
/// domain that is described by what is on the left and on the right of each segment, and for segments that are added to
/// one.
///
/// segments: count ids, in force or staged. If one is listed twice the last row counts. sides: a row of 2 labels for
/// each: on the left, as seen from its first end along it, and on the right. DELDRIFT_NO_LABEL is none. Ends no views.
///
/// Cost: count.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_SEGMENT, DELDRIFT_PREPARED; then
/// none is changed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_set_segment_sides(
    t: *mut deldrift_triangulation,
    segments: *const u32,
    sides: *const i32,
    count: usize,
) -> deldrift_status {
    let sides = sides.cast::<[i32; 2]>();
    given!(t: Changing, segments[count]: Array, sides[count]: Array);
    t.change(|t| {
        let AnyTriangulation::Plane(t) = t else { return Err(Failure::NotOfThePlane) };
        Ok(t.set_sides(SegmentId::of_numbers(segments.get()?), sides.get()?)?)
    })
}

/// The label of the region of each cell, in the order of deldrift_cells. It is the label of the sides of the region's
/// outer boundary, which deldrift_set_regions and deldrift_set_segment_sides have given. Where these have none, it is
/// that of the sides around islands in it. So a region keeps its label when an island jumps into it, or out of it.
///
/// other: the label of cells from which the outside of the hull is reached without crossing a segment, and of undecided
/// ones. labels: a buffer with room for capacity numbers. count: receives the number of cells. undecided: receives the
/// number of cells in other regions whose sides have several labels, or none; may be NULL. If it is not 0, segments
/// have been added or removed, or vertices have passed segments, and it is time for deldrift_set_regions.
///
/// Exact. Cost: m, and for each segment the cells around an end.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_regions(
    t: *const deldrift_triangulation,
    other: i32,
    labels: *mut i32,
    capacity: usize,
    count: *mut usize,
    undecided: *mut usize,
) -> deldrift_status {
    given!(t: Reading, labels[capacity]: Buffer, count: Output, undecided: Output);
    t.read(|t| {
        let t = of_the_plane(t)?;
        let undecided = undecided.if_any()?;
        let mut n_undecided = 0;
        labels.fill(count, t.cell_count(), || {
            let (labels, n) = t.region_labels(other)?;
            n_undecided = n;
            Ok(labels)
        })?;
        if let Some(undecided) = undecided {
            undecided.write(n_undecided);
        }
        Ok(())
    })
}
