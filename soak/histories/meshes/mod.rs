//! Histories of meshes that live: rounds of *move, commit, coarsen, refine* of a domain with holes and slits, while a
//! program adds and removes vertices and segments, compacts, saves and loads.
//!
//! After each round
//!
//! - the cells are those of a fresh build of the same vertices and segments, and the change list leads to them;
//! - no cell is bad beyond those that the report tells of;
//! - the pieces of every segment of the program's are a chain from end to end, and no vertex of the program's has gone;
//! - refinement at rest changes nothing, and neither does, from the second one on, a round at rest: what is saved is
//!   the same to the byte;
//! - copies and what has been loaded have gone on to the same mesh.
//!
//! A call that is refused leaves what is saved as it was.

mod asked;
mod checks;
mod domain;
mod motion;

use super::log::Log;
use super::mirror::Mirror;
use super::{Outcome, Tally};
use crate::common::Rng;
use asked::{Asked, LIMIT};
use deldrift::motion::{
    Algorithm, MovingTriangulation, Options, PassingPolicy, QualityReport, Saved, Segment,
};
use deldrift::{Error, Plane, SegmentId, VertexId};
use domain::{Domain, direction, turned};
use motion::Motion;
use std::collections::BTreeMap;

/// Histories end when there are more vertices.
const MOST: usize = 4_000;

/// A segment that the program has made, and pieces may have taken the place of.
#[derive(Clone, Copy, Debug)]
struct Original {
    ends: [VertexId; 2],
    marker: i32,
    is_slit: bool,
}

pub struct MeshHistory {
    t: MovingTriangulation<Plane>,
    asked: Asked,
    /// By id, the length that edges may have, of what is there.
    sizes: Vec<f64>,
    /// By id, whether the program has put the vertex there.
    is_own: Vec<bool>,
    originals: BTreeMap<SegmentId, Original>,
    /// How large the domain is, and where.
    size: f64,
    centre: [f64; 2],
    passing: PassingPolicy,
    mirror: Mirror<Plane>,
    rng: Rng,
    log: Log,
    tally: Tally,
    checksum: u64,
}

impl MeshHistory {
    pub fn new(seed: u64, is_loud: bool) -> Self {
        let mut rng = Rng::new(seed ^ 0x3e54_0000_0000);
        let size = 2f64.powi(*rng.pick(&[0, 0, 0, -30, 40]));
        let centre = *rng.pick(&[[0.0; 2], [0.0; 2], [1e6, -1e6], [3e4, 7e4]]);
        let centre = centre.map(|x: f64| x * size);
        let passing = *rng.pick(&[PassingPolicy::Ignore, PassingPolicy::Tell, PassingPolicy::Refuse]);
        let algorithm = *rng.pick(&[&Algorithm::ALL[..], &[Algorithm::Auto; 6]].concat());
        let threads = 1 + rng.below(3) as u32;
        let turn = if rng.one_in(3) { [1.0, 0.0] } else { direction(rng.unit()) };
        let has_keys = rng.one_in(4);
        // Some slits make two ends of a segment meet.
        let (t, originals, name) = loop {
            let domain = Domain::new(&mut rng);
            let name = format!(
                "seed {seed}: a domain of {} vertices and {} edges, {size:e} large at {centre:?}, turned by {turn:?}, \
                 {algorithm:?}, {threads} threads, {passing:?}, keys: {has_keys}",
                domain.points.len(),
                domain.edges.len()
            );
            let points: Vec<_> = domain
                .points
                .iter()
                .map(|&p| turned(p, turn))
                .map(|p| [0, 1].map(|axis| p[axis] * size + centre[axis]))
                .collect();
            let options = Options { algorithm, threads, passing, ..Options::default() };
            let keys: Vec<_> = points.iter().map(|_| rng.next() % 9).collect();
            let made = if has_keys {
                MovingTriangulation::with_keys(&points, &keys, options)
            } else {
                MovingTriangulation::new(&points, options)
            };
            let mut t = made.unwrap_or_else(|error| panic!("{name}: {error}"));
            let segments: Vec<_> = (0..)
                .zip(&domain.edges)
                .map(|(marker, edge)| Segment { ends: edge.map(VertexId::at), marker, ..Segment::default() })
                .collect();
            let first = t.stage_segments(segments.into_iter()).expect("present");
            // What crosses is split.
            if t.stage_splits(10_000).is_err() {
                continue;
            }
            t.commit_timestamp().unwrap_or_else(|error| panic!("{name}: {error}"));
            let original = |(k, edge): (usize, &[usize; 2])| Original {
                ends: edge.map(VertexId::at),
                marker: k as i32,
                is_slit: k >= domain.n_loops,
            };
            let ids = SegmentId::range(first.index()..first.index() + domain.edges.len());
            break (t, ids.zip(domain.edges.iter().enumerate().map(original)).collect(), name);
        };
        let log = Log::new(seed, name, is_loud);
        let asked = Asked::new(size, &mut rng);
        let n = t.id_count();
        let mut history = MeshHistory {
            t,
            asked,
            sizes: Vec::new(),
            is_own: vec![true; n],
            originals,
            size,
            centre,
            passing,
            mirror: Mirror::default(),
            rng,
            log,
            tally: Tally { histories: 1, ..Tally::default() },
            checksum: 0,
        };
        history.draw_sizes();
        history
    }

