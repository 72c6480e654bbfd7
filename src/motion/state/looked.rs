//! What refinement and coarsening have looked at, and what they have found: which cells are bad, and which vertices
//! could not go.
//!
//! Whether a cell has a small angle or is too large depends on the places of its corners, on its label, and on what is
//! asked for. Whether a vertex on no segment may go depends on that of the cells around it. Where all of that is what
//! it was, neither is looked at again. Cells at segments are, and so are vertices of these: they depend on what is a
//! segment.

use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;

/// If not so large a share of the vertices are where they were, cells are not compared: nearly all would be others.
const LEAST_SHARE: f64 = 0.1;

/// Where vertices are.
#[derive(Debug)]
pub(in crate::motion) struct ScaledPlaces {
    /// By vertex, its place, multiplied by the scale.
    pub(in crate::motion) points: Vec<[f64; 2]>,
    /// A power of two: more than 1 where all coordinates are so small that the squares of lengths might underflow.
    pub(in crate::motion) scale: f64,
    /// The box of all places, as multiplied.
    pub(in crate::motion) lower: [f64; 2],
    pub(in crate::motion) upper: [f64; 2],
}

impl Default for ScaledPlaces {
    fn default() -> Self {
        ScaledPlaces {
            points: Vec::new(),
            scale: 1.0,
            lower: [f64::INFINITY; 2],
            upper: [f64::NEG_INFINITY; 2],
        }
    }
}

/// Cells as they were looked at.
#[derive(Debug, Default)]
pub(in crate::motion) struct Looked {
    /// The bits of the numbers that were asked for; none if nothing is known.
    asked: Vec<u64>,
    /// The sizes that were asked for.
    sizes: Vec<f64>,
    places: ScaledPlaces,
    /// The number of changes of the mesh for which those are the places of now.
    placed_at: Option<u64>,
    corners: Vec<[VertexId; 3]>,
    mask: Vec<u8>,
    /// None if all are 0.
    labels: Vec<u32>,
    /// By cell, whether it is selected, and has a small angle or is too large.
    is_flawed: Vec<bool>,
    /// The number of the domain of which that is the mask, and that of changes of the mesh up to which it is, but for
    /// cells that have become others.
    domain: Option<(u32, u64)>,
    /// By vertex, whether it could not go.
    stays: Vec<bool>,
    /// The bits of the numbers that coarsening was asked for then.
    coarsened_for: Vec<u64>,
}

/// What has been found by looks at all cells, until one of them changes.
#[derive(Debug, Default)]
pub(in crate::motion) struct Found {
    /// No selected cell is bad, or has an encroached edge.
    pub(in crate::motion) all_good: Finding,
    /// No vertex can go.
    pub(in crate::motion) all_stay: Finding,
}

/// Something that was found to hold.
#[derive(Debug, Default)]
pub(in crate::motion) struct Finding {
    /// The number of changes of the mesh until then; none if nothing was found.
    n_changes: Option<u64>,
    /// The bits of the numbers that were asked for.
    asked: Vec<u64>,
    mask: Vec<u8>,
    /// None if all are 0.
    labels: Vec<u32>,
    sizes: Vec<f64>,
}

/// What a call asks for.
#[derive(Clone, Copy, Debug)]
pub(in crate::motion) struct Question<'a> {
    /// The number of changes of the mesh so far.
    pub(in crate::motion) n_changes: u64,
    /// The bits of the numbers that are asked for; none if it is more than numbers.
    pub(in crate::motion) asked: &'a [u64],
    pub(in crate::motion) mask: &'a [u8],
    pub(in crate::motion) labels: &'a [u32],
    pub(in crate::motion) sizes: &'a [f64],
}

impl Finding {
    /// Whether it holds.
    pub(in crate::motion) fn holds(&self, question: Question) -> bool {
        self.n_changes == Some(question.n_changes)
            && !question.asked.is_empty()
            && self.asked == question.asked
            && self.mask == question.mask
            && self.labels == question.labels
            && are_equal(&self.sizes, question.sizes)
    }

