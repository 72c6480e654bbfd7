//! What two cells have in common.
//!
//! The heights of a point above the facets of a cell, as determinants, are linear, so that those of the corners of
//! another cell tell all of it. It is cut at the zeros of one height after the other, always along one edge: a cut
//! divides the volume as it divides the edge. What is left where no height is negative is summed up.
//!
//! # Accuracy
//! The volume in common is within [`BOUND`] · ε (E + F) Fⁿ⁻¹ of the exact one, and 8 ε Eⁿ for the volume of the cell
//! that is cut, where ε is 2⁻⁵³, n the dimension, E the greatest difference of coordinates in the cell that is cut,
//! and F that in the cell with the facets, as long as nothing underflows. Proof: a height is a determinant of a
//! difference of up to E + F, as the boxes meet, and of edges up to F: it is off by at most 48 ε (E + F) Fⁿ⁻¹, and
//! those of new corners, which are between others, by 24 more in each of four cuts. So all is within δ = 160 ε (E + F)
//! Fⁿ⁻¹, and what is kept differs from what is in common only where a height is within δ of 0. Let V be the
//! determinant of the cell with the facets. A height within it is below δ on a share nδ/V of its volume V/n! at most,
//! for all facets (n + 1)nδ/n!, at most 3δ; and beyond its facets is what the cell that is larger by 1 + (n + 1)δ/V
//! has more, at most 3.3δ where V is at least 16δ. A flatter one has nothing in common with others by what is
//! computed, and at most 8δ in fact. Shares are rounded in each cut, which is less than 256 ε of a volume up to Fⁿ.

use crate::predicates::PlaceInSpace;

/// By how many ε (E + F) Fⁿ⁻¹ a volume in common may be off.
const BOUND: f64 = 1536.0;

/// By how many ε Eⁿ the volume of a cell may be off.
const BOUND_OF_CELL: f64 = 8.0;

/// As many ε (E + F) Fⁿ⁻¹ a determinant must have for heights above facets to mean anything.
const LEAST: f64 = 2560.0;

const UNIT: f64 = f64::EPSILON / 2.0;

