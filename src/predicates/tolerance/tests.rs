//! Bounds of distances and tolerances against exact arithmetic, and several at a time against each.

use super::super::dyadic::{Dyadic, product};
use super::*;
use crate::random::Rng;

fn within(fixed: &[[f64; 3]; LANES], tolerances: &[f64; LANES], places: &[[f64; 3]; LANES]) -> [u32; 2] {
    let plane = |points: &[[f64; 3]; LANES]| points.map(|[x, y, _]| [x, y]);
    let (fixed2d, places2d) = (plane(fixed), plane(places));
    [
        in_lanes!(simd => are_within(simd, fixed2d.each_ref(), tolerances, places2d.each_ref())),
        in_lanes!(simd => are_within(simd, fixed.each_ref(), tolerances, places.each_ref())),
    ]
}

/// Distances of several points are those of each, bit by bit, also where squares underflow.
#[test]
fn distances_of_several_are_those_of_each() {
    let rng = &mut Rng::new(3);
    let mut n_same = 0;
    for _ in 0..20_000 {
        let size = [0.0, 1e-300, 1e-141, 1e-3, 1e50][rng.below(5)];
        let mut point = |around: [f64; 3]| around.map(|x| x + size * (rng.unit() - 0.5));
        let p: [[f64; 3]; LANES] = std::array::from_fn(|_| point([0.0; 3]));
        let q = p.map(&mut point);
        let (p2d, q2d) = (p.map(|[x, y, _]| [x, y]), q.map(|[x, y, _]| [x, y]));
        let in_space = in_lanes!(simd => distances_above(simd, p.each_ref(), q.each_ref()));
        let in_plane = in_lanes!(simd => distances_above(simd, p2d.each_ref(), q2d.each_ref()));
        assert_eq!(in_space, [0, 1, 2, 3].map(|k| distance_above(&p[k], &q[k])));
        assert_eq!(in_plane, [0, 1, 2, 3].map(|k| distance_above(&p2d[k], &q2d[k])));
        n_same += in_space.iter().filter(|&&distance| distance == 0.0).count();
    }
    assert!((10_000..30_000).contains(&n_same), "{n_same}");
}

/// Several vertices are found to be within exactly where each of them is, tolerances without a use included.
#[test]
fn several_are_within_where_each_is() {
    let mut state = 1_u64;
    let mut random = move |n: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % n
    };
    let special = [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-200, 2.0 * LEAST, 1e200, 0.5, 1.0, 1.5];
    let mut n_within = [0; 2];
    for _ in 0..10_000 {
        let mut points = || [(); LANES].map(|()| [(); 3].map(|()| random(3) as f64));
        let (fixed, places) = (points(), points());
        let tolerances = [(); LANES].map(|()| special[random(special.len() as u64) as usize]);
        let found = within(&fixed, &tolerances, &places);
        for k in 0..LANES {
            let ([a, b, _], [c, d, _]) = (fixed[k], places[k]);
            let limit = displacement_limit(tolerances[k]);
            let is_within = [squared_distance(&[a, b], &[c, d]), squared_distance(&fixed[k], &places[k])]
                .map(|d| d < limit);
            for dimension in 0..2 {
                assert_eq!(
                    found[dimension] >> k & 1 == 1,
                    is_within[dimension],
                    "{fixed:?} {places:?} {tolerances:?}"
                );
                n_within[dimension] += u32::from(is_within[dimension]);
            }
        }
    }
    assert!(n_within.iter().all(|n| (5_000..35_000).contains(n)), "{n_within:?}");
}

/// The half-width is the lesser of both distances from the radius, less what the analysis takes off, in exact
/// numbers: also where the radius has been rounded, and where distances are nearly [`LEAST`].
#[test]
fn half_widths_are_as_documented() {
    let rng = &mut Rng::new(8);
    let (mut n_nearer_inside, mut n_positive) = (0, 0);
    for case in 0..20_000 {
        let unit = [1.0, 1e-139, 3e50][case % 3];
        let inner = unit * (1.0 + rng.unit());
        let outer = inner * (1.0 + [10.0 * rng.unit(), (100 + rng.below(400)) as f64 * UNIT][case % 2]);
        let (radius, half_width) = middle::<f64, 3>(inner * inner, outer * outer);
        let [r, big, rho] = [(inner * inner).sqrt(), (outer * outer).sqrt(), radius].map(Dyadic::from);
        let (inside, outside) = (rho.clone() - r, big.clone() - rho);
        n_nearer_inside += usize::from(inside < outside);
        let least = if inside < outside { inside } else { outside };
        let lost = product([4.5, UNIT]) * big + product([2.0, LEAST]);
        if least <= lost {
            assert_eq!(half_width, 0.0, "{inner:e} {outer:e}");
            continue;
        }
        n_positive += 1;
        assert!((lost + product([half_width])).is_close_to(&least, 38), "{inner:e} {outer:e}");
    }
    assert!(n_nearer_inside > 1_000 && n_positive > 10_000, "{n_nearer_inside} {n_positive}");
}

/// Half the least distance of two opposite faces, vertex and facet or two edges, of tetrahedra of all sizes.
#[test]
fn tolerances_of_tetrahedra_are_close_below_half_the_least_width() {
    let rng = &mut Rng::new(9);
    let mut n_positive = 0;
    for _ in 0..10_000 {
        let size = 2f64.powi(rng.within(-100, 100) as i32);
        let corners: [[f64; 3]; 4] =
            std::array::from_fn(|_| std::array::from_fn(|_| rng.below(1_000) as f64));
        let [u, v, w] = [1, 2, 3].map(|k| minus(&corners[k], &corners[0]));
        // Integers of which all products are exact.
        let normals = [
            cross(&u, &v),
            cross(&v, &w),
            cross(&w, &u),
            cross(&minus(&v, &u), &minus(&w, &u)),
            cross(&u, &minus(&w, &v)),
            cross(&v, &minus(&u, &w)),
            cross(&w, &minus(&v, &u)),
        ];
        let square = normals.iter().map(|n| dot(n, n)).fold(0.0, f64::max);
        let volume = dot(&cross(&u, &v), &w);
        let scaled = corners.map(|p| p.map(|x| x * size));
        let t = orientation_tolerance3d(scaled.each_ref());
        if volume <= 0.0 {
            assert_eq!(t, 0.0, "{corners:?}");
            continue;
        }
        n_positive += 1;
        let (found, limit) = (product([4.0, t, t, square]), product([volume, volume, size, size]));
        assert!(found < limit && found.is_close_to(&limit, 24), "{corners:?}, {size:e}");
    }
    assert!(n_positive > 4_000);
}
