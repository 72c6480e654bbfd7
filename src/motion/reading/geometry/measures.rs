//! Numbers of each cell: circumsphere, volume, and whether its circumradius is within a bound.

use std::ops::Range;

use crate::delaunay::Moving;
use crate::error::{Error, Result};
use crate::ids::{CellId, Slot};
use crate::machine::prefetch::{AHEAD, prefetch};
use crate::motion::state::checking::check_not_negative;
use crate::motion::triangulation::MovingTriangulation;
use crate::predicates::{Measures, Reach};

impl<G: Moving> MovingTriangulation<G> {
    /// What `measure` gives for the corners of the cells in some slots; `later` tells which of them is at an index.
    #[inline(always)]
    fn measures<'t, T: 't>(
        &'t self,
        slots: impl ExactSizeIterator<Item = Slot> + 't,
        later: impl Fn(usize) -> Option<Slot> + 't,
        measure: impl Fn(&[&'t G::Point]) -> T + 't,
    ) -> impl ExactSizeIterator<Item = T> + 't {
        let kernel = &self.mesh.kernel;
        slots.enumerate().map(move |(index, slot)| {
            if let Some(next) = later(index + AHEAD) {
                prefetch(kernel.complex().cells(), next.index());
            }
            if let Some(next) = later(index + AHEAD / 2) {
                let corners = kernel.complex().cell(next).corners;
                corners.as_ref().iter().for_each(|s| prefetch(kernel.sites(), s.index()));
            }
            measure(&kernel.places(slot)[..G::D + 1])
        })
    }

    /// The measures of all cells, in the order of [`cells`](Self::cells).
    #[inline(always)]
    fn measures_of_all<'t, T: 't>(
        &'t self,
        measure: impl Fn(&[&'t G::Point]) -> T + 't,
    ) -> Result<impl ExactSizeIterator<Item = T> + 't> {
        let slots = self.cell_arrays()?.slots();
        Ok(self.measures(slots.iter().copied(), |k| slots.get(k).copied(), measure))
    }

    /// The measures of the cells of these indices.
    #[inline(always)]
    fn measures_of<'t, T: 't>(
        &'t self,
        cells: &'t [CellId],
        measure: impl Fn(&[&'t G::Point]) -> T + 't,
    ) -> Result<impl ExactSizeIterator<Item = T> + 't> {
        let slots = self.cell_arrays()?.slots();
        if let Some(index) = cells.iter().position(|cell| cell.index() >= slots.len()) {
            return Err(Error::NoSuchCell {
                argument: "cells",
                index,
                cell: cells[index],
                cells: slots.len(),
            });
        }
        let slot_of = |&cell: &CellId| slots[cell];
        Ok(self.measures(cells.iter().map(slot_of), move |k| cells.get(k).map(slot_of), measure))
    }

    /// Circumcentre and squared circumradius of each cell, in the order of [`cells`](Self::cells).
    ///
    /// A coordinate of a centre is off by at most 10⁻⁹ circumradii and its own rounding, a squared radius by 4·10⁻⁹ of
    /// itself; by a few last bits unless the cell is nearly flat. They are infinite where the value is too large for a
    /// number, and never NaN.
    ///
    /// With weights these are power spheres: the power of the centre in respect of every corner is the squared radius,
    /// which may be negative. With the greatest m of the distance of the centre from the first corner, of differences
    /// of coordinates of corners from that one's, and of roots of differences of weights, a coordinate is off by at
    /// most 10⁻⁹ m and its own rounding, a squared radius by 4·10⁻⁹ m² and the rounding of that weight.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn circumspheres(&self) -> Result<impl ExactSizeIterator<Item = (G::Point, f64)> + '_> {
        self.measures_of_all(G::Point::circumsphere)
    }

    /// The circumspheres of the cells of a range of indices that there are.
    pub(crate) fn circumspheres_in(
        &self,
        cells: Range<usize>,
    ) -> Result<impl ExactSizeIterator<Item = (G::Point, f64)> + '_> {
        let slots = &self.cell_arrays()?.slots()[cells];
        Ok(self.measures(slots.iter().copied(), |k| slots.get(k).copied(), G::Point::circumsphere))
    }

    /// Circumcentre and squared circumradius of the cells of these indices, in their order, with the errors that
    /// [`circumspheres`](Self::circumspheres) documents.
    ///
    /// Rounding depends on the order in which the kernel has the corners of a cell. That may change when the cell is
    /// removed and created again between two readings, so a value that is kept meanwhile agrees with that of a full
    /// pass within the errors documented, not always bit by bit. So it is with [`volumes_of`](Self::volumes_of).
    ///
    /// # Errors
    /// [`Error::NoSuchCell`], [`Error::OutOfMemory`].
    pub fn circumspheres_of<'t>(
        &'t self,
        cells: &'t [CellId],
    ) -> Result<impl ExactSizeIterator<Item = (G::Point, f64)> + 't> {
        self.measures_of(cells, G::Point::circumsphere)
    }

    /// Area or volume of each cell, in the order of [`cells`](Self::cells): positive, with a relative error of at most
    /// 10⁻⁹, and of a few last bits unless the cell is nearly flat.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    /// let t = MovingTriangulation::<Plane>::new(&corners, Options::default())?;
    /// assert_eq!(t.volumes()?.sum::<f64>(), 1.0);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn volumes(&self) -> Result<impl ExactSizeIterator<Item = f64> + '_> {
        self.measures_of_all(G::Point::volume)
    }

    /// Area or volume of the cells of these indices, in their order, with the errors that [`volumes`](Self::volumes)
    /// documents.
    ///
    /// # Errors
    /// [`Error::NoSuchCell`], [`Error::OutOfMemory`].
    pub fn volumes_of<'t>(&'t self, cells: &'t [CellId]) -> Result<impl ExactSizeIterator<Item = f64> + 't> {
        self.measures_of(cells, G::Point::volume)
    }

    /// Whether the squared circumradius of each cell is at most `squared_radius`, decided exactly; in the order of
    /// [`cells`](Self::cells). With weights it is that of the power sphere, and may be negative, as the bound may.
    ///
    /// ```
    /// use deldrift::{Plane, motion::{MovingTriangulation, Options}};
    ///
    /// let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [9.0, 9.0]];
    /// let t = MovingTriangulation::<Plane>::new(&points, Options::default())?;
    /// let mask: Vec<bool> = t.mask_by_circumradius(1.0)?.collect();
    /// assert_eq!(mask.iter().filter(|&&is_small| is_small).count(), 1);
    /// # Ok::<(), deldrift::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::InvalidValue`] if the bound is negative or NaN, with weights only if it is NaN; [`Error::OutOfMemory`].
    pub fn mask_by_circumradius(
        &self,
        squared_radius: f64,
    ) -> Result<impl ExactSizeIterator<Item = bool> + '_> {
        check_square::<G>(squared_radius)?;
        self.measures_of_all(
            #[inline(always)]
            move |cell| G::Point::is_circumradius_within(cell, squared_radius),
        )
    }

    /// Whether the squared circumradius of each cell of these indices is at most `squared_radius`, decided exactly; in
    /// their order.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] if the bound is negative or NaN, with weights only if it is NaN; [`Error::NoSuchCell`],
    /// [`Error::OutOfMemory`].
    pub fn mask_by_circumradius_of<'t>(
        &'t self,
        cells: &'t [CellId],
        squared_radius: f64,
    ) -> Result<impl ExactSizeIterator<Item = bool> + 't> {
        check_square::<G>(squared_radius)?;
        self.measures_of(
            cells,
            #[inline(always)]
            move |cell| G::Point::is_circumradius_within(cell, squared_radius),
        )
    }

    /// Tells the [`circumspheres`](Self::circumspheres) of all cells, or of those of these indices, in their order.
    pub(crate) fn for_circumspheres(
        &self,
        cells: Option<&[CellId]>,
        tell: impl FnMut(CellId, (G::Point, f64)),
    ) -> Result<()> {
        match cells {
            None => tell_all(None, self.circumspheres()?, tell),
            Some(some) => tell_all(cells, self.circumspheres_of(some)?, tell),
        }
        Ok(())
    }

    /// Tells the [`volumes`](Self::volumes) of all cells, or of those of these indices, in their order.
    pub(crate) fn for_volumes(&self, cells: Option<&[CellId]>, tell: impl FnMut(CellId, f64)) -> Result<()> {
        match cells {
            None => tell_all(None, self.volumes()?, tell),
            Some(some) => tell_all(cells, self.volumes_of(some)?, tell),
        }
        Ok(())
    }

    /// Tells the [`mask_by_circumradius`](Self::mask_by_circumradius) of all cells, or of those of these indices, in their
    /// order.
    pub(crate) fn for_mask_by_circumradius(
        &self,
        squared_radius: f64,
        cells: Option<&[CellId]>,
        tell: impl FnMut(CellId, bool),
    ) -> Result<()> {
        match cells {
            None => tell_all(None, self.mask_by_circumradius(squared_radius)?, tell),
            Some(some) => tell_all(cells, self.mask_by_circumradius_of(some, squared_radius)?, tell),
        }
        Ok(())
    }
}

