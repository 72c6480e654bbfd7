//! Moves of all vertices against moves of single ones.

use super::*;
use crate::delaunay::{Level, Plane, Space};
use crate::error::Error;
use crate::ids::VertexId;
use crate::motion::algorithms::Algorithm;
use crate::motion::filters::store::TimestampSteps;
use crate::motion::options::Options;
use crate::motion::region_kind::RegionKind;
use crate::motion::state::goals::Movers;
use crate::motion::state::segments::Aim;
use crate::motion::triangulation::MovingTriangulation;
use crate::random::Rng;

/// Small whole numbers, and the same ones again.
fn points<G: Moving>(n: usize, rng: &mut Rng) -> Vec<G::Point> {
    let mut points = vec![G::Point::default(); n];
    points.iter_mut().for_each(|p| (0..G::D).for_each(|axis| p[axis] = (rng.next() >> 40) as f64));
    points
}

fn positions<G: Moving>(t: &MovingTriangulation<G>) -> Vec<G::Point> {
    t.mesh.site_of.iter().map(|&s| t.mesh.kernel.site(s).point).collect()
}

fn steps<G: Moving>(other_positions: &[G::Point]) -> TimestampSteps<'_, G> {
    TimestampSteps { other_positions, watched_share: 1.0 }
}

/// A triangulation with tolerances, and goals of all its vertices: some of them where they are, some with one
/// coordinate that stays, some far away. Returns these places and which are beyond tolerance.
fn aimed<G: Moving>(n: usize, rng: &mut Rng) -> (MovingTriangulation<G>, Vec<G::Point>, Vec<VertexId>) {
    let mut t = MovingTriangulation::<G>::new(&points::<G>(n, rng), Options::default()).expect("room");
    t.regions.prepare(RegionKind::Tolerance, &mut t.mesh.kernel, n, steps(&[])).expect("room");
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
    t.mesh.begin(Aim::Commit).expect("room");
    (t, places, beyond)
}

/// Moves of all vertices, lent or as if they were staged.
fn moves_of<G: Moving>(are_lent: bool, places: &[G::Point]) -> Moves<'_, G> {
    if are_lent { Moves::lent(places) } else { Moves::staged(places, Movers::All) }
}

fn origins<G: Moving>(t: &MovingTriangulation<G>) -> &[G::Point] {
    assert!(t.mesh.transaction.origins().are_of_all());
    t.mesh.transaction.origins().positions()
}

fn move_and_queue<G: Moving, const MOVES_ALL: bool>(
    t: &mut MovingTriangulation<G>,
    most: usize,
    moves: &mut Moves<'_, G>,
    queue: &mut Vec<VertexId>,
) -> Result<Advance> {
    let mut beyond = Beyond { fixed: t.regions.fixed(), most, queue };
    t.mesh.move_and_queue::<MOVES_ALL>(moves, &mut beyond)
}

fn agree<G: Moving>() {
    let rng = &mut Rng::new(5);
    let (mut n_beyond, mut n_moved) = (0, 0);
    // More than a block of them as well.
    for (n, are_lent) in (G::D + 1..60).chain([2 * BLOCK + 3]).flat_map(|n| [(n, true), (n, false)]) {
        let (mut t, places, beyond) = aimed::<G>(n, rng);
        let before = positions(&t);
        let is_beyond = |v: usize| beyond.contains(&VertexId::at(v));
        let differ = |v: &usize| before[*v] != places[*v];
        let n_of = |moves_all: bool| (0..n).filter(|&v| moves_all || !is_beyond(v)).filter(differ).count();
        (n_beyond, n_moved) = (n_beyond + beyond.len(), n_moved + n_of(false));
        let (mut moves, mut queue) = (moves_of(are_lent, &places), Vec::new());

        if !beyond.is_empty() {
            let most = beyond.len() - 1;
            for moved in [
                move_and_queue::<G, false>(&mut t, most, &mut moves, &mut queue),
                move_and_queue::<G, true>(&mut t, most, &mut moves, &mut queue),
            ] {
                assert_eq!(moved.expect("room"), Advance::TooManyBeyond, "{n} vertices");
            }
            assert!(queue.is_empty() && !t.mesh.transaction.origins().are_of_all());
            assert_eq!(positions(&t), before, "{n} vertices");
        }

        let moved = move_and_queue::<G, false>(&mut t, beyond.len(), &mut moves, &mut queue);
        assert_eq!(moved.expect("room"), Advance::Moved(n_of(false) as u64));
        assert_eq!(queue, beyond, "{n} vertices");
        assert_eq!(origins(&t), before, "{n} vertices");
        for v in 0..n {
            let expected = if is_beyond(v) { before[v] } else { places[v] };
            assert_eq!(positions(&t)[v], expected, "vertex {v} of {n}");
        }
        t.undo();
        assert_eq!(positions(&t), before, "{n} vertices");

        for moved_by in 0..3 {
            let (mut t, places, beyond) = aimed::<G>(n, rng);
            let moves = &mut moves_of(are_lent, &places);
            let before = positions(&t);
            let n_moved = (0..n).filter(|&v| before[v] != places[v]).count() as u64;
            if moved_by == 0 {
                let moved = move_and_queue::<G, true>(&mut t, n, moves, &mut queue);
                assert_eq!(moved.expect("room"), Advance::Moved(n_moved));
                assert_eq!(queue, beyond, "{n} vertices");
            } else if moved_by == 1 {
                assert_eq!(t.mesh.move_everything(moves).expect("good places"), n_moved);
            } else {
                let other_positions = vec![G::Point::default(); n];
                let computed =
                    t.regions.prepare(RegionKind::Slack, &mut t.mesh.kernel, n, steps(&other_positions));
                computed.expect("room");
                let slacks = t.regions.slacks().expect("they are computed");
                assert_eq!(t.mesh.move_all_on_record(moves, slacks).expect("good places").moved, n_moved);
            }
            assert_eq!([&positions(&t)[..], origins(&t)], [&places[..], &before[..]], "{n} vertices");
            t.undo();
            assert_eq!(positions(&t), before, "{n} vertices");
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
        t.mesh.begin(Aim::Commit).expect("room");
        assert_eq!(t.mesh.move_everything(&mut Moves::lent(&second)).expect("good places"), 2_000);
        assert_eq!([&positions(&t)[..], origins(&t)], [&second[..], &first[..]]);
    }
}

/// Wherever a bad position is, all commits say so, and nothing changes.
fn bad_positions_are_refused<G: Moving>() {
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
