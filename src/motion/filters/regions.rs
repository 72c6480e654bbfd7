//! Regions: what lets a vertex move without checking its certificates (report, sections 2.3, 2.4).
//!
//! | store | keeps |
//! |---|---|
//! | [`tolerance`](super::tolerance) | a tolerance for each vertex |
//! | [`safe_regions`](super::safe_regions) | a delimiter for each bi-cell, and tolerances |
//! | [`watching`](super::watching) | tolerances, and the bi-cells that would make them too small |
//! | [`slack`](super::slack) | a tolerance for each bi-cell |
//!
//! Each is a [`Store`]. One is kept at a time, and only while it is valid.
//!
//! Invariant of what is kept: the ball around the fixed position of each vertex, of its tolerance, is inside all its
//! safe regions, or, when watching, inside those of the bi-cells that are not watched.
//!
//! While cells change (a queue, an insertion, a removal) no regions are kept. They are again once
//! every bi-cell that has a new cell or a relocated vertex has been computed at the positions of that moment
//! ([`with_regions`]): the points of all other bi-cells have stayed, since they were last known to be on
//! their sides, or moved within their regions. Where most bi-cells are concerned all are computed, which
//! also makes good for tolerances that have only been lowered for long.
//!
//! [`with_regions`]: crate::motion::MovingTriangulation::with_regions

use crate::delaunay::{Delaunay, Moving};
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::filters::safe_regions::{Admission, SafeRegions};
use crate::motion::filters::slack::Slacks;
use crate::motion::filters::store::{Store, TimestampSteps};
use crate::motion::filters::tolerance::{Fixed, Tolerances};
use crate::motion::filters::watching::Watching;
use crate::motion::region_kind::RegionKind;

/// With more than this share of the cells changed, all bi-cells are computed again.
const MAX_SHARE_FOLLOWED: f64 = 1.0 / 3.0;

/// Regions that are valid.
#[derive(Debug)]
pub(in crate::motion) enum KeptRegions<G: Moving> {
    Tolerance(Tolerances<G>),
    SafeRegion(SafeRegions<G>),
    Watching(Watching<G>),
    Slack(Slacks<G>),
}

impl<G: Moving> KeptRegions<G> {
    /// Nothing yet of a kind.
    fn empty(kind: RegionKind) -> Self {
        match kind {
            RegionKind::Tolerance => KeptRegions::Tolerance(Tolerances::default()),
            RegionKind::SafeRegion => KeptRegions::SafeRegion(SafeRegions::new(false)),
            RegionKind::Both => KeptRegions::SafeRegion(SafeRegions::new(true)),
            RegionKind::Watch => KeptRegions::Watching(Watching::default()),
            RegionKind::Slack => KeptRegions::Slack(Slacks::default()),
        }
    }

    fn copied(&self) -> Result<Self> {
        Ok(match self {
            KeptRegions::Tolerance(store) => KeptRegions::Tolerance(store.copied()?),
            KeptRegions::SafeRegion(store) => KeptRegions::SafeRegion(store.copied()?),
            KeptRegions::Watching(store) => KeptRegions::Watching(store.copied()?),
            KeptRegions::Slack(store) => KeptRegions::Slack(store.copied()?),
        })
    }

    /// What they are of.
    #[inline(always)]
    fn kind(&self) -> RegionKind {
        match self {
            KeptRegions::Tolerance(_) => RegionKind::Tolerance,
            KeptRegions::SafeRegion(regions) if regions.tests_tolerance() => RegionKind::Both,
            KeptRegions::SafeRegion(_) => RegionKind::SafeRegion,
            KeptRegions::Watching(_) => RegionKind::Watch,
            KeptRegions::Slack(_) => RegionKind::Slack,
        }
    }

    fn store(&self) -> &dyn Store<G> {
        match self {
            KeptRegions::Tolerance(store) => store,
            KeptRegions::SafeRegion(store) => store,
            KeptRegions::Watching(store) => store,
            KeptRegions::Slack(store) => store,
        }
    }

