//! Who is hidden, and by what, where vertices have weights.
//!
//! Each vertex then has a site of its own, and the kernel knows which ones are in no cell. Of those at one place the one of
//! the greatest weight represents it, then the one of the lowest rank, whether it is a corner of cells or hidden itself;
//! the others are hidden by place, as they are without weights.
//!
//! Nothing is kept of this: what a call needs is found anew from the hidden vertices. Cost: for each
//! hidden one the corners of the cell below it. Of hidden ones that are at no corner those are sorted that may share a place, by
//! a hash of it.

use std::cmp::Ordering;

use crate::delaunay::{Delaunay, Moving};
use crate::error::{Error, Result};
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::options::CoincidencePolicy;
use crate::motion::state::hidden_ids::HiddenIds;
use crate::motion::state::mesh::Mesh;
use crate::predicates::PointArray;

/// A vertex that is hidden by weight, as it represents its place, and the cell below it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) struct Covered {
    pub(in crate::motion) vertex: VertexId,
    /// [`Slot::NONE`] where there are no cells.
    pub(in crate::motion) cell: Slot,
}

/// The vertices that are in no cell.
#[derive(Debug, Default)]
pub(in crate::motion) struct HiddenVertices {
    /// Vertices hidden by place, ascending, each with the one that represents it.
    pub(in crate::motion) by_place: Vec<(VertexId, VertexId)>,
    /// Vertices hidden by weight, ascending by id.
    pub(in crate::motion) by_weight: Vec<Covered>,
}

/// How many bits there are for each place in a table of places, by a hash.
const BITS_PER_PLACE: usize = 16;

/// Who is hidden, and how many by what.
#[derive(Debug, Default)]
pub(in crate::motion) struct HiddenNow {
    pub(in crate::motion) ids: HiddenIds,
    pub(in crate::motion) by_place: u64,
    pub(in crate::motion) by_weight: u64,
}

impl<G: Moving> Mesh<G> {
    /// The site at the place of a live one that cells have for a corner, while there are cells; none at a place that is hidden by
    /// weight.
    #[inline(always)]
    pub(in crate::motion) fn shown_at(&self, s: SiteId) -> Option<SiteId> {
        if self.kernel.is_hidden(s) {
            corner_at_place(&self.kernel, s, self.kernel.cell_below(s))
        } else {
            Some(s)
        }
    }

    /// The vertices that are in no cell, of those with weights.
    pub(in crate::motion) fn vertices_in_no_cell(&self) -> Result<HiddenVertices> {
        HiddenVertices::of(&self.kernel)
    }

    /// Who is hidden in a kernel, of vertices with weights; an error if two are at one place, and that is refused.
    pub(in crate::motion) fn hidden_in(
        &self,
        kernel: &Delaunay<G>,
        policy: CoincidencePolicy,
    ) -> Result<HiddenNow> {
        if !G::HAS_WEIGHTS {
            return Ok(HiddenNow::default());
        }
        let found = HiddenVertices::of(kernel)?;
        if let Some(&(v, w)) = found.by_place.first().filter(|_| policy == CoincidencePolicy::Reject) {
            return Err(Error::Coincident { vertex: v.min(w), other: v.max(w) });
        }
        let ids = HiddenIds::of(found.all(), self.site_of.len())?;
        let [by_place, by_weight] = [found.by_place.len(), found.by_weight.len()].map(|n| n as u64);
        Ok(HiddenNow { ids, by_place, by_weight })
    }
}

