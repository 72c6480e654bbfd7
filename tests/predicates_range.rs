//! The predicates at the ends of the range of coordinates, where differences, products and bounds underflow.

use crate::exact_oracle::*;
use deldrift::internals::predicates::*;
use std::array::from_fn;
use std::cmp::Ordering;

/// The least positive number.
const LEAST: f64 = f64::from_bits(1);

// ---------------------------------------------------------------------------------------------- points

#[derive(Clone, Copy, Debug)]
enum Family {
    /// Small multiples of the least positive number.
    LeastLattice,
    /// A small lattice, scaled by a power of two of its own in every axis, up to 600 orders of magnitude
    /// apart.
    ScaledAxes,
    /// The same with random points.
    ScaledAxesUniform,
    /// All at a scale near which products of some degree underflow; flat, spherical or neither.
    Underflow,
    /// A cluster of a few last bits, anywhere, near the origin in some axes.
    Cluster,
    /// A lattice near 1 with noise of 10^-40 or less in place of some zeros, or added to some numbers.
    Noise,
    /// Any magnitude, any subset of coordinates zero or at the very ends.
    Mixed,
    /// Two or three places of very different size, at each a cluster.
    Clusters,
}

use Family::*;

const FAMILIES: [Family; 8] =
    [LeastLattice, ScaledAxes, ScaledAxesUniform, Underflow, Cluster, Noise, Mixed, Clusters];

impl Family {
    fn points<const D: usize, const N: usize>(self, random: &mut Random) -> [[f64; D]; N] {
        let mut points = match self {
            LeastLattice => {
                let size = [1, 2, 5, 1_000, 1 << 30, 1 << 54][random.below(6)];
                from_fn(|_| from_fn(|_| random.integer(size) as f64 * LEAST))
            }
            ScaledAxes => {
                let scales: [f64; D] = from_fn(|_| scale(random));
                let size = [1, 2, 5, 100][random.below(4)];
                from_fn(|_| scales.map(|scale| random.integer(size) as f64 * scale))
            }
            ScaledAxesUniform => {
                let scales: [f64; D] = from_fn(|_| scale(random));
                from_fn(|_| scales.map(|scale| random.unit() * scale))
            }
            Underflow => underflow(random),
            Cluster => {
                let base = from_fn(|_| if random.below(2) == 0 { 0.0 } else { magnitude(random) });
                cluster(random, base)
            }
            Noise => noise(random),
            Mixed => from_fn(|_| from_fn(|_| magnitude(random) * random.sign())),
            Clusters => {
                let clusters: [[[f64; D]; N]; 3] = from_fn(|_| {
                    let size = magnitude(random);
                    let base = from_fn(|_| size * random.integer(2) as f64);
                    cluster(random, base)
                });
                let n = 2 + random.below(2);
                from_fn(|i| clusters[random.below(n)][i])
            }
        };
        random.shuffle(&mut points);
        points.map(|p| p.map(|x| x.clamp(-MAX_MAGNITUDE, MAX_MAGNITUDE)))
    }
}

/// A power of two in the range; often at its lower end.
fn scale(random: &mut Random) -> f64 {
    let exponent = if random.below(4) == 0 { -1074 } else { random.below(1_250) as i32 - 1_074 };
    power_of_two(exponent)
}

fn power_of_two(exponent: i32) -> f64 {
    2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2)
}

fn magnitude(random: &mut Random) -> f64 {
    match random.below(7) {
        0 => 0.0,
        1 => LEAST * (1 + random.below(4)) as f64,
        2 => nudged(f64::MIN_POSITIVE, random.integer(3)),
        3 => nudged(MAX_MAGNITUDE, -(random.below(4) as i64)),
        _ => scale(random) * random.unit().abs(),
    }
}

/// Around the place, a few last bits wide.
fn cluster<const D: usize, const N: usize>(random: &mut Random, base: [f64; D]) -> [[f64; D]; N] {
    let spread = [1, 2, 20][random.below(3)];
    from_fn(|_| {
        base.map(|x| {
            let n = random.integer(spread);
            if x.abs() < 100.0 * LEAST { x + n as f64 * LEAST } else { nudged(x, n) }
        })
    })
}

