//! Simplices that stay positively oriented while their corners go straight, at constant speed, from old to new places.
//!
//! Let D_S be the determinant of the differences from the first corner, those in the set S of rows taken between new
//! places and the others between old ones. The orientation at time t is a polynomial with the Bernstein coefficients
//! B_k / C(D, k), B_k being the sum of the D_S with |S| = k: it is positive on [0, 1] if all of them are.
//!
//! Rounded, a D_S is off by at most the bound of `filter.rs`, with the largest difference along each axis for
//! extent. A sum of d of them is d times that off, and d − 1 roundings of at most d · d! products: 16 u in the
//! plane, 156 u in space.

use super::tolerance::{LEAST_DETERMINANT, ORIENT_2D, ORIENT_3D};
use super::vectors::{cross, dot, minor, minus};

/// Whether a triangle certainly stays positively oriented.
#[inline]
pub fn stays_positive2d(old: [&[f64; 2]; 3], new: [&[f64; 2]; 3]) -> bool {
    let rows = |p: [&[f64; 2]; 3]| [p[1], p[2]].map(|q| minus(q, p[0]));
    let [a, b] = [rows(old), rows(new)];
    let bound = 3.0 * ORIENT_2D * product_of_extents([&a, &b]) + 2.0 * LEAST_DETERMINANT;
    let one = minor(&a[0], &b[1]) + minor(&b[0], &a[1]);
    [minor(&a[0], &a[1]), one, minor(&b[0], &b[1])].iter().all(|&sum| sum > bound)
}

/// Whether a tetrahedron certainly stays positively oriented.
#[inline]
pub fn stays_positive3d(old: [&[f64; 3]; 4], new: [&[f64; 3]; 4]) -> bool {
    let rows = |p: [&[f64; 3]; 4]| [p[1], p[2], p[3]].map(|q| minus(q, p[0]));
    let [a, b] = [rows(old), rows(new)];
    let det = |u: &[f64; 3], v: &[f64; 3], w: &[f64; 3]| dot(u, &cross(v, w));
    let bound = 4.0 * ORIENT_3D * product_of_extents([&a, &b]) + 3.0 * LEAST_DETERMINANT;
    let one = det(&b[0], &a[1], &a[2]) + det(&a[0], &b[1], &a[2]) + det(&a[0], &a[1], &b[2]);
    let two = det(&a[0], &b[1], &b[2]) + det(&b[0], &a[1], &b[2]) + det(&b[0], &b[1], &a[2]);
    let all = |p: &[[f64; 3]; 3]| det(&p[0], &p[1], &p[2]);
    [all(&a), one, two, all(&b)].iter().all(|&sum| sum > bound)
}

/// The product, over the axes, of the greatest magnitude of a component.
fn product_of_extents<const D: usize>(rows: [&[[f64; D]; D]; 2]) -> f64 {
    let greatest =
        |axis: usize| rows.iter().flat_map(|r| r.iter()).fold(0.0, |most, r| r[axis].abs().max(most));
    (0..D).map(greatest).product()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coordinates from −8 to 8.
    struct Random(u64);

    impl Random {
        fn points<const D: usize, const N: usize>(&mut self) -> [[i128; D]; N] {
            [(); N].map(|()| {
                [(); D].map(|()| {
                    self.0 = self
                        .0
                        .wrapping_mul(6_364_136_223_846_793_005)
                        .wrapping_add(1_442_695_040_888_963_407);
                    i128::from(self.0 >> 40) % 17 - 8
                })
            })
        }
    }

    fn floats<const D: usize, const N: usize>(points: &[[i128; D]; N]) -> [[f64; D]; N] {
        points.map(|p| p.map(|x| x as f64))
    }

    /// The points at time k/n, times n.
    fn at<const D: usize, const N: usize>(
        old: &[[i128; D]; N],
        new: &[[i128; D]; N],
        k: i128,
        n: i128,
    ) -> [[i128; D]; N] {
        std::array::from_fn(|i| std::array::from_fn(|axis| old[i][axis] * (n - k) + new[i][axis] * k))
    }

    fn area(p: &[[i128; 2]; 3]) -> i128 {
        let [u, v] = [p[1], p[2]].map(|q| [q[0] - p[0][0], q[1] - p[0][1]]);
        u[0] * v[1] - u[1] * v[0]
    }

    fn volume(p: &[[i128; 3]; 4]) -> i128 {
        let [u, v, w] = [p[1], p[2], p[3]].map(|q| [q[0] - p[0][0], q[1] - p[0][1], q[2] - p[0][2]]);
        u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
            + u[2] * (v[0] * w[1] - v[1] * w[0])
    }

    /// What is said to stay positive is so at 1,001 moments, and most of what is so is said to be.
    #[test]
    fn what_stays_positive_is_positive_all_the_way() {
        const MOMENTS: i128 = 1_000;
        let mut random = Random(1);
        let (mut said, mut is_so) = ([0; 2], [0; 2]);
        for _ in 0..20_000 {
            let (old, new) = (random.points::<2, 3>(), random.points::<2, 3>());
            let (a, b) = (floats(&old), floats(&new));
            let stays = stays_positive2d(a.each_ref(), b.each_ref());
            let positive = (0..=MOMENTS).all(|k| area(&at(&old, &new, k, MOMENTS)) > 0);
            assert!(positive || !stays, "{old:?} {new:?}");
            (said[0], is_so[0]) = (said[0] + i32::from(stays), is_so[0] + i32::from(positive));

            let (old, new) = (random.points::<3, 4>(), random.points::<3, 4>());
            let (a, b) = (floats(&old), floats(&new));
            let stays = stays_positive3d(a.each_ref(), b.each_ref());
            let positive = (0..=MOMENTS).all(|k| volume(&at(&old, &new, k, MOMENTS)) > 0);
            assert!(positive || !stays, "{old:?} {new:?}");
            (said[1], is_so[1]) = (said[1] + i32::from(stays), is_so[1] + i32::from(positive));
        }
        for (said, is_so) in said.into_iter().zip(is_so) {
            assert!(said > 100 && 10 * said > 4 * is_so, "{said} of {is_so}");
        }
    }
}
