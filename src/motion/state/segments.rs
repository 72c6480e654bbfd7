//! Segments between vertices, which have to be edges, and what becomes of them in a change.
//!
//! ```text
//! relax: the cells that segments have taken the place of are put back
//! the vertices move, come and go, in the Delaunay triangulation
//! enforce: all segments that are missing are looked along, and then entered
//! ```
//!
//! What is in the way of a segment is a *conflict*. If there is any, the change is undone; all are told.
//!
//! Invariant between changes: the cells are the constrained Delaunay triangulation of sites and segments, and
//! `replaced` holds those of the Delaunay triangulation that are not among them.

mod listed;
mod rounds;

use crate::delaunay::{Crossing, Delaunay, InTheWay, Moving, Replaced};
use crate::error::{Conflict, Error, Result};
use crate::ids::{SegmentId, SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::state::last_found::{LastFound, refuse_conflicts};

pub(in crate::motion) use rounds::{KeptSegments, SegmentsBefore};

/// What stands for the label of a side of a segment that has none.
pub const NO_LABEL: i32 = i32::MIN;

/// How many ids of segments there are: all numbers but that of [`SegmentId::NONE`].
pub(in crate::motion) const MAX_SEGMENTS: usize = u32::MAX as usize;

/// A segment between two vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Segment {
    /// Its ends.
    pub ends: [VertexId; 2],
    /// What the program knows it by: any number.
    pub marker: i32,
    /// The labels of the regions on its left and on its right, as seen from its first end along it; [`NO_LABEL`] for none.
    pub sides: [i32; 2],
}

impl Segment {
    /// Between no vertices.
    pub(in crate::motion) const NOTHING: Self =
        Segment { ends: [VertexId::NONE; 2], marker: 0, sides: [NO_LABEL; 2] };

    /// Whether a side has a label.
    pub(in crate::motion) fn has_labels(&self) -> bool {
        self.sides != [NO_LABEL; 2]
    }
}

impl Default for Segment {
    fn default() -> Self {
        Segment::NOTHING
    }
}

/// What a change is made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum Aim {
    /// What is staged takes effect.
    Commit,
    /// As a commit, but nothing stays: it is cancelled when all conflicts are known.
    Check,
    /// What is staged still waits.
    Other,
    /// Nothing will change: neither a vertex moves nor is an edit or a segment staged.
    Rest,
}

impl Aim {
    /// Whether staged segments are enforced.
    fn takes_staged(self) -> bool {
        matches!(self, Aim::Commit | Aim::Check)
    }
}

/// The segments of a mesh.
#[derive(Debug)]
pub(in crate::motion) struct Segments<G: Moving> {
    /// The segments in force, ascending: refinement gives ids for ever, so there is no array by id. There is room for all
    /// staged ones.
    enforced: Vec<(SegmentId, Segment)>,
    /// How many ids have been given to those that are, or were, in force.
    n_enforced: usize,
    /// The staged segments, whose ids follow; `None` for those that pieces are staged for.
    staged: Vec<Option<Segment>>,
    /// The segments that the next commit removes.
    leaving: Vec<SegmentId>,
    replaced: Replaced<G>,
    /// What will be `replaced` after the change.
    next: Replaced<G>,
    crossing: Crossing,
    /// The sites of the ends of each segment, the lower one first, with its id; sorted.
    edges: Vec<([SiteId; 2], SegmentId)>,
    /// The edges that a kernel had to have before the change, while it has others.
    before: Option<Vec<[SiteId; 2]>>,
    /// By site: whether it is an end of one of `edges`.
    is_end: Vec<bool>,
    /// A cell that each of `edges` was seen at last.
    seen: Vec<Slot>,
    /// The entries of `edges` that are no edges before segments are enforced.
    missing: Vec<usize>,
    aim: Aim,
    /// Whether a check has found that there are no conflicts.
    is_checked: bool,
}

impl<G: Moving> Default for Segments<G> {
    fn default() -> Self {
        Segments {
            enforced: Vec::new(),
            n_enforced: 0,
            staged: Vec::new(),
            leaving: Vec::new(),
            replaced: Replaced::default(),
            next: Replaced::default(),
            crossing: Crossing::default(),
            edges: Vec::new(),
            before: None,
            is_end: Vec::new(),
            seen: Vec::new(),
            missing: Vec::new(),
            aim: Aim::Other,
            is_checked: false,
        }
    }
}

/// Two sites, the lower one first.
fn ordered([s, t]: [SiteId; 2]) -> [SiteId; 2] {
    if s < t { [s, t] } else { [t, s] }
}

