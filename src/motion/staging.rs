//! Positions that wait for the next commit.

use crate::delaunay::Dimension;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::predicates::{Array, MAX_MAGNITUDE, is_in_range};

/// Staged positions by vertex id. During and after a commit the entries of its vertices hold the positions
/// *before* it: applying a move exchanges the two.
///
/// Most callers stage all vertices at once. Such a staging is *whole*: it has neither list nor flags until something
/// asks for them.
#[derive(Debug)]
pub(super) struct Staging<G: Dimension> {
    positions: Vec<G::Point>,
    /// By vertex id; all false while whole.
    is_staged: Vec<bool>,
    /// Staged vertices in the order of the calls. While whole: those that a commit has queued. Moves that were
    /// forgotten one by one stay listed until the list is [tidied](Self::tidy): to find each would take a pass.
    vertices: Vec<VertexId>,
    n_forgotten: usize,
    /// How many of the listed vertices are at their new positions, while a commit is under way.
    applied: usize,
    is_whole: bool,
    /// Whether, while whole, the vertices that are not listed are at their new positions.
    others_applied: bool,
}

/// Positions of all vertices as the caller of a commit has given them, until they are staged: all at once
/// ([`stage_given`](super::MovingTriangulation::stage_given)), or block by block as the vertices move
/// ([`moving`](super::moving)).
#[derive(Debug)]
pub(super) struct Given<'p, G: Dimension>(Option<&'p [G::Point]>);

impl<'p, G: Dimension> Given<'p, G> {
    /// No positions are given: all are staged.
    pub(super) fn nothing() -> Self {
        Given(None)
    }

    pub(super) fn all(positions: &'p [G::Point]) -> Self {
        Given(Some(positions))
    }

    /// The positions, if they are not staged.
    pub(super) fn positions(&self) -> Option<&'p [G::Point]> {
        self.0
    }

    /// The positions, if they are not staged; the caller makes sure that they will be.
    pub(super) fn take(&mut self) -> Option<&'p [G::Point]> {
        self.0.take()
    }
}

/// Stages positions; `false` if one is bad.
pub(super) fn stage_block<G: Dimension>(staged: &mut [G::Point], given: &[G::Point]) -> bool {
    let mut bad = 0u64;
    for (staged, &value) in G::Point::flattened_mut(staged).iter_mut().zip(G::Point::flattened(given)) {
        bad |= u64::from(!is_in_range(value));
        *staged = value + 0.0;
    }
    bad == 0
}

/// The first error in positions of which one is bad.
#[cold]
pub(super) fn first_bad<G: Dimension>(given: &[G::Point]) -> Error {
    let errors = given.iter().enumerate().map(|(v, p)| check_position::<G>("positions", v, p));
    errors.filter_map(Result::err).next().expect("one is bad")
}

impl<G: Dimension> Default for Staging<G> {
    fn default() -> Self {
        Staging {
            positions: Vec::new(),
            is_staged: Vec::new(),
            vertices: Vec::new(),
            n_forgotten: 0,
            applied: 0,
            is_whole: false,
            others_applied: false,
        }
    }
}

impl<G: Dimension> Staging<G> {
    /// By vertex id: where the vertex is to go, or, once its move is applied, where it was.
    #[inline(always)]
    pub(super) fn positions(&self) -> &[G::Point] {
        &self.positions
    }

    #[inline(always)]
    pub(super) fn positions_mut(&mut self) -> &mut [G::Point] {
        &mut self.positions
    }

    /// The listed vertices, after the list has been [tidied](Self::tidy). The first of them, as many as are [applied](Self::applied), are at their new positions.
    #[inline(always)]
    pub(super) fn vertices(&self) -> &[VertexId] {
        &self.vertices
    }

    /// The listed vertices, to queue some.
    #[inline(always)]
    pub(super) fn vertices_mut(&mut self) -> &mut Vec<VertexId> {
        &mut self.vertices
    }

    /// [Positions](Self::positions) and [list](Self::vertices).
    #[inline(always)]
    pub(super) fn parts_mut(&mut self) -> (&mut [G::Point], &mut Vec<VertexId>) {
        (&mut self.positions, &mut self.vertices)
    }

    /// How many of the listed vertices are at their new positions.
    #[inline(always)]
    pub(super) fn applied(&self) -> usize {
        self.applied
    }

    #[inline(always)]
    pub(super) fn set_applied(&mut self, n: usize) {
        self.applied = n;
    }

