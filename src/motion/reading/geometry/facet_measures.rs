//! What a Voronoi facet in a box measures, and what it is of a cell.

use crate::error::Result;
use crate::motion::reading::geometry::clipping::{
    Clip, Face, Vector, cross, dot, length_by, minus, normalised, times,
};
use crate::motion::reading::geometry::cut_facets::{CutFacet, FacetSide};
use crate::motion::reading::geometry::sums::Sums;
use crate::predicates::VertexInSpace;

/// What a facet adds to the boundary of the cell of its edge's first end, in the unit of the box.
pub(super) enum BoundaryPiece {
    /// An edge of the facet; in the plane, the facet.
    Edge([Vector; 2]),
    /// An edge of the facet in space, which is on a face of the box.
    On(Face, [Vector; 2]),
    /// The end of what the cell has of an edge of the box, where these faces meet; in the plane there is one face.
    End {
        /// The bits of the axes along which faces are high.
        highs: usize,
        /// The axis of the edge.
        along: usize,
        /// Whether the cell is below, along the axis.
        is_upper: bool,
        /// Where it is.
        place: Vector,
    },
}

impl<V: VertexInSpace> CutFacet<V> {
    /// The way from its first end to the other one, of length 1.
    pub(super) fn direction(&self) -> Vector {
        normalised(&minus(self.to.place(), self.at.place()))
    }

    /// Tells what it adds to the boundary of a cell.
    pub(super) fn for_pieces(
        &self,
        unit: f64,
        mut tell: impl FnMut(BoundaryPiece) -> Result<()>,
    ) -> Result<()> {
        let n = self.places.len();
        let place = |k: usize| times(&self.places[k % n], unit);
        let mut end = |faces: &[Face], along: usize, place: Vector| {
            let highs = faces.iter().map(|face| usize::from(face.is_high) << face.axis).sum();
            tell(BoundaryPiece::End { highs, along, is_upper: self.normal[along] > 0, place })
        };
        for (k, corner) in self.corners.iter().enumerate() {
            match corner.sides {
                [FacetSide::On(face), FacetSide::On(next)] => {
                    end(&[face, next], 3 - face.axis - next.axis, place(k))?
                }
                [FacetSide::On(face), FacetSide::None] => end(&[face], 1 - face.axis, place(k))?,
                _ => {}
            }
        }
        if self.is_plane {
            return if n == 2 { tell(BoundaryPiece::Edge([place(0), place(1)])) } else { Ok(()) };
        }
        for (k, corner) in self.corners.iter().enumerate() {
            let edge = [place(k), place(k + 1)];
            tell(BoundaryPiece::Edge(edge))?;
            if let FacetSide::On(face) = corner.sides[1] {
                tell(BoundaryPiece::On(face, edge))?;
            }
        }
        Ok(())
    }

    /// Its length or area.
    pub(super) fn measure(&self) -> f64 {
        let normal = minus(self.to.place(), self.at.place());
        match self.places[..] {
            [] => 0.0,
            [p, q] if self.is_plane => {
                let along = minus(&q, &p);
                length_by(dot(&along, &along), &along)
            }
            [first, ref others @ ..] => {
                let mut doubled = [0.0; 3];
                for pair in others.windows(2) {
                    let more = cross(&minus(&pair[0], &first), &minus(&pair[1], &first));
                    doubled = [0, 1, 2].map(|axis| doubled[axis] + more[axis]);
                }
                (0.5 * dot(&doubled, &normalised(&normal))).max(0.0)
            }
        }
    }

    /// Its length or area, and its centroid, from the box's corner of least coordinates; NaN if nothing is left.
    pub(super) fn measure_and_centroid(&self) -> (f64, Vector) {
        let measure = self.measure();
        let [first, ref others @ ..] = self.places[..] else { return (0.0, [f64::NAN; 3]) };
        if self.is_plane {
            return (measure, [0, 1, 2].map(|axis| 0.5 * (first[axis] + others[0][axis])));
        }
        let normal = normalised(&minus(self.to.place(), self.at.place()));
        let (mut sum, mut moment) = (0.0, [0.0; 3]);
        for pair in others.windows(2) {
            let [p, q] = [0, 1].map(|k| minus(&pair[k], &first));
            // The facet is convex, so that what is below zero is rounding.
            let weight = dot(&cross(&p, &q), &normal).max(0.0);
            sum += weight;
            moment = [0, 1, 2].map(|axis| moment[axis] + weight * (p[axis] + q[axis]));
        }
        let offset = if sum > 0.0 { moment.map(|x| x / (3.0 * sum)) } else { [0.0; 3] };
        (measure, [0, 1, 2].map(|axis| first[axis] + offset[axis]))
    }

    /// Adds what it is of the cell of its edge's first end: the pyramid above it, and those above its sides and corners
    /// on faces of the box, as `cut_cells.rs` has them. All have their apex at the same place in the box.
    pub(super) fn add_pyramids(&self, clip: &Clip, apex: &Vector, sums: &mut Sums) {
        let n = self.places.len();
        let from_apex = |k: usize| minus(&self.places[k % n], apex).map(|x| x * clip.unit);
        for (k, corner) in self.corners.iter().enumerate() {
            let p = from_apex(k);
            if self.is_plane {
                if let FacetSide::On(face) = corner.sides[0] {
                    let foot = clip.way_to(face, apex);
                    let along = 1 - face.axis;
                    let length = f64::from(self.normal[along]) * p[along];
                    sums.wall += length;
                    sums.add(0.5 * foot[face.axis].abs() * length, 1.0 / 3.0, [&foot, &p]);
                }
                continue;
            }
            let q = from_apex(k + 1);
            let first = from_apex(0);
            sums.add(dot(&first, &cross(&p, &q)) / 6.0, 0.25, [&first, &p, &q]);
            if let FacetSide::On(face) = corner.sides[1] {
                let foot = clip.way_to(face, apex);
                let doubled = f64::from(face.outward()) * cross(&q, &p)[face.axis];
                sums.wall += 0.5 * doubled;
                sums.add(foot[face.axis].abs() * doubled / 6.0, 0.25, [&foot, &p, &q]);
            }
            if let [FacetSide::On(face), FacetSide::On(next)] = corner.sides {
                let along = 3 - face.axis - next.axis;
                let [one, other] = [face, next].map(|face| clip.way_to(face, apex));
                let heights = [one[face.axis].abs(), other[next.axis].abs()];
                let length = f64::from(self.normal[along]) * p[along];
                sums.wall += 0.5 * (heights[0] + heights[1]) * length;
                // Two tetrahedra, with the foot on either face; one and a half times the foot on the edge is the sum of
                // what both have on average.
                let foot = [0, 1, 2].map(|axis| 1.5 * (one[axis] + other[axis]));
                sums.add(heights[0] * heights[1] * length / 3.0, 0.25, [&foot, &p]);
            }
        }
        if self.is_plane && n == 2 {
            let [p, q] = [0, 1].map(from_apex);
            sums.add(0.5 * cross(&p, &q)[2], 1.0 / 3.0, [&p, &q]);
        }
    }
}
