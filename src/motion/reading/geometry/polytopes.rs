//! What a box has of a Voronoi cell as a polytope, which half-spaces cut.
//!
//! # Idea
//!
//! A face is a list of directed edges, counter-clockwise as seen from outside; in the plane the cell itself is the only
//! face. As the facets of a cell in a box are cut exactly (`cut_facets.rs`), and a corner has the same coordinates to the
//! last bit in all faces that it is a corner of, the edges of each face are closed, and each edge of the cell is there
//! once in either direction. A half-space keeps that so, whatever the rounded distances of corners from its plane are:
//! an edge between a corner inside and one beyond gets a new end, computed from inside in both directions; a face gets an
//! edge from each place where it is left to one where it is entered, of which there are as many; and the reverses of
//! these edges, which are closed, too, make the face on the plane. There is no case in which that fails: of planes
//! through corners, along faces, nearly parallel to edges or to each other, a corner near a plane is taken as inside or
//! as beyond, and as it is near, both are right but for rounding.
//!
//! # Accuracy
//!
//! A new corner is within some last bits of the box of its edge and of the plane. So what is left is between what planes
//! would leave that are farther out, or farther in, by that: a volume is off by it times the area of the surface. To
//! corners that are off by h the first-order errors of uncut cells apply (`dual.rs`).
//!
//! Volumes are sums of tetrahedra between a corner of the cell, the mean of a face's corners, and an edge of it. The
//! means are the same from both sides of a facet, so that what a cell has more if corners are off, the other one has
//! less.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::machine::memory;
use crate::motion::reading::geometry::clipping::{Ball, Clip, Face, Vector, cross, dot, minus, times};
use crate::motion::reading::geometry::cut_cells::BoxCorner;
use crate::motion::reading::geometry::cut_facets::CutFacet;
use crate::motion::reading::geometry::facet_measures::BoundaryPiece;
use crate::motion::reading::geometry::half_spaces::{BoxBounds, HalfSpace, HalfSpaces};
use crate::motion::reading::geometry::sums::Sums;

/// A directed edge, with offsets from the box's corner of least coordinates, in its unit.
type DirectedEdge = [Vector; 2];

/// A face: where its edges end among all, and its outward normal.
#[derive(Clone, Copy, Debug)]
struct PolytopeFace {
    end: usize,
    normal: Vector,
}

/// An edge of the box: the axis that it is along, and which of the faces at it are high, a bit for each axis.
type BoxEdge = (usize, usize);

/// A polytope that is built and cut.
#[derive(Debug, Default)]
pub(super) struct Polytope {
    edges: Vec<DirectedEdge>,
    sides: Vec<PolytopeFace>,
    /// Edges on faces of the box, by the bits of these.
    walls: Vec<(u8, DirectedEdge)>,
    /// Where the cell has an end of what it has of an edge of the box, and whether that is the upper one.
    ends: Vec<(BoxEdge, bool, Vector)>,
    cut: PlaneCut,
    /// What is left by a half-space, before it takes the place of the rest.
    left: (Vec<DirectedEdge>, Vec<PolytopeFace>),
}

/// What a half-space makes of faces.
#[derive(Debug, Default)]
struct PlaneCut {
    /// Where a face is left, and where it is entered.
    exits: Vec<Vector>,
    entries: Vec<Vector>,
    /// The edges of the face on the plane.
    cap: Vec<DirectedEdge>,
}

/// Adds an edge, unless it has no length.
fn push(edges: &mut Vec<DirectedEdge>, edge: DirectedEdge) -> Result<()> {
    if edge[0] == edge[1] { Ok(()) } else { memory::push(edges, edge) }
}

/// Where a plane crosses the way from a place inside to one beyond, by their distances.
fn crossing([inside, beyond]: [&Vector; 2], [from, to]: [f64; 2]) -> Vector {
    let share = from / (from - to);
    [0, 1, 2].map(|axis| inside[axis] + share * (beyond[axis] - inside[axis]))
}

