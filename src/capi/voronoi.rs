//! Voronoi cells and facets, clipped by a box, or by half-spaces besides.

mod parts;

use super::handle::{Reading, by_kind, deldrift_triangulation, in_any};
use super::pointers::{Array, Buffer, Output, Point, given};
use super::status::deldrift_status;
use crate::ids::VertexId;
use parts::{CellArrays, FacetArrays, box_for, clip_for, fill, half_space_rows, mask_for};

/// Rows of half-spaces and a mask that are not given: pointers and counts.
const NO_ROWS: (*const f64, usize) = (std::ptr::null(), 0);
const NO_MASK: (*const u8, usize) = (std::ptr::null(), 0);
const NO_NUMBERS: *mut f64 = std::ptr::null_mut();

/// Computes Voronoi cells and facets in one pass, whatever is asked for.
///
/// # Safety
/// What the header says of the arguments of deldrift_voronoi_cells_and_facets.
unsafe fn pass(
    t: *const deldrift_triangulation,
    [low, high]: [*const f64; 2],
    (half_spaces, half_space_count): (*const f64, usize),
    (mask, mask_count): (*const u8, usize),
    cells: Option<CellArrays>,
    facets: Option<FacetArrays>,
) -> deldrift_status {
    given!(t: Reading, low: Point, high: Point, mask[mask_count]: Array);
    t.read_any_watched(|t, monitor| {
        let d = t.dimension() as usize;
        let are_both = cells.is_some() && facets.is_some();
        // SAFETY: the caller promises that there are as many half-spaces.
        let rows = || unsafe { half_space_rows(d, half_spaces, half_space_count) };
        // SAFETY: the caller promises that the arrays of cells have the room that they say.
        let cell_rows = |n: usize| cells.map(|cells| unsafe { cells.rows(d, n) });
        // SAFETY: the caller promises that the arrays of facets have the room that they say.
        let facet_rows = |n: usize| facets.map(|facets| unsafe { facets.rows(d, n, are_both) });
        by_kind!(t => {
                let clip = clip_for(t, low, high, half_space_count > 0)?;
                let half_spaces = rows()?;
                t.check_half_spaces(half_spaces)?;
                let mask = mask_for(mask, mask_count, |given| t.check_vertex_mask(given))?;
                let (cells, facets) = (cell_rows(t.id_count()), facet_rows(t.edge_count()));
                fill(cells, facets, |cells, facets| {
                    t.for_voronoi(clip.as_ref().map(|clip| clip.each_ref()), half_spaces, mask, monitor, cells, facets)
                })
            }, periodic t => {
                let clip = box_for(t, low, high)?;
                let half_spaces = rows()?;
                let container = t.container(clip.as_ref().map(|clip| clip.each_ref()), half_spaces)?;
                let mask = mask_for(mask, mask_count, |given| t.check_vertex_mask(given))?;
                let n_edges = if facets.is_some() { t.edge_count()? } else { 0 };
                let (cells, facets) = (cell_rows(t.id_count()), facet_rows(n_edges));
                fill(cells, facets, |cells, facets| {
                    t.for_voronoi_in(container.as_ref(), mask, monitor, cells, facets)
                })
            })
    })
}

