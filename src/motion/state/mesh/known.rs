//! Who is hidden, kept from one change to the next where vertices have weights, so that a change of few vertices need
//! not look at all hidden ones.
//!
//! A change knows which vertices it has hidden and shown ([`Delaunay::turned`](crate::delaunay::Delaunay::turned)). How
//! many are hidden by place cannot be told from that. As long as no vertex shares its place it is enough to look at
//! those that have come to others; where some do, all are looked at.
//!
//! Nothing depends on this being kept: it is forgotten where it cannot be followed, and found out anew by the next call
//! that asks.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::options::CoincidencePolicy;
use crate::motion::state::hidden_ids::HiddenIds;
use crate::motion::state::mesh::{HiddenNow, Mesh};

/// How many vertices may come to other places by calls at once before it is forgotten how many are hidden by place.
const MOST_PLACED: usize = 256;

/// Who is hidden after the latest change.
#[derive(Debug)]
pub(in crate::motion) struct KnownHidden {
    now: HiddenNow,
    /// Vertices that calls at once have brought to other places since it was known that none shared its place.
    placed: Vec<VertexId>,
    /// Whether how many are hidden by place follows from what was known then and these.
    are_counted: bool,
}

impl KnownHidden {
    /// Which ones.
    pub(in crate::motion) fn ids(&self) -> &HiddenIds {
        &self.now.ids
    }

    /// Whether it is known that no vertex shares its place.
    pub(in crate::motion) fn has_no_shared_place(&self) -> bool {
        self.now.by_place == 0 && self.is_counted()
    }

    /// Whether it is known how many are hidden by place.
    fn is_counted(&self) -> bool {
        self.are_counted && self.placed.is_empty()
    }

    /// Makes room for the vertices of so many ids.
    pub(in crate::motion) fn make_room(&mut self, n_ids: usize) -> Result<()> {
        self.now.ids.make_room(n_ids)
    }

    /// Enters who is hidden now, or not, of some vertices, where so many are hidden in all; whether there was room for
    /// them.
    fn enter(&mut self, mut vertices: impl Iterator<Item = (VertexId, bool)>, n_hidden: usize) -> bool {
        self.now.by_weight = (n_hidden as u64).saturating_sub(self.now.by_place);
        vertices.all(|(v, is_hidden)| self.now.ids.set(v, is_hidden))
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        self.now.ids.memory_bytes() + memory::bytes_of(&self.placed)
    }
}

/// What a commit has found out of who is hidden.
#[derive(Debug)]
pub(in crate::motion) enum Told {
    /// Nothing: there are no weights.
    Nothing,
    /// Who may have been hidden or shown, and is hidden now, or not.
    Turned(Vec<(VertexId, bool)>),
    /// Everything.
    Anew(HiddenNow),
}

impl<G: Moving> Mesh<G> {
    /// Finds out who is hidden, of vertices with weights, unless that is known, and how many are so by place. No change
    /// may be under way.
    pub(in crate::motion) fn know_hidden(&mut self) -> Result<()> {
        if !G::HAS_WEIGHTS {
            return Ok(());
        }
        if let Some(mut known) = self.known.take().filter(|known| known.are_counted) {
            let mut are_alone = true;
            for v in known.placed.drain(..) {
                let Some(s) = self.site(v) else { continue };
                are_alone = are_alone && self.kernel.is_alone(s)?;
            }
            if are_alone {
                self.known = Some(known);
                return Ok(());
            }
        }
        let now = self.hidden_in(&self.kernel, CoincidencePolicy::Merge)?;
        let mut placed = Vec::new();
        memory::reserve_exact(&mut placed, MOST_PLACED)?;
        self.known = Some(KnownHidden { now, placed, are_counted: true });
        Ok(())
    }

    /// Finds out which vertices with weights are hidden, unless that is known.
    pub(in crate::motion) fn know_hidden_ids(&mut self) -> Result<()> {
        if self.known.is_some() { Ok(()) } else { self.know_hidden() }
    }

    /// Follows a commit.
    pub(in crate::motion) fn follow_told(&mut self, told: Told) {
        match told {
            Told::Nothing => {}
            Told::Turned(vertices) => {
                let n_hidden = self.kernel.n_hidden();
                self.known.take_if(|known| !known.enter(vertices.into_iter(), n_hidden));
            }
            Told::Anew(now) => {
                if let Some(known) = &mut self.known {
                    (known.now, known.are_counted) = (now, true);
                    known.placed.clear();
                }
            }
        }
    }

    /// Follows a call at once, which may have brought a vertex to another `place`, or taken it out.
    pub(in crate::motion) fn follow_turned(&mut self, placed: Option<VertexId>) {
        if !G::HAS_WEIGHTS {
            return;
        }
        let Some(mut known) = self.known.take() else { return };
        let Some(turned) = self.kernel.turned().filter(|_| self.kernel.has_cells()) else { return };
        if let Some(v) = placed {
            if known.now.by_place > 0 || known.placed.len() == MOST_PLACED.min(known.placed.capacity()) {
                known.are_counted = false;
            } else {
                known.placed.push(v);
            }
        }
        // A vertex may be among them twice.
        if known.enter(turned.iter().map(|&v| (v, self.is_hidden(v))), self.kernel.n_hidden()) {
            self.known = Some(known);
        }
    }

    /// How many vertices are hidden by place and by weight, if that is known.
    pub(in crate::motion) fn known_counts(&self) -> Option<(u64, u64)> {
        let known = self.known.as_ref().filter(|known| known.is_counted())?;
        Some((known.now.by_place, known.now.by_weight))
    }

    /// Whether what is known of who is hidden is so, while there are cells.
    pub(in crate::motion) fn knows_who_is_hidden(&self) -> bool {
        let Some(known) = self.known.as_ref().filter(|_| self.kernel.has_cells()) else { return true };
        let is_so = |v: VertexId| known.now.ids.has(v) == self.is_hidden(v);
        VertexId::range(0..self.site_of.len().max(known.now.ids.n_ids())).all(is_so)
    }
}
