//! What the latest call has found of segments, conflicts and passings: each call that may find some, after each that has left
//! some, tells what it would tell of a copy that knows nothing of calls before.

use deldrift::motion::{
    CoarsenOptions, MovingTriangulation, Options, PassingPolicy, Quality, RefineOptions, Saved, Segment,
};
use deldrift::{Conflict, Error, Passing, Plane, SegmentId, VertexId};

type Triangulation = MovingTriangulation<Plane>;
type Outcome = Result<String, String>;
type Call = (&'static str, fn(&mut Triangulation) -> Outcome);

const ON_SLIT: [f64; 2] = [4.0, 3.0];
const FREE: [f64; 2] = [1.0, 6.0];

fn v(id: u32) -> VertexId {
    VertexId::new(id)
}

fn segment(ends: [u32; 2]) -> Segment {
    Segment { ends: ends.map(VertexId::new), marker: 7, ..Segment::default() }
}

fn with_policy(passing: PassingPolicy) -> Options {
    Options { passing, ..Options::default() }
}

/// A square with a slit in it, and vertices beside that; 8 is the end of no segment.
fn base(passing: PassingPolicy) -> Triangulation {
    let points = [
        [0.0, 0.0],
        [8.0, 0.0],
        [8.0, 8.0],
        [0.0, 8.0],
        [4.0, 2.0],
        [4.0, 6.0],
        [2.0, 4.0],
        [6.0, 4.0],
        [1.0, 1.5],
    ];
    let mut t = Triangulation::new(&points, with_policy(passing)).expect("good points");
    let sides = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5]];
    t.stage_segments(sides.map(segment).into_iter()).expect("present");
    t.commit_timestamp().expect("nothing is in the way");
    t
}

fn told<T: std::fmt::Debug>(outcome: Result<T, Error>) -> Outcome {
    outcome.map(|value| format!("{value:?}")).map_err(|error| error.to_string())
}

fn everywhere(t: &Triangulation) -> Vec<[f64; 2]> {
    (0..t.id_count()).map(|id| t.position(v(id as u32)).unwrap_or(FREE)).collect()
}

fn refined(t: &mut Triangulation, quality: &Quality) -> Outcome {
    let mask = vec![1; t.cell_count()];
    told(t.refine(quality, &RefineOptions::default(), &mask))
}

fn coarsened(t: &mut Triangulation, margin: f64) -> Outcome {
    let mask = vec![1; t.cell_count()];
    let options = CoarsenOptions { margin, ..CoarsenOptions::default() };
    told(t.coarsen(&Quality { least_angle: 10.0, ..Quality::default() }, &options, &mask))
}

