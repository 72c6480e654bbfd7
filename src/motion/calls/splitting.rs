//! Segments that are in the way of each other, or that vertices are on, are split before a commit.
//!
//! ```text
//! while the check of what is staged finds conflicts
//!     a segment gets a cut at each vertex on it
//!     two that cross get one at an end of the other that they pass, or else both
//!         where they cross, rounded, at the vertex that is there or at a new one
//!     pieces are staged in the place of each segment that has a cut
//! ```
//!
//! # Why it ends
//!
//! Crossings are [rounded correctly](crate::predicates::crossing), and a segment [passes near](crate::predicates::passes_near) a vertex
//! if a place on it is rounded to that of the vertex. So cuts are at rounded places of a segment: they are in its box, and in
//! the order of both coordinates at once, and the boxes of pieces are those of a staircase in the box of the segment. Let the
//! *length* of a segment be how many numbers there are from one end to the other along the axes, both together. The pieces
//! have the lengths of their segments in all, and each has at least 1. Each round makes more pieces: a vertex on a segment is
//! at neither end, and a place that is an end of one of two segments that cross is at no end of the other. So the number of
//! pieces grows up to the lengths at most.
//!
//! The bound is out of reach. Cuts at ends that are passed keep the numbers small: otherwise chains that are nearly
//! one, as those of two segments that cross at an angle of last places, cross anew wherever they have been bent, and get ever
//! more vertices. So they are joined at the vertices that they have, as in snap rounding (Hobby,
//! 10.1016/S0925-7721(99)00021-8), where a segment goes through all vertices that it passes.
//!
//! # How far pieces are from their segment
//!
//! A cut at a vertex on it is on the segment. Another one is off by at most half a last place along each axis from where the pieces
//! are, and a piece is nowhere farther from its segment than at an end. So in r rounds a vertex comes to be off by r halves of
//! a last place of the greatest coordinates of the segment, at most, along each axis.
//!
//! # What it depends on
//!
//! All conflicts of a round are resolved at once, and places depend neither on the order of segments nor on their directions.
//! So where new vertices are, their ids, and which of them and of others pieces are between is a function of places, ids
//! of vertices and segments alone.
//!
//! Cost: a check for each round and one more, n log m for n vertices and m crossings, and sorting cuts.

use crate::delaunay::Plane;
use crate::error::{Conflict, Error, Result};
use crate::ids::{SegmentId, VertexId};
use crate::machine::memory;
use crate::motion::calls::keys::Coming;
use crate::motion::report::SplitReport;
use crate::motion::state::made::Origin;
use crate::motion::state::segments::Segment;
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates;

/// What was staged before.
struct StagedBefore {
    staged: Vec<Option<Segment>>,
    leaving: Vec<SegmentId>,
    n_insertions: usize,
    conflicts: Vec<Conflict>,
    first_vertex: VertexId,
    first_piece: SegmentId,
}

/// A piece that takes the place of a segment, with others.
#[derive(Clone, Copy)]
struct SegmentPiece {
    of: SegmentId,
    ends: [VertexId; 2],
}

/// A vertex at which a segment or a piece is cut.
#[derive(Clone, Copy)]
struct Cut {
    of: SegmentId,
    /// Coordinates with signs by which they ascend along the segment.
    along: [f64; 2],
    vertex: VertexId,
}

/// A segment that crosses another one, and the place where it is to be cut.
struct Crossed {
    of: SegmentId,
    place: [f64; 2],
}

fn compare(p: &[f64; 2], q: &[f64; 2]) -> std::cmp::Ordering {
    p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1]))
}

