//! Voronoi facets that are not in a box as a whole, cut by its faces.
//!
//! # Idea
//!
//! In its bisector, with weights the radical plane, a facet is a convex polygon; in the plane, a piece of a line. Its
//! sides are where it meets the cells of the vertices of the edge's link, in the order of these. One that is unbounded
//! has a side at infinity. Each face of the box in turn cuts off what is beyond it: corners are kept or not, and where
//! the one follows the other, there is a new corner on the face.
//!
//! A corner is known by the two sides that meet in it, so that whether it is beyond a face is a sign of a polynomial in
//! the coordinates of vertices and the box. These signs are exact ([`Meeting`]). A corner *on* a face is not beyond it:
//! the faces are in effect a little farther out, each by more than all before it, and no other corner is as close to
//! one. So nothing but what is convex is cut, a cut crosses two sides or none, and all facets agree about the box.
//!
//! Coordinates are computed at the end, of the corners that are left, each from the vertices and faces that define it,
//! not from corners that have been cut off. So none is far off because others are far away.
//!
//! # Corners at infinity
//!
//! One has a direction, of which the signs of the coordinates are known. A face along which that goes has all or
//! nothing of the side that leads to the corner. If none does, as in the middle of a plane that is a facet as a whole,
//! the corner is *open* unless the plane is parallel to the face: a part of what is far away in its direction is on
//! either side of the face. Then it goes if the corners before and after it do, so that what stays is convex; if one of
//! them does, either will do. These are not open to the same face.
//!
//! # Cost
//!
//! In proportion to the number of sides, as the box has but 2 D faces.

use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::reading::geometry::centres::Centres;
use crate::motion::reading::geometry::clipping::{Clip, Face, Vector};
use crate::motion::reading::geometry::rings::EdgeRing;
use crate::predicates::{Meeting, VertexInSpace, sign_of_cross};

/// What a corner other than a circumcentre may be off by, in sizes of the box: 2⁻⁴⁴.
const TOLERANCE: f64 = 1.0 / (1u64 << 44) as f64;

/// A side of a facet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum FacetSide<V> {
    /// Where the cell of another vertex begins.
    With(V),
    /// On a face of the box.
    On(Face),
    AtInfinity,
    /// There is none: in the plane a corner is on one side alone.
    None,
}

/// A corner of a facet, and the sides before and after it.
#[derive(Clone, Copy, Debug)]
pub(super) struct FacetCorner<V> {
    pub(super) sides: [FacetSide<V>; 2],
    /// The cell of which it is the circumcentre, if any.
    cell: CellId,
    /// The signs of the direction in which it is, if it is at infinity.
    direction: [i32; 3],
}

impl<V> FacetCorner<V> {
    fn of_cell(cell: CellId, sides: [FacetSide<V>; 2]) -> Self {
        FacetCorner { sides, cell, direction: [0; 3] }
    }

    fn far(direction: [i32; 3], sides: [FacetSide<V>; 2]) -> Self {
        FacetCorner { sides, cell: CellId::NONE, direction }
    }

    fn is_far(&self) -> bool {
        self.direction != [0; 3]
    }
}

/// A facet, or what is left of it.
#[derive(Debug, Default)]
pub(super) struct CutFacet<V> {
    pub(super) at: V,
    pub(super) to: V,
    /// The signs of the coordinates of the edge.
    pub(super) normal: [i32; 3],
    pub(super) is_plane: bool,
    pub(super) corners: Vec<FacetCorner<V>>,
    cut: Vec<FacetCorner<V>>,
    is_beyond: Vec<bool>,
    /// The corners that are left, from the box's corner of least coordinates.
    pub(super) places: Vec<Vector>,
}

fn negated(direction: [i32; 3]) -> [i32; 3] {
    direction.map(|sign| -sign)
}

impl<V: VertexInSpace> CutFacet<V> {
    /// Begins with the bisector of two vertices.
    fn begin(&mut self, [at, to]: [V; 2], is_plane: bool) {
        (self.at, self.to, self.is_plane) = (at, to, is_plane);
        let (at, to) = (at.place(), to.place());
        self.normal = [0, 1, 2].map(|axis| i32::from(to[axis] > at[axis]) - i32::from(to[axis] < at[axis]));
        self.corners.clear();
    }

