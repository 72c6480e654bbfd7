//! Beside copies: a part of the repeating set that is large enough is triangulated as a whole.

use super::*;
use crate::delaunay::{Moving, Plane, PowerPlane, PowerSpace, Space};
use crate::error::Error;
use crate::ids::VertexId;
use crate::motion::{Algorithm, MovingTriangulation, NO_CELL, Options};
use crate::predicates::WeightedPoint;
use crate::random::Rng;
use std::collections::BTreeSet;

mod boxes;
mod changes;
mod editing;
mod grid;
mod hidden;
mod histories;
mod keeping;
mod lists;
mod locating;
mod meeting;
mod near;
mod preparing;
mod staged;
mod telling;
mod times;
mod transferring;
mod zone;

/// Made anew of those vertices that are there.
fn anew<G: Moving>(points: &[G::Point], is_there: &[bool], basis: &[G::Point]) -> PeriodicTriangulation<G> {
    let mut t = PeriodicTriangulation::<G>::new(points, basis, Options::default()).unwrap();
    let gone: Vec<_> = VertexId::range(0..points.len()).filter(|&v| !is_there[v.index()]).collect();
    t.stage_removals(&gone).unwrap();
    // As if there had been many more, so that it is built.
    t.inside.n_built = usize::MAX / 4;
    let report = t.commit_timestamp().unwrap();
    assert_eq!(report.rebuilds, u64::from(!gone.is_empty()));
    t
}

type Class = Vec<(u32, [i64; 3])>;

/// A class of cells: the corners in order, relative to the first.
fn class(mut corners: Vec<(u32, [i64; 3])>, place: &dyn Fn(u32, [i64; 3]) -> Vec<f64>) -> Class {
    corners
        .sort_by(|a, b| a.0.cmp(&b.0).then_with(|| place(a.0, a.1).partial_cmp(&place(b.0, b.1)).unwrap()));
    let first = corners[0].1;
    corners.iter().map(|&(v, s)| (v, [0, 1, 2].map(|j| s[j] - first[j]))).collect()
}

fn place<G: Moving>(points: &[G::Point], basis: &[G::Point], v: u32, s: [i64; 3]) -> G::Point {
    let mut p = points[v as usize];
    for (j, b) in basis.iter().enumerate() {
        for axis in 0..G::D {
            p[axis] += s[j] as f64 * b[axis];
        }
    }
    p
}

