//! Triangulations of moving points: staging, timestamps, and the algorithms of the report.
//!
//! A vertex has an id, for life or until a compaction, and a position at each timestamp. Relocations are staged; a commit
//! makes all of them the next timestamp, by one of the algorithms. `algorithms` has a row for each; they are in these
//! files:
//!
//! | file | report | what |
//! |---|---|---|
//! | `rebuilding` | section 1 | triangulate all positions again |
//! | `placement` | sections 3.1, 3.2 | relocate the vertices one at a time |
//! | `tolerance` | section 3.3, Algorithm 1 | place only vertices that leave their tolerance |
//! | `safe_region` | section 3.3, Algorithm 2 | place only vertices that leave their safe region |
//! | `switching` | section 5.2 | rebuild until few leave their tolerance |
//! | `repair` | | move all at once, check every certificate, mend what fails |
//! | `watching` | | as repair, but of what has left its tolerance, or soon will |
//! | `slack` | | as repair, but of bi-cells whose own tolerance is used up |
//! | `auto` | | watching, slack, repair or rebuilding, by what the last commits found |
//!
//! Each of `tolerance`, `safe_region`, `watching` and `slack` has a store and a commit; `regions` keeps one of the stores, and
//! lets it follow changes. `immediate` relocates, inserts and removes one vertex at a time; `moving` has the loops that move
//! all vertices; `transaction` what undoes a change; `cells` and `changes` what callers read of it; `compaction` forgets
//! removed vertices.
//!
//! Invariants between calls:
//! - the cells are those of a fresh build of (positions, ids), whatever happened before;
//! - the vertices at one place share a site; the lowest id represents it, the others are *hidden*;
//! - a call that fails has no effect: every change is a transaction (`transaction`), which is undone from its own record.
//!
//! Memory per vertex: the kernel's, 4 bytes for the site of an id, and once moves are staged a position, a flag and
//! an id.

mod algorithms;
mod attempt;
mod auto;
mod bicell;
mod cells;
mod changes;
mod coincidence;
mod commit;
mod compaction;
mod editing;
mod immediate;
mod marks;
mod matching;
mod moving;
mod options;
mod ordering;
mod placement;
mod query;
mod rebuilding;
mod regions;
mod repair;
mod safe_region;
mod slack;
mod staging;
mod switching;
mod tolerance;
mod transaction;
mod views;
mod visibility;
mod watching;

pub use crate::delaunay::{Level, Violation};
pub use algorithms::{Algorithm, AlgorithmRow, Commits, Purpose};
pub use cells::NO_CELL;
pub use changes::{Changes, NO_VERTEX};
pub use options::{CoincidencePolicy, CommitReport, Monitor, Options, SwitchingRule};
pub use query::Location;
pub(crate) use query::cells_at;
pub use views::CellsView;

use crate::complex::NONE;
use crate::delaunay::{Delaunay, Dimension};
use crate::error::{Error, Result};
use crate::machine::memory;
use crate::machine::threads::Threads;
use crate::predicates::exact_calls;
use auto::Auto;
use changes::Taken;
use coincidence::Hidden;
use editing::Edits;
use regions::Regions;
use repair::Repair;
use staging::{Staging, check_position};
use switching::Switching;
use transaction::Transaction;
use views::Views;

/// Greatest number of vertex ids.
pub const MAX_VERTICES: usize = u32::MAX as usize - 1;

/// The kernel's static filter holds for a box that only grows as vertices move. After this number of moves per vertex it is
/// fitted to the points again, which takes as long as a small part of one commit.
const MOVED: u64 = 64;

/// A Delaunay triangulation whose vertices move.
#[derive(Debug)]
pub struct MovingTriangulation<G: Dimension> {
    kernel: Delaunay<G>,
    /// Site of each id; [`NONE`] once removed.
    site_of: Vec<u32>,
    hidden: Hidden,
    n_present: usize,
    staging: Staging<G>,
    edits: Edits<G>,
    regions: Regions<G>,
    switching: Switching,
    repair: Repair,
    auto: Auto,
    options: Options,
    statistics: CommitReport,
    /// Moves and insertions since the kernel's static filter was made as sharp as possible.
    n_moved: u64,
    /// Mean distance of sites from the next ones in freshly sorted storage: the measure of lost locality.
    sorted_stride: f64,
    transaction: Transaction<G>,
    views: Views<G>,
    /// The changes taken last, and whether any ever were.
    taken: Taken<G::Corners>,
    takes_changes: bool,
}

