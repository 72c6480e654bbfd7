//! Against exact numbers: the centre by Cramer's rule from coordinates, not from differences, and no quotients.

use super::super::dyadic::Dyadic;
use super::*;
use crate::predicates::weighted::WeightedPoint;
use crate::predicates::{MAX_MAGNITUDE, MAX_WEIGHT, Measures};
use crate::random::Rng;

fn exact(x: f64) -> Dyadic {
    Dyadic::from(x)
}

fn zero() -> Dyadic {
    exact(0.0)
}

fn det(rows: &[Vec<Dyadic>]) -> Dyadic {
    if rows.len() == 1 {
        return rows[0][0].clone();
    }
    let mut sum = zero();
    for column in 0..rows.len() {
        let rest: Vec<Vec<Dyadic>> = rows[1..]
            .iter()
            .map(|row| (0..rows.len()).filter(|&k| k != column).map(|k| row[k].clone()).collect())
            .collect();
        let term = rows[0][column].clone() * det(&rest);
        sum = if column % 2 == 0 { sum + term } else { sum - term };
    }
    sum
}

/// The centre of a sphere and the square of its radius, as quotients: with the divisor and with its square.
struct Exact {
    centre: Vec<Dyadic>,
    divisor: Dyadic,
    squared_radius: Dyadic,
}

impl Exact {
    fn new<const D: usize>(cell: &[[f64; D]]) -> Self {
        let cell: Vec<_> = cell.iter().map(|&place| WeightedPoint { place, weight: 0.0 }).collect();
        Self::with_weights(&cell, 0.0)
    }

    /// Of points with weights; the square of the radius is that of the reach for the greatest weight, and may be negative.
    fn with_weights<const D: usize>(cell: &[WeightedPoint<D>], greatest: f64) -> Self {
        // 2 (p − a) · c = |p|² − |a|² − (w_p − w_a).
        let lift = |p: &WeightedPoint<D>| {
            p.place.iter().fold(zero() - exact(p.weight), |sum, &x| sum + exact(x) * exact(x))
        };
        let rows: Vec<Vec<Dyadic>> = cell[1..]
            .iter()
            .map(|p| (0..D).map(|k| exact(2.0) * (exact(p.place[k]) - exact(cell[0].place[k]))).collect())
            .collect();
        let right: Vec<Dyadic> = cell[1..].iter().map(|p| lift(p) - lift(&cell[0])).collect();
        let divisor = det(&rows);
        let centre: Vec<Dyadic> = (0..D)
            .map(|k| {
                let mut replaced = rows.clone();
                replaced.iter_mut().zip(&right).for_each(|(row, x)| row[k] = x.clone());
                det(&replaced)
            })
            .collect();
        let mut here = Exact { centre, divisor, squared_radius: zero() };
        let apart = exact(greatest) - exact(cell[0].weight);
        here.squared_radius =
            here.squared_distance(&cell[0].place) + apart * here.divisor.clone() * here.divisor.clone();
        here
    }

    /// The square of the distance of a place from the centre, times that of the divisor.
    fn squared_distance<const D: usize>(&self, p: &[f64; D]) -> Dyadic {
        (0..D).fold(zero(), |sum, k| {
            let apart = exact(p[k]) * self.divisor.clone() - self.centre[k].clone();
            sum + apart.clone() * apart
        })
    }

    fn meets<const D: usize>(&self, low: &[f64; D], high: &[f64; D]) -> bool {
        let mut left = self.squared_radius.clone();
        for k in 0..D {
            let is_positive = self.divisor > zero();
            let [l, h] = [low[k], high[k]].map(|x| {
                let apart = exact(x) * self.divisor.clone() - self.centre[k].clone();
                if is_positive { apart } else { zero() - apart }
            });
            if l > zero() {
                left = left - l.clone() * l;
            } else if h < zero() {
                left = left - h.clone() * h;
            }
        }
        left >= zero()
    }

