//! Labels of regions that follow: beside seeds that move with the regions, through every call that changes cells.

use crate::common::Rng;
use deldrift::motion::{
    Algorithm, CoarsenOptions, Level, MovingTriangulation, NO_LABEL, Options, Quality, RefineOptions, Saved,
    Segment,
};
use deldrift::{Error, Plane, SegmentId, VertexId};
use std::f64::consts::TAU;

type Triangulation = MovingTriangulation<Plane>;

/// Outside, the ring between the square and the inclusion, the inclusion, and the hole in it.
const LABELS: [i32; 3] = [1, 2, -3];
const OUTSIDE: i32 = -7;

/// A square with an inclusion that has a hole, both of which turn about a centre that moves.
struct Rotor {
    t: Triangulation,
    centre: [f64; 2],
}

fn circle(centre: [f64; 2], radius: f64, n: usize) -> impl Iterator<Item = [f64; 2]> {
    (0..n).map(move |k| {
        let (sine, cosine) = (TAU * k as f64 / n as f64).sin_cos();
        [centre[0] + radius * cosine, centre[1] + radius * sine]
    })
}

impl Rotor {
    fn new(rng: &mut Rng) -> Self {
        let centre = [0.1, -0.05];
        let mut points = vec![[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]];
        points.extend(circle(centre, 0.9, 9));
        points.extend(circle(centre, 0.4, 5));
        points.push([3.0, 0.5]);
        points.extend((0..12).map(|_| [rng.unit() * 1.9, rng.unit() * 1.9]));
        let ring = |first: usize, n: usize| (0..n).map(move |k| [first + k, first + (k + 1) % n]);
        let mut t = Triangulation::new(&points, Options::default()).expect("good points");
        let edges = ring(0, 4).chain(ring(4, 9)).chain(ring(13, 5));
        // Some in the other direction.
        let segments: Vec<_> = edges
            .enumerate()
            .map(|(k, [v, w])| if k % 3 == 0 { [w, v] } else { [v, w] })
            .map(|ends| Segment { ends: ends.map(VertexId::at), ..Segment::default() })
            .collect();
        t.stage_segments(segments.into_iter()).expect("present");
        t.commit_timestamp().expect("no conflict");
        let mut rotor = Rotor { t, centre };
        let labels = rotor.by_seeds(&rotor.t);
        rotor.t.set_regions(&labels).expect("labels of regions");
        rotor
    }

    /// The labels by seeds, which are in the middles of the regions.
    fn by_seeds(&self, t: &Triangulation) -> Vec<i32> {
        let [x, y] = self.centre;
        t.label_cells(&[[-1.99, 1.99], [x + 0.65, y], [x, y]], &LABELS, OUTSIDE)
            .expect("no seed at a segment")
    }

    fn check(&self, t: &Triangulation, context: &str) {
        let (labels, n_undecided) = t.region_labels(OUTSIDE).expect("room");
        assert_eq!((labels, n_undecided), (self.by_seeds(t), 0), "{context}");
    }

    /// All that is within the square turns and moves, the less the farther out.
    fn step(&mut self, angle: f64, [dx, dy]: [f64; 2]) {
        let [x, y] = self.centre;
        for v in (0..self.t.id_count()).map(VertexId::at) {
            let Ok(p) = self.t.position(v) else { continue };
            let (u, w) = (p[0] - x, p[1] - y);
            let share = ((1.7 - u.hypot(w)) / 0.75).clamp(0.0, 1.0);
            let (sine, cosine) = (angle * share).sin_cos();
            let goal = [x + u * cosine - w * sine + share * dx, y + u * sine + w * cosine + share * dy];
            self.t.move_vertices(&[v], &[goal]).expect("present");
        }
        self.t.commit_timestamp().expect("no conflict");
        self.centre = [x + dx, y + dy];
    }
}

fn mask_of(labels: &[i32]) -> Vec<u8> {
    labels.iter().map(|&label| u8::from(label > 0)).collect()
}

