//! Points on a lattice, whose determinants are computed without rounding.
//!
//! Where all coordinates are multiples of one power of two, and differences are few of these, every intermediate value
//! of a determinant is an integer of at most 53 bits in that unit to some power, so that every operation is exact. A
//! rounded determinant that is not zero has the right sign then, and zero is a tie: no later stage is needed.
//! Structured meshes begin like that, and a build of one would spend most of its time on ties otherwise.

use super::filter::{DIFFERENCE, MINOR, ROUND_UP, SQUARE, StaticFilter, box_extents, largest};

/// The largest extent, in units, of points on a lattice whose determinants are computed without rounding: all
/// intermediate values are integers of at most 53 bits. A power of two.
const fn lattice_extent(dimension: usize) -> f64 {
    if dimension == 2 { 4096.0 } else { 512.0 }
}

const _: () = {
    let lift = SQUARE.plus(SQUARE);
    let (circle, seen) = (lift.times(SQUARE.plus(SQUARE)), lift.times(MINOR));
    let magnitude_2d = (circle.magnitude + circle.magnitude + circle.magnitude)
        .max(seen.magnitude + seen.magnitude + seen.magnitude);
    let lift = lift.plus(SQUARE);
    let part = MINOR.times(DIFFERENCE);
    let volume = lift.times(part.plus(part).plus(part));
    let magnitude_3d = volume.magnitude * 4.0;
    let mantissa = (1_u64 << f64::MANTISSA_DIGITS) as f64;
    let (plane, space) = (lattice_extent(2), lattice_extent(3));
    assert!(magnitude_2d * ROUND_UP * plane * plane * plane * plane <= mantissa);
    assert!(magnitude_3d * ROUND_UP * space * space * space * space * space <= mantissa);
};

