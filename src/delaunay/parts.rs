//! Parts of the sites, for a build on several threads.
//!
//! Hyperplanes orthogonal to the axes divide space, each part of it in two (Bentley's k-d tree, 10.1145/361002.361007).
//! The sites of each part keep their order, along a Hilbert curve. The planes are those of a sample, and of one build.

use super::order::bounding_box;
use super::{Delaunay, Dimension};
use crate::error::Result;
use crate::ids::SiteId;
use crate::machine::memory;
use crate::machine::threads;
use std::ops::Range;

/// A sample of this number of sites for each part puts each plane where the sizes of the parts differ by a
/// hundredth.
const SAMPLE: usize = 1 << 13;

/// The first site after the placeholder.
const FIRST: SiteId = SiteId::new(1);

/// Parts of sites.
#[derive(Debug, Default)]
pub(super) struct Parts {
    /// First site of each part; none if there is but one part.
    starts: Vec<SiteId>,
    /// Axis and coordinate of the plane that has the parts below `i + 1`, as far as they are on the same side
    /// of all planes before, below it.
    planes: Vec<(usize, f64)>,
}

impl Parts {
    /// Planes for `n_parts` parts with like shares of a sample.
    fn of_sample<G: Dimension>(sample: &mut [G::Point], n_parts: usize) -> Result<Self> {
        let mut parts = Parts::default();
        memory::lengthen(&mut parts.starts, n_parts, FIRST)?;
        memory::lengthen(&mut parts.planes, n_parts - 1, (0, 0.0))?;
        parts.divide::<G>(sample, 0..n_parts);
        Ok(parts)
    }

    fn divide<G: Dimension>(&mut self, sample: &mut [G::Point], parts: Range<usize>) {
        let Some((lower, upper)) = bounding_box::<G>(sample.iter()) else { return };
        if parts.len() <= 1 {
            return;
        }
        let extent = |axis: &usize| upper[*axis] - lower[*axis];
        let axis = (0..G::D).max_by(|a, b| extent(a).total_cmp(&extent(b))).expect("an axis");
        let middle = middle(&parts);
        let rank = sample.len() * (middle - parts.start) / parts.len();
        let (below, at, _) = sample.select_nth_unstable_by(rank, |p, q| p[axis].total_cmp(&q[axis]));
        self.planes[middle - 1] = (axis, at[axis]);
        self.divide::<G>(below, parts.start..middle);
        self.divide::<G>(&mut sample[rank..], middle..parts.end);
    }

    /// Number of parts.
    pub(super) fn count(&self) -> usize {
        self.planes.len() + 1
    }

    /// The sites of consecutive parts, of which there are several, with `n_sites` in all.
    pub(super) fn sites(&self, parts: Range<usize>, n_sites: usize) -> Range<usize> {
        let start = |part: usize| self.starts.get(part).map_or(n_sites, |s| s.index());
        start(parts.start)..start(parts.end)
    }

    /// The least coordinates of points in a part, and what their coordinates are below.
    fn bounds(&self, part: usize) -> ([f64; 3], [f64; 3]) {
        let (mut least, mut limit) = ([f64::NEG_INFINITY; 3], [f64::INFINITY; 3]);
        let mut parts = 0..self.count();
        while parts.len() > 1 {
            let middle = middle(&parts);
            let (axis, at) = self.planes[middle - 1];
            if part < middle {
                limit[axis] = at;
                parts.end = middle;
            } else {
                least[axis] = at;
                parts.start = middle;
            }
        }
        (least, limit)
    }

    /// The sites of a part.
    fn items_in<'p, G: Dimension>(
        &self,
        part: usize,
        mut items: impl Iterator<Item = SiteId>,
        n: usize,
        point: impl Fn(SiteId) -> &'p G::Point,
    ) -> Result<Vec<SiteId>> {
        let (least, limit) = self.bounds(part);
        let mut own = Vec::new();
        // Sizes differ by less unless many coordinates are equal.
        memory::reserve_exact(&mut own, n / self.count() + n / 16)?;
        // On which side of a plane the next one is cannot be predicted: all are written and some kept.
        let mut kept = [SiteId::NONE; 1024];
        loop {
            let (mut n_items, mut n_kept) = (0, 0);
            for item in items.by_ref().take(kept.len()) {
                let p = point(item);
                let is_in = (0..G::D).fold(true, |is_in, k| is_in & (least[k] <= p[k]) & (p[k] < limit[k]));
                kept[n_kept] = item;
                n_kept += is_in as usize;
                n_items += 1;
            }
            if n_items == 0 {
                return Ok(own);
            }
            if own.capacity() - own.len() < n_kept {
                let more = n_kept.max(own.len() / 4);
                memory::reserve_exact(&mut own, more)?;
            }
            own.extend_from_slice(&kept[..n_kept]);
        }
    }
}

