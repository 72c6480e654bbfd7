//! Voronoi cells in a box in exact rationals: slow, small, and independent of the library.
//!
//! A cell is a box, in the plane one of unit height, cut by the bisector of its vertex and each other one, where both
//! have one power. Corners have
//! homogeneous coordinates, which are integers; each new face is the convex hull of the places where the cut passes.

use crate::exact_oracle::decode;
use num_bigint::{BigInt, Sign};
use std::cmp::Ordering;

/// Coordinates and what they are to be divided by, which is positive; of a plane the coefficients, those of places
/// behind it being negative.
type Homogeneous = [BigInt; 4];

/// A face of a cell.
pub struct ExactFace {
    /// The vertex beyond, or none on the box.
    pub other: Option<usize>,
    corners: Vec<Homogeneous>,
    plane: Homogeneous,
}

/// A cell, in units of a power of two.
pub struct ExactCell {
    pub faces: Vec<ExactFace>,
    unit: i32,
}

fn zero() -> BigInt {
    BigInt::ZERO
}

fn compare_zero(x: &BigInt) -> Ordering {
    match x.sign() {
        Sign::Minus => Ordering::Less,
        Sign::NoSign => Ordering::Equal,
        Sign::Plus => Ordering::Greater,
    }
}

fn value(plane: &Homogeneous, p: &Homogeneous) -> BigInt {
    (0..4).map(|k| &plane[k] * &p[k]).sum()
}

fn greatest_divisor(mut a: BigInt, mut b: BigInt) -> BigInt {
    while b != zero() {
        (a, b) = (b.clone(), a % b);
    }
    BigInt::from(a.magnitude().clone())
}

fn reduced(p: Homogeneous) -> Homogeneous {
    let divisor = p.iter().fold(zero(), |divisor, x| greatest_divisor(divisor, x.clone()));
    p.map(|x| x / &divisor)
}

/// a / b · 2^exponent, rounded.
fn rounded(a: &BigInt, b: &BigInt, exponent: i32) -> f64 {
    if *a == zero() {
        return 0.0;
    }
    let shift = 80 + b.bits() as i32 - a.bits() as i32;
    let quotient = if shift >= 0 { (a << shift) / b } else { a / (b << -shift) };
    let mut x = i128::try_from(quotient).expect("80 bits") as f64;
    let mut left = exponent - shift;
    while left != 0 && x != 0.0 && x.is_finite() {
        let step = left.clamp(-1000, 1000);
        x *= 2f64.powi(step);
        left -= step;
    }
    x
}

/// The convex hull of places in a plane, counter-clockwise around its normal.
fn hull(mut places: Vec<Homogeneous>, plane: &Homogeneous) -> Vec<Homogeneous> {
    let dropped = dropped_axis(plane);
    let (j, k) = ((dropped + 1) % 3, (dropped + 2) % 3);
    let compare = |p: &Homogeneous, q: &Homogeneous, axis: usize| (&p[axis] * &q[3]).cmp(&(&q[axis] * &p[3]));
    places.sort_by(|p, q| compare(p, q, j).then_with(|| compare(p, q, k)));
    places.dedup();
    let turn = |p: &Homogeneous, q: &Homogeneous, r: &Homogeneous| {
        let minor = |p: &Homogeneous, q: &Homogeneous| &p[j] * &q[k] - &p[k] * &q[j];
        compare_zero(&(minor(q, r) * &p[3] - minor(p, r) * &q[3] + minor(p, q) * &r[3]))
    };
    let half = |places: &mut dyn Iterator<Item = &Homogeneous>| {
        let mut chain: Vec<Homogeneous> = Vec::new();
        for p in places {
            while let [.., a, b] = &chain[..]
                && turn(a, b, p) != Ordering::Greater
            {
                chain.pop();
            }
            chain.push(p.clone());
        }
        chain.pop();
        chain
    };
    if places.len() < 3 {
        return places;
    }
    let mut corners = half(&mut places.iter());
    corners.extend(half(&mut places.iter().rev()));
    if plane[dropped].sign() == Sign::Minus {
        corners.reverse();
    }
    corners
}

