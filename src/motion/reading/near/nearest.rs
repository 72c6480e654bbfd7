//! The vertices nearest to a place.
//!
//! Some neighbour of a vertex that is not the nearest is nearer. So a walk along edges ends at the nearest one, and of
//! the vertices in order of distance each is a neighbour of an earlier one, but for those that are nearest: these are
//! on an empty sphere around the place, so they are connected by edges. Distances are compared exactly.
//!
//! With weights the same is true of powers and of the vertices that are shown: one of greater power than another is out
//! of its cell, beyond a facet, and those of least power are the corners of a face of the lower hull. So
//! [`nearest_vertex`] is the one of least power. In order of distance vertices are found by cells there, whether they
//! are shown or not.
//!
//! [`nearest_vertex`]: MovingTriangulation::nearest_vertex

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use crate::complex::INFINITE;
use crate::delaunay::{IndexSet, Keys, Moving, Place};
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::reading::near::AroundSite;
use crate::motion::state::checking::check_position;
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::{PointArray, compare_distance, squared_distance};

/// A search for the nearest vertex that has looked around so many others is on a long way.
const MANY_STARS: u32 = 8;

/// A vertex that waits to be the next in order of distance from a place: the greatest is the nearest, of the nearest
/// ones that of the lowest rank: by key, place and id.
struct WaitingVertex<'t, P> {
    q: &'t P,
    point: &'t P,
    vertex: VertexId,
    site: SiteId,
    keys: &'t Keys,
}

impl<P: AsRef<[f64]>> Ord for WaitingVertex<'_, P> {
    fn cmp(&self, other: &Self) -> Ordering {
        compare_distance(self.q, other.point, self.point).then_with(|| {
            let [place, own] = [other, self].map(|next| next.point.as_ref());
            self.keys.compare_at((other.vertex, place), (self.vertex, own))
        })
    }
}

impl<P: AsRef<[f64]>> PartialOrd for WaitingVertex<'_, P> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<P: AsRef<[f64]>> PartialEq for WaitingVertex<'_, P> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<P: AsRef<[f64]>> Eq for WaitingVertex<'_, P> {}

impl<G: Moving> MovingTriangulation<G> {
    /// The vertex nearest to a point, of the nearest that of the lowest key, then place, then id; `None` if there are
    /// no vertices. Distances are compared exactly. With weights it is the vertex of least power, in whose power cell
    /// the point is, whatever weight is given with that; never one that weights hide. Where there are no cells, and
    /// several have the least power, that takes as long as a build.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// assert_eq!(t.nearest_vertex(&[0.8, 0.1])?, Some(VertexId::new(1)));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`](crate::Error::NotFinite), [`Error::OutOfRange`](crate::Error::OutOfRange),
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn nearest_vertex(&self, position: &G::Point) -> Result<Option<VertexId>> {
        let q = check_position::<G>("position", 0, position)?;
        if !self.mesh.kernel.has_cells() {
            return self.nearest_without_cells(&q);
        }
        let (nearest, _) = self.nearest_sites(&q, Slot::NONE)?;
        let lowest = nearest.as_slice().iter().copied().min_by(|&s, &t| self.compare_ranks(s, t));
        Ok(lowest.map(|s| self.mesh.kernel.site(s).id))
    }

