//! What meets what: the neighbours and the cells of each vertex, and facets seen from the other side.
//!
//! A vertex meets an edge or a cell once for each end or corner that it is, as in space, where it is at one place. So an edge from
//! a vertex to itself in another period is met twice, and a cell with a vertex in two periods as well.

use crate::delaunay::{Moving, Plane};
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::{
    NO_CELL, NO_CORNER, Rows, are_many, check_simplices, find_in_stars, first_cells, ordered_star,
};
use crate::periodic::cells::PeriodicCells;
use crate::periodic::triangulation::PeriodicTriangulation;
use crate::predicates::PlanePoint;

impl<G: Moving> PeriodicTriangulation<G> {
    /// The vertices to which edges lead from each one, ascending: one for each edge, so that a vertex is there several times where
    /// edges lead to it in several periods, and itself twice for each edge to itself. None for those that are hidden or removed.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::Options, periodic::PeriodicTriangulation};
    ///
    /// let t = PeriodicTriangulation::<Plane>::new(&[[0.25, 0.25]], &[[1.0, 0.0], [0.0, 1.0]], Options::default())?;
    /// // Three edges lead from the vertex to itself.
    /// assert_eq!(t.vertex_neighbours()?.row(VertexId::new(0)), [VertexId::new(0); 6]);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn vertex_neighbours(&self) -> Result<Rows<VertexId>> {
        let edges = self.edges()?;
        let mut ends = Vec::new();
        memory::reserve_exact(&mut ends, 2 * edges.len())?;
        ends.extend(edges.flat_map(|([u, w], _)| [(u, w), (w, u)]));
        ends.sort_unstable();
        rows_of(&ends, self.id_count())
    }

    /// The cells of which each vertex is a corner, ascending: one for each corner. None for those that are hidden or removed.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn vertex_cells(&self) -> Result<Rows<CellId>> {
        let mut met = Vec::new();
        let cells = self.read_cells()?;
        memory::reserve_exact(&mut met, cells.corners.len() * (G::D + 1))?;
        for (cell, row) in CellId::range(0..cells.corners.len()).zip(&cells.corners) {
            met.extend(row.as_ref().iter().map(|&v| (v, cell)));
        }
        met.sort_unstable();
        rows_of(&met, self.id_count())
    }

    /// A cell of each vertex by id, the first one; [`NO_CELL`] for those that are hidden or removed, whose insertion is staged, and
    /// while there are no cells.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn cell_of_each_vertex(&self) -> Result<Vec<CellId>> {
        first_cells::<G>(&self.read_cells()?.corners, self.id_count())
    }

    /// The cells around the place of a vertex, ascending: one for each corner that is the vertex.
    ///
    /// # Errors
    /// The errors of [`position`](Self::position), and [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn star(&self, vertex: VertexId) -> Result<Vec<CellId>> {
        let mut star = Vec::new();
        self.enter_star(self.represented(vertex)?, &mut star)?;
        star.sort_unstable();
        Ok(star)
    }

    /// For each simplex a cell that has each of its vertices as another corner, in whatever period, `None` if there is none; told to
    /// `found` one after the other. `vertices`: rows of `n_corners` ids, from 1 to `D + 1`. A hidden vertex stands for the one
    /// that represents it. A vertex that is there twice asks for two corners, in different periods.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::Options, periodic::PeriodicTriangulation};
    ///
    /// let t = PeriodicTriangulation::<Plane>::new(&[[0.25, 0.25]], &[[1.0, 0.0], [0.0, 1.0]], Options::default())?;
    /// // Edges lead from the vertex to itself.
    /// t.find_simplices(&[VertexId::new(0); 2], 2, |cell| assert!(cell.is_some()))?;
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`MovingTriangulation::find_simplices`](crate::motion::MovingTriangulation::find_simplices).
    pub fn find_simplices(
        &self,
        vertices: &[VertexId],
        n_corners: usize,
        mut found: impl FnMut(Option<CellId>),
    ) -> Result<()> {
        check_simplices::<G>(vertices.len(), n_corners)?;
        self.check_present(vertices)?;
        let corners = &self.read_cells()?.corners;
        let is_many = are_many(vertices.len() / n_corners, self.vertex_count());
        let all = if is_many { Some(self.vertex_cells()?) } else { None };
        let mut stars = [const { Vec::new() }; 4];
        for row in vertices.chunks_exact(n_corners) {
            let mut wanted = [VertexId::NONE; 4];
            for (k, &vertex) in row.iter().enumerate() {
                wanted[k] = self.represented(vertex)?;
                stars[k].clear();
                if all.is_none() {
                    self.enter_star(wanted[k], &mut stars[k])?;
                }
            }
            let star = |k: usize| all.as_ref().map_or(&stars[k][..], |all| all.row(wanted[k]));
            found(find_in_stars(corners, &wanted[..n_corners], star));
        }
        Ok(())
    }

    /// Adds the cells around the place of a vertex that no other one hides: those inside at its home, as each of its corners is
    /// there in one of them.
    fn enter_star(&self, vertex: VertexId, list: &mut Vec<CellId>) -> Result<()> {
        let (class_of, mut inside) = (&self.read_cells()?.class_of, Vec::new());
        self.inside.t.star(self.inside.images.home(vertex), &mut inside)?;
        memory::collect(list, inside.into_iter().map(|cell| class_of[cell]))
    }

    /// The cells of which at least one of these vertices is a corner: ascending, each once. Vertices may be listed more than
    /// once; hidden ones have no cells.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`](crate::Error::NoSuchVertex), [`Error::RemovedVertex`](crate::Error::RemovedVertex),
    /// [`Error::StagedVertex`](crate::Error::StagedVertex), [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn cells_around(&self, vertices: &[VertexId]) -> Result<Vec<CellId>> {
        self.check_present(vertices)?;
        let mut list = Vec::new();
        for &vertex in vertices {
            if self.represented(vertex)? == vertex {
                self.enter_star(vertex, &mut list)?;
            }
        }
        list.sort_unstable();
        list.dedup();
        Ok(list)
    }

    fn check_present(&self, vertices: &[VertexId]) -> Result<()> {
        let n_coming = self.staged.insertions().len();
        let mut all = vertices.iter().enumerate();
        all.try_for_each(|(index, &vertex)| self.inside.images.check(index, vertex, n_coming).map(drop))
    }

    /// For each cell and each of its corners the corner of the neighbour across the facet opposite it that is opposite the same
    /// facet, in the order of [`cells`](Self::cells); [`NO_CORNER`] on the hull, and after the last corner.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn mirror_indices(&self) -> Result<impl ExactSizeIterator<Item = [u8; 4]> + '_> {
        let cells = self.read_cells()?;
        Ok((0..cells.corners.len()).map(|cell| {
            let mut mirrors = [NO_CORNER; 4];
            (0..=G::D).for_each(|corner| mirrors[corner] = mirror::<G>(cells, cell, corner));
            mirrors
        }))
    }

    /// The corner of the neighbour across the facet opposite `corner` of `cell` that is opposite the same facet; `None` on the
    /// hull, or if there is no such facet.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn mirror_index(&self, cell: CellId, corner: usize) -> Result<Option<usize>> {
        let cells = self.read_cells()?;
        if cell.index() >= cells.corners.len() || corner > G::D {
            return Ok(None);
        }
        let mirror = mirror::<G>(cells, cell.index(), corner);
        Ok((mirror != NO_CORNER).then_some(usize::from(mirror)))
    }
}

