//! Conservative transfer: means in cells, from the cells that were to those that are.
//!
//! A mean rides with its cell while vertices move. A cell that lives keeps it. At the new positions, those that are
//! gone, with removed vertices where they last were, and those that have come cover the same region, but for what the
//! hull has lost or gained: so each of these gets the mean, over itself, of what was there. Only cells of the change
//! list meet.
//!
//! A cell that was turned over since is both gone, as it was, and come; and if one that is gone is turned over at the
//! new positions, so are all cells that live and that it meets. The volume that it has in common with others counts as
//! negative: then at each place the cells that were add up to one, counted with their signs, and the sum over all is
//! exact.
//!
//! # Invariants
//! - The sum of mean times volume over the cells of now is that over the cells that were, with signed volumes at the
//!   new positions, less what is told as lost, and with what is told as gained, but for the rounding of sums.
//! - What is lost and gained is 0 where the regions are the same, but for rounding (see `overlap`).
//! - A constant stays, to the last bit: means are differences from one of those that a cell meets.
//! - But where a cell that is turned over is met, no mean is beyond those of the cells that it comes from, and of the
//!   second order of the neighbours of these, and of theirs.
//! - Linear functions are reproduced but for rounding, of the second order, where gradients are known (`beside`) and
//!   no part that cells have in common has a mean beyond that range, as one may at the hull.
//!
//! # Order 2
//! A mean m of a cell becomes m + a g · (x - c), with the gradient g fitted to neighbours and c the centroid, which
//! does not change its content. The share a is the greatest of 0 to 1 for which no mean that comes of it can leave the
//! range above, by what all that meet there add and take away (Zalesak's limiter). It limits what is made of a
//! gradient, not the gradient at the corners of its cell (Barth and Jespersen), which would flatten linear functions,
//! too.
//!
//! # Cost
//! For n cells in the change list n log n and the pairs that meet, times the number of components. For those that are
//! turned over also a search for a corner each, and the cells of now that they would meet if they were half as large
//! again; or a look at all cells, where no corner of one is in the hull, or an eighth of all is reached (`near`).
//!
//! # Sources
//! P. E. Farrell and J. R. Maddison, "Conservative interpolation between volume meshes by local Galerkin projection",
//! 2011 (doi:10.1016/j.cma.2010.07.015); F. Alauzet, "A parallel matrix-free conservative solution interpolation on
//! unstructured tetrahedral meshes", 2016 (doi:10.1016/j.cma.2015.10.012); S. T. Zalesak, "Fully multidimensional
//! flux-corrected transport algorithms for fluids", 1979 (doi:10.1016/0021-9991(79)90051-2); T. J. Barth and D. C.
//! Jespersen, "The design and application of upwind schemes on unstructured meshes", 1989 (doi:10.2514/6.1989-366).

mod beside;
mod boxes;
mod change;
mod means;
mod near;
mod now;
mod open;
mod overlap;

use crate::error::{Error, Result};
use crate::ids::CellId;
use crate::machine::memory;
use crate::motion::reading::progress::Progress;
use crate::predicates::PlaceInSpace;
use boxes::Boxes;
pub(crate) use boxes::Extent;
#[cfg(test)]
pub(crate) use change::tests::finds_as_by_a_look_at_all;
pub(crate) use change::transfer;
pub(crate) use now::{CellAt, Multiples, Now};
use overlap::{Facets, Overlap, centroid, error_of_volume, extent, minus, plus, volume};

/// How much of a function means are transferred with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransferOrder {
    /// As if the function were constant in each cell.
    First,
    /// With a limited gradient in each cell.
    Second,
}

