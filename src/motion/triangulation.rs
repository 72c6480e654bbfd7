//! The triangulation: the place where its parts meet.

use crate::delaunay::{Delaunay, Moving};
use crate::error::{Error, Result, StagedEdit};
use crate::ids::{SegmentId, SiteId, VertexId};
use crate::machine::memory;
use crate::machine::threads::Threads;
use crate::motion::constants::Table;
use crate::motion::filters::regions::Regions;
use crate::motion::options::Options;
use crate::motion::plan::auto::Auto;
use crate::motion::plan::switching::Switching;
use crate::motion::report::{CommitReport, Evaluations};
use crate::motion::state::cells::Cells;
use crate::motion::state::checking::{are_good, first_bad};
use crate::motion::state::edits::Edits;
use crate::motion::state::foreseen::Foreseen;
use crate::motion::state::hidden::Hidden;
use crate::motion::state::made::Made;
use crate::motion::state::mesh::Mesh;
use crate::motion::state::repair::Repair;
use crate::motion::state::segments::Aim;
use crate::motion::state::staging::Staging;
use crate::motion::state::taken::Taken;
use crate::motion::state::views::CellsView;

/// Greatest number of vertex ids.
pub const MAX_VERTICES: usize = u32::MAX as usize - 1;

/// The static filter's box only grows as vertices move. After this number of moves per vertex it is fitted again, which
/// takes as long as a small part of one commit.
const MOVES_PER_FIT: u64 = 64;

/// A Delaunay triangulation whose vertices move.
#[derive(Debug)]
pub struct MovingTriangulation<G: Moving> {
    pub(in crate::motion) mesh: Mesh<G>,
    pub(in crate::motion) staging: Staging<G>,
    /// Memory for the vertices that a commit places.
    pub(in crate::motion) queue: Vec<VertexId>,
    pub(in crate::motion) edits: Edits<G>,
    pub(in crate::motion) regions: Regions<G>,
    pub(in crate::motion) switching: Switching,
    /// Memory of repairs, once there was one.
    pub(in crate::motion) repair: Option<Box<Repair>>,
    pub(in crate::motion) auto: Auto,
    /// Without the monitor, which the kernel has.
    pub(in crate::motion) options: Options,
    pub(in crate::motion) statistics: CommitReport,
    /// Moves and insertions since the kernel's static filter was made as sharp as possible.
    pub(in crate::motion) n_moved: u64,
    pub(in crate::motion) foreseen: Foreseen,
    /// The changes taken last.
    pub(in crate::motion) taken: Option<Box<Taken<G::Vertices>>>,
    /// What refinement has made, once it has made something.
    pub(in crate::motion) made: Option<Box<Made>>,
}

impl<G: Moving> MovingTriangulation<G> {
    /// Triangulates `positions`; vertex `i` is the `i`-th of them.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// assert_eq!((t.vertex_count(), t.cell_count(), t.timestamp()), (4, 2, 0));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::OutOfRange`], [`Error::TooManyVertices`], [`Error::TooManyCells`],
    /// [`Error::OutOfMemory`], [`Error::Cancelled`], [`Error::Coincident`] if the options reject that.
    pub fn new(positions: &[G::Point], options: Options) -> Result<Self> {
        let mut t = Self::unbuilt(options);
        t.build_first(positions)?;
        Ok(t)
    }

    /// A triangulation that is to be [built](Self::build_first). Inlined, it is made where it is going to be: it has
    /// some kilobytes, and to move them takes longer than to build one of a few points.
    #[inline(always)]
    pub(crate) fn unbuilt(options: Options) -> Self {
        let kernel = Delaunay::empty_on(Threads::at_most(options.threads, options.parts));
        Self::of_parts(kernel, Vec::new(), Hidden::default(), 0, options)
    }

    /// A triangulation of which nothing is known but the kernel, the site of each id, and which of the `n_present`
    /// vertices are hidden.
    #[inline(always)]
    pub(in crate::motion) fn of_parts(
        mut kernel: Delaunay<G>,
        site_of: Vec<SiteId>,
        hidden: Hidden,
        n_present: usize,
        mut options: Options,
    ) -> Self {
        kernel.pace_mut().set_monitor(options.monitor.take());
        MovingTriangulation {
            mesh: Mesh::of_parts(kernel, site_of, hidden, n_present),
            staging: Staging::default(),
            queue: Vec::new(),
            edits: Edits::default(),
            regions: Regions::default(),
            switching: Switching::default(),
            repair: None,
            auto: Auto::default(),
            options,
            statistics: CommitReport::default(),
            n_moved: 0,
            foreseen: Foreseen::default(),
            taken: None,
            made: None,
        }
    }

