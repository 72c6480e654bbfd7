//! Error bounds by the lengths of a cell's edges.
//!
//! Where spacings differ much, spheres and circles need a bound for each cell that costs little. *By lengths* it takes
//! a few products of what has been computed for the sign itself, and it does not depend on directions.
//!
//! # In space
//!
//! Multiplied out, the value of a prepared sphere (`sphere.rs`) is a sum of products of five differences. Each has been
//! rounded at most 17 times: in the differences, three times in the square of a length, twice in a minor, three times
//! in a component of n, three times in the scalar product, and once in the last sum. So it is off by at most 17 u times
//! the sum of the magnitudes of all products, as under *Sums of magnitudes* in `filter.rs`.
//!
//! The magnitudes of a determinant's products add up to the permanent of the magnitudes, which is at most 2/√3 times
//! the product of the lengths of its three rows (Carlen, Lieb and Loss, 10.4310/MAA.2006.v13.n1.a1). With L for the
//! longest edge from the first corner, those that belong to s·n thus add up to 2/√3 · 3 L⁴ |s| at most, and those of
//! |s|² V to 2/√3 · L³ |s|². Since 2 L |s| ≤ L² + |s|², all together are 2/√3 · L³ (5/2 |s|² + 3/2 L²) at most.
//!
//! Of the volume alone each product has been rounded 8 times: in three differences, twice in a minor, three times in
//! the scalar product.
//!
//! # In the plane
//!
//! Permanents of two rows are at most the product of their lengths. Those of a prepared circle that belong to s·n add
//! up to 2 L³ |s|, those of |s|² V to L² |s|², and all together to L² (2 |s|² + L²) at most. Each product has been
//! rounded 11 times: in four differences, twice in the square of a length, in a component of n, and in the scalar
//! product, and once in the last sum. Of the area alone it is 4 times: in two differences, and twice in the minor.
//!
//! In `lifted.rs`, too, each product has been rounded 11 times: in four differences, twice in the square of a length
//! and in a minor, in their product, and in two sums. With L for the greatest of the three distances all magnitudes add
//! up to 3 L⁴. Where L is above 1, the bound exceeds what underflow adds; for all others that is added to it.
//!
//! # Underflow
//!
//! All bounds but that of `lifted.rs` exceed by far what underflow adds where L is not less than [`LEAST_LENGTH`]. They
//! grow with L, so where all edges are shorter, the bound for edges of that length holds.

use super::filter::{ROUND_UP, UNDERFLOW, UNIT};
use crate::simd::Real;

/// Bound of a prepared sphere / (L³ (|s|² + 3/5 L²)) for an edge's length L and the difference s of the point.
const PREPARED_BY_LENGTHS: f64 = 17.0 * UNIT * PERMANENT_3D * 2.5 * ROUND_UP;

/// Bound of a volume / L³.
const VOLUME_BY_LENGTHS: f64 = 8.0 * UNIT * PERMANENT_3D * ROUND_UP;

/// Bound of a prepared circle / (L² (2 |s|² + L²)).
const CIRCLE_BY_LENGTHS: f64 = 11.0 * UNIT * ROUND_UP;

/// Bound of an area / L².
const AREA_BY_LENGTHS: f64 = 4.0 * UNIT * ROUND_UP;

/// Bound of `side_of_seen_circle` / the fourth power of a corner's greatest distance.
const LIFTED_BY_LENGTHS: f64 = 11.0 * UNIT * 3.0 * ROUND_UP;

/// 2/√3, from above: of the permanent of three rows / the product of their lengths.
const PERMANENT_3D: f64 = 1.1548;

/// Where all edges are shorter than this, underflow may be more than the rounding errors of a prepared sphere.
pub(super) const LEAST_LENGTH: f64 = 1e-30;

/// A half-space by lengths is the sphere of V = 0 and this many times L² times the facet's normal.
pub(super) const HALF_SPACE_SCALE: f64 = 4.0;

/// A half-space by lengths keeps the bound of spheres: its terms have been rounded nine times at most, and |s|² + 3/5
/// L² ≥ 2 √(3/5) L |s|.
const _: () = {
    let error = 9.0 * UNIT * PERMANENT_3D * HALF_SPACE_SCALE * ROUND_UP;
    assert!(error < PREPARED_BY_LENGTHS * 1.549);
};

