//! Triangulations with weights are saved and loaded whole, and go on; data that are not those of one are refused.

use super::{History, Shown, fresh, shown};
use crate::common::inputs::KINDS;
use crate::common::{Rng, assert_same_cells, check_adjacency, seeds, vertex};
use crate::saving_format::{Parts, Weighted, forged, seal};
use deldrift::internals::{PowerPlane, PowerSpace};
use deldrift::motion::{Algorithm, CoincidencePolicy, Level, MovingTriangulation, Options, PointPart, Saved};
use deldrift::{AnyTriangulation, Damage, LoadError, Moving, Plane, Space, VertexId};

fn load<G: Moving>(bytes: &[u8]) -> Result<MovingTriangulation<G>, LoadError> {
    MovingTriangulation::load(&Saved::of(bytes)?, Options::default())
}

fn damage_of<G: Moving>(parts: &Parts) -> Damage {
    match load::<G>(&parts.bytes()) {
        Err(LoadError::Data(damage)) => damage,
        other => panic!("{:?}", other.map(|t| t.cell_count())),
    }
}

fn positions_of<G: Moving>(t: &MovingTriangulation<G>) -> Vec<Option<G::Point>> {
    VertexId::range(0..t.id_count()).map(|v| t.position(v).ok()).collect()
}

/// Everything that is read of one is read of the other, and what is staged is the same.
fn assert_same<G: Moving>(t: &MovingTriangulation<G>, other: &MovingTriangulation<G>, context: &str) {
    let (own, others) = (t.cells().expect("room"), other.cells().expect("room"));
    assert_eq!(own.corners, others.corners, "{context}");
    assert_eq!(own.neighbours, others.neighbours, "{context}");
    assert_eq!(t.vertices_hidden_by_weight(), other.vertices_hidden_by_weight(), "{context}");
    assert_eq!(positions_of(t), positions_of(other), "{context}");
    assert_eq!(t.statistics_of_now(), other.statistics_of_now(), "{context}");
    assert_eq!(
        (t.staged_count(), t.staged_edits()),
        (other.staged_count(), other.staged_edits()),
        "{context}"
    );
    assert!(t.saved().expect("room") == other.saved().expect("room"), "{context}: saved again");
}

/// The bytes are those that the format says, and hold what is read.
fn check_bytes<G: Moving>(t: &MovingTriangulation<G>, bytes: &[u8], context: &str) {
    let parts = Parts::read(bytes);
    assert_eq!(parts.bytes(), bytes, "{context}");
    let Weighted { weights, below, .. } = parts.weighted.expect("weights");
    let cells = t.cells().expect("room");
    let by_weight = t.hidden_by_weight().expect("room");
    let by_place = t.hidden_by_place().expect("room");
    for v in VertexId::range(0..t.id_count()) {
        let k = v.index();
        let place = &parts.positions[k * G::D..(k + 1) * G::D];
        match t.position(v) {
            Ok(p) => {
                assert_eq!((place, weights[k]), (p.as_ref(), p[G::D]), "{context}: vertex {v}");
                assert_eq!(parts.representatives[k], v.get(), "{context}: vertex {v}");
            }
            Err(_) => {
                assert!(place.iter().chain([&weights[k]]).all(|x| x.is_nan()), "{context}: id {v}");
                assert_eq!(parts.representatives[k], u32::MAX, "{context}: id {v}");
            }
        }
        let cell =
            by_weight.iter().find(|&&(hidden, _)| hidden == v).map_or(u32::MAX, |&(_, cell)| cell.get());
        if by_place.iter().any(|&(hidden, _)| hidden == v) && !cells.corners.is_empty() {
            assert!((below[k] as usize) < cells.corners.len(), "{context}: vertex {v}");
        } else {
            assert_eq!(below[k], cell, "{context}: vertex {v}");
        }
    }
    assert_eq!(weights.len(), t.id_count(), "{context}");
}

