//! *Placement* (report, section 3.1), with the improvements for small displacements of section 3.2.
//!
//! Vertices are relocated one at a time, each by a walk from its old place, from the vertex placed before it, or from a
//! landmark, whichever is nearest: in storage order, or, where many go far away, in that of their goals along a Hilbert
//! curve, so that what an insertion reads has been read by the one before. (One in twenty of a million vertices that go
//! anywhere take half the time so in the plane, and three quarters in space.) In between, some vertices are at their
//! new and some at their old positions: two may meet that are never at the same place at a timestamp; they share a site
//! for that while.
//!
//! **Threads.** Where many vertices go far away and the cells are sorted, several threads relocate most of them [side
//! by side](Delaunay::place_side_by_side), each in its range of the cells, some thousands at a time. Where one in a
//! hundred of a million vertices leaps, a repair on two threads is 1.3 to 1.5 times as fast as on one (`make targets`:
//! *threads_leaping*); the gain is the same after twenty such commits (`examples/thread_scaling`: *later*). Vertices
//! that go to near places are relocated by one thread, as that takes little more than to find out whose cells they
//! change.

use super::constants::constants;
use super::repair::Budget;
use super::staging::Given;
use super::{CommitReport, MovingTriangulation};
use crate::delaunay::order::{Keyed, hilbert_order};
use crate::delaunay::{Dimension, Goal, Insertion, Relocation, Shortcut};
use crate::error::{Error, Result};
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;
use crate::machine::prefetch::prefetch;
use std::ops::Range;

/// Vertices looked at to find out whether many go far away.
const SAMPLE: usize = 64;

/// Many vertices go far away if more than one in this number does.
const AWAY_SHARE: usize = 4;

/// Vertices placed side by side at a time, at most, and also for each of those at a time how many there are in all.
const MOST_SIDE_BY_SIDE: usize = 1 << 14;
const LEFT_PER_PLACED: usize = 16;

/// Where a vertex has been placed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Placed {
    /// In a triangulation, or in a set of sites that spans no cell.
    InCells,
    /// All have to be built: it is outside the hyperplane of all others, so that there are cells again, or it would
    /// take longer to place those that are left.
    NeedBuild,
}

impl<G: Dimension> MovingTriangulation<G> {
    /// Relocates the staged vertices one after the other.
    pub(super) fn commit_by_placement(
        &mut self,
        shortcut: Shortcut,
        given: &mut Given<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        self.queue_for_placement(given)?;
        self.place_side_by_side(report)?;
        self.place_staged(report, |t, v, new, report| t.relocate(v, new, shortcut, report))
    }

    /// Relocates the staged vertices one after the other, with flips, and rebuilds where what is left would take longer
    /// than that.
    pub(super) fn commit_by_placement_or_rebuilding(
        &mut self,
        given: &mut Given<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        self.queue_for_placement(given)?;
        self.place_staged_within_budget(0, report)
    }

    /// Relocates the staged vertices that are not applied yet, with flips, while that costs less than to rebuild; after
    /// a sweep with `exact` exact evaluations, or none.
    pub(super) fn place_staged_within_budget(&mut self, exact: u64, report: &mut CommitReport) -> Result<()> {
        self.place_side_by_side(report)?;
        let left = self.staging.vertices().len() - self.staging.applied();
        let slowdown = self.slowdown(1.0);
        let mut budget = Budget::new::<G>(self.n_present, left, exact, self.evaluations(), report, slowdown);
        self.place_staged(report, |t, v, new, report| {
            let placed = t.relocate(v, new, Shortcut::Flips, report)?;
            Ok(if budget.is_exceeded::<G>(t.evaluations(), report) { Placed::NeedBuild } else { placed })
        })
    }

    fn queue_for_placement(&mut self, given: &mut Given<'_, G>) -> Result<()> {
        self.stage_given(given)?;
        self.staging.list()?;
        self.regions.invalidate();
        self.order_queue();
        Ok(())
    }

