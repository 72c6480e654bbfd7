//! Shared by the test crates: seeded numbers, views of cells as sets, and an exact integer oracle.
#![allow(dead_code)] // Each test crate uses a part.

pub mod carried;
pub mod exact;
pub mod files;
pub mod history;
pub mod inputs;
pub mod passing_by_roots;
pub mod random;

use deldrift::motion::{Level, MovingTriangulation, NO_CELL, Options};
use deldrift::{CellId, Moving, VertexId};
pub use random::Rng;
use std::collections::BTreeSet;
use std::io::{self, Write};

/// How many seeds a test takes: `n` times what the environment variable `DELDRIFT_SOAK` says, if anything, and at least
/// one.
pub fn seeds(n: u64) -> std::ops::Range<u64> {
    let factor: f64 =
        std::env::var("DELDRIFT_SOAK").map_or(1.0, |soak| soak.parse().expect("DELDRIFT_SOAK is a number"));
    0..((n as f64 * factor).ceil() as u64).max(1)
}

/// Says what cannot be tested here, and why: `make test` repeats such lines at its end. Not by a macro, whose text is not
/// shown where the test passes.
pub fn skipped(what: &str, reason: &str) {
    let text = format!("SKIPPED {what}: {reason}\n");
    io::stderr().write_all(text.as_bytes()).expect("it can be told");
}

/// A point from coordinates.
pub fn point<G: Moving>(coordinate: impl FnMut(usize) -> f64) -> G::Point {
    let mut p = G::Point::default();
    for (k, x) in (0..G::D).map(coordinate).enumerate() {
        p[k] = x;
    }
    p
}

/// Vertices of these ids.
pub fn ids<const N: usize>(numbers: [u32; N]) -> [VertexId; N] {
    numbers.map(VertexId::new)
}

/// The vertex of an id.
pub const fn vertex(id: u32) -> VertexId {
    VertexId::new(id)
}

/// All vertices that there may be, in the order of their ids.
pub fn vertices() -> impl Iterator<Item = VertexId> {
    (0..).map(VertexId::new)
}

/// A set of cells, each as its ascending vertex ids.
pub type CellSet = BTreeSet<Vec<VertexId>>;

pub fn sorted(corners: &[VertexId]) -> Vec<VertexId> {
    let mut ids = corners.to_vec();
    ids.sort_unstable();
    ids
}

/// The cells of a triangulation.
pub fn cell_set<G: Moving>(t: &MovingTriangulation<G>) -> CellSet {
    t.cells().expect("room").corners.iter().map(|c| sorted(c.as_ref())).collect()
}

/// The cells of a fresh build of the present vertices, by their ids here: a build from scratch numbers its
/// vertices from 0, so present ids are mapped in ascending order, on which alone ties depend.
pub fn fresh_cells<G: Moving>(positions: &[Option<G::Point>]) -> CellSet {
    let present: Vec<VertexId> =
        VertexId::range(0..positions.len()).filter(|&v| positions[v].is_some()).collect();
    let points: Vec<G::Point> = positions.iter().copied().flatten().collect();
    let fresh = MovingTriangulation::<G>::new(&points, Options::default()).expect("a fresh build");
    fresh.validate(Level::Delaunay).expect("a valid fresh build");
    let named = |c: &Vec<VertexId>| c.iter().map(|&i| present[i]).collect();
    cell_set(&fresh).iter().map(named).collect()
}

/// Panics with the first few differences of two sets of cells.
pub fn assert_same_cells(found: &CellSet, expected: &CellSet, context: impl Fn() -> String) {
    if found != expected {
        let extra: Vec<_> = found.difference(expected).take(5).collect();
        let missing: Vec<_> = expected.difference(found).take(5).collect();
        panic!(
            "{}: {} cells, not {}; wrongly there: {extra:?}, missing: {missing:?}",
            context(),
            found.len(),
            expected.len()
        );
    }
}

/// Checks what a caller relies on when reading cells: no cell is listed twice; neighbour
/// `i` is opposite corner `i`, has the other corners too and knows its way back; where
/// there is none, the facet is in no other cell.
pub fn check_adjacency<G: Moving>(t: &MovingTriangulation<G>, context: &dyn Fn() -> String) {
    let view = t.cells().expect("room");
    assert_eq!(view.corners.len(), view.neighbours.len(), "{}", context());
    assert_eq!(view.corners.len(), t.cell_count(), "{}", context());
    assert_eq!(cell_set(t).len(), t.cell_count(), "{}: a cell is listed twice", context());
    let facet = |c: CellId, i: usize| {
        let mut ids = view.corners[c].as_ref().to_vec();
        ids.remove(i);
        sorted(&ids)
    };
    let mut hull = BTreeSet::new();
    let mut inner = BTreeSet::new();
    for c in CellId::range(0..view.corners.len()) {
        for i in 0..=G::D {
            let n = view.neighbours[c][i];
            if n == NO_CELL {
                assert!(hull.insert(facet(c, i)), "{}: a hull facet is there twice", context());
                continue;
            }
            let back = (0..=G::D).find(|&j| view.neighbours[n][j] == c && facet(n, j) == facet(c, i));
            assert!(back.is_some(), "{}: cells {c} and {n} do not share facet {:?}", context(), facet(c, i));
            inner.insert(facet(c, i));
        }
    }
    assert!(hull.is_disjoint(&inner), "{}: a facet is on the hull and within", context());
}
