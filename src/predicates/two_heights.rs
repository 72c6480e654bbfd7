//! Signs of points at *two heights*: one of their coordinates has two values.
//!
//! So are the corners of boxes, prisms and layers, which is where meshes along the axes have their ties.
//!
//! # Derivation
//!
//! Let z be the coordinate, 0 at the points of Q and H at those of P. Then z² = Hz: in the in-sphere determinant, with
//! rows (x, y, z, x² + y² + z², 1), H times the third column can be taken from the fourth. Expanded by the third,
//! which is H for P and 0 for Q, it is
//!
//! H Σ (−1)ᵏ incircle(all points but the k-th, in their order), over the k of P, counted from zero.
//!
//! So it is one dimension below, too, where what is left is the determinant of rows (x, x², 1), a product of
//! differences, and for orientations, where it is an orientation of the plane.
//!
//! A term with two points at the same place is zero: with P and Q exchanged if need be, there are one or two points in
//! P, and of two, each is absent from one term. So the determinant is zero, or one determinant of lower degree, unless
//! there are two points in P and neither is above or below one of Q. That case is left to others.
//!
//! # Cost
//!
//! Comparisons alone in the plane and for the corners of boxes; a sign of the plane otherwise.

use std::array::from_fn;
use std::cmp::Ordering;

/// The sign of the in-circle determinant, if the points are at two heights and one term is left at most.
pub(super) fn incircle_at_two_heights(points: [&[f64; 2]; 4]) -> Option<Ordering> {
    (0..2).find_map(|axis| {
        let x = points.map(|p| p[1 - axis]);
        let sign = the_term(points, axis, |k, l| x[k] == x[l], |k| vandermonde(&all_but(k, &x)))?;
        // An exchange of the coordinates changes the sign, and so does the column of the height, the second of four.
        Some(if axis == 0 { sign } else { sign.reverse() })
    })
}

/// Whether these are the corners of a rectangle along the axes, which are on a circle. Without branches, as their order
/// is any.
#[inline(always)]
pub(super) fn is_rectangle([a, b, c, d]: [&[f64; 2]; 4]) -> bool {
    let are_pairs =
        |axis: usize, [[p, q], [r, s]]: [[&[f64; 2]; 2]; 2]| (p[axis] == q[axis]) & (r[axis] == s[axis]);
    let pairings = [[[a, b], [c, d]], [[a, c], [b, d]], [[a, d], [b, c]]];
    let [x0, x1, x2] = pairings.map(|pairing| are_pairs(0, pairing));
    let [y0, y1, y2] = pairings.map(|pairing| are_pairs(1, pairing));
    (x0 & (y1 | y2)) | (x1 & (y0 | y2)) | (x2 & (y0 | y1))
}

/// The sign of the in-sphere determinant, if the points are at two heights and one term is left at most, which has the
/// sign of an in-circle determinant.
pub(super) fn insphere_at_two_heights(
    points: [&[f64; 3]; 5],
    sign_of_incircle: impl Fn([&[f64; 2]; 4]) -> Ordering,
) -> Option<Ordering> {
    (0..3).find_map(|axis| {
        let flat = points.map(|p| without(p, axis));
        let term = |k| sign_of_incircle(all_but(k, &flat.each_ref()));
        // Tetrahedra are positive when they are negative for the determinant of the derivation.
        the_term(points, axis, |k, l| flat[k] == flat[l], term).map(Ordering::reverse)
    })
}

/// The sign of the orientation of four points of space, if they are at two heights and one term is left at most, which
/// has the sign of an orientation of the plane.
pub(super) fn orient3d_at_two_heights(
    points: [&[f64; 3]; 4],
    sign_of_orient2d: impl Fn([&[f64; 2]; 3]) -> Ordering,
) -> Option<Ordering> {
    (0..3).find_map(|axis| {
        let flat = points.map(|p| without(p, axis));
        let term = |k| sign_of_orient2d(all_but(k, &flat.each_ref()));
        the_term(points, axis, |k, l| flat[k] == flat[l], term).map(Ordering::reverse)
    })
}

/// `H Σ (−1)ᵏ term(k)` over the points of P, where P and Q are exchanged if P is larger; none if two terms are left, or
/// if there are more than two heights.
#[inline(always)]
fn the_term<const D: usize, const N: usize>(
    points: [&[f64; D]; N],
    axis: usize,
    is_above: impl Fn(usize, usize) -> bool,
    term: impl Fn(usize) -> Ordering,
) -> Option<Ordering> {
    let low = points[0][axis];
    let (mut high, mut others) = (low, 0u32);
    for (k, point) in points.iter().enumerate() {
        let z = point[axis];
        if z != low {
            if others != 0 && z != high {
                return None;
            }
            (high, others) = (z, others | 1 << k);
        }
    }
    let is_p_high = 2 * others.count_ones() as usize <= N;
    let p = if is_p_high { others } else { others ^ ((1 << N) - 1) };
    // Each point of P that is above or below one of Q makes the terms without any other point of P zero.
    let mut left = p;
    for k in (0..N).filter(|k| p >> k & 1 != 0) {
        if (0..N).any(|q| p >> q & 1 == 0 && is_above(k, q)) {
            left &= 1 << k;
        }
    }
    if left.count_ones() > 1 {
        return None;
    }
    if left == 0 {
        return Some(Ordering::Equal);
    }
    let k = left.trailing_zeros() as usize;
    let is_positive = k.is_multiple_of(2) == ((high > low) == is_p_high);
    Some(if is_positive { term(k) } else { term(k).reverse() })
}

