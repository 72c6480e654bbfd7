//! Refinement and coarsening of the cells of a domain.

mod improving;

use std::ffi::{c_int, c_void};
use std::mem::offset_of;
use std::ptr;

use super::domain::of_the_plane;
use super::guard;
use super::handle::{Changing, Reading, deldrift_triangulation};
use super::options::{Given, Growing};
use super::pointers::{Array, Buffer, Output, fill_all, given, write_all};
use super::status::deldrift_status;
use crate::ids::VertexId;
use crate::motion::{QualityReport, RefineOptions};
use improving::{coarsening_of, improve, kept_of};

/// Which segments deldrift_refine keeps whole.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum deldrift_kept {
    /// None: the quality is reached wherever angles between segments allow it.
    DELDRIFT_KEPT_NONE = 0,
    /// Those with cells to be refined on one side only: the boundary of the cells that are refined.
    DELDRIFT_KEPT_OUTER = 1,
    /// All.
    DELDRIFT_KEPT_ALL = 2,
}

/// Which segments are kept whole as it arrives from C, where any number may be passed.
pub type KeptCode = u32;

/// Which cells deldrift_refine and deldrift_coarsen work on where they are given no mask.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum deldrift_domain {
    /// Those with an odd nesting level: see deldrift_nesting_levels.
    DELDRIFT_DOMAIN_NESTING = 0,
    /// Those with an odd crossing number, as the even-odd rule has it: see deldrift_crossing_numbers.
    DELDRIFT_DOMAIN_EVEN_ODD = 1,
    /// All within closed chains of segments: those with a nesting level above 0.
    DELDRIFT_DOMAIN_INSIDE = 2,
    /// Those in regions with a label above 0: see deldrift_regions.
    DELDRIFT_DOMAIN_REGIONS = 3,
}

/// Which cells are the domain as it arrives from C, where any number may be passed.
pub type DomainCode = u32;

