//! Cells that are in another slot than before, found by their corners.
//!
//! Few are found by a hash table. Many are listed by their lowest corner: cells with the same lowest corner are close
//! together in memory, before and after, while the entries of a hash table are scattered, and each is a cache miss.

use crate::complex::Corners;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::machine::prefetch::{AHEAD, prefetch};

/// From this number on, lost cells are listed by their lowest corner.
const MIN_CELLS_LISTED: usize = 1 << 12;

/// Lost cells are not listed by their lowest corner if ids are more than this many times as many.
const MAX_IDS_PER_CELL: usize = 8;

/// Lost cells are not listed by their lowest corner if more than this number have the same one: a search goes through
/// all of these.
const MAX_CELLS_PER_CORNER: u32 = 256;

/// Cache lines that are asked for in advance of the cells of a lowest corner.
const LINES: usize = 4;

/// In a place of the table: no entry.
const NO_ENTRY: u32 = u32::MAX;

/// A lost cell.
#[derive(Clone, Copy, Debug)]
struct LostCell<C> {
    /// A hash of the corners.
    mark: u32,
    index: CellId,
    corners: C,
}

/// Memory to find cells in.
#[derive(Debug)]
pub(in crate::motion) struct Matcher<C> {
    entries: Vec<LostCell<C>>,
    /// Positions of entries by a hash of the corners, if these are few.
    table: Vec<u32>,
    /// Where the entries of each lowest corner end, if these are many.
    ends: Vec<u32>,
}

impl<C> Default for Matcher<C> {
    fn default() -> Self {
        Matcher { entries: Vec::new(), table: Vec::new(), ends: Vec::new() }
    }
}

/// Whether two cells have the same corners, in any order.
#[inline(always)]
pub(in crate::motion) fn are_same<C: Corners<VertexId>>(a: &C, b: &C) -> bool {
    a == b || a.as_ref().iter().all(|x| b.as_ref().contains(x))
}

/// A hash that does not depend on the order of the corners.
#[inline(always)]
fn hash<C: Corners<VertexId>>(corners: &C) -> u32 {
    let mixed = |x: &VertexId| {
        let x = (u64::from(x.get()) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        (x ^ x >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9)
    };
    (corners.as_ref().iter().map(mixed).fold(0, u64::wrapping_add) >> 7) as u32
}

fn lowest<C: Corners<VertexId>>(corners: &C) -> usize {
    corners.as_ref().iter().fold(VertexId::NONE, |least, &v| least.min(v)).index()
}

/// The rows of indices, each asked for in advance.
fn ahead<'c, C>(corners: &'c [C], indices: &'c [CellId]) -> impl Iterator<Item = (CellId, &'c C)> {
    indices.iter().enumerate().map(|(k, &index)| {
        if let Some(&next) = indices.get(k + AHEAD) {
            prefetch(corners, next.index());
        }
        (index, &corners[index])
    })
}

impl<C: Corners<VertexId>> Matcher<C> {
    /// Gets ready to find lost cells, of which there are the indices among all `corners`.
    pub(in crate::motion) fn list(&mut self, corners: &[C], lost: &[CellId]) -> Result<()> {
        self.entries.clear();
        memory::reserve(&mut self.entries, lost.len())?;
        self.ends.clear();
        if lost.len() >= MIN_CELLS_LISTED {
            let n_ids = ahead(corners, lost).map(|(_, row)| lowest(row)).fold(0, usize::max) + 1;
            if n_ids <= MAX_IDS_PER_CELL * lost.len() && self.list_by_lowest(corners, lost, n_ids)? {
                return Ok(());
            }
            self.ends.clear();
        }
        let table = &mut self.table;
        let n = (2 * lost.len()).next_power_of_two();
        table.clear();
        memory::reserve(table, n)?;
        table.resize(n, NO_ENTRY);
        for ((index, &corners), k) in ahead(corners, lost).zip(0..) {
            let mark = hash(&corners);
            self.entries.push(LostCell { mark, index, corners });
            let mut place = mark as usize & (n - 1);
            while table[place] != NO_ENTRY {
                place = (place + 1) & (n - 1);
            }
            table[place] = k;
        }
        Ok(())
    }

    /// Lists the cells unless a list would be too long.
    fn list_by_lowest(&mut self, corners: &[C], lost: &[CellId], n_ids: usize) -> Result<bool> {
        let Matcher { ends, entries, .. } = self;
        memory::reserve(ends, n_ids + 1)?;
        ends.resize(n_ids + 1, 0);
        for (_, row) in ahead(corners, lost) {
            ends[lowest(row) + 1] += 1;
        }
        if ends.iter().any(|&n| n > MAX_CELLS_PER_CORNER) {
            return Ok(false);
        }
        for v in 0..n_ids {
            ends[v + 1] += ends[v];
        }
        entries.resize(
            lost.len(),
            LostCell { mark: 0, index: CellId::NONE, corners: C::filled(VertexId::NONE) },
        );
        // Each is where the entries begin, until these have been made.
        for (index, &corners) in ahead(corners, lost) {
            let end = &mut ends[lowest(&corners)];
            entries[*end as usize] = LostCell { mark: hash(&corners), index, corners };
            *end += 1;
        }
        Ok(true)
    }

