//! Exact signs of orientation and in-sphere determinants, in the plane and in space.
//!
//! Everything above this module decides by signs alone, so a sign must never be wrong; and nearly all
//! signs are easy, so an easy one must cost no more than the determinant itself.
//!
//! # Idea
//!
//! Every predicate evaluates its determinant in plain `f64` and trusts its sign when the magnitude
//! exceeds a bound on the rounding error. Stages are tried from the cheapest to the dearest:
//!
//! 1. *Static*: one bound per predicate, valid for all points of a bounding box ([`StaticFilter`]). The
//!    only work beside the determinant is one comparison; this much is inlined into the caller.
//! 2. *Semi-static*: the same bound for the bounding box of this call's own points; then sharper ones, for `insphere`
//!    from the magnitudes of its terms, for `incircle` from running errors.
//! 3. *Two heights*: where a coordinate has two values, as at the corners of boxes, prisms and layers, the determinant
//!    is zero by comparisons alone, or one of lower degree (`two_heights.rs`; before the sharper bound).
//! 4. *Integer*: where differences are integers that fit, as those of neighbours on a grid are, the determinant
//!    modulo 2⁶⁴ to 2⁵¹², by the length of the differences (`integer.rs`; not for `orient2d`, whose expansions are
//!    short).
//! 5. *Expansions*: otherwise, Shewchuk's adaptive arithmetic, from the crate [`robust`] (not for `insphere`, whose
//!    expansions take 170 KiB of the stack and no less time than the next stage).
//! 6. *Big integers*: where expansions would underflow, the determinant in long integers (`big.rs`).
//!
//! The error constants are not quoted but computed by the compiler, from the operation order of each
//! determinant (`filter.rs`, which holds the analysis).
//!
//! [`exact_calls`] counts the signs that stages after the second decide.
//!
//! A determinant that is exactly zero is a tie. Orientations report it as `0.0`; for in-sphere tests
//! [`incircle_perturbed`] and [`insphere_perturbed`] decide it by vertex id, as if every vertex had been
//! lifted by an infinitesimal of its own, so that they never see a tie (`perturbation.rs`).
//!
//! # Invariants
//!
//! - The sign of a returned value is the sign of the determinant in exact arithmetic. Its magnitude is an
//!   approximation with no promise attached.
//! - A result depends on the positions (and ids, where they are given), never on the filter: a tighter box
//!   is faster, and nothing else.
//! - Swapping two simplex vertices negates the sign.
//! - Nothing allocates, panics or branches on the way to the static comparison, and nothing but the last
//!   stage allocates at all.
//!
//! The caller owes that all coordinates satisfy [`is_in_range`] and lie in the filter's box.
//!
//! # Range
//!
//! Coordinates are finite and of magnitude up to [`MAX_MAGNITUDE`], subnormal numbers included. The
//! arithmetic is that of IEEE 754, rounding to nearest and with gradual underflow. Rust takes that for granted;
//! functions of the C interface see to it, whatever their callers have in force (`machine/environment.rs`).
//!
//! - *No overflow.* Differences are at most 2·10⁵⁷, products of five of them 32·10²⁸⁵, and the in-sphere
//!   determinant is a sum of fewer than 1,000 such products: below 10²⁹⁰. The expansions split factors by
//!   multiplying them by 2²⁷ + 1, but only factors of degree three or less, below 10¹⁸². The largest `f64` is
//!   1.8·10³⁰⁸.
//! - *Underflow in the filters* is part of their bounds (`filter.rs`). Differences never underflow.
//! - *Underflow in integers.* Scaling is by powers of two, and checked by scaling back. A value returned is
//!   kept from underflowing to zero.
//! - *No underflow in expansions.* They are used for points whose coordinates are multiples of a unit 2⁻ˡ
//!   such that kl ≤ 960 in a determinant of degree k. Sums and differences, rounded or not, and the halves
//!   and tails into which Dekker and Shewchuk split numbers are multiples of the same unit, hence a product
//!   of k of them is a multiple of 2⁻⁹⁶⁰ and either zero or a normal number, and every tail is representable.
//!   The bounds by which [`robust`] ends early are products with constants down to 2⁻¹⁰⁵ and may lose 2⁻¹⁰⁷⁵,
//!   which is less than the 2⁻⁵⁰ or so that Shewchuk rounds these constants up by, of a value of 2⁻⁹⁶⁰. With
//!   53 significant bits, coordinates are such multiples if they are zero or at least 2⁵²⁻ˡ: 10⁻¹²⁸ in degree
//!   2 (and for distances), or 10⁻⁸⁰ and 10⁻⁵⁶ in degrees 3 and 4.
//!
//! # Cost
//!
//! Time per call on one core of a recent x86-64 server (only the ratios travel), by the stage that decides:
//!
//! | | operations | bound / extents | static | semi-static | tie, integer | short tie | tie, expansions |
//! |---|---|---|---|---|---|---|---|
//! | [`orient2d`] | 7 | 6 u | 0.8 ns | 2.2 ns | | | 7 ns |
//! | [`incircle`] | 25 | 72 u | 3.5 ns | 5.2 ns | 28 ns | 20 ns | 1,900 ns |
//! | [`orient3d`] | 23 | 40 u | 2.4 ns | 5.0 ns | 13 ns | 12 ns | 160 ns |
//! | [`insphere`] | 74 | 756 u | 7.7 ns | 11.5 ns | 79 ns | 46 ns | |
//!
//! `cargo bench --bench predicates` measures them. A *short tie* is one whose differences have few bits.

