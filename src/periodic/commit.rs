//! Commits.

use std::sync::OnceLock;

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::{ChangedParts, CommitReport, HiddenIds};
use crate::periodic::editing::ImageEdits;
use crate::periodic::images::Image;
use crate::periodic::inside::{Inside, InsideBefore};
use crate::periodic::lattice::{HOME, Lattice, Occupied};
use crate::periodic::rounds::{MovedBefore, PlacesBefore, RoundBefore};
use crate::periodic::triangulation::PeriodicTriangulation;

/// What a round of moves and few edits has done, and what there was before.
type RoundMade<G> = (CommitReport, MovedBefore<G>);

/// Where vertices go.
#[derive(Clone, Copy)]
pub(super) enum PeriodicGoals<'a, G: Moving> {
    /// To what is staged for them; others stay.
    Staged,
    /// To the entries of an array by id.
    Of(&'a [G::Point]),
}

impl<G: Moving> PeriodicTriangulation<G> {
    /// Makes all that is staged the next timestamp; on an error nothing has happened.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a vertex that is too far away for new vectors, [`Error::OutOfMemory`],
    /// [`Error::TooManyVertices`], [`Error::TooManyCells`], [`Error::Cancelled`], [`Error::Prepared`].
    pub fn commit_timestamp(&mut self) -> Result<CommitReport> {
        self.reject_prepared()?;
        self.commit(PeriodicGoals::Staged)
    }

    /// Moves each vertex to the entry of its id, and makes that, and all that is staged but for moves, the next timestamp.
    /// Entries of removed vertices are not read.
    ///
    /// # Errors
    /// [`Error::DuplicateMove`] if a move is staged, [`Error::WrongCount`] unless there is an entry for each id,
    /// [`Error::NotFinite`], [`Error::OutOfRange`], and those of [`commit_timestamp`](Self::commit_timestamp).
    pub fn commit_positions(&mut self, positions: &[G::Point]) -> Result<CommitReport> {
        self.reject_prepared()?;
        if let Some(vertex) = self.staged.first_moving() {
            return Err(Error::DuplicateMove { argument: "positions", index: vertex.index(), vertex });
        }
        let (given, wanted) = (positions.len(), self.id_count());
        if given != wanted {
            let coming = self.staged.insertions().len();
            return Err(Error::WrongCount { argument: "count", given, wanted, coming });
        }
        self.commit(PeriodicGoals::Of(positions))
    }

    fn commit(&mut self, goals: PeriodicGoals<'_, G>) -> Result<CommitReport> {
        let (report, before) = self.make_round(goals)?;
        self.inside.publish([before]);
        (self.cells, self.edges) = (OnceLock::new(), OnceLock::new());
        self.statistics.timestamp += 1;
        Ok(report)
    }

    /// Makes all that is staged a round of the next timestamp; on an error nothing has happened. Returns what there
    /// was before as well. What was read is of the past then.
    pub(super) fn make_round(
        &mut self,
        goals: PeriodicGoals<'_, G>,
    ) -> Result<(CommitReport, RoundBefore<G>)> {
        let mut hidden = HiddenIds::default();
        if G::HAS_WEIGHTS {
            hidden = self.inside.hidden_homes(&self.lattice)?.ids(self.inside.images.n_vertices())?;
        }
        let (mut report, before) = match self.moved(goals, &hidden)? {
            Some((report, moved)) => (report, RoundBefore::Moved(moved)),
            None => self.rebuilt(goals, &hidden)?,
        };
        self.staged.clear();
        report.timestamp = self.statistics.timestamp + 1;
        self.statistics.add(&report);
        self.statistics.coincident = report.coincident;
        self.statistics.hidden_by_weight = report.hidden_by_weight;
        Ok((report, before))
    }

