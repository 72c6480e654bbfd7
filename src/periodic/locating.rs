//! Where places lie.
//!
//! A place is rounded to the grid and taken into the unit cell, and located inside. If it is in a cell there that has a vertex
//! at home, that cell is one of the repeating set, and which class it is of is known. Otherwise, if it is in a cell of images
//! alone or outside of what is inside, it is looked for in the repeating set, from a corner of what has been found.
//!
//! # Beyond what is inside
//!
//! The cells that the straight way from the corner to the place meets are connected by facets: those at one place are the star
//! of a face, and that of a face at a place near by is a part of it. The last place of the way that is in the hull is in one of
//! them; if that is not where the way ends, the hull has a facet there that the end is strictly beyond. So a search from a
//! cell at the corner, from neighbour to neighbour, over all cells that the way may meet, ends in a cell that has the place, or
//! behind a facet of the hull that has it beyond. It looks first at neighbours on the other side of whose facet the place
//! is, which as a rule leads straight to it.
//!
//! No number is rounded that matters: the way is within the multiples of vectors that images can have. What it may meet has, with
//! the bound on the corners of a cell (lattice.rs), at most twice as many and one more, for which sums on the grid are exact.

use std::collections::HashMap;
use std::hash::BuildHasherDefault;

use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::{CellId, VertexId};
use crate::machine::memory;
use crate::motion::{Location, NO_CELL};
use crate::periodic::cells::{PeriodicCells, RowHasher};
use crate::periodic::images::Image;
use crate::periodic::lattice::{HOME, Lattice, Shift, plus};
use crate::periodic::reduction::SLACK;
use crate::periodic::triangulation::PeriodicTriangulation;
use crate::predicates::PointArray;

/// A cell of the repeating set: one of a class, translated by this shift from where its least vertex is at home.
pub(super) type PlacedCell = (CellId, Shift);

/// Where a place in the unit cell lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PeriodicLocation {
    /// At this image of the vertex that represents those there.
    Vertex(Image),
    /// In the closure of this cell, at no vertex.
    Cell(PlacedCell),
    /// Beyond a facet of the hull of this cell.
    Outside(PlacedCell),
    /// There are no cells.
    NoCells,
}

/// What there is at an image of a vertex.
#[derive(Clone, Copy, Debug)]
pub(super) enum AtImage {
    /// A corner of cells: the image, or what represents it.
    Corner(Image),
    /// The image is hidden by weight, above this cell.
    Above(PlacedCell),
}

/// Places that are asked for.
pub(super) struct AskedPlaces<G: Moving> {
    /// In the unit cell.
    pub(super) places: Vec<G::Point>,
    /// By which multiples of the reduced vectors each has been translated to come from there.
    pub(super) wraps: Vec<[i64; 3]>,
}

/// The ranges of coordinates, and of multiples of the vectors, that some places have.
struct PlaceRanges {
    low: [f64; 6],
    high: [f64; 6],
}

impl PlaceRanges {
    fn of<G: Moving>(lattice: &Lattice<G>, places: &[G::Point]) -> Self {
        let (mut extent, used) = (PlaceRanges { low: [0.0; 6], high: [0.0; 6] }, [0..G::D, 3..6]);
        for k in used.into_iter().flatten() {
            (extent.low[k], extent.high[k]) = (f64::INFINITY, f64::NEG_INFINITY);
        }
        for place in places {
            for axis in 0..G::D {
                extent.enter(axis, place[axis], 0.0);
            }
            for (j, x) in lattice.multiples(place).into_iter().enumerate() {
                extent.enter(3 + j, x, SLACK * (1.0 + x.abs()));
            }
        }
        extent
    }

    fn enter(&mut self, k: usize, x: f64, slack: f64) {
        self.low[k] = self.low[k].min(x - slack);
        self.high[k] = self.high[k].max(x + slack);
    }

    fn may_meet(&self, other: &Self) -> bool {
        (0..6).all(|k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k])
    }
}

/// Cells that have been seen by a search.
type SeenCells = HashMap<PlacedCell, (), BuildHasherDefault<RowHasher>>;