impl MovingTriangulation<Plane> {
    /// Resolves the conflicts of segments that a commit of what is staged would be refused for: a segment with a vertex on it
    /// is replaced by pieces, and two that cross get a vertex there, whose place is rounded correctly. Pieces have the marker
    /// and the direction of their segment, and know [where they come from](Self::original_segment). They are staged, and so are
    /// the new vertices, at most `limit` of them. A segment in force leaves with the commit; one that is staged is not made,
    /// and its id is not given again.
    ///
    /// Segments that overlap have common pieces, each with an id for each of them. A crossing that is rounded to the place of a
    /// vertex gets that one; where a segment crosses another one so near to an end of this that a place on it is rounded to that
    /// of the end, it is cut there. Passings are not looked at.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options, Segment}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let diagonals = [[0, 2], [1, 3]].map(|ends| Segment { ends: ends.map(VertexId::new), marker: 7, ..Segment::default() });
    /// let first = t.stage_segments(diagonals.into_iter())?;
    /// let report = t.stage_splits(1)?;
    /// assert_eq!((report.inserted, report.pieces), (1, 4));
    /// t.commit_timestamp()?;
    /// assert_eq!(t.position(report.first_vertex)?, [0.5, 0.5]);
    /// assert_eq!(t.original_segment(report.first_piece), first);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Conflict`] for an end that is removed or ends that meet; for a crossing, if more vertices than `limit` would
    /// be inserted: [the conflicts](Self::conflicts_of_segments) are those of what is staged. Others of
    /// [`check_staged`](Self::check_staged), [`Error::TooManyVertices`]. What was staged is so as before then.
    pub fn stage_splits(&mut self, limit: usize) -> Result<SplitReport> {
        let nothing = SplitReport {
            first_vertex: VertexId::at(self.id_count()),
            first_piece: SegmentId::at(self.mesh.segments.as_ref().map_or(0, |segments| segments.n_ids())),
            ..SplitReport::default()
        };
        self.mesh.last_found.begin();
        // A vertex that stops on a segment passes it, and is what it is to be split at.
        match self.check_conflicts() {
            Ok(()) => return Ok(nothing),
            Err(Error::Conflict { .. }) => {}
            Err(error) => return Err(error),
        }
        let before = self.before_splits(&nothing)?;
        let split = self.split_until_free(&before, limit, nothing);
        if let Err(error) = &split {
            let is_refused = matches!(error, Error::Conflict { .. });
            self.take_splits_back(before, is_refused);
        }
        split
    }

    /// Copies what is staged of segments.
    fn before_splits(&mut self, nothing: &SplitReport) -> Result<StagedBefore> {
        let n_insertions = self.staged_edits().0;
        let segments = memory::made(&mut self.mesh.segments)?;
        Ok(StagedBefore {
            staged: memory::copy_of(segments.staged())?,
            leaving: memory::copy_of(segments.leaving())?,
            n_insertions,
            conflicts: memory::copy_of(self.mesh.last_found.conflicts())?,
            first_vertex: nothing.first_vertex,
            first_piece: nothing.first_piece,
        })
    }

    /// Splits segments, and pieces, until there are no conflicts.
    ///
    /// What it calls beside the check is not inlined: exact numbers and sorts have kilobytes of memory on the stack, which is not
    /// to be there beside that of the check.
    fn split_until_free(
        &mut self,
        before: &StagedBefore,
        limit: usize,
        mut report: SplitReport,
    ) -> Result<SplitReport> {
        let mut pieces: Vec<SegmentPiece> = Vec::new();
        loop {
            let conflicts = memory::copy_of(self.conflicts_of_segments())?;
            if let Some(&conflict) = conflicts.iter().find(|conflict| !can_be_split(conflict)) {
                return Err(Error::Conflict { conflict, others: conflicts.len() - 1 });
            }
            let crossed = self.crossed(&conflicts)?;
            let mut vertices = self.vertices_at_crossings(&crossed)?;
            let mut places = Vec::new();
            let absent = vertices.iter().filter(|(_, v)| *v == VertexId::NONE);
            memory::collect(&mut places, absent.map(|&(place, _)| place))?;
            if places.len() > limit - report.inserted {
                let (conflict, others) = (before.conflicts[0], before.conflicts.len() - 1);
                return Err(Error::Conflict { conflict, others });
            }
            let first = self.stage_coming(&places, Coming::Made)?;
            let absent = vertices.iter_mut().filter(|(_, v)| *v == VertexId::NONE);
            VertexId::range(first.index()..first.index() + places.len())
                .zip(absent)
                .for_each(|(id, (_, v))| *v = id);
            report.inserted += places.len();
            report.rounds += 1;
            let cuts = self.cuts(&conflicts, &crossed, &vertices)?;
            pieces = self.divided(&pieces, &cuts, before.first_piece)?;
            report.replaced_segments = self.stage_pieces(before, &pieces)?;
            match self.check_conflicts() {
                Ok(()) => break,
                Err(Error::Conflict { .. }) => {}
                Err(error) => return Err(error),
            }
        }
        report.pieces = pieces.len();
        self.note_origins(before, &pieces)?;
        Ok(report)
    }

