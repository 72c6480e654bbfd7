//! Triangulations that are saved and loaded, or cloned, are like the first, and go on like it; data that are not those
//! of a triangulation are refused. Oracles: a fresh build, and a reader and writer of the format of the tests' own.

mod segments;

use crate::common::history::{History, Snapshot};
use crate::common::inputs::{KINDS, Kind, draw};
use crate::common::{
    Rng, assert_same_cells, carried, cell_set, fresh_cells, ids, point, seeds, vertex, vertices,
};
use crate::saving_format::{Parts, forged, seal};
use deldrift::motion::{Algorithm, CoincidencePolicy, Level, MovingTriangulation, NO_CELL, Options, Saved};
use deldrift::{CellId, Damage, Dimension, Error, LoadError, Plane, Space, VertexId};

fn load<G: Dimension>(bytes: &[u8]) -> Result<MovingTriangulation<G>, LoadError> {
    MovingTriangulation::load(&Saved::of(bytes)?, Options::default())
}

fn positions_of<G: Dimension>(t: &MovingTriangulation<G>) -> Vec<Option<G::Point>> {
    VertexId::range(0..t.id_count()).map(|v| t.position(v).ok()).collect()
}

/// Everything that is read of one is read of the other.
fn assert_same<G: Dimension>(
    t: &MovingTriangulation<G>,
    other: &MovingTriangulation<G>,
    context: &dyn Fn() -> String,
) {
    assert!(Snapshot::of(t) == Snapshot::of(other), "{}", context());
    let (own, others) = (t.cells().expect("room"), other.cells().expect("room"));
    assert_eq!(own.corners, others.corners, "{}", context());
    assert_eq!(own.neighbours, others.neighbours, "{}", context());
    assert_eq!(t.statistics(), other.statistics(), "{}", context());
    assert_eq!(t.staged_edits(), other.staged_edits(), "{}", context());
    assert_eq!(t.saved().expect("room"), other.saved().expect("room"), "{}", context());
}

/// The bytes are those that the format says, and hold what is read.
fn check_bytes<G: Dimension>(t: &MovingTriangulation<G>, bytes: &[u8], context: &dyn Fn() -> String) {
    let parts = Parts::read(bytes);
    assert_eq!(parts.bytes(), bytes, "{}", context());
    let cells = t.cells().expect("room");
    let numbers =
        |rows: &[G::Vertices]| rows.iter().flat_map(|row| row.as_ref().to_vec()).collect::<Vec<_>>();
    assert_eq!(VertexId::of_numbers(&parts.cells), numbers(cells.corners), "{}", context());
    let across = cells.neighbours.iter().flat_map(|row| row.as_ref().to_vec()).collect::<Vec<_>>();
    assert_eq!(CellId::of_numbers(&parts.neighbours), across, "{}", context());
    for (v, (p, r)) in vertices().zip(parts.positions.chunks(G::D).zip(&parts.representatives)) {
        assert_eq!(t.coincident_representative(v).map_or(u32::MAX, VertexId::get), *r, "{}", context());
        match t.position(v) {
            Ok(position) => assert_eq!(p, position.as_ref(), "{}", context()),
            Err(_) => assert!(p.iter().all(|x| x.is_nan()), "{}", context()),
        }
    }
    assert_eq!(parts.representatives.len(), t.id_count(), "{}", context());
    assert_eq!((parts.dimension, parts.sums[0]), (G::D, t.timestamp()), "{}", context());
    assert_eq!(parts.sums[1], t.statistics().moved, "{}", context());
}

/// Histories that go on with what has been loaded.
fn loaded_go_on<G: Dimension>(n_seeds: u64, n: impl Fn(&mut Rng) -> usize, steps: usize) {
    for kind in KINDS {
        for seed in seeds(n_seeds) {
            let n = n(&mut Rng::new(seed ^ 0x7171));
            let mut history = History::<G>::new(kind, n, seed + 1000);
            for step in 0..steps {
                if step % 2 == 0 {
                    let bytes = history.t.saved().expect("room");
                    assert_eq!(bytes.len(), history.t.saved_size());
                    let loaded =
                        load::<G>(&bytes).unwrap_or_else(|error| panic!("{}: {error}", history.context()));
                    check_bytes(&history.t, &bytes, &|| history.context());
                    assert_same(&history.t, &loaded, &|| history.context());
                    history.replace(loaded, false);
                    history.check();
                }
                history.step();
            }
        }
    }
}

