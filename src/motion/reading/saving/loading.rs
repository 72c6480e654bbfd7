//! Making a triangulation of bytes that may be anything.

use crate::complex::Corners;
use crate::damage::{Damage, LoadError};
use crate::delaunay::{Delaunay, Keys, Moving, Rows};
use crate::error::{AXIS_OF_WEIGHT, Error, Result};
use crate::ids::{CellId, Id, SegmentId, Slot, VertexId};
use crate::machine::memory;
use crate::machine::threads::Threads;
use crate::motion::options::Options;
use crate::motion::reading::saving::Saved;
use crate::motion::reading::saving::header::{
    GIVEN_UP, Header, History, N_SUMS_OF_WEIGHTS, SIZE, SegmentCounts, enter_sums_of_weights,
};
use crate::motion::reading::saving::reader::Reader;
use crate::motion::state::cells::Cells;
use crate::motion::state::checking::{check_position, limit};
use crate::motion::state::hidden::Hidden;
use crate::motion::state::made::{Made, Origin};
use crate::motion::state::part::{numbers_of, staged_part};
use crate::motion::state::segments::{Segment, Segments};
use crate::motion::triangulation::{MAX_VERTICES, MovingTriangulation};

impl Reader<'_> {
    /// The keys, if there are some.
    fn keys(&mut self, header: &Header) -> Result<Keys> {
        if !header.has_keys {
            return Ok(Keys::default());
        }
        let mut keys = Vec::new();
        memory::reserve_exact(&mut keys, header.ids)?;
        keys.extend(self.entries(header.ids).iter().map(|&bytes| u64::from_le_bytes(bytes)));
        Keys::of_list(keys)
    }

    /// The history, if there is one.
    fn history(&mut self, header: &Header) -> Result<Option<History>, Damage> {
        if !header.has_history {
            return Ok(None);
        }
        let numbers = self.entries::<8>(12);
        History::of(std::array::from_fn(|k| u64::from_le_bytes(numbers[k]))).map(Some)
    }

    fn rows<I: Id, C: Corners<I>>(&mut self, n: usize) -> Result<Vec<C>> {
        let mut rows = Vec::new();
        memory::reserve_exact(&mut rows, n)?;
        rows.extend(self.entries(n * C::N).chunks_exact(C::N).map(|bytes| {
            let mut row = C::filled(I::new(0));
            (0..C::N).for_each(|i| row[i] = I::new(u32::from_le_bytes(bytes[i])));
            row
        }));
        Ok(rows)
    }
}

/// Segments, and what refinement has made.
type SavedSegments<G> = (Box<Segments<G>>, Option<Box<Made>>);

