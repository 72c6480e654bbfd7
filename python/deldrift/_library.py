"""The C library: where it is, its structures, and its functions as ctypes calls them.

ctypes releases the GIL during each call. Pointers are passed as addresses, None being NULL.
"""

from __future__ import annotations

import ctypes
import os
import sys
from ctypes import POINTER, c_bool, c_char_p, c_double, c_int, c_int32, c_size_t, c_ubyte, c_uint32, c_uint64, c_void_p
from typing import Any

NONE = 0xFFFFFFFF
"""DELDRIFT_NONE: no cell, no vertex. Arrays that are seen as int32 have -1."""

ALGORITHMS = ("auto", "rebuilding", "placement_flips", "tolerance", "repair")
COINCIDENCES = ("merge", "reject")
PASSINGS = ("ignore", "tell", "refuse")
INTERPOLATIONS = ("linear", "natural")
KEPT = ("none", "outer", "all")
DOMAINS = ("nesting", "even-odd", "inside", "regions")
NO_LABEL = -(2**31)
"""DELDRIFT_NO_LABEL: a side of a segment has no label."""
NO_LIMIT = 2 * sys.maxsize + 1
"""SIZE_MAX."""
FIRST_CONFLICT = 30
"""DELDRIFT_CROSSING: the statuses from it on stand for kinds of conflicts, in their order."""
PASSES_SEGMENT = 35
"""DELDRIFT_PASSES_SEGMENT."""
NOT_PREPARED = 37
"""DELDRIFT_NOT_PREPARED."""

CancelCallback = ctypes.CFUNCTYPE(c_ubyte, c_void_p)
ProgressCallback = ctypes.CFUNCTYPE(None, c_void_p, c_double)
# Its user data are an object of Python's, but on PyPy, whose ctypes hands over none.
TooLargeCallback = ctypes.CFUNCTYPE(
    c_int, c_void_p if sys.implementation.name == "pypy" else ctypes.py_object, c_void_p
)


class Options(ctypes.Structure):
    """deldrift_options."""

    _fields_ = [
        ("struct_size", c_size_t),
        ("algorithm", c_uint32),
        ("threads", c_uint32),
        ("coincidence", c_uint32),
        ("passing", c_uint32),
        ("parts", c_size_t),
        ("cancel", CancelCallback),
        ("progress", ProgressCallback),
        ("user_data", c_void_p),
    ]


class Counts(ctypes.Structure):
    """Counts of the library, by name."""

    def as_dict(self) -> dict[str, int]:
        """The counts by name."""
        return {name: getattr(self, name) for name, *_ in self._fields_ if name != "_reserved"}

    def __repr__(self) -> str:
        return f"{type(self).__name__}(" + ", ".join(f"{name}={count}" for name, count in self.as_dict().items()) + ")"


class Report(Counts):
    """What a commit did, or all of them.

    Attributes
    ----------
    timestamp : int
        Number of the timestamp reached: 0 at creation, one more at each commit.
    moved : int
        Vertices whose position differs from that of the timestamp before.
    unchanged : int
        Moved vertices for which nothing but coordinates changed.
    placements : int
        Vertices removed and inserted again.
    flips : int
        Flips made.
    rebuilds : int
        1 if the triangulation was rebuilt; in `Delaunay.statistics` how often.
    coincident : int
        Vertices hidden by place at the end: those at the place of a vertex with a lower id, or greater weight.
    within_tolerance : int
        Vertices that were certainly within their tolerance, with an algorithm that tests it.
    tolerances : int
        Bi-cells whose tolerance was computed.
    certificates : int
        Orientations and in-sphere tests of the stars of relocated vertices.
    exact_calls : int
        Signs that floating-point filters left to exact arithmetic.
    inserted, removed : int
        Vertices inserted and removed.
    reweighted : int
        Vertices of `Regular` whose weight differs from that of the timestamp before.
    hidden_by_weight : int
        Vertices hidden by weight at the end; `Regular.hidden_by_weight` lists them.
    newly_hidden : int
        Vertices of `Regular` that are hidden at the end, by weight or by place, and were not.
    newly_shown : int
        Vertices of `Regular` that were hidden, and are there at the end and not hidden.
    """

    timestamp: int
    moved: int
    unchanged: int
    placements: int
    flips: int
    rebuilds: int
    coincident: int
    within_tolerance: int
    tolerances: int
    certificates: int
    exact_calls: int
    inserted: int
    removed: int
    reweighted: int
    hidden_by_weight: int
    newly_hidden: int
    newly_shown: int

    _fields_ = [
        (name, c_uint64)
        for name in (
            "timestamp moved unchanged placements flips rebuilds coincident within_tolerance tolerances certificates "
            "exact_calls inserted removed reweighted hidden_by_weight newly_hidden newly_shown"
        ).split()
    ] + [("_reserved", c_uint64 * 3)]


