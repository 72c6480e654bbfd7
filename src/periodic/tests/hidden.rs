//! Vertices with weights: who is hidden, beside copies; parts that are staged alone; and what is near by power.

use super::*;
use crate::ids::CellId;
use crate::motion::{Level, PointPart};
use crate::periodic::SavedPeriodic;
use crate::predicates::PointArray;

/// Who is hidden by what: by place, each with the vertex that represents it, and by weight.
type Hidden = (Vec<(VertexId, VertexId)>, Vec<VertexId>);

/// Who is hidden among copies from -n to n, of those that are not translated.
fn hidden_by_copies<G: Moving>(points: &[Option<G::Point>], basis: &[G::Point], n: i64) -> Hidden {
    let (mut all, mut places) = (Vec::new(), Vec::new());
    let range = |j: usize| if j < basis.len() { -n..=n } else { 0..=0 };
    for shift in range(0).flat_map(|x| range(1).flat_map(move |y| range(2).map(move |z| [x, y, z]))) {
        for v in VertexId::range(0..points.len()).filter(|v| points[v.index()].is_some()) {
            all.push((v, shift));
            let there: Vec<G::Point> = points.iter().map(|p| p.unwrap_or_default()).collect();
            places.push(place::<G>(&there, basis, v.get(), shift));
        }
    }
    let keys: Vec<u64> = all.iter().map(|&(v, _)| v.get().into()).collect();
    let t = MovingTriangulation::<G>::with_keys(&places, &keys, Options::default()).unwrap();
    let is_home = |inner: VertexId| all[inner.index()].1 == [0; 3];
    let by_place = t.hidden_by_place().unwrap().into_iter().filter(|&(v, _)| is_home(v));
    let by_weight = t.hidden_by_weight().unwrap().into_iter().map(|(v, _)| v).filter(|&v| is_home(v));
    let vertex = |inner: VertexId| all[inner.index()].0;
    let mut by_place: Vec<_> = by_place.map(|(v, w)| (vertex(v), vertex(w))).collect();
    let mut by_weight: Vec<_> = by_weight.map(vertex).collect();
    by_place.sort_unstable();
    by_weight.sort_unstable();
    (by_place, by_weight)
}

/// A point of a coarse grid, in any period, of a whole weight: many are at one place, and many are tied.
fn coarse_point<G: Moving>(rng: &mut Rng, basis: &[G::Point], greatest: usize) -> G::Point {
    let mut p = G::Point::default();
    for vector in basis {
        let share = rng.below(4) as f64 / 4.0 + rng.below(3) as f64 - 1.0;
        (0..G::D).for_each(|axis| p[axis] += share * vector[axis]);
    }
    for axis in basis.len()..G::D {
        p[axis] += rng.below(3) as f64 / 4.0;
    }
    p[G::D] = rng.below(greatest) as f64 / 16.0;
    p
}

fn check_hidden<G: Moving>(
    t: &PeriodicTriangulation<G>,
    points: &[Option<G::Point>],
    basis: &[G::Point],
) -> Vec<VertexId> {
    let (by_place, by_weight) = hidden_by_copies::<G>(points, basis, 4);
    assert_eq!(t.hidden_vertices().unwrap(), by_place, "{points:?} {basis:?}");
    let found = t.hidden_by_weight().unwrap();
    assert_eq!(found.iter().map(|&(v, _)| v).collect::<Vec<_>>(), by_weight, "{points:?} {basis:?}");
    let has_cells = t.cell_count().unwrap() > 0;
    for &(v, cell) in &found {
        assert_eq!(cell != CellId::NONE, has_cells);
        if has_cells {
            let is_above = |weights: Option<&[f64]>| assert!(weights.unwrap().iter().all(|&x| x >= -1e-9));
            t.barycentric(&[t.position(v).unwrap()], &[cell], is_above).unwrap();
        }
    }
    for v in VertexId::range(0..points.len()).filter(|v| points[v.index()].is_some()) {
        let shown = by_place.iter().find(|&&(hidden, _)| hidden == v).map_or(v, |&(_, shown)| shown);
        assert_eq!(t.coincident_representative(v), Ok(shown));
    }
    let statistics = t.statistics();
    assert_eq!(
        (statistics.coincident, statistics.hidden_by_weight),
        (by_place.len() as u64, by_weight.len() as u64)
    );
    assert_eq!(t.violation(Level::Delaunay), Ok(None));
    let mut hidden: Vec<_> = by_place.into_iter().map(|(v, _)| v).chain(by_weight).collect();
    hidden.sort_unstable();
    hidden
}

