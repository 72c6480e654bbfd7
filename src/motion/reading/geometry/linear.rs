//! The weights of linear interpolation: the barycentric coordinates of the cell that holds a place.
//!
//! Weights come from elimination with pivots, whose result leaves a small residual however flat the cell, so linear
//! functions are reproduced; where that makes one clearly negative they are quotients of volumes, which are exact but
//! for their last bits.

use crate::delaunay::{Delaunay, Moving};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::predicates::Measures;

/// Weights of sites, which add up to 1.
pub(super) type Weights = Vec<(SiteId, f64)>;

/// Below this, a coordinate of a place in a cell is wrong.
const LEAST_COORDINATE: f64 = -1e-6;

/// The weights of linear interpolation at a place in a cell.
pub(super) fn list_linear<G: Moving>(
    kernel: &Delaunay<G>,
    cell: Slot,
    q: &G::Point,
    weights: &mut Weights,
) -> Result<()> {
    let coordinates = linear::<G>(&kernel.places(cell)[..G::D + 1], q);
    let corners = kernel.complex().cell(cell).corners;
    memory::collect(weights, corners.as_ref().iter().copied().zip(coordinates))
}

/// Barycentric coordinates of a place in a cell with these corners.
pub(super) fn linear<G: Moving>(points: &[&G::Point], q: &G::Point) -> [f64; 4] {
    match barycentric::<G>(points, q) {
        Some(coordinates) if coordinates.iter().all(|&x| x >= LEAST_COORDINATE) => coordinates,
        _ => by_volumes::<G>(points, q),
    }
}

/// Barycentric coordinates, by elimination with pivots; none if a pivot is 0.
pub(super) fn barycentric<G: Moving>(points: &[&G::Point], q: &G::Point) -> Option<[f64; 4]> {
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
fn by_volumes<G: Moving>(points: &[&G::Point], q: &G::Point) -> [f64; 4] {
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
