//! *Repair*: move everything at once, look at every certificate once, and mend what broke.
//!
//! ```text
//! move all vertices
//! where few vertices have moved, take these back and place them one by one; no sweep
//! rebuild if a sample of the cells foretells that this is faster; where some vertices have moved and nearly all around
//!     them fails, take these back and place them one by one
//! sweep: orientation of every cell, empty sphere of every facet, convexity of every ridge of the hull
//! take vertices of inverted cells back that have gone farther than the cell reaches
//! where a cell is inverted or a ridge is not convex: untangle them by flips, and take a vertex back to its old place where
//!     a cell or a ridge cannot be flipped; if that does not make all right, undo the flips, and again with these vertices
//!     back; if it never does, take vertices back, one of each cell or ridge, until all are right
//! flip until no facet fails, and triangulate small cavities where flips are stuck
//! if some still are, undo all flips, take a vertex of each back, and again
//! place the vertices that were taken back, one by one
//! ```
//!
//! Where flips are stuck after it, untangling is undone and not tried any more. Where it fails and many facets fail,
//! all is rebuilt: flips would be stuck among what is placed. Invariant: with every vertex taken back all is as before
//! the commit, so taking back comes to an end; and when it has, the cells are the Delaunay triangulation of the
//! vertices where they are ([`Failures`](crate::delaunay::Failures) has the argument). Of a certificate's vertices the
//! one that moved farthest is taken back, so that a vertex that jumps across the domain goes first.
//!
//! Cost (`examples/tolerance_share`, 10,000 points): a sweep, moves included, is a fourteenth of a rebuild in
//! the plane and a nineteenth in space; a vertex taken back costs a placement, some eight vertices rebuilt.
//! Where more break than is worth mending, the triangulation is rebuilt, at once where that is foreseen
//! ([`foresight`](super::foresight)). The first repair after a build sorts the cells of a large triangulation, and so
//! does another when twice as many have been replaced. Moving all vertices, finding those that have moved, the sweep
//! and the flips are done by several threads, all else by one.

use crate::delaunay::{CERTIFICATES_PER_EXACT, Delaunay, Moving};
use crate::error::{Error, Result};
use crate::ids::SiteId;
use crate::machine::memory;
use crate::machine::prefetch::{AHEAD, prefetch};
use crate::motion::plan::budget::REPAIRED_ALONE;
use crate::motion::report::CommitReport;
use crate::motion::state::goals::{Goals, Moves};
use crate::motion::state::mesh::Mesh;
use crate::motion::state::places::At;
use crate::motion::state::repair::Repair;
use crate::motion::triangulation::MovingTriangulation;
use crate::motion::ways::attempt::Start;
use crate::motion::ways::repair::{Mending, Prospect};
use crate::predicates::exact_calls;

/// Times that flips may be stuck before the triangulation is rebuilt.
const MAX_ROUNDS: usize = 8;

/// Times that cells are untangled, each time with more vertices taken back before.
const MAX_UNTANGLINGS: usize = 4;

impl<G: Moving> MovingTriangulation<G> {
    /// Brings the vertices to their goals by a sweep and repair of what failed. Those that are there already may be
    /// taken back like the others.
    pub(in crate::motion) fn commit_by_repair(
        &mut self,
        start: Start,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        if !self.mesh.kernel.has_cells() {
            return self.rebuild(moves, report);
        }
        self.regions.invalidate();
        let mut repair = memory::take_made(&mut self.repair)?;
        let done = self.move_and_repair(&mut repair, start, moves, report);
        self.repair = Some(repair);
        done
    }

    fn move_and_repair(
        &mut self,
        repair: &mut Repair,
        start: Start,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        self.begin_moves(repair)?;
        match start {
            Start::AtGoals { n_moved } => self.note_all_moved(repair, n_moved),
            Start::AtOrigins if self.mesh.moves_in_one_loop(moves) => {
                let n_moved = self.mesh.move_everything(moves)?;
                self.note_all_moved(repair, n_moved);
            }
            Start::AtOrigins => self.move_queued(repair, moves)?,
        }
        let goals = moves.checked()?;
        repair.failures.is_sweep_due = true;
        let accepted = report.moved;
        let mended = if repair.places.n_new == 0 {
            // No vertex of the cells has moved.
            self.settle(repair, goals);
            report.moved = 0;
            Mending::Mended
        } else {
            self.mend(repair, goals, report)?
        };
        report.unchanged += report.moved.saturating_sub(accepted);
        if mended == Mending::TooMuch {
            return self.rebuild_moving(&repair.places.queue, goals, report);
        }
        self.mesh.transaction.want_order();
        self.place_within_budget(&repair.places.queue, goals, repair.exact, report, Self::relocate_by_flips)
    }