#[test]
fn labels_follow_through_every_change() {
    let mut rng = Rng::new(61);
    let mut rotor = Rotor::new(&mut rng);
    rotor.check(&rotor.t, "at first");
    let (mut n_inserted, mut n_removed) = (0, 0);
    for step in 0..60 {
        let context = format!("step {step}");
        if step % 20 == 7 {
            rotor.t.set_algorithm(*rng.pick(&[Algorithm::Auto, Algorithm::Rebuilding, Algorithm::Repair]));
        }
        rotor.step(0.03, [0.01 * (step as f64 / 9.0).sin(), 0.004]);
        rotor.check(&rotor.t, &context);
        let asked = Quality {
            least_angle: 25.0,
            // By the labels of the library: the inclusion is finer.
            areas: &[0.0, 0.2, 0.02],
            ..Quality::default()
        };
        for coarsens in [true, false] {
            let labels = rotor.t.region_labels(0).expect("room").0;
            let (mask, own) =
                (mask_of(&labels), labels.iter().map(|&label| label as u32).collect::<Vec<_>>());
            let asked = Quality { labels: Some(&own), ..asked };
            let report = if coarsens {
                rotor.t.coarsen(&asked, &CoarsenOptions::default(), &mask)
            } else {
                let options = RefineOptions { reuses_ids: step % 2 == 0, ..RefineOptions::default() };
                rotor.t.refine(&asked, &options, &mask)
            };
            let report = report.expect("no conflict");
            n_inserted += report.inserted;
            n_removed += report.removed;
            rotor.check(&rotor.t, &context);
        }
        if step % 10 == 3 {
            let bytes = rotor.t.saved().expect("room");
            let loaded = Triangulation::load(&Saved::of(&bytes).expect("saved"), Options::default());
            let loaded = loaded.expect("saved");
            let cloned = rotor.t.try_clone(None).expect("room");
            for copy in [&loaded, &cloned] {
                rotor.check(copy, &context);
                assert!(copy.has_regions() && copy.saved().expect("room") == bytes, "{context}");
            }
            rotor.t = if step % 20 == 3 { loaded } else { cloned };
        }
        if step % 15 == 4 {
            rotor.t.compact().expect("room");
            rotor.check(&rotor.t, &context);
        }
        if step % 12 == 5 {
            // A line across the outer region is split where it meets vertices and segments, and goes again.
            let ends = [VertexId::new(1), VertexId::new(3)];
            rotor.t.stage_segments([Segment { ends, ..Segment::default() }].into_iter()).expect("present");
            rotor.t.stage_splits(10_000).expect("room");
            rotor.t.prepare_timestamp().expect("no conflict");
            let refused = [rotor.t.set_regions(&[]), rotor.t.set_sides(&[], &[]), rotor.t.forget_regions()];
            assert!(refused.iter().all(|told| matches!(told, Err(Error::Prepared { .. }))), "{refused:?}");
            rotor.t.withdraw_timestamp();
            rotor.t.discard_moves();
            rotor.check(&rotor.t, &context);
        }
    }
    assert!(n_inserted > 200 && n_removed > 60, "{n_inserted} {n_removed}");
    assert_eq!(rotor.t.validate(Level::Delaunay), Ok(()));
    let n = rotor.t.saved().expect("room").len();
    rotor.t.forget_regions().expect("not prepared");
    assert!(!rotor.t.has_regions() && rotor.t.saved().expect("room").len() < n);
    let (labels, n_undecided) = rotor.t.region_labels(5).expect("room");
    let levels = rotor.t.nesting_levels().expect("room");
    assert!(labels.iter().all(|&label| label == 5));
    assert_eq!(n_undecided, levels.iter().filter(|&&level| level > 0).count());
}

