//! What coarsening does not look at is not missed: beside copies that know nothing of what was looked at, and beside the
//! removal of each vertex that has stayed.

use super::{
    Domain, Triangulation, bad_cells, check_fresh, circle, has_large_area, has_small_angle, mask,
    random_domain, rectangle, refine,
};
use crate::common::{Rng, cell_set, seeds};
use deldrift::motion::{CoarsenOptions, Options, Quality, QualityReport, RefineOptions, Segment};
use deldrift::{SegmentId, VertexId};
use std::collections::BTreeSet;

type Row = Vec<VertexId>;

/// Places of the corners of a cell, in any order.
fn places<'p>(points: &'p [[f64; 2]], row: &Row) -> [&'p [f64; 2]; 3] {
    [&points[row[0].index()], &points[row[1].index()], &points[row[2].index()]]
}

/// The marker of segments that are no loops.
const OWN: i32 = 1_000;

fn is_loop(marker: i32) -> bool {
    marker < OWN
}

/// By id; vertices that have been removed are far away.
fn positions(t: &Triangulation) -> Vec<[f64; 2]> {
    VertexId::range(0..t.id_count()).map(|v| t.position(v).unwrap_or([9e4; 2])).collect()
}

/// Whether a cell fulfils the criteria with room, `slack` more or less of it.
fn has_room(p: [&[f64; 2]; 3], quality: &Quality, options: &CoarsenOptions, slack: f64) -> bool {
    let bound = quality.greatest_area * options.share;
    let [a, b, c] = p;
    let is_large = |bound: f64| has_large_area(p, bound) || has_large_area([a, c, b], bound);
    (quality.least_angle == 0.0 || !has_small_angle(p, quality.least_angle + options.margin + slack))
        && (bound == 0.0 || !is_large(bound * (1.0 - slack)))
}

/// The vertices added that are at no segment, and in selected cells alone, none of which is bad, and could clearly go.
fn could_go(
    t: &Triangulation,
    selected: &[u8],
    quality: &Quality,
    options: &CoarsenOptions,
) -> Vec<VertexId> {
    let before = cell_set(t);
    let points = positions(t);
    let bad: BTreeSet<VertexId> = bad_cells(t, selected, quality).into_iter().flatten().collect();
    let rows = t.cells().expect("room").corners;
    let kept: BTreeSet<VertexId> = t.segments().flat_map(|(_, segment)| segment.ends).collect();
    let outside = rows.iter().zip(selected).filter(|&(_, &m)| m == 0).flat_map(|(row, _)| *row);
    let outside: BTreeSet<VertexId> = outside.collect();
    let is_inside =
        |&(v, _): &(VertexId, SegmentId)| ![&bad, &kept, &outside].iter().any(|set| set.contains(&v));
    let can_go = |&(v, _): &(VertexId, SegmentId)| {
        let mut without = t.try_clone(None).expect("room");
        without.remove_vertex(v).expect("present");
        let after = cell_set(&without);
        after.difference(&before).all(|row| has_room(places(&points, row), quality, options, 1e-6))
    };
    t.made_vertices().filter(is_inside).filter(can_go).map(|(v, _)| v).collect()
}

/// Coarsens, and a copy that knows nothing as well: both have to do the same. Where nothing was bad, all that comes has
/// room.
fn coarsen_beside_a_copy(
    t: &mut Triangulation,
    quality: &Quality,
    options: &CoarsenOptions,
    context: &dyn Fn() -> String,
) -> QualityReport {
    let selected = mask(t, is_loop);
    let mut twin = t.try_clone(None).expect("room");
    let before = cell_set(t);
    let were_good = bad_cells(t, &selected, quality).is_empty();
    let report = t.coarsen(quality, options, &selected).expect("a domain");
    let of_twin = twin.coarsen(quality, options, &selected).expect("a domain");
    assert_eq!(report, of_twin, "{}", context());
    assert_eq!(cell_set(t), cell_set(&twin), "{}", context());
    assert!(t.made_vertices().eq(twin.made_vertices()), "{}", context());
    if were_good {
        let points = positions(t);
        let selected = mask(t, is_loop);
        for row in super::cells_of(t, &selected, 1).difference(&before) {
            assert!(has_room(places(&points, row), quality, options, -1e-9), "{}: {row:?}", context());
        }
    }
    report
}

