//! *Placement* (report, section 3.1), with the improvements for small displacements of section 3.2.
//!
//! Vertices are relocated one at a time, each by a walk from its old place, from the vertex placed before it, or from a
//! landmark, whichever is nearest: in storage order, or, where many go far away, in that of their goals along a Hilbert
//! curve, so that what an insertion reads has been read by the one before. (One in twenty of a million vertices that go
//! anywhere take half the time so in the plane, and three quarters in space.) In between, some vertices are at their
//! new and some at their old positions: two may meet that are never at the same place at a timestamp; they share a site
//! for that while. All is done by one thread.

use crate::delaunay::order::{Keyed, hilbert_order};
use crate::delaunay::{Insertion, Moving, Relocation, Shortcut};
use crate::error::{Error, Result};
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;
use crate::machine::prefetch::prefetch;
use crate::motion::plan::budget::Budget;
use crate::motion::report::CommitReport;
use crate::motion::state::goals::{Goals, Movers, Moves};
use crate::motion::state::mesh::Mesh;
use crate::motion::triangulation::MovingTriangulation;

/// Relocations between two calls of the monitor.
const RELOCATIONS_PER_CALL: usize = 256;

/// Vertices looked at to find out whether many go far away.
const SAMPLE: usize = 64;

/// Many vertices go far away if more than one in this number does.
const AWAY_SHARE: usize = 4;

/// Where a vertex has been placed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum Placed {
    /// In a triangulation, or in a set of sites that spans no cell.
    InCells,
    /// All have to be built: it is outside the hyperplane of all others, so that there are cells again, or it would
    /// take longer to place those that are left.
    NeedBuild,
}

impl<G: Moving> MovingTriangulation<G> {
    /// Relocates the vertices one after the other.
    pub(in crate::motion) fn commit_by_placement(
        &mut self,
        shortcut: Shortcut,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        let (queue, goals) = self.queue_for_placement(moves)?;
        self.place_all(&queue, goals, report, |t, v, goal, report| {
            t.mesh.relocate(v, goal, shortcut, report)
        })?;
        self.queue = queue;
        Ok(())
    }

    /// Relocates the vertices one after the other, with flips, and rebuilds where what is left would take longer than
    /// that.
    pub(in crate::motion) fn commit_by_placement_or_rebuilding(
        &mut self,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        let (queue, goals) = self.queue_for_placement(moves)?;
        self.place_within_budget(&queue, goals, 0, report, Self::relocate_by_flips)?;
        self.queue = queue;
        Ok(())
    }

    /// Relocates a vertex; regions are not told.
    pub(in crate::motion) fn relocate_by_flips(
        &mut self,
        vertex: VertexId,
        q: &G::Point,
        report: &mut CommitReport,
    ) -> Result<Placed> {
        self.mesh.relocate(vertex, q, Shortcut::Flips, report)
    }

    /// Relocates these vertices, with flips, while that costs less than to rebuild; after a sweep with `exact` exact
    /// evaluations, or none.
    pub(in crate::motion) fn place_within_budget(
        &mut self,
        queue: &[VertexId],
        goals: Goals<'_, G>,
        exact: u64,
        report: &mut CommitReport,
        mut relocate: impl FnMut(&mut Self, VertexId, &G::Point, &mut CommitReport) -> Result<Placed>,
    ) -> Result<()> {
        let (left, slowdown) = (queue.len(), self.mesh.slowdown(1.0));
        let mut budget = Budget::new(
            self.mesh.constants,
            self.mesh.n_present,
            left,
            exact,
            self.mesh.evaluations(),
            report,
            slowdown,
        );
        self.place_all(queue, goals, report, |t, v, goal, report| {
            let placed = relocate(t, v, goal, report)?;
            Ok(if budget.is_exceeded(t.mesh.evaluations(), report) { Placed::NeedBuild } else { placed })
        })
    }

    fn queue_for_placement<'p>(&mut self, moves: &mut Moves<'p, G>) -> Result<(Vec<VertexId>, Goals<'p, G>)> {
        let goals = moves.checked()?;
        let mut queue = self.queue_of(moves)?;
        self.regions.invalidate();
        self.mesh.order_for_placement(&mut queue, goals);
        Ok((queue, goals))
    }

    /// The vertices that are to move, in the memory of queues.
    pub(in crate::motion) fn queue_of(&mut self, moves: &Moves<'_, G>) -> Result<Vec<VertexId>> {
        let mut queue = std::mem::take(&mut self.queue);
        queue.clear();
        memory::reserve(&mut queue, moves.count())?;
        match moves.movers() {
            Movers::All => queue.extend(VertexId::range(0..moves.count())),
            Movers::Listed(vertices) => queue.extend_from_slice(vertices),
        }
        Ok(queue)
    }

    /// Relocates these vertices, which are where they were when the commit began, one after the other.
    pub(in crate::motion) fn place_all(
        &mut self,
        queue: &[VertexId],
        goals: Goals<'_, G>,
        report: &mut CommitReport,
        mut relocate: impl FnMut(&mut Self, VertexId, &G::Point, &mut CommitReport) -> Result<Placed>,
    ) -> Result<()> {
        let (n_there, n) = (goals.n_movers() - queue.len(), goals.n_movers() as f64);
        let is_far = self.mesh.kernel.is_far();
        self.mesh.transaction.origins_mut().make_room(self.mesh.site_of.len(), queue.len())?;
        for (k, &v) in queue.iter().enumerate() {
            if !self.mesh.kernel.has_cells() {
                // Nothing to walk in: what is left is placed at once.
                return self.rebuild_moving(&queue[k..], goals, report);
            }
            let is_call_due = k.is_multiple_of(RELOCATIONS_PER_CALL);
            if is_call_due && !self.mesh.monitor((n_there + k) as f64 / n) {
                return Err(Error::Cancelled);
            }
            if is_far {
                self.mesh.prefetch_queued(&queue[k + 1..], goals);
            }
            let (old, goal) = (self.mesh.kernel.site(self.mesh.site_of[v]).point, goals.read(v)?);
            if goal == old {
                continue;
            }
            report.moved += 1;
            self.mesh.transaction.origins_mut().note(v, old);
            if relocate(self, v, &goal, report)? == Placed::NeedBuild {
                return self.rebuild_moving(&queue[k + 1..], goals, report);
            }
        }
        Ok(())
    }
}