    /// Whether, while whole, the vertices that are not listed are at their new positions.
    #[inline(always)]
    pub(super) fn others_applied(&self) -> bool {
        self.others_applied
    }

    /// All vertices of a whole staging are at their new positions, but for those listed.
    pub(super) fn apply_others(&mut self) {
        self.others_applied = true;
    }

    pub(super) fn is_staged(&self, vertex: VertexId) -> bool {
        self.is_whole || self.is_staged.get(vertex.index()).copied().unwrap_or(false)
    }

    /// A vertex of which a move is staged.
    pub(super) fn first_staged(&self) -> Option<VertexId> {
        if self.is_whole { Some(VertexId::new(0)) } else { self.listed().next() }
    }

    /// Whether all vertices are staged, and not listed.
    pub(super) fn is_whole(&self) -> bool {
        self.is_whole
    }

    /// Number of staged vertices.
    pub(super) fn count(&self) -> usize {
        if self.is_whole { self.positions.len() } else { self.vertices.len() - self.n_forgotten }
    }

    /// The staged vertices of a staging that is not whole, in the order of the calls.
    pub(super) fn listed(&self) -> impl Iterator<Item = VertexId> {
        self.vertices.iter().copied().filter(|&v| self.is_staged[v])
    }

    /// Takes forgotten moves out of the list.
    pub(super) fn tidy(&mut self) {
        if self.n_forgotten > 0 {
            let is_staged = &self.is_staged;
            self.vertices.retain(|&v| is_staged[v]);
            self.n_forgotten = 0;
        }
    }

    /// Makes a list of all of `n_present` vertices whole.
    pub(super) fn forget_full_list(&mut self, n_present: usize) {
        if self.vertices.len() == n_present && self.positions.len() == n_present && n_present > 0 {
            self.vertices.clear();
            self.is_staged.fill(false);
            self.is_whole = true;
        }
    }

    /// Makes the list of a whole staging of which nothing has been applied, or all.
    pub(super) fn list(&mut self) -> Result<()> {
        if !self.is_whole {
            return Ok(());
        }
        let n = self.positions.len();
        debug_assert!(self.applied == self.vertices.len() && (self.others_applied || self.applied == 0));
        self.vertices.clear();
        memory::reserve_exact(&mut self.vertices, n)?;
        self.vertices.extend(VertexId::range(0..n));
        self.is_staged.fill(true);
        self.applied = if self.others_applied { n } else { 0 };
        (self.is_whole, self.others_applied) = (false, false);
        Ok(())
    }

    /// Empties the queue of a whole staging, after a commit or its undoing.
    pub(super) fn end_queue(&mut self) {
        if self.is_whole {
            self.vertices.clear();
            self.others_applied = false;
        }
    }

    /// A flag of a vertex, free for use while whole.
    pub(super) fn flag(&self, vertex: VertexId) -> bool {
        self.is_staged[vertex]
    }

    /// Sets a flag, which must be reset before the staging is whole no more.
    pub(super) fn set_flag(&mut self, vertex: VertexId, flag: bool) {
        self.is_staged[vertex] = flag;
    }

    /// Makes room for more ids, if there is something to follow.
    pub(super) fn make_room(&mut self, more: usize) -> Result<()> {
        if !self.positions.is_empty() {
            memory::reserve(&mut self.positions, more)?;
            memory::reserve(&mut self.is_staged, more)?;
        }
        Ok(())
    }

    /// Follows the number of ids once there is something to follow, and [room](Self::make_room). The staging must not
    /// be whole.
    pub(super) fn grow(&mut self, n_ids: usize) {
        debug_assert!(!self.is_whole);
        if !self.positions.is_empty() {
            self.positions.resize(n_ids, G::Point::default());
            self.is_staged.resize(n_ids, false);
        }
    }

    /// Makes room for a position of each id.
    pub(super) fn grow_for(&mut self, n_ids: usize) -> Result<()> {
        if self.positions.len() < n_ids { self.reserve(n_ids, 0) } else { Ok(()) }
    }

    /// Makes room for `more` moves of `n_ids` vertices.
    pub(super) fn reserve(&mut self, n_ids: usize, more: usize) -> Result<()> {
        let bytes = n_ids * (size_of::<G::Point>() + 1) + more * size_of::<VertexId>();
        let missing = n_ids - self.positions.len();
        let reserved = self.positions.try_reserve_exact(missing).is_ok()
            && self.is_staged.try_reserve_exact(missing).is_ok()
            && self.vertices.try_reserve_exact(more).is_ok();
        if !reserved {
            return Err(Error::OutOfMemory { bytes });
        }
        self.positions.resize(n_ids, G::Point::default());
        self.is_staged.resize(n_ids, false);
        Ok(())
    }

