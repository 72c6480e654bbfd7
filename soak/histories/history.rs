//! One history: phases of commits, with everything else that a program may do in between.

use super::family::{Frame, Source};
use super::fingerprint::Fingerprint;
use super::log::Log;
use super::mirror::Mirror;
use super::motion::Phase;
use super::{Outcome, RECORDED, Tally};
use crate::common::{CellSet, Rng, assert_same_cells, cell_set, fresh_cells, sorted};
use deldrift::motion::{
    Algorithm, CommitReport, Commits, Level, MovingTriangulation, NO_CELL, Options, Saved,
};
use deldrift::{CellId, Dimension, Error, VertexId};
use std::collections::BTreeSet;

pub struct History<G: Dimension> {
    t: MovingTriangulation<G>,
    source: Source<G>,
    frame: Frame<G>,
    /// By id, before the frame is applied; `None` once removed.
    now: Vec<Option<G::Point>>,
    /// By id, where vertices have keys, and what these are drawn from.
    keys: Option<(Vec<u64>, KeySource)>,
    /// What is drawn from for timestamps that are prepared, and then published or withdrawn.
    trials: Option<Rng>,
    spacing: f64,
    mirror: Mirror<G>,
    algorithm: Algorithm,
    /// Whether vertices come and go. While ids are missing no commit is of all vertices.
    has_edits: bool,
    rng: Rng,
    log: Log,
    tally: Tally,
    checksum: u64,
}

/// What keys are drawn from: a source of their own, as histories without keys are recorded.
struct KeySource {
    rng: Rng,
    /// How many there are to be drawn.
    n: u64,
}

impl KeySource {
    /// Of one in four histories behind the recorded ones: different keys, few, or one for all.
    fn of(seed: u64) -> Option<Self> {
        let is_recorded = seed < RECORDED.len() as u64;
        let n = [u64::MAX, 5, 1][(seed / 4 % 3) as usize];
        (!is_recorded && seed % 4 >= 2 && seed % 8 < 4).then(|| KeySource { rng: Rng::new(seed), n })
    }

    fn draw(&mut self) -> u64 {
        self.rng.next() % self.n
    }
}

/// How many points a history has at most, by its seed: they grow, up to some 10,000s.
fn most_points<G: Dimension>(seed: u64) -> usize {
    let (first, step, most): (usize, usize, usize) =
        if G::D == 2 { (16, 24, 40_000) } else { (16, 8, 12_000) };
    step.saturating_mul(usize::try_from(seed / 2).unwrap_or(most)).saturating_add(first).min(most)
}

impl<G: Dimension> History<G> {
    pub fn new(seed: u64, is_loud: bool) -> Self {
        let mut rng = Rng::new(seed ^ 0x50a4_0000_0000);
        let most = most_points::<G>(seed);
        let bits = 3 + rng.below(most.ilog2() as usize - 2);
        let n = 5 + rng.below((1 << bits).min(most));
        let mut source = Source::<G>::new(n, &mut rng);
        let (frame, suits) = Frame::new(source.family, &mut rng);
        source.n = source.n.min(suits);
        let now = source.draw(&mut rng);
        let algorithm = *rng.pick(&[&Algorithm::ALL[..], &[Algorithm::Auto; 6]].concat());
        let threads = 1 + rng.below(3) as u32;
        let name = format!(
            "seed {seed}: {}D, {:?}, {} points, {frame:?}, {threads} threads",
            G::D,
            source.family,
            source.n
        );
        let log = Log::new(seed, name, is_loud);
        let places: Vec<G::Point> = now.iter().map(|p| frame.place(p)).collect();
        let options = Options { algorithm, threads, ..Options::default() };
        let keys = KeySource::of(seed).map(|mut source| {
            let drawn: Vec<u64> = places.iter().map(|_| source.draw()).collect();
            (drawn, source)
        });
        let made = match &keys {
            Some((keys, _)) => MovingTriangulation::with_keys(&places, keys, options),
            None => MovingTriangulation::new(&places, options),
        };
        let t = made.unwrap_or_else(|error| panic!("{}: {error}", log.name()));
        History {
            t,
            spacing: spacing_of::<G>(&now),
            now: now.into_iter().map(Some).collect(),
            keys,
            trials: Self::trials_of(seed),
            source,
            frame,
            mirror: Mirror::default(),
            algorithm,
            has_edits: rng.one_in(2),
            rng,
            log,
            tally: Tally { histories: 1, ..Tally::default() },
            checksum: 0,
        }
    }

