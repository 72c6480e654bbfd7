//! Keys of vertices, and ids that are given again.
//!
//! A key is what breaks ties and chooses what represents a place (`Keys`). A vertex has it from its creation or insertion
//! on; without one given it is the id. That of a staged insertion is kept from when it is staged, as the kernel of the
//! commit finds it by id, and means nothing until then.

use crate::delaunay::{Keys, Moving};
use crate::error::{Error, Result};
use crate::ids::{SiteId, VertexId};
use crate::machine::memory;
use crate::motion::options::Options;
use crate::motion::state::checking::check_position;
use crate::motion::triangulation::{MAX_VERTICES, MovingTriangulation};

/// Keys of vertices that come.
#[derive(Clone, Copy, Debug)]
pub(in crate::motion) enum Coming<'k> {
    /// Their ids.
    Ids,
    /// Keys that the program gives, in the order of the vertices.
    Keys(&'k [u64]),
    /// For all the greatest key if vertices have keys, else their ids: of vertices that the library makes, so that it need
    /// not know their ids to foresee the cells.
    Made,
}

/// Ids of vertices that come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum Ids {
    /// The ids above the highest that has been given.
    Next,
    /// The ids of removed vertices, the lowest first, then those above.
    Free,
}

impl<G: Moving> MovingTriangulation<G> {
    /// Triangulates `positions`, as [`new`](Self::new) does; the vertices have these keys, which break ties and choose what
    /// represents a place, in the order of keys. They need not be different: vertices of equal keys are ranked by
    /// position, one coordinate after the other, and at the same place by id.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// // Four on a circle: the edge is between the two that do not have the lowest key, whatever their ids.
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    /// let has_edge = |keys: [u64; 4], v: u32, w: u32| {
    ///     let t = MovingTriangulation::<Plane>::with_keys(&corners, &keys, Options::default())?;
    ///     let (v, w) = (VertexId::new(v), VertexId::new(w));
    ///     Ok::<_, deldrift::Error>(t.cells()?.corners.iter().all(|cell| cell.contains(&v) && cell.contains(&w)))
    /// };
    /// assert!(has_edge([10, 20, 30, 40], 0, 2)? != has_edge([20, 10, 40, 30], 0, 2)?);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`new`](Self::new), and [`Error::WrongCount`] if there are not as many keys as positions.
    pub fn with_keys(positions: &[G::Point], keys: &[u64], options: Options) -> Result<Self> {
        let mut t = Self::unbuilt(options);
        t.build_first_with_keys(positions, keys)?;
        Ok(t)
    }

    /// Builds the cells for the first time, as [`build_first`](Self::build_first) does, of vertices with these keys.
    ///
    /// # Errors
    /// The errors of [`with_keys`](Self::with_keys).
    pub(crate) fn build_first_with_keys(&mut self, positions: &[G::Point], keys: &[u64]) -> Result<()> {
        check_count(keys, positions.len())?;
        if positions.len() > MAX_VERTICES {
            return Err(Error::TooManyVertices { given: positions.len(), limit: MAX_VERTICES });
        }
        *self.mesh.kernel.keys_mut() = Keys::of_list(memory::copy_of(keys)?)?;
        self.build_first(positions)
    }

    /// Stages the insertion of vertices, as [`stage_insertions`](Self::stage_insertions) does, with these keys.
    ///
    /// # Errors
    /// The errors of [`stage_insertions`](Self::stage_insertions), and [`Error::WrongCount`] if there are not as many keys
    /// as positions.
    pub fn stage_insertions_with_keys(&mut self, positions: &[G::Point], keys: &[u64]) -> Result<VertexId> {
        self.stage_coming(positions, Coming::Keys(keys))
    }

