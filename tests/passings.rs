//! Vertices that pass segments: against all pairs, each decided by the roots of a polynomial in integers of any length.

use crate::common::inputs::{KINDS, Kind, draw, draw_one};
use crate::common::passing_by_roots::passes_by_roots;
use crate::common::{Rng, assert_same_cells, cell_set, ids, seeds, vertex};
use deldrift::motion::{Algorithm, MovingTriangulation, Options, PassingPolicy, Segment};
use deldrift::{Error, Passing, Plane, SegmentId, VertexId};
use std::f64::consts::TAU;

type Triangulation = MovingTriangulation<Plane>;
type Place = [f64; 2];

/// By vertex id: where it is before a step, and after; `None` where it is not there both times.
type Paths = Vec<Option<[Place; 2]>>;

/// Where the vertices are that there are.
fn places(t: &Triangulation) -> Vec<Option<Place>> {
    VertexId::range(0..t.id_count()).map(|v| t.position(v).ok()).collect()
}

/// All that pass, by all pairs. `is_near` says of which it is worth asking.
fn all_passings(
    paths: &Paths,
    segments: &[(SegmentId, Segment)],
    is_near: impl Fn(&[Place; 2], &[[Place; 2]; 2]) -> bool,
) -> Vec<Passing> {
    let mut passings = Vec::new();
    for &(segment, Segment { ends, .. }) in segments {
        let [Some(a), Some(b)] = ends.map(|v| paths[v.index()]) else { continue };
        for (v, path) in VertexId::range(0..paths.len()).zip(paths) {
            let Some(p) = path.filter(|p| !ends.contains(&v) && is_near(p, &[a, b])) else { continue };
            if passes_by_roots(&[p, a, b]) {
                passings.push(Passing { segment, vertex: v });
            }
        }
    }
    passings.sort();
    passings
}

fn checked(t: &mut Triangulation, expected: &[Passing], context: &dyn Fn() -> String) {
    let told = t.check_passings();
    assert_eq!(t.passings(), expected, "{}", context());
    match (told, expected) {
        (Ok(()), []) => {}
        (Err(Error::Passing { passing, others }), [first, more @ ..]) => {
            assert_eq!((passing, others), (*first, more.len()), "{}", context());
        }
        (told, _) => panic!("{}: {told:?}", context()),
    }
}

/// A copy with another policy, with all that is staged.
fn with_policy(t: &Triangulation, passing: PassingPolicy, algorithm: Algorithm) -> Triangulation {
    let bytes = t.saved().expect("room");
    let saved = deldrift::motion::Saved::of(&bytes).expect("good data");
    let options = Options { passing, algorithm, ..Options::default() };
    Triangulation::load(&saved, options).expect("room")
}

/// Commits what is staged by each policy, and compares.
fn commit_by_each_policy(
    t: &mut Triangulation,
    algorithm: Algorithm,
    expected: &[Passing],
    context: &dyn Fn() -> String,
) -> bool {
    let mut telling = with_policy(t, PassingPolicy::Tell, algorithm);
    let mut refusing = with_policy(t, PassingPolicy::Refuse, algorithm);
    let before = refusing.saved().expect("room");
    let [told, refused] = [&mut telling, &mut refusing].map(|t| t.commit_timestamp().map(drop));
    assert_eq!(telling.passings(), expected, "{}", context());
    assert_eq!(refusing.passings(), expected, "{}", context());
    if expected.is_empty() {
        assert_eq!(refused, told, "{}", context());
    } else {
        assert!(matches!(refused, Err(Error::Passing { .. })), "{}: {refused:?}", context());
        assert_eq!(refusing.saved().expect("room"), before, "{}", context());
        refusing.validate(deldrift::motion::Level::Delaunay).expect("as before");
        assert_eq!(refusing.check_staged(), refused, "{}", context());
        assert_eq!(refusing.saved().expect("room"), before, "{}", context());
    }
    let done = t.commit_timestamp();
    assert!(t.passings().is_empty(), "{}", context());
    assert_eq!(done.map(drop), told, "{}", context());
    assert_same_cells(&cell_set(t), &cell_set(&telling), context);
    told.is_ok()
}

