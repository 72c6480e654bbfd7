//! Voronoi cells and facets, cut by a box.
//!
//! The Voronoi facet of an edge has the circumcentres of the cells around the edge for corners. If all of them are in
//! the box it is their polygon (in the plane a segment), and the cells of both vertices have a pyramid of it; otherwise
//! it is cut (`cut_facets.rs`), and so are both cells (`cut_cells.rs`). Which circumcentres are in the box is exact.
//!
//! While all vertices are in one hyperplane there are no cells, but in a box there still are Voronoi cells
//! (`flat_cells.rs`).
//!
//! # Cost
//!
//! In proportion to the cells: those around all edges are three times as many as there are in the plane, and six times
//! in space, and what is cut is visited twice more.

use crate::delaunay::Dimension;
use crate::error::{Error, Result};
use crate::ids::{CellId, SiteId, VertexId};
use crate::machine::memory;
use crate::motion::reading::geometry::clipping::{
    Clip, Vector, cross, dot, greatest, in_space, length_by, minus,
};
use crate::motion::reading::geometry::cut_facets::{Centres, CutFacet};
use crate::motion::reading::geometry::incidence::Neighbours;
use crate::motion::reading::geometry::rings::Ring;
use crate::motion::state::cells::Cells;
use crate::motion::state::checking::check_position;
use crate::motion::triangulation::MovingTriangulation;

/// A circumcentre is used where its radius is at most so many times the size of the box; one in the box, of a cell of
/// which a vertex is there, too, has less than half of that.
const LARGEST_RADIUS: f64 = 4.0;

/// How much is done between two calls of a monitor, in cells visited.
const WORK: usize = 1 << 15;

/// Tells a monitor how far the work is.
pub(super) struct Progress<'m> {
    monitor: &'m mut dyn FnMut(f64) -> bool,
    done: usize,
    asked_at: usize,
    expected: usize,
}

impl<'m> Progress<'m> {
    fn new(monitor: &'m mut dyn FnMut(f64) -> bool, expected: usize) -> Self {
        Progress { monitor, done: 0, asked_at: 0, expected }
    }

    /// Expects another amount of work in all.
    pub(super) fn expect(&mut self, expected: usize) {
        self.expected = expected.max(1);
    }

    /// Some more has been done.
    #[inline(always)]
    pub(super) fn advance(&mut self, n: usize) -> Result<()> {
        self.done += n;
        if self.done - self.asked_at < WORK { Ok(()) } else { self.ask() }
    }

    #[cold]
    fn ask(&mut self) -> Result<()> {
        self.asked_at = self.done;
        let fraction = (self.done as f64 / self.expected as f64).min(1.0);
        if (self.monitor)(fraction) { Ok(()) } else { Err(Error::Cancelled) }
    }
}

/// Computes Voronoi facets.
pub(super) struct Voronoi<'t, G: Dimension> {
    pub(super) t: &'t MovingTriangulation<G>,
    pub(super) cells: &'t Cells<G>,
    centres: Vec<G::Point>,
    /// The faces of the box that they are beyond; none without a box.
    sides: Vec<u8>,
    pub(super) ring: Ring,
    pub(super) facet: CutFacet,
}

/// What of a Voronoi facet is in the box.
enum Part {
    All,
    /// Some of it, or none.
    Cut,
}

impl<'t, G: Dimension> Voronoi<'t, G> {
    fn new(t: &'t MovingTriangulation<G>, clip: Option<&Clip>) -> Result<Self> {
        let cells = t.cell_arrays()?;
        let n_cells = cells.corners().len();
        let (mut centres, mut sides) = (Vec::new(), Vec::new());
        memory::reserve_exact(&mut centres, n_cells)?;
        match clip {
            None => centres.extend(t.circumspheres()?.map(|(centre, _)| centre)),
            Some(clip) => {
                memory::reserve_exact(&mut sides, n_cells)?;
                let most = LARGEST_RADIUS * clip.size;
                let mut slots = cells.slots().iter();
                centres.extend(t.circumspheres()?.map(|(centre, squared)| {
                    let places = t.mesh.kernel.places(*slots.next().expect("a slot for each cell"));
                    sides.push(clip.sides::<G>(&centre, squared, &places[..=G::D]));
                    if squared <= most * most { centre } else { infinite::<G>() }
                }));
            }
        }
        Ok(Voronoi { t, cells, centres, sides, ring: Ring::default(), facet: CutFacet::default() })
    }

    pub(super) fn place(&self, v: VertexId) -> Vector {
        self.t.place_in_space(v)
    }

    /// How much of the facet of the ring is in the box, if there is a box.
    #[inline(always)]
    fn part(&self) -> Part {
        let is_inside = |cell: &CellId| self.sides[cell.index()] == 0 && self.centres[*cell][0].is_finite();
        if self.ring.is_closed && self.ring.cells.iter().all(is_inside) { Part::All } else { Part::Cut }
    }

