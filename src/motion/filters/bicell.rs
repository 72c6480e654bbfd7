//! Bi-cells: two cells and the facet between them (report, section 2.2).

use crate::complex::{Corners, Facet, INFINITE};
use crate::delaunay::{Delaunay, Moving};
use crate::ids::{SiteId, Slot, VertexId};
use crate::machine::prefetch::CACHE_BYTES;
use crate::predicates::{BiCellTolerances, Delimiter};

/// The corners of a bi-cell that are not the ghost vertex.
#[derive(Clone, Copy, Debug)]
pub(in crate::motion) struct BiCell<'k, G: Moving> {
    sites: [SiteId; 5],
    points: [&'k G::Point; 5],
    n: usize,
}

impl<'k, G: Moving> BiCell<'k, G> {
    /// The bi-cell of a facet: the opposing vertices are the first and the last of the `D + 2` corners of an interior
    /// one; the vertices of the facet and then the first of all are in the order of a positive orientation.
    /// At the hull only the `D + 1` finite corners are listed, in the order of a positive orientation.
    #[inline(always)]
    pub(in crate::motion) fn of(kernel: &'k Delaunay<G>, facet: Facet) -> Self {
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
    pub(in crate::motion) fn sites(&self) -> &[SiteId] {
        &self.sites[..self.n]
    }

    /// The vertices at the finite corners; what follows them in the array is some of them again.
    #[inline(always)]
    pub(in crate::motion) fn vertices(&self, kernel: &Delaunay<G>) -> [VertexId; 5] {
        self.sites.map(|s| kernel.site(s).id)
    }

    /// The places of the corners of an interior bi-cell; `None` at the hull.
    #[inline(always)]
    pub(in crate::motion) fn interior(&self) -> Option<&[&'k G::Point]> {
        (self.n == G::D + 2).then(|| &self.points[..G::D + 2])
    }

    /// The standard delimiter; `None` at the hull.
    #[inline(always)]
    pub(in crate::motion) fn delimiter(&self) -> Option<Delimiter<G::Point>> {
        (self.n == G::D + 2).then(|| G::Point::delimiter(&self.points[..G::D + 2]))
    }

    /// Certified lower bound of the tolerance of a bi-cell at the hull.
    pub(in crate::motion) fn hull_tolerance(&self) -> f64 {
        G::Point::orientation_tolerance(&self.points[..G::D + 1])
    }

    /// Certified lower bound of the distance that the corners of the cell on the first vertex's side may move and leave it
    /// positively oriented.
    pub(in crate::motion) fn cell_tolerance(&self) -> f64 {
        if self.n != G::D + 2 {
            return self.hull_tolerance();
        }
        let mut cell = self.points;
        cell[..=G::D].rotate_left(1);
        G::Point::orientation_tolerance(&cell[..=G::D])
    }

    /// Certified lower bound of the tolerance; it need not be sharp if it is `enough`.
    #[inline(always)]
    pub(in crate::motion) fn tolerance(&self, enough: f64) -> f64 {
        if self.n == G::D + 2 {
            G::Point::tolerance(&self.points[..G::D + 2], enough)
        } else {
            self.hull_tolerance()
        }
    }
}

/// Visits every bi-cell by one side of its facet; returns their number.
#[inline(always)]
pub(in crate::motion) fn for_bicells<G: Moving>(kernel: &Delaunay<G>, mut visit: impl FnMut(Facet)) -> u64 {
    let complex = kernel.complex();
    let is_far = kernel.bytes_read() > CACHE_BYTES;
    let mut n = 0;
    for c in complex.live() {
        if is_far {
            kernel.prefetch_around_cells_after(c);
        }
        for i in 0..G::Corners::N {
            if c < complex.cell(c).neighbour(i).cell() {
                visit(Facet::new(c, i));
                n += 1;
            }
        }
    }
    n
}

/// The tolerance of the vertex of a site that no two share: the least of the bi-cells around it; 0 without the memory
/// to look.
pub(in crate::motion) fn tolerance_of_site<G: Moving>(kernel: &mut Delaunay<G>, s: SiteId) -> f64 {
    if kernel.gather_star(s).is_err() {
        return 0.0;
    }
    let star = kernel.gathered_star().iter();
    star.fold(f64::INFINITY, |tolerance, &(c, _)| tolerance_around(kernel, c, tolerance))
}

/// The least of a tolerance and those of a cell's bi-cells.
pub(in crate::motion) fn tolerance_around<G: Moving>(
    kernel: &Delaunay<G>,
    cell: Slot,
    tolerance: f64,
) -> f64 {
    let bicells = (0..G::Corners::N).map(|i| BiCell::of(kernel, Facet::new(cell, i)));
    bicells.fold(tolerance, |least, bicell| least.min(bicell.tolerance(least)))
}
