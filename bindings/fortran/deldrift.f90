! deldrift for Fortran: its functions, structures and constants. Written by bindings/generate from the headers of
! deldrift: change it there.
!
! An argument that may be NULL in C may be left out, by keyword or at the end. Ids of vertices and cells count from 0,
! and unsigned numbers are those of the same bits: DELDRIFT_NONE is -1. Points are columns: positions(dimension,
! count). A constant with the name of a function has _VALUE behind it: DELDRIFT_TOLERANCE_VALUE. Options have their
! defaults, struct_size among them. docs/FORTRAN.md has a program.
module deldrift
   use, intrinsic :: iso_c_binding
   implicit none
   public

   integer(c_int32_t), parameter :: DELDRIFT_VERSION_MAJOR = 0
   integer(c_int32_t), parameter :: DELDRIFT_VERSION_MINOR = 1
   integer(c_int32_t), parameter :: DELDRIFT_VERSION_PATCH = 0
   integer(c_int32_t), parameter :: DELDRIFT_NONE = -1
   integer(c_int32_t), parameter :: DELDRIFT_OK = 0
   integer(c_int32_t), parameter :: DELDRIFT_NULL_ARGUMENT = 1
   integer(c_int32_t), parameter :: DELDRIFT_MISALIGNED_ARGUMENT = 2
   integer(c_int32_t), parameter :: DELDRIFT_SIZE_OVERFLOW = 3
   integer(c_int32_t), parameter :: DELDRIFT_INVALID_DIMENSION = 4
   integer(c_int32_t), parameter :: DELDRIFT_INVALID_OPTIONS = 5
   integer(c_int32_t), parameter :: DELDRIFT_INVALID_LEVEL = 6
   integer(c_int32_t), parameter :: DELDRIFT_BUFFER_TOO_SMALL = 7
   integer(c_int32_t), parameter :: DELDRIFT_NOT_FINITE = 8
   integer(c_int32_t), parameter :: DELDRIFT_OUT_OF_RANGE = 9
   integer(c_int32_t), parameter :: DELDRIFT_NO_SUCH_VERTEX = 10
   integer(c_int32_t), parameter :: DELDRIFT_REMOVED_VERTEX = 11
   integer(c_int32_t), parameter :: DELDRIFT_DUPLICATE_MOVE = 12
   integer(c_int32_t), parameter :: DELDRIFT_WRONG_COUNT = 13
   integer(c_int32_t), parameter :: DELDRIFT_COINCIDENT = 14
   integer(c_int32_t), parameter :: DELDRIFT_TOO_MANY_VERTICES = 15
   integer(c_int32_t), parameter :: DELDRIFT_TOO_MANY_CELLS = 16
   integer(c_int32_t), parameter :: DELDRIFT_OUT_OF_MEMORY = 17
   integer(c_int32_t), parameter :: DELDRIFT_CANCELLED = 18
   integer(c_int32_t), parameter :: DELDRIFT_INVALID = 19
   integer(c_int32_t), parameter :: DELDRIFT_BUSY = 20
   integer(c_int32_t), parameter :: DELDRIFT_POISONED = 21
   integer(c_int32_t), parameter :: DELDRIFT_INTERNAL_ERROR = 22
   integer(c_int32_t), parameter :: DELDRIFT_NO_SUCH_FACET = 23
   integer(c_int32_t), parameter :: DELDRIFT_INVALID_VALUE = 24
   integer(c_int32_t), parameter :: DELDRIFT_INVALID_DATA = 25
   integer(c_int32_t), parameter :: DELDRIFT_IO_ERROR = 26
   integer(c_int32_t), parameter :: DELDRIFT_INVALID_FIELD = 27
   integer(c_int32_t), parameter :: DELDRIFT_STAGED_VERTEX = 28
   integer(c_int32_t), parameter :: DELDRIFT_NO_SUCH_SEGMENT = 29
   integer(c_int32_t), parameter :: DELDRIFT_CROSSING = 30
   integer(c_int32_t), parameter :: DELDRIFT_ON_SEGMENT = 31
   integer(c_int32_t), parameter :: DELDRIFT_END_REMOVED = 32
   integer(c_int32_t), parameter :: DELDRIFT_ENDS_MEET = 33
   integer(c_int32_t), parameter :: DELDRIFT_AMBIGUOUS_SEED = 34
   integer(c_int32_t), parameter :: DELDRIFT_PASSES_SEGMENT = 35
   integer(c_int32_t), parameter :: DELDRIFT_PREPARED = 36
   integer(c_int32_t), parameter :: DELDRIFT_NOT_PREPARED = 37
   integer(c_int32_t), parameter :: DELDRIFT_PERIODIC = 38
   integer(c_int32_t), parameter :: DELDRIFT_DEPENDENT_VECTORS = 39
   integer(c_int32_t), parameter :: DELDRIFT_CHANGES_NOT_TAKEN = 40
   integer(c_int32_t), parameter :: DELDRIFT_UNDECIDED_REGIONS = 41
   integer(c_int32_t), parameter :: DELDRIFT_WEIGHTED = 42
   integer(c_int32_t), parameter :: DELDRIFT_NOT_WEIGHTED = 43
   integer(c_int32_t), parameter :: DELDRIFT_AUTO = 0
   integer(c_int32_t), parameter :: DELDRIFT_REBUILDING = 1
   integer(c_int32_t), parameter :: DELDRIFT_PLACEMENT_FLIPS = 2
   integer(c_int32_t), parameter :: DELDRIFT_TOLERANCE_VALUE = 3
   integer(c_int32_t), parameter :: DELDRIFT_REPAIR = 4
   integer(c_int32_t), parameter :: DELDRIFT_COINCIDENCE_MERGE = 0
   integer(c_int32_t), parameter :: DELDRIFT_COINCIDENCE_REJECT = 1
   integer(c_int32_t), parameter :: DELDRIFT_PASSING_IGNORE = 0
   integer(c_int32_t), parameter :: DELDRIFT_PASSING_TELL = 1
   integer(c_int32_t), parameter :: DELDRIFT_PASSING_REFUSE = 2
   integer(c_int32_t), parameter :: DELDRIFT_TRANSFER_FIRST_ORDER = 0
   integer(c_int32_t), parameter :: DELDRIFT_TRANSFER_SECOND_ORDER = 1
   integer(c_int32_t), parameter :: DELDRIFT_LOCATION_VERTEX = 0
   integer(c_int32_t), parameter :: DELDRIFT_LOCATION_CELL = 1
   integer(c_int32_t), parameter :: DELDRIFT_LOCATION_OUTSIDE = 2
   integer(c_int32_t), parameter :: DELDRIFT_LOCATION_NO_CELLS = 3
   integer(c_int32_t), parameter :: DELDRIFT_INTERPOLATION_LINEAR = 0
   integer(c_int32_t), parameter :: DELDRIFT_INTERPOLATION_NATURAL_NEIGHBOUR = 1
   integer(c_int32_t), parameter :: DELDRIFT_PAIRS_FULL = 0
   integer(c_int32_t), parameter :: DELDRIFT_PAIRS_HALF = 1
   integer(c_int32_t), parameter :: DELDRIFT_NO_LABEL = -2147483647_c_int32_t - 1
   integer(c_int32_t), parameter :: DELDRIFT_CONFLICT_CROSSING = 0
   integer(c_int32_t), parameter :: DELDRIFT_CONFLICT_ON_SEGMENT = 1
   integer(c_int32_t), parameter :: DELDRIFT_CONFLICT_END_REMOVED = 2
   integer(c_int32_t), parameter :: DELDRIFT_CONFLICT_ENDS_MEET = 3
   integer(c_int32_t), parameter :: DELDRIFT_DOMAIN_NESTING = 0
   integer(c_int32_t), parameter :: DELDRIFT_DOMAIN_EVEN_ODD = 1
   integer(c_int32_t), parameter :: DELDRIFT_DOMAIN_INSIDE = 2
   integer(c_int32_t), parameter :: DELDRIFT_DOMAIN_REGIONS = 3
   integer(c_int32_t), parameter :: DELDRIFT_KEPT_NONE = 0
   integer(c_int32_t), parameter :: DELDRIFT_KEPT_OUTER = 1
   integer(c_int32_t), parameter :: DELDRIFT_KEPT_ALL = 2
   integer(c_int32_t), parameter :: DELDRIFT_RESEARCH_PLACEMENT = 16
   integer(c_int32_t), parameter :: DELDRIFT_RESEARCH_SAFE_REGION = 17
   integer(c_int32_t), parameter :: DELDRIFT_RESEARCH_SAFE_REGION_TOLERANCE = 18
   integer(c_int32_t), parameter :: DELDRIFT_RESEARCH_REBUILDING_TOLERANCE = 19

   type, bind(c) :: deldrift_options
      integer(c_size_t) :: struct_size = 56
      integer(c_int32_t) :: algorithm = 0
      integer(c_int32_t) :: threads = 0
      integer(c_int32_t) :: coincidence = 0
      integer(c_int32_t) :: passing = 0
      integer(c_size_t) :: parts = 0
      type(c_funptr) :: cancel = c_null_funptr
      type(c_funptr) :: progress = c_null_funptr
      type(c_ptr) :: user_data = c_null_ptr
   end type

   type, bind(c) :: deldrift_cells_view
      integer(c_size_t) :: count = 0
      integer(c_int32_t) :: corners_per_cell = 0
      type(c_ptr) :: vertices = c_null_ptr
      type(c_ptr) :: neighbours = c_null_ptr
   end type

   type, bind(c) :: deldrift_commit_report
      integer(c_int64_t) :: timestamp = 0
      integer(c_int64_t) :: moved = 0
      integer(c_int64_t) :: unchanged = 0
      integer(c_int64_t) :: placements = 0
      integer(c_int64_t) :: flips = 0
      integer(c_int64_t) :: rebuilds = 0
      integer(c_int64_t) :: coincident = 0
      integer(c_int64_t) :: within_tolerance = 0
      integer(c_int64_t) :: tolerances = 0
      integer(c_int64_t) :: certificates = 0
      integer(c_int64_t) :: exact_calls = 0
      integer(c_int64_t) :: inserted = 0
      integer(c_int64_t) :: removed = 0
      integer(c_int64_t) :: reweighted = 0
      integer(c_int64_t) :: hidden_by_weight = 0
      integer(c_int64_t) :: newly_hidden = 0
      integer(c_int64_t) :: newly_shown = 0
      integer(c_int64_t) :: reserved(3) = 0
   end type

   type, bind(c) :: deldrift_changes
      integer(c_size_t) :: created_count = 0
      type(c_ptr) :: created = c_null_ptr
      integer(c_size_t) :: removed_count = 0
      type(c_ptr) :: removed = c_null_ptr
      type(c_ptr) :: removed_vertices = c_null_ptr
      integer(c_size_t) :: renumbered_count = 0
      type(c_ptr) :: renumbered_from = c_null_ptr
      type(c_ptr) :: renumbered_to = c_null_ptr
      integer(c_size_t) :: star_count = 0
      type(c_ptr) :: stars = c_null_ptr
      integer(c_size_t) :: hidden_count = 0
      type(c_ptr) :: hidden = c_null_ptr
      integer(c_size_t) :: shown_count = 0
      type(c_ptr) :: shown = c_null_ptr
      integer(c_size_t) :: reserved(4) = 0
   end type

   type, bind(c) :: deldrift_transfer_report
      integer(c_int64_t) :: gone = 0
      integer(c_int64_t) :: arrived = 0
      integer(c_int64_t) :: overlaps = 0
      integer(c_int64_t) :: turned_over = 0
      integer(c_int64_t) :: uncovered = 0
      integer(c_int64_t) :: reserved(3) = 0
      real(c_double) :: lost_volume = 0
      real(c_double) :: gained_volume = 0
      real(c_double) :: volume_error = 0
      real(c_double) :: reserved_numbers(3) = 0
   end type

   type, bind(c) :: deldrift_location
      integer(c_int32_t) :: kind = 0
      integer(c_int32_t) :: index = 0
   end type

   type, bind(c) :: deldrift_conflict
      integer(c_int32_t) :: kind = 0
      integer(c_int32_t) :: segment = 0
      integer(c_int32_t) :: other = 0
   end type

   type, bind(c) :: deldrift_split_report
      integer(c_int64_t) :: inserted = 0
      integer(c_int64_t) :: replaced_segments = 0
      integer(c_int64_t) :: pieces = 0
      integer(c_int64_t) :: rounds = 0
      integer(c_int32_t) :: first_vertex = 0
      integer(c_int32_t) :: first_piece = 0
      integer(c_int64_t) :: reserved(3) = 0
   end type

   type, bind(c) :: deldrift_quality
      integer(c_size_t) :: struct_size = 152
      real(c_double) :: least_angle = 0
      real(c_double) :: greatest_area = 0
      type(c_ptr) :: labels = c_null_ptr
      integer(c_size_t) :: label_count = 0
      type(c_ptr) :: areas = c_null_ptr
      integer(c_size_t) :: area_count = 0
      type(c_ptr) :: sizes = c_null_ptr
      integer(c_size_t) :: size_count = 0
      type(c_funptr) :: is_too_large = c_null_funptr
      type(c_ptr) :: user_data = c_null_ptr
      integer(c_int32_t) :: keeps = 0
      integer(c_int32_t) :: has_weights = 0
      integer(c_int32_t) :: is_conforming = 0
      integer(c_size_t) :: limit = 0
      real(c_double) :: margin = 0
      real(c_double) :: share = 0
      real(c_double) :: joins = 0
      real(c_double) :: growth = 0
      integer(c_int32_t) :: reuses_ids = 0
      integer(c_int32_t) :: domain = 0
   end type

   type, bind(c) :: deldrift_quality_report
      integer(c_int64_t) :: inserted = 0
      integer(c_int64_t) :: on_segments = 0
      integer(c_int64_t) :: removed = 0
      integer(c_int64_t) :: replaced_segments = 0
      integer(c_int64_t) :: new_segments = 0
      integer(c_int64_t) :: unsplit = 0
      integer(c_int64_t) :: bad_cells = 0
      integer(c_int64_t) :: is_cut_short = 0
      integer(c_int64_t) :: reserved(4) = 0
   end type

   type, bind(c) :: deldrift_field
      type(c_ptr) :: name = c_null_ptr
      type(c_ptr) :: values = c_null_ptr
      integer(c_size_t) :: components = 0
   end type

   type, bind(c) :: deldrift_research_options
      integer(c_size_t) :: struct_size = 32
      real(c_double) :: switch_share = 0
      integer(c_int64_t) :: switch_seed = 0
      integer(c_int32_t) :: switch_sample = 0
      integer(c_int32_t) :: switch_period = 0
   end type

   interface
      ! A status in a few words, in English, without a full stop.
      function deldrift_status_string(status) bind(c) result(status_)
         import
         integer(c_int32_t), value :: status
         type(c_ptr) :: status_
      end function
      ! The message of the last call on this thread that failed.
      function deldrift_last_error() bind(c) result(status_)
         import
         type(c_ptr) :: status_
      end function
      ! The version of the library that is running, as "major.minor.patch".
      function deldrift_version() bind(c) result(status_)
         import
         type(c_ptr) :: status_
      end function
      ! Creates the Delaunay triangulation of count points in the plane or in space, at timestamp 0.
      function deldrift_create(dimension, positions, count, options, out) bind(c) result(status_)
         import
         integer(c_int32_t), value :: dimension
         real(c_double), intent(in), optional :: positions(*)
         integer(c_size_t), value :: count
         type(deldrift_options), intent(in), optional :: options
         type(c_ptr), intent(inout), optional :: out
         integer(c_int32_t) :: status_
      end function
      ! Destroys a triangulation: its memory is freed and its views end.
      subroutine deldrift_destroy(t) bind(c)
         import
         type(c_ptr), value :: t
      end subroutine
      ! The dimension of the triangulation, 2 or 3, to *dimension.
      function deldrift_dimension(t, dimension) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: dimension
         integer(c_int32_t) :: status_
      end function
      ! Changes the algorithm of later commits.
      function deldrift_set_algorithm(t, algorithm) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: algorithm
         integer(c_int32_t) :: status_
      end function
      ! The algorithm in force, to *algorithm.
      function deldrift_get_algorithm(t, algorithm) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: algorithm
         integer(c_int32_t) :: status_
      end function
      ! How many vertices are present, hidden ones included and removed ones not, to *count.
      function deldrift_vertex_count(t, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! How many ids there are, to *count: those given so far, or left by the latest deldrift_compact and given since.
      function deldrift_id_count(t, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! How many cells there are, to *count.
      function deldrift_cell_count(t, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! How many moves are staged for the next timestamp, to *count.
      function deldrift_staged_count(t, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! How many bytes of memory the triangulation holds, to *bytes.
      function deldrift_memory_bytes(t, bytes) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_size_t), intent(inout), optional :: bytes
         integer(c_int32_t) :: status_
      end function
      ! The number of the current timestamp, to *timestamp.
      function deldrift_timestamp(t, timestamp) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int64_t), intent(inout), optional :: timestamp
         integer(c_int32_t) :: status_
      end function
      ! Whether a vertex of this id is present, to *present.
      function deldrift_is_present(t, vertex, present) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: vertex
         logical(c_bool), intent(inout), optional :: present
         integer(c_int32_t) :: status_
      end function
      ! The position of a vertex at the current timestamp, not a staged one, to position.
      function deldrift_position(t, vertex, position) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: vertex
         real(c_double), intent(inout), optional :: position(*)
         integer(c_int32_t) :: status_
      end function
      ! The positions of all ids, in their order.
      function deldrift_copy_positions(t, positions, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(inout), optional :: positions(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The cells, without a copy, to *view.
      function deldrift_cells(t, view) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         type(deldrift_cells_view), intent(inout), optional :: view
         integer(c_int32_t) :: status_
      end function
      ! Hands the arrays of deldrift_cells over to the program, to *view, with an owner for them, to *owner.
      function deldrift_release_cells(t, view, owner) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         type(deldrift_cells_view), intent(inout), optional :: view
         type(c_ptr), intent(inout), optional :: owner
         integer(c_int32_t) :: status_
      end function
      ! Frees arrays that deldrift_release_cells has handed over, once.
      subroutine deldrift_free_cells(owner) bind(c)
         import
         type(c_ptr), value :: owner
      end subroutine
      ! A copy of the cells: see deldrift_cells_view for what the rows mean.
      function deldrift_copy_cells(t, vertices, neighbours, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: vertices(*)
         integer(c_int32_t), intent(inout), optional :: neighbours(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The star of a vertex: the indices of the cells that have it as a corner, in no particular order.
      function deldrift_star(t, vertex, cells, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: vertex
         integer(c_int32_t), intent(inout), optional :: cells(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The tolerance of a vertex, to *out: while every vertex stays closer to its current position than its
      ! tolerance, no cell changes.
      function deldrift_tolerance(t, vertex, out) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: vertex
         real(c_double), intent(inout), optional :: out
         integer(c_int32_t) :: status_
      end function
      ! Checks the triangulation exactly, in time proportional to its size.
      function deldrift_validate(t, level) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: level
         integer(c_int32_t) :: status_
      end function
      ! Stages the move of one vertex for the next timestamp.
      function deldrift_move_vertex(t, vertex, position) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: vertex
         real(c_double), intent(in), optional :: position(*)
         integer(c_int32_t) :: status_
      end function
      ! Stages the moves of count vertices for the next timestamp: all of them, or none if it fails.
      function deldrift_move_vertices(t, vertices, positions, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(in), optional :: vertices(*)
         real(c_double), intent(in), optional :: positions(*)
         integer(c_size_t), value :: count
         integer(c_int32_t) :: status_
      end function
      ! Stages the insertion of count vertices: all of them, or none if it fails.
      function deldrift_stage_insertions(t, positions, count, first_vertex) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: positions(*)
         integer(c_size_t), value :: count
         integer(c_int32_t), intent(inout), optional :: first_vertex
         integer(c_int32_t) :: status_
      end function
      ! Stages the removal of count vertices: all of them, or none if it fails.
      function deldrift_stage_removals(t, vertices, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(in), optional :: vertices(*)
         integer(c_size_t), value :: count
         integer(c_int32_t) :: status_
      end function
      ! Forgets all staged moves, insertions and removals, of vertices and of segments.
      function deldrift_discard_moves(t) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t) :: status_
      end function
      ! Makes the staged positions the next timestamp.
      function deldrift_commit_timestamp(t, report) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         type(deldrift_commit_report), intent(inout), optional :: report
         integer(c_int32_t) :: status_
      end function
      ! Moves all vertices and makes that the next timestamp.
      function deldrift_commit_positions(t, positions, count, report) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: positions(*)
         integer(c_size_t), value :: count
         type(deldrift_commit_report), intent(inout), optional :: report
         integer(c_int32_t) :: status_
      end function
      ! What all commits and immediate calls so far have done, in sum, to *report.
      function deldrift_statistics(t, report) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         type(deldrift_commit_report), intent(inout), optional :: report
         integer(c_int32_t) :: status_
      end function
      ! The first phase of a commit.
      function deldrift_prepare_timestamp(t, report) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         type(deldrift_commit_report), intent(inout), optional :: report
         integer(c_int32_t) :: status_
      end function
      ! The second phase of a commit.
      function deldrift_publish_timestamp(t) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t) :: status_
      end function
      ! Takes back what deldrift_prepare_timestamp has prepared, all rounds.
      function deldrift_withdraw_timestamp(t) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t) :: status_
      end function
      ! Moves one vertex at once.
      function deldrift_relocate_vertex(t, vertex, position) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: vertex
         real(c_double), intent(in), optional :: position(*)
         integer(c_int32_t) :: status_
      end function
      ! Inserts a vertex at once.
      function deldrift_insert_vertex(t, position, out_vertex) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: position(*)
         integer(c_int32_t), intent(inout), optional :: out_vertex
         integer(c_int32_t) :: status_
      end function
      ! Removes a vertex at once, with the move or the removal staged for it, if any. deldrift_compact frees its id
      ! and the rest of its memory; deldrift_stage_insertions_at_free_ids gives the id again.
      function deldrift_remove_vertex(t, vertex) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: vertex
         integer(c_int32_t) :: status_
      end function
      ! Frees the memory that has served removed vertices, and gives the others new ids.
      function deldrift_compact(t, map, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: map(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Creates a triangulation, as deldrift_create does, of vertices that have keys.
      function deldrift_create_with_keys(dimension, positions, keys, count, options, out) bind(c) result(status_)
         import
         integer(c_int32_t), value :: dimension
         real(c_double), intent(in), optional :: positions(*)
         integer(c_int64_t), intent(in), optional :: keys(*)
         integer(c_size_t), value :: count
         type(deldrift_options), intent(in), optional :: options
         type(c_ptr), intent(inout), optional :: out
         integer(c_int32_t) :: status_
      end function
      ! Stages the insertion of count vertices, as deldrift_stage_insertions does, with keys.
      ! deldrift_create_with_keys says what these are.
      function deldrift_stage_insertions_with_keys(t, positions, keys, count, first_vertex) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: positions(*)
         integer(c_int64_t), intent(in), optional :: keys(*)
         integer(c_size_t), value :: count
         integer(c_int32_t), intent(inout), optional :: first_vertex
         integer(c_int32_t) :: status_
      end function
      ! Stages the insertion of count vertices, as deldrift_stage_insertions_with_keys does, under ids that are given
      ! again.
      function deldrift_stage_insertions_at_free_ids(t, positions, keys, count, vertices) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: positions(*)
         integer(c_int64_t), intent(in), optional :: keys(*)
         integer(c_size_t), value :: count
         integer(c_int32_t), intent(inout), optional :: vertices(*)
         integer(c_int32_t) :: status_
      end function
      ! Inserts a vertex at once, as deldrift_insert_vertex does, with a key. deldrift_create_with_keys says what that
      ! is.
      function deldrift_insert_vertex_with_key(t, position, key, out_vertex) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: position(*)
         integer(c_int64_t), value :: key
         integer(c_int32_t), intent(inout), optional :: out_vertex
         integer(c_int32_t) :: status_
      end function
      ! The key of each vertex by id, to keys: the one that it was given, or else its id.
      function deldrift_keys(t, keys, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int64_t), intent(inout), optional :: keys(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Takes what has changed since the last call of this function, to *changes.
      function deldrift_take_changes(t, changes) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         type(deldrift_changes), intent(inout), optional :: changes
         integer(c_int32_t) :: status_
      end function
      ! Brings means in cells over to the cells of now.
      function deldrift_transfer_cells(t, positions, position_count, order, values, value_count, n_values, capacity, &
         report, lost, gained) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: positions(*)
         integer(c_size_t), value :: position_count
         integer(c_int32_t), value :: order
         real(c_double), intent(inout), optional :: values(*)
         integer(c_size_t), value :: value_count
         integer(c_size_t), value :: n_values
         integer(c_size_t), value :: capacity
         type(deldrift_transfer_report), intent(inout), optional :: report
         real(c_double), intent(inout), optional :: lost(*)
         real(c_double), intent(inout), optional :: gained(*)
         integer(c_int32_t) :: status_
      end function
      ! Where a point lies, exactly, to *location.
      function deldrift_locate(t, position, location) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: position(*)
         type(deldrift_location), intent(inout), optional :: location
         integer(c_int32_t) :: status_
      end function
      ! Where count points lie, exactly, to locations, which has room for count.
      function deldrift_locate_points(t, positions, count, hint, locations) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: positions(*)
         integer(c_size_t), value :: count
         type(deldrift_location), intent(in), optional :: hint
         type(deldrift_location), intent(inout), optional :: locations(*)
         integer(c_int32_t) :: status_
      end function
      ! Where count points lie, exactly, to locations, and in which period, to shifts.
      function deldrift_locate_in_period(t, positions, count, hint, locations, shifts) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: positions(*)
         integer(c_size_t), value :: count
         type(deldrift_location), intent(in), optional :: hint
         type(deldrift_location), intent(inout), optional :: locations(*)
         integer(c_int64_t), intent(inout), optional :: shifts(*)
         integer(c_int32_t) :: status_
      end function
      ! The vertex nearest to a point, to *vertex.
      function deldrift_nearest_vertex(t, position, vertex) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: position(*)
         integer(c_int32_t), intent(inout), optional :: vertex
         integer(c_int32_t) :: status_
      end function
      ! The vertex that represents this one in cells, to *representative.
      function deldrift_coincident_representative(t, vertex, representative) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: vertex
         integer(c_int32_t), intent(inout), optional :: representative
         integer(c_int32_t) :: status_
      end function
      ! The vertices that are hidden by place, ascending, each with the one that represents it.
      function deldrift_hidden_vertices(t, vertices, representatives, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: vertices(*)
         integer(c_int32_t), intent(inout), optional :: representatives(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The k vertices nearest to each of count positions: rows of k ids, by distance.
      function deldrift_nearest_vertices(t, positions, count, k, vertices) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: positions(*)
         integer(c_size_t), value :: count
         integer(c_size_t), value :: k
         integer(c_int32_t), intent(inout), optional :: vertices(*)
         integer(c_int32_t) :: status_
      end function
      ! The vertices in a closed ball, ascending by id, hidden ones included.
      function deldrift_vertices_in_ball(t, centre, squared_radius, vertices, capacity, count) bind(c) &
         result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: centre(*)
         real(c_double), value :: squared_radius
         integer(c_int32_t), intent(inout), optional :: vertices(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! For each vertex the others that are near it, all in one call: the neighbour lists of particle codes.
      function deldrift_neighbour_lists(t, squared_radii, radius_count, mask, mask_count, pairs, offsets, &
         offset_count, neighbours, shifts, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: squared_radii(*)
         integer(c_size_t), value :: radius_count
         integer(c_int8_t), intent(in), optional :: mask(*)
         integer(c_size_t), value :: mask_count
         integer(c_int32_t), value :: pairs
         integer(c_size_t), intent(inout), optional :: offsets(*)
         integer(c_size_t), value :: offset_count
         integer(c_int32_t), intent(inout), optional :: neighbours(*)
         integer(c_int64_t), intent(inout), optional :: shifts(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The vertices in a closed box, ascending by id, hidden ones included.
      function deldrift_vertices_in_box(t, low, high, vertices, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: low(*)
         real(c_double), intent(in), optional :: high(*)
         integer(c_int32_t), intent(inout), optional :: vertices(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The cells that the insertion of a vertex at a position would remove, in no particular order.
      function deldrift_conflicts(t, position, hint, cells, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: position(*)
         type(deldrift_location), intent(in), optional :: hint
         integer(c_int32_t), intent(inout), optional :: cells(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The cells that a vertex at a place in one of some boxes could change.
      function deldrift_cells_in_reach(t, low, high, box_count, mask, mask_count, cells, centres, radii, capacity, &
         count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: low(*)
         real(c_double), intent(in), optional :: high(*)
         integer(c_size_t), value :: box_count
         integer(c_int8_t), intent(in), optional :: mask(*)
         integer(c_size_t), value :: mask_count
         integer(c_int32_t), intent(inout), optional :: cells(*)
         real(c_double), intent(inout), optional :: centres(*)
         real(c_double), intent(inout), optional :: radii(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The facets of the convex hull that a place in one of some boxes is strictly beyond, exactly.
      function deldrift_hull_facets_in_reach(t, low, high, box_count, mask, mask_count, cells, corners, capacity, &
         count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: low(*)
         real(c_double), intent(in), optional :: high(*)
         integer(c_size_t), value :: box_count
         integer(c_int8_t), intent(in), optional :: mask(*)
         integer(c_size_t), value :: mask_count
         integer(c_int32_t), intent(inout), optional :: cells(*)
         integer(c_int8_t), intent(inout), optional :: corners(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! For each of some boxes the vertices of the cells and hull facets in its reach.
      function deldrift_vertices_in_reach(t, low, high, box_count, mask, mask_count, vertices, offsets, capacity, &
         count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: low(*)
         real(c_double), intent(in), optional :: high(*)
         integer(c_size_t), value :: box_count
         integer(c_int8_t), intent(in), optional :: mask(*)
         integer(c_size_t), value :: mask_count
         integer(c_int32_t), intent(inout), optional :: vertices(*)
         integer(c_size_t), intent(inout), optional :: offsets(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The edges: rows of two vertex ids, the lower one first, each edge once, in lexicographic order.
      function deldrift_edges(t, edges, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: edges(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The neighbours of all vertices: for each id the vertices with which it shares an edge, ascending, one list
      ! after the other.
      function deldrift_vertex_neighbours(t, offsets, offset_count, neighbours, capacity, count) bind(c) &
         result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: offsets(*)
         integer(c_size_t), value :: offset_count
         integer(c_int32_t), intent(inout), optional :: neighbours(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The cells of all vertices: for each id the indices of the cells that have it as a corner, ascending, one list
      ! after the other.
      function deldrift_vertex_cells(t, offsets, offset_count, cells, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: offsets(*)
         integer(c_size_t), value :: offset_count
         integer(c_int32_t), intent(inout), optional :: cells(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! A cell of each vertex: for each id the index of the first cell of which the vertex is a corner.
      function deldrift_cell_of_each_vertex(t, cells, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: cells(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Cells that have given vertices as corners: for each of count simplices the index of one, DELDRIFT_NONE if
      ! there is none.
      function deldrift_find_simplices(t, corners_per_simplex, vertices, count, cells) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: corners_per_simplex
         integer(c_int32_t), intent(in), optional :: vertices(*)
         integer(c_size_t), value :: count
         integer(c_int32_t), intent(inout), optional :: cells(*)
         integer(c_int32_t) :: status_
      end function
      ! The mirror indices of all facets, in the order of deldrift_cells.
      function deldrift_mirror_indices(t, mirrors, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int8_t), intent(inout), optional :: mirrors(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The mirror index of one facet, to *mirror: the corner of the neighbour beyond that is opposite the same facet,
      ! DELDRIFT_NONE on the hull.
      function deldrift_mirror_index(t, cell, corner, mirror) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: cell
         integer(c_int32_t), value :: corner
         integer(c_int32_t), intent(inout), optional :: mirror
         integer(c_int32_t) :: status_
      end function
      ! The star of a vertex of the plane, counter-clockwise: the indices of the cells that have it as a corner.
      function deldrift_ordered_star(t, vertex, cells, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: vertex
         integer(c_int32_t), intent(inout), optional :: cells(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Interpolates values of the vertices at count positions.
      function deldrift_interpolate(t, method, values, value_count, n_values, positions, count, hint, outside, &
         results) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: method
         real(c_double), intent(in), optional :: values(*)
         integer(c_size_t), value :: value_count
         integer(c_size_t), value :: n_values
         real(c_double), intent(in), optional :: positions(*)
         integer(c_size_t), value :: count
         type(deldrift_location), intent(in), optional :: hint
         real(c_double), intent(in), optional :: outside(*)
         real(c_double), intent(inout), optional :: results(*)
         integer(c_int32_t) :: status_
      end function
      ! The barycentric coordinates of count positions, each in a cell that is given: rows of 3 (2D) or 4 (3D)
      ! numbers, one for each corner in the order of deldrift_cells.
      function deldrift_barycentric(t, positions, cells, count, weights) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: positions(*)
         integer(c_int32_t), intent(in), optional :: cells(*)
         integer(c_size_t), value :: count
         real(c_double), intent(inout), optional :: weights(*)
         integer(c_int32_t) :: status_
      end function
      ! The circumcentres and squared circumradii of all cells, in the order of deldrift_cells.
      function deldrift_circumcentres(t, centres, squared_radii, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(inout), optional :: centres(*)
         real(c_double), intent(inout), optional :: squared_radii(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The areas (2D) or volumes (3D) of all cells, in the order of deldrift_cells.
      function deldrift_volumes(t, volumes, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(inout), optional :: volumes(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Which cells have a circumradius of at most a given one, as for an alpha shape, in the order of deldrift_cells.
      function deldrift_mask_by_circumradius(t, squared_radius, mask, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), value :: squared_radius
         integer(c_int8_t), intent(inout), optional :: mask(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Which cells are more than what the rounding of a straight or flat side has made, in the order of
      ! deldrift_cells.
      function deldrift_mask_without_flat_cells(t, tolerance, mask, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), value :: tolerance
         integer(c_int8_t), intent(inout), optional :: mask(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The boundary of some of the cells: the facets between a cell in a mask and one that is not in it, or the
      ! outside.
      function deldrift_mask_boundary(t, mask, mask_count, facets, cells, corners, capacity, count) bind(c) &
         result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int8_t), intent(in), optional :: mask(*)
         integer(c_size_t), value :: mask_count
         integer(c_int32_t), intent(inout), optional :: facets(*)
         integer(c_int32_t), intent(inout), optional :: cells(*)
         integer(c_int8_t), intent(inout), optional :: corners(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The facets of the convex hull, in ascending order of cell and then of corner.
      function deldrift_hull_facets(t, facets, cells, corners, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: facets(*)
         integer(c_int32_t), intent(inout), optional :: cells(*)
         integer(c_int8_t), intent(inout), optional :: corners(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The cells around some vertices: those that have at least one of the vertices as a corner, ascending, each
      ! once.
      function deldrift_cells_around(t, vertices, vertex_count, cells, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(in), optional :: vertices(*)
         integer(c_size_t), value :: vertex_count
         integer(c_int32_t), intent(inout), optional :: cells(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Computes circumcentres and squared circumradii of some cells again, in arrays that deldrift_circumcentres has
      ! filled.
      function deldrift_update_circumcentres(t, cells, cell_count, centres, squared_radii, capacity) bind(c) &
         result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(in), optional :: cells(*)
         integer(c_size_t), value :: cell_count
         real(c_double), intent(inout), optional :: centres(*)
         real(c_double), intent(inout), optional :: squared_radii(*)
         integer(c_size_t), value :: capacity
         integer(c_int32_t) :: status_
      end function
      ! Computes the areas (2D) or volumes (3D) of some cells again, in an array that deldrift_volumes has filled.
      function deldrift_update_volumes(t, cells, cell_count, volumes, capacity) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(in), optional :: cells(*)
         integer(c_size_t), value :: cell_count
         real(c_double), intent(inout), optional :: volumes(*)
         integer(c_size_t), value :: capacity
         integer(c_int32_t) :: status_
      end function
      ! Decides for some cells again whether their circumradius is at most a given one, in a mask that
      ! deldrift_mask_by_circumradius has filled for the same one.
      function deldrift_update_mask_by_circumradius(t, cells, cell_count, squared_radius, mask, capacity) bind(c) &
         result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(in), optional :: cells(*)
         integer(c_size_t), value :: cell_count
         real(c_double), value :: squared_radius
         integer(c_int8_t), intent(inout), optional :: mask(*)
         integer(c_size_t), value :: capacity
         integer(c_int32_t) :: status_
      end function
      ! The orientation of points, exactly, to *sign: 1, -1 or 0.
      function deldrift_orientation(dimension, points, sign) bind(c) result(status_)
         import
         integer(c_int32_t), value :: dimension
         real(c_double), intent(in), optional :: points(*)
         integer(c_int32_t), intent(inout), optional :: sign
         integer(c_int32_t) :: status_
      end function
      ! Whether a point is inside the circle or sphere through others, exactly, to *sign: 1 inside, -1 outside, 0 on
      ! it.
      function deldrift_in_sphere(dimension, points, sign) bind(c) result(status_)
         import
         integer(c_int32_t), value :: dimension
         real(c_double), intent(in), optional :: points(*)
         integer(c_int32_t), intent(inout), optional :: sign
         integer(c_int32_t) :: status_
      end function
      ! Whether a point with a weight is inside the power circle or power sphere of others, exactly, to *sign: 1
      ! inside, -1 outside, 0 on it.
      function deldrift_in_power_sphere(dimension, points, weights, sign) bind(c) result(status_)
         import
         integer(c_int32_t), value :: dimension
         real(c_double), intent(in), optional :: points(*)
         real(c_double), intent(in), optional :: weights(*)
         integer(c_int32_t), intent(inout), optional :: sign
         integer(c_int32_t) :: status_
      end function
      ! The areas (2D) or volumes (3D) of the Voronoi cells of all ids, within a box.
      function deldrift_voronoi_volumes(t, low, high, volumes, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: low(*)
         real(c_double), intent(in), optional :: high(*)
         real(c_double), intent(inout), optional :: volumes(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The lengths (2D) or areas (3D) of the Voronoi facets of all edges, in the order of deldrift_edges, within a
      ! box.
      function deldrift_voronoi_facets(t, low, high, measures, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: low(*)
         real(c_double), intent(in), optional :: high(*)
         real(c_double), intent(inout), optional :: measures(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The Voronoi cells of all ids within a box: areas (2D) or volumes (3D), boundaries and centroids.
      function deldrift_voronoi_cells(t, low, high, mask, mask_count, volumes, areas, centroids, capacity, count) &
         bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: low(*)
         real(c_double), intent(in), optional :: high(*)
         integer(c_int8_t), intent(in), optional :: mask(*)
         integer(c_size_t), value :: mask_count
         real(c_double), intent(inout), optional :: volumes(*)
         real(c_double), intent(inout), optional :: areas(*)
         real(c_double), intent(inout), optional :: centroids(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The Voronoi cells of all ids within a box and half-spaces, as deldrift_voronoi_cells has them within a box.
      function deldrift_voronoi_cells_within(t, low, high, half_spaces, half_space_count, mask, mask_count, volumes, &
         areas, centroids, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: low(*)
         real(c_double), intent(in), optional :: high(*)
         real(c_double), intent(in), optional :: half_spaces(*)
         integer(c_size_t), value :: half_space_count
         integer(c_int8_t), intent(in), optional :: mask(*)
         integer(c_size_t), value :: mask_count
         real(c_double), intent(inout), optional :: volumes(*)
         real(c_double), intent(inout), optional :: areas(*)
         real(c_double), intent(inout), optional :: centroids(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The Voronoi facets of all edges within a box, in the order of deldrift_edges: lengths (2D) or areas (3D),
      ! centroids, and the derivatives of the areas or volumes on their sides by positions.
      function deldrift_voronoi_derivatives(t, low, high, mask, mask_count, measures, centroids, derivatives, &
         capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: low(*)
         real(c_double), intent(in), optional :: high(*)
         integer(c_int8_t), intent(in), optional :: mask(*)
         integer(c_size_t), value :: mask_count
         real(c_double), intent(inout), optional :: measures(*)
         real(c_double), intent(inout), optional :: centroids(*)
         real(c_double), intent(inout), optional :: derivatives(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The Voronoi facets of all edges within a box and half-spaces, with derivatives, as
      ! deldrift_voronoi_derivatives has them within a box.
      function deldrift_voronoi_derivatives_within(t, low, high, half_spaces, half_space_count, mask, mask_count, &
         measures, centroids, derivatives, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: low(*)
         real(c_double), intent(in), optional :: high(*)
         real(c_double), intent(in), optional :: half_spaces(*)
         integer(c_size_t), value :: half_space_count
         integer(c_int8_t), intent(in), optional :: mask(*)
         integer(c_size_t), value :: mask_count
         real(c_double), intent(inout), optional :: measures(*)
         real(c_double), intent(inout), optional :: centroids(*)
         real(c_double), intent(inout), optional :: derivatives(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Voronoi cells and facets in one call.
      function deldrift_voronoi_cells_and_facets(t, low, high, half_spaces, half_space_count, mask, mask_count, &
         volumes, areas, centroids, capacity, count, measures, facet_centroids, derivatives, edge_capacity, &
         edge_count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: low(*)
         real(c_double), intent(in), optional :: high(*)
         real(c_double), intent(in), optional :: half_spaces(*)
         integer(c_size_t), value :: half_space_count
         integer(c_int8_t), intent(in), optional :: mask(*)
         integer(c_size_t), value :: mask_count
         real(c_double), intent(inout), optional :: volumes(*)
         real(c_double), intent(inout), optional :: areas(*)
         real(c_double), intent(inout), optional :: centroids(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         real(c_double), intent(inout), optional :: measures(*)
         real(c_double), intent(inout), optional :: facet_centroids(*)
         real(c_double), intent(inout), optional :: derivatives(*)
         integer(c_size_t), value :: edge_capacity
         integer(c_size_t), intent(inout), optional :: edge_count
         integer(c_int32_t) :: status_
      end function
      ! Areas (2D) or volumes (3D) of Voronoi cells, and their derivatives by weights, in one call: what Newton's
      ! method needs that looks for weights for which cells have prescribed areas or volumes, as in semi-discrete
      ! optimal transport.
      function deldrift_voronoi_weight_derivatives(t, low, high, half_spaces, half_space_count, mask, mask_count, &
         volumes, capacity, count, weight_derivatives, edge_capacity, edge_count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: low(*)
         real(c_double), intent(in), optional :: high(*)
         real(c_double), intent(in), optional :: half_spaces(*)
         integer(c_size_t), value :: half_space_count
         integer(c_int8_t), intent(in), optional :: mask(*)
         integer(c_size_t), value :: mask_count
         real(c_double), intent(inout), optional :: volumes(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         real(c_double), intent(inout), optional :: weight_derivatives(*)
         integer(c_size_t), value :: edge_capacity
         integer(c_size_t), intent(inout), optional :: edge_count
         integer(c_int32_t) :: status_
      end function
      ! Marks the vertices whose Voronoi cell has changed, or may have.
      function deldrift_voronoi_changed(t, vertices, vertex_count, mask, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(in), optional :: vertices(*)
         integer(c_size_t), value :: vertex_count
         integer(c_int8_t), intent(inout), optional :: mask(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Creates the regular triangulation of count points with weights in the plane or in space, at timestamp 0: the
      ! weighted Delaunay triangulation, which is the dual of the power diagram.
      function deldrift_create_weighted(dimension, positions, weights, keys, count, options, out) bind(c) &
         result(status_)
         import
         integer(c_int32_t), value :: dimension
         real(c_double), intent(in), optional :: positions(*)
         real(c_double), intent(in), optional :: weights(*)
         integer(c_int64_t), intent(in), optional :: keys(*)
         integer(c_size_t), value :: count
         type(deldrift_options), intent(in), optional :: options
         type(c_ptr), intent(inout), optional :: out
         integer(c_int32_t) :: status_
      end function
      ! Whether the triangulation has weights, to *weighted.
      function deldrift_is_weighted(t, weighted) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         logical(c_bool), intent(inout), optional :: weighted
         integer(c_int32_t) :: status_
      end function
      ! The weights of all ids, in their order: those of the current timestamp, or those that vertices whose insertion
      ! is staged will have.
      function deldrift_weights(t, weights, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(inout), optional :: weights(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Stages other weights of count vertices for the next timestamp: all of them, or none if it fails.
      function deldrift_stage_weights(t, vertices, weights, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(in), optional :: vertices(*)
         real(c_double), intent(in), optional :: weights(*)
         integer(c_size_t), value :: count
         integer(c_int32_t) :: status_
      end function
      ! Moves all vertices, gives all other weights, or both, and makes that the next timestamp:
      ! deldrift_commit_positions for vertices with weights.
      function deldrift_commit_weighted(t, positions, weights, count, report) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: positions(*)
         real(c_double), intent(in), optional :: weights(*)
         integer(c_size_t), value :: count
         type(deldrift_commit_report), intent(inout), optional :: report
         integer(c_int32_t) :: status_
      end function
      ! Stages the insertion of count vertices with weights, as deldrift_stage_insertions does of vertices of weight
      ! 0: all of them, or none if it fails.
      function deldrift_stage_insertions_with_weights(t, positions, weights, count, first_vertex) bind(c) &
         result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: positions(*)
         real(c_double), intent(in), optional :: weights(*)
         integer(c_size_t), value :: count
         integer(c_int32_t), intent(inout), optional :: first_vertex
         integer(c_int32_t) :: status_
      end function
      ! Inserts a vertex with a weight at once, as deldrift_insert_vertex does one of weight 0. deldrift_take_changes,
      ! called before and after, tells whom it has hidden; it may be hidden itself.
      function deldrift_insert_vertex_with_weight(t, position, weight, out_vertex) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: position(*)
         real(c_double), value :: weight
         integer(c_int32_t), intent(inout), optional :: out_vertex
         integer(c_int32_t) :: status_
      end function
      ! Gives one vertex another weight at once, whatever is staged for others; it stays where it is.
      function deldrift_set_weight(t, vertex, weight) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: vertex
         real(c_double), value :: weight
         integer(c_int32_t) :: status_
      end function
      ! The vertices that are hidden by weight, ascending, each with the cell that it is above: at its place the power
      ! sphere of this cell says that it is hidden.
      function deldrift_hidden_by_weight(t, vertices, cells, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: vertices(*)
         integer(c_int32_t), intent(inout), optional :: cells(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Stages segments between vertices: all of them, or none if it fails.
      function deldrift_stage_segments(t, ends, markers, count, first_segment) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(in), optional :: ends(*)
         integer(c_int32_t), intent(in), optional :: markers(*)
         integer(c_size_t), value :: count
         integer(c_int32_t), intent(inout), optional :: first_segment
         integer(c_int32_t) :: status_
      end function
      ! Stages the removal of segments: all of them, or none if it fails.
      function deldrift_stage_segment_removals(t, segments, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(in), optional :: segments(*)
         integer(c_size_t), value :: count
         integer(c_int32_t) :: status_
      end function
      ! The segments in force, ascending by id.
      function deldrift_segments(t, segments, ends, markers, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: segments(*)
         integer(c_int32_t), intent(inout), optional :: ends(*)
         integer(c_int32_t), intent(inout), optional :: markers(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Whether a commit of what is staged would be refused because of segments.
      function deldrift_check_staged(t) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t) :: status_
      end function
      ! The conflicts for which the latest call that changes or checks t was refused, in ascending order of kind,
      ! segment and other.
      function deldrift_segment_conflicts(t, conflicts, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         type(deldrift_conflict), intent(inout), optional :: conflicts(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Whether vertices would pass segments in a commit of what is staged, whatever the options say of passings.
      function deldrift_check_passings(t) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t) :: status_
      end function
      ! The vertices that pass segments in the step that the latest call has looked at, in ascending order of segment
      ! and vertex.
      function deldrift_passings(t, segments, vertices, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: segments(*)
         integer(c_int32_t), intent(inout), optional :: vertices(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Splits segments, staged ones and those in force, for which a commit of what is staged would be refused.
      function deldrift_stage_splits(t, limit, report) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_size_t), value :: limit
         type(deldrift_split_report), intent(inout), optional :: report
         integer(c_int32_t) :: status_
      end function
      ! The segments at the edges of each cell, in the order of deldrift_cells: entry i of a row is the segment at the
      ! edge opposite corner i.
      function deldrift_segments_of_cells(t, segments, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: segments(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The cells on both sides of each segment in force, in the order of deldrift_segments.
      function deldrift_cells_of_segments(t, cells, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: cells(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The nesting level of each cell, in the order of deldrift_cells: the least number of edges with segments on a
      ! path from the cell to the outside.
      function deldrift_nesting_levels(t, levels, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: levels(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The crossing number of each cell, in the order of deldrift_cells: the least number of segments on a path from
      ! the cell to the outside, where each segment at an edge counts.
      function deldrift_crossing_numbers(t, numbers, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: numbers(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! A label for each cell, in the order of deldrift_cells: the label of the first seed in its region.
      function deldrift_label_cells(t, seeds, labels, seed_count, other, label_of, capacity, count) bind(c) &
         result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: seeds(*)
         integer(c_int32_t), intent(in), optional :: labels(*)
         integer(c_size_t), value :: seed_count
         integer(c_int32_t), value :: other
         integer(c_int32_t), intent(inout), optional :: label_of(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Computes the labels of some cells again, in an array that deldrift_label_cells has filled, or that is filled
      ! with nesting levels.
      function deldrift_update_labels(t, cells, cell_count, other, label_of, capacity, undecided) bind(c) &
         result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(in), optional :: cells(*)
         integer(c_size_t), value :: cell_count
         integer(c_int32_t), value :: other
         integer(c_int32_t), intent(inout), optional :: label_of(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: undecided
         integer(c_int32_t) :: status_
      end function
      ! The boundary of some of the cells of the plane, in closed chains of edges, which have these cells on their
      ! left.
      function deldrift_boundary_chains(t, mask, mask_count, vertices, chains, segments, cells, corners, capacity, &
         count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int8_t), intent(in), optional :: mask(*)
         integer(c_size_t), value :: mask_count
         integer(c_int32_t), intent(inout), optional :: vertices(*)
         integer(c_int32_t), intent(inout), optional :: chains(*)
         integer(c_int32_t), intent(inout), optional :: segments(*)
         integer(c_int32_t), intent(inout), optional :: cells(*)
         integer(c_int8_t), intent(inout), optional :: corners(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Gives regions labels that follow them.
      function deldrift_set_regions(t, labels, label_count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(in), optional :: labels(*)
         integer(c_size_t), value :: label_count
         integer(c_int32_t) :: status_
      end function
      ! Gives labels to the sides of segments; deldrift_set_regions does so for all of them, by labels of cells.
      function deldrift_set_segment_sides(t, segments, sides, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(in), optional :: segments(*)
         integer(c_int32_t), intent(in), optional :: sides(*)
         integer(c_size_t), value :: count
         integer(c_int32_t) :: status_
      end function
      ! The label of the region of each cell, in the order of deldrift_cells.
      function deldrift_regions(t, other, labels, capacity, count, undecided) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: other
         integer(c_int32_t), intent(inout), optional :: labels(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_size_t), intent(inout), optional :: undecided
         integer(c_int32_t) :: status_
      end function
      ! Sets a quality to the defaults: no criterion.
      function deldrift_quality_init(quality) bind(c) result(status_)
         import
         type(deldrift_quality), intent(inout), optional :: quality
         integer(c_int32_t) :: status_
      end function
      ! Inserts vertices into cells of the plane, and on segments at these, until the cells there are of a quality.
      function deldrift_refine(t, quality, mask, mask_count, report) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         type(deldrift_quality), intent(in), optional :: quality
         integer(c_int8_t), intent(in), optional :: mask(*)
         integer(c_size_t), value :: mask_count
         type(deldrift_quality_report), intent(inout), optional :: report
         integer(c_int32_t) :: status_
      end function
      ! Removes vertices that deldrift_refine has inserted and that are not needed any more.
      function deldrift_coarsen(t, quality, mask, mask_count, report) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         type(deldrift_quality), intent(in), optional :: quality
         integer(c_int8_t), intent(in), optional :: mask(*)
         integer(c_size_t), value :: mask_count
         type(deldrift_quality_report), intent(inout), optional :: report
         integer(c_int32_t) :: status_
      end function
      ! The vertices that deldrift_refine has inserted and that are present, ascending by id.
      function deldrift_made_vertices(t, vertices, segments, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: vertices(*)
         integer(c_int32_t), intent(inout), optional :: segments(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The original of each segment in force, in the order of deldrift_segments.
      function deldrift_original_segments(t, originals, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: originals(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! How linear values at the vertices that the last deldrift_refine inserted, in the order of their ids, follow
      ! from those at the vertices before.
      function deldrift_refined_weights(t, vertices, weights, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: vertices(*)
         real(c_double), intent(inout), optional :: weights(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The sizes of the vertices that the last deldrift_refine inserted, in the order of their ids: the greatest
      ! length of edges that it had there, from those given in quality.sizes at the vertices before.
      function deldrift_refined_sizes(t, sizes, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(inout), optional :: sizes(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The vertices that the last deldrift_refine inserted, ascending by id. deldrift_refined_weights and
      ! deldrift_refined_sizes are in this order.
      function deldrift_refined_vertices(t, vertices, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), intent(inout), optional :: vertices(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Creates the Delaunay triangulation of points that repeat.
      function deldrift_create_periodic(dimension, positions, count, vectors, vector_count, options, out) bind(c) &
         result(status_)
         import
         integer(c_int32_t), value :: dimension
         real(c_double), intent(in), optional :: positions(*)
         integer(c_size_t), value :: count
         real(c_double), intent(in), optional :: vectors(*)
         integer(c_size_t), value :: vector_count
         type(deldrift_options), intent(in), optional :: options
         type(c_ptr), intent(inout), optional :: out
         integer(c_int32_t) :: status_
      end function
      ! Creates the regular triangulation of points with weights that repeat: deldrift_create_periodic for vertices
      ! with weights, as deldrift_create_weighted has them.
      function deldrift_create_periodic_weighted(dimension, positions, weights, count, vectors, vector_count, &
         options, out) bind(c) result(status_)
         import
         integer(c_int32_t), value :: dimension
         real(c_double), intent(in), optional :: positions(*)
         real(c_double), intent(in), optional :: weights(*)
         integer(c_size_t), value :: count
         real(c_double), intent(in), optional :: vectors(*)
         integer(c_size_t), value :: vector_count
         type(deldrift_options), intent(in), optional :: options
         type(c_ptr), intent(inout), optional :: out
         integer(c_int32_t) :: status_
      end function
      ! Stages other vectors for the box: strain, shear, or others of the same lattice.
      function deldrift_stage_vectors(t, vectors, vector_count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: vectors(*)
         integer(c_size_t), value :: vector_count
         integer(c_int32_t) :: status_
      end function
      ! The vectors by which the triangulation repeats: those that were given, on the grid of
      ! deldrift_create_periodic.
      function deldrift_vectors(t, vectors, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(inout), optional :: vectors(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The shortest vectors of the lattice, a reduced basis of it. deldrift_wrap_positions translates by them.
      function deldrift_reduced_vectors(t, vectors, multiples, greatest, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(inout), optional :: vectors(*)
         integer(c_int64_t), intent(inout), optional :: multiples(*)
         integer(c_int32_t), intent(inout), optional :: greatest(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Takes positions into the box, each to its place in the unit cell of deldrift_reduced_vectors, on the grid of
      ! deldrift_create_periodic.
      function deldrift_wrap_positions(t, positions, previous, count, places, shifts) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(in), optional :: positions(*)
         real(c_double), intent(in), optional :: previous(*)
         integer(c_size_t), value :: count
         real(c_double), intent(inout), optional :: places(*)
         integer(c_int64_t), intent(inout), optional :: shifts(*)
         integer(c_int32_t) :: status_
      end function
      ! In which period each corner of each cell is, and each neighbour.
      function deldrift_cell_shifts(t, shifts, neighbour_shifts, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int64_t), intent(inout), optional :: shifts(*)
         integer(c_int64_t), intent(inout), optional :: neighbour_shifts(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! In which period the second vertex of each edge is, in the order of deldrift_edges.
      function deldrift_edge_shifts(t, shifts, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int64_t), intent(inout), optional :: shifts(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Makes an independent copy of the triangulation, to *out.
      function deldrift_clone(t, out) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         type(c_ptr), intent(inout), optional :: out
         integer(c_int32_t) :: status_
      end function
      ! Saves the triangulation: writes bytes from which deldrift_load makes one like it, on this machine or any
      ! other.
      function deldrift_save(t, buffer, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         type(c_ptr), value :: buffer
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! Makes a triangulation of bytes that deldrift_save has written, to *out.
      function deldrift_load(data, size, options, out) bind(c) result(status_)
         import
         type(c_ptr), value :: data
         integer(c_size_t), value :: size
         type(deldrift_options), intent(in), optional :: options
         type(c_ptr), intent(inout), optional :: out
         integer(c_int32_t) :: status_
      end function
      ! Saves the triangulation to a file, as deldrift_save does.
      function deldrift_save_file(t, path) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         character(kind=c_char), intent(in), optional :: path(*)
         integer(c_int32_t) :: status_
      end function
      ! Makes a triangulation of a file that deldrift_save_file has written, to *out, as deldrift_load does.
      function deldrift_load_file(path, options, out) bind(c) result(status_)
         import
         character(kind=c_char), intent(in), optional :: path(*)
         type(deldrift_options), intent(in), optional :: options
         type(c_ptr), intent(inout), optional :: out
         integer(c_int32_t) :: status_
      end function
      ! Writes a file for ParaView and VTK: an unstructured grid of the cells, in VTK's XML format (.vtu).
      function deldrift_write_vtu(t, path, vertex_fields, vertex_field_count, cell_fields, cell_field_count) bind(c) &
         result(status_)
         import
         type(c_ptr), value :: t
         character(kind=c_char), intent(in), optional :: path(*)
         type(deldrift_field), intent(in), optional :: vertex_fields(*)
         integer(c_size_t), value :: vertex_field_count
         type(deldrift_field), intent(in), optional :: cell_fields(*)
         integer(c_size_t), value :: cell_field_count
         integer(c_int32_t) :: status_
      end function
      ! Writes a file for Mmg, FreeFem, Gmsh and others:
      function deldrift_write_medit(t, path, references, reference_count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         character(kind=c_char), intent(in), optional :: path(*)
         integer(c_int32_t), intent(in), optional :: references(*)
         integer(c_size_t), value :: reference_count
         integer(c_int32_t) :: status_
      end function
      ! Changes the algorithm of later commits to one of research, until deldrift_set_algorithm chooses another.
      function deldrift_research_set_algorithm(t, algorithm, options) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: algorithm
         type(deldrift_research_options), intent(in), optional :: options
         integer(c_int32_t) :: status_
      end function
      ! How many vertices all commits together have found to be certainly within their safe region, of those that were
      ! not within their tolerance or whose tolerance was not tested, to *count.
      function deldrift_research_within_safe_region(t, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int64_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The annulus widths of all bi-cells: entry i of the row of a cell, in the order of deldrift_cells, is that of
      ! the bi-cell at the facet opposite corner i.
      function deldrift_research_annulus_widths(t, widths, capacity, count) bind(c) result(status_)
         import
         type(c_ptr), value :: t
         real(c_double), intent(inout), optional :: widths(*)
         integer(c_size_t), value :: capacity
         integer(c_size_t), intent(inout), optional :: count
         integer(c_int32_t) :: status_
      end function
      ! The standard delimiter of a bi-cell: the circle or sphere in the middle of its annulus, see
      ! deldrift_research_annulus_widths, which has the vertices of the facet inside and the two opposite it outside.
      function deldrift_research_standard_delimiter(t, cell, corner, centre, radius, tolerance) bind(c) &
         result(status_)
         import
         type(c_ptr), value :: t
         integer(c_int32_t), value :: cell
         integer(c_int32_t), value :: corner
         real(c_double), intent(inout), optional :: centre(*)
         real(c_double), intent(inout), optional :: radius
         real(c_double), intent(inout), optional :: tolerance
         integer(c_int32_t) :: status_
      end function
   end interface

contains

   ! The message of the last call on this thread that failed.
   function deldrift_message() result(text)
      character(len=:), allocatable :: text
      character(kind=c_char), pointer :: letters(:)
      type(c_ptr) :: message
      integer(c_size_t) :: n, k
      interface
         pure function strlen(string) bind(c) result(length)
            import
            type(c_ptr), value :: string
            integer(c_size_t) :: length
         end function
      end interface
      message = deldrift_last_error()
      n = strlen(message)
      call c_f_pointer(message, letters, [n])
      allocate (character(len=n) :: text)
      do k = 1, n
         text(k:k) = letters(k)
      end do
   end function
end module
