//! Volumes, boundaries and centroids of Voronoi cells in a box, from one pass over the facets of the Delaunay cells.
//!
//! # Idea
//!
//! The Voronoi facet of an edge ab is the polygon of the centres of the cells around it. Seen from the middle m of the
//! edge, it is the sum of signed triangles m, p, q of the centres of two cells that share a facet of the triangulation
//! with the edge on it: all that is outside of the polygon cancels. So no ring of cells has to be gone around: each
//! facet of the triangulation, with the centres p and q on its sides, adds a [`Piece`] to each of its edges. Let
//! e = b − a, g = q − p. In space the weight D = e · ((p − b) × g) is twice the area of the triangle times |e|, and
//! positive where the facet is seen from p with a before b counter-clockwise from the side of q. The tetrahedra of the
//! triangle with a and with b have volume D / 12 each, as their height is |e| / 2. In the plane a facet of the
//! triangulation is an edge itself, D = g × e is the length of pq times |e|, and the triangles with a and b have area
//! D / 4. Centroids are those of these simplices.
//!
//! # Accuracy
//!
//! Let p and q be off by at most h, as the [circumspheres](crate::motion::MovingTriangulation::circumspheres) are. The
//! sums are those of polygons with the corners moved by that, whatever the sizes of the pieces, since all pieces take
//! the same p and q: an area is off by h times the perimeter, a volume by h times the area of the surface, as every
//! point that is in but one of the two cells is within h of the surface. A product of e, p − b and g is rounded by a
//! few ε = 2⁻⁵³ times |e| |p − b| |g|; |p − b| is the circumradius, and pieces add up to ε R times the perimeter: less
//! than h has in place of ε. Rounding of the sums themselves is relative to that of the magnitudes of pieces, which are
//! bounded in that way, too. So, with S the surface and d the diameter of a cell of volume V, its centroid is off by at
//! most h S d / V.
//!
//! The pieces of all cells have D of one and the same number for both ends, and their sum over a facet of the
//! triangulation is that between p and q; so volumes add up to that of what cells fill, however far p and q are off.
//!
//! # Cost
//!
//! One pass over the cells for the centres and one over their facets, two a cell in space. What the box cuts is done by
//! `cut_cells.rs`.

use crate::complex::Corners;
use crate::delaunay::Dimension;
use crate::error::Result;
use crate::ids::{CellId, SiteId, VertexId};
use crate::machine::memory;
use crate::motion::reading::geometry::clipping::{
    Clip, Vector, cross, dot, in_space, length_by, minus, times,
};
use crate::motion::reading::geometry::incidence::Neighbours;
use crate::motion::reading::geometry::progress::Progress;
use crate::motion::reading::geometry::sums::Sums;
use crate::motion::reading::geometry::voronoi::Voronoi;
use crate::motion::reading::geometry::voronoi_cells::checked;
use crate::motion::state::cells::NO_CELL;
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

/// A triangle of a Voronoi facet (in the plane, the facet) as seen from the ends a and b of its edge.
pub(super) struct Piece {
    /// From a to b, in the unit of the box.
    pub(super) along: Vector,
    /// The square of its length.
    pub(super) square: f64,
    /// The sum of the ways from b to both centres.
    pub(super) to_centres: Vector,
    /// The measure of the facet times the length of the edge, and times two in space.
    pub(super) weight: f64,
    /// The distance of the centres.
    pub(super) step: f64,
}

/// Edges of which the square of the length, in the unit of a box, is less than that are left to `cut_cells.rs`.
pub(super) const LEAST_SQUARE: f64 = 1e-140;

/// By the corner opposite a facet of a cell, the other ones, counter-clockwise as seen from outside.
const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

impl Piece {
    #[inline(always)]
    pub(super) fn new<G: Dimension>(
        [a, b]: [&Vector; 2],
        p: &Vector,
        step: (&Vector, f64),
        unit: f64,
    ) -> Self {
        let (step, distance) = step;
        let along = times(&minus(b, a), unit);
        let from_b = times(&minus(p, b), unit);
        let weight = if G::D == 2 {
            step[0] * along[1] - step[1] * along[0]
        } else {
            dot(&along, &cross(&from_b, step))
        };
        let to_centres = [2.0 * from_b[0] + step[0], 2.0 * from_b[1] + step[1], 2.0 * from_b[2] + step[2]];
        Piece { along, square: dot(&along, &along), to_centres, weight, step: distance }
    }

