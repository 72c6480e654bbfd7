//! The kernel: a Delaunay triangulation of *sites* under insertion, removal and relocation.
//!
//! Written once for both dimensions, over [`Geometry`]. Ties between signs are broken by the keys of the sites' vertices,
//! by default their ids (see [`crate::predicates`]), so the cells are a function of the live sites alone: whatever the order of
//! insertions, removals and relocations, they are those of a fresh build.
//!
//! | file | what |
//! |---|---|
//! | `shape` | the two dimensions, as types, and the arrays that have a length for each |
//! | `signs`, `lane_tests`, `exchange`, `geometry` | what differs between them, by what it is for |
//! | `plane`, `space` | how they do it |
//! | `order` | Hilbert curve and insertion rounds |
//! | `inserting` | many sites, one after the other |
//! | `build` | all sites at once |
//! | `parts`, `parallel`, `unite` | the same on several threads |
//! | `locate`, `straight`, `landmarks` | the walk, and where it begins |
//! | `around`, `star` | the cells around a site, for questions and for changes |
//! | `cavity`, `cavity_plane`, `cavity_space`, `cavity_marked` | insertion: dig the conflict zone, fill it |
//! | `above`, `settling`, `cone` | sites that weights hide, with cells and without |
//! | `remove`, `hole`, `wrapping` | removal: fill the star by gift wrapping, in lanes where that is certain |
//! | `high_degree` | removal of a vertex of high degree |
//! | `relocate` | one site to a new place |
//! | `flip`, `flipper`, `flips` | flips, on several threads, and undoing them |
//! | `undo` | undoing any change |
//! | `changes` | a record of the cells made or moved |
//! | `successor` | a kernel to be built beside another one |
//! | `covering` | the static filter, and the box for which it holds |
//! | `copying`, `restoring` | a copy of a kernel; one of cells that are known, all of them checked |
//! | `certify`, `uncertain`, `failures` | all certificates at once |
//! | `sample` | those of a few cells |
//! | `keys` | what ties are broken by |
//! | `flat` | fewer than `D + 1` sites, or all in one hyperplane: no cells |
//! | `validate` | the exact check of everything |
//! | `set` | small sets of indices |
//!
//! **Ghost cells.** A ghost cell stands for what lies beyond a facet of the convex hull. A point is in conflict
//! with it if it is strictly beyond the facet's hyperplane; if it is in the hyperplane, exactly if it is in
//! conflict with the finite cell behind the facet: the affine dependency of the `D + 2` points does not involve
//! that cell's opposite corner, so the perturbed sign is the one in the hyperplane.

#![allow(unsafe_code)]

mod above;
mod around;
mod build;
mod cavity;
mod cavity_marked;
mod cavity_plane;
mod cavity_space;
mod certify;
mod changes;
mod cone;
mod copying;
mod covering;
mod exchange;
mod facets;
mod failures;
mod flat;
mod flip;
mod flipper;
mod flips;
mod geometry;
mod high_degree;
mod hole;
mod in_space;
mod inserting;
mod keys;
mod landmarks;
mod lane_tests;
mod locate;
mod meetings;
pub mod order;
mod parallel;
mod parts;
mod plane;
mod relocate;
mod remove;
mod restoring;
mod sample;
mod segments;
mod set;
mod settling;
mod shape;
mod signs;
pub mod site;
mod space;
mod spheres;
mod star;
mod straight;
mod successor;
mod uncertain;
mod undo;
mod unite;
mod validate;
mod winding;
mod wrapping;

pub use build::Merge;
pub use cavity::Insertion;
pub(crate) use certify::Waiting;
pub(crate) use facets::Mix;
pub use failures::Failures;
pub(crate) use flips::CERTIFICATES_PER_EXACT;
pub use geometry::{Dimension, Geometry, Moving};
pub(crate) use keys::Keys;
pub use locate::Place;
pub use relocate::{Relocation, Shortcut};
pub(crate) use restoring::Rows;
pub(crate) use sample::Joint;
pub(crate) use segments::{Crossing, InTheWay, Replaced};
pub(crate) use set::IndexSet;
pub use shape::{Plane, PowerPlane, PowerSpace, Shape, Space};
pub use site::Site;
pub(crate) use undo::KeptChange;
pub use validate::{Level, Violation};

use crate::complex::{Complex, Corners, Facet};
use crate::error::{Error, Result};
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::machine::pace::Pace;
use crate::machine::prefetch::prefetch;
use crate::machine::threads::Threads;
use crate::predicates::StaticFilter;
use above::Above;
use cavity::Cavity;
use flat::Flat;
use flip::AllFlips;
use geometry::Insert;
use hole::Hole;
use parts::Parts;
use wrapping::Wrapping;

