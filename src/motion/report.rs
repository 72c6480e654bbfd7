//! What a commit reports, and a refinement.

use crate::ids::{SegmentId, VertexId};

/// What one commit did; summed over all commits and immediate calls in
/// [`statistics`](super::MovingTriangulation::statistics).
///
/// The report counts how often a vertex joins the queue again. None ever does here, as relocations are made
/// at the moving positions, so there is no counter for it.
///
/// ```
/// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
///
/// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
/// let mut t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
/// t.move_vertices(&[VertexId::new(3)], &[[1.01, 1.0]])?;
/// let report = t.commit_timestamp()?;
/// assert_eq!((report.moved, report.unchanged, report.rebuilds), (1, 1, 0));
/// # Ok::<(), deldrift::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CommitReport {
    /// Number of the timestamp reached: 0 at creation, one more at each commit.
    pub timestamp: u64,
    /// Vertices whose position differs from that of the timestamp before.
    pub moved: u64,
    /// Moved vertices for which only coordinates changed.
    pub unchanged: u64,
    /// Vertices removed and inserted again.
    pub placements: u64,
    /// Flips made.
    pub flips: u64,
    /// 1 if the triangulation was rebuilt (a sum in the statistics).
    pub rebuilds: u64,
    /// Vertices that were certainly within their tolerance.
    pub within_tolerance: u64,
    /// Vertices that were certainly within their safe region, where the algorithm tests that.
    pub within_safe_region: u64,
    /// Delimiters computed: bi-cells whose tolerance was computed.
    pub tolerances: u64,
    /// Certificates evaluated: orientations and in-sphere tests of stars whose vertex was relocated.
    pub certificates: u64,
    /// Signs, of whatever purpose, that floating-point filters left to exact arithmetic. Ties are among them, but those
    /// on a lattice, in builds, need none.
    pub exact_calls: u64,
    /// Hidden vertices at the end: those that are at the place of a vertex with a lower id.
    pub coincident: u64,
    /// Vertices inserted.
    pub inserted: u64,
    /// Vertices removed.
    pub removed: u64,
    /// Vertices whose weight differs from that of the timestamp before.
    pub reweighted: u64,
    /// Vertices hidden by weight at the end: those that are above the cells and represent their place.
    pub hidden_by_weight: u64,
    /// Vertices with weights that are hidden at the end, by weight or by place, and were not.
    pub newly_hidden: u64,
    /// Vertices with weights that were hidden, and are shown at the end.
    pub newly_shown: u64,
}

/// Sums of what has been evaluated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Evaluations {
    pub(super) certificates: u64,
    /// Exact signs.
    pub(super) exact: u64,
    /// Sites of links that were triangulated in removals of vertices of high degree.
    pub(super) link_sites: u64,
}

impl CommitReport {
    /// Adds what another change has done to the counts of work.
    pub(crate) fn add(&mut self, other: &Self) {
        self.moved += other.moved;
        self.unchanged += other.unchanged;
        self.placements += other.placements;
        self.flips += other.flips;
        self.rebuilds += other.rebuilds;
        self.inserted += other.inserted;
        self.removed += other.removed;
        self.reweighted += other.reweighted;
        self.newly_hidden += other.newly_hidden;
        self.newly_shown += other.newly_shown;
        self.within_tolerance += other.within_tolerance;
        self.within_safe_region += other.within_safe_region;
        self.tolerances += other.tolerances;
        self.certificates += other.certificates;
        self.exact_calls += other.exact_calls;
    }
}

impl Evaluations {
    /// What has been evaluated since.
    pub(super) fn since(self, before: Self) -> Self {
        Evaluations {
            certificates: self.certificates - before.certificates,
            exact: self.exact - before.exact,
            link_sites: self.link_sites - before.link_sites,
        }
    }
}

/// How linear values at a vertex that a [`refine`](super::MovingTriangulation::refine) has inserted follow from those at
/// vertices that were there: the sum of their values by these weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexWeights {
    /// The corners of the cell that it was put into; on a segment, or an edge, its two ends, the first one twice.
    pub vertices: [VertexId; 3],
    /// From 0 to 1, with a sum of 1 but for rounding.
    pub weights: [f64; 3],
}

/// What a [`refine`](super::MovingTriangulation::refine) or [`coarsen`](super::MovingTriangulation::coarsen) did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct QualityReport {
    /// Vertices inserted, with the highest ids of all.
    pub inserted: usize,
    /// How many of them are on segments.
    pub on_segments: usize,
    /// Vertices removed.
    pub removed: usize,
    /// Segments that pieces took the place of, or pieces that one took the place of.
    pub replaced_segments: usize,
    /// Segments that came, with the highest ids of all.
    pub new_segments: usize,
    /// Pieces that had to be split and are whole, as there is no room for a vertex between their ends, as a vertex
    /// touches them, or as what they had to be split for is across a gap that is narrower than 1 / 8,192 of the
    /// segments at it.
    pub unsplit: usize,
    /// Cells that are still bad, of those selected: at small angles between segments, in narrow gaps between them, at
    /// segments that are kept whole, and where the limit was reached.
    pub bad_cells: usize,
    /// Whether the limit was reached.
    pub is_cut_short: bool,
}

/// What [`stage_splits`](super::MovingTriangulation::stage_splits) has staged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SplitReport {
    /// How often pieces were split, with all conflicts at a time: a vertex is off its segment by at most so many halves of a
    /// last place of the greatest coordinates of the segment, along each axis.
    pub rounds: usize,
    /// Vertices to be inserted, where segments cross.
    pub inserted: usize,
    /// The id of the first of them; the others follow it.
    pub first_vertex: VertexId,
    /// Segments that pieces take the place of.
    pub replaced_segments: usize,
    /// Pieces to be made.
    pub pieces: usize,
    /// The id of the first of them; the others follow it, by their segments, and along each of these.
    pub first_piece: SegmentId,
}

impl Default for SplitReport {
    fn default() -> Self {
        SplitReport {
            rounds: 0,
            inserted: 0,
            first_vertex: VertexId::NONE,
            replaced_segments: 0,
            pieces: 0,
            first_piece: SegmentId::NONE,
        }
    }
}
