//! The sphere of a cell, prepared once to be tested against many points.
//!
//! The in-sphere determinant is linear in the lift of its last point. With the
//! differences u, v, w from corner `a` of a cell to the others and s to the point, and a
//! vector *n* and a volume *V* of the cell alone,
//!
//! ```text
//! in-sphere = s·n − |s|² V,    space: V = [u v w],    n = |u|² v × w − |v|² u × w + |w|² u × v
//!                              plane: V = u × v,      n = |u|² (v_y, −v_x) − |v|² (u_y, −u_x)
//! ```
//!
//! since u·n = |u|² V, and likewise for v and w, determines n. A test costs 9 or 14 operations instead of 25
//! or 74. The bound is derived like those of the other determinants, for this operation order, and is static
//! only: what it leaves uncertain goes to [`incircle`](super::incircle) or [`insphere`](super::insphere).
//!
//! The half-space beyond a hull facet is the sphere of a ghost cell: V = 0 and n is the facet's outer normal,
//! times [`StaticFilter::largest_square`], so that its values have the same degree. Their sign is that of the
//! orientation for whatever positive scale there is; their errors grow with the scale, so all that the bound
//! asks of it is not to exceed the square of the largest extent by more than a rounding error, with or
//! without underflow. (The compiler checks that the bound of spheres is sufficient.) A scale of zero, the
//! square of less than 10⁻¹⁶², makes all values zero, hence uncertain.
//!
//! Underflow of n and V is amplified like that of any other intermediate value and part of the bound.
//! Infinity, the scale in a filter that bounds nothing, may make a value NaN, which like any value does not
//! exceed infinity.

use super::StaticFilter;

/// Vector and area of a cell of the plane: `[n_x, n_y, V]`.
pub type Circle = [f64; 3];
/// Vector and volume of a cell of space: `[n_x, n_y, n_z, V]`.
pub type Sphere = [f64; 4];

/// The circle of the triangle `abc`.
#[inline(always)]
pub fn circle(a: &[f64; 2], b: &[f64; 2], c: &[f64; 2]) -> Circle {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let (uu, vv) = (u[0] * u[0] + u[1] * u[1], v[0] * v[0] + v[1] * v[1]);
    [uu * v[1] - vv * u[1], vv * u[0] - uu * v[0], u[0] * v[1] - u[1] * v[0]]
}

/// Positive if `q` is inside the circle of which `a` is the first corner, negative if outside; open if the
/// magnitude is not above [`StaticFilter::prepared`]. (Two numbers, not one answer of three: a branch on it
/// would be mispredicted.)
#[inline(always)]
pub fn side_of_circle([x, y, volume]: &Circle, a: &[f64; 2], q: &[f64; 2]) -> f64 {
    let s = [q[0] - a[0], q[1] - a[1]];
    (s[0] * x + s[1] * y) - (s[0] * s[0] + s[1] * s[1]) * volume
}

/// The sphere of the tetrahedron `abcd`.
#[inline(always)]
pub fn sphere(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3], d: &[f64; 3]) -> Sphere {
    let [u, v, w] = [b, c, d].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
    let [uu, vv, ww] = [u, v, w].map(|p| p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    let (vw, uw, uv) = (cross(&v, &w), cross(&u, &w), cross(&u, &v));
    let n = |k: usize| uu * vw[k] - vv * uw[k] + ww * uv[k];
    [n(0), n(1), n(2), u[0] * vw[0] + u[1] * vw[1] + u[2] * vw[2]]
}

/// What lies beyond the plane of `a`, `b`, `c`, on the side from which they turn counter-clockwise.
#[inline(always)]
pub fn half_space(f: &StaticFilter, a: &[f64; 3], b: &[f64; 3], c: &[f64; 3]) -> Sphere {
    let [u, v] = [b, c].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
    let [x, y, z] = cross(&u, &v).map(|t| t * f.largest_square);
    [x, y, z, 0.0]
}

/// Positive if `q` is inside the sphere of which `a` is the first corner, negative if outside; open if the
/// magnitude is not above [`StaticFilter::prepared`]. (Two numbers, not one answer of three: a branch on it
/// would be mispredicted.)
#[inline(always)]
pub fn side_of_sphere([x, y, z, volume]: &Sphere, a: &[f64; 3], q: &[f64; 3]) -> f64 {
    let s = [q[0] - a[0], q[1] - a[1], q[2] - a[2]];
    (s[0] * x + s[1] * y + s[2] * z) - (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) * volume
}

#[inline(always)]
fn cross(p: &[f64; 3], q: &[f64; 3]) -> [f64; 3] {
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predicates::{insphere, orient3d};

    fn certain(f: &StaticFilter, value: f64) -> Option<bool> {
        (value.abs() > f.prepared).then_some(value > 0.0)
    }

    fn unit(state: &mut u64) -> f64 {
        *state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
        (*state >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A certain answer is that of the exact predicate, on random points and on points a few ulps from a
    /// sphere.
    #[test]
    fn certain_answers_are_exact() {
        let mut state = 5;
        let (mut n_certain, mut n_open) = (0, 0);
        for round in 0..200_000 {
            // Every other round has integer points around a sphere of radius 5, shaken by a last bit or not
            // at all.
            let shaken =
                |state: &mut u64, x: f64| x + [0.0, 0.0, 1e-15, -1e-15][(unit(state) * 4.0) as usize];
            let on_sphere = [
                [3., 4., 0.],
                [5., 0., 0.],
                [0., 3., -4.],
                [-4., 0., 3.],
                [0., -5., 0.],
                [-3., 0., -4.],
                [0., 0., 5.],
            ];
            let p: [[f64; 3]; 5] = std::array::from_fn(|_| {
                if round % 2 == 0 {
                    std::array::from_fn(|_| unit(&mut state) * 10.0 - 5.0)
                } else {
                    on_sphere[(unit(&mut state) * 7.0) as usize].map(|x| shaken(&mut state, x))
                }
            });
            let f = StaticFilter::space([-6.0; 3], [6.0; 3]);
            let [a, b, c, d, q] = &p;
            match certain(&f, side_of_sphere(&sphere(a, b, c, d), a, q)) {
                Some(inside) => {
                    n_certain += 1;
                    assert_eq!(inside, insphere(&f, a, b, c, d, q) > 0.0);
                    assert_ne!(insphere(&f, a, b, c, d, q), 0.0);
                }
                None => n_open += 1,
            }
            if let Some(beyond) = certain(&f, side_of_sphere(&half_space(&f, a, b, c), a, q)) {
                assert_eq!(beyond, orient3d(&f, a, b, c, q) > 0.0);
                assert_ne!(orient3d(&f, a, b, c, q), 0.0);
            }
        }
        assert!(n_certain > 90_000 && n_open > 10_000, "{n_certain} certain, {n_open} open");
    }
}
