//! Delimiters, separators, tolerances and the distance tests, against exact rational arithmetic.
//!
//! Doubles are integers times a common power of two, so inequalities between them are decided in integers. A
//! bi-cell is its facet followed by both opposing vertices.

use crate::common::Rng;
use deldrift::internals::predicates::{
    BiCells, LANES, delimiter2d, delimiter3d, displacement_limit, distance_above, distance_from_sphere,
    is_certainly_inside, is_path_certainly_outside, orientation_tolerance2d, orientation_tolerance3d,
    separator3d, squared_distance, tolerances2d, tolerances3d,
};
use num_bigint::{BigInt, Sign};
use std::array::from_fn;

type Integers = Vec<BigInt>;

/// Integers proportional to the numbers, all of the same scale.
/// Whether a point that stays where it is is certainly strictly outside the sphere.
fn is_certainly_outside<const D: usize>(centre: &[f64; D], radius: f64, p: &[f64; D]) -> bool {
    is_path_certainly_outside(centre, radius, p, p)
}

fn integers(numbers: &[f64]) -> (Integers, i64) {
    let parts = |x: f64| {
        let bits = x.to_bits();
        let (mantissa, exponent) = (bits & ((1 << 52) - 1), (bits >> 52 & 2047) as i64);
        let (mantissa, exponent) =
            if exponent == 0 { (mantissa, -1074) } else { (mantissa | 1 << 52, exponent - 1075) };
        (if x < 0.0 { -BigInt::from(mantissa) } else { BigInt::from(mantissa) }, exponent)
    };
    assert!(numbers.iter().all(|x| x.is_finite()));
    let lowest = numbers.iter().filter(|x| **x != 0.0).map(|&x| parts(x).1).min().unwrap_or(0);
    let scaled = |&x: &f64| {
        let (mantissa, exponent) = parts(x);
        if x == 0.0 { BigInt::ZERO } else { mantissa << (exponent - lowest) as usize }
    };
    (numbers.iter().map(scaled).collect(), lowest)
}

/// To the last bit or so.
fn to_f64(x: &BigInt, scale: i64) -> f64 {
    let shift = x.bits().saturating_sub(64);
    let digits = (x >> shift as usize).iter_u64_digits().next().unwrap_or(0) as f64;
    let mut value = if x.sign() == Sign::Minus { -digits } else { digits };
    let mut exponent = shift as i64 + scale;
    while exponent != 0 {
        let step = exponent.clamp(-1000, 1000);
        value *= 2f64.powi(step as i32);
        exponent -= step;
    }
    value
}

fn ratio(numerator: &BigInt, denominator: &BigInt, scale: i64) -> f64 {
    let shift = (denominator.bits() as i64 - numerator.bits() as i64 + 80).max(0);
    to_f64(&((numerator << shift as usize) / denominator), scale - shift)
}

fn minus(p: &Integers, q: &Integers) -> Integers {
    p.iter().zip(q).map(|(x, y)| x - y).collect()
}

fn dot(p: &Integers, q: &Integers) -> BigInt {
    p.iter().zip(q).map(|(x, y)| x * y).sum()
}

fn cross(p: &Integers, q: &Integers) -> Integers {
    (0..3).map(|k| &p[(k + 1) % 3] * &q[(k + 2) % 3] - &p[(k + 2) % 3] * &q[(k + 1) % 3]).collect()
}

fn determinant(rows: &[Integers]) -> BigInt {
    if rows.len() == 1 {
        return rows[0][0].clone();
    }
    (0..rows.len())
        .map(|j| {
            let minor: Vec<Integers> = rows[1..]
                .iter()
                .map(|row| (0..row.len()).filter(|&k| k != j).map(|k| row[k].clone()).collect())
                .collect();
            let term = &rows[0][j] * determinant(&minor);
            if j % 2 == 0 { term } else { -term }
        })
        .sum()
}

fn is_positive(x: &BigInt) -> bool {
    x.sign() == Sign::Plus
}

/// Orientation of D + 1 points.
fn orientation<const D: usize>(points: &[[f64; D]]) -> BigInt {
    let p = exact(points).0;
    determinant(&p[1..].iter().map(|q| minus(q, &p[0])).collect::<Vec<_>>())
}

/// The points as integers, from the first one.
fn exact<const D: usize>(points: &[[f64; D]]) -> (Vec<Integers>, i64) {
    let (all, scale) = integers(points.as_flattened());
    let points: Vec<Integers> = all.chunks(D).map(<[BigInt]>::to_vec).collect();
    (points.iter().map(|p| minus(p, &points[0])).collect(), scale)
}

