//! Segments that are split where they are in each other's way: against all pairs in exact integers, and fresh builds.

use crate::common::{Rng, assert_same_cells, cell_set, seeds};
use deldrift::motion::{
    Algorithm, CoarsenOptions, Level, MovingTriangulation, Options, Quality, RefineOptions, Saved, Segment,
    SplitReport,
};
use deldrift::{Conflict, Error, Plane, SegmentId, VertexId};
use num_bigint::{BigInt, Sign};
use std::collections::{BTreeMap, BTreeSet};

type Triangulation = MovingTriangulation<Plane>;

/// The exponent of the last places of a number.
fn exponent_of(x: f64) -> u64 {
    (x.to_bits() >> 52 & 2047).max(1)
}

/// The least exponent of last places of these numbers.
fn least_exponent(places: &[Option<[f64; 2]>]) -> u64 {
    let numbers = places.iter().flatten().flatten().filter(|&&x| x != 0.0);
    numbers.map(|&x| exponent_of(x)).min().unwrap_or(1)
}

/// A number without rounding, in units of such a place.
fn whole(x: f64, least: u64) -> BigInt {
    let fraction = x.to_bits() & ((1 << 52) - 1);
    let is_normal = x.to_bits() >> 52 & 2047 != 0;
    let digits = BigInt::from(if is_normal { fraction | 1 << 52 } else { fraction });
    let magnitude = if x == 0.0 { digits } else { digits << (exponent_of(x) - least) as usize };
    if x < 0.0 { -magnitude } else { magnitude }
}

type Whole = [BigInt; 2];

fn cross(a: &Whole, b: &Whole, c: &Whole) -> BigInt {
    (&b[0] - &a[0]) * (&c[1] - &a[1]) - (&b[1] - &a[1]) * (&c[0] - &a[0])
}

fn turn(a: &Whole, b: &Whole, c: &Whole) -> i32 {
    match cross(a, b, c).sign() {
        Sign::Minus => -1,
        Sign::NoSign => 0,
        Sign::Plus => 1,
    }
}

fn positions(t: &Triangulation) -> Vec<Option<[f64; 2]>> {
    VertexId::range(0..t.id_count()).map(|v| t.position(v).ok()).collect()
}

/// Checks by all pairs that no two segments cross, and that no vertex is on one but at its ends.
fn check_no_conflicts(t: &Triangulation, context: &dyn Fn() -> String) {
    let places = positions(t);
    let least = least_exponent(&places);
    let wholes: Vec<Option<Whole>> = places.iter().map(|p| p.map(|p| p.map(|x| whole(x, least)))).collect();
    let at = |v: VertexId| wholes[v.index()].as_ref().expect("present");
    let number = |v: VertexId| places[v.index()].expect("present");
    let edges: BTreeSet<[VertexId; 2]> = t
        .segments()
        .map(|(_, segment)| {
            let mut ends = segment.ends.map(|v| t.coincident_representative(v).expect("present"));
            ends.sort();
            ends
        })
        .collect();
    let edges: Vec<_> = edges.into_iter().collect();
    let range = |[v, w]: [VertexId; 2], k: usize| {
        let (x, y) = (number(v)[k], number(w)[k]);
        [x.min(y), x.max(y)]
    };
    for (i, &[a, b]) in edges.iter().enumerate() {
        let box_of = [range([a, b], 0), range([a, b], 1)];
        for (v, p) in places.iter().enumerate() {
            let Some(p) = p else { continue };
            let is_in = (0..2).all(|k| box_of[k][0] <= p[k] && p[k] <= box_of[k][1]);
            if is_in && *p != number(a) && *p != number(b) {
                let at_vertex = wholes[v].as_ref().expect("present");
                assert!(turn(at(a), at(b), at_vertex) != 0, "{}: {v} is on {a}, {b}", context());
            }
        }
        for &[c, d] in &edges[..i] {
            let other = [range([c, d], 0), range([c, d], 1)];
            if (0..2).any(|k| box_of[k][1] < other[k][0] || other[k][1] < box_of[k][0]) {
                continue;
            }
            let are_apart = |a, b, c, d| turn(at(a), at(b), at(c)) * turn(at(a), at(b), at(d)) < 0;
            let is_crossed = are_apart(a, b, c, d) && are_apart(c, d, a, b);
            assert!(!is_crossed, "{}: {a}, {b} and {c}, {d} cross", context());
        }
    }
}

