//! Which vertices are hidden: by what is at their place in any period or, with weights, by the cells that they are above.
//!
//! What is hidden inside is hidden in the set that repeats, as that has all of its places and more. It is the other way
//! round as well (needed.rs). So who is hidden is read inside. Vertices that share a place and are hidden by weight there
//! need no images beside each other, and are found by their multiples of the vectors.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::{CommitReport, HiddenIds};
use crate::periodic::images::Image;
use crate::periodic::inside::Inside;
use crate::periodic::lattice::{Lattice, Shift, plus};
use crate::predicates::PointArray;

/// By axis of the lattice, how many intervals of multiples there are in which vertices are looked for that share a place.
const INTERVALS: f64 = (1u64 << 20) as f64;

/// Multiples of two places that are the same in some period differ by less than this.
const APART: f64 = 1e-9;

/// The vertices that are corners of no cell.
#[derive(Debug, Default)]
pub(super) struct HiddenHomes {
    /// Hidden by place, ascending, each with the one that represents it.
    pub(super) by_place: Vec<(VertexId, VertexId)>,
    /// Hidden by weight, ascending; they represent their places.
    pub(super) by_weight: Vec<VertexId>,
}

impl HiddenHomes {
    /// All of them, as a set of so many ids.
    pub(super) fn ids(&self, n_ids: usize) -> Result<HiddenIds> {
        if self.by_place.is_empty() && self.by_weight.is_empty() {
            return Ok(HiddenIds::default());
        }
        let by_place = self.by_place.iter().map(|&(vertex, _)| vertex);
        HiddenIds::of(by_place.chain(self.by_weight.iter().copied()), n_ids)
    }

    /// Enters how many there are.
    pub(super) fn count_in(&self, report: &mut CommitReport) {
        report.coincident = self.by_place.len() as u64;
        report.hidden_by_weight = self.by_weight.len() as u64;
    }
}

impl<G: Moving> Inside<G> {
    /// The vertices at home that are corners of no cell. Never a part of its callers, of which some take much of the stack.
    #[inline(never)]
    pub(super) fn hidden_homes(&self, lattice: &Lattice<G>) -> Result<HiddenHomes> {
        let mut hidden = HiddenHomes::default();
        if !G::HAS_WEIGHTS {
            if self.t.hidden_count() > 0 {
                let of_homes = self.t.hidden_vertices().filter(|(inner, _)| self.images.is_home(*inner));
                let vertices =
                    of_homes.map(|(inner, shown)| (self.images.vertex(inner), self.images.vertex(shown)));
                memory::collect(&mut hidden.by_place, vertices)?;
                hidden.by_place.sort_unstable();
            }
            return Ok(hidden);
        }
        let mut alone = Vec::new();
        if self.t.cell_count() == 0 {
            // All images by which vertices can share a place are there.
            for (inner, shown) in self.t.hidden_by_place()? {
                if self.images.is_home(inner) {
                    memory::push(
                        &mut hidden.by_place,
                        (self.images.vertex(inner), self.images.vertex(shown)),
                    )?;
                }
            }
            let by_weight = self.t.hidden_by_weight()?.into_iter().map(|(inner, _)| inner);
            let homes =
                by_weight.filter(|inner| self.images.is_home(*inner)).map(|inner| self.images.vertex(inner));
            memory::collect(&mut hidden.by_weight, homes)?;
        } else if self.t.count_in_no_cell() > 0 {
            for inner in
                self.t.vertices_hidden_by_weight()?.into_iter().filter(|inner| self.images.is_home(*inner))
            {
                match self.t.corner_at(inner) {
                    Some(shown) => memory::push(
                        &mut hidden.by_place,
                        (self.images.vertex(inner), self.images.vertex(shown)),
                    )?,
                    None => memory::push(&mut alone, inner)?,
                }
            }
            self.list_sharing(lattice, &alone, &mut hidden.by_place)?;
        }
        hidden.by_place.sort_unstable();
        let is_represented =
            |vertex: VertexId| hidden.by_place.binary_search_by_key(&vertex, |&(v, _)| v).is_ok();
        let left =
            alone.iter().map(|&inner| self.images.vertex(inner)).filter(|&vertex| !is_represented(vertex));
        memory::collect(&mut hidden.by_weight, left)?;
        hidden.by_weight.sort_unstable();
        Ok(hidden)
    }

