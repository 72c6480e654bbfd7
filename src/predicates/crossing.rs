//! Where two segments of the plane cross: the place with each coordinate rounded correctly.
//!
//! The lines through a, b and c, d meet at a + (b − a) N / D with N = (c − a) × (d − c) and D = (b − a) × (d − c). So a
//! coordinate is a quotient of integers in units of the smallest last bit among the coordinates: (a D + (b − a) N) / D,
//! of degrees 3 and 2. Both are made without rounding (`big.rs`). Their rounded quotient is off by a few last bits; from
//! there the number is looked for that is nearest, by exact comparison with the places half way between numbers, ties to
//! even.
//!
//! What follows from that:
//!
//! - The place depends on the two segments alone: neither on their order nor on their directions.
//! - Rounding is monotone, so it is in the boxes of both segments, and places on one segment are, coordinate by
//!   coordinate, in the order of the exact ones. A line along an axis keeps its coordinate.
//! - It is off by at most half a last place along each axis.
//!
//! A segment *passes* a place of numbers if a place on it is rounded there and nowhere else: if it goes through the inside of
//! the rectangle whose sides are half way to the neighbours of the coordinates. For two segments that cross, an end of one that
//! the other passes will do for the crossing, with no greater error.
//!
//! Length of integers: a coordinate has 20 limbs, a difference one more, N and D up to 41, the numerator up to 62.

use std::cmp::Ordering;

use super::big::{Integer, LimbRoom, decode, differences_in_units, minor};
use super::measures::scaled;

/// Where two segments cross, correctly rounded, without negative zeros. They are not parallel.
pub fn crossing([a, b, c, d]: [&[f64; 2]; 4]) -> [f64; 2] {
    [0, 1].map(|axis| {
        let room = LimbRoom::new();
        let (unit, [a, b, c, d]) = differences_in_units(&room, &[0.0; 2], [a, b, c, d], i32::MAX);
        let [along, across, between] = [(b, a), (d, c), (c, a)].map(|(p, q)| [p[0] - q[0], p[1] - q[1]]);
        let below = minor(&along, &across);
        let above = a[axis] * below + along[axis] * minor(&between, &across);
        // A zero has no sign.
        Quotient { room: &room, above, below, unit }.rounded() + 0.0
    })
}

/// Whether a place on the segment from `a` to `b`, which are apart, is rounded to `p` and nowhere else.
pub fn passes_near([a, b]: [&[f64; 2]; 2], p: &[f64; 2]) -> bool {
    // Between numbers on both sides of the middle to the next number there is that one.
    if (0..2).any(|k| p[k] < a[k].min(b[k]) || p[k] > a[k].max(b[k])) {
        return false;
    }
    let sides = p.map(|x| {
        let (mantissa, exponent) = middle_above(-x);
        [(-mantissa, exponent), middle_above(x)]
    });
    let room = LimbRoom::new();
    let least = sides.iter().flatten().map(|&(_, exponent)| exponent).min();
    let (unit, [a, b]) = differences_in_units(&room, &[0.0; 2], [a, b], least.unwrap_or(0));
    let [x, y] = sides.map(|sides| {
        sides.map(|(mantissa, exponent)| Integer::shifted(&room, mantissa, (exponent - unit) as u32))
    });
    let along = [b[0] - a[0], b[1] - a[1]];
    // The corners that are farthest to the left and to the right.
    let [is_right, is_up] = along.map(|d| d.sign() != Ordering::Less);
    let turn = |x: Integer<'_>, y: Integer<'_>| (along[0] * (y - a[1]) - along[1] * (x - a[0])).sign();
    let [left, right] = [
        turn(x[usize::from(!is_up)], y[usize::from(is_right)]),
        turn(x[usize::from(is_up)], y[usize::from(!is_right)]),
    ];
    left == Ordering::Greater && right == Ordering::Less
}

/// The place half way between a number and the next greater one: mantissa and exponent.
fn middle_above(x: f64) -> (i64, i32) {
    // The one of the two that is nearer to zero has the exponent of their last places.
    let inner = if x >= 0.0 { x } else { -x.next_up() };
    let (mantissa, exponent) = decode(inner);
    (if x >= 0.0 { 2 * mantissa.abs() + 1 } else { -(2 * mantissa.abs() + 1) }, exponent - 1)
}

