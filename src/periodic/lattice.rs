//! The translations that leave a periodic set as it is.
//!
//! A *lattice* has all sums of up to D independent vectors, which are on a grid (grid.rs). Positions of vertices are rounded
//! to that grid as well.
//!
//! # Which images can matter
//!
//! Let c be the centre of the empty ball of a cell, u one of its corners, and v a vector of the lattice. u + v and u − v are
//! vertices of the set, so neither is inside of the ball, and |(u − c) · v| ≤ v² / 2. That holds for another corner w as well:
//! |(u − w) · v| ≤ v², whatever the radius is, and with ties. Let u − w have the multiples x of the vectors of a basis, and what is
//! orthogonal to them. Its products with these vectors are y = G x, with their matrix of products G, and |yⱼ| ≤ Gⱼⱼ. So
//! |xᵢ| ≤ Σ |G⁻¹ᵢⱼ| Gⱼⱼ, which is 1 for each of orthogonal vectors, however different their lengths are. Every edge is one of a
//! cell, those of the hull too.
//!
//! The bound is good for a *reduced* basis, whose vectors are short: pairs are reduced as by Gauss, and the third vector by
//! the nearest sums of the others (reduction.rs).

#![expect(clippy::needless_range_loop, reason = "axes and vectors are indices of several arrays at a time")]

use crate::delaunay::Shape;
use crate::error::{Error, Result};
use crate::periodic::grid::{Grid, MOST_UNITS, ROOM, greatest_of};
use crate::periodic::reduction::{SLACK, dot, dual_of};
use crate::periodic::relation::Relation;
use crate::predicates::PointArray;

/// Multiples of one vector.
pub(super) type Range = std::ops::RangeInclusive<i32>;

/// Multiples of the vectors of a reduced basis.
pub(super) type Shift = [i32; 3];

/// No translation.
pub(super) const HOME: Shift = [0; 3];

/// One translation after another.
pub(super) fn plus(one: Shift, other: Shift) -> Shift {
    [0, 1, 2].map(|j| one[j] + other[j])
}

/// The translation after which another one comes to this.
pub(super) fn minus(one: Shift, other: Shift) -> Shift {
    [0, 1, 2].map(|j| one[j] - other[j])
}

/// The least and the greatest multiples of each vector that vertices at home have, and their greatest weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Occupied {
    low: [f64; 3],
    high: [f64; 3],
    /// 0 without weights.
    pub(super) weight: f64,
}

impl Occupied {
    /// What no vertex occupies.
    pub(super) const NOTHING: Self = Occupied { low: [0.0; 3], high: [0.0; 3], weight: f64::NEG_INFINITY };

    /// Now a place with these multiples, too.
    #[inline(always)]
    fn enter(&mut self, multiples: &[f64; 3]) {
        self.low.iter_mut().zip(multiples).for_each(|(low, &x)| *low = low.min(x));
        self.high.iter_mut().zip(multiples).for_each(|(high, &x)| *high = high.max(x));
    }

    /// How many multiples of a vector vertices at home are apart at most.
    pub(super) fn width(&self, j: usize) -> f64 {
        self.high[j] - self.low[j]
    }

    /// Whether no vertex is farther outside of the unit cell than some share of it.
    pub(super) fn is_within(&self, room: &[f64; 3]) -> bool {
        (0..3).all(|j| -room[j] <= self.low[j] && self.high[j] <= 1.0 + room[j])
    }
}

/// A lattice, by its reduced basis.
#[derive(Debug)]
pub(super) struct Lattice<G: Shape> {
    /// The number of vectors: of directions in which the set is periodic.
    pub(super) rank: usize,
    /// The caller's, on the grid.
    given: [G::Point; 3],
    /// Reduced, on the grid.
    pub(super) vectors: [G::Point; 3],
    /// By vector, its multiples of the caller's vectors.
    of_caller: [[i64; 3]; 3],
    /// By axis, the unit of coordinates; 0 where they are as they are given.
    pub(super) unit: [f64; 3],
    /// By axis, how far away positions may be.
    pub(super) limit: [f64; 3],
    /// Linear forms, by which a place has its multiples of the vectors, rounded.
    dual: [[f64; 3]; 3],
    /// The lengths of the forms, or a bit more.
    thickness: [f64; 3],
    /// By vector, the greatest multiples of images that can be needed.
    greatest: Shift,
    /// A way of that length has no multiple of a vector above a half.
    pub(super) short_way: f64,
}