/// Checks the cells against those of a fresh build with the same ids.
fn check_fresh(t: &Triangulation, context: &dyn Fn() -> String) {
    t.validate(Level::Delaunay).unwrap_or_else(|violation| panic!("{}: {violation:?}", context()));
    let points: Vec<_> = positions(t).into_iter().map(|p| p.unwrap_or([1e50, 1e50])).collect();
    let mut fresh = Triangulation::new(&points, Options::default()).expect("good points");
    for v in VertexId::range(0..t.id_count()).filter(|&v| !t.is_present(v)) {
        fresh.remove_vertex(v).expect("present");
    }
    fresh
        .stage_segments(t.segments().map(|(_, segment)| segment).collect::<Vec<_>>().into_iter())
        .expect("present");
    fresh.commit_timestamp().expect("no conflict");
    assert_same_cells(&cell_set(t), &cell_set(&fresh), context);
}

/// Segments before a split, with the originals they come from.
type Parents = BTreeMap<SegmentId, (Segment, SegmentId)>;

/// Checks that each segment of before is there, or that a chain of pieces is in its place: in order, beside it, with its
/// marker and its original. `places` are those that the commit leads to.
fn check_chains(t: &Triangulation, parents: &Parents, report: &SplitReport, context: &dyn Fn() -> String) {
    let in_force: BTreeMap<SegmentId, Segment> = t.segments().collect();
    let least = least_exponent(&positions(t));
    let mut next = report.first_piece;
    let mut n_replaced = 0;
    for (&id, &(parent, original)) in parents {
        if let Some(&segment) = in_force.get(&id) {
            assert_eq!((segment, t.original_segment(id)), (parent, original), "{}", context());
            continue;
        }
        n_replaced += 1;
        let place = |v| t.position(v).expect("present");
        let [from, to] = parent.ends.map(place);
        let [a, b] = [from, to].map(|p| p.map(|x| whole(x, least)));
        // So many halves of a last place of the greatest coordinates.
        let greatest = from.iter().chain(&to).fold(0.0, |most: f64, x| most.max(x.abs()));
        let room = (whole(greatest.next_up(), least) - whole(greatest, least)) * BigInt::from(report.rounds);
        let length = (&b[0] - &a[0]).magnitude() + (&b[1] - &a[1]).magnitude();
        let (mut at, mut n) = (parent.ends[0], 0);
        while at != parent.ends[1] {
            let piece = in_force[&next];
            assert_eq!((piece.ends[0], piece.marker), (at, parent.marker), "{}: {next}", context());
            assert_eq!(t.original_segment(next), original, "{}: {next}", context());
            let (p, q) = (place(at), place(piece.ends[1]));
            let ascends = |k: usize| if from[k] <= to[k] { p[k] <= q[k] } else { p[k] >= q[k] };
            assert!(ascends(0) && ascends(1) && p != q, "{}: {p:?}, {q:?}", context());
            let off = cross(&a, &b, &q.map(|x| whole(x, least))) * BigInt::from(2);
            assert!(*off.magnitude() <= (&length * room.magnitude()), "{}: {q:?}", context());
            (at, next, n) = (piece.ends[1], SegmentId::new(next.get() + 1), n + 1);
        }
        assert!(n > 1, "{}", context());
    }
    assert_eq!(next.index() - report.first_piece.index(), report.pieces, "{}", context());
    assert_eq!(n_replaced, report.replaced_segments, "{}", context());
    assert!(in_force.keys().all(|id| parents.contains_key(id) || report.first_piece <= *id && *id < next));
    for k in 0..report.inserted {
        assert!(t.is_present(VertexId::at(report.first_vertex.index() + k)), "{}", context());
    }
}

const N_KINDS: usize = 9;

