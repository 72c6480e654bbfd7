//! The static triangulation on several threads.
//!
//! The sites are in [parts](super::parts) with hyperplanes between them. Each part is triangulated on a
//! thread of its own, by the same insertions as on one thread; then triangulations on either side of a
//! hyperplane are [united](super::unite), two by two. Where there are fewer threads than parts, they do one after the
//! other: what comes of it, slots included, depends on the parts alone.
//!
//! Invariants: a thread changes nothing but its own part's triangulation, of which it is the owner; that of the first
//! part has the sites of all and room for all cells, each other one a copy of its own sites and a part of that room,
//! where its cells stay; the monitor is called by the calling thread alone. Keys break the ties in a part as in the
//! whole, so the cells are those of a build on one thread.
//!
//! Cost: that of the largest part, and of uniting. Of a million sites in two parts 0.15 % are inserted again
//! in the plane, and 1.7 % in space. Where spheres reach far into other parts, as those of points on one
//! sphere do, all sites but those of one part are, on one thread: a build then takes a third longer. One thread alone takes
//! for 100,000 sites in two, four and eight parts 1, 1.05 and 1.1 times as long as in one in the plane, 1.06, 1.1 and 1.3
//! times in space; for 20,000 1.2 times in the plane, 1.15, 1.35 and 1.55 times in space; for 30,000 on a sphere 1.7 times in
//! two parts (`examples/thread_scaling`).

use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};

use super::order::{bounding_box, in_rounds};
use super::parts::{self, Parts};
use super::unite::Open;
use super::{Delaunay, Geometry, Keys, Site};
use crate::complex::INFINITE;
use crate::error::{Error, Result};
use crate::ids::SiteId;
use crate::machine::memory;
use crate::machine::threads::{self, Crew, Threads};

/// Share of the work that is done when the parts are triangulated, roughly.
const SHARE_OF_PARTS: f64 = 0.8;

/// Is told the fraction of the work that is done, and says whether to go on.
type Monitor<'m> = &'m mut dyn FnMut(f64) -> bool;

/// Pairs of coincident sites, the second in the cells.
type Coincident = Vec<(SiteId, SiteId)>;

/// What all threads read.
struct Build<'t, G: Geometry> {
    parts: &'t Parts,
    keys: Keys,
    n_sites: usize,
    /// The sites of each part but the first, after a placeholder, for the thread that triangulates it.
    copies: Vec<Mutex<Vec<Site<G>>>>,
    /// Bounding box of each part, none of which is without.
    boxes: Vec<Option<(G::Point, G::Point)>>,
    /// How many parts are triangulated.
    done: AtomicUsize,
    /// The threads at work, as many of them as there are parts at most.
    crew: Crew,
    n_threads: usize,
    /// Whether some thread has failed.
    stop: AtomicBool,
}