/// The areas (2D) or volumes (3D) of the Voronoi cells of all ids, within a box.
///
/// low, high: the corners of the box with the least and the greatest coordinates. Vertices may be outside of it. NULL
/// for both is no box; NULL for one of them is DELDRIFT_NULL_ARGUMENT. Without a box the Voronoi cells of the vertices
/// on the convex hull are infinite. volumes: a buffer with room for capacity numbers. count: receives the number of
/// ids.
///
/// NaN is for removed vertices only. A hidden vertex has 0: the one of lowest id at its place has the cell. Vertices in
/// one hyperplane, a single one included, have Voronoi cells too, though deldrift_cells has none. In a box such a cell
/// is what of the box is nearest to the vertex; without one it is infinite. What is beyond the range of numbers, or has
/// a corner there, is infinite.
///
/// Rounded: in a box, let h be 1e-8 times its greatest extent and 1e-15 times the greatest magnitude of its
/// coordinates. Without a box, let h be 1e-8 times the greatest circumradius of the cells around the vertex and 1e-15
/// times the greatest magnitude of a coordinate of their circumcentres. In place of 1e-8 it is some last bits, about
/// 1e-15, unless cells are nearly flat (see deldrift_circumcentres). A corner of a Voronoi cell is off by at most h. To
/// first order in h, an area is off by at most h times its perimeter, however near to each other vertices are. A volume
/// is off by at most h times the area of the cell's surface, or two thirds of that of the triangles that the vertex
/// makes with its edges if that is more, as it may be for cells with dozens of facets. Volumes are never negative.
/// Those of all ids add up to that of the box but for rounding.
///
/// The volumes are those of deldrift_voronoi_cells, to the last bit. In a periodic triangulation low and high are as
/// they are there. With NULL for both, cells without an end, as there are where the triangulation is open in some
/// direction, are infinite.
///
/// Takes time in proportion to the number of cells, and of ids. In a box, a Voronoi cell at its boundary also takes
/// time for each corner of its facets: a microsecond (2D) or some (3D) for such a cell of ordinary sets. A circumcentre
/// that nearly is in a face of the box takes microseconds, as that is decided exactly. The call takes memory for
/// circumcentres and sums, and for the cells of each vertex that is cut. For vertices in one hyperplane, in a box, it
/// takes the time and the memory of creating a triangulation of these. Runs on several threads, as the options allow.
///
/// Cost: n + m; in a box, for vertices in one hyperplane, that of deldrift_create.
///
/// Errors: DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE if high is not above low in every
/// coordinate, or if the box is not one that repeats, or not bounded across the vectors, DELDRIFT_OUT_OF_MEMORY,
/// DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_voronoi_volumes(
    t: *const deldrift_triangulation,
    low: *const f64,
    high: *const f64,
    volumes: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    let none = std::ptr::null_mut();
    let cells = CellArrays { volumes, areas: none, centroids: none, capacity, count };
    // SAFETY: what the caller promises here is what is to be promised there; there are neither half-spaces nor a mask.
    unsafe { pass(t, [low, high], NO_ROWS, NO_MASK, Some(cells), None) }
}

/// The lengths (2D) or areas (3D) of the Voronoi facets of all edges, in the order of deldrift_edges, within a box.
/// The Voronoi facet of an edge is what the Voronoi cells of its two vertices share.
///
/// low, high: as for deldrift_voronoi_volumes. Without a box, the Voronoi facets of the edges on the convex hull are
/// infinite. measures: a buffer with room for capacity numbers. count: receives the number of edges.
///
/// There is one number for each edge of the triangulation, so vertices in one hyperplane have none. It is the measure
/// of what both cells share, whichever of the two it is seen from. It is never NaN, and infinite where a corner is
/// beyond the range of numbers. Edges that exist only by tie-breaking, between vertices on an empty circle or sphere,
/// have a facet of measure 0, up to rounding. A facet outside the box has 0. One that is in a face of the box counts as
/// inside.
///
/// Rounded: with the h that deldrift_voronoi_volumes has, of the cells around the edge, a length is off by at most 2 h,
/// an area by at most h times the perimeter of the facet, however near to each other vertices are. It is never
/// negative. For a vertex whose Voronoi cell is in the box, facets times the lengths of their edges, divided by 4 (2D)
/// or 6 (3D), add up to its area or volume but for rounding.
///
/// The measures are those of deldrift_voronoi_derivatives, to the last bit. In a periodic triangulation low and high
/// are as deldrift_voronoi_cells has them. Of several edges between two vertices each has the facet of its own, and one
/// that leads from a vertex to itself has the facet that two periods of its cell share.
///
/// Takes time in proportion to the number of cells, and memory for circumcentres, facets and the cells of each vertex.
/// What is cut by the box, or nearly in a face of it, takes as long as in deldrift_voronoi_volumes. Runs on several
/// threads, as the options allow.
///
/// Cost: n + m.
///
/// Errors: DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE, DELDRIFT_OUT_OF_MEMORY,
/// DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_voronoi_facets(
    t: *const deldrift_triangulation,
    low: *const f64,
    high: *const f64,
    measures: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    let facets = FacetArrays::of_measures(measures, capacity, count);
    // SAFETY: what the caller promises here is what is to be promised there; there are neither half-spaces nor a mask.
    unsafe { pass(t, [low, high], NO_ROWS, NO_MASK, None, Some(facets)) }
}

