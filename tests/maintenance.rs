//! The maintenance algorithms of the report, each by itself over many
//! timestamps: its cells are those of a fresh build.
//!
//! Displacements are of the size of tolerances, so that every commit has vertices on both sides of the tests.

use crate::common::{Rng, assert_same_cells, cell_set, fresh_cells, vertex};
use deldrift::motion::{
    Algorithm, CoincidencePolicy, CommitReport, Level, MovingTriangulation, Options, SwitchingRule,
};
use deldrift::{Coordinates, Dimension, Plane, Space, VertexId};

const MAINTENANCE: [Algorithm; 4] = [
    Algorithm::Tolerance,
    Algorithm::SafeRegion,
    Algorithm::SafeRegionTolerance,
    Algorithm::RebuildingTolerance,
];

/// Points at unit density: anywhere, on a grid, or a grid that is a little off.
fn positions<G: Dimension>(kind: u64, n: usize, rng: &mut Rng) -> Vec<Option<G::Point>> {
    let side = (n as f64).powf(1.0 / G::D as f64).ceil();
    (0..n)
        .map(|i| {
            let mut p = G::Point::default();
            let mut rest = i;
            for k in 0..G::D {
                let on_grid = (rest % side as usize) as f64;
                rest /= side as usize;
                p[k] = match kind % 3 {
                    0 => rng.unit() * side,
                    1 => on_grid,
                    _ => on_grid + 1e-9 * rng.unit(),
                };
            }
            Some(p)
        })
        .collect()
}

fn nudge<P: Coordinates>(p: &mut P, d: usize, size: f64, rng: &mut Rng) {
    for k in 0..d {
        p[k] += size * (rng.unit() - 0.5);
    }
}

fn agree<G: Dimension>(algorithm: Algorithm, seed: u64, n: usize) -> CommitReport {
    let rng = &mut Rng::new(seed);
    let mut now = positions::<G>(seed, n, rng);
    let start: Vec<G::Point> = now.iter().map(|p| p.expect("present")).collect();
    let switching = SwitchingRule { seed, ..SwitchingRule::default() };
    let options = Options { algorithm, ..Options::default() };
    let mut t = MovingTriangulation::<G>::new(&start, options).expect("a build");
    t.set_switching_rule(switching);
    for step in 0..12 {
        let context = || format!("{algorithm:?} in {} dimensions, seed {seed}, step {step}", G::D);
        let present: Vec<usize> = (0..now.len()).filter(|&v| now[v].is_some()).collect();
        // From far within all tolerances to far beyond.
        let size = 10f64.powf(-4.0 + 4.0 * rng.unit());
        match rng.below(8) {
            0 => {
                let v = present[rng.below(present.len())];
                t.remove_vertex(VertexId::at(v)).expect("a removal");
                now[v] = None;
            }
            1 => {
                let mut p = now[present[rng.below(present.len())]].expect("present");
                nudge(&mut p, G::D, size, rng);
                assert_eq!(t.insert_vertex(&p).expect("an insertion").index(), now.len());
                now.push(Some(p));
            }
            2 => {
                for &v in present.iter().take(10) {
                    let p = now[v].as_mut().expect("present");
                    nudge(p, G::D, size, rng);
                    t.relocate_vertex(VertexId::at(v), p).expect("a relocation");
                }
            }
            3 => {
                // Two meet, or part again.
                let [a, b] = [0, 1].map(|_| present[rng.below(present.len())]);
                now[a] = now[b];
                t.move_vertices(&[VertexId::at(a)], &[now[b].expect("present")]).expect("a move");
                t.commit_timestamp().expect("a commit");
            }
            _ => {
                let share = 1 + rng.below(3);
                for &v in present.iter().filter(|&v| v % share == 0) {
                    nudge(now[v].as_mut().expect("present"), G::D, size, rng);
                    t.move_vertices(&[VertexId::at(v)], &[now[v].expect("present")]).expect("a move");
                }
                t.commit_timestamp().expect("a commit");
            }
        }
        t.validate(Level::Delaunay).unwrap_or_else(|v| panic!("{}: {v}", context()));
        assert_same_cells(&cell_set(&t), &fresh_cells::<G>(&now), context);
    }
    t.statistics()
}

fn all_agree<G: Dimension>() {
    for algorithm in MAINTENANCE {
        let (mut within, mut beyond) = (0, 0);
        for seed in 0..200u64 {
            let n = if seed % 20 == 0 { 400 } else { 20 + seed as usize % 60 };
            let sums = agree::<G>(algorithm, seed, n);
            within += sums.within_tolerance + sums.within_safe_region;
            beyond += sums.placements + sums.flips;
        }
        // Both ways through the algorithms have been taken often.
        assert!(within > 1000 && beyond > 1000, "{algorithm:?}: {within} within, {beyond} beyond");
    }
}

#[test]
fn maintenance_in_the_plane_matches_fresh_builds() {
    all_agree::<Plane>();
}

#[test]
fn maintenance_in_space_matches_fresh_builds() {
    all_agree::<Space>();
}