/// Points of some kind.
fn draw(kind: usize, n: usize, rng: &mut Rng) -> Vec<[f64; 2]> {
    let mut point = |k: usize| match kind {
        0 => [rng.unit(), rng.unit()],
        1 => [rng.below(7) as f64, rng.below(7) as f64],
        // Many on a line.
        2 if !rng.one_in(4) => {
            let x = rng.below(40) as f64;
            [3.0 * x, x]
        }
        2 => [rng.below(100) as f64, rng.below(40) as f64],
        // Pairs whose segments go all but through one place, which is no number.
        3 => {
            let angle = (k / 2) as f64 * 0.7;
            let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
            [0.1 + sign * angle.cos(), 1.0 / 3.0 + sign * angle.sin()]
        }
        // Ends a few last places from each other.
        4 => {
            let y = 0.7 + rng.below(9) as f64 * f64::EPSILON;
            [if k.is_multiple_of(2) { rng.unit() * 1e-3 } else { 1.0 - rng.unit() * 1e-3 }, y]
        }
        5 => [0; 2].map(|_| 1.0 + rng.below(9) as f64 * f64::EPSILON),
        // Of very different lengths, and close to zero.
        6 => [0; 2].map(|_| (rng.unit() - 0.5) * 10f64.powi(-(rng.below(40) as i32))),
        7 => [0; 2].map(|_| f64::from_bits(rng.below(6) as u64)),
        // All but on a line, which no two numbers are on.
        _ => {
            let share = rng.unit();
            [0.3 + share * 0.7, 0.1 + share / 3.0]
        }
    };
    (0..n).map(&mut point).collect()
}

fn random_segments(kind: usize, n_ids: usize, n: usize, rng: &mut Rng) -> Vec<Segment> {
    (0..n)
        .map(|k| {
            let pair = rng.below(n_ids / 2);
            let are_pairs = kind == 3 || kind == 4;
            let ends = if are_pairs { [2 * pair, 2 * pair + 1] } else { [0; 2].map(|_| rng.below(n_ids)) };
            Segment { ends: ends.map(VertexId::at), marker: k as i32 - 3, ..Segment::default() }
        })
        .collect()
}

/// Without those whose ends would be at one place.
fn with_two_ends(segments: Vec<Segment>, place: impl Fn(VertexId) -> [f64; 2]) -> Vec<Segment> {
    segments.into_iter().filter(|segment| place(segment.ends[0]) != place(segment.ends[1])).collect()
}

/// What is there after a split, whatever the order and the directions of segments: places by id, and edges.
#[allow(clippy::type_complexity)]
fn outcome(t: &Triangulation) -> (Vec<Option<[f64; 2]>>, BTreeSet<[VertexId; 2]>) {
    let mut edges = BTreeSet::new();
    for (_, segment) in t.segments() {
        let mut ends = segment.ends;
        ends.sort();
        edges.insert(ends);
    }
    (positions(t), edges)
}

fn parents_of(t: &Triangulation) -> Parents {
    t.segments().map(|(id, segment)| (id, (segment, t.original_segment(id)))).collect()
}