impl HiddenVertices {
    /// The vertices that are in no cell of a kernel, of those with weights.
    pub(in crate::motion) fn of<G: Moving>(kernel: &Delaunay<G>) -> Result<Self> {
        let (mut found, mut alone) = (HiddenVertices::default(), Vec::new());
        if kernel.has_cells() {
            for s in kernel.hidden_sites() {
                let cell = kernel.cell_below(s);
                match corner_at_place(kernel, s, cell) {
                    Some(corner) => {
                        memory::push(&mut found.by_place, (kernel.site(s).id, kernel.site(corner).id))?;
                    }
                    None => memory::push(&mut alone, (s, cell))?,
                }
            }
            found.list_by_place(kernel, &alone)?;
            memory::collect(
                &mut found.by_weight,
                alone.iter().map(|&(s, cell)| Covered { vertex: kernel.site(s).id, cell }),
            )?;
        } else {
            memory::collect(&mut alone, kernel.live_sites().map(|s| (s, Slot::NONE)))?;
            found.list_by_place(kernel, &alone)?;
            let sites = kernel.hidden_without_cells()?;
            memory::collect(
                &mut found.by_weight,
                sites.into_iter().map(|s| Covered { vertex: kernel.site(s).id, cell: Slot::NONE }),
            )?;
        }
        let HiddenVertices { by_place, by_weight } = &mut found;
        by_place.sort_unstable();
        by_weight.sort_unstable_by_key(|covered| covered.vertex);
        by_weight
            .retain(|covered| by_place.binary_search_by_key(&covered.vertex, |&(vertex, _)| vertex).is_err());
        Ok(found)
    }

    /// All of them, in no particular order.
    pub(in crate::motion) fn all(&self) -> impl Iterator<Item = VertexId> {
        let by_weight = self.by_weight.iter().map(|covered| covered.vertex);
        self.by_place.iter().map(|&(vertex, _)| vertex).chain(by_weight)
    }

    /// Lists those of these sites that share a place and do not represent it.
    fn list_by_place<G: Moving>(&mut self, kernel: &Delaunay<G>, sites: &[(SiteId, Slot)]) -> Result<()> {
        let mut shared = maybe_shared(kernel, sites)?;
        let of = |s: SiteId| (kernel.site(s).id, kernel.site(s).point);
        let by_place = |a: &SiteId, b: &SiteId| -> Ordering {
            let ((v, p), (w, q)) = (of(*a), of(*b));
            let places = p.as_ref().iter().zip(q.as_ref());
            let order = places.map(|(x, y)| x.total_cmp(y)).find(|order| order.is_ne());
            let heavier_first = || q.weight().total_cmp(&p.weight());
            order
                .unwrap_or(Ordering::Equal)
                .then_with(heavier_first)
                .then_with(|| kernel.keys().order_of(v, w))
        };
        shared.sort_unstable_by(by_place);
        for group in shared.chunk_by(|&a, &b| of(a).1.as_ref() == of(b).1.as_ref()) {
            let others = group[1..].iter().map(|&s| (of(s).0, of(group[0]).0));
            memory::collect(&mut self.by_place, others)?;
        }
        Ok(())
    }
}

/// Sites of a list that may share a place: all that do, and few others.
fn maybe_shared<G: Moving>(kernel: &Delaunay<G>, sites: &[(SiteId, Slot)]) -> Result<Vec<SiteId>> {
    let n_bits = (BITS_PER_PLACE * sites.len()).next_power_of_two().max(64);
    let (mut seen, mut again) = (Vec::new(), Vec::new());
    memory::lengthen(&mut seen, n_bits / 64, 0_u64)?;
    memory::lengthen(&mut again, n_bits / 64, 0_u64)?;
    let bit_of = |s: SiteId| {
        let hash =
            kernel.site(s).point.as_ref().iter().fold(0_u64, |hash, x| {
                (hash.rotate_left(26) ^ x.to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15)
            });
        let bit = (hash >> 32) as usize & (n_bits - 1);
        (bit / 64, 1_u64 << (bit % 64))
    };
    for &(s, _) in sites {
        let (word, bit) = bit_of(s);
        again[word] |= seen[word] & bit;
        seen[word] |= bit;
    }
    let mut shared = Vec::new();
    if again.iter().any(|&word| word != 0) {
        let repeated = sites.iter().map(|&(s, _)| s).filter(|&s| {
            let (word, bit) = bit_of(s);
            again[word] & bit != 0
        });
        memory::collect(&mut shared, repeated)?;
    }
    Ok(shared)
}

/// The corner of the cell below a hidden site that is at its place.
fn corner_at_place<G: Moving>(kernel: &Delaunay<G>, s: SiteId, cell: Slot) -> Option<SiteId> {
    let place = kernel.site(s).point;
    let corners = kernel.complex().cell(cell).corners;
    corners.as_ref().iter().copied().find(|&corner| kernel.site(corner).point.as_ref() == place.as_ref())
}