/// Affine dependency of D + 2 points, λ of the first opposing vertex not
/// negative, and the in-sphere determinant.
fn dependency(points: &[Integers]) -> (Integers, BigInt) {
    let n = points.len();
    let mut lambda: Integers = (0..n)
        .map(|i| {
            let rows: Vec<Integers> = (0..n)
                .filter(|&j| j != i)
                .map(|j| [BigInt::from(1)].iter().chain(&points[j]).cloned().collect())
                .collect();
            let value = determinant(&rows);
            if i % 2 == 0 { value } else { -value }
        })
        .collect();
    if lambda[n - 2].sign() == Sign::Minus {
        lambda.iter_mut().for_each(|x| *x = -&*x);
    }
    let delta = lambda.iter().zip(points).map(|(l, p)| l * dot(p, p)).sum();
    (lambda, delta)
}

/// Whether the two cells have opposite sides of the facet to themselves, and then whether the facet is
/// Delaunay, which must be certain.
fn is_delaunay<const D: usize>(points: &[[f64; D]]) -> Option<bool> {
    let (lambda, delta) = dependency(&exact(points).0);
    (is_positive(&lambda[D]) && is_positive(&lambda[D + 1])).then(|| is_positive(&delta))
}

/// The partitions of a bi-cell: which points are inside. The standard one is the last.
fn partitions<const D: usize>() -> Vec<Vec<usize>> {
    match D {
        2 => vec![vec![0, 1]],
        _ => vec![vec![1, 2], vec![2, 0], vec![0, 1], vec![0, 1, 2]],
    }
}

fn others(inside: &[usize], n: usize) -> Vec<usize> {
    (0..n).filter(|i| !inside.contains(i)).collect()
}

/// Half the width of the annulus with these points inside, and its centre; negative if
/// they are outside, NaN if there is no centre.
fn half_width<const D: usize>(points: &[[f64; D]], inside: &[usize]) -> (f64, [f64; D]) {
    let (p, scale) = exact(points);
    let outside = others(inside, D + 2);
    let (mut rows, mut right): (Vec<Integers>, Integers) = Default::default();
    for set in [inside, &outside] {
        for &i in &set[1..] {
            rows.push(minus(&p[i], &p[set[0]]).iter().map(|x| x * 2).collect());
            right.push(dot(&p[i], &p[i]) - dot(&p[set[0]], &p[set[0]]));
        }
    }
    let denominator = determinant(&rows);
    if denominator == BigInt::ZERO {
        return (f64::NAN, [f64::NAN; D]);
    }
    let numerators: Integers = (0..D)
        .map(|k| {
            let mut replaced = rows.clone();
            replaced.iter_mut().zip(&right).for_each(|(row, x)| row[k] = x.clone());
            determinant(&replaced)
        })
        .collect();
    let square_from = |i: usize| -> BigInt {
        let from: Integers = p[i].iter().zip(&numerators).map(|(x, n)| x * &denominator - n).collect();
        dot(&from, &from)
    };
    let squares = [square_from(inside[0]), square_from(outside[0])];
    let denominator_square = &denominator * &denominator;
    let difference = ratio(&(&squares[1] - &squares[0]), &denominator_square, 2 * scale);
    let [r, big] = squares.map(|square| ratio(&square, &denominator_square, 2 * scale).sqrt());
    let centre = from_fn(|k| points[0][k] + ratio(&numerators[k], &denominator, scale));
    (difference / (2.0 * (r + big)), centre)
}

/// Half the width of the slab with these points on one side, as far as the slabs of the module go.
fn slab_half_width(points: &[[f64; 3]], inside: &[usize]) -> f64 {
    let (p, scale) = exact(points);
    let w = minus(&p[3], &p[4]);
    let sides = |k: usize| {
        let (e, a, b) = (&p[k], &p[(k + 1) % 3], &p[(k + 2) % 3]);
        let mut n = cross(&minus(b, a), &w);
        if !is_positive(&dot(&minus(e, a), &n)) {
            n.iter_mut().for_each(|x| *x = -&*x);
        }
        let width = |height: BigInt| 0.5 * ratio(&(&height * &height), &dot(&n, &n), 2 * scale).sqrt();
        let (line, vertex) = (dot(&minus(&p[3], a), &n), dot(&minus(e, a), &n));
        (is_positive(&line), width(line.clone()), width(vertex.min(line)))
    };
    match inside {
        [_, _] => {
            let (above, _, width) = sides((inside[0] + 2) % 3);
            if above { width } else { 0.0 }
        }
        _ => (0..3).map(sides).filter(|(above, ..)| !above).map(|(_, width, _)| width).fold(0.0, f64::max),
    }
}

/// The tolerance that `predicates::separator3d` bounds from below.
fn true_tolerance(points: &[[f64; 3]]) -> f64 {
    let width = |inside: &Vec<usize>| half_width(points, inside).0.max(slab_half_width(points, inside));
    partitions::<3>().iter().map(width).fold(f64::INFINITY, f64::min)
}

