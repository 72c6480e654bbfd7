//! Writing all bytes, from the first to the last.

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::{CellId, SegmentId, VertexId};
use crate::machine::memory;
use crate::motion::reading::chunks::Chunks;
use crate::motion::reading::saving::header::{GIVEN_UP, Header, History, SegmentCounts, sums_of_weights};
use crate::motion::state::cells::Cells;
use crate::motion::state::density::Density;
use crate::motion::state::made::Origin;
use crate::motion::state::mesh::Standing;
use crate::motion::state::part::{PointPart, set_part};
use crate::motion::state::segments::{Segment, Segments};
use crate::motion::triangulation::MovingTriangulation;

/// Writes segments: how many there are, the ends and the marker of each, in a list with its id and the labels of its sides,
/// and which are to go.
fn save_segments<G: Moving, E>(
    segments: &Segments<G>,
    counts: SegmentCounts,
    chunks: &mut Chunks<impl FnMut(&[u8]) -> Result<(), E>>,
) -> Result<(), E> {
    for count in counts.numbers() {
        chunks.numbers(&[count as u32, (count >> 32) as u32])?;
    }
    let staged = segments.staged().iter().map(|segment| segment.unwrap_or(GIVEN_UP));
    if counts.listed.is_some() {
        let staged = SegmentId::range(counts.enforced..counts.ids).zip(staged);
        for (id, Segment { ends: [v, w], marker, sides: [left, right] }) in segments.enforced().chain(staged)
        {
            chunks.numbers(&[id.get(), v.get(), w.get(), marker as u32, left as u32, right as u32])?;
        }
    } else {
        let enforced = segments.enforced_by_id().map(|segment| segment.unwrap_or(Segment::NOTHING));
        for Segment { ends: [v, w], marker, .. } in enforced.chain(staged) {
            chunks.numbers(&[v.get(), w.get(), marker as u32])?;
        }
    }
    chunks.numbers(SegmentId::numbers_of(segments.leaving()))
}

impl<G: Moving> MovingTriangulation<G> {
    fn header(&self) -> Header {
        let (insertions, removals) = self.staged_edits();
        Header {
            dimension: G::D as u32,
            ids: self.id_count(),
            cells: self.cell_count(),
            moves: self.staged_count(),
            insertions,
            removals,
            has_keys: !self.mesh.kernel.keys().are_ids(),
            has_weights: G::HAS_WEIGHTS,
            has_history: self.history_to_save().is_some(),
            has_list: self.has_list(),
            segment_bytes: self
                .segments_to_save()
                .map_or(0, |segments| self.counts_of(segments).bytes() as usize),
            statistics: self.statistics(),
        }
    }

    /// How many bytes [`save`](Self::save) writes.
    pub fn saved_size(&self) -> usize {
        self.header().size().and_then(|size| usize::try_from(size).ok()).expect("it fits in memory")
    }

    /// Hands on all bytes from which [`load`](Self::load) makes a triangulation like this one, a few thousand at a
    /// time. Before the first, it does what the first [`cells`](Self::cells) does.
    ///
    /// Cost: a pass over what is saved.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`] and [`Error::Prepared`], before the first byte; and those of `put`, with which it ends.
    pub fn save<E: From<Error>>(&self, mut put: impl FnMut(&[u8]) -> Result<(), E>) -> Result<(), E> {
        self.reject_prepared()?;
        let cells = self.cell_arrays()?;
        let insertions = self.edits.insertions();
        let mut checksum = crc32fast::Hasher::new();
        let mut chunks = Chunks::new(|bytes: &[u8]| {
            checksum.update(bytes);
            put(bytes)
        });
        self.save_places(insertions, &mut chunks)?;
        self.save_numbers(cells, insertions, &mut chunks)?;
        chunks.end()?;
        put(&checksum.finalize().to_le_bytes())
    }

    /// Writes the header, and where vertices are or go.
    fn save_places<E>(
        &self,
        insertions: &[(VertexId, G::Point)],
        chunks: &mut Chunks<impl FnMut(&[u8]) -> Result<(), E>>,
    ) -> Result<(), E> {
        chunks.write(self.header().bytes())?;
        let mut nowhere = G::Point::default();
        (0..G::NUMBERS).for_each(|k| nowhere[k] = f64::NAN);
        for (_, s) in self.mesh.sites_of_ids() {
            chunks.whole_point::<G>(s.map_or(&nowhere, |s| &self.mesh.kernel.site(s).point))?;
        }
        self.staged_vertices().try_for_each(|v| chunks.whole_point::<G>(&self.staged_parts(v)))?;
        insertions.iter().try_for_each(|(_, point)| chunks.whole_point::<G>(point))
    }

    /// Where a vertex is to go, and the weight that it is to have; NaN for what is not staged, and stays.
    fn staged_parts(&self, vertex: VertexId) -> G::Point {
        let mut goal = *self.staging.goal(vertex);
        let parts = if G::HAS_WEIGHTS { &[PointPart::Place, PointPart::Weight][..] } else { &[] };
        for &part in parts.iter().filter(|&&part| !self.staging.is_part_staged(vertex, part)) {
            set_part::<G>(&mut goal, part, &[f64::NAN; 3][..part.width::<G>()]);
        }
        goal
    }