/// Moves some or all vertices of a kind of motion.
fn goals_of(kind: Kind, places: &[Option<Place>], rng: &mut Rng) -> Vec<Option<Place>> {
    let n = places.len();
    let how = rng.below(6);
    let (turn, shift) = (TAU * rng.unit(), [rng.unit() * 9.0, rng.unit() - 0.5]);
    let (sin, cos) = turn.sin_cos();
    let mut goal = |p: Place| match how {
        // Most move by little.
        0 => p.map(|x| x + 0.1 * (rng.unit() - 0.5)),
        // Some are dealt other places.
        1 if rng.one_in(6) => draw_one::<Plane>(kind, n, rng),
        1 => p,
        // All turn, or all go along.
        2 => [cos * p[0] - sin * p[1], sin * p[0] + cos * p[1]],
        3 => [p[0] + shift[0], p[1] + shift[1]],
        4 => p.map(|x| -x),
        // One moves.
        _ if rng.one_in(n) => draw_one::<Plane>(kind, n, rng),
        _ => p,
    };
    places.iter().map(|place| place.map(&mut goal)).collect()
}

/// A random history of what `check_passings` and the policies tell. Returns how many passed, in how many steps that were
/// refused for nothing else.
fn run(kind: Kind, algorithm: Algorithm, seed: u64) -> [usize; 2] {
    let rng = &mut Rng::new(seed);
    let n = [5, 12, 40][rng.below(3)];
    let options = Options { algorithm, ..Options::default() };
    let mut t = Triangulation::new(&draw::<Plane>(kind, n, rng), options).expect("good points");
    for _ in 0..n {
        let ends = [0; 2].map(|_| VertexId::at(rng.below(n)));
        t.stage_segments([Segment { ends, marker: 0, ..Segment::default() }].into_iter()).expect("present");
        if t.commit_timestamp().is_err() {
            t.discard_moves();
        }
    }
    let [mut n_passing, mut n_done] = [0; 2];
    for step in 0..8 {
        let context = || format!("{kind:?}, {algorithm:?}, seed {seed}, step {step}");
        let before = places(&t);
        let goals = goals_of(kind, &before, rng);
        let stays = rng.below(4);
        let all: Option<Vec<Place>> = goals.iter().copied().collect();
        if let Some(all) = all.filter(|_| stays == 1) {
            t.move_all(&all).expect("good places");
        }
        for (v, (goal, place)) in VertexId::range(0..goals.len()).zip(goals.iter().zip(&before)) {
            if t.staged_count() == goals.len() {
                break;
            }
            if let Some(goal) = goal.filter(|goal| stays == 0 || Some(*goal) != *place) {
                t.move_vertices(&[v], &[goal]).expect("good places");
            }
        }
        let mut paths: Paths =
            before.iter().zip(&goals).map(|(place, goal)| place.zip(*goal).map(|(p, q)| [p, q])).collect();
        let mut segments: Vec<_> = t.segments().collect();
        if rng.one_in(3) {
            t.stage_insertions(&[draw_one::<Plane>(kind, n, rng)]).expect("a good place");
            paths.push(None);
        }
        if rng.one_in(4) {
            let v = VertexId::at(rng.below(before.len()));
            if t.is_present(v) && t.stage_removals(&[v]).is_ok() {
                paths[v.index()] = None;
            }
        }
        if rng.one_in(3)
            && let Some(&(id, _)) = segments.get(rng.below(segments.len().max(1)))
        {
            t.stage_segment_removals(&[id]).expect("in force");
            segments.retain(|&(other, _)| other != id);
        }
        if rng.one_in(3) {
            let ends = [0; 2].map(|_| VertexId::at(rng.below(before.len())));
            if ends.iter().all(|v| paths[v.index()].is_some()) {
                t.stage_segments([Segment { ends, marker: 0, ..Segment::default() }].into_iter())
                    .expect("present");
            }
        }
        let expected = all_passings(&paths, &segments, |_, _| true);
        checked(&mut t, &expected, &context);
        if commit_by_each_policy(&mut t, algorithm, &expected, &context) {
            n_passing += expected.len();
            n_done += 1;
        } else {
            t.discard_moves();
        }
    }
    [n_passing, n_done]
}

