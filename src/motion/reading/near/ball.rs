//! The vertices in a ball.
//!
//! A vertex that is not the nearest to a place has a neighbour that is nearer, and so there is a path to the nearest
//! one that does not leave the ball: the vertices in a ball are connected by edges. Where cells are not Delaunay, as
//! with weights, they are found by cells.

use crate::delaunay::{IndexSet, Moving};
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::motion::reading::near::{AroundSite, most_cells};
use crate::motion::state::checking::{check_not_negative, check_position};
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::{is_within_distance, squared_distance};

impl<G: Moving> MovingTriangulation<G> {
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
    /// [`Error::NotFinite`](crate::Error::NotFinite), [`Error::OutOfRange`](crate::Error::OutOfRange),
    /// [`Error::InvalidValue`](crate::Error::InvalidValue) if the squared radius is negative or NaN,
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn vertices_in_ball(&self, centre: &G::Point, squared_radius: f64) -> Result<Vec<VertexId>> {
        let q = check_position::<G>("centre", 0, centre)?;
        check_not_negative("squared_radius", squared_radius)?;
        let kernel = &self.mesh.kernel;
        let is_in = |s: SiteId| is_within_distance(&q, &kernel.site(s).point, squared_radius);
        let mut found = IndexSet::new();
        if self.are_by_cells() {
            // Until there is one in the ball, the nearest has to be found.
            let mut nearest = f64::INFINITY;
            self.for_sites_by_cells(&q, Slot::NONE, |s| {
                nearest = nearest.min(squared_distance(&q, kernel.place(s)));
                if is_in(s) {
                    found.insert(s)?;
                }
                Ok(nearest.max(squared_radius))
            })?;
            self.vertices_at(found.as_slice().iter().copied())
        } else if kernel.has_cells() && self.flood_ball(&q, is_in, &mut found)? {
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
        let (mut around, mut next, mut n_cells) = (AroundSite::default(), 0, 0);
        while let Some(&s) = found.as_slice().get(next) {
            next += 1;
            for &x in around.list(&self.mesh.kernel, s)? {
                if is_in(x) {
                    found.insert(x)?;
                }
            }
            n_cells += around.star.as_slice().len();
            if n_cells > most_cells(&self.mesh.kernel) {
                return Ok(false);
            }
        }
        Ok(true)
    }
}
