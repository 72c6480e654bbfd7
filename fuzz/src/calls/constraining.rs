//! Segments come and go, and are split.

use super::super::passing_by_roots::passes_by_roots;
use super::called::{c, note};
use super::segments::{Conflict, conflicts, marker, status_of};
use super::types::Place;
use super::{History, message};
use deldrift::capi::deldrift_status::*;
use deldrift::capi::*;
use std::ptr::null_mut;

impl History<'_> {
    pub(super) fn stage_these(&mut self, ends: &[[u32; 2]]) {
        let (t, count) = (self.t, ends.len());
        let first_id = self.m.segments.n_ids();
        let markers: Vec<i32> = (first_id..).take(count).map(marker).collect();
        let mut first = 77;
        self.ok(|| c!(deldrift_stage_segments(t, ends.as_ptr().cast(), markers.as_ptr(), count, &mut first)));
        assert_eq!(first, first_id, "the id of staged segments");
        self.m.segments.all.extend(ends.iter().copied().map(Some));
        self.m.segments.markers.extend(markers);
    }

    pub(super) fn stage_segments(&mut self) {
        let count = self.s.below(4);
        let coming: Vec<u32> = self.m.coming.iter().map(|&(v, _)| v).collect();
        let known: Vec<u32> = self.m.present().chain(coming).collect();
        let count = if known.is_empty() { 0 } else { count };
        let ends: Vec<[u32; 2]> =
            (0..count).map(|_| [0; 2].map(|_| known[self.s.below(known.len())])).collect();
        self.stage_these(&ends);
        self.check();
        // Most are committed at once, and what is refused is forgotten.
        if self.s.below(4) != 0 {
            self.commit();
            if !self.m.segments.coming().is_empty() && self.s.below(2) == 0 {
                self.discard();
            }
        }
    }

    pub(super) fn stage_segment_removals(&mut self) {
        let t = self.t;
        let Some(id) = self.some_segment() else {
            self.expect(DELDRIFT_NO_SUCH_SEGMENT, || c!(deldrift_stage_segment_removals(t, &0, 1)));
            return;
        };
        let wanted =
            if self.m.segments.leaving.contains(&id) { DELDRIFT_NO_SUCH_SEGMENT } else { DELDRIFT_OK };
        self.expect(wanted, || c!(deldrift_stage_segment_removals(t, &id, 1)));
        self.m.segments.leaving.insert(id);
        self.expect(DELDRIFT_NO_SUCH_SEGMENT, || c!(deldrift_stage_segment_removals(t, &id, 1)));
        self.check();
    }

    /// A segment in force.
    fn some_segment(&mut self) -> Option<u32> {
        let laid: Vec<u32> = self.m.segments.laid().map(|(id, _)| id).collect();
        if laid.is_empty() { None } else { Some(laid[self.s.below(laid.len())]) }
    }

    /// A check does not see that vertices share a place where there are no segments.
    pub(super) fn check_staged(&mut self) {
        let (t, after) = (self.t, self.m.committed());
        let wanted = self.status_after(&after, true);
        let is_free = self.m.segments.coming().is_empty() && self.m.segments.leaving.is_empty();
        let status = self.call(|| c!(deldrift_check_staged(t)));
        assert!(wanted.contains(&status) || is_free && status == DELDRIFT_OK, "{status:?}: {}", message());
        self.check_conflicts(status, &after, true);
        self.check();
    }

    /// The vertices that pass segments, by all pairs.
    pub(super) fn check_passings(&mut self) {
        let t = self.t;
        if self.m.d != 2 {
            return self.expect(DELDRIFT_INVALID_DIMENSION, || c!(deldrift_check_passings(t)));
        }
        let path = |v: u32| {
            let from = self.m.at(v).filter(|_| !self.m.leaving.contains(&v))?;
            Some([from, self.m.staged.get(&v).copied().unwrap_or(from)].map(|p| [p[0], p[1]]))
        };
        let mut wanted = Vec::new();
        for (id, ends) in self.m.segments.laid().filter(|(id, _)| !self.m.segments.leaving.contains(id)) {
            let [Some(a), Some(b)] = ends.map(path) else { continue };
            for v in self.m.present().filter(|v| !ends.contains(v)) {
                if path(v).is_some_and(|p| passes_by_roots(&[p, a, b])) {
                    wanted.push((id, v));
                }
            }
        }
        let status = if wanted.is_empty() { DELDRIFT_OK } else { DELDRIFT_PASSES_SEGMENT };
        self.expect(status, || c!(deldrift_check_passings(t)));
        let n = wanted.len();
        let (mut segments, mut vertices, mut count) = (vec![77; n], vec![77; n], 77);
        let to = [segments.as_mut_ptr(), vertices.as_mut_ptr()];
        self.is_ok(c!(deldrift_passings(t, to[0], to[1], n, &mut count)));
        assert_eq!((count, segments.into_iter().zip(vertices).collect::<Vec<_>>()), (n, wanted), "passings");
        self.check();
    }

    /// Splits what is in the way of each other, within a limit; most of it is committed, and then compared with what was
    /// staged before.
    pub(super) fn stage_splits(&mut self) {
        let (t, after) = (self.t, self.m.committed());
        let limit = self.s.pick(&[0, 1, 5, usize::MAX]);
        let wanted = self.status_after(&after, true);
        let conflicts = self.conflicts_after(&after, true);
        let stays: Vec<Conflict> = conflicts.iter().copied().filter(|conflict| conflict.0 > 1).collect();
        let mut report = deldrift_split_report { inserted: 77, ..Default::default() };
        let status = self.call(|| c!(deldrift_stage_splits(t, limit, &mut report)));
        let has_crossing = conflicts.first().is_some_and(|first| first.0 == 0);
        let is_right = match status {
            DELDRIFT_OK => stays.is_empty(),
            DELDRIFT_CROSSING => stays.is_empty() && has_crossing && limit < usize::MAX,
            other => other == status_of(&stays) || other == DELDRIFT_COINCIDENT && wanted.contains(&other),
        };
        assert!(is_right, "{status:?}: {}, of {conflicts:?}, {limit}", message());
        if status != DELDRIFT_OK {
            assert_eq!(report.inserted, 77, "an output of a call that failed");
            self.check();
            return;
        }
        assert_eq!(report.rounds == 0, conflicts.is_empty(), "{report:?}, {conflicts:?}");
        assert!(report.inserted <= limit as u64, "{report:?}, {limit}");
        let first_ids = (report.first_vertex as usize, report.first_piece as usize);
        assert_eq!(first_ids, (self.m.positions.len(), self.m.segments.all.len()), "first ids");
        if self.s.below(4) == 0 {
            self.discard();
        } else if report.rounds == 0 {
            self.check();
        } else {
            self.commit_splits(after, &report);
        }
    }

    /// Commits what has been split, and learns what it is.
    fn commit_splits(&mut self, mut after: Vec<Option<Place>>, split: &deldrift_split_report) {
        let t = self.t;
        let mut report = deldrift_commit_report::default();
        self.ok(|| c!(deldrift_commit_timestamp(t, &mut report)));
        for v in split.first_vertex..split.first_vertex + split.inserted as u32 {
            let mut place = Place::default();
            self.is_ok(c!(deldrift_position(t, v, place.as_mut_ptr())));
            assert!(!after.contains(&Some(place)), "a vertex where there is one");
            self.m.coming.push((v, place));
            self.m.positions.push(None);
            after.push(Some(place));
        }
        let n = self.m.segments.all.len() + split.pieces as usize;
        let (mut ids, mut ends, mut count) = (vec![77; n], vec![[77; 2]; n], 77);
        let to_ends = ends.as_mut_ptr().cast();
        self.is_ok(c!(deldrift_segments(t, ids.as_mut_ptr(), to_ends, null_mut(), n, &mut count)));
        let found: Vec<(u32, [u32; 2])> = ids.into_iter().zip(ends).take(count).collect();
        // Each that is not there is replaced by a chain of pieces, in the order of their ids.
        let mut pieces = found.iter().filter(|(id, _)| *id >= split.first_piece);
        for (id, [from, to]) in self.m.segments.coming() {
            if found.iter().any(|&(other, _)| other == id) {
                continue;
            }
            let (mut at, mut n_pieces) = (from, 0);
            while at != to {
                let (_, [start, end]) = *pieces.next().expect("a piece");
                assert_eq!(start, at, "pieces of {id}");
                (at, n_pieces) = (end, n_pieces + 1);
                let segments = &mut self.m.segments;
                segments.all.push(Some([start, end]));
                segments.markers.push(segments.markers[id as usize]);
            }
            assert!(n_pieces > 1, "pieces of {id}");
            self.m.segments.all[id as usize] = None;
            self.m.segments.leaving.remove(&id);
        }
        assert_eq!((pieces.count(), self.m.segments.all.len()), (0, n), "pieces");
        let coming = self.m.segments.coming();
        assert_eq!((conflicts(&coming, &after), coming), (vec![], found), "what has been split");
        self.committed(after, &report);
        self.check();
    }
}
