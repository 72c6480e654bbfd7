//! Cells that pass every check of a cell, a facet and a ridge, and are no triangulation: no cell is negative, no facet
//! fails its test, and the hull is convex wherever two of its facets meet. And other data that might take long.

use super::{Parts, Weighted};

const NONE: u32 = u32::MAX;

/// Cells that are all apart from each other, of the vertices in the order of their ids.
fn apart(dimension: usize, positions: Vec<f64>) -> Parts {
    let (n, n_corners) = (positions.len() / dimension, dimension + 1);
    let mut cells: Vec<u32> = (0..(n / n_corners * n_corners) as u32).collect();
    for row in cells.chunks_exact_mut(n_corners) {
        if !is_positive(dimension, row, &positions) {
            row.swap(0, 1);
        }
    }
    Parts {
        dimension,
        sums: [0; 13],
        moved: Vec::new(),
        coming: Vec::new(),
        representatives: (0..n as u32).collect(),
        neighbours: vec![NONE; cells.len()],
        cells,
        moves: Vec::new(),
        insertions: Vec::new(),
        removals: Vec::new(),
        weighted: None,
        positions,
    }
}

/// Of corners that are not nearly in one line or plane.
fn is_positive(dimension: usize, row: &[u32], positions: &[f64]) -> bool {
    let place = |v: u32| &positions[v as usize * dimension..][..dimension];
    let largest = row.iter().flat_map(|&v| place(v)).fold(0.0, |most: f64, x| most.max(x.abs()));
    let edge = |i: usize, k: usize| (place(row[i])[k] - place(row[0])[k]) / largest;
    let minor = |i: usize, j: usize, k: usize, l: usize| edge(i, k) * edge(j, l) - edge(i, l) * edge(j, k);
    let volume = if dimension == 2 {
        minor(1, 2, 0, 1)
    } else {
        minor(1, 2, 0, 1) * edge(3, 2) - minor(1, 2, 0, 2) * edge(3, 1) + minor(1, 2, 1, 2) * edge(3, 0)
    };
    volume > 0.0
}

/// Cells of consecutive vertices on the curve (t, t^2, t^3), of which a build has a number of cells that grows like the
/// square of theirs. With the smallest number for a unit no double is inside any.
pub fn moment_curve(dimension: usize, n: usize, unit: f64) -> Parts {
    let whole = (0..n).flat_map(|t| (1..=dimension as i32).map(move |k| (t as f64).powi(k)));
    let mut parts = apart(dimension, whole.collect());
    parts.positions.iter_mut().for_each(|x| *x *= unit);
    parts
}

/// Cells around one point, each within the next.
pub fn shells(dimension: usize, n: usize) -> Parts {
    let first = [[0.0, 4.0, 0.0], [-4.0, -3.0, -1.0], [4.0, -3.0, -1.0], [0.0, 0.0, 6.0]];
    let corner = |k: usize| {
        let (shell, corner) = (k / (dimension + 1), k % (dimension + 1));
        (0..dimension).map(move |axis| first[corner][axis] * (1 + shell) as f64)
    };
    apart(dimension, (0..n).flat_map(corner).collect())
}

/// The same cell again and again, of other vertices at the same places.
pub fn one_place(dimension: usize, n: usize) -> Parts {
    let corner =
        |k: usize| (0..dimension).map(move |axis| f64::from(u8::from(k % (dimension + 1) == axis + 1)));
    apart(dimension, (0..n).flat_map(corner).collect())
}

/// A fan of triangles that goes twice around its first vertex.
pub fn double_fan(n: usize) -> Parts {
    let n_outer = n.max(6) - 1;
    let mut positions = vec![0.0; 2];
    for k in 0..n_outer {
        let angle = 4.0 * std::f64::consts::PI * k as f64 / n_outer as f64;
        positions.extend([angle.cos(), angle.sin()]);
    }
    let mut parts = apart(2, positions);
    let after = |k: usize, step: usize| (k + step) % n_outer;
    parts.cells = (0..n_outer).flat_map(|k| [0, 1 + k as u32, 1 + after(k, 1) as u32]).collect();
    let row = |k: usize| [NONE, after(k, 1) as u32, after(k, n_outer - 1) as u32];
    parts.neighbours = (0..n_outer).flat_map(row).collect();
    parts
}

/// Vertices on a line, without cells, and all at one place, hidden but one.
pub fn line(dimension: usize, n: usize) -> Parts {
    let mut parts = apart(dimension, (0..n).flat_map(|k| (0..dimension).map(move |_| k as f64)).collect());
    (parts.cells, parts.neighbours) = (Vec::new(), Vec::new());
    parts
}

pub fn hidden(dimension: usize, n: usize) -> Parts {
    let mut parts = line(dimension, n);
    parts.positions.fill(1.0);
    parts.representatives.fill(0);
    parts
}

/// Everything staged that can be.
pub fn staged(dimension: usize, n: usize) -> Parts {
    let mut parts = line(dimension, n);
    parts.moves = (0..n as u32 / 2).rev().collect();
    parts.moved = vec![0.5; parts.moves.len() * dimension];
    parts.removals = (n as u32 / 2..n as u32).collect();
    parts.insertions = (n as u32..2 * n as u32).collect();
    parts.coming = vec![0.25; n * dimension];
    parts.positions.extend(vec![f64::NAN; n * dimension]);
    parts.representatives.extend(vec![NONE; n]);
    parts
}

/// With weights: one cell, and all other vertices above it, on a line between two of its corners; they are told in no order.
pub fn covered(dimension: usize, n: usize) -> Parts {
    let corner = |k: usize| (0..dimension).map(move |axis| if k == axis + 1 { n as f64 } else { 0.0 });
    let mut positions: Vec<f64> = (0..=dimension).flat_map(corner).collect();
    let others = (dimension + 1..n).map(|k| (k * 7919 % n) as f64);
    positions.extend(others.flat_map(|x| (0..dimension).map(move |axis| if axis == 0 { x } else { 0.0 })));
    let mut parts = apart(dimension, positions);
    parts.cells.truncate(dimension + 1);
    parts.neighbours.truncate(dimension + 1);
    let mut weighted = Weighted { weights: vec![-1e12; n], below: vec![0; n], ..Weighted::default() };
    weighted.weights[..=dimension].fill(0.0);
    weighted.below[..=dimension].fill(NONE);
    weighted.history[0] = n as u64;
    parts.weighted = Some(weighted);
    parts
}

/// Those that are to be refused for what their hull is, with about `n` vertices.
pub fn of_wrong_hulls(dimension: usize, n: usize) -> Vec<(&'static str, Parts)> {
    let mut all = vec![
        ("moment curve", moment_curve(dimension, n, 1.0)),
        ("thin cells", moment_curve(dimension, n, f64::from_bits(1))),
        ("shells", shells(dimension, n)),
        ("one place", one_place(dimension, n)),
    ];
    if dimension == 2 {
        all.push(("double fan", double_fan(n)));
    }
    for (_, parts) in &mut all {
        // Only whole cells.
        let n_used = parts.cells.iter().max().map_or(0, |&v| v as usize + 1);
        parts.positions.truncate(n_used * dimension);
        parts.representatives.truncate(n_used);
    }
    all
}

/// Those that are legal.
pub fn legal(dimension: usize, n: usize) -> [(&'static str, Parts); 3] {
    [("line", line(dimension, n)), ("hidden", hidden(dimension, n)), ("staged", staged(dimension, n))]
}
