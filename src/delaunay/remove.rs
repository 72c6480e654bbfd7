//! Removal: take the star away and fill the hole by gift wrapping.
//!
//! Every facet of the hole's frontier has exactly one cell of the new triangulation on its inner side, and the apex
//! of that cell is one of the link's sites: the one whose sphere with the facet has no other link site inside.
//! One pass over the link finds it, by keeping the best so far. A frontier facet with no link site on its inner
//! side lies on the new convex hull and gets a ghost cell. Facets that hold the ghost vertex are never wrapped: each
//! is met by the ghost cell of a finite facet.
//!
//! So it is done where signs have to be exact. Mostly they need not be: then the filling is found in doubles, four
//! sites at a time, and certified as a whole ([`wrapping`](super::wrapping)).
//!
//! Cost: with `k` link sites, about `2k` cells in space and `k` in the plane, each after at most `k` in-sphere
//! tests. For a vertex of high degree ([`MAX_LINK`] sites and more) `high_degree` triangulates the link instead.
//!
//! Invariant: the complex is not touched before the whole filling is known.

use super::flat::Flat;
use super::hole::{FacetsOf, Gap, Hole, MAX_LINK, NEW, new_of};
use super::{Delaunay, Geometry};
use crate::complex::{Corners, Facet, INFINITE};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;

impl<G: Geometry> Delaunay<G> {
    /// Removes a live site.
    pub fn remove_site(&mut self, s: SiteId) -> Result<()> {
        self.go_on()?;
        self.log_site(s)?;
        if self.is_hidden(s) {
            self.forget_hidden(s);
            self.drop_site(s);
            return Ok(());
        }
        if !self.has_cells() {
            self.remove_flat(s);
            self.drop_site(s);
            return Ok(());
        }
        self.gather_star(s)?;
        self.remove_site_of_star(s)
    }

    /// Removes a live site unless its degree is high, so that its link would have to be triangulated; whether it has.
    pub(crate) fn remove_site_unless_high(&mut self, s: SiteId) -> Result<bool> {
        if !self.has_cells() || self.is_hidden(s) {
            return self.remove_site(s).map(|()| true);
        }
        self.go_on()?;
        self.gather_star(s)?;
        if self.gathered_degree() > MAX_LINK {
            return Ok(false);
        }
        self.log_site(s)?;
        self.remove_site_of_star(s).map(|()| true)
    }

    /// Removes the site whose star has been gathered, and which is logged.
    fn remove_site_of_star(&mut self, s: SiteId) -> Result<()> {
        self.remove_gathered(s)?;
        if self.complex.n_finite() == 0 {
            self.become_flat(s)?;
        }
        self.drop_site(s);
        Ok(())
    }

    /// How many sites of links the removal of a live site would triangulate: none where its degree is not high. A pass
    /// over its star.
    pub(crate) fn link_sites_of(&mut self, s: SiteId) -> Result<usize> {
        if !self.has_cells() || self.is_hidden(s) {
            return Ok(0);
        }
        self.gather_star(s)?;
        Ok(Some(self.gathered_degree()).filter(|&degree| degree > MAX_LINK).unwrap_or(0))
    }

    /// How many sites the link of the gathered star has, the ghost vertex included: it is a sphere.
    fn gathered_degree(&self) -> usize {
        if G::D == 2 { self.star.len() } else { self.star.len() / 2 + 2 }
    }

    /// Removes the site whose star has been gathered from the cells; the site stays live.
    pub(super) fn remove_gathered(&mut self, s: SiteId) -> Result<()> {
        let mut hole = memory::take_made(&mut self.hole)?;
        let removed = self.remove_and_fill(s, &mut hole);
        self.hole = Some(hole);
        if removed.is_ok() {
            self.loosen_star();
        }
        removed
    }

    #[inline(always)]
    fn remove_and_fill(&mut self, s: SiteId, hole: &mut Hole<G>) -> Result<()> {
        self.label_link(hole)?;
        if hole.sites.len() > MAX_LINK {
            self.restore_link_cells();
            return self.remove_high_degree(hole);
        }
        let filled = self.wrap_in_lanes(s, hole).and_then(|is_wrapped| {
            if !is_wrapped {
                self.wrap(hole)?;
            }
            self.reserve_filling(hole)
        });
        if let Err(error) = filled {
            self.restore_link_cells();
            return Err(error);
        }
        self.replace_star(hole);
        if let Some(changed) = &mut self.changed {
            changed.extend_from_slice(&hole.made_at);
        }
        self.sites[s].cell = Slot::NONE;
        Ok(())
    }

    /// Makes sure that the cells of the hole can be replaced.
    fn reserve_filling(&mut self, hole: &mut Hole<G>) -> Result<()> {
        let n = hole.made.len();
        hole.made_at.clear();
        memory::reserve(&mut hole.made_at, n)?;
        self.reserve_record(n)?;
        self.complex.reserve(n)?;
        self.complex.note_all(self.star.iter().map(|&(c, _)| c))?;
        self.complex.reserve_rows(n)
    }

