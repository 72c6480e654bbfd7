//! Calls that change a triangulation.

use super::super::tally;
use super::called::{c, note};
use super::places::Motion;
use super::types::{NONE, Place, Row};
use super::{ALGORITHMS, Carried, Chosen, History, flattened, options};
use deldrift::capi::deldrift_status::*;
use deldrift::capi::*;
use std::collections::BTreeSet;
use std::ptr::{null, null_mut};

impl History<'_> {
    pub(super) fn insert(&mut self) {
        let p = self.place();
        let (t, mut id) = (self.t, 77);
        let mut after = self.m.positions.clone();
        after.push(Some(p));
        let wanted = self.status_after(&after, false);
        let key = self.draw_keys(1).map(|keys| keys[0]);
        let status = self.expect_one(&wanted, || match key {
            Some(key) => c!(deldrift_insert_vertex_with_key(t, p.as_ptr(), key, &mut id)),
            None => c!(deldrift_insert_vertex(t, p.as_ptr(), &mut id)),
        });
        self.check_conflicts(status, &after, false);
        if status == DELDRIFT_OK {
            assert_eq!(id as usize, self.m.positions.len(), "the id of an insertion");
            self.m.positions.push(Some(p));
            self.m.n_known = self.m.positions.len();
            self.fresh = None;
        }
        self.check();
    }

    pub(super) fn remove(&mut self) {
        let (t, Some(v)) = (self.t, self.some()) else { return };
        let mut after = self.m.positions.clone();
        after[v as usize] = None;
        // Vertices that share a place do so already.
        let is_an_end = self.m.segments.is_an_end(v);
        let wanted = if is_an_end { DELDRIFT_END_REMOVED } else { DELDRIFT_OK };
        self.expect(wanted, || c!(deldrift_remove_vertex(t, v)));
        self.check_conflicts(wanted, &after, false);
        if is_an_end {
            return self.check();
        }
        self.m.positions[v as usize] = None;
        self.m.made.remove(&v);
        self.m.staged.remove(&v);
        self.m.leaving.remove(&v);
        self.fresh = None;
        self.check();
    }

    pub(super) fn relocate(&mut self) {
        let (t, Some(v)) = (self.t, self.some()) else { return };
        let q = if self.s.below(2) == 0 { self.place() } else { self.nudged(v) };
        let other = self.m.positions.iter().enumerate().any(|(w, p)| w != v as usize && *p == Some(q));
        let mut after = self.m.positions.clone();
        after[v as usize] = Some(q);
        let wanted = if self.m.staged.contains_key(&v) {
            vec![DELDRIFT_DUPLICATE_MOVE]
        } else if other && self.options.coincidence == 1 && self.m.at(v) != Some(q) {
            vec![DELDRIFT_COINCIDENT]
        } else {
            self.status_after(&after, false)
        };
        let status = self.expect_one(&wanted, || c!(deldrift_relocate_vertex(t, v, q.as_ptr())));
        if status == DELDRIFT_OK {
            self.m.positions[v as usize] = Some(q);
            self.fresh = None;
        }
        self.check();
    }

    /// A place near that of a vertex.
    fn nudged(&mut self, v: u32) -> Place {
        let motion = Motion::new(&mut self.s, self.style);
        let p = self.m.at(v).expect("present");
        let other = self.some().and_then(|w| self.m.at(w)).unwrap_or(p);
        motion.of(v, p, other, self.m.d)
    }

    /// Whether a move of a vertex can be staged.
    fn is_free(&self, v: u32) -> bool {
        !self.m.staged.contains_key(&v) && !self.m.leaving.contains(&v)
    }

    pub(super) fn move_one(&mut self) {
        let (t, Some(v)) = (self.t, self.some()) else { return };
        let q = self.nudged(v);
        let wanted = if self.m.leaving.contains(&v) {
            DELDRIFT_STAGED_VERTEX
        } else if self.m.staged.contains_key(&v) {
            DELDRIFT_DUPLICATE_MOVE
        } else {
            DELDRIFT_OK
        };
        self.expect(wanted, || c!(deldrift_move_vertex(t, v, q.as_ptr())));
        if wanted == DELDRIFT_OK {
            self.m.staged.insert(v, q);
        }
        self.check();
    }

    /// Where vertices go by a motion.
    fn destinations(&mut self) -> Vec<(u32, Place)> {
        let motion = Motion::new(&mut self.s, self.style);
        let start = self.s.below(motion.share);
        let present: Vec<u32> = self.m.present().collect();
        let chosen = present.iter().enumerate().filter(|(k, _)| k % motion.share == start);
        let place = |k: usize| self.m.at(present[k % present.len()]).expect("present");
        // The other one is its partner, so that they may change places.
        chosen.map(|(k, &v)| (v, motion.of(v, place(k), place(k ^ 1), self.m.d))).collect()
    }

    /// Stages moves of many vertices, by ids or, of all, without.
    pub(super) fn stage_motion(&mut self) {
        let (t, d) = (self.t, self.m.d);
        let moves: Vec<(u32, Place)> = self.destinations();
        let n = self.m.positions.len();
        if self.s.below(2) == 0 && moves.len() == self.m.present().count() {
            let mut numbers = vec![f64::NAN; n * d];
            moves.iter().for_each(|(v, q)| numbers[*v as usize * d..][..d].copy_from_slice(&q[..d]));
            let coming = self.goals_of_coming();
            coming.iter().for_each(|(v, q)| numbers[*v as usize * d..][..d].copy_from_slice(&q[..d]));
            let is_double = moves.iter().any(|(v, _)| self.m.staged.contains_key(v));
            let wanted = if is_double { DELDRIFT_DUPLICATE_MOVE } else { DELDRIFT_OK };
            self.expect(wanted, || c!(deldrift_move_vertices(t, null(), numbers.as_ptr(), n)));
            if wanted == DELDRIFT_OK {
                let leaving = &self.m.leaving;
                self.m.staged.extend(moves.into_iter().filter(|(v, _)| !leaving.contains(v)));
                self.m.coming = coming;
            }
        } else {
            let moves: Vec<(u32, Place)> = moves.into_iter().filter(|&(v, _)| self.is_free(v)).collect();
            let (ids, places): (Vec<u32>, Vec<Place>) = moves.iter().copied().unzip();
            let numbers = flattened(&places, d);
            self.ok(|| c!(deldrift_move_vertices(t, ids.as_ptr(), numbers.as_ptr(), ids.len())));
            self.m.staged.extend(moves);
        }
        self.check();
        // Most are committed at once.
        if self.s.below(4) != 0 {
            self.commit();
        }
    }

    pub(super) fn stage_insertions(&mut self) {
        let (t, count) = (self.t, self.s.below(6));
        let places: Vec<Place> = (0..count).map(|_| self.place()).collect();
        let numbers = flattened(&places, self.m.d);
        let mut first = 77;
        if self.m.coming.is_empty() {
            self.m.n_known = self.m.positions.len();
        }
        if self.next_key.is_none() && !self.has_segments && self.s.below(2) == 0 {
            return self.stage_at_free_ids(&places, &numbers);
        }
        let keys = self.draw_keys(count);
        self.ok(|| match &keys {
            Some(keys) => {
                c!(deldrift_stage_insertions_with_keys(t, numbers.as_ptr(), keys.as_ptr(), count, &mut first))
            }
            None => c!(deldrift_stage_insertions(t, numbers.as_ptr(), count, &mut first)),
        });
        assert_eq!(first as usize, self.m.positions.len(), "the id of staged insertions");
        self.m.coming.extend((first..).zip(places));
        self.m.positions.resize(self.m.positions.len() + count, None);
        self.check();
    }

    /// Under ids of removed vertices, the lowest first, and those above.
    fn stage_at_free_ids(&mut self, places: &[Place], numbers: &[f64]) {
        let (t, count, n) = (self.t, places.len(), self.m.positions.len() as u32);
        let free = (0..n).filter(|&v| self.m.at(v).is_none() && !self.m.is_coming(v));
        let wanted: Vec<u32> = free.chain(n..).take(count).collect();
        let mut ids = vec![77; count];
        self.ok(|| {
            c!(deldrift_stage_insertions_at_free_ids(t, numbers.as_ptr(), null(), count, ids.as_mut_ptr()))
        });
        assert_eq!(ids, wanted, "free ids");
        let n_ids = wanted.last().map_or(0, |last| last + 1).max(n);
        self.m.coming.extend(wanted.into_iter().zip(places.iter().copied()));
        self.m.coming.sort_unstable_by_key(|&(v, _)| v);
        self.m.positions.resize(n_ids as usize, None);
        self.check();
    }

    /// Where vertices whose insertion is staged are to be now: some elsewhere.
    fn goals_of_coming(&mut self) -> Vec<(u32, Place)> {
        let mut coming = self.m.coming.clone();
        for (_, q) in &mut coming {
            if self.s.below(2) == 0 {
                *q = self.place();
            }
        }
        coming
    }

    pub(super) fn stage_removals(&mut self) {
        let (t, count) = (self.t, self.s.below(5));
        let chosen: BTreeSet<u32> = (0..count).filter_map(|_| self.some()).collect();
        let ids: Vec<u32> = chosen.into_iter().rev().filter(|v| !self.m.leaving.contains(v)).collect();
        self.ok(|| c!(deldrift_stage_removals(t, ids.as_ptr(), ids.len())));
        self.m.staged.retain(|v, _| !ids.contains(v));
        self.m.leaving.extend(ids);
        self.check();
    }

    pub(super) fn discard(&mut self) {
        let t = self.t;
        self.ok(|| c!(deldrift_discard_moves(t)));
        self.forget_coming_ids();
        self.m.forget_staged();
        self.check();
    }

    pub(super) fn commit(&mut self) {
        let (t, after) = (self.t, self.m.committed());
        let wanted = self.status_after(&after, true);
        let mut report = deldrift_commit_report::default();
        let is_prepared = self.s.below(4) == 0;
        let status = self.expect_one(&wanted, || {
            if is_prepared {
                c!(deldrift_prepare_timestamp(t, &mut report))
            } else {
                c!(deldrift_commit_timestamp(t, &mut report))
            }
        });
        self.check_conflicts(status, &after, true);
        if status == DELDRIFT_OK {
            if is_prepared {
                return self.publish_or_withdraw(after, &report);
            }
            self.committed(after, &report);
        }
        self.check();
    }

    /// The staged timestamp is prepared. Perhaps there is another round, which is always withdrawn.
    fn publish_or_withdraw(&mut self, after: Vec<Option<Place>>, report: &deldrift_commit_report) {
        let t = self.t;
        let (mut bytes, mut timestamp) = (0, 0);
        assert_eq!(c!(deldrift_save(t, null_mut(), 0, &mut bytes)), DELDRIFT_PREPARED);
        self.is_ok(c!(deldrift_timestamp(t, &mut timestamp)));
        assert_eq!(timestamp, self.m.timestamp);
        self.is_ok(c!(deldrift_validate(t, 3)));
        let choice = self.s.below(4);
        if choice < 2 {
            self.is_ok(c!(deldrift_publish_timestamp(t)));
            self.committed(after, report);
            return self.check();
        }
        if choice == 3 {
            // Another round, which the model does not know, as it is withdrawn with the first.
            let p = self.place();
            let (mut id, mut next) = (77, 77);
            self.is_ok(c!(deldrift_stage_insertions(t, p.as_ptr(), 1, &mut id)));
            let leaving = after.iter().position(Option::is_some).filter(|_| !self.has_segments);
            if let Some(v) = leaving {
                self.is_ok(c!(deldrift_stage_removals(t, &(v as u32), 1)));
            }
            let status = c!(deldrift_prepare_timestamp(t, null_mut()));
            if status == DELDRIFT_OK {
                self.is_ok(c!(deldrift_validate(t, 3)));
                self.is_ok(c!(deldrift_stage_insertions(t, p.as_ptr(), 1, &mut next)));
                assert_eq!(next, id + 1, "ids of staged insertions");
            }
        }
        self.is_ok(c!(deldrift_withdraw_timestamp(t)));
        self.forget_coming_ids();
        self.m.forget_staged();
        self.check();
    }

    /// Ids of staged insertions are given back.
    fn forget_coming_ids(&mut self) {
        for &(id, _) in self.m.coming.iter().rev() {
            if id as usize >= self.m.n_known && id as usize + 1 == self.m.positions.len() {
                self.m.positions.pop();
            }
        }
    }

    /// The model after a commit, and what the report must say.
    pub(super) fn committed(&mut self, after: Vec<Option<Place>>, report: &deldrift_commit_report) {
        tally::COMMITS.add(1);
        let pairs = self.m.positions.iter().zip(&after);
        let moved = pairs.filter(|(old, new)| old.is_some() && new.is_some() && old != new).count();
        self.fresh = None;
        self.m.positions = after;
        let positions = &self.m.positions;
        self.m.made.retain(|&v| positions[v as usize].is_some());
        self.m.timestamp += 1;
        let counts = [moved, self.m.coming.len(), self.m.leaving.len(), self.m.hidden().len()];
        let [moved, inserted, removed, hidden] = counts.map(|n| n as u64);
        let wanted = [self.m.timestamp, moved, inserted, removed, hidden];
        let found = [report.timestamp, report.moved, report.inserted, report.removed, report.coincident];
        assert_eq!(found, wanted, "timestamp, moved, inserted, removed, coincident");
        self.m.segments.commit();
        self.m.forget_staged();
    }

    /// The step in one call; its callers have no moves staged.
    pub(super) fn commit_positions(&mut self) {
        let (t, d, n) = (self.t, self.m.d, self.m.positions.len());
        let mut numbers = vec![f64::NAN; n * d];
        let mut after = self.m.committed();
        for (v, q) in self.goals_of_coming() {
            numbers[v as usize * d..][..d].copy_from_slice(&q[..d]);
            after[v as usize] = Some(q);
        }
        for v in self.m.present() {
            numbers[v as usize * d..][..d].copy_from_slice(&self.m.at(v).expect("present")[..d]);
        }
        for (v, q) in self.destinations() {
            numbers[v as usize * d..][..d].copy_from_slice(&q[..d]);
            if !self.m.leaving.contains(&v) {
                after[v as usize] = Some(q);
            }
        }
        let wanted = if self.m.staged.is_empty() {
            self.status_after(&after, true)
        } else {
            vec![DELDRIFT_DUPLICATE_MOVE]
        };
        let mut report = deldrift_commit_report::default();
        let status =
            self.expect_one(&wanted, || c!(deldrift_commit_positions(t, numbers.as_ptr(), n, &mut report)));
        if status == DELDRIFT_OK {
            self.committed(after, &report);
        }
        self.check();
    }

    pub(super) fn set_algorithm(&mut self) {
        let t = self.t;
        let chosen = Chosen { algorithm: self.s.pick(&ALGORITHMS), ..self.chosen };
        self.ok(|| chosen.choose(t));
        self.chosen = chosen;
        self.check();
    }

    pub(super) fn compact(&mut self) {
        let (t, n) = (self.t, self.m.positions.len());
        let (mut map, mut count) = (vec![77; n], 0);
        let is_wanted = self.s.below(4) != 0;
        let (start, room) = if is_wanted { (map.as_mut_ptr(), n) } else { (null_mut(), 0) };
        self.ok(|| c!(deldrift_compact(t, start, room, &mut count)));
        assert_eq!(count, n);
        let coming: BTreeSet<u32> = self.m.coming.iter().map(|&(v, _)| v).collect();
        let mut next = 0;
        let new_id = |v: u32| {
            let is_kept = self.m.at(v).is_some() || coming.contains(&v);
            next += u32::from(is_kept);
            if is_kept { next - 1 } else { NONE }
        };
        let ids: Vec<u32> = (0..n as u32).map(new_id).collect();
        assert!(!is_wanted || map == ids, "{map:?}, not {ids:?}");
        self.renumber(&ids);
        self.check();
    }

    fn renumber(&mut self, ids: &[u32]) {
        let new = |v: u32| if v == NONE { NONE } else { ids[v as usize] };
        let row = |row: &Row| row.map(new);
        let old = std::mem::take(&mut self.m.positions);
        let kept = old.iter().zip(ids).filter(|(_, id)| **id != NONE);
        self.m.positions = kept.map(|(p, _)| *p).collect();
        self.m.n_known = ids.iter().take(self.m.n_known).filter(|id| **id != NONE).count();
        self.m.staged = self.m.staged.iter().map(|(&v, &q)| (new(v), q)).collect();
        self.m.coming.iter_mut().for_each(|(v, _)| *v = new(*v));
        self.m.leaving = self.m.leaving.iter().map(|&v| new(v)).collect();
        self.m.segments.renumber(new);
        self.m.made = self.m.made.iter().map(|&v| new(v)).collect();
        self.carried.rows.iter_mut().for_each(|r| *r = row(r));
        self.carried.hidden = self.carried.hidden.iter().map(|&v| new(v)).filter(|&v| v != NONE).collect();
        self.fresh = None;
    }

    /// Goes on with a copy, or with what has been saved.
    pub(super) fn clone_or_load(&mut self) {
        let (t, mut other) = (self.t, null_mut());
        let way = self.s.below(4);
        if way == 0 {
            self.ok(|| c!(deldrift_clone(t, &mut other)));
        } else {
            // What is loaded from is not in use by that call.
            self.callback.calls_back.set(false);
            let (options, chosen) = options(&mut self.s, &self.callback);
            if let Some(with) = self.with {
                return self.go_on_with(with);
            }
            let hides = options.coincidence == 1 && !self.m.hidden().is_empty();
            let wanted = if hides { DELDRIFT_COINCIDENT } else { DELDRIFT_OK };
            if way == 1 {
                let file = self.save_to_file();
                self.expect(wanted, || c!(deldrift_load_file(file.as_ptr(), &options, &mut other)));
                super::files::remove(&file);
            } else {
                let data = self.saved();
                let (start, size) = (data.as_ptr().cast(), data.len());
                self.expect(wanted, || c!(deldrift_load(start, size, &options, &mut other)));
            }
            if hides {
                assert!(other.is_null(), "loaded in spite of coincidence");
                self.check();
                return;
            }
            self.is_ok(chosen.choose(other));
            (self.options, self.chosen) = (options, chosen);
            self.carried = Carried::default();
        }
        let (kept, gone) = if way == 0 && self.s.below(2) == 0 { (t, other) } else { (other, t) };
        self.t = kept;
        self.end_other(gone);
        self.check();
    }
}
