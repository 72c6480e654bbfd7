//! Volumes, boundaries and centroids of Voronoi cells in a box, from one pass over the facets of the Delaunay cells.
//!
//! # Idea
//!
//! The Voronoi facet of an edge ab is the polygon of the centres of the cells around it. Seen from the middle m of the
//! edge, it is the sum of signed triangles m, p, q of the centres of two cells that share a facet of the triangulation
//! with the edge on it: all that is outside of the polygon cancels. So no ring of cells has to be gone around: each
//! facet of the triangulation, with the centres p and q on its sides, has a piece for each of its edges. Let
//! e = b − a, g = q − p. In space the weight D = e · ((p − b) × g) is twice the area of the triangle times |e|, and
//! positive where the facet is seen from p with a before b counter-clockwise from the side of q. The tetrahedra of the
//! triangle with a and with b have volume D / 12 each, as their height is |e| / 2, and centroids that are a quarter of
//! the sum of p, q, m and the end. In the plane a facet of the triangulation is an edge itself, D = g × e is the length
//! of pq times |e|, and the triangles with a and b have area D / 4. Factors are left for the end.
//!
//! # Accuracy
//!
//! Let p and q be off by at most h, as the [circumspheres](crate::motion::MovingTriangulation::circumspheres) are. The
//! sums are those of polygons with the corners moved by that, whatever the sizes of the pieces, since all pieces take
//! the same p and q: an area is off by h times the perimeter. A product of e, p − b and g is rounded by a few ε = 2⁻⁵³
//! times |e| |p − b| |g|; |p − b| is the circumradius, and pieces add up to ε R times the perimeter: less than h has in
//! place of ε. Rounding of the sums themselves is relative to that of the magnitudes of pieces, which are bounded in
//! that way, too.
//!
//! For a volume let two facets of a cell meet in an edge E of the cell, at the feet f₁ and f₂ of the perpendiculars of
//! the vertex to them. A shift δ of the ends of E changes the volume by a third of |E| δ · R(f₁ − f₂) to first order,
//! where R turns by a right angle around E: each facet grows by |E| times the part of δ that is in it and away from it.
//! Both feet are on the circle over the perpendicular of the vertex to E, of length ρ, so that |f₁ − f₂| = ρ sin θ with
//! the angle θ between the normals. So with T the sum over the edges of the areas |E| ρ / 2 of the triangles that the
//! vertex makes with them, a volume is off by at most 2/3 h T: less than h times the surface unless a cell has dozens of
//! facets. In the plane, with r the distance of a corner, it is h/2 times the sum of r sin θ. With the
//! support function s of the cell, seen from the vertex, that is at most ∫ √(s² + s'²) ≤ ∫ s + ∫ |s'| over all
//! directions. The first is the length of the boundary, and so the second one at most: from a direction in which s is
//! greatest, M, to one in which it is least, it goes down by less than the integral of M times the cosine, which it
//! exceeds. So an area is off by at most h times the length of the boundary. With d the diameter of a cell of volume V,
//! its centroid is off by at most the error of the volume times d / V.
//!
//! The pieces of all cells have D of one and the same number for both ends, and their sum over a facet of the
//! triangulation is that between p and q; so volumes add up to that of what cells fill, however far p and q are off.
//!
//! # The same bits
//!
//! A vertex gets its sums from the cells around it in ascending order, with corners in the order of their rows.
//! Several threads have ranges of the sites, and each goes over all cells for its own. So sums depend neither on the
//! number of threads nor on which other vertices there is a mask for.
//!
//! # Cost
//!
//! One pass over the cells for the centres and one over their facets, two a cell in space. What the box cuts is done by
//! `cut_cells.rs`. With a mask, cells around its vertices are all that is looked at, but for a bit for each cell and
//! an entry for each id.

use crate::complex::Corners;
use crate::delaunay::Dimension;
use crate::error::Result;
use crate::ids::{CellId, SiteId, VertexId};
use crate::machine::prefetch::AHEAD;
use crate::machine::{memory, threads};
use crate::motion::reading::geometry::centres::{All, Centres, Numbering, Ranks, SHARED_AT_LEAST, ask_for};
use crate::motion::reading::geometry::clipping::{Clip, Vector, cross, dot, in_space, minus, times};
use crate::motion::reading::geometry::incidence::Neighbours;
use crate::motion::reading::geometry::progress::Progress;
use crate::motion::reading::geometry::sums::{LEAST_SQUARE, Sums};
use crate::motion::reading::geometry::voronoi::Voronoi;
use crate::motion::reading::geometry::voronoi_cells::checked;
use crate::motion::state::cells::NO_CELL;
use crate::motion::state::mesh::Standing;
use crate::motion::triangulation::MovingTriangulation;

