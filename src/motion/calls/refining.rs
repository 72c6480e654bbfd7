//! Refinement and coarsening of the cells of a domain, each in one commit of its own.
//!
//! A pass over the cells finds those that are bad, and the vertices that may have become superfluous: of cells that
//! are as at the last call it is known ([`looked`](crate::motion::state::looked)). What is to be done there is found
//! on copies of the cells that are entered alone ([`refine`](crate::refine)). Then vertices, and pieces of segments in
//! the place of these, are staged and committed.

mod checks;
mod origins;
mod reading;
mod remeshing;
mod staging;
#[cfg(test)]
mod tests;

use crate::delaunay::{Keys, Plane};
use crate::error::Result;
use crate::ids::{CellId, SegmentId, VertexId};
use crate::machine::memory;
use crate::motion::options::{CoarsenOptions, Quality, RefineOptions};
use crate::motion::report::QualityReport;
use crate::motion::state::density::Due;
use crate::motion::state::looked::{Looked, Question, ScaledPlaces};
use crate::motion::state::made::{Inserted, Origin};
use crate::motion::state::segments::Segment;
use crate::motion::triangulation::MovingTriangulation;
use crate::refine::{self, Candidate, Criteria, LeftBad, NONE, Refined, Room, Tests};
use reading::Read;
use staging::SegmentChanges;

impl MovingTriangulation<Plane> {
    /// Inserts vertices, in cells that `mask` selects by numbers other than 0 and on segments at them, until the cells there
    /// are of the quality asked for: one commit of its own, all or nothing. The cells selected have to end at segments.
    ///
    /// A segment that gets a vertex is removed, and pieces take its place, with its marker. The places of new vertices are
    /// rounded; the pieces are straight between their own ends.
    ///
    /// Cells where the quality cannot be had stay: between segments at a small angle, at segments that stay whole, and where
    /// there is no room for a vertex. So do those in narrow gaps: between nearly parallel segments, less wide than
    /// 1 / 8,192 of the shorter one. The report tells how many.
    ///
    /// After a [`coarsen`](Self::coarsen) it may make the mesh anew, in its one commit, where that has fewer vertices by the
    /// factor [`growth`](CoarsenOptions::growth): then it removes vertices that it has made, too, and weights tell how values
    /// follow from those that there were. The report tells how many have gone.
    ///
    /// Where all is good already: a comparison of the cells with those of the last call, tests of those that are
    /// others, and a sort of the segments.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options, Quality, RefineOptions, Segment}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// let side = |k: u32| Segment { ends: [k, (k + 1) % 4].map(VertexId::new), marker: 0, ..Segment::default() };
    /// t.stage_segments((0..4).map(side))?;
    /// t.commit_timestamp()?;
    /// let quality = Quality { least_angle: 30.0, greatest_area: 0.01, ..Quality::default() };
    /// let report = t.refine(&quality, &RefineOptions::default(), &[1, 1])?;
    /// assert!(t.cell_count() >= 100 && report.bad_cells == 0);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Staged`](crate::Error::Staged) if anything is staged; [`Error::InvalidValue`](crate::Error::InvalidValue) for a
    /// quality that has no meaning or cannot be had, and for a selected cell at an edge beyond which none is selected and that
    /// is no segment; [`Error::WrongCount`](crate::Error::WrongCount); those of
    /// [`commit_timestamp`](Self::commit_timestamp).
    pub fn refine(
        &mut self,
        quality: &Quality,
        options: &RefineOptions,
        mask: &[u8],
    ) -> Result<QualityReport> {
        self.reject_prepared()?;
        self.mesh.last_found.begin();
        self.check_quality(quality, mask)?;
        if !options.reuses_ids || self.has_keys() {
            return self.refine_checked(quality, options, mask);
        }
        // With keys the cells that will be are foreseen without the ids that vertices will have.
        let n_ids = self.id_count();
        self.mesh.kernel.keys_mut().reserve(n_ids)?;
        let before = self.statistics.timestamp;
        let done = self.refine_checked(quality, options, mask);
        if self.statistics.timestamp == before {
            *self.mesh.kernel.keys_mut() = Keys::default();
        }
        done
    }