    /// Whether the facet of the ring is beyond a face of the box.
    fn is_outside(&self) -> bool {
        let sides = self.ring.cells.iter().fold(u8::MAX, |sides, cell| sides & self.sides[cell.index()]);
        self.ring.is_closed && sides != 0
    }

    /// Twice the area of the polygon of the circumcentres around an edge times the length of the edge; in the plane, the
    /// square of the distance between the two centres.
    #[inline(always)]
    fn rounded_measure(&self, along: &Vector) -> f64 {
        let centre = |cell: CellId| in_space::<G>(&self.centres[cell]);
        let (first, others) = self.ring.cells.split_first().expect("a cell at the edge");
        let first = centre(*first);
        let mut before = minus(&centre(others[0]), &first);
        if G::D == 2 {
            return dot(&before, &before);
        }
        let mut doubled = 0.0;
        for &cell in &others[1..] {
            let next = minus(&centre(cell), &first);
            doubled += dot(&cross(&before, &next), along);
            before = next;
        }
        doubled.abs()
    }

    /// Length or area of the polygon of the circumcentres around an edge, and the length of that.
    #[inline(always)]
    fn polygon(&self, [v, w]: [VertexId; 2]) -> [f64; 2] {
        let along = minus(&self.place(w), &self.place(v));
        let (square, rounded) = (dot(&along, &along), self.rounded_measure(&along));
        let is_safe = (square > LEAST_SQUARE) & (square < MOST_SQUARE) & (rounded < MOST);
        if !is_safe || G::D == 2 && rounded < LEAST_SQUARE && rounded != 0.0 {
            return self.polygon_scaled(&along);
        }
        let length = square.sqrt();
        [if G::D == 2 { rounded.sqrt() } else { 0.5 * rounded / length }, length]
    }

    /// The same where numbers are too large or too small for their products.
    #[cold]
    #[inline(never)]
    fn polygon_scaled(&self, along: &Vector) -> [f64; 2] {
        let length = length_by(dot(along, along), along);
        let unit = along.map(|x| x / greatest(along));
        let unit = unit.map(|x| x / dot(&unit, &unit).sqrt());
        let centre = |cell: CellId| in_space::<G>(&self.centres[cell]);
        let (first, others) = self.ring.cells.split_first().expect("a cell at the edge");
        let first = centre(*first);
        let most = others.iter().fold(greatest(&first), |most, &cell| most.max(greatest(&centre(cell))));
        if most == f64::INFINITY {
            return [most, length];
        }
        // Halves, as the difference may be twice the greatest number.
        let from_first = |cell: CellId| minus(&centre(cell).map(|x| 0.5 * x), &first.map(|x| 0.5 * x));
        let most = others.iter().fold(0.0f64, |most, &cell| most.max(greatest(&from_first(cell))));
        if most == 0.0 {
            return [0.0, length];
        }
        let scaled = |cell: CellId| from_first(cell).map(|x| x / most);
        if G::D == 2 {
            let along = scaled(others[0]);
            return [2.0 * (most * dot(&along, &along).sqrt()), length];
        }
        let doubled: f64 =
            others.windows(2).map(|pair| dot(&cross(&scaled(pair[0]), &scaled(pair[1])), &unit)).sum();
        let area = 2.0 * doubled.abs();
        // Not the square, which may be beyond the range of numbers where the area is not.
        [area * most * most, length]
    }

    /// Makes `facet` the part in the box of that of an edge, around which `ring` is.
    pub(super) fn cut(&mut self, [v, w]: [VertexId; 2], clip: &Clip) -> Result<()> {
        let has_left = self.ring.orient(self.cells, [v, w]);
        let edge = [self.place(v), self.place(w)];
        let (t, ring) = (self.t, &self.ring);
        self.facet.fill(edge, ring, |z| t.place_in_space(z), G::D == 2, has_left)?;
        let centres = Centres { places: &self.centres, sides: &self.sides };
        self.facet.cut(clip, &centres)?;
        self.facet.place(clip, &centres)
    }

    /// Goes around an edge of which `first` is a cell, and makes `facet` the part of its facet that is in the box;
    /// whether there is any.
    pub(super) fn cut_around(&mut self, edge: [VertexId; 2], first: CellId, clip: &Clip) -> Result<bool> {
        self.ring.go_around(self.cells, edge, first)?;
        if self.is_outside() {
            return Ok(false);
        }
        self.cut(edge, clip)?;
        Ok(true)
    }