/// Whether all points are on their sides of a sphere, and not nearer to it than `margin`.
fn are_apart<const D: usize>(
    points: &[[f64; D]],
    inside: &[usize],
    centre: &[f64; D],
    radius: f64,
    margin: f64,
) -> bool {
    let numbers: Vec<f64> =
        points.as_flattened().iter().chain(centre).chain(&[radius, margin]).copied().collect();
    let (all, _) = integers(&numbers);
    let [.., radius, margin] = &all[..] else { unreachable!() };
    let centre = all[D * points.len()..][..D].to_vec();
    let (least, greatest) = (radius + margin, radius - margin);
    all[..D * points.len()].chunks(D).enumerate().all(|(i, p)| {
        let from = minus(&p.to_vec(), &centre);
        let square = dot(&from, &from);
        if inside.contains(&i) {
            greatest.sign() != Sign::Minus && square <= &greatest * &greatest
        } else {
            square >= &least * &least
        }
    })
}

/// Compares |p − q| to t.
fn compare_distance<const D: usize>(p: &[f64; D], q: &[f64; D], t: f64) -> std::cmp::Ordering {
    let numbers: Vec<f64> = p.iter().chain(q).chain(&[t]).copied().collect();
    let (all, _) = integers(&numbers);
    let from = minus(&all[..D].to_vec(), &all[D..2 * D].to_vec());
    dot(&from, &from).cmp(&(&all[2 * D] * &all[2 * D]))
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Random,
    Far,
    Clustered,
    Cospherical,
    Sliver,
    Flat,
    Grid,
    ShakenGrid,
    Magnitudes,
    Mixed,
}
const KINDS: [Kind; 10] = [
    Kind::Random,
    Kind::Far,
    Kind::Clustered,
    Kind::Cospherical,
    Kind::Sliver,
    Kind::Flat,
    Kind::Grid,
    Kind::ShakenGrid,
    Kind::Magnitudes,
    Kind::Mixed,
];

fn signed(rng: &mut Rng) -> f64 {
    2.0 * rng.unit() - 1.0
}

fn power(rng: &mut Rng, low: f64, high: f64) -> f64 {
    10f64.powf(low + (high - low) * rng.unit())
}

fn draw<const D: usize, const N: usize>(kind: Kind, rng: &mut Rng) -> [[f64; D]; N] {
    let scale = match kind {
        Kind::Magnitudes if rng.one_in(2) => power(rng, -130.0, 56.0),
        Kind::Magnitudes => power(rng, -324.0, 56.0),
        _ => 1.0,
    };
    let small = power(rng, -16.0, 0.0);
    let origin: [f64; D] = from_fn(|_| if kind == Kind::Far { 1e4 * rng.unit() } else { 0.0 });
    from_fn(|_| {
        let mut p: [f64; D] = from_fn(|_| signed(rng));
        let norm = p.iter().map(|x| x * x).sum::<f64>().sqrt();
        match kind {
            Kind::Clustered if rng.one_in(2) => p = p.map(|x| x * small),
            Kind::Cospherical => p = p.map(|x| x / norm + small * signed(rng)),
            Kind::Sliver => {
                p[D - 1] *= small;
                p = p.map(|x| x / norm + small * signed(rng));
            }
            Kind::Flat => p[D - 1] *= small,
            Kind::Grid => p = p.map(|x| (3.0 * x).round()),
            Kind::ShakenGrid => p = p.map(|x| (2.0 * x).round() + 1e-15 * signed(rng)),
            Kind::Mixed => p = p.map(|x| x * power(rng, -60.0, 56.0)),
            _ => {}
        }
        from_fn(|k| origin[k] + p[k] * scale)
    })
}

/// Random bi-cells of all kinds, Delaunay or not.
fn bicells<const D: usize, const N: usize>(
    n: usize,
    seed: u64,
) -> impl Iterator<Item = (Kind, [[f64; D]; N])> {
    let mut rng = Rng::new(seed);
    (0..).map(move |i| (KINDS[i % KINDS.len()], draw::<D, N>(KINDS[i % KINDS.len()], &mut rng))).take(n)
}

/// Certified values over true ones, per kind.
#[derive(Default)]
struct Ratios(Vec<(Kind, f64)>);

impl Ratios {
    fn add(&mut self, kind: Kind, certified: f64, exact: f64) {
        // A rounded centre can be a better one: the standard delimiter
        // is the best only where the width is small.
        self.0.push((kind, certified / exact));
    }

    fn report(mut self, what: &str) {
        for kind in KINDS {
            let mut of_kind: Vec<f64> = self.0.iter().filter(|(k, _)| *k == kind).map(|(_, r)| *r).collect();
            of_kind.sort_by(f64::total_cmp);
            if let Some(worst) = of_kind.first() {
                let at = |q: f64| of_kind[(q * of_kind.len() as f64) as usize];
                println!(
                    "{what}, {kind:?}: {} positive, certified / true worst {worst:.6}, 1 % {:.6}, median 1 - {:.1e}, best 1 + {:.1e}",
                    of_kind.len(),
                    at(0.01),
                    1.0 - at(0.5),
                    of_kind.last().expect("one") - 1.0
                );
                assert!(kind != Kind::Random && kind != Kind::Far || at(0.5) > 0.999);
            }
        }
        self.0.clear();
    }
}