class Quality(ctypes.Structure):
    """deldrift_quality."""

    _fields_ = [
        ("struct_size", c_size_t),
        ("least_angle", c_double),
        ("greatest_area", c_double),
        ("labels", c_void_p),
        ("label_count", c_size_t),
        ("areas", c_void_p),
        ("area_count", c_size_t),
        ("sizes", c_void_p),
        ("size_count", c_size_t),
        ("is_too_large", TooLargeCallback),
        ("user_data", c_void_p),
        ("keeps", c_uint32),
        ("has_weights", c_uint32),
        ("is_conforming", c_uint32),
        ("limit", c_size_t),
        ("margin", c_double),
        ("share", c_double),
        ("joins", c_double),
        ("growth", c_double),
        ("reuses_ids", c_uint32),
        ("domain", c_uint32),
    ]


class QualityReport(Counts):
    """What `refine` or `coarsen` did.

    Attributes
    ----------
    inserted : int
        Vertices inserted. Their ids are the last ones.
    on_segments : int
        How many of them are on segments.
    removed : int
        Vertices removed.
    replaced_segments : int
        Segments removed, as pieces took the place of one, or one that of pieces.
    new_segments : int
        Segments that came. Their ids are the last ones that have been given.
    unsplit : int
        Pieces that had to be split and are whole, as there is no room for a vertex between their ends.
    bad_cells : int
        Simplices that are still bad, of those that were to be refined.
    is_cut_short : int
        1 if the limit was reached, otherwise 0.
    values : ndarray, dict of ndarray or None
        The values that `refine` was given, by the ids that there are now.
    sizes : ndarray or None
        The sizes that `refine` was given, by the ids that there are now, with those that it had for the new vertices. With
        these a second call finds nothing to do.
    """

    inserted: int
    on_segments: int
    removed: int
    replaced_segments: int
    new_segments: int
    unsplit: int
    bad_cells: int
    is_cut_short: int
    values: Any = None
    sizes: Any = None

    _fields_ = [
        (name, c_uint64)
        for name in (
            "inserted on_segments removed replaced_segments new_segments unsplit bad_cells is_cut_short"
        ).split()
    ] + [("_reserved", c_uint64 * 4)]


class SplitReport(ctypes.Structure):
    """deldrift_split_report."""

    _fields_ = [
        ("inserted", c_uint64),
        ("replaced_segments", c_uint64),
        ("pieces", c_uint64),
        ("rounds", c_uint64),
        ("first_vertex", c_uint32),
        ("first_piece", c_uint32),
        ("reserved", c_uint64 * 3),
    ]


class ChangesView(ctypes.Structure):
    """deldrift_changes."""

    _fields_ = [
        ("created_count", c_size_t),
        ("created", c_void_p),
        ("removed_count", c_size_t),
        ("removed", c_void_p),
        ("removed_vertices", c_void_p),
        ("renumbered_count", c_size_t),
        ("renumbered_from", c_void_p),
        ("renumbered_to", c_void_p),
        ("star_count", c_size_t),
        ("stars", c_void_p),
        ("hidden_count", c_size_t),
        ("hidden", c_void_p),
        ("shown_count", c_size_t),
        ("shown", c_void_p),
        ("reserved", c_size_t * 4),
    ]


class TransferReport(ctypes.Structure):
    """deldrift_transfer_report."""

    _fields_ = [
        *((name, c_uint64) for name in ("gone", "arrived", "overlaps", "turned_over", "uncovered")),
        ("reserved", c_uint64 * 3),
        *((name, c_double) for name in ("lost_volume", "gained_volume", "volume_error")),
        ("reserved_numbers", c_double * 3),
    ]


class CellsView(ctypes.Structure):
    """deldrift_cells_view."""

    _fields_ = [
        ("count", c_size_t),
        ("corners_per_cell", c_uint32),
        ("vertices", c_void_p),
        ("neighbours", c_void_p),
    ]


class Field(ctypes.Structure):
    """deldrift_field."""

    _fields_ = [("name", c_char_p), ("values", c_void_p), ("components", c_size_t)]


# Arrays are addresses; T is a triangulation, N a count or a capacity, C the count that a function tells.
T = A = c_void_p
N = c_size_t
C = POINTER(c_size_t)
U32, F64 = c_uint32, c_double

