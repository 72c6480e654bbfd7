// deldrift for C#: its functions, structures and constants. Written by bindings/generate from the headers of deldrift: change it there.
//
// Arguments are those of C: arrays for pointers to many, null for NULL, and IntPtr.Zero for a pointer that is not
// given. Ids of vertices and cells count from 0.
using System;
using System.Runtime.InteropServices;

public static class Deldrift
{
    const string Library = "deldrift";

    public const uint DELDRIFT_VERSION_MAJOR = 0;
    public const uint DELDRIFT_VERSION_MINOR = 1;
    public const uint DELDRIFT_VERSION_PATCH = 0;
    public const uint DELDRIFT_NONE = 4294967295;
    public const uint DELDRIFT_OK = 0;
    public const uint DELDRIFT_NULL_ARGUMENT = 1;
    public const uint DELDRIFT_MISALIGNED_ARGUMENT = 2;
    public const uint DELDRIFT_SIZE_OVERFLOW = 3;
    public const uint DELDRIFT_INVALID_DIMENSION = 4;
    public const uint DELDRIFT_INVALID_OPTIONS = 5;
    public const uint DELDRIFT_INVALID_LEVEL = 6;
    public const uint DELDRIFT_BUFFER_TOO_SMALL = 7;
    public const uint DELDRIFT_NOT_FINITE = 8;
    public const uint DELDRIFT_OUT_OF_RANGE = 9;
    public const uint DELDRIFT_NO_SUCH_VERTEX = 10;
    public const uint DELDRIFT_REMOVED_VERTEX = 11;
    public const uint DELDRIFT_DUPLICATE_MOVE = 12;
    public const uint DELDRIFT_WRONG_COUNT = 13;
    public const uint DELDRIFT_COINCIDENT = 14;
    public const uint DELDRIFT_TOO_MANY_VERTICES = 15;
    public const uint DELDRIFT_TOO_MANY_CELLS = 16;
    public const uint DELDRIFT_OUT_OF_MEMORY = 17;
    public const uint DELDRIFT_CANCELLED = 18;
    public const uint DELDRIFT_INVALID = 19;
    public const uint DELDRIFT_BUSY = 20;
    public const uint DELDRIFT_POISONED = 21;
    public const uint DELDRIFT_INTERNAL_ERROR = 22;
    public const uint DELDRIFT_NO_SUCH_FACET = 23;
    public const uint DELDRIFT_INVALID_VALUE = 24;
    public const uint DELDRIFT_INVALID_DATA = 25;
    public const uint DELDRIFT_IO_ERROR = 26;
    public const uint DELDRIFT_INVALID_FIELD = 27;
    public const uint DELDRIFT_STAGED_VERTEX = 28;
    public const uint DELDRIFT_NO_SUCH_SEGMENT = 29;
    public const uint DELDRIFT_CROSSING = 30;
    public const uint DELDRIFT_ON_SEGMENT = 31;
    public const uint DELDRIFT_END_REMOVED = 32;
    public const uint DELDRIFT_ENDS_MEET = 33;
    public const uint DELDRIFT_AMBIGUOUS_SEED = 34;
    public const uint DELDRIFT_PASSES_SEGMENT = 35;
    public const uint DELDRIFT_PREPARED = 36;
    public const uint DELDRIFT_NOT_PREPARED = 37;
    public const uint DELDRIFT_PERIODIC = 38;
    public const uint DELDRIFT_DEPENDENT_VECTORS = 39;
    public const uint DELDRIFT_CHANGES_NOT_TAKEN = 40;
    public const uint DELDRIFT_UNDECIDED_REGIONS = 41;
    public const uint DELDRIFT_WEIGHTED = 42;
    public const uint DELDRIFT_NOT_WEIGHTED = 43;
    public const uint DELDRIFT_AUTO = 0;
    public const uint DELDRIFT_REBUILDING = 1;
    public const uint DELDRIFT_PLACEMENT_FLIPS = 2;
    public const uint DELDRIFT_TOLERANCE = 3;
    public const uint DELDRIFT_REPAIR = 4;
    public const uint DELDRIFT_COINCIDENCE_MERGE = 0;
    public const uint DELDRIFT_COINCIDENCE_REJECT = 1;
    public const uint DELDRIFT_PASSING_IGNORE = 0;
    public const uint DELDRIFT_PASSING_TELL = 1;
    public const uint DELDRIFT_PASSING_REFUSE = 2;
    public const uint DELDRIFT_TRANSFER_FIRST_ORDER = 0;
    public const uint DELDRIFT_TRANSFER_SECOND_ORDER = 1;
    public const uint DELDRIFT_LOCATION_VERTEX = 0;
    public const uint DELDRIFT_LOCATION_CELL = 1;
    public const uint DELDRIFT_LOCATION_OUTSIDE = 2;
    public const uint DELDRIFT_LOCATION_NO_CELLS = 3;
    public const uint DELDRIFT_INTERPOLATION_LINEAR = 0;
    public const uint DELDRIFT_INTERPOLATION_NATURAL_NEIGHBOUR = 1;
    public const uint DELDRIFT_PAIRS_FULL = 0;
    public const uint DELDRIFT_PAIRS_HALF = 1;
    public const int DELDRIFT_NO_LABEL = -2147483648;
    public const uint DELDRIFT_CONFLICT_CROSSING = 0;
    public const uint DELDRIFT_CONFLICT_ON_SEGMENT = 1;
    public const uint DELDRIFT_CONFLICT_END_REMOVED = 2;
    public const uint DELDRIFT_CONFLICT_ENDS_MEET = 3;
    public const uint DELDRIFT_DOMAIN_NESTING = 0;
    public const uint DELDRIFT_DOMAIN_EVEN_ODD = 1;
    public const uint DELDRIFT_DOMAIN_INSIDE = 2;
    public const uint DELDRIFT_DOMAIN_REGIONS = 3;
    public const uint DELDRIFT_KEPT_NONE = 0;
    public const uint DELDRIFT_KEPT_OUTER = 1;
    public const uint DELDRIFT_KEPT_ALL = 2;
    public const uint DELDRIFT_RESEARCH_PLACEMENT = 16;
    public const uint DELDRIFT_RESEARCH_SAFE_REGION = 17;
    public const uint DELDRIFT_RESEARCH_SAFE_REGION_TOLERANCE = 18;
    public const uint DELDRIFT_RESEARCH_REBUILDING_TOLERANCE = 19;

