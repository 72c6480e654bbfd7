//! Vertices that pass segments on their way: asked for, told, or refused.

use crate::delaunay::Moving;
use crate::error::{Passing, Result};
use crate::motion::options::PassingPolicy;
use crate::motion::state::passings::{Steps, find};
use crate::motion::triangulation::MovingTriangulation;

impl<G: Moving> MovingTriangulation<G> {
    /// Whether vertices would pass segments in a commit of what is staged, which stays so; then
    /// [`passings`](Self::passings) has them.
    ///
    /// In a step each vertex goes straight from its old place to its new one, at constant speed, and so do both ends of
    /// each segment that is in force before and after. A vertex *passes* a segment, of which it is no end, if it goes
    /// through it and is not back on its side at the end of the step; also if it goes exactly through an end on its way. One
    /// that is at the place of an end when the step begins or when it ends is on no side of that segment, and does not
    /// pass it. Exact, at all positions.
    ///
    /// ```
    /// use deldrift::{Error, Plane, VertexId, motion::{MovingTriangulation, Options, Segment}};
    ///
    /// let points = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [2.0, 1.0], [2.0, 3.0], [1.0, 2.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&points, Options::default())?;
    /// let slit = Segment { ends: [4, 5].map(VertexId::new), marker: 0, ..Segment::default() };
    /// t.stage_segments([slit].into_iter())?;
    /// t.commit_timestamp()?;
    /// t.move_vertices(&[VertexId::new(6)], &[[3.0, 2.0]])?;
    /// assert!(matches!(t.check_passings(), Err(Error::Passing { others: 0, .. })));
    /// assert_eq!(t.passings()[0].vertex.get(), 6);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Passing`](crate::Error::Passing) if one would, [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn check_passings(&mut self) -> Result<()> {
        self.mesh.last_found.begin();
        let staging = std::mem::take(&mut self.staging);
        let looked = self.look_for_passings(&Steps::Staged(&staging));
        self.staging = staging;
        looked?;
        self.mesh.last_found.refuse_passings()
    }

    /// The vertices that pass segments in the step that the latest call that changes or checks has looked at, ascending by
    /// segment and vertex: [`check_passings`](Self::check_passings), or a commit, check of what is staged or relocation
    /// where the options say that they look. Calls that stage, discard, publish, withdraw or ask keep them.
    pub fn passings(&self) -> &[Passing] {
        self.mesh.last_found.passings()
    }

    /// Looks at the staged moves as the options say.
    pub(in crate::motion) fn apply_passing_policy_to_staged(&mut self) -> Result<()> {
        let staging = std::mem::take(&mut self.staging);
        let applied = self.apply_passing_policy(|| Ok(Steps::Staged(&staging)));
        self.staging = staging;
        applied
    }

    /// Looks at a step as the options say, if there are segments; `steps` is asked for where that is so.
    pub(in crate::motion) fn apply_passing_policy<'a>(
        &mut self,
        steps: impl FnOnce() -> Result<Steps<'a, G>>,
    ) -> Result<()>
    where
        G: 'a,
    {
        if self.mesh.segments.is_none() || self.options.passing == PassingPolicy::Ignore {
            return Ok(());
        }
        self.look_for_passings(&steps()?)?;
        if self.options.passing == PassingPolicy::Refuse {
            self.mesh.last_found.refuse_passings()
        } else {
            Ok(())
        }
    }

    fn look_for_passings(&mut self, steps: &Steps<'_, G>) -> Result<()> {
        let found = find(&self.mesh, &self.edits, steps)?;
        self.mesh.last_found.report_passings(found);
        Ok(())
    }
}
