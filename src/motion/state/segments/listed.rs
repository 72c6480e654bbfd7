//! The list of segments: those in force, those that are staged, and those that are to go.

use super::{MAX_SEGMENTS, Segment, Segments};
use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::SegmentId;
use crate::machine::memory;

impl<G: Moving> Segments<G> {
    /// Stages segments for the next commit; returns the id of the first, which those of the others follow.
    pub(in crate::motion) fn stage(
        &mut self,
        segments: impl ExactSizeIterator<Item = Segment>,
    ) -> Result<SegmentId> {
        let given = self.n_ids() + segments.len();
        if given > MAX_SEGMENTS {
            return Err(Error::TooManySegments { given, limit: MAX_SEGMENTS });
        }
        let first = SegmentId::at(self.n_ids());
        memory::reserve(&mut self.enforced, self.staged.len() + segments.len())?;
        memory::reserve(&mut self.staged, segments.len())?;
        self.staged.extend(segments.map(Some));
        Ok(first)
    }

    /// The segment of an id that is in force or staged, to be changed.
    pub(in crate::motion) fn get_mut(&mut self, segment: SegmentId) -> Option<&mut Segment> {
        match segment.index().checked_sub(self.n_enforced) {
            Some(k) => self.staged.get_mut(k)?.as_mut(),
            None => {
                let at = self.enforced.binary_search_by_key(&segment, |&(id, _)| id).ok()?;
                Some(&mut self.enforced[at].1)
            }
        }
    }

    /// Whether a side of any of them, staged ones included, has a label.
    pub(in crate::motion) fn have_labels(&self) -> bool {
        self.enforced
            .iter()
            .map(|(_, segment)| segment)
            .chain(self.staged.iter().flatten())
            .any(Segment::has_labels)
    }

    /// Whether saved data list those in force, by what takes less: where sides have labels, and where those in force have
    /// fewer than half of the ids that were given.
    pub(in crate::motion) fn are_to_be_listed(&self) -> bool {
        2 * self.enforced.len() < self.n_enforced || self.have_labels()
    }

    /// Stages the removal of a segment that is in force, if it is not.
    pub(in crate::motion) fn stage_removal(&mut self, segment: SegmentId) -> Result<()> {
        if let Err(at) = self.leaving.binary_search(&segment) {
            memory::reserve(&mut self.leaving, 1)?;
            self.leaving.insert(at, segment);
        }
        Ok(())
    }

    /// Forgets that removals are staged.
    pub(in crate::motion) fn forget_removals(&mut self, segments: &[SegmentId]) {
        for segment in segments {
            if let Ok(at) = self.leaving.binary_search(segment) {
                self.leaving.remove(at);
            }
        }
    }

    /// Whether the removal of a segment is staged.
    pub(in crate::motion) fn is_removal_staged(&self, segment: SegmentId) -> bool {
        self.leaving.binary_search(&segment).is_ok()
    }

    /// Forgets what is staged.
    pub(in crate::motion) fn discard(&mut self) {
        self.staged.clear();
        self.leaving.clear();
    }

    /// Puts what is staged back to what it was once.
    pub(in crate::motion) fn restore_staged(&mut self, staged: &[Option<Segment>], leaving: &[SegmentId]) {
        // There is room, as arrays never shrink.
        self.staged.clear();
        self.staged.extend_from_slice(staged);
        self.leaving.clear();
        self.leaving.extend_from_slice(leaving);
    }

    /// Takes a segment out of those that will be in force, and returns it: one that is staged is not there any more.
    pub(in crate::motion) fn take_out(&mut self, segment: SegmentId) -> Result<Segment> {
        let taken = self.enforced_or_staged(segment).expect("a segment that is to be in force");
        match segment.index().checked_sub(self.n_enforced) {
            Some(k) => self.staged[k] = None,
            None => self.stage_removal(segment)?,
        }
        Ok(taken)
    }

    /// How many removals are staged.
    pub(in crate::motion) fn n_leaving(&self) -> usize {
        self.leaving.len()
    }

