//! The predicates against determinants of integers, for coordinates of which no product underflows.

use crate::exact_oracle::*;
use deldrift::internals::predicates::*;
use num_bigint::BigInt;
use std::array::from_fn;
use std::cmp::Ordering;

// ---------------------------------------------------------------------------------------------- generator

/// Expansions of the highest degree have room for coordinates from this on.
const MIN_MAGNITUDE: f64 = 1e-42;

/// What remains in range, of what a family generates near its ends.
fn in_range(x: f64) -> f64 {
    match x.abs() {
        m if m < MIN_MAGNITUDE => 0.0,
        m if m > MAX_MAGNITUDE => MAX_MAGNITUDE.copysign(x),
        _ => x,
    }
}

#[derive(Clone, Copy, Debug)]
enum Family {
    Uniform,
    /// Small integers, so degenerate often; scaled by powers of two.
    Lattice,
    /// The same, translated far away.
    DistantLattice,
    /// Small integers on a common line or plane, translated and scaled.
    LatticeFlat,
    /// Near the corners of a cube, where differences are as large as the extents.
    Corners,
    /// On a common line or plane, up to a few ulps.
    Flat,
    /// On a common circle or sphere, up to a few ulps.
    Sphere,
    /// Exactly on a common circle or sphere, translated and scaled; one coordinate in some cases is an ulp
    /// off.
    ExactSphere,
    /// Coordinates from both ends of the range, and anywhere between.
    Extreme,
    /// All coordinates within a few ulps of one magnitude: differences of lsb level.
    LeastBits,
    /// Flat and sphere at either end of the range.
    ExtremeDegenerate,
}

use Family::*;

impl Family {
    fn points<const D: usize, const N: usize>(self, random: &mut Random) -> [[f64; D]; N] {
        let mut points = match self {
            Uniform => from_fn(|_| from_fn(|_| random.unit())),
            Lattice => lattice(random, 0),
            DistantLattice => lattice(random, 1 << 45),
            LatticeFlat => lattice_flat(random),
            Corners => from_fn(|_| from_fn(|_| random.sign() * (1.0 - 1e-3 * random.unit().abs()))),
            Flat => flat(random),
            Sphere => sphere(random),
            ExactSphere => exact_sphere(random),
            Extreme => from_fn(|_| from_fn(|_| extreme(random))),
            LeastBits => least_bits(random),
            ExtremeDegenerate => {
                let points: [[f64; D]; N] = if random.below(2) == 0 { flat(random) } else { sphere(random) };
                let scale = if random.below(2) == 0 { MIN_MAGNITUDE * 1e3 } else { MAX_MAGNITUDE / 4.0 };
                points.map(|p| p.map(|x| x * scale))
            }
        };
        let mut axes: [usize; D] = from_fn(|axis| axis);
        random.shuffle(&mut axes);
        random.shuffle(&mut points);
        points.map(|p| from_fn(|axis| in_range(p[axes[axis]])))
    }
}

fn lattice<const D: usize, const N: usize>(random: &mut Random, offset: i64) -> [[f64; D]; N] {
    let size = [1, 2, 5, 100, 10_000][random.below(5)];
    let scale = 2f64.powi(random.integer(90) as i32);
    let offset: [i64; D] = from_fn(|_| random.integer(offset));
    from_fn(|_| from_fn(|axis| (offset[axis] + random.integer(size)) as f64 * scale))
}

fn lattice_flat<const D: usize, const N: usize>(random: &mut Random) -> [[f64; D]; N] {
    let size = [3, 100, 100_000][random.below(3)];
    let scale = 2f64.powi(random.integer(90) as i32);
    let origin: [i64; D] = from_fn(|_| random.integer(1 << 40));
    let directions: [[i64; D]; D] = from_fn(|_| from_fn(|_| random.integer(size)));
    let dimension = 1 + random.below(D - 1);
    from_fn(|_| {
        let mut p = origin;
        for direction in &directions[..dimension] {
            let t = random.integer(size);
            p = from_fn(|axis| p[axis] + t * direction[axis]);
        }
        p.map(|x| x as f64 * scale)
    })
}