    /// Whether a ball has this one in it: r ≥ R and r² + R² − d² ≥ 2 r R, all times the square of the divisor.
    fn is_in<const D: usize>(&self, centre: &[f64; D], radius: f64) -> bool {
        let squared = exact(radius) * exact(radius) * self.divisor.clone() * self.divisor.clone();
        let sum = squared.clone() + self.squared_radius.clone() - self.squared_distance(centre);
        squared >= self.squared_radius
            && sum >= zero()
            && sum.clone() * sum >= exact(4.0) * squared * self.squared_radius.clone()
    }
}

/// A positively oriented cell of one of many kinds, `None` if the one that has been drawn has no volume.
fn draw<const D: usize>(kind: usize, rng: &mut Rng) -> Option<Vec<[f64; D]>>
where
    [f64; D]: Measures,
{
    let whole = |rng: &mut Rng, n: usize| rng.below(2 * n + 1) as f64 - n as f64;
    let scale = match kind % 5 {
        0 | 1 => 1.0,
        2 => 2f64.powi(rng.below(300) as i32 - 150),
        // The ends of the range.
        3 => 2f64.powi(-1074),
        _ => MAX_MAGNITUDE / 64.0,
    };
    // Digits that integers of 128 bits have room for, or not.
    let step = if kind.is_multiple_of(2) { 1.0 } else { 0.1 };
    // How flat it is.
    let flatness =
        if kind % 7 == 3 && scale != 2f64.powi(-1074) { 2f64.powi(-(rng.below(60) as i32)) } else { 1.0 };
    let mut cell: Vec<[f64; D]> = (0..=D)
        .map(|_| {
            std::array::from_fn(|axis| {
                let x = match kind % 3 {
                    0 => whole(rng, 4),
                    1 => whole(rng, 30),
                    // Digits all the way, which at the lower end of the range there are not.
                    _ => (rng.unit() - 0.5) * 64.0,
                };
                let x = if axis == D - 1 { x * flatness } else { x };
                x * step * scale
            })
        })
        .collect();
    let rows: Vec<Vec<Dyadic>> =
        cell[1..].iter().map(|p| (0..D).map(|k| exact(p[k]) - exact(cell[0][k])).collect()).collect();
    let orientation = det(&rows);
    if orientation < zero() {
        cell.swap(0, 1);
    }
    (orientation != zero()).then_some(cell)
}

/// Numbers next to one, and that itself.
fn nearby(x: f64, rng: &mut Rng) -> f64 {
    let x = match rng.below(6) {
        0 => x.next_up(),
        1 => x.next_down(),
        2 => x.next_up().next_up(),
        _ => x,
    };
    x.clamp(-MAX_MAGNITUDE, MAX_MAGNITUDE)
}

/// A box that touches a ball, or nearly so, or is anywhere; the sides that do not matter are anywhere, or at the ends of
/// the range.
fn draw_box<const D: usize>(cell: &[[f64; D]], rng: &mut Rng) -> [[f64; D]; 2]
where
    [f64; D]: Measures,
{
    let corners: Vec<&[f64; D]> = cell.iter().collect();
    let (centre, squared) = Measures::circumsphere(&corners);
    let radius = squared.sqrt().min(MAX_MAGNITUDE);
    let (mut low, mut high) = ([0.0; D], [0.0; D]);
    for axis in 0..D {
        let c = centre[axis].clamp(-MAX_MAGNITUDE, MAX_MAGNITUDE);
        let any = cell[rng.below(D + 1)][axis];
        let at = |rng: &mut Rng| match rng.below(7) {
            0 => nearby(c + radius, rng),
            1 => nearby(c - radius, rng),
            2 => nearby(any, rng),
            3 => nearby(c, rng),
            4 => nearby(c + radius * (rng.unit() * 3.0 - 1.5), rng),
            5 => MAX_MAGNITUDE,
            _ => -MAX_MAGNITUDE,
        };
        let (x, y) = (at(rng), at(rng));
        (low[axis], high[axis]) = if rng.below(4) == 0 { (x, x) } else { (x.min(y), x.max(y)) };
    }
    // Beside the ball along one axis alone: a face of the box touches it.
    if rng.below(3) == 0 {
        let axis = rng.below(D);
        let side = nearby(centre[axis].clamp(-MAX_MAGNITUDE, MAX_MAGNITUDE) + radius, rng);
        (low, high) = ([-MAX_MAGNITUDE; D], [MAX_MAGNITUDE; D]);
        low[axis] = side;
    }
    [low, high]
}

