//! Moves that wait for the next commit.

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::state::checking::copy_checked;
use crate::motion::state::goals::{Movers, Moves};
use crate::motion::state::part::{PointPart, copy_part, set_part};

/// Both parts.
const WHOLE: u8 = 3;

/// Goals by vertex id, and of which vertices.
///
/// Most callers stage all vertices at once. Such a staging is *whole*: it has neither list nor flags until something
/// asks for them.
#[derive(Debug, Default)]
pub(in crate::motion) struct Staging<G: Moving> {
    /// Where the vertices are to go that are staged.
    goals: Vec<G::Point>,
    /// By vertex id, which [parts](PointPart) of its goal are staged; nothing while whole, when all are.
    parts: Vec<u8>,
    /// Staged vertices in the order of the calls; none while whole. Moves that were forgotten one by one stay listed
    /// until the list is [tidied](Self::tidy): to find each would take a pass.
    vertices: Vec<VertexId>,
    n_forgotten: usize,
    is_whole: bool,
}

impl<G: Moving> Staging<G> {
    /// What a commit is to do: all moves, of `n_present` vertices that there are. The list is
    /// [tidied](Self::tidy) before.
    pub(in crate::motion) fn moves(&mut self, n_present: usize) -> Moves<'_, G> {
        self.tidy();
        let n = self.goals.len();
        let are_all = self.is_whole || self.vertices.len() == n_present && n == n_present && n > 0;
        Moves::staged(&self.goals, if are_all { Movers::All } else { Movers::Listed(&self.vertices) })
    }

    /// Where a staged vertex is to go.
    pub(in crate::motion) fn goal(&self, vertex: VertexId) -> &G::Point {
        debug_assert!(self.is_staged(vertex));
        &self.goals[vertex]
    }

    /// Number of listed vertices, forgotten ones included.
    pub(in crate::motion) fn n_listed(&self) -> usize {
        self.vertices.len()
    }

    pub(in crate::motion) fn is_staged(&self, vertex: VertexId) -> bool {
        self.is_whole || self.parts.get(vertex.index()).is_some_and(|&parts| parts != 0)
    }

    /// Whether this part of the goal of a vertex is staged.
    pub(in crate::motion) fn is_part_staged(&self, vertex: VertexId, part: PointPart) -> bool {
        self.is_whole || self.parts.get(vertex.index()).is_some_and(|&parts| parts & part.bit() != 0)
    }

    /// Stages a part of the goal of a vertex, for which there is [room](Self::reserve) and a list; the other part stays what it is
    /// to be, or what it `is`.
    pub(in crate::motion) fn stage_part(
        &mut self,
        vertex: VertexId,
        part: PointPart,
        is: impl FnOnce() -> G::Point,
        numbers: &[f64],
    ) {
        debug_assert!(!self.is_whole && !self.is_part_staged(vertex, part));
        if self.parts[vertex.index()] == 0 {
            self.goals[vertex] = is();
            self.vertices.push(vertex);
        }
        self.parts[vertex.index()] |= part.bit();
        set_part::<G>(&mut self.goals[vertex], part, numbers);
    }

    /// Forgets a part of the goal of a vertex that was staged last, or beside another part that stays.
    pub(in crate::motion) fn unstage_part(&mut self, vertex: VertexId, part: PointPart, was: &G::Point) {
        let parts = &mut self.parts[vertex.index()];
        *parts &= !part.bit();
        if *parts == 0 {
            let last = self.vertices.pop();
            debug_assert_eq!(last, Some(vertex));
        } else {
            copy_part::<G>(&mut self.goals[vertex], part, was);
        }
    }

    /// Where all vertices go, of which none is staged: an array of so many points, which `write` fills. They are staged if it has.
    pub(in crate::motion) fn stage_all_by(
        &mut self,
        n_ids: usize,
        write: impl FnOnce(&mut [G::Point]) -> Result<()>,
    ) -> Result<()> {
        debug_assert!(self.count() == 0);
        self.reserve(n_ids, 0)?;
        self.vertices.clear();
        self.n_forgotten = 0;
        write(&mut self.goals)?;
        self.is_whole = true;
        Ok(())
    }

    /// A vertex of which a move is staged.
    pub(in crate::motion) fn first_staged(&self) -> Option<VertexId> {
        if self.is_whole { Some(VertexId::new(0)) } else { self.listed().next() }
    }

    /// Whether all vertices are staged, and not listed.
    pub(in crate::motion) fn is_whole(&self) -> bool {
        self.is_whole
    }

    /// Number of staged vertices.
    pub(in crate::motion) fn count(&self) -> usize {
        if self.is_whole { self.goals.len() } else { self.vertices.len() - self.n_forgotten }
    }

    /// The staged vertices of a staging that is not whole, in the order of the calls.
    pub(in crate::motion) fn listed(&self) -> impl Iterator<Item = VertexId> {
        self.vertices.iter().copied().filter(|&v| self.parts[v.index()] != 0)
    }

    /// Takes forgotten moves out of the list.
    fn tidy(&mut self) {
        if self.n_forgotten > 0 {
            let parts = &self.parts;
            self.vertices.retain(|&v| parts[v.index()] != 0);
            self.n_forgotten = 0;
        }
    }

    /// Makes the list of a whole staging.
    pub(in crate::motion) fn list(&mut self) -> Result<()> {
        if !self.is_whole {
            return Ok(());
        }
        let n = self.goals.len();
        memory::reserve_exact(&mut self.vertices, n)?;
        self.vertices.extend(VertexId::range(0..n));
        self.parts.fill(WHOLE);
        self.is_whole = false;
        Ok(())
    }

    /// Makes room for more ids, if there is something to follow.
    pub(in crate::motion) fn make_room(&mut self, more: usize) -> Result<()> {
        if !self.goals.is_empty() {
            memory::reserve(&mut self.goals, more)?;
            memory::reserve(&mut self.parts, more)?;
        }
        Ok(())
    }

    /// Follows the number of ids once there is something to follow, and [room](Self::make_room). The staging must not
    /// be whole.
    pub(in crate::motion) fn grow(&mut self, n_ids: usize) {
        debug_assert!(!self.is_whole);
        if !self.goals.is_empty() {
            self.goals.resize(n_ids, G::Point::default());
            self.parts.resize(n_ids, 0);
        }
    }

    /// Makes room for `more` moves of `n_ids` vertices.
    pub(in crate::motion) fn reserve(&mut self, n_ids: usize, more: usize) -> Result<()> {
        let bytes = n_ids * (size_of::<G::Point>() + 1) + more * size_of::<VertexId>();
        let missing = n_ids - self.goals.len();
        let reserved = self.goals.try_reserve_exact(missing).is_ok()
            && self.parts.try_reserve_exact(missing).is_ok()
            && self.vertices.try_reserve_exact(more).is_ok();
        if !reserved {
            return Err(Error::OutOfMemory { bytes });
        }
        self.goals.resize(n_ids, G::Point::default());
        self.parts.resize(n_ids, 0);
        Ok(())
    }

    pub(in crate::motion) fn stage(&mut self, vertex: VertexId, goal: G::Point) {
        self.goals[vertex] = goal;
        self.parts[vertex.index()] = WHOLE;
        self.vertices.push(vertex);
    }

    /// Stages all vertices, of which none is, at once; `false`, and nothing staged, if a position is bad.
    pub(in crate::motion) fn stage_all(&mut self, positions: &[G::Point]) -> bool {
        debug_assert!(self.count() == 0 && self.goals.len() == positions.len());
        self.vertices.clear();
        self.is_whole = copy_checked::<G>(&mut self.goals, positions);
        self.is_whole
    }

    /// Takes back all but the first `kept` moves.
    pub(in crate::motion) fn truncate(&mut self, kept: usize) {
        if kept == 0 && self.vertices.len() > self.parts.len() / 8 {
            self.parts.fill(0);
        } else {
            self.vertices[kept..].iter().for_each(|&v| self.parts[v.index()] = 0);
        }
        self.vertices.truncate(kept);
        if kept == 0 {
            self.n_forgotten = 0;
        }
    }

    /// Forgets all moves; returns how many there were.
    pub(in crate::motion) fn clear(&mut self) -> usize {
        let n = self.count();
        if self.is_whole {
            self.is_whole = false;
        } else {
            self.truncate(0);
        }
        n
    }

    /// Follows the number of ids when the highest have been given back.
    pub(in crate::motion) fn shrink(&mut self, n_ids: usize) {
        self.goals.truncate(n_ids);
        self.parts.truncate(n_ids);
    }

    /// Forgets the move of a vertex, which is not staged again before the next commit. The staging must not be whole.
    pub(in crate::motion) fn unstage(&mut self, vertex: VertexId) {
        debug_assert!(!self.is_whole);
        if self.is_staged(vertex) {
            self.parts[vertex.index()] = 0;
            self.n_forgotten += 1;
        }
    }

    /// A copy in which the vertices have other ids, `n` in all: those listed by the old ones, [`VertexId::NONE`] for
    /// those removed. Of no moves nothing is kept.
    pub(in crate::motion) fn renumbered(&self, ids: &[VertexId], n: usize) -> Result<Self> {
        let mut staging = Staging::default();
        if self.count() == 0 {
            return Ok(staging);
        }
        staging.reserve(n, self.count())?;
        staging.is_whole = self.is_whole;
        for (v, &id) in ids.iter().enumerate().filter(|(_, id)| **id != VertexId::NONE) {
            staging.goals[id] = self.goals[v];
            staging.parts[id.index()] = self.parts[v];
        }
        if !self.is_whole {
            staging.vertices.extend(self.listed().map(|v| ids[v]));
        }
        Ok(staging)
    }

    /// A copy.
    pub(in crate::motion) fn copied(&self) -> Result<Self> {
        Ok(Staging {
            goals: memory::copy_of(&self.goals)?,
            parts: memory::copy_of(&self.parts)?,
            vertices: memory::copy_of(&self.vertices)?,
            n_forgotten: self.n_forgotten,
            is_whole: self.is_whole,
        })
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.goals) + memory::bytes_of(&self.parts) + memory::bytes_of(&self.vertices)
    }
}
