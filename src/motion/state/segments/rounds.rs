//! Changes of segments that are settled, and can still be taken back: rounds of a timestamp that is being prepared.

use super::{Aim, Segment, Segments};
use crate::delaunay::{Moving, Replaced};
use crate::error::Result;
use crate::ids::{SegmentId, SiteId};
use crate::machine::memory;

/// What is known of segments beside [`Segments::set_aside`] to take back a change that has been settled.
#[derive(Debug, Default)]
pub(in crate::motion) struct SegmentsBefore {
    /// Whether nothing was relaxed.
    is_of_rest: bool,
    n_enforced: usize,
    /// The segments that the change has removed.
    removed: Vec<(SegmentId, Segment)>,
}

impl SegmentsBefore {
    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.removed)
    }
}

/// The cells that segments had taken the place of before a change, and the edges that a kernel had to have, while it has
/// others.
pub(in crate::motion) type KeptSegments<G> = (Replaced<G>, Option<Vec<[SiteId; 2]>>);

impl<G: Moving> Segments<G> {
    /// What is to be known, before a change, to take it back once it has been [settled](Self::settle).
    pub(in crate::motion) fn before_settling(&self) -> Result<SegmentsBefore> {
        let mut removed = Vec::new();
        let leaving = self.leaving.iter().filter_map(|&id| Some((id, self.get(id)?)));
        memory::collect(&mut removed, leaving)?;
        Ok(SegmentsBefore { is_of_rest: false, n_enforced: self.n_enforced, removed })
    }

    /// The change stays, and so does what was before it.
    pub(in crate::motion) fn settle(&mut self, before: &mut SegmentsBefore) {
        before.is_of_rest = self.aim == Aim::Rest;
        if !before.is_of_rest {
            std::mem::swap(&mut self.replaced, &mut self.next);
        }
        self.end_staging();
    }

    /// Takes what was before a change that has been settled out of the way of the next one.
    pub(in crate::motion) fn set_aside(&mut self) -> KeptSegments<G> {
        (std::mem::take(&mut self.next), self.before.take())
    }

    /// Takes up what was [set aside](Self::set_aside).
    pub(in crate::motion) fn take_up(&mut self, kept: KeptSegments<G>) {
        (self.next, self.before) = kept;
    }

    /// A change that has been settled is going to be [undone](Self::undo).
    pub(in crate::motion) fn unsettle(&mut self, before: SegmentsBefore) {
        if !before.is_of_rest {
            std::mem::swap(&mut self.replaced, &mut self.next);
        }
        // There is room, as there was before.
        self.n_enforced = before.n_enforced;
        self.enforced.retain(|&(id, _)| id.index() < before.n_enforced);
        self.enforced.extend(before.removed);
        self.enforced.sort_unstable_by_key(|&(id, _)| id);
    }

    /// Forgets what was before changes that have been settled.
    pub(in crate::motion) fn end_rounds(&mut self) {
        self.next.clear();
        self.before = None;
    }
}