/// What there is of the Voronoi cells of all ids in a box. A removed vertex, and one that is left out, has NaN in all
/// three; a hidden one has no volume.
#[derive(Clone, Debug, PartialEq)]
pub struct VoronoiCells<P> {
    /// Areas or volumes.
    pub volumes: Vec<f64>,
    /// Lengths or areas of the boundaries, with what they have of the box's.
    pub areas: Vec<f64>,
    /// Centroids; NaN where the volume is 0.
    pub centroids: Vec<P>,
}

/// What there is of one Voronoi cell in a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VoronoiCell<P> {
    /// Area or volume.
    pub volume: f64,
    /// Length or area of the boundary, with what it has of the box's.
    pub area: f64,
    /// Centroid; NaN where the volume is 0.
    pub centroid: P,
}

/// What a vertex has so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Target {
    /// From pieces: times 12, 2 and 48, in the plane times 4, 1 and 12.
    pub(super) sums: Sums,
    /// Whether pieces do not tell all.
    pub(super) is_cut: bool,
}

impl Target {
    /// By what to multiply sums of volumes, facets and moments.
    pub(super) fn factors<G: Dimension>(&self) -> [f64; 3] {
        match (self.is_cut, G::D) {
            (true, _) => [1.0; 3],
            (false, 2) => [0.25, 1.0, 1.0 / 12.0],
            (false, _) => [1.0 / 12.0, 0.5, 1.0 / 48.0],
        }
    }
}

/// In place of a target: there is none.
const NOWHERE: usize = usize::MAX;

/// By the corner opposite a facet of a cell, the other ones, counter-clockwise as seen from outside.
const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// How many cells are visited between two looks at whether to go on.
const CELLS_AT_A_TIME: usize = 1 << 16;

/// A facet between two cells: centres p and q on its sides, the way from p to q in the unit of the box.
struct Facet<'f> {
    unit: f64,
    p: &'f Vector,
    step: Vector,
}

impl Facet<'_> {
    /// Adds pieces to the vertices at its ends, in the plane, where it is an edge.
    #[inline(always)]
    fn add_in_plane(&self, [a, b]: [&Vector; 2], targets: [usize; 2], part: &mut [Target]) {
        let (step, to) = (&self.step, |x: &Vector| times(&minus(self.p, x), self.unit));
        let along = times(&minus(b, a), self.unit);
        let weight = step[0] * along[1] - step[1] * along[0];
        let square = dot(&along, &along);
        let facet = weight / square.sqrt();
        for (target, place) in targets.into_iter().zip([a, b]) {
            let Some(target) = part.get_mut(target) else { continue };
            let from = to(place);
            target.is_cut |= square < LEAST_SQUARE;
            target.sums.volume += weight;
            target.sums.facets += facet;
            target.sums.moment[0] += weight * (2.0 * from[0] + step[0]);
            target.sums.moment[1] += weight * (2.0 * from[1] + step[1]);
        }
    }

    /// Adds pieces to the vertices at its corners, in space.
    #[inline(always)]
    fn add_in_space(&self, [a, b, c]: [&Vector; 3], targets: [usize; 3], part: &mut [Target]) {
        let (step, unit) = (&self.step, self.unit);
        let to =
            [times(&minus(self.p, a), unit), times(&minus(self.p, b), unit), times(&minus(self.p, c), unit)];
        let edges = [times(&minus(b, a), unit), times(&minus(c, b), unit), times(&minus(a, c), unit)];
        let weights = [
            dot(&edges[0], &cross(&to[1], step)),
            dot(&edges[1], &cross(&to[2], step)),
            dot(&edges[2], &cross(&to[0], step)),
        ];
        let squares = [dot(&edges[0], &edges[0]), dot(&edges[1], &edges[1]), dot(&edges[2], &edges[2])];
        let facets =
            [weights[0] / squares[0].sqrt(), weights[1] / squares[1].sqrt(), weights[2] / squares[2].sqrt()];
        for k in 0..3 {
            let before = (k + 2) % 3;
            let Some(target) = part.get_mut(targets[k]) else { continue };
            let sums = &mut target.sums;
            let weight = weights[k] + weights[before];
            sums.volume += weight;
            sums.facets += facets[k] + facets[before];
            for axis in 0..3 {
                let middles = weights[k] * edges[k][axis] - weights[before] * edges[before][axis];
                sums.moment[axis] += weight * (2.0 * to[k][axis] + step[axis]) + 0.5 * middles;
            }
            target.is_cut |= (squares[k] < LEAST_SQUARE) | (squares[before] < LEAST_SQUARE);
        }
    }
}