fn underflow<const D: usize, const N: usize>(random: &mut Random) -> [[f64; D]; N] {
    let degree = 1 + random.below(D + 2) as i32;
    let scale = power_of_two(-1_074 / degree + random.integer(60) as i32 + 30);
    let shape = random.below(4);
    let size = [1, 3, 100][random.below(3)];
    let slope: [f64; D] = from_fn(|_| random.unit());
    let mut points: [[f64; D]; N] = from_fn(|_| match shape {
        0 => from_fn(|_| random.unit()),
        1 => from_fn(|_| random.integer(size) as f64),
        // Flat: the last coordinate depends on the first.
        2 => {
            let x: [f64; D] = from_fn(|_| random.unit());
            from_fn(|axis| if axis == D - 1 { slope[0] * x[0] } else { x[axis] })
        }
        _ => {
            let x: [f64; D] = from_fn(|_| random.unit());
            let length = x.iter().map(|x| x * x).sum::<f64>().sqrt();
            x.map(|x| x / length)
        }
    });
    if random.below(2) == 0 {
        points = points.map(|p| from_fn(|axis| p[axis] + slope[axis]));
    }
    points.map(|p| p.map(|x| x * scale))
}

fn noise<const D: usize, const N: usize>(random: &mut Random) -> [[f64; D]; N] {
    let size = [1, 2, 4][random.below(3)];
    let cell = [1.0, 0.1, 1e-3, 1e30][random.below(4)];
    let frequency = 1 + random.below(6);
    from_fn(|_| {
        from_fn(|_| {
            let x = random.integer(size) as f64 * cell;
            if random.below(frequency) == 0 {
                x + 10f64.powi(-40 - random.below(284) as i32) * random.sign() * (1.0 + random.unit().abs())
            } else {
                x
            }
        })
    })
}

// ---------------------------------------------------------------------------------------------- signs

/// A prepared sphere, or a half-space if there is one point less, of all points but the last, which is
/// tested.
struct Prepared<const D: usize, const N: usize> {
    filter: fn([f64; D], [f64; D]) -> StaticFilter,
    side: fn(&StaticFilter, &[[f64; D]; N]) -> f64,
}

impl<const D: usize, const N: usize> Prepared<D, N> {
    /// Answers above the bound have the exact sign, and errors are below the bound.
    fn check(&self) {
        let mut random = Random::new(1_986 + N as u64);
        let mut tally = Tally::default();
        let (mut n_certain, mut largest) = (0, 0f64);
        for family in FAMILIES {
            for _ in 0..N_CASES {
                let points = family.points::<D, N>(&mut random);
                let [lower, upper] = bounding_box(&points);
                let f = (self.filter)(lower, upper);
                let side = (self.side)(&f, &points);
                let expected = exact_sign(&points, &mut tally);
                if side.abs() > f.prepared {
                    assert_eq!(side.partial_cmp(&0.0), Some(expected), "{points:?}");
                    n_certain += 1;
                }
                // An orientation is in other units.
                if N == D + 2 {
                    largest = largest.max(error_ratio(&points, side, f.prepared));
                }
            }
        }
        println!("{D}D: {n_certain} certain of {}, errors up to {largest:.3} of the bound", tally.cases);
        assert!(tally.cases >= 100_000 && n_certain >= tally.cases / 20);
    }
}

/// A determinant predicate: `N` points in dimension `D`.
struct Predicate<const D: usize, const N: usize> {
    value: fn(&StaticFilter, &[[f64; D]; N]) -> f64,
    filter: fn([f64; D], [f64; D]) -> StaticFilter,
    bound: fn(&StaticFilter) -> f64,
}

/// Of each family.
const N_CASES: usize = 15_000;

