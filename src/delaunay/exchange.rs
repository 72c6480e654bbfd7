//! Positions exchanged with those of sites, several at a time, by dimension: what moves all vertices does no more.

use super::shape::{Plane, Shape, Space};
use super::site::Site;
use crate::simd::{ALL, LANES, Lanes, Real, Simd};

/// The exchange of several positions.
pub trait Exchange: Shape {
    /// Exchanges places with those of sites; returns how many differ, bit by bit. Widens a box, given by its lower and
    /// its upper corner, to the places that the sites get. The lanes of a corner are x, y, x, y in the plane; in space
    /// x, y, z and something without a meaning.
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
        [lower, upper]: &mut [S::Lanes; 2],
    ) -> u64 {
        let places = places.as_flattened_mut();
        let new = [
            simd.load(from(places, 0)),
            simd.load(from(places, 3)),
            simd.load(from(places, 6)),
            simd.load(from(places, 8)).rotated(),
        ];
        let old =
            [simd.load(s.padded()), simd.load(t.padded()), simd.load(u.padded()), simd.load(v.padded())];
        *lower = lower.min(new[0].min(new[1]).min(new[2].min(new[3])));
        *upper = upper.max(new[0].max(new[1]).max(new[2].max(new[3])));
        // What is behind a site's point stays.
        let new = [
            new[0].with_last_of(old[0]),
            new[1].with_last_of(old[1]),
            new[2].with_last_of(old[2]),
            new[3].with_last_of(old[3]),
        ];
        new[0].store_to(s.padded_mut());
        new[1].store_to(t.padded_mut());
        new[2].store_to(u.padded_mut());
        new[3].store_to(v.padded_mut());
        // Each has one number too many, which the next one mends.
        old[0].store_to(from(places, 0));
        old[1].store_to(from(places, 3));
        old[2].store_to(from(places, 6));
        old[3].store_three_to(from(places, 9));
        (0..LANES).map(|k| u64::from(new[k].are_same(old[k]).bits() != ALL)).sum()
    }
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
