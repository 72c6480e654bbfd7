# deldrift for Julia: its functions, structures and constants. Written by bindings/generate from the headers of deldrift: change it there.
#
# Each function calls the library, which is `LibDeldrift.library[]`. Arguments are those of C: arrays for pointers,
# `Ref` for one value, `C_NULL` for NULL. Ids of vertices and cells count from 0. Columns of a matrix are points.
module LibDeldrift

const library = Ref{String}("libdeldrift")

const DELDRIFT_VERSION_MAJOR = 0x00000000
const DELDRIFT_VERSION_MINOR = 0x00000001
const DELDRIFT_VERSION_PATCH = 0x00000000
const DELDRIFT_NONE = 0xffffffff
const DELDRIFT_OK = 0x00000000
const DELDRIFT_NULL_ARGUMENT = 0x00000001
const DELDRIFT_MISALIGNED_ARGUMENT = 0x00000002
const DELDRIFT_SIZE_OVERFLOW = 0x00000003
const DELDRIFT_INVALID_DIMENSION = 0x00000004
const DELDRIFT_INVALID_OPTIONS = 0x00000005
const DELDRIFT_INVALID_LEVEL = 0x00000006
const DELDRIFT_BUFFER_TOO_SMALL = 0x00000007
const DELDRIFT_NOT_FINITE = 0x00000008
const DELDRIFT_OUT_OF_RANGE = 0x00000009
const DELDRIFT_NO_SUCH_VERTEX = 0x0000000a
const DELDRIFT_REMOVED_VERTEX = 0x0000000b
const DELDRIFT_DUPLICATE_MOVE = 0x0000000c
const DELDRIFT_WRONG_COUNT = 0x0000000d
const DELDRIFT_COINCIDENT = 0x0000000e
const DELDRIFT_TOO_MANY_VERTICES = 0x0000000f
const DELDRIFT_TOO_MANY_CELLS = 0x00000010
const DELDRIFT_OUT_OF_MEMORY = 0x00000011
const DELDRIFT_CANCELLED = 0x00000012
const DELDRIFT_INVALID = 0x00000013
const DELDRIFT_BUSY = 0x00000014
const DELDRIFT_POISONED = 0x00000015
const DELDRIFT_INTERNAL_ERROR = 0x00000016
const DELDRIFT_NO_SUCH_FACET = 0x00000017
const DELDRIFT_INVALID_VALUE = 0x00000018
const DELDRIFT_INVALID_DATA = 0x00000019
const DELDRIFT_IO_ERROR = 0x0000001a
const DELDRIFT_INVALID_FIELD = 0x0000001b
const DELDRIFT_STAGED_VERTEX = 0x0000001c
const DELDRIFT_NO_SUCH_SEGMENT = 0x0000001d
const DELDRIFT_CROSSING = 0x0000001e
const DELDRIFT_ON_SEGMENT = 0x0000001f
const DELDRIFT_END_REMOVED = 0x00000020
const DELDRIFT_ENDS_MEET = 0x00000021
const DELDRIFT_AMBIGUOUS_SEED = 0x00000022
const DELDRIFT_PASSES_SEGMENT = 0x00000023
const DELDRIFT_PREPARED = 0x00000024
const DELDRIFT_NOT_PREPARED = 0x00000025
const DELDRIFT_PERIODIC = 0x00000026
const DELDRIFT_DEPENDENT_VECTORS = 0x00000027
const DELDRIFT_CHANGES_NOT_TAKEN = 0x00000028
const DELDRIFT_UNDECIDED_REGIONS = 0x00000029
const DELDRIFT_WEIGHTED = 0x0000002a
const DELDRIFT_NOT_WEIGHTED = 0x0000002b
const DELDRIFT_AUTO = 0x00000000
const DELDRIFT_REBUILDING = 0x00000001
const DELDRIFT_PLACEMENT_FLIPS = 0x00000002
const DELDRIFT_TOLERANCE = 0x00000003
const DELDRIFT_REPAIR = 0x00000004
const DELDRIFT_COINCIDENCE_MERGE = 0x00000000
const DELDRIFT_COINCIDENCE_REJECT = 0x00000001
const DELDRIFT_PASSING_IGNORE = 0x00000000
const DELDRIFT_PASSING_TELL = 0x00000001
const DELDRIFT_PASSING_REFUSE = 0x00000002
const DELDRIFT_TRANSFER_FIRST_ORDER = 0x00000000
const DELDRIFT_TRANSFER_SECOND_ORDER = 0x00000001
const DELDRIFT_LOCATION_VERTEX = 0x00000000
const DELDRIFT_LOCATION_CELL = 0x00000001
const DELDRIFT_LOCATION_OUTSIDE = 0x00000002
const DELDRIFT_LOCATION_NO_CELLS = 0x00000003
const DELDRIFT_INTERPOLATION_LINEAR = 0x00000000
const DELDRIFT_INTERPOLATION_NATURAL_NEIGHBOUR = 0x00000001
const DELDRIFT_PAIRS_FULL = 0x00000000
const DELDRIFT_PAIRS_HALF = 0x00000001
const DELDRIFT_NO_LABEL = typemin(Int32)
const DELDRIFT_CONFLICT_CROSSING = 0x00000000
const DELDRIFT_CONFLICT_ON_SEGMENT = 0x00000001
const DELDRIFT_CONFLICT_END_REMOVED = 0x00000002
const DELDRIFT_CONFLICT_ENDS_MEET = 0x00000003
const DELDRIFT_DOMAIN_NESTING = 0x00000000
const DELDRIFT_DOMAIN_EVEN_ODD = 0x00000001
const DELDRIFT_DOMAIN_INSIDE = 0x00000002
const DELDRIFT_DOMAIN_REGIONS = 0x00000003
const DELDRIFT_KEPT_NONE = 0x00000000
const DELDRIFT_KEPT_OUTER = 0x00000001
const DELDRIFT_KEPT_ALL = 0x00000002
const DELDRIFT_RESEARCH_PLACEMENT = 0x00000010
const DELDRIFT_RESEARCH_SAFE_REGION = 0x00000011
const DELDRIFT_RESEARCH_SAFE_REGION_TOLERANCE = 0x00000012
const DELDRIFT_RESEARCH_REBUILDING_TOLERANCE = 0x00000013

mutable struct deldrift_options
    struct_size::Csize_t
    algorithm::UInt32
    threads::UInt32
    coincidence::UInt32
    passing::UInt32
    parts::Csize_t
    cancel::Ptr{Cvoid}
    progress::Ptr{Cvoid}
    user_data::Ptr{Cvoid}
    deldrift_options() = (made = new(); GC.@preserve made Base.Libc.memset(pointer_from_objref(made), 0, sizeof(made)); made.struct_size = sizeof(deldrift_options); made)
end

mutable struct deldrift_cells_view
    count::Csize_t
    corners_per_cell::UInt32
    vertices::Ptr{UInt32}
    neighbours::Ptr{UInt32}
    deldrift_cells_view() = (made = new(); GC.@preserve made Base.Libc.memset(pointer_from_objref(made), 0, sizeof(made)); made)
end

mutable struct deldrift_commit_report
    timestamp::UInt64
    moved::UInt64
    unchanged::UInt64
    placements::UInt64
    flips::UInt64
    rebuilds::UInt64
    coincident::UInt64
    within_tolerance::UInt64
    tolerances::UInt64
    certificates::UInt64
    exact_calls::UInt64
    inserted::UInt64
    removed::UInt64
    reweighted::UInt64
    hidden_by_weight::UInt64
    newly_hidden::UInt64
    newly_shown::UInt64
    reserved::NTuple{3, UInt64}
    deldrift_commit_report() = (made = new(); GC.@preserve made Base.Libc.memset(pointer_from_objref(made), 0, sizeof(made)); made)