/// What deldrift_refine and deldrift_coarsen work towards, and how. Initialise it with deldrift_quality_init, then set
/// what should differ from the defaults. Without a criterion nothing is done.
///
/// The structure may grow in later versions, as deldrift_options does. struct_size says how much of it the program
/// knows.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct deldrift_quality {
    /// sizeof(deldrift_quality) as the program sees it.
    pub struct_size: usize,
    /// The least angle of a cell in degrees, up to 34; 0, the default, for any. Up to 26.5 degrees it is proved that
    /// all cells have it wherever angles between segments are at least 60 degrees and no vertex is within 1,024 last
    /// places of the greatest coordinate of another one or of a segment. Above that they do in practice. Refinement
    /// ends for all angles and domains, as no vertex is inserted that is so near to another one.
    pub least_angle: f64,
    /// The greatest area of a cell; 0, the default, for any.
    pub greatest_area: f64,
    /// A label for each cell, in the order of deldrift_cells, as deldrift_label_cells gives them. NULL, the default,
    /// stands for those of deldrift_regions, with 0 for other.
    pub labels: *const i32,
    /// How many labels there are: as many as cells, or 0.
    pub label_count: usize,
    /// The greatest area of cells by label, 0 for any. Entry k is that of label k; labels below 0 and beyond the
    /// entries have none. New cells have the label of the region that they are in. NULL by default.
    pub areas: *const f64,
    /// How many areas there are.
    pub area_count: usize,
    /// By vertex id the greatest length of edges there: no edge of a cell is longer than the mean at its corners. New
    /// vertices have sizes in between. Entries are above 0, infinity for any; those of removed vertices are not used.
    /// NULL, the default, is no criterion.
    pub sizes: *const f64,
    /// How many sizes there are: as many as ids, or 0.
    pub size_count: usize,
    /// Another criterion: whether a cell is too large, given the coordinates of its corners, 6 numbers,
    /// counter-clockwise. It gives 1 if the cell is too large, otherwise 0. It has to give the same answer for the same
    /// corners, and 0 for cells that are small enough. A number below 0 stops: it is not called again, and the call
    /// ends in DELDRIFT_CANCELLED and has had no effect. It is called from inside the call as the callbacks of
    /// deldrift_options are. NULL, the default, for none.
    pub is_too_large: Option<unsafe extern "C" fn(user_data: *mut c_void, corners: *const f64) -> c_int>,
    /// Handed to is_too_large as it is.
    pub user_data: *mut c_void,
    /// Which segments deldrift_refine keeps whole: default DELDRIFT_KEPT_NONE. Cells at those that it keeps may stay
    /// bad.
    pub keeps: KeptCode,
    /// Not 0 if deldrift_refined_weights will be called. Default 0.
    pub has_weights: u32,
    /// Not 0 if no corner of a cell is to be strictly inside the circle that has a segment at the cell for a diameter.
    /// Then no vertex is inside the circle of a cell that it sees, segments or not: a conforming Delaunay
    /// triangulation. Segments that are kept whole may still have such corners, and so may those that a vertex touches
    /// and those at narrow gaps (see unsplit). What is said of 26.5 degrees then holds up to 20.7, and there are more
    /// cells. Default 0: segments are split where angles, areas and lengths need it.
    pub is_conforming: u32,
    /// Greatest number of vertices that deldrift_refine inserts: default SIZE_MAX.
    pub limit: usize,
    /// By how many degrees the angles of cells that deldrift_coarsen makes have to be above the least one, so that the
    /// removed vertex is not needed again at once: from 0 to 30, default 2.
    pub margin: f64,
    /// The share of the greatest areas and lengths that cells may have that deldrift_coarsen makes: above 0 and at most
    /// 1, default 0.9.
    pub share: f64,
    /// deldrift_coarsen joins two pieces of a segment if the vertex between them is on the line through their other
    /// ends, or off it by no more than this share of their distance: from 0 to 1. If the share is above 0, the vertex
    /// may always be off by 64 last places of the greatest coordinate. The default, 1e-9, is above what the rounding of
    /// motions adds up to.
    pub joins: f64,
    /// How many times as many vertices as a mesh made anew the mesh may have: 1 or more, default 1.1. Where
    /// deldrift_coarsen leaves more of those that deldrift_refine has inserted, or takes many away for another quality,
    /// the next deldrift_refine makes the mesh anew on a copy. If that has fewer vertices by this factor it takes it,
    /// in its one commit, and its report tells what was removed. Infinity for never. Not done with sizes.
    pub growth: f64,
    /// Not 0 if deldrift_refine gives its vertices free ids, as deldrift_stage_insertions_at_free_ids does: those of
    /// vertices that earlier commits have removed, the lowest first, and then new ones. deldrift_refined_vertices tells
    /// which. So deldrift_id_count does not grow for ever. From the first insertion on vertices then have keys, as if
    /// these had been given (see deldrift_keys): those that deldrift_refine inserts the greatest one, the others their
    /// ids. A program that transfers means of cells takes the changes between deldrift_coarsen and deldrift_refine as
    /// well, as a cell with the ids of a former one is not listed. Default 0.
    pub reuses_ids: u32,
    /// Which cells are refined without a mask: default DELDRIFT_DOMAIN_NESTING.
    pub domain: DomainCode,
}

impl Growing for deldrift_quality {
    const DEFAULT: Self = deldrift_quality {
        struct_size: size_of::<deldrift_quality>(),
        least_angle: 0.0,
        greatest_area: 0.0,
        labels: ptr::null(),
        label_count: 0,
        areas: ptr::null(),
        area_count: 0,
        sizes: ptr::null(),
        size_count: 0,
        is_too_large: None,
        user_data: ptr::null_mut(),
        keeps: 0,
        has_weights: 0,
        is_conforming: 0,
        limit: usize::MAX,
        margin: 2.0,
        share: 0.9,
        joins: 1e-9,
        growth: 1.1,
        reuses_ids: 0,
        domain: 0,
    };
    const ENDS: &'static [usize] = &[
        offset_of!(deldrift_quality, greatest_area),
        offset_of!(deldrift_quality, labels),
        offset_of!(deldrift_quality, label_count),
        offset_of!(deldrift_quality, areas),
        offset_of!(deldrift_quality, area_count),
        offset_of!(deldrift_quality, sizes),
        offset_of!(deldrift_quality, size_count),
        offset_of!(deldrift_quality, is_too_large),
        offset_of!(deldrift_quality, user_data),
        offset_of!(deldrift_quality, keeps),
        offset_of!(deldrift_quality, has_weights),
        offset_of!(deldrift_quality, is_conforming),
        offset_of!(deldrift_quality, limit),
        offset_of!(deldrift_quality, margin),
        offset_of!(deldrift_quality, share),
        offset_of!(deldrift_quality, joins),
        offset_of!(deldrift_quality, growth),
        offset_of!(deldrift_quality, reuses_ids),
        offset_of!(deldrift_quality, domain),
        size_of::<deldrift_quality>(),
    ];
    const SIZE: &'static str = "quality.struct_size";
    const SIZE_OF: &'static str = "sizeof(deldrift_quality)";
}