/// The Voronoi cells of all ids within a box: areas (2D) or volumes (3D), boundaries and centroids. It is for programs
/// that need them at every step, and takes one pass over the cells, however many vertices have moved. A program that
/// needs facets as well gets both from deldrift_voronoi_cells_and_facets.
///
/// low, high: the corners of the box with the least and the greatest coordinates. Vertices may be outside of it. NULL
/// for both is no box. mask, mask_count: a byte for each id, mask_count of them, which must be deldrift_id_count. Only
/// entries of vertices whose byte is not 0 are computed and written; the others are left as they are. NULL and 0 for
/// all vertices. deldrift_voronoi_changed makes a mask of the cells that have changed. The numbers of a vertex depend
/// neither on the mask nor on the number of threads that compute them, to the last bit. They are sums in the order of
/// the cells, which a build on several threads may change.
///
/// volumes: a buffer with room for capacity numbers. areas: room for as many; it receives the length (2D) or area (3D)
/// of the boundary of what there is of each cell in the box, including what it has of the faces of the box. centroids:
/// a buffer with room for capacity rows of 2 or 3 coordinates. count: receives the number of ids.
///
/// A removed vertex has NaN, a hidden one volume and area 0. A centroid is NaN where the volume is 0 or infinite.
/// Nothing else is NaN. Vertices in one hyperplane, a single one included, have cells too, as in
/// deldrift_voronoi_volumes. Without a box the cells of vertices on the convex hull have volume and area infinite.
/// Segments are not looked at.
///
/// Rounded: let h be what deldrift_voronoi_volumes has for a box, or without one. Let S be the area of a cell's
/// surface, T that of the triangles that the vertex makes with its edges, V its volume and d its diameter. To first
/// order in h, a volume is off by at most h times the greater of S and 2/3 T, which is less unless a cell has dozens of
/// facets (2D: h times the length of the boundary). An area is off by at most h times the sum of the perimeters of the
/// cell's faces (2D: 2 h for each). A centroid is off by at most that error of the volume times d / V, where this is
/// less than d, and without a box by the rounding of its coordinates besides. It is in the box in any case. The volumes
/// of all ids add up to that of the box but for rounding.
///
/// In a periodic triangulation low and high are walls, which repeat with it. They must be -infinity and infinity along
/// each axis along which a vector goes. So both are infinite, or NULL, where vectors span all directions. Along other
/// axes they are finite, unless half-spaces (deldrift_voronoi_cells_within) bound what is left. Let the box that
/// repeats be the least one that has all places of the container which are up to 1.5 of each reduced vector away from
/// the unit cell, with low and high as faces. With the h of this box numbers are off as in the open, and the volumes
/// add up to that of one period of the container. NULL for low and high cuts nothing, and h is the one that
/// deldrift_voronoi_volumes has without a box. A cell without an end, where the triangulation is open in some
/// direction, then has volume and area infinite, and its centroid is NaN. A centroid is where the vertex is at its own
/// position, in whatever period that is, and off by the rounding of its coordinates besides. But for rounding, the
/// numbers depend neither on the periods in which positions are given nor on copies that the library keeps. With the
/// same cells in the same order they are the same to the last bit.
///
/// Takes memory for circumcentres, for sums, and, where cells are cut by the box, for the cells of each vertex. Runs on
/// several threads, as the options allow. Cells that are cut take several times as long as others.
///
/// Cost: n + m; with a mask, a byte for each id, a bit for each cell, and the cells around vertices of the mask; for
/// vertices in one hyperplane, that of deldrift_create.
///
/// Errors: DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE if high is not above low in every
/// coordinate, or if the box is not one that repeats, or not bounded across the vectors, DELDRIFT_WRONG_COUNT,
/// DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_voronoi_cells(
    t: *const deldrift_triangulation,
    low: *const f64,
    high: *const f64,
    mask: *const u8,
    mask_count: usize,
    volumes: *mut f64,
    areas: *mut f64,
    centroids: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    let cells = CellArrays { volumes, areas, centroids, capacity, count };
    // SAFETY: what the caller promises here is what is to be promised there; there are no half-spaces.
    unsafe { pass(t, [low, high], NO_ROWS, (mask, mask_count), Some(cells), None) }
}