impl<G: Dimension> Voronoi<'_, G> {
    /// Adds the pieces between cells that both fit, of cells of some numbers, to some of the targets, of which `first`
    /// is the first one's number; and marks those that have a cell that does not fit, a facet on the hull, or an edge
    /// that is too short for products.
    fn add_pieces(
        &self,
        unit: f64,
        numbers: std::ops::Range<usize>,
        (cells, sites): (impl Numbering, impl Numbering),
        first: usize,
        part: &mut [Target],
    ) {
        let kernel = &self.t.mesh.kernel;
        let centres = &self.centres.list[..];
        let end = numbers.end;
        for number in numbers {
            ask_for(self.t, self.cells, number + AHEAD..end, |number| self.centres.cell(number));
            let index = self.centres.cell(number);
            let corners = self.cells.sites(kernel, index);
            let target = |k: usize| {
                let s: SiteId = corners[k.min(G::D)];
                sites.number(s.index()).map_or(NOWHERE, |number| number.wrapping_sub(first))
            };
            let targets = [target(0), target(1), target(2), target(3)];
            if targets.iter().all(|&target| target >= part.len()) {
                continue;
            }
            let place = |k: usize| in_space::<G>(kernel.place(corners[k.min(G::D)]));
            let places = [place(0), place(1), place(2), place(3)];
            let centre = &centres[number];
            let fits = centre.fits();
            if !fits {
                mark(part, &targets);
            }
            let p = in_space::<G>(&centre.place);
            let neighbours = &self.cells.neighbours()[index];
            for k in 0..G::Corners::N {
                let next: CellId = neighbours[k];
                let face = if G::D == 2 { [(k + 1) % 3, (k + 2) % 3, (k + 1) % 3] } else { FACES[k] };
                let ends = [targets[face[0]], targets[face[1]], targets[face[2]]];
                if next == NO_CELL {
                    // The corner opposite the facet may have its cell inside.
                    mark(part, &ends);
                }
                if next == NO_CELL || next < index || !fits {
                    continue;
                }
                // A cell that is not chosen has no vertex of the mask.
                let Some(beyond) = cells.number(next.index()).map(|number| &centres[number]) else {
                    continue;
                };
                if !beyond.fits() {
                    continue;
                }
                let step = times(&minus(&in_space::<G>(&beyond.place), &p), unit);
                let facet = Facet { unit, p: &p, step };
                let at = [&places[face[0]], &places[face[1]], &places[face[2]]];
                if G::D == 2 {
                    facet.add_in_plane([at[0], at[1]], [ends[0], ends[1]], part);
                } else {
                    facet.add_in_space(at, ends, part);
                }
            }
        }
    }

    /// Adds all pieces to targets, which are numbered as sites are; on several threads where that pays.
    pub(super) fn add_all(
        &self,
        unit: f64,
        cells: impl Numbering,
        progress: &mut Progress,
        targets: &mut Targets<impl Numbering>,
    ) -> Result<()> {
        let (n, sites) = (self.centres.list.len(), targets.sites);
        for from in (0..n).step_by(CELLS_AT_A_TIME) {
            let numbers = from..n.min(from + CELLS_AT_A_TIME);
            let n_threads = self.t.mesh.kernel.threads().for_work(numbers.len(), SHARED_AT_LEAST, 64);
            let n_threads = n_threads.min(targets.list.len());
            threads::for_parts(&mut targets.list, 0, n_threads, &|first, part: &mut [Target]| {
                self.add_pieces(unit, numbers.clone(), (cells, sites), first, part);
            });
            progress.advance(numbers.len())?;
        }
        Ok(())
    }

    /// Puts the cells of those of some vertices together from corners that are marked as cut.
    fn cut_all(
        &mut self,
        clip: &Clip,
        vertices: &[VertexId],
        progress: &mut Progress,
        targets: &mut Targets<impl Numbering>,
    ) -> Result<()> {
        let t = self.t;
        let (site_of, sites) = (&t.mesh.site_of, targets.sites);
        let mut cut = Vec::new();
        for &v in vertices {
            let target = targets.of(site_of[v]);
            if target.is_cut {
                target.sums = Sums::default();
                memory::push(&mut cut, v)?;
            }
        }
        let around = t.cells_around(&cut)?;
        let neighbours = Neighbours::of(self.cells, t.id_count(), around.iter().copied())?;
        let cut = cut.into_iter();
        self.cut_cells(clip, neighbours, cut, progress, |v, part| targets.of(site_of[v]).sums.join(part))?;
        self.corner_parts(
            clip,
            |v| sites.number(site_of[v].index()).is_some(),
            |v, part| {
                targets.of(site_of[v]).sums.join(part);
            },
        )
    }
}

