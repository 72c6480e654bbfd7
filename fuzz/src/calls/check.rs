//! What a triangulation says, compared with what it should say.

use super::super::tally;
use super::asking::{cells_of, rows, slice};
use super::called::{c, note};
use super::types::{NONE, Place, Row, sorted};
use super::{Carried, History, flattened, message};
use deldrift::capi::deldrift_status::*;
use deldrift::capi::*;
use std::collections::{BTreeMap, BTreeSet};
use std::ptr::null;

/// The cells of a fresh build of these vertices and segments, each row and all of them in ascending order.
pub fn fresh_cells(positions: &[Option<Place>], segments: &[[u32; 2]], d: usize) -> Vec<Row> {
    let present = positions.iter().enumerate().filter_map(|(v, p)| p.map(|p| (v as u32, p)));
    let (ids, places): (Vec<u32>, Vec<Place>) = present.unzip();
    let numbers = flattened(&places, d);
    let mut t = std::ptr::null_mut();
    let status = c!(deldrift_create(d as u32, numbers.as_ptr(), places.len(), null(), &mut t));
    assert_eq!(status, DELDRIFT_OK, "a fresh build: {}", message());
    if !segments.is_empty() {
        let new = |v: u32| ids.binary_search(&v).expect("an end is present") as u32;
        let ends: Vec<[u32; 2]> = segments.iter().map(|ends| ends.map(new)).collect();
        let (start, n, mut first) = (ends.as_ptr().cast(), ends.len(), 77);
        let status = c!(deldrift_stage_segments(t, start, null(), n, &mut first));
        assert_eq!((status, first), (DELDRIFT_OK, 0), "segments of a fresh build: {}", message());
        let status = c!(deldrift_commit_timestamp(t, std::ptr::null_mut()));
        assert_eq!(status, DELDRIFT_OK, "segments of a fresh build: {}", message());
    }
    let (rows, _) = cells_of(t);
    c!(deldrift_destroy(t));
    let named = |row: &Row| sorted(row.map(|v| if v == NONE { NONE } else { ids[v as usize] }));
    let mut cells: Vec<Row> = rows.iter().map(named).collect();
    cells.sort_unstable();
    cells
}

/// What a caller relies on when reading cells: the neighbour opposite a corner has the other corners, too, and knows
/// its way back, and facets without a neighbour are in no other cell.
pub fn check_adjacency(rows: &[Row], neighbours: &[Row], d: usize) {
    let mut facets: BTreeMap<Row, Vec<usize>> = BTreeMap::new();
    for (cell, row) in rows.iter().enumerate() {
        for i in 0..=d {
            let mut facet = *row;
            facet[i] = NONE;
            facets.entry(sorted(facet)).or_default().push(cell);
        }
    }
    for (cell, (row, across)) in rows.iter().zip(neighbours).enumerate() {
        for i in 0..=d {
            let mut facet = *row;
            facet[i] = NONE;
            let sharing = &facets[&sorted(facet)];
            let wanted: Vec<usize> = sharing.iter().copied().filter(|&other| other != cell).collect();
            let found: Vec<usize> =
                Some(across[i]).filter(|&n| n != NONE).map(|n| n as usize).into_iter().collect();
            assert_eq!(found, wanted, "across facet {i} of cell {cell}, {row:?}");
        }
    }
}

