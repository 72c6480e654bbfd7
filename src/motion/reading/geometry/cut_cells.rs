//! Areas and volumes of Voronoi cells that are cut by a box.
//!
//! # Idea
//!
//! Let *a* be the place of the vertex, or that in the box which is nearest to it. A cell in the box consists of the
//! pyramids from *a* to its facets and to what it has of the faces of the box. That, in its face, consists of those
//! from the foot of *a* on the face to sides of Voronoi facets and to what the cell has of the edges of the box; and
//! that of what is between the foot on the edge and corners of facets, or the end of the edge. With heights as factors,
//! each of these is one term; where *a* is on the other side, as it may be with weights, it is negative. So a cell is a
//! sum over its facets, their sides and corners on the box, and those corners of the box that are in it: nothing has to
//! be put together, the terms are exact but for the rounding of corners, and there are as few as there are corners.
//!
//! A corner of the box is in the cell of the vertex that is nearest to it, with weights of that of least power. Faces
//! are where cutting facets assumes them (`cut_facets.rs`): a little farther out, the later the more. So of vertices
//! equally near, it is the one that is farthest out along the last axis; then, along the one before.

use std::cmp::Ordering;

use crate::delaunay::{IndexSet, Moving};
use crate::error::Result;
use crate::ids::{CellId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::reading::geometry::clipping::{
    Clip, Face, Vector, cross, dot, heights, in_space, minus, times,
};
use crate::motion::reading::geometry::incidence::Neighbours;
use crate::motion::reading::geometry::sums::{LEAST_SQUARE, Sums};
use crate::motion::reading::geometry::voronoi::Voronoi;
use crate::motion::reading::progress::Progress;
use crate::motion::reading::query::cells_at;
use crate::predicates::{VertexInSpace, WeightedPoint, compare_power};

/// A corner of a box, and which of the faces at it are high, a bit for each axis.
#[derive(Clone, Copy)]
pub(super) struct BoxCorner {
    at: Vector,
    pub(super) highs: usize,
}

impl BoxCorner {
    pub(super) fn all<G: Moving>(clip: &Clip) -> impl Iterator<Item = BoxCorner> {
        let low = *clip.low();
        let high = *clip.high();
        (0..1 << G::D).map(move |highs| {
            let at = [0, 1, 2].map(|axis| if highs >> axis & 1 == 1 { high[axis] } else { low[axis] });
            BoxCorner { at, highs }
        })
    }

    /// The offset from the corner of least coordinates, in the box's unit.
    pub(super) fn offset(&self, clip: &Clip) -> Vector {
        [0, 1, 2].map(|axis| if self.highs >> axis & 1 == 1 { clip.extent(axis) * clip.unit } else { 0.0 })
    }

    /// In coordinates of the dimension.
    pub(super) fn point<G: Moving>(&self) -> G::Point {
        let mut point = G::Point::default();
        (0..G::D).for_each(|axis| point[axis] = self.at[axis]);
        point
    }

    /// Whether it is in the cell of the first of two vertices rather than of the other one.
    fn prefers<V: VertexInSpace>(&self, p: &V, q: &V) -> bool {
        let farther_out = |axis: usize| {
            let order = p.place()[axis].partial_cmp(&q.place()[axis]).expect("numbers");
            if self.highs >> axis & 1 == 1 { order } else { order.reverse() }
        };
        let [to_p, to_q] = [p, q].map(|v| WeightedPoint { place: *v.place(), weight: v.weight() });
        match compare_power(&self.at, &to_p, &to_q) {
            Ordering::Equal => {
                (0..3).rev().map(farther_out).find(|order| order.is_ne()) == Some(Ordering::Greater)
            }
            order => order == Ordering::Less,
        }
    }

    /// The vertex in whose cell it is, from one that is near, by those that have a facet with each.
    pub(super) fn owner<V: VertexInSpace>(
        &self,
        near: VertexId,
        ball: impl Fn(VertexId) -> V,
        mut list: impl FnMut(VertexId, &mut Vec<VertexId>) -> Result<()>,
    ) -> Result<VertexId> {
        let (mut owner, mut others) = (near, Vec::new());
        loop {
            list(owner, &mut others)?;
            let better = |&best: &VertexId, w: &VertexId| self.prefers(&ball(*w), &ball(best));
            let next = others.iter().fold(owner, |best, w| if better(&best, w) { *w } else { best });
            if next == owner {
                return Ok(owner);
            }
            owner = next;
        }
    }

    /// What is between it and a place in the box.
    pub(super) fn sums<G: Moving>(&self, clip: &Clip, apex: &Vector) -> Sums {
        let mut way = [0.0; 3];
        for (axis, way) in way.iter_mut().enumerate().take(G::D) {
            let face = Face { axis, is_high: self.highs >> axis & 1 == 1 };
            *way = clip.way_to(face, apex)[axis];
        }
        let area_but = |axis: usize| -> f64 {
            (0..G::D).filter(|&other| other != axis).map(|other| way[other].abs()).product()
        };
        let mut sums = Sums { wall: (0..G::D).map(area_but).sum(), ..Sums::default() };
        sums.add(way[0].abs() * area_but(0), 0.5, [&way]);
        sums
    }
}

impl<G: Moving> Voronoi<'_, G> {
    /// Tells what there is of the cells of some vertices, which do not fit in the box, with offsets from the vertex, or
    /// from the place in the box that is nearest to it.
    pub(super) fn cut_cells(
        &mut self,
        clip: &Clip,
        mut neighbours: Neighbours<'_, G>,
        vertices: impl Iterator<Item = VertexId>,
        progress: &mut Progress,
        mut tell: impl FnMut(VertexId, &Sums),
    ) -> Result<()> {
        let mut list = Vec::new();
        for v in vertices {
            let place = self.place(v);
            let apex = clip.offset_within(&place);
            let is_inside = clip.has(&place);
            neighbours.list(v, VertexId::new(0), &mut list, |w, cell| (w, cell))?;
            let mut sums = Sums::default();
            for &(w, first) in &list {
                self.ring.go_around(self.cells, [v, w], first)?;
                let is_whole = is_inside && self.is_whole();
                let is_added = is_whole && self.add_whole([v, w], clip.unit, &mut sums);
                if !is_added && !self.is_outside() {
                    self.cut([v, w], clip)?;
                    self.facet.add_pyramids(clip, &apex, &mut sums);
                    sums.facets += clip.facet_in_unit(G::D, self.facet.measure());
                }
                progress.advance(self.ring.cells.len())?;
            }
            tell(v, &sums);
        }
        Ok(())
    }

    /// Adds the pyramid between a vertex and the facet of the ring, which is in the box as a whole, unless the edge is
    /// too short for products; whether it has.
    fn add_whole(&self, [v, w]: [VertexId; 2], unit: f64, sums: &mut Sums) -> bool {
        let apex = self.place(v);
        let along = times(&minus(&self.place(w), &apex), unit);
        let square = dot(&along, &along);
        if square < LEAST_SQUARE {
            return false;
        }
        let from_apex =
            |cell: CellId| times(&minus(&in_space::<G>(&self.centres.of(cell).place), &apex), unit);
        let apart = (self.t.weight(v) - self.t.weight(w)) * (unit * unit);
        let [height, _] = heights::<G>(square, apart);
        let first = from_apex(self.ring.cells[0]);
        let mut before = from_apex(self.ring.cells[1]);
        if G::D == 2 {
            let step = minus(&before, &first);
            let weight = (step[0] * along[1] - step[1] * along[0]).abs();
            sums.facets += weight / square.sqrt();
            sums.add(0.25 * weight * height, 1.0 / 3.0, [&first, &before]);
            return true;
        }
        let (mut weight, mut moment) = (0.0, [0.0; 3]);
        for &cell in &self.ring.cells[2..] {
            let next = from_apex(cell);
            let part = dot(&along, &cross(&minus(&before, &first), &minus(&next, &first)));
            weight += part;
            for axis in 0..3 {
                moment[axis] += part * (first[axis] + before[axis] + next[axis]);
            }
            before = next;
        }
        // The ring may go either way around; a facet that is but rounding has no sign.
        let sign = if weight < 0.0 { -1.0 } else { 1.0 };
        sums.facets += 0.5 * weight.abs() / square.sqrt();
        sums.volume += weight.abs() / 12.0 * height;
        sums.moment.iter_mut().zip(moment).for_each(|(sum, moment)| *sum += sign * moment / 48.0 * height);
        true
    }

    /// Tells what is between the corners of the box and the vertices in whose cells they are, of those that are wanted.
    pub(super) fn corner_parts(
        &self,
        clip: &Clip,
        is_wanted: impl Fn(VertexId) -> bool,
        mut tell: impl FnMut(VertexId, &Sums),
    ) -> Result<()> {
        self.for_corners(clip, |corner, owner| {
            if is_wanted(owner) {
                tell(owner, &corner.sums::<G>(clip, &clip.offset_within(&self.place(owner))));
            }
            Ok(())
        })
    }

    /// Tells the corners of the box, and the vertices in whose cells they are.
    pub(super) fn for_corners(
        &self,
        clip: &Clip,
        mut tell: impl FnMut(BoxCorner, VertexId) -> Result<()>,
    ) -> Result<()> {
        let mut star = IndexSet::new();
        for corner in BoxCorner::all::<G>(clip) {
            let near = self.t.nearest_vertex(&corner.point::<G>())?.expect("there are vertices");
            let owner = corner.owner(
                near,
                |v| self.t.ball(v),
                |v, others| self.list_neighbours(v, &mut star, others),
            )?;
            tell(corner, owner)?;
        }
        Ok(())
    }

    /// Lists the vertices that share a cell with one, ascending.
    fn list_neighbours(
        &self,
        v: VertexId,
        star: &mut IndexSet<Slot>,
        others: &mut Vec<VertexId>,
    ) -> Result<()> {
        star.clear();
        others.clear();
        self.t.mesh.kernel.list_star(self.t.mesh.site_of[v], star, |_| {})?;
        for cell in cells_at(star, self.cells.index_of()) {
            let row = self.cells.corners()[cell];
            memory::collect(others, row.as_ref().iter().copied().filter(|&w| w != v))?;
        }
        others.sort_unstable();
        others.dedup();
        Ok(())
    }
}
