//! The oracle: what cells have in common, in exact rational numbers, and what follows for means.

use num_bigint::{BigInt, Sign};
use std::ops::{Add, Mul, Neg, Sub};

/// A rational number, not in lowest terms: the denominator is a power of two times what divisions have left.
#[derive(Clone, Debug)]
pub struct Ratio {
    over: BigInt,
    under: BigInt,
}

fn common_divisor(mut a: BigInt, mut b: BigInt) -> BigInt {
    while b.sign() != Sign::NoSign {
        let rest = &a % &b;
        (a, b) = (b, rest);
    }
    a
}

impl Ratio {
    fn new(over: BigInt, under: BigInt) -> Self {
        let mut divisor = common_divisor(over.clone(), under.clone());
        if (divisor.sign() == Sign::Minus) != (under.sign() == Sign::Minus) {
            divisor = -divisor;
        }
        Ratio { over: over / &divisor, under: under / divisor }
    }

    pub fn of(x: f64) -> Self {
        if x == 0.0 {
            return Ratio { over: BigInt::ZERO, under: BigInt::from(1) };
        }
        let (bits, exponent) = (x.to_bits(), (x.to_bits() >> 52 & 0x7ff) as i32);
        let digits = BigInt::from(bits & ((1 << 52) - 1) | u64::from(exponent > 0) << 52);
        let digits = if x < 0.0 { -digits } else { digits };
        let exponent = exponent.max(1) - 1075;
        let power = BigInt::from(1) << exponent.unsigned_abs();
        if exponent < 0 { Ratio::new(digits, power) } else { Ratio::new(digits * power, BigInt::from(1)) }
    }

    pub fn sign(&self) -> i32 {
        match self.over.sign() {
            Sign::Minus => -1,
            Sign::NoSign => 0,
            Sign::Plus => 1,
        }
    }

    fn over(&self, other: &Ratio) -> Ratio {
        Ratio::new(&self.over * &other.under, &self.under * &other.over)
    }

    /// The nearest number, or one beside it.
    pub fn value(&self) -> f64 {
        let digits = |x: &BigInt| x.bits() as i64;
        let shift = 64 - (digits(&self.over) - digits(&self.under));
        let scaled = if shift >= 0 { &self.over << shift } else { &self.over >> -shift };
        let quotient: f64 = i128::try_from(scaled / &self.under).expect("65 bits") as f64;
        quotient * 2f64.powi(-shift as i32)
    }
}

impl Add for &Ratio {
    type Output = Ratio;
    fn add(self, other: &Ratio) -> Ratio {
        Ratio::new(&self.over * &other.under + &other.over * &self.under, &self.under * &other.under)
    }
}

impl Sub for &Ratio {
    type Output = Ratio;
    fn sub(self, other: &Ratio) -> Ratio {
        self + &-other
    }
}

impl Mul for &Ratio {
    type Output = Ratio;
    fn mul(self, other: &Ratio) -> Ratio {
        Ratio::new(&self.over * &other.over, &self.under * &other.under)
    }
}

impl Neg for &Ratio {
    type Output = Ratio;
    fn neg(self) -> Ratio {
        Ratio { over: -&self.over, under: self.under.clone() }
    }
}

type Place = Vec<Ratio>;

fn determinant(rows: &[Vec<Ratio>]) -> Ratio {
    if rows.len() == 1 {
        return rows[0][0].clone();
    }
    let mut sum = Ratio::of(0.0);
    for i in 0..rows.len() {
        let rest: Vec<Vec<Ratio>> =
            rows.iter().enumerate().filter(|(k, _)| *k != i).map(|(_, row)| row[1..].to_vec()).collect();
        let term = &rows[i][0] * &determinant(&rest);
        sum = if i % 2 == 0 { &sum + &term } else { &sum - &term };
    }
    sum
}

/// Twice the area, or six times the volume, with its sign.
pub fn volume(corners: &[Place]) -> Ratio {
    let rows: Vec<Vec<Ratio>> =
        corners[1..].iter().map(|p| p.iter().zip(&corners[0]).map(|(x, y)| x - y).collect()).collect();
    determinant(&rows)
}

pub fn place(coordinates: &[f64]) -> Place {
    coordinates.iter().map(|&x| Ratio::of(x)).collect()
}

fn may_meet(one: &[Place], other: &[Place]) -> bool {
    let extent = |corners: &[Place], axis: usize| {
        let (mut low, mut high) = (corners[0][axis].clone(), corners[0][axis].clone());
        for p in corners {
            if (&p[axis] - &low).sign() < 0 {
                low = p[axis].clone();
            }
            if (&p[axis] - &high).sign() > 0 {
                high = p[axis].clone();
            }
        }
        (low, high)
    };
    (0..one[0].len()).all(|axis| {
        let ((a, b), (c, d)) = (extent(one, axis), extent(other, axis));
        (&b - &c).sign() > 0 && (&d - &a).sign() > 0
    })
}

/// The volume, as above, of what two cells have in common, with the sign of the second one.
pub fn common(one: &[Place], other: &[Place]) -> Ratio {
    let mut sum = Ratio::of(0.0);
    let sign = volume(other).sign();
    if sign == 0 || !may_meet(one, other) {
        return sum;
    }
    let mut left = vec![one.to_vec()];
    for k in 0..other.len() {
        let height = |p: &Place| {
            let mut with = other.to_vec();
            with[k] = p.clone();
            let height = volume(&with);
            if sign < 0 { -&height } else { height }
        };
        let mut kept = Vec::new();
        while let Some(corners) = left.pop() {
            let heights: Vec<Ratio> = corners.iter().map(height).collect();
            let Some(above) = heights.iter().position(|h| h.sign() > 0) else { continue };
            let Some(below) = heights.iter().position(|h| h.sign() < 0) else {
                kept.push(corners);
                continue;
            };
            let part = heights[above].over(&(&heights[above] - &heights[below]));
            let (a, b) = (&corners[above], &corners[below]);
            let between: Place = a.iter().zip(b).map(|(x, y)| x + &(&part * &(y - x))).collect();
            for replaced in [above, below] {
                let mut piece = corners.clone();
                piece[replaced] = between.clone();
                left.push(piece);
            }
        }
        left = kept;
    }
    for piece in &left {
        let of_piece = volume(piece);
        let is_negative = (of_piece.sign() < 0) != (sign < 0);
        sum = if is_negative { &sum - &of_piece } else { &sum + &of_piece };
    }
    if sign < 0 && sum.sign() > 0 || sign > 0 && sum.sign() < 0 { -&sum } else { sum }
}
