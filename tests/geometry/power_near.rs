//! What is near a place, with weights: the vertex of least power, and vertices by distance, whether weights hide them
//! or not; cells in conflict; values between vertices.

use super::power_cells::{build, weighted};
use crate::common::{Rng, cell_set};
use crate::exact_oracle::decode;
use deldrift::internals::predicates::{WeightedPoint, compare_power};
use deldrift::internals::{PowerPlane, PowerSpace};
use deldrift::motion::{Interpolation, ListsOf, Location, MovingTriangulation, TransferOrder, VertexValues};
use deldrift::{CellId, Error, Moving, VertexId};
use num_bigint::BigInt;
use std::cmp::Ordering;

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

/// What meets what: the lists of shown vertices are those of the cells, those of hidden ones are empty.
fn check_incidence<G: Moving>() {
    for_sets::<G>(4, |(points, _, t), rng| {
        let hidden = t.vertices_hidden_by_weight().expect("room");
        let corners = t.cells().expect("room").corners;
        let around = |v: VertexId| -> Vec<CellId> {
            CellId::range(0..corners.len()).filter(|&cell| corners[cell].as_ref().contains(&v)).collect()
        };
        let (cells, neighbours) = (t.vertex_cells().expect("room"), t.vertex_neighbours().expect("room"));
        let first = t.cell_of_each_vertex().expect("room");
        assert_eq!(t.edges().expect("room").len(), t.edge_count());
        assert_eq!(neighbours.entries.len(), 2 * t.edge_count());
        let mut star = Vec::new();
        for v in VertexId::range(0..points.len()) {
            let wanted = around(v);
            assert_eq!(cells.row(v), wanted);
            assert!(corners.is_empty() || wanted.is_empty() == hidden.contains(&v));
            assert_eq!(first[v], wanted.first().copied().unwrap_or(CellId::NONE));
            t.star(v, &mut star).expect("room");
            star.sort_unstable();
            // What is hidden by place has the star of what is seen there.
            let seen = t.coincident_representative(v).expect("room");
            assert_eq!(star, around(seen));
            assert_eq!(t.cells_around(&[v]).expect("room"), wanted);
            t.find_simplices(&[v], 1, |cell| assert_eq!(cell.is_some(), !wanted.is_empty())).expect("room");
            let w = VertexId::at(rng.below(points.len()));
            let is_edge = v != w && wanted.iter().any(|&cell| corners[cell].as_ref().contains(&w));
            if v != w {
                t.find_simplices(&[v, w], 2, |cell| assert_eq!(cell.is_some(), is_edge)).expect("room");
            }
            assert_eq!(t.tolerance(v).expect("room") > 0.0 || t.cell_count() == 0, t.tolerance(v) != Ok(0.0));
            let same = |w: &VertexId| points[w.index()].as_ref() == points[v.index()].as_ref();
            let heaviest = VertexId::range(0..points.len())
                .filter(same)
                .min_by(|&w, &x| points[x.index()][G::D].total_cmp(&points[w.index()][G::D]).then(w.cmp(&x)));
            assert_eq!(t.coincident_representative(v).ok(), heaviest, "{points:?}");
        }
        assert!(t.annulus_widths().expect("room").iter().all(|width| width.is_nan()));
        // All hull facets are those of the cells, and masks by a bound of the power of a centre are as good as these
        // are known.
        let mut n_hull = 0;
        t.hull_facets(|_| n_hull += 1).expect("room");
        assert_eq!(n_hull, t.hull_facet_count());
        let spheres: Vec<_> = t.circumspheres().expect("room").collect();
        for (row, (centre, squared)) in corners.iter().zip(&spheres) {
            for &v in row.as_ref() {
                let p = &points[v.index()];
                let apart: f64 = (0..G::D).map(|k| (centre[k] - p[k]).powi(2)).sum();
                assert!(
                    (apart - p[G::D] - squared).abs() <= 1e-6 * (1.0 + apart + p[G::D].abs()),
                    "{points:?}"
                );
            }
        }
        for bound in [f64::NEG_INFINITY, -f64::MAX, -5.0, 0.0, 7.5, f64::MAX, f64::INFINITY] {
            let mask: Vec<bool> = t.mask_by_circumradius(bound).expect("a bound").collect();
            for (is_within, (_, squared)) in mask.into_iter().zip(&spheres) {
                let is_near = (squared - bound).abs() <= 1e-6 * (1.0 + squared.abs());
                assert!(is_near || is_within == (*squared <= bound), "{squared} {bound}");
            }
        }
        assert!(t.mask_by_circumradius(f64::NAN).is_err());
        let mut written = 0;
        t.write_vtu::<Error>(&[], &[], |bytes| {
            written += bytes.len();
            Ok(())
        })
        .expect("room");
        assert!(written > 0);
    });
}

#[test]
fn incidence_is_that_of_the_cells() {
    check_incidence::<PowerPlane>();
    check_incidence::<PowerSpace>();
}