#[test]
fn loaded_triangulations_go_on_in_the_plane() {
    loaded_go_on::<Plane>(12, |rng| rng.below(61), 12);
    loaded_go_on::<Plane>(1, |rng| 400 + rng.below(100), 8);
}

#[test]
fn loaded_triangulations_go_on_in_space() {
    loaded_go_on::<Space>(12, |rng| rng.below(61), 12);
    loaded_go_on::<Space>(1, |rng| 400 + rng.below(100), 8);
}

/// Histories that go on with a clone, while the first one stays as it is.
fn clones_go_on<G: Dimension>(n_seeds: u64, steps: usize) {
    for kind in KINDS {
        for seed in seeds(n_seeds) {
            let n = Rng::new(seed ^ 0x7272).below(61);
            let mut history = History::<G>::new(kind, n, seed + 2000);
            for _ in 0..steps {
                let clone = history.t.try_clone(None).expect("room");
                assert_same(&history.t, &clone, &|| history.context());
                let bytes = history.t.saved().expect("room");
                let first = history.replace(clone, true);
                history.step();
                assert_eq!(first.saved().expect("room"), bytes, "{}", history.context());
            }
        }
    }
}

#[test]
fn clones_go_on_in_the_plane() {
    clones_go_on::<Plane>(8, 10);
}

#[test]
fn clones_go_on_in_space() {
    clones_go_on::<Space>(8, 10);
}

fn shaken<G: Dimension>(positions: &[G::Point], size: f64, rng: &mut Rng) -> Vec<G::Point> {
    positions.iter().map(|p| point::<G>(|k| p[k] + size * (rng.unit() - 0.5))).collect()
}

/// By every algorithm, with what it keeps between commits: a clone, after the same calls, has the same rows and lists
/// the same changes; a loaded triangulation has the same cells.
fn the_same_calls_give_the_same<G: Dimension>(n: usize) {
    for algorithm in Algorithm::ALL {
        let context = || format!("{}D, {algorithm:?}", G::D);
        let rng = &mut Rng::new(31);
        let mut positions = draw::<G>(Kind::Random, n, rng);
        let options = Options { algorithm, threads: 1, ..Options::default() };
        let mut t = MovingTriangulation::<G>::new(&positions, options).expect("a build");
        for warm in 0..6 {
            positions = shaken::<G>(&positions, 0.3, rng);
            t.commit_positions(&positions).expect("a commit");
            if warm == 2 {
                carried::take(&mut t).expect("room");
            }
        }
        positions = shaken::<G>(&positions, 0.3, rng);
        t.move_all(&positions).expect("moves");
        let mut clone = t.try_clone(None).expect("room");
        let mut loaded = load::<G>(&t.saved().expect("room")).expect("saved");
        loaded.set_algorithm(algorithm);
        assert_same(&t, &clone, &context);
        assert_same(&t, &loaded, &context);
        for step in 0..5 {
            if step > 0 {
                positions = shaken::<G>(&positions, [0.01, 0.3, 3.0][step % 3], rng);
                for t in [&mut t, &mut clone, &mut loaded] {
                    t.move_all(&positions).expect("moves");
                }
            }
            let [report, other, _] =
                [&mut t, &mut clone, &mut loaded].map(|t| t.commit_timestamp().expect("a commit"));
            // Walks may take other ways.
            assert_eq!(report.moved, other.moved, "{}", context());
            assert_eq!(report.within_tolerance, other.within_tolerance, "{}", context());
            assert_eq!((report.flips, report.rebuilds), (other.flips, other.rebuilds), "{}", context());
            let (rows, others) = (t.cells().expect("room"), clone.cells().expect("room"));
            assert_eq!(rows.corners, others.corners, "{}", context());
            assert_eq!(rows.neighbours, others.neighbours, "{}", context());
            if step != 1 {
                assert_eq!(carried::take(&mut t), carried::take(&mut clone), "{}", context());
            }
            let some = positions.iter().copied().map(Some).collect::<Vec<_>>();
            let fresh = fresh_cells::<G>(&some);
            assert_same_cells(&cell_set(&t), &fresh, context);
            assert_same_cells(&cell_set(&loaded), &fresh, context);
        }
    }
}