end

mutable struct deldrift_changes
    created_count::Csize_t
    created::Ptr{UInt32}
    removed_count::Csize_t
    removed::Ptr{UInt32}
    removed_vertices::Ptr{UInt32}
    renumbered_count::Csize_t
    renumbered_from::Ptr{UInt32}
    renumbered_to::Ptr{UInt32}
    star_count::Csize_t
    stars::Ptr{UInt32}
    hidden_count::Csize_t
    hidden::Ptr{UInt32}
    shown_count::Csize_t
    shown::Ptr{UInt32}
    reserved::NTuple{4, Csize_t}
    deldrift_changes() = (made = new(); GC.@preserve made Base.Libc.memset(pointer_from_objref(made), 0, sizeof(made)); made)
end

mutable struct deldrift_transfer_report
    gone::UInt64
    arrived::UInt64
    overlaps::UInt64
    turned_over::UInt64
    uncovered::UInt64
    reserved::NTuple{3, UInt64}
    lost_volume::Cdouble
    gained_volume::Cdouble
    volume_error::Cdouble
    reserved_numbers::NTuple{3, Cdouble}
    deldrift_transfer_report() = (made = new(); GC.@preserve made Base.Libc.memset(pointer_from_objref(made), 0, sizeof(made)); made)
end

mutable struct deldrift_location
    kind::UInt32
    index::UInt32
    deldrift_location() = (made = new(); GC.@preserve made Base.Libc.memset(pointer_from_objref(made), 0, sizeof(made)); made)
end

mutable struct deldrift_conflict
    kind::UInt32
    segment::UInt32
    other::UInt32
    deldrift_conflict() = (made = new(); GC.@preserve made Base.Libc.memset(pointer_from_objref(made), 0, sizeof(made)); made)
end

mutable struct deldrift_split_report
    inserted::UInt64
    replaced_segments::UInt64
    pieces::UInt64
    rounds::UInt64
    first_vertex::UInt32
    first_piece::UInt32
    reserved::NTuple{3, UInt64}
    deldrift_split_report() = (made = new(); GC.@preserve made Base.Libc.memset(pointer_from_objref(made), 0, sizeof(made)); made)
end

mutable struct deldrift_quality
    struct_size::Csize_t
    least_angle::Cdouble
    greatest_area::Cdouble
    labels::Ptr{Int32}
    label_count::Csize_t
    areas::Ptr{Cdouble}
    area_count::Csize_t
    sizes::Ptr{Cdouble}
    size_count::Csize_t
    is_too_large::Ptr{Cvoid}
    user_data::Ptr{Cvoid}
    keeps::UInt32
    has_weights::UInt32
    is_conforming::UInt32
    limit::Csize_t
    margin::Cdouble
    share::Cdouble
    joins::Cdouble
    growth::Cdouble
    reuses_ids::UInt32
    domain::UInt32
    deldrift_quality() = (made = new(); GC.@preserve made Base.Libc.memset(pointer_from_objref(made), 0, sizeof(made)); made.struct_size = sizeof(deldrift_quality); made)
end

mutable struct deldrift_quality_report
    inserted::UInt64
    on_segments::UInt64
    removed::UInt64
    replaced_segments::UInt64
    new_segments::UInt64
    unsplit::UInt64
    bad_cells::UInt64
    is_cut_short::UInt64
    reserved::NTuple{4, UInt64}
    deldrift_quality_report() = (made = new(); GC.@preserve made Base.Libc.memset(pointer_from_objref(made), 0, sizeof(made)); made)
end

mutable struct deldrift_field
    name::Cstring
    values::Ptr{Cdouble}
    components::Csize_t
    deldrift_field() = (made = new(); GC.@preserve made Base.Libc.memset(pointer_from_objref(made), 0, sizeof(made)); made)
end

mutable struct deldrift_research_options
    struct_size::Csize_t
    switch_share::Cdouble
    switch_seed::UInt64
    switch_sample::UInt32
    switch_period::UInt32
    deldrift_research_options() = (made = new(); GC.@preserve made Base.Libc.memset(pointer_from_objref(made), 0, sizeof(made)); made.struct_size = sizeof(deldrift_research_options); made)
end

# A status in a few words, in English, without a full stop.
deldrift_status_string(status) = @ccall $(symbol(:deldrift_status_string))(status::UInt32)::Cstring

# The message of the last call on this thread that failed.
deldrift_last_error() = @ccall $(symbol(:deldrift_last_error))()::Cstring

# The version of the library that is running, as "major.minor.patch".
deldrift_version() = @ccall $(symbol(:deldrift_version))()::Cstring

# Creates the Delaunay triangulation of count points in the plane or in space, at timestamp 0.
deldrift_create(dimension, positions, count, options, out) = @ccall $(symbol(:deldrift_create))(dimension::UInt32, positions::Ptr{Cdouble}, count::Csize_t, options::Ptr{deldrift_options}, out::Ptr{Ptr{Cvoid}})::UInt32

# Destroys a triangulation: its memory is freed and its views end.
deldrift_destroy(t) = @ccall $(symbol(:deldrift_destroy))(t::Ptr{Cvoid})::Cvoid

# The dimension of the triangulation, 2 or 3, to *dimension.
deldrift_dimension(t, dimension) = @ccall $(symbol(:deldrift_dimension))(t::Ptr{Cvoid}, dimension::Ptr{UInt32})::UInt32

# Changes the algorithm of later commits.
deldrift_set_algorithm(t, algorithm) = @ccall $(symbol(:deldrift_set_algorithm))(t::Ptr{Cvoid}, algorithm::UInt32)::UInt32

# The algorithm in force, to *algorithm.
deldrift_get_algorithm(t, algorithm) = @ccall $(symbol(:deldrift_get_algorithm))(t::Ptr{Cvoid}, algorithm::Ptr{UInt32})::UInt32

# How many vertices are present, hidden ones included and removed ones not, to *count.
deldrift_vertex_count(t, count) = @ccall $(symbol(:deldrift_vertex_count))(t::Ptr{Cvoid}, count::Ptr{Csize_t})::UInt32

# How many ids there are, to *count: those given so far, or left by the latest deldrift_compact and given since.
deldrift_id_count(t, count) = @ccall $(symbol(:deldrift_id_count))(t::Ptr{Cvoid}, count::Ptr{Csize_t})::UInt32

# How many cells there are, to *count.
deldrift_cell_count(t, count) = @ccall $(symbol(:deldrift_cell_count))(t::Ptr{Cvoid}, count::Ptr{Csize_t})::UInt32

# How many moves are staged for the next timestamp, to *count.
deldrift_staged_count(t, count) = @ccall $(symbol(:deldrift_staged_count))(t::Ptr{Cvoid}, count::Ptr{Csize_t})::UInt32

# How many bytes of memory the triangulation holds, to *bytes.
deldrift_memory_bytes(t, bytes) = @ccall $(symbol(:deldrift_memory_bytes))(t::Ptr{Cvoid}, bytes::Ptr{Csize_t})::UInt32

# The number of the current timestamp, to *timestamp.
deldrift_timestamp(t, timestamp) = @ccall $(symbol(:deldrift_timestamp))(t::Ptr{Cvoid}, timestamp::Ptr{UInt64})::UInt32

# Whether a vertex of this id is present, to *present.
deldrift_is_present(t, vertex, present) = @ccall $(symbol(:deldrift_is_present))(t::Ptr{Cvoid}, vertex::UInt32, present::Ptr{Bool})::UInt32

# The position of a vertex at the current timestamp, not a staged one, to position.
deldrift_position(t, vertex, position) = @ccall $(symbol(:deldrift_position))(t::Ptr{Cvoid}, vertex::UInt32, position::Ptr{Cdouble})::UInt32

