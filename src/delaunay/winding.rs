//! How often the hull winds around a point inside.
//!
//! A hull that is convex at every ridge is the boundary of a convex set, but may cover it more than once. A ray from a
//! point strictly inside a cell crosses as many of its facets as it winds. The point must be on the inner side of each.
//!
//! Nearly all of these signs are certain by the static bound. So four facets are looked at together, and all of them
//! again, one by one and exactly, only where a sign of one is not.
//!
//! Cost: `D + 1` orientations a facet, which have all differences and half of their minors in common.

use super::{Delaunay, Dimension, order};
use crate::complex::Corners;
use crate::ids::Slot;
use crate::predicates::StaticFilter;
use crate::simd::{ALL, Avx2, LANES, Lanes, Real};

/// Where a ray from a point goes, past facets or through them: bits by facet of what is certain.
#[derive(Clone, Copy)]
pub struct Ray {
    /// The point is on the inner side.
    pub inside: u32,
    /// The ray crosses the facet, if the point is on the inner side.
    pub crossing: u32,
    /// It passes the facet, likewise.
    pub passing: u32,
}

impl Ray {
    /// By orientations of facets with the point, and with the point and the aim in place of each corner.
    #[inline(always)]
    pub(super) fn of<const N: usize>(avx2: Avx2, f: &StaticFilter, orientations: [Lanes; N]) -> Ray {
        let (positive, negative) = (avx2.splat(f.orient), avx2.splat(-f.orient));
        // The facet of a ghost is oriented as seen from outside: negative, with a point on the inner side.
        let is_negative = orientations.map(
            #[inline(always)]
            |x| x.is_less(negative).bits(),
        );
        let is_positive = orientations.map(
            #[inline(always)]
            |x| positive.is_less(x).bits(),
        );
        Ray {
            inside: is_negative[0],
            crossing: is_negative[1..].iter().fold(ALL, |all, bits| all & bits),
            passing: is_positive[1..].iter().fold(0, |any, bits| any | bits),
        }
    }
}

