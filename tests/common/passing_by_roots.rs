//! Whether a vertex passes a segment, decided in integers of any length by the roots of a polynomial, and without winding
//! numbers.

use num_bigint::BigInt;
use num_bigint::Sign::{self, Minus, NoSign, Plus};
use std::cmp::Ordering;

type Vector = [BigInt; 2];

/// Digits and exponent of a number.
fn decoded(x: f64) -> (i64, i32) {
    let (fraction, exponent) = ((x.to_bits() & ((1 << 52) - 1)) as i64, (x.to_bits() >> 52 & 2047) as i32);
    let digits = if exponent == 0 { fraction } else { fraction | 1 << 52 };
    (if x < 0.0 { -digits } else { digits }, exponent.max(1) - 1075)
}

/// Coordinates as integers in the largest unit of which all are multiples as numbers of 53 bits.
fn integers(step: &[[[f64; 2]; 2]; 3]) -> [[Vector; 2]; 3] {
    let all = step.as_flattened().as_flattened().iter().filter(|&&x| x != 0.0);
    let unit = all.map(|&x| decoded(x).1).min().unwrap_or(0);
    step.map(|path| {
        path.map(|place| {
            place.map(|x| {
                let (digits, exponent) = decoded(x);
                BigInt::from(digits) << if digits == 0 { 0 } else { (exponent - unit) as usize }
            })
        })
    })
}

fn difference(p: &Vector, q: &Vector) -> Vector {
    [&p[0] - &q[0], &p[1] - &q[1]]
}

fn cross(u: &Vector, v: &Vector) -> BigInt {
    &u[0] * &v[1] - &u[1] * &v[0]
}

fn dot(u: &Vector, v: &Vector) -> BigInt {
    &u[0] * &v[0] + &u[1] * &v[1]
}

fn is_zero(v: &Vector) -> bool {
    v.iter().all(|x| x.sign() == NoSign)
}

fn times(one: Sign, other: Sign) -> Sign {
    if one == NoSign || other == NoSign {
        NoSign
    } else if one == other {
        Plus
    } else {
        Minus
    }
}

/// The sign of u + v √d.
fn sign_with_root(u: &BigInt, v: &BigInt, d: &BigInt) -> Sign {
    let [of_u, of_v] = [u.sign(), times(v.sign(), d.sign())];
    if of_u == of_v || of_v == NoSign {
        return of_u;
    }
    match (u * u).cmp(&(v * v * d)) {
        Ordering::Greater => of_u,
        Ordering::Equal => NoSign,
        Ordering::Less => of_v,
    }
}

/// A polynomial of degree 2, the constant first, from products of what is linear in time.
fn product_of(
    [u0, u1]: [&Vector; 2],
    [v0, v1]: [&Vector; 2],
    product: fn(&Vector, &Vector) -> BigInt,
) -> [BigInt; 3] {
    let [du, dv] = [difference(u1, u0), difference(v1, v0)];
    [product(u0, v0), product(u0, &dv) + product(&du, v0), product(&du, &dv)]
}

/// Whether what goes straight from u to v is zero on the way.
fn goes_through_zero(u: &Vector, v: &Vector) -> bool {
    cross(u, v).sign() == NoSign && dot(u, v).sign() != Plus
}

/// Whether a vertex passes a segment in a step of vertex and ends, each before and after: by the times at which the vertex is on the line of the segment: roots of g = e × w for the differences e from a to
/// b and w from a to p. At each it is on the segment if w · e is above zero and below e · e.
pub fn passes_by_roots(step: &[[[f64; 2]; 2]; 3]) -> bool {
    let [p, a, b] = integers(step);
    let w = [0, 1].map(|k| difference(&p[k], &a[k]));
    let x = [0, 1].map(|k| difference(&p[k], &b[k]));
    let e = [0, 1].map(|k| difference(&b[k], &a[k]));
    if w.iter().chain(&x).any(is_zero) {
        return false;
    }
    let stops_on = (0..2).any(|k| goes_through_zero(&w[k], &x[k]));
    if stops_on || goes_through_zero(&w[0], &w[1]) || goes_through_zero(&x[0], &x[1]) {
        return true;
    }
    let [g, along, back] = [
        product_of(e.each_ref(), w.each_ref(), cross),
        product_of(w.each_ref(), e.each_ref(), dot),
        product_of(x.each_ref(), e.each_ref(), dot),
    ];
    let mut net = 0;
    let mut count = |at: &dyn Fn(&[BigInt; 3]) -> Sign, direction: Sign| {
        let time = [BigInt::from(0), BigInt::from(1), BigInt::from(0)];
        let rest = [BigInt::from(1), BigInt::from(-1), BigInt::from(0)];
        if at(&time) == Plus && at(&rest) == Plus && at(&along) == Plus && at(&back) == Minus {
            net += match direction {
                Plus => 1,
                Minus => -1,
                NoSign => 0,
            };
        }
    };
    if g[2].sign() == NoSign {
        if g[1].sign() != NoSign {
            // The root is -g0 / g1.
            let at = |f: &[BigInt; 3]| {
                (&f[0] * &g[1] * &g[1] - &f[1] * &g[0] * &g[1] + &f[2] * &g[0] * &g[0]).sign()
            };
            count(&at, g[1].sign());
        }
        return net != 0;
    }
    let four = BigInt::from(4);
    let d = &g[1] * &g[1] - &four * &g[2] * &g[0];
    if d.sign() == Plus {
        for root in [1, -1].map(BigInt::from) {
            // The root is (-g1 + root √d) / (2 g2), so with g t² = -g1 t - g0, f times 2 g2² is
            // 2 g2² f0 + (g2 f1 - g1 f2) (-g1 + root √d) - 2 g2 g0 f2.
            let at = |f: &[BigInt; 3]| {
                let slope = &g[2] * &f[1] - &g[1] * &f[2];
                let two = BigInt::from(2);
                let rest = &two * &g[2] * &g[2] * &f[0] - &two * &g[2] * &g[0] * &f[2] - &slope * &g[1];
                sign_with_root(&rest, &(slope * &root), &d)
            };
            // g' there is root √d.
            count(&at, root.sign());
        }
    }
    net != 0
}