/// Marks targets as cut.
fn mark(part: &mut [Target], targets: &[usize]) {
    for &target in targets {
        if let Some(target) = part.get_mut(target) {
            target.is_cut = true;
        }
    }
}

/// The targets of a pass: vertices by number.
pub(super) struct Targets<S> {
    /// The numbers of sites.
    sites: S,
    list: Vec<Target>,
}

impl<S: Numbering> Targets<S> {
    pub(super) fn new(sites: S, n: usize) -> Result<Self> {
        let mut list = Vec::new();
        memory::lengthen(&mut list, n, Target::default())?;
        Ok(Targets { sites, list })
    }

    pub(super) fn of(&mut self, s: SiteId) -> &mut Target {
        &mut self.list[self.sites.number(s.index()).expect("a site of the pass")]
    }
}

impl<G: Dimension> MovingTriangulation<G> {
    /// Areas or volumes, boundaries and centroids of the Voronoi cells of all ids within the box from `low` to `high`,
    /// or of those of which `mask` has an entry that is not 0.
    ///
    /// Rounded: let h be 10⁻⁸ times the greatest extent of the box and 10⁻¹⁵ times the greatest magnitude of its
    /// coordinates. To first order in h, a volume is off by at most h times the area of the cell's surface or two
    /// thirds of that of the triangles that the vertex makes with its edges, whichever is more (an area, by h times the
    /// length of the boundary), an area by h times the sum of the perimeters of its facets, and a centroid by the error
    /// of the volume times d / V, where d is the diameter of the cell and V its volume.
    /// In place of 10⁻⁸ it is some last bits unless cells are nearly flat. The volumes of all ids add up to that of the
    /// box.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let cells = t.voronoi_cells([&[0.0, 0.0], &[1.0, 1.0]], None, &mut |_| true)?;
    /// assert_eq!(cells.volumes, [0.25; 4]);
    /// assert_eq!(cells.areas, [2.0; 4]);
    /// assert_eq!(cells.centroids[3], [0.75, 0.75]);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Cancelled`](crate::Error::Cancelled) if `monitor`, which is told the fraction done now and then, returns
    /// `false`; [`NotFinite`](crate::Error::NotFinite), [`OutOfRange`](crate::Error::OutOfRange) and
    /// [`InvalidValue`](crate::Error::InvalidValue) for the box; [`WrongCount`](crate::Error::WrongCount) if the mask has
    /// not an entry for each id; [`OutOfMemory`](crate::Error::OutOfMemory).
    pub fn voronoi_cells(
        &self,
        clip: [&G::Point; 2],
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<VoronoiCells<G::Point>> {
        let (mut volumes, mut areas, mut centroids) = (Vec::new(), Vec::new(), Vec::new());
        let n_ids = self.id_count();
        memory::lengthen(&mut volumes, n_ids, f64::NAN)?;
        memory::lengthen(&mut areas, n_ids, f64::NAN)?;
        memory::lengthen(&mut centroids, n_ids, nowhere::<G>())?;
        self.for_voronoi_cells(clip, mask, monitor, &mut |v, cell| {
            volumes[v.index()] = cell.volume;
            areas[v.index()] = cell.area;
            centroids[v.index()] = cell.centroid;
        })?;
        Ok(VoronoiCells { volumes, areas, centroids })
    }

    /// Tells the [`voronoi_cells`](Self::voronoi_cells) of all ids, or of those of which `mask` has an entry that is not
    /// 0, one after the other in ascending order, when all are computed.
    ///
    /// # Errors
    /// Those of [`voronoi_cells`](Self::voronoi_cells); then nothing has been told.
    pub fn for_voronoi_cells(
        &self,
        clip: [&G::Point; 2],
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
        tell: &mut dyn FnMut(VertexId, VoronoiCell<G::Point>),
    ) -> Result<()> {
        mask.map_or(Ok(()), |mask| self.check_vertex_mask(mask.len()))?;
        if self.mesh.kernel.is_constrained() {
            return self.without_segments()?.for_voronoi_cells(clip, mask, monitor, tell);
        }
        let clip = checked::<G>(clip)?;
        let is_wanted = |v: &VertexId| mask.is_none_or(|mask| mask[v.index()] != 0);
        let wanted = VertexId::range(0..self.id_count()).filter(is_wanted);
        if self.cell_count() == 0 {
            let targets = self.flat_targets(&clip, monitor)?;
            self.tell_cells(&clip, wanted, targets, tell);
            return Ok(());
        }
        let (cells, n_sites) = (self.cell_arrays()?, self.mesh.kernel.sites().len());
        let Some(mask) = mask else {
            let mut vertices = Vec::new();
            memory::reserve_exact(&mut vertices, self.vertex_count())?;
            vertices.extend(self.mesh.kernel.live_sites().map(|s| self.mesh.kernel.site(s).id));
            let centres = Centres::new(self, cells, Some(&clip), None)?;
            let targets = Targets::new(All, n_sites)?;
            let targets = self.targets_of(&clip, (&centres, All), &vertices, targets, monitor)?;
            self.tell_cells(&clip, wanted, targets, tell);
            return Ok(());
        };
        let vertices = self.shown_in(mask)?;
        let chosen = self.cells_around(&vertices)?;
        let centres = Centres::new(self, cells, Some(&clip), Some(&chosen))?;
        let (_, ranks) = centres.chosen.as_ref().expect("cells are chosen");
        let numbers = Ranks::of(n_sites, vertices.iter().map(|&v| self.mesh.site_of[v].index()))?;
        let targets = Targets::new(&numbers, vertices.len())?;
        let targets = self.targets_of(&clip, (&centres, ranks), &vertices, targets, monitor)?;
        self.tell_cells(&clip, wanted, targets, tell);
        Ok(())
    }

    /// Sums for vertices in one hyperplane.
    fn flat_targets(&self, clip: &Clip, monitor: &mut dyn FnMut(f64) -> bool) -> Result<Targets<All>> {
        let mut targets = Targets::new(All, self.mesh.kernel.sites().len())?;
        targets.list.iter_mut().for_each(|target| target.is_cut = true);
        self.flat_cells(clip, &mut Progress::new(monitor, 1), |v, part| {
            targets.of(self.mesh.site_of[v]).sums.join(part);
        })?;
        Ok(targets)
    }

    /// Sums for some vertices, which have targets, by the centres of all cells around these, which are numbered.
    fn targets_of<S: Numbering>(
        &self,
        clip: &Clip,
        (centres, numbers): (&Centres<G::Point>, impl Numbering),
        vertices: &[VertexId],
        mut targets: Targets<S>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Targets<S>> {
        let mut voronoi = Voronoi::new(self, self.cell_arrays()?, centres);
        let progress = &mut Progress::new(monitor, 2 * centres.list.len());
        voronoi.add_all(clip.unit, numbers, progress, &mut targets)?;
        voronoi.cut_all(clip, vertices, progress, &mut targets)?;
        Ok(targets)
    }

    /// Tells what is known of vertices.
    fn tell_cells(
        &self,
        clip: &Clip,
        wanted: impl Iterator<Item = VertexId>,
        mut targets: Targets<impl Numbering>,
        tell: &mut dyn FnMut(VertexId, VoronoiCell<G::Point>),
    ) {
        for v in wanted {
            let none = |x| VoronoiCell { volume: x, area: x, centroid: nowhere::<G>() };
            let cell = match self.mesh.standing(v) {
                Standing::Gone => none(f64::NAN),
                Standing::Hidden(_) => none(0.0),
                Standing::Shown(s) => cell_of::<G>(clip, self.mesh.kernel.place(s), targets.of(s)),
            };
            tell(v, cell);
        }
    }
}

/// No place.
pub(super) fn nowhere<G: Dimension>() -> G::Point {
    let mut nowhere = G::Point::default();
    (0..G::D).for_each(|axis| nowhere[axis] = f64::NAN);
    nowhere
}

/// What the sums of a vertex at this place say.
fn cell_of<G: Dimension>(clip: &Clip, place: &G::Point, target: &Target) -> VoronoiCell<G::Point> {
    let sums = &target.sums;
    let [of_volume, of_facets, of_moment] = target.factors::<G>();
    let volume = of_volume * sums.volume;
    let mut centroid = nowhere::<G>();
    if volume > 0.0 {
        let apex = clip.offset_within(&in_space::<G>(place));
        for axis in 0..G::D {
            let way = of_moment * sums.moment[axis] / volume / clip.unit;
            let at = clip.low()[axis] + (apex[axis] + way);
            centroid[axis] = at.clamp(clip.low()[axis], clip.high()[axis]);
        }
    }
    // What is left of negative parts by rounding may be negative.
    VoronoiCell {
        volume: clip.measure_in(G::D, volume).max(0.0),
        area: clip.measure_in(G::D - 1, of_facets * sums.facets + sums.wall).max(0.0),
        centroid,
    }
}