    /// Moves vertices and images, makes the edits, and inserts images that are missing; none, without a change, if a vertex would
    /// be too far from the unit cell, the lattice too different, or the edits too many.
    fn moved(&mut self, goals: PeriodicGoals<'_, G>, hidden: &HiddenIds) -> Result<Option<RoundMade<G>>> {
        let n = self.inside.images.n_vertices();
        let lattice = self.coming.as_ref().unwrap_or(&self.lattice);
        let edits = ImageEdits::of(&self.inside, lattice, &self.staged, |index| match goals {
            PeriodicGoals::Of(positions) => positions[n + index],
            PeriodicGoals::Staged => self.staged.insertions()[index],
        });
        let Some(edits) = edits? else { return Ok(None) };
        memory::reserve(&mut self.wraps, edits.wraps().len())?;
        let moved = match (goals, &self.coming) {
            (PeriodicGoals::Staged, None) => self.some_moved(&edits, hidden),
            (PeriodicGoals::Of(positions), None) => {
                let goals = AllGoals { positions, wraps: &self.wraps, hidden };
                self.inside.move_all(&self.lattice, goals, &edits, |wrap| wrap)
            }
            (PeriodicGoals::Of(positions), Some(_)) => self.all_moved_in_other(positions, &edits, hidden),
            (PeriodicGoals::Staged, Some(_)) => {
                let mut positions = Vec::new();
                let places = VertexId::range(0..n).map(|v| self.position(v).unwrap_or_default());
                memory::collect(&mut positions, places)?;
                self.staged.moves().iter().for_each(|&(vertex, goal)| positions[vertex] = goal);
                self.all_moved_in_other(&positions, &edits, hidden)
            }
        };
        let Some((mut report, mut before)) = moved? else { return Ok(None) };
        before.exchange_wraps(&mut self.wraps);
        self.wraps.extend_from_slice(edits.wraps());
        (report.inserted, report.removed) = (edits.wraps().len() as u64, edits.going().len() as u64);
        before.removed = edits.into_going_inside();
        Ok(Some((report, before)))
    }

    /// Of those whose moves are staged.
    fn some_moved(&mut self, edits: &ImageEdits<G>, hidden: &HiddenIds) -> Result<Option<RoundMade<G>>> {
        let Self { lattice, inside, wraps, staged, .. } = self;
        let (mut new_wraps, mut ids, mut places) = (Vec::new(), Vec::new(), Vec::new());
        let (mut occupied, mut changed, mut before) =
            (inside.occupied, ChangedParts::default(), inside.before_round());
        edits.enter(lattice, &mut occupied);
        edits.forget_wraps(&mut new_wraps)?;
        for &(vertex, position) in staged.moves().iter().filter(|&&(vertex, _)| !staged.goes(vertex)) {
            let near = inside.places[inside.images.home(vertex)];
            let mut wrap = wraps[vertex];
            let place = lattice.wrapped_near("positions", vertex.index(), &position, &near, &mut wrap)?;
            lattice.enter(&mut occupied, &place);
            changed.count_in_period(&near, &place, wrap != wraps[vertex]);
            if wrap != wraps[vertex] {
                memory::push(&mut new_wraps, (vertex, wrap))?;
            }
            for inner in inside.images.all_of(vertex) {
                memory::push(&mut ids, inner)?;
                memory::push(&mut places, lattice.translated(&place, inside.images.of(inner).shift))?;
            }
        }
        if !inside.is_near(lattice, &occupied) {
            return Ok(None);
        }
        let n_more = (inside.images.len() + edits.len()).saturating_sub(inside.places.len());
        memory::reserve(&mut inside.places, n_more)?;
        inside.t.move_vertices(&ids, &places)?;
        let report = inside.commit_edits(lattice, occupied, edits, changed, hidden)?;
        (before.places, before.wraps) = (PlacesBefore::Some(ids, places), new_wraps);
        inside.settle(edits, &mut before);
        Ok(Some((report, before)))
    }