/// A point of a box, drawn by a fixed rule.
fn aim_in<G: Dimension>(lower: &G::Point, upper: &G::Point, attempt: u32) -> G::Point {
    let mut aim = G::Point::default();
    for k in 0..G::D {
        let hash = (u64::from(attempt) * 3 + k as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 11;
        let share = hash as f64 / (1u64 << 53) as f64;
        aim[k] = lower[k] + share * (upper[k] - lower[k]);
    }
    aim
}

/// A point of a curve that meets any hyperplane in at most as many points as there are dimensions.
fn aim_on_curve<G: Dimension>(step: u32) -> G::Point {
    let mut aim = G::Point::default();
    let mut power = 1.0;
    for k in 0..G::D {
        power *= f64::from(step);
        aim[k] = power;
    }
    aim
}

/// Aims in the box of the hull that are tried: the first nearly always serves.
const AIMS_IN_BOX: u32 = 64;
/// Aims on the curve: the third powers of smaller numbers are exact.
const AIMS_ON_CURVE: u32 = 1 << 17;

impl<G: Dimension> Delaunay<G> {
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

    /// Whether the hull, which is convex at every ridge, winds once around a point inside a cell; `false` also if these
    /// are not all ghost cells, or if every cell is so thin that no double lies inside.
    pub(crate) fn winds_once(&self, ghosts: &[Slot]) -> bool {
        let are_all = ghosts.len() == self.complex.n_ghosts();
        are_all
            && self.inner_point().is_some_and(|o| {
                let is_inside = |&g: &Slot| {
                    let corners = &self.complex.cell(g).corners;
                    G::orientation_with(&self.filter, self.view(), corners, Self::LAST, &o) < 0.0
                };
                self.surely_winds_once(ghosts, &o)
                    || ghosts.iter().all(is_inside) && self.crossings_of(ghosts.iter().copied(), &o).0 == 1
            })
    }

    /// The same, of ghosts that are all there are, and a point inside a cell, if static bounds show it.
    fn surely_winds_once(&self, ghosts: &[Slot], o: &G::Point) -> bool {
        let aim = aim_in::<G>(&self.lower, &self.upper, 0);
        let Some(avx2) = Avx2::new().filter(|_| self.is_covered(&aim)) else { return false };
        avx2.run_with(
            self,
            ghosts,
            (o, &aim),
            #[inline(always)]
            |t, ghosts, (o, aim)| {
                let mut n_crossings = 0;
                for four in ghosts.chunks(LANES) {
                    // The last one fills the last lanes.
                    let corners = [0, 1, 2, 3].map(|k| &t.complex.cell(four[k.min(four.len() - 1)]).corners);
                    let ray = G::ray(avx2, &t.filter, t.view(), corners, o, aim);
                    if ray.inside & (ray.crossing | ray.passing) != ALL {
                        return false;
                    }
                    n_crossings += (ray.crossing & (ALL >> (LANES - four.len()))).count_ones();
                }
                n_crossings == 1
            },
        )
    }

    /// How many of the ghosts' facets, all of which have `o` on their inner side, a ray from `o` that meets no ridge
    /// crosses, and a point on it. `o` must be in the box of the filter.
    ///
    /// Where the hull is a few roundings wide, its box may have no other aims than `o` and points behind ridges. Of
    /// those on the curve, each ridge is in the way of as many as there are dimensions at most, since it is in one
    /// hyperplane with `o`.
    pub(super) fn crossings_of(
        &self,
        ghosts: impl Iterator<Item = Slot> + Clone,
        o: &G::Point,
    ) -> (usize, G::Point) {
        let aim = aim_in::<G>(&self.lower, &self.upper, 0);
        if self.is_covered(&aim)
            && let Some(crossings) = self.crossings(&self.filter, ghosts.clone(), o, &aim)
        {
            return (crossings, aim);
        }
        // The box of the hull: that of the filter may be far wider.
        let corners = ghosts.clone().map(|g| &self.complex.cell(g).corners.as_ref()[..Self::LAST]);
        let places = corners.flatten().map(|&s| &self.site(s).point);
        let (lower, upper) = order::bounding_box::<G>(places).unwrap_or_default();
        let in_box = (0..AIMS_IN_BOX).map(|attempt| aim_in::<G>(&lower, &upper, attempt));
        let mut aims = in_box.chain((1..AIMS_ON_CURVE).map(aim_on_curve::<G>));
        let crossings = |aim: G::Point| {
            // Aims may be out of the box of the triangulation's filter.
            let (lower, upper) = order::bounding_box::<G>([&lower, &upper, o, &aim].into_iter())?;
            let filter = G::filter(&lower, &upper);
            Some((self.crossings(&filter, ghosts.clone(), o, &aim)?, aim))
        };
        aims.find_map(crossings).unwrap_or((0, *o))
    }

    /// How many facets the ray from `o` through `aim` crosses; `None` if it meets a ridge.
    fn crossings(
        &self,
        filter: &StaticFilter,
        ghosts: impl Iterator<Item = Slot>,
        o: &G::Point,
        aim: &G::Point,
    ) -> Option<usize> {
        let mut crossings = 0;
        for c in ghosts {
            crossings += usize::from(self.is_crossed(filter, c, o, aim)?);
        }
        Some(crossings)
    }

    /// Whether the ray from `o` through `aim` crosses the facet of a ghost cell, of which `o` is on the inner side;
    /// `None` if it meets the boundary of the facet, or there is no ray.
    fn is_crossed(&self, filter: &StaticFilter, ghost: Slot, o: &G::Point, aim: &G::Point) -> Option<bool> {
        let mut is_crossed = Some(true);
        for i in 0..G::D {
            let mut points = self.view().points(&self.complex.cell(ghost).corners);
            (points[i], points[Self::LAST]) = (aim, o);
            // The facet of a ghost is oriented as seen from outside: negative, with a point on the inner side.
            let sign = G::orient(filter, &points[..G::Corners::N]);
            if sign > 0.0 {
                return Some(false);
            }
            if sign == 0.0 {
                is_crossed = None;
            }
        }
        is_crossed
    }
}

#[cfg(test)]
mod tests;
