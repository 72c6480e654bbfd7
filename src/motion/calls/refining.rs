//! Refinement and coarsening of the cells of a domain, each in one commit of its own.
//!
//! What is to be done is found on a copy of the cells ([`refine`](crate::refine)), and only if a first look at all selected
//! cells finds something bad. Then vertices, and pieces of segments in the place of these, are staged and committed.

use crate::delaunay::Plane;
use crate::error::{Error, Result};
use crate::ids::{CellId, SegmentId, VertexId};
use crate::machine::memory;
use crate::motion::options::{CoarsenOptions, MAX_LEAST_ANGLE, Quality, RefineOptions};
use crate::motion::report::QualityReport;
use crate::motion::state::made::Origin;
use crate::motion::state::mesh::Standing;
use crate::motion::state::segments::Segment;
use crate::motion::triangulation::MovingTriangulation;
use crate::refine::{self, Candidate, Criteria, Given, NONE, NOT_SELECTED, Origins, Room, Tests};

/// The cells, and the segments at their edges, as refinement reads them.
struct Copied {
    points: Vec<[f64; 2]>,
    /// Segments by edge, the lower end first; sorted.
    by_edge: Vec<([VertexId; 2], SegmentId)>,
    /// Where those of each edge begin, and in the end how many there are.
    starts: Vec<usize>,
    /// The ends of each edge, in the direction of its segment of the lowest id.
    edges: Vec<[VertexId; 2]>,
    sides: Vec<[u32; 3]>,
    labels: Vec<u32>,
    extent: f64,
}

impl Copied {
    /// The segments at an edge.
    fn segments_at(&self, edge: usize) -> &[([VertexId; 2], SegmentId)] {
        &self.by_edge[self.starts[edge]..self.starts[edge + 1]]
    }

    fn given<'a>(&'a self, corners: &'a [[VertexId; 3]], neighbours: &'a [[CellId; 3]]) -> Given<'a> {
        Given {
            points: &self.points,
            corners,
            neighbours,
            sides: &self.sides,
            labels: &self.labels,
            segments: &self.edges,
        }
    }
}

