//! Which vertices are near a place.
//!
//! Each vertex counts once, by its *nearest image*: what particle codes call the minimum image. Some neighbour of an image that
//! is not the nearest of all to a place is nearer, and the nearest image of that neighbour is no farther. So the vertices, each
//! beside those that it has a common cell with in any period, are connected as those of an open triangulation are: a walk from
//! vertex to nearer vertex ends at the nearest one, of the vertices in order of distance each is beside an earlier one, and those in a
//! ball are connected. Of those that are nearest, images are on an empty sphere around the place, and connected, too.
//!
//! Distances are compared exactly: a nearest image y of a place q has |(y − q) · v| ≤ v² / 2 for each vector v of the lattice, so
//! it is nearer than the images that can be corners of a cell may be (lattice.rs), and sums on the grid are exact.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use crate::delaunay::{IndexSet, Moving};
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::{Location, check_not_negative};
use crate::periodic::inside::all;
use crate::periodic::locating::AtImage;
use crate::periodic::triangulation::PeriodicTriangulation;
use crate::predicates::{PointArray, compare_distance, is_within_distance, squared_distance};

/// A flood that has come to more vertices than this share of them takes longer than a pass over all.
const MOST_OF_ALL: f64 = 0.05;

/// A vertex that waits to be the next in order of distance from a place, with its nearest image: the greatest is the nearest, of
/// the nearest ones that of the lowest id.
struct WaitingImage<'q, P> {
    q: &'q P,
    image: P,
    vertex: VertexId,
    is_hidden: bool,
}

impl<P: AsRef<[f64]>> Ord for WaitingImage<'_, P> {
    fn cmp(&self, other: &Self) -> Ordering {
        compare_distance(self.q, &other.image, &self.image).then_with(|| other.vertex.cmp(&self.vertex))
    }
}

impl<P: AsRef<[f64]>> PartialOrd for WaitingImage<'_, P> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<P: AsRef<[f64]>> PartialEq for WaitingImage<'_, P> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<P: AsRef<[f64]>> Eq for WaitingImage<'_, P> {}

/// The vertices that have a common cell with one in any period; kept as scratch from one to the next.
#[derive(Default)]
struct BesideVertex {
    star: Vec<CellId>,
    vertices: Vec<VertexId>,
}

impl BesideVertex {
    fn list<G: Moving>(&mut self, t: &PeriodicTriangulation<G>, vertex: VertexId) -> Result<&[VertexId]> {
        t.inside.t.star(t.inside.images.home(vertex), &mut self.star)?;
        let corners = t.inside.t.cells()?.corners;
        self.vertices.clear();
        for &cell in &self.star {
            let beside = corners[cell].as_ref().iter().map(|&v| t.inside.images.of(v).vertex);
            memory::collect(&mut self.vertices, beside)?;
        }
        self.vertices.sort_unstable();
        self.vertices.dedup();
        Ok(&self.vertices)
    }
}

impl<G: Moving> PeriodicTriangulation<G> {
    /// The vertex of which an image is nearest to a position, rounded to the grid of the lattice; with weights, of least power
    /// distance. Of the nearest that of the lowest id; `None` if there are no vertices. Distances are compared exactly.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::Options, periodic::PeriodicTriangulation};
    ///
    /// let points = [[0.125, 0.5], [0.5, 0.5]];
    /// let t = PeriodicTriangulation::<Plane>::new(&points, &[[1.0, 0.0], [0.0, 1.0]], Options::default())?;
    /// assert_eq!(t.nearest_vertex(&[0.875, 7.5])?, Some(VertexId::new(0)));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`](crate::Error::NotFinite), [`Error::OutOfRange`](crate::Error::OutOfRange),
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn nearest_vertex(&self, position: &G::Point) -> Result<Option<VertexId>> {
        let (q, _) = self.lattice.wrapped("position", 0, position)?;
        let start = self.start_at(self.inside.t.locate(&q)?)?;
        let nearest = self.nearest_of(&q, start)?.into_iter().min_by(|(vertex, image), (other, of_other)| {
            q.compare_powers(image, of_other).then(vertex.cmp(other))
        });
        Ok(nearest.map(|(vertex, _)| vertex))
    }

