//! How often the hull winds around a point inside.
//!
//! A hull that is convex at every ridge is the boundary of convex sets, but may have several parts, or cover one more
//! than once. Let a point strictly inside a cell be on the inner side of every facet. Seen from there facets that share
//! a ridge are on different sides of it, so each part of the hull covers the directions of all rays, and nearly all of
//! them equally often: a ray that meets no ridge crosses as many facets as the parts wind in all. If it crosses one,
//! there is one part, and it winds once.
//!
//! Nearly always all signs for a point and a ray in doubles are certain by the static bound: four facets are looked at
//! together. Where a sign is not, or no double is inside a cell, the point has no coordinates: it is
//!
//! ```text
//! c₀ + ε (c₁ - c₀) + ε² (c₂ - c₀) + ...      c: the corners of a cell, ε: above zero, below any number
//! ```
//!
//! which is inside, however thin the cell. An orientation with it is a sum of those with the corners in its place, with
//! weights 1, ε, ε², ... up to smaller ones, so its sign is that of the first which is not zero. The ray goes along the
//! last axis. It meets no ridge, unless that is parallel to it and so behind facets that have no breadth: seen along
//! the axis the corners are not all on the line of a ridge.
//!
//! Cost: `D + 1` orientations a facet, which have all differences and half of their minors in common; exactly, `D + 1`
//! times as many at most. Nothing is asked for.

use super::signs::Signs;
use super::{Delaunay, Geometry, Plane};
use crate::complex::Corners;
use crate::ids::Slot;
use crate::predicates::{self, StaticFilter};
use crate::simd::{ALL, LANES, in_lanes};

/// A point of a box, drawn by a fixed rule.
fn aim_in<G: Geometry>(lower: &G::Point, upper: &G::Point) -> G::Point {
    let mut aim = G::Point::default();
    for k in 0..G::D {
        let hash = (k as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 11;
        let share = hash as f64 / (1u64 << 53) as f64;
        aim[k] = lower[k] + share * (upper[k] - lower[k]);
    }
    aim
}

/// A point strictly inside a cell, infinitesimally far from its first corner.
pub(super) struct Inner<'p, G: Geometry> {
    corners: [&'p G::Point; 4],
    /// Error bounds for places without their last coordinates.
    shadows: StaticFilter,
}

impl<G: Geometry> Inner<'_, G> {
    /// The sign at this point of an affine function, by its values at the corners.
    fn sign(&self, value: impl Fn(&G::Point) -> f64) -> f64 {
        let values = self.corners[..G::Corners::N].iter().map(|corner| value(corner));
        values.into_iter().find(|&value| value != 0.0).unwrap_or(0.0)
    }

    /// Whether the point, seen along the last axis, is surrounded by the corners of a facet in positive order.
    fn is_behind(&self, facet: &[&G::Point]) -> bool {
        if G::D == 2 {
            let [from, to] = [facet[0][0], facet[1][0]];
            return self.sign(|corner| corner[0] - from) > 0.0 && self.sign(|corner| to - corner[0]) > 0.0;
        }
        let shadow = |p: &G::Point| [p[0], p[1]];
        [[0, 1], [1, 2], [2, 0]].iter().all(|&[i, j]| {
            let (from, to) = (shadow(facet[i]), shadow(facet[j]));
            self.sign(|corner| predicates::orient2d(&self.shadows, &from, &to, &shadow(corner))) > 0.0
        })
    }
}

impl<G: Geometry> Delaunay<G> {
    /// A point strictly inside some finite cell.
    pub(super) fn inner_point(&self) -> Option<G::Point> {
        self.complex.finite().find_map(|c| self.point_inside(c))
    }

    /// A point strictly inside a finite cell, unless that is too thin.
    pub(super) fn point_inside(&self, c: Slot) -> Option<G::Point> {
        let corners = &self.complex.cell(c).corners;
        let mut o = G::Point::default();
        for k in 0..G::D {
            o[k] = (0..G::Corners::N).map(|i| self.site(corners[i]).point[k] / G::Corners::N as f64).sum();
        }
        let is_inside = self.is_covered(&o)
            && (0..G::Corners::N)
                .all(|i| G::orientation_with(&self.filter, self.view(), corners, i, &o) > 0.0);
        is_inside.then_some(o)
    }

    /// Whether the hull, which is convex at every ridge, is in one part and winds once around a point inside a cell;
    /// not if these are not all ghost cells. All finite cells must be positive.
    pub(crate) fn winds_once(&self, ghosts: &[Slot]) -> bool {
        let are_all = ghosts.len() == self.complex.n_ghosts();
        are_all
            && (self.inner_point().is_some_and(|o| self.surely_winds_once(ghosts, &o))
                || self.exactly_winds_once(ghosts))
    }

    /// Whether the hull is in one part and winds once, of ghosts that are all there are, by exact signs.
    fn exactly_winds_once(&self, ghosts: &[Slot]) -> bool {
        let Some(o) = self.inner() else { return false };
        let mut n_crossings = 0;
        ghosts.iter().all(|&g| {
            n_crossings += usize::from(self.is_crossed(g, &o));
            n_crossings <= 1 && self.is_inside(g, &o)
        }) && n_crossings == 1
    }

    /// A point strictly inside a finite cell, which must be positive.
    pub(super) fn inner(&self) -> Option<Inner<'_, G>> {
        let cell = self.complex.finite().next()?;
        let corners = self.view().points(&self.complex.cell(cell).corners);
        let [lower, upper] = [&self.lower, &self.upper].map(|p| [p[0], p[1]]);
        Some(Inner { corners, shadows: Plane::filter(&lower, &upper) })
    }

    /// Whether a point is strictly on the inner side of the facet of a ghost cell.
    pub(super) fn is_inside(&self, ghost: Slot, o: &Inner<'_, G>) -> bool {
        let corners = &self.complex.cell(ghost).corners;
        o.sign(|corner| G::orientation_with(&self.filter, self.view(), corners, Self::LAST, corner)) < 0.0
    }

    /// Whether the ray from a point, which is on the inner side of the facet of a ghost cell, along the last axis, one
    /// way for all facets, crosses it.
    pub(super) fn is_crossed(&self, ghost: Slot, o: &Inner<'_, G>) -> bool {
        let facet = self.view().points(&self.complex.cell(ghost).corners);
        o.is_behind(&facet[..G::D])
    }

    /// Whether static bounds show that the hull winds once around `o`, a point inside a cell.
    fn surely_winds_once(&self, ghosts: &[Slot], o: &G::Point) -> bool {
        let aim = aim_in::<G>(&self.lower, &self.upper);
        if !self.is_covered(&aim) {
            return false;
        }
        in_lanes!(simd, self, ghosts, (o, &aim) => |t, ghosts, (o, aim)| {
                let mut n_crossings = 0;
                for four in ghosts.chunks(LANES) {
                    // The last one fills the last lanes.
                    let corners = [0, 1, 2, 3].map(|k| &t.complex.cell(four[k.min(four.len() - 1)]).corners);
                    let ray = G::ray(simd, &t.filter, t.view(), corners, o, aim);
                    if ray.inside & (ray.crossing | ray.passing) != ALL {
                        return false;
                    }
                    n_crossings += (ray.crossing & (ALL >> (LANES - four.len()))).count_ones();
                }
                n_crossings == 1
        })
    }
}

#[cfg(test)]
mod tests;