fn flat<const D: usize, const N: usize>(random: &mut Random) -> [[f64; D]; N] {
    let origin: [f64; D] = from_fn(|_| random.unit());
    let directions: [[f64; D]; D] = from_fn(|_| from_fn(|_| random.unit()));
    let dimension = 1 + random.below(D - 1);
    let ulps = [0, 1, 3][random.below(3)];
    from_fn(|_| {
        let mut p = origin;
        for direction in &directions[..dimension] {
            let t = random.unit();
            p = from_fn(|axis| p[axis] + t * direction[axis]);
        }
        p.map(|x| nudged(x, random.integer(ulps)))
    })
}

fn sphere<const D: usize, const N: usize>(random: &mut Random) -> [[f64; D]; N] {
    let centre: [f64; D] = if random.below(2) == 0 { [0.0; D] } else { from_fn(|_| random.unit()) };
    let radius = [1.0, 1e-3, 0.5, random.unit()][random.below(4)];
    let ulps = [0, 1, 3][random.below(3)];
    from_fn(|_| {
        let direction: [f64; D] = from_fn(|_| random.unit());
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        from_fn(|axis| nudged(centre[axis] + radius * (direction[axis] / length), random.integer(ulps)))
    })
}

fn exact_sphere<const D: usize, const N: usize>(random: &mut Random) -> [[f64; D]; N] {
    let offset = [0, 100, 1 << 40][random.below(3)];
    let offset: [i64; D] = from_fn(|_| random.integer(offset));
    let scale = 2f64.powi(random.integer(90) as i32);
    let integers: [[i64; D]; N] = integers_on_sphere(random);
    let mut points = integers.map(|p| from_fn(|axis| (p[axis] + offset[axis]) as f64 * scale));
    if random.below(4) == 0 {
        let x: &mut f64 = &mut points[random.below(N)][random.below(D)];
        *x = nudged(*x, random.sign() as i64);
    }
    points
}

/// Around the origin, of length 65 in the plane and 13 in space.
fn integers_on_sphere<const D: usize, const N: usize>(random: &mut Random) -> [[i64; D]; N] {
    let plane = [[0, 65, 0], [16, 63, 0], [25, 60, 0], [33, 56, 0], [39, 52, 0]];
    let space = [[3, 4, 12], [0, 5, 12], [0, 0, 13], [12, 4, 3], [4, 12, 3]];
    from_fn(|_| {
        let choice = [plane, space][D - 2][random.below(5)];
        let mut p = from_fn(|axis| if random.below(2) == 0 { choice[axis] } else { -choice[axis] });
        random.shuffle(&mut p);
        p
    })
}

fn extreme(random: &mut Random) -> f64 {
    let near = random.below(4) as i64;
    let magnitude = match random.below(6) {
        0 => 0.0,
        1 => nudged(MIN_MAGNITUDE, near),
        2 => nudged(MAX_MAGNITUDE, -near),
        3 => MIN_MAGNITUDE * (1.0 + 8.0 * random.unit().abs()),
        4 => MAX_MAGNITUDE * random.unit().abs(),
        _ => 10f64.powf(-42.0 + 99.0 * random.unit().abs()),
    };
    magnitude * random.sign()
}

fn least_bits<const D: usize, const N: usize>(random: &mut Random) -> [[f64; D]; N] {
    let base = match random.below(3) {
        0 => nudged(MIN_MAGNITUDE, 20),
        1 => nudged(MAX_MAGNITUDE, -20),
        _ => 10f64.powf(-41.0 + 97.0 * random.unit().abs()),
    };
    let mixed_signs = random.below(2) == 0;
    let spread = [1, 3, 15][random.below(3)];
    from_fn(|_| {
        from_fn(|_| nudged(base, random.integer(spread)) * if mixed_signs { random.sign() } else { 1.0 })
    })
}

// ---------------------------------------------------------------------------------------------- signs

/// A determinant predicate: `N` points in dimension `D`.
struct Predicate<const D: usize, const N: usize> {
    value: fn(&StaticFilter, &[[f64; D]; N]) -> f64,
    filter: fn([f64; D], [f64; D]) -> StaticFilter,
    bound: fn(&StaticFilter) -> f64,
}

