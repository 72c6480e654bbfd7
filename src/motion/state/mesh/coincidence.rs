//! Vertices at the same place: that of the lowest key and then of the lowest id represents it, the others are [hidden](crate::motion::state::hidden) until
//! they move apart.

use crate::delaunay::{Delaunay, Moving, Place};
use crate::error::{Error, Result};
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::options::CoincidencePolicy;
use crate::motion::state::hidden::Hidden;
use crate::motion::state::mesh::{Mesh, Standing};
use crate::motion::state::transaction::{Event, VertexBefore};

impl<G: Moving> Mesh<G> {
    /// Whether several vertices are at a site.
    #[inline(always)]
    pub(in crate::motion) fn is_shared(&self, s: SiteId) -> bool {
        self.hidden.count() != 0 && self.hidden.is_followed(self.kernel.site(s).id)
    }

    /// Lets a vertex that has no site of its own join another's.
    pub(in crate::motion) fn hide(&mut self, vertex: VertexId, s: SiteId) -> Result<()> {
        self.hidden.reserve(self.site_of.len())?;
        self.transaction.reserve_log()?;
        let representative = self.kernel.site(s).id;
        let is_shown = self.kernel.keys().is_lower(vertex, representative);
        self.note_visibility(if is_shown { representative } else { vertex }, false)?;
        if is_shown {
            self.kernel.rename_site(s, vertex)?;
        }
        // From here on nothing fails.
        self.transaction.log(VertexBefore {
            vertex,
            site: self.site_of[vertex],
            event: Event::Joined { representative },
        });
        self.hidden.join(self.kernel.keys(), representative, vertex);
        self.site_of[vertex] = s;
        Ok(())
    }

    /// Takes a vertex away from the site that it shares.
    pub(in crate::motion) fn leave(&mut self, vertex: VertexId) -> Result<()> {
        let s = self.site_of[vertex];
        self.kernel.log_site(s)?;
        self.transaction.reserve_log()?;
        let representative = self.kernel.site(s).id;
        let next = self.hidden.first_behind(self.kernel.keys(), representative);
        if vertex == representative {
            self.note_visibility(next, true)?;
            self.kernel.rename_site(s, next)?;
        } else {
            self.note_visibility(vertex, true)?;
        }
        // From here on nothing fails.
        let left = if vertex == representative { next } else { representative };
        self.transaction.log(VertexBefore { vertex, site: s, event: Event::Parted { representative: left } });
        self.hidden.part(self.kernel.keys(), representative, vertex);
        Ok(())
    }

    /// Enforces [`CoincidencePolicy::Reject`] on the present state.
    pub(in crate::motion) fn reject_coincidence(&self, policy: CoincidencePolicy) -> Result<()> {
        match self.hidden.first_pair(self.kernel.keys()) {
            Some((vertex, other)) if policy == CoincidencePolicy::Reject => {
                Err(Error::Coincident { vertex, other })
            }
            _ => Ok(()),
        }
    }

    /// Enforces [`CoincidencePolicy::Reject`] on a place that `vertex` would take. Where there are weights others may be there that
    /// cells do not show: those are looked for after the change.
    pub(in crate::motion) fn reject_occupied(
        &self,
        vertex: VertexId,
        q: &G::Point,
        policy: CoincidencePolicy,
    ) -> Result<()> {
        if policy == CoincidencePolicy::Merge || G::HAS_WEIGHTS {
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

    /// Notes that a vertex is about to be hidden or shown, if the program takes changes.
    pub(in crate::motion) fn note_visibility(&mut self, vertex: VertexId, was_hidden: bool) -> Result<()> {
        if !self.takes_changes {
            return Ok(());
        }
        self.views.visibilities_mut().note(vertex, was_hidden)
    }

    /// Notes the vertices that a new kernel hides and the present one does not, or the other way round. Insertions that
    /// are staged, but not a part of this change, are in neither.
    pub(in crate::motion) fn note_visibilities_of(
        &mut self,
        next: &Delaunay<G>,
        hidden: &Hidden,
    ) -> Result<()> {
        if !self.takes_changes || self.hidden.count() + hidden.count() == 0 {
            return Ok(());
        }
        for s in next.live_sites() {
            let representative = next.site(s).id;
            if self.is_present(representative) && self.is_hidden(representative) {
                self.note_visibility(representative, true)?;
            }
            let mut noted = Ok(());
            hidden.for_all_behind(representative, |v| {
                if noted.is_ok() && (!self.is_present(v) || !self.is_hidden(v)) {
                    noted = self.note_visibility(v, false);
                }
            });
            noted?;
        }
        Ok(())
    }

    /// Gives every hidden vertex a site of its own in a new kernel, at the place where it is. Returns vertices and
    /// sites, by vertex.
    pub(in crate::motion) fn spread_hidden(&self, next: &mut Delaunay<G>) -> Result<Vec<(VertexId, SiteId)>> {
        let mut spread = Vec::new();
        if self.hidden.count() == 0 {
            return Ok(spread);
        }
        memory::reserve_exact(&mut spread, self.hidden.count())?;
        for (v, standing) in self.standings() {
            if let Standing::Hidden(s) = standing {
                spread.push((v, next.add_site(self.kernel.site(s).point, v)?));
            }
        }
        Ok(spread)
    }

    /// The site that a vertex has for itself in a new kernel where the hidden ones have been
    /// [spread](Self::spread_hidden).
    pub(in crate::motion) fn own_site(&self, spread: &[(VertexId, SiteId)], vertex: VertexId) -> SiteId {
        let at = spread.binary_search_by_key(&vertex, |&(hidden, _)| hidden);
        at.map_or(self.site_of[vertex], |k| spread[k].1)
    }
}