    /// Refines, with keys if ids are given again.
    fn refine_checked(
        &mut self,
        quality: &Quality,
        options: &RefineOptions,
        mask: &[u8],
    ) -> Result<QualityReport> {
        let asked = asked(quality)?;
        let question = self.question(&asked, quality, mask);
        let made = self.made.as_ref().filter(|_| quality.sizes.is_none());
        let due = made.and_then(|made| made.density.due());
        if !due.is_some_and(|due| due.is_certain)
            && self.made.as_ref().is_some_and(|made| made.found.all_good.holds(question))
        {
            self.set_refined(quality, Inserted::default(), None);
            return Ok(QualityReport::default());
        }
        // After an error nothing is known.
        let mut looked = self.made.as_mut().map(|made| std::mem::take(&mut made.looked)).unwrap_or_default();
        let numbers = memory::copy_of(&asked)?;
        let mut read = self.read_vertices(&mut looked)?;
        let bounds = Bounds::new(quality, read.places.scale)?;
        let tests = bounds.tests(quality, &read);
        self.read_cells(&mut read, &mut looked, &tests, question)?;
        tests.check_stop()?;
        if !read.bad.is_empty() || due.is_some() {
            read.read_cells_of_vertices(self.cells()?.corners)?;
        }
        let mut report = QualityReport { bad_cells: read.bad.len(), ..Default::default() };
        let mut pace = std::mem::take(self.mesh.kernel.pace_mut());
        pace.begin();
        let found =
            self.find((&read, mask, quality), (&bounds, tests), (options, due), &mut || pace.ask_again());
        *self.mesh.kernel.pace_mut() = pace;
        let (refined, n_fresh) = found?;
        let Some(mut refined) = refined else {
            if let (Some(made), 0) = (&mut self.made, report.bad_cells) {
                made.found.all_good.set(question)?;
            }
            // Nothing fails from here on.
            looked.end(numbers, read.places, Some(question.n_changes));
            self.set_refined(quality, Inserted::default(), n_fresh);
            self.set_looked(looked);
            return Ok(report);
        };
        report.inserted = refined.vertices.len();
        report.on_segments = refined.vertices.iter().filter(|(_, segment)| *segment != NONE).count();
        report.removed = refined.removed.len();
        report.unsplit = refined.n_unsplit;
        report.is_cut_short = refined.is_cut_short;
        report.bad_cells = refined.n_bad;
        let mut inserted = Inserted { sizes: std::mem::take(&mut refined.sizes), ..Inserted::default() };
        inserted.sizes.iter_mut().for_each(|size| *size /= read.places.scale);
        let mut placed_at = Some(question.n_changes);
        if report.inserted > 0 || report.removed > 0 {
            placed_at = None;
            self.commit_refined(&read, &refined, options, &mut inserted, &mut report)?;
        }
        looked.end(numbers, read.places, placed_at);
        self.set_refined(quality, inserted, n_fresh);
        self.set_looked(looked);
        Ok(report)
    }

    /// Finds what is to be done, if anything, and how many vertices a mesh made anew has, if that has been found. `ask` is
    /// called now and then, and ends it by an error.
    fn find(
        &self,
        (read, mask, quality): (&Read, &[u8], &Quality),
        (bounds, tests): (&Bounds, Tests),
        (options, due): (&RefineOptions, Option<Due>),
        ask: &mut dyn FnMut() -> Result<()>,
    ) -> Result<(Option<Refined>, Option<usize>)> {
        let n = self.made_vertices().count();
        let mut anew = match due {
            Some(due) if due.is_certain => {
                self.find_anew((read, mask, quality), bounds, options, due, ask)?
            }
            _ => None,
        };
        let mut refined = None;
        let is_enough = anew.as_ref().is_some_and(|anew| n > anew.most);
        if !is_enough && !read.bad.is_empty() && !tests.are_none() {
            let points = memory::copy_of(&read.places.points)?;
            let given = read.given(self.cells()?, mask, quality.labels, self.mesh.kernel.keys());
            let (origins, limit) = (self.origins(read)?, (options.keeps, options.limit));
            refined = Some(refine::refine(given, points, &read.bad, tests, origins, limit, ask)?);
        }
        let n = n + refined.as_ref().map_or(0, |refined| refined.vertices.len());
        if let (Some(due), None, Some(_)) = (due, &anew, &refined)
            && self.made.as_ref().is_some_and(|made| made.density.is_grown(n, due.growth))
        {
            anew = self.find_anew((read, mask, quality), bounds, options, due, ask)?;
        }
        Ok(match anew {
            Some(anew) if n > anew.most => (Some(anew.refined), Some(anew.n)),
            Some(anew) => (refined, Some(anew.n)),
            None => (refined, None),
        })
    }

