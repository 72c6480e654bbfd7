//! Refinement that gives ids again.

use super::lives::{LIMIT, coarsen, count_bad, domain_of, domains, quality};
use super::loops::Rotor;
use super::{Triangulation, check_fresh};
use crate::common::cell_set;
use deldrift::motion::{
    Algorithm, CoarsenOptions, Kept, Options, Quality, QualityReport, RefineOptions, Saved, Segment,
};
use deldrift::{Error, VertexId};
use std::collections::BTreeSet;
use std::ops::ControlFlow;

const OPTIONS: RefineOptions =
    RefineOptions { keeps: Kept::None, limit: LIMIT, has_weights: true, reuses_ids: true };

fn refine(t: &mut Triangulation, asked: &Quality) -> QualityReport {
    let mask = domain_of(t);
    t.refine(asked, &OPTIONS, &mask).expect("a domain")
}

fn bytes(t: &Triangulation) -> Vec<u8> {
    t.saved().expect("room")
}

fn loaded(bytes: &[u8]) -> Triangulation {
    Triangulation::load(&Saved::of(bytes).expect("saved"), Options::default()).expect("saved")
}

/// Whether two have the same vertices, cells and segments, and tell the same of those inserted last.
pub(super) fn assert_same(s: &Triangulation, t: &Triangulation, context: &dyn Fn() -> String) {
    assert_eq!(s.refined_vertices(), t.refined_vertices(), "{}", context());
    assert_eq!(s.refined_weights(), t.refined_weights(), "{}", context());
    let places =
        |t: &Triangulation| VertexId::range(0..t.id_count()).map(|v| t.position(v).ok()).collect::<Vec<_>>();
    assert!(places(s) == places(t) && s.made_vertices().eq(t.made_vertices()), "{}", context());
    assert!(cell_set(s) == cell_set(t) && s.segments().eq(t.segments()), "{}", context());
}

fn present(t: &Triangulation) -> BTreeSet<VertexId> {
    VertexId::range(0..t.id_count()).filter(|&v| t.is_present(v)).collect()
}

