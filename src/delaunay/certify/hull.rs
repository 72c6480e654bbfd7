//! Certificates of the hull: whether it is convex at its ridges, and has been so all the way of a motion.
//!
//! A ridge is named as the facet of a ghost cell that it has in common with another one.

use crate::complex::{Corners, Facet};
use crate::delaunay::{Delaunay, Failures, Geometry};
use crate::error::Result;
use crate::ids::{Slot, VertexId};
use crate::machine::memory;
use crate::simd::{LANES, in_lanes};

impl<G: Geometry> Delaunay<G> {
    /// Checks the ridges of the ghost cells that are open; what is listed may be none any more, where flips have been
    /// undone. Finite cells must be positive. `before` tells, by id, from where a vertex has come, if it has moved.
    pub(crate) fn check_ridges<'p>(
        &self,
        failures: &mut Failures,
        before: impl Fn(VertexId) -> Option<&'p G::Point>,
    ) -> Result<()> {
        // Where the hull's windings are going to be counted, it does not matter what has been all the way.
        if failures.may_wind_twice {
            self.drop_convex(&mut failures.open_ghosts);
        }
        for g in failures.open_ghosts.drain(..).filter(|&g| self.is_ghost(g)) {
            for ridge in (0..Self::LAST).map(|i| Facet::new(g, i)) {
                if !self.is_convex(ridge) {
                    memory::push(&mut failures.ridges, ridge)?;
                } else {
                    failures.may_wind_twice = failures.may_wind_twice
                        || !self.stayed_positive(&self.simplex_at_hull(ridge), &before);
                }
            }
        }
        Ok(())
    }

    /// Drops ghosts at whose ridges the hull surely is convex, and what is no ghost any more.
    pub(in crate::delaunay) fn drop_convex(&self, ghosts: &mut Vec<Slot>) {
        ghosts.retain(|&g| self.is_ghost(g));
        in_lanes!(simd, self, ghosts, () => |t, ghosts, ()| {
                let mut n_kept = 0;
                for first in (0..ghosts.len()).step_by(LANES) {
                    // The last one fills the last lanes.
                    let four = [0, 1, 2, 3].map(|k| ghosts[(first + k).min(ghosts.len() - 1)]);
                    let corners = four.map(|g| &t.complex.cell(g).corners);
                    // There are three ridges in space: in the plane the last two are the same.
                    let [i, j, k] = [0, 1, G::D - 1]
                        .map(|i| four.map(|g| t.complex.apex(t.complex.cell(g).neighbour(i))));
                    let are_convex = G::are_convex(simd, &t.filter, t.view(), corners, [&i, &j, &k]);
                    for (lane, &g) in four[..LANES.min(ghosts.len() - first)].iter().enumerate() {
                        if are_convex >> lane & 1 == 0 {
                            ghosts[n_kept] = g;
                            n_kept += 1;
                        }
                    }
                }
                ghosts.truncate(n_kept);
        });
    }

    /// Checks that the hull is convex at a ridge between ghost cells, and has been so all the way. Whether it is now.
    pub(super) fn check_ridge(
        &self,
        ridge: Facet,
        before: &[G::Point],
        failures: &mut Failures,
    ) -> Result<bool> {
        let simplex = self.simplex_at_hull(ridge);
        if self.stayed_positive(&simplex, |id| Some(&before[id])) {
            return Ok(true);
        }
        // In a flat part of the hull the cell behind decides, so it must be positive.
        let behind = self.complex.cell(ridge.cell()).neighbour(Self::LAST).cell();
        if !self.check_orientation_of(behind, failures)? {
            memory::push(&mut failures.open_ghosts, ridge.cell())?;
            return Ok(false);
        }
        if !self.is_convex(ridge) {
            memory::push(&mut failures.ridges, ridge)?;
            return Ok(false);
        }
        failures.may_wind_twice = true;
        Ok(true)
    }

    /// Whether the hull is convex or flat at the ridge that is this facet of a ghost cell, and not folded. The finite
    /// cells there must be positive.
    pub(crate) fn is_convex(&self, ridge: Facet) -> bool {
        let ghost = self.complex.cell(ridge.cell());
        let apex = self.place(self.complex.apex(ghost.neighbour(ridge.index())));
        let beyond = G::orientation_with(&self.filter, self.view(), &ghost.corners, Self::LAST, apex);
        if beyond != 0.0 {
            return beyond < 0.0;
        }
        // In a hyperplane, the vertices next to the ridge must be on both sides of it: of one through the cell behind.
        let behind = &self.complex.cell(ghost.neighbour(Self::LAST).cell()).corners;
        let own = (0..G::Corners::N).find(|&i| behind[i] == ghost.corners[ridge.index()]);
        let own = own.expect("the cell behind a ghost has its finite corners");
        G::orientation_with(&self.filter, self.view(), behind, own, apex) < 0.0
    }

    /// The corners of the simplex whose orientation is the certificate of a facet with a ghost cell, at the hull or
    /// between two ghosts.
    pub(crate) fn simplex_at_hull(&self, facet: Facet) -> G::Corners {
        let (c, i) = (facet.cell(), facet.index());
        let cell = self.complex.cell(c);
        if !cell.is_ghost() {
            cell.corners
        } else if i == Self::LAST {
            self.complex.cell(cell.neighbour(i).cell()).corners
        } else {
            // Across a ridge of the hull the other facet's apex is on the inner side.
            cell.corners.with(Self::LAST, self.complex.apex(cell.neighbour(i))).reflected(Self::LAST)
        }
    }

    /// Whether a simplex that is not negative now has not become so on the way from where its vertices were before: it
    /// was certainly positive all the way, or nothing has moved.
    #[inline(always)]
    fn stayed_positive<'p>(
        &self,
        corners: &G::Corners,
        before: impl Fn(VertexId) -> Option<&'p G::Point>,
    ) -> bool {
        let (mut old, mut new) = ([&self.sites[0].point; 4], [&self.sites[0].point; 4]);
        for (k, &s) in corners.as_ref().iter().enumerate() {
            let site = self.site(s);
            (old[k], new[k]) = (before(site.id).unwrap_or(&site.point), &site.point);
        }
        let (old, new) = (&old[..G::Corners::N], &new[..G::Corners::N]);
        G::stays_positive(old, new) || old == new
    }

    /// Lists the ghost cells: one, and all that are reached from it. (The ghost vertex need not know one while there
    /// are flips; where cells are sorted the first ones are ghosts.)
    pub(crate) fn list_ghosts(&mut self, ghosts: &mut Vec<Slot>) -> Result<()> {
        ghosts.clear();
        let complex = &mut self.complex;
        let Some(first) = complex.live().find(|&c| complex.cell(c).is_ghost()) else { return Ok(()) };
        memory::lengthen(ghosts, complex.n_ghosts() + 1, first)?;
        complex.set_mark(first, 1);
        let (mut n, mut k) = (1, 0);
        while k < n {
            for i in 0..Self::LAST {
                // Whether it is new is hard to foresee. Where it is not, what is behind the last one is written.
                let across = complex.cell(ghosts[k]).neighbour(i).cell();
                ghosts[n] = across;
                n += usize::from(complex.mark(across) == 0);
                complex.set_mark(across, 1);
            }
            k += 1;
        }
        ghosts.truncate(n);
        debug_assert_eq!(ghosts.len(), complex.n_ghosts());
        ghosts.iter().for_each(|&c| complex.set_mark(c, 0));
        Ok(())
    }

    /// Whether there is a finite cell in this slot, which may be free.
    pub(in crate::delaunay) fn is_finite(&self, c: Slot) -> bool {
        !self.complex.is_free(c) && !self.complex.cell(c).is_ghost()
    }

    /// Whether there is a ghost cell in this slot, which may be free.
    pub(in crate::delaunay) fn is_ghost(&self, c: Slot) -> bool {
        !self.complex.is_free(c) && self.complex.cell(c).is_ghost()
    }
}
