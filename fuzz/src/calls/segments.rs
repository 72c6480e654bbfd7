//! Segments, compared with a model of them: what is in their way by all pairs, in exact arithmetic; and what they divide.

use super::super::exact_oracle::{Tally, exact_sign};
use super::super::passing_by_roots::passes_by_roots;
use super::called::{c, note};
use super::model::{NONE, Place, Row};
use super::{History, flattened, message};
use deldrift::capi::deldrift_conflict_kind::*;
use deldrift::capi::deldrift_status::*;
use deldrift::capi::*;
use std::cmp::Ordering::{self, Equal, Less};
use std::collections::BTreeSet;
use std::ptr::null_mut;

/// What is known of segments.
#[derive(Clone, Debug, Default)]
pub struct Segments {
    /// The ends by id; none where the segment has been removed. Those from `n_laid` on are staged.
    all: Vec<Option<[u32; 2]>>,
    /// The markers by id.
    markers: Vec<i32>,
    n_laid: usize,
    leaving: BTreeSet<u32>,
}

impl Segments {
    /// Those in force.
    pub fn laid(&self) -> impl Iterator<Item = (u32, [u32; 2])> {
        (0..).zip(&self.all[..self.n_laid]).filter_map(|(id, ends)| ends.map(|ends| (id, ends)))
    }

    /// Those after a commit.
    fn coming(&self) -> Vec<(u32, [u32; 2])> {
        let all = (0..).zip(&self.all).filter_map(|(id, ends)| ends.map(|ends| (id, ends)));
        all.filter(|(id, _)| !self.leaving.contains(id)).collect()
    }

    pub fn forget_staged(&mut self) {
        self.all.truncate(self.n_laid);
        self.markers.truncate(self.n_laid);
        self.leaving.clear();
    }

    pub fn commit(&mut self) {
        for id in std::mem::take(&mut self.leaving) {
            self.all[id as usize] = None;
        }
        self.n_laid = self.all.len();
    }

    pub fn renumber(&mut self, new: impl Fn(u32) -> u32) {
        self.all.iter_mut().flatten().for_each(|ends| *ends = ends.map(&new));
    }

    pub fn has_staged(&self) -> bool {
        self.all.len() > self.n_laid || !self.leaving.is_empty()
    }

    /// How many ids have been given.
    pub fn n_ids(&self) -> u32 {
        self.all.len() as u32
    }

    /// One in force is gone.
    pub fn drop(&mut self, id: u32) {
        assert!(self.all[id as usize].take().is_some(), "{id} is in force");
    }

    /// One comes into force, with the marker of another one.
    pub fn add(&mut self, ends: [u32; 2], like: u32) {
        self.all.push(Some(ends));
        self.markers.push(self.markers[like as usize]);
        self.n_laid += 1;
    }

    pub fn is_an_end(&self, v: u32) -> bool {
        self.laid().any(|(_, ends)| ends.contains(&v))
    }
}

fn turn(a: &Place, b: &Place, p: &Place) -> Ordering {
    exact_sign::<2, 3>(&[a, b, p].map(|p| [p[0], p[1]]), &mut Tally::default())
}

fn is_between(a: &Place, b: &Place, p: &Place) -> bool {
    let is_in = |k: usize| a[k].min(b[k]) <= p[k] && p[k] <= a[k].max(b[k]);
    turn(a, b, p) == Equal && is_in(0) && is_in(1) && p != a && p != b
}

fn are_apart(a: &Place, b: &Place, [p, q]: [&Place; 2]) -> bool {
    let [one, other] = [p, q].map(|p| turn(a, b, p));
    one != Equal && other != Equal && one != other
}

/// A conflict as the numbers of `deldrift_conflict`.
type Conflict = (u32, u32, u32);

