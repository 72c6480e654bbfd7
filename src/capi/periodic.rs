//! Periodic triangulations: their creation, and what only they have.

use std::iter::repeat;
use std::mem::MaybeUninit;

use super::geometry::cell_count_of;
use super::guard;
use super::handle::{Changing, Content, Reading, by_kind, deldrift_triangulation, hand_out, in_its_period};
use super::options::{GivenOptions, deldrift_options, invalid};
use super::pointers::{Array, Buffer, Output, Points, fill_all, given, write_all};
use super::status::{Failure, deldrift_status};
use crate::delaunay::{Moving, Plane, PowerPlane, PowerSpace, Space};
use crate::error::Error;
use crate::machine::memory;
use crate::motion::{CoincidencePolicy, MovingTriangulation, Options, check_position};
use crate::periodic::{AnyPeriodic, PeriodicTriangulation};
use crate::predicates::PointArray;

/// Creates the Delaunay triangulation of points that repeat. Each is in all places to which sums of multiples of the
/// vectors take it.
///
/// dimension: 2 or 3. positions, count: as in deldrift_create; a position may be in any period. vectors: vector_count
/// rows of dimension numbers, the vectors of the box: 1 to dimension of them. They need not be orthogonal nor short: a
/// triclinic box, or one that is skewed by any number of its lengths, is legal. Directions that they do not span are
/// open. options: as in deldrift_create, except that coincidence must be DELDRIFT_COINCIDENCE_MERGE. Vertices that are
/// at the same place in any period share it, and the one of the lowest id represents it. out: receives the
/// triangulation.
///
/// The cells are those of all the places at once. Of cells that are translations of each other one is told. Any number
/// of vertices is legal, one included: a cell may have a vertex in several periods, and be its own neighbour. The cells
/// do not depend on the periods in which positions are given, on which vectors of the same lattice are given, or on
/// what happened before. deldrift_cell_shifts tells in which period each corner is.
///
/// Positions and vectors are rounded to a grid, along axes along which a vector goes. Its step is a power of two, so
/// that all coordinates that are calculated with have at most 53 binary digits. In a box whose reduced vectors (the
/// shortest of its lattice) have lengths up to L and are not flatter than a cube, the step is at most 2^-45 L, and
/// mostly 2^-47 L. A position moves by half of that at most, and so does each reduced vector. The step depends on the
/// lattice alone, whichever of its vectors are given. deldrift_copy_positions and deldrift_vectors tell what is used,
/// to the last bit. For these positions and vectors the cells are exact. They are kept as they are when they are given
/// again, here or to deldrift_stage_vectors and deldrift_commit_positions. A vector of many times L may have no 53
/// digits as a sum of the rounded reduced ones: then the vectors that are given are rounded to the grid instead.
/// Entries of vectors may be up to 1e50 in magnitude, and are 0 or at least 1e-50. Positions may be some 1e13 L away,
/// so far that 64 bits still count the periods, and less far in a box that is skewed by more than a thousand of its
/// lengths. Where vectors go along more axes than there are vectors, as one that is along no axis does, the step is
/// 2^10 times that. Then positions may be some 500 L away across the vectors, else they are out of range. Vectors that
/// on their grid depend on each other, or nearly so, are refused.
///
/// All functions serve a periodic triangulation but those of deldrift/segments.h and the following, which return
/// DELDRIFT_PERIODIC: deldrift_stage_insertions_with_keys, deldrift_stage_insertions_at_free_ids,
/// deldrift_insert_vertex_with_key, deldrift_keys, deldrift_cells_in_reach, deldrift_hull_facets_in_reach and
/// deldrift_vertices_in_reach. Cells are numbered anew by each commit, unless changes are taken.
///
/// Cost: that of deldrift_create, of some n + c n^(1/2) vertices in 2D and n + c n^(2/3) in 3D. In the mean a commit of
/// moves, or of other vectors that are near those in force, costs what it costs in an open triangulation of as many,
/// and reading the cells after it n + m. Each insertion and removal costs what it changes. A commit with more of these
/// than a tenth of the vertices, or where a vertex has drifted far out of the box since the last such commit, costs as
/// much as creation.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_INVALID_OPTIONS, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE, DELDRIFT_DEPENDENT_VECTORS, DELDRIFT_TOO_MANY_VERTICES,
/// DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_create_periodic(
    dimension: u32,
    positions: *const f64,
    count: usize,
    vectors: *const f64,
    vector_count: usize,
    options: *const deldrift_options,
    out: *mut *mut deldrift_triangulation,
) -> deldrift_status {
    given!(positions[count]: Points, vectors[vector_count]: Points, options: GivenOptions, out: Output);
    guard::enter(|| {
        create(dimension, options, [count, vector_count], out, |options| {
            if dimension == 2 {
                built(
                    &positions.of_kind::<PeriodicTriangulation<Plane>>()?,
                    vectors,
                    options,
                    AnyPeriodic::Plane,
                )
            } else {
                built(
                    &positions.of_kind::<PeriodicTriangulation<Space>>()?,
                    vectors,
                    options,
                    AnyPeriodic::Space,
                )
            }
        })
    })
}

