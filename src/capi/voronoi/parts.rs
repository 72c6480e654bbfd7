//! What Voronoi cells and facets are clipped by, and where they are written to.

use std::mem::MaybeUninit;

use crate::capi::pointers::{Array, Buffer, Fitting, Output, Point, fit, given};
use crate::capi::status::Failure;
use crate::delaunay::Moving;
use crate::error::Result;
use crate::ids::VertexId;
use crate::motion::{MovingTriangulation, TellCell, TellFacet, VoronoiCell, VoronoiFacet};
use crate::periodic::PeriodicTriangulation;

/// Where Voronoi cells are written to.
#[derive(Clone, Copy)]
pub(super) struct CellArrays {
    pub(super) volumes: *mut f64,
    pub(super) areas: *mut f64,
    pub(super) centroids: *mut f64,
    pub(super) capacity: usize,
    pub(super) count: *mut usize,
}

/// Where Voronoi facets are written to.
#[derive(Clone, Copy)]
pub(super) struct FacetArrays {
    pub(super) measures: *mut f64,
    pub(super) centroids: *mut f64,
    pub(super) derivatives: *mut f64,
    /// For derivatives by weights, if these are all that is asked for.
    pub(super) weight_derivatives: Option<*mut f64>,
    pub(super) capacity: usize,
    pub(super) count: *mut usize,
}

impl FacetArrays {
    /// For measures alone.
    pub(super) fn of_measures(measures: *mut f64, capacity: usize, count: *mut usize) -> Self {
        let none = std::ptr::null_mut();
        FacetArrays {
            measures,
            centroids: none,
            derivatives: none,
            weight_derivatives: None,
            capacity,
            count,
        }
    }

    /// For derivatives by weights alone.
    pub(super) fn of_weight_derivatives(
        weight_derivatives: *mut f64,
        capacity: usize,
        count: *mut usize,
    ) -> Self {
        let none = Self::of_measures(std::ptr::null_mut(), capacity, count);
        FacetArrays { weight_derivatives: Some(weight_derivatives), ..none }
    }
}

/// Buffers that have room for rows, or are not there.
pub(super) struct Rows<'a> {
    columns: [&'a mut [MaybeUninit<f64>]; 4],
    fitting: Fitting<'a>,
}

impl CellArrays {
    /// Buffers for so many cells in a dimension, if they are large enough.
    ///
    /// # Safety
    /// Each pointer is NULL, misaligned, or to as much room as the header says, for as long as the rows are used.
    pub(super) unsafe fn rows<'a>(self, d: usize, needed: usize) -> Result<Rows<'a>, Failure> {
        let CellArrays { volumes, areas, centroids, capacity, count } = self;
        given!(volumes[capacity]: Buffer, areas[capacity]: Buffer, count: Output);
        given!(centroids[capacity.saturating_mul(d)]: Buffer);
        let offers = [volumes.offer(), areas.offer(), centroids.offer()];
        let fitting = fit(count, needed, capacity, &offers)?;
        let columns = [
            volumes.places_if_any(needed)?,
            areas.places_if_any(needed)?,
            centroids.places_if_any(needed * d)?,
            &mut [],
        ];
        Ok(Rows { columns, fitting })
    }
}

impl FacetArrays {
    /// Buffers for so many facets in a dimension, if they are large enough; under other names beside those of cells.
    ///
    /// # Safety
    /// Each pointer is NULL, misaligned, or to as much room as the header says, for as long as the rows are used.
    pub(super) unsafe fn rows<'a>(
        self,
        d: usize,
        needed: usize,
        is_beside_cells: bool,
    ) -> Result<Rows<'a>, Failure> {
        let FacetArrays { measures, centroids, derivatives, weight_derivatives, capacity, count } = self;
        let (facet_centroids, edge_count, n) = (centroids, count, capacity.saturating_mul(d));
        given!(measures[capacity]: Buffer, derivatives[n.saturating_mul(2)]: Buffer);
        let are_by_weight = weight_derivatives.is_some();
        let weight_derivatives = weight_derivatives.unwrap_or(std::ptr::null_mut());
        given!(weight_derivatives[capacity]: Buffer);
        let (centroids, count) = if is_beside_cells {
            given!(facet_centroids[n]: Buffer, edge_count: Output);
            (facet_centroids, edge_count)
        } else {
            given!(centroids[n]: Buffer, count: Output);
            (centroids, count)
        };
        let offers = if are_by_weight {
            [weight_derivatives.offer(); 3]
        } else {
            [measures.offer(), centroids.offer(), derivatives.offer()]
        };
        let fitting = fit(count, needed, capacity, &offers).map_err(|failure| match failure {
            Failure::BufferTooSmall { capacity, needed, .. } if is_beside_cells => {
                Failure::BufferTooSmall { argument: "edge_capacity", capacity, needed }
            }
            other => other,
        })?;
        let columns = [
            measures.places_if_any(needed)?,
            centroids.places_if_any(needed * d)?,
            derivatives.places_if_any(needed * 2 * d)?,
            weight_derivatives.places_if_any(needed)?,
        ];
        Ok(Rows { columns, fitting })
    }
}

