//! Spheres of cells and half-spaces beyond facets against boxes, exactly; and balls that certainly cover a sphere.
//!
//! With the vector n and the determinant V of a cell (`measures.rs`), the centre is at n / 2V from the first corner, and
//! a box between l and h, as seen from there, is at a distance along an axis of
//!
//! ```text
//! e / 2V,    e = max(2V l − n, n − 2V h, 0)
//! ```
//!
//! so that the closed ball meets the closed box exactly if Σ e² ≤ |n|². That is decided in these stages, of which the first
//! one is for each ball and box, and the others know the offset o of the centre from integers (`measures.rs`), which is computed
//! once for a ball and many boxes.
//!
//! 1. *Rounded*: where the rounded vector o = n / 2V is sharp, it is within R / 2³⁰ of the exact one along each axis, and
//!    |o|² within a factor 1 ± 2⁻²⁸ of R². A distance along an axis is off by that and by its own rounding, which is less
//!    than 4 u of itself and of R. So the square of the distance is certain, up to a few u of itself, within
//!    2 √3 R² / 2³⁰ < R² / 2²⁸ where it is near R²: where it differs from |o|² by more than a factor 1 ± 2⁻²⁶, the answer
//!    is certain.
//! 2. *Corners*: a box that has a corner of the cell meets the ball, whatever is rounded.
//! 3. *Power*: the place q of the box nearest to the centre, seen from the first corner, has the power Σ q (q − 2 o), which is
//!    not positive exactly if they meet. A component of o is off by 2⁻⁵⁰ = 8 u of itself, and q by u of itself or, where it
//!    is that of the centre, as much as that, which matters in second order. So a term is off by less than 12 u |q| (|q| + 2 |o|)
//!    and the sum by three roundings more: less than 32 u Σ |q| (|q| + 2 |o|). Of a large ball and a box near its cell that is a
//!    small part of R².
//! 4. *Places*: where a place of the box is certainly the nearest, as along each axis the box is flat or the centre is beyond a side,
//!    the sign is that of `incircle` or `insphere`.
//! 5. *Big integers* (`big.rs`), for any. Sides that the centre is certainly inside of do not count: where a box is unbounded,
//!    that leaves integers of few bits.
//!
//! A half-space beyond a facet with the outer normal n meets a box if Σ max(n l, n h) > 0. A component of n is a minor,
//! off by at most 4 u of the sum P of the magnitudes of its products, to first order, and the whole by at most 8 u
//! Σ P max(|l|, |h|): 2 u for the differences and products and one for each sum. Where that does not decide, the
//! orientations of the corners do that may be furthest along n, exactly.
//!
//! # Covering balls
//!
//! Let N and W be the exact vector and determinant, n and V the rounded ones, E and F what they are off by at most. Then
//! the exact offset differs from n / 2V along an axis by at most (E / 2 + |n / 2V| F) / (V − F), and the rounded quotient
//! by another u of itself. Where numbers are not sharp, n and V are integers, rounded by 2⁻⁵² each, and a component of the
//! offset is off by at most 2⁻⁵⁰ of itself and the least numbers. The centre that is told is off by its last rounding,
//! too. With d for what the offset is off by, and c for what the centre is, a ball with the radius |o| + |d| + |c| around
//! the centre has the circumball in it, as R is at most |o| + |d|. Sums and roots are rounded, which a factor 1 + 2⁻⁴⁸
//! makes good for.

use std::cmp::Ordering;
use std::fmt::Debug;

use super::StaticFilter;
use super::big::{Integer, LimbRoom, MOST_LIMBS, differences_in_units, square};
use super::filter::{
    CIRCLE_VECTOR, SPHERE_VECTOR, UNDERFLOW, UNIT, semi_static_bounds_2d, semi_static_bounds_3d,
};
use super::measures::{Rounded, exact_circle, exact_offset, exact_sphere, rounded2d, rounded3d};
use super::plane::{incircle, orient2d};
use super::space::{insphere, orient3d};
use super::sphere::{circle, sphere};
use super::vectors::{cross, dot, greatest_along_axes, minus, plus};
use crate::machine::tally;
use crate::simd::Real;

/// What the square of a distance must differ by from that of a rounded radius, relatively, to be certainly less or
/// greater.
const MARGIN: f64 = 1.0 / (1u64 << 26) as f64;

