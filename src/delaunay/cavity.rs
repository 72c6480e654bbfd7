//! Insertion (Bowyer 10.1093/comjnl/24.2.162, Watson 10.1093/comjnl/24.2.167): *dig* the zone of cells in conflict
//! with the new site, then *fill* it with the cells that join its rim to the site.
//!
//! The conflict zone is connected and star-shaped as seen from the site, because signs are exact and ties are
//! broken consistently; a rim facet keeps the corners of the dead cell it comes from, with the site in place of
//! the corner that goes, so the new cell is positively oriented and its ghost corner is last without any
//! permutation.
//!
//! To glue the new cells to each other, every ridge of the rim must find its second facet. In the plane the ridge
//! is a site; in space it is an edge, looked up in a small square table over local labels. A label is kept in the
//! site's `cell` field, which the insertion overwrites anyway.
//!
//! Cost: in expectation 6 cells made and 4 deleted in the plane, about 27 and 20 in space, with one in-sphere test
//! for each deleted cell and each rim facet.

use super::{Delaunay, Dimension};
use crate::complex::{Corners, Facet, NONE};
use crate::error::Result;

/// What an insertion found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Insertion {
    /// The site is in the triangulation.
    New,
    /// This site was at the place already; nothing has changed.
    Coincident(u32),
}

/// A facet of the conflict zone's rim.
#[derive(Clone, Copy, Debug)]
struct Rim<C> {
    /// Corners of the new cell.
    corners: C,
    /// The facet seen from outside the zone.
    out: Facet,
    /// Index of the new site in `corners`.
    at: u32,
}

const IN_ZONE: u8 = 1;
/// Sites that the small table of ridges can label.
const MAX_LABELS: usize = 64;

/// Scratch memory of insertions.
#[derive(Debug)]
pub(super) struct Cavity<G: Dimension> {
    zone: Vec<u32>,
    rim: Vec<Rim<G::Corners>>,
    cells: Vec<u32>,
    local: Vec<[u32; 4]>,
    labels: Vec<u32>,
    ridges: Vec<u32>,
    /// Cells crossed by the walks so far.
    pub(super) steps: u64,
}

impl<G: Dimension> Default for Cavity<G> {
    fn default() -> Self {
        Cavity {
            zone: Vec::new(),
            rim: Vec::new(),
            cells: Vec::new(),
            local: Vec::new(),
            labels: Vec::new(),
            ridges: vec![0; if G::D == 3 { MAX_LABELS * MAX_LABELS } else { 0 }],
            steps: 0,
        }
    }
}

/// For corners `i`, `j` of a tetrahedron, the other two in the order that makes `(i, j, k, l)` even.
const EVEN: [[(usize, usize); 4]; 4] = [
    [(0, 0), (2, 3), (3, 1), (1, 2)],
    [(3, 2), (0, 0), (0, 3), (2, 0)],
    [(1, 3), (3, 0), (0, 0), (0, 1)],
    [(2, 1), (0, 2), (1, 0), (0, 0)],
];

impl<G: Dimension> Delaunay<G> {
    /// Inserts a site that has been added, walking from the cell `near`. There must be cells, and the filter must
    /// cover the site.
    pub(super) fn insert_into_cells(&mut self, s: u32, near: u32) -> Result<Insertion> {
        let (q, id) = (self.site(s).point, self.site(s).id);
        let mut steps = 0;
        let start = self.walk(&self.filter, &q, near, &mut steps);
        self.cavity.steps += steps;
        if let Some(t) = self.corner_at(start, &q) {
            return Ok(Insertion::Coincident(t));
        }
        let mut cavity = std::mem::take(&mut self.cavity.zone);
        let mut rim = std::mem::take(&mut self.cavity.rim);
        self.dig(start, s, &q, id, &mut cavity, &mut rim);
        let filled = self.fill(s, &cavity, &rim);
        self.cavity.zone = cavity;
        self.cavity.rim = rim;
        filled?;
        Ok(Insertion::New)
    }

    /// Finds the conflict zone of `q` from one cell of it, and its rim.
    #[inline(always)]
    fn dig(&mut self, start: u32, s: u32, q: &G::Point, id: u32, zone: &mut Vec<u32>, rim: &mut Vec<Rim<G::Corners>>) {
        zone.clear();
        rim.clear();
        zone.push(start);
        self.complex.set_mark(start, IN_ZONE);
        let mut next = 0;
        while next < zone.len() {
            let cell = *self.complex.cell(zone[next]);
            next += 1;
            for i in 0..G::Corners::N {
                let out = cell.neighbour(i);
                if self.complex.mark(out.cell()) == IN_ZONE {
                    continue;
                }
                if self.is_in_conflict(out.cell(), q, id) {
                    self.complex.set_mark(out.cell(), IN_ZONE);
                    zone.push(out.cell());
                } else {
                    rim.push(Rim { corners: cell.corners.with(i, s), out, at: i as u32 });
                }
            }
        }
    }

