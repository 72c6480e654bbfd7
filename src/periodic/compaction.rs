//! Compaction: vertices get the ids from 0 on, and what removed ones have left behind goes.

use std::sync::OnceLock;

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::NO_VERTEX;
use crate::periodic::inside::Inside;
use crate::periodic::triangulation::PeriodicTriangulation;

impl<G: Moving> PeriodicTriangulation<G> {
    /// Numbers the vertices that are there from 0 on, in the order of their ids, and then those of staged insertions. Returns the
    /// new id of each old one, [`NO_VERTEX`] for removed vertices. Positions, what is staged and the timestamp stay, and so do
    /// the cells, which may have other indices, as the triangulation inside is built anew; nothing is done if no vertex has
    /// been removed.
    ///
    /// # Errors
    /// [`Error::Prepared`](crate::Error::Prepared), and those of a creation, such as [`Error::OutOfMemory`](crate::Error::OutOfMemory) and
    /// [`Error::Cancelled`](crate::Error::Cancelled); nothing has happened then.
    pub fn compact(&mut self) -> Result<Vec<VertexId>> {
        self.reject_prepared()?;
        let (n_ids, n_home) = (self.inside.images.n_vertices(), self.vertex_count());
        let mut new_ids = Vec::new();
        memory::reserve_exact(&mut new_ids, self.id_count())?;
        let mut next = 0;
        for vertex in VertexId::range(0..self.id_count()) {
            let stays = vertex.index() >= n_ids || self.is_present(vertex);
            new_ids.push(if stays { VertexId::at(next) } else { NO_VERTEX });
            next += usize::from(stays);
        }
        if n_home == n_ids {
            return Ok(new_ids);
        }
        let staged = self.staged.renumbered(&new_ids, n_home)?;
        let (mut home, mut wraps) = (Vec::new(), Vec::new());
        memory::reserve_exact(&mut home, n_home)?;
        memory::reserve_exact(&mut wraps, n_home)?;
        for (vertex, inner) in self.inside.images.homes() {
            home.push((new_ids[vertex], self.inside.places[inner]));
            wraps.push(self.wraps[vertex]);
        }
        let new_id = |v: VertexId| new_ids.get(v.index()).copied().unwrap_or(NO_VERTEX);
        let taking = self.taking.as_ref().map(|taking| taking.renumbered(new_id)).transpose()?;
        let options = self.inside.t.options_of_another();
        let mut inside = Inside::unbuilt(&self.lattice, &home, n_home, options)?;
        inside.t.exchange_monitors(&mut self.inside.t);
        if let Err(error) = inside.build(&self.lattice) {
            inside.t.exchange_monitors(&mut self.inside.t);
            return Err(error);
        }
        (self.inside, self.wraps, self.staged, self.taking) = (inside, wraps, staged, taking);
        (self.cells, self.edges) = (OnceLock::new(), OnceLock::new());
        Ok(new_ids)
    }
}
