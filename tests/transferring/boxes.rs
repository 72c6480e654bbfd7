//! Transfer in boxes that repeat: there no region is lost or gained, whatever cells are turned over.

use crate::common::{Rng, point, seeds, vertex};
use deldrift::motion::{Options, TransferOrder};
use deldrift::periodic::PeriodicTriangulation;
use deldrift::{Dimension, Plane, Space, VertexId};

const CONSTANT: f64 = 0.1;

fn history<G: Dimension>(seed: u64, n: usize, steps: usize) -> usize {
    let mut rng = Rng::new(seed);
    let order = if rng.one_in(2) { TransferOrder::First } else { TransferOrder::Second };
    let (way, skew) = (*rng.pick(&[0.02, 0.1, 0.5]), rng.below(3) as f64 * 0.3);
    let vectors = |strain: f64| -> Vec<G::Point> {
        let entry = |j: usize, k: usize| {
            if j == k {
                1.0 + strain
            } else if j > k {
                skew
            } else {
                0.0
            }
        };
        (0..G::D).map(|j| point::<G>(|k| entry(j, k))).collect()
    };
    let mut places: Vec<G::Point> = (0..n).map(|_| point::<G>(|_| rng.unit())).collect();
    let mut t = PeriodicTriangulation::<G>::new(&places, &vectors(0.0), Options::default()).expect("a box");
    t.take_changes().expect("room");
    let name = format!("{}D, seed {seed}, {order:?}, way {way}, skew {skew}", G::D);
    let mut turned_over = 0;
    for step in 0..steps {
        let n_cells = t.cell_count().expect("room");
        let mut values: Vec<f64> = (0..n_cells).flat_map(|_| [CONSTANT, rng.unit()]).collect();
        let n_before = places.len();
        for _ in 0..1 + rng.below(2) {
            for v in VertexId::range(0..places.len()) {
                if t.is_present(v) && !rng.one_in(4) {
                    places[v.index()] = point::<G>(|k| places[v.index()][k] + way * (rng.unit() - 0.5));
                    t.move_vertices(&[v], &[places[v.index()]]).expect("a move");
                }
            }
            if rng.one_in(3) {
                let v = vertex(rng.below(places.len()) as u32);
                if t.is_present(v) && t.vertex_count() > 2 {
                    t.discard_moves();
                    places.iter_mut().zip(VertexId::range(0..u32::MAX as usize)).for_each(|(place, v)| {
                        if t.is_present(v) {
                            *place = t.position(v).expect("it is there");
                        }
                    });
                    t.remove_vertex(v).expect("a removal");
                }
                let place = point::<G>(|_| 3.0 * rng.unit() - 1.0);
                t.insert_vertex(&place).expect("an insertion");
                places.push(place);
            }
            if rng.one_in(4) {
                t.stage_vectors(&vectors(0.1 * rng.unit())).expect("vectors");
            }
            t.commit_timestamp().expect("a commit");
        }
        t.take_changes().expect("room");
        let before = values.clone();
        let report = t
            .transfer_cells(Some(&places[..n_before]), order, 2, &mut values, &mut |_| true)
            .expect("a transfer");
        turned_over += report.turned_over;
        let told = [report.lost_volume, report.gained_volume].map(f64::abs);
        assert!(told.iter().all(|&x| x <= report.volume_error), "{name}, step {step}: {report:?}");
        assert!(values.iter().step_by(2).all(|&x| x == CONSTANT), "{name}, step {step}: a constant changes");
        let contents = [report.lost[1], report.gained[1]].map(f64::abs);
        assert!(contents.iter().all(|&x| x <= 4.0 * report.volume_error), "{name}, step {step}: {report:?}");
        if report.turned_over == 0 {
            let fold =
                |values: &[f64], f: fn(f64, f64) -> f64| values.iter().skip(1).step_by(2).copied().reduce(f);
            assert!(fold(&values, f64::min) >= fold(&before, f64::min), "{name}, step {step}: a new minimum");
            assert!(fold(&values, f64::max) <= fold(&before, f64::max), "{name}, step {step}: a new maximum");
        }
    }
    turned_over
}

#[test]
fn nothing_is_lost_in_boxes() {
    let plane: usize = seeds(250).map(|seed| history::<Plane>(seed, 3 + seed as usize % 20, 3)).sum();
    let space: usize = seeds(250).map(|seed| history::<Space>(seed, 3 + seed as usize % 12, 2)).sum();
    println!("turned over: {plane} and {space}");
    assert!(plane > 100 && space > 100);
}
