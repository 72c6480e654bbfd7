//! Sizes of cells, and exact comparisons of circumradii.

use super::super::exact_oracle::*;
use super::super::source::Source;
use super::super::tally;
use super::points::points;
use super::signs::exact;
use deldrift::internals::predicates::Measures;
use num_bigint::BigInt;
use std::cmp::Ordering::{Greater, Less};

pub fn in_plane(s: &mut Source) {
    check::<2, 3>(s, |rows| {
        let (u, v) = (&rows[0], &rows[1]);
        vec![&u[2] * &v[1] - &v[2] * &u[1], &v[2] * &u[0] - &u[2] * &v[0]]
    });
}

pub fn in_space(s: &mut Source) {
    check::<3, 4>(s, |rows| {
        let (u, v, w) = (&rows[0], &rows[1], &rows[2]);
        let minor = |p: &[BigInt], q: &[BigInt], k: usize| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            &p[i] * &q[j] - &p[j] * &q[i]
        };
        (0..3).map(|k| &u[3] * minor(v, w, k) - &v[3] * minor(u, w, k) + &w[3] * minor(u, v, k)).collect()
    });
}

/// An integer times a power of two.
fn shifted(n: BigInt, exponent: i32) -> BigInt {
    n << exponent
}

/// `vector` is that of the cell of which the rows are the edges from one corner, with their squares: twice the volume's
/// determinant times the way to the circumcentre.
fn check<const D: usize, const N: usize>(s: &mut Source, vector: impl Fn(&[Vec<BigInt>]) -> Vec<BigInt>)
where
    [f64; D]: Measures,
{
    let mut p: [[f64; D]; N] = points(s);
    match exact(&p) {
        Less => p.swap(0, 1),
        Greater => {}
        _ => return,
    }
    let cell: Vec<&[f64; D]> = p.iter().collect();
    let (centre, rounded) = <[f64; D]>::circumsphere(&cell);
    assert!(!rounded.is_nan() && centre.iter().all(|x| !x.is_nan()), "circumsphere {p:?}");
    let squared = if s.below(3) == 0 { s.magnitude().abs() } else { nudged(rounded, s.within(3)) };
    let volume = <[f64; D]>::volume(&cell);
    let mut rows = big_differences(&p);
    lift(&mut rows);
    let unit = common_unit(&p).0;
    let determinant = BigInt::from(
        determinant(&rows.iter().map(|row| row[..D].to_vec()).collect::<Vec<_>>()).magnitude().clone(),
    );
    tally::SIGNS.add(1);
    if squared.is_finite() {
        let (mantissa, exponent) = decode(squared);
        // |n|² against 4 V² r², in units of which the exponents are not negative.
        let n = vector(&rows).iter().map(|x| x * x).sum::<BigInt>();
        let (ours, theirs) = (2 * unit, exponent);
        let least = ours.min(theirs);
        let right = shifted(4 * &determinant * &determinant * BigInt::from(mantissa), theirs - least);
        let expected = shifted(n, ours - least) <= right;
        let found = <[f64; D]>::is_circumradius_within(&cell, squared);
        assert_eq!(found, expected, "is_circumradius_within {p:?} {squared:?}");
    }
    if volume > f64::MIN_POSITIVE {
        let (mantissa, exponent) = decode(volume);
        let parts = [2, 6][D - 2];
        let (ours, theirs) = (D as i32 * unit, exponent);
        let least = ours.min(theirs);
        let found = shifted(BigInt::from(mantissa) * parts, theirs - least);
        let exact = shifted(determinant, ours - least);
        let error: BigInt = &found - &exact;
        assert!(
            BigInt::from(error.magnitude().clone()) * 1_000_000_000i64 <= exact,
            "volume {p:?} {volume:?}"
        );
    } else {
        assert!(volume >= 0.0, "volume {p:?}");
    }
}
