//! The predicates on hard cases published with other implementations, when their files are at hand.
//!
//! They are looked for in the directory that the environment variable `DELDRIFT_SHARED` names, else in
//! `shared` beside this package; without them the test is skipped.

use crate::common::skipped;
use deldrift::internals::predicates::*;
use std::env;
use std::fs;
use std::path::PathBuf;

/// Columns of a line between its index and its sign, as points.
fn points<const D: usize, const N: usize>(columns: &[f64]) -> [[f64; D]; N] {
    assert_eq!(columns.len(), N * D);
    assert!(columns.iter().all(|&x| is_in_range(x)));
    std::array::from_fn(|i| std::array::from_fn(|axis| columns[i * D + axis]))
}

/// Checks all cases of a suite, each with the tightest filter and with one that decides nothing. The suite's
/// sign is that of the determinant of differences to the last point: in space the opposite of ours.
fn check<const D: usize, const N: usize>(
    name: &str,
    filter: fn([f64; D], [f64; D]) -> StaticFilter,
    value: fn(&StaticFilter, [[f64; D]; N]) -> f64,
) {
    let shared = env::var_os("DELDRIFT_SHARED")
        .map_or_else(|| PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared")), PathBuf::from);
    let path = shared.join("data/suites").join(format!("robust-predicates_{name}.txt"));
    let Ok(suite) = fs::read_to_string(&path) else {
        skipped("predicates_suites", &format!("there is no {}", path.display()));
        return;
    };
    let mut n_cases = 0;
    for line in suite.lines().filter(|line| !line.trim().is_empty()) {
        let columns: Vec<f64> = line.split_whitespace().map(|column| column.parse().unwrap()).collect();
        let [_, coordinates @ .., sign] = &columns[..] else { panic!("{line}") };
        let points: [[f64; D]; N] = points(coordinates);
        let expected = if D == 3 { -sign } else { *sign };
        let corner = |pick: fn(f64, f64) -> f64| {
            std::array::from_fn(|axis| points.iter().map(|p| p[axis]).reduce(pick).unwrap())
        };
        let tight = filter(corner(f64::min), corner(f64::max));
        let nothing = filter([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
        for f in [tight, nothing] {
            assert_eq!(value(&f, points).partial_cmp(&0.0), expected.partial_cmp(&0.0), "{line}");
        }
        n_cases += 1;
    }
    assert_eq!(n_cases, 1_000);
}

#[test]
fn orient2d_suite() {
    check("orient2d", StaticFilter::plane, |f, [a, b, c]| orient2d(f, &a, &b, &c));
}

#[test]
fn incircle_suite() {
    check("incircle", StaticFilter::plane, |f, [a, b, c, d]| incircle(f, &a, &b, &c, &d));
}

#[test]
fn orient3d_suite() {
    check("orient3d", StaticFilter::space, |f, [a, b, c, d]| orient3d(f, &a, &b, &c, &d));
}

#[test]
fn insphere_suite() {
    check("insphere", StaticFilter::space, |f, [a, b, c, d, e]| insphere(f, &a, &b, &c, &d, &e));
}
