//! Error bounds of the floating-point determinants.
//!
//! # Analysis
//!
//! Let u = 2⁻⁵³. Without overflow and underflow, which the range of coordinates excludes, an operation
//! with exact result t returns fl(t) where |fl(t) − t| ≤ u·|t| and also |fl(t) − t| ≤ u·|fl(t)|, and fl(t)
//! has the sign of t.
//!
//! Every determinant here is a polynomial in coordinate differences. All its terms are bounded by the same
//! product of extents of the points' bounding box: one extent per axis and, where a lift takes part, the
//! square of the largest. So is every intermediate value by a product of its own, and it is described by two
//! numbers in units of that ([`Computed`]): `magnitude` bounds the computed value and `error` its distance
//! to the exact value. The rules are
//!
//! - difference of two coordinates: magnitude 1, error u (relative to the computed value, by the second
//!   inequality);
//! - product: with x = X + δ and y = Y + η for exact X, Y, |xy − XY| = |xη + yδ − δη|, then rounding of a
//!   value of at most |x||y|;
//! - sum: errors add, then rounding of a value of at most |x| + |y|;
//! - last sum: its rounding cannot change the sign, so it is only accounted for by comparing with fl(t)
//!   instead of t, where |t| ≥ (1 − u)·|fl(t)|.
//!
//! These are carried out by the compiler, second-order terms included, on the operation order of
//! `plane.rs` and `space.rs`. To first order they give 6 u, 72 u, 40 u and 756 u. Keeping the last rounding
//! would give 8 u, 80 u and 46 u for the first three, as found in CGAL, Geogram and HXT; those have 1122 u
//! for the in-sphere determinant, which they expand into four products of a lift instead of three.
//!
//! The calculus adds and multiplies positive numbers only, fewer than 200 times, and evaluating a bound
//! takes at most six more operations; each loses at most a factor 1 − u, and the factor 1 + 2⁻⁴⁰ makes good
//! for more than 8,000 of them ([`ROUND_UP`]).
//!
//! # Whose bounding box
//!
//! Extents are rounded differences too: upper − lower. Rounding being monotone, |fl(p − q)| ≤
//! fl(upper − lower) along every axis for any p, q in the box, which is all that the analysis asks of an
//! extent. So one formula gives both the static bound, from a box of all points there are, and the
//! semi-static bound, from the box of the few points at hand.

/// Unit roundoff, u.
const UNIT: f64 = f64::EPSILON / 2.0;

/// Covers the rounding of the bounds themselves.
const ROUND_UP: f64 = 1.0 + 1.0 / (1u64 << 40) as f64;

/// Bound of `orient2d` / (extent x · extent y).
const ORIENT_2D: f64 = {
    let product = DIFFERENCE.times(DIFFERENCE);
    product.last_plus(product)
};

/// Bound of `incircle` / (extent x · extent y · largest extent²).
const IN_CIRCLE: f64 = {
    let product = DIFFERENCE.times(DIFFERENCE);
    let minor = product.plus(product);
    let dot = product.plus(product);
    let term = minor.times(dot);
    term.last_plus(term)
};

/// Bound of `orient3d` / (extent x · extent y · extent z).
const ORIENT_3D: f64 = {
    let term = MINOR_3D.times(DIFFERENCE);
    term.plus(term).last_plus(term)
};

/// Bound of `insphere` / (extent x · extent y · extent z · largest extent²).
const IN_SPHERE: f64 = {
    let square = DIFFERENCE.times(DIFFERENCE);
    let dot = square.plus(square).plus(square);
    let part = MINOR_3D.times(DIFFERENCE);
    let volume = part.plus(part).plus(part);
    let term = volume.times(dot);
    term.plus(term).last_plus(term)
};

/// Bound of a prepared circle / (extent x · extent y · largest extent²), see `sphere.rs`.
const PREPARED_2D: f64 = {
    let square = DIFFERENCE.times(DIFFERENCE);
    let lift = square.plus(square);
    let part = lift.times(DIFFERENCE);
    let term = part.plus(part).times(DIFFERENCE);
    term.plus(term).last_plus(lift.times(square.plus(square)))
};

/// Bound of a prepared sphere / (extent x · extent y · extent z · largest extent²), see `sphere.rs`.
const PREPARED_3D: f64 = {
    let square = DIFFERENCE.times(DIFFERENCE);
    let lift = square.plus(square).plus(square);
    let part = lift.times(MINOR_3D);
    let term = part.plus(part).plus(part).times(DIFFERENCE);
    let volume = MINOR_3D.times(DIFFERENCE);
    let volume = volume.plus(volume).plus(volume);
    term.plus(term).plus(term).last_plus(lift.times(volume))
};

/// A 2 × 2 minor of differences.
const MINOR_3D: Computed = {
    let product = DIFFERENCE.times(DIFFERENCE);
    product.plus(product)
};

/// A difference of two coordinates.
const DIFFERENCE: Computed = Computed { magnitude: 1.0, error: UNIT };

/// What is known of an intermediate value, in units of its product of extents.
#[derive(Clone, Copy)]
struct Computed {
    /// Bounds the computed value.
    magnitude: f64,
    /// Bounds its distance to the exact value.
    error: f64,
}

impl Computed {
    const fn times(self, other: Self) -> Self {
        let magnitude = self.magnitude * other.magnitude;
        let inherited =
            self.magnitude * other.error + self.error * other.magnitude + self.error * other.error;
        Self { magnitude: magnitude * (1.0 + UNIT), error: inherited + magnitude * UNIT }
    }

