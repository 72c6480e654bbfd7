//! Transfer of means in cells: sums and constants stay, and no mean is beyond all others where nothing turns over.

use super::super::allocator::Fault;
use super::super::tally;
use super::called::{c, note};
use super::types::{NONE, Place, Row};
use super::{History, flattened};
use deldrift::capi::deldrift_status::*;
use deldrift::capi::*;
use std::ptr::null;

/// A mean that all cells have.
const CONSTANT: f64 = 0.1;

impl History<'_> {
    /// Brings means of the cells that were over to those of now, just after the changes have been taken.
    pub(super) fn transfer(&mut self, before: &[Row], removed: &[Row]) {
        let (t, d, order) = (self.t, self.m.d, self.s.below(2) as u32);
        let (now, _) = self.cells();
        // Where vertices are that are gone, the program knows, or it says something.
        let somewhere = self.place();
        let places: Vec<Place> = self.m.positions.iter().map(|p| p.unwrap_or(somewhere)).collect();
        let is_left_out = self.s.below(3) == 0;
        let numbers = flattened(&places, d);
        let (positions, n) = if is_left_out { (null(), 0) } else { (numbers.as_ptr(), places.len()) };
        let corners = || removed.iter().flat_map(|row| &row[..=d]);
        // The first one that is not present: its id may have been given anew since the time of the cells.
        let is_absent = |v: u32| v == NONE || is_left_out && self.m.at(v).is_none();
        let wanted = match corners().find(|&&v| is_absent(v)) {
            Some(&NONE) => DELDRIFT_CHANGES_NOT_TAKEN,
            Some(_) => DELDRIFT_REMOVED_VERTEX,
            None => DELDRIFT_OK,
        };
        let room = before.len().max(now.len());
        let seed = f64::from(self.s.byte());
        let varied = |k: usize| (k as f64 * 0.618 + seed / 7.0).fract() * 8.0 - 4.0;
        let of_old: Vec<[f64; 2]> = (0..before.len()).map(|k| [CONSTANT, varied(k)]).collect();
        let mut values = of_old.clone();
        values.resize(room + 1, [77.0; 2]);
        let (mut report, mut lost, mut gained) = (deldrift_transfer_report::default(), [77.0; 2], [77.0; 2]);
        let (to, told, at) = (values.as_mut_ptr().cast::<f64>(), lost.as_mut_ptr(), gained.as_mut_ptr());
        let count = before.len();
        if self.with.is_none() {
            match self.s.below(4) {
                0 => self.fault = Some(Fault { first: self.s.below(40), goes_on: self.s.below(2) == 0 }),
                1 => self.cancel_after = Some(self.s.below(4) as u32),
                _ => {}
            }
        }
        self.expect(wanted, || {
            c!(deldrift_transfer_cells(t, positions, n, order, to, count, 2, room, &mut report, told, at))
        });
        (self.fault, self.cancel_after) = (None, None);
        if wanted != DELDRIFT_OK {
            assert!(values[..count] == of_old && lost == [77.0; 2], "outputs of a call that failed");
            return;
        }
        tally::TRANSFERS.add(1);
        assert!(values[now.len().max(count)..].iter().all(|row| *row == [77.0; 2]), "beyond the cells");
        assert!(report.gone >= removed.len() as u64, "{report:?}");
        let values = &values[..now.len()];
        // Where no cell of now has any of those that were, and none of them lives, there is no neighbour to ask.
        let is_nothing_known =
            values.iter().all(|row| *row == [0.0; 2]) && report.uncovered == now.len() as u64;
        assert!(is_nothing_known || values.iter().all(|row| row[0] == CONSTANT), "a constant: {values:?}");
        if report.turned_over == 0 {
            assert!(values.iter().all(|row| row[1].abs() <= 4.0), "a new extreme: {values:?}");
        }
        if places.iter().all(is_moderate) {
            self.check_sums([before, &now], [&of_old, values], &places, [lost, gained]);
        }
    }

    /// What there is, is what there was, less what is lost and with what is gained.
    fn check_sums(
        &self,
        rows: [&[Row]; 2],
        values: [&[[f64; 2]]; 2],
        places: &[Place],
        [lost, gained]: [[f64; 2]; 2],
    ) {
        // A cell that lives has the same corners in both, but its volume is rounded for each order of them.
        let mut error = 0.0;
        let mut sums = [[0.0; 2]; 2];
        for ((rows, values), sums) in rows.iter().zip(values).zip(&mut sums) {
            for (row, value) in rows.iter().zip(values) {
                let (volume, bound) = volume(row, places, self.m.d);
                error += 1e-9 * bound;
                (0..2).for_each(|c| sums[c] += volume * value[c]);
            }
        }
        for c in 0..2 {
            let (was, is) = (sums[0][c] - lost[c] + gained[c], sums[1][c]);
            assert!((was - is).abs() <= error, "component {c}: {was} before, {is} after, within {error}");
        }
    }
}

/// Whether cubes of coordinates are far from the ends of the range.
fn is_moderate(p: &Place) -> bool {
    p.iter().all(|&x| x == 0.0 || (1e-20..1e20).contains(&x.abs()))
}

/// The area or volume of a cell, with its sign, and a number of which its rounding is a small part.
fn volume(row: &Row, places: &[Place], d: usize) -> (f64, f64) {
    let base = places[row[0] as usize];
    let edge = |i: usize| -> Place { std::array::from_fn(|k| places[row[i] as usize][k] - base[k]) };
    let (a, b) = (edge(1), edge(2));
    let length = |e: &Place| e.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    if d == 2 {
        return ((a[0] * b[1] - a[1] * b[0]) / 2.0, length(&a) * length(&b));
    }
    let c = edge(3);
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let sum: f64 = (0..3).map(|k| cross[k] * c[k]).sum();
    (sum / 6.0, length(&a) * length(&b) * length(&c))
}
