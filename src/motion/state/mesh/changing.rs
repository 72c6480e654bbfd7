//! One change of the triangulation, made or undone.
//!
//! ```text
//! begin
//! change: note what is about to change, then change it
//! if that failed: undo
//! else: publish
//! ```
//!
//! What is kept for undoing: the rows of cells and the sites that were removed, added or renamed
//! ([`Delaunay::begin`](crate::delaunay::Delaunay::begin)), the site of each vertex that came to or left a place, and
//! with whom, and where the vertices were that have moved ([`origins`](crate::motion::state::origins)). A rebuilding
//! makes a new kernel beside the old one, which stays as it is until that is complete.
//!
//! Memory is reserved before a change, so [`undo`](Mesh::undo) needs none, and cannot fail.

use crate::delaunay::{Delaunay, Dimension};
use crate::error::Result;
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;
use crate::motion::state::hidden::Hidden;
use crate::motion::state::mesh::Mesh;
use crate::motion::state::segments::Aim;
use crate::motion::state::transaction::{Counts, Event, VertexBefore};

/// After a repair, cells are sorted again if this many times as many as there are have been replaced.
const REPLACED_TO_SORT: f64 = 2.0;

impl<G: Dimension> Mesh<G> {
    /// Begins a change.
    pub(in crate::motion) fn begin(&mut self, aim: Aim) -> Result<()> {
        self.kernel.begin()?;
        self.transaction.begin(Counts {
            present: self.n_present,
            visibilities: self.views.visibilities_mut().shortened_len(self.site_of.len()),
        });
        let Some(segments) = &mut self.segments else { return Ok(()) };
        // What segments refuse is undone after all of it has been made.
        let lifted = self.kernel.keep_flat().and_then(|()| segments.lift(&mut self.kernel, aim));
        if lifted.is_err() {
            self.undo();
        }
        lifted
    }

    /// What the change is made for.
    pub(in crate::motion) fn aim(&self) -> Aim {
        self.segments.as_ref().map_or(Aim::Commit, |segments| segments.aim())
    }

    /// Lays the segments, when the vertices are where they go, unless a new kernel has them.
    pub(in crate::motion) fn lay_segments(&mut self) -> Result<()> {
        let Some(segments) = &mut self.segments else { return Ok(()) };
        if self.transaction.has_rebuilt() {
            return Ok(());
        }
        // A hidden vertex that goes to another place of vertices takes its segments along, and changes no cell.
        let is_unchanged = self.kernel.complex().rows().is_empty() && !self.transaction.has_logged();
        if is_unchanged && segments.are_at_rest() && self.kernel.has_cells() {
            return Ok(());
        }
        segments.lay(&mut self.kernel, &self.site_of)
    }

    /// Lays the segments in a new kernel that hides these vertices.
    pub(in crate::motion) fn lay_segments_in(
        &mut self,
        next: &mut Delaunay<G>,
        hidden: &Hidden,
    ) -> Result<()> {
        let Some(segments) = &mut self.segments else { return Ok(()) };
        let mut site_of = Vec::new();
        memory::lengthen(&mut site_of, self.site_of.len(), SiteId::NONE)?;
        for s in next.live_sites() {
            hidden.for_all_at(next.site(s).id, |v| site_of[v.index()] = s);
        }
        segments.lay_in_new(next, &site_of)
    }

    /// Keeps the site of a vertex before it gets one of its own, or loses it.
    pub(in crate::motion) fn log_vertex(&mut self, vertex: VertexId) -> Result<()> {
        self.transaction.reserve_log()?;
        self.transaction.log(VertexBefore { vertex, site: self.site_of[vertex], event: Event::Alone });
        Ok(())
    }

    /// Makes a change visible to programs that read the cells. Cannot fail.
    pub(in crate::motion) fn publish(&mut self) {
        self.n_changes += u64::from(self.has_changed());
        if self.transaction.has_rebuilt() || self.kernel.has_given_up_cells() {
            self.views.follow_all();
        } else {
            self.views.follow(&self.kernel);
        }
        self.kernel.end();
        self.transaction.end();
        if let Some(segments) = &mut self.segments {
            segments.keep();
        }
        if self.transaction.wants_order() {
            // For speed alone: without the memory for it the cells stay as they are.
            let _ = self.sort_cells(REPLACED_TO_SORT);
        }
    }

    /// Whether a place, a cell or a segment may have changed.
    fn has_changed(&self) -> bool {
        self.transaction.has_rebuilt()
            || self.transaction.has_logged()
            || !self.transaction.origins().are_none()
            || !self.kernel.complex().rows().is_empty()
            || self.segments.as_ref().is_some_and(|segments| !segments.are_at_rest())
    }

    /// Puts all back as it was when the change began. Needs no memory.
    pub(in crate::motion) fn undo(&mut self) {
        debug_assert!(!self.transaction.has_rebuilt(), "nothing fails after a new kernel is in place");
        let keys = self.kernel.keys();
        while let Some(VertexBefore { vertex, site, event }) = self.transaction.pop_logged() {
            self.site_of[vertex] = site;
            match event {
                Event::Alone => {}
                Event::Joined { representative } => {
                    self.hidden.part(keys, keys.lower(representative, vertex), vertex);
                }
                Event::Parted { representative } => self.hidden.join(keys, representative, vertex),
            }
        }
        let before = self.transaction.before();
        self.n_present = before.present;
        self.views.visibilities_mut().truncate(before.visibilities);
        self.kernel.undo();
        self.transaction.origins().put_back(&mut self.kernel, &self.site_of);
        if let Some(segments) = &mut self.segments {
            segments.undo(&mut self.kernel);
        }
    }
}
