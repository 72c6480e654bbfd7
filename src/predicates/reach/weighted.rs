//! Reaches of cells of points with weights against boxes.
//!
//! A place x of the box is in reach, for a vertex of weight W there, if its side of the power sphere is not negative. The side is a
//! concave function of x, so it is the place next to the power centre that counts. That is decided in these stages:
//!
//! 1. *Rounded*: the filter for boxes ([`side_of_box_2d`], [`side_of_box_3d`]), by which the sign at this place is certain.
//! 2. *Corners*: a box that has a corner of the cell meets the reach if W is no less than the weight of the corner.
//! 3. *Big integers*: with the vector n and the determinant V of the lifted cell, w the weight of its first corner, and e
//!    as without weights, they meet exactly if Σ e² ≤ |n|² + 4 V² (W − w).
//!
//! # Covering balls
//!
//! A reach is a ball around the power centre with the square of the radius |o|² + W − w, or nothing. With the length m of
//! [`Measures::centre`], |o|² is off by less than 4·10⁻⁹ m² and a coordinate of the centre by 10⁻⁹ m and its rounding.

use std::cmp::Ordering;

use super::{ROUND_UP, Reach};
use crate::machine::tally;
use crate::predicates::big::{
    Integer, LimbRoom, POWER_BOX_LIMBS, POWER_CELL_LIMBS, POWER_REACH_LIMBS, in_square_of_unit, lifted,
    square,
};
use crate::predicates::measures::{Measures, lifted_circle, lifted_sphere};
use crate::predicates::points::{side_of_box_2d, side_of_box_3d};
use crate::predicates::weighted::WeightedPoint;

/// What the square of a distance from a rounded centre is off by, in squares of m, and more.
const SQUARE: f64 = 5e-9;

/// What a centre is off by, in lengths m, and more, in space.
const CENTRE: f64 = 2e-9;

/// What a sum of a few squares and weights is off by, in sums of magnitudes, and more.
const ROUNDED: f64 = 1e-15;

/// What a sum of squares that are below the range of numbers is off by, and more.
const LEAST_SQUARE: f64 = 1e-300;

impl Reach for WeightedPoint<2> {
    type Centre = ();

    #[inline(always)]
    fn does_ball_surely_meet(cell: &[&Self], low: &Self, high: &Self) -> Option<bool> {
        let &[a, b, c] = cell else { unreachable!("a triangle") };
        surely(side_of_box_2d([a, b, c], [low, high]))
    }

    fn exact_centre(_: &[&Self]) {}

    #[cold]
    #[inline(never)]
    fn does_ball_meet(cell: &[&Self], _: &(), low: &Self, high: &Self) -> bool {
        let &[a, b, c] = cell else { unreachable!("a triangle") };
        has_corner(cell, low, high)
            || is_exactly_met([a, b, c], [b, c, low, high], high.weight, |[u, v, ..], [of_u, of_v, ..]| {
                lifted_circle(&[u, v], [of_u, of_v])
            })
    }

    #[inline(always)]
    fn does_half_space_meet(facet: &[&Self], low: &Self, high: &Self) -> bool {
        let &[a, b] = facet else { unreachable!("an edge") };
        <[f64; 2]>::does_half_space_meet(&[&a.place, &b.place], &low.place, &high.place)
    }

    fn covering_ball(cell: &[&Self], greatest: f64) -> (Self, f64) {
        cover(cell, greatest)
    }
}

impl Reach for WeightedPoint<3> {
    type Centre = ();

    #[inline(always)]
    fn does_ball_surely_meet(cell: &[&Self], low: &Self, high: &Self) -> Option<bool> {
        let &[a, b, c, d] = cell else { unreachable!("a tetrahedron") };
        surely(side_of_box_3d([a, b, c, d], [low, high]))
    }

    fn exact_centre(_: &[&Self]) {}

    #[cold]
    #[inline(never)]
    fn does_ball_meet(cell: &[&Self], _: &(), low: &Self, high: &Self) -> bool {
        let &[a, b, c, d] = cell else { unreachable!("a tetrahedron") };
        has_corner(cell, low, high)
            || is_exactly_met(
                [a, b, c, d],
                [b, c, d, low, high],
                high.weight,
                |[u, v, w, ..], [of_u, of_v, of_w, ..]| lifted_sphere(&[u, v, w], [of_u, of_v, of_w]),
            )
    }

    #[inline(always)]
    fn does_half_space_meet(facet: &[&Self], low: &Self, high: &Self) -> bool {
        let &[a, b, c] = facet else { unreachable!("a triangle") };
        <[f64; 3]>::does_half_space_meet(&[&a.place, &b.place, &c.place], &low.place, &high.place)
    }

    fn covering_ball(cell: &[&Self], greatest: f64) -> (Self, f64) {
        cover(cell, greatest)
    }
}

/// Whether a side is certain, and which.
#[inline(always)]
fn surely((side, bound): (f64, f64)) -> Option<bool> {
    (side.abs() > bound).then_some(side > 0.0)
}