    /// Stages the insertion of vertices, as [`stage_insertions`](Self::stage_insertions) does, under ids of removed
    /// vertices, the lowest first; where there are no more, those above the highest given follow. `given` is told the id of
    /// each. With keys the vertices have these.
    ///
    /// Not given again are ids by which something is still known: ends of staged segments, ends of segments that have
    /// been split, as long as there are pieces, and vertices that have been removed for the timestamp that is being
    /// prepared.
    ///
    /// Cost: a pass over all ids and segments.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let mut t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// t.remove_vertex(VertexId::new(2))?;
    /// let mut ids = Vec::new();
    /// t.stage_insertions_at_free_ids(&[[0.4, 0.5], [0.6, 0.5]], None, |v| ids.push(v.get()))?;
    /// assert_eq!(ids, [2, 4]);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`stage_insertions_with_keys`](Self::stage_insertions_with_keys).
    pub fn stage_insertions_at_free_ids(
        &mut self,
        positions: &[G::Point],
        keys: Option<&[u64]>,
        mut given: impl FnMut(VertexId),
    ) -> Result<()> {
        let keys = keys.map_or(Coming::Ids, Coming::Keys);
        let ids = self.coming_ids(positions.len(), Ids::Free)?;
        self.stage_at(positions, keys, &ids)?;
        ids.iter().for_each(|&id| given(id));
        Ok(())
    }

    /// Stages the insertion of vertices, with such keys.
    pub(in crate::motion) fn stage_coming(
        &mut self,
        positions: &[G::Point],
        keys: Coming<'_>,
    ) -> Result<VertexId> {
        let first = VertexId::at(self.mesh.site_of.len());
        let ids = self.coming_ids(positions.len(), Ids::Next)?;
        self.stage_at(positions, keys, &ids)?;
        Ok(first)
    }

    /// The ids for `n` vertices that come, ascending.
    pub(in crate::motion) fn coming_ids(&self, n: usize, from: Ids) -> Result<Vec<VertexId>> {
        let mut ids = Vec::new();
        let n_ids = self.mesh.site_of.len();
        if from == Ids::Next && n > MAX_VERTICES - n_ids {
            return Err(Error::TooManyVertices { given: n_ids.saturating_add(n), limit: MAX_VERTICES });
        }
        memory::reserve_exact(&mut ids, n)?;
        if from == Ids::Free {
            let named = self.absent_ends()?;
            let is_waiting = |v| self.edits.is_insertion_staged(v) || self.mesh.is_withheld(v);
            let is_free =
                |&v: &VertexId| self.mesh.is_absent(v) && !is_waiting(v) && named.binary_search(&v).is_err();
            ids.extend(VertexId::range(0..n_ids).filter(is_free).take(n));
        }
        let n_new = n - ids.len();
        if n_new > MAX_VERTICES - n_ids {
            return Err(Error::TooManyVertices { given: n_ids.saturating_add(n_new), limit: MAX_VERTICES });
        }
        ids.extend(VertexId::range(n_ids..n_ids + n_new));
        Ok(ids)
    }

    /// The vertices that are not present and by which segments, or those that pieces come from, are known; ascending.
    fn absent_ends(&self) -> Result<Vec<VertexId>> {
        let mut absent = Vec::new();
        let Some(segments) = &self.mesh.segments else { return Ok(absent) };
        let pieces = self.made.iter().flat_map(|made| made.pieces());
        let origins = pieces
            .filter(|(piece, _)| segments.enforced_or_staged(*piece).is_some())
            .map(|(_, origin)| origin.ends);
        let all = segments
            .enforced()
            .map(|(_, segment)| segment)
            .chain(segments.staged().iter().copied().flatten());
        let ends = all.map(|segment| segment.ends).chain(origins).flatten();
        for v in ends.filter(|&v| v != VertexId::NONE && self.mesh.is_absent(v)) {
            memory::push(&mut absent, v)?;
        }
        absent.sort_unstable();
        Ok(absent)
    }