impl<G: Moving> History<G> {
    /// A history like this one, that goes on with another triangulation.
    fn with(&self, t: MovingTriangulation<G>) -> Self {
        let (points, rng, name) = (self.points.clone(), self.rng.clone(), self.name.clone());
        History { t, points, kind: self.kind, n: self.n, most: self.most, unit: self.unit, rng, name }
    }

    /// Stages moves, and sometimes insertions and removals.
    fn stage(&mut self) {
        for v in self.present() {
            if self.rng.one_in(3) {
                let q = self.goal(&self.points[v.index()].expect("present"));
                let point = self.points[v.index()].as_mut().expect("present");
                match self.rng.below(3) {
                    0 => {
                        self.t.move_vertices(&[v], &[q]).expect("good places");
                        *point = q;
                    }
                    1 => {
                        self.t.move_parts(PointPart::Place, Some(&[v]), q.as_ref()).expect("good places");
                        (0..G::D).for_each(|k| point[k] = q[k]);
                    }
                    _ => {
                        self.t.move_parts(PointPart::Weight, Some(&[v]), &[q[G::D]]).expect("good weights");
                        point[G::D] = q[G::D];
                    }
                }
            }
        }
        self.stage_edits();
    }
}

/// Histories that go on beside what has been loaded of them: with what is staged, flat sets without cells as well.
fn loaded_go_on<G: Moving>(n: u64) {
    let (mut n_hidden, mut n_flat, mut n_staged) = (0, 0, 0);
    for kind in KINDS {
        for seed in seeds(n) {
            let mut history = History::<G>::new(kind, seed + 500);
            for step in 0..10 {
                let is_staged = step % 3 == 2;
                if is_staged {
                    history.stage();
                }
                let bytes = history.t.saved().expect("room");
                assert_eq!(bytes.len(), history.t.saved_size());
                let loaded = load::<G>(&bytes).unwrap_or_else(|error| panic!("{}: {error}", history.name));
                loaded.validate(Level::Delaunay).expect("a regular triangulation");
                check_bytes(&loaded, &bytes, &history.name);
                let sums = loaded.statistics();
                assert_eq!(sums.coincident as usize, loaded.hidden_by_place().expect("room").len());
                assert_eq!(sums.hidden_by_weight as usize, loaded.hidden_by_weight().expect("room").len());
                assert_same(&history.t, &loaded, &history.name);
                assert!(loaded.saved().expect("room") == bytes, "{}", history.name);
                let mut beside = history.with(loaded);
                n_hidden += history.t.vertices_hidden_by_weight().expect("room").len();
                n_flat += usize::from(history.t.cell_count() == 0);
                n_staged += history.t.staged_count();
                let what = if is_staged { 7 } else { history.rng.below(8) };
                for history in [&mut history, &mut beside] {
                    history.rng = Rng::new(seed ^ step << 8);
                    if is_staged {
                        let algorithm = *history.rng.pick(&Algorithm::ALL);
                        history.t.set_algorithm(algorithm);
                        history.t.commit_timestamp().expect("room");
                        history.name += &format!(" {algorithm:?}");
                    } else {
                        history.step(what);
                    }
                    history.check();
                }
                assert_eq!(shown(&history.t), shown(&beside.t), "{}", history.name);
                if history.rng.one_in(2) {
                    history = beside;
                }
            }
        }
    }
    assert!(
        n_hidden as u64 > 100 * n && n_flat as u64 > 2 * n && n_staged as u64 > 100 * n,
        "{n_hidden} {n_flat} {n_staged}"
    );
}

#[test]
fn loaded_triangulations_go_on_in_the_plane() {
    loaded_go_on::<PowerPlane>(12);
}

#[test]
fn loaded_triangulations_go_on_in_space() {
    loaded_go_on::<PowerSpace>(8);
}

fn point<G: Moving>(mut number: impl FnMut(usize) -> f64) -> G::Point {
    let mut p = G::Point::default();
    (0..G::NUMBERS).for_each(|k| p[k] = number(k));
    p
}

