//! Runs of thousands of commits: whatever is kept from commit to commit stays as it is after the first ones. And the
//! first histories of `make soak`.

use crate::common::{Rng, assert_same_cells, cell_set, fresh_cells, seeds};
use crate::histories;
use deldrift::motion::{Algorithm, Level, MovingTriangulation, Options};
use deldrift::{Dimension, Plane, Shape, Space};

const COMMITS: usize = 10_000;

/// How the vertices go on, all at once.
type Motion<G> = fn(&mut Vec<<G as Shape>::Point>, &mut Rng);

/// A step so long that nearly all tolerances have to be computed in each commit.
fn shake<G: Dimension>(points: &mut Vec<G::Point>, rng: &mut Rng) {
    for p in points {
        for k in 0..G::D {
            p[k] = (p[k] + 0.1 * rng.unit() - 0.05).clamp(0.0, 1.0);
        }
    }
}

/// A hundredth of the cloud's extent along the first axis, and a little on their own.
fn drift<G: Dimension>(points: &mut Vec<G::Point>, rng: &mut Rng) {
    for p in points {
        p[0] += 0.01;
        for k in 0..G::D {
            p[k] += 0.001 * (rng.unit() - 0.5);
        }
    }
}

/// The exact evaluations of the first commits after the warm-up and of the last ones, as many.
fn run<G: Dimension>(algorithm: Algorithm, n: usize, motion: Motion<G>) -> (u64, u64) {
    let rng = &mut Rng::new(7);
    let mut points = vec![G::Point::default(); n];
    for p in &mut points {
        (0..G::D).for_each(|k| p[k] = rng.unit());
    }
    let options = Options { algorithm, ..Options::default() };
    let mut t = MovingTriangulation::<G>::new(&points, options).expect("points");
    let mut exact = Vec::new();
    for step in 1..=COMMITS {
        motion(&mut points, rng);
        exact.push(t.commit_positions(&points).expect("a commit").exact_calls);
        if step % (COMMITS / 20) == 0 || step == COMMITS {
            t.validate(Level::Delaunay)
                .unwrap_or_else(|wrong| panic!("{algorithm:?}, commit {step}: {wrong}"));
            let now: Vec<_> = points.iter().copied().map(Some).collect();
            assert_same_cells(&cell_set(&t), &fresh_cells::<G>(&now), || {
                format!("{algorithm:?}, commit {step}")
            });
        }
    }
    let tenth = COMMITS / 10;
    (exact[..tenth].iter().sum(), exact[COMMITS - tenth..].iter().sum())
}

/// Exact evaluations do not become more frequent: the bounds of the filters are as sharp as at first.
fn stays_as_it_is<G: Dimension>(algorithm: Algorithm, n: usize, motion: Motion<G>) {
    let (first, last) = run::<G>(algorithm, n, motion);
    assert!(
        last <= 2 * first + COMMITS as u64 / 100,
        "{algorithm:?}: {first} exact evaluations, then {last}"
    );
}

#[test]
fn ten_thousand_commits_with_tolerances_in_the_plane() {
    stays_as_it_is::<Plane>(Algorithm::Tolerance, 40, shake::<Plane>);
}

#[test]
fn ten_thousand_commits_with_tolerances_in_space() {
    stays_as_it_is::<Space>(Algorithm::Tolerance, 40, shake::<Space>);
}

#[test]
fn ten_thousand_commits_of_a_drifting_cloud_in_the_plane() {
    for algorithm in [Algorithm::Auto, Algorithm::Repair, Algorithm::Tolerance, Algorithm::PlacementFlips] {
        stays_as_it_is::<Plane>(algorithm, 40, drift::<Plane>);
    }
}

#[test]
fn ten_thousand_commits_of_a_drifting_cloud_in_space() {
    for algorithm in [Algorithm::Auto, Algorithm::Repair, Algorithm::Tolerance, Algorithm::PlacementFlips] {
        stays_as_it_is::<Space>(algorithm, 40, drift::<Space>);
    }
}

/// Those of the plane or of space: the checksums are the same in every build.
fn soak<G: Dimension>() {
    let mut sum = histories::Tally::default();
    for (seed, &recorded) in (0..).zip(&histories::RECORDED) {
        if histories::dimension_of(seed) == G::D {
            let outcome = histories::run(seed, false);
            assert_eq!(outcome.checksum, recorded, "seed {seed}: {:#018x}", outcome.checksum);
            sum.add(&outcome.tally);
        }
    }
    // They do what they are for.
    let rare = sum.loads.min(sum.clones).min(sum.compactions).min(sum.insertions).min(sum.removals);
    let ways = sum.flips.min(sum.placements).min(sum.rebuilds).min(sum.within_tolerance);
    assert!(sum.comparisons > sum.commits && 50 * rare > sum.commits && 10 * ways > sum.commits, "{sum:?}");
}

#[test]
fn the_first_histories_of_the_soak_in_the_plane() {
    soak::<Plane>();
}

#[test]
fn the_first_histories_of_the_soak_in_space() {
    soak::<Space>();
}

/// In boxes that repeat: those of the first seeds that have one.
#[test]
fn histories_in_boxes() {
    let mut sum = histories::Tally::default();
    for k in seeds(30) {
        sum.add(&histories::run(44 + 5 * k, false).tally);
    }
    // They do what they are for.
    let rare = sum.rebuilds.min(sum.insertions).min(sum.removals).min(sum.validations);
    assert!(rare > 0 && sum.moves > sum.commits && sum.rebuilds < sum.commits, "{sum:?}");
}

/// Of meshes that are coarsened and refined: those of the first seeds that have one.
#[test]
fn histories_of_meshes() {
    let mut sum = histories::Tally::default();
    for k in seeds(30) {
        sum.add(&histories::run(42 + 10 * k, false).tally);
    }
    // They do what they are for.
    let rare = sum.loads.min(sum.clones).min(sum.compactions).min(sum.insertions).min(sum.removals);
    let of_meshes = sum.made_anew.min(sum.rests).min(sum.refusals);
    assert!(rare.min(of_meshes) > 0 && sum.refined > 10 * sum.commits, "{sum:?}");
}

/// Those of meshes that have found something: pieces that were joined beside flat cells, of which the cells beyond were
/// not told, and pieces that were joined up to a vertex that shared the place of their end.
#[test]
fn histories_of_meshes_that_have_found_defects() {
    for seed in [1872, 2102, 2152, 2252, 2752, 2812, 3542, 5962, 13_082] {
        assert!(histories::run(seed, false).tally.refined > 0);
    }
}