/// Bound of a prepared sphere, or half-space, of a cell with edges of at most a length from its first corner, which is
/// given squared and to the third power, for a point at this squared distance from there.
#[inline(always)]
pub(super) fn prepared_bound_by_length_3d<T: Real>(squared: T, cubed: T, squared_distance: T) -> T {
    cubed * cubed.splat(PREPARED_BY_LENGTHS) * (squared * squared.splat(0.6) + squared_distance)
}

/// Bound of the volume of a cell with edges of at most a length from its first corner, which is given to the third
/// power.
#[inline(always)]
pub(super) fn volume_bound_by_length<T: Real>(cubed: T) -> T {
    cubed * cubed.splat(VOLUME_BY_LENGTHS)
}

/// Bound of a prepared circle of a cell with edges of at most a length from its first corner, which is given squared,
/// for a point at this squared distance from there.
#[inline(always)]
pub(super) fn prepared_bound_by_length_2d<T: Real>(squared: T, squared_distance: T) -> T {
    squared * squared.splat(CIRCLE_BY_LENGTHS) * (squared_distance * squared.splat(2.0) + squared)
}

/// Bound of the area of a cell with edges of at most a length from its first corner, which is given squared.
#[inline(always)]
pub(super) fn area_bound_by_length<T: Real>(squared: T) -> T {
    squared * squared.splat(AREA_BY_LENGTHS)
}

/// Bound of `side_of_seen_circle` by the greatest of the corners' squared distances.
#[inline(always)]
pub(super) fn lifted_bound_by_lengths(square: f64) -> f64 {
    LIFTED_BY_LENGTHS * (square * square) + UNDERFLOW
}

#[cfg(test)]
mod tests {
    use super::super::dyadic::product;
    use super::*;
    use crate::random::Rng;

    /// The bounds are what the analysis asks for, in exact numbers, for lengths of all sizes.
    #[test]
    fn bounds_are_as_documented() {
        let rng = &mut Rng::new(5);
        for case in 0..20_000 {
            let lowest = [-20, -1_060][case % 2];
            let [x, y]: [f64; 2] =
                std::array::from_fn(|_| (1.0 + rng.unit()) * 2f64.powi(rng.within(lowest, 180) as i32));
            let seen = product([LIFTED_BY_LENGTHS, x, x, x, x]) + product([UNDERFLOW]);
            assert!(product([lifted_bound_by_lengths(x * x)]).is_close_to(&seen, 48), "{x:e}");
            if x > LEAST_LENGTH {
                let (c, underflow) = (PREPARED_BY_LENGTHS, 10.0 * UNDERFLOW);
                let by_lengths = product([c, x, x, x, y, y]) + product([c, 0.6, x, x, x, x, x]);
                let found = prepared_bound_by_length_3d(x * x, x * x * x, y * y);
                assert!(product([found]).is_close_to(&by_lengths, 48), "{x:e}, {y:e}");
                // The bound covers what underflow adds.
                assert!(found > underflow * (1.0 + y * y * y), "{x:e}, {y:e}");

                let c = CIRCLE_BY_LENGTHS;
                let by_lengths = product([2.0, c, x, x, y, y]) + product([c, x, x, x, x]);
                let found = prepared_bound_by_length_2d(x * x, y * y);
                assert!(product([found]).is_close_to(&by_lengths, 48), "{x:e}, {y:e}");
                assert!(found > underflow * (1.0 + x * x + y * y), "{x:e}, {y:e}");

                let volume = volume_bound_by_length(x * x * x);
                assert!(product([volume]).is_close_to(&product([VOLUME_BY_LENGTHS, x, x, x]), 48), "{x:e}");
                assert!(volume > underflow * (1.0 + x), "{x:e}");
                let area = area_bound_by_length(x * x);
                assert!(product([area]).is_close_to(&product([AREA_BY_LENGTHS, x, x]), 48), "{x:e}");
                assert!(area > underflow, "{x:e}");
            }
        }
    }
}