#[test]
fn delimiters_of_the_plane_are_certified() {
    let mut ratios = Ratios::default();
    for (kind, p) in bicells::<2, 4>(200_000, 1) {
        let delimiter = delimiter2d(&p[2], [&p[0], &p[1]], &p[3]);
        let (t, delaunay) = (delimiter.half_width, is_delaunay(&p));
        assert!(t >= 0.0 && t.is_finite() && delimiter.reach == f64::INFINITY && delimiter.tolerance == t);
        if t > 0.0 {
            assert!(are_apart(&p, &[0, 1], &delimiter.centre, delimiter.radius, t), "{kind:?} {p:?}");
            assert_ne!(delaunay, Some(false), "{kind:?} {p:?}");
        }
        if delaunay == Some(true) && !matches!(kind, Kind::Magnitudes | Kind::Mixed) {
            ratios.add(kind, t, half_width(&p, &[0, 1]).0);
        }
    }
    ratios.report("plane");
}

#[test]
fn delimiters_and_separators_of_space_are_certified() {
    let (mut ratios, mut standard) = (Ratios::default(), Ratios::default());
    let mut n_exceptions = 0;
    for (kind, p) in bicells::<3, 5>(300_000, 2) {
        let facet = [&p[0], &p[1], &p[2]];
        let delimiter = delimiter3d(&p[3], facet, &p[4]);
        let separator = separator3d(&p[3], facet, &p[4], f64::INFINITY);
        let exception = usize::from(separator.exception);
        let delaunay = is_delaunay(&p);
        for (d, inside) in [(delimiter, 3), (separator.delimiter, exception)] {
            assert!(d.half_width >= 0.0 && d.half_width.is_finite() && d.reach >= 0.0);
            assert_eq!(d.tolerance, d.half_width.min(d.reach));
            if d.half_width > 0.0 {
                let inside = &partitions::<3>()[inside];
                assert!(are_apart(&p, inside, &d.centre, d.radius, d.half_width), "{kind:?} {p:?}");
            }
            if d.tolerance > 0.0 {
                assert_ne!(delaunay, Some(false), "{kind:?} {p:?}");
            }
        }
        if delaunay == Some(true) {
            n_exceptions += usize::from(exception < 3);
            let certified =
                [f64::INFINITY, 0.0].map(|e| separator3d(&p[3], facet, &p[4], e).delimiter.tolerance);
            assert!(certified[1] <= certified[0] * (1.0 + 1e-14));
            if !matches!(kind, Kind::Magnitudes | Kind::Mixed) {
                ratios.add(kind, certified[0], true_tolerance(&p));
                standard.add(kind, delimiter.half_width, half_width(&p, &[0, 1, 2]).0);
            }
        }
    }
    assert!(n_exceptions > 1000);
    ratios.report("space, tolerance");
    standard.report("space, standard half-width");
}

/// What is computed for several bi-cells at a time is, bit for bit, what is computed for one.
#[test]
fn tolerances_of_several_bicells_are_those_of_each() {
    let mut several = BiCells::<2, 4>::default();
    let all: Vec<_> = bicells::<2, 4>(40_000, 8).map(|(_, p)| p).collect();
    for group in all.chunks_exact(LANES) {
        group.iter().enumerate().for_each(|(i, p)| several.set(i, p.each_ref()));
        let each: Vec<f64> =
            group.iter().map(|p| delimiter2d(&p[2], [&p[0], &p[1]], &p[3]).tolerance).collect();
        assert_eq!(tolerances2d(&several).map(f64::to_bits), from_fn(|i| each[i].to_bits()), "{group:?}");
    }
    let (mut several, rng) = (BiCells::<3, 5>::default(), &mut Rng::new(8));
    let all: Vec<_> = bicells::<3, 5>(40_000, 9).map(|(_, p)| p).collect();
    let (mut n_positive, mut n_less) = (0, 0);
    for group in all.chunks_exact(LANES) {
        group.iter().enumerate().for_each(|(i, p)| several.set(i, p.each_ref()));
        let enough: [f64; LANES] = from_fn(|_| [0.0, f64::INFINITY, power(rng, -3.0, 0.0)][rng.below(3)]);
        let each = |i: usize| {
            let [o, f, g, c, d] = &group[i];
            separator3d(c, [o, f, g], d, enough[i]).delimiter.tolerance
        };
        let tolerances = tolerances3d(&several, enough, 1.0);
        n_positive += tolerances.iter().filter(|t| **t > 0.0).count();
        assert_eq!(tolerances.map(f64::to_bits), from_fn(|i| each(i).to_bits()), "{group:?}");
        let share = rng.unit();
        for (i, of_a_share) in tolerances3d(&several, enough, share).into_iter().enumerate() {
            let [o, f, g, c, d] = &group[i];
            let sharp = separator3d(c, [o, f, g], d, f64::INFINITY).delimiter.tolerance;
            assert!(of_a_share <= sharp * (1.0 + 1e-14), "{group:?}");
            assert!(of_a_share >= share * enough[i].min(sharp) * (1.0 - 1e-14), "{group:?}");
            n_less += usize::from(of_a_share < 0.99 * tolerances[i]);
        }
    }
    assert!(n_positive > 10_000 && n_less > 500, "{n_positive}, {n_less}");
}

