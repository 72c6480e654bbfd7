//! A mesh that has grown is made anew: all vertices that refinement has made are taken away, and it begins again.

use super::reading::Read;
use super::{Bounds, NONE};
use crate::delaunay::Plane;
use crate::error::Result;
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::options::{CoarsenOptions, Quality, RefineOptions};
use crate::motion::state::density::{Asked, Due};
use crate::motion::state::made::Inserted;
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::minus;
use crate::refine::{self, Kept, Refined};

/// A mesh made anew.
pub(super) struct Anew {
    pub(super) refined: Refined,
    /// How many vertices it has that refinement has made.
    pub(super) n: usize,
    /// How many of them there may be otherwise.
    pub(super) most: usize,
}

impl MovingTriangulation<Plane> {
    /// Coarsening ends: if it has left too many vertices, the next refinement compares the mesh with one made anew.
    pub(super) fn set_coarsened(&mut self, quality: &Quality, options: &CoarsenOptions, n_removed: usize) {
        let n = self.made_vertices().count();
        let CoarsenOptions { growth, joins, .. } = *options;
        let (timestamp, due) = (self.statistics.timestamp, Due { growth, joins, is_certain: false });
        if let Some(made) = &mut self.made {
            made.density.set_coarsened([n, n_removed], bounds_of(quality), timestamp, due);
        }
    }

    /// Refinement ends, and is remembered with the vertices that it has inserted, and how many there are in a mesh made anew,
    /// if it has compared.
    pub(super) fn set_refined(&mut self, quality: &Quality, inserted: Inserted, n_fresh: Option<usize>) {
        let (n, timestamp) = (self.made_vertices().count(), self.statistics.timestamp);
        if let Some(made) = &mut self.made {
            made.density.set_refined([n, inserted.vertices.len()], n_fresh, bounds_of(quality), timestamp);
            made.set_inserted(inserted);
        }
    }

    /// Finds the mesh made anew; nothing if it would be cut short.
    pub(super) fn find_anew(
        &self,
        (read, mask, quality): (&Read, &[u8], &Quality),
        bounds: &Bounds,
        options: &RefineOptions,
        due: Due,
        ask: &mut dyn FnMut() -> Result<()>,
    ) -> Result<Option<Anew>> {
        let mut candidates = self.candidates(read)?;
        candidates.retain(|candidate| options.keeps == Kept::None || candidate.between.is_none());
        // Those near each other are mostly soon after each other.
        candidates.sort_unstable_by_key(|candidate| read.cell_at(candidate.vertex));
        let no_bounds = Bounds::new(&Quality::default(), read.places.scale)?;
        let (tests, no_tests) = (bounds.tests(quality, read), no_bounds.tests(&Quality::default(), read));
        let points = memory::copy_of(&read.places.points)?;
        let given = read.given(self.cells()?, mask, quality.labels, self.mesh.kernel.keys());
        let (origins, limit) = (self.origins(read)?, (options.keeps, options.limit));
        let made = (&candidates[..], no_tests, due.joins);
        let refined = refine::remesh(given, points, made, tests, origins, limit, ask)?;
        if refined.is_cut_short {
            return Ok(None);
        }
        let n = self.made_vertices().count() - refined.removed.len() + refined.vertices.len();
        Ok(Some(Anew { refined, n, most: (due.growth * n as f64) as usize }))
    }

    /// For each new vertex the edge that it has been put on, of those that there were.
    pub(super) fn edges_under(&self, read: &Read, refined: &Refined) -> Result<Vec<Option<[VertexId; 2]>>> {
        let Refined { vertices, into, .. } = refined;
        // Edges by the one that they have been joined to, along it.
        let mut along: Vec<(u32, f64, u32)> = Vec::new();
        let place = |v| self.position(v).expect("it is an end").map(|x| x * read.places.scale);
        let axis_of = |edge: u32| {
            let [p, q] = read.edges[edge as usize].map(place);
            let u = minus::<f64, 2>(&q, &p);
            usize::from(u[1].abs() > u[0].abs())
        };
        for (edge, &root) in (0..).zip(into) {
            let axis = axis_of(root);
            let [p, q] = read.edges[edge as usize].map(|v| place(v)[axis]);
            memory::push(&mut along, (root, p.min(q), edge))?;
        }
        along.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let mut edges = Vec::new();
        memory::collect(
            &mut edges,
            vertices.iter().map(|&(p, root)| {
                let edge = match (root, along.is_empty()) {
                    (NONE, _) => return None,
                    (_, true) => root,
                    _ => {
                        let x = p[axis_of(root)];
                        let behind =
                            along.partition_point(|&(r, start, _)| r < root || r == root && start <= x);
                        let found = along[..behind].last().filter(|&&(r, ..)| r == root);
                        found.or_else(|| along.get(behind)).expect("it is joined to itself").2
                    }
                };
                Some(read.edges[edge as usize])
            }),
        )?;
        Ok(edges)
    }
}

/// The bounds of a quality; areas add up.
fn bounds_of(quality: &Quality) -> Asked {
    // No area is bounded by 0, which is more than any.
    let area = |x: f64| if x == 0.0 { f64::INFINITY } else { x };
    let areas = quality.areas.iter().map(|&x| area(x)).filter(|x| x.is_finite());
    Asked {
        angle: quality.least_angle,
        area: areas.fold(area(quality.greatest_area), |sum, x| match sum {
            f64::INFINITY => x,
            sum => sum + x,
        }),
    }
}
