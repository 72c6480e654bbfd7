//! Vertices at the same place: the lowest id represents it, the others are hidden until they move apart.
//!
//! The vertices at a place form a chain in ascending order: each names the next one. A vertex without a next one is the
//! last at its place, and most are alone there. So nothing is kept until the first vertex is hidden, and then 4 bytes
//! for each id.

use super::{CoincidencePolicy, MovingTriangulation};
use crate::complex::NONE;
use crate::delaunay::{Dimension, Merge, Place};
use crate::error::{Error, Result};
use crate::machine::memory;

/// Which vertices are hidden.
#[derive(Debug, Default)]
pub(super) struct Hidden {
    /// By vertex id, the next one at the same place; [`NONE`] for the last one, and for ids beyond the end.
    next: Vec<u32>,
    count: usize,
}

impl Hidden {
    /// Number of hidden vertices.
    #[inline(always)]
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// The next vertex at the place of this one.
    #[inline(always)]
    pub(super) fn next(&self, vertex: u32) -> u32 {
        self.next.get(vertex as usize).copied().unwrap_or(NONE)
    }

    /// Whether a representative has others behind it.
    #[inline(always)]
    pub(super) fn is_followed(&self, representative: u32) -> bool {
        self.count != 0 && self.next(representative) != NONE
    }

    /// The one of the vertices at a representative's place after which this one comes.
    fn before(&self, representative: u32, vertex: u32) -> u32 {
        let mut before = representative;
        while self.next(before) < vertex {
            before = self.next(before);
        }
        before
    }

    /// Makes room for `n_ids` ids.
    pub(super) fn reserve(&mut self, n_ids: usize) -> Result<()> {
        let missing = n_ids.saturating_sub(self.next.len());
        if missing > 0 {
            memory::reserve(&mut self.next, missing)?;
            self.next.resize(n_ids, NONE);
        }
        Ok(())
    }

    /// Sets the next vertex after one that there is room for.
    pub(super) fn set_next(&mut self, vertex: u32, next: u32) {
        if let Some(entry) = self.next.get_mut(vertex as usize) {
            *entry = next;
        }
    }

    /// Sets the number of hidden vertices.
    pub(super) fn set_count(&mut self, count: usize) {
        self.count = count;
    }

    /// The chains of merged vertices, by their representatives' ids.
    pub(super) fn of_merges(
        mut merges: Vec<Merge>,
        n_ids: usize,
        representative: impl Fn(u32) -> u32,
    ) -> Result<Self> {
        let mut hidden = Hidden::default();
        if merges.is_empty() {
            return Ok(hidden);
        }
        hidden.reserve(n_ids)?;
        merges.sort_unstable_by_key(|merge| std::cmp::Reverse(merge.hidden));
        for merge in &merges {
            let first = representative(merge.site);
            let after = hidden.next(first);
            hidden.set_next(merge.hidden, after);
            hidden.set_next(first, merge.hidden);
        }
        hidden.count = merges.len();
        Ok(hidden)
    }

    /// A copy in which the vertices have other ids, `n` in all: those listed by the old ones.
    pub(super) fn renumbered(&self, ids: &[u32], n: usize) -> Result<Self> {
        let mut hidden = Hidden { next: Vec::new(), count: self.count };
        if self.count > 0 {
            memory::reserve_exact(&mut hidden.next, n)?;
            hidden.next.resize(n, NONE);
            for (&id, &next) in ids.iter().zip(&self.next).filter(|(_, next)| **next != NONE) {
                hidden.next[id as usize] = ids[next as usize];
            }
        }
        Ok(hidden)
    }

    /// The first representative with hidden vertices behind it, and the first of them.
    pub(super) fn first_pair(&self) -> Option<(u32, u32)> {
        // A vertex that another one names is no representative; those come in ascending order.
        let first = (0..).zip(&self.next).find(|&(_, &next)| next != NONE)?;
        Some((first.0, *first.1))
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.next.capacity() * 4
    }
}

impl<G: Dimension> MovingTriangulation<G> {
    /// Whether several vertices are at a site.
    #[inline(always)]
    pub(super) fn is_shared(&self, s: u32) -> bool {
        self.hidden.count() != 0 && self.hidden.is_followed(self.kernel.site(s).id)
    }

    /// Whether a vertex that is present is hidden.
    pub(super) fn is_hidden(&self, vertex: u32) -> bool {
        self.hidden.count() != 0 && self.kernel.site(self.site_of[vertex as usize]).id != vertex
    }

    /// Lets a vertex that has no site of its own join another's.
    pub(super) fn hide(&mut self, vertex: u32, s: u32) -> Result<()> {
        self.hidden.reserve(self.site_of.len())?;
        self.transaction.reserve_displaced(self.hidden.count() + 1)?;
        let representative = self.kernel.site(s).id;
        self.log_vertex(vertex)?;
        if vertex > representative {
            let before = self.hidden.before(representative, vertex);
            self.log_vertex(before)?;
            self.note_visibility(vertex, false)?;
            self.hidden.set_next(vertex, self.hidden.next(before));
            self.hidden.set_next(before, vertex);
        } else {
            self.note_visibility(representative, false)?;
            self.kernel.rename_site(s, vertex)?;
            self.hidden.set_next(vertex, representative);
        }
        self.site_of[vertex as usize] = s;
        self.hidden.set_count(self.hidden.count() + 1);
        Ok(())
    }

    /// Takes a vertex away from the site that it shares.
    pub(super) fn leave(&mut self, vertex: u32) -> Result<()> {
        let s = self.site_of[vertex as usize];
        self.kernel.log_site(s)?;
        let representative = self.kernel.site(s).id;
        self.log_vertex(vertex)?;
        if vertex == representative {
            let next = self.hidden.next(vertex);
            self.note_visibility(next, true)?;
            self.kernel.rename_site(s, next)?;
        } else {
            let before = self.hidden.before(representative, vertex);
            self.log_vertex(before)?;
            self.note_visibility(vertex, true)?;
            self.hidden.set_next(before, self.hidden.next(vertex));
        }
        self.hidden.set_next(vertex, NONE);
        self.hidden.set_count(self.hidden.count() - 1);
        Ok(())
    }

    /// Enforces [`CoincidencePolicy::Reject`] on the present state.
    pub(super) fn reject_coincidence(&self) -> Result<()> {
        match self.hidden.first_pair() {
            Some((vertex, other)) if self.options.coincidence == CoincidencePolicy::Reject => {
                Err(Error::Coincident { vertex, other })
            }
            _ => Ok(()),
        }
    }

    /// Enforces [`CoincidencePolicy::Reject`] on a place that `vertex` would take.
    pub(super) fn reject_occupied(&self, vertex: u32, q: &G::Point) -> Result<()> {
        if self.options.coincidence == CoincidencePolicy::Merge {
            return Ok(());
        }
        match self.kernel.locate(q, NONE) {
            Place::Site(s) => {
                let there = self.kernel.site(s).id;
                Err(Error::Coincident { vertex: vertex.min(there), other: vertex.max(there) })
            }
            _ => Ok(()),
        }
    }
}