    /// Removes vertices that [`refine`](Self::refine) has added and that are not needed any more: those around which the
    /// cells would still be of the quality asked for, by a margin, in the cells that `mask` selects. Pieces of a
    /// segment are joined again. One commit of its own, all or nothing.
    ///
    /// Around cells that are of lower quality already, those that come may have angles as small: what `refine` then mends
    /// has fewer vertices than if it were called first.
    ///
    /// Cost: a comparison of the cells with those of the last call, tests of those that are others, and for each
    /// vertex added that of looking at the cells around it, unless these, their places and sizes are those of the last
    /// call with this quality and these options. With a callback all are looked at. Where nothing has changed since a
    /// call that removed nothing, masks, labels and sizes are compared.
    ///
    /// # Errors
    /// Those of [`refine`](Self::refine).
    pub fn coarsen(
        &mut self,
        quality: &Quality,
        options: &CoarsenOptions,
        mask: &[u8],
    ) -> Result<QualityReport> {
        self.reject_prepared()?;
        self.mesh.last_found.begin();
        self.check_quality(quality, mask)?;
        options.check()?;
        let mut report = QualityReport::default();
        let quality_asked = asked(quality)?;
        let all_asked = asked_with(&quality_asked, options)?;
        let question = self.question(&all_asked, quality, mask);
        let Some(made) = self.made.as_mut().filter(|made| !made.vertices().is_empty()) else {
            return Ok(report);
        };
        if made.found.all_stay.holds(question) {
            // What is due depends on timestamps, too.
            self.set_coarsened(quality, options, report.removed);
            return Ok(report);
        }
        // After an error nothing is known.
        let mut looked = std::mem::take(&mut made.looked);
        let numbers = memory::copy_of(&quality_asked)?;
        let mut read = self.read_vertices(&mut looked)?;
        let bounds = Bounds::new(quality, read.places.scale)?;
        let tests = bounds.tests(quality, &read);
        self.read_cells(&mut read, &mut looked, &tests, Question { asked: &quality_asked, ..question })?;
        tests.check_stop()?;
        let cells = self.cells()?;
        read.read_cells_of_vertices(cells.corners)?;
        let mut points = memory::copy_of(&read.places.points)?;
        let given = read.given(cells, mask, quality.labels, self.mesh.kernel.keys());
        let mendable = match read.bad[..] {
            [] => Vec::new(),
            _ => {
                let (tests, points) = (bounds.tests(quality, &read), memory::copy_of(&points)?);
                refine::mendable(given, points, &read.bad, tests, self.origins(&read)?, options.keeps)?
            }
        };
        let stays = looked.stays_for(&all_asked)?;
        // More vertices may go around these.
        mendable.iter().flat_map(|&cell| cells.corners[cell as usize]).for_each(|v| stays[v] = false);
        let mut candidates = self.candidates(&read)?;
        for candidate in &mut candidates {
            candidate.is_kept = candidate.between.is_none() && stays[candidate.vertex];
        }
        let room = Room { angle: options.margin, share: options.share, offset: options.joins };
        refine::keep(given, &points, &tests, room, &mut candidates)?;
        read.put_first(&mut candidates);
        let thin = |&&cell: &&u32| tests.is_thin(cells.corners[cell as usize].map(|v| &points[v]));
        let mut corners_of_thin = Vec::new();
        for &cell in read.bad.iter().filter(thin) {
            memory::append(&mut corners_of_thin, &cells.corners[cell as usize])?;
        }
        let mut left = Vec::new();
        let is_left = |cell: &&u32| mendable.binary_search(cell).is_err();
        memory::collect(&mut left, read.bad.iter().filter(is_left).copied())?;
        // Those without which refinement would do more than before stay, and the others are looked at again.
        let coarsened = loop {
            let points =
                if left.is_empty() { std::mem::take(&mut points) } else { memory::copy_of(&points)? };
            let origins = if corners_of_thin.is_empty() { None } else { Some(self.origins(&read)?) };
            let left = match left[..] {
                [] => None,
                _ => Some(LeftBad { cells: &left, origins: self.origins(&read)?, kept: options.keeps }),
            };
            let (tests, bad) = (bounds.tests(quality, &read), (&mendable[..], origins));
            let coarsened = refine::coarsen(given, points, (tests, room), bad, left, &candidates)?;
            if coarsened.wakers.is_empty() {
                break coarsened;
            }
            candidates.retain(|candidate| coarsened.wakers.binary_search(&candidate.vertex).is_err());
        };
        remember(stays, &read, cells.corners, &candidates, &coarsened.able);
        // Whether they are in narrow gaps depends on more than the cells around them.
        corners_of_thin.iter().for_each(|&v| stays[v] = false);
        report.removed = coarsened.vertices.len();
        if report.removed == 0 {
            let made = self.made.as_mut().expect("it has vertices");
            if !numbers.is_empty() {
                made.found.all_stay.set(question)?;
                if read.bad.is_empty() {
                    made.found.all_good.set(Question { asked: &quality_asked, ..question })?;
                }
            }
            looked.end(numbers, read.places, Some(question.n_changes));
            self.set_coarsened(quality, options, report.removed);
            self.set_looked(looked);
            return Ok(report);
        }
        let mut changes = SegmentChanges::default();
        for &(edge, ends) in &coarsened.joined {
            self.replace_at(&read, edge, ends, &mut changes)?;
        }
        for &edge in &coarsened.replaced {
            changes.leave(read.segments_at(edge as usize))?;
        }
        self.commit_quality((&[], &[], &[]), &coarsened.vertices, changes, &mut report)?;
        let is_bounded_alike = !coarsened.vertices.iter().any(|&v| read.places.bound(v));
        looked.end(numbers, read.places, is_bounded_alike.then_some(self.mesh.n_changes));
        self.set_coarsened(quality, options, report.removed);
        self.set_looked(looked);
        Ok(report)
    }