    /// The segments whose removal is staged.
    pub(in crate::motion) fn leaving(&self) -> &[SegmentId] {
        &self.leaving
    }

    /// The staged segments, by id from [`n_enforced`](Self::n_enforced) on; `None` for those that pieces are staged for.
    pub(in crate::motion) fn staged(&self) -> &[Option<Segment>] {
        &self.staged
    }

    /// By id from 0 to [`n_enforced`](Self::n_enforced), with `None` for those removed.
    pub(in crate::motion) fn enforced_by_id(&self) -> impl Iterator<Item = Option<Segment>> {
        let mut enforced = self.enforced.iter().peekable();
        SegmentId::range(0..self.n_enforced)
            .map(move |id| enforced.next_if(|&&(next, _)| next == id).map(|&(_, segment)| segment))
    }

    /// A segment that is in force or staged.
    pub(in crate::motion) fn enforced_or_staged(&self, segment: SegmentId) -> Option<Segment> {
        match segment.index().checked_sub(self.n_enforced) {
            Some(k) => self.staged.get(k).copied().flatten(),
            None => self.get(segment),
        }
    }

    /// How many ids have been given to segments that are, or were, in force: those behind are staged.
    pub(in crate::motion) fn n_enforced(&self) -> usize {
        self.n_enforced
    }

    /// Segments as they were saved, those in force ascending and of ids below `n_enforced`.
    pub(in crate::motion) fn of_saved(
        mut enforced: Vec<(SegmentId, Segment)>,
        n_enforced: usize,
        staged: Vec<Option<Segment>>,
        leaving: Vec<SegmentId>,
    ) -> Result<Self> {
        memory::reserve(&mut enforced, staged.len())?;
        Ok(Segments { enforced, n_enforced, staged, leaving, ..Segments::default() })
    }

    /// The ids that have been given.
    pub(in crate::motion) fn n_ids(&self) -> usize {
        self.n_enforced + self.staged.len()
    }

    /// A segment that is in force.
    pub(in crate::motion) fn get(&self, segment: SegmentId) -> Option<Segment> {
        // Where none has been removed it is found at once, and it is nowhere behind.
        let n = self.enforced.len().min(segment.index() + 1);
        match self.enforced[..n].last() {
            Some(&(id, found)) if id == segment => Some(found),
            _ => {
                let at = self.enforced[..n].binary_search_by_key(&segment, |&(id, _)| id).ok()?;
                Some(self.enforced[at].1)
            }
        }
    }

    /// The segments in force, with their ids, ascending.
    pub(in crate::motion) fn enforced(&self) -> impl ExactSizeIterator<Item = (SegmentId, Segment)> {
        self.enforced.iter().copied()
    }

    /// The segments in force, ascending, to be changed.
    pub(in crate::motion) fn enforced_mut(&mut self) -> impl Iterator<Item = &mut Segment> {
        self.enforced.iter_mut().map(|(_, segment)| segment)
    }

    /// Takes the labels away from all sides.
    pub(in crate::motion) fn forget_labels(&mut self) {
        let staged = self.staged.iter_mut().flatten();
        let enforced = self.enforced.iter_mut().map(|(_, segment)| segment);
        enforced.chain(staged).for_each(|segment| segment.sides = Segment::NOTHING.sides);
    }

    /// Whether some are staged, or the removal of some.
    pub(in crate::motion) fn are_staged(&self) -> bool {
        !self.staged.is_empty() || !self.leaving.is_empty()
    }

    /// A commit has enforced what was staged.
    pub(in crate::motion) fn end_staging(&mut self) {
        let Segments { enforced, n_enforced, staged, leaving, .. } = self;
        if !leaving.is_empty() {
            enforced.retain(|(id, _)| leaving.binary_search(id).is_err());
            leaving.clear();
        }
        let ids = SegmentId::range(*n_enforced..*n_enforced + staged.len());
        *n_enforced += staged.len();
        enforced.extend(ids.zip(staged.drain(..)).filter_map(|(id, segment)| Some((id, segment?))));
    }
}