    pub(super) fn stage(&mut self, vertex: VertexId, position: G::Point) {
        self.positions[vertex] = position;
        self.is_staged[vertex] = true;
        self.vertices.push(vertex);
    }

    /// Stages all vertices, of which none is, at once; `false`, and nothing staged, if a position is bad.
    pub(super) fn stage_all(&mut self, positions: &[G::Point]) -> bool {
        debug_assert!(self.count() == 0 && self.positions.len() == positions.len());
        self.is_whole = stage_block::<G>(&mut self.positions, positions);
        self.is_whole
    }

    /// All vertices are staged, of which none is, though their positions are not yet.
    pub(super) fn expect_whole(&mut self) {
        self.is_whole = true;
    }

    /// Takes back all but the first `kept` moves.
    pub(super) fn truncate(&mut self, kept: usize) {
        if kept == 0 && self.vertices.len() > self.is_staged.len() / 8 {
            self.is_staged.fill(false);
        } else {
            self.vertices[kept..].iter().for_each(|&v| self.is_staged[v] = false);
        }
        self.vertices.truncate(kept);
        if kept == 0 {
            self.n_forgotten = 0;
        }
    }

    /// Forgets all moves; returns how many there were.
    pub(super) fn clear(&mut self) -> usize {
        let n = self.count();
        self.applied = 0;
        if self.is_whole {
            self.end_queue();
            self.is_whole = false;
        } else {
            self.truncate(0);
        }
        n
    }

    /// Follows the number of ids when the highest have been given back.
    pub(super) fn shrink(&mut self, n_ids: usize) {
        self.positions.truncate(n_ids);
        self.is_staged.truncate(n_ids);
    }

    /// Forgets the move of a vertex, which is not staged again before the next commit. The staging must not be whole.
    pub(super) fn unstage(&mut self, vertex: VertexId) {
        debug_assert!(!self.is_whole);
        if self.is_staged(vertex) {
            self.is_staged[vertex] = false;
            self.n_forgotten += 1;
        }
    }

    /// A copy in which the vertices have other ids, `n` in all: those listed by the old ones, [`VertexId::NONE`] for
    /// those removed. Of no moves nothing is kept.
    pub(super) fn renumbered(&self, ids: &[VertexId], n: usize) -> Result<Self> {
        let mut staging = Staging::default();
        if self.count() == 0 {
            return Ok(staging);
        }
        staging.reserve(n, self.count())?;
        staging.is_whole = self.is_whole;
        for (v, &id) in ids.iter().enumerate().filter(|(_, id)| **id != VertexId::NONE) {
            staging.positions[id] = self.positions[v];
            staging.is_staged[id] = self.is_staged[v];
        }
        if !self.is_whole {
            staging.vertices.extend(self.listed().map(|v| ids[v]));
        }
        Ok(staging)
    }

    /// A copy.
    pub(super) fn copied(&self) -> Result<Self> {
        Ok(Staging {
            positions: memory::copy_of(&self.positions)?,
            is_staged: memory::copy_of(&self.is_staged)?,
            vertices: memory::copy_of(&self.vertices)?,
            n_forgotten: self.n_forgotten,
            applied: self.applied,
            is_whole: self.is_whole,
            others_applied: self.others_applied,
        })
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.positions.capacity() * size_of::<G::Point>()
            + self.is_staged.capacity()
            + self.vertices.capacity() * 4
    }
}

/// A position with the sign of zeros made positive, so that equal places are equal bits.
#[inline(always)]
pub(crate) fn check_position<G: Dimension>(
    argument: &'static str,
    index: usize,
    p: &G::Point,
) -> Result<G::Point> {
    let mut checked = *p;
    for axis in 0..G::D {
        let value = p[axis];
        checked[axis] = value + 0.0;
        if is_in_range(value) {
            continue;
        }
        return Err(if value.is_finite() {
            Error::OutOfRange { argument, index, axis, value, limit: MAX_MAGNITUDE }
        } else {
            Error::NotFinite { argument, index, axis, value }
        });
    }
    Ok(checked)
}
