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
//! ([`Delaunay::begin`]), the site of each vertex that came to or left a place, and with whom, and, of a
//! commit, where the moved vertices were ([`staging`](super::staging): applying a move exchanges the two positions). A
//! [rebuilding](super::rebuilding) makes a new kernel beside the old one, which stays as it is until that is complete.
//!
//! Memory is reserved before a change, so [`undo`](MovingTriangulation::undo) needs none, and cannot fail.

use super::MovingTriangulation;
use super::constants::constants;
use super::transaction::{Counts, Event, VertexBefore};
use crate::delaunay::Dimension;
use crate::error::Result;
use crate::ids::VertexId;

impl<G: Dimension> MovingTriangulation<G> {
    /// Makes a change, all of it or nothing.
    pub(super) fn transact<T>(&mut self, change: impl FnOnce(&mut Self) -> Result<T>) -> Result<T> {
        self.begin()?;
        let done = change(self).and_then(|done| self.views.prepare(&self.kernel).map(|()| done));
        match done {
            Ok(done) => {
                self.publish();
                Ok(done)
            }
            Err(error) => {
                self.undo();
                Err(error)
            }
        }
    }

    /// Begins a change.
    pub(super) fn begin(&mut self) -> Result<()> {
        self.transaction.reserve_displaced(self.hidden.count())?;
        self.kernel.begin()?;
        self.transaction.begin(Counts {
            present: self.n_present,
            visibilities: self.views.visibilities().shortened_len(self.site_of.len()),
        });
        Ok(())
    }

    /// Keeps the site of a vertex before it gets one of its own, or loses it.
    pub(super) fn log_vertex(&mut self, vertex: VertexId) -> Result<()> {
        self.transaction.reserve_log()?;
        self.transaction.log(VertexBefore { vertex, site: self.site_of[vertex], event: Event::Alone });
        Ok(())
    }

    /// Makes a change visible to programs that read the cells. Cannot fail.
    pub(super) fn publish(&mut self) {
        if self.transaction.has_rebuilt() || self.kernel.has_given_up_cells() {
            self.views.follow_all();
        } else {
            self.views.follow(&self.kernel);
        }
        self.kernel.end();
        self.transaction.end();
        if self.transaction.wants_order() {
            // For speed alone: without the memory for it the cells stay as they are.
            let _ = self.sort_cells(constants::<G>().replaced_to_sort);
        }
    }

    /// Puts all back as it was when the change began. Needs no memory.
    pub(super) fn undo(&mut self) {
        debug_assert!(!self.transaction.has_rebuilt(), "nothing fails after a new kernel is in place");
        self.take_moves_back();
        while let Some(VertexBefore { vertex, site, event }) = self.transaction.pop_logged() {
            self.site_of[vertex] = site;
            match event {
                Event::Alone => {}
                Event::Joined { representative } => self.hidden.part(representative.min(vertex), vertex),
                Event::Parted { representative } => self.hidden.join(representative, vertex),
            }
        }
        let before = self.transaction.before();
        self.n_present = before.present;
        self.views.visibilities().truncate(before.visibilities);
        self.kernel.undo();
        while let Some((vertex, position)) = self.transaction.pop_displaced() {
            self.kernel.set_point(self.site_of[vertex], position);
        }
        self.regions.invalidate();
    }

    /// Stages all applied moves again, and puts the vertices back where they were, those at shared places later.
    fn take_moves_back(&mut self) {
        let n_listed = self.staging.vertices().len();
        if self.staging.others_applied() {
            // While whole the flags are free for the few that have not moved.
            for k in self.staging.applied()..n_listed {
                let vertex = self.staging.vertices()[k];
                self.staging.set_flag(vertex, true);
            }
            for vertex in VertexId::range(0..self.site_of.len()) {
                if !self.staging.flag(vertex) {
                    self.take_move_back(vertex);
                }
            }
            for k in self.staging.applied()..n_listed {
                let vertex = self.staging.vertices()[k];
                self.staging.set_flag(vertex, false);
            }
        } else {
            for k in 0..self.staging.applied() {
                self.take_move_back(self.staging.vertices()[k]);
            }
        }
        self.staging.set_applied(0);
        self.staging.end_queue();
    }

    fn take_move_back(&mut self, vertex: VertexId) {
        let s = self.site_of[vertex];
        if !self.is_shared(s) {
            self.exchange_position(vertex);
            return;
        }
        let here = self.kernel.site(s).point;
        let old = std::mem::replace(&mut self.staging.positions_mut()[vertex], here);
        self.transaction.displace(vertex, old);
    }
}
