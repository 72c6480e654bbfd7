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
//! Vertices are placed at the moving positions, and none is queued twice: see the [tolerance
//! algorithm](crate::motion::ways::tolerance). With tolerances, the safe region is tested only where the tolerance
//! test fails. A vertex that is still in it and goes slowly gets another ball in it, around its new place, with the
//! distance of the nearest delimiter for radius: this is its tolerance from then on. So its star is tested now and
//! then, and one distance in between. (`docs/FUTURE_WORK.md` has what this gains.)
//!
//! Cost: a test is a squared distance for each bi-cell of the star, and another ball as much again; a queued vertex
//! costs as in the tolerance algorithm.

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
        if self.regions.kept_for() != Some(kind) {
            let goals = moves.checked()?;
            self.prepare_regions(kind, goals.positions(), report)?;
        }
        let mut queue = if kind == RegionKind::Both && self.mesh.moves_in_one_loop(moves) {
            self.accept_all(moves, report)?
        } else {
            self.queue_of(moves)?
        };
        let goals = moves.checked()?;
        self.accept_queued(&mut queue, goals, report)?;
        self.place_queued(queue, goals, report)
    }
}

#[cfg(test)]
mod tests {
    use crate::delaunay::{Level, Moving, Plane, Space};
    use crate::motion::algorithms::Algorithm;
    use crate::motion::options::Options;
    use crate::motion::triangulation::MovingTriangulation;
    use crate::random::Rng;

    /// Vertices that go slowly are found in the ball that they have got where they left the one before.
    fn another_ball_lasts<G: Moving>(step: f64) {
        let rng = &mut Rng::new(4);
        let n = 300;
        let mut draw = |size: f64| {
            let mut p = G::Point::default();
            (0..G::D).for_each(|axis| p[axis] = size * (rng.unit() - 0.5));
            p
        };
        let mut places: Vec<_> = (0..n).map(|_| draw(1.0)).collect();
        let ways: Vec<_> = (0..n).map(|_| draw(step)).collect();
        let options = Options { algorithm: Algorithm::SafeRegionTolerance, ..Options::default() };
        let mut t = MovingTriangulation::<G>::new(&places, options).expect("room");
        for k in 0..100 {
            for (p, way) in places.iter_mut().zip(&ways) {
                (0..G::D).for_each(|axis| p[axis] += way[axis]);
            }
            t.commit_positions(&places).expect("good places");
            assert!(k % 10 > 0 || t.validate(Level::Delaunay) == Ok(()));
        }
        let done = t.statistics();
        assert!(done.within_safe_region > 20, "{done:?}");
        assert!(8 * done.within_safe_region < done.within_tolerance, "{done:?}");
    }

    /// A vertex of the hull goes in, farther than the filter reaches off all vertices, and back to its ball.
    #[test]
    fn the_filter_covers_balls_that_vertices_have_left() {
        let mut places = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.2], [0.01, 0.2], [1.5, 0.1]];
        let options = Options { algorithm: Algorithm::SafeRegionTolerance, ..Options::default() };
        let mut t = MovingTriangulation::<Plane>::new(&places, options).expect("room");
        for (x, within) in [(1.5, [5, 0]), (1.47, [4, 1]), (1.5, [5, 0])] {
            places[4][0] = x;
            let report = t.commit_positions(&places).expect("good places");
            assert_eq!([report.within_tolerance, report.within_safe_region], within, "{x}");
            assert!(t.mesh.kernel.is_covered(&places[4]));
            t.regions.tighten_filter(&mut t.mesh.kernel);
        }
    }

    #[test]
    fn another_ball_lasts_in_the_plane() {
        another_ball_lasts::<Plane>(1e-5);
    }

    #[test]
    fn another_ball_lasts_in_space() {
        another_ball_lasts::<Space>(1e-5);
    }
}
