//! Insertions and removals that wait for the next commit, with the moves.
//!
//! A staged insertion gets its id at once; the vertex is present from the commit on. The commit removes and inserts
//! first, at the positions before, and then moves the vertices by the algorithm in force; where many vertices come or
//! go, or those that go have more neighbours in all than there are vertices, it rebuilds. Either way all of it is one
//! transaction.

use crate::delaunay::order::{Keyed, hilbert_order};
use crate::delaunay::{Delaunay, Insertion, Keys, Moving};
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::calls::keys::Coming;
use crate::motion::report::CommitReport;
use crate::motion::state::goals::{Goals, Movers, Moves};
use crate::motion::triangulation::MovingTriangulation;
use crate::motion::ways::rebuilding::move_to;

/// What has become of the staged insertions and removals.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum Edited {
    /// There were none, or they have been made one by one; no vertex has moved.
    WithoutMoves,
    /// A kernel has been built with them, and with all vertices at their goals.
    WithMoves,
}

/// What has become of edits that are made one by one.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SingleEdits {
    /// All have been made.
    Made,
    /// A vertex has left the hyperplane of all others, or more takes longer than a build: a kernel has to be built.
    /// Some have been made, and have to be undone.
    NeedBuild,
}

impl<G: Moving> MovingTriangulation<G> {
    /// Stages the insertion of vertices, all of them or, on an error, none; returns the id of the first, which those
    /// of the others follow. They are present from the next commit on.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let first = t.stage_insertions(&[[0.4, 0.5], [0.6, 0.5]])?;
    /// assert_eq!((first.get(), t.staged_edits(), t.is_present(first)), (4, (2, 0), false));
    /// t.commit_timestamp()?;
    /// assert_eq!((t.is_present(first), t.vertex_count()), (true, 6));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`](crate::Error::NotFinite), [`Error::OutOfRange`](crate::Error::OutOfRange),
    /// [`Error::TooManyVertices`](crate::Error::TooManyVertices), [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn stage_insertions(&mut self, positions: &[G::Point]) -> Result<VertexId> {
        self.stage_coming(positions, Coming::Ids)
    }

    /// Stages the removal of vertices, all of them or, on an error, none. Moves staged for them are forgotten, and no
    /// more can be staged.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// t.stage_removals(&[VertexId::new(3)])?;
    /// let report = t.commit_timestamp()?;
    /// assert_eq!((report.removed, t.vertex_count(), t.cell_count()), (1, 3, 1));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`](crate::Error::NoSuchVertex), [`Error::RemovedVertex`](crate::Error::RemovedVertex);
    /// [`Error::StagedVertex`](crate::Error::StagedVertex) if the removal is staged already, or the insertion;
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn stage_removals(&mut self, vertices: &[VertexId]) -> Result<()> {
        self.staging.list()?;
        self.edits.reserve_removals(vertices.len(), self.mesh.site_of.len())?;
        let before = self.edits.removals().len();
        for (index, &vertex) in vertices.iter().enumerate() {
            if let Err(error) = self.site_of_vertex("vertices", index, vertex) {
                self.edits.truncate_removals(before);
                return Err(error);
            }
            self.edits.remove(vertex);
        }
        vertices.iter().for_each(|&vertex| self.staging.unstage(vertex));
        Ok(())
    }

    /// The id of a staged insertion.
    pub(in crate::motion) fn coming(&self, k: usize) -> VertexId {
        self.edits.insertions()[k].0
    }

    /// Number of staged insertions and removals.
    pub fn staged_edits(&self) -> (usize, usize) {
        (self.edits.insertions().len(), self.edits.removals().len())
    }

    /// Forgets what waits. Ids that were given last are given back.
    pub(in crate::motion) fn discard_edits(&mut self) {
        let n_known = self.edits.n_known();
        if self.edits.has_insertions() && !self.edits.had_keys() {
            *self.mesh.kernel.keys_mut() = Keys::default();
        }
        for id in self.edits.forget_insertions() {
            if id.index() >= n_known && id.index() + 1 == self.mesh.site_of.len() {
                self.mesh.site_of.pop();
            }
        }
        self.mesh.kernel.keys_mut().truncate(self.mesh.site_of.len());
        self.staging.shrink(self.mesh.site_of.len());
        self.edits.clear();
    }

    /// The edits have been made.
    pub(in crate::motion) fn end_edits(&mut self) {
        self.edits.clear();
    }

    /// Makes all edits, and all moves as well where a kernel is built for them.
    pub(in crate::motion) fn make_edits(
        &mut self,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<Edited> {
        if self.edits.are_none() {
            return Ok(Edited::WithoutMoves);
        }
        let n_edits = self.edits.insertions().len().max(self.edits.removals().len());
        if self.mesh.kernel.has_cells()
            && self.mesh.constants.rebuilt_per_edit * n_edits <= self.mesh.n_present
        {
            if self.edit_cells(report)? == SingleEdits::Made {
                return Ok(Edited::WithoutMoves);
            }
            // Once more from the beginning.
            self.undo();
            self.mesh.begin(self.mesh.aim())?;
            (report.inserted, report.removed) = (0, 0);
        }
        self.rebuild_edited(moves, report)?;
        Ok(Edited::WithMoves)
    }

    /// Removes and inserts one vertex after the other.
    fn edit_cells(&mut self, report: &mut CommitReport) -> Result<SingleEdits> {
        let insertions = self.ordered_insertions()?;
        self.with_regions(report, |t, report| {
            let mut most_link_sites = None;
            for k in 0..t.edits.removals().len() {
                let vertex = t.edits.removals()[k];
                if !t.remove_unless_high(vertex)? {
                    let most = match most_link_sites {
                        Some(most) => most,
                        None if t.are_links_too_large(k)? => return Ok(SingleEdits::NeedBuild),
                        None => *most_link_sites.insert(t.mesh.kernel.link_sites() + t.mesh.n_present as u64),
                    };
                    if t.mesh.kernel.link_sites() > most {
                        return Ok(SingleEdits::NeedBuild);
                    }
                    t.remove_present(vertex)?;
                }
                report.removed += 1;
            }
            let mut near = Slot::NONE;
            for (id, q) in insertions {
                let s = t.mesh.kernel.add_site(q, id)?;
                t.mesh.log_vertex(id)?;
                t.mesh.site_of[id] = s;
                match t.mesh.kernel.insert_site(s, near)? {
                    Insertion::New => near = t.mesh.kernel.site(s).cell,
                    Insertion::Coincident(at) => t.mesh.hide(id, at)?,
                    Insertion::Spans => return Ok(SingleEdits::NeedBuild),
                }
                t.mesh.n_present += 1;
                t.regions.note_relocated(id)?;
                report.inserted += 1;
            }
            Ok(SingleEdits::Made)
        })
    }

    /// Takes a vertex out.
    pub(in crate::motion) fn remove_present(&mut self, vertex: VertexId) -> Result<()> {
        let s = self.mesh.site_of[vertex];
        self.mesh.log_vertex(vertex)?;
        if self.mesh.is_shared(s) {
            self.mesh.leave(vertex)?;
        } else {
            self.mesh.kernel.remove_site(s)?;
        }
        self.note_removed(vertex);
        Ok(())
    }

    /// Takes a vertex out unless its degree is high; whether it has.
    fn remove_unless_high(&mut self, vertex: VertexId) -> Result<bool> {
        let s = self.mesh.site_of[vertex];
        if self.mesh.is_shared(s) {
            self.remove_present(vertex)?;
            return Ok(true);
        }
        self.mesh.log_vertex(vertex)?;
        if !self.mesh.kernel.remove_site_unless_high(s)? {
            return Ok(false);
        }
        self.note_removed(vertex);
        Ok(true)
    }

    fn note_removed(&mut self, vertex: VertexId) {
        self.mesh.site_of[vertex] = SiteId::NONE;
        self.mesh.n_present -= 1;
    }

    /// Whether to triangulate the links of those vertices of high degree that are still to be removed, from the `k`-th
    /// removal on, takes longer than to build all: whether they have more sites.
    #[cold]
    fn are_links_too_large(&mut self, k: usize) -> Result<bool> {
        let mut n_sites = 0;
        for k in k..self.edits.removals().len() {
            let s = self.mesh.site_of[self.edits.removals()[k]];
            if !self.mesh.is_shared(s) {
                n_sites += self.mesh.kernel.link_sites_of(s)?;
            }
            if n_sites > self.mesh.n_present {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// The insertions along a Hilbert curve, so that each walk begins near its end.
    fn ordered_insertions(&self) -> Result<Vec<(VertexId, G::Point)>> {
        let insertions = self.edits.insertions();
        let mut keyed = Vec::new();
        memory::reserve_exact(&mut keyed, insertions.len())?;
        keyed.extend((0..insertions.len() as u32).map(Keyed::new));
        let keyed = hilbert_order::<G>(keyed, |k| &insertions[k as usize].1)?;
        let mut ordered = Vec::new();
        memory::reserve_exact(&mut ordered, insertions.len())?;
        ordered.extend(keyed.iter().map(|k| insertions[k.item() as usize]));
        Ok(ordered)
    }

    /// Triangulates the vertices that stay, at their goals, and those that come.
    fn rebuild_edited(&mut self, moves: &mut Moves<'_, G>, report: &mut CommitReport) -> Result<()> {
        let goals = moves.checked()?;
        let Movers::Listed(movers) = moves.movers() else {
            unreachable!("where there are edits, moves are listed");
        };
        let room = self.mesh.hidden.count() + self.edits.insertions().len();
        let mut next = self.mesh.kernel.successor(room, |site| site.point, |_| {})?;
        let ready = self.edit_sites(&mut next, movers, goals, report);
        let (n_in, n_out) = self.staged_edits();
        self.build_and_adopt(next, ready, report)?;
        for &v in self.edits.removals() {
            self.mesh.site_of[v] = SiteId::NONE;
        }
        self.mesh.n_present = self.mesh.n_present + n_in - n_out;
        report.inserted += n_in as u64;
        report.removed += n_out as u64;
        Ok(())
    }

    /// Gives a new kernel the sites of all vertices that are to be there, where they are to be.
    fn edit_sites(
        &mut self,
        next: &mut Delaunay<G>,
        movers: &[VertexId],
        goals: Goals<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        let spread = self.mesh.spread_hidden(next)?;
        for &v in movers {
            report.moved += u64::from(move_to(next, self.mesh.own_site(&spread, v), goals.of(v)));
        }
        for &v in self.edits.removals() {
            next.discard_site(self.mesh.own_site(&spread, v))?;
            // Its id may become that of another one before changes are taken.
            if self.mesh.is_hidden(v) {
                self.mesh.note_visibility(v, true)?;
            }
        }
        for &(id, q) in self.edits.insertions() {
            next.add_site(q, id)?;
        }
        Ok(())
    }
}
