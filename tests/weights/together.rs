//! All vertices go by one vector, weights by one number: the cells stay, and hidden vertices go along.

use super::shown;
use crate::common::Rng;
use deldrift::internals::{PowerPlane, PowerSpace};
use deldrift::motion::{Algorithm, MovingTriangulation, Options};
use deldrift::{Moving, VertexId};

/// Whole numbers, so that sums are exact; half of the vertices are so light that some are hidden.
fn go_together<G: Moving>(seed: u64, removes: bool, algorithm: Algorithm) {
    let rng = &mut Rng::new(seed);
    let n = 80;
    let mut points = vec![G::Point::default(); n];
    for (k, p) in points.iter_mut().enumerate() {
        (0..G::D).for_each(|axis| p[axis] = rng.below(200) as f64);
        p[G::D] = if k % 2 == 0 { 0.0 } else { -(rng.below(4_000) as f64) };
    }
    let options = Options { algorithm, ..Options::default() };
    let mut t = MovingTriangulation::<G>::new(&points, options).expect("room");
    let gone = removes.then(|| VertexId::new(4));
    if let Some(v) = gone {
        t.remove_vertex(v).expect("it is there");
    }
    let first = shown(&t);
    assert!(!first.1.is_empty(), "some are hidden");
    for _ in 0..6 {
        let mut way = G::Point::default();
        (0..G::D + 1).for_each(|k| way[k] = 64.0 * [0.0, rng.below(64) as f64 - 32.0][rng.below(2)]);
        for p in &mut points {
            (0..G::D + 1).for_each(|k| p[k] += way[k]);
        }
        t.commit_positions(&points).expect("good points");
        assert_eq!(shown(&t), first, "seed {seed}");
        for v in (0..n as u32).map(VertexId::new).filter(|&v| Some(v) != gone) {
            assert_eq!(t.position(v).expect("it is there"), points[v.index()], "seed {seed}, {v}");
        }
    }
}

#[test]
fn vertices_that_go_together_keep_their_cells() {
    for seed in 0..12 {
        for removes in [false, true] {
            for algorithm in [Algorithm::Auto, Algorithm::Repair, Algorithm::Tolerance] {
                go_together::<PowerPlane>(seed, removes, algorithm);
                go_together::<PowerSpace>(seed, removes, algorithm);
            }
        }
    }
}
