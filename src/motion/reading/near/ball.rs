//! The vertices in a ball.
//!
//! A vertex that is not the nearest to a place has a neighbour that is nearer, and so is a path to the nearest one that
//! does not leave the ball: the vertices in a ball are connected by edges.

use crate::delaunay::{Dimension, IndexSet};
use crate::error::{Error, Result};
use crate::ids::{SiteId, Slot, VertexId};
use crate::motion::reading::near::{Link, most_cells};
use crate::motion::state::checking::check_position;
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::is_within_distance;

impl<G: Dimension> MovingTriangulation<G> {
    /// The vertices whose squared distance from `centre` is at most `squared_radius`, exactly: ascending, hidden ones
    /// included.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let points = [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0], [4.0, 3.0]];
    /// let t = MovingTriangulation::<Plane>::new(&points, Options::default())?;
    /// assert_eq!(t.vertices_in_ball(&[0.0, 0.0], 16.0)?, [0, 1, 2].map(VertexId::new));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::OutOfRange`], [`Error::InvalidValue`] if the squared radius is negative or NaN,
    /// [`Error::OutOfMemory`].
    pub fn vertices_in_ball(&self, centre: &G::Point, squared_radius: f64) -> Result<Vec<VertexId>> {
        let q = check_position::<G>("centre", 0, centre)?;
        if squared_radius.is_nan() || squared_radius < 0.0 {
            let (argument, value, wanted) = ("squared_radius", squared_radius, "0 or more");
            return Err(Error::InvalidValue { argument, index: 0, value, wanted });
        }
        let kernel = &self.mesh.kernel;
        let is_in = |s: SiteId| is_within_distance(&q, &kernel.site(s).point, squared_radius);
        let mut found = IndexSet::new();
        if kernel.has_cells() && self.flood_ball(&q, is_in, &mut found)? {
            self.vertices_at(found.as_slice().iter().copied())
        } else {
            self.vertices_at(kernel.live_sites().filter(|&s| is_in(s)))
        }
    }

    /// Lists the sites in a ball around `q`; whether all have been found, before a pass over the sites takes less.
    fn flood_ball(
        &self,
        q: &G::Point,
        is_in: impl Fn(SiteId) -> bool,
        found: &mut IndexSet<SiteId>,
    ) -> Result<bool> {
        let (nearest, _) = self.nearest_sites(q, Slot::NONE)?;
        if is_in(nearest.as_slice()[0]) {
            for &s in nearest.as_slice() {
                found.insert(s)?;
            }
        }
        let (mut link, mut next, mut n_cells) = (Link::default(), 0, 0);
        while let Some(&s) = found.as_slice().get(next) {
            next += 1;
            for &x in link.list(&self.mesh.kernel, s)? {
                if is_in(x) {
                    found.insert(x)?;
                }
            }
            n_cells += link.star.as_slice().len();
            if n_cells > most_cells(&self.mesh.kernel) {
                return Ok(false);
            }
        }
        Ok(true)
    }
}