/// Bounds for points between `lower` and `upper` if these and all of them are multiples of one unit and so few apart
/// that determinants are computed without rounding; `None` if they are not. `bounds` gives those of a box.
///
/// Where points are in no such order, that is found out after a few of them.
pub fn exact_filter<'p, const D: usize>(
    bounds: fn([f64; D], [f64; D]) -> StaticFilter,
    lower: &'p [f64; D],
    upper: &'p [f64; D],
    points: impl Iterator<Item = &'p [f64; D]>,
) -> Option<StaticFilter> {
    let extent = largest(box_extents(lower, upper));
    // So that products of five neither underflow nor overflow.
    if !(1e-50..1e50).contains(&extent) {
        return None;
    }
    // The least power of two that is not below this fraction of the extent.
    let least = extent / lattice_extent(D);
    let floor = f64::from_bits(least.to_bits() & !((1 << (f64::MANTISSA_DIGITS - 1)) - 1));
    let unit = if floor < least { 2.0 * floor } else { floor };
    let is_multiple = |x: f64| {
        let scaled = x / unit;
        // What is far below the unit may become zero.
        scaled == scaled.trunc() && (scaled != 0.0 || x == 0.0)
    };
    let is_on_lattice = |p: &[f64; D]| p.iter().all(|&x| is_multiple(x));
    let mut points = [lower, upper].into_iter().chain(points);
    points.all(is_on_lattice).then(|| StaticFilter {
        // Every magnitude is above that, zero too.
        orient: -1.0,
        in_sphere: -1.0,
        prepared: 0.0,
        is_exact: true,
        ..bounds(*lower, *upper)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predicates::{
        SpacePoint, incircle, insphere, insphere_perturbed, is_inside_cospherical_on_lattice, orient2d,
        orient3d, sphere,
    };
    use crate::random::Rng;

    /// Integers up to 512 apart, at an offset, in units of any power of two; half of them near the ends.
    fn lattice_points<const D: usize, const N: usize>(
        rng: &mut Rng,
        most: i64,
    ) -> ([[i128; D]; N], [[f64; D]; N]) {
        let unit = 2f64.powi(rng.within(-150, 100) as i32);
        let offset = rng.within(-1 << 40, 1 << 40);
        let integers: [[i128; D]; N] = std::array::from_fn(|_| {
            std::array::from_fn(|_| {
                let any = [rng.within(0, most), most * rng.within(0, 1), rng.within(0, 4)];
                i128::from(*rng.pick(&any))
            })
        });
        let points = integers.map(|p| p.map(|x| (x + i128::from(offset)) as f64 * unit));
        (integers, points)
    }

    fn box_of<const D: usize>(points: &[[f64; D]]) -> [[f64; D]; 2] {
        [f64::min, f64::max]
            .map(|of| std::array::from_fn(|axis| points.iter().map(|p| p[axis]).reduce(of).expect("points")))
    }

    fn minor(p: &[i128], q: &[i128]) -> i128 {
        p[0] * q[1] - p[1] * q[0]
    }

    #[test]
    fn determinants_on_lattices_are_exact_in_space() {
        let rng = &mut Rng::new(1);
        let mut n_ties = 0;
        for _ in 0..1_000_000 {
            let (integers, points) = lattice_points::<3, 5>(rng, 512);
            let [lower, upper] = box_of(&points);
            if lower == upper {
                continue;
            }
            // The unit found may be finer than the lattice's: an extent is at most 512 of it.
            let f = exact_filter(StaticFilter::space, &lower, &upper, points.iter()).expect("a lattice");
            let [u, v, w, s] = [1, 2, 3, 4]
                .map(|k| -> [i128; 3] { std::array::from_fn(|axis| integers[k][axis] - integers[0][axis]) });
            let volume = |p: &[i128; 3], q: &[i128; 3], r: &[i128; 3]| {
                minor(q, r) * p[2] - minor(p, r) * q[2] + minor(p, q) * r[2]
            };
            let square = |p: &[i128; 3]| p.iter().map(|x| x * x).sum::<i128>();
            let det = square(&u) * volume(&v, &w, &s) - square(&v) * volume(&u, &w, &s)
                + square(&w) * volume(&u, &v, &s)
                - square(&s) * volume(&u, &v, &w);
            let [a, b, c, d, e] = points.each_ref();
            let sign = |x: f64| x.partial_cmp(&0.0).expect("a number");
            assert_eq!(sign(orient3d(&f, a, b, c, d)), volume(&u, &v, &w).cmp(&0));
            assert_eq!(sign(insphere(&f, a, b, c, d, e)), det.cmp(&0));
            if volume(&u, &v, &w) > 0 {
                assert_eq!(sign(<[f64; 3]>::side(&sphere(a, b, c, d), a, e)), det.cmp(&0));
            }
            n_ties += u32::from(det == 0);
        }
        assert!(n_ties > 10_000);
    }

    /// Ties of all kinds, those of four points in a plane too, come out without branches as they do with them.
    #[test]
    fn ties_on_lattices_are_decided_as_elsewhere() {
        let rng = &mut Rng::new(3);
        let f = exact_filter(StaticFilter::space, &[0.0; 3], &[512.0; 3], [].iter()).expect("a lattice");
        let mut n = [[0; 2]; 2];
        for _ in 0..200_000 {
            // Images of a point under changes of signs and permutations of axes, which are on one sphere.
            let most = *rng.pick(&[1, 2, 5, 255]);
            let mut p: [i64; 3] = std::array::from_fn(|_| rng.within(0, most));
            let points: [[f64; 3]; 5] = std::array::from_fn(|_| {
                rng.shuffle(&mut p);
                p.map(|x| (256 + if rng.one_in(2) { x } else { -x }) as f64)
            });
            let [a, b, c, d, e] = points.each_ref();
            let is_distinct = (0..5).all(|i| (0..i).all(|j| points[i] != points[j]));
            if !is_distinct || orient3d(&f, a, b, c, d) <= 0.0 {
                continue;
            }
            let mut ids = [0, 3, u32::MAX - 1, 1 << 31, 7];
            rng.shuffle(&mut ids);
            let expected = insphere_perturbed(&f, points.each_ref(), || ids);
            let found = is_inside_cospherical_on_lattice(points.each_ref(), ids);
            assert_eq!(found, expected, "{points:?}, {ids:?}");
            let is_flat = [[e, b, c, d], [a, e, c, d], [a, b, e, d], [a, b, c, e]]
                .iter()
                .any(|[p, q, r, s]| orient3d(&f, p, q, r, s) == 0.0);
            n[usize::from(is_flat)][usize::from(found)] += 1;
        }
        assert!(n.as_flattened().iter().all(|&n| n > 1_000), "{n:?}");
    }

    #[test]
    fn determinants_on_lattices_are_exact_in_the_plane() {
        let rng = &mut Rng::new(2);
        let mut n_ties = 0;
        for _ in 0..1_000_000 {
            let (integers, points) = lattice_points::<2, 4>(rng, 4096);
            let [lower, upper] = box_of(&points);
            if lower == upper {
                continue;
            }
            let f = exact_filter(StaticFilter::plane, &lower, &upper, points.iter()).expect("a lattice");
            let [u, v, w] = [1, 2, 3]
                .map(|k| -> [i128; 2] { std::array::from_fn(|axis| integers[k][axis] - integers[0][axis]) });
            let square = |p: &[i128; 2]| p.iter().map(|x| x * x).sum::<i128>();
            let det = square(&v) * minor(&u, &w) - square(&u) * minor(&v, &w) - square(&w) * minor(&u, &v);
            let [a, b, c, d] = points.each_ref();
            let sign = |x: f64| x.partial_cmp(&0.0).expect("a number");
            assert_eq!(sign(orient2d(&f, a, b, c)), minor(&u, &v).cmp(&0));
            assert_eq!(sign(incircle(&f, a, b, c, d)), det.cmp(&0));
            n_ties += u32::from(det == 0);
        }
        assert!(n_ties > 10_000);
    }

    #[test]
    fn points_off_a_lattice_or_too_far_apart_have_no_exact_filter() {
        let exact = |points: [[f64; 2]; 3]| {
            let [lower, upper] = box_of(&points);
            exact_filter(StaticFilter::plane, &lower, &upper, points.iter()).is_some()
        };
        assert!(exact([[0.0, 0.0], [4096.0, 1.0], [2.0, 3.0]]));
        assert!(!exact([[0.0, 0.0], [4097.0, 1.0], [2.0, 3.0]]));
        assert!(!exact([[0.0, 0.0], [4096.0, 1.0], [2.0, 3.5]]));
        assert!(!exact([[0.0, 0.0], [1.0, 0.1], [2.0, 3.5]]));
        assert!(!exact([[1.0, 1.0]; 3]) && !exact([[f64::INFINITY, 0.0]; 3]));
        assert!(exact([[1e7, 0.5], [1e7 + 1.0, 0.25], [1e7 + 2.0, 0.0]]));
        assert!(!exact([[1e-57, 0.0], [2e-57, 1e-57], [0.0, 0.0]]));
        // In units of 4, the least number is rounded to zero.
        assert!(exact([[0.0, 0.0], [16384.0, 0.0], [8192.0, 4.0]]));
        assert!(!exact([[0.0, 0.0], [16384.0, 0.0], [8192.0, f64::from_bits(1)]]));
        assert!(!exact([[1e57, 3e-294], [-1e57, 0.0], [0.0, 0.0]]));
    }
}
