//! Sites without cells: fewer than `D + 1` of them, or all in one hyperplane.
//!
//! Such a state is legal and has zero cells. Two things stand in for them: a map from places to sites, which finds
//! coincident sites, and a *basis*, a largest set of affinely independent sites. A site that is independent of a
//! basis of `D` completes it to a cell, and the triangulation is built.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::{Delaunay, Geometry};
use crate::complex::INFINITE;
use crate::error::Result;
use crate::ids::SiteId;
use crate::machine::memory;

/// Places and basis; empty while there are cells.
#[derive(Debug)]
pub(super) struct Flat<G: Geometry> {
    places: HashMap<[u64; 3], SiteId>,
    pub(super) basis: Basis<G>,
}

impl<G: Geometry> Default for Flat<G> {
    #[inline(always)]
    fn default() -> Self {
        Flat { places: HashMap::new(), basis: Basis::default() }
    }
}

/// Affinely independent sites, `D + 1` at most.
#[derive(Clone, Copy, Debug)]
pub(super) struct Basis<G: Geometry> {
    n: usize,
    sites: [SiteId; 4],
    points: [G::Point; 4],
}

impl<G: Geometry> Default for Basis<G> {
    #[inline(always)]
    fn default() -> Self {
        Basis { n: 0, sites: [INFINITE; 4], points: [G::Point::default(); 4] }
    }
}

impl<G: Geometry> Basis<G> {
    pub(super) fn sites(&self) -> &[SiteId] {
        &self.sites[..self.n]
    }
}

fn key<G: Geometry>(point: &G::Point) -> [u64; 3] {
    let mut key = [0; 3];
    for k in 0..G::D {
        // The sum makes -0 into 0, so that equal places have equal bits.
        key[k] = (point[k] + 0.0).to_bits();
    }
    key
}

impl<G: Geometry> Flat<G> {
    /// The site at a place. With weights none is said: there may be several.
    pub(super) fn site_at(&self, q: &G::Point) -> Option<SiteId> {
        self.places.get(&key::<G>(q)).copied()
    }

    /// Enters a site; the one that is there already, if any, stays and is returned. With weights several may be at a place, and
    /// none is told.
    pub(super) fn enter(&mut self, s: SiteId, q: &G::Point) -> Result<Option<SiteId>> {
        if G::HAS_WEIGHTS {
            return Ok(None);
        }
        memory::reserve_map(&mut self.places, 1)?;
        Ok(match self.places.entry(key::<G>(q)) {
            Entry::Occupied(there) => Some(*there.get()),
            Entry::Vacant(place) => {
                place.insert(s);
                None
            }
        })
    }

    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.places = HashMap::new();
        self.basis.n = 0;
    }

    /// A copy.
    pub(super) fn copied(&self) -> Result<Self> {
        let mut flat = Flat { places: HashMap::new(), basis: self.basis };
        memory::reserve_map(&mut flat.places, self.places.len())?;
        flat.places.extend(&self.places);
        Ok(flat)
    }

    /// A copy in which the sites have other names, listed by the old ones.
    pub(super) fn renamed(&self, names: &[SiteId]) -> Result<Self> {
        let mut flat = Flat { places: HashMap::new(), basis: self.basis };
        memory::reserve_map(&mut flat.places, self.places.len())?;
        flat.places.extend(self.places.iter().map(|(&place, &s)| (place, names[s])));
        let Basis { n, sites, .. } = &mut flat.basis;
        sites[..*n].iter_mut().for_each(|s| *s = names[*s]);
        Ok(flat)
    }

    pub(super) fn memory_bytes(&self) -> usize {
        // The map has a power of two of places, seven in eight of which it fills, and a byte of its own for each.
        match self.places.capacity() {
            0 => 0,
            n => (n * 8 / 7).next_power_of_two() * (size_of::<([u64; 3], SiteId)>() + 1),
        }
    }
}

impl<G: Geometry> Delaunay<G> {
    /// Adds a site to the basis if it is independent of it; whether the basis is that of a cell now.
    pub(super) fn extend_basis(&mut self, s: SiteId) -> bool {
        let point = self.site(s).point;
        let Basis { n, sites, points } = &mut self.flat.basis;
        (sites[*n], points[*n]) = (s, point);
        if !G::is_dependent(&self.filter, &points[..*n + 1]) {
            *n += 1;
        }
        *n == G::D + 1
    }

    /// Whether there are no cells and have to be some, for which a kernel has to be built: the last sites that were shown were in a
    /// hyperplane, and those that they had hidden are not.
    pub(crate) fn spans_without_cells(&self) -> bool {
        G::HAS_WEIGHTS && !self.has_cells() && self.flat.basis.n == G::D + 1
    }

    /// Takes a site out while there are no cells; it stays live.
    pub(super) fn remove_flat(&mut self, s: SiteId) {
        let q = self.site(s).point;
        self.flat.places.remove(&key::<G>(&q));
        if self.flat.basis.sites().contains(&s) {
            // Those that stay span no more than all did.
            self.find_basis(s, self.flat.basis.n);
        }
    }

    /// Finds a basis of the live sites but one.
    pub(super) fn find_flat_basis(&mut self, except: SiteId) {
        self.find_basis(except, G::D + 1);
    }

    /// Finds a basis of the live sites but one, which has `most` sites at most. It begins with those behind that one:
    /// where sites go in their order, the ones before it have gone.
    fn find_basis(&mut self, except: SiteId, most: usize) {
        self.flat.basis = Basis::default();
        let n = self.sites.len();
        let first = if except == SiteId::NONE { 1 } else { except.index() };
        for s in SiteId::range(first..n).chain(SiteId::range(1..first)) {
            if s != except && self.site(s).is_live() && (self.extend_basis(s) || self.flat.basis.n == most) {
                break;
            }
        }
    }
}
