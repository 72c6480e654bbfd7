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
//! |s|² V to 2/√3 · L³ |s|². Since 2 L |s| ≤ L² + |s|², all together are 2/√3 · L³ (5/2 |s|² + 3/2 L²) at most. The
//! bound is larger than what underflow adds, L being not less than [`LEAST_LENGTH`].
//!
//! # In the plane
//!
//! The same holds for `lifted.rs`: four differences, each rounded, the square of a length and a minor, twice each,
//! their product, and two sums, 11 times in all. Permanents of two rows are at most the product of their lengths, so
//! that with L for the greatest of the three distances all magnitudes add up to 3 L⁴. Where L is above 1, the bound
//! exceeds what underflow adds; for all others that is added to it.

use super::filter::{ROUND_UP, UNDERFLOW, UNIT};

/// Bound of a prepared sphere / (L³ (|s|² + 3/5 L²)) for an edge's length L and the difference s of the point.
const PREPARED_BY_LENGTHS: f64 = 17.0 * UNIT * PERMANENT_3D * 2.5 * ROUND_UP;

/// Bound of `side_of_seen_circle` / the fourth power of a corner's greatest distance.
const LIFTED_BY_LENGTHS: f64 = 11.0 * UNIT * 3.0 * ROUND_UP;

/// 2/√3, from above: of the permanent of three rows / the product of their lengths.
const PERMANENT_3D: f64 = 1.1548;

/// With edges that are shorter, underflow may be more than the rounding errors of a prepared sphere.
pub(super) const LEAST_LENGTH: f64 = 1e-30;

/// A half-space by lengths is the sphere of V = 0 and this many times L² times the facet's normal.
pub(super) const HALF_SPACE_SCALE: f64 = 4.0;

/// It keeps the bound of spheres: its terms have been rounded nine times at most, and |s|² + 3/5 L² ≥ 2 √(3/5) L |s|.
const _: () = {
    let error = 9.0 * UNIT * PERMANENT_3D * HALF_SPACE_SCALE * ROUND_UP;
    assert!(error < PREPARED_BY_LENGTHS * 1.549);
};

/// Bound of a prepared sphere, or half-space, of a cell with edges of at most this length from its first corner, for a
/// point at this squared distance from there.
#[inline(always)]
pub(super) fn prepared_bound_by_lengths(length: f64, squared_distance: f64) -> f64 {
    let square = length * length;
    PREPARED_BY_LENGTHS * (square * length) * (0.6 * square + squared_distance)
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
                let c = PREPARED_BY_LENGTHS;
                let by_lengths = product([c, x, x, x, y, y]) + product([c, 0.6, x, x, x, x, x]);
                let found = prepared_bound_by_lengths(x, y * y);
                assert!(product([found]).is_close_to(&by_lengths, 48), "{x:e}, {y:e}");
                // It covers what underflow adds.
                assert!(found > 10.0 * UNDERFLOW * (1.0 + y * y * y), "{x:e}, {y:e}");
            }
        }
    }
}
