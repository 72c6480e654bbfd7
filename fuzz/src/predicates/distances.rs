//! Distances, lines, paths and delimiters.

use super::super::exact_oracle::*;
use super::super::source::Source;
use super::super::tally;
use super::points::points;
use super::signs::exact;
use deldrift::internals::predicates::*;
use num_bigint::BigInt;
use std::cmp::Ordering::{Equal, Greater, Less};

pub fn orders(s: &mut Source) {
    fn check<const D: usize>(p: [[f64; D]; 3], ulps: i64) {
        let expected = exact_distance_order(&p, &mut Tally::default());
        tally::SIGNS.add(1);
        let [a, b, q] = &p;
        assert_eq!(compare_distance(q, a, b), expected, "compare_distance {p:?}");
        assert_eq!(compare_distance(q, b, a), expected.reverse(), "compare_distance {p:?}");
        // Next to the square of the distance.
        let squared = squared_distance(q, a);
        let squared = if squared < f64::MIN_POSITIVE { squared } else { nudged(squared, ulps) };
        let is_within = exact_order_to_square(&[*a, *q], squared, &mut Tally::default()) != Greater;
        assert_eq!(is_within_distance(q, a, squared), is_within, "is_within_distance {p:?} {squared:e}");
    }
    if s.below(2) == 0 {
        let p = points::<2, 3>(s);
        return check(p, s.within(3));
    }
    let p = points::<3, 3>(s);
    check(p, s.within(3));
    let [a, b, c] = &p;
    let collinear = is_exactly_collinear(&p, &mut Tally::default());
    assert_eq!(is_collinear3(a, b, c), collinear, "is_collinear3 {p:?}");
}

/// Sums over the sets of rows of which k are new and the others old: coefficients of the orientation by time.
fn coefficients<const D: usize>(rows: &[Vec<Vec<BigInt>>; 2]) -> Vec<BigInt> {
    let mut sums = vec![BigInt::ZERO; D + 1];
    for set in 0..1usize << D {
        let mixed: Vec<Vec<BigInt>> = (0..D).map(|i| rows[set >> i & 1][i].clone()).collect();
        sums[set.count_ones() as usize] += determinant(&mixed);
    }
    sums
}

/// What is said to stay positive has coefficients that are.
pub fn paths(s: &mut Source) {
    fn check<const D: usize, const N: usize, const M: usize>(
        s: &mut Source,
        stays: impl Fn([&[f64; D]; N], [&[f64; D]; N]) -> bool,
    ) {
        let mut old: [[f64; D]; N] = points(s);
        let moved: [[f64; D]; N] = points(s);
        if exact(&old) == Less {
            old.swap(0, 1);
        }
        // Near by in some cases, or one corner alone.
        let share = s.pick(&[1.0, 0.5, 1e-3, 1e-12]);
        let one = s.below(2 * N);
        let new: [[f64; D]; N] = std::array::from_fn(|i| {
            std::array::from_fn(|axis| {
                let (from, to) = (old[i][axis], moved[i][axis]);
                if one < N && one != i { from } else { from + share * (to - from) }
            })
        });
        if new.iter().flatten().any(|&x| !is_in_range(x)) || !stays(old.each_ref(), new.each_ref()) {
            return;
        }
        let all: [[f64; D]; M] = std::array::from_fn(|i| if i < N { old[i] } else { new[i - N] });
        let mut rows = big_differences(&all);
        rows.push(vec![BigInt::ZERO; D]);
        let from_first = |first: usize| -> Vec<Vec<BigInt>> {
            let difference = |row: &Vec<BigInt>| row.iter().zip(&rows[first]).map(|(x, o)| x - o).collect();
            rows[first + 1..first + N].iter().map(difference).collect()
        };
        let sums = coefficients::<D>(&[from_first(0), from_first(N)]);
        tally::SIGNS.add(sums.len() as u64);
        assert!(sums.iter().all(|sum| *sum > BigInt::ZERO), "stays_positive {old:?} {new:?}");
    }
    if s.below(2) == 0 {
        check::<2, 3, 6>(s, stays_positive2d);
    } else {
        check::<3, 4, 8>(s, stays_positive3d);
    }
}

/// Points that are certainly inside a sphere, or outside, are.
pub fn delimiters(s: &mut Source) {
    fn check<const D: usize>(s: &mut Source)
    where
        [f64; D]: AsRef<[f64]> + Default + PartialEq,
    {
        let [centre, p, q] = points::<D, 3>(s);
        let near = squared_distance(&centre, &p).sqrt();
        let radius = if s.below(2) == 0 { s.magnitude().abs() } else { nudged(near, s.within(20)) };
        if !radius.is_finite() {
            return;
        }
        // With a number beside the coordinates, in their unit: the radius as that of a point on an axis.
        let order = |p: &[f64; D]| {
            let mut all: Vec<[f64; 1]> = (0..D).flat_map(|k| [[p[k]], [centre[k]]]).collect();
            all.extend([[radius], [0.0]]);
            let mut rows = big_differences(&all);
            rows.push(vec![BigInt::ZERO]);
            let square = |i: usize| (&rows[i][0] - &rows[i + 1][0]).pow(2);
            (0..D).map(|k| square(2 * k)).sum::<BigInt>().cmp(&square(2 * D))
        };
        tally::SIGNS.add(1);
        if is_certainly_inside(&centre, radius, &p) {
            assert_eq!(order(&p), Less, "is_certainly_inside {centre:?} {radius:?} {p:?}");
        }
        if is_path_certainly_outside(&centre, radius, &p, &q) {
            assert_eq!(order(&p), Greater, "is_path_certainly_outside {centre:?} {radius:?} {p:?}");
            assert_eq!(order(&q), Greater, "is_path_certainly_outside {centre:?} {radius:?} {q:?}");
            let middle: [f64; D] = std::array::from_fn(|k| 0.5 * p[k] + 0.5 * q[k]);
            let is_middle = (0..D).all(|k| middle[k] - p[k] == q[k] - middle[k]);
            assert!(
                !is_middle || order(&middle) != Less,
                "is_path_certainly_outside {centre:?} {radius:?} {p:?} {q:?}"
            );
        }
        let above = distance_above(&p, &centre);
        assert!((above == 0.0) == (p == centre) && !above.is_nan(), "distance_above {p:?} {centre:?}");
        assert_ne!(compare_distance(&p, &p, &q), Greater, "{p:?} {q:?}");
        assert_eq!(compare_distance(&p, &q, &q), Equal, "{p:?} {q:?}");
    }
    if s.below(2) == 0 { check::<2>(s) } else { check::<3>(s) }
}
