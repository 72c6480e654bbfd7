//! Vectors: points, and differences of points.
//!
//! Bounds of rounding errors are those of an order of operations, so the order of each function is part of what it
//! promises, and all operations are rounded.
//!
//! All are written out for both dimensions: with loops over the axes `insphere` compiles to 7 % more instructions.

use crate::simd::Real;

/// What the code of a function of vectors is right for.
const fn is_dimension(d: usize) -> bool {
    d == 2 || d == 3
}

/// `p` − `q`.
#[inline(always)]
pub(crate) fn minus<T: Real, const D: usize>(p: &[T; D], q: &[T; D]) -> [T; D] {
    const { assert!(is_dimension(D)) };
    let mut difference = *p;
    (difference[0], difference[1]) = (p[0] - q[0], p[1] - q[1]);
    if D == 3 {
        difference[2] = p[2] - q[2];
    }
    difference
}

/// `p` + `q`.
#[inline(always)]
pub(super) fn plus<T: Real, const D: usize>(p: &[T; D], q: &[T; D]) -> [T; D] {
    const { assert!(is_dimension(D)) };
    let mut sum = *p;
    (sum[0], sum[1]) = (p[0] + q[0], p[1] + q[1]);
    if D == 3 {
        sum[2] = p[2] + q[2];
    }
    sum
}

/// `p`₀ `q`₀ + `p`₁ `q`₁ + `p`₂ `q`₂, from left to right.
#[inline(always)]
pub(crate) fn dot<T: Real, const D: usize>(p: &[T; D], q: &[T; D]) -> T {
    const { assert!(is_dimension(D)) };
    let sum = p[0] * q[0] + p[1] * q[1];
    if D == 3 { sum + p[2] * q[2] } else { sum }
}

/// `p`₀ `q`₁ − `p`₁ `q`₀: the cross product of the plane, the minor of the first two columns in space.
#[inline(always)]
pub(super) fn minor<T: Real, const D: usize>(p: &[T; D], q: &[T; D]) -> T {
    p[0] * q[1] - p[1] * q[0]
}

/// The cross product of space, each component like [`minor`].
#[inline(always)]
pub(crate) fn cross<T: Real>(p: &[T; 3], q: &[T; 3]) -> [T; 3] {
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
}

/// The square of the distance of two points, from the first axis on.
#[inline(always)]
pub(super) fn square_between<T: Real>(p: &[T], q: &[T]) -> T {
    let mut sum = (p[0] - q[0]) * (p[0] - q[0]);
    for axis in 1..p.len() {
        sum = sum + (p[axis] - q[axis]) * (p[axis] - q[axis]);
    }
    sum
}

/// The greatest magnitude along each axis.
#[inline(always)]
pub(super) fn greatest_along_axes<T: Real, const D: usize, const N: usize>(
    differences: [&[T; D]; N],
) -> [T; D] {
    let mut greatest = [differences[0][0].splat(0.0); D];
    for difference in differences {
        for axis in 0..D {
            greatest[axis] = difference[axis].abs().max(greatest[axis]);
        }
    }
    greatest
}

/// The greatest one of some magnitudes.
#[inline(always)]
pub(super) fn greatest_of<T: Real, const N: usize>(magnitudes: &[T; N]) -> T {
    let mut greatest = magnitudes[0];
    for &magnitude in &magnitudes[1..] {
        greatest = magnitude.max(greatest);
    }
    greatest
}

/// Squared distance, in the order of operations that the thresholds of tolerances certify.
#[inline(always)]
pub fn squared_distance<P: AsRef<[f64]>>(p: &P, q: &P) -> f64 {
    square_between(p.as_ref(), q.as_ref())
}
