//! Refinement and coarsening: their reports, pieces and weights, compared with what there was before; the quality that they
//! reach, measured here.

use super::super::tally;
use super::History;
use super::called::{c, note};
use super::message;
use super::types::{NONE, Place, Row, sorted};
use deldrift::capi::deldrift_status::*;
use deldrift::capi::*;
use std::collections::{BTreeMap, BTreeSet};
use std::ffi::{c_int, c_void};
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

/// Above what rounding does to angles in degrees, and to shares of lengths and areas.
const SLACK: f64 = 1e-6;

/// What segments in force are: by id the ends, and the segment that each is a piece of.
type Pieces = BTreeMap<u32, ([u32; 2], u32)>;

/// Cells are too large whose extent from left to right is more than a number.
unsafe extern "C" fn is_wide(width: *mut c_void, corners: *const f64) -> c_int {
    // SAFETY: the number is the program's, and there are six of the corners.
    let (width, corners) = unsafe { (*width.cast::<f64>(), std::slice::from_raw_parts(corners, 6)) };
    let xs = [corners[0], corners[2], corners[4]];
    let is_wide =
        xs.iter().copied().fold(f64::MIN, f64::max) - xs.iter().copied().fold(f64::MAX, f64::min) > width;
    c_int::from(is_wide)
}

/// A quality without a criterion.
fn any() -> deldrift_quality {
    let mut quality = MaybeUninit::uninit();
    assert_eq!(c!(deldrift_quality_init(quality.as_mut_ptr())), DELDRIFT_OK, "{}", message());
    // SAFETY: it has been written.
    unsafe { quality.assume_init() }
}