/// Stars in the plane follow each other around a vertex.
#[test]
fn stars_are_in_order() {
    for_sets::<PowerPlane>(5, |(points, _, t), _| {
        for v in VertexId::range(0..points.len()) {
            let (mut ordered, mut star) = (t.ordered_star(v).expect("room").collect::<Vec<_>>(), Vec::new());
            t.star(v, &mut star).expect("room");
            ordered.sort_unstable();
            star.sort_unstable();
            assert_eq!(ordered, star);
        }
    });
}

/// Means in cells go on to those that come when weights change: constants stay, and contents.
fn check_transfer<G: Moving>() {
    let rng = &mut Rng::new(6);
    let n = 60;
    let mut points: Vec<G::Point> = (0..n)
        .map(|_| {
            let weight = 2.0 * rng.unit();
            weighted::<G>(weight, |_| 10.0 * rng.unit())
        })
        .collect();
    // Corners far away, so that the hull stays.
    for k in 0..1 << G::D {
        points.push(weighted::<G>(0.0, |axis| if k >> axis & 1 == 1 { 20.0 } else { -10.0 }));
    }
    let mut t = build::<G>(&points);
    t.take_changes().expect("room");
    for order in [TransferOrder::First, TransferOrder::Second] {
        for step in 0..20 {
            let mut means: Vec<f64> = (0..t.cell_count()).flat_map(|_| [1.0, rng.unit()]).collect();
            let content = |t: &MovingTriangulation<G>, means: &[f64]| -> f64 {
                t.volumes().expect("room").zip(means.chunks(2)).map(|(volume, mean)| volume * mean[1]).sum()
            };
            let before = points.clone();
            for p in points.iter_mut().take(n) {
                p[G::D] = if step % 3 == 0 { 6.0 } else { 2.0 } * rng.unit();
            }
            let was = content(&t, &means);
            t.move_vertices(&VertexId::range(0..n).collect::<Vec<_>>(), &points[..n]).expect("good places");
            t.commit_timestamp().expect("room");
            t.take_changes().expect("room");
            t.transfer_cells(Some(&before), order, 2, &mut means, &mut |_| true).expect("room");
            assert!(means.iter().step_by(2).all(|&x| x == 1.0));
            let now = content(&t, &means);
            assert!((now - was).abs() < 1e-9 * was, "{now}, not {was}");
        }
    }
}

#[test]
fn contents_stay_when_weights_change() {
    check_transfer::<PowerPlane>();
    check_transfer::<PowerSpace>();
}

/// The order of two powers, in exact integers.
fn exact_order(q: &[f64; 3], a: &WeightedPoint<3>, b: &WeightedPoint<3>) -> Ordering {
    let all = q.iter().chain(&a.place).chain(&b.place);
    let exponents = all.map(|&x| (x, 1)).chain([(a.weight, 2), (b.weight, 2)]).filter(|(x, _)| *x != 0.0);
    let unit = exponents.map(|(x, share)| decode(x).1.div_euclid(share)).min().unwrap_or(0);
    let integer = |x: f64, share: i32| {
        let (mantissa, exponent) = decode(x);
        if mantissa == 0 { BigInt::ZERO } else { BigInt::from(mantissa) << (exponent - share * unit) }
    };
    let power = |p: &WeightedPoint<3>| {
        let square =
            (0..3).map(|k| integer(p.place[k], 1) - integer(q[k], 1)).map(|x| &x * &x).sum::<BigInt>();
        square - integer(p.weight, 2)
    };
    power(a).cmp(&power(b))
}

/// Powers that tie or nearly do, of weights and places of any size.
#[test]
fn powers_are_compared_exactly() {
    let rng = &mut Rng::new(8);
    let (mut n_equal, mut n_near) = (0, 0);
    for case in 0..60_000 {
        let scale = [1.0, 1e-160, 1e-200, 1e50, 1e-3][case % 5];
        let mut coordinate = |_| match rng.below(3) {
            0 => scale * rng.within(-3, 3) as f64,
            1 => scale * (2.0 * rng.unit() - 1.0),
            _ => rng.within(-2, 2) as f64,
        };
        let [q, a, b]: [[f64; 3]; 3] = [(); 3].map(|()| std::array::from_fn(&mut coordinate));
        let square = |p: &[f64; 3]| (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>();
        let near = square(&b) - square(&a);
        // The weight that makes powers tie, but for rounding, a bit more or less.
        let of_b = if rng.one_in(3) {
            near + [0.0, 1.0, 5e-324][rng.below(3)]
        } else {
            near * (1.0 + f64::EPSILON * rng.within(-2, 2) as f64)
        };
        let of_a = [0.0, 1.0, 1e-300][rng.below(3)];
        let [a, b] = [(a, of_a), (b, of_b + of_a)].map(|(place, weight)| WeightedPoint { place, weight });
        let order = exact_order(&q, &a, &b);
        n_equal += usize::from(order == Ordering::Equal);
        n_near += usize::from(order != Ordering::Equal);
        assert_eq!(compare_power(&q, &a, &b), order, "{q:?} {a:?} {b:?}");
        assert_eq!(compare_power(&q, &b, &a), order.reverse());
        let other = WeightedPoint { weight: a.weight, ..b };
        assert_eq!(compare_power(&q, &a, &other), exact_order(&q, &a, &other));
    }
    assert!(n_equal > 100 && n_near > 500, "{n_equal} {n_near}");
}
