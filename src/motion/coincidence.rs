//! Vertices at the same place: the lowest id represents the place, the others are hidden until they move apart.

use std::collections::BTreeMap;

use super::{CoincidencePolicy, MovingTriangulation};
use crate::delaunay::{Dimension, Place};
use crate::error::{Error, Result};

/// Hidden vertices by site, ascending; every id is above the site's own.
#[derive(Debug, Default)]
pub(super) struct Hidden {
    at: BTreeMap<u32, Vec<u32>>,
    count: usize,
}

impl Hidden {
    /// Number of hidden vertices.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Whether there are any at a site.
    #[inline(always)]
    pub(super) fn any_at(&self, s: u32) -> bool {
        !self.at.is_empty() && self.at.contains_key(&s)
    }

    pub(super) fn add(&mut self, s: u32, vertex: u32) {
        let ids = self.at.entry(s).or_default();
        let at = ids.partition_point(|&v| v < vertex);
        ids.insert(at, vertex);
        self.count += 1;
    }

    /// Takes a vertex away from the site that it shares. If it is the site's `representative`, returns the next one.
    pub(super) fn leave(&mut self, s: u32, vertex: u32, representative: u32) -> Option<u32> {
        let ids = self.at.get_mut(&s).expect("the site is shared");
        let next = if vertex == representative {
            Some(ids.remove(0))
        } else {
            ids.retain(|&v| v != vertex);
            None
        };
        if ids.is_empty() {
            self.at.remove(&s);
        }
        self.count -= 1;
        next
    }

    /// One hidden vertex, and the site where it is.
    pub(super) fn first(&self) -> Option<(u32, u32)> {
        self.at.iter().next().map(|(&s, ids)| (s, ids[0]))
    }

    /// Empties the list.
    pub(super) fn take(&mut self) -> BTreeMap<u32, Vec<u32>> {
        self.count = 0;
        std::mem::take(&mut self.at)
    }
}

impl<G: Dimension> MovingTriangulation<G> {
    /// Lets a vertex that has no site of its own join another's.
    pub(super) fn hide(&mut self, vertex: u32, s: u32) -> Result<()> {
        let representative = self.kernel.site(s).id;
        self.site_of[vertex as usize] = s;
        if vertex > representative {
            self.hidden.add(s, vertex);
            return Ok(());
        }
        self.hidden.add(s, representative);
        self.kernel.rename_site(s, vertex)
    }

    /// Gives every hidden vertex a site of its own, at the place where it is: a rebuild must follow.
    pub(super) fn spread_hidden(&mut self) -> Result<()> {
        for (s, ids) in self.hidden.take() {
            let place = self.kernel.site(s).point;
            for id in ids {
                self.site_of[id as usize] = self.kernel.add_site(place, id)?;
            }
        }
        Ok(())
    }

    /// Enforces [`CoincidencePolicy::Reject`] on the present state.
    pub(super) fn reject_coincidence(&self) -> Result<()> {
        match self.hidden.first() {
            Some((s, other)) if self.options.coincidence == CoincidencePolicy::Reject => {
                Err(Error::Coincident { vertex: self.kernel.site(s).id, other })
            }
            _ => Ok(()),
        }
    }

    /// Enforces [`CoincidencePolicy::Reject`] on a place that `vertex` would take.
    pub(super) fn reject_occupied(&self, vertex: u32, q: &G::Point) -> Result<()> {
        if self.options.coincidence == CoincidencePolicy::Merge {
            return Ok(());
        }
        match self.kernel.locate(q, crate::complex::NONE) {
            Place::Site(s) => {
                let there = self.kernel.site(s).id;
                Err(Error::Coincident { vertex: vertex.min(there), other: vertex.max(there) })
            }
            _ => Ok(()),
        }
    }
}
