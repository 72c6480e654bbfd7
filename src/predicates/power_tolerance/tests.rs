use super::*;
use crate::predicates::{in_power_circle, in_power_sphere, orient2d, orient3d};
use crate::random::Rng;

/// A step of a point of at most this length in a direction, all of it place but a share that is weight.
fn step<const D: usize>(
    p: &WeightedPoint<D>,
    e: f64,
    mut way: [f64; D],
    share: f64,
    sign: f64,
) -> WeightedPoint<D> {
    let length = way.iter().map(|x| x * x).sum::<f64>().sqrt().max(1e-300);
    let most = e * (1.0 - share).sqrt() * (1.0 - 1e-14);
    way.iter_mut().for_each(|x| *x *= most / length);
    let mut q = *p;
    (0..D).for_each(|k| q.place[k] += way[k]);
    q.weight += sign * e * e * share * (1.0 - 1e-14);
    q
}

/// No step within the tolerance makes a bi-cell fail, also where vertices go straight to the centre or away from it;
/// twice as far many do.
fn check<const D: usize, const N: usize>(
    tolerance: impl Fn(&[WeightedPoint<D>; N]) -> f64,
    of_cells: impl Fn(&[WeightedPoint<D>; N]) -> f64,
    centre: impl Fn(&[WeightedPoint<D>; N]) -> [f64; D],
    holds: impl Fn(&[WeightedPoint<D>; N]) -> bool,
) {
    let rng = &mut Rng::new(7);
    let (mut n_bicells, mut n_sharp, mut n_of_cells, mut n_none) = (0, 0, 0, 0);
    while n_bicells < 3_000 {
        let weight = [0.0, 0.1, 1.0][rng.below(3)];
        let mut draw = || {
            let mut place = [0.0; D];
            place.iter_mut().for_each(|x| *x = rng.unit());
            WeightedPoint { place, weight: weight * rng.unit() }
        };
        let points: [WeightedPoint<D>; N] = std::array::from_fn(|_| draw());
        if !holds(&points) {
            continue;
        }
        n_bicells += 1;
        let e = tolerance(&points);
        if e == 0.0 {
            n_none += 1;
            continue;
        }
        let centre = centre(&points);
        let mut is_sharp = false;
        // Each vertex straight to the centre or away from it, in all ways, and then anywhere.
        for trial in 0..(1 << N) + 16 {
            let share = if trial < 1 << N { 0.0 } else { rng.unit() };
            for (scale, is_within) in [(1.0, true), (2.0, false)] {
                let moved: [WeightedPoint<D>; N] = std::array::from_fn(|k| {
                    let p = &points[k];
                    let to = minus(&p.place, &centre);
                    let sign = if trial >> k & 1 == 0 { -1.0 } else { 1.0 };
                    let way = if trial < 1 << N {
                        to.map(|x| sign * x)
                    } else {
                        std::array::from_fn(|_| rng.unit() - 0.5)
                    };
                    step(p, scale * e, way, share, if sign > 0.0 { -1.0 } else { 1.0 })
                });
                let is_good = holds(&moved);
                assert!(is_good || !is_within, "{points:?} within {e}: {moved:?}");
                is_sharp |= !is_good && !is_within;
            }
        }
        let is_of_cells = e > 0.9 * of_cells(&points);
        n_of_cells += usize::from(is_of_cells);
        n_sharp += usize::from(is_sharp && !is_of_cells);
    }
    let rest = n_bicells - n_of_cells;
    assert!(n_none < 100 && 10 * n_sharp > 4 * rest, "{n_none} without, {n_sharp} of {rest} are sharp");
}

#[test]
fn bicells_hold_within_their_tolerance_in_the_plane() {
    let f = StaticFilter::plane([-9.0; 2], [9.0; 2]);
    check::<2, 4>(
        |[a, b, c, d]| tolerance2d(c, [a, b], d),
        |points| {
            let [a, b, c, d] = points.each_ref().map(|p| &p.place);
            orientation_tolerance2d([a, b, c]).min(orientation_tolerance2d([b, a, d]))
        },
        |[a, b, c, _]| {
            let [x, y, volume] = WeightedPoint::<2>::circle::<f64>(a, b, c);
            [a.place[0] + x / (2.0 * volume), a.place[1] + y / (2.0 * volume)]
        },
        |points| {
            let [a, b, c, d] = points.each_ref().map(|p| &p.place);
            orient2d(&f, a, b, c) > 0.0
                && orient2d(&f, b, a, d) > 0.0
                && in_power_circle(&f, [a, b, c, d], &points.map(|p| p.weight)) < 0.0
        },
    );
}

#[test]
fn bicells_hold_within_their_tolerance_in_space() {
    let f = StaticFilter::space([-9.0; 3], [9.0; 3]);
    check::<3, 5>(
        |[a, b, c, d, e]| tolerance3d(d, [a, b, c], e),
        |points| {
            let [a, b, c, d, e] = points.each_ref().map(|p| &p.place);
            orientation_tolerance3d([a, b, c, d]).min(orientation_tolerance3d([b, a, c, e]))
        },
        |[a, b, c, d, _]| {
            let [x, y, z, volume] = WeightedPoint::<3>::sphere::<f64>(a, b, c, d);
            let offset = [x, y, z].map(|n| n / (2.0 * volume));
            std::array::from_fn(|k| a.place[k] + offset[k])
        },
        |points| {
            let [a, b, c, d, e] = points.each_ref().map(|p| &p.place);
            orient3d(&f, a, b, c, d) > 0.0
                && orient3d(&f, b, a, c, e) > 0.0
                && in_power_sphere(&f, [a, b, c, d, e], &points.map(|p| p.weight)) < 0.0
        },
    );
}