impl History<'_> {
    /// The cells that there should be.
    pub(super) fn wanted_cells(&mut self) -> &[Row] {
        let m = &self.m;
        self.fresh.get_or_insert_with(|| {
            let segments: Vec<[u32; 2]> = m.segments.laid().map(|(_, ends)| ends).collect();
            fresh_cells(&m.positions, &segments, m.d)
        })
    }

    /// Compares all that there is.
    pub(super) fn check(&mut self) {
        tally::COMPARISONS.add(1);
        self.check_numbers();
        self.check_vertices();
        self.check_segments();
        let (rows, neighbours) = self.cells();
        let mut found: Vec<Row> = rows.iter().map(|&row| sorted(row)).collect();
        found.sort_unstable();
        let wanted = self.wanted_cells();
        if found != wanted {
            let [found, wanted]: [BTreeSet<&Row>; 2] = [found.iter().collect(), wanted.iter().collect()];
            let extra: Vec<_> = found.difference(&wanted).take(4).collect();
            let missing: Vec<_> = wanted.difference(&found).take(4).collect();
            panic!("{} cells, not {}; wrongly {extra:?}, missing {missing:?}", rows.len(), wanted.len());
        }
        let mut count = 0;
        self.is_ok(c!(deldrift_cell_count(self.t, &mut count)));
        assert_eq!(count, rows.len());
        check_adjacency(&rows, &neighbours, self.m.d);
        self.is_ok(c!(deldrift_validate(self.t, 3)));
    }

    fn check_numbers(&mut self) {
        let (t, m) = (self.t, &self.m);
        let (mut dimension, mut algorithm, mut timestamp) = (0, 77, u64::MAX);
        let [mut ids, mut vertices, mut staged, mut bytes] = [usize::MAX; 4];
        self.is_ok(c!(deldrift_dimension(t, &mut dimension)));
        self.is_ok(c!(deldrift_get_algorithm(t, &mut algorithm)));
        self.is_ok(c!(deldrift_id_count(t, &mut ids)));
        self.is_ok(c!(deldrift_vertex_count(t, &mut vertices)));
        self.is_ok(c!(deldrift_staged_count(t, &mut staged)));
        self.is_ok(c!(deldrift_timestamp(t, &mut timestamp)));
        self.is_ok(c!(deldrift_memory_bytes(t, &mut bytes)));
        assert_eq!((dimension as usize, algorithm), (m.d, self.chosen.algorithm));
        assert_eq!(
            (ids, vertices, staged),
            (m.positions.len(), m.present().count(), m.staged.len()),
            "counts"
        );
        assert_eq!(timestamp, m.timestamp);
        assert!(bytes > 8 * m.d * vertices, "{bytes} bytes for {vertices} vertices");
        let mut report = deldrift_commit_report::default();
        self.is_ok(c!(deldrift_statistics(t, &mut report)));
        assert_eq!(
            (report.timestamp, report.coincident),
            (m.timestamp, m.hidden().len() as u64),
            "statistics"
        );
        let mut within = u64::MAX;
        self.is_ok(c!(deldrift_research_within_safe_region(t, &mut within)));
        let tests_regions = matches!(self.chosen.algorithm, 17 | 18);
        let is_right = if tests_regions { within >= self.within } else { within == self.within };
        assert!(is_right, "{within} within their safe region, {} before", self.within);
        self.within = within;
    }

    fn check_vertices(&self) {
        let (t, m) = (self.t, &self.m);
        let n = m.positions.len();
        let mut numbers = vec![77.0; n * m.d];
        let mut count = 0;
        self.is_ok(c!(deldrift_copy_positions(t, numbers.as_mut_ptr(), n, &mut count)));
        assert_eq!(count, n);
        let mut keys = vec![77; n];
        self.is_ok(c!(deldrift_keys(t, keys.as_mut_ptr(), n, &mut count)));
        let known: Vec<u32> = (0..n as u32).filter(|&v| m.at(v).is_some() || m.is_coming(v)).collect();
        let key_of = |v: u32| keys[v as usize];
        match self.next_key {
            Some(next) => assert!(
                known.windows(2).all(|w| key_of(w[0]) < key_of(w[1])) && keys.iter().all(|&key| key < next)
            ),
            None => assert!(known.iter().all(|&v| key_of(v) == u64::from(v)), "keys: {keys:?}"),
        }
        let representatives = m.representatives();
        for v in 0..n as u32 + 1 {
            let wanted = m.at(v);
            let (mut present, mut representative) = (true, 77);
            self.is_ok(c!(deldrift_is_present(t, v, &mut present)));
            assert_eq!(present, wanted.is_some(), "vertex {v} is present");
            let absent = match m.goal(v) {
                Some(_) => DELDRIFT_STAGED_VERTEX,
                None if v as usize == n => DELDRIFT_NO_SUCH_VERTEX,
                None => DELDRIFT_REMOVED_VERTEX,
            };
            let status = c!(deldrift_coincident_representative(t, v, &mut representative));
            let Some(p) = wanted else {
                assert_eq!((status, representative), (absent, 77), "vertex {v}");
                let goal = m.goal(v).unwrap_or([f64::NAN; 3]);
                let is_there = |(x, y): (&f64, &f64)| x.to_bits() == y.to_bits() || x.is_nan() && y.is_nan();
                assert!(
                    v as usize == n || numbers[v as usize * m.d..][..m.d].iter().zip(&goal).all(is_there)
                );
                continue;
            };
            assert_eq!((status, representative), (DELDRIFT_OK, representatives[v as usize]), "vertex {v}");
            let found = &numbers[v as usize * m.d..][..m.d];
            assert!(
                found.iter().zip(p).all(|(x, y)| x.to_bits() == y.to_bits()),
                "vertex {v}: {found:?}, not {p:?}"
            );
        }
    }

    /// Takes the changes, and follows them with what was there.
    pub(super) fn take_changes(&mut self) {
        let mut changes = std::mem::MaybeUninit::<deldrift_changes>::zeroed();
        let t = self.t;
        self.ok(|| c!(deldrift_take_changes(t, changes.as_mut_ptr())));
        // SAFETY: the call has succeeded; zeroes would do, too.
        let list = unsafe { changes.assume_init() };
        let before = self.carried.rows.clone();
        self.follow(&list);
        if self.s.below(2) == 0 {
            let corners = self.m.d + 1;
            let removed = rows(slice(list.removed_vertices, list.removed_count * corners), corners);
            self.transfer(&before, &removed);
        }
        // SAFETY: as above.
        let again = unsafe {
            self.is_ok(c!(deldrift_take_changes(t, changes.as_mut_ptr())));
            changes.assume_init()
        };
        let counts = [again.created_count, again.removed_count, again.renumbered_count, again.star_count];
        assert_eq!(
            (counts, again.hidden_count, again.shown_count),
            ([0; 4], 0, 0),
            "changes are taken twice"
        );
        self.check();
    }

    fn follow(&mut self, list: &deldrift_changes) {
        let d = self.m.d;
        let created = slice(list.created, list.created_count);
        let removed = slice(list.removed, list.removed_count);
        let removed_rows = rows(slice(list.removed_vertices, list.removed_count * (d + 1)), d + 1);
        let from = slice(list.renumbered_from, list.renumbered_count);
        let to = slice(list.renumbered_to, list.renumbered_count);
        let [stars, hidden, shown] =
            [(list.stars, list.star_count), (list.hidden, list.hidden_count), (list.shown, list.shown_count)]
                .map(|(start, count)| slice(start, count));
        let (now, _) = self.cells();
        let mut cells: Vec<Option<Row>> = self.carried.rows.iter().copied().map(Some).collect();
        let mut touched = BTreeSet::new();
        let mut gone = BTreeSet::new();
        for (&cell, row) in removed.iter().zip(&removed_rows) {
            assert_eq!(cells[cell as usize].take().as_ref(), Some(row), "removed cell {cell}");
            gone.insert(sorted(*row));
            touched.extend(row[..=d].iter().copied());
        }
        let moving: Vec<(Option<Row>, u32)> =
            from.iter().zip(to).map(|(&from, &to)| (cells[from as usize].take(), to)).collect();
        cells.resize(cells.len().max(now.len()), None);
        for (row, to) in moving {
            assert!(row.is_some() && cells[to as usize].is_none(), "renumbered to {to}");
            cells[to as usize] = row;
        }
        for &cell in created {
            let row = now[cell as usize];
            assert!(cells[cell as usize].replace(row).is_none(), "created cell {cell} was there");
            assert!(!gone.contains(&sorted(row)), "{row:?} is removed and created");
            touched.extend(row[..=d].iter().copied());
        }
        assert!(created.is_sorted_by(|a, b| a < b) && cells[now.len()..].iter().all(Option::is_none));
        for (cell, row) in now.iter().enumerate() {
            assert_eq!(cells[cell].map(sorted), Some(sorted(*row)), "cell {cell}, carried along");
        }
        touched.remove(&NONE);
        let stars: Vec<u32> = stars.iter().copied().filter(|&v| v != NONE).collect();
        assert!(touched.iter().eq(&stars), "stars {stars:?}, not {touched:?}");
        let all = self.m.hidden();
        assert!(all.difference(&self.carried.hidden).eq(hidden), "hidden {hidden:?}: now {all:?}");
        let wanted = self.carried.hidden.difference(&all).filter(|&&v| self.m.at(v).is_some());
        assert!(wanted.eq(shown), "shown {shown:?}");
        self.carried = Carried { rows: now, hidden: all };
    }
}
