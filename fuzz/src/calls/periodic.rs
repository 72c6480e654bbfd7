//! The positions of a history in a box that repeats: moved, edited and given another box, beside what is made anew.

use super::History;
use super::called::{c, note};
use super::check::slice;
use deldrift::capi::deldrift_status::*;
use deldrift::capi::*;
use std::collections::BTreeSet;
use std::ptr::{null, null_mut};

/// A box, and positions in it or near it.
struct Boxed {
    vectors: Vec<f64>,
    positions: Vec<f64>,
}

impl History<'_> {
    /// A box that is created, and moved with what is in it, has the cells of one that is made of what it has become.
    pub(super) fn repeat(&mut self) {
        let d = self.m.d;
        let rank = 1 + self.s.below(d);
        let n = 1 + self.s.below(9);
        let first = self.boxed(n, rank);
        let Some(t) = created(&first, d, n) else { return };
        for _ in 0..1 + self.s.below(3) {
            let next = self.boxed(n, rank);
            if self.s.below(2) == 0 {
                let staged = c!(deldrift_stage_vectors(t, next.vectors.as_ptr(), rank));
                assert!(staged == DELDRIFT_OK || staged == DELDRIFT_DEPENDENT_VECTORS, "{staged:?}");
            }
            let status = c!(deldrift_commit_positions(t, next.positions.as_ptr(), n, null_mut()));
            self.is_ok(status);
        }
        let [mut positions, mut vectors] = [vec![0.0; n * d], vec![0.0; rank * d]];
        let mut count = 0;
        self.is_ok(c!(deldrift_copy_positions(t, positions.as_mut_ptr(), n, &mut count)));
        assert_eq!(count, n);
        self.is_ok(c!(deldrift_vectors(t, vectors.as_mut_ptr(), rank, &mut count)));
        assert_eq!(count, rank);
        self.wrap(t, &positions, &vectors, d);
        let anew = created(&Boxed { vectors, positions }, d, n).expect("it has been a box");
        assert_eq!(self.classes(t, d), self.classes(anew, d), "{rank} vectors, {n} vertices");
        c!(deldrift_destroy(anew));
        c!(deldrift_destroy(t));
    }

    /// Places in the box are where positions are, less the multiples of the vectors that are told, near other places or not.
    fn wrap(&mut self, t: *const deldrift_triangulation, positions: &[f64], vectors: &[f64], d: usize) {
        let (n, rank) = (positions.len() / d, vectors.len() / d);
        let (mut places, mut shifts, mut count) = (vec![0.0; n * d], vec![0i64; n * d], 0);
        let near = if self.s.below(2) == 0 { null() } else { positions.as_ptr() };
        let (place, shift) = (places.as_mut_ptr(), shifts.as_mut_ptr());
        self.is_ok(c!(deldrift_wrap_positions(t, positions.as_ptr(), near, n, place, shift)));
        self.is_ok(c!(deldrift_reduced_vectors(t, null_mut(), null_mut(), null_mut(), 0, &mut count)));
        assert_eq!(count, rank);
        for (k, &position) in positions.iter().enumerate() {
            let way = (0..rank).map(|j| shifts[k / d * d + j] as f64 * vectors[j * d + k % d]);
            assert_eq!(places[k] + way.sum::<f64>(), position, "{rank} vectors");
        }
    }

    /// Whole numbers of eighths, so that much ties.
    fn boxed(&mut self, n: usize, rank: usize) -> Boxed {
        let d = self.m.d;
        let mut number = |most: usize| (self.s.below(2 * most + 1) as f64 - most as f64) / 8.0;
        let mut vectors = vec![0.0; rank * d];
        for (k, entry) in vectors.iter_mut().enumerate() {
            *entry = number(6) + if k % (d + 1) == 0 { 1.5 } else { 0.0 };
        }
        let positions = (0..n * d).map(|_| number(24)).collect();
        Boxed { vectors, positions }
    }

    /// The classes of cells: corners with their shifts beside those of the first.
    fn classes(&self, t: *const deldrift_triangulation, d: usize) -> BTreeSet<Vec<(u32, Vec<i64>)>> {
        let mut view =
            deldrift_cells_view { count: 0, corners_per_cell: 0, vertices: null(), neighbours: null() };
        self.is_ok(c!(deldrift_cells(t, &mut view)));
        let (mut shifts, mut count) = (vec![0i64; view.count * (d + 1) * d], 0);
        let room = if view.count == 0 { null_mut() } else { shifts.as_mut_ptr() };
        self.is_ok(c!(deldrift_cell_shifts(t, room, null_mut(), view.count, &mut count)));
        assert_eq!(count, view.count);
        self.is_ok(c!(deldrift_edge_shifts(t, null_mut(), 0, &mut count)));
        assert!(count >= view.count.min(1) * d, "{count} edges of {} cells", view.count);
        let corners = slice(view.vertices, view.count * (d + 1));
        let classes =
            corners.chunks_exact(d + 1).zip(shifts.chunks_exact((d + 1) * d)).map(|(row, shifts)| {
                // The corner of the lowest id is where it was given, and the first of these where there are several.
                let mut class: Vec<_> =
                    row.iter().copied().zip(shifts.chunks_exact(d).map(<[i64]>::to_vec)).collect();
                class.sort();
                class
            });
        classes.collect()
    }
}

/// None where the vectors depend on each other.
fn created(of: &Boxed, d: usize, n: usize) -> Option<*mut deldrift_triangulation> {
    let mut t = null_mut();
    let (positions, vectors) = (of.positions.as_ptr(), of.vectors.as_ptr());
    let rank = of.vectors.len() / d;
    let status = c!(deldrift_create_periodic(d as u32, positions, n, vectors, rank, null(), &mut t));
    assert!(status == DELDRIFT_OK || status == DELDRIFT_DEPENDENT_VECTORS, "{status:?}");
    (status == DELDRIFT_OK).then_some(t)
}