impl<const D: usize, const N: usize> Predicate<D, N> {
    /// The tightest filter, one that decides next to nothing, a swap; and the rounding error.
    fn check(&self) {
        let mut random = Random::new(1_985 + N as u64);
        let mut total = Tally::default();
        let everything = StaticFilter {
            orient: -1.0,
            in_sphere: -1.0,
            prepared: 0.0,
            largest_square: 0.0,
            is_exact: false,
        };
        let wide = (self.filter)([-MAX_MAGNITUDE; D], [MAX_MAGNITUDE; D]);
        let sign = |f: &StaticFilter, points: &[[f64; D]; N]| {
            (self.value)(f, points).partial_cmp(&0.0).expect("not NaN")
        };
        let (mut largest, mut n_static, mut n_wrong) = (0f64, 0, 0);
        for family in FAMILIES {
            let mut tally = Tally::default();
            for _ in 0..N_CASES {
                let points = family.points::<D, N>(&mut random);
                assert!(points.iter().flatten().all(|&x| is_in_range(x)), "{points:?}");
                let expected = exact_sign(&points, &mut tally);
                let [lower, upper] = bounding_box(&points);
                let tight = (self.filter)(lower, upper);
                assert_eq!(sign(&tight, &points), expected, "{points:?}");
                assert_eq!(sign(&wide, &points), expected, "{points:?}, without static filter");
                let mut swapped = points;
                let i = random.below(N);
                swapped.swap(i, (i + 1 + random.below(N - 1)) % N);
                assert_eq!(sign(&tight, &swapped), expected.reverse(), "{swapped:?}, swapped");

                let rounded = (self.value)(&everything, &points);
                largest = largest.max(error_ratio(&points, rounded, (self.bound)(&tight)));
                n_static += usize::from(rounded.abs() > (self.bound)(&tight));
                n_wrong += usize::from(rounded.partial_cmp(&0.0) != Some(expected));
            }
            println!(
                "{D}D, {N} points, {family:?}: {} cases, {} big, {} zero",
                tally.cases, tally.big, tally.zero
            );
            total.add(&tally);
        }
        println!(
            "{D}D, {N} points: {n_static} static, {n_wrong} wrong signs rounded, errors to {largest:.3}"
        );
        assert!(total.cases >= 100_000 && total.big >= 50_000 && total.zero >= 5_000);
        assert!(n_static >= 10_000 && n_wrong >= 10_000);
    }

    /// Points of a grid whose spacing is next to the least for which determinants are evaluated in integers of fixed
    /// width, some of them a little off: what is left of a tie there is close to underflow.
    fn check_fine_grids(&self) {
        let mut random = Random::new(206);
        let mut tally = Tally::default();
        for case in 0..40_000 {
            let spacing = power_of_two(-175 - case % 40);
            let moved = random.below(D);
            let points: [[f64; D]; N] = from_fn(|_| {
                let mut p = from_fn(|_| (1_000 + random.below(3)) as f64 * spacing);
                if random.below(2) == 0 {
                    p[moved] += spacing * (random.unit() - 0.5) * power_of_two(-20);
                }
                p
            });
            let [lower, upper] = bounding_box(&points);
            let value = (self.value)(&(self.filter)(lower, upper), &points);
            let sign = value.partial_cmp(&0.0).expect("not NaN");
            assert_eq!(sign, exact_sign(&points, &mut tally), "{points:?}");
        }
        assert!(tally.zero > 1_000 && tally.cases - tally.zero > 1_000);
    }
}

#[test]
fn orient2d_has_the_exact_sign() {
    let value = |f: &StaticFilter, [a, b, c]: &[[f64; 2]; 3]| orient2d(f, a, b, c);
    Predicate { value, filter: StaticFilter::plane, bound: |f| f.orient }.check();
}

#[test]
fn incircle_has_the_exact_sign() {
    let value = |f: &StaticFilter, [a, b, c, d]: &[[f64; 2]; 4]| incircle(f, a, b, c, d);
    let predicate = Predicate { value, filter: StaticFilter::plane, bound: |f| f.in_sphere };
    predicate.check();
    predicate.check_fine_grids();
}

#[test]
fn orient3d_has_the_exact_sign() {
    let value = |f: &StaticFilter, [a, b, c, d]: &[[f64; 3]; 4]| orient3d(f, a, b, c, d);
    Predicate { value, filter: StaticFilter::space, bound: |f| f.orient }.check();
}

