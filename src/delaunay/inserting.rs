//! Many sites, one after the other: from a first cell on, or into cells that are there.

use super::cavity::Cavity;
use super::geometry::Insert;
use super::order::in_rounds;
use super::{Delaunay, Geometry, Insertion};
use crate::complex::{Corners, INFINITE};
use crate::error::{Error, Result};
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::machine::pace::ASKED_EVERY;
use crate::predicates::{StaticFilter, squared_distance};

/// Insertions between two calls of a monitor, unless they take much [work](ASKED_EVERY).
const MONITORED: usize = 1024;

/// Pairs of sites whose distances tell whether the static filter is weak.
const SAMPLED_PAIRS: usize = 64;

/// The static filter is weak, as it decides little, where its bound exceeds this share of the determinant of a cell as
/// large as the spacing.
const WEAK_SHARE: f64 = 1.0 / 256.0;

impl<G: Geometry> Delaunay<G> {
    /// The live sites in the order in which to insert them, if a basis of `D + 1` is among them, from which
    /// [`triangulate`](Self::triangulate) starts.
    pub(super) fn spanning_order(&mut self) -> Result<Option<Vec<SiteId>>> {
        self.tighten_filter();
        let order = in_rounds::<G>(self.live_sites())?;
        let is_spanning = order.iter().any(|&s| self.extend_basis(s));
        Ok(is_spanning.then_some(order))
    }

    /// For how many cells there is room in a build of `n` sites; only few sets have more. In the plane there are not
    /// quite two for each site. In space Poisson points have 6.77, hulls and rounds need a little more, and a few sites
    /// never have as many.
    pub(super) fn n_cells_of(n: usize) -> usize {
        let most = if G::D == 2 { 2 * n } else { (n + 1).saturating_mul(n.saturating_sub(2)) / 2 };
        most.min(7 * n + (4 * n).min(64))
    }

    /// Builds the cells of all live sites, given in insertion order, from a basis of `D + 1` on, with room for `n`
    /// sites; returns pairs of coincident sites, the second in the cells.
    pub(super) fn triangulate(
        &mut self,
        order: &[SiteId],
        n: usize,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Vec<(SiteId, SiteId)>> {
        let coincident = self.triangulate_shown(order, n, monitor)?;
        self.find_hidden()?;
        Ok(coincident)
    }

    /// As [`triangulate`](Self::triangulate), but where the hidden sites are is left to be [found](Self::find_hidden).
    pub(super) fn triangulate_shown(
        &mut self,
        order: &[SiteId],
        n: usize,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Vec<(SiteId, SiteId)>> {
        self.complex.clear();
        self.forget_all_hidden();
        self.is_sorted = false;
        self.complex.reserve(Self::n_cells_of(n))?;
        for site in &mut self.sites {
            site.cell = Slot::NONE;
        }
        self.start()?;
        self.cavity.steps = 0;
        let filter = self.filter;
        self.filter = self.exact_filter().unwrap_or(filter);
        let inserted = self.insert_all(order, monitor);
        // Vertices may leave the lattice.
        self.filter = filter;
        let coincident = inserted?;
        self.flat.clear();
        Ok(coincident)
    }

    /// Lists the hidden sites anew, after a build, each above its cell.
    pub(super) fn find_hidden(&mut self) -> Result<()> {
        self.forget_all_hidden();
        self.list_hidden()?;
        self.settle(|_| Ok(()))
    }

    /// Bounds for the box of the filter if it and the sites are on a lattice, and few steps of it apart. With keys there are
    /// none: what exact bounds are for, ties that ids decide, would have to ask for keys first.
    fn exact_filter(&self) -> Option<StaticFilter> {
        if !self.keys.are_ids() {
            return None;
        }
        let places = self.sites[1..].iter().filter(|site| site.is_live()).map(|site| &site.point);
        G::exact_filter(&self.lower, &self.upper, places)
    }

    /// Inserts those sites that are in no cell yet; returns pairs of coincident sites, the second in the
    /// cells.
    pub(super) fn insert_all(
        &mut self,
        order: &[SiteId],
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Vec<(SiteId, SiteId)>> {
        debug_assert!(!self.complex.is_recording());
        let is_weak = self.is_filter_weak(order);
        self.cavity.scratch.begin_build(self.complex.n_cells_reserved(), is_weak)?;
        let mut cavity = std::mem::take(&mut self.cavity);
        let inserted = self.insert_each(&mut cavity, order, monitor);
        cavity.scratch.end_build();
        self.cavity = cavity;
        inserted
    }

    /// Whether the static bound is of the order of in-sphere determinants, and so decides little: that of clusters, of
    /// which it spans the whole, or of graded points. A sample of pairs of sites next to each other in `order` tells.
    fn is_filter_weak(&self, order: &[SiteId]) -> bool {
        if self.filter.is_exact {
            return false;
        }
        let step = (order.len() / SAMPLED_PAIRS).max(1);
        let pairs = order.windows(2).step_by(step);
        let (mut n_weak, mut n_pairs) = (0, 0);
        for pair in pairs {
            let [p, q] = [pair[0], pair[1]].map(|s| &self.site(s).point);
            let spacing = squared_distance(p, q).sqrt();
            n_weak += usize::from(WEAK_SHARE * spacing.powi(G::D as i32 + 2) < self.filter.prepared);
            n_pairs += 1;
        }
        2 * n_weak > n_pairs
    }

    fn insert_each(
        &mut self,
        cavity: &mut Cavity<G>,
        order: &[SiteId],
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Vec<(SiteId, SiteId)>> {
        let mut coincident = Vec::new();
        // Cells made, and crossed by walks, since the monitor was called.
        let mut work = 0;
        for (done, &s) in order.iter().enumerate() {
            if done % MONITORED == 0 || work >= ASKED_EVERY {
                work = 0;
                if !monitor(done as f64 / order.len() as f64) {
                    return Err(Error::Cancelled);
                }
            }
            if done % MONITORED == 0 {
                cavity.scratch.adapt();
            }
            let steps = cavity.steps;
            if self.site(s).cell != Slot::NONE {
                continue;
            }
            match self.insert_into_cells::<true>(cavity, s, self.recent)? {
                Insertion::New => {
                    work += cavity.scratch.made().len() as u64;
                    self.record(cavity.scratch.made());
                }
                Insertion::Coincident(t) => memory::push(&mut coincident, (s, t))?,
                Insertion::Hidden(_) => {}
                Insertion::Spans => unreachable!("there are cells"),
            }
            work += cavity.steps - steps;
        }
        Ok(coincident)
    }

    /// The first cell, of the basis, and the ghost cells around it.
    fn start(&mut self) -> Result<()> {
        let mut corners = G::Corners::filled(INFINITE);
        corners.as_mut().copy_from_slice(self.flat.basis.sites());
        if G::orientation(&self.filter, self.view(), &corners) < 0.0 {
            corners.as_mut().swap(0, 1);
        }
        self.complex.start(corners)?;
        self.recent = Slot::new(0);
        for i in 0..G::Corners::N {
            self.sites[corners[i]].cell = Slot::new(0);
        }
        self.sites[INFINITE].cell = Slot::new(1);
        Ok(())
    }
}
