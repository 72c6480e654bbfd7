//! All sites at once: the static triangulation.
//!
//! Sites along a Hilbert curve are inserted in rounds (see [`order`](super::order)), each by a walk from the site
//! before it to a cell that is in conflict with it. Rebuilding keeps the storage order of the sites, which small
//! motions spoil little; the mean distance of sites that are next to each other in storage tells when to sort again.

use super::{Delaunay, Geometry, Site};
use crate::complex::INFINITE;
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::predicates::distance_above;

/// A vertex that is hidden by one of a lower [key](super::keys) at the same place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Merge {
    /// The id of the vertex.
    pub hidden: VertexId,
    /// The site at which it is.
    pub site: SiteId,
}

/// Distances of sites next to each other in storage of which the mean is taken.
const STRIDES: usize = 1024;

/// From this number on, cells do not fit in a core's own cache.
const LARGE: usize = 1 << 15;

/// Cells between free ones where several threads will flip.
const GAP_AFTER: usize = 63;

/// After how many cells there is a free one, for this number of ranges in which to flip: each needs free cells of its own
/// in space.
fn gap_after<G: Geometry>(n_ranges: usize) -> usize {
    if G::D == 3 && n_ranges > 1 { GAP_AFTER } else { usize::MAX }
}

impl<G: Geometry> Delaunay<G> {
    /// Adds a site for each of the points to a triangulation without any, be it an [empty](Self::empty_on) one: along a
    /// Hilbert curve, each with the index of its point for id, and with the sign of zeros made positive.
    /// [`rebuild`](Self::rebuild) must follow.
    pub fn add_sites(&mut self, points: &[G::Point]) -> Result<()> {
        let n = points.len();
        let site = |item: u32| {
            let mut point = points[item as usize];
            for axis in 0..G::NUMBERS {
                point[axis] += 0.0;
            }
            Site::new(point, VertexId::new(item))
        };
        let (parts, sorted) = self.in_parts(0..n as u32, n, |i| &points[i as usize])?;
        self.begin_sites(n)?;
        let n_threads = self.threads.for_work(sorted.len(), 1, 1);
        for keyed in &sorted {
            memory::extend(&mut self.sites, keyed, n_threads, |k| site(k.item()))?;
        }
        self.parts = parts;
        Ok(())
    }

    /// Triangulates the live sites from nothing. Coincident sites are dropped in favour of the lowest id and reported.
    /// `monitor` is called with the fraction done; if it returns `false`, the cells are left half made.
    pub fn rebuild(&mut self, monitor: &mut dyn FnMut(f64) -> bool) -> Result<Vec<Merge>> {
        self.flat.clear();
        if let Some(coincident) = self.triangulate_parts(monitor)? {
            return self.merge(coincident);
        }
        if let Some(order) = self.spanning_order()? {
            let coincident = self.triangulate(&order, order.len(), monitor)?;
            return self.merge(coincident);
        }
        self.complex.clear();
        let mut coincident = Vec::new();
        for s in SiteId::range(1..self.sites.len()) {
            self.sites[s].cell = Slot::NONE;
            if !self.site(s).is_live() {
                continue;
            }
            let q = self.site(s).point;
            if let Some(t) = self.flat.enter(s, &q)? {
                memory::push(&mut coincident, (s, t))?;
            }
        }
        let mut merges = Vec::new();
        memory::reserve_exact(&mut merges, coincident.len())?;
        memory::reserve(&mut self.free_sites, coincident.len())?;
        for (s, t) in coincident {
            // Without cells an id decides nothing but the name of the site.
            let [other, there] = [s, t].map(|s| self.site(s).id);
            merges.push(Merge { hidden: self.keys.higher(other, there), site: t });
            self.sites[t].id = self.keys.lower(other, there);
            self.drop_site(s);
        }
        self.find_flat_basis(SiteId::NONE);
        Ok(merges)
    }

    /// Drops the sites that found others at their places, and gives those the vertex of the lowest key.
    fn merge(&mut self, coincident: Vec<(SiteId, SiteId)>) -> Result<Vec<Merge>> {
        if coincident.is_empty() {
            return Ok(Vec::new());
        }
        // All are dropped first: a change of id may have to look at every live site. So it is made once for a place.
        let (mut ids, mut merges) = (Vec::new(), Vec::new());
        memory::collect(&mut ids, coincident.iter().map(|&(s, t)| (t, self.site(s).id)))?;
        memory::reserve_exact(&mut merges, coincident.len())?;
        memory::reserve(&mut self.free_sites, coincident.len())?;
        for &(s, _) in &coincident {
            self.drop_site(s);
        }
        let keys = &self.keys;
        ids.sort_unstable_by(|(s, v), (t, w)| s.cmp(t).then_with(|| keys.order_of(*v, *w)));
        for there in ids.chunk_by(|(t, _), (other, _)| t == other) {
            let (site, lowest) = there[0];
            let before = self.site(site).id;
            let hidden = self.keys.higher(lowest, before);
            if hidden == before {
                self.rename_site(site, lowest)?;
            }
            // All but the lowest are hidden, in its place the one that was there.
            let of_lowest = Merge { hidden, site };
            merges.push(of_lowest);
            merges.extend(there[1..].iter().map(|&(_, hidden)| Merge { hidden, site }));
        }
        Ok(merges)
    }

