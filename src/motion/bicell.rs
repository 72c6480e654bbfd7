//! Bi-cells: two cells and the facet between them (report, section 2.2).

use super::MovingTriangulation;
use crate::complex::{Corners, Facet, INFINITE};
use crate::delaunay::{Delaunay, Dimension};
use crate::error::Result;
use crate::machine::memory;
use crate::predicates::{Delimiter, Tolerances};

/// The corners of a bi-cell that are not the ghost vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct BiCell<'k, G: Dimension> {
    sites: [u32; 5],
    points: [&'k G::Point; 5],
    n: usize,
}

impl<'k, G: Dimension> BiCell<'k, G> {
    /// The bi-cell of a facet: the opposing vertices are the first and the last of the `D + 2` corners of an interior one;
    /// the vertices of the facet and then the first of all are in the order of a positive orientation.
    /// At the hull only the `D + 1` finite corners are listed, in the order of a positive orientation.
    #[inline(always)]
    pub(super) fn of(kernel: &'k Delaunay<G>, facet: Facet) -> Self {
        let complex = kernel.complex();
        let (c, i) = (facet.cell(), facet.index());
        let cell = complex.cell(c);
        let across = cell.neighbour(i);
        let apex = complex.apex(across);
        if cell.is_ghost() || apex == INFINITE {
            return Self::at_hull(kernel, facet);
        }
        let corners = cell.corners.rotated_to_last(i);
        let (facet, opposite) = corners.as_ref().split_at(G::D);
        let mut sites = [apex; 5];
        sites[..1].copy_from_slice(opposite);
        sites[1..=G::D].copy_from_slice(facet);
        BiCell { sites, points: sites.map(|s| kernel.place(s)), n: G::D + 2 }
    }

    #[cold]
    fn at_hull(kernel: &'k Delaunay<G>, facet: Facet) -> Self {
        let corners = kernel.simplex_at_hull(facet);
        let mut sites = [corners[0]; 5];
        sites[..G::Corners::N].copy_from_slice(corners.as_ref());
        BiCell { sites, points: sites.map(|s| kernel.place(s)), n: G::D + 1 }
    }

    /// The finite corners.
    #[inline(always)]
    pub(super) fn sites(&self) -> &[u32] {
        &self.sites[..self.n]
    }

    /// The vertices at the finite corners; what follows them in the array is some of them again.
    #[inline(always)]
    pub(super) fn vertices(&self, kernel: &Delaunay<G>) -> [u32; 5] {
        self.sites.map(|s| kernel.site(s).id)
    }

    /// The places of the corners of an interior bi-cell; `None` at the hull.
    #[inline(always)]
    pub(super) fn interior(&self) -> Option<&[&'k G::Point]> {
        (self.n == G::D + 2).then(|| &self.points[..G::D + 2])
    }

    /// The standard delimiter; `None` at the hull.
    #[inline(always)]
    pub(super) fn delimiter(&self) -> Option<Delimiter<G::Point>> {
        (self.n == G::D + 2).then(|| G::Point::delimiter(&self.points[..G::D + 2]))
    }

    /// Certified lower bound of the tolerance of a bi-cell at the hull.
    pub(super) fn hull_tolerance(&self) -> f64 {
        G::Point::orientation_tolerance(&self.points[..G::D + 1])
    }

    /// Certified lower bound of the tolerance; it need not be sharp if it is `enough`.
    #[inline(always)]
    pub(super) fn tolerance(&self, enough: f64) -> f64 {
        if self.n == G::D + 2 {
            G::Point::tolerance(&self.points[..G::D + 2], enough)
        } else {
            self.hull_tolerance()
        }
    }
}

impl<G: Dimension> MovingTriangulation<G> {
    /// Tolerance of a vertex at its current position: a certified lower bound of the distance that all vertices may move
    /// without a change of connectivity, as far as the bi-cells of this one go (report, section 2.4). 0 if it shares its
    /// place with another, infinite while there are no cells.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`](crate::Error::NoSuchVertex), [`Error::RemovedVertex`](crate::Error::RemovedVertex).
    pub fn tolerance(&self, vertex: u32) -> Result<f64> {
        let s = self.present_site("vertex", 0, vertex)?;
        if self.is_shared(s) {
            return Ok(0.0);
        }
        let mut tolerance = f64::INFINITY;
        self.kernel.for_star(s, |c, _| tolerance = self.tolerance_around(c, tolerance))?;
        Ok(tolerance)
    }

    /// As [`tolerance`](Self::tolerance), for a site that no two vertices share; 0 without the memory to look.
    pub(super) fn tolerance_of_site(&mut self, s: u32) -> f64 {
        if self.kernel.gather_star(s).is_err() {
            return 0.0;
        }
        let star = self.kernel.gathered_star().iter();
        star.fold(f64::INFINITY, |tolerance, &(c, _)| self.tolerance_around(c, tolerance))
    }

    /// The least of a tolerance and those of a cell's bi-cells.
    fn tolerance_around(&self, cell: u32, tolerance: f64) -> f64 {
        let bicells = (0..G::Corners::N).map(|i| BiCell::of(&self.kernel, Facet::new(cell, i)));
        bicells.fold(tolerance, |least, bicell| least.min(bicell.tolerance(least)))
    }

    /// Annulus width of the bi-cell beyond each facet of each finite cell, as a certified lower bound, in the order of
    /// [`cells`](Self::cells): entry `i` of a cell is that of the facet opposite corner `i`. Every interior bi-cell is
    /// listed from both sides; facets of the hull have none and hold NaN.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn annulus_widths(&self) -> Result<Vec<f64>> {
        let cells = self.cell_arrays()?;
        let mut widths = Vec::new();
        memory::reserve_exact(&mut widths, cells.corners.len() * G::Corners::N)?;
        for index in 0..cells.corners.len() as u32 {
            for corner in 0..G::Corners::N {
                let delimiter = BiCell::of(&self.kernel, cells.facet(index, corner)).delimiter();
                widths.push(delimiter.map_or(f64::NAN, |delimiter| 2.0 * delimiter.half_width));
            }
        }
        Ok(widths)
    }

    /// Standard delimiter of the bi-cell of the facet opposite corner `corner` of the finite cell of index `cell` in
    /// [`cells`](Self::cells); `None` if there is no such facet or it is on the hull.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn standard_delimiter(&self, cell: u32, corner: u32) -> Result<Option<Delimiter<G::Point>>> {
        let cells = self.cell_arrays()?;
        if cell as usize >= cells.corners.len() || corner as usize > G::D {
            return Ok(None);
        }
        Ok(BiCell::of(&self.kernel, cells.facet(cell, corner as usize)).delimiter())
    }
}