pub(super) fn minus(a: &PlaceInSpace, b: &PlaceInSpace) -> PlaceInSpace {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn plus(a: &PlaceInSpace, b: &PlaceInSpace) -> PlaceInSpace {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn dot(a: &PlaceInSpace, b: &PlaceInSpace) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &PlaceInSpace, b: &PlaceInSpace) -> PlaceInSpace {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The greatest difference of coordinates of the first `n` places.
pub(super) fn extent(corners: &[PlaceInSpace]) -> f64 {
    let of_axis = |j: usize| {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        corners.iter().for_each(|p| (low, high) = (low.min(p[j]), high.max(p[j])));
        high - low
    };
    of_axis(0).max(of_axis(1)).max(of_axis(2))
}

/// The signed area or volume of a cell.
pub(super) fn volume<const D: usize>(corners: &[PlaceInSpace; 4]) -> f64 {
    let [u, v, w] = [1, 2, 3].map(|i| minus(&corners[i], &corners[0]));
    if D == 2 { (u[0] * v[1] - u[1] * v[0]) / 2.0 } else { dot(&cross(&u, &v), &w) / 6.0 }
}

/// The determinant of a cell in units of its extent, which does not underflow: its sign is that of the volume, its
/// magnitude at most 6.
fn determinant<const D: usize>(corners: &[PlaceInSpace; 4], extent: f64) -> f64 {
    let scale = power_below(extent);
    let [u, v, w] = [1, 2, 3].map(|i| minus(&corners[i], &corners[0]).map(|x| x / scale));
    let scaled = if D == 2 { u[0] * v[1] - u[1] * v[0] } else { dot(&cross(&u, &v), &w) };
    if extent > 0.0 { scaled / (extent / scale).powi(D as i32) } else { 0.0 }
}

/// Whether a cell is turned over, so that what it has counts as negative.
pub(super) fn is_turned_over<const D: usize>(corners: &[PlaceInSpace; 4]) -> bool {
    determinant::<D>(corners, extent(&corners[..=D])) < 0.0
}

/// By how much at most the volume of a cell of this extent is off.
pub(super) fn error_of_volume<const D: usize>(extent: f64) -> f64 {
    BOUND_OF_CELL * UNIT * extent.powi(D as i32)
}

/// The centroid of a cell as seen from its first corner.
pub(super) fn centroid<const D: usize>(corners: &[PlaceInSpace; 4]) -> PlaceInSpace {
    let sum = (1..=D).fold([0.0; 3], |sum, i| plus(&sum, &minus(&corners[i], &corners[0])));
    sum.map(|x| x / (D + 1) as f64)
}

/// A cell as the heights above its facets.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facets {
    corners: [PlaceInSpace; 4],
    /// Of the facet opposite each corner: towards it, of about the length of the facet in units of the cell's extent.
    normals: [PlaceInSpace; 4],
    extent: f64,
    /// In units of the extent, see [`determinant`].
    pub(super) determinant: f64,
}

impl Facets {
    pub(super) fn of<const D: usize>(corners: &[PlaceInSpace; 4]) -> Self {
        let extent = extent(&corners[..=D]);
        let scale = power_below(extent);
        let seen = |i: usize, from: usize| minus(&corners[i], &corners[from]).map(|x| x / scale);
        let determinant = determinant::<D>(corners, extent);
        let mut normals = [[0.0; 3]; 4];
        for (k, normal) in normals.iter_mut().enumerate().take(D + 1) {
            let [p, q, r] = others::<D>(k);
            let edge = seen(q, p);
            let plain = if D == 2 { [-edge[1], edge[0], 0.0] } else { cross(&edge, &seen(r, p)) };
            // Outwards or inwards by the place of the corner in the row, and by the sign of the cell.
            let is_inwards = if D == 2 { k != 1 } else { k % 2 == 1 };
            *normal = if is_inwards == (determinant > 0.0) { plain } else { plain.map(|x| -x) };
        }
        Facets { corners: *corners, normals, extent, determinant }
    }

    /// The height of a place above the facet opposite a corner; exactly 0 at the corners of the facet.
    fn height<const D: usize>(&self, k: usize, place: &PlaceInSpace) -> f64 {
        let on_facet = others::<D>(k);
        if on_facet[..D].iter().any(|&i| self.corners[i] == *place) {
            return 0.0;
        }
        dot(&self.normals[k], &minus(place, &self.corners[on_facet[0]]))
    }

    /// Whether heights of a cell of this extent mean anything.
    fn is_solid(&self, its_extent: f64) -> bool {
        self.determinant.abs() > LEAST * UNIT * (1.0 + its_extent / self.extent)
    }

    /// Whether all of a cell is certainly beyond one facet by more than an eighth of the height above it, though its
    /// corners may be off by four times a `rounding` from where they are told.
    pub(super) fn is_beyond<const D: usize>(
        &self,
        other: &[PlaceInSpace; 4],
        its_extent: f64,
        rounding: f64,
    ) -> bool {
        let per_unit = self.extent / power_below(self.extent);
        let whole = self.determinant.abs() * self.extent * per_unit.powi(D as i32 - 1);
        self.is_solid(its_extent)
            && whole >= 1024.0 * rounding
            && (0..=D).any(|k| other[..=D].iter().all(|p| self.height::<D>(k, p) < -whole / 4.0))
    }

    /// By how much at most the volume in common with a cell of this extent is off, but for that of the cell.
    pub(super) fn error<const D: usize>(&self, its_extent: f64) -> f64 {
        BOUND * UNIT * (its_extent + self.extent) * self.extent.powi(D as i32 - 1)
    }

    /// What is in common with a cell of this extent: the share of its volume, and that times where the centroid of the
    /// common part is as seen from the cell's first corner.
    pub(super) fn overlap<const D: usize>(&self, other: &[PlaceInSpace; 4], its_extent: f64) -> Overlap {
        let mut sum = Overlap::default();
        if !self.is_solid(its_extent) {
            return sum;
        }
        let corners = [0, 1, 2, 3].map(|i| {
            let mut corner = CornerHeights { at: minus(&other[i], &other[0]), heights: [0.0; 4] };
            if i <= D {
                (0..=D).for_each(|k| corner.heights[k] = self.height::<D>(k, &other[i]));
            }
            corner
        });
        if (0..=D).all(|k| (0..=D).any(|i| corners[i].heights[k] > 0.0)) {
            cut::<D>(corners, 1.0, 0, &mut sum);
        }
        sum
    }
}

/// A part of a cell.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Overlap {
    pub(super) share: f64,
    pub(super) moment: PlaceInSpace,
}

#[derive(Clone, Copy)]
struct CornerHeights {
    at: PlaceInSpace,
    heights: [f64; 4],
}

/// Sums up what of a cell has no negative height, from that above a facet on; `share` is the cell's of the whole.
fn cut<const D: usize>(mut corners: [CornerHeights; 4], mut share: f64, first: usize, sum: &mut Overlap) {
    for k in first..=D {
        loop {
            let find = |is: fn(f64) -> bool| (0..=D).find(|&i| is(corners[i].heights[k]));
            let Some(above) = find(|height| height > 0.0) else { return };
            let Some(below) = find(|height| height < 0.0) else { break };
            let (a, b) = (corners[above], corners[below]);
            let part = a.heights[k] / (a.heights[k] - b.heights[k]);
            let mut between = CornerHeights {
                at: [0, 1, 2].map(|j| a.at[j] + part * (b.at[j] - a.at[j])),
                heights: [0, 1, 2, 3].map(|m| a.heights[m] + part * (b.heights[m] - a.heights[m])),
            };
            between.heights[k] = 0.0;
            let mut near = corners;
            near[below] = between;
            cut::<D>(near, part * share, k, sum);
            corners[above] = between;
            share *= 1.0 - part;
        }
    }
    sum.share += share;
    for j in 0..D {
        let of_corners: f64 = corners[..=D].iter().map(|corner| corner.at[j]).sum();
        sum.moment[j] += share * of_corners / (D + 1) as f64;
    }
}

/// The corners of the facet opposite one, in the order of the row; in the plane the last is none.
fn others<const D: usize>(k: usize) -> [usize; 3] {
    let mut rest = (0..=D).filter(|&i| i != k);
    std::array::from_fn(|_| rest.next().unwrap_or(0))
}

/// A power of two that is at most a length and more than half of it; the least normal one for shorter lengths, as
/// powers of these would be 0.
fn power_below(length: f64) -> f64 {
    f64::from_bits(length.max(f64::MIN_POSITIVE).to_bits() & 0x7ff0_0000_0000_0000)
}
