//! What a vertex is to the cells: a corner of them, hidden, or gone.
//!
//! Two arrays say so, the site of each id and the id of each site, and only here are they read for it. Where vertices
//! are hidden for another reason than their place, as weights may be, it is this that has to know.

use crate::delaunay::Moving;
use crate::ids::{SiteId, VertexId};
use crate::motion::state::mesh::Mesh;

/// What a vertex is to the cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum Standing {
    /// What is seen at its site: a corner of cells, while there are any.
    Shown(SiteId),
    /// At the site of a vertex of lower key, or of equal key and lower id, which is seen.
    Hidden(SiteId),
    /// Removed, to be inserted by the next commit, or never there.
    Gone,
}

impl<G: Moving> Mesh<G> {
    /// What a vertex is to the cells.
    pub(in crate::motion) fn standing(&self, vertex: VertexId) -> Standing {
        match self.site(vertex) {
            None => Standing::Gone,
            Some(s) if self.kernel.site(s).id == vertex => Standing::Shown(s),
            Some(s) => Standing::Hidden(s),
        }
    }

    /// The site of a vertex, which it may share, if there is one of this id.
    #[inline(always)]
    pub(in crate::motion) fn site(&self, vertex: VertexId) -> Option<SiteId> {
        self.site_of.get(vertex.index()).copied().filter(|&s| s != SiteId::NONE)
    }

    /// Whether there is a vertex of this id.
    #[inline(always)]
    pub(in crate::motion) fn is_present(&self, vertex: VertexId) -> bool {
        self.site(vertex).is_some()
    }

    /// Whether an id has been given to a vertex that is not there: it has been removed, or is to be inserted.
    pub(in crate::motion) fn is_absent(&self, vertex: VertexId) -> bool {
        vertex.index() < self.site_of.len() && !self.is_present(vertex)
    }

    /// Whether a vertex that is present is hidden.
    pub(in crate::motion) fn is_hidden(&self, vertex: VertexId) -> bool {
        self.hidden.count() != 0 && matches!(self.standing(vertex), Standing::Hidden(_))
    }

    /// Every id that has been given, with what the vertex is to the cells.
    pub(in crate::motion) fn standings(&self) -> impl Iterator<Item = (VertexId, Standing)> {
        VertexId::range(0..self.site_of.len()).map(|v| (v, self.standing(v)))
    }

    /// Every id that has been given, with the site of the vertex if there is one.
    pub(in crate::motion) fn sites_of_ids(&self) -> impl Iterator<Item = (VertexId, Option<SiteId>)> {
        VertexId::range(0..self.site_of.len()).map(|v| (v, self.site(v)))
    }
}