/// What a power is off by, in sums of magnitudes, and a distance of the centre from a side, in those of both.
const POWER: f64 = 32.0 * UNIT;

/// What the side of a half-space is off by, in sums of magnitudes: twice the first order.
const HALF_SPACE: f64 = 16.0 * UNIT;

/// What a component of a normal is off by, in sums of magnitudes: twice the first order.
const NORMAL: f64 = 8.0 * UNIT;

/// Makes good for the rounding of a sum of a few lengths.
const ROUND_UP: f64 = 1.0 + 1.0 / (1u64 << 48) as f64;

/// A filter that nothing passes: the predicates use their sharper bounds.
const NO_FILTER: StaticFilter = StaticFilter {
    orient: f64::INFINITY,
    in_sphere: f64::INFINITY,
    prepared: f64::INFINITY,
    largest_square: f64::INFINITY,
    is_exact: false,
};

/// Cells and facets against boxes. Boxes are in the range of coordinates, and not empty. With weights both sides of a box have
/// one weight, the greatest of what may be in it, and it is the *reach* of a cell that meets it or does not: all places at which
/// the power of a vertex of this weight would be at most that of the corners.
pub trait Reach: Sized {
    /// What is computed once for a cell that rounded numbers do not suffice for.
    type Centre: Copy + Debug + Default;

    /// Whether the closed ball of a positively oriented cell, given by its `D + 1` corners, and a closed box have a
    /// place in common, where rounded numbers tell.
    fn does_ball_surely_meet(cell: &[&Self], low: &Self, high: &Self) -> Option<bool>;

    /// The way from the first corner of a cell to the centre of its ball, as [`does_ball_meet`](Self::does_ball_meet) needs it.
    fn exact_centre(cell: &[&Self]) -> Self::Centre;

    /// Whether the ball of a cell meets a box, exactly.
    fn does_ball_meet(cell: &[&Self], centre: &Self::Centre, low: &Self, high: &Self) -> bool;

    /// Whether a closed box has a place that is strictly beyond a facet, given by its `D` corners in the order that
    /// makes the orientation with a place beyond positive: exactly.
    fn does_half_space_meet(facet: &[&Self], low: &Self, high: &Self) -> bool;

    /// A centre and a radius of a closed ball that certainly has the closed ball of a positively oriented cell in it; with
    /// weights its reach for this greatest weight. The radius is infinite, and the centre a corner, where numbers do not suffice.
    fn covering_ball(cell: &[&Self], greatest: f64) -> (Self, f64);
}

impl Reach for [f64; 2] {
    type Centre = Self;

    #[inline(always)]
    fn does_ball_surely_meet(cell: &[&Self], low: &Self, high: &Self) -> Option<bool> {
        let &[a, b, c] = cell else { unreachable!("a triangle") };
        does_surely_meet(&rounded2d([a, b, c]), a, low, high)
    }

    fn exact_centre(cell: &[&Self]) -> Self {
        let &[a, b, c] = cell else { unreachable!("a triangle") };
        tally::count();
        exact_offset([a, b, c], |p| exact_circle(p))
    }

    #[cold]
    #[inline(never)]
    fn does_ball_meet(cell: &[&Self], centre: &Self, low: &Self, high: &Self) -> bool {
        let &[a, b, c] = cell else { unreachable!("a triangle") };
        does_meet(cell, centre, [low, high], |q| incircle(&NO_FILTER, a, b, c, q))
            .unwrap_or_else(|binding| is_exactly_met_2d([a, b, c], [low, high], binding))
    }

    #[inline(always)]
    fn does_half_space_meet(facet: &[&Self], low: &Self, high: &Self) -> bool {
        let &[a, b] = facet else { unreachable!("an edge") };
        let [x, y] = minus(b, a);
        let normal = Normal { n: [-y, x], magnitudes: [y.abs(), x.abs()] };
        normal.meets(a, [low, high], |q| orient2d(&NO_FILTER, a, b, q) > 0.0)
    }

