//! Error bounds of the floating-point determinants.
//!
//! # Analysis
//!
//! Let u = 2⁻⁵³ and η = 2⁻¹⁰⁷⁵, half the least positive number. The range of coordinates excludes overflow,
//! so an operation with exact result t returns fl(t) where |fl(t) − t| ≤ u·|t| and also |fl(t) − t| ≤
//! u·|fl(t)|, and fl(t) has the sign of t; but a product below 2⁻¹⁰²² has an error of up to η instead, and
//! may become zero. Sums and differences of such size are multiples of 2η with no more than 53 bits, hence
//! exact.
//!
//! Every determinant here is a polynomial in coordinate differences. All its terms are bounded by the same
//! product of extents of the points' bounding box: one extent per axis and, where a lift takes part, the
//! square of the largest. So is every intermediate value by a product of its own, and it is described by two
//! numbers in units of that ([`Computed`]): `magnitude` bounds the computed value and `error` its distance
//! to the exact value. The rules are
//!
//! - difference of two coordinates: magnitude 1, error u (relative to the computed value, by the second
//!   inequality, so that it also holds for extents that are subnormal);
//! - product: with x = X + δ and y = Y + η for exact X, Y, |xy − XY| = |xη + yδ − δη|, then rounding of a
//!   value of at most |x||y|;
//! - sum: errors add, then rounding of a value of at most |x| + |y|;
//! - last sum: its rounding cannot change the sign, so it is only accounted for by comparing with fl(t)
//!   instead of t, where |t| ≥ (1 − u)·|fl(t)|.
//!
//! The rules are carried out by the compiler, second-order terms included, on the operation order of
//! `plane.rs`, `space.rs` and `vectors.rs`. To first order they give 6 u, 72 u, 40 u and 756 u. Keeping the
//! last rounding would give 8 u, 80 u and 46 u for the first three, as found in CGAL, Geogram and HXT; those
//! have 1122 u for the in-sphere determinant, which they expand into four products of a lift instead of
//! three.
//!
//! # Products and sums in one
//!
//! Where a product and a sum are one operation with one rounding (`vectors.rs`), the rules hold as they are.
//! With x y + z in place of fl(x y) + z the sum adds the exact product, which is bounded by what bounds
//! the rounded one, and an error has gone. The result may underflow, which a sum does not, and is η off
//! then: the η granted to the product. As the last operation it is right in sign unless it underflows, and
//! then it does not exceed a bound, all of which are at least the least normal number.
//!
//! # Underflow
//!
//! Both numbers of a value of degree k hold up to an absolute term, too, `underflow` times η·Mᵏ⁻², where M is
//! the largest extent or 1, whichever is larger. A product starts with one η of its own. It inherits, from
//! either factor, that factor's term times the magnitude of the other, whose own product of extents is at
//! most Mʲ for degree j; products of a term with an error or with another term are smaller by 2⁻⁴⁰ at least
//! and left to [`ROUND_UP`]. Terms of summands add.
//!
//! The determinants collect fewer than 300 η·Mᵏ⁻² in this way, and evaluating a bound, whose products
//! underflow like any others, loses no more than 4. Instead of the precise number, all bounds add
//! [`UNDERFLOW`] = 2⁵³ η times Mᵏ⁻²; the compiler checks that it is plenty. That much leaves determinants
//! uncertain that are below 10⁻³⁰⁷ where extents are up to 1, and below 10⁻¹³⁴ where one is as large as can
//! be.
//!
//! # Sums of magnitudes
//!
//! Ties and near ties are mostly those of structured points, many differences of which are nearly zero. Multiplied
//! out, the in-sphere determinant of `space.rs` is a sum of products of five differences each. A computed one has
//! been rounded at most 16 times on the way of each product into the sum: in its five differences, twice in a minor,
//! three times more in a volume, and in a scalar product, once in their product and twice in the last sums. So it is
//! off by at most a factor 1 ± u to the power of 16 in each product, and with P for the sum of their magnitudes, the
//! determinant by ((1 + u)¹⁶ − 1) P. Evaluated in the same order, with magnitudes for differences and sums for
//! differences of products, P comes out too small by a factor (1 − u)¹⁶ at most. To first order the bound is 16 u P
//! ([`insphere_bound_of_terms`]); second-order terms, and its own rounding, are less than 50 u of it, and left to
//! [`ROUND_UP`]. Underflow adds what it adds to the bound by extents.
//!
//! # Rounding of the bounds
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