    /// Runs it to its end: after so many moves, or commits.
    pub fn run(mut self) -> Outcome {
        let (most_moves, most_commits) = if G::D == 2 { (400_000, 400) } else { (80_000, 300) };
        self.check(true);
        let mut cost = 0;
        while self.tally.commits < most_commits && cost < most_moves {
            let mut phase = self.begin_phase();
            while phase.commits_left > 0 {
                phase.commits_left -= 1;
                let report = self.commit(&phase);
                // Relocating all vertices one after the other takes several times as long as moving all.
                let dearer = if self.t.algorithm().row().commits == Commits::OneByOne { 4 } else { 1 };
                cost += self.now.len() as u64 / 4 + dearer * report.moved;
                self.check(false);
            }
            self.go_back(&phase);
        }
        assert_same_cells(&cell_set(&self.t), &self.expected_cells(), || self.context("in the end"));
        Outcome { tally: self.tally, checksum: self.checksum }
    }

    /// Between phases it may be compacted, and goes on by another algorithm.
    fn begin_phase(&mut self) -> Phase<G> {
        if self.now.contains(&None) && self.rng.one_in(3) {
            self.compact();
        }
        if self.rng.one_in(6) {
            self.copy();
        }
        let algorithm = if self.rng.one_in(3) { *self.rng.pick(&Algorithm::ALL) } else { self.algorithm };
        self.tally.algorithm_changes += u64::from(algorithm != self.t.algorithm());
        self.t.set_algorithm(algorithm);
        let phase = Phase::new(&self.source, self.spacing, &self.now, &mut self.rng);
        self.note(|| format!("{algorithm:?}, {}", phase.name()));
        phase
    }

    /// A commit of the phase's moves, sometimes together with insertions and removals, or after calls that take effect
    /// at once.
    fn commit(&mut self, phase: &Phase<G>) -> CommitReport {
        self.prepare_and_withdraw(phase);
        if self.has_edits && self.rng.one_in(4) {
            self.call_at_once(phase);
        }
        let leaving = if self.has_edits && self.rng.one_in(6) { self.stage_edits() } else { BTreeSet::new() };
        let mut present = self.present();
        // Those that are to be inserted are not there yet.
        present.retain(|&v| !leaving.contains(&v) && self.t.is_present(v));
        let chosen = phase.choose(present, &mut self.rng);
        let targets = phase.targets(&chosen, &self.now, &self.source, &mut self.rng);
        let report = self.stage_and_commit(&chosen, &targets);
        for v in leaving {
            self.now[v] = None;
        }
        report
    }

    fn stage_and_commit(&mut self, chosen: &[VertexId], targets: &[G::Point]) -> CommitReport {
        self.note(|| format!("commit {} moves", chosen.len()));
        let mut moved = 0;
        let places: Vec<G::Point> = targets.iter().map(|q| self.frame.place(q)).collect();
        for ((&v, q), place) in chosen.iter().zip(targets).zip(&places) {
            moved += u64::from(self.place(v) != *place);
            self.now[v] = Some(*q);
        }
        let is_whole = chosen.len() == self.t.id_count() && chosen.is_sorted();
        let committed = if is_whole && self.rng.one_in(3) {
            self.t.commit_positions(&places)
        } else {
            let staged = if is_whole && self.rng.one_in(2) {
                self.t.move_all(&places)
            } else {
                self.t.move_vertices(chosen, &places)
            };
            if self.rng.one_in(40) {
                self.copy();
            }
            staged.and_then(|()| self.commit_or_publish())
        };
        let report = committed.unwrap_or_else(|error| panic!("{}", self.context(&error.to_string())));
        if report.moved != moved {
            panic!("{}", self.context(&format!("{moved} have moved, {} are reported", report.moved)));
        }
        let tally = &mut self.tally;
        tally.commits += 1;
        tally.moves += moved;
        tally.flips += report.flips;
        tally.placements += report.placements;
        tally.rebuilds += report.rebuilds;
        tally.within_tolerance += report.within_tolerance;
        tally.hidden += report.coincident;
        report
    }

    /// Of half of the histories behind the recorded ones.
    fn trials_of(seed: u64) -> Option<Rng> {
        (seed >= RECORDED.len() as u64 && seed % 8 >= 3).then(|| Rng::new(!seed))
    }

    fn commit_or_publish(&mut self) -> Result<CommitReport, Error> {
        if !self.trials.as_mut().is_some_and(|rng| rng.one_in(3)) {
            return self.t.commit_timestamp();
        }
        self.note(|| "in two phases".to_string());
        let report = self.t.prepare_timestamp()?;
        self.t.publish_timestamp()?;
        Ok(report)
    }

