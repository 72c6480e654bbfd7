//! The vertices, the kernel that triangulates them, and what undoes a change of both.
//!
//! Vertices that share a place share a site; which of them is seen is in [`coincidence`]. A change is begun, and then
//! published or undone ([`changing`]). Whether a vertex is there, and seen, is asked in [`standing`]; with weights, who is hidden
//! in [`hidden_by_weight`].

mod changing;
mod coincidence;
mod hidden_by_weight;
mod known;
mod rounds;
mod standing;

use crate::delaunay::{Delaunay, Merge, Moving};
use crate::error::{Error, Result};
use crate::ids::SiteId;
use crate::machine::memory;
use crate::motion::constants::{Constants, TABLE};
use crate::motion::options::CoincidencePolicy;
use crate::motion::report::Evaluations;
use crate::motion::state::goals::Moves;
use crate::motion::state::hidden::Hidden;
use crate::motion::state::last_found::LastFound;
use crate::motion::state::rounds::Rounds;
use crate::motion::state::segments::Segments;
use crate::motion::state::transaction::Transaction;
use crate::motion::state::views::Views;
use crate::predicates::exact_calls;

pub(in crate::motion) use hidden_by_weight::HiddenNow;
pub(in crate::motion) use known::{KnownHidden, Told};
pub(in crate::motion) use standing::Standing;

/// Before the tolerances of all bi-cells are computed, cells are sorted again if this many times as many as there are
/// have been replaced: the computation takes several times as long as sorting, and less where cells are sorted.
pub(in crate::motion) const REPLACED_TO_SORT_FIRST: f64 = 0.5;

/// The vertices at their last timestamp, and their cells; or midway in a change.
#[derive(Debug)]
pub(in crate::motion) struct Mesh<G: Moving> {
    pub(in crate::motion) kernel: Delaunay<G>,
    /// Site of each id; [`SiteId::NONE`] once removed.
    pub(in crate::motion) site_of: Vec<SiteId>,
    pub(in crate::motion) hidden: Hidden,
    pub(in crate::motion) n_present: usize,
    /// Mean distance of sites from the next ones in freshly sorted storage: the measure of lost locality.
    pub(in crate::motion) sorted_stride: f64,
    pub(in crate::motion) transaction: Transaction<G>,
    pub(in crate::motion) views: Views<G>,
    /// Segments that have to be edges, once there was one.
    pub(in crate::motion) segments: Option<Box<Segments<G>>>,
    /// Who is hidden, of vertices with weights, in a new kernel that is in place: found before, as nothing may fail after.
    pub(in crate::motion) hidden_in_new: Option<HiddenNow>,
    /// Who is hidden, of vertices with weights, as long as that is known.
    pub(in crate::motion) known: Option<KnownHidden>,
    /// What the latest call has found to be in their way.
    pub(in crate::motion) last_found: LastFound,
    /// Changes that can still all be taken back, while a timestamp is being prepared.
    pub(in crate::motion) rounds: Option<Box<Rounds<G>>>,
    /// By what is decided between two ways to the same cells.
    pub(in crate::motion) constants: &'static Constants,
    /// Whether the program takes changes.
    pub(in crate::motion) takes_changes: bool,
    /// How many changes have been published that may have changed a place, a cell or a segment.
    pub(in crate::motion) n_changes: u64,
}

impl<G: Moving> Mesh<G> {
    /// A mesh of which nothing is known but the kernel, the site of each id, and which of the `n_present` vertices are
    /// hidden.
    #[inline(always)]
    pub(in crate::motion) fn of_parts(
        kernel: Delaunay<G>,
        site_of: Vec<SiteId>,
        hidden: Hidden,
        n_present: usize,
    ) -> Self {
        Mesh {
            kernel,
            site_of,
            hidden,
            n_present,
            sorted_stride: 0.0,
            transaction: Transaction::default(),
            views: Views::default(),
            segments: None,
            hidden_in_new: None,
            known: None,
            last_found: LastFound::default(),
            rounds: None,
            constants: TABLE.of::<G>(),
            takes_changes: false,
            n_changes: 0,
        }
    }

