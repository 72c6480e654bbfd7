//! A box, cut by half-spaces: a polyhedron whose surface is always closed.
//!
//! Whether a corner is cut off is decided once, for all faces that have it; an edge of which one end is cut off has one
//! new corner, for both of its faces. Each of these has a new edge where the cut passes; the other way around these
//! make up the new faces. So every edge is passed once in each direction, whatever rounding says, and the volume of
//! what the faces enclose depends continuously on the corners.

use super::clipping::{Clip, Vector, cross, dot, in_space, minus};
use crate::delaunay::Dimension;
use crate::error::Result;
use crate::machine::memory;

/// Index of a corner.
type Corner = u32;

/// An edge that a face passes from its first to its second end, and the corner where it has been cut.
type CutEdge = ([Corner; 2], Corner);

/// Corners, and the faces as closed lists of them, counter-clockwise seen from outside.
#[derive(Debug, Default)]
pub(super) struct Polyhedron {
    corners: Vec<Vector>,
    /// The corners of the faces, one face after the other.
    lists: Vec<Corner>,
    /// Where each list ends.
    ends: Vec<usize>,
    /// Height of each corner that is left above the plane of the latest cut.
    heights: Vec<f64>,
    cut_edges: Vec<CutEdge>,
    /// New edges of the faces that remain: from where the cut enters one to where it leaves it.
    new_edges: Vec<[Corner; 2]>,
    next_lists: Vec<Corner>,
    next_ends: Vec<usize>,
}

/// The faces of a box whose corners are numbered by a bit for each axis.
const FACES: [[Corner; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

impl Polyhedron {
    /// Makes it a box; in the plane, one of height 1 upon that.
    pub(super) fn start<G: Dimension>(&mut self, clip: &Clip<G>) -> Result<()> {
        let (low, mut high) = (in_space::<G>(&clip.low), in_space::<G>(&clip.high));
        if G::D == 2 {
            high[2] = 1.0;
        }
        self.corners.clear();
        self.lists.clear();
        self.ends.clear();
        let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { low[axis] } else { high[axis] });
        memory::collect(&mut self.corners, (0..8).map(corner))?;
        memory::append(&mut self.lists, FACES.as_flattened())?;
        memory::collect(&mut self.ends, (1..=FACES.len()).map(|k| 4 * k))
    }

    /// Cuts off what is beyond the plane through a point, on the side to which the normal points.
    pub(super) fn keep_behind(&mut self, normal: &Vector, through: &Vector) -> Result<()> {
        memory::lengthen(&mut self.heights, self.corners.len(), 0.0)?;
        for &corner in &self.lists {
            self.heights[corner as usize] = dot(normal, &minus(&self.corners[corner as usize], through));
        }
        if !self.lists.iter().any(|&corner| self.is_beyond(corner)) {
            return Ok(());
        }
        self.cut_edges.clear();
        self.new_edges.clear();
        self.next_lists.clear();
        self.next_ends.clear();
        let mut start = 0;
        for face in 0..self.ends.len() {
            let end = self.ends[face];
            self.cut_face(start..end)?;
            start = end;
        }
        self.close()?;
        std::mem::swap(&mut self.lists, &mut self.next_lists);
        std::mem::swap(&mut self.ends, &mut self.next_ends);
        Ok(())
    }

    fn is_beyond(&self, corner: Corner) -> bool {
        self.heights[corner as usize] > 0.0
    }

    /// Lists what is left of a face.
    fn cut_face(&mut self, list: std::ops::Range<usize>) -> Result<()> {
        let first = self.next_lists.len();
        let (mut left_at, mut entered_first) = (None, None);
        let mut before = self.lists[list.end - 1];
        for at in list {
            let corner = self.lists[at];
            if self.is_beyond(before) != self.is_beyond(corner) {
                let new = self.corner_on([before, corner])?;
                memory::push(&mut self.next_lists, new)?;
                if self.is_beyond(corner) {
                    left_at = Some(new);
                } else if let Some(left) = left_at.take() {
                    memory::push(&mut self.new_edges, [new, left])?;
                } else {
                    entered_first = Some(new);
                }
            }
            if !self.is_beyond(corner) {
                memory::push(&mut self.next_lists, corner)?;
            }
            before = corner;
        }
        if let Some((entered, left)) = entered_first.zip(left_at) {
            memory::push(&mut self.new_edges, [entered, left])?;
        }
        if self.next_lists.len() > first {
            memory::push(&mut self.next_ends, self.next_lists.len())?;
        }
        Ok(())
    }

    /// The corner where an edge has been cut.
    fn corner_on(&mut self, [from, to]: [Corner; 2]) -> Result<Corner> {
        // The other face has passed it the other way around.
        let is_same = |(edge, _): &&CutEdge| *edge == [to, from];
        if let Some(&(_, new)) = self.cut_edges.iter().find(is_same) {
            return Ok(new);
        }
        let (p, q) = (self.corners[from as usize], self.corners[to as usize]);
        let (a, b) = (self.heights[from as usize], self.heights[to as usize]);
        let share = a / (a - b);
        let new = self.corners.len() as Corner;
        memory::push(&mut self.corners, [0, 1, 2].map(|axis| p[axis] + share * (q[axis] - p[axis])))?;
        memory::push(&mut self.cut_edges, ([from, to], new))?;
        Ok(new)
    }

    /// Lists the faces made up by the new edges.
    fn close(&mut self) -> Result<()> {
        while let Some([first, mut end]) = self.new_edges.pop() {
            let start = self.next_lists.len();
            memory::push(&mut self.next_lists, first)?;
            while end != first {
                memory::push(&mut self.next_lists, end)?;
                let follows = |edge: &[Corner; 2]| edge[0] == end;
                let next = self.new_edges.iter().position(follows).expect("new edges make closed lists");
                end = self.new_edges.swap_remove(next)[1];
            }
            // An edge there and back encloses nothing.
            if self.next_lists.len() - start == 2 {
                self.next_lists.truncate(start);
            } else {
                memory::push(&mut self.next_ends, self.next_lists.len())?;
            }
        }
        Ok(())
    }

    /// Its volume.
    pub(super) fn volume(&self) -> f64 {
        let Some(&apex) = self.lists.first() else { return 0.0 };
        let apex = self.corners[apex as usize];
        let (mut sum, mut start) = (0.0, 0);
        for &end in &self.ends {
            let list = &self.lists[start..end];
            let from_apex = |corner: Corner| minus(&self.corners[corner as usize], &apex);
            let first = from_apex(list[0]);
            for pair in list[1..].windows(2) {
                sum += dot(&first, &cross(&from_apex(pair[0]), &from_apex(pair[1])));
            }
            start = end;
        }
        sum / 6.0
    }
}
