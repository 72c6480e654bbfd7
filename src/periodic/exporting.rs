//! Files for programs that draw and mesh: cells together as they are in space, and so a vertex once for each period in which
//! a cell has it.

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::{Drawn, Field, check_references};
use crate::periodic::triangulation::PeriodicTriangulation;

/// Points that cells have, and vertices that no cell has.
struct Periods<'t, G: Moving> {
    t: &'t PeriodicTriangulation<G>,
    /// Ascending by vertex, and by the multiples of the vectors by which it is translated from its position.
    points: Vec<(VertexId, G::Point)>,
    /// By cell and corner the number of the point.
    numbers: Vec<u32>,
}

/// A corner of a cell, or a vertex that is in none.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct ExportedCorner {
    vertex: VertexId,
    /// By which multiples of the given vectors it is translated from its position.
    shift: [i64; 3],
    /// Its number among all corners, beyond the last for a vertex that is in no cell.
    index: usize,
    /// By which multiples of the reduced vectors it is translated from home.
    from_home: [i64; 3],
}

impl<'t, G: Moving> Periods<'t, G> {
    fn of(t: &'t PeriodicTriangulation<G>) -> Result<Self> {
        let cells = t.read_cells()?;
        let n = G::D + 1;
        let n_corners = cells.corners.len() * n;
        let mut corners = Vec::new();
        memory::reserve_exact(&mut corners, n_corners)?;
        for (index, shift) in t.cell_shifts()?.enumerate() {
            let (cell, corner) = (index / n, index % n);
            let row = cells.corners[cell].as_ref();
            let wrap = t.wraps[row[usize::from(cells.least[cell])]];
            let from_home = [0, 1, 2].map(|j| i64::from(cells.shifts.of(cell)[corner][j]) + wrap[j]);
            corners.push(ExportedCorner { vertex: row[corner], shift, index, from_home });
        }
        let mut is_corner = Vec::new();
        memory::lengthen(&mut is_corner, t.wraps.len(), false)?;
        corners.iter().for_each(|corner| is_corner[corner.vertex] = true);
        for vertex in VertexId::range(0..t.wraps.len()).filter(|&v| t.is_present(v) && !is_corner[v]) {
            let from_home = t.wraps[vertex];
            memory::push(
                &mut corners,
                ExportedCorner { vertex, shift: [0; 3], index: n_corners, from_home },
            )?;
        }
        corners.sort_unstable();
        let (mut points, mut numbers) = (Vec::new(), Vec::new());
        memory::lengthen(&mut numbers, n_corners, 0)?;
        for same in corners.chunk_by(|one, other| (one.vertex, one.shift) == (other.vertex, other.shift)) {
            let ExportedCorner { vertex, from_home, .. } = same[0];
            same.iter().filter(|one| one.index < n_corners).for_each(|one| {
                numbers[one.index] = points.len() as u32;
            });
            let home = &t.inside.t.position(t.inside.images.home(vertex))?;
            memory::push(&mut points, (vertex, t.lattice.unwrapped(home, &from_home)))?;
        }
        Ok(Periods { t, points, numbers })
    }
}

impl<G: Moving> Drawn<G> for Periods<'_, G> {
    fn id_counts(&self) -> [usize; 2] {
        [self.t.id_count(), self.t.staged.insertions().len()]
    }

    fn point_count(&self) -> usize {
        self.points.len()
    }

    fn points(&self) -> impl Iterator<Item = (VertexId, G::Point)> {
        self.points.iter().copied()
    }

    fn cell_count(&self) -> usize {
        self.numbers.len() / (G::D + 1)
    }

    fn cells(&self) -> impl Iterator<Item = [u32; 4]> {
        self.numbers.chunks_exact(G::D + 1).map(|row| {
            let mut numbers = [0; 4];
            numbers[..=G::D].copy_from_slice(row);
            numbers
        })
    }

    fn lines(&self) -> impl Iterator<Item = ([u32; 2], i32)> {
        std::iter::empty()
    }
}

impl<G: Moving> PeriodicTriangulation<G> {
    /// Hands on the bytes of a `.vtu` file, some thousand at a time: the cells, together as
    /// [`cell_shifts`](Self::cell_shifts) has them. A vertex is a point for each period in which a cell has it, and once at its
    /// position if no cell has it; its id is in an array `vertex`, and its numbers of fields are those of all of its points. The
    /// points have three coordinates, the third being 0 in the plane.
    ///
    /// # Errors
    /// The errors of [`MovingTriangulation::write_vtu`](crate::motion::MovingTriangulation::write_vtu).
    pub fn write_vtu<E: From<Error>>(
        &self,
        vertex_fields: &[Field<'_>],
        cell_fields: &[Field<'_>],
        put: impl FnMut(&[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        Periods::of(self)?.put_vtu(vertex_fields, cell_fields, put)
    }

    /// Hands on the text of a `.mesh` file, some thousand bytes at a time: the cells and points of
    /// [`write_vtu`](Self::write_vtu), which are numbered from 1; the reference of each is the id of its vertex, that of a cell
    /// the number given for it, or 1 if none are given.
    ///
    /// # Errors
    /// The errors of [`MovingTriangulation::write_medit`](crate::motion::MovingTriangulation::write_medit).
    pub fn write_medit<E: From<Error>>(
        &self,
        references: Option<&[i32]>,
        put: impl FnMut(&[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        Periods::of(self)?.put_medit(references, put)
    }

    /// There must be a reference for each cell.
    pub(crate) fn check_references(&self, given: usize) -> Result<()> {
        check_references(given, self.cell_count()?)
    }

    /// Whether files have lines: there are no segments.
    pub(crate) fn has_lines(&self) -> bool {
        false
    }
}
