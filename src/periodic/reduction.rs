//! The shortest vectors of a lattice: pairs are reduced as by Gauss, and the third vector by the nearest sums of the others (I.
//! Semaev: *A 3-dimensional lattice reduction algorithm*. CaLC 2001, 10.1007/3-540-44670-2_13).
//!
//! Where shortest vectors tie, or nearly so, there are several reduced bases. The one that is found follows from the basis
//! that was given, so that a box that is strained a bit keeps its own. What must depend on the lattice alone is asked of all
//! of them ([`for_short_bases`](Reduced::for_short_bases)), or of the first one in an order of vectors
//! ([`first`](Reduced::first)). All are sums of the vectors of any of them with multiples -1, 0 and 1: half of another sum is
//! nearer to a shorter vector of the lattice than to none.

#![expect(clippy::needless_range_loop, reason = "axes and vectors are indices of several arrays at a time")]

use std::cmp::Ordering;

use crate::predicates::compare_lengths;

/// By how much bounds on rounded numbers are widened, relatively.
pub(super) const SLACK: f64 = 1e-9;

/// Vectors whose squares differ by less, as a share of the square of their difference, tie: far more than what a reduction
/// leaves.
const TIE: f64 = 1e-6;

/// Vectors are read with so many bits.
const LONG_BITS: i32 = 96;

/// A vector, and its multiples of those of a basis.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    row: [i128; 3],
    multiples: [i64; 3],
}

/// Sums of the vectors of a basis with multiples -1, 0 and 1, one of two that are opposite.
const SUMS: usize = 13;

/// A basis of integers while it is reduced.
#[derive(Clone, Debug)]
pub(super) struct Reduced {
    pub(super) rank: usize,
    /// By vector and axis, in units of that axis.
    rows: [[i128; 3]; 3],
    /// By axis, the unit.
    units: [f64; 3],
    pub(super) of_caller: [[i64; 3]; 3],
    /// Whether the vectors that were given have not been rounded.
    pub(super) is_exact: bool,
}

impl Reduced {
    /// A reduced basis; none if the vectors depend on each other, or nearly so.
    pub(super) fn new(basis: &[[f64; 3]]) -> Option<Self> {
        let mut reduced = Reduced {
            rank: basis.len(),
            rows: [[0; 3]; 3],
            units: [1.0; 3],
            of_caller: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
            is_exact: true,
        };
        for axis in 0..3 {
            let entries = || basis.iter().map(|vector| vector[axis].abs()).filter(|&x| x > 0.0);
            if let Some(last) = entries().map(last_bit).min() {
                let finest = exponent_above(entries().fold(0.0, f64::max)) - LONG_BITS;
                reduced.units[axis] = 2f64.powi(finest.max(last));
                reduced.is_exact &= finest <= last;
            }
        }
        for (row, vector) in reduced.rows.iter_mut().zip(basis) {
            *row = [0, 1, 2].map(|axis| (vector[axis] / reduced.units[axis]).round_ties_even() as i128);
        }
        for _ in 0..MAX_STEPS {
            if !reduced.step()? {
                return if reduced.is_independent() { reduced.or_the_first() } else { None };
            }
        }
        None
    }

    pub(super) fn vectors(&self) -> [[f64; 3]; 3] {
        self.rows.map(|row| self.rounded(&row))
    }

    fn rounded(&self, row: &[i128; 3]) -> [f64; 3] {
        [0, 1, 2].map(|axis| row[axis] as f64 * self.units[axis])
    }

    /// Makes one vector shorter by multiples of others; whether that was possible. The vectors are in the order of their
    /// lengths then. None if numbers are too large.
    fn step(&mut self) -> Option<bool> {
        let vectors = self.vectors();
        let squares = vectors.map(|v| dot(&v, &v));
        for j in 1..self.rank {
            if squares[j] < squares[j - 1] {
                self.rows.swap(j, j - 1);
                self.of_caller.swap(j, j - 1);
                return Some(true);
            }
        }
        for j in 1..self.rank {
            let mut best = (0.0, [0i64; 2]);
            for multiples in self.near(&vectors, j) {
                let gain = self.excess(&self.rows[j], &self.minus(j, multiples)?, SLACK)?;
                if gain > best.0 {
                    best = (gain, multiples);
                }
            }
            if best.1 != [0; 2] {
                self.rows[j] = self.minus(j, best.1)?;
                for (i, n) in best.1.into_iter().enumerate() {
                    for axis in 0..3 {
                        let product = n.checked_mul(self.of_caller[i][axis])?;
                        self.of_caller[j][axis] = self.of_caller[j][axis].checked_sub(product)?;
                    }
                }
                return Some(true);
            }
        }
        Some(false)
    }

