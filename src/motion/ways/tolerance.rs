//! One commit of the tolerance algorithm.
//!
//! ```text
//! for each relocation of z to p:
//!     m_z <- p
//!     if m_z is certainly in the tolerance region of z: done
//!     else: z joins the queue
//! for each z in the queue:
//!     move z with the placement algorithm
//! for each bi-cell B of a queued vertex or a new cell:
//!     ε' <- half the width of the standard delimiter of B
//!     for each vertex w of B: ε_w <- min(ε_w, ε')
//! ```
//!
//! **One embedding.** The report places vertices in the embedding at *fixed* positions, T_f, and so has to
//! queue a vertex again when a new bi-cell's tolerance falls below its displacement. Here the queue is
//! worked off in the embedding at the *moving* positions: once every accepted vertex has moved, that is a
//! Delaunay triangulation by Proposition 1, the queued vertices being where they were; predicates are exact, so it
//! stays one after each placement, without checking any delimiter. So delimiters are computed once, after the last
//! placement, and no vertex is ever queued again. They are taken at the moving positions, which lie within them by
//! construction. A vertex *w* that gets a smaller tolerance is fixed again where it is: the ball around `f_w` of
//! radius ε_w holds the ball around `m_w` of radius `ε_w − |m_w − f_w|`, so
//! `(f_w, ε_w) <- (m_w, min(ε_w − |m_w − f_w|, ε'))`.
//!
//! **Certified.** Tolerances are lower bounds and displacements are compared as upper bounds
//! ([`predicates::tolerance`](crate::predicates)), so an accepted vertex *provably* changes nothing.
//!
//! **Coincident vertices** always take the queue.
//!
//! Cost: a test is a squared distance; a queued vertex costs a placement, and up to about 12 (plane) or 66 (space)
//! delimiters, which it shares with its neighbours in the queue. `examples/tolerance_share` measures both.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::motion::region_kind::RegionKind;
use crate::motion::report::CommitReport;
use crate::motion::state::goals::Moves;
use crate::motion::triangulation::MovingTriangulation;

impl<G: Moving> MovingTriangulation<G> {
    /// Algorithm 1.
    pub(in crate::motion) fn commit_by_tolerance(
        &mut self,
        moves: &mut Moves<'_, G>,
        report: &mut CommitReport,
    ) -> Result<()> {
        if !self.mesh.kernel.has_cells() {
            return self.rebuild(moves, report);
        }
        if self.regions.kept_for() != Some(RegionKind::Tolerance) {
            let goals = moves.checked()?;
            self.prepare_regions(RegionKind::Tolerance, goals.positions(), report)?;
        }
        let queue = if self.mesh.moves_in_one_loop(moves) {
            self.accept_all(moves, report)?
        } else {
            let mut queue = self.queue_of(moves)?;
            self.accept_queued(&mut queue, moves.checked()?, report)?;
            queue
        };
        self.place_queued(queue, moves.checked()?, report)
    }
}