/// Balls against boxes: as exact numbers have it, where a side is at the ball to the last bit, too.
fn check_balls<const D: usize>(seed: u64)
where
    [f64; D]: Reach + Measures,
{
    let rng = &mut Rng::new(seed);
    let (mut n_met, mut n_apart, mut n_touching, mut n_sure) = (0, 0, 0, 0);
    for round in 0..6_000 {
        let Some(cell) = draw::<D>(round, rng) else { continue };
        let corners: Vec<&[f64; D]> = cell.iter().collect();
        let sphere = Exact::new(&cell);
        for _ in 0..4 {
            let [low, high] = draw_box(&cell, rng);
            let expected = sphere.meets(&low, &high);
            let centre = Reach::exact_centre(&corners);
            let exactly = Reach::does_ball_meet(&corners, &centre, &low, &high);
            let surely = Reach::does_ball_surely_meet(&corners, &low, &high);
            assert_eq!(exactly, expected, "{cell:?} {low:?} {high:?}");
            assert!(surely.is_none_or(|surely| surely == expected), "{cell:?} {low:?} {high:?}");
            n_sure += usize::from(surely.is_some());
            n_met += usize::from(expected);
            n_apart += usize::from(!expected);
            // Whether it touches in a place: with sides moved by a bit it does not any more.
            if expected
                && (0..D).any(|k| {
                    low[k] < MAX_MAGNITUDE && {
                        let mut moved = low;
                        moved[k] = low[k].next_up();
                        moved[k] <= high[k] && !sphere.meets(&moved, &high)
                    }
                })
            {
                n_touching += 1;
            }
        }
    }
    println!("{n_met} met, {n_apart} not, {n_touching} by a bit; {n_sure} are sure");
    assert!(n_met > 3_000 && n_apart > 3_000 && n_touching > 300 && n_sure > 3_000);
}

#[test]
fn balls_meet_boxes_as_exact_numbers_have_it() {
    check_balls::<2>(1);
    check_balls::<3>(2);
}

/// The half-space beyond the first facet of a cell, against the orientations of all corners in exact numbers.
fn check_half_spaces<const D: usize>(seed: u64)
where
    [f64; D]: Reach + Measures,
{
    let rng = &mut Rng::new(seed);
    let (mut n_met, mut n_apart) = (0, 0);
    for round in 0..6_000 {
        let Some(mut cell) = draw::<D>(round, rng) else { continue };
        // Without the last corner, so that the orientation with it is negative.
        cell.swap(0, 1);
        let facet: Vec<&[f64; D]> = cell[..D].iter().collect();
        for _ in 0..4 {
            let mut low = cell[rng.below(D + 1)];
            let mut high = low;
            for axis in 0..D {
                match rng.below(5) {
                    0 => high[axis] = MAX_MAGNITUDE,
                    1 => low[axis] = -MAX_MAGNITUDE,
                    2 => {
                        let other = nearby(cell[rng.below(D + 1)][axis], rng);
                        (low[axis], high[axis]) = (low[axis].min(other), high[axis].max(other));
                    }
                    3 => (low[axis], high[axis]) = (nearby(low[axis], rng), f64::INFINITY),
                    _ => {}
                }
                high[axis] = high[axis].min(MAX_MAGNITUDE).max(low[axis]);
            }
            let expected = (0..1 << D).any(|bits| {
                let corner: [f64; D] =
                    std::array::from_fn(|k| if bits >> k & 1 == 1 { high[k] } else { low[k] });
                let rows: Vec<Vec<Dyadic>> = cell[1..D]
                    .iter()
                    .chain([&corner])
                    .map(|p| (0..D).map(|k| exact(p[k]) - exact(cell[0][k])).collect())
                    .collect();
                det(&rows) > zero()
            });
            assert_eq!(
                Reach::does_half_space_meet(&facet, &low, &high),
                expected,
                "{cell:?} {low:?} {high:?}"
            );
            n_met += usize::from(expected);
            n_apart += usize::from(!expected);
        }
    }
    println!("{n_met} met, {n_apart} not");
    assert!(n_met > 3_000 && n_apart > 3_000);
}

