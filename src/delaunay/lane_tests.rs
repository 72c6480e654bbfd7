//! Tests that leave a doubt, by dimension: by bounds alone, and mostly of several cells at a time, in lanes.
//!
//! What they say is so; of what they do not say, exact signs decide.

use super::shape::Shape;
use super::signs::Signs;
use super::site::Sites;
use crate::complex::{Complex, Corners, Facet, INFINITE};
use crate::ids::{SiteId, Slot};
use crate::predicates::StaticFilter;
use crate::simd::{ALL, Avx2, LANES, Lanes, Real};

/// What surely holds of cells, facets and hulls.
pub trait LaneTests: Signs {
    /// Whether a finite cell surely is positively oriented and has no other corner of a neighbour in its sphere.
    fn cell_holds(f: &StaticFilter, sites: Sites<Self>, cells: &Complex<Self::Corners>, cell: Slot) -> bool;

    /// What surely holds of several cells, with these corners and these sites beyond their facets;
    /// [`cell_holds`](Self::cell_holds) is that all of it does.
    fn cells_hold<const HAVE_OWN_BOUNDS: bool>(
        avx2: Avx2,
        f: &StaticFilter,
        sites: Sites<Self>,
        cells: [&Self::Corners; LANES],
        apexes: [&[SiteId; LANES]; 4],
    ) -> Held;

    /// Whether all cells of a star, listed with the index of its site in each, surely are as
    /// [`cell_holds`](Self::cell_holds) says: not if there are ghosts among them. `None` where there is no faster way
    /// than [`cells_hold`](Self::cells_hold).
    #[inline(always)]
    fn star_holds(
        _avx2: Avx2,
        _f: &StaticFilter,
        _sites: Sites<Self>,
        _cells: &Complex<Self::Corners>,
        _star: &[(Slot, u8)],
    ) -> Option<bool> {
        None
    }

    /// For each of several cells, with a site each, whether the site surely is outside the cell's sphere: one bit each.
    fn are_outside(
        avx2: Avx2,
        f: &StaticFilter,
        sites: Sites<Self>,
        cells: [&Self::Corners; LANES],
        others: &[SiteId; LANES],
    ) -> u32;

    /// Where the ray from `o` through `aim` goes, past the facets of several ghosts or through them.
    fn ray(
        avx2: Avx2,
        f: &StaticFilter,
        sites: Sites<Self>,
        ghosts: [&Self::Corners; LANES],
        o: &Self::Point,
        aim: &Self::Point,
    ) -> Ray;

    /// For each of several ghosts, with the finite corners across its ridges, whether the hull surely is convex at all
    /// of these: one bit each.
    fn are_convex(
        avx2: Avx2,
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
    fn facets_hold(
        avx2: Avx2,
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
pub struct Held {
    /// The cells are positively oriented.
    pub positive: Lanes,
    /// The site beyond the facet opposite a corner is outside the sphere; anything of corners that are not there.
    pub facets: [Lanes; 4],
    /// All of this holds by the static bounds, too, which are looser.
    pub by_static_bounds: Lanes,
}

impl Held {
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
