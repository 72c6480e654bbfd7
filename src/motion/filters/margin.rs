//! How far the kernel's static filter reaches beyond the vertices, so that one that stays in its region need not be
//! looked at for that.

use crate::delaunay::{Delaunay, Moving};

/// How far the static filter reaches beyond the vertices, as a share of their least extent: no tolerance is greater.
const MARGIN: f64 = 1.0 / 16.0;

/// A distance from fixed positions that the static filter covers. No tolerance is greater.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::motion) struct Margin(f64);

impl Margin {
    /// The margin for the vertices where they are, which the filter covers from now on.
    pub(in crate::motion) fn around_all<G: Moving>(kernel: &mut Delaunay<G>) -> Margin {
        let (lower, upper) = kernel.tighten_filter();
        let extents = (0..G::D).map(|axis| upper[axis] - lower[axis]);
        let margin = extents.fold(f64::INFINITY, f64::min) * MARGIN;
        kernel.cover_around(&lower, &upper, margin);
        Margin(margin)
    }

    /// Makes the filter cover the margin around a vertex that has been relocated.
    #[inline(always)]
    pub(in crate::motion) fn cover<G: Moving>(self, kernel: &mut Delaunay<G>, point: &G::Point) {
        kernel.cover_around(point, point, self.0);
    }

    /// Makes the filter as sharp as what the regions may let pass allows.
    pub(in crate::motion) fn tighten<G: Moving>(self, kernel: &mut Delaunay<G>) {
        let (lower, upper) = kernel.tighten_filter();
        // A vertex is within its tolerance of where it was fixed, and may go as far to the other side of that.
        kernel.cover_around(&lower, &upper, 2.0 * self.0);
    }

    #[inline(always)]
    pub(in crate::motion) fn distance(self) -> f64 {
        self.0
    }
}
