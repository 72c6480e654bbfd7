//! One vertex at a time: relocations, insertions and removals that are visible at once.

use crate::delaunay::{Insertion, Keys, Moving, Shortcut};
use crate::error::{Error, Result};
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;
use crate::motion::algorithms::{Algorithm, Immediate};
use crate::motion::calls::hiding::ChangedParts;
use crate::motion::calls::keys::Coming;
use crate::motion::region_kind::RegionKind;
use crate::motion::report::CommitReport;
use crate::motion::state::checking::{check_position, differ};
use crate::motion::state::passings::Steps;
use crate::motion::triangulation::{MAX_VERTICES, MovingTriangulation};
use crate::motion::ways::placement::Placed;

impl<G: Moving> MovingTriangulation<G> {
    /// Moves one vertex at once, whatever is staged for others.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// t.relocate_vertex(VertexId::new(3), &[0.2, 0.2])?;
    /// assert_eq!((t.cell_count(), t.timestamp()), (3, 0));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::OutOfRange`], [`Error::NoSuchVertex`], [`Error::RemovedVertex`];
    /// [`Error::DuplicateMove`] if a move of the vertex is staged; [`Error::Coincident`] if the options reject that,
    /// [`Error::Passing`] if they refuse that; [`Error::Prepared`].
    #[inline]
    pub fn relocate_vertex(&mut self, vertex: VertexId, position: &G::Point) -> Result<()> {
        if self.relocate_within_tolerance(vertex, position) {
            return Ok(());
        }
        self.relocate_checked(vertex, position)
    }

    /// The long way of [`relocate_vertex`](Self::relocate_vertex), kept out of the short one's registers.
    #[inline(never)]
    fn relocate_checked(&mut self, vertex: VertexId, position: &G::Point) -> Result<()> {
        self.reject_prepared()?;
        self.mesh.last_found.begin();
        let s = self.present_site("vertex", 0, vertex)?;
        let q = check_position::<G>("position", 0, position)?;
        if self.staging.is_staged(vertex) {
            return Err(Error::DuplicateMove { argument: "vertex", index: 0, vertex });
        }
        let old = self.mesh.kernel.site(s).point;
        if old == q {
            return Ok(());
        }
        self.apply_passing_policy(|| Ok(Steps::One(vertex, q)))?;
        self.foreseen.prefetch_next_stars(&self.mesh, vertex);
        let before = self.mesh.evaluations();
        let mut report = CommitReport { moved: 1, ..CommitReport::default() };
        let relocate = |t: &mut Self| {
            t.mesh.reject_occupied(vertex, &q, t.options.coincidence)?;
            t.relocate_filtered(vertex, &q, &mut report)?;
            t.settle_hidden(&mut report)?;
            t.reject_shared_places()
        };
        self.transact(relocate, |t| t.mesh.kernel.set_point(t.mesh.site_of[vertex], old))?;
        self.mesh.follow_turned((old.as_ref() != q.as_ref()).then_some(vertex));
        self.enter_evaluations(&mut report, before);
        self.count(report);
        if self.options.algorithm == Algorithm::Auto && self.mesh.kernel.has_cells() {
            self.follow_relocations(&report);
        }
        let mut changed = ChangedParts::default();
        changed.count(&old, &q);
        self.tell_parts(&mut report, changed);
        Ok(())
    }

    /// Inserts a vertex; its id is one above the highest ever given, or left by the latest [`compact`](Self::compact).
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let vertex = t.insert_vertex(&[0.3, 0.3])?;
    /// assert_eq!(vertex.get(), 4);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::OutOfRange`], [`Error::TooManyVertices`], [`Error::TooManyCells`],
    /// [`Error::OutOfMemory`]; [`Error::Coincident`] if the options reject that; [`Error::Prepared`].
    pub fn insert_vertex(&mut self, position: &G::Point) -> Result<VertexId> {
        self.insert_coming(position, Coming::Ids)
    }

    /// Inserts a vertex, as [`insert_vertex`](Self::insert_vertex) does, with a key.
    ///
    /// # Errors
    /// The errors of [`insert_vertex`](Self::insert_vertex).
    pub fn insert_vertex_with_key(&mut self, position: &G::Point, key: u64) -> Result<VertexId> {
        self.insert_coming(position, Coming::Keys(&[key]))
    }

