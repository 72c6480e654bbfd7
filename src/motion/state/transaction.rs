//! What undoing a change needs beside the kernel's log.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;
use crate::motion::state::origins::{KeptOrigins, VertexOrigins};

/// The site at which a vertex was, and what it has done since.
#[derive(Clone, Copy, Debug)]
pub(in crate::motion) struct VertexBefore {
    pub(in crate::motion) vertex: VertexId,
    pub(in crate::motion) site: SiteId,
    pub(in crate::motion) event: Event,
}

/// What a vertex has done.
#[derive(Clone, Copy, Debug)]
pub(in crate::motion) enum Event {
    /// The vertex has got a site of its own, or lost it.
    Alone,
    /// The vertex has joined those that this one represented.
    Joined { representative: VertexId },
    /// The vertex has parted from those that this one represents.
    Parted { representative: VertexId },
}

/// Numbers of vertices present, and of events of visibility.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::motion) struct Counts {
    pub(in crate::motion) present: usize,
    pub(in crate::motion) visibilities: usize,
}

/// What undoing needs beside the kernel's log.
#[derive(Debug, Default)]
pub(in crate::motion) struct Transaction<G: Moving> {
    vertices: Vec<VertexBefore>,
    /// Where the vertices were that have moved.
    origins: VertexOrigins<G>,
    before: Counts,
    /// Whether the kernel is a new one.
    has_rebuilt: bool,
    /// Whether the cells are worth sorting when all is done.
    wants_order: bool,
}

/// What undoes a change that has been set aside, beside the kernel's part.
#[derive(Debug)]
pub(in crate::motion) struct KeptTransaction<G: Moving> {
    vertices: Vec<VertexBefore>,
    origins: KeptOrigins<G>,
    before: Counts,
}

impl<G: Moving> KeptTransaction<G> {
    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        self.vertices.capacity() * size_of::<VertexBefore>() + self.origins.memory_bytes()
    }
}

impl<G: Moving> Transaction<G> {
    /// A change begins.
    pub(in crate::motion) fn begin(&mut self, now: Counts) {
        debug_assert!(self.vertices.is_empty());
        self.origins.begin();
        (self.has_rebuilt, self.wants_order) = (false, false);
        self.before = now;
    }

    /// A change has been made.
    pub(in crate::motion) fn end(&mut self) {
        self.vertices.clear();
    }

    /// The counts when the change began.
    pub(in crate::motion) fn before(&self) -> Counts {
        self.before
    }

    /// Makes room in the log for one vertex.
    pub(in crate::motion) fn reserve_log(&mut self) -> Result<()> {
        memory::reserve(&mut self.vertices, 1)
    }

    /// Keeps where a vertex was; there is [room](Self::reserve_log).
    pub(in crate::motion) fn log(&mut self, before: VertexBefore) {
        debug_assert!(self.vertices.len() < self.vertices.capacity());
        self.vertices.push(before);
    }

    /// Whether a vertex has got another site.
    pub(in crate::motion) fn has_logged(&self) -> bool {
        !self.vertices.is_empty()
    }

    /// Takes where a vertex was out of the log, the last one first.
    pub(in crate::motion) fn pop_logged(&mut self) -> Option<VertexBefore> {
        self.vertices.pop()
    }

    /// Where the vertices were that have moved.
    #[inline(always)]
    pub(in crate::motion) fn origins(&self) -> &VertexOrigins<G> {
        &self.origins
    }

    /// Where the vertices were that have moved, to note more.
    #[inline(always)]
    pub(in crate::motion) fn origins_mut(&mut self) -> &mut VertexOrigins<G> {
        &mut self.origins
    }

    /// Whether a new kernel is in place.
    pub(in crate::motion) fn has_rebuilt(&self) -> bool {
        self.has_rebuilt
    }

    /// The cells are worth sorting when all is done.
    pub(in crate::motion) fn want_order(&mut self) {
        self.wants_order = true;
    }

    /// Whether the cells are worth sorting.
    pub(in crate::motion) fn wants_order(&self) -> bool {
        self.wants_order
    }

    /// A new kernel is in place: nothing can fail. Unless the old one is kept, nothing can be undone.
    pub(in crate::motion) fn adopt(&mut self, is_old_kept: bool) {
        self.has_rebuilt = true;
        if !is_old_kept {
            self.vertices.clear();
        }
    }

    /// The old kernel is back in place, as it was when the new one took it.
    pub(in crate::motion) fn reject(&mut self) {
        self.has_rebuilt = false;
    }

    /// Sets a change aside that has been made.
    pub(in crate::motion) fn set_aside(&mut self) -> Result<KeptTransaction<G>> {
        let origins = self.origins.set_aside()?;
        Ok(KeptTransaction { vertices: std::mem::take(&mut self.vertices), origins, before: self.before })
    }

    /// Takes up a change that was set aside, to be undone. Its origins are to be put back after that.
    pub(in crate::motion) fn take_up(&mut self, kept: KeptTransaction<G>) -> KeptOrigins<G> {
        self.begin(kept.before);
        self.vertices = kept.vertices;
        kept.origins
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        self.vertices.capacity() * size_of::<VertexBefore>() + self.origins.memory_bytes()
    }
}
