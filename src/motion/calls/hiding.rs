//! What a change tells of vertices with weights: who is hidden, whose place and whose weight is another one.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::algorithms::{Algorithm, Commits};
use crate::motion::options::CoincidencePolicy;
use crate::motion::report::CommitReport;
use crate::motion::state::goals::{Movers, Moves};
use crate::motion::state::mesh::{KnownHidden, Mesh, Told};
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

/// Vertices that have changed are looked at one by one if there are so many times as many in all; else all that are
/// hidden are.
const ALL_PER_FEW: usize = 16;

impl<G: Moving> Mesh<G> {
    /// Whether so few vertices have changed that it takes less to look around each than at all hidden ones.
    fn are_few_beside_all(&self, n: usize) -> bool {
        n.saturating_mul(ALL_PER_FEW) <= self.n_present
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

    /// Reports who is hidden, of vertices with weights, and who was not before; or refuses two of them at one place.
    /// Who was hidden [has been found out](Mesh::know_hidden).
    pub(in crate::motion) fn tell_hidden(
        &mut self,
        moves: &Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<Told> {
        if !G::HAS_WEIGHTS {
            return Ok(Told::Nothing);
        }
        let in_new = self.mesh.hidden_in_new.take().filter(|_| self.mesh.transaction.has_rebuilt());
        let told = match in_new {
            Some(now) => Told::Anew(now),
            None => match self.turned_alone(moves)? {
                Some(turned) => Told::Turned(turned),
                None => Told::Anew(self.mesh.hidden_in(&self.mesh.kernel, self.options.coincidence)?),
            },
        };
        let before = self.mesh.known.as_ref().expect("it was found out before the change").ids();
        let mut count = |vertex: VertexId, was_hidden: bool, is_hidden: bool| match (was_hidden, is_hidden) {
            _ if !self.mesh.is_present(vertex) => {}
            (false, true) => report.newly_hidden += 1,
            (true, false) => report.newly_shown += 1,
            _ => {}
        };
        (report.coincident, report.hidden_by_weight) = match &told {
            Told::Anew(now) => {
                now.ids.differences(before).for_each(|(v, is_hidden)| count(v, !is_hidden, is_hidden));
                (now.by_place, now.by_weight)
            }
            Told::Turned(vertices) => {
                vertices.iter().for_each(|&(v, is_hidden)| count(v, before.has(v), is_hidden));
                (0, self.mesh.kernel.n_hidden() as u64)
            }
            Told::Nothing => (0, 0),
        };
        Ok(told)
    }

    /// The vertices that a commit may have hidden or shown, each with whether it is hidden, if it has moved and
    /// inserted few vertices, and neither these nor others share their places; there is room to
    /// [follow](Mesh::follow_told) them.
    fn turned_alone(&mut self, moves: &Moves<'_, G>) -> Result<Option<Vec<(VertexId, bool)>>> {
        let Self { mesh, edits, .. } = self;
        let Movers::Listed(movers) = moves.movers() else { return Ok(None) };
        let are_known = mesh.known.as_ref().is_some_and(KnownHidden::has_no_shared_place)
            && mesh.kernel.has_cells()
            && mesh.kernel.turned().is_some();
        if !are_known || !mesh.are_few_beside_all(movers.len() + edits.insertions().len()) {
            return Ok(None);
        }
        let inserted = edits.insertions().iter().map(|&(v, _)| v);
        for v in movers.iter().copied().chain(inserted) {
            if !mesh.kernel.is_alone(mesh.site_of[v])? {
                return Ok(None);
            }
        }
        if let Some(known) = &mut mesh.known {
            known.make_room(mesh.site_of.len())?;
        }
        let mut turned = Vec::new();
        memory::collect(&mut turned, mesh.kernel.turned().into_iter().flatten().copied())?;
        turned.sort_unstable();
        turned.dedup();
        let mut told = Vec::new();
        memory::collect(&mut told, turned.iter().map(|&v| (v, mesh.is_hidden(v))))?;
        Ok(Some(told))
    }

    /// Loosens the hidden vertices that may come back as vertices have moved: where few have been taken one by one,
    /// those above the cells around them, as what is above cells that have been removed is loose already; all of them
    /// where others have moved.
    pub(in crate::motion) fn loosen_moved(&mut self, moves: &Moves<'_, G>) -> Result<()> {
        let mesh = &mut self.mesh;
        // A new kernel has been built with all of them.
        if !G::HAS_WEIGHTS || mesh.transaction.has_rebuilt() || moves.count() == 0 {
            return Ok(());
        }
        let are_one_by_one = match self.options.algorithm {
            Algorithm::Auto => mesh.constants.are_few(moves.count(), mesh.n_present),
            algorithm => algorithm.row().commits != Commits::Together,
        };
        match moves.movers() {
            Movers::Listed(movers) if are_one_by_one && mesh.are_few_beside_all(movers.len()) => {
                movers.iter().try_for_each(|&v| mesh.kernel.loosen_around(mesh.site_of[v]))
            }
            _ => {
                mesh.kernel.loosen_all();
                Ok(())
            }
        }
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