/// Whether a bound of squared circumradii is one; with weights these may be negative.
fn check_square<G: Moving>(squared: f64) -> Result<()> {
    if !G::HAS_WEIGHTS {
        return check_not_negative("squared_radius", squared);
    }
    let (argument, wanted) = ("squared_radius", "a number or infinite");
    if squared.is_nan() {
        Err(Error::InvalidValue { argument, index: 0, value: squared, wanted })
    } else {
        Ok(())
    }
}

/// Tells what there is of each cell: of these, or of all from 0 on.
pub(crate) fn tell_all<T>(
    cells: Option<&[CellId]>,
    values: impl Iterator<Item = T>,
    mut tell: impl FnMut(CellId, T),
) {
    for (k, value) in values.enumerate() {
        tell(cells.map_or_else(|| CellId::at(k), |cells| cells[k]), value);
    }
}
impl<G: Moving> MovingTriangulation<G> {
    /// For each of the cells of these indices, in their order, a centre and a radius of a closed ball that certainly has
    /// the closed ball of the cell in it. It is larger by some 10⁻¹² of the radius and last bits of the coordinates, by up
    /// to 4·10⁻⁹ of the radius where the cell is nearly flat. Where numbers do not suffice the radius is infinite, and the
    /// centre is a corner. With weights they have the reach of the cell for a vertex of the greatest weight that there is, or of
    /// 0 if that is greater.
    ///
    /// # Errors
    /// [`Error::NoSuchCell`], [`Error::OutOfMemory`].
    pub fn covering_balls_of<'t>(
        &'t self,
        cells: &'t [CellId],
    ) -> Result<impl ExactSizeIterator<Item = (G::Point, f64)> + 't> {
        let greatest = self.greatest_weight().max(0.0);
        self.measures_of(cells, move |cell| G::Point::covering_ball(cell, greatest))
    }
}