    /// The translation that takes one vertex at home to the place of another one, if there is one.
    pub(super) fn shift_between(&self, lattice: &Lattice<G>, to: VertexId, from: VertexId) -> Option<Shift> {
        let (goal, home) = (self.place_of(to), self.place_of(from));
        let mut way = goal;
        (0..G::D).for_each(|axis| way[axis] -= home[axis]);
        let shift = lattice.multiples(&way).map(|x| x.round() as i32);
        (lattice.translated(&home, shift).as_ref() == goal.as_ref()).then_some(shift)
    }

    /// Where a vertex at home is, in the midst of a commit as well.
    fn place_of(&self, home: VertexId) -> G::Point {
        self.t.position(home).unwrap_or_default()
    }

    /// Of vertices at one place that of the least rank, and of these that of the lowest id, represents it.
    pub(super) fn rank_at_place(&self, home: VertexId) -> f64 {
        -self.place_of(home).weight()
    }

    /// Lists those of some vertices at home that share a place with another one of them, which represents it.
    fn list_sharing(
        &self,
        lattice: &Lattice<G>,
        homes: &[VertexId],
        sharing: &mut Vec<(VertexId, VertexId)>,
    ) -> Result<()> {
        let mut entries = Vec::new();
        for &home in homes {
            let place = self.place_of(home);
            let numbers = lattice.multiples(&place).map(|x| (x - x.floor()) * INTERVALS);
            // Along axes along which no vector goes, places that are the same in some period have one coordinate.
            let open = [0, 1, 2]
                .map(|axis| if axis < G::D && !lattice.is_spanned(axis) { place[axis].to_bits() } else { 0 });
            for choice in 0..1_u32 << lattice.rank() {
                let beside = [0, 1, 2].map(|j| choice >> j & 1 == 1);
                let interval = [0, 1, 2].map(|j| {
                    let [low, high] = [-APART, APART].map(|way| (numbers[j] + way * INTERVALS).floor());
                    // The last interval is beside the first one.
                    (!beside[j] || low != high)
                        .then(|| (if beside[j] { high } else { low }).rem_euclid(INTERVALS))
                });
                if let [Some(x), Some(y), Some(z)] = interval {
                    memory::push(&mut entries, (([x as u32, y as u32, z as u32], open), home))?;
                }
            }
        }
        let rank = |home: VertexId| self.rank_at_place(home);
        entries
            .sort_unstable_by(|(a, v), (b, w)| a.cmp(b).then(rank(*v).total_cmp(&rank(*w))).then(v.cmp(w)));
        let (mut found, mut first) = (Vec::new(), Vec::new());
        for there in entries.chunk_by(|(a, _), (b, _)| a == b) {
            first.clear();
            for &(_, home) in there {
                let shown = first.iter().find(|&&other| self.shift_between(lattice, home, other).is_some());
                match shown {
                    Some(&shown) if shown != home => memory::push(&mut found, (home, shown))?,
                    _ => memory::push(&mut first, home)?,
                }
            }
        }
        found.sort_unstable_by(|(v, a), (w, b)| v.cmp(w).then(rank(*a).total_cmp(&rank(*b))).then(a.cmp(b)));
        found.dedup_by_key(|(home, _)| *home);
        memory::collect(sharing, found.iter().map(|&(v, w)| (self.images.vertex(v), self.images.vertex(w))))
    }

    /// The translated corner of cells that is at the place of an image; none if that is hidden by weight.
    pub(super) fn corner_at_image(&self, image: Image) -> Option<Image> {
        let shown = self.images.of(self.t.corner_at(self.images.home(image.vertex))?);
        Some(Image { vertex: shown.vertex, shift: plus(shown.shift, image.shift) })
    }
}
