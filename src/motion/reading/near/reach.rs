//! The cells and the hull facets that a point in a box could change, and their vertices.
//!
//! A cell is in reach of a box if its closed ball meets the box, a facet of the hull if the box has a place strictly
//! beyond it. Of a new vertex at a place x, these are all that it could remove, whatever its id: ties count as in the
//! ball. For a place in the plane of a hull facet ties are those of the cell behind it, so that this is in reach where the
//! facet would be.
//!
//! In a Delaunay triangulation the cells and ghost cells in reach of a convex box are connected by facets.
//! - Those of one place x are. On the straight way from a place in one of the cells to x, the power of x falls from each
//!   cell to the next, so all of them are in reach, until one has x in its closure, and these are the star of a face; or
//!   until the way leaves the hull, by a facet that x is strictly beyond, and the facets that are seen from a place are
//!   connected.
//! - If those of a box were two parts without a facet in common, the places with cells of the one and those with cells of
//!   the other would fill the box, so a place x of the second would be the limit of places of the first, all with the same
//!   cells. A finite one would be in reach of x, too, as its ball is closed. So they are facets that x is in the planes of,
//!   and beyond none, and they are all facets in a plane. One of these facets has x, and the cell behind it is in reach of
//!   x: the two have a facet in common.
//!
//! So a flood finds all of them from the located cell of one place of the box. In a constrained triangulation it finds
//! those that are connected with the cells that have a place of the box; all that an insertion would remove are.
//!
//! # With weights
//!
//! Let W be the greatest of the weights of what may be in the box and of all vertices. A cell is in reach of a place x if the power
//! of x in respect of it is at most W: all that a vertex of a weight up to W could remove, and all that have x in their closure. Of the
//! latter the power is a mean of weights of corners, less one of squares of distances from them, and so at most W. So what is said
//! of balls above is true of reaches, and each vertex in the box, whether the cells show it or hide it, is in a cell that is told.

use std::collections::HashMap;

use crate::complex::INFINITE;
use crate::delaunay::{Delaunay, IndexSet, Moving, Place};
use crate::error::{Error, Result};
use crate::ids::{CellId, SiteId, Slot, VertexId};
use crate::machine::memory;
use crate::machine::prefetch::prefetch;
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::{MAX_MAGNITUDE, PointArray, Reach};

/// The cells and hull facets in reach of boxes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct InReach {
    /// Cells, ascending.
    pub cells: Vec<CellId>,
    /// Facets of the hull: the cell behind each, and its corner opposite the facet; ascending.
    pub hull: Vec<(CellId, usize)>,
}

/// The vertices in reach of each box.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VerticesInReach {
    /// Where the list of each box begins; then where the last one ends.
    pub offsets: Vec<usize>,
    /// The lists, each ascending.
    pub vertices: Vec<VertexId>,
}

/// The sides of a box that vertices can be at, `None` if there is none; both of the weight of the upper one, or of this, if it is greater.
fn in_range<G: Moving>(low: &G::Point, high: &G::Point, greatest: f64) -> Option<[G::Point; 2]> {
    let [mut lower, mut upper] =
        [low, high].map(|side| G::Point::at(side.coordinates(), high.weight().max(greatest)));
    for axis in 0..G::D {
        lower[axis] = low[axis].max(-MAX_MAGNITUDE);
        upper[axis] = high[axis].min(MAX_MAGNITUDE);
    }
    (0..G::D).all(|axis| lower[axis] <= upper[axis]).then_some([lower, upper])
}

/// A place of a box, near the middle of what it shares with another one, or near that.
fn place_near<G: Moving>([low, high]: &[G::Point; 2], lower: &G::Point, upper: &G::Point) -> G::Point {
    let mut place = *low;
    for axis in 0..G::D {
        let [least, most] = [low[axis], high[axis]].map(|x| x.clamp(lower[axis], upper[axis]));
        place[axis] = f64::midpoint(least, most).clamp(low[axis], high[axis]);
    }
    place
}