/// Refines, and a copy that knows nothing as well: both have to do the same.
fn refine_beside_a_copy(
    t: &mut Triangulation,
    quality: &Quality,
    context: &dyn Fn() -> String,
) -> QualityReport {
    let selected = mask(t, is_loop);
    let mut twin = t.try_clone(None).expect("room");
    let report = refine(t, quality, &RefineOptions::default(), &selected);
    assert_eq!(report, refine(&mut twin, quality, &RefineOptions::default(), &selected), "{}", context());
    assert_eq!(cell_set(t), cell_set(&twin), "{}", context());
    report
}

/// Random domains that are stretched a bit, and lattices with many vertices on circles: no vertex stays that could go.
#[test]
fn no_vertex_stays_that_could_go() {
    let (mut n_removed, mut n_looked) = (0, 0);
    for seed in seeds(60) {
        let rng = &mut Rng::new(seed);
        let is_lattice = seed % 3 == 0;
        let (domain, n_loops) = if is_lattice {
            (Domain::default().with_ring(&rectangle([0.0, 0.0], [1.0, 1.0])), 4)
        } else {
            random_domain(rng)
        };
        let quality = Quality {
            least_angle: *rng.pick(&[0.0, 20.0, 25.0]),
            greatest_area: *rng.pick(&if is_lattice { [0.03125, 0.0078125] } else { [0.05, 0.02] }),
            ..Quality::default()
        };
        // Chains within would be taken for loops.
        let domain = Domain { edges: domain.edges[..n_loops].to_vec(), ..domain };
        let context = || format!("seed {seed}, {quality:?}, {domain:?}");
        let mut t = Triangulation::new(&domain.points, Options::default()).expect("good points");
        let segment = |k: usize| Segment {
            ends: domain.edges[k].map(VertexId::at),
            marker: k as i32,
            ..Segment::default()
        };
        t.stage_segments((0..n_loops).map(segment)).expect("present");
        if t.commit_timestamp().is_err() {
            // The inner loop crosses the outer one.
            continue;
        }
        let selected = mask(&t, is_loop);
        let finer = Quality { greatest_area: quality.greatest_area * 0.5, ..quality };
        refine(&mut t, if rng.one_in(2) { &finer } else { &quality }, &RefineOptions::default(), &selected);
        if is_lattice {
            // To multiples of 1/64, where that conflicts with nothing: on one circle, four are common.
            let made: Vec<_> = t.made_vertices().filter(|&(_, on)| on == SegmentId::NONE).collect();
            for (v, _) in made {
                let goal = t.position(v).expect("present").map(|x| (x * 64.0).round() / 64.0);
                t.move_vertices(&[v], &[goal]).expect("a good place");
                if t.commit_timestamp().is_err() {
                    t.discard_moves();
                }
            }
        } else {
            let ids: Vec<_> = VertexId::range(0..t.id_count()).collect();
            let goals: Vec<_> = positions(&t).into_iter().map(|[x, y]| [x * 0.93, y * 0.97]).collect();
            t.move_vertices(&ids, &goals).expect("good places");
            t.commit_timestamp().expect("no conflict");
        }
        let options = CoarsenOptions { margin: *rng.pick(&[0.0, 2.0]), ..CoarsenOptions::default() };
        n_removed += coarsen_beside_a_copy(&mut t, &quality, &options, &context).removed;
        check_fresh(&t, &context);
        let selected = mask(&t, is_loop);
        n_looked += t.made_vertices().count();
        assert_eq!(could_go(&t, &selected, &quality, &options), [], "{}", context());
        // What has been looked at is not looked at again, and is all that there is.
        let again = t.coarsen(&quality, &options, &selected).expect("a domain");
        assert_eq!(again.removed, 0, "{}", context());
    }
    println!("{n_removed} removed, {n_looked} stay");
    assert!(n_removed > 500 && n_looked > 1_000);
}

