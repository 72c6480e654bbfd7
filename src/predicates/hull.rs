//! Orientations at hull facets, several with one facet: for numbers in lanes, which have the bits of single ones.
//!
//! Results have the signs of [`orient2d`](super::orient2d) and [`orient3d`](super::orient3d), and each is open if its
//! magnitude is not above [`StaticFilter::orient`](super::StaticFilter): the bound holds for any of the points to take
//! differences from, and for any order of the columns. In space that is a sum of three products of a minor and a
//! difference, in the plane a minor.

use super::vectors::{cross, dot, minor, minus};
use crate::simd::Real;

/// The orientation of `a`, `b`, `c`.
#[inline(always)]
pub fn area<T: Real>(a: &[T; 2], b: &[T; 2], c: &[T; 2]) -> T {
    minor(&minus(b, a), &minus(c, a))
}

/// The orientations of a triangle with each of three points.
#[inline(always)]
pub fn volumes_over<T: Real>([a, b, c]: [&[T; 3]; 3], others: [[T; 3]; 3]) -> [T; 3] {
    let normal = cross(&minus(b, a), &minus(c, a));
    others.map(
        #[inline(always)]
        |d| dot(&minus(&d, a), &normal),
    )
}

/// The orientation of a segment with `o`, and then also with `aim` in place of each end.
#[inline(always)]
pub fn ray_and_segment<T: Real>([a, b]: [&[T; 2]; 2], o: &[T; 2], aim: &[T; 2]) -> [T; 3] {
    let (u, v, t) = (minus(a, o), minus(b, o), minus(aim, o));
    [minor(&u, &v), minor(&t, &v), minor(&u, &t)]
}

/// The orientation of a triangle with `o`, and then also with `aim` in place of each corner.
#[inline(always)]
pub fn ray_and_triangle<T: Real>([a, b, c]: [&[T; 3]; 3], o: &[T; 3], aim: &[T; 3]) -> [T; 4] {
    let (u, v, w, t) = (minus(a, o), minus(b, o), minus(c, o), minus(aim, o));
    let (wv, uw, vu) = (cross(&w, &v), cross(&u, &w), cross(&v, &u));
    [dot(&u, &wv), dot(&t, &wv), dot(&t, &uw), dot(&t, &vu)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predicates::{StaticFilter, orient2d, orient3d};
    use crate::random::Rng;

    /// Points of a small grid, of a large one, or off a plane by a rounding, so that many signs are zero or nearly so.
    fn point<const D: usize>(kind: usize, rng: &mut Rng) -> [f64; D] {
        let mut p = [0.0; D];
        p.iter_mut().for_each(|x| *x = (rng.unit() * 5.0).floor() - 2.0);
        if kind == 1 {
            p.iter_mut().for_each(|x| *x = *x * 0.1 + rng.unit());
        } else if kind == 2 {
            let k = rng.below(D);
            p[k] = (p[k] * 0.1).next_up();
        }
        p
    }

    /// Whether a sign that is above the bound is right; returns whether it is.
    fn is_certain(computed: f64, bound: f64, exact: f64) -> bool {
        let is_certain = computed.abs() > bound;
        assert!(!is_certain || computed.is_sign_positive() == (exact > 0.0) && exact != 0.0);
        is_certain
    }

    #[test]
    fn certain_signs_in_the_plane_are_right() {
        let rng = &mut Rng::new(1);
        let mut n_certain = 0;
        for round in 0..1_000_000 {
            let points: [[f64; 2]; 4] = std::array::from_fn(|_| point(round % 3, rng));
            let [a, b, o, aim] = points;
            let f = StaticFilter::plane([-3.0; 2], [3.0; 2]);
            let orient = |a, b, c| orient2d(&f, a, b, c);
            let exact = [orient(&a, &b, &o), orient(&aim, &b, &o), orient(&a, &aim, &o)];
            let signs = ray_and_segment([&a, &b], &o, &aim);
            n_certain += signs.iter().zip(exact).filter(|&(&s, e)| is_certain(s, f.orient, e)).count();
            n_certain += usize::from(is_certain(area(&a, &b, &o), f.orient, exact[0]));
        }
        assert!(n_certain > 1_000_000, "{n_certain}");
    }

    #[test]
    fn certain_signs_in_space_are_right() {
        let rng = &mut Rng::new(2);
        let mut n_certain = 0;
        for round in 0..1_000_000 {
            let points: [[f64; 3]; 5] = std::array::from_fn(|_| point(round % 3, rng));
            let [a, b, c, o, aim] = points;
            let f = StaticFilter::space([-3.0; 3], [3.0; 3]);
            let orient = |a, b, c, d| orient3d(&f, a, b, c, d);
            let with_o = [
                orient(&a, &b, &c, &o),
                orient(&aim, &b, &c, &o),
                orient(&a, &aim, &c, &o),
                orient(&a, &b, &aim, &o),
            ];
            let signs = ray_and_triangle([&a, &b, &c], &o, &aim);
            n_certain += signs.iter().zip(with_o).filter(|&(&s, e)| is_certain(s, f.orient, e)).count();
            let over = [orient(&a, &b, &c, &o), orient(&a, &b, &c, &aim), orient(&a, &b, &c, &a)];
            let signs = volumes_over([&a, &b, &c], [o, aim, a]);
            n_certain += signs.iter().zip(over).filter(|&(&s, e)| is_certain(s, f.orient, e)).count();
        }
        assert!(n_certain > 1_000_000, "{n_certain}");
    }
}
