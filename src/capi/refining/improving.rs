//! From a quality in C to a call that improves cells.

use std::ops::ControlFlow;

use super::{
    DomainCode, KeptCode, deldrift_domain, deldrift_kept, deldrift_quality, deldrift_quality_report,
};
use crate::capi::guard;
use crate::capi::handle::Changing;
use crate::capi::options::{Given, invalid};
use crate::capi::pointers::{Array, Output};
use crate::capi::status::{Failure, deldrift_status};
use crate::delaunay::Plane;
use crate::either::AnyTriangulation;
use crate::error::Error;
use crate::machine::memory;
use crate::machine::tally;
use crate::motion::{CoarsenOptions, Kept, MovingTriangulation, Quality, QualityReport, TooLarge};

/// What coarsening is told by a quality.
pub(super) fn coarsening_of(given: &deldrift_quality) -> Result<CoarsenOptions, Failure> {
    let deldrift_quality { margin, share, joins, growth, keeps, .. } = *given;
    Ok(CoarsenOptions { margin, share, joins, growth, keeps: kept_of(keeps)? })
}

/// Runs a call that improves the cells of a mask.
pub(super) fn improve(
    t: Changing<'_>,
    quality: Given<'_, deldrift_quality>,
    mask: Array<'_, u8>,
    mask_count: usize,
    report: Output<'_, deldrift_quality_report>,
    body: impl FnOnce(
        &mut MovingTriangulation<Plane>,
        &deldrift_quality,
        &Quality,
        &[u8],
    ) -> Result<QualityReport, Failure>,
) -> deldrift_status {
    t.change(|t| {
        let AnyTriangulation::Plane(t) = t else { return Err(Failure::NotOfThePlane) };
        let given = quality.get()?;
        let report = report.if_any()?;
        let is_whole_domain = mask.is_null() && mask_count == 0;
        if !is_whole_domain {
            t.check_mask(mask_count)?;
        }
        let has_own_labels = !(given.labels.is_null() && given.label_count == 0);
        let domain = domain_named(given.domain)?;
        let by_region = is_whole_domain && domain == deldrift_domain::DELDRIFT_DOMAIN_REGIONS;
        let needs_labels = by_region || !has_own_labels && given.area_count > 0;
        let labels = match needs_labels && t.has_regions() {
            true => decided_labels(t)?,
            false => Vec::new(),
        };
        let known = if is_whole_domain && !by_region { t.mask_since(domain as u32)? } else { None };
        let cells = match known {
            Some(cells) => cells,
            None if is_whole_domain => cells_of(t, domain, &labels)?,
            None => Vec::new(),
        };
        let mask = if is_whole_domain { &cells } else { mask.get()? };
        let is_too_large = given.is_too_large.map(|is_too_large| {
            move |corners: [[f64; 2]; 3]| {
                // SAFETY: the caller set both, the one for the other, and the corners are 6 numbers.
                let ask = || unsafe { is_too_large(given.user_data, corners.as_ptr().cast()) };
                match tally::uncounted(|| guard::call_back(ask)) {
                    answer if answer < 0 => ControlFlow::Break(()),
                    answer => ControlFlow::Continue(answer != 0),
                }
            }
        });
        let quality = Quality {
            least_angle: given.least_angle,
            greatest_area: given.greatest_area,
            labels: match has_own_labels {
                true => array("quality.labels", given.labels.cast(), given.label_count)?,
                false => (!labels.is_empty()).then_some(&labels),
            },
            areas: array("quality.areas", given.areas, given.area_count)?.unwrap_or_default(),
            sizes: array("quality.sizes", given.sizes, given.size_count)?,
            is_too_large: is_too_large.as_ref().map(|is_too_large| is_too_large as TooLarge),
            is_conforming: given.is_conforming != 0,
        };
        let done = body(t, &given, &quality, mask).map_err(of_quality)?;
        if is_whole_domain && !by_region {
            t.set_domain(domain as u32, mask);
        }
        if let Some(report) = report {
            report.write(done.into());
        }
        Ok(())
    })
}