    /// Also describes a difference.
    const fn plus(self, other: Self) -> Self {
        let magnitude = self.magnitude + other.magnitude;
        Self { magnitude: magnitude * (1.0 + UNIT), error: self.error + other.error + magnitude * UNIT }
    }

    /// What the magnitude of a sum must exceed for its sign to be right.
    const fn last_plus(self, other: Self) -> f64 {
        (self.error + other.error) / (1.0 - UNIT) * ROUND_UP
    }
}

/// Error bounds valid for all points of a bounding box.
///
/// A bound of zero (a box without extent along some axis) is as valid as any: every determinant of such
/// points is computed as zero, which does not exceed it. An empty or unbounded box gives infinity or NaN,
/// which nothing exceeds: all calls then take the slow path.
#[derive(Clone, Copy, Debug)]
pub struct StaticFilter {
    /// Bound of `orient2d` or `orient3d`.
    pub orient: f64,
    /// Bound of `incircle` or `insphere`.
    pub in_sphere: f64,
    /// Bound of `side_of_circle` or `side_of_sphere`.
    pub prepared: f64,
    /// Square of the largest extent.
    pub largest_square: f64,
}

impl StaticFilter {
    /// Bounds for `orient2d` and `incircle` of points between `lower` and `upper`, inclusive.
    pub fn plane(lower: [f64; 2], upper: [f64; 2]) -> Self {
        let extents = box_extents(&lower, &upper);
        let in_sphere = incircle_bound(extents);
        let largest_square = largest(extents) * largest(extents);
        Self {
            orient: orient2d_bound(extents),
            in_sphere,
            prepared: in_sphere * (PREPARED_2D / IN_CIRCLE),
            largest_square,
        }
    }

    /// Bounds for `orient3d` and `insphere` of points between `lower` and `upper`, inclusive.
    pub fn space(lower: [f64; 3], upper: [f64; 3]) -> Self {
        let extents = box_extents(&lower, &upper);
        let in_sphere = insphere_bound(extents);
        let largest_square = largest(extents) * largest(extents);
        Self {
            orient: orient3d_bound(extents),
            in_sphere,
            prepared: in_sphere * (PREPARED_3D / IN_SPHERE),
            largest_square,
        }
    }
}

fn box_extents<const D: usize>(lower: &[f64; D], upper: &[f64; D]) -> [f64; D] {
    std::array::from_fn(|axis| {
        let extent = upper[axis] - lower[axis];
        // Also for NaN, and for the inverted box of no points: a negative extent would be no bound.
        if extent >= 0.0 { extent } else { f64::INFINITY }
    })
}

/// Extents of the points' own bounding box.
#[inline]
pub(super) fn extents<const D: usize, const N: usize>(points: [&[f64; D]; N]) -> [f64; D] {
    // Written so that each compiles to one instruction, unlike `f64::min` with its regard for NaN.
    let min = |a: f64, b: f64| if a < b { a } else { b };
    let max = |a: f64, b: f64| if a > b { a } else { b };
    std::array::from_fn(|axis| {
        let (mut lower, mut upper) = (points[0][axis], points[0][axis]);
        for p in &points[1..] {
            (lower, upper) = (min(lower, p[axis]), max(upper, p[axis]));
        }
        upper - lower
    })
}

/// Whether a rounded determinant has the right sign.
#[inline]
pub(super) fn is_certain(det: f64, bound: f64) -> bool {
    // Nothing underflows, so the bound vanishes only with an extent, and the exact determinant with it.
    det.abs() > bound || bound == 0.0
}

pub(super) fn largest<const D: usize>(extents: [f64; D]) -> f64 {
    extents.into_iter().fold(0.0, f64::max)
}

pub(super) fn orient2d_bound([x, y]: [f64; 2]) -> f64 {
    ORIENT_2D * (x * y)
}

pub(super) fn incircle_bound(extents @ [x, y]: [f64; 2]) -> f64 {
    let largest = largest(extents);
    IN_CIRCLE * (x * y) * (largest * largest)
}

pub(super) fn orient3d_bound([x, y, z]: [f64; 3]) -> f64 {
    ORIENT_3D * (x * y * z)
}

pub(super) fn insphere_bound(extents @ [x, y, z]: [f64; 3]) -> f64 {
    let largest = largest(extents);
    IN_SPHERE * (x * y * z) * (largest * largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_are_the_first_order_counts_rounded_up() {
        for (constant, count) in [(ORIENT_2D, 6.0), (IN_CIRCLE, 72.0), (ORIENT_3D, 40.0), (IN_SPHERE, 756.0)]
        {
            let first_order = count * UNIT;
            assert!(first_order < constant && constant < first_order * (1.0 + 1e-11));
        }
    }

    #[test]
    fn boxes_that_bound_nothing_accept_nothing() {
        let (inf, nan) = (f64::INFINITY, f64::NAN);
        for (lower, upper) in
            [([inf; 3], [-inf; 3]), ([-inf; 3], [inf; 3]), ([nan; 3], [nan; 3]), ([1.0; 3], [-1.0; 3])]
        {
            let f = StaticFilter::space(lower, upper);
            let accepts = |bound: f64| f64::MAX > bound;
            assert!(!accepts(f.orient) && !accepts(f.in_sphere));
        }
    }
}
