//! A set of facets that is gone through at each timestamp.
//!
//! A list of facet codes, and by cell and index a bit for being a member and a bit for being listed: what leaves the
//! set stays listed until the list is gone through. A facet may be named from either side.

use crate::complex::Facet;
use crate::delaunay::{Delaunay, Moving};
use crate::error::Result;
use crate::ids::Slot;
use crate::machine::memory;
use crate::machine::prefetch::{AHEAD, CACHE_BYTES, prefetch};

#[derive(Debug, Default)]
pub(super) struct WatchedFacets {
    list: Vec<Facet>,
    /// By cell: bit i for the membership of facet i, bit 4 + i for its being listed.
    bits: Vec<u8>,
}

const LISTED: u8 = 0xf0;

impl WatchedFacets {
    /// A copy.
    pub(super) fn copied(&self) -> Result<Self> {
        Ok(WatchedFacets { list: memory::copy_of(&self.list)?, bits: memory::copy_of(&self.bits)? })
    }

    /// Empties the set.
    pub(super) fn clear(&mut self) {
        self.list.clear();
        self.bits.clear();
    }

    /// Follows the number of cells.
    pub(super) fn grow(&mut self, n_cells: usize) -> Result<()> {
        let more = n_cells.saturating_sub(self.bits.len());
        memory::reserve(&mut self.bits, more)?;
        self.bits.resize(self.bits.len() + more, 0);
        Ok(())
    }

    /// Number of listed facets.
    pub(super) fn len(&self) -> usize {
        self.list.len()
    }

    /// Takes the facets that are named from these cells out of the set.
    pub(super) fn forget(&mut self, cells: &[Slot]) {
        for &c in cells {
            if let Some(bits) = self.bits.get_mut(c.index()) {
                *bits &= LISTED;
            }
        }
    }

    /// Puts a facet, given from both sides, into the set or takes it out; whether it is in the set.
    pub(super) fn set(&mut self, [facet, across]: [Facet; 2], is_member: bool) -> bool {
        let (name, other) = if facet < across { (facet, across) } else { (across, facet) };
        self.bits[other.cell()] &= !(1 << other.index());
        let bits = &mut self.bits[name.cell()];
        let (member, listed) = (1 << name.index(), 0x10 << name.index());
        if !is_member {
            *bits &= !member;
            return false;
        }
        if *bits & listed == 0 {
            if memory::reserve(&mut self.list, 1).is_err() {
                *bits &= !member;
                return false;
            }
            self.list.push(name);
        }
        *bits |= member | listed;
        true
    }

    /// Visits all members named from live cells, and drops the others.
    pub(super) fn for_each<G: Moving>(&mut self, kernel: &Delaunay<G>, mut visit: impl FnMut(Facet)) {
        let is_far = size_of_val(kernel.sites()) > CACHE_BYTES;
        let mut n = 0;
        for k in 0..self.list.len() {
            if is_far {
                if let Some(&next) = self.list.get(k + 2 * AHEAD) {
                    prefetch(kernel.complex().cells(), next.cell().index());
                }
                if let Some(&next) = self.list.get(k + AHEAD) {
                    kernel.prefetch_bicell(next);
                }
            }
            let facet = self.list[k];
            let bits = &mut self.bits[facet.cell()];
            if *bits & 1 << facet.index() != 0 && !kernel.complex().is_free(facet.cell()) {
                visit(facet);
                self.list[n] = facet;
                n += 1;
            } else {
                *bits &= !(0x11 << facet.index());
            }
        }
        self.list.truncate(n);
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.list.capacity() * size_of::<Facet>() + self.bits.capacity()
    }
}
