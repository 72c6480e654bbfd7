//! Cells that have given vertices as corners: whether two vertices share an edge, whether a facet is there.
//!
//! Of few simplices the stars are looked through, those of all corners in turn and for twice as long each time, so that
//! one with few cells is done before one with thousands has cost much. For many, a pass over the cells lists those of
//! each vertex, and of each simplex the shortest list is looked through.

use crate::complex::Corners;
use crate::delaunay::{Delaunay, IndexSet, Moving};
use crate::error::{Error, Result};
use crate::ids::{CellId, SiteId, Slot, VertexId};
use crate::motion::reading::geometry::incidence::{first_cells, stars};
use crate::motion::triangulation::MovingTriangulation;

/// From so many simplices for each vertex on, listing the cells of all vertices is faster.
const LEAST_PER_VERTEX: f64 = 0.125;

/// Whether there are so many simplices that listing the cells of all vertices is faster than looking at stars.
pub(crate) fn are_many(n_simplices: usize, n_vertices: usize) -> bool {
    n_simplices as f64 > LEAST_PER_VERTEX * n_vertices as f64
}

/// How many cells of a star are looked at first.
const FIRST_CELLS: usize = 64;

impl<G: Moving> MovingTriangulation<G> {
    /// For each simplex a cell that has all its vertices as corners, `None` if there is none; told to `found` one after
    /// the other. `vertices`: rows of `n_corners` ids, from 1 (a cell of each vertex) to `D + 1`. A hidden vertex
    /// stands for the one that represents it. A simplex with two corners at one place is in no cell, nor is one with a
    /// vertex that weights hide.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [3.0, 0.0], [0.0, 1.0], [3.0, 1.0], [1.5, 0.5]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let edges = [[0, 1], [0, 3], [1, 4]].map(|edge| edge.map(VertexId::new));
    /// let mut are_there = Vec::new();
    /// t.find_simplices(edges.as_flattened(), 2, |cell| are_there.push(cell.is_some()))?;
    /// assert_eq!(are_there, [true, false, true]);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for another number of corners, [`Error::WrongCount`] if the last row is not whole,
    /// [`Error::NoSuchVertex`], [`Error::RemovedVertex`], [`Error::StagedVertex`], [`Error::OutOfMemory`].
    pub fn find_simplices(
        &self,
        vertices: &[VertexId],
        n_corners: usize,
        mut found: impl FnMut(Option<CellId>),
    ) -> Result<()> {
        check_simplices::<G>(vertices.len(), n_corners)?;
        for (index, &vertex) in vertices.iter().enumerate() {
            self.present_site("vertices", index, vertex)?;
        }
        let rows = vertices.chunks_exact(n_corners);
        if !self.mesh.kernel.has_cells() {
            rows.for_each(|_| found(None));
            return Ok(());
        }
        if are_many(rows.len(), self.vertex_count()) {
            return self.find_in_lists(rows, found);
        }
        let index_of = self.cell_arrays()?.index_of();
        let mut star = IndexSet::new();
        for row in rows {
            let (sites, n) = self.sites_of_corners(row);
            let slot = find_around(&self.mesh.kernel, &sites[..n], &mut star)?;
            found(slot.map(|slot| index_of[slot]));
        }
        Ok(())
    }

    /// The sites of a few vertices, and their number.
    fn sites_of_corners(&self, row: &[VertexId]) -> ([SiteId; 4], usize) {
        let mut sites = [SiteId::NONE; 4];
        row.iter().zip(&mut sites).for_each(|(&v, site)| *site = self.mesh.site_of[v]);
        (sites, row.len())
    }

