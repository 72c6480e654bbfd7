//! Files for programs that draw and mesh: positions and cells, without a way back.
//!
//! A file holds the vertices that are present, also hidden ones, in the order of their ids and numbered without gaps;
//! the id of each is kept beside it.
//!
//! Segments in force are lines behind the cells, in the order of their ids, so that the cell of an index is there where
//! it is without segments. A triangulation without segments has no lines, and nothing else that speaks of them.

mod medit;
mod vtu;

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::state::segments::Segment;
use crate::motion::state::views::CellsView;
use crate::motion::triangulation::MovingTriangulation;
pub use vtu::Field;

/// There must be a reference for each cell.
pub(crate) fn check_references(given: usize, wanted: usize) -> Result<()> {
    if given == wanted {
        Ok(())
    } else {
        Err(Error::WrongCount { argument: "reference_count", given, wanted, coming: 0 })
    }
}

/// What is written: points, cells between them, and lines.
pub(crate) trait Drawn<G: Moving>: Sized {
    /// How many numbers of each component a field of vertices has, and how many of them are for staged insertions.
    fn id_counts(&self) -> [usize; 2];

    /// How many points there are.
    fn point_count(&self) -> usize;

    /// The points, each of which is a vertex, or a translation of one.
    fn points(&self) -> impl Iterator<Item = (VertexId, G::Point)>;

    /// How many cells there are.
    fn cell_count(&self) -> usize;

    /// The cells, by the numbers of their points; of a triangle the last is not used.
    fn cells(&self) -> impl Iterator<Item = [u32; 4]>;

    /// The lines, by the numbers of their points, each with its marker.
    fn lines(&self) -> impl Iterator<Item = ([u32; 2], i32)>;

    /// Hands on the bytes of a `.vtu` file.
    fn put_vtu<E: From<Error>>(
        &self,
        vertex_fields: &[Field<'_>],
        cell_fields: &[Field<'_>],
        put: impl FnMut(&[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        vtu::write(self, vertex_fields, cell_fields, put)
    }

    /// Hands on the text of a `.mesh` file.
    fn put_medit<E: From<Error>>(
        &self,
        references: Option<&[i32]>,
        put: impl FnMut(&[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        medit::write(self, references, put)
    }
}

/// A triangulation of the plane or of space, with segments.
struct OpenExport<'t, G: Moving> {
    t: &'t MovingTriangulation<G>,
    view: CellsView<'t, G>,
    /// For each id the number of present vertices with lower ones; nothing if that is the id itself.
    ranks: Vec<u32>,
}

impl<'t, G: Moving> OpenExport<'t, G> {
    fn of(t: &'t MovingTriangulation<G>) -> Result<Self> {
        Ok(OpenExport { t, view: t.cells()?, ranks: t.ranks()? })
    }

    /// The number of a vertex among those present.
    fn rank(&self, vertex: VertexId) -> u32 {
        self.ranks.get(vertex.index()).copied().unwrap_or(vertex.get())
    }
}

impl<G: Moving> Drawn<G> for OpenExport<'_, G> {
    fn id_counts(&self) -> [usize; 2] {
        [self.t.id_count(), self.t.staged_edits().0]
    }

    fn point_count(&self) -> usize {
        self.t.vertex_count()
    }

    fn points(&self) -> impl Iterator<Item = (VertexId, G::Point)> {
        let mesh = &self.t.mesh;
        self.t.present().map(|v| (v, mesh.kernel.site(mesh.site_of[v]).point))
    }

    fn cell_count(&self) -> usize {
        self.view.corners.len()
    }

    fn cells(&self) -> impl Iterator<Item = [u32; 4]> {
        self.view.corners.iter().map(|row| {
            let mut numbers = [0; 4];
            numbers.iter_mut().zip(row.as_ref()).for_each(|(n, &v)| *n = self.rank(v));
            numbers
        })
    }

    fn lines(&self) -> impl Iterator<Item = ([u32; 2], i32)> {
        self.t.lines().map(|line| (line.ends.map(|v| self.rank(v)), line.marker))
    }
}

impl<G: Moving> MovingTriangulation<G> {
    /// Hands on the bytes of a `.vtu` file, some thousand at a time. The points have three coordinates, the third being
    /// 0 in the plane, and their ids as an array `vertex`. If there are segments in force, they are lines behind the
    /// cells: their markers are an array `marker` of cell data, which is 0 for cells, and fields of cells are NaN there.
    ///
    /// # Errors
    /// [`Error::InvalidName`] if a field is called what XML does not have, or as another one; [`Error::WrongCount`] if
    /// one has no or too few numbers, or too many; [`Error::OutOfMemory`]; all before the first byte; and those of
    /// `put`, with which it ends.
    pub fn write_vtu<E: From<Error>>(
        &self,
        vertex_fields: &[Field<'_>],
        cell_fields: &[Field<'_>],
        put: impl FnMut(&[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        OpenExport::of(self)?.put_vtu(vertex_fields, cell_fields, put)
    }

    /// Hands on the text of a `.mesh` file, some thousand bytes at a time. Vertices are numbered from 1; the reference
    /// of each is its id, that of a cell the number given for it, or 1 if none are given, and that of a segment its
    /// marker. Coordinates have as many digits as tell them apart.
    ///
    /// # Errors
    /// [`Error::WrongCount`] unless there is a number for each cell, [`Error::OutOfMemory`], both before the first byte;
    /// and those of `put`, with which it ends.
    pub fn write_medit<E: From<Error>>(
        &self,
        references: Option<&[i32]>,
        put: impl FnMut(&[u8]) -> Result<(), E>,
    ) -> Result<(), E> {
        OpenExport::of(self)?.put_medit(references, put)
    }

    /// There must be a reference for each cell.
    pub(crate) fn check_references(&self, given: usize) -> Result<()> {
        check_references(given, self.cell_count())
    }

    /// The vertices that are present, ascending.
    fn present(&self) -> impl Iterator<Item = VertexId> + '_ {
        VertexId::range(0..self.id_count()).filter(|&v| self.mesh.is_present(v))
    }

    /// The segments in force, between vertices that are corners of cells: where others are at the same place, those that
    /// represent them.
    fn lines(&self) -> impl Iterator<Item = Segment> + '_ {
        let shown = |v: VertexId| self.mesh.kernel.site(self.mesh.site_of[v]).id;
        let segments = self.mesh.segments.iter().flat_map(|segments| segments.enforced());
        segments.map(move |(_, segment)| Segment { ends: segment.ends.map(shown), ..segment })
    }

    /// Whether files have lines.
    pub(crate) fn has_lines(&self) -> bool {
        self.lines().next().is_some()
    }

    /// For each id the number of present vertices with lower ones; nothing if that is the id itself.
    fn ranks(&self) -> Result<Vec<u32>> {
        let mut ranks = Vec::new();
        if self.vertex_count() == self.id_count() {
            return Ok(ranks);
        }
        memory::lengthen(&mut ranks, self.id_count(), 0)?;
        self.present().zip(0..).for_each(|(v, rank)| ranks[v] = rank);
        Ok(ranks)
    }
}