impl PlaneCut {
    /// Adds what a half-space leaves of the edges of a face to a list.
    fn face(
        &mut self,
        space: &HalfSpace,
        edges: &[DirectedEdge],
        left: &mut Vec<DirectedEdge>,
    ) -> Result<()> {
        self.exits.clear();
        self.entries.clear();
        for [p, q] in edges {
            let [from, to] = [space.beyond(p), space.beyond(q)];
            match (from <= 0.0, to <= 0.0) {
                (true, true) => push(left, [*p, *q])?,
                (true, false) => {
                    let exit = crossing([p, q], [from, to]);
                    push(left, [*p, exit])?;
                    memory::push(&mut self.exits, exit)?;
                }
                (false, true) => {
                    let entry = crossing([q, p], [to, from]);
                    push(left, [entry, *q])?;
                    memory::push(&mut self.entries, entry)?;
                }
                (false, false) => {}
            }
        }
        debug_assert_eq!(self.exits.len(), self.entries.len(), "edges are closed");
        for (&exit, &entry) in self.exits.iter().zip(&self.entries) {
            push(left, [exit, entry])?;
            push(&mut self.cap, [entry, exit])?;
        }
        Ok(())
    }
}

impl Polytope {
    /// Begins with no faces.
    pub(super) fn clear(&mut self) {
        self.edges.clear();
        self.sides.clear();
        self.walls.clear();
        self.ends.clear();
    }

    /// Adds a facet in the box, and what it borders of faces of the box.
    pub(super) fn add_facet<G: Moving>(&mut self, clip: &Clip, facet: &CutFacet<Ball<G>>) -> Result<()> {
        facet.for_pieces(clip.unit, |piece| match piece {
            BoundaryPiece::Edge(edge) => push(&mut self.edges, edge),
            BoundaryPiece::On(face, [p, q]) => memory::push(&mut self.walls, (face.bit(), [q, p])),
            BoundaryPiece::End { highs, along, is_upper, place } => {
                memory::push(&mut self.ends, ((along, highs), is_upper, place))
            }
        })?;
        if G::D == 3 {
            self.end_face(facet.direction())?;
        }
        Ok(())
    }

    /// All edges since the last face are one, if there are any.
    fn end_face(&mut self, normal: Vector) -> Result<()> {
        let end = self.edges.len();
        if self.sides.last().map_or(0, |side| side.end) == end {
            return Ok(());
        }
        memory::push(&mut self.sides, PolytopeFace { end, normal })
    }

    /// Adds a corner of the box that is in the cell.
    pub(super) fn add_corner<G: Moving>(&mut self, clip: &Clip, corner: &BoxCorner) -> Result<()> {
        let place = corner.offset(clip);
        for along in 0..G::D {
            let (highs, is_upper) = (corner.highs & !(1 << along), corner.highs >> along & 1 == 1);
            memory::push(&mut self.ends, ((along, highs), is_upper, place))?;
        }
        Ok(())
    }

    /// Adds the faces on the box, when all facets and corners have been added.
    pub(super) fn close<G: Moving>(&mut self) -> Result<()> {
        for k in 0..self.ends.len() {
            let (edge, is_upper, upper) = self.ends[k];
            // The lower end that comes as late among those of the edge.
            let of_edge = |at: &usize, is: bool| self.ends[*at].0 == edge && self.ends[*at].1 == is;
            let n_before = (0..k).filter(|at| of_edge(at, true)).count();
            let lower = (0..self.ends.len()).filter(|at| of_edge(at, false)).nth(n_before);
            if let (true, Some(lower)) = (is_upper, lower) {
                self.add_box_edge::<G>(edge, [self.ends[lower].2, upper])?;
            }
        }
        if G::D == 2 {
            for k in 0..self.walls.len() {
                push(&mut self.edges, self.walls[k].1)?;
            }
            return self.end_face([0.0, 0.0, 1.0]);
        }
        for face in Face::all::<G>() {
            for k in 0..self.walls.len() {
                let (bit, edge) = self.walls[k];
                if bit == face.bit() {
                    push(&mut self.edges, edge)?;
                }
            }
            let mut normal = [0.0; 3];
            normal[face.axis] = f64::from(face.outward());
            self.end_face(normal)?;
        }
        Ok(())
    }

