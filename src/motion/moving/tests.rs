//! Moves of all vertices against moves of single ones.

use super::*;
use crate::delaunay::{Plane, Space};
use crate::error::Error;
use crate::ids::VertexId;
use crate::motion::Options;
use crate::motion::regions::Filter;
use crate::motion::{Algorithm, Level};
use crate::random::Rng;

/// Small whole numbers, and the same ones again.
fn points<G: Dimension>(n: usize, rng: &mut Rng) -> Vec<G::Point> {
    let mut points = vec![G::Point::default(); n];
    points.iter_mut().for_each(|p| (0..G::D).for_each(|axis| p[axis] = (rng.next() >> 40) as f64));
    points
}

fn positions<G: Dimension>(t: &MovingTriangulation<G>) -> Vec<G::Point> {
    t.site_of.iter().map(|&s| t.kernel.site(s).point).collect()
}

/// A triangulation with tolerances, and all its vertices staged: some of them where they are, some with one coordinate
/// that stays, some far away. Returns these places and which are beyond tolerance.
/// They are staged at once, or going to be on the way.
fn staged<G: Dimension>(
    n: usize,
    at_once: bool,
    rng: &mut Rng,
) -> (MovingTriangulation<G>, Vec<G::Point>, Vec<VertexId>) {
    let mut t = MovingTriangulation::<G>::new(&points::<G>(n, rng), Options::default()).expect("room");
    let other_positions = t.staging.positions().to_vec();
    t.regions.prepare(Filter::Tolerance, &mut t.kernel, n, &other_positions).expect("room");
    let mut places = positions(&t);
    let far = points::<G>(n, rng);
    for (p, far) in places.iter_mut().zip(far) {
        match rng.below(5) {
            0 => {}
            1 => *p = far,
            2 => p[0] = p[0].next_up(),
            _ => (0..G::D).for_each(|axis| p[axis] = p[axis].next_down()),
        }
    }
    let fixed = t.regions.fixed();
    let beyond = VertexId::range(0..n).filter(|&v| !fixed[v].holds(&places[v])).collect();
    if at_once {
        t.move_all(&places).expect("good places");
    } else {
        assert!(t.expect_whole(n).expect("room"));
    }
    (t, places, beyond)
}

fn given_unless<G: Dimension>(at_once: bool, places: &[G::Point]) -> Given<'_, G> {
    if at_once { Given::nothing() } else { Given::all(places) }
}

fn agree<G: Dimension>() {
    let rng = &mut Rng::new(5);
    let (mut n_beyond, mut n_moved) = (0, 0);
    // More than a block of them as well.
    for (n, at_once) in (G::D + 1..60).chain([2 * BLOCK + 3]).flat_map(|n| [(n, true), (n, false)]) {
        let (mut t, places, beyond) = staged::<G>(n, at_once, rng);
        let before = positions(&t);
        let is_beyond = |v: usize| beyond.contains(&VertexId::at(v));
        let differ = |v: &usize| before[*v] != places[*v];
        let n_of = |moves_all: bool| (0..n).filter(|&v| moves_all || !is_beyond(v)).filter(differ).count();
        (n_beyond, n_moved) = (n_beyond + beyond.len(), n_moved + n_of(false));

        if !beyond.is_empty() {
            let (most, given) = (beyond.len() - 1, &mut given_unless(at_once, &places));
            assert_eq!(
                t.move_and_queue::<false>(most, given).expect("room"),
                Advance::TooManyBeyond,
                "{n} vertices"
            );
            assert_eq!(
                t.move_and_queue::<true>(most, given).expect("room"),
                Advance::TooManyBeyond,
                "{n} vertices"
            );
            t.stage_given(given).expect("good places");
            assert!(t.staging.vertices().is_empty() && !t.staging.others_applied());
            assert_eq!(
                [&positions(&t)[..], t.staging.positions()],
                [&before[..], &places[..]],
                "{n} vertices"
            );
        }

        let moved = t.move_and_queue::<false>(beyond.len(), &mut given_unless(at_once, &places));
        assert_eq!(moved.expect("room"), Advance::Moved(n_of(false) as u64));
        assert_eq!(t.staging.vertices(), beyond, "{n} vertices");
        for v in 0..n {
            let expected = if is_beyond(v) { [before[v], places[v]] } else { [places[v], before[v]] };
            assert_eq!([positions(&t)[v], t.staging.positions()[v]], expected, "vertex {v} of {n}");
        }

        for moved_by in 0..3 {
            let (mut t, places, beyond) = staged::<G>(n, at_once, rng);
            let given = &mut given_unless(at_once, &places);
            let before = positions(&t);
            let n_moved = (0..n).filter(|&v| before[v] != places[v]).count() as u64;
            if moved_by == 0 {
                assert_eq!(t.move_and_queue::<true>(n, given).expect("room"), Advance::Moved(n_moved));
                assert_eq!(t.staging.vertices(), beyond, "{n} vertices");
            } else if moved_by == 1 {
                assert_eq!(t.move_all_staged(given).expect("good places"), n_moved);
            } else {
                let other_positions = vec![G::Point::default(); n];
                let computed = t.regions.prepare(Filter::Slack, &mut t.kernel, n, &other_positions);
                computed.expect("room");
                assert_eq!(t.move_all_on_record(given).expect("good places").moved, n_moved);
            }
            assert_eq!(
                [&positions(&t)[..], t.staging.positions()],
                [&places[..], &before[..]],
                "{n} vertices"
            );
        }
    }
    assert!(n_beyond > 200 && n_moved > 400, "{n_beyond} beyond, {n_moved} moved");
}