/// An axis along which the normal of a plane has its greatest coordinate.
fn dropped_axis(plane: &Homogeneous) -> usize {
    (0..3).max_by_key(|&axis| plane[axis].magnitude().clone()).expect("an axis")
}

/// The cell of one of some places, in a box.
pub fn exact_cell<const D: usize>(places: &[[f64; D]], of: usize, clip: [&[f64; D]; 2]) -> ExactCell {
    exact_power_cell(places, &vec![0.0; places.len()], of, clip)
}

/// The power cell of one of some places with weights, in a box.
pub fn exact_power_cell<const D: usize>(
    places: &[[f64; D]],
    weights: &[f64],
    of: usize,
    [low, high]: [&[f64; D]; 2],
) -> ExactCell {
    let all = || places.iter().chain([low, high]).flatten();
    let exponent = |x: &f64| Some(decode(*x)).filter(|x| x.0 != 0).map(|x| x.1);
    let of_weights = weights.iter().filter_map(exponent).map(|exponent| exponent.div_euclid(2));
    let unit = all().filter_map(exponent).chain(of_weights).min().unwrap_or(0).min(0);
    let weight = |k: usize| {
        let (mantissa, exponent) = decode(weights[k]);
        if mantissa == 0 { zero() } else { BigInt::from(mantissa) << (exponent - 2 * unit) }
    };
    let integer = |x: f64| {
        let (mantissa, exponent) = decode(x);
        if mantissa == 0 { zero() } else { BigInt::from(mantissa) << (exponent - unit) }
    };
    let in_space = |p: &[f64; D]| -> [BigInt; 3] {
        std::array::from_fn(|axis| if axis < D { integer(p[axis]) } else { zero() })
    };
    let (low, mut high) = (in_space(low), in_space(high));
    if D == 2 {
        high[2] = integer(1.0);
    }
    let corner = |k: usize| -> Homogeneous {
        std::array::from_fn(|axis| match axis {
            3 => BigInt::from(1),
            _ if k >> axis & 1 == 1 => high[axis].clone(),
            _ => low[axis].clone(),
        })
    };
    let mut faces = Vec::new();
    for k in 0..6 {
        let (axis, is_high) = (k / 2, k % 2 == 1);
        let mut plane = [zero(), zero(), zero(), if is_high { -&high[axis] } else { low[axis].clone() }];
        plane[axis] = BigInt::from(if is_high { 1 } else { -1 });
        let on = (0..8).filter(|corner| (corner >> axis & 1 == 1) == is_high).map(corner).collect();
        faces.push(ExactFace { other: None, corners: hull(on, &plane), plane });
    }
    let mut cell = ExactCell { faces, unit };
    let at = in_space(&places[of]);
    for (other, place) in places.iter().enumerate() {
        let to = in_space(place);
        if to != at {
            let square = |p: &[BigInt; 3]| p.iter().map(|x| x * x).sum::<BigInt>();
            let difference = |axis: usize| (&to[axis] - &at[axis]) * 2;
            let offset = square(&at) - square(&to) + weight(other) - weight(of);
            cell.cut([difference(0), difference(1), difference(2), offset], other);
        } else if weight(other) > weight(of) || other < of && weight(other) == weight(of) {
            cell.faces.clear();
        }
    }
    cell
}

impl ExactFace {
    /// Whether it is parallel to the last axis.
    pub fn is_upright(&self) -> bool {
        self.plane[2] == zero()
    }
}

