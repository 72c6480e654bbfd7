//! Positions on the grid of a lattice, and the translations that take them home.

#![expect(clippy::needless_range_loop, reason = "axes and vectors are indices of several arrays at a time")]

use crate::delaunay::Shape;
use crate::error::{Error, Result};
use crate::motion::check_weight;
use crate::periodic::grid::{MOST_UNITS, ROOM, exact};
use crate::periodic::lattice::Lattice;
use crate::predicates::{MAX_MAGNITUDE, PointArray};

/// Positions of fewer units of the grid are rounded to it without long numbers, and translated by a vector without rounding.
const SHORT: f64 = (1u64 << 51) as f64;

impl<G: Shape> Lattice<G> {
    /// A position in units of the grid; 0 along axes that have none.
    #[inline(always)]
    pub(super) fn units_of(
        &self,
        argument: &'static str,
        index: usize,
        position: &G::Point,
    ) -> Result<[i128; 3]> {
        let mut units = [0i128; 3];
        for axis in 0..G::D {
            let value = position[axis];
            if !value.is_finite() {
                return Err(Error::NotFinite { argument, index, axis, value });
            }
            let (unit, limit) = (self.unit[axis], self.limit[axis]);
            if value.abs() > limit {
                return Err(Error::OutOfRange { argument, index, axis, value, limit });
            }
            if unit != 0.0 {
                units[axis] = (value / unit).round_ties_even() as i128;
            }
        }
        Ok(units)
    }

    /// Checks that a position is one of a vertex.
    pub(super) fn check(&self, argument: &'static str, index: usize, position: &G::Point) -> Result<()> {
        check_weight(argument, index, position.weight())?;
        self.units_of(argument, index, position).map(drop)
    }

    /// What multiples of the vectors are along an axis, in units of the grid.
    pub(super) fn units_along(&self, axis: usize, multiples: &[i64; 3]) -> i128 {
        let unit = self.unit[axis];
        let of = |j: usize| i128::from(multiples[j]) * (self.vectors[j][axis] / unit) as i128;
        if unit == 0.0 { 0 } else { (0..self.rank).map(of).sum() }
    }

    /// The place of so many units along axes on the grid; along others that of the position.
    pub(super) fn place_of(&self, position: &G::Point, units: &[i128; 3]) -> G::Point {
        let mut place = *position;
        for axis in (0..G::D).filter(|&axis| self.unit[axis] != 0.0) {
            place[axis] = units[axis] as f64 * self.unit[axis];
        }
        place
    }

    /// A position on the grid, in the unit cell but for rounding, and by how much it was translated to come from there.
    pub(super) fn wrapped(
        &self,
        argument: &'static str,
        index: usize,
        position: &G::Point,
    ) -> Result<(G::Point, [i64; 3])> {
        check_weight(argument, index, position.weight())?;
        if let Some(place) = self.place_of_short(position, &[0; 3])
            && self.multiples(&place).iter().all(|&x| (0.0..1.0).contains(&x))
        {
            return Ok((place, [0; 3]));
        }
        let mut units = self.units_of(argument, index, position)?;
        let mut total = [0i64; 3];
        let mut place = self.place_of(position, &units);
        // What is far away gets near in a few steps, as multiples of many digits are rounded.
        for _ in 0..8 {
            let multiples = self.multiples(&place).map(|x| x.floor() as i64);
            if multiples == [0; 3] {
                break;
            }
            for axis in 0..G::D {
                units[axis] -= self.units_along(axis, &multiples);
            }
            total = [0, 1, 2].map(|j| total[j] + multiples[j]);
            place = self.place_of(position, &units);
        }
        self.reject_far(argument, index, position, &units)?;
        Ok((place, total))
    }

    /// A position on the grid, less the multiples of the vectors in `wrap`, which change to those that take it closest to
    /// `near`.
    #[inline(always)]
    pub(super) fn wrapped_near(
        &self,
        argument: &'static str,
        index: usize,
        position: &G::Point,
        near: &G::Point,
        wrap: &mut [i64; 3],
    ) -> Result<G::Point> {
        check_weight(argument, index, position.weight())?;
        if let Some(place) = self.place_of_short(position, wrap) {
            let mut square = 0.0;
            (0..G::D).for_each(|axis| square += (place[axis] - near[axis]) * (place[axis] - near[axis]));
            // No multiple of that way is above a half.
            if square <= self.short_way * self.short_way {
                return Ok(place);
            }
        }
        self.wrapped_far(argument, index, position, near, wrap)
    }

