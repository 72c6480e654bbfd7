//! Vertices that are hidden by others at the same place, or shown again, as the change list tells it.

use super::MovingTriangulation;
use super::views::Views;
use crate::complex::NONE;
use crate::delaunay::Dimension;
use crate::error::Result;
use crate::machine::memory;

/// A vertex that was hidden or shown, and whether it was hidden before.
#[derive(Clone, Copy, Debug)]
pub(super) struct Visibility {
    vertex: u32,
    /// The order of the events.
    at: u32,
    was_hidden: bool,
}

impl Visibility {
    /// Events of vertices that have other ids now, listed by the old ones; those of removed vertices matter to nobody.
    pub(super) fn renumbered(events: &[Self], ids: &[u32]) -> Result<Vec<Self>> {
        let mut renumbered = memory::copy_of(events)?;
        renumbered.retain_mut(|event| {
            event.vertex = ids[event.vertex as usize];
            event.vertex != NONE
        });
        // Fewer events than before: later ones must not seem earlier.
        keep_first(&mut renumbered);
        Ok(renumbered)
    }
}

/// Keeps the first event of each vertex, in the order of the vertices.
fn keep_first(visibilities: &mut Vec<Visibility>) {
    visibilities.sort_unstable_by_key(|event| (event.vertex, event.at));
    visibilities.dedup_by_key(|event| event.vertex);
    visibilities.iter_mut().for_each(|event| event.at = 0);
}

impl<G: Dimension> Views<G> {
    /// Number of events, after a list that has grown far beyond the number of ids has been shortened.
    pub(super) fn count_visibilities(&mut self, n_ids: usize) -> usize {
        if self.visibilities.len() > 2 * n_ids + 1024 {
            keep_first(&mut self.visibilities);
        }
        self.visibilities.len()
    }

    /// Forgets the events after the first `n`.
    pub(super) fn forget_visibilities(&mut self, n: usize) {
        self.visibilities.truncate(n);
    }
}

impl<G: Dimension> MovingTriangulation<G> {
    /// Notes that a vertex is about to be hidden or shown, if the program takes changes.
    pub(super) fn note_visibility(&mut self, vertex: u32, was_hidden: bool) -> Result<()> {
        if !self.takes_changes {
            return Ok(());
        }
        let visibilities = &mut self.views.visibilities;
        let at = visibilities.len() as u32;
        memory::push(visibilities, Visibility { vertex, at, was_hidden })
    }

    /// Lists the vertices that have been hidden or shown; at the first call all that are hidden.
    pub(super) fn list_visibilities(&mut self) -> Result<()> {
        if !self.takes_changes {
            memory::reserve(&mut self.taken.hidden, self.hidden.count())?;
            for v in 0..self.site_of.len() as u32 {
                if self.is_present(v) && self.is_hidden(v) {
                    self.taken.hidden.push(v);
                }
            }
            return Ok(());
        }
        let n = self.views.visibilities.len();
        memory::reserve(&mut self.taken.hidden, n)?;
        memory::reserve(&mut self.taken.shown, n)?;
        keep_first(&mut self.views.visibilities);
        for k in 0..self.views.visibilities.len() {
            let Visibility { vertex, was_hidden, .. } = self.views.visibilities[k];
            if !self.is_present(vertex) {
                continue;
            }
            match (was_hidden, self.is_hidden(vertex)) {
                (false, true) => self.taken.hidden.push(vertex),
                (true, false) => self.taken.shown.push(vertex),
                _ => {}
            }
        }
        Ok(())
    }
}