impl Reader<'_> {
    /// The segments, if there are any, and what refinement has made of them; ends of those that are staged may be staged, too.
    fn segments<G: Moving>(&mut self, header: &Header) -> Result<Option<SavedSegments<G>>, LoadError> {
        if header.segment_bytes == 0 {
            return Ok(None);
        }
        if G::D != 2 {
            return Err(Damage::Counts.into());
        }
        let numbers = self.entries::<8>(SegmentCounts::n_counts(header.has_list));
        let mut counts = [0; 6];
        let counts = &mut counts[..numbers.len()];
        counts.iter_mut().zip(numbers).for_each(|(count, &bytes)| *count = u64::from_le_bytes(bytes));
        let counts = SegmentCounts::of(counts, header)?;
        let (SegmentCounts { enforced, removals, .. }, n) = (counts, counts.numbers_of_one());
        let (mut in_force, mut staged) = (Vec::new(), Vec::new());
        for (k, row) in self.entries::<4>(n * counts.rows()).chunks_exact(n).enumerate() {
            let (id, segment) = counts.row(k, row);
            let is_staged = k >= counts.listed.unwrap_or(enforced);
            let follows = match counts.listed {
                Some(listed) if is_staged => id.index() == enforced + (k - listed),
                Some(_) => id.index() < enforced && in_force.last().is_none_or(|&(last, _)| last < id),
                None => true,
            };
            if !follows {
                return Err(Damage::Segment { segment: id }.into());
            }
            if is_staged && segment == GIVEN_UP {
                memory::push(&mut staged, None)?;
                continue;
            }
            // A staged one may have an end that was removed before a compaction.
            let is_known = |v: VertexId| v.index() < header.ids || (is_staged && v == VertexId::NONE);
            if !is_staged && !header.has_list && segment == Segment::NOTHING {
                continue;
            }
            if !segment.ends.into_iter().all(is_known) {
                return Err(Damage::Segment { segment: id }.into());
            }
            match is_staged {
                true => memory::push(&mut staged, Some(segment))?,
                false => memory::push(&mut in_force, (id, segment))?,
            }
        }
        let mut leaving = self.numbers::<SegmentId>(removals)?;
        leaving.sort_unstable();
        let is_bad = |&&id: &&SegmentId| in_force.binary_search_by_key(&id, |&(id, _)| id).is_err();
        let twice = leaving.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| &pair[0]);
        if let Some(&segment) = leaving.iter().find(is_bad).or(twice) {
            return Err(Damage::Segment { segment }.into());
        }
        let segments = memory::boxed(Segments::of_saved(in_force, enforced, staged, leaving)?)?;
        if header.has_list && !segments.are_to_be_listed() {
            return Err(Damage::Counts.into());
        }
        let made = self.made(counts, header.ids, &segments)?;
        Ok(Some((segments, made)))
    }

    /// What refinement has made.
    fn made<G: Moving>(
        &mut self,
        counts: SegmentCounts,
        n_vertices: usize,
        segments: &Segments<G>,
    ) -> Result<Option<Box<Made>>, LoadError> {
        let is_original =
            |segment: SegmentId| segment == SegmentId::NONE || segment.index() < counts.enforced;
        let mut vertices: Vec<(VertexId, SegmentId)> = Vec::new();
        memory::reserve_exact(&mut vertices, counts.made_vertices)?;
        for row in self.entries::<4>(2 * counts.made_vertices).chunks_exact(2) {
            let [vertex, segment] = [row[0], row[1]].map(u32::from_le_bytes);
            let (vertex, segment) = (VertexId::new(vertex), SegmentId::new(segment));
            let follows = vertices.last().is_none_or(|&(last, _)| last < vertex);
            if !follows || vertex.index() >= n_vertices || !is_original(segment) {
                return Err(Damage::Made { vertex }.into());
            }
            vertices.push((vertex, segment));
        }
        let mut pieces: Vec<(SegmentId, Origin)> = Vec::new();
        memory::reserve_exact(&mut pieces, counts.pieces)?;
        for row in self.entries::<4>(4 * counts.pieces).chunks_exact(4) {
            let [piece, segment, v, w] = [row[0], row[1], row[2], row[3]].map(u32::from_le_bytes);
            let (piece, segment) = (SegmentId::new(piece), SegmentId::new(segment));
            let ends = [v, w].map(VertexId::new);
            let follows = pieces.last().is_none_or(|&(last, _)| last < piece);
            let is_there = segments.enforced_or_staged(piece).is_some();
            let is_piece = is_there && segment.index() < piece.index();
            let are_known = ends.iter().all(|&v| v == VertexId::NONE || v.index() < n_vertices);
            if !follows || !is_piece || !are_known {
                return Err(Damage::Segment { segment: piece }.into());
            }
            pieces.push((piece, Origin { segment, ends }));
        }
        if vertices.is_empty() && pieces.is_empty() {
            return Ok(None);
        }
        Ok(Some(memory::boxed(Made::of_lists(vertices, pieces, counts.enforced)?)?))
    }
}