#[test]
fn half_spaces_meet_boxes_as_exact_numbers_have_it() {
    check_half_spaces::<2>(3);
    check_half_spaces::<3>(4);
}

/// Covering balls have the exact ones in them, and are hardly larger; the radius as it is rounded to the nearest number
/// would not do.
fn check_covering<const D: usize>(seed: u64)
where
    [f64; D]: Reach + Measures,
{
    let rng = &mut Rng::new(seed);
    let (mut n, mut n_tight, mut n_plain, mut n_infinite) = (0, 0, 0, 0);
    for round in 0..20_000 {
        let Some(cell) = draw::<D>(round, rng) else { continue };
        let corners: Vec<&[f64; D]> = cell.iter().collect();
        let sphere = Exact::new(&cell);
        let (centre, radius) = Reach::covering_ball(&corners, 0.0);
        if radius == f64::INFINITY {
            n_infinite += 1;
            assert_eq!(centre, cell[0]);
            continue;
        }
        assert!(sphere.is_in(&centre, radius), "{cell:?} {centre:?} {radius:e}");
        let largest = centre.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let least = radius - largest * 2f64.powi(-50) - 24.0 * f64::from_bits(1);
        let exceeds = |factor: f64| {
            let squared = exact(least) * exact(least) * sphere.divisor.clone() * sphere.divisor.clone();
            least > 0.0 && squared > sphere.squared_radius.clone() * exact(factor)
        };
        assert!(!exceeds(1.0 + 8e-9), "{cell:?} {centre:?} {radius:e}");
        n += 1;
        n_tight += usize::from(!exceeds(1.0 + 1e-11));
        let (plain, squared) = Measures::circumsphere(&corners);
        n_plain += usize::from(sphere.is_in(&plain, squared.sqrt()));
    }
    println!("{n} balls, {n_tight} tight, {n_plain} of those rounded suffice, {n_infinite} infinite");
    assert!(n > 10_000 && 10 * n_tight > 6 * n && 2 * n_plain < n);
}

#[test]
fn covering_balls_cover() {
    check_covering::<2>(5);
    check_covering::<3>(6);
}

/// A cell with weights: equal ones, whole ones, any, far greater than the cell, or far less than a last bit of it.
fn draw_weights<const D: usize>(cell: &[[f64; D]], rng: &mut Rng) -> Vec<WeightedPoint<D>> {
    let extent = cell.iter().flat_map(|p| (0..D).map(|k| (p[k] - cell[0][k]).abs())).fold(0.0, f64::max);
    let scale = (extent * extent * [0.0, 0.125, 1.0, 100.0, 1e30, 1e-30][rng.below(6)]).min(MAX_WEIGHT / 8.0);
    let is_whole = rng.one_in(2);
    let weight = |rng: &mut Rng| {
        let share = rng.unit() * 8.0 - 4.0;
        scale * if is_whole { share.floor() } else { share }
    };
    cell.iter().map(|&place| WeightedPoint { place, weight: weight(rng) }).collect()
}