    /// Sometimes, a few rounds of moves, insertions and removals that are withdrawn.
    fn prepare_and_withdraw(&mut self, phase: &Phase<G>) {
        let Some(mut rng) = self.trials.take() else { return };
        if rng.one_in(6) {
            let n_rounds = 1 + rng.below(3);
            self.note(|| format!("prepare {n_rounds} rounds and withdraw"));
            let mut removed = BTreeSet::new();
            for _ in 0..n_rounds {
                let mut present = self.present();
                present.retain(|v| !removed.contains(v));
                let leaving = (present.len() > 8 && rng.one_in(2)).then(|| *rng.pick(&present));
                let mut chosen = phase.choose(present, &mut rng);
                chosen.retain(|&v| Some(v) != leaving);
                let targets = phase.targets(&chosen, &self.now, &self.source, &mut rng);
                let places: Vec<G::Point> = targets.iter().map(|q| self.frame.place(q)).collect();
                let coming: Vec<G::Point> =
                    (0..rng.below(4)).map(|_| self.source.draw_one(&mut rng)).collect();
                let coming: Vec<G::Point> = coming.iter().map(|p| self.frame.place(p)).collect();
                let keys = (rng.one_in(2) || self.keys.is_some()).then(|| vec![rng.next() % 9; coming.len()]);
                let mut given = Vec::new();
                let staged = self.t.stage_insertions_at_free_ids(&coming, keys.as_deref(), |v| given.push(v));
                let staged = staged.and_then(|()| self.t.move_vertices(&chosen, &places));
                let staged = staged.and_then(|()| self.t.stage_removals(leaving.as_slice()));
                let made = staged.and_then(|()| self.t.prepare_timestamp());
                made.unwrap_or_else(|error| panic!("{}", self.context(&error.to_string())));
                assert!(given.iter().all(|v| !removed.contains(v)), "{}", self.context("an id given again"));
                removed.extend(leaving);
            }
            if rng.one_in(3) {
                let valid = self.t.validate(Level::Delaunay);
                valid.unwrap_or_else(|wrong| panic!("{}", self.context(&wrong.to_string())));
            }
            self.t.withdraw_timestamp();
            assert_eq!(self.t.id_count(), self.now.len(), "{}", self.context("ids after a withdrawal"));
        }
        self.trials = Some(rng);
    }

    /// The vertices return to where they were before the phase.
    fn go_back(&mut self, phase: &Phase<G>) {
        let Some(begin) = &phase.begin else { return };
        self.note(|| "back".to_string());
        let mut chosen = self.present();
        chosen.retain(|v| begin.get(v.index()).is_some_and(Option::is_some));
        let targets: Vec<G::Point> = chosen.iter().map(|&v| begin[v].expect("present")).collect();
        self.stage_and_commit(&chosen, &targets);
        self.check(false);
    }

    /// Stages insertions and removals; returns which vertices are leaving.
    fn stage_edits(&mut self) -> BTreeSet<VertexId> {
        let most = *self.rng.pick(&[2, 2, 10, self.now.len() / 4 + 1]);
        let coming: Vec<G::Point> =
            (0..self.rng.below(most + 1)).map(|_| self.source.draw_one(&mut self.rng)).collect();
        let present = self.present();
        let n_leaving = self.rng.below(most + 1).min(present.len() / 2);
        let leaving: BTreeSet<VertexId> = (0..n_leaving).map(|_| *self.rng.pick(&present)).collect();
        self.note(|| format!("stage {} insertions and removals of {leaving:?}", coming.len()));
        let places: Vec<G::Point> = coming.iter().map(|p| self.frame.place(p)).collect();
        let staged = match &mut self.keys {
            Some((keys, source)) => {
                let drawn: Vec<u64> = places.iter().map(|_| source.draw()).collect();
                keys.extend(&drawn);
                self.t.stage_insertions_with_keys(&places, &drawn)
            }
            None => self.t.stage_insertions(&places),
        };
        let first = staged.expect("room");
        assert_eq!(first.index(), self.now.len(), "{}", self.context("first id of staged insertions"));
        let numbers: Vec<VertexId> = leaving.iter().copied().collect();
        self.t.stage_removals(&numbers).expect("they are present");
        self.tally.insertions += coming.len() as u64;
        self.tally.removals += numbers.len() as u64;
        self.now.extend(coming.into_iter().map(Some));
        leaving
    }

