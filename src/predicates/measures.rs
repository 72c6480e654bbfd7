//! Volumes and circumspheres of cells: rounded numbers of known accuracy, and exact comparisons of radii.
//!
//! With the differences u, v, w from corner `a` of a positively oriented cell to the others, the
//! [prepared sphere](super::sphere) has a vector n and a determinant V of theirs: V is twice the area or six times the
//! volume, and the circumcentre is *a* + n / 2V.
//!
//! # Accuracy
//!
//! V is within the bound B of its orientation (`filter.rs`). Where the rounded one exceeds 2³⁰ B, its relative error is
//! below 2⁻³⁰ and a little; elsewhere it is computed from integers of any length (`big.rs`) and rounded.
//!
//! Let e₁ ≥ e₂ be the two greatest magnitudes of differences along an axis; in the plane take e₁ for e₂ in what
//! follows, and one e₁ less. A component of n is off by at most β e₁³ e₂, with β of `filter.rs`. One of the edges is no
//! shorter than e₁, hence the circumradius R ≥ e₁ / 2. Where V > 2³¹ β e₁² e₂, a component of n / 2V is off by no more
//! than e₁ / 2³² ≤ R / 2³¹ from n, and by R / 2³¹ times the ratio of the bounds of V and n, which is at most 6 / 28,
//! from V; so that it is within R / 2³⁰, and the square of its length within a factor 1 ± 2⁻²⁸. Elsewhere n and V are
//! computed from integers, and quotients are off by a few last bits.
//!
//! Underflow takes no more than 100 η max(1, e₁²) off n. With V > 10⁻²⁵⁰ max(1, e₁³) and e₁ > 10⁻⁶⁰ that is less than
//! a hundredth of the above; below, too, integers are used. Nothing overflows but quotients and squares, where the
//! circumcentre or the squared radius itself is beyond the range of numbers.

use super::big::{
    Integer, LimbRoom, Ring, decode, differences_in_units, minor as big_minor, square, volume as big_volume,
};
use super::filter::{CIRCLE_VECTOR, SPHERE_VECTOR, semi_static_bounds_2d, semi_static_bounds_3d};
use super::integer::power_of_two;
use super::sphere::{circle, sphere};
use super::vectors::{dot, greatest_along_axes, minor, minus, plus};
use crate::simd::Real;
use std::cmp::Ordering;

/// By how much a rounded determinant must exceed its bound to be used as a value.
pub(super) const SHARP: f64 = (1u64 << 30) as f64;

/// By how much a rounded determinant must exceed its bound to be used where quotients of volumes are weights.
const VERY_SHARP: f64 = (1u64 << 43) as f64;

/// Determinants and differences above these have not suffered from underflow.
pub(super) const LEAST_VOLUME: f64 = 1e-250;
pub(super) const LEAST_EXTENT: f64 = 1e-60;

/// What a squared radius must differ by from a rounded one, relatively, to be certainly less or greater.
pub(super) const MARGIN: f64 = 1.0 / (1u64 << 27) as f64;

/// Measures of a positively oriented cell, given by its `D + 1` corners.
pub trait Measures: Sized {
    /// Area or volume: positive, with a relative error of at most 10⁻⁹ unless it is below the least normal number.
    #[inline(always)]
    fn volume(cell: &[&Self]) -> f64 {
        Self::volume_by(cell, SHARP)
    }

    /// Area or volume, with a relative error of at most 1.2·10⁻¹³ unless it is below the least normal number.
    #[inline(always)]
    fn sharp_volume(cell: &[&Self]) -> f64 {
        Self::volume_by(cell, VERY_SHARP)
    }

    /// Area or volume, from integers unless the rounded determinant exceeds so many times its bound.
    fn volume_by(cell: &[&Self], sharp: f64) -> f64;

    /// Circumcentre and squared circumradius. A coordinate is off by at most 10⁻⁹ circumradii and its own rounding, the
    /// square by 4·10⁻⁹ of itself. What is beyond the range of numbers is infinite. Of points with weights
    /// (`power_measures.rs`) they are those of the power sphere, with other bounds.
    fn circumsphere(cell: &[&Self]) -> (Self, f64);