/// Whether an edge has to be there. `is_end`: whether a site is an end of a segment.
fn has_to_be(edges: &[([SiteId; 2], SegmentId)], is_end: &[bool], edge: [SiteId; 2]) -> bool {
    edge.iter().all(|s| is_end.get(s.index()) == Some(&true)) && !at_edge(edges, edge).is_empty()
}

/// The segments that have to be at an edge.
fn at_edge(edges: &[([SiteId; 2], SegmentId)], edge: [SiteId; 2]) -> &[([SiteId; 2], SegmentId)] {
    let edge = ordered(edge);
    let first = edges.partition_point(|&(other, _)| other < edge);
    let n = edges[first..].iter().take_while(|&&(other, _)| other == edge).count();
    &edges[first..first + n]
}

impl<G: Moving> Segments<G> {
    /// A kernel has cells that were saved with these segments: it has to have them, and to be told what cells they have
    /// taken the place of. `site_of` is by vertex id.
    pub(in crate::motion) fn join(&mut self, kernel: &mut Delaunay<G>, site_of: &[SiteId]) -> Result<()> {
        self.aim = Aim::Other;
        let mut conflicts = Vec::new();
        self.list_edges(site_of, &mut conflicts)?;
        let mut required = self.required()?;
        kernel.exchange_required(&mut required);
        if kernel.has_cells() {
            self.replaced = kernel.find_replaced()?;
        } else {
            self.look_along_line(kernel, &mut conflicts)?;
        }
        refuse_conflicts(&mut conflicts)
    }

    /// Whether some cell is not of the Delaunay triangulation.
    pub(in crate::motion) fn have_replaced_cells(&self) -> bool {
        !self.replaced.is_empty()
    }

    /// What the change is made for.
    pub(in crate::motion) fn aim(&self) -> Aim {
        self.aim
    }

    /// Whether the change was a check that has found no conflicts.
    pub(in crate::motion) fn is_checked(&self) -> bool {
        self.is_checked
    }

    /// A change begins: puts back the cells that segments have taken the place of.
    pub(in crate::motion) fn relax(&mut self, kernel: &mut Delaunay<G>, aim: Aim) -> Result<()> {
        self.next.clear();
        (self.aim, self.is_checked) = (aim, false);
        if aim == Aim::Rest { Ok(()) } else { kernel.put_back_replaced(&self.replaced) }
    }

    /// Whether nothing that a segment depends on has changed, where no row of the kernel's cells has, and no vertex has
    /// another site.
    pub(in crate::motion) fn are_at_rest(&self) -> bool {
        self.replaced.is_empty() && !(self.aim.takes_staged() && self.are_staged())
    }

    /// Enters the segments that are missing in the Delaunay triangulation of a kernel: those in force, or, in a commit,
    /// those that will be. `site_of` is by vertex id.
    pub(in crate::motion) fn enforce(
        &mut self,
        kernel: &mut Delaunay<G>,
        site_of: &[SiteId],
        last_found: &mut LastFound,
    ) -> Result<()> {
        self.next.clear();
        let conflicts = last_found.conflicts_to_fill();
        let is_new = !self.are_listed(site_of);
        if is_new {
            self.list_edges(site_of, conflicts)?;
        }
        if kernel.has_cells() {
            let looked = self.look_along(kernel, conflicts);
            kernel.end_looking(&self.next);
            looked?;
            if !conflicts.is_empty() || !self.enter(kernel)? {
                self.cross_missing(kernel, conflicts)?;
            }
        } else {
            self.look_along_line(kernel, conflicts)?;
        }
        if is_new {
            let mut required = self.required()?;
            kernel.exchange_required(&mut required);
            self.before = Some(required);
        }
        refuse_conflicts(conflicts)?;
        if self.aim == Aim::Check {
            self.is_checked = true;
            return Err(Error::Cancelled);
        }
        Ok(())
    }

    /// Enters the segments that are missing in a new kernel, which takes the place of the old one if nothing conflicts.
    pub(in crate::motion) fn enforce_in_new(
        &mut self,
        kernel: &mut Delaunay<G>,
        site_of: &[SiteId],
        last_found: &mut LastFound,
    ) -> Result<()> {
        // A new kernel has none yet.
        self.edges.clear();
        let enforced = self.enforce(kernel, site_of, last_found);
        self.before = None;
        enforced
    }

