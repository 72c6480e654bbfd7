//! The *tolerance* algorithm (report, Algorithm 1), the *safe region* algorithm (Algorithm 2) and both together.
//!
//! ```text
//! for each relocation of z to p:
//!     m_z <- p
//!     if m_z is certainly in the tolerance (safe) region of z: done
//!     else: z joins the queue
//! for each z in the queue:
//!     move z with the placement algorithm
//! for each bi-cell of a queued vertex or a new cell:
//!     its delimiter; for each vertex of it: a smaller tolerance
//! ```
//!
//! **One embedding.** The report places vertices in the embedding at *fixed* positions, T_f, and so has to
//! queue a vertex again when a new bi-cell's tolerance falls below its displacement. Here the queue is
//! worked off in the embedding at the *moving* positions: once every accepted vertex has moved, that is a
//! Delaunay triangulation by Proposition 1 (in space, with the correction in [`regions`](crate::motion::regions)),
//! the queued vertices being where they were; predicates are exact, so it stays one after each placement,
//! without checking any delimiter. So delimiters are computed once, after the last placement, and no vertex
//! is ever queued again. They are taken at the moving positions, which lie within them by construction. A
//! vertex *w* that gets a smaller tolerance is fixed again where it is: the ball around `f_w` of radius ε_w
//! holds the ball around `m_w` of radius `ε_w − |m_w − f_w|`, so
//! `(f_w, ε_w) <- (m_w, min(ε_w − |m_w − f_w|, ε'))`.
//!
//! **Certified.** Tolerances are lower bounds and displacements are compared as upper bounds
//! ([`predicates::tolerance`](crate::predicates)), so an accepted vertex *provably* changes nothing.
//!
//! **Coincident vertices** always take the queue.
//!
//! Cost: a test is a squared distance, or one for each bi-cell of the star; a queued vertex costs a
//! placement, and up to about 12 (plane) or 66 (space) delimiters, which it shares with its neighbours in
//! the queue. `examples/tolerance_share` measures both.

use crate::complex::NONE;
use crate::delaunay::{Dimension, Shortcut};
use crate::error::Result;
use crate::motion::moving::differ;
use crate::motion::placement::Placed;
use crate::motion::regions::Filter;
use crate::motion::staging::Given;
use crate::motion::staging::check_position;
use crate::motion::{Algorithm, CommitReport, MovingTriangulation};

impl<G: Dimension> MovingTriangulation<G> {
    /// Brings the staged vertices to their new positions by a filter and a queue.
    pub(in crate::motion) fn commit_by_filter(
        &mut self,
        filter: Filter,
        given: &mut Given<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        if !self.kernel.has_cells() {
            return self.rebuild_given(given, report);
        }
        self.accept_by(filter, given, report)?;
        self.place_beyond(report)
    }

    /// Moves the vertices that stay in their regions and queues the others.
    fn accept_by(
        &mut self,
        filter: Filter,
        given: &mut Given<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        if self.regions.kept_for() != Some(filter) {
            self.stage_given(given)?;
            self.pre_compute(filter, report)?;
        }
        if filter == Filter::Tolerance && self.staging.is_whole() && self.hidden.count() == 0 {
            let moved = self.move_and_queue::<false>(usize::MAX, given)?;
            report.moved += moved.expect("there is room for all in the queue");
            report.within_tolerance += (self.site_of.len() - self.staging.vertices.len()) as u64;
            return Ok(());
        }
        self.stage_given(given)?;
        self.staging.list()?;
        self.accept_listed(filter, report);
        Ok(())
    }

    /// Places the queued vertices; the regions follow.
    pub(in crate::motion) fn place_beyond(&mut self, report: &mut CommitReport) -> Result<()> {
        self.order_queue_by_site();
        self.with_regions(report, |t, report| {
            t.place_staged(report, |t, v, new, report| t.relocate_noted(v, new, report))
        })
    }

    /// Computes tolerances and delimiters unless those of the last commit are valid.
    fn pre_compute(&mut self, filter: Filter, report: &mut CommitReport) -> Result<()> {
        if self.regions.kept_for() == Some(filter) {
            return Ok(());
        }
        let (n_ids, elsewhere) = (self.site_of.len(), &self.staging.positions);
        self.regions.compute(&mut self.kernel, n_ids, filter, elsewhere, report)
    }

    /// Moves those of the listed vertices that stay in their regions, and puts them before the others.
    fn accept_listed(&mut self, filter: Filter, report: &mut CommitReport) {
        let mut vertices = std::mem::take(&mut self.staging.vertices);
        for k in self.staging.applied..vertices.len() {
            if self.accept(vertices[k], filter, report) {
                vertices.swap(self.staging.applied, k);
                self.staging.applied += 1;
            }
        }
        self.staging.vertices = vertices;
    }

