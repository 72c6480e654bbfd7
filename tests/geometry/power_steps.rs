//! Power cells of vertices that move and whose weights change, of vertices in one hyperplane, and at the ends of the
//! range of numbers.

use super::power_cells::{Weighted, build, check_of, cube, numbers, weighted};
use crate::common::Rng;
use deldrift::VertexId;
use deldrift::internals::{PowerPlane, PowerSpace};
use deldrift::motion::{MovingTriangulation, Options};

/// Moves, and changes of weights alone: numbers are those of a fresh build, those of changed cells are all that change.
fn history<G: Weighted>() {
    let rng = &mut Rng::new(17);
    let n = 60;
    let mut points: Vec<G::Point> = (0..n)
        .map(|_| {
            let weight = 2.0 * rng.unit();
            weighted::<G>(weight, |_| 10.0 * rng.unit())
        })
        .collect();
    let [low, high] = cube::<G>(0.0, 10.0);
    let clip = [&low, &high];
    let mut t = build::<G>(&points);
    t.take_changes().expect("room");
    let mut kept = t.voronoi_cells(clip, None, &mut |_| true).expect("room");
    for step in 0..200 {
        let mut moved: Vec<VertexId> = VertexId::range(0..n).filter(|_| rng.one_in(12)).collect();
        moved.dedup();
        for v in &moved {
            let p = &mut points[v.index()];
            if step % 2 == 0 {
                (0..G::D).for_each(|axis| p[axis] += 0.3 * (rng.unit() - 0.5));
            }
            p[G::D] = if rng.one_in(10) { 12.0 } else { 2.0 } * rng.unit();
        }
        let goals: Vec<G::Point> = moved.iter().map(|v| points[v.index()]).collect();
        t.move_vertices(&moved, &goals).expect("good places");
        t.commit_timestamp().expect("room");
        t.take_changes().expect("room");
        let mask = t.voronoi_changed(&moved).expect("present");
        let all = t.voronoi_cells(clip, None, &mut |_| true).expect("room");
        let some = t.voronoi_cells(clip, Some(&mask), &mut |_| true).expect("room");
        for (k, &is_changed) in mask.iter().enumerate() {
            if is_changed != 0 {
                kept.volumes[k] = some.volumes[k];
                kept.areas[k] = some.areas[k];
                kept.centroids[k] = some.centroids[k];
            }
        }
        assert_eq!(format!("{kept:?}"), format!("{all:?}"));
        if step % 20 == 19 {
            check_of::<G>(&t, &points, clip, 0.1, false);
        }
    }
}

#[test]
fn histories_give_the_numbers_of_fresh_builds() {
    history::<PowerPlane>();
    history::<PowerSpace>();
}

/// Vertices in one hyperplane: those that are hidden there have no cell.
fn flat<G: Weighted>() {
    let rng = &mut Rng::new(19);
    let mut n_hidden = 0;
    for case in 0..60 {
        let n = 1 + rng.below(9);
        let most = [0, 1, 6, 30][case % 4];
        let across = rng.below(G::D);
        let on_line = case % 3 == 0;
        let points: Vec<G::Point> = (0..n)
            .map(|_| {
                let (weight, along) = (rng.within(0, most) as f64 / 8.0, rng.within(0, 8) as f64 / 8.0);
                weighted::<G>(weight, |axis| {
                    if on_line {
                        0.25 + along * (1.0 + axis as f64)
                    } else if axis == across {
                        0.5
                    } else {
                        rng.within(0, 8) as f64 / 8.0
                    }
                })
            })
            .collect();
        let t = build::<G>(&points);
        assert_eq!(t.cell_count(), 0);
        let hidden = t.vertices_hidden_by_weight().expect("room");
        n_hidden += hidden.len();
        for (low, high) in [(0.0, 1.0), (-1.0, 3.0), (0.25, 0.5), (2.0, 2.5)] {
            let [low, high] = cube::<G>(low, high);
            check_of::<G>(&t, &points, [&low, &high], 1e-4, true);
        }
        for (k, volume) in t.voronoi_volumes(None).expect("room").into_iter().enumerate() {
            let is_hidden = hidden.contains(&VertexId::at(k));
            assert_eq!(volume, if is_hidden { 0.0 } else { f64::INFINITY });
        }
    }
    assert!(n_hidden > 30, "{n_hidden}");
}

#[test]
fn vertices_in_a_hyperplane_have_power_cells() {
    flat::<PowerPlane>();
    flat::<PowerSpace>();
}

/// Distances whose squares are zero, and weights as great as they may be.
fn extremes<G: Weighted>() {
    let rng = &mut Rng::new(23);
    for scale in [1e-300, 1e-162, 1e-150, 1e-57, 1.0, 1e30, 1e56] {
        for a in [0.0, 1e-300, scale * scale, 1e3 * scale * scale, 1e60, 1e114] {
            for far in [0.0, 1.0, 1e57] {
                let n = G::D + 3 + rng.below(6);
                let mut points: Vec<G::Point> = (0..n)
                    .map(|_| {
                        let weight = if rng.one_in(2) { f64::min(a, 1e114) * rng.unit() } else { 0.0 };
                        weighted::<G>(weight, |_| scale * rng.unit())
                    })
                    .collect();
                points.push(weighted::<G>(0.0, |_| far));
                let t = build::<G>(&points);
                let volumes = t.voronoi_volumes(None).expect("room");
                let facets = t.voronoi_facets(None).expect("room");
                assert!(!volumes.iter().chain(&facets).any(|x| x.is_nan()), "{volumes:?} {facets:?}");
                for (low, high) in [(0.0, scale), (-1.0, 2.0), (0.25 * scale, 0.5 * scale)] {
                    // Measures of smaller boxes are less than any number.
                    if high - low > 1e-90 {
                        let [low, high] = cube::<G>(low, high);
                        check_of::<G>(&t, &points, [&low, &high], 1.0, false);
                    }
                }
            }
        }
    }
}

#[test]
fn cells_at_the_ends_of_the_range_are_exact_but_for_rounding() {
    extremes::<PowerPlane>();
    extremes::<PowerSpace>();
}

/// Numbers are the same to the last bit on any number of threads, and of copies.
fn threads<G: Weighted>() {
    let rng = &mut Rng::new(29);
    let n = 6_000;
    let spacing = 10.0 * f64::powf(n as f64, -1.0 / G::D as f64);
    let points: Vec<G::Point> = (0..n)
        .map(|_| {
            let weight = spacing * spacing * rng.unit();
            weighted::<G>(weight, |_| 10.0 * rng.unit())
        })
        .collect();
    let [low, high] = cube::<G>(1.0, 9.0);
    let all = |threads| {
        let options = Options { threads, parts: 2, ..Options::default() };
        let t = MovingTriangulation::<G>::new(&points, options).expect("room");
        assert!(!t.vertices_hidden_by_weight().expect("room").is_empty());
        let copy = t.try_clone(None).expect("room");
        assert_eq!(t.voronoi_volumes(None), copy.voronoi_volumes(None));
        assert_eq!(
            format!("{:?}", numbers(&t, [&low, &high])),
            format!("{:?}", numbers(&copy, [&low, &high]))
        );
        format!("{:?}", numbers(&t, [&low, &high]))
    };
    assert!(all(1) == all(3));
}

#[test]
fn numbers_are_the_same_on_any_number_of_threads() {
    threads::<PowerPlane>();
    threads::<PowerSpace>();
}