/// The vertices that stand for the ends of the segments in force.
fn ends_of<G: Moving>(
    segments: Option<&Segments<G>>,
    representatives: &[VertexId],
) -> Result<Vec<[VertexId; 2]>, LoadError> {
    let mut ends = Vec::new();
    for (id, segment) in segments.into_iter().flat_map(|segments| segments.enforced()) {
        let shown = segment.ends.map(|v| representatives[v]);
        if shown.contains(&VertexId::NONE) || shown[0] == shown[1] {
            return Err(Damage::Segment { segment: id }.into());
        }
        memory::push(&mut ends, shown)?;
    }
    Ok(ends)
}

/// Why segments cannot be those of the cells: the data are wrong, or there is no memory.
fn of_segment(error: Error) -> LoadError {
    match error {
        Error::Conflict { conflict, .. } => Damage::Segment { segment: conflict.segment() }.into(),
        error => error.into(),
    }
}

/// What is wrong with a coordinate, or a weight.
fn of_number(vertex: VertexId, axis: usize, value: f64) -> Damage {
    match axis {
        AXIS_OF_WEIGHT => Damage::Weight { vertex, value },
        axis => Damage::Position { vertex, axis, value },
    }
}

/// Checks where the present vertices are, and what stands for their places, and that all others are nowhere and above no
/// cell; returns how many are present.
fn check_vertices<G: Moving>(
    positions: &[G::Point],
    representatives: &[VertexId],
    below: &[CellId],
    keys: &Keys,
) -> Result<usize, Damage> {
    let mut n_present = 0;
    for (vertex, &first) in VertexId::range(0..positions.len()).zip(representatives) {
        let p = &positions[vertex];
        if first == VertexId::NONE {
            if let Some(axis) = (0..G::D).find(|&axis| !p[axis].is_nan()) {
                return Err(Damage::Absent { vertex, axis, value: p[axis] });
            }
            if G::HAS_WEIGHTS && !p[G::D].is_nan() {
                return Err(Damage::Weight { vertex, value: p[G::D] });
            }
            if let Some(&cell) = below.get(vertex.index()).filter(|&&cell| cell != CellId::NONE) {
                return Err(Damage::Above { vertex, cell });
            }
            continue;
        }
        n_present += 1;
        // What is not a number is within no limit.
        let n_good = (0..G::NUMBERS).take_while(|&k| p[k].abs() <= limit::<G>(k)).count();
        if n_good < G::NUMBERS {
            let axis = if n_good == G::D { AXIS_OF_WEIGHT } else { n_good };
            return Err(of_number(vertex, axis, p[n_good]));
        }
        if first != vertex {
            // One beyond the last represents none; with weights, each stands for itself.
            let is_lower =
                !G::HAS_WEIGHTS && first.index() < representatives.len() && keys.is_lower(first, vertex);
            if !is_lower || representatives[first] != first {
                return Err(Damage::Representative { vertex, given: first });
            }
            if positions[first] != *p {
                return Err(Damage::Apart { vertex, representative: first });
            }
        }
    }
    Ok(n_present)
}

