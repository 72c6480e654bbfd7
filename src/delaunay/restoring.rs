//! A triangulation from cells that are known already, as those that have been saved: nothing is triangulated, and
//! everything is checked.
//!
//! Cost: the sort of a fresh build, a pass over the cells to glue them, and a [sweep](super::certify) of all
//! certificates.

use super::{Delaunay, Dimension, Failures, Site};
use crate::complex::{Complex, Corners};
use crate::damage::{Damage, LoadError};
use crate::error::Result;
use crate::ids::{CellId, SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::machine::prefetch::{AHEAD, prefetch};
use crate::machine::threads::Threads;

/// Cells as programs know them: the vertices of each, and its neighbours.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rows<'r, G: Dimension> {
    pub(crate) corners: &'r [G::Vertices],
    pub(crate) neighbours: &'r [G::Neighbours],
}

impl<G: Dimension> Delaunay<G> {
    /// The triangulation of these cells: cell k is in slot k. `positions` are by vertex id, and all are in range;
    /// `is_site` tells which vertices stand for their places. Also the site of each of these.
    ///
    /// The rows may hold anything. What is returned is the Delaunay triangulation of the sites.
    pub(crate) fn of_rows(
        positions: &[G::Point],
        is_site: impl Fn(VertexId) -> bool + Copy + Sync,
        rows: Rows<'_, G>,
        threads: Threads,
    ) -> Result<(Self, Vec<SiteId>), LoadError> {
        let mut t = Delaunay::on(threads)?;
        let vertices = 0..positions.len() as u32;
        let n = vertices.clone().filter(|&v| is_site(VertexId::new(v))).count();
        let own = vertices.filter(move |&v| is_site(VertexId::new(v)));
        let (parts, sorted) = t.in_parts(own, n, |v| &positions[v as usize])?;
        t.reserve_sites(n)?;
        let mut site_of = Vec::new();
        memory::lengthen(&mut site_of, positions.len(), SiteId::NONE)?;
        for part in &sorted {
            for (k, keyed) in part.iter().enumerate() {
                if let Some(later) = part.get(k + AHEAD) {
                    prefetch(positions, later.item() as usize);
                    prefetch(&site_of, later.item() as usize);
                }
                site_of[keyed.item() as usize] = SiteId::at(t.sites.len());
                t.sites.push(Site::new(positions[keyed.item() as usize], VertexId::new(keyed.item())));
            }
        }
        drop(sorted);
        t.parts = parts;
        t.tighten_filter();
        if rows.corners.is_empty() {
            t.enter_flat()?;
            return Ok((t, site_of));
        }
        t.enter_rows(rows, &site_of)?;
        t.check_restored()?;
        Ok((t, site_of))
    }

    /// Enters all sites where there are no cells; they must be in one hyperplane.
    fn enter_flat(&mut self) -> Result<(), LoadError> {
        for s in SiteId::range(1..self.sites.len()) {
            let Site { point, id, .. } = *self.site(s);
            if let Some(other) = self.flat.enter(s, &point)? {
                return Err(Damage::SamePlace { vertex: self.site(other).id, other: id }.into());
            }
            if self.extend_basis(s) {
                return Err(Damage::NoCells { vertex: id }.into());
            }
        }
        Ok(())
    }