impl<P: PlanePoint> PeriodicTriangulation<Plane<P>>
where
    Plane<P>: Moving,
{
    /// The cells around the place of a vertex, counter-clockwise, each once for each of its corners that is the vertex: from the
    /// one of lowest index, or, on the hull of a set that is open somewhere, from the one at the hull's edge that leaves the
    /// vertex when the hull is passed counter-clockwise.
    ///
    /// # Errors
    /// The errors of [`star`](Self::star).
    pub fn ordered_star(&self, vertex: VertexId) -> Result<impl Iterator<Item = CellId> + Clone + '_> {
        let (vertex, cells) = (self.represented(vertex)?, self.read_cells()?);
        let first = self.star(vertex)?.first().copied();
        let start = first
            .and_then(|cell| Some((cell, cells.corners[cell].as_ref().iter().position(|&v| v == vertex)?)));
        Ok(ordered_star(start, move |cell, corner| {
            let mirror = mirror::<Plane<P>>(cells, cell.index(), corner);
            (mirror != NO_CORNER).then(|| (cells.neighbours[cell][corner], usize::from(mirror)))
        }))
    }
}

/// The corner of the neighbour that is not one of the facet opposite a corner of a cell.
fn mirror<G: Moving>(cells: &PeriodicCells<G>, cell: usize, corner: usize) -> u8 {
    let across = cells.neighbours[cell].as_ref()[corner];
    if across == NO_CELL {
        return NO_CORNER;
    }
    let n = G::D + 1;
    let by = cells.neighbour_shifts.of(cell)[corner];
    let (row, others) = (cells.corners[cell].as_ref(), cells.corners[across].as_ref());
    let is_shared = |k: usize| {
        let shift = [0, 1, 2].map(|j| cells.shifts.of(across.index())[k][j] + by[j]);
        (0..n).any(|i| i != corner && row[i] == others[k] && cells.shifts.of(cell)[i] == shift)
    };
    (0..n).find(|&k| !is_shared(k)).map_or(NO_CORNER, |k| k as u8)
}

/// The lists of pairs that are sorted by vertex.
fn rows_of<T: Copy>(pairs: &[(VertexId, T)], n_ids: usize) -> Result<Rows<T>> {
    let (mut offsets, mut entries) = (Vec::new(), Vec::new());
    memory::lengthen(&mut offsets, n_ids + 1, 0)?;
    memory::collect(&mut entries, pairs.iter().map(|&(_, entry)| entry))?;
    pairs.iter().for_each(|&(vertex, _)| offsets[vertex.index() + 1] += 1);
    (1..=n_ids).for_each(|k| offsets[k] += offsets[k - 1]);
    Ok(Rows { offsets, entries })
}