    /// Relocates those of the staged vertices that go far away on several threads, as far as these can.
    fn place_side_by_side(&mut self, report: &mut CommitReport) -> Result<()> {
        // With fewer sites at once the others stay as near to each other as they were.
        let most = MOST_SIDE_BY_SIDE.min(self.n_present / LEFT_PER_PLACED).max(1);
        let n = self.staging.vertices().len();
        let first = self.staging.applied();
        if self.kernel.placing_threads(n - first) < 2 || !self.goals_are_away(1) {
            return Ok(());
        }
        // If not for this commit, for the next one.
        self.transaction.want_order();
        if !self.kernel.are_cells_sorted() {
            return Ok(());
        }
        let n_chunks = (n - first).div_ceil(most);
        self.spread_queue(n_chunks)?;
        let size = (n - first).div_ceil(n_chunks);
        let placed = (first..n).step_by(size).try_for_each(|start| {
            if !self.monitor(start as f64 / n as f64) {
                return Err(Error::Cancelled);
            }
            self.place_chunk_side_by_side(start..n.min(start + size), report)
        });
        self.kernel.end_side_by_side();
        placed
    }

    /// Puts every `n_chunks`-th of the staged vertices that are not applied yet first, then those after these, and so
    /// on, so that each chunk has some everywhere.
    fn spread_queue(&mut self, n_chunks: usize) -> Result<()> {
        if n_chunks < 2 {
            return Ok(());
        }
        let first = self.staging.applied();
        let queue = &mut self.staging.vertices_mut()[first..];
        let before = memory::copy_of(queue)?;
        let spread = (0..n_chunks).flat_map(|chunk| before.iter().skip(chunk).step_by(n_chunks));
        queue.iter_mut().zip(spread).for_each(|(v, spread)| *v = *spread);
        Ok(())
    }

    /// Relocates those of a range of the staged vertices that go far away, on several threads, as far as these can;
    /// none of them is applied yet. Those that have been relocated are put behind the applied ones. Where that fails
    /// midway, the kernel's log has the places of all.
    fn place_chunk_side_by_side(&mut self, queue: Range<usize>, report: &mut CommitReport) -> Result<()> {
        let (mut goals, mut at, mut placed) = (Vec::new(), Vec::new(), Vec::new());
        memory::reserve_exact(&mut goals, queue.len())?;
        memory::reserve_exact(&mut at, queue.len())?;
        for k in queue {
            let v = self.staging.vertices()[k];
            let (site, place) = (self.site_of[v], self.staging.positions()[v]);
            if !self.is_shared(site) && self.kernel.is_away(site, &place) {
                goals.push(Goal { site, place });
                at.push(k);
            }
        }
        self.kernel.place_side_by_side(&mut goals, &mut placed)?;
        // From the first in the queue to the last, each changes places with one that has not been relocated.
        placed.sort_unstable_by_key(|&(goal, _)| goal);
        for &(goal, other) in &placed {
            let (v, new) = self.note_placed(at[goal as usize], goals[goal as usize].place, report);
            if let Some(other) = other
                && let Err(error) = self.hide(v, other)
            {
                // It counts as not moved; what has become of its site is in the record.
                self.staging.positions_mut()[v] = new;
                self.staging.set_applied(self.staging.applied() - 1);
                return Err(error);
            }
        }
        Ok(())
    }

    /// Enters that the `k`-th staged vertex, which was here, has been placed; returns it, and where it is.
    fn note_placed(&mut self, k: usize, old: G::Point, report: &mut CommitReport) -> (VertexId, G::Point) {
        let first = self.staging.applied();
        let vertices = self.staging.vertices_mut();
        vertices.swap(first, k);
        let v = vertices[first];
        self.staging.set_applied(first + 1);
        report.moved += 1;
        report.placements += 1;
        (v, std::mem::replace(&mut self.staging.positions_mut()[v], old))
    }

