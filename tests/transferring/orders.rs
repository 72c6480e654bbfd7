//! How accurate transfer is: linear functions, and a smooth one on finer and finer meshes.

use crate::common::{Rng, point};
use deldrift::motion::{MovingTriangulation, NO_CELL, Options, TransferOrder};
use deldrift::{Dimension, Plane, Space, VertexId};

fn linear<P: AsRef<[f64]>>(p: &P) -> f64 {
    p.as_ref().iter().zip([0.7, -1.3, 0.4]).map(|(x, slope)| x * slope).sum::<f64>() + 2.0
}

fn smooth<P: AsRef<[f64]>>(p: &P) -> f64 {
    p.as_ref().iter().zip([3.0, 2.0, 2.5]).map(|(x, k)| (k * x + 0.3).sin()).product()
}

/// The mean of a function in a cell: exact for polynomials of degree 2.
fn mean<G: Dimension>(corners: &[G::Point], f: fn(&G::Point) -> f64) -> f64 {
    let n = G::D as f64;
    let centre = point::<G>(|k| corners.iter().map(|p| p[k]).sum::<f64>() / (n + 1.0));
    let at_corners: f64 = corners.iter().map(f).sum();
    let (of_corners, of_centre) = (1.0 / ((n + 1.0) * (n + 2.0)), (n + 1.0) / (n + 2.0));
    of_corners * at_corners + of_centre * f(&centre)
}

/// Half of the vertices of a mesh of m to a side, but those on the sides, are replaced by others: the mean error of a
/// smooth function where cells have come, and the share of the cells away from the hull where a linear function is
/// another one.
fn errors<G: Dimension>(m: usize, order: TransferOrder) -> (f64, f64) {
    let rng = &mut Rng::new(m as u64);
    let mut places = Vec::new();
    for v in 0..m.pow(G::D as u32) {
        let at = |k: usize| (v / m.pow(k as u32) % m) as f64;
        let is_inside = (0..G::D).all(|k| at(k) > 0.0 && at(k) < (m - 1) as f64);
        let jitter = if is_inside { 0.5 } else { 0.0 };
        places.push(point::<G>(|k| (at(k) + jitter * (rng.unit() - 0.5)) / (m - 1) as f64));
    }
    let mut t = MovingTriangulation::<G>::new(&places, Options::default()).expect("good points");
    t.take_changes().expect("room");
    let mut values = Vec::new();
    for row in t.cells().expect("room").corners {
        let corners: Vec<_> = row.as_ref().iter().map(|v| places[v.index()]).collect();
        values.extend([mean::<G>(&corners, smooth), mean::<G>(&corners, linear)]);
    }
    let is_inside = |p: &G::Point| (0..G::D).all(|k| p[k] > 0.0 && p[k] < 1.0);
    let leaving: Vec<VertexId> = VertexId::range(0..places.len())
        .filter(|v| is_inside(&places[v.index()]) && v.index() % 2 == 0)
        .collect();
    t.stage_removals(&leaving).expect("removals");
    let edge = 1.0 / (m - 1) as f64;
    let coming: Vec<G::Point> =
        leaving.iter().map(|_| point::<G>(|_| edge + (1.0 - 2.0 * edge) * rng.unit())).collect();
    t.stage_insertions(&coming).expect("insertions");
    t.commit_timestamp().expect("a commit");
    let created = t.take_changes().expect("room").created.to_vec();
    let report = t.transfer_cells(Some(&places), order, 2, &mut values, &mut |_| true).expect("a transfer");
    assert!(report.lost_volume.abs() < 1e-12 && report.turned_over == 0, "{report:?}");
    let (cells, volumes) = (t.cells().expect("room"), t.volumes().expect("room").collect::<Vec<_>>());
    let (mut error, mut volume, mut n_inner, mut n_other) = (0.0, 0.0, 0.0, 0.0);
    let is_at_hull = |index: usize| cells.neighbours[index].as_ref().contains(&NO_CELL);
    for cell in created {
        let index = cell.index();
        let row = cells.corners[index].as_ref();
        let corners: Vec<_> = row.iter().map(|&v| t.position(v).expect("it is there")).collect();
        error += volumes[index] * (values[2 * index] - mean::<G>(&corners, smooth)).abs();
        volume += volumes[index];
        let beside = cells.neighbours[index].as_ref().iter();
        if !is_at_hull(index) && !beside.into_iter().any(|other| is_at_hull(other.index())) {
            n_inner += 1.0;
            let is_other = (values[2 * index + 1] - mean::<G>(&corners, linear)).abs() > 1e-10;
            n_other += f64::from(u8::from(is_other));
        }
    }
    (error / volume, n_other / n_inner)
}

fn orders_are_what_they_are_called<G: Dimension>(sides: [usize; 3]) {
    for (order, least, most) in [(TransferOrder::First, 0.7, 1.3), (TransferOrder::Second, 1.6, 2.5)] {
        let found = sides.map(|m| errors::<G>(m, order));
        let steps = [0, 1].map(|k| (found[k].0 / found[k + 1].0).log2());
        println!("{}D, {order:?}: errors {found:?}, orders {steps:?}", G::D);
        assert!(steps.iter().all(|step| (least..most).contains(step)), "{}D, {order:?}: {steps:?}", G::D);
        if order == TransferOrder::Second {
            // In space neighbours are farther apart than cells are long, and the limiter meets some.
            let most = if G::D == 2 { 0.0 } else { 0.01 };
            assert!(found.iter().all(|&(_, others)| others <= most), "a linear function: {found:?}");
        }
    }
}

#[test]
fn orders_are_what_they_are_called_in_the_plane() {
    orders_are_what_they_are_called::<Plane>([17, 33, 65]);
}

#[test]
fn orders_are_what_they_are_called_in_space() {
    orders_are_what_they_are_called::<Space>([7, 13, 25]);
}
