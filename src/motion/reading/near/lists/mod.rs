//! For each vertex those that are near it: the neighbour lists of particle codes.
//!
//! | file | what |
//! |---|---|
//! | `tree` | boxes over the places |
//! | `search` | the lists of a part of the places |
//!
//! The triangulation is not asked: a tree of boxes over the places takes less time to make than the star of each vertex takes
//! to read, and serves flat sets, segments and images alike.
//!
//! Cost: let each vertex have its greatest ball, and k be the number of entries of all lists. Boxes that are longer than a
//! ball and meet it are few, as is shown in `tree`, and places in shorter ones are at most some lengths of its radius away. With
//! one radius for all, the places that are that near to vertices are at most a constant times n + k: parted into squares or cubes
//! in which all are near each other, the set has at least as many entries as the sum of the squares of what is in each, and what
//! is looked at are products of the numbers of squares near each other. With radii that differ, those of each size cost at most n √k.

mod search;
mod tree;

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::machine::memory;
use crate::machine::threads::{Threads, for_ranges};
use crate::motion::state::checking::check_not_negative;
use crate::motion::state::mesh::Standing;
use crate::motion::triangulation::MovingTriangulation;
use search::Part;
pub(crate) use search::{Entry, Search};
use tree::NO_LIST;
pub(crate) use tree::{BoxTree, PlacedVertex};

/// A thread more pays if it gets so many lists.
const SHARED_AT_LEAST: usize = 1 << 10;

/// About so many places are looked at between two calls of a monitor.
const WORK: usize = 1 << 20;

/// What lists are asked for.
#[derive(Clone, Copy, Debug)]
pub struct ListsOf<'a> {
    /// The square of the radius of all lists, or by id that of each.
    pub squared_radii: &'a [f64],
    /// By id, whether there is a list of the vertex: where it is not 0.
    pub mask: Option<&'a [u8]>,
    /// Whether each pair of vertices comes once: in the list of the lower id, or of the one that has a list.
    pub is_half: bool,
}

impl ListsOf<'_> {
    /// Whether there are as many radii and entries of the mask as there have to be, and the radius of all is one.
    pub(crate) fn check(&self, id_count: usize) -> Result<()> {
        let given = self.squared_radii.len();
        if given != 1 && given != id_count {
            return Err(Error::WrongCount { argument: "radius_count", given, wanted: id_count, coming: 0 });
        }
        if let Some(mask) = self.mask.filter(|mask| mask.len() != id_count) {
            let given = mask.len();
            return Err(Error::WrongCount { argument: "mask_count", given, wanted: id_count, coming: 0 });
        }
        match *self.squared_radii {
            [of_all] => check_not_negative("squared_radii", of_all),
            _ => Ok(()),
        }
    }

    /// Vertices with their places and the squares of the radii of their lists.
    pub(crate) fn placed<P>(
        &self,
        vertices: impl Iterator<Item = (VertexId, P)>,
        n: usize,
    ) -> Result<Vec<PlacedVertex<P>>> {
        let mut placed = Vec::new();
        memory::reserve_exact(&mut placed, n)?;
        let mut bad = VertexId::NONE;
        for (vertex, place) in vertices {
            let has_list = self.mask.is_none_or(|mask| mask[vertex.index()] != 0);
            let squared_radius = if has_list { self.squared_radius(vertex) } else { NO_LIST };
            if has_list && (squared_radius.is_nan() || squared_radius < 0.0) {
                bad = bad.min(vertex);
            }
            // No square of a distance is greater than the greatest number.
            memory::push(
                &mut placed,
                PlacedVertex { place, squared_radius: squared_radius.min(f64::MAX), vertex },
            )?;
        }
        if bad == VertexId::NONE {
            return Ok(placed);
        }
        Err(self.refused(bad, "0 or more"))
    }

    /// Says that the radius of the list of a vertex is not what is wanted.
    pub(crate) fn refused(&self, vertex: VertexId, wanted: &'static str) -> Error {
        let index = if self.squared_radii.len() == 1 { 0 } else { vertex.index() };
        Error::InvalidValue { argument: "squared_radii", index, value: self.squared_radius(vertex), wanted }
    }

    fn squared_radius(&self, vertex: VertexId) -> f64 {
        let index = if self.squared_radii.len() == 1 { 0 } else { vertex.index() };
        self.squared_radii[index]
    }
}

/// The lists of all vertices.
pub(crate) struct Lists<E> {
    /// Where the list of each id begins; then where the last one ends.
    pub(crate) offsets: Vec<usize>,
    /// Whose they are, in the order in which they have been found.
    vertices: Vec<VertexId>,
    parts: Vec<Part<E>>,
}