/// What a transfer of means in cells has met.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TransferReport {
    /// Cells that are gone, those that count as such included.
    pub gone: usize,
    /// Cells that have come, those that count as such included.
    pub arrived: usize,
    /// Pairs of these that have something in common.
    pub overlaps: usize,
    /// Cells that were, and are turned over at the new positions: what they have is counted as negative.
    pub turned_over: usize,
    /// Cells that have come where nothing was: their means are those of a neighbour.
    pub uncovered: usize,
    /// The volume of the cells that are gone that no cell has come to, with its sign.
    pub lost_volume: f64,
    /// The volume of the cells that have come that none of those that are gone was in, with its sign.
    pub gained_volume: f64,
    /// By how much at most the volumes lost and gained are off, where nothing underflows: what is no more than that
    /// may be 0.
    pub volume_error: f64,
    /// By component, the content of what was lost: mean times volume.
    pub lost: Vec<f64>,
    /// By component, the content of what was gained.
    pub gained: Vec<f64>,
}

/// What becomes of means.
#[derive(Clone, Debug)]
pub(crate) struct Transferred {
    /// Cells that have other means than before.
    pub(crate) cells: Vec<CellId>,
    /// The components of each of these.
    pub(crate) means: Vec<f64>,
    pub(crate) report: TransferReport,
}

/// A facet of a cell.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NamedFacet {
    /// By which the cells on both sides know it.
    pub(crate) name: u128,
    /// Which corner of the cell is the one of the facet by which both know where it is.
    pub(crate) anchor: u8,
}

/// A cell that is gone, at the new positions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gone {
    pub(crate) corners: [PlaceInSpace; 4],
    pub(crate) facets: [NamedFacet; 4],
    /// Its index when it was there.
    pub(crate) before: u32,
}

/// A cell that has come.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arrived {
    pub(crate) index: CellId,
    pub(crate) corners: [PlaceInSpace; 4],
    pub(crate) facets: [NamedFacet; 4],
    pub(crate) beyond: [BeyondFacet; 4],
}

/// What is beyond a facet of a cell that has come.
#[derive(Clone, Copy, Debug)]
pub(crate) enum BeyondFacet {
    Nothing,
    /// Another one of them, by its number.
    Arrived(u32),
    /// A cell that lives: its index before, and its centroid as seen from here.
    Living {
        before: u32,
        centre: PlaceInSpace,
    },
}

/// Two cells that have something in common.
#[derive(Clone, Copy, Debug)]
struct Pair {
    arrived: u32,
    gone: u32,
    /// Of the volume of the one that has come, below 0 where the one that is gone is turned over.
    share: f64,
    /// The share times the way from the centroid of the one that is gone to the centroid of what is in common.
    moment: PlaceInSpace,
}

/// The cells of a change, and what they have in common.
struct Overlay<'a> {
    gone: &'a [Gone],
    arrived: &'a [Arrived],
    /// With their signs.
    volumes_gone: Vec<f64>,
    volumes_arrived: Vec<f64>,
    /// In the order of those that have come.
    pairs: Vec<Pair>,
    /// By how much the volumes of all may be off together.
    volume_error: f64,
}

/// Cells that are gone, to be met.
struct GoneCells<'a> {
    gone: &'a [Gone],
    /// Where each of them is: its number, by how much it is translated, and its facets there.
    copies: Vec<(u32, PlaceInSpace, Facets)>,
    boxes: Boxes,
}

impl<'a> GoneCells<'a> {
    /// The meeting of some cells with their translations.
    fn of<const D: usize>(gone: &'a [Gone], places: Vec<(u32, PlaceInSpace)>) -> Result<Self> {
        let (mut copies, mut extents) = (Vec::new(), Vec::new());
        memory::reserve_exact(&mut copies, places.len())?;
        memory::reserve_exact(&mut extents, places.len())?;
        for (k, offset) in places {
            let corners = gone[k as usize].corners.map(|corner| plus(&corner, &offset));
            copies.push((k, offset, Facets::of::<D>(&corners)));
            extents.push(Extent::of(&corners[..=D]));
        }
        Ok(GoneCells { gone, copies, boxes: Boxes::new(extents)? })
    }

