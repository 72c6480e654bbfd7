//! Calls with something wrong: they fail with the status that the header says, and nothing changes.

use super::super::tally;
use super::called::{c, note};
use super::{History, message, no_triangulation};
use deldrift::capi::deldrift_status::*;
use deldrift::capi::*;
use std::ptr::{null, null_mut};

/// An address that is not one of a number.
fn misaligned<T>(value: &T) -> *mut T {
    std::ptr::from_ref(value).cast_mut().wrapping_byte_add(1)
}

impl History<'_> {
    pub(super) fn refuse(&mut self) {
        tally::REFUSED.add(1);
        // What befalls a call is for calls that could succeed.
        (self.fault, self.cancel_after) = (None, None);
        match self.s.below(6) {
            0 => self.refuse_vertices(),
            1 => self.refuse_numbers(),
            2 => self.refuse_pointers(),
            3 => self.refuse_creation(),
            4 => self.refuse_counts(),
            _ => self.refuse_values(),
        }
        assert!(!message().is_empty() && message().len() < 512);
        self.check();
    }

    /// An id that names no vertex, and what is said of it.
    fn absent(&mut self) -> (u32, deldrift_status) {
        let n = self.m.positions.len() as u32;
        let absent: Vec<u32> = (0..n).filter(|&v| self.m.at(v).is_none()).collect();
        if absent.is_empty() || self.s.below(2) == 0 {
            (self.s.pick(&[n, n + 1, u32::MAX, u32::MAX - 1]), DELDRIFT_NO_SUCH_VERTEX)
        } else {
            let v = absent[self.s.below(absent.len())];
            (v, if self.m.is_coming(v) { DELDRIFT_STAGED_VERTEX } else { DELDRIFT_REMOVED_VERTEX })
        }
    }

    fn refuse_vertices(&mut self) {
        let (t, (v, wanted)) = (self.t, self.absent());
        let (p, mut out, mut number, mut count) = ([0.5; 3], 77, 77.0, 77);
        let known = self.some();
        self.expect(wanted, || c!(deldrift_move_vertex(t, v, p.as_ptr())));
        self.expect(wanted, || c!(deldrift_relocate_vertex(t, v, p.as_ptr())));
        self.expect(wanted, || c!(deldrift_remove_vertex(t, v)));
        self.expect(wanted, || c!(deldrift_position(t, v, &mut number)));
        self.expect(wanted, || c!(deldrift_tolerance(t, v, &mut number)));
        self.expect(wanted, || c!(deldrift_star(t, v, null_mut(), 0, &mut count)));
        self.expect(wanted, || c!(deldrift_coincident_representative(t, v, &mut out)));
        self.expect(wanted, || c!(deldrift_stage_removals(t, &v, 1)));
        self.expect(wanted, || c!(deldrift_cells_around(t, &v, 1, null_mut(), 0, &mut count)));
        self.expect(wanted, || c!(deldrift_find_simplices(t, 1, &v, 1, &mut out)));
        if self.m.d == 2 {
            self.expect(wanted, || c!(deldrift_ordered_star(t, v, null_mut(), 0, &mut count)));
        }
        assert_eq!((out, number, count), (77, 77.0, 77), "an output of a call that failed");
        // All or none.
        if let Some(known) = known.filter(|v| !self.m.staged.contains_key(v) && !self.m.leaving.contains(v)) {
            let (ids, numbers) = ([known, v], [0.5; 6]);
            self.expect(wanted, || c!(deldrift_move_vertices(t, ids.as_ptr(), numbers.as_ptr(), 2)));
            self.expect(wanted, || c!(deldrift_stage_removals(t, ids.as_ptr(), 2)));
            let twice = [known; 2];
            self.expect(DELDRIFT_DUPLICATE_MOVE, || {
                c!(deldrift_move_vertices(t, twice.as_ptr(), numbers.as_ptr(), 2))
            });
            self.expect(DELDRIFT_STAGED_VERTEX, || c!(deldrift_stage_removals(t, twice.as_ptr(), 2)));
        }
    }

    fn refuse_numbers(&mut self) {
        let (t, d) = (self.t, self.m.d);
        let (bad, wanted) = self.s.pick(&[
            (f64::NAN, DELDRIFT_NOT_FINITE),
            (f64::INFINITY, DELDRIFT_NOT_FINITE),
            (1.0000000000000002e57, DELDRIFT_OUT_OF_RANGE),
            (f64::MIN, DELDRIFT_OUT_OF_RANGE),
        ]);
        let mut numbers = [0.25; 9];
        numbers[self.s.below(3 * d)] = bad;
        let p = &numbers
            [(numbers.iter().position(|x| x.to_bits() == bad.to_bits()).expect("it is there") / d) * d];
        let (mut id, mut sign) = (77, 77);
        let mut places =
            [deldrift_location { kind: deldrift_location_kind::DELDRIFT_LOCATION_CELL, index: 77 }; 3];
        self.expect(wanted, || c!(deldrift_insert_vertex(t, p, &mut id)));
        self.expect(wanted, || c!(deldrift_stage_insertions(t, numbers.as_ptr(), 3, &mut id)));
        self.expect(wanted, || c!(deldrift_locate(t, p, &mut places[0])));
        self.expect(wanted, || {
            c!(deldrift_locate_points(t, numbers.as_ptr(), 3, null(), places.as_mut_ptr()))
        });
        self.expect(wanted, || c!(deldrift_nearest_vertex(t, p, &mut id)));
        let (mut ids, mut weights, mut found) = ([77; 6], [77.0; 12], 77);
        let (to, cells) = (ids.as_mut_ptr(), [DELDRIFT_NONE; 3]);
        self.expect(wanted, || c!(deldrift_nearest_vertices(t, numbers.as_ptr(), 3, 2, to)));
        self.expect(wanted, || c!(deldrift_vertices_in_ball(t, p, 1.0, null_mut(), 0, &mut found)));
        self.expect(wanted, || c!(deldrift_conflicts(t, p, null(), null_mut(), 0, &mut found)));
        let (positions, to) = (numbers.as_ptr(), weights.as_mut_ptr());
        self.expect(wanted, || c!(deldrift_barycentric(t, positions, cells.as_ptr(), 3, to)));
        assert_eq!((ids, weights, found), ([77; 6], [77.0; 12], 77), "an output of a call that failed");
        if d == 2 {
            self.expect(wanted, || c!(deldrift_orientation(2, numbers.as_ptr(), &mut sign)));
            self.expect(wanted, || c!(deldrift_in_sphere(2, numbers.as_ptr(), &mut sign)));
        }
        let mut created = null_mut();
        self.expect(wanted, || c!(deldrift_create(d as u32, numbers.as_ptr(), 3, null(), &mut created)));
        assert!(created.is_null() && (id, sign) == (77, 77) && places.iter().all(|place| place.index == 77));
        if let Some(v) = self.some().filter(|v| !self.m.staged.contains_key(v) && !self.m.leaving.contains(v))
        {
            self.expect(wanted, || c!(deldrift_move_vertex(t, v, p)));
            self.expect(wanted, || c!(deldrift_move_vertices(t, &v, p, 1)));
            self.expect(wanted, || c!(deldrift_relocate_vertex(t, v, p)));
        }
        let n = self.m.positions.len();
        let stays = self.m.present().find(|v| !self.m.leaving.contains(v));
        if let Some(v) = stays.filter(|_| self.m.staged.is_empty()) {
            let mut all = vec![0.5; n * d];
            all[v as usize * d] = bad;
            self.expect(wanted, || c!(deldrift_commit_positions(t, all.as_ptr(), n, null_mut())));
            self.expect(wanted, || c!(deldrift_move_vertices(t, null(), all.as_ptr(), n)));
        }
    }

    fn refuse_pointers(&mut self) {
        let (t, nothing) = (self.t, no_triangulation());
        let (number, id, count) = (0.5, 77u32, 77usize);
        let null_argument = DELDRIFT_NULL_ARGUMENT;
        let odd = DELDRIFT_MISALIGNED_ARGUMENT;
        let mut out = 77;
        self.expect(null_argument, || c!(deldrift_vertex_count(nothing, &mut out)));
        self.expect(null_argument, || c!(deldrift_commit_timestamp(nothing.cast_mut(), null_mut())));
        self.expect(null_argument, || c!(deldrift_insert_vertex(t, null(), null_mut())));
        self.expect(null_argument, || c!(deldrift_move_vertices(t, null(), null(), 1)));
        self.expect(null_argument, || c!(deldrift_stage_insertions(t, null(), 1, null_mut())));
        self.expect(null_argument, || c!(deldrift_stage_removals(t, null(), 1)));
        self.expect(null_argument, || c!(deldrift_cells(t, null_mut())));
        self.expect(null_argument, || c!(deldrift_take_changes(t, null_mut())));
        self.expect(null_argument, || c!(deldrift_clone(t, null_mut())));
        self.expect(null_argument, || c!(deldrift_save_file(t, null())));
        self.expect(null_argument, || c!(deldrift_compact(t, null_mut(), 0, null_mut())));
        self.expect(odd, || c!(deldrift_vertex_count(t, misaligned(&count))));
        self.expect(odd, || c!(deldrift_insert_vertex(t, misaligned(&number), &mut 0)));
        self.expect(odd, || c!(deldrift_stage_insertions(t, misaligned(&number), 1, &mut 0)));
        self.expect(odd, || c!(deldrift_stage_removals(t, misaligned(&id), 1)));
        self.expect(odd, || c!(deldrift_commit_timestamp(t, misaligned(&deldrift_commit_report::default()))));
        self.expect(null_argument, || c!(deldrift_nearest_vertices(t, null(), 1, 1, &mut 0)));
        self.expect(null_argument, || c!(deldrift_nearest_vertices(t, [0.5; 3].as_ptr(), 1, 1, null_mut())));
        self.expect(null_argument, || {
            c!(deldrift_vertices_in_box(t, null(), null(), null_mut(), 0, &mut out))
        });
        self.expect(null_argument, || {
            c!(deldrift_cells_in_reach(
                t,
                null(),
                null(),
                1,
                null(),
                0,
                null_mut(),
                null_mut(),
                null_mut(),
                0,
                &mut out
            ))
        });
        self.expect(null_argument, || c!(deldrift_find_simplices(t, 2, null(), 1, &mut 0)));
        self.expect(null_argument, || c!(deldrift_hidden_vertices(t, null_mut(), null_mut(), 1, &mut out)));
        self.expect(odd, || c!(deldrift_barycentric(t, misaligned(&number), &id, 1, &mut 0.0)));
        self.expect(odd, || c!(deldrift_find_simplices(t, 1, misaligned(&id), 1, &mut 0)));
        self.expect(odd, || c!(deldrift_edges(t, null_mut(), 0, misaligned(&count))));
        assert_eq!((number, id, count, out), (0.5, 77, 77, 77), "an output of a call that failed");
    }

    fn refuse_creation(&mut self) {
        let (d, numbers) = (self.m.d as u32, [0.5; 9]);
        let mut created = null_mut();
        let bad = self.s.pick(&[0, 1, 4, u32::MAX]);
        self.expect(DELDRIFT_INVALID_DIMENSION, || {
            c!(deldrift_create(bad, numbers.as_ptr(), 2, null(), &mut created))
        });
        let mut options = self.options;
        options.cancel = None;
        match self.s.below(6) {
            0 => options.struct_size = self.s.pick(&[0, 1, 9, 4097, usize::MAX]),
            1 => options.algorithm = self.s.pick(&[5, 15, 16, 999, 1000, u32::MAX]),
            2 => options.coincidence = 2,
            _ => options.passing = self.s.pick(&[3, 7, u32::MAX]),
        }
        let wanted = DELDRIFT_INVALID_OPTIONS;
        self.expect(wanted, || c!(deldrift_create(d, numbers.as_ptr(), 1, &options, &mut created)));
        let data = self.saved();
        let (start, size) = (data.as_ptr(), data.len());
        self.expect(wanted, || c!(deldrift_load(start.cast(), size, &options, &mut created)));
        let cut = self.s.below(size.min(256));
        self.expect(DELDRIFT_INVALID_DATA, || {
            c!(deldrift_load(start.cast(), cut.max(1), null(), &mut created))
        });
        self.expect(DELDRIFT_IO_ERROR, || {
            c!(deldrift_load_file(c"/nowhere/at/all".as_ptr(), null(), &mut created))
        });
        let t = self.t;
        self.expect(wanted, || c!(deldrift_set_algorithm(t, 7)));
        self.expect(wanted, || c!(deldrift_research_set_algorithm(t, 4, null())));
        let rule = deldrift_research_options { switch_share: 1.5, ..self.chosen.rule };
        self.expect(wanted, || c!(deldrift_research_set_algorithm(t, 19, &rule)));
        assert!(created.is_null(), "an output of a call that failed");
    }

    fn refuse_counts(&mut self) {
        let (t, n) = (self.t, self.m.positions.len());
        let huge = usize::MAX / 2;
        let (number, id, mut out, mut count) = (0.5, 0u32, 77, 77);
        let overflow = DELDRIFT_SIZE_OVERFLOW;
        self.expect(overflow, || c!(deldrift_stage_insertions(t, &number, huge, &mut out)));
        self.expect(overflow, || c!(deldrift_move_vertices(t, &id, &number, huge)));
        self.expect(overflow, || c!(deldrift_stage_removals(t, &id, huge)));
        self.expect(overflow, || c!(deldrift_cells_around(t, &id, huge, null_mut(), 0, &mut count)));
        self.expect(overflow, || c!(deldrift_nearest_vertices(t, &number, huge, 1, &mut 0)));
        self.expect(overflow, || c!(deldrift_find_simplices(t, 2, &id, huge, &mut 0)));
        self.expect(overflow, || c!(deldrift_barycentric(t, &number, &id, huge, &mut 0.0)));
        let place = [0.5; 3];
        self.expect(overflow, || c!(deldrift_nearest_vertices(t, place.as_ptr(), 1, huge, &mut 0)));
        let more = vec![0.5; (n + 1) * 3];
        self.expect(DELDRIFT_WRONG_COUNT, || c!(deldrift_move_vertices(t, null(), more.as_ptr(), n + 1)));
        if self.m.staged.is_empty() {
            self.expect(DELDRIFT_WRONG_COUNT, || {
                c!(deldrift_commit_positions(t, more.as_ptr(), n + 1, null_mut()))
            });
        }
        let mut offsets = vec![77; n + 3];
        let start = offsets.as_mut_ptr();
        self.expect(DELDRIFT_WRONG_COUNT, || {
            c!(deldrift_vertex_cells(t, start, n + 2, null_mut(), 0, &mut count))
        });
        self.expect(DELDRIFT_WRONG_COUNT, || {
            c!(deldrift_vertex_neighbours(t, start, n, null_mut(), 0, &mut count))
        });
        let cells = self.cells().0.len();
        let mask = vec![1; cells + 1];
        let none = null_mut::<u32>();
        self.expect(DELDRIFT_WRONG_COUNT, || {
            c!(deldrift_mask_boundary(t, mask.as_ptr(), cells + 1, none, none, null_mut(), 0, &mut count))
        });
        assert!(offsets.iter().all(|&x| x == 77) && (out, count) == (77, 77));
        if n > 0 {
            self.expect(DELDRIFT_BUFFER_TOO_SMALL, || c!(deldrift_compact(t, &mut out, n - 1, &mut count)));
            assert_eq!(count, n);
        }
    }

    fn refuse_values(&mut self) {
        let (t, d) = (self.t, self.m.d);
        let (mut count, n) = (77, self.m.positions.len());
        let level = self.s.pick(&[0, 4, u32::MAX]);
        self.expect(DELDRIFT_INVALID_LEVEL, || c!(deldrift_validate(t, level)));
        let wanted = DELDRIFT_INVALID_VALUE;
        let square = self.s.pick(&[-1.0, f64::NAN, -f64::MIN_POSITIVE, f64::NEG_INFINITY]);
        self.expect(wanted, || c!(deldrift_mask_by_circumradius(t, square, null_mut(), 0, &mut count)));
        let (low, high) = ([1.0; 3], [1.0; 3]);
        let [low, high] = [low.as_ptr(), high.as_ptr()];
        self.expect(wanted, || c!(deldrift_voronoi_volumes(t, low, high, null_mut(), 0, &mut count)));
        self.expect(wanted, || c!(deldrift_voronoi_facets(t, low, high, null_mut(), 0, &mut count)));
        let (mut found, mut weight) = (77, 77.0);
        let nowhere = [0.0, f64::NAN, 0.0];
        self.expect(wanted, || c!(deldrift_vertices_in_ball(t, low, square, null_mut(), 0, &mut count)));
        self.expect(wanted, || {
            c!(deldrift_vertices_in_box(t, low, nowhere.as_ptr(), null_mut(), 0, &mut count))
        });
        self.expect(wanted, || {
            let (nowhere, nothing) = (nowhere.as_ptr(), null_mut());
            c!(deldrift_vertices_in_reach(t, nowhere, low, 1, null(), 0, nothing, null_mut(), 0, &mut count))
        });
        self.expect(wanted, || {
            let (nowhere, nothing) = (nowhere.as_ptr(), null_mut());
            c!(deldrift_hull_facets_in_reach(
                t,
                low,
                nowhere,
                1,
                null(),
                0,
                nothing,
                null_mut(),
                0,
                &mut count
            ))
        });
        self.expect(wanted, || c!(deldrift_mask_without_flat_cells(t, square, null_mut(), 0, &mut count)));
        self.expect(wanted, || c!(deldrift_find_simplices(t, 0, null(), 0, &mut found)));
        self.expect(wanted, || c!(deldrift_find_simplices(t, d as u32 + 2, null(), 0, &mut found)));
        let no_cell = self.cells().0.len() as u32;
        self.expect(DELDRIFT_NO_SUCH_FACET, || c!(deldrift_barycentric(t, low, &no_cell, 1, &mut weight)));
        let mut sign = 77;
        self.expect(DELDRIFT_INVALID_DIMENSION, || c!(deldrift_in_sphere(4, low, &mut sign)));
        assert_eq!((found, weight, sign), (77, 77.0, 77), "an output of a call that failed");
        let values = vec![0.0; n + 1];
        let (values, place, mut result) = (values.as_ptr(), [0.5; 3], 77.0);
        self.expect(wanted, || {
            c!(deldrift_interpolate(t, 2, values, n, 1, place.as_ptr(), 1, null(), null(), &mut result))
        });
        self.expect(DELDRIFT_WRONG_COUNT, || {
            c!(deldrift_interpolate(t, 0, values, n + 1, 1, place.as_ptr(), 1, null(), null(), &mut result))
        });
        let cells = self.cells().0.len() as u32;
        let mut mirror = 77;
        self.expect(DELDRIFT_NO_SUCH_FACET, || c!(deldrift_mirror_index(t, cells, 0, &mut mirror)));
        if cells > 0 {
            self.expect(DELDRIFT_NO_SUCH_FACET, || {
                c!(deldrift_mirror_index(t, 0, d as u32 + 1, &mut mirror))
            });
        }
        assert_eq!((count, mirror, result), (77, 77, 77.0), "an output of a call that failed");
        self.refuse_segments();
        self.refuse_qualities();
    }

    /// In space there are none; in the plane ids and seeds may be wrong.
    fn refuse_segments(&mut self) {
        let (t, n) = (self.t, self.m.positions.len() as u32);
        let (ends, seed, mut count, mut first) = ([n; 2], [f64::NAN, 0.0], 77, 77);
        let [bad_end, bad_id, bad_seed, in_space] = if self.m.d == 2 {
            [DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_NO_SUCH_SEGMENT, DELDRIFT_NOT_FINITE, DELDRIFT_WRONG_COUNT]
        } else {
            [DELDRIFT_INVALID_DIMENSION; 4]
        };
        self.expect(bad_end, || c!(deldrift_stage_segments(t, ends.as_ptr(), null(), 1, &mut first)));
        self.expect(bad_id, || c!(deldrift_stage_segment_removals(t, &DELDRIFT_NONE, 1)));
        let mut cells = 0;
        self.is_ok(c!(deldrift_cell_count(t, &mut cells)));
        let (mut labels, start) = (vec![77; cells + 1], seed.as_ptr());
        let to = labels.as_mut_ptr();
        self.expect(bad_seed, || c!(deldrift_label_cells(t, start, &1, 1, 2, to, cells + 1, &mut count)));
        let (mask, none) = (vec![1; cells + 1], null_mut::<u32>());
        self.expect(in_space, || {
            let (mask, corners) = (mask.as_ptr(), null_mut());
            c!(deldrift_boundary_chains(t, mask, cells + 1, none, none, none, none, corners, 0, &mut count))
        });
        if self.m.d == 3 {
            let wanted = DELDRIFT_INVALID_DIMENSION;
            self.expect(wanted, || c!(deldrift_nesting_levels(t, none, 0, &mut count)));
            self.expect(wanted, || c!(deldrift_crossing_numbers(t, none, 0, &mut count)));
            self.expect(wanted, || c!(deldrift_check_passings(t)));
            self.expect(wanted, || {
                c!(deldrift_update_labels(t, none, 0, 8, labels.as_mut_ptr(), cells, &mut count))
            });
            self.expect(wanted, || c!(deldrift_passings(t, none, none, 0, &mut count)));
            self.expect(wanted, || c!(deldrift_segments(t, none, none, null_mut(), 0, &mut count)));
            self.ok(|| c!(deldrift_check_staged(t)));
        }
        assert!((count, first) == (77, 77) && labels.iter().all(|&label| label == 77));
    }
}
