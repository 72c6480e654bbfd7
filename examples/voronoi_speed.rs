//! What Voronoi cells cost in a particle code: random vertices all move a little at every step, which is committed, and
//! volumes, boundaries and centroids of all cells are computed, and then facets with derivatives. Microseconds for each
//! vertex; the number of vertices may be given.
//!
//! With a mask of the vertices that have no part of the box's boundary, the cells that are cut are left out.
mod common;

use common::{Rng, in_cube};
use deldrift::motion::{MovingTriangulation, Options};
use deldrift::{Dimension, Plane, Space, VertexId};
use std::hint::black_box;
use std::time::Instant;

fn micros<T>(n: usize, work: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let made = black_box(work());
    (start.elapsed().as_secs_f64() * 1e6 / n as f64, made)
}

fn speed<G: Dimension>(n: usize, share: f64) {
    let rng = &mut Rng::new(17);
    let mut places: Vec<G::Point> = (0..n).map(|_| in_cube::<G>(rng, 1.0)).collect();
    let mut t = MovingTriangulation::<G>::new(&places, Options::default()).expect("good points");
    let ids: Vec<VertexId> = VertexId::range(0..n).collect();
    let spacing = (1.0 / n as f64).powf(1.0 / G::D as f64);
    let (mut low, mut high) = (G::Point::default(), G::Point::default());
    (0..G::D).for_each(|axis| (low[axis], high[axis]) = (-1e-2, 1.0 + 1e-2));
    let inside = |p: &G::Point| (0..G::D).all(|axis| (p[axis] - 0.5).abs() < 0.5 - 3.0 * spacing);
    let mask: Vec<u8> = places.iter().map(|p| u8::from(inside(p))).collect();
    let n_masked = mask.iter().filter(|&&m| m != 0).count();
    let mut least = [f64::MAX; 6];
    let mut off: f64 = 0.0;
    for _ in 0..6 {
        for p in &mut places {
            (0..G::D).for_each(|axis| p[axis] += share * spacing * (2.0 * rng.unit() - 1.0));
        }
        t.move_vertices(&ids, &places).expect("good places");
        let (commit, _) = micros(n, || t.commit_timestamp().expect("room"));
        let (view, _) = micros(n, || t.cells().map(|view| view.corners.len()).expect("room"));
        let clip = [&low, &high];
        let (cells, made) = micros(n, || t.voronoi_cells(clip, None, &mut |_| true).expect("room"));
        let (inner, _) =
            micros(n_masked, || t.voronoi_cells(clip, Some(&mask), &mut |_| true).expect("room"));
        let go = || t.voronoi_derivatives(clip, None, &mut |_| true).expect("room");
        let (facets, _) = micros(n, go);
        let (volumes, _) = micros(n, || t.voronoi_volumes(Some(clip)).expect("room"));
        let now = [commit, view, cells, inner, facets, volumes];
        least = std::array::from_fn(|k| least[k].min(now[k]));
        let size: f64 = (0..G::D).map(|axis| high[axis] - low[axis]).product();
        off = off.max((made.volumes.iter().sum::<f64>() / size - 1.0).abs());
    }
    let [commit, view, cells, inner, facets, volumes] = least;
    println!(
        "{}D {share:7.0e}  {commit:8.3} {view:8.3} {cells:8.3} {inner:8.3} {facets:8.3} {volumes:8.3}   {off:.0e}",
        G::D
    );
}

fn main() {
    let n = std::env::args().nth(1).map_or(100_000, |n| n.parse().expect("a number"));
    println!("{n} vertices, microseconds a vertex");
    println!("    moves     commit    cells  voronoi    inner   facets  volumes   sum off by");
    for share in [1e-4, 1e-2] {
        speed::<Plane>(n, share);
        speed::<Space>(n, share);
    }
}