    /// The options of this, for another triangulation, but for the monitor.
    pub(crate) fn options_of_another(&self) -> Options {
        let Options { algorithm, threads, parts, coincidence, passing, .. } = self.options;
        Options { algorithm, threads, parts, coincidence, passing, monitor: None }
    }

    /// How many threads its calls may use.
    pub(crate) fn threads(&self) -> Threads {
        self.mesh.kernel.threads()
    }

    /// Gives its monitor to another triangulation, for that of the other one.
    pub(crate) fn exchange_monitors(&mut self, other: &mut Self) {
        std::mem::swap(self.mesh.kernel.pace_mut(), other.mesh.kernel.pace_mut());
    }

    /// From now on decides by other constants, for measurements.
    pub fn set_constants(&mut self, table: &'static Table) {
        self.mesh.constants = table.of::<G>();
    }

    /// The site of a vertex that must be present and not about to be removed.
    #[inline(always)]
    pub(in crate::motion) fn site_of_vertex(
        &self,
        argument: &'static str,
        index: usize,
        vertex: VertexId,
    ) -> Result<SiteId> {
        let s = self.present_site(argument, index, vertex)?;
        if self.edits.is_removal_staged(vertex) {
            return Err(Error::StagedVertex { argument, index, vertex, staged: StagedEdit::Removal });
        }
        Ok(s)
    }

    /// The site of a vertex that must be present.
    pub(in crate::motion) fn present_site(
        &self,
        argument: &'static str,
        index: usize,
        vertex: VertexId,
    ) -> Result<SiteId> {
        self.mesh.site(vertex).ok_or_else(|| self.absent(argument, index, vertex))
    }

    /// Why a vertex is not there.
    #[cold]
    fn absent(&self, argument: &'static str, index: usize, vertex: VertexId) -> Error {
        let ids = self.mesh.site_of.len();
        if vertex.index() >= ids {
            Error::NoSuchVertex { argument, index, vertex, ids }
        } else if self.edits.is_insertion_staged(vertex) {
            Error::StagedVertex { argument, index, vertex, staged: StagedEdit::Insertion }
        } else {
            Error::RemovedVertex { argument, index, vertex }
        }
    }

    /// Whether a timestamp is prepared.
    pub fn is_prepared(&self) -> bool {
        self.mesh.rounds.is_some()
    }

    /// Refuses what may not be done while a timestamp is prepared.
    #[inline(always)]
    pub(crate) fn reject_prepared(&self) -> Result<()> {
        if self.is_prepared() { Err(self.prepared()) } else { Ok(()) }
    }

    #[cold]
    fn prepared(&self) -> Error {
        Error::Prepared { timestamp: self.statistics.timestamp + 1, rounds: self.mesh.n_rounds() }
    }

    /// Makes the sites and builds the cells for the first time. After an error the triangulation can only be dropped.
    ///
    /// # Errors
    /// The errors of [`new`](Self::new).
    pub(crate) fn build_first(&mut self, positions: &[G::Point]) -> Result<()> {
        if positions.len() > MAX_VERTICES {
            return Err(Error::TooManyVertices { given: positions.len(), limit: MAX_VERTICES });
        }
        if !are_good::<G>(positions) {
            return Err(first_bad::<G>(positions));
        }
        self.mesh.n_present = positions.len();
        self.mesh.kernel.add_sites(positions)?;
        memory::reserve_exact(&mut self.mesh.site_of, positions.len())?;
        self.mesh.site_of.resize(positions.len(), SiteId::NONE);
        self.mesh.sorted_stride = self.mesh.kernel.mean_stride();
        let mut pace = std::mem::take(self.mesh.kernel.pace_mut());
        let merges = self.mesh.kernel.rebuild(&mut |fraction| pace.ask(fraction));
        *self.mesh.kernel.pace_mut() = pace;
        let merges = merges?;
        self.mesh.hidden = self.mesh.hide_merged(&self.mesh.kernel, &merges, self.options.coincidence)?;
        self.statistics.coincident = self.mesh.hidden.count() as u64;
        self.mesh.find_sites();
        self.count_hidden()
    }