    /// Remembers that the answer to a question is known.
    pub(in crate::motion) fn set(&mut self, question: Question) -> Result<()> {
        // What is remembered in part is not to be taken for anything.
        self.n_changes = None;
        replace(&mut self.asked, question.asked)?;
        replace(&mut self.mask, question.mask)?;
        replace(&mut self.labels, question.labels)?;
        replace(&mut self.sizes, question.sizes)?;
        self.n_changes = Some(question.n_changes);
        Ok(())
    }

    fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.asked)
            + memory::bytes_of(&self.mask)
            + memory::bytes_of(&self.labels)
            + memory::bytes_of(&self.sizes)
    }
}

impl Found {
    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        self.all_good.memory_bytes() + self.all_stay.memory_bytes()
    }
}

/// Cells that are looked at.
#[derive(Clone, Copy, Debug)]
pub(in crate::motion) struct Looking<'a> {
    pub(in crate::motion) question: Question<'a>,
    pub(in crate::motion) points: &'a [[f64; 2]],
    pub(in crate::motion) corners: &'a [[VertexId; 3]],
}

/// Which vertices are others than when cells were looked at.
#[derive(Debug)]
pub(in crate::motion) enum Others {
    /// All, or it is not known.
    All,
    /// By vertex, whether it is one of the others.
    Some(Vec<bool>),
}

impl Looked {
    /// The places of vertices, if they are those of so many changes of the mesh, and of so many ids.
    pub(in crate::motion) fn take_places(&mut self, n_changes: u64, n_ids: usize) -> Option<ScaledPlaces> {
        let is_known = self.placed_at.take() == Some(n_changes) && self.places.points.len() == n_ids;
        is_known.then(|| std::mem::take(&mut self.places))
    }

    /// A look at the cells of now begins, which [`look_at`](Self::look_at) goes on with for each. `has_moved`: whether
    /// vertices may be at other places than at the last look. What is remembered is not to be taken for anything until
    /// it has [ended](Self::end).
    pub(in crate::motion) fn begin(&mut self, now: Looking, has_moved: bool) -> Result<Others> {
        let Question { asked, labels, sizes, .. } = now.question;
        self.domain = None;
        let is_known = !asked.is_empty()
            && self.asked == asked
            && self.labels.is_empty() == labels.is_empty()
            && self.sizes.is_empty() == sizes.is_empty();
        self.asked.clear();
        let n = now.points.len();
        let mut others = Others::All;
        if is_known {
            let mut are_other = Vec::new();
            memory::lengthen(&mut are_other, n, false)?;
            // The vertices behind have come since; they may be corners of cells that only seem to be the same.
            let n_before = self.stays.len().min(n);
            are_other[n_before..].fill(true);
            if has_moved {
                let points = self.places.points.iter().zip(now.points);
                are_other.iter_mut().zip(points).for_each(|(is_other, (before, p))| *is_other |= before != p);
            }
            let both = self.sizes.iter().zip(sizes);
            are_other.iter_mut().zip(both).for_each(|(is_other, (before, size))| *is_other |= before != size);
            let n_same = are_other.iter().filter(|&&is_other| !is_other).count();
            if n_same as f64 >= LEAST_SHARE * n as f64 {
                others = Others::Some(are_other);
            }
        }
        if matches!(others, Others::All) {
            self.stays.clear();
        }
        self.stays.truncate(n);
        memory::lengthen(&mut self.stays, n, false)?;
        let n_cells = now.corners.len();
        self.corners.truncate(n_cells);
        memory::lengthen(&mut self.corners, n_cells, [VertexId::NONE; 3])?;
        self.mask.truncate(n_cells);
        memory::lengthen(&mut self.mask, n_cells, 0)?;
        self.is_flawed.truncate(n_cells);
        memory::lengthen(&mut self.is_flawed, n_cells, false)?;
        self.labels.truncate(labels.len());
        memory::lengthen(&mut self.labels, labels.len(), 0)?;
        if !are_equal(&self.sizes, sizes) {
            replace(&mut self.sizes, sizes)?;
        }
        Ok(others)
    }

