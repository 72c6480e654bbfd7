//! Where vertices were that a commit has moved.
//!
//! Every vertex that is moved is noted here first, or with all others. A vertex that is taken back goes to its origin, a
//! check of certificates may take them to have held at the origins, and undoing puts all vertices back. Where vertices go
//! is in [`goals`](super::goals), for as long as the commit takes.

use crate::delaunay::{Delaunay, Moving};
use crate::error::Result;
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;

/// Of which vertices origins are known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Known {
    /// Of the listed vertices.
    #[default]
    Listed,
    /// Of every vertex.
    All,
}

/// Where the vertices of a change were when it began, by id: of those that have moved.
#[derive(Debug, Default)]
pub(in crate::motion) struct VertexOrigins<G: Moving> {
    positions: Vec<G::Point>,
    /// Vertices that have moved one by one. One that has been taken back in between is listed twice.
    listed: Vec<VertexId>,
    known: Known,
}

/// Puts all vertices back where they were. Ids that have been given since have no site.
fn put_all_back<G: Moving>(positions: &[G::Point], kernel: &mut Delaunay<G>, site_of: &[SiteId]) {
    for (&s, p) in std::iter::zip(site_of, positions).filter(|&(&s, _)| s != SiteId::NONE) {
        kernel.set_point(s, *p);
    }
}

/// The origins of a change that has been set aside.
#[derive(Debug)]
pub(in crate::motion) enum KeptOrigins<G: Moving> {
    Listed(Vec<(VertexId, G::Point)>),
    All(Vec<G::Point>),
}

impl<G: Moving> KeptOrigins<G> {
    /// Puts all vertices that have moved back where they were. Each is at the site that it had then.
    pub(in crate::motion) fn put_back(&self, kernel: &mut Delaunay<G>, site_of: &[SiteId]) {
        match self {
            KeptOrigins::All(positions) => put_all_back(positions, kernel, site_of),
            KeptOrigins::Listed(listed) => {
                listed.iter().for_each(|&(v, p)| kernel.set_point(site_of[v], p));
            }
        }
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        match self {
            KeptOrigins::All(positions) => memory::bytes_of(positions),
            KeptOrigins::Listed(listed) => memory::bytes_of(listed),
        }
    }
}

impl<G: Moving> VertexOrigins<G> {
    /// Sets the origins of a change aside: of few vertices they are copied, at the cost of these.
    pub(in crate::motion) fn set_aside(&mut self) -> Result<KeptOrigins<G>> {
        if self.known == Known::All {
            self.begin();
            return Ok(KeptOrigins::All(std::mem::take(&mut self.positions)));
        }
        let mut listed = Vec::new();
        memory::collect(&mut listed, self.listed.iter().map(|&v| (v, self.positions[v])))?;
        self.begin();
        Ok(KeptOrigins::Listed(listed))
    }

    /// A change begins: nothing has moved.
    pub(in crate::motion) fn begin(&mut self) {
        self.listed.clear();
        self.known = Known::Listed;
    }

    /// Makes room for this number of moves more, of `n_ids` vertices.
    pub(in crate::motion) fn make_room(&mut self, n_ids: usize, more: usize) -> Result<()> {
        if self.known == Known::Listed {
            self.make_room_by_id(n_ids)?;
            memory::reserve(&mut self.listed, more)?;
        }
        Ok(())
    }

    fn make_room_by_id(&mut self, n_ids: usize) -> Result<()> {
        let missing = n_ids.saturating_sub(self.positions.len());
        memory::reserve(&mut self.positions, missing)?;
        self.positions.resize(self.positions.len() + missing, G::Point::default());
        Ok(())
    }

    /// A vertex that was here is going to be moved; there is [room](Self::make_room).
    #[inline(always)]
    pub(in crate::motion) fn note(&mut self, vertex: VertexId, position: G::Point) {
        if self.known == Known::Listed {
            debug_assert!(self.listed.len() < self.listed.capacity());
            self.positions[vertex] = position;
            self.listed.push(vertex);
        }
    }

    /// Memory for the origins of all `n` vertices, to be filled; then [`note_all`](Self::note_all) follows.
    pub(in crate::motion) fn of_all_mut(&mut self, n: usize) -> Result<&mut [G::Point]> {
        debug_assert!(self.listed.is_empty());
        self.make_room_by_id(n)?;
        Ok(&mut self.positions[..n])
    }

    /// All vertices have been moved, and their origins entered.
    pub(in crate::motion) fn note_all(&mut self) {
        self.known = Known::All;
    }

    /// Whether no vertex has been moved.
    pub(in crate::motion) fn are_none(&self) -> bool {
        self.known == Known::Listed && self.listed.is_empty()
    }

    /// Whether the origins of all vertices are known.
    pub(in crate::motion) fn are_of_all(&self) -> bool {
        self.known == Known::All
    }

    /// By vertex id, where the vertices were that have moved in this change, or in one before.
    #[inline(always)]
    pub(in crate::motion) fn positions(&self) -> &[G::Point] {
        &self.positions
    }

    /// Where a vertex was that has moved.
    #[inline(always)]
    pub(in crate::motion) fn of(&self, vertex: VertexId) -> &G::Point {
        &self.positions[vertex]
    }

    /// Puts all vertices that have moved back where they were. Each is at the site that it had then.
    pub(in crate::motion) fn put_back(&self, kernel: &mut Delaunay<G>, site_of: &[SiteId]) {
        match self.known {
            Known::All => put_all_back(&self.positions, kernel, site_of),
            Known::Listed => {
                self.listed.iter().for_each(|&v| kernel.set_point(site_of[v], self.positions[v]));
            }
        }
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.positions) + memory::bytes_of(&self.listed)
    }
}