/// What the ghost vertex has for an id.
const GHOST: VertexId = VertexId::new(0);

/// A Delaunay triangulation of sites.
#[derive(Debug)]
pub struct Delaunay<G: Geometry> {
    sites: Vec<Site<G>>,
    /// What ranks the vertices at the sites.
    keys: Keys,
    free_sites: Vec<SiteId>,
    parts: Parts,
    complex: Complex<G::Corners>,
    /// Edges that have to be there, the lower site first, sorted.
    required: Vec<[SiteId; 2]>,
    /// Whether the cells are constrained by these edges, and not Delaunay.
    is_constrained: bool,
    filter: StaticFilter,
    lower: G::Point,
    upper: G::Point,
    /// What stands in for cells while there are none.
    flat: Flat<G>,
    /// Whether the cells have been [sorted](Self::sort_cells) since the latest build.
    is_sorted: bool,
    /// How many slots have got other cells since they were sorted, counted once in each change.
    n_replaced: usize,
    /// A live cell, near the latest change.
    recent: Slot,
    /// The site relocated last; a hint: it may have gone.
    relocated: SiteId,
    landmarks: landmarks::Landmarks,
    cavity: Cavity<G>,
    /// The sites that weights hide.
    above: Above,
    /// The star gathered last: its cells, and the index of the site in each.
    star: Vec<(Slot, u8)>,
    /// The hole that the star gathered last would leave, once there was one.
    hole: Option<Box<Hole<G>>>,
    /// Memory for gift wrapping in lanes, once a site has been removed.
    wrapping: Option<Box<Wrapping>>,
    /// The cells of the star gathered last, once there was one.
    around: Option<Box<IndexSet<Slot>>>,
    /// The latest flips, once there were any.
    flips: Option<Box<AllFlips<G>>>,
    log: undo::Log<G>,
    /// Cells made, or moved, since [`record_changes`](Delaunay::record_changes); `None` if no record is kept.
    changed: Option<Vec<Slot>>,
    /// Certificates evaluated by relocations so far.
    certificates: u64,
    /// Sites of links that have been triangulated in removals of vertices of high degree.
    link_sites: u64,
    threads: Threads,
    /// Whom long changes ask whether to go on.
    pace: Pace,
}

impl<G: Geometry> Default for Delaunay<G> {
    /// # Panics
    /// Where there is no memory for a single site.
    fn default() -> Self {
        Delaunay::on(Threads::ONE).expect("memory for a site")
    }
}

impl<G: Geometry> Delaunay<G> {
    /// Index of the last corner, the one that is infinite in a ghost cell.
    const LAST: usize = G::D;

    /// A triangulation of nothing, without even the placeholder for the ghost vertex.
    pub(crate) fn empty() -> Self {
        Self::empty_on(Threads::ONE)
    }

    /// A triangulation of nothing, as [`empty`](Self::empty) makes it, that uses several threads. Inlined, it is made
    /// where it is going to be: it has some kilobytes.
    #[inline(always)]
    pub(crate) fn empty_on(threads: Threads) -> Self {
        let origin = G::Point::default();
        Delaunay {
            sites: Vec::new(),
            keys: Keys::default(),
            free_sites: Vec::new(),
            parts: Parts::default(),
            complex: Complex::default(),
            required: Vec::new(),
            is_constrained: false,
            filter: G::filter(&origin, &origin),
            lower: origin,
            upper: origin,
            flat: Flat::default(),
            is_sorted: false,
            n_replaced: 0,
            recent: Slot::new(0),
            relocated: SiteId::NONE,
            landmarks: Default::default(),
            cavity: Cavity::default(),
            above: Above::default(),
            star: Vec::new(),
            hole: None,
            wrapping: None,
            around: None,
            flips: None,
            log: undo::Log::default(),
            changed: None,
            certificates: 0,
            link_sites: 0,
            threads,
            pace: Pace::default(),
        }
    }

    /// A triangulation without sites that uses several threads.
    pub(crate) fn on(threads: Threads) -> Result<Self> {
        let mut t = Self::empty_on(threads);
        t.begin_sites(0)?;
        Ok(t)
    }

    /// Makes room for the first `n` sites, and puts the placeholder before them unless it is there.
    fn begin_sites(&mut self, n: usize) -> Result<()> {
        if !self.sites.is_empty() {
            return self.reserve_sites(n);
        }
        self.reserve_sites(n + 1)?;
        self.sites.push(Site::new(G::Point::default(), GHOST));
        Ok(())
    }

    /// The cells.
    pub fn complex(&self) -> &Complex<G::Corners> {
        &self.complex
    }

