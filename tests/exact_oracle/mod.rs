//! Exact answers, in integers, for whatever `f64` coordinates; and random numbers.
//!
//! Every `f64` is an integer times a power of two, so a case is scaled to integers and its determinant
//! evaluated exactly: in `i128` where it fits, else in big integers.

// Every test file uses a part of this.
#![allow(dead_code)]

pub mod reach;

use num_bigint::{BigInt, Sign};
use std::array::from_fn;
use std::cmp::Ordering;

/// Integers enough to evaluate a determinant.
pub trait Integer: Clone {
    fn minus(&self, other: &Self) -> Self;
    fn plus(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Self;
    fn compare_zero(&self) -> Ordering;
}

impl Integer for i128 {
    fn minus(&self, other: &Self) -> Self {
        self - other
    }
    fn plus(&self, other: &Self) -> Self {
        self + other
    }
    fn times(&self, other: &Self) -> Self {
        self * other
    }
    fn compare_zero(&self) -> Ordering {
        self.cmp(&0)
    }
}

impl Integer for BigInt {
    fn minus(&self, other: &Self) -> Self {
        self - other
    }
    fn plus(&self, other: &Self) -> Self {
        self + other
    }
    fn times(&self, other: &Self) -> Self {
        self * other
    }
    fn compare_zero(&self) -> Ordering {
        match self.sign() {
            Sign::Minus => Ordering::Less,
            Sign::NoSign => Ordering::Equal,
            Sign::Plus => Ordering::Greater,
        }
    }
}

/// Determinant of a square matrix of two to four rows, by minors of the first two columns.
pub fn determinant<T: Integer>(rows: &[Vec<T>]) -> T {
    let minor = |column: usize, i: usize, j: usize| {
        let [p, q] = [&rows[i], &rows[j]];
        p[column].times(&q[column + 1]).minus(&p[column + 1].times(&q[column]))
    };
    match rows.len() {
        2 => minor(0, 0, 1),
        3 => {
            let term = |i, j, k: usize| minor(0, i, j).times(&rows[k][2]);
            term(0, 1, 2).minus(&term(0, 2, 1)).plus(&term(1, 2, 0))
        }
        4 => {
            let term = |i, j, k, l| minor(0, i, j).times(&minor(2, k, l));
            let positive =
                term(0, 1, 2, 3).plus(&term(0, 3, 1, 2)).plus(&term(1, 2, 0, 3)).plus(&term(2, 3, 0, 1));
            positive.minus(&term(0, 2, 1, 3)).minus(&term(1, 3, 0, 2))
        }
        n => unreachable!("{n} rows"),
    }
}

/// `x` = mantissa · 2^exponent with an odd mantissa, or 0 = 0 · 2^0.
pub fn decode(x: f64) -> (i64, i32) {
    if x == 0.0 {
        return (0, 0);
    }
    let exponent = (x.to_bits() >> 52 & 0x7ff) as i32;
    assert!(exponent < 0x7ff, "{x} is not finite");
    let leading = u64::from(exponent > 0) << 52;
    let exponent = exponent.max(1);
    let mantissa = (x.to_bits() & ((1 << 52) - 1) | leading) as i64;
    let zeros = mantissa.trailing_zeros();
    ((mantissa >> zeros) * if x < 0.0 { -1 } else { 1 }, exponent - 1075 + zeros as i32)
}

/// The points as integers in units of a common power of two, its exponent, and the bits of the largest.
pub fn common_unit<const D: usize>(points: &[[f64; D]]) -> (i32, u32) {
    let decoded = || points.iter().flatten().map(|&x| decode(x)).filter(|&(mantissa, _)| mantissa != 0);
    let unit = decoded().map(|(_, exponent)| exponent).min().unwrap_or(0);
    let bits = decoded().map(|(m, e)| (e - unit) as u32 + 64 - m.unsigned_abs().leading_zeros()).max();
    (unit, bits.unwrap_or(0))
}

/// The differences to the last point, as integers: small ones if a polynomial of `degree` in them is sure to
/// fit.
pub enum Differences {
    Small(Vec<Vec<i128>>),
    Big(Vec<Vec<BigInt>>),
}

pub fn differences<const D: usize>(points: &[[f64; D]], degree: u32) -> Differences {
    let (unit, bits) = common_unit(points);
    let (last, others) = points.split_last().unwrap();
    if bits <= 126 {
        let integer = |x: f64| {
            let (mantissa, exponent) = decode(x);
            if mantissa == 0 { 0 } else { i128::from(mantissa) << (exponent - unit) }
        };
        let row = |p: &[f64; D]| (0..D).map(|i| integer(p[i]) - integer(last[i])).collect();
        let rows: Vec<Vec<i128>> = others.iter().map(row).collect();
        let largest = rows.iter().flatten().map(|d| 128 - d.unsigned_abs().leading_zeros()).max().unwrap();
        // Each determinant has at most 2^7 monomials.
        if degree * largest + 7 <= 126 {
            return Differences::Small(rows);
        }
    }
    Differences::Big(big_differences(points))
}

pub fn big_differences<const D: usize>(points: &[[f64; D]]) -> Vec<Vec<BigInt>> {
    let (unit, _) = common_unit(points);
    let (last, others) = points.split_last().unwrap();
    let integer = |x: f64| {
        let (mantissa, exponent) = decode(x);
        if mantissa == 0 { BigInt::ZERO } else { BigInt::from(mantissa) << (exponent - unit) }
    };
    let row = |p: &[f64; D]| (0..D).map(|i| integer(p[i]) - integer(last[i])).collect();
    others.iter().map(row).collect()
}

/// Appends the squared length to every row.
pub fn lift<T: Integer>(rows: &mut [Vec<T>]) {
    for row in rows {
        let square = row.iter().map(|x| x.times(x)).reduce(|a, b| a.plus(&b)).unwrap();
        row.push(square);
    }
}

// ---------------------------------------------------------------------------------------------- random
// numbers

#[path = "../common/random.rs"]
#[allow(clippy::duplicate_mod)] // The fuzz targets take this folder without the other.
mod random;

/// Random numbers as the predicates' tests need them.
pub struct Random(random::Rng);

impl Random {
    pub fn new(seed: u64) -> Self {
        Random(random::Rng::new(seed))
    }

