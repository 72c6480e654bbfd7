//! Flips of one thread in its range of the cells, until nothing is left that it can flip.

use std::ops::ControlFlow;

use super::flips::Flips;
use super::lane_tests::LaneTests;
use super::site::Sites;
use crate::complex::{CellRange, Corners, Facet, INFINITE, Obstacle};
use crate::predicates::{StaticFilter, exact_calls};
use crate::simd::{LANES, in_lanes};

/// The step that differs between the dimensions.
pub trait Flip: LaneTests {
    /// Flips a facet between finite cells that fails the empty-sphere test, and enters that.
    fn flip(flipper: &mut Flipper<Self>, facet: Facet, flips: &mut Flips<Self>) -> Result<(), Obstacle>;
}

/// Flips cells of a range.
pub struct Flipper<'t, 's, G: Flip> {
    pub(super) filter: &'t StaticFilter,
    pub(super) sites: Sites<'t, G>,
    pub(super) cells: &'t mut CellRange<'s, G::Corners>,
    /// Whether the sites, too, are to be asked for in advance.
    pub(super) are_sites_far: bool,
}

impl<G: Flip> Flipper<'_, '_, G> {
    /// Flips until no suspect is left, or none but those that are stuck or for later.
    pub(super) fn flip_all(&mut self, flips: &mut Flips<G>) {
        let mut before = flips.n_flips;
        let mut counted = exact_calls();
        loop {
            // Most suspects hold. If one of those taken together changes cells of the others, what has become of these
            // is a suspect again.
            while let Some((rest, &four)) = flips.suspects.split_last_chunk::<LANES>() {
                self.prefetch(rest);
                flips.suspects.truncate(rest.len());
                let hold = self.surely_hold(&four);
                flips.certificates += u64::from(hold.count_ones());
                flips.count_exact(&mut counted);
                for k in (0..LANES).rev().filter(|k| hold >> k & 1 == 0) {
                    if self.flip_suspect(four[k], flips).is_break() {
                        return;
                    }
                }
            }
            while let Some(facet) = flips.suspects.pop() {
                flips.count_exact(&mut counted);
                if self.flip_suspect(facet, flips).is_break() {
                    return;
                }
            }
            if flips.stuck.is_empty() || flips.n_flips == before {
                return;
            }
            // What was stuck may not be any more.
            std::mem::swap(&mut flips.suspects, &mut flips.stuck);
            before = flips.n_flips;
        }
    }

    /// Asks for the cells of the suspects that will be taken after the next ones, which are the last, and for the
    /// sites.
    #[inline(always)]
    fn prefetch(&self, suspects: &[Facet]) {
        let Some(&next) = suspects.last_chunk::<{ 4 * LANES }>() else { return };
        next[..LANES].iter().for_each(|facet| self.cells.prefetch(facet.cell()));
        for facet in &next[LANES..2 * LANES] {
            if let Ok(cell) = self.cells.cell(facet.cell()) {
                self.cells.prefetch(cell.neighbour(facet.index()).cell());
            }
        }
        if !self.are_sites_far {
            return;
        }
        for facet in &next[2 * LANES..3 * LANES] {
            if let Ok(cell) = self.cells.cell(facet.cell())
                && !cell.is_free()
            {
                cell.corners.as_ref().iter().for_each(|&s| self.sites.prefetch(s));
                if let Ok(apex) = self.cells.apex(cell.neighbour(facet.index())) {
                    self.sites.prefetch(apex);
                }
            }
        }
    }

    /// Which of these facets surely hold, one bit each.
    #[inline(always)]
    fn surely_hold(&self, facets: &[Facet; LANES]) -> u32 {
        let none = G::Corners::filled(INFINITE);
        // References: the corners of new cells would be read wider than they have just been written, which waits.
        let (mut cells, mut apexes, mut known) = ([&none; LANES], [INFINITE; LANES], 0);
        for (k, facet) in facets.iter().enumerate() {
            let Ok(cell) = self.cells.cell(facet.cell()) else { continue };
            let Ok(apex) = self.cells.apex(cell.neighbour(facet.index())) else { continue };
            if !cell.is_free() && !cell.is_ghost() && apex != INFINITE {
                (cells[k], apexes[k]) = (&cell.corners, apex);
                known |= 1 << k;
            }
        }
        known & in_lanes!(simd => G::are_outside(simd, self.filter, self.sites, cells, &apexes))
    }

    /// Flips a facet if it fails, or puts it off; ends where there is no memory, or too much has been evaluated.
    #[inline(always)]
    fn flip_suspect(&mut self, facet: Facet, flips: &mut Flips<G>) -> ControlFlow<()> {
        if flips.spent() >= flips.most {
            flips.is_exhausted = true;
            return ControlFlow::Break(());
        }
        if let Err(obstacle) = self.flip_if_it_fails(facet, flips) {
            flips.put_off(facet, obstacle);
            if flips.has_failed {
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    }

    #[inline(always)]
    fn flip_if_it_fails(&mut self, facet: Facet, flips: &mut Flips<G>) -> Result<(), Obstacle> {
        let cell = self.cells.cell(facet.cell())?;
        // The cell of a facet may have gone; then those around it are suspects, too.
        if cell.is_free() || cell.is_ghost() {
            return Ok(());
        }
        let apex = self.cells.apex(cell.neighbour(facet.index()))?;
        if apex == INFINITE {
            return Ok(());
        }
        flips.certificates += 1;
        let (place, id) = (self.sites.point(apex), self.sites.id(apex));
        if !G::is_in_sphere(self.filter, self.sites, &cell.corners, place, id) {
            return Ok(());
        }
        flips.reserve()?;
        G::flip(self, facet, flips)?;
        flips.n_flips += 1;
        Ok(())
    }
}
