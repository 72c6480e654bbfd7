//! Triangulations of sets that repeat: each vertex is in all places to which a [lattice](lattice) takes it.
//!
//! Inside is a triangulation of the plane or of space that has each vertex once, *at home*, in a cell of the lattice, and the
//! *images* of vertices that have a common cell with one at home, or may have one. Each cell of the repeating set
//! is there, with all of its neighbours, for each vertex of it that is at home.
//!
//! # Which images are needed
//!
//! An image of u by −s is needed if the ball of a cell at u, or the half-space beyond a facet of the hull there, meets the
//! cell of the lattice that is translated by s. They are inserted until none is missing. Then all cells at vertices at home are
//! those of the repeating set: suppose that C, a cell at u, has another vertex in its ball. Of the cells at u in the
//! repeating set, take the one where a way from u into C begins. It has a vertex y in the ball of C, as at u the
//! lifted planes of both agree, and along the way that of the set is lower. y is at home by a translation s, whose cell
//! meets the ball of C. So u by −s is there, and −s takes y home. The edge from u to y is one of any
//! triangulation that has both, and the ball of a cell at it touches u. So −s takes home what takes y to its image, which
//! is there, and would be a corner. (A process that sends its vertices to others by this rule is the origin of this proof: here
//! all processes are translations of one.)
//!
//! What is farther than the lattice allows for vertices of one cell is not inserted (lattice.rs).
//!
//! # Cost
//!
//! That of the triangulation inside, which for n vertices has some n + c n^(1 - 1/D) images, and a pass over its cells.

mod cells;
mod lattice;
#[cfg(test)]
mod tests;

use crate::delaunay::Dimension;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::{CommitReport, MovingTriangulation, NO_CELL, Options};
use lattice::{HOME, Lattice, Shift};
use std::collections::HashSet;

/// Images up to so many mean distances of vertices outside of a cell of the lattice are there from the beginning.
const MARGIN: f64 = 1.5;

/// A Delaunay triangulation of a set of vertices that repeats, and that move.
#[derive(Debug)]
pub struct PeriodicTriangulation<G: Dimension> {
    inside: MovingTriangulation<G>,
    lattice: Lattice<G>,
    /// By vertex, the translation by which it went from where it was given to home: it is where it was given less that.
    wraps: Vec<[i64; 3]>,
    /// By vertex inside, which image it is. The first ones are at home.
    images: Vec<(VertexId, Shift)>,
    /// Those that are there.
    present: HashSet<(VertexId, Shift)>,
    n_vertices: usize,
    cells: cells::PeriodicCells<G>,
}

impl<G: Dimension> PeriodicTriangulation<G> {
    /// Triangulates `positions` and all places to which sums of the vectors of `basis` take them.
    ///
    /// # Errors
    /// Those of [`MovingTriangulation::new`]; [`Error::InvalidValue`] for vectors that depend on each other.
    pub fn new(positions: &[G::Point], basis: &[G::Point], options: Options) -> Result<Self> {
        let lattice = Lattice::<G>::new(basis)?;
        let (mut home, mut wraps, mut images) = (Vec::new(), Vec::new(), Vec::new());
        for (index, position) in positions.iter().enumerate() {
            let (place, wrap) = lattice.wrapped("positions", index, position)?;
            memory::push(&mut home, place)?;
            memory::push(&mut wraps, wrap)?;
            memory::push(&mut images, (VertexId::at(index), HOME))?;
        }
        let n_vertices = home.len();
        let mut present = HashSet::new();
        let mut margin = MARGIN * spacing(&lattice, &home);
        let inside = loop {
            images.truncate(n_vertices);
            present.clear();
            let mut places = memory::copy_of(&home)?;
            for (v, place) in VertexId::range(0..n_vertices).zip(&home) {
                let [a, b, c] = lattice.shifts_to(place, margin);
                for (x, y, z) in all(a, b, c) {
                    // The cell of the lattice that is translated by this meets the ball: what takes it home takes the
                    // vertex near home.
                    let shift = [-x, -y, -z];
                    if shift != HOME {
                        memory::push(&mut images, (v, shift))?;
                        memory::push(&mut places, lattice.translated(place, shift))?;
                    }
                }
            }
            let keys = keys_of(&images)?;
            let t = MovingTriangulation::<G>::with_keys(&places, &keys, options_of(&options))?;
            let are_all = margin.is_infinite();
            if t.cell_count() > 0 || are_all || n_vertices == 0 {
                break t;
            }
            margin =
                if margin > 0.0 && margin < 1e3 * lattice.measure() { 4.0 * margin } else { f64::INFINITY };
        };
        present.try_reserve(images.len()).map_err(|_| Error::OutOfMemory { bytes: images.len() * 16 })?;
        present.extend(images.iter().copied());
        let cells = cells::PeriodicCells::default();
        let mut t = PeriodicTriangulation { inside, lattice, wraps, images, present, n_vertices, cells };
        t.complete()?;
        t.cells.read(&t.inside, &t.images, t.n_vertices)?;
        Ok(t)
    }

