//! Many sites to places far away, on several threads.
//!
//! ```text
//! twice, with other ranges:
//!     divide the cells, which are sorted, into ranges of storage; each thread in its range:
//!         remove the sites that have a cell there
//!     all removed sites are at their new places now, in no cell; each thread in its range:
//!         insert those that a landmark says are near a cell there
//!     give the sites their new cells
//! insert what is left over, on one thread
//! ```
//!
//! A removal or an insertion is done only if every cell that it changes, or whose gluings it changes, is of the
//! thread's range, as with [flips](super::flip): so no two threads read or write the same cell. Sites are read by all
//! and written by none. What is at the border of a range is done the second time; what is on the hull, among ties that
//! have to be removed, or at the place of another site is left over, and done here or by the caller, as if the threads
//! had not been there. Since the cells are a function of the sites, they do not depend on which thread has done what.
//!
//! Invariant: until all is done, the rows of all cells that have been replaced are in the journals, round by round. An
//! error takes all of it back.
//!
//! Cost: that of the removals and insertions, divided by the number of threads, and the sites' new cells, which one
//! thread writes. (`examples/thread_scaling`: *leaps*.)

use super::landmarks::Landmarks;
use super::remove::Hole;
use super::site::Sites;
use super::wrapping::Wrapping;
use super::{Delaunay, Dimension, IndexSet, Insertion, Site};
use crate::complex::{CellRange, Corners, Row, WORD, starts_of_ranges};
use crate::error::{Error, Result};
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::machine::prefetch::{AHEAD, prefetch};
use crate::predicates::StaticFilter;
use crate::simd::Avx2;
use inserting::Rim;

/// Sites for each thread that take longer to place than the thread to wake up, twice; and as many if all threads are to
/// be used.
const PLACED_AT_LEAST: usize = 64;
const PLACED_IF_ASKED: usize = 8;

/// A journal with room for more rows is not kept as scratch memory.
const ROWS_KEPT: usize = 1 << 14;

/// Tasks between those of which one thing and the next are asked for.
const STEP: usize = 4;

/// Parts of the cells' storage at which a thread's cells may begin.
const STARTS: usize = 64;

/// Where a site is to go; where it was, once it has gone there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Goal<G: Dimension> {
    pub(crate) site: SiteId,
    pub(crate) place: G::Point,
}

/// What has become of a goal's site.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    InPlace,
    /// In no cell, and to be inserted near this one, if one is known.
    Removed(Slot),
    Inserted,
}

/// The number of a goal, and a cell with which to begin.
type Task = (u32, Slot);

/// What a thread works with.
#[derive(Debug)]
struct Part<G: Dimension> {
    /// Sites to be removed, or to be inserted.
    tasks: Vec<Task>,
    /// What has become of those with which that could be done.
    done: Vec<(u32, State)>,
    /// For each of those that have been removed a site that was next to it, and landmarks near its goal.
    left_behind: Vec<SiteId>,
    landmarks: Vec<[SiteId; 2]>,
    /// The rows of the cells that have been replaced, and how many were there before the second round.
    journal: Vec<Row<G::Corners>>,
    n_first: usize,
    /// The slots of cells that have been made in this round.
    made: Vec<Slot>,
    /// Whether there was no memory to go on.
    has_failed: bool,
    /// A star or a conflict zone, and the slots of the cells in its place.
    cells: IndexSet<Slot>,
    slots: Vec<Slot>,
    hole: Hole<G>,
    wrapping: Option<Box<Wrapping>>,
    rim: Rim<G>,
}

impl<G: Dimension> Default for Part<G> {
    fn default() -> Self {
        Part {
            tasks: Vec::new(),
            done: Vec::new(),
            left_behind: Vec::new(),
            landmarks: Vec::new(),
            journal: Vec::new(),
            n_first: 0,
            made: Vec::new(),
            has_failed: false,
            cells: IndexSet::new(),
            slots: Vec::new(),
            hole: Hole::default(),
            wrapping: None,
            rim: Rim::default(),
        }
    }
}

impl<G: Dimension> Part<G> {
    fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.tasks)
            + memory::bytes_of(&self.done)
            + memory::bytes_of(&self.left_behind)
            + memory::bytes_of(&self.landmarks)
            + memory::bytes_of(&self.journal)
            + memory::bytes_of(&self.made)
            + self.cells.memory_bytes()
            + memory::bytes_of(&self.slots)
            + self.hole.memory_bytes()
            + memory::bytes_of_made(&self.wrapping, |_| 0)
            + self.rim.memory_bytes()
    }
}