#[test]
fn passings_are_those_of_all_pairs() {
    let mut sums = [0; 2];
    for seed in seeds(6) {
        for kind in KINDS {
            for algorithm in [Algorithm::Auto, Algorithm::Rebuilding, Algorithm::PlacementFlips] {
                let counts = run(kind, algorithm, 1000 * seed + kind as u64);
                sums.iter_mut().zip(counts).for_each(|(sum, n)| *sum += n);
            }
        }
    }
    println!("{sums:?} passings, steps");
    assert!(sums.iter().all(|&n| n > 100), "{sums:?}");
}

/// A ring of vertices around a place, and the segments between them.
fn ring(n: usize, first: u32, centre: Place, radius: f64, turn: f64) -> (Vec<Place>, Vec<Segment>) {
    let at = |k: usize| {
        let (sin, cos) = (turn + TAU * k as f64 / n as f64).sin_cos();
        [centre[0] + radius * cos, centre[1] + radius * sin]
    };
    let id = |k: usize| vertex(first + (k % n) as u32);
    (
        (0..n).map(at).collect(),
        (0..n).map(|k| Segment { ends: [id(k), id(k + 1)], marker: 0, ..Segment::default() }).collect(),
    )
}

/// Whether boxes that cover the ways meet.
fn do_boxes_meet(p: &[Place; 2], [a, b]: &[[Place; 2]; 2]) -> bool {
    (0..2).all(|axis| {
        let low = |places: &[Place]| places.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
        let high = |places: &[Place]| places.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max);
        let segment = [*a, *b].concat();
        low(p) <= high(&segment) && low(&segment) <= high(p)
    })
}

/// Many vertices and segments, so that there are several levels of boxes, in motions of all kinds.
#[test]
fn near_pairs_are_found_among_many() {
    let rng = &mut Rng::new(11);
    let mut points: Vec<Place> = (0..2_500).map(|_| [0; 2].map(|_| 2.0 * rng.unit() - 1.0)).collect();
    let mut segments = Vec::new();
    for (radius, n) in [(0.3, 90), (0.7, 130)] {
        let (mut more, mut edges) = ring(n, points.len() as u32, [0.0; 2], radius, 0.1);
        points.append(&mut more);
        segments.append(&mut edges);
    }
    let mut t = Triangulation::new(&points, Options::default()).expect("good points");
    t.stage_segments(segments.into_iter()).expect("present");
    t.commit_timestamp().expect("nothing is in the way");
    let (laid, mut n_passing) = (t.segments().collect::<Vec<_>>(), Vec::new());
    for (motion, how_far) in
        [("jitter", 0.02), ("turn", 0.5), ("shift", 3.0), ("inner turn", 2.0), ("some", 0.1)]
    {
        let (sin, cos) = f64::sin_cos(how_far);
        let goals: Vec<Place> = points
            .iter()
            .enumerate()
            .map(|(v, &p)| match motion {
                "jitter" => p.map(|x| x + how_far * (rng.unit() - 0.5)),
                "shift" => [p[0] + how_far + 0.001 * rng.unit(), p[1] - how_far],
                "some" if v % 40 != 0 => p,
                "some" => p.map(|x| x + how_far * (rng.unit() - 0.5)),
                "inner turn" if p[0].hypot(p[1]) > 0.5 => p,
                _ => [cos * p[0] - sin * p[1], sin * p[0] + cos * p[1]],
            })
            .collect();
        let paths = points.iter().zip(&goals).map(|(&p, &q)| Some([p, q])).collect();
        let expected = all_passings(&paths, &laid, do_boxes_meet);
        let all: Vec<_> = VertexId::range(0..points.len()).collect();
        let moved: Vec<_> = all.iter().copied().filter(|v| goals[v.index()] != points[v.index()]).collect();
        for movers in [all, moved, Vec::new()] {
            let to: Vec<_> = movers.iter().map(|v| goals[v.index()]).collect();
            if movers.is_empty() {
                t.move_all(&goals).expect("good places");
            }
            t.move_vertices(&movers, &to).expect("good places");
            checked(&mut t, &expected, &|| format!("{motion}, {} of them", movers.len()));
            t.discard_moves();
        }
        n_passing.push(expected.len());
    }
    println!("{n_passing:?} passings");
    assert!(n_passing.iter().filter(|&&n| n > 0).count() >= 3, "{n_passing:?}");
}