    #[inline(always)]
    fn covering_ball(cell: &[&Self], _: f64) -> (Self, f64) {
        let &[a, b, c] = cell else { unreachable!("a triangle") };
        let rounded = rounded2d([a, b, c]);
        if !rounded.is_sharp {
            return cover_exact(a, exact_offset([a, b, c], |p| exact_circle(p)));
        }
        let [_, _, volume] = circle(a, b, c);
        let [bound, _] = semi_static_bounds_2d(greatest_along_axes([&minus(b, a), &minus(c, a)]));
        let extent = rounded.extent;
        cover_rounded(a, &rounded, volume, CIRCLE_VECTOR * (extent * extent * extent), bound)
    }
}

impl Reach for [f64; 3] {
    type Centre = Self;

    #[inline(always)]
    fn does_ball_surely_meet(cell: &[&Self], low: &Self, high: &Self) -> Option<bool> {
        let &[a, b, c, d] = cell else { unreachable!("a tetrahedron") };
        does_surely_meet(&rounded3d([a, b, c, d]), a, low, high)
    }

    fn exact_centre(cell: &[&Self]) -> Self {
        let &[a, b, c, d] = cell else { unreachable!("a tetrahedron") };
        tally::count();
        exact_offset([a, b, c, d], |p| exact_sphere(p))
    }

    #[cold]
    #[inline(never)]
    fn does_ball_meet(cell: &[&Self], centre: &Self, low: &Self, high: &Self) -> bool {
        let &[a, b, c, d] = cell else { unreachable!("a tetrahedron") };
        does_meet(cell, centre, [low, high], |q| insphere(&NO_FILTER, a, b, c, d, q))
            .unwrap_or_else(|binding| is_exactly_met_3d([a, b, c, d], [low, high], binding))
    }

    #[inline(always)]
    fn does_half_space_meet(facet: &[&Self], low: &Self, high: &Self) -> bool {
        let &[a, b, c] = facet else { unreachable!("a triangle") };
        let (u, v) = (minus(b, a), minus(c, a));
        let magnitudes = |i: usize, j: usize| (u[i] * v[j]).abs() + (u[j] * v[i]).abs();
        let normal =
            Normal { n: cross(&u, &v), magnitudes: [magnitudes(1, 2), magnitudes(2, 0), magnitudes(0, 1)] };
        normal.meets(a, [low, high], |q| orient3d(&NO_FILTER, a, b, c, q) > 0.0)
    }

    #[inline(always)]
    fn covering_ball(cell: &[&Self], _: f64) -> (Self, f64) {
        let &[a, b, c, d] = cell else { unreachable!("a tetrahedron") };
        let rounded = rounded3d([a, b, c, d]);
        if !rounded.is_sharp {
            return cover_exact(a, exact_offset([a, b, c, d], |p| exact_sphere(p)));
        }
        let [_, _, _, volume] = sphere(a, b, c, d);
        let [bound, _] =
            semi_static_bounds_3d(greatest_along_axes([&minus(b, a), &minus(c, a), &minus(d, a)]));
        let square = rounded.extent * rounded.extent;
        cover_rounded(a, &rounded, volume, SPHERE_VECTOR * (square * square), bound)
    }
}

/// For each axis, whether the low side of a box counts, and whether the high one does.
type Binding<const D: usize> = [[bool; 2]; D];

/// Whether a ball and a box meet, where rounded numbers decide.
#[inline(always)]
fn does_surely_meet<const D: usize>(
    rounded: &Rounded<D>,
    a: &[f64; D],
    low: &[f64; D],
    high: &[f64; D],
) -> Option<bool> {
    let o = rounded.offset;
    let (low, high) = (minus(low, a), minus(high, a));
    let apart: [f64; D] =
        std::array::from_fn(|axis| Real::max(Real::max(low[axis] - o[axis], o[axis] - high[axis]), 0.0));
    let (distance, squared) = (dot(&apart, &apart), dot(&o, &o));
    let is_certain = (distance < squared * (1.0 - MARGIN)) | (distance > squared * (1.0 + MARGIN));
    (rounded.is_sharp & is_certain).then_some(distance < squared)
}