    [StructLayout(LayoutKind.Sequential)]
    public struct deldrift_options
    {
        public UIntPtr struct_size;
        public uint algorithm;
        public uint threads;
        public uint coincidence;
        public uint passing;
        public UIntPtr parts;
        public IntPtr cancel;
        public IntPtr progress;
        public IntPtr user_data;

        /// <summary>The defaults.</summary>
        public static deldrift_options Defaults() => new deldrift_options { struct_size = (UIntPtr)Marshal.SizeOf(typeof(deldrift_options)) };
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct deldrift_cells_view
    {
        public UIntPtr count;
        public uint corners_per_cell;
        public IntPtr vertices;
        public IntPtr neighbours;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct deldrift_commit_report
    {
        public ulong timestamp;
        public ulong moved;
        public ulong unchanged;
        public ulong placements;
        public ulong flips;
        public ulong rebuilds;
        public ulong coincident;
        public ulong within_tolerance;
        public ulong tolerances;
        public ulong certificates;
        public ulong exact_calls;
        public ulong inserted;
        public ulong removed;
        public ulong reweighted;
        public ulong hidden_by_weight;
        public ulong newly_hidden;
        public ulong newly_shown;
        public ulong reserved_0;
        public ulong reserved_1;
        public ulong reserved_2;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct deldrift_changes
    {
        public UIntPtr created_count;
        public IntPtr created;
        public UIntPtr removed_count;
        public IntPtr removed;
        public IntPtr removed_vertices;
        public UIntPtr renumbered_count;
        public IntPtr renumbered_from;
        public IntPtr renumbered_to;
        public UIntPtr star_count;
        public IntPtr stars;
        public UIntPtr hidden_count;
        public IntPtr hidden;
        public UIntPtr shown_count;
        public IntPtr shown;
        public UIntPtr reserved_0;
        public UIntPtr reserved_1;
        public UIntPtr reserved_2;
        public UIntPtr reserved_3;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct deldrift_transfer_report
    {
        public ulong gone;
        public ulong arrived;
        public ulong overlaps;
        public ulong turned_over;
        public ulong uncovered;
        public ulong reserved_0;
        public ulong reserved_1;
        public ulong reserved_2;
        public double lost_volume;
        public double gained_volume;
        public double volume_error;
        public double reserved_numbers_0;
        public double reserved_numbers_1;
        public double reserved_numbers_2;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct deldrift_location
    {
        public uint kind;
        public uint index;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct deldrift_conflict
    {
        public uint kind;
        public uint segment;
        public uint other;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct deldrift_split_report
    {
        public ulong inserted;
        public ulong replaced_segments;
        public ulong pieces;
        public ulong rounds;
        public uint first_vertex;
        public uint first_piece;
        public ulong reserved_0;
        public ulong reserved_1;
        public ulong reserved_2;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct deldrift_quality
    {
        public UIntPtr struct_size;
        public double least_angle;
        public double greatest_area;
        public IntPtr labels;
        public UIntPtr label_count;
        public IntPtr areas;
        public UIntPtr area_count;
        public IntPtr sizes;
        public UIntPtr size_count;
        public IntPtr is_too_large;
        public IntPtr user_data;
        public uint keeps;
        public uint has_weights;
        public uint is_conforming;
        public UIntPtr limit;
        public double margin;
        public double share;
        public double joins;
        public double growth;
        public uint reuses_ids;
        public uint domain;

        /// <summary>The defaults.</summary>
        public static deldrift_quality Defaults() => new deldrift_quality { struct_size = (UIntPtr)Marshal.SizeOf(typeof(deldrift_quality)) };
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct deldrift_quality_report
    {
        public ulong inserted;
        public ulong on_segments;
        public ulong removed;
        public ulong replaced_segments;
        public ulong new_segments;
        public ulong unsplit;
        public ulong bad_cells;
        public ulong is_cut_short;
        public ulong reserved_0;
        public ulong reserved_1;
        public ulong reserved_2;
        public ulong reserved_3;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct deldrift_field
    {
        public IntPtr name;
        public IntPtr values;
        public UIntPtr components;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct deldrift_research_options
    {
        public UIntPtr struct_size;
        public double switch_share;
        public ulong switch_seed;
        public uint switch_sample;
        public uint switch_period;

        /// <summary>The defaults.</summary>
        public static deldrift_research_options Defaults() => new deldrift_research_options { struct_size = (UIntPtr)Marshal.SizeOf(typeof(deldrift_research_options)) };
    }

    /// <summary>A status in a few words, in English, without a full stop.</summary>
    [DllImport(Library)] public static extern IntPtr deldrift_status_string(uint status);

    /// <summary>The message of the last call on this thread that failed.</summary>
    [DllImport(Library)] public static extern IntPtr deldrift_last_error();

    /// <summary>The version of the library that is running, as "major.minor.patch".</summary>
    [DllImport(Library)] public static extern IntPtr deldrift_version();

    /// <summary>Creates the Delaunay triangulation of count points in the plane or in space, at timestamp
    /// 0.</summary>
    [DllImport(Library)] public static extern uint deldrift_create(uint dimension, double[] positions, UIntPtr count, ref deldrift_options options, out IntPtr @out);

    /// <summary>Destroys a triangulation: its memory is freed and its views end.</summary>
    [DllImport(Library)] public static extern void deldrift_destroy(IntPtr t);

    /// <summary>The dimension of the triangulation, 2 or 3, to *dimension.</summary>
    [DllImport(Library)] public static extern uint deldrift_dimension(IntPtr t, ref uint dimension);

    /// <summary>Changes the algorithm of later commits.</summary>
    [DllImport(Library)] public static extern uint deldrift_set_algorithm(IntPtr t, uint algorithm);

    /// <summary>The algorithm in force, to *algorithm.</summary>
    [DllImport(Library)] public static extern uint deldrift_get_algorithm(IntPtr t, ref uint algorithm);

    /// <summary>How many vertices are present, hidden ones included and removed ones not, to *count.</summary>
    [DllImport(Library)] public static extern uint deldrift_vertex_count(IntPtr t, ref UIntPtr count);

    /// <summary>How many ids there are, to *count: those given so far, or left by the latest deldrift_compact and
    /// given since.</summary>
    [DllImport(Library)] public static extern uint deldrift_id_count(IntPtr t, ref UIntPtr count);

    /// <summary>How many cells there are, to *count.</summary>
    [DllImport(Library)] public static extern uint deldrift_cell_count(IntPtr t, ref UIntPtr count);

    /// <summary>How many moves are staged for the next timestamp, to *count.</summary>
    [DllImport(Library)] public static extern uint deldrift_staged_count(IntPtr t, ref UIntPtr count);

    /// <summary>How many bytes of memory the triangulation holds, to *bytes.</summary>
    [DllImport(Library)] public static extern uint deldrift_memory_bytes(IntPtr t, ref UIntPtr bytes);

    /// <summary>The number of the current timestamp, to *timestamp.</summary>
    [DllImport(Library)] public static extern uint deldrift_timestamp(IntPtr t, ref ulong timestamp);

    /// <summary>Whether a vertex of this id is present, to *present.</summary>
    [DllImport(Library)] public static extern uint deldrift_is_present(IntPtr t, uint vertex, ref byte present);

    /// <summary>The position of a vertex at the current timestamp, not a staged one, to position.</summary>
    [DllImport(Library)] public static extern uint deldrift_position(IntPtr t, uint vertex, double[] position);

    /// <summary>The positions of all ids, in their order.</summary>
    [DllImport(Library)] public static extern uint deldrift_copy_positions(IntPtr t, double[] positions, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The cells, without a copy, to *view.</summary>
    [DllImport(Library)] public static extern uint deldrift_cells(IntPtr t, ref deldrift_cells_view view);

    /// <summary>Hands the arrays of deldrift_cells over to the program, to *view, with an owner for them, to
    /// *owner.</summary>
    [DllImport(Library)] public static extern uint deldrift_release_cells(IntPtr t, ref deldrift_cells_view view, out IntPtr owner);

    /// <summary>Frees arrays that deldrift_release_cells has handed over, once.</summary>
    [DllImport(Library)] public static extern void deldrift_free_cells(IntPtr owner);

    /// <summary>A copy of the cells: see deldrift_cells_view for what the rows mean.</summary>
    [DllImport(Library)] public static extern uint deldrift_copy_cells(IntPtr t, uint[] vertices, uint[] neighbours, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The star of a vertex: the indices of the cells that have it as a corner, in no particular
    /// order.</summary>
    [DllImport(Library)] public static extern uint deldrift_star(IntPtr t, uint vertex, uint[] cells, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The tolerance of a vertex, to *out: while every vertex stays closer to its current position than its
    /// tolerance, no cell changes.</summary>
    [DllImport(Library)] public static extern uint deldrift_tolerance(IntPtr t, uint vertex, ref double @out);

    /// <summary>Checks the triangulation exactly, in time proportional to its size.</summary>
    [DllImport(Library)] public static extern uint deldrift_validate(IntPtr t, uint level);

    /// <summary>Stages the move of one vertex for the next timestamp.</summary>
    [DllImport(Library)] public static extern uint deldrift_move_vertex(IntPtr t, uint vertex, double[] position);

    /// <summary>Stages the moves of count vertices for the next timestamp: all of them, or none if it
    /// fails.</summary>
    [DllImport(Library)] public static extern uint deldrift_move_vertices(IntPtr t, uint[] vertices, double[] positions, UIntPtr count);

    /// <summary>Stages the insertion of count vertices: all of them, or none if it fails.</summary>
    [DllImport(Library)] public static extern uint deldrift_stage_insertions(IntPtr t, double[] positions, UIntPtr count, ref uint first_vertex);

    /// <summary>Stages the removal of count vertices: all of them, or none if it fails.</summary>
    [DllImport(Library)] public static extern uint deldrift_stage_removals(IntPtr t, uint[] vertices, UIntPtr count);

    /// <summary>Forgets all staged moves, insertions and removals, of vertices and of segments.</summary>
    [DllImport(Library)] public static extern uint deldrift_discard_moves(IntPtr t);

    /// <summary>Makes the staged positions the next timestamp.</summary>
    [DllImport(Library)] public static extern uint deldrift_commit_timestamp(IntPtr t, ref deldrift_commit_report report);

    /// <summary>Moves all vertices and makes that the next timestamp.</summary>
    [DllImport(Library)] public static extern uint deldrift_commit_positions(IntPtr t, double[] positions, UIntPtr count, ref deldrift_commit_report report);

    /// <summary>What all commits and immediate calls so far have done, in sum, to *report.</summary>
    [DllImport(Library)] public static extern uint deldrift_statistics(IntPtr t, ref deldrift_commit_report report);

    /// <summary>The first phase of a commit.</summary>
    [DllImport(Library)] public static extern uint deldrift_prepare_timestamp(IntPtr t, ref deldrift_commit_report report);

    /// <summary>The second phase of a commit.</summary>
    [DllImport(Library)] public static extern uint deldrift_publish_timestamp(IntPtr t);

    /// <summary>Takes back what deldrift_prepare_timestamp has prepared, all rounds.</summary>
    [DllImport(Library)] public static extern uint deldrift_withdraw_timestamp(IntPtr t);

    /// <summary>Moves one vertex at once.</summary>
    [DllImport(Library)] public static extern uint deldrift_relocate_vertex(IntPtr t, uint vertex, double[] position);

    /// <summary>Inserts a vertex at once.</summary>
    [DllImport(Library)] public static extern uint deldrift_insert_vertex(IntPtr t, double[] position, ref uint out_vertex);

    /// <summary>Removes a vertex at once, with the move or the removal staged for it, if any. deldrift_compact frees
    /// its id and the rest of its memory; deldrift_stage_insertions_at_free_ids gives the id again.</summary>
    [DllImport(Library)] public static extern uint deldrift_remove_vertex(IntPtr t, uint vertex);

    /// <summary>Frees the memory that has served removed vertices, and gives the others new ids.</summary>
    [DllImport(Library)] public static extern uint deldrift_compact(IntPtr t, uint[] map, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Creates a triangulation, as deldrift_create does, of vertices that have keys.</summary>
    [DllImport(Library)] public static extern uint deldrift_create_with_keys(uint dimension, double[] positions, ulong[] keys, UIntPtr count, ref deldrift_options options, out IntPtr @out);

    /// <summary>Stages the insertion of count vertices, as deldrift_stage_insertions does, with keys.
    /// deldrift_create_with_keys says what these are.</summary>
    [DllImport(Library)] public static extern uint deldrift_stage_insertions_with_keys(IntPtr t, double[] positions, ulong[] keys, UIntPtr count, ref uint first_vertex);

    /// <summary>Stages the insertion of count vertices, as deldrift_stage_insertions_with_keys does, under ids that
    /// are given again.</summary>
    [DllImport(Library)] public static extern uint deldrift_stage_insertions_at_free_ids(IntPtr t, double[] positions, ulong[] keys, UIntPtr count, uint[] vertices);

    /// <summary>Inserts a vertex at once, as deldrift_insert_vertex does, with a key. deldrift_create_with_keys says
    /// what that is.</summary>
    [DllImport(Library)] public static extern uint deldrift_insert_vertex_with_key(IntPtr t, double[] position, ulong key, ref uint out_vertex);

    /// <summary>The key of each vertex by id, to keys: the one that it was given, or else its id.</summary>
    [DllImport(Library)] public static extern uint deldrift_keys(IntPtr t, ulong[] keys, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Takes what has changed since the last call of this function, to *changes.</summary>
    [DllImport(Library)] public static extern uint deldrift_take_changes(IntPtr t, ref deldrift_changes changes);

    /// <summary>Brings means in cells over to the cells of now.</summary>
    [DllImport(Library)] public static extern uint deldrift_transfer_cells(IntPtr t, double[] positions, UIntPtr position_count, uint order, double[] values, UIntPtr value_count, UIntPtr n_values, UIntPtr capacity, ref deldrift_transfer_report report, double[] lost, double[] gained);

    /// <summary>Where a point lies, exactly, to *location.</summary>
    [DllImport(Library)] public static extern uint deldrift_locate(IntPtr t, double[] position, ref deldrift_location location);

    /// <summary>Where count points lie, exactly, to locations, which has room for count.</summary>
    [DllImport(Library)] public static extern uint deldrift_locate_points(IntPtr t, double[] positions, UIntPtr count, ref deldrift_location hint, deldrift_location[] locations);

    /// <summary>Where count points lie, exactly, to locations, and in which period, to shifts.</summary>
    [DllImport(Library)] public static extern uint deldrift_locate_in_period(IntPtr t, double[] positions, UIntPtr count, ref deldrift_location hint, deldrift_location[] locations, long[] shifts);

    /// <summary>The vertex nearest to a point, to *vertex.</summary>
    [DllImport(Library)] public static extern uint deldrift_nearest_vertex(IntPtr t, double[] position, ref uint vertex);

    /// <summary>The vertex that represents this one in cells, to *representative.</summary>
    [DllImport(Library)] public static extern uint deldrift_coincident_representative(IntPtr t, uint vertex, ref uint representative);

    /// <summary>The vertices that are hidden by place, ascending, each with the one that represents it.</summary>
    [DllImport(Library)] public static extern uint deldrift_hidden_vertices(IntPtr t, uint[] vertices, uint[] representatives, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The k vertices nearest to each of count positions: rows of k ids, by distance.</summary>
    [DllImport(Library)] public static extern uint deldrift_nearest_vertices(IntPtr t, double[] positions, UIntPtr count, UIntPtr k, uint[] vertices);

    /// <summary>The vertices in a closed ball, ascending by id, hidden ones included.</summary>
    [DllImport(Library)] public static extern uint deldrift_vertices_in_ball(IntPtr t, double[] centre, double squared_radius, uint[] vertices, UIntPtr capacity, ref UIntPtr count);

    /// <summary>For each vertex the others that are near it, all in one call: the neighbour lists of particle
    /// codes.</summary>
    [DllImport(Library)] public static extern uint deldrift_neighbour_lists(IntPtr t, double[] squared_radii, UIntPtr radius_count, byte[] mask, UIntPtr mask_count, uint pairs, UIntPtr[] offsets, UIntPtr offset_count, uint[] neighbours, long[] shifts, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The vertices in a closed box, ascending by id, hidden ones included.</summary>
    [DllImport(Library)] public static extern uint deldrift_vertices_in_box(IntPtr t, double[] low, double[] high, uint[] vertices, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The cells that the insertion of a vertex at a position would remove, in no particular
    /// order.</summary>
    [DllImport(Library)] public static extern uint deldrift_conflicts(IntPtr t, double[] position, ref deldrift_location hint, uint[] cells, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The cells that a vertex at a place in one of some boxes could change.</summary>
    [DllImport(Library)] public static extern uint deldrift_cells_in_reach(IntPtr t, double[] low, double[] high, UIntPtr box_count, byte[] mask, UIntPtr mask_count, uint[] cells, double[] centres, double[] radii, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The facets of the convex hull that a place in one of some boxes is strictly beyond,
    /// exactly.</summary>
    [DllImport(Library)] public static extern uint deldrift_hull_facets_in_reach(IntPtr t, double[] low, double[] high, UIntPtr box_count, byte[] mask, UIntPtr mask_count, uint[] cells, byte[] corners, UIntPtr capacity, ref UIntPtr count);

    /// <summary>For each of some boxes the vertices of the cells and hull facets in its reach.</summary>
    [DllImport(Library)] public static extern uint deldrift_vertices_in_reach(IntPtr t, double[] low, double[] high, UIntPtr box_count, byte[] mask, UIntPtr mask_count, uint[] vertices, UIntPtr[] offsets, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The edges: rows of two vertex ids, the lower one first, each edge once, in lexicographic
    /// order.</summary>
    [DllImport(Library)] public static extern uint deldrift_edges(IntPtr t, uint[] edges, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The neighbours of all vertices: for each id the vertices with which it shares an edge, ascending, one
    /// list after the other.</summary>
    [DllImport(Library)] public static extern uint deldrift_vertex_neighbours(IntPtr t, uint[] offsets, UIntPtr offset_count, uint[] neighbours, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The cells of all vertices: for each id the indices of the cells that have it as a corner, ascending,
    /// one list after the other.</summary>
    [DllImport(Library)] public static extern uint deldrift_vertex_cells(IntPtr t, uint[] offsets, UIntPtr offset_count, uint[] cells, UIntPtr capacity, ref UIntPtr count);

    /// <summary>A cell of each vertex: for each id the index of the first cell of which the vertex is a
    /// corner.</summary>
    [DllImport(Library)] public static extern uint deldrift_cell_of_each_vertex(IntPtr t, uint[] cells, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Cells that have given vertices as corners: for each of count simplices the index of one,
    /// DELDRIFT_NONE if there is none.</summary>
    [DllImport(Library)] public static extern uint deldrift_find_simplices(IntPtr t, uint corners_per_simplex, uint[] vertices, UIntPtr count, uint[] cells);

    /// <summary>The mirror indices of all facets, in the order of deldrift_cells.</summary>
    [DllImport(Library)] public static extern uint deldrift_mirror_indices(IntPtr t, byte[] mirrors, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The mirror index of one facet, to *mirror: the corner of the neighbour beyond that is opposite the
    /// same facet, DELDRIFT_NONE on the hull.</summary>
    [DllImport(Library)] public static extern uint deldrift_mirror_index(IntPtr t, uint cell, uint corner, ref uint mirror);

    /// <summary>The star of a vertex of the plane, counter-clockwise: the indices of the cells that have it as a
    /// corner.</summary>
    [DllImport(Library)] public static extern uint deldrift_ordered_star(IntPtr t, uint vertex, uint[] cells, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Interpolates values of the vertices at count positions.</summary>
    [DllImport(Library)] public static extern uint deldrift_interpolate(IntPtr t, uint method, double[] values, UIntPtr value_count, UIntPtr n_values, double[] positions, UIntPtr count, ref deldrift_location hint, double[] outside, double[] results);

    /// <summary>The barycentric coordinates of count positions, each in a cell that is given: rows of 3 (2D) or 4
    /// (3D) numbers, one for each corner in the order of deldrift_cells.</summary>
    [DllImport(Library)] public static extern uint deldrift_barycentric(IntPtr t, double[] positions, uint[] cells, UIntPtr count, double[] weights);

    /// <summary>The circumcentres and squared circumradii of all cells, in the order of deldrift_cells.</summary>
    [DllImport(Library)] public static extern uint deldrift_circumcentres(IntPtr t, double[] centres, double[] squared_radii, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The areas (2D) or volumes (3D) of all cells, in the order of deldrift_cells.</summary>
    [DllImport(Library)] public static extern uint deldrift_volumes(IntPtr t, double[] volumes, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Which cells have a circumradius of at most a given one, as for an alpha shape, in the order of
    /// deldrift_cells.</summary>
    [DllImport(Library)] public static extern uint deldrift_mask_by_circumradius(IntPtr t, double squared_radius, byte[] mask, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Which cells are more than what the rounding of a straight or flat side has made, in the order of
    /// deldrift_cells.</summary>
    [DllImport(Library)] public static extern uint deldrift_mask_without_flat_cells(IntPtr t, double tolerance, byte[] mask, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The boundary of some of the cells: the facets between a cell in a mask and one that is not in it, or
    /// the outside.</summary>
    [DllImport(Library)] public static extern uint deldrift_mask_boundary(IntPtr t, byte[] mask, UIntPtr mask_count, uint[] facets, uint[] cells, byte[] corners, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The facets of the convex hull, in ascending order of cell and then of corner.</summary>
    [DllImport(Library)] public static extern uint deldrift_hull_facets(IntPtr t, uint[] facets, uint[] cells, byte[] corners, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The cells around some vertices: those that have at least one of the vertices as a corner, ascending,
    /// each once.</summary>
    [DllImport(Library)] public static extern uint deldrift_cells_around(IntPtr t, uint[] vertices, UIntPtr vertex_count, uint[] cells, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Computes circumcentres and squared circumradii of some cells again, in arrays that
    /// deldrift_circumcentres has filled.</summary>
    [DllImport(Library)] public static extern uint deldrift_update_circumcentres(IntPtr t, uint[] cells, UIntPtr cell_count, double[] centres, double[] squared_radii, UIntPtr capacity);

    /// <summary>Computes the areas (2D) or volumes (3D) of some cells again, in an array that deldrift_volumes has
    /// filled.</summary>
    [DllImport(Library)] public static extern uint deldrift_update_volumes(IntPtr t, uint[] cells, UIntPtr cell_count, double[] volumes, UIntPtr capacity);

    /// <summary>Decides for some cells again whether their circumradius is at most a given one, in a mask that
    /// deldrift_mask_by_circumradius has filled for the same one.</summary>
    [DllImport(Library)] public static extern uint deldrift_update_mask_by_circumradius(IntPtr t, uint[] cells, UIntPtr cell_count, double squared_radius, byte[] mask, UIntPtr capacity);

    /// <summary>The orientation of points, exactly, to *sign: 1, -1 or 0.</summary>
    [DllImport(Library)] public static extern uint deldrift_orientation(uint dimension, double[] points, ref int sign);

    /// <summary>Whether a point is inside the circle or sphere through others, exactly, to *sign: 1 inside, -1
    /// outside, 0 on it.</summary>
    [DllImport(Library)] public static extern uint deldrift_in_sphere(uint dimension, double[] points, ref int sign);

    /// <summary>Whether a point with a weight is inside the power circle or power sphere of others, exactly, to
    /// *sign: 1 inside, -1 outside, 0 on it.</summary>
    [DllImport(Library)] public static extern uint deldrift_in_power_sphere(uint dimension, double[] points, double[] weights, ref int sign);

    /// <summary>The areas (2D) or volumes (3D) of the Voronoi cells of all ids, within a box.</summary>
    [DllImport(Library)] public static extern uint deldrift_voronoi_volumes(IntPtr t, double[] low, double[] high, double[] volumes, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The lengths (2D) or areas (3D) of the Voronoi facets of all edges, in the order of deldrift_edges,
    /// within a box.</summary>
    [DllImport(Library)] public static extern uint deldrift_voronoi_facets(IntPtr t, double[] low, double[] high, double[] measures, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The Voronoi cells of all ids within a box: areas (2D) or volumes (3D), boundaries and
    /// centroids.</summary>
    [DllImport(Library)] public static extern uint deldrift_voronoi_cells(IntPtr t, double[] low, double[] high, byte[] mask, UIntPtr mask_count, double[] volumes, double[] areas, double[] centroids, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The Voronoi cells of all ids within a box and half-spaces, as deldrift_voronoi_cells has them within
    /// a box.</summary>
    [DllImport(Library)] public static extern uint deldrift_voronoi_cells_within(IntPtr t, double[] low, double[] high, double[] half_spaces, UIntPtr half_space_count, byte[] mask, UIntPtr mask_count, double[] volumes, double[] areas, double[] centroids, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The Voronoi facets of all edges within a box, in the order of deldrift_edges: lengths (2D) or areas
    /// (3D), centroids, and the derivatives of the areas or volumes on their sides by positions.</summary>
    [DllImport(Library)] public static extern uint deldrift_voronoi_derivatives(IntPtr t, double[] low, double[] high, byte[] mask, UIntPtr mask_count, double[] measures, double[] centroids, double[] derivatives, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The Voronoi facets of all edges within a box and half-spaces, with derivatives, as
    /// deldrift_voronoi_derivatives has them within a box.</summary>
    [DllImport(Library)] public static extern uint deldrift_voronoi_derivatives_within(IntPtr t, double[] low, double[] high, double[] half_spaces, UIntPtr half_space_count, byte[] mask, UIntPtr mask_count, double[] measures, double[] centroids, double[] derivatives, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Voronoi cells and facets in one call.</summary>
    [DllImport(Library)] public static extern uint deldrift_voronoi_cells_and_facets(IntPtr t, double[] low, double[] high, double[] half_spaces, UIntPtr half_space_count, byte[] mask, UIntPtr mask_count, double[] volumes, double[] areas, double[] centroids, UIntPtr capacity, ref UIntPtr count, double[] measures, double[] facet_centroids, double[] derivatives, UIntPtr edge_capacity, ref UIntPtr edge_count);

    /// <summary>Areas (2D) or volumes (3D) of Voronoi cells, and their derivatives by weights, in one call: what
    /// Newton's method needs that looks for weights for which cells have prescribed areas or volumes, as in semi-
    /// discrete optimal transport.</summary>
    [DllImport(Library)] public static extern uint deldrift_voronoi_weight_derivatives(IntPtr t, double[] low, double[] high, double[] half_spaces, UIntPtr half_space_count, byte[] mask, UIntPtr mask_count, double[] volumes, UIntPtr capacity, ref UIntPtr count, double[] weight_derivatives, UIntPtr edge_capacity, ref UIntPtr edge_count);

    /// <summary>Marks the vertices whose Voronoi cell has changed, or may have.</summary>
    [DllImport(Library)] public static extern uint deldrift_voronoi_changed(IntPtr t, uint[] vertices, UIntPtr vertex_count, byte[] mask, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Creates the regular triangulation of count points with weights in the plane or in space, at timestamp
    /// 0: the weighted Delaunay triangulation, which is the dual of the power diagram.</summary>
    [DllImport(Library)] public static extern uint deldrift_create_weighted(uint dimension, double[] positions, double[] weights, ulong[] keys, UIntPtr count, ref deldrift_options options, out IntPtr @out);

    /// <summary>Whether the triangulation has weights, to *weighted.</summary>
    [DllImport(Library)] public static extern uint deldrift_is_weighted(IntPtr t, ref byte weighted);

    /// <summary>The weights of all ids, in their order: those of the current timestamp, or those that vertices whose
    /// insertion is staged will have.</summary>
    [DllImport(Library)] public static extern uint deldrift_weights(IntPtr t, double[] weights, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Stages other weights of count vertices for the next timestamp: all of them, or none if it
    /// fails.</summary>
    [DllImport(Library)] public static extern uint deldrift_stage_weights(IntPtr t, uint[] vertices, double[] weights, UIntPtr count);

    /// <summary>Moves all vertices, gives all other weights, or both, and makes that the next timestamp:
    /// deldrift_commit_positions for vertices with weights.</summary>
    [DllImport(Library)] public static extern uint deldrift_commit_weighted(IntPtr t, double[] positions, double[] weights, UIntPtr count, ref deldrift_commit_report report);

    /// <summary>Stages the insertion of count vertices with weights, as deldrift_stage_insertions does of vertices of
    /// weight 0: all of them, or none if it fails.</summary>
    [DllImport(Library)] public static extern uint deldrift_stage_insertions_with_weights(IntPtr t, double[] positions, double[] weights, UIntPtr count, ref uint first_vertex);

    /// <summary>Inserts a vertex with a weight at once, as deldrift_insert_vertex does one of weight 0.
    /// deldrift_take_changes, called before and after, tells whom it has hidden; it may be hidden itself.</summary>
    [DllImport(Library)] public static extern uint deldrift_insert_vertex_with_weight(IntPtr t, double[] position, double weight, ref uint out_vertex);

    /// <summary>Gives one vertex another weight at once, whatever is staged for others; it stays where it
    /// is.</summary>
    [DllImport(Library)] public static extern uint deldrift_set_weight(IntPtr t, uint vertex, double weight);

    /// <summary>The vertices that are hidden by weight, ascending, each with the cell that it is above: at its place
    /// the power sphere of this cell says that it is hidden.</summary>
    [DllImport(Library)] public static extern uint deldrift_hidden_by_weight(IntPtr t, uint[] vertices, uint[] cells, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Stages segments between vertices: all of them, or none if it fails.</summary>
    [DllImport(Library)] public static extern uint deldrift_stage_segments(IntPtr t, uint[] ends, int[] markers, UIntPtr count, ref uint first_segment);

    /// <summary>Stages the removal of segments: all of them, or none if it fails.</summary>
    [DllImport(Library)] public static extern uint deldrift_stage_segment_removals(IntPtr t, uint[] segments, UIntPtr count);

    /// <summary>The segments in force, ascending by id.</summary>
    [DllImport(Library)] public static extern uint deldrift_segments(IntPtr t, uint[] segments, uint[] ends, int[] markers, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Whether a commit of what is staged would be refused because of segments.</summary>
    [DllImport(Library)] public static extern uint deldrift_check_staged(IntPtr t);

    /// <summary>The conflicts for which the latest call that changes or checks t was refused, in ascending order of
    /// kind, segment and other.</summary>
    [DllImport(Library)] public static extern uint deldrift_segment_conflicts(IntPtr t, deldrift_conflict[] conflicts, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Whether vertices would pass segments in a commit of what is staged, whatever the options say of
    /// passings.</summary>
    [DllImport(Library)] public static extern uint deldrift_check_passings(IntPtr t);

    /// <summary>The vertices that pass segments in the step that the latest call has looked at, in ascending order of
    /// segment and vertex.</summary>
    [DllImport(Library)] public static extern uint deldrift_passings(IntPtr t, uint[] segments, uint[] vertices, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Splits segments, staged ones and those in force, for which a commit of what is staged would be
    /// refused.</summary>
    [DllImport(Library)] public static extern uint deldrift_stage_splits(IntPtr t, UIntPtr limit, ref deldrift_split_report report);

    /// <summary>The segments at the edges of each cell, in the order of deldrift_cells: entry i of a row is the
    /// segment at the edge opposite corner i.</summary>
    [DllImport(Library)] public static extern uint deldrift_segments_of_cells(IntPtr t, uint[] segments, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The cells on both sides of each segment in force, in the order of deldrift_segments.</summary>
    [DllImport(Library)] public static extern uint deldrift_cells_of_segments(IntPtr t, uint[] cells, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The nesting level of each cell, in the order of deldrift_cells: the least number of edges with
    /// segments on a path from the cell to the outside.</summary>
    [DllImport(Library)] public static extern uint deldrift_nesting_levels(IntPtr t, uint[] levels, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The crossing number of each cell, in the order of deldrift_cells: the least number of segments on a
    /// path from the cell to the outside, where each segment at an edge counts.</summary>
    [DllImport(Library)] public static extern uint deldrift_crossing_numbers(IntPtr t, uint[] numbers, UIntPtr capacity, ref UIntPtr count);

    /// <summary>A label for each cell, in the order of deldrift_cells: the label of the first seed in its
    /// region.</summary>
    [DllImport(Library)] public static extern uint deldrift_label_cells(IntPtr t, double[] seeds, int[] labels, UIntPtr seed_count, int other, int[] label_of, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Computes the labels of some cells again, in an array that deldrift_label_cells has filled, or that is
    /// filled with nesting levels.</summary>
    [DllImport(Library)] public static extern uint deldrift_update_labels(IntPtr t, uint[] cells, UIntPtr cell_count, int other, int[] label_of, UIntPtr capacity, ref UIntPtr undecided);

    /// <summary>The boundary of some of the cells of the plane, in closed chains of edges, which have these cells on
    /// their left.</summary>
    [DllImport(Library)] public static extern uint deldrift_boundary_chains(IntPtr t, byte[] mask, UIntPtr mask_count, uint[] vertices, uint[] chains, uint[] segments, uint[] cells, byte[] corners, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Gives regions labels that follow them.</summary>
    [DllImport(Library)] public static extern uint deldrift_set_regions(IntPtr t, int[] labels, UIntPtr label_count);

    /// <summary>Gives labels to the sides of segments; deldrift_set_regions does so for all of them, by labels of
    /// cells.</summary>
    [DllImport(Library)] public static extern uint deldrift_set_segment_sides(IntPtr t, uint[] segments, int[] sides, UIntPtr count);

    /// <summary>The label of the region of each cell, in the order of deldrift_cells.</summary>
    [DllImport(Library)] public static extern uint deldrift_regions(IntPtr t, int other, int[] labels, UIntPtr capacity, ref UIntPtr count, ref UIntPtr undecided);

    /// <summary>Sets a quality to the defaults: no criterion.</summary>
    [DllImport(Library)] public static extern uint deldrift_quality_init(ref deldrift_quality quality);

    /// <summary>Inserts vertices into cells of the plane, and on segments at these, until the cells there are of a
    /// quality.</summary>
    [DllImport(Library)] public static extern uint deldrift_refine(IntPtr t, ref deldrift_quality quality, byte[] mask, UIntPtr mask_count, ref deldrift_quality_report report);

    /// <summary>Removes vertices that deldrift_refine has inserted and that are not needed any more.</summary>
    [DllImport(Library)] public static extern uint deldrift_coarsen(IntPtr t, ref deldrift_quality quality, byte[] mask, UIntPtr mask_count, ref deldrift_quality_report report);

    /// <summary>The vertices that deldrift_refine has inserted and that are present, ascending by id.</summary>
    [DllImport(Library)] public static extern uint deldrift_made_vertices(IntPtr t, uint[] vertices, uint[] segments, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The original of each segment in force, in the order of deldrift_segments.</summary>
    [DllImport(Library)] public static extern uint deldrift_original_segments(IntPtr t, uint[] originals, UIntPtr capacity, ref UIntPtr count);

    /// <summary>How linear values at the vertices that the last deldrift_refine inserted, in the order of their ids,
    /// follow from those at the vertices before.</summary>
    [DllImport(Library)] public static extern uint deldrift_refined_weights(IntPtr t, uint[] vertices, double[] weights, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The sizes of the vertices that the last deldrift_refine inserted, in the order of their ids: the
    /// greatest length of edges that it had there, from those given in quality.sizes at the vertices
    /// before.</summary>
    [DllImport(Library)] public static extern uint deldrift_refined_sizes(IntPtr t, double[] sizes, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The vertices that the last deldrift_refine inserted, ascending by id. deldrift_refined_weights and
    /// deldrift_refined_sizes are in this order.</summary>
    [DllImport(Library)] public static extern uint deldrift_refined_vertices(IntPtr t, uint[] vertices, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Creates the Delaunay triangulation of points that repeat.</summary>
    [DllImport(Library)] public static extern uint deldrift_create_periodic(uint dimension, double[] positions, UIntPtr count, double[] vectors, UIntPtr vector_count, ref deldrift_options options, out IntPtr @out);

    /// <summary>Creates the regular triangulation of points with weights that repeat: deldrift_create_periodic for
    /// vertices with weights, as deldrift_create_weighted has them.</summary>
    [DllImport(Library)] public static extern uint deldrift_create_periodic_weighted(uint dimension, double[] positions, double[] weights, UIntPtr count, double[] vectors, UIntPtr vector_count, ref deldrift_options options, out IntPtr @out);

    /// <summary>Stages other vectors for the box: strain, shear, or others of the same lattice.</summary>
    [DllImport(Library)] public static extern uint deldrift_stage_vectors(IntPtr t, double[] vectors, UIntPtr vector_count);

    /// <summary>The vectors by which the triangulation repeats: those that were given, on the grid of
    /// deldrift_create_periodic.</summary>
    [DllImport(Library)] public static extern uint deldrift_vectors(IntPtr t, double[] vectors, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The shortest vectors of the lattice, a reduced basis of it. deldrift_wrap_positions translates by
    /// them.</summary>
    [DllImport(Library)] public static extern uint deldrift_reduced_vectors(IntPtr t, double[] vectors, long[] multiples, uint[] greatest, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Takes positions into the box, each to its place in the unit cell of deldrift_reduced_vectors, on the
    /// grid of deldrift_create_periodic.</summary>
    [DllImport(Library)] public static extern uint deldrift_wrap_positions(IntPtr t, double[] positions, double[] previous, UIntPtr count, double[] places, long[] shifts);

    /// <summary>In which period each corner of each cell is, and each neighbour.</summary>
    [DllImport(Library)] public static extern uint deldrift_cell_shifts(IntPtr t, long[] shifts, long[] neighbour_shifts, UIntPtr capacity, ref UIntPtr count);

    /// <summary>In which period the second vertex of each edge is, in the order of deldrift_edges.</summary>
    [DllImport(Library)] public static extern uint deldrift_edge_shifts(IntPtr t, long[] shifts, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Makes an independent copy of the triangulation, to *out.</summary>
    [DllImport(Library)] public static extern uint deldrift_clone(IntPtr t, out IntPtr @out);

    /// <summary>Saves the triangulation: writes bytes from which deldrift_load makes one like it, on this machine or
    /// any other.</summary>
    [DllImport(Library)] public static extern uint deldrift_save(IntPtr t, IntPtr buffer, UIntPtr capacity, ref UIntPtr count);

    /// <summary>Makes a triangulation of bytes that deldrift_save has written, to *out.</summary>
    [DllImport(Library)] public static extern uint deldrift_load(IntPtr data, UIntPtr size, ref deldrift_options options, out IntPtr @out);

    /// <summary>Saves the triangulation to a file, as deldrift_save does.</summary>
    [DllImport(Library)] public static extern uint deldrift_save_file(IntPtr t, string path);

    /// <summary>Makes a triangulation of a file that deldrift_save_file has written, to *out, as deldrift_load
    /// does.</summary>
    [DllImport(Library)] public static extern uint deldrift_load_file(string path, ref deldrift_options options, out IntPtr @out);

    /// <summary>Writes a file for ParaView and VTK: an unstructured grid of the cells, in VTK's XML format
    /// (.vtu).</summary>
    [DllImport(Library)] public static extern uint deldrift_write_vtu(IntPtr t, string path, deldrift_field[] vertex_fields, UIntPtr vertex_field_count, deldrift_field[] cell_fields, UIntPtr cell_field_count);

    /// <summary>Writes a file for Mmg, FreeFem, Gmsh and others:</summary>
    [DllImport(Library)] public static extern uint deldrift_write_medit(IntPtr t, string path, int[] references, UIntPtr reference_count);

    /// <summary>Changes the algorithm of later commits to one of research, until deldrift_set_algorithm chooses
    /// another.</summary>
    [DllImport(Library)] public static extern uint deldrift_research_set_algorithm(IntPtr t, uint algorithm, ref deldrift_research_options options);

    /// <summary>How many vertices all commits together have found to be certainly within their safe region, of those
    /// that were not within their tolerance or whose tolerance was not tested, to *count.</summary>
    [DllImport(Library)] public static extern uint deldrift_research_within_safe_region(IntPtr t, ref ulong count);

    /// <summary>The annulus widths of all bi-cells: entry i of the row of a cell, in the order of deldrift_cells, is
    /// that of the bi-cell at the facet opposite corner i.</summary>
    [DllImport(Library)] public static extern uint deldrift_research_annulus_widths(IntPtr t, double[] widths, UIntPtr capacity, ref UIntPtr count);

    /// <summary>The standard delimiter of a bi-cell: the circle or sphere in the middle of its annulus, see
    /// deldrift_research_annulus_widths, which has the vertices of the facet inside and the two opposite it
    /// outside.</summary>
    [DllImport(Library)] public static extern uint deldrift_research_standard_delimiter(IntPtr t, uint cell, uint corner, double[] centre, ref double radius, ref double tolerance);

    /// <summary>The message of the last call on this thread that failed.</summary>
    public static string Message() => Marshal.PtrToStringAnsi(deldrift_last_error());
}