impl<G: Geometry> Delaunay<G> {
    /// Triangulates the parts of the live sites at the same time; returns pairs of coincident sites, the
    /// second in the cells. `None`, and no cells, if there is but one part or no memory for several, or one
    /// is flat.
    pub(super) fn triangulate_parts(
        &mut self,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Option<Coincident>> {
        let n_parts = self.parts.count();
        if n_parts == 1 {
            return Ok(None);
        }
        let n_sites = self.sites.len();
        let mut boxes = Vec::new();
        memory::lengthen(&mut boxes, n_parts, None)?;
        let n_threads = self.threads.for_work(n_parts, 1, 1);
        threads::fill(&mut boxes, n_threads, &|part| {
            let sites = &self.sites[self.parts.sites(part..part + 1, n_sites)];
            bounding_box::<G>(sites.iter().filter(|site| site.is_live()).map(|site| &site.point))
        });
        if boxes.contains(&None) {
            return Ok(None);
        }
        let Ok(copies) = self.copies(n_threads) else { return Ok(None) };
        let parts = std::mem::take(&mut self.parts);
        let build = Build {
            parts: &parts,
            keys: self.keys.another(),
            n_sites,
            copies,
            boxes,
            done: AtomicUsize::new(0),
            crew: self.threads.crew(),
            n_threads,
            stop: AtomicBool::new(false),
        };
        let (mut is_cancelled, mut furthest) = (false, 0.0);
        self.complex.clear();
        // The first part is triangulated here, where the sites of all are.
        let built = self.complex.reserve(build.n_cells_of(0..n_parts)).and_then(|()| {
            build.triangulate(self, 0..n_parts, &mut |fraction| {
                furthest = fraction.max(furthest);
                is_cancelled = is_cancelled || !monitor(furthest);
                !is_cancelled && !build.stop.load(Relaxed)
            })
        });
        self.complex.reclaim();
        self.parts = parts;
        match built {
            Ok(coincident) => {
                self.find_hidden()?;
                Ok(Some(coincident))
            }
            Err(_) => {
                self.flat.clear();
                if is_cancelled { Err(Error::Cancelled) } else { Ok(None) }
            }
        }
    }

    /// The [copies](Self::copy_of_part) of all parts.
    fn copies(&self, n_threads: usize) -> Result<Vec<Mutex<Vec<Site<G>>>>> {
        let mut copies = Vec::new();
        memory::reserve_exact(&mut copies, self.parts.count())?;
        for part in 0..self.parts.count() {
            copies.push(self.copy_of_part(part, n_threads)?);
        }
        Ok(copies)
    }

    /// The sites of a part, after a placeholder, with room for those of all parts that will be united with it; nothing
    /// for the first part.
    fn copy_of_part(&self, part: usize, n_threads: usize) -> Result<Mutex<Vec<Site<G>>>> {
        let mut copy = Vec::new();
        if part > 0 {
            let (n_parts, n_sites) = (self.parts.count(), self.sites.len());
            let room = self.parts.sites(part..parts::end_from(part, n_parts), n_sites).len();
            memory::reserve_exact(&mut copy, room + 1)?;
            copy.push(self.sites[INFINITE]);
            let own = &self.sites[self.parts.sites(part..part + 1, n_sites)];
            memory::extend(&mut copy, own, n_threads, |site| *site)?;
        }
        Ok(Mutex::new(copy))
    }
}

impl<G: Geometry> Build<'_, G> {
    /// Triangulates parts, for the cells of which there is [room](Self::n_cells_of).
    fn triangulate(&self, t: &mut Delaunay<G>, parts: Range<usize>, monitor: Monitor) -> Result<Coincident> {
        let built = if parts.len() == 1 {
            self.triangulate_one(t, parts.start, monitor)
        } else {
            self.triangulate_halves(t, parts, monitor)
        };
        // The work of the others is lost.
        self.stop.fetch_or(built.is_err(), Relaxed);
        built
    }

    fn triangulate_halves(
        &self,
        t: &mut Delaunay<G>,
        parts: Range<usize>,
        monitor: Monitor,
    ) -> Result<Coincident> {
        let middle = parts::middle(&parts);
        let [n_left, n_right] = [parts.start..middle, middle..parts.end].map(|half| self.n_cells_of(half));
        let complex = t.complex.divide(n_left, n_right)?;
        let mut left = |monitor: Monitor| self.triangulate(t, parts.start..middle, monitor);
        let right = |monitor: Monitor| {
            let keys = self.keys.another();
            let mut right = Delaunay { complex, keys, ..Delaunay::on(Threads::ONE)? };
            let coincident = self.triangulate(&mut right, middle..parts.end, monitor)?;
            let (lower, upper) = self.box_of(parts.start..middle);
            Ok((right.open(&lower, &upper)?, coincident))
        };
        let (left, right) = if self.crew.enter() {
            let right = || {
                let right = right(&mut |_| !self.stop.load(Relaxed));
                self.crew.leave();
                right
            };
            threads::join(|| left(monitor), right)
        } else {
            (left(monitor), right(monitor))
        };
        let mut coincident = left?;
        let (right, found): (Open<G>, Coincident) = right?;
        let first = SiteId::at(1 + self.parts.sites(parts.start..middle, self.n_sites).len());
        let moved = |s: SiteId| SiteId::at(s.index() + first.index() - 1);
        memory::collect(&mut coincident, found.into_iter().map(|(s, t)| (moved(s), moved(t))))?;
        let [from, to] = [middle, parts.end].map(|part| part as f64 / self.parts.count() as f64);
        let mut monitor = |fraction: f64| {
            let united = (1.0 - SHARE_OF_PARTS) * (from + (to - from) * fraction);
            monitor(self.share_triangulated(0.0) + united)
        };
        let n_threads = self.n_threads.min(parts.len());
        memory::append(&mut coincident, &t.unite(right, first, n_threads, &mut monitor)?)?;
        Ok(coincident)
    }

