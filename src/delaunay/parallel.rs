//! The static triangulation on several threads.
//!
//! The sites are in [parts](super::parts) with hyperplanes between them. Each part is triangulated on a
//! thread of its own, by the same insertions as on one thread; then triangulations on either side of a
//! hyperplane are [united](super::unite), two by two.
//!
//! Invariants: a thread changes nothing but its own part's triangulation, of which it is the owner, and reads
//! sites that none changes; the monitor is called by the calling thread alone. Ids break the ties in a part
//! as in the whole, so the cells are those of a build on one thread.
//!
//! Cost: that of the largest part, and of uniting. Of a million sites in two parts 0.15 % are inserted again
//! in the plane, and 1.7 % in space. Where spheres reach far into other parts, as those of points on one
//! sphere do, all sites but those of one part are, on one thread: a build then takes a third longer.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use super::order::{bounding_box, in_rounds};
use super::parts::{self, Parts};
use super::unite::Open;
use super::{Delaunay, Dimension, Site};
use crate::complex::{Complex, INFINITE, memory};
use crate::error::{Error, Result};
use crate::threads;

/// Share of the work that is done when the parts are triangulated, roughly.
const SHARE_OF_PARTS: f64 = 0.8;

/// A triangulation, and pairs of coincident sites, the second in the cells.
type Built<G> = (Delaunay<G>, Vec<(u32, u32)>);

/// What all threads read.
struct Build<'t, G: Dimension> {
    sites: &'t [Site<G>],
    parts: &'t Parts,
    /// Bounding box of each part.
    boxes: Vec<(G::Point, G::Point)>,
    /// Whether some thread has failed.
    stop: AtomicBool,
}