/// Memory of a flood, kept from one to the next.
#[derive(Debug, Default)]
struct Flood<P: Reach> {
    seen: IndexSet<Slot>,
    /// The cells in reach, ghost cells included.
    reached: Vec<Slot>,
    /// Centres of cells that rounded numbers did not suffice for: there are as many boxes as are asked about at a time for
    /// each of these cells, which may be nearly all where vertices are on a line.
    centres: HashMap<Slot, P::Centre>,
}

impl<P: Reach + Copy> Flood<P> {
    /// Lists all cells in reach of a box, ghost cells included; `near` is where to begin to look for it.
    fn list<G>(&mut self, kernel: &Delaunay<G>, within: &[P; 2], near: Slot) -> Result<()>
    where
        G: Moving<Point = P>,
    {
        self.seen.clear();
        self.reached.clear();
        let first = match kernel.locate(&place_near::<G>(within, &kernel.lower(), &kernel.upper()), near) {
            Place::Site(s) => behind(kernel, kernel.site(s).cell),
            Place::Cell(c) | Place::Outside(c) => c,
            Place::NoCells => return Ok(()),
        };
        self.seen.insert(first)?;
        memory::push(&mut self.reached, first)?;
        let mut next = 0;
        while let Some(&cell) = self.reached.get(next) {
            next += 1;
            for i in 0..=G::D {
                let across = kernel.complex().cell(cell).neighbour(i).cell();
                if self.seen.insert(across)? && self.is_in_reach(kernel, across, within)? {
                    for j in 0..=G::D {
                        prefetch(
                            kernel.complex().cells(),
                            kernel.complex().cell(across).neighbour(j).cell().index(),
                        );
                    }
                    memory::push(&mut self.reached, across)?;
                }
            }
        }
        Ok(())
    }

    /// Whether a cell, maybe a ghost cell, is in reach of a box.
    #[inline(always)]
    fn is_in_reach<G>(&mut self, kernel: &Delaunay<G>, slot: Slot, [low, high]: &[P; 2]) -> Result<bool>
    where
        G: Moving<Point = P>,
    {
        let places = kernel.places(slot);
        if kernel.complex().cell(slot).is_ghost() {
            return Ok(P::does_half_space_meet(&places[..G::D], low, high));
        }
        let cell = &places[..=G::D];
        match P::does_ball_surely_meet(cell, low, high) {
            Some(does) => Ok(does),
            None => Ok(P::does_ball_meet(cell, &self.centre(slot, cell)?, low, high)),
        }
    }

    #[cold]
    #[inline(never)]
    fn centre(&mut self, slot: Slot, cell: &[&P]) -> Result<P::Centre> {
        memory::reserve_map(&mut self.centres, 1)?;
        Ok(*self.centres.entry(slot).or_insert_with(|| P::exact_centre(cell)))
    }
}

/// A cell, or the finite cell behind a ghost cell.
fn behind<G: Moving>(kernel: &Delaunay<G>, slot: Slot) -> Slot {
    let cell = kernel.complex().cell(slot);
    if cell.is_ghost() { cell.neighbour(G::D).cell() } else { slot }
}

impl<G: Moving> MovingTriangulation<G> {
    /// A mask of vertices has an entry for each id.
    pub(crate) fn check_vertex_mask(&self, given: usize) -> Result<()> {
        let wanted = self.id_count();
        if given == wanted {
            Ok(())
        } else {
            Err(Error::WrongCount { argument: "mask_count", given, wanted, coming: 0 })
        }
    }