    /// Makes the cells of rows.
    fn enter_rows(&mut self, rows: Rows<'_, G>, site_of: &[SiteId]) -> Result<(), LoadError> {
        let sites = &mut self.sites;
        let corners = rows.corners.iter().enumerate().map(|(c, row)| {
            let later = [rows.corners.get(c + 2 * AHEAD), rows.corners.get(c + AHEAD)];
            for i in 0..G::Corners::N {
                if let Some(row) = later[0] {
                    prefetch(site_of, row[i].index());
                }
                if let Some(s) = later[1].and_then(|row| site_of.get(row[i].index())) {
                    prefetch(sites, s.index());
                }
            }
            let mut corners = G::Corners::filled(SiteId::NONE);
            for i in 0..G::Corners::N {
                let s = site_of.get(row[i].index()).copied().unwrap_or(SiteId::NONE);
                if s == SiteId::NONE {
                    return Err(Damage::Corner { cell: CellId::at(c), corner: i, given: row[i] }.into());
                }
                if corners.as_ref()[..i].contains(&s) {
                    return Err(Damage::CornerTwice { cell: CellId::at(c), vertex: row[i] }.into());
                }
                corners[i] = s;
                sites[s].cell = Slot::at(c);
            }
            Ok(corners)
        });
        self.complex = Complex::of_rows(corners, rows.neighbours)?;
        self.recent = Slot::new(0);
        // The ghosts follow the finite cells. Without any the cells are closed, and cannot all be positive.
        self.sites[0].cell = Slot::at(rows.corners.len().min(self.complex.n_slots() - 1));
        match self.sites[1..].iter().find(|site| site.cell == Slot::NONE) {
            Some(site) => Err(Damage::InNoCell { vertex: site.id }.into()),
            None => Ok(()),
        }
    }

    /// Checks that the cells, which are closed and oriented alike, are the Delaunay triangulation of the sites.
    fn check_restored(&mut self) -> Result<(), LoadError> {
        let mut failures = Failures::default();
        let are_positive = self.sweep(&mut failures, 0, None)?;
        if let Some(&c) = failures.cells.iter().min() {
            return Err(Damage::NotPositive { cell: CellId::new(c.get()) }.into());
        }
        debug_assert!(are_positive);
        if let Some(facet) = failures.facets.first() {
            let cell = CellId::new(facet.cell().get());
            return Err(Damage::NotDelaunay { cell, corner: facet.index() }.into());
        }
        self.check_ridges(&mut failures, |_| None)?;
        if let Some(ridge) = failures.ridges.first() {
            let behind = self.complex.cell(ridge.cell()).neighbour(Self::LAST).cell();
            return Err(Damage::NotConvex { cell: CellId::new(behind.get()) }.into());
        }
        if self.winds_once(&failures.ghosts) || self.has_cells_of_a_build()? {
            Ok(())
        } else {
            Err(Damage::NotATriangulation.into())
        }
    }

    /// Whether a fresh build has the same cells, and as many ghosts: where the hull could not be seen to wind once, as
    /// that of cells so thin that no double lies inside any. A facet has one other cell to be glued to or none, so
    /// cells with as many ghosts are glued alike.
    fn has_cells_of_a_build(&self) -> Result<bool> {
        let mut build = Delaunay::<G>::on(self.threads)?;
        memory::reserve_exact(&mut build.sites, self.sites.len() - 1)?;
        build.sites.extend(self.sites[1..].iter().map(|site| Site::new(site.point, site.id)));
        build.parts = self.parts.copy()?;
        let merges = build.rebuild(&mut |_| true)?;
        let sizes = |t: &Self| (t.complex.n_finite(), t.complex.n_ghosts());
        if !merges.is_empty() || sizes(&build) != sizes(self) {
            return Ok(false);
        }
        let (own, others) = (self.sorted_cells()?, build.sorted_cells()?);
        Ok(own == others)
    }

    /// The vertices of all finite cells, ascending in each, and the cells in ascending order.
    fn sorted_cells(&self) -> Result<Vec<G::Vertices>> {
        let mut all = Vec::new();
        memory::reserve_exact(&mut all, self.complex.n_finite())?;
        all.extend(self.complex.finite().map(|c| {
            let corners = self.complex.cell(c).corners;
            let mut ids = G::Vertices::filled(VertexId::NONE);
            (0..G::Corners::N).for_each(|i| ids[i] = self.site(corners[i]).id);
            ids.as_mut().sort_unstable();
            ids
        }));
        all.sort_unstable();
        Ok(all)
    }
}
