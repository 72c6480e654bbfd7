//! Beside whole numbers: distances of all images that can be nearest, and weights as quotients of volumes.

use super::locating::{OF_PLANE, OF_SPACE, corners, points_of_kind, position};
use super::*;
use crate::ids::CellId;
use crate::motion::{Interpolation, Location, VertexValues};

/// All coordinates of these tests are multiples of its inverse.
const SCALE: f64 = (1u64 << 22) as f64;

fn whole<G: Moving>(p: &G::Point) -> [i128; 3] {
    [0, 1, 2].map(|axis| if axis < G::D { (p[axis] * SCALE) as i128 } else { 0 })
}

/// The squares of the distances of the nearest images of all vertices, in order, and of the same the lower id first.
fn by_distance<G: Moving>(t: &PeriodicTriangulation<G>, p: &G::Point) -> Vec<(i128, VertexId)> {
    let unit = |j: usize| [0, 1, 2].map(|i| i32::from(i == j));
    let vectors = [0, 1, 2].map(|j| whole::<G>(&t.lattice.translated(&G::Point::default(), unit(j))));
    let mut squares: Vec<_> = VertexId::range(0..t.id_count())
        .filter_map(|v| t.position(v).ok().map(|q| (v, q)))
        .map(|(v, q)| {
            let mut way = *p;
            (0..G::D).for_each(|axis| way[axis] -= q[axis]);
            let middle = t.lattice.multiples(&way).map(|x| x.round() as i128);
            let ways = [whole::<G>(p), whole::<G>(&q)];
            let range = |j: usize| if j < t.vector_count() { -4..=4 } else { 0..=0 };
            let mut least = i128::MAX;
            for (x, y, z) in super::super::inside::all(range(0), range(1), range(2)) {
                let by = [middle[0] + i128::from(x), middle[1] + i128::from(y), middle[2] + i128::from(z)];
                let square = (0..3).map(|axis| {
                    let shift: i128 = (0..3).map(|j| by[j] * vectors[j][axis]).sum();
                    (ways[0][axis] - ways[1][axis] - shift).pow(2)
                });
                least = least.min(square.sum());
            }
            (least, v)
        })
        .collect();
    squares.sort_unstable();
    squares
}

fn check_near<G: Moving>(t: &PeriodicTriangulation<G>, p: &G::Point, rng: &mut Rng) {
    let squares = by_distance(t, p);
    assert_eq!(t.nearest_vertex(p), Ok(squares.first().map(|&(_, v)| v)), "{p:?}");
    for k in [1, 3, squares.len() + 2] {
        let mut found = Vec::new();
        t.nearest_vertices(&[*p, *p], k, |v| found.push(v)).unwrap();
        let expected: Vec<_> =
            squares.iter().map(|&(_, v)| v).chain(std::iter::repeat(VertexId::NONE)).take(k).collect();
        assert!(found == [&expected[..], &expected].concat(), "{k} near {p:?}: {found:?} {expected:?}");
    }
    for _ in 0..3 {
        let mut radius = squares[rng.below(squares.len())].0 as f64;
        radius += [-1.0, 0.0, 0.0, 1e9][rng.below(4)];
        let radius = radius.max(0.0);
        let mut expected: Vec<_> =
            squares.iter().filter(|&&(square, _)| square <= radius as i128).map(|&(_, v)| v).collect();
        expected.sort_unstable();
        let found = t.vertices_in_ball(p, radius / (SCALE * SCALE)).unwrap();
        assert!(found == expected, "{radius} around {p:?}: {found:?} {expected:?}");
    }
    assert_eq!(t.vertices_in_ball(p, f64::INFINITY).unwrap().len(), squares.len());
}

/// Volumes of a cell with a place for each of its corners in turn, and of the cell.
fn volumes<G: Moving>(corners: &[G::Point], p: &G::Point) -> (Vec<i128>, i128) {
    let volume = |points: &[G::Point]| {
        let at: Vec<_> = points.iter().map(whole::<G>).collect();
        let row = |i: usize| [0, 1, 2].map(|axis| at[i][axis] - at[0][axis]);
        let [a, b] = [row(1), row(2)];
        if G::D == 2 {
            return a[0] * b[1] - a[1] * b[0];
        }
        let c = row(3);
        let minor = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
        -(a[0] * minor(1, 2) - a[1] * minor(0, 2) + a[2] * minor(0, 1))
    };
    let sign = volume(corners).signum();
    let of = |i: usize| {
        let mut replaced = corners.to_vec();
        replaced[i] = *p;
        sign * volume(&replaced)
    };
    ((0..corners.len()).map(of).collect(), sign * volume(corners))
}