#[test]
fn insphere_has_the_exact_sign() {
    let value = |f: &StaticFilter, [a, b, c, d, e]: &[[f64; 3]; 5]| insphere(f, a, b, c, d, e);
    let predicate = Predicate { value, filter: StaticFilter::space, bound: |f| f.in_sphere };
    predicate.check();
    predicate.check_fine_grids();
}

#[test]
fn circles_seen_from_the_point_are_certain_or_open() {
    let side = |_: &StaticFilter, [a, b, c, q]: &[[f64; 2]; 4]| {
        let [u, v, w] = [a, b, c].map(|p| Lifted::new(p, q));
        side_of_seen_circle([&u, &v, &w], [u.cross(&v), v.cross(&w), w.cross(&u)])
    };
    Prepared { filter: StaticFilter::plane, side }.check();
}

#[test]
fn prepared_circles_are_certain_or_open() {
    let side = |_: &StaticFilter, [a, b, c, q]: &[[f64; 2]; 4]| <[f64; 2]>::side(&circle(a, b, c), a, q);
    Prepared { filter: StaticFilter::plane, side }.check();
}

#[test]
fn prepared_spheres_are_certain_or_open() {
    let side =
        |_: &StaticFilter, [a, b, c, d, q]: &[[f64; 3]; 5]| <[f64; 3]>::side(&sphere(a, b, c, d), a, q);
    Prepared { filter: StaticFilter::space, side }.check();
}

/// The stages after the static bound of spheres: the bound of the points themselves, that of the determinant's terms,
/// and what is left for integers.
#[test]
fn stages_after_the_static_bound_of_spheres_are_exact() {
    let mut random = Random::new(2_026);
    let wide = StaticFilter::space([-MAX_MAGNITUDE; 3], [MAX_MAGNITUDE; 3]);
    let (mut tally, mut n_certain) = (Tally::default(), 0);
    for family in FAMILIES {
        for _ in 0..130_000 {
            let points = family.points::<3, 5>(&mut random);
            let expected = exact_sign(&points, &mut tally);
            let [a, b, c, d, q] = points.each_ref();
            let side = <[f64; 3]>::side(&sphere(a, b, c, d), a, q);
            if <[f64; 3]>::is_side_certain(side, [a, b, c, d, q]) {
                assert_eq!(side.partial_cmp(&0.0), Some(expected), "{points:?}");
                n_certain += 1;
            }
            assert_eq!(insphere(&wide, a, b, c, d, q).partial_cmp(&0.0), Some(expected), "{points:?}");
        }
    }
    println!("{n_certain} certain of {}", tally.cases);
    assert!(tally.cases >= 1_000_000 && n_certain >= tally.cases / 20);
}

#[test]
fn prepared_half_spaces_are_certain_or_open() {
    let side =
        |f: &StaticFilter, [a, b, c, q]: &[[f64; 3]; 4]| <[f64; 3]>::side(&half_space(f, a, b, c), a, q);
    Prepared { filter: StaticFilter::space, side }.check();
}

// ---------------------------------------------------------------------------------------------- the others

fn check_perturbed<const D: usize, const N: usize, const M: usize>(
    is_inside: fn(&StaticFilter, &[[f64; D]; N], [u32; N]) -> bool,
    filter: fn([f64; D], [f64; D]) -> StaticFilter,
) {
    let mut random = Random::new(2_010 + N as u64);
    let (mut tally, mut n_cases) = (Tally::default(), 0);
    for family in FAMILIES.into_iter().cycle() {
        if n_cases >= 100_000 {
            break;
        }
        let mut points = family.points::<D, N>(&mut random);
        if (0..N).any(|i| points[..i].contains(&points[i])) {
            continue;
        }
        let simplex: [[f64; D]; M] = from_fn(|i| points[i]);
        match exact_sign(&simplex, &mut Tally::default()) {
            Ordering::Equal => continue,
            Ordering::Less => points.swap(0, 1),
            Ordering::Greater => {}
        }
        let mut ids: [u32; N] = from_fn(|i| 10 * i as u32);
        random.shuffle(&mut ids);
        let [lower, upper] = bounding_box(&points);
        let expected = is_inside_by_polynomial(&points, &ids, &mut tally);
        assert_eq!(is_inside(&filter(lower, upper), &points, ids), expected, "{points:?} {ids:?}");
        n_cases += 1;
    }
    println!("{D}D: {} cases, {} big, {} zero", tally.cases, tally.big, tally.zero);
    assert!(tally.zero >= 1_000 && tally.big >= 10_000);
}