/// The parts of the last call, and the memory for the next one.
#[derive(Debug)]
pub(super) struct SideBySide<G: Dimension> {
    parts: Vec<Part<G>>,
    /// Where their cells begin.
    starts: Vec<Slot>,
    /// What has become of each goal's site.
    states: Vec<State>,
}

impl<G: Dimension> Default for SideBySide<G> {
    fn default() -> Self {
        SideBySide { parts: Vec::new(), starts: Vec::new(), states: Vec::new() }
    }
}

impl<G: Dimension> SideBySide<G> {
    pub(super) fn memory_bytes(&self) -> usize {
        self.parts.iter().map(Part::memory_bytes).sum::<usize>()
            + memory::bytes_of(&self.parts)
            + memory::bytes_of(&self.starts)
            + memory::bytes_of(&self.states)
    }

    /// Gives the threads tasks by the goals' states: a task is the thread's that has its cell.
    fn give_tasks(&mut self, cell_of: impl Fn(usize, State) -> Option<Slot>) -> Result<()> {
        let SideBySide { parts, starts, states, .. } = self;
        parts.iter_mut().for_each(|part| part.tasks.clear());
        for (goal, &state) in states.iter().enumerate() {
            if let Some(cell) = cell_of(goal, state).filter(|&cell| cell != Slot::NONE) {
                // The last one has what is before the first start.
                let part = starts.partition_point(|&start| start <= cell).checked_sub(1);
                memory::push(&mut parts[part.unwrap_or(starts.len() - 1)].tasks, (goal as u32, cell))?;
            }
        }
        parts.iter_mut().try_for_each(|part| {
            part.done.clear();
            memory::reserve(&mut part.done, part.tasks.len())
        })
    }

    /// The second round is done in ranges that begin in the middle of those of the first. As the curve along which the
    /// cells are sorted ends beside where it begins, the last range goes on at the first slot: so most of what is
    /// between two ranges of one round is within a range of the other.
    fn begin_second_round(&mut self, n_slots: usize) {
        for k in 0..self.starts.len() {
            let end = self.starts.get(k + 1).map_or(n_slots, |end| end.index());
            self.starts[k] = Slot::at(self.starts[k].index().midpoint(end) / WORD * WORD);
        }
        for part in &mut self.parts {
            part.n_first = part.journal.len();
            part.made.clear();
        }
    }

    /// The rows of the cells that have been replaced, in an order in which that can have been done.
    fn rows(&self) -> impl DoubleEndedIterator<Item = &[Row<G::Corners>]> {
        let first = self.parts.iter().map(|part| &part.journal[..part.n_first]);
        first.chain(self.parts.iter().map(|part| &part.journal[part.n_first..]))
    }
}

/// What all threads read.
#[derive(Clone, Copy)]
struct Shared<'t, G: Dimension> {
    filter: &'t StaticFilter,
    sites: Sites<'t, G>,
    /// The sites once more, for the cells that they had before.
    cells_of: &'t [Site<G>],
    landmarks: &'t Landmarks,
    goals: &'t [Goal<G>],
}

impl<G: Dimension> Delaunay<G> {
    /// How many threads may place this number of sites side by side, if the cells are sorted.
    pub(crate) fn placing_threads(&self, n: usize) -> usize {
        // There has to be a way to find out which range the cells near a place are in.
        if Avx2::new().is_none() || !self.landmarks.are_made_by(n, self.sites.len()) {
            return 1;
        }
        self.threads.for_work(n, PLACED_AT_LEAST, PLACED_IF_ASKED)
    }

    /// Whether the cells have been sorted since the latest build.
    pub(crate) fn are_cells_sorted(&self) -> bool {
        self.is_sorted
    }