/// An array that a quality names: none if its pointer is NULL and its count 0.
fn array<'a, T>(argument: &'static str, pointer: *const T, count: usize) -> Result<Option<&'a [T]>, Failure> {
    if pointer.is_null() && count == 0 {
        return Ok(None);
    }
    // SAFETY: the header has the caller promise that it is NULL, misaligned, or to so many values.
    let values = unsafe { Array::new(argument, pointer, count) }.get()?;
    Ok(Some(values))
}

/// The labels of the regions of all cells, as numbers without a sign.
fn decided_labels(t: &MovingTriangulation<Plane>) -> Result<Vec<u32>, Failure> {
    let (found, cells) = t.region_labels(0)?;
    if cells > 0 {
        return Err(Error::UndecidedRegions { cells }.into());
    }
    let mut labels = Vec::new();
    memory::collect(&mut labels, found.into_iter().map(|label| label as u32))?;
    Ok(labels)
}

/// The cells of a domain, for which `labels` has those of their regions if it needs them; none if no region has one.
fn cells_of(
    t: &MovingTriangulation<Plane>,
    domain: deldrift_domain,
    labels: &[u32],
) -> Result<Vec<u8>, Failure> {
    use deldrift_domain::*;
    let (numbers, is_in): (Vec<u32>, fn(u32) -> bool) = match domain {
        DELDRIFT_DOMAIN_NESTING => (t.nesting_levels()?, |level| level % 2 == 1),
        DELDRIFT_DOMAIN_EVEN_ODD => (t.crossing_numbers()?, |number| number % 2 == 1),
        DELDRIFT_DOMAIN_INSIDE => (t.nesting_levels()?, |level| level > 0),
        DELDRIFT_DOMAIN_REGIONS => (memory::copy_of(labels)?, |label| label as i32 > 0),
    };
    let mut mask = Vec::new();
    memory::collect(&mut mask, numbers.into_iter().map(|number| u8::from(is_in(number))))?;
    // Without labels there are no numbers.
    memory::lengthen(&mut mask, t.cell_count(), 0)?;
    Ok(mask)
}

/// The domain of a number.
fn domain_named(code: DomainCode) -> Result<deldrift_domain, Failure> {
    use deldrift_domain::*;
    [DELDRIFT_DOMAIN_NESTING, DELDRIFT_DOMAIN_EVEN_ODD, DELDRIFT_DOMAIN_INSIDE, DELDRIFT_DOMAIN_REGIONS]
        .into_iter()
        .find(|&known| known as u32 == code)
        .ok_or_else(|| invalid("quality.domain", code, "a deldrift_domain"))
}

pub(super) fn kept_of(code: KeptCode) -> Result<Kept, Failure> {
    use deldrift_kept::*;
    [(DELDRIFT_KEPT_NONE, Kept::None), (DELDRIFT_KEPT_OUTER, Kept::Outer), (DELDRIFT_KEPT_ALL, Kept::All)]
        .into_iter()
        .find(|&(known, _)| known as u32 == code)
        .map(|(_, kept)| kept)
        .ok_or_else(|| invalid("quality.keeps", code, "a deldrift_kept"))
}

/// An error about a quality, in the names of its fields.
fn of_quality(failure: Failure) -> Failure {
    let name = |argument: &'static str, is_count: bool| match (argument, is_count) {
        ("labels", true) => "quality.label_count",
        ("sizes", true) => "quality.size_count",
        ("sizes", false) => "quality.sizes",
        ("areas", false) => "quality.areas",
        ("least_angle", false) => "quality.least_angle",
        ("greatest_area", false) => "quality.greatest_area",
        ("margin", false) => "quality.margin",
        ("share", false) => "quality.share",
        ("joins", false) => "quality.joins",
        ("growth", false) => "quality.growth",
        (other, _) => other,
    };
    match failure {
        Failure::Call(Error::InvalidValue { argument, index, value, wanted }) => {
            Error::InvalidValue { argument: name(argument, false), index, value, wanted }.into()
        }
        Failure::Call(Error::WrongCount { argument, given, wanted, coming }) => {
            Error::WrongCount { argument: name(argument, true), given, wanted, coming }.into()
        }
        other => other,
    }
}
