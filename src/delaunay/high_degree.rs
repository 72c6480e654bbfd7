//! Removal of a vertex of high degree: gift wrapping, which is quadratic in the degree, would be too slow.
//!
//! The cells that fill the hole are cells of the Delaunay triangulation of the link's sites: their spheres are empty
//! of all sites but the removed one, so of those of the link. Triangulate the link, find one cell behind a facet of the
//! hole, and take every cell that is reached without crossing the hole's frontier. They are all, since the hole is
//! connected, and so it is without its vertices and edges.

use super::facets::{ByCorners, facet_of};
use super::hole::{Gap, Hole};
use super::{Delaunay, Geometry, Shape};
use crate::complex::{Corners, Facet, INFINITE};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::machine::pace::Pace;
use crate::machine::threads::Threads;

/// What is across a facet of a new cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Across {
    /// A cell that stays.
    Old(Facet),
    /// Another new one: its place in their list, and the index of the facet there.
    New(usize, usize),
}

/// New cells, and what is across their facets.
type Filling<C> = Vec<(C, <C as Corners>::Of<Across>)>;

impl<G: Geometry> Delaunay<G> {
    /// Fills the hole of the gathered star by the triangulation of its link. After an error nothing has changed.
    #[cold]
    pub(super) fn remove_high_degree(&mut self, hole: &Hole<G>) -> Result<()> {
        self.link_sites += hole.sites.len() as u64;
        let mut pace = std::mem::take(&mut self.pace);
        let filling = self.filling(hole, &mut pace);
        self.pace = pace;
        let filling = filling?;
        let mut slots = Vec::new();
        memory::reserve_exact(&mut slots, filling.len())?;
        self.reserve_record(filling.len())?;
        self.complex.reserve(filling.len())?;
        self.complex.note_all(self.star.iter().map(|&(c, _)| c))?;
        self.complex.reserve_rows(filling.len())?;
        for &(c, _) in &self.star {
            self.complex.retire(c);
            self.complex.release(c);
        }
        let near = self.star[0].0;
        slots.extend(filling.iter().map(|&(corners, _)| self.complex.create(corners, near)));
        for (&cell, (corners, across)) in slots.iter().zip(&filling) {
            for i in 0..G::Corners::N {
                let other = match across[i] {
                    Across::Old(facet) => facet,
                    Across::New(k, at) => Facet::new(slots[k], at),
                };
                self.complex.glue(Facet::new(cell, i), other);
                self.sites[corners[i]].cell = cell;
            }
        }
        self.recent = slots[0];
        self.record(slots);
        Ok(())
    }

    /// Cells that fill the hole.
    fn filling(&self, hole: &Hole<G>, pace: &mut Pace) -> Result<Filling<G::Corners>> {
        let (local, globals) = self.link_alone(&hole.sites, pace)?;
        if !local.has_cells() {
            return self.flat_filling(&hole.link);
        }
        let corners_of = |c: Slot| map_corners(local.complex.cell(c).corners, |s| globals[s]);
        let mut rim = ByCorners::<G::Corners, (Facet, bool)>::default();
        memory::reserve_map(&mut rim, hole.link.len())?;
        rim.extend(hole.link.iter().map(|gap| {
            let (facet, is_odd) = facet_of(&gap.corners, gap.at);
            (facet, (gap.out, is_odd))
        }));
        // The new cell sees the facet as the removed one did.
        let is_inside = |c: Slot| {
            let corners = corners_of(c);
            (0..G::Corners::N).any(|i| {
                let (facet, is_odd) = facet_of(&corners, i);
                rim.get(&facet).is_some_and(|&(_, rim_is_odd)| rim_is_odd == is_odd)
            })
        };
        let mut live = local.complex.live();
        let first = live.find(|&c| is_inside(c)).expect("a cell behind each facet of the hole");
        // The local cells inside, and the place of each among them.
        let (mut inside, mut places) = (Vec::new(), Vec::new());
        memory::reserve_exact(&mut places, local.complex.n_slots())?;
        places.resize(local.complex.n_slots(), usize::MAX);
        memory::push(&mut inside, first)?;
        places[first.index()] = 0;
        let mut filling = Vec::new();
        while let Some(&c) = inside.get(filling.len()) {
            pace.count(1);
            if pace.is_due() && self.is_in_change() {
                pace.ask_again()?;
            }
            let corners = corners_of(c);
            let mut facets = Of::<G>::filled(Across::Old(Facet::NONE));
            for i in 0..G::Corners::N {
                if let Some(&(out, _)) = rim.get(&facet_of(&corners, i).0) {
                    facets[i] = Across::Old(out);
                    continue;
                }
                let across = local.complex.cell(c).neighbour(i);
                let place = &mut places[across.cell().index()];
                if *place == usize::MAX {
                    *place = inside.len();
                    memory::push(&mut inside, across.cell())?;
                }
                facets[i] = Across::New(*place, across.index());
            }
            memory::push(&mut filling, (corners, facets))?;
        }
        Ok(filling)
    }

