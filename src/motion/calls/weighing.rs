//! How values at vertices that refinement inserts follow from those that are there.

use crate::complex::INFINITE;
use crate::delaunay::{Place, Plane};
use crate::error::Result;
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::filters::barycentric::barycentric;
use crate::motion::report::VertexWeights;
use crate::motion::state::made::Inserted;
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::minus;

impl MovingTriangulation<Plane> {
    /// For each vertex that the last [`refine`](Self::refine) inserted, in the order of their ids, how linear values there
    /// follow from those at the vertices before: if [`has_weights`](crate::motion::RefineOptions::has_weights) was set, and
    /// neither a commit nor a compaction has come since. Otherwise empty.
    pub fn refined_weights(&self) -> &[VertexWeights] {
        self.last_inserted().map_or(&[], |inserted| &inserted.weights)
    }

    /// For each vertex that the last [`refine`](Self::refine) inserted, in the order of their ids, the size that it had there,
    /// if it was called with [sizes](crate::motion::Quality::sizes), and neither a commit nor a compaction has come since.
    /// Otherwise empty. With these sizes a second call finds nothing to do.
    pub fn refined_sizes(&self) -> &[f64] {
        self.last_inserted().map_or(&[], |inserted| &inserted.sizes)
    }

    /// The vertices that the last [`refine`](Self::refine) inserted, ascending, if neither a commit nor a compaction has
    /// come since. Otherwise empty.
    pub fn refined_vertices(&self) -> &[VertexId] {
        self.last_inserted().map_or(&[], |inserted| &inserted.vertices)
    }

    fn last_inserted(&self) -> Option<&Inserted> {
        self.made.as_ref()?.inserted(self.statistics.timestamp)
    }

    /// Weights of places that are on an edge of two vertices, or in the closure of a cell.
    pub(super) fn weights_of(
        &self,
        points: &[[f64; 2]],
        edges: &[Option<[VertexId; 2]>],
    ) -> Result<Vec<VertexWeights>> {
        let mut weights = Vec::new();
        memory::reserve_exact(&mut weights, points.len())?;
        let kernel = &self.mesh.kernel;
        let mut near = Slot::NONE;
        for (point, &edge) in points.iter().zip(edges) {
            weights.push(match edge {
                Some(edge) => self.weights_on(edge, point),
                None => match kernel.locate(point, near) {
                    Place::Cell(slot) => {
                        near = slot;
                        self.weights_in(slot, point)
                    }
                    // One in a cell at a piece that rounding has bent outwards may be beyond the hull, by as much.
                    Place::Outside(slot) => {
                        let ends = kernel.complex().cell(slot).corners;
                        let mut ends =
                            (0..3).map(|i| ends[i]).filter(|&s| s != INFINITE).map(|s| kernel.site(s).id);
                        let mut end = || ends.next().expect("an edge of the hull");
                        self.weights_on(ascending([end(), end()]), point)
                    }
                    Place::Site(s) => {
                        VertexWeights { vertices: [kernel.site(s).id; 3], weights: [1.0, 0.0, 0.0] }
                    }
                    Place::NoCells => unreachable!("cells have been refined"),
                },
            });
        }
        Ok(weights)
    }

    /// A place on an edge, but for rounding.
    fn weights_on(&self, [a, b]: [VertexId; 2], point: &[f64; 2]) -> VertexWeights {
        let [p, q] = [a, b].map(|v| self.position(v).expect("it is an end"));
        let u = minus::<f64, 2>(&q, &p);
        // By the coordinate in which the ends differ more: no product that might underflow.
        let axis = usize::from(u[1].abs() > u[0].abs());
        let share = ((point[axis] - p[axis]) / u[axis]).clamp(0.0, 1.0);
        VertexWeights { vertices: [a, b, a], weights: [1.0 - share, share, 0.0] }
    }

    /// A place that is in a cell. Neither the order of corners counts nor, on an edge, which of the two cells there it
    /// is, as copies that have been loaded have others.
    fn weights_in(&self, slot: Slot, point: &[f64; 2]) -> VertexWeights {
        let kernel = &self.mesh.kernel;
        let corners = kernel.complex().cell(slot).corners;
        let mut sites = [0, 1, 2].map(|i| corners[i]);
        let vertex = |s: SiteId| kernel.site(s).id;
        let first = (0..3).min_by_key(|&i| vertex(sites[i])).expect("three corners");
        sites.rotate_left(first);
        let [x, y, z, _] = barycentric(kernel, &sites.map(|s| kernel.place(s)), point);
        let vertices = sites.map(vertex);
        // A weight is 0 on the edge opposite alone.
        if let Some(opposite) = [x, y, z].iter().position(|&weight| weight == 0.0) {
            let ends = [1, 2].map(|k| vertices[(opposite + k) % 3]);
            return self.weights_on(ascending(ends), point);
        }
        // Rounding may take one above 1.
        VertexWeights { vertices, weights: [x, y, z].map(|weight| weight.min(1.0)) }
    }
}

fn ascending([v, w]: [VertexId; 2]) -> [VertexId; 2] {
    [v.min(w), v.max(w)]
}
