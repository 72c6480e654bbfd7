//! Tests of the integer stages on ties and near ties of every length of differences, by long integers.

use std::cmp::Ordering;

use super::dyadic::product;
use super::filter::{
    extents, incircle_bound, insphere_bound, insphere_bound_of_terms, is_certain, largest, orient3d_bound,
};
use super::integer::{LongScaled, Scaled};
use super::plane::{incircle_rounded, incircle_sign, own_incircle_bound};
use super::space::{insphere_magnitudes, insphere_rounded, insphere_sign, orient3d_sign, volume};
use super::vectors::minus;
use super::{
    MAX_MAGNITUDE, OwnBounds2d, OwnBounds3d, PlanePoint, SpacePoint, big, circle, edge_length,
    half_space_by_length, side_bound_by_length, sphere,
};
use crate::random::Rng;

/// Numbers of up to 53 bits with exponents up to `spread` apart, at any place of the range.
fn numbers<const D: usize>(rng: &mut Rng, n_bits: u32, spread: i64) -> [f64; D] {
    let exponent = rng.within(-180, 130 - spread);
    std::array::from_fn(|_| {
        let mantissa = rng.next() >> (64 - n_bits);
        mantissa as f64 * 2f64.powi((exponent + rng.within(0, spread)) as i32)
    })
}

/// Images of a point under changes of signs and permutations of axes, which are all on one sphere about the origin.
fn images<const D: usize, const N: usize>(rng: &mut Rng, p: [f64; D]) -> [[f64; D]; N] {
    std::array::from_fn(|_| image(rng, p))
}

fn image<const D: usize>(rng: &mut Rng, mut p: [f64; D]) -> [f64; D] {
    rng.shuffle(&mut p);
    p.map(|x| if rng.one_in(2) { x } else { -x })
}

/// Images of a point; now and then one of them is moved by a last bit.
fn near_tie<const D: usize, const N: usize>(rng: &mut Rng) -> [[f64; D]; N] {
    if rng.one_in(3) {
        return near_sphere(rng);
    }
    let n_bits = *rng.pick(&[2, 5, 10, 19, 20, 21, 25, 31, 32, 33, 40, 50, 52, 53]);
    let spread = *rng.pick(&[0, 0, 0, 2, 5, 8, 20, 30, 31, 32, 33, 40, 50, 56, 60, 80]);
    let p = numbers::<D>(rng, n_bits, spread);
    let mut points = images(rng, p);
    if rng.one_in(2) {
        let x = &mut points[rng.below(N)][rng.below(D)];
        *x = if rng.one_in(2) { x.next_up() } else { x.next_down() };
    }
    points
}

/// Integers on a sphere, and one that is next to it: with squares of the distances from the origin that differ by a
/// small k, the determinant is k times a volume, and as large as it can be where it is still uncertain.
///
/// From (x, y) to (x − s, y + 1) the square grows by s² − 2 s x + 2 y + 1, which is k for y = s x + (k − s² − 1) / 2.
fn near_sphere<const D: usize, const N: usize>(rng: &mut Rng) -> [[f64; D]; N] {
    let n_bits = rng.within(8, 47) as u32;
    let (x, z) = ((rng.next() >> (64 - n_bits)) as i64, (rng.next() >> (64 - n_bits)) as i64);
    let s = rng.within(1, 8);
    let k = 2 * rng.within(-200, 200) + s * s + 1;
    let y = s * x + (k - s * s - 1) / 2;
    let unit = 2f64.powi(rng.within(-100, 100) as i32);
    let on = [x, y, z].map(|x| x as f64 * unit);
    let beside = [x - s, y + 1, z].map(|x| x as f64 * unit);
    let of = |p: [f64; 3]| std::array::from_fn(|axis| p[axis]);
    let mut points = images(rng, of(on));
    points[rng.below(N)] = image(rng, of(beside));
    points
}