/// A history on a coarse grid, with ties, vertices at one place in several periods, and weights that change alone.
fn hidden_history<G: Moving>(seed: u64, basis: &[G::Point], n: usize) {
    let rng = &mut Rng::new(seed);
    let greatest = [1, 3, 20][rng.below(3)];
    let points: Vec<G::Point> = (0..n).map(|_| coarse_point::<G>(rng, basis, greatest)).collect();
    let algorithm = [Algorithm::Auto, Algorithm::Rebuilding, Algorithm::PlacementFlips, Algorithm::Tolerance]
        [rng.below(4)];
    let options = Options { algorithm, ..Options::default() };
    let mut t = PeriodicTriangulation::<G>::new(&points, basis, options).unwrap();
    let mut points: Vec<Option<G::Point>> = points.into_iter().map(Some).collect();
    let mut hidden = check_hidden(&t, &points, basis);
    t.take_changes().unwrap();
    for step in 0..8 {
        let before = points.clone();
        let there: Vec<VertexId> =
            VertexId::range(0..points.len()).filter(|v| points[v.index()].is_some()).collect();
        for &v in &there {
            let goal = coarse_point::<G>(rng, basis, greatest);
            let p = points[v.index()].as_mut().unwrap();
            // The place, the weight, both, or nothing.
            let (moves, weighs) = (rng.one_in(3), rng.one_in(3));
            if moves {
                t.move_parts(PointPart::Place, Some(&[v]), &goal.as_ref()[..G::D]).unwrap();
                let weight = p.weight();
                *p = goal;
                p[G::D] = weight;
            }
            if weighs {
                p[G::D] = goal.weight();
                t.move_parts(PointPart::Weight, Some(&[v]), &[goal.weight()]).unwrap();
            }
        }
        if rng.one_in(2) {
            let coming = coarse_point::<G>(rng, basis, greatest);
            let mut unweighted = coming;
            unweighted[G::D] = 0.0;
            let v = t.stage_insertions(&[unweighted]).unwrap();
            t.move_parts(PointPart::Weight, Some(&[v]), &[coming.weight()]).unwrap();
            points.push(Some(coming));
        }
        if there.len() > 2 && rng.one_in(2) {
            let v = there[rng.below(there.len())];
            t.stage_removals(&[v]).unwrap();
            points[v.index()] = None;
        }
        // What is staged is saved, prepared and withdrawn, and staged again.
        let bytes = t.saved().unwrap();
        let loaded =
            PeriodicTriangulation::<G>::load(&SavedPeriodic::of(&bytes).unwrap(), Options::default());
        let mut loaded = loaded.unwrap();
        assert!(loaded.saved().unwrap() == bytes, "seed {seed}, step {step}");
        let rows = t.cells().unwrap().corners.to_vec();
        let mut copy = t.try_clone(None).unwrap();
        copy.prepare_timestamp().unwrap();
        copy.withdraw_timestamp();
        assert_eq!(t.hidden_vertices(), copy.hidden_vertices());
        assert!(copy.cells().unwrap().corners.len() == rows.len());
        let report = t.commit_timestamp().unwrap();
        loaded.commit_timestamp().unwrap();
        let now = check_hidden(&t, &points, basis);
        assert_eq!(check_hidden(&loaded, &points, basis), now);
        let is_there = |v: &&VertexId| points[v.index()].is_some();
        let newly_hidden: Vec<_> = now.iter().filter(|v| !hidden.contains(v)).copied().collect();
        let newly_shown: Vec<_> =
            hidden.iter().filter(is_there).filter(|v| !now.contains(v)).copied().collect();
        assert_eq!(
            (report.newly_hidden, report.newly_shown),
            (newly_hidden.len() as u64, newly_shown.len() as u64),
            "seed {seed}, step {step}"
        );
        let changed = |differ: &dyn Fn(&G::Point, &G::Point) -> bool| {
            let both = before.iter().zip(&points);
            both.filter(|(was, is)| matches!((was, is), (Some(was), Some(is)) if differ(was, is))).count()
                as u64
        };
        assert_eq!(report.moved, changed(&|was, is| was.as_ref()[..G::D] != is.as_ref()[..G::D]));
        assert_eq!(report.reweighted, changed(&|was, is| was.weight() != is.weight()));
        let changes = t.take_changes().unwrap();
        assert_eq!((changes.hidden, changes.shown), (&newly_hidden[..], &newly_shown[..]));
        let all: Vec<G::Point> = points.iter().map(|p| p.unwrap_or_default()).collect();
        let is_there: Vec<bool> = points.iter().map(Option::is_some).collect();
        let fresh = anew::<G>(&all, &is_there, basis);
        assert_eq!(classes(&t, &all, basis), classes(&fresh, &all, basis), "seed {seed}, step {step}");
        check_near(rng, &t, &points, basis);
        // At rest nothing changes.
        let bytes = t.saved().unwrap();
        let at_rest = t.commit_parts(None, None).unwrap();
        assert_eq!(
            (at_rest.moved, at_rest.reweighted, at_rest.newly_hidden, at_rest.newly_shown),
            (0, 0, 0, 0)
        );
        assert_eq!(t.saved().unwrap().len(), bytes.len());
        hidden = now;
    }
}