impl MovingTriangulation<Plane> {
    /// Inserts vertices, in cells that `mask` selects by numbers other than 0 and on segments at them, until the cells there
    /// are of the quality asked for: one commit of its own, all or nothing. The cells selected have to end at segments.
    ///
    /// A segment that gets a vertex is removed, and pieces take its place, with its marker. The places of new vertices are
    /// rounded; the pieces are straight between their own ends.
    ///
    /// Cells where the quality cannot be had stay: between segments at a small angle, at segments that stay whole, and where
    /// there is no room for a vertex. The report tells how many.
    ///
    /// Where all is good already: a pass over the cells, and a sort of the segments.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options, Quality, RefineOptions, Segment}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let side = |k: u32| Segment { ends: [k, (k + 1) % 4].map(VertexId::new), marker: 0 };
    /// t.stage_segments((0..4).map(side))?;
    /// t.commit_timestamp()?;
    /// let quality = Quality { least_angle: 30.0, greatest_area: 0.01, ..Quality::default() };
    /// let report = t.refine(&quality, &RefineOptions::default(), &[1, 1])?;
    /// assert!(t.cell_count() >= 100 && report.bad_cells == 0);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Staged`] if anything is staged; [`Error::InvalidValue`] for a quality that has no meaning or cannot be had,
    /// and for a selected cell at an edge beyond which none is selected and that is no segment; [`Error::WrongCount`];
    /// those of [`commit_timestamp`](Self::commit_timestamp).
    pub fn refine(
        &mut self,
        quality: &Quality,
        options: &RefineOptions,
        mask: &[u8],
    ) -> Result<QualityReport> {
        self.check_quality(quality, mask)?;
        let copied = self.copy_for_refinement(quality, mask)?;
        let areas = none_where_zero(quality.areas)?;
        let mut tests = Tests::new(criteria(quality, &areas), copied.extent);
        if let Some(made) = &mut self.made {
            made.set_weights(Vec::new(), 0);
        }
        let mut report =
            QualityReport { bad_cells: self.count_bad(quality, &tests, &copied)?, ..Default::default() };
        if report.bad_cells == 0 || tests.are_none() {
            return Ok(report);
        }
        let sizes = self.sizes_of_ids(quality)?;
        tests = Tests::new(Criteria { sizes: &sizes, ..criteria(quality, &areas) }, copied.extent);
        let (ends, of_segments, of_vertices) = self.origins(&copied)?;
        let cells = self.cells()?;
        let given = copied.given(cells.corners, cells.neighbours);
        let origins = Origins { ends: &ends, of_segments: &of_segments, of_vertices: &of_vertices };
        let refined = refine::refine(&given, tests, origins, options.keeps, options.limit)?;
        report.inserted = refined.vertices.len();
        report.on_segments = refined.vertices.iter().filter(|(_, segment)| *segment != NONE).count();
        report.unsplit = refined.n_unsplit;
        report.is_cut_short = refined.is_cut_short;
        report.bad_cells = refined.n_bad;
        if report.inserted == 0 {
            return Ok(report);
        }
        let mut changes = SegmentChanges::default();
        let mut start = 0;
        for &(edge, end) in &refined.split {
            let chain = &refined.chain[start..end];
            for pair in chain.windows(2) {
                self.replace_at(&copied, edge, [pair[0], pair[1]], &mut changes)?;
            }
            changes.leave(copied.segments_at(edge as usize))?;
            start = end;
        }
        let mut points = Vec::new();
        memory::collect(&mut points, refined.vertices.iter().map(|&(p, _)| p))?;
        let on = |edge: u32| match edge {
            NONE => SegmentId::NONE,
            edge => self.origin_of(copied.segments_at(edge as usize)[0].1).segment,
        };
        let mut on_segments = Vec::new();
        memory::collect(&mut on_segments, refined.vertices.iter().map(|&(_, edge)| on(edge)))?;
        let edges =
            refined.vertices.iter().map(|&(_, edge)| (edge != NONE).then(|| copied.edges[edge as usize]));
        let weights = if options.has_weights { self.weights_of(&points, edges)? } else { Vec::new() };
        self.commit_quality(&points, &on_segments, &[], changes, &mut report)?;
        let timestamp = self.timestamp();
        self.made.as_mut().expect("it has been made").set_weights(weights, timestamp);
        Ok(report)
    }

    /// Removes vertices that [`refine`](Self::refine) has added and that are not needed any more: those around which the
    /// cells would still be of the quality asked for, by a margin, in the cells that `mask` selects. Pieces of a
    /// segment are joined again. One commit of its own, all or nothing.
    ///
    /// Around cells that are of lower quality already, those that come may have angles as small: what `refine` then mends
    /// has fewer vertices than if it were called first.
    ///
    /// Cost: a pass over the cells, and for each vertex added that of looking at a hole of its size.
    ///
    /// # Errors
    /// Those of [`refine`](Self::refine).
    pub fn coarsen(
        &mut self,
        quality: &Quality,
        options: &CoarsenOptions,
        mask: &[u8],
    ) -> Result<QualityReport> {
        self.check_quality(quality, mask)?;
        check_coarsening(options)?;
        let mut report = QualityReport::default();
        if self.made.as_ref().is_none_or(|made| made.vertices().is_empty()) {
            return Ok(report);
        }
        let copied = self.copy_for_refinement(quality, mask)?;
        let areas = none_where_zero(quality.areas)?;
        let sizes = self.sizes_of_ids(quality)?;
        let tests = Tests::new(Criteria { sizes: &sizes, ..criteria(quality, &areas) }, copied.extent);
        let candidates = self.candidates(&copied)?;
        let cells = self.cells()?;
        let given = copied.given(cells.corners, cells.neighbours);
        let room = Room { angle: options.margin, share: options.share, offset: options.joins };
        let coarsened = refine::coarsen(&given, tests, room, &candidates)?;
        report.removed = coarsened.vertices.len();
        if report.removed == 0 {
            return Ok(report);
        }
        let mut changes = SegmentChanges::default();
        for &(edge, ends) in &coarsened.joined {
            self.replace_at(&copied, edge, ends, &mut changes)?;
        }
        for &edge in &coarsened.replaced {
            changes.leave(copied.segments_at(edge as usize))?;
        }
        self.commit_quality(&[], &[], &coarsened.vertices, changes, &mut report)?;
        Ok(report)
    }