    fn push(&mut self, corner: FacetCorner<V>) -> Result<()> {
        memory::push(&mut self.corners, corner)
    }

    /// The signs of the product of the normal with a unit vector.
    fn along(&self, axis: usize) -> [i32; 3] {
        let mut direction = [0; 3];
        direction[(axis + 1) % 3] = self.normal[(axis + 2) % 3];
        direction[(axis + 2) % 3] = -self.normal[(axis + 1) % 3];
        direction
    }

    /// The direction in which one goes along the cell of a vertex that is on the left, counter-clockwise around this.
    fn along_cell_of(&self, place: &Vector) -> [i32; 3] {
        [0, 1, 2].map(|axis| sign_of_cross([self.at.place(), self.to.place(), place], axis))
    }

    /// The direction of a facet in the plane, the first end of the edge on the left.
    fn along_line(&self) -> [i32; 3] {
        [-self.normal[1], self.normal[0], 0]
    }

    /// Makes it the facet of an edge between two vertices with a ring that is [oriented](EdgeRing::orient), whole.
    pub(super) fn fill(
        &mut self,
        edge: [V; 2],
        ring: &EdgeRing,
        ball: impl Fn(VertexId) -> V,
        is_plane: bool,
        has_left: bool,
    ) -> Result<()> {
        self.begin(edge, is_plane);
        let side = |k: usize| FacetSide::With(ball(ring.link[k % ring.link.len()]));
        if is_plane {
            return self.fill_line(ring, side, has_left);
        }
        memory::reserve(&mut self.corners, ring.cells.len() + 2)?;
        for (k, &cell) in ring.cells.iter().enumerate() {
            self.corners.push(FacetCorner::of_cell(cell, [side(k), side(k + 1)]));
        }
        if !ring.is_closed {
            let last = ring.link.len() - 1;
            let [first_way, last_way] = [0, last].map(|k| self.along_cell_of(ball(ring.link[k]).place()));
            self.corners.push(FacetCorner::far(last_way, [side(last), FacetSide::AtInfinity]));
            self.corners.push(FacetCorner::far(negated(first_way), [FacetSide::AtInfinity, side(0)]));
        }
        Ok(())
    }

    /// In the plane: from the right of the edge to its left.
    fn fill_line(
        &mut self,
        ring: &EdgeRing,
        side: impl Fn(usize) -> FacetSide<V>,
        has_left: bool,
    ) -> Result<()> {
        let of_cell = |k: usize| FacetCorner::of_cell(ring.cells[k], [side(k), FacetSide::None]);
        let far = |direction| FacetCorner::far(direction, [FacetSide::AtInfinity, FacetSide::None]);
        let left = if has_left { of_cell(0) } else { far(self.along_line()) };
        let right = match (has_left, ring.is_closed) {
            (true, true) => of_cell(1),
            (true, false) => far(negated(self.along_line())),
            (false, _) => of_cell(0),
        };
        self.push(right)?;
        self.push(left)
    }

    /// Makes it the facet between two vertices of a set that is in one hyperplane, whole. In space, `others` are at
    /// most two, the cells of which it meets.
    pub(super) fn fill_flat(&mut self, edge: [V; 2], others: &[V], is_plane: bool) -> Result<()> {
        self.begin(edge, is_plane);
        let infinity = FacetSide::AtInfinity;
        if is_plane {
            let way = self.along_line();
            self.push(FacetCorner::far(negated(way), [infinity, FacetSide::None]))?;
            return self.push(FacetCorner::far(way, [infinity, FacetSide::None]));
        }
        for other in others {
            let way = self.along_cell_of(other.place());
            self.push(FacetCorner::far(negated(way), [infinity, FacetSide::With(*other)]))?;
            self.push(FacetCorner::far(way, [FacetSide::With(*other), infinity]))?;
        }
        match others {
            [] => {
                let axis = (0..3).find(|&axis| self.normal[axis] != 0).expect("two places");
                let [first, second] = [1, 2].map(|k| self.along((axis + k) % 3));
                let ways = if self.normal[axis] > 0 { [first, second] } else { [second, first] };
                for way in [ways[0], ways[1], negated(ways[0]), negated(ways[1])] {
                    self.push(FacetCorner::far(way, [infinity; 2]))?;
                }
            }
            [other] => {
                // Any direction on the left of the way.
                let way = self.along_cell_of(other.place());
                let axis = (0..3).find(|&axis| way[axis] != 0).expect("places that are not on a line");
                let across = self.along(axis).map(|sign| sign * way[axis]);
                self.push(FacetCorner::far(across, [infinity; 2]))?;
            }
            _ => {}
        }
        Ok(())
    }