    /// Writes which vertices are present and hidden, and by what, the cells, and what is staged.
    fn save_numbers<E: From<Error>>(
        &self,
        cells: &Cells<G>,
        insertions: &[(VertexId, G::Point)],
        chunks: &mut Chunks<impl FnMut(&[u8]) -> Result<(), E>>,
    ) -> Result<(), E> {
        for (_, s) in self.mesh.sites_of_ids() {
            let first = s.map_or(VertexId::NONE, |s| self.mesh.kernel.site(s).id);
            chunks.numbers(&[first.get()])?;
        }
        if G::HAS_WEIGHTS {
            self.save_hidden_by_weight(cells, chunks)?;
        }
        cells.corners().iter().try_for_each(|row| chunks.numbers(VertexId::numbers_of(row.as_ref())))?;
        cells.neighbours().iter().try_for_each(|row| chunks.numbers(CellId::numbers_of(row.as_ref())))?;
        self.staged_vertices().try_for_each(|v| chunks.numbers(&[v.get()]))?;
        insertions.iter().try_for_each(|(id, _)| chunks.numbers(&[id.get()]))?;
        chunks.numbers(VertexId::numbers_of(self.edits.removals()))?;
        self.save_keys(chunks)?;
        for number in self.history_to_save().iter().flat_map(History::numbers) {
            chunks.numbers(&[number as u32, (number >> 32) as u32])?;
        }
        if G::HAS_WEIGHTS {
            for sum in sums_of_weights(&self.statistics) {
                chunks.numbers(&[sum as u32, (sum >> 32) as u32])?;
            }
        }
        let Some(segments) = self.segments_to_save() else { return Ok(()) };
        save_segments(segments, self.counts_of(segments), chunks)?;
        for (vertex, segment) in self.made_vertices() {
            chunks.numbers(&[vertex.get(), segment.get()])?;
        }
        for (piece, Origin { segment, ends }) in self.pieces_of(segments) {
            chunks.numbers(&[piece.get(), segment.get(), ends[0].get(), ends[1].get()])?;
        }
        Ok(())
    }

    /// Writes the cell below each vertex that weights hide.
    fn save_hidden_by_weight<E>(
        &self,
        cells: &Cells<G>,
        chunks: &mut Chunks<impl FnMut(&[u8]) -> Result<(), E>>,
    ) -> Result<(), E>
    where
        E: From<Error>,
    {
        let kernel = &self.mesh.kernel;
        self.mesh.standings().try_for_each(|(_, standing)| {
            let below = match standing {
                Standing::Above(s) => self.lowest_cell_at(s, kernel.cell_below(s), cells.index_of())?,
                _ => CellId::NONE,
            };
            chunks.numbers(&[below.get()])
        })
    }

    /// Writes the keys, if the program has given some.
    fn save_keys<E>(&self, chunks: &mut Chunks<impl FnMut(&[u8]) -> Result<(), E>>) -> Result<(), E> {
        if self.mesh.kernel.keys().are_ids() {
            return Ok(());
        }
        (0..self.id_count()).map(VertexId::at).try_for_each(|v| {
            let key = self.key_of_id(v);
            chunks.numbers(&[key as u32, (key >> 32) as u32])
        })
    }

    /// The history as far as ids and keys tell it: no id is known that only staged insertions have, there were keys if there
    /// are, and there is nothing to compare with.
    pub(super) fn usual_history(&self) -> History {
        let n_ids = self.id_count();
        let last = self.edits.insertions().iter().rev().zip(1..=n_ids);
        let n_last = last.take_while(|&(&(v, _), k)| v.index() == n_ids - k).count();
        History { n_known: n_ids - n_last, had_keys: self.has_keys(), density: Density::default() }
    }

    /// The history, if it is to be saved.
    fn history_to_save(&self) -> Option<History> {
        let usual = self.usual_history();
        let mut history = usual;
        if self.edits.has_insertions() {
            (history.n_known, history.had_keys) = (self.edits.n_known(), self.edits.had_keys());
        }
        if self.made_vertices().next().is_some() {
            history.density = self.made.as_ref().map_or(usual.density, |made| made.density);
        }
        (history != usual || self.has_list() || G::HAS_WEIGHTS).then_some(history)
    }

    /// Whether the segments in force are listed.
    fn has_list(&self) -> bool {
        self.segments_to_save().is_some_and(Segments::are_to_be_listed)
    }

    /// How many segments there are to be saved.
    fn counts_of(&self, segments: &Segments<G>) -> SegmentCounts {
        SegmentCounts {
            ids: segments.n_ids(),
            enforced: segments.n_enforced(),
            removals: segments.n_leaving(),
            made_vertices: self.made_vertices().count(),
            pieces: self.pieces_of(segments).count(),
            listed: segments.are_to_be_listed().then(|| segments.enforced().len()),
        }
    }

    /// The pieces in force, and those that are staged, with where they come from.
    fn pieces_of<'a>(&'a self, segments: &'a Segments<G>) -> impl Iterator<Item = (SegmentId, Origin)> + 'a {
        let all = self.made.iter().flat_map(|made| made.pieces());
        all.copied().filter(|&(piece, _)| segments.enforced_or_staged(piece).is_some())
    }

    /// The segments, if there ever was one that was not discarded.
    fn segments_to_save(&self) -> Option<&Segments<G>> {
        self.mesh.segments.as_deref().filter(|segments| segments.n_ids() > 0)
    }

    /// The vertices of which moves are staged, in the order of the calls.
    fn staged_vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        let n_unlisted = if self.staging.is_whole() { self.staging.count() } else { 0 };
        VertexId::range(0..n_unlisted).chain(self.staging.listed())
    }

    /// All bytes that [`save`](Self::save) writes.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn saved(&self) -> Result<Vec<u8>> {
        let mut bytes = Vec::new();
        memory::reserve_exact(&mut bytes, self.saved_size())?;
        self.save(|more| memory::append(&mut bytes, more))?;
        debug_assert_eq!(bytes.len(), self.saved_size());
        Ok(bytes)
    }
}
