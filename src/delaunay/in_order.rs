//! The order of cells after a build, which does not tell how many threads have built them.

use super::build::{Merge, gap_after};
use super::{Delaunay, Dimension};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::machine::memory;

impl<G: Dimension> Delaunay<G> {
    /// What the corners of cells are called if they are called what they are.
    pub(super) fn own_names(&self) -> Result<Vec<SiteId>> {
        let mut names = Vec::new();
        memory::reserve_exact(&mut names, self.sites.len())?;
        names.extend(SiteId::range(0..self.sites.len()));
        Ok(names)
    }

    /// [Merges](Self::merge) coincident sites of cells that have been built, and puts these in order.
    pub(super) fn merge_in_order(
        &mut self,
        names: Vec<SiteId>,
        mut coincident: Vec<(SiteId, SiteId)>,
    ) -> Result<Vec<Merge>> {
        self.put_in_order(names, &mut coincident)?;
        if coincident.is_empty() {
            return Ok(Vec::new());
        }
        // Where the lowest vertex of a place had not been in the cells, ties have been broken again.
        let mut merges = self.merge(coincident)?;
        merges.sort_unstable_by_key(|merge| (merge.site, merge.hidden));
        if let Some(wrapping) = &mut self.wrapping {
            wrapping.forget_failures();
        }
        self.put_in_order(self.own_names()?, &mut [])?;
        Ok(merges)
    }

    /// Puts the cells that have been built, and their corners, in the order that is a function of the cells: how many
    /// threads have built them does not show any more. The sites of the cells get these names. Of coincident sites, the
    /// second of each pair in the cells, the lowest one is there afterwards, with the vertex by which ties have been broken.
    pub(super) fn put_in_order(
        &mut self,
        mut names: Vec<SiteId>,
        coincident: &mut [(SiteId, SiteId)],
    ) -> Result<()> {
        coincident.sort_unstable_by_key(|&(s, t)| (t, s));
        let mut lowered = Vec::new();
        memory::reserve_exact(&mut lowered, coincident.len())?;
        for pairs in coincident.chunk_by_mut(|(_, t), (_, other)| t == other) {
            let (first, t) = pairs[0];
            if first < t {
                lowered.push((t, first));
                pairs[0].0 = t;
                pairs.iter_mut().for_each(|pair| pair.1 = first);
            }
        }
        if !lowered.is_empty() {
            lowered.sort_unstable();
            for &(t, first) in &lowered {
                let [a, b] = [t, first].map(|s| self.sites[s].id);
                (self.sites[t].id, self.sites[first].id) = (b, a);
            }
            for name in &mut names {
                if let Ok(at) = lowered.binary_search_by_key(name, |&(t, _)| t) {
                    *name = lowered[at].1;
                }
            }
        }
        coincident.sort_unstable();
        let n_cells = self.complex.n_finite() + self.complex.n_ghosts();
        let gap_after = gap_after::<G>(self.is_flipping_shared(n_cells));
        self.complex.put_in_order(self.sites.len(), gap_after, |s| names[s])?;
        self.sites.iter_mut().for_each(|site| site.cell = Slot::NONE);
        for c in (0..self.complex.n_slots()).rev().map(Slot::at) {
            if !self.complex.is_free(c) {
                let corners = self.complex.cell(c).corners;
                corners.as_ref().iter().for_each(|&s| self.sites[s].cell = c);
            }
        }
        let n_ghosts = self.complex.n_ghosts();
        self.recent = Slot::at(n_ghosts + n_ghosts / gap_after);
        (self.is_sorted, self.n_replaced) = (true, 0);
        Ok(())
    }
}