    /// Finds the cells that fill the hole.
    #[inline(never)]
    pub(super) fn wrap(&self, hole: &mut Hole<G>) -> Result<()> {
        hole.open.clear();
        hole.open_ghost.clear();
        hole.made.clear();
        memory::reserve(&mut hole.open, hole.link.len())?;
        memory::reserve(&mut hole.open_ghost, hole.link.len())?;
        let bit = |sites: &[super::Site<G>], v: SiteId| 1u64 << sites[v].cell.get();
        for gap in &hole.link {
            let key =
                (0..G::Corners::N).filter(|&i| i != gap.at).map(|i| bit(&self.sites, gap.corners[i])).sum();
            if gap.at != Self::LAST && gap.corners[Self::LAST] == INFINITE {
                hole.open_ghost.push((key, gap.out));
            } else {
                hole.open.push((key, *gap));
            }
        }
        let is_finite = |(label, &x): (usize, &SiteId)| u64::from(x != INFINITE) << label;
        let finite: u64 = hole.sites.iter().enumerate().map(is_finite).sum();
        while let Some((key, gap)) = hole.open.pop() {
            memory::reserve(&mut hole.open, G::D)?;
            memory::reserve(&mut hole.open_ghost, G::D)?;
            memory::reserve(&mut hole.made, 1)?;
            let apex = self.wrap_apex(&hole.sites, finite & !key, &gap);
            let k = Slot::at(NEW + hole.made.len());
            let mut corners = gap.corners.with(gap.at, apex);
            let mut at = gap.at;
            if apex == INFINITE {
                corners = corners.rotated_to_last(at);
                at = Self::LAST;
            }
            hole.made.push((corners, FacetsOf::<G>::filled(Facet::NONE)));
            let made = &mut hole.made;
            let mut glue = |a: Facet, b: Facet| {
                for (x, y) in [(a, b), (b, a)] {
                    if let Some(new) = new_of(x) {
                        made[new].1[x.index()] = y;
                    }
                }
            };
            glue(Facet::new(k, at), gap.out);
            // Outer cells learn of their new neighbours when the cells are put; within the hole both sides are new.
            let whole = key | bit(&self.sites, apex);
            for i in (0..G::Corners::N).filter(|&i| i != at) {
                let key = whole & !bit(&self.sites, corners[i]);
                let facet = Facet::new(k, i);
                if apex == INFINITE {
                    match hole.open_ghost.iter().position(|o| o.0 == key) {
                        Some(o) => glue(facet, hole.open_ghost.swap_remove(o).1),
                        None => hole.open_ghost.push((key, facet)),
                    }
                } else {
                    match hole.open.iter().position(|o| o.0 == key) {
                        Some(o) => glue(facet, hole.open.swap_remove(o).1.out),
                        None => {
                            hole.open.push((key, Gap { corners: corners.reflected(i), at: i, out: facet }))
                        }
                    }
                }
            }
        }
        debug_assert!(hole.open_ghost.is_empty());
        Ok(())
    }

    /// The corner of the new cell on the inner side of a finite frontier facet, which is one of those sites of the link
    /// that are in the set `left`.
    fn wrap_apex(&self, link: &[SiteId], mut left: u64, gap: &Gap<G::Corners>) -> SiteId {
        let mut best = INFINITE;
        let mut cell = gap.corners;
        while left != 0 {
            let x = link[left.trailing_zeros() as usize];
            left &= left - 1;
            let site = self.site(x);
            let is_closer =
                best == INFINITE || G::is_in_sphere(&self.filter, self.view(), &cell, &site.point, site.id);
            if is_closer
                && G::orientation_with(&self.filter, self.view(), &gap.corners, gap.at, &site.point) > 0.0
            {
                best = x;
                cell[gap.at] = x;
                left = G::drop_outside(&self.filter, self.view(), &cell, link, left);
            }
        }
        best
    }

    /// Puts the cells of `made`, for which there is room, in the place of the star.
    #[inline(always)]
    fn replace_star(&mut self, hole: &mut Hole<G>) {
        let Self { complex, star, .. } = self;
        for &(c, _) in &*star {
            complex.retire(c);
        }
        for &(c, _) in star.iter().skip(hole.made.len()) {
            complex.release(c);
        }
        hole.made_at.extend(star.iter().take(hole.made.len()).map(|&(c, _)| c));
        let near = star[0].0;
        hole.made_at.extend((star.len()..hole.made.len()).map(|_| complex.create_blank(near)));
        for (&cell, &(corners, mut neighbours)) in hole.made_at.iter().zip(&hole.made) {
            for (i, facet) in neighbours.as_mut().iter_mut().enumerate() {
                match new_of(*facet) {
                    Some(new) => *facet = Facet::new(hole.made_at[new], facet.index()),
                    None => self.complex.set_neighbour(*facet, Facet::new(cell, i)),
                }
            }
            self.complex.put_whole(cell, corners, neighbours);
            for &corner in corners.as_ref() {
                self.corner_mut(corner).cell = cell;
            }
        }
        self.recent = hole.made_at[0];
    }

    /// Gives up the cells when the last finite one is gone. `except` is a site that is on its way elsewhere. After an
    /// error they are still there.
    pub(super) fn become_flat(&mut self, except: SiteId) -> Result<()> {
        let mut flat = Flat::default();
        for s in self.live_sites().filter(|&s| s != except) {
            flat.enter(s, &self.site(s).point)?;
        }
        self.give_up_cells()?;
        self.forget_all_hidden();
        self.flat = flat;
        self.changed = None;
        self.sites[1..].iter_mut().for_each(|site| site.cell = Slot::NONE);
        self.find_flat_basis(except);
        Ok(())
    }
}