    /// The vertices that [`refine`](Self::refine) has added and that are there, ascending, each with the segment that it
    /// was put on, [`SegmentId::NONE`] if there is none. Neither this nor where pieces come from is saved in files.
    pub fn made_vertices(&self) -> impl Iterator<Item = (VertexId, SegmentId)> {
        let all = self.made.iter().flat_map(|made| made.vertices());
        all.copied().filter(|&(v, _)| self.mesh.is_present(v))
    }

    /// The segment of which refinement has made this one a piece; the segment itself if it has not.
    pub fn original_segment(&self, segment: SegmentId) -> SegmentId {
        self.made.as_ref().and_then(|made| made.origin(segment)).map_or(segment, |origin| origin.segment)
    }

    /// Where a segment that is in force comes from.
    fn origin_of(&self, segment: SegmentId) -> Origin {
        let found = self.made.as_ref().and_then(|made| made.origin(segment));
        found.unwrap_or_else(|| Origin { segment, ends: self.segment_in_force(segment).ends })
    }

    fn segment_in_force(&self, segment: SegmentId) -> Segment {
        let segments = self.mesh.segments.as_ref().expect("there is one");
        segments.get(segment).expect("it is in force")
    }

    /// Whether a call can be made with these arguments.
    fn check_quality(&self, quality: &Quality, mask: &[u8]) -> Result<()> {
        let segments =
            self.mesh.segments.as_ref().map_or(0, |s| s.all().len() - s.n_laid() + s.leaving().len());
        let (moves, (coming, leaving)) = (self.staged_count(), self.staged_edits());
        if moves + coming + leaving + segments > 0 {
            return Err(Error::Staged { moves, edits: coming + leaving, segments });
        }
        let n = self.cell_count();
        let lengths = [
            ("mask", Some(mask.len()), n),
            ("labels", quality.labels.map(<[u32]>::len), n),
            ("sizes", quality.sizes.map(<[f64]>::len), self.id_count()),
        ];
        for (argument, given, wanted) in lengths {
            if let Some(given) = given.filter(|&given| given != wanted) {
                return Err(Error::WrongCount { argument, given, wanted, coming: 0 });
            }
        }
        let value = quality.least_angle;
        if !(0.0..=MAX_LEAST_ANGLE).contains(&value) {
            let wanted = "from 0 to 34 degrees";
            return Err(Error::InvalidValue { argument: "least_angle", index: 0, value, wanted });
        }
        check_all("greatest_area", &[quality.greatest_area], |x| x >= 0.0, "0 or more")?;
        check_all("areas", quality.areas, |x| x >= 0.0, "0 or more")?;
        check_all("sizes", quality.sizes.unwrap_or_default(), |x| x > 0.0, "above 0")
    }

    /// Copies what refinement reads, but for the cells themselves, and checks that those selected end at segments.
    fn copy_for_refinement(&self, quality: &Quality, mask: &[u8]) -> Result<Copied> {
        let mut points = Vec::new();
        memory::lengthen(&mut points, self.id_count(), [0.0; 2])?;
        let (mut lower, mut upper) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for (v, standing) in self.mesh.standings() {
            let (Standing::Shown(s) | Standing::Hidden(s)) = standing else { continue };
            points[v] = self.mesh.kernel.site(s).point;
            for axis in 0..2 {
                lower[axis] = lower[axis].min(points[v][axis]);
                upper[axis] = upper[axis].max(points[v][axis]);
            }
        }
        let mut copied = Copied {
            points,
            by_edge: Vec::new(),
            starts: Vec::new(),
            edges: Vec::new(),
            sides: Vec::new(),
            labels: Vec::new(),
            extent: (upper[0] - lower[0]).max(upper[1] - lower[1]),
        };
        self.list_edges(&mut copied)?;
        memory::collect(
            &mut copied.labels,
            mask.iter().enumerate().map(|(c, &selected)| match quality.labels {
                _ if selected == 0 => NOT_SELECTED,
                Some(labels) => labels[c].min(NOT_SELECTED - 1),
                None => 0,
            }),
        )?;
        self.find_sides(&mut copied, mask)?;
        Ok(copied)
    }

