//! Voronoi facets in a box, with centroids and derivatives of the volumes on their sides by positions.
//!
//! # Idea
//!
//! The [pieces](super::dual) of a facet add up to its measure A and to the moment of its points as seen from the middle
//! of its edge. Which edge it is, the list of the edges of the vertex of lower id tells.
//!
//! Let x and y be the ends, L their distance and c the centroid of the facet. A point z of the facet is as far from x as
//! from y: |z − x|² = |z − y|². If y moves by dy, and z by dz, (y − x) · dz = (y − z) · dy; so the facet moves by
//! (y − z) · dy / L along its normal, and with it grows the cell of x: dV_x / dy = A (y − c) / L, as was found by many
//! (for instance Springel, 2010, doi 10.1111/j.1365-2966.2009.15715.x, uses the like for his fluxes). What the box has
//! of a cell does not move. So dV_y / dx = A (x − c) / L, and what a vertex loses to all its neighbours is what it gains:
//! dV_x / dx is minus the sum of dV_y / dx over its facets.
//!
//! # Accuracy
//!
//! With h as in [`dual`](super::dual), P the perimeter and d the diameter of a facet, A is off by h P, as its corners
//! are off by h; the centroid by h P d / A; a derivative, which is linear in the measure and the moment, by
//! h P (|y − c| + d) / L. Where A ≤ 2 h P the quotient of moment and measure could be anywhere; such facets are put
//! together from their corners, as those are that the box cuts, and the centroid is a mean of corners with weights that
//! are not negative: off by d + h at most.

use crate::delaunay::Dimension;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::reading::geometry::clipping::{Clip, Vector, minus, times};
use crate::motion::reading::geometry::dual::{Piece, Wanted, length};
use crate::motion::reading::geometry::incidence::Neighbours;
use crate::motion::reading::geometry::progress::Progress;
use crate::motion::reading::geometry::voronoi::Voronoi;
use crate::motion::reading::geometry::voronoi_cells::checked;
use crate::motion::triangulation::MovingTriangulation;

/// The Voronoi facets of edges in a box.
#[derive(Clone, Debug, PartialEq)]
pub struct VoronoiFacets<P> {
    /// The edges, as [`edges`](MovingTriangulation::edges) lists them.
    pub edges: Vec<[VertexId; 2]>,
    /// Lengths or areas of their facets.
    pub areas: Vec<f64>,
    /// Centroids of these; NaN where nothing of a facet is in the box.
    pub centroids: Vec<P>,
    /// The derivative of the area or volume of the cell of an edge's first vertex by the position of the second one,
    /// and of that of the second one by the position of the first.
    pub derivatives: Vec<[P; 2]>,
}

/// An edge, and sums over the pieces of its facet.
#[derive(Clone, Copy, Debug)]
struct Edge {
    lower: VertexId,
    /// A cell of which it is an edge.
    first: CellId,
    is_cut: bool,
    weight: f64,
    /// The sum of the lengths of its sides.
    perimeter: f64,
    /// From the middle of the edge.
    moment: Vector,
}

/// Edges by their lower vertex.
struct Edges {
    offsets: Vec<u32>,
    /// The upper vertex of each.
    upper: Vec<VertexId>,
    edges: Vec<Edge>,
}

impl Edges {
    fn of<G: Dimension>(t: &MovingTriangulation<G>) -> Result<Self> {
        let n_ids = t.id_count();
        let mut neighbours = Neighbours::new(t.cell_arrays()?, n_ids)?;
        let (mut offsets, mut upper, mut edges) = (Vec::new(), Vec::new(), Vec::new());
        memory::reserve_exact(&mut offsets, n_ids + 1)?;
        memory::reserve_exact(&mut upper, t.edge_count())?;
        memory::reserve_exact(&mut edges, t.edge_count())?;
        let mut list = Vec::new();
        offsets.push(0);
        for lower in VertexId::range(0..n_ids) {
            neighbours.prefetch(lower.index() + 2);
            neighbours.list(lower, lower, &mut list, |w, cell| (w, cell))?;
            for &(w, first) in &list {
                upper.push(w);
                edges.push(Edge {
                    lower,
                    first,
                    is_cut: false,
                    weight: 0.0,
                    perimeter: 0.0,
                    moment: [0.0; 3],
                });
            }
            offsets.push(upper.len() as u32);
        }
        Ok(Edges { offsets, upper, edges })
    }