    /// Places sites, which are in cells and go [away](Self::is_away), on several threads, as far as these can. Enters
    /// the numbers of those that have been, and exchanges their goals with where they were. Where there was a site at
    /// the goal, it is entered as well, and the index of the other is free. After an error as after one of
    /// [`relocate_site`](Self::relocate_site).
    pub(crate) fn place_side_by_side(
        &mut self,
        goals: &mut [Goal<G>],
        placed: &mut Vec<(u32, Option<SiteId>)>,
    ) -> Result<()> {
        placed.clear();
        let n_threads = self.placing_threads(goals.len());
        // Unless the cells are sorted nearly all changes would need those of several threads.
        if n_threads < 2 || !self.is_sorted {
            return Ok(());
        }
        let mut all = memory::take_made(&mut self.side_by_side)?;
        let done = self.place_in_parts(&mut all, goals, n_threads, placed);
        self.side_by_side = Some(all);
        done
    }

    /// Frees memory that was needed for many sites, after the last of several calls.
    pub(crate) fn end_side_by_side(&mut self) {
        let parts = self.side_by_side.iter_mut().flat_map(|all| &mut all.parts);
        for part in parts.filter(|part| part.journal.capacity() > ROWS_KEPT) {
            *part = Part::default();
        }
    }

    fn place_in_parts(
        &mut self,
        all: &mut SideBySide<G>,
        goals: &mut [Goal<G>],
        n_threads: usize,
        placed: &mut Vec<(u32, Option<SiteId>)>,
    ) -> Result<()> {
        memory::reserve(placed, goals.len())?;
        self.landmarks.make(&self.sites)?;
        for goal in &*goals {
            self.log_site(goal.site)?;
            self.cover(&goal.place, &goal.place);
        }
        self.divide(all, goals, n_threads)?;
        if all.starts.len() < 2 {
            return Ok(());
        }
        let done = self.exchange_in_rounds(all, goals).and_then(|()| self.enter_parts(all));
        if let Err(error) = done {
            self.take_parts_back(all, goals);
            return Err(error);
        }
        for (goal, state) in (0..).zip(&all.states) {
            match state {
                State::InPlace => continue,
                State::Inserted => placed.push((goal, None)),
                State::Removed(_) => self.sites[goals[goal as usize].site].cell = Slot::NONE,
            }
        }
        for (goal, _) in (0..).zip(&all.states).filter(|(_, state)| matches!(state, State::Removed(_))) {
            let inserted = match self.insert_site_anywhere(goals[goal as usize].site)? {
                Insertion::New => None,
                Insertion::Coincident(other) => Some(other),
                Insertion::Spans => unreachable!("the hull has not changed"),
            };
            placed.push((goal, inserted));
        }
        Ok(())
    }

    /// Finds out where each thread's cells begin.
    fn divide(&mut self, all: &mut SideBySide<G>, goals: &[Goal<G>], n_threads: usize) -> Result<()> {
        let SideBySide { parts, starts, states } = all;
        // In each call in the same places, mostly: a star at the border gets cells of both sides, and stays there.
        let unit = (self.complex.n_slots().next_power_of_two() / STARTS).max(WORD);
        *starts = starts_of_ranges(goals.iter().map(|goal| self.site(goal.site).cell), n_threads, unit)?;
        let missing = starts.len().saturating_sub(parts.len());
        memory::reserve_exact(parts, missing)?;
        parts.resize_with(parts.len() + missing, Part::default);
        for part in parts {
            part.journal.clear();
            part.made.clear();
            (part.n_first, part.has_failed) = (0, false);
        }
        states.clear();
        memory::lengthen(states, goals.len(), State::InPlace)
    }

    /// Removes and inserts, as far as that can be done in ranges.
    fn exchange_in_rounds(&mut self, all: &mut SideBySide<G>, goals: &mut [Goal<G>]) -> Result<()> {
        self.exchange_in_ranges(all, goals)?;
        all.begin_second_round(self.complex.n_slots());
        self.exchange_in_ranges(all, goals)
    }

    /// A round, after which the sites have their new cells.
    fn exchange_in_ranges(&mut self, all: &mut SideBySide<G>, goals: &mut [Goal<G>]) -> Result<()> {
        self.remove_in_ranges(all, goals)?;
        all.give_tasks(|_, state| if let State::Removed(near) = state { Some(near) } else { None })?;
        self.work_in_ranges(all, goals, |shared, range, part| shared.insert_all(range, part))?;
        for &(goal, state) in all.parts.iter().flat_map(|part| &part.done) {
            all.states[goal as usize] = state;
        }
        self.give_cells(all);
        Ok(())
    }

