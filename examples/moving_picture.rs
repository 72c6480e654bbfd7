//! Draws the picture of the README: points in a disk are carried around
//! by a vortex; three successive timestamps.
//!
//! ```sh
//! cargo run --release --example moving_picture > docs/moving.svg
//! ```
//!
//! Everything drawn is read from the library: the cells, which of them the commit has
//! changed, and the numbers in the captions.

use deldrift::Error;
use deldrift::Plane;
use deldrift::VertexId;
use deldrift::motion::{Algorithm, CommitReport, MovingTriangulation, Options};
use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

/// Vertices on the rim, which stay, and inside.
const N_RIM: usize = 26;
const N_INSIDE: usize = 84;

/// Radius of the disk, centre of the vortex, radius of what it moves, and its rotation per timestamp.
const RADIUS: f64 = 150.0;
const CENTRE: [f64; 2] = [14.0, -8.0];
const REACH: f64 = 128.0;
const TURN: f64 = 0.34;

/// Size of a panel, and of the strip below it for the caption.
const WIDTH: f64 = 340.0;
const HEIGHT: f64 = 330.0;
const CAPTION: f64 = 58.0;
const N_PANELS: u32 = 3;

const STYLE: &str = "\
text{font-family:system-ui,'Helvetica Neue',Helvetica,Arial,'DejaVu Sans',sans-serif;text-anchor:middle;fill:#57606a;\
font-size:12.5px}\
.title{font-size:15px;font-weight:600;fill:#24292f}\
.edges{stroke:#c3cad1;stroke-width:1;fill:none;stroke-linecap:round}\
.cells{fill:#ffe3bf;stroke:none}\
.new{stroke:#d9730d;stroke-width:1.7;fill:none;stroke-linecap:round}\
.trails{stroke:#4f94e8;stroke-width:2.4;fill:none;stroke-linecap:round}\
.still{fill:#8c959f}\
.moved{fill:#0a3a7c}";

fn main() -> Result<(), Error> {
    let mut positions = points();
    let options = Options { algorithm: Algorithm::PlacementFlips, ..Options::default() };
    let mut t = MovingTriangulation::<Plane>::new(&positions, options)?;
    let mut before = positions.clone();
    let mut edges_before = edges(t.cells().expect("room").corners);
    let mut picture = header();
    for panel in 0..N_PANELS {
        let mut report = CommitReport::default();
        if panel > 0 {
            before.clone_from(&positions);
            positions.iter_mut().for_each(drift);
            t.move_all(&positions)?;
            report = t.commit_timestamp()?;
        }
        let created = t.take_changes()?.created.to_vec();
        let cells = t.cells().expect("room").corners.to_vec();
        // The first time all are listed.
        let n_changed = if panel > 0 { created.len() } else { 0 };
        let changed: Vec<[VertexId; 3]> = created[..n_changed].iter().map(|&c| cells[c]).collect();
        let all = edges(&cells);
        let shown = Panel {
            before: &before,
            now: &positions,
            changed: &changed,
            kept_edges: all.intersection(&edges_before).copied().collect(),
            new_edges: all.difference(&edges_before).copied().collect(),
        };
        let x = WIDTH * f64::from(panel);
        let _ = writeln!(picture, "<g transform=\"translate({} {})\">", x + WIDTH / 2.0, HEIGHT / 2.0);
        shown.draw(&mut picture);
        caption(&mut picture, &report, changed.len(), cells.len());
        picture.push_str("</g>\n");
        edges_before = all;
    }
    println!("{picture}</svg>");
    Ok(())
}

/// Points spread evenly: a circle, and a sunflower inside it, a little disturbed.
fn points() -> Vec<[f64; 2]> {
    let golden = PI * (3.0 - 5f64.sqrt());
    let on_circle = |radius: f64, angle: f64| [radius * angle.cos(), radius * angle.sin()];
    let rim = (0..N_RIM).map(|i| on_circle(RADIUS, TAU * i as f64 / N_RIM as f64));
    let inside = (0..N_INSIDE).map(|i| {
        let radius = 0.9 * RADIUS * ((i as f64 + 0.5) / N_INSIDE as f64).sqrt();
        let noise = |k: f64| 7.0 * (k * (i as f64 + 1.0)).sin();
        let [x, y] = on_circle(radius, golden * i as f64);
        [x + noise(12.9898), y + noise(78.233)]
    });
    rim.chain(inside).collect()
}