    /// The circumcentre, and the square of a length m: a coordinate is off by at most 10⁻⁹ m and its own rounding. It
    /// is the circumradius; of points with weights the greatest of the distance of the power centre from the first
    /// corner, of differences of coordinates from that, and of roots of differences of weights.
    #[inline(always)]
    fn centre(cell: &[&Self]) -> (Self, f64) {
        Self::circumsphere(cell)
    }

    /// Whether the squared circumradius is at most `squared`, which is not negative: exactly.
    fn is_circumradius_within(cell: &[&Self], squared: f64) -> bool;
}

/// What is known of a circumsphere from rounded numbers.
pub(super) struct Rounded<const D: usize> {
    /// From the first corner to the centre.
    pub(super) offset: [f64; D],
    /// Whether the offset is as accurate as the module's documentation says.
    pub(super) is_sharp: bool,
    /// Greatest magnitude of a difference along an axis.
    pub(super) extent: f64,
}

impl<const D: usize> Rounded<D> {
    #[inline(always)]
    fn new(n: [f64; D], volume: f64, extent: f64, bound: f64) -> Self {
        let amplified = if extent > 1.0 { extent * extent * extent } else { 1.0 };
        let is_sharp = extent > LEAST_EXTENT && volume > bound + LEAST_VOLUME * amplified;
        Rounded { offset: n.map(|x| x / (2.0 * volume)), is_sharp, extent }
    }

    /// Whether the squared radius is at most `squared`, from `exactly` where that is not certain.
    #[inline(always)]
    fn is_within(&self, squared: f64, exactly: impl FnOnce() -> bool) -> bool {
        let own = dot(&self.offset, &self.offset);
        // One branch, as the answer cannot be predicted.
        let is_apart = (own < squared * (1.0 - MARGIN)) | (own > squared * (1.0 + MARGIN));
        if self.is_sharp & is_apart {
            return own < squared;
        }
        // The radius is at least half the extent, with room for the rounding of the extent and of this.
        let is_flat_and_large = !self.is_sharp && squared < 0.2499 * (self.extent * self.extent);
        !is_flat_and_large && exactly()
    }
}

impl Measures for [f64; 2] {
    #[inline(always)]
    fn volume_by(cell: &[&Self], sharp: f64) -> f64 {
        let &[a, b, c] = cell else { unreachable!("a triangle") };
        let (u, v) = (minus(b, a), minus(c, a));
        let [bound, _] = semi_static_bounds_2d(greatest_along_axes([&u, &v]));
        let det = minor(&u, &v);
        if det > sharp * bound { 0.5 * det } else { exact_volume([a, b, c], |[u, v]| big_minor(u, v), 0.5) }
    }

    #[inline(always)]
    fn circumsphere(cell: &[&Self]) -> (Self, f64) {
        let &[a, b, c] = cell else { unreachable!("a triangle") };
        finish(a, rounded2d([a, b, c]), || exact_offset([a, b, c], |p| exact_circle(p)))
    }

    #[inline(always)]
    fn is_circumradius_within(cell: &[&Self], squared: f64) -> bool {
        let &[a, b, c] = cell else { unreachable!("a triangle") };
        let rounded = rounded2d([a, b, c]);
        rounded.is_within(squared, || is_exactly_within([a, b, c], squared, |p| exact_circle(p)))
    }
}

impl Measures for [f64; 3] {
    #[inline(always)]
    fn volume_by(cell: &[&Self], sharp: f64) -> f64 {
        let &[a, b, c, d] = cell else { unreachable!("a tetrahedron") };
        let (u, v, w) = (minus(b, a), minus(c, a), minus(d, a));
        let [bound, _] = semi_static_bounds_3d(greatest_along_axes([&u, &v, &w]));
        let det = super::space::volume(&u, &v, &w);
        let sixth = 1.0 / 6.0;
        if det > sharp * bound {
            det * sixth
        } else {
            exact_volume([a, b, c, d], |[u, v, w]| big_volume(u, v, w), sixth)
        }
    }

    #[inline(always)]
    fn circumsphere(cell: &[&Self]) -> (Self, f64) {
        let &[a, b, c, d] = cell else { unreachable!("a tetrahedron") };
        finish(a, rounded3d([a, b, c, d]), || exact_offset([a, b, c, d], |p| exact_sphere(p)))
    }

