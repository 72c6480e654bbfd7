//! Lists of images near each vertex, beside all images in whole numbers.

use super::locating::{OF_PLANE, OF_SPACE, points_of_kind};
use super::*;
use crate::motion::ListsOf;

/// All coordinates of these tests are multiples of its inverse.
const SCALE: f64 = (1u64 << 22) as f64;

type Found = (VertexId, [i64; 3]);

/// The square of the distance of a vertex from the image of another one, whole.
fn square<G: Moving>(points: &[G::Point], basis: &[G::Point], v: usize, (w, shift): Found) -> i128 {
    let along = |axis: usize| {
        let whole = |x: f64| (x * SCALE) as i128;
        let by = basis.iter().zip(shift).map(|(b, n)| i128::from(n) * whole(b[axis]));
        whole(points[w.index()][axis]) + by.sum::<i128>() - whole(points[v][axis])
    };
    (0..G::D).map(|axis| along(axis).pow(2)).sum()
}

/// The lists by the definition, from all images that are so many periods away at most from the nearest one.
fn by_definition<G: Moving>(
    t: &PeriodicTriangulation<G>,
    points: &[G::Point],
    basis: &[G::Point],
    squared_radius: &dyn Fn(usize) -> Option<f64>,
    is_half: bool,
) -> Vec<Vec<Found>> {
    let range = |j: usize| if j < basis.len() { -MOST..=MOST } else { 0..=0 };
    let mut lists = vec![Vec::new(); points.len()];
    for (v, list) in lists.iter_mut().enumerate() {
        for w in 0..points.len() {
            let mut way = points[v];
            (0..G::D).for_each(|axis| way[axis] -= points[w][axis]);
            let middle = t.lattice.multiples(&way).map(|x| x.round() as i64);
            for (x, y, z) in super::super::inside::all(range(0), range(1), range(2)) {
                let by = [x, y, z].map(i64::from);
                let by = t.lattice.of_caller([0, 1, 2].map(|j| middle[j] + by[j]));
                let found = (VertexId::at(w), by);
                let square = square::<G>(points, basis, v, found);
                let is_near = |from| {
                    squared_radius(from).is_some_and(|r: f64| square <= (r * SCALE * SCALE).floor() as i128)
                };
                let is_in = if v == w && by == [0; 3] {
                    false
                } else if is_half && squared_radius(v).is_some() && squared_radius(w).is_some() {
                    (VertexId::at(v), [0; 3]) < found && (is_near(v) || is_near(w))
                } else {
                    is_near(v)
                };
                if is_in {
                    list.push(found);
                }
            }
        }
        list.sort_unstable();
    }
    lists
}

/// Radii are less than so many distances between the sides of the box.
const MOST: i32 = 3;

fn check_lists<G: Moving>(
    t: &PeriodicTriangulation<G>,
    points: &[G::Point],
    basis: &[G::Point],
    rng: &mut Rng,
) {
    let least = (0..basis.len()).map(|j| 1.0 / t.lattice.thickness()[j]).fold(f64::INFINITY, f64::min);
    for share in [0.1, 0.6, 2.2] {
        let n_radii = [1, points.len()][rng.below(2)];
        let mut radii = Vec::new();
        for _ in 0..n_radii {
            // A distance between two images, or a last place beside it.
            let mut shift = [0i64; 3];
            (0..basis.len()).for_each(|j| shift[j] = rng.below(3) as i64 - 1);
            let (v, w) = (rng.below(points.len()), rng.below(points.len()));
            let exact = square::<G>(points, basis, v, (VertexId::at(w), shift)) as f64 / (SCALE * SCALE);
            let near = [exact, exact.next_up(), exact.next_down().max(0.0)][rng.below(3)];
            let most = share * least;
            radii.push(if near <= most * most { near } else { most * most * rng.below(9) as f64 / 8.0 });
        }
        let mask: Vec<u8> = (0..points.len()).map(|_| rng.below(2) as u8).collect();
        for mask in [None, Some(&mask[..])] {
            let of = |v: usize| radii[if radii.len() == 1 { 0 } else { v }];
            let listed = |v: usize| mask.is_none_or(|mask| mask[v] != 0).then(|| of(v));
            for is_half in [false, true] {
                let wanted = ListsOf { squared_radii: &radii, mask, is_half };
                let found = t.neighbour_lists(&wanted).unwrap();
                let expected = by_definition::<G>(t, points, basis, &listed, is_half);
                for (v, expected) in expected.iter().enumerate() {
                    let range = found.offsets[v]..found.offsets[v + 1];
                    let list: Vec<Found> = range.map(|k| (found.neighbours[k], found.shifts[k])).collect();
                    assert!(&list == expected, "of {v}, half {is_half}: {list:?}, not {expected:?}");
                }
            }
        }
    }
}

fn check_kinds<G: Moving>(bases: [&[G::Point]; 6]) {
    for (k, basis) in bases.into_iter().enumerate() {
        for kind in 0..4 {
            let rng = &mut Rng::new(k as u64 * 16 + kind as u64);
            let mut points = points_of_kind::<G>(rng, [1, 2, 9, 14][(k + kind) % 4], basis);
            // In other periods, too.
            for p in &mut points {
                let j = rng.below(basis.len());
                (0..G::D).for_each(|axis| p[axis] += (rng.below(3) as f64 - 1.0) * basis[j][axis]);
            }
            let t = PeriodicTriangulation::<G>::new(&points, basis, Options::default()).unwrap();
            let (mut told, mut vectors) = (Vec::new(), Vec::new());
            told.extend(VertexId::range(0..points.len()).map(|v| t.position(v).unwrap()));
            vectors.extend(t.lattice.given());
            assert_eq!((&told, vectors.as_slice()), (&points, basis), "all are on the grid");
            check_lists(&t, &points, basis, rng);
        }
    }
}

#[test]
fn lists_are_of_all_images() {
    check_kinds::<Plane>(OF_PLANE);
    check_kinds::<Space>(OF_SPACE);
}

/// One vertex is its own neighbour, each way; of these half lists have one.
#[test]
fn a_vertex_is_near_its_own_images() {
    let t =
        PeriodicTriangulation::<Plane>::new(&[[7.25, -3.5]], &[[1.0, 0.0], [0.0, 1.0]], Options::default());
    let t = t.unwrap();
    let mut wanted = ListsOf { squared_radii: &[1.0], mask: None, is_half: false };
    let found = t.neighbour_lists(&wanted).unwrap();
    assert_eq!(found.shifts, [[-1, 0, 0], [0, -1, 0], [0, 1, 0], [1, 0, 0]]);
    wanted.is_half = true;
    assert_eq!(t.neighbour_lists(&wanted).unwrap().shifts, [[0, 1, 0], [1, 0, 0]]);
    wanted = ListsOf { squared_radii: &[64.0], ..wanted };
    assert_eq!(t.neighbour_lists(&wanted).unwrap().shifts.len(), 98);
    for endless in [f64::INFINITY, 1e300, 1e30] {
        let refused = t.neighbour_lists(&ListsOf { squared_radii: &[endless], ..wanted });
        assert!(matches!(refused, Err(Error::InvalidValue { argument: "squared_radii", index: 0, .. })));
    }
}
