//! The star of a site, gathered for what is going to change it.
//!
//! In space each cell of a star is beside three others, so most of what is reached is known. Where marks stay in a
//! cache, what is listed is marked, and a relocation takes a tenth less time than with a [set](super::set), which is
//! for questions: those may not write marks. Of a large triangulation, marks are more to wait for. Whether a cell is
//! new is hard to foresee, so no branch is on it.
//!
//! Invariant: all marks are 0 before and after.
//!
//! Cost: three marks a cell; a relocation that finds nothing to do spends nearly half of its time here.

use super::around::{BESIDE, beside, list_ring, list_star};
use super::{Delaunay, Geometry};
use crate::complex::{Complex, Corners};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::machine::prefetch::prefetch;

/// A cell of a star, and the index of its site.
type Entry = (Slot, u8);

/// Nearly all stars have fewer cells: a power of two.
const FEW: usize = 64;

impl<G: Geometry> Delaunay<G> {
    /// Collects the star of a site: nothing of one that weights hide. What a relocation reads next is asked for: the sites of the link and those beyond
    /// its facets.
    pub(crate) fn gather_star(&mut self, s: SiteId) -> Result<()> {
        if self.is_hidden(s) {
            self.star.clear();
            return Ok(());
        }
        self.gather_star_from(self.sites[s].cell, s)
    }

    /// Collects the star of a site, of which `first` is a cell: while there are flips the site itself need not know
    /// one.
    pub(super) fn gather_star_from(&mut self, first: Slot, s: SiteId) -> Result<()> {
        let is_far = self.is_far();
        let (complex, star) = (&mut self.complex, &mut self.star);
        if G::D == 2 {
            star.clear();
            list_ring(complex, first, s, |c, at| memory::push(star, (c, at as u8)))?;
        } else if is_far {
            let around = memory::made(&mut self.around)?;
            around.clear();
            list_star(complex, first, s, around, |_| {})?;
            let cells = around.as_slice();
            star.clear();
            memory::reserve(star, cells.len())?;
            star.extend(cells.iter().map(|&c| (c, complex.cell(c).index_of(s) as u8)));
        } else {
            memory::reserve(star, FEW.saturating_sub(star.len()))?;
            let marked = mark_star(complex, first, s, star);
            star.iter().for_each(|&(c, _)| complex.set_mark(c, 0));
            marked?;
            debug_assert!(is_whole(complex, star), "a mark was left");
        }
        if is_far {
            self.prefetch_link();
        }
        self.pace.count(self.star.len());
        Ok(())
    }

    /// Asks for the sites of the gathered star's link, and for those beyond its facets.
    fn prefetch_link(&self) {
        for &(c, at) in &self.star {
            self.prefetch_across(c, usize::from(at));
        }
        for &(c, at) in &self.star {
            let across = self.complex.cell(c).neighbour(usize::from(at));
            prefetch(&self.sites, self.complex.apex(across).index());
        }
    }

    /// Cells of the star gathered last, and the index of its site in each.
    pub(crate) fn gathered_star(&self) -> &[(Slot, u8)] {
        &self.star
    }
}

/// Whether what is beside a cell of a star in space is in the star: where marks are left, some are missing.
fn is_whole<C: Corners>(complex: &Complex<C>, star: &[Entry]) -> bool {
    star.iter().all(|&(c, at)| {
        let (_, others) = beside(complex, c, complex.cell(c).corners[usize::from(at)]);
        others.iter().all(|other| star.iter().any(|(c, _)| c == other))
    })
}

/// Lists the cells around a site in space, of which `first` is one, and marks all that are listed. There is room for
/// [`FEW`].
fn mark_star<C: Corners>(
    complex: &mut Complex<C>,
    first: Slot,
    s: SiteId,
    star: &mut Vec<Entry>,
) -> Result<()> {
    star.resize(FEW, (first, 0));
    let (few, _) = star.as_chunks_mut::<FEW>();
    let (n, mut next) = mark_few(complex, first, s, &mut few[0]);
    star.truncate(n);
    while next < star.len() {
        let c = star[next].0;
        let (at, beside) = beside(complex, c, s);
        star[next].1 = at;
        for other in beside {
            if complex.mark(other) == 0 {
                memory::push(star, (other, 0))?;
                complex.set_mark(other, 1);
            }
        }
        next += 1;
    }
    Ok(())
}

/// Lists cells while there is room for those beside one; returns how many, and of which the ones beside are not listed.
#[inline(always)]
fn mark_few<C: Corners>(
    complex: &mut Complex<C>,
    first: Slot,
    s: SiteId,
    few: &mut [Entry; FEW],
) -> (usize, usize) {
    debug_assert!(complex.mark(first) == 0);
    complex.set_mark(first, 1);
    few[0] = (first, 0);
    let (mut n, mut next) = (1, 0);
    while next < n && n + BESIDE <= FEW {
        let entry = &mut few[next % FEW];
        let (at, beside) = beside(complex, entry.0, s);
        entry.1 = at;
        for other in beside {
            complex.prefetch(other);
            // Where it is not new, what is behind the last entry is written.
            few[n % FEW].0 = other;
            n += usize::from(complex.mark(other) == 0);
            complex.set_mark(other, 1);
        }
        next += 1;
    }
    (n, next)
}