/// `p` moved towards `aim` by less than `t`, exactly, if it can be told; by `factor` t at most.
fn moved<const D: usize>(p: &[f64; D], aim: &[f64; D], t: f64, factor: f64) -> [f64; D] {
    let length = squared_distance(p, aim).sqrt();
    let mut factor = factor;
    loop {
        let q = from_fn(|k| p[k] + (aim[k] - p[k]) * (factor * t / length));
        if factor.abs() >= 1.0 || squared_distance(p, &q) < displacement_limit(t) {
            return q;
        }
        // Rounding has taken it too far.
        factor *= 0.5;
        if factor.abs() < 1e-3 || !factor.is_finite() {
            return *p;
        }
    }
}

/// All points moved by `factor` t to the sphere around the centre from
/// the sides that the partition gives them.
fn squeezed<const D: usize, const N: usize>(
    points: &[[f64; D]; N],
    inside: &[usize],
    centre: &[f64; D],
    t: f64,
    factor: f64,
) -> [[f64; D]; N] {
    from_fn(|i| moved(&points[i], centre, t, if inside.contains(&i) { -factor } else { factor }))
}

/// Moves bi-cells by just under their certified tolerances, in the worst
/// directions and in others: they stay Delaunay.
fn survive<const D: usize, const N: usize>(
    n: usize,
    tolerance: impl Fn(&[[f64; D]; N]) -> f64,
    orientation_tolerance: impl Fn(&[[f64; D]; N]) -> f64,
) {
    let mut rng = Rng::new(7);
    let mut n_moved = 0;
    for (kind, p) in bicells::<D, N>(n, 3) {
        let t = tolerance(&p).min(orientation_tolerance(&p));
        if t == 0.0 || is_delaunay(&p).is_none() {
            continue;
        }
        let mut worst: Vec<[[f64; D]; N]> = Vec::new();
        for inside in partitions::<D>() {
            let (_, centre) = half_width(&p, &inside);
            if centre.iter().all(|x| x.is_finite()) {
                worst.push(squeezed(&p, &inside, &centre, t, 0.999_999_999));
                worst.push(squeezed(&p, &inside, &centre, t, -0.999_999_999));
            }
        }
        for _ in 0..3 {
            let directions: [[f64; D]; N] = from_fn(|_| from_fn(|_| signed(&mut rng)));
            worst.push(from_fn(|i| {
                moved(&p[i], &from_fn(|k| p[i][k] + t * directions[i][k]), t, 0.999_999_999)
            }));
            // Towards and away from one point.
            worst.push(from_fn(|i| moved(&p[i], &directions[0], t, 0.999_999 * directions[i][0].signum())));
        }
        for q in worst {
            n_moved += usize::from(q != p);
            assert_eq!(is_delaunay(&q), Some(true), "{kind:?} {p:?} to {q:?}, tolerance {t:e}");
        }
    }
    assert!(n_moved > n, "{n_moved} moves");
}

fn cell_tolerance2d(p: &[[f64; 2]; 4]) -> f64 {
    let [a, b, c, d] = p;
    let positive = |x, y, z| orientation_tolerance2d([x, y, z]).max(orientation_tolerance2d([y, x, z]));
    positive(a, b, c).min(positive(b, a, d))
}

fn cell_tolerance3d(p: &[[f64; 3]; 5]) -> f64 {
    let [a, b, c, d, e] = p;
    let positive =
        |v, w, x, y| orientation_tolerance3d([v, w, x, y]).max(orientation_tolerance3d([w, v, x, y]));
    positive(a, b, c, d).min(positive(b, a, c, e))
}

#[test]
fn bicells_of_the_plane_survive_what_is_within_tolerance() {
    survive::<2, 4>(60_000, |p| delimiter2d(&p[2], [&p[0], &p[1]], &p[3]).tolerance, cell_tolerance2d);
}

#[test]
fn bicells_of_space_survive_what_is_within_tolerance() {
    let tolerance = |p: &[[f64; 3]; 5], enough| {
        separator3d(&p[3], [&p[0], &p[1], &p[2]], &p[4], enough).delimiter.tolerance
    };
    survive::<3, 5>(60_000, |p| tolerance(p, f64::INFINITY), cell_tolerance3d);
    survive::<3, 5>(20_000, |p| delimiter3d(&p[3], [&p[0], &p[1], &p[2]], &p[4]).tolerance, cell_tolerance3d);
}