    /// Adds it to the cells of a and b.
    #[inline(always)]
    pub(super) fn add_to_cells<G: Dimension>(&self, sums: &mut [Sums], [a, b]: [usize; 2]) {
        // Its share of the facet, as the weight has it, and centroids as seen from a and from b: of a triangle with the
        // end, or of a tetrahedron with the end and the middle.
        let (facet, volume, share, from_a, from_b) =
            if G::D == 2 { (1.0, 0.25, 1.0 / 3.0, 2.0, 0.0) } else { (0.5, 1.0 / 12.0, 0.25, 2.5, -0.5) };
        let facet = facet * self.weight / self.square.sqrt();
        let volume = volume * self.weight;
        for (end, factor) in [(a, from_a), (b, from_b)] {
            let end = &mut sums[end];
            end.volume += volume;
            end.facets += facet;
            for axis in 0..G::D {
                end.moment[axis] += volume * share * (self.to_centres[axis] + factor * self.along[axis]);
            }
        }
    }
}

/// Which cells and vertices a pass is for.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'m>(Option<&'m [u8]>);

impl<'m> Wanted<'m> {
    pub(super) fn new(mask: Option<&'m [u8]>) -> Self {
        Wanted(mask)
    }

    #[inline(always)]
    pub(super) fn has(self, v: VertexId) -> bool {
        self.0.is_none_or(|mask| mask[v.index()] != 0)
    }
}

impl<G: Dimension> Voronoi<'_, G> {
    /// Whether a centre is in the box.
    #[inline(always)]
    pub(super) fn fits(&self, cell: CellId) -> bool {
        self.sides[cell.index()] == 0 && self.centres[cell][0].is_finite()
    }

    /// Visits the pieces between cells that both fit, with the sites of their ends; and of every cell that does not, or
    /// has a facet on the hull or an edge that is too short for products, the facet's corners or all.
    #[inline(always)]
    pub(super) fn for_pieces(
        &self,
        unit: f64,
        wanted: Wanted,
        progress: &mut Progress,
        mut tell: impl FnMut([SiteId; 2], &Piece),
        mut tell_cut: impl FnMut(CellId, &[SiteId]),
    ) -> Result<()> {
        let kernel = &self.t.mesh.kernel;
        let (slots, index_of) = (self.cells.slots(), self.cells.index_of());
        for index in CellId::range(0..slots.len()) {
            progress.advance(1)?;
            let cell = kernel.complex().cell(slots[index]);
            let sites = cell.corners.as_ref();
            if wanted.0.is_some() && !sites.iter().any(|&s| wanted.has(kernel.site(s).id)) {
                continue;
            }
            let fits = self.fits(index);
            if !fits {
                tell_cut(index, sites);
            }
            let centre = in_space::<G>(&self.centres[index]);
            for (k, face) in FACES.iter().enumerate().take(G::Corners::N) {
                let next = index_of[cell.neighbour(k).cell()];
                if next == NO_CELL {
                    // The corner opposite the facet may have its cell inside.
                    let mut others = sites.iter().enumerate().filter(|&(i, _)| i != k).map(|(_, &s)| s);
                    let hull: [SiteId; 3] = std::array::from_fn(|_| others.next().unwrap_or(SiteId::NONE));
                    tell_cut(index, &hull[..G::D]);
                    continue;
                }
                if next < index || !fits || !self.fits(next) {
                    continue;
                }
                let step = times(&minus(&in_space::<G>(&self.centres[next]), &centre), unit);
                let distance = dot(&step, &step).sqrt();
                let face = if G::D == 2 { [(k + 1) % 3, (k + 2) % 3, 0] } else { *face };
                let n_edges = if G::D == 2 { 1 } else { 3 };
                let place = |i: usize| in_space::<G>(kernel.place(sites[face[i]]));
                let places = [place(0), place(1), place(2)];
                for i in 0..n_edges {
                    let j = (i + 1) % 3;
                    let ends = [sites[face[i]], sites[face[j]]];
                    let piece = Piece::new::<G>([&places[i], &places[j]], &centre, (&step, distance), unit);
                    if piece.square < LEAST_SQUARE {
                        tell_cut(index, &ends);
                    }
                    tell(ends, &piece);
                }
            }
        }
        Ok(())
    }
}