    fn store_mut(&mut self) -> &mut dyn Store<G> {
        match self {
            KeptRegions::Tolerance(store) => store,
            KeptRegions::SafeRegion(store) => store,
            KeptRegions::Watching(store) => store,
            KeptRegions::Slack(store) => store,
        }
    }
}

/// The regions of one kind, if any are kept.
#[derive(Debug, Default)]
pub(in crate::motion) struct Regions<G: Moving> {
    kept: Option<Box<KeptRegions<G>>>,
    /// Regions that are no longer valid: their memory serves the next ones of that kind.
    spare: Option<Box<KeptRegions<G>>>,
    /// Regions that are valid, but not to be used: no vertex may move alone while a timestamp is prepared.
    withheld: Option<Box<KeptRegions<G>>>,
    /// The kernel's record of changed cells, or its memory.
    changed: Vec<Slot>,
    /// Vertices that have been relocated during the change under way.
    relocated: Vec<VertexId>,
}

impl<G: Moving> Regions<G> {
    /// A copy of what is kept.
    pub(in crate::motion) fn copied(&self) -> Result<Self> {
        let kept = self.kept.as_deref().map(|kept| memory::boxed(kept.copied()?)).transpose()?;
        Ok(Regions { kept, ..Regions::default() })
    }

    /// The kind of the regions that are kept.
    #[inline(always)]
    pub(in crate::motion) fn kept_for(&self) -> Option<RegionKind> {
        self.kept.as_deref().map(KeptRegions::kind)
    }

    /// The report's pre-computations, for a kind; returns the number of bi-cells computed. `steps` as for a
    /// [`Store`].
    pub(in crate::motion) fn prepare(
        &mut self,
        kind: RegionKind,
        kernel: &mut Delaunay<G>,
        n_ids: usize,
        steps: TimestampSteps<'_, G>,
    ) -> Result<u64> {
        self.invalidate();
        let spare = self.spare.take().filter(|spare| spare.kind() == kind);
        let mut kept = spare.map_or_else(|| memory::boxed(KeptRegions::empty(kind)), Ok)?;
        let n = kept.store_mut().prepare(kernel, n_ids, steps)?;
        self.kept = Some(kept);
        Ok(n)
    }

    /// The triangulation has changed without the regions.
    #[inline(always)]
    pub(in crate::motion) fn invalidate(&mut self) {
        if let Some(kept) = self.kept.take() {
            self.spare = Some(kept);
        }
    }

    /// Withholds what is kept, until it is [released](Self::release).
    pub(in crate::motion) fn withhold(&mut self) {
        self.withheld = self.kept.take();
    }

    /// What has been withheld is kept again.
    pub(in crate::motion) fn release(&mut self) {
        if let Some(kept) = self.withheld.take() {
            self.kept = Some(kept);
        }
    }

    /// Whether a vertex that has site `s` for itself certainly stays in its region when it moves to `p`.
    #[inline(always)]
    pub(in crate::motion) fn admit(
        &mut self,
        kernel: &mut Delaunay<G>,
        vertex: VertexId,
        s: SiteId,
        p: &G::Point,
    ) -> Option<Admission> {
        match self.kept.as_deref_mut() {
            Some(KeptRegions::Tolerance(tolerances)) => {
                tolerances.fixed()[vertex].holds(p).then_some(Admission::WithinTolerance)
            }
            Some(KeptRegions::SafeRegion(regions)) => regions.admit(kernel, vertex, s, p),
            // All vertices move, and their bi-cells are checked after that.
            Some(KeptRegions::Watching(_) | KeptRegions::Slack(_)) | None => None,
        }
    }

    /// Fixed positions and tolerances by vertex id: of all kinds but slack, which has none.
    #[inline(always)]
    pub(in crate::motion) fn fixed(&self) -> &[Fixed<G>] {
        match self.kept.as_deref() {
            Some(KeptRegions::Tolerance(tolerances)) => tolerances.fixed(),
            Some(KeptRegions::Watching(watching)) => watching.fixed(),
            Some(KeptRegions::SafeRegion(regions)) => regions.fixed(),
            Some(KeptRegions::Slack(_)) | None => &[],
        }
    }

