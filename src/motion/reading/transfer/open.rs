//! The transfer of means in a triangulation that is open.

use super::boxes::Extent;
use super::change::transfer;
use super::now::{CellAt, Multiples, Now};
use super::{Gone, NamedFacet, TransferOrder, TransferReport, Transferred, in_place};
use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::reading::query::Location;
use crate::motion::state::cells::{Cells, NO_CELL};
use crate::motion::state::changes::NO_VERTEX;
use crate::motion::state::checking::check_position;
use crate::motion::state::taken::{Changes, Taken};
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::PlaceInSpace;

impl<G: Moving> MovingTriangulation<G> {
    /// Brings means in cells over to the cells of now: conservative transfer of what a program knows of each cell, by
    /// the changes that were [taken](Self::take_changes) last.
    ///
    /// `values` has `n_values` components for each cell that there was when changes were taken before, in the order of
    /// the indices of then; afterwards for each cell that there is. A mean rides with its cell: what is kept is the
    /// sum of mean times volume *at the positions of now*. A program that keeps content, not means, divides by the
    /// volumes of now before.
    ///
    /// `positions` has by id where the vertices of the cells that were are now, or where they were when they were
    /// removed: what a program has that has committed them, before it reads those of new vertices. Where none of them
    /// has been removed it may be none, for where they are. `monitor` is asked now and then, with the share of the work that
    /// is done, and breaks the call off.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options, TransferOrder}};
    ///
    /// let places = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [2.0, 2.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&places, Options::default())?;
    /// t.take_changes()?;
    /// let mut heat = vec![1.0, 2.0, 3.0, 4.0];
    /// t.remove_vertex(VertexId::new(4))?;
    /// t.insert_vertex(&[1.0, 2.0])?;
    /// t.take_changes()?;
    /// let report = t.transfer_cells(Some(&places), TransferOrder::First, 1, &mut heat, &mut |_| true)?;
    /// let content: f64 = heat.iter().zip(t.volumes()?).map(|(mean, volume)| mean * volume).sum();
    /// assert!((content - 40.0).abs() < 1e-14 && report.lost[0].abs() < 1e-14);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::ChangesNotTaken`] unless changes have been taken and none has come since, and where vertices of cells
    /// that are gone have no id any more; [`Error::WrongCount`] unless there are as many values as there were cells;
    /// [`Error::InvalidValue`] for a value that is needed and no number up to 10³⁰⁰ in magnitude;
    /// [`Error::RemovedVertex`] and [`Error::NoSuchVertex`] for a vertex of which `positions` has none;
    /// [`Error::NotFinite`], [`Error::OutOfRange`], [`Error::Prepared`], [`Error::OutOfMemory`], [`Error::Cancelled`].
    /// Then the values are as before.
    pub fn transfer_cells(
        &self,
        positions: Option<&[G::Point]>,
        order: TransferOrder,
        n_values: usize,
        values: &mut Vec<f64>,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<TransferReport> {
        let counts = [self.count_before()?, self.cell_count()];
        in_place(values, n_values, counts, |value| {
            self.transferred(positions, order, n_values, &value, monitor)
        })
    }

    /// How many cells there were when changes were taken before.
    pub(crate) fn count_before(&self) -> Result<usize> {
        let changes = self.fresh_lists()?.1.changes();
        Ok(self.cell_count() + changes.removed.len() - changes.created.len())
    }

    /// The cells, and the lists that were taken last.
    fn fresh_lists(&self) -> Result<(&Cells<G>, &Taken<G::Vertices>)> {
        self.reject_prepared()?;
        let cells = self.cell_arrays()?;
        let taken =
            self.taken.as_ref().filter(|_| cells.are_changes_taken()).ok_or(Error::ChangesNotTaken)?;
        Ok((cells, taken))
    }

    /// What becomes of means; `value` tells a component of that of a cell that was.
    pub(crate) fn transferred(
        &self,
        positions: Option<&[G::Point]>,
        order: TransferOrder,
        n_values: usize,
        value: &impl Fn(u32, usize) -> f64,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Transferred> {
        let now = self.now()?;
        let (gone, arrived) = now.gone_and_arrived(positions)?;
        let renumbered = [now.changes.renumbered_from, now.changes.renumbered_to];
        transfer(&now, gone, arrived, renumbered, (order, n_values), value, monitor)
    }

    pub(super) fn now(&self) -> Result<OpenCells<'_, G>> {
        let (cells, taken) = self.fresh_lists()?;
        Ok(OpenCells { t: self, cells, changes: taken.changes(), turned: taken.turned() })
    }

    /// One of the cells at the place of a vertex; none if there are no cells.
    pub(crate) fn a_cell_at(&self, vertex: VertexId) -> Result<Option<CellId>> {
        let (cells, kernel) = (self.cell_arrays()?, &self.mesh.kernel);
        if self.cell_count() == 0 {
            return Ok(None);
        }
        let s = self.present_site("vertex", 0, vertex)?;
        let slot = if kernel.is_hidden(s) { kernel.cell_below(s) } else { kernel.site(s).cell };
        let around = kernel.complex().cell(slot);
        let finite = if around.is_ghost() { around.neighbour(G::D).cell() } else { slot };
        Ok(Some(cells.index_of()[finite]))
    }

    /// Where a vertex of a cell that was is, or was at last.
    fn place_before(&self, positions: Option<&[G::Point]>, v: VertexId) -> Result<PlaceInSpace> {
        let (argument, index, vertex) = ("positions", v.index(), v);
        let point = match positions {
            _ if v == NO_VERTEX => return Err(Error::ChangesNotTaken),
            Some(positions) => match positions.get(index) {
                Some(point) => check_position::<G>(argument, index, point)?,
                None => return Err(Error::NoSuchVertex { argument, index, vertex, ids: positions.len() }),
            },
            None if !self.mesh.is_present(v) => return Err(Error::RemovedVertex { argument, index, vertex }),
            None => self.position(v)?,
        };
        Ok(place_of::<G>(&point))
    }
}

fn place_of<G: Moving>(point: &G::Point) -> PlaceInSpace {
    let mut place = [0.0; 3];
    place[..G::D].copy_from_slice(point.as_ref());
    place
}

/// The cells of now.
pub(super) struct OpenCells<'t, G: Moving> {
    t: &'t MovingTriangulation<G>,
    cells: &'t Cells<G>,
    changes: Changes<'t, G::Vertices>,
    /// Cells that were turned over, and the corners that each had.
    turned: &'t [(CellId, G::Vertices)],
}

