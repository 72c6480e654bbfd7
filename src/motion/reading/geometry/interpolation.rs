//! Values between vertices.
//!
//! Each is a sum of the values of some vertices, with weights: by the barycentric coordinates of the cell that holds
//! the place ([`linear`](super::linear)), or by natural neighbours ([`natural`](super::natural)).

use crate::delaunay::{Moving, Place};
use crate::error::{Error, Result};
use crate::ids::{CellId, VertexId};
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

impl VertexValues<'_> {
    /// The sum of the values of some vertices with weights, of which there are some, and which add up to 1.
    #[inline(always)]
    pub(crate) fn combine(&self, weights: impl IntoIterator<Item = (VertexId, f64)>, result: &mut [f64]) {
        let values_of = |v: VertexId| &self.values[v.index() * self.n_values..][..self.n_values];
        let mut weights = weights.into_iter();
        let base = values_of(weights.next().expect("a vertex").0);
        result.copy_from_slice(base);
        for (v, weight) in weights {
            for ((result, value), base) in result.iter_mut().zip(values_of(v)).zip(base) {
                *result += weight * (value - base);
            }
        }
    }
}

impl<G: Moving> MovingTriangulation<G> {
    /// The weights of linear interpolation at a place in a cell, which is there, of its corners.
    pub(crate) fn linear_weights(
        &self,
        cell: CellId,
        q: &G::Point,
        weights: &mut Vec<(VertexId, f64)>,
    ) -> Result<()> {
        let (kernel, mut of_sites) = (&self.mesh.kernel, Weights::new());
        let slot = self.start_near(Some(Location::Cell(cell)))?;
        list_linear(kernel, slot, q, &mut of_sites)?;
        weights.clear();
        memory::collect(weights, of_sites.iter().map(|&(s, weight)| (kernel.site(s).id, weight)))
    }

    /// Interpolates values of vertices at positions: those of each are told to `found`, or `None` for positions outside
    /// the convex hull. Values of hidden and removed vertices are not read. Each position is looked for from the one
    /// before, the first one from `near`, if that is near it.
    ///
    /// A linear function is reproduced but for rounding; at the place of a vertex, its own values are. With weights
    /// vertices are those that are shown, and natural neighbours are by power cells, with the weight of a position for
    /// its own: where a vertex of that weight would be hidden, values are linear in the cell.
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
            let of_vertices = weights.iter().map(|&(s, weight)| (self.mesh.kernel.site(s).id, weight));
            given.combine(of_vertices, &mut result);
            found(Some(&result));
        }
        Ok(())
    }
}