/// Segments in three batches, with vertices that move in between.
fn run(kind: usize, algorithm: Algorithm, seed: u64) -> [usize; 3] {
    let rng = &mut Rng::new(seed);
    // Where vertices are in few rows, there are as many pieces as segments times vertices.
    let is_small = matches!(kind, 4 | 5 | 7);
    let n = 2 * if is_small { [3, 4, 6, 9] } else { [4, 8, 15, 30] }[rng.below(4)];
    let options = || Options { algorithm, ..Options::default() };
    let points = draw(kind, n, rng);
    let mut t = Triangulation::new(&points, options()).expect("good points");
    let mut counts = [0; 3];
    for batch in 0..3 {
        let context = || format!("kind {kind}, {algorithm:?}, seed {seed}, batch {batch}");
        let mut parents = parents_of(&t);
        let mut goals: Vec<_> = positions(&t).into_iter().map(|p| p.expect("present")).collect();
        if batch == 1 {
            // All are halved, which is exact for all but the smallest numbers, and one goes anywhere.
            if kind != 7 {
                goals.iter_mut().flatten().for_each(|x| *x *= 0.5);
                t.move_all(&goals).expect("good places");
            }
        } else if batch == 2 {
            let v = rng.below(n);
            let goal = draw(kind, 2, rng)[rng.below(2)];
            t.move_vertices(&[VertexId::at(v)], &[goal]).expect("a good place");
            goals[v] = goal;
        }
        let fresh_points = draw(kind, 2, rng);
        t.stage_insertions(&fresh_points).expect("good places");
        goals.extend(fresh_points);
        let place = |v: VertexId| goals[v.index()];
        // Of those in force, too, ends may meet.
        let met: Vec<_> = parents
            .iter()
            .filter(|(_, (s, _))| place(s.ends[0]) == place(s.ends[1]))
            .map(|(&id, _)| id)
            .collect();
        t.stage_segment_removals(&met).expect("in force");
        met.iter().for_each(|id| _ = parents.remove(id));
        if batch > 0
            && rng.one_in(2)
            && let Some(&id) = parents.keys().next()
        {
            t.stage_segment_removals(&[id]).expect("in force");
            parents.remove(&id);
        }
        let n_segments = 1 + rng.below(n / 2);
        let segments = with_two_ends(random_segments(kind, goals.len() & !1, n_segments, rng), place);
        let first = t.stage_segments(segments.iter().copied()).expect("present");
        for (id, &segment) in SegmentId::range(first.index()..first.index() + segments.len()).zip(&segments) {
            parents.insert(id, (segment, id));
        }
        let checked = t.check_staged();
        let (before, conflicts) = (t.saved().expect("room"), t.conflicts_of_segments().to_vec());
        let mut others = t.try_clone(None).expect("room");
        let report = t.stage_splits(100_000).unwrap_or_else(|error| panic!("{}: {error}", context()));
        assert_eq!(report.rounds == 0, checked.is_ok(), "{}", context());
        if report.inserted > 0 {
            let refused = others.stage_splits(report.inserted - 1).expect_err("too few");
            assert!(
                matches!(refused, Error::Conflict { conflict: Conflict::Crossing { .. }, .. }),
                "{}",
                context()
            );
            assert_eq!(others.conflicts_of_segments(), conflicts, "{}", context());
            assert!(others.saved().expect("room") == before, "{}", context());
        }
        assert_eq!(others.stage_splits(report.inserted), Ok(report), "{}", context());
        assert_eq!(t.stage_splits(0).map(|report| report.rounds), Ok(0), "{}", context());
        let bytes = t.saved().expect("room");
        let loaded = Triangulation::load(&Saved::of(&bytes).expect("good data"), options());
        let mut loaded = loaded.unwrap_or_else(|error| panic!("{}: {error}", context()));
        assert!(loaded.saved().expect("room") == bytes, "{}", context());
        let commit = t.commit_timestamp().unwrap_or_else(|error| panic!("{}: {error}", context()));
        assert_eq!(commit.inserted as usize, report.inserted + 2, "{}", context());
        others.commit_timestamp().expect("no conflict");
        loaded.commit_timestamp().unwrap_or_else(|error| panic!("{}: {error}", context()));
        check_chains(&loaded, &parents, &report, &context);
        assert_same_cells(&cell_set(&loaded), &cell_set(&t), context);
        check_no_conflicts(&t, &context);
        check_chains(&t, &parents, &report, &context);
        check_chains(&others, &parents, &report, &context);
        check_fresh(&t, &context);
        let compact = {
            let mut copy = t.try_clone(None).expect("room");
            copy.compact().expect("room");
            copy
        };
        for (id, _) in t.segments() {
            assert_eq!(compact.original_segment(id), t.original_segment(id), "{}", context());
        }
        if batch == 0 {
            let mut shuffled = segments;
            rng.shuffle(&mut shuffled);
            shuffled.iter_mut().for_each(|segment| {
                if rng.one_in(2) {
                    segment.ends.reverse()
                }
            });
            let mut other = Triangulation::new(&points, Options::default()).expect("good points");
            other.stage_insertions(&goals[n..]).expect("good places");
            other.stage_segments(shuffled.into_iter()).expect("present");
            other.stage_splits(usize::MAX).expect("no other conflicts");
            other.commit_timestamp().expect("no conflict");
            assert_eq!(outcome(&other), outcome(&t), "{}", context());
        }
        counts[0] += report.inserted;
        counts[1] += report.pieces;
        counts[2] = counts[2].max(report.rounds);
    }
    counts
}