PROTOTYPES = {
    "create": (U32, A, N, POINTER(Options), POINTER(T)),
    "dimension": (T, POINTER(U32)),
    "set_algorithm": (T, U32),
    "get_algorithm": (T, POINTER(U32)),
    "move_vertices": (T, A, A, N),
    "stage_insertions": (T, A, N, POINTER(U32)),
    "stage_removals": (T, A, N),
    "discard_moves": (T,),
    "commit_timestamp": (T, POINTER(Report)),
    "prepare_timestamp": (T, POINTER(Report)),
    "publish_timestamp": (T,),
    "withdraw_timestamp": (T,),
    "commit_positions": (T, A, N, POINTER(Report)),
    "relocate_vertex": (T, U32, A),
    "insert_vertex": (T, A, POINTER(U32)),
    "create_with_keys": (U32, A, A, N, POINTER(Options), POINTER(T)),
    "stage_insertions_with_keys": (T, A, A, N, POINTER(U32)),
    "stage_insertions_at_free_ids": (T, A, A, N, A),
    "insert_vertex_with_key": (T, A, c_uint64, POINTER(U32)),
    "keys": (T, A, N, C),
    "remove_vertex": (T, U32),
    "compact": (T, A, N, C),
    "take_changes": (T, POINTER(ChangesView)),
    "transfer_cells": (T, A, N, U32, A, N, N, N, POINTER(TransferReport), A, A),
    "vertex_count": (T, C),
    "id_count": (T, C),
    "cell_count": (T, C),
    "staged_count": (T, C),
    "memory_bytes": (T, C),
    "timestamp": (T, POINTER(c_uint64)),
    "statistics": (T, POINTER(Report)),
    "is_present": (T, U32, POINTER(c_bool)),
    "copy_positions": (T, A, N, C),
    "cells": (T, POINTER(CellsView)),
    "copy_cells": (T, A, A, N, C),
    "star": (T, U32, A, N, C),
    "tolerance": (T, U32, POINTER(F64)),
    "validate": (T, U32),
    "locate_points": (T, A, N, A, A),
    "locate_in_period": (T, A, N, A, A, A),
    "release_cells": (T, POINTER(CellsView), POINTER(T)),
    "nearest_vertices": (T, A, N, N, A),
    "vertices_in_ball": (T, A, F64, A, N, C),
    "vertices_in_box": (T, A, A, A, N, C),
    "neighbour_lists": (T, A, N, A, N, U32, A, N, A, A, N, C),
    "conflicts": (T, A, A, A, N, C),
    "cells_in_reach": (T, A, A, N, A, N, A, A, A, N, C),
    "hull_facets_in_reach": (T, A, A, N, A, N, A, A, N, C),
    "vertices_in_reach": (T, A, A, N, A, N, A, A, N, C),
    "hidden_vertices": (T, A, A, N, C),
    "cell_of_each_vertex": (T, A, N, C),
    "find_simplices": (T, U32, A, N, A),
    "barycentric": (T, A, A, N, A),
    "mask_without_flat_cells": (T, F64, A, N, C),
    "coincident_representative": (T, U32, POINTER(U32)),
    "circumcentres": (T, A, A, N, C),
    "volumes": (T, A, N, C),
    "mask_by_circumradius": (T, F64, A, N, C),
    "mask_boundary": (T, A, N, A, A, A, N, C),
    "hull_facets": (T, A, A, A, N, C),
    "edges": (T, A, N, C),
    "vertex_neighbours": (T, A, N, A, N, C),
    "vertex_cells": (T, A, N, A, N, C),
    "mirror_indices": (T, A, N, C),
    "ordered_star": (T, U32, A, N, C),
    "cells_around": (T, A, N, A, N, C),
    "stage_segments": (T, A, A, N, POINTER(U32)),
    "stage_segment_removals": (T, A, N),
    "segments": (T, A, A, A, N, C),
    "check_staged": (T,),
    "stage_splits": (T, N, POINTER(SplitReport)),
    "segment_conflicts": (T, A, N, C),
    "check_passings": (T,),
    "passings": (T, A, A, N, C),
    "segments_of_cells": (T, A, N, C),
    "cells_of_segments": (T, A, N, C),
    "nesting_levels": (T, A, N, C),
    "crossing_numbers": (T, A, N, C),
    "label_cells": (T, A, A, N, c_int32, A, N, C),
    "update_labels": (T, A, N, c_int32, A, N, C),
    "set_regions": (T, A, N),
    "set_segment_sides": (T, A, A, N),
    "regions": (T, c_int32, A, N, C, C),
    "boundary_chains": (T, A, N, A, A, A, A, A, N, C),
    "quality_init": (POINTER(Quality),),
    "refine": (T, POINTER(Quality), A, N, POINTER(QualityReport)),
    "coarsen": (T, POINTER(Quality), A, N, POINTER(QualityReport)),
    "made_vertices": (T, A, A, N, C),
    "original_segments": (T, A, N, C),
    "refined_weights": (T, A, A, N, C),
    "refined_sizes": (T, A, N, C),
    "refined_vertices": (T, A, N, C),
    "update_circumcentres": (T, A, N, A, A, N),
    "update_volumes": (T, A, N, A, N),
    "update_mask_by_circumradius": (T, A, N, F64, A, N),
    "create_weighted": (U32, A, A, A, N, POINTER(Options), POINTER(T)),
    "is_weighted": (T, POINTER(c_bool)),
    "weights": (T, A, N, C),
    "stage_weights": (T, A, A, N),
    "commit_weighted": (T, A, A, N, POINTER(Report)),
    "stage_insertions_with_weights": (T, A, A, N, POINTER(U32)),
    "insert_vertex_with_weight": (T, A, F64, POINTER(U32)),
    "set_weight": (T, U32, F64),
    "hidden_by_weight": (T, A, A, N, C),
    "create_periodic": (U32, A, N, A, N, POINTER(Options), POINTER(T)),
    "create_periodic_weighted": (U32, A, A, N, A, N, POINTER(Options), POINTER(T)),
    "stage_vectors": (T, A, N),
    "vectors": (T, A, N, C),
    "reduced_vectors": (T, A, A, A, N, C),
    "wrap_positions": (T, A, A, N, A, A),
    "cell_shifts": (T, A, A, N, C),
    "edge_shifts": (T, A, N, C),
    "voronoi_volumes": (T, A, A, A, N, C),
    "voronoi_facets": (T, A, A, A, N, C),
    "voronoi_changed": (T, A, N, A, N, C),
    "voronoi_cells": (T, A, A, A, N, A, A, A, N, C),
    "voronoi_cells_within": (T, A, A, A, N, A, N, A, A, A, N, C),
    "voronoi_derivatives": (T, A, A, A, N, A, A, A, N, C),
    "voronoi_derivatives_within": (T, A, A, A, N, A, N, A, A, A, N, C),
    "voronoi_weight_derivatives": (T, A, A, A, N, A, N, A, N, C, A, N, C),
    "voronoi_cells_and_facets": (T, A, A, A, N, A, N, A, A, A, N, C, A, A, A, N, C),
    "interpolate": (T, U32, A, N, N, A, N, A, A, A),
    "clone": (T, POINTER(T)),
    "save": (T, A, N, C),
    "load": (A, N, POINTER(Options), POINTER(T)),
    "save_file": (T, c_char_p),
    "load_file": (c_char_p, POINTER(Options), POINTER(T)),
    "write_vtu": (T, c_char_p, POINTER(Field), N, POINTER(Field), N),
    "write_medit": (T, c_char_p, A, N),
    "orientation": (U32, A, POINTER(c_int32)),
    "in_sphere": (U32, A, POINTER(c_int32)),
    "in_power_sphere": (U32, A, A, POINTER(c_int32)),
}