use crate::simd::Real;

/// Unit roundoff, u.
pub(super) const UNIT: f64 = f64::EPSILON / 2.0;

/// Covers the rounding of the bounds themselves.
pub(super) const ROUND_UP: f64 = 1.0 + 1.0 / (1u64 << 40) as f64;

/// What bounds allow for underflow, times a power of the largest extent: 2⁵³ η, the least normal number.
/// Processors take longer to multiply a subnormal one than to evaluate all the rest of a bound.
pub(super) const UNDERFLOW: f64 = f64::MIN_POSITIVE;

/// Bound of `orient2d` / (extent x · extent y).
const ORIENT_2D: f64 = SQUARE.last_plus(SQUARE);

/// Bound of `incircle` / (extent x · extent y · largest extent²).
const IN_CIRCLE: f64 = {
    let (minor, dot) = (MINOR, SQUARE.plus(SQUARE));
    let term = minor.times(dot);
    term.last_plus(term)
};

/// Bound of `orient3d` / (extent x · extent y · extent z).
const ORIENT_3D: f64 = {
    let term = MINOR.times(DIFFERENCE);
    term.plus(term).last_plus(term)
};

/// Bound of `insphere` / (extent x · extent y · extent z · largest extent²).
const IN_SPHERE: f64 = {
    let dot = SQUARE.plus(SQUARE).plus(SQUARE);
    let part = MINOR.times(DIFFERENCE);
    let volume = part.plus(part).plus(part);
    let term = volume.times(dot);
    term.plus(term).last_plus(term)
};

/// Bound of `insphere` / the sum of the magnitudes of its terms.
const IN_SPHERE_TERMS: f64 = 16.0 * UNIT * ROUND_UP;

/// Bound of `side_of_seen_circle` / (extent x · extent y · largest extent²), see `lifted.rs`.
const LIFTED: f64 = {
    let term = SQUARE.plus(SQUARE).times(MINOR);
    term.plus(term).last_plus(term)
};

/// Bound of a prepared circle / (extent x · extent y · largest extent²), see `sphere.rs`.
const PREPARED_2D: f64 = {
    let lift = SQUARE.plus(SQUARE);
    let part = lift.times(DIFFERENCE);
    let term = part.plus(part).times(DIFFERENCE);
    term.plus(term).last_plus(lift.times(SQUARE.plus(SQUARE)))
};

/// Bound of a prepared sphere / (extent x · extent y · extent z · largest extent²), see `sphere.rs`.
const PREPARED_3D: f64 = {
    let lift = SQUARE.plus(SQUARE).plus(SQUARE);
    let part = lift.times(MINOR);
    let term = part.plus(part).plus(part).times(DIFFERENCE);
    let volume = MINOR.times(DIFFERENCE);
    let volume = volume.plus(volume).plus(volume);
    term.plus(term).plus(term).last_plus(lift.times(volume))
};

/// Bound of a prepared power circle / (extent x · extent y · the greater one of the square of the largest extent and the extent of
/// the weights), which bounds each of the three terms of a lift.
const POWER_PREPARED_2D: f64 = {
    let lift = SQUARE.plus(SQUARE).plus(DIFFERENCE);
    let part = lift.times(DIFFERENCE);
    let term = part.plus(part).times(DIFFERENCE);
    term.plus(term).last_plus(lift.times(SQUARE.plus(SQUARE)))
};

