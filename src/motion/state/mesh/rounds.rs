//! Changes that stay until all of them are published or withdrawn: the rounds of a timestamp that is being prepared.

use crate::delaunay::{Delaunay, Keys, Moving};
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::state::hidden::Hidden;
use crate::motion::state::mesh::{Mesh, REPLACED_TO_SORT_FIRST};
use crate::motion::state::rounds::{Former, Published, Rounds, Settled};

impl<G: Moving> Mesh<G> {
    /// How many rounds have been made.
    pub(in crate::motion) fn n_rounds(&self) -> usize {
        self.rounds.as_ref().map_or(0, |rounds| rounds.count())
    }

    /// From now on changes are rounds.
    pub(in crate::motion) fn open_rounds(&mut self, before: Published) -> Result<()> {
        let rounds = memory::boxed(Rounds::new(before))?;
        self.views.open_rounds()?;
        self.rounds = Some(rounds);
        Ok(())
    }

    /// Ends the rounds if none has been made.
    pub(in crate::motion) fn close_empty_rounds(&mut self) {
        if self.rounds.as_ref().is_some_and(|rounds| rounds.count() == 0) {
            self.rounds = None;
            self.views.end_rounds();
        }
    }

    /// Makes room for the present kernel to be kept while another one takes its place. Nothing without rounds.
    pub(in crate::motion) fn make_room_for_former(&mut self) -> Result<()> {
        let Some(rounds) = &mut self.rounds else { return Ok(()) };
        let site_of = memory::copy_of(&self.site_of)?;
        let sorted_stride = self.sorted_stride;
        let former = Former { kernel: Delaunay::empty(), hidden: Hidden::default(), site_of, sorted_stride };
        rounds.last.former = Some(memory::boxed(former)?);
        Ok(())
    }

    /// Puts a kernel, which is complete, in the place of the present one, which is kept if there is
    /// [room](Self::make_room_for_former).
    pub(in crate::motion) fn adopt(&mut self, mut next: Delaunay<G>, hidden: Hidden, stride: f64) {
        *next.pace_mut() = std::mem::take(self.kernel.pace_mut());
        let kernel = std::mem::replace(&mut self.kernel, next);
        let hidden = std::mem::replace(&mut self.hidden, hidden);
        self.sorted_stride = stride;
        let former = self.rounds.as_mut().and_then(|rounds| rounds.last.former.as_mut());
        self.transaction.adopt(former.is_some());
        if let Some(former) = former {
            (former.kernel, former.hidden) = (kernel, hidden);
            former.kernel.keys_mut().give_away();
        }
    }

    /// A round has been made: makes it visible to programs that read the cells.
    pub(in crate::motion) fn settle_round(&mut self) {
        self.n_changes += u64::from(self.has_changed());
        self.show_change();
        let rounds = self.rounds.as_mut().expect("a round is being made");
        if let (Some(segments), Some(before)) = (&mut self.segments, &mut rounds.last.segments) {
            segments.settle(before);
        }
        rounds.has_last = true;
    }

    /// Makes room to [withhold](Self::withhold_ids) the ids of `n` more vertices.
    pub(in crate::motion) fn make_room_to_withhold(&mut self, n: usize) -> Result<()> {
        let Some(rounds) = &mut self.rounds else { return Ok(()) };
        memory::reserve(&mut rounds.removed, n)
    }

    /// The round has removed these vertices, which may come back: their ids are not given again before that is settled.
    pub(in crate::motion) fn withhold_ids(&mut self, removed: &[VertexId]) {
        let Some(rounds) = &mut self.rounds else { return };
        rounds.removed.extend_from_slice(removed);
        rounds.removed.sort_unstable();
    }

    /// Whether an id is that of a vertex which a round has removed.
    pub(in crate::motion) fn is_withheld(&self, vertex: VertexId) -> bool {
        self.rounds.as_ref().is_some_and(|rounds| rounds.removed.binary_search(&vertex).is_ok())
    }

    /// The cells are worth sorting, but are not before the timestamp is published.
    pub(in crate::motion) fn want_order_when_published(&mut self) {
        if let Some(rounds) = &mut self.rounds {
            rounds.wants_order = true;
        }
    }

    /// The rounds stay.
    pub(in crate::motion) fn publish_rounds(&mut self) {
        let Some(rounds) = self.rounds.take() else { return };
        self.kernel.forget_changes_aside();
        if rounds.has_last {
            self.kernel.end();
            self.transaction.end();
        }
        self.views.end_rounds();
        if let Some(segments) = &mut self.segments {
            segments.end_rounds();
        }
        if rounds.wants_order {
            // For speed alone: without the memory for it the cells stay as they are.
            let _ = self.sort_cells(REPLACED_TO_SORT_FIRST);
        } else {
            self.sort_if_wanted();
        }
    }

    /// Takes all rounds back. Needs no memory.
    pub(in crate::motion) fn withdraw_rounds(&mut self) -> Option<Published> {
        let rounds = *self.rounds.take()?;
        if rounds.has_last {
            self.unsettle(rounds.last);
            self.undo();
        }
        for round in rounds.earlier.into_iter().rev() {
            let origins = self.transaction.take_up(round.transaction);
            if let Some(kept) = round.kernel {
                self.kernel.take_change_up(kept);
            }
            if let (Some(segments), Some(kept)) = (&mut self.segments, round.segments) {
                segments.take_up(kept);
            }
            self.unsettle(round.settled);
            self.undo();
            origins.put_back(&mut self.kernel, &self.site_of);
        }
        self.views.withdraw_rounds();
        if let Some(segments) = &mut self.segments {
            segments.end_rounds();
        }
        if !rounds.before.has_segments {
            self.segments = None;
        }
        self.site_of.truncate(rounds.before.n_ids);
        if rounds.before.has_keys {
            self.kernel.keys_mut().truncate(rounds.before.n_ids);
        } else {
            *self.kernel.keys_mut() = Keys::default();
        }
        self.n_changes += 1;
        Some(rounds.before)
    }

    /// Brings what a round has left to where [`undo`](Self::undo) begins.
    fn unsettle(&mut self, settled: Settled<G>) {
        if let Some(former) = settled.former {
            let Former { mut kernel, hidden, site_of, sorted_stride } = *former;
            *kernel.pace_mut() = std::mem::take(self.kernel.pace_mut());
            self.kernel.give_scratch_to(&mut kernel);
            *kernel.keys_mut() = std::mem::take(self.kernel.keys_mut());
            (self.kernel, self.hidden, self.sorted_stride) = (kernel, hidden, sorted_stride);
            self.site_of = site_of;
            self.transaction.reject();
        }
        if let (Some(segments), Some(before)) = (&mut self.segments, settled.segments) {
            segments.unsettle(before);
        }
    }
}