/// The nearest vertex by power, and those by distance, beside a look at all copies.
fn check_near<G: Moving>(
    rng: &mut Rng,
    t: &PeriodicTriangulation<G>,
    points: &[Option<G::Point>],
    basis: &[G::Point],
) {
    let there: Vec<G::Point> = points.iter().map(|p| p.unwrap_or_default()).collect();
    for _ in 0..4 {
        let mut q = coarse_point::<G>(rng, basis, 1);
        (0..G::D).for_each(|axis| q[axis] += rng.below(3) as f64 / 8.0);
        let range = |j: usize| if j < basis.len() { -9..=9 } else { 0..=0 };
        let square =
            |p: &G::Point| -> f64 { (0..G::D).map(|axis| (p[axis] - q[axis]) * (p[axis] - q[axis])).sum() };
        let mut distances = Vec::new();
        for v in VertexId::range(0..points.len()).filter(|v| points[v.index()].is_some()) {
            let shifts = range(0).flat_map(|x| range(1).flat_map(move |y| range(2).map(move |z| [x, y, z])));
            let least = shifts.map(|shift| square(&place::<G>(&there, basis, v.get(), shift)));
            distances.push((least.fold(f64::INFINITY, f64::min), v));
        }
        // All numbers are of few digits, so these are exact.
        let power = |&(square, v): &(f64, VertexId)| (square - there[v.index()].weight(), v);
        let nearest =
            distances.iter().map(power).min_by(|a, b| a.partial_cmp(b).unwrap()).map(|(power, _)| power);
        let found = t.nearest_vertex(&q).unwrap().unwrap();
        let of_found = distances.iter().find(|(_, v)| *v == found).map(power).unwrap().0;
        assert_eq!(Some(of_found), nearest);
        distances.sort_by(|a, b| a.partial_cmp(b).unwrap());
        let mut listed = Vec::new();
        t.nearest_vertices(&[q], 3, |v| listed.push(v)).unwrap();
        let wanted: Vec<_> = distances.iter().map(|&(_, v)| v).chain([VertexId::NONE; 3]).take(3).collect();
        assert_eq!(listed, wanted);
        let mut ball = t.vertices_in_ball(&q, 0.25).unwrap();
        ball.sort_unstable();
        let mut wanted: Vec<_> = distances.iter().filter(|&&(d, _)| d <= 0.25).map(|&(_, v)| v).collect();
        wanted.sort_unstable();
        assert_eq!(ball, wanted);
    }
}

#[test]
fn who_is_hidden_is_as_among_copies() {
    for seed in 0..24 {
        let n = [1, 2, 3, 5, 9, 16][seed as usize % 6];
        hidden_history::<PowerPlane>(seed, &unweighted(&[[1.0, 0.0], [0.0, 1.0]]), n);
        hidden_history::<PowerPlane>(seed, &unweighted(&[[1.0, 0.25], [-0.25, 1.0]]), n);
        hidden_history::<PowerPlane>(seed, &unweighted(&[[1.0, 0.0]]), n);
    }
    for seed in 0..3 {
        let n = [1, 2, 5][seed as usize % 3];
        hidden_history::<PowerSpace>(
            seed,
            &unweighted(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
            n,
        );
        hidden_history::<PowerSpace>(seed, &unweighted(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.25]]), n);
    }
}