    /// Mends a triangulation all vertices of which have been moved, as [`commit_by_repair`](Self::commit_by_repair)
    /// does, after a check that has found failures. Those to be placed are in the [queue](Repair::queue).
    pub(in crate::motion) fn mend_moved(
        &mut self,
        repair: &mut Repair,
        goals: Goals<'_, G>,
        report: &mut CommitReport,
    ) -> Result<Mending> {
        self.begin_moves(repair)?;
        self.note_all_moved(repair, report.moved);
        self.mend(repair, goals, report)
    }

    /// Takes back what must be, and flips.
    fn mend(
        &mut self,
        repair: &mut Repair,
        goals: Goals<'_, G>,
        report: &mut CommitReport,
    ) -> Result<Mending> {
        let mended = self.mend_failures(repair, report);
        self.settle(repair, goals);
        report.moved = repair.places.n_new as u64;
        mended
    }

    fn mend_failures(&mut self, repair: &mut Repair, report: &mut CommitReport) -> Result<Mending> {
        let constants = self.mesh.constants;
        let per_placement = self.mesh.slowdown(REPAIRED_ALONE) * constants.rebuilt_per_placement as f64;
        let most = (self.mesh.n_present as f64 / per_placement) as usize;
        if repair.failures.is_sweep_due && constants.are_few(repair.places.n_new, self.mesh.n_present) {
            self.take_all_back(repair)?;
            return Ok(Mending::Mended);
        }
        if repair.failures.is_sweep_due {
            match self.sweep(repair, constants.failures_per_placement * most)? {
                Prospect::Mendable => {}
                Prospect::Placeable => {
                    self.take_all_back(repair)?;
                    return Ok(Mending::Mended);
                }
                Prospect::TooMuch => return Ok(Mending::TooMuch),
            }
        }
        if !self.mesh.monitor(0.5) {
            return Err(Error::Cancelled);
        }
        // A rebuild's exact evaluations, too.
        let exact_of_rebuild = (constants.exact_per_swept * repair.exact as f64) as u64;
        let most_spent = self.spent()
            + constants.certified_per_vertex * self.mesh.n_present as u64
            + CERTIFICATES_PER_EXACT * exact_of_rebuild;
        // All facets of a star that is taken back are listed.
        let n_failing = repair.failures.facets.len();
        if self.take_leapers_back(repair, most)? == Prospect::TooMuch
            || !self.is_worth_going_on(repair, n_failing)
        {
            return Ok(Mending::TooMuch);
        }
        let mut is_triangulation = repair.failures.is_triangulation();
        for round in 0..MAX_ROUNDS {
            if !self.mesh.monitor(0.5) {
                return Err(Error::Cancelled);
            }
            repair.suspects.clear();
            is_triangulation = is_triangulation || round == 0 && self.untangle(repair, most)?;
            if !is_triangulation {
                let is_mended = self.is_worth_placing(n_failing)
                    && self.take_back_failed(repair, most)? == Prospect::Mendable
                    && self.winds_once(repair)?;
                if !is_mended {
                    return Ok(Mending::TooMuch);
                }
            }
            memory::reserve(&mut repair.suspects, repair.failures.facets.len())?;
            repair.suspects.extend_from_slice(&repair.failures.facets);
            let left = most_spent.saturating_sub(self.spent());
            let flips = self.mesh.kernel.flip_all(&mut repair.suspects, &mut repair.stuck, left)?;
            let Some(flips) = flips else {
                self.mesh.kernel.undo_flips();
                return Ok(Mending::TooMuch);
            };
            if repair.stuck.is_empty() {
                report.flips += flips;
                return Ok(Mending::Mended);
            }
            let listed = self.list_stuck(repair);
            self.mesh.kernel.undo_flips();
            listed?;
            if repair.sites.is_empty() {
                return Ok(Mending::TooMuch);
            }
            is_triangulation = false;
            self.take_back_listed(repair)?;
        }
        Ok(Mending::TooMuch)
    }

    /// What has been evaluated so far, in certificates.
    fn spent(&self) -> u64 {
        self.mesh.kernel.certificates() + CERTIFICATES_PER_EXACT * exact_calls()
    }

    /// Whether so few facets fail that vertices may be taken back, and placed, besides.
    fn is_worth_placing(&self, n_failing: usize) -> bool {
        let n_cells = self.mesh.kernel.complex().n_finite() as f64;
        n_failing as f64 <= self.mesh.constants.max_failing * n_cells
    }

    /// Makes the cells a triangulation by flips, if that can be done with at most this number of vertices taken back;
    /// what has failed is listed as before.
    fn untangle(&mut self, repair: &mut Repair, most_back: usize) -> Result<bool> {
        if repair.failures.cells.is_empty() {
            self.check_ridges(repair)?;
            if repair.failures.ridges.is_empty() {
                return self.winds_once(repair);
            }
        }
        // Where it can be done it takes less on lattices, of which small ones have the larger share of flat cells.
        let most = 2 * self.mesh.kernel.n_certificates();
        let before = self.mesh.kernel.certificates();
        for _ in 0..MAX_UNTANGLINGS {
            let n_back = repair.places.queue.len();
            if self.untangle_once(repair, most, most_back)? {
                return Ok(true);
            }
            // With those back from the start, other cells are exchanged.
            let is_hopeless = repair.places.queue.len() == n_back;
            if is_hopeless || self.mesh.kernel.certificates() - before > most / 2 {
                break;
            }
            self.check_taken_back(repair)?;
        }
        Ok(false)
    }

