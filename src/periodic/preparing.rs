//! Commits in two phases: a timestamp is prepared, in one round or several, and then published or withdrawn.
//!
//! A round is a commit whose rounds inside stay open, with a savepoint before the first of them: one that fails goes
//! back to its savepoint, and all are published or withdrawn together. What was before them, beside the triangulation
//! inside, is in [`RoundBefore`].

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::machine::memory;
use crate::motion::CommitReport;
use crate::periodic::commit::PeriodicGoals;
use crate::periodic::rounds::{BeforeRounds, RoundBefore};
use crate::periodic::triangulation::PeriodicTriangulation;

impl<G: Moving> PeriodicTriangulation<G> {
    /// Brings the triangulation to what is staged, as a commit does, and keeps what it was: all that reads sees the prepared
    /// state, which [`publish_timestamp`](Self::publish_timestamp) makes the next timestamp, and
    /// [`withdraw_timestamp`](Self::withdraw_timestamp) takes back. More may be staged then, and prepared in another round
    /// of the same timestamp. On an error the rounds before are in force, and what is staged stays so.
    ///
    /// The report is of this round; its timestamp is the one that is prepared. Statistics count the round.
    ///
    /// Cost: that of a commit.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::Options, periodic::PeriodicTriangulation};
    ///
    /// let square = [[1.0, 0.0], [0.0, 1.0]];
    /// let mut t = PeriodicTriangulation::<Plane>::new(&[[0.25, 0.25]], &square, Options::default())?;
    /// t.stage_insertions(&[[0.5, 0.75]])?;
    /// t.prepare_timestamp()?;
    /// assert_eq!((t.cell_count()?, t.timestamp()), (4, 0));
    /// t.withdraw_timestamp();
    /// assert_eq!((t.cell_count()?, t.timestamp()), (2, 0));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`commit_timestamp`](Self::commit_timestamp), [`Error::OutOfMemory`] among them.
    pub fn prepare_timestamp(&mut self) -> Result<CommitReport> {
        let (statistics, mut rounds) = (self.statistics, Vec::new());
        memory::reserve(self.former.as_mut().map_or(&mut rounds, |former| &mut former.rounds), 1)?;
        let (report, round) = self.make_round(PeriodicGoals::Staged)?;
        let (cells, edges) = (std::mem::take(&mut self.cells), std::mem::take(&mut self.edges));
        let former = self.former.get_or_insert_with(|| BeforeRounds { statistics, cells, edges, rounds });
        former.rounds.push(round);
        Ok(report)
    }

    /// Makes the prepared state the next timestamp, which it returns. What has been staged since the last round stays so.
    ///
    /// # Errors
    /// [`Error::NotPrepared`].
    pub fn publish_timestamp(&mut self) -> Result<u64> {
        let former = self.former.take().ok_or(Error::NotPrepared)?;
        self.inside.publish(former.rounds);
        self.statistics.timestamp += 1;
        Ok(self.statistics.timestamp)
    }

    /// Takes back all rounds of the prepared state: all is as at the last timestamp, with nothing staged. Does nothing if no
    /// timestamp is prepared. Needs no memory.
    ///
    /// Tolerances are forgotten, so the next commits may take longer.
    pub fn withdraw_timestamp(&mut self) {
        let Some(former) = self.former.take() else { return };
        let BeforeRounds { statistics, cells, edges, rounds } = former;
        rounds.into_iter().rev().for_each(|round| self.put_back(round));
        self.inside.t.withdraw_timestamp();
        (self.statistics, self.cells, self.edges) = (statistics, cells, edges);
        self.discard_moves();
    }

    /// Puts what there was before the last round back, but for the rounds inside. Needs no memory.
    fn put_back(&mut self, round: RoundBefore<G>) {
        let lattice = match round {
            RoundBefore::Built { inside, wraps, lattice } => {
                let mut other = std::mem::replace(&mut self.inside, *inside);
                self.inside.t.exchange_monitors(&mut other.t);
                self.inside.t.set_algorithm(other.t.algorithm());
                self.wraps = wraps;
                lattice
            }
            RoundBefore::Moved(mut moved) => {
                self.inside.put_back(&mut moved);
                self.wraps.truncate(self.inside.images.n_vertices());
                moved.exchange_wraps(&mut self.wraps);
                moved.other.map(|(lattice, _)| lattice)
            }
        };
        if let Some(lattice) = lattice {
            self.lattice = lattice;
        }
    }
}