/// Creates the regular triangulation of points with weights that repeat: deldrift_create_periodic for vertices with
/// weights, as deldrift_create_weighted has them.
///
/// weights: count numbers, or NULL: then all are 0. Each is finite and at most 1e114 in magnitude, and may be negative.
/// Weights are not rounded to the grid, and may be as far apart as they like: one heavy vertex may hide all others, whose
/// cells are then its own in several periods. All else is as in deldrift_create_periodic.
///
/// Of vertices at one place in any period that of the greatest weight represents the place; of these the one of the lowest
/// id. deldrift_hidden_by_weight and deldrift_hidden_vertices tell who is hidden.
///
/// The functions that serve such a triangulation are those that serve a periodic one and one with weights.
/// deldrift_nearest_vertices looks at all vertices for each position.
///
/// Cost: that of deldrift_create_periodic. A commit looks at all cells at home where weights hide vertices.
///
/// Errors: DELDRIFT_INVALID_DIMENSION, DELDRIFT_INVALID_OPTIONS, DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE,
/// DELDRIFT_OUT_OF_RANGE, DELDRIFT_INVALID_VALUE, DELDRIFT_DEPENDENT_VECTORS, DELDRIFT_TOO_MANY_VERTICES,
/// DELDRIFT_TOO_MANY_CELLS, DELDRIFT_OUT_OF_MEMORY, DELDRIFT_CANCELLED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_create_periodic_weighted(
    dimension: u32,
    positions: *const f64,
    weights: *const f64,
    count: usize,
    vectors: *const f64,
    vector_count: usize,
    options: *const deldrift_options,
    out: *mut *mut deldrift_triangulation,
) -> deldrift_status {
    given!(positions[count]: Points, weights[count]: Array, vectors[vector_count]: Points, options: GivenOptions, out: Output);
    guard::enter(|| {
        create(dimension, options, [count, vector_count], out, |options| {
            let weights = weights.if_any()?;
            if dimension == 2 {
                let points = positions.with_weights::<PeriodicTriangulation<PowerPlane>>(weights)?;
                built(&points, vectors, options, AnyPeriodic::PowerPlane)
            } else {
                let points = positions.with_weights::<PeriodicTriangulation<PowerSpace>>(weights)?;
                built(&points, vectors, options, AnyPeriodic::PowerSpace)
            }
        })
    })
}

/// Builds one, by itself: no other call has room for one on the stack.
#[inline(never)]
fn built<G: Moving>(
    points: &[G::Point],
    vectors: Points<'_>,
    options: Options,
    any: impl FnOnce(PeriodicTriangulation<G>) -> AnyPeriodic,
) -> Result<Box<AnyPeriodic>, Failure> {
    let vectors = vectors.of_kind::<PeriodicTriangulation<G>>()?;
    let t = PeriodicTriangulation::<G>::new(points, &vectors, options)?;
    Ok(memory::boxed_by(|| any(t))?)
}

/// Hands out what is made by these options, in this dimension, of so many positions and vectors.
fn create(
    dimension: u32,
    options: GivenOptions<'_>,
    [count, vector_count]: [usize; 2],
    out: Output<'_, *mut deldrift_triangulation>,
    make: impl FnOnce(Options) -> Result<Box<AnyPeriodic>, Failure>,
) -> Result<(), Failure> {
    let out = out.place()?;
    let (callbacks, options) = options.of_creation(dimension, count)?;
    reject_coincidence(&options)?;
    if vector_count == 0 || vector_count > dimension as usize {
        return Err(Error::DependentVectors { count: vector_count }.into());
    }
    hand_out(out, make(options)?, callbacks)
}