    fn insert_coming(&mut self, position: &G::Point, key: Coming<'_>) -> Result<VertexId> {
        self.reject_prepared()?;
        self.mesh.last_found.begin();
        let q = check_position::<G>("position", 0, position)?;
        if self.mesh.site_of.len() >= MAX_VERTICES {
            return Err(Error::TooManyVertices { given: self.mesh.site_of.len() + 1, limit: MAX_VERTICES });
        }
        let id = VertexId::at(self.mesh.site_of.len());
        self.staging.list()?;
        self.staging.make_room(1)?;
        memory::reserve(&mut self.mesh.site_of, 1)?;
        if let Some(known) = &mut self.mesh.known {
            known.make_room(id.index() + 1)?;
        }
        let had_keys = self.has_keys();
        self.give_keys(key, &[id], id.index() + 1)?;
        self.mesh.site_of.push(SiteId::NONE);
        let before = self.mesh.evaluations();
        let mut report = CommitReport { inserted: 1, ..CommitReport::default() };
        let insert = |t: &mut Self| {
            t.mesh.reject_occupied(id, &q, t.options.coincidence)?;
            t.insert_at(id, &q, &mut report)?;
            t.settle_hidden(&mut report)?;
            t.reject_shared_places()
        };
        let inserted = self.transact(insert, |_| {});
        if let Err(error) = inserted {
            self.mesh.site_of.pop();
            if had_keys {
                self.mesh.kernel.keys_mut().truncate(id.index());
            } else {
                *self.mesh.kernel.keys_mut() = Keys::default();
            }
            return Err(error);
        }
        self.mesh.n_present += 1;
        self.mesh.follow_turned(Some(id));
        self.staging.grow(self.mesh.site_of.len());
        // The keys of staged insertions are forgotten with them.
        let has_keys = self.edits.had_keys() || matches!(key, Coming::Keys(_));
        self.edits.know(self.mesh.site_of.len(), has_keys);
        self.enter_evaluations(&mut report, before);
        self.count(report);
        Ok(id)
    }

    /// Gives the highest of all ids a site, or a place at one.
    fn insert_at(&mut self, id: VertexId, q: &G::Point, report: &mut CommitReport) -> Result<()> {
        let s = self.mesh.kernel.add_site(*q, id)?;
        self.mesh.site_of[id] = s;
        let inserted = self.with_regions(report, |t, _| {
            // Undoing does not know of a site that is in without cells, so nothing may fail after that.
            t.regions.make_room_to_note()?;
            let inserted = t.mesh.kernel.insert_site_anywhere(s)?;
            if let Insertion::Coincident(at) = inserted {
                // Without keys the new id is the highest of all, so it is the one to hide: nothing else changes.
                t.mesh.hide(id, at)?;
            }
            t.regions.note_relocated(id)?;
            Ok(inserted)
        })?;
        if inserted == Insertion::Spans { self.rebuild_as_is(report) } else { Ok(()) }
    }

    /// Removes a vertex and its staged move, if any. Its id is not given again before a [`compact`](Self::compact).
    ///
    /// ```
    /// use deldrift::{Error, Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let vertex = VertexId::new(2);
    /// t.remove_vertex(vertex)?;
    /// assert!(matches!(t.position(vertex), Err(Error::RemovedVertex { .. })));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`], [`Error::RemovedVertex`], [`Error::OutOfMemory`], [`Error::Prepared`].
    pub fn remove_vertex(&mut self, vertex: VertexId) -> Result<()> {
        self.reject_prepared()?;
        self.mesh.last_found.begin();
        self.present_site("vertex", 0, vertex)?;
        self.staging.list()?;
        let before = self.mesh.evaluations();
        let mut report = CommitReport { removed: 1, ..CommitReport::default() };
        let remove = |t: &mut Self| {
            t.with_regions(&mut report, |t, _| t.remove_present(vertex))?;
            t.settle_hidden(&mut report)
        };
        self.transact(remove, |_| {})?;
        self.mesh.follow_turned(Some(vertex));
        self.staging.unstage(vertex);
        self.edits.forget_removal(vertex);
        self.enter_evaluations(&mut report, before);
        self.count(report);
        Ok(())
    }