#[test]
fn incircle_perturbed_is_the_sign_of_the_raised_determinant() {
    check_perturbed::<2, 4, 3>(
        |f, points, ids| incircle_perturbed(f, points.each_ref(), || ids),
        StaticFilter::plane,
    );
}

#[test]
fn insphere_perturbed_is_the_sign_of_the_raised_determinant() {
    check_perturbed::<3, 5, 4>(
        |f, points, ids| insphere_perturbed(f, points.each_ref(), || ids),
        StaticFilter::space,
    );
}

fn check_compare_distance<const D: usize>(random: &mut Random) {
    let mut tally = Tally::default();
    for family in FAMILIES {
        for _ in 0..N_CASES {
            let mut points: [[f64; D]; 3] = family.points(random);
            // Mirror images are equally far, but for rounding.
            if random.below(3) == 0 {
                let [a, _, q] = points;
                points[1] =
                    from_fn(|axis| (q[axis] + (q[axis] - a[axis])).clamp(-MAX_MAGNITUDE, MAX_MAGNITUDE));
            }
            let [a, b, q] = &points;
            let expected = exact_distance_order(&points, &mut tally);
            assert_eq!(compare_distance(q, a, b), expected, "{points:?}");
            assert_eq!(compare_distance(q, b, a), expected.reverse(), "{points:?}");
        }
    }
    println!("{D}D: {} cases, {} big, {} zero", tally.cases, tally.big, tally.zero);
    assert!(tally.cases >= 100_000 && tally.big >= 20_000 && tally.zero >= 10_000);
}

#[test]
fn compare_distance_is_exact() {
    let mut random = Random::new(17);
    check_compare_distance::<2>(&mut random);
    check_compare_distance::<3>(&mut random);
}

/// Squares next to that of the distance, and any; where that underflows the least numbers are next to it.
fn check_is_within_distance<const D: usize>(random: &mut Random) {
    let (mut tally, mut n_within) = (Tally::default(), 0);
    for family in FAMILIES {
        for _ in 0..N_CASES {
            let mut points: [[f64; D]; 2] = family.points(random);
            // Squares of powers of two are numbers: these apart along an axis, distances tie.
            let apart = power_of_two(random.below(727) as i32 - 537);
            let is_apart = random.below(4) == 0;
            if is_apart {
                let axis = random.below(D);
                points[0][axis] = 0.0;
                points[1] = points[0];
                points[1][axis] = apart * random.sign();
            }
            let [a, q] = &points;
            let near = squared_distance(a, q);
            let squared = match random.below(7) {
                _ if is_apart => apart * apart,
                0 => magnitude(random),
                1 => LEAST * random.below(3) as f64,
                2 => [f64::MAX, f64::INFINITY, MAX_MAGNITUDE * MAX_MAGNITUDE][random.below(3)],
                _ => near + random.below(3) as f64 * LEAST,
            };
            for squared in [squared, squared.next_up(), squared.next_down().max(0.0)] {
                let expected = exact_order_to_square(&points, squared, &mut tally) != Ordering::Greater;
                assert_eq!(is_within_distance(q, a, squared), expected, "{points:?} {squared:e}");
                assert_eq!(is_within_distance(a, q, squared), expected, "{points:?} {squared:e}");
                n_within += usize::from(expected);
            }
        }
    }
    println!("{D}D: {} cases, {n_within} within, {} ties", tally.cases, tally.zero);
    assert!(tally.cases >= 300_000 && tally.zero >= 30_000);
    assert!(n_within >= 50_000 && tally.cases - n_within >= 50_000);
}

#[test]
fn is_within_distance_is_exact() {
    let mut random = Random::new(18);
    check_is_within_distance::<2>(&mut random);
    check_is_within_distance::<3>(&mut random);
}