/// At both ends of the range, and with numbers of all sizes in one step.
#[test]
fn near_pairs_are_found_at_all_sizes() {
    let rng = &mut Rng::new(3);
    let mut n_passing = [0; 3];
    for k in 0..24 {
        let sizes: &[f64] = [&[1e57][..], &[1e-321], &[1e57, 1.0, 1e-60, 1e-310]][k % 3];
        let mut place = || [0; 2].map(|_| *rng.pick(sizes) * (2.0 * rng.unit() - 1.0));
        let points: Vec<Place> = (0..60).map(|_| place()).collect();
        let goals: Vec<Place> = (0..60).map(|_| place()).collect();
        let mut t = Triangulation::new(&points, Options::default()).expect("good points");
        for _ in 0..60 {
            let ends = [0; 2].map(|_| VertexId::at(rng.below(60)));
            t.stage_segments([Segment { ends, marker: 0, ..Segment::default() }].into_iter())
                .expect("present");
            if t.commit_timestamp().is_err() {
                t.discard_moves();
            }
        }
        let paths = points.iter().zip(&goals).map(|(&p, &q)| Some([p, q])).collect();
        let expected = all_passings(&paths, &t.segments().collect::<Vec<_>>(), |_, _| true);
        t.move_all(&goals).expect("good places");
        checked(&mut t, &expected, &|| format!("{sizes:?}, {k}"));
        n_passing[k % 3] += expected.len();
    }
    assert!(n_passing.iter().all(|&n| n > 100), "{n_passing:?}");
}

/// Calls that move one vertex at once are refused as commits are.
#[test]
fn relocations_are_looked_at() {
    let rng = &mut Rng::new(5);
    let (mut points, edges) = ring(20, 0, [0.0; 2], 0.6, 0.0);
    points.extend((0..60).map(|_| [0; 2].map(|_| 2.0 * rng.unit() - 1.0)));
    let new = |passing| {
        let mut t =
            Triangulation::new(&points, Options { passing, ..Options::default() }).expect("good points");
        t.stage_segments(edges.clone().into_iter()).expect("present");
        t.commit_timestamp().expect("nothing is in the way");
        t
    };
    let mut refusing = new(PassingPolicy::Refuse);
    let mut n_refused = 0;
    for k in 0..400 {
        let v = VertexId::at(rng.below(points.len()));
        let q = [0; 2].map(|_| 2.0 * rng.unit() - 1.0);
        let mut telling = refusing.try_clone(None).expect("room");
        let mut paths: Paths = places(&refusing).iter().map(|p| p.map(|p| [p, p])).collect();
        paths[v.index()].as_mut().expect("present")[1] = q;
        let expected = all_passings(&paths, &refusing.segments().collect::<Vec<_>>(), |_, _| true);
        let before = refusing.saved().expect("room");
        let moved = refusing.relocate_vertex(v, &q);
        assert_eq!(refusing.passings(), expected, "{k}");
        if !expected.is_empty() {
            n_refused += 1;
            assert!(matches!(moved, Err(Error::Passing { .. })), "{k}: {moved:?}");
            assert_eq!(refusing.saved().expect("room"), before, "{k}");
        }
        telling.move_vertices(&[v], &[q]).expect("a good place");
        checked(&mut telling, &expected, &|| format!("step {k}"));
    }
    assert!(n_refused > 50 && n_refused < 350, "{n_refused}");
    let mut telling = new(PassingPolicy::Tell);
    let inside = (20..80).map(vertex).find(|&v| {
        let [x, y] = telling.position(v).expect("present");
        x.hypot(y) < 0.5
    });
    telling.relocate_vertex(inside.expect("some are inside"), &[3.0, 0.01]).expect("it is only told");
    assert_eq!(telling.passings().len(), 1);
}