    /// Tells what a cell has in common with those that are gone, and with which, and how that is translated, and by
    /// how much the volume of that may be off.
    fn for_each<const D: usize>(
        &self,
        corners: &[PlaceInSpace; 4],
        tell: &mut impl FnMut(u32, &PlaceInSpace, Overlap, f64) -> Result<()>,
    ) -> Result<()> {
        let its_extent = extent(&corners[..=D]);
        self.boxes.meeting(&Extent::of(&corners[..=D]), &mut |copy| {
            let (k, offset, facets) = &self.copies[copy as usize];
            let found = facets.overlap::<D>(corners, its_extent);
            let sign = facets.determinant.signum();
            let signed = Overlap { share: sign * found.share, moment: found.moment.map(|x| sign * x) };
            tell(*k, offset, signed, facets.error::<D>(its_extent))
        })
    }

    /// Whether a cell meets any of them.
    fn meets<const D: usize>(&self, corners: &[PlaceInSpace; 4]) -> Result<bool> {
        let mut is_met = false;
        self.for_each::<D>(corners, &mut |_, _, found, _| {
            is_met |= found.share != 0.0;
            Ok(())
        })?;
        Ok(is_met)
    }

    fn overlay<const D: usize>(self, arrived: &'a [Arrived], progress: &mut Progress) -> Result<Overlay<'a>> {
        let gone = self.gone;
        let (mut volumes_gone, mut volumes_arrived, mut pairs) = (Vec::new(), Vec::new(), Vec::new());
        memory::collect(&mut volumes_gone, gone.iter().map(|cell| volume::<D>(&cell.corners)))?;
        memory::collect(&mut volumes_arrived, arrived.iter().map(|cell| volume::<D>(&cell.corners)))?;
        let of_volume = |corners: &[PlaceInSpace; 4]| error_of_volume::<D>(extent(&corners[..=D]));
        let all = gone.iter().map(|cell| &cell.corners).chain(arrived.iter().map(|cell| &cell.corners));
        let mut volume_error: f64 = all.map(of_volume).sum();
        progress.expect_more(arrived.len());
        for (i, cell) in (0..).zip(arrived) {
            self.for_each::<D>(&cell.corners, &mut |k, offset, Overlap { share, moment }, error| {
                progress.advance(1)?;
                volume_error += error;
                if share == 0.0 {
                    return Ok(());
                }
                let there = &gone[k as usize].corners;
                let centre = plus(&plus(&there[0], offset), &centroid::<D>(there));
                let seen = minus(&centre, &cell.corners[0]);
                let moment = minus(&moment, &seen.map(|x| share * x));
                memory::push(&mut pairs, Pair { arrived: i, gone: k, share, moment })
            })?;
        }
        Ok(Overlay { gone, arrived, volumes_gone, volumes_arrived, pairs, volume_error })
    }
}

/// Transfers the means in an array, of the cells that were, which has those of the cells of now then; `counts` is how many
/// there are of both.
pub(crate) fn in_place(
    values: &mut Vec<f64>,
    n_values: usize,
    [before, now]: [usize; 2],
    transferred: impl FnOnce(&dyn Fn(u32, usize) -> f64) -> Result<Transferred>,
) -> Result<TransferReport> {
    if Some(values.len()) != before.checked_mul(n_values) {
        let (given, wanted) = (values.len(), before.saturating_mul(n_values));
        return Err(Error::WrongCount { argument: "values", given, wanted, coming: 0 });
    }
    let made = transferred(&|before, c| values[before as usize * n_values + c])?;
    memory::lengthen(values, before.max(now) * n_values, 0.0)?;
    made.tell(n_values, |entry, mean| values[entry] = mean);
    values.truncate(now * n_values);
    Ok(made.report)
}

impl Transferred {
    /// Tells which entry of an array of means becomes what.
    pub(crate) fn tell(&self, n_values: usize, mut tell: impl FnMut(usize, f64)) {
        for (cell, row) in self.cells.iter().zip(self.means.chunks_exact(n_values.max(1))) {
            (0..n_values).for_each(|c| tell(cell.index() * n_values + c, row[c]));
        }
    }
}