    pub fn next(&mut self) -> u64 {
        self.0.next()
    }

    pub fn below(&mut self, n: usize) -> usize {
        self.0.below(n)
    }

    /// Integer in -n..=n.
    pub fn integer(&mut self, n: i64) -> i64 {
        self.below(2 * n as usize + 1) as i64 - n
    }

    /// In [-1, 1).
    pub fn unit(&mut self) -> f64 {
        2.0 * self.0.unit() - 1.0
    }

    pub fn sign(&mut self) -> f64 {
        if self.below(2) == 0 { 1.0 } else { -1.0 }
    }

    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        self.0.shuffle(items);
    }
}

/// `x` moved by `n` units in the last place, away from zero if positive. Zero stays.
pub fn nudged(x: f64, n: i64) -> f64 {
    if x == 0.0 { x } else { f64::from_bits(x.to_bits().wrapping_add_signed(n)) }
}

// ---------------------------------------------------------------------------------------------- answers

/// How many cases there were, how many of them in big integers, and how many of them ties.
#[derive(Default)]
pub struct Tally {
    pub cases: usize,
    pub big: usize,
    pub zero: usize,
}

impl Tally {
    fn count(&mut self, is_big: bool, is_zero: bool) {
        self.cases += 1;
        self.big += usize::from(is_big);
        self.zero += usize::from(is_zero);
    }

    pub fn add(&mut self, other: &Self) {
        self.cases += other.cases;
        self.big += other.big;
        self.zero += other.zero;
    }
}

/// Sign of the orientation of `D + 1` points or of the in-sphere determinant of `D + 2`.
pub fn exact_sign<const D: usize, const N: usize>(points: &[[f64; D]; N], tally: &mut Tally) -> Ordering {
    fn sign<T: Integer>(mut rows: Vec<Vec<T>>, is_lifted: bool) -> Ordering {
        if is_lifted {
            lift(&mut rows);
        }
        determinant(&rows).compare_zero()
    }
    let is_lifted = N == D + 2;
    let (sign, is_big) = match differences(points, if is_lifted { D + 2 } else { D } as u32) {
        Differences::Small(rows) => (sign(rows, is_lifted), false),
        Differences::Big(rows) => (sign(rows, is_lifted), true),
    };
    tally.count(is_big, sign == Ordering::Equal);
    // In space, differences to the last point make a left-handed basis of a positive tetrahedron.
    if D == 3 { sign.reverse() } else { sign }
}

/// The sign of the in-sphere determinant whose lifts are polynomials |p|² + ε(id), the indeterminate of the
/// highest id being the largest: a determinant is linear in its last column, so its coefficients are the
/// determinants whose last column holds one coefficient of every lift.
pub fn is_inside_by_polynomial<const D: usize, const N: usize>(
    points: &[[f64; D]; N],
    ids: &[u32; N],
    tally: &mut Tally,
) -> bool {
    fn leading<T: Integer + From<i8>>(rows: &[Vec<T>], descending: &[usize]) -> Ordering {
        let last = rows.len();
        let coefficient = |&raised: &usize| {
            let row = |(i, row): (usize, &Vec<T>)| {
                let column = i8::from(i == raised) - i8::from(last == raised);
                row.iter().cloned().chain([T::from(column)]).collect()
            };
            determinant(&rows.iter().enumerate().map(row).collect::<Vec<_>>()).compare_zero()
        };
        let mut coefficients = descending.iter().map(coefficient);
        coefficients.find(|&sign| sign != Ordering::Equal).expect("no tie survives")
    }
    let sign = exact_sign(points, tally);
    if sign != Ordering::Equal {
        return sign == Ordering::Greater;
    }
    let mut order: [usize; N] = from_fn(|i| i);
    order.sort_by(|&i, &j| ids[j].cmp(&ids[i]));
    let sign = match differences(points, D as u32) {
        Differences::Small(rows) => leading(&rows, &order),
        Differences::Big(rows) => leading(&rows, &order),
    };
    sign == if D == 3 { Ordering::Less } else { Ordering::Greater }
}