    /// The cells and the facets of the convex hull that a vertex at a place in one of some boxes could change: the cells
    /// of which the closed ball meets one of the closed boxes, and the facets that a place in a box is strictly beyond.
    /// Exactly these. Each box is between an entry of `low` and that of `high`, whose coordinates may be infinite; only
    /// places in the range of coordinates count. A box is empty if one of `low` is above that of `high`. With a mask,
    /// which has an entry for each id, only those with a corner at whose place is a vertex of an entry that is not 0.
    ///
    /// With weights a vertex in a box may have a weight up to that of the entry of `high`, or up to the greatest that there is, if
    /// that is greater; in place of the ball counts the reach for this weight. A vertex of the mask counts if it is a corner.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let points = [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0], [4.0, 3.0], [9.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&points, Options::default())?;
    /// let (low, high) = ([f64::NEG_INFINITY; 2], [-0.6, f64::INFINITY]);
    /// // The circle around the square, with its centre at (2, 1.5), ends at -0.5. All facets of the hull have places of the
    /// // boxes beyond them.
    /// let reach = t.cells_in_reach(&[low], &[high], None)?;
    /// assert_eq!((reach.cells.len(), reach.hull.len()), (0, 5));
    /// let reach = t.cells_in_reach(&[low], &[[-0.5, f64::INFINITY]], None)?;
    /// assert_eq!((reach.cells.len(), reach.hull.len()), (2, 5));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::WrongCount`] unless there are as many of `high` as of `low`, and an entry of the mask for each id,
    /// [`Error::InvalidValue`] for NaN, [`Error::OutOfMemory`].
    pub fn cells_in_reach(
        &self,
        low: &[G::Point],
        high: &[G::Point],
        mask: Option<&[u8]>,
    ) -> Result<InReach> {
        self.check_boxes(low, high)?;
        mask.map_or(Ok(()), |mask| self.check_vertex_mask(mask.len()))?;
        let mut found = InReach::default();
        let kernel = &self.mesh.kernel;
        if !kernel.has_cells() {
            return Ok(found);
        }
        let cells = self.cell_arrays()?;
        let mut flood = Flood::<G::Point>::default();
        let greatest = self.greatest_weight();
        for within in low.iter().zip(high).filter_map(|(low, high)| in_range::<G>(low, high, greatest)) {
            let near = flood.reached.first().copied().unwrap_or(Slot::NONE);
            flood.list(kernel, &within, near)?;
            for &slot in flood.reached.iter().filter(|&&slot| self.has_masked(slot, mask)) {
                let cell = kernel.complex().cell(slot);
                if cell.is_ghost() {
                    memory::push(&mut found.hull, cells.shown(cell.neighbour(G::D)))?;
                } else {
                    memory::push(&mut found.cells, cells.index_of()[slot])?;
                }
            }
        }
        found.cells.sort_unstable();
        found.cells.dedup();
        found.hull.sort_unstable();
        found.hull.dedup();
        Ok(found)
    }

    /// For each box the vertices of the cells and hull facets in its reach of which the entry in the mask is not 0, all
    /// without a mask, hidden ones included: see [`cells_in_reach`](Self::cells_in_reach). While there are no cells, a
    /// vertex anywhere could change everything: all of the mask are in reach of each box that is not empty. With weights
    /// hidden ones are not told where there are cells.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let points = [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0], [4.0, 3.0], [9.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&points, Options::default())?;
    /// let reach = t.vertices_in_reach(&[[-7.0, 0.0], [4.0, 3.0]], &[[-7.0, 1.0], [4.0, 3.0]], None)?;
    /// assert_eq!(reach.offsets, [0, 2, 7]);
    /// assert_eq!(reach.vertices[..2], [0, 2].map(VertexId::new));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`cells_in_reach`](Self::cells_in_reach).
    pub fn vertices_in_reach(
        &self,
        low: &[G::Point],
        high: &[G::Point],
        mask: Option<&[u8]>,
    ) -> Result<VerticesInReach> {
        self.check_boxes(low, high)?;
        mask.map_or(Ok(()), |mask| self.check_vertex_mask(mask.len()))?;
        let mut found = VerticesInReach::default();
        memory::reserve_exact(&mut found.offsets, low.len() + 1)?;
        found.offsets.push(0);
        let kernel = &self.mesh.kernel;
        let (mut flood, mut sites) = (Flood::<G::Point>::default(), IndexSet::new());
        let greatest = self.greatest_weight();
        for (low, high) in low.iter().zip(high) {
            let first = found.vertices.len();
            match in_range::<G>(low, high, greatest) {
                Some(within) if kernel.has_cells() => {
                    let near = flood.reached.first().copied().unwrap_or(Slot::NONE);
                    flood.list(kernel, &within, near)?;
                    self.list_corners(&flood.reached, &mut sites)?;
                    self.list_masked(sites.as_slice().iter().copied(), mask, &mut found.vertices)?;
                }
                Some(_) => self.list_masked(kernel.live_sites(), mask, &mut found.vertices)?,
                None => {}
            }
            found.vertices[first..].sort_unstable();
            found.offsets.push(found.vertices.len());
        }
        Ok(found)
    }

