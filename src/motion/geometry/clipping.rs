//! Plane sections of a box, cut by half-spaces; and what both need to know of boxes.
//!
//! In the plane, the box is one of unit height upon it, so that the area of an upright section is its length.

use crate::delaunay::Dimension;
use crate::error::Result;
use crate::machine::memory;

/// A vector of space.
pub(super) type Vector = [f64; 3];

/// A point, in the plane at height 0.
pub(super) fn in_space<G: Dimension>(p: &G::Point) -> Vector {
    std::array::from_fn(|axis| if axis < G::D { p[axis] } else { 0.0 })
}

pub(super) fn minus(p: &Vector, q: &Vector) -> Vector {
    std::array::from_fn(|axis| p[axis] - q[axis])
}

pub(super) fn dot(p: &Vector, q: &Vector) -> f64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

pub(super) fn cross(p: &Vector, q: &Vector) -> Vector {
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
}

/// Half-way between two points.
pub(super) fn middle(p: &Vector, q: &Vector) -> Vector {
    std::array::from_fn(|axis| 0.5 * (p[axis] + q[axis]))
}

/// The vector of length 1 in the direction of one that is not zero, however short or long that is.
fn normalised(p: &Vector) -> Vector {
    let most = p.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    let scaled = p.map(|x| x / most);
    let length = dot(&scaled, &scaled).sqrt();
    scaled.map(|x| x / length)
}

/// A box, between two opposite corners.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clip<G: Dimension> {
    pub(super) low: G::Point,
    pub(super) high: G::Point,
}

impl<G: Dimension> Clip<G> {
    /// Whether a point is in the box or on its boundary.
    #[inline(always)]
    pub(super) fn holds(&self, p: &G::Point) -> bool {
        (0..G::D).fold(true, |holds, axis| holds & (self.low[axis] <= p[axis]) & (p[axis] <= self.high[axis]))
    }

    fn centre(&self) -> Vector {
        middle(&in_space::<G>(&self.low), &in_space::<G>(&self.high))
    }

    fn half_extent(&self, axis: usize) -> f64 {
        0.5 * (self.high[axis] - self.low[axis])
    }
}

/// A convex polygon in a plane of space: corners in coordinates of that plane.
#[derive(Debug, Default)]
pub(super) struct Section {
    origin: Vector,
    axes: [Vector; 2],
    corners: Vec<[f64; 2]>,
    cut: Vec<[f64; 2]>,
}

impl Section {
    /// Makes it that of a box with the plane through a point that is orthogonal to a normal. There is room for
    /// `n_cuts` more cuts.
    pub(super) fn start<G: Dimension>(
        &mut self,
        clip: &Clip<G>,
        normal: &Vector,
        through: &Vector,
        n_cuts: usize,
    ) -> Result<()> {
        let (normal, centre) = (normalised(normal), clip.centre());
        let height = dot(&normal, &minus(through, &centre));
        self.origin = std::array::from_fn(|axis| centre[axis] + height * normal[axis]);
        self.axes = if G::D == 2 {
            [[-normal[1], normal[0], 0.0], [0.0, 0.0, 1.0]]
        } else {
            // Orthogonal to the axis that is the farthest from the normal.
            let [x, y, z] = normal.map(f64::abs);
            let axis = if x <= y && x <= z {
                [1.0, 0.0, 0.0]
            } else if y <= z {
                [0.0, 1.0, 0.0]
            } else {
                [0.0, 0.0, 1.0]
            };
            let first = normalised(&cross(&axis, &normal));
            [first, cross(&normal, &first)]
        };
        let reach = (0..G::D).map(|axis| clip.half_extent(axis)).sum::<f64>();
        self.fill::<G>(reach, 2 * G::D + n_cuts)?;
        for axis in 0..G::D {
            let mut outward = [0.0; 3];
            outward[axis] = 1.0;
            self.keep_behind(&outward, &in_space::<G>(&clip.high));
            outward[axis] = -1.0;
            self.keep_behind(&outward, &in_space::<G>(&clip.low));
        }
        Ok(())
    }

    /// Makes it a square around the origin; in the plane, a rectangle from height 0 to height 1.
    fn fill<G: Dimension>(&mut self, half: f64, n_cuts: usize) -> Result<()> {
        self.corners.clear();
        self.cut.clear();
        memory::reserve(&mut self.corners, 4 + n_cuts)?;
        memory::reserve(&mut self.cut, 4 + n_cuts)?;
        let (least, most) = if G::D == 2 { (0.0, 1.0) } else { (-half, half) };
        self.corners.extend([[-half, least], [half, least], [half, most], [-half, most]]);
        Ok(())
    }

    /// Cuts off what is beyond the plane through a point, on the side to which the normal points.
    pub(super) fn keep_behind(&mut self, normal: &Vector, through: &Vector) {
        let [a, b] = self.axes.map(|axis| dot(normal, &axis));
        let c = dot(normal, &minus(through, &self.origin));
        let beyond = |p: &[f64; 2]| a * p[0] + b * p[1] - c;
        self.cut.clear();
        if let Some(&last) = self.corners.last() {
            let (mut before, mut height_before) = (last, beyond(&last));
            for &corner in &self.corners {
                let height = beyond(&corner);
                if (height_before > 0.0) != (height > 0.0) {
                    let share = height_before / (height_before - height);
                    self.cut.push([0, 1].map(|k| before[k] + share * (corner[k] - before[k])));
                }
                if height <= 0.0 {
                    self.cut.push(corner);
                }
                (before, height_before) = (corner, height);
            }
        }
        std::mem::swap(&mut self.corners, &mut self.cut);
    }

    /// Its area.
    pub(super) fn area(&self) -> f64 {
        let Some((first, others)) = self.corners.split_first() else { return 0.0 };
        let from_first = |p: &[f64; 2]| [p[0] - first[0], p[1] - first[1]];
        let doubled = others.windows(2).map(|pair| {
            let [p, q] = [&pair[0], &pair[1]].map(from_first);
            p[0] * q[1] - p[1] * q[0]
        });
        0.5 * doubled.sum::<f64>().abs()
    }
}