    /// Lists the segments by edge.
    fn list_edges(&self, copied: &mut Copied) -> Result<()> {
        let shown = |v: VertexId| self.mesh.kernel.site(self.mesh.site_of[v]).id;
        let Copied { by_edge, starts, edges, .. } = copied;
        memory::collect(
            by_edge,
            self.segments().map(|(id, segment)| {
                let [v, w] = segment.ends.map(shown);
                ([v.min(w), v.max(w)], id)
            }),
        )?;
        by_edge.sort_unstable();
        for k in 0..by_edge.len() {
            if k == 0 || by_edge[k - 1].0 != by_edge[k].0 {
                memory::push(starts, k)?;
                memory::push(edges, self.segment_in_force(by_edge[k].1).ends.map(shown))?;
            }
        }
        memory::push(starts, by_edge.len())
    }

    /// Finds the segments at the edges of cells.
    fn find_sides(&self, copied: &mut Copied, mask: &[u8]) -> Result<()> {
        let cells = self.cells()?;
        let Copied { by_edge, starts, edges, sides, .. } = copied;
        // Most edges are none of an end, and are not looked for.
        let mut is_end = Vec::new();
        memory::lengthen(&mut is_end, self.id_count(), false)?;
        edges.iter().flatten().for_each(|&v| is_end[v] = true);
        memory::reserve_exact(sides, cells.corners.len())?;
        for (c, row) in cells.corners.iter().enumerate() {
            let mut found = [NONE; 3];
            for (i, [j, k]) in [[1, 2], [2, 0], [0, 1]].into_iter().enumerate() {
                let [v, w] = [row[j], row[k]];
                if is_end[v] && is_end[w] {
                    let edge = [v.min(w), v.max(w)];
                    let at = starts[..edges.len()].binary_search_by_key(&edge, |&start| by_edge[start].0);
                    found[i] = at.map_or(NONE, |at| at as u32);
                }
                let beyond = cells.neighbours[c][i];
                let ends = beyond == CellId::NONE || mask[beyond.index()] == 0;
                if mask[c] != 0 && ends && found[i] == NONE {
                    let wanted =
                        "0, as the cell has an edge that is no segment and beyond which no cell is selected";
                    let value = f64::from(mask[c]);
                    return Err(Error::InvalidValue { argument: "mask", index: c, value, wanted });
                }
            }
            sides.push(found);
        }
        Ok(())
    }

    /// Counts the selected cells that are bad, or have an encroached segment.
    fn count_bad(&self, quality: &Quality, tests: &Tests, copied: &Copied) -> Result<usize> {
        let sizes = quality.sizes.unwrap_or_default();
        let corners = self.cells()?.corners;
        let is_bad = |c: &usize| {
            let (row, label) = (corners[*c], copied.labels[*c]);
            if label == NOT_SELECTED {
                return false;
            }
            let points = row.map(|v| &copied.points[v]);
            tests.measure(points, label, |i| sizes[row[i]]).flaw.is_some()
                || copied.sides[*c] != [NONE; 3]
                    && [[1, 2], [2, 0], [0, 1]].iter().enumerate().any(|(i, &[j, k])| {
                        copied.sides[*c][i] != NONE && tests.is_in_lens([points[j], points[k]], points[i])
                    })
        };
        Ok((0..corners.len()).filter(is_bad).count())
    }

    /// The sizes given, which new vertices will follow.
    fn sizes_of_ids(&self, quality: &Quality) -> Result<Vec<f64>> {
        memory::copy_of(quality.sizes.unwrap_or_default())
    }

