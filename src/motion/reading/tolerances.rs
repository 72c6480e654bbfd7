//! Tolerances, annulus widths and delimiters, for programs that ask (report, sections 2.2 to 2.4).

use crate::complex::{Corners, Facet};
use crate::delaunay::{Delaunay, Moving};
use crate::error::Result;
use crate::ids::{CellId, Slot, VertexId};
use crate::machine::memory;
use crate::motion::filters::bicell::BiCell;
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::Delimiter;

/// The least of a tolerance and those of a cell's bi-cells, of which some may have a segment for their facet.
fn tolerance_at<G: Moving>(kernel: &Delaunay<G>, cell: Slot, tolerance: f64) -> f64 {
    let is_segment = |i: usize| !kernel.complex().cell(cell).is_ghost() && kernel.is_facet_required(cell, i);
    (0..G::Corners::N).fold(tolerance, |least, i| {
        let bicell = BiCell::of(kernel, Facet::new(cell, i));
        least.min(if is_segment(i) { bicell.cell_tolerance() } else { bicell.tolerance(least) })
    })
}

impl<G: Moving> MovingTriangulation<G> {
    /// Tolerance of a vertex at its current position: a certified lower bound of the distance that all vertices may
    /// move without a change of connectivity, as far as the bi-cells of this one go (report, section 2.4). 0 if it
    /// shares its place with another; infinite while there are no cells.
    ///
    /// With weights a vertex goes as far as the root of the square of the distance and the magnitude of the change of
    /// its weight, and 0 is told of one that weights hide: what it takes to bring those back is in no bi-cell.
    ///
    /// A bi-cell whose facet is a segment stays as it is while its two cells are positively oriented: each has the
    /// tolerance of that alone, whatever is beyond the segment.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{MovingTriangulation, Options}};
    ///
    /// let points = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&points, Options::default())?;
    /// let tolerance = t.tolerance(VertexId::new(3))?;
    /// assert!(tolerance > 0.0 && tolerance < 1.0);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`](crate::Error::NoSuchVertex), [`Error::RemovedVertex`](crate::Error::RemovedVertex).
    pub fn tolerance(&self, vertex: VertexId) -> Result<f64> {
        let s = self.present_site("vertex", 0, vertex)?;
        if self.mesh.is_shared(s) || self.mesh.kernel.is_hidden(s) {
            return Ok(0.0);
        }
        let mut tolerance = f64::INFINITY;
        let kernel = &self.mesh.kernel;
        kernel.for_star(s, |c, _| tolerance = tolerance_at(kernel, c, tolerance))?;
        Ok(tolerance)
    }

    /// Annulus width of the bi-cell beyond each facet of each finite cell, as a certified lower bound, in the order of
    /// [`cells`](Self::cells): entry `i` of a cell is that of the facet opposite corner `i`. Every interior bi-cell is
    /// listed from both sides; facets of the hull have none and hold NaN, as all do with weights: there are no annuli
    /// then.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn annulus_widths(&self) -> Result<Vec<f64>> {
        let cells = self.cell_arrays()?;
        let mut widths = Vec::new();
        memory::reserve_exact(&mut widths, cells.corners().len() * G::Corners::N)?;
        for index in CellId::range(0..cells.corners().len()) {
            for corner in 0..G::Corners::N {
                let bicell = BiCell::of(&self.mesh.kernel, cells.facet(index, corner));
                let delimiter = bicell.delimiter().filter(|_| !G::HAS_WEIGHTS);
                widths.push(delimiter.map_or(f64::NAN, |delimiter| 2.0 * delimiter.half_width));
            }
        }
        Ok(widths)
    }

    /// Standard delimiter of the bi-cell of the facet opposite corner `corner` of the finite cell of index `cell` in
    /// [`cells`](Self::cells); `None` if there is no such facet or it is on the hull, and with weights.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn standard_delimiter(&self, cell: CellId, corner: u32) -> Result<Option<Delimiter<G::Point>>> {
        let cells = self.cell_arrays()?;
        if G::HAS_WEIGHTS || cell.index() >= cells.corners().len() || corner as usize > G::D {
            return Ok(None);
        }
        Ok(BiCell::of(&self.mesh.kernel, cells.facet(cell, corner as usize)).delimiter())
    }
}