impl<E: Entry> Lists<E> {
    /// Searches; a monitor is told the fraction done.
    pub(crate) fn find<G: Moving>(
        search: &Search<'_, G>,
        id_count: usize,
        threads: Threads,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Self> {
        let placed = &search.tree.placed;
        let mut lists = Lists { offsets: Vec::new(), vertices: Vec::new(), parts: Vec::new() };
        memory::lengthen(&mut lists.offsets, id_count + 1, 0)?;
        memory::collect(&mut lists.vertices, placed.iter().map(|p| p.vertex))?;
        let (mut begin, mut n_next) = (0, SHARED_AT_LEAST);
        while begin < placed.len() {
            let n = n_next.min(placed.len() - begin);
            let n_threads = threads.for_work(n, SHARED_AT_LEAST, 64);
            let mut n_found = 0;
            for part in for_ranges(n, n_threads, |part| search.lists(begin + part.start..begin + part.end))? {
                let part = part?;
                n_found += part.lengths.iter().sum::<usize>();
                memory::push(&mut lists.parts, part)?;
            }
            begin += n;
            if !monitor(begin as f64 / placed.len() as f64) {
                return Err(Error::Cancelled);
            }
            // What is looked at is some times what is found.
            n_next = (WORK * n / (8 * (n_found + n))).clamp(1, 64 * SHARED_AT_LEAST);
        }
        let lengths = lists.parts.iter().flat_map(|part| &part.lengths);
        for (vertex, &length) in lists.vertices.iter().zip(lengths) {
            lists.offsets[vertex.index() + 1] = length;
        }
        let mut sum = 0;
        lists.offsets.iter_mut().for_each(|offset| {
            sum += *offset;
            *offset = sum;
        });
        Ok(lists)
    }

    /// The number of entries of all.
    pub(crate) fn n_entries(&self) -> usize {
        self.offsets[self.offsets.len() - 1]
    }

    /// Visits the lists: of which vertex each is, where it begins, and its entries.
    pub(crate) fn for_each(&self, mut visit: impl FnMut(VertexId, usize, &[E])) {
        let mut vertices = self.vertices.iter();
        for part in &self.parts {
            let mut rest = &part.entries[..];
            for (&length, &vertex) in part.lengths.iter().zip(&mut vertices) {
                let (list, others) = rest.split_at(length);
                visit(vertex, self.offsets[vertex.index()], list);
                rest = others;
            }
        }
    }
}

/// The vertices near each vertex.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NeighbourLists {
    /// Where the list of each id begins; then where the last one ends.
    pub offsets: Vec<usize>,
    /// The lists.
    pub neighbours: Vec<VertexId>,
    /// Of a set that repeats, in which period each entry is, as multiples of the vectors; else none.
    pub shifts: Vec<[i64; 3]>,
}

impl<G: Moving> MovingTriangulation<G> {
    /// For each vertex the others whose squared distance from it is at most that of its list, exactly: ascending, hidden ones
    /// included, which have lists as well.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{ListsOf, MovingTriangulation, Options}};
    ///
    /// let points = [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0], [4.0, 3.0]];
    /// let t = MovingTriangulation::<Plane>::new(&points, Options::default())?;
    /// let mut wanted = ListsOf { squared_radii: &[16.0], mask: None, is_half: false };
    /// let lists = t.neighbour_lists(&wanted)?;
    /// assert_eq!(lists.offsets, [0, 2, 4, 6, 8]);
    /// assert_eq!(lists.neighbours[..4], [1, 2, 0, 3].map(VertexId::new));
    /// wanted.is_half = true;
    /// assert_eq!(t.neighbour_lists(&wanted)?.offsets, [0, 2, 3, 4, 4]);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::WrongCount`] unless there is one radius, or one for each id, and an entry of the mask for each id;
    /// [`Error::InvalidValue`] for the square of the radius of a list that is negative or NaN, [`Error::OutOfMemory`].
    pub fn neighbour_lists(&self, wanted: &ListsOf<'_>) -> Result<NeighbourLists> {
        let lists = self.lists_of(wanted, true, &mut |_| true)?;
        let mut neighbours = Vec::new();
        memory::lengthen(&mut neighbours, lists.n_entries(), VertexId::NONE)?;
        lists.for_each(|_, begin, list| {
            neighbours[begin..begin + list.len()].iter_mut().zip(list).for_each(|(v, e)| *v = e.parts().0);
        });
        Ok(NeighbourLists { offsets: lists.offsets, neighbours, shifts: Vec::new() })
    }

    /// Finds the [`neighbour_lists`](Self::neighbour_lists), or only how long they are; a monitor is told the fraction done.
    pub(crate) fn lists_of(
        &self,
        wanted: &ListsOf<'_>,
        is_kept: bool,
        monitor: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Lists<u32>> {
        wanted.check(self.id_count())?;
        let kernel = &self.mesh.kernel;
        // In the order of storage, which is mostly one of space.
        let shown = kernel.live_sites().map(|s| (kernel.site(s).id, kernel.site(s).point));
        let n_looked_at = if self.hidden_count() > 0 { self.id_count() } else { 0 };
        let hidden =
            self.mesh.standings().take(n_looked_at).filter_map(|(vertex, standing)| match standing {
                Standing::Hidden(s) => Some((vertex, kernel.site(s).point)),
                _ => None,
            });
        let vertices = shown.chain(hidden);
        let search = Search::<G> {
            tree: BoxTree::new(wanted.placed(vertices, self.vertex_count())?)?,
            translations: &[G::Point::default()],
            nowhere: 0,
            is_half: wanted.is_half,
            is_kept,
        };
        Lists::find(&search, self.id_count(), self.threads(), monitor)
    }
}