const ORIENT_2D: Predicate<2, 3> = Predicate {
    value: |f, [a, b, c]| orient2d(f, a, b, c),
    filter: StaticFilter::plane,
    bound: |f| f.orient,
};
const IN_CIRCLE: Predicate<2, 4> = Predicate {
    value: |f, [a, b, c, d]| incircle(f, a, b, c, d),
    filter: StaticFilter::plane,
    bound: |f| f.in_sphere,
};
const ORIENT_3D: Predicate<3, 4> = Predicate {
    value: |f, [a, b, c, d]| orient3d(f, a, b, c, d),
    filter: StaticFilter::space,
    bound: |f| f.orient,
};
const IN_SPHERE: Predicate<3, 5> = Predicate {
    value: |f, [a, b, c, d, e]| insphere(f, a, b, c, d, e),
    filter: StaticFilter::space,
    bound: |f| f.in_sphere,
};

impl<const D: usize, const N: usize> Predicate<D, N> {
    fn sign(&self, f: &StaticFilter, points: &[[f64; D]; N]) -> Ordering {
        (self.value)(f, points).partial_cmp(&0.0).expect("not NaN")
    }

    fn tight_filter(&self, points: &[[f64; D]; N]) -> StaticFilter {
        let [lower, upper] = bounding_box(points);
        (self.filter)(lower, upper)
    }

    /// The tightest filter, one that holds for all coordinates (and so proves nothing here), and a swap.
    fn check(&self, points: [[f64; D]; N], random: &mut Random, tally: &mut Tally) {
        assert!(points.iter().flatten().all(|&x| is_in_range(x)), "{points:?}");
        let expected = exact_sign(&points, tally);
        let tight = self.tight_filter(&points);
        assert_eq!(self.sign(&tight, &points), expected, "{points:?}");
        let wide = (self.filter)([-MAX_MAGNITUDE; D], [MAX_MAGNITUDE; D]);
        assert_eq!(self.sign(&wide, &points), expected, "{points:?}, without static filter");
        let mut swapped = points;
        let i = random.below(N);
        swapped.swap(i, (i + 1 + random.below(N - 1)) % N);
        assert_eq!(self.sign(&tight, &swapped), expected.reverse(), "{swapped:?}, swapped");
    }

    fn check_families(&self, families: &[(Family, usize)]) {
        let mut random = Random::new(2_010 + N as u64);
        let mut total = Tally::default();
        for &(family, n_cases) in families {
            let mut tally = Tally::default();
            for _ in 0..n_cases {
                self.check(family.points(&mut random), &mut random, &mut tally);
            }
            println!(
                "{D}D, {N} points, {family:?}: {} cases, {} big, {} zero",
                tally.cases, tally.big, tally.zero
            );
            total.add(&tally);
        }
        assert!(total.cases >= 1_000_000 && total.big >= 100_000 && total.zero >= 100_000);
    }

    fn error_ratio(&self, points: &[[f64; D]; N]) -> f64 {
        let everything = StaticFilter {
            orient: -1.0,
            in_sphere: -1.0,
            prepared: 0.0,
            largest_square: 0.0,
            is_exact: false,
        };
        error_ratio(points, (self.value)(&everything, points), (self.bound)(&self.tight_filter(points)))
    }

    /// Errors of any points, and the largest to be found by climbing from points in a cube's corners.
    fn check_bound(&self) {
        let mut random = Random::new(6_750 + N as u64);
        let mut largest = 0f64;
        for family in [Uniform, Corners, Flat, Sphere, LeastBits, Extreme, ExtremeDegenerate] {
            for _ in 0..10_000 {
                largest = largest.max(self.error_ratio(&family.points(&mut random)));
            }
        }
        let mut climbed = 0f64;
        for _ in 0..100 {
            let mut points = Corners.points(&mut random);
            let mut height = 0.0;
            for _ in 0..2_000 {
                let mut changed = points;
                let x: &mut f64 = &mut changed[random.below(N)][random.below(D)];
                let reach = 1 << random.below(50);
                *x = if random.below(3) == 0 { random.unit() } else { nudged(*x, random.integer(reach)) };
                *x = x.clamp(-1.0, 1.0);
                let ratio = self.error_ratio(&changed);
                if ratio >= height {
                    (points, height) = (changed, ratio);
                }
            }
            climbed = climbed.max(height);
        }
        println!("{D}D, {N} points: at most {largest:.3} of the bound, {climbed:.3} by climbing");
    }
}

