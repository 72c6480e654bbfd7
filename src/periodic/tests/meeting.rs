//! Simplices, stars in order, tolerances, masks without flat cells and released cells, beside a look at all cells and at copies.

use super::*;
use crate::ids::CellId;

/// Whether a row has each of these vertices as another corner.
fn has_each(row: &[VertexId], wanted: &[VertexId]) -> bool {
    let mut left = row.to_vec();
    wanted.iter().all(|v| left.iter().position(|w| w == v).map(|at| left.swap_remove(at)).is_some())
}

/// A set of which vertex 3 is hidden by vertex 1 in another period.
fn set<G: Moving>(rng: &mut Rng, n: usize, basis: &[G::Point]) -> Vec<G::Point> {
    let mut points = random_points::<G>(rng, n, basis);
    if n > 3 {
        points[3] = place::<G>(&points, basis, 1, [1, 0, 0]);
    }
    points
}

fn check_simplices<G: Moving>(seed: u64, n: usize, basis: &[G::Point]) -> usize {
    let rng = &mut Rng::new(seed);
    let points = set::<G>(rng, n, basis);
    let t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
    let corners = t.cells().unwrap().corners;
    let mut n_found = 0;
    for n_corners in 1..=G::D + 1 {
        let mut all = Vec::new();
        for _ in 0..200 {
            // Half of them are of a cell.
            let cell = corners[rng.below(corners.len())].as_ref();
            let is_of_cell = rng.below(2) == 0;
            all.extend(
                cell[..n_corners].iter().map(|&v| if is_of_cell { v } else { VertexId::at(rng.below(n)) }),
            );
        }
        let shown: Vec<_> = all.iter().map(|&v| t.coincident_representative(v).unwrap()).collect();
        let mut check = |asked: &[VertexId], shown: &[VertexId]| {
            let mut found = Vec::new();
            t.find_simplices(asked, n_corners, |cell| found.push(cell)).unwrap();
            for (cell, wanted) in found.iter().zip(shown.chunks_exact(n_corners)) {
                let is_there = corners.iter().any(|row| has_each(row.as_ref(), wanted));
                assert_eq!(cell.is_some(), is_there, "seed {seed}: {wanted:?}");
                n_found += usize::from(is_there);
                assert!(cell.is_none_or(|cell| has_each(corners[cell].as_ref(), wanted)));
            }
        };
        // Many at once, and few.
        check(&all, &shown);
        all.chunks_exact(n_corners)
            .zip(shown.chunks_exact(n_corners))
            .for_each(|(one, shown)| check(one, shown));
    }
    n_found
}

#[test]
fn simplices_are_found() {
    let mut n_found = 0;
    for seed in 0..12 {
        let n = [1, 2, 5, 40][seed as usize % 4];
        n_found += check_simplices::<Plane>(seed, n, &[[1.0, 0.0], [0.25, 1.0]]);
        n_found += check_simplices::<Plane>(seed, n + 4, &[[1.0, 0.0]]);
        n_found += check_simplices::<Space>(seed, n, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.25, 0.0, 1.0]]);
    }
    assert!(n_found > 10_000, "{n_found}");
    let t = PeriodicTriangulation::<Plane>::new(&[[0.0; 2]], &[[1.0, 0.0], [0.0, 1.0]], Options::default())
        .unwrap();
    let v = VertexId::new;
    let asked = |vertices: &[VertexId], n| t.find_simplices(vertices, n, |_| panic!("nothing is told"));
    assert!(matches!(asked(&[v(0)], 4), Err(Error::InvalidValue { .. })));
    assert!(matches!(asked(&[v(0)], 2), Err(Error::WrongCount { .. })));
    assert!(matches!(asked(&[v(0), v(1)], 2), Err(Error::NoSuchVertex { index: 1, .. })));
}

