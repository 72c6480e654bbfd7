//! A periodic triangulation of either dimension, for bindings to other languages.

use crate::damage::LoadError;
use crate::delaunay::{Plane, Space};
use crate::error::{Error, Result};
use crate::ids::VertexId;
use crate::motion::{Monitor, Options};
use crate::periodic::saving::SavedPeriodic;
use crate::periodic::triangulation::PeriodicTriangulation;
use crate::points_of;

/// A periodic triangulation of the plane or of space.
#[derive(Debug)]
pub enum AnyPeriodic {
    /// Two dimensions.
    Plane(PeriodicTriangulation<Plane>),
    /// Three dimensions.
    Space(PeriodicTriangulation<Space>),
}

impl AnyPeriodic {
    /// Triangulates points in a `dimension`, 2 or 3, and all places to which the vectors take them; the coordinates of both are
    /// given one after the other.
    ///
    /// # Errors
    /// [`Error::InvalidDimension`], [`Error::WrongCount`] if the last point or vector is incomplete, and those of
    /// [`PeriodicTriangulation::new`].
    pub fn new(dimension: u32, coordinates: &[f64], vectors: &[f64], options: Options) -> Result<Self> {
        Ok(match dimension {
            2 => {
                let (points, vectors) = (points_of::<Plane>(coordinates)?, points_of::<Plane>(vectors)?);
                Self::Plane(PeriodicTriangulation::new(points, vectors, options)?)
            }
            3 => {
                let (points, vectors) = (points_of::<Space>(coordinates)?, points_of::<Space>(vectors)?);
                Self::Space(PeriodicTriangulation::new(points, vectors, options)?)
            }
            given => return Err(Error::InvalidDimension { given }),
        })
    }

    /// Makes the triangulation that has been saved, as [`PeriodicTriangulation::load`] does, in its dimension.
    ///
    /// # Errors
    /// Those of [`PeriodicTriangulation::load`].
    pub fn load(saved: &SavedPeriodic<'_>, options: Options) -> Result<Self, LoadError> {
        Ok(if saved.dimension() == 2 {
            Self::Plane(PeriodicTriangulation::load(saved, options)?)
        } else {
            Self::Space(PeriodicTriangulation::load(saved, options)?)
        })
    }

    /// A copy with a monitor of its own, as [`PeriodicTriangulation::try_clone`] makes it.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn try_clone(&self, monitor: Option<Monitor>) -> Result<Self> {
        Ok(match self {
            Self::Plane(t) => Self::Plane(t.try_clone(monitor)?),
            Self::Space(t) => Self::Space(t.try_clone(monitor)?),
        })
    }

    /// Those of [`PeriodicTriangulation::edges`].
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn edges(&self) -> Result<impl ExactSizeIterator<Item = ([VertexId; 2], [i64; 3])> + '_> {
        Ok(match self {
            Self::Plane(t) => OfEither::Plane(t.edges()?),
            Self::Space(t) => OfEither::Space(t.edges()?),
        })
    }

    /// Those of [`PeriodicTriangulation::voronoi_volumes`].
    ///
    /// # Errors
    /// [`Error::Cancelled`] if `monitor` returns `false`, [`Error::OutOfMemory`].
    pub fn voronoi_volumes(&self, monitor: &mut dyn FnMut(f64) -> bool) -> Result<Vec<f64>> {
        match self {
            Self::Plane(t) => t.voronoi_volumes(monitor),
            Self::Space(t) => t.voronoi_volumes(monitor),
        }
    }

    /// The number of ids that have been given, those of staged insertions included.
    pub fn id_count(&self) -> usize {
        match self {
            Self::Plane(t) => t.id_count(),
            Self::Space(t) => t.id_count(),
        }
    }

    /// Number of cells that are not translations of each other.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn cell_count(&self) -> Result<usize> {
        match self {
            Self::Plane(t) => t.cell_count(),
            Self::Space(t) => t.cell_count(),
        }
    }

    /// The number of coordinates of a point, 2 or 3.
    pub fn dimension(&self) -> u32 {
        match self {
            Self::Plane(_) => 2,
            Self::Space(_) => 3,
        }
    }
}

/// What a triangulation of the plane or of space lists.
enum OfEither<P, S> {
    Plane(P),
    Space(S),
}

impl<T, P: Iterator<Item = T>, S: Iterator<Item = T>> Iterator for OfEither<P, S> {
    type Item = T;

    fn next(&mut self) -> Option<T> {
        match self {
            Self::Plane(list) => list.next(),
            Self::Space(list) => list.next(),
        }
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        match self {
            Self::Plane(list) => list.size_hint(),
            Self::Space(list) => list.size_hint(),
        }
    }
}

impl<T, P: ExactSizeIterator<Item = T>, S: ExactSizeIterator<Item = T>> ExactSizeIterator for OfEither<P, S> {}