/// Small coordinates and weights, so that there are ties and many at one place.
fn small<G: Moving>(n: usize, most: i64, rng: &mut Rng) -> Vec<G::Point> {
    (0..n).map(|_| point::<G>(|k| rng.within(0, if k < G::D { 4 } else { most }) as f64)).collect()
}

fn build<G: Moving>(points: &[G::Point]) -> MovingTriangulation<G> {
    MovingTriangulation::new(points, Options::default()).expect("a build")
}

/// Of a vertex of which a part is staged, the other part can be staged after loading as well, and this one cannot.
#[test]
fn staged_parts_are_saved() {
    let points = small::<PowerPlane>(9, 6, &mut Rng::new(3));
    let mut t = build::<PowerPlane>(&points);
    let [v, w, both] = [1, 2, 3].map(vertex);
    t.move_parts(PointPart::Place, Some(&[v]), &[0.25, 0.5]).expect("a place");
    t.move_parts(PointPart::Weight, Some(&[w]), &[7.0]).expect("a weight");
    t.move_vertices(&[both], &points[..1]).expect("a place and a weight");
    t.stage_insertions(&points[..1]).expect("a place");
    let bytes = t.saved().expect("room");
    let whole = Parts::read(&bytes);
    let moved = &whole.weighted.as_ref().expect("weights").moved;
    assert!(moved[0].is_nan() && moved[1] == 7.0 && !moved[2].is_nan());
    assert!(whole.moved[2..4].iter().all(|x| x.is_nan()));
    let mut loaded = load::<PowerPlane>(&bytes).expect("saved");
    assert_same(&t, &loaded, "parts");
    for t in [&mut t, &mut loaded] {
        t.move_parts(PointPart::Place, Some(&[v]), &[0.0; 2]).expect_err("it is staged");
        t.move_parts(PointPart::Weight, Some(&[w]), &[1.0]).expect_err("it is staged");
        t.move_parts(PointPart::Weight, Some(&[v]), &[3.0]).expect("it is not");
        t.move_parts(PointPart::Place, Some(&[w]), &[2.5, 1.5]).expect("it is not");
        for part in [PointPart::Place, PointPart::Weight] {
            t.move_parts(part, Some(&[both]), &[1.0; 2][..1 + usize::from(part == PointPart::Place)])
                .expect_err("both are staged");
        }
        t.commit_timestamp().expect("room");
    }
    assert_eq!(shown(&t), shown(&loaded));
    assert_eq!(positions_of(&t), positions_of(&loaded));
    assert_eq!(t.statistics().reweighted, loaded.statistics().reweighted);
    // A coordinate alone is no part, nor is a weight of an insertion a move.
    let told = |change: &dyn Fn(&mut Parts)| {
        let mut parts = whole.clone();
        change(&mut parts);
        damage_of::<PowerPlane>(&parts)
    };
    assert!(matches!(told(&|p| p.moved[0] = f64::NAN), Damage::Position { axis: 0, .. }));
    assert!(matches!(told(&|p| p.moved[4] = f64::NAN), Damage::Position { axis: 0, .. }));
    // Without its position a move is that of a weight.
    let mut parts = whole.clone();
    parts.moved[4..6].fill(f64::NAN);
    assert!(check_forged::<PowerPlane>(&parts.bytes()));
    assert_eq!(told(&|p| p.moves[1] = 9), Damage::Staged { vertex: vertex(9) });
    assert_eq!(told(&|p| p.moves[1] = 1), Damage::Staged { vertex: vertex(1) });
}

/// Two vertices at one place are refused where the options reject that, as they are without weights.
#[test]
fn shared_places_are_refused_where_the_options_reject_them() {
    let mut points = small::<PowerSpace>(6, 0, &mut Rng::new(3));
    points.push(points[2]);
    points[6].weight = -3.0;
    let bytes = build::<PowerSpace>(&points).saved().expect("room");
    let options = Options { coincidence: CoincidencePolicy::Reject, ..Options::default() };
    let loaded = MovingTriangulation::<PowerSpace>::load(&Saved::of(&bytes).expect("whole"), options);
    assert!(matches!(loaded.err(), Some(LoadError::Call(deldrift::Error::Coincident { .. }))));
}

