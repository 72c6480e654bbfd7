//! Copies beside the original: the same history goes on with the original, with clones, and with what has been saved and loaded,
//! and must be the same one.

use super::called::{c, note};
use super::types::{Row, sorted};
use super::{Carried, History, live};
use std::ptr::null_mut;

/// What goes on where there is a copy. The original has been read as the copies are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum With {
    Original,
    Clones,
    Loaded,
}

/// What can be seen after a step, whatever the indices of cells and the counts of what algorithms have done.
#[derive(Debug, PartialEq, Eq)]
pub struct Seen {
    n_bytes: usize,
    cells: Vec<Row>,
    n_ids: usize,
    n_staged: usize,
}

/// Compares the histories step by step.
pub fn compare(data: &[u8]) {
    let original = live(data, Some(With::Original));
    for with in [With::Clones, With::Loaded] {
        let other = live(data, Some(with));
        assert_eq!(original.len(), other.len());
        let different = original.iter().zip(&other).position(|(one, other)| one != other);
        assert_eq!(different, None, "{with:?} go on in another way at this step");
    }
}

impl History<'_> {
    /// Goes on with the original or a copy.
    pub(super) fn go_on_with(&mut self, with: With) {
        let (t, data) = (self.t, self.saved());
        let (mut other, options) = (null_mut(), self.options);
        match with {
            With::Original => return self.check(),
            With::Clones => self.ok(|| c!(deldrift_clone(t, &mut other))),
            With::Loaded => {
                let (start, size) = (data.as_ptr().cast(), data.len());
                self.ok(|| c!(deldrift_load(start, size, &options, &mut other)));
                self.is_ok(self.chosen.choose(other));
                self.carried = Carried::default();
            }
        }
        self.t = other;
        self.end_other(t);
        assert_eq!(self.saved(), data, "a copy has other bytes");
        self.check();
    }

    /// Notes what can be seen after a step, if histories are compared.
    pub(super) fn note_seen(&mut self) {
        if self.with.is_none() {
            return;
        }
        let n_bytes = self.saved().len();
        let (rows, _) = self.cells();
        let mut cells: Vec<Row> = rows.iter().map(|&row| sorted(row)).collect();
        cells.sort_unstable();
        let [mut n_ids, mut n_staged] = [0; 2];
        self.is_ok(c!(deldrift_id_count(self.t, &mut n_ids)));
        self.is_ok(c!(deldrift_staged_count(self.t, &mut n_staged)));
        self.seen.push(Seen { n_bytes, cells, n_ids, n_staged });
    }
}