#[test]
fn orient2d_has_the_exact_sign() {
    ORIENT_2D.check_families(&[
        (Uniform, 100_000),
        (Lattice, 400_000),
        (DistantLattice, 300_000),
        (LatticeFlat, 300_000),
        (Corners, 50_000),
        (Flat, 300_000),
        (ExactSphere, 100_000),
        (Extreme, 200_000),
        (LeastBits, 300_000),
        (ExtremeDegenerate, 200_000),
    ]);
}

#[test]
fn incircle_has_the_exact_sign() {
    IN_CIRCLE.check_families(&[
        (Uniform, 60_000),
        (Lattice, 400_000),
        (DistantLattice, 300_000),
        (LatticeFlat, 100_000),
        (Corners, 50_000),
        (Flat, 50_000),
        (Sphere, 200_000),
        (ExactSphere, 400_000),
        (Extreme, 100_000),
        (LeastBits, 200_000),
        (ExtremeDegenerate, 100_000),
    ]);
}

#[test]
fn orient3d_has_the_exact_sign() {
    ORIENT_3D.check_families(&[
        (Uniform, 60_000),
        (Lattice, 400_000),
        (DistantLattice, 300_000),
        (LatticeFlat, 300_000),
        (Corners, 50_000),
        (Flat, 200_000),
        (ExactSphere, 200_000),
        (Extreme, 100_000),
        (LeastBits, 300_000),
        (ExtremeDegenerate, 100_000),
    ]);
}

#[test]
fn insphere_has_the_exact_sign() {
    IN_SPHERE.check_families(&[
        (Uniform, 50_000),
        (Lattice, 400_000),
        (DistantLattice, 300_000),
        (LatticeFlat, 100_000),
        (Corners, 50_000),
        (Flat, 40_000),
        (Sphere, 100_000),
        (ExactSphere, 400_000),
        (Extreme, 50_000),
        (LeastBits, 200_000),
        (ExtremeDegenerate, 50_000),
    ]);
}

#[test]
fn orient2d_keeps_its_error_bound() {
    ORIENT_2D.check_bound();
}

#[test]
fn incircle_keeps_its_error_bound() {
    IN_CIRCLE.check_bound();
}

#[test]
fn orient3d_keeps_its_error_bound() {
    ORIENT_3D.check_bound();
}

#[test]
fn insphere_keeps_its_error_bound() {
    IN_SPHERE.check_bound();
}

#[test]
fn conventions() {
    let f = StaticFilter::plane([0.0; 2], [4.0; 2]);
    let (a, b, c) = ([0.0, 0.0], [4.0, 0.0], [0.0, 4.0]);
    assert_eq!(orient2d(&f, &a, &b, &c), 16.0, "counter-clockwise");
    assert!(incircle(&f, &a, &b, &c, &[1.0, 1.0]) > 0.0, "inside");
    assert!(incircle(&f, &a, &b, &c, &[4.0, 4.0]) == 0.0, "on the circle");

    let f = StaticFilter::space([0.0; 3], [4.0; 3]);
    let (a, b, c, d) = ([0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]);
    assert_eq!(orient3d(&f, &a, &b, &c, &d), 64.0, "right-handed");
    assert!(insphere(&f, &a, &b, &c, &d, &[1.0; 3]) > 0.0, "inside");
    assert!(insphere(&f, &a, &b, &c, &d, &[4.0; 3]) == 0.0, "on the sphere");
    assert!(insphere(&f, &a, &b, &c, &d, &[4.0, 4.0, 4.0f64.next_down()]) > 0.0, "inside by an ulp");
}

// ---------------------------------------------------------------------------------------------- perturbation

