//! The commit: one timestamp, all or nothing.

use crate::delaunay::{Moving, Shortcut};
use crate::error::{Error, Result};
use crate::machine::memory;
use crate::motion::algorithms::{Algorithm, for_algorithms};
use crate::motion::calls::editing::Edited;
use crate::motion::region_kind::RegionKind;
use crate::motion::report::CommitReport;
use crate::motion::state::goals::Moves;
use crate::motion::state::mesh::Told;
use crate::motion::state::passings::Steps;
use crate::motion::state::segments::Aim;
use crate::motion::triangulation::MovingTriangulation;
use crate::motion::ways::attempt::Start;
use crate::motion::ways::outlook::Outlook;

impl<G: Moving> MovingTriangulation<G> {
    /// Makes the staged positions the next timestamp.
    ///
    /// On an error the triangulation is at the timestamp before, and the moves stay staged.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// t.move_vertices(&[VertexId::new(3)], &[[0.2, 0.2]])?;
    /// let report = t.commit_timestamp()?;
    /// assert_eq!((report.timestamp, report.moved), (1, 1));
    /// assert_eq!(t.cell_count(), 3); // the vertex is inside of the triangle of the others
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Cancelled`], [`Error::Coincident`] if the options reject that, [`Error::TooManyCells`],
    /// [`Error::OutOfMemory`]; [`Error::Prepared`]; [`Error::Conflict`] of segments, and [`Error::Passing`] if the options refuse that, which is
    /// looked at first.
    pub fn commit_timestamp(&mut self) -> Result<CommitReport> {
        self.reject_prepared()?;
        self.mesh.last_found.begin();
        self.apply_passing_policy_to_staged()?;
        let mut staging = std::mem::take(&mut self.staging);
        let done = self.commit(&mut staging.moves(self.mesh.n_present));
        if done.is_ok() {
            staging.clear();
        }
        self.staging = staging;
        done
    }

    /// Makes these moves, and the staged edits, the next timestamp.
    fn commit(&mut self, moves: &mut Moves<'_, G>) -> Result<CommitReport> {
        self.mesh.know_hidden()?;
        let before = self.mesh.evaluations();
        let changed = self.parts_to_change(moves);
        let mut report = self.reach(moves)?;
        self.mesh.publish();
        self.enter_evaluations(&mut report, before);
        self.end_edits();
        if let Some(segments) = &mut self.mesh.segments {
            segments.end_staging();
        }
        if let Some(made) = &mut self.made {
            made.end_staging();
        }
        self.statistics.timestamp += 1;
        self.count(report);
        self.note_hidden(&report);
        report.timestamp = self.statistics.timestamp;
        report.coincident = self.statistics.coincident;
        self.follow_commit(&report);
        self.tell_parts(&mut report, changed);
        Ok(report)
    }

    /// Begins a change and brings all to where these moves, and the staged edits, have it; then nothing can fail. On an
    /// error the change has been undone. Who is hidden [has been found
    /// out](crate::motion::state::mesh::Mesh::know_hidden).
    pub(in crate::motion) fn reach(&mut self, moves: &mut Moves<'_, G>) -> Result<CommitReport> {
        let mut report = CommitReport::default();
        let mut told = Told::Nothing;
        let advanced = if self.rests_beside_segments(moves) {
            self.mesh.begin(Aim::Rest)?;
            self.mesh.reject_coincidence(self.options.coincidence)
        } else {
            self.mesh.begin(Aim::Commit)?;
            self.edit_and_advance(moves, &mut report)
                .and_then(|()| self.loosen_moved(moves))
                .and_then(|()| self.settle_hidden(&mut report))
                .and_then(|()| {
                    told = self.tell_hidden(moves, &mut report)?;
                    self.mesh.enforce_segments()
                })
        };
        if let Err(error) = advanced.and_then(|()| self.mesh.views.prepare(&self.mesh.kernel)) {
            self.undo();
            return Err(error);
        }
        self.mesh.follow_told(told);
        Ok(report)
    }

    /// Whether segments would be in the way of a commit of what is staged: the commit is made and taken back. What is
    /// staged stays so, and the [conflicts](Self::conflicts_of_segments) can be asked for. Without segments, in force or
    /// staged, nothing is looked at.
    ///
    /// # Errors
    /// The errors of [`commit_timestamp`](Self::commit_timestamp), but [`Error::Prepared`]: what has been prepared is
    /// where the check begins.
    pub fn check_staged(&mut self) -> Result<()> {
        self.mesh.last_found.begin();
        self.apply_passing_policy_to_staged()?;
        self.check_conflicts()
    }

    /// Whether segments would be in the way of a commit of what is staged, whatever passes them.
    pub(in crate::motion) fn check_conflicts(&mut self) -> Result<()> {
        if self.mesh.segments.is_none() {
            return Ok(());
        }
        let mut staging = std::mem::take(&mut self.staging);
        let checked = self.check(&mut staging.moves(self.mesh.n_present));
        self.staging = staging;
        checked
    }

    /// Whether segments have taken the place of cells, which need not be put back, as nothing is going to change.
    fn rests_beside_segments(&self, moves: &Moves<'_, G>) -> bool {
        let Some(segments) = &self.mesh.segments else { return false };
        segments.have_replaced_cells()
            && !segments.are_staged()
            && self.edits.are_none()
            && self.options.algorithm != Algorithm::Rebuilding
            && self.mesh.outlook(moves, false) == Outlook::AtRest
    }

    /// Makes these moves and the staged edits, and takes them back.
    fn check(&mut self, moves: &mut Moves<'_, G>) -> Result<()> {
        let mut report = CommitReport::default();
        if self.rests_beside_segments(moves) {
            self.mesh.begin(Aim::Rest)?;
            self.undo();
            return Ok(());
        }
        self.mesh.begin(Aim::Check)?;
        let advanced = self.edit_and_advance(moves, &mut report).and_then(|()| self.mesh.enforce_segments());
        self.undo();
        match advanced {
            Err(Error::Cancelled) if self.mesh.segments.as_ref().is_some_and(|s| s.is_checked()) => Ok(()),
            other => other,
        }
    }

    /// Makes the positions given the next timestamp, in one call for [`move_all`](Self::move_all) and
    /// [`commit_timestamp`](Self::commit_timestamp), and without a copy of them. On an error no move is staged, and
    /// insertions are staged as before.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let mut points = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&points, Options::default())?;
    /// for point in &mut points {
    ///     point[0] += 0.5;
    /// }
    /// assert_eq!(t.commit_positions(&points)?.moved, 4);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::DuplicateMove`] if moves are staged; otherwise those of both.
    pub fn commit_positions(&mut self, positions: &[G::Point]) -> Result<CommitReport> {
        self.reject_prepared()?;
        self.mesh.last_found.begin();
        if let Some(vertex) = self.staging.first_staged() {
            return Err(Error::DuplicateMove { argument: "positions", index: vertex.index(), vertex });
        }
        if self.can_stage_whole(positions.len()) && !positions.is_empty() {
            let mut moves = Moves::lent(positions);
            self.apply_passing_policy(|| Ok(Steps::All(moves.checked()?)))?;
            return self.commit(&mut moves);
        }
        let before = memory::copy_of(self.edits.insertions())?;
        self.move_all(positions)?;
        let done = self.commit_timestamp();
        if done.is_err() {
            self.staging.clear();
            self.edits.restore_insertions(before);
        }
        done
    }

    /// Makes the edits, and brings the vertices to their goals.
    fn edit_and_advance(&mut self, moves: &mut Moves<'_, G>, report: &mut CommitReport) -> Result<()> {
        match self.make_edits(moves, report)? {
            Edited::WithMoves => Ok(()),
            Edited::WithoutMoves => self.advance(moves, report),
        }
    }

    /// Brings the vertices to their goals.
    fn advance(&mut self, moves: &mut Moves<'_, G>, report: &mut CommitReport) -> Result<()> {
        // Without cells nothing is looked at but this, and by rebuilding not even that.
        let algorithm = self.options.algorithm;
        let may_rest = !self.mesh.kernel.has_cells() && algorithm != Algorithm::Rebuilding;
        if !may_rest || self.mesh.outlook(moves, false) != Outlook::AtRest {
            self.commit_by(algorithm, moves, report)?;
        }
        self.mesh.reject_coincidence(self.options.coincidence)
    }
}