/// The sign of the determinant with rows (x, x², 1).
fn vandermonde([x, y, z]: &[f64; 3]) -> Ordering {
    let sign = |a: &f64, b: &f64| a.partial_cmp(b).expect("coordinates are numbers") as i8;
    (sign(y, x) * sign(z, x) * sign(z, y)).cmp(&0)
}

/// The coordinates but that of an axis, in cyclic order.
fn without(p: &[f64; 3], axis: usize) -> [f64; 2] {
    [p[(axis + 1) % 3], p[(axis + 2) % 3]]
}

fn all_but<T: Copy, const N: usize, const M: usize>(k: usize, items: &[T; N]) -> [T; M] {
    from_fn(|i| items[i + usize::from(i >= k)])
}

#[cfg(test)]
mod tests {
    use super::super::big;
    use super::super::plane::{sign_of_incircle, sign_of_orient2d};
    use super::*;
    use crate::random::Rng;
    use std::collections::BTreeSet;

    const CASES: usize = 100_000;

    /// Points whose coordinates are among a few, `n_values[axis]` of them, which are of any length.
    fn few_values<const D: usize, const N: usize>(rng: &mut Rng, n_values: [usize; D]) -> [[f64; D]; N] {
        let scale = [1.0, 1e-3, 1e57, 1e-300][rng.below(4)];
        let values: [[f64; 5]; D] = from_fn(|_| from_fn(|_| (rng.unit() - 0.5) * scale));
        from_fn(|_| from_fn(|axis| values[axis][rng.below(n_values[axis])]))
    }

    fn sign(det: f64) -> Ordering {
        det.partial_cmp(&0.0).expect("a number")
    }

    /// Compares the signs that are given with those of long integers. At least this share must be given, and this
    /// share of those must be zero, and not zero.
    fn check<const D: usize, const N: usize>(
        at_two_heights: impl Fn([&[f64; D]; N]) -> Option<Ordering>,
        expected: impl Fn([&[f64; D]; N]) -> Ordering,
    ) {
        let rng = &mut Rng::new(16);
        let (mut given, mut ties) = (0, 0);
        for case in 0..CASES {
            let mut n_values = [5; D];
            // The axis that has two values, and at times another one.
            n_values[case % D] = 2;
            n_values[rng.below(D)] = 2 + rng.below(2);
            let points = few_values::<D, N>(rng, n_values);
            let Some(sign) = at_two_heights(points.each_ref()) else { continue };
            assert_eq!(sign, expected(points.each_ref()), "{points:?}");
            given += 1;
            ties += usize::from(sign == Ordering::Equal);
        }
        assert!(given > CASES / 3, "{given}");
        assert!(ties > given / 8 && given - ties > given / 8, "{ties} of {given}");
    }

    #[test]
    fn signs_of_circles_are_exact() {
        check(incircle_at_two_heights, |points| sign(big::incircle(1.0, points)));
    }

    /// Corners of rectangles in any order are called so, and nothing else than ties is.
    #[test]
    fn rectangles_are_ties() {
        let rng = &mut Rng::new(17);
        let (mut n_rectangles, mut n_others) = (0, 0);
        for _ in 0..CASES {
            let n_values = [2 + rng.below(2), 2 + rng.below(2)];
            let points = few_values::<2, 4>(rng, n_values);
            let [a, b, c, d] = points;
            let are_distinct = a != b && a != c && a != d && b != c && b != d && c != d;
            let values =
                |axis: usize| points.map(|p| p[axis].to_bits()).into_iter().collect::<BTreeSet<_>>().len();
            let is_one = is_rectangle(points.each_ref());
            assert!(!is_one || big::incircle(1.0, points.each_ref()) == 0.0, "{points:?}");
            if are_distinct {
                assert_eq!(is_one, values(0) == 2 && values(1) == 2, "{points:?}");
                n_rectangles += usize::from(is_one);
                n_others += usize::from(!is_one);
            }
        }
        assert!(n_rectangles > CASES / 100 && n_others > CASES / 100, "{n_rectangles} {n_others}");
    }

    #[test]
    fn signs_of_spheres_are_exact() {
        check(
            |points| insphere_at_two_heights(points, sign_of_incircle),
            |points| sign(big::insphere(1.0, points)),
        );
    }

    #[test]
    fn signs_of_volumes_are_exact() {
        check(
            |points| orient3d_at_two_heights(points, sign_of_orient2d),
            |points| sign(big::orient3d(1.0, points)),
        );
    }

    /// Any five corners of a box are a tie that needs no arithmetic, whatever the lengths of its edges.
    #[test]
    fn corners_of_a_box_are_cospherical() {
        let edges = [[0.1, 0.3], [-7e50, 1.0 / 3.0], [1e-40, 2e-40]];
        let corner = |bits: usize| -> [f64; 3] { from_fn(|axis| edges[axis][bits >> axis & 1]) };
        let mut n = 0;
        for set in 0u32..256 {
            let corners: Vec<_> = (0..8).filter(|bit| set >> bit & 1 == 1).map(corner).collect();
            if let [a, b, c, d, e] = &corners[..] {
                let sign = insphere_at_two_heights([a, b, c, d, e], sign_of_incircle);
                assert_eq!(sign, Some(Ordering::Equal), "{corners:?}");
                n += 1;
            }
        }
        assert_eq!(n, 56);
    }
}