/// The Voronoi cells of all ids within a box and half-spaces, as deldrift_voronoi_cells has them within a box. It is
/// for containers with oblique walls: hoppers, wedges, boxes that are turned, polygons that approximate a cylinder.
///
/// low, high, mask, mask_count, volumes, areas, centroids, capacity, count: as deldrift_voronoi_cells has them.
/// half_spaces: half_space_count rows of 3 (2D) or 4 (3D) numbers: an outward normal, of any length, and an offset. The
/// half-space is the set of the places x with normal · x at most the offset. If there are any, the box is needed, too;
/// one around the container does. Vertices may be outside of box and half-spaces.
///
/// What there is of a cell in the box and all half-spaces is convex. Areas include what it has of the faces of the box
/// and of the planes. Where nothing of a cell is left, or of the box, volume and area are 0 and the centroid is NaN.
/// Half-spaces may be equal, opposite, touch cells at corners or along faces, or leave nothing.
///
/// Rounded: let h be what deldrift_voronoi_volumes has for a box, with 3e-15 in place of 1e-15. Unlike the faces of the
/// box, planes are not exact: a corner within h of one may be taken as inside or as beyond. With this h the errors are
/// those of deldrift_voronoi_cells. What is left of a cell or of the box, and is thinner than 2 h, may have any area up
/// to that of its boundary. The volumes of all ids add up to that of the box in the half-spaces, but for rounding.
/// Numbers depend neither on the mask nor on the number of threads, to the last bit; without half-spaces they are those
/// of deldrift_voronoi_cells.
///
/// In a periodic triangulation the product of each normal and each of the vectors that deldrift_vectors tells must be
/// 0, exactly, so that the half-space repeats as well. Along axes along which no vector goes normals may have any
/// entries. What low, high and half-spaces leave must be bounded across the vectors. NULL for low and high is a box
/// that is infinite along all axes.
///
/// A cell that is in all half-spaces takes little longer than in deldrift_voronoi_cells, as circumcentres are only
/// compared with the half-spaces nearby. One that is cut takes some microseconds, and some nanoseconds for each
/// half-space. One thread computes those that are cut. Takes memory for half-spaces, and for lists of those nearby.
///
/// Cost: n + m, and half_space_count for each cell that is cut; otherwise that of deldrift_voronoi_cells. In a periodic
/// triangulation that is open in two directions also the square of half_space_count.
///
/// Errors: those of deldrift_voronoi_cells: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE (also for a normal or an
/// offset), DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE (also if a normal is zero, or one of a periodic triangulation
/// has a product with a vector that is not 0), DELDRIFT_WRONG_COUNT, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_voronoi_cells_within(
    t: *const deldrift_triangulation,
    low: *const f64,
    high: *const f64,
    half_spaces: *const f64,
    half_space_count: usize,
    mask: *const u8,
    mask_count: usize,
    volumes: *mut f64,
    areas: *mut f64,
    centroids: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    let cells = CellArrays { volumes, areas, centroids, capacity, count };
    let half_spaces = (half_spaces, half_space_count);
    // SAFETY: what the caller promises here is what is to be promised there.
    unsafe { pass(t, [low, high], half_spaces, (mask, mask_count), Some(cells), None) }
}

