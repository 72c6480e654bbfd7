//! Rounds: changes that have been made for the next timestamp and can still all be taken back.
//!
//! Each round is a change like that of a commit. What undoes it is kept until the timestamp is published or withdrawn: of
//! the last round where the change has left it, of those before in a list.

use crate::delaunay::{Delaunay, KeptChange, Moving};
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;
use crate::motion::report::CommitReport;
use crate::motion::state::hidden::Hidden;
use crate::motion::state::segments::SegmentsBefore;
use crate::motion::state::transaction::KeptTransaction;

/// A kernel that another one has taken the place of in a round, and what belongs to it.
#[derive(Debug)]
pub(in crate::motion) struct Former<G: Moving> {
    pub(in crate::motion) kernel: Delaunay<G>,
    pub(in crate::motion) hidden: Hidden,
    pub(in crate::motion) site_of: Vec<SiteId>,
    pub(in crate::motion) sorted_stride: f64,
}

/// What undoes a round.
#[derive(Debug)]
pub(in crate::motion) struct Round<G: Moving> {
    /// The kernel before, if the round has built another one.
    pub(in crate::motion) former: Option<Box<Former<G>>>,
    /// If there were segments.
    pub(in crate::motion) segments: Option<SegmentsBefore<G>>,
    /// If others have followed, and the kernel is the same: a former one has it itself.
    pub(in crate::motion) kernel: Option<KeptChange<G>>,
    /// If others have followed.
    pub(in crate::motion) transaction: Option<KeptTransaction<G>>,
}

impl<G: Moving> Default for Round<G> {
    fn default() -> Self {
        Round { former: None, segments: None, kernel: None, transaction: None }
    }
}

impl<G: Moving> Round<G> {
    fn memory_bytes(&self) -> usize {
        let of_former = |former: &Former<G>| {
            former.kernel.memory_bytes() + former.hidden.memory_bytes() + memory::bytes_of(&former.site_of)
        };
        memory::bytes_of_made(&self.former, of_former)
            + self.segments.as_ref().map_or(0, SegmentsBefore::memory_bytes)
            + self.kernel.as_ref().map_or(0, KeptChange::memory_bytes)
            + self.transaction.as_ref().map_or(0, KeptTransaction::memory_bytes)
    }
}

/// What a triangulation was where rounds may be withdrawn to, as far as numbers tell that.
#[derive(Clone, Copy, Debug)]
pub(in crate::motion) struct Savepoint {
    /// How many rounds had been made.
    pub(in crate::motion) n_rounds: usize,
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
    /// The first one is of the timestamp before; later ones have more rounds, or as many.
    pub(in crate::motion) savepoints: Vec<Savepoint>,
    pub(in crate::motion) earlier: Vec<Round<G>>,
    /// The last round, or the one being made.
    pub(in crate::motion) last: Round<G>,
    /// Whether `last` is a round that has been made.
    pub(in crate::motion) has_last: bool,
    /// The vertices that the rounds have removed, ascending.
    pub(in crate::motion) removed: Vec<VertexId>,
    /// Whether the cells are worth sorting once the timestamp is published.
    pub(in crate::motion) wants_order: bool,
}

impl<G: Moving> Default for Rounds<G> {
    fn default() -> Self {
        Rounds {
            savepoints: Vec::new(),
            earlier: Vec::new(),
            last: Round::default(),
            has_last: false,
            removed: Vec::new(),
            wants_order: false,
        }
    }
}

impl<G: Moving> Rounds<G> {
    /// How many have been made.
    pub(in crate::motion) fn count(&self) -> usize {
        self.earlier.len() + usize::from(self.has_last)
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        self.earlier.capacity() * size_of::<Round<G>>()
            + self.earlier.iter().map(Round::memory_bytes).sum::<usize>()
            + self.last.memory_bytes()
            + memory::bytes_of(&self.removed)
            + memory::bytes_of(&self.savepoints)
    }
}
