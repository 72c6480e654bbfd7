//! Every algorithm in both dimensions, on few points of every kind, against fresh builds and all else that is known of a
//! triangulation.

use crate::common::history::{History, nudged};
use crate::common::inputs::{KINDS, Kind, quantized};
use crate::common::point;
use deldrift::motion::Algorithm;
use deldrift::{Dimension, Plane, Space, VertexId};

/// Commits of all vertices, by less and by more than the spacing, then of some; with an insertion and a removal between.
fn commits_agree<G: Dimension>(kind: Kind, algorithm: Algorithm, n: usize) {
    let mut history = History::<G>::new(kind, n, 7);
    for quanta in [0, 1, 1 << 10, 1 << 16, 1 << 20, 1 << 23] {
        for v in VertexId::range(0..history.positions.len()) {
            if let Some(p) = history.positions[v] {
                let q = nudged::<G>(&p, quanta, &mut history.rng);
                history.stage(v, q);
            }
        }
        history.commit(algorithm);
        history.check();
    }
    let p = history.positions[1].expect("it is present");
    history.insert(p);
    history.remove(VertexId::new(0));
    for v in VertexId::range(1..n / 4) {
        let p = history.positions[v].expect("it is present");
        history.stage(v, quantized::<G>(point::<G>(|k| 0.75 * p[k])));
    }
    history.commit(algorithm);
    history.check();
}

/// Random calls of all kinds, the algorithm drawn for each commit.
fn random_calls_agree<G: Dimension>(kind: Kind, n: usize) {
    let mut history = History::<G>::new(kind, n, 11);
    (0..30).for_each(|_| history.step());
}

macro_rules! each_dimension {
    ($($name:ident: $dimension:ident, $n:literal;)+) => {$(
        mod $name {
            use super::*;

            #[test]
            fn commits_by_every_algorithm_are_fresh_builds() {
                for kind in KINDS {
                    Algorithm::ALL.into_iter().for_each(|by| commits_agree::<$dimension>(kind, by, $n));
                }
            }

            #[test]
            fn random_calls_end_in_fresh_builds() {
                KINDS.into_iter().for_each(|kind| random_calls_agree::<$dimension>(kind, $n));
            }
        }
    )+};
}

each_dimension! {
    in_the_plane: Plane, 40;
    in_space: Space, 30;
}