    /// The `k` vertices nearest to each of several positions, rounded to the grid of the lattice, told to `found` one after the
    /// other: `k` for each position, each once, by the distance of its nearest image and, at the same distance, by id, hidden ones
    /// included; [`VertexId::NONE`] where there are no more.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::Options, periodic::PeriodicTriangulation};
    ///
    /// let points = [[0.125, 0.5], [0.5, 0.5]];
    /// let t = PeriodicTriangulation::<Plane>::new(&points, &[[1.0, 0.0], [0.0, 1.0]], Options::default())?;
    /// let mut found = Vec::new();
    /// t.nearest_vertices(&[[0.875, 7.5]], 3, |vertex| found.push(vertex))?;
    /// assert_eq!(found, [VertexId::new(0), VertexId::new(1), VertexId::NONE]);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`](crate::Error::NotFinite) and [`Error::OutOfRange`](crate::Error::OutOfRange) for a position,
    /// before anything is told; [`Error::OutOfMemory`](crate::Error::OutOfMemory), before or after.
    pub fn nearest_vertices(
        &self,
        positions: &[G::Point],
        k: usize,
        mut found: impl FnMut(VertexId),
    ) -> Result<()> {
        let asked = self.asked(positions)?;
        if k == 0 {
            return Ok(());
        }
        if G::HAS_WEIGHTS {
            return asked.places.iter().try_for_each(|q| self.nearest_by_distance(q, k, &mut found));
        }
        let hidden = self.hidden_by_shown()?;
        let mut inner = Vec::new();
        memory::reserve_exact(&mut inner, positions.len())?;
        self.inside.t.locate_points(&asked.places, None, |location| inner.push(location))?;
        let mut beside = BesideVertex::default();
        for (q, inner) in asked.places.iter().zip(inner) {
            let (mut seen, mut waiting) = (IndexSet::new(), BinaryHeap::new());
            let has_cells = inner != Location::NoCells;
            for (vertex, image) in self.nearest_of(q, self.start_at(inner)?)? {
                seen.insert(vertex)?;
                memory::enter(&mut waiting, WaitingImage { q, image, vertex, is_hidden: false })?;
            }
            for n_wanted in (0..k).rev() {
                let next = waiting.pop();
                found(next.as_ref().map_or(VertexId::NONE, |next| next.vertex));
                let Some(next) = next.filter(|next| n_wanted > 0 && !next.is_hidden) else { continue };
                for &(_, vertex) in hidden_at(&hidden, next.vertex) {
                    let candidate = WaitingImage { q, image: next.image, vertex, is_hidden: true };
                    memory::enter(&mut waiting, candidate)?;
                }
                let others: &[VertexId] = if has_cells { beside.list(self, next.vertex)? } else { &[] };
                for &vertex in others {
                    if seen.insert(vertex)? {
                        let image = self.nearest_image(q, vertex);
                        memory::enter(&mut waiting, WaitingImage { q, image, vertex, is_hidden: false })?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Tells the vertices nearest to a place, by a look at all of them: neighbours by power need not be near.
    fn nearest_by_distance(&self, q: &G::Point, k: usize, found: &mut impl FnMut(VertexId)) -> Result<()> {
        let mut all = BinaryHeap::new();
        for (vertex, _) in self.inside.images.homes() {
            let image = self.nearest_image(q, vertex);
            memory::enter(&mut all, WaitingImage { q, image, vertex, is_hidden: false })?;
        }
        (0..k).for_each(|_| found(all.pop().map_or(VertexId::NONE, |next| next.vertex)));
        Ok(())
    }

    /// The vertices of which an image is in a closed ball around a centre, rounded to the grid of the lattice: those of which the
    /// squared distance from it is at most `squared_radius`, exactly. Ascending, each once, hidden ones included.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::Options, periodic::PeriodicTriangulation};
    ///
    /// let points = [[0.125, 0.5], [0.5, 0.5]];
    /// let t = PeriodicTriangulation::<Plane>::new(&points, &[[1.0, 0.0], [0.0, 1.0]], Options::default())?;
    /// assert_eq!(t.vertices_in_ball(&[0.875, 7.5], 0.0625)?, [VertexId::new(0)]);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`](crate::Error::NotFinite), [`Error::OutOfRange`](crate::Error::OutOfRange),
    /// [`Error::InvalidValue`](crate::Error::InvalidValue) if the squared radius is negative or NaN,
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn vertices_in_ball(&self, centre: &G::Point, squared_radius: f64) -> Result<Vec<VertexId>> {
        let (q, _) = self.lattice.wrapped("centre", 0, centre)?;
        check_not_negative("squared_radius", squared_radius)?;
        let is_in = |image: &G::Point| is_within_distance(&q, image, squared_radius);
        let inner = self.inside.t.locate(&q)?;
        let mut found = Vec::new();
        if inner == Location::NoCells
            || self.inside.t.hidden_count() > 0
            || G::HAS_WEIGHTS
            || !self.flood_ball(&q, inner, is_in, &mut found)?
        {
            found.clear();
            for (vertex, _) in self.inside.images.homes() {
                if is_in(&self.nearest_image(&q, vertex)) {
                    memory::push(&mut found, vertex)?;
                }
            }
        }
        found.sort_unstable();
        Ok(found)
    }

    /// Lists the vertices in a ball around a place that is there inside; whether all have been found, before a pass over all takes
    /// less.
    fn flood_ball(
        &self,
        q: &G::Point,
        inner: Location,
        is_in: impl Fn(&G::Point) -> bool,
        found: &mut Vec<VertexId>,
    ) -> Result<bool> {
        let (mut seen, mut beside) = (IndexSet::new(), BesideVertex::default());
        for (vertex, image) in self.nearest_of(q, self.start_at(inner)?)? {
            seen.insert(vertex)?;
            if is_in(&image) {
                memory::push(found, vertex)?;
            }
        }
        let mut next = 0;
        while let Some(&vertex) = found.get(next) {
            next += 1;
            for &other in beside.list(self, vertex)? {
                if seen.insert(other)? && is_in(&self.nearest_image(q, other)) {
                    memory::push(found, other)?;
                }
            }
            if next as f64 > MOST_OF_ALL * self.vertex_count() as f64 + 8.0 {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// A vertex near a place that is there inside; none where there are no cells.
    fn start_at(&self, inner: Location) -> Result<Option<VertexId>> {
        let corner = match inner {
            Location::Vertex(v) => v,
            Location::Cell(cell) | Location::Outside(cell) => {
                self.inside.t.cells()?.corners[cell].as_ref()[0]
            }
            Location::NoCells => return Ok(None),
        };
        let cells = self.read_cells()?;
        Ok(Some(match self.at_image(cells, self.inside.images.of(corner))? {
            AtImage::Corner(image) => image.vertex,
            AtImage::Above((class, _)) => cells.corners[class].as_ref()[0],
        }))
    }

    /// All vertices, but hidden ones, that are nearest to a place in the unit cell, each with its nearest image, from a vertex on;
    /// where there are no cells, all vertices but hidden ones.
    fn nearest_of(&self, q: &G::Point, start: Option<VertexId>) -> Result<Vec<(VertexId, G::Point)>> {
        let mut nearest = Vec::new();
        // At a vertex there may be no cells around it, as it is on a line with all others.
        let Some(start) = start.filter(|_| self.inside.t.cell_count() > 0) else {
            for (vertex, _) in self.inside.images.homes() {
                if self.represented(vertex)? == vertex {
                    memory::push(&mut nearest, (vertex, self.nearest_image(q, vertex)))?;
                }
            }
            return Ok(nearest);
        };
        let (mut tied, mut beside) = (IndexSet::new(), BesideVertex::default());
        let mut best = self.nearest_image(q, start);
        tied.insert(start)?;
        memory::push(&mut nearest, (start, best))?;
        // The stars of the vertices before this index have been looked at.
        let mut next = 0;
        while let Some(&(vertex, _)) = nearest.get(next) {
            next += 1;
            for &other in beside.list(self, vertex)? {
                let image = self.nearest_image(q, other);
                let order = q.compare_powers(&image, &best);
                if order == Ordering::Less {
                    best = image;
                    next = 0;
                    nearest.clear();
                    tied.clear();
                }
                if order != Ordering::Greater && tied.insert(other)? {
                    memory::push(&mut nearest, (other, image))?;
                }
            }
        }
        Ok(nearest)
    }

    /// The image of a vertex that is nearest to a place in the unit cell, or one of those.
    fn nearest_image(&self, q: &G::Point, vertex: VertexId) -> G::Point {
        let home = &self.inside.places[self.inside.images.home(vertex)];
        let mut way = *q;
        (0..G::D).for_each(|axis| way[axis] -= home[axis]);
        let mut best = self.lattice.translated(home, self.lattice.multiples(&way).map(|x| x.round() as i32));
        let way = self.lattice.short_way();
        if squared_distance(q, &best) <= way * way {
            return best;
        }
        let [a, b, c] = self.lattice.shifts_near(q, home);
        for (x, y, z) in all(a, b, c) {
            let image = self.lattice.translated(home, [x, y, z]);
            if compare_distance(q, &image, &best) == Ordering::Less {
                best = image;
            }
        }
        best
    }

    /// Hidden vertices, in order of what represents them.
    fn hidden_by_shown(&self) -> Result<Vec<(VertexId, VertexId)>> {
        let mut hidden = self.hidden_vertices()?;
        hidden.iter_mut().for_each(|(vertex, shown)| std::mem::swap(vertex, shown));
        hidden.sort_unstable();
        Ok(hidden)
    }
}

/// The part of a list of hidden vertices that one represents.
fn hidden_at(hidden: &[(VertexId, VertexId)], shown: VertexId) -> &[(VertexId, VertexId)] {
    let first = hidden.partition_point(|&(other, _)| other < shown);
    let n = hidden[first..].partition_point(|&(other, _)| other == shown);
    &hidden[first..first + n]
}