/// What is told of regions whose sides have no label, or several, and what is refused.
#[test]
fn sides_decide_or_do_not() {
    let points = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [9.0, 2.0]];
    let mut t = Triangulation::new(&points, Options::default()).expect("good points");
    let segment = |v: u32, w: u32| Segment { ends: [v, w].map(VertexId::new), ..Segment::default() };
    let first = t.stage_segments([[0, 1], [1, 2], [2, 3], [3, 0]].map(|[v, w]| segment(v, w)).into_iter());
    let first = first.expect("present").index();
    let id = |k: usize| SegmentId::at(first + k);
    // Staged ones can be given labels, which are forgotten with them.
    t.set_sides(&[id(0)], &[[3, NO_LABEL]]).expect("staged");
    t.commit_timestamp().expect("no conflict");
    let cells = |t: &Triangulation| {
        let levels = t.nesting_levels().expect("room");
        levels.into_iter().zip(t.region_labels(0).expect("room").0).collect::<Vec<_>>()
    };
    let is_told =
        |t: &Triangulation, label: i32| cells(t).iter().all(|&(level, told)| (level == 1) == (told == label));
    assert!(is_told(&t, 3) && t.region_labels(0).expect("room").1 == 0);
    // Sides that say something else leave it open, and so do none.
    t.set_sides(&[id(1)], &[[4, 0]]).expect("in force");
    let (mut labels, n_undecided) = t.region_labels(-1).expect("room");
    labels.sort_unstable();
    assert_eq!((labels, n_undecided), (vec![-1; 3], 2));
    t.set_sides(&[id(0), id(1), id(1), id(2)], &[[5, 5], [6, 6], [NO_LABEL, 0], [5, NO_LABEL]])
        .expect("in force");
    assert!(is_told(&t, 5));
    let bytes = t.saved().expect("room");
    for (ids, index) in [(vec![id(0), SegmentId::new(9)], 1), (vec![SegmentId::NONE], 0)] {
        let sides = vec![[1, 1]; ids.len()];
        let error = Error::NoSuchSegment { argument: "segments", index, segment: ids[index], ids: 4 };
        assert_eq!(t.set_sides(&ids, &sides), Err(error));
    }
    // The diagonal parts the square; with it each half may have its own label, and without it they may not.
    let n = t.cell_count();
    let by_half = |t: &Triangulation| {
        let cells = t.cells().expect("room");
        let has = |row: &[VertexId; 3], v: u32| row.contains(&VertexId::new(v));
        let label = |row| if has(row, 4) { 0 } else { 1 + i32::from(has(row, 0) && !has(row, 1)) };
        cells.corners.iter().map(label).collect::<Vec<_>>()
    };
    assert!(matches!(t.set_regions(&by_half(&t)), Err(Error::InvalidValue { argument: "labels", .. })));
    let counts = Error::WrongCount { argument: "labels", given: n + 1, wanted: n, coming: 0 };
    assert_eq!(t.set_regions(&vec![1; n + 1]), Err(counts));
    assert!(t.saved().expect("room") == bytes, "what is refused changes nothing");
    let cells_of = |t: &Triangulation| t.cells().expect("room").corners.to_vec();
    let diagonal = cells_of(&t).iter().find(|row| !row.contains(&VertexId::new(4))).copied().expect("a half");
    let (v, w) = match diagonal.contains(&VertexId::new(0)) && diagonal.contains(&VertexId::new(2)) {
        true => (0, 2),
        false => (1, 3),
    };
    t.stage_segments([segment(v, w)].into_iter()).expect("present");
    t.commit_timestamp().expect("no conflict");
    assert!(is_told(&t, 5), "both parts have a side with the label of the whole");
    let labels: Vec<i32> =
        (1..).zip(cells_of(&t)).map(|(k, row)| if row.contains(&VertexId::new(4)) { 0 } else { k }).collect();
    t.set_regions(&labels).expect("each cell is a region");
    assert_eq!(t.region_labels(0).expect("room"), (labels, 0));
    // Without the diagonal the two labels meet.
    t.stage_segment_removals(&[id(4)]).expect("in force");
    t.commit_timestamp().expect("no conflict");
    assert_eq!(t.region_labels(0).expect("room").1, 2);
}