/// What deldrift_refine or deldrift_coarsen did.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct deldrift_quality_report {
    /// Vertices inserted. Their ids are the last ones below deldrift_id_count, or those of deldrift_refined_vertices if
    /// quality.reuses_ids was set.
    pub inserted: u64,
    /// How many of them are on segments.
    pub on_segments: u64,
    /// Vertices removed.
    pub removed: u64,
    /// Segments removed, as pieces have replaced a segment, or a segment pieces.
    pub replaced_segments: u64,
    /// Segments made. Their ids are the last ones that have been given.
    pub new_segments: u64,
    /// Pieces that had to be split and are whole, as there is no room for a vertex between their ends, as a vertex
    /// touches them (it is beside them by less than 1,024 last places of the greatest coordinate), or as what they
    /// had to be split for is across a narrow gap: one between two nearly parallel segments that is narrower than
    /// 1 / 8,192 of the shorter one.
    pub unsplit: u64,
    /// Cells that are still bad, of those that were to be refined: at small angles between segments, in narrow gaps
    /// between them, at segments that are kept whole, and where the limit was reached. What is_conforming asks of
    /// segments does not count.
    pub bad_cells: u64,
    /// 1 if the limit was reached, otherwise 0.
    pub is_cut_short: u64,
    /// Zero; later versions may count more.
    pub reserved: [u64; 4],
}

impl From<QualityReport> for deldrift_quality_report {
    fn from(report: QualityReport) -> Self {
        Self {
            inserted: report.inserted as u64,
            on_segments: report.on_segments as u64,
            removed: report.removed as u64,
            replaced_segments: report.replaced_segments as u64,
            new_segments: report.new_segments as u64,
            unsplit: report.unsplit as u64,
            bad_cells: report.bad_cells as u64,
            is_cut_short: u64::from(report.is_cut_short),
            reserved: [0; 4],
        }
    }
}

/// Sets a quality to the defaults: no criterion.
///
/// Cost: constant.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_quality_init(quality: *mut deldrift_quality) -> deldrift_status {
    given!(quality: Output);
    guard::enter(|| {
        quality.place()?.write(deldrift_quality::DEFAULT);
        Ok(())
    })
}

/// Inserts vertices into cells of the plane, and on segments at these, until the cells there are of a quality. It is
/// one commit of its own, all or nothing, and deldrift_take_changes tells what it has changed. docs/SEGMENTS.md has a
/// loop that moves, commits, coarsens and refines.
///
/// quality: what is wanted. mask: mask_count bytes, one for each cell in the order of deldrift_cells (mask_count must
/// be deldrift_cell_count). Cells are refined if their byte is not 0. They have to end at segments: an edge beyond
/// which there is no cell, or one that is not refined, has to have one. NULL with mask_count 0 stands for the domain
/// (see deldrift_domain): by default the cells that have an odd nesting level. report: receives what was done; may be
/// NULL. Views end only if anything was inserted or removed.
///
/// A segment that gets a vertex is removed, and pieces take its place, with its marker (see
/// deldrift_original_segments). The places of new vertices are rounded, and pieces are straight between their own ends.
/// Some cells stay bad: between segments at a small angle, in narrow gaps between segments (see unsplit), at segments
/// that stay whole, and where there is no room for a vertex. The report tells how many.
///
/// After a deldrift_coarsen it may make the mesh anew, where that has fewer vertices by a factor (see growth). Then it
/// also removes vertices that it has inserted, in its one commit.
///
/// Where all is good already, nothing is committed.
///
/// Cost: a comparison of the m cells with those that this call or deldrift_coarsen has looked at last, a test of those
/// alone that are others, or of which corners, labels or sizes are, s log s for s segments, and for each vertex
/// inserted, on the average, a constant. Without a mask also that of deldrift_nesting_levels, or
/// deldrift_crossing_numbers, unless nothing has changed since a call with the same domain. With is_too_large all
/// cells are tested. Where no place, cell or segment has changed since one of the calls has found all to be good with
/// these numbers: comparing mask, labels and sizes.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_OPTIONS for struct_size, keeps
/// and domain, DELDRIFT_WRONG_COUNT, DELDRIFT_INVALID_VALUE for a number of quality that has no meaning, those for
/// deldrift_coarsen included, and for a mask that does not end at segments, DELDRIFT_UNDECIDED_REGIONS where the labels
/// of regions are used: for the domain, and for areas without labels of cells, DELDRIFT_STAGED_VERTEX if anything is
/// staged, DELDRIFT_TOO_MANY_VERTICES, DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED, and
/// DELDRIFT_ON_SEGMENT and DELDRIFT_CROSSING where pieces that are bent by rounding would touch others (see
/// deldrift_segment_conflicts).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_refine(
    t: *mut deldrift_triangulation,
    quality: *const deldrift_quality,
    mask: *const u8,
    mask_count: usize,
    report: *mut deldrift_quality_report,
) -> deldrift_status {
    given!(t: Changing, quality: Given, mask[mask_count]: Array, report: Output);
    improve(t, quality, mask, mask_count, report, |t, given, quality, mask| {
        coarsening_of(given)?.check()?;
        let options = RefineOptions {
            keeps: kept_of(given.keeps)?,
            limit: given.limit,
            has_weights: given.has_weights != 0,
            reuses_ids: given.reuses_ids != 0,
        };
        Ok(t.refine(quality, &options, mask)?)
    })
}

