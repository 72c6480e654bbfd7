//! A triangulation from cells that are known already, as those that have been saved: nothing is triangulated, and
//! everything is checked.
//!
//! Cost: the sort of a fresh build, a pass over the cells to glue them, a [sweep](super::certify) of all certificates,
//! and one over the hull, whatever the cells are. Time and memory are in proportion to their number and that of the
//! positions, but for the sort's `n log n`.

use super::{Delaunay, Failures, Geometry, Keys, Site};
use crate::complex::{Complex, Corners, Facet};
use crate::damage::{Damage, LoadError};
use crate::error::{Error, Result};
use crate::ids::{CellId, SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::machine::prefetch::{AHEAD, prefetch};
use crate::machine::threads::Threads;

/// Parts of the work that are done when sites are sorted, and when cells are glued to each other.
const SORTED: f64 = 0.3;
const GLUED: f64 = 0.7;

/// The part of the checks that is done when all cells have been swept.
const SWEPT: f64 = 0.9;

/// The part that is done when, with weights, the hidden sites have been entered.
const HIDDEN: f64 = 0.95;

/// Sites without cells that are entered, sites that may be hidden, and ghosts that are looked at, between two calls of a
/// monitor.
const ENTERED: usize = 1 << 16;

/// Ends in an error if a monitor does not want to go on.
fn go_on(monitor: &mut dyn FnMut(f64) -> bool, fraction: f64) -> Result<()> {
    if monitor(fraction) { Ok(()) } else { Err(Error::Cancelled) }
}

/// A monitor of a part of the work.
fn part_of(monitor: &mut dyn FnMut(f64) -> bool, from: f64, to: f64) -> impl FnMut(f64) -> bool {
    move |fraction| monitor(from + (to - from) * fraction)
}

/// Cells as programs know them: the vertices of each, and its neighbours.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rows<'r, G: Geometry> {
    pub(crate) corners: &'r [G::Vertices],
    pub(crate) neighbours: &'r [G::Neighbours],
    /// With weights, by vertex the cell that it is hidden above, [`CellId::NONE`] for a corner of cells.
    pub(crate) below: &'r [CellId],
    /// Vertices that stand for their places, between which there have to be edges.
    pub(crate) segments: &'r [[VertexId; 2]],
}

