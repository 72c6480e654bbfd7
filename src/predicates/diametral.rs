//! Whether a place is in the circle of which two others are opposite ends.

use std::cmp::Ordering;

use super::passing::sign_of_cross;
use super::vectors::minus;

/// Whether a place is strictly inside the circle of which two others are opposite ends: it sees them under more than 90
/// degrees.
///
/// The answer is the sign of a dot product of differences, which is their cross product after a quarter turn of one of
/// them, as exact as that is.
#[inline]
pub fn is_in_diametral_circle([a, b]: [&[f64; 2]; 2], p: &[f64; 2]) -> bool {
    let turned = |[x, y]: &[f64; 2]| [-y, *x];
    let (end, place) = (turned(b), turned(p));
    let differences = [minus(a, p), minus(&end, &place)];
    sign_of_cross(differences, [[a, p], [&end, &place]]) == Ordering::Less
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Rng;

    /// Small integers, where ties are the rule, at places and with bits below that rounded products do not have.
    #[test]
    fn integers_say_so() {
        let (mut n_inside, mut n_on) = (0, 0);
        for seed in 0..20_000 {
            let rng = &mut Rng::new(seed);
            let size = *rng.pick(&[2, 5, 1 << 52]);
            let offset = *rng.pick(&[0, 1 << 40]);
            let [a, b, mut p] = [(); 3].map(|()| [(); 2].map(|()| offset + rng.within(-size, size)));
            if rng.one_in(2) {
                // Seen at a right angle from the place beside both along an axis, and nearly so from one next to it.
                p = [a[0], b[1] + rng.within(-1, 1)];
            }
            let product = |axis: usize| i128::from(a[axis] - p[axis]) * i128::from(b[axis] - p[axis]);
            let dot = product(0) + product(1);
            let unit = *rng.pick(&[1.0, f64::powi(2.0, -300)]);
            let [a, b, p] = [a, b, p].map(|q| q.map(|x| x as f64 * unit));
            assert_eq!(is_in_diametral_circle([&a, &b], &p), dot < 0, "{a:?}, {b:?}, {p:?}");
            n_inside += usize::from(dot < 0);
            n_on += usize::from(dot == 0);
        }
        assert!(n_inside > 3_000 && n_on > 3_000, "{n_inside}, {n_on}");
    }
}