/// A few percent above the true tolerance, where that is the sphere's and the cells keep their orientation.
fn break_above_tolerance<const D: usize, const N: usize>(
    n: usize,
    separator: impl Fn(&[[f64; D]; N]) -> (Vec<usize>, f64, f64),
) {
    let (mut n_limited, mut n_broken, mut n_delaunay) = (0, 0, 0);
    for (_, p) in bicells::<D, N>(n, 4).filter(|(kind, _)| matches!(kind, Kind::Random | Kind::Cospherical)) {
        if is_delaunay(&p) != Some(true) {
            continue;
        }
        n_delaunay += 1;
        let (inside, half, reach) = separator(&p);
        let (exact, centre) = half_width(&p, &inside);
        // Wider annuli turn cells before they fail.
        if half < 0.999 * exact || reach < exact || exact > 0.02 {
            continue;
        }
        let q = squeezed(&p, &inside, &centre, exact, 1.03);
        let (lambda, _) = dependency(&exact_points(&q));
        if (0..D + 2).all(|i| (lambda[i].sign() == Sign::Minus) == inside.contains(&i)) {
            n_limited += 1;
            n_broken += usize::from(is_delaunay(&q) == Some(false));
        }
    }
    println!(
        "{n_delaunay} bi-cells, {n_limited} of a tolerance below 0.02 that the sphere limits, {n_broken} broken at 1.03 times that"
    );
    assert!(n_limited > n / 1000 && n_broken == n_limited);
}

fn exact_points<const D: usize>(points: &[[f64; D]]) -> Vec<Integers> {
    exact(points).0
}

#[test]
fn tolerances_are_tight() {
    break_above_tolerance::<2, 4>(100_000, |p| {
        let delimiter = delimiter2d(&p[2], [&p[0], &p[1]], &p[3]);
        (vec![0, 1], delimiter.half_width, delimiter.reach)
    });
    break_above_tolerance::<3, 5>(100_000, |p| {
        let separator = separator3d(&p[3], [&p[0], &p[1], &p[2]], &p[4], f64::INFINITY);
        let inside = partitions::<3>()[usize::from(separator.exception)].clone();
        (inside, separator.delimiter.half_width, separator.delimiter.reach)
    });
}

/// The example of the module: the standard delimiter alone proves nothing in space.
#[test]
fn the_standard_half_width_is_no_tolerance_in_space() {
    let s = 0.01;
    let around = |k: f64, r: f64| {
        let (y, x) = (k * std::f64::consts::TAU / 3.0).sin_cos();
        [r * x, r * y, 0.0]
    };
    let points = |s: f64, z: f64| {
        [[0.0, 0.0, z], [0.0, 0.0, -z], around(0.0, 1.0 + s), around(1.0, 1.0 + s), around(2.0, 1.0 + s)]
    };
    let p = points(s, 1.0);
    assert_eq!(is_delaunay(&p), Some(true));
    let delimiter = delimiter3d(&p[3], [&p[0], &p[1], &p[2]], &p[4]);
    let separator = separator3d(&p[3], [&p[0], &p[1], &p[2]], &p[4], f64::INFINITY);
    assert!((delimiter.half_width / s - 0.75).abs() < 0.01, "{delimiter:?}");
    assert!((separator.delimiter.tolerance / s - 0.5).abs() < 0.01, "{separator:?}");
    assert_eq!(separator.exception, 2);
    // Every vertex moves by 0.6 s, less than the standard half-width, and
    // stays on its side of the standard delimiter.
    let q = points(s - 0.6 * s, 1.0 + 0.6 * s);
    assert!(are_apart(&q, &[0, 1, 2], &delimiter.centre, delimiter.radius, 0.1 * s));
    assert_eq!(is_delaunay(&q), Some(false));
}

/// The second gap: both ends of a move are safe, the cells are not.
#[test]
fn a_vertex_may_jump_over_a_delimiter() {
    let p = [[-1.0, 0.0], [1.0, 0.0], [0.0, 2.0], [0.0, -2.0]];
    let delimiter = delimiter2d(&p[2], [&p[0], &p[1]], &p[3]);
    let to = [0.0, -1.9];
    assert!(is_certainly_outside(&delimiter.centre, delimiter.radius, &to));
    assert!(is_delaunay(&[p[0], p[1], to, p[3]]).is_none());
    assert!(!is_path_certainly_outside(&delimiter.centre, delimiter.radius, &p[2], &to));
    assert!(is_path_certainly_outside(&delimiter.centre, delimiter.radius, &p[2], &[0.5, 2.1]));
}