#[test]
fn vertices_of_the_plane_go_where_they_are_told() {
    agree::<Plane>();
}

#[test]
fn vertices_of_space_go_where_they_are_told() {
    agree::<Space>();
}

/// Several threads move what one does.
#[test]
fn threads_share_the_moves() {
    for threads in 1..5 {
        let options = || Options { threads, algorithm: Algorithm::Repair, ..Options::default() };
        let (first, second) =
            (points::<Space>(2_000, &mut Rng::new(1)), points::<Space>(2_000, &mut Rng::new(2)));
        let mut t = MovingTriangulation::<Space>::new(&first, options()).expect("room");
        t.move_all(&second).expect("good places");
        assert_eq!(t.move_all_staged(&mut Given::nothing()).expect("good places"), 2_000);
        assert_eq!([&positions(&t)[..], t.staging.positions()], [&second[..], &first[..]]);
    }
}

/// Wherever a bad position is, all commits say so, and nothing changes.
fn bad_positions_are_refused<G: Dimension>() {
    let n = 5_000;
    let points = points::<G>(n, &mut Rng::new(3));
    let algorithms = [
        Algorithm::Auto,
        Algorithm::Tolerance,
        Algorithm::Repair,
        Algorithm::Watching,
        Algorithm::Slack,
        Algorithm::Rebuilding,
        Algorithm::Placement,
    ];
    for (algorithm, threads) in algorithms.into_iter().flat_map(|algorithm| [(algorithm, 1), (algorithm, 3)])
    {
        let options = Options { threads, algorithm, ..Options::default() };
        let mut t = MovingTriangulation::<G>::new(&points, options).expect("room");
        let mut places = points.clone();
        // What the commits before leave behind differs.
        for n_commits in 0..4 {
            for bad in [0, 1, n / 2, n - 2, n - 1] {
                let mut given = places.clone();
                given.iter_mut().for_each(|p| p[0] += 1.0);
                given[bad][G::D - 1] = if bad == 1 { f64::INFINITY } else { f64::NAN };
                let error = t.commit_positions(&given).expect_err("a bad position");
                let is_it = matches!(
                    error,
                    Error::NotFinite { argument: "positions", index, axis, .. }
                        if index == bad && axis == G::D - 1
                );
                assert!(is_it, "{algorithm:?}: {error:?}");
                assert_eq!((positions(&t), t.staged_count()), (places.clone(), 0), "{algorithm:?}");
                assert_eq!(t.timestamp(), n_commits, "{algorithm:?}");
            }
            for p in &mut places {
                (0..G::D).for_each(|axis| p[axis] += 1e-3);
            }
            t.commit_positions(&places).expect("good positions");
            assert_eq!(positions(&t), places, "{algorithm:?}");
            t.validate(Level::Delaunay).expect("a triangulation");
        }
    }
}

#[test]
fn bad_positions_in_the_plane_are_refused() {
    bad_positions_are_refused::<Plane>();
}

#[test]
fn bad_positions_in_space_are_refused() {
    bad_positions_are_refused::<Space>();
}