    /// Stages the insertion of vertices with these ids, ascending, of which those that have not been given before follow
    /// each other.
    pub(in crate::motion) fn stage_at(
        &mut self,
        positions: &[G::Point],
        keys: Coming<'_>,
        ids: &[VertexId],
    ) -> Result<()> {
        let n_ids = ids.last().map_or(0, |last| last.index() + 1).max(self.mesh.site_of.len());
        let n_new = n_ids - self.mesh.site_of.len();
        if let Coming::Keys(keys) = keys {
            check_count(keys, positions.len())?;
        }
        self.staging.list()?;
        self.staging.make_room(n_new)?;
        memory::reserve(&mut self.mesh.site_of, n_new)?;
        self.edits.reserve_insertions(ids.len())?;
        for (index, position) in positions.iter().enumerate() {
            check_position::<G>("positions", index, position)?;
        }
        let had_keys = self.has_keys();
        // What may fail comes before: a triangulation has keys or none.
        self.give_keys(keys, ids, n_ids)?;
        if !self.edits.has_insertions() {
            self.edits.know(self.mesh.site_of.len(), had_keys);
        }
        for (&id, position) in ids.iter().zip(positions) {
            let checked = check_position::<G>("positions", 0, position)?;
            self.edits.insert(id, checked);
        }
        self.edits.sort_insertions();
        if let (Some(made), true) = (&mut self.made, n_new < ids.len()) {
            made.forget(ids);
        }
        self.mesh.site_of.resize(n_ids, SiteId::NONE);
        self.staging.grow(n_ids);
        Ok(())
    }

    /// Gives vertices that come their keys; after an error none has changed.
    pub(in crate::motion) fn give_keys(
        &mut self,
        coming: Coming<'_>,
        ids: &[VertexId],
        n_ids: usize,
    ) -> Result<()> {
        let keys = self.mesh.kernel.keys_mut();
        match coming {
            Coming::Keys(_) if ids.is_empty() => {}
            Coming::Keys(given) => {
                keys.reserve(n_ids)?;
                ids.iter().zip(given).for_each(|(&id, &key)| keys.set(id, key));
            }
            Coming::Made if !keys.are_ids() => {
                keys.reserve(n_ids)?;
                ids.iter().for_each(|&id| keys.set(id, Keys::OF_MADE));
            }
            Coming::Ids | Coming::Made => ids.iter().for_each(|&id| keys.unset(id)),
        }
        Ok(())
    }

    /// The key of a vertex that is present: what it has been given, or else its id.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`], [`Error::RemovedVertex`]; [`Error::StagedVertex`] if its insertion is staged.
    pub fn key(&self, vertex: VertexId) -> Result<u64> {
        self.present_site("vertex", 0, vertex)?;
        Ok(self.mesh.kernel.keys().of(vertex))
    }

    /// The key that an id has, or will have with the insertion that is staged; 0 if there is no such vertex.
    pub fn key_of_id(&self, vertex: VertexId) -> u64 {
        let is_known = self.mesh.is_present(vertex) || self.edits.is_insertion_staged(vertex);
        if is_known { self.mesh.kernel.keys().of(vertex) } else { 0 }
    }

    /// Whether vertices have been given keys, since the creation.
    pub fn has_keys(&self) -> bool {
        !self.mesh.kernel.keys().are_ids()
    }

    /// The first id that has a key, and is neither present nor that of a staged insertion, of keys that have been loaded.
    pub(in crate::motion) fn first_key_of_none(&self) -> Option<VertexId> {
        let keys = self.mesh.kernel.keys();
        if keys.are_ids() {
            return None;
        }
        VertexId::range(0..self.mesh.site_of.len()).find(|&v| keys.of(v) != self.key_of_id(v))
    }
}

fn check_count(keys: &[u64], wanted: usize) -> Result<()> {
    if keys.len() == wanted {
        return Ok(());
    }
    Err(Error::WrongCount { argument: "keys", given: keys.len(), wanted, coming: 0 })
}