/// Removes vertices that deldrift_refine has inserted and that are not needed any more. Without them the cells are
/// still of the quality, by a margin. Pieces of a segment are joined again. It is one commit of its own, all or
/// nothing, and deldrift_take_changes tells what it has changed.
///
/// The arguments are those of deldrift_refine. has_weights, limit and reuses_ids of the quality are not used; keeps
/// says what it would do.
///
/// Around cells that are of lower quality already, new cells may have angles as small. So call it before
/// deldrift_refine, which then has less to insert. Vertices that stay keep their ids, and so values by id stay, too:
/// one pass after deldrift_refine carries them over both (see deldrift_refined_weights).
///
/// Cost: that of deldrift_refine where all is good, and for each vertex that deldrift_refine has inserted, and around
/// which cells are others than at the last call, or at segments, at most that of looking at these. Where no place,
/// cell or segment has changed since this call has found nothing to remove with these numbers: comparing mask, labels
/// and sizes.
///
/// Errors: those of deldrift_refine: DELDRIFT_INVALID_DIMENSION in 3D, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_INVALID_OPTIONS
/// for struct_size, keeps and domain, DELDRIFT_WRONG_COUNT, DELDRIFT_INVALID_VALUE, DELDRIFT_UNDECIDED_REGIONS,
/// DELDRIFT_STAGED_VERTEX, DELDRIFT_TOO_MANY_VERTICES for ids of segments, DELDRIFT_TOO_MANY_CELLS,
/// DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED, DELDRIFT_ON_SEGMENT and DELDRIFT_CROSSING.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_coarsen(
    t: *mut deldrift_triangulation,
    quality: *const deldrift_quality,
    mask: *const u8,
    mask_count: usize,
    report: *mut deldrift_quality_report,
) -> deldrift_status {
    given!(t: Changing, quality: Given, mask[mask_count]: Array, report: Output);
    improve(t, quality, mask, mask_count, report, |t, given, quality, mask| {
        Ok(t.coarsen(quality, &coarsening_of(given)?, mask)?)
    })
}

/// The vertices that deldrift_refine has inserted and that are present, ascending by id.
///
/// vertices: a buffer with room for capacity ids. segments: room for as many: the segment that the vertex was put on,
/// by the id that it had before it was split, DELDRIFT_NONE if there is none. count: receives the number of vertices.
///
/// Cost: the vertices inserted so far.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_made_vertices(
    t: *const deldrift_triangulation,
    vertices: *mut u32,
    segments: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, vertices[capacity]: Buffer, segments[capacity]: Buffer, count: Output);
    t.read(|t| {
        let t = of_the_plane(t)?;
        let n = t.made_vertices().count();
        fill_all(count, n, capacity, [vertices.offer(), segments.offer()], || {
            let (vertices, segments) = (vertices.places_if_any(n)?, segments.places_if_any(n)?);
            write_all(vertices, t.made_vertices().map(|(v, _)| v.get()));
            write_all(segments, t.made_vertices().map(|(_, segment)| segment.get()));
            Ok(())
        })
    })
}