    /// Triangulates one part. A flat one is an error, whichever: the caller triangulates all on one thread
    /// then.
    fn triangulate_one(&self, t: &mut Delaunay<G>, part: usize, monitor: Monitor) -> Result<Coincident> {
        if part > 0 {
            t.sites = std::mem::take(&mut *self.copies[part].lock().expect("each is locked once"));
        }
        (t.lower, t.upper) = self.boxes[part].expect("the box of a part");
        t.filter = G::filter(&t.lower, &t.upper);
        let own = SiteId::range(1..1 + self.parts.sites(part..part + 1, self.n_sites).len());
        let order = in_rounds::<G>(own.filter(|&s| t.site(s).is_live()))?;
        if !order.iter().any(|&s| t.extend_basis(s)) {
            return Err(Error::Cancelled);
        }
        let mut monitor = |fraction: f64| monitor(self.share_triangulated(fraction));
        let coincident = t.triangulate_shown(&order, self.n_sites_of(part), &mut monitor)?;
        self.done.fetch_add(1, Relaxed);
        Ok(coincident)
    }

    /// The share of the work that is done while each thread has done this fraction of its part.
    fn share_triangulated(&self, fraction: f64) -> f64 {
        let done = self.done.load(Relaxed) as f64 + self.n_threads as f64 * fraction;
        SHARE_OF_PARTS * (done / self.parts.count() as f64).min(1.0)
    }

    /// For how many sites a part has room: while two triangulations are united there are more cells than before and
    /// after.
    fn n_sites_of(&self, part: usize) -> usize {
        let n = self.parts.sites(part..part + 1, self.n_sites).len();
        n + 8 * n.isqrt()
    }

    /// For how many cells parts have room.
    fn n_cells_of(&self, parts: Range<usize>) -> usize {
        parts.map(|part| Delaunay::<G>::n_cells_of(self.n_sites_of(part))).sum()
    }