    /// A position on the grid, less these multiples of the vectors, if all of that has few enough digits.
    #[inline(always)]
    fn place_of_short(&self, position: &G::Point, wrap: &[i64; 3]) -> Option<G::Point> {
        let mut place = *position;
        let mut is_short = true;
        for axis in 0..G::D {
            let unit = self.unit[axis];
            if unit != 0.0 {
                let units = position[axis] / unit;
                is_short &= units.abs() < SHORT;
                place[axis] = units.round_ties_even() * unit;
            } else {
                is_short &= position[axis].abs() <= MAX_MAGNITUDE;
            }
        }
        if *wrap != [0; 3] {
            for axis in 0..G::D {
                let mut greatest = 0.0;
                for j in 0..self.rank {
                    let way = wrap[j] as f64 * self.vectors[j][axis];
                    greatest += way.abs();
                    place[axis] -= way;
                }
                is_short &= self.unit[axis] == 0.0 || greatest < SHORT * self.unit[axis];
            }
        }
        is_short.then_some(place)
    }

    /// The home of a position which is far away, or has come a long way.
    #[cold]
    #[inline(never)]
    fn wrapped_far(
        &self,
        argument: &'static str,
        index: usize,
        position: &G::Point,
        near: &G::Point,
        wrap: &mut [i64; 3],
    ) -> Result<G::Point> {
        let (mut way, total) = self.wrapped(argument, index, position)?;
        (0..G::D).for_each(|axis| way[axis] -= near[axis]);
        let multiples = self.multiples(&way).map(|x| x.round_ties_even() as i64);
        *wrap = [0, 1, 2].map(|j| total[j] + multiples[j]);
        self.place_of_long(argument, index, position, wrap)
    }

    /// A position at home: the period that is nearest to `near`, if that is in the unit cell or near it, and the one in
    /// the unit cell otherwise; and by how much it was translated to come from there.
    pub(super) fn at_home(
        &self,
        argument: &'static str,
        index: usize,
        position: &G::Point,
        near: Option<&G::Point>,
    ) -> Result<(G::Point, [i64; 3])> {
        let is_near = |place: &G::Point, room: f64| {
            self.multiples(place).iter().all(|x| (-room..=1.0 + room).contains(x))
        };
        if let Some(near) = near.filter(|near| is_near(near, 1.0)) {
            let mut wrap = [0; 3];
            let place = self.wrapped_near(argument, index, position, near, &mut wrap)?;
            if is_near(&place, ROOM) {
                return Ok((place, wrap));
            }
        }
        self.wrapped(argument, index, position)
    }

    /// The reduced vectors.
    pub(super) fn reduced(&self) -> &[G::Point] {
        &self.vectors[..self.rank]
    }

    /// A position on the grid less multiples of the vectors, whatever its magnitude.
    fn place_of_long(
        &self,
        argument: &'static str,
        index: usize,
        position: &G::Point,
        wrap: &[i64; 3],
    ) -> Result<G::Point> {
        let mut units = self.units_of(argument, index, position)?;
        (0..G::D).for_each(|axis| units[axis] -= self.units_along(axis, wrap));
        self.reject_far(argument, index, position, &units)?;
        Ok(self.place_of(position, &units))
    }

    /// An error if a position at home is so far away, in a direction that the vectors do not span, that translations of it are
    /// rounded.
    fn reject_far(
        &self,
        argument: &'static str,
        index: usize,
        position: &G::Point,
        units: &[i128; 3],
    ) -> Result<()> {
        match (0..G::D).find(|&axis| units[axis].abs() > MOST_UNITS) {
            Some(axis) => {
                let limit = MOST_UNITS as f64 * self.unit[axis];
                Err(Error::OutOfRange { argument, index, axis, value: position[axis], limit })
            }
            None => Ok(()),
        }
    }

    /// Whether a vertex at home may have come there by this translation: its position is a number that has not been rounded, and
    /// not too far away.
    pub(super) fn may_come_by(&self, place: &G::Point, wrap: &[i64; 3]) -> bool {
        let is_exact = |axis: usize| {
            let units = self.units_from(place, wrap, axis);
            self.unit[axis] == 0.0 || exact(units).is_some()
        };
        (0..G::D).all(is_exact) && self.check("positions", 0, &self.unwrapped(place, wrap)).is_ok()
    }

    /// How many units along an axis the position of which a place at home is the translation has.
    fn units_from(&self, place: &G::Point, wrap: &[i64; 3], axis: usize) -> i128 {
        (place[axis] / self.unit[axis]) as i128 + self.units_along(axis, wrap)
    }

    /// The position of which a place at home is the translation.
    pub(super) fn unwrapped(&self, place: &G::Point, wrap: &[i64; 3]) -> G::Point {
        if *wrap == [0; 3] {
            return *place;
        }
        let mut units = [0i128; 3];
        for axis in (0..G::D).filter(|&axis| self.unit[axis] != 0.0) {
            units[axis] = self.units_from(place, wrap, axis);
        }
        self.place_of(place, &units)
    }
}
