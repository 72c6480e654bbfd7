use super::*;
use crate::predicates::dyadic::Dyadic;
use crate::random::Rng;
use std::cmp::Ordering;

/// The determinant by its definition, in exact numbers: as the determinant of the rows (p, |p|² − w, 1), by the last corner's
/// differences and Laplace's rule.
fn exact<const D: usize, const N: usize>(points: &[[f64; D]; N], weights: &[f64; N]) -> Ordering {
    let difference = |a: f64, b: f64| Dyadic::from(a) - Dyadic::from(b);
    let rows: Vec<Vec<Dyadic>> = (0..N - 1)
        .map(|i| {
            let mut row: Vec<_> =
                (0..D).map(|axis| difference(points[i][axis], points[N - 1][axis])).collect();
            let square = row.iter().fold(Dyadic::from(0.0), |sum, x| sum + x.clone() * x.clone());
            row.push(square - difference(weights[i], weights[N - 1]));
            row
        })
        .collect();
    let det = determinant(&rows);
    let zero = Dyadic::from(0.0);
    // Of positive simplices it is positive inside in the plane, and negative in space.
    let order = det.partial_cmp(&zero).expect("numbers");
    if D == 2 { order } else { order.reverse() }
}

fn determinant(rows: &[Vec<Dyadic>]) -> Dyadic {
    let Some((first, rest)) = rows.split_first() else { return Dyadic::from(1.0) };
    let mut sum = Dyadic::from(0.0);
    for (k, x) in first.iter().enumerate() {
        let minor: Vec<Vec<Dyadic>> = rest
            .iter()
            .map(|row| row.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, y)| y.clone()).collect())
            .collect();
        let term = x.clone() * determinant(&minor);
        sum = if k % 2 == 0 { sum + term } else { sum - term };
    }
    sum
}

fn sign(x: f64) -> Ordering {
    x.partial_cmp(&0.0).expect("a number")
}

/// Points, and weights with which nearly all of them have one power to a common centre.
fn near_tie<const D: usize, const N: usize>(rng: &mut Rng) -> ([[f64; D]; N], [f64; N]) {
    let size = [3, 20, 1 << 20][rng.below(3)];
    let exponent = rng.within(-90, 90) as i32;
    let (unit, square) = (2f64.powi(exponent), 2f64.powi(2 * exponent));
    let point = |rng: &mut Rng| -> [i64; D] { std::array::from_fn(|_| rng.within(-size, size)) };
    let (centre, radius) = (point(rng), rng.within(-size, size));
    let whole: [[i64; D]; N] = std::array::from_fn(|_| point(rng));
    let mut weights = whole.map(|p| {
        let square_of = |axis: usize| (p[axis] - centre[axis]) * (p[axis] - centre[axis]);
        ((0..D).map(square_of).sum::<i64>() - radius) as f64 * square
    });
    let changed = rng.below(N);
    weights[changed] = match rng.below(4) {
        0 => weights[changed],
        1 => weights[changed].next_up(),
        2 => weights[changed].next_down(),
        _ => weights[changed] + square * rng.within(-1, 1) as f64,
    };
    (whole.map(|p| p.map(|x| x as f64 * unit)), weights)
}

/// Numbers of any size, a few of them close to each other.
fn wild<const D: usize, const N: usize>(rng: &mut Rng) -> ([[f64; D]; N], [f64; N]) {
    let number = |rng: &mut Rng, greatest: f64, least: i64| -> f64 {
        match rng.below(6) {
            0 => 0.0,
            1 => f64::from_bits(1 + rng.below(3) as u64),
            2 => greatest,
            3 => -greatest,
            _ => {
                (2.0 * rng.unit() - 1.0) * 2f64.powi(rng.within(least, (greatest.log2() - 1.0) as i64) as i32)
            }
        }
    };
    let mut points: [[f64; D]; N] =
        std::array::from_fn(|_| std::array::from_fn(|_| number(rng, 1e57, -1000)));
    let weights = std::array::from_fn(|_| number(rng, MAX_WEIGHT, -1000));
    if rng.one_in(2) {
        points[rng.below(N)] = points[rng.below(N)];
    }
    (points, weights)
}

fn check<const D: usize, const N: usize>(
    rng: &mut Rng,
    n: usize,
    draw: impl Fn(&mut Rng) -> ([[f64; D]; N], [f64; N]),
    found: impl Fn(&[[f64; D]; N], &[f64; N]) -> f64,
) -> [usize; 3] {
    let mut counts = [0; 3];
    for _ in 0..n {
        let (points, weights) = draw(rng);
        let expected = exact(&points, &weights);
        assert_eq!(sign(found(&points, &weights)), expected, "{points:?} {weights:?}");
        counts[(expected as i8 + 1) as usize] += 1;
    }
    counts
}

fn circle(points: &[[f64; 2]; 4], weights: &[f64; 4]) -> f64 {
    in_power_circle(&StaticFilter::plane([1.0; 2], [-1.0; 2]), points.each_ref(), weights)
}

fn sphere(points: &[[f64; 3]; 5], weights: &[f64; 5]) -> f64 {
    in_power_sphere(&StaticFilter::space([1.0; 3], [-1.0; 3]), points.each_ref(), weights)
}

#[test]
fn signs_are_exact() {
    let rng = &mut Rng::new(1);
    for counts in [
        check(rng, 40_000, near_tie, circle),
        check(rng, 20_000, near_tie, sphere),
        check(rng, 10_000, wild, circle),
        check(rng, 4_000, wild, sphere),
    ] {
        assert!(counts.iter().all(|&n| n > 100), "{counts:?}");
    }
}

/// Random points with weights as large as their squared distances are decided without integers.
#[test]
fn easy_signs_are_certain() {
    let rng = &mut Rng::new(2);
    let before = crate::predicates::exact_calls();
    for _ in 0..10_000 {
        let points: [[f64; 3]; 5] = std::array::from_fn(|_| std::array::from_fn(|_| rng.unit()));
        let weights = std::array::from_fn(|_| rng.unit());
        assert_ne!(sphere(&points, &weights), 0.0);
        let points: [[f64; 2]; 4] = std::array::from_fn(|_| std::array::from_fn(|_| rng.unit()));
        assert_ne!(circle(&points, &[rng.unit(), rng.unit(), 0.0, 1.0]), 0.0);
    }
    assert!(crate::predicates::exact_calls() - before < 20, "some of 20,000");
}

/// Equal weights make no difference, and a weight that is larger takes a point inside: at which it does is where its power is that
/// of the circle.
#[test]
fn a_weight_takes_a_point_inside() {
    let unit = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]];
    let with = |q: [f64; 2], weight: f64| circle(&[unit[0], unit[1], unit[2], q], &[0.0, 0.0, 0.0, weight]);
    assert!(with([3.0, 0.0], 0.0) < 0.0);
    // Its power is 9 - w, and 1 is that of the circle.
    assert_eq!(sign(with([3.0, 0.0], 8.0)), Ordering::Equal);
    assert!(with([3.0, 0.0], 8f64.next_up()) > 0.0 && with([3.0, 0.0], 8f64.next_down()) < 0.0);
    // Far away weights of the corners are the same as less weight of the point.
    let corners = [5.0, 5.0, 5.0, 13.0];
    assert_eq!(sign(circle(&[unit[0], unit[1], unit[2], [3.0, 0.0]], &corners)), Ordering::Equal);
}
