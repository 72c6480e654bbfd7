//! What holds after every round.

use super::super::fingerprint::Fingerprint;
use super::MeshHistory;
use super::asked::LIMIT;
use deldrift::motion::{Level, MovingTriangulation, Options, QualityReport, Segment};
use deldrift::{Plane, VertexId};
use std::collections::BTreeMap;

impl MeshHistory {
    /// The cells are those of a fresh build, and so is what the change list leads to; segments are where they were.
    pub(super) fn check(&mut self) {
        let present = self.present();
        let mut rank = vec![VertexId::NONE; self.t.id_count()];
        (0..).map(VertexId::new).zip(&present).for_each(|(k, v)| rank[v.index()] = k);
        let points: Vec<_> = present.iter().map(|&v| self.t.position(v).expect("present")).collect();
        let keys: Vec<_> = present.iter().map(|&v| self.t.key_of_id(v)).collect();
        let options = Options { threads: 1, ..Options::default() };
        let fresh = match self.t.has_keys() {
            true => MovingTriangulation::<Plane>::with_keys(&points, &keys, options),
            false => MovingTriangulation::<Plane>::new(&points, options),
        };
        let mut fresh = fresh.expect("a fresh build");
        let renamed = |segment: Segment| Segment { ends: segment.ends.map(|v| rank[v.index()]), ..segment };
        let segments: Vec<_> = self.t.segments().map(|(_, segment)| renamed(segment)).collect();
        fresh.stage_segments(segments.into_iter()).expect("present");
        fresh.commit_timestamp().unwrap_or_else(|error| panic!("{}", self.context(&error.to_string())));
        let found = Fingerprint::of(self.t.cells().expect("room").corners, |v| v);
        let expected = Fingerprint::of(fresh.cells().expect("room").corners, |v| present[v]);
        assert!(found == expected, "{}", self.context(&format!("{found:?}, a fresh build {expected:?}")));
        for (k, &v) in present.iter().enumerate() {
            let first = fresh.coincident_representative(VertexId::at(k)).expect("present");
            let first = Ok(present[first.index()]);
            assert!(self.t.coincident_representative(v) == first, "{}", self.context(&format!("at {v}")));
        }
        found.enter(&mut self.checksum);
        self.tally.comparisons += 1;
        self.tally.cells_compared += found.cells;
        self.tally.without_cells += u64::from(found.cells == 0);
        if self.rng.one_in(4) {
            self.tally.validations += 1;
            let valid = self.t.validate(Level::Delaunay);
            valid.unwrap_or_else(|violation| panic!("{}", self.context(&violation.to_string())));
        }
        self.check_chains();
        self.follow_changes();
    }

    pub(super) fn follow_changes(&mut self) {
        if let Err(wrong) = self.mirror.follow(&mut self.t) {
            panic!("{}", self.context(&wrong));
        }
    }

    /// The pieces of each segment of the program's are a chain from end to end, with its marker.
    fn check_chains(&self) {
        let shown = |v: VertexId| self.t.coincident_representative(v).ok();
        let mut next = BTreeMap::new();
        for (id, segment) in self.t.segments() {
            let original = self.t.original_segment(id);
            let of = self.originals.get(&original);
            let is_known = of.is_some_and(|of| of.marker == segment.marker);
            assert!(is_known, "{}", self.context(&format!("{id:?} is of {original:?}, {of:?}")));
            let before = next.insert((original, shown(segment.ends[0])), segment.ends[1]);
            assert!(before.is_none(), "{}", self.context(&format!("two pieces of {original:?}")));
        }
        let mut n_pieces = 0;
        for (&id, original) in &self.originals {
            let [mut v, end] = original.ends;
            while shown(v) != shown(end) {
                let Some(&w) = next.get(&(id, shown(v))) else {
                    panic!("{}", self.context(&format!("{id:?}, {original:?}: no piece from {v}")));
                };
                n_pieces += 1;
                v = w;
            }
        }
        assert!(n_pieces == next.len(), "{}", self.context("pieces beside chains"));
        let gone = self.ids().find(|&v| self.is_own[v.index()] && !self.t.is_present(v));
        assert!(gone.is_none(), "{}", self.context(&format!("{gone:?} of the program's has gone")));
    }