/// Which format takes the differences of points: its number of bits rounded up to the next limit.
fn length<const D: usize, const N: usize>(
    origin: &[f64; D],
    others: [&[f64; D]; N],
    extent: f64,
    limits: &[u32],
) -> usize {
    let n_bits = match Scaled::new(origin, others, extent) {
        Some(scaled) => scaled.n_bits,
        None => LongScaled::new(origin, others, extent).map_or(u32::MAX, |scaled| scaled.n_bits),
    };
    limits.iter().position(|&most| n_bits <= most).unwrap_or(limits.len())
}

fn sign(x: f64) -> Ordering {
    x.partial_cmp(&0.0).expect("a number")
}

const CASES: usize = 400_000;

/// Every format has been taken, and what is too long for all of them has been seen.
fn assert_all_taken(counts: &[usize]) {
    assert!(counts.iter().all(|&n| n > CASES / 1_000), "{counts:?}");
}

#[test]
fn near_ties_of_spheres_are_those_of_long_integers() {
    let rng = &mut Rng::new(1);
    let mut counts = [0; 6];
    for _ in 0..CASES {
        let points = near_tie::<3, 5>(rng);
        let [a, others @ ..] = points.each_ref();
        let extents = extents(points.each_ref());
        let det = insphere_rounded(points.each_ref());
        let by_terms = insphere_bound_of_terms(insphere_magnitudes(points.each_ref()), extents);
        let bound = insphere_bound(extents).min(by_terms);
        if is_certain(det, bound, extents) {
            continue;
        }
        counts[length(a, others, largest(extents), &[21, 33, 59, 85, 110])] += 1;
        if let Some(found) = insphere_sign(points.each_ref(), largest(extents), bound) {
            assert_eq!(found, sign(big::insphere(1.0, points.each_ref())), "{points:?}");
        }
    }
    assert_all_taken(&counts);
}

/// Corners of a small lattice at any scale, narrower along some axes, with noise of any size: many differences are
/// nearly zero.
fn noisy_lattice(rng: &mut Rng) -> [[f64; 3]; 5] {
    let unit = 2f64.powi(rng.within(-150, 150) as i32);
    let noise = unit * 2f64.powi(-rng.within(30, 60) as i32);
    let (size, offset) = (rng.within(1, 3), rng.within(0, 30));
    let spacings: [f64; 3] = std::array::from_fn(|_| {
        if rng.one_in(2) { unit } else { unit * rng.unit() * 2f64.powi(-rng.within(0, 40) as i32) }
    });
    std::array::from_fn(|_| {
        spacings.map(|spacing| {
            let noise = noise * rng.unit() * rng.within(0, 1) as f64;
            (offset + rng.within(0, size)) as f64 * spacing + if rng.one_in(3) { noise } else { 0.0 }
        })
    })
}