    /// Runs it to its end.
    pub fn run(mut self) -> Outcome {
        self.check();
        for _ in 0..8 + self.rng.below(13) {
            if self.rng.one_in(5) {
                self.asked = Asked::new(self.size, &mut self.rng);
                self.draw_sizes();
            }
            self.change();
            self.mend();
            self.check();
            // A refinement that does not end leaves many.
            if self.t.vertex_count() > MOST {
                break;
            }
        }
        Outcome { tally: self.tally, checksum: self.checksum }
    }

    /// Everything that a program may do between two refinements.
    fn change(&mut self) {
        if self.rng.one_in(6) {
            self.withdraw();
        }
        self.advance();
        if self.rng.one_in(3) {
            for _ in 0..1 + self.rng.below(4) {
                self.edit();
            }
        }
        match self.rng.below(16) {
            0 => self.compact(),
            1 => {
                self.note(|| "clone".to_string());
                self.t = self.t.try_clone(None).expect("room");
                self.tally.clones += 1;
            }
            2 => {
                self.t = self.loaded();
                self.mirror = Mirror::default();
                self.tally.loads += 1;
            }
            3 => {
                let algorithm = *self.rng.pick(&Algorithm::ALL);
                self.note(|| format!("{algorithm:?}"));
                self.t.set_algorithm(algorithm);
                self.tally.algorithm_changes += 1;
            }
            _ => {}
        }
    }

    /// Moves vertices, by less where segments refuse it.
    fn advance(&mut self) {
        let motion = Motion::new(&mut self.rng);
        let before = self.bytes();
        for halvings in 0..5 {
            let (chosen, goals) = self.goals(&motion, 0.5f64.powi(halvings));
            self.note(|| format!("{motion:?} of {} vertices, halved {halvings} times", chosen.len()));
            let n_ids = self.t.id_count();
            let committed = if chosen.len() == n_ids && self.rng.one_in(2) {
                self.t.commit_positions(&goals)
            } else {
                self.t.move_vertices(&chosen, &goals).expect("present");
                if self.rng.one_in(4) {
                    let made = self.t.prepare_timestamp();
                    if made.is_ok() {
                        self.t.publish_timestamp().expect("it is prepared");
                    }
                    made
                } else {
                    self.t.commit_timestamp()
                }
            };
            match committed {
                Ok(report) => {
                    let tally = &mut self.tally;
                    tally.commits += 1;
                    tally.moves += report.moved;
                    tally.flips += report.flips;
                    tally.placements += report.placements;
                    tally.rebuilds += report.rebuilds;
                    tally.within_tolerance += report.within_tolerance;
                    tally.hidden += report.coincident;
                    for (v, goal) in chosen.iter().zip(goals) {
                        assert_eq!(self.t.position(*v), Ok(goal), "{}", self.context("a place"));
                    }
                    return;
                }
                Err(error) => self.refused(&error, &before),
            }
        }
    }

    /// Rounds that leave nothing.
    fn withdraw(&mut self) {
        self.note(|| "prepare and withdraw".to_string());
        let before = self.bytes();
        for _ in 0..1 + self.rng.below(2) {
            let motion = Motion::new(&mut self.rng);
            let (chosen, goals) = self.goals(&motion, 1.0);
            self.t.move_vertices(&chosen, &goals).expect("present");
            if self.t.prepare_timestamp().is_err() {
                self.t.discard_moves();
            }
        }
        self.t.withdraw_timestamp();
        self.t.discard_moves();
        assert!(self.bytes() == before, "{}", self.context("bytes after a withdrawal"));
    }

