//! Sites in space, read several at a time.

use super::shape::Space;
use super::site::Sites;
use crate::ids::SiteId;
use crate::predicates::{PointArray, SpacePoint, WeightedPoint};
use crate::simd::{LANES, Simd};

/// A point of space, as cells of several of them are read.
pub trait InSpace: SpacePoint {
    /// Several sites, in lanes.
    fn of_sites<S: Simd>(simd: S, all: Sites<Space<Self>>, sites: [SiteId; LANES]) -> Self::Of<S::Lanes>;
}

impl InSpace for [f64; 3] {
    #[inline(always)]
    fn of_sites<S: Simd>(simd: S, all: Sites<Space>, sites: [SiteId; LANES]) -> [S::Lanes; 3] {
        let [x, y, z, _] = simd.fours(sites.map(|s| all.padded_point(s)));
        [x, y, z]
    }
}

impl InSpace for WeightedPoint<3> {
    #[inline(always)]
    fn of_sites<S: Simd>(
        simd: S,
        all: Sites<Space<Self>>,
        sites: [SiteId; LANES],
    ) -> WeightedPoint<3, S::Lanes> {
        let numbers = |s| Self::flattened(std::slice::from_ref(all.point(s))).first_chunk();
        let [x, y, z, weight] = simd.fours(sites.map(|s| numbers(s).expect("four numbers")));
        WeightedPoint { place: [x, y, z], weight }
    }
}
