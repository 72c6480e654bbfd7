//! What undoing a change needs beside the kernel's log and the staging.

use crate::delaunay::Dimension;
use crate::error::Result;
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;

/// The site at which a vertex was, and what it has done since.
#[derive(Clone, Copy, Debug)]
pub(super) struct VertexBefore {
    pub(super) vertex: VertexId,
    pub(super) site: SiteId,
    pub(super) event: Event,
}

/// What a vertex has done.
#[derive(Clone, Copy, Debug)]
pub(super) enum Event {
    /// It has got a site of its own, or lost it.
    Alone,
    /// It has joined those that this one represented.
    Joined { representative: VertexId },
    /// It has parted from those that this one represents.
    Parted { representative: VertexId },
}

/// Numbers of vertices present, and of events of visibility.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counts {
    pub(super) present: usize,
    pub(super) visibilities: usize,
}

/// What undoing needs beside the kernel's log and the staging.
#[derive(Debug)]
pub(super) struct Transaction<G: Dimension> {
    vertices: Vec<VertexBefore>,
    /// Room for the old positions of vertices that are at shared places when undoing begins.
    displaced: Vec<(VertexId, G::Point)>,
    before: Counts,
    /// Whether the kernel is a new one.
    has_rebuilt: bool,
    /// Whether the cells are worth sorting when all is done.
    wants_order: bool,
}

impl<G: Dimension> Default for Transaction<G> {
    fn default() -> Self {
        Transaction {
            vertices: Vec::new(),
            displaced: Vec::new(),
            before: Counts::default(),
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

    /// A change begins.
    pub(super) fn begin(&mut self, now: Counts) {
        debug_assert!(self.vertices.is_empty());
        (self.has_rebuilt, self.wants_order) = (false, false);
        self.before = now;
    }

    /// A change has been made.
    pub(super) fn end(&mut self) {
        self.vertices.clear();
    }

    /// The counts when the change began.
    pub(super) fn before(&self) -> Counts {
        self.before
    }

    /// Makes room in the log for one vertex.
    pub(super) fn reserve_log(&mut self) -> Result<()> {
        memory::reserve(&mut self.vertices, 1)
    }

    /// Keeps where a vertex was; there is [room](Self::reserve_log).
    pub(super) fn log(&mut self, before: VertexBefore) {
        debug_assert!(self.vertices.len() < self.vertices.capacity());
        self.vertices.push(before);
    }

    /// Takes where a vertex was out of the log, the last one first.
    pub(super) fn pop_logged(&mut self) -> Option<VertexBefore> {
        self.vertices.pop()
    }

    /// Keeps the old position of a vertex at a shared place, for which there is [room](Self::reserve_displaced).
    pub(super) fn displace(&mut self, vertex: VertexId, position: G::Point) {
        debug_assert!(self.displaced.len() < self.displaced.capacity());
        self.displaced.push((vertex, position));
    }

    /// Takes the old position of a vertex at a shared place.
    pub(super) fn pop_displaced(&mut self) -> Option<(VertexId, G::Point)> {
        self.displaced.pop()
    }

    /// Whether a new kernel is in place.
    pub(super) fn has_rebuilt(&self) -> bool {
        self.has_rebuilt
    }

    /// The cells are worth sorting when all is done.
    pub(super) fn want_order(&mut self) {
        self.wants_order = true;
    }

    /// Whether the cells are worth sorting.
    pub(super) fn wants_order(&self) -> bool {
        self.wants_order
    }

    /// A new kernel is in place: nothing can be undone, and nothing can fail.
    pub(super) fn adopt(&mut self) {
        self.has_rebuilt = true;
        self.vertices.clear();
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.vertices.capacity() * size_of::<VertexBefore>()
            + self.displaced.capacity() * size_of::<(VertexId, G::Point)>()
    }
}
