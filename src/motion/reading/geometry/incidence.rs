//! What meets what: edges, the neighbours and the cells of each vertex, and facets seen from the other side.
//!
//! Lists by vertex are ordered by id or index, so that neighbours and edges are a function of positions and ids alone.
//!
//! Cost: a pass over the cells to list those of each vertex; for neighbours a second one over these lists, in which a
//! vertex is recognised by the round in which it has been seen last. By Euler's formula the number of edges follows
//! from those of vertices, cells and hull facets.

use std::ops::Range;

use crate::complex::Corners;
use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::machine::prefetch::prefetch;
use crate::motion::state::cells::{Cells, NO_CORNER};
use crate::motion::triangulation::MovingTriangulation;

/// How many vertices in advance to ask for the cells of one.
const STARS_AHEAD: usize = 2;

/// An edge, and a cell of it.
pub(crate) type EdgeWithCell = ([VertexId; 2], CellId);

/// A list for each vertex, one after the other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rows<T> {
    /// Where the list of each id begins; then where the last one ends.
    pub offsets: Vec<u32>,
    /// All lists.
    pub entries: Vec<T>,
}

impl<T> Rows<T> {
    /// The list of a vertex.
    pub fn row(&self, vertex: VertexId) -> &[T] {
        &self.entries[self.range(vertex.index())]
    }

    fn range(&self, vertex: usize) -> Range<usize> {
        self.offsets[vertex] as usize..self.offsets[vertex + 1] as usize
    }
}

/// For each of `n_ids` vertices the first of these cells that has it as a corner; [`CellId::NONE`] where there is none.
pub(crate) fn first_cells<G: Moving>(corners: &[G::Vertices], n_ids: usize) -> Result<Vec<CellId>> {
    let mut first = Vec::new();
    memory::lengthen(&mut first, n_ids, CellId::NONE)?;
    for (cell, row) in CellId::range(0..corners.len()).zip(corners).rev() {
        row.as_ref().iter().for_each(|&v| first[v] = cell);
    }
    Ok(first)
}

/// The vertices that share a cell with a vertex.
pub(super) struct Neighbours<'t, G: Moving> {
    corners: &'t [G::Vertices],
    stars: Rows<CellId>,
    /// In which round each vertex has been seen last.
    seen_in: Vec<u32>,
    /// The number of this round.
    round: u32,
}

impl<'t, G: Moving> Neighbours<'t, G> {
    pub(super) fn new(cells: &'t Cells<G>, n_ids: usize) -> Result<Self> {
        Self::of(cells, n_ids, CellId::range(0..cells.corners().len()))
    }

    /// Of vertices of which all cells are among these, which are ascending.
    pub(super) fn of(
        cells: &'t Cells<G>,
        n_ids: usize,
        chosen: impl ExactSizeIterator<Item = CellId> + Clone,
    ) -> Result<Self> {
        let stars = stars_of(cells, n_ids, chosen)?;
        let mut seen_in = Vec::new();
        memory::reserve_exact(&mut seen_in, n_ids)?;
        seen_in.resize(n_ids, 0);
        Ok(Neighbours { corners: cells.corners(), stars, seen_in, round: 0 })
    }

    /// The cells of a vertex, ascending.
    pub(super) fn star(&self, vertex: VertexId) -> &[CellId] {
        self.stars.row(vertex)
    }

    /// Appends what `entry` makes of each neighbour of a vertex that is not below `least`, and of a cell that both
    /// share, in ascending order, to a list with room for them.
    #[inline(always)]
    fn append<T: Ord>(
        &mut self,
        vertex: VertexId,
        least: VertexId,
        list: &mut Vec<T>,
        entry: impl Fn(VertexId, CellId) -> T,
    ) {
        let (first, star) = (list.len(), self.stars.row(vertex));
        // Vertices with cells are too few for as many rounds as there are numbers.
        self.round += u32::from(!star.is_empty());
        self.seen_in[vertex.index()] = self.round;
        for &cell in star {
            for &other in self.corners[cell].as_ref() {
                let seen_in = &mut self.seen_in[other.index()];
                if other >= least && *seen_in != self.round {
                    *seen_in = self.round;
                    debug_assert!(list.len() < list.capacity());
                    list.push(entry(other, cell));
                }
            }
        }
        list[first..].sort_unstable();
    }

    /// Asks for what the lists of a vertex will be made from, if there is such a vertex.
    #[inline(always)]
    pub(super) fn prefetch(&self, vertex: usize) {
        if vertex + 1 < self.stars.offsets.len() {
            self.stars.entries[self.stars.range(vertex)]
                .iter()
                .for_each(|cell| prefetch(self.corners, cell.index()));
        }
    }

    /// Clears a list, and [appends](Self::append) to it.
    #[inline(always)]
    pub(super) fn list<T: Ord>(
        &mut self,
        vertex: VertexId,
        least: VertexId,
        list: &mut Vec<T>,
        entry: impl Fn(VertexId, CellId) -> T,
    ) -> Result<()> {
        list.clear();
        memory::reserve(list, self.stars.row(vertex).len() * G::D)?;
        self.append(vertex, least, list, entry);
        Ok(())
    }
}