    /// Whether the list of edges is still the right one.
    fn are_listed(&self, site_of: &[SiteId]) -> bool {
        let is_right = |&(edge, id): &([SiteId; 2], SegmentId)| {
            self.enforced_or_staged(id)
                .is_some_and(|segment| ordered(segment.ends.map(|v| site_of[v.index()])) == edge)
        };
        !(self.aim.takes_staged() && self.are_staged())
            && self.edges.len() == self.enforced.len()
            && self.edges.iter().all(is_right)
    }

    /// Lists the edges that have to be there, and the conflicts of ends alone.
    fn list_edges(&mut self, site_of: &[SiteId], conflicts: &mut Vec<Conflict>) -> Result<()> {
        let Segments { enforced, n_enforced, staged, leaving, edges, is_end, seen, .. } = self;
        let takes_staged = self.aim.takes_staged();
        edges.clear();
        let staged = if takes_staged { &staged[..] } else { &[] };
        memory::reserve(edges, enforced.len() + staged.len())?;
        let ids = SegmentId::range(*n_enforced..*n_enforced + staged.len());
        let coming = ids.zip(staged).filter_map(|(id, &segment)| Some((id, segment?)));
        for (id, segment) in enforced.iter().copied().chain(coming) {
            if takes_staged && leaving.binary_search(&id).is_ok() {
                continue;
            }
            // An end that was removed before a compaction has no id any more.
            let sites = segment.ends.map(|v| site_of.get(v.index()).copied().unwrap_or(SiteId::NONE));
            if sites.contains(&SiteId::NONE) {
                for k in (0..2).filter(|&k| sites[k] == SiteId::NONE) {
                    memory::push(conflicts, Conflict::EndRemoved { segment: id, vertex: segment.ends[k] })?;
                }
            } else if sites[0] == sites[1] {
                memory::push(conflicts, Conflict::EndsMeet { segment: id })?;
            } else {
                edges.push((ordered(sites), id));
            }
        }
        edges.sort_unstable();
        is_end.clear();
        let n_sites = edges.iter().map(|(edge, _)| edge[1].index() + 1).max().unwrap_or(0);
        memory::lengthen(is_end, n_sites, false)?;
        edges.iter().flat_map(|(edge, _)| edge).for_each(|s| is_end[s.index()] = true);
        seen.clear();
        memory::lengthen(seen, edges.len(), Slot::NONE)
    }

    /// Looks along all segments that are missing.
    fn look_along(&mut self, kernel: &mut Delaunay<G>, conflicts: &mut Vec<Conflict>) -> Result<()> {
        let Segments { edges, is_end, seen, next, crossing, missing, .. } = self;
        let (edges, is_end) = (&*edges, &*is_end);
        missing.clear();
        for k in 0..edges.len() {
            let (edge, id) = edges[k];
            let is_told = k > 0 && edges[k - 1].0 == edge;
            if is_told && missing.last().is_none_or(|&m| edges[m].0 != edge) {
                continue;
            }
            if !is_told {
                if !kernel.has_edge(seen[k], edge) {
                    seen[k] = kernel.find_edge(edge)?;
                }
                if seen[k] != Slot::NONE {
                    continue;
                }
            }
            memory::push(missing, k)?;
            kernel.look_along(
                edge,
                |other| has_to_be(edges, is_end, other),
                crossing,
                next,
                |found| match found {
                    InTheWay::Site(vertex) => {
                        memory::push(conflicts, Conflict::OnSegment { segment: id, vertex })
                    }
                    InTheWay::Edge(other) => at_edge(edges, other)
                        .iter()
                        .try_for_each(|&(_, other)| memory::push(conflicts, Conflict::crossing(id, other))),
                },
            )?;
        }
        Ok(())
    }

