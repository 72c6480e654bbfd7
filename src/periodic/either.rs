//! A periodic triangulation of either dimension, for bindings to other languages.

use crate::damage::LoadError;
use crate::delaunay::{Plane, Space};
use crate::error::Result;
use crate::motion::{Monitor, Options};
use crate::periodic::saving::SavedPeriodic;
use crate::periodic::triangulation::PeriodicTriangulation;

/// A periodic triangulation of the plane or of space.
#[derive(Debug)]
pub enum AnyPeriodic {
    /// Two dimensions.
    Plane(PeriodicTriangulation<Plane>),
    /// Three dimensions.
    Space(PeriodicTriangulation<Space>),
}

impl AnyPeriodic {
    /// Makes the triangulation that has been saved, as [`PeriodicTriangulation::load`] does, in its dimension.
    ///
    /// # Errors
    /// The errors of [`PeriodicTriangulation::load`].
    pub fn load(saved: &SavedPeriodic<'_>, options: Options) -> Result<Self, LoadError> {
        if saved.dimension() == 2 {
            PeriodicTriangulation::load(saved, options).map(Self::Plane)
        } else {
            PeriodicTriangulation::load(saved, options).map(Self::Space)
        }
    }

    /// A copy with a monitor of its own, as [`PeriodicTriangulation::try_clone`] makes it.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn try_clone(&self, monitor: Option<Monitor>) -> Result<Self> {
        Ok(match self {
            Self::Plane(t) => Self::Plane(t.try_clone(monitor)?),
            Self::Space(t) => Self::Space(t.try_clone(monitor)?),
        })
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
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
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
