//! Values between vertices, and the weights of places in cells.
//!
//! Of each class one cell inside has its least vertex at home. A place is taken to where it is in that cell, exactly, so the
//! numbers do not depend on the period.

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::CellId;
use crate::machine::memory;
use crate::motion::{Interpolation, Location, Ridges, VertexValues};
use crate::periodic::images::Image;
use crate::periodic::inside::all;
use crate::periodic::lattice::{HOME, Range, Shift};
use crate::periodic::locating::{PeriodicLocation, PlacedCell};
use crate::periodic::reduction::SLACK;
use crate::periodic::triangulation::PeriodicTriangulation;
use crate::periodic::zone::ZoneCells;

impl<G: Moving> PeriodicTriangulation<G> {
    /// Interpolates values of vertices at positions, rounded to the grid of the lattice: those of each are told to `found`, or `None` for positions outside the convex hull of a set that is open in some direction. An image of a
    /// vertex has its values. Those of hidden and removed vertices are not read. Each position is looked for from the one before,
    /// the first one from `near`, if that is near it.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{Interpolation, Options, VertexValues}, periodic::PeriodicTriangulation};
    ///
    /// let points = [[0.0, 0.0], [0.5, 0.0]];
    /// let t = PeriodicTriangulation::<Plane>::new(&points, &[[1.0, 0.0], [0.0, 1.0]], Options::default())?;
    /// let heights = VertexValues { values: &[0.0, 1.0], n_values: 1 };
    /// let mut found = Vec::new();
    /// t.interpolate(Interpolation::Linear, heights, &[[0.75, 5.0], [-0.25, 0.5]], None, |values| {
    ///     found.push(values.unwrap()[0]);
    /// })?;
    /// assert_eq!(found, [0.5, 0.5]);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::WrongCount`] unless there are values for each id; [`Error::NotFinite`] and [`Error::OutOfRange`] for a
    /// position; [`Error::OutOfMemory`], before or after some have been told.
    pub fn interpolate(
        &self,
        method: Interpolation,
        given: VertexValues<'_>,
        positions: &[G::Point],
        near: Option<Location>,
        mut found: impl FnMut(Option<&[f64]>),
    ) -> Result<()> {
        let wanted = self.id_count() * given.n_values;
        if given.values.len() != wanted {
            let coming = self.staged.insertions().len() * given.n_values;
            let (argument, given) = ("the length of values", given.values.len());
            return Err(Error::WrongCount { argument, given, wanted, coming });
        }
        let asked = self.asked(positions)?;
        let locations = self.periodic_locations(&asked, near)?;
        let cells = self.read_cells()?;
        let (mut weights, mut result) = (Vec::new(), Vec::new());
        let (mut of_images, mut zone, mut ridges) = (Vec::new(), ZoneCells::default(), Ridges::default());
        memory::lengthen(&mut result, given.n_values, 0.0)?;
        for (place, location) in asked.places.iter().zip(locations) {
            match location {
                PeriodicLocation::Vertex(Image { vertex, .. }) => given.combine([(vertex, 1.0)], &mut result),
                PeriodicLocation::Cell(placed) if method == Interpolation::NaturalNeighbour => {
                    self.natural_weights(cells, (placed, place), &mut zone, &mut ridges, &mut of_images)?;
                    let of_vertices = of_images.iter().map(|&(image, weight)| (image.vertex, weight));
                    given.combine(of_vertices, &mut result);
                }
                PeriodicLocation::Cell((class, shift)) => {
                    let place = self.lattice.translated(place, shift.map(|n| -n));
                    self.inside.t.linear_weights(cells.chosen[class], &place, &mut weights)?;
                    let of_vertices =
                        weights.iter().map(|&(v, weight)| (self.inside.images.of(v).vertex, weight));
                    given.combine(of_vertices, &mut result);
                }
                PeriodicLocation::Outside(_) | PeriodicLocation::NoCells => {
                    found(None);
                    continue;
                }
            }
            found(Some(&result));
        }
        Ok(())
    }

    /// The barycentric coordinates of each position, rounded to the grid of the lattice, in the translation of the cell of the same
    /// index of the list that has it: told to `found`, one for each corner in the order of [`cells`](Self::cells). `None` where the
    /// cell is [`CellId::NONE`], and where no translation of it has the position inside or on its boundary.
    ///
    /// ```
    /// use deldrift::{CellId, Plane, motion::{Location, Options}, periodic::PeriodicTriangulation};
    ///
    /// let t = PeriodicTriangulation::<Plane>::new(&[[0.0, 0.0]], &[[1.0, 0.0], [0.0, 1.0]], Options::default())?;
    /// let position = [7.25, 0.5];
    /// let Location::Cell(cell) = t.locate(&position)? else { panic!("it is at no vertex") };
    /// t.barycentric(&[position], &[cell], |weights| assert_eq!(weights.unwrap().iter().sum::<f64>(), 1.0))?;
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::WrongCount`] unless there are as many cells as positions; [`Error::NotFinite`] and [`Error::OutOfRange`] for a
    /// position, [`Error::NoSuchCell`], [`Error::OutOfMemory`]: before anything is told.
    pub fn barycentric(
        &self,
        positions: &[G::Point],
        classes: &[CellId],
        found: impl FnMut(Option<&[f64]>),
    ) -> Result<()> {
        if classes.len() != positions.len() {
            let (given, wanted) = (classes.len(), positions.len());
            return Err(Error::WrongCount { argument: "the length of cells", given, wanted, coming: 0 });
        }
        let mut asked = self.asked(positions)?;
        let cells = self.read_cells()?;
        let n = cells.corners.len();
        let mut inner = Vec::new();
        memory::lengthen(&mut inner, classes.len(), CellId::NONE)?;
        for (index, &cell) in classes.iter().enumerate().filter(|(_, cell)| **cell != CellId::NONE) {
            if cell.index() >= n {
                return Err(Error::NoSuchCell { argument: "cells", index, cell, cells: n });
            }
            let place = asked.places[index];
            if let Some(shift) = self.shift_at(&place, cell)? {
                inner[index] = cells.chosen[cell];
                asked.places[index] = self.lattice.translated(&place, shift.map(|n| -n));
            }
        }
        self.inside.t.barycentric(&asked.places, &inner, found)
    }

    /// By which shift a cell is to be translated to have a place in the unit cell inside or on its boundary.
    fn shift_at(&self, place: &G::Point, class: CellId) -> Result<Option<Shift>> {
        let cells = self.read_cells()?;
        let corners = self.corners_of(cells, (class, HOME));
        let multiples = corners[..=G::D].iter().map(|(_, corner)| self.lattice.multiples(corner));
        let mut range = [(f64::INFINITY, f64::NEG_INFINITY); 3];
        for of_corner in multiples {
            for (range, x) in range.iter_mut().zip(of_corner) {
                *range = (range.0.min(x), range.1.max(x));
            }
        }
        let at = self.lattice.multiples(place);
        let [a, b, c]: [Range; 3] = [0, 1, 2].map(|j| {
            let slack = SLACK * (1.0 + at[j].abs() + range[j].0.abs() + range[j].1.abs());
            let (least, most) = (at[j] - range[j].1 - slack, at[j] - range[j].0 + slack);
            least.ceil() as i32..=most.floor() as i32
        });
        let has_place = |by: Shift| {
            let placed: PlacedCell = (class, by);
            self.facets_before(&self.corners_of(cells, placed), place) == 0
        };
        Ok(all(a, b, c).map(|(x, y, z)| [x, y, z]).find(|&by| has_place(by)))
    }
}
