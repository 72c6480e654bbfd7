//! Whether a vertex goes through a segment, all three places going straight, at constant speed, from old to new ones.
//!
//! # Definition
//!
//! Let p go from p₀ to p₁, and the ends a and b of a segment from a₀ and b₀ to a₁ and b₁, all at the same time. At time t
//! the vertex is on the segment, s of the way from a to b, where f(s, t) = p(t) − a(t) − s (b(t) − a(t)) is zero. Each
//! zero is a passage from one side to the other, and counts as 1 or −1. The sum is not changed by anything but zeros that
//! come or go through the boundary of the unit square: it is the degree of f, which is the winding number around zero of
//! the image of that boundary. As f is linear in s and in t, the image is a quadrilateral, of corners p₀ − a₀, p₀ − b₀,
//! p₁ − b₁ and p₁ − a₁.
//!
//! The vertex *passes* the segment if that number is not zero; or if zero is on the quadrilateral: then it goes exactly
//! through an end, or begins or stops on the segment. A vertex that is at the place of an end when it begins or when it
//! stops is on no side there, and does not pass. In and out again in one step is no passing.
//!
//! # Exactness
//!
//! The winding number is counted along the positive first axis. It takes the signs of corners, which are exact as they
//! are signs of differences, and for sides that cross the axis the sign of a cross product of two differences. That is
//! decided by its rounded value where that exceeds the bound of `orient2d` for extents that are the larger of the two
//! differences along each axis, which is all that the analysis in `filter.rs` asks of extents; then with tails
//! (`corners.rs`), exact on lattices; then from the coordinates in long integers (`big.rs`).

use std::cmp::Ordering;

use super::big;
use super::corners::Bounded;
use super::filter::{is_certain, orient2d_bound};
use super::plane::sign_of;
use super::vectors::{minor, minus};
use crate::machine::tally;

/// Whether a vertex passes a segment. Each place is given before and after.
#[inline]
pub fn passes(p: [&[f64; 2]; 2], a: [&[f64; 2]; 2], b: [&[f64; 2]; 2]) -> bool {
    let pairs = [[p[0], a[0]], [p[0], b[0]], [p[1], b[1]], [p[1], a[1]]];
    let corners: [[f64; 2]; 4] = pairs.map(|[p, q]| minus(p, q));
    let is_beside =
        |axis: usize| corners.iter().all(|c| c[axis] > 0.0) || corners.iter().all(|c| c[axis] < 0.0);
    !is_beside(0) && !is_beside(1) && winds(&corners, &pairs)
}

/// Whether a quadrilateral has zero on it, though not at a corner, or winds around it.
fn winds(corners: &[[f64; 2]; 4], pairs: &[[&[f64; 2]; 2]; 4]) -> bool {
    if corners.contains(&[0.0; 2]) {
        return false;
    }
    let mut winding = 0;
    for k in 0..4 {
        let next = (k + 1) % 4;
        let [u, v] = [corners[k], corners[next]];
        match (u[1] > 0.0, v[1] > 0.0) {
            (false, true) | (true, false) => {
                let is_up = v[1] > 0.0;
                match sign_of_cross([u, v], [pairs[k], pairs[next]]) {
                    Ordering::Equal => return true,
                    Ordering::Greater if is_up => winding += 1,
                    Ordering::Less if !is_up => winding -= 1,
                    _ => {}
                }
            }
            (false, false) if u[1] == 0.0 && v[1] == 0.0 && (u[0] > 0.0) != (v[0] > 0.0) => return true,
            _ => {}
        }
    }
    winding != 0
}

