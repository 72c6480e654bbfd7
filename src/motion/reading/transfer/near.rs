//! Which cells of now may meet those that are turned over, without a look at all.
//!
//! Cells are found from neighbour to neighbour, from a cell that has a corner of one that is turned over, across all
//! that are not certainly apart from each of these: whose boxes do not meet, where that of the one that is turned over
//! is widened by half of its extent on each side, or all of whose corners are beyond one of its facets by a fourth of
//! the height above it.
//!
//! # None is missed
//! Let V be the determinant of a cell T that is turned over, δ how far heights above its facets are off with a cell c
//! of now, and n the dimension, as in `overlap`. Heights mean anything only where V is at least 16 δ; only then a share
//! is not 0, or a cell apart by its heights. Let K be what has heights above -V/8: T enlarged about its centroid by
//! 1 + (n + 1)/8, which is inside of the widened box.
//!
//! - If the share of c is not 0, some part of c has no height below -δ, at least -V/16, and c meets K.
//! - A cell that meets K is not apart: its box meets the widened one, and its corners are not all below -V/8, so by
//!   what is computed not all below -V/4.
//! - The cells that meet K are connected through facets. Two of them have inner points in K, as it is open and no cell
//!   is flat. The way from one to the other is in K and in the hull, as both are convex, and if the points are chosen
//!   so that it meets nothing of less dimension than facets, it goes from cell to cell through these. The cell with
//!   the corner is one of them.
//!
//! Sides of boxes are compared as they are, and those that are widened are rounded outwards. Heights of what is shorter
//! than [`LEAST_EXTENT`] may underflow; then there is a look at all cells.
//!
//! In a set that repeats, cells are told from corners that may be rounded, and so are those that are turned over: boxes
//! are wider by more than that, and heights are compared only where they cannot change by V/16 for that.

use super::Gone;
use super::boxes::{Boxes, Extent};
use super::now::{CellAt, Now};
use super::overlap::{Facets, extent, plus};
use crate::delaunay::Mix;
use crate::error::Result;
use crate::ids::CellId;
use crate::machine::memory;
use crate::motion::reading::progress::Progress;
use crate::predicates::PlaceInSpace;
use std::collections::HashMap;
use std::hash::BuildHasherDefault;

/// A look at one cell costs about as much here as one at so many of all in order.
const SHARE: usize = 8;

/// So many cells are looked at here, however few there are.
const FEW: usize = 1000;

/// Shorter cells are not looked for near by.
const LEAST_EXTENT: f64 = 1e-280;

/// Cells that have been reached, in the order of that.
#[derive(Default)]
struct Reached {
    list: Vec<CellAt>,
    seen: HashMap<CellAt, (), BuildHasherDefault<Mix>>,
}

impl Reached {
    fn enter(&mut self, placed: CellAt) -> Result<()> {
        memory::reserve_map(&mut self.seen, 1)?;
        if self.seen.insert(placed, ()).is_none() {
            memory::push(&mut self.list, placed)?;
        }
        Ok(())
    }
}

/// The cells of now that may meet some that are turned over, ascending; none where it is not known where to begin, or
/// where more are reached than it takes to make a look at all cheaper.
pub(super) fn near<const D: usize, T: Now>(
    now: &T,
    turned_over: &[Gone],
    progress: &mut Progress,
) -> Result<Option<Vec<CellId>>> {
    let (mut extents, mut shapes, mut reached) = (Vec::new(), Vec::new(), Reached::default());
    memory::reserve_exact(&mut extents, turned_over.len())?;
    memory::reserve_exact(&mut shapes, turned_over.len())?;
    for cell in turned_over {
        let corners = &cell.corners[..=D];
        if extent(corners) < LEAST_EXTENT {
            return Ok(None);
        }
        let rounding = now.rounding(&Extent::of(corners));
        extents.push(widened(corners, &rounding));
        shapes.push((Facets::of::<D>(&cell.corners), rounding.into_iter().fold(0.0, f64::max)));
        let Some(start) = corners.iter().find_map(|corner| now.at(corner).transpose()) else {
            return Ok(None);
        };
        reached.enter(start?)?;
    }
    let boxes = Boxes::new(extents)?;
    let (mut next, mut cells) = (0, Vec::new());
    while let Some(&(cell, shift)) = reached.list.get(next) {
        next += 1;
        if next > (now.len() / SHARE).max(FEW) {
            return Ok(None);
        }
        progress.advance(1)?;
        let offset = now.offset(&shift);
        let corners = now.corners(cell).map(|corner| plus(&corner, &offset));
        let its_extent = extent(&corners[..=D]);
        let is_near = boxes.has_one(&Extent::of(&corners[..=D]), &|k| {
            let (facets, rounding) = &shapes[k as usize];
            !facets.is_beyond::<D>(&corners, its_extent, *rounding)
        });
        if !is_near {
            continue;
        }
        memory::push(&mut cells, cell)?;
        for k in 0..=D {
            if let Some((other, way)) = now.across(cell, k) {
                reached.enter((other, [0, 1, 2].map(|j| shift[j] + way[j])))?;
            }
        }
    }
    cells.sort_unstable();
    cells.dedup();
    Ok(Some(cells))
}

/// The box of a cell, with half of its extent more on each side, and so much for rounding.
fn widened(corners: &[PlaceInSpace], rounding: &PlaceInSpace) -> Extent {
    let mut all = Extent::of(corners);
    for (j, rounding) in rounding.iter().enumerate() {
        let more = extent(corners) / 2.0 + rounding;
        all.low[j] = (all.low[j] - more).next_down();
        all.high[j] = (all.high[j] + more).next_up();
    }
    all
}