/// Exact arithmetic is for ties: all fours (eights) of a grid, none of random points. The grid's coordinates are
/// rounded, as those of few bits need none.
#[test]
fn exact_signs_are_counted() {
    fn count<G: Dimension>(kind: u64, algorithm: Algorithm) -> u64 {
        let mut points: Vec<G::Point> =
            positions::<G>(kind, 1000, &mut Rng::new(kind)).into_iter().flatten().collect();
        points.iter_mut().for_each(|p| (0..G::D).for_each(|k| p[k] *= 0.1));
        let options = Options { algorithm, ..Options::default() };
        let mut t = MovingTriangulation::<G>::new(&points, options).expect("a build");
        assert_eq!(t.statistics().exact_calls, 0);
        // Half of the way to a neighbour on the grid makes ties there.
        let mut half = points[500];
        for k in 0..G::D {
            half[k] = 0.5 * (half[k] + points[501][k]);
        }
        t.move_vertices(&[vertex(500)], &[half]).expect("a move");
        let report = t.commit_timestamp().expect("a commit");
        assert_eq!(report.exact_calls, t.statistics().exact_calls);
        t.relocate_vertex(vertex(500), &points[500]).expect("a relocation");
        let v = t.insert_vertex(&points[3]).expect("an insertion");
        t.remove_vertex(v).expect("a removal");
        assert!(t.statistics().exact_calls >= report.exact_calls);
        report.exact_calls
    }
    for (algorithm, least) in [(Algorithm::Rebuilding, 1000), (Algorithm::Placement, 1)] {
        let of_random = count::<Plane>(0, algorithm).max(count::<Space>(0, algorithm));
        let of_grids = count::<Plane>(1, algorithm).min(count::<Space>(1, algorithm));
        assert!(of_random <= 2 && of_grids >= least, "{algorithm:?}: {of_random} and {of_grids}");
    }
}

/// Filters are made for where vertices are, now and then in the middle of a commit. One that fails after that puts
/// vertices back to places far away from there: the filters have to hold for these as well.
#[test]
fn filters_hold_for_where_vertices_are_put_back() {
    fn check<G: Dimension>(algorithm: Algorithm) {
        let rng = &mut Rng::new(11);
        let mut now: Vec<G::Point> = positions::<G>(0, 200, rng).into_iter().flatten().collect();
        let options = Options { algorithm, coincidence: CoincidencePolicy::Reject, ..Options::default() };
        let mut t = MovingTriangulation::<G>::new(&now, options).expect("a build");
        for _ in 0..3 {
            now.iter_mut().for_each(|p| nudge(p, G::D, 1e-3, rng));
            t.commit_positions(&now).expect("a commit");
        }
        let mut far = now.clone();
        for p in &mut far {
            (0..G::D).for_each(|k| p[k] += 1000.0);
            nudge(p, G::D, 3.0, rng);
        }
        far[199] = far[0];
        t.commit_positions(&far).expect_err("two vertices at one place");
        t.validate(Level::Delaunay).unwrap_or_else(|violation| panic!("{algorithm:?}: {violation}"));
        t.discard_moves();
        now.iter_mut().for_each(|p| nudge(p, G::D, 0.3, rng));
        t.commit_positions(&now).expect("a commit");
        t.validate(Level::Delaunay).unwrap_or_else(|violation| panic!("{algorithm:?}: {violation}"));
        let expected: Vec<_> = now.iter().copied().map(Some).collect();
        assert_same_cells(&cell_set(&t), &fresh_cells::<G>(&expected), || format!("{algorithm:?}"));
    }
    for algorithm in Algorithm::ALL {
        check::<Plane>(algorithm);
        check::<Space>(algorithm);
    }
}

/// An insertion and a removal compute the bi-cells of new cells, and no others: the next commit has nothing
/// to compute.
#[test]
fn tolerances_follow_insertions_and_removals() {
    fn check<G: Dimension>(algorithm: Algorithm) {
        let rng = &mut Rng::new(3);
        let mut now = positions::<G>(0, 2000, rng);
        let start: Vec<G::Point> = now.iter().copied().flatten().collect();
        let options = Options { algorithm, ..Options::default() };
        let mut t = MovingTriangulation::<G>::new(&start, options).expect("a build");
        let all = t.commit_timestamp().expect("a commit").tolerances;
        for step in 0..20 {
            let before = t.statistics().tolerances;
            let v = rng.below(2000);
            if now[v].take().is_some() {
                t.remove_vertex(VertexId::at(v)).expect("a removal");
                assert!(t.statistics().tolerances > before, "{algorithm:?}, step {step}");
            }
            let removed = t.statistics().tolerances;
            let mut p = start[v];
            nudge(&mut p, G::D, 0.3, rng);
            t.insert_vertex(&p).expect("an insertion");
            now.push(Some(p));
            assert!(t.statistics().tolerances > removed, "{algorithm:?}, step {step}");
            let computed = t.statistics().tolerances - before;
            assert!(computed < all / 5, "{algorithm:?}, step {step}: {computed} of {all}");
            // The inserted vertex has a tolerance of its own, as good as new: it stays within it, and leaves
            // it.
            for (size, within) in [(0.5, 1), (4.0, 0)] {
                let v = VertexId::at(now.len() - 1);
                let mut p = now[v].expect("present");
                p[0] += size * t.tolerance(v).expect("present");
                now[v] = Some(p);
                t.move_vertices(&[v], &[p]).expect("a move");
                let report = t.commit_timestamp().expect("a commit");
                assert_eq!(report.within_tolerance, within, "{algorithm:?}, step {step}");
                assert!(within == 0 || report.tolerances == 0);
                assert_same_cells(&cell_set(&t), &fresh_cells::<G>(&now), || format!("{algorithm:?} {step}"));
            }
        }
    }
    for algorithm in [Algorithm::Tolerance, Algorithm::SafeRegionTolerance] {
        check::<Plane>(algorithm);
        check::<Space>(algorithm);
    }
}