    /// A few insertions, removals and relocations.
    fn call_at_once(&mut self, phase: &Phase<G>) {
        for _ in 0..1 + self.rng.below(3) {
            let present = self.present();
            if present.len() < 3 {
                return;
            }
            let v = *self.rng.pick(&present);
            match self.rng.below(5) {
                0 => {
                    let p = self.source.draw_one(&mut self.rng);
                    self.note(|| format!("insert {p:?}"));
                    let place = self.frame.place(&p);
                    let inserted = match &mut self.keys {
                        Some((keys, source)) => {
                            keys.push(source.draw());
                            self.t.insert_vertex_with_key(&place, keys[keys.len() - 1])
                        }
                        None => self.t.insert_vertex(&place),
                    };
                    let id = inserted.expect("room");
                    assert_eq!(id.index(), self.now.len(), "{}", self.context("id of an insertion"));
                    self.now.push(Some(p));
                    self.tally.insertions += 1;
                }
                1 => {
                    self.note(|| format!("remove {v}"));
                    self.t.remove_vertex(v).expect("it is present");
                    self.now[v] = None;
                    self.tally.removals += 1;
                }
                _ => {
                    let q = phase.targets(&[v], &self.now, &self.source, &mut self.rng)[0];
                    self.note(|| format!("relocate {v} to {q:?}"));
                    let place = self.frame.place(&q);
                    self.tally.moves += u64::from(self.place(v) != place);
                    self.tally.relocations += 1;
                    self.t.relocate_vertex(v, &place).expect("a good place");
                    self.now[v] = Some(q);
                }
            }
        }
    }

    fn compact(&mut self) {
        self.note(|| "compact".to_string());
        self.follow_changes();
        let new = self.t.compact().expect("room");
        if let Some((keys, _)) = &mut self.keys {
            let mut is_present = self.now.iter().map(Option::is_some);
            keys.retain(|_| is_present.next() == Some(true));
        }
        self.now.retain(Option::is_some);
        self.mirror.rename(&new, self.now.len());
        self.tally.compactions += 1;
        self.check(false);
    }

    /// Goes on with what has been saved and loaded, or with a clone, whatever is staged.
    fn copy(&mut self) {
        if self.rng.one_in(2) {
            self.note(|| "clone".to_string());
            self.t = self.t.try_clone(None).expect("room");
            self.tally.clones += 1;
            return;
        }
        let threads = 1 + self.rng.below(3) as u32;
        self.note(|| format!("save and load, {threads} threads from now on"));
        let bytes = self.t.saved().expect("room");
        let options = Options { algorithm: self.t.algorithm(), threads, ..Options::default() };
        let loaded = Saved::of(&bytes)
            .map_err(|damage| damage.to_string())
            .and_then(|saved| MovingTriangulation::load(&saved, options).map_err(|error| error.to_string()));
        self.t = loaded.unwrap_or_else(|error| panic!("{}", self.context(&error)));
        // It lists all cells as created.
        self.mirror = Mirror::default();
        self.tally.loads += 1;
    }

    fn present(&self) -> Vec<VertexId> {
        VertexId::range(0..self.now.len()).filter(|&v| self.now[v].is_some()).collect()
    }

    /// The vertices that are present, in the order that breaks ties: by id, or by key, position and id.
    fn ranked(&self) -> Vec<VertexId> {
        let mut present = self.present();
        if let Some((keys, _)) = &self.keys {
            let rank = |v: VertexId| {
                let place = self.place(v);
                // Of numbers that have the order of places, which are no negative zeros.
                let bits = [0, 1, G::D - 1].map(|k| place[k].to_bits() as i64);
                (keys[v.index()], bits.map(|x| if x < 0 { x ^ i64::MAX } else { x }), v)
            };
            present.sort_by_key(|&v| rank(v));
        }
        present
    }

    fn place(&self, v: VertexId) -> G::Point {
        self.frame.place(&self.now[v].expect("present"))
    }

    /// Where the vertices have to be.
    fn places(&self) -> Vec<Option<G::Point>> {
        self.now.iter().map(|p| p.map(|p| self.frame.place(&p))).collect()
    }