    /// A call by which segments are in the way has changed nothing.
    fn refused(&mut self, error: &Error, before: &[u8]) {
        let is_expected = match error {
            Error::Conflict { .. } => true,
            Error::Passing { .. } => self.passing == PassingPolicy::Refuse,
            _ => false,
        };
        assert!(is_expected, "{}", self.context(&error.to_string()));
        self.note(|| format!("refused: {error}"));
        self.t.discard_moves();
        self.tally.refusals += 1;
        assert!(self.bytes() == before, "{}", self.context("bytes after a refusal"));
    }

    /// One vertex or segment comes or goes.
    fn edit(&mut self) {
        let before = self.bytes();
        let present = self.present();
        let v = *self.rng.pick(&present);
        let reach = self.size;
        let place = [0, 1].map(|axis| self.centre[axis] + reach * (self.rng.unit() - 0.5));
        let edited = match self.rng.below(6) {
            0 => {
                self.note(|| format!("insert at {place:?}"));
                self.t.insert_vertex(&place).map(|v| self.own(v))
            }
            1 => {
                // Sometimes where another one is.
                let place = if self.rng.one_in(3) { self.t.position(v).expect("present") } else { place };
                self.note(|| format!("insert at a free id at {place:?}"));
                let (mut id, keys) = (None, [self.rng.next() % 9]);
                let keys = self.t.has_keys().then_some(&keys[..]);
                self.t.stage_insertions_at_free_ids(&[place], keys, |v| id = Some(v)).expect("a place");
                self.t.commit_timestamp().map(|_| self.own(id.expect("an id")))
            }
            2 | 3 => {
                self.note(|| format!("remove {v}"));
                let removed = self.t.remove_vertex(v);
                if removed.is_ok() {
                    self.is_own[v.index()] = false;
                    self.tally.removals += 1;
                }
                removed
            }
            4 => {
                let cells = self.t.cells().expect("room").corners;
                if cells.is_empty() {
                    return;
                }
                let row = cells[self.rng.below(cells.len())];
                self.note(|| format!("a segment from {} to {}", row[0], row[1]));
                let original = Original { ends: [row[0], row[1]], marker: 1_000, is_slit: true };
                let segment = Segment { ends: original.ends, marker: original.marker, ..Segment::default() };
                let id = self.t.stage_segments([segment].into_iter()).expect("present");
                self.t.commit_timestamp().map(|_| {
                    self.originals.insert(id, original);
                })
            }
            _ => {
                let slits: Vec<_> =
                    self.originals.iter().filter(|(_, o)| o.is_slit).map(|(&id, _)| id).collect();
                if slits.is_empty() {
                    return;
                }
                let slit = *self.rng.pick(&slits);
                self.note(|| format!("remove segment {slit:?}"));
                let pieces = self.t.segments().map(|(id, _)| id);
                let pieces: Vec<_> = pieces.filter(|&id| self.t.original_segment(id) == slit).collect();
                self.t.stage_segment_removals(&pieces).expect("in force");
                self.t.commit_timestamp().map(|_| {
                    self.originals.remove(&slit);
                })
            }
        };
        if let Err(error) = edited {
            self.refused(&error, &before);
        }
    }

    /// The program has put a vertex there.
    fn own(&mut self, v: VertexId) {
        let n = self.t.id_count();
        self.is_own.resize(n, false);
        self.sizes.resize(n, f64::NAN);
        self.is_own[v.index()] = true;
        self.sizes[v.index()] = self.size_at(v);
        self.tally.insertions += 1;
    }

    fn compact(&mut self) {
        self.note(|| "compact".to_string());
        self.follow_changes();
        let new = self.t.compact().expect("room");
        let is_there = |&(_, v): &(usize, &VertexId)| *v != VertexId::NONE;
        let there: Vec<usize> = new.iter().enumerate().filter(is_there).map(|(old, _)| old).collect();
        self.sizes = there.iter().map(|&old| self.sizes[old]).collect();
        self.is_own = there.iter().map(|&old| self.is_own[old]).collect();
        for original in self.originals.values_mut() {
            original.ends = original.ends.map(|v| new[v.index()]);
        }
        self.mirror.rename(&new, there.len());
        self.tally.compactions += 1;
    }

