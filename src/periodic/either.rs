//! A periodic triangulation of either dimension, with weights or without, for bindings to other languages.

use crate::damage::LoadError;
use crate::delaunay::{Moving, Plane, PowerPlane, PowerSpace, Space};
use crate::error::Result;
use crate::machine::memory;
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
    /// Two dimensions, of vertices with weights.
    PowerPlane(PeriodicTriangulation<PowerPlane>),
    /// Three dimensions, of vertices with weights.
    PowerSpace(PeriodicTriangulation<PowerSpace>),
}

impl AnyPeriodic {
    /// Makes the triangulation that has been saved, as [`PeriodicTriangulation::load`] does, in its dimension.
    ///
    /// # Errors
    /// The errors of [`PeriodicTriangulation::load`].
    pub fn load(saved: &SavedPeriodic<'_>, options: Options) -> Result<Box<Self>, LoadError> {
        match (saved.dimension(), saved.is_weighted()) {
            (2, false) => load_as(saved, options, Self::Plane),
            (2, true) => load_as(saved, options, Self::PowerPlane),
            (_, false) => load_as(saved, options, Self::Space),
            (_, true) => load_as(saved, options, Self::PowerSpace),
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
            Self::PowerPlane(t) => Self::PowerPlane(t.try_clone(monitor)?),
            Self::PowerSpace(t) => Self::PowerSpace(t.try_clone(monitor)?),
        })
    }

    /// The number of ids that have been given, those of staged insertions included.
    pub fn id_count(&self) -> usize {
        match self {
            Self::Plane(t) => t.id_count(),
            Self::Space(t) => t.id_count(),
            Self::PowerPlane(t) => t.id_count(),
            Self::PowerSpace(t) => t.id_count(),
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
            Self::PowerPlane(t) => t.cell_count(),
            Self::PowerSpace(t) => t.cell_count(),
        }
    }

    /// The number of coordinates of a point, 2 or 3.
    pub fn dimension(&self) -> u32 {
        match self {
            Self::Plane(_) | Self::PowerPlane(_) => 2,
            Self::Space(_) | Self::PowerSpace(_) => 3,
        }
    }

    /// Whether vertices have weights.
    pub fn is_weighted(&self) -> bool {
        matches!(self, Self::PowerPlane(_) | Self::PowerSpace(_))
    }
}

/// Loads one by itself, so that the stack has room for one alone.
#[inline(never)]
fn load_as<G: Moving>(
    saved: &SavedPeriodic<'_>,
    options: Options,
    any: impl FnOnce(PeriodicTriangulation<G>) -> AnyPeriodic,
) -> Result<Box<AnyPeriodic>, LoadError> {
    let t = PeriodicTriangulation::load(saved, options)?;
    Ok(memory::boxed_by(|| any(t))?)
}
