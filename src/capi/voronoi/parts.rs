//! What Voronoi cells and facets are clipped by, and where they are written to.

use std::mem::MaybeUninit;

use crate::capi::pointers::{Array, Buffer, Output, Point, fill_all, given};
use crate::capi::status::Failure;
use crate::delaunay::Dimension;
use crate::error::Result;
use crate::ids::VertexId;
use crate::motion::{MovingTriangulation, VoronoiCell, VoronoiFacet};
use crate::periodic::PeriodicTriangulation;

/// Buffers for what there is of Voronoi cells, for so many of these.
pub(super) struct OfCells<'a> {
    pub(super) volumes: Buffer<'a, f64>,
    pub(super) areas: Buffer<'a, f64>,
    pub(super) centroids: Buffer<'a, f64>,
    pub(super) capacity: usize,
}

impl OfCells<'_> {
    /// Writes what `list` tells, if the buffers are large enough, and tells how many entries there are.
    pub(super) fn fill<P: AsRef<[f64]> + Default>(
        self,
        count: Output<'_, usize>,
        needed: usize,
        list: impl FnOnce(&mut dyn FnMut(VertexId, VoronoiCell<P>)) -> Result<()>,
    ) -> Result<(), Failure> {
        let OfCells { volumes, areas, centroids, capacity } = self;
        fill_all(count, needed, capacity, [volumes.offer(), areas.offer(), centroids.offer()], || {
            let volumes = volumes.places_if_any(needed)?;
            let areas = areas.places_if_any(needed)?;
            let centroids = centroids.places_if_any(needed * P::default().as_ref().len())?;
            list(&mut |v, cell| {
                write(volumes, v.index(), &[cell.volume]);
                write(areas, v.index(), &[cell.area]);
                write(centroids, v.index(), cell.centroid.as_ref());
            })?;
            Ok(())
        })
    }
}

/// Buffers for Voronoi facets, for so many of these.
pub(super) struct OfFacets<'a> {
    pub(super) measures: Buffer<'a, f64>,
    pub(super) centroids: Buffer<'a, f64>,
    pub(super) derivatives: Buffer<'a, f64>,
    pub(super) capacity: usize,
}

impl OfFacets<'_> {
    /// Writes what `list` tells, if the buffers are large enough, and tells how many entries there are.
    pub(super) fn fill<P: AsRef<[f64]> + Default>(
        self,
        count: Output<'_, usize>,
        needed: usize,
        list: impl FnOnce(&mut dyn FnMut(usize, VoronoiFacet<P>)) -> Result<()>,
    ) -> Result<(), Failure> {
        let OfFacets { measures, centroids, derivatives, capacity } = self;
        let d = P::default().as_ref().len();
        fill_all(count, needed, capacity, [measures.offer(), centroids.offer(), derivatives.offer()], || {
            let measures = measures.places_if_any(needed)?;
            let centroids = centroids.places_if_any(needed * d)?;
            let derivatives = derivatives.places_if_any(needed * 2 * d)?;
            list(&mut |edge, facet| {
                write(measures, edge, &[facet.area]);
                write(centroids, edge, facet.centroid.as_ref());
                write(derivatives, 2 * edge, facet.derivatives[0].as_ref());
                write(derivatives, 2 * edge + 1, facet.derivatives[1].as_ref());
            })?;
            Ok(())
        })
    }
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
pub(super) fn write(places: &mut [MaybeUninit<f64>], row: usize, numbers: &[f64]) {
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
pub(super) fn box_for<'a, G: Dimension>(
    t: &PeriodicTriangulation<G>,
    low: Point<'a>,
    high: Point<'a>,
) -> Result<Option<[&'a G::Point; 2]>, Failure> {
    if low.is_null() && high.is_null() {
        return Ok(None);
    }
    Ok(Some([low.of("low", t)?, high.of("high", t)?]))
}

/// The corners of a box that is a good one, in the dimension of `t`; none if both are NULL.
pub(super) fn clip_for<'a, G: Dimension>(
    t: &MovingTriangulation<G>,
    low: Point<'a>,
    high: Point<'a>,
) -> Result<Option<[&'a G::Point; 2]>, Failure> {
    if low.is_null() && high.is_null() {
        return Ok(None);
    }
    let clip = [low.of("low", t)?, high.of("high", t)?];
    t.check_clip(clip)?;
    Ok(Some(clip))
}