    /// The edge between two vertices of a cell.
    #[inline(always)]
    fn between(&mut self, a: VertexId, b: VertexId) -> &mut Edge {
        let (lower, upper) = if a < b { (a, b) } else { (b, a) };
        let [from, to] = [0, 1].map(|k| self.offsets[lower.index() + k] as usize);
        let at = self.upper[from..to].iter().position(|&w| w == upper);
        &mut self.edges[from + at.expect("all edges are listed")]
    }
}

impl Edge {
    /// Whether the facet may be narrower than corners are off: then the quotient of its moment and its measure may be
    /// anywhere, and corners have to be put together.
    #[inline(always)]
    fn is_narrow<G: Dimension>(&self, clip: &Clip, [x, y]: &[Vector; 2]) -> bool {
        let along = times(&minus(y, x), clip.unit);
        G::D == 3 && self.weight <= 2.0 * NARROW * self.perimeter * length(&along)
    }

    #[inline(always)]
    fn add<G: Dimension>(&mut self, piece: &Piece) {
        self.weight += piece.weight;
        self.perimeter += piece.step;
        let weight = piece.weight / G::D as f64;
        for axis in 0..G::D {
            self.moment[axis] += weight * (piece.to_centres[axis] + piece.along[axis]);
        }
    }
}

/// What the area of a facet is to its perimeter, in sizes of the box, where it is narrow: twice what corners are off,
/// and room for what the unit is less than the size.
const NARROW: f64 = 4e-8;

/// A facet: measure, centroid, derivatives.
type Facet = (f64, Vector, [Vector; 2]);

impl<G: Dimension> Voronoi<'_, G> {
    /// The facet of an edge that is in the box as a whole, from its sums.
    fn whole(&self, clip: &Clip, edge: &Edge, [x, y]: [Vector; 2]) -> Facet {
        let along = times(&minus(&y, &x), clip.unit);
        let length = length(&along);
        let factor = if G::D == 2 { 1.0 } else { 0.5 };
        let measure = (factor * edge.weight / length).max(0.0);
        let unit = |measure: f64| clip.measure_in(G::D - 1, measure);
        let centroid = if edge.weight > 0.0 {
            [0, 1, 2].map(|axis| {
                let way = (edge.moment[axis] / edge.weight + 0.5 * along[axis]) / clip.unit;
                (x[axis] + way).clamp(clip.low()[axis], clip.high()[axis])
            })
        } else {
            [f64::NAN; 3]
        };
        let derivative = |sign: f64| {
            [0, 1, 2].map(|axis| {
                let from_middle = factor * (edge.moment[axis] / length) / length;
                unit(sign * 0.5 * measure * (along[axis] / length) - from_middle)
            })
        };
        (unit(measure), centroid, [derivative(1.0), derivative(-1.0)])
    }

    /// The facet of an edge that may be cut by the box.
    fn cut_one(&mut self, clip: &Clip, edge: [VertexId; 2], first: CellId) -> Result<Facet> {
        if !self.cut_around(edge, first, clip)? {
            return Ok((0.0, [f64::NAN; 3], [[0.0; 3]; 2]));
        }
        let [x, y] = edge.map(|v| self.place(v));
        let (measure, offset) = self.facet.measure_and_centroid();
        let centroid = [0, 1, 2].map(|axis| (clip.low()[axis] + offset[axis]).min(clip.high()[axis]));
        let length = length(&minus(&y, &x));
        let derivative = |of: &Vector| {
            let by = |axis: usize| measure * ((of[axis] - centroid[axis]) / length);
            if measure > 0.0 { [0, 1, 2].map(by) } else { [0.0; 3] }
        };
        Ok((measure, centroid, [derivative(&y), derivative(&x)]))
    }
}

