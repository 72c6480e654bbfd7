//! Half-spaces that cut Voronoi cells besides a box.
//!
//! Lengths are in the unit of the box, and places are offsets from its corner of least coordinates. Distances are
//! rounded by some last bits of the size of the box, which is as good as if the planes were elsewhere by as much.
//!
//! # Which places are beyond
//!
//! There may be hundreds of half-spaces, and most places are far from the planes of all. So the box is divided in blocks,
//! each with a list of the half-spaces that it is not certainly inside of: from all those of the whole box, halves take
//! theirs from the list of the whole. A place is compared with those of its block. What is certain has a margin for
//! rounding, so that blocks never change an answer.

use std::ops::Range;

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::machine::memory;
use crate::motion::reading::geometry::clipping::{Clip, Vector, dot, greatest};

/// More than a distance from a plane is rounded by, in the unit of the box.
const MARGIN: f64 = 1e-13;

/// How many cells of a triangulation there are for each block, at least.
const CELLS_PER_BLOCK: usize = 16;

/// Bounds of how many blocks there are, and of how many half-spaces all of them list.
const MOST_BLOCKS: usize = 1 << 15;
const MOST_ENTRIES: usize = 1 << 24;

/// The places x with normal · x at most the offset. The normal has length 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct HalfSpace {
    pub(super) normal: Vector,
    offset: f64,
}

/// A box along the axes, by its corners.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoxBounds {
    low: Vector,
    high: Vector,
}

impl BoxBounds {
    /// Of no places yet.
    pub(super) const NONE: Self = BoxBounds { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    /// Makes room for a place.
    #[inline(always)]
    pub(super) fn include(&mut self, p: &Vector) {
        for ((low, high), &x) in self.low.iter_mut().zip(&mut self.high).zip(p) {
            (*low, *high) = (low.min(x), high.max(x));
        }
    }
}

impl HalfSpace {
    /// From a normal of any length, in the coordinates of a box.
    fn new(normal: &Vector, offset: f64, clip: &Clip) -> Self {
        let most = greatest(normal);
        let normal = normal.map(|x| x / most);
        let length = dot(&normal, &normal).sqrt();
        let from_low = (offset / most - dot(&normal, clip.low())) / length;
        HalfSpace { normal: normal.map(|x| x / length), offset: from_low * clip.unit }
    }

    /// How far beyond the plane a place is; negative inside.
    #[inline(always)]
    pub(super) fn beyond(&self, p: &Vector) -> f64 {
        dot(&self.normal, p) - self.offset
    }