impl<G: Dimension> Delaunay<G> {
    /// Triangulates the parts of the live sites at the same time; returns pairs of coincident sites, the
    /// second in the cells. `None`, and no cells, if there is but one part or no memory for several, or one
    /// is flat.
    pub(super) fn triangulate_parts(
        &mut self,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Option<Vec<(u32, u32)>>> {
        let n_parts = self.parts.count();
        if n_parts == 1 {
            return Ok(None);
        }
        let boxes = threads::for_each(0..n_parts, &|part| {
            let sites = &self.sites[self.parts.sites(part..part + 1, self.sites.len())];
            bounding_box::<G>(sites.iter().filter(|site| site.is_live()).map(|site| &site.point))
        });
        let Some(boxes) = boxes.into_iter().collect() else { return Ok(None) };
        let mut complex = std::mem::take(&mut self.complex);
        complex.clear();
        let build = Build { sites: &self.sites, parts: &self.parts, boxes, stop: AtomicBool::new(false) };
        let mut is_cancelled = false;
        let built = build.triangulate(0..n_parts, n_parts, complex, &mut |fraction| {
            is_cancelled |= !monitor(fraction);
            !is_cancelled && !build.stop.load(Relaxed)
        });
        match built {
            Ok((united, coincident)) => {
                self.adopt(united);
                Ok(Some(coincident))
            }
            Err(_) if is_cancelled => Err(Error::Cancelled),
            Err(_) => Ok(None),
        }
    }

    /// Takes over the cells of a triangulation of the same sites.
    fn adopt(&mut self, other: Self) {
        self.sites = other.sites;
        self.complex = other.complex;
        (self.lower, self.upper, self.filter) = (other.lower, other.upper, other.filter);
        self.cavity = other.cavity;
        self.recent = other.recent;
        self.is_sorted = false;
    }
}

impl<G: Dimension> Build<'_, G> {
    /// Triangulates parts, with room for the sites up to the part `end`, in the memory of a complex.
    fn triangulate(
        &self,
        parts: Range<usize>,
        end: usize,
        complex: Complex<G::Corners>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Built<G>> {
        let built = if parts.len() == 1 {
            self.triangulate_one(parts.start, end, complex, monitor)
        } else {
            self.triangulate_halves(parts, end, complex, monitor)
        };
        // The work of the others is in vain.
        self.stop.fetch_or(built.is_err(), Relaxed);
        built
    }

    fn triangulate_halves(
        &self,
        parts: Range<usize>,
        end: usize,
        complex: Complex<G::Corners>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Built<G>> {
        let middle = parts::middle(&parts);
        let (left, right) = threads::join(
            || self.triangulate(parts.start..middle, end, complex, monitor),
            || {
                let goes_on = &mut |_| !self.stop.load(Relaxed);
                let (right, coincident) =
                    self.triangulate(middle..parts.end, parts.end, Complex::default(), goes_on)?;
                let (lower, upper) = self.box_of(parts.start..middle);
                Ok((right.open(&lower, &upper)?, coincident))
            },
        );
        let (mut left, mut coincident) = left?;
        let (right, found): (Open<G>, Vec<(u32, u32)>) = right?;
        let shift = left.sites().len() as u32 - 1;
        coincident.extend(found.into_iter().map(|(s, t)| (s + shift, t + shift)));
        let [from, to] = [middle, parts.end].map(|part| part as f64 / self.parts.count() as f64);
        let mut monitor = |fraction: f64| {
            monitor(SHARE_OF_PARTS + (1.0 - SHARE_OF_PARTS) * (from + (to - from) * fraction))
        };
        coincident.extend(left.unite(right, parts.len(), &mut monitor)?);
        Ok((left, coincident))
    }

    /// Triangulates one part. A flat one is an error, whichever: the caller triangulates all on one thread
    /// then.
    fn triangulate_one(
        &self,
        part: usize,
        end: usize,
        complex: Complex<G::Corners>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Built<G>> {
        let n = self.parts.sites(part..end, self.sites.len()).len();
        let mut sites = Vec::new();
        memory::reserve_exact(&mut sites, n + 1)?;
        sites.push(self.sites[INFINITE as usize]);
        sites.extend_from_slice(&self.sites[self.parts.sites(part..part + 1, self.sites.len())]);
        let (lower, upper) = self.boxes[part];
        let filter = G::filter(&lower, &upper);
        let mut t = Delaunay { sites, complex, lower, upper, filter, ..Delaunay::default() };
        let order = in_rounds::<G>(t.live_sites())?;
        if !order.iter().any(|&s| t.extend_basis(s)) {
            return Err(Error::Cancelled);
        }
        let mut monitor = |fraction: f64| monitor(SHARE_OF_PARTS * fraction);
        // While two triangulations are united there are more cells than before and after.
        let coincident = t.triangulate_unmerged(&order, n + 8 * n.isqrt(), &mut monitor)?;
        Ok((t, coincident))
    }

    /// Bounding box of the sites of parts.
    fn box_of(&self, parts: Range<usize>) -> (G::Point, G::Point) {
        let corners = self.boxes[parts].iter().flat_map(|(lower, upper)| [lower, upper]);
        bounding_box::<G>(corners).expect("the box of a part")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::{Level, Plane, Space};
    use crate::threads::Threads;

    fn random<G: Dimension>(n: usize) -> Vec<G::Point> {
        let mut state = 1u64;
        let mut unit = || {
            state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let mut points = vec![G::Point::default(); n];
        points.iter_mut().for_each(|p| (0..G::D).for_each(|k| p[k] = unit()));
        points
    }

    /// Parts are triangulated as such, and their sizes, hulls and counters are those of one triangulation.
    fn unites<G: Dimension>() {
        for threads in [2, 3, 5] {
            let mut t = Delaunay::<G>::on(Threads::at_most(threads));
            t.add_sites(&random::<G>(3000)).expect("room for it");
            let coincident = t.triangulate_parts(&mut |_| true).expect("room for it");
            assert_eq!(coincident, Some(Vec::new()));
            t.validate(Level::Delaunay).expect("a Delaunay triangulation");
            let mut one = Delaunay::<G>::default();
            one.add_sites(&random::<G>(3000)).expect("room for it");
            one.rebuild(&mut |_| true).expect("room for it");
            assert_eq!(t.complex().n_finite(), one.complex().n_finite());
            assert_eq!(t.complex().n_ghosts(), one.complex().n_ghosts());
            assert!(t.mean_walk() < 2.0 * one.mean_walk(), "{} and {}", t.mean_walk(), one.mean_walk());
        }
    }

    #[test]
    fn parts_are_united() {
        unites::<Plane>();
        unites::<Space>();
    }

    #[test]
    fn flat_parts_are_left_to_one_thread() {
        let mut points = random::<Plane>(3000);
        points.iter_mut().filter(|p| p[0] < 0.6).for_each(|p| p[1] = 0.0);
        let mut t = Delaunay::<Plane>::on(Threads::at_most(2));
        t.add_sites(&points).expect("room for it");
        assert_eq!(t.triangulate_parts(&mut |_| true), Ok(None));
        assert_eq!(t.rebuild(&mut |_| true), Ok(Vec::new()));
        t.validate(Level::Delaunay).expect("a Delaunay triangulation");
    }
}
