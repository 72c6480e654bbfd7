//! What it costs to tell which cells a vertex in a box could change, of 100,000 vertices or as many as are given: for boxes of
//! different sizes nanoseconds per call, the walk included, and per cell and hull facet in reach. Beside it a pass over the
//! circumspheres of all cells, which finds them, too, but for rounding.
mod common;

use common::{Rng, in_cube};
use deldrift::motion::{MovingTriangulation, Options};
use deldrift::{Dimension, Plane, Shape, Space};
use std::hint::black_box;
use std::time::Instant;

/// Boxes of a kind.
type Boxes<G> = Vec<[<G as Shape>::Point; 2]>;

fn box_around<G: Dimension>(middle: &G::Point, half: f64) -> [G::Point; 2] {
    let (mut low, mut high) = (*middle, *middle);
    (0..G::D).for_each(|k| (low[k], high[k]) = (low[k] - half, high[k] + half));
    [low, high]
}

/// Boxes of some sizes in a cube of this side, and all that is beyond the middle of it, or beside it.
fn boxes<G: Dimension>(side: f64, spacing: f64, middles: &[G::Point]) -> Vec<(String, Boxes<G>)> {
    let mut all = Vec::new();
    for spacings in [0.0, 1.0, 3.0, 10.0, 30.0] {
        let of = |middle: &G::Point| box_around::<G>(middle, 0.5 * spacings * spacing);
        all.push((format!("{spacings} spacings wide"), middles.iter().map(of).collect()));
    }
    let (mut beside, mut half) = (box_around::<G>(&G::Point::default(), f64::INFINITY), middles[0]);
    beside[0][0] = side;
    all.push(("all that is on one side".to_string(), vec![beside]));
    half[0] = 0.5 * side;
    let mut beyond = box_around::<G>(&half, f64::INFINITY);
    beyond[0][0] = half[0];
    all.push(("half of all".to_string(), vec![beyond]));
    all
}

fn check<G: Dimension>(name: &str, points: &[G::Point], side: f64, spacing: f64, middles: &[G::Point]) {
    let t = MovingTriangulation::<G>::new(points, Options::default()).expect("good places");
    t.cells().expect("room");
    println!("{name}, {}D, {} vertices, {} cells", G::D, points.len(), t.cell_count());
    println!("  {:<28}{:>10}{:>12}{:>12}", "box", "in reach", "ns a call", "ns for each");
    for (what, boxes) in boxes::<G>(side, spacing, middles) {
        let (mut best, mut n) = (f64::MAX, 0);
        for _ in 0..3 {
            let start = Instant::now();
            n = 0;
            for [low, high] in &boxes {
                let found = t.cells_in_reach(&[*low], &[*high], None).expect("good boxes");
                n += found.cells.len() + found.hull.len();
            }
            best = best.min(start.elapsed().as_secs_f64());
        }
        let per_call = best * 1e9 / boxes.len() as f64;
        println!(
            "  {what:<28}{:>10.1}{per_call:>12.0}{:>12.1}",
            n as f64 / boxes.len() as f64,
            best * 1e9 / n as f64
        );
    }
    let start = Instant::now();
    t.circumspheres().expect("room").for_each(|sphere| _ = black_box(sphere));
    let all = start.elapsed().as_secs_f64() * 1e9;
    println!(
        "  {:<28}{:>10}{all:>12.0}{:>12.1}",
        "circumspheres of all",
        t.cell_count(),
        all / t.cell_count() as f64
    );
}

fn check_sets<G: Dimension>(n: usize) {
    let rng = &mut Rng::new(1);
    let spacing = (n as f64).powf(-1.0 / G::D as f64);
    let middles: Vec<G::Point> = (0..200).map(|_| in_cube::<G>(rng, 1.0)).collect();
    let points: Vec<G::Point> = (0..n).map(|_| in_cube::<G>(rng, 1.0)).collect();
    check::<G>("random", &points, 1.0, spacing, &middles);
    let per_side = (n as f64).powf(1.0 / G::D as f64).round() as usize;
    for (name, step) in [("lattice of whole numbers", 1.0), ("lattice of tenths", 0.1)] {
        let at = |mut v: usize| {
            let mut p = G::Point::default();
            for axis in 0..G::D {
                p[axis] = (v % per_side) as f64 * step;
                v /= per_side;
            }
            p
        };
        let points: Vec<G::Point> = (0..per_side.pow(G::D as u32)).map(at).collect();
        // At vertices, so that sides of boxes of whole spacings touch many balls.
        let middles: Vec<G::Point> = (0..200).map(|k| points[k * 7919 % points.len()]).collect();
        check::<G>(name, &points, (per_side - 1) as f64 * step, 2.0 * step, &middles);
    }
}

fn main() {
    let n = std::env::args().nth(1).map_or(100_000, |n| n.parse().expect("a number of vertices"));
    check_sets::<Plane>(n);
    check_sets::<Space>(n);
}
