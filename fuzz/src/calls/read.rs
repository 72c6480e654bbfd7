//! Calls that read, compared with what follows from the cells.

use super::super::exact_oracle::{Tally, exact_distance_order, exact_sign};
use super::called::{c, note};
use super::types::{NONE, Place, Row};
use super::{History, flattened, message};
use deldrift::capi::deldrift_location_kind::*;
use deldrift::capi::deldrift_status::*;
use deldrift::capi::*;
use std::array::from_fn;
use std::cmp::Ordering::{Greater, Less};
use std::ffi::CStr;
use std::ptr::{null, null_mut};

impl History<'_> {
    pub(super) fn read(&mut self) {
        match self.s.below(12) {
            0 => self.copy_cells(),
            1 => self.star(),
            2 => self.tolerance(),
            3 => self.annulus_widths(),
            4 => self.standard_delimiter(),
            5 => self.locate(),
            6 => self.locate_points(),
            7 => self.nearest(),
            8 | 9 => self.position(),
            10 => self.strings(),
            _ => {
                let (t, level) = (self.t, 1 + self.s.below(3) as u32);
                self.ok(|| c!(deldrift_validate(t, level)));
            }
        }
    }

    fn copy_cells(&mut self) {
        let t = self.t;
        let corners = self.m.d + 1;
        let vertices = self
            .copied(77, corners, |to, room, count| c!(deldrift_copy_cells(t, to, null_mut(), room, count)));
        let across = self
            .copied(77, corners, |to, room, count| c!(deldrift_copy_cells(t, null_mut(), to, room, count)));
        let found = [vertices, across].map(|numbers| super::asking::rows(&numbers, corners));
        assert_eq!(found, <[_; 2]>::from(self.cells()), "copies of cells");
    }

    /// A vertex, the one of lowest id at its place, and the cells around that.
    pub(super) fn some_star(&mut self) -> Option<(u32, u32, Vec<u32>, Vec<Row>)> {
        let v = self.some()?;
        let representative = self.m.first_at(&self.m.at(v)?)?;
        let (rows, _) = self.cells();
        let star =
            (0..).zip(&rows).filter(|(_, row)| row.contains(&representative)).map(|(cell, _)| cell).collect();
        Some((v, representative, star, rows))
    }

    fn star(&mut self) {
        let t = self.t;
        let Some((v, _, wanted, _)) = self.some_star() else { return };
        let mut found = self.copied(77, 1, |to, room, count| c!(deldrift_star(t, v, to, room, count)));
        found.sort_unstable();
        assert_eq!(found, wanted, "star of {v}");
    }

    fn tolerance(&mut self) {
        let t = self.t;
        let Some((v, representative, star, _)) = self.some_star() else { return };
        let mut found = -1.0;
        self.ok(|| c!(deldrift_tolerance(t, v, &mut found)));
        let is_shared =
            v != representative || self.m.positions.iter().filter(|p| **p == self.m.at(v)).count() > 1;
        let wanted = if is_shared {
            found == 0.0
        } else if self.wanted_cells().is_empty() {
            found == f64::INFINITY
        } else {
            !star.is_empty() && found >= 0.0
        };
        assert!(wanted, "tolerance of {v}: {found}");
    }

    fn annulus_widths(&mut self) {
        let t = self.t;
        let found =
            self.copied(-1.0, 1, |to, room, count| c!(deldrift_research_annulus_widths(t, to, room, count)));
        let (_, neighbours) = self.cells();
        let corners = self.m.d + 1;
        assert_eq!(found.len(), corners * neighbours.len());
        for (k, width) in found.iter().enumerate() {
            let is_hull = neighbours[k / corners][k % corners] == NONE;
            assert!(if is_hull { width.is_nan() } else { *width >= 0.0 }, "width {k}: {width}");
        }
    }

    fn standard_delimiter(&mut self) {
        let (t, corners) = (self.t, self.m.d + 1);
        let (rows, neighbours) = self.cells();
        let (cell, corner) = (self.s.below(rows.len() + 1), self.s.below(corners + 1));
        let is_there = cell < rows.len() && corner < corners;
        let is_hull = is_there && neighbours[cell][corner] == NONE;
        let wanted = if is_there { DELDRIFT_OK } else { DELDRIFT_NO_SUCH_FACET };
        let (mut centre, mut radius, mut tolerance) = ([77.0; 3], 77.0, -1.0);
        let (cell, corner) = (cell as u32, corner as u32);
        self.expect(wanted, || {
            c!(deldrift_research_standard_delimiter(
                t,
                cell,
                corner,
                centre.as_mut_ptr(),
                &mut radius,
                &mut tolerance
            ))
        });
        let is_written = tolerance != -1.0;
        assert_eq!(is_written, is_there);
        assert_eq!(is_hull, radius.is_nan() && tolerance.is_nan());
        assert!(!is_there || is_hull || tolerance >= 0.0, "tolerance {tolerance}");
    }

    /// Whether no corner's side of a cell is negative, for a place; and whether a facet of the hull has it beyond.
    fn sides<const D: usize, const N: usize>(&self, row: &Row, across: &Row, q: &Place) -> (bool, bool) {
        let short = |p: &Place| -> [f64; D] { from_fn(|k| p[k]) };
        let corners: [[f64; D]; N] = from_fn(|i| short(&self.m.at(row[i]).expect("present")));
        let (mut holds, mut faces) = (true, false);
        for (i, &beyond) in across[..N].iter().enumerate() {
            let seen: [[f64; D]; N] = from_fn(|k| if k == i { short(q) } else { corners[k] });
            let is_beyond = exact_sign(&seen, &mut Tally::default()) == Less;
            holds &= !is_beyond;
            faces |= is_beyond && beyond == NONE;
        }
        (holds, faces)
    }

    pub(super) fn check_location(&self, q: &Place, found: deldrift_location) {
        let (rows, neighbours) = self.cells();
        let sides = |cell: usize| {
            let (row, across) = (&rows[cell], &neighbours[cell]);
            if self.m.d == 2 {
                self.sides::<2, 3>(row, across, q)
            } else {
                self.sides::<3, 4>(row, across, q)
            }
        };
        let at = self.m.first_at(q);
        let index = found.index as usize;
        let is_right = match found.kind {
            DELDRIFT_LOCATION_VERTEX => at == Some(found.index),
            DELDRIFT_LOCATION_NO_CELLS => at.is_none() && rows.is_empty() && found.index == NONE,
            DELDRIFT_LOCATION_CELL => at.is_none() && sides(index).0,
            DELDRIFT_LOCATION_OUTSIDE => {
                at.is_none() && sides(index).1 && !(0..rows.len()).any(|cell| sides(cell).0)
            }
        };
        assert!(is_right, "{q:?} is not at {found:?}; vertex {at:?}");
    }

    fn locate(&mut self) {
        let (t, q) = (self.t, self.place());
        let mut found = deldrift_location { kind: DELDRIFT_LOCATION_NO_CELLS, index: 77 };
        self.ok(|| c!(deldrift_locate(t, q.as_ptr(), &mut found)));
        self.check_location(&q, found);
    }

    fn locate_points(&mut self) {
        let (t, count) = (self.t, self.s.below(5));
        let places: Vec<Place> = (0..count).map(|_| self.place()).collect();
        let numbers = flattened(&places, self.m.d);
        let near = deldrift_location {
            kind: self.s.pick(&[DELDRIFT_LOCATION_VERTEX, DELDRIFT_LOCATION_CELL, DELDRIFT_LOCATION_OUTSIDE]),
            index: u32::from(self.s.byte()),
        };
        let near = if self.s.below(2) == 0 { null() } else { &raw const near };
        let mut found = vec![deldrift_location { kind: DELDRIFT_LOCATION_NO_CELLS, index: 77 }; count];
        self.ok(|| c!(deldrift_locate_points(t, numbers.as_ptr(), count, near, found.as_mut_ptr())));
        places.iter().zip(found).for_each(|(q, found)| self.check_location(q, found));
    }

    fn nearest(&mut self) {
        fn is_nearer<const D: usize>(a: &Place, b: &Place, q: &Place) -> bool {
            let points: [[f64; D]; 3] = [a, b, q].map(|p| from_fn(|k| p[k]));
            exact_distance_order(&points, &mut Tally::default()) == Less
        }
        let (t, q, d) = (self.t, self.place(), self.m.d);
        let mut found = 77;
        self.ok(|| c!(deldrift_nearest_vertex(t, q.as_ptr(), &mut found)));
        let nearer = if d == 2 { is_nearer::<2> } else { is_nearer::<3> };
        let at = |v: u32| self.m.at(v).expect("present");
        let wanted = self.m.present().reduce(|best, v| if nearer(&at(v), &at(best), &q) { v } else { best });
        assert_eq!(found, wanted.unwrap_or(NONE), "nearest to {q:?}");
    }

    fn position(&mut self) {
        let (t, Some(v)) = (self.t, self.some()) else { return };
        let mut found = [0.0; 3];
        self.ok(|| c!(deldrift_position(t, v, found.as_mut_ptr())));
        assert_eq!(Some(found), self.m.at(v));
    }

    /// Texts, and a sign of points of one's own.
    fn strings(&mut self) {
        let text = |start| {
            // SAFETY: a static string of the library's.
            unsafe { CStr::from_ptr(start) }.to_str().expect("UTF-8").to_owned()
        };
        let status = u32::from(self.s.byte());
        assert!(!text(c!(deldrift_status_string(status))).is_empty());
        assert_eq!(text(c!(deldrift_version())).split('.').count(), 3);
        assert!(message().len() < 512);
        let places: [Place; 4] = from_fn(|_| self.place());
        let d = self.m.d;
        let numbers = flattened(&places[..=d], d);
        let mut sign = 77;
        self.ok(|| c!(deldrift_orientation(d as u32, numbers.as_ptr(), &mut sign)));
        let wanted = if d == 2 {
            let p: [[f64; 2]; 3] = from_fn(|i| [places[i][0], places[i][1]]);
            exact_sign(&p, &mut Tally::default())
        } else {
            exact_sign(&places, &mut Tally::default())
        };
        assert_eq!(sign.cmp(&0), wanted, "orientation of {places:?}");
        assert!(sign.abs() <= 1 && (wanted != Greater || sign == 1));
    }
}