#[test]
fn is_collinear3_is_exact() {
    let mut random = Random::new(19);
    let mut tally = Tally::default();
    for family in FAMILIES {
        for _ in 0..N_CASES {
            let mut points: [[f64; 3]; 3] = family.points(&mut random);
            if random.below(2) == 0 {
                let [a, b, _] = points;
                points[2] =
                    from_fn(|axis| (b[axis] + (b[axis] - a[axis])).clamp(-MAX_MAGNITUDE, MAX_MAGNITUDE));
            }
            let [a, b, c] = &points;
            let expected = is_exactly_collinear(&points, &mut tally);
            assert_eq!(is_collinear3(a, b, c), expected, "{points:?}");
        }
    }
    println!("{} cases, {} big, {} collinear", tally.cases, tally.big, tally.zero);
    assert!(tally.cases >= 100_000 && tally.big >= 20_000 && tally.zero >= 10_000);
}

#[test]
fn range() {
    let inside = [0.0, LEAST, f64::MIN_POSITIVE.next_down(), f64::MIN_POSITIVE, 1.15e-64, 1.0, MAX_MAGNITUDE];
    for x in inside {
        assert!(is_in_range(x) && is_in_range(-x), "{x}");
    }
    for x in [MAX_MAGNITUDE.next_up(), f64::MAX, f64::INFINITY, f64::NAN] {
        assert!(!is_in_range(x) && !is_in_range(-x), "{x}");
    }
}

/// Determinants whose products all round to zero, or to each other.
#[test]
fn products_that_vanish() {
    let f = StaticFilter::plane([0.0; 2], [1.0; 2]);
    let tiny = 3.0 * LEAST;
    assert!(orient2d(&f, &[0.0; 2], &[LEAST, 0.0], &[0.0, LEAST]) > 0.0);
    assert!(orient2d(&f, &[0.0; 2], &[0.0, LEAST], &[LEAST, 0.0]) < 0.0);
    assert!(orient2d(&f, &[0.0; 2], &[tiny, LEAST], &[1.0, 0.3]) < 0.0);
    assert!(orient2d(&f, &[0.0; 2], &[tiny, LEAST], &[tiny, LEAST]) == 0.0);
    assert!(incircle(&f, &[0.0; 2], &[LEAST, 0.0], &[0.0, LEAST], &[LEAST, LEAST]) == 0.0);
    assert!(incircle(&f, &[0.0; 2], &[LEAST, 0.0], &[0.0, LEAST], &[tiny, tiny]) < 0.0);
    assert!(incircle(&f, &[0.0; 2], &[1.0, 0.0], &[0.0, 1.0], &[1.0, LEAST]) > 0.0);
    assert!(incircle(&f, &[0.0; 2], &[1.0, 0.0], &[0.0, 1.0], &[1.0, -LEAST]) < 0.0);

    let f = StaticFilter::space([0.0; 3], [1.0; 3]);
    let [x, y, z] = [[LEAST, 0.0, 0.0], [0.0, LEAST, 0.0], [0.0, 0.0, LEAST]];
    assert!(orient3d(&f, &[0.0; 3], &x, &y, &z) > 0.0);
    assert!(orient3d(&f, &[0.0; 3], &[1.0, 0.0, 0.0], &[0.0, 1.0, 0.0], &[0.3, 0.3, -LEAST]) < 0.0);
    assert!(insphere(&f, &[0.0; 3], &x, &y, &z, &[LEAST; 3]) == 0.0);
    assert!(insphere(&f, &[0.0; 3], &x, &y, &z, &[LEAST, LEAST, 0.0]) == 0.0);
    assert!(insphere(&f, &[0.0; 3], &x, &y, &z, &[LEAST, LEAST, -LEAST]) < 0.0);

    assert_eq!(compare_distance(&[0.0; 2], &[LEAST, 0.0], &[0.0, tiny]), Ordering::Less);
    assert!(is_within_distance(&[0.0; 2], &[LEAST, 0.0], LEAST));
    assert!(!is_within_distance(&[0.0; 2], &[LEAST, 0.0], 0.0));
    assert!(is_within_distance(&[LEAST, tiny], &[LEAST, tiny], 0.0));
    assert!(!is_collinear3(&[0.0; 3], &x, &y));
    assert!(is_collinear3(&[0.0; 3], &x, &[1.0, 0.0, 0.0]));
}
