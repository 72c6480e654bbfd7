//! Which vertices would pass which segments in a step: from the positions of the last commit to those that are to come.
//!
//! What it is to pass is decided, exactly, for one vertex and one segment at a time (`predicates/passing.rs`). Here the
//! pairs are found for which that has to be asked: by boxes that move ([`sweep`]). Vertices are taken in the order of
//! the sites, which follows a curve, so that some after one another have a small box together; segments are in a tree in
//! the order of the sites of their ends.
//!
//! A vertex or an end that is not moved stays where it is for all of the step. Vertices that come or go with it have no
//! place at one of the two times, and are not looked at; neither are segments that come or go.
//!
//! Cost: where most vertices move, a pass over all of them, and for each sixteen a search in the tree. Where few move and
//! are no ends, that of looking at them and the segments alone.

mod sweep;

use crate::delaunay::Moving;
use crate::error::{Passing, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::motion::state::edits::Edits;
use crate::motion::state::goals::Goals;
use crate::motion::state::mesh::Mesh;
use crate::motion::state::staging::Staging;
use sweep::{SegmentTree, StraightPath, Swept, Walker, look_at_pairs};

/// Vertices that are looked at together.
const BLOCK: usize = 16;

/// Up to this number of movers a tree of segments is not worth making.
const FEW: usize = 8;

/// Where vertices go in a step.
#[derive(Debug)]
pub(in crate::motion) enum Steps<'a, G: Moving> {
    /// Every vertex goes to its goal.
    All(Goals<'a, G>),
    /// The staged ones do.
    Staged(&'a Staging<G>),
    /// One vertex does.
    One(VertexId, G::Point),
}

impl<G: Moving> Steps<'_, G> {
    #[inline(always)]
    fn goal(&self, vertex: VertexId) -> Option<G::Point> {
        match *self {
            Steps::All(goals) => Some(goals.of(vertex)),
            Steps::Staged(staging) => staging.is_staged(vertex).then(|| *staging.goal(vertex)),
            Steps::One(mover, goal) => (mover == vertex).then_some(goal),
        }
    }

    fn move_something(&self) -> bool {
        match self {
            Steps::All(_) | Steps::One(..) => true,
            Steps::Staged(staging) => staging.count() > 0,
        }
    }

    /// The vertices that move, if they are listed and few of all.
    fn few(&self, n_present: usize) -> Result<Option<Vec<VertexId>>> {
        let mut few = Vec::new();
        match *self {
            Steps::Staged(staging) if !staging.is_whole() && staging.count() <= n_present / 4 => {
                memory::reserve_exact(&mut few, staging.count())?;
                few.extend(staging.listed());
            }
            Steps::One(mover, _) => memory::push(&mut few, mover)?,
            _ => return Ok(None),
        }
        Ok(Some(few))
    }
}

/// The vertices that would pass segments, ascending by segment and vertex.
pub(in crate::motion) fn find<G: Moving>(
    mesh: &Mesh<G>,
    edits: &Edits<G>,
    steps: &Steps<'_, G>,
) -> Result<Vec<Passing>> {
    let mut found = Vec::new();
    if !steps.move_something() {
        return Ok(found);
    }
    let step = Step { mesh, edits, steps };
    let mut segments = step.segments()?;
    if segments.is_empty() {
        return Ok(found);
    }
    if let Some(movers) = steps.few(mesh.n_present)? {
        // A segment that stays is passed by vertices that move alone.
        let mut still = Vec::new();
        memory::reserve(&mut still, segments.len())?;
        still.extend(segments.iter().filter(|segment| segment.is_still()).copied());
        segments.retain(|segment| !segment.is_still());
        step.look_at_all(segments, &mut found)?;
        step.look_at_movers(movers, still, &mut found)?;
    } else {
        step.look_at_all(segments, &mut found)?;
    }
    found.sort_unstable();
    Ok(found)
}

/// What is looked at.
struct Step<'a, G: Moving> {
    mesh: &'a Mesh<G>,
    edits: &'a Edits<G>,
    steps: &'a Steps<'a, G>,
}

impl<G: Moving> Step<'_, G> {
    /// A vertex on its way, if it is there before and after.
    fn walker(&self, vertex: VertexId) -> Option<Walker> {
        self.walker_from(vertex, &self.mesh.kernel.site(self.mesh.site(vertex)?).point)
    }

    /// A vertex on its way from its place, if it is there after.
    #[inline(always)]
    fn walker_from(&self, vertex: VertexId, from: &G::Point) -> Option<Walker> {
        if self.edits.is_removal_staged(vertex) {
            return None;
        }
        let to = self.steps.goal(vertex).unwrap_or(*from);
        Some(Walker { vertex, path: StraightPath { from: [from[0], from[1]], to: [to[0], to[1]] } })
    }

    /// The segments that are in force before and after.
    fn segments(&self) -> Result<Vec<Swept>> {
        let mut swept = Vec::new();
        let Some(segments) = &self.mesh.segments else { return Ok(swept) };
        memory::reserve(&mut swept, segments.enforced().len())?;
        for (id, segment) in segments.enforced().filter(|&(id, _)| !segments.is_removal_staged(id)) {
            if let [Some(a), Some(b)] = segment.ends.map(|v| self.walker(v)) {
                let place = segment.ends.map(|v| self.mesh.site_of[v].get());
                swept.push(Swept { id, ends: [a, b], place: place[0].min(place[1]) });
            }
        }
        Ok(swept)
    }

    /// Looks at all vertices.
    fn look_at_all(&self, segments: Vec<Swept>, found: &mut Vec<Passing>) -> Result<()> {
        if segments.is_empty() {
            return Ok(());
        }
        let tree = SegmentTree::new(segments)?;
        let (mesh, mut block) = (self.mesh, Vec::new());
        memory::reserve(&mut block, BLOCK)?;
        for s in mesh.kernel.live_sites() {
            let site = mesh.kernel.site(s);
            self.take(site.id, &site.point, &mut block)?;
            if mesh.hidden.is_followed(site.id) {
                let mut taken = Ok(());
                mesh.hidden.for_all_behind(site.id, |v| {
                    if taken.is_ok() {
                        taken = self.take(v, &site.point, &mut block);
                    }
                });
                taken?;
            }
            if block.len() >= BLOCK {
                tree.look_at(&block, found)?;
                block.clear();
            }
        }
        tree.look_at(&block, found)
    }

    /// Puts a vertex into a block.
    #[inline(always)]
    fn take(&self, vertex: VertexId, from: &G::Point, block: &mut Vec<Walker>) -> Result<()> {
        self.walker_from(vertex, from).map_or(Ok(()), |walker| memory::push(block, walker))
    }

    /// Looks at the vertices that move, of which there are few, and segments that stay.
    fn look_at_movers(
        &self,
        mut movers: Vec<VertexId>,
        segments: Vec<Swept>,
        found: &mut Vec<Passing>,
    ) -> Result<()> {
        if segments.is_empty() {
            return Ok(());
        }
        movers.sort_unstable_by_key(|&v| self.mesh.site_of[v]);
        let mut walkers = Vec::new();
        memory::reserve(&mut walkers, movers.len())?;
        walkers.extend(movers.iter().filter_map(|&v| self.walker(v)));
        if walkers.len() <= FEW {
            return look_at_pairs(&segments, &walkers, found);
        }
        let tree = SegmentTree::new(segments)?;
        walkers.chunks(BLOCK).try_for_each(|block| tree.look_at(block, found))
    }
}
