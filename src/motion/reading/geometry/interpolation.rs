//! Values between vertices.
//!
//! They are sums of the values of some vertices, with weights: by the barycentric coordinates of the cell that holds
//! the place ([`linear`](super::linear)), or by natural neighbours ([`natural`](super::natural)).

use crate::delaunay::{Dimension, Place};
use crate::error::{Error, Result};
use crate::ids::SiteId;
use crate::machine::memory;
use crate::motion::reading::geometry::linear::{Weights, list_linear};
use crate::motion::reading::geometry::natural::Natural;
use crate::motion::reading::query::Location;
use crate::motion::state::checking::check_position;
use crate::motion::triangulation::MovingTriangulation;

/// How values between vertices follow from those at vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// Linear in each cell.
    Linear,
    /// By the weights of the natural neighbours of a place: smooth except at vertices and on the spheres of cells.
    NaturalNeighbour,
}

/// Values at vertices: `n_values` for each id.
#[derive(Clone, Copy, Debug)]
pub struct VertexValues<'v> {
    /// The values of each id, one after the other.
    pub values: &'v [f64],
    /// How many each has.
    pub n_values: usize,
}

impl<G: Dimension> MovingTriangulation<G> {
    /// Interpolates values of vertices at positions: those of each are told to `found`, or `None` for positions outside
    /// the convex hull. Values of hidden and removed vertices are not read. Each position is looked for from the one
    /// before, the first one from `near`, if that is near it.
    ///
    /// A linear function is reproduced but for rounding; at the place of a vertex, its own values are.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{Interpolation, MovingTriangulation, Options, VertexValues}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let heights = VertexValues { values: &[0.0, 1.0, 1.0, 2.0], n_values: 1 };
    /// let mut found = Vec::new();
    /// t.interpolate(Interpolation::Linear, heights, &[[0.25, 0.25], [9.0, 9.0]], None, |values| {
    ///     found.push(values.map(|values| values[0]));
    /// })?;
    /// assert_eq!(found, [Some(0.5), None]); // the last one is outside
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::WrongCount`] unless there are values for each id; [`Error::NotFinite`] and [`Error::OutOfRange`] for a
    /// position; [`Error::OutOfMemory`], before or after some have been told.
    pub fn interpolate(
        &self,
        method: Interpolation,
        given: VertexValues<'_>,
        positions: &[G::Point],
        near: Option<Location>,
        mut found: impl FnMut(Option<&[f64]>),
    ) -> Result<()> {
        let VertexValues { values, n_values } = given;
        let wanted = self.id_count() * n_values;
        if values.len() != wanted {
            let (given, coming) = (values.len(), self.staged_edits().0 * n_values);
            return Err(Error::WrongCount { argument: "the length of values", given, wanted, coming });
        }
        for (index, position) in positions.iter().enumerate() {
            check_position::<G>("positions", index, position)?;
        }
        let mut near = self.start_near(near)?;
        let (mut natural, mut weights, mut result) = (Natural::default(), Weights::new(), Vec::new());
        memory::reserve_exact(&mut result, n_values)?;
        result.resize(n_values, 0.0);
        for q in positions {
            let place = self.mesh.kernel.locate(q, near);
            near = self.slot_at(place);
            weights.clear();
            match place {
                Place::Site(s) => memory::push(&mut weights, (s, 1.0))?,
                Place::Cell(c) if method == Interpolation::NaturalNeighbour => {
                    natural.list(&self.mesh.kernel, c, q, &mut weights)?;
                }
                Place::Cell(c) => list_linear(&self.mesh.kernel, c, q, &mut weights)?,
                Place::Outside(_) | Place::NoCells => {
                    found(None);
                    continue;
                }
            }
            let values_of = |s: SiteId| &values[self.mesh.kernel.site(s).id.index() * n_values..][..n_values];
            let (first, others) = weights.split_first().expect("a vertex");
            let base = values_of(first.0);
            result.copy_from_slice(base);
            for &(s, weight) in others {
                for ((result, value), base) in result.iter_mut().zip(values_of(s)).zip(base) {
                    *result += weight * (value - base);
                }
            }
            found(Some(&result));
        }
        Ok(())
    }
}
