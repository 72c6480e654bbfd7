//! Volumes, boundaries and centroids of Voronoi cells, with weights of power cells, in a box, from one pass over the
//! facets of the Delaunay cells.
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
//! With weights the facet is on the radical plane, where a and b have one power: at distances t_a |e| and t_b |e| from
//! them, with 2 t_a = 1 + (w_a − w_b) / |e|² and t_a + t_b = 1, either of which may be negative, if a vertex is not in
//! its own cell. D is what it was, as any point of the line ab may stand for b in it. The tetrahedra, which may be
//! negative, are 2 t_a and 2 t_b times as large, and the foot a + t_a e is where m was. Of equal weights these factors
//! are 1, and sums the same to the last bit.
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
//! With weights h is that of power centres ([`Measures::centre`](crate::predicates::Measures::centre)), and a shift of
//! E does as before, on whichever sides the feet are: a volume is off by 2/3 h T, an area by h/2 times the sum of r sin
//! θ. The vertex may be outside of its cell, and far away beside the size of that, so that the surface is no bound, nor
//! is the length of the boundary by a support function. With the greatest distance r of a corner from the vertex, if it
//! is more than d, the centroid is off by at most the error of the volume times r / V. A product of D and t_a is
//! rounded by a few ε times |p − a| |p − b| |g|, as t_a |e| is at most |p − a|, and t_a |e| itself by a few ε times
//! itself and |e|.
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
use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{CellId, SiteId, VertexId};
use crate::machine::prefetch::AHEAD;
use crate::machine::{memory, threads};
use crate::motion::reading::geometry::cells_within::Region;
use crate::motion::reading::geometry::centres::{Numbering, SHARED_AT_LEAST, ask_for};
use crate::motion::reading::geometry::clipping::{Vector, cross, dot, heights, in_space, minus, times};
use crate::motion::reading::geometry::incidence::Neighbours;
use crate::motion::reading::geometry::sums::{LEAST_SQUARE, Sums};
use crate::motion::reading::geometry::voronoi::Voronoi;
use crate::motion::reading::progress::Progress;
use crate::motion::state::cells::NO_CELL;
use crate::predicates::PointArray;

/// What a vertex has so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Target {
    /// From pieces: times 12, 2 and 48, in the plane times 4, 1 and 12.
    pub(super) sums: Sums,
    /// Whether pieces do not tell all.
    pub(super) is_cut: bool,
}

impl Target {
    /// The sums of an unbounded Voronoi cell.
    pub(super) const ENDLESS: Self = Target {
        sums: Sums { volume: f64::INFINITY, facets: f64::INFINITY, wall: 0.0, moment: [0.0; 3] },
        is_cut: true,
    };

    /// By what to multiply sums of volumes, facets and moments.
    pub(super) fn factors<G: Moving>(&self) -> [f64; 3] {
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
struct DualFacet<'f> {
    unit: f64,
    p: &'f Vector,
    step: Vector,
}

impl DualFacet<'_> {
    /// What the weight of an end is more than that of another one.
    #[inline(always)]
    fn apart(&self, own: f64, other: f64) -> f64 {
        (own - other) * (self.unit * self.unit)
    }

    /// Adds pieces to the vertices at its ends, in the plane, where it is an edge.
    #[inline(always)]
    fn add_in_plane<G: Moving>(
        &self,
        [a, b]: [&Vector; 2],
        [of_a, of_b]: [f64; 2],
        targets: [usize; 2],
        part: &mut [Target],
    ) {
        let (step, to) = (&self.step, |x: &Vector| times(&minus(self.p, x), self.unit));
        let along = times(&minus(b, a), self.unit);
        let weight = step[0] * along[1] - step[1] * along[0];
        let square = dot(&along, &along);
        let facet = weight / square.sqrt();
        let heights = heights::<G>(square, self.apart(of_a, of_b));
        for ((target, place), height) in targets.into_iter().zip([a, b]).zip(heights) {
            let Some(target) = part.get_mut(target) else { continue };
            let (from, volume) = (to(place), weight * height);
            target.is_cut |= square < LEAST_SQUARE;
            target.sums.volume += volume;
            target.sums.facets += facet;
            target.sums.moment[0] += volume * (2.0 * from[0] + step[0]);
            target.sums.moment[1] += volume * (2.0 * from[1] + step[1]);
        }
    }

    /// Adds pieces to the vertices at its corners, in space.
    #[inline(always)]
    fn add_in_space<G: Moving>(
        &self,
        [a, b, c]: [&Vector; 3],
        [of_a, of_b, of_c]: [f64; 3],
        targets: [usize; 3],
        part: &mut [Target],
    ) {
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
        let heights = [
            heights::<G>(squares[0], self.apart(of_a, of_b)),
            heights::<G>(squares[1], self.apart(of_b, of_c)),
            heights::<G>(squares[2], self.apart(of_c, of_a)),
        ];
        for k in 0..3 {
            let before = (k + 2) % 3;
            let Some(target) = part.get_mut(targets[k]) else { continue };
            let sums = &mut target.sums;
            let [forth, back] = [heights[k][0], heights[before][1]];
            let [one, other] = [weights[k] * forth, weights[before] * back];
            let [to_one, to_other] = [one * forth, other * back];
            let volume = one + other;
            sums.volume += volume;
            sums.facets += facets[k] + facets[before];
            for axis in 0..3 {
                let feet = to_one * edges[k][axis] - to_other * edges[before][axis];
                sums.moment[axis] += volume * (2.0 * to[k][axis] + step[axis]) + 0.5 * feet;
            }
            target.is_cut |= (squares[k] < LEAST_SQUARE) | (squares[before] < LEAST_SQUARE);
        }
    }
}

impl<G: Moving> Voronoi<'_, G> {
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
                let facet = DualFacet { unit, p: &p, step };
                let at = [&places[face[0]], &places[face[1]], &places[face[2]]];
                let weight = |k: usize| kernel.place(corners[face[k].min(G::D)]).weight();
                let weights = [weight(0), weight(1), weight(2)];
                if G::D == 2 {
                    let [of_a, of_b, _] = weights;
                    facet.add_in_plane::<G>([at[0], at[1]], [of_a, of_b], [ends[0], ends[1]], part);
                } else {
                    facet.add_in_space::<G>(at, weights, ends, part);
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
    pub(super) fn cut_all(
        &mut self,
        region: &Region,
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
        let join = |v, part: &Sums| targets.of(site_of[v]).sums.join(part);
        if !region.half_spaces.is_empty() {
            return self.cells_within(region, neighbours, cut, progress, join);
        }
        self.cut_cells(&region.clip, neighbours, cut, progress, join)?;
        self.corner_parts(
            &region.clip,
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
    pub(super) list: Vec<Target>,
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
