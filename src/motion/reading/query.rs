//! Questions that change nothing. They may be asked from several threads at once.

use crate::delaunay::{IndexSet, Level, Moving, Place, Violation};
use crate::error::Result;
use crate::ids::{CellId, Slot, VertexId};
use crate::machine::memory;
use crate::machine::prefetch::prefetch;
use crate::motion::algorithms::Algorithm;
use crate::motion::report::CommitReport;
use crate::motion::state::cells::Cells;
use crate::motion::state::checking::check_position;
use crate::motion::state::made::Made;
use crate::motion::state::repair::Repair;
use crate::motion::state::taken::Taken;
use crate::motion::triangulation::MovingTriangulation;

/// Where a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Location {
    /// At the place of this vertex (the representative; with weights, one that is shown: the place of another is in a
    /// cell).
    Vertex(VertexId),
    /// In the closure of the cell of this index, at no vertex.
    Cell(CellId),
    /// Outside the convex hull, beyond a facet of the cell of this index.
    Outside(CellId),
    /// There are no cells: the points are fewer than `D + 1` or in one hyperplane.
    NoCells,
}

/// Indices of the finite cells in some slots.
pub(crate) fn cells_at(slots: &IndexSet<Slot>, index_of: &[CellId]) -> impl Iterator<Item = CellId> {
    slots.as_slice().iter().map(|&slot| index_of[slot]).filter(|&index| index != CellId::NONE)
}

impl<G: Moving> MovingTriangulation<G> {
    /// The algorithm of commits.
    pub fn algorithm(&self) -> Algorithm {
        self.options.algorithm
    }