/// Immediate relocations within tolerance have a short way, which is not taken while there are views to end. It does,
/// counts and refuses what the long way does.
fn ways_agree<G: Dimension>(algorithm: Algorithm, coincidence: CoincidencePolicy) {
    let rng = &mut Rng::new(9);
    let mut now: Vec<G::Point> = positions::<G>(0, 90, rng).into_iter().flatten().collect();
    let options = || Options { algorithm, coincidence, ..Options::default() };
    let [mut short, mut long] =
        [(); 2].map(|()| MovingTriangulation::<G>::new(&now, options()).expect("a build"));
    for t in [&mut short, &mut long] {
        // A calm commit, after which rebuilding + tolerance has switched.
        t.move_all(&now).expect("moves");
        t.commit_timestamp().expect("a commit");
        t.remove_vertex(vertex(5)).expect("a removal");
        t.move_vertices(&[vertex(7)], &[now[7]]).expect("a move");
    }
    let mut refused = 0;
    for size in [1e-9, 1e-5, 1e-5, 1e-9, 1e-3, 0.3, 0.3, 0.3, 1e-6, 1e-6, 1e-6, 1e-6] {
        for v in 0..now.len() + 1 {
            let mut q = now.get(v).copied().unwrap_or_default();
            match rng.below(16) {
                0..3 => {}
                3 => q[G::D - 1] = *rng.pick(&[f64::NAN, f64::INFINITY, 2e57, -1e58]),
                4 if size == 0.3 => q = *rng.pick(&now),
                _ => nudge(&mut q, G::D, size, rng),
            }
            let _ = long.cells().expect("room");
            let done = long.relocate_vertex(VertexId::at(v), &q);
            // Not a number is not equal to itself.
            assert_eq!(format!("{:?}", short.relocate_vertex(VertexId::at(v), &q)), format!("{done:?}"));
            assert_eq!(short.statistics(), long.statistics(), "{algorithm:?}, vertex {v}, {size}");
            refused += u32::from(done.is_err());
            if done.is_ok() {
                now[v] = q;
            }
        }
        let present: Vec<_> = now.iter().enumerate().map(|(v, &p)| (v != 5).then_some(p)).collect();
        let context = || format!("{algorithm:?} in {} dimensions, {size}", G::D);
        assert_same_cells(&cell_set(&short), &fresh_cells::<G>(&present), context);
        short.validate(Level::Delaunay).unwrap_or_else(|v| panic!("{}: {v}", context()));
    }
    let sums = short.statistics();
    assert!(sums.within_tolerance > 200 && sums.placements + sums.flips > 50 && refused > 50, "{sums:?}");
}

#[test]
fn short_relocations_are_like_long_ones() {
    for algorithm in [Algorithm::Tolerance, Algorithm::RebuildingTolerance, Algorithm::Auto] {
        for coincidence in [CoincidencePolicy::Merge, CoincidencePolicy::Reject] {
            ways_agree::<Plane>(algorithm, coincidence);
            ways_agree::<Space>(algorithm, coincidence);
        }
    }
}

/// A vertex must not move for being on its side of a sphere if the others of the bi-cell may be on the wrong one: so
/// near to each other, rounding leaves no sphere between them.
#[test]
fn what_rounding_does_not_separate_has_no_safe_region() {
    let mut now = [
        [3e-12, 6.999999999996],
        [1e-14, 6.99999999999996],
        [-7.0000000000003, -99.90000000000049],
        [-1e-13, 6.9999999999998],
        [-6.9999999999999, -99.90000000000019],
    ];
    let start = now;
    now[4] = [-6.99999999999996, -99.90000000000003];
    for algorithm in MAINTENANCE {
        let options = Options { algorithm, ..Options::default() };
        let mut t = MovingTriangulation::<Plane>::new(&start, options).expect("a build");
        t.move_vertices(&[vertex(4)], &now[4..]).expect("a move");
        t.commit_timestamp().expect("a commit");
        t.validate(Level::Delaunay).unwrap_or_else(|v| panic!("{algorithm:?}: {v}"));
        assert_same_cells(&cell_set(&t), &fresh_cells::<Plane>(&now.map(Some)), || format!("{algorithm:?}"));
    }
}