    /// Of all, to these positions by id, in the lattice that is staged. Vertices go to the place that is nearest, images with
    /// them: each is translated by what is nearest to what it was translated by.
    fn all_moved_in_other(
        &mut self,
        positions: &[G::Point],
        edits: &ImageEdits<G>,
        hidden: &HiddenIds,
    ) -> Result<Option<RoundMade<G>>> {
        let Some(other) = &self.coming else { return Ok(None) };
        let Some(relation) = self.lattice.relation_to(other) else { return Ok(None) };
        let mut changed = ChangedParts::default();
        for (vertex, _) in self.inside.images.homes().filter(|&(vertex, _)| !self.staged.goes(vertex)) {
            changed.count(&self.position(vertex)?, &positions[vertex]);
        }
        let Self { inside, wraps, .. } = self;
        let mut images = Vec::new();
        memory::reserve_exact(&mut images, inside.images.len())?;
        for &image in inside.images.as_slice() {
            if image == Image::GONE {
                images.push(image);
                continue;
            }
            let shift = relation.of(image.shift.map(i64::from)).and_then(|shift| {
                let short = shift.map(|n| i32::try_from(n).unwrap_or(i32::MAX));
                other.may_need(short).then_some(short)
            });
            match shift {
                Some(shift) => images.push(Image { vertex: image.vertex, shift }),
                None if inside.images.is_there(&image) => return Ok(None),
                None => images.push(Image::GONE),
            }
        }
        inside.images.exchange(&mut images);
        let in_other = |wrap| relation.of(wrap).unwrap_or(wrap);
        let moved = inside.move_all(other, AllGoals { positions, wraps, hidden }, edits, in_other);
        let Ok(Some((mut report, mut before))) = moved else {
            inside.images.exchange(&mut images);
            return moved;
        };
        (report.moved, report.reweighted) = (changed.moved, changed.reweighted);
        before.other = self.coming.take().map(|other| (std::mem::replace(&mut self.lattice, other), images));
        Ok(Some((report, before)))
    }

    /// Builds another triangulation, with all that is staged, which takes the place of the present one.
    fn rebuilt(
        &mut self,
        goals: PeriodicGoals<'_, G>,
        hidden: &HiddenIds,
    ) -> Result<(CommitReport, RoundBefore<G>)> {
        let lattice = self.coming.as_ref().unwrap_or(&self.lattice);
        let (n_before, n_ids) = (self.inside.images.n_vertices(), self.id_count());
        let mut positions = Vec::new();
        memory::reserve_exact(&mut positions, n_ids)?;
        for vertex in VertexId::range(0..n_before) {
            positions.push(match goals {
                PeriodicGoals::Of(goals) => Some(goals[vertex]),
                PeriodicGoals::Staged => self.position(vertex).ok(),
            });
        }
        for (index, position) in self.staged.insertions().iter().enumerate() {
            positions.push(Some(match goals {
                PeriodicGoals::Of(goals) => goals[n_before + index],
                PeriodicGoals::Staged => *position,
            }));
        }
        self.staged.moves().iter().for_each(|&(vertex, goal)| positions[vertex] = Some(goal));
        let mut changed = ChangedParts::default();
        let (mut home, mut wraps) = (Vec::new(), Vec::new());
        memory::reserve_exact(&mut home, n_ids)?;
        memory::reserve_exact(&mut wraps, n_ids)?;
        for (index, position) in positions.iter().enumerate() {
            let vertex = VertexId::at(index);
            let is_there = index >= n_before || self.inside.images.home(vertex) != VertexId::NONE;
            wraps.push([0; 3]);
            let Some(position) = position.filter(|_| is_there && !self.staged.goes(vertex)) else { continue };
            let (place, wrap) = lattice.wrapped("positions", index, &position)?;
            if index < n_before {
                changed.count(&self.position(vertex)?, &position);
            }
            wraps[index] = wrap;
            home.push((vertex, place));
        }
        let mut inside =
            memory::boxed(Inside::unbuilt(lattice, &home, n_ids, self.inside.t.options_of_another())?)?;
        inside.t.exchange_monitors(&mut self.inside.t);
        let (inserted, removed) =
            (self.staged.insertions().len() as u64, self.staged.removals().len() as u64);
        let mut report = CommitReport { rebuilds: 1, inserted, removed, ..CommitReport::default() };
        let built =
            inside.build(lattice).and_then(|()| inside.enter_change(lattice, changed, hidden, &mut report));
        if let Err(error) = built {
            inside.t.exchange_monitors(&mut self.inside.t);
            return Err(error);
        }
        std::mem::swap(&mut self.inside, &mut inside);
        std::mem::swap(&mut self.wraps, &mut wraps);
        let lattice = self.coming.take().map(|lattice| std::mem::replace(&mut self.lattice, lattice));
        Ok((report, RoundBefore::Built { inside, wraps, lattice }))
    }
}

