//! Vertices at the same place: the lowest id represents it, the others are [hidden](super::hidden) until they move
//! apart.

use crate::delaunay::{Dimension, Place};
use crate::error::{Error, Result};
use crate::ids::{SiteId, Slot, VertexId};
use crate::motion::options::CoincidencePolicy;
use crate::motion::state::transaction::{Event, VertexBefore};
use crate::motion::triangulation::MovingTriangulation;

impl<G: Dimension> MovingTriangulation<G> {
    /// Whether several vertices are at a site.
    #[inline(always)]
    pub(in crate::motion) fn is_shared(&self, s: SiteId) -> bool {
        self.hidden.count() != 0 && self.hidden.is_followed(self.kernel.site(s).id)
    }

    /// Whether a vertex that is present is hidden.
    pub(in crate::motion) fn is_hidden(&self, vertex: VertexId) -> bool {
        self.hidden.count() != 0 && self.kernel.site(self.site_of[vertex]).id != vertex
    }

    /// Lets a vertex that has no site of its own join another's.
    pub(in crate::motion) fn hide(&mut self, vertex: VertexId, s: SiteId) -> Result<()> {
        self.hidden.reserve(self.site_of.len())?;
        self.transaction.reserve_log()?;
        let representative = self.kernel.site(s).id;
        self.note_visibility(vertex.max(representative), false)?;
        if vertex < representative {
            self.kernel.rename_site(s, vertex)?;
        }
        // From here on nothing fails.
        self.transaction.log(VertexBefore {
            vertex,
            site: self.site_of[vertex],
            event: Event::Joined { representative },
        });
        self.hidden.join(representative, vertex);
        self.site_of[vertex] = s;
        Ok(())
    }

    /// Takes a vertex away from the site that it shares.
    pub(in crate::motion) fn leave(&mut self, vertex: VertexId) -> Result<()> {
        let s = self.site_of[vertex];
        self.kernel.log_site(s)?;
        self.transaction.reserve_log()?;
        let representative = self.kernel.site(s).id;
        let next = self.hidden.first_behind(representative);
        if vertex == representative {
            self.note_visibility(next, true)?;
            self.kernel.rename_site(s, next)?;
        } else {
            self.note_visibility(vertex, true)?;
        }
        // From here on nothing fails.
        let left = if vertex == representative { next } else { representative };
        self.transaction.log(VertexBefore { vertex, site: s, event: Event::Parted { representative: left } });
        self.hidden.part(representative, vertex);
        Ok(())
    }

    /// Enforces [`CoincidencePolicy::Reject`] on the present state.
    pub(in crate::motion) fn reject_coincidence(&self) -> Result<()> {
        match self.hidden.first_pair() {
            Some((vertex, other)) if self.options.coincidence == CoincidencePolicy::Reject => {
                Err(Error::Coincident { vertex, other })
            }
            _ => Ok(()),
        }
    }

    /// Enforces [`CoincidencePolicy::Reject`] on a place that `vertex` would take.
    pub(in crate::motion) fn reject_occupied(&self, vertex: VertexId, q: &G::Point) -> Result<()> {
        if self.options.coincidence == CoincidencePolicy::Merge {
            return Ok(());
        }
        match self.kernel.locate(q, Slot::NONE) {
            Place::Site(s) => {
                let there = self.kernel.site(s).id;
                Err(Error::Coincident { vertex: vertex.min(there), other: vertex.max(there) })
            }
            _ => Ok(()),
        }
    }
}