    /// Where sides meet, as seen from a place; the axes `also` are fixed as well.
    fn meet<T>(
        &self,
        sides: [FacetSide<V>; 2],
        clip: &Clip,
        also: [Option<f64>; 3],
        from: Vector,
        then: impl FnOnce(Meeting<'_, V>) -> T,
    ) -> T {
        let (mut others, mut n) = ([self.to; 3], 1);
        let mut meeting =
            Meeting { vertex: self.at, others: &[], from, is_fixed: [false, false, self.is_plane] };
        for (axis, place) in also.into_iter().enumerate() {
            if let Some(place) = place {
                (meeting.is_fixed[axis], meeting.from[axis]) = (true, place);
            }
        }
        for side in sides {
            match side {
                FacetSide::With(other) => {
                    others[n] = other;
                    n += 1;
                }
                FacetSide::On(face) => {
                    (meeting.is_fixed[face.axis], meeting.from[face.axis]) = (true, clip.bound(face));
                }
                FacetSide::AtInfinity | FacetSide::None => {}
            }
        }
        // One order, so that the answer is alike in all facets at the corner.
        others[..n].sort_unstable_by(|p, q| p.place().partial_cmp(q.place()).expect("numbers"));
        then(Meeting { others: &others[..n], ..meeting })
    }

    /// Whether a corner is beyond a face.
    fn is_beyond<P>(&self, corner: &FacetCorner<V>, face: Face, clip: &Clip, centres: &Centres<P>) -> bool {
        if corner.cell != CellId::NONE {
            return centres.of(corner.cell).sides & face.bit() != 0;
        }
        // One on the opposite face is as far from this one as it can be.
        if corner.sides.iter().any(|side| matches!(side, FacetSide::On(on) if on.axis == face.axis)) {
            return false;
        }
        let mut from = *self.at.place();
        from[face.axis] = clip.bound(face);
        let sign = if !corner.is_far() {
            self.meet(corner.sides, clip, [None; 3], from, |meeting| meeting.sign(face.axis))
        } else if corner.direction[face.axis] != 0 {
            corner.direction[face.axis]
        } else {
            self.sign_of_parallel(corner, face.axis, clip, from)
        };
        sign == face.outward()
    }

    /// The side of a face on which what leads to a corner at infinity is, parallel to that.
    fn sign_of_parallel(&self, corner: &FacetCorner<V>, axis: usize, clip: &Clip, from: Vector) -> i32 {
        let is_on_line = |side: &FacetSide<V>| matches!(side, FacetSide::With(_) | FacetSide::On(_));
        let others = [(axis + 1) % 3, (axis + 2) % 3];
        let mut also = [None; 3];
        if corner.sides.iter().any(is_on_line) {
            // Anywhere along the line.
            let along = others.into_iter().find(|&k| corner.direction[k] != 0).expect("a direction");
            also[along] = Some(self.at.place()[along]);
        } else if others.iter().all(|&k| self.normal[k] == 0) {
            others.iter().for_each(|&k| also[k] = Some(self.at.place()[k]));
        } else {
            // The sign is open.
            return 0;
        }
        self.meet(corner.sides, clip, also, from, |meeting| meeting.sign(axis))
    }

    /// Whether a corner is open to the faces of an axis.
    fn is_open(&self, corner: &FacetCorner<V>, axis: usize) -> bool {
        let is_parallel = (0..3).all(|k| k == axis || self.normal[k] == 0);
        let has_line = corner.sides.iter().any(|side| *side != FacetSide::AtInfinity);
        corner.is_far() && corner.direction[axis] == 0 && !has_line && !is_parallel
    }

    /// The faces that some corner may be beyond, by their bits: no corner that is new is beyond others.
    fn faces_to_cut<P>(&self, centres: &Centres<P>) -> u8 {
        let faces = |corner: &FacetCorner<V>| {
            if corner.is_far() { u8::MAX } else { centres.of(corner.cell).faces() }
        };
        self.corners.iter().fold(0, |all, corner| all | faces(corner))
    }

    /// Cuts off what is outside of a box.
    pub(super) fn cut<P>(&mut self, clip: &Clip, centres: &Centres<P>) -> Result<()> {
        let faces = self.faces_to_cut(centres);
        for k in 0..if self.is_plane { 4 } else { 6 } {
            let face = Face { axis: k / 2, is_high: k % 2 == 1 };
            if faces & face.bit() == 0 {
                continue;
            }
            self.is_beyond.clear();
            memory::reserve(&mut self.is_beyond, self.corners.len())?;
            for corner in &self.corners {
                self.is_beyond.push(self.is_beyond(corner, face, clip, centres));
            }
            let n = self.corners.len();
            for k in 0..n {
                if self.is_open(&self.corners[k], face.axis) {
                    self.is_beyond[k] = self.is_beyond[(k + n - 1) % n] && self.is_beyond[(k + 1) % n];
                }
            }
            if self.is_beyond.iter().all(|&is_beyond| is_beyond) {
                self.corners.clear();
                return Ok(());
            }
            if self.is_beyond.iter().any(|&is_beyond| is_beyond) {
                self.cut_by(face)?;
            }
        }
        Ok(())
    }

    /// Cuts off what is beyond a face.
    fn cut_by(&mut self, face: Face) -> Result<()> {
        if self.is_plane {
            let cut = self.is_beyond.iter().position(|&is_beyond| is_beyond).expect("one that is beyond");
            self.corners[cut] = FacetCorner::of_cell(CellId::NONE, [FacetSide::On(face), FacetSide::None]);
            return Ok(());
        }
        let n = self.corners.len();
        self.cut.clear();
        memory::reserve(&mut self.cut, 2 * n)?;
        let way = self.along(face.axis).map(|sign| sign * face.outward());
        for k in 0..n {
            let (corner, next) = (self.corners[k], (k + 1) % n);
            if !self.is_beyond[k] {
                self.cut.push(corner);
            }
            let side = corner.sides[1];
            // One on a side at infinity is at that end of the new side that it makes.
            let end = |way| if side == FacetSide::AtInfinity { way } else { [0; 3] };
            match (self.is_beyond[k], self.is_beyond[next]) {
                (false, true) => {
                    self.cut.push(FacetCorner::far(end(negated(way)), [side, FacetSide::On(face)]))
                }
                (true, false) => self.cut.push(FacetCorner::far(end(way), [FacetSide::On(face), side])),
                _ => {}
            }
        }
        std::mem::swap(&mut self.corners, &mut self.cut);
        Ok(())
    }

    /// Computes the places of the corners.
    pub(super) fn place<P: AsRef<[f64]>>(&mut self, clip: &Clip, centres: &Centres<P>) -> Result<()> {
        self.places.clear();
        memory::reserve(&mut self.places, self.corners.len())?;
        for corner in &self.corners {
            self.places.push(self.place_of(corner, clip, centres));
        }
        Ok(())
    }

    fn place_of<P: AsRef<[f64]>>(
        &self,
        corner: &FacetCorner<V>,
        clip: &Clip,
        centres: &Centres<P>,
    ) -> Vector {
        let within = |axis: usize, offset: f64| offset.clamp(0.0, clip.extent(axis));
        if corner.cell != CellId::NONE {
            let centre = centres.of(corner.cell).place.as_ref();
            if centre[0].is_finite() {
                let offset = |axis: usize| centre.get(axis).map_or(0.0, |x| x - clip.low()[axis]);
                return [0, 1, 2].map(|axis| within(axis, offset(axis)));
            }
        }
        debug_assert!(!corner.is_far());
        self.meet(corner.sides, clip, [None; 3], *clip.low(), |meeting| {
            [0, 1, 2].map(|axis| {
                if meeting.is_fixed[axis] {
                    meeting.from[axis] - clip.low()[axis]
                } else {
                    within(axis, meeting.offset(axis, TOLERANCE * clip.size))
                }
            })
        })
    }
}