/// Bound of a prepared power sphere / (extent x · extent y · extent z · the greater one of the square of the largest extent and the
/// extent of the weights).
const POWER_PREPARED_3D: f64 = {
    let lift = SQUARE.plus(SQUARE).plus(SQUARE).plus(DIFFERENCE);
    let part = lift.times(MINOR);
    let term = part.plus(part).plus(part).times(DIFFERENCE);
    let volume = MINOR.times(DIFFERENCE);
    let volume = volume.plus(volume).plus(volume);
    term.plus(term).plus(term).last_plus(lift.times(volume))
};

/// Error of the vector of a circle / largest extent³, see `sphere.rs`.
pub(super) const CIRCLE_VECTOR: f64 = {
    let part = SQUARE.plus(SQUARE).times(DIFFERENCE);
    part.plus(part).error * ROUND_UP
};

/// Error of the vector of a sphere / (largest extent³ · second largest extent), see `sphere.rs`.
pub(super) const SPHERE_VECTOR: f64 = {
    let part = SQUARE.plus(SQUARE).plus(SQUARE).times(MINOR);
    part.plus(part).plus(part).error * ROUND_UP
};

/// Error of the vector of a power circle / (largest extent · q²), see `power_measures.rs`.
pub(super) const POWER_CIRCLE_VECTOR: f64 = {
    let part = SQUARE.plus(SQUARE).plus(DIFFERENCE).times(DIFFERENCE);
    part.plus(part).error * ROUND_UP
};

/// Error of the vector of a power sphere / (largest extent · second largest extent · q²), see `power_measures.rs`.
pub(super) const POWER_SPHERE_VECTOR: f64 = {
    let part = SQUARE.plus(SQUARE).plus(SQUARE).plus(DIFFERENCE).times(MINOR);
    part.plus(part).plus(part).error * ROUND_UP
};

/// Planes in place of spheres keep the bound of those, see `sphere.rs`. The rounded square of the largest
/// extent is their exact scale: [`SQUARE`] grants it an error that it has not.
const _: () = {
    let term = MINOR.times(SQUARE).times(DIFFERENCE);
    assert!(term.plus(term).last_plus(term) <= PREPARED_3D);
};

/// A 2 × 2 minor of differences.
pub(super) const MINOR: Computed = SQUARE.plus(SQUARE);

/// A product of two differences.
pub(super) const SQUARE: Computed = DIFFERENCE.times(DIFFERENCE);

/// A difference of two coordinates.
pub(super) const DIFFERENCE: Computed = Computed { magnitude: 1.0, error: UNIT, underflow: 0.0 };

/// What is known of an intermediate value of degree k, in units of its product of extents.
#[derive(Clone, Copy)]
pub(super) struct Computed {
    /// Bounds the computed value.
    pub(super) magnitude: f64,
    /// Bounds its distance to the exact value.
    error: f64,
    /// What both may be exceeded by, in units of η·Mᵏ⁻².
    underflow: f64,
}

impl Computed {
    pub(super) const fn times(self, other: Self) -> Self {
        let magnitude = self.magnitude * other.magnitude;
        let inherited =
            self.magnitude * other.error + self.error * other.magnitude + self.error * other.error;
        let underflow =
            1.0 + (self.magnitude * other.underflow + self.underflow * other.magnitude) * ROUND_UP;
        Self { magnitude: magnitude * (1.0 + UNIT), error: inherited + magnitude * UNIT, underflow }
    }

    /// What is known of a sum, or of a difference.
    pub(super) const fn plus(self, other: Self) -> Self {
        let magnitude = self.magnitude + other.magnitude;
        Self {
            magnitude: magnitude * (1.0 + UNIT),
            error: self.error + other.error + magnitude * UNIT,
            underflow: (self.underflow + other.underflow) * ROUND_UP,
        }
    }