    /// The original of each edge that is a segment, by its ends, and those of vertices that have been added.
    #[allow(clippy::type_complexity)]
    fn origins(&self, copied: &Copied) -> Result<(Vec<[VertexId; 2]>, Vec<u32>, Vec<(VertexId, u32)>)> {
        let mut origins = Vec::new();
        memory::collect(
            &mut origins,
            (0..copied.edges.len()).map(|edge| {
                let origin = self.origin_of(copied.segments_at(edge)[0].1);
                (origin.segment, origin.ends)
            }),
        )?;
        let mut sorted = memory::copy_of(&origins)?;
        sorted.sort_unstable();
        sorted.dedup_by_key(|&mut (segment, _)| segment);
        let place = |segment: SegmentId| sorted.binary_search_by_key(&segment, |&(other, _)| other).ok();
        let mut of_segments = Vec::new();
        memory::collect(
            &mut of_segments,
            origins.iter().map(|&(segment, _)| place(segment).expect("it is listed") as u32),
        )?;
        let mut of_vertices = Vec::new();
        memory::collect(
            &mut of_vertices,
            self.made_vertices().filter_map(|(v, segment)| Some((v, place(segment)? as u32))),
        )?;
        let mut ends = Vec::new();
        memory::collect(&mut ends, sorted.iter().map(|&(_, ends)| ends))?;
        Ok((ends, of_segments, of_vertices))
    }

    /// The vertices that may go.
    fn candidates(&self, copied: &Copied) -> Result<Vec<Candidate>> {
        let n = self.id_count();
        let (mut before, mut behind) = (Vec::new(), Vec::new());
        memory::lengthen(&mut before, n, NONE)?;
        memory::lengthen(&mut behind, n, NONE)?;
        for (edge, &[v, w]) in (0..).zip(&copied.edges) {
            before[w] = edge;
            behind[v] = edge;
        }
        let mut candidates = Vec::new();
        for (vertex, on) in self.made_vertices() {
            let Standing::Shown(s) = self.mesh.standing(vertex) else { continue };
            if self.mesh.is_shared(s) {
                continue;
            }
            let pieces = [before[vertex], behind[vertex]];
            if on == SegmentId::NONE {
                memory::push(&mut candidates, Candidate { vertex, between: None })?;
            } else if !pieces.contains(&NONE) && self.are_of_one_origin(copied, pieces) {
                memory::push(&mut candidates, Candidate { vertex, between: Some(pieces) })?;
            }
        }
        Ok(candidates)
    }

    /// Whether the segments at two edges come from the same ones.
    fn are_of_one_origin(&self, copied: &Copied, edges: [u32; 2]) -> bool {
        let [one, other] = edges.map(|edge| copied.segments_at(edge as usize));
        let origin = |&(_, segment): &(_, SegmentId)| self.original_segment(segment);
        one.len() == other.len() && one.iter().all(|a| other.iter().any(|b| origin(a) == origin(b)))
    }

    /// Enters a segment between two vertices in the direction of an edge, for each segment at it.
    fn replace_at(
        &self,
        copied: &Copied,
        edge: u32,
        [v, w]: [VertexId; 2],
        changes: &mut SegmentChanges,
    ) -> Result<()> {
        let shown = |v: VertexId| self.mesh.kernel.site(self.mesh.site_of[v]).id;
        let start = copied.edges[edge as usize][0];
        for &(_, id) in copied.segments_at(edge as usize) {
            let segment = self.segment_in_force(id);
            let ends = if shown(segment.ends[0]) == start { [v, w] } else { [w, v] };
            // A vertex that shares its place stays the end that it was.
            let ends = ends.map(|v| segment.ends.into_iter().find(|&end| shown(end) == v).unwrap_or(v));
            let marker = segment.marker;
            memory::push(&mut changes.coming, (Segment { ends, marker }, self.origin_of(id)))?;
        }
        Ok(())
    }