/// All calls that may find something, in each of their outcomes.
const CALLS: [Call; 28] = [
    ("commit", |t| told(t.commit_timestamp())),
    ("commit where all are", |t| {
        let places = everywhere(t);
        told(t.commit_positions(&places))
    }),
    ("commit onto the slit", |t| {
        let mut places = everywhere(t);
        places[8] = ON_SLIT;
        told(t.commit_positions(&places))
    }),
    ("commit NaN", |t| {
        let mut places = everywhere(t);
        places[8] = [f64::NAN; 2];
        told(t.commit_positions(&places))
    }),
    ("prepare and withdraw", |t| {
        let prepared = told(t.prepare_timestamp());
        t.withdraw_timestamp();
        prepared
    }),
    ("check staged", |t| told(t.check_staged())),
    ("check passings", |t| told(t.check_passings())),
    ("split", |t| told(t.stage_splits(usize::MAX))),
    ("split without vertices", |t| told(t.stage_splits(0))),
    ("relocate to its place", |t| {
        let place = t.position(v(8)).unwrap_or(FREE);
        told(t.relocate_vertex(v(8), &place))
    }),
    ("relocate", |t| told(t.relocate_vertex(v(8), &FREE))),
    ("relocate onto the slit", |t| told(t.relocate_vertex(v(8), &ON_SLIT))),
    ("relocate beyond the slit", |t| told(t.relocate_vertex(v(6), &[7.0, 4.0]))),
    ("relocate to NaN", |t| told(t.relocate_vertex(v(8), &[f64::NAN; 2]))),
    ("relocate one that is not", |t| told(t.relocate_vertex(v(99), &FREE))),
    ("insert", |t| told(t.insert_vertex(&[1.5, 2.5]))),
    ("insert on the slit", |t| told(t.insert_vertex(&ON_SLIT))),
    ("insert with a key", |t| told(t.insert_vertex_with_key(&[2.5, 1.25], 3))),
    ("insert NaN", |t| told(t.insert_vertex(&[f64::NAN; 2]))),
    ("remove", |t| told(t.remove_vertex(v(8)))),
    ("remove an end", |t| told(t.remove_vertex(v(4)))),
    ("remove one that is not", |t| told(t.remove_vertex(v(99)))),
    ("refine nothing", |t| refined(t, &Quality::default())),
    ("refine", |t| refined(t, &Quality { greatest_area: 4.0, ..Quality::default() })),
    ("refine by NaN", |t| refined(t, &Quality { least_angle: f64::NAN, ..Quality::default() })),
    ("coarsen", |t| coarsened(t, 2.0)),
    ("coarsen by NaN", |t| coarsened(t, f64::NAN)),
    ("compact", |t| told(t.compact())),
];

/// What leaves something to be told.
const REFUSALS: [Call; 10] = [
    ("crossing", |t| {
        t.stage_segments([segment([6, 7])].into_iter()).expect("present");
        told(t.commit_timestamp())
    }),
    ("checked crossing", |t| {
        t.stage_segments([segment([6, 7])].into_iter()).expect("present");
        told(t.check_staged())
    }),
    ("both ends", |t| {
        t.stage_removals(&[v(4), v(5)]).expect("present");
        told(t.commit_timestamp())
    }),
    ("prepared crossing", |t| {
        t.stage_segments([segment([6, 7])].into_iter()).expect("present");
        told(t.prepare_timestamp())
    }),
    ("no room to split", |t| {
        t.stage_segments([segment([6, 7])].into_iter()).expect("present");
        told(t.stage_splits(0))
    }),
    ("inserted on the slit", |t| told(t.insert_vertex(&ON_SLIT))),
    ("an end removed", |t| told(t.remove_vertex(v(5)))),
    ("relocated onto the slit", |t| told(t.relocate_vertex(v(6), &ON_SLIT))),
    ("passes", |t| {
        t.move_vertices(&[v(6)], &[[7.0, 4.5]]).expect("a good place");
        told(t.check_passings())
    }),
    ("a commit that passes", |t| {
        t.move_vertices(&[v(6)], &[[7.0, 4.5]]).expect("a good place");
        told(t.commit_timestamp())
    }),
];

fn found(t: &Triangulation) -> (Vec<Conflict>, Vec<Passing>) {
    (t.conflicts_of_segments().to_vec(), t.passings().to_vec())
}

