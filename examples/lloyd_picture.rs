//! Draws the picture of docs/WHICH_ALGORITHM.md: Lloyd's iterations in a disk, each vertex coloured by how far it
//! is about to move, in units of its tolerance.
//!
//! ```sh
//! cargo run --release --example lloyd_picture > docs/lloyd.svg
//! ```
//!
//! Cells and tolerances are read from the library; centroids are those of Voronoi cells clipped to a polygon.

use deldrift::Error;
use deldrift::Plane;
use deldrift::VertexId;
use deldrift::motion::{Algorithm, MovingTriangulation, Options};
use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::fmt::Write;

type Point = [f64; 2];

const N: usize = 260;
const RADIUS: f64 = 118.0;
/// Sides of the polygon that stands for the disk.
const N_SIDES: usize = 128;
/// The iterations that are shown.
const SHOWN: [usize; 4] = [1, 3, 10, 60];

/// Size of a panel, of the strip below it for the caption, and of the key below all.
const WIDTH: f64 = 262.0;
const HEIGHT: f64 = 258.0;
const CAPTION: f64 = 50.0;
const KEY: f64 = 44.0;

/// Greatest displacement per tolerance, class, and what the key says. Blue stays within, orange does not.
const CLASSES: [(f64, &str, &str); 4] = [
    (0.1, "far", "below 0.1"),
    (1.0, "within", "0.1 to 1: within"),
    (10.0, "beyond", "1 to 10: beyond"),
    (f64::INFINITY, "out", "above 10"),
];

const STYLE: &str = "\
text{font-family:system-ui,'Helvetica Neue',Helvetica,Arial,'DejaVu Sans',sans-serif;fill:#57606a;font-size:12.5px}\
.title{font-size:15px;font-weight:600;fill:#24292f}\
.middle{text-anchor:middle}\
.edges{stroke:#aab3bc;stroke-width:.9;fill:none;stroke-linecap:round}\
.far{fill:#0b5394}\
.within{fill:#6fb1e0}\
.beyond{fill:#f0a04b}\
.out{fill:#a8480a}";

fn main() -> Result<(), Error> {
    let mut positions = points();
    let options = Options { algorithm: Algorithm::RebuildingTolerance, ..Options::default() };
    let mut t = MovingTriangulation::<Plane>::new(&positions, options)?;
    let mut picture = header();
    for iteration in 1..=SHOWN[SHOWN.len() - 1] {
        let edges = edges(t.cells().expect("room").corners);
        let next = centroids(&positions, &edges);
        if let Some(panel) = SHOWN.iter().position(|&shown| shown == iteration) {
            let tolerances =
                VertexId::range(0..N).map(|v| t.tolerance(v)).collect::<Result<Vec<f64>, Error>>()?;
            let shares: Vec<f64> = (0..N)
                .map(|v| distance(&positions[v], &next[v]) / tolerances[v].max(f64::MIN_POSITIVE))
                .collect();
            draw(&mut picture, panel, iteration, &positions, &edges, &shares);
        }
        t.move_all(&next)?;
        t.commit_timestamp()?;
        positions = next;
    }
    key(&mut picture);
    println!("{picture}</svg>");
    Ok(())
}

/// Random points in the disk, the same every time.
fn points() -> Vec<Point> {
    let mut state = 20_081_201_u64;
    let mut unit = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    (0..N)
        .map(|_| {
            let (radius, angle) = (RADIUS * unit().sqrt(), TAU * unit());
            [radius * angle.cos(), radius * angle.sin()]
        })
        .collect()
}

fn distance(a: &Point, b: &Point) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// The edges of triangles, each once, from the lower id to the higher.
fn edges(triangles: &[[VertexId; 3]]) -> BTreeSet<[VertexId; 2]> {
    let edge = |a: VertexId, b: VertexId| [a.min(b), a.max(b)];
    triangles.iter().flat_map(|&[a, b, c]| [edge(a, b), edge(b, c), edge(c, a)]).collect()
}

/// Where Lloyd's iteration takes every point: to the centroid of its Voronoi cell in the disk.
fn centroids(positions: &[Point], edges: &BTreeSet<[VertexId; 2]>) -> Vec<Point> {
    let corner = |i: usize| {
        let angle = TAU * i as f64 / N_SIDES as f64;
        [RADIUS * angle.cos(), RADIUS * angle.sin()]
    };
    let disk: Vec<Point> = (0..N_SIDES).map(corner).collect();
    let mut cells = vec![disk; positions.len()];
    for &[a, b] in edges {
        let (p, q) = (positions[a], positions[b]);
        clip(&mut cells[a], &p, &q);
        clip(&mut cells[b], &q, &p);
    }
    cells.iter().map(|cell| centroid(cell)).collect()
}