    /// Relocates the staged vertices that are not applied yet, one after the other.
    pub(super) fn place_staged(
        &mut self,
        report: &mut CommitReport,
        mut relocate: impl FnMut(&mut Self, VertexId, &G::Point, &mut CommitReport) -> Result<Placed>,
    ) -> Result<()> {
        let (first, n) = (self.staging.applied(), self.staging.vertices().len());
        let is_far = self.kernel.is_far();
        for k in first..n {
            if !self.kernel.has_cells() {
                // Nothing to walk in: what is left is placed at once.
                return self.commit_by_rebuilding(k, report);
            }
            let is_call_due = (k - first).is_multiple_of(constants::<G>().relocations_per_call);
            if is_call_due && !self.monitor(k as f64 / n as f64) {
                return Err(Error::Cancelled);
            }
            if is_far {
                self.prefetch_staged(k);
            }
            self.staging.set_applied(k + 1);
            let v = self.staging.vertices()[k];
            let old = self.kernel.site(self.site_of[v]).point;
            let new = std::mem::replace(&mut self.staging.positions_mut()[v], old);
            if new != old {
                report.moved += 1;
                match relocate(self, v, &new, report) {
                    Ok(Placed::InCells) => {}
                    Ok(Placed::NeedBuild) => return self.commit_by_rebuilding(k + 1, report),
                    Err(error) => {
                        // It counts as not moved; what has become of its site is in the record.
                        self.staging.positions_mut()[v] = new;
                        self.staging.set_applied(k);
                        return Err(error);
                    }
                }
            }
        }
        Ok(())
    }

    /// Asks for what the relocations after the `k`-th one will read: vertices that are staged are far from each other
    /// where they are few.
    #[inline(always)]
    fn prefetch_staged(&self, k: usize) {
        let staged = self.staging.vertices();
        for step in 0..4 {
            if let Some(&v) = staged.get(k + 2 * (4 - step)) {
                self.kernel.prefetch_star(self.site_of[v], step);
            }
        }
        if let Some(&v) = staged.get(k + 10) {
            prefetch(&self.site_of, v.index());
            prefetch(self.staging.positions(), v.index());
        }
    }

    /// Relocates a vertex; the maps of sites and hidden vertices follow.
    pub(super) fn relocate(
        &mut self,
        vertex: VertexId,
        q: &G::Point,
        shortcut: Shortcut,
        report: &mut CommitReport,
    ) -> Result<Placed> {
        let s = self.site_of[vertex];
        if self.is_shared(s) {
            return self.relocate_from_shared(vertex, s, q, report);
        }
        match self.kernel.relocate_site(s, q, vertex, shortcut)? {
            Relocation::InPlace => report.unchanged += 1,
            Relocation::Flipped(flips) => report.flips += flips,
            Relocation::Placed => report.placements += 1,
            Relocation::Coincident(t) => {
                report.placements += 1;
                self.hide(vertex, t)?;
            }
            Relocation::Spans => return Ok(Placed::NeedBuild),
        }
        Ok(Placed::InCells)
    }

    /// The vertex leaves others behind at the place: it gets a site of its own.
    fn relocate_from_shared(
        &mut self,
        vertex: VertexId,
        s: SiteId,
        q: &G::Point,
        report: &mut CommitReport,
    ) -> Result<Placed> {
        report.placements += 1;
        // A live site must be in the triangulation while another is renamed, so the vertex's own is made after that.
        self.leave(vertex)?;
        let own = self.kernel.add_site(*q, vertex)?;
        self.site_of[vertex] = own;
        match self.kernel.insert_site(own, self.kernel.site(s).cell)? {
            Insertion::New => {}
            Insertion::Coincident(t) => self.hide(vertex, t)?,
            Insertion::Spans => return Ok(Placed::NeedBuild),
        }
        Ok(Placed::InCells)
    }

    /// Puts the staged vertices that are not applied yet, and have sites of their own, in the order in which to
    /// relocate them: that of their goals along a Hilbert curve if many go far away and the caches do not hold all;
    /// that of storage otherwise, and where there is no memory for the other.
    pub(super) fn order_queue(&mut self) {
        let is_worth = self.kernel.is_far() && self.goals_are_away(SAMPLE);
        if !is_worth || self.order_queue_by_goal().is_err() {
            self.order_queue_by_site();
        }
    }

    /// Whether of the staged vertices that are not applied yet there are this number, and many of them go far away,
    /// which shows in a sample.
    fn goals_are_away(&self, least: usize) -> bool {
        let queue = &self.staging.vertices()[self.staging.applied()..];
        if !self.kernel.has_cells() || queue.len() < least.max(1) {
            return false;
        }
        let is_away = |&&v: &&VertexId| self.kernel.is_away(self.site_of[v], &self.staging.positions()[v]);
        let sample = queue.iter().step_by((queue.len() / SAMPLE).max(1));
        sample.clone().filter(is_away).count() * AWAY_SHARE >= sample.len()
    }

