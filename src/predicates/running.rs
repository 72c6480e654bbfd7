//! Error bounds by running errors: by the values that a determinant has been computed from.
//!
//! Points close to a circle, or to a line, make small cross products of long differences, and the errors of what these
//! are multiplied by are small with them. Bounds by extents or by lengths do not know that.
//!
//! # A sum of two products
//!
//! Let C be a cross product, or D a scalar product, of rounded differences in the plane, and m the sum of the
//! magnitudes of its two products, as computed. Each of these is off by at most 3 u of itself: for two differences and
//! its own rounding. So C is off by at most e(C) = u (3 m + |C|), and D likewise ([`Running`]).
//!
//! # The in-circle determinant of `plane.rs`
//!
//! The determinant is a difference of two products C D. Each is off by at most |C| e(D) + e(C) (|D| + e(D)) + u |C D|.
//!
//! # The in-circle determinant of `lifted.rs`
//!
//! The determinant is a sum of three products S C of a square of a distance and a cross product. S is off by 4 u S, for
//! two differences, a product and a sum. With its own rounding S C is off by u S (3 m + 6 |C|), and the sum of three by
//! what they are off together and, for the first of its two roundings, by u S |C| of two of them.
//!
//! Second-order terms that are not there are less than 10 u of the bound, and left to [`ROUND_UP`]. Underflow adds what
//! it adds to the bounds by extents (`filter.rs`).

use super::filter::{ROUND_UP, UNDERFLOW, UNIT, largest};

/// A sum of two products of differences, and what it is off.
#[derive(Clone, Copy)]
pub(super) struct Running {
    magnitude: f64,
    /// What the sum is off, in units of u.
    error: f64,
}

impl Running {
    /// The sum of two products.
    #[inline(always)]
    pub(super) fn sum(first: f64, second: f64) -> Self {
        let magnitude = (first + second).abs();
        Running { magnitude, error: 3.0 * (first.abs() + second.abs()) + magnitude }
    }

    /// What its product with another is off, in units of u.
    #[inline(always)]
    fn error_of_product(self, other: Self) -> f64 {
        let of_factors = self.magnitude * other.error + self.error * (other.magnitude + UNIT * other.error);
        of_factors + self.magnitude * other.magnitude
    }

    /// What its product with the square of a distance adds to the error of `side_of_seen_circle`, in units of u.
    #[inline(always)]
    pub(super) fn error_of_lifted(self, square: f64) -> f64 {
        square * (self.error + 6.0 * self.magnitude)
    }
}

/// Bound of `incircle` for points of these extents, of which the determinant is a difference of two products.
#[inline(always)]
pub(super) fn incircle_running_bound(products: [[Running; 2]; 2], extents: [f64; 2]) -> f64 {
    let amplified = largest(extents).max(1.0);
    let [first, second] = products.map(|[c, d]| c.error_of_product(d));
    UNIT * ROUND_UP * (first + second) + UNDERFLOW * (amplified * amplified)
}

/// Bound of `side_of_seen_circle` by the [errors](Running::error_of_lifted) of its terms and the greatest of the
/// corners' squared distances.
#[inline(always)]
pub(super) fn lifted_running_bound(errors: f64, square: f64) -> f64 {
    UNIT * ROUND_UP * errors + UNDERFLOW * square.max(1.0)
}