    /// Removes sites, as far as that can be done in ranges, and takes these to their goals.
    fn remove_in_ranges(&mut self, all: &mut SideBySide<G>, goals: &mut [Goal<G>]) -> Result<()> {
        let cell_of = |goal: usize| self.site(goals[goal].site).cell;
        all.give_tasks(|goal, state| (state == State::InPlace).then(|| cell_of(goal)))?;
        self.work_in_ranges(all, goals, |shared, range, part| shared.remove_all(range, part))?;
        for &(goal, state) in all.parts.iter().flat_map(|part| &part.done) {
            all.states[goal as usize] = state;
            self.exchange_places(&mut goals[goal as usize]);
        }
        Ok(())
    }

    fn exchange_places(&mut self, Goal { site, place }: &mut Goal<G>) {
        std::mem::swap(&mut self.sites[*site].point, place);
    }

    /// Has each thread do its tasks in its range.
    fn work_in_ranges(
        &mut self,
        all: &mut SideBySide<G>,
        goals: &[Goal<G>],
        work: impl Fn(Shared<G>, &mut CellRange<G::Corners>, &mut Part<G>) + Sync,
    ) -> Result<()> {
        let shared = Shared {
            filter: &self.filter,
            sites: Sites::new(&self.sites),
            cells_of: &self.sites,
            landmarks: &self.landmarks,
            goals,
        };
        self.complex.divided(&all.starts, &mut all.parts, |_, range, part| work(shared, range, part))?;
        if all.parts.iter().any(|part| part.has_failed) {
            let rows: usize = all.rows().map(<[_]>::len).sum();
            return Err(Error::OutOfMemory { bytes: rows * size_of::<Row<G::Corners>>() });
        }
        Ok(())
    }

    /// Gives the sites of cells that have been made one of these.
    fn give_cells(&mut self, all: &SideBySide<G>) {
        for part in &all.parts {
            for (k, &c) in part.made.iter().enumerate() {
                if let Some(&next) = part.made.get(k + AHEAD) {
                    prefetch(self.complex.cells(), next.index());
                }
                self.give_cell(c);
            }
        }
    }

    /// Gives the corners of a cell, if there is one, this cell.
    #[inline(always)]
    fn give_cell(&mut self, c: Slot) {
        let cell = *self.complex.cell(c);
        if !cell.is_free() {
            for &s in cell.corners.as_ref() {
                self.corner_mut(s).cell = c;
            }
            self.recent = c;
        }
    }

    /// Enters the changes, which will stay, into the records.
    fn enter_parts(&mut self, all: &SideBySide<G>) -> Result<()> {
        for rows in all.rows() {
            self.complex.note_rows(rows)?;
            if let Some(changed) = &mut self.changed {
                memory::collect(changed, rows.iter().map(|row| row.slot))?;
            }
        }
        Ok(())
    }

    fn take_parts_back(&mut self, all: &mut SideBySide<G>, goals: &mut [Goal<G>]) {
        for rows in all.rows().rev() {
            self.complex.undo_rows(rows.iter().rev().copied());
        }
        for row in all.rows().flatten() {
            self.give_cell(row.slot);
        }
        for (goal, _) in goals.iter_mut().zip(&all.states).filter(|(_, state)| **state != State::InPlace) {
            self.exchange_places(goal);
        }
    }
}

impl<G: Dimension> Shared<'_, G> {
    /// Asks for what the tasks after the `k`-th one will read first: the cell there, those next to it, and those next
    /// to these, with their corners.
    #[inline(always)]
    fn prefetch(&self, range: &CellRange<G::Corners>, tasks: &[Task], k: usize) {
        let cell = |steps: usize| range.cell(tasks.get(k + steps * STEP)?.1).ok();
        if let Some(&(_, slot)) = tasks.get(k + 3 * STEP) {
            range.prefetch(slot);
        }
        if let Some(cell) = cell(2) {
            (0..G::Corners::N).for_each(|i| range.prefetch(cell.neighbour(i).cell()));
        }
        let Some(first) = cell(1) else { return };
        for next in (0..G::Corners::N).filter_map(|i| range.cell(first.neighbour(i).cell()).ok()) {
            for i in 0..G::Corners::N {
                self.sites.prefetch(next.corners[i]);
                range.prefetch(next.neighbour(i).cell());
            }
        }
    }
}

mod inserting;
mod removing;
#[cfg(test)]
mod tests;