impl<G: Moving> MovingTriangulation<G> {
    /// The triangulation that has been saved, under other options. The cells have the indices that they
    /// had, and are as [`cells`](Self::cells) shows them; no changes have been taken.
    ///
    /// After the same calls the loaded triangulation has the same cells as the saved one: cells created by these calls may
    /// have other indices.
    ///
    /// Cost: the sort of a fresh build, and a few passes over the data, whatever they hold; memory for at most 16 times
    /// as many bytes. The monitor of the options is called.
    ///
    /// ```
    /// use deldrift::{LoadError, Plane, motion::{MovingTriangulation, Options, Saved}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default()).map_err(LoadError::Call)?;
    /// let bytes = t.saved().map_err(LoadError::Call)?;
    /// let saved = Saved::of(&bytes).map_err(LoadError::Data)?;
    /// let loaded = MovingTriangulation::<Plane>::load(&saved, Options::default())?;
    /// assert_eq!(loaded.saved().map_err(LoadError::Call)?, bytes);
    /// # Ok::<(), LoadError>(())
    /// ```
    ///
    /// # Errors
    /// [`LoadError::Data`] if it is not one of this dimension, with weights where these are asked for and without them
    /// otherwise, or the bytes are none at all;
    /// [`Error::OutOfMemory`], [`Error::TooManyVertices`], [`Error::TooManyCells`], [`Error::Cancelled`], and
    /// [`Error::Coincident`] if there are hidden vertices, and the options reject that.
    pub fn load(saved: &Saved<'_>, mut options: Options) -> Result<Self, LoadError> {
        let Saved { header, data } = saved;
        if header.dimension != G::D as u32 {
            return Err(Damage::Dimension { given: header.dimension }.into());
        }
        if header.has_weights != G::HAS_WEIGHTS {
            return Err(Damage::Weighted { is_weighted: header.has_weights }.into());
        }
        if header.ids > MAX_VERTICES {
            return Err(Error::TooManyVertices { given: header.ids, limit: MAX_VERTICES }.into());
        }
        let mut reader = Reader(&data[SIZE..]);
        let positions = reader.points::<G>(header.ids)?;
        let moved = reader.points::<G>(header.moves)?;
        let coming = reader.points::<G>(header.insertions)?;
        let representatives = reader.numbers::<VertexId>(header.ids)?;
        let below = reader.numbers::<CellId>(if G::HAS_WEIGHTS { header.ids } else { 0 })?;
        let corners = reader.rows::<VertexId, G::Vertices>(header.cells)?;
        let neighbours = reader.rows::<CellId, G::Neighbours>(header.cells)?;
        let mut later = Reader(&reader.0[4 * (header.moves + header.insertions + header.removals)..]);
        let keys = later.keys(header)?;
        let n_present = check_vertices::<G>(&positions, &representatives, &below, &keys)?;
        let history = later.history(header)?;
        let (segments, made) = later.segments::<G>(header)?.unzip();
        let made = made.flatten();
        if let Some(&(vertex, _)) =
            made.iter().flat_map(|made| made.vertices()).find(|&&(v, _)| representatives[v] == VertexId::NONE)
        {
            return Err(Damage::Made { vertex }.into());
        }
        let ends = ends_of(segments.as_deref(), &representatives)?;
        let rows = Rows { corners: &corners, neighbours: &neighbours, below: &below, segments: &ends };
        let is_site = |v: VertexId| representatives[v] == v;
        let threads = Threads::at_most(options.threads, options.parts);
        let mut unmonitored = |_| true;
        let monitor: &mut dyn FnMut(f64) -> bool = match &mut options.monitor {
            Some(monitor) => monitor,
            None => &mut unmonitored,
        };
        let (kernel, mut site_of) = Delaunay::of_rows(&positions, is_site, rows, keys, threads, monitor)?;
        drop(positions);
        for (v, &first) in VertexId::range(0..header.ids).zip(&representatives) {
            if first != VertexId::NONE && first != v {
                site_of[v] = site_of[first];
            }
        }
        let hidden = Hidden::of_representatives(kernel.keys(), &representatives)?;
        drop(representatives);
        let cells = Cells::of_rows(corners, neighbours, kernel.complex().n_slots())?;
        let mut t = MovingTriangulation::of_parts(kernel, site_of, hidden, n_present, options);
        t.mesh.sorted_stride = t.mesh.kernel.mean_stride();
        t.mesh.reject_coincidence(t.options.coincidence)?;
        t.mesh.views.show(cells)?;
        if let Some(mut segments) = segments {
            let joined = segments.join(&mut t.mesh.kernel, &t.mesh.site_of);
            joined.map_err(of_segment)?;
            for (segment, ends) in segments.enforced().map(|(id, segment)| (id, segment.ends)) {
                let sites = ends.map(|v| t.mesh.site_of[v]);
                if t.mesh.kernel.has_cells() && t.mesh.kernel.find_edge(sites)? == Slot::NONE {
                    return Err(Damage::Segment { segment }.into());
                }
            }
            (t.mesh.segments, t.made) = (Some(segments), made);
        }
        t.statistics = header.statistics;
        t.statistics.coincident = t.mesh.hidden.count() as u64;
        if G::HAS_WEIGHTS {
            let sums = later.entries::<8>(N_SUMS_OF_WEIGHTS);
            enter_sums_of_weights(
                &mut t.statistics,
                sums,
                data.len() - later.0.len() - 8 * N_SUMS_OF_WEIGHTS,
            )?;
            t.count_hidden()?;
        }
        t.stage_saved(header, &mut reader, (&moved, &coming), history)?;
        Ok(t)
    }

