//! What a thread has flipped, and what it is to flip, with room for what a flip enters.

use super::shape::Shape;
use crate::complex::{Facet, Obstacle, Row};
use crate::error::{Error, Result};
use crate::ids::Slot;
use crate::machine::memory;
use crate::predicates::exact_calls;

/// An exact evaluation takes as long as this number of certificates: their costs in `motion::constants` are as 135 to
/// 30 in space, and as 80 to 20 in the plane.
pub(crate) const CERTIFICATES_PER_EXACT: u64 = 4;

/// What has been flipped, and what is to be.
#[derive(Debug)]
pub struct Flips<G: Shape> {
    /// Facets that may fail.
    pub(super) suspects: Vec<Facet>,
    /// Facets that fail and cannot be flipped.
    pub(super) stuck: Vec<Facet>,
    /// Facets that may fail, for when there are more cells.
    pub(super) later: Vec<Facet>,
    /// Two cells of each flip that have all its sites as corners.
    pub(super) changed: Vec<Slot>,
    /// The third cell of flips that have made one.
    pub(super) made: Vec<Slot>,
    /// For undoing: the rows that each flip has changed.
    pub(super) journal: Vec<Row<G::Corners>>,
    pub(super) n_flips: u64,
    pub(super) certificates: u64,
    /// How many of the certificates evaluated took exact arithmetic.
    pub(super) exact: u64,
    /// How much may be spent, in certificates.
    pub(super) most: u64,
    /// Whether these were not enough.
    pub(super) is_exhausted: bool,
    /// Whether there was no memory to go on.
    pub(super) has_failed: bool,
}

impl<G: Shape> Default for Flips<G> {
    fn default() -> Self {
        Flips {
            suspects: Vec::new(),
            stuck: Vec::new(),
            later: Vec::new(),
            changed: Vec::new(),
            made: Vec::new(),
            journal: Vec::new(),
            n_flips: 0,
            certificates: 0,
            exact: 0,
            most: u64::MAX,
            is_exhausted: false,
            has_failed: false,
        }
    }
}

impl<G: Shape> Flips<G> {
    pub(super) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.suspects)
            + memory::bytes_of(&self.stuck)
            + memory::bytes_of(&self.later)
            + memory::bytes_of(&self.changed)
            + memory::bytes_of(&self.made)
            + memory::bytes_of(&self.journal)
    }

    pub(super) fn begin(&mut self, most: u64) {
        (self.n_flips, self.certificates, self.exact, self.most) = (0, 0, 0, most);
        (self.is_exhausted, self.has_failed) = (false, false);
        self.stuck.clear();
        self.later.clear();
        self.changed.clear();
        self.made.clear();
        self.journal.clear();
    }

    /// Adds the exact evaluations since `counted`, and counts from there on.
    #[inline(always)]
    pub(super) fn count_exact(&mut self, counted: &mut u64) {
        let now = exact_calls();
        self.exact += now - std::mem::replace(counted, now);
    }

    /// What has been spent, in certificates.
    #[inline(always)]
    pub(super) fn spent(&self) -> u64 {
        self.certificates + CERTIFICATES_PER_EXACT * self.exact
    }

    /// Makes room for what a flip enters: twice that of one for a 4-4 flip.
    #[inline(always)]
    pub(super) fn reserve(&mut self) -> Result<(), Obstacle> {
        let has_room = self.suspects.capacity() - self.suspects.len() >= 12
            && self.changed.capacity() - self.changed.len() >= 4
            && self.made.capacity() - self.made.len() >= 1
            && self.journal.capacity() - self.journal.len() >= 6;
        if has_room { Ok(()) } else { self.grow().map_err(|_| Obstacle::Memory) }
    }

    #[cold]
    fn grow(&mut self) -> Result<()> {
        memory::reserve(&mut self.suspects, 12)?;
        memory::reserve(&mut self.changed, 4)?;
        memory::reserve(&mut self.made, 1)?;
        memory::reserve(&mut self.journal, 6)
    }

    /// Enters a flip that is in the journal: facets on its boundary, of two cells that have all its sites.
    #[inline(always)]
    pub(super) fn enter<const N: usize>(&mut self, outer: [Facet; N]) {
        self.changed.push(outer[0].cell());
        self.changed.push(outer[N / 2].cell());
        // One by one: an array of them would be written first, and then read wider than that, which waits.
        for facet in outer {
            self.suspects.push(facet);
        }
    }

    /// Lists a facet that was not flipped.
    pub(super) fn put_off(&mut self, facet: Facet, obstacle: Obstacle) {
        let listed = match obstacle {
            Obstacle::Shape => memory::push(&mut self.stuck, facet),
            Obstacle::OtherRange | Obstacle::Full => memory::push(&mut self.later, facet),
            Obstacle::Memory => Err(Error::OutOfMemory { bytes: 0 }),
        };
        self.has_failed = listed.is_err();
    }
}