fn passings_of(t: &mut Triangulation, v: &[VertexId], to: &[Place]) -> Vec<(u32, u32)> {
    t.move_vertices(v, to).expect("good places");
    let is_told = t.check_passings().is_err();
    let told: Vec<_> = t.passings().iter().map(|p| (p.segment.get(), p.vertex.get())).collect();
    assert_eq!(is_told, !told.is_empty());
    t.discard_moves();
    told
}

/// A slit in a square, with vertices around it.
fn with_slit() -> Triangulation {
    let points = [
        [-9.0, -9.0],
        [9.0, -9.0],
        [9.0, 9.0],
        [-9.0, 9.0],
        [0.0, -2.0],
        [0.0, 2.0],
        [-1.0, 0.0],
        [0.0, 2.0],
        [-3.0, 7.0],
    ];
    let mut t = Triangulation::new(&points, Options::default()).expect("good points");
    let slit = Segment { ends: ids([4, 5]), marker: 0, ..Segment::default() };
    t.stage_segments([slit].into_iter()).expect("present");
    t.commit_timestamp().expect("nothing is in the way");
    t
}

#[test]
fn a_vertex_goes_across_a_slit() {
    let mut t = with_slit();
    let v = vertex(6);
    assert_eq!(passings_of(&mut t, &[v], &[[1.0, 0.0]]), [(0, 6)]);
    assert_eq!(passings_of(&mut t, &[v], &[[-0.5, 0.0]]), []);
    // Around the end, and exactly through it.
    assert_eq!(passings_of(&mut t, &[v], &[[1.0, 5.0]]), []);
    assert_eq!(passings_of(&mut t, &[v], &[[1.0, 4.0]]), [(0, 6)]);
    // The slit goes over it, and along with it.
    assert_eq!(passings_of(&mut t, &ids([4, 5]), &[[-2.0, -2.0], [-2.0, 2.0]]), [(0, 6)]);
    assert_eq!(passings_of(&mut t, &ids([4, 5, 6]), &[[-2.0, -2.0], [-2.0, 2.0], [-3.0, 0.0]]), []);
    // Half a turn of the slit about its middle, which takes the ends through each other.
    assert_eq!(passings_of(&mut t, &ids([4, 5]), &[[0.0, 2.0], [0.0, -2.0]]), []);
    // From the outside of the mesh to its other outside: through no segment, and through the slit.
    assert_eq!(passings_of(&mut t, &[vertex(8)], &[[20.0, 7.0]]), []);
    assert_eq!(passings_of(&mut t, &[vertex(0)], &[[9.0, 8.0]]), [(0, 0)]);
}

/// A hidden vertex shares the place of an end: it goes to either side, and is on none while it is there.
#[test]
fn hidden_vertices_part_to_either_side() {
    let mut t = with_slit();
    assert_eq!(t.coincident_representative(vertex(7)), Ok(vertex(5)));
    for to in [[-1.0, 0.5], [1.0, 0.5], [0.0, 3.0]] {
        assert_eq!(passings_of(&mut t, &[vertex(7)], &[to]), []);
    }
    // It goes along with the end, or is left where the end was.
    assert_eq!(passings_of(&mut t, &ids([5, 7]), &[[1.0, 2.0], [1.0, 2.0]]), []);
    assert_eq!(passings_of(&mut t, &[vertex(5)], &[[1.0, 3.0]]), []);
    // Two at one place, and both go through.
    t.move_vertices(&[vertex(7)], &[[-1.0, 0.0]]).expect("a good place");
    t.commit_timestamp().expect("nothing is in the way");
    assert_eq!(passings_of(&mut t, &ids([6, 7]), &[[1.0, 0.0], [1.0, 1.0]]), [(0, 6), (0, 7)]);
}