impl History<'_> {
    /// Refines or coarsens, mostly where segments are around something and nothing is staged.
    pub(super) fn improve(&mut self) {
        if self.has_staged() && self.s.below(4) != 0 {
            self.discard();
        }
        if !self.has_staged() {
            match self.s.below(6) {
                0..=2 => self.surround_all(),
                3 | 4 => self.surround_a_cell(),
                _ => {}
            }
        }
        for _ in 0..=self.s.below(3) {
            self.improve_once();
        }
    }

    fn improve_once(&mut self) {
        let extent = self.extent();
        let share = self.s.pick(&[0.0, 0.1, 0.01]);
        let (mut width, mut quality) = (extent * self.s.pick(&[0.5, 0.1]), any());
        quality.least_angle = self.s.pick(&[0.0, 10.0, 20.7, 26.5, 34.0]);
        quality.greatest_area = (extent * extent * share).min(f64::MAX);
        quality.limit = self.s.pick(&[0, 1, 5, 30, 30, 100]);
        quality.has_weights = self.s.below(2) as u32;
        quality.keeps = self.s.pick(&[0, 0, 1, 2]);
        quality.growth = self.s.pick(&[1.1, 1.0, f64::INFINITY]);
        quality.domain = self.s.pick(&[0, 0, 0, 1, 2, 3]);
        let kind = self.s.below(4);
        let n = self.m.positions.len();
        let sizes: Vec<f64> =
            (0..n).map(|_| (extent * self.s.pick(&[1.0, 0.3])).max(f64::from_bits(1))).collect();
        if kind == 0 {
            (quality.sizes, quality.size_count) = (sizes.as_ptr(), n);
        } else if kind == 1 {
            quality.is_too_large = Some(is_wide);
            quality.user_data = std::ptr::from_mut(&mut width).cast();
        }
        if self.s.below(3) != 0 {
            self.refine(&quality, if kind == 0 { &sizes } else { &[] });
        } else {
            self.coarsen(&quality);
        }
    }

    fn has_staged(&self) -> bool {
        let m = &self.m;
        !(m.staged.is_empty() && m.coming.is_empty() && m.leaving.is_empty()) || m.segments.has_staged()
    }

    /// The greatest difference of coordinates, 1 if that is no number to work with.
    fn extent(&self) -> f64 {
        let ends = |k: usize| {
            let all = self.m.positions.iter().flatten().map(move |p| p[k]);
            all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
        };
        let extent = ends(0).max(ends(1));
        if extent > 0.0 && extent < f64::INFINITY { extent } else { 1.0 }
    }

    fn surround_all(&mut self) {
        let t = self.t;
        let edges = self.copied(77, 2, |to, room, count| {
            c!(deldrift_hull_facets(t, to, null_mut(), null_mut(), room, count))
        });
        self.lay(&edges);
    }

    fn surround_a_cell(&mut self) {
        // Copies have their cells in another order.
        let rows: BTreeSet<Row> = self.cells().0.into_iter().map(sorted).collect();
        if rows.is_empty() {
            return;
        }
        let &[a, b, c, _] = rows.iter().nth(self.s.below(rows.len())).expect("there are as many");
        self.lay(&[a, b, b, c, c, a]);
    }

    /// Segments between vertices that have an edge.
    fn lay(&mut self, ends: &[u32]) {
        let mut ends: Vec<[u32; 2]> = ends.chunks_exact(2).map(|ends| [ends[0], ends[1]]).collect();
        ends.sort_unstable();
        self.stage_these(&ends);
        self.check();
        self.commit();
        assert!(!self.has_staged(), "edges are in the way of segments");
    }

    /// The cells of odd levels, or all; and what is to come of a call with that.
    fn choose_mask(&mut self) -> (Option<Vec<u8>>, deldrift_status) {
        if self.s.below(4) != 0 {
            return (None, DELDRIFT_OK);
        }
        let (_, neighbours, sides) = self.wanted_sides();
        let is_open = |(across, at): (&Row, &[u32; 3])| (0..3).any(|i| across[i] == NONE && at[i] == NONE);
        let is_refused = neighbours.iter().zip(&sides).any(is_open);
        let wanted = if is_refused { DELDRIFT_INVALID_VALUE } else { DELDRIFT_OK };
        (Some(vec![1; sides.len()]), wanted)
    }

    /// Makes the call, by which pieces that are bent may come in the way of each other; whether it has done something.
    fn has_improved(
        &mut self,
        (mask, by_region): (&Option<Vec<u8>>, bool),
        wanted: deldrift_status,
        mut call: impl FnMut(*const u8, usize) -> deldrift_status,
    ) -> bool {
        let wanted = if self.has_staged() { DELDRIFT_STAGED_VERTEX } else { wanted };
        let (start, n) = mask.as_ref().map_or((null(), 0), |mask| (mask.as_ptr(), mask.len()));
        let status = self.call(|| call(start, n));
        let is_bent = wanted == DELDRIFT_OK && matches!(status, DELDRIFT_CROSSING | DELDRIFT_ON_SEGMENT);
        let is_undecided = mask.is_none() && status == DELDRIFT_UNDECIDED_REGIONS;
        assert!(
            status == wanted || is_bent || by_region && is_undecided,
            "{status:?}, not {wanted:?}: {}",
            message()
        );
        status == DELDRIFT_OK
    }

    fn refine(&mut self, quality: &deldrift_quality, sizes: &[f64]) {
        let (t, (mask, wanted)) = (self.t, self.choose_mask());
        let (before, first) = (self.pieces(), self.m.positions.len() as u32);
        let by_region = quality.domain == 3;
        let mut report = deldrift_quality_report { inserted: 77, ..Default::default() };
        if !self.has_improved((&mask, by_region), wanted, |mask, n| {
            c!(deldrift_refine(t, quality, mask, n, &mut report))
        }) {
            assert_eq!(report.inserted, 77, "an output of a call that failed");
            return self.check();
        }
        let deldrift_quality_report { inserted, on_segments, bad_cells, is_cut_short, .. } = report;
        assert_eq!(report.reserved, [0; 4], "{report:?}");
        let places = self.m.positions.clone();
        let gone = self.drop_gone(report.removed);
        assert!(inserted <= quality.limit as u64 && on_segments <= inserted, "{report:?}");
        assert!(is_cut_short == 0 || inserted == quality.limit as u64, "{report:?}");
        assert!(quality.keeps != 2 || on_segments == 0 && report.replaced_segments == 0, "{report:?}");
        for v in first..first + inserted as u32 {
            let mut place = Place::default();
            self.is_ok(c!(deldrift_position(t, v, place.as_mut_ptr())));
            self.m.positions.push(Some(place));
            self.m.made.insert(v);
        }
        tally::REFINED.add(inserted);
        if inserted + report.removed > 0 {
            (self.fresh, self.m.timestamp) = (None, self.m.timestamp + 1);
        }
        self.follow_pieces(&before, &report, |v| v >= first || gone.contains(&v));
        self.check();
        self.check_made(&places, &report, quality.has_weights != 0);
        if mask.is_none() && bad_cells == 0 && is_cut_short == 0 {
            // Fourth powers of lengths are in the range of numbers then.
            if self.is_moderate() && quality.domain == 0 {
                self.check_quality(quality);
            }
            if report.unsplit == 0 {
                self.check_that_nothing_is_left(quality, sizes);
            }
        }
    }

    fn coarsen(&mut self, quality: &deldrift_quality) {
        let (t, (mask, wanted)) = (self.t, self.choose_mask());
        let (before, by_region) = (self.pieces(), quality.domain == 3);
        // Whether the mask is looked at where nothing is left of what has been made is not said.
        let (mask, wanted) = if self.m.made.is_empty() { (None, DELDRIFT_OK) } else { (mask, wanted) };
        let mut report = deldrift_quality_report { inserted: 77, ..Default::default() };
        if !self.has_improved((&mask, by_region), wanted, |mask, n| {
            c!(deldrift_coarsen(t, quality, mask, n, &mut report))
        }) {
            assert_eq!(report.inserted, 77, "an output of a call that failed");
            return self.check();
        }
        assert_eq!((report.inserted, report.on_segments, report.bad_cells), (0, 0, 0), "{report:?}");
        let gone = self.drop_gone(report.removed);
        tally::COARSENED.add(report.removed);
        if report.removed > 0 {
            (self.fresh, self.m.timestamp) = (None, self.m.timestamp + 1);
        }
        self.follow_pieces(&before, &report, |v| gone.contains(&v));
        self.check();
    }

    /// The vertices, of those made, that are no more: so many. The model drops them.
    fn drop_gone(&mut self, n_removed: u64) -> BTreeSet<u32> {
        let (t, n_before) = (self.t, self.m.present().count());
        let mut gone = BTreeSet::new();
        for v in self.m.made.clone() {
            let mut is_present = false;
            self.is_ok(c!(deldrift_is_present(t, v, &mut is_present)));
            if !is_present {
                self.m.positions[v as usize] = None;
                self.m.made.remove(&v);
                gone.insert(v);
            }
        }
        let n = self.m.present().count();
        assert_eq!((gone.len() as u64, n_before - n), (n_removed, gone.len()), "removed vertices");
        gone
    }

    /// The segments in force, as the library tells, and what they are pieces of.
    fn pieces(&mut self) -> Pieces {
        let t = self.t;
        let ids = self.copied(77, 1, |to, room, count| {
            c!(deldrift_segments(t, to, null_mut(), null_mut(), room, count))
        });
        let ends = self.copied(77, 2, |to, room, count| {
            c!(deldrift_segments(t, null_mut(), to, null_mut(), room, count))
        });
        let originals =
            self.copied(77, 1, |to, room, count| c!(deldrift_original_segments(t, to, room, count)));
        let ends = ends.chunks_exact(2).map(|ends| [ends[0], ends[1]]);
        ids.into_iter().zip(ends.zip(originals)).collect()
    }

    /// What has come in the place of segments: chains of one original, with the ends, the direction and the marker of what
    /// is gone, or the other way round; `is_within` are the vertices between their ends. The model has them from then on.
    fn follow_pieces(
        &mut self,
        before: &Pieces,
        report: &deldrift_quality_report,
        is_within: impl Fn(u32) -> bool,
    ) {
        let now = self.pieces();
        let gone: Vec<u32> = before.keys().filter(|id| !now.contains_key(id)).copied().collect();
        let come: Vec<u32> = now.keys().filter(|id| !before.contains_key(id)).copied().collect();
        let counts = (report.replaced_segments, report.new_segments);
        assert_eq!((gone.len() as u64, come.len() as u64), counts, "segments that are gone, and come");
        assert!(before.iter().all(|(id, piece)| now.get(id).is_none_or(|other| other == piece)), "segments");
        let shown = self.m.representatives();
        let is_at = |v: u32, w: u32| {
            v == w || !is_within(v) && !is_within(w) && shown[v as usize] == shown[w as usize]
        };
        if report.inserted > 0 && report.removed > 0 {
            return self.follow_pieces_made_anew(before, &now, [&gone, &come], is_within);
        }
        let is_split = report.inserted > 0;
        let (long, short) = if is_split { (&gone, &come) } else { (&come, &gone) };
        let row = |id: u32| if let Some(row) = now.get(&id) { *row } else { before[&id] };
        let mut left: BTreeSet<u32> = short.iter().copied().collect();
        let mut marked = BTreeMap::new();
        for &id in long {
            let ([from, to], original) = row(id);
            let (mut last, mut at, mut n) = (NONE, from, 0);
            while n == 0 || !is_at(at, to) {
                // Where vertices share a place, others of one original may begin there, and its pieces may go both ways
                // along an edge.
                let follows = |other: &&u32| {
                    let ([start, end], of) = row(**other);
                    of == original && is_at(start, at) && end != last && (is_within(end) || is_at(end, to))
                };
                let next = left.iter().copied().filter(|other| follows(&other));
                let next = next.min_by_key(|&other| row(other).0[0] != at);
                let next =
                    next.unwrap_or_else(|| panic!("no piece of {id} at {at}: {before:?}, now {now:?}"));
                left.remove(&next);
                (last, at, n) = (at, row(next).0[1], n + 1);
                marked.insert(id.max(next), id.min(next));
            }
            assert!(n > 1, "{id} is one piece");
        }
        assert!(left.is_empty(), "pieces of nothing: {left:?}");
        let first = self.m.segments.n_ids();
        assert!(come.iter().copied().eq(first..first + come.len() as u32), "ids of pieces");
        for &id in &gone {
            self.m.segments.drop(id);
        }
        for &id in &come {
            self.m.segments.add(now[&id].0, marked[&id]);
        }
    }

    /// Where vertices have been inserted and removed, what has come of each original begins and ends where what is gone does.
    fn follow_pieces_made_anew(
        &mut self,
        before: &Pieces,
        now: &Pieces,
        [gone, come]: [&[u32]; 2],
        is_within: impl Fn(u32) -> bool,
    ) {
        let shown = self.m.representatives();
        // How often more pieces begin at a place than end there; those of one original may go both ways.
        let ends = |pieces: &Pieces, ids: &[u32]| {
            let mut ends: BTreeMap<(u32, u32), u32> = BTreeMap::new();
            for ([from, to], original) in ids.iter().map(|id| pieces[id]) {
                for v in [from, to].into_iter().filter(|&v| !is_within(v)) {
                    *ends.entry((original, shown[v as usize])).or_default() += 1;
                }
            }
            ends
        };
        assert_eq!(ends(before, gone), ends(now, come), "ends of pieces");
        let first = self.m.segments.n_ids();
        assert!(come.iter().copied().eq(first..first + come.len() as u32), "ids of pieces");
        for id in come {
            let (ends, original) = now[id];
            let marked = gone.iter().find(|id| before[id].1 == original).expect("it takes the place of one");
            self.m.segments.add(ends, *marked);
        }
        gone.iter().for_each(|&id| self.m.segments.drop(id));
    }

    /// The vertices that have been made, where they were put, and the weights of the last ones.
    fn check_made(&mut self, places: &[Option<Place>], report: &deldrift_quality_report, has_weights: bool) {
        let (t, first) = (self.t, places.len() as u32);
        let made =
            self.copied(77, 1, |to, room, count| c!(deldrift_made_vertices(t, to, null_mut(), room, count)));
        let on =
            self.copied(77, 1, |to, room, count| c!(deldrift_made_vertices(t, null_mut(), to, room, count)));
        assert!(made.iter().eq(&self.m.made), "{made:?} are made, not {:?}", self.m.made);
        let new = made.iter().zip(&on).filter(|(v, _)| **v >= first);
        assert_eq!(new.filter(|(_, on)| **on != NONE).count() as u64, report.on_segments, "on segments");
        let rows = self
            .copied(77, 3, |to, room, count| c!(deldrift_refined_weights(t, to, null_mut(), room, count)));
        let weights = self
            .copied(77.0, 3, |to, room, count| c!(deldrift_refined_weights(t, null_mut(), to, room, count)));
        let inserted =
            self.copied(77, 1, |to, room, count| c!(deldrift_refined_vertices(t, to, room, count)));
        assert!(inserted.iter().copied().eq(first..first + report.inserted as u32), "ids of those inserted");
        let n = if has_weights { report.inserted as usize } else { 0 };
        assert_eq!(rows.len(), 3 * n, "weights");
        let extent = self.m.positions.iter().flatten().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
        for (k, (row, weights)) in rows.chunks(3).zip(weights.chunks(3)).enumerate() {
            let place = self.m.positions[first as usize + k].expect("present");
            let mut mean = [0.0; 2];
            for (&v, weight) in row.iter().zip(weights) {
                assert!(v < first && (0.0..=1.0).contains(weight), "{row:?}, {weights:?}");
                let p = places[v as usize].expect("a corner was present");
                (0..2).for_each(|axis| mean[axis] += weight * p[axis]);
            }
            let is_near =
                |axis: usize| (mean[axis] - place[axis]).abs() <= 1e-12 * extent + f64::MIN_POSITIVE;
            // As areas of cells have these errors only above the least normal number.
            let is_right = !self.is_moderate() || is_near(0) && is_near(1);
            assert!(is_right, "{row:?}, {weights:?}: {mean:?}, not {place:?}");
        }
    }

    /// Angles and areas of the cells of odd levels.
    fn check_quality(&mut self, quality: &deldrift_quality) {
        let t = self.t;
        let levels = self.copied(77, 1, |to, room, count| c!(deldrift_nesting_levels(t, to, room, count)));
        let (rows, _) = self.cells();
        tally::REACHED.add(u64::from(levels.iter().any(|level| level % 2 == 1)));
        for (row, _) in rows.iter().zip(levels).filter(|(_, level)| level % 2 == 1) {
            let p = [0, 1, 2].map(|i| self.m.at(row[i]).expect("present"));
            let edges = [0, 1, 2].map(|i| [0, 1].map(|axis| p[(i + 1) % 3][axis] - p[i][axis]));
            let most = edges.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
            let scaled = edges.map(|u| u.map(|x| x / most));
            for i in 0..3 {
                let (u, w) = (scaled[i], scaled[(i + 2) % 3].map(|x| -x));
                let (cross, dot) = (u[0] * w[1] - u[1] * w[0], u[0] * w[0] + u[1] * w[1]);
                let angle = cross.atan2(dot).to_degrees().abs();
                assert!(
                    angle >= quality.least_angle - SLACK,
                    "{row:?}, {p:?}, has an angle of {angle}, below {}",
                    quality.least_angle
                );
                let area = most * most * cross / 2.0;
                let is_small = quality.greatest_area == 0.0 || area <= quality.greatest_area * (1.0 + SLACK);
                assert!(is_small, "{row:?} has an area of {area}");
            }
            if let Some(is_too_large) = quality.is_too_large {
                let corners = p.map(|p| [p[0], p[1]]);
                // SAFETY: it is given what it asks for.
                let is_large = unsafe { is_too_large(quality.user_data, corners.as_ptr().cast()) };
                assert!(is_large == 0, "{row:?} is too large");
            }
        }
    }

    /// Where all is good a second call commits nothing.
    fn check_that_nothing_is_left(&mut self, quality: &deldrift_quality, sizes: &[f64]) {
        let (t, mut report) = (self.t, deldrift_quality_report::default());
        let new = self.copied(77.0, 1, |to, room, count| c!(deldrift_refined_sizes(t, to, room, count)));
        let mut quality = *quality;
        let sizes = [sizes, &new].concat();
        assert_eq!(sizes.len(), if quality.sizes.is_null() { 0 } else { self.m.positions.len() }, "sizes");
        if !quality.sizes.is_null() {
            (quality.sizes, quality.size_count) = (sizes.as_ptr(), sizes.len());
        }
        self.ok(|| c!(deldrift_refine(t, &quality, null(), 0, &mut report)));
        assert_eq!(report, deldrift_quality_report::default(), "where all is good");
        self.check();
    }

    /// A quality that has no meaning, and calls in space.
    pub(super) fn refuse_qualities(&mut self) {
        let (t, mut report) = (self.t, deldrift_quality_report { inserted: 77, ..Default::default() });
        type Change = (fn(&mut deldrift_quality), deldrift_status);
        let changes: [Change; 5] = [
            (|q| q.least_angle = f64::NAN, DELDRIFT_INVALID_VALUE),
            (|q| q.greatest_area = -1.0, DELDRIFT_INVALID_VALUE),
            (|q| q.struct_size = 3, DELDRIFT_INVALID_OPTIONS),
            (|q| q.size_count = 1, DELDRIFT_NULL_ARGUMENT),
            (|q| q.label_count = usize::MAX, DELDRIFT_NULL_ARGUMENT),
        ];
        for (change, wanted) in changes {
            let mut quality = any();
            change(&mut quality);
            let is_value = wanted == DELDRIFT_INVALID_VALUE;
            let wanted = match self.m.d {
                3 => DELDRIFT_INVALID_DIMENSION,
                _ if is_value && self.has_staged() => DELDRIFT_STAGED_VERTEX,
                _ => wanted,
            };
            self.expect(wanted, || c!(deldrift_refine(t, &quality, null(), 0, &mut report)));
            self.expect(wanted, || c!(deldrift_coarsen(t, &quality, null(), 0, &mut report)));
        }
        let (mut count, none) = (77, null_mut::<u32>());
        if self.m.d == 3 {
            let wanted = DELDRIFT_INVALID_DIMENSION;
            self.expect(wanted, || c!(deldrift_made_vertices(t, none, none, 0, &mut count)));
            self.expect(wanted, || c!(deldrift_original_segments(t, none, 0, &mut count)));
            self.expect(wanted, || c!(deldrift_refined_weights(t, none, null_mut(), 0, &mut count)));
            self.expect(wanted, || c!(deldrift_refined_sizes(t, null_mut(), 0, &mut count)));
            self.expect(wanted, || c!(deldrift_refined_vertices(t, none, 0, &mut count)));
        }
        assert_eq!((report.inserted, count), (77, 77), "an output of a call that failed");
    }
}