    /// The short way of [`relocate_vertex`](Self::relocate_vertex): moves a vertex that certainly stays within the
    /// tolerance kept of it if nothing follows from that but a few counts. Otherwise it does nothing and says
    /// `false`; the long way finds out what is to be done, or is wrong. It cannot panic, so C needs no guard around it.
    ///
    /// No other vertex can be at the new place. All are within their tolerances, so the cells still are a triangulation
    /// when this one has moved, and positive; if two of its vertices were at one place, cells of theirs would overlap.
    ///
    /// Sites are not stored in the order of ids, so what they hold comes late. Nothing waits for it here: a vertex
    /// that is there already is moved like the others, and counts nothing.
    #[inline(always)]
    pub(crate) fn relocate_within_tolerance(&mut self, vertex: VertexId, position: &G::Point) -> bool {
        let v = vertex.index();
        // Tolerances are of the Delaunay triangulation, which has other cells beside segments, and say nothing of vertices above
        // the cells.
        let says_all = self.mesh.segments.is_none() && self.mesh.kernel.n_hidden() == 0;
        let Some(tolerances) = self.regions.tolerances().filter(|_| says_all) else {
            return false;
        };
        let (Some(s), Some(fixed)) = (self.mesh.site(vertex), tolerances.fixed().get(v)) else {
            return false;
        };
        let Ok(q) = check_position::<G>("position", 0, position) else {
            return false;
        };
        let is_auto = self.options.algorithm == Algorithm::Auto;
        let may_move = self.mesh.kernel.has_cells()
            && self.filters_by_kept(RegionKind::Tolerance)
            && fixed.holds(&q)
            && !self.staging.is_staged(vertex)
            && !self.mesh.is_shared(s)
            && self.mesh.kernel.is_covered(&q)
            && (!is_auto || self.may_count_within());
        let Some(site) = self.mesh.kernel.sites_mut().get_mut(s.index()).filter(|_| may_move) else {
            return false;
        };
        let old = std::mem::replace(&mut site.point, q);
        let moved = differ::<G>(&old, &q);
        if G::HAS_WEIGHTS {
            let mut changed = ChangedParts::default();
            changed.count(&old, &q);
            changed.add_to(&mut self.statistics);
        } else {
            self.statistics.moved += u64::from(moved);
        }
        self.statistics.within_tolerance += u64::from(moved);
        if is_auto {
            self.count_within(moved);
        }
        true
    }

    /// Moves one vertex at once, by the regions in force if there are any.
    fn relocate_filtered(&mut self, vertex: VertexId, q: &G::Point, report: &mut CommitReport) -> Result<()> {
        let Some(filter) = self.immediate_filter().filter(|_| self.mesh.kernel.has_cells()) else {
            self.regions.invalidate();
            return self.relocate_alone(vertex, q, report);
        };
        self.prepare_regions(filter, &[], report)?;
        if let Some(origin) = self.accept(vertex, q, report) {
            report.moved = 1;
            let s = self.mesh.site_of[vertex];
            return self.mesh.kernel.loosen_around(s).inspect_err(|_| self.mesh.kernel.set_point(s, origin));
        }
        match self.with_regions(report, |t, report| t.relocate_noted(vertex, q, report))? {
            Placed::InCells => Ok(()),
            Placed::NeedBuild => self.rebuild_as_is(report),
        }
    }

    /// Moves one vertex at once, without regions.
    fn relocate_alone(&mut self, vertex: VertexId, q: &G::Point, report: &mut CommitReport) -> Result<()> {
        if !self.mesh.kernel.has_cells() {
            return self.rebuild_with(vertex, q, report);
        }
        match self.mesh.relocate(vertex, q, Shortcut::Flips, report)? {
            Placed::InCells => Ok(()),
            Placed::NeedBuild => self.rebuild_as_is(report),
        }
    }

    /// Whether immediate relocations are filtered by regions of this kind, which are kept.
    #[inline(always)]
    fn filters_by_kept(&self, kept: RegionKind) -> bool {
        match self.options.algorithm.immediate() {
            Immediate::None => false,
            Immediate::By(filter) | Immediate::WhileKept(filter) => filter == kept,
            Immediate::OnceSwitched(filter) => filter == kept && self.switching.has_switched(),
        }
    }

    /// The filter in force for immediate relocations.
    fn immediate_filter(&self) -> Option<RegionKind> {
        match self.options.algorithm.immediate() {
            Immediate::None => None,
            Immediate::By(filter) => Some(filter),
            Immediate::OnceSwitched(filter) => self.switching.has_switched().then_some(filter),
            Immediate::WhileKept(filter) => self.regions.kept_for().filter(|&kept| kept == filter),
        }
    }
}