/// All classes at vertices that are not translated, of copies from -n to n.
fn by_copies<G: Moving>(points: &[G::Point], basis: &[G::Point], n: i64) -> BTreeSet<Class> {
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

fn classes<G: Moving>(
    t: &PeriodicTriangulation<G>,
    points: &[G::Point],
    basis: &[G::Point],
) -> BTreeSet<Class> {
    check_structure(t, basis);
    let at = |v: u32, s: [i64; 3]| place::<G>(points, basis, v, s).as_ref().to_vec();
    let mut set = BTreeSet::new();
    let shifts: Vec<_> = t.cell_shifts().unwrap().collect();
    for (c, row) in t.cells().unwrap().corners.iter().enumerate() {
        let corners =
            row.as_ref().iter().zip(&shifts[c * (G::D + 1)..]).map(|(v, &s)| (v.get(), s)).collect();
        assert!(set.insert(class(corners, &at)), "a class comes once");
    }
    set
}

/// Cells are beside each other as neighbours and their shifts say, edges are those of the cells, and where the set repeats along
/// all axes, Voronoi cells fill the unit cell.
fn check_structure<G: Moving>(t: &PeriodicTriangulation<G>, basis: &[G::Point]) {
    let n = G::D + 1;
    let cells = t.cells().unwrap();
    let shifts: Vec<_> = t.cell_shifts().unwrap().collect();
    let beside: Vec<_> = t.neighbour_shifts().unwrap().collect();
    let sum = |a: [i64; 3], b: [i64; 3]| [0, 1, 2].map(|j| a[j] + b[j]);
    let mut edges = BTreeSet::new();
    for (c, row) in cells.corners.iter().enumerate() {
        let row = row.as_ref();
        let least = row.iter().min().unwrap();
        assert!(
            (0..n).any(|i| row[i] == *least && shifts[c * n + i] == [0; 3]),
            "the least is where it is given"
        );
        for i in 0..n {
            for j in 0..n {
                let between = [0, 1, 2].map(|k| shifts[c * n + j][k] - shifts[c * n + i][k]);
                if row[i] < row[j] || row[i] == row[j] && i != j {
                    edges.insert(([row[i], row[j]], between));
                }
            }
            let across = cells.neighbours[c].as_ref()[i];
            if across == NO_CELL {
                assert!(basis.len() < G::D, "there is no hull");
                continue;
            }
            let by = beside[c * n + i];
            let facet: BTreeSet<_> =
                (0..n).filter(|&k| k != i).map(|k| (row[k], shifts[c * n + k])).collect();
            let other = cells.corners[across].as_ref();
            let theirs: BTreeSet<_> =
                (0..n).map(|k| (other[k], sum(shifts[across.index() * n + k], by))).collect();
            assert!(facet.is_subset(&theirs), "{facet:?} {theirs:?}");
            assert!(!theirs.contains(&(row[i], shifts[c * n + i])));
        }
    }
    let listed: Vec<_> = t.edges().unwrap().collect();
    let mut found = BTreeSet::new();
    for &([u, w], shift) in &listed {
        assert!(found.insert(([u, w], shift)));
        if u == w {
            assert!(found.insert(([u, w], shift.map(|k| -k))), "one of both");
        }
    }
    assert_eq!(found, edges);
    if basis.len() == G::D && t.vertex_count() > 0 {
        let volumes = t.voronoi_volumes(&mut |_| true).unwrap();
        let sum: f64 = volumes.iter().filter(|x| !x.is_nan()).sum();
        let of_box = t.lattice.measure();
        assert!((sum - of_box).abs() < 1e-12 * of_box, "{sum} {of_box}");
    }
}

/// Random points in the unit cell; if they have weights, these are to a tenth of the squared spacing or one, a few of them or a
/// thousand.
fn random_points<G: Moving>(rng: &mut Rng, n: usize, basis: &[G::Point]) -> Vec<G::Point> {
    let grid = (1u64 << 20) as f64;
    let spread = spread_of_weights::<G>(rng, n);
    let places: Vec<G::Point> = (0..n)
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
        .collect();
    places.into_iter().map(|p| with_random_weight::<G>(rng, p, spread)).collect()
}

/// How far weights are to spread in one set.
fn spread_of_weights<G: Moving>(rng: &mut Rng, n: usize) -> f64 {
    if !G::HAS_WEIGHTS {
        return 0.0;
    }
    [0.1, 1.0, 4.0, 1000.0][rng.below(4)] * (n as f64).powf(-2.0 / G::D as f64)
}

/// A point with a weight up to a bound, if points have weights.
fn with_random_weight<G: Moving>(rng: &mut Rng, mut p: G::Point, spread: f64) -> G::Point {
    if G::HAS_WEIGHTS {
        p[G::D] = spread * (rng.unit() - 0.25);
    }
    p
}

fn check<G: Moving>(seed: u64, basis: &[G::Point], n: usize) {
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
        let spread = spread_of_weights::<G>(rng, n);
        for p in &mut points {
            for axis in 0..G::D {
                p[axis] += (rng.below(1 << 18) as f64 - (1 << 17) as f64) / (1u64 << 20) as f64;
            }
            *p = with_random_weight::<G>(rng, *p, spread);
        }
        t.commit_positions(&points).unwrap();
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

/// Vectors, as points without weight.
fn unweighted<const D: usize>(vectors: &[[f64; D]]) -> Vec<WeightedPoint<D>> {
    vectors.iter().map(|&place| WeightedPoint { place, weight: 0.0 }).collect()
}

#[test]
fn cells_with_weights_are_those_of_copies() {
    for seed in 0..40 {
        let n = [1, 2, 3, 5, 20, 60][seed as usize % 6];
        check::<PowerPlane>(seed, &unweighted(&[[1.0, 0.0], [0.0, 1.0]]), n);
        check::<PowerPlane>(seed, &unweighted(&[[1.0, 0.0], [0.375, 1.0]]), n);
        check::<PowerPlane>(seed, &unweighted(&[[1.0, 0.25], [-0.125, 3.0]]), n);
        check::<PowerPlane>(seed, &unweighted(&[[1.0, 0.0]]), n);
    }
    for seed in 0..8 {
        let n = [1, 2, 5, 20][seed as usize % 4];
        check::<PowerSpace>(seed, &unweighted(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]), n);
        check::<PowerSpace>(seed, &unweighted(&[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 1.5]]), n);
    }
}

