//! Parts of the sites, for a build on several threads, or as on several threads.
//!
//! Hyperplanes orthogonal to the axes divide space, each part of it in two (Bentley's k-d tree, 10.1145/361002.361007).
//! The sites of each part follow each other in memory, along a Hilbert curve of their own. The planes are those of a
//! sample, and stay when sites move: before the next build, sites that have crossed one change places.

use super::order::{Keyed, bounding_box, hilbert_order};
use super::{Delaunay, Geometry, Site};
use crate::complex::INFINITE;
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

/// Parts of sites; none for a build in one.
#[derive(Debug, Default)]
pub(super) struct Parts {
    /// First site of each part; none if there is but one part.
    starts: Vec<SiteId>,
    /// Axis and coordinate of the plane that has the parts below `i + 1`, as far as they are on the same side
    /// of all planes before, below it.
    planes: Vec<(usize, f64)>,
}

impl Parts {
    pub(super) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.starts) + memory::bytes_of(&self.planes)
    }

    /// Planes for `n_parts` parts with like shares of a sample.
    fn of_sample<G: Geometry>(sample: &mut [G::Point], n_parts: usize) -> Result<Self> {
        let mut parts = Parts::default();
        memory::lengthen(&mut parts.starts, n_parts, FIRST)?;
        memory::lengthen(&mut parts.planes, n_parts - 1, (0, 0.0))?;
        parts.divide::<G>(sample, 0..n_parts);
        Ok(parts)
    }

    fn divide<G: Geometry>(&mut self, sample: &mut [G::Point], parts: Range<usize>) {
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

    /// A copy.
    pub(super) fn copy(&self) -> Result<Self> {
        Ok(Parts { starts: memory::copy_of(&self.starts)?, planes: memory::copy_of(&self.planes)? })
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

    /// The items of a part.
    fn items_in<'p, G: Geometry>(
        &self,
        part: usize,
        mut items: impl Iterator<Item = u32>,
        n: usize,
        point: impl Fn(u32) -> &'p G::Point,
    ) -> Result<Vec<Keyed>> {
        let (least, limit) = self.bounds(part);
        let mut own = Vec::new();
        // Sizes differ by less unless many coordinates are equal.
        memory::reserve_exact(&mut own, n / self.count() + n / 16)?;
        // On which side of a plane the next one is cannot be predicted: all are written and some kept.
        let mut kept = [Keyed::default(); 1024];
        loop {
            let (mut n_items, mut n_kept) = (0, 0);
            for item in items.by_ref().take(kept.len()) {
                let p = point(item);
                let is_in = (0..G::D).fold(true, |is_in, k| is_in & (least[k] <= p[k]) & (p[k] < limit[k]));
                kept[n_kept] = Keyed::new(item);
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

    /// Lets sites that are on the wrong side of a plane change places.
    fn restore<G: Geometry>(&mut self, sites: &mut [Site<G>], parts: Range<usize>) {
        if parts.len() <= 1 {
            return;
        }
        let middle = middle(&parts);
        let (axis, at) = self.planes[middle - 1];
        let Range { start: mut i, end: mut j } = self.sites(parts.clone(), sites.len());
        loop {
            i += sites[i..j].iter().take_while(|site| site.point[axis] < at).count();
            j -= sites[i..j].iter().rev().take_while(|site| site.point[axis] >= at).count();
            if i == j {
                break;
            }
            sites.swap(i, j - 1);
            (i, j) = (i + 1, j - 1);
        }
        self.starts[middle] = SiteId::at(i);
        self.restore(sites, parts.start..middle);
        self.restore(sites, middle..parts.end);
    }

    /// Whether no part is much larger than the others.
    fn are_even(&self, n_sites: usize) -> bool {
        if self.starts.is_empty() {
            return true;
        }
        let largest = (0..self.count()).map(|part| self.sites(part..part + 1, n_sites).len()).max();
        largest.is_none_or(|largest| largest * self.count() <= n_sites + n_sites / 8)
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

impl<G: Geometry> Delaunay<G> {
    /// In how many parts to build a triangulation of this number of sites.
    pub(crate) fn build_parts(&self, n: usize) -> usize {
        self.threads.parts_of(n, BUILT_AT_LEAST[G::D - 2], BUILT_IF_ASKED)
    }

    /// Items at these places in [parts](Self::build_parts), each along a Hilbert curve. The parts start
    /// where the sites do if the first one is [`FIRST`].
    pub(super) fn in_parts<'p>(
        &self,
        items: impl Iterator<Item = u32> + Clone + Sync,
        n: usize,
        point: impl Fn(u32) -> &'p G::Point + Copy + Sync,
    ) -> Result<(Parts, Vec<Vec<Keyed>>)> {
        let n_parts = self.build_parts(n);
        let mut sorted = Vec::new();
        memory::reserve_exact(&mut sorted, n_parts)?;
        if n_parts == 1 {
            let mut all = Vec::new();
            memory::reserve_exact(&mut all, n)?;
            all.extend(items.map(Keyed::new));
            sorted.push(hilbert_order::<G>(all, point)?);
            return Ok((Parts::default(), sorted));
        }
        let step = (n / (SAMPLE * n_parts)).max(1);
        let mut sample = Vec::new();
        memory::reserve_exact(&mut sample, n.div_ceil(step))?;
        memory::collect(&mut sample, items.clone().step_by(step).map(|item| *point(item)))?;
        let mut parts = Parts::of_sample::<G>(&mut sample, n_parts)?;
        sorted.resize_with(n_parts, Vec::new);
        let mut done = Vec::new();
        memory::lengthen(&mut done, n_parts, Ok(Vec::new()))?;
        threads::fill(&mut done, self.threads.for_work(n_parts, 1, 1), &|part| {
            hilbert_order::<G>(parts.items_in::<G>(part, items.clone(), n, point)?, point)
        });
        for (sorted, done) in sorted.iter_mut().zip(done) {
            *sorted = done?;
        }
        let mut start = FIRST;
        for (part, sorted) in sorted.iter().enumerate() {
            parts.starts[part] = start;
            start = SiteId::at(start.index() + sorted.len());
        }
        Ok((parts, sorted))
    }

    /// Brings the sites back into parts, if they were: indices change. [`rebuild`](Self::rebuild) must follow.
    pub(crate) fn restore_parts(&mut self) {
        let n_parts = self.parts.count();
        if n_parts == 1 {
            return;
        }
        self.parts.restore(&mut self.sites, 0..n_parts);
        if !self.free_sites.is_empty() {
            // The list keeps its length, so this needs no memory.
            self.free_sites.clear();
            let sites = SiteId::range(1..self.sites.len());
            self.free_sites.extend(sites.filter(|&s| !self.sites[s].is_live()));
        }
    }

    /// Whether no part of the sites is much larger than the others.
    pub(crate) fn has_even_parts(&self) -> bool {
        self.parts.are_even(self.sites.len())
    }

    /// Puts the live sites along a Hilbert curve, from index 1 on without gaps. All indices change and the cells
    /// go: [`rebuild`](Self::rebuild) must follow.
    pub fn sort_sites(&mut self) -> Result<()> {
        let sites = &self.sites;
        let n = sites.len() - 1 - self.free_sites.len();
        let (parts, keyed) =
            self.in_parts(self.live_sites().map(SiteId::get), n, |s| &sites[s as usize].point)?;
        let mut sorted = Vec::new();
        memory::reserve_exact(&mut sorted, n + 1)?;
        sorted.push(sites[INFINITE]);
        let n_threads = self.threads.for_work(keyed.len(), 1, 1);
        for part in &keyed {
            memory::extend(&mut sorted, part, n_threads, |k| sites[k.item() as usize])?;
        }
        self.sites = sorted;
        self.parts = parts;
        self.free_sites.clear();
        self.complex.clear();
        Ok(())
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
    use crate::ids::VertexId;
    use crate::random::Rng;

    /// Sites that have crossed a plane change places with others, all others stay.
    #[test]
    fn parts_are_restored() {
        let rng = &mut Rng::new(1);
        let mut sample: Vec<[f64; 2]> = (0..4_000).map(|_| [rng.unit(), rng.unit()]).collect();
        let n_parts = 5;
        let mut parts = Parts::of_sample::<Plane>(&mut sample, n_parts).expect("room");
        let site = |(k, &point): (usize, &[f64; 2])| Site::new(point, VertexId::at(k));
        // In any order at first.
        let mut sites: Vec<Site<Plane>> = sample.iter().enumerate().map(site).collect();
        sites.insert(0, Site::new([f64::NAN; 2], VertexId::NONE));
        for round in 0..3 {
            parts.restore(&mut sites, 0..n_parts);
            assert!(parts.are_even(sites.len()));
            for part in 0..n_parts {
                let (least, limit) = parts.bounds(part);
                for site in &sites[parts.sites(part..part + 1, sites.len())] {
                    assert!((0..2).all(|k| least[k] <= site.point[k] && site.point[k] < limit[k]), "{part}");
                }
            }
            let mut ids: Vec<VertexId> = sites[1..].iter().map(|site| site.id).collect();
            ids.sort_unstable();
            assert!(ids.into_iter().eq(VertexId::range(0..sample.len())), "{round}");
            for site in sites[1..].iter_mut().step_by(7) {
                site.point = [rng.unit(), rng.unit()];
            }
        }
    }
}