#[test]
fn stars_are_in_order() {
    let (mut n_open, mut n_closed) = (0, 0);
    for seed in 0..40 {
        let rng = &mut Rng::new(seed);
        let bases: [&[[f64; 2]]; 2] = [&[[1.0, 0.0], [0.25, 1.0]], &[[1.0, 0.5]]];
        let basis = bases[seed as usize % 2];
        let n = [1, 2, 5, 40][seed as usize / 2 % 4] + 4 * (2 - basis.len());
        let points = set::<Plane>(rng, n, basis);
        let t = PeriodicTriangulation::<Plane>::new(&points, basis, Options::default()).unwrap();
        let cells = t.cells().unwrap();
        let shifts: Vec<_> = t.cell_shifts().unwrap().collect();
        let place_of = |cell: CellId, corner: usize| {
            let v = cells.corners[cell][corner];
            place::<Plane>(&points, basis, v.get(), shifts[3 * cell.index() + corner])
        };
        for vertex in VertexId::range(0..n) {
            let star: Vec<_> = t.ordered_star(vertex).unwrap().collect();
            let mut sorted = star.clone();
            sorted.sort_unstable();
            assert_eq!(sorted, t.star(vertex).unwrap(), "seed {seed}");
            let shown = t.coincident_representative(vertex).unwrap();
            // Each begins where the one before ends, as seen from the vertex; of its corners that are the vertex the first that
            // has not been met there. Which one the star begins at is tried.
            let chain = |first: usize| {
                let (mut met, mut ways) = (BTreeSet::new(), Vec::<[[f64; 2]; 2]>::new());
                for &cell in &star {
                    let fits = |k: &usize| cells.corners[cell][*k] == shown && !met.contains(&(cell, *k));
                    let seen = |k: usize, step: usize| {
                        let (at, to) = (place_of(cell, k), place_of(cell, (k + step) % 3));
                        [to[0] - at[0], to[1] - at[1]]
                    };
                    let follows = |k: &usize| match ways.last() {
                        None => *k == first,
                        Some(&[_, end]) => is_near(seen(*k, 1), end),
                    };
                    let k = (0..3).filter(fits).find(follows)?;
                    met.insert((cell, k));
                    ways.push([seen(k, 1), seen(k, 2)]);
                }
                Some([ways[0][0], ways[ways.len() - 1][1]])
            };
            let [begin, end] = (0..3).find_map(chain).expect("each follows the one before");
            let is_closed = is_near(begin, end);
            (n_open, n_closed) = (n_open + u32::from(!is_closed), n_closed + u32::from(is_closed));
            if is_closed {
                assert_eq!(star[0], sorted[0], "from the lowest one");
            } else {
                let on_hull = |&cell: &CellId| cells.neighbours[cell].contains(&NO_CELL);
                assert!(on_hull(&star[0]) && on_hull(star.last().unwrap()));
            }
        }
    }
    assert!(n_open > 40 && n_closed > 300, "{n_open} {n_closed}");
}

fn is_near(a: [f64; 2], b: [f64; 2]) -> bool {
    (a[0] - b[0]).abs() + (a[1] - b[1]).abs() < 1e-9
}

/// All move by less than the least tolerance: the cells stay.
fn check_tolerances<G: Moving>(seed: u64, n: usize, basis: &[G::Point]) {
    let rng = &mut Rng::new(seed);
    let mut points = Vec::new();
    for _ in 0..n {
        let mut p = G::Point::default();
        (0..G::D).for_each(|axis| p[axis] = rng.unit());
        points.push(p);
    }
    let t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
    let tolerances: Vec<f64> = VertexId::range(0..n).map(|v| t.tolerance(v).unwrap()).collect();
    let least = tolerances.iter().copied().fold(f64::INFINITY, f64::min);
    let is_closed = basis.len() == G::D;
    // A vertex that makes a side of a strip's hull alone is on a line with its images.
    assert!((least > 1e-9 || !is_closed) && least < 1.0, "{tolerances:?}");
    let (before, home) = (classes::<G>(&t, &points, basis), points.clone());
    for _ in 0..if is_closed { 10 } else { 0 } {
        for p in &mut points {
            // Of a way that is shorter than the least tolerance by the rounding to the grid.
            let share = 0.99 / (G::D as f64).sqrt() * least;
            (0..G::D).for_each(|axis| p[axis] += (2.0 * rng.unit() - 1.0) * share);
        }
        let moved = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
        assert_eq!(classes::<G>(&moved, &points, basis), before, "seed {seed}");
        points.clone_from(&home);
    }
    // A tolerance is of the bi-cells around its vertex: copies have it, too.
    let (all, middle) = copies::<G>(&points, basis);
    let open = MovingTriangulation::<G>::new(&all, Options::default()).unwrap();
    for (v, tolerance) in tolerances.into_iter().enumerate() {
        let of_copy = open.tolerance(VertexId::at(middle + v)).unwrap();
        assert!((of_copy - tolerance).abs() < 1e-9, "seed {seed}: {of_copy} {tolerance}");
    }
}