    /// All sites by index; 0 is a placeholder, and free indices are not [live](Site::is_live).
    pub fn sites(&self) -> &[Site<G>] {
        &self.sites
    }

    /// The keys of vertices.
    #[inline(always)]
    pub(crate) fn keys(&self) -> &Keys {
        &self.keys
    }

    /// The keys of vertices, of which those may be changed that are in no cell.
    pub(crate) fn keys_mut(&mut self) -> &mut Keys {
        &mut self.keys
    }

    /// All sites by index, to write places without any change to the cells.
    pub(crate) fn sites_mut(&mut self) -> &mut [Site<G>] {
        &mut self.sites
    }

    /// The sites, as predicates read them.
    #[inline(always)]
    fn view(&self) -> site::Sites<'_, G> {
        site::Sites::new(&self.sites, &self.keys)
    }

    /// The place of a corner of a cell, not the ghost vertex.
    #[inline(always)]
    pub(crate) fn place(&self, s: SiteId) -> &G::Point {
        self.view().point(s)
    }

    /// The places of the corners of a finite cell; in the plane the last one is there twice.
    #[inline(always)]
    pub(crate) fn places(&self, cell: Slot) -> [&G::Point; 4] {
        self.view().points(&self.complex.cell(cell).corners)
    }

    /// The site of an index.
    #[inline(always)]
    pub fn site(&self, s: SiteId) -> &Site<G> {
        &self.sites[s]
    }

    /// Indices of the live sites.
    pub fn live_sites(&self) -> impl Iterator<Item = SiteId> + Clone + '_ {
        SiteId::range(1..self.sites.len()).filter(|&s| self.sites[s].is_live())
    }

    /// Whether there are cells.
    #[inline(always)]
    pub fn has_cells(&self) -> bool {
        self.complex.n_slots() != 0
    }

    /// Record of a corner of a cell, the ghost vertex included.
    #[inline(always)]
    fn corner_mut(&mut self, s: SiteId) -> &mut Site<G> {
        debug_assert!(s.index() < self.sites.len());
        // SAFETY: a corner of a cell is the index of a site, by the kernel's invariants.
        unsafe { self.sites.get_unchecked_mut(s.index()) }
    }

    /// Adds a site that is in no cell yet: to be followed by [`rebuild`](Self::rebuild) or by the rest of an
    /// insertion.
    pub fn add_site(&mut self, point: G::Point, id: VertexId) -> Result<SiteId> {
        let site = Site::new(point, id);
        if let Some(&s) = self.free_sites.last() {
            self.log_site(s)?;
            self.free_sites.pop();
            self.sites[s] = site;
            return Ok(s);
        }
        // Site indices end below the sentinel.
        if self.sites.len() >= u32::MAX as usize {
            return Err(Error::TooManyVertices { given: self.sites.len(), limit: u32::MAX as usize - 1 });
        }
        // To discard it needs an entry in the other list, and must not fail.
        memory::reserve(&mut self.free_sites, 1)?;
        if self.sites.len() == self.sites.capacity() {
            self.reserve_sites(1.max(self.sites.len() / 8))?;
        }
        // A free one, which is named like any other.
        let s = SiteId::at(self.sites.len());
        self.sites.push(Site::new(point, VertexId::NONE));
        if let Err(error) = self.log_site(s) {
            self.sites.pop();
            return Err(error);
        }
        self.sites[s] = site;
        Ok(s)
    }

    /// Makes room for `n` more sites.
    pub fn reserve_sites(&mut self, n: usize) -> Result<()> {
        memory::reserve_exact(&mut self.sites, n)
    }

    /// Frees a site that is in no cell.
    pub fn discard_site(&mut self, s: SiteId) -> Result<()> {
        memory::reserve(&mut self.free_sites, 1)?;
        self.drop_site(s);
        Ok(())
    }

    /// Frees a site; there is room for it in the list, as it has been logged or [counted](Self::merge).
    fn drop_site(&mut self, s: SiteId) {
        self.sites[s].id = VertexId::NONE;
        self.free_sites.push(s);
    }

    /// Writes a place without any change to the cells; [`rebuild`](Self::rebuild) must follow.
    #[inline(always)]
    pub fn set_point(&mut self, s: SiteId, point: G::Point) {
        self.sites[s].point = point;
    }

    /// Whom long changes ask whether to go on.
    pub(crate) fn pace_mut(&mut self) -> &mut Pace {
        &mut self.pace
    }

    /// Asks whether to go on, where that is due. A step of a change begins with it, so that none is half made.
    #[inline(always)]
    fn go_on(&mut self) -> Result<()> {
        if self.pace.is_due() { self.ask() } else { Ok(()) }
    }

    #[cold]
    fn ask(&mut self) -> Result<()> {
        // What is no part of a change could not be taken back.
        if self.is_in_change() { self.pace.ask_again() } else { Ok(()) }
    }

    /// How many threads a call may use.
    pub(crate) fn threads(&self) -> Threads {
        self.threads
    }

    /// Whether `q`, with ties broken as those of vertex `id`, is in conflict with a cell.
    #[inline(always)]
    pub(crate) fn is_in_conflict(&self, cell: Slot, q: &G::Point, id: VertexId) -> bool {
        self.is_in_conflict_with(&self.filter, cell, q, id)
    }

    /// Whether `q`, for which `f` must hold, is in conflict with a cell, with ties broken as those of vertex `id`.
    #[inline(always)]
    pub(crate) fn is_in_conflict_with(
        &self,
        f: &StaticFilter,
        cell: Slot,
        q: &G::Point,
        id: VertexId,
    ) -> bool {
        let c = self.complex.cell(cell);
        if c.is_ghost() {
            return self.is_in_conflict_with_ghost(f, cell, q, id);
        }
        G::is_in_sphere(f, self.view(), &c.corners, q, id)
    }

    #[inline(never)]
    fn is_in_conflict_with_ghost(&self, f: &StaticFilter, cell: Slot, q: &G::Point, id: VertexId) -> bool {
        let beyond = self.orientation_beyond(f, cell, q);
        if beyond != 0.0 {
            return beyond > 0.0;
        }
        let c = self.complex.cell(cell);
        let behind = self.complex.cell(c.neighbour(Self::LAST).cell());
        G::is_in_sphere(f, self.view(), &behind.corners, q, id)
    }

    /// On which side of the hull facet of a ghost cell `q` is, for which `f` must hold: positive beyond, 0 in its line
    /// or plane.
    #[inline(always)]
    pub(crate) fn orientation_beyond(&self, f: &StaticFilter, ghost: Slot, q: &G::Point) -> f64 {
        G::orientation_with(f, self.view(), &self.complex.cell(ghost).corners, Self::LAST, q)
    }

    /// How many certificates relocations have evaluated so far.
    pub fn certificates(&self) -> u64 {
        self.certificates
    }

    /// How many sites of links removals of vertices of high degree have triangulated so far.
    pub(crate) fn link_sites(&self) -> u64 {
        self.link_sites
    }

    /// Counts certificates.
    pub(crate) fn count_certificates(&mut self, n: usize) {
        self.certificates += n as u64;
    }

    /// Visits each facet of these cells, which are live and listed once, exactly once.
    pub(crate) fn for_facets_of(&mut self, cells: &[Slot], mut visit: impl FnMut(&Self, Facet)) {
        for &c in cells {
            self.complex.set_mark(c, 1);
        }
        for &c in cells {
            for i in 0..G::Corners::N {
                let across = self.complex.cell(c).neighbour(i).cell();
                if c < across || self.complex.mark(across) == 0 {
                    visit(self, Facet::new(c, i));
                }
            }
        }
        for &c in cells {
            self.complex.set_mark(c, 0);
        }
    }

    /// Prefetches what a check of the bi-cell of a facet needs, except for the vertex beyond.
    #[inline(always)]
    pub(crate) fn prefetch_bicell(&self, facet: Facet) {
        let cell = self.complex.cell(facet.cell());
        // A free cell has corners that are no sites; they are only asked for.
        for i in 0..G::Corners::N {
            prefetch(&self.sites, cell.corners[i].index());
        }
        prefetch(self.complex.cells(), cell.neighbour(facet.index()).cell().index());
    }

    /// Bytes held.
    pub fn memory_bytes(&self) -> usize {
        memory::bytes_of(&self.sites)
            + self.keys.memory_bytes()
            + memory::bytes_of(&self.free_sites)
            + self.parts.memory_bytes()
            + self.complex.memory_bytes()
            + self.flat.memory_bytes()
            + self.landmarks.memory_bytes()
            + self.cavity.scratch.memory_bytes()
            + self.above.memory_bytes()
            + memory::bytes_of(&self.star)
            + memory::bytes_of_made(&self.hole, Hole::memory_bytes)
            + memory::bytes_of_made(&self.wrapping, |_| 0)
            + memory::bytes_of_made(&self.around, IndexSet::memory_bytes)
            + memory::bytes_of_made(&self.flips, AllFlips::memory_bytes)
            + self.log.memory_bytes()
            + self.changed.as_ref().map_or(0, memory::bytes_of)
            + self.pace.memory_bytes()
    }
}
