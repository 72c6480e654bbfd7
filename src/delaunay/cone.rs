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

/// A coordinate that is not this one, and no further from zero than it or than one: no rounding takes it back, and it is in range.
fn another(x: f64) -> f64 {
    if x.abs() > 1.0 { 0.5 * x } else { x + 1.0 }
}

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
        for s in SiteId::range(1..self.sites.len()) {
            self.extend_basis(s);
        }
        for axis in 0..G::D {
            let mut apex = self.site(SiteId::new(1)).point;
            apex[axis] = another(apex[axis]);
            let n_before = self.flat.basis.sites().len();
            if n_before == G::D + 1 {
                break;
            }
            self.cover(&apex, &apex);
            let s = self.add_site(apex, VertexId::at(next))?;
            self.extend_basis(s);
            if self.flat.basis.sites().len() == n_before {
                self.drop_site(s);
                continue;
            }
            next += 1;
        }
        debug_assert!(self.flat.basis.sites().len() == G::D + 1);
        self.flat.clear();
        Ok(())
    }
}
