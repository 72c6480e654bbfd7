//! Keys: what breaks ties and chooses the representative of a place is the order of keys and positions, whatever ids are.
//!
//! The oracle is a build without keys, of the vertices in the order of key, position and id: there the order of ids, by
//! which ties are broken without keys, is that by which they have to be broken here.

use crate::common::history::nudged;
use crate::common::inputs::{KINDS, Kind, draw, draw_one};
use crate::common::{CellSet, Rng, assert_same_cells, cell_set, seeds, sorted};
use crate::saving_format::seal;
use deldrift::motion::{Algorithm, CoincidencePolicy, Level, MovingTriangulation, Options, Saved, Segment};
use deldrift::{Damage, Dimension, Error, LoadError, Plane, Space, VertexId};
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// What keys are like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Keys {
    Random,
    Few,
    Equal,
    Greatest,
    /// Of some vertices, the others have their ids.
    Some,
}

const ALL_KEYS: [Keys; 5] = [Keys::Random, Keys::Few, Keys::Equal, Keys::Greatest, Keys::Some];

impl Keys {
    fn draw(self, id: usize, rng: &mut Rng) -> Option<u64> {
        match self {
            Keys::Random => Some(rng.next()),
            Keys::Few => Some(rng.below(3) as u64),
            Keys::Equal => Some(7),
            Keys::Greatest => Some(u64::MAX - rng.below(2) as u64),
            Keys::Some => rng.one_in(2).then(|| rng.below(2 * id + 1) as u64),
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct Vertex<P> {
    key: u64,
    place: P,
}

/// The order of places, one coordinate after the other.
fn compare_places<G: Dimension>(p: &G::Point, q: &G::Point) -> Ordering {
    (0..G::D)
        .map(|k| p[k].partial_cmp(&q[k]).expect("numbers"))
        .find(|o| o.is_ne())
        .unwrap_or(Ordering::Equal)
}

/// The vertices in the order that counts.
fn ranked<G: Dimension>(vertices: &[Option<Vertex<G::Point>>]) -> Vec<VertexId> {
    let mut order: Vec<VertexId> =
        VertexId::range(0..vertices.len()).filter(|&v| vertices[v].is_some()).collect();
    order.sort_by(|&v, &w| {
        let [a, b] = [v, w].map(|v| vertices[v].expect("present"));
        a.key.cmp(&b.key).then(compare_places::<G>(&a.place, &b.place)).then(v.cmp(&w))
    });
    order
}

struct History<G: Dimension> {
    t: MovingTriangulation<G>,
    now: Vec<Option<Vertex<G::Point>>>,
    staged: BTreeMap<VertexId, G::Point>,
    coming: BTreeMap<VertexId, Vertex<G::Point>>,
    leaving: Vec<VertexId>,
    kind: Kind,
    keys: Keys,
    n: usize,
    rng: Rng,
    log: Vec<String>,
}

impl<G: Dimension> History<G> {
    fn new(kind: Kind, keys: Keys, n: usize, seed: u64) -> Self {
        let mut rng = Rng::new(seed);
        let places = draw::<G>(kind, n, &mut rng);
        let given: Vec<Option<u64>> = (0..n).map(|v| keys.draw(v, &mut rng)).collect();
        let all: Vec<u64> = given.iter().enumerate().map(|(v, key)| key.unwrap_or(v as u64)).collect();
        let options = Options { threads: 1 + rng.below(2) as u32, ..Options::default() };
        let t = MovingTriangulation::with_keys(&places, &all, options).expect("a build");
        let vertices = all.iter().zip(&places).map(|(&key, &place)| Some(Vertex { key, place }));
        let log = vec![format!("{}D, {kind:?}, {keys:?}, {n} points, seed {seed}", G::D)];
        History {
            t,
            now: vertices.collect(),
            staged: BTreeMap::new(),
            coming: BTreeMap::new(),
            leaving: Vec::new(),
            kind,
            keys,
            n,
            rng,
            log,
        }
    }

    fn context(&self) -> String {
        format!("{}: ... {}", self.log[0], self.log[self.log.len().saturating_sub(8)..].join("; "))
    }

    fn present(&self) -> Vec<VertexId> {
        VertexId::range(0..self.now.len()).filter(|&v| self.now[v].is_some()).collect()
    }

    /// A place: another one of the kind, that of a vertex, or near the one before.
    fn place_near(&mut self, place: &G::Point) -> G::Point {
        match self.rng.below(4) {
            0 => draw_one::<G>(self.kind, self.n, &mut self.rng),
            1 => {
                let present = self.present();
                let v = *self.rng.pick(&present);
                self.now[v].expect("present").place
            }
            2 => nudged::<G>(place, 1 << 20, &mut self.rng),
            _ => nudged::<G>(place, 1 << self.rng.below(18), &mut self.rng),
        }
    }

    fn step(&mut self) {
        let present = self.present();
        let v = *self.rng.pick(&present);
        let place = self.now[v].expect("present").place;
        match self.rng.below(12) {
            0..=4 => {
                let share = [1, 3, 20][self.rng.below(3)];
                for v in present {
                    let is_free = !self.leaving.contains(&v) && !self.staged.contains_key(&v);
                    if is_free && self.rng.one_in(share) {
                        let q = self.place_near(&self.now[v].expect("present").place.clone());
                        self.t.move_vertices(&[v], &[q]).expect("a good place");
                        self.staged.insert(v, q);
                    }
                }
                self.commit();
            }
            5 => self.stage_edits(),
            6 if self.coming.is_empty() => {
                let (id, q) = (self.now.len(), self.place_near(&place));
                let key = self.keys.draw(id, &mut self.rng);
                self.log.push(format!("insert {q:?}, {key:?}"));
                let inserted = match key {
                    Some(key) => self.t.insert_vertex_with_key(&q, key),
                    None => self.t.insert_vertex(&q),
                };
                assert_eq!(inserted, Ok(VertexId::at(id)), "{}", self.context());
                self.now.push(Some(Vertex { key: key.unwrap_or(id as u64), place: q }));
            }
            7 if !self.leaving.contains(&v) && self.present().len() > 4 => {
                self.log.push(format!("remove {v}"));
                self.t.remove_vertex(v).expect("present");
                self.staged.remove(&v);
                self.now[v] = None;
            }
            8 if !self.staged.contains_key(&v) => {
                let q = self.place_near(&place);
                self.log.push(format!("relocate {v} to {q:?}"));
                self.t.relocate_vertex(v, &q).expect("a good place");
                self.now[v].as_mut().expect("present").place = q;
            }
            9 => self.compact(),
            10 => {
                self.log.push("clone".into());
                self.t = self.t.try_clone(None).expect("room");
            }
            _ => self.load(),
        }
        self.check();
    }

    fn stage_edits(&mut self) {
        let n_coming = self.rng.below(6);
        let present = self.present();
        let mut places = Vec::new();
        for _ in 0..n_coming {
            let v = *self.rng.pick(&present);
            let place = self.now[v].expect("present").place;
            places.push(self.place_near(&place));
        }
        let first = self.t.id_count();
        let is_reused = self.rng.one_in(2);
        let keys: Vec<Option<u64>> =
            (first..first + n_coming).map(|id| self.keys.draw(id, &mut self.rng)).collect();
        let all: Option<Vec<u64>> = keys.iter().copied().collect();
        let mut ids = Vec::new();
        if is_reused {
            let free =
                VertexId::range(0..first).filter(|v| self.now.get(v.index()).is_none_or(|v| v.is_none()));
            let free = free.filter(|v| !self.coming.contains_key(v));
            let expected: Vec<VertexId> =
                free.chain(VertexId::range(first..first + n_coming)).take(n_coming).collect();
            self.t.stage_insertions_at_free_ids(&places, all.as_deref(), |v| ids.push(v)).expect("room");
            assert_eq!(ids, expected, "{}", self.context());
        } else {
            let staged = match &all {
                Some(keys) => self.t.stage_insertions_with_keys(&places, keys),
                None => self.t.stage_insertions(&places),
            };
            assert_eq!(staged, Ok(VertexId::at(first)), "{}", self.context());
            ids.extend(VertexId::range(first..first + n_coming));
        }
        self.log.push(format!("stage {ids:?} with {all:?}"));
        for (k, (&v, &place)) in ids.iter().zip(&places).enumerate() {
            let key = all.as_ref().map_or(v.index() as u64, |keys| keys[k]);
            self.coming.insert(v, Vertex { key, place });
        }
        self.now.resize(self.t.id_count(), None);
        let v = *self.rng.pick(&present);
        if self.rng.one_in(2) && !self.leaving.contains(&v) && present.len() > self.leaving.len() + 4 {
            self.log.push(format!("stage removal of {v}"));
            self.t.stage_removals(&[v]).expect("present");
            self.leaving.push(v);
            self.staged.remove(&v);
        }
        if self.rng.one_in(4) {
            self.log.push("discard".into());
            self.t.discard_moves();
            self.now.truncate(self.t.id_count());
            (self.staged, self.coming) = Default::default();
            self.leaving.clear();
        }
    }

    fn commit(&mut self) {
        let algorithm = *self.rng.pick(&Algorithm::ALL);
        self.log.push(format!("commit {} moves by {algorithm:?}", self.staged.len()));
        self.t.set_algorithm(algorithm);
        self.t.commit_timestamp().unwrap_or_else(|error| panic!("{}: {error}", self.context()));
        for (v, place) in std::mem::take(&mut self.staged) {
            self.now[v].as_mut().expect("present").place = place;
        }
        for (v, vertex) in std::mem::take(&mut self.coming) {
            self.now[v] = Some(vertex);
        }
        for v in std::mem::take(&mut self.leaving) {
            self.now[v] = None;
        }
    }

    fn compact(&mut self) {
        self.log.push("compact".into());
        let ids = self.t.compact().expect("room");
        let n = self.t.id_count();
        let renamed = |v: VertexId| ids[v];
        let mut now = vec![None; n];
        for v in self.present() {
            now[renamed(v).index()] = self.now[v];
        }
        self.now = now;
        self.staged = std::mem::take(&mut self.staged).into_iter().map(|(v, q)| (renamed(v), q)).collect();
        self.coming = std::mem::take(&mut self.coming).into_iter().map(|(v, q)| (renamed(v), q)).collect();
        self.leaving.iter_mut().for_each(|v| *v = renamed(*v));
    }

    fn load(&mut self) {
        self.log.push("save and load".into());
        let bytes = self.t.saved().expect("room");
        let saved = Saved::of(&bytes).expect("its own bytes");
        self.t = MovingTriangulation::load(&saved, Options::default())
            .unwrap_or_else(|error| panic!("{}: {error}", self.context()));
        assert!(self.t.saved().expect("room") == bytes, "{}", self.context());
    }

    fn check(&self) {
        check_against_ranks(&self.t, &self.now, &|| self.context());
        for (v, vertex) in self.coming.iter() {
            assert_eq!(self.t.key_of_id(*v), vertex.key, "{}", self.context());
        }
    }
}

/// Compares with a build without keys of the vertices in the order that counts.
fn check_against_ranks<G: Dimension>(
    t: &MovingTriangulation<G>,
    now: &[Option<Vertex<G::Point>>],
    context: &dyn Fn() -> String,
) {
    let order = ranked::<G>(now);
    let places: Vec<G::Point> = order.iter().map(|&v| now[v].expect("present").place).collect();
    let fresh = MovingTriangulation::<G>::new(&places, Options::default()).expect("a build");
    let named = |cells: CellSet| -> CellSet {
        cells.iter().map(|c| sorted(&c.iter().map(|&k| order[k]).collect::<Vec<_>>())).collect()
    };
    let found = cell_set(t);
    assert_same_cells(&found, &named(cell_set(&fresh)), context);
    for (k, &v) in order.iter().enumerate() {
        let expected = order[fresh.coincident_representative(VertexId::at(k)).expect("present")];
        assert_eq!(t.coincident_representative(v), Ok(expected), "{}: at the place of {v}", context());
        assert_eq!(t.key(v), Ok(now[v].expect("present").key), "{}: key of {v}", context());
    }
    let queries: Vec<G::Point> = places.iter().step_by(7).copied().collect();
    let (mut near, mut expected) = (Vec::new(), Vec::new());
    t.nearest_vertices(&queries, 6, |v| near.push(v)).expect("room");
    let named = |k: VertexId| if k == VertexId::NONE { k } else { order[k] };
    fresh.nearest_vertices(&queries, 6, |k| expected.push(named(k))).expect("room");
    assert_eq!(near, expected, "{}: nearest", context());
    for q in &queries {
        let found = t.nearest_vertex(q).expect("room");
        assert_eq!(found, fresh.nearest_vertex(q).expect("room").map(named), "{}: nearest", context());
    }
    assert_eq!(t.vertex_count(), order.len(), "{}", context());
    assert_eq!(t.validate(Level::Delaunay), Ok(()), "{}", context());
}

fn histories_agree<G: Dimension>(n: usize) {
    deldrift::internals::use_all_threads();
    for seed in seeds(3) {
        for kind in KINDS {
            for keys in ALL_KEYS {
                let n = [n, 12, 20][seed as usize % 3];
                let mut history = History::<G>::new(kind, keys, n, seed);
                history.check();
                (0..30).for_each(|_| history.step());
            }
        }
    }
}

#[test]
fn keyed_histories_of_the_plane_end_in_builds_by_rank() {
    histories_agree::<Plane>(60);
}

#[test]
fn keyed_histories_in_space_end_in_builds_by_rank() {
    histories_agree::<Space>(40);
}

/// The cells of a triangulation as sets of keys, which are different here.
fn cells_by_key<G: Dimension>(t: &MovingTriangulation<G>) -> Vec<Vec<u64>> {
    let mut cells: Vec<Vec<u64>> = t
        .cells()
        .expect("room")
        .corners
        .iter()
        .map(|c| {
            let mut keys: Vec<u64> = c.as_ref().iter().map(|&v| t.key(v).expect("present")).collect();
            keys.sort_unstable();
            keys
        })
        .collect();
    cells.sort_unstable();
    cells
}

/// Moves vertices by every algorithm, those of one triangulation under ids of another order: cells are the same by key.
fn permutations_agree<G: Dimension>(kind: Kind, n: usize, seed: u64) {
    let rng = &mut Rng::new(seed);
    let mut places = draw::<G>(kind, n, rng);
    let mut keys: Vec<u64> = (0..n as u64).map(|k| k << 40 | rng.next() >> 24).collect();
    rng.shuffle(&mut keys);
    let mut order: Vec<usize> = (0..n).collect();
    rng.shuffle(&mut order);
    let of = |places: &[G::Point]| -> Vec<G::Point> { order.iter().map(|&k| places[k]).collect() };
    let other_keys: Vec<u64> = order.iter().map(|&k| keys[k]).collect();
    let make = |places: &[G::Point], keys: &[u64]| {
        MovingTriangulation::<G>::with_keys(places, keys, Options::default()).expect("a build")
    };
    let mut t = make(&places, &keys);
    let mut other = make(&of(&places), &other_keys);
    for algorithm in Algorithm::ALL {
        let quanta = 1 << rng.below(22);
        for place in &mut places {
            *place = match rng.below(3) {
                0 => *place,
                1 => draw_one::<G>(kind, n, rng),
                _ => nudged::<G>(place, quanta, rng),
            };
        }
        t.set_algorithm(algorithm);
        other.set_algorithm(*rng.pick(&Algorithm::ALL));
        t.commit_positions(&places).expect("good places");
        other.commit_positions(&of(&places)).expect("good places");
        assert_eq!(cells_by_key(&t), cells_by_key(&other), "{}D, {kind:?}, seed {seed}, {algorithm:?}", G::D);
    }
    let fresh = make(&places, &keys);
    assert_eq!(cells_by_key(&t), cells_by_key(&fresh), "{}D, {kind:?}, seed {seed}", G::D);
}

#[test]
fn permuted_ids_have_the_cells_of_their_keys() {
    for seed in seeds(40) {
        for kind in [Kind::Lattice, Kind::Sphere, Kind::Duplicates] {
            permutations_agree::<Plane>(kind, 80, seed);
            permutations_agree::<Space>(kind, 50, seed);
        }
    }
}

/// Keys that are the ids change nothing, whatever the number of threads, in sets that are built in parts.
#[test]
fn builds_in_parts_know_keys() {
    fn agree<G: Dimension>(side: usize) {
        deldrift::internals::use_all_threads();
        let rng = &mut Rng::new(5);
        let mut places = Vec::new();
        for k in 0..side.pow(G::D as u32) {
            let mut p = G::Point::default();
            (0..G::D).for_each(|axis| p[axis] = (k / side.pow(axis as u32) % side) as f64);
            places.push(p);
        }
        let n = places.len();
        let mut keys: Vec<u64> = (0..n as u64).collect();
        rng.shuffle(&mut keys);
        let mut by_key = places.clone();
        keys.iter().zip(&places).for_each(|(&key, &p)| by_key[key as usize] = p);
        let by_id = MovingTriangulation::<G>::new(&by_key, Options::default()).expect("a build");
        for threads in [1, 2, 4] {
            let options = Options { threads, ..Options::default() };
            let t = MovingTriangulation::<G>::with_keys(&places, &keys, options).expect("a build");
            assert_eq!(cells_by_key(&t), cells_by_key(&by_id), "{}D, {threads} threads", G::D);
        }
    }
    agree::<Plane>(70);
    agree::<Space>(17);
}

/// Adding the same to all positions keeps the order of equal keys, so cells stay; negating them turns it.
#[test]
fn equal_keys_are_ranked_by_position() {
    let square = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    let expected = |order: [usize; 4]| {
        let places = order.map(|k| square[k]);
        let t = MovingTriangulation::<Plane>::new(&places, Options::default()).expect("a build");
        cell_set(&t)
            .iter()
            .map(|c| sorted(&c.iter().map(|v| VertexId::at(order[v.index()])).collect::<Vec<_>>()))
            .collect::<CellSet>()
    };
    let equal = |places: &[[f64; 2]]| {
        cell_set(
            &MovingTriangulation::<Plane>::with_keys(places, &[3; 4], Options::default()).expect("a build"),
        )
    };
    assert_eq!(equal(&square), expected([0, 2, 1, 3]));
    assert_eq!(equal(&square.map(|[x, y]| [x + 5.0, y - 7.0])), expected([0, 2, 1, 3]));
    assert_eq!(equal(&square.map(|[x, y]| [-x, -y])), expected([3, 1, 2, 0]));
}

/// A call that fails changes nothing, and gives no keys.
#[test]
fn refused_calls_leave_no_keys() {
    let places = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    let wrong = MovingTriangulation::<Plane>::with_keys(&places, &[1; 3], Options::default()).err();
    assert_eq!(wrong, Some(Error::WrongCount { argument: "keys", given: 3, wanted: 4, coming: 0 }));
    let options = Options { coincidence: CoincidencePolicy::Reject, ..Options::default() };
    let mut t = MovingTriangulation::<Plane>::new(&places, options).expect("a build");
    let before = t.saved().expect("room");
    let nan = t.stage_insertions_with_keys(&[[0.5, 0.5], [f64::NAN, 0.0]], &[1, 2]);
    assert!(matches!(nan, Err(Error::NotFinite { argument: "positions", index: 1, axis: 0, .. })), "{nan:?}");
    let short = t.stage_insertions_with_keys(&[[0.5, 0.5]], &[]);
    assert_eq!(short, Err(Error::WrongCount { argument: "keys", given: 0, wanted: 1, coming: 0 }));
    let there = t.insert_vertex_with_key(&[1.0, 0.0], 0);
    assert_eq!(there, Err(Error::Coincident { vertex: VertexId::new(1), other: VertexId::new(4) }));
    assert!(!t.has_keys());
    assert!(t.saved().expect("room") == before);
    // A commit that fails leaves what is staged; given up, it has left nothing but that there are keys.
    t.stage_insertions_with_keys(&[[1.0, 0.0]], &[0]).expect("room");
    assert!(t.commit_timestamp().is_err());
    assert_eq!(t.key_of_id(VertexId::new(4)), 0);
    t.discard_moves();
    assert_eq!(t.id_count(), 4);
    assert_eq!(t.insert_vertex(&[0.5, 0.25]), Ok(VertexId::new(4)));
    assert_eq!(t.key(VertexId::new(4)), Ok(4));
}

/// Bytes of keys that are wrong are refused: keys of no vertex, and those by which another vertex represents a place, or other
/// cells are the triangulation.
#[test]
fn wrong_keys_are_not_loaded() {
    let places = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0], [5.0, 5.0]];
    let mut t =
        MovingTriangulation::<Plane>::with_keys(&places, &[40, 20, 30, 10, 20, 6], Options::default())
            .expect("a build");
    t.remove_vertex(VertexId::new(5)).expect("present");
    t.stage_insertions_with_keys(&[[0.5, 0.5]], &[3]).expect("room");
    let bytes = t.saved().expect("room");
    // Behind the header, 7 positions and one that is staged, the representatives, 2 cells, and the staged id.
    let start = 168 + 16 * 8 + 4 * 7 + 2 * 2 * 3 * 4 + 4;
    assert_eq!(bytes.len(), start + 8 * 7 + 4);
    assert_eq!(bytes[8], 3);
    let with_key = |vertex: usize, key: u64| {
        let mut changed = bytes.clone();
        changed[start + 8 * vertex..][..8].copy_from_slice(&key.to_le_bytes());
        seal(&mut changed);
        let saved = Saved::of(&changed).expect("the right checksum");
        MovingTriangulation::<Plane>::load(&saved, Options::default())
            .map(|t| t.key_of_id(VertexId::at(vertex)))
            .map_err(|error| match error {
                LoadError::Data(damage) => damage,
                error => panic!("{error}"),
            })
    };
    let vertex = VertexId::new;
    assert_eq!(with_key(5, 6), Err(Damage::Key { vertex: vertex(5), given: 6 }));
    assert_eq!(with_key(4, 19), Err(Damage::Representative { vertex: vertex(4), given: vertex(1) }));
    assert!(matches!(with_key(3, 100), Err(Damage::NotDelaunay { .. })));
    assert_eq!((with_key(3, 11), with_key(4, u64::MAX), with_key(6, 9)), (Ok(11), Ok(u64::MAX), Ok(9)));
    let mut shorter = bytes[..bytes.len() - 8].to_vec();
    let size = shorter.len() as u64;
    shorter[16..24].copy_from_slice(&size.to_le_bytes());
    seal(&mut shorter);
    assert_eq!(Saved::of(&shorter).err(), Some(Damage::Counts));
}

/// Ten places in the plane.
fn ten() -> Vec<[f64; 2]> {
    let mut rng = Rng::new(59);
    (0..10).map(|_| [rng.unit(), rng.unit()]).collect()
}

/// What is there once insertions have been discarded is what was there before they were staged: also in a copy that is loaded in
/// between, whose next vertex has the same id and the same key.
#[test]
fn loaded_copies_forget_insertions_as_the_original_does() {
    type Staging = fn(&mut MovingTriangulation<Plane>) -> Result<(), Error>;
    // Keys come with the insertions; the highest id is given again; a higher one has been given, and compacted away.
    let stagings: [(u8, Staging); 4] = [
        (6, |t| t.stage_insertions_with_keys(&[[0.5, 0.5], [0.25, 0.5]], &[9, 9]).map(drop)),
        (5, |t| {
            t.remove_vertex(VertexId::new(9))?;
            t.stage_insertions_at_free_ids(&[[0.5, 0.5]], None, drop)
        }),
        (5, |t| {
            t.stage_insertions(&[[0.5, 0.5]])?;
            let higher = t.insert_vertex(&[0.25, 0.5])?;
            t.remove_vertex(higher)?;
            t.compact().map(drop)
        }),
        (1, |t| t.stage_insertions(&[[0.5, 0.5]]).map(drop)),
    ];
    for (k, (version, stage)) in stagings.into_iter().enumerate() {
        let mut t = MovingTriangulation::<Plane>::new(&ten(), Options::default()).expect("a build");
        stage(&mut t).expect("room");
        let bytes = t.saved().expect("room");
        assert_eq!(bytes[8], version, "{k}");
        let saved = Saved::of(&bytes).expect("saved");
        let mut copy = MovingTriangulation::<Plane>::load(&saved, Options::default()).expect("saved");
        let mut clone = t.try_clone(None).expect("room");
        assert_eq!(copy.saved().expect("room"), bytes, "{k}");
        let ends = [&mut t, &mut clone, &mut copy].map(|t| {
            t.discard_moves();
            let discarded = t.saved().expect("room");
            let vertex = t.insert_vertex(&[0.125, 0.375]).expect("room");
            (discarded, vertex, t.key(vertex).expect("present"), t.has_keys())
        });
        assert_eq!(ends[0], ends[1], "{k}");
        assert_eq!(ends[0], ends[2], "{k}");
    }
}

/// Data that tell of what was before the staged insertions tell what can have been, and nothing that follows from the rest.
#[test]
fn what_was_before_insertions_is_checked() {
    let mut t = MovingTriangulation::<Plane>::new(&ten(), Options::default()).expect("a build");
    t.stage_insertions_with_keys(&[[0.5, 0.5], [0.25, 0.5]], &[9, 9]).expect("room");
    let bytes = t.saved().expect("room");
    let at = bytes.len() - 4 - 96;
    let with = |n_known: u64, had_keys: u64| {
        let mut changed = bytes.clone();
        changed[at..at + 8].copy_from_slice(&n_known.to_le_bytes());
        changed[at + 8..at + 16].copy_from_slice(&had_keys.to_le_bytes());
        seal(&mut changed);
        let saved = Saved::of(&changed).expect("the right checksum");
        MovingTriangulation::<Plane>::load(&saved, Options::default()).map(drop)
    };
    for (n_known, had_keys) in [(10, 0), (11, 0), (12, 1), (11, 1)] {
        with(n_known, had_keys).unwrap_or_else(|error| panic!("{n_known} {had_keys}: {error}"));
    }
    // Below the ids that are not staged; above all; what version 3 says; neither 0 nor 1; of no size.
    for (n_known, had_keys) in [(9, 0), (13, 0), (10, 1), (10, 2), (u64::MAX, 0)] {
        assert_eq!(with(n_known, had_keys), Err(LoadError::Data(Damage::Counts)), "{n_known} {had_keys}");
    }
    // A mesh of no vertices is compared with nothing.
    let mut changed = bytes.clone();
    changed[at + 16] = 1;
    seal(&mut changed);
    let saved = Saved::of(&changed).expect("the right checksum");
    let loaded = MovingTriangulation::<Plane>::load(&saved, Options::default()).map(drop);
    assert_eq!(loaded, Err(LoadError::Data(Damage::Counts)));
}

/// Whether an id is given again: not one that is staged, nor where segments may still know it.
#[test]
fn ids_are_given_again_where_nothing_knows_them() {
    let places = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 0.5]];
    let mut t = MovingTriangulation::<Plane>::new(&places, Options::default()).expect("a build");
    let given = |t: &mut MovingTriangulation<Plane>, n: usize| {
        let mut ids = Vec::new();
        t.stage_insertions_at_free_ids(&vec![[1.0, 1.5]; n], None, |v| ids.push(v.get())).expect("room");
        ids
    };
    t.remove_vertex(VertexId::new(1)).expect("present");
    t.remove_vertex(VertexId::new(4)).expect("present");
    assert_eq!(given(&mut t, 1), [1]);
    assert_eq!(given(&mut t, 2), [4, 5]);
    assert!(given(&mut t, 0).is_empty());
    t.discard_moves();
    assert_eq!((t.id_count(), given(&mut t, 3)), (5, vec![1, 4, 5]));
    t.commit_timestamp().expect("room");
    assert_eq!((t.vertex_count(), t.validate(Level::Delaunay)), (6, Ok(())));
    t.remove_vertex(VertexId::new(4)).expect("present");
    t.stage_segments(
        [Segment { ends: [VertexId::new(0), VertexId::new(2)], marker: 0, ..Segment::default() }].into_iter(),
    )
    .expect("room");
    assert_eq!(given(&mut t, 1), [4]);
    t.discard_moves();
    // The end of a segment that is staged may be gone, and is not another vertex then.
    t.stage_segments(
        [Segment { ends: [VertexId::new(0), VertexId::new(3)], marker: 0, ..Segment::default() }].into_iter(),
    )
    .expect("room");
    t.remove_vertex(VertexId::new(3)).expect("present");
    assert_eq!(given(&mut t, 2), [4, 6]);
}
