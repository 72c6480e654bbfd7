//! Removal of a hub: a site with so many neighbours that gift wrapping, quadratic in them, is too slow.
//!
//! The cells that fill the hole are cells of the Delaunay triangulation of the link's sites: their spheres are empty
//! of all sites but the removed one, so of those of the link. Triangulate the link, start behind each facet of the
//! hole, and take every cell that is reached without crossing the hole's frontier.

use std::collections::{HashMap, HashSet};

use super::{Delaunay, Dimension};
use crate::complex::{Corners, Facet, INFINITE};
use crate::error::Result;
use crate::threads::Threads;

impl<G: Dimension> Delaunay<G> {
    /// Fills the hole of the gathered star by the triangulation of its link.
    #[cold]
    pub(super) fn remove_hub(&mut self) -> Result<()> {
        let made = self.cells_of_link()?;
        // Orientation is part of a facet seen from one side: the rim is looked up by its sorted corners.
        let mut open: HashMap<G::Corners, Facet> = HashMap::with_capacity(2 * self.hole.link.len());
        for gap in &self.hole.link {
            open.insert(sorted_without(gap.corners, gap.at), gap.out);
        }
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
                let facet = Facet::new(cell, i);
                let key = sorted_without(corners, i);
                match open.remove(&key) {
                    Some(across) => self.complex.glue(facet, across),
                    None => {
                        open.insert(key, facet);
                    }
                }
                self.sites[corners[i] as usize].cell = cell;
            }
            self.recent = cell;
            self.record([cell]);
        }
        debug_assert!(open.is_empty());
        Ok(())
    }

    /// Corners of the cells that fill the hole.
    fn cells_of_link(&self) -> Result<Vec<G::Corners>> {
        let mut local = Delaunay::<G>::on(Threads::ONE)?;
        // Site k + 1 of the link's triangulation is the k-th of these.
        let finite: Vec<u32> = self.hole.sites.iter().copied().filter(|&s| s != INFINITE).collect();
        for &s in &finite {
            local.add_site(self.site(s).point, self.site(s).id)?;
        }
        local.sort_sites()?;
        local.rebuild(&mut |_| true)?;
        let mut at_id = HashMap::with_capacity(finite.len());
        for &s in &finite {
            at_id.insert(self.site(s).id, s);
        }
        let global = |s: u32| if s == INFINITE { INFINITE } else { at_id[&local.site(s).id] };
        let rim: HashMap<G::Corners, (G::Corners, usize)> = self
            .hole
            .link
            .iter()
            .map(|gap| (sorted_without(gap.corners, gap.at), (gap.corners, gap.at)))
            .collect();
        if !local.has_cells() {
            // The link is in one hyperplane: each finite facet of it is on the new hull.
            let finite_facets =
                self.hole.link.iter().filter(|g| g.at == Self::LAST || g.corners[Self::LAST] != INFINITE);
            return Ok(finite_facets.map(|g| g.corners.with(g.at, INFINITE).rotated_to_last(g.at)).collect());
        }
        let mut inside: HashSet<u32> = HashSet::new();
        let mut stack = Vec::new();
        for c in local.complex.live() {
            let corners = map_corners(local.complex.cell(c).corners, global);
            for i in 0..G::Corners::N {
                let Some(&(facing, at)) = rim.get(&sorted_without(corners, i)) else { continue };
                // On the inner side the apex takes the removed site's place without a reflection.
                if is_even(facing.with(at, corners[i]), corners) && inside.insert(c) {
                    stack.push(c);
                }
            }
        }
        while let Some(c) = stack.pop() {
            let corners = map_corners(local.complex.cell(c).corners, global);
            for i in 0..G::Corners::N {
                let next = local.complex.cell(c).neighbour(i).cell();
                if !rim.contains_key(&sorted_without(corners, i)) && inside.insert(next) {
                    stack.push(next);
                }
            }
        }
        Ok(inside.into_iter().map(|c| map_corners(local.complex.cell(c).corners, global)).collect())
    }
}

fn map_corners<C: Corners>(mut corners: C, f: impl Fn(u32) -> u32) -> C {
    for s in corners.as_mut() {
        *s = f(*s);
    }
    corners
}

/// The corners without the one at `i`, sorted; the freed entry is set to a value that no site has.
fn sorted_without<C: Corners>(corners: C, i: usize) -> C {
    let mut facet = corners.with(i, u32::MAX);
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
