//! Compaction: what removed vertices have left behind goes.
//!
//! The id of a removed vertex is not given again, nor is its place in arrays by id, and free sites and cells stay
//! where they are. So a triangulation grows with the number of insertions. A compaction gives the present vertices
//! the ids from 0 on, in the order of those that they have: ties are broken by keys, which they keep, or by the order of
//! ids, so the cells stay the same.
//!
//! All that is to be kept is copied, with sites and cells in the order of a fresh build, and then takes the place of
//! what there was: a compaction that fails has changed nothing. Scratch memory goes, and so do tolerances: the next
//! commit that wants some computes them.
//!
//! Cost: the sort of a fresh build, without its insertions, and a pass over all old ids, sites and cells; while it
//! lasts, the memory of a second triangulation.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;
use crate::motion::filters::regions::Regions;
use crate::motion::state::transaction::Transaction;
use crate::motion::triangulation::MovingTriangulation;

impl<G: Moving> MovingTriangulation<G> {
    /// Numbers the present vertices from 0 on, in the order of their ids, and frees what memory serves removed ones
    /// alone. Returns the new id of each old one, [`NO_VERTEX`](crate::motion::NO_VERTEX) for vertices that have been
    /// removed.
    ///
    /// All else stays: positions, cells with their indices in [`cells`](Self::cells), what is staged, the timestamp.
    /// [`take_changes`](Self::take_changes) goes on as it would have, with vertices under their new ids.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, NO_VERTEX, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// t.remove_vertex(VertexId::new(1))?;
    /// let ids = [0, 1, 2].map(VertexId::new);
    /// assert_eq!(t.compact()?, [ids[0], NO_VERTEX, ids[1], ids[2]]);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory): for the time of the call there are two triangulations;
    /// [`Error::Prepared`](crate::Error::Prepared).
    pub fn compact(&mut self) -> Result<Vec<VertexId>> {
        self.reject_prepared()?;
        let ids = self.dense_ids()?;
        let n = self.mesh.n_present + self.staged_edits().0;
        let mut site_of = Vec::new();
        memory::reserve_exact(&mut site_of, n)?;
        let (mut kernel, slots) = self.mesh.kernel.compacted(&ids, n)?;
        let hidden = self.mesh.hidden.renumbered(kernel.keys(), &ids, n)?;
        let segments = match &self.mesh.segments {
            Some(segments) => {
                let mut sites = Vec::new();
                memory::lengthen(&mut sites, n, SiteId::NONE)?;
                for s in kernel.live_sites() {
                    hidden.for_all_at(kernel.site(s).id, |v| sites[v.index()] = s);
                }
                Some(memory::boxed(segments.renumbered(&mut kernel, &ids, &sites)?)?)
            }
            None => None,
        };
        let made = match &self.made {
            Some(made) => Some(memory::boxed(made.renumbered(&ids)?)?),
            None => None,
        };
        let staging = self.staging.renumbered(&ids, n)?;
        let edits = self.edits.renumbered(&ids, n)?;
        let views =
            self.mesh.views.renumbered(&self.mesh.kernel, &ids, &slots, kernel.complex().n_slots())?;
        // From here on nothing fails.
        site_of.resize(n, SiteId::NONE);
        self.note_tolerances_dropped();
        // The ids that are told there are others now.
        self.mesh.last_found.begin();
        (self.mesh.segments, self.made) = (segments, made);
        (self.mesh.site_of, self.staging, self.edits, self.mesh.views) = (site_of, staging, edits, views);
        let stride = kernel.mean_stride();
        self.adopt(kernel, hidden, stride);
        self.mesh.known = None;
        self.mesh.find_sites();
        (self.regions, self.repair) = (Regions::default(), None);
        (self.mesh.transaction, self.taken) = (Transaction::default(), None);
        Ok(ids)
    }

    /// For each id the number of vertices with lower ones that are present or about to be inserted, [`VertexId::NONE`]
    /// for those removed.
    fn dense_ids(&self) -> Result<Vec<VertexId>> {
        let mut ids = Vec::new();
        memory::reserve_exact(&mut ids, self.mesh.site_of.len())?;
        let first = VertexId::new(0);
        ids.extend(self.mesh.sites_of_ids().map(|(_, s)| s.map_or(VertexId::NONE, |_| first)));
        for k in 0..self.staged_edits().0 {
            ids[self.coming(k)] = first;
        }
        let all = VertexId::range(0..ids.len());
        for (next, id) in all.zip(ids.iter_mut().filter(|id| **id != VertexId::NONE)) {
            *id = next;
        }
        Ok(ids)
    }
}
