//! Who is hidden by weight where there are no cells: the sites are in a line, a plane or at one place.
//!
//! The lower hull is that in the dimension which the sites span. With *apexes* outside, as many as are missing to a simplex, the cells of
//! all are those of the lower hull joined to the apexes: a lifted simplex without one of them is in the same hyperplane. So a site is
//! hidden if it is in no cell of a triangulation of all with apexes. What these are lifted to, and how they are ranked, is
//! no matter: in a test of a site the orientation with it in the place of an apex is zero.
//!
//! Cost: a build.

use super::{Delaunay, Geometry};
use crate::error::Result;
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;
use crate::machine::threads::Threads;

/// Of a coordinate, how far along its axis an apex may be off: further than any rounding.
const STEP: f64 = 1.0;

impl<G: Geometry> Delaunay<G> {
    /// The sites that weights hide while there are no cells.
    pub(crate) fn hidden_without_cells(&self) -> Result<Vec<SiteId>> {
        let mut hidden = Vec::new();
        if !G::HAS_WEIGHTS || self.has_cells() || self.live_sites().nth(1).is_none() {
            return Ok(hidden);
        }
        let mut cone = Delaunay::<G>::on(Threads::ONE)?;
        cone.keys = self.keys.another();
        let mut names = Vec::new();
        memory::collect(&mut names, self.live_sites())?;
        for &s in &names {
            cone.add_site(self.site(s).point, self.site(s).id)?;
        }
        cone.add_apexes(names.iter().map(|&s| self.site(s).id))?;
        cone.rebuild(&mut |_| true)?;
        for (k, &s) in names.iter().enumerate() {
            if cone.is_hidden(SiteId::at(1 + k)) {
                memory::push(&mut hidden, s)?;
            }
        }
        Ok(hidden)
    }

    /// Adds sites outside of what all others span until these span the space, as vertices above theirs.
    fn add_apexes(&mut self, ids: impl Iterator<Item = VertexId>) -> Result<()> {
        self.tighten_filter();
        let mut next = ids.map(VertexId::index).max().map_or(0, |most| most + 1);
        let mut n = 0;
        for s in SiteId::range(1..self.sites.len()) {
            self.extend_basis(s);
        }
        for axis in 0..G::D {
            let mut apex = self.site(SiteId::new(1)).point;
            // Half as far again as it is from zero, which no rounding takes back.
            apex[axis] += (0.5 * apex[axis].abs()).max(STEP);
            let before = self.flat.basis.sites().len();
            if before == G::D + 1 {
                break;
            }
            self.cover(&apex, &apex);
            let s = self.add_site(apex, VertexId::at(next))?;
            if !self.extend_basis(s) && self.flat.basis.sites().len() == before {
                self.drop_site(s);
                continue;
            }
            (next, n) = (next + 1, n + 1);
        }
        debug_assert!(n > 0 && self.flat.basis.sites().len() == G::D + 1);
        self.flat.clear();
        Ok(())
    }
}
