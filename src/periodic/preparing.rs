//! Commits in two phases: a timestamp is prepared, in one round or several, and then published or withdrawn.
//!
//! The rounds are commits of a copy. What was before the first one is kept as it is: to withdraw, it takes its place again, so
//! nothing has to be undone. A copy costs less than twice what a commit by which all vertices move costs.

use crate::delaunay::Dimension;
use crate::error::{Error, Result};
use crate::machine::memory;
use crate::motion::CommitReport;
use crate::periodic::triangulation::{Former, PeriodicTriangulation};

impl<G: Dimension> PeriodicTriangulation<G> {
    /// Brings the triangulation to what is staged, as a commit does, and keeps what it was: all that reads sees the prepared
    /// state, which [`publish_timestamp`](Self::publish_timestamp) makes the next timestamp, and
    /// [`withdraw_timestamp`](Self::withdraw_timestamp) takes back. More may be staged then, and prepared in another round
    /// of the same timestamp. On an error the rounds before are in force, and what is staged stays so.
    ///
    /// The report is of this round; its timestamp is the one that is prepared. Statistics count the round.
    ///
    /// Cost: that of a commit, and in the first round that of a [copy](Self::try_clone).
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
    /// Those of [`commit_timestamp`](Self::commit_timestamp), [`Error::OutOfMemory`] among them.
    pub fn prepare_timestamp(&mut self) -> Result<CommitReport> {
        if self.former.is_none() {
            self.set_aside()?;
        }
        let done = self.commit_staged();
        let Some(former) = &mut self.former else { return done };
        match &done {
            Ok(_) => {
                former.rounds += 1;
                // The timestamp is not reached before it is published.
                self.statistics.timestamp -= 1;
            }
            Err(_) if former.rounds == 0 => self.put_back(),
            Err(_) => {}
        }
        done
    }

    /// Makes the prepared state the next timestamp, which it returns. What has been staged since the last round stays so.
    ///
    /// # Errors
    /// [`Error::NotPrepared`].
    pub fn publish_timestamp(&mut self) -> Result<u64> {
        self.former.take().ok_or(Error::NotPrepared)?;
        self.statistics.timestamp += 1;
        Ok(self.statistics.timestamp)
    }

    /// Takes back all rounds of the prepared state: all is as at the last timestamp, with nothing staged. Does nothing if no
    /// timestamp is prepared. Needs no memory.
    pub fn withdraw_timestamp(&mut self) {
        if self.former.is_some() {
            let algorithm = self.algorithm();
            self.put_back();
            self.set_algorithm(algorithm);
            self.discard_moves();
        }
    }

    /// Keeps what there is, and goes on with a copy of it.
    fn set_aside(&mut self) -> Result<()> {
        let taking = self.taking.take();
        let copy = self.try_clone(None).and_then(memory::boxed);
        self.taking = taking;
        let mut other = copy?;
        std::mem::swap(self, &mut other);
        self.exchange_callers(&mut other);
        self.former = Some(Former { t: other, rounds: 0 });
        Ok(())
    }

    /// What was kept takes its place again, with what was staged then.
    fn put_back(&mut self) {
        let Some(Former { mut t, .. }) = self.former.take() else { return };
        self.exchange_callers(&mut t);
        std::mem::swap(self, &mut t);
    }

    /// Exchanges what belongs to the program's side: its callback, and which cells it knows.
    fn exchange_callers(&mut self, other: &mut Self) {
        self.inside.t.exchange_monitors(&mut other.inside.t);
        std::mem::swap(&mut self.taking, &mut other.taking);
    }
}