impl<G: Moving> Mesh<G> {
    /// Asks for what the next relocations will read: vertices that move are far from each other where they are few.
    #[inline(always)]
    fn prefetch_queued(&self, next: &[VertexId], goals: Goals<'_, G>) {
        for step in 0..4 {
            if let Some(&v) = next.get(2 * (4 - step) - 1) {
                self.kernel.prefetch_star(self.site_of[v], step);
            }
        }
        if let Some(&v) = next.get(9) {
            prefetch(&self.site_of, v.index());
            goals.prefetch(v);
        }
    }

    /// Relocates a vertex; the maps of sites and hidden vertices follow.
    pub(in crate::motion) fn relocate(
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
            Insertion::New | Insertion::Hidden(_) => {}
            Insertion::Coincident(t) => self.hide(vertex, t)?,
            Insertion::Spans => return Ok(Placed::NeedBuild),
        }
        Ok(Placed::InCells)
    }

    /// Puts vertices in the order in which to relocate them: that of their goals along a Hilbert curve if many go far
    /// away and the caches do not hold all; that of storage otherwise, and where there is no memory for the other.
    pub(in crate::motion) fn order_for_placement(&self, queue: &mut [VertexId], goals: Goals<'_, G>) {
        let is_worth = self.kernel.is_far() && self.goals_are_away(queue, goals);
        if !is_worth || order_by_goal(queue, goals).is_err() {
            self.order_by_site(queue);
        }
    }

    /// Whether there are enough of these vertices for a sample, and many of them go far away, which shows in a sample.
    fn goals_are_away(&self, queue: &[VertexId], goals: Goals<'_, G>) -> bool {
        if !self.kernel.has_cells() || queue.len() < SAMPLE {
            return false;
        }
        let is_away = |&&v: &&VertexId| self.kernel.is_away(self.site_of[v], &goals.of(v));
        let sample = queue.iter().step_by(queue.len() / SAMPLE);
        sample.clone().filter(is_away).count() * AWAY_SHARE >= sample.len()
    }

    /// Puts vertices in storage order, so that each starts near the one before.
    pub(in crate::motion) fn order_by_site(&self, queue: &mut [VertexId]) {
        let (site_of, kernel) = (&self.site_of, &self.kernel);
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

/// Puts vertices in the order of their goals along a Hilbert curve.
fn order_by_goal<G: Moving>(queue: &mut [VertexId], goals: Goals<'_, G>) -> Result<()> {
    let mut keyed = Vec::new();
    memory::reserve_exact(&mut keyed, queue.len())?;
    keyed.extend(queue.iter().map(|v| Keyed::new(v.get())));
    let keyed = hilbert_order::<G>(keyed, |v| &goals.positions()[VertexId::new(v)])?;
    queue.iter_mut().zip(&keyed).for_each(|(v, k)| *v = VertexId::new(k.item()));
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::delaunay::{Level, Moving, Plane, Space};
    use crate::ids::{SiteId, VertexId};
    use crate::motion::algorithms::Algorithm;
    use crate::motion::options::Options;
    use crate::motion::triangulation::MovingTriangulation;
    use crate::predicates::squared_distance;
    use crate::random::Rng;

    /// Of more vertices than a cache near the processor holds some go anywhere, or only to near places. Returns the
    /// queue's sites, and how far one goal is from the next in the mean, in units of the box.
    fn queue_of_some<G: Moving>(reach: f64) -> (Vec<SiteId>, f64) {
        let rng = &mut Rng::new(1);
        let n = 50_000;
        let mut points = vec![G::Point::default(); n];
        points.iter_mut().for_each(|p| (0..G::D).for_each(|axis| p[axis] = rng.unit()));
        let options = Options { algorithm: Algorithm::PlacementFlips, ..Options::default() };
        let mut t = MovingTriangulation::<G>::new(&points, options).expect("room");
        assert!(t.mesh.kernel.is_far());
        for (v, p) in VertexId::range(0..n).zip(&points).step_by(29) {
            let mut goal = *p;
            (0..G::D).for_each(|axis| goal[axis] += reach * (rng.unit() - p[axis]));
            t.move_vertices(&[v], &[goal]).expect("a good place");
        }
        let mut staging = std::mem::take(&mut t.staging);
        let (queue, goals) = t.queue_for_placement(&mut staging.moves(n)).expect("room");
        let goals: Vec<_> = queue.iter().map(|&v| (t.mesh.site_of[v], goals.of(v))).collect();
        t.staging = staging;
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

    fn leapers_are_placed_in_the_order_of_their_goals<G: Moving>() {
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
