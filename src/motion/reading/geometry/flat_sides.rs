//! Cells that only the rounding of a straight or flat side has made.
//!
//! Vertices that were meant to be on one line or plane are not, once their coordinates are rounded: then the hull goes
//! from one to the other over flat cells, which are exactly Delaunay, and useless for a stiffness matrix. They are
//! found from the hull inwards: a cell goes if it is flat, and has a facet on the hull or on a cell that goes. So it
//! does not matter in which order they are looked at.
//!
//! A cell is flat if its least height is at most the tolerance times its longest edge. With the longest edge L, twice
//! the greatest area of a facet F, and the volume V, the least height of a tetrahedron is 6 V / F. Where F itself is at
//! most the tolerance times L², all vertices are within the tolerance times L of a line, and the cell is flat whatever
//! the rounded quotient says.
//!
//! # Accuracy
//!
//! V has a relative error of 10⁻⁹ at most. A component of a cross product of edges is the difference of two products of
//! at most L², each of which is off by 3 u; so F is off by less than √3 · 7 u L² < 2·10⁻¹⁵ L², and where it is above
//! the tolerance times L², by a part of less than 2·10⁻¹⁵ over the tolerance. Of cells so small that a volume could
//! underflow the corners are scaled by a power of two first.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::CellId;
use crate::machine::memory;
use crate::motion::reading::geometry::clipping::{Vector, cross, dot, in_space, minus};
use crate::motion::state::cells::NO_CELL;
use crate::motion::state::checking::check_not_negative;
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::Measures;

/// Cells of an extent below 2 to this are scaled before they are measured, to about 2 to the second one: squares of
/// cross products do not underflow then.
const LEAST_EXTENT: i32 = -200;
const SCALED_EXTENT: i32 = -150;

impl<G: Moving> MovingTriangulation<G> {
    /// For each cell, in the order of [`cells`](Self::cells), 0 if it is flat and on the hull, or beside such a cell;
    /// else 1. A cell is flat if its least height is at most `tolerance` times its longest edge; with 0 none is.
    ///
    /// Rounded: a cell whose quotient of the two is the tolerance but for a part of 1.1·10⁻⁹ + 2·10⁻¹⁵ / `tolerance`
    /// may be taken for either.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// // The third point is nearly on the side from the first to the second.
    /// let points = [[0.0, 0.0], [2.0, 0.0], [1.0, 1e-15], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&points, Options::default())?;
    /// let mask = t.mask_without_flat_cells(1e-9)?;
    /// assert_eq!(mask.iter().filter(|&&stays| stays == 1).count(), 2);
    /// assert_eq!(mask.len(), 3);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::InvalidValue`](crate::Error::InvalidValue) if the tolerance is negative or NaN,
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn mask_without_flat_cells(&self, tolerance: f64) -> Result<Vec<u8>> {
        let (kernel, cells) = (&self.mesh.kernel, self.cell_arrays()?);
        let slots = cells.slots();
        without_flat_cells::<G>(cells.neighbours(), tolerance, |cell| kernel.places(slots[cell]).map(|p| *p))
    }
}

/// For each cell 0 if it is flat and on the hull, or beside such a cell; else 1. With a tolerance of 0 none is flat. The corners of
/// a cell are where `places` says.
pub(crate) fn without_flat_cells<G: Moving>(
    neighbours: &[G::Neighbours],
    tolerance: f64,
    places: impl Fn(CellId) -> [G::Point; 4],
) -> Result<Vec<u8>> {
    check_not_negative("tolerance", tolerance)?;
    let is_flat = |cell| is_flat::<G>(&places(cell).each_ref()[..=G::D], tolerance);
    let (mut mask, mut waiting) = (Vec::new(), Vec::new());
    memory::lengthen(&mut mask, neighbours.len(), 1)?;
    let on_hull = |&cell: &CellId| neighbours[cell].as_ref().contains(&NO_CELL);
    if tolerance > 0.0 {
        memory::collect(&mut waiting, CellId::range(0..neighbours.len()).filter(on_hull))?;
    }
    while let Some(cell) = waiting.pop() {
        if mask[cell.index()] == 0 || !is_flat(cell) {
            continue;
        }
        mask[cell.index()] = 0;
        let beside = neighbours[cell].as_ref().iter().copied();
        memory::collect(&mut waiting, beside.filter(|&beside| beside != NO_CELL))?;
    }
    Ok(mask)
}

/// Whether the least height of a cell is at most `tolerance` times its longest edge.
fn is_flat<G: Moving>(places: &[&G::Point], tolerance: f64) -> bool {
    let extent = (0..G::D).fold(0.0f64, |most, axis| {
        places[1..].iter().fold(most, |most, p| most.max((p[axis] - places[0][axis]).abs()))
    });
    if extent < 2f64.powi(LEAST_EXTENT) {
        let scaled = scaled::<G>(places, extent);
        let mut places = [&scaled[0]; 4];
        scaled.iter().zip(&mut places).for_each(|(scaled, place)| *place = scaled);
        return is_flat_and_sized::<G>(&places[..=G::D], tolerance);
    }
    is_flat_and_sized::<G>(places, tolerance)
}

/// Whether a cell is flat, of which no volume or product of lengths underflows unless it is.
fn is_flat_and_sized<G: Moving>(places: &[&G::Point], tolerance: f64) -> bool {
    let mut points: [Vector; 4] = Default::default();
    places.iter().zip(&mut points).for_each(|(p, point)| *point = in_space::<G>(p));
    let (mut longest, mut largest) = (0.0f64, 0.0f64);
    for i in 1..places.len() {
        for j in 0..i {
            let edge = minus(&points[i], &points[j]);
            longest = longest.max(dot(&edge, &edge));
            for k in 0..j {
                let normal = cross(&edge, &minus(&points[k], &points[j]));
                largest = largest.max(dot(&normal, &normal));
            }
        }
    }
    let volume = G::Point::volume(places);
    let largest = largest.sqrt();
    if G::D == 2 {
        return 2.0 * volume <= tolerance * longest;
    }
    largest <= tolerance * longest || 6.0 * volume <= tolerance * longest.sqrt() * largest
}

/// Corners scaled by a power of two that makes a cell larger. An axis along which all are at one place has zeros: their
/// coordinate there may be too large to be scaled. Along others no coordinate is more than 2⁵³ times the extent.
#[cold]
fn scaled<G: Moving>(places: &[&G::Point], extent: f64) -> [G::Point; 4] {
    let exponent = (extent.max(f64::MIN_POSITIVE).to_bits() >> 52) as i32 - 1023;
    let half = (SCALED_EXTENT - exponent) / 2;
    let (first, second) = (2f64.powi(half), 2f64.powi(SCALED_EXTENT - exponent - half));
    let mut scaled = [*places[0]; 4];
    for axis in 0..G::D {
        let is_extended = places.iter().any(|p| p[axis] != places[0][axis]);
        for (scaled, p) in scaled.iter_mut().zip(places) {
            scaled[axis] = if is_extended { p[axis] * first * second } else { 0.0 };
        }
    }
    scaled
}