/// One vertex may be so heavy that all others are hidden, and others so far apart that no sum of both is exact.
#[test]
fn one_heavy_vertex_hides_all_others() {
    for heavy in [4.0, 1e20, 1e114] {
        let rng = &mut Rng::new(3);
        let mut points = random_points::<PowerPlane>(rng, 40, &unweighted(&[[1.0, 0.0], [0.0, 1.0]]));
        points.iter_mut().for_each(|p| p.weight = if heavy == 1e114 { -1e114 } else { 5e-324 });
        points[7].weight = heavy;
        let basis = unweighted(&[[1.0, 0.0], [0.0, 1.0]]);
        let mut t = PeriodicTriangulation::<PowerPlane>::new(&points, &basis, Options::default()).unwrap();
        assert_eq!((t.cell_count(), t.hidden_by_weight().unwrap().len()), (Ok(2), 39));
        let volumes = t.voronoi_volumes(&mut |_| true).unwrap();
        assert_eq!((volumes[7], volumes.iter().sum::<f64>()), (1.0, 1.0));
        t.relocate_part(PointPart::Weight, VertexId::new(7), &[points[0].weight]).unwrap();
        assert_eq!(t.statistics().hidden_by_weight, 0);
        t.relocate_part(PointPart::Weight, VertexId::new(7), &[heavy]).unwrap();
        assert_eq!((t.statistics().hidden_by_weight, t.timestamp()), (39, 0));
    }
}

/// Bad weights are told by name, and change nothing.
#[test]
fn bad_weights_change_nothing() {
    let basis = unweighted(&[[1.0, 0.0], [0.0, 1.0]]);
    let mut points = random_points::<PowerPlane>(&mut Rng::new(3), 9, &basis);
    let good = points.clone();
    points[4].weight = f64::NAN;
    let made = PeriodicTriangulation::<PowerPlane>::new(&points, &basis, Options::default());
    assert!(matches!(made, Err(Error::NotFinite { argument: "weights", index: 4, .. })));
    let mut t = PeriodicTriangulation::<PowerPlane>::new(&good, &basis, Options::default()).unwrap();
    let bytes = t.saved().unwrap();
    let mut weights = vec![0.5; 9];
    weights[3] = 1e115;
    let bad = t.commit_parts(None, Some(&weights));
    assert!(matches!(bad, Err(Error::OutOfRange { argument: "weights", index: 3, .. })), "{bad:?}");
    let bad = t.move_parts(PointPart::Weight, None, &weights);
    assert!(matches!(bad, Err(Error::OutOfRange { argument: "weights", index: 3, .. })), "{bad:?}");
    let ids = VertexId::of_numbers(&[2, 3, 2]);
    let bad = t.move_parts(PointPart::Weight, Some(ids), &[1.0, 2.0, 3.0]);
    assert!(matches!(bad, Err(Error::DuplicateMove { argument: "vertices", index: 2, .. })), "{bad:?}");
    assert!(t.saved().unwrap() == bytes);
    t.move_parts(PointPart::Place, Some(&ids[..1]), &[0.25, 0.5]).unwrap();
    let staged = t.saved().unwrap();
    let bad = t.move_parts(PointPart::Weight, Some(ids), &[1.0, 2.0, 3.0]);
    assert!(matches!(bad, Err(Error::DuplicateMove { .. })));
    assert!(t.saved().unwrap() == staged);
    assert_eq!(t.discard_moves(), 1);
    assert!(t.saved().unwrap() == bytes);
}

/// All weights change by one number, and all vertices go by one vector, after some have been removed and while some are hidden.
#[test]
fn all_that_change_alike_keep_their_cells() {
    let basis = unweighted(&[[1.0, 0.0], [0.0, 1.0]]);
    let points = random_points::<PowerPlane>(&mut Rng::new(6), 60, &basis);
    let mut points: Vec<_> = points.into_iter().map(Some).collect();
    // Numbers of few digits: then all differences are exact.
    points.iter_mut().flatten().for_each(|p| p.weight = (p.weight * 4096.0).round() / 4096.0);
    let given: Vec<_> = points.iter().flatten().copied().collect();
    let mut t = PeriodicTriangulation::<PowerPlane>::new(&given, &basis, Options::default()).unwrap();
    t.remove_vertex(VertexId::new(7)).unwrap();
    points[7] = None;
    for (way, more) in [(0.0, -3.0), (0.25, 0.0), (-0.125, 8.0), (0.0, -16.0)] {
        for p in points.iter_mut().flatten() {
            *p = WeightedPoint { place: p.place.map(|x| x + way), weight: p.weight + more };
        }
        let goals: Vec<_> = points.iter().map(|p| p.unwrap_or_default()).collect();
        let report = t.commit_positions(&goals).unwrap();
        assert_eq!((report.newly_hidden, report.newly_shown), (0, 0));
        check_hidden(&t, &points, &basis);
    }
}