    #[inline(always)]
    fn is_circumradius_within(cell: &[&Self], squared: f64) -> bool {
        let &[a, b, c, d] = cell else { unreachable!("a tetrahedron") };
        let rounded = rounded3d([a, b, c, d]);
        rounded.is_within(squared, || is_exactly_within([a, b, c, d], squared, |p| exact_sphere(p)))
    }
}

#[inline(always)]
pub(super) fn rounded2d([a, b, c]: [&[f64; 2]; 3]) -> Rounded<2> {
    let [x, y, volume] = circle(a, b, c);
    let [e, f] = greatest_along_axes([&minus(b, a), &minus(c, a)]);
    let extent = Real::max(e, f);
    Rounded::new([x, y], volume, extent, 2.0 * SHARP * CIRCLE_VECTOR * (extent * extent))
}

#[inline(always)]
pub(super) fn rounded3d([a, b, c, d]: [&[f64; 3]; 4]) -> Rounded<3> {
    let [x, y, z, volume] = sphere(a, b, c, d);
    let [e, f, g] = greatest_along_axes([&minus(b, a), &minus(c, a), &minus(d, a)]);
    let (more, less) = (Real::max(e, f), Real::min(e, f));
    let (extent, second) = (Real::max(more, g), Real::max(Real::min(more, g), less));
    let bound = 2.0 * SHARP * SPHERE_VECTOR * (extent * extent * second);
    Rounded::new([x, y, z], volume, extent, bound)
}

/// The centre and the squared radius, from `exactly` where rounded numbers are not sharp.
#[inline(always)]
fn finish<const D: usize>(
    a: &[f64; D],
    rounded: Rounded<D>,
    exactly: impl FnOnce() -> [f64; D],
) -> ([f64; D], f64) {
    let offset = if rounded.is_sharp { rounded.offset } else { exactly() };
    (plus(a, &offset), dot(&offset, &offset))
}

/// The vector and the determinant of a circle.
pub(super) fn exact_circle<T: Ring>(differences: &[[T; 2]; 2]) -> ([T; 2], T) {
    lifted_circle(differences, differences.each_ref().map(square))
}

/// The vector and the determinant of a circle of differences with these lifts.
pub(super) fn lifted_circle<T: Ring>([u, v]: &[[T; 2]; 2], [uu, vv]: [T; 2]) -> ([T; 2], T) {
    ([uu * v[1] - vv * u[1], vv * u[0] - uu * v[0]], big_minor(u, v))
}

/// The vector and the determinant of a sphere.
pub(super) fn exact_sphere<T: Ring>(differences: &[[T; 3]; 3]) -> ([T; 3], T) {
    lifted_sphere(differences, differences.each_ref().map(square))
}

/// The vector and the determinant of a sphere of differences with these lifts.
pub(super) fn lifted_sphere<T: Ring>([u, v, w]: &[[T; 3]; 3], [uu, vv, ww]: [T; 3]) -> ([T; 3], T) {
    let cross = |p: &[T; 3], q: &[T; 3]| {
        [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
    };
    let (vw, uw, uv) = (cross(v, w), cross(u, w), cross(u, v));
    let n = std::array::from_fn(|axis| uu * vw[axis] - vv * uw[axis] + ww * uv[axis]);
    (n, u[0] * vw[0] + u[1] * vw[1] + u[2] * vw[2])
}

/// A determinant of the differences times a factor, rounded.
#[cold]
#[inline(never)]
fn exact_volume<const D: usize, const M: usize, const N: usize>(
    points: [&[f64; D]; N],
    det: impl for<'r> FnOnce(&[[Integer<'r>; D]; M]) -> Integer<'r>,
    factor: f64,
) -> f64 {
    let room = LimbRoom::new();
    let (unit, differences) = differences_in_units(&room, points[0], others(points), i32::MAX);
    let (mantissa, exponent) = det(&differences).rounded();
    // The cell is positive, though its volume may be less than any number.
    scaled(mantissa * factor, exponent + D as i32 * unit).max(f64::from_bits(1))
}

