//! What is near a place, with weights: the vertex of least power, and vertices by distance, whether weights hide them
//! or not; cells in conflict; values between vertices.

use super::power_cells::{build, weighted};
use crate::common::{Rng, cell_set};
use deldrift::internals::{PowerPlane, PowerSpace};
use deldrift::motion::{Interpolation, ListsOf, Location, MovingTriangulation, VertexValues};
use deldrift::{Moving, VertexId};

/// The square of the distance of integer places.
fn square<G: Moving>(p: &G::Point, q: &G::Point) -> i64 {
    (0..G::D).map(|k| (p[k] - q[k]) as i64).map(|x| x * x).sum()
}

/// A set of integer points, how far they reach, and what it is made of.
type Set<G> = (Vec<<G as deldrift::Shape>::Point>, i64, MovingTriangulation<G>);

/// Sets of integer places and weights: random ones, lattices, and those in one hyperplane.
fn for_sets<G: Moving>(seed: u64, mut visit: impl FnMut(&Set<G>, &mut Rng)) {
    let rng = &mut Rng::new(seed);
    for case in 0..120 {
        let (extent, n) = ([3, 40][case % 2], 1 + rng.below(40));
        let most = [0, 2, extent * extent / 2, 4 * extent * extent][case / 2 % 4];
        let is_flat = case % 7 == 0;
        let points: Vec<G::Point> = (0..n)
            .map(|_| {
                let weight = rng.within(-most, most) as f64;
                weighted::<G>(weight, |k| if is_flat && k == 0 { 1.0 } else { rng.within(0, extent) as f64 })
            })
            .collect();
        let t = build::<G>(&points);
        visit(&(points, extent, t), rng);
    }
}

fn place<G: Moving>(extent: i64, rng: &mut Rng) -> G::Point {
    let weight = rng.within(-20, 20) as f64;
    weighted::<G>(weight, |_| rng.within(-2, extent + 2) as f64)
}

fn check_near<G: Moving>() {
    let mut n_hidden = 0;
    for_sets::<G>(1, |(points, extent, t), rng| {
        let hidden = t.vertices_hidden_by_weight().expect("room");
        n_hidden += hidden.len();
        let all = || VertexId::range(0..points.len());
        for _ in 0..20 {
            let q = place::<G>(*extent, rng);
            let of = |v: VertexId| square::<G>(&q, &points[v.index()]);
            let power = |v: &VertexId| (of(*v) - points[v.index()][G::D] as i64, *v);
            let nearest = all().filter(|v| !hidden.contains(v)).min_by_key(power);
            assert_eq!(t.nearest_vertex(&q), Ok(nearest), "{q:?} of {points:?}");
            let mut by_distance: Vec<VertexId> = all().collect();
            by_distance.sort_by_key(|&v| (of(v), v));
            for k in [1, 4, points.len()] {
                let mut found = Vec::new();
                t.nearest_vertices(&[q], k, |v| found.push(v)).expect("room");
                by_distance
                    .iter()
                    .take(k)
                    .zip(&found)
                    .for_each(|(v, w)| assert_eq!(v, w, "{q:?}, {points:?}"));
                assert!(found.iter().skip(points.len()).all(|&v| v == VertexId::NONE));
            }
            let radius = rng.within(0, extent * extent);
            let inside: Vec<VertexId> = all().filter(|&v| of(v) <= radius).collect();
            assert_eq!(t.vertices_in_ball(&q, radius as f64), Ok(inside));
            let far = weighted::<G>(0.0, |k| q[k] + rng.within(-1, *extent) as f64);
            let in_box = |v: &VertexId| (0..G::D).all(|k| (q[k]..=far[k]).contains(&points[v.index()][k]));
            assert_eq!(t.vertices_in_box(&q, &far), Ok(all().filter(in_box).collect::<Vec<_>>()));
            match t.locate(&q).expect("room") {
                Location::Vertex(v) => assert!(of(v) == 0 && !hidden.contains(&v)),
                Location::NoCells => assert_eq!(t.cell_count(), 0),
                _ => assert!(all().all(|v| of(v) != 0 || hidden.contains(&v))),
            }
        }
        let wanted = ListsOf { squared_radii: &[9.0], mask: None, is_half: false };
        let lists = t.neighbour_lists(&wanted).expect("room");
        for v in all() {
            let near = |w: &VertexId| *w != v && square::<G>(&points[v.index()], &points[w.index()]) <= 9;
            let list = &lists.neighbours[lists.offsets[v.index()]..lists.offsets[v.index() + 1]];
            assert_eq!(list, all().filter(near).collect::<Vec<_>>());
        }
    });
    assert!(n_hidden > 500, "{n_hidden}");
}