    /// By how much the square of a vector is greater than that of another one, less a share of the square of their
    /// difference, and less what may be rounding: as a product of the difference and the sum, so that a short difference of
    /// long vectors counts.
    fn excess(&self, one: &[i128; 3], other: &[i128; 3], share: f64) -> Option<f64> {
        let (mut way, mut sum) = ([0; 3], [0; 3]);
        for axis in 0..3 {
            way[axis] = one[axis].checked_sub(other[axis])?;
            sum[axis] = one[axis].checked_add(other[axis])?;
        }
        let (way, sum) = (self.rounded(&way), self.rounded(&sum));
        let (way_square, sum_square) = (dot(&way, &way), dot(&sum, &sum));
        let rounding = 4.0 * f64::EPSILON * (way_square * sum_square).sqrt();
        Some(dot(&way, &sum) - share * way_square - rounding)
    }

    /// Multiples of the vectors before one whose sums are near it.
    fn near(&self, vectors: &[[f64; 3]; 3], j: usize) -> impl Iterator<Item = [i64; 2]> + use<> {
        let dual = dual_of(vectors, j);
        let middle = [0, 1].map(|i| if i < j { dot(&dual[i], &vectors[j]).round() as i64 } else { 0 });
        let width = [0, 1].map(|i| i64::from(i < j));
        (-width[0]..=width[0]).flat_map(move |a| {
            (-width[1]..=width[1]).map(move |b| [middle[0].saturating_add(a), middle[1].saturating_add(b)])
        })
    }

    /// A vector less multiples of those before it.
    fn minus(&self, j: usize, multiples: [i64; 2]) -> Option<[i128; 3]> {
        let mut row = self.rows[j];
        for (i, n) in multiples.into_iter().enumerate().take(j) {
            for axis in 0..3 {
                let product = self.rows[i][axis].checked_mul(i128::from(n))?;
                row[axis] = row[axis].checked_sub(product)?;
            }
        }
        Some(row)
    }

    fn is_independent(&self) -> bool {
        let vectors = self.vectors();
        let dual = dual_of(&vectors, self.rank);
        (0..self.rank).all(|j| {
            let product = dot(&dual[j], &dual[j]).sqrt() * dot(&vectors[j], &vectors[j]).sqrt();
            product < GREATEST_DEFECT
        })
    }

    /// The sums of the vectors that may be in a reduced basis, the shortest first; how many there are.
    fn sums(&self) -> ([Sum; SUMS], usize) {
        let (mut sums, mut n) = ([Sum::default(); SUMS], 0);
        let range = |j: usize| if j < self.rank { -1..=1 } else { 0..=0 };
        for a in range(0) {
            for b in range(1) {
                for c in range(2) {
                    let multiples: [i64; 3] = [a, b, c];
                    // Of two that are opposite the one whose first multiple is positive.
                    if multiples > [0; 3] {
                        let along =
                            |axis: usize| (0..3).map(|j| i128::from(multiples[j]) * self.rows[j][axis]).sum();
                        sums[n] = Sum { row: [0, 1, 2].map(along), multiples };
                        n += 1;
                    }
                }
            }
        }
        sums[..n].sort_unstable_by(|one, other| self.order(&one.row, &other.row));
        (sums, n)
    }

    /// An order of vectors that depends on nothing else, nor on their directions: by length, and then by coordinates.
    fn order(&self, one: &[i128; 3], other: &[i128; 3]) -> Ordering {
        let squares = [one, other].map(|row| self.rounded(row)).map(|v| dot(&v, &v));
        if (squares[0] - squares[1]).abs() > 1e-14 * (squares[0] + squares[1]) {
            return squares[0].total_cmp(&squares[1]);
        }
        let exponents = self.units.map(exponent_above);
        let upwards = |row: &[i128; 3]| if *row < [0; 3] { row.map(|x| -x) } else { *row };
        compare_lengths(one, other, &exponents).then_with(|| upwards(one).cmp(&upwards(other)))
    }

    /// Finds the sums that are together a basis, in their order, until one is enough.
    fn find_basis(&self, sums: &[Sum], mut is_enough: impl FnMut([usize; 3]) -> bool) {
        let after = |j: usize, index: usize| if j < self.rank { index + 1..sums.len() } else { 0..1 };
        for i in 0..sums.len() {
            for j in after(1, i) {
                for k in after(2, j) {
                    let mut rows = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
                    for (row, index) in rows.iter_mut().zip([i, j, k]).take(self.rank) {
                        *row = sums[index].multiples;
                    }
                    if determinant(&rows).abs() == 1 && is_enough([i, j, k]) {
                        return;
                    }
                }
            }
        }
    }

    /// The places of the shortest vectors that are a basis, the first ones of those that tie.
    fn first_of(&self, sums: &[Sum]) -> [usize; 3] {
        let mut first = [0; 3];
        self.find_basis(sums, |places| {
            first = places;
            true
        });
        first
    }

    /// Calls with the places of all bases of vectors that tie with the shortest ones, or nearly so.
    fn for_ties(&self, sums: &[Sum], mut enter: impl FnMut([usize; 3])) {
        let first = self.first_of(sums);
        let ties = |index: usize, j: usize| {
            let (row, shortest) = (&sums[index].row, &sums[first[j]].row);
            let [v, w] = [row, shortest].map(|row| self.rounded(row));
            let row = if dot(&v, &w) < 0.0 { row.map(|x| -x) } else { *row };
            self.excess(&row, shortest, TIE).is_some_and(|excess| excess <= 0.0)
        };
        self.find_basis(sums, |places| {
            if (0..self.rank).all(|j| ties(places[j], j)) {
                enter(places);
            }
            false
        });
    }