    /// Moves a vertex if it stays in its region.
    #[inline(always)]
    fn accept(&mut self, vertex: u32, filter: Filter, report: &mut CommitReport) -> bool {
        let s = self.site_of[vertex as usize];
        let p = self.staging.positions[vertex as usize];
        if self.is_shared(s) {
            return false;
        }
        if filter != Filter::SafeRegion && self.regions.is_within_tolerance(vertex, &p) {
            report.within_tolerance += 1;
        } else if filter != Filter::Tolerance && self.regions.is_in_safe_region(&mut self.kernel, s, &p) {
            report.within_safe_region += 1;
        } else {
            return false;
        }
        self.kernel.cover(&p, &p);
        report.moved += u64::from(self.exchange_position(vertex));
        true
    }

    /// The short way of [`relocate_vertex`](Self::relocate_vertex): moves a vertex that certainly stays within the tolerance
    /// kept of it if nothing follows from that but a few counts. Otherwise it does nothing and says `false`; the long
    /// way finds out what is to be done, or is wrong. It cannot panic, so C needs no fence around it.
    ///
    /// No other vertex can be at the new place. All are within their tolerances, so the cells still are a triangulation
    /// when this one has moved, and positive; if two of its vertices were at one place, cells of theirs would overlap.
    ///
    /// Sites are not stored in the order of ids, so what they hold comes late. Nothing waits for it here: a vertex that is
    /// there already is moved like the others, and counts nothing.
    #[inline(always)]
    pub(crate) fn relocate_within_tolerance(&mut self, vertex: u32, position: &G::Point) -> bool {
        let v = vertex as usize;
        let (Some(&s), Some(fixed)) = (self.site_of.get(v), self.regions.fixed().get(v)) else {
            return false;
        };
        let Ok(q) = check_position::<G>("position", 0, position) else {
            return false;
        };
        let is_auto = self.options.algorithm == Algorithm::Auto;
        let may_move = self.kernel.has_cells()
            && self.regions.kept_for() == Some(Filter::Tolerance)
            && self.filter() == Some(Filter::Tolerance)
            && fixed.holds(&q)
            && !self.staging.is_staged(vertex)
            && (self.hidden.count() == 0 || s != NONE && !self.is_shared(s))
            && self.kernel.is_covered(&q)
            && !(is_auto && self.is_round_ending());
        // A removed vertex has no site.
        let Some(site) = self.kernel.sites_mut().get_mut(s as usize).filter(|_| may_move) else {
            return false;
        };
        let old = std::mem::replace(&mut site.point, q);
        let moved = u64::from(differ::<G>(&old, &q));
        self.statistics.moved += moved;
        self.statistics.within_tolerance += moved;
        if is_auto {
            self.count_within(moved);
        }
        true
    }

    /// Moves one vertex at once, by the filter in force if there is one.
    pub(in crate::motion) fn relocate_filtered(
        &mut self,
        vertex: u32,
        q: &G::Point,
        report: &mut CommitReport,
    ) -> Result<()> {
        let Some(filter) = self.filter().filter(|_| self.kernel.has_cells()) else {
            self.regions.invalidate();
            return self.relocate_alone(vertex, q, report);
        };
        self.pre_compute(filter, report)?;
        self.staging.grow_for(self.site_of.len())?;
        self.staging.positions[vertex as usize] = *q;
        if self.accept(vertex, filter, report) {
            report.moved = 1;
            return Ok(());
        }
        match self.with_regions(report, |t, report| t.relocate_noted(vertex, q, report))? {
            Placed::InCells => Ok(()),
            Placed::BesideFlat => self.rebuild_as_is(report),
        }
    }

    /// Moves one vertex at once, without a filter.
    fn relocate_alone(&mut self, vertex: u32, q: &G::Point, report: &mut CommitReport) -> Result<()> {
        if !self.kernel.has_cells() {
            return self.rebuild_with(vertex, q, report);
        }
        match self.relocate(vertex, q, Shortcut::Flips, report)? {
            Placed::InCells => Ok(()),
            Placed::BesideFlat => self.rebuild_as_is(report),
        }
    }

    /// Relocates a vertex; the regions are told.
    pub(in crate::motion) fn relocate_noted(
        &mut self,
        vertex: u32,
        q: &G::Point,
        report: &mut CommitReport,
    ) -> Result<Placed> {
        // Who fails after the relocation would have to take it back.
        self.regions.make_room_to_note()?;
        let placed = self.relocate(vertex, q, Shortcut::Flips, report)?;
        self.regions.note_relocated(vertex)?;
        Ok(placed)
    }

    /// The filter of the algorithm in force.
    fn filter(&self) -> Option<Filter> {
        match self.options.algorithm {
            Algorithm::Tolerance => Some(Filter::Tolerance),
            Algorithm::RebuildingTolerance => self.switching.has_switched().then_some(Filter::Tolerance),
            Algorithm::SafeRegion => Some(Filter::SafeRegion),
            Algorithm::SafeRegionTolerance => Some(Filter::Both),
            Algorithm::Auto => self.regions.kept_for().filter(|&kept| kept == Filter::Tolerance),
            _ => None,
        }
    }
}
