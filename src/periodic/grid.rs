//! The grid on which the vectors of a lattice and positions are.
//!
//! Along an axis along which any vector goes, coordinates are multiples of a power of two, the *step*, so large that a vertex
//! can be translated by any vector of the lattice that is asked for without rounding. It is the greatest one that any reduced
//! basis asks for, nearly reduced ones included, so it depends on the lattice alone, and not on which of several shortest
//! vectors are found.
//!
//! The first of the reduced bases is rounded to the grid, and with it all vectors of the lattice, so whichever vectors are
//! given, the lattice on the grid is the same. A vector that is many times as long as those may have more than 53 digits
//! then. In that case the vectors that are given are rounded instead: what a program is told has to be what is used, and a
//! number that it has given has few enough digits. The lattice on the grid follows from the vectors, and is that of others
//! only as far as these have the digits.
//!
//! What has been rounded asks for a step of its own. If that is no greater, it is the one that is used, or else all is
//! rounded once more. So the vectors on the grid, given again, have the same grid, and nothing is rounded then.

use crate::periodic::reduction::{Reduced, SLACK, dot, dual_of, exponent_above};
use crate::predicates::MAX_MAGNITUDE;

/// Coordinates on the grid, and sums of them, have at most so many bits.
const GRID_BITS: i32 = 52;

/// Where vectors go along more axes than there are vectors, vertices are anywhere along these: there is one grid for all axes,
/// so that a small component does not ask for a fine one, and it is that much coarser, in bits, so that vertices may be so many
/// times as far away.
const BITS_OF_OPEN: i32 = 10;

/// All is rounded so many times at most: rounding changes bounds by far less than a step changes from one time to the next.
const MOST_ROUNDINGS: usize = 16;

/// Vertices at home are in the unit cell, or outside of it by this share of it at most.
pub(super) const ROOM: f64 = 0.25;

/// Positions at home are so many units of the grid away at most: no translation that is asked for needs more bits than
/// there are.
pub(super) const MOST_UNITS: i128 = 1 << 52;

/// Positions may be so many units of the grid away.
const FAR: f64 = (1u64 << 62) as f64 * (1u64 << 32) as f64;

/// Translations that take a position home are so many of each vector at most, of the reduced ones and of the caller's: sums
/// of a few of them are numbers of 64 bits.
const MOST_PERIODS: f64 = (1u64 << 58) as f64;

/// Vectors on their grid.
pub(super) struct Grid {
    /// A reduced basis, on the grid, with its multiples of the vectors that were given.
    pub(super) reduced: Reduced,
    /// By axis, the step; 0 where no vector goes along it.
    pub(super) unit: [f64; 3],
    /// The vectors that were given, on the grid.
    pub(super) given: [[f64; 3]; 3],
}

impl Grid {
    /// The grid of vectors of two or three coordinates, all of three; none if they depend on each other, or nearly so.
    pub(super) fn new(basis: &[[f64; 3]]) -> Option<Self> {
        let first = Reduced::new(basis)?.first()?;
        let mut unit = unit_of(&first);
        for _ in 0..MOST_ROUNDINGS {
            let given = on_grid(&first, &unit).unwrap_or_else(|| {
                let mut given = [[0.0; 3]; 3];
                for (given, vector) in given.iter_mut().zip(basis) {
                    *given = [0, 1, 2].map(|axis| nearest(vector[axis], unit[axis]) * unit[axis]);
                }
                given
            });
            let reduced = Reduced::new(&given[..basis.len()])?;
            let next = unit_of(&reduced);
            if (0..3).all(|axis| next[axis] <= unit[axis]) {
                return reduced.is_exact.then_some(Grid { reduced, unit: next, given });
            }
            unit = [0, 1, 2].map(|axis| unit[axis].max(next[axis]));
        }
        None
    }