    /// Calls with the vectors of all bases that are as short as possible, or nearly so: a set that depends on the lattice alone.
    pub(super) fn for_short_bases(&self, mut enter: impl FnMut(&[[f64; 3]; 3])) {
        let (sums, n) = self.sums();
        self.for_ties(&sums[..n], |places| {
            let of = |j: usize| if j < self.rank { self.rounded(&sums[places[j]].row) } else { [0.0; 3] };
            enter(&[0, 1, 2].map(of));
        });
    }

    /// The first one of the shortest bases, which depends on the lattice alone but for the directions of vectors.
    pub(super) fn first(&self) -> Option<Self> {
        let (sums, n) = self.sums();
        let places = self.first_of(&sums[..n]);
        let mut first = self.clone();
        for j in 0..self.rank {
            let Sum { row, multiples } = sums[places[j]];
            first.rows[j] = row;
            for k in 0..3 {
                let mut sum = 0i64;
                for i in 0..3 {
                    sum = sum.checked_add(multiples[i].checked_mul(self.of_caller[i][k])?)?;
                }
                first.of_caller[j][k] = sum;
            }
        }
        Some(first)
    }

    /// The basis itself, if it is one of the shortest ones, or nearly so, and else the first one of these.
    fn or_the_first(self) -> Option<Self> {
        let (sums, n) = self.sums();
        let mut is_one = false;
        self.for_ties(&sums[..n], |places| {
            let is_own = |j: usize| {
                let multiples = sums[places[j]].multiples;
                multiples.iter().filter(|&&m| m != 0).count() == 1
            };
            is_one |= (0..self.rank).all(is_own);
        });
        if is_one { Some(self) } else { self.first() }
    }

    /// Which multiples of these vectors each of the caller's is; none of numbers that are too large.
    pub(super) fn to_caller(&self) -> Option<[[i128; 3]; 3]> {
        let m = self.of_caller.map(|row| row.map(i128::from));
        let mut inverse = [[0; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                // The entries of the inverse are those of the transposed cofactors, as the determinant is 1 or -1.
                let ([a, b], [c, d]) = ([(i + 1) % 3, (i + 2) % 3], [(j + 1) % 3, (j + 2) % 3]);
                inverse[j][i] = m[a][c].checked_mul(m[b][d])?.checked_sub(m[a][d].checked_mul(m[b][c])?)?;
            }
        }
        let mut determinant = 0i128;
        for j in 0..3 {
            determinant = determinant.checked_add(m[0][j].checked_mul(inverse[j][0])?)?;
        }
        Some(inverse.map(|row| row.map(|x| determinant * x)))
    }
}

fn determinant([a, b, c]: &[[i64; 3]; 3]) -> i64 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}
/// Steps of a reduction: each but a swap makes a vector shorter, mostly by half and more.
const MAX_STEPS: usize = 2_000;

/// The vectors of a reduced basis are that far from orthogonal at most; rounded, those that depend on each other are farther.
const GREATEST_DEFECT: f64 = 4.0;

/// Linear forms that are 1 on one vector and 0 on the others, and on what is orthogonal to all.
pub(super) fn dual_of(vectors: &[[f64; 3]; 3], rank: usize) -> [[f64; 3]; 3] {
    let mut dual = [[0.0; 3]; 3];
    for j in 0..rank {
        // What a vector has orthogonal to the others.
        let [one, other] =
            match [(j + 1) % 3, (j + 2) % 3].map(|i| if i < rank { vectors[i] } else { [0.0; 3] }) {
                [one, other] if one == [0.0; 3] => [other, one],
                pair => pair,
            };
        let v = vectors[j];
        let part = if other != [0.0; 3] {
            let normal = cross(&one, &other);
            scaled(&normal, dot(&v, &normal) / dot(&normal, &normal))
        } else if one != [0.0; 3] {
            let along = dot(&v, &one) / dot(&one, &one);
            [0, 1, 2].map(|axis| v[axis] - along * one[axis])
        } else {
            v
        };
        dual[j] = scaled(&part, 1.0 / dot(&part, &part));
    }
    dual
}

pub(super) fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

fn scaled(a: &[f64; 3], factor: f64) -> [f64; 3] {
    a.map(|x| x * factor)
}

/// The least exponent of a power of two that is not below a positive number; exact, so that grids are those of any machine.
pub(super) fn exponent_above(x: f64) -> i32 {
    let bits = x.to_bits();
    (bits >> 52) as i32 - 1023 + i32::from(bits << 12 != 0)
}

/// The exponent of the last bit of a positive number, which is none of the smallest there are.
fn last_bit(x: f64) -> i32 {
    let bits = x.to_bits() | 1 << 52;
    (x.to_bits() >> 52) as i32 - 1075 + bits.trailing_zeros() as i32
}
