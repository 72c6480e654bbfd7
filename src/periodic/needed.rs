//! Images that are needed and not there.

use std::ops::Range as Indices;

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::{memory, threads};
use crate::motion::{MovingTriangulation, NO_CELL};
use crate::periodic::images::Image;
use crate::periodic::inside::{Inside, all};
use crate::periodic::lattice::{HOME, Lattice, Occupied, Range, Shift};
use crate::predicates::{PointArray, squared_distance};

/// What makes a rounded radius one that certainly is no less than the distance of a corner from a rounded centre.
///
/// With weights it makes the radius r of a reach, told by a rounded centre and the first corner, one of a ball that has the reach in
/// it. No corner is farther than r from the centre, so coordinates of corners differ by 2 r at most, and weights by r² at most. So
/// each coordinate of the centre is off by 2·10⁻⁹ r at most (circumspheres), the centre by 3.5·10⁻⁹ r, and r by as much: seven
/// are less than ten.
const RADIUS: f64 = 1.0 + 1e-8;

/// Images up to so many mean distances of vertices outside of what vertices at home occupy are there from the beginning.
const MARGIN: f64 = 1.5;

/// A thread more pays for so many cells.
const CELLS_AT_LEAST: usize = 16_384;

/// Images that have to be inserted, each once.
#[derive(Debug, Default)]
pub(super) struct Needed {
    pub(super) images: Vec<Image>,
}

impl Needed {
    /// The images that are missing, by a look at all cells.
    pub(super) fn of_all<G: Moving>(inside: &Inside<G>, lattice: &Lattice<G>) -> Result<Self> {
        let mut needed = Needed::default();
        if inside.t.cell_count() == 0 {
            // All vertices are in a line or plane: only images anywhere can change that.
            for (vertex, _) in inside.images.homes().filter(|&(_, inner)| inside.t.is_present(inner)) {
                needed.enter(inside, vertex, lattice.all_shifts())?;
            }
            return Ok(needed.each_once());
        }
        let n = inside.t.cells()?.corners.len();
        let n_threads = inside.t.threads().for_work(n, CELLS_AT_LEAST, CELLS_AT_LEAST / 64);
        let parts = threads::for_ranges(n, n_threads, |range| Self::of_range(inside, lattice, range))?;
        for part in parts {
            memory::append(&mut needed.images, &part?.images)?;
        }
        Ok(needed.each_once())
    }

    /// The images that the cells of a range of indices ask for.
    fn of_range<G: Moving>(inside: &Inside<G>, lattice: &Lattice<G>, range: Indices<usize>) -> Result<Self> {
        let mut needed = Needed::default();
        let corners = inside.t.cells()?.corners;
        for (cell, sphere) in CellId::range(range.clone()).zip(inside.t.circumspheres_in(range)?) {
            if corners[cell].as_ref().iter().any(|v| inside.images.is_home(*v)) {
                needed.enter_by_ball(inside, lattice, cell, sphere)?;
            }
        }
        Ok(needed)
    }

    /// The images that are missing, by a look at the cells that have come since changes were taken, where before none
    /// was missing but what has been inserted since then.
    pub(super) fn of_new<G: Moving>(inside: &Inside<G>, lattice: &Lattice<G>) -> Result<Self> {
        let Some(rows) = inside.t.rows_since_taken()? else { return Self::of_all(inside, lattice) };
        let mut needed = Needed::default();
        for (row, created) in rows {
            if let Some(cell) = created
                && row.as_ref().iter().any(|v| inside.images.is_home(*v))
            {
                needed.enter_cell(inside, lattice, cell)?;
            }
        }
        Ok(needed.each_once())
    }

    /// Enters those that the ball of a cell asks for.
    pub(super) fn enter_cell<G: Moving>(
        &mut self,
        inside: &Inside<G>,
        lattice: &Lattice<G>,
        cell: CellId,
    ) -> Result<()> {
        for sphere in inside.t.circumspheres_of(&[cell])? {
            self.enter_by_ball(inside, lattice, cell, sphere)?;
        }
        Ok(())
    }

