//! How values at vertices that refinement inserts follow from those that are there.

use crate::delaunay::Plane;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::reading::query::Location;
use crate::motion::report::VertexWeights;
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::minus;

impl MovingTriangulation<Plane> {
    /// For each vertex that the last [`refine`](Self::refine) inserted, in the order of their ids, how linear values there
    /// follow from those at the vertices before: if [`has_weights`](crate::motion::RefineOptions::has_weights) was set, and
    /// neither a commit nor a compaction has come since. Otherwise empty.
    pub fn refined_weights(&self) -> &[VertexWeights] {
        self.made.as_ref().map_or(&[], |made| made.weights(self.timestamp()))
    }

    /// Weights of places that are on an edge of two vertices, or in the closure of a cell.
    pub(super) fn weights_of(
        &self,
        points: &[[f64; 2]],
        edges: impl Iterator<Item = Option<[VertexId; 2]>>,
    ) -> Result<Vec<VertexWeights>> {
        let mut weights = Vec::new();
        memory::reserve_exact(&mut weights, points.len())?;
        let mut near = None;
        for (point, edge) in points.iter().zip(edges) {
            weights.push(match edge {
                Some(edge) => self.weights_on(edge, point),
                None => {
                    let mut found = Location::NoCells;
                    self.locate_points(std::slice::from_ref(point), near, |location| found = location)?;
                    near = Some(found);
                    self.weights_in(found, point)?
                }
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

    /// A place that is in a cell. One in a cell at a piece that rounding has bent outwards may be beyond the hull of the
    /// cells before, by as much: then weights below 0 are 0.
    fn weights_in(&self, location: Location, point: &[f64; 2]) -> Result<VertexWeights> {
        let cell = match location {
            Location::Vertex(v) => return Ok(VertexWeights { vertices: [v; 3], weights: [1.0, 0.0, 0.0] }),
            Location::Cell(cell) | Location::Outside(cell) => cell,
            Location::NoCells => unreachable!("cells have been refined"),
        };
        let mut weights = [0.0; 3];
        self.barycentric(std::slice::from_ref(point), &[cell], |row| {
            weights.copy_from_slice(row.expect("it is a cell"));
        })?;
        if matches!(location, Location::Outside(_)) {
            weights = weights.map(|weight: f64| weight.max(0.0));
            let sum: f64 = weights.iter().sum();
            weights = weights.map(|weight| weight / sum);
        }
        Ok(VertexWeights { vertices: self.cells()?.corners[cell], weights })
    }
}