impl<G: Shape> Lattice<G> {
    /// The lattice of these vectors.
    pub(super) fn new(basis: &[G::Point]) -> Result<Self> {
        let rank = basis.len();
        for (index, vector) in basis.iter().enumerate() {
            for (axis, &value) in vector.as_ref().iter().enumerate() {
                if !value.is_finite() {
                    return Err(Error::NotFinite { argument: "vectors", index, axis, value });
                }
                if value.abs() > GREATEST {
                    return Err(Error::OutOfRange {
                        argument: "vectors",
                        index,
                        axis,
                        value,
                        limit: GREATEST,
                    });
                }
                if value != 0.0 && value.abs() < LEAST {
                    let wanted = "0, or at least 1e-50 in magnitude";
                    return Err(Error::InvalidValue {
                        argument: "vectors",
                        index: index * G::D + axis,
                        value,
                        wanted,
                    });
                }
            }
        }
        let mut rows = [[0.0; 3]; 3];
        rows.iter_mut().zip(basis).for_each(|(row, vector)| *row = widened::<G>(vector));
        let grid = (1..=G::D).contains(&rank).then(|| Grid::new(&rows[..rank])).flatten();
        let lattice = grid.and_then(|grid| Self::on_grid(rank, &grid));
        lattice.ok_or(Error::DependentVectors { count: rank })
    }

    /// The lattice of vectors that are on their grid; none if sums of multiples of them are too large for numbers.
    fn on_grid(rank: usize, grid: &Grid) -> Option<Self> {
        let Grid { reduced, unit, given } = grid;
        let rows = reduced.vectors();
        let dual = dual_of(&rows, rank);
        let thickness = dual.map(|form| dot(&form, &form).sqrt() * (1.0 + SLACK));
        let of = |row: &[f64; 3]| {
            let mut point = G::Point::default();
            (0..G::D).for_each(|axis| point[axis] = row[axis]);
            point
        };
        let lattice = Lattice::<G> {
            rank,
            given: given.map(|row| of(&row)),
            vectors: rows.map(|row| of(&row)),
            of_caller: reduced.of_caller,
            unit: *unit,
            limit: grid.limits(&dual)?,
            dual,
            thickness,
            short_way: 0.5 * (1.0 - SLACK) / thickness.iter().fold(0.0, |most, &x| f64::max(most, x)),
            greatest: greatest_of(&rows, &dual, rank),
        };
        Some(lattice)
    }

    pub(super) fn copied(&self) -> Self {
        Lattice { ..*self }
    }

    /// Whether these are the same vectors, given as the same.
    pub(super) fn is_equal(&self, other: &Self) -> bool {
        (self.rank, self.of_caller, self.unit) == (other.rank, other.of_caller, other.unit)
            && self.vectors.iter().zip(&other.vectors).all(|(v, w)| v.as_ref() == w.as_ref())
    }

    /// The number of directions in which the set is periodic.
    pub(super) fn rank(&self) -> usize {
        self.rank
    }

    /// The lengths of the linear forms by which multiples of the vectors are found, or a bit more.
    pub(super) fn thickness(&self) -> [f64; 3] {
        self.thickness
    }

    /// By axis, whether any vector goes along it.
    pub(super) fn is_spanned(&self, axis: usize) -> bool {
        self.unit[axis] != 0.0
    }

    /// How shifts by multiples of these vectors are to be told by those of another lattice, which takes the place of this one:
    /// none if its vectors are too different for each of these to be near one sum of them.
    pub(super) fn relation_to(&self, other: &Self) -> Option<Relation> {
        let mut rows = [[0i64; 3]; 3];
        for j in 0..self.rank {
            let multiples = other.multiples(&self.vectors[j]);
            if multiples.iter().any(|x| x.abs() > GREATEST_RELATION) {
                return None;
            }
            rows[j] = multiples.map(|x| x.round_ties_even() as i64);
        }
        // Along what is open nothing is translated.
        (self.rank..3).for_each(|j| rows[j][j] = 1);
        Some(Relation { rows }).filter(|relation| relation.determinant().abs() == 1)
    }

    /// Whether a place is one at home: on the grid, near the unit cell, and not too far away where no vector goes.
    pub(super) fn has_at_home(&self, place: &G::Point) -> bool {
        let is_on_grid = |axis: usize| {
            let units = place[axis] / self.unit[axis];
            self.unit[axis] == 0.0 || units == units.round_ties_even() && units.abs() <= MOST_UNITS as f64
        };
        let mut occupied = Occupied::NOTHING;
        self.enter(&mut occupied, place);
        (0..G::D).all(is_on_grid) && occupied.is_within(&[ROOM; 3])
    }

    /// Whether there may be an image with this shift.
    pub(super) fn may_need(&self, shift: Shift) -> bool {
        shift.iter().zip(self.greatest).all(|(n, greatest)| n.unsigned_abs() <= greatest.unsigned_abs())
    }

    /// The caller's vectors, on the grid: of these [`new`](Self::new) makes the same lattice, on any machine.
    pub(super) fn given(&self) -> &[G::Point] {
        &self.given[..self.rank]
    }

    /// Multiples of the caller's vectors.
    pub(super) fn of_caller(&self, shift: [i64; 3]) -> [i64; 3] {
        let mut sum = [0; 3];
        for (n, row) in shift.into_iter().zip(&self.of_caller) {
            sum = [0, 1, 2].map(|j| sum[j] + n * row[j]);
        }
        sum
    }

