//! What Voronoi cells cost in a particle code: random vertices all move a little at every step, which is committed, and
//! volumes, boundaries and centroids of all cells are computed, and then facets with derivatives. Microseconds for each
//! vertex of which a call is for; the numbers of vertices and of threads may be given.
//!
//! With a mask of the vertices that have no part of the box's boundary (inner) the cells that are cut are left out. With
//! one of every 1,000th vertex (few) cells are far from each other. With 100 half-spaces as upright walls they may contain
//! all (walled), or be a cylinder as wide as the square or cube (cylinder), and cut what is near its wall.
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

/// Upright half-spaces around the middle, which are this far from it.
fn walls<G: Dimension>(n: usize, radius: f64) -> Vec<f64> {
    let wall = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / n as f64;
        let mut row = vec![0.0; G::D + 1];
        (row[0], row[1]) = (angle.cos(), angle.sin());
        row[G::D] = radius + 0.5 * (row[0] + row[1]);
        row
    };
    (0..n).flat_map(wall).collect()
}

fn speed<G: Dimension>(n: usize, threads: u32, share: f64) {
    let rng = &mut Rng::new(17);
    let options = Options { threads, ..Options::default() };
    let mut places: Vec<G::Point> = (0..n).map(|_| in_cube::<G>(rng, 1.0)).collect();
    let mut t = MovingTriangulation::<G>::new(&places, options).expect("good points");
    let ids: Vec<VertexId> = VertexId::range(0..n).collect();
    let spacing = (1.0 / n as f64).powf(1.0 / G::D as f64);
    let (mut low, mut high) = (G::Point::default(), G::Point::default());
    (0..G::D).for_each(|axis| (low[axis], high[axis]) = (-1e-2, 1.0 + 1e-2));
    let inside = |p: &G::Point| (0..G::D).all(|axis| (p[axis] - 0.5).abs() < 0.5 - 3.0 * spacing);
    let mask: Vec<u8> = places.iter().map(|p| u8::from(inside(p))).collect();
    let n_masked = mask.iter().filter(|&&m| m != 0).count();
    let few: Vec<u8> = (0..n).map(|k| u8::from(k % 1000 == 500)).collect();
    let n_few = few.iter().filter(|&&m| m != 0).count();
    let [wide, narrow] = [0.75, 0.5].map(|radius| walls::<G>(100, radius));
    let mut least = [f64::MAX; 9];
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
        let (scattered, _) =
            micros(n_few, || t.voronoi_cells(clip, Some(&few), &mut |_| true).expect("room"));
        let [(walled, _), (cylinder, _)] = [&wide, &narrow]
            .map(|rows| micros(n, || t.voronoi_cells_within(clip, rows, None, &mut |_| true).expect("room")));
        let go = || t.voronoi_derivatives(clip, None, &mut |_| true).expect("room");
        let (facets, _) = micros(n, go);
        let (volumes, _) = micros(n, || t.voronoi_volumes(Some(clip)).expect("room"));
        let now = [commit, view, cells, inner, scattered, walled, cylinder, facets, volumes];
        least = std::array::from_fn(|k| least[k].min(now[k]));
        let size: f64 = (0..G::D).map(|axis| high[axis] - low[axis]).product();
        off = off.max((made.volumes.iter().sum::<f64>() / size - 1.0).abs());
    }
    let [commit, view, cells, inner, scattered, walled, cylinder, facets, volumes] = least;
    println!(
        "{}D {share:7.0e}  {commit:8.3} {view:8.3} {cells:8.3} {inner:8.3} {scattered:8.3} {walled:8.3} {cylinder:8.3} {facets:8.3} {volumes:8.3}   {off:.0e}",
        G::D
    );
}

fn main() {
    let given =
        |k: usize, other: usize| std::env::args().nth(k).map_or(other, |n| n.parse().expect("a number"));
    let (n, threads) = (given(1, 100_000), given(2, 1) as u32);
    println!("{n} vertices, {threads} threads, microseconds a vertex");
    println!(
        "    moves     commit    cells  voronoi    inner      few   walled cylinder   facets  volumes   sum off by"
    );
    for share in [1e-4, 1e-2] {
        speed::<Plane>(n, threads, share);
        speed::<Space>(n, threads, share);
    }
}
