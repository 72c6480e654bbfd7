//! Positions that programs give: whether they are good, and equal.

use crate::delaunay::Moving;
use crate::error::{AXIS_OF_WEIGHT, Error, Result};
use crate::motion::state::part::{PointPart, set_part};
use crate::predicates::{MAX_MAGNITUDE, MAX_WEIGHT, PointArray, is_in_range};

/// Whether two places, without negative zeros, differ.
#[inline(always)]
pub(in crate::motion) fn differ<G: Moving>(p: &G::Point, q: &G::Point) -> bool {
    (0..G::NUMBERS).fold(0, |bits, axis| bits | (p[axis].to_bits() ^ q[axis].to_bits())) != 0
}

/// Copies positions, with the sign of zeros made positive; `false` if one is bad.
#[inline(always)]
pub(in crate::motion) fn copy_checked<G: Moving>(to: &mut [G::Point], positions: &[G::Point]) -> bool {
    let mut bad = 0u64;
    for (to, &value) in G::Point::flattened_mut(to).iter_mut().zip(G::Point::flattened(positions)) {
        bad |= u64::from(!is_in_range(value));
        *to = value + 0.0;
    }
    bad == 0 || G::HAS_WEIGHTS && are_good::<G>(positions)
}

/// The greatest magnitude of a number of a point: of a coordinate, or of the weight after them.
pub(in crate::motion) const fn limit<G: Moving>(k: usize) -> f64 {
    if k < G::D { MAX_MAGNITUDE } else { MAX_WEIGHT }
}

/// Whether all positions are good. Without a branch for each, several at a time are looked at.
pub(in crate::motion) fn are_good<G: Moving>(positions: &[G::Point]) -> bool {
    if G::HAS_WEIGHTS {
        return positions.iter().all(|p| (0..G::NUMBERS).all(|k| p[k].abs() <= limit::<G>(k)));
    }
    G::Point::flattened(positions).iter().fold(true, |are_good, &x| are_good & is_in_range(x))
}

/// The first error in positions of which one is bad.
#[cold]
pub(in crate::motion) fn first_bad<G: Moving>(positions: &[G::Point]) -> Error {
    let errors = positions.iter().enumerate().map(|(v, p)| check_position::<G>("positions", v, p));
    errors.filter_map(Result::err).next().expect("one is bad")
}

/// A position with the sign of zeros made positive, so that equal places are equal bits.
#[inline(always)]
pub(crate) fn check_position<G: Moving>(
    argument: &'static str,
    index: usize,
    p: &G::Point,
) -> Result<G::Point> {
    let mut checked = *p;
    for axis in 0..G::NUMBERS {
        let value = p[axis];
        checked[axis] = value + 0.0;
        if value.abs() <= limit::<G>(axis) {
            continue;
        }
        if axis == G::D {
            check_weight(argument, index, value)?;
        }
        let limit = limit::<G>(axis);
        return Err(if value.is_finite() {
            Error::OutOfRange { argument, index, axis, value, limit }
        } else {
            Error::NotFinite { argument, index, axis, value }
        });
    }
    Ok(checked)
}

/// Checks a weight of a point.
#[inline(always)]
pub(crate) fn check_weight(argument: &'static str, index: usize, weight: f64) -> Result<()> {
    if weight.abs() <= MAX_WEIGHT {
        return Ok(());
    }
    let (argument, axis, value) = (weights_of(argument), AXIS_OF_WEIGHT, weight);
    Err(if weight.is_finite() {
        Error::OutOfRange { argument, index, axis, value, limit: MAX_WEIGHT }
    } else {
        Error::NotFinite { argument, index, axis, value }
    })
}

/// What the weights are called of points that have this name.
fn weights_of(argument: &'static str) -> &'static str {
    if argument == "position" { "weight" } else { "weights" }
}

/// The numbers of a part of a point must be good.
pub(crate) fn check_numbers<G: Moving>(
    argument: &'static str,
    index: usize,
    part: PointPart,
    numbers: &[f64],
) -> Result<()> {
    let mut point = G::Point::default();
    set_part::<G>(&mut point, part, numbers);
    check_position::<G>(argument, index, &point).map(drop)
}

/// A bound must be a number that is not negative.
pub(crate) fn check_not_negative(argument: &'static str, value: f64) -> Result<()> {
    if value >= 0.0 {
        return Ok(());
    }
    Err(Error::InvalidValue { argument, index: 0, value, wanted: "0 or more" })
}