    /// Compares all with a fresh build; certificates and neighbours of few points always, of many now and then.
    fn check(&mut self, is_first: bool) {
        let places = self.places();
        for (v, p) in places.iter().enumerate() {
            let found = self.t.position(VertexId::at(v)).ok();
            assert!(found == *p, "{}", self.context(&format!("vertex {v} is at {found:?}, not at {p:?}")));
        }
        let present = self.ranked();
        let points: Vec<G::Point> = present.iter().map(|&v| places[v].expect("present")).collect();
        let options = Options { threads: 1, ..Options::default() };
        let fresh = MovingTriangulation::<G>::new(&points, options).expect("a fresh build");
        let cells = self.t.cells().expect("room").corners;
        let found = Fingerprint::of(cells, |v| v);
        let expected = Fingerprint::of(fresh.cells().expect("room").corners, |v| present[v]);
        if found != expected {
            self.tell_cells(&places);
        }
        for (rank, &v) in present.iter().enumerate() {
            let first = fresh.coincident_representative(VertexId::at(rank)).expect("present");
            let found = self.t.coincident_representative(v).ok();
            let expected = Some(present[first]);
            assert!(found == expected, "{}", self.context(&format!("at the place of {v} is {found:?}")));
        }
        found.enter(&mut self.checksum);
        let tally = &mut self.tally;
        tally.comparisons += 1;
        tally.cells_compared += found.cells;
        tally.without_cells += u64::from(found.cells == 0);
        if is_first || self.now.len() <= 100 || self.rng.one_in(8) {
            self.validate();
        }
        self.follow_changes();
    }

    fn validate(&mut self) {
        if let Err(violation) = self.t.validate(Level::Delaunay) {
            panic!("{}", self.context(&violation.to_string()));
        }
        let view = self.t.cells().expect("room");
        for c in CellId::range(0..view.corners.len()) {
            for (i, &n) in view.neighbours[c].as_ref().iter().enumerate() {
                if n == NO_CELL {
                    continue;
                }
                let (own, others) = (view.corners[c].as_ref(), view.corners[n].as_ref());
                let back = view.neighbours[n].as_ref().iter().position(|&back| back == c);
                let shares = (0..own.len()).filter(|&j| j != i).all(|j| others.contains(&own[j]));
                let is_opposite = back.is_some_and(|j| !own.contains(&others[j]));
                assert!(shares && is_opposite, "{}", self.context(&format!("cells {c} and {n}")));
            }
        }
        self.tally.validations += 1;
    }

    fn follow_changes(&mut self) {
        if let Err(wrong) = self.mirror.follow(&mut self.t) {
            panic!("{}", self.context(&wrong));
        }
    }

    /// Panics with the first cells that are wrong, and where their vertices are.
    /// The cells of a fresh build.
    fn expected_cells(&self) -> CellSet {
        let (places, order) = (self.places(), self.ranked());
        let ranked: Vec<_> = order.iter().map(|&v| places[v]).collect();
        let named = |cell: &Vec<VertexId>| sorted(&cell.iter().map(|&k| order[k]).collect::<Vec<_>>());
        fresh_cells::<G>(&ranked).iter().map(named).collect()
    }

    fn tell_cells(&self, places: &[Option<G::Point>]) -> ! {
        let (found, expected) = (cell_set(&self.t), self.expected_cells());
        let first = |cells: &CellSet, others: &CellSet| -> Vec<Vec<VertexId>> {
            cells.difference(others).take(4).cloned().collect()
        };
        let (extra, missing) = (first(&found, &expected), first(&expected, &found));
        let concerned: BTreeSet<VertexId> = extra.iter().chain(&missing).flatten().copied().collect();
        let valid =
            self.t.validate(Level::Delaunay).map_or_else(|v| v.to_string(), |()| "nothing".to_string());
        let mut text =
            format!("wrongly there: {extra:?}; missing: {missing:?}; the validation finds wrong: {valid}");
        for v in concerned {
            text += &format!("\n  vertex {v} at {:?}", places[v]);
        }
        panic!("{}", self.context(&text))
    }

    fn note(&mut self, what: impl FnOnce() -> String) {
        self.log.note(self.tally.commits, what());
    }

    /// What to tell of a mismatch.
    fn context(&self, what: &str) -> String {
        self.log.context("", what)
    }
}

/// About how far points are apart.
fn spacing_of<G: Dimension>(points: &[G::Point]) -> f64 {
    let extent = (0..G::D)
        .map(|k| {
            let (low, high) =
                points.iter().fold((f64::MAX, f64::MIN), |(l, h), p| (l.min(p[k]), h.max(p[k])));
            high - low
        })
        .fold(0.0, f64::max);
    let side = (1..).find(|side: &usize| side.pow(G::D as u32) >= points.len()).expect("some side");
    if extent > 0.0 { extent / side as f64 } else { 1.0 }
}