/// With keys the version is another one, and ties are decided by them.
fn keys_are_saved<G: Moving>() {
    let rng = &mut Rng::new(4);
    for _ in 0..200 {
        let n = 5 + rng.below(30);
        let points = small::<G>(n, 6, rng);
        let keys: Vec<u64> = (0..n).map(|_| rng.below(9) as u64).collect();
        let mut t = MovingTriangulation::<G>::with_keys(&points, &keys, Options::default()).expect("a build");
        let coming = small::<G>(3, 6, rng);
        t.stage_insertions_with_keys(&coming, &[1, 7, 2]).expect("room");
        let bytes = t.saved().expect("room");
        assert_eq!(bytes[8], 10);
        let mut loaded = load::<G>(&bytes).expect("saved");
        assert_same(&t, &loaded, "with keys");
        let mut discarded = load::<G>(&bytes).expect("saved");
        discarded.discard_moves();
        for t in [&mut t, &mut loaded] {
            t.commit_timestamp().expect("room");
        }
        assert_eq!(shown(&t), shown(&loaded));
        let again = load::<G>(&discarded.saved().expect("room")).expect("saved");
        assert_same(&again, &discarded, "discarded");
    }
}

#[test]
fn keys_are_saved_with_weights() {
    keys_are_saved::<PowerPlane>();
    keys_are_saved::<PowerSpace>();
}

/// What may be damaged: with hidden vertices and all kinds of things staged, on a line, and nothing.
fn samples<G: Moving>() -> [MovingTriangulation<G>; 3] {
    let rng = &mut Rng::new(5);
    let mut t = build::<G>(&small::<G>(10 + 2 * G::D, 9, rng));
    t.remove_vertex(vertex(2)).expect("a removal");
    t.stage_insertions(&small::<G>(2, 9, rng)).expect("room");
    t.stage_removals(&[vertex(4)]).expect("present");
    t.move_vertices(&[vertex(6), vertex(5)], &small::<G>(2, 9, rng)).expect("present");
    assert!(t.vertices_hidden_by_weight().expect("room").len() > 1 && t.cell_count() > 2);
    let line: Vec<G::Point> = (0..5).map(|i| point::<G>(|k| (i % 4 * (k + 1)) as f64)).collect();
    [t, build(&line), build(&[])]
}

fn every_byte_is_protected<G: Moving>() {
    for t in samples::<G>() {
        let bytes = t.saved().expect("room");
        let damaged = |bytes: &[u8]| load::<G>(bytes).expect_err("damaged");
        for at in 0..bytes.len() {
            let mut bytes = bytes.clone();
            for change in 1..=255 {
                bytes[at] ^= change;
                let error = damaged(&bytes);
                assert!(matches!(error, LoadError::Data(_)), "byte {at}: {error}");
                bytes[at] ^= change;
            }
            damaged(&bytes[..at]);
        }
    }
}

#[test]
fn every_byte_is_protected_in_both_dimensions() {
    every_byte_is_protected::<PowerPlane>();
    every_byte_is_protected::<PowerSpace>();
}

/// Data whose checksum is right are refused, or those of the regular triangulation of what they hold. Whether they are
/// loaded.
fn check_forged<G: Moving>(bytes: &[u8]) -> bool {
    match load::<G>(bytes) {
        Err(LoadError::Data(damage)) => {
            assert!(!damage.to_string().is_empty());
            false
        }
        Err(error) => panic!("{error}"),
        Ok(t) => {
            let (cells, hidden): Shown = shown(&t);
            let (fresh_cells, fresh_hidden) = fresh::<G>(&positions_of(&t));
            assert_same_cells(&cells, &fresh_cells, || "forged".to_string());
            assert_eq!(hidden, fresh_hidden);
            check_adjacency(&t, &|| "forged".to_string());
            let again = t.saved().expect("room");
            assert_same(&t, &load::<G>(&again).expect("saved"), "forged");
            true
        }
    }
}

