//! What a transfer asks of the cells of now, in the open and in boxes that repeat.

use super::boxes::Extent;
use super::{Gone, NamedFacet};
use crate::error::Result;
use crate::ids::CellId;
use crate::predicates::PlaceInSpace;

/// Multiples of vectors.
pub(crate) type Multiples = [i64; 3];

/// A cell, and by what it is translated from where its corners are told.
pub(crate) type CellAt = (CellId, Multiples);

/// The cells of now.
pub(crate) trait Now {
    /// The dimension.
    const D: usize;

    /// How many there are.
    fn len(&self) -> usize;

    /// The index that one had that was there.
    fn before(&self, cell: CellId) -> CellId;

    fn corners(&self, cell: CellId) -> [PlaceInSpace; 4];

    fn facets(&self, cell: CellId) -> [NamedFacet; 4];

    /// The cell across the facet opposite a corner, where the cell is as its corners are told.
    fn across(&self, cell: CellId, corner: usize) -> Option<CellAt>;

    /// By how much what has a shift is translated.
    fn offset(&self, shift: &Multiples) -> PlaceInSpace;

    /// A cell that has a place, of which it may be a corner.
    fn at(&self, place: &PlaceInSpace) -> Result<Option<CellAt>>;

    /// By how much more, at least, than corners of a cell with this box, and those of cells there, are off by rounding.
    fn rounding(&self, extent: &Extent) -> PlaceInSpace;

    /// Where each of these is that may meet some cells of now: its number, and by how much it is translated.
    fn copies(&self, gone: &[Gone], cells: impl Iterator<Item = CellId>) -> Result<Vec<(u32, PlaceInSpace)>>;

    /// The box of some cells.
    fn extent_of(&self, cells: impl Iterator<Item = CellId>) -> Extent {
        let mut all = Extent::of(&[]);
        cells.for_each(|cell| all.enter(&Extent::of(&self.corners(cell)[..=Self::D])));
        all
    }
}