    /// What the magnitude of a sum must exceed for its sign to be right, beside the term for underflow.
    const fn last_plus(self, other: Self) -> f64 {
        assert!(self.underflow + other.underflow < 1_000.0, "less than UNDERFLOW");
        (self.error + other.error) / (1.0 - UNIT) * ROUND_UP
    }
}

/// Error bounds valid for all points of a bounding box.
///
/// No determinant that is zero exceeds a bound. An empty or unbounded box gives infinity or NaN,
/// which nothing exceeds: all calls then take the slow path.
#[derive(Clone, Copy, Debug)]
pub struct StaticFilter {
    /// Bound of `orient2d` or `orient3d`.
    pub orient: f64,
    /// Bound of `incircle` or `insphere`.
    pub in_sphere: f64,
    /// Bound of `side_of_circle_seen` and `side_of_seen_circle`, or of `side_of_sphere_seen`.
    pub prepared: f64,
    /// Square of the largest extent, or the extent of the weights if that is greater: the greatest term of a lift.
    pub largest_square: f64,
    /// Whether rounded determinants are exact, so that one that is zero is a tie.
    pub is_exact: bool,
}

impl StaticFilter {
    /// Bounds for `orient2d` and `incircle` of points between `lower` and `upper`, inclusive.
    pub fn plane(lower: [f64; 2], upper: [f64; 2]) -> Self {
        let extents = box_extents(&lower, &upper);
        Self {
            orient: orient2d_bound(extents),
            in_sphere: incircle_bound(extents),
            prepared: lifted_bound_2d(PREPARED_2D.max(LIFTED), extents),
            largest_square: largest(extents) * largest(extents),
            is_exact: false,
        }
    }

    /// Bounds for `orient3d` and `insphere` of points between `lower` and `upper`, inclusive.
    pub fn space(lower: [f64; 3], upper: [f64; 3]) -> Self {
        let extents = box_extents(&lower, &upper);
        Self {
            orient: orient3d_bound(extents),
            in_sphere: insphere_bound(extents),
            prepared: lifted_bound_3d(PREPARED_3D, extents),
            largest_square: largest(extents) * largest(extents),
            is_exact: false,
        }
    }

    /// Bounds for `orient2d` and power circles of points between `lower` and `upper`, inclusive, of which the weights are between these
    /// two. `in_sphere` is the bound of `incircle`.
    pub fn power_plane(lower: [f64; 2], upper: [f64; 2], weights: [f64; 2]) -> Self {
        let [weight] = box_extents(&[weights[0]], &[weights[1]]);
        let filter = Self::plane(lower, upper);
        let [_, prepared] = power_bounds_2d(box_extents(&lower, &upper), weight);
        Self { prepared, largest_square: filter.largest_square.max(weight), ..filter }
    }

    /// Bounds for `orient3d` and power spheres of points between `lower` and `upper`, inclusive, of which the weights are between these
    /// two. `in_sphere` is the bound of `insphere`.
    pub fn power_space(lower: [f64; 3], upper: [f64; 3], weights: [f64; 2]) -> Self {
        let [weight] = box_extents(&[weights[0]], &[weights[1]]);
        let filter = Self::space(lower, upper);
        let [_, prepared] = power_bounds_3d(box_extents(&lower, &upper), weight);
        Self { prepared, largest_square: filter.largest_square.max(weight), ..filter }
    }
}

