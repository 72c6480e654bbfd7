//! The algorithms that move all vertices at once, and *auto*, under adversarial motion: after every commit the cells
//! are those of a fresh build.
//!
//! Each history is a sequence of motions, drawn by its seed from those of [`MOTIONS`], on random points or on
//! a grid, whose ties every motion breaks or makes. `DELDRIFT_SOAK` multiplies the number of seeds.

use crate::common::inputs::{on_spheres_within_each_other, on_unit_sphere};
use crate::common::{Rng, assert_same_cells, cell_set, fresh_cells, point, seeds, vertex};
use deldrift::motion::{Algorithm, CommitReport, Commits, Level, Location, MovingTriangulation, Options};
use deldrift::{Dimension, Plane, Shape, Space, VertexId};

/// A motion of all positions; it gets the positions of the beginning and those of now.
type Motion<G> = fn(&[Point<G>], &mut [Point<G>], &mut Rng);
type Point<G> = <G as Shape>::Point;

/// Extent of the inputs.
const EXTENT: f64 = 8.0;

fn motions<G: Dimension>() -> [(&'static str, Motion<G>); 12] {
    [
        ("shear", |_, now, rng| {
            let s = rng.unit() - 0.5;
            for p in now {
                p[0] += s * p[1];
            }
        }),
        ("back", |first, now, _| now.copy_from_slice(first)),
        ("breathe", |_, now, rng| {
            let s = 0.8 + 0.4 * rng.unit();
            for p in now {
                for k in 0..G::D {
                    p[k] = (p[k] - EXTENT / 2.0) * s + EXTENT / 2.0;
                }
            }
        }),
        ("teleport", |_, now, rng| {
            for _ in 0..1 + now.len() / 30 {
                let v = rng.below(now.len());
                now[v] = point::<G>(|_| EXTENT * (2.0 * rng.unit() - 0.5));
            }
        }),
        ("rotate the outer ones", |_, now, rng| {
            let (sin, cos) = (0.3 * rng.unit()).sin_cos();
            for p in now {
                let [x, y] = [p[0] - EXTENT / 2.0, p[1] - EXTENT / 2.0];
                if x * x + y * y > EXTENT * EXTENT / 9.0 {
                    p[0] = cos * x - sin * y + EXTENT / 2.0;
                    p[1] = sin * x + cos * y + EXTENT / 2.0;
                }
            }
        }),
        ("through a plane", |_, now, _| {
            for p in now {
                p[G::D - 1] = EXTENT - p[G::D - 1];
            }
        }),
        ("swap", |_, now, rng| {
            for _ in 0..1 + now.len() / 20 {
                let (a, b) = (rng.below(now.len()), rng.below(now.len()));
                now.swap(a, b);
            }
        }),
        ("onto a line", |_, now, _| {
            for p in now {
                for k in 1..G::D {
                    p[k] = 1.0;
                }
            }
        }),
        ("to a grid", |_, now, _| {
            for p in now {
                for k in 0..G::D {
                    p[k] = p[k].round();
                }
            }
        }),
        ("tremble", |_, now, rng| tremble::<G>(now, 1e-3, rng)),
        ("shake", |_, now, rng| tremble::<G>(now, 0.05, rng)),
        ("a few jump", |_, now, rng| {
            for _ in 0..3 {
                let (v, w) = (rng.below(now.len()), rng.below(now.len()));
                now[v] = now[w];
                now[v][0] += [0.0, 1e-9, 0.3][rng.below(3)];
            }
        }),
    ]
}

fn tremble<G: Dimension>(now: &mut [Point<G>], size: f64, rng: &mut Rng) {
    for p in now {
        for k in 0..G::D {
            p[k] += size * (2.0 * rng.unit() - 1.0);
        }
    }
}

fn beginning<G: Dimension>(seed: u64, rng: &mut Rng) -> Vec<Point<G>> {
    let n = 12 + rng.below(if seed.is_multiple_of(16) { 400 } else { 80 });
    (0..n)
        .map(|i| match seed % 3 {
            0 => {
                let side = if G::D == 2 { 9 } else { 5 };
                point::<G>(|k| (i / [1, side, side * side][k] % side) as f64)
            }
            1 => point::<G>(|_| (EXTENT * rng.unit() * 64.0).round() / 64.0),
            _ => point::<G>(|_| EXTENT * rng.unit()),
        })
        .collect()
}

/// One history; returns what was done.
fn agree<G: Dimension>(algorithm: Algorithm, seed: u64) -> CommitReport {
    let mut rng = Rng::new(seed);
    let first = beginning::<G>(seed, &mut rng);
    let mut now = first.clone();
    let options = Options { algorithm, ..Options::default() };
    let mut t = MovingTriangulation::<G>::new(&first, options).expect("a build");
    let motions = motions::<G>();
    let mut names = Vec::new();
    for _ in 0..8 {
        // Small motions are the more frequent ones.
        let (name, motion) = if rng.one_in(2) { motions[9] } else { *rng.pick(&motions) };
        names.push(name);
        motion(&first, &mut now, &mut rng);
        t.move_all(&now).expect("moves");
        t.commit_timestamp().expect("a commit");
        let context = || format!("{algorithm:?}, {}D, seed {seed}: {names:?}", G::D);
        t.validate(Level::Delaunay).unwrap_or_else(|v| panic!("{}: {v}", context()));
        let positions: Vec<Option<Point<G>>> = now.iter().copied().map(Some).collect();
        assert_same_cells(&cell_set(&t), &fresh_cells::<G>(&positions), context);
    }
    t.statistics()
}

fn all_agree<G: Dimension>() {
    let together = Algorithm::ALL.into_iter().filter(|a| a.row().commits == Commits::Together);
    for algorithm in together.chain([Algorithm::Auto]) {
        let (mut flips, mut placements, mut rebuilds, mut within) = (0, 0, 0, 0);
        let seeds = seeds(500);
        let n = seeds.end;
        for seed in seeds {
            let sums = agree::<G>(algorithm, seed);
            flips += sums.flips;
            placements += sums.placements;
            rebuilds += sums.rebuilds;
            within += sums.within_tolerance;
        }
        let taken = [flips, placements, rebuilds];
        assert!(taken.iter().all(|&times| times > n / 2), "{algorithm:?}: a way was hardly taken: {taken:?}");
        assert!(algorithm != Algorithm::Watching || within > 10 * n, "tolerances were hardly used: {within}");
    }
}

#[test]
fn adversarial_motion_in_the_plane_matches_fresh_builds() {
    all_agree::<Plane>();
}

#[test]
fn adversarial_motion_in_space_matches_fresh_builds() {
    all_agree::<Space>();
}

/// One vertex after another by *auto*, which turns to tolerances when little
/// changes and away from them when much does.
fn relocations_agree<G: Dimension>() {
    let mut rng = Rng::new(5);
    let mut now = beginning::<G>(32, &mut rng);
    let mut t = MovingTriangulation::<G>::new(&now, Options::default()).expect("a build");
    for (round, size) in [1e-6, 1e-6, 1e-6, 1e-6, 0.3, 0.3, 0.3, 1e-7, 1e-7].into_iter().enumerate() {
        tremble::<G>(&mut now, size, &mut rng);
        for (v, p) in now.iter().enumerate() {
            t.relocate_vertex(VertexId::at(v), p).expect("a relocation");
        }
        let context = || format!("{}D, round {round}", G::D);
        t.validate(Level::Delaunay).unwrap_or_else(|v| panic!("{}: {v}", context()));
        let positions: Vec<Option<Point<G>>> = now.iter().copied().map(Some).collect();
        assert_same_cells(&cell_set(&t), &fresh_cells::<G>(&positions), context);
    }
    let (sums, n) = (t.statistics(), now.len() as u64);
    assert!(sums.within_tolerance > n / 2, "tolerances were hardly used: {sums:?}");
    assert!(sums.placements + sums.flips > n / 2, "next to nothing changed: {sums:?}");
}

#[test]
fn relocations_by_auto_match_fresh_builds() {
    relocations_agree::<Plane>();
    relocations_agree::<Space>();
}

/// Walks begin in the cell of the latest change, here an insertion: a flip that frees it must leave another one for
/// that.
#[test]
fn walks_begin_in_a_cell_after_flips() {
    let mut flips = 0;
    let seeds = seeds(1000);
    let n = seeds.end;
    for seed in seeds {
        let mut rng = Rng::new(seed);
        let mut now: Vec<_> = (0..20).map(|_| point::<Space>(|_| EXTENT * rng.unit())).collect();
        let options = Options { algorithm: Algorithm::Repair, ..Options::default() };
        let mut t = MovingTriangulation::<Space>::new(&now, options).expect("a build");
        now.push([EXTENT / 2.0; 3]);
        t.insert_vertex(&now[20]).expect("an insertion");
        tremble::<Space>(&mut now, 0.02, &mut rng);
        tremble::<Space>(&mut now[20..], 0.5, &mut rng);
        t.move_all(&now).expect("moves");
        flips += t.commit_timestamp().expect("a commit").flips;
        t.validate(Level::Delaunay).unwrap_or_else(|v| panic!("seed {seed}: {v}"));
        assert_eq!(t.locate(&now[20]), Ok(Location::Vertex(vertex(20))), "seed {seed}");
    }
    assert!(flips > 2 * n, "there were hardly any flips: {flips}");
}

/// Where all cells change at once flips would be quadratic in their number: a repair gives up in time, in proportion to
/// the number of vertices.
#[test]
fn repairs_that_would_flip_without_end_rebuild() {
    let mut rng = Rng::new(3);
    let mut now = on_unit_sphere(4000, &mut rng);
    let options = Options { algorithm: Algorithm::Repair, ..Options::default() };
    let mut t = MovingTriangulation::<Space>::new(&now, options).expect("a build");
    // The sphere becomes an ellipsoid.
    now.iter_mut().for_each(|p| p[0] += 0.001 * p[1]);
    let report = t.commit_positions(&now).expect("a commit");
    assert_eq!(report.rebuilds, 1);
    assert!(report.certificates < 100 * now.len() as u64, "{report:?}");
    let positions: Vec<_> = now.iter().copied().map(Some).collect();
    assert_same_cells(&cell_set(&t), &fresh_cells::<Space>(&positions), || "an ellipsoid".into());
}

/// On spheres within each other most cells are in conflict with many: flips are stuck, islands are too large to be
/// filled, and vertices are taken back, round after round.
#[test]
fn repairs_that_are_stuck_on_spheres_match_fresh_builds() {
    let mut placements = 0;
    for (algorithm, seed) in [(Algorithm::Repair, 1), (Algorithm::Repair, 4), (Algorithm::Auto, 3)] {
        let rng = &mut Rng::new(seed);
        let first = on_spheres_within_each_other(600, rng);
        let options = Options { algorithm, ..Options::default() };
        let mut t = MovingTriangulation::<Space>::new(&first, options).expect("a build");
        for step in 0..12 {
            // Of all at once a repair would foresee that it takes too long.
            let mut moved = |p: &[f64; 3]| {
                let size = if rng.one_in(20) { 4e-5 } else { 0.0 };
                p.map(|x| x + size * (rng.unit() - 0.5))
            };
            let now: Vec<_> = first.iter().map(&mut moved).collect();
            let report = t.commit_positions(&now).expect("a commit");
            placements += if report.rebuilds == 0 { report.placements } else { 0 };
            let positions: Vec<_> = now.iter().copied().map(Some).collect();
            assert_same_cells(&cell_set(&t), &fresh_cells::<Space>(&positions), || {
                format!("{algorithm:?}, seed {seed}, step {step}")
            });
        }
    }
    assert!(placements > 0, "none was taken back and placed");
}

/// A lattice of so many points along each axis, of these spacings, in any order.
fn lattice<G: Dimension>(side: usize, spacing: [f64; 3], rng: &mut Rng) -> Vec<Point<G>> {
    let n = side.pow(G::D as u32);
    let place = |i: usize| point::<G>(|k| spacing[k] * (i / [1, side, side * side][k] % side) as f64);
    let mut points: Vec<_> = (0..n).map(place).collect();
    rng.shuffle(&mut points);
    points
}

fn sheared<G: Dimension>(points: &[Point<G>], by: f64) -> Vec<Point<G>> {
    let mut points = points.to_vec();
    points.iter_mut().for_each(|p| p[0] += by * p[1]);
    points
}

/// Points in lattices, sheared by as much as in each of these commits; returns the reports.
fn shear_lattice<G: Dimension>(
    algorithm: Algorithm,
    first: &[Point<G>],
    shears: &[f64],
    checks: bool,
) -> Vec<CommitReport> {
    let options = Options { algorithm, threads: 1, ..Options::default() };
    let mut t = MovingTriangulation::<G>::new(first, options).expect("a build");
    let commit = |&by: &f64| {
        let now = sheared::<G>(first, by);
        let report = t.commit_positions(&now).expect("a commit");
        if checks {
            let positions: Vec<_> = now.into_iter().map(Some).collect();
            assert_same_cells(&cell_set(&t), &fresh_cells::<G>(&positions), || {
                format!("{algorithm:?}, {}D, sheared by {by}", G::D)
            });
        }
        report
    };
    shears.iter().map(commit).collect()
}

/// Whatever is foreseen, the cells are those of a fresh build, and it is foreseen again.
#[test]
fn foresight_changes_no_cell_and_depends_on_nothing_else() {
    fn agree<G: Dimension>(side: usize) {
        let rng = &mut Rng::new(17);
        for (spacing, noise) in
            [([1.0; 3], 0.0), ([1.0, if G::D == 2 { 1e-3 } else { 1.0 }, 1e-3], 0.0), ([1.0; 3], 1e-12)]
        {
            let mut first = lattice::<G>(side, spacing, rng);
            if noise > 0.0 {
                tremble::<G>(&mut first, noise, rng);
            }
            let shears = [1e-3, 0.0, 1e-3, 2e-3, 3e-3, 0.0];
            for algorithm in [Algorithm::Repair, Algorithm::Auto] {
                let reports = shear_lattice::<G>(algorithm, &first, &shears, true);
                assert_eq!(reports, shear_lattice::<G>(algorithm, &first, &shears, false));
            }
        }
    }
    agree::<Plane>(130);
    agree::<Space>(19);
}

/// In a lattice that is sheared, or becomes one again, up to two thirds of the facets fail for each cell, in clusters
/// as small as its cubes: they are flipped.
#[test]
fn sheared_lattices_are_mended() {
    for side in [8, 14] {
        let first = lattice::<Space>(side, [1.0; 3], &mut Rng::new(19));
        let n = first.len() as u64;
        for report in shear_lattice::<Space>(Algorithm::Repair, &first, &[1e-3, 0.0], true) {
            assert_eq!((report.rebuilds, report.placements), (0, 0), "{report:?}");
            assert!(report.flips > n && report.certificates < 40 * n, "{report:?}");
        }
    }
}

/// On a sphere that becomes an ellipsoid most facets fail, in clusters of hundreds of cells: all is rebuilt, after a
/// sweep or, where there are enough cells for it, after a sample. The next time few facets fail.
#[test]
fn spheres_that_become_ellipsoids_are_rebuilt_at_once() {
    for (n, most) in [(1000, 10), (12_000, 1)] {
        let first = on_unit_sphere(n, &mut Rng::new(5));
        let reports = shear_lattice::<Space>(Algorithm::Repair, &first, &[1e-3, 2e-3], true);
        assert_eq!(reports.iter().map(|report| report.rebuilds).collect::<Vec<_>>(), [1, 0]);
        assert!(reports[0].certificates < most * n as u64, "{reports:?}");
    }
}

/// A seventh of a lattice leaves its places: there are more cells then, and the slots for them are made at once, so
/// that facets do not wait for them by turns.
#[test]
fn leaving_a_lattice_takes_few_certificates_for_each_flip() {
    let rng = &mut Rng::new(37);
    let mut now = lattice::<Space>(19, [1.0; 3], rng);
    let options = Options { algorithm: Algorithm::Repair, threads: 1, ..Options::default() };
    let mut t = MovingTriangulation::<Space>::new(&now, options).expect("a build");
    let n = now.len();
    tremble::<Space>(&mut now[..n / 7], 1e-4, rng);
    let report = t.commit_positions(&now).expect("a commit");
    assert_eq!(report.rebuilds, 0, "{report:?}");
    assert!(report.flips > n as u64, "{report:?}");
    // A sweep evaluates 18 for each vertex, and a flip six.
    assert!(report.certificates < 18 * n as u64 + 12 * report.flips, "{report:?}");
    let positions: Vec<_> = now.iter().copied().map(Some).collect();
    assert_same_cells(&cell_set(&t), &fresh_cells::<Space>(&positions), || "a lattice left".into());
}

/// What has made auto rebuild may not happen again: the next commit is swept, and repaired if that is cheaper.
#[test]
fn auto_looks_again_after_a_rebuild() {
    let first = on_unit_sphere(2000, &mut Rng::new(41));
    let reports = shear_lattice::<Space>(Algorithm::Auto, &first, &[1e-3, 2e-3], true);
    assert_eq!(reports.iter().map(|report| report.rebuilds).collect::<Vec<_>>(), [1, 0]);
}

/// The flat sides of a body that begins to bend are dented all over, once: that commit is rebuilt, and no other. (As by
/// the Lagrangian motion that Mmg ships with its examples.)
#[test]
fn auto_repairs_after_flat_sides_have_bent() {
    let rng = &mut Rng::new(51);
    let mut now: Vec<_> = (0..3000).map(|_| point::<Space>(|_| 12.0 * rng.unit())).collect();
    for p in now.iter_mut().take(900) {
        p[rng.below(3)] = *rng.pick(&[0.0, 12.0]);
    }
    let options = Options { algorithm: Algorithm::Auto, threads: 1, ..Options::default() };
    let mut t = MovingTriangulation::<Space>::new(&now, options).expect("a build");
    let mut rebuilds = Vec::new();
    let first = now.clone();
    for step in 1..7 {
        let bent = |p: &Point<Space>, k: usize| p[k] + 1e-3 * f64::from(step) * (p[(k + 1) % 3] + p[k]).sin();
        now = first.iter().map(|p| [0, 1, 2].map(|k| bent(p, k))).collect();
        rebuilds.push(t.commit_positions(&now).expect("a commit").rebuilds);
    }
    assert_eq!(rebuilds, [1, 0, 0, 0, 0, 0]);
    let positions: Vec<_> = now.into_iter().map(Some).collect();
    assert_same_cells(&cell_set(&t), &fresh_cells::<Space>(&positions), || "a bent body".into());
}

/// Vertices on flat parts of the hull, which take as long as a rebuild each, are not placed to the end.
#[test]
fn placing_is_given_up_where_it_would_take_too_long() {
    let first = lattice::<Space>(24, [1.0, 1.0, 1e-3], &mut Rng::new(23));
    let shears = [1e-3, 2e-3, 3e-3];
    let [rebuilding, repair] = [Algorithm::Rebuilding, Algorithm::Repair]
        .map(|algorithm| shear_lattice::<Space>(algorithm, &first, &shears, false)[2]);
    assert!(repair.exact_calls < 2 * rebuilding.exact_calls, "{repair:?}");
}

/// A lattice that is sheared again and again: repairs that cost more than a rebuild are not made each time.
#[test]
fn auto_does_not_repeat_repairs_that_were_too_expensive() {
    let first = lattice::<Space>(19, [1.0; 3], &mut Rng::new(47));
    let shears: Vec<_> = (1..13).map(|k| 1e-3 * f64::from(k)).collect();
    let [rebuilding, auto] = [Algorithm::Rebuilding, Algorithm::Auto].map(|algorithm| {
        let reports = shear_lattice::<Space>(algorithm, &first, &shears, false);
        reports.iter().map(|report| report.exact_calls).sum::<u64>()
    });
    assert!(2 * auto < 3 * rebuilding, "{auto} against {rebuilding}");
}

/// A few vertices of a sphere, each with a star of hundreds of cells, are not placed to the end where that takes longer
/// than a rebuild.
#[test]
fn auto_rebuilds_where_few_vertices_take_longer() {
    let rng = &mut Rng::new(43);
    let mut now = on_unit_sphere(2000, rng);
    let first = now.clone();
    now.iter_mut().take(80).for_each(|p| p[0] += 0.001 * p[1]);
    let [flips, auto] = [Algorithm::PlacementFlips, Algorithm::Auto].map(|algorithm| {
        let options = Options { algorithm, threads: 1, ..Options::default() };
        let mut t = MovingTriangulation::<Space>::new(&first, options).expect("a build");
        t.move_first(&now[..80]).expect("moves");
        let report = t.commit_timestamp().expect("a commit");
        let positions: Vec<_> = now.iter().copied().map(Some).collect();
        assert_same_cells(&cell_set(&t), &fresh_cells::<Space>(&positions), || "few of a sphere".into());
        report
    });
    assert_eq!((flips.rebuilds, auto.rebuilds), (0, 1), "{flips:?}, {auto:?}");
    assert!(2 * auto.certificates < flips.certificates, "{flips:?}, {auto:?}");
}

/// What a repair does well is left to it: lattices that move as a whole, random points, few that go far.
#[test]
fn repairs_that_are_cheap_are_not_replaced() {
    fn repairs<G: Dimension>(first: &[Point<G>], mut motion: impl FnMut(&mut [Point<G>]), name: &str) {
        let options = Options { algorithm: Algorithm::Repair, threads: 1, ..Options::default() };
        let mut t = MovingTriangulation::<G>::new(first, options).expect("a build");
        let mut now = first.to_vec();
        for _ in 0..3 {
            motion(&mut now);
            let report = t.commit_positions(&now).expect("a commit");
            assert_eq!(report.rebuilds, 0, "{name}, {}D: {report:?}", G::D);
        }
    }
    fn all_repair<G: Dimension>(side: usize, step: f64) {
        let rng = &mut Rng::new(29);
        let grid = lattice::<G>(side, [1.0; 3], rng);
        repairs::<G>(&grid, |now| now.iter_mut().for_each(|p| p[0] += 1e-3), "a lattice moved");
        let random: Vec<_> = grid.iter().map(|_| point::<G>(|_| side as f64 * rng.unit())).collect();
        repairs::<G>(&random, |now| tremble::<G>(now, step, rng), "random points");
        let far = |now: &mut [Point<G>]| tremble::<G>(&mut now[..grid.len() / 200], side as f64 / 4.0, rng);
        repairs::<G>(&random, far, "few");
    }
    all_repair::<Plane>(130, 0.15);
    all_repair::<Space>(19, 0.06);
}

/// A tenth of a lattice leaves it while the rest stays: those are placed, nothing is built, however they are staged,
/// and also where slack has moved them before it gave up.
#[test]
fn few_vertices_that_leave_a_lattice_are_placed() {
    for (algorithm, is_whole) in
        [(Algorithm::Repair, true), (Algorithm::Repair, false), (Algorithm::Auto, true)]
    {
        let rng = &mut Rng::new(41);
        let mut now = lattice::<Space>(15, [1.0; 3], rng);
        let n = now.len();
        let options = Options { algorithm, threads: 1, ..Options::default() };
        let mut t = MovingTriangulation::<Space>::new(&now, options).expect("a build");
        for _ in 0..4 {
            t.commit_positions(&now).expect("a commit");
        }
        for step in 0..4 {
            let first = step * n / 10;
            tremble::<Space>(&mut now[first..first + n / 10], 1e-4, rng);
            let report = if is_whole {
                t.commit_positions(&now).expect("a commit")
            } else {
                let vertices: Vec<_> = VertexId::range(first..first + n / 10).collect();
                t.move_vertices(&vertices, &now[first..first + n / 10]).expect("room");
                t.commit_timestamp().expect("a commit")
            };
            assert_eq!((report.rebuilds, report.moved), (0, (n / 10) as u64), "{algorithm:?}, step {step}");
            assert!(report.certificates < 40 * n as u64, "{algorithm:?}: {report:?}");
            let positions: Vec<_> = now.iter().copied().map(Some).collect();
            assert_same_cells(&cell_set(&t), &fresh_cells::<Space>(&positions), || format!("{algorithm:?}"));
        }
    }
}