    /// Bounding box of the sites of parts.
    fn box_of(&self, parts: Range<usize>) -> (G::Point, G::Point) {
        let corners = self.boxes[parts].iter().flatten().flat_map(|(lower, upper)| [lower, upper]);
        bounding_box::<G>(corners).expect("the box of a part")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::{Level, Plane, PowerPlane, PowerSpace, Space};
    use crate::random::Rng;

    fn random<G: Geometry>(n: usize) -> Vec<G::Point> {
        let rng = &mut Rng::new(1);
        let mut points = vec![G::Point::default(); n];
        // Of those with weights some are hidden.
        let most = |k: usize| if k < G::D { 1.0 } else { 2.0 * (n as f64).powf(-2.0 / G::D as f64) };
        points.iter_mut().for_each(|p| (0..G::NUMBERS).for_each(|k| p[k] = most(k) * rng.unit()));
        points
    }

    /// Parts are triangulated as such, and their sizes, hulls and counters are those of one triangulation.
    fn unites<G: Geometry>() {
        for threads in [2, 3, 5] {
            let mut t = Delaunay::<G>::on(Threads::exactly(threads)).expect("room for it");
            t.add_sites(&random::<G>(3000)).expect("room for it");
            let coincident = t.triangulate_parts(&mut |_| true).expect("room for it");
            assert_eq!(coincident, Some(Vec::new()));
            t.validate(Level::Delaunay).expect("a Delaunay triangulation");
            let mut one = Delaunay::<G>::default();
            one.add_sites(&random::<G>(3000)).expect("room for it");
            one.rebuild(&mut |_| true).expect("room for it");
            assert_eq!(t.complex().n_finite(), one.complex().n_finite());
            assert_eq!(t.complex().n_ghosts(), one.complex().n_ghosts());
            assert_eq!((t.n_hidden(), t.n_hidden() > 0), (one.n_hidden(), G::HAS_WEIGHTS));
            // Cells crossed by the walk of an insertion.
            let [of_parts, of_one] = [&t, &one].map(|t| t.cavity.steps as f64 / t.sites.len() as f64);
            assert!(of_parts < 2.0 * of_one, "{of_parts} and {of_one}");
        }
    }

    #[test]
    fn parts_are_united() {
        unites::<Plane>();
        unites::<Space>();
        unites::<PowerPlane>();
        unites::<PowerSpace>();
    }

    /// What is built depends on the parts alone, slot by slot, and progress never goes back.
    #[test]
    fn threads_do_not_show() {
        fn check<G: Geometry>() {
            for parts in [2, 5, 8] {
                let on = |threads| {
                    let mut t =
                        Delaunay::<G>::on(Threads::exactly(threads).in_parts(parts)).expect("room for it");
                    t.add_sites(&random::<G>(3000)).expect("room for it");
                    let mut told = vec![0.0];
                    let coincident = t.triangulate_parts(&mut |fraction| {
                        told.push(fraction);
                        true
                    });
                    assert_eq!(coincident, Ok(Some(Vec::new())));
                    assert!(told.is_sorted() && *told.last().expect("some") <= 1.0, "{told:?}");
                    t
                };
                let one = on(1);
                one.validate(Level::Delaunay).expect("a Delaunay triangulation");
                for threads in [2, 3, 7] {
                    let several = on(threads);
                    let cells = |t: &Delaunay<G>| format!("{:?}", t.complex().cells());
                    assert!(cells(&several) == cells(&one), "{threads} threads, {parts} parts");
                }
                let mut t = on(1);
                for most in [0.01, 0.3, 0.7, 0.9] {
                    assert_eq!(t.triangulate_parts(&mut |fraction| fraction < most), Err(Error::Cancelled));
                }
            }
        }
        check::<Plane>();
        check::<Space>();
        check::<PowerPlane>();
        check::<PowerSpace>();
    }

    /// No hyperplane separates parts of which a site has left for the place of another one; they are united all the
    /// same.
    #[test]
    fn parts_that_overlap_are_united() {
        fn unites<G: Geometry>() {
            for threads in [2, 5] {
                let mut t = Delaunay::<G>::on(Threads::exactly(threads)).expect("room for it");
                t.add_sites(&random::<G>(3000)).expect("room for it");
                let [first, last] = [SiteId::at(1), SiteId::at(3000)].map(|s| t.site(s).point);
                t.set_point(SiteId::at(1), last);
                t.set_point(SiteId::at(3000), first);
                assert_eq!(t.triangulate_parts(&mut |_| true), Ok(Some(Vec::new())));
                t.validate(Level::Delaunay).expect("a Delaunay triangulation");
            }
        }
        unites::<Plane>();
        unites::<Space>();
        unites::<PowerPlane>();
        unites::<PowerSpace>();
    }

    /// Points on the moment curve have a cell for each pair of pairs of neighbours along it: parts outgrow the room for
    /// their cells.
    #[test]
    fn parts_of_very_many_cells_are_united() {
        let n = 520;
        let rng = &mut Rng::new(1);
        let points: Vec<[f64; 3]> = (0..n).map(|_| rng.unit()).map(|x| [x, x * x, x * x * x]).collect();
        let mut t = Delaunay::<Space>::on(Threads::exactly(2)).expect("room for it");
        t.add_sites(&points).expect("room for it");
        assert_eq!(t.triangulate_parts(&mut |_| true), Ok(Some(Vec::new())));
        assert!(t.complex().n_finite() > 3 * Delaunay::<Space>::n_cells_of(n));
        t.validate(Level::Delaunay).expect("a Delaunay triangulation");
    }

    /// A triangulation that is built again has its room again, whether or not it was cancelled, and no more.
    #[test]
    fn room_is_divided_and_taken_back() {
        let mut t = Delaunay::<Space>::on(Threads::exactly(4)).expect("room for it");
        t.add_sites(&random::<Space>(3000)).expect("room for it");
        t.triangulate_parts(&mut |_| true).expect("room for it");
        let (room, n_slots) = (t.complex().n_cells_reserved(), t.complex().n_slots());
        for most in [0.5, 2.0, 0.9, 2.0] {
            let built = t.triangulate_parts(&mut |fraction| fraction < most);
            assert_eq!(built, if most > 1.0 { Ok(Some(Vec::new())) } else { Err(Error::Cancelled) });
            assert_eq!(t.complex().n_cells_reserved(), room);
        }
        assert_eq!(t.complex().n_slots(), n_slots);
        t.validate(Level::Delaunay).expect("a Delaunay triangulation");
    }

    #[test]
    fn flat_parts_are_left_to_one_thread() {
        let mut points = random::<Plane>(3000);
        points.iter_mut().filter(|p| p[0] < 0.6).for_each(|p| p[1] = 0.0);
        let mut t = Delaunay::<Plane>::on(Threads::exactly(2)).expect("room for it");
        t.add_sites(&points).expect("room for it");
        assert_eq!(t.triangulate_parts(&mut |_| true), Ok(None));
        assert_eq!(t.rebuild(&mut |_| true), Ok(Vec::new()));
        t.validate(Level::Delaunay).expect("a Delaunay triangulation");
    }
}