/// What moves come to: what vertices at home occupy then, what of them changes, and which ones come home by another
/// translation than before, and by which.
type MovedHomes = (Occupied, ChangedParts, Vec<(VertexId, [i64; 3])>);

/// Where all vertices go.
#[derive(Clone, Copy)]
struct AllGoals<'a, G: Moving> {
    /// By id.
    positions: &'a [G::Point],
    /// By vertex, the translation by which it came home.
    wraps: &'a [[i64; 3]],
    /// The vertices that were hidden.
    hidden: &'a HiddenIds,
}

impl<G: Moving> Inside<G> {
    /// Moves all to these positions by id, and inserts images that are missing, all of it or, on an error, nothing;
    /// returns what there was before as well, where vertices have the translations by which they come home. None,
    /// without a change, if one would be too far from the unit cell. `wrap_of` tells what a translation is by the
    /// vectors of the lattice.
    fn move_all(
        &mut self,
        lattice: &Lattice<G>,
        all: AllGoals<'_, G>,
        edits: &ImageEdits<G>,
        wrap_of: impl Fn([i64; 3]) -> [i64; 3],
    ) -> Result<Option<RoundMade<G>>> {
        let (mut goals, mut before) = (std::mem::take(&mut self.goals), self.before_round());
        let moved = self.goals_of(lattice, all, edits, wrap_of, &mut goals);
        let done = moved.and_then(|moved| {
            let Some((occupied, changed, new_wraps)) = moved else { return Ok(None) };
            memory::reserve(&mut goals, edits.len())?;
            self.t.move_all(&goals)?;
            let report = self.commit_edits(lattice, occupied, edits, changed, all.hidden)?;
            (before.places, before.wraps) = (PlacesBefore::All(std::mem::take(&mut goals)), new_wraps);
            self.settle(edits, &mut before);
            Ok(Some((report, before)))
        });
        self.goals = goals;
        done
    }

    /// Where all go, images included, if the vertices go to these positions; none if one of them would be too far from the unit
    /// cell.
    fn goals_of(
        &self,
        lattice: &Lattice<G>,
        AllGoals { positions, wraps, .. }: AllGoals<'_, G>,
        edits: &ImageEdits<G>,
        wrap_of: impl Fn([i64; 3]) -> [i64; 3],
        goals: &mut Vec<G::Point>,
    ) -> Result<Option<MovedHomes>> {
        goals.clear();
        memory::lengthen(goals, self.images.len(), G::Point::default())?;
        let (mut occupied, mut changed, mut new_wraps) =
            (Occupied::NOTHING, ChangedParts::default(), Vec::new());
        edits.enter(lattice, &mut occupied);
        edits.forget_wraps(&mut new_wraps)?;
        let mut going = edits.going().iter().peekable();
        for (vertex, inner) in self.images.homes() {
            if going.next_if_eq(&&vertex).is_some() {
                continue;
            }
            let (before, near) = (wrap_of(wraps[vertex]), &self.places[inner]);
            let mut wrap = before;
            let (index, position) = (vertex.index(), &positions[vertex]);
            let place = lattice.wrapped_near("positions", index, position, near, &mut wrap)?;
            lattice.enter(&mut occupied, &place);
            changed.count_in_period(near, &place, wrap != before);
            goals[inner] = place;
            if wrap != wraps[vertex] {
                memory::push(&mut new_wraps, (vertex, wrap))?;
            }
        }
        if !self.is_near(lattice, &occupied) {
            return Ok(None);
        }
        for (inner, image) in VertexId::range(0..self.images.len()).zip(self.images.as_slice()) {
            if image.shift != HOME && self.images.is_there(image) {
                goals[inner] = lattice.translated(&goals[self.images.home(image.vertex)], image.shift);
            }
        }
        Ok(Some((occupied, changed, new_wraps)))
    }