    fn order_queue_by_goal(&mut self) -> Result<()> {
        let applied = self.staging.applied();
        let (positions, vertices) = self.staging.parts_mut();
        let queue = &mut vertices[applied..];
        let mut keyed = Vec::new();
        memory::reserve_exact(&mut keyed, queue.len())?;
        keyed.extend(queue.iter().map(|v| Keyed::new(v.get())));
        let keyed = hilbert_order::<G>(keyed, |v| &positions[VertexId::new(v)])?;
        queue.iter_mut().zip(&keyed).for_each(|(v, k)| *v = VertexId::new(k.item()));
        Ok(())
    }

    /// Puts the staged vertices that are not applied yet in storage order, so that each starts near the one
    /// before.
    pub(super) fn order_queue_by_site(&mut self) {
        let (site_of, kernel) = (&self.site_of, &self.kernel);
        let applied = self.staging.applied();
        let queue = &mut self.staging.vertices_mut()[applied..];
        if self.hidden.count() > 0 {
            queue.sort_unstable_by_key(|&v| site_of[v]);
            return;
        }
        // Each site has one vertex, so the sites can be sorted for them, in the same memory.
        let queue = VertexId::numbers_of_mut(queue);
        queue.iter_mut().for_each(|v| *v = site_of[*v as usize].get());
        queue.sort_unstable();
        queue.iter_mut().for_each(|s| *s = kernel.site(SiteId::new(*s)).id.get());
    }
}

#[cfg(test)]
mod tests {
    use crate::delaunay::{Dimension, Level, Plane, Space};
    use crate::ids::{SiteId, VertexId};
    use crate::motion::{Algorithm, MovingTriangulation, Options};
    use crate::predicates::squared_distance;
    use crate::random::Rng;

    /// Of more vertices than a cache near the processor holds some go anywhere, or only to near places. Returns the
    /// queue's sites, and how far one goal is from the next in the mean, in units of the box.
    fn queue_of_some<G: Dimension>(reach: f64) -> (Vec<SiteId>, f64) {
        let rng = &mut Rng::new(1);
        let n = 50_000;
        let mut points = vec![G::Point::default(); n];
        points.iter_mut().for_each(|p| (0..G::D).for_each(|axis| p[axis] = rng.unit()));
        let options = Options { algorithm: Algorithm::PlacementFlips, ..Options::default() };
        let mut t = MovingTriangulation::<G>::new(&points, options).expect("room");
        assert!(t.kernel.is_far());
        for (v, p) in VertexId::range(0..n).zip(&points).step_by(29) {
            let mut goal = *p;
            (0..G::D).for_each(|axis| goal[axis] += reach * (rng.unit() - p[axis]));
            t.move_vertices(&[v], &[goal]).expect("a good place");
        }
        t.order_queue();
        let goals: Vec<_> =
            t.staging.vertices().iter().map(|&v| (t.site_of[v], t.staging.positions()[v])).collect();
        let between = |w: &[(SiteId, G::Point)]| squared_distance(&w[0].1, &w[1].1).sqrt();
        let mean = goals.windows(2).map(between).sum::<f64>() / goals.len() as f64;
        t.commit_timestamp().expect("room");
        assert_eq!(t.validate(Level::Delaunay), Ok(()));
        let mut listed: Vec<_> = goals.iter().map(|&(s, _)| s).collect();
        let queue = listed.clone();
        listed.sort_unstable();
        listed.dedup();
        assert_eq!(listed.len(), n.div_ceil(29));
        (queue, mean)
    }

    fn leapers_are_placed_in_the_order_of_their_goals<G: Dimension>() {
        let (queue, mean) = queue_of_some::<G>(1.0);
        assert!(!queue.is_sorted() && mean < 0.12, "{mean}");
        let (queue, _) = queue_of_some::<G>(1e-3);
        assert!(queue.is_sorted());
    }

    #[test]
    fn leapers_are_placed_in_the_order_of_their_goals_in_the_plane() {
        leapers_are_placed_in_the_order_of_their_goals::<Plane>();
    }

    #[test]
    fn leapers_are_placed_in_the_order_of_their_goals_in_space() {
        leapers_are_placed_in_the_order_of_their_goals::<Space>();
    }
}