/// Compares the distances of the last point from the first two.
pub fn exact_distance_order<const D: usize>(points: &[[f64; D]; 3], tally: &mut Tally) -> Ordering {
    fn order<T: Integer>(mut rows: Vec<Vec<T>>, axis: usize) -> Ordering {
        lift(&mut rows);
        rows[0][axis].minus(&rows[1][axis]).compare_zero()
    }
    let (order, is_big) = match differences(points, 2) {
        Differences::Small(rows) => (order(rows, D), false),
        Differences::Big(rows) => (order(rows, D), true),
    };
    tally.count(is_big, order == Ordering::Equal);
    order
}

/// Compares the square of the distance of two points with a number that is not negative.
pub fn exact_order_to_square<const D: usize>(
    points: &[[f64; D]; 2],
    squared: f64,
    tally: &mut Tally,
) -> Ordering {
    let (unit, _) = common_unit(points);
    let square: BigInt = big_differences(points)[0].iter().map(|x| x * x).sum();
    let order = if squared == f64::INFINITY {
        Ordering::Less
    } else {
        let (mantissa, exponent) = decode(squared);
        // In the unit of either, whichever is less.
        let shift = 2 * unit - exponent;
        (square << shift.max(0)).cmp(&(BigInt::from(mantissa) << (-shift).max(0)))
    };
    tally.count(true, order == Ordering::Equal);
    order
}

/// Whether the points are on a line.
pub fn is_exactly_collinear(points: &[[f64; 3]; 3], tally: &mut Tally) -> bool {
    fn is_collinear<T: Integer>(rows: &[Vec<T>]) -> bool {
        [(0, 1), (1, 2), (2, 0)].into_iter().all(|(x, y)| {
            let minor = rows[0][x].times(&rows[1][y]).minus(&rows[0][y].times(&rows[1][x]));
            minor.compare_zero() == Ordering::Equal
        })
    }
    let (is_collinear, is_big) = match differences(points, 2) {
        Differences::Small(rows) => (is_collinear(&rows), false),
        Differences::Big(rows) => (is_collinear(&rows), true),
    };
    tally.count(is_big, is_collinear);
    is_collinear
}

/// The error of a rounded determinant over what its bound allows: the bound, and the last rounding.
pub fn error_ratio<const D: usize, const N: usize>(points: &[[f64; D]; N], rounded: f64, bound: f64) -> f64 {
    // Every product of up to five coordinates is a multiple of 2 to the minus this.
    const UNIT: i32 = 5 * 1074;
    let is_lifted = N == D + 2;
    let mut rows = big_differences(points);
    if is_lifted {
        lift(&mut rows);
    }
    let exact = determinant(&rows) * if D == 3 { -1 } else { 1 };
    let degree = if is_lifted { D + 2 } else { D } as i32;
    let exact = exact << (common_unit(points).0 * degree + UNIT);
    let units = |x: f64| {
        let (mantissa, exponent) = decode(x);
        if mantissa == 0 { BigInt::ZERO } else { BigInt::from(mantissa) << (exponent + UNIT) }
    };
    let error: BigInt = units(rounded) - exact;
    let error = BigInt::from(error.magnitude().clone());
    // Half of a last bit more, which subnormal numbers do not need: their last sum is exact.
    let allowed = units(bound) + (units(rounded.abs()) >> 53);
    assert!(error <= allowed, "{points:?}: {rounded} is beyond {bound}");
    if allowed == BigInt::ZERO { 0.0 } else { ratio(&error, &allowed) }
}

fn ratio(a: &BigInt, b: &BigInt) -> f64 {
    let shift = b.bits().saturating_sub(60);
    let small = |x: &BigInt| i128::try_from(x >> shift).unwrap() as f64;
    small(a) / small(b)
}

/// The box of the points, by corners.
pub fn bounding_box<const D: usize>(points: &[[f64; D]]) -> [[f64; D]; 2] {
    let corner =
        |pick: fn(f64, f64) -> f64| from_fn(|axis| points.iter().map(|p| p[axis]).reduce(pick).unwrap());
    [corner(f64::min), corner(f64::max)]
}