/// Stages other vectors for the box: strain, shear, or others of the same lattice. The next commit, with or without
/// moves, makes them those of the triangulation.
///
/// vectors, vector_count: as many as deldrift_create_periodic was given; none, vector_count being 0, for a
/// triangulation that is not periodic. Vertices that do not move stay at their positions. So a program that deforms its
/// box with all that is in it gives the positions, too. Vectors that are staged already are replaced.
/// deldrift_discard_moves discards them.
///
/// Cost: constant. The commit costs as much as one of moves of all vertices, as long as the lattice is near the one in
/// force, whichever vectors of it are given. A box that is strained or sheared in small steps costs a creation once for
/// each strain of about 1.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_WRONG_COUNT, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE,
/// DELDRIFT_INVALID_VALUE, DELDRIFT_DEPENDENT_VECTORS, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_stage_vectors(
    t: *mut deldrift_triangulation,
    vectors: *const f64,
    vector_count: usize,
) -> deldrift_status {
    given!(t: Changing, vectors[vector_count]: Points);
    t.change_any(|t| {
        let wanted = vector_count_of(t);
        if vector_count != wanted {
            let argument = "vector_count";
            return Err(Error::WrongCount { argument, given: vector_count, wanted, coming: 0 }.into());
        }
        match t {
            Content::Open(_) | Content::Weighted(_) => Ok(()),
            Content::Periodic(t) => in_its_period!(t, t => Ok(t.stage_vectors(&vectors.of(t)?)?)),
        }
    })
}

/// The vectors by which the triangulation repeats: those that were given, on the grid of deldrift_create_periodic.
///
/// vectors: a buffer with room for capacity rows of 2 (2D) or 3 (3D) numbers. count: receives their number, 0 for a
/// triangulation that is not periodic.
///
/// Cost: constant.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_vectors(
    t: *const deldrift_triangulation,
    vectors: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, count: Output);
    t.read_any(|t| {
        let needed = vector_count_of(t);
        match t {
            Content::Open(_) | Content::Weighted(_) => {
                given!(vectors[capacity]: Buffer);
                vectors.fill(count, needed, || Ok([]))
            }
            Content::Periodic(t) => in_its_period!(t, t => {
                let vectors = vectors.cast();
                given!(vectors[capacity]: Buffer);
                vectors.fill(count, needed, || Ok(t.vectors().map(|vector| vector.coordinates())))
            }),
        }
    })
}

/// The shortest vectors of the lattice, a reduced basis of it. deldrift_wrap_positions translates by them.
///
/// vectors: receives rows of 2 (2D) or 3 (3D) numbers. multiples: receives as many rows of whole numbers: each vector
/// is the sum of these multiples of the vectors that were given. greatest: receives a number for each. No edge between
/// positions that deldrift_wrap_positions gives spans more than entry j of greatest times vector j, and the place to
/// which it leads is calculated without rounding. All are buffers with room for capacity vectors. count: receives their
/// number, 0 for a triangulation that is not periodic.
///
/// Cost: constant.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_reduced_vectors(
    t: *const deldrift_triangulation,
    vectors: *mut f64,
    multiples: *mut i64,
    greatest: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, greatest[capacity]: Buffer, count: Output);
    t.read_any(|t| {
        if t.dimension() == 2 {
            let (vectors, multiples) = (vectors.cast(), multiples.cast());
            given!(vectors[capacity]: Buffer, multiples[capacity]: Buffer);
            fill_reduced_vectors::<2>(t, vectors, multiples, greatest, capacity, count)
        } else {
            let (vectors, multiples) = (vectors.cast(), multiples.cast());
            given!(vectors[capacity]: Buffer, multiples[capacity]: Buffer);
            fill_reduced_vectors::<3>(t, vectors, multiples, greatest, capacity, count)
        }
    })
}

/// Takes positions into the box, each to its place in the unit cell of deldrift_reduced_vectors, on the grid of
/// deldrift_create_periodic.
///
/// positions: count points. They need not be those of vertices, and the triangulation may have none. previous: NULL, or
/// count points where the vertices have been. Each position then goes to the period nearest to its entry, while it is
/// at most a quarter of the unit cell outside of it. So a vertex does not flip back and forth at a face. places:
/// receives count points. shifts: receives count rows of 2 (2D) or 3 (3D) whole numbers: the multiples of the vectors
/// that were given by which the position is translated from its place, 0 beyond the last of these.
///
/// Where the triangulation is not periodic, places are the positions, and shifts 0.
///
/// Cost: count.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_NOT_FINITE, DELDRIFT_OUT_OF_RANGE, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_wrap_positions(
    t: *const deldrift_triangulation,
    positions: *const f64,
    previous: *const f64,
    count: usize,
    places: *mut f64,
    shifts: *mut i64,
) -> deldrift_status {
    given!(t: Reading, positions[count]: Points, previous[count]: Points);
    t.read_any(|t| {
        if t.dimension() == 2 {
            let (places, shifts) = (places.cast(), shifts.cast());
            given!(places[count]: Buffer, shifts[count]: Buffer);
            fill_wrapped::<2>(t, positions, previous, count, places, shifts)
        } else {
            let (places, shifts) = (places.cast(), shifts.cast());
            given!(places[count]: Buffer, shifts[count]: Buffer);
            fill_wrapped::<3>(t, positions, previous, count, places, shifts)
        }
    })
}