    /// Makes a change, all of it or nothing; `put_back` follows where it is undone, and puts vertices back that it has only moved.
    pub(in crate::motion) fn transact<T>(
        &mut self,
        change: impl FnOnce(&mut Self) -> Result<T>,
        put_back: impl FnOnce(&mut Self),
    ) -> Result<T> {
        self.mesh.begin(Aim::Other)?;
        let done = change(self).and_then(|done| {
            self.mesh.enforce_segments()?;
            self.mesh.views.prepare(&self.mesh.kernel)?;
            Ok(done)
        });
        match done {
            Ok(done) => {
                self.mesh.publish();
                Ok(done)
            }
            Err(error) => {
                self.undo_but_places();
                put_back(self);
                self.mesh.kernel.settle_undone();
                Err(error)
            }
        }
    }

    /// Puts all back as it was when a change began, but for places of vertices that were only moved, which nothing has noted, and for
    /// where hidden ones are: [`settle_undone`](Delaunay::settle_undone) must follow. Needs no memory.
    fn undo_but_places(&mut self) {
        self.mesh.undo();
        self.regions.invalidate();
    }

    /// Puts all back as it was when a change began. Needs no memory.
    pub(in crate::motion) fn undo(&mut self) {
        self.undo_but_places();
        self.mesh.kernel.settle_undone();
    }

    /// Enters what was evaluated since then.
    pub(in crate::motion) fn enter_evaluations(&self, report: &mut CommitReport, before: Evaluations) {
        let now = self.mesh.evaluations();
        report.certificates = now.certificates - before.certificates;
        report.exact_calls = now.exact - before.exact;
    }

    /// Adds what was done to the sums.
    pub(in crate::motion) fn count(&mut self, report: CommitReport) {
        self.statistics.add(&report);
        if !G::HAS_WEIGHTS {
            self.statistics.coincident = self.mesh.hidden.count() as u64;
        }
        self.n_moved += report.moved + report.inserted;
        if self.n_moved > MOVES_PER_FIT * self.mesh.n_present as u64 {
            self.n_moved = 0;
            self.regions.tighten_filter(&mut self.mesh.kernel);
        }
    }

    /// Counts the vertices with weights that are hidden, in the sums; or refuses two at one place, if the options do.
    pub(in crate::motion) fn count_hidden(&mut self) -> Result<()> {
        if G::HAS_WEIGHTS {
            let now = self.mesh.hidden_in(&self.mesh.kernel, self.options.coincidence)?;
            (self.statistics.coincident, self.statistics.hidden_by_weight) = (now.by_place, now.by_weight);
        }
        Ok(())
    }

    /// Ids given so far; those below it are valid unless removed.
    pub fn id_count(&self) -> usize {
        self.mesh.site_of.len()
    }

    /// Number of finite cells.
    pub fn cell_count(&self) -> usize {
        self.mesh.kernel.complex().n_finite()
    }

    /// Position of a vertex at the current timestamp; a staged one is not seen.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`](crate::Error::NoSuchVertex), [`Error::RemovedVertex`](crate::Error::RemovedVertex).
    pub fn position(&self, vertex: VertexId) -> Result<G::Point> {
        Ok(self.mesh.kernel.site(self.present_site("vertex", 0, vertex)?).point)
    }

    /// The vertices that `refine` has added and that are there, ascending, each with the segment that it was put
    /// on, [`SegmentId::NONE`] if there is none; not those of `stage_splits`.
    pub fn made_vertices(&self) -> impl Iterator<Item = (VertexId, SegmentId)> {
        let all = self.made.iter().flat_map(|made| made.vertices());
        all.copied().filter(|&(v, _)| self.mesh.is_present(v))
    }

    /// The finite cells and their neighbours.
    ///
    /// The first call after a change costs what that has changed, others constant time.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let cells = t.cells()?;
    /// for (row, neighbours) in cells.corners.iter().zip(cells.neighbours) {
    ///     println!("{row:?} beside {neighbours:?}");
    /// }
    /// assert_eq!(cells.corners.len(), 2);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn cells(&self) -> Result<CellsView<'_, G>> {
        let cells = self.cell_arrays()?;
        Ok(CellsView { corners: cells.corners(), neighbours: cells.neighbours() })
    }

    pub(in crate::motion) fn cell_arrays(&self) -> Result<&Cells<G>> {
        self.mesh.views.cells(&self.mesh.kernel)
    }
}