impl<G: Moving> OpenCells<'_, G> {
    /// The cells that are gone and those that have come, those that were turned over are both.
    pub(super) fn gone_and_arrived(
        &self,
        positions: Option<&[G::Point]>,
    ) -> Result<(Vec<Gone>, Vec<CellId>)> {
        let (changes, turned) = (&self.changes, self.turned);
        let place = |v| self.t.place_before(positions, v);
        let (mut gone, mut arrived) = (Vec::new(), Vec::new());
        let turned_rows = turned.iter().map(|(cell, row)| (self.before(*cell), row));
        for (before, row) in changes.removed.iter().copied().zip(changes.removed_corners).chain(turned_rows) {
            let mut corners = [[0.0; 3]; 4];
            for (corner, &v) in corners.iter_mut().zip(row.as_ref()) {
                *corner = place(v)?;
            }
            let facets = facets_of(row.as_ref());
            memory::push(&mut gone, Gone { corners, facets, before: before.get() })?;
        }
        memory::append(&mut arrived, changes.created)?;
        turned.iter().try_for_each(|&(cell, _)| memory::push(&mut arrived, cell))?;
        Ok((gone, arrived))
    }
}

impl<G: Moving> Now for OpenCells<'_, G> {
    const D: usize = G::D;

    fn len(&self) -> usize {
        self.cells.corners().len()
    }

    fn before(&self, cell: CellId) -> CellId {
        let found = self.changes.renumbered_to.binary_search(&cell);
        found.map_or(cell, |k| self.changes.renumbered_from[k])
    }

    fn corners(&self, cell: CellId) -> [PlaceInSpace; 4] {
        let mut corners = [[0.0; 3]; 4];
        let sites = self.cells.sites(&self.t.mesh.kernel, cell);
        for (corner, site) in corners.iter_mut().zip(sites.as_ref()) {
            *corner = place_of::<G>(&self.t.mesh.kernel.site(*site).point);
        }
        corners
    }

    fn facets(&self, cell: CellId) -> [NamedFacet; 4] {
        facets_of(self.cells.corners()[cell].as_ref())
    }

    fn across(&self, cell: CellId, corner: usize) -> Option<CellAt> {
        let other = self.cells.neighbours()[cell].as_ref()[corner];
        (other != NO_CELL).then_some((other, [0; 3]))
    }

    fn offset(&self, _shift: &Multiples) -> PlaceInSpace {
        [0.0; 3]
    }

    fn at(&self, place: &PlaceInSpace) -> Result<Option<CellAt>> {
        let mut point = G::Point::default();
        (0..G::D).for_each(|axis| point[axis] = place[axis]);
        let found = match self.t.locate(&point)? {
            Location::Vertex(v) => self.t.a_cell_at(v)?,
            Location::Cell(cell) => Some(cell),
            Location::Outside(_) | Location::NoCells => None,
        };
        Ok(found.map(|cell| (cell, [0; 3])))
    }

    fn rounding(&self, _extent: &Extent) -> PlaceInSpace {
        [0.0; 3]
    }

    fn copies(
        &self,
        gone: &[Gone],
        _cells: impl Iterator<Item = CellId>,
    ) -> Result<Vec<(u32, PlaceInSpace)>> {
        let mut copies = Vec::new();
        memory::collect(&mut copies, (0..gone.len() as u32).map(|k| (k, [0.0; 3])))?;
        Ok(copies)
    }
}

/// The facets of a cell, by the vertices of each in the order of their ids.
fn facets_of(row: &[VertexId]) -> [NamedFacet; 4] {
    let mut facets = [NamedFacet::default(); 4];
    for (k, facet) in facets.iter_mut().enumerate().take(row.len()) {
        let mut others = [(VertexId::NONE, 0); 3];
        let on_facet = row.iter().zip(0..).filter(|&(_, i)| usize::from(i) != k);
        others.iter_mut().zip(on_facet).for_each(|(entry, (&v, i))| *entry = (v, i));
        others[..row.len() - 1].sort_unstable();
        let name = others.iter().fold(0, |name, (v, _)| name << 32 | u128::from(v.get()));
        *facet = NamedFacet { name, anchor: others[0].1 };
    }
    facets
}