#[test]
fn the_same_calls_give_the_same_in_the_plane() {
    the_same_calls_give_the_same::<Plane>(300);
}

#[test]
fn the_same_calls_give_the_same_in_space() {
    the_same_calls_give_the_same::<Space>(200);
}

/// A triangulation with removed and hidden vertices, and moves, insertions and removals staged.
fn with_everything<G: Dimension>(n: usize) -> MovingTriangulation<G> {
    let rng = &mut Rng::new(5);
    let mut positions = draw::<G>(Kind::Lattice, n, rng);
    positions[n / 2] = positions[1];
    positions[n / 2 + 1] = positions[1];
    let mut t = MovingTriangulation::<G>::new(&positions, Options::default()).expect("a build");
    t.remove_vertex(vertex(2)).expect("a removal");
    t.stage_insertions(&[point::<G>(|k| 0.5 + k as f64), positions[3]]).expect("room");
    t.insert_vertex(&point::<G>(|k| 0.25 * k as f64)).expect("an insertion");
    t.stage_removals(&ids([4])).expect("removals");
    t.move_vertices(&ids([6, 5]), &[positions[1], point::<G>(|_| 1.5)]).expect("moves");
    t
}

fn what_is_staged_is_saved<G: Dimension>() {
    let context = || format!("{}D", G::D);
    let mut t = with_everything::<G>(20);
    let mut loaded = load::<G>(&t.saved().expect("room")).expect("saved");
    let mut clone = t.try_clone(None).expect("room");
    assert_same(&t, &loaded, &context);
    assert_eq!((t.staged_count(), t.staged_edits()), (2, (2, 1)));
    assert_eq!(loaded.move_vertices(&ids([4]), &[point::<G>(|_| 0.0)]).map_err(|e| e.to_string()), {
        Err(t.move_vertices(&ids([4]), &[point::<G>(|_| 0.0)]).expect_err("it is leaving").to_string())
    });
    let mut discarded = load::<G>(&t.saved().expect("room")).expect("saved");
    let mut expected = t.try_clone(None).expect("room");
    expected.discard_moves();
    discarded.discard_moves();
    assert_same(&expected, &discarded, &context);
    for t in [&mut t, &mut loaded, &mut clone] {
        t.commit_timestamp().expect("a commit");
        t.validate(Level::Delaunay).expect("a triangulation");
    }
    assert!(Snapshot::of(&t) == Snapshot::of(&loaded) && Snapshot::of(&t) == Snapshot::of(&clone));
    assert_same_cells(&cell_set(&loaded), &fresh_cells::<G>(&positions_of(&t)), context);
    assert_same(&t, &load(&t.saved().expect("room")).expect("saved"), &context);
}

#[test]
fn what_is_staged_is_saved_in_the_plane() {
    what_is_staged_is_saved::<Plane>();
}

#[test]
fn what_is_staged_is_saved_in_space() {
    what_is_staged_is_saved::<Space>();
}

/// What may be damaged: everything at once, no cells, nothing.
fn samples<G: Dimension>() -> [MovingTriangulation<G>; 3] {
    let line: Vec<G::Point> = (0..4).map(|i| point::<G>(|k| f64::from(i % 3) * (k + 1) as f64)).collect();
    let of =
        |positions: &[G::Point]| MovingTriangulation::new(positions, Options::default()).expect("a build");
    [with_everything::<G>(9 + 2 * G::D), of(&line), of(&[])]
}