/// Whether all points of the segment are farther from the centre than `radius`, and whether the nearer end
/// is so by a quarter of the squared length, what [`is_path_certainly_outside`] asks for, with 1e-14 to
/// spare.
fn is_path_outside<const D: usize>(centre: &[f64; D], radius: f64, ends: [&[f64; D]; 2]) -> (bool, bool) {
    let numbers: Vec<f64> = centre.iter().chain(ends[0]).chain(ends[1]).chain(&[radius]).copied().collect();
    let (all, _) = integers(&numbers);
    let point = |i: usize| all[i * D..][..D].to_vec();
    let (to_a, to_b) = (minus(&point(1), &point(0)), minus(&point(2), &point(0)));
    let (way, r2) = (minus(&to_b, &to_a), &all[3 * D] * &all[3 * D]);
    let (aa, bb, ww) = (dot(&to_a, &to_a), dot(&to_b, &to_b), dot(&way, &way));
    // The foot of the perpendicular is the fraction -a·w / w·w of the way.
    let along = -dot(&to_a, &way);
    let outside = aa > r2
        && bb > r2
        && (!is_positive(&along) || along >= ww || &aa * &ww - &along * &along > &r2 * &ww);
    let part = |x: &BigInt| x / BigInt::from(10u64.pow(14));
    let least: BigInt = aa.min(bb) * 4;
    (outside, &least - part(&least) > ww + r2 * 4)
}

fn paths_are_certified<const D: usize>(n: usize) {
    let rng = &mut Rng::new(11);
    let (mut n_certain, mut n_jumps) = (0, 0);
    for (kind, [centre, from, mut to, rim]) in bicells::<D, 4>(n, 10) {
        if rng.one_in(3) {
            // To the other side, where the plain test says yes.
            to = from_fn(|k| 2.0 * centre[k] - from[k] + 0.1 * (to[k] - centre[k]));
        }
        let square =
            [&from, &to].map(|p| squared_distance(&centre, p)).into_iter().fold(f64::INFINITY, f64::min);
        let limit = (square - 0.25 * squared_distance(&from, &to)).max(0.0).sqrt();
        let radius = match rng.below(4) {
            0 => squared_distance(&centre, &rim).sqrt(),
            1 => limit,
            2 => limit * (1.0 + 4.0 * f64::EPSILON * signed(rng)),
            _ => square.sqrt() * rng.unit(),
        };
        let certain = is_path_certainly_outside(&centre, radius, &from, &to);
        let (outside, with_room) = is_path_outside(&centre, radius, [&from, &to]);
        assert!(!certain || outside, "{kind:?} {centre:?} {radius} {from:?} {to:?}");
        assert!(certain || !with_room || square < 1e-250, "{kind:?} {centre:?} {radius} {from:?} {to:?}");
        n_certain += usize::from(certain);
        let ends = [&from, &to].map(|p| is_certainly_outside(&centre, radius, p));
        n_jumps += usize::from(ends == [true, true] && !outside);
    }
    assert!(n_certain > n / 20 && n_jumps > n / 20, "{n_certain} certain, {n_jumps} jumps of {n}");
}

/// No path is taken for outside that is not, and nearly all are that the rule of
/// [`is_path_certainly_outside`] allows.
#[test]
fn paths_outside_spheres_are_certified() {
    paths_are_certified::<2>(60_000);
    paths_are_certified::<3>(60_000);
}

/// A simplex moves by just under its tolerance, towards the middle of every slab: it stays positive. And by a
/// little more than that, where the slab is the narrowest: it does not.
fn orientation_is_certified<const D: usize, const N: usize>(
    n: usize,
    tolerance: impl Fn(&[[f64; D]; N]) -> f64,
) {
    let mut ratios = Ratios::default();
    for (kind, mut p) in bicells::<D, N>(n, 5) {
        if orientation(&p).sign() == Sign::Minus {
            p.swap(0, 1);
        }
        let t = tolerance(&p);
        assert!(t >= 0.0 && t.is_finite());
        assert_eq!(tolerance(&from_fn(|i| p[[1, 0, 2, 3][i]])), 0.0);
        if !is_positive(&orientation(&p)) {
            assert_eq!(t, 0.0);
            continue;
        }
        let mut narrowest = (f64::INFINITY, vec![], [0.0; D]);
        let (integers, scale) = exact(&p);
        // The first point is in the first part, whatever that is; each complement once.
        for mask in (1..(1 << N) - 1).step_by(2) {
            let part: Vec<usize> = (0..N).filter(|i| mask >> i & 1 == 1).collect();
            let rest = others(&part, N);
            let differences: Vec<Integers> = [&part, &rest]
                .into_iter()
                .flat_map(|set| set[1..].iter().map(|&i| minus(&integers[i], &integers[set[0]])))
                .collect();
            let mut normal = match &differences[..] {
                [d] => vec![-&d[1], d[0].clone()],
                [d, e] => cross(d, e),
                _ => unreachable!(),
            };
            if dot(&minus(&integers[rest[0]], &integers[part[0]]), &normal).sign() == Sign::Minus {
                normal.iter_mut().for_each(|x| *x = -&*x);
            }
            let height = dot(&minus(&integers[rest[0]], &integers[part[0]]), &normal);
            let square = dot(&normal, &normal);
            let half = 0.5 * ratio(&(&height * &height), &square, 2 * scale).sqrt();
            // In units of the points' scale, and as long as the slab is wide.
            let along: [f64; D] = from_fn(|k| ratio(&(&normal[k] * &height), &square, scale));
            if t > 0.0 {
                let q: [_; N] = from_fn(|i| {
                    let aim = from_fn(|k| p[i][k] + if part.contains(&i) { along[k] } else { -along[k] });
                    moved(&p[i], &aim, t, 0.999_999_999)
                });
                assert!(is_positive(&orientation(&q)), "{kind:?} {p:?}, {part:?}, {t:e}");
            }
            if half < narrowest.0 {
                narrowest = (half, part, along);
            }
        }
        let (half, part, along) = narrowest;
        assert!(t <= half * (1.0 + 1e-15), "{kind:?} {p:?} {t:e} {half:e}");
        if !matches!(kind, Kind::Magnitudes | Kind::Mixed) {
            ratios.add(kind, t, half);
        }
        if kind == Kind::Random {
            let shift = |i: usize| if part.contains(&i) { 0.501 } else { -0.501 };
            let q: [[f64; D]; N] = from_fn(|i| from_fn(|k| p[i][k] + shift(i) * along[k]));
            assert_eq!(orientation(&q).sign(), Sign::Minus);
        }
    }
    ratios.report("orientation");
}