    /// Makes all changes in a commit, and remembers them.
    fn commit_quality(
        &mut self,
        points: &[[f64; 2]],
        on_segments: &[SegmentId],
        removed: &[VertexId],
        changes: SegmentChanges,
        report: &mut QualityReport,
    ) -> Result<()> {
        memory::made(&mut self.made)?.reserve(points.len(), changes.coming.len())?;
        let done = self.stage_quality(points, removed, &changes).and_then(|ids| {
            self.commit_timestamp()?;
            Ok(ids)
        });
        let (first_vertex, first_segment) = match done {
            Ok(ids) => ids,
            Err(error) => {
                self.discard_moves();
                return Err(error);
            }
        };
        let made = self.made.as_mut().expect("it has been made");
        for (v, &on) in VertexId::range(first_vertex.index()..self.mesh.site_of.len()).zip(on_segments) {
            made.enter_vertex(v, on);
        }
        let n_coming = changes.coming.len();
        let ids = SegmentId::range(first_segment.index()..first_segment.index() + n_coming);
        for (id, &(_, origin)) in ids.zip(&changes.coming) {
            made.enter_piece(id, origin);
        }
        let (mesh, segments) = (&self.mesh, &self.mesh.segments);
        made.keep(
            |v| mesh.is_present(v),
            |piece| segments.as_ref().is_some_and(|segments| segments.get(piece).is_some()),
        );
        (report.replaced_segments, report.new_segments) = (changes.leaving.len(), n_coming);
        Ok(())
    }

    /// Stages all changes; returns the ids of the first vertex and segment that will come.
    fn stage_quality(
        &mut self,
        points: &[[f64; 2]],
        removed: &[VertexId],
        changes: &SegmentChanges,
    ) -> Result<(VertexId, SegmentId)> {
        let first_vertex = self.stage_insertions(points)?;
        self.stage_removals(removed)?;
        let first_segment = self.stage_segments(changes.coming.iter().map(|&(segment, _)| segment))?;
        let segments = memory::made(&mut self.mesh.segments)?;
        changes.leaving.iter().try_for_each(|&segment| segments.stage_removal(segment))?;
        Ok((first_vertex, first_segment))
    }
}

/// Segments that come and go.
#[derive(Debug, Default)]
struct SegmentChanges {
    coming: Vec<(Segment, Origin)>,
    leaving: Vec<SegmentId>,
}

impl SegmentChanges {
    fn leave(&mut self, segments: &[([VertexId; 2], SegmentId)]) -> Result<()> {
        memory::collect(&mut self.leaving, segments.iter().map(|&(_, id)| id))
    }
}

/// The criteria of a quality.
fn criteria<'a>(quality: &Quality<'a>, areas: &'a [f64]) -> Criteria<'a> {
    Criteria {
        least_angle: quality.least_angle,
        greatest_area: if quality.greatest_area == 0.0 { f64::INFINITY } else { quality.greatest_area },
        areas,
        sizes: quality.sizes.unwrap_or_default(),
        is_too_large: quality.is_too_large,
    }
}

/// Bounds in which 0 stands for none, as what no area exceeds.
fn none_where_zero(areas: &[f64]) -> Result<Vec<f64>> {
    let mut bounds = Vec::new();
    memory::collect(&mut bounds, areas.iter().map(|&x| if x == 0.0 { f64::INFINITY } else { x }))?;
    Ok(bounds)
}

fn check_all(
    argument: &'static str,
    values: &[f64],
    is_good: impl Fn(f64) -> bool,
    wanted: &'static str,
) -> Result<()> {
    match values.iter().position(|&value| !is_good(value)) {
        Some(index) => Err(Error::InvalidValue { argument, index, value: values[index], wanted }),
        None => Ok(()),
    }
}

fn check_coarsening(options: &CoarsenOptions) -> Result<()> {
    check_all("margin", &[options.margin], |x| (0.0..=30.0).contains(&x), "from 0 to 30 degrees")?;
    check_all("share", &[options.share], |x| x > 0.0 && x <= 1.0, "above 0 and up to 1")?;
    check_all("joins", &[options.joins], |x| (0.0..=1.0).contains(&x), "from 0 to 1")
}