    /// Asks for what [`prefetch_entries`](Self::prefetch_entries) is going to need.
    #[inline(always)]
    pub(in crate::motion) fn prefetch_place(&self, ids: &C) {
        if self.ends.is_empty() {
            prefetch(&self.table, hash(ids) as usize & (self.table.len() - 1));
        } else {
            prefetch(&self.ends, lowest(ids));
        }
    }

    /// Asks for what [`find`](Self::find) is going to need.
    #[inline(always)]
    pub(in crate::motion) fn prefetch_entries(&self, ids: &C) {
        if self.ends.is_empty() {
            prefetch(&self.entries, self.table[hash(ids) as usize & (self.table.len() - 1)] as usize);
        } else {
            let begin = self.ends.get(lowest(ids).wrapping_sub(1)).map_or(0, |&end| end as usize);
            (0..LINES).for_each(|k| prefetch(&self.entries, begin + k * 64 / size_of::<LostCell<C>>()));
        }
    }

    /// The index of a lost cell with these corners, and how they were listed.
    #[inline(always)]
    pub(in crate::motion) fn find(&self, ids: &C) -> Option<(CellId, C)> {
        let mark = hash(ids);
        let is_it = |entry: &&LostCell<C>| entry.mark == mark && are_same(&entry.corners, ids);
        let entry = if self.ends.is_empty() {
            let last = self.table.len() - 1;
            let places = (mark as usize..).map(|place| self.table[place & last]);
            places.take_while(|&k| k != NO_ENTRY).map(|k| &self.entries[k as usize]).find(is_it)
        } else {
            let v = lowest(ids);
            let end = *self.ends.get(v)? as usize;
            let begin = if v == 0 { 0 } else { self.ends[v - 1] as usize };
            self.entries[begin..end].iter().find(is_it)
        };
        entry.map(|entry| (entry.index, entry.corners))
    }

    /// For how many lost cells there is room.
    pub(in crate::motion) fn capacity(&self) -> usize {
        self.entries.capacity()
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        (self.table.capacity() + self.ends.capacity()) * 4
            + self.entries.capacity() * size_of::<LostCell<C>>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The k-th of many cells with different corners, in an order of its own.
    fn cell(k: u32, n_ids: u32) -> [VertexId; 4] {
        let v = k % (n_ids - 3);
        let mut corners = [v, v + 1, v + 2, v + 3 + k / (n_ids - 3)].map(VertexId::new);
        corners.rotate_left(k as usize % 4);
        corners
    }

    fn cells_are_found(n: u32, n_ids: u32) {
        let corners: Vec<_> = (0..n).map(|k| cell(k, n_ids)).collect();
        // One in three is not lost.
        let lost: Vec<CellId> = (0..n).filter(|k| k % 3 != 0).rev().map(CellId::new).collect();
        let mut matcher = Matcher::default();
        matcher.list(&corners, &lost).expect("room");
        for (index, row) in (0..).zip(&corners) {
            let mut ids = *row;
            ids.rotate_left(index as usize % 3);
            ids.swap(0, 2);
            matcher.prefetch_place(&ids);
            matcher.prefetch_entries(&ids);
            assert_eq!(
                matcher.find(&ids),
                (index % 3 != 0).then_some((CellId::new(index), *row)),
                "{n} cells"
            );
        }
        assert_eq!(matcher.find(&[0, 1, 2, 3].map(|k| VertexId::new(n_ids + n + k))), None);
    }

    #[test]
    fn lost_cells_are_found_by_their_corners() {
        for n in [1, 2, 30, 1_000, 20_000] {
            cells_are_found(n, 100);
            cells_are_found(n, 5_000);
            cells_are_found(n, 1_000_000);
        }
        let mut matcher = Matcher::default();
        matcher.list(&[], &[]).expect("room");
        assert_eq!(matcher.find(&[0, 1, 2, 3].map(VertexId::new)), None);
    }

    /// Cells around one vertex are not searched one after the other.
    #[test]
    fn cells_of_a_hub_are_found_by_a_hash() {
        let corners: Vec<_> = (0..20_000).map(|k| [0, k + 1, k + 2].map(VertexId::new)).collect();
        let lost: Vec<CellId> = CellId::range(0..20_000).collect();
        let mut matcher = Matcher::default();
        matcher.list(&corners, &lost).expect("room");
        assert!(matcher.ends.is_empty());
        assert!(
            (0..).zip(&corners).all(|(index, row)| matcher.find(row) == Some((CellId::new(index), *row)))
        );
    }
}
