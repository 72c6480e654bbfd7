//! What differs by less than rounding, and what is counted.

use super::definition::by_weight;
use crate::common::vertex;
use deldrift::internals::{PowerPlane, PowerSpace};
use deldrift::motion::{Algorithm, MovingTriangulation, Options};
use deldrift::{Error, Moving};

fn point<G: Moving>(x: f64, y: f64, weight: f64) -> G::Point {
    let mut p = G::Point::default();
    (p[0], p[1], p[G::D]) = (x, y, weight);
    p
}

/// Of two vertices that are as far from a place the heavier one is nearer, by however little, and of equal ones the
/// first.
#[test]
fn the_nearest_vertex_is_the_heavier_one_by_however_little() {
    fn check<G: Moving>() {
        for unit in [1e-17, 1e-20, 1e-200, 5e-324] {
            for (v, w) in (0..3).flat_map(|v| (0..3).map(move |w| (v, w))) {
                let of = |k: i32| f64::from(k) * unit;
                // Others make cells, far off.
                let mut points = vec![
                    point::<G>(0.0, 0.25, of(v)),
                    point::<G>(1.0, 0.25, of(w)),
                    point::<G>(0.5, 9.0, 0.0),
                ];
                points.extend((0..G::D - 1).map(|k| {
                    let mut p = point::<G>(0.5, -9.0, 0.0);
                    p[G::D - 1] -= k as f64;
                    p
                }));
                let t = MovingTriangulation::<G>::new(&points, Options::default()).expect("a build");
                assert!(t.cell_count() > 0);
                let nearest = vertex(u32::from(w > v));
                assert_eq!(
                    t.nearest_vertex(&point::<G>(0.5, 0.25, 0.0)),
                    Ok(Some(nearest)),
                    "{v} and {w} of {unit}"
                );
            }
        }
    }
    check::<PowerPlane>();
    check::<PowerSpace>();
}

/// Places and weights that change are counted apart, in reports and in their sums, by every algorithm.
#[test]
fn changed_places_and_weights_are_counted() {
    fn check<G: Moving>() {
        for algorithm in Algorithm::ALL {
            let mut points: Vec<G::Point> = (0..40)
                .map(|k| point::<G>(f64::from(k % 7), f64::from(k * k % 11), f64::from(k % 3)))
                .collect();
            if G::D == 3 {
                (0..40).for_each(|k| points[k][2] = (k * k * k % 13) as f64);
            }
            let mut t = MovingTriangulation::<G>::new(&points, Options::default()).expect("a build");
            t.set_algorithm(algorithm);
            let (mut moved, mut reweighted) = (0, 0);
            for step in 0..12 {
                let (n_moved, n_reweighted) = (3 * step % 7, 5 * step % 11);
                points[..n_moved].iter_mut().for_each(|p| p[0] += 0.25);
                points[40 - n_reweighted..].iter_mut().for_each(|p| p[G::D] += 0.5);
                let report = t.commit_positions(&points).expect("room");
                assert_eq!(
                    (report.moved, report.reweighted),
                    (n_moved as u64, n_reweighted as u64),
                    "{algorithm:?}"
                );
                (moved, reweighted) = (moved + report.moved, reweighted + report.reweighted);
                let sums = t.statistics();
                assert_eq!((sums.moved, sums.reweighted), (moved, reweighted), "{algorithm:?}, {step}");
                assert_eq!(report.hidden_by_weight as usize, by_weight(&t).len(), "{algorithm:?}, {step}");
            }
        }
    }
    check::<PowerPlane>();
    check::<PowerSpace>();
}

/// Fewer or more places or weights than ids are refused, and one that is no number; nothing is staged or changed then.
#[test]
fn wrong_parts_are_refused() {
    fn check<G: Moving>() {
        let points: Vec<G::Point> = (0..9).map(|k| point::<G>(f64::from(k), f64::from(k * k), 1.0)).collect();
        let mut t = MovingTriangulation::<G>::new(&points, Options::default()).expect("a build");
        let before = super::shown(&t);
        for n in [0, 8, 10] {
            let (places, weights) = (vec![0.5; n * G::D], vec![2.0; n]);
            let of_places = t.commit_parts(Some(&places), None);
            let of_weights = t.commit_parts(None, Some(&weights));
            let of_both = t.commit_parts(Some(&places), Some(&weights));
            for refused in [of_places, of_weights, of_both] {
                assert!(matches!(refused, Err(Error::WrongCount { .. })), "{n}: {refused:?}");
            }
            assert_eq!((t.staged_count(), t.timestamp(), super::shown(&t)), (0, 0, before.clone()));
        }
        let weights: Vec<f64> = (0..9).map(f64::from).collect();
        assert_eq!(t.commit_parts(None, Some(&weights)).expect("room").reweighted, 8);
        // With an id that is not present the two are staged one after the other: the first one goes with the second.
        t.remove_vertex(vertex(3)).expect("room");
        let before = super::shown(&t);
        let (places, mut weights) = (vec![0.5; 9 * G::D], vec![2.0; 9]);
        weights[5] = f64::NAN;
        for _ in 0..200 {
            let refused = t.commit_parts(Some(&places), Some(&weights));
            assert!(matches!(refused, Err(Error::NotFinite { .. })), "{refused:?}");
            assert_eq!((t.staged_count(), super::shown(&t)), (0, before.clone()));
        }
        weights[5] = 2.0;
        assert_eq!(t.commit_parts(Some(&places), Some(&weights)).expect("room").reweighted, 7);
        assert_eq!(t.hidden_by_place().expect("room").len(), 7);
    }
    check::<PowerPlane>();
    check::<PowerSpace>();
}