/// Keeps the part of a convex polygon that is nearer to `site` than to `other`.
fn clip(polygon: &mut Vec<Point>, site: &Point, other: &Point) {
    let normal = [other[0] - site[0], other[1] - site[1]];
    let middle = [(other[0] + site[0]) / 2.0, (other[1] + site[1]) / 2.0];
    let excess = |p: &Point| (p[0] - middle[0]) * normal[0] + (p[1] - middle[1]) * normal[1];
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, a) in polygon.iter().enumerate() {
        let b = &polygon[(i + 1) % polygon.len()];
        let (at_a, at_b) = (excess(a), excess(b));
        if at_a <= 0.0 {
            kept.push(*a);
        }
        if (at_a < 0.0) != (at_b < 0.0) && at_a != at_b {
            let share = at_a / (at_a - at_b);
            kept.push([a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])]);
        }
    }
    *polygon = kept;
}

fn centroid(polygon: &[Point]) -> Point {
    let (mut area, mut sum) = (0.0, [0.0; 2]);
    for (i, a) in polygon.iter().enumerate() {
        let b = &polygon[(i + 1) % polygon.len()];
        let part = a[0] * b[1] - a[1] * b[0];
        area += part;
        sum = [sum[0] + part * (a[0] + b[0]), sum[1] + part * (a[1] + b[1])];
    }
    [sum[0] / (3.0 * area), sum[1] / (3.0 * area)]
}

fn header() -> String {
    let (width, height) = (WIDTH * SHOWN.len() as f64, HEIGHT + CAPTION + KEY);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" role=\"img\" \
         aria-label=\"Lloyd's iterations, vertices coloured by displacement per tolerance\">\n\
         <style>{STYLE}</style>\n\
         <rect width=\"{width}\" height=\"{height}\" rx=\"10\" fill=\"#fff\"/>\n"
    )
}

fn class(share: f64) -> &'static str {
    CLASSES.iter().find(|(greatest, _, _)| share < *greatest).map_or("out", |&(_, class, _)| class)
}

fn draw(
    picture: &mut String,
    panel: usize,
    iteration: usize,
    positions: &[Point],
    edges: &BTreeSet<[VertexId; 2]>,
    shares: &[f64],
) {
    let x = WIDTH * (panel as f64 + 0.5);
    let _ = writeln!(picture, "<g transform=\"translate({x} {})\">", HEIGHT / 2.0 + 4.0);
    let corner = |v: VertexId| format!("{:.1} {:.1}", positions[v][0], -positions[v][1]);
    let lines = edges.iter().fold(String::new(), |d, &[a, b]| d + &format!("M{}L{}", corner(a), corner(b)));
    let _ = writeln!(picture, "<path class=\"edges\" d=\"{lines}\"/>");
    for (p, &share) in positions.iter().zip(shares) {
        let [x, y] = [p[0], -p[1]];
        let _ =
            writeln!(picture, "<circle class=\"{}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.1\"/>", class(share));
    }
    let n_within = shares.iter().filter(|&&share| share < 1.0).count();
    let y = HEIGHT / 2.0 + 16.0;
    let _ = writeln!(picture, "<text class=\"title middle\" y=\"{y}\">iteration {iteration}</text>");
    let _ = writeln!(
        picture,
        "<text class=\"middle\" y=\"{}\">{n_within} of {N} vertices within tolerance</text>\n</g>",
        y + 20.0
    );
}

fn key(picture: &mut String) {
    let y = HEIGHT + CAPTION + 20.0;
    let mut x = 170.0;
    let _ = writeln!(picture, "<text x=\"{x}\" y=\"{y}\">displacement / tolerance:</text>");
    x += 172.0;
    for (_, class, text) in CLASSES {
        let _ = writeln!(picture, "<circle class=\"{class}\" cx=\"{x}\" cy=\"{}\" r=\"5\"/>", y - 4.0);
        let _ = writeln!(picture, "<text x=\"{}\" y=\"{y}\">{text}</text>", x + 12.0);
        x += 52.0 + 7.0 * text.len() as f64;
    }
}
