//! A second triangulation like the first.

use crate::delaunay::Moving;
use crate::error::Result;
use crate::machine::memory;
use crate::motion::options::{Monitor, Options};
use crate::motion::state::views::Views;
use crate::motion::triangulation::MovingTriangulation;

impl<G: Moving> MovingTriangulation<G> {
    /// An independent triangulation that is as this one: positions, ids, cells with their indices, hidden vertices,
    /// what is staged, the timestamp, statistics, options, the changes that have not been taken, and what the algorithm
    /// keeps between commits. The callback of the options is `monitor`, as that of this one cannot be copied. Views,
    /// and lists of changes that have been taken, stay with this one.
    ///
    /// If there are arrays of [`cells`](Self::cells), they are brought up to date. A pass over what is kept.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let mut copy = t.try_clone(None)?;
    /// copy.remove_vertex(VertexId::new(3))?;
    /// assert_eq!((t.vertex_count(), copy.vertex_count()), (4, 3));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory), [`Error::Prepared`](crate::Error::Prepared).
    pub fn try_clone(&self, monitor: Option<Monitor>) -> Result<Self> {
        self.reject_prepared()?;
        self.duplicate(monitor)
    }

    /// A copy, of the prepared state if there is one, which is published in the copy.
    fn duplicate(&self, monitor: Option<Monitor>) -> Result<Self> {
        let Options { algorithm, threads, parts, coincidence, passing, .. } = self.options;
        let mut mesh = self.mesh.copied()?;
        mesh.kernel.pace_mut().set_monitor(monitor);
        Ok(MovingTriangulation {
            mesh,
            staging: self.staging.copied()?,
            queue: Vec::new(),
            edits: self.edits.copied()?,
            regions: self.regions.copied()?,
            switching: self.switching.clone(),
            repair: None,
            auto: self.auto.clone(),
            options: Options { algorithm, threads, parts, coincidence, passing, monitor: None },
            statistics: self.statistics,
            n_moved: self.n_moved,
            foreseen: Default::default(),
            taken: None,
            made: match &self.made {
                Some(made) => Some(memory::boxed(made.copied()?)?),
                None => None,
            },
        })
    }

    /// A copy without segments: the cells are the Delaunay triangulation of the vertices, which have the ids that they have
    /// here.
    pub(in crate::motion) fn without_segments(&self) -> Result<Self> {
        let mut copy = self.duplicate(None)?;
        if let Some(segments) = copy.mesh.segments.take() {
            copy.mesh.kernel.put_back_replaced(segments.replaced())?;
            copy.mesh.kernel.exchange_required(&mut Vec::new());
            copy.mesh.views = Views::default();
        }
        Ok(copy)
    }
}