    /// The `k` vertices nearest to each of several places, told to `found` one after the other: `k` for each place, in
    /// order of distance, whatever weights are, and, at the same distance, of key, then place, then id, hidden ones
    /// included; [`VertexId::NONE`] where there are no more. Each place is looked for from the one before.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let mut found = Vec::new();
    /// t.nearest_vertices(&[[0.75, 0.25]], 3, |vertex| found.push(vertex))?;
    /// assert_eq!(found, [1, 0, 3].map(VertexId::new));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`](crate::Error::NotFinite) and [`Error::OutOfRange`](crate::Error::OutOfRange) for a place,
    /// before anything is told; [`Error::OutOfMemory`](crate::Error::OutOfMemory), before or after.
    pub fn nearest_vertices(
        &self,
        positions: &[G::Point],
        k: usize,
        mut found: impl FnMut(VertexId),
    ) -> Result<()> {
        for (index, position) in positions.iter().enumerate() {
            check_position::<G>("positions", index, position)?;
        }
        if k == 0 {
            return Ok(());
        }
        let mut near = Slot::NONE;
        let (mut around, mut seen) = (AroundSite::default(), IndexSet::new());
        for q in positions {
            let mut waiting = BinaryHeap::new();
            seen.clear();
            if self.are_by_cells() {
                near = self.enter_by_cells(q, k, near, &mut waiting)?;
            } else if self.mesh.kernel.has_cells() {
                let (nearest, start) = self.nearest_sites(q, near)?;
                near = start;
                for &s in nearest.as_slice() {
                    seen.insert(s)?;
                    memory::enter(&mut waiting, self.candidate(q, s))?;
                }
            } else {
                for s in self.mesh.kernel.live_sites() {
                    memory::enter(&mut waiting, self.candidate(q, s))?;
                }
            }
            for n_wanted in (0..k).rev() {
                let next = waiting.pop();
                found(next.as_ref().map_or(VertexId::NONE, |next| next.vertex));
                if let Some(next) = next.filter(|_| n_wanted > 0) {
                    self.enter_after(&next, &mut around, &mut seen, &mut waiting)?;
                }
            }
        }
        Ok(())
    }

    fn candidate<'t>(&'t self, q: &'t G::Point, s: SiteId) -> WaitingVertex<'t, G::Point> {
        let site = self.mesh.kernel.site(s);
        WaitingVertex { q, point: &site.point, vertex: site.id, site: s, keys: self.mesh.kernel.keys() }
    }

