//! Vertices that are hidden, or shown again, as the change list tells it.

use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::state::hidden_ids::HiddenIds;

/// A vertex that was hidden or shown, and whether it was hidden before.
#[derive(Clone, Copy, Debug)]
struct Visibility {
    vertex: VertexId,
    /// Its place in the order of the events.
    at: u32,
    was_hidden: bool,
}

/// The events since the program last took the changes; and, where there are weights, who was hidden then, as there are no events.
#[derive(Debug, Default)]
pub(in crate::motion) struct Visibilities {
    events: Vec<Visibility>,
    pub(in crate::motion) hidden_when_taken: HiddenIds,
}

impl Visibilities {
    /// A vertex is about to be hidden or shown.
    pub(in crate::motion) fn note(&mut self, vertex: VertexId, was_hidden: bool) -> Result<()> {
        let at = self.events.len() as u32;
        memory::push(&mut self.events, Visibility { vertex, at, was_hidden })
    }

    /// Number of events.
    pub(in crate::motion) fn len(&self) -> usize {
        self.events.len()
    }

    /// Number of events, after a list that has grown far beyond the number of ids has been shortened.
    pub(in crate::motion) fn shortened_len(&mut self, n_ids: usize) -> usize {
        if self.events.len() > 2 * n_ids + 1024 {
            self.keep_first();
        }
        self.events.len()
    }

    /// Forgets the events after the first `n`.
    pub(in crate::motion) fn truncate(&mut self, n: usize) {
        self.events.truncate(n);
    }

    /// Keeps the first event of each vertex, in the order of the vertices.
    pub(in crate::motion) fn keep_first(&mut self) {
        self.events.sort_unstable_by_key(|event| (event.vertex, event.at));
        self.events.dedup_by_key(|event| event.vertex);
        self.events.iter_mut().for_each(|event| event.at = 0);
    }

    /// The vertices, each with whether it was hidden before.
    pub(in crate::motion) fn iter(&self) -> impl Iterator<Item = (VertexId, bool)> {
        self.events.iter().map(|event| (event.vertex, event.was_hidden))
    }

    /// Events of vertices that have other ids now, listed by the old ones; those of removed vertices are dropped.
    pub(in crate::motion) fn renumbered(&self, ids: &[VertexId]) -> Result<Self> {
        let hidden_when_taken = self.hidden_when_taken.renumbered(ids, ids.len())?;
        let mut renumbered = Visibilities { events: memory::copy_of(&self.events)?, hidden_when_taken };
        renumbered.events.retain_mut(|event| {
            event.vertex = ids[event.vertex];
            event.vertex != VertexId::NONE
        });
        // Fewer events than before: later ones must not seem earlier.
        renumbered.keep_first();
        Ok(renumbered)
    }

    pub(in crate::motion) fn copied(&self) -> Result<Self> {
        let hidden_when_taken = self.hidden_when_taken.copied()?;
        Ok(Visibilities { events: memory::copy_of(&self.events)?, hidden_when_taken })
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.events) + self.hidden_when_taken.memory_bytes()
    }
}
