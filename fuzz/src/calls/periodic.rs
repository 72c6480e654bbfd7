//! The positions of a history in a box that repeats: moved, edited and given another box, beside what is made anew.

use super::asking::slice;
use super::called::{c, note};
use super::{History, message};
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
        let mut known = BTreeSet::new();
        for _ in 0..1 + self.s.below(3) {
            if self.s.below(2) == 0 {
                self.take_boxed(t, &mut known);
            }
            let next = self.boxed(n, rank);
            if self.s.below(2) == 0 {
                let staged = c!(deldrift_stage_vectors(t, next.vectors.as_ptr(), rank));
                assert!(staged == DELDRIFT_OK || staged == DELDRIFT_DEPENDENT_VECTORS, "{staged:?}");
            }
            let status = c!(deldrift_commit_positions(t, next.positions.as_ptr(), n, null_mut()));
            self.is_ok(status);
            if self.s.below(3) == 0 {
                self.come_and_go(t, d, n);
            }
        }
        let t = self.kept(t, d, &mut known);
        let [mut positions, mut vectors] = [vec![0.0; n * d], vec![0.0; rank * d]];
        let mut count = 0;
        self.is_ok(c!(deldrift_copy_positions(t, positions.as_mut_ptr(), n, &mut count)));
        assert_eq!(count, n);
        self.is_ok(c!(deldrift_vectors(t, vectors.as_mut_ptr(), rank, &mut count)));
        assert_eq!(count, rank);
        self.wrap(t, &positions, &vectors, d);
        let anew = created(&Boxed { vectors, positions }, d, n).expect("it has been a box");
        assert_eq!(self.classes(t, d), self.classes(anew, d), "{rank} vectors, {n} vertices");
        self.take_boxed(t, &mut known);
        self.take_boxed(anew, &mut BTreeSet::new());
        self.voronoi_of_periods(t, d, rank);
        self.look_around([t, anew], d, n);
        c!(deldrift_destroy(anew));
        c!(deldrift_destroy(t));
    }

    /// A vertex comes and goes again, by commits or by rounds, which may be withdrawn.
    fn come_and_go(&mut self, t: *mut deldrift_triangulation, d: usize, n: usize) {
        let before = self.classes(t, d);
        let place = self.boxed(1, 1).positions;
        let (mut coming, is_tried) = (0, self.s.below(2) == 0);
        self.is_ok(c!(deldrift_stage_insertions(t, place.as_ptr(), 1, &mut coming)));
        if is_tried {
            self.is_ok(c!(deldrift_prepare_timestamp(t, null_mut())));
            self.is_ok(c!(deldrift_validate(t, 3)));
            if self.s.below(2) == 0 {
                self.is_ok(c!(deldrift_withdraw_timestamp(t)));
                assert_eq!(self.classes(t, d), before);
                return;
            }
            self.is_ok(c!(deldrift_publish_timestamp(t)));
        } else {
            self.is_ok(c!(deldrift_commit_timestamp(t, null_mut())));
            self.is_ok(c!(deldrift_validate(t, 3)));
        }
        self.is_ok(c!(deldrift_remove_vertex(t, coming)));
        self.is_ok(c!(deldrift_validate(t, 3)));
        assert_eq!(self.classes(t, d), before);
        let mut count = 0;
        self.is_ok(c!(deldrift_compact(t, null_mut(), 0, &mut count)));
        assert_eq!(count, n + 1);
    }

    /// Follows the indices of cells by the changes.
    fn take_boxed(&self, t: *mut deldrift_triangulation, known: &mut BTreeSet<u32>) {
        let mut changes = std::mem::MaybeUninit::uninit();
        self.is_ok(c!(deldrift_take_changes(t, changes.as_mut_ptr())));
        // SAFETY: it was written, as the call had no error.
        let changes: deldrift_changes = unsafe { changes.assume_init() };
        let list = |start: *const u32, n: usize| slice(start, n).to_vec();
        for cell in list(changes.removed, changes.removed_count) {
            assert!(known.remove(&cell), "it was there");
        }
        for cell in list(changes.renumbered_from, changes.renumbered_count) {
            assert!(known.remove(&cell), "it was there");
        }
        for cell in list(changes.renumbered_to, changes.renumbered_count) {
            assert!(known.insert(cell), "its index was free");
        }
        for cell in list(changes.created, changes.created_count) {
            assert!(known.insert(cell), "its index was free");
        }
        let mut count = 0;
        self.is_ok(c!(deldrift_cell_count(t, &mut count)));
        assert!(known.iter().copied().eq(0..count as u32), "all are known");
    }

    /// Places are as near to vertices in a box, and at the same of them, as in one that is made of what it has become.
    fn look_around(&mut self, both: [*const deldrift_triangulation; 2], d: usize, n: usize) {
        let places: Vec<f64> = (0..4 * d).map(|_| (self.s.below(129) as f64 - 64.0) / 16.0).collect();
        let values: Vec<f64> = (0..n).map(|v| v as f64).collect();
        let squared = self.s.below(40) as f64 / 8.0;
        let seen = both.map(|t| {
            let mut locations =
                [deldrift_location { kind: deldrift_location_kind::DELDRIFT_LOCATION_CELL, index: 0 }; 4];
            let (mut shifts, mut near, mut ids) = ([0i64; 12], [0u32; 12], [0u32; 9]);
            let (mut nearest, mut count, mut results, mut weights) = (0, 0, [0.0; 4], [0.0; 16]);
            let (at, shown) = (places.as_ptr(), locations.as_mut_ptr());
            self.is_ok(c!(deldrift_locate(t, at, shown)));
            self.is_ok(c!(deldrift_locate_points(t, at, 4, null(), shown)));
            self.is_ok(c!(deldrift_locate_in_period(t, at, 4, shown, shown, shifts.as_mut_ptr())));
            self.is_ok(c!(deldrift_nearest_vertex(t, at, &mut nearest)));
            self.is_ok(c!(deldrift_nearest_vertices(t, at, 4, 3, near.as_mut_ptr())));
            self.is_ok(c!(deldrift_vertices_in_ball(t, at, squared, ids.as_mut_ptr(), 9, &mut count)));
            // What is near vertices depends on the periods in which they are, so that only its number is as in another one.
            let mut n_near = 0;
            let none = (null(), 0, null_mut(), null_mut());
            let status = c!(deldrift_neighbour_lists(
                t,
                &squared,
                1,
                none.0,
                none.1,
                1,
                null_mut(),
                0,
                none.2,
                none.3,
                0,
                &mut n_near
            ));
            // A radius may take in images that are so many periods away that their places are rounded.
            assert!(matches!(status, DELDRIFT_OK | DELDRIFT_INVALID_VALUE), "{status:?}: {}", message());
            n_near = if status == DELDRIFT_OK { n_near } else { usize::MAX };
            let (of, to) = (values.as_ptr(), results.as_mut_ptr());
            self.is_ok(c!(deldrift_interpolate(t, 0, of, n, 1, at, 4, null(), null(), to)));
            let cells = locations.map(|location| match location.kind {
                deldrift_location_kind::DELDRIFT_LOCATION_CELL => location.index,
                _ => DELDRIFT_NONE,
            });
            self.is_ok(c!(deldrift_barycentric(t, at, cells.as_ptr(), 4, weights.as_mut_ptr())));
            assert_eq!(nearest, near[0]);
            let is_sum = |row: &[f64]| row[0].is_nan() || (row.iter().sum::<f64>() - 1.0).abs() < 1e-12;
            assert!(weights[..4 * (d + 1)].chunks_exact(d + 1).all(is_sum), "{weights:?}");
            let vertices = locations.map(|at| match at.kind {
                deldrift_location_kind::DELDRIFT_LOCATION_VERTEX => (at.kind, at.index),
                kind => (kind, 0),
            });
            ((vertices, near, n_near, ids[..count].to_vec()), results)
        });
        let [(one, values), (other, others)] = seen;
        assert_eq!(one, other, "{places:?}");
        let is_like = |(x, y): (f64, f64)| x.is_nan() && y.is_nan() || (x - y).abs() < 1e-6;
        assert!(values.into_iter().zip(others).all(is_like), "{values:?} {others:?}");
    }

    /// The triangulation, a clone of it, or one that is loaded of what it was, each with its cells.
    fn kept(
        &mut self,
        t: *mut deldrift_triangulation,
        d: usize,
        known: &mut BTreeSet<u32>,
    ) -> *mut deldrift_triangulation {
        let mut other = null_mut();
        match self.s.below(3) {
            0 => self.is_ok(c!(deldrift_clone(t, &mut other))),
            1 => {
                // Of one that has been loaded no changes have been taken.
                known.clear();
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

    /// Voronoi cells fill the box, where it is open nowhere, and have the facets of edges on both of their sides.
    fn voronoi_of_periods(&self, t: *const deldrift_triangulation, d: usize, rank: usize) {
        let (none, nowhere, mut n, mut n_edges) = (null(), null_mut(), 0, 0);
        self.is_ok(c!(deldrift_voronoi_cells(
            t,
            none,
            none,
            null(),
            0,
            nowhere,
            nowhere,
            nowhere,
            0,
            &mut n
        )));
        self.is_ok(c!(deldrift_edges(t, null_mut(), 0, &mut n_edges)));
        let [mut volumes, mut areas, mut centroids] = [vec![0.0; n], vec![0.0; n], vec![0.0; n * d]];
        let [to_volumes, to_areas, to_centroids] =
            [&mut volumes, &mut areas, &mut centroids].map(|to| to.as_mut_ptr());
        self.is_ok(c!(deldrift_voronoi_cells(
            t,
            none,
            none,
            null(),
            0,
            to_volumes,
            to_areas,
            to_centroids,
            n,
            &mut n
        )));
        let [mut measures, mut derivatives] = [vec![0.0; n_edges + 1], vec![0.0; (n_edges + 1) * 2 * d]];
        let [to_measures, to_derivatives] = [&mut measures, &mut derivatives].map(|to| to.as_mut_ptr());
        self.is_ok(c!(deldrift_voronoi_derivatives(
            t,
            none,
            none,
            null(),
            0,
            to_measures,
            nowhere,
            to_derivatives,
            n_edges + 1,
            &mut n_edges
        )));
        let same = measures.clone();
        self.is_ok(c!(deldrift_voronoi_facets(t, none, none, to_measures, n_edges + 1, &mut n_edges)));
        assert_eq!(same, measures);
        if rank == d {
            let (facets, all): (f64, f64) = (measures.iter().sum(), areas.iter().sum());
            assert!((2.0 * facets - all).abs() <= 1e-9 * all, "{facets} {all}");
            assert!(volumes.iter().all(|volume| (0.0..f64::INFINITY).contains(volume)));
            assert!(derivatives.iter().all(|x| x.is_finite()));
        } else {
            assert!(areas.iter().zip(&volumes).all(|(x, y)| *x >= 0.0 && *y >= 0.0));
        }
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
        let mut volumes = vec![0.0; view.count + 1];
        self.is_ok(c!(deldrift_volumes(t, volumes.as_mut_ptr(), volumes.len(), &mut count)));
        assert!(volumes[..count].iter().all(|&volume| volume > 0.0));
        self.is_ok(c!(deldrift_circumcentres(
            t,
            null_mut(),
            volumes.as_mut_ptr(),
            volumes.len(),
            &mut count
        )));
        assert!(volumes[..count].iter().all(|&square| square > 0.0));
        self.is_ok(c!(deldrift_hull_facets(t, null_mut(), null_mut(), null_mut(), 0, &mut count)));
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