/// An island that jumps from a region to another one leaves both their labels, and takes its own along.
#[test]
fn islands_may_jump() {
    let ring = |[x, y]: [f64; 2], size: f64| [[x, y], [x + size, y], [x + size, y + size], [x, y + size]];
    // The corner of the second square is the leftmost place of its region, and a slit begins there.
    let mut points = ring([0.0, 0.0], 4.0).to_vec();
    points.extend(ring([10.0, 0.0], 4.0));
    points.extend(ring([1.0, 1.0], 1.0));
    points.push([12.0, 2.5]);
    let mut t = Triangulation::new(&points, Options::default()).expect("good points");
    let ends = (0..12).map(|k: u32| [k, k / 4 * 4 + (k + 1) % 4]).chain([[7, 12]]);
    let segments: Vec<_> =
        ends.map(|ends| Segment { ends: ends.map(VertexId::new), ..Segment::default() }).collect();
    t.stage_segments(segments.into_iter()).expect("present");
    t.commit_timestamp().expect("no conflict");
    let labels = |t: &Triangulation, island: [f64; 2]| {
        t.label_cells(&[island, [0.5, 0.5], [10.5, 0.5]], &[3, 1, 2], 9).expect("within regions")
    };
    t.set_regions(&labels(&t, [1.5, 1.5])).expect("labels of regions");
    let goals = [[11.0, 1.0], [12.0, 1.0], [12.0, 2.0], [11.0, 2.0]];
    t.move_vertices(&[8, 9, 10, 11].map(VertexId::new), &goals).expect("present");
    t.commit_timestamp().expect("no conflict");
    assert_eq!(t.region_labels(9).expect("room"), (labels(&t, [11.5, 1.5]), 0));
    // Where the outer boundary tells nothing the island does: it says what was around it.
    t.set_sides(&(4..8).chain([12]).map(SegmentId::at).collect::<Vec<_>>(), &[[NO_LABEL; 2]; 5])
        .expect("in force");
    let (found, n_undecided) = t.region_labels(9).expect("room");
    let at = |seed: [f64; 2]| {
        let here = t.label_cells(&[seed], &[1], 0).expect("within a region");
        found[here.iter().position(|&label| label == 1).expect("a cell")]
    };
    assert_eq!((at([11.5, 1.5]), at([10.5, 0.5]), at([0.5, 0.5]), n_undecided), (3, 1, 1, 0));
}

/// Data with labels that are changed are refused, or are those of other labels.
#[test]
fn saved_labels_are_looked_at() {
    let rotor = Rotor::new(&mut Rng::new(5));
    let bytes = rotor.t.saved().expect("room");
    let plain = {
        let mut t = rotor.t.try_clone(None).expect("room");
        t.forget_regions().expect("not prepared");
        t.saved().expect("room")
    };
    assert_eq!(
        bytes.len(),
        plain.len() + 96 + 8 + 12 * rotor.t.segments().count(),
        "a history, how many are in force, and an id and two labels each"
    );
    let checked = |mut bytes: Vec<u8>| {
        let n = bytes.len() - 4;
        let sum = crc32fast::hash(&bytes[..n]);
        bytes[n..].copy_from_slice(&sum.to_le_bytes());
        bytes
    };
    let load = |bytes: &[u8]| {
        let saved = Saved::of(bytes).map_err(|_| ())?;
        Triangulation::load(&saved, Options::default()).map_err(|_| ())
    };
    // The versions with labels, and the others, each with data of the others.
    for (given, versions) in [(&bytes, [1, 2, 3, 4, 5, 6, 8, 9]), (&plain, [1, 3, 4, 5, 6, 7, 8, 9])] {
        for version in versions {
            let mut other = given.clone();
            other[8] = version;
            assert!(load(&checked(other)).is_err(), "version {version}");
        }
    }
    // Labels are the last two numbers of each segment; data that say there are some and have none are not what is saved.
    let n_rows = rotor.t.segments().count();
    let first = bytes.len() - 4 - 24 * n_rows;
    let mut empty = bytes.clone();
    for k in 0..n_rows {
        for at in [16, 20].map(|offset| first + 24 * k + offset) {
            empty[at..at + 4].copy_from_slice(&NO_LABEL.to_le_bytes());
        }
    }
    assert!(load(&checked(empty)).is_err());
    let mut other = bytes.clone();
    other[first + 16] ^= 4;
    let other = checked(other);
    assert!(load(&other).expect("another label").saved().expect("room") == other);
}
