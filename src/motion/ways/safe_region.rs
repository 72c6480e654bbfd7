//! One commit of the safe region algorithm.
//!
//! ```text
//! for each relocation of z to p:
//!     m_z <- p
//!     if m_z is certainly in the safe region of z: done
//!     else: z joins the queue
//! for each z in the queue:
//!     move z with the placement algorithm
//! for each bi-cell B of a queued vertex or a new cell:
//!     compute and store c_B and r_B
//! ```
//!
//! Vertices are placed at the moving positions, and none is queued twice: see the
//! [tolerance algorithm](crate::motion::ways::tolerance). With tolerances, the safe region is tested only where the
//! tolerance test fails.
//!
//! Cost: a test is a squared distance for each bi-cell of the star; a queued vertex costs as in the tolerance
//! algorithm.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::motion::region_kind::RegionKind;
use crate::motion::report::CommitReport;
use crate::motion::state::goals::Moves;
use crate::motion::triangulation::MovingTriangulation;

impl<G: Moving> MovingTriangulation<G> {
    /// Algorithm 2, with regions of a kind that has safe regions.
    pub(in crate::motion) fn commit_by_safe_region(
        &mut self,
        kind: RegionKind,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        if !self.mesh.kernel.has_cells() {
            return self.rebuild(moves, report);
        }
        let goals = moves.checked()?;
        self.prepare_regions(kind, goals.positions(), report)?;
        let mut queue = self.queue_of(moves)?;
        self.accept_queued(&mut queue, goals, report)?;
        self.place_queued(queue, goals, report)
    }
}