/// The Voronoi facets of all edges within a box, in the order of deldrift_edges: lengths (2D) or areas (3D), centroids,
/// and the derivatives of the areas or volumes on their sides by positions.
///
/// low, high, mask, mask_count: as deldrift_voronoi_cells has them. Only entries of edges that have an end whose byte
/// is not 0 are computed and written.
///
/// measures: a buffer with room for capacity numbers. centroids: a buffer with room for capacity rows of 2 or 3
/// coordinates. derivatives: a buffer with room for capacity rows of 4 or 6 numbers. For the edge of the vertices i and
/// j they are the derivative of the area or volume of the cell of i by the position of j, and then that of the cell of
/// j by the position of i. count: receives the number of edges.
///
/// With the measure A and the centroid c of the facet, and the distance L of the vertices at x_i and x_j, the first
/// derivative is A (x_j - c) / L, the second one A (x_i - c) / L. The derivative of the volume of a cell by the
/// position of its own vertex is minus the sum, over the edges of that, of the derivatives of the other cells by that
/// position, as all fill the box, which stays. Where cells come to touch or to part, derivatives are still continuous,
/// as A is 0 there.
///
/// A centroid is NaN where nothing of the facet is in the box or its measure is 0; measures and derivatives are 0
/// there. Derivatives are infinite where the quotient is beyond the range of numbers. There is one entry for each edge
/// of the triangulation, as in deldrift_voronoi_facets, and none for vertices in one hyperplane.
///
/// Without a box, facets of edges on the convex hull have an infinite measure, and NaN for the rest; so have others of
/// which a corner is beyond the range of numbers.
///
/// Rounded: let h be what deldrift_voronoi_volumes has for a box, or without one, P the perimeter of a facet (2D: 2), d
/// its diameter. A measure is off by at most h P. A centroid is off by at most h P d / A, or by d + h where A is less
/// than 4 h P. A derivative by the position x is off by at most h P (d + |x - c|) / L.
///
/// In a periodic triangulation low and high are walls, as deldrift_voronoi_cells has them, with its h; or NULL, with
/// the h that deldrift_voronoi_volumes has without a box, of the cells around the edge. Then a facet without an end has
/// an infinite measure, and NaN for the rest. A centroid is where the first vertex of the edge is at its own position,
/// and off by the rounding of its coordinates besides; the second vertex is where deldrift_edge_shifts has it. The
/// derivatives of an edge are those by the position of one of its ends alone. All periods of a vertex move. So the
/// derivative of the volume of the cell of i by the position of j is the sum over the edges between i and j. That by
/// its own position is minus the sum of the derivatives of the other cells by that position, over its edges to other
/// vertices. An edge from a vertex to itself contributes nothing, as its facet moves along with all of the cell.
///
/// Takes memory for circumcentres, edges and the cells of each vertex. What is cut by the box, and facets narrower than
/// 1e-7 of it, take about a microsecond each.
///
/// Cost: n + m, and d log d for the d neighbours of each vertex.
///
/// Errors: those of deldrift_voronoi_cells: DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE,
/// DELDRIFT_WRONG_COUNT, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_voronoi_derivatives(
    t: *const deldrift_triangulation,
    low: *const f64,
    high: *const f64,
    mask: *const u8,
    mask_count: usize,
    measures: *mut f64,
    centroids: *mut f64,
    derivatives: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    let facets = FacetArrays { measures, centroids, derivatives, weight_derivatives: None, capacity, count };
    // SAFETY: what the caller promises here is what is to be promised there; there are no half-spaces.
    unsafe { pass(t, [low, high], NO_ROWS, (mask, mask_count), None, Some(facets)) }
}

