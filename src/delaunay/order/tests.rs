//! The curve, the sorting and the rounds.

use super::*;
use crate::delaunay::{Plane, Space};
use crate::random::Rng;

/// On a full grid a Hilbert curve visits every cell once and steps to a neighbour each time.
#[test]
fn the_curve_steps_to_neighbours() {
    for bits in [4, 8] {
        let side = 1u32 << bits;
        let mut plane: Vec<_> = (0..side * side).map(|i| [i % side, i / side]).collect();
        plane.sort_by_key(|c| hilbert_key_2(c[0], c[1], bits));
        for w in plane.windows(2) {
            assert_eq!(w[0][0].abs_diff(w[1][0]) + w[0][1].abs_diff(w[1][1]), 1, "{w:?}");
        }
    }
    for bits in 1..6 {
        let side = 1u32 << bits;
        let mut space: Vec<_> =
            (0..side.pow(3)).map(|i| [i % side, i / side % side, i / side / side]).collect();
        space.sort_by_key(|&c| hilbert_key_3(c, bits));
        for w in space.windows(2) {
            assert_eq!((0..3).map(|k| w[0][k].abs_diff(w[1][k])).sum::<u32>(), 1, "{w:?}");
        }
    }
}

/// Skilling's transform, bit by bit.
fn transformed(mut x: [u32; 3], bits: u32) -> u32 {
    for q in (1..bits).rev().map(|bit| 1 << bit) {
        for i in 0..3 {
            if x[i] & q != 0 {
                x[0] ^= q - 1;
            } else {
                let t = (x[0] ^ x[i]) & (q - 1);
                (x[0], x[i]) = (x[0] ^ t, x[i] ^ t);
            }
        }
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    let set = (1..bits).map(|bit| 1 << bit).filter(|q| x[2] & q != 0);
    let t = set.fold(0, |t, q| t ^ (q - 1));
    let x = x.map(|v| v ^ t);
    (0..bits).rev().fold(0, |key, bit| x.iter().fold(key, |key, v| key << 1 | v >> bit & 1))
}

#[test]
fn the_curve_of_space_is_skillings() {
    let rng = &mut Rng::new(1);
    for bits in 1..=10 {
        for _ in 0..5_000 {
            let x = std::array::from_fn(|_| rng.next() as u32 % (1 << bits));
            assert_eq!(hilbert_key_3(x, bits), transformed(x, bits), "{x:?}, {bits} bits");
        }
    }
}

/// Tight clusters far apart keep short steps: the total length is that of visiting each cluster in turn.
#[test]
fn clusters_are_sorted_within() {
    let mut points = Vec::new();
    for cluster in 0..4 {
        for i in 0..400 {
            let (x, y) = ((i * 7 % 20) as f64, (i * 7 / 20 % 20) as f64);
            points.push([f64::from(cluster) * 1e12 + x, y]);
        }
    }
    let n = points.len();
    let keyed = (0..n as u32).map(Keyed::new).collect();
    let keyed = hilbert_order::<Plane>(keyed, |i| &points[i as usize]).expect("room for it");
    let order: Vec<u32> = keyed.into_iter().map(Keyed::item).collect();
    let mut seen = order.clone();
    seen.sort_unstable();
    assert!(seen.iter().copied().eq(0..points.len() as u32));
    let long = order.windows(2).filter(|w| (points[w[0] as usize][0] - points[w[1] as usize][0]).abs() > 1e6);
    assert_eq!(long.count(), 3);
    let step = |w: &[u32]| {
        let (a, b) = (points[w[0] as usize], points[w[1] as usize]);
        (a[0] - b[0]).abs().min(20.0) + (a[1] - b[1]).abs()
    };
    assert!(order.windows(2).map(step).sum::<f64>() < 4.0 * 400.0 * 4.0);
}

/// Few items, and many with keys of one to three digits, some of which all have in common.
#[test]
fn digits_sort_as_comparisons_do() {
    let rng = &mut Rng::new(1);
    for (n, bits) in [(1, 8), (2, 32), (255, 30), (256, 32), (257, 32), (1000, 4), (5000, 24), (30_000, 30)] {
        for common in [0, 0x00ff_ff00, !0] {
            let keys = (0..n).map(|item| {
                let key = rng.next() as u32 & !common & (u32::MAX >> (32 - bits));
                Keyed(u64::from(key) << 32 | item)
            });
            let mut keyed: Vec<Keyed> = keys.collect();
            let mut expected = keyed.clone();
            expected.sort_by_key(|k| k.key());
            sort_by_key(&mut keyed, &mut vec![Keyed::default(); n as usize], bits);
            assert_eq!(keyed, expected, "{n} keys of {bits} bits");
        }
    }
}

#[test]
fn rounds_are_a_permutation() {
    let order = in_rounds::<Space>(SiteId::range(5..5000)).expect("room for it");
    let mut seen = order.to_vec();
    seen.sort_unstable();
    assert!(seen.into_iter().eq(SiteId::range(5..5000)));
    let falls = order.windows(2).filter(|w| w[1] < w[0]).count();
    assert!((1..16).contains(&falls), "{falls} rounds");
    for n in 0..SHORT_RUN + 3 {
        let mut order = in_rounds::<Plane>(SiteId::range(1..n + 1)).expect("room for it");
        order.sort_unstable();
        assert!(order.into_iter().eq(SiteId::range(1..n + 1)), "{n}");
    }
}

/// The smallest numbers there are come in the order of as many whole ones.
#[test]
fn subnormal_extents_are_sorted_as_others() {
    let rng = &mut Rng::new(12);
    let whole: Vec<[f64; 2]> =
        (0..5_000).map(|_| std::array::from_fn(|_| (rng.unit() * 1e6).floor())).collect();
    let order = |unit: f64| {
        let points: Vec<[f64; 2]> = whole.iter().map(|p| p.map(|x| x * unit)).collect();
        let items = (0..whole.len() as u32).map(Keyed::new).collect();
        let sorted = hilbert_order::<Plane>(items, |k| &points[k as usize]).expect("room for it");
        sorted.into_iter().map(Keyed::item).collect::<Vec<_>>()
    };
    for unit in [f64::from_bits(1), 2.0_f64.powi(-1000), 2.0_f64.powi(-350), 2.0_f64.powi(150)] {
        assert_eq!(order(unit), order(1.0), "{unit:e}");
    }
}