    /// Enters all segments that are missing, and of which nothing that is there is in the way. Returns whether none of
    /// them crosses another.
    fn enter(&mut self, kernel: &mut Delaunay<G>) -> Result<bool> {
        let Segments { edges, is_end, crossing, missing, .. } = self;
        let (edges, is_end) = (&*edges, &*is_end);
        for (i, &k) in missing.iter().enumerate() {
            let edge = edges[k].0;
            let is_entered = i > 0 && edges[missing[i - 1]].0 == edge;
            if is_entered || kernel.find_edge(edge)? != Slot::NONE {
                continue;
            }
            if !kernel.enter_segment(edge, |other| has_to_be(edges, is_end, other), crossing)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Finds all pairs of missing segments that cross: by a sweep over their ranges along the first axis.
    fn cross_missing(&mut self, kernel: &Delaunay<G>, conflicts: &mut Vec<Conflict>) -> Result<()> {
        let Segments { edges, missing, .. } = self;
        let range = |k: usize| {
            let [p, q] = edges[k].0.map(|s| kernel.site(s).point[0]);
            [p.min(q), p.max(q)]
        };
        missing.sort_unstable_by(|&j, &k| range(j)[0].total_cmp(&range(k)[0]));
        let mut open: Vec<usize> = Vec::new();
        for &k in &*missing {
            let [from, _] = range(k);
            open.retain(|&j| range(j)[1] >= from);
            for &j in &open {
                if kernel.do_cross(edges[j].0, edges[k].0) {
                    memory::push(conflicts, Conflict::crossing(edges[j].1, edges[k].1))?;
                }
            }
            memory::push(&mut open, k)?;
        }
        Ok(())
    }

    /// Finds the vertices on segments while all are on one line.
    fn look_along_line(&self, kernel: &Delaunay<G>, conflicts: &mut Vec<Conflict>) -> Result<()> {
        for &([s, t], segment) in &self.edges {
            let [p, q] = [s, t].map(|s| kernel.site(s).point);
            let axis = if p[0] == q[0] { 1 } else { 0 };
            let (low, high) = (p[axis].min(q[axis]), p[axis].max(q[axis]));
            for other in kernel.live_sites() {
                let site = kernel.site(other);
                if low < site.point[axis] && site.point[axis] < high {
                    memory::push(conflicts, Conflict::OnSegment { segment, vertex: site.id })?;
                }
            }
        }
        Ok(())
    }

    /// The change does not stay: the kernel of before has to have the edges that it had.
    pub(in crate::motion) fn undo(&mut self, kernel: &mut Delaunay<G>) {
        if let Some(mut before) = self.before.take() {
            kernel.exchange_required(&mut before);
        }
        // What is in `edges` is of the change.
        self.edges.clear();
        kernel.set_constrained(!self.replaced.is_empty());
    }

    /// The change stays.
    pub(in crate::motion) fn keep(&mut self) {
        self.before = None;
        if self.aim != Aim::Rest {
            std::mem::swap(&mut self.replaced, &mut self.next);
            self.next.clear();
        }
    }

    /// The cells have other slots now, by their old ones.
    pub(in crate::motion) fn renumber_slots(&mut self, index: &[Slot]) {
        self.replaced.renumber_slots(index);
    }

    /// A copy where vertices have other ids and the kernel is a copy with other sites and slots: it gets the edges that
    /// have to be there. `site_of` is by the new ids.
    pub(in crate::motion) fn renumbered(
        &self,
        kernel: &mut Delaunay<G>,
        ids: &[VertexId],
        site_of: &[SiteId],
    ) -> Result<Self> {
        let mut copy = self.copied()?;
        let enforced = copy.enforced.iter_mut().map(|(_, segment)| segment);
        for segment in enforced.chain(copy.staged.iter_mut().flatten()) {
            // An end of a staged one may have been removed before an earlier compaction.
            segment.ends = segment.ends.map(|v| if v == VertexId::NONE { v } else { ids[v.index()] });
        }
        copy.replaced = Replaced::default();
        copy.list_edges(site_of, &mut Vec::new())?;
        let mut required = copy.required()?;
        kernel.exchange_required(&mut required);
        copy.replaced = kernel.find_replaced()?;
        Ok(copy)
    }

    /// The edges that have to be there, each once.
    fn required(&self) -> Result<Vec<[SiteId; 2]>> {
        let mut required = Vec::new();
        memory::collect(&mut required, self.edges.iter().map(|&(edge, _)| edge))?;
        required.dedup();
        Ok(required)
    }

    /// The cells of a kernel that segments have taken the place of, to be put back in a copy of it.
    pub(in crate::motion) fn replaced(&self) -> &Replaced<G> {
        &self.replaced
    }

    pub(in crate::motion) fn copied(&self) -> Result<Self> {
        let mut enforced = Vec::new();
        memory::reserve_exact(&mut enforced, self.enforced.len() + self.staged.len())?;
        enforced.extend_from_slice(&self.enforced);
        Ok(Segments {
            enforced,
            n_enforced: self.n_enforced,
            staged: memory::copy_of(&self.staged)?,
            leaving: memory::copy_of(&self.leaving)?,
            replaced: self.replaced.copied()?,
            ..Segments::default()
        })
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.enforced)
            + memory::bytes_of(&self.staged)
            + memory::bytes_of(&self.leaving)
            + self.replaced.memory_bytes()
            + self.next.memory_bytes()
            + self.crossing.memory_bytes()
            + memory::bytes_of(&self.edges)
            + memory::bytes_of(&self.is_end)
            + memory::bytes_of(&self.seen)
            + memory::bytes_of(&self.missing)
    }
}
