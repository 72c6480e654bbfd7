//! Values between vertices.
//!
//! *Linear*: the barycentric coordinates of the cell that holds the place. They come from elimination with pivots,
//! whose result leaves a small residual however flat the cell, so linear functions are reproduced; where that makes one
//! clearly negative they are quotients of volumes, which are exact but for their last bits.
//!
//! *Natural neighbours*: see `natural.rs`.

use crate::delaunay::{Delaunay, Dimension, Place};
use crate::error::{Error, Result};
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::motion::reading::geometry::natural::Natural;
use crate::motion::reading::query::Location;
use crate::motion::state::checking::check_position;
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::Measures;

/// How values between vertices follow from those at vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// Linear in each cell.
    Linear,
    /// By the weights of the natural neighbours of a place: smooth except at vertices and on the spheres of cells.
    NaturalNeighbour,
}

/// Weights of sites, which add up to 1.
pub(super) type Weights = Vec<(SiteId, f64)>;

/// Below this, a coordinate of a place in a cell is wrong.
const LEAST_COORDINATE: f64 = -1e-6;

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

/// The weights of linear interpolation at a place in a cell.
pub(super) fn list_linear<G: Dimension>(
    kernel: &Delaunay<G>,
    cell: Slot,
    q: &G::Point,
    weights: &mut Weights,
) -> Result<()> {
    let points = &kernel.places(cell)[..G::D + 1];
    let coordinates = match barycentric::<G>(points, q) {
        Some(coordinates) if coordinates.iter().all(|&x| x >= LEAST_COORDINATE) => coordinates,
        _ => by_volumes::<G>(points, q),
    };
    let corners = kernel.complex().cell(cell).corners;
    memory::collect(weights, corners.as_ref().iter().copied().zip(coordinates))
}

/// Barycentric coordinates, by elimination with pivots; none if a pivot is 0.
pub(super) fn barycentric<G: Dimension>(points: &[&G::Point], q: &G::Point) -> Option<[f64; 4]> {
    let d = G::D;
    // A row for each axis: the differences of the corners from the first one, and that of the place.
    let mut rows = [[0.0; 4]; 3];
    for (axis, row) in rows.iter_mut().enumerate().take(d) {
        let difference = |p: &G::Point| p[axis] - points[0][axis];
        points[1..].iter().zip(&mut *row).for_each(|(p, entry)| *entry = difference(p));
        row[3] = difference(q);
    }
    for k in 0..d {
        let most = (k..d).max_by(|&i, &j| rows[i][k].abs().total_cmp(&rows[j][k].abs())).expect("a row");
        rows.swap(k, most);
        let pivot = rows[k];
        if pivot[k] == 0.0 {
            return None;
        }
        for row in &mut rows[k + 1..d] {
            let factor = row[k] / pivot[k];
            (k..4).for_each(|j| row[j] -= factor * pivot[j]);
        }
    }
    let mut coordinates = [0.0; 4];
    for k in (0..d).rev() {
        let known: f64 = (k + 1..d).map(|j| rows[k][j] * coordinates[j + 1]).sum();
        coordinates[k + 1] = (rows[k][3] - known) / rows[k][k];
    }
    coordinates[0] = 1.0 - coordinates[1..=d].iter().sum::<f64>();
    Some(coordinates)
}

/// Barycentric coordinates of a place in a cell: quotients of the volumes with the place for a corner.
#[cold]
fn by_volumes<G: Dimension>(points: &[&G::Point], q: &G::Point) -> [f64; 4] {
    let mut volumes = [0.0; 4];
    for (i, volume) in volumes.iter_mut().enumerate().take(G::D + 1) {
        let mut replaced = [q; 4];
        replaced[..=G::D].copy_from_slice(points);
        replaced[i] = q;
        *volume = G::Point::volume(&replaced[..=G::D]);
    }
    let sum: f64 = volumes.iter().sum();
    volumes.map(|volume| volume / sum)
}