/// Makes the calls of the methods that commit, from the table of algorithms.
macro_rules! commit_by {
    (default $default:ident; $(
        $(#[doc = $line:literal])+
        $variant:ident = $code:literal {
            name: $name:literal,
            purpose: $purpose:ident,
            commits: $commits:ident,
            keeps: $keeps:literal,
            immediate: $immediate:ident$(($filter:ident))?,
            by: $method:ident($($argument:expr),*),
        }
    )+) => {
        impl<G: Moving> MovingTriangulation<G> {
            /// Brings the vertices to their goals.
            fn commit_by(
                &mut self,
                algorithm: Algorithm,
                moves: &mut Moves<'_, G>,
                report: &mut CommitReport,
            ) -> Result<()> {
                match algorithm {
                    $(Algorithm::$variant => self.$method($($argument,)* moves, report),)+
                }
            }
        }
    };
}

for_algorithms!(commit_by);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::{Level, Plane, PowerPlane, PowerSpace, Space};
    use crate::ids::VertexId;
    use crate::motion::options::Options;
    use crate::motion::state::goals::Movers;
    use crate::random::Rng;

    /// Memory that is lent is the program's: what a callback has written there after the check is refused where it is
    /// read again, and all is undone.
    fn goals_that_turn_bad_are_refused<G: Moving>() {
        let rng = &mut Rng::new(7);
        let mut random = || {
            let mut points = vec![G::Point::default(); 300];
            points.iter_mut().for_each(|p| (0..G::D).for_each(|axis| p[axis] = rng.unit()));
            points
        };
        let (here, mut goals) = (random(), random());
        goals[200][G::D - 1] = f64::NAN;
        let vertices: Vec<_> = VertexId::range(0..300).collect();
        for algorithm in [Algorithm::PlacementFlips, Algorithm::Placement, Algorithm::Tolerance] {
            for movers in [Movers::All, Movers::Listed(&vertices)] {
                let options = Options { algorithm, ..Options::default() };
                let mut t = MovingTriangulation::<G>::new(&here, options).expect("room");
                // Staged goals count as checked.
                let refused = t.commit(&mut Moves::staged(&goals, movers)).expect_err("one is no number");
                assert!(matches!(refused, Error::NotFinite { index: 200, .. }), "{algorithm:?}: {refused:?}");
                assert!(vertices.iter().all(|&v| t.position(v) == Ok(here[v.index()])), "{algorithm:?}");
                assert_eq!((t.timestamp(), t.validate(Level::Delaunay)), (0, Ok(())), "{algorithm:?}");
            }
        }
    }

    /// Of many hidden vertices those alone are looked at that a vertex which moves, changes its weight, or comes may
    /// show; and what is told follows from these.
    fn few_hidden_vertices_are_looked_at<G: Moving>() {
        let rng = &mut Rng::new(3);
        let n = 3_000;
        let mut points = vec![G::Point::default(); n];
        for p in &mut points {
            (0..G::D).for_each(|axis| p[axis] = rng.unit());
            p[G::D] = 20.0 * (n as f64).powf(-2.0 / G::D as f64) * rng.unit();
        }
        for algorithm in [Algorithm::Auto, Algorithm::PlacementFlips, Algorithm::Tolerance] {
            let options = Options { algorithm, ..Options::default() };
            let mut t = MovingTriangulation::<G>::new(&points, options).expect("room");
            assert!(t.mesh.kernel.n_hidden() > n / 2);
            t.commit_timestamp().expect("room");
            for k in 0..40 {
                let (v, other) = (VertexId::at(rng.below(n)), points[rng.below(n)]);
                let mut goal = points[v];
                if k % 2 == 0 {
                    goal[0] += 1e-2 * rng.unit();
                } else {
                    goal[G::D] = other[G::D];
                }
                if k % 4 == 3 {
                    let mut coming = other;
                    coming[0] *= 1.01;
                    t.stage_insertions(&[coming]).expect("room");
                }
                t.move_vertices(&[v], &[goal]).expect("a good place");
                let mut staging = std::mem::take(&mut t.staging);
                let moves = &mut staging.moves(t.mesh.n_present);
                let mut report = CommitReport::default();
                t.mesh.know_hidden().expect("room");
                t.mesh.begin(Aim::Commit).expect("room");
                t.edit_and_advance(moves, &mut report).expect("room");
                t.loosen_moved(moves).expect("room");
                let n_loose = t.mesh.kernel.n_loose();
                assert!(n_loose < n / 4, "{algorithm:?}: {n_loose}");
                t.settle_hidden(&mut report).expect("room");
                let told = t.tell_hidden(moves, &mut report).expect("room");
                assert!(matches!(told, Told::Turned(_)), "{algorithm:?}");
                t.undo();
                t.staging = staging;
                t.commit_timestamp().expect("room");
                assert_eq!(t.validate(Level::Delaunay), Ok(()), "{algorithm:?}");
            }
        }
    }

    #[test]
    fn few_hidden_vertices_are_looked_at_in_the_plane() {
        few_hidden_vertices_are_looked_at::<PowerPlane>();
    }

    #[test]
    fn few_hidden_vertices_are_looked_at_in_space() {
        few_hidden_vertices_are_looked_at::<PowerSpace>();
    }

    #[test]
    fn goals_that_turn_bad_are_refused_in_the_plane() {
        goals_that_turn_bad_are_refused::<Plane>();
    }

    #[test]
    fn goals_that_turn_bad_are_refused_in_space() {
        goals_that_turn_bad_are_refused::<Space>();
    }
}
