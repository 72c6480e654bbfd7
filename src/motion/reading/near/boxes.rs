//! The vertices in a box.
//!
//! The cells that meet a convex set are connected by facets, if what is outside the hull counts as well: for a ghost
//! cell, the open half-space beyond its facet.
//! - The cells at one place are the star of a face, and so connected. The star of a face at a place near by is a part
//!   of it, so along a path the connection does not break.
//! - From a place outside, the facets that are seen are connected. On the straight way from there into the hull none
//!   comes into sight that was not, and the last ones that are seen hold the place where the way enters.
//!
//! So a flood from the located centre of a box, over the cells whose bounding boxes meet it and the ghost cells beyond
//! whose facets it has a corner, finds all cells that meet it, and with them all vertices in it, also those that
//! weights hide, which are above the cells that have their places. (Where the centre is a
//! vertex, the flood may begin at a ghost cell there that does not meet the box; the cell behind it has the vertex as a
//! corner, and is looked at next.)

use crate::delaunay::{IndexSet, Moving};
use crate::error::{Error, Result};
use crate::ids::{Slot, VertexId};
use crate::machine::memory;
use crate::motion::reading::near::most_cells;
use crate::motion::triangulation::MovingTriangulation;

/// A closed box.
#[derive(Clone, Copy)]
struct ClosedBox<G: Moving> {
    low: G::Point,
    high: G::Point,
}

impl<G: Moving> ClosedBox<G> {
    /// What it shares with another; `None` if that is nothing.
    fn intersection(mut self, low: &G::Point, high: &G::Point) -> Option<Self> {
        for axis in 0..G::D {
            self.low[axis] = self.low[axis].max(low[axis]);
            self.high[axis] = self.high[axis].min(high[axis]);
        }
        (0..G::D).all(|axis| self.low[axis] <= self.high[axis]).then_some(self)
    }

    fn has(&self, p: &G::Point) -> bool {
        (0..G::D).all(|axis| self.low[axis] <= p[axis] && p[axis] <= self.high[axis])
    }

    /// A place in the middle.
    fn centre(&self) -> G::Point {
        let mut middle = self.low;
        (0..G::D).for_each(|axis| middle[axis] = f64::midpoint(self.low[axis], self.high[axis]));
        middle
    }

    /// The corner with the greatest coordinates along the axes whose bit is set.
    fn corner(&self, bits: usize) -> G::Point {
        let mut corner = self.low;
        (0..G::D).filter(|axis| bits >> axis & 1 == 1).for_each(|axis| corner[axis] = self.high[axis]);
        corner
    }
}

impl<G: Moving> MovingTriangulation<G> {
    /// The vertices of which each coordinate is at least that of `low` and at most that of `high`: ascending, hidden
    /// ones included. Coordinates of the box may be infinite; it is empty if one of `low` is above that of `high`.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let points = [[0.0, 0.0], [4.0, 0.0], [0.0, 3.0], [4.0, 3.0]];
    /// let t = MovingTriangulation::<Plane>::new(&points, Options::default())?;
    /// let above = t.vertices_in_box(&[f64::NEG_INFINITY, 1.0], &[f64::INFINITY, 3.0])?;
    /// assert_eq!(above, [2, 3].map(VertexId::new));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for NaN, [`Error::OutOfMemory`].
    pub fn vertices_in_box(&self, low: &G::Point, high: &G::Point) -> Result<Vec<VertexId>> {
        for (argument, corner) in [("low", low), ("high", high)] {
            if let Some(index) = (0..G::D).find(|&axis| corner[axis].is_nan()) {
                let (value, wanted) = (corner[index], "a number or infinite");
                return Err(Error::InvalidValue { argument, index, value, wanted });
            }
        }
        let wanted = ClosedBox::<G> { low: *low, high: *high };
        let kernel = &self.mesh.kernel;
        if !kernel.has_cells() {
            return self.find_in_box(&wanted);
        }
        // All sites are in the box for which the kernel's filter holds.
        let Some(inner) = wanted.intersection(&kernel.lower(), &kernel.upper()) else {
            return Ok(Vec::new());
        };
        let mut cells = Vec::new();
        if !self.flood_box(&inner, &mut cells)? {
            return self.find_in_box(&wanted);
        }
        let mut found = IndexSet::new();
        for &cell in cells.iter().filter(|&&cell| !kernel.complex().cell(cell).is_ghost()) {
            let corners = kernel.complex().cell(cell).corners;
            for &s in corners.as_ref().iter().filter(|&&s| wanted.has(&kernel.site(s).point)) {
                found.insert(s)?;
            }
            if G::HAS_WEIGHTS {
                for s in kernel.sites_above(cell).filter(|&s| wanted.has(&kernel.site(s).point)) {
                    found.insert(s)?;
                }
            }
        }
        self.vertices_at(found.as_slice().iter().copied())
    }

    /// The vertices that are in a box, by a pass over all.
    fn find_in_box(&self, wanted: &ClosedBox<G>) -> Result<Vec<VertexId>> {
        let kernel = &self.mesh.kernel;
        self.vertices_at(kernel.live_sites().filter(|&s| wanted.has(&kernel.site(s).point)))
    }

    /// Lists cells, among them all that meet a box whose corners are in range of the kernel's filter; whether all have
    /// been found, before a pass over the sites takes less.
    fn flood_box(&self, wanted: &ClosedBox<G>, cells: &mut Vec<Slot>) -> Result<bool> {
        let kernel = &self.mesh.kernel;
        let centre = wanted.centre();
        let filter = kernel.filter_for(&centre);
        let first = self.slot_at(kernel.locate(&centre, Slot::NONE));
        let mut seen = IndexSet::new();
        seen.insert(first)?;
        memory::push(cells, first)?;
        let mut next = 0;
        while let Some(&cell) = cells.get(next) {
            next += 1;
            for i in 0..=G::D {
                let across = kernel.complex().cell(cell).neighbour(i).cell();
                if !seen.insert(across)? {
                    continue;
                }
                let may_meet = if kernel.complex().cell(across).is_ghost() {
                    (0..1 << G::D)
                        .any(|bits| kernel.orientation_beyond(&filter, across, &wanted.corner(bits)) > 0.0)
                } else {
                    self.may_reach(across, wanted)
                };
                if may_meet {
                    memory::push(cells, across)?;
                }
            }
            if next > most_cells(kernel) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether the bounding box of a finite cell meets a box.
    fn may_reach(&self, cell: Slot, wanted: &ClosedBox<G>) -> bool {
        let places = self.mesh.kernel.places(cell);
        (0..G::D).all(|axis| {
            let along = || places[..=G::D].iter().map(|p| p[axis]);
            along().any(|x| x <= wanted.high[axis]) && along().any(|x| x >= wanted.low[axis])
        })
    }
}