# The positions of all ids, in their order.
deldrift_copy_positions(t, positions, capacity, count) = @ccall $(symbol(:deldrift_copy_positions))(t::Ptr{Cvoid}, positions::Ptr{Cdouble}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The cells, without a copy, to *view.
deldrift_cells(t, view) = @ccall $(symbol(:deldrift_cells))(t::Ptr{Cvoid}, view::Ptr{deldrift_cells_view})::UInt32

# Hands the arrays of deldrift_cells over to the program, to *view, with an owner for them, to *owner.
deldrift_release_cells(t, view, owner) = @ccall $(symbol(:deldrift_release_cells))(t::Ptr{Cvoid}, view::Ptr{deldrift_cells_view}, owner::Ptr{Ptr{Cvoid}})::UInt32

# Frees arrays that deldrift_release_cells has handed over, once.
deldrift_free_cells(owner) = @ccall $(symbol(:deldrift_free_cells))(owner::Ptr{Cvoid})::Cvoid

# A copy of the cells: see deldrift_cells_view for what the rows mean.
deldrift_copy_cells(t, vertices, neighbours, capacity, count) = @ccall $(symbol(:deldrift_copy_cells))(t::Ptr{Cvoid}, vertices::Ptr{UInt32}, neighbours::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The star of a vertex: the indices of the cells that have it as a corner, in no particular order.
deldrift_star(t, vertex, cells, capacity, count) = @ccall $(symbol(:deldrift_star))(t::Ptr{Cvoid}, vertex::UInt32, cells::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The tolerance of a vertex, to *out: while every vertex stays closer to its current position than its
# tolerance, no cell changes.
deldrift_tolerance(t, vertex, out) = @ccall $(symbol(:deldrift_tolerance))(t::Ptr{Cvoid}, vertex::UInt32, out::Ptr{Cdouble})::UInt32

# Checks the triangulation exactly, in time proportional to its size.
deldrift_validate(t, level) = @ccall $(symbol(:deldrift_validate))(t::Ptr{Cvoid}, level::UInt32)::UInt32

# Stages the move of one vertex for the next timestamp.
deldrift_move_vertex(t, vertex, position) = @ccall $(symbol(:deldrift_move_vertex))(t::Ptr{Cvoid}, vertex::UInt32, position::Ptr{Cdouble})::UInt32

# Stages the moves of count vertices for the next timestamp: all of them, or none if it fails.
deldrift_move_vertices(t, vertices, positions, count) = @ccall $(symbol(:deldrift_move_vertices))(t::Ptr{Cvoid}, vertices::Ptr{UInt32}, positions::Ptr{Cdouble}, count::Csize_t)::UInt32

# Stages the insertion of count vertices: all of them, or none if it fails.
deldrift_stage_insertions(t, positions, count, first_vertex) = @ccall $(symbol(:deldrift_stage_insertions))(t::Ptr{Cvoid}, positions::Ptr{Cdouble}, count::Csize_t, first_vertex::Ptr{UInt32})::UInt32

# Stages the removal of count vertices: all of them, or none if it fails.
deldrift_stage_removals(t, vertices, count) = @ccall $(symbol(:deldrift_stage_removals))(t::Ptr{Cvoid}, vertices::Ptr{UInt32}, count::Csize_t)::UInt32

# Forgets all staged moves, insertions and removals, of vertices and of segments.
deldrift_discard_moves(t) = @ccall $(symbol(:deldrift_discard_moves))(t::Ptr{Cvoid})::UInt32

# Makes the staged positions the next timestamp.
deldrift_commit_timestamp(t, report) = @ccall $(symbol(:deldrift_commit_timestamp))(t::Ptr{Cvoid}, report::Ptr{deldrift_commit_report})::UInt32

# Moves all vertices and makes that the next timestamp.
deldrift_commit_positions(t, positions, count, report) = @ccall $(symbol(:deldrift_commit_positions))(t::Ptr{Cvoid}, positions::Ptr{Cdouble}, count::Csize_t, report::Ptr{deldrift_commit_report})::UInt32

# What all commits and immediate calls so far have done, in sum, to *report.
deldrift_statistics(t, report) = @ccall $(symbol(:deldrift_statistics))(t::Ptr{Cvoid}, report::Ptr{deldrift_commit_report})::UInt32

# The first phase of a commit.
deldrift_prepare_timestamp(t, report) = @ccall $(symbol(:deldrift_prepare_timestamp))(t::Ptr{Cvoid}, report::Ptr{deldrift_commit_report})::UInt32

# The second phase of a commit.
deldrift_publish_timestamp(t) = @ccall $(symbol(:deldrift_publish_timestamp))(t::Ptr{Cvoid})::UInt32

# Takes back what deldrift_prepare_timestamp has prepared, all rounds.
deldrift_withdraw_timestamp(t) = @ccall $(symbol(:deldrift_withdraw_timestamp))(t::Ptr{Cvoid})::UInt32

# Moves one vertex at once.
deldrift_relocate_vertex(t, vertex, position) = @ccall $(symbol(:deldrift_relocate_vertex))(t::Ptr{Cvoid}, vertex::UInt32, position::Ptr{Cdouble})::UInt32

# Inserts a vertex at once.
deldrift_insert_vertex(t, position, out_vertex) = @ccall $(symbol(:deldrift_insert_vertex))(t::Ptr{Cvoid}, position::Ptr{Cdouble}, out_vertex::Ptr{UInt32})::UInt32

# Removes a vertex at once, with the move or the removal staged for it, if any. deldrift_compact frees its id
# and the rest of its memory; deldrift_stage_insertions_at_free_ids gives the id again.
deldrift_remove_vertex(t, vertex) = @ccall $(symbol(:deldrift_remove_vertex))(t::Ptr{Cvoid}, vertex::UInt32)::UInt32

# Frees the memory that has served removed vertices, and gives the others new ids.
deldrift_compact(t, map, capacity, count) = @ccall $(symbol(:deldrift_compact))(t::Ptr{Cvoid}, map::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Creates a triangulation, as deldrift_create does, of vertices that have keys.
deldrift_create_with_keys(dimension, positions, keys, count, options, out) = @ccall $(symbol(:deldrift_create_with_keys))(dimension::UInt32, positions::Ptr{Cdouble}, keys::Ptr{UInt64}, count::Csize_t, options::Ptr{deldrift_options}, out::Ptr{Ptr{Cvoid}})::UInt32

# Stages the insertion of count vertices, as deldrift_stage_insertions does, with keys.
# deldrift_create_with_keys says what these are.
deldrift_stage_insertions_with_keys(t, positions, keys, count, first_vertex) = @ccall $(symbol(:deldrift_stage_insertions_with_keys))(t::Ptr{Cvoid}, positions::Ptr{Cdouble}, keys::Ptr{UInt64}, count::Csize_t, first_vertex::Ptr{UInt32})::UInt32

# Stages the insertion of count vertices, as deldrift_stage_insertions_with_keys does, under ids that are given
# again.
deldrift_stage_insertions_at_free_ids(t, positions, keys, count, vertices) = @ccall $(symbol(:deldrift_stage_insertions_at_free_ids))(t::Ptr{Cvoid}, positions::Ptr{Cdouble}, keys::Ptr{UInt64}, count::Csize_t, vertices::Ptr{UInt32})::UInt32

# Inserts a vertex at once, as deldrift_insert_vertex does, with a key. deldrift_create_with_keys says what that
# is.
deldrift_insert_vertex_with_key(t, position, key, out_vertex) = @ccall $(symbol(:deldrift_insert_vertex_with_key))(t::Ptr{Cvoid}, position::Ptr{Cdouble}, key::UInt64, out_vertex::Ptr{UInt32})::UInt32

# The key of each vertex by id, to keys: the one that it was given, or else its id.
deldrift_keys(t, keys, capacity, count) = @ccall $(symbol(:deldrift_keys))(t::Ptr{Cvoid}, keys::Ptr{UInt64}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Takes what has changed since the last call of this function, to *changes.
deldrift_take_changes(t, changes) = @ccall $(symbol(:deldrift_take_changes))(t::Ptr{Cvoid}, changes::Ptr{deldrift_changes})::UInt32

# Brings means in cells over to the cells of now.
deldrift_transfer_cells(t, positions, position_count, order, values, value_count, n_values, capacity, report, lost, gained) = @ccall $(symbol(:deldrift_transfer_cells))(t::Ptr{Cvoid}, positions::Ptr{Cdouble}, position_count::Csize_t, order::UInt32, values::Ptr{Cdouble}, value_count::Csize_t, n_values::Csize_t, capacity::Csize_t, report::Ptr{deldrift_transfer_report}, lost::Ptr{Cdouble}, gained::Ptr{Cdouble})::UInt32

# Where a point lies, exactly, to *location.
deldrift_locate(t, position, location) = @ccall $(symbol(:deldrift_locate))(t::Ptr{Cvoid}, position::Ptr{Cdouble}, location::Ptr{deldrift_location})::UInt32

# Where count points lie, exactly, to locations, which has room for count.
deldrift_locate_points(t, positions, count, hint, locations) = @ccall $(symbol(:deldrift_locate_points))(t::Ptr{Cvoid}, positions::Ptr{Cdouble}, count::Csize_t, hint::Ptr{deldrift_location}, locations::Ptr{deldrift_location})::UInt32

# Where count points lie, exactly, to locations, and in which period, to shifts.
deldrift_locate_in_period(t, positions, count, hint, locations, shifts) = @ccall $(symbol(:deldrift_locate_in_period))(t::Ptr{Cvoid}, positions::Ptr{Cdouble}, count::Csize_t, hint::Ptr{deldrift_location}, locations::Ptr{deldrift_location}, shifts::Ptr{Int64})::UInt32

# The vertex nearest to a point, to *vertex.
deldrift_nearest_vertex(t, position, vertex) = @ccall $(symbol(:deldrift_nearest_vertex))(t::Ptr{Cvoid}, position::Ptr{Cdouble}, vertex::Ptr{UInt32})::UInt32

# The vertex that represents this one in cells, to *representative.
deldrift_coincident_representative(t, vertex, representative) = @ccall $(symbol(:deldrift_coincident_representative))(t::Ptr{Cvoid}, vertex::UInt32, representative::Ptr{UInt32})::UInt32

# The vertices that are hidden by place, ascending, each with the one that represents it.
deldrift_hidden_vertices(t, vertices, representatives, capacity, count) = @ccall $(symbol(:deldrift_hidden_vertices))(t::Ptr{Cvoid}, vertices::Ptr{UInt32}, representatives::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The k vertices nearest to each of count positions: rows of k ids, by distance.
deldrift_nearest_vertices(t, positions, count, k, vertices) = @ccall $(symbol(:deldrift_nearest_vertices))(t::Ptr{Cvoid}, positions::Ptr{Cdouble}, count::Csize_t, k::Csize_t, vertices::Ptr{UInt32})::UInt32

# The vertices in a closed ball, ascending by id, hidden ones included.
deldrift_vertices_in_ball(t, centre, squared_radius, vertices, capacity, count) = @ccall $(symbol(:deldrift_vertices_in_ball))(t::Ptr{Cvoid}, centre::Ptr{Cdouble}, squared_radius::Cdouble, vertices::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# For each vertex the others that are near it, all in one call: the neighbour lists of particle codes.
deldrift_neighbour_lists(t, squared_radii, radius_count, mask, mask_count, pairs, offsets, offset_count, neighbours, shifts, capacity, count) = @ccall $(symbol(:deldrift_neighbour_lists))(t::Ptr{Cvoid}, squared_radii::Ptr{Cdouble}, radius_count::Csize_t, mask::Ptr{UInt8}, mask_count::Csize_t, pairs::UInt32, offsets::Ptr{Csize_t}, offset_count::Csize_t, neighbours::Ptr{UInt32}, shifts::Ptr{Int64}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The vertices in a closed box, ascending by id, hidden ones included.
deldrift_vertices_in_box(t, low, high, vertices, capacity, count) = @ccall $(symbol(:deldrift_vertices_in_box))(t::Ptr{Cvoid}, low::Ptr{Cdouble}, high::Ptr{Cdouble}, vertices::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The cells that the insertion of a vertex at a position would remove, in no particular order.
deldrift_conflicts(t, position, hint, cells, capacity, count) = @ccall $(symbol(:deldrift_conflicts))(t::Ptr{Cvoid}, position::Ptr{Cdouble}, hint::Ptr{deldrift_location}, cells::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The cells that a vertex at a place in one of some boxes could change.
deldrift_cells_in_reach(t, low, high, box_count, mask, mask_count, cells, centres, radii, capacity, count) = @ccall $(symbol(:deldrift_cells_in_reach))(t::Ptr{Cvoid}, low::Ptr{Cdouble}, high::Ptr{Cdouble}, box_count::Csize_t, mask::Ptr{UInt8}, mask_count::Csize_t, cells::Ptr{UInt32}, centres::Ptr{Cdouble}, radii::Ptr{Cdouble}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The facets of the convex hull that a place in one of some boxes is strictly beyond, exactly.
deldrift_hull_facets_in_reach(t, low, high, box_count, mask, mask_count, cells, corners, capacity, count) = @ccall $(symbol(:deldrift_hull_facets_in_reach))(t::Ptr{Cvoid}, low::Ptr{Cdouble}, high::Ptr{Cdouble}, box_count::Csize_t, mask::Ptr{UInt8}, mask_count::Csize_t, cells::Ptr{UInt32}, corners::Ptr{UInt8}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# For each of some boxes the vertices of the cells and hull facets in its reach.
deldrift_vertices_in_reach(t, low, high, box_count, mask, mask_count, vertices, offsets, capacity, count) = @ccall $(symbol(:deldrift_vertices_in_reach))(t::Ptr{Cvoid}, low::Ptr{Cdouble}, high::Ptr{Cdouble}, box_count::Csize_t, mask::Ptr{UInt8}, mask_count::Csize_t, vertices::Ptr{UInt32}, offsets::Ptr{Csize_t}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The edges: rows of two vertex ids, the lower one first, each edge once, in lexicographic order.
deldrift_edges(t, edges, capacity, count) = @ccall $(symbol(:deldrift_edges))(t::Ptr{Cvoid}, edges::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The neighbours of all vertices: for each id the vertices with which it shares an edge, ascending, one list
# after the other.
deldrift_vertex_neighbours(t, offsets, offset_count, neighbours, capacity, count) = @ccall $(symbol(:deldrift_vertex_neighbours))(t::Ptr{Cvoid}, offsets::Ptr{UInt32}, offset_count::Csize_t, neighbours::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The cells of all vertices: for each id the indices of the cells that have it as a corner, ascending, one list
# after the other.
deldrift_vertex_cells(t, offsets, offset_count, cells, capacity, count) = @ccall $(symbol(:deldrift_vertex_cells))(t::Ptr{Cvoid}, offsets::Ptr{UInt32}, offset_count::Csize_t, cells::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# A cell of each vertex: for each id the index of the first cell of which the vertex is a corner.
deldrift_cell_of_each_vertex(t, cells, capacity, count) = @ccall $(symbol(:deldrift_cell_of_each_vertex))(t::Ptr{Cvoid}, cells::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Cells that have given vertices as corners: for each of count simplices the index of one, DELDRIFT_NONE if
# there is none.
deldrift_find_simplices(t, corners_per_simplex, vertices, count, cells) = @ccall $(symbol(:deldrift_find_simplices))(t::Ptr{Cvoid}, corners_per_simplex::UInt32, vertices::Ptr{UInt32}, count::Csize_t, cells::Ptr{UInt32})::UInt32

# The mirror indices of all facets, in the order of deldrift_cells.
deldrift_mirror_indices(t, mirrors, capacity, count) = @ccall $(symbol(:deldrift_mirror_indices))(t::Ptr{Cvoid}, mirrors::Ptr{UInt8}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The mirror index of one facet, to *mirror: the corner of the neighbour beyond that is opposite the same facet,
# DELDRIFT_NONE on the hull.
deldrift_mirror_index(t, cell, corner, mirror) = @ccall $(symbol(:deldrift_mirror_index))(t::Ptr{Cvoid}, cell::UInt32, corner::UInt32, mirror::Ptr{UInt32})::UInt32

# The star of a vertex of the plane, counter-clockwise: the indices of the cells that have it as a corner.
deldrift_ordered_star(t, vertex, cells, capacity, count) = @ccall $(symbol(:deldrift_ordered_star))(t::Ptr{Cvoid}, vertex::UInt32, cells::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Interpolates values of the vertices at count positions.
deldrift_interpolate(t, method, values, value_count, n_values, positions, count, hint, outside, results) = @ccall $(symbol(:deldrift_interpolate))(t::Ptr{Cvoid}, method::UInt32, values::Ptr{Cdouble}, value_count::Csize_t, n_values::Csize_t, positions::Ptr{Cdouble}, count::Csize_t, hint::Ptr{deldrift_location}, outside::Ptr{Cdouble}, results::Ptr{Cdouble})::UInt32

# The barycentric coordinates of count positions, each in a cell that is given: rows of 3 (2D) or 4 (3D)
# numbers, one for each corner in the order of deldrift_cells.
deldrift_barycentric(t, positions, cells, count, weights) = @ccall $(symbol(:deldrift_barycentric))(t::Ptr{Cvoid}, positions::Ptr{Cdouble}, cells::Ptr{UInt32}, count::Csize_t, weights::Ptr{Cdouble})::UInt32

# The circumcentres and squared circumradii of all cells, in the order of deldrift_cells.
deldrift_circumcentres(t, centres, squared_radii, capacity, count) = @ccall $(symbol(:deldrift_circumcentres))(t::Ptr{Cvoid}, centres::Ptr{Cdouble}, squared_radii::Ptr{Cdouble}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The areas (2D) or volumes (3D) of all cells, in the order of deldrift_cells.
deldrift_volumes(t, volumes, capacity, count) = @ccall $(symbol(:deldrift_volumes))(t::Ptr{Cvoid}, volumes::Ptr{Cdouble}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Which cells have a circumradius of at most a given one, as for an alpha shape, in the order of deldrift_cells.
deldrift_mask_by_circumradius(t, squared_radius, mask, capacity, count) = @ccall $(symbol(:deldrift_mask_by_circumradius))(t::Ptr{Cvoid}, squared_radius::Cdouble, mask::Ptr{UInt8}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Which cells are more than what the rounding of a straight or flat side has made, in the order of
# deldrift_cells.
deldrift_mask_without_flat_cells(t, tolerance, mask, capacity, count) = @ccall $(symbol(:deldrift_mask_without_flat_cells))(t::Ptr{Cvoid}, tolerance::Cdouble, mask::Ptr{UInt8}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The boundary of some of the cells: the facets between a cell in a mask and one that is not in it, or the
# outside.
deldrift_mask_boundary(t, mask, mask_count, facets, cells, corners, capacity, count) = @ccall $(symbol(:deldrift_mask_boundary))(t::Ptr{Cvoid}, mask::Ptr{UInt8}, mask_count::Csize_t, facets::Ptr{UInt32}, cells::Ptr{UInt32}, corners::Ptr{UInt8}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The facets of the convex hull, in ascending order of cell and then of corner.
deldrift_hull_facets(t, facets, cells, corners, capacity, count) = @ccall $(symbol(:deldrift_hull_facets))(t::Ptr{Cvoid}, facets::Ptr{UInt32}, cells::Ptr{UInt32}, corners::Ptr{UInt8}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The cells around some vertices: those that have at least one of the vertices as a corner, ascending, each
# once.
deldrift_cells_around(t, vertices, vertex_count, cells, capacity, count) = @ccall $(symbol(:deldrift_cells_around))(t::Ptr{Cvoid}, vertices::Ptr{UInt32}, vertex_count::Csize_t, cells::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Computes circumcentres and squared circumradii of some cells again, in arrays that deldrift_circumcentres has
# filled.
deldrift_update_circumcentres(t, cells, cell_count, centres, squared_radii, capacity) = @ccall $(symbol(:deldrift_update_circumcentres))(t::Ptr{Cvoid}, cells::Ptr{UInt32}, cell_count::Csize_t, centres::Ptr{Cdouble}, squared_radii::Ptr{Cdouble}, capacity::Csize_t)::UInt32

# Computes the areas (2D) or volumes (3D) of some cells again, in an array that deldrift_volumes has filled.
deldrift_update_volumes(t, cells, cell_count, volumes, capacity) = @ccall $(symbol(:deldrift_update_volumes))(t::Ptr{Cvoid}, cells::Ptr{UInt32}, cell_count::Csize_t, volumes::Ptr{Cdouble}, capacity::Csize_t)::UInt32

# Decides for some cells again whether their circumradius is at most a given one, in a mask that
# deldrift_mask_by_circumradius has filled for the same one.
deldrift_update_mask_by_circumradius(t, cells, cell_count, squared_radius, mask, capacity) = @ccall $(symbol(:deldrift_update_mask_by_circumradius))(t::Ptr{Cvoid}, cells::Ptr{UInt32}, cell_count::Csize_t, squared_radius::Cdouble, mask::Ptr{UInt8}, capacity::Csize_t)::UInt32

# The orientation of points, exactly, to *sign: 1, -1 or 0.
deldrift_orientation(dimension, points, sign) = @ccall $(symbol(:deldrift_orientation))(dimension::UInt32, points::Ptr{Cdouble}, sign::Ptr{Int32})::UInt32

# Whether a point is inside the circle or sphere through others, exactly, to *sign: 1 inside, -1 outside, 0 on
# it.
deldrift_in_sphere(dimension, points, sign) = @ccall $(symbol(:deldrift_in_sphere))(dimension::UInt32, points::Ptr{Cdouble}, sign::Ptr{Int32})::UInt32

# Whether a point with a weight is inside the power circle or power sphere of others, exactly, to *sign: 1
# inside, -1 outside, 0 on it.
deldrift_in_power_sphere(dimension, points, weights, sign) = @ccall $(symbol(:deldrift_in_power_sphere))(dimension::UInt32, points::Ptr{Cdouble}, weights::Ptr{Cdouble}, sign::Ptr{Int32})::UInt32

# The areas (2D) or volumes (3D) of the Voronoi cells of all ids, within a box.
deldrift_voronoi_volumes(t, low, high, volumes, capacity, count) = @ccall $(symbol(:deldrift_voronoi_volumes))(t::Ptr{Cvoid}, low::Ptr{Cdouble}, high::Ptr{Cdouble}, volumes::Ptr{Cdouble}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The lengths (2D) or areas (3D) of the Voronoi facets of all edges, in the order of deldrift_edges, within a
# box.
deldrift_voronoi_facets(t, low, high, measures, capacity, count) = @ccall $(symbol(:deldrift_voronoi_facets))(t::Ptr{Cvoid}, low::Ptr{Cdouble}, high::Ptr{Cdouble}, measures::Ptr{Cdouble}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The Voronoi cells of all ids within a box: areas (2D) or volumes (3D), boundaries and centroids.
deldrift_voronoi_cells(t, low, high, mask, mask_count, volumes, areas, centroids, capacity, count) = @ccall $(symbol(:deldrift_voronoi_cells))(t::Ptr{Cvoid}, low::Ptr{Cdouble}, high::Ptr{Cdouble}, mask::Ptr{UInt8}, mask_count::Csize_t, volumes::Ptr{Cdouble}, areas::Ptr{Cdouble}, centroids::Ptr{Cdouble}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The Voronoi cells of all ids within a box and half-spaces, as deldrift_voronoi_cells has them within a box.
deldrift_voronoi_cells_within(t, low, high, half_spaces, half_space_count, mask, mask_count, volumes, areas, centroids, capacity, count) = @ccall $(symbol(:deldrift_voronoi_cells_within))(t::Ptr{Cvoid}, low::Ptr{Cdouble}, high::Ptr{Cdouble}, half_spaces::Ptr{Cdouble}, half_space_count::Csize_t, mask::Ptr{UInt8}, mask_count::Csize_t, volumes::Ptr{Cdouble}, areas::Ptr{Cdouble}, centroids::Ptr{Cdouble}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The Voronoi facets of all edges within a box, in the order of deldrift_edges: lengths (2D) or areas (3D),
# centroids, and the derivatives of the areas or volumes on their sides by positions.
deldrift_voronoi_derivatives(t, low, high, mask, mask_count, measures, centroids, derivatives, capacity, count) = @ccall $(symbol(:deldrift_voronoi_derivatives))(t::Ptr{Cvoid}, low::Ptr{Cdouble}, high::Ptr{Cdouble}, mask::Ptr{UInt8}, mask_count::Csize_t, measures::Ptr{Cdouble}, centroids::Ptr{Cdouble}, derivatives::Ptr{Cdouble}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The Voronoi facets of all edges within a box and half-spaces, with derivatives, as
# deldrift_voronoi_derivatives has them within a box.
deldrift_voronoi_derivatives_within(t, low, high, half_spaces, half_space_count, mask, mask_count, measures, centroids, derivatives, capacity, count) = @ccall $(symbol(:deldrift_voronoi_derivatives_within))(t::Ptr{Cvoid}, low::Ptr{Cdouble}, high::Ptr{Cdouble}, half_spaces::Ptr{Cdouble}, half_space_count::Csize_t, mask::Ptr{UInt8}, mask_count::Csize_t, measures::Ptr{Cdouble}, centroids::Ptr{Cdouble}, derivatives::Ptr{Cdouble}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Voronoi cells and facets in one call.
deldrift_voronoi_cells_and_facets(t, low, high, half_spaces, half_space_count, mask, mask_count, volumes, areas, centroids, capacity, count, measures, facet_centroids, derivatives, edge_capacity, edge_count) = @ccall $(symbol(:deldrift_voronoi_cells_and_facets))(t::Ptr{Cvoid}, low::Ptr{Cdouble}, high::Ptr{Cdouble}, half_spaces::Ptr{Cdouble}, half_space_count::Csize_t, mask::Ptr{UInt8}, mask_count::Csize_t, volumes::Ptr{Cdouble}, areas::Ptr{Cdouble}, centroids::Ptr{Cdouble}, capacity::Csize_t, count::Ptr{Csize_t}, measures::Ptr{Cdouble}, facet_centroids::Ptr{Cdouble}, derivatives::Ptr{Cdouble}, edge_capacity::Csize_t, edge_count::Ptr{Csize_t})::UInt32

# Areas (2D) or volumes (3D) of Voronoi cells, and their derivatives by weights, in one call: what Newton's
# method needs that looks for weights for which cells have prescribed areas or volumes, as in semi-discrete
# optimal transport.
deldrift_voronoi_weight_derivatives(t, low, high, half_spaces, half_space_count, mask, mask_count, volumes, capacity, count, weight_derivatives, edge_capacity, edge_count) = @ccall $(symbol(:deldrift_voronoi_weight_derivatives))(t::Ptr{Cvoid}, low::Ptr{Cdouble}, high::Ptr{Cdouble}, half_spaces::Ptr{Cdouble}, half_space_count::Csize_t, mask::Ptr{UInt8}, mask_count::Csize_t, volumes::Ptr{Cdouble}, capacity::Csize_t, count::Ptr{Csize_t}, weight_derivatives::Ptr{Cdouble}, edge_capacity::Csize_t, edge_count::Ptr{Csize_t})::UInt32

# Marks the vertices whose Voronoi cell has changed, or may have.
deldrift_voronoi_changed(t, vertices, vertex_count, mask, capacity, count) = @ccall $(symbol(:deldrift_voronoi_changed))(t::Ptr{Cvoid}, vertices::Ptr{UInt32}, vertex_count::Csize_t, mask::Ptr{UInt8}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Creates the regular triangulation of count points with weights in the plane or in space, at timestamp 0: the
# weighted Delaunay triangulation, which is the dual of the power diagram.
deldrift_create_weighted(dimension, positions, weights, keys, count, options, out) = @ccall $(symbol(:deldrift_create_weighted))(dimension::UInt32, positions::Ptr{Cdouble}, weights::Ptr{Cdouble}, keys::Ptr{UInt64}, count::Csize_t, options::Ptr{deldrift_options}, out::Ptr{Ptr{Cvoid}})::UInt32

# Whether the triangulation has weights, to *weighted.
deldrift_is_weighted(t, weighted) = @ccall $(symbol(:deldrift_is_weighted))(t::Ptr{Cvoid}, weighted::Ptr{Bool})::UInt32

# The weights of all ids, in their order: those of the current timestamp, or those that vertices whose insertion
# is staged will have.
deldrift_weights(t, weights, capacity, count) = @ccall $(symbol(:deldrift_weights))(t::Ptr{Cvoid}, weights::Ptr{Cdouble}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Stages other weights of count vertices for the next timestamp: all of them, or none if it fails.
deldrift_stage_weights(t, vertices, weights, count) = @ccall $(symbol(:deldrift_stage_weights))(t::Ptr{Cvoid}, vertices::Ptr{UInt32}, weights::Ptr{Cdouble}, count::Csize_t)::UInt32

# Moves all vertices, gives all other weights, or both, and makes that the next timestamp:
# deldrift_commit_positions for vertices with weights.
deldrift_commit_weighted(t, positions, weights, count, report) = @ccall $(symbol(:deldrift_commit_weighted))(t::Ptr{Cvoid}, positions::Ptr{Cdouble}, weights::Ptr{Cdouble}, count::Csize_t, report::Ptr{deldrift_commit_report})::UInt32

# Stages the insertion of count vertices with weights, as deldrift_stage_insertions does of vertices of weight
# 0: all of them, or none if it fails.
deldrift_stage_insertions_with_weights(t, positions, weights, count, first_vertex) = @ccall $(symbol(:deldrift_stage_insertions_with_weights))(t::Ptr{Cvoid}, positions::Ptr{Cdouble}, weights::Ptr{Cdouble}, count::Csize_t, first_vertex::Ptr{UInt32})::UInt32

# Inserts a vertex with a weight at once, as deldrift_insert_vertex does one of weight 0. deldrift_take_changes,
# called before and after, tells whom it has hidden; it may be hidden itself.
deldrift_insert_vertex_with_weight(t, position, weight, out_vertex) = @ccall $(symbol(:deldrift_insert_vertex_with_weight))(t::Ptr{Cvoid}, position::Ptr{Cdouble}, weight::Cdouble, out_vertex::Ptr{UInt32})::UInt32

# Gives one vertex another weight at once, whatever is staged for others; it stays where it is.
deldrift_set_weight(t, vertex, weight) = @ccall $(symbol(:deldrift_set_weight))(t::Ptr{Cvoid}, vertex::UInt32, weight::Cdouble)::UInt32

# The vertices that are hidden by weight, ascending, each with the cell that it is above: at its place the power
# sphere of this cell says that it is hidden.
deldrift_hidden_by_weight(t, vertices, cells, capacity, count) = @ccall $(symbol(:deldrift_hidden_by_weight))(t::Ptr{Cvoid}, vertices::Ptr{UInt32}, cells::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Stages segments between vertices: all of them, or none if it fails.
deldrift_stage_segments(t, ends, markers, count, first_segment) = @ccall $(symbol(:deldrift_stage_segments))(t::Ptr{Cvoid}, ends::Ptr{UInt32}, markers::Ptr{Int32}, count::Csize_t, first_segment::Ptr{UInt32})::UInt32

# Stages the removal of segments: all of them, or none if it fails.
deldrift_stage_segment_removals(t, segments, count) = @ccall $(symbol(:deldrift_stage_segment_removals))(t::Ptr{Cvoid}, segments::Ptr{UInt32}, count::Csize_t)::UInt32

# The segments in force, ascending by id.
deldrift_segments(t, segments, ends, markers, capacity, count) = @ccall $(symbol(:deldrift_segments))(t::Ptr{Cvoid}, segments::Ptr{UInt32}, ends::Ptr{UInt32}, markers::Ptr{Int32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Whether a commit of what is staged would be refused because of segments.
deldrift_check_staged(t) = @ccall $(symbol(:deldrift_check_staged))(t::Ptr{Cvoid})::UInt32

# The conflicts for which the latest call that changes or checks t was refused, in ascending order of kind,
# segment and other.
deldrift_segment_conflicts(t, conflicts, capacity, count) = @ccall $(symbol(:deldrift_segment_conflicts))(t::Ptr{Cvoid}, conflicts::Ptr{deldrift_conflict}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Whether vertices would pass segments in a commit of what is staged, whatever the options say of passings.
deldrift_check_passings(t) = @ccall $(symbol(:deldrift_check_passings))(t::Ptr{Cvoid})::UInt32

# The vertices that pass segments in the step that the latest call has looked at, in ascending order of segment
# and vertex.
deldrift_passings(t, segments, vertices, capacity, count) = @ccall $(symbol(:deldrift_passings))(t::Ptr{Cvoid}, segments::Ptr{UInt32}, vertices::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Splits segments, staged ones and those in force, for which a commit of what is staged would be refused.
deldrift_stage_splits(t, limit, report) = @ccall $(symbol(:deldrift_stage_splits))(t::Ptr{Cvoid}, limit::Csize_t, report::Ptr{deldrift_split_report})::UInt32

# The segments at the edges of each cell, in the order of deldrift_cells: entry i of a row is the segment at the
# edge opposite corner i.
deldrift_segments_of_cells(t, segments, capacity, count) = @ccall $(symbol(:deldrift_segments_of_cells))(t::Ptr{Cvoid}, segments::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The cells on both sides of each segment in force, in the order of deldrift_segments.
deldrift_cells_of_segments(t, cells, capacity, count) = @ccall $(symbol(:deldrift_cells_of_segments))(t::Ptr{Cvoid}, cells::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The nesting level of each cell, in the order of deldrift_cells: the least number of edges with segments on a
# path from the cell to the outside.
deldrift_nesting_levels(t, levels, capacity, count) = @ccall $(symbol(:deldrift_nesting_levels))(t::Ptr{Cvoid}, levels::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The crossing number of each cell, in the order of deldrift_cells: the least number of segments on a path from
# the cell to the outside, where each segment at an edge counts.
deldrift_crossing_numbers(t, numbers, capacity, count) = @ccall $(symbol(:deldrift_crossing_numbers))(t::Ptr{Cvoid}, numbers::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# A label for each cell, in the order of deldrift_cells: the label of the first seed in its region.
deldrift_label_cells(t, seeds, labels, seed_count, other, label_of, capacity, count) = @ccall $(symbol(:deldrift_label_cells))(t::Ptr{Cvoid}, seeds::Ptr{Cdouble}, labels::Ptr{Int32}, seed_count::Csize_t, other::Int32, label_of::Ptr{Int32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Computes the labels of some cells again, in an array that deldrift_label_cells has filled, or that is filled
# with nesting levels.
deldrift_update_labels(t, cells, cell_count, other, label_of, capacity, undecided) = @ccall $(symbol(:deldrift_update_labels))(t::Ptr{Cvoid}, cells::Ptr{UInt32}, cell_count::Csize_t, other::Int32, label_of::Ptr{Int32}, capacity::Csize_t, undecided::Ptr{Csize_t})::UInt32

# The boundary of some of the cells of the plane, in closed chains of edges, which have these cells on their
# left.
deldrift_boundary_chains(t, mask, mask_count, vertices, chains, segments, cells, corners, capacity, count) = @ccall $(symbol(:deldrift_boundary_chains))(t::Ptr{Cvoid}, mask::Ptr{UInt8}, mask_count::Csize_t, vertices::Ptr{UInt32}, chains::Ptr{UInt32}, segments::Ptr{UInt32}, cells::Ptr{UInt32}, corners::Ptr{UInt8}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Gives regions labels that follow them.
deldrift_set_regions(t, labels, label_count) = @ccall $(symbol(:deldrift_set_regions))(t::Ptr{Cvoid}, labels::Ptr{Int32}, label_count::Csize_t)::UInt32

# Gives labels to the sides of segments; deldrift_set_regions does so for all of them, by labels of cells.
deldrift_set_segment_sides(t, segments, sides, count) = @ccall $(symbol(:deldrift_set_segment_sides))(t::Ptr{Cvoid}, segments::Ptr{UInt32}, sides::Ptr{Int32}, count::Csize_t)::UInt32

# The label of the region of each cell, in the order of deldrift_cells.
deldrift_regions(t, other, labels, capacity, count, undecided) = @ccall $(symbol(:deldrift_regions))(t::Ptr{Cvoid}, other::Int32, labels::Ptr{Int32}, capacity::Csize_t, count::Ptr{Csize_t}, undecided::Ptr{Csize_t})::UInt32

# Sets a quality to the defaults: no criterion.
deldrift_quality_init(quality) = @ccall $(symbol(:deldrift_quality_init))(quality::Ptr{deldrift_quality})::UInt32

# Inserts vertices into cells of the plane, and on segments at these, until the cells there are of a quality.
deldrift_refine(t, quality, mask, mask_count, report) = @ccall $(symbol(:deldrift_refine))(t::Ptr{Cvoid}, quality::Ptr{deldrift_quality}, mask::Ptr{UInt8}, mask_count::Csize_t, report::Ptr{deldrift_quality_report})::UInt32

# Removes vertices that deldrift_refine has inserted and that are not needed any more.
deldrift_coarsen(t, quality, mask, mask_count, report) = @ccall $(symbol(:deldrift_coarsen))(t::Ptr{Cvoid}, quality::Ptr{deldrift_quality}, mask::Ptr{UInt8}, mask_count::Csize_t, report::Ptr{deldrift_quality_report})::UInt32

# The vertices that deldrift_refine has inserted and that are present, ascending by id.
deldrift_made_vertices(t, vertices, segments, capacity, count) = @ccall $(symbol(:deldrift_made_vertices))(t::Ptr{Cvoid}, vertices::Ptr{UInt32}, segments::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The original of each segment in force, in the order of deldrift_segments.
deldrift_original_segments(t, originals, capacity, count) = @ccall $(symbol(:deldrift_original_segments))(t::Ptr{Cvoid}, originals::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# How linear values at the vertices that the last deldrift_refine inserted, in the order of their ids, follow
# from those at the vertices before.
deldrift_refined_weights(t, vertices, weights, capacity, count) = @ccall $(symbol(:deldrift_refined_weights))(t::Ptr{Cvoid}, vertices::Ptr{UInt32}, weights::Ptr{Cdouble}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The sizes of the vertices that the last deldrift_refine inserted, in the order of their ids: the greatest
# length of edges that it had there, from those given in quality.sizes at the vertices before.
deldrift_refined_sizes(t, sizes, capacity, count) = @ccall $(symbol(:deldrift_refined_sizes))(t::Ptr{Cvoid}, sizes::Ptr{Cdouble}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The vertices that the last deldrift_refine inserted, ascending by id. deldrift_refined_weights and
# deldrift_refined_sizes are in this order.
deldrift_refined_vertices(t, vertices, capacity, count) = @ccall $(symbol(:deldrift_refined_vertices))(t::Ptr{Cvoid}, vertices::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Creates the Delaunay triangulation of points that repeat.
deldrift_create_periodic(dimension, positions, count, vectors, vector_count, options, out) = @ccall $(symbol(:deldrift_create_periodic))(dimension::UInt32, positions::Ptr{Cdouble}, count::Csize_t, vectors::Ptr{Cdouble}, vector_count::Csize_t, options::Ptr{deldrift_options}, out::Ptr{Ptr{Cvoid}})::UInt32

# Creates the regular triangulation of points with weights that repeat: deldrift_create_periodic for vertices
# with weights, as deldrift_create_weighted has them.
deldrift_create_periodic_weighted(dimension, positions, weights, count, vectors, vector_count, options, out) = @ccall $(symbol(:deldrift_create_periodic_weighted))(dimension::UInt32, positions::Ptr{Cdouble}, weights::Ptr{Cdouble}, count::Csize_t, vectors::Ptr{Cdouble}, vector_count::Csize_t, options::Ptr{deldrift_options}, out::Ptr{Ptr{Cvoid}})::UInt32

# Stages other vectors for the box: strain, shear, or others of the same lattice.
deldrift_stage_vectors(t, vectors, vector_count) = @ccall $(symbol(:deldrift_stage_vectors))(t::Ptr{Cvoid}, vectors::Ptr{Cdouble}, vector_count::Csize_t)::UInt32

# The vectors by which the triangulation repeats: those that were given, on the grid of
# deldrift_create_periodic.
deldrift_vectors(t, vectors, capacity, count) = @ccall $(symbol(:deldrift_vectors))(t::Ptr{Cvoid}, vectors::Ptr{Cdouble}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The shortest vectors of the lattice, a reduced basis of it. deldrift_wrap_positions translates by them.
deldrift_reduced_vectors(t, vectors, multiples, greatest, capacity, count) = @ccall $(symbol(:deldrift_reduced_vectors))(t::Ptr{Cvoid}, vectors::Ptr{Cdouble}, multiples::Ptr{Int64}, greatest::Ptr{UInt32}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Takes positions into the box, each to its place in the unit cell of deldrift_reduced_vectors, on the grid of
# deldrift_create_periodic.
deldrift_wrap_positions(t, positions, previous, count, places, shifts) = @ccall $(symbol(:deldrift_wrap_positions))(t::Ptr{Cvoid}, positions::Ptr{Cdouble}, previous::Ptr{Cdouble}, count::Csize_t, places::Ptr{Cdouble}, shifts::Ptr{Int64})::UInt32

# In which period each corner of each cell is, and each neighbour.
deldrift_cell_shifts(t, shifts, neighbour_shifts, capacity, count) = @ccall $(symbol(:deldrift_cell_shifts))(t::Ptr{Cvoid}, shifts::Ptr{Int64}, neighbour_shifts::Ptr{Int64}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# In which period the second vertex of each edge is, in the order of deldrift_edges.
deldrift_edge_shifts(t, shifts, capacity, count) = @ccall $(symbol(:deldrift_edge_shifts))(t::Ptr{Cvoid}, shifts::Ptr{Int64}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Makes an independent copy of the triangulation, to *out.
deldrift_clone(t, out) = @ccall $(symbol(:deldrift_clone))(t::Ptr{Cvoid}, out::Ptr{Ptr{Cvoid}})::UInt32

# Saves the triangulation: writes bytes from which deldrift_load makes one like it, on this machine or any
# other.
deldrift_save(t, buffer, capacity, count) = @ccall $(symbol(:deldrift_save))(t::Ptr{Cvoid}, buffer::Ptr{Cvoid}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# Makes a triangulation of bytes that deldrift_save has written, to *out.
deldrift_load(data, size, options, out) = @ccall $(symbol(:deldrift_load))(data::Ptr{Cvoid}, size::Csize_t, options::Ptr{deldrift_options}, out::Ptr{Ptr{Cvoid}})::UInt32

# Saves the triangulation to a file, as deldrift_save does.
deldrift_save_file(t, path) = @ccall $(symbol(:deldrift_save_file))(t::Ptr{Cvoid}, path::Cstring)::UInt32

# Makes a triangulation of a file that deldrift_save_file has written, to *out, as deldrift_load does.
deldrift_load_file(path, options, out) = @ccall $(symbol(:deldrift_load_file))(path::Cstring, options::Ptr{deldrift_options}, out::Ptr{Ptr{Cvoid}})::UInt32

# Writes a file for ParaView and VTK: an unstructured grid of the cells, in VTK's XML format (.vtu).
deldrift_write_vtu(t, path, vertex_fields, vertex_field_count, cell_fields, cell_field_count) = @ccall $(symbol(:deldrift_write_vtu))(t::Ptr{Cvoid}, path::Cstring, vertex_fields::Ptr{deldrift_field}, vertex_field_count::Csize_t, cell_fields::Ptr{deldrift_field}, cell_field_count::Csize_t)::UInt32

# Writes a file for Mmg, FreeFem, Gmsh and others:
deldrift_write_medit(t, path, references, reference_count) = @ccall $(symbol(:deldrift_write_medit))(t::Ptr{Cvoid}, path::Cstring, references::Ptr{Int32}, reference_count::Csize_t)::UInt32

# Changes the algorithm of later commits to one of research, until deldrift_set_algorithm chooses another.
deldrift_research_set_algorithm(t, algorithm, options) = @ccall $(symbol(:deldrift_research_set_algorithm))(t::Ptr{Cvoid}, algorithm::UInt32, options::Ptr{deldrift_research_options})::UInt32

# How many vertices all commits together have found to be certainly within their safe region, of those that were
# not within their tolerance or whose tolerance was not tested, to *count.
deldrift_research_within_safe_region(t, count) = @ccall $(symbol(:deldrift_research_within_safe_region))(t::Ptr{Cvoid}, count::Ptr{UInt64})::UInt32

# The annulus widths of all bi-cells: entry i of the row of a cell, in the order of deldrift_cells, is that of
# the bi-cell at the facet opposite corner i.
deldrift_research_annulus_widths(t, widths, capacity, count) = @ccall $(symbol(:deldrift_research_annulus_widths))(t::Ptr{Cvoid}, widths::Ptr{Cdouble}, capacity::Csize_t, count::Ptr{Csize_t})::UInt32

# The standard delimiter of a bi-cell: the circle or sphere in the middle of its annulus, see
# deldrift_research_annulus_widths, which has the vertices of the facet inside and the two opposite it outside.
deldrift_research_standard_delimiter(t, cell, corner, centre, radius, tolerance) = @ccall $(symbol(:deldrift_research_standard_delimiter))(t::Ptr{Cvoid}, cell::UInt32, corner::UInt32, centre::Ptr{Cdouble}, radius::Ptr{Cdouble}, tolerance::Ptr{Cdouble})::UInt32

using Libdl

symbol(name) = dlsym(dlopen(library[]), name)

end
