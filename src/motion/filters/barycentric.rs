//! The weights of a place in a cell: `reading/geometry/weights.rs` has their errors.

use crate::delaunay::{Delaunay, Moving};
use crate::predicates::Measures;

/// The weights of a place in a cell, given by its corners.
pub(in crate::motion) fn barycentric<G: Moving>(
    kernel: &Delaunay<G>,
    places: &[&G::Point],
    q: &G::Point,
) -> [f64; 4] {
    let filter = kernel.filter_for(q);
    let whole = G::Point::sharp_volume(places);
    let mut weights = [0.0; 4];
    for (i, weight) in weights.iter_mut().enumerate().take(places.len()) {
        let mut replaced = [q; 4];
        replaced[..=G::D].copy_from_slice(places);
        replaced[i] = q;
        let replaced = &mut replaced[..=G::D];
        let orientation = G::orient(&filter, replaced);
        if orientation < 0.0 {
            replaced.swap(0, 1);
        }
        if orientation != 0.0 {
            let quotient = G::Point::sharp_volume(replaced) / whole;
            *weight = quotient.max(f64::from_bits(1)).copysign(orientation);
        }
    }
    weights
}
