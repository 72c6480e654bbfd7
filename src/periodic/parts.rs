//! Places and weights of vertices, given apart, as in an open triangulation
//! ([`move_parts`](crate::motion::MovingTriangulation::move_parts)).

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::{CommitReport, PointPart, check_numbers, set_part};
use crate::periodic::lattice::Lattice;
use crate::periodic::triangulation::PeriodicTriangulation;

impl<G: Moving> PeriodicTriangulation<G> {
    /// Stages places or weights of these vertices, or of those with the first ids: rows of as many numbers as they have, one for
    /// each; all of them or, on an error, none. The other part stays what it is, or what it is staged to be. In a list vertices
    /// that are to be inserted can be given weights, again and again, and no places. Without a list entries of vertices that are
    /// gone, or are to go, are not read.
    ///
    /// # Errors
    /// [`Error::WrongCount`] if there are more rows than ids, or not one for each; [`Error::NoSuchVertex`], [`Error::RemovedVertex`],
    /// [`Error::StagedVertex`]; [`Error::DuplicateMove`] if this part is staged already; [`Error::NotFinite`],
    /// [`Error::OutOfRange`], [`Error::OutOfMemory`].
    pub fn move_parts(
        &mut self,
        part: PointPart,
        vertices: Option<&[VertexId]>,
        numbers: &[f64],
    ) -> Result<()> {
        let (n, n_ids) = (numbers.len() / part.width::<G>(), self.id_count());
        let n_coming = self.staged.insertions().len();
        let wanted = vertices.map_or(n.min(n_ids), <[VertexId]>::len);
        if n != wanted {
            return Err(Error::WrongCount { argument: "count", given: n, wanted, coming: n_coming });
        }
        let n_vertices = self.inside.images.n_vertices();
        let vertex_at = |k: usize| vertices.map_or(VertexId::at(k), |vertices| vertices[k]);
        let (mut listed, mut coming) = (Vec::new(), Vec::new());
        memory::reserve_exact(&mut listed, n)?;
        for k in 0..n {
            let (vertex, row) = (vertex_at(k), part.row::<G>(numbers, k));
            let is_coming = (n_vertices..n_ids).contains(&vertex.index());
            if is_coming && !(vertices.is_some() && part == PointPart::Place) {
                memory::push(&mut coming, k)?;
            } else if vertices.is_none() && (!self.is_present(vertex) || self.staged.goes(vertex)) {
                continue;
            } else {
                self.inside.images.check(k, vertex, n_coming)?;
                listed.push((k, vertex));
            }
            let lattice = self.coming.as_ref().unwrap_or(&self.lattice);
            check_row(lattice, part, k, row)?;
        }
        let Self { staged, inside, lattice, wraps, .. } = self;
        let present = |vertex: VertexId| {
            let home = inside.images.home(vertex);
            lattice.unwrapped(&inside.places[home], &wraps[vertex])
        };
        let is_listed = vertices.is_some();
        staged.move_parts(part, n_vertices, &listed, |k| part.row::<G>(numbers, k), present).map_err(
            |error| match error {
                Error::DuplicateMove { index, vertex, .. } if !is_listed => {
                    Error::DuplicateMove { argument: part.argument(), index, vertex }
                }
                error => error,
            },
        )?;
        // Insertions are not taken back, so they come last.
        for k in coming {
            let index = vertex_at(k).index() - n_vertices;
            staged.set_part_of_insertion(index, part, part.row::<G>(numbers, k));
        }
        Ok(())
    }

    /// Makes these places and weights the next timestamp, one row for each id; what is not given stays, and what is staged to be
    /// inserted keeps the part that is not given, too. On an error no move is staged, and insertions are staged as before.
    ///
    /// # Errors
    /// [`Error::WrongCount`]; [`Error::DuplicateMove`] if moves are staged; otherwise those of
    /// [`commit_timestamp`](Self::commit_timestamp) and [`move_parts`](Self::move_parts).
    pub fn commit_parts(&mut self, places: Option<&[f64]>, weights: Option<&[f64]>) -> Result<CommitReport> {
        self.reject_prepared()?;
        if let Some(vertex) = self.staged.first_moving() {
            return Err(Error::DuplicateMove { argument: "positions", index: vertex.index(), vertex });
        }
        let n_ids = self.id_count();
        let parts = [(PointPart::Place, places), (PointPart::Weight, weights)];
        for (part, numbers) in parts.into_iter().filter_map(|(part, numbers)| Some((part, numbers?))) {
            let given = numbers.len() / part.width::<G>();
            if given != n_ids {
                let coming = self.staged.insertions().len();
                return Err(Error::WrongCount { argument: "count", given, wanted: n_ids, coming });
            }
        }
        let mut goals = Vec::new();
        memory::reserve_exact(&mut goals, n_ids)?;
        for k in 0..n_ids {
            let vertex = VertexId::at(k);
            // Entries of vertices that are gone are not read.
            let Some(mut goal) = self.position_or_goal(vertex) else {
                goals.push(G::Point::default());
                continue;
            };
            for (part, numbers) in parts.into_iter().filter_map(|(part, numbers)| Some((part, numbers?))) {
                let row = part.row::<G>(numbers, k);
                if !self.staged.goes(vertex) {
                    check_numbers::<G>(part.argument(), k, part, row)?;
                    set_part::<G>(&mut goal, part, row);
                }
            }
            goals.push(goal);
        }
        self.commit_positions(&goals)
    }

    /// Moves one vertex at once, and it keeps its weight; or gives it another weight, and it keeps its place.
    ///
    /// # Errors
    /// The errors of [`relocate_vertex`](Self::relocate_vertex).
    pub fn relocate_part(&mut self, part: PointPart, vertex: VertexId, numbers: &[f64]) -> Result<()> {
        let mut goal = self.position(vertex)?;
        set_part::<G>(&mut goal, part, numbers);
        self.relocate_vertex(vertex, &goal)
    }

    /// A staged goal with NaN for what is not staged.
    pub(super) fn staged_parts_of(&self, vertex: VertexId, goal: &G::Point) -> G::Point {
        let mut parts = *goal;
        let all = if G::HAS_WEIGHTS { &PointPart::BOTH[..] } else { &[] };
        for &part in all.iter().filter(|&&part| !self.staged.has_part(vertex, part)) {
            set_part::<G>(&mut parts, part, &[f64::NAN; 3][..part.width::<G>()]);
        }
        parts
    }
}

/// Checks a place, or a weight.
fn check_row<G: Moving>(lattice: &Lattice<G>, part: PointPart, index: usize, row: &[f64]) -> Result<()> {
    check_numbers::<G>(part.argument(), index, part, row)?;
    let mut point = G::Point::default();
    if part == PointPart::Place {
        set_part::<G>(&mut point, part, row);
        lattice.check(part.argument(), index, &point)?;
    }
    Ok(())
}
