//! The mask without flat cells along the hull: against its definition in exact integers, and on lattices that are
//! turned, whose sides are straight but for rounding.

use super::*;
use crate::common::inputs::quantized;
use std::cell::Cell;

/// The square of the least height over the longest edge of a cell, but for a few last bits.
fn flatness(corners: &[Grid]) -> f64 {
    let edge = |i: usize, j: usize| -> Vec<BigInt> {
        (0..corners[0].len()).map(|k| BigInt::from(corners[i][k]) - BigInt::from(corners[j][k])).collect()
    };
    let square = |v: &[BigInt]| -> BigInt { v.iter().map(|x| x * x).sum() };
    let n = corners.len();
    let longest = (0..n).flat_map(|i| (0..i).map(move |j| (i, j))).map(|(i, j)| square(&edge(i, j))).max();
    let longest = longest.expect("corners");
    let (_, det) = circumsphere(corners);
    if n == 3 {
        return quotient(&(&det * &det), &(&longest * &longest), 0);
    }
    let area = |i: usize, j: usize, k: usize| {
        let (u, v) = (edge(i, j), edge(k, j));
        let minor = |a: usize, b: usize| &u[a] * &v[b] - &u[b] * &v[a];
        square(&[minor(0, 1), minor(1, 2), minor(2, 0)])
    };
    let largest = [area(0, 1, 2), area(0, 1, 3), area(0, 2, 3), area(1, 2, 3)].into_iter().max();
    quotient(&(&det * &det), &(longest * largest.expect("facets")), 0)
}

/// The mask by its definition; `None` if a cell is too near to the tolerance.
fn defined<G: Dimension>(t: &MovingTriangulation<G>, tolerance: f64) -> Option<Vec<u8>> {
    let margin = 1e-6 + 1e-14 / tolerance;
    let mut is_flat = Vec::new();
    for corners in cells_of(t) {
        let ratio = flatness(&corners).sqrt() / tolerance;
        if (ratio - 1.0).abs() < margin {
            return None;
        }
        is_flat.push(ratio < 1.0);
    }
    let neighbours = t.cells().expect("room").neighbours;
    let mut mask = vec![1; is_flat.len()];
    let goes = |mask: &[u8], c: usize| {
        let beside = neighbours[CellId::at(c)].as_ref();
        is_flat[c] && mask[c] == 1 && beside.iter().any(|&n| n == NO_CELL || mask[n.index()] == 0)
    };
    while let Some(c) = (0..mask.len()).find(|&c| goes(&mask, c)) {
        mask[c] = 0;
    }
    Some(mask)
}

fn check_definition<G: Dimension>(t: &MovingTriangulation<G>, n_compared: &Cell<usize>) {
    for tolerance in [1e-9, 1e-5, 0.02, 0.3, 5.0, f64::INFINITY] {
        if let Some(expected) = defined(t, tolerance) {
            assert_eq!(t.mask_without_flat_cells(tolerance).expect("room"), expected, "{tolerance}");
            n_compared.set(n_compared.get() + usize::from(t.cell_count() > 0));
        }
    }
    assert!(t.mask_without_flat_cells(0.0).expect("room").iter().all(|&stays| stays == 1));
    for bad in [-1e-9, f64::NAN] {
        let refused = t.mask_without_flat_cells(bad);
        assert!(matches!(refused, Err(Error::InvalidValue { argument: "tolerance", .. })));
    }
}

#[test]
fn flat_cells_are_those_of_the_definition() {
    let n_compared = Cell::new(0);
    on_all_kinds::<Plane>(|t, _| check_definition(t, &n_compared));
    on_all_kinds::<Space>(|t, _| check_definition(t, &n_compared));
    assert!(n_compared.get() > 50, "{n_compared:?}");
}

/// A lattice of `side` steps each way, turned in the first two axes and, in space, in the last two.
fn turned<G: Dimension>(side: usize, angle: f64) -> Vec<G::Point> {
    let n = side + 1;
    let (sin, cos) = angle.sin_cos();
    let turn = |p: &mut G::Point, a: usize, b: usize| {
        (p[a], p[b]) = (cos * p[a] - sin * p[b], sin * p[a] + cos * p[b]);
    };
    (0..n.pow(G::D as u32))
        .map(|k| {
            let mut p = point::<G>(|axis| (k / n.pow(axis as u32) % n) as f64);
            turn(&mut p, 0, 1);
            if G::D == 3 {
                turn(&mut p, 1, 2);
            }
            p
        })
        .collect()
}

#[test]
fn turned_lattices_keep_as_many_triangles_as_straight_ones() {
    for (side, angle) in [(1, 0.3), (7, 0.1), (40, 0.1), (40, 0.3), (25, 1.234)] {
        let points = turned::<Plane>(side, angle);
        let t = MovingTriangulation::<Plane>::new(&points, Options::default()).expect("good points");
        let mask = t.mask_without_flat_cells(1e-9).expect("room");
        assert_eq!(mask.iter().filter(|&&stays| stays == 1).count(), 2 * side * side, "{side} {angle}");
        let mut n_edges = 0;
        t.mask_boundary(&mask, |_| n_edges += 1).expect("a mask");
        assert_eq!(n_edges, 4 * side);
        assert!(side < 7 || mask.len() > 2 * side * side, "no side is bent");
    }
}

/// What stays of a turned cube has the volume of the cube, its surface six squares of two triangles for each step.
#[test]
fn turned_cubes_keep_their_volume_and_surface() {
    let mut n_flat = 0;
    for (side, angle) in [(1, 0.3), (5, 0.1), (8, 0.3)] {
        let points = turned::<Space>(side, angle);
        let t = MovingTriangulation::<Space>::new(&points, Options::default()).expect("good points");
        let mask = t.mask_without_flat_cells(1e-9).expect("room");
        n_flat += mask.iter().filter(|&&stays| stays == 0).count();
        let volumes = t.volumes().expect("room").zip(&mask).filter(|(_, stays)| **stays == 1);
        let whole = (side as f64).powi(3);
        assert!((volumes.map(|(volume, _)| volume).sum::<f64>() - whole).abs() < 1e-11 * whole);
        let mut n_facets = 0;
        t.mask_boundary(&mask, |_| n_facets += 1).expect("a mask");
        assert_eq!(n_facets, 6 * side * side * 2, "{side} {angle}");
    }
    assert!(n_flat > 50, "{n_flat}");
}

/// The mask does not depend on the unit of length, even where areas and volumes are less than any number.
#[test]
fn the_unit_of_length_does_not_matter() {
    fn check<G: Dimension>() {
        let turned = turned::<G>(5, 0.1).into_iter().map(quantized::<G>);
        let points: Vec<G::Point> = turned.collect();
        let mask_of = |exponent: i32| {
            let half = 2f64.powi(exponent / 2);
            let scaled: Vec<_> = points.iter().map(|p| point::<G>(|k| p[k] * half * half)).collect();
            let t = MovingTriangulation::<G>::new(&scaled, Options::default()).expect("good points");
            let mask = t.mask_without_flat_cells(1e-3).expect("room");
            let rows = t.cells().expect("room").corners.iter().map(|row| crate::common::sorted(row.as_ref()));
            rows.zip(mask).collect::<BTreeMap<_, _>>()
        };
        let mask = mask_of(0);
        assert!(mask.values().any(|&stays| stays == 0) && mask.values().any(|&stays| stays == 1));
        for exponent in [-1000, -900, -420, -198, -40, 40, 184] {
            assert!(mask_of(exponent) == mask, "2^{exponent}");
        }
    }
    check::<Plane>();
    check::<Space>();
}
