//! A triangulation of either dimension, for bindings to other languages: what they hold is one type, and which
//! dimension it has is known when the program runs.

use crate::damage::LoadError;
use crate::delaunay::{Dimension, Plane, PowerPlane, PowerSpace, Space};
use crate::error::{Error, Result};
use crate::motion::{Monitor, MovingTriangulation, Options, Saved};
use crate::predicates::PointArray;

/// A triangulation of the plane or of space.
///
/// [`in_its_dimension!`](crate::in_its_dimension) runs the same code on either.
///
/// ```
/// use deldrift::{AnyTriangulation, in_its_dimension, motion::Options};
///
/// let corners = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0];
/// let t = AnyTriangulation::new(2, &corners, Options::default())?;
/// assert_eq!(t.dimension(), 2);
/// assert_eq!(in_its_dimension!(&t => t.cell_count()), 2);
/// # Ok::<(), deldrift::Error>(())
/// ```
#[derive(Debug)]
pub enum AnyTriangulation {
    /// Two dimensions.
    Plane(MovingTriangulation<Plane>),
    /// Three dimensions.
    Space(MovingTriangulation<Space>),
}

impl AnyTriangulation {
    /// Triangulates points in a `dimension`, 2 or 3, of which the coordinates are given one after the other.
    ///
    /// # Errors
    /// [`Error::InvalidDimension`], [`Error::WrongCount`] if the last point is incomplete, and those of
    /// [`MovingTriangulation::new`].
    pub fn new(dimension: u32, coordinates: &[f64], options: Options) -> Result<Self> {
        Ok(match dimension {
            2 => Self::Plane(MovingTriangulation::new(points_of::<Plane>(coordinates)?, options)?),
            3 => Self::Space(MovingTriangulation::new(points_of::<Space>(coordinates)?, options)?),
            given => return Err(Error::InvalidDimension { given }),
        })
    }

    /// Makes the triangulation that has been saved, as [`MovingTriangulation::load`] does, in its dimension.
    ///
    /// # Errors
    /// The errors of [`MovingTriangulation::load`].
    pub fn load(saved: &Saved<'_>, options: Options) -> Result<Self, LoadError> {
        if saved.dimension() == 2 {
            MovingTriangulation::load(saved, options).map(Self::Plane)
        } else {
            MovingTriangulation::load(saved, options).map(Self::Space)
        }
    }

    /// A copy with a monitor of its own, as [`MovingTriangulation::try_clone`] makes it.
    ///
    /// # Errors
    /// The errors of [`MovingTriangulation::try_clone`].
    pub fn try_clone(&self, monitor: Option<Monitor>) -> Result<Self> {
        Ok(match self {
            Self::Plane(t) => Self::Plane(t.try_clone(monitor)?),
            Self::Space(t) => Self::Space(t.try_clone(monitor)?),
        })
    }

    /// The number of coordinates of a point, 2 or 3.
    pub fn dimension(&self) -> u32 {
        match self {
            Self::Plane(_) => 2,
            Self::Space(_) => 3,
        }
    }
}

impl From<MovingTriangulation<Plane>> for AnyTriangulation {
    fn from(t: MovingTriangulation<Plane>) -> Self {
        Self::Plane(t)
    }
}

impl From<MovingTriangulation<Space>> for AnyTriangulation {
    fn from(t: MovingTriangulation<Space>) -> Self {
        Self::Space(t)
    }
}

/// A triangulation of points with weights, of the plane or of space, for bindings.
#[derive(Debug)]
pub enum AnyWeighted {
    /// Two dimensions.
    Plane(MovingTriangulation<PowerPlane>),
    /// Three dimensions.
    Space(MovingTriangulation<PowerSpace>),
}

impl AnyWeighted {
    /// Makes the triangulation that has been saved, as [`MovingTriangulation::load`] does, in its dimension.
    ///
    /// # Errors
    /// The errors of [`MovingTriangulation::load`].
    pub fn load(saved: &Saved<'_>, options: Options) -> Result<Self, LoadError> {
        if saved.dimension() == 2 {
            MovingTriangulation::load(saved, options).map(Self::Plane)
        } else {
            MovingTriangulation::load(saved, options).map(Self::Space)
        }
    }

