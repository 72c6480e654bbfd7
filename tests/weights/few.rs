//! Few vertices change among many that are hidden: reports, lists of changes and sums tell of each who is hidden,
//! whatever came before.

use super::{fresh, shown};
use crate::common::Rng;
use deldrift::internals::{PowerPlane, PowerSpace};
use deldrift::motion::{Algorithm, CommitReport, MovingTriangulation, Options};
use deldrift::{Moving, VertexId};
use std::collections::BTreeSet;

type Hidden = BTreeSet<VertexId>;

/// Vertices on a grid where two seldom meet by chance, and what is known of them.
struct Few<G: Moving> {
    t: MovingTriangulation<G>,
    points: Vec<Option<G::Point>>,
    extent: i64,
    most: i64,
    rng: Rng,
    hidden: Hidden,
    taken: Hidden,
    n_shared: usize,
    name: String,
}

impl<G: Moving> Few<G> {
    fn new(algorithm: Algorithm, seed: u64) -> Self {
        let n = 160;
        let mut few = Few {
            t: MovingTriangulation::new(&[], Options::default()).expect("room"),
            points: Vec::new(),
            extent: if G::D == 2 { 60 } else { 14 },
            most: if G::D == 2 { 80 } else { 30 },
            rng: Rng::new(seed),
            hidden: Hidden::new(),
            taken: Hidden::new(),
            n_shared: 0,
            name: format!("{algorithm:?}, {}D, seed {seed}", G::D),
        };
        let points: Vec<_> = (0..n).map(|_| few.draw()).collect();
        few.t = MovingTriangulation::new(&points, Options { algorithm, ..Options::default() }).expect("room");
        few.points = points.into_iter().map(Some).collect();
        few.hidden = few.listed();
        few
    }

    fn draw(&mut self) -> G::Point {
        let mut p = G::Point::default();
        (0..G::D).for_each(|k| p[k] = self.rng.within(0, self.extent) as f64);
        p[G::D] = self.rng.within(0, self.most) as f64;
        p
    }

    fn present(&mut self) -> VertexId {
        loop {
            let v = self.rng.below(self.points.len());
            if self.points[v].is_some() {
                return VertexId::new(v as u32);
            }
        }
    }

    /// Another weight, another place, maybe that of another vertex, or both.
    fn goal(&mut self, v: VertexId) -> G::Point {
        let (other, mut goal) = (self.present(), self.draw());
        let own = self.points[v].expect("it is present");
        match self.rng.below(6) {
            0 => (0..G::D).for_each(|k| goal[k] = own[k]),
            1 => goal[G::D] = own[G::D],
            2 => (0..G::D).for_each(|k| goal[k] = self.points[other].expect("it is present")[k]),
            3 => (0..G::D).for_each(|k| goal[k] = own[k] + self.rng.within(-1, 1) as f64),
            _ => {}
        }
        goal
    }

    /// Who is hidden, by the lists that are made anew.
    fn listed(&self) -> Hidden {
        let by_weight = self.t.hidden_by_weight().expect("room").into_iter().map(|(v, _)| v);
        by_weight.chain(self.t.hidden_by_place().expect("room").into_iter().map(|(v, _)| v)).collect()
    }

    fn stage(&mut self) {
        let mut chosen = Hidden::new();
        for _ in 0..self.rng.below(3) {
            let v = self.present();
            if chosen.insert(v) {
                let goal = self.goal(v);
                self.t.move_vertices(&[v], &[goal]).expect("room");
                self.points[v] = Some(goal);
            }
        }
        if self.rng.below(3) == 0 {
            let v = self.present();
            self.t.stage_removals(&[v]).expect("room");
            self.points[v] = None;
        }
        for _ in 0..self.rng.below(3) {
            let other = self.present();
            let mut point = self.draw();
            if self.rng.below(8) == 0 {
                (0..G::D).for_each(|k| point[k] = self.points[other].expect("it is present")[k]);
            }
            self.t
                .stage_insertions_at_free_ids(&[point], None, |v| {
                    self.points.resize(self.points.len().max(v.index() + 1), None);
                    self.points[v] = Some(point);
                })
                .expect("room");
        }
    }

    fn at_once(&mut self) {
        for _ in 0..=self.rng.below(3) {
            let v = self.present();
            match self.rng.below(4) {
                0 => {
                    let point = self.draw();
                    self.points.push(Some(point));
                    self.t.insert_vertex(&point).expect("room");
                }
                1 => {
                    self.t.remove_vertex(v).expect("room");
                    self.points[v] = None;
                }
                _ => {
                    let goal = self.goal(v);
                    self.t.relocate_vertex(v, &goal).expect("room");
                    self.points[v] = Some(goal);
                }
            }
        }
    }

    fn step(&mut self) {
        match self.rng.below(8) {
            0..=2 => {
                self.at_once();
                self.hidden = self.listed();
            }
            3 => {
                let before = self.points.clone();
                self.stage();
                self.t.prepare_timestamp().expect("room");
                self.t.withdraw_timestamp();
                self.points = before;
            }
            4 => self.t = self.t.try_clone(None).expect("room"),
            _ => {
                self.stage();
                let report = self.t.commit_timestamp().expect("room");
                self.check_report(&report);
            }
        }
        self.check();
    }

    /// What a commit says of who is hidden.
    fn check_report(&mut self, report: &CommitReport) {
        let (was, is) = (std::mem::take(&mut self.hidden), self.listed());
        let n_shown = was.difference(&is).filter(|&&v| self.points[v].is_some()).count();
        let told = [report.newly_hidden, report.newly_shown, report.coincident, report.hidden_by_weight];
        let by_place = self.t.hidden_by_place().expect("room").len();
        let found = [is.difference(&was).count(), n_shown, by_place, is.len() - by_place];
        assert_eq!(told, found.map(|n| n as u64), "{}", self.name);
        self.n_shared += usize::from(by_place > 0);
        self.hidden = is;
    }

    fn check(&mut self) {
        assert_eq!(shown(&self.t), fresh::<G>(&self.points), "{}", self.name);
        let is = self.listed();
        assert_eq!(is, self.hidden, "{}", self.name);
        let sums = self.t.statistics_of_now().expect("room");
        assert_eq!(sums.coincident + sums.hidden_by_weight, is.len() as u64, "{}", self.name);
        if self.rng.below(2) == 0 {
            let points = &self.points;
            // One that has the id of a vertex that has gone is told as if that had moved.
            self.taken.retain(|&v| points[v].is_some());
            let changes = self.t.take_changes().expect("room");
            let hidden: Vec<_> = is.difference(&self.taken).copied().collect();
            let shown: Vec<_> = self.taken.difference(&is).copied().collect();
            assert_eq!((changes.hidden, changes.shown), (&hidden[..], &shown[..]), "{}", self.name);
            self.taken = is;
        }
    }
}

fn histories_are_followed<G: Moving>() {
    let (mut n_hidden, mut n_shared) = (0, 0);
    for algorithm in Algorithm::ALL {
        for seed in 0..3 {
            let mut few = Few::<G>::new(algorithm, seed);
            for _ in 0..30 {
                few.step();
            }
            n_hidden += few.hidden.len();
            n_shared += few.n_shared;
        }
    }
    assert!(n_hidden > 1_000 && n_shared > 30, "{n_hidden} hidden, {n_shared} commits with shared places");
}

#[test]
fn few_that_change_in_the_plane_are_followed() {
    histories_are_followed::<PowerPlane>();
}

#[test]
fn few_that_change_in_space_are_followed() {
    histories_are_followed::<PowerSpace>();
}
