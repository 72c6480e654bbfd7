//! What a triangulation says: its cells, its lists, its bytes.

use super::called::{c, note};
use super::model::Model;
use super::types::{NONE, Place, Row};
use super::{History, message};
use deldrift::capi::deldrift_status::*;
use deldrift::capi::*;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

/// An array of the library's; no pointer is no entries.
pub fn slice<'a, T>(start: *const T, count: usize) -> &'a [T] {
    assert_eq!(start.is_null(), count == 0, "an array without entries has no pointer, any other has one");
    // SAFETY: the library's array, which stays until the triangulation changes.
    if count == 0 { &[] } else { unsafe { std::slice::from_raw_parts(start, count) } }
}

/// Rows of 3 or 4 numbers.
pub fn rows(numbers: &[u32], corners: usize) -> Vec<Row> {
    let row = |row: &[u32]| std::array::from_fn(|k| row.get(k).copied().unwrap_or(NONE));
    numbers.chunks_exact(corners).map(row).collect()
}

/// The cells of a triangulation, and across which facets others are.
pub fn cells_of(t: *const deldrift_triangulation) -> (Vec<Row>, Vec<Row>) {
    let mut view =
        deldrift_cells_view { count: 0, corners_per_cell: 0, vertices: null(), neighbours: null() };
    assert_eq!(c!(deldrift_cells(t, &mut view)), DELDRIFT_OK, "{}", message());
    let corners = view.corners_per_cell as usize;
    let [vertices, neighbours] =
        [view.vertices, view.neighbours].map(|start| rows(slice(start, view.count * corners), corners));
    (vertices, neighbours)
}

impl History<'_> {
    pub(super) fn is_ok(&self, status: deldrift_status) {
        assert_eq!(status, DELDRIFT_OK, "{}", message());
    }

    /// Whether the positions that would come of a commit are refused.
    pub(super) fn is_rejected(&self, positions: &[Option<Place>]) -> bool {
        self.options.coincidence == 1 && Model::has_coincidence(positions)
    }

    pub(super) fn cells(&self) -> (Vec<Row>, Vec<Row>) {
        cells_of(self.t)
    }

    /// Calls for a count, then for so many entries, then with a buffer that is too small.
    pub(super) fn copied<T: Copy + PartialEq>(
        &mut self,
        filler: T,
        per_entry: usize,
        mut call: impl FnMut(*mut T, usize, *mut usize) -> deldrift_status,
    ) -> Vec<T> {
        let (mut n, mut count) = (usize::MAX, usize::MAX);
        self.ok(|| match call(null_mut(), 0, &mut n) {
            DELDRIFT_BUFFER_TOO_SMALL => DELDRIFT_OK,
            status => status,
        });
        let mut values = vec![filler; n * per_entry];
        self.ok(|| call(values.as_mut_ptr(), n, &mut count));
        assert_eq!(count, n, "the count of entries");
        if n > 0 {
            let mut fewer = vec![filler; (n - 1) * per_entry + 1];
            let wanted = DELDRIFT_BUFFER_TOO_SMALL;
            self.expect(wanted, || call(fewer.as_mut_ptr(), n - 1, &mut count));
            assert_eq!(count, n);
        }
        values
    }

    /// The bytes that are saved.
    pub(super) fn saved(&mut self) -> Vec<u8> {
        let (t, mut count) = (self.t, 0);
        self.is_ok(c!(deldrift_save(t, null_mut(), 0, &mut count)));
        let mut data = vec![0u8; count];
        let start = data.as_mut_ptr();
        let room = data.len();
        self.ok(|| c!(deldrift_save(t, start.cast(), room, &mut count)));
        assert_eq!(count, room);
        data
    }

    /// Destroys one whose cells outlive it.
    pub(super) fn end_other(&self, gone: *mut deldrift_triangulation) {
        let (mut view, mut owner) = (MaybeUninit::uninit(), null_mut());
        self.is_ok(c!(deldrift_release_cells(gone, view.as_mut_ptr(), &mut owner)));
        // SAFETY: it has been written.
        let view: deldrift_cells_view = unsafe { view.assume_init() };
        let numbers = || {
            let n = view.count * view.corners_per_cell as usize;
            // SAFETY: the owner keeps them, as many as the view says; there may be none, and no address.
            if n == 0 { &[][..] } else { unsafe { std::slice::from_raw_parts(view.vertices, n) } }
        };
        let before = numbers().to_vec();
        c!(deldrift_destroy(gone));
        assert_eq!(numbers(), before, "cells that have been handed over");
        c!(deldrift_free_cells(owner));
    }
}