/// The cells of each vertex, ascending.
pub(super) fn stars<G: Moving>(cells: &Cells<G>, n_ids: usize) -> Result<Rows<CellId>> {
    stars_of(cells, n_ids, CellId::range(0..cells.corners().len()))
}

/// Of each vertex those of these cells, which are ascending.
fn stars_of<G: Moving>(
    cells: &Cells<G>,
    n_ids: usize,
    chosen: impl ExactSizeIterator<Item = CellId> + Clone,
) -> Result<Rows<CellId>> {
    let corners = cells.corners();
    let (mut offsets, mut entries) = (Vec::new(), Vec::new());
    let n_entries = chosen.len() * G::Corners::N;
    memory::reserve_exact(&mut offsets, n_ids + 2)?;
    memory::reserve_exact(&mut entries, n_entries)?;
    // The number of cells of each vertex two entries on, then where its list begins one entry on: when this has moved
    // to the end of the list, it is where the next one begins.
    offsets.resize(n_ids + 2, 0);
    entries.resize(n_entries, CellId::NONE);
    for cell in chosen.clone() {
        for &vertex in corners[cell].as_ref() {
            offsets[vertex.index() + 2] += 1;
        }
    }
    for k in 2..offsets.len() {
        offsets[k] += offsets[k - 1];
    }
    for cell in chosen {
        for &vertex in corners[cell].as_ref() {
            let place = &mut offsets[vertex.index() + 1];
            entries[*place as usize] = cell;
            *place += 1;
        }
    }
    offsets.pop();
    Ok(Rows { offsets, entries })
}

impl<G: Moving> MovingTriangulation<G> {
    /// Number of edges.
    pub fn edge_count(&self) -> usize {
        let (cells, hull) = (self.cell_count(), self.mesh.kernel.complex().n_ghosts());
        if cells == 0 {
            return 0;
        }
        let places = self.mesh.n_present - self.mesh.hidden.count() - self.mesh.kernel.n_hidden();
        // Vertices - edges + facets (- cells) = 1, where in space 2 facets = 4 cells + hull facets.
        if G::D == 2 { places + cells - 1 } else { places + cells + hull / 2 - 1 }
    }

    /// The edges, each once and with the lower id first, in lexicographic order.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn edges(&self) -> Result<Vec<[VertexId; 2]>> {
        let n_ids = self.id_count();
        let mut neighbours = Neighbours::new(self.cell_arrays()?, n_ids)?;
        let (mut edges, mut list) = (Vec::new(), Vec::new());
        memory::reserve_exact(&mut edges, self.edge_count())?;
        for vertex in VertexId::range(0..n_ids) {
            neighbours.prefetch(vertex.index() + STARS_AHEAD);
            neighbours.list(vertex, vertex, &mut list, |other, _| other)?;
            edges.extend(list.iter().map(|&other| [vertex, other]));
        }
        debug_assert_eq!(edges.len(), self.edge_count());
        Ok(edges)
    }

    /// The vertices with which each one shares an edge, ascending; none for those that are hidden or removed.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let points = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&points, Options::default())?;
    /// let neighbours = t.vertex_neighbours()?;
    /// assert_eq!(neighbours.row(VertexId::new(3)), [0, 1, 2].map(VertexId::new));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn vertex_neighbours(&self) -> Result<Rows<VertexId>> {
        let n_ids = self.id_count();
        let mut neighbours = Neighbours::new(self.cell_arrays()?, n_ids)?;
        let (mut offsets, mut entries) = (Vec::new(), Vec::new());
        memory::reserve_exact(&mut offsets, n_ids + 1)?;
        memory::reserve_exact(&mut entries, 2 * self.edge_count())?;
        offsets.push(0);
        for vertex in VertexId::range(0..n_ids) {
            neighbours.prefetch(vertex.index() + STARS_AHEAD);
            neighbours.append(vertex, VertexId::new(0), &mut entries, |other, _| other);
            offsets.push(entries.len() as u32);
        }
        Ok(Rows { offsets, entries })
    }

    /// The cells of which each vertex is a corner, ascending; none for those that are hidden or removed.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn vertex_cells(&self) -> Result<Rows<CellId>> {
        stars(self.cell_arrays()?, self.id_count())
    }

    /// For each cell and each of its corners the corner of the neighbour across the facet opposite it that is opposite
    /// the same facet, in the order of [`cells`](Self::cells); [`NO_CORNER`] on the hull, and after the last corner.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn mirror_indices(&self) -> Result<impl ExactSizeIterator<Item = [u8; 4]> + '_> {
        let cells = self.cell_arrays()?;
        let indices = CellId::range(0..cells.corners().len());
        Ok(indices.map(move |index| cells.mirrors(&self.mesh.kernel, index)))
    }

    /// The corner of the neighbour across the facet opposite `corner` of `cell` that is opposite the same facet; `None`
    /// on the hull, or if there is no such facet.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn mirror_index(&self, cell: CellId, corner: usize) -> Result<Option<usize>> {
        let cells = self.cell_arrays()?;
        if cell.index() >= cells.corners().len() || corner > G::D {
            return Ok(None);
        }
        let mirror = cells.mirrors(&self.mesh.kernel, cell)[corner];
        Ok((mirror != NO_CORNER).then_some(usize::from(mirror)))
    }
}