    /// A copy. Arrays of cells, if there are some, are brought up to date for it.
    pub(in crate::motion) fn copied(&self) -> Result<Self> {
        Ok(Mesh {
            kernel: self.kernel.copied()?,
            site_of: memory::copy_of(&self.site_of)?,
            hidden: self.hidden.copied()?,
            n_present: self.n_present,
            sorted_stride: self.sorted_stride,
            transaction: Transaction::default(),
            views: self.views.copied(&self.kernel)?,
            segments: match &self.segments {
                Some(segments) => Some(memory::boxed(segments.copied()?)?),
                None => None,
            },
            hidden_in_new: None,
            known: None,
            last_found: LastFound::default(),
            rounds: None,
            constants: self.constants,
            takes_changes: self.takes_changes,
            n_changes: self.n_changes,
        })
    }

    /// Whether these moves are of every vertex, and each has a site of its own: one loop can make them.
    pub(in crate::motion) fn moves_in_one_loop(&self, moves: &Moves<'_, G>) -> bool {
        moves.are_of_all() && self.hidden.count() == 0
    }

    /// Finds the site of each vertex.
    pub(in crate::motion) fn find_sites(&mut self) {
        let Self { kernel, hidden, site_of, .. } = self;
        for s in kernel.live_sites() {
            hidden.for_all_at(kernel.site(s).id, |v| site_of[v] = s);
        }
    }

    /// The trees of the vertices that a kernel hides, unless the policy rejects them.
    pub(in crate::motion) fn hide_merged(
        &self,
        kernel: &Delaunay<G>,
        merges: &[Merge],
        policy: CoincidencePolicy,
    ) -> Result<Hidden> {
        let hidden = Hidden::of_merges(kernel.keys(), merges, self.site_of.len(), |s| kernel.site(s).id)?;
        match hidden.first_pair(kernel.keys()) {
            Some((vertex, other)) if policy == CoincidencePolicy::Reject => {
                Err(Error::Coincident { vertex, other })
            }
            _ => Ok(hidden),
        }
    }

    /// Puts the cells in the order of the sites, and the arrays follow. Sorted cells stay as they are until `replaced`
    /// times as many as there are have been replaced, and where rounds may be taken back or a change has recorded cells: both name
    /// slots.
    pub(in crate::motion) fn sort_cells(&mut self, replaced: f64) -> Result<()> {
        if self.rounds.is_some() || !self.kernel.complex().rows().is_empty() {
            return Ok(());
        }
        if let Some(index) = self.kernel.sort_cells(replaced)? {
            self.views.renumber_slots(&index);
            if let Some(segments) = &mut self.segments {
                segments.renumber_slots(&index);
            }
        }
        Ok(())
    }

    /// What has been evaluated so far.
    pub(in crate::motion) fn evaluations(&self) -> Evaluations {
        Evaluations {
            certificates: self.kernel.certificates(),
            exact: exact_calls(),
            link_sites: self.kernel.link_sites(),
        }
    }

    /// Tells the monitor how far the work is; whether to go on.
    pub(in crate::motion) fn monitor(&mut self, fraction: f64) -> bool {
        self.kernel.pace_mut().ask(fraction)
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        self.kernel.memory_bytes()
            + memory::bytes_of(&self.site_of)
            + self.hidden.memory_bytes()
            + self.transaction.memory_bytes()
            + self.views.memory_bytes()
            + self.segments.as_ref().map_or(0, |segments| segments.memory_bytes())
            + self.last_found.memory_bytes()
            + self.known.as_ref().map_or(0, KnownHidden::memory_bytes)
            + memory::bytes_of_made(&self.rounds, Rounds::memory_bytes)
    }
}
