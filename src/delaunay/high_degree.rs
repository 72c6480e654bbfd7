//! Removal of a vertex of high degree: gift wrapping, which is quadratic in the degree, would be too slow.
//!
//! The cells that fill the hole are cells of the Delaunay triangulation of the link's sites: their spheres are empty
//! of all sites but the removed one, so of those of the link. Triangulate the link, start behind each facet of the
//! hole, and take every cell that is reached without crossing the hole's frontier.

use std::collections::HashMap;

use super::{Delaunay, Dimension};
use crate::complex::{Corners, Facet, INFINITE};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;
use crate::machine::threads::Threads;

impl<G: Dimension> Delaunay<G> {
    /// Fills the hole of the gathered star by the triangulation of its link. After an error nothing has changed.
    #[cold]
    pub(super) fn remove_high_degree(&mut self) -> Result<()> {
        self.link_sites += self.hole.sites.len() as u64;
        let made = self.cells_of_link()?;
        // Orientation is part of a facet seen from one side: the two sides have their sorted corners in common.
        let mut sides: Vec<(G::Corners, Facet)> = Vec::new();
        memory::reserve_exact(&mut sides, self.hole.link.len() + made.len() * G::Corners::N)?;
        sides.extend(self.hole.link.iter().map(|gap| (sorted_without(gap.corners, gap.at), gap.out)));
        self.reserve_record(made.len())?;
        self.complex.reserve(made.len())?;
        self.complex.note_all(self.hole.star.iter().map(|&(c, _)| c))?;
        self.complex.reserve_rows(made.len())?;
        let star = std::mem::take(&mut self.hole.star);
        for &(c, _) in &star {
            self.complex.retire(c);
            self.complex.release(c);
        }
        self.hole.star = star;
        for corners in made {
            let cell = self.complex.create(corners);
            for i in 0..G::Corners::N {
                sides.push((sorted_without(corners, i), Facet::new(cell, i)));
                self.sites[corners[i]].cell = cell;
            }
            self.recent = cell;
            self.record([cell]);
        }
        sides.sort_unstable();
        for pair in sides.chunks_exact(2) {
            debug_assert_eq!(pair[0].0, pair[1].0);
            self.complex.glue(pair[0].1, pair[1].1);
        }
        debug_assert!(sides.len().is_multiple_of(2));
        Ok(())
    }

    /// Corners of the cells that fill the hole.
    fn cells_of_link(&self) -> Result<Vec<G::Corners>> {
        let mut local = Delaunay::<G>::on(Threads::ONE)?;
        local.reserve_sites(self.hole.sites.len())?;
        let mut by_id = Vec::new();
        memory::reserve_exact(&mut by_id, self.hole.sites.len())?;
        for &s in self.hole.sites.iter().filter(|&&s| s != INFINITE) {
            local.add_site(self.site(s).point, self.site(s).id)?;
            by_id.push((self.site(s).id, s));
        }
        by_id.sort_unstable();
        local.sort_sites()?;
        local.rebuild(&mut |_| true)?;
        let mut made = Vec::new();
        if !local.has_cells() {
            // The link is in one hyperplane: each finite facet of it is on the new hull.
            let finite_facets =
                self.hole.link.iter().filter(|g| g.at == Self::LAST || g.corners[Self::LAST] != INFINITE);
            let ghosts = finite_facets.map(|g| g.corners.with(g.at, INFINITE).rotated_to_last(g.at));
            memory::collect(&mut made, ghosts)?;
            return Ok(made);
        }
        // The site of each local one.
        let mut globals = Vec::new();
        memory::reserve_exact(&mut globals, local.sites.len())?;
        globals.push(INFINITE);
        globals.extend(local.sites[1..].iter().map(|site| {
            let at = by_id.binary_search_by_key(&site.id, |&(id, _)| id).expect("a site of the link");
            by_id[at].1
        }));
        let global = |s: SiteId| globals[s];
        let mut rim: HashMap<G::Corners, (G::Corners, usize)> = HashMap::new();
        memory::reserve_map(&mut rim, self.hole.link.len())?;
        rim.extend(
            self.hole.link.iter().map(|gap| (sorted_without(gap.corners, gap.at), (gap.corners, gap.at))),
        );
        // The local cells inside, which are marked.
        let mut inside = Vec::new();
        for c in Slot::range(0..local.complex.n_slots()).filter(|&c| local.complex.is_live(c)) {
            let corners = map_corners(local.complex.cell(c).corners, global);
            let is_behind = |i: usize| {
                rim.get(&sorted_without(corners, i)).is_some_and(|&(facing, at)| {
                    // On the inner side the apex takes the removed site's place without a reflection.
                    is_even(facing.with(at, corners[i]), corners)
                })
            };
            if (0..G::Corners::N).any(is_behind) {
                memory::push(&mut inside, c)?;
            }
        }
        for &c in &inside {
            local.complex.set_mark(c, 1);
        }
        let mut next = 0;
        while let Some(&c) = inside.get(next) {
            next += 1;
            let corners = map_corners(local.complex.cell(c).corners, global);
            for i in 0..G::Corners::N {
                let beyond = local.complex.cell(c).neighbour(i).cell();
                if local.complex.mark(beyond) == 0 && !rim.contains_key(&sorted_without(corners, i)) {
                    local.complex.set_mark(beyond, 1);
                    memory::push(&mut inside, beyond)?;
                }
            }
        }
        let corners_of = |&c: &Slot| map_corners(local.complex.cell(c).corners, global);
        memory::collect(&mut made, inside.iter().map(corners_of))?;
        Ok(made)
    }
}

fn map_corners<C: Corners>(mut corners: C, f: impl Fn(SiteId) -> SiteId) -> C {
    for s in corners.as_mut() {
        *s = f(*s);
    }
    corners
}

/// The corners without the one at `i`, sorted; the freed entry is set to a value that no site has.
fn sorted_without<C: Corners>(corners: C, i: usize) -> C {
    let mut facet = corners.with(i, SiteId::NONE);
    facet.as_mut().sort_unstable();
    facet
}

/// Whether two orders of the same corners have the same orientation.
fn is_even<C: Corners>(mut a: C, b: C) -> bool {
    let mut even = true;
    for i in 0..C::N {
        if a[i] != b[i] {
            let j = (i + 1..C::N).find(|&j| a[j] == b[i]).expect("the same corners");
            a.as_mut().swap(i, j);
            even = !even;
        }
    }
    even
}
