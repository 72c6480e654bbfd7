//! Sites without cells: fewer than `D + 1` of them, or all in one hyperplane.
//!
//! Such a state is legal and has zero cells. Two things stand in for them: a map from places to sites, which finds
//! coincident sites, and a *basis*, a largest set of affinely independent sites. A site that is independent of a
//! basis of `D` completes it to a cell, and the triangulation is built.

use std::collections::HashMap;

use super::{Delaunay, Dimension, Insertion};
use crate::complex::{NONE, memory};
use crate::error::{Error, Result};

/// Places and basis; empty while there are cells.
#[derive(Debug, Default)]
pub(super) struct Flat<G: Dimension> {
    places: HashMap<[u64; 3], u32>,
    pub(super) basis: Vec<u32>,
    points: Vec<G::Point>,
}

fn key<G: Dimension>(point: &G::Point) -> [u64; 3] {
    let mut key = [0; 3];
    for k in 0..G::D {
        // The sum makes -0 into 0, so that equal places have equal bits.
        key[k] = (point[k] + 0.0).to_bits();
    }
    key
}

impl<G: Dimension> Flat<G> {
    /// The site at a place.
    pub(super) fn site_at(&self, q: &G::Point) -> Option<u32> {
        self.places.get(&key::<G>(q)).copied()
    }

    /// Enters a site; the one that is there already, if any, stays and is returned.
    pub(super) fn enter(&mut self, s: u32, q: &G::Point) -> Option<u32> {
        match self.places.entry(key::<G>(q)) {
            std::collections::hash_map::Entry::Occupied(there) => Some(*there.get()),
            std::collections::hash_map::Entry::Vacant(place) => {
                place.insert(s);
                None
            }
        }
    }

    pub(super) fn clear(&mut self) {
        *self = Flat::default();
    }

    /// A copy in which the sites have other names, listed by the old ones.
    pub(super) fn renamed(&self, names: &[u32]) -> Result<Self> {
        let mut flat = Flat {
            places: HashMap::new(),
            basis: memory::copy_of(&self.basis)?,
            points: memory::copy_of(&self.points)?,
        };
        let n = self.places.len();
        let bytes = n * size_of::<([u64; 3], u32)>();
        flat.places.try_reserve(n).map_err(|_| Error::OutOfMemory { bytes })?;
        flat.places.extend(self.places.iter().map(|(&place, &s)| (place, names[s as usize])));
        flat.basis.iter_mut().for_each(|s| *s = names[*s as usize]);
        Ok(flat)
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.places.capacity() * size_of::<([u64; 3], u32)>()
    }
}

impl<G: Dimension> Delaunay<G> {
    /// Adds a site to the basis if it is independent of it; whether the basis is that of a cell now.
    pub(super) fn extend_basis(&mut self, s: u32) -> bool {
        let point = self.site(s).point;
        self.flat.points.push(point);
        if G::is_dependent(&self.filter, &self.flat.points) {
            self.flat.points.pop();
        } else {
            self.flat.basis.push(s);
        }
        self.flat.basis.len() == G::D + 1
    }

    /// Inserts a site while there are no cells.
    pub(super) fn insert_flat(&mut self, s: u32) -> Result<Insertion> {
        let q = self.site(s).point;
        if let Some(t) = self.flat.enter(s, &q) {
            return Ok(Insertion::Coincident(t));
        }
        self.sites[s as usize].cell = NONE;
        if self.extend_basis(s) {
            self.remove_flat(s);
            return Ok(Insertion::Spans);
        }
        Ok(Insertion::New)
    }

    /// Takes a site out while there are no cells; it stays live.
    pub(super) fn remove_flat(&mut self, s: u32) {
        let q = self.site(s).point;
        self.flat.places.remove(&key::<G>(&q));
        if self.flat.basis.contains(&s) {
            self.find_flat_basis(s);
        }
    }

    /// Finds a basis of the live sites but one.
    pub(super) fn find_flat_basis(&mut self, except: u32) {
        self.flat.basis.clear();
        self.flat.points.clear();
        for s in 1..self.sites.len() as u32 {
            if s != except && self.site(s).is_live() && self.extend_basis(s) {
                break;
            }
        }
    }

    /// Gives up the cells when the last finite one is gone. `except` is a site that is on its way elsewhere.
    pub(super) fn become_flat(&mut self, except: u32) {
        self.give_up_cells();
        self.changed = None;
        self.flat.clear();
        for s in 1..self.sites.len() as u32 {
            self.sites[s as usize].cell = NONE;
            if s != except && self.site(s).is_live() {
                let q = self.site(s).point;
                self.flat.enter(s, &q);
            }
        }
        self.find_flat_basis(except);
    }
}