fn forged_bytes_are_regular_or_refused<G: Moving>() {
    let rng = &mut Rng::new(9);
    let (mut n_refused, mut n_loaded) = (0, 0);
    for t in samples::<G>() {
        let bytes = t.saved().expect("room");
        for at in 0..bytes.len() - 4 {
            for change in (0..8).map(|bit| 1 << bit).chain([255, rng.within(1, 255) as u8]) {
                let mut bytes = bytes.clone();
                bytes[at] ^= change;
                seal(&mut bytes);
                if check_forged::<G>(&bytes) { n_loaded += 1 } else { n_refused += 1 }
            }
        }
        for _ in 0..2000 {
            let mut bytes = bytes.clone();
            for _ in 0..1 + rng.below(4) {
                let (at, from) = (rng.below(bytes.len() / 4 - 1) * 4, rng.below(bytes.len() / 4 - 1) * 4);
                bytes.copy_within(from..from + 4, at);
            }
            seal(&mut bytes);
            check_forged::<G>(&bytes);
        }
    }
    assert!(n_refused > 1000 && n_loaded > 100, "{n_refused} refused, {n_loaded} loaded");
}

#[test]
fn forged_bytes_are_regular_or_refused_in_the_plane() {
    forged_bytes_are_regular_or_refused::<PowerPlane>();
}

#[test]
fn forged_bytes_are_regular_or_refused_in_space() {
    forged_bytes_are_regular_or_refused::<PowerSpace>();
}

/// All but the corners of one cell are hidden, on its edge.
#[test]
fn many_vertices_above_one_cell_are_loaded() {
    for n in [5, 100] {
        assert!(check_forged::<PowerPlane>(&forged::covered(2, n).bytes()));
        assert!(check_forged::<PowerSpace>(&forged::covered(3, n).bytes()));
    }
}

/// Two vertices with each other's weights: loaded if the cells and who is above which are the same, found otherwise.
fn swapped_weights_are_found<G: Moving>() {
    let rng = &mut Rng::new(10);
    let (mut n_found, mut n_same) = (0, 0);
    for _ in 0..60 {
        let (n, most) = (6 + rng.below(14), *rng.pick(&[1, 9, 30]));
        let points = small::<G>(n, most, rng);
        let t = build::<G>(&points);
        let parts = Parts::read(&t.saved().expect("room"));
        for v in 0..n {
            for w in 0..v {
                let mut parts = parts.clone();
                parts.weighted.as_mut().expect("weights").weights.swap(v, w);
                let mut swapped = points.clone();
                (swapped[v][G::D], swapped[w][G::D]) = (points[w][G::D], points[v][G::D]);
                let swapped: Vec<_> = swapped.into_iter().map(Some).collect();
                let is_same = fresh::<G>(&swapped) == shown(&t);
                assert_eq!(check_forged::<G>(&parts.bytes()), is_same);
                if is_same { n_same += 1 } else { n_found += 1 }
            }
        }
    }
    assert!(n_found > 500 && n_same > 500, "{n_found} found, {n_same} the same");
}

#[test]
fn swapped_weights_are_found_in_both_dimensions() {
    swapped_weights_are_found::<PowerPlane>();
    swapped_weights_are_found::<PowerSpace>();
}