#[test]
fn segments_are_split_until_none_is_in_the_way() {
    let algorithms = [Algorithm::Auto, Algorithm::Rebuilding, Algorithm::PlacementFlips, Algorithm::Repair];
    let mut sums = [0; 3];
    for kind in 0..N_KINDS {
        let mut of_kind = [0; 3];
        for seed in seeds(10) {
            for algorithm in algorithms {
                let counts = run(kind, algorithm, 100 * seed + kind as u64);
                of_kind = [of_kind[0] + counts[0], of_kind[1] + counts[1], of_kind[2].max(counts[2])];
            }
        }
        println!(
            "kind {kind}: {} inserted, {} pieces, at most {} rounds",
            of_kind[0], of_kind[1], of_kind[2]
        );
        sums = [sums[0] + of_kind[0], sums[1] + of_kind[1], sums[2].max(of_kind[2])];
    }
    // The bending of pieces has brought about more.
    assert!(sums[0] > 1000 && sums[1] > 5000 && sums[2] > 1, "{sums:?}");
}

fn square() -> Triangulation {
    let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    Triangulation::new(&corners, Options::default()).expect("good points")
}

fn between(ends: [u32; 2], marker: i32) -> Segment {
    Segment { ends: ends.map(VertexId::new), marker, ..Segment::default() }
}

#[test]
fn what_is_staged_after_a_split_is_split_again() {
    let mut t = square();
    let first = t.stage_segments([between([0, 2], 1)].into_iter()).expect("present");
    t.commit_timestamp().expect("no conflict");
    let before = t.saved().expect("room");
    let second = t.stage_segments([between([1, 3], 2)].into_iter()).expect("present");
    let report = t.stage_splits(1).expect("one crossing");
    assert_eq!((report.inserted, report.pieces, report.replaced_segments, report.rounds), (1, 4, 2, 1));
    let middle = report.first_vertex;
    // A commit that is refused keeps what is staged; where pieces come from is known once they are made.
    let third = t.stage_insertions(&[[1.0, 3.0]]).expect("a good place");
    let refused = t.commit_timestamp().expect_err("a vertex on a piece");
    assert!(
        matches!(refused, Error::Conflict { conflict: Conflict::OnSegment { vertex, .. }, .. } if vertex == third)
    );
    assert_eq!(t.original_segment(report.first_piece), report.first_piece);
    let again = t.stage_splits(0).expect("no crossing");
    assert_eq!((again.inserted, again.pieces, again.replaced_segments), (0, 2, 1));
    t.commit_timestamp().expect("no conflict");
    let told: Vec<_> =
        t.segments().map(|(id, s)| (t.original_segment(id), s.marker, s.ends.map(VertexId::get))).collect();
    let (m, v) = (middle.get(), third.get());
    let expected = [
        (first, 1, [0, m]),
        (first, 1, [m, 2]),
        (second, 2, [1, m]),
        (second, 2, [m, v]),
        (second, 2, [v, 3]),
    ];
    assert_eq!(told, expected);
    assert_eq!(t.made_vertices().count(), 0);
    // Discarding forgets all of it, and ids are given again.
    let mut t = square();
    t.stage_segments([between([0, 2], 1)].into_iter()).expect("present");
    t.commit_timestamp().expect("no conflict");
    t.stage_segments([between([1, 3], 2)].into_iter()).expect("present");
    t.stage_splits(1).expect("one crossing");
    t.discard_moves();
    assert!(t.saved().expect("room") == before);
    let ids = t
        .stage_segments([between([0, 1], 0), between([1, 2], 0), between([2, 3], 0)].into_iter())
        .expect("present");
    t.commit_timestamp().expect("no conflict");
    for id in SegmentId::range(ids.index()..ids.index() + 3) {
        assert_eq!(t.original_segment(id), id);
    }
}

#[test]
fn ends_that_meet_or_go_are_refused() {
    let mut t = square();
    t.stage_segments([between([0, 2], 0), between([1, 3], 0), between([2, 2], 0)].into_iter())
        .expect("present");
    let refused = t.stage_splits(9).expect_err("ends meet");
    let conflict = Conflict::EndsMeet { segment: SegmentId::new(2) };
    assert_eq!(refused, Error::Conflict { conflict, others: 1 });
    assert_eq!((t.conflicts_of_segments().len(), t.staged_edits()), (2, (0, 0)));
    t.discard_moves();
    t.stage_segments([between([0, 2], 0), between([1, 3], 0)].into_iter()).expect("present");
    t.stage_removals(&[VertexId::new(3)]).expect("present");
    let refused = t.stage_splits(9).expect_err("an end goes");
    assert!(matches!(refused, Error::Conflict { conflict: Conflict::EndRemoved { .. }, .. }));
}