/// In which period each corner of each cell is, and each neighbour.
///
/// shifts: receives a row of 2 (2D) or 3 (3D) whole numbers for each of the 3 or 4 corners of each cell, in the order
/// of deldrift_cells: multiples of the vectors, 0 beyond the last of these. The corner is at its position and the sum
/// of these multiples. The corner of the lowest id is at its position (if the vertex is there more than once, the first
/// of these corners by x, y, z). neighbour_shifts: receives as many rows, one for the neighbour opposite each corner.
/// Translated by it from where its own shifts have it, the neighbour shares the facet. It is 0 on the hull. Both are
/// buffers with room for capacity cells. count: receives the number of cells.
///
/// All are 0 where the triangulation is not periodic.
///
/// Cost: n + m.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_cell_shifts(
    t: *const deldrift_triangulation,
    shifts: *mut i64,
    neighbour_shifts: *mut i64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, count: Output);
    t.read_any(|t| {
        if t.dimension() == 2 {
            let (shifts, neighbour_shifts) = (shifts.cast(), neighbour_shifts.cast());
            given!(shifts[capacity]: Buffer, neighbour_shifts[capacity]: Buffer);
            fill_cell_shifts::<2, 3>(t, shifts, neighbour_shifts, capacity, count)
        } else {
            let (shifts, neighbour_shifts) = (shifts.cast(), neighbour_shifts.cast());
            given!(shifts[capacity]: Buffer, neighbour_shifts[capacity]: Buffer);
            fill_cell_shifts::<3, 4>(t, shifts, neighbour_shifts, capacity, count)
        }
    })
}

/// In which period the second vertex of each edge is, in the order of deldrift_edges.
///
/// In a periodic triangulation deldrift_edges tells one of the edges that are translations of each other, the lower id
/// first. An edge may lead from a vertex to itself in another period, and two vertices may have several edges. shifts:
/// a buffer with room for capacity edges, which receives a row of 2 (2D) or 3 (3D) whole numbers for each: multiples of
/// the vectors, 0 beyond the last of these. From the position of the first vertex the edge leads to that of the second
/// and the sum of these multiples. count: receives the number of edges.
///
/// All are 0 where the triangulation is not periodic.
///
/// Cost: n + m, and d log d for the d neighbours of each vertex.
///
/// Errors: DELDRIFT_SIZE_OVERFLOW, DELDRIFT_OUT_OF_MEMORY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn deldrift_edge_shifts(
    t: *const deldrift_triangulation,
    shifts: *mut i64,
    capacity: usize,
    count: *mut usize,
) -> deldrift_status {
    given!(t: Reading, count: Output);
    t.read_any(|t| {
        if t.dimension() == 2 {
            let shifts = shifts.cast();
            given!(shifts[capacity]: Buffer);
            fill_edge_shifts::<2>(t, shifts, count)
        } else {
            let shifts = shifts.cast();
            given!(shifts[capacity]: Buffer);
            fill_edge_shifts::<3>(t, shifts, count)
        }
    })
}

/// Vertices of a periodic triangulation may share a place, as images may do.
pub(super) fn reject_coincidence(options: &Options) -> Result<(), Failure> {
    if options.coincidence == CoincidencePolicy::Reject {
        let wanted = "DELDRIFT_COINCIDENCE_MERGE where the triangulation is periodic";
        return Err(invalid("options.coincidence", 1, wanted));
    }
    Ok(())
}

/// By how many vectors a triangulation repeats.
fn vector_count_of(t: &Content) -> usize {
    match t {
        Content::Open(_) | Content::Weighted(_) => 0,
        Content::Periodic(t) => in_its_period!(t, t => t.vector_count()),
    }
}

