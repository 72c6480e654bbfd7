//! The list of segments, and what is in their way, compared with the model.

use super::History;
use super::called::{c, note};
use super::segments::{Conflict, conflicts, status_of};
use super::types::Place;
use deldrift::capi::deldrift_conflict_kind::*;
use deldrift::capi::deldrift_status::*;
use deldrift::capi::*;
use std::ptr::null_mut;

impl History<'_> {
    /// What a change to these positions may give: that vertices share a place or, where that is refused, that something is
    /// in the way of segments, if there are both.
    pub(super) fn status_after(&self, after: &[Option<Place>], is_commit: bool) -> Vec<deldrift_status> {
        let conflicts = self.conflicts_after(after, is_commit);
        let is_rejected = self.is_rejected(after).then_some(DELDRIFT_COINCIDENT);
        let in_the_way = Some(status_of(&conflicts)).filter(|&status| status != DELDRIFT_OK);
        let refused: Vec<_> = is_rejected.into_iter().chain(in_the_way).collect();
        if refused.is_empty() { vec![DELDRIFT_OK] } else { refused }
    }

    pub(super) fn conflicts_after(&self, after: &[Option<Place>], is_commit: bool) -> Vec<Conflict> {
        let segments = &self.m.segments;
        let wanted = if is_commit { segments.coming() } else { segments.laid().collect() };
        conflicts(&wanted, after)
    }

    /// The conflicts of a change that has given this status.
    pub(super) fn check_conflicts(
        &mut self,
        status: deldrift_status,
        after: &[Option<Place>],
        is_commit: bool,
    ) {
        if self.m.d != 2 {
            return;
        }
        let mut wanted = self.conflicts_after(after, is_commit);
        if status != status_of(&wanted) {
            wanted.clear();
        }
        let mut n = 0;
        self.is_ok(c!(deldrift_segment_conflicts(self.t, null_mut(), 0, &mut n)));
        let none = deldrift_conflict { kind: DELDRIFT_CONFLICT_CROSSING, segment: 77, other: 77 };
        let mut told = vec![none; n];
        self.is_ok(c!(deldrift_segment_conflicts(self.t, told.as_mut_ptr(), n, &mut n)));
        let told: Vec<Conflict> = told.iter().map(|one| (one.kind as u32, one.segment, one.other)).collect();
        assert_eq!(told, wanted, "conflicts");
    }

    /// The list of segments.
    pub(super) fn check_segments(&self) {
        if self.m.d != 2 {
            return;
        }
        let wanted: Vec<(u32, [u32; 2])> = self.m.segments.laid().collect();
        let n = wanted.len();
        let (mut ids, mut ends, mut markers, mut count) = (vec![77; n], vec![[77; 2]; n], vec![77; n], 77);
        let (to, to_ends) = (ids.as_mut_ptr(), ends.as_mut_ptr().cast());
        self.is_ok(c!(deldrift_segments(self.t, to, to_ends, markers.as_mut_ptr(), n, &mut count)));
        assert_eq!((count, ids.iter().copied().zip(ends).collect::<Vec<_>>()), (n, wanted), "segments");
        let all = &self.m.segments.markers;
        assert!(ids.iter().zip(markers).all(|(&id, found)| found == all[id as usize]), "markers");
    }
}