/// The sign of the cross product of two differences, of which the rounded ones are given, and the points.
pub(super) fn sign_of_cross([u, v]: [[f64; 2]; 2], pairs: [[&[f64; 2]; 2]; 2]) -> Ordering {
    let det = minor(&u, &v);
    let extents = [u[0].abs().max(v[0].abs()), u[1].abs().max(v[1].abs())];
    if is_certain(det, orient2d_bound(extents), extents) {
        return sign_of(det);
    }
    tally::count();
    let [u, v] = pairs.map(|[p, q]| [0, 1].map(|axis| Bounded::difference(p[axis], q[axis])));
    match (u[0] * v[1] - u[1] * v[0]).sign() {
        Some(sign) => sign.cmp(&0),
        None => big::sign_of_cross(pairs),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::passing_by_roots::passes_by_roots;
    use crate::random::Rng;

    /// A step: vertex and ends, each before and after.
    type Step = [[[f64; 2]; 2]; 3];

    fn is_said_to_pass([p, a, b]: &Step) -> bool {
        passes(p.each_ref(), a.each_ref(), b.each_ref())
    }

    fn check(step: &Step) -> bool {
        let [p, a, b] = *step;
        let expected = passes_by_roots(step);
        assert_eq!(is_said_to_pass(step), expected, "{step:?}");
        assert_eq!(is_said_to_pass(&[p, b, a]), expected, "ends exchanged: {step:?}");
        let reversed = [p, a, b].map(|[from, to]| [to, from]);
        assert_eq!(is_said_to_pass(&reversed), expected, "back in time: {step:?}");
        let turned = step.map(|path| path.map(|[x, y]| [-y, x]));
        assert_eq!(is_said_to_pass(&turned), expected, "turned: {step:?}");
        expected
    }

    fn random_step(mut coordinate: impl FnMut() -> f64) -> Step {
        [(); 3].map(|()| [(); 2].map(|()| [(); 2].map(|()| coordinate())))
    }

    /// Small integers: most kinds of coincidences and ties.
    #[test]
    fn on_lattices_roots_say_so() {
        let rng = &mut Rng::new(1);
        let (mut n_passing, mut n_steps) = (0, 0);
        for reach in [1, 2, 3, 8] {
            for _ in 0..60_000 {
                let step = random_step(|| rng.within(-reach, reach) as f64);
                n_passing += u32::from(check(&step));
                n_steps += 1;
            }
        }
        assert!(10 * n_passing > n_steps && 2 * n_passing < n_steps, "{n_passing} of {n_steps}");
    }

    /// Numbers of all sizes that are accepted, very large, very small and subnormal ones in one step.
    #[test]
    fn at_all_sizes_roots_say_so() {
        let rng = &mut Rng::new(2);
        let most = crate::predicates::MAX_MAGNITUDE;
        let mut n_passing = 0;
        for k in 0..12_000 {
            let size = [most, 1.0, f64::MIN_POSITIVE, 4.0 * f64::from_bits(1)][k % 4];
            let is_mixed = k % 3 == 0;
            let step = random_step(|| match rng.within(0, 6) {
                0 if is_mixed => most * if rng.unit() < 0.5 { 1.0 } else { -1.0 },
                1 if is_mixed => f64::from_bits(rng.within(0, 4) as u64),
                2 if is_mixed => (rng.unit() - 0.5) * 1e-160,
                _ => (2.0 * rng.unit() - 1.0) * size,
            });
            n_passing += u32::from(check(&step));
        }
        assert!(n_passing > 1_000, "{n_passing}");
    }

    /// A vertex that goes through an end, or stops on the segment, and all its neighbours one last bit away.
    #[test]
    fn one_last_bit_decides() {
        let rng = &mut Rng::new(3);
        let (mut n_exact, mut n_passing, mut n_steps) = (0, 0, 0);
        for k in 0..3_000 {
            // At half time the vertex is at an end, or it is on the segment at the end: exact in multiples of a power of
            // two.
            let unit = [2f64.powi(-20), 2f64.powi(-40), 2f64.powi(160), f64::from_bits(16)][k / 2 % 4];
            let mut place = || [(); 2].map(|()| (rng.within(-(1 << 20), 1 << 20) as f64) * unit * 2.0);
            let [p0, p1, a0, b0, b1] = [(); 5].map(|()| place());
            let a1 = [0, 1].map(|axis| p0[axis] + p1[axis] - a0[axis]);
            let half = [0, 1].map(|axis| (b1[axis] + a1[axis]) / 2.0);
            let exact: Step =
                if k % 2 == 0 { [[p0, p1], [a0, a1], [b0, b1]] } else { [[p0, half], [a0, a1], [b0, b1]] };
            n_exact += u32::from(check(&exact));
            for which in 0..12 {
                for up in [false, true] {
                    let mut near = exact;
                    let x = &mut near[which / 4][which / 2 % 2][which % 2];
                    *x = if up { x.next_up() } else { x.next_down() };
                    n_passing += u32::from(check(&near));
                    n_steps += 1;
                }
            }
        }
        assert!(
            n_exact > 2_900 && n_passing > n_steps / 5 && n_passing < 4 * n_steps / 5,
            "{n_exact} {n_passing}"
        );
    }

    /// What the definition says of simple steps.
    #[test]
    fn simple_steps() {
        let still = |x: f64, y: f64| [[x, y]; 2];
        let wall = [still(0.0, -1.0), still(0.0, 1.0)];
        let with = |p: [[f64; 2]; 2], [a, b]: [[[f64; 2]; 2]; 2]| check(&[p, a, b]);
        assert!(with([[-1.0, 0.0], [1.0, 0.0]], wall), "across");
        assert!(!with([[-1.0, 2.0], [1.0, 2.0]], wall), "past the end");
        assert!(with([[-1.0, 1.0], [1.0, 1.0]], wall), "through the end");
        assert!(with([[-1.0, 0.0], [0.0, 0.0]], wall), "stops on it");
        assert!(!with([[0.0, 1.0], [1.0, 0.0]], wall), "begins at an end");
        assert!(!with(still(0.5, 0.0), wall), "nothing moves");
        let passing = [[[-1.0, -1.0], [1.0, -1.0]], [[-1.0, 1.0], [1.0, 1.0]]];
        assert!(with(still(0.0, 0.0), passing), "the segment moves");
        assert!(!with([[0.0, 0.0], [2.0, 0.0]], passing), "both move as one");
        let turned = [[[-1.0, 0.0], [1.0, 0.0]], [[1.0, 0.0], [-1.0, 0.0]]];
        assert!(!with(still(0.0, 0.5), turned), "the ends change places on the line");
        assert!(with(still(0.5, 0.0), turned), "an end goes through it");
        let folded = [[[-1.0, -1.0], [-1.0, 2.0]], [[1.0, -1.0], [1.0, -0.5]]];
        assert!(with(still(0.0, 0.0), folded), "the segment turns over it");
    }
}