fn fill_reduced_vectors<const D: usize>(
    t: &Content,
    vectors: Buffer<'_, [f64; D]>,
    multiples: Buffer<'_, [i64; D]>,
    greatest: Buffer<'_, u32>,
    capacity: usize,
    count: Output<'_, usize>,
) -> Result<(), Failure> {
    let needed = vector_count_of(t);
    let offers = [vectors.offer(), multiples.offer(), greatest.offer()];
    fill_all(count, needed, capacity, offers, || {
        let (vectors, multiples) = (vectors.places_if_any(needed)?, multiples.places_if_any(needed)?);
        let greatest = greatest.places_if_any(needed)?;
        if let Content::Periodic(t) = t {
            in_its_period!(t, t => {
                write_all(vectors, t.reduced_vectors().map(|(vector, ..)| row_of(vector.as_ref())));
                write_all(multiples, t.reduced_vectors().map(|(_, row, _)| first_of(row)));
                write_all(greatest, t.reduced_vectors().map(|(.., greatest)| greatest));
            });
        }
        Ok(())
    })
}

fn fill_wrapped<const D: usize>(
    t: &Content,
    positions: Points<'_>,
    previous: Points<'_>,
    count: usize,
    places: Buffer<'_, [f64; D]>,
    shifts: Buffer<'_, [i64; D]>,
) -> Result<(), Failure> {
    let (places, shifts) = (places.places(count)?, shifts.places(count)?);
    by_kind!(t => {
        let positions = positions.of(t)?;
        previous.if_any(t)?;
        check_points_of(t, &positions)?;
        write_all(places, positions.iter().map(|position| row_of(position.as_ref())));
        write_all(shifts, repeat([0; D]));
        Ok(())
    }, periodic t => {
        let wrapped = t.wrap_positions(&positions.of(t)?, previous.if_any(t)?.as_deref())?;
        write_all(places, wrapped.iter().map(|(place, _)| row_of(place.as_ref())));
        write_all(shifts, wrapped.iter().map(|&(_, shift)| first_of(shift)));
        Ok(())
    })
}

fn fill_cell_shifts<const D: usize, const N: usize>(
    t: &Content,
    shifts: Buffer<'_, [[i64; D]; N]>,
    neighbour_shifts: Buffer<'_, [[i64; D]; N]>,
    capacity: usize,
    count: Output<'_, usize>,
) -> Result<(), Failure> {
    let needed = cell_count_of(t)?;
    fill_all(count, needed, capacity, [shifts.offer(), neighbour_shifts.offer()], || {
        let (corners, beside) = (shifts.places_if_any(needed)?, neighbour_shifts.places_if_any(needed)?);
        match t {
            Content::Open(_) | Content::Weighted(_) => {
                write_rows(corners, repeat([0; 3]));
                write_rows(beside, repeat([0; 3]));
            }
            Content::Periodic(t) => in_its_period!(t, t => {
                write_rows(corners, t.cell_shifts()?);
                write_rows(beside, t.neighbour_shifts()?);
            }),
        }
        Ok(())
    })
}

fn fill_edge_shifts<const D: usize>(
    t: &Content,
    shifts: Buffer<'_, [i64; D]>,
    count: Output<'_, usize>,
) -> Result<(), Failure> {
    by_kind!(t => shifts.fill(count, t.edge_count(), || Ok(repeat([0; D]))), periodic t => {
        let edges = t.edges()?;
        shifts.fill(count, edges.len(), || Ok(edges.map(|(_, shift)| first_of(shift))))
    })
}

/// The numbers of a shift along as many vectors as there can be.
fn first_of<const D: usize>(shift: [i64; 3]) -> [i64; D] {
    std::array::from_fn(|k| shift[k])
}

/// Checks that points are in the range of coordinates.
fn check_points_of<G: Moving>(_t: &MovingTriangulation<G>, points: &[G::Point]) -> Result<(), Failure> {
    let mut points = points.iter().enumerate();
    Ok(points.try_for_each(|(index, point)| check_position::<G>("positions", index, point).map(drop))?)
}

/// The coordinates of a point as a row.
fn row_of<const D: usize>(point: &[f64]) -> [f64; D] {
    std::array::from_fn(|axis| point[axis])
}

/// Writes the shifts of all corners, by cell.
fn write_rows<const D: usize, const N: usize>(
    places: &mut [MaybeUninit<[[i64; D]; N]>],
    mut shifts: impl Iterator<Item = [i64; 3]>,
) {
    let mut next = || first_of(shifts.next().expect("there is one for each corner"));
    places.iter_mut().for_each(|place| _ = place.write(std::array::from_fn(|_| next())));
}
