//! A model of segments: what is in their way by all pairs, in exact arithmetic.

use super::super::exact_oracle::{Tally, exact_sign};
use super::types::{NONE, Place};
use deldrift::capi::deldrift_conflict_kind::*;
use deldrift::capi::deldrift_status;
use deldrift::capi::deldrift_status::*;
use std::cmp::Ordering::{self, Equal};
use std::collections::BTreeSet;

/// What is known of segments.
#[derive(Clone, Debug, Default)]
pub struct Segments {
    /// The ends by id; none where the segment has been removed. Those from `n_laid` on are staged.
    pub all: Vec<Option<[u32; 2]>>,
    /// The markers by id.
    pub markers: Vec<i32>,
    n_laid: usize,
    pub leaving: BTreeSet<u32>,
}

impl Segments {
    /// Those in force.
    pub fn laid(&self) -> impl Iterator<Item = (u32, [u32; 2])> {
        (0..).zip(&self.all[..self.n_laid]).filter_map(|(id, ends)| ends.map(|ends| (id, ends)))
    }

    /// Those after a commit.
    pub fn coming(&self) -> Vec<(u32, [u32; 2])> {
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

pub fn turn(a: &Place, b: &Place, p: &Place) -> Ordering {
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
pub type Conflict = (u32, u32, u32);

/// All conflicts of segments, where vertices are at these positions.
pub fn conflicts(segments: &[(u32, [u32; 2])], positions: &[Option<Place>]) -> Vec<Conflict> {
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

pub fn status_of(conflicts: &[Conflict]) -> deldrift_status {
    match conflicts.first() {
        None => DELDRIFT_OK,
        Some((0, ..)) => DELDRIFT_CROSSING,
        Some((1, ..)) => DELDRIFT_ON_SEGMENT,
        Some((2, ..)) => DELDRIFT_END_REMOVED,
        Some(_) => DELDRIFT_ENDS_MEET,
    }
}

/// What a segment is marked with.
pub fn marker(id: u32) -> i32 {
    3 - 7 * id as i32
}