impl<G: Moving> PeriodicTriangulation<G> {
    /// Where a position, rounded to the grid of the lattice, lies: the class of cells, or the vertex, of which a translation is
    /// there.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{Location, Options}, periodic::PeriodicTriangulation};
    ///
    /// let t = PeriodicTriangulation::<Plane>::new(&[[0.25, 0.25]], &[[1.0, 0.0], [0.0, 1.0]], Options::default())?;
    /// assert_eq!(t.locate(&[-6.75, 8.25])?, Location::Vertex(VertexId::new(0)));
    /// assert!(matches!(t.locate(&[0.5, 0.9])?, Location::Cell(_)));
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`](crate::Error::NotFinite), [`Error::OutOfRange`](crate::Error::OutOfRange),
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn locate(&self, position: &G::Point) -> Result<Location> {
        let (place, _) = self.lattice.wrapped("position", 0, position)?;
        let inner = self.inside.t.locate(&place)?;
        Ok(location_of(self.periodic_location(self.read_cells()?, &place, inner)?))
    }

    /// Where positions, rounded to the grid of the lattice, lie, told to `found` one after the other, each with the multiples of
    /// the vectors by which the vertex is to be translated from its position, or the cell from where
    /// [`cell_shifts`](Self::cell_shifts) has it, to be there. Each is looked for from the one before, the first from `near`, if
    /// that is near it. This is only where to begin: it need not be right, nor name anything.
    ///
    /// ```
    /// use deldrift::{Plane, VertexId, motion::{Location, Options}, periodic::PeriodicTriangulation};
    ///
    /// let t = PeriodicTriangulation::<Plane>::new(&[[0.25, 0.25]], &[[1.0, 0.0], [0.0, 1.0]], Options::default())?;
    /// t.locate_in_period(&[[-6.75, 8.25]], None, |location, shift| {
    ///     assert_eq!((location, shift), (Location::Vertex(VertexId::new(0)), [-7, 8, 0]));
    /// })?;
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`locate`](Self::locate), before anything is told.
    pub fn locate_in_period(
        &self,
        positions: &[G::Point],
        near: Option<Location>,
        mut found: impl FnMut(Location, [i64; 3]),
    ) -> Result<()> {
        let asked = self.asked(positions)?;
        let locations = self.periodic_locations(&asked, near)?;
        for (location, wrap) in locations.into_iter().zip(&asked.wraps) {
            found(location_of(location), self.shift_of(location, wrap)?);
        }
        Ok(())
    }

    /// Positions on the grid, in the unit cell.
    pub(super) fn asked(&self, positions: &[G::Point]) -> Result<AskedPlaces<G>> {
        let mut asked = AskedPlaces { places: Vec::new(), wraps: Vec::new() };
        memory::reserve_exact(&mut asked.places, positions.len())?;
        memory::reserve_exact(&mut asked.wraps, positions.len())?;
        for (index, position) in positions.iter().enumerate() {
            let (place, wrap) = self.lattice.wrapped("positions", index, position)?;
            asked.places.push(place);
            asked.wraps.push(wrap);
        }
        Ok(asked)
    }

    /// Where these places are.
    pub(super) fn periodic_locations(
        &self,
        asked: &AskedPlaces<G>,
        near: Option<Location>,
    ) -> Result<Vec<PeriodicLocation>> {
        let cells = self.read_cells()?;
        let (mut inner, mut locations) = (Vec::new(), Vec::new());
        memory::reserve_exact(&mut inner, asked.places.len())?;
        memory::reserve_exact(&mut locations, asked.places.len())?;
        let near = self.inside_of(cells, near);
        self.inside.t.locate_points(&asked.places, near, |location| inner.push(location))?;
        for (place, inner) in asked.places.iter().zip(inner) {
            locations.push(self.periodic_location(cells, place, inner)?);
        }
        Ok(locations)
    }

    /// A location inside that has been told as this one, to begin a search at.
    pub(super) fn inside_of(&self, cells: &PeriodicCells<G>, near: Option<Location>) -> Option<Location> {
        match near? {
            Location::Vertex(v) if self.is_present(v) => Some(Location::Vertex(self.inside.images.home(v))),
            Location::Cell(c) | Location::Outside(c) => {
                cells.chosen.get(c.index()).copied().map(Location::Cell)
            }
            Location::Vertex(_) | Location::NoCells => None,
        }
    }

    /// By which multiples of the given vectors what is at a location is translated from where it is told to be.
    fn shift_of(&self, location: PeriodicLocation, wrap: &[i64; 3]) -> Result<[i64; 3]> {
        let (vertex, shift) = match location {
            PeriodicLocation::Vertex(image) => (image.vertex, image.shift),
            PeriodicLocation::Cell((class, shift)) | PeriodicLocation::Outside((class, shift)) => {
                let cells = self.read_cells()?;
                (self.least_of(cells, class.index()), shift)
            }
            PeriodicLocation::NoCells => return Ok([0; 3]),
        };
        let own = &self.wraps[vertex];
        Ok(self.lattice.of_caller([0, 1, 2].map(|j| i64::from(shift[j]) + wrap[j] - own[j])))
    }

    /// Where a place in the unit cell is, which is there inside.
    pub(super) fn periodic_location(
        &self,
        cells: &PeriodicCells<G>,
        place: &G::Point,
        inner: Location,
    ) -> Result<PeriodicLocation> {
        match inner {
            Location::Vertex(v) => Ok(match self.at_image(cells, self.inside.images.of(v))? {
                AtImage::Corner(image) => PeriodicLocation::Vertex(image),
                AtImage::Above(placed) => PeriodicLocation::Cell(placed),
            }),
            Location::Cell(cell) if cells.class_of[cell] != NO_CELL => {
                Ok(PeriodicLocation::Cell(self.placed(cells, cell)?))
            }
            Location::Cell(cell) | Location::Outside(cell) => self.searched(cells, place, cell),
            Location::NoCells => {
                Ok(self.at_vertex(place).map_or(PeriodicLocation::NoCells, PeriodicLocation::Vertex))
            }
        }
    }

    /// What is at an image, by what is at its vertex at home: where the image is, inside need not have all images. There must be
    /// cells.
    pub(super) fn at_image(&self, cells: &PeriodicCells<G>, image: Image) -> Result<AtImage> {
        if let Some(corner) = self.inside.corner_at_image(image) {
            return Ok(AtImage::Corner(corner));
        }
        let below = self.inside.t.cell_below(self.inside.images.home(image.vertex))?;
        let (class, by) = self.placed_anywhere(cells, below)?;
        Ok(AtImage::Above((class, plus(by, image.shift))))
    }

    /// Which cell of the repeating set one inside is that is a cell of it, with a vertex at home or without one.
    pub(super) fn placed_anywhere(&self, cells: &PeriodicCells<G>, cell: CellId) -> Result<PlacedCell> {
        if cells.class_of[cell] != NO_CELL {
            return self.placed(cells, cell);
        }
        let row = self.inside.t.cells()?.corners[cell];
        let corner = row.as_ref()[0];
        let translated =
            self.inside.translated_home(&row, corner).expect("a cell is there around each of its corners");
        let Image { vertex, shift } = self.inside.images.of(corner);
        let home = self.inside.cell_at(self.inside.images.home(vertex), &translated)?;
        let (class, by) = self.placed(cells, home.expect("a cell is there around each of its corners"))?;
        Ok((class, plus(by, shift)))
    }

    /// Which cell of the repeating set one inside is that has a vertex at home.
    pub(super) fn placed(&self, cells: &PeriodicCells<G>, cell: CellId) -> Result<PlacedCell> {
        let row = &self.inside.t.cells()?.corners[cell];
        let least = row.as_ref()[self.inside.least(row)?];
        Ok((cells.class_of[cell], self.inside.images.of(least).shift))
    }

    /// The corners of a cell of the repeating set, and where they are.
    pub(super) fn corners_of(
        &self,
        cells: &PeriodicCells<G>,
        (class, by): PlacedCell,
    ) -> [(Image, G::Point); 4] {
        let mut corners = [(Image { vertex: VertexId::NONE, shift: HOME }, G::Point::default()); 4];
        let shifts = cells.shifts.of(class.index());
        for (i, &vertex) in cells.corners[class].as_ref().iter().enumerate() {
            let shift = plus(shifts[i], by);
            let home = &self.inside.places[self.inside.images.home(vertex)];
            corners[i] = (Image { vertex, shift }, self.lattice.translated(home, shift));
        }
        corners
    }

    /// The image of a vertex at a place in the unit cell, by a look at all vertices; the one of the lowest id, with weights of
    /// those of the greatest weight.
    fn at_vertex(&self, place: &G::Point) -> Option<Image> {
        let there = self.inside.images.homes().filter_map(|(vertex, inner)| {
            let (home, mut way) = (&self.inside.places[inner], *place);
            (0..G::D).for_each(|axis| way[axis] -= home[axis]);
            let shift = self.lattice.multiples(&way).map(|x| x.round() as i32);
            let is_there = self.lattice.translated(home, shift).as_ref() == place.as_ref();
            is_there.then_some((home.weight(), Image { vertex, shift }))
        });
        let heavier =
            |first: (f64, Image), other: (f64, Image)| if other.0 > first.0 { other } else { first };
        there.reduce(heavier).map(|(_, image)| image)
    }

    /// Where a place is, by a search from a corner of a cell inside.
    #[cold]
    fn searched(&self, cells: &PeriodicCells<G>, place: &G::Point, cell: CellId) -> Result<PeriodicLocation> {
        let (first, corner) = self.first_of(cells, cell)?;
        let way = PlaceRanges::of(&self.lattice, &[corner, *place]);
        let (mut seen, mut waiting) = (SeenCells::default(), Vec::new());
        memory::reserve_map(&mut seen, 1)?;
        seen.insert(first, ());
        memory::push(&mut waiting, first)?;
        while let Some(at) = waiting.pop() {
            let corners = self.corners_of(cells, at);
            let beyond = self.facets_before(&corners, place);
            if beyond == 0 {
                let vertex = corners[..=G::D].iter().find(|(_, p)| p.as_ref() == place.as_ref());
                return Ok(
                    vertex.map_or(PeriodicLocation::Cell(at), |&(image, _)| PeriodicLocation::Vertex(image))
                );
            }
            // What waits last is looked at first: neighbours towards the place.
            for is_beyond in [false, true] {
                for i in (0..=G::D).filter(|&i| (beyond >> i & 1 == 1) == is_beyond) {
                    let Some(across) = across(cells, at, i) else {
                        if is_beyond {
                            return Ok(PeriodicLocation::Outside(at));
                        }
                        continue;
                    };
                    if seen.contains_key(&across) {
                        continue;
                    }
                    memory::reserve_map(&mut seen, 1)?;
                    seen.insert(across, ());
                    let places = self.corners_of(cells, across).map(|(_, place)| place);
                    if way.may_meet(&PlaceRanges::of(&self.lattice, &places[..=G::D])) {
                        memory::push(&mut waiting, across)?;
                    }
                }
            }
        }
        unreachable!("the cells that a way meets are connected")
    }

    /// A cell of the repeating set at a corner of one inside, and where that corner is.
    fn first_of(&self, cells: &PeriodicCells<G>, cell: CellId) -> Result<(PlacedCell, G::Point)> {
        let inside = &self.inside;
        let row = inside.t.cells()?.corners[cell];
        let corner = row.as_ref().iter().copied().min().expect("a cell has corners");
        let image = inside.images.of(corner);
        let Image { vertex, shift } = match self.at_image(cells, image)? {
            AtImage::Corner(shown) => shown,
            AtImage::Above(placed) => {
                let home = &inside.places[inside.images.home(image.vertex)];
                return Ok((placed, self.lattice.translated(home, image.shift)));
            }
        };
        let place = self.lattice.translated(&inside.places[inside.images.home(vertex)], shift);
        if cells.class_of[cell] != NO_CELL {
            return Ok((self.placed(cells, cell)?, place));
        }
        let mut star = Vec::new();
        inside.t.star(inside.images.home(vertex), &mut star)?;
        let (class, by) = self.placed(cells, star[0])?;
        Ok(((class, plus(by, shift)), place))
    }

    /// The facets of a cell that have a place strictly beyond them, by the bits of the corners opposite.
    pub(super) fn facets_before(&self, corners: &[(Image, G::Point); 4], place: &G::Point) -> u32 {
        let (mut low, mut high) = (*place, *place);
        for (_, corner) in &corners[..=G::D] {
            for axis in 0..G::D {
                low[axis] = low[axis].min(corner[axis]);
                high[axis] = high[axis].max(corner[axis]);
            }
        }
        let filter = G::filter(&low, &high);
        let mut facets = 0;
        for i in 0..=G::D {
            let mut points = corners.each_ref().map(|(_, corner)| corner);
            points[i] = place;
            facets |= u32::from(G::orient(&filter, &points[..=G::D]) < 0.0) << i;
        }
        facets
    }
}

/// The cell beyond the facet of one that is opposite a corner; none on the hull.
pub(super) fn across<G: Moving>(
    cells: &PeriodicCells<G>,
    (class, by): PlacedCell,
    i: usize,
) -> Option<PlacedCell> {
    let next = cells.neighbours[class].as_ref()[i];
    (next != NO_CELL).then(|| (next, plus(cells.neighbour_shifts.of(class.index())[i], by)))
}

fn location_of(location: PeriodicLocation) -> Location {
    match location {
        PeriodicLocation::Vertex(image) => Location::Vertex(image.vertex),
        PeriodicLocation::Cell((class, _)) => Location::Cell(class),
        PeriodicLocation::Outside((class, _)) => Location::Outside(class),
        PeriodicLocation::NoCells => Location::NoCells,
    }
}