/// The Voronoi facets of all edges within a box and half-spaces, with derivatives, as deldrift_voronoi_derivatives has
/// them within a box.
///
/// low, high, mask, mask_count, measures, centroids, derivatives, capacity, count: as deldrift_voronoi_derivatives has
/// them. half_spaces, half_space_count: as deldrift_voronoi_cells_within has them, in a periodic triangulation as well.
/// Box and half-spaces stay where they are when vertices move, so that the sums of derivatives are as in a box.
///
/// Rounded: with the h of deldrift_voronoi_cells_within the errors are those of deldrift_voronoi_derivatives. For a
/// facet that a plane cuts they are divided by the sine of the angle between both. A facet that is in a plane, but for
/// h, may be there or not.
///
/// Takes memory for half-spaces, too, and for lists of those nearby. A facet that is cut takes about a microsecond, and
/// some nanoseconds for each half-space.
///
/// Cost: n + m, and half_space_count for each facet that is cut; otherwise that of deldrift_voronoi_derivatives. In a
/// periodic triangulation that is open in two directions also the square of half_space_count.
///
/// Errors: those of deldrift_voronoi_cells_within: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_INVALID_VALUE, DELDRIFT_WRONG_COUNT, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_voronoi_derivatives_within(
    t: *const deldrift_triangulation,
    low: *const f64,
    high: *const f64,
    half_spaces: *const f64,
    half_space_count: usize,
    mask: *const u8,
    mask_count: usize,
    measures: *mut f64,
    centroids: *mut f64,
    derivatives: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    let facets = FacetArrays { measures, centroids, derivatives, weight_derivatives: None, capacity, count };
    let half_spaces = (half_spaces, half_space_count);
    // SAFETY: what the caller promises here is what is to be promised there.
    unsafe { pass(t, [low, high], half_spaces, (mask, mask_count), None, Some(facets)) }
}

/// Voronoi cells and facets in one call. It gives any of the numbers of deldrift_voronoi_cells_within and
/// deldrift_voronoi_derivatives_within, to the last bit, but computes circumcentres, and compares them with box and
/// half-spaces, only once.
///
/// low, high, half_spaces, half_space_count, mask, mask_count: as these functions have them; NULL for low and high is
/// no box. volumes, areas, centroids, capacity, count: as deldrift_voronoi_cells has them. measures, facet_centroids,
/// derivatives, edge_capacity, edge_count: as deldrift_voronoi_derivatives has them. A buffer that is NULL is neither
/// filled nor computed. With NULL for measures, facet_centroids and derivatives, and edge_capacity 0, this takes as
/// long as deldrift_voronoi_cells_within. With NULL for volumes, areas and centroids, and capacity 0, it takes as long
/// as deldrift_voronoi_derivatives_within. count and edge_count receive the numbers of ids and of edges in any case,
/// also when buffers of either kind are too small.
///
/// Cost: that of both functions, without the circumcentres of one of them.
///
/// Errors: those of deldrift_voronoi_cells_within: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_INVALID_VALUE, DELDRIFT_WRONG_COUNT, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_voronoi_cells_and_facets(
    t: *const deldrift_triangulation,
    low: *const f64,
    high: *const f64,
    half_spaces: *const f64,
    half_space_count: usize,
    mask: *const u8,
    mask_count: usize,
    volumes: *mut f64,
    areas: *mut f64,
    centroids: *mut f64,
    capacity: usize,
    count: *mut usize,
    measures: *mut f64,
    facet_centroids: *mut f64,
    derivatives: *mut f64,
    edge_capacity: usize,
    edge_count: *mut usize,
) -> deldrift_status {
    let cells = CellArrays { volumes, areas, centroids, capacity, count };
    let facets = FacetArrays {
        measures,
        centroids: facet_centroids,
        derivatives,
        weight_derivatives: None,
        capacity: edge_capacity,
        count: edge_count,
    };
    let half_spaces = (half_spaces, half_space_count);
    // SAFETY: what the caller promises here is what is to be promised there.
    unsafe { pass(t, [low, high], half_spaces, (mask, mask_count), Some(cells), Some(facets)) }
}