/// One vector that is along no axis, or nearly along one: vertices are several of its lengths apart across it. The cells are those
/// of copies of the positions and vectors that are used.
fn check_oblique<G: Moving>(seed: u64) {
    let rng = &mut Rng::new(seed);
    let mut number = |most: f64| most * (rng.within(0, (1 << 40) - 1) as f64 / (1u64 << 39) as f64 - 1.0);
    let mut vector = G::Point::default();
    (0..G::D).for_each(|axis| vector[axis] = number(if seed.is_multiple_of(4) { 1e-9 } else { 0.4 }));
    vector[0] += 0.7;
    let points: Vec<G::Point> = (0..1 + seed % 6)
        .map(|_| {
            let mut p = G::Point::default();
            (0..G::D).for_each(|axis| p[axis] = number(4.0));
            p
        })
        .collect();
    let t = PeriodicTriangulation::<G>::new(&points, &[vector], Options::default()).unwrap();
    let used: Vec<G::Point> = (0..points.len()).map(|v| t.position(VertexId::at(v)).unwrap()).collect();
    let basis: Vec<G::Point> = t.vectors().collect();
    assert_eq!(
        classes(&t, &used, &basis),
        by_copies::<G>(&used, &basis, 40),
        "seed {seed}: {used:?}, {basis:?}"
    );
    assert!(used.iter().zip(&points).all(|(p, q)| (0..G::D).all(|axis| (p[axis] - q[axis]).abs() < 1e-10)));
}

#[test]
fn vectors_along_no_axis_leave_nothing_rounded() {
    (0..60).for_each(check_oblique::<Plane>);
    (0..24).for_each(check_oblique::<Space>);
    let far =
        PeriodicTriangulation::<Plane>::new(&[[0.0, 0.0], [1e5, -1e5]], &[[1.0, 1.0]], Options::default());
    assert!(
        matches!(far, Err(Error::OutOfRange { argument: "positions", index: 1, axis: 0, .. })),
        "{far:?}"
    );
}

/// How thin a box is does not matter: no cell reaches farther than to the next periods.
#[test]
fn thin_boxes_have_few_images() {
    for seed in 0..12 {
        let rng = &mut Rng::new(seed);
        let n = 1 + seed as usize % 3;
        let basis = [[1.0, 0.0], [0.375, 16.0]];
        let points = random_points::<Plane>(rng, n, &basis);
        let t = PeriodicTriangulation::<Plane>::new(&points, &basis, Options::default()).unwrap();
        assert_eq!(classes(&t, &points, &basis), by_copies::<Plane>(&points, &basis, 24), "seed {seed}");
        let basis = [[1.0, 0.0, 0.0], [0.25, 1.0, 0.0], [0.0, 0.5, 5.0]];
        let points = random_points::<Space>(rng, n, &basis);
        let t = PeriodicTriangulation::<Space>::new(&points, &basis, Options::default()).unwrap();
        assert_eq!(classes(&t, &points, &basis), by_copies::<Space>(&points, &basis, 8), "seed {seed}");
    }
    for length in [1e3, 1e9, 1e15] {
        let basis = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, length]];
        let t = PeriodicTriangulation::<Space>::new(&[[0.5; 3]], &basis, Options::default()).unwrap();
        assert_eq!(t.cell_count(), Ok(6));
        assert!(t.image_count() <= 125, "{} images", t.image_count());
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
        let shifts: Vec<_> = t.cell_shifts().unwrap().collect();
        for (c, row) in t.cells().unwrap().corners.iter().enumerate() {
            let corners = (0..3)
                .map(|i| {
                    let [a, b, _] = shifts[3 * c + i];
                    let m = moved[row[i].index()];
                    (row[i].get(), [a + m[0], 5 * a + b + m[1], 0])
                })
                .collect();
            assert!(found.insert(class(corners, &at)));
        }
        assert_eq!(found, expected, "seed {seed}");
    }
}

/// Vertices at the same place modulo the lattice share one, which the lowest id represents.
#[test]
fn vertices_at_a_place_in_any_period_share_it() {
    let basis = [[1.0, 0.0], [0.0, 1.0]];
    let points = [[0.25, 0.25], [0.75, 0.5], [5.25, -2.75], [0.25, 1.25], [-0.25, 0.5]];
    let mut t = PeriodicTriangulation::<Plane>::new(&points, &basis, Options::default()).unwrap();
    let shown = |t: &PeriodicTriangulation<Plane>| {
        (0..5).map(|v| t.coincident_representative(VertexId::new(v)).unwrap().get()).collect::<Vec<_>>()
    };
    assert_eq!(shown(&t), [0, 1, 0, 0, 1]);
    assert_eq!((t.cell_count().unwrap(), t.statistics().coincident), (4, 3));
    check_structure(&t, &basis);
    let volumes = t.voronoi_volumes(&mut |_| true).unwrap();
    assert_eq!(volumes[2..], [0.0; 3]);
    // 0 leaves; across the border a vertex comes to where another one is.
    let report =
        t.commit_positions(&[[0.5, 0.875], [0.0, 0.5], [5.25, -2.75], [0.25, 1.25], [1.0, 0.5]]).unwrap();
    assert_eq!(shown(&t), [0, 1, 2, 2, 1]);
    assert_eq!((t.cell_count().unwrap(), report.coincident), (6, 2));
    check_structure(&t, &basis);
}