fn every_byte_is_protected<G: Dimension>() {
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
        damaged(&[&bytes[..], &[0]].concat());
    }
}

#[test]
fn every_byte_is_protected_in_the_plane() {
    every_byte_is_protected::<Plane>();
}

#[test]
fn every_byte_is_protected_in_space() {
    every_byte_is_protected::<Space>();
}

/// Data whose checksum is right are refused, or those of a triangulation. Returns which.
fn check_forged<G: Dimension>(bytes: &[u8]) -> bool {
    match load::<G>(bytes) {
        Err(LoadError::Data(damage)) => {
            assert!(!damage.to_string().is_empty());
            false
        }
        Err(error) => panic!("{error}"),
        Ok(t) => {
            t.validate(Level::Delaunay).unwrap_or_else(|violation| panic!("{violation}"));
            assert_same_cells(&cell_set(&t), &fresh_cells::<G>(&positions_of(&t)), || "forged".to_string());
            crate::common::check_adjacency(&t, &|| "forged".to_string());
            true
        }
    }
}

fn forged_bytes_give_triangulations_or_nothing<G: Dimension>() {
    let rng = &mut Rng::new(9);
    let (mut n_refused, mut n_loaded) = (0, 0);
    for t in samples::<G>() {
        let bytes = t.saved().expect("room");
        for at in 0..bytes.len() - 4 {
            let changes = (0..8).map(|bit| 1 << bit).chain([255, rng.within(1, 255) as u8]);
            for change in changes {
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
fn forged_bytes_give_triangulations_or_nothing_in_the_plane() {
    forged_bytes_give_triangulations_or_nothing::<Plane>();
}

#[test]
fn forged_bytes_give_triangulations_or_nothing_in_space() {
    forged_bytes_give_triangulations_or_nothing::<Space>();
}

/// The parts of a triangulation of these points.
fn parts_of<G: Dimension>(points: &[G::Point]) -> Parts {
    let t = MovingTriangulation::<G>::new(points, Options::default()).expect("a build");
    Parts::read(&t.saved().expect("room"))
}

fn damage_of<G: Dimension>(parts: &Parts) -> Damage {
    match load::<G>(&parts.bytes()) {
        Err(LoadError::Data(damage)) => damage,
        other => panic!("{:?}", other.map(|t| t.cell_count())),
    }
}

/// Cells that fit together and are positive, but are no Delaunay triangulation.
#[test]
fn cells_that_are_not_the_triangulation_are_refused() {
    // The other diagonal, of four points not on a circle, and of four on one.
    for last in [[3.0, 3.0], [2.0, 2.0]] {
        let mut parts = parts_of::<Plane>(&[[0.0, 0.0], [2.0, 0.0], [0.0, 2.0], last]);
        let other = if parts.cells.windows(2).any(|pair| pair == [0, 3] || pair == [3, 0]) {
            [0, 1, 2, 1, 3, 2]
        } else {
            [0, 1, 3, 0, 3, 2]
        };
        parts.cells = other.to_vec();
        parts.glue();
        assert!(matches!(damage_of::<Plane>(&parts), Damage::NotDelaunay { .. }), "{last:?}");
    }
    let points = draw::<Plane>(Kind::Random, 30, &mut Rng::new(3));
    let whole = parts_of::<Plane>(&points);
    // A cell at the hull is missing.
    let mut parts = whole.clone();
    let at = parts.neighbours.iter().position(|&across| across == u32::MAX).expect("a hull") / 3;
    parts.cells.drain(3 * at..3 * at + 3);
    parts.glue();
    assert!(matches!(damage_of::<Plane>(&parts), Damage::NotConvex { .. } | Damage::InNoCell { .. }));
    // All are turned over.
    let mut parts = whole.clone();
    parts.cells.chunks_mut(3).chain(parts.neighbours.chunks_mut(3)).for_each(|row| row.swap(0, 1));
    assert_eq!(damage_of::<Plane>(&parts), Damage::NotPositive { cell: CellId::new(0) });
    // All are there twice.
    let mut parts = whole.clone();
    let n = whole.cells.len() as u32 / 3;
    parts.cells.extend(&whole.cells);
    let again = |&across: &u32| if across == u32::MAX { across } else { across + n };
    parts.neighbours.extend(whole.neighbours.iter().map(again));
    assert_eq!(damage_of::<Plane>(&parts), Damage::NotATriangulation);
    // One is turned over, and its neighbours too, so that it lies on their side.
    let mut parts = whole;
    parts.cells.swap(0, 1);
    parts.neighbours.swap(0, 1);
    assert!(matches!(damage_of::<Plane>(&parts), Damage::Neighbour { .. }));
}

/// Five triangles around a point that go around it twice: all are positive, every facet is locally Delaunay, and the
/// hull is convex at every vertex. Two neighbours are saved as if both were on the hull: whatever else agrees, that is
/// not the triangulation.
fn cells_cut_apart_are_refused<G: Dimension>() {
    let mut n_cut = 0;
    for seed in 0..20 {
        let rng = &mut Rng::new(seed);
        let points: Vec<G::Point> =
            (0..5 + G::D).map(|_| point::<G>(|_| rng.within(-60, 60) as f64)).collect();
        let parts = parts_of::<G>(&points);
        let n = G::D + 1;
        for k in (0..parts.neighbours.len()).filter(|&k| parts.neighbours[k] != u32::MAX) {
            let (cell, across) = (k / n, parts.neighbours[k] as usize);
            let back = (across * n..(across + 1) * n).find(|&l| parts.neighbours[l] as usize == cell);
            let mut parts = parts.clone();
            parts.neighbours[k] = u32::MAX;
            parts.neighbours[back.expect("a neighbour")] = u32::MAX;
            damage_of::<G>(&parts);
            n_cut += 1;
        }
    }
    assert!(n_cut > 200, "{n_cut}");
}

#[test]
fn cells_cut_apart_are_refused_in_the_plane_and_in_space() {
    cells_cut_apart_are_refused::<Plane>();
    cells_cut_apart_are_refused::<Space>();
}

#[test]
fn a_hull_that_winds_twice_is_refused() {
    let mut points = vec![[0.0, 0.0]];
    points.extend((0..5).map(|k| [(f64::from(k) * 1.2566).cos(), (f64::from(k) * 1.2566).sin()]));
    let mut parts = parts_of::<Plane>(&points);
    assert_eq!(parts.cells.len(), 15);
    parts.cells = (0..5).flat_map(|k| [0, 1 + 2 * k % 5, 1 + (2 * k + 2) % 5]).collect();
    parts.glue();
    assert_eq!(damage_of::<Plane>(&parts), Damage::NotATriangulation);
}

/// Points so close to zero that no double lies inside a cell.
#[test]
fn cells_without_a_place_inside_are_loaded() {
    let unit = f64::from_bits(1);
    for n in [3, 4, 9] {
        let points: Vec<[f64; 2]> =
            (0..n).map(|k| [f64::from(k % 3) * unit, f64::from(k / 3) * unit]).collect();
        let t = MovingTriangulation::<Plane>::new(&points, Options::default()).expect("a build");
        let loaded = load::<Plane>(&t.saved().expect("room")).expect("saved");
        assert_same(&t, &loaded, &|| format!("{n} points"));
        if n == 4 {
            let mut parts = Parts::read(&t.saved().expect("room"));
            parts.cells = parts.cells.repeat(2);
            let n = parts.neighbours.len() as u32 / 3;
            let again = parts.neighbours.iter().map(|&c| if c == u32::MAX { c } else { c + n });
            let again: Vec<u32> = again.collect();
            parts.neighbours.extend(again);
            assert_eq!(damage_of::<Plane>(&parts), Damage::NotATriangulation);
        }
    }
}

#[test]
fn every_kind_of_damage_is_told() {
    let mut square = vec![[0.0, 0.0], [4.0, 0.0], [5.0, 5.0], [0.0, 4.0], [1.0, 2.0]];
    square.push(square[4]);
    let whole = parts_of::<Plane>(&square);
    let bytes = whole.bytes();
    let told = |change: &dyn Fn(&mut Parts)| {
        let mut parts = whole.clone();
        change(&mut parts);
        damage_of::<Plane>(&parts)
    };
    let vertex = VertexId::new;
    assert_eq!(Saved::of(b"").err(), Some(Damage::NoHeader { given: 0, wanted: 168 }));
    assert_eq!(Saved::of(&bytes[..100]).err(), Some(Damage::NoHeader { given: 100, wanted: 168 }));
    assert_eq!(Saved::of(b"solid cube").err(), Some(Damage::Foreign));
    let size = Damage::Size { given: bytes.len() - 1, wanted: bytes.len() as u64 };
    assert_eq!(Saved::of(&bytes[..bytes.len() - 1]).err(), Some(size));
    let mut later = bytes.clone();
    later[8] = 12;
    assert_eq!(Saved::of(&later).err(), Some(Damage::Version { given: 12, latest: 11 }));
    let mut flipped = bytes.clone();
    flipped[200] ^= 1;
    assert!(matches!(Saved::of(&flipped).err(), Some(Damage::Checksum { .. })));
    let mut flat = bytes.clone();
    flat[12] = 4;
    seal(&mut flat);
    assert_eq!(Saved::of(&flat).err(), Some(Damage::Dimension { given: 4 }));
    let mut many = bytes.clone();
    many[31] = 0x80;
    seal(&mut many);
    assert_eq!(Saved::of(&many).err(), Some(Damage::Counts));
    let wrong = MovingTriangulation::<Space>::load(&Saved::of(&bytes).expect("saved"), Options::default());
    assert_eq!(wrong.err(), Some(LoadError::Data(Damage::Dimension { given: 2 })));

    assert_eq!(told(&|p| p.sums[3] = 1 << 62), Damage::Sum { offset: 88, value: 1 << 62 });
    let far = told(&|p| p.positions[3] = 1e58);
    assert_eq!(far, Damage::Position { vertex: vertex(1), axis: 1, value: 1e58 });
    assert_eq!(
        told(&|p| p.representatives[5] = 6),
        Damage::Representative { vertex: vertex(5), given: vertex(6) }
    );
    assert_eq!(
        told(&|p| p.representatives[4] = 5),
        Damage::Representative { vertex: vertex(4), given: vertex(5) }
    );
    assert_eq!(
        told(&|p| p.representatives[5] = 3),
        Damage::Apart { vertex: vertex(5), representative: vertex(3) }
    );
    assert_eq!(told(&|p| p.representatives[5] = 5), Damage::InNoCell { vertex: vertex(5) });
    let gone = |p: &mut Parts| {
        p.representatives[3] = u32::MAX;
        p.positions[6..8].fill(f64::NAN);
    };
    assert!(matches!(told(&gone), Damage::Corner { given, .. } if given == vertex(3)));
    assert_eq!(
        told(&|p| p.cells[4] = 9),
        Damage::Corner { cell: CellId::new(1), corner: 1, given: vertex(9) }
    );
    assert!(
        matches!(told(&|p| p.cells[1] = p.cells[0]), Damage::CornerTwice { cell, .. } if cell == CellId::new(0))
    );
    for wrong in [0, 17, NO_CELL.get() - 1] {
        let damage = told(&|p| p.neighbours[0] = wrong);
        assert!(matches!(damage, Damage::Neighbour { given, .. } if given == CellId::new(wrong)), "{damage}");
    }
    let none = |p: &mut Parts| {
        p.cells.clear();
        p.neighbours.clear();
    };
    assert!(matches!(told(&none), Damage::NoCells { .. }));
    let same = |p: &mut Parts| {
        none(p);
        p.positions = vec![1.0; 12];
        p.representatives = (0..6).collect();
    };
    assert_eq!(told(&same), Damage::SamePlace { vertex: vertex(0), other: vertex(1) });
    let coming = |p: &mut Parts, ids: &[u32]| {
        p.insertions = ids.to_vec();
        p.coming = vec![1.5; 2 * ids.len()];
        p.representatives.extend([u32::MAX; 2]);
        p.positions.extend([f64::NAN; 4]);
    };
    assert!(
        load::<Plane>(&{
            let mut p = whole.clone();
            coming(&mut p, &[6, 7]);
            p.bytes()
        })
        .is_ok()
    );
    assert_eq!(told(&|p| coming(p, &[7, 6])), Damage::Insertion { vertex: vertex(6) });
    assert_eq!(told(&|p| coming(p, &[5])), Damage::Insertion { vertex: vertex(5) });
    assert_eq!(told(&|p| coming(p, &[8])), Damage::Insertion { vertex: vertex(8) });
    assert_eq!(told(&|p| p.removals = vec![1, 1]), Damage::Staged { vertex: vertex(1) });
    let moves = |p: &mut Parts, ids: &[u32], x: f64| {
        p.moves = ids.to_vec();
        p.moved = vec![x; 2 * ids.len()];
    };
    assert_eq!(told(&|p| moves(p, &[3, 3], 1.0)), Damage::Staged { vertex: vertex(3) });
    assert_eq!(told(&|p| moves(p, &[6], 1.0)), Damage::Staged { vertex: vertex(6) });
    let nan = told(&|p| moves(p, &[3, 2], f64::INFINITY));
    assert_eq!(nan, Damage::Position { vertex: vertex(3), axis: 0, value: f64::INFINITY });
    let leaving = |p: &mut Parts| {
        p.removals = vec![3];
        moves(p, &[3], 1.0);
    };
    assert_eq!(told(&leaving), Damage::Staged { vertex: vertex(3) });
}

#[test]
fn hidden_vertices_are_refused_where_the_options_reject_them() {
    let t = MovingTriangulation::<Plane>::new(
        &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 0.0]],
        Options::default(),
    );
    let bytes = t.expect("a build").saved().expect("room");
    let options = Options { coincidence: CoincidencePolicy::Reject, ..Options::default() };
    let loaded = MovingTriangulation::<Plane>::load(&Saved::of(&bytes).expect("saved"), options);
    let coincident = Error::Coincident { vertex: vertex(1), other: vertex(3) };
    assert_eq!(loaded.err(), Some(LoadError::Call(coincident)));
}

/// Hulls in parts, or that wind more than once, of cells that are right one by one.
#[test]
fn wrong_hulls_are_refused() {
    for dimension in [2, 3] {
        for n in [2 * (dimension + 1), 40, 400] {
            for (name, parts) in forged::of_wrong_hulls(dimension, n) {
                let load = |bytes: &[u8]| match dimension {
                    2 => load::<Plane>(bytes).err(),
                    _ => load::<Space>(bytes).err(),
                };
                let wanted = LoadError::Data(Damage::NotATriangulation);
                assert_eq!(load(&parts.bytes()), Some(wanted), "{name}, {dimension}D, {n}");
            }
            for (name, parts) in forged::legal(dimension, n) {
                let bytes = parts.bytes();
                let again = match dimension {
                    2 => load::<Plane>(&bytes).map(|t| t.saved()),
                    _ => load::<Space>(&bytes).map(|t| t.saved()),
                };
                assert!(again.is_ok_and(|again| again.expect("room") == bytes), "{name}, {dimension}D, {n}");
            }
        }
    }
}

/// The monitor is asked all the way, with fractions that do not fall, and ends the call whenever it is.
fn loading_is_monitored<G: Dimension>(n: usize) {
    use std::sync::{Arc, Mutex};
    let rng = &mut Rng::new(8);
    let spread = draw::<G>(Kind::Random, n, rng);
    let line: Vec<G::Point> = (0..2 * n).map(|i| point::<G>(|_| i as f64)).collect();
    for points in [spread, line] {
        let t = MovingTriangulation::<G>::new(&points, Options::default()).expect("a build");
        let bytes = t.saved().expect("room");
        let load = |stops_at: usize| {
            let asked = Arc::new(Mutex::new(Vec::new()));
            let own = asked.clone();
            let monitor = move |fraction: f64| {
                let mut asked = own.lock().expect("one at a time");
                asked.push(fraction);
                asked.len() != stops_at
            };
            let options = Options { monitor: Some(Box::new(monitor)), ..Options::default() };
            let loaded = MovingTriangulation::<G>::load(&Saved::of(&bytes).expect("saved"), options);
            let asked = asked.lock().expect("it is over").clone();
            (loaded, asked)
        };
        let (loaded, asked) = load(0);
        assert_eq!(loaded.expect("saved").saved().expect("room"), bytes);
        assert!(
            asked.len() > 1 && asked.is_sorted() && asked.iter().all(|f| (0.0..=1.0).contains(f)),
            "{asked:?}"
        );
        for k in 1..=asked.len() {
            let (loaded, asked) = load(k);
            assert_eq!(loaded.err(), Some(LoadError::Call(Error::Cancelled)), "{k}");
            assert_eq!(asked.len(), k);
        }
    }
}

#[test]
fn loading_is_monitored_in_the_plane() {
    loading_is_monitored::<Plane>(60_000);
}

#[test]
fn loading_is_monitored_in_space() {
    loading_is_monitored::<Space>(20_000);
}

/// As great sums as are loaded: what is saved after commits is loaded as well.
#[test]
fn the_greatest_sums_are_saved_and_loaded() {
    let greatest = (1 << 62) - 1;
    let mut parts = parts_of::<Plane>(&[[0.0, 0.0], [4.0, 0.0], [5.0, 5.0], [0.0, 4.0]]);
    parts.sums = [greatest; 13];
    let mut bytes = parts.bytes();
    for step in 0..5 {
        let mut t = load::<Plane>(&bytes).unwrap_or_else(|error| panic!("{step}: {error}"));
        assert_eq!((t.timestamp(), t.statistics().moved), (greatest, greatest));
        for k in 0..3 {
            t.move_vertices(&ids([k]), &[[f64::from(k), 0.25 + f64::from(step)]]).expect("a move");
            t.commit_timestamp().expect("a commit");
        }
        t.insert_vertex(&[2.0, 2.0 + f64::from(step)]).expect("an insertion");
        t.remove_vertex(vertex(4 + step)).expect("a removal");
        assert_eq!((t.timestamp(), t.statistics().moved), (greatest + 3, greatest + 3));
        bytes = t.saved().expect("room");
        assert_eq!(Parts::read(&bytes).sums, [greatest; 13]);
    }
    for k in 0..13 {
        let mut parts = parts.clone();
        parts.sums[k] += 1;
        assert_eq!(damage_of::<Plane>(&parts), Damage::Sum { offset: 64 + 8 * k, value: greatest + 1 });
    }
}

/// Ids that are not present are nowhere.
#[test]
fn absent_ids_have_no_position() {
    let mut t = MovingTriangulation::<Space>::new(
        &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.2; 3]],
        Options::default(),
    )
    .expect("a build");
    t.remove_vertex(vertex(4)).expect("a removal");
    t.stage_insertions(&[[0.5; 3]]).expect("room");
    let parts = Parts::read(&t.saved().expect("room"));
    for (absent, axis) in [(4, 0), (4, 1), (4, 2), (5, 0), (5, 1), (5, 2)] {
        for value in [0.0, 0.2, f64::INFINITY, -1e300] {
            let mut parts = parts.clone();
            parts.positions[3 * absent + axis] = value;
            let wanted = Damage::Absent { vertex: vertex(absent as u32), axis, value };
            assert_eq!(damage_of::<Space>(&parts), wanted);
        }
        let mut parts = parts.clone();
        parts.positions[3 * absent + axis] = -f64::NAN;
        assert!(load::<Space>(&parts.bytes()).is_ok());
    }
}
