//! Positions that are taken into the box, in whole numbers of sixteenths.

use super::*;
use crate::delaunay::{Moving, Plane, Space};
use crate::error::Error;
use crate::motion::Options;
use crate::random::Rng;

type Rows = [[i64; 3]; 3];

fn point_of<G: Moving>(sixteenths: &[i64; 3]) -> G::Point {
    let mut point = G::Point::default();
    (0..G::D).for_each(|axis| point[axis] = sixteenths[axis] as f64 / 16.0);
    point
}

fn sixteenths_of<G: Moving>(point: &G::Point) -> [i64; 3] {
    [0, 1, 2].map(|axis| {
        let x = if axis < G::D { point[axis] * 16.0 } else { 0.0 };
        assert!(x.fract() == 0.0, "{x}");
        x as i64
    })
}

fn sum(multiples: &[i64; 3], rows: &Rows) -> [i64; 3] {
    [0, 1, 2].map(|axis| (0..3).map(|j| multiples[j] * rows[j][axis]).sum())
}

fn determinant([a, b, c]: &Rows) -> i64 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// What multiples of rows a vector has, times their determinant.
fn multiples_of(vector: &[i64; 3], rows: &Rows) -> [i64; 3] {
    [0, 1, 2].map(|j| {
        let mut replaced = *rows;
        replaced[j] = *vector;
        determinant(&replaced) * determinant(rows).signum()
    })
}

/// Vectors that are those of a box, padded so that they span space.
fn box_of<G: Moving>(rng: &mut Rng, rank: usize) -> Rows {
    let mut rows = [[16, 0, 0], [0, 16, 0], [0, 0, 16]];
    for (j, row) in rows.iter_mut().enumerate().take(rank) {
        for (axis, entry) in row.iter_mut().enumerate().take(G::D) {
            *entry = rng.below(17) as i64 - 8 + if axis == j { 48 } else { 0 };
        }
    }
    let skew = rng.below(9) as i64 - 4;
    if rank > 1 {
        rows[1] = [0, 1, 2].map(|axis| rows[1][axis] + skew * rows[0][axis]);
    }
    rows
}

fn check<G: Moving>(seed: u64, rank: usize) {
    let rng = &mut Rng::new(seed);
    let rows = box_of::<G>(rng, rank);
    let basis: Vec<_> = rows[..rank].iter().map(point_of::<G>).collect();
    let empty = PeriodicTriangulation::<G>::new(&[], &basis, Options::default()).unwrap();
    let mut reduced = rows;
    let mut of_box: Rows = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    for (j, (vector, multiples, _)) in empty.reduced_vectors().enumerate() {
        reduced[j] = sixteenths_of::<G>(&vector);
        of_box[j] = multiples;
        assert_eq!(reduced[j], sum(&multiples, &rows), "seed {seed}");
        assert!((rank..3).all(|k| multiples[k] == 0));
    }
    assert_eq!(determinant(&of_box).abs(), 1, "seed {seed}");
    let given: Vec<[i64; 3]> = (0..30)
        .map(|_| [0, 1, 2].map(|axis| if axis < G::D { rng.below(4_001) as i64 - 2_000 } else { 0 }))
        .collect();
    let positions: Vec<_> = given.iter().map(point_of::<G>).collect();
    let wrapped = empty.wrap_positions(&positions, None).unwrap();
    let places: Vec<_> = wrapped.iter().map(|(place, _)| *place).collect();
    let size = determinant(&reduced).abs();
    // Along what is open the unit cell is orthogonal to the vectors, and not along the others of the padded ones.
    let is_open = rank < G::D;
    for (position, (place, shift)) in given.iter().zip(&wrapped) {
        let (place, way) = (sixteenths_of::<G>(place), sum(shift, &rows));
        assert_eq!([0, 1, 2].map(|axis| place[axis] + way[axis]), *position, "seed {seed}");
        let multiples = multiples_of(&place, &reduced);
        let is_inside = multiples[..rank].iter().all(|m| (0..=size).contains(m));
        assert!(is_inside || is_open, "seed {seed}: {multiples:?}");
    }
    // Positions near others: to the nearest period, or as without.
    let mut near = places.clone();
    rng.shuffle(&mut near);
    for (index, (place, shift)) in empty.wrap_positions(&positions, Some(&near)).unwrap().iter().enumerate() {
        let (at, way, from) =
            (sixteenths_of::<G>(place), sum(shift, &rows), sixteenths_of::<G>(&near[index]));
        assert_eq!([0, 1, 2].map(|axis| at[axis] + way[axis]), given[index], "seed {seed}");
        let apart = multiples_of(&[0, 1, 2].map(|axis| at[axis] - from[axis]), &reduced);
        let is_nearest = apart[..rank].iter().all(|m| 2 * m.abs() <= size);
        assert!(is_nearest || is_open || *place == places[index], "seed {seed}");
        let multiples = multiples_of(&at, &reduced);
        let is_about = multiples[..rank].iter().all(|m| (-size..=5 * size).contains(&(4 * m)));
        assert!(is_about || is_open, "seed {seed}");
    }
    // Neighbours are no farther than is told.
    let t = PeriodicTriangulation::<G>::new(&places, &basis, Options::default()).unwrap();
    let greatest: Vec<_> = t.reduced_vectors().map(|(.., greatest)| i64::from(greatest)).collect();
    for (_, shift) in t.edges().unwrap() {
        let multiples = multiples_of(&sum(&shift, &rows), &reduced);
        assert!((0..rank).all(|j| multiples[j].abs() <= greatest[j] * size), "seed {seed}: {shift:?}");
    }
}

#[test]
fn positions_are_taken_into_the_box() {
    for seed in 0..40 {
        for rank in 1..=3 {
            if rank < 3 {
                check::<Plane>(seed, rank);
            }
            check::<Space>(seed, rank);
        }
    }
}

#[test]
fn what_can_not_be_taken_in_is_told() {
    let t = PeriodicTriangulation::<Plane>::new(&[], &[[1.0, 0.0], [0.0, 1.0]], Options::default()).unwrap();
    let bad = t.wrap_positions(&[[0.5, 0.5], [0.5, f64::NAN]], None);
    assert!(matches!(bad, Err(Error::NotFinite { argument: "positions", index: 1, axis: 1, .. })));
    assert!(matches!(
        t.wrap_positions(&[[1e40, 0.5]], None),
        Err(Error::OutOfRange { index: 0, axis: 0, .. })
    ));
    assert!(matches!(
        t.wrap_positions(&[[0.5; 2]], Some(&[])),
        Err(Error::WrongCount { given: 0, wanted: 1, .. })
    ));
    // What is near nothing does not count.
    for near in [f64::NAN, f64::INFINITY, 1e300, -1e18] {
        assert_eq!(t.wrap_positions(&[[2.5, 0.25]], Some(&[[near; 2]])), Ok(vec![([0.5, 0.25], [2, 0, 0])]));
    }
}
