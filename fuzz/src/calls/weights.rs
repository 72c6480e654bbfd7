//! Vertices with weights, that come, go, move and grow, beside a triangulation that is made of what they have become.

use super::History;
use super::asking::{rows, slice};
use super::called::{c, note};
use super::types::Row;
use deldrift::capi::*;
use std::collections::BTreeSet;
use std::ptr::{null, null_mut};

/// The length of what repeats.
const PERIOD: f64 = 5.0;

/// Vertices by id: where each is, and its weight; none if it has gone.
type Weighed = Vec<Option<(Vec<f64>, f64)>>;

/// Cells by vertex ids, who is hidden by weight, and who by place with who represents it.
type Told = (BTreeSet<Row>, Vec<u32>, Vec<(u32, u32)>);

impl History<'_> {
    /// After any calls cells, and who is hidden, are those of a fresh build.
    pub(super) fn weigh(&mut self) {
        let d = self.m.d;
        let n = self.s.below(24);
        let mut all: Weighed = (0..n).map(|_| Some(self.weighed(d))).collect();
        let (positions, weights) = numbers_of(&all);
        let mut t = null_mut();
        let repeats = self.s.below(2) == 0;
        let create = |positions: &[f64], weights: &[f64], n: usize, t: &mut *mut deldrift_triangulation| {
            let (positions, weights, vectors) = (positions.as_ptr(), weights.as_ptr(), vectors_of(d));
            if repeats {
                let vectors = vectors.as_ptr();
                c!(deldrift_create_periodic_weighted(d as u32, positions, weights, n, vectors, d, null(), t))
            } else {
                c!(deldrift_create_weighted(d as u32, positions, weights, null(), n, null(), t))
            }
        };
        self.is_ok(create(&positions, &weights, n, &mut t));
        let mut taken = BTreeSet::new();
        for _ in 0..1 + self.s.below(6) {
            self.change_weights(t, d, &mut all);
            self.look_at_power_cells(t, d, &all, repeats);
            if self.s.below(2) == 0 {
                self.take_hidden(t, &mut taken);
            }
            if self.s.below(3) == 0 {
                t = self.saved_and_loaded(t);
                taken.clear();
            }
        }
        let ids: Vec<u32> = (0..all.len() as u32).filter(|&v| all[v as usize].is_some()).collect();
        let present: Weighed = all.iter().filter(|vertex| vertex.is_some()).cloned().collect();
        let (positions, weights) = numbers_of(&present);
        let mut fresh = null_mut();
        self.is_ok(create(&positions, &weights, ids.len(), &mut fresh));
        let is: Vec<u32> = (0..all.len() as u32).collect();
        assert_eq!(self.told(t, d, &is), self.told(fresh, d, &ids), "{all:?}");
        let mut is_weighted = false;
        self.is_ok(c!(deldrift_is_weighted(t, &mut is_weighted)));
        assert!(is_weighted);
        c!(deldrift_destroy(fresh));
        c!(deldrift_destroy(t));
    }

    /// Of few places and weights, so that many are tied.
    fn weighed(&mut self, d: usize) -> (Vec<f64>, f64) {
        let place = (0..d).map(|_| self.s.below(5) as f64).collect();
        (place, self.s.below(12) as f64 - 3.0)
    }

    fn change_weights(&mut self, t: *mut deldrift_triangulation, d: usize, all: &mut Weighed) {
        let n = all.len();
        match self.s.below(6) {
            0 | 1 => {
                let are_both = self.s.below(2) == 0;
                for vertex in all.iter_mut() {
                    let Some((place, weight)) = vertex else { continue };
                    let (other, w) = self.weighed(d);
                    *weight = w;
                    if are_both {
                        *place = other;
                    }
                }
                let (positions, weights) = numbers_of(all);
                let moved = if are_both { positions.as_ptr() } else { null() };
                self.is_ok(c!(deldrift_commit_weighted(t, moved, weights.as_ptr(), n, null_mut())));
            }
            2 => {
                let (place, weight) = self.weighed(d);
                let (mut id, at) = (0, place.as_ptr());
                match self.s.below(3) {
                    0 => {
                        self.is_ok(c!(deldrift_stage_insertions(t, at, 1, &mut id)));
                        self.is_ok(c!(deldrift_stage_weights(t, &id, &weight, 1)));
                        self.is_ok(c!(deldrift_commit_timestamp(t, null_mut())));
                    }
                    1 => {
                        self.is_ok(c!(deldrift_stage_insertions_with_weights(t, at, &weight, 1, &mut id)));
                        self.is_ok(c!(deldrift_commit_timestamp(t, null_mut())));
                    }
                    _ => self.is_ok(c!(deldrift_insert_vertex_with_weight(t, at, weight, &mut id))),
                }
                assert_eq!(id as usize, n);
                all.push(Some((place, weight)));
            }
            what => {
                let chosen = self.s.below(n.max(1));
                let Some(Some(vertex)) = all.get_mut(chosen) else { return };
                let (place, weight) = self.weighed(d);
                if what == 3 {
                    self.is_ok(c!(deldrift_remove_vertex(t, chosen as u32)));
                    all[chosen] = None;
                } else if what == 4 {
                    self.is_ok(c!(deldrift_relocate_vertex(t, chosen as u32, place.as_ptr())));
                    vertex.0 = place;
                } else {
                    self.is_ok(c!(deldrift_set_weight(t, chosen as u32, weight)));
                    vertex.1 = weight;
                }
            }
        }
        self.is_ok(c!(deldrift_validate(t, 3)));
        let (mut weights, mut count) = (vec![0.0; all.len()], 0);
        self.is_ok(c!(deldrift_weights(t, weights.as_mut_ptr(), weights.len(), &mut count)));
        let is_same = |(&w, vertex): (&f64, &Option<(Vec<f64>, f64)>)| {
            vertex.as_ref().map_or(w.is_nan(), |vertex| vertex.1 == w)
        };
        assert!(count == all.len() && weights.iter().zip(all.iter()).all(is_same));
    }

    /// Power cells fill the box, or the period.
    fn look_at_power_cells(&self, t: *mut deldrift_triangulation, d: usize, all: &Weighed, repeats: bool) {
        let (mut edges, mut count) = (0, 0);
        self.is_ok(c!(deldrift_edges(t, null_mut(), 0, &mut edges)));
        let mut by_weights = vec![0.0; edges];
        let mut volumes = vec![0.0; all.len()];
        let (low, high) = ([-1.0; 3], [5.0; 3]);
        let (low, high) = if repeats { (null(), null()) } else { (low.as_ptr(), high.as_ptr()) };
        self.is_ok(c!(deldrift_voronoi_weight_derivatives(
            t,
            low,
            high,
            null(),
            0,
            null(),
            0,
            volumes.as_mut_ptr(),
            volumes.len(),
            &mut count,
            by_weights.as_mut_ptr(),
            edges,
            &mut edges
        )));
        assert!(by_weights.iter().all(|&x| x <= 0.0));
        let whole = if repeats { PERIOD } else { 6.0_f64 }.powi(d as i32);
        let sum: f64 = volumes.iter().filter(|volume| !volume.is_nan()).sum();
        assert!(all.iter().all(Option::is_none) || (sum - whole).abs() < 1e-5 * whole, "{sum}: {all:?}");
    }

    /// Follows who is hidden by the changes.
    fn take_hidden(&self, t: *mut deldrift_triangulation, known: &mut BTreeSet<u32>) {
        let mut changes = std::mem::MaybeUninit::uninit();
        self.is_ok(c!(deldrift_take_changes(t, changes.as_mut_ptr())));
        // SAFETY: it was written, as the call had no error.
        let changes: deldrift_changes = unsafe { changes.assume_init() };
        for v in slice(changes.hidden, changes.hidden_count) {
            assert!(known.insert(*v), "it was not hidden");
        }
        for v in slice(changes.shown, changes.shown_count) {
            assert!(known.remove(v), "it was hidden");
        }
        let mut present = false;
        known.retain(|&v| {
            self.is_ok(c!(deldrift_is_present(t, v, &mut present)));
            present
        });
        let mut report = std::mem::MaybeUninit::uninit();
        self.is_ok(c!(deldrift_statistics(t, report.as_mut_ptr())));
        // SAFETY: it was written, as the call had no error.
        let report: deldrift_commit_report = unsafe { report.assume_init() };
        assert_eq!(known.len() as u64, report.coincident + report.hidden_by_weight);
    }

    fn saved_and_loaded(&self, t: *mut deldrift_triangulation) -> *mut deldrift_triangulation {
        let (mut size, mut loaded) = (0, null_mut());
        self.is_ok(c!(deldrift_save(t, null_mut(), 0, &mut size)));
        let mut bytes = vec![0_u8; size];
        self.is_ok(c!(deldrift_save(t, bytes.as_mut_ptr().cast(), size, &mut size)));
        self.is_ok(c!(deldrift_load(bytes.as_ptr().cast(), size, null(), &mut loaded)));
        c!(deldrift_destroy(t));
        loaded
    }

    /// What a triangulation tells, of vertices that have these names.
    fn told(&self, t: *const deldrift_triangulation, d: usize, names: &[u32]) -> Told {
        let mut view = std::mem::MaybeUninit::uninit();
        self.is_ok(c!(deldrift_cells(t, view.as_mut_ptr())));
        // SAFETY: it was written, as the call had no error.
        let view: deldrift_cells_view = unsafe { view.assume_init() };
        let named = |row: Row| {
            let mut row = row.map(|v| names.get(v as usize).copied().unwrap_or(v));
            row.sort_unstable();
            row
        };
        let cells = rows(slice(view.vertices, view.count * (d + 1)), d + 1).into_iter().map(named).collect();
        let n = names.len();
        let (mut by_weight, mut firsts, mut seconds, mut count) = (vec![0; n], vec![0; n], vec![0; n], 0);
        self.is_ok(c!(deldrift_hidden_by_weight(t, by_weight.as_mut_ptr(), null_mut(), n, &mut count)));
        by_weight.truncate(count);
        let (to, of) = (firsts.as_mut_ptr(), seconds.as_mut_ptr());
        self.is_ok(c!(deldrift_hidden_vertices(t, to, of, n, &mut count)));
        let name = |v: u32| names[v as usize];
        let pairs = firsts.iter().zip(&seconds).take(count).map(|(&v, &w)| (name(v), name(w))).collect();
        (cells, by_weight.into_iter().map(name).collect(), pairs)
    }
}

/// The vectors of a cube.
fn vectors_of(d: usize) -> Vec<f64> {
    (0..d * d).map(|k| if k % (d + 1) == 0 { PERIOD } else { 0.0 }).collect()
}

/// Coordinates and weights, one after the other; what has gone is NaN.
fn numbers_of(all: &Weighed) -> (Vec<f64>, Vec<f64>) {
    let d = all.iter().flatten().map(|(place, _)| place.len()).next().unwrap_or(3);
    let place = |vertex: &Option<(Vec<f64>, f64)>| {
        vertex.as_ref().map_or(vec![f64::NAN; d], |(place, _)| place.clone())
    };
    let weights = all.iter().map(|vertex| vertex.as_ref().map_or(f64::NAN, |vertex| vertex.1)).collect();
    (all.iter().flat_map(place).collect(), weights)
}