/// What does not move, or is not in force on both sides, is not looked at.
#[test]
fn what_comes_or_goes_is_not_looked_at() {
    let mut t = with_slit();
    let slit = SegmentId::new(0);
    t.stage_segment_removals(&[slit]).expect("in force");
    assert_eq!(passings_of(&mut t, &[vertex(6)], &[[1.0, 0.0]]), []);
    t.stage_segments([Segment { ends: ids([6, 8]), marker: 0, ..Segment::default() }].into_iter())
        .expect("present");
    assert_eq!(passings_of(&mut t, &[vertex(0)], &[[0.0, 9.0]]), []);
    t.stage_insertions(&[[0.5, 0.0]]).expect("a good place");
    assert_eq!(t.check_passings(), Ok(()));
    t.discard_moves();
    // Without segments nothing is looked at, and nothing is told.
    let mut plain = Triangulation::new(&[[0.0; 2], [1.0, 0.0]], Options::default()).expect("good points");
    plain.move_vertices(&[vertex(0)], &[[2.0, 0.0]]).expect("a good place");
    assert_eq!((plain.check_passings(), plain.passings()), (Ok(()), &[][..]));
}

/// A loop jumps over a vertex, which is told of the two segments that have gone over it; a hole that turns by a half is
/// told of what it goes over.
#[test]
fn loops_jump_and_turn() {
    let (mut points, edges) = ring(4, 0, [0.0; 2], 1.0, 0.3);
    points.extend([[5.0, 0.0], [-9.0, -9.0], [19.0, -9.0], [5.0, 19.0]]);
    let mut t = Triangulation::new(&points, Options::default()).expect("good points");
    t.stage_segments(edges.into_iter()).expect("present");
    t.commit_timestamp().expect("nothing is in the way");
    let loop_ids = ids([0, 1, 2, 3]);
    let shifted: Vec<Place> = points[..4].iter().map(|p| [p[0] + 10.0, p[1]]).collect();
    let told = passings_of(&mut t, &loop_ids, &shifted);
    assert!(told.len() == 2 && told.iter().all(|&(_, v)| v == 4), "{told:?}");
    // Half way the vertex is inside, so that one segment has gone over it.
    let onto: Vec<Place> = points[..4].iter().map(|p| [p[0] + 5.1, p[1]]).collect();
    assert_eq!(passings_of(&mut t, &loop_ids, &onto).len(), 1);
    t.move_vertices(&loop_ids, &shifted).expect("good places");
    t.commit_timestamp().expect("positions alone are compared");
    // Straight ways of a half turn go through the middle: each end through the segments on the other side.
    let turned: Vec<Place> = shifted.iter().map(|p| [20.0 - p[0], -p[1]]).collect();
    let told = passings_of(&mut t, &loop_ids, &turned);
    assert!(told.iter().all(|&(segment, v)| segment < 4 && v < 4), "{told:?}");
    let small: Vec<Place> = ring(4, 0, [10.0, 0.0], 1.0, 0.4).0;
    assert_eq!(passings_of(&mut t, &loop_ids, &small), []);
}

/// By way of positions that the program lends, too.
#[test]
fn lent_positions_are_looked_at() {
    let mut t = with_slit();
    let mut goals: Vec<Place> = places(&t).into_iter().flatten().collect();
    t.remove_vertex(vertex(7)).expect("present");
    for (algorithm, is_whole) in
        [(Algorithm::Auto, true), (Algorithm::Rebuilding, true), (Algorithm::Auto, false)]
    {
        let mut t = with_policy(&t, PassingPolicy::Refuse, algorithm);
        let mut goals = goals.clone();
        if is_whole {
            t.compact().expect("room");
            goals.remove(7);
        }
        let before = t.saved().expect("room");
        goals[6] = [1.0, 0.0];
        let refused = t.commit_positions(&goals).expect_err("it passes the slit");
        assert_eq!(refused.to_string(), "vertex 6 passes segment 0");
        assert_eq!(t.passings(), [Passing { segment: SegmentId::new(0), vertex: vertex(6) }]);
        assert_eq!((t.saved().expect("room"), t.staged_count()), (before, 0));
        goals[6] = [f64::NAN, 0.0];
        assert!(matches!(t.commit_positions(&goals), Err(Error::NotFinite { index: 6, .. })));
        goals[6] = [-0.5, 0.0];
        t.commit_positions(&goals).expect("it stays on its side");
        assert_eq!((t.passings(), t.timestamp()), (&[][..], 2));
    }
    goals[6] = [1.0, 0.0];
    let mut telling = with_policy(&t, PassingPolicy::Tell, Algorithm::Auto);
    telling.commit_positions(&goals).expect("it is only told");
    assert_eq!(telling.passings().len(), 1);
}