    /// Makes the cells a triangulation by flips, as they are now, if that can be done in at most `most` certificates
    /// and with at most `most_back` vertices taken back.
    fn untangle_once(&mut self, repair: &mut Repair, most: u64, most_back: usize) -> Result<bool> {
        let Mesh { kernel, transaction, .. } = &mut self.mesh;
        let origins = transaction.origins();
        let Repair { failures, suspects, places, .. } = repair;
        let first = places.queue.len();
        let mut take_back = |kernel: &mut Delaunay<G>, sites: &[SiteId]| {
            let s = places.farthest(kernel, origins, sites).filter(|_| places.queue.len() < most_back);
            s.map_or(Ok(()), |s| places.take_back(kernel, origins, s)).map(|()| s)
        };
        let is_done = kernel.untangle(failures, suspects, most, &mut take_back);
        places.unchecked = first..places.queue.len();
        if !is_done? {
            return Ok(false);
        }
        let checked = self.check_untangled(repair);
        if checked != Ok(true) {
            self.mesh.kernel.undo_flips();
            repair.suspects.clear();
        }
        checked
    }

    /// Whether the hull of cells that have been untangled winds once. There is room for all suspects then.
    fn check_untangled(&mut self, repair: &mut Repair) -> Result<bool> {
        let Repair { failures, suspects, .. } = repair;
        memory::reserve(suspects, failures.facets.len())?;
        self.mesh.kernel.list_ghosts(&mut failures.ghosts)?;
        let winds_once = self.mesh.kernel.winds_once(&failures.ghosts);
        failures.ghosts.clear();
        Ok(winds_once)
    }

    /// Whether a convex hull winds once.
    fn winds_once(&mut self, repair: &mut Repair) -> Result<bool> {
        let failures = &mut repair.failures;
        if !failures.may_wind_twice {
            return Ok(true);
        }
        if failures.ghosts.is_empty() {
            self.mesh.kernel.list_ghosts(&mut failures.ghosts)?;
        }
        Ok(self.mesh.kernel.winds_once(&failures.ghosts))
    }

    /// A repair begins.
    fn begin_moves(&mut self, repair: &mut Repair) -> Result<()> {
        repair.places.begin(self.mesh.site_of.len())?;
        (repair.exact, repair.share_failing, repair.was_foreseen) = (0, 0.0, false);
        Ok(())
    }

    /// Notes that all vertices have been moved, this number of them to another place.
    fn note_all_moved(&mut self, repair: &mut Repair, n_moved: u64) {
        repair.places.at.resize(self.mesh.site_of.len(), At::New);
        repair.places.n_new = n_moved as usize;
    }

    /// Moves the vertices that have sites of their own, one by one, and queues the others.
    fn move_queued(&mut self, repair: &mut Repair, moves: &mut Moves<'_, G>) -> Result<()> {
        let goals = moves.checked()?;
        let movers = self.queue_of(moves)?;
        let (places, origins) = (&mut repair.places, self.mesh.transaction.origins_mut());
        places.at.resize(self.mesh.site_of.len(), At::Rest);
        // At shared places there are the hidden vertices, and no more representatives than these.
        memory::reserve(&mut places.queue, movers.len().min(2 * self.mesh.hidden.count()))?;
        origins.make_room(self.mesh.site_of.len(), movers.len())?;
        // Sites are asked for in advance, as they are in another order than the vertices.
        let site_of = &self.mesh.site_of[..];
        let (mut lower, mut upper) = (self.mesh.kernel.lower(), self.mesh.kernel.upper());
        let sites = self.mesh.kernel.sites_mut();
        for (k, &v) in movers.iter().enumerate() {
            if let Some(&next) = movers.get(k + AHEAD) {
                prefetch(sites, site_of[next].index());
            }
            let s = site_of[v];
            if self.mesh.hidden.is_followed(sites[s].id) {
                places.at[v] = At::Old;
                places.queue.push(v);
                continue;
            }
            let goal = goals.of(v);
            for axis in 0..G::D {
                lower[axis] = if goal[axis] < lower[axis] { goal[axis] } else { lower[axis] };
                upper[axis] = if goal[axis] > upper[axis] { goal[axis] } else { upper[axis] };
            }
            let point = &mut sites[s].point;
            if *point != goal {
                origins.note(v, *point);
                *point = goal;
                places.at[v] = At::New;
                places.n_new += 1;
            }
        }
        self.mesh.kernel.cover(&lower, &upper);
        self.queue = movers;
        Ok(())
    }

    /// Orders the vertices that are to be placed.
    fn settle(&mut self, repair: &mut Repair, goals: Goals<'_, G>) {
        self.mesh.order_for_placement(&mut repair.places.queue, goals);
    }
}