    fn enter_by_ball<G: Moving>(
        &mut self,
        inside: &Inside<G>,
        lattice: &Lattice<G>,
        cell: CellId,
        (centre, square): (G::Point, f64),
    ) -> Result<()> {
        let cells = inside.t.cells()?;
        // Of all places at which a vertex of the greatest weight would change the cell, none is farther.
        let square = if G::HAS_WEIGHTS {
            let corner = inside.t.position(cells.corners[cell].as_ref()[0])?;
            squared_distance(&centre, &corner) + (inside.occupied.weight - corner.weight())
        } else {
            square
        };
        let is_at_hull = cells.neighbours[cell].as_ref().contains(&NO_CELL);
        let ranges = if is_at_hull {
            lattice.all_shifts()
        } else {
            lattice.shifts_to(&centre, square.sqrt() * RADIUS, &inside.occupied)
        };
        if ranges.iter().all(|range| *range == (0..=0)) {
            return Ok(());
        }
        for &v in cells.corners[cell].as_ref().iter().filter(|v| inside.images.is_home(**v)) {
            self.enter(inside, inside.images.of(v).vertex, ranges.clone())?;
        }
        Ok(())
    }

    /// Enters those images of a vertex that are not there, with shifts that are less than nothing by these.
    fn enter<G: Moving>(
        &mut self,
        inside: &Inside<G>,
        vertex: VertexId,
        [a, b, c]: [Range; 3],
    ) -> Result<()> {
        for (x, y, z) in all(a, b, c) {
            let shift = [-x, -y, -z];
            if inside.images.find(vertex, shift) == VertexId::NONE {
                memory::push(&mut self.images, Image { vertex, shift })?;
            }
        }
        Ok(())
    }

    pub(super) fn each_once(mut self) -> Self {
        self.images.sort_unstable();
        self.images.dedup();
        self
    }
}

/// Enters the shifts of the images that a vertex at home has from the beginning: where what is occupied, translated, is so near.
pub(super) fn for_images<G: Moving>(
    lattice: &Lattice<G>,
    place: &G::Point,
    spacing: f64,
    occupied: &Occupied,
    enter: &mut impl FnMut(Shift) -> Result<()>,
) -> Result<()> {
    let [a, b, c] = lattice.shifts_to(place, MARGIN * spacing, occupied);
    for (x, y, z) in all(a, b, c) {
        // What is occupied, translated by this, meets the ball: what takes it home takes the vertex near home.
        let shift = [-x, -y, -z];
        if shift != HOME {
            enter(shift)?;
        }
    }
    Ok(())
}

/// Images have the key of their vertex: ties between images of one are broken by position.
pub(super) fn keys_of(images: &[Image]) -> Result<Vec<u64>> {
    let mut keys = Vec::new();
    memory::collect(&mut keys, images.iter().map(|image| u64::from(image.vertex.get())))?;
    Ok(keys)
}

impl<G: Moving> Inside<G> {
    /// Inserts images that are needed, and in further rounds those that are missing after that, until there are none.
    pub(super) fn complete(
        &mut self,
        lattice: &Lattice<G>,
        mut needed: Needed,
        after: impl Fn(&Self, &Lattice<G>) -> Result<Needed>,
        mut round: impl FnMut(&mut MovingTriangulation<G>) -> Result<()>,
    ) -> Result<()> {
        while !needed.images.is_empty() {
            let Needed { images } = needed;
            let mut places = Vec::new();
            memory::reserve(&mut places, images.len())?;
            for image in &images {
                let home = self.t.position(self.images.home(image.vertex))?;
                places.push(lattice.translated(&home, image.shift));
            }
            self.images.reserve(0, images.len())?;
            self.t.stage_insertions_with_keys(&places, &keys_of(&images)?)?;
            round(&mut self.t)?;
            images.iter().for_each(|&image| self.images.push(image));
            needed = after(self, lattice)?;
        }
        Ok(())
    }
}
