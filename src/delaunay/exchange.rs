//! Positions exchanged with those of sites, several at a time, by dimension: what moves all vertices does no more.

use super::shape::{Plane, PowerPlane, PowerSpace, Shape, Space};
use super::site::Site;
use crate::predicates::{PointArray, WeightedPoint};
use crate::simd::{ALL, LANES, Lanes, Real, Simd};

/// The exchange of several positions.
pub trait Exchange: Shape {
    /// Exchanges places with those of sites; returns how many differ, bit by bit. Widens a box, given by its lower and
    /// its upper corner, to the places that the sites get. The lanes of a corner are x, y, x, y in the plane without weights;
    /// elsewhere the numbers of a point, and something without a meaning where these are three.
    fn exchange<S: Simd>(
        simd: S,
        places: &mut [Self::Point; LANES],
        sites: [&mut Site<Self>; LANES],
        covered: &mut [S::Lanes; 2],
    ) -> u64;
}

impl Exchange for Plane {
    #[inline(always)]
    fn exchange<S: Simd>(
        simd: S,
        places: &mut [[f64; 2]; LANES],
        [s, t, u, v]: [&mut Site<Plane>; LANES],
        [lower, upper]: &mut [S::Lanes; 2],
    ) -> u64 {
        /// How many of the two pairs of bits of a number are not both set.
        const N_PAIRS: [u8; 1 << LANES] = [2, 2, 2, 1, 2, 2, 2, 1, 2, 2, 2, 1, 1, 1, 1, 0];
        let (first, last) = halves(places);
        let new = [simd.load(first), simd.load(last)];
        let old = [simd.two_pairs(&s.point, &t.point), simd.two_pairs(&u.point, &v.point)];
        new[0].store_low_to(&mut s.point);
        new[0].store_high_to(&mut t.point);
        new[1].store_low_to(&mut u.point);
        new[1].store_high_to(&mut v.point);
        old[0].store_to(first);
        old[1].store_to(last);
        *lower = lower.min(new[0].min(new[1]));
        *upper = upper.max(new[0].max(new[1]));
        let [first, last] = [0, 1].map(|k| N_PAIRS[new[k].are_same(old[k]).bits() as usize]);
        u64::from(first + last)
    }
}

impl Exchange for Space {
    #[inline(always)]
    fn exchange<S: Simd>(
        simd: S,
        places: &mut [[f64; 3]; LANES],
        [s, t, u, v]: [&mut Site<Space>; LANES],
        covered: &mut [S::Lanes; 2],
    ) -> u64 {
        let sites = [s.padded_mut(), t.padded_mut(), u.padded_mut(), v.padded_mut()];
        exchange_threes(simd, places.as_flattened_mut(), sites, covered)
    }
}

impl Exchange for PowerPlane {
    #[inline(always)]
    fn exchange<S: Simd>(
        simd: S,
        places: &mut [WeightedPoint<2>; LANES],
        [s, t, u, v]: [&mut Site<PowerPlane>; LANES],
        covered: &mut [S::Lanes; 2],
    ) -> u64 {
        let sites = [s.padded_mut(), t.padded_mut(), u.padded_mut(), v.padded_mut()];
        exchange_threes(simd, WeightedPoint::flattened_mut(places), sites, covered)
    }
}

impl Exchange for PowerSpace {
    #[inline(always)]
    fn exchange<S: Simd>(
        simd: S,
        places: &mut [WeightedPoint<3>; LANES],
        sites: [&mut Site<PowerSpace>; LANES],
        [lower, upper]: &mut [S::Lanes; 2],
    ) -> u64 {
        let numbers =
            |p| WeightedPoint::flattened_mut(std::slice::from_mut(p)).first_chunk_mut().expect("four");
        let mut n_moved = 0;
        for (place, site) in places.iter_mut().zip(sites) {
            let (place, site): (&mut [f64; 4], &mut [f64; 4]) = (numbers(place), numbers(&mut site.point));
            let (new, old) = (simd.load(place), simd.load(site));
            (*lower, *upper) = (lower.min(new), upper.max(new));
            new.store_to(site);
            old.store_to(place);
            n_moved += u64::from(new.are_same(old).bits() != ALL);
        }
        n_moved
    }
}

/// Exchanges points of three numbers with those of sites, which have another one behind them that stays.
#[inline(always)]
fn exchange_threes<S: Simd>(
    simd: S,
    places: &mut [f64],
    [s, t, u, v]: [&mut [f64; 4]; LANES],
    [lower, upper]: &mut [S::Lanes; 2],
) -> u64 {
    let new = [
        simd.load(from(places, 0)),
        simd.load(from(places, 3)),
        simd.load(from(places, 6)),
        simd.load(from(places, 8)).rotated(),
    ];
    let old = [simd.load(s), simd.load(t), simd.load(u), simd.load(v)];
    *lower = lower.min(new[0].min(new[1]).min(new[2].min(new[3])));
    *upper = upper.max(new[0].max(new[1]).max(new[2].max(new[3])));
    let new = [
        new[0].with_last_of(old[0]),
        new[1].with_last_of(old[1]),
        new[2].with_last_of(old[2]),
        new[3].with_last_of(old[3]),
    ];
    new[0].store_to(s);
    new[1].store_to(t);
    new[2].store_to(u);
    new[3].store_to(v);
    // Each has one number too many, which the next one mends.
    old[0].store_to(from(places, 0));
    old[1].store_to(from(places, 3));
    old[2].store_to(from(places, 6));
    old[3].store_three_to(from(places, 9));
    (0..LANES).map(|k| u64::from(new[k].are_same(old[k]).bits() != ALL)).sum()
}

#[inline(always)]
fn halves(places: &mut [[f64; 2]; LANES]) -> (&mut [f64; LANES], &mut [f64; LANES]) {
    let halves = places.as_flattened_mut().as_chunks_mut().0;
    let [first, last] = halves else { unreachable!("four pairs") };
    (first, last)
}

#[inline(always)]
fn from<const N: usize>(numbers: &mut [f64], first: usize) -> &mut [f64; N] {
    numbers[first..].first_chunk_mut().expect("all are there")
}
