//! Rounds: changes that have been made for the next timestamp and can still all be taken back.
//!
//! Each round is a change like that of a commit. What undoes it is kept until the timestamp is published or withdrawn: of
//! the last round where the change has left it, of those before in a list.

use crate::delaunay::{Delaunay, KeptChange, Moving};
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;
use crate::motion::report::CommitReport;
use crate::motion::state::hidden::Hidden;
use crate::motion::state::segments::{KeptSegments, SegmentsBefore};
use crate::motion::state::transaction::KeptTransaction;

/// A kernel that another one has taken the place of in a round, and what belongs to it.
#[derive(Debug)]
pub(in crate::motion) struct Former<G: Moving> {
    pub(in crate::motion) kernel: Delaunay<G>,
    pub(in crate::motion) hidden: Hidden,
    pub(in crate::motion) site_of: Vec<SiteId>,
    pub(in crate::motion) sorted_stride: f64,
}

/// What undoes a round beside what is kept where the change has left it.
#[derive(Debug)]
pub(in crate::motion) struct Settled<G: Moving> {
    /// The kernel before, if the round has built another one.
    pub(in crate::motion) former: Option<Box<Former<G>>>,
    /// If there were segments.
    pub(in crate::motion) segments: Option<SegmentsBefore>,
}

impl<G: Moving> Default for Settled<G> {
    fn default() -> Self {
        Settled { former: None, segments: None }
    }
}

impl<G: Moving> Settled<G> {
    fn memory_bytes(&self) -> usize {
        let of_former = |former: &Former<G>| {
            former.kernel.memory_bytes() + former.hidden.memory_bytes() + memory::bytes_of(&former.site_of)
        };
        memory::bytes_of_made(&self.former, of_former)
            + self.segments.as_ref().map_or(0, SegmentsBefore::memory_bytes)
    }
}

/// A round that others have followed.
#[derive(Debug)]
pub(in crate::motion) struct Round<G: Moving> {
    pub(in crate::motion) settled: Settled<G>,
    /// `None` if the round has built another kernel: then the former one has it.
    pub(in crate::motion) kernel: Option<KeptChange<G>>,
    pub(in crate::motion) transaction: KeptTransaction<G>,
    pub(in crate::motion) segments: Option<KeptSegments<G>>,
}

impl<G: Moving> Round<G> {
    fn memory_bytes(&self) -> usize {
        let of_segments = |(replaced, before): &KeptSegments<G>| {
            replaced.memory_bytes() + before.as_ref().map_or(0, memory::bytes_of)
        };
        self.settled.memory_bytes()
            + self.kernel.as_ref().map_or(0, KeptChange::memory_bytes)
            + self.transaction.memory_bytes()
            + self.segments.as_ref().map_or(0, of_segments)
    }
}

/// What a triangulation was at its timestamp, as far as numbers tell that.
#[derive(Clone, Copy, Debug)]
pub(in crate::motion) struct Published {
    pub(in crate::motion) statistics: CommitReport,
    /// Ids of vertices, those of staged insertions that can be given back not counted.
    pub(in crate::motion) n_ids: usize,
    /// Pieces of segments, if there was a list of them.
    pub(in crate::motion) n_pieces: Option<usize>,
    pub(in crate::motion) has_segments: bool,
    /// Whether vertices had been given keys.
    pub(in crate::motion) has_keys: bool,
}

/// The rounds of a timestamp that is being prepared.
#[derive(Debug)]
pub(in crate::motion) struct Rounds<G: Moving> {
    pub(in crate::motion) before: Published,
    pub(in crate::motion) earlier: Vec<Round<G>>,
    /// The last round, or the one being made.
    pub(in crate::motion) last: Settled<G>,
    /// Whether `last` is a round that has been made.
    pub(in crate::motion) has_last: bool,
    /// The vertices that the rounds have removed, ascending.
    pub(in crate::motion) removed: Vec<VertexId>,
    /// Whether the cells are worth sorting once the timestamp is published.
    pub(in crate::motion) wants_order: bool,
}

impl<G: Moving> Rounds<G> {
    pub(in crate::motion) fn new(before: Published) -> Self {
        Rounds {
            before,
            earlier: Vec::new(),
            last: Settled::default(),
            has_last: false,
            removed: Vec::new(),
            wants_order: false,
        }
    }

    /// How many have been made.
    pub(in crate::motion) fn count(&self) -> usize {
        self.earlier.len() + usize::from(self.has_last)
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        self.earlier.capacity() * size_of::<Round<G>>()
            + self.earlier.iter().map(Round::memory_bytes).sum::<usize>()
            + self.last.memory_bytes()
            + memory::bytes_of(&self.removed)
    }
}