    /// The greatest weight of a vertex; with the weights of boxes it says what a reach is. Without weights, 0.
    pub(in crate::motion::reading) fn greatest_weight(&self) -> f64 {
        if !G::HAS_WEIGHTS {
            return 0.0;
        }
        let kernel = &self.mesh.kernel;
        kernel.live_sites().fold(f64::NEG_INFINITY, |most, s| most.max(kernel.site(s).point.weight()))
    }

    /// Boxes have two corners each, of numbers.
    fn check_boxes(&self, low: &[G::Point], high: &[G::Point]) -> Result<()> {
        if low.len() != high.len() {
            let (given, wanted) = (high.len(), low.len());
            return Err(Error::WrongCount { argument: "the length of high", given, wanted, coming: 0 });
        }
        for (argument, corners) in [("low", low), ("high", high)] {
            let coordinates = corners.iter().flat_map(|corner| (0..G::D).map(|axis| corner[axis]));
            if let Some((index, value)) = coordinates.enumerate().find(|(_, x)| x.is_nan()) {
                let wanted = "a number or infinite";
                return Err(Error::InvalidValue { argument, index, value, wanted });
            }
        }
        Ok(())
    }

    /// Whether a vertex of the mask is at a corner of a cell.
    fn has_masked(&self, slot: Slot, mask: Option<&[u8]>) -> bool {
        let Some(mask) = mask else { return true };
        let corners = self.mesh.kernel.complex().cell(slot).corners;
        corners.as_ref().iter().filter(|&&s| s != INFINITE).any(|&s| {
            let mut is_masked = false;
            let id = self.mesh.kernel.site(s).id;
            self.mesh.hidden.for_all_at(id, |v| is_masked |= mask[v.index()] != 0);
            is_masked
        })
    }

    /// Enters the corners of some cells into a set, which is emptied first.
    fn list_corners(&self, cells: &[Slot], sites: &mut IndexSet<SiteId>) -> Result<()> {
        sites.clear();
        for &slot in cells {
            let corners = self.mesh.kernel.complex().cell(slot).corners;
            for &s in corners.as_ref().iter().filter(|&&s| s != INFINITE) {
                sites.insert(s)?;
            }
        }
        Ok(())
    }

    /// Lists the vertices of the mask at some sites.
    fn list_masked(
        &self,
        sites: impl Iterator<Item = SiteId>,
        mask: Option<&[u8]>,
        vertices: &mut Vec<VertexId>,
    ) -> Result<()> {
        for s in sites {
            let mut entered = Ok(());
            self.mesh.hidden.for_all_at(self.mesh.kernel.site(s).id, |v| {
                if entered.is_ok() && mask.is_none_or(|mask| mask[v.index()] != 0) {
                    entered = memory::push(vertices, v);
                }
            });
            entered?;
        }
        Ok(())
    }
}