/// Whether a ball and a box meet, where the centre and signs of single places tell; otherwise the sides that may count.
#[inline(always)]
fn does_meet<const D: usize>(
    cell: &[&[f64; D]],
    o: &[f64; D],
    [low, high]: [&[f64; D]; 2],
    side: impl FnOnce(&[f64; D]) -> f64,
) -> Result<bool, Binding<D>> {
    let is_in = |p: &[f64; D]| (0..D).all(|axis| low[axis] <= p[axis] && p[axis] <= high[axis]);
    if cell.iter().any(|p| is_in(p)) {
        return Ok(true);
    }
    let (l, h) = (minus(low, cell[0]), minus(high, cell[0]));
    let (mut power, mut bound) = (0.0, UNDERFLOW);
    for axis in 0..D {
        let (q, twice) = (o[axis].max(l[axis]).min(h[axis]), 2.0 * o[axis]);
        power += q * (q - twice);
        bound += POWER * (q.abs() * (q.abs() + twice.abs())) + UNDERFLOW * q.abs();
    }
    if power.abs() > bound {
        return Ok(power < 0.0);
    }
    let exceeds = |x: f64, y: f64| x - y > POWER * (x.abs() + y.abs()) + UNDERFLOW;
    let is_below = |axis: usize| exceeds(l[axis], o[axis]);
    let is_above = |axis: usize| exceeds(o[axis], h[axis]);
    if (0..D).all(|axis| is_below(axis) || is_above(axis) || low[axis] == high[axis]) {
        let nearest = std::array::from_fn(|axis| if is_above(axis) { high[axis] } else { low[axis] });
        return Ok(side(&nearest) >= 0.0);
    }
    Err(std::array::from_fn(|axis| [!exceeds(o[axis], l[axis]), !exceeds(h[axis], o[axis])]))
}