/// The sign of the in-sphere determinant whose lifts are raised by numbers: ε of the k-th highest id is
/// 2^(-128 k).
fn is_inside_by_numbers<const D: usize, const N: usize>(points: &[[i64; D]; N], ids: &[u32; N]) -> bool {
    let raised = |i: usize| {
        let rank = 1 + ids.iter().filter(|&&id| id > ids[i]).count();
        let square: BigInt = points[i].iter().map(|&x| BigInt::from(x) * x).sum();
        (square << (128 * N)) + (BigInt::from(1) << (128 * (N - rank)))
    };
    let last = N - 1;
    let row = |i: usize| {
        let mut row: Vec<BigInt> =
            (0..D).map(|axis| BigInt::from(points[i][axis] - points[last][axis])).collect();
        row.push(raised(i) - raised(last));
        row
    };
    let rows: Vec<Vec<BigInt>> = (0..last).map(row).collect();
    determinant(&rows).compare_zero() == if D == 3 { Ordering::Less } else { Ordering::Greater }
}

/// A perturbed in-sphere test and the orientation it presumes.
struct Perturbed<const D: usize, const N: usize> {
    is_inside: fn(&StaticFilter, &[[f64; D]; N], [u32; N]) -> bool,
    orientation: fn(&StaticFilter, &[[f64; D]; N]) -> f64,
    filter: fn([f64; D], [f64; D]) -> StaticFilter,
}

const IN_CIRCLE_PERTURBED: Perturbed<2, 4> = Perturbed {
    is_inside: |f, points, ids| incircle_perturbed(f, points.each_ref(), || ids),
    orientation: |f, [a, b, c, _]| orient2d(f, a, b, c),
    filter: StaticFilter::plane,
};
const IN_SPHERE_PERTURBED: Perturbed<3, 5> = Perturbed {
    is_inside: |f, points, ids| insphere_perturbed(f, points.each_ref(), || ids),
    orientation: |f, [a, b, c, d, _]| orient3d(f, a, b, c, d),
    filter: StaticFilter::space,
};

impl<const D: usize, const N: usize> Perturbed<D, N> {
    /// Distinct lattice points on a sphere or anywhere, the first ones in positive orientation.
    fn points(&self, f: &StaticFilter, random: &mut Random) -> Option<[[i64; D]; N]> {
        let offset: [i64; D] = from_fn(|_| random.integer(1_000));
        let mut points: [[i64; D]; N] = if random.below(2) == 0 {
            let size = [1, 2, 4][random.below(3)];
            from_fn(|_| from_fn(|_| random.integer(size)))
        } else {
            integers_on_sphere(random)
        };
        points = points.map(|p| from_fn(|axis| p[axis] + offset[axis]));
        if (0..N).any(|i| points[..i].contains(&points[i])) {
            return None;
        }
        match (self.orientation)(f, &points.map(|p| p.map(|x| x as f64))) {
            0.0 => return None,
            orientation if orientation < 0.0 => points.swap(0, 1),
            _ => {}
        }
        Some(points)
    }

    fn check(&self, n_cases: usize, every_nth_by_numbers: usize) {
        let f = (self.filter)([-1e6; D], [1e6; D]);
        let mut random = Random::new(20_100_910 + N as u64);
        let (mut tally, mut cases, mut by_numbers) = (Tally::default(), 0, 0);
        while cases < n_cases {
            let Some(integers) = self.points(&f, &mut random) else { continue };
            let mut ids: [u32; N] = from_fn(|i| (i * i) as u32 * 1_000);
            random.shuffle(&mut ids);
            let points = integers.map(|p| p.map(|x| x as f64));
            let is_inside = (self.is_inside)(&f, &points, ids);
            assert_eq!(is_inside, is_inside_by_polynomial(&points, &ids, &mut tally), "{integers:?} {ids:?}");
            if cases % every_nth_by_numbers == 0 {
                assert_eq!(is_inside, is_inside_by_numbers(&integers, &ids), "{integers:?} {ids:?}");
                by_numbers += 1;
            }
            self.check_symmetries(&f, points, ids, is_inside);
            cases += 1;
        }
        assert!(by_numbers >= 100_000);
    }