    /// Makes the moves that are staged inside, and the edits, and inserts images that are missing then: all of it or, on an error,
    /// nothing. The edits are to be [settled](Self::settle) then.
    fn commit_edits(
        &mut self,
        lattice: &Lattice<G>,
        occupied: Occupied,
        edits: &ImageEdits<G>,
        changed: ChangedParts,
        hidden: &HiddenIds,
    ) -> Result<CommitReport> {
        if !self.t.is_prepared() {
            self.since =
                InsideBefore { n_vertices: self.images.n_vertices(), is_plain: self.is_plain(lattice) };
        }
        if let Err(error) = self.t.set_savepoint() {
            self.t.discard_moves();
            return Err(error);
        }
        let (before, n_images) = (self.occupied, self.images.len());
        self.occupied = occupied;
        let done = self.stage(edits).and_then(|()| {
            let mut report = self.t.prepare_timestamp()?;
            self.enter_coming(edits);
            self.complete(lattice, self.missing(lattice)?, Self::missing, |t| {
                report.add(&t.prepare_timestamp()?);
                Ok(())
            })?;
            self.enter_change(lattice, changed, hidden, &mut report)?;
            Ok(report)
        });
        if done.is_err() {
            self.t.discard_moves();
            self.t.withdraw_to_savepoint();
            self.images.truncate(n_images);
            self.occupied = before;
        }
        done
    }

    /// Enters into a report of what is inside what has become of the vertices: how many have changed, are hidden, and were not
    /// or were hidden before.
    fn enter_change(
        &self,
        lattice: &Lattice<G>,
        changed: ChangedParts,
        before: &HiddenIds,
        report: &mut CommitReport,
    ) -> Result<()> {
        (report.moved, report.reweighted) = (changed.moved, changed.reweighted);
        let hidden = self.hidden_homes(lattice)?;
        hidden.count_in(report);
        if G::HAS_WEIGHTS {
            (report.newly_hidden, report.newly_shown) = (0, 0);
            let is_there = |v: VertexId| {
                let home = self.images.home(v);
                home != VertexId::NONE && self.t.is_present(home)
            };
            for (_, is_hidden) in
                hidden.ids(self.images.n_vertices())?.differences(before).filter(|&(v, _)| is_there(v))
            {
                *if is_hidden { &mut report.newly_hidden } else { &mut report.newly_shown } += 1;
            }
        }
        Ok(())
    }

    /// The rounds stay: what they have removed is forgotten, and their room is for the next goals.
    pub(super) fn publish(
        &mut self,
        rounds: impl IntoIterator<Item = RoundBefore<G>, IntoIter: DoubleEndedIterator>,
    ) {
        if self.t.publish_timestamp().is_ok() {
            // Without the memory for it the next commit looks at what has changed now, too.
            let _ = self.t.take_changes();
        }
        for round in rounds.into_iter().rev() {
            // Before another triangulation was built, there were other ids inside.
            let RoundBefore::Moved(MovedBefore { removed, places, .. }) = round else { return };
            removed.into_iter().for_each(|inner| self.images.forget(inner));
            if let PlacesBefore::All(places) = places {
                self.goals = places;
            }
        }
    }
}