/// Whether Σ e² ≤ |n|², with the sides that count.
fn is_met<const D: usize, const N: usize>(
    (n, volume): ([Integer<'_, N>; D], Integer<'_, N>),
    [low, high]: [[Integer<'_, N>; D]; 2],
    binding: Binding<D>,
) -> bool {
    let twice = volume + volume;
    let mut left = square(&n);
    for axis in 0..D {
        let sides = [(low, false), (high, true)];
        for ((side, is_high), _) in sides.into_iter().zip(binding[axis]).filter(|&(_, counts)| counts) {
            let at = twice * side[axis];
            let e = if is_high { n[axis] - at } else { at - n[axis] };
            if e.sign() == Ordering::Greater {
                left = left - e * e;
                break;
            }
        }
    }
    left.sign() != Ordering::Less
}

#[cold]
#[inline(never)]
fn is_exactly_met_2d([a, b, c]: [&[f64; 2]; 3], sides: [&[f64; 2]; 2], binding: Binding<2>) -> bool {
    let [low, high] = counting(a, sides, binding);
    let points = [b, c, &low, &high];
    tally::count();
    let room = LimbRoom::<MOST_LIMBS>::of_any_size();
    let (_, [u, v, low, high]) = differences_in_units(&room, a, points, i32::MAX);
    is_met(exact_circle(&[u, v]), [low, high], binding)
}

#[cold]
#[inline(never)]
fn is_exactly_met_3d([a, b, c, d]: [&[f64; 3]; 4], sides: [&[f64; 3]; 2], binding: Binding<3>) -> bool {
    let [low, high] = counting(a, sides, binding);
    let points = [b, c, d, &low, &high];
    tally::count();
    let room = LimbRoom::<MOST_LIMBS>::of_any_size();
    let (_, [u, v, w, low, high]) = differences_in_units(&room, a, points, i32::MAX);
    is_met(exact_sphere(&[u, v, w]), [low, high], binding)
}

/// The corners of a box, with the coordinates of `a` in place of those that do not count.
fn counting<const D: usize>(a: &[f64; D], sides: [&[f64; D]; 2], binding: Binding<D>) -> [[f64; D]; 2] {
    [0, 1].map(|k| std::array::from_fn(|axis| if binding[axis][k] { sides[k][axis] } else { a[axis] }))
}

/// The outer normal of a facet, rounded.
struct Normal<const D: usize> {
    n: [f64; D],
    /// For each component the sum of the magnitudes of its products.
    magnitudes: [f64; D],
}

impl<const D: usize> Normal<D> {
    /// Whether a box has a place beyond the facet of which `a` is the first corner; `is_beyond` tells of one.
    #[inline(always)]
    fn meets(
        &self,
        a: &[f64; D],
        [low, high]: [&[f64; D]; 2],
        is_beyond: impl Fn(&[f64; D]) -> bool,
    ) -> bool {
        let (l, h) = (minus(low, a), minus(high, a));
        let (mut furthest, mut bound, mut reach) = (0.0, 0.0, 1.0);
        for axis in 0..D {
            let side = Real::max(l[axis].abs(), h[axis].abs());
            furthest += Real::max(self.n[axis] * l[axis], self.n[axis] * h[axis]);
            bound += self.magnitudes[axis] * side;
            reach = Real::max(reach, side);
        }
        let bound = HALF_SPACE * bound + UNDERFLOW * reach;
        if furthest.abs() > bound {
            return furthest > 0.0;
        }
        self.has_corner([low, high], is_beyond)
    }

    /// Whether one of the corners that may be furthest along the normal is beyond.
    #[cold]
    #[inline(never)]
    fn has_corner(&self, [low, high]: [&[f64; D]; 2], is_beyond: impl Fn(&[f64; D]) -> bool) -> bool {
        let is_certain = |axis: usize| self.n[axis].abs() > NORMAL * self.magnitudes[axis] + UNDERFLOW;
        (0..1usize << D).any(|bits| {
            let is_high = |axis: usize| bits >> axis & 1 == 1;
            let may_be_furthest = |axis: usize| {
                let is_other = low[axis] != high[axis] || !is_high(axis);
                is_other
                    && (low[axis] == high[axis] || !is_certain(axis) || is_high(axis) == (self.n[axis] > 0.0))
            };
            let corner = std::array::from_fn(|axis| if is_high(axis) { high[axis] } else { low[axis] });
            (0..D).all(may_be_furthest) && is_beyond(&corner)
        })
    }
}

/// The covering ball of a sharp sphere: `vector` and `bound` are what a component of the vector and the determinant
/// are off by.
#[inline(always)]
fn cover_rounded<const D: usize>(
    a: &[f64; D],
    rounded: &Rounded<D>,
    volume: f64,
    vector: f64,
    bound: f64,
) -> ([f64; D], f64) {
    let amplified = Real::max(rounded.extent, 1.0);
    let vector = vector + UNDERFLOW * (amplified * amplified);
    let off = bound + 2.0 * UNIT * volume;
    let scale = 1.0 / (volume - off);
    cover(
        a,
        rounded.offset,
        rounded.offset.map(|o| (0.5 * vector + o.abs() * off) * scale + 2.0 * UNIT * o.abs()),
    )
}

/// The covering ball of a sphere of which the offset has been rounded from integers.
#[cold]
#[inline(never)]
fn cover_exact<const D: usize>(a: &[f64; D], offset: [f64; D]) -> ([f64; D], f64) {
    cover(a, offset, offset.map(|o| 8.0 * UNIT * o.abs() + 2.0 * f64::from_bits(1)))
}

/// The covering ball of a sphere of which the offset is off by so much along each axis.
#[inline(always)]
fn cover<const D: usize>(a: &[f64; D], offset: [f64; D], off: [f64; D]) -> ([f64; D], f64) {
    let centre = plus(a, &offset);
    // A sum is rounded by half a last bit, and exact where it is subnormal.
    let moved: [f64; D] = std::array::from_fn(|axis| off[axis] + UNIT * centre[axis].abs());
    let radius = (length(&offset) + length(&off) + length(&moved)) * ROUND_UP;
    // Above what is subnormal, and infinite where it has overflowed or an offset has.
    let radius = (radius + 4.0 * f64::from_bits(1)).next_up();
    if radius < f64::INFINITY { (centre, radius) } else { (*a, f64::INFINITY) }
}

/// The length of a vector, with a relative error of a few last bits and one of a least number.
#[inline(always)]
fn length<const D: usize>(v: &[f64; D]) -> f64 {
    let squared = dot(v, v);
    if squared > 1e-280 && squared < 1e300 { squared.sqrt() } else { length_of_scaled(v) }
}

/// The length of a vector whose square is not in the range of numbers.
#[cold]
#[inline(never)]
fn length_of_scaled<const D: usize>(v: &[f64; D]) -> f64 {
    let most = v.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    if most == 0.0 || most == f64::INFINITY {
        return most;
    }
    let scaled = v.map(|x| x / most);
    most * dot(&scaled, &scaled).sqrt()
}

mod weighted;

#[cfg(test)]
mod tests;