def _find() -> str:
    """The path of the library: that of the environment variable DELDRIFT_LIBRARY, or else the package's own."""
    path = os.environ.get("DELDRIFT_LIBRARY")
    if path:
        return path
    return os.path.join(os.path.dirname(os.path.abspath(__file__)), "libdeldrift.so")


def _load() -> ctypes.CDLL:
    path = _find()
    try:
        loaded = ctypes.CDLL(path)
    except OSError as error:
        raise ImportError(f"deldrift needs its library, {path}, which cannot be loaded: {error}") from error
    for name, arguments in PROTOTYPES.items():
        function = getattr(loaded, "deldrift_" + name)
        function.argtypes = arguments
        function.restype = U32
    loaded.deldrift_destroy.argtypes = loaded.deldrift_free_cells.argtypes = (T,)
    loaded.deldrift_destroy.restype = loaded.deldrift_free_cells.restype = None
    loaded.deldrift_version.argtypes = loaded.deldrift_last_error.argtypes = ()
    loaded.deldrift_version.restype = loaded.deldrift_last_error.restype = c_char_p
    return loaded


_loaded = _load()
destroy = _loaded.deldrift_destroy
free_cells = _loaded.deldrift_free_cells


def function(name: str) -> Any:
    """The function deldrift_NAME."""
    return getattr(_loaded, "deldrift_" + name)


def version() -> str:
    """The version of the library that is running."""
    return str(_loaded.deldrift_version(), "utf-8")


def last_error() -> str:
    """The message of the last call of this thread that failed."""
    return str(_loaded.deldrift_last_error(), "utf-8")