    /// Where a vertex will be, if it will be there.
    fn place_after(&self, v: VertexId) -> Option<[f64; 2]> {
        if self.edits.is_removal_staged(v) {
            None
        } else if self.staging.is_staged(v) {
            Some(*self.staging.goal(v))
        } else if let Some(s) = self.mesh.site(v) {
            Some(self.mesh.kernel.site(s).point)
        } else {
            self.edits.insertion(v).copied()
        }
    }

    /// The vertices between which a segment is, in force or staged, and their places.
    fn ends_after(&self, segment: SegmentId) -> ([VertexId; 2], [[f64; 2]; 2]) {
        let segments = self.mesh.segments.as_ref();
        let found = segments.and_then(|segments| segments.enforced_or_staged(segment));
        let ends = found.expect("a segment with a conflict").ends;
        (ends, ends.map(|v| self.place_after(v).expect("a segment that has its ends")))
    }

    /// Where segments that cross are to be cut: at ends of the other one that they pass, or both where they cross.
    #[inline(never)]
    fn crossed(&self, conflicts: &[Conflict]) -> Result<Vec<Crossed>> {
        let mut crossed = Vec::new();
        for conflict in conflicts {
            let Conflict::Crossing { segments } = *conflict else { continue };
            let ends = segments.map(|segment| self.ends_after(segment).1);
            let n_before = crossed.len();
            for (k, of) in segments.into_iter().enumerate() {
                let [a, b] = &ends[k];
                for place in ends[1 - k].into_iter().filter(|p| predicates::passes_near([a, b], p)) {
                    memory::push(&mut crossed, Crossed { of, place })?;
                }
            }
            if crossed.len() == n_before {
                let [[a, b], [c, d]] = &ends;
                let place = predicates::crossing([a, b, c, d]);
                memory::collect(&mut crossed, segments.into_iter().map(|of| Crossed { of, place }))?;
            }
        }
        Ok(crossed)
    }

    /// The places at which segments are to be cut where they cross, sorted, with the lowest vertex that will be there;
    /// [`VertexId::NONE`] if none will.
    #[inline(never)]
    fn vertices_at_crossings(&self, crossed: &[Crossed]) -> Result<Vec<([f64; 2], VertexId)>> {
        let mut vertices = Vec::new();
        memory::collect(&mut vertices, crossed.iter().map(|crossed| (crossed.place, VertexId::NONE)))?;
        vertices.sort_unstable_by(|(p, _), (q, _)| compare(p, q));
        vertices.dedup_by_key(|(p, _)| *p);
        let n_ids = if vertices.is_empty() { 0 } else { self.id_count() };
        for v in VertexId::range(0..n_ids) {
            let Some(place) = self.place_after(v) else { continue };
            if let Ok(k) = vertices.binary_search_by(|(p, _)| compare(p, &place)) {
                vertices[k].1 = vertices[k].1.min(v);
            }
        }
        Ok(vertices)
    }

    /// Where segments and pieces have to be cut, in their order, and along each of them.
    #[inline(never)]
    fn cuts(
        &self,
        conflicts: &[Conflict],
        crossed: &[Crossed],
        vertices: &[([f64; 2], VertexId)],
    ) -> Result<Vec<Cut>> {
        let cut = |of: SegmentId, place: [f64; 2], vertex: VertexId| {
            let (_, [from, to]) = self.ends_after(of);
            let along = [0, 1].map(|k| if to[k] < from[k] { -place[k] } else { place[k] });
            (place != from && place != to).then_some(Cut { of, along, vertex })
        };
        let mut cuts = Vec::new();
        for conflict in conflicts {
            let Conflict::OnSegment { segment, vertex } = *conflict else { continue };
            let place = self.place_after(vertex).expect("a vertex on a segment");
            memory::collect(&mut cuts, cut(segment, place, vertex).into_iter())?;
        }
        for &Crossed { of, place } in crossed {
            let at = vertices.binary_search_by(|(p, _)| compare(p, &place)).expect("it is listed");
            memory::collect(&mut cuts, cut(of, place, vertices[at].1).into_iter())?;
        }
        cuts.sort_unstable_by(|a: &Cut, b| a.of.cmp(&b.of).then_with(|| compare(&a.along, &b.along)));
        cuts.dedup_by_key(|cut| (cut.of, cut.along));
        Ok(cuts)
    }