/// `above` / `below` 2^`unit`.
struct Quotient<'r> {
    room: &'r LimbRoom,
    above: Integer<'r>,
    below: Integer<'r>,
    unit: i32,
}

impl Quotient<'_> {
    /// The nearest number; of two that are as near, the even one.
    fn rounded(&self) -> f64 {
        let ((numerator, more), (divisor, less)) = (self.above.rounded(), self.below.rounded());
        let mut x = scaled(numerator / divisor, more - less + self.unit);
        while self.compare_with_middle_above(x) == Ordering::Greater {
            x = x.next_up();
        }
        while self.compare_with_middle_above(x.next_down()) == Ordering::Less {
            x = x.next_down();
        }
        if x.to_bits() & 1 == 1 {
            if self.compare_with_middle_above(x) == Ordering::Equal {
                return x.next_up();
            }
            if self.compare_with_middle_above(x.next_down()) == Ordering::Equal {
                return x.next_down();
            }
        }
        x
    }

    /// How this compares with the place half way between a number and the next greater one.
    fn compare_with_middle_above(&self, x: f64) -> Ordering {
        let (middle, exponent) = middle_above(x);
        let shift = exponent - self.unit;
        let power = |exponent: i32| Integer::shifted(self.room, 1, exponent.max(0) as u32);
        let middle = Integer::shifted(self.room, middle, shift.max(0) as u32);
        let (left, right) = (self.above * power(-shift), middle * self.below);
        let difference = left - right;
        if self.below.sign() == Ordering::Less { difference.sign().reverse() } else { difference.sign() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predicates::{MAX_MAGNITUDE, StaticFilter, dyadic::Dyadic, orient2d};
    use crate::random::Rng;

    /// The exact place is no farther from the number than from the places half way to its neighbours, by the products.
    fn check([a, b, c, d]: [[f64; 2]; 4], p: [f64; 2]) {
        let number = Dyadic::from;
        let difference = |p: [f64; 2], q: [f64; 2]| [0, 1].map(|k| number(p[k]) - number(q[k]));
        let cross =
            |u: &[Dyadic; 2], v: &[Dyadic; 2]| u[0].clone() * v[1].clone() - u[1].clone() * v[0].clone();
        let (along, across, between) = (difference(b, a), difference(d, c), difference(c, a));
        let below = cross(&along, &across);
        let share = cross(&between, &across);
        let zero = number(0.0);
        for axis in 0..2 {
            let above = number(a[axis]) * below.clone() + along[axis].clone() * share.clone();
            // Twice the quotient is between the sums of the number and its neighbours, or at one of them if it is even.
            for (neighbour, is_above) in [(p[axis].next_up(), true), (p[axis].next_down(), false)] {
                let sum = number(p[axis]) + number(neighbour);
                let mut rest = above.clone() + above.clone() - sum * below.clone();
                if below < zero {
                    rest = zero.clone() - rest;
                }
                let is_even = p[axis].to_bits() & 1 == 0;
                let is_nearest = if is_above { rest < zero } else { rest > zero };
                assert!(is_nearest || is_even && rest == zero, "{a:?} {b:?} {c:?} {d:?}: {p:?}");
            }
            assert!(p[axis] != 0.0 || p[axis].is_sign_positive());
        }
    }

    fn is_crossed([a, b, c, d]: [[f64; 2]; 4]) -> bool {
        let filter = StaticFilter::plane([-MAX_MAGNITUDE; 2], [MAX_MAGNITUDE; 2]);
        let turn = |p, q, r| orient2d(&filter, p, q, r).total_cmp(&0.0) as i32;
        let are_apart = |p, q, r, s| turn(p, q, r) * turn(p, q, s) < 0;
        are_apart(&a, &b, &c, &d) && are_apart(&c, &d, &a, &b)
    }

    #[test]
    fn crossings_are_rounded_correctly() {
        let rng = &mut Rng::new(1);
        let mut n_crossed = 0;
        for round in 0..60_000 {
            let mut scale = [1.0, 1e-3, 1e40, 1e-300, f64::from_bits(1), MAX_MAGNITUDE][round % 6];
            let mut number = || {
                let x = 2.0 * rng.unit() - 1.0;
                match rng.below(6) {
                    0 => (x * 8.0).round() * scale,
                    1 => (x * 1000.0).round() * scale,
                    // One far smaller, and one that is a last bit away from another.
                    2 => x * scale * 1e-20,
                    3 => ((x * 4.0).round() * 0.25 * scale).next_up(),
                    _ => x * scale,
                }
            };
            let mut points = [[0.0; 2]; 4];
            points.iter_mut().flatten().for_each(|x| *x = number());
            scale = points.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
            if scale > MAX_MAGNITUDE || !is_crossed(points) {
                continue;
            }
            n_crossed += 1;
            let [a, b, c, d] = points;
            let p = crossing([&a, &b, &c, &d]);
            check(points, p);
            for [a, b, c, d] in [[b, a, c, d], [a, b, d, c], [c, d, a, b], [d, c, b, a]] {
                assert_eq!(crossing([&a, &b, &c, &d]), p);
            }
            for axis in 0..2 {
                let least = a[axis].min(b[axis]).max(c[axis].min(d[axis]));
                let most = a[axis].max(b[axis]).min(c[axis].max(d[axis]));
                assert!((least..=most).contains(&p[axis]));
            }
        }
        assert!(n_crossed > 5000, "{n_crossed}");
    }

    /// By clipping (Liang and Barsky) in exact fractions.
    #[test]
    fn segments_pass_what_places_on_them_are_rounded_to() {
        let rng = &mut Rng::new(2);
        let mut counts = [0; 2];
        for round in 0..40_000 {
            // A few numbers around one, a power of two, with places of two lengths, or around zero.
            let number = |rng: &mut Rng| match round % 3 {
                0 => f64::from_bits(1.0f64.to_bits() + 4 - rng.below(9) as u64),
                1 => f64::from_bits(rng.below(5) as u64) * if rng.one_in(2) { 1.0 } else { -1.0 } + 0.0,
                _ => f64::from_bits(3.7f64.to_bits() + rng.below(7) as u64),
            };
            let [a, b, p] = [0; 3].map(|_| [number(rng), number(rng)]);
            if a == b {
                continue;
            }
            let least = if round % 3 == 1 { 1074 } else { 54 };
            let whole = |x: f64| {
                let (mantissa, exponent) = decode(x);
                i128::from(mantissa) << (exponent + least)
            };
            let found = passes_near([&a, &b], &p);
            let low = p.map(|x| whole(x.next_down()));
            let high = p.map(|x| whole(x.next_up()));
            let [a, b, p] = [a, b, p].map(|p| p.map(whole));
            // Doubled, so that the sides are whole.
            let box_of = [0, 1].map(|k| [low[k] + p[k], p[k] + high[k]]);
            // Which part of the segment is inside: fractions of it.
            let (mut from, mut to) = ((0i128, 1i128), (1i128, 1i128));
            let mut is_in = true;
            for k in 0..2 {
                let d = 2 * (b[k] - a[k]);
                let [below, above] = [box_of[k][0] - 2 * a[k], box_of[k][1] - 2 * a[k]];
                if d == 0 {
                    is_in &= below < 0 && above > 0;
                    continue;
                }
                let (enter, leave) =
                    if d > 0 { ((below, d), (above, d)) } else { ((-above, -d), (-below, -d)) };
                if enter.0 * from.1 > from.0 * enter.1 {
                    from = enter;
                }
                if leave.0 * to.1 < to.0 * leave.1 {
                    to = leave;
                }
            }
            let is_passed = is_in && from.0 * to.1 < to.0 * from.1;
            assert_eq!(found, is_passed, "{a:?} {b:?} {p:?}");
            counts[usize::from(is_passed)] += 1;
        }
        assert!(counts[0] > 1000 && counts[1] > 1000, "{counts:?}");
    }

    #[test]
    fn crossings_half_way_are_even() {
        let one = 1.0f64;
        // Between one and the number above it, and between this and the next.
        for (low, high, even) in
            [(one, one.next_up(), one), (one.next_up(), one.next_up().next_up(), one.next_up().next_up())]
        {
            let [a, b, c, d] = [[low, -1.0], [high, 1.0], [0.0, 0.0], [2.0, 0.0]];
            assert_eq!(crossing([&a, &b, &c, &d]), [even, 0.0]);
        }
    }

    /// The longest integers fit their room.
    #[test]
    fn the_longest_crossings_have_room() {
        let (most, least) = (MAX_MAGNITUDE, f64::from_bits(1));
        let points =
            [[-most, -most], [most, most.next_down()], [-most, most.next_down()], [most, least - most]];
        let [a, b, c, d] = points;
        check(points, crossing([&a, &b, &c, &d]));
    }
}