/// Tolerances of a bi-cell that is scaled, and of one that is seen in a mirror, follow from its own. As each is
/// tried by steps, a few may be found one step smaller or greater.
fn follow<const D: usize, const N: usize>(
    tolerance: impl Fn(&[WeightedPoint<D>; N]) -> f64,
    same: impl Fn(&[WeightedPoint<D>; N]) -> [WeightedPoint<D>; N],
) {
    let rng = &mut Rng::new(8);
    let (mut n_bicells, mut n_steps) = (0, 0);
    while n_bicells < 2_000 {
        let mut draw = |_| {
            let mut place = [0.0; D];
            place.iter_mut().for_each(|x| *x = rng.unit());
            WeightedPoint { place, weight: 0.3 * rng.unit() }
        };
        let points: [WeightedPoint<D>; N] = std::array::from_fn(&mut draw);
        let e = tolerance(&points);
        if e == 0.0 {
            continue;
        }
        n_bicells += 1;
        let mut compare = |found: f64| {
            if (found / e - 1.0).abs() > 1e-6 {
                n_steps += 1;
                assert!((0.8..1.25).contains(&(found / e)), "{found}, not {e}: {points:?}");
            }
        };
        for scale in [2.0f64.powi(-20), 2.0f64.powi(20)] {
            let scaled = points.map(|p| WeightedPoint {
                place: p.place.map(|x| scale * x),
                weight: scale * scale * p.weight,
            });
            compare(tolerance(&scaled) / scale);
        }
        compare(tolerance(&same(&points)));
    }
    assert!(n_steps < n_bicells / 20, "{n_steps} differ");
}

#[test]
fn tolerances_follow_bicells_that_are_scaled_and_turned() {
    follow::<2, 4>(
        |[a, b, c, d]| tolerance2d(c, [a, b], d),
        |points| {
            let [a, b, c, d] = points.map(|p| WeightedPoint { place: [-p.place[0], p.place[1]], ..p });
            [b, a, c, d]
        },
    );
    follow::<3, 5>(
        |[a, b, c, d, e]| tolerance3d(d, [a, b, c], e),
        |points| {
            let [a, b, c, d, e] = points.map(|p| WeightedPoint { place: p.place.map(|x| -x), ..p });
            [a, c, b, d, e]
        },
    );
}

/// The bound that the head of this file derives, term by term and not multiplied out, of whatever numbers.
#[test]
fn bounds_are_the_sums_that_are_derived() {
    fn check<const D: usize, const N: usize>(rng: &mut Rng, [second, third]: [f64; 2], has_longest: bool)
    where
        WeightedPoint<D>: Located<D, Of<f64> = WeightedPoint<D>>,
    {
        let mut number = |_| 2.0 * rng.unit() - 1.0;
        let points: [WeightedPoint<D>; N] = std::array::from_fn(|k| WeightedPoint {
            place: std::array::from_fn(&mut number),
            weight: number(k),
        });
        let x: [f64; D] = std::array::from_fn(&mut number);
        let volumes: [f64; N] = std::array::from_fn(&mut number);
        let gradients: [[f64; D]; N] = std::array::from_fn(|_| std::array::from_fn(&mut number));
        let facets: [f64; N] = std::array::from_fn(|k| number(k).abs());
        let bound = Bound::new(points.each_ref(), &x, volumes, 0.0, gradients, facets);
        let seen: [[f64; D]; N] = points.map(|p| minus(&p.place, &points[0].place));
        let squares = seen.map(|u| dot(&u, &u));
        let powers: [f64; N] = std::array::from_fn(|k| {
            squares[k] - points[k].weight + points[0].weight - 2.0 * dot(&x, &seen[k])
        });
        let longest = if has_longest { 2.0 * squares.into_iter().fold(0.0, f64::max).sqrt() } else { 1.0 };
        let (d, g) = (N - 1, powers[N - 1]);
        if g <= 0.0 {
            // The bi-cell does not hold, and there is nothing to bound.
            return;
        }
        for e in [0.0, 0.1, 1.0, 3.0] {
            let m = second * longest * e * e + third * e * e * e;
            let (mut sum, mut terms) = (volumes[d] * g, (volumes[d] * g).abs());
            for k in 0..N {
                let way = minus(&seen[k], &x);
                let r = dot(&way, &way).sqrt();
                let gradient: [f64; D] =
                    std::array::from_fn(|axis| 2.0 * volumes[k] * way[axis] + g * gradients[k][axis]);
                let differs = if k == d { 0.0 } else { powers[k].abs() };
                let taken = volumes[k].abs() * differs
                    + e * (dot(&gradient, &gradient).sqrt() + facets[k] * differs)
                    + e * e * volumes[k].abs()
                    + e * facets[k] * (2.0 * r * e + e * e)
                    + m * (powers[k].abs() + 2.0 * r * e + e * e);
                (sum, terms) = (sum - taken, terms + taken);
            }
            let found = bound.0[0] - bound.0[1..].iter().rev().fold(0.0, |sum, term| (sum + term) * e);
            assert!((found - sum).abs() < 1e-9 * terms, "{found}, not {sum}, within {e}: {points:?}");
        }
    }
    let rng = &mut Rng::new(9);
    for _ in 0..500 {
        check::<2, 4>(rng, [4.0, 0.0], false);
        check::<3, 5>(rng, [12.0, 8.0], true);
    }
}