    /// Values of a linear function follow.
    pub(super) fn check_weights(&self, come: &[VertexId], before: &[Option<[f64; 2]>]) {
        let weights = self.t.refined_weights();
        assert!(weights.len() == come.len(), "{}", self.context("as many weights as vertices"));
        for (&v, row) in come.iter().zip(weights) {
            let p = self.t.position(v).expect("it has come");
            for axis in 0..2 {
                let sum: f64 = row
                    .vertices
                    .iter()
                    .zip(row.weights)
                    .map(|(from, weight)| {
                        let place = before[from.index()].expect("it was there");
                        weight * (place[axis] - self.centre[axis])
                    })
                    .sum();
                let off = (sum - (p[axis] - self.centre[axis])).abs();
                let most = 1e-8 * (self.size + self.centre[axis].abs());
                assert!(off <= most, "{}", self.context(&format!("{v} is off by {off:e}: {row:?}")));
            }
        }
    }

    /// No more cells are bad than are told.
    pub(super) fn check_quality(&self, report: &QualityReport) {
        let n_bad = self.asked.count_bad(&self.t, &self.sizes);
        assert!(n_bad <= report.bad_cells, "{}", self.context(&format!("{n_bad} are bad, {report:?}")));
    }

    /// Another refinement changes nothing, and from the second one on no round does.
    pub(super) fn check_rest(&mut self, report: &QualityReport) {
        let before = self.bytes();
        let again = self.refine(LIMIT);
        let is_same = again.bad_cells == report.bad_cells && self.bytes() == before;
        assert!(is_same, "{}", self.context(&format!("a second refinement: {report:?}, {again:?}")));
        if self.rng.one_in(2) {
            return;
        }
        self.note(|| "rounds at rest".to_string());
        self.tally.rests += 1;
        // Coarsening has not looked at a mesh that has been made anew.
        let mut n_anew = 0;
        while self.goes_on(LIMIT)[1].removed > 0 {
            n_anew += 1;
            assert!(n_anew < 4, "{}", self.context("made anew again and again"));
        }
        self.tally.changed_at_rest += u64::from(self.bytes() != before);
        let before = self.bytes();
        let reports = self.goes_on(LIMIT);
        assert!(self.bytes() == before, "{}", self.context(&format!("a second round at rest: {reports:?}")));
    }

    /// A copy has gone on as the original.
    pub(super) fn check_copy(
        &self,
        copy: &MovingTriangulation<Plane>,
        [reports, others]: [[QualityReport; 2]; 2],
    ) {
        let what = || self.context(&format!("a copy reports {others:?}, and not {reports:?}"));
        assert!(reports == others, "{}", what());
        let places = |t: &MovingTriangulation<Plane>| -> Vec<_> {
            VertexId::range(0..t.id_count()).map(|v| t.position(v).ok()).collect()
        };
        let of = |t: &MovingTriangulation<Plane>| Fingerprint::of(t.cells().expect("room").corners, |v| v);
        let parts = [
            ("places", places(&self.t) == places(copy)),
            ("cells", of(&self.t) == of(copy)),
            ("segments", self.t.segments().eq(copy.segments())),
            ("vertices that were made", self.t.made_vertices().eq(copy.made_vertices())),
            ("vertices that have come", self.t.refined_vertices() == copy.refined_vertices()),
            ("their sizes", self.t.refined_sizes() == copy.refined_sizes()),
            ("their weights", self.t.refined_weights() == copy.refined_weights()),
        ];
        let others: Vec<_> = parts.iter().filter(|(_, is_same)| !is_same).map(|(name, _)| name).collect();
        assert!(others.is_empty(), "{}", self.context(&format!("a copy goes on with other {others:?}")));
    }
}