/// Buffers, if there are any of the kind, and if they are in order.
type Given<'a> = Option<Result<Rows<'a>, Failure>>;

/// Buffers that are in order. Where those of one kind are too small, it is told of both how many entries there are.
fn in_order<'a>(cells: Given<'a>, facets: Given<'a>) -> Result<[Option<Rows<'a>>; 2], Failure> {
    let too_small = |failure: &Failure| matches!(failure, Failure::BufferTooSmall { .. });
    match (cells, facets) {
        (Some(Ok(rows)), Some(Err(failure))) | (Some(Err(failure)), Some(Ok(rows))) => {
            if too_small(&failure) {
                rows.fitting.tell();
            }
            Err(failure)
        }
        (cells, facets) => Ok([cells.transpose()?, facets.transpose()?]),
    }
}

/// Writes what `list` tells of cells and of facets, as far as there are buffers, and tells how many entries there are.
pub(super) fn fill<P: AsRef<[f64]>>(
    cells: Given<'_>,
    facets: Given<'_>,
    list: impl FnOnce(TellCell<'_, P>, TellFacet<'_, P>) -> Result<()>,
) -> Result<(), Failure> {
    let [mut cells, mut facets] = in_order(cells, facets)?;
    let are_any = |rows: &&mut Rows<'_>| rows.fitting.are_any;
    let mut tell_cell = cells.as_mut().filter(are_any).map(|rows| {
        let [volumes, areas, centroids, _] = &mut rows.columns;
        |v: VertexId, cell: VoronoiCell<P>| {
            write(volumes, v.index(), &[cell.volume]);
            write(areas, v.index(), &[cell.area]);
            write(centroids, v.index(), cell.centroid.as_ref());
        }
    });
    let mut tell_facet = facets.as_mut().filter(are_any).map(|rows| {
        let [measures, centroids, derivatives, weight_derivatives] = &mut rows.columns;
        |edge: usize, facet: VoronoiFacet<P>| {
            write(measures, edge, &[facet.area]);
            write(centroids, edge, facet.centroid.as_ref());
            write(derivatives, 2 * edge, facet.derivatives[0].as_ref());
            write(derivatives, 2 * edge + 1, facet.derivatives[1].as_ref());
            write(weight_derivatives, edge, &[facet.weight_derivative]);
        }
    });
    if tell_cell.is_some() || tell_facet.is_some() {
        list(
            tell_cell.as_mut().map(|tell| tell as &mut dyn FnMut(_, _)),
            tell_facet.as_mut().map(|tell| tell as &mut dyn FnMut(_, _)),
        )?;
    }
    cells.into_iter().chain(facets).for_each(|rows| rows.fitting.tell());
    Ok(())
}

/// Rows of a normal and an offset, as numbers.
///
/// # Safety
/// `half_spaces` is NULL, misaligned, or to as many rows of `d` + 1 numbers, for as long as they are used.
pub(super) unsafe fn half_space_rows<'a>(
    d: usize,
    half_spaces: *const f64,
    half_space_count: usize,
) -> Result<&'a [f64], Failure> {
    if d == 2 {
        let half_spaces = half_spaces.cast::<[f64; 3]>();
        given!(half_spaces[half_space_count]: Array);
        return Ok(half_spaces.get()?.as_flattened());
    }
    let half_spaces = half_spaces.cast::<[f64; 4]>();
    given!(half_spaces[half_space_count]: Array);
    Ok(half_spaces.get()?.as_flattened())
}

/// Writes a row of numbers, if there is a buffer for rows.
fn write(places: &mut [MaybeUninit<f64>], row: usize, numbers: &[f64]) {
    let first = row * numbers.len();
    if let Some(places) = places.get_mut(first..first + numbers.len()) {
        places.iter_mut().zip(numbers).for_each(|(place, &x)| _ = place.write(x));
    }
}

/// A mask of vertices, if there is one, with as many entries as `check` wants.
pub(super) fn mask_for(
    mask: Array<'_, u8>,
    mask_count: usize,
    check: impl FnOnce(usize) -> Result<()>,
) -> Result<Option<&[u8]>, Failure> {
    if mask.is_null() && mask_count == 0 {
        return Ok(None);
    }
    check(mask_count)?;
    mask.get().map(Some)
}

/// The corners of a box; none if both are NULL.
pub(super) fn box_for<G: Moving>(
    t: &PeriodicTriangulation<G>,
    low: Point<'_>,
    high: Point<'_>,
) -> Result<Option<[G::Point; 2]>, Failure> {
    if low.is_null() && high.is_null() {
        return Ok(None);
    }
    Ok(Some([low.of("low", t)?, high.of("high", t)?]))
}

/// The corners of a box that is a good one, in the dimension of `t`; none if both are NULL and none is needed.
pub(super) fn clip_for<G: Moving>(
    t: &MovingTriangulation<G>,
    low: Point<'_>,
    high: Point<'_>,
    is_needed: bool,
) -> Result<Option<[G::Point; 2]>, Failure> {
    if low.is_null() && high.is_null() && !is_needed {
        return Ok(None);
    }
    let clip = [low.of("low", t)?, high.of("high", t)?];
    t.check_clip(clip.each_ref())?;
    Ok(Some(clip))
}