    /// Has what can follow a vertex wait: of those hidden at its place the ones below it in their tree, as there may be
    /// thousands of which few are wanted; and the neighbours of a representative.
    fn enter_after<'t>(
        &'t self,
        next: &WaitingVertex<'t, G::Point>,
        around: &mut AroundSite,
        seen: &mut IndexSet<SiteId>,
        waiting: &mut BinaryHeap<WaitingVertex<'t, G::Point>>,
    ) -> Result<()> {
        let &WaitingVertex { q, point, vertex, site, keys } = next;
        for top in self.mesh.hidden.tops_below(vertex).into_iter().filter(|&top| top != VertexId::NONE) {
            memory::enter(waiting, WaitingVertex { q, point, vertex: top, site, keys })?;
        }
        if vertex != self.mesh.kernel.site(site).id || self.are_by_cells() {
            return Ok(());
        }
        for &x in around.list(&self.mesh.kernel, site)? {
            if seen.insert(x)? {
                memory::enter(waiting, self.candidate(q, x))?;
            }
        }
        Ok(())
    }

    /// Whether there are cells of which some vertex has no neighbour that is nearer to a place than itself though it is
    /// not the nearest: those of a constrained triangulation, and those with weights.
    #[inline(always)]
    pub(super) fn are_by_cells(&self) -> bool {
        let kernel = &self.mesh.kernel;
        kernel.is_constrained() || G::HAS_WEIGHTS && kernel.has_cells()
    }

    /// All sites nearest to a place, with weights those of least power, where there are cells, and a slot near it;
    /// `near` is where to begin.
    pub(super) fn nearest_sites(&self, q: &G::Point, near: Slot) -> Result<(IndexSet<SiteId>, Slot)> {
        let mut nearest = IndexSet::new();
        if self.mesh.kernel.is_constrained() {
            let start = self.list_nearest_by_cells(q, near, &mut nearest)?;
            return Ok((nearest, start));
        }
        let place = self.mesh.kernel.locate(q, near);
        let start = self.slot_at(place);
        let mut best = match place {
            Place::Site(s) if G::HAS_WEIGHTS => s,
            Place::Site(s) => {
                nearest.insert(s)?;
                return Ok((nearest, start));
            }
            _ => {
                let corners = self.mesh.kernel.complex().cell(start).corners;
                let finite = corners.as_ref().iter().copied().filter(|&s| s != INFINITE);
                finite.min_by(|&a, &b| self.compare(q, a, b)).expect("a cell has finite corners")
            }
        };
        nearest.insert(best)?;
        let mut around = AroundSite::default();
        // The stars of the sites before this index have been looked at.
        let (mut next, mut n_stars) = (0, 0);
        while let Some(&s) = nearest.as_slice().get(next) {
            next += 1;
            n_stars += 1;
            // Where cells are long, a landmark can be nearer by far.
            if n_stars == MANY_STARS
                && let Some(landmark) = self.nearer_landmark(q, best)
            {
                best = landmark;
                nearest.clear();
                nearest.insert(best)?;
                next = 0;
                continue;
            }
            for &x in around.list(&self.mesh.kernel, s)? {
                match self.compare(q, x, best) {
                    Ordering::Less => {
                        best = x;
                        nearest.clear();
                        nearest.insert(x)?;
                        next = 0;
                    }
                    Ordering::Equal => {
                        nearest.insert(x)?;
                    }
                    Ordering::Greater => {}
                }
            }
        }
        Ok((nearest, start))
    }

    /// Lists all sites nearest to a place by cells; returns a slot near it.
    fn list_nearest_by_cells(
        &self,
        q: &G::Point,
        near: Slot,
        nearest: &mut IndexSet<SiteId>,
    ) -> Result<Slot> {
        self.for_sites_by_cells(q, near, |s| {
            let order = nearest.as_slice().first().map_or(Ordering::Less, |&best| self.compare(q, s, best));
            if order == Ordering::Less {
                nearest.clear();
            }
            if order != Ordering::Greater {
                nearest.insert(s)?;
            }
            Ok(squared_distance(q, self.mesh.kernel.place(nearest.as_slice()[0])))
        })
    }

    /// Has the vertices at the `k` sites nearest to a place wait, by cells, and maybe others; returns a slot near it.
    fn enter_by_cells<'t>(
        &'t self,
        q: &'t G::Point,
        k: usize,
        near: Slot,
        waiting: &mut BinaryHeap<WaitingVertex<'t, G::Point>>,
    ) -> Result<Slot> {
        // The farthest of the k nearest so far is the first.
        let mut best: BinaryHeap<Reverse<WaitingVertex<'t, G::Point>>> = BinaryHeap::new();
        self.for_sites_by_cells(q, near, |s| {
            memory::enter(waiting, self.candidate(q, s))?;
            memory::enter(&mut best, Reverse(self.candidate(q, s)))?;
            if best.len() > k {
                best.pop();
            }
            let farthest = best.peek().filter(|_| best.len() == k);
            Ok(farthest.map_or(f64::INFINITY, |Reverse(farthest)| squared_distance(q, farthest.point)))
        })
    }

    /// A landmark that is nearer to `q` than a site, if one is known.
    #[cold]
    fn nearer_landmark(&self, q: &G::Point, than: SiteId) -> Option<SiteId> {
        self.mesh.kernel.landmark(q).filter(|&landmark| self.compare(q, landmark, than) == Ordering::Less)
    }

    fn compare(&self, q: &G::Point, a: SiteId, b: SiteId) -> Ordering {
        q.compare_powers(&self.mesh.kernel.site(a).point, &self.mesh.kernel.site(b).point)
    }

    /// The nearest vertex where there are no cells.
    fn nearest_without_cells(&self, q: &G::Point) -> Result<Option<VertexId>> {
        let sites = || self.mesh.kernel.live_sites();
        let Some(best) = self.nearest_of(q, sites()) else { return Ok(None) };
        let is_as_near = |&s: &SiteId| self.compare(q, s, best) == Ordering::Equal;
        let best = if G::HAS_WEIGHTS && sites().filter(is_as_near).nth(1).is_some() {
            let hidden = self.mesh.kernel.hidden_without_cells()?;
            self.nearest_of(q, sites().filter(|s| hidden.binary_search(s).is_err()))
                .expect("not all are hidden")
        } else {
            best
        };
        Ok(Some(self.mesh.kernel.site(best).id))
    }

    fn nearest_of(&self, q: &G::Point, mut sites: impl Iterator<Item = SiteId>) -> Option<SiteId> {
        let mut best = sites.next()?;
        for s in sites {
            let order = self.compare(q, s, best);
            if order.then_with(|| self.compare_ranks(s, best)) == Ordering::Less {
                best = s;
            }
        }
        Some(best)
    }

    /// The order of what represents two sites, by key, place and id.
    fn compare_ranks(&self, s: SiteId, t: SiteId) -> Ordering {
        let [first, second] = [s, t].map(|s| {
            let site = self.mesh.kernel.site(s);
            (site.id, site.point.as_ref())
        });
        self.mesh.kernel.keys().compare_at(first, second)
    }
}