    /// The store of the tolerance algorithm, if that is kept.
    #[inline(always)]
    pub(in crate::motion) fn tolerances(&self) -> Option<&Tolerances<G>> {
        if let Some(KeptRegions::Tolerance(tolerances)) = self.kept.as_deref() {
            Some(tolerances)
        } else {
            None
        }
    }

    /// The store of watching, if that is kept.
    pub(in crate::motion) fn watching(&mut self) -> Option<&mut Watching<G>> {
        if let Some(KeptRegions::Watching(watching)) = self.kept.as_deref_mut() {
            Some(watching)
        } else {
            None
        }
    }

    /// About how many bi-cells are watched.
    pub(in crate::motion) fn n_watched(&self) -> usize {
        if let Some(KeptRegions::Watching(watching)) = self.kept.as_deref() {
            watching.n_watched()
        } else {
            0
        }
    }

    /// The store of slack, if that is kept.
    pub(in crate::motion) fn slacks(&mut self) -> Option<&mut Slacks<G>> {
        if let Some(KeptRegions::Slack(slacks)) = self.kept.as_deref_mut() { Some(slacks) } else { None }
    }

    /// Makes the kernel's static filter as sharp as what the regions, if any are kept, may let pass allows.
    pub(in crate::motion) fn tighten_filter(&mut self, kernel: &mut Delaunay<G>) {
        if let Some(kept) = &mut self.kept {
            kept.store_mut().tighten_filter(kernel);
        } else {
            kernel.tighten_filter();
        }
    }

    /// A vertex has been relocated: all bi-cells of its site are among the changes.
    pub(in crate::motion) fn note_relocated(&mut self, vertex: VertexId) -> Result<()> {
        memory::push(&mut self.relocated, vertex)
    }

    /// Makes sure that a vertex can be [noted](Self::note_relocated) without a failure.
    pub(in crate::motion) fn make_room_to_note(&mut self) -> Result<()> {
        memory::reserve(&mut self.relocated, 1)
    }

    /// A change begins, during which no regions are kept. Returns those that can [follow](Self::follow) it, and
    /// memory for the record of cells that this takes.
    pub(in crate::motion) fn begin_change(&mut self) -> Option<(Box<KeptRegions<G>>, Vec<Slot>)> {
        self.relocated.clear();
        let kept = self.kept.take()?;
        Some((kept, std::mem::take(&mut self.changed)))
    }

    /// The vertices relocated during the change, which is over.
    pub(in crate::motion) fn end_change(&mut self) -> Vec<VertexId> {
        std::mem::take(&mut self.relocated)
    }

    /// Computes the bi-cells of all facets of the `changed` cells, and keeps the regions again; returns the number of
    /// bi-cells.
    pub(in crate::motion) fn follow(
        &mut self,
        mut kept: Box<KeptRegions<G>>,
        mut changed: Vec<Slot>,
        relocated: Vec<VertexId>,
        kernel: &mut Delaunay<G>,
        site_of: &[SiteId],
        steps: TimestampSteps<'_, G>,
    ) -> Result<u64> {
        let store = kept.store_mut();
        store.forget_cells(&changed);
        kernel.tidy_changes(&mut changed);
        let most = MAX_SHARE_FOLLOWED * kernel.complex().n_finite() as f64;
        let n = if changed.len() as f64 > most {
            store.prepare(kernel, site_of.len(), steps)
        } else {
            store.follow(kernel, site_of, steps, &changed, &relocated)
        }?;
        (self.changed, self.relocated) = (changed, relocated);
        self.kept = Some(kept);
        Ok(n)
    }

    /// What was kept when a change began cannot follow it.
    pub(in crate::motion) fn give_up(&mut self, kept: Box<KeptRegions<G>>) {
        self.spare = Some(kept);
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        let bytes_of =
            |kept| memory::bytes_of_made(kept, |kept: &KeptRegions<G>| kept.store().memory_bytes());
        bytes_of(&self.kept)
            + bytes_of(&self.spare)
            + bytes_of(&self.withheld)
            + memory::bytes_of(&self.changed)
            + memory::bytes_of(&self.relocated)
    }
}