#[test]
fn each_call_tells_what_it_has_found_itself() {
    let (mut n, mut n_left, mut n_told) = (0, 0, 0);
    for passing in [PassingPolicy::Ignore, PassingPolicy::Tell, PassingPolicy::Refuse] {
        for (refusal, refuse) in REFUSALS {
            for discards in [false, true] {
                let mut refused = base(passing);
                let _ = refuse(&mut refused);
                let left = found(&refused);
                n_left += usize::from(left != (vec![], vec![]));
                if discards {
                    refused.discard_moves();
                    assert_eq!(found(&refused), left, "{refusal}: discarding keeps what is told");
                }
                for (name, call) in CALLS {
                    let context = format!("{passing:?}, {refusal}, {discards}, {name}");
                    let mut t = base(passing);
                    let _ = refuse(&mut t);
                    if discards {
                        t.discard_moves();
                    }
                    let mut copy = t.try_clone(None).expect("room");
                    let bytes = t.saved().expect("room");
                    let mut loaded =
                        Triangulation::load(&Saved::of(&bytes).expect("good"), with_policy(passing))
                            .expect("room");
                    assert_eq!(found(&copy), (vec![], vec![]), "{context}");
                    assert_eq!(found(&loaded), (vec![], vec![]), "{context}");
                    let outcomes = [&mut copy, &mut loaded, &mut t].map(call);
                    assert_eq!(outcomes[0].is_ok(), outcomes[2].is_ok(), "{context}: {outcomes:?}");
                    assert_eq!(outcomes[0].as_ref().err(), outcomes[2].as_ref().err(), "{context}");
                    assert_eq!(found(&t), found(&copy), "{context}, of a copy");
                    assert_eq!(found(&t), found(&loaded), "{context}, loaded");
                    n += 1;
                    n_told += usize::from(found(&t) != (vec![], vec![]));
                }
            }
        }
    }
    assert!(n == 3 * 10 * 2 * 28 && n_left > 50 && n_told > 100, "{n} {n_left} {n_told}");
}

/// What stages, publishes, withdraws or asks keeps what is told.
#[test]
fn calls_that_find_nothing_keep_what_is_told() {
    let mut t = base(PassingPolicy::Tell);
    t.move_vertices(&[v(6)], &[[7.0, 4.5]]).expect("a good place");
    t.stage_segments([segment([0, 2])].into_iter()).expect("present");
    t.check_staged().expect_err("it crosses the slit");
    let left = found(&t);
    assert!(!left.0.is_empty() && !left.1.is_empty());
    t.stage_removals(&[v(8)]).expect("present");
    t.stage_insertions(&[[3.0, 3.5]]).expect("a good place");
    t.stage_segments([segment([6, 9])].into_iter()).expect("present");
    t.stage_segment_removals(&[SegmentId::new(0)]).expect("in force");
    t.cells().expect("room");
    t.take_changes().expect("room");
    t.nearest_vertex(&FREE).expect("room");
    t.publish_timestamp().expect_err("none is prepared");
    t.withdraw_timestamp();
    t.discard_moves();
    assert_eq!(found(&t), left);
    // The first segments of all are staged in a round that is withdrawn: what a later round was refused for is told still.
    let points = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [2.0, 1.0]];
    let mut t = Triangulation::new(&points, Options::default()).expect("good points");
    t.move_vertices(&[v(4)], &[[2.0, 1.5]]).expect("a good place");
    t.prepare_timestamp().expect("nothing is in the way");
    t.stage_segments([segment([0, 2]), segment([1, 3])].into_iter()).expect("present");
    t.prepare_timestamp().expect_err("they cross");
    t.withdraw_timestamp();
    assert_eq!(
        t.conflicts_of_segments(),
        [Conflict::Crossing { segments: [SegmentId::new(0), SegmentId::new(1)] }]
    );
}

/// A vertex that stops on a segment passes it; where that is refused, the segment can be split there all the same.
#[test]
fn segments_are_split_where_a_passing_would_be_refused() {
    let mut t = base(PassingPolicy::Refuse);
    t.move_vertices(&[v(6)], &[ON_SLIT]).expect("a good place");
    assert!(matches!(t.commit_timestamp(), Err(Error::Passing { .. })));
    let report = t.stage_splits(0).expect("there is a vertex where it is split");
    assert_eq!((report.inserted, report.replaced_segments, report.pieces), (0, 1, 2));
    assert_eq!(found(&t), (vec![], vec![]));
    t.commit_timestamp().expect("what passes is a piece by now");
    let pieces: Vec<_> = t.segments().map(|(_, segment)| segment.ends.map(VertexId::get)).collect();
    assert_eq!(pieces[4..], [[4, 6], [6, 5]]);
    let mut fresh = Triangulation::new(&everywhere(&t), Options::default()).expect("good points");
    fresh.stage_segments(pieces.into_iter().map(segment)).expect("present");
    fresh.commit_timestamp().expect("nothing is in the way");
    let cells = |t: &Triangulation| {
        let mut rows: Vec<_> =
            t.cells().expect("room").corners.iter().map(|row| crate::common::sorted(row)).collect();
        rows.sort();
        rows
    };
    assert_eq!(cells(&t), cells(&fresh));
    for (piece, _) in t.segments().skip(4) {
        assert_eq!(t.original_segment(piece), SegmentId::new(4));
    }
}

