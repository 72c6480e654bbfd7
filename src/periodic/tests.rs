//! Beside copies: a part of the repeating set that is large enough is triangulated as a whole.

use super::*;
use crate::delaunay::{Plane, Space};
use crate::random::Rng;
use std::collections::BTreeSet;

type Class = Vec<(u32, [i64; 3])>;

/// A class of cells: the corners in order, relative to the first.
fn class(mut corners: Vec<(u32, [i64; 3])>, place: &dyn Fn(u32, [i64; 3]) -> Vec<f64>) -> Class {
    corners
        .sort_by(|a, b| a.0.cmp(&b.0).then_with(|| place(a.0, a.1).partial_cmp(&place(b.0, b.1)).unwrap()));
    let first = corners[0].1;
    corners.iter().map(|&(v, s)| (v, [0, 1, 2].map(|j| s[j] - first[j]))).collect()
}

fn place<G: Dimension>(points: &[G::Point], basis: &[G::Point], v: u32, s: [i64; 3]) -> G::Point {
    let mut p = points[v as usize];
    for (j, b) in basis.iter().enumerate() {
        for axis in 0..G::D {
            p[axis] += s[j] as f64 * b[axis];
        }
    }
    p
}

/// All classes at vertices that are not translated, of copies from -n to n.
fn by_copies<G: Dimension>(points: &[G::Point], basis: &[G::Point], n: i64) -> BTreeSet<Class> {
    let at = |v: u32, s: [i64; 3]| place::<G>(points, basis, v, s).as_ref().to_vec();
    let mut all = Vec::new();
    let mut places = Vec::new();
    let range = |j: usize| if j < basis.len() { -n..=n } else { 0..=0 };
    for x in range(0) {
        for y in range(1) {
            for z in range(2) {
                for v in 0..points.len() as u32 {
                    all.push((v, [x, y, z]));
                    places.push(place::<G>(points, basis, v, [x, y, z]));
                }
            }
        }
    }
    let keys: Vec<u64> = all.iter().map(|&(v, _)| v.into()).collect();
    let t = MovingTriangulation::<G>::with_keys(&places, &keys, Options::default()).unwrap();
    let mut classes = BTreeSet::new();
    for row in t.cells().unwrap().corners {
        let corners: Vec<_> = row.as_ref().iter().map(|&v| all[v.index()]).collect();
        if corners.iter().any(|&(_, s)| s == [0; 3]) {
            classes.insert(class(corners, &at));
        }
    }
    classes
}

fn classes<G: Dimension>(
    t: &PeriodicTriangulation<G>,
    points: &[G::Point],
    basis: &[G::Point],
) -> BTreeSet<Class> {
    let at = |v: u32, s: [i64; 3]| place::<G>(points, basis, v, s).as_ref().to_vec();
    let mut set = BTreeSet::new();
    for (c, row) in t.corners().iter().enumerate() {
        let corners = row.as_ref().iter().enumerate().map(|(i, v)| (v.get(), t.shifts(c, i))).collect();
        assert!(set.insert(class(corners, &at)), "a class comes once");
    }
    set
}

fn random_points<G: Dimension>(rng: &mut Rng, n: usize, basis: &[G::Point]) -> Vec<G::Point> {
    let grid = (1u64 << 20) as f64;
    (0..n)
        .map(|_| {
            let mut p = G::Point::default();
            for axis in 0..G::D {
                p[axis] = (rng.below(1 << 20) as f64) / grid;
            }
            let mut q = G::Point::default();
            for j in 0..G::D {
                for axis in 0..G::D {
                    q[axis] += p[j] * basis.get(j).map_or(f64::from(u8::from(axis == j)), |b| b[axis]);
                }
            }
            for axis in 0..G::D {
                q[axis] = (q[axis] * grid).round() / grid;
            }
            q
        })
        .collect()
}

fn check<G: Dimension>(seed: u64, basis: &[G::Point], n: usize) {
    let rng = &mut Rng::new(seed);
    let mut points = random_points::<G>(rng, n, basis);
    let mut t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
    let copies = 3;
    assert_eq!(
        classes(&t, &points, basis),
        by_copies::<G>(&points, basis, copies),
        "seed {seed}, {n}, {basis:?}"
    );
    for _ in 0..3 {
        for p in &mut points {
            for axis in 0..G::D {
                p[axis] += (rng.below(1 << 18) as f64 - (1 << 17) as f64) / (1u64 << 20) as f64;
            }
        }
        t.commit(&points).unwrap();
        let expected = by_copies::<G>(&points, basis, copies + 1);
        assert_eq!(classes(&t, &points, basis), expected, "seed {seed}, {n}, {basis:?}, {points:?}");
    }
}