    /// The segment of which refinement, or [`stage_splits`](Self::stage_splits), has made this one a piece; the segment itself
    /// if they have not. From the commit on that makes the piece.
    pub fn original_segment(&self, segment: SegmentId) -> SegmentId {
        self.made.as_ref().and_then(|made| made.origin(segment)).map_or(segment, |origin| origin.segment)
    }

    /// The mask of a domain that a program knows by this number, if the last refinement or coarsening has had it and
    /// nothing has changed since: cells that the call itself has made are in the domain if those are that are reached
    /// from there without crossing a segment.
    pub(crate) fn mask_since(&self, domain: u32) -> Result<Option<Vec<u8>>> {
        let known = self.made.as_ref().and_then(|made| made.looked.of_domain(domain, self.mesh.n_changes));
        let Some((before, known)) = known else { return Ok(None) };
        let corners = self.cells()?.corners;
        let (mut mask, mut others) = (Vec::new(), Vec::new());
        memory::reserve_exact(&mut mask, corners.len())?;
        mask.extend_from_slice(&known[..known.len().min(corners.len())]);
        mask.resize(corners.len(), 0);
        for (cell, row) in CellId::range(0..corners.len()).zip(corners) {
            if before.get(cell.index()) != Some(row) {
                memory::push(&mut others, cell)?;
            }
        }
        let (found, n_undecided) = self.labels_of(&others, |cell| i32::from(mask[cell.index()]), 0)?;
        if n_undecided > 0 {
            return Ok(None);
        }
        found.into_iter().for_each(|(cell, is_in)| mask[cell.index()] = is_in as u8);
        Ok(Some(mask))
    }

    /// The refinement or coarsening that has ended had this mask, which is that of a domain that a program knows by
    /// this number.
    pub(crate) fn set_domain(&mut self, domain: u32, mask: &[u8]) {
        if let Some(made) = &mut self.made {
            made.looked.set_domain(domain, mask, self.mesh.n_changes);
        }
    }