/// The longest integers that there can be have room.
#[test]
fn there_is_room_for_the_longest_reaches() {
    let least = f64::from_bits(1);
    for (most, heavy) in [(MAX_MAGNITUDE, MAX_WEIGHT), (MAX_MAGNITUDE, -MAX_WEIGHT)] {
        let at = |place, weight| WeightedPoint { place, weight };
        let low = at([most.next_down(), least, -most], heavy);
        let high = at([most, most.next_down(), most], heavy);
        let cell = [
            at([-most, -most, -most.next_down()], -heavy),
            at([most, least, -most], heavy),
            at([least, most, -most], -heavy.next_down()),
            at([-most, least, most], least),
        ];
        let cell = cell.each_ref();
        let reach = Exact::with_weights(&cell.map(|&p| p), heavy);
        assert_eq!(Reach::does_ball_meet(&cell, &(), &low, &high), reach.meets(&low.place, &high.place));
    }
}

/// Reaches against boxes as exact numbers have it, for weights up to the greatest of a corner and for less; and balls that cover
/// them.
fn check_reaches<const D: usize>(seed: u64)
where
    WeightedPoint<D>: Reach<Centre = ()> + Measures,
    [f64; D]: Measures,
{
    let rng = &mut Rng::new(seed);
    let (mut n_met, mut n_apart, mut n_touching, mut n_sure, mut n_covered) = (0, 0, 0, 0, 0);
    for round in 0..6_000 {
        let Some(places) = draw::<D>(round, rng) else { continue };
        let cell = draw_weights(&places, rng);
        let corners: Vec<&WeightedPoint<D>> = cell.iter().collect();
        let heaviest = cell.iter().fold(f64::NEG_INFINITY, |most, p| most.max(p.weight));
        let greatest = [heaviest, heaviest, 2.0 * heaviest.abs(), cell[0].weight][rng.below(4)];
        let reach = Exact::with_weights(&cell, greatest);
        for _ in 0..4 {
            let [mut low, mut high] = draw_box(&places, rng);
            // At the end of the reach along an axis, where the box decides by a bit.
            if rng.one_in(3) {
                let (centre, squared) = Measures::circumsphere(&corners);
                let (axis, radius) = (rng.below(D), (squared + greatest).max(0.0).sqrt());
                (low, high) = ([-MAX_MAGNITUDE; D], [MAX_MAGNITUDE; D]);
                let side = (centre.place[axis] + radius).clamp(-MAX_MAGNITUDE, MAX_MAGNITUDE);
                low[axis] = nearby(side, rng);
            }
            let expected = reach.meets(&low, &high);
            let [l, h] = [low, high].map(|place| WeightedPoint { place, weight: greatest });
            let surely = Reach::does_ball_surely_meet(&corners, &l, &h);
            assert_eq!(Reach::does_ball_meet(&corners, &(), &l, &h), expected, "{cell:?} {low:?} {high:?}");
            assert!(surely.is_none_or(|surely| surely == expected), "{cell:?} {low:?} {high:?}");
            n_sure += usize::from(surely.is_some());
            n_met += usize::from(expected);
            n_apart += usize::from(!expected);
            let is_touched = |k: usize| {
                let mut moved = low;
                moved[k] = low[k].next_up();
                moved[k] <= high[k] && !reach.meets(&moved, &high)
            };
            n_touching += usize::from(expected && (0..D).any(is_touched));
        }
        let (centre, radius) = Reach::covering_ball(&corners, greatest);
        if reach.squared_radius >= zero() && radius < f64::INFINITY {
            assert!(reach.is_in(&centre.place, radius), "{cell:?} {greatest} {centre:?} {radius:e}");
            n_covered += 1;
        }
    }
    println!("{n_met} met, {n_apart} not, {n_touching} by a bit; {n_sure} are sure; {n_covered} are covered");
    assert!(n_met > 3_000 && n_apart > 3_000 && n_touching > 200 && n_sure > 3_000 && n_covered > 2_000);
}

#[test]
fn reaches_meet_boxes_as_exact_numbers_have_it() {
    check_reaches::<2>(7);
    check_reaches::<3>(8);
}
