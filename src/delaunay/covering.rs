//! The static filter, and the box of the points for which it holds.

use super::{Delaunay, Geometry, order};
use crate::predicates::StaticFilter;

impl<G: Geometry> Delaunay<G> {
    /// The static filter.
    pub(crate) fn filter(&self) -> &StaticFilter {
        &self.filter
    }

    /// Least coordinates of the points for which the static filter is valid.
    pub fn lower(&self) -> G::Point {
        self.lower
    }

    /// Greatest coordinates of the points for which the static filter is valid.
    pub fn upper(&self) -> G::Point {
        self.upper
    }

    /// Makes the static filter valid for points in a box.
    pub fn cover(&mut self, lower: &G::Point, upper: &G::Point) {
        let mut grown = false;
        for k in 0..G::NUMBERS {
            if lower[k] < self.lower[k] {
                self.lower[k] = lower[k];
                grown = true;
            }
            if upper[k] > self.upper[k] {
                self.upper[k] = upper[k];
                grown = true;
            }
        }
        if grown {
            self.filter = G::filter(&self.lower, &self.upper);
        }
    }

    /// Whether the static filter is valid for a point.
    #[inline(always)]
    pub(crate) fn is_covered(&self, p: &G::Point) -> bool {
        let mut is_covered = true;
        for k in 0..G::NUMBERS {
            is_covered &= (self.lower[k] <= p[k]) & (p[k] <= self.upper[k]);
        }
        is_covered
    }

    /// Makes the static filter valid for points in a box and up to `distance` off it: so far is a weight that is off by the square.
    pub(crate) fn cover_around(&mut self, lower: &G::Point, upper: &G::Point, distance: f64) {
        let (mut lower, mut upper) = (*lower, *upper);
        for k in 0..G::NUMBERS {
            let most = if k < G::D { distance } else { (distance * distance).next_up() };
            lower[k] = (lower[k] - most).next_down();
            upper[k] = (upper[k] + most).next_up();
        }
        self.cover(&lower, &upper);
    }

    /// Makes the static filter as sharp as the places of the live sites allow, and, while there is a change that may be
    /// undone, those where they were before. Returns the box of the live sites.
    pub fn tighten_filter(&mut self) -> (G::Point, G::Point) {
        let places = self.sites[1..].iter().filter(|s| s.is_live()).map(|s| &s.point);
        let (lower, upper) = order::bounding_box::<G>(places).unwrap_or_default();
        (self.lower, self.upper) = (lower, upper);
        self.filter = G::filter(&lower, &upper);
        if let Some((lower, upper)) = self.box_before() {
            self.cover(&lower, &upper);
        }
        (lower, upper)
    }
}