    /// By axis, how far away positions may be, which is farther than vertices at home are, with the linear forms of the reduced
    /// basis; none where translations may be too many.
    pub(super) fn limits(&self, dual: &[[f64; 3]; 3]) -> Option<[f64; 3]> {
        let Grid { reduced, unit, .. } = self;
        let mut limits = [MAX_MAGNITUDE; 3];
        for axis in (0..3).filter(|&axis| unit[axis] != 0.0) {
            // How many periods a position is away for each unit of length along this axis.
            let sum = |of: &dyn Fn(usize) -> f64| -> f64 {
                (0..reduced.rank).map(|j| dual[j][axis].abs() * of(j)).sum()
            };
            let of_caller = |k: usize| sum(&|j| reduced.of_caller[j][k].unsigned_abs() as f64);
            let periods = (0..reduced.rank).map(of_caller).fold(sum(&|_| 1.0), f64::max);
            limits[axis] = (unit[axis] * FAR).min(MAX_MAGNITUDE).min(MOST_PERIODS / (3.0 * periods));
            if limits[axis] < unit[axis] * MOST_UNITS as f64 {
                return None;
            }
        }
        Some(limits)
    }
}

/// The nearest number of units, all of them powers of two; 0 where there is none.
fn nearest(x: f64, unit: f64) -> f64 {
    if unit == 0.0 { 0.0 } else { (x / unit).round_ties_even() }
}

/// The caller's vectors where those of a reduced basis are rounded to a grid; none if one has too many digits for a number.
fn on_grid(reduced: &Reduced, unit: &[f64; 3]) -> Option<[[f64; 3]; 3]> {
    let (rows, to_caller) = (reduced.vectors(), reduced.to_caller()?);
    let mut given = [[0.0; 3]; 3];
    for k in 0..reduced.rank {
        for axis in 0..3 {
            let mut units = 0i128;
            for j in 0..reduced.rank {
                let of_one = nearest(rows[j][axis], unit[axis]) as i128;
                units = units.checked_add(to_caller[k][j].checked_mul(of_one)?)?;
            }
            given[k][axis] = exact(units)? * unit[axis];
        }
    }
    Some(given)
}

/// A whole number as a double; none if that would be rounded.
pub(super) fn exact(units: i128) -> Option<f64> {
    let rounded = units as f64;
    (rounded as i128 == units).then_some(rounded)
}

/// By axis, the step that all reduced bases ask for at most.
fn unit_of(reduced: &Reduced) -> [f64; 3] {
    let rank = reduced.rank;
    let mut spans = [0f64; 3];
    reduced.for_short_bases(|rows| {
        let greatest = greatest_of(rows, &dual_of(rows, rank), rank);
        for axis in 0..3 {
            let span: f64 = (0..rank).map(|j| (f64::from(greatest[j]) + 2.0) * rows[j][axis].abs()).sum();
            spans[axis] = spans[axis].max(span);
        }
    });
    let most = spans.iter().fold(0.0, |most, &x| f64::max(most, x));
    let has_open = spans.iter().filter(|&&x| x > 0.0).count() > rank;
    spans.map(|span| {
        if span == 0.0 {
            0.0
        } else if has_open {
            2f64.powi(exponent_above(2.0 * most) - GRID_BITS + BITS_OF_OPEN)
        } else {
            2f64.powi(exponent_above(2.0 * span) - GRID_BITS)
        }
    })
}

/// By vector of a reduced basis with its linear forms, the greatest multiples of images that can be needed.
pub(super) fn greatest_of(rows: &[[f64; 3]; 3], dual: &[[f64; 3]; 3], rank: usize) -> [i32; 3] {
    // The entries of G⁻¹ are products of the linear forms.
    let most = |i: usize| -> f64 {
        (0..rank).map(|j| dot(&dual[i], &dual[j]).abs() * dot(&rows[j], &rows[j])).sum()
    };
    [0, 1, 2].map(|j| if j < rank { (1.0 + 2.0 * ROOM + most(j) * (1.0 + SLACK)).floor() as i32 } else { 0 })
}