impl ExactCell {
    fn cut(&mut self, plane: Homogeneous, other: usize) {
        let side = |p: &Homogeneous| compare_zero(&value(&plane, p));
        if !self.faces.iter().flat_map(|face| &face.corners).any(|p| side(p) == Ordering::Greater) {
            return;
        }
        let mut section = Vec::new();
        for face in &mut self.faces {
            let mut kept = Vec::new();
            for (k, p) in face.corners.iter().enumerate() {
                let q = &face.corners[(k + 1) % face.corners.len()];
                if side(p) != Ordering::Greater {
                    kept.push(p.clone());
                }
                if side(p) == Ordering::Equal {
                    section.push(p.clone());
                }
                if side(p).is_gt() && side(q).is_lt() || side(p).is_lt() && side(q).is_gt() {
                    let (a, b) = (value(&plane, p), value(&plane, q));
                    let mut x: Homogeneous = std::array::from_fn(|k| &p[k] * &b - &q[k] * &a);
                    if x[3].sign() == Sign::Minus {
                        x = x.map(|x| -x);
                    }
                    let x = reduced(x);
                    kept.push(x.clone());
                    section.push(x);
                }
            }
            face.corners = kept;
        }
        self.faces.retain(|face| face.corners.len() > 2);
        let corners = hull(section, &plane);
        if corners.len() > 2 {
            self.faces.push(ExactFace { other: Some(other), corners, plane });
        }
    }

    /// Cuts off what is beyond a half-space, given by a normal and an offset, as if there was another vertex.
    pub fn cut_by<const D: usize>(&mut self, row: &[f64], other: usize) {
        assert_eq!(row.len(), D + 1);
        let parts: Vec<_> = row.iter().map(|&x| decode(x)).collect();
        // A coordinate is a number of units.
        let exponent = |k: usize| parts[k].1 + if k < D { self.unit } else { 0 };
        let least = (0..=D).filter(|&k| parts[k].0 != 0).map(exponent).min().expect("a normal");
        let integer = |k: usize| {
            if parts[k].0 == 0 { zero() } else { BigInt::from(parts[k].0) << (exponent(k) - least) }
        };
        let mut plane = [zero(), zero(), zero(), -integer(D)];
        (0..D).for_each(|axis| plane[axis] = integer(axis));
        self.cut(plane, other);
        // What is left in the plane alone has no inside.
        if self.faces.len() < 4 {
            self.faces.clear();
        }
    }

    /// Its volume, or, in the plane, its area.
    pub fn volume(&self, dimension: i32) -> f64 {
        let Some(apex) = self.faces.first().map(|face| &face.corners[0]) else { return 0.0 };
        let pyramid = |face: &ExactFace| {
            let dropped = dropped_axis(&face.plane);
            let height = rounded(&value(&face.plane, apex), &(&apex[3] * &face.plane[dropped]), self.unit);
            self.projected(face) * height.abs() / 3.0
        };
        let volume: f64 = self.faces.iter().map(pyramid).sum();
        debug_assert!(dimension == 2 || dimension == 3);
        volume
    }

    /// The area of a face seen along the axis that is dropped.
    fn projected(&self, face: &ExactFace) -> f64 {
        let dropped = dropped_axis(&face.plane);
        let (j, k) = ((dropped + 1) % 3, (dropped + 2) % 3);
        let minor = |p: &Homogeneous, q: &Homogeneous| &p[j] * &q[k] - &p[k] * &q[j];
        let first = &face.corners[0];
        let triangle = |pair: &[Homogeneous]| {
            let [p, q] = pair else { unreachable!("a pair") };
            let doubled = minor(p, q) * &first[3] - minor(first, q) * &p[3] + minor(first, p) * &q[3];
            rounded(&doubled, &(&first[3] * &p[3] * &q[3]), 2 * self.unit).abs()
        };
        0.5 * face.corners[1..].windows(2).map(triangle).sum::<f64>()
    }

    /// The area of a face; in the plane, the length of one that is upright.
    pub fn area(&self, face: &ExactFace) -> f64 {
        let dropped = dropped_axis(&face.plane);
        let square: BigInt = face.plane[..3].iter().map(|x| x * x).sum();
        let stretch = rounded(&square, &(&face.plane[dropped] * &face.plane[dropped]), 0).sqrt();
        self.projected(face) * stretch
    }