impl<G: Dimension> MovingTriangulation<G> {
    /// The Voronoi facets of all edges within the box from `low` to `high`: measures, centroids, and derivatives of the
    /// areas or volumes on their sides. With a `mask`, NaN for edges that have no end of which the entry is not 0.
    ///
    /// The derivative of the volume of a cell by the position of its own vertex is minus the sum of those of its
    /// neighbours by that position.
    ///
    /// Rounded: with h as for [`voronoi_cells`](Self::voronoi_cells), P the perimeter of a facet (in the plane, 2), d
    /// its diameter, A its measure and L the length of its edge, a measure is off by at most h P, a centroid by
    /// h P d / A, or by d + h where A is less than 4 h P, a derivative by h P / L times the sum of d and the distance
    /// from the vertex to the centroid.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let facets = t.voronoi_derivatives([&[-1.0, -1.0], &[2.0, 2.0]], None, &mut |_| true)?;
    /// assert_eq!(facets.areas[0], 1.5); // between vertices 0 and 1: from y = -1 to 1/2
    /// assert_eq!(facets.centroids[0], [0.5, -0.25]);
    /// assert_eq!(facets.derivatives[0][0], [0.75, 0.375]); // by the position of vertex 1
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`voronoi_cells`](Self::voronoi_cells).
    pub fn voronoi_derivatives(
        &self,
        clip: [&G::Point; 2],
        mask: Option<&[u8]>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<VoronoiFacets<G::Point>> {
        mask.map_or(Ok(()), |mask| self.check_vertex_mask(mask.len()))?;
        if self.mesh.kernel.is_constrained() {
            return self.without_segments()?.voronoi_derivatives(clip, mask, monitor);
        }
        let (clip, wanted) = (checked::<G>(clip)?, Wanted::new(mask));
        let progress = &mut Progress::new(monitor, 2 * self.cell_count());
        let mut edges = std::cell::RefCell::new(Edges::of(self)?);
        let mut voronoi = Voronoi::new(self, Some(&clip))?;
        let id = |s| self.mesh.kernel.site(s).id;
        voronoi.for_pieces(
            clip.unit,
            wanted,
            progress,
            #[inline(always)]
            |[a, b], piece| {
                edges.borrow_mut().between(id(a), id(b)).add::<G>(piece);
            },
            |_, sites| {
                let mut edges = edges.borrow_mut();
                for (k, &a) in sites.iter().enumerate() {
                    for &b in &sites[..k] {
                        edges.between(id(a), id(b)).is_cut = true;
                    }
                }
            },
        )?;
        let Edges { upper, edges, .. } = edges.get_mut();
        let mut found = VoronoiFacets {
            edges: Vec::new(),
            areas: Vec::new(),
            centroids: Vec::new(),
            derivatives: Vec::new(),
        };
        memory::reserve_exact(&mut found.edges, edges.len())?;
        memory::reserve_exact(&mut found.areas, edges.len())?;
        memory::reserve_exact(&mut found.centroids, edges.len())?;
        memory::reserve_exact(&mut found.derivatives, edges.len())?;
        for (edge, &upper) in edges.iter().zip(&*upper) {
            let ends = [edge.lower, upper];
            let places = ends.map(|v| voronoi.place(v));
            let (area, centroid, derivatives) = if !ends.iter().any(|&v| wanted.has(v)) {
                (f64::NAN, [f64::NAN; 3], [[f64::NAN; 3]; 2])
            } else if edge.is_cut || edge.is_narrow::<G>(&clip, &places) {
                let facet = voronoi.cut_one(&clip, ends, edge.first)?;
                progress.advance(voronoi.ring.cells.len())?;
                facet
            } else {
                voronoi.whole(&clip, edge, places)
            };
            found.edges.push(ends);
            found.areas.push(area);
            found.centroids.push(of_space::<G>(&centroid));
            found.derivatives.push(derivatives.each_ref().map(of_space::<G>));
        }
        Ok(found)
    }
}

/// The coordinates that a dimension has.
fn of_space<G: Dimension>(p: &Vector) -> G::Point {
    let mut point = G::Point::default();
    (0..G::D).for_each(|axis| point[axis] = p[axis]);
    point
}