    /// Adds what the cell has of an edge of the box to the faces at it.
    fn add_box_edge<G: Moving>(
        &mut self,
        (along, highs): BoxEdge,
        [lower, upper]: DirectedEdge,
    ) -> Result<()> {
        let face = |axis: usize| Face { axis, is_high: highs >> axis & 1 == 1 };
        let ways = [[lower, upper], [upper, lower]];
        if G::D == 2 {
            let face = face(1 - along);
            let is_up = face.is_high == (along == 1);
            return memory::push(&mut self.walls, (face.bit(), ways[usize::from(!is_up)]));
        }
        let [one, other] = [face((along + 1) % 3), face((along + 2) % 3)];
        let is_up = one.is_high == other.is_high;
        memory::push(&mut self.walls, (one.bit(), ways[usize::from(!is_up)]))?;
        memory::push(&mut self.walls, (other.bit(), ways[usize::from(is_up)]))
    }

    /// Cuts off what is beyond half-spaces.
    pub(super) fn cut<G: Moving>(&mut self, spaces: &HalfSpaces) -> Result<()> {
        let mut bounds = self.bounds();
        for space in &spaces.list {
            // Its edges are between its corners.
            if space.range(&bounds)[1] > 0.0 && self.edges.iter().any(|[p, _]| space.beyond(p) > 0.0) {
                self.cut_by::<G>(space)?;
                bounds = self.bounds();
            }
        }
        Ok(())
    }

    /// What half-spaces leave of a facet in the box: its length or area, and its centroid as an offset from the box's
    /// corner of least coordinates.
    pub(super) fn facet_within<G: Moving>(
        &mut self,
        clip: &Clip,
        spaces: &HalfSpaces,
        facet: &CutFacet<Ball<G>>,
    ) -> Result<(f64, Vector)> {
        self.clear();
        facet.for_pieces(clip.unit, |piece| match piece {
            BoundaryPiece::Edge(edge) => push(&mut self.edges, edge),
            BoundaryPiece::On(..) | BoundaryPiece::End { .. } => Ok(()),
        })?;
        let mut bounds = self.bounds();
        for space in &spaces.list {
            if space.range(&bounds)[1] <= 0.0 {
                continue;
            }
            let left = &mut self.left.0;
            left.clear();
            if G::D == 2 {
                cut_segments(space, &self.edges, left)?;
            } else {
                self.cut.cap.clear();
                self.cut.face(space, &self.edges, left)?;
            }
            std::mem::swap(&mut self.edges, left);
            bounds = self.bounds();
        }
        let (measure, centroid) = measure_and_centroid::<G>(&self.edges, &facet.direction());
        Ok((clip.measure_in(G::D - 1, measure), times(&centroid, 1.0 / clip.unit)))
    }

    fn bounds(&self) -> BoxBounds {
        let mut bounds = BoxBounds::NONE;
        self.edges.iter().flatten().for_each(|p| bounds.include(p));
        bounds
    }

    fn cut_by<G: Moving>(&mut self, space: &HalfSpace) -> Result<()> {
        let (edges, sides) = (&mut self.left.0, &mut self.left.1);
        edges.clear();
        sides.clear();
        self.cut.cap.clear();
        let mut start = 0;
        for side in &self.sides {
            let before = edges.len();
            self.cut.face(space, &self.edges[start..side.end], edges)?;
            if edges.len() > before {
                memory::push(sides, PolytopeFace { end: edges.len(), ..*side })?;
            }
            start = side.end;
        }
        std::mem::swap(&mut self.edges, &mut self.left.0);
        std::mem::swap(&mut self.sides, &mut self.left.1);
        if G::D == 3 {
            memory::append(&mut self.edges, &self.cut.cap)?;
            self.end_face(space.normal)?;
        }
        Ok(())
    }

