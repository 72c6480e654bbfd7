//! A geometry: all that differs between the plane and space, with weights and without.

use std::fmt::Debug;

use super::Delaunay;
use super::exchange::Exchange;
use super::flipper::Flip;
use super::shape::{Plane, PowerPlane, PowerSpace, Space};
use crate::error::Result;
use crate::ids::{SiteId, Slot};
use crate::predicates::{BiCellTolerances, Measures, Reach, StaticFilter};

/// The plane or space, with places by a power distance or without: what the kernel asks of it.
pub trait Geometry: Flip {
    /// Scratch memory of insertions.
    type Scratch: Insert<Self>;
}

/// A geometry in which vertices move.
pub trait Moving: Geometry<Point: BiCellTolerances + Measures + Reach> + Exchange {}

impl Moving for Plane {}
impl Moving for Space {}
impl Moving for PowerPlane {}
impl Moving for PowerSpace {}

/// A dimension: [`Plane`] or [`Space`].
pub trait Dimension: Moving {}

impl Dimension for Plane {}
impl Dimension for Space {}

/// How a geometry inserts, and the scratch memory for that.
pub trait Insert<G: Geometry>: Debug + Default + Send + Sync {
    /// Gets ready to insert very many sites, which will have `n_cells` cells: after that, and until
    /// [`end_build`](Self::end_build), `BUILD` is true. The complex keeps no record meanwhile. `is_weak` if the static
    /// filter is.
    fn begin_build(&mut self, _n_cells: usize, _is_weak: bool) -> Result<()> {
        Ok(())
    }

    /// Between insertions of a build, now and then: looks what tests have needed, for those to come.
    fn adapt(&mut self) {}

    /// Frees what [`begin_build`](Self::begin_build) made.
    fn end_build(&mut self) {}

    /// Whether the point is certainly in the sphere of a cell, as far as that is known.
    #[inline(always)]
    fn is_inside(&self, _filter: &StaticFilter, _cell: Slot, _q: &G::Point) -> bool {
        false
    }

    /// Bytes held.
    fn memory_bytes(&self) -> usize;

    /// Finds the conflict zone of the site `s`, of which the cell `start` is one, and joins its rim to the site.
    /// Returns one of the new cells. After an error nothing has changed.
    fn insert<const BUILD: bool>(&mut self, t: &mut Delaunay<G>, start: Slot, s: SiteId) -> Result<Slot>;

    /// The cells made by the last insertion.
    fn made(&self) -> impl ExactSizeIterator<Item = Slot> + '_;
}