    /// Whether a cell is flawed; `test` tells, if it or what that depends on is another one than at the last look.
    #[inline(always)]
    pub(in crate::motion) fn look_at(
        &mut self,
        now: &Looking,
        others: &Others,
        cell: usize,
        test: impl FnOnce() -> bool,
    ) -> bool {
        let row = now.corners[cell];
        let is_same = match others {
            Others::All => false,
            Others::Some(are_other) => {
                self.corners[cell] == row
                    && self.mask[cell] == now.question.mask[cell]
                    && self.labels.get(cell) == now.question.labels.get(cell)
                    && !(are_other[row[0]] | are_other[row[1]] | are_other[row[2]])
            }
        };
        if !is_same {
            self.corners[cell] = row;
            self.mask[cell] = now.question.mask[cell];
            if let Some(label) = self.labels.get_mut(cell) {
                *label = now.question.labels[cell];
            }
            if let Others::Some(_) = others {
                row.iter().for_each(|&v| self.stays[v] = false);
            }
            self.is_flawed[cell] = test();
        }
        self.is_flawed[cell]
    }

    /// By vertex, whether it could not go by these numbers, as far as it has been looked at as it is now.
    pub(in crate::motion) fn stays_for(&mut self, numbers: &[u64]) -> Result<&mut [bool]> {
        if self.coarsened_for != numbers {
            self.stays.fill(false);
            replace(&mut self.coarsened_for, numbers)?;
        }
        Ok(&mut self.stays)
    }

    /// All cells have been looked at, with vertices at these places, which are those of so many changes of the mesh if
    /// that is known. It may be taken for what is asked for.
    pub(in crate::motion) fn end(&mut self, asked: Vec<u64>, places: ScaledPlaces, placed_at: Option<u64>) {
        (self.asked, self.places, self.placed_at) = (asked, places, placed_at);
    }

    /// The mask of the call that ends is that of a domain, and was so for the cells that it looked at, if it did. That
    /// holds up to so many changes of the mesh: those since were made by the call, which keeps regions as they are.
    pub(in crate::motion) fn set_domain(&mut self, domain: u32, mask: &[u8], n_changes: u64) {
        // A call that knew what would be found has not looked, and another one may have, with another mask.
        let has_looked = !self.asked.is_empty() && self.mask == mask;
        self.domain = has_looked.then_some((domain, n_changes));
    }

    /// The cells and the mask that were looked at last, if that is the mask of this domain but for cells that have
    /// become others.
    pub(in crate::motion) fn of_domain(
        &self,
        domain: u32,
        n_changes: u64,
    ) -> Option<(&[[VertexId; 3]], &[u8])> {
        (self.domain == Some((domain, n_changes))).then_some((&self.corners, &self.mask))
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.asked)
            + memory::bytes_of(&self.sizes)
            + memory::bytes_of(&self.places.points)
            + memory::bytes_of(&self.corners)
            + memory::bytes_of(&self.mask)
            + memory::bytes_of(&self.labels)
            + memory::bytes_of(&self.is_flawed)
            + memory::bytes_of(&self.stays)
            + memory::bytes_of(&self.coarsened_for)
    }
}

/// Whether sizes are the same to the bit; what is no number may stand for vertices that have been removed.
fn are_equal(one: &[f64], other: &[f64]) -> bool {
    one.len() == other.len() && one.iter().zip(other).all(|(a, b)| a.to_bits() == b.to_bits())
}

fn replace<T: Copy>(array: &mut Vec<T>, entries: &[T]) -> Result<()> {
    array.clear();
    memory::append(array, entries)
}