impl<G: Dimension> MovingTriangulation<G> {
    /// Areas or volumes, boundaries and centroids of the Voronoi cells of all ids within the box from `low` to `high`,
    /// or of those of which `mask` has an entry that is not 0.
    ///
    /// Rounded: let h be 10⁻⁸ times the greatest extent of the box and 10⁻¹⁵ times the greatest magnitude of its
    /// coordinates. A volume is off by at most h times the area S of the cell's surface, an area by h times the sum of
    /// the perimeters of its facets, and a centroid by h S d / V, where d is the diameter of the cell and V its volume.
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
        mask.map_or(Ok(()), |mask| self.check_vertex_mask(mask.len()))?;
        if self.mesh.kernel.is_constrained() {
            return self.without_segments()?.voronoi_cells(clip, mask, monitor);
        }
        let (clip, wanted) = (checked::<G>(clip)?, Wanted::new(mask));
        let n_sites = self.mesh.kernel.sites().len();
        let mut sums = Vec::new();
        memory::lengthen(&mut sums, n_sites, Sums::default())?;
        let progress = &mut Progress::new(monitor, 2 * self.cell_count());
        let site_of = |v: VertexId| self.mesh.site_of[v].index();
        if self.cell_count() == 0 {
            self.flat_cells(&clip, progress, |v, part| sums[site_of(v)].join(part))?;
        } else {
            let mut voronoi = Voronoi::new(self, Some(&clip))?;
            let mut is_cut = Vec::new();
            memory::lengthen(&mut is_cut, n_sites, false)?;
            voronoi.for_pieces(
                clip.unit,
                wanted,
                progress,
                #[inline(always)]
                |ends, piece| piece.add_to_cells::<G>(&mut sums, ends.map(SiteId::index)),
                |_, sites| sites.iter().for_each(|&s| is_cut[s.index()] = true),
            )?;
            let neighbours = Neighbours::new(voronoi.cells, self.id_count())?;
            let cut = self.mesh.kernel.live_sites().filter(|s| is_cut[s.index()]);
            let cut = cut.map(|s| self.mesh.kernel.site(s).id).filter(|&v| wanted.has(v));
            cut.clone().for_each(|v| sums[site_of(v)] = Sums::default());
            voronoi.cut_cells(
                &clip,
                neighbours,
                cut,
                |v| wanted.has(v),
                progress,
                |v, part| sums[site_of(v)].join(part),
            )?;
        }
        self.cells_of_sums(&clip, wanted, &sums)
    }

    /// What sums by site say, by id.
    fn cells_of_sums(&self, clip: &Clip, wanted: Wanted, sums: &[Sums]) -> Result<VoronoiCells<G::Point>> {
        let (mut volumes, mut areas, mut centroids) = (Vec::new(), Vec::new(), Vec::new());
        let n_ids = self.id_count();
        let mut nowhere = G::Point::default();
        (0..G::D).for_each(|axis| nowhere[axis] = f64::NAN);
        memory::lengthen(&mut volumes, n_ids, f64::NAN)?;
        memory::lengthen(&mut areas, n_ids, f64::NAN)?;
        memory::lengthen(&mut centroids, n_ids, nowhere)?;
        for (v, s) in self.mesh.sites_of_ids().filter(|&(v, s)| s.is_some() && wanted.has(v)) {
            let site = s.map(|s| self.mesh.kernel.site(s)).filter(|site| site.id == v);
            let (sums, at) =
                (s.filter(|_| site.is_some()).map_or(Sums::default(), |s| sums[s.index()]), site);
            // What is left of negative parts by rounding may be negative.
            volumes[v.index()] = clip.measure_in(G::D, sums.volume).max(0.0);
            areas[v.index()] = clip.measure_in(G::D - 1, sums.facets + sums.wall).max(0.0);
            if let (Some(site), true) = (at, sums.volume > 0.0) {
                let apex = clip.offset_within(&in_space::<G>(&site.point));
                for axis in 0..G::D {
                    let way = sums.moment[axis] / sums.volume / clip.unit;
                    let place = clip.low()[axis] + (apex[axis] + way);
                    centroids[v.index()][axis] = place.clamp(clip.low()[axis], clip.high()[axis]);
                }
            }
        }
        Ok(VoronoiCells { volumes, areas, centroids })
    }
}

/// The length of an edge of this direction.
pub(super) fn length(along: &Vector) -> f64 {
    length_by(dot(along, along), along)
}
