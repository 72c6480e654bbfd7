//! One change of the triangulation, made or undone.
//!
//! ```text
//! begin
//! change: note what is about to change, then change it
//! if that failed: undo
//! else: publish
//! ```
//!
//! What is kept for undoing: the rows of cells and the sites that were removed, added or renamed
//! ([`Delaunay::begin`](crate::delaunay::Delaunay::begin)), the site of each vertex that came to or left a place, and
//! with whom, and where the vertices were that have moved ([`origins`](crate::motion::state::origins)). A rebuilding
//! makes a new kernel beside the old one, which stays as it is until that is complete.
//!
//! Memory is reserved before a change, so [`undo`](Mesh::undo) needs none, and cannot fail.

use crate::delaunay::{Delaunay, Moving};
use crate::error::Result;
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;
use crate::motion::state::hidden::Hidden;
use crate::motion::state::mesh::Mesh;
use crate::motion::state::rounds::Round;
use crate::motion::state::segments::Aim;
use crate::motion::state::transaction::{Counts, Event, VertexBefore};

/// After a repair, cells are sorted again if this many times as many as there are have been replaced.
const REPLACED_TO_SORT: f64 = 2.0;

impl<G: Moving> Mesh<G> {
    /// Begins a change.
    pub(in crate::motion) fn begin(&mut self, aim: Aim) -> Result<()> {
        if self.rounds.is_some() {
            self.make_room_for_round()?;
        }
        self.kernel.begin()?;
        self.kernel.settle_undone();
        let n_ids = self.site_of.len();
        let visibilities = match &self.rounds {
            // Rounds that may be taken back know how many there were.
            Some(_) => self.views.visibilities().len(),
            None => self.views.visibilities_mut().shortened_len(n_ids),
        };
        self.transaction.begin(Counts { present: self.n_present, visibilities });
        let Some(segments) = &mut self.segments else { return Ok(()) };
        // What segments refuse is undone after all of it has been made.
        let relaxed = self.kernel.keep_flat().and_then(|()| segments.relax(&mut self.kernel, aim));
        if relaxed.is_err() {
            self.undo();
        }
        relaxed
    }

    /// What undoes the last round is set aside, so that another change can be begun, and
    /// [settled](Self::settle_round) without a failure.
    fn make_room_for_round(&mut self) -> Result<()> {
        self.set_round_aside()?;
        let Some(rounds) = &mut self.rounds else { return Ok(()) };
        rounds.last = Round::default();
        if let Some(segments) = &self.segments {
            rounds.last.segments = Some(segments.before_settling()?);
        }
        Ok(())
    }

    /// What undoes the last round, if there is one, is set aside.
    fn set_round_aside(&mut self) -> Result<()> {
        let Some(rounds) = self.rounds.as_mut().filter(|rounds| rounds.has_last) else { return Ok(()) };
        memory::reserve(&mut rounds.earlier, 1)?;
        let transaction = self.transaction.set_aside()?;
        // From here on nothing fails.
        let mut round = std::mem::take(&mut rounds.last);
        round.transaction = Some(transaction);
        round.kernel = round.former.is_none().then(|| self.kernel.set_change_aside());
        if let (Some(segments), Some(before)) = (&mut self.segments, &mut round.segments) {
            segments.set_aside(before);
        }
        rounds.earlier.push(round);
        rounds.has_last = false;
        Ok(())
    }

    /// What the change is made for.
    pub(in crate::motion) fn aim(&self) -> Aim {
        self.segments.as_ref().map_or(Aim::Commit, |segments| segments.aim())
    }

    /// Enforces the segments, when the vertices are where they go, unless a new kernel has them.
    pub(in crate::motion) fn enforce_segments(&mut self) -> Result<()> {
        let Some(segments) = &mut self.segments else { return Ok(()) };
        if self.transaction.has_rebuilt() {
            return Ok(());
        }
        // A hidden vertex that goes to another place of vertices takes its segments along, and changes no cell.
        let is_unchanged = self.kernel.complex().rows().is_empty() && !self.transaction.has_logged();
        if is_unchanged && segments.are_at_rest() && self.kernel.has_cells() {
            return Ok(());
        }
        segments.enforce(&mut self.kernel, &self.site_of, &mut self.last_found)
    }

    /// Enforces the segments in a new kernel that hides these vertices.
    pub(in crate::motion) fn enforce_segments_in(
        &mut self,
        next: &mut Delaunay<G>,
        hidden: &Hidden,
    ) -> Result<()> {
        let Some(segments) = &mut self.segments else { return Ok(()) };
        let mut site_of = Vec::new();
        memory::lengthen(&mut site_of, self.site_of.len(), SiteId::NONE)?;
        for s in next.live_sites() {
            hidden.for_all_at(next.site(s).id, |v| site_of[v.index()] = s);
        }
        segments.enforce_in_new(next, &site_of, &mut self.last_found)
    }

    /// Keeps the site of a vertex before it gets one of its own, or loses it.
    pub(in crate::motion) fn log_vertex(&mut self, vertex: VertexId) -> Result<()> {
        self.transaction.reserve_log()?;
        self.transaction.log(VertexBefore { vertex, site: self.site_of[vertex], event: Event::Alone });
        Ok(())
    }

    /// Makes a change visible to programs that read the cells. Cannot fail.
    pub(in crate::motion) fn publish(&mut self) {
        self.n_changes += u64::from(self.has_changed());
        self.show_change();
        self.hidden_in_new = None;
        self.kernel.end();
        self.transaction.end();
        if let Some(segments) = &mut self.segments {
            segments.keep();
        }
        self.sort_if_wanted();
    }

    /// The arrays of cells follow a change.
    pub(super) fn show_change(&mut self) {
        if self.transaction.has_rebuilt() || self.kernel.has_given_up_cells() {
            self.views.follow_all();
        } else {
            self.views.follow(&self.kernel);
        }
    }

    /// Sorts the cells if the last change has found that they are worth it.
    pub(super) fn sort_if_wanted(&mut self) {
        if self.transaction.wants_order() {
            // For speed alone: without the memory for it the cells stay as they are.
            let _ = self.sort_cells(REPLACED_TO_SORT);
        }
    }

    /// Whether a place, a cell or a segment may have changed.
    pub(super) fn has_changed(&self) -> bool {
        self.transaction.has_rebuilt()
            || self.transaction.has_logged()
            || !self.transaction.origins().are_none()
            || !self.kernel.complex().rows().is_empty()
            || self.segments.as_ref().is_some_and(|segments| !segments.are_at_rest())
    }

    /// Puts all back as it was when the change began. Needs no memory.
    pub(in crate::motion) fn undo(&mut self) {
        debug_assert!(!self.transaction.has_rebuilt(), "nothing fails after a new kernel is in place");
        let keys = self.kernel.keys();
        while let Some(VertexBefore { vertex, site, event }) = self.transaction.pop_logged() {
            self.site_of[vertex] = site;
            match event {
                Event::Alone => {}
                Event::Joined { representative } => {
                    self.hidden.part(keys, keys.lower(representative, vertex), vertex);
                }
                Event::Parted { representative } => self.hidden.join(keys, representative, vertex),
            }
        }
        let before = self.transaction.before();
        self.n_present = before.present;
        self.views.visibilities_mut().truncate(before.visibilities);
        self.kernel.undo();
        self.transaction.origins().put_back(&mut self.kernel, &self.site_of);
        if let Some(segments) = &mut self.segments {
            segments.undo(&mut self.kernel);
        }
    }
}