/// A domain of which a hole turns, while the program also does what it likes: vertices of refinement are removed, moved and
/// inserted, segments laid and removed, ids compacted, and copies go on in the place of what they were made of.
#[test]
fn a_hole_turns_while_the_program_edits() {
    let domain = Domain::default()
        .with_ring(&rectangle([-1.0, -0.6], [1.0, 0.6]))
        .with_ring(&circle([0.0; 2], 0.2, 12));
    let mut n = [0; 3];
    for seed in seeds(4) {
        let rng = &mut Rng::new(seed);
        let mut t = domain.build();
        let mut quality = Quality { least_angle: 25.0, greatest_area: 0.008, ..Quality::default() };
        let options = CoarsenOptions::default();
        let selected = mask(&t, is_loop);
        refine(&mut t, &quality, &RefineOptions::default(), &selected);
        for step in 0..150 {
            let context = || format!("seed {seed}, step {step}");
            // At rest, what was found before still holds, unless an edit changes that.
            if !rng.one_in(3) {
                turn(&mut t, 0.02);
            }
            match rng.below(8) {
                0 => edit_a_vertex(&mut t, rng),
                1 => lay_or_take_away(&mut t, rng),
                2 => drop(t.compact().expect("room")),
                3 => t = t.try_clone(None).expect("room"),
                4 => quality.greatest_area = *rng.pick(&[0.008, 0.009]),
                _ => (),
            }
            n[0] += coarsen_beside_a_copy(&mut t, &quality, &options, &context).removed;
            let report = refine_beside_a_copy(&mut t, &quality, &context);
            n[1] += report.inserted;
            assert_eq!(report.bad_cells, 0, "{}", context());
            let selected = mask(&t, is_loop);
            assert_eq!(bad_cells(&t, &selected, &quality), Vec::<[VertexId; 3]>::new(), "{}", context());
            if step % 30 == 29 {
                check_fresh(&t, &context);
                coarsen_beside_a_copy(&mut t, &quality, &options, &context);
                let selected = mask(&t, is_loop);
                assert_eq!(could_go(&t, &selected, &quality, &options), [], "{}", context());
                n[2] += 1;
            }
        }
    }
    println!("{n:?} removed, inserted, looked at all");
    assert!(n[0] > 200 && n[1] > 200 && n[2] > 5, "{n:?}");
}

/// Turns the hole by an angle, and what is near it by less.
fn turn(t: &mut Triangulation, angle: f64) {
    let (mut ids, mut goals) = (Vec::new(), Vec::new());
    for v in VertexId::range(0..t.id_count()) {
        let Ok([x, y]) = t.position(v) else { continue };
        let part = ((0.4 - (x * x + y * y).sqrt()) / 0.2).clamp(0.0, 1.0);
        if part > 0.0 {
            let (sin, cos) = (angle * part).sin_cos();
            ids.push(v);
            goals.push([cos * x - sin * y, sin * x + cos * y]);
        }
    }
    t.move_vertices(&ids, &goals).expect("good places");
    t.commit_timestamp().expect("no conflict");
}

/// Removes or moves a vertex of refinement that no segment is at, or inserts one there.
fn edit_a_vertex(t: &mut Triangulation, rng: &mut Rng) {
    let kept: BTreeSet<VertexId> = t.segments().flat_map(|(_, segment)| segment.ends).collect();
    let made: Vec<_> = t.made_vertices().map(|(v, _)| v).filter(|v| !kept.contains(v)).collect();
    if made.is_empty() {
        return;
    }
    let v = *rng.pick(&made);
    let [x, y] = t.position(v).expect("present");
    match rng.below(3) {
        0 => t.remove_vertex(v).expect("present"),
        1 => {
            t.move_vertices(&[v], &[[x + 0.002, y]]).expect("a good place");
            if t.commit_timestamp().is_err() {
                t.discard_moves();
            }
        }
        _ => drop(t.insert_vertex(&[x + 0.003, y + 0.001])),
    }
}