/// In a loop there are as many ids as the most vertices, but for few, and where the mesh is made anew, as old and new
/// vertices have different ones, at most twice as many. The cells are those of a fresh build, values of linear functions
/// are carried, and copies answer alike.
#[test]
fn ids_of_a_loop_are_as_many_as_its_vertices() {
    for (angle, area, growth, most_ids) in
        [(25.0, 0.004, f64::INFINITY, 1.3), (25.0, 0.004, 1.1, 2.0), (33.0, 0.01, 1.1, 2.0)]
    {
        let asked = quality(angle, area);
        let coarsening = CoarsenOptions { growth, ..CoarsenOptions::default() };
        let linear = |p: [f64; 2]| 3.0 + 2.0 * p[0] - 0.5 * p[1];
        let mut rotor = Rotor::new();
        rotor.t.set_algorithm(Algorithm::Auto);
        refine(&mut rotor.t, &asked);
        let (mut most, mut n_reused, mut n_anew, mut n_inserted) = (rotor.t.vertex_count(), 0, 0, 0);
        let mut values: Vec<f64> = Vec::new();
        for step in 0..300 {
            rotor.step(0.02);
            let t = &mut rotor.t;
            let mask = domain_of(t);
            t.coarsen(&asked, &coarsening, &mask).expect("a domain");
            values.resize(t.id_count(), f64::NAN);
            for v in present(t) {
                values[v.index()] = linear(t.position(v).expect("present"));
            }
            let (before, n_before) = (present(t), t.id_count());
            // The ends of all segments that there were are there.
            let wanted: Vec<_> = VertexId::range(0..n_before).filter(|v| !before.contains(v)).collect();
            let copies = (step % 30 == 0).then(|| [loaded(&bytes(t)), t.try_clone(None).expect("room")]);
            let report = refine(t, &asked);
            for mut copy in copies.into_iter().flatten() {
                assert_eq!(refine(&mut copy, &asked), report, "{step}");
                assert_same(&copy, t, &|| format!("{angle} degrees, step {step}"));
            }
            let ids = t.refined_vertices().to_vec();
            assert_eq!(ids.len(), report.inserted, "{step}");
            // Those that were free, the lowest first, and then new ones.
            let wanted = wanted.into_iter().chain((n_before..).map(VertexId::at));
            assert!(ids.iter().copied().eq(wanted.take(ids.len())), "{step}: {ids:?}");
            let new: BTreeSet<_> = present(t).difference(&before).copied().collect();
            assert!(new.iter().eq(&ids), "{step}");
            let made: Vec<_> = t.made_vertices().map(|(v, _)| v).collect();
            assert!(made.is_sorted() && ids.iter().all(|v| made.binary_search(v).is_ok()), "{step}");
            let weights = t.refined_weights();
            assert_eq!(weights.len(), ids.len(), "{step}");
            let sums: Vec<f64> = weights
                .iter()
                .map(|row| row.vertices.iter().zip(row.weights).map(|(&v, w)| values[v.index()] * w).sum())
                .collect();
            for (v, sum) in ids.iter().zip(sums) {
                let wanted = linear(t.position(*v).expect("it has been inserted"));
                assert!((sum - wanted).abs() < 1e-13, "{step}, {v}: {sum} {wanted}");
            }
            assert_eq!(count_bad(t, &asked), 0, "{step}");
            if step % 20 == 0 {
                check_fresh(t, &|| format!("{angle} degrees, step {step}"));
            }
            n_reused += ids.iter().filter(|v| v.index() < n_before).count();
            n_anew += usize::from(report.removed > 0);
            n_inserted += report.inserted;
            most = most.max(t.vertex_count());
        }
        let n_ids = rotor.t.id_count();
        println!(
            "{angle} degrees, {growth}: {n_ids} ids, {most} vertices, {n_inserted} inserted, {n_anew} times anew"
        );
        assert!(n_ids as f64 <= most_ids * most as f64, "{n_ids} ids of {most} vertices");
        assert!(n_reused > most && (growth < f64::INFINITY) == (n_anew > 0), "{n_reused} {n_anew}");
        // At rest nothing changes from the second round on, and nothing is told.
        for round in 0..3 {
            let saved = bytes(&rotor.t);
            let mask = domain_of(&rotor.t);
            rotor.t.coarsen(&asked, &coarsening, &mask).expect("a domain");
            refine(&mut rotor.t, &asked);
            let is_same = bytes(&rotor.t) == saved && rotor.t.refined_vertices().is_empty();
            assert!(round == 0 || is_same, "{angle} degrees, {growth}, {round}");
        }
        // A compaction tells nothing either, and leaves no id free.
        rotor.t.compact().expect("room");
        assert_eq!(rotor.t.id_count(), rotor.t.vertex_count());
        for _ in 0..30 {
            rotor.step(0.02);
            coarsen(&mut rotor.t, &asked);
            assert_eq!(refine(&mut rotor.t, &asked).bad_cells, 0);
            if !rotor.t.refined_vertices().is_empty() {
                break;
            }
        }
        assert!(!rotor.t.refined_vertices().is_empty());
        check_fresh(&rotor.t, &|| format!("{angle} degrees, compacted"));
        rotor.t.compact().expect("room");
        assert!(rotor.t.refined_vertices().is_empty());
    }
}

/// Domains with many vertices on common circles: what refinement has foreseen are the cells, whichever ids are free.
#[test]
fn ids_decide_no_cells() {
    for (name, size, domain) in domains() {
        let [fine, coarse] = [0.002, 0.02].map(|area| quality(20.0, area * size * size));
        let mut all = [false, true].map(|reuses_ids| {
            let mut t = domain.build();
            let options = RefineOptions { reuses_ids, ..OPTIONS };
            for asked in [&fine, &coarse, &fine, &coarse, &fine] {
                coarsen(&mut t, asked);
                let mask = domain_of(&t);
                let report = t.refine(asked, &options, &mask).expect("a domain");
                check_fresh(&t, &|| format!("{name}, {reuses_ids}"));
                let mask = domain_of(&t);
                let saved = bytes(&t);
                let again = t.refine(asked, &options, &mask).expect("a domain");
                assert_eq!((again.inserted, again.bad_cells), (0, report.bad_cells), "{name}, {reuses_ids}");
                assert!(bytes(&t) == saved, "{name}, {reuses_ids}");
            }
            t
        });
        let [plain, reused] = all.each_mut().map(|t| t.id_count());
        assert!(reused < plain, "{name}: {reused} {plain}");
        // Those with keys go on without being asked for ids.
        let mask = domain_of(&all[1]);
        let finer = quality(20.0, 0.001 * size * size);
        let plain = RefineOptions { reuses_ids: false, ..OPTIONS };
        let report = all[1].refine(&finer, &plain, &mask).expect("a domain");
        let first = all[1].id_count() - report.inserted;
        assert!(all[1].refined_vertices().iter().copied().eq(VertexId::range(first..all[1].id_count())));
        check_fresh(&all[1], &|| format!("{name}, at new ids"));
    }
}