/// All conflicts of segments, where vertices are at these positions.
fn conflicts(segments: &[(u32, [u32; 2])], positions: &[Option<Place>]) -> Vec<Conflict> {
    let at = |v: u32| positions.get(v as usize).copied().flatten();
    let shown = |p: Place| positions.iter().position(|q| *q == Some(p)).expect("a vertex is there") as u32;
    let kinds = [
        DELDRIFT_CONFLICT_CROSSING,
        DELDRIFT_CONFLICT_ON_SEGMENT,
        DELDRIFT_CONFLICT_END_REMOVED,
        DELDRIFT_CONFLICT_ENDS_MEET,
    ];
    let [crossing, on_segment, end_removed, ends_meet] = kinds.map(|kind| kind as u32);
    let (mut found, mut edges) = (BTreeSet::new(), Vec::new());
    for &(id, ends) in segments {
        match ends.map(at) {
            [Some(p), Some(q)] if p == q => _ = found.insert((ends_meet, id, NONE)),
            [Some(p), Some(q)] => edges.push((id, p, q)),
            _ => found.extend(ends.into_iter().filter(|&v| at(v).is_none()).map(|v| (end_removed, id, v))),
        }
    }
    for (k, (id, a, b)) in edges.iter().enumerate() {
        for p in positions.iter().flatten().filter(|p| is_between(a, b, p)) {
            found.insert((on_segment, *id, shown(*p)));
        }
        for (other, p, q) in &edges[..k] {
            if are_apart(a, b, [p, q]) && are_apart(p, q, [a, b]) {
                found.insert((crossing, *id.min(other), *id.max(other)));
            }
        }
    }
    found.into_iter().collect()
}

fn status_of(conflicts: &[Conflict]) -> deldrift_status {
    match conflicts.first() {
        None => DELDRIFT_OK,
        Some((0, ..)) => DELDRIFT_CROSSING,
        Some((1, ..)) => DELDRIFT_ON_SEGMENT,
        Some((2, ..)) => DELDRIFT_END_REMOVED,
        Some(_) => DELDRIFT_ENDS_MEET,
    }
}