    /// Length or area of the facet of an edge of which `first` is a cell.
    fn measure(&mut self, edge: [VertexId; 2], first: CellId, clip: Option<&Clip>) -> Result<f64> {
        let Some(clip) = clip else {
            self.ring.go_around(self.cells, edge, first)?;
            return Ok(if self.ring.is_closed { self.polygon(edge)[0] } else { f64::INFINITY });
        };
        self.ring.go_around(self.cells, edge, first)?;
        if let Part::All = self.part() {
            return Ok(self.polygon(edge)[0]);
        }
        if self.is_outside() {
            return Ok(0.0);
        }
        self.cut(edge, clip)?;
        Ok(self.facet.measure())
    }
}

/// Bounds of numbers of which products have neither overflowed nor lost more than a result may be off.
const LEAST_SQUARE: f64 = 1e-140;
const MOST_SQUARE: f64 = 1e140;
const MOST: f64 = 1e280;

fn infinite<G: Dimension>() -> G::Point {
    let mut p = G::Point::default();
    p[0] = f64::INFINITY;
    p
}

impl<G: Dimension> MovingTriangulation<G> {
    /// Areas or volumes of the Voronoi cells of all ids, within the box from `low` to `high` if these are given.
    /// Without a box that of a vertex of the convex hull is infinite, and so are all while there are no cells. NaN for
    /// removed vertices, 0 for hidden ones.
    ///
    /// Rounded: let h be 10⁻⁸ times the greatest extent of the box and 10⁻¹⁵ times the greatest magnitude of its
    /// coordinates; without a box, 10⁻⁸ times the greatest circumradius around the vertex and 10⁻¹⁵ times the greatest
    /// magnitude of coordinates of the circumcentres. A corner of a cell is off by at most h, and so the area or volume
    /// by h times the length or area of the surface of the cell; by a few last bits in place of 10⁻⁸, unless there are
    /// cells that are nearly flat. In the box, no corner is left out and none is too many.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let (low, high) = ([0.0, 0.0], [1.0, 1.0]);
    /// let areas = t.voronoi_volumes(Some([&low, &high]))?;
    /// assert!(areas.iter().all(|area| (area - 0.25).abs() < 1e-6));
    /// assert!(t.voronoi_volumes(None)?.iter().all(|area| area.is_infinite())); // all are on the hull
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::OutOfRange`] and [`Error::InvalidValue`] for the box, [`Error::OutOfMemory`].
    pub fn voronoi_volumes(&self, clip: Option<[&G::Point; 2]>) -> Result<Vec<f64>> {
        self.voronoi_volumes_monitored(clip, &mut |_| true)
    }

    /// As [`voronoi_volumes`](Self::voronoi_volumes). `monitor` is called now and then with the fraction done.
    ///
    /// # Errors
    /// As [`voronoi_volumes`](Self::voronoi_volumes), and [`Error::Cancelled`] if `monitor` returns `false`.
    pub fn voronoi_volumes_monitored(
        &self,
        clip: Option<[&G::Point; 2]>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Vec<f64>> {
        let clip = clip.map(checked::<G>).transpose()?;
        let mut volumes = Vec::new();
        memory::reserve_exact(&mut volumes, self.id_count())?;
        volumes.extend(self.mesh.site_of.iter().map(|&s| if s == SiteId::NONE { f64::NAN } else { 0.0 }));
        let progress = &mut Progress::new(monitor, self.expected_work(clip.is_some()));
        match clip {
            None if self.cell_count() == 0 => {
                self.mesh
                    .kernel
                    .live_sites()
                    .for_each(|s| volumes[self.mesh.kernel.site(s).id.index()] = f64::INFINITY);
            }
            None => self.whole_volumes(&mut volumes, progress)?,
            Some(clip) if self.cell_count() == 0 => self.flat_volumes(&clip, &mut volumes, progress)?,
            Some(clip) => self.volumes_in(&clip, &mut volumes, progress)?,
        }
        Ok(volumes)
    }

    /// The place of a vertex, in the plane at height 0.
    pub(super) fn place_in_space(&self, v: VertexId) -> Vector {
        in_space::<G>(&self.mesh.kernel.site(self.mesh.site_of[v]).point)
    }

    /// The number of cells around edges that are visited, at most.
    fn expected_work(&self, is_cut: bool) -> usize {
        let once = self.cell_count() * if G::D == 2 { 3 } else { 6 };
        if is_cut { 3 * once } else { once }
    }

    fn whole_volumes(&self, volumes: &mut [f64], progress: &mut Progress) -> Result<()> {
        let mut voronoi = Voronoi::new(self, None)?;
        // In the order of storage, as their sums have none.
        let vertices = self.mesh.kernel.live_sites().map(|s| self.mesh.kernel.site(s).id);
        self.for_edges(vertices, |edge, first| {
            voronoi.ring.go_around(voronoi.cells, edge, first)?;
            let pyramid =
                if voronoi.ring.is_closed { pyramid::<G>(voronoi.polygon(edge)) } else { f64::INFINITY };
            edge.into_iter().for_each(|v| volumes[v.index()] += pyramid);
            progress.advance(voronoi.ring.cells.len())
        })
        .map(drop)
    }

    fn volumes_in(&self, clip: &Clip, volumes: &mut [f64], progress: &mut Progress) -> Result<()> {
        let mut voronoi = Voronoi::new(self, Some(clip))?;
        let mut is_cut = Vec::new();
        memory::lengthen(&mut is_cut, self.id_count(), false)?;
        let vertices = self.mesh.kernel.live_sites().map(|s| self.mesh.kernel.site(s).id);
        let neighbours = self.for_edges(vertices, |edge, first| {
            if edge.into_iter().all(|v| is_cut[v.index()]) {
                return progress.advance(1);
            }
            voronoi.ring.go_around(voronoi.cells, edge, first)?;
            if let Part::All = voronoi.part() {
                let pyramid = pyramid::<G>(voronoi.polygon(edge));
                edge.into_iter().for_each(|v| volumes[v.index()] += pyramid);
            } else {
                edge.into_iter().for_each(|v| is_cut[v.index()] = true);
            }
            progress.advance(voronoi.ring.cells.len())
        })?;
        let cut = VertexId::range(0..self.id_count()).filter(|v| is_cut[v.index()]);
        voronoi.cut_volumes(clip, neighbours, cut, volumes, progress)
    }

    /// Lengths or areas of the Voronoi facets between the ends of all edges, in the order of [`edges`](Self::edges),
    /// within the box from `low` to `high` if these are given. Without a box that of an edge on the convex hull is
    /// infinite.
    ///
    /// Rounded: with h as for [`voronoi_volumes`](Self::voronoi_volumes), a length is off by at most 2 h, an area by h
    /// times the perimeter of the facet.
    ///
    /// # Errors
    /// As [`voronoi_volumes`](Self::voronoi_volumes).
    pub fn voronoi_facets(&self, clip: Option<[&G::Point; 2]>) -> Result<Vec<f64>> {
        self.voronoi_facets_monitored(clip, &mut |_| true)
    }

    /// As [`voronoi_facets`](Self::voronoi_facets). `monitor` is called now and then with the fraction done.
    ///
    /// # Errors
    /// As [`voronoi_facets`](Self::voronoi_facets), and [`Error::Cancelled`] if `monitor` returns `false`.
    pub fn voronoi_facets_monitored(
        &self,
        clip: Option<[&G::Point; 2]>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Vec<f64>> {
        let clip = clip.map(checked::<G>).transpose()?;
        let mut measures = Vec::new();
        memory::reserve_exact(&mut measures, self.edge_count())?;
        let progress = &mut Progress::new(monitor, self.expected_work(false));
        let mut voronoi = Voronoi::new(self, clip.as_ref())?;
        self.for_edges(VertexId::range(0..self.id_count()), |edge, first| {
            measures.push(voronoi.measure(edge, first, clip.as_ref())?);
            progress.advance(voronoi.ring.cells.len())
        })?;
        Ok(measures)
    }

    /// Whether `high` is above `low` in every coordinate, and both are good.
    pub(crate) fn check_clip(&self, clip: [&G::Point; 2]) -> Result<()> {
        checked::<G>(clip).map(drop)
    }

    /// Visits all edges with a cell of each, in the order of their lower ids in `vertices`.
    #[inline(always)]
    fn for_edges(
        &self,
        vertices: impl Iterator<Item = VertexId>,
        mut visit: impl FnMut([VertexId; 2], CellId) -> Result<()>,
    ) -> Result<Neighbours<'_, G>> {
        let mut neighbours = Neighbours::new(self.cell_arrays()?, self.id_count())?;
        let mut list = Vec::new();
        for v in vertices {
            neighbours.list(v, v, &mut list, |w, cell| (w, cell))?;
            for &(w, cell) in &list {
                visit([v, w], cell)?;
            }
        }
        Ok(neighbours)
    }
}

/// Area or volume of the pyramid from a vertex to a Voronoi facet, by the measure of that and the length of the edge.
#[inline(always)]
fn pyramid<G: Dimension>([measure, length]: [f64; 2]) -> f64 {
    // Half of the least length is zero.
    if measure == f64::INFINITY { measure } else { 0.5 * length * measure / G::D as f64 }
}

/// A box that is one.
fn checked<G: Dimension>([low, high]: [&G::Point; 2]) -> Result<Clip> {
    let (low, high) = (check_position::<G>("low", 0, low)?, check_position::<G>("high", 0, high)?);
    for axis in 0..G::D {
        if low[axis] >= high[axis] {
            let wanted = "above low";
            return Err(Error::InvalidValue { argument: "high", index: axis, value: high[axis], wanted });
        }
    }
    Ok(Clip::new::<G>(&low, &high))
}