/// A call that ends in an error, or has nothing to do, leaves the bytes that there were, keys or none.
#[test]
fn a_refusal_leaves_all_alone() {
    let domain = &domains()[1].2;
    let mut t = domain.build();
    let before = bytes(&t);
    let mask = domain_of(&t);
    let stop = |_: [[f64; 2]; 3]| ControlFlow::Break(());
    let asked = Quality { is_too_large: Some(&stop), ..quality(0.0, 0.0) };
    assert_eq!(t.refine(&asked, &OPTIONS, &mask), Err(Error::Cancelled));
    assert!(bytes(&t) == before && !t.has_keys());
    assert_eq!(t.refine(&quality(0.0, 2.0), &OPTIONS, &mask).expect("a domain").inserted, 0);
    assert!(bytes(&t) == before && !t.has_keys());
    let none = RefineOptions { limit: 0, ..OPTIONS };
    assert_eq!(t.refine(&quality(0.0, 0.1), &none, &mask).expect("a domain").inserted, 0);
    assert!(bytes(&t) == before && !t.has_keys());
    assert!(refine(&mut t, &quality(0.0, 0.1)).inserted > 0 && t.has_keys());
}

/// The end of a segment that has been split is known by the pieces that are left, and its id is not given again before
/// these are gone.
#[test]
fn ends_of_originals_are_not_given_again() {
    let square = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [1.0, 1.0], [3.0, 1.0]];
    let mut t = Triangulation::new(&square, Options::default()).expect("good points");
    let ends = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5]];
    let segment = |(marker, ends): (i32, [usize; 2])| Segment {
        ends: ends.map(VertexId::at),
        marker,
        ..Segment::default()
    };
    t.stage_segments(ends.map(|ends| segment((0, ends))).into_iter()).expect("present");
    t.commit_timestamp().expect("no conflict");
    refine(&mut t, &quality(20.0, 0.1));
    // The piece at the end of the inner segment goes, and so does the end.
    let end = VertexId::new(4);
    let at_end: Vec<_> = t.segments().filter(|(_, s)| s.ends.contains(&end)).map(|(id, _)| id).collect();
    assert_eq!(at_end.len(), 1);
    t.stage_segment_removals(&at_end).expect("in force");
    t.commit_timestamp().expect("no conflict");
    t.remove_vertex(end).expect("present");
    let free = |t: &mut Triangulation| {
        let mut first = None;
        t.stage_insertions_at_free_ids(&[[0.5, 3.2]], None, |v| first = Some(v)).expect("room");
        t.discard_moves();
        first.expect("an id")
    };
    let n = t.id_count();
    assert_eq!(free(&mut t), VertexId::at(n));
    let mut copy = loaded(&bytes(&t));
    assert_eq!(free(&mut copy), VertexId::at(n));
    let report = refine(&mut t, &quality(25.0, 0.05));
    assert!(report.inserted > 0 && t.refined_vertices()[0] == VertexId::at(n));
    assert_eq!(refine(&mut copy, &quality(25.0, 0.05)), report);
    assert_same(&copy, &t, &|| "a loaded copy".to_owned());
    // A vertex that refinement has made and the program has removed is another one, made by the program, from then on.
    let made = t.refined_vertices()[5];
    if t.segments().all(|(_, s)| !s.ends.contains(&made)) {
        t.remove_vertex(made).expect("present");
        assert_eq!(free(&mut t), made);
        t.stage_insertions_at_free_ids(&[[0.5, 3.2]], None, |v| assert_eq!(v, made)).expect("room");
        t.commit_timestamp().expect("no conflict");
        assert!(t.is_present(made) && t.made_vertices().all(|(v, _)| v != made));
        assert!(bytes(&loaded(&bytes(&t))) == bytes(&t));
    }
    // Without pieces the end is free.
    let inner: Vec<_> =
        t.segments().map(|(id, _)| id).filter(|&id| t.original_segment(id).index() == 4).collect();
    t.stage_segment_removals(&inner).expect("in force");
    t.commit_timestamp().expect("no conflict");
    assert_eq!(free(&mut t), end);
}