    /// A copy with a monitor of its own, as [`MovingTriangulation::try_clone`] makes it.
    ///
    /// # Errors
    /// The errors of [`MovingTriangulation::try_clone`].
    pub fn try_clone(&self, monitor: Option<Monitor>) -> Result<Self> {
        Ok(match self {
            Self::Plane(t) => Self::Plane(t.try_clone(monitor)?),
            Self::Space(t) => Self::Space(t.try_clone(monitor)?),
        })
    }

    /// The number of coordinates of a point, 2 or 3.
    pub fn dimension(&self) -> u32 {
        match self {
            Self::Plane(_) => 2,
            Self::Space(_) => 3,
        }
    }
}

/// The points of which the coordinates are given one after the other, in the same memory.
///
/// ```
/// let points = deldrift::points_of::<deldrift::Plane>(&[0.0, 1.0, 2.0, 3.0])?;
/// assert_eq!(points, [[0.0, 1.0], [2.0, 3.0]]);
/// assert!(deldrift::points_of::<deldrift::Space>(&[0.0; 4]).is_err());
/// # Ok::<(), deldrift::Error>(())
/// ```
///
/// # Errors
/// [`Error::WrongCount`] if the last point is incomplete.
pub fn points_of<G: Dimension>(coordinates: &[f64]) -> Result<&[G::Point]> {
    let (points, rest) = G::Point::of_flattened(coordinates);
    if rest.is_empty() {
        return Ok(points);
    }
    let wanted = (points.len() + 1) * G::D;
    Err(Error::WrongCount { argument: "coordinates", given: coordinates.len(), wanted, coming: 0 })
}

/// Evaluates an expression on the triangulation of an [`AnyTriangulation`], or of a reference to one, in its dimension.
/// The expression is compiled once for each, so what it calls may be generic.
///
/// ```
/// use deldrift::{AnyTriangulation, Dimension, in_its_dimension, motion::{MovingTriangulation, Options}};
///
/// fn corners_per_cell<G: Dimension>(_t: &MovingTriangulation<G>) -> usize {
///     G::D + 1
/// }
///
/// let t = AnyTriangulation::new(3, &[], Options::default())?;
/// assert_eq!(in_its_dimension!(&t => corners_per_cell(t)), 4);
/// assert_eq!(in_its_dimension!(&t, space => space.vertex_count()), 0);
/// # Ok::<(), deldrift::Error>(())
/// ```
#[macro_export]
macro_rules! in_its_dimension {
    ($either:expr, $t:ident => $body:expr) => {
        match $either {
            $crate::AnyTriangulation::Plane($t) => $body,
            $crate::AnyTriangulation::Space($t) => $body,
        }
    };
    (&$t:ident => $body:expr) => {
        $crate::in_its_dimension!(&$t, $t => $body)
    };
    (&mut $t:ident => $body:expr) => {
        $crate::in_its_dimension!(&mut $t, $t => $body)
    };
    ($t:ident => $body:expr) => {
        $crate::in_its_dimension!($t, $t => $body)
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dimensions_are_kept_and_others_refused() {
        let made = |dimension, coordinates: &[f64]| {
            AnyTriangulation::new(dimension, coordinates, Options::default())
        };
        for (dimension, n_coordinates) in [(2, 6), (3, 12)] {
            let coordinates: Vec<f64> = (0..n_coordinates).map(|i| f64::from(i * i % 7)).collect();
            let t = made(dimension, &coordinates).expect("there are enough");
            let bytes = in_its_dimension!(&t => t.saved()).expect("there is memory");
            let saved = Saved::of(&bytes).expect("they are whole");
            let loaded = AnyTriangulation::load(&saved, Options::default()).expect("they are right");
            let copy = t.try_clone(None).expect("there is memory");
            assert_eq!([&t, &loaded, &copy].map(AnyTriangulation::dimension), [dimension; 3]);
            assert_eq!(in_its_dimension!(&copy => copy.saved()).expect("there is memory"), bytes);
            let incomplete = made(dimension, &coordinates[1..]).err();
            let (given, wanted) = (coordinates.len() - 1, coordinates.len());
            assert_eq!(
                incomplete,
                Some(Error::WrongCount { argument: "coordinates", given, wanted, coming: 0 })
            );
        }
        assert_eq!(made(4, &[]).err(), Some(Error::InvalidDimension { given: 4 }));
    }
}