#[test]
fn cells_are_those_of_copies() {
    for seed in 0..40 {
        let n = [1, 2, 3, 5, 20, 60][seed as usize % 6];
        check::<Plane>(seed, &[[1.0, 0.0], [0.0, 1.0]], n);
        check::<Plane>(seed, &[[1.0, 0.0], [0.375, 1.0]], n);
        check::<Plane>(seed, &[[1.0, 0.25], [-0.125, 3.0]], n);
        check::<Plane>(seed, &[[1.0, 0.0]], n);
    }
    for seed in 0..8 {
        let n = [1, 2, 5, 20][seed as usize % 4];
        check::<Space>(seed, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], n);
        check::<Space>(seed, &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 1.5]], n);
    }
}

/// Lattices, where all is tied: positions wrapped in another way, or another basis, change no class.
#[test]
fn ties_do_not_depend_on_wrapping_and_basis() {
    for seed in 0..30 {
        let rng = &mut Rng::new(seed);
        let n = 1 + rng.below(3);
        let step = 1.0 / n as f64;
        let step = if n == 3 { 0.25 } else { step };
        let mut points = Vec::new();
        for x in 0..n {
            for y in 0..n {
                points.push([x as f64 * step, y as f64 * step]);
            }
        }
        rng.shuffle(&mut points);
        let basis = [[1.0, 0.0], [0.0, 1.0]];
        let expected = by_copies::<Plane>(&points, &basis, 3);
        let t = PeriodicTriangulation::<Plane>::new(&points, &basis, Options::default()).unwrap();
        assert_eq!(classes(&t, &points, &basis), expected, "seed {seed}");
        // Another basis of the lattice, and each vertex somewhere else: shifts in the first basis from the first places.
        let other_basis = [[1.0, 5.0], [0.0, 1.0]];
        let moved: Vec<[i64; 2]> = points.iter().map(|_| [0, 1].map(|_| rng.below(7) as i64 - 3)).collect();
        let other: Vec<[f64; 2]> =
            points.iter().zip(&moved).map(|(p, m)| [p[0] + m[0] as f64, p[1] + m[1] as f64]).collect();
        let t = PeriodicTriangulation::<Plane>::new(&other, &other_basis, Options::default()).unwrap();
        let at = |v: u32, s: [i64; 3]| place::<Plane>(&points, &basis, v, s).to_vec();
        let mut found = BTreeSet::new();
        for (c, row) in t.corners().iter().enumerate() {
            let corners = (0..3)
                .map(|i| {
                    let [a, b, _] = t.shifts(c, i);
                    let m = moved[row[i].index()];
                    (row[i].get(), [a + m[0], 5 * a + b + m[1], 0])
                })
                .collect();
            assert!(found.insert(class(corners, &at)));
        }
        assert_eq!(found, expected, "seed {seed}");
    }
}

/// What a build and a commit take, beside those of as many vertices in the open.
#[test]
#[ignore = "prints times"]
fn times() {
    fn go<G: Dimension>(n: usize, basis: &[G::Point]) {
        use std::time::Instant;
        let rng = &mut Rng::new(1);
        let mut points = random_points::<G>(rng, n, basis);
        let start = Instant::now();
        let mut open = MovingTriangulation::<G>::new(&points, Options::default()).unwrap();
        open.cells().unwrap();
        let open_build = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let mut t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
        let build = start.elapsed().as_secs_f64();
        println!("{}D, {n}: build {:.1} ms, open {:.1} ms, {} images, {} cells, open {}", G::D, 1e3 * build, 1e3 * open_build, t.image_count(), t.cell_count(), open.cell_count());
        let spacing = (n as f64).powf(-1.0 / G::D as f64);
        for share in [1e-4, 1e-3, 1e-2] {
            for _ in 0..3 {
                for p in &mut points {
                    for axis in 0..G::D {
                        p[axis] += share * spacing * (rng.below(2001) as f64 / 1000.0 - 1.0);
                    }
                }
                let start = Instant::now();
                open.commit_positions(&points).unwrap();
                let open_commit = start.elapsed().as_secs_f64();
                let start = Instant::now();
                t.commit(&points).unwrap();
                println!("  {share}: {:.2} ms, open {:.2} ms, {} images", 1e3 * start.elapsed().as_secs_f64(), 1e3 * open_commit, t.image_count());
            }
        }
    }
    go::<Plane>(100_000, &[[1.0, 0.0], [0.0, 1.0]]);
    go::<Space>(100_000, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    go::<Space>(100_000, &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 1.0]]);
}
