//! Cells in an order, and with corners in an order, that are functions of the cells alone.
//!
//! A cell has its lowest corner first, and in space the next one second: the others follow from its orientation. Ghosts
//! keep the ghost vertex last. Cells are in the order of their lowest corners, then of the next two; ghosts come first, as
//! the ghost vertex is the lowest of all. No two cells have the same ones, as a side has one cell on its inner side.

use super::free::FreeSlots;
use super::sorting::gaps;
use super::{Cell, Complex, Corners, Facet, INFINITE, MAX_CELLS};
use crate::error::{Error, Result};
use crate::ids::{SiteId, Slot};
use crate::machine::aligned::Aligned;
use crate::machine::memory;

/// Where the corners of a cell go: two bits for each, by where they have been.
type Places = u8;

/// The place of corner `i`.
#[inline(always)]
fn place(places: Places, i: usize) -> usize {
    usize::from(places >> (2 * i) & 3)
}

/// Where the corners of a cell with these names go.
#[inline(always)]
fn places_of<C: Corners>(names: &C) -> Places {
    // The names from the lowest on, of those that may move.
    let n = if names[C::N - 1] == INFINITE { C::N - 1 } else { C::N };
    let mut order = [0, 1, 2, 3];
    let lowest_from = |order: &[usize; 4], from: usize| {
        (from..n).min_by_key(|&k| names[order[k]]).expect("there are corners left")
    };
    let first = lowest_from(&order, 0);
    if n == C::N && C::N == 4 {
        // Two exchanges keep the orientation; then the last three are turned.
        if first > 0 {
            order.swap(0, first);
            let (other, another) = match first {
                1 => (2, 3),
                2 => (1, 3),
                _ => (1, 2),
            };
            order.swap(other, another);
        }
        match lowest_from(&order, 1) {
            1 => {}
            2 => order[1..].rotate_left(1),
            _ => order[1..].rotate_left(2),
        }
    } else if n == 3 {
        order[..3].rotate_left(first);
    }
    (0..C::N).fold(0, |places, to| places | (to as Places) << (2 * order[to]))
}

impl<C: Corners> Complex<C> {
    /// Puts cells, and the corners of each, in the order that is a function of the cells, by the names of the sites, which
    /// are all below `n_sites`; and a free one after every `gap_after` of them.
    pub(crate) fn put_in_order(
        &mut self,
        n_sites: usize,
        gap_after: usize,
        name: impl Fn(SiteId) -> SiteId,
    ) -> Result<()> {
        debug_assert!(!self.is_recording(), "rows are named by slot");
        let n_live = self.cells.len() - self.free.len();
        let n_slots = n_live + n_live / gap_after;
        if n_slots > MAX_CELLS {
            return Err(Error::TooManyCells { limit: MAX_CELLS });
        }
        let lowest = |cell: &Cell<C>| {
            cell.corners.as_ref().iter().map(|&s| name(s)).fold(SiteId::NONE, SiteId::min).index()
        };
        let (mut starts, mut ranked, mut index) = (Vec::new(), Vec::new(), Vec::new());
        let (mut places, mut sorted) = (Vec::new(), Aligned::new());
        memory::lengthen(&mut starts, n_sites + 1, 0u32)?;
        memory::lengthen(&mut ranked, n_live, (0u64, Slot::NONE))?;
        memory::lengthen(&mut index, self.cells.len(), Slot::NONE)?;
        memory::lengthen(&mut places, self.cells.len(), 0)?;
        sorted.reserve_exact(n_slots + n_live / 64)?;
        let mut free = FreeSlots::default();
        let (mut marks, capacity) = (Vec::new(), sorted.capacity());
        free.cover(capacity)?;
        memory::reserve_exact(&mut marks, capacity)?;
        for cell in self.cells.iter().filter(|cell| !cell.is_free()) {
            starts[lowest(cell) + 1] += 1;
        }
        for s in 0..n_sites {
            starts[s + 1] += starts[s];
        }
        for (c, cell) in self.cells.iter().enumerate().filter(|(_, cell)| !cell.is_free()) {
            let mut names = cell.corners;
            names.as_mut().iter_mut().for_each(|s| *s = name(*s));
            let to = places_of(&names);
            places[c] = to;
            let mut moved = names;
            (0..C::N).for_each(|i| moved[place(to, i)] = names[i]);
            let first = usize::from(moved[C::N - 1] != INFINITE);
            // The first two, or in the plane the second alone.
            let next = if first + 1 < C::N { moved[first + 1].get() } else { 0 };
            let at = &mut starts[lowest(cell)];
            ranked[*at as usize] = (u64::from(moved[first].get()) << 32 | u64::from(next), Slot::at(c));
            *at += 1;
        }
        // Each start is now the end of its cells.
        let mut start = 0;
        for &end in &starts[..n_sites] {
            ranked[start as usize..end as usize].sort_unstable_by_key(|&(rank, _)| rank);
            start = end;
        }
        for (rank, &(_, c)) in ranked.iter().enumerate() {
            index[c] = Slot::at(rank + rank / gap_after);
        }
        sorted.lengthen(n_slots, Cell::free());
        for &(_, c) in &ranked {
            let (cell, to) = (&self.cells[c.index()], places[c.index()]);
            let mut put = *cell;
            for i in 0..C::N {
                put.corners[place(to, i)] = name(cell.corners[i]);
                let out = cell.neighbour(i);
                let across = place(places[out.cell().index()], out.index());
                put.neighbours[place(to, i)] = Facet::new(index[out.cell()], across);
            }
            sorted[index[c]] = put;
        }
        marks.resize(n_slots, 0);
        free.put_everywhere(gaps(n_live, gap_after));
        (self.cells, self.marks, self.free) = (sorted, marks, free);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Any order of a cell's corners of one orientation comes to the same one, with the lowest first.
    #[test]
    fn corners_are_put_in_one_order() {
        fn check<C: Corners>(corners: C, evens: &[C]) {
            for even in evens {
                let to = places_of(even);
                let mut moved = *even;
                (0..C::N).for_each(|i| moved[place(to, i)] = even[i]);
                assert_eq!(moved.as_ref(), corners.as_ref());
            }
        }
        let s = |k: u32| SiteId::new(k);
        let three = |a, b, c| [s(a), s(b), s(c)];
        check(three(4, 9, 7), &[three(4, 9, 7), three(9, 7, 4), three(7, 4, 9)]);
        check([s(7), s(4), INFINITE], &[[s(7), s(4), INFINITE]]);
        let four = |[a, b, c, d]: [u32; 4]| [s(a), s(b), s(c), s(d)];
        let mut evens = Vec::new();
        for [a, b, c, d] in [[2, 3, 5, 4], [3, 2, 4, 5], [5, 4, 2, 3], [4, 5, 3, 2]] {
            evens.extend([[a, b, c, d], [a, c, d, b], [a, d, b, c]].map(four));
        }
        check(four([2, 3, 5, 4]), &evens);
        let ghost = |a, b, c| [s(a), s(b), s(c), INFINITE];
        check(ghost(3, 9, 5), &[ghost(3, 9, 5), ghost(9, 5, 3), ghost(5, 3, 9)]);
    }
}
