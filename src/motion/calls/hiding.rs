//! What a change tells of vertices with weights: who is hidden, whose place and whose weight is another one.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::VertexId;
use crate::motion::options::CoincidencePolicy;
use crate::motion::report::CommitReport;
use crate::motion::state::goals::{Movers, Moves};
use crate::motion::state::mesh::HiddenNow;
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::PointArray;

/// How many vertices have another place, and how many another weight.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ChangedParts {
    pub(crate) moved: u64,
    pub(crate) reweighted: u64,
}

impl ChangedParts {
    /// Counts a vertex.
    #[inline(always)]
    pub(crate) fn count<P: AsRef<[f64]> + PointArray>(&mut self, was: &P, is: &P) {
        self.moved += u64::from(was.as_ref() != is.as_ref());
        self.reweighted += u64::from(was.weight() != is.weight());
    }

    /// Counts a vertex, which has another place as well if it comes there from another period.
    #[inline(always)]
    pub(crate) fn count_in_period<P: AsRef<[f64]> + PointArray>(&mut self, was: &P, is: &P, is_other: bool) {
        self.moved += u64::from(is_other || was.as_ref() != is.as_ref());
        self.reweighted += u64::from(was.weight() != is.weight());
    }

    /// Adds them to sums.
    #[inline(always)]
    pub(in crate::motion) fn add_to(&self, statistics: &mut CommitReport) {
        statistics.moved += self.moved;
        statistics.reweighted += self.reweighted;
    }
}

impl<G: Moving> MovingTriangulation<G> {
    /// What these moves are going to change, where there are weights.
    pub(in crate::motion) fn parts_to_change(&self, moves: &Moves<'_, G>) -> ChangedParts {
        let mut changed = ChangedParts::default();
        if !G::HAS_WEIGHTS {
            return changed;
        }
        let mesh = &self.mesh;
        let mut count = |v: VertexId| {
            let was = &mesh.kernel.site(mesh.site_of[v]).point;
            changed.count(was, &moves.unchecked()[v.index()]);
        };
        match moves.movers() {
            Movers::All => VertexId::range(0..moves.count()).for_each(count),
            Movers::Listed(vertices) => vertices.iter().for_each(|&v| count(v)),
        }
        changed
    }

    /// Tells places and weights apart, in a report and in the sums that it has been added to.
    #[inline(always)]
    pub(in crate::motion) fn tell_parts(&mut self, report: &mut CommitReport, changed: ChangedParts) {
        if G::HAS_WEIGHTS {
            self.statistics.moved -= report.moved;
            changed.add_to(&mut self.statistics);
            (report.moved, report.reweighted) = (changed.moved, changed.reweighted);
        }
    }

    /// Who is hidden now, where there are weights.
    pub(in crate::motion) fn hidden_now(&self) -> Result<HiddenNow> {
        self.mesh.hidden_in(&self.mesh.kernel, CoincidencePolicy::Merge)
    }

    /// Reports who is hidden, of vertices with weights, and who was not `before`; or refuses two of them at one place.
    pub(in crate::motion) fn tell_hidden(
        &mut self,
        before: &HiddenNow,
        report: &mut CommitReport,
    ) -> Result<()> {
        if !G::HAS_WEIGHTS {
            return Ok(());
        }
        let in_new = self.mesh.hidden_in_new.take().filter(|_| self.mesh.transaction.has_rebuilt());
        let now = match in_new {
            Some(now) => now,
            None => self.mesh.hidden_in(&self.mesh.kernel, self.options.coincidence)?,
        };
        for (_, is_hidden) in now.ids.differences(&before.ids).filter(|&(v, _)| self.mesh.is_present(v)) {
            *if is_hidden { &mut report.newly_hidden } else { &mut report.newly_shown } += 1;
        }
        (report.coincident, report.hidden_by_weight) = (now.by_place, now.by_weight);
        Ok(())
    }

    /// Enters who is hidden into the sums.
    #[inline(always)]
    pub(in crate::motion) fn note_hidden(&mut self, report: &CommitReport) {
        if G::HAS_WEIGHTS {
            self.statistics.coincident = report.coincident;
            self.statistics.hidden_by_weight = report.hidden_by_weight;
        }
    }

    /// Refuses two vertices with weights at one place after a change at once, if the options do; where it has built a new kernel
    /// they have been looked for before.
    pub(in crate::motion) fn reject_shared_places(&self) -> Result<()> {
        let is_done =
            self.options.coincidence == CoincidencePolicy::Merge || self.mesh.transaction.has_rebuilt();
        if !G::HAS_WEIGHTS || is_done {
            return Ok(());
        }
        self.mesh.hidden_in(&self.mesh.kernel, self.options.coincidence).map(drop)
    }
}