/// From the first corner to the centre, rounded.
#[cold]
#[inline(never)]
pub(super) fn exact_offset<const D: usize, const M: usize, const N: usize>(
    points: [&[f64; D]; N],
    sphere: impl for<'r> FnOnce(&[[Integer<'r>; D]; M]) -> ([Integer<'r>; D], Integer<'r>),
) -> [f64; D] {
    let room = LimbRoom::new();
    let (unit, differences) = differences_in_units(&room, points[0], others(points), i32::MAX);
    let (n, volume) = sphere(&differences);
    let (divisor, shift) = volume.rounded();
    n.map(|n| {
        let (mantissa, exponent) = n.rounded();
        scaled(mantissa / divisor, exponent - shift - 1 + unit)
    })
}

/// Whether |n|² ≤ 4 V² `squared`.
#[cold]
#[inline(never)]
fn is_exactly_within<const D: usize, const M: usize, const N: usize>(
    points: [&[f64; D]; N],
    squared: f64,
    sphere: impl for<'r> FnOnce(&[[Integer<'r>; D]; M]) -> ([Integer<'r>; D], Integer<'r>),
) -> bool {
    if squared == f64::INFINITY {
        return true;
    }
    let room = LimbRoom::new();
    let (mantissa, exponent) = decode(squared);
    // The square of the unit must divide the given one.
    let most = exponent.div_euclid(2);
    let (unit, differences) = differences_in_units(&room, points[0], others(points), most);
    let (n, volume) = sphere(&differences);
    let given = Integer::shifted(&room, mantissa, (exponent - 2 * unit + 2) as u32);
    square(&n).compare_magnitude(&(volume * volume * given)) != Ordering::Greater
}

/// All but the first.
pub(super) fn others<P: Copy, const M: usize, const N: usize>(points: [P; N]) -> [P; M] {
    const { assert!(M + 1 == N) };
    std::array::from_fn(|k| points[k + 1])
}

/// `x` · 2^`exponent`, infinite or zero beyond the range of numbers.
pub(super) fn scaled(mut x: f64, mut exponent: i32) -> f64 {
    const STEP: i32 = 1000;
    while exponent.abs() > STEP && x != 0.0 && x.is_finite() {
        let step = STEP * exponent.signum();
        x *= power_of_two(step);
        exponent -= step;
    }
    x * power_of_two(exponent.clamp(-STEP, STEP))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Rng;

    /// Whether rounded numbers are sharp depends on the shape of a cell, not on its size, and is certain of all but
    /// flat ones: those of which the determinant is a billionth of what it may be.
    fn check<const D: usize, const N: usize>(rounded: impl Fn([&[f64; D]; N]) -> Rounded<D>) {
        let rng = &mut Rng::new(12);
        let (mut n_sharp, mut n_blunt) = (0, 0);
        for case in 0..4_000 {
            // The last coordinates are smaller, down to 2^-26 of the others.
            let flatness = 2f64.powi(-(case % 27));
            let mut points: [[f64; D]; N] =
                std::array::from_fn(|_| std::array::from_fn(|_| (rng.unit() * 1024.0).round()));
            points.iter_mut().for_each(|p| p[D - 1] *= flatness);
            let here = rounded(points.each_ref());
            n_sharp += usize::from(here.is_sharp);
            n_blunt += usize::from(!here.is_sharp);
            for exponent in [-40, -9, 7, 30] {
                let scale = 2f64.powi(exponent);
                let scaled = points.map(|p| p.map(|x| x * scale));
                let there = rounded(scaled.each_ref());
                assert_eq!(there.is_sharp, here.is_sharp, "{points:?}, {exponent}");
                if here.is_sharp {
                    assert_eq!(there.offset, here.offset.map(|x| x * scale), "{points:?}, {exponent}");
                }
                assert_eq!(there.extent, here.extent * scale);
            }
            if case % 27 < 8 && here.is_sharp {
                let squares =
                    points.map(|p| (0..D).map(|k| p[k] - points[0][k] - here.offset[k]).map(|x| x * x).sum());
                let [least, most] = [f64::min, f64::max].map(|f| squares.into_iter().fold(squares[0], f));
                assert!(most - least <= 1e-9 * most, "{points:?}");
            }
        }
        assert!(n_sharp > 500 && n_blunt > 500, "{n_sharp} {n_blunt}");
    }

    #[test]
    fn sharpness_does_not_depend_on_size() {
        check(rounded2d);
        check(rounded3d);
    }
}
