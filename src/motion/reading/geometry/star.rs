//! Stars in the order in which one goes around a vertex of the plane.

use crate::delaunay::{Moving, Plane, Shape};
use crate::error::Result;
use crate::ids::{CellId, SiteId, VertexId};
use crate::motion::state::cells::NO_CORNER;
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::PlanePoint;

/// A cell around a vertex, and which of its corners the vertex is: in a box it may be several.
type Met = (CellId, usize);

/// The cells around a vertex, counter-clockwise. `across` tells what is across the facet opposite a corner of a cell, with
/// the corner there that is opposite the same facet.
#[derive(Clone, Debug)]
struct OrderedStar<A> {
    across: A,
    first: Met,
    next: Option<Met>,
}

impl<A: Fn(CellId, usize) -> Option<Met>> OrderedStar<A> {
    /// The cell that follows another one, counter-clockwise or else clockwise.
    fn beside(&self, (cell, at): Met, counter_clockwise: bool) -> Option<Met> {
        // The next cell is across the edge to the last of the three corners, and so opposite the one after the vertex; there
        // the vertex comes after the corner opposite that edge.
        let step = if counter_clockwise { 1 } else { 2 };
        let (next, mirror) = (self.across)(cell, (at + step) % 3)?;
        Some((next, (mirror + step) % 3))
    }
}

impl<A: Fn(CellId, usize) -> Option<Met>> Iterator for OrderedStar<A> {
    type Item = CellId;

    fn next(&mut self) -> Option<CellId> {
        let met = self.next?;
        self.next = self.beside(met, true).filter(|&next| next != self.first);
        Some(met.0)
    }
}

/// The cells around a vertex, counter-clockwise, of which one is given: from the one of lowest index, or, on the hull, from the
/// last that is met clockwise.
pub(crate) fn ordered_star(
    start: Option<(CellId, usize)>,
    across: impl Fn(CellId, usize) -> Option<(CellId, usize)> + Clone,
) -> impl Iterator<Item = CellId> + Clone {
    let mut star = OrderedStar { across, first: (CellId::NONE, 0), next: None };
    let Some(start) = start else { return star };
    let (mut lowest, mut met) = (start, start);
    star.first = loop {
        match star.beside(met, false) {
            None => break met,
            Some(before) if before == start => break lowest,
            Some(before) => met = before,
        }
        lowest = lowest.min(met);
    };
    star.next = Some(star.first);
    star
}

impl<P: PlanePoint> MovingTriangulation<Plane<P>>
where
    Plane<P>: Moving,
{
    /// The cells around the place of a vertex, counter-clockwise: from the one of lowest index, or, for a vertex of the
    /// convex hull, from the one at the hull's edge that leaves the vertex when the hull is passed counter-clockwise.
    /// None for one that weights hide.
    ///
    /// # Errors
    /// [`Error::NoSuchVertex`](crate::Error::NoSuchVertex), [`Error::RemovedVertex`](crate::Error::RemovedVertex),
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn ordered_star(&self, vertex: VertexId) -> Result<impl Iterator<Item = CellId> + Clone + '_> {
        let s: SiteId = self.present_site("vertex", 0, vertex)?;
        let (kernel, cells) = (&self.mesh.kernel, self.cell_arrays()?);
        let start = self.mesh.shown_at(s).filter(|_| !cells.corners().is_empty()).map(|s| {
            let around = kernel.site(s).cell;
            let behind = kernel.complex().cell(around).neighbour(Plane::<P>::D).cell();
            let is_ghost = kernel.complex().cell(around).is_ghost();
            let cell = cells.index_of()[if is_ghost { behind } else { around }];
            let at = cells.corners()[cell]
                .as_ref()
                .iter()
                .position(|&v| v == kernel.site(s).id)
                .expect("a corner");
            (cell, at)
        });
        let neighbours = cells.neighbours();
        Ok(ordered_star(start, move |cell, corner| {
            let mirror = cells.mirrors(kernel, cell)[corner];
            (mirror != NO_CORNER).then(|| (neighbours[cell][corner], usize::from(mirror)))
        }))
    }
}
