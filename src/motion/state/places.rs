//! Where vertices are while a repair is under way: at their new places, or taken back to the old ones, to be placed.

use std::ops::Range;

use crate::complex::INFINITE;
use crate::delaunay::{Delaunay, Moving};
use crate::error::Result;
use crate::ids::{SiteId, VertexId};
use crate::machine::prefetch::{AHEAD, prefetch};
use crate::machine::{memory, threads};
use crate::motion::state::origins::VertexOrigins;
use crate::predicates::squared_distance;

/// To find those of this number of vertices that have moved takes a few times as long as a thread takes to wake up.
const LISTED_AT_LEAST: usize = 1 << 14;

/// Where a vertex is while a commit is under way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::motion) enum At {
    /// The vertex has not moved.
    Rest,
    New,
    /// At its new place, and listed to be taken back.
    Listed,
    /// Taken back, or never moved because it shares its place: to be placed.
    Old,
}

/// Where all vertices are.
#[derive(Debug, Default)]
pub(in crate::motion) struct Places {
    /// Where each vertex is, by id.
    pub(in crate::motion) at: Vec<At>,
    pub(in crate::motion) n_new: usize,
    /// Vertices at their old places, to be placed.
    pub(in crate::motion) queue: Vec<VertexId>,
    /// The part of the queue that was taken back while cells were exchanged: if that is undone, nothing is known of
    /// their stars.
    pub(in crate::motion) unchecked: Range<usize>,
}

impl Places {
    /// Forgets everything; has room for this number of vertices.
    pub(in crate::motion) fn begin(&mut self, n: usize) -> Result<()> {
        self.at.clear();
        self.queue.clear();
        (self.n_new, self.unchecked) = (0, 0..0);
        memory::reserve(&mut self.at, n)
    }

    /// Of these sites, the one that has moved farthest and is at its new place.
    pub(in crate::motion) fn farthest<G: Moving>(
        &self,
        kernel: &Delaunay<G>,
        origins: &VertexOrigins<G>,
        sites: &[SiteId],
    ) -> Option<SiteId> {
        let displacement = |s: SiteId| {
            let site = kernel.site(s);
            if self.at[site.id] != At::New {
                return None;
            }
            let origin = origins.of(site.id);
            (site.point != *origin).then(|| squared_distance(&site.point, origin))
        };
        let finite = sites.iter().filter(|&&s| s != INFINITE);
        let with_displacement = finite.filter_map(|&s| displacement(s).map(|d| (d, s)));
        with_displacement.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, s)| s)
    }

    /// Takes a vertex back to its old place.
    pub(in crate::motion) fn take_back<G: Moving>(
        &mut self,
        kernel: &mut Delaunay<G>,
        origins: &VertexOrigins<G>,
        s: SiteId,
    ) -> Result<()> {
        memory::reserve(&mut self.queue, 1)?;
        let v = kernel.site(s).id;
        kernel.set_point(s, *origins.of(v));
        self.at[v] = At::Old;
        self.queue.push(v);
        self.n_new -= 1;
        Ok(())
    }

    /// Queues the vertices at new places that are not the old ones, for which there must be room; none of them is taken
    /// back yet. After an error the queue is as before.
    pub(in crate::motion) fn list_new<G: Moving>(
        &mut self,
        kernel: &Delaunay<G>,
        origins: &VertexOrigins<G>,
        site_of: &[SiteId],
    ) -> Result<()> {
        let Self { at, queue, .. } = self;
        let n = site_of.len();
        let list = |range, moved: &mut Vec<VertexId>| {
            VertexId::range(range).try_for_each(|v| {
                // Sites are in another order than vertices.
                if let Some(&later) = site_of.get(v.index() + AHEAD) {
                    prefetch(kernel.sites(), later.index());
                }
                let has_moved = at[v] == At::New && kernel.site(site_of[v]).point != *origins.of(v);
                if has_moved { memory::push(moved, v) } else { Ok(()) }
            })
        };
        let n_threads = kernel.threads().for_work(n, LISTED_AT_LEAST, LISTED_AT_LEAST / 64);
        if n_threads == 1 {
            return list(0..n, queue);
        }
        let parts = threads::for_ranges(n, n_threads, |range| {
            let mut moved = Vec::new();
            list(range, &mut moved).map(|()| moved)
        })?;
        let before = queue.len();
        let listed = parts.into_iter().try_for_each(|part| memory::append(queue, &part?));
        if listed.is_err() {
            queue.truncate(before);
        }
        listed
    }

    pub(in crate::motion) fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.at) + memory::bytes_of(&self.queue)
    }
}