    /// The triangulation of the link's sites, and the site of each of its own.
    fn link_alone(&self, link: &[SiteId], pace: &mut Pace) -> Result<(Self, Vec<SiteId>)> {
        let mut local = Delaunay::<G>::on(Threads::ONE)?;
        local.keys = self.keys.another();
        local.reserve_sites(link.len())?;
        let mut by_id = Vec::new();
        memory::reserve_exact(&mut by_id, link.len())?;
        for &s in link.iter().filter(|&&s| s != INFINITE) {
            local.add_site(self.site(s).point, self.site(s).id)?;
            by_id.push((self.site(s).id, s));
        }
        by_id.sort_unstable();
        local.sort_sites()?;
        if let Some(order) = local.spanning_order()? {
            local.triangulate(&order, order.len(), &mut |_| {
                !self.is_in_change() || pace.ask_again().is_ok()
            })?;
        }
        let mut globals = Vec::new();
        memory::reserve_exact(&mut globals, local.sites.len())?;
        globals.push(INFINITE);
        globals.extend(local.sites[1..].iter().map(|site| {
            let at = by_id.binary_search_by_key(&site.id, |&(id, _)| id).expect("a site of the link");
            by_id[at].1
        }));
        Ok((local, globals))
    }

    /// Cells that fill a hole whose link is in one hyperplane: each finite facet of the link is on the new hull.
    fn flat_filling(&self, link: &[Gap<G::Corners>]) -> Result<Filling<G::Corners>> {
        let (mut open, mut filling) = (ByCorners::<G::Corners, Across>::default(), Vec::new());
        memory::reserve_map(&mut open, G::Corners::N * link.len())?;
        memory::reserve_exact(&mut filling, link.len())?;
        for gap in link {
            if gap.at != Self::LAST && gap.corners[Self::LAST] == INFINITE {
                open.insert(facet_of(&gap.corners, gap.at).0, Across::Old(gap.out));
            } else {
                let ghost = gap.corners.with(gap.at, INFINITE).rotated_to_last(gap.at);
                // What is across the other facets, other ghosts, is found below.
                filling.push((ghost, Of::<G>::filled(Across::Old(gap.out))));
            }
        }
        for k in 0..filling.len() {
            for i in 0..Self::LAST {
                let Some(other) = open.insert(facet_of(&filling[k].0, i).0, Across::New(k, i)) else {
                    continue;
                };
                filling[k].1[i] = other;
                if let Across::New(of, at) = other {
                    filling[of].1[at] = Across::New(k, i);
                }
            }
        }
        Ok(filling)
    }
}

/// Of each facet of a cell.
type Of<G> = <<G as Shape>::Corners as Corners>::Of<Across>;

fn map_corners<C: Corners>(mut corners: C, f: impl Fn(SiteId) -> SiteId) -> C {
    for s in corners.as_mut() {
        *s = f(*s);
    }
    corners
}