/// The original of each segment in force, in the order of deldrift_segments. For a piece that deldrift_stage_splits or
/// deldrift_refine has made it is the id of the segment that the program staged; for a whole segment it is its own id.
/// The original of a piece is not in force any more, or, where it was split before it was made, has never been.
///
/// originals: a buffer with room for capacity ids. count: receives the number of segments.
///
/// Cost: of s segments in force s log s.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_original_segments(
    t: *const deldrift_triangulation,
    originals: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, originals[capacity]: Buffer, count: Output);
    t.read(|t| {
        let t = of_the_plane(t)?;
        originals.fill(count, t.segments().count(), || {
            Ok(t.segments().map(|(id, _)| t.original_segment(id).get()))
        })
    })
}

/// How linear values at the vertices that the last deldrift_refine inserted, in the order of their ids, follow from
/// those at the vertices before. Each is a sum of the values of three vertices by their weights. So
///
///   value(new(k)) = sum of weights(3 k + i) * value(vertices(3 k + i)) for i = 0, 1, 2
///
/// carries values at vertices over, where new(k) is what deldrift_refined_vertices tells, or, without reuses_ids,
/// id_count - inserted + k. Vertices on the right may have been removed by this deldrift_refine, which has not given
/// their ids again, but not by a deldrift_coarsen before it: one pass with values from before both carries them over
/// both. deldrift_refine has to have been called with has_weights, and neither a commit nor a compaction must have come
/// since; otherwise there are none.
///
/// vertices: a buffer with room for capacity rows of 3 ids: the corners of the cell that the vertex was put into, or
/// the two ends of its segment or edge, the first one twice. weights: room for as many rows of 3 numbers, from 0 to 1,
/// with a sum of 1 but for rounding. count: receives the number of vertices.
///
/// Cost: the vertices inserted.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_refined_weights(
    t: *const deldrift_triangulation,
    vertices: *mut u32,
    weights: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    let (vertices, weights) = (vertices.cast::<[u32; 3]>(), weights.cast::<[f64; 3]>());
    given!(t: Reading, vertices[capacity]: Buffer, weights[capacity]: Buffer, count: Output);
    t.read(|t| {
        let rows = of_the_plane(t)?.refined_weights();
        fill_all(count, rows.len(), capacity, [vertices.offer(), weights.offer()], || {
            let (vertices, weights) =
                (vertices.places_if_any(rows.len())?, weights.places_if_any(rows.len())?);
            write_all(vertices, rows.iter().map(|row| row.vertices.map(VertexId::get)));
            write_all(weights, rows.iter().map(|row| row.weights));
            Ok(())
        })
    })
}

/// The sizes of the vertices that the last deldrift_refine inserted, in the order of their ids: the greatest length of
/// edges that it had there, from those given in quality.sizes at the vertices before. With these by id, behind the
/// others unless reuses_ids was set, a second call finds nothing to do. deldrift_refine has to have been called with
/// sizes, and neither a commit nor a compaction must have come since; otherwise there are none.
///
/// sizes: a buffer with room for capacity numbers. count: receives the number of vertices.
///
/// Cost: the vertices inserted.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_refined_sizes(
    t: *const deldrift_triangulation,
    sizes: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, sizes[capacity]: Buffer, count: Output);
    t.read(|t| {
        let all = of_the_plane(t)?.refined_sizes();
        sizes.fill(count, all.len(), || Ok(all.iter().copied()))
    })
}

/// The vertices that the last deldrift_refine inserted, ascending by id. deldrift_refined_weights and
/// deldrift_refined_sizes are in this order. Neither a commit nor a compaction must have come since; otherwise there
/// are none.
///
/// vertices: a buffer with room for capacity ids. count: receives the number of vertices.
///
/// Cost: the vertices inserted.
///
/// Errors: DELDRIFT_INVALID_DIMENSION in 3D.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_refined_vertices(
    t: *const deldrift_triangulation,
    vertices: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, vertices[capacity]: Buffer, count: Output);
    t.read(|t| {
        let all = of_the_plane(t)?.refined_vertices();
        vertices.fill(count, all.len(), || Ok(all.iter().map(|v| v.get())))
    })
}