    /// What has been saved and loaded.
    fn loaded(&mut self) -> MovingTriangulation<Plane> {
        let threads = 1 + self.rng.below(3) as u32;
        self.note(|| format!("save and load, {threads} threads from now on"));
        let bytes = self.bytes();
        let options =
            Options { algorithm: self.t.algorithm(), threads, passing: self.passing, ..Options::default() };
        let loaded = Saved::of(&bytes)
            .map_err(|damage| damage.to_string())
            .and_then(|saved| MovingTriangulation::load(&saved, options).map_err(|error| error.to_string()));
        loaded.unwrap_or_else(|error| panic!("{}", self.context(&error)))
    }

    /// Coarsens and refines: so do copies, to the same end.
    fn mend(&mut self) {
        let copies = match self.rng.below(3) {
            0 => vec![self.loaded(), self.t.try_clone(None).expect("room")],
            _ => Vec::new(),
        };
        self.note(|| "coarsen and refine".to_string());
        let sizes = self.sizes.clone();
        let limit = self.asked.limit;
        let [coarsened, refined] = self.goes_on(limit);
        for mut copy in copies {
            let reports = [
                self.asked.coarsen(&mut copy, &sizes).expect("a domain"),
                self.asked.refine(&mut copy, &sizes, limit).expect("a domain"),
            ];
            self.check_copy(&copy, [[coarsened, refined], reports]);
        }
        assert!(refined.inserted <= limit, "{}", self.context("more vertices than the limit"));
        if refined.is_cut_short {
            let is_expected = limit < LIMIT || self.asked.may_be_endless();
            assert!(is_expected, "{}", self.context("refinement does not end"));
            self.tally.cut_short += u64::from(limit == LIMIT);
            return;
        }
        self.check_quality(&refined);
        self.check_rest(&refined);
    }

    /// What a program does at each step.
    fn goes_on(&mut self, limit: usize) -> [QualityReport; 2] {
        let coarsened = self.asked.coarsen(&mut self.t, &self.sizes);
        let coarsened = coarsened.unwrap_or_else(|error| panic!("{}", self.context(&error.to_string())));
        let refined = self.refine(limit);
        [coarsened, refined]
    }

    /// Refines, and carries along what belongs to vertices.
    fn refine(&mut self, limit: usize) -> QualityReport {
        let before: Vec<_> = self.ids().map(|v| self.t.position(v).ok()).collect();
        let refined = self.asked.refine(&mut self.t, &self.sizes, limit);
        let refined = refined.unwrap_or_else(|error| panic!("{}", self.context(&error.to_string())));
        self.tally.refined += refined.inserted as u64;
        self.tally.made_anew += u64::from(refined.removed > 0);
        let n = self.t.id_count();
        self.is_own.resize(n, false);
        self.sizes.resize(n, f64::NAN);
        let come = self.t.refined_vertices().to_vec();
        let told = self.t.refined_sizes().to_vec();
        for (k, &v) in come.iter().enumerate() {
            self.is_own[v.index()] = false;
            self.sizes[v.index()] = told.get(k).copied().unwrap_or_else(|| self.size_at(v));
        }
        self.check_weights(&come, &before);
        refined
    }

    /// The length that edges may have at a vertex.
    fn size_at(&self, v: VertexId) -> f64 {
        let [x, y] = self.t.position(v).expect("present");
        let [x, y] = [x - self.centre[0], y - self.centre[1]];
        0.1 * self.size + 0.3 * (x * x + y * y).sqrt()
    }

    fn draw_sizes(&mut self) {
        let sizes = self.ids().map(|v| if self.t.is_present(v) { self.size_at(v) } else { f64::NAN });
        self.sizes = sizes.collect();
    }

    fn ids(&self) -> impl Iterator<Item = VertexId> + use<> {
        VertexId::range(0..self.t.id_count())
    }

    fn present(&self) -> Vec<VertexId> {
        self.ids().filter(|&v| self.t.is_present(v)).collect()
    }

    fn bytes(&self) -> Vec<u8> {
        self.t.saved().expect("room")
    }

    fn note(&mut self, what: impl FnOnce() -> String) {
        self.log.note(self.tally.commits, what());
    }

    /// What to tell of a mismatch.
    fn context(&self, what: &str) -> String {
        self.log.context(&format!("\n  {:?}", self.asked), what)
    }
}
