//! Meshes of six domains from nothing: how many cells they have, and how long a cell takes.
//!
//! `cargo bench --bench refine -- FOLDER` also writes each domain there as a .poly file, and the table as refine.csv;
//! `python/bench/refine.py FOLDER` then does the work again by PyPI's `triangle`, where that is installed.
//!
//! `cargo bench --bench refine -- loop` has a beam move instead, and prints what coarsening and refinement take in a step.

mod domains;
mod looping;

use deldrift::motion::{MovingTriangulation, NO_CELL, Options, Quality, RefineOptions, Segment};
use deldrift::{CellId, Plane, SegmentId, VertexId};
use domains::{Domain, domains};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Least angle in degrees and greatest area, 0 for none.
const QUALITIES: [(f64, f64); 5] = [(30.0, 0.0), (30.0, 1e-2), (30.0, 1e-3), (30.0, 1e-4), (30.0, 1e-5)];

const RUNS: usize = 5;

/// The text of a .poly file.
fn poly(domain: &Domain) -> String {
    let mut text = format!("{} 2 0 0\n", domain.points.len());
    for (k, [x, y]) in domain.points.iter().enumerate() {
        writeln!(text, "{k} {x:?} {y:?}").expect("a string grows");
    }
    writeln!(text, "{} 0", domain.edges.len()).expect("a string grows");
    for (k, [v, w]) in domain.edges.iter().enumerate() {
        writeln!(text, "{k} {v} {w}").expect("a string grows");
    }
    writeln!(text, "{}", domain.holes.len()).expect("a string grows");
    for (k, [x, y]) in domain.holes.iter().enumerate() {
        writeln!(text, "{k} {x:?} {y:?}").expect("a string grows");
    }
    text
}

fn build(domain: &Domain) -> MovingTriangulation<Plane> {
    let mut t = MovingTriangulation::new(&domain.points, Options { threads: 1, ..Options::default() })
        .expect("good points");
    let segment = |(k, edge): (usize, &[usize; 2])| Segment {
        ends: edge.map(VertexId::at),
        marker: k as i32,
        ..Segment::default()
    };
    let segments: Vec<_> = domain.edges.iter().enumerate().map(segment).collect();
    t.stage_segments(segments.into_iter()).expect("present");
    t.commit_timestamp().expect("no conflict");
    t
}

/// The cells that an odd number of loops is around.
fn mask(t: &MovingTriangulation<Plane>, n_loops: usize) -> Vec<u8> {
    let cells = t.cells().expect("room");
    let sides: Vec<_> = t.segments_of_cells().expect("room");
    let is_wall = |c: CellId, i: usize| {
        let side = sides[c.index()][i];
        side != SegmentId::NONE && t.original_segment(side).index() < n_loops
    };
    let mut parity = vec![u8::MAX; cells.corners.len()];
    let mut waiting = Vec::new();
    for c in CellId::range(0..cells.corners.len()) {
        for i in 0..3 {
            if cells.neighbours[c][i] == NO_CELL && parity[c.index()] == u8::MAX {
                parity[c.index()] = u8::from(is_wall(c, i));
                waiting.push(c);
            }
        }
    }
    while let Some(c) = waiting.pop() {
        for (i, beyond) in cells.neighbours[c].into_iter().enumerate() {
            if beyond != NO_CELL && parity[beyond.index()] == u8::MAX {
                parity[beyond.index()] = parity[c.index()] ^ u8::from(is_wall(c, i));
                waiting.push(beyond);
            }
        }
    }
    parity
}

fn main() {
    let folder = std::env::args().skip(1).find(|argument| !argument.starts_with("--")).map(PathBuf::from);
    if folder.as_deref() == Some(Path::new("loop")) {
        return looping::run();
    }
    let mut table = String::from("domain,angle,area,cells,bad,seconds,again_seconds\n");
    for domain in domains() {
        for (least_angle, greatest_area) in QUALITIES {
            let quality = Quality { least_angle, greatest_area, ..Quality::default() };
            let (mut cells, mut bad) = (0, 0);
            let [mut best, mut again] = [f64::INFINITY; 2];
            for _ in 0..RUNS {
                let mut t = build(&domain);
                let before = mask(&t, domain.n_loops);
                let start = Instant::now();
                let report = t.refine(&quality, &RefineOptions::default(), &before).expect("a domain");
                t.cells().expect("room");
                best = best.min(start.elapsed().as_secs_f64());
                let after = mask(&t, domain.n_loops);
                let start = Instant::now();
                t.refine(&quality, &RefineOptions::default(), &after).expect("a domain");
                again = again.min(start.elapsed().as_secs_f64());
                (cells, bad) = (after.iter().filter(|&&c| c == 1).count(), report.bad_cells);
            }
            let row = format!(
                "{},{least_angle},{greatest_area:e},{cells},{bad},{best:.3e},{again:.3e}",
                domain.name
            );
            println!(
                "{row}  ({:.0} ns a cell, {:.1} when good)",
                best / cells as f64 * 1e9,
                again / cells as f64 * 1e9
            );
            writeln!(table, "{row}").expect("a string grows");
        }
        if let Some(folder) = &folder {
            std::fs::write(folder.join(domain.name).with_extension("poly"), poly(&domain)).expect("a folder");
        }
    }
    if let Some(folder) = folder {
        std::fs::write(folder.join("refine.csv"), table).expect("a folder");
    }
}
