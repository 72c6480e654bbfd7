//! Numbers of each cell: circumsphere, volume, and whether its circumradius is within a bound.

use crate::delaunay::Dimension;
use crate::error::{Error, Result};
use crate::machine::prefetch::{AHEAD, prefetch};
use crate::motion::MovingTriangulation;
use crate::predicates::Measures;

impl<G: Dimension> MovingTriangulation<G> {
    /// What `measure` gives for the corners of each cell, in the order of [`cells`](Self::cells).
    #[inline(always)]
    fn measures<'t, T: 't>(
        &'t self,
        measure: impl Fn(&[&'t G::Point]) -> T + 't,
    ) -> Result<impl ExactSizeIterator<Item = T> + 't> {
        let (kernel, slots) = (&self.kernel, self.cell_arrays()?.slots());
        Ok(slots.iter().enumerate().map(move |(index, &slot)| {
            if let Some(&next) = slots.get(index + AHEAD) {
                prefetch(kernel.complex().cells(), next.index());
            }
            if let Some(&next) = slots.get(index + AHEAD / 2) {
                let corners = kernel.complex().cell(next).corners;
                corners.as_ref().iter().for_each(|s| prefetch(kernel.sites(), s.index()));
            }
            measure(&kernel.places(slot)[..G::D + 1])
        }))
    }

    /// Circumcentre and squared circumradius of each cell, in the order of [`cells`](Self::cells).
    ///
    /// A coordinate of a centre is off by at most 10⁻⁹ circumradii and its own rounding, a squared radius by 4·10⁻⁹ of
    /// itself; by a few last bits unless the cell is nearly flat. They are infinite where the value is too large for a
    /// number, and never NaN.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn circumspheres(&self) -> Result<impl ExactSizeIterator<Item = (G::Point, f64)> + '_> {
        self.measures(G::Point::circumsphere)
    }

    /// Area or volume of each cell, in the order of [`cells`](Self::cells): positive, with a relative error of at most
    /// 10⁻⁹, and of a few last bits unless the cell is nearly flat.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn volumes(&self) -> Result<impl ExactSizeIterator<Item = f64> + '_> {
        self.measures(G::Point::volume)
    }

    /// Whether the squared circumradius of each cell is at most `squared_radius`, decided exactly; in the order of
    /// [`cells`](Self::cells).
    ///
    /// # Errors
    /// [`Error::InvalidValue`] if the bound is negative or NaN, [`Error::OutOfMemory`].
    pub fn mask_by_circumradius(
        &self,
        squared_radius: f64,
    ) -> Result<impl ExactSizeIterator<Item = bool> + '_> {
        if squared_radius.is_nan() || squared_radius < 0.0 {
            let (argument, wanted) = ("squared_radius", "0 or more");
            return Err(Error::InvalidValue { argument, index: 0, value: squared_radius, wanted });
        }
        self.measures(
            #[inline(always)]
            move |cell| G::Point::is_circumradius_within(cell, squared_radius),
        )
    }
}