#[test]
fn vertices_near_a_place_are_those_of_all() {
    check_near::<PowerPlane>();
    check_near::<PowerSpace>();
}

/// The cells that an insertion removes.
fn check_conflicts<G: Moving>() {
    let (mut n_none, mut n_some) = (0, 0);
    for_sets::<G>(2, |(points, extent, t), rng| {
        for _ in 0..6 {
            let mut q = place::<G>(*extent, rng);
            if rng.one_in(3) {
                let weight = q[G::D];
                q = *rng.pick(points);
                q[G::D] += weight;
            }
            let corners = t.cells().expect("room").corners;
            let mut found: Vec<Vec<VertexId>> = Vec::new();
            for cell in t.conflicts(&q, None).expect("room") {
                let mut row: Vec<VertexId> = corners[cell].as_ref().to_vec();
                row.sort_unstable();
                found.push(row);
            }
            found.sort();
            let before = cell_set(t);
            let mut other = t.try_clone(None).expect("room");
            other.insert_vertex(&q).expect("room");
            let after = cell_set(&other);
            let mut gone: Vec<Vec<VertexId>> =
                before.iter().filter(|row| !after.contains(*row)).map(|row| row.to_vec()).collect();
            gone.sort();
            assert_eq!(found, gone, "{q:?} in {points:?}");
            *(if gone.is_empty() { &mut n_none } else { &mut n_some }) += 1;
        }
    });
    assert!(n_none > 50 && n_some > 50, "{n_none} {n_some}");
}

#[test]
fn conflicts_are_the_cells_that_an_insertion_removes() {
    check_conflicts::<PowerPlane>();
    check_conflicts::<PowerSpace>();
}

/// Linear functions are reproduced, whatever the weight of a place; at the place of a vertex that is shown its value is
/// found.
fn check_values<G: Moving>() {
    for_sets::<G>(3, |(points, extent, t), rng| {
        let linear = |p: &G::Point| 2.0 + (0..G::D).map(|k| p[k] * (1.0 + k as f64)).sum::<f64>();
        let mut values: Vec<f64> = points.iter().map(linear).collect();
        // Those of hidden vertices are not read.
        t.vertices_hidden_by_weight().expect("room").iter().for_each(|v| values[v.index()] = f64::NAN);
        if t.cell_count() == 0 {
            return;
        }
        for method in [Interpolation::Linear, Interpolation::NaturalNeighbour] {
            let places: Vec<G::Point> = (0..20)
                .map(|_| {
                    let mut q = place::<G>(*extent, rng);
                    (0..G::D).for_each(|k| q[k] += 0.25 * rng.below(4) as f64);
                    q
                })
                .chain(points.iter().copied())
                .collect();
            let mut k = 0;
            let given = VertexValues { values: &values, n_values: 1 };
            t.interpolate(method, given, &places, None, |found| {
                if let Some(found) = found {
                    let wanted = linear(&places[k]);
                    assert!(
                        (found[0] - wanted).abs() < 1e-9 * (1.0 + wanted),
                        "{found:?}, not {wanted}: {method:?}"
                    );
                }
                k += 1;
            })
            .expect("room");
        }
    });
}

#[test]
fn linear_functions_are_reproduced() {
    check_values::<PowerPlane>();
    check_values::<PowerSpace>();
}