    /// Changes the algorithm of later commits.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{Algorithm, MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// assert_eq!(t.algorithm(), Algorithm::Auto);
    /// t.set_algorithm(Algorithm::Rebuilding);
    /// t.move_all(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.1, 1.1]])?;
    /// assert_eq!(t.commit_timestamp()?.rebuilds, 1);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    pub fn set_algorithm(&mut self, algorithm: Algorithm) {
        if algorithm != self.options.algorithm {
            self.reset_switching();
        }
        self.options.algorithm = algorithm;
    }

    /// Vertices present, hidden ones included.
    pub fn vertex_count(&self) -> usize {
        self.mesh.n_present
    }

    /// Whether the vertex is present.
    pub fn is_present(&self, vertex: VertexId) -> bool {
        self.mesh.is_present(vertex)
    }

    /// Where a vertex of this id is at the current timestamp, or where it will be inserted if that is staged.
    pub fn position_or_goal(&self, vertex: VertexId) -> Option<G::Point> {
        match self.mesh.site(vertex) {
            Some(s) => Some(self.mesh.kernel.site(s).point),
            None => self.edits.insertion(vertex).copied(),
        }
    }

    /// Indices of the finite cells around the place of a vertex, in no particular order, in `out`, which is cleared
    /// first.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let mut star = Vec::new();
    /// t.star(VertexId::new(0), &mut star)?;
    /// let cells = t.cells()?.corners;
    /// assert!(star.iter().all(|&cell| cells[cell].contains(&VertexId::new(0))));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`](crate::Error::NoSuchVertex), [`Error::RemovedVertex`](crate::Error::RemovedVertex),
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn star(&self, vertex: VertexId, out: &mut Vec<CellId>) -> Result<()> {
        let mut slots = IndexSet::new();
        let (index_of, _) = self.list_star(vertex, &mut slots)?;
        out.clear();
        memory::collect(out, cells_at(&slots, index_of))
    }

    /// Enters the slots of the cells around the place of a vertex into an empty set; returns the index of the cell in
    /// each slot, for [`cells_at`], and the number of those that are finite.
    pub(crate) fn list_star(
        &self,
        vertex: VertexId,
        slots: &mut IndexSet<Slot>,
    ) -> Result<(&[CellId], usize)> {
        let s = self.present_site("vertex", 0, vertex)?;
        let cells = self.cell_arrays()?;
        let index_of = cells.index_of();
        self.foreseen.prefetch_next_stars(&self.mesh, vertex);
        let Some(s) = self.mesh.shown_at(s) else { return Ok((index_of, 0)) };
        self.mesh.kernel.list_star(s, slots, |slot| prefetch(index_of, slot.index()))?;
        // A program that asks for a star goes on to read the rows of its cells.
        let asked = cells_at(slots, index_of).inspect(|&index| prefetch(cells.corners(), index.index()));
        let n = asked.count();
        self.mesh.kernel.prefetch_around(s, slots);
        Ok((index_of, n))
    }

    /// Where a point lies.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{Location, MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// assert_eq!(t.locate(&[1.0, 0.0])?, Location::Vertex(VertexId::new(1)));
    /// assert!(matches!(t.locate(&[0.2, 0.3])?, Location::Cell(_)));
    /// assert!(matches!(t.locate(&[7.0, 7.0])?, Location::Outside(_)));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`](crate::Error::NotFinite), [`Error::OutOfRange`](crate::Error::OutOfRange),
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn locate(&self, position: &G::Point) -> Result<Location> {
        let q = check_position::<G>("position", 0, position)?;
        let cells = self.cell_arrays()?;
        Ok(self.location(cells, self.mesh.kernel.locate(&q, Slot::NONE)))
    }

    /// Where points lie, told to `found` one after the other. Each is looked for from the one before, the first from
    /// `near`, if that is near it. This is only where to begin: it need not be right, nor name anything.
    ///
    /// # Errors
    /// The errors of [`locate`](Self::locate), before any location is told.
    pub fn locate_points(
        &self,
        positions: &[G::Point],
        near: Option<Location>,
        mut found: impl FnMut(Location),
    ) -> Result<()> {
        for (index, position) in positions.iter().enumerate() {
            check_position::<G>("positions", index, position)?;
        }
        let cells = self.cell_arrays()?;
        let mut near = self.start_near(near)?;
        for position in positions {
            let place = self.mesh.kernel.locate(position, near);
            near = self.slot_at(place);
            found(self.location(cells, place));
        }
        Ok(())
    }

    /// The slot of a cell near a location, [`Slot::NONE`] if none is known.
    pub(in crate::motion) fn start_near(&self, near: Option<Location>) -> Result<Slot> {
        let cells = self.cell_arrays()?;
        Ok(near.map_or(Slot::NONE, |near| self.slot_of(cells, near)))
    }

    /// The slot of a cell at a place, to begin a search at.
    pub(in crate::motion) fn slot_at(&self, place: Place) -> Slot {
        match place {
            Place::Site(s) => self.mesh.kernel.site(s).cell,
            Place::Cell(c) | Place::Outside(c) => c,
            Place::NoCells => Slot::NONE,
        }
    }

    /// The name of a place.
    fn location(&self, cells: &Cells<G>, place: Place) -> Location {
        let index_of = |c: Slot| cells.index_of()[c];
        match place {
            Place::Site(s) => Location::Vertex(self.mesh.kernel.site(s).id),
            Place::Cell(c) => Location::Cell(index_of(c)),
            Place::Outside(c) => {
                Location::Outside(index_of(self.mesh.kernel.complex().cell(c).neighbour(G::D).cell()))
            }
            Place::NoCells => Location::NoCells,
        }
    }

    /// The slot of a cell at a place that need not exist; [`Slot::NONE`] if there is no such place.
    fn slot_of(&self, cells: &Cells<G>, location: Location) -> Slot {
        match location {
            Location::Vertex(v) => match self.present_site("hint", 0, v) {
                Ok(s) => self.mesh.kernel.site(s).cell,
                Err(_) => Slot::NONE,
            },
            Location::Cell(index) | Location::Outside(index) => cells.slot(index).unwrap_or(Slot::NONE),
            Location::NoCells => Slot::NONE,
        }
    }

    /// How many vertices are hidden.
    pub fn hidden_count(&self) -> usize {
        self.mesh.hidden.count()
    }

    /// The number of vertices that are corners of no cell, while there are cells.
    pub(crate) fn count_in_no_cell(&self) -> usize {
        self.mesh.hidden.count() + self.mesh.kernel.n_hidden()
    }

    /// Checks the triangulation: see [`Level`].
    ///
    /// ```
    /// use deldrift::{Space, motion::{Level, MovingTriangulation, Options}};
    ///
    /// let points: Vec<_> = (0..50).map(|i| [i as f64, (i * i % 17) as f64, (i * i * i % 13) as f64]).collect();
    /// let t = MovingTriangulation::<Space>::new(&points, Options::default())?;
    /// assert!(t.validate(Level::Delaunay).is_ok());
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// The first violation found.
    pub fn validate(&self, level: Level) -> std::result::Result<(), Violation> {
        self.mesh.kernel.validate(level)?;
        self.check_sites()
    }

    /// Every vertex is at a site that it represents or where it is hidden.
    fn check_sites(&self) -> std::result::Result<(), Violation> {
        let violation = |message| Err(Violation { level: Level::Structure, message });
        let mut hidden = 0;
        for (v, s) in self.mesh.sites_of_ids().filter_map(|(v, s)| s.map(|s| (v, s))) {
            let site = self.mesh.kernel.site(s);
            if !site.is_live() || self.mesh.kernel.keys().is_lower(v, site.id) {
                let message = format_args!("vertex {v} is at a site of vertex {}", site.id);
                return violation(memory::text(message));
            }
            hidden += usize::from(site.id != v);
        }
        let sites = self.mesh.kernel.live_sites().count();
        if hidden != self.mesh.hidden.count() || sites + hidden != self.mesh.n_present {
            return violation(memory::text(format_args!(
                "{} vertices, but {sites} places with {hidden} hidden vertices ({} listed)",
                self.mesh.n_present,
                self.mesh.hidden.count()
            )));
        }
        if !self.mesh.knows_who_is_hidden() {
            return violation(memory::text(format_args!("others are hidden than is known")));
        }
        Ok(())
    }

    /// Sums over all commits and immediate calls; `timestamp` and `coincident` are those of now. With weights `coincident` and
    /// `hidden_by_weight` are those of the latest commit; [`statistics_of_now`](Self::statistics_of_now) counts them anew.
    pub fn statistics(&self) -> CommitReport {
        self.statistics
    }

    /// Timestamp reached: 0 at creation.
    pub fn timestamp(&self) -> u64 {
        self.statistics.timestamp
    }

    /// Bytes held, views included.
    pub fn memory_bytes(&self) -> usize {
        self.mesh.memory_bytes()
            + self.staging.memory_bytes()
            + memory::bytes_of(&self.queue)
            + self.regions.memory_bytes()
            + memory::bytes_of_made(&self.repair, Repair::memory_bytes)
            + self.edits.memory_bytes()
            + memory::bytes_of_made(&self.taken, Taken::memory_bytes)
            + memory::bytes_of_made(&self.made, Made::memory_bytes)
    }
}