/// Areas (2D) or volumes (3D) of Voronoi cells, and their derivatives by weights, in one call: what Newton's method needs
/// that looks for weights for which cells have prescribed areas or volumes, as in semi-discrete optimal transport.
///
/// low, high, half_spaces, half_space_count, mask, mask_count: as deldrift_voronoi_cells_within has them; NULL for low and
/// high is no box. volumes, capacity, count: as deldrift_voronoi_volumes has them. weight_derivatives: a buffer with room
/// for edge_capacity numbers, one for each edge in the order of deldrift_edges: the derivative of the area or volume of the
/// cell of either end by the weight of the other one, which is minus the measure of the facet over twice the length of the
/// edge. The derivative by the own weight is minus the sum over the edges of the vertex, in a box as well as without one.
/// edge_count: receives the number of edges. Where there are no weights derivatives are those at equal ones. With NULL for
/// weight_derivatives, and edge_capacity 0, it takes as long as deldrift_voronoi_volumes.
///
/// Rounded: volumes as deldrift_voronoi_volumes has them. A derivative is off by what the measure of its facet is off,
/// see deldrift_voronoi_derivatives, over twice the length of its edge.
///
/// Cost: that of deldrift_voronoi_cells_and_facets.
///
/// Errors: those of deldrift_voronoi_cells_within: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_INVALID_VALUE, DELDRIFT_WRONG_COUNT, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_voronoi_weight_derivatives(
    t: *const deldrift_triangulation,
    low: *const f64,
    high: *const f64,
    half_spaces: *const f64,
    half_space_count: usize,
    mask: *const u8,
    mask_count: usize,
    volumes: *mut f64,
    capacity: usize,
    count: *mut usize,
    weight_derivatives: *mut f64,
    edge_capacity: usize,
    edge_count: *mut usize,
) -> deldrift_status {
    let cells = CellArrays { volumes, areas: NO_NUMBERS, centroids: NO_NUMBERS, capacity, count };
    let facets = FacetArrays::of_weight_derivatives(weight_derivatives, edge_capacity, edge_count);
    let half_spaces = (half_spaces, half_space_count);
    // SAFETY: what the caller promises here is what is to be promised there.
    unsafe { pass(t, [low, high], half_spaces, (mask, mask_count), Some(cells), Some(facets)) }
}

/// Marks the vertices whose Voronoi cell has changed, or may have. With this mask for deldrift_voronoi_cells a step
/// costs what has changed.
///
/// vertices: vertex_count ids of those that have moved since the deldrift_take_changes before the last one, in any
/// order, some maybe more than once; NULL if there are none. Call it after deldrift_take_changes, before the next
/// change. mask: a buffer with room for capacity bytes. A vertex gets 1 if it has moved, or shares a cell with one that
/// has. It also gets 1 if it is in the star of the changes that were taken last, is hidden or shown in them, is a
/// corner of a renumbered cell, or has been removed. All others get 0. count: receives the number of ids.
///
/// A program keeps arrays of deldrift_voronoi_cells for a box. It moves vertices, commits, takes the changes, and calls
/// this and then deldrift_voronoi_cells with the mask. If changes are taken after every commit, its arrays are those of
/// a call without a mask, to the last bit. Otherwise they are so within the errors documented, as cells that have come
/// back meanwhile may list their corners in another order. All vertices are marked where nothing is known of single
/// cells: if changes have not been taken since the last change or since deldrift_compact, while all vertices are in one
/// hyperplane, and where there are segments.
///
/// In a periodic triangulation arrays are those of a call without a mask within the errors documented, as copies that
/// the library keeps may differ. All vertices are marked where the vectors are not those of the time when changes were
/// taken before.
///
/// Cost: a byte for each id; the changes taken, and the cells around the moved vertices, of k cells k log k.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NO_SUCH_VERTEX, DELDRIFT_REMOVED_VERTEX, DELDRIFT_STAGED_VERTEX,
/// DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_voronoi_changed(
    t: *const deldrift_triangulation,
    vertices: *const u32,
    vertex_count: usize,
    mask: *mut u8,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, vertices[vertex_count]: Array, mask[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        in_any!(t => {
            let moved = VertexId::of_numbers(vertices.get()?);
            mask.fill(count, t.id_count(), || Ok(t.voronoi_changed(moved)?))
        })
    })
}
