//! Vertices and cells that are near a place: which are nearest, which are in a ball or a box, which are in conflict.
//!
//! | file | what |
//! |---|---|
//! | `nearest` | the nearest vertex, and the k nearest of many places |
//! | `ball` | the vertices in a ball |
//! | `boxes` | the vertices in a box |
//! | `by_cells` | sites in order of distance where the cells are not Delaunay |
//! | `conflicts` | the cells that a new vertex would remove |
//! | `lists` | for each vertex those that are near it |
//! | `reach` | the cells and hull facets that a new vertex in a box could change, and their vertices |
//!
//! All but lists is found by floods from a located cell, from neighbour to neighbour, at about the cost of what is found, and
//! decided by exact signs. A flood that has looked at as many cells as would pay for a pass over all vertices is given
//! up for that pass.

mod ball;
mod boxes;
mod by_cells;
mod conflicts;
mod lists;
mod nearest;
mod reach;

pub(crate) use lists::{BoxTree, Entry, Lists, PlacedVertex, Search};
pub use lists::{ListsOf, NeighbourLists};
pub use reach::{InReach, VerticesInReach};

use crate::complex::INFINITE;
use crate::delaunay::{Delaunay, IndexSet, Moving};
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::machine::prefetch::prefetch;
use crate::motion::triangulation::MovingTriangulation;

/// A flood that has looked at more cells than this share of the sites takes longer than a pass over these: of 100,000
/// random vertices a cell takes as long as some twenty sites, in the plane and in space.
const MOST_CELLS_PER_SITE: f64 = 0.05;

/// The most cells that a flood looks at before all vertices are.
fn most_cells<G: Moving>(kernel: &Delaunay<G>) -> usize {
    (MOST_CELLS_PER_SITE * kernel.sites().len() as f64) as usize
}

/// The sites that share a cell with one, itself included; kept as scratch from one to the next.
#[derive(Debug, Default)]
struct AroundSite {
    star: IndexSet<Slot>,
    sites: IndexSet<SiteId>,
}

impl AroundSite {
    /// Lists those of a site.
    fn list<G: Moving>(&mut self, kernel: &Delaunay<G>, s: SiteId) -> Result<&[SiteId]> {
        self.sites.clear();
        self.star.clear();
        kernel.list_star(s, &mut self.star, |_| {})?;
        for &c in self.star.as_slice() {
            for &x in kernel.complex().cell(c).corners.as_ref().iter().filter(|&&x| x != INFINITE) {
                if self.sites.insert(x)? {
                    prefetch(kernel.sites(), x.index());
                }
            }
        }
        Ok(self.sites.as_slice())
    }
}

impl<G: Moving> MovingTriangulation<G> {
    /// All vertices at some sites, ascending.
    fn vertices_at(&self, sites: impl Iterator<Item = SiteId>) -> Result<Vec<VertexId>> {
        let mut vertices = Vec::new();
        for s in sites {
            let mut entered = Ok(());
            self.mesh.hidden.for_all_at(self.mesh.kernel.site(s).id, |vertex| {
                if entered.is_ok() {
                    entered = memory::push(&mut vertices, vertex);
                }
            });
            entered?;
        }
        vertices.sort_unstable();
        Ok(vertices)
    }
}