/// Segments that overlap have common pieces, in their own directions; a vertex at a crossing is taken for it.
#[test]
fn overlaps_have_common_pieces() {
    let points = [[0.0, 0.0], [4.0, 0.0], [2.0, 0.0], [6.0, 0.0], [3.0, -1.0], [3.0, 1.0], [3.0, 0.0]];
    let mut t = Triangulation::new(&points, Options::default()).expect("good points");
    let segments = [between([0, 1], 1), between([3, 2], 2), between([4, 5], 3), between([0, 1], 4)];
    t.stage_segments(segments.into_iter()).expect("present");
    let report = t.stage_splits(0).expect("no vertex is needed");
    assert_eq!((report.inserted, report.replaced_segments, report.pieces), (0, 4, 11));
    t.commit_timestamp().expect("no conflict");
    let told: Vec<_> = t.segments().map(|(_, s)| (s.marker, s.ends.map(VertexId::get))).collect();
    let expected = [
        (1, [0, 2]),
        (1, [2, 6]),
        (1, [6, 1]),
        (2, [3, 1]),
        (2, [1, 6]),
        (2, [6, 2]),
        (3, [4, 6]),
        (3, [6, 5]),
        (4, [0, 2]),
        (4, [2, 6]),
        (4, [6, 1]),
    ];
    assert_eq!(told, expected);
}

/// Refinement of what has been split adds as many vertices as of pieces given as such, at small angles too; coarsening keeps
/// crossings.
#[test]
fn crossings_are_refined_and_stay() {
    for rise in [0.05, 0.2, 1.5] {
        let points = [
            [0.0, 0.0],
            [4.0, 0.0],
            [4.0, 4.0],
            [0.0, 4.0],
            [0.5, 2.0 - rise],
            [3.5, 2.0 + rise],
            [0.5, 2.0 + rise],
            [3.5, 2.0 - rise],
        ];
        let outline = (0..4).map(|k| between([k, (k + 1) % 4], 0));
        let mut t = Triangulation::new(&points, Options::default()).expect("good points");
        let all: Vec<_> = outline.clone().chain([between([4, 5], 1), between([6, 7], 1)]).collect();
        t.stage_segments(all.into_iter()).expect("present");
        let middle = t.stage_splits(1).expect("a crossing").first_vertex;
        t.commit_timestamp().expect("no conflict");
        let mut given = Triangulation::new(&points, Options::default()).expect("good points");
        given.stage_insertions(&[t.position(middle).expect("present")]).expect("a good place");
        let pieces: Vec<_> = t.segments().map(|(_, segment)| segment).collect();
        given.stage_segments(pieces.into_iter()).expect("present");
        given.commit_timestamp().expect("no conflict");
        let quality = Quality { least_angle: 28.0, greatest_area: 0.05, ..Quality::default() };
        let options = RefineOptions { limit: 20_000, ..RefineOptions::default() };
        let mut reports = Vec::new();
        for t in [&mut t, &mut given] {
            let mask = vec![1; t.cell_count()];
            reports.push(t.refine(&quality, &options, &mask).expect("good quality"));
        }
        // Cells may be stored in another order, in which equally bad ones are mended.
        let [split, whole] = [reports[0], reports[1]];
        assert_eq!((split.bad_cells, split.is_cut_short), (whole.bad_cells, false), "{rise}");
        assert!(
            split.inserted > 100 && split.inserted.abs_diff(whole.inserted) <= whole.inserted / 20,
            "{rise}"
        );
        assert!(t.made_vertices().all(|(v, _)| v > middle));
        let coarse = Quality { least_angle: 5.0, ..Quality::default() };
        let n_before = t.vertex_count();
        for _ in 0..4 {
            let mask = vec![1; t.cell_count()];
            t.coarsen(&coarse, &CoarsenOptions::default(), &mask).expect("good quality");
        }
        assert!(t.is_present(middle) && t.vertex_count() < n_before, "{rise}");
        check_no_conflicts(&t, &|| format!("{rise}"));
        let at_middle: BTreeSet<_> = t
            .segments()
            .filter(|(_, s)| s.ends.contains(&middle))
            .map(|(id, _)| t.original_segment(id))
            .collect();
        assert_eq!(at_middle, BTreeSet::from([4, 5].map(SegmentId::new)), "{rise}");
    }
}