    fn check_symmetries(&self, f: &StaticFilter, points: [[f64; D]; N], ids: [u32; N], is_inside: bool) {
        // An even permutation of the simplex.
        let (mut turned, mut turned_ids) = (points, ids);
        turned[..3].rotate_left(1);
        turned_ids[..3].rotate_left(1);
        assert_eq!((self.is_inside)(f, &turned, turned_ids), is_inside, "{points:?} {ids:?}, turned");
        // Exchanging the query point with a vertex negates the determinant; so does exchanging two vertices,
        // which is done where the simplex would be negative.
        let (mut exchanged, mut exchanged_ids) = (points, ids);
        exchanged.swap(0, N - 1);
        exchanged_ids.swap(0, N - 1);
        let orientation = (self.orientation)(f, &exchanged);
        if orientation != 0.0 {
            if orientation < 0.0 {
                exchanged.swap(1, 2);
                exchanged_ids.swap(1, 2);
            }
            let expected = if orientation < 0.0 { is_inside } else { !is_inside };
            let found = (self.is_inside)(f, &exchanged, exchanged_ids);
            assert_eq!(found, expected, "{points:?} {ids:?}, exchanged");
        }
    }
}

#[test]
fn incircle_perturbed_is_the_sign_of_the_raised_determinant() {
    IN_CIRCLE_PERTURBED.check(1_000_000, 10);
}

#[test]
fn insphere_perturbed_is_the_sign_of_the_raised_determinant() {
    IN_SPHERE_PERTURBED.check(1_000_000, 10);
}

/// The triangles without a point inside are a triangulation: they cover the square once, whatever the ids.
#[test]
fn perturbed_circles_triangulate_a_grid() {
    let points: Vec<[f64; 2]> = (0..25).map(|i| [f64::from(i % 5), f64::from(i / 5)]).collect();
    let f = StaticFilter::plane([0.0; 2], [4.0; 2]);
    let mut random = Random::new(5);
    let mut ids: Vec<u32> = (0..25).collect();
    for _ in 0..20 {
        random.shuffle(&mut ids);
        let (mut n_triangles, mut area) = (0, 0.0);
        for (i, j, k) in (0..25).flat_map(|i| (0..i).flat_map(move |j| (0..j).map(move |k| (i, j, k)))) {
            let orientation = orient2d(&f, &points[i], &points[j], &points[k]);
            let (j, k) = if orientation < 0.0 { (k, j) } else { (j, k) };
            let is_empty = |l: usize| {
                let positions = [i, j, k, l].map(|v| &points[v]);
                [i, j, k].contains(&l) || !incircle_perturbed(&f, positions, || [i, j, k, l].map(|v| ids[v]))
            };
            if orientation != 0.0 && (0..25).all(is_empty) {
                n_triangles += 1;
                area += orientation.abs();
            }
        }
        assert_eq!((n_triangles, area), (32, 32.0));
    }
}

/// The same in space, where the number of tetrahedra depends on the ids.
#[test]
fn perturbed_spheres_triangulate_a_grid() {
    let points: Vec<[f64; 3]> =
        (0..27).map(|i| [f64::from(i % 3), f64::from(i / 3 % 3), f64::from(i / 9)]).collect();
    let f = StaticFilter::space([0.0; 3], [2.0; 3]);
    let mut random = Random::new(7);
    let mut ids: Vec<u32> = (0..27).collect();
    let quadruples = || {
        (0..27usize).flat_map(|i| {
            (0..i).flat_map(move |j| (0..j).flat_map(move |k| (0..k).map(move |l| [i, j, k, l])))
        })
    };
    for _ in 0..20 {
        random.shuffle(&mut ids);
        let mut volume = 0.0;
        for [i, j, k, l] in quadruples() {
            let orientation = orient3d(&f, &points[i], &points[j], &points[k], &points[l]);
            let (k, l) = if orientation < 0.0 { (l, k) } else { (k, l) };
            let is_empty = |m: usize| {
                let positions = [i, j, k, l, m].map(|v| &points[v]);
                [i, j, k, l].contains(&m)
                    || !insphere_perturbed(&f, positions, || [i, j, k, l, m].map(|v| ids[v]))
            };
            if orientation != 0.0 && (0..27).all(is_empty) {
                volume += orientation.abs();
            }
        }
        assert_eq!(volume, 48.0);
    }
}

// ---------------------------------------------------------------------------------------------- distances

