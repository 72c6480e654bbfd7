//! What a coarsening has looked at: the vertices that could not go, and what that depended on.
//!
//! Whether a vertex on no segment may go depends on the places of the corners of the cells around it, on their labels, and
//! on what is asked for. Where all of that is what it was, the vertex is not looked at again. Vertices of cells at
//! segments are: what is around them may depend on these.

use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;

/// Cells as they were looked at.
#[derive(Debug, Default)]
pub(in crate::motion) struct Looked {
    /// The bits of the numbers that were asked for.
    asked: Vec<u64>,
    /// By vertex.
    points: Vec<[f64; 2]>,
    corners: Vec<[VertexId; 3]>,
    mask: Vec<u8>,
    /// None if all are 0.
    labels: Vec<u32>,
    /// By vertex, whether it could not go.
    stays: Vec<bool>,
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
}

impl Finding {
    /// Whether it holds.
    pub(in crate::motion) fn holds(&self, question: Question) -> bool {
        self.n_changes == Some(question.n_changes)
            && !question.asked.is_empty()
            && self.asked == question.asked
            && self.mask == question.mask
            && self.labels == question.labels
    }

    /// Remembers that the answer to a question is known.
    pub(in crate::motion) fn set(&mut self, question: Question) -> Result<()> {
        // What is remembered in part is not to be taken for anything.
        self.n_changes = None;
        replace(&mut self.asked, question.asked)?;
        replace(&mut self.mask, question.mask)?;
        replace(&mut self.labels, question.labels)?;
        self.n_changes = Some(question.n_changes);
        Ok(())
    }

    fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.asked) + memory::bytes_of(&self.mask) + memory::bytes_of(&self.labels)
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
    /// The bits of the numbers that are asked for.
    pub(in crate::motion) asked: &'a [u64],
    pub(in crate::motion) points: &'a [[f64; 2]],
    pub(in crate::motion) corners: &'a [[VertexId; 3]],
    pub(in crate::motion) mask: &'a [u8],
    pub(in crate::motion) labels: &'a [u32],
}

impl Looked {
    /// By vertex, whether it could not go and nothing that this depended on has changed; empty if other numbers are asked
    /// for.
    pub(in crate::motion) fn known(&self, now: Looking) -> Result<Vec<bool>> {
        let mut known = Vec::new();
        if self.asked != now.asked || self.labels.is_empty() != now.labels.is_empty() {
            return Ok(known);
        }
        let n = now.points.len();
        memory::reserve_exact(&mut known, n)?;
        known.extend_from_slice(&self.stays[..n.min(self.stays.len())]);
        known.resize(n, false);
        let mut has_moved = Vec::new();
        memory::reserve_exact(&mut has_moved, n)?;
        has_moved.extend(self.points.iter().zip(now.points).map(|(before, p)| before != p));
        // The vertices behind have come since; they may be corners of cells that only seem to be the same.
        has_moved.resize(n, true);
        for (c, row) in now.corners.iter().enumerate() {
            let is_same = self.corners.get(c) == Some(row)
                && self.mask[c] == now.mask[c]
                && self.labels.get(c) == now.labels.get(c)
                && !row.iter().any(|&v| has_moved[v]);
            if !is_same {
                row.iter().for_each(|&v| known[v] = false);
            }
        }
        Ok(known)
    }

    /// Remembers what has been looked at: the vertices of which `stays` says so could not go.
    pub(in crate::motion) fn remember(&mut self, now: Looking, stays: Vec<bool>) -> Result<()> {
        // What is remembered in part is not to be taken for anything.
        self.asked.clear();
        replace(&mut self.points, now.points)?;
        replace(&mut self.corners, now.corners)?;
        replace(&mut self.mask, now.mask)?;
        replace(&mut self.labels, now.labels)?;
        self.stays = stays;
        replace(&mut self.asked, now.asked)
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.asked)
            + memory::bytes_of(&self.points)
            + memory::bytes_of(&self.corners)
            + memory::bytes_of(&self.mask)
            + memory::bytes_of(&self.labels)
            + memory::bytes_of(&self.stays)
    }
}

fn replace<T: Copy>(array: &mut Vec<T>, entries: &[T]) -> Result<()> {
    array.clear();
    memory::append(array, entries)
}