pub(super) fn box_extents<const D: usize>(lower: &[f64; D], upper: &[f64; D]) -> [f64; D] {
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

/// Whether a rounded determinant has the right sign, given its bound for points of the given extents.
#[inline]
pub(super) fn is_certain<const D: usize>(det: f64, bound: f64, extents: [f64; D]) -> bool {
    // Without extent along an axis, all differences along it are exactly zero, and so are both determinants.
    det.abs() > bound || extents.contains(&0.0)
}

pub(super) fn largest<const D: usize>(extents: [f64; D]) -> f64 {
    extents.into_iter().fold(0.0, f64::max)
}

pub(super) fn orient2d_bound([x, y]: [f64; 2]) -> f64 {
    ORIENT_2D * (x * y) + UNDERFLOW
}

pub(super) fn incircle_bound(extents: [f64; 2]) -> f64 {
    lifted_bound_2d(IN_CIRCLE, extents)
}

pub(super) fn orient3d_bound(extents @ [x, y, z]: [f64; 3]) -> f64 {
    ORIENT_3D * (x * y * z) + UNDERFLOW * largest(extents).max(1.0)
}

pub(super) fn insphere_bound(extents: [f64; 3]) -> f64 {
    lifted_bound_3d(IN_SPHERE, extents)
}

/// Bound of `insphere` for points of which the terms of the determinant have this sum of magnitudes, computed in the
/// order of its operations.
pub(super) fn insphere_bound_of_terms(magnitudes: f64, extents: [f64; 3]) -> f64 {
    let amplified = largest(extents).max(1.0);
    IN_SPHERE_TERMS * magnitudes + UNDERFLOW * (amplified * amplified * amplified)
}

/// Bound of a prepared circle of a triangle of this largest extent, for points no further than `reach` from
/// its corners along each axis: with an extent of its own for the two differences of the point.
pub(super) fn prepared_bound_2d(extent: f64, reach: f64) -> f64 {
    let largest = extent.max(reach);
    let amplified = largest.max(1.0);
    PREPARED_2D * (extent * extent * reach) * largest + UNDERFLOW * (amplified * amplified)
}

/// Bound of a prepared sphere of a tetrahedron of this largest extent, for points no further than `reach` from its
/// corners along each axis: with an extent of its own for the two differences of the point.
pub(super) fn prepared_bound_3d(extent: f64, reach: f64) -> f64 {
    let largest = extent.max(reach);
    let amplified = largest.max(1.0);
    PREPARED_3D * (extent * extent * extent * reach) * largest
        + UNDERFLOW * (amplified * amplified * amplified)
}

/// Bounds of `orient2d` and of a prepared circle for differences of at most these magnitudes.
#[inline(always)]
pub(super) fn semi_static_bounds_2d<T: Real>([x, y]: [T; 2]) -> [T; 2] {
    let (one, underflow) = (x.splat(1.0), x.splat(UNDERFLOW));
    let (area, largest) = (x * y, x.max(y));
    let amplified = largest.max(one);
    [
        x.splat(ORIENT_2D) * area + underflow,
        x.splat(PREPARED_2D) * area * (largest * largest) + underflow * (amplified * amplified),
    ]
}

/// Bounds of `orient3d` and of a prepared sphere for differences of at most these magnitudes.
#[inline(always)]
pub(super) fn semi_static_bounds_3d<T: Real>([x, y, z]: [T; 3]) -> [T; 2] {
    let (one, underflow) = (x.splat(1.0), x.splat(UNDERFLOW));
    let (volume, largest) = (x * y * z, x.max(y).max(z));
    let amplified = largest.max(one);
    [
        x.splat(ORIENT_3D) * volume + underflow * amplified,
        x.splat(PREPARED_3D) * volume * (largest * largest) + underflow * (amplified * amplified * amplified),
    ]
}

/// Bounds of `orient2d` and of a prepared power circle for differences of at most these magnitudes, and weights that are no
/// further apart than `weight`.
///
/// In units of products of M, the square of which is the greatest term of a lift or 1, a lift is of degree two, as it is without
/// weights; so underflow adds what it adds there.
#[inline(always)]
pub(super) fn power_bounds_2d<T: Real>([x, y]: [T; 2], weight: T) -> [T; 2] {
    let largest = x.max(y);
    let square = (largest * largest).max(weight);
    let [orient, _] = semi_static_bounds_2d([x, y]);
    let underflow = x.splat(UNDERFLOW) * square.max(x.splat(1.0));
    [orient, x.splat(POWER_PREPARED_2D) * (x * y) * square + underflow]
}

/// Bounds of `orient3d` and of a prepared power sphere for differences of at most these magnitudes, and weights that are no
/// further apart than `weight`; of underflow as in [`power_bounds_2d`].
#[inline(always)]
pub(super) fn power_bounds_3d<T: Real>([x, y, z]: [T; 3], weight: T) -> [T; 2] {
    let largest = x.max(y).max(z);
    let square = (largest * largest).max(weight);
    let [orient, _] = semi_static_bounds_3d([x, y, z]);
    let amplified = square.max(x.splat(1.0));
    let underflow = x.splat(UNDERFLOW) * (amplified * amplified.sqrt());
    [orient, x.splat(POWER_PREPARED_3D) * (x * y * z) * square + underflow]
}

fn lifted_bound_2d(constant: f64, extents @ [x, y]: [f64; 2]) -> f64 {
    let largest = largest(extents);
    let amplified = largest.max(1.0);
    constant * (x * y) * (largest * largest) + UNDERFLOW * (amplified * amplified)
}

fn lifted_bound_3d(constant: f64, extents @ [x, y, z]: [f64; 3]) -> f64 {
    let largest = largest(extents);
    let amplified = largest.max(1.0);
    constant * (x * y * z) * (largest * largest) + UNDERFLOW * (amplified * amplified * amplified)
}

#[cfg(test)]
mod tests {
    use super::super::dyadic::product;
    use super::*;
    use crate::random::Rng;

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
            assert!(!accepts(f.orient) && !accepts(f.in_sphere) && !accepts(f.prepared));
        }
    }

    /// The first N factors, of which the first is a constant, and what underflow adds: the largest extent or 1, to the
    /// power of the degree less two.
    fn check<const N: usize>(bound: f64, factors: [f64; N], largest: f64) {
        let [mut of_underflow, m] = [UNDERFLOW, largest.max(1.0)].map(|x| product([x]));
        (3..N).for_each(|_| of_underflow = of_underflow.clone() * m.clone());
        let expected = product(factors) + of_underflow;
        assert!(product([bound]).is_close_to(&expected, 48), "{bound:e}, {factors:?}, {largest:e}");
    }

    /// Each bound is what the analysis asks for, in exact numbers, for extents of all sizes; so is the part of it that
    /// underflow takes.
    #[test]
    fn bounds_are_as_documented() {
        let rng = &mut Rng::new(5);
        for case in 0..20_000 {
            let lowest = [-20, -1_060][case % 2];
            let [x, y, z] =
                std::array::from_fn(|_| (1.0 + rng.unit()) * 2f64.powi(rng.within(lowest, 180) as i32));
            let (flat, l) = (x.max(y), x.max(y).max(z));
            let [orient, prepared] = semi_static_bounds_2d([x, y]);
            check(orient, [ORIENT_2D, x, y], flat);
            check(prepared, [PREPARED_2D, x, y, flat, flat], flat);
            check(incircle_bound([x, y]), [IN_CIRCLE, x, y, flat, flat], flat);
            check(prepared_bound_2d(x, y), [PREPARED_2D, x, x, y, flat], flat);
            let [orient, prepared] = semi_static_bounds_3d([x, y, z]);
            check(orient, [ORIENT_3D, x, y, z], l);
            check(prepared, [PREPARED_3D, x, y, z, l, l], l);
            check(insphere_bound([x, y, z]), [IN_SPHERE, x, y, z, l, l], l);
            check(prepared_bound_3d(x, y), [PREPARED_3D, x, x, x, y, flat], flat);
            check(insphere_bound_of_terms(z, [x, y, y]), [IN_SPHERE_TERMS, z, 1.0, 1.0, 1.0, 1.0], flat);
        }
    }
}