/// What the bound of the points or that of the terms calls certain has the sign of long integers, and so has what is
/// left to integers as long as the sharper bound allows.
#[test]
fn stages_after_the_static_bound_of_spheres_are_exact() {
    let rng = &mut Rng::new(4);
    let (mut n_sides, mut n_own, mut n_by_lengths, mut n_half_spaces, mut n_volumes) = (0, 0, 0, 0, 0);
    let (mut n_by_terms, mut n_open) = (0, 0);
    let mut n_long = [0; 4];
    for k in 0..1_200_000 {
        let points = if k % 3 == 0 { near_tie::<3, 5>(rng) } else { noisy_lattice(rng) };
        let refs @ [a, b, c, d, q] = points.each_ref();
        let (extents, det) = (extents(refs), insphere_rounded(refs));
        let expected = sign(big::insphere(1.0, refs));
        let side = <[f64; 3]>::side(&sphere(a, b, c, d), a, q);
        if SpacePoint::is_side_certain(side, refs) {
            assert_eq!(sign(side), expected, "{points:?}");
            n_sides += 1;
        }
        let own = OwnBounds3d::new(a, b, c, d);
        if side.abs() > own.side(a, q) {
            assert_eq!(sign(side), expected, "{points:?}");
            n_own += 1;
        }
        let volume = sphere(a, b, c, d)[3];
        if volume.abs() > own.volume() {
            assert_eq!(sign(volume), sign(big::orient3d(1.0, [a, b, c, d])), "{points:?}");
            n_volumes += 1;
        }
        if side.abs() > side_bound_by_length(edge_length(a, b, c, d) as f32, a, q) {
            assert_eq!(sign(side), expected, "{points:?}");
            n_by_lengths += 1;
        }
        let (half_space, length) = half_space_by_length(a, b, c);
        let side = <[f64; 3]>::side(&half_space, a, q);
        if side.abs() > side_bound_by_length(length, a, q) {
            assert_eq!(sign(side), sign(big::orient3d(1.0, [a, b, c, q])), "{points:?}");
            n_half_spaces += 1;
        }
        let bound = insphere_bound(extents);
        if is_certain(det, bound, extents) {
            continue;
        }
        let bound = bound.min(insphere_bound_of_terms(insphere_magnitudes(refs), extents));
        if det.abs() > bound {
            assert_eq!(sign(det), expected, "{points:?}");
            n_by_terms += 1;
        } else if let Some(found) = insphere_sign(refs, largest(extents), bound) {
            assert_eq!(found, expected, "{points:?}");
            n_open += 1;
            if let Some(scaled) = LongScaled::new(a, [b, c, d, q], largest(extents)) {
                let n_bits = scaled.n_bits_within(bound, largest(extents));
                let format = [256, 320, 384].iter().position(|&most| n_bits <= most).unwrap_or(3);
                n_long[format] += u32::from(scaled.n_bits > 59);
            }
        }
    }
    println!(
        "{n_sides} sides, {n_own} by own bounds, {n_by_lengths} by lengths, {n_half_spaces} half-spaces, {n_volumes} volumes, \
         {n_by_terms} by terms, {n_open} open, {n_long:?} long"
    );
    assert!(n_volumes > 100_000 && n_own > 50_000);
    assert!(
        n_sides > 100_000
            && n_by_lengths > 50_000
            && n_half_spaces > 50_000
            && n_by_terms > 50_000
            && n_open > 100_000
    );
    assert!(n_long.iter().all(|&n| n > 1_000));
}

#[test]
fn near_ties_of_circles_are_those_of_long_integers() {
    let rng = &mut Rng::new(2);
    let mut counts = [0; 6];
    let (mut n_sides, mut n_areas) = (0, 0);
    for _ in 0..3 * CASES {
        let points = near_tie::<2, 4>(rng);
        let [a, others @ ..] = points.each_ref();
        let extents = extents(points.each_ref());
        let det = incircle_rounded(points.each_ref());
        let [b, c, q] = others;
        let (prepared, own) = (circle(a, b, c), OwnBounds2d::new(a, b, c));
        let side = <[f64; 2]>::side(&prepared, a, q);
        if side.abs() > own.side(a, q) {
            assert_eq!(sign(side), sign(big::incircle(1.0, points.each_ref())), "{points:?}");
            n_sides += 1;
        }
        if prepared[2].abs() > own.area() {
            assert_eq!(sign(prepared[2]), sign(big::orient2d(1.0, [a, b, c])), "{points:?}");
            n_areas += 1;
        }
        if is_certain(det, incircle_bound(extents), extents) {
            continue;
        }
        counts[length(a, others, largest(extents), &[27, 43, 59, 91, 110])] += 1;
        if let Some(found) = incircle_sign(points.each_ref(), largest(extents)) {
            assert_eq!(found, sign(big::incircle(1.0, points.each_ref())), "{points:?}");
        }
    }
    println!("{n_sides} sides, {n_areas} areas");
    assert!(n_sides > CASES / 20 && n_areas > CASES / 20);
    assert_all_taken(&counts);
}

