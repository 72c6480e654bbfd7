//! Facets as keys: the two cells of a facet see the same corners, in orders of opposite orientation.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

use crate::complex::Corners;
use crate::ids::SiteId;

/// A map from facets, each by the first that [`facet_of`] returns.
pub(super) type ByCorners<C, V> = HashMap<C, V, BuildHasherDefault<Mix>>;

/// The corners of a facet, ascending, and whether they are an odd permutation of the facet as its cell sees
/// it.
pub(super) fn facet_of<C: Corners>(corners: &C, i: usize) -> (C, bool) {
    let last = C::N - 1;
    let mut facet = corners.rotated_to_last(i).with(last, SiteId::NONE);
    let mut is_odd = false;
    for end in (1..last).rev() {
        for k in 0..end {
            if facet[k] > facet[k + 1] {
                facet.as_mut().swap(k, k + 1);
                is_odd = !is_odd;
            }
        }
    }
    (facet, is_odd)
}

/// Hash of a facet, or of indices and small numbers: products and rotations are enough for these.
#[derive(Default)]
pub(crate) struct Mix(u64);

impl Hasher for Mix {
    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(4) {
            self.write_u32(chunk.iter().rev().fold(0, |number, &byte| number << 8 | u32::from(byte)));
        }
    }

    fn write_u32(&mut self, number: u32) {
        self.0 = (self.0.rotate_left(26) ^ u64::from(number)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }

    fn finish(&self) -> u64 {
        self.0 ^ self.0 >> 32
    }
}
