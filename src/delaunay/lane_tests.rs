//! Tests that leave a doubt, by dimension: by bounds alone, and mostly of several cells at a time, in lanes.
//!
//! What they say is so; of what they do not say, exact signs decide.

use super::shape::Shape;
use super::signs::Signs;
use super::site::Sites;
use crate::complex::{Complex, Corners, Facet, INFINITE};
use crate::ids::{SiteId, Slot};
use crate::predicates::StaticFilter;
use crate::simd::{ALL, LANES, Lanes, Real, Simd};

/// What surely holds of cells, facets and hulls.
pub trait LaneTests: Signs {
    /// What surely holds of several finite cells, with these corners and these sites beyond their facets.
    fn cells_hold<S: Simd, const HAVE_OWN_BOUNDS: bool>(
        simd: S,
        f: &StaticFilter,
        sites: Sites<Self>,
        cells: [&Self::Corners; LANES],
        apexes: [&[SiteId; LANES]; 4],
    ) -> Held<S::Lanes>;

    /// Whether all cells of a star, listed with the index of its site in each, surely are positively oriented and
    /// have no other corner of a neighbour in their spheres: not if there are ghosts among them. `None` where there is no faster way
    /// than [`cells_hold`](Self::cells_hold).
    #[inline(always)]
    fn star_holds<S: Simd>(
        _simd: S,
        _f: &StaticFilter,
        _sites: Sites<Self>,
        _cells: &Complex<Self::Corners>,
        _star: &[(Slot, u8)],
    ) -> Option<bool> {
        None
    }

    /// For each of several cells, with a site each, whether the site surely is outside the cell's sphere: one bit each.
    fn are_outside<S: Simd>(
        simd: S,
        f: &StaticFilter,
        sites: Sites<Self>,
        cells: [&Self::Corners; LANES],
        others: &[SiteId; LANES],
    ) -> u32;

    /// Where the ray from `o` through `aim` goes, past the facets of several ghosts or through them.
    fn ray<S: Simd>(
        simd: S,
        f: &StaticFilter,
        sites: Sites<Self>,
        ghosts: [&Self::Corners; LANES],
        o: &Self::Point,
        aim: &Self::Point,
    ) -> Ray;

    /// For each of several ghosts, with the finite corners across its ridges, whether the hull surely is convex at all
    /// of these: one bit each.
    fn are_convex<S: Simd>(
        simd: S,
        f: &StaticFilter,
        sites: Sites<Self>,
        ghosts: [&Self::Corners; LANES],
        across: [&[SiteId; LANES]; 3],
    ) -> u32;

    /// Whether the two cells of a facet, both finite, surely are positively oriented, and it passes the empty-sphere
    /// test.
    fn bicell_holds(
        f: &StaticFilter,
        sites: Sites<Self>,
        cells: &Complex<Self::Corners>,
        facet: Facet,
    ) -> bool;

    /// For each of several facets whether [`bicell_holds`](Self::bicell_holds) says so of it, or sharper bounds do: one
    /// bit each.
    fn facets_hold<S: Simd>(
        simd: S,
        f: &StaticFilter,
        sites: Sites<Self>,
        cells: &Complex<Self::Corners>,
        facets: &[Facet; LANES],
    ) -> u32;

    /// Takes sites that are certainly outside the sphere of a cell out of a set of them, by position.
    fn drop_outside(
        f: &StaticFilter,
        sites: Sites<Self>,
        cell: &Self::Corners,
        listed: &[SiteId],
        set: u64,
    ) -> u64;
}

/// What surely holds of some cells, by bounds of the cells' own if they have these.
#[derive(Clone, Copy)]
pub struct Held<L> {
    /// The cells are positively oriented.
    pub positive: L,
    /// The site beyond the facet opposite a corner is outside the sphere; anything of corners that are not there.
    pub facets: [L; 4],
    /// All of this holds by the static bounds, too, which are looser.
    pub by_static_bounds: L,
}

impl<L: Lanes> Held<L> {
    /// The cells of which all holds, one bit each.
    #[inline(always)]
    pub(super) fn all<G: Shape>(&self) -> u32 {
        self.facets[..G::Corners::N].iter().fold(self.positive, |all, &facet| all & facet).bits()
    }
}

/// Where a ray from a point goes, past facets or through them: bits by facet of what is certain.
#[derive(Clone, Copy)]
pub struct Ray {
    /// The point is on the inner side.
    pub inside: u32,
    /// The ray crosses the facet, if the point is on the inner side.
    pub crossing: u32,
    /// The ray passes the facet, if the point is on the inner side.
    pub passing: u32,
}

impl Ray {
    /// By orientations of facets with the point, and with the point and the aim in place of each corner.
    #[inline(always)]
    pub(super) fn of<S: Simd, const N: usize>(simd: S, f: &StaticFilter, orientations: [S::Lanes; N]) -> Ray {
        let (positive, negative) = (simd.splat(f.orient), simd.splat(-f.orient));
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

/// The corners of the cell of a facet, those of the facet first.
#[inline(always)]
pub(super) fn corners_at<C: Corners>(cells: &Complex<C>, facet: Facet) -> C {
    cells.cell(facet.cell()).corners.rotated_to_last(facet.index())
}

/// The sites beyond facets.
#[inline(always)]
pub(super) fn apexes_beyond<C: Corners>(cells: &Complex<C>, facets: &[Facet; LANES]) -> [SiteId; LANES] {
    let mut apexes = [INFINITE; LANES];
    for (apex, facet) in apexes.iter_mut().zip(facets) {
        *apex = cells.apex(cells.cell(facet.cell()).neighbour(facet.index()));
    }
    apexes
}