/// One timestamp in the vortex: full rotation at its centre, none beyond its reach.
fn drift(p: &mut [f64; 2]) {
    let [x, y] = [p[0] - CENTRE[0], p[1] - CENTRE[1]];
    let share = (x * x + y * y) / (REACH * REACH);
    if share < 1.0 {
        let (sin, cos) = (TURN * (1.0 - share)).sin_cos();
        *p = [CENTRE[0] + cos * x - sin * y, CENTRE[1] + sin * x + cos * y];
    }
}

/// The edges of triangles, each once, from the lower id to the higher.
fn edges(triangles: &[[VertexId; 3]]) -> BTreeSet<[VertexId; 2]> {
    let edge = |a: VertexId, b: VertexId| [a.min(b), a.max(b)];
    triangles.iter().flat_map(|&[a, b, c]| [edge(a, b), edge(b, c), edge(c, a)]).collect()
}

/// What one timestamp shows.
struct Panel<'a> {
    before: &'a [[f64; 2]],
    now: &'a [[f64; 2]],
    changed: &'a [[VertexId; 3]],
    kept_edges: Vec<[VertexId; 2]>,
    new_edges: Vec<[VertexId; 2]>,
}

impl Panel<'_> {
    /// From the back to the front: changed triangles, edges, trails, vertices.
    fn draw(&self, picture: &mut String) {
        let corner = |v: VertexId| place(self.now[v]);
        let lines = |edges: &[[VertexId; 2]]| {
            edges.iter().fold(String::new(), |d, &[a, b]| d + &format!("M{}L{}", corner(a), corner(b)))
        };
        let cells = self
            .changed
            .iter()
            .fold(String::new(), |d, &[a, b, c]| d + &format!("M{}L{}L{}Z", corner(a), corner(b), corner(c)));
        let trails = self.moved().fold(String::new(), |d, (from, to)| d + &format!("M{from}L{to}"));
        for (class, d) in [
            ("cells", cells),
            ("edges", lines(&self.kept_edges)),
            ("new", lines(&self.new_edges)),
            ("trails", trails),
        ] {
            if !d.is_empty() {
                let _ = writeln!(picture, "<path class=\"{class}\" d=\"{d}\"/>");
            }
        }
        for (from, to) in self.before.iter().zip(self.now) {
            let class = if from == to { "still" } else { "moved" };
            let [x, y] = [to[0], -to[1]];
            let _ = writeln!(picture, "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.6\"/>");
        }
    }

    /// Old and new places of the vertices that have moved.
    fn moved(&self) -> impl Iterator<Item = (String, String)> + '_ {
        let pairs = self.before.iter().zip(self.now).filter(|(from, to)| from != to);
        pairs.map(|(from, to)| (place(*from), place(*to)))
    }
}

/// A place in the picture, where y points down.
fn place(p: [f64; 2]) -> String {
    format!("{:.1} {:.1}", p[0], -p[1])
}

fn header() -> String {
    let (width, height) = (WIDTH * f64::from(N_PANELS), HEIGHT + CAPTION);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"A Delaunay triangulation at three timestamps\">\n\
         <style>{STYLE}</style>\n\
         <rect width=\"{width}\" height=\"{height}\" rx=\"10\" fill=\"#fff\"/>\n"
    )
}

fn caption(picture: &mut String, report: &CommitReport, n_changed: usize, n_cells: usize) {
    let details = match report.timestamp {
        0 => format!("{} vertices, {n_cells} triangles", N_RIM + N_INSIDE),
        _ => format!("{} vertices moved, {n_changed} of {n_cells} triangles changed", report.moved),
    };
    for (y, class, text) in
        [(0.0, " class=\"title\"", format!("timestamp {}", report.timestamp)), (21.0, "", details)]
    {
        let y = HEIGHT / 2.0 + 16.0 + y;
        let _ = writeln!(picture, "<text{class} y=\"{y}\">{text}</text>");
    }
}