/// Copies in periods from -2 to 2, and the number of the first that is not translated.
fn copies<G: Moving>(points: &[G::Point], basis: &[G::Point]) -> (Vec<G::Point>, usize) {
    let range = |j: usize| if j < basis.len() { -2..=2 } else { 0..=0 };
    let (mut all, mut middle) = (Vec::new(), 0);
    for (x, y) in range(0).flat_map(|x| range(1).map(move |y| (x, y))) {
        for z in range(2) {
            if [x, y, z] == [0; 3] {
                middle = all.len();
            }
            all.extend((0..points.len() as u32).map(|v| place::<G>(points, basis, v, [x, y, z])));
        }
    }
    (all, middle)
}

#[test]
fn tolerances_are_those_of_copies() {
    for seed in 0..8 {
        check_tolerances::<Plane>(seed, 12, &[[1.0, 0.0], [0.25, 1.0]]);
        check_tolerances::<Plane>(seed, 12, &[[1.0, 0.0]]);
        check_tolerances::<Space>(seed, 10, &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.25, 0.0, 1.0]]);
    }
    let points = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.25]];
    let t =
        PeriodicTriangulation::<Plane>::new(&points, &[[1.0, 0.0], [0.0, 1.0]], Options::default()).unwrap();
    assert_eq!([0, 1].map(|v| t.tolerance(VertexId::new(v)).unwrap()), [0.0; 2], "they share a place");
    assert!(matches!(t.tolerance(VertexId::new(3)), Err(Error::NoSuchVertex { .. })));
}

#[test]
fn flat_cells_are_left_out_along_the_hull_alone() {
    // A strip of which the lower side is straight but for rounding, and which has a flat cell in the middle as well.
    let mut points = vec![[0.0, 0.0], [0.2, 1e-13], [0.45, 0.0], [0.7, 2e-13]];
    points.extend([[0.1, 1.0], [0.3, 0.5], [0.31, 0.5 + 1e-13], [0.32, 0.5], [0.6, 0.5], [0.8, 1.0]]);
    let strip = [[1.0, 0.0]];
    let t = PeriodicTriangulation::<Plane>::new(&points, &strip, Options::default()).unwrap();
    let mask = t.mask_without_flat_cells(1e-9).unwrap();
    let cells = t.cells().unwrap();
    let is_low = |row: &[VertexId; 3]| row.iter().all(|v| v.index() < 4);
    for (row, &stays) in cells.corners.iter().zip(&mask) {
        assert_eq!(stays == 0, is_low(row), "{row:?}");
    }
    assert!(mask.contains(&0) && mask.contains(&1));
    assert_eq!(t.mask_without_flat_cells(0.0).unwrap(), vec![1; mask.len()]);
    assert!(matches!(t.mask_without_flat_cells(f64::NAN), Err(Error::InvalidValue { .. })));
    // Without a hull all stay.
    let closed =
        PeriodicTriangulation::<Plane>::new(&points, &[[1.0, 0.0], [0.0, 2.0]], Options::default()).unwrap();
    let mask = closed.mask_without_flat_cells(1e-9).unwrap();
    assert!(!mask.is_empty() && !mask.contains(&0));
}

#[test]
fn released_cells_stay_as_they_are() {
    let square = [[1.0, 0.0], [0.0, 1.0]];
    let points = random_points::<Plane>(&mut Rng::new(3), 30, &square);
    let mut t = PeriodicTriangulation::<Plane>::new(&points, &square, Options::default()).unwrap();
    let rows = t.cells().unwrap().corners.as_ptr();
    let released = t.release_cells().unwrap();
    assert_eq!(released.corners.as_ptr(), rows, "what has been looked at is handed over");
    let again = t.cells().unwrap();
    assert!(again.corners == released.corners && again.neighbours == released.neighbours);
    let before = released.clone();
    t.move_vertices(&[VertexId::new(0)], &[[0.5, 0.5]]).unwrap();
    t.commit_timestamp().unwrap();
    assert!(t.cells().unwrap().corners != released.corners);
    assert!(released.corners == before.corners && released.neighbours == before.neighbours);
}