impl History<'_> {
    /// Segments come, go, and are asked about.
    pub(super) fn change_segments(&mut self) {
        match self.s.below(12) {
            0..=2 => self.stage_segments(),
            3 => self.stage_segment_removals(),
            4 => {
                self.check_staged();
                self.check_passings();
            }
            5 => self.read_sides(),
            6 => self.read_regions(),
            7 => self.stage_splits(),
            8 => self.read_chains(),
            _ => self.improve(),
        }
    }

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

    fn stage_segments(&mut self) {
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

    fn stage_segment_removals(&mut self) {
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
    fn check_staged(&mut self) {
        let (t, after) = (self.t, self.m.committed());
        let wanted = self.status_after(&after, true);
        let is_free = self.m.segments.coming().is_empty() && self.m.segments.leaving.is_empty();
        let status = self.call(|| c!(deldrift_check_staged(t)));
        assert!(wanted.contains(&status) || is_free && status == DELDRIFT_OK, "{status:?}: {}", message());
        self.check_conflicts(status, &after, true);
        self.check();
    }

    /// The vertices that pass segments, by all pairs.
    fn check_passings(&mut self) {
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
    fn stage_splits(&mut self) {
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

    /// What a change to these positions may give: that vertices share a place or, where that is refused, that something is
    /// in the way of segments, if there are both.
    pub(super) fn status_after(&self, after: &[Option<Place>], is_commit: bool) -> Vec<deldrift_status> {
        let conflicts = self.conflicts_after(after, is_commit);
        let is_rejected = self.is_rejected(after).then_some(DELDRIFT_COINCIDENT);
        let in_the_way = Some(status_of(&conflicts)).filter(|&status| status != DELDRIFT_OK);
        let refused: Vec<_> = is_rejected.into_iter().chain(in_the_way).collect();
        if refused.is_empty() { vec![DELDRIFT_OK] } else { refused }
    }

    fn conflicts_after(&self, after: &[Option<Place>], is_commit: bool) -> Vec<Conflict> {
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

    /// For each cell the segments at its edges, looked for among all.
    pub(super) fn wanted_sides(&self) -> (Vec<Row>, Vec<Row>, Vec<[u32; 3]>) {
        let (rows, neighbours) = self.cells();
        let shown = self.m.representatives();
        let edges: Vec<(u32, [u32; 2])> =
            self.m.segments.laid().map(|(id, ends)| (id, ends.map(|v| shown[v as usize]))).collect();
        let at = |row: &Row, i: usize| {
            let edge = [row[(i + 1) % 3], row[(i + 2) % 3]];
            let is_there = |ends: &[u32; 2]| *ends == edge || [ends[1], ends[0]] == edge;
            edges.iter().find(|(_, ends)| is_there(ends)).map_or(NONE, |&(id, _)| id)
        };
        let sides = rows.iter().map(|row| [0, 1, 2].map(|i| at(row, i))).collect();
        (rows, neighbours, sides)
    }

    fn read_sides(&mut self) {
        let t = self.t;
        let found = self.copied(77, 3, |to, room, count| c!(deldrift_segments_of_cells(t, to, room, count)));
        let beside = self.copied(77, 2, |to, room, count| c!(deldrift_cells_of_segments(t, to, room, count)));
        let (rows, _, sides) = self.wanted_sides();
        assert_eq!(found, sides.concat(), "segments of cells");
        let shown = self.m.representatives();
        for ((id, ends), found) in self.m.segments.laid().zip(beside.chunks(2)) {
            let [a, b] = ends.map(|v| shown[v as usize]);
            let left_of = |a: u32, b: u32| {
                let has = |row: &Row| (0..3).any(|i| row[(i + 1) % 3] == a && row[(i + 2) % 3] == b);
                rows.iter().position(has).map_or(NONE, |cell| cell as u32)
            };
            assert_eq!(found, [left_of(a, b), left_of(b, a)], "cells beside segment {id}");
        }
    }

    /// Levels are the least that agree with those of the neighbours; cells without a segment between them have one label.
    fn read_regions(&mut self) {
        let (t, n_seeds) = (self.t, self.s.below(4));
        let levels = self.copied(77, 1, |to, room, count| c!(deldrift_nesting_levels(t, to, room, count)));
        let (rows, neighbours, sides) = self.wanted_sides();
        let (mut wanted, mut region) = (vec![NONE; sides.len()], (0..sides.len()).collect::<Vec<_>>());
        let mut has_changed = true;
        while std::mem::take(&mut has_changed) {
            for (cell, (across, at)) in neighbours.iter().zip(&sides).enumerate() {
                for i in 0..3 {
                    let (other, is_crossed) = (across[i], at[i] != NONE);
                    let from = if other == NONE { 0 } else { wanted[other as usize] };
                    let level = from.saturating_add(u32::from(is_crossed));
                    if level < wanted[cell] {
                        (wanted[cell], has_changed) = (level, true);
                    }
                    if other != NONE && !is_crossed && region[other as usize] < region[cell] {
                        (region[cell], has_changed) = (region[other as usize], true);
                    }
                }
            }
        }
        assert_eq!(levels, wanted, "levels");
        // Each segment is crossed at an edge, and each edge crossed has one.
        let numbers = self.copied(77, 1, |to, room, count| c!(deldrift_crossing_numbers(t, to, room, count)));
        let agrees = |(&number, &level): (&u32, &u32)| number >= level && (number == 0) == (level == 0);
        assert!(numbers.len() == levels.len() && numbers.iter().zip(&levels).all(agrees), "crossing numbers");
        let seeds: Vec<Place> = (0..n_seeds).map(|_| self.place()).collect();
        let (numbers, labels) = (flattened(&seeds, 2), [5, -5, i32::MAX]);
        let mut told = vec![77; sides.len()];
        let (start, to, n) = (numbers.as_ptr(), told.as_mut_ptr(), sides.len());
        let mut count = 0;
        let status =
            self.call(|| c!(deldrift_label_cells(t, start, labels.as_ptr(), n_seeds, 9, to, n, &mut count)));
        let touched =
            |q: &Place| -> BTreeSet<usize> { self.touching(q).iter().map(|&cell| region[cell]).collect() };
        let regions: Vec<BTreeSet<usize>> = seeds.iter().map(touched).collect();
        // The outside is a region, too, and one with those that have an edge there without a segment.
        let edges = || (0..sides.len()).flat_map(|cell| (0..3).map(move |i| (cell, i)));
        let outer: Vec<(usize, usize)> = edges().filter(|&(cell, i)| neighbours[cell][i] == NONE).collect();
        let open: BTreeSet<usize> = outer
            .iter()
            .filter(|&&(cell, i)| sides[cell][i] == NONE)
            .map(|&(cell, _)| region[cell])
            .collect();
        let at = |v: u32| self.m.at(v).expect("present");
        let is_on_hull = |q: &Place| {
            outer.iter().any(|&(cell, i)| {
                let [v, w] = [1, 2].map(|k| at(rows[cell][(i + k) % 3]));
                turn(&v, &w, q) == Equal
            })
        };
        let is_ambiguous = |(q, regions): (&Place, &BTreeSet<usize>)| {
            regions.len() > 1 || (regions.len() == 1 && is_on_hull(q) && regions.is_disjoint(&open))
        };
        if seeds.iter().zip(&regions).any(is_ambiguous) {
            assert_eq!((status, count), (DELDRIFT_AMBIGUOUS_SEED, 0), "{}", message());
            return;
        }
        assert_eq!((status, count), (DELDRIFT_OK, n), "{}", message());
        for (cell, &label) in told.iter().enumerate() {
            let seed = regions.iter().position(|regions| regions.contains(&region[cell]));
            assert_eq!(label, seed.map_or(9, |k| labels[k]), "label of cell {cell}");
        }
        self.update_labels(&told, &neighbours, &sides);
        self.label_regions(&rows, &region);
    }

    /// Regions get labels, as a rule of the lowest vertex in each, and have them; but not the other cells of a region.
    fn label_regions(&mut self, rows: &[Row], region: &[usize]) {
        let (t, n) = (self.t, rows.len());
        let rule = 1 + self.s.below(5) as i32;
        let mut lowest = vec![NONE; n + 1];
        for (row, &region) in rows.iter().zip(region) {
            lowest[region] = lowest[region].min(row[0]).min(row[1]).min(row[2]);
        }
        let labels: Vec<i32> = region.iter().map(|&region| lowest[region] as i32 % rule - 1).collect();
        if self.s.below(3) == 0 {
            self.ok(|| c!(deldrift_set_regions(t, std::ptr::null(), 0)));
        }
        let wrong: Vec<i32> = (0..n as i32).collect();
        let has_two = (0..n).any(|cell| region[..cell].contains(&region[cell]));
        let status = if has_two { DELDRIFT_INVALID_VALUE } else { DELDRIFT_OK };
        if n > 0 {
            self.expect(status, || c!(deldrift_set_regions(t, wrong.as_ptr(), n)));
            self.ok(|| c!(deldrift_set_regions(t, labels.as_ptr(), n)));
        }
        let mut undecided = 77;
        let told = self.copied(77, 1, |to: *mut i32, room, count| {
            c!(deldrift_regions(t, 9, to, room, count, &mut undecided))
        });
        // Cells from which the outside is reached, and no others.
        let levels = self.copied(77, 1, |to, room, count| c!(deldrift_nesting_levels(t, to, room, count)));
        for (cell, &label) in told.iter().enumerate() {
            let wanted = if levels[cell] == 0 { 9 } else { labels[cell] };
            assert_eq!(label, wanted, "label of cell {cell}");
        }
        let laid = self.m.segments.laid().map(|(id, _)| id).next();
        if let Some(id) = laid {
            let sides = [self.s.pick(&[DELDRIFT_NO_LABEL, 4]), 5];
            self.ok(|| c!(deldrift_set_segment_sides(t, &id, sides.as_ptr(), 1)));
        }
    }

    /// Some of the cells get their labels from others of their regions, if there are any, or else from the outside.
    fn update_labels(&mut self, told: &[i32], neighbours: &[Row], sides: &[[u32; 3]]) {
        let (t, n, share) = (self.t, told.len(), 1 + self.s.below(4));
        let mut listed: Vec<u32> = (0..n as u32).filter(|_| self.s.below(4) < share).collect();
        let is_listed: BTreeSet<u32> = listed.iter().copied().collect();
        listed.extend(is_listed.first());
        let (mut wanted, mut wanted_undecided) = (told.to_vec(), 0);
        let mut left = is_listed.clone();
        while let Some(first) = left.pop_first() {
            let (mut found, mut has_label, mut is_outer) = (vec![first], false, false);
            let mut k = 0;
            while k < found.len() {
                let cell = found[k] as usize;
                k += 1;
                for i in (0..3).filter(|&i| sides[cell][i] == NONE) {
                    let other = neighbours[cell][i];
                    is_outer |= other == NONE;
                    has_label |= other != NONE && !is_listed.contains(&other);
                    if left.remove(&other) {
                        found.push(other);
                    }
                }
            }
            if !has_label {
                found.iter().for_each(|&cell| wanted[cell as usize] = 8);
                wanted_undecided += if is_outer { 0 } else { found.len() };
            }
        }
        let mut labels = told.to_vec();
        is_listed.iter().for_each(|&cell| labels[cell as usize] = i32::MIN);
        let (cells, n_listed, to, mut undecided) = (listed.as_ptr(), listed.len(), labels.as_mut_ptr(), 77);
        self.ok(|| c!(deldrift_update_labels(t, cells, n_listed, 8, to, n, &mut undecided)));
        assert_eq!((labels, undecided), (wanted, wanted_undecided), "labels again of {listed:?}");
    }

    /// The cells that have a place inside or on their boundary.
    fn touching(&self, q: &Place) -> Vec<usize> {
        let (rows, _) = self.cells();
        let at = |v: u32| self.m.at(v).expect("present");
        let has = |row: &Row| (0..3).all(|i| turn(&at(row[i]), &at(row[(i + 1) % 3]), q) != Less);
        rows.iter().enumerate().filter(|(_, row)| has(row)).map(|(cell, _)| cell).collect()
    }

    /// Chains are closed, have the edges of the boundary, and begin in order.
    fn read_chains(&mut self) {
        let t = self.t;
        let (rows, neighbours, sides) = self.wanted_sides();
        let n = rows.len();
        let mask: Vec<u8> = (0..n).map(|_| self.s.byte() & 1).collect();
        let none = null_mut::<u32>;
        let vertices = self.copied(77, 1, |to, room, count| {
            c!(deldrift_boundary_chains(
                t,
                mask.as_ptr(),
                n,
                to,
                none(),
                none(),
                none(),
                null_mut(),
                room,
                count
            ))
        });
        let e = vertices.len();
        let [mut chains, mut segments, mut cells] = [0; 3].map(|_| vec![77; e]);
        let (mut corners, mut count) = (vec![77; e], 0);
        let [to_chains, to_segments, to_cells] =
            [&mut chains, &mut segments, &mut cells].map(|list| list.as_mut_ptr());
        let to_corners = corners.as_mut_ptr();
        self.ok(|| {
            let (start, none) = (mask.as_ptr(), none());
            c!(deldrift_boundary_chains(
                t,
                start,
                n,
                none,
                to_chains,
                to_segments,
                to_cells,
                to_corners,
                e,
                &mut count
            ))
        });
        let is_out = |cell: u32| cell == NONE || mask[cell as usize] == 0;
        let mut wanted = BTreeSet::new();
        for (cell, across) in neighbours.iter().enumerate().filter(|(cell, _)| mask[*cell] != 0) {
            wanted.extend((0..3).filter(|&i| is_out(across[i])).map(|i| (cell, i)));
        }
        let mut last_start = None;
        for k in 0..e {
            let (cell, i) = (cells[k] as usize, usize::from(corners[k]));
            assert!(wanted.remove(&(cell, i)), "edge {i} of cell {cell} in a chain");
            assert_eq!(segments[k], sides[cell][i], "the segment of an edge");
            let edge = [rows[cell][(i + 1) % 3], rows[cell][(i + 2) % 3]];
            let is_first = k == 0 || chains[k] != chains[k - 1];
            let is_last = k + 1 == e || chains[k + 1] != chains[k];
            let first = chains.partition_point(|&chain| chain < chains[k]);
            assert_eq!(edge, [vertices[k], vertices[if is_last { first } else { k + 1 }]], "edge {k}");
            if is_first {
                assert!(last_start < Some(edge) && chains[k] == if k == 0 { 0 } else { chains[k - 1] + 1 });
                last_start = Some(edge);
            }
            assert!(last_start <= Some(edge), "a chain begins with its least edge");
        }
        assert!(wanted.is_empty() && count == e, "edges in no chain: {wanted:?}");
    }
}

/// What a segment is marked with.
fn marker(id: u32) -> i32 {
    3 - 7 * id as i32
}