    /// Replaces the zone by the cells that join its rim to the site.
    #[inline(always)]
    fn fill(&mut self, s: u32, zone: &[u32], rim: &[Rim<G::Corners>]) -> Result<()> {
        if let Err(error) = self.complex.reserve(rim.len()) {
            for &c in zone {
                self.complex.set_mark(c, 0);
            }
            return Err(error);
        }
        for &c in zone {
            self.complex.retire(c);
        }
        // The k-th rim facet gets the k-th cell of the zone, whose memory is at hand, then new ones.
        for &c in zone.iter().skip(rim.len()) {
            self.complex.release(c);
        }
        let mut cells = std::mem::take(&mut self.cavity.cells);
        cells.clear();
        for (k, facet) in rim.iter().enumerate() {
            let cell = match zone.get(k) {
                Some(&c) => {
                    self.complex.put(c, facet.corners);
                    c
                }
                None => self.complex.create(facet.corners),
            };
            self.complex.glue(Facet::new(cell, facet.at as usize), facet.out);
            cells.push(cell);
        }
        if G::D == 2 {
            self.glue_around_2(rim, &cells);
        } else {
            self.glue_around_3(rim, &cells);
        }
        self.recent = cells[0];
        self.sites[s as usize].cell = cells[0];
        self.cavity.cells = cells;
        Ok(())
    }

    /// Around the site each new triangle starts at one site of the rim and ends at another: the one that starts
    /// where this one ends is its neighbour.
    #[inline(always)]
    fn glue_around_2(&mut self, rim: &[Rim<G::Corners>], cells: &[u32]) {
        for (facet, &cell) in rim.iter().zip(cells) {
            let (start, end) = ((facet.at as usize + 1) % 3, (facet.at as usize + 2) % 3);
            self.sites[facet.corners[start] as usize].cell = Facet::new(cell, end).code();
        }
        for (facet, &cell) in rim.iter().zip(cells) {
            let (start, end) = ((facet.at as usize + 1) % 3, (facet.at as usize + 2) % 3);
            let next = Facet::from_code(self.sites[facet.corners[end] as usize].cell);
            self.complex.glue(Facet::new(cell, start), next);
        }
        for (facet, &cell) in rim.iter().zip(cells) {
            let start = (facet.at as usize + 1) % 3;
            self.sites[facet.corners[start] as usize].cell = cell;
        }
    }

    /// Each edge of the rim is seen once in each direction: the facet that sees it as `kl` meets the one that sees
    /// it as `lk`.
    #[inline(always)]
    fn glue_around_3(&mut self, rim: &[Rim<G::Corners>], cells: &[u32]) {
        let mut local = std::mem::take(&mut self.cavity.local);
        local.clear();
        let labels = &mut self.cavity.labels;
        labels.clear();
        for facet in rim {
            let mut label = [0u32; 4];
            for i in 0..4 {
                if i != facet.at as usize {
                    let site = &mut self.sites[facet.corners[i] as usize];
                    let l = site.cell as usize;
                    if l >= labels.len() || labels[l] != facet.corners[i] {
                        site.cell = labels.len() as u32;
                        labels.push(facet.corners[i]);
                    }
                    label[i] = site.cell;
                }
            }
            local.push(label);
        }
        if labels.len() <= MAX_LABELS {
            let ridges = &mut self.cavity.ridges;
            for ((facet, &cell), label) in rim.iter().zip(cells).zip(&local) {
                let i = facet.at as usize;
                for j in (0..4).filter(|&j| j != i) {
                    let (k, l) = EVEN[i][j];
                    ridges[label[k] as usize * MAX_LABELS + label[l] as usize] = Facet::new(cell, j).code();
                }
            }
            for ((facet, &cell), label) in rim.iter().zip(cells).zip(&local) {
                let i = facet.at as usize;
                for j in (0..4).filter(|&j| j != i) {
                    let (k, l) = EVEN[i][j];
                    let meets = ridges[label[l] as usize * MAX_LABELS + label[k] as usize];
                    self.complex.set_neighbour(Facet::new(cell, j), Facet::from_code(meets));
                }
            }
        } else {
            self.glue_sorted(rim, cells, &local);
        }
        for (facet, &cell) in rim.iter().zip(cells) {
            for i in (0..4).filter(|&i| i != facet.at as usize) {
                self.sites[facet.corners[i] as usize].cell = cell;
            }
        }
        self.cavity.local = local;
    }

    /// As the table, for zones with too many sites: the two facets of an edge are neighbours in sorted order.
    #[cold]
    fn glue_sorted(&mut self, rim: &[Rim<G::Corners>], cells: &[u32], local: &[[u32; 4]]) {
        let mut ridges: Vec<(u64, Facet)> = Vec::with_capacity(3 * rim.len());
        for ((facet, &cell), label) in rim.iter().zip(cells).zip(local) {
            let i = facet.at as usize;
            for j in (0..4).filter(|&j| j != i) {
                let (k, l) = EVEN[i][j];
                let (low, high) = (label[k].min(label[l]), label[k].max(label[l]));
                ridges.push((u64::from(low) << 32 | u64::from(high), Facet::new(cell, j)));
            }
        }
        ridges.sort_unstable();
        for pair in ridges.chunks_exact(2) {
            debug_assert_eq!(pair[0].0, pair[1].0);
            self.complex.glue(pair[0].1, pair[1].1);
        }
    }

    /// Inserts a site that has been added; `near` is a cell to walk from, [`NONE`] for any. A coincident site is
    /// dropped; after an error the site is live and in no cell.
    pub fn insert_site(&mut self, s: u32, near: u32) -> Result<Insertion> {
        let q = self.site(s).point;
        self.cover(&q, &q);
        let inserted = if self.has_cells() {
            self.insert_into_cells(s, if near == NONE { self.recent } else { near })
        } else {
            self.insert_flat(s)
        };
        if matches!(inserted, Ok(Insertion::Coincident(_))) {
            self.drop_site(s);
        }
        inserted
    }
}