impl<G: Dimension> MovingTriangulation<G> {
    /// Triangulates `positions`; vertex `i` is the `i`-th of them.
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::OutOfRange`], [`Error::TooManyVertices`], [`Error::TooManyCells`],
    /// [`Error::OutOfMemory`], [`Error::Cancelled`], [`Error::Coincident`] if the options reject that.
    pub fn new(positions: &[G::Point], options: Options) -> Result<Self> {
        if positions.len() > MAX_VERTICES {
            return Err(Error::TooManyVertices { given: positions.len(), limit: MAX_VERTICES });
        }
        let mut t = MovingTriangulation {
            kernel: Delaunay::on(Threads::at_most(options.threads))?,
            site_of: Vec::new(),
            hidden: Hidden::default(),
            n_present: positions.len(),
            staging: Staging::default(),
            edits: Edits::default(),
            regions: Regions::default(),
            switching: Switching::default(),
            repair: Repair::default(),
            auto: Auto::default(),
            options,
            statistics: CommitReport::default(),
            n_moved: 0,
            sorted_stride: 0.0,
            transaction: Transaction::default(),
            views: Views::default(),
            taken: Taken::default(),
            takes_changes: false,
        };
        for (i, p) in positions.iter().enumerate() {
            check_position::<G>("positions", i, p)?;
        }
        t.kernel.add_sites(positions)?;
        memory::reserve_exact(&mut t.site_of, positions.len())?;
        t.site_of.resize(positions.len(), NONE);
        t.build_first()?;
        t.statistics.coincident = t.hidden.count() as u64;
        Ok(t)
    }

    /// The site of a vertex that must be present and not about to be removed.
    #[inline(always)]
    fn site_of_vertex(&self, argument: &'static str, index: usize, vertex: u32) -> Result<u32> {
        let s = self.present_site(argument, index, vertex)?;
        if self.edits.is_leaving(vertex) {
            return Err(Error::RemovedVertex { argument, index, vertex });
        }
        Ok(s)
    }

    /// The site of a vertex that must be present.
    fn present_site(&self, argument: &'static str, index: usize, vertex: u32) -> Result<u32> {
        match self.site_of.get(vertex as usize) {
            None => Err(Error::NoSuchVertex { argument, index, vertex, ids: self.site_of.len() }),
            Some(&NONE) => Err(Error::RemovedVertex { argument, index, vertex }),
            Some(&s) => Ok(s),
        }
    }

    /// Builds the cells of sites in sorted storage for the first time.
    fn build_first(&mut self) -> Result<()> {
        let mut kernel = Delaunay::on(Threads::ONE)?;
        std::mem::swap(&mut kernel, &mut self.kernel);
        let stride = kernel.mean_stride();
        let mut quiet = |_| true;
        let merges = match &mut self.options.monitor {
            Some(monitor) => kernel.rebuild(monitor)?,
            None => kernel.rebuild(&mut quiet)?,
        };
        let hidden = self.hide_merged(&kernel, merges)?;
        self.adopt(kernel, hidden, stride);
        self.find_sites();
        Ok(())
    }

    /// Certificates and exact signs evaluated so far.
    fn evaluations(&self) -> [u64; 2] {
        [self.kernel.certificates(), exact_calls()]
    }

    /// Enters what was evaluated since then.
    fn enter_evaluations(&self, report: &mut CommitReport, [certificates, exact]: [u64; 2]) {
        report.certificates = self.kernel.certificates() - certificates;
        report.exact_calls = exact_calls() - exact;
    }

    /// Adds what was done to the sums.
    fn count(&mut self, report: CommitReport) {
        let sum = &mut self.statistics;
        sum.moved += report.moved;
        sum.unchanged += report.unchanged;
        sum.placements += report.placements;
        sum.flips += report.flips;
        sum.rebuilds += report.rebuilds;
        sum.inserted += report.inserted;
        sum.removed += report.removed;
        sum.within_tolerance += report.within_tolerance;
        sum.within_safe_region += report.within_safe_region;
        sum.tolerances += report.tolerances;
        sum.certificates += report.certificates;
        sum.exact_calls += report.exact_calls;
        sum.coincident = self.hidden.count() as u64;
        self.n_moved += report.moved + report.inserted;
        if self.n_moved > MOVED * self.n_present as u64 {
            self.n_moved = 0;
            self.regions.tighten_filter(&mut self.kernel);
        }
    }
}