    /// Puts the cells in the order of the sites, so that what is near in space is near in memory for sweeps over all: a
    /// build leaves them in the order of its insertion rounds, and what flips and placements make is where there is
    /// room. Once after each build, and again when they are [disordered](Self::is_disordered); large sets gain, by half
    /// and more, and several threads need it to have cells of their own.
    ///
    /// Returns the new slot of each, [`Slot::NONE`] for free ones, unless they stay as they are.
    pub(crate) fn sort_cells(&mut self, replaced: f64) -> Result<Option<Vec<Slot>>> {
        let n_slots = self.complex.n_slots();
        let n_ranges = self.flipping_ranges(n_slots);
        if self.is_sorted && !self.is_disordered(replaced) || n_slots < LARGE && n_ranges == 1 {
            return Ok(None);
        }
        // With free slots between there are more.
        let room = self.room_to_renumber_cells_below(n_slots + n_slots / GAP_AFTER + 1)?;
        let index = self.complex.sort(self.sites.len(), gap_after::<G>(n_ranges))?;
        self.renumber_cells_below(&index, room);
        for site in &mut self.sites {
            if site.cell != Slot::NONE {
                site.cell = index[site.cell];
            }
        }
        self.recent = index[self.recent];
        (self.is_sorted, self.n_replaced) = (true, 0);
        Ok(Some(index))
    }

    /// Whether the number of cells replaced since they were sorted exceeds `replaced` times the number of slots, in a
    /// set so large that order counts.
    pub(crate) fn is_disordered(&self, replaced: f64) -> bool {
        let n_slots = self.complex.n_slots();
        n_slots >= LARGE && self.n_replaced as f64 > replaced * n_slots as f64
    }

    /// In how many ranges to flip, of this number of cells.
    fn flipping_ranges(&self, n_cells: usize) -> usize {
        self.threads.parts_of(n_cells, LARGE, LARGE / 64)
    }

    /// A copy without memory for what is gone, in which the vertices have other ids, `n_ids` in all and in the same order:
    /// those listed by the old ones. Sites and cells are sorted. Also the new slot of each cell, [`Slot::NONE`] for free ones.
    pub(crate) fn compacted(&self, ids: &[VertexId], n_ids: usize) -> Result<(Self, Vec<Slot>)> {
        let sites = &self.sites;
        let n = sites.len() - 1 - self.free_sites.len();
        let (parts, keyed) =
            self.in_parts(self.live_sites().map(SiteId::get), n, |s| &sites[s as usize].point)?;
        let mut names = Vec::new();
        memory::reserve_exact(&mut names, sites.len())?;
        names.resize(sites.len(), SiteId::NONE);
        names[INFINITE] = INFINITE;
        for (name, k) in SiteId::range(1..n + 1).zip(keyed.iter().flatten()) {
            names[k.item() as usize] = name;
        }
        let n_cells = self.complex.n_finite() + self.complex.n_ghosts();
        let gap_after = gap_after::<G>(self.flipping_ranges(n_cells));
        let (complex, index) = self.complex.compacted(n + 1, gap_after, &names)?;
        let flat = self.flat.renamed(&names)?;
        // Without cells the ghost vertex may still name one.
        let cell_of = |site: &Site<G>| index.get(site.cell.index()).copied().unwrap_or(Slot::NONE);
        let mut sorted = Vec::new();
        memory::reserve_exact(&mut sorted, n + 1)?;
        let ghost = &sites[INFINITE];
        sorted.push(Site { cell: cell_of(ghost), ..*ghost });
        sorted.extend(keyed.iter().flatten().map(|k| {
            let site = &sites[k.item() as usize];
            Site { point: site.point, cell: cell_of(site), id: ids[site.id] }
        }));
        let mut t = Delaunay {
            sites: sorted,
            parts,
            flat,
            is_sorted: true,
            relocated: SiteId::NONE,
            recent: index.get(self.recent.index()).copied().unwrap_or(Slot::new(0)),
            complex,
            keys: self.keys.renumbered(ids, n_ids)?,
            certificates: self.certificates,
            link_sites: self.link_sites,
            threads: self.threads,
            ..Delaunay::empty()
        };
        t.tighten_filter();
        if t.has_cells() {
            t.list_hidden()?;
            t.settle(|_| Ok(()))?;
        }
        Ok((t, index))
    }

    /// Mean distance of sites from the next ones in storage, of a sample: small while storage follows a curve.
    pub(crate) fn mean_stride(&self) -> f64 {
        let sites = &self.sites[1..];
        let step = (sites.len() / STRIDES).max(1);
        let (mut sum, mut n) = (0.0, 0.0);
        let mut rest = sites;
        while let [first, second, ..] = rest {
            if first.is_live() && second.is_live() {
                sum += distance_above(&first.point, &second.point);
                n += 1.0;
            }
            rest = rest.get(step..).unwrap_or_default();
        }
        if n > 0.0 { sum / n } else { 0.0 }
    }
}
