//! The cells that a new vertex would remove, and the natural neighbours of a place.
//!
//! A place is in conflict with a cell of the repeating set if its ball has the place inside, with ties broken as for a vertex of the
//! highest id. That is so if the translation of the place is in conflict with the translation of the cell that is inside, with
//! its least vertex at home: as images have the key of their vertex, ties are broken alike in all periods.
//!
//! The cells in conflict with a place in one of them are connected by facets: on the straight way from the place to one of them there
//! are no others. Of a place outside the hull of a set that is open somewhere they need not be, and the facets of the hull that are
//! seen from there have no end: what is in conflict with such a place is not told.

use std::collections::HashMap;
use std::hash::BuildHasherDefault;

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::CellId;
use crate::machine::memory;
use crate::motion::{Location, Ridges};
use crate::periodic::cells::{PeriodicCells, RowHasher};
use crate::periodic::images::Image;
use crate::periodic::locating::{PeriodicLocation, PlacedCell, across};
use crate::periodic::triangulation::PeriodicTriangulation;

/// By the corner opposite a facet of a cell of space, the other ones, all counter-clockwise as seen from outside.
const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// The cells of a zone, each once.
#[derive(Debug, Default)]
pub(super) struct ZoneCells {
    list: Vec<PlacedCell>,
    seen: HashMap<PlacedCell, (), BuildHasherDefault<RowHasher>>,
}

impl ZoneCells {
    fn clear(&mut self) {
        self.list.clear();
        self.seen.clear();
    }

    fn enter(&mut self, placed: PlacedCell) -> Result<()> {
        memory::reserve_map(&mut self.seen, 1)?;
        if self.seen.insert(placed, ()).is_none() {
            memory::push(&mut self.list, placed)?;
        }
        Ok(())
    }
}

impl<G: Moving> PeriodicTriangulation<G> {
    /// The cells that the insertion of a vertex at a position, rounded to the grid of the lattice, would remove with all of its
    /// images: those of which a translation has the position inside of its circle or sphere, with ties broken as for a vertex of the
    /// highest id. Ascending, each once. None at the place of a vertex, nor while there are no cells. The position is looked for
    /// from `near`, if that is near it.
    ///
    /// ```
    /// use deldrift::{Plane, motion::Options, periodic::PeriodicTriangulation};
    ///
    /// let t = PeriodicTriangulation::<Plane>::new(&[[0.0, 0.0]], &[[1.0, 0.0], [0.0, 1.0]], Options::default())?;
    /// assert_eq!(t.conflicts(&[7.5, -0.5], None)?.len(), 2);
    /// assert!(t.conflicts(&[3.0, 4.0], None)?.is_empty());
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::OutOfRange`], [`Error::OutOfMemory`]; [`Error::OutsideOfPeriodic`] for a position outside the
    /// convex hull of a set that is open somewhere.
    pub fn conflicts(&self, position: &G::Point, near: Option<Location>) -> Result<Vec<CellId>> {
        let (place, _) = self.lattice.wrapped("position", 0, position)?;
        let cells = self.read_cells()?;
        let mut inner = Location::NoCells;
        let near = self.inside_of(cells, near);
        self.inside.t.locate_points(&[place], near, |location| inner = location)?;
        let mut found = Vec::new();
        let first = match self.periodic_location(cells, &place, inner)? {
            PeriodicLocation::Cell(placed) => placed,
            PeriodicLocation::Outside(_) => return Err(Error::OutsideOfPeriodic { argument: "position" }),
            PeriodicLocation::Vertex(_) | PeriodicLocation::NoCells => return Ok(found),
        };
        let mut zone = ZoneCells::default();
        self.fill_zone(cells, (first, &place), &mut zone, |_, _| Ok(()))?;
        memory::collect(&mut found, zone.list.iter().map(|&(class, _)| class))?;
        found.sort_unstable();
        found.dedup();
        Ok(found)
    }

    /// Lists the cells in conflict with a place in one of them, at no vertex, and tells the facets around them, by the cell and the corner
    /// opposite.
    fn fill_zone(
        &self,
        cells: &PeriodicCells<G>,
        (first, place): (PlacedCell, &G::Point),
        zone: &mut ZoneCells,
        mut facet: impl FnMut(PlacedCell, usize) -> Result<()>,
    ) -> Result<()> {
        zone.clear();
        zone.enter(first)?;
        let mut next = 0;
        while let Some(&placed) = zone.list.get(next) {
            next += 1;
            for i in 0..=G::D {
                match across(cells, placed, i) {
                    Some(beyond) if self.is_in_conflict(cells, beyond, place)? => zone.enter(beyond)?,
                    _ => facet(placed, i)?,
                }
            }
        }
        Ok(())
    }

    fn is_in_conflict(
        &self,
        cells: &PeriodicCells<G>,
        (class, by): PlacedCell,
        place: &G::Point,
    ) -> Result<bool> {
        let there = self.lattice.translated(place, by.map(|n| -n));
        self.inside.t.is_in_conflict(cells.chosen[class], &there)
    }

    /// The weights of the natural neighbours of a place in a cell, at no vertex: of images.
    pub(super) fn natural_weights(
        &self,
        cells: &PeriodicCells<G>,
        (first, place): (PlacedCell, &G::Point),
        zone: &mut ZoneCells,
        ridges: &mut Ridges<Image>,
        weights: &mut Vec<(Image, f64)>,
    ) -> Result<()> {
        ridges.clear();
        self.fill_zone(cells, (first, place), zone, |placed, i| {
            let corners = self.corners_of(cells, placed);
            let of_facet = if G::D == 2 { [(i + 1) % 3, (i + 2) % 3, (i + 2) % 3] } else { FACES[i] };
            ridges.add_facet::<G>(of_facet.map(|k| (corners[k].0, &corners[k].1)), place)
        })?;
        let corners = self.corners_of(cells, first);
        let corners = corners.each_ref().map(|(image, corner)| (*image, corner));
        let place_of = |image: Image| {
            let home = &self.inside.places[self.inside.images.home(image.vertex)];
            self.lattice.translated(home, image.shift)
        };
        ridges.weights::<G>(&corners[..=G::D], place, place_of, weights)
    }
}
