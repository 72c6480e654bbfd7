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
//! ([`Delaunay::begin`]), the site and the successor of each vertex that came to or left a shared place, and, of a commit,
//! where the moved vertices were ([`staging`](super::staging): applying a move exchanges the two positions). A
//! [rebuilding](super::rebuilding) makes a new kernel beside the old one, which stays as it is until that is complete.
//!
//! Memory is reserved before a change, so [`undo`](MovingTriangulation::undo) needs none, and cannot fail.

use super::MovingTriangulation;
use crate::delaunay::Dimension;
use crate::error::Result;
use crate::machine::memory;

/// Where a vertex was: its site, and the next vertex there.
#[derive(Clone, Copy, Debug)]
struct VertexBefore {
    vertex: u32,
    site: u32,
    next: u32,
}

/// What undoing needs beside the kernel's log and the staging.
#[derive(Debug)]
pub(super) struct Transaction<G: Dimension> {
    vertices: Vec<VertexBefore>,
    /// Room for the old positions of vertices that are at shared places when undoing begins.
    displaced: Vec<(u32, G::Point)>,
    n_hidden: usize,
    n_present: usize,
    n_visibilities: usize,
    /// Whether the kernel is a new one.
    pub(super) has_rebuilt: bool,
    /// Whether the cells are worth sorting when all is done.
    pub(super) wants_order: bool,
}

impl<G: Dimension> Default for Transaction<G> {
    fn default() -> Self {
        Transaction {
            vertices: Vec::new(),
            displaced: Vec::new(),
            n_hidden: 0,
            n_present: 0,
            n_visibilities: 0,
            has_rebuilt: false,
            wants_order: false,
        }
    }
}

impl<G: Dimension> Transaction<G> {
    /// Makes room for the positions of all vertices at shared places, `n_hidden` of which are hidden.
    pub(super) fn reserve_displaced(&mut self, n_hidden: usize) -> Result<()> {
        let missing = (2 * n_hidden).saturating_sub(self.displaced.capacity());
        if missing == 0 {
            return Ok(());
        }
        memory::reserve(&mut self.displaced, 2 * n_hidden)
    }

    /// A new kernel is in place: nothing can be undone, and nothing can fail.
    pub(super) fn adopt(&mut self) {
        self.has_rebuilt = true;
        self.vertices.clear();
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.vertices.capacity() * size_of::<VertexBefore>()
            + self.displaced.capacity() * size_of::<(u32, G::Point)>()
    }
}

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
        let transaction = &mut self.transaction;
        debug_assert!(transaction.vertices.is_empty());
        (transaction.has_rebuilt, transaction.wants_order) = (false, false);
        transaction.n_hidden = self.hidden.count();
        transaction.n_present = self.n_present;
        transaction.n_visibilities = self.views.count_visibilities(self.site_of.len());
        Ok(())
    }

    /// Keeps where a vertex is before it comes to or leaves a shared place.
    pub(super) fn log_vertex(&mut self, vertex: u32) -> Result<()> {
        let (site, next) = (self.site_of[vertex as usize], self.hidden.next(vertex));
        memory::push(&mut self.transaction.vertices, VertexBefore { vertex, site, next })
    }

    /// Makes a change visible to who reads the cells. Cannot fail.
    pub(super) fn publish(&mut self) {
        if self.transaction.has_rebuilt || self.kernel.has_given_up_cells() {
            self.views.follow_all();
        } else {
            self.views.follow(&self.kernel);
        }
        self.kernel.end();
        self.transaction.vertices.clear();
        if self.transaction.wants_order {
            // For speed alone: without the memory for it the cells stay as they are.
            let _ = self.sort_cells();
        }
    }

    /// Puts all back as it was when the change began. Needs no memory.
    pub(super) fn undo(&mut self) {
        debug_assert!(!self.transaction.has_rebuilt, "nothing fails after a new kernel is in place");
        self.take_moves_back();
        while let Some(VertexBefore { vertex, site, next }) = self.transaction.vertices.pop() {
            self.site_of[vertex as usize] = site;
            self.hidden.set_next(vertex, next);
        }
        self.hidden.set_count(self.transaction.n_hidden);
        self.n_present = self.transaction.n_present;
        self.views.forget_visibilities(self.transaction.n_visibilities);
        self.kernel.undo();
        while let Some((vertex, position)) = self.transaction.displaced.pop() {
            self.kernel.set_point(self.site_of[vertex as usize], position);
        }
        self.regions.invalidate();
    }

    /// Stages all applied moves again, and puts the vertices back where they were, those at shared places later.
    fn take_moves_back(&mut self) {
        let n_listed = self.staging.vertices.len();
        if self.staging.others_applied {
            // While whole the flags are free for the few that have not moved.
            for k in self.staging.applied..n_listed {
                let vertex = self.staging.vertices[k];
                self.staging.set_flag(vertex, true);
            }
            for vertex in 0..self.site_of.len() as u32 {
                if !self.staging.flag(vertex) {
                    self.take_move_back(vertex);
                }
            }
            for k in self.staging.applied..n_listed {
                let vertex = self.staging.vertices[k];
                self.staging.set_flag(vertex, false);
            }
        } else {
            for k in 0..self.staging.applied {
                self.take_move_back(self.staging.vertices[k]);
            }
        }
        self.staging.applied = 0;
        self.staging.end_queue();
    }

    fn take_move_back(&mut self, vertex: u32) {
        let s = self.site_of[vertex as usize];
        if !self.is_shared(s) {
            self.exchange_position(vertex);
            return;
        }
        let here = self.kernel.site(s).point;
        let old = std::mem::replace(&mut self.staging.positions[vertex as usize], here);
        debug_assert!(self.transaction.displaced.len() < self.transaction.displaced.capacity());
        self.transaction.displaced.push((vertex, old));
    }
}