/// Lays a segment of the program's own along an edge within the domain, or takes away what has become of it.
fn lay_or_take_away(t: &mut Triangulation, rng: &mut Rng) {
    let own: Vec<_> = t.segments().filter(|(_, segment)| segment.marker == OWN).map(|(id, _)| id).collect();
    if !own.is_empty() {
        t.stage_segment_removals(&own).expect("in force");
        t.commit_timestamp().expect("no conflict");
        return;
    }
    let kept: BTreeSet<VertexId> = t.segments().flat_map(|(_, segment)| segment.ends).collect();
    let rows = t.cells().expect("room").corners.iter();
    let edges: Vec<[VertexId; 2]> =
        rows.map(|row| [row[0], row[1]]).filter(|edge| edge.iter().all(|v| !kept.contains(v))).collect();
    if edges.is_empty() {
        return;
    }
    let segment = Segment { ends: *rng.pick(&edges), marker: OWN, ..Segment::default() };
    t.stage_segments(std::iter::once(segment)).expect("present");
    t.commit_timestamp().expect("it is an edge");
}

/// A vertex between two pieces sticks out of the hull by less than what they are joined for: one of the pieces is on the
/// hull, and a cell is beyond the other one. It stays, whatever the direction of the segment, until that cell is gone.
#[test]
fn a_vertex_that_sticks_out_of_the_hull_stays() {
    for ends in [[0, 1], [1, 0]] {
        let points = vec![[0.0, 0.0], [2.0, 0.0], [1.0, 1.0], [3.0, -1e-13]];
        let domain = Domain { points, edges: vec![ends, [1, 2], [2, 0]] };
        let mut t = domain.build();
        let quality = Quality { greatest_area: 0.6, ..Quality::default() };
        let inside = mask(&t, |_| true);
        let report = refine(&mut t, &quality, &RefineOptions::default(), &inside);
        assert_eq!((report.inserted, report.on_segments), (1, 1), "{report:?}");
        let (options, none) = (CoarsenOptions::default(), Quality::default());
        for (height, wanted) in [(-1e-12, 0), (-1e-14, 1)] {
            t.move_vertices(&[VertexId::new(4)], &[[1.0, height]]).expect("present");
            t.commit_timestamp().expect("no conflict");
            let inside = mask(&t, |_| true);
            let report = t.coarsen(&none, &options, &inside).expect("no conflict");
            assert_eq!(report.removed, wanted, "{ends:?}, {height}");
            check_fresh(&t, &|| format!("{ends:?}, {height}"));
        }
    }
}

/// A vertex that comes to the place of an end, and has a lower id, does not become the end when pieces are joined
/// there: the segment stays with its own when they part again.
#[test]
fn joined_pieces_keep_their_ends_where_vertices_share_a_place() {
    let mut domain = Domain::default();
    domain.points.push([0.5, 0.4]);
    let mut domain = domain.with_ring(&rectangle([0.0, 0.0], [1.0, 1.0]));
    domain.points.push([0.4, 0.6]);
    let end = VertexId::new(2);
    for anew in [false, true] {
        let mut t = domain.build();
        let [fine, coarse] =
            [0.002, 0.5].map(|greatest_area| Quality { greatest_area, ..Quality::default() });
        let selected = mask(&t, |_| true);
        refine(&mut t, &fine, &RefineOptions::default(), &selected);
        let goes_to = |t: &mut Triangulation, place| {
            t.move_vertices(&[VertexId::new(0)], &[place]).expect("present");
            t.commit_timestamp().expect("no conflict");
        };
        goes_to(&mut t, domain.points[end.index()]);
        let selected = mask(&t, |_| true);
        let growth = if anew { 1.0 } else { f64::INFINITY };
        let options = CoarsenOptions { growth, ..CoarsenOptions::default() };
        assert!(t.coarsen(&coarse, &options, &selected).expect("a domain").new_segments > 0);
        let selected = mask(&t, |_| true);
        refine(&mut t, &coarse, &RefineOptions::default(), &selected);
        goes_to(&mut t, domain.points[0]);
        check_fresh(&t, &|| format!("made anew: {anew}"));
        let at_end = t.segments().filter(|(_, segment)| segment.ends.contains(&end)).count();
        let at_other = t.segments().filter(|(_, segment)| segment.ends.contains(&VertexId::new(0))).count();
        assert_eq!((at_end, at_other), (2, 0), "made anew: {anew}");
    }
}