/// Where a range of parts is divided.
pub(super) fn middle(parts: &Range<usize>) -> usize {
    parts.start.midpoint(parts.end)
}

/// The end of the longest range of parts that begins with this one and is divided as one.
pub(super) fn end_from(part: usize, n_parts: usize) -> usize {
    let mut parts = 0..n_parts;
    while parts.start != part {
        let middle = middle(&parts);
        if part < middle {
            parts.end = middle;
        } else {
            parts.start = middle;
        }
    }
    parts.end
}

impl<G: Dimension> Delaunay<G> {
    /// How many threads build a triangulation of this number of sites.
    pub(super) fn build_threads(&self, n: usize) -> usize {
        self.threads.for_work(n, BUILT_AT_LEAST[G::D - 2], BUILT_IF_ASKED)
    }

    /// Whether several threads would build a triangulation of this number of sites, if there were as many.
    pub(super) fn is_build_shared(&self, n: usize) -> bool {
        self.threads.shares(n, BUILT_AT_LEAST[G::D - 2], BUILT_IF_ASKED) > 1
    }

    /// The live sites, of which there are `n`, in this number of parts, each in their order.
    pub(super) fn in_parts(&self, n_parts: usize, n: usize) -> Result<(Parts, Vec<Vec<SiteId>>)> {
        let step = (n / (SAMPLE * n_parts)).max(1);
        let mut sample = Vec::new();
        memory::reserve_exact(&mut sample, n.div_ceil(step))?;
        memory::collect(&mut sample, self.live_sites().step_by(step).map(|s| self.site(s).point))?;
        let mut parts = Parts::of_sample::<G>(&mut sample, n_parts)?;
        let (mut lists, mut done) = (Vec::new(), Vec::new());
        memory::reserve_exact(&mut lists, n_parts)?;
        memory::lengthen(&mut done, n_parts, Ok(Vec::new()))?;
        threads::fill(&mut done, &|part| {
            parts.items_in::<G>(part, self.live_sites(), n, |s| &self.site(s).point)
        });
        let mut start = FIRST;
        for (part, list) in done.into_iter().enumerate() {
            let list = list?;
            parts.starts[part] = start;
            start = SiteId::at(start.index() + list.len());
            lists.push(list);
        }
        Ok((parts, lists))
    }
}

/// Sites of a part at least if all threads are to be used.
const BUILT_IF_ASKED: usize = 256;

/// Sites of a part at least for a build in parts to be clearly faster, in the plane and in space, on a busy machine as
/// well. (On an idle one two parts are faster from 3,000 sites on; where no processor is free they take up to a third
/// longer than one.)
const BUILT_AT_LEAST: [usize; 2] = [5_000, 2_500];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::Plane;
    use crate::machine::threads::Threads;
    use crate::random::Rng;

    /// Every site is in one part, on its side of all planes, and parts are even and keep the order of sites.
    #[test]
    fn sites_are_parted() {
        let rng = &mut Rng::new(1);
        let points: Vec<[f64; 2]> = (0..4_000).map(|_| [rng.unit(), rng.unit()]).collect();
        let mut t = Delaunay::<Plane>::on(Threads::ONE).expect("room");
        t.add_sites(&points).expect("room");
        let n_parts = 5;
        let (parts, lists) = t.in_parts(n_parts, points.len()).expect("room");
        for (part, list) in lists.iter().enumerate() {
            let (least, limit) = parts.bounds(part);
            for &s in list {
                let p = t.site(s).point;
                assert!((0..2).all(|k| least[k] <= p[k] && p[k] < limit[k]), "{part}");
            }
            assert!(list.is_sorted() && n_parts * list.len() < points.len() + points.len() / 8);
            assert_eq!(parts.sites(part..part + 1, points.len() + 1).len(), list.len());
        }
        let mut all = lists.concat();
        all.sort_unstable();
        assert!(all.into_iter().eq(t.live_sites()));
    }
}