fn check_compare_distance<const D: usize>(family: Family, n_cases: usize, random: &mut Random) -> Tally {
    let mut tally = Tally::default();
    for _ in 0..n_cases {
        let points: [[f64; D]; 3] = family.points(random);
        let [a, b, q] = &points;
        let expected = exact_distance_order(&points, &mut tally);
        assert_eq!(compare_distance(q, a, b), expected, "{points:?}");
        assert_eq!(compare_distance(q, b, a), expected.reverse(), "{points:?}");
    }
    tally
}

#[test]
fn compare_distance_is_exact() {
    let families = [
        (Uniform, 50_000),
        (Lattice, 100_000),
        (DistantLattice, 100_000),
        (Sphere, 100_000),
        (ExactSphere, 100_000),
        (Extreme, 100_000),
        (LeastBits, 100_000),
        (ExtremeDegenerate, 50_000),
    ];
    let mut random = Random::new(11);
    let mut total = Tally::default();
    for (family, n_cases) in families {
        for tally in [
            check_compare_distance::<2>(family, n_cases, &mut random),
            check_compare_distance::<3>(family, n_cases, &mut random),
        ] {
            total.add(&tally);
        }
    }
    println!("{} cases, {} big, {} zero", total.cases, total.big, total.zero);
    assert!(total.cases >= 1_000_000 && total.big >= 100_000 && total.zero >= 40_000);
}

/// Squares next to that of the distance, and far from it.
fn check_is_within_distance<const D: usize>(family: Family, n_cases: usize, random: &mut Random) -> Tally {
    let mut tally = Tally::default();
    for _ in 0..n_cases {
        let points: [[f64; D]; 2] = family.points(random);
        let [a, q] = &points;
        let near = squared_distance(a, q);
        let squared = match random.below(8) {
            0 => 0.0,
            1 => near * random.unit().abs() * 2.0,
            _ => nudged(near, random.integer(3)),
        };
        let expected = exact_order_to_square(&points, squared, &mut tally) != Ordering::Greater;
        assert_eq!(is_within_distance(q, a, squared), expected, "{points:?} {squared:e}");
        assert_eq!(is_within_distance(a, q, squared), expected, "{points:?} {squared:e}");
    }
    tally
}

#[test]
fn is_within_distance_is_exact() {
    let families = [
        (Uniform, 50_000),
        (Lattice, 100_000),
        (DistantLattice, 100_000),
        (Sphere, 50_000),
        (ExactSphere, 50_000),
        (Extreme, 50_000),
        (LeastBits, 50_000),
        (ExtremeDegenerate, 50_000),
    ];
    let mut random = Random::new(12);
    let mut total = Tally::default();
    for (family, n_cases) in families {
        total.add(&check_is_within_distance::<2>(family, n_cases, &mut random));
        total.add(&check_is_within_distance::<3>(family, n_cases, &mut random));
    }
    println!("{} cases, {} ties", total.cases, total.zero);
    assert!(total.cases >= 1_000_000 && total.zero >= 40_000);
}

#[test]
fn is_collinear3_is_exact() {
    let families = [
        (Uniform, 50_000),
        (Lattice, 350_000),
        (DistantLattice, 200_000),
        (LatticeFlat, 100_000),
        (Flat, 150_000),
        (Extreme, 150_000),
        (LeastBits, 150_000),
        (ExtremeDegenerate, 50_000),
    ];
    let mut random = Random::new(13);
    let mut total = Tally::default();
    for (family, n_cases) in families {
        for _ in 0..n_cases {
            let mut points: [[f64; 3]; 3] = family.points(&mut random);
            // Random points are seldom collinear: make a good half of them so, but for rounding.
            if random.below(2) == 0 {
                let [a, b, _] = points;
                points[2] = from_fn(|axis| in_range(b[axis] + (b[axis] - a[axis])));
            }
            let is_collinear = is_exactly_collinear(&points, &mut total);
            let [a, b, c] = &points;
            assert_eq!(is_collinear3(a, b, c), is_collinear, "{points:?}");
        }
    }
    println!("{} cases, {} big, {} collinear", total.cases, total.big, total.zero);
    assert!(total.cases >= 1_000_000 && total.big >= 100_000 && total.zero >= 100_000);
}
