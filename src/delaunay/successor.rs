//! A kernel to be built beside another one, so that this stays as it is until the new one is complete.

use super::{Delaunay, Geometry, Site};
use crate::error::Result;
use crate::ids::Slot;
use crate::machine::memory;
use crate::machine::prefetch::AHEAD;

impl<G: Geometry> Delaunay<G> {
    /// A kernel with the same sites, but without cells, and with room for `more` of them. `place` tells where a live
    /// one is; `announce` is told of those that come later. The scratch memory goes along, until it is [given
    /// back](Self::give_scratch_to).
    pub(crate) fn successor(
        &mut self,
        more: usize,
        place: impl Fn(&Site<G>) -> G::Point,
        announce: impl Fn(&Site<G>),
    ) -> Result<Self> {
        let mut sites = Vec::new();
        memory::reserve_exact(&mut sites, self.sites.len() + more)?;
        let free_sites = memory::copy_of(&self.free_sites)?;
        let parts = self.parts.copy()?;
        sites.push(self.sites[0]);
        for (k, site) in self.sites.iter().enumerate().skip(1) {
            if let Some(next) = self.sites.get(k + AHEAD) {
                announce(next);
            }
            let point = if site.is_live() { place(site) } else { site.point };
            sites.push(Site { point, cell: Slot::NONE, id: site.id });
        }
        let mut next = Delaunay {
            sites,
            keys: self.keys.another(),
            free_sites,
            parts,
            threads: self.threads,
            ..Delaunay::empty()
        };
        self.give_scratch_to(&mut next);
        (next.certificates, next.link_sites) = (self.certificates, self.link_sites);
        Ok(next)
    }

    /// Whether a rebuild leaves all sites at their indices: for several threads they may change places.
    pub(crate) fn keeps_sites(&self) -> bool {
        self.parts.count() == 1
    }

    /// Gives all scratch memory to another kernel.
    pub(crate) fn give_scratch_to(&mut self, other: &mut Self) {
        other.cavity = std::mem::take(&mut self.cavity);
        other.star = std::mem::take(&mut self.star);
        other.hole = self.hole.take();
        other.wrapping = self.wrapping.take();
        other.flips = std::mem::take(&mut self.flips);
        // Most sites keep their indices, and any site will do.
        other.landmarks = std::mem::take(&mut self.landmarks);
    }
}