    /// A place after a translation: exact, where both are on the grid and near.
    pub(super) fn translated(&self, place: &G::Point, shift: Shift) -> G::Point {
        let mut sum = *place;
        for (n, vector) in shift.into_iter().zip(&self.vectors) {
            for axis in 0..G::D {
                sum[axis] += f64::from(n) * vector[axis];
            }
        }
        sum
    }

    /// By vector, the greatest multiples of images that can be needed.
    pub(super) fn greatest(&self) -> Shift {
        self.greatest
    }

    /// Enters a vertex at home into what is occupied.
    #[inline(always)]
    pub(super) fn enter(&self, occupied: &mut Occupied, home: &G::Point) {
        occupied.enter(&self.multiples(home));
        if G::HAS_WEIGHTS {
            occupied.weight = occupied.weight.max(home.weight());
        }
    }

    /// The multiples of the vectors that a place has, rounded.
    pub(super) fn multiples(&self, place: &G::Point) -> [f64; 3] {
        let mut multiples = [0.0; 3];
        for (j, form) in self.dual.iter().enumerate() {
            for axis in 0..G::D {
                multiples[j] += form[axis] * place[axis];
            }
        }
        multiples
    }

    /// By vector, the range of multiples by which what is occupied can be translated to meet a ball; none of it is more than
    /// can be needed.
    pub(super) fn shifts_to(&self, centre: &G::Point, radius: f64, occupied: &Occupied) -> [Range; 3] {
        let multiples = self.multiples(centre);
        [0, 1, 2].map(|j| {
            let greatest = f64::from(self.greatest[j]);
            if j >= self.rank {
                return 0..=0;
            }
            let reach = radius * self.thickness[j] + SLACK * (1.0 + multiples[j].abs());
            let low = (multiples[j] - reach - occupied.high[j]).ceil().max(-greatest);
            let high = (multiples[j] + reach - occupied.low[j]).floor().min(greatest);
            // Where numbers are too large to tell, all are in reach.
            if low.is_nan() || high.is_nan() {
                -(greatest as i32)..=greatest as i32
            } else {
                low as i32..=high as i32
            }
        })
    }

    /// By vector, a range of multiples of which some take a place at home to its image nearest to another place: of the way from
    /// there to that image none is above half of the greatest between corners of a cell.
    pub(super) fn shifts_near(&self, to: &G::Point, home: &G::Point) -> [Range; 3] {
        let [to, from] = [to, home].map(|place| self.multiples(place));
        [0, 1, 2].map(|j| {
            if j >= self.rank {
                return 0..=0;
            }
            let middle = to[j] - from[j];
            let reach = 0.5 * f64::from(self.greatest[j]) + SLACK * (1.0 + to[j].abs() + from[j].abs());
            (middle - reach).ceil() as i32..=(middle + reach).floor() as i32
        })
    }

    /// The linear form that is 1 on a vector, and 0 on the others and on what is orthogonal to all.
    pub(super) fn form(&self, j: usize) -> &[f64; 3] {
        &self.dual[j]
    }

    /// By vector, at most so many multiples of it away from its vertex is a Voronoi cell, which is in no half of space that is nearer to
    /// a translation of the vertex by a vector, one way or the other.
    pub(super) fn reach_of_voronoi_cells(&self) -> [f64; 3] {
        let square = |j: usize| dot(&widened::<G>(&self.vectors[j]), &widened::<G>(&self.vectors[j]));
        [0, 1, 2].map(|i| {
            let most: f64 = (0..self.rank).map(|j| dot(&self.dual[i], &self.dual[j]).abs() * square(j)).sum();
            0.5 * most * (1.0 + SLACK)
        })
    }

    /// A way of that length is nearer to no other vector of the lattice than to none.
    pub(super) fn short_way(&self) -> f64 {
        self.short_way
    }

    /// All shifts that can be needed.
    pub(super) fn all_shifts(&self) -> [Range; 3] {
        self.greatest.map(|greatest| -greatest..=greatest)
    }

    /// The length, area or volume of a cell of the lattice, rounded.
    pub(super) fn measure(&self) -> f64 {
        let rows = [0, 1, 2].map(|j| widened::<G>(&self.vectors[j]));
        let mut orthogonal: [[f64; 3]; 3] = rows;
        let mut product = 1.0;
        for j in 0..self.rank {
            for i in 0..j {
                let along = dot(&rows[j], &orthogonal[i]) / dot(&orthogonal[i], &orthogonal[i]);
                orthogonal[j] = [0, 1, 2].map(|axis| orthogonal[j][axis] - along * orthogonal[i][axis]);
            }
            product *= dot(&orthogonal[j], &orthogonal[j]).sqrt();
        }
        product
    }
}

/// Vectors of a reduced basis are at most so many times those of another that takes its place.
const GREATEST_RELATION: f64 = 8.0;

/// Bounds on the entries of a basis.
const GREATEST: f64 = 1e50;
const LEAST: f64 = 1e-50;

fn widened<G: Shape>(point: &G::Point) -> [f64; 3] {
    [0, 1, 2].map(|axis| if axis < G::D { point[axis] } else { 0.0 })
}