/// Points of an arc of any length, but for rounding.
pub(super) fn on_arc(rng: &mut Rng) -> [[f64; 2]; 4] {
    let scale = 2f64.powi(rng.within(-260, 150) as i32);
    let (middle, half) = (7.0 * rng.unit(), 3.2 * 2f64.powi(-rng.within(0, 25) as i32));
    std::array::from_fn(|_| {
        let angle = middle + half * (2.0 * rng.unit() - 1.0);
        [scale * angle.cos(), scale * angle.sin()]
    })
}

/// The bound by running errors is what the analysis asks for, and what exceeds it has the right sign.
#[test]
fn running_errors_of_circles_are_bounded() {
    let rng = &mut Rng::new(6);
    let (mut n_certain, mut n_open) = (0, 0);
    for case in 0..CASES {
        let points = if case % 4 == 0 { near_tie::<2, 4>(rng) } else { on_arc(rng) };
        let refs @ [a, b, c, d] = points.each_ref();
        let (extents, det) = (extents(refs), incircle_rounded(refs));
        let bound = own_incircle_bound(refs, extents);
        if is_certain(det, incircle_bound(extents), extents) {
            continue;
        }
        if det.abs() > bound {
            assert_eq!(sign(det), sign(big::incircle(1.0, refs)), "{points:?}");
            n_certain += 1;
        } else {
            n_open += 1;
        }
        if case % 8 > 0 {
            continue;
        }
        let (u, v, w) = (minus::<f64, 2>(b, a), minus(c, a), minus(d, a));
        let exact = |x: f64| product([x]);
        let unit = exact(f64::EPSILON / 2.0);
        let running = |first: f64, second: f64| {
            let magnitude = exact((first + second).abs());
            let error = exact(3.0) * (exact(first.abs()) + exact(second.abs())) + magnitude.clone();
            (magnitude, unit.clone() * error)
        };
        let mut expected = exact(f64::MIN_POSITIVE) * exact(largest(extents).max(1.0).powi(2));
        for (p, q, from_b) in [(&w, &v, c), (&v, &w, d)] {
            let r = minus::<f64, 2>(from_b, b);
            let (c, of_c) = running(u[0] * p[1], -(u[1] * p[0]));
            let (d, of_d) = running(q[0] * r[0], q[1] * r[1]);
            let both = unit.clone() * c.clone() * d.clone();
            expected = expected + c * of_d.clone() + of_c * (d + of_d) + both;
        }
        assert!(exact(bound).is_close_to(&expected, 38), "{points:?}");
    }
    println!("{n_certain} certain, {n_open} open");
    assert!(n_certain > CASES / 10 && n_open > CASES / 10);
}

#[test]
fn near_ties_of_planes_are_those_of_long_integers() {
    let rng = &mut Rng::new(3);
    let mut counts = [0; 5];
    for _ in 0..CASES {
        // Images with one coordinate kept, now and then moved by a last bit; the sum of a plane's points is in it, too.
        let mut points = near_tie::<3, 4>(rng);
        let axis = rng.below(3);
        let height = points[0][axis];
        points.iter_mut().skip(1).filter(|_| !rng.one_in(30)).for_each(|p| p[axis] = height);
        if rng.one_in(2) {
            // A plane that is not parallel to any axis.
            points.iter_mut().for_each(|p| p[axis] = p[(axis + 1) % 3] + p[(axis + 2) % 3]);
        }
        if points.as_flattened().iter().any(|x| x.abs() > MAX_MAGNITUDE) {
            continue;
        }
        let [a, b, c, d] = points.each_ref();
        let extents = extents(points.each_ref());
        let det = volume(&minus(b, a), &minus(c, a), &minus(d, a));
        if is_certain(det, orient3d_bound(extents), extents) {
            continue;
        }
        counts[length(a, [b, c, d], largest(extents), &[36, 57, 59, 110])] += 1;
        if let Some(found) = orient3d_sign(points.each_ref(), largest(extents)) {
            assert_eq!(found, sign(big::orient3d(1.0, points.each_ref())), "{points:?}");
        }
    }
    assert_all_taken(&counts);
}