    /// How far beyond the plane places of a box are, at least and at most.
    #[inline(always)]
    pub(super) fn range(&self, bounds: &BoxBounds) -> [f64; 2] {
        let mut range = [-self.offset; 2];
        for axis in 0..3 {
            let (a, b) = (self.normal[axis] * bounds.low[axis], self.normal[axis] * bounds.high[axis]);
            range[0] += a.min(b);
            range[1] += a.max(b);
        }
        range
    }
}

/// Some half-spaces, with blocks of a box.
#[derive(Debug, Default)]
pub(super) struct HalfSpaces {
    pub(super) list: Vec<HalfSpace>,
    /// The number of blocks along each axis, and blocks in a unit of length.
    n_blocks: [usize; 3],
    per_length: Vector,
    /// The half-spaces of each block are those of a range of entries.
    blocks: Vec<[u32; 2]>,
    entries: Vec<u32>,
}

impl HalfSpaces {
    /// From rows of a normal and an offset, which are [checked](checked_row), in the coordinates of a box, which gets about as many blocks as fit a
    /// triangulation of `n_cells` cells.
    pub(super) fn new<G: Moving>(rows: &[f64], clip: &Clip, n_cells: usize) -> Result<Self> {
        let mut spaces = HalfSpaces::default();
        memory::reserve_exact(&mut spaces.list, rows.len() / (G::D + 1))?;
        for row in rows.chunks(G::D + 1) {
            let normal = [row[0], row[1], if G::D == 3 { row[2] } else { 0.0 }];
            spaces.list.push(HalfSpace::new(&normal, row[G::D], clip));
        }
        if !spaces.list.is_empty() {
            spaces.divide::<G>(clip, n_cells)?;
        }
        Ok(spaces)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Divides the box in blocks, and lists the half-spaces of each.
    fn divide<G: Moving>(&mut self, clip: &Clip, n_cells: usize) -> Result<()> {
        let extents = [0, 1, 2].map(|axis| clip.extent(axis) * clip.unit);
        let mut length = extents;
        self.n_blocks = [1; 3];
        let most = (n_cells / CELLS_PER_BLOCK).min(MOST_BLOCKS).min(MOST_ENTRIES / self.list.len());
        for _ in 0..most.max(1).ilog2() {
            let longest =
                (1..G::D).fold(0, |best, axis| if length[axis] > length[best] { axis } else { best });
            length[longest] *= 0.5;
            self.n_blocks[longest] *= 2;
        }
        self.per_length =
            [0, 1, 2].map(|axis| if axis < G::D { self.n_blocks[axis] as f64 / extents[axis] } else { 0.0 });
        memory::lengthen(&mut self.blocks, self.n_blocks.iter().product(), [0; 2])?;
        let mut candidates = Vec::new();
        memory::collect(&mut candidates, 0..self.list.len() as u32)?;
        self.fill(self.n_blocks.map(|n| 0..n), &length, &mut candidates, 0)
    }

    /// Lists the half-spaces of some blocks, which are among the candidates from `first` on. A block has this length.
    fn fill(
        &mut self,
        blocks: [Range<usize>; 3],
        length: &Vector,
        candidates: &mut Vec<u32>,
        first: usize,
    ) -> Result<()> {
        let corner =
            |end: fn(&Range<usize>) -> usize| [0, 1, 2].map(|axis| end(&blocks[axis]) as f64 * length[axis]);
        let bounds = BoxBounds { low: corner(|range| range.start), high: corner(|range| range.end) };
        let last = candidates.len();
        for at in first..last {
            let [least, most] = self.list[candidates[at] as usize].range(&bounds);
            if least > MARGIN {
                // The whole block is beyond this one.
                let candidate = candidates[at];
                candidates.truncate(last);
                memory::push(candidates, candidate)?;
                break;
            }
            if most > -MARGIN {
                memory::push(candidates, candidates[at])?;
            }
        }
        let widest =
            (1..3).fold(0, |best, axis| if blocks[axis].len() > blocks[best].len() { axis } else { best });
        let Range { start, end } = blocks[widest];
        if candidates.len() > last && end - start > 1 {
            let middle = start + (end - start) / 2;
            for half in [start..middle, middle..end] {
                let mut halves = blocks.clone();
                halves[widest] = half;
                self.fill(halves, length, candidates, last)?;
            }
        } else if candidates.len() > last {
            let from = self.entries.len() as u32;
            memory::append(&mut self.entries, &candidates[last..])?;
            let block = self.index(&[0, 1, 2].map(|axis| blocks[axis].start));
            self.blocks[block] = [from, self.entries.len() as u32];
        }
        candidates.truncate(last);
        Ok(())
    }

    fn index(&self, block: &[usize; 3]) -> usize {
        (block[2] * self.n_blocks[1] + block[1]) * self.n_blocks[0] + block[0]
    }

    /// Whether a place in the box is beyond some half-space.
    #[inline(always)]
    pub(super) fn are_left_by(&self, p: &Vector) -> bool {
        let along = |axis: usize| ((p[axis] * self.per_length[axis]) as usize).min(self.n_blocks[axis] - 1);
        let [from, to] = self.blocks[self.index(&[along(0), along(1), along(2)])];
        self.entries[from as usize..to as usize].iter().any(|&k| self.list[k as usize].beyond(p) > 0.0)
    }

    /// Whether all places of a box are certainly beyond one of them.
    pub(super) fn certainly_miss(&self, bounds: &BoxBounds) -> bool {
        self.list.iter().any(|space| space.range(bounds)[0] > MARGIN)
    }
}

/// Whether a row is a normal that is not zero and an offset, all finite.
pub(super) fn checked_row<G: Moving>(index: usize, row: &[f64]) -> Result<()> {
    let argument = "half_spaces";
    if let Some(axis) = row.iter().position(|x| !x.is_finite()) {
        return Err(Error::NotFinite { argument, index, axis, value: row[axis] });
    }
    if row[..G::D].iter().all(|&x| x == 0.0) {
        return Err(Error::InvalidValue { argument, index, value: 0.0, wanted: "a normal that is not zero" });
    }
    Ok(())
}
