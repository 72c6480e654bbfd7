//! What can be asked.

use std::mem;

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::{Algorithm, CommitReport, OwnedCells};
use crate::periodic::cells::PeriodicView;
use crate::periodic::triangulation::PeriodicTriangulation;

impl<G: Moving> PeriodicTriangulation<G> {
    /// The number of vertices that are there.
    pub fn vertex_count(&self) -> usize {
        self.inside.images.n_present()
    }

    /// The number of ids that have been given, those of staged insertions included.
    pub fn id_count(&self) -> usize {
        self.inside.images.n_vertices() + self.staged.insertions().len()
    }

    /// The number of vertices that are kept in order to know the cells: those that there are, and images of some.
    pub fn image_count(&self) -> usize {
        self.inside.images.len() - self.inside.images.n_gone()
    }

    /// The number of directions in which the set is periodic.
    pub fn vector_count(&self) -> usize {
        self.lattice.rank()
    }

    /// The vectors by which the set repeats: those that were given, on the grid.
    pub fn vectors(&self) -> impl ExactSizeIterator<Item = G::Point> + '_ {
        self.lattice.given().iter().copied()
    }

    /// The vectors of the reduced basis, by whose multiples vertices come home; for each its multiples of the vectors that
    /// were given, and the greatest multiple by which one corner of a cell is translated from where another one is, where
    /// both are at places of [`wrap_positions`](Self::wrap_positions).
    pub fn reduced_vectors(&self) -> impl ExactSizeIterator<Item = (G::Point, [i64; 3], u32)> + '_ {
        let vectors = self.lattice.reduced().iter().enumerate();
        vectors.map(|(j, &vector)| {
            let mut unit = [0; 3];
            unit[j] = 1;
            (vector, self.lattice.of_caller(unit), self.lattice.greatest()[j].unsigned_abs())
        })
    }

    /// The place of each position in the unit cell of the reduced vectors, on the grid, and by which multiples of the vectors
    /// that were given the position is translated from there. With `previous`, the period whose place is nearest to the
    /// entry there, if that is out of the unit cell by a quarter of it at most.
    ///
    /// # Errors
    /// [`Error::WrongCount`] unless there are as many entries of `previous`; [`Error::NotFinite`], [`Error::OutOfRange`],
    /// [`Error::OutOfMemory`].
    pub fn wrap_positions(
        &self,
        positions: &[G::Point],
        previous: Option<&[G::Point]>,
    ) -> Result<Vec<(G::Point, [i64; 3])>> {
        if let Some(previous) = previous.filter(|previous| previous.len() != positions.len()) {
            let (given, wanted) = (previous.len(), positions.len());
            return Err(Error::WrongCount { argument: "the length of previous", given, wanted, coming: 0 });
        }
        let mut wrapped = Vec::new();
        memory::reserve_exact(&mut wrapped, positions.len())?;
        for (index, position) in positions.iter().enumerate() {
            let near = previous.map(|previous| &previous[index]);
            let (place, wrap) = self.lattice.at_home("positions", index, position, near)?;
            wrapped.push((place, self.lattice.of_caller(wrap)));
        }
        Ok(wrapped)
    }

    /// The number of staged moves.
    pub fn staged_count(&self) -> usize {
        self.staged.moves().len()
    }

    /// The numbers of staged insertions and removals.
    pub fn staged_edits(&self) -> (usize, usize) {
        (self.staged.insertions().len(), self.staged.removals().len())
    }

    /// Whether a vertex is there.
    pub fn is_present(&self, vertex: VertexId) -> bool {
        vertex.index() < self.inside.images.n_vertices() && self.inside.images.home(vertex) != VertexId::NONE
    }

    /// Where a vertex is: its position as it was given, on the grid of the lattice.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`], [`Error::RemovedVertex`], [`Error::StagedVertex`].
    pub fn position(&self, vertex: VertexId) -> Result<G::Point> {
        let inside = self.inside.images.check(0, vertex, self.staged.insertions().len());
        let inside = inside.map_err(|mut error| {
            if let Error::NoSuchVertex { argument, .. }
            | Error::RemovedVertex { argument, .. }
            | Error::StagedVertex { argument, .. } = &mut error
            {
                *argument = "vertex";
            }
            error
        })?;
        Ok(self.lattice.unwrapped(&self.inside.t.position(inside)?, &self.wraps[vertex]))
    }

    /// Where a vertex is, or where it will be inserted; none for a removed one.
    pub fn position_or_goal(&self, vertex: VertexId) -> Option<G::Point> {
        let n = self.inside.images.n_vertices();
        if vertex.index() >= n {
            return self.staged.insertions().get(vertex.index() - n).copied();
        }
        self.position(vertex).ok()
    }

    /// The timestamp: 0 at creation, one more at each commit.
    pub fn timestamp(&self) -> u64 {
        self.statistics.timestamp
    }

    /// The sums of the reports of all commits.
    pub fn statistics(&self) -> CommitReport {
        self.statistics
    }

    /// The algorithm of commits.
    pub fn algorithm(&self) -> Algorithm {
        self.inside.t.algorithm()
    }

    /// Changes the algorithm of later commits.
    pub fn set_algorithm(&mut self, algorithm: Algorithm) {
        self.inside.t.set_algorithm(algorithm);
    }

    /// Number of cells that are not translations of each other.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn cell_count(&self) -> Result<usize> {
        Ok(self.read_cells()?.corners.len())
    }

    /// The cells, one of each class of translations of each other; see [`cell_shifts`](Self::cell_shifts) for where they are.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn cells(&self) -> Result<PeriodicView<'_, G>> {
        let cells = self.read_cells()?;
        Ok(PeriodicView { corners: &cells.corners, neighbours: &cells.neighbours })
    }

    /// By cell and corner, by which multiples of the vectors the vertex is translated from its position. The corner of the
    /// lowest id is where it was given, and if there are several images of that in the cell, the first of them by coordinates.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn cell_shifts(&self) -> Result<impl ExactSizeIterator<Item = [i64; 3]> + '_> {
        let cells = self.read_cells()?;
        let n = G::D + 1;
        Ok((0..n * cells.corners.len()).map(move |k| {
            let (cell, corner) = (k / n, k % n);
            let vertex = cells.corners[cell].as_ref()[corner];
            self.given(self.least_of(cells, cell), vertex, cells.shifts.of(cell)[corner])
        }))
    }

    /// By cell and corner, by which multiples of the vectors the neighbour opposite the corner is to be translated from where
    /// it is by its own shifts, to be beside the cell.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn neighbour_shifts(&self) -> Result<impl ExactSizeIterator<Item = [i64; 3]> + '_> {
        let cells = self.read_cells()?;
        let n = G::D + 1;
        Ok((0..n * cells.corners.len()).map(move |k| {
            let (cell, corner) = (k / n, k % n);
            let across = cells.neighbours[cell].as_ref()[corner];
            if across == crate::motion::NO_CELL {
                return [0; 3];
            }
            let from = self.least_of(cells, cell);
            self.given(from, self.least_of(cells, across.index()), cells.neighbour_shifts.of(cell)[corner])
        }))
    }

    /// The edges, one of each class of translations of each other: two vertices, and by which multiples of the vectors the
    /// second is translated from its position where the first is at its own. The first has the lower id; the order is that of
    /// ids.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn edges(&self) -> Result<impl ExactSizeIterator<Item = ([VertexId; 2], [i64; 3])> + '_> {
        Ok(self.read_edges()?.list.iter().map(|(edge, _)| {
            let [from, to] = edge.map(|inside| self.inside.images.of(inside));
            ([from.vertex, to.vertex], self.given(from.vertex, to.vertex, to.shift))
        }))
    }

    /// Number of edges that are not translations of each other.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn edge_count(&self) -> Result<usize> {
        Ok(self.read_edges()?.list.len())
    }

    /// Tolerance of a vertex at its current position, as
    /// [`MovingTriangulation::tolerance`](crate::motion::MovingTriangulation::tolerance) tells it: images move as their
    /// vertices do, and the vectors stay. 0, too, if the vertex alone makes a side of a set that is open across it, as it is on one
    /// line with its images.
    ///
    /// # Errors
    /// The errors of [`position`](Self::position).
    pub fn tolerance(&self, vertex: VertexId) -> Result<f64> {
        self.position(vertex)?;
        self.inside.t.tolerance(self.inside.images.home(vertex))
    }

    /// Hands over the rows of [`cells`](Self::cells), as they are, to a caller who may look at them for longer than until the
    /// next change. The triangulation goes on with copies.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`]; then nothing has been handed over.
    pub fn release_cells(&mut self) -> Result<OwnedCells<G>> {
        self.read_cells()?;
        let cells = self.cells.get_mut().expect("they have been read");
        let (corners, neighbours) = (memory::copy_of(&cells.corners)?, memory::copy_of(&cells.neighbours)?);
        Ok(OwnedCells {
            corners: mem::replace(&mut cells.corners, corners),
            neighbours: mem::replace(&mut cells.neighbours, neighbours),
        })
    }
}