    /// Stages what was staged.
    fn stage_saved(
        &mut self,
        header: &Header,
        reader: &mut Reader<'_>,
        (moved, coming): (&[G::Point], &[G::Point]),
        history: Option<History>,
    ) -> Result<(), LoadError> {
        let moves = reader.numbers::<VertexId>(header.moves)?;
        let insertions = reader.numbers::<VertexId>(header.insertions)?;
        let removals = reader.numbers::<VertexId>(header.removals)?;
        self.edits.reserve_insertions(insertions.len())?;
        let mut last = None;
        for (index, (&vertex, position)) in insertions.iter().zip(coming).enumerate() {
            let is_free = self.mesh.is_absent(vertex);
            if !is_free || last.is_some_and(|last| vertex <= last) {
                return Err(Damage::Insertion { vertex }.into());
            }
            let checked = check_position::<G>("positions", index, position);
            let position = checked.map_err(|error| of_staged(error, &insertions))?;
            self.edits.insert(vertex, position);
            last = Some(vertex);
        }
        let usual = self.usual_history();
        let told = history.unwrap_or(usual);
        let History { n_known, had_keys, density } = told;
        let is_staged = (n_known, had_keys) == (usual.n_known, usual.had_keys) || self.edits.has_insertions();
        let is_known =
            (usual.n_known..=self.mesh.site_of.len()).contains(&n_known) && had_keys <= self.has_keys();
        let is_compared = density == usual.density || self.made_vertices().next().is_some();
        let is_told_in_vain = history == Some(usual) && !header.has_list && !header.has_weights;
        if is_told_in_vain || !(is_staged && is_known && is_compared) {
            return Err(Damage::Counts.into());
        }
        if let Some(made) = &mut self.made {
            made.density = density;
        }
        self.edits.know(n_known, had_keys);
        if let Some(vertex) = self.first_key_of_none() {
            return Err(Damage::Key { vertex, given: self.mesh.kernel.keys().of(vertex) }.into());
        }
        self.stage_removals(&removals).map_err(|error| of_staged(error, &removals))?;
        if !G::HAS_WEIGHTS {
            return self.move_vertices(&moves, moved).map_err(|error| of_staged(error, &moves));
        }
        if !moves.is_empty() {
            self.staging.reserve(header.ids, moves.len())?;
        }
        for (&v, goal) in moves.iter().zip(moved) {
            let staged = match staged_part::<G>(goal) {
                // The other part may be staged beside it, and weights of what is to be inserted, but each vertex is told once.
                Some(_) if self.staging.is_staged(v) || !self.mesh.is_present(v) => {
                    return Err(Damage::Staged { vertex: v }.into());
                }
                Some(part) => self.move_parts(part, Some(&[v]), numbers_of::<G>(goal, part)),
                None => self.move_vertices(&[v], std::slice::from_ref(goal)),
            };
            staged.map_err(|error| of_staged(error, &[v]))?;
        }
        Ok(())
    }
}

/// Why something cannot be staged that has been: the data are wrong, or there is no memory.
fn of_staged(error: Error, vertices: &[VertexId]) -> LoadError {
    match error {
        Error::NoSuchVertex { vertex, .. }
        | Error::RemovedVertex { vertex, .. }
        | Error::StagedVertex { vertex, .. }
        | Error::DuplicateMove { vertex, .. } => Damage::Staged { vertex }.into(),
        Error::NotFinite { index, axis, value, .. } | Error::OutOfRange { index, axis, value, .. } => {
            of_number(vertices[index], axis, value).into()
        }
        error => error.into(),
    }
}