    /// All pieces after these cuts of segments, whose ids are below `first`, and of pieces, whose ids are those from it on.
    #[inline(never)]
    fn divided(&self, pieces: &[SegmentPiece], cuts: &[Cut], first: SegmentId) -> Result<Vec<SegmentPiece>> {
        let mut divided = Vec::new();
        let mut divide = |SegmentPiece { of, ends: [mut from, to] }: SegmentPiece, cuts: &[Cut]| {
            for &Cut { vertex, .. } in cuts {
                memory::push(&mut divided, SegmentPiece { of, ends: [from, vertex] })?;
                from = vertex;
            }
            memory::push(&mut divided, SegmentPiece { of, ends: [from, to] })
        };
        let (of_segments, mut of_pieces) = cuts.split_at(cuts.partition_point(|cut| cut.of < first));
        let mut of_segments = of_segments.chunk_by(|a, b| a.of == b.of).peekable();
        let whole = |of: SegmentId| SegmentPiece { of, ends: self.ends_after(of).0 };
        for (id, &piece) in SegmentId::range(first.index()..first.index() + pieces.len()).zip(pieces) {
            while let Some(cuts) = of_segments.next_if(|cuts| cuts[0].of < piece.of) {
                divide(whole(cuts[0].of), cuts)?;
            }
            let (cuts, others) = of_pieces.split_at(of_pieces.partition_point(|cut| cut.of == id));
            divide(piece, cuts)?;
            of_pieces = others;
        }
        for cuts in of_segments {
            divide(whole(cuts[0].of), cuts)?;
        }
        Ok(divided)
    }

    /// Stages what was staged before, and pieces in the place of their segments; returns of how many.
    #[inline(never)]
    fn stage_pieces(&mut self, before: &StagedBefore, pieces: &[SegmentPiece]) -> Result<usize> {
        let segments = memory::made(&mut self.mesh.segments)?;
        segments.restore_staged(&before.staged, &before.leaving);
        let mut n_replaced = 0;
        for pieces in pieces.chunk_by(|a, b| a.of == b.of) {
            let whole = segments.take_out(pieces[0].of)?;
            segments.stage(pieces.iter().map(|piece| Segment { ends: piece.ends, ..whole }))?;
            n_replaced += 1;
        }
        Ok(n_replaced)
    }

    /// Notes where pieces come from, for when they are made.
    #[inline(never)]
    fn note_origins(&mut self, before: &StagedBefore, pieces: &[SegmentPiece]) -> Result<()> {
        let made = memory::made(&mut self.made)?;
        made.reserve_staged(pieces.len())?;
        let segments = self.mesh.segments.as_ref().expect("there are pieces");
        let mut ids = SegmentId::range(before.first_piece.index()..segments.n_ids());
        for pieces in pieces.chunk_by(|a, b| a.of == b.of) {
            let segment = pieces[0].of;
            let last = pieces.len() - 1;
            let own = || Origin { segment, ends: [pieces[0].ends[0], pieces[last].ends[1]] };
            let origin = made.origin_with_staged(segment).unwrap_or_else(own);
            for (k, (piece, id)) in pieces.iter().zip(&mut ids).enumerate() {
                // Where it is cut, other segments may meet it at any angle.
                let start = if k == 0 { origin.ends[0] } else { piece.ends[0] };
                let end = if k == last { origin.ends[1] } else { piece.ends[1] };
                made.enter_staged(id, Origin { segment: origin.segment, ends: [start, end] });
            }
        }
        Ok(())
    }

    /// Puts what was staged back. Needs no memory.
    fn take_splits_back(&mut self, before: StagedBefore, is_refused: bool) {
        if let Some(segments) = &mut self.mesh.segments {
            segments.restore_staged(&before.staged, &before.leaving);
        }
        self.mesh.last_found.report_conflicts(if is_refused { before.conflicts } else { Vec::new() });
        self.edits.truncate_insertions(before.n_insertions);
        self.mesh.site_of.truncate(before.first_vertex.index());
        self.mesh.kernel.keys_mut().truncate(before.first_vertex.index());
        self.staging.shrink(before.first_vertex.index());
    }
}

/// Whether splitting resolves a conflict.
fn can_be_split(conflict: &Conflict) -> bool {
    matches!(conflict, Conflict::Crossing { .. } | Conflict::OnSegment { .. })
}
