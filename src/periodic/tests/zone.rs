//! Conflicts and natural neighbours beside those among copies in the open.

use super::*;
use crate::ids::CellId;
use crate::motion::{Interpolation, Location, VertexValues};

/// A cell by its vertices and their periods, of which the first is none.
type Name = Vec<(usize, [i64; 3])>;

fn name_of(mut row: Name) -> Name {
    row.sort_unstable();
    let first = row[0].1;
    row.iter_mut().for_each(|(_, shift)| *shift = [0, 1, 2].map(|j| shift[j] - first[j]));
    row
}

/// Points with coordinates from 0 to 1 that are multiples of a step, and other places from -1 to 2.
fn check<G: Moving>(seed: u64, n: usize, step: f64, basis: &[G::Point], most: i64) {
    let context = format!("seed {seed}, {n} points, {step}, {basis:?}");
    let rng = &mut Rng::new(seed);
    let at = |rng: &mut Rng, step: f64, least: f64, extent: f64| {
        let mut p = G::Point::default();
        (0..G::D).for_each(|axis| {
            let x = least + extent * rng.below(1 << 20) as f64 / f64::from(1 << 20);
            p[axis] = (x / step).round() * step;
        });
        p
    };
    let points: Vec<G::Point> = (0..n).map(|_| at(rng, step, 0.0, 1.0)).collect();
    let t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
    let (mut places, mut of) = (Vec::new(), Vec::new());
    let range = |j: usize| if j < basis.len() { -most..=most } else { 0..=0 };
    for x in range(0) {
        for y in range(1) {
            for z in range(2) {
                for (v, p) in points.iter().enumerate() {
                    let mut place = *p;
                    for (vector, k) in basis.iter().zip([x, y, z]) {
                        (0..G::D).for_each(|axis| place[axis] += k as f64 * vector[axis]);
                    }
                    of.push((v, [x, y, z]));
                    places.push(place);
                }
            }
        }
    }
    let keys: Vec<u64> = of.iter().map(|&(v, _)| v as u64).collect();
    let open = MovingTriangulation::<G>::with_keys(&places, &keys, Options::default()).unwrap();
    let values: Vec<f64> = (0..n).map(|_| rng.below(1 << 20) as f64 / f64::from(1 << 20)).collect();
    let of_copies: Vec<f64> = of.iter().map(|&(v, _)| values[v]).collect();
    let asked: Vec<G::Point> =
        (0..12).map(|k| at(rng, if k < 6 { 0.5 * step } else { 1e-6 }, -0.5, 2.0)).collect();
    // On the grid, as the triangulation has them.
    let asked: Vec<G::Point> = asked
        .iter()
        .map(|p| {
            let mut p = *p;
            (0..G::D).for_each(|axis| p[axis] = (p[axis] * f64::from(1 << 24)).round() / f64::from(1 << 24));
            p
        })
        .collect();

    let (mut found, mut expected) = (Vec::new(), Vec::new());
    let method = Interpolation::NaturalNeighbour;
    let (given, given_copies) =
        (VertexValues { values: &values, n_values: 1 }, VertexValues { values: &of_copies, n_values: 1 });
    t.interpolate(method, given, &asked, None, |row| found.push(row.map(|row| row[0]))).unwrap();
    open.interpolate(method, given_copies, &asked, None, |row| expected.push(row.map(|row| row[0]))).unwrap();
    for (p, (found, expected)) in asked.iter().zip(found.iter().zip(&expected)) {
        let is_same = match (found, expected) {
            (Some(x), Some(y)) => (x - y).abs() < 1e-9,
            (found, expected) => found == expected,
        };
        assert!(is_same, "{context}: {p:?} {found:?} {expected:?}");
    }

    let view = t.cells().unwrap();
    let shifts: Vec<[i64; 3]> = t.cell_shifts().unwrap().collect();
    let names: Vec<Name> = view
        .corners
        .iter()
        .enumerate()
        .map(|(c, row)| {
            let shifts = &shifts[c * (G::D + 1)..];
            name_of(row.as_ref().iter().zip(shifts).map(|(v, &shift)| (v.index(), shift)).collect())
        })
        .collect();
    let open_cells = open.cells().unwrap();
    for p in &asked {
        let found = match t.conflicts(p, None) {
            Err(Error::OutsideOfPeriodic { argument: "position" }) => {
                assert!(matches!(t.locate(p), Ok(Location::Outside(_))), "{context}: {p:?}");
                continue;
            }
            found => found.unwrap(),
        };
        assert!(!matches!(t.locate(p), Ok(Location::Outside(_))), "{context}: {p:?}");
        assert!(found.is_sorted_by(|a, b| a < b), "{context}: {p:?}");
        let found: BTreeSet<&Name> = found.iter().map(|cell| &names[cell.index()]).collect();
        let there: Vec<Name> = open
            .conflicts(p, None)
            .unwrap()
            .iter()
            .map(|&cell: &CellId| {
                name_of(open_cells.corners[cell].as_ref().iter().map(|v| of[v.index()]).collect())
            })
            .collect();
        assert_eq!(found, there.iter().collect(), "{context}: {p:?}");
    }
}

#[test]
fn zones_are_those_among_copies() {
    for seed in 0..24 {
        let n = [1, 2, 3, 5, 20, 60][seed as usize % 6];
        for step in [1.0 / f64::from(1 << 20), 0.125] {
            check::<Plane>(seed, n, step, &[[1.0, 0.0], [0.0, 1.0]], 3);
            check::<Plane>(seed, n, step, &[[1.0, 0.0], [0.375, 1.0]], 3);
            if seed < 8 {
                let n = n.min(8);
                check::<Space>(seed, n, step, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], 3);
                check::<Space>(seed, n, step, &[[1.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.25, -0.375, 1.0]], 3);
            }
        }
    }
}

/// Of sets that are open somewhere, in whose balls near the hull copies are farther away. The conflicts of places outside are not told.
#[test]
fn zones_of_slabs_are_those_among_copies() {
    for seed in 0..12 {
        let n = [3, 5, 20, 60][seed as usize % 4];
        check::<Plane>(seed, n, 0.125, &[[1.0, 0.0]], 12);
        check::<Space>(seed, n.min(20), 0.25, &[[0.0, 0.0, 1.0]], 12);
        if seed < 4 {
            check::<Space>(seed, n.min(20), 0.25, &[[1.0, 0.0, 0.0], [0.25, 1.0, 0.0]], 5);
        }
    }
}