    /// For each simplex a cell, by the cells of all vertices.
    fn find_in_lists<'v>(
        &self,
        rows: impl Iterator<Item = &'v [VertexId]>,
        mut found: impl FnMut(Option<CellId>),
    ) -> Result<()> {
        let cells = self.cell_arrays()?;
        let stars = stars(cells, self.id_count())?;
        for row in rows {
            let mut corners = [VertexId::NONE; 4];
            let (sites, n) = self.sites_of_corners(row);
            sites[..n].iter().zip(&mut corners).for_each(|(&s, v)| *v = self.mesh.kernel.site(s).id);
            found(find_in_stars(cells.corners(), &corners[..n], |k| stars.row(corners[k])));
        }
        Ok(())
    }

    /// For each id the first cell of which the vertex is a corner; [`CellId::NONE`] for those that are hidden or removed, and
    /// where there are no cells.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn cell_of_each_vertex(&self) -> Result<Vec<CellId>> {
        first_cells::<G>(self.cells()?.corners, self.id_count())
    }
}

/// A simplex has from 1 corner to one more than there are dimensions.
pub(crate) fn check_corners(dimension: usize, n_corners: usize) -> Result<()> {
    if (1..=dimension + 1).contains(&n_corners) {
        return Ok(());
    }
    let wanted = if dimension == 2 { "1, 2 or 3" } else { "1, 2, 3 or 4" };
    let (argument, value) = ("corners_per_simplex", n_corners as f64);
    Err(Error::InvalidValue { argument, index: 0, value, wanted })
}

/// Simplices have a legal number of corners, and there are rows of as many.
pub(crate) fn check_simplices<G: Moving>(n_vertices: usize, n_corners: usize) -> Result<()> {
    check_corners(G::D, n_corners)?;
    let (given, wanted) = (n_vertices, n_vertices.next_multiple_of(n_corners));
    if given == wanted {
        return Ok(());
    }
    Err(Error::WrongCount { argument: "the length of vertices", given, wanted, coming: 0 })
}

/// Whether each of these is another corner of a cell.
fn are_corners<T: PartialEq>(of_cell: &[T], wanted: &[T]) -> bool {
    let count = |row: &[T], v: &T| row.iter().filter(|&w| w == v).count();
    wanted.iter().all(|v| of_cell.contains(v)) && wanted.iter().all(|v| count(wanted, v) <= count(of_cell, v))
}

/// The first cell that has each of these vertices as another corner, of the shortest of their lists of cells.
pub(crate) fn find_in_stars<'s, V: AsRef<[VertexId]>>(
    corners: &[V],
    wanted: &[VertexId],
    star: impl Fn(usize) -> &'s [CellId],
) -> Option<CellId> {
    let shortest = (0..wanted.len()).map(star).min_by_key(|list| list.len())?;
    shortest.iter().copied().find(|&cell| are_corners(corners[cell].as_ref(), wanted))
}

/// The slot of a finite cell that has all these sites as corners; none if there are no sites.
fn find_around<G: Moving>(
    kernel: &Delaunay<G>,
    sites: &[SiteId],
    star: &mut IndexSet<Slot>,
) -> Result<Option<Slot>> {
    let has_all = |slot: Slot| {
        let cell = kernel.complex().cell(slot);
        !cell.is_ghost() && are_corners(cell.corners.as_ref(), sites)
    };
    if sites.iter().any(|&s| kernel.is_hidden(s)) {
        return Ok(None);
    }
    let mut most = FIRST_CELLS;
    while !sites.is_empty() {
        for &s in sites {
            let is_whole = spread_around(kernel, s, most, star)?;
            let slot = star.as_slice().iter().copied().find(|&slot| has_all(slot));
            if is_whole || slot.is_some() {
                return Ok(slot);
            }
        }
        most *= 2;
    }
    Ok(None)
}

/// Lists cells around a site, until so many have been looked around; whether these are all.
fn spread_around<G: Moving>(
    kernel: &Delaunay<G>,
    s: SiteId,
    most: usize,
    star: &mut IndexSet<Slot>,
) -> Result<bool> {
    star.clear();
    star.insert(kernel.site(s).cell)?;
    let mut next = 0;
    while let Some(&slot) = star.as_slice().get(next) {
        if next == most {
            return Ok(false);
        }
        next += 1;
        let cell = kernel.complex().cell(slot);
        let at = cell.index_of(s);
        for i in (0..G::Corners::N).filter(|&i| i != at) {
            star.insert(cell.neighbour(i).cell())?;
        }
    }
    Ok(true)
}