    fn question<'a>(&self, asked: &'a [u64], quality: &Quality<'a>, mask: &'a [u8]) -> Question<'a> {
        let labels = quality.labels.unwrap_or_default();
        let sizes = quality.sizes.unwrap_or_default();
        Question { n_changes: self.mesh.n_changes, asked, mask, labels, sizes }
    }

    /// Remembers what has been looked at, if there is anything that refinement has made.
    fn set_looked(&mut self, looked: Looked) {
        if let Some(made) = &mut self.made {
            made.looked = looked;
        }
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

    /// The vertices that may go.
    fn candidates(&self, read: &Read) -> Result<Vec<Candidate>> {
        let n = self.id_count();
        let (mut before, mut behind) = (Vec::new(), Vec::new());
        memory::lengthen(&mut before, n, NONE)?;
        memory::lengthen(&mut behind, n, NONE)?;
        for (edge, &[v, w]) in (0..).zip(&read.edges) {
            before[w] = edge;
            behind[v] = edge;
        }
        let mut candidates = Vec::new();
        let made = self.made.as_ref().map_or(&[][..], |made| made.vertices());
        for &(vertex, on) in made.iter().filter(|&&(vertex, _)| read.cell_at(vertex) != NONE) {
            let pieces = [before[vertex], behind[vertex]];
            let (between, may_go) = match pieces {
                // Also where the program has removed the segment that it was put on.
                [NONE, NONE] => (None, true),
                // A segment of the program's own ends there, or one goes through.
                [NONE, _] | [_, NONE] => (None, false),
                _ => (Some(pieces), on != SegmentId::NONE && self.are_of_one_origin(read, pieces)),
            };
            if may_go && !self.mesh.is_shared(self.mesh.site_of[vertex]) {
                memory::push(&mut candidates, Candidate { vertex, between, is_kept: false })?;
            }
        }
        Ok(candidates)
    }

    /// Whether the segments at two edges come from the same ones.
    fn are_of_one_origin(&self, read: &Read, edges: [u32; 2]) -> bool {
        let [one, other] = edges.map(|edge| read.segments_at(edge as usize));
        let origin = |&(_, segment): &(_, SegmentId)| self.origin_of(segment);
        one.len() == other.len() && one.iter().all(|a| other.iter().any(|b| origin(a) == origin(b)))
    }
}

/// The bits of the numbers of a quality, but for sizes; empty if it is more than numbers.
fn asked(quality: &Quality) -> Result<Vec<u64>> {
    let mut asked = Vec::new();
    if quality.is_too_large.is_some() {
        return Ok(asked);
    }
    let is_conforming = f64::from(u8::from(quality.is_conforming));
    let has_sizes = f64::from(u8::from(quality.sizes.is_some()));
    let numbers = [quality.least_angle, quality.greatest_area, is_conforming, has_sizes];
    memory::collect(&mut asked, numbers.iter().chain(quality.areas).map(|x| x.to_bits()))?;
    Ok(asked)
}

/// Those of a quality and of these options; empty if the quality is more than numbers.
fn asked_with(quality: &[u64], options: &CoarsenOptions) -> Result<Vec<u64>> {
    let mut asked = Vec::new();
    if !quality.is_empty() {
        let CoarsenOptions { margin, share, joins, growth, keeps } = *options;
        let numbers = [margin, share, joins, growth, f64::from(keeps as u8)].map(f64::to_bits);
        memory::collect(&mut asked, numbers.iter().chain(quality).copied())?;
    }
    Ok(asked)
}

/// Marks the vertices that are candidates on no segment, could not go, and have no cells at segments.
fn remember(
    stays: &mut [bool],
    read: &Read,
    corners: &[[VertexId; 3]],
    candidates: &[Candidate],
    able: &[VertexId],
) {
    stays.fill(false);
    for candidate in candidates.iter().filter(|candidate| candidate.between.is_none()) {
        stays[candidate.vertex] = true;
    }
    able.iter().for_each(|&v| stays[v] = false);
    read.corners_at_sides(corners).for_each(|v| stays[v] = false);
}

/// The bounds of a quality, multiplied as places are.
struct Bounds {
    /// Infinite for none.
    greatest_area: f64,
    areas: Vec<f64>,
    sizes: Vec<f64>,
}

impl Bounds {
    fn new(quality: &Quality, scale: f64) -> Result<Self> {
        // What no area exceeds, where 0 stands for none.
        let area = |x: f64| if x == 0.0 { f64::INFINITY } else { x * scale * scale };
        let (mut areas, mut sizes) = (Vec::new(), Vec::new());
        memory::collect(&mut areas, quality.areas.iter().map(|&x| area(x)))?;
        let given = quality.sizes.unwrap_or_default();
        memory::collect(&mut sizes, given.iter().map(|x| (x * scale).min(f64::MAX)))?;
        Ok(Bounds { greatest_area: area(quality.greatest_area), areas, sizes })
    }

    /// The tests of a quality for what has been read.
    fn tests<'a>(&'a self, quality: &Quality<'a>, read: &Read) -> Tests<'a> {
        let ScaledPlaces { lower, upper, .. } = read.places;
        let criteria = Criteria {
            least_angle: quality.least_angle,
            greatest_area: self.greatest_area,
            areas: &self.areas,
            sizes: &self.sizes,
            is_too_large: quality.is_too_large,
            is_conforming: quality.is_conforming,
            scale: read.places.scale,
        };
        Tests::new(criteria, lower, upper)
    }
}