/// A segment that loses both ends has a conflict for each; ends without ids are told once.
#[test]
fn both_ends_that_go_are_told() {
    let mut t = base(PassingPolicy::Ignore);
    t.stage_removals(&[v(4), v(5)]).expect("present");
    t.check_staged().expect_err("they are ends");
    let slit = SegmentId::new(4);
    let gone = |vertex| Conflict::EndRemoved { segment: slit, vertex };
    assert_eq!(t.conflicts_of_segments(), [gone(v(4)), gone(v(5))]);
    let mut t = Triangulation::new(&[[0.0; 2], [1.0, 0.0], [0.0, 1.0], [3.0, 3.0]], Options::default())
        .expect("good points");
    t.stage_segments([segment([2, 3])].into_iter()).expect("present");
    t.remove_vertex(v(2)).expect("a segment that is staged does not keep it");
    t.remove_vertex(v(3)).expect("a segment that is staged does not keep it");
    t.compact().expect("room");
    t.check_staged().expect_err("it has no end");
    assert_eq!(
        t.conflicts_of_segments(),
        [Conflict::EndRemoved { segment: SegmentId::new(0), vertex: VertexId::NONE }]
    );
}

/// Of several vertices at a place on a segment the one is told that represents the place: by key, where there are keys.
#[test]
fn the_vertex_on_a_segment_is_the_one_that_represents_its_place() {
    let points = [[0.0, 0.0], [4.0, 0.0], [2.0, 3.0], [2.0, 0.0], [2.0, 0.0], [2.0, -3.0]];
    for keys in [None, Some([10, 11, 12, 9, 3, 8])] {
        let mut t = match keys {
            Some(keys) => Triangulation::with_keys(&points, &keys, Options::default()),
            None => Triangulation::new(&points, Options::default()),
        }
        .expect("good points");
        let shown = t.coincident_representative(v(3)).expect("present");
        assert_eq!(shown, if keys.is_some() { v(4) } else { v(3) });
        t.stage_segments([segment([0, 1])].into_iter()).expect("present");
        t.check_staged().expect_err("a vertex is on it");
        assert_eq!(
            t.conflicts_of_segments(),
            [Conflict::OnSegment { segment: SegmentId::new(0), vertex: shown }]
        );
    }
}

/// Infinity among sizes is none: as a mesh without sizes, or of those that are finite.
#[test]
fn infinite_sizes_are_none() {
    let sizes_of = |t: &Triangulation, size: f64| vec![size; t.id_count()];
    let [mut none, mut all, mut mixed] = [(); 3].map(|()| base(PassingPolicy::Ignore));
    let plain = Quality { least_angle: 20.0, ..Quality::default() };
    let sizes = sizes_of(&all, f64::INFINITY);
    let one = refined(&mut none, &plain);
    let other = refined(&mut all, &Quality { sizes: Some(&sizes), ..plain });
    assert_eq!((one, none.saved().expect("room")), (other, all.saved().expect("room")));
    let mut sizes = sizes_of(&mixed, 0.5);
    sizes[2] = f64::INFINITY;
    refined(&mut mixed, &Quality { sizes: Some(&sizes), ..Quality::default() }).expect("it ends");
    assert!(mixed.id_count() > none.id_count() + 50, "{}", mixed.id_count());
}