/// Where all ids that are free are below those of the vertices that are there, ties in a lattice are as was foreseen.
#[test]
fn low_ids_decide_no_ties() {
    const N_FREE: usize = 60;
    let lattice = (0..25).map(|k| [(k % 5) as f64, (k / 5) as f64]);
    let free = (0..N_FREE).map(|k| [0.3 + 0.05 * k as f64, 1.1 + 0.03 * (k * k % 17) as f64]);
    let points: Vec<_> = free.chain(lattice).collect();
    for (angle, area) in [(0.0, 0.4), (0.0, 0.2), (0.0, 0.1), (20.0, 0.2), (26.0, 0.15), (30.0, 0.1)] {
        let mut t = Triangulation::new(&points, Options::default()).expect("good points");
        (0..N_FREE).for_each(|k| t.remove_vertex(VertexId::at(k)).expect("present"));
        let corners = [0, 4, 24, 20];
        let sides = (0..4).flat_map(|k| {
            let (a, b) = (corners[k], corners[(k + 1) % 4]);
            (0..4).map(move |j| [a + (b - a) / 4 * j, a + (b - a) / 4 * (j + 1)])
        });
        let segments: Vec<_> = sides
            .map(|ends| Segment {
                ends: ends.map(|v| VertexId::at(N_FREE + v as usize)),
                marker: 0,
                ..Segment::default()
            })
            .collect();
        t.stage_segments(segments.into_iter()).expect("present");
        t.commit_timestamp().expect("no conflict");
        let asked = quality(angle, area);
        let report = refine(&mut t, &asked);
        assert!(report.inserted > 10 && t.refined_vertices()[0] == VertexId::new(0), "{angle}, {area}");
        check_fresh(&t, &|| format!("{angle}, {area}"));
        assert_eq!((report.bad_cells, count_bad(&t, &asked)), (0, 0), "{angle}, {area}");
        let saved = bytes(&t);
        assert_eq!(refine(&mut t, &asked).inserted, 0, "{angle}, {area}");
        assert!(bytes(&t) == saved, "{angle}, {area}");
    }
}

/// Values that a program has by id before it coarsens are carried once, after it has refined: ids of vertices that
/// coarsening has removed are given again, pieces are joined, and meshes are made anew, and linear functions stay.
#[test]
fn values_are_carried_over_both() {
    let (mut n_reused, mut n_anew, mut n_joined, mut n_inserted) = (0, 0, 0, 0);
    for (name, size, domain) in domains() {
        for (reuses_ids, growth, joins) in
            [(false, 1.1, 1e-9), (true, 1.1, 1e-9), (true, f64::INFINITY, 0.01), (true, 1.0, 0.01)]
        {
            let mut t = domain.build();
            let options = RefineOptions { reuses_ids, ..OPTIONS };
            let coarsening = CoarsenOptions { growth, joins, ..CoarsenOptions::default() };
            let qualities =
                [(25.0, 0.004), (30.0, 0.03), (20.0, 0.002), (0.0, 0.05), (25.0, 0.05), (33.0, 0.01)];
            for (round, (angle, area)) in qualities.into_iter().cycle().take(9).enumerate() {
                let asked = quality(angle, area * size * size);
                let origin = t.position(present(&t).pop_first().expect("there are some")).expect("present");
                let linear = |p: [f64; 2]| 3.0 + (2.0 * (p[0] - origin[0]) - 0.5 * (p[1] - origin[1])) / size;
                let places: Vec<_> = VertexId::range(0..t.id_count()).map(|v| t.position(v)).collect();
                // Nothing is carried from a vertex that there was not.
                let mut values: Vec<f64> =
                    places.iter().map(|place| place.as_ref().map_or(f64::NAN, |&p| linear(p))).collect();
                let n_segments = t.segments().count();
                let mask = domain_of(&t);
                let coarsened = t.coarsen(&asked, &coarsening, &mask).expect("a domain");
                n_joined += n_segments - t.segments().count();
                let mask = domain_of(&t);
                let refined = t.refine(&asked, &options, &mask).expect("a domain");
                n_reused += t.refined_vertices().iter().filter(|v| v.index() < places.len()).count();
                n_inserted += refined.inserted;
                n_anew += usize::from(refined.removed > 0);
                values.resize(t.id_count(), f64::NAN);
                // One after the other, in place, as the bindings do it.
                for (v, row) in t.refined_vertices().iter().zip(t.refined_weights()) {
                    let terms = row.vertices.iter().zip(row.weights);
                    values[v.index()] = terms.map(|(&v, weight)| values[v.index()] * weight).sum();
                }
                for v in present(&t) {
                    let (is, p) = (values[v.index()], t.position(v).expect("present"));
                    let magnitude = 1.0 + (p[0].abs() + p[1].abs()) / size;
                    assert!(
                        (is - linear(p)).abs() <= 1e-12 * magnitude,
                        "{name}, round {round}, {coarsening:?}, {v}: {is} {} {coarsened:?} {refined:?}",
                        linear(p)
                    );
                }
            }
        }
    }
    println!(
        "{n_inserted} inserted, {n_reused} at ids given again, {n_anew} made anew, {n_joined} pieces joined"
    );
    assert!(n_reused > 1000 && n_anew > 20 && n_joined > 500, "{n_reused} {n_anew} {n_joined}");
}