    /// The way from the first corner of the cell to a corner, rounded.
    fn way(&self, p: &Homogeneous) -> [f64; 3] {
        let from = &self.faces[0].corners[0];
        std::array::from_fn(|k| {
            rounded(&(&p[k] * &from[3] - &from[k] * &p[3]), &(&p[3] * &from[3]), self.unit)
        })
    }

    /// The place of the first corner, rounded.
    fn first(&self) -> [f64; 3] {
        let from = &self.faces[0].corners[0];
        std::array::from_fn(|k| rounded(&from[k], &from[3], self.unit))
    }

    /// Triangles that make up a face, as ways from the first corner of the cell.
    fn triangles(&self, face: &ExactFace) -> Vec<[[f64; 3]; 3]> {
        let ways: Vec<[f64; 3]> = face.corners.iter().map(|p| self.way(p)).collect();
        ways[1..].windows(2).map(|pair| [ways[0], pair[0], pair[1]]).collect()
    }

    /// The centroid, and the greatest distance of two corners; none if there is no cell.
    pub fn centroid_and_diameter(&self) -> Option<([f64; 3], f64)> {
        self.faces.first()?;
        let first = self.first();
        let (mut volume, mut moment, mut ways) = (0.0, [0.0; 3], Vec::new());
        for [p, q, r] in self.faces.iter().flat_map(|face| self.triangles(face)) {
            let weight = dot(&p, &cross(&q, &r)).abs() + f64::MIN_POSITIVE;
            volume += weight;
            (0..3).for_each(|k| moment[k] += 0.25 * weight * (p[k] + q[k] + r[k]));
            ways.extend([p, q, r]);
        }
        Some(([0, 1, 2].map(|k| first[k] + moment[k] / volume), diameter(&ways)))
    }

    /// The centroid of a face, and the greatest distance of two of its corners.
    pub fn face_centroid_and_diameter(&self, face: &ExactFace) -> ([f64; 3], f64) {
        let first = self.first();
        let (triangles, mut area, mut moment) = (self.triangles(face), 0.0, [0.0; 3]);
        let ways: Vec<[f64; 3]> = triangles.iter().flatten().copied().collect();
        let diameter = diameter(&ways).max(f64::MIN_POSITIVE);
        for [p, q, r] in triangles {
            // Products of ways themselves may be below the least number.
            let [u, v] = [&q, &r].map(|q| minus(q, &p).map(|x| x / diameter));
            let normal = cross(&u, &v);
            let weight = dot(&normal, &normal).sqrt() + f64::MIN_POSITIVE;
            area += weight;
            (0..3).for_each(|k| moment[k] += weight * ((p[k] + q[k] + r[k]) / 3.0));
        }
        ([0, 1, 2].map(|k| first[k] + moment[k] / area), diameter)
    }

    /// The perimeter of a face.
    pub fn perimeter(&self, face: &ExactFace) -> f64 {
        let n = face.corners.len();
        let side = |k: usize| {
            let (p, q) = (&face.corners[k], &face.corners[(k + 1) % n]);
            let along = |axis: usize| {
                rounded(&(&q[axis] * &p[3] - &p[axis] * &q[3]), &(&p[3] * &q[3]), self.unit).powi(2)
            };
            (0..3).map(along).sum::<f64>().sqrt()
        };
        (0..n).map(side).sum()
    }
}

fn minus(p: &[f64; 3], q: &[f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| p[k] - q[k])
}

fn dot(p: &[f64; 3], q: &[f64; 3]) -> f64 {
    (0..3).map(|k| p[k] * q[k]).sum()
}

fn cross(p: &[f64; 3], q: &[f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3])
}

fn diameter(places: &[[f64; 3]]) -> f64 {
    let length = |d: [f64; 3]| d[0].hypot(d[1]).hypot(d[2]);
    places.iter().flat_map(|p| places.iter().map(|q| length(minus(p, q)))).fold(0.0, f64::max)
}