fn check_values<G: Moving>(
    t: &PeriodicTriangulation<G>,
    points: &[G::Point],
    basis: &[G::Point],
    positions: &[G::Point],
    rng: &mut Rng,
) {
    let values: Vec<f64> = (0..2 * points.len()).map(|_| rng.below(1 << 20) as f64 / 1e6).collect();
    let given = VertexValues { values: &values, n_values: 2 };
    let mut located = Vec::new();
    t.locate_in_period(positions, None, |location, shift| located.push((location, shift))).unwrap();
    let mut n_told = 0;
    t.interpolate(Interpolation::Linear, given, positions, None, |found| {
        let (p, (location, shift)) = (&positions[n_told], located[n_told]);
        n_told += 1;
        let (vertices, weights) = match location {
            Location::Vertex(v) => (vec![v], vec![1.0]),
            Location::Cell(cell) => {
                let (parts, sum) = volumes::<G>(&corners(t, points, basis, cell, shift), p);
                let row = t.cells().unwrap().corners[cell];
                (row.as_ref().to_vec(), parts.iter().map(|&part| part as f64 / sum as f64).collect())
            }
            Location::Outside(_) | Location::NoCells => return assert!(found.is_none()),
        };
        for (k, &value) in found.unwrap().iter().enumerate() {
            let expected: f64 =
                vertices.iter().zip(&weights).map(|(v, w)| w * values[2 * v.index() + k]).sum();
            assert!((value - expected).abs() < 1e-6, "{value} {expected}");
        }
    })
    .unwrap();
    assert_eq!(n_told, positions.len());
    let cells: Vec<CellId> = located
        .iter()
        .map(|&(location, _)| if let Location::Cell(cell) = location { cell } else { CellId::NONE })
        .collect();
    let mut n_told = 0;
    t.barycentric(positions, &cells, |found| {
        let (p, (location, shift)) = (&positions[n_told], located[n_told]);
        n_told += 1;
        let Location::Cell(cell) = location else { return assert!(found.is_none()) };
        let (parts, sum) = volumes::<G>(&corners(t, points, basis, cell, shift), p);
        let found = found.expect("the cell has the place");
        if parts.contains(&0) {
            // Two translations of it may have the place on their boundary.
            assert!((found.iter().sum::<f64>() - 1.0).abs() < 1e-12 && found.iter().all(|&w| w >= 0.0));
            return;
        }
        for (&weight, &part) in found.iter().zip(&parts) {
            let expected = part as f64 / sum as f64;
            assert!((weight - expected).abs() <= 3e-13 * expected, "{weight} {expected}");
        }
    })
    .unwrap();
    assert_eq!(n_told, positions.len());
}

fn check_all<G: Moving>(seed: u64, basis: &[G::Point], n: usize) {
    let rng = &mut Rng::new(seed);
    let mut points = points_of_kind::<G>(rng, n, basis);
    let mut t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
    for step in 0..3 {
        let positions: Vec<G::Point> = (0..12).map(|_| position::<G>(rng, &points, basis)).collect();
        positions.iter().for_each(|p| check_near(&t, p, rng));
        check_values(&t, &points, basis, &positions, rng);
        if step == 0 {
            for p in &mut points {
                (0..G::D).for_each(|axis| p[axis] += (rng.below(64) as f64 - 31.0) / 512.0);
            }
            t.commit_positions(&points).unwrap();
        } else if n > 2 {
            t.stage_removals(&[VertexId::at(rng.below(n / 2))]).unwrap();
            t.stage_insertions(&[points[n - 1]]).unwrap();
            t.commit_timestamp().unwrap();
            points.push(points[n - 1]);
            break;
        }
    }
    let positions: Vec<G::Point> = (0..12).map(|_| position::<G>(rng, &points[n / 2..], basis)).collect();
    positions.iter().for_each(|p| check_near(&t, p, rng));
    check_values(&t, &points, basis, &positions, rng);
}

#[test]
fn what_is_near_is_what_is_nearest_of_all_images() {
    for seed in 0..48 {
        let n = [1, 2, 3, 4, 7, 20, 40, 120][seed as usize / 6];
        check_all::<Plane>(seed, OF_PLANE[seed as usize % 6], n);
        check_all::<Space>(seed, OF_SPACE[seed as usize % 6], n.min(40));
    }
}

#[test]
fn what_cannot_be_asked_is_told() {
    type Periodic = PeriodicTriangulation<Plane>;
    let square = [[1.0, 0.0], [0.0, 1.0]];
    let empty = Periodic::new(&[], &square, Options::default()).unwrap();
    assert_eq!(
        (empty.nearest_vertex(&[0.5; 2]), empty.vertices_in_ball(&[0.5; 2], 9.0)),
        (Ok(None), Ok(vec![]))
    );
    empty.nearest_vertices(&[[0.5; 2]], 2, |v| assert_eq!(v, VertexId::NONE)).unwrap();
    let t = Periodic::new(&[[0.5, 0.5]], &square, Options::default()).unwrap();
    let negative = t.vertices_in_ball(&[0.5; 2], -1.0);
    assert!(matches!(negative, Err(Error::InvalidValue { argument: "squared_radius", .. })));
    let nan = t.vertices_in_ball(&[0.5, f64::NAN], 1.0);
    assert!(matches!(nan, Err(Error::NotFinite { argument: "centre", axis: 1, .. })));
    let far = t.nearest_vertices(&[[0.0; 2], [1e99, 0.0]], 1, |_| panic!("nothing is told"));
    assert!(matches!(far, Err(Error::OutOfRange { argument: "positions", index: 1, .. })));
    let given = VertexValues { values: &[1.0; 3], n_values: 1 };
    let wrong = t.interpolate(Interpolation::Linear, given, &[[0.0; 2]], None, |_| panic!("nothing is told"));
    assert!(matches!(wrong, Err(Error::WrongCount { given: 3, wanted: 1, .. })));
    let other = t.barycentric(&[[0.0; 2]], &[CellId::new(2)], |_| panic!("nothing is told"));
    assert!(matches!(other, Err(Error::NoSuchCell { index: 0, cells: 2, .. })));
    let few = t.barycentric(&[[0.0; 2]], &[], |_| panic!("nothing is told"));
    assert!(matches!(few, Err(Error::WrongCount { .. })));
    // A cell of which no translation has the place.
    let t = Periodic::new(&[[0.0; 2], [0.5, 0.25]], &square, Options::default()).unwrap();
    let Ok(Location::Cell(at)) = t.locate(&[0.55, 0.15]) else { panic!("it is at no vertex") };
    let other = CellId::range(0..4).find(|&cell| cell != at).unwrap();
    t.barycentric(&[[0.55, 0.15]], &[other], |found| assert!(found.is_none())).unwrap();
}