/// Whether a box has a corner of a cell, at a place that is in reach for that alone.
fn has_corner<const D: usize>(
    cell: &[&WeightedPoint<D>],
    low: &WeightedPoint<D>,
    high: &WeightedPoint<D>,
) -> bool {
    let is_in = |p: &[f64; D]| (0..D).all(|axis| low.place[axis] <= p[axis] && p[axis] <= high.place[axis]);
    cell.iter().any(|p| p.weight <= high.weight && is_in(&p.place))
}

/// An integer of the lifted cell, one that is kept of it, and one of what is made of that with a box.
type OfLift<'r> = Integer<'r, POWER_REACH_LIMBS>;
type OfCell<'r> = Integer<'r, POWER_CELL_LIMBS>;
type OfBox<'r> = Integer<'r, POWER_BOX_LIMBS>;

/// The exponent of a unit, the vector and the determinant of a lifted cell, and the ways from its first corner to the sides of a
/// box.
struct LiftedCell<'r, const D: usize> {
    unit: i32,
    n: [OfCell<'r>; D],
    volume: OfCell<'r>,
    sides: [[OfCell<'r>; D]; 2],
}

/// Whether Σ e² ≤ |n|² + 4 V² (`greatest` − w). `points` are the corners but the first one, and the sides of the box.
#[inline(never)]
fn is_exactly_met<const D: usize, const M: usize, const N: usize>(
    cell: [&WeightedPoint<D>; N],
    points: [&WeightedPoint<D>; M],
    greatest: f64,
    sphere: impl for<'r> FnOnce([[OfLift<'r>; D]; M], [OfLift<'r>; M]) -> ([OfLift<'r>; D], OfLift<'r>),
) -> bool {
    tally::count();
    let room = LimbRoom::of_any_size();
    let lifted = lift(&room, cell, points, greatest, sphere);
    is_met(&lifted, [greatest, cell[0].weight])
}

/// What is kept of a lifted cell in this room: what is made on the way is elsewhere, for the time of this call.
#[inline(never)]
fn lift<'s, const D: usize, const M: usize, const N: usize>(
    room: &'s LimbRoom<POWER_CELL_LIMBS>,
    cell: [&WeightedPoint<D>; N],
    points: [&WeightedPoint<D>; M],
    greatest: f64,
    sphere: impl for<'r> FnOnce([[OfLift<'r>; D]; M], [OfLift<'r>; M]) -> ([OfLift<'r>; D], OfLift<'r>),
) -> LiftedCell<'s, D> {
    let within = LimbRoom::of_any_size();
    // The weights of the points, that of the first corner after them, and another one that the unit has to serve.
    let mut weights = [greatest; 7];
    for (weight, p) in weights.iter_mut().zip(points) {
        *weight = p.weight;
    }
    weights[M] = cell[0].weight;
    let (unit, differences, lifts) =
        lifted(&within, &cell[0].place, points.map(|p| &p.place), &weights[..M + 2]);
    let sides = [differences[M - 2], differences[M - 1]].map(|side| side.map(|x| x.copied_to(room)));
    let (n, volume) = sphere(differences, lifts);
    LiftedCell { unit, n: n.map(|x| x.copied_to(room)), volume: volume.copied_to(room), sides }
}

#[inline(never)]
fn is_met<const D: usize>(cell: &LiftedCell<'_, D>, [greatest, own]: [f64; 2]) -> bool {
    let room = LimbRoom::of_any_size();
    let n: [OfBox<'_>; D] = cell.n.map(|x| x.within(&room));
    let [low, high] = cell.sides.map(|side| side.map(|x| x.within(&room)));
    let twice = cell.volume.within(&room) + cell.volume.within(&room);
    let [greatest, own] = [greatest, own].map(|weight| in_square_of_unit(&room, weight, cell.unit));
    let mut left = square(&n) + twice * twice * (greatest - own);
    for axis in 0..D {
        let below = twice * low[axis] - n[axis];
        let e = if below.sign() == Ordering::Greater { below } else { n[axis] - twice * high[axis] };
        if e.sign() == Ordering::Greater {
            left = left - e * e;
        }
    }
    left.sign() != Ordering::Less
}

/// A ball that has the reach of a cell for a weight in it.
fn cover<const D: usize>(cell: &[&WeightedPoint<D>], greatest: f64) -> (WeightedPoint<D>, f64)
where
    WeightedPoint<D>: Measures,
{
    let (centre, bound) = Measures::centre(cell);
    let (_, square) = Measures::circumsphere(cell);
    let own = cell[0].weight.abs() + greatest.abs();
    let most = square + greatest + SQUARE * bound + ROUNDED * (bound + own) + LEAST_SQUARE;
    let off = (0..D).fold(CENTRE * (bound + LEAST_SQUARE).sqrt(), |off, axis| {
        off + f64::EPSILON * centre.place[axis].abs()
    });
    let radius = ((most.max(0.0).sqrt() + off) * ROUND_UP + 4.0 * f64::from_bits(1)).next_up();
    if radius < f64::INFINITY { (centre, radius) } else { (*cell[0], f64::INFINITY) }
}