    /// Volume, boundary, and the moment of its points as seen from an offset.
    pub(super) fn sums<G: Moving>(&self, apex: &Vector) -> Sums {
        let mut sums = Sums::default();
        let Some([first, _]) = self.edges.first() else { return sums };
        let mut start = 0;
        for side in &self.sides {
            let edges = &self.edges[start..side.end];
            if G::D == 2 {
                add_polygon(edges, first, &mut sums)
            } else {
                add_face(edges, &side.normal, first, &mut sums)
            }
            start = side.end;
        }
        if sums.volume > 0.0 {
            let way = minus(first, apex);
            (0..3).for_each(|axis| sums.moment[axis] += sums.volume * way[axis]);
        } else {
            (sums.volume, sums.moment) = (0.0, [0.0; 3]);
        }
        sums
    }
}

/// Adds what a half-space leaves of segments to a list.
fn cut_segments(space: &HalfSpace, segments: &[DirectedEdge], left: &mut Vec<DirectedEdge>) -> Result<()> {
    for [p, q] in segments {
        let [from, to] = [space.beyond(p), space.beyond(q)];
        match (from <= 0.0, to <= 0.0) {
            (true, true) => push(left, [*p, *q])?,
            (true, false) => push(left, [*p, crossing([p, q], [from, to])])?,
            (false, true) => push(left, [crossing([q, p], [to, from]), *q])?,
            (false, false) => {}
        }
    }
    Ok(())
}

/// Length or area of a facet with a normal, and its centroid; NaN if there is none.
fn measure_and_centroid<G: Moving>(edges: &[DirectedEdge], normal: &Vector) -> (f64, Vector) {
    let Some([first, end]) = edges.first() else { return (0.0, [f64::NAN; 3]) };
    if G::D == 2 {
        let way = minus(end, first);
        return (dot(&way, &way).sqrt(), [0, 1, 2].map(|axis| 0.5 * (first[axis] + end[axis])));
    }
    let (mut doubled, mut moment) = (0.0, [0.0; 3]);
    for [p, q] in edges {
        let [p, q] = [minus(p, first), minus(q, first)];
        // The polygon is convex, so that what is below zero is rounding.
        let weight = dot(normal, &cross(&p, &q)).max(0.0);
        doubled += weight;
        (0..3).for_each(|axis| moment[axis] += weight * (p[axis] + q[axis]));
    }
    let offset = if doubled > 0.0 { moment.map(|x| x / (3.0 * doubled)) } else { [0.0; 3] };
    (0.5 * doubled, [0, 1, 2].map(|axis| first[axis] + offset[axis]))
}

/// The mean of the places where edges begin.
fn mean(edges: &[DirectedEdge]) -> Vector {
    let sum = edges.iter().fold([0.0; 3], |sum, [p, _]| [0, 1, 2].map(|axis| sum[axis] + p[axis]));
    sum.map(|x| x / edges.len() as f64)
}

/// Adds a cell in the plane, as seen from a place.
fn add_polygon(edges: &[DirectedEdge], from: &Vector, sums: &mut Sums) {
    for [p, q] in edges {
        let step = minus(q, p);
        sums.facets += dot(&step, &step).sqrt();
        let [p, q] = [minus(p, from), minus(q, from)];
        sums.add(0.5 * cross(&p, &q)[2], 1.0 / 3.0, [&p, &q]);
    }
}

/// Adds a face, and the pyramid between it and a place.
fn add_face(edges: &[DirectedEdge], normal: &Vector, from: &Vector, sums: &mut Sums) {
    let middle = mean(edges);
    let height = minus(&middle, from);
    let mut doubled = 0.0;
    for [p, q] in edges {
        let area = cross(&minus(p, &middle), &minus(q, &middle));
        doubled += dot(normal, &area);
        sums.add(dot(&height, &area) / 6.0, 0.25, [&height, &minus(p, from), &minus(q, from)]);
    }
    sums.facets += (0.5 * doubled).max(0.0);
}