impl<G: Geometry> Delaunay<G> {
    /// The triangulation of these cells: cell k is in slot k. `positions` are by vertex id, and all are in range;
    /// `is_site` tells which vertices stand for their places. Also the site of each of these.
    ///
    /// The rows may hold anything. What is returned is the Delaunay triangulation of the sites. `monitor` is called
    /// with the fraction done; if it returns `false`, this ends in [`Error::Cancelled`].
    pub(crate) fn of_rows(
        positions: &[G::Point],
        is_site: impl Fn(VertexId) -> bool + Copy + Sync,
        rows: Rows<'_, G>,
        keys: Keys,
        threads: Threads,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(Self, Vec<SiteId>), LoadError> {
        let mut t = Delaunay::on(threads)?;
        t.keys = keys;
        go_on(monitor, 0.0)?;
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
        go_on(monitor, SORTED)?;
        t.parts = parts;
        t.tighten_filter();
        if rows.corners.is_empty() {
            t.enter_flat(rows.below, &mut part_of(monitor, SORTED, 1.0))?;
            return Ok((t, site_of));
        }
        t.enter_rows(rows, &site_of, &mut part_of(monitor, SORTED, GLUED))?;
        t.enter_segments(rows.segments, &site_of)?;
        t.check_restored(rows.below, &mut part_of(monitor, GLUED, 1.0))?;
        Ok((t, site_of))
    }

    /// Enters all sites where there are no cells; they must be in one hyperplane.
    fn enter_flat(
        &mut self,
        below: &[CellId],
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(), LoadError> {
        if let Some((vertex, &cell)) =
            VertexId::range(0..below.len()).zip(below).find(|(_, cell)| **cell != CellId::NONE)
        {
            return Err(Damage::Above { vertex, cell }.into());
        }
        let n_sites = self.sites.len();
        for s in SiteId::range(1..n_sites) {
            if s.index() % ENTERED == 0 {
                go_on(monitor, s.index() as f64 / n_sites as f64)?;
            }
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
    fn enter_rows(
        &mut self,
        rows: Rows<'_, G>,
        site_of: &[SiteId],
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(), LoadError> {
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
        self.complex = Complex::of_rows(corners, rows.neighbours, monitor)?;
        self.recent = Slot::new(0);
        // The ghosts follow the finite cells. Without any the cells are closed, and cannot all be positive.
        self.sites[0].cell = Slot::at(rows.corners.len().min(self.complex.n_slots() - 1));
        let is_lost = |site: &&Site<G>| {
            site.cell == Slot::NONE
                && rows.below.get(site.id.index()).is_none_or(|&cell| cell == CellId::NONE)
        };
        match self.sites[1..].iter().find(is_lost) {
            Some(site) => Err(Damage::InNoCell { vertex: site.id }.into()),
            None => Ok(()),
        }
    }

    /// Enters the edges that have to be there.
    fn enter_segments(&mut self, segments: &[[VertexId; 2]], site_of: &[SiteId]) -> Result<(), LoadError> {
        memory::reserve_exact(&mut self.required, segments.len())?;
        for ends in segments {
            let [s, t] = ends.map(|v| site_of[v.index()]);
            self.required.push(if s < t { [s, t] } else { [t, s] });
        }
        self.required.sort_unstable();
        self.required.dedup();
        Ok(())
    }

    /// Enters the sites that weights hide, each above the positive cell that it is said to be above.
    fn enter_hidden(
        &mut self,
        below: &[CellId],
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(), LoadError> {
        self.make_room_to_hide()?;
        let n_cells = self.complex.n_finite();
        for s in SiteId::range(1..self.sites.len()) {
            if s.index() % ENTERED == 0 {
                go_on(monitor, s.index() as f64 / self.sites.len() as f64)?;
            }
            let Site { point, id: vertex, cell: of } = *self.site(s);
            let cell = below[vertex];
            let slot = Slot::new(cell.get());
            let is_right = if of == Slot::NONE {
                cell.index() < n_cells
                    && self.has_place(slot, &point)
                    && !self.is_in_conflict(slot, &point, vertex)
            } else {
                cell == CellId::NONE
            };
            if !is_right {
                return Err(Damage::Above { vertex, cell }.into());
            }
            if of == Slot::NONE {
                self.hide(s, slot);
            }
        }
        Ok(())
    }

    /// Checks that the cells, which are closed and oriented alike, are the Delaunay triangulation of the sites.
    fn check_restored(
        &mut self,
        below: &[CellId],
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(), LoadError> {
        let mut failures = Failures::default();
        self.sweep_monitored(&mut failures, &mut part_of(monitor, 0.0, SWEPT))?;
        if let Some(&c) = failures.cells.iter().min() {
            return Err(Damage::NotPositive { cell: CellId::new(c.get()) }.into());
        }
        let is_free = |facet: &&Facet| !self.is_facet_required(facet.cell(), facet.index());
        if let Some(facet) = failures.facets.iter().find(is_free) {
            let cell = CellId::new(facet.cell().get());
            return Err(Damage::NotDelaunay { cell, corner: facet.index() }.into());
        }
        let mut done = SWEPT;
        if G::HAS_WEIGHTS {
            self.enter_hidden(below, &mut part_of(monitor, SWEPT, HIDDEN))?;
            done = HIDDEN;
        }
        for first in (0..failures.ghosts.len()).step_by(ENTERED) {
            go_on(monitor, done + (1.0 - done) * first as f64 / failures.ghosts.len() as f64)?;
            failures.open_ghosts.clear();
            let some = failures.ghosts[first..].iter().take(ENTERED);
            failures.open_ghosts.extend(some);
            self.check_ridges(&mut failures, |_| None)?;
            if let Some(ridge) = failures.ridges.first() {
                let behind = self.complex.cell(ridge.cell()).neighbour(Self::LAST).cell();
                return Err(Damage::NotConvex { cell: CellId::new(behind.get()) }.into());
            }
        }
        if self.winds_once(&failures.ghosts) { Ok(()) } else { Err(Damage::NotATriangulation.into()) }
    }
}