#[test]
fn every_kind_of_damage_to_weights_is_told() {
    let mut points: Vec<_> = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [5.0, 5.0], [1.0, 1.0], [3.0, 4.0]]
        .map(|[x, y]| point::<PowerPlane>(|k| [x, y, 0.0][k]))
        .to_vec();
    (points[4].weight, points[5].weight) = (-9.0, -9.0);
    let mut t = build::<PowerPlane>(&points);
    t.insert_vertex(&points[0]).expect("room");
    t.remove_vertex(vertex(6)).expect("a removal");
    t.move_vertices(&[vertex(1)], &[point::<PowerPlane>(|_| 2.0)]).expect("present");
    let whole = Parts::read(&t.saved().expect("room"));
    let told = |change: &dyn Fn(&mut Parts, &mut Weighted)| {
        let mut parts = whole.clone();
        let mut weighted = parts.weighted.take().expect("weights");
        change(&mut parts, &mut weighted);
        parts.weighted = Some(weighted);
        damage_of::<PowerPlane>(&parts)
    };
    let cell = deldrift::CellId::new;
    let below = whole.weighted.as_ref().expect("weights").below.clone();
    assert_eq!(t.vertices_hidden_by_weight(), Ok(vec![vertex(4), vertex(5)]));
    assert_ne!(below[4], below[5]);

    // The edge between the cells ends at vertex 1, which is lowered by a great weight, and raised by its opposite.
    let far = told(&|_, w| w.weights[1] = 1.001e114);
    assert_eq!(far, Damage::Weight { vertex: vertex(1), value: 1.001e114 });
    assert!(matches!(told(&|_, w| w.weights[1] = -1e114), Damage::NotDelaunay { .. }));
    assert!(
        matches!(told(&|_, w| w.weights[1] = f64::NAN), Damage::Weight { vertex: v, .. } if v == vertex(1))
    );
    let infinite = Damage::Weight { vertex: vertex(1), value: f64::NEG_INFINITY };
    assert_eq!(told(&|_, w| w.moved[0] = f64::NEG_INFINITY), infinite);
    assert_eq!(told(&|_, w| w.weights[6] = 0.5), Damage::Weight { vertex: vertex(6), value: 0.5 });
    let above = |v: u32, c: u32| Damage::Above { vertex: vertex(v), cell: cell(c) };
    assert_eq!(told(&|_, w| w.weights[4] = 20.0), above(4, below[4]));
    let swapped = told(&|_, w| w.below.swap(4, 5));
    assert!(swapped == above(4, below[5]) || swapped == above(5, below[4]), "{swapped:?}");
    assert_eq!(told(&|_, w| w.below[0] = 0), above(0, 0));
    assert_eq!(told(&|_, w| w.below[6] = 0), above(6, 0));
    assert_eq!(told(&|_, w| w.below[5] = 2), above(5, 2));
    assert_eq!(told(&|_, w| w.below[5] = u32::MAX), Damage::InNoCell { vertex: vertex(5) });
    let representative = Damage::Representative { vertex: vertex(5), given: vertex(4) };
    assert_eq!(told(&|p, _| p.representatives[5] = 4), representative);
    let greatest = (1 << 62) - 1;
    for k in 0..3 {
        let offset = whole.bytes().len() - 4 - 24 + 8 * k;
        assert_eq!(told(&|_, w| w.sums[k] = greatest + 1), Damage::Sum { offset, value: greatest + 1 });
    }
    assert_eq!(told(&|_, w| w.history[1] = 2), Damage::Counts);
    assert_eq!(told(&|_, w| w.history[0] = 9), Damage::Counts);

    // Those with weights are not loaded as those without, nor the other way round.
    let bytes = whole.bytes();
    let weighted = LoadError::Data(Damage::Weighted { is_weighted: true });
    assert_eq!(load::<Plane>(&bytes).err(), Some(weighted.clone()));
    let saved = Saved::of(&bytes).expect("whole");
    assert!(saved.is_weighted());
    assert_eq!(AnyTriangulation::load(&saved, Options::default()).err(), Some(weighted));
    assert_eq!(load::<PowerSpace>(&bytes).err(), Some(LoadError::Data(Damage::Dimension { given: 2 })));
    let plain = MovingTriangulation::<Space>::new(&[[0.0; 3]], Options::default()).expect("a build");
    let plain = plain.saved().expect("room");
    assert!(!Saved::of(&plain).expect("whole").is_weighted());
    let other = LoadError::Data(Damage::Weighted { is_weighted: false });
    assert_eq!(load::<PowerSpace>(&plain).err(), Some(other));
    // The version alone does not make one the other.
    for (mut bytes, version) in [(bytes, 1), (plain, 9)] {
        bytes[8] = version;
        seal(&mut bytes);
        assert_eq!(Saved::of(&bytes).err(), Some(Damage::Counts));
    }
}