mod array;
mod bicells;
mod big;
mod coordinates;
mod corners;
mod crossing;
mod diametral;
mod distance;
#[cfg(test)]
mod dyadic;
mod filter;
mod hull;
mod in_space;
mod integer;
mod lanes;
mod lattice;
mod lengths;
mod lifted;
mod located;
mod measures;
#[cfg(test)]
mod near_ties;
mod passing;
mod path;
mod perturbation;
mod plane;
mod points;
mod power;
mod power_measures;
mod power_tolerance;
mod reach;
mod running;
mod separator;
mod space;
mod sphere;
mod tolerance;
mod two_heights;
mod vectors;
mod weighted;

pub use crate::machine::tally::exact_calls;
pub use crate::simd::LANES;
pub use array::PointArray;
pub use bicells::BiCellTolerances;
pub(crate) use bicells::{
    bicells_hold_for_their_size2d, bicells_hold_for_their_size3d, bicells_surely_hold2d,
    bicells_surely_hold3d,
};
pub use big::compare_lengths;
pub use coordinates::Coordinates;
pub use corners::{Meeting, sign_of_cross};
pub use crossing::{crossing, passes_near};
pub use diametral::is_in_diametral_circle;
pub use distance::{compare_distance, compare_power, is_collinear3, is_within_distance};
pub use filter::StaticFilter;
pub use hull::{area, ray_and_segment, ray_and_triangle, volumes_over};
pub use in_space::{PlaceInSpace, VertexInSpace};
pub use lanes::BiCells;
pub use lattice::exact_filter;
pub use lifted::{Lifted, seen_circle_bound, seen_circle_running_bound, side_of_seen_circle};
pub use measures::Measures;
pub use passing::passes;
pub use path::{stays_positive2d, stays_positive3d};
#[cfg(feature = "internals")]
pub use perturbation::{in_power_circle_perturbed, in_power_sphere_perturbed, insphere_perturbed};
pub use perturbation::{incircle_perturbed, is_inside_cospherical_on_lattice};
pub use plane::{incircle, orient2d};
pub use points::{OwnBounds, PlanePoint, SpacePoint};
pub use power::{MAX_WEIGHT, in_power_circle, in_power_sphere};
pub use reach::Reach;
pub use separator::{delimiter3d, separator3d, tolerances3d};
pub use space::{insphere, orient3d};
pub use sphere::{Circle, Sphere, edge_length, half_space, half_space_by_length, side_bound_by_length};
#[cfg(feature = "internals")]
pub use sphere::{OwnBounds2d, OwnBounds3d, circle, is_box_outside_circle, is_box_outside_sphere, sphere};
pub use tolerance::{
    Delimiter, delimiter2d, displacement_limit, distance_above, distance_from_sphere, is_certainly_inside,
    is_path_certainly_outside, orientation_tolerance2d, orientation_tolerance3d, tolerances2d,
};
pub(crate) use tolerance::{are_within, distances_above};
pub use vectors::squared_distance;
pub(crate) use vectors::{cross, dot, minus};
pub use weighted::WeightedPoint;

/// Largest magnitude of an accepted coordinate.
pub const MAX_MAGNITUDE: f64 = 1e57;

/// Whether `x` is accepted as a coordinate: finite, and of magnitude up to [`MAX_MAGNITUDE`].
#[inline]
pub fn is_in_range(x: f64) -> bool {
    // False for NaN.
    x.abs() <= MAX_MAGNITUDE
}