    /// Number of cells that are not translations of each other.
    pub fn cell_count(&self) -> usize {
        self.cells.corners.len()
    }

    /// Number of vertices inside: those at home and images.
    pub fn image_count(&self) -> usize {
        self.images.len()
    }

    /// The corners of each cell.
    pub fn corners(&self) -> &[G::Vertices] {
        &self.cells.corners
    }

    /// By cell and corner, the translation by which the vertex is there from where it was given, in multiples of the basis.
    pub fn shifts(&self, cell: usize, corner: usize) -> [i64; 3] {
        let v = self.cells.corners[cell].as_ref()[corner];
        let shift = self.cells.shifts[cell * (G::D + 1) + corner];
        let total = [0, 1, 2].map(|j| i64::from(shift[j]) - self.wraps[v][j]);
        self.lattice.of_caller(total)
    }

    /// By cell and corner, the shift from home.
    pub fn shift_from_home(&self, cell: usize, corner: usize) -> [i32; 3] {
        self.cells.shifts[cell * (G::D + 1) + corner]
    }

    /// Moves all vertices.
    pub fn commit(&mut self, positions: &[G::Point]) -> Result<CommitReport> {
        let mut goals = Vec::new();
        let mut ids = Vec::new();
        for (k, &(v, shift)) in self.images.iter().enumerate() {
            let (place, wrap) = self.lattice.wrapped("positions", v.index(), &positions[v])?;
            self.wraps[v] = wrap;
            memory::push(&mut goals, self.lattice.translated(&place, shift))?;
            memory::push(&mut ids, VertexId::at(k))?;
        }
        self.inside.move_vertices(&ids, &goals)?;
        let report = self.inside.commit_timestamp()?;
        self.complete()?;
        self.cells.read(&self.inside, &self.images, self.n_vertices)?;
        Ok(report)
    }

    /// Inserts images that are missing until there are none.
    fn complete(&mut self) -> Result<()> {
        loop {
            let missing = self.missing()?;
            if missing.is_empty() {
                return Ok(());
            }
            let mut places = Vec::new();
            for &(v, shift) in &missing {
                let home = self.inside.position(v)?;
                memory::push(&mut places, self.lattice.translated(&home, shift))?;
            }
            memory::append(&mut self.images, &missing)?;
            self.inside.stage_insertions_with_keys(&places, &keys_of(&missing)?)?;
            self.inside.commit_timestamp()?;
        }
    }

    /// Images that are needed and not there; they are taken to be there from now on.
    fn missing(&mut self) -> Result<Vec<(VertexId, Shift)>> {
        let mut missing = Vec::new();
        let cells = self.inside.cells()?;
        let spheres = self.inside.circumspheres()?;
        for (c, (centre, square)) in spheres.enumerate() {
            let row = cells.corners[c];
            let row = row.as_ref();
            if row.iter().all(|v| v.index() >= self.n_vertices) {
                continue;
            }
            let radius = square.sqrt() * RADIUS;
            let is_at_hull = cells.neighbours[c].as_ref().iter().any(|&n| n == NO_CELL);
            let [x, y, z] =
                if is_at_hull { self.lattice.all_shifts() } else { self.lattice.shifts_to(&centre, radius) };
            if [&x, &y, &z].iter().all(|range| **range == (0..=0)) {
                continue;
            }
            for &v in row.iter().filter(|v| v.index() < self.n_vertices) {
                for (a, b, c) in all(x.clone(), y.clone(), z.clone()) {
                    let shift = [-a, -b, -c];
                    if self.present.len() == self.present.capacity() {
                        let bytes = self.present.len() * 16;
                        self.present.try_reserve(1).map_err(|_| Error::OutOfMemory { bytes })?;
                    }
                    if self.present.insert((v, shift)) {
                        memory::push(&mut missing, (v, shift))?;
                    }
                }
            }
        }
        Ok(missing)
    }
}

/// What makes a rounded radius one that certainly is no less than the distance of a corner from a rounded centre.
const RADIUS: f64 = 1.0 + 1e-8;

type Range = std::ops::RangeInclusive<i32>;

fn all(a: Range, b: Range, c: Range) -> impl Iterator<Item = (i32, i32, i32)> {
    a.flat_map(move |x| {
        let c = c.clone();
        b.clone().flat_map(move |y| c.clone().map(move |z| (x, y, z)))
    })
}

/// Images have the key of their vertex: ties between images of one are broken by position.
fn keys_of(images: &[(VertexId, Shift)]) -> Result<Vec<u64>> {
    let mut keys = Vec::new();
    memory::collect(&mut keys, images.iter().map(|(v, _)| u64::from(v.get())))?;
    Ok(keys)
}

/// The mean distance of vertices.
fn spacing<G: Dimension>(lattice: &Lattice<G>, home: &[G::Point]) -> f64 {
    let n = home.len().max(1) as f64;
    // Along axes that are open, the box of the vertices.
    (lattice.measure() / n).powf(1.0 / lattice.rank().max(1) as f64)
}

fn options_of(options: &Options) -> Options {
    Options { algorithm: options.algorithm, threads: options.threads, ..Options::default() }
}