#[test]
fn tolerances_of_orientations_are_certified() {
    orientation_is_certified::<2, 3>(60_000, |[a, b, c]| orientation_tolerance2d([a, b, c]));
    orientation_is_certified::<3, 4>(60_000, |[a, b, c, d]| orientation_tolerance3d([a, b, c, d]));
}

/// Distances, against thresholds a few last bits off.
fn distances_are_certified<const D: usize>(n: usize)
where
    [f64; D]: Default,
{
    use std::cmp::Ordering::{Greater, Less};
    let mut n_undecided = 0;
    for (kind, [p, q, r]) in bicells::<D, 3>(n, 6) {
        let above = distance_above(&p, &q);
        assert_ne!(compare_distance(&p, &q, above), Greater);
        assert_eq!(distance_above(&p, &p), 0.0);
        if !matches!(kind, Kind::Magnitudes | Kind::Mixed) && above > 0.0 {
            assert_eq!(compare_distance(&p, &q, above * (1.0 - 1e-14)), Greater);
        }
        let square = squared_distance(&p, &q);
        for factor in [0.0, 0.5, 1.0 - 1e-9, 1.0 + 1e-12, 3.0] {
            let radius = square.sqrt() * factor;
            let room = distance_from_sphere(&p, radius, &q);
            let inside: &[usize] = if factor > 1.0 { &[0] } else { &[] };
            assert!(room == 0.0 || are_apart(&[q], inside, &p, radius, room), "{kind:?}");
            if square > 1e-200 && factor != 1.0 + 1e-12 {
                assert!(room >= 0.999 * (radius - square.sqrt()).abs(), "{kind:?}");
            }
        }
        for k in -12..=12 {
            let t = square.sqrt() * (1.0 + f64::from(k) * f64::EPSILON / 2.0);
            let room = distance_from_sphere(&p, t, &q);
            assert!(room == 0.0, "{kind:?}: {room} of {t}");
            let order = compare_distance(&p, &q, t);
            let (inside, outside) = (is_certainly_inside(&p, t, &q), is_certainly_outside(&p, t, &q));
            assert!(square >= displacement_limit(t) || order == Less);
            assert!(!inside || order == Less);
            assert!(!outside || order == Greater);
            n_undecided += usize::from(!inside && !outside);
            if square > 1e-200 {
                assert!((k < 12 || inside) && (k > -12 || outside));
            }
            if is_path_certainly_outside(&p, t, &q, &r) {
                // The nearest point of the segment, to double precision; exact arithmetic decides about it.
                let to: [f64; D] = from_fn(|i| r[i] - q[i]);
                let along: f64 = (0..D).map(|i| (p[i] - q[i]) * to[i]).sum::<f64>()
                    / to.iter().map(|x| x * x).sum::<f64>();
                let along = if along.is_finite() { along.clamp(0.0, 1.0) } else { 0.0 };
                let nearest = from_fn(|i| q[i] + along * to[i]);
                assert_ne!(compare_distance(&p, &nearest, t * (1.0 - 1e-12)), Less, "{kind:?}");
                assert!(compare_distance(&p, &q, t) == Greater && compare_distance(&p, &r, t) == Greater);
            }
        }
    }
    assert!(n_undecided > n);
    assert!([0.0, -1.0, 1e-200, f64::NAN].iter().all(|&t| displacement_limit(t) == 0.0));
    assert!(displacement_limit(f64::INFINITY) > 1e200);
}

#[test]
fn distances_and_sides_are_certified() {
    distances_are_certified::<2>(20_000);
    distances_are_certified::<3>(20_000);
}