#[test]
fn what_is_bad_is_told_and_changes_nothing() {
    type Periodic = PeriodicTriangulation<Plane>;
    let made = |vectors: &[[f64; 2]]| Periodic::new(&[[0.5, 0.5]], vectors, Options::default()).err();
    for vectors in [&[[0.0, 0.0]][..], &[[1.0, 1.0], [2.0, 2.0]], &[[1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]] {
        assert_eq!(made(vectors), Some(Error::DependentVectors { count: vectors.len() }));
    }
    assert!(matches!(
        made(&[[1.0, f64::NAN]]),
        Some(Error::NotFinite { argument: "vectors", index: 0, axis: 1, .. })
    ));
    assert!(matches!(
        made(&[[1.0, 0.0], [0.0, 1e51]]),
        Some(Error::OutOfRange { argument: "vectors", index: 1, .. })
    ));
    assert!(matches!(
        made(&[[1.0, 0.0], [1e-51, 1.0]]),
        Some(Error::InvalidValue { argument: "vectors", index: 2, .. })
    ));
    let square = [[1.0, 0.0], [0.0, 1.0]];
    let far = Periodic::new(&[[0.5, 0.5], [1e20, 0.0]], &square, Options::default()).err();
    assert!(
        matches!(far, Some(Error::OutOfRange { argument: "positions", index: 1, axis: 0, .. })),
        "{far:?}"
    );
    let points = [[0.5, 0.5], [0.25, 0.75], [0.125, 0.0]];
    let mut t = Periodic::new(&points, &square, Options::default()).unwrap();
    let ids = |numbers: &'static [u32]| VertexId::of_numbers(numbers);
    t.move_vertices(ids(&[1]), &[[0.5, 0.25]]).unwrap();
    let twice = t.move_vertices(ids(&[0, 1]), &[[0.5, 0.25]; 2]);
    assert!(matches!(twice, Err(Error::DuplicateMove { index: 1, .. })));
    assert!(matches!(t.move_vertices(ids(&[3]), &[[0.0; 2]]), Err(Error::NoSuchVertex { ids: 3, .. })));
    assert!(matches!(t.stage_removals(ids(&[0, 0])), Err(Error::StagedVertex { index: 1, .. })));
    assert!(matches!(t.commit_positions(&points), Err(Error::DuplicateMove { index: 1, .. })));
    assert!(matches!(t.stage_vectors(&square[..1]), Err(Error::WrongCount { given: 1, wanted: 2, .. })));
    assert_eq!((t.staged_count(), t.discard_moves(), t.staged_count()), (1, 1, 0));
    let nan = t.commit_positions(&[[0.5, 0.5], [f64::NAN, 0.75], [0.125, 0.0]]);
    assert!(matches!(nan, Err(Error::NotFinite { argument: "positions", index: 1, axis: 0, .. })));
    let far = t.commit_positions(&[[0.5, 0.5], [0.0, 0.75], [1e30, 0.0]]);
    assert!(matches!(far, Err(Error::OutOfRange { argument: "positions", index: 2, axis: 0, .. })));
    assert_eq!((t.timestamp(), t.position(VertexId::new(1))), (0, Ok([0.25, 0.75])));
}

/// A commit that is cancelled, in whatever round, leaves all as it was.
#[test]
fn a_commit_that_is_cancelled_has_no_effect() {
    use std::sync::Arc;
    use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
    let rng = &mut Rng::new(5);
    let basis = [[1.0, 0.0], [0.0, 1.0]];
    let points = random_points::<Plane>(rng, 3_000, &basis);
    let goals = random_points::<Plane>(rng, 3_000, &basis);
    let left = Arc::new(AtomicU64::new(u64::MAX));
    let asked = Arc::clone(&left);
    let monitor = move |_| asked.fetch_update(Relaxed, Relaxed, |n| n.checked_sub(1)).is_ok();
    let options = Options { monitor: Some(Box::new(monitor)), ..Options::default() };
    let mut t = PeriodicTriangulation::<Plane>::new(&points, &basis, options).unwrap();
    let before = classes(&t, &points, &basis);
    let mut n_cancelled = 0;
    for n in 0.. {
        left.store(n, Relaxed);
        if t.commit_positions(&goals).is_ok() {
            break;
        }
        left.store(u64::MAX, Relaxed);
        assert_eq!((t.timestamp(), classes(&t, &points, &basis) == before), (0, true), "{n}");
        n_cancelled += 1;
    }
    assert!(n_cancelled > 0);
    left.store(u64::MAX, Relaxed);
    let fresh = PeriodicTriangulation::<Plane>::new(&goals, &basis, Options::default()).unwrap();
    assert!(classes(&t, &goals, &basis) == classes(&fresh, &goals, &basis));
}
