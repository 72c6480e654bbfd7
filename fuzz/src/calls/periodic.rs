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
        let t = self.kept(t, d);
        let [mut positions, mut vectors] = [vec![0.0; n * d], vec![0.0; rank * d]];
        let mut count = 0;
        self.is_ok(c!(deldrift_copy_positions(t, positions.as_mut_ptr(), n, &mut count)));
        assert_eq!(count, n);
        self.is_ok(c!(deldrift_vectors(t, vectors.as_mut_ptr(), rank, &mut count)));
        assert_eq!(count, rank);
        let anew = created(&Boxed { vectors, positions }, d, n).expect("it has been a box");
        assert_eq!(self.classes(t, d), self.classes(anew, d), "{rank} vectors, {n} vertices");
        c!(deldrift_destroy(anew));
        c!(deldrift_destroy(t));
    }

    /// The triangulation, a clone of it, or one that is loaded of what it was, each with its cells.
    fn kept(&mut self, t: *mut deldrift_triangulation, d: usize) -> *mut deldrift_triangulation {
        let mut other = null_mut();
        match self.s.below(3) {
            0 => self.is_ok(c!(deldrift_clone(t, &mut other))),
            1 => {
                let mut size = 0;
                self.is_ok(c!(deldrift_save(t, null_mut(), 0, &mut size)));
                let mut bytes = vec![0u8; size];
                self.is_ok(c!(deldrift_save(t, bytes.as_mut_ptr().cast(), size, &mut size)));
                self.is_ok(c!(deldrift_load(bytes.as_ptr().cast(), size, null(), &mut other)));
            }
            _ => return t,
        }
        assert_eq!(self.classes(t, d), self.classes(other, d));
        self.is_ok(c!(deldrift_validate(other, 3)));
        let (mut count, mut n_edges) = (0, 0);
        self.is_ok(c!(deldrift_edges(other, null_mut(), 0, &mut n_edges)));
        self.is_ok(c!(deldrift_vertex_neighbours(other, null_mut(), 0, null_mut(), 0, &mut count)));
        assert_eq!(count, 2 * n_edges);
        c!(deldrift_destroy(t));
        other
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
