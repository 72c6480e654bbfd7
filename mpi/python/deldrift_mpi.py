"""deldrift on several processes, for Python: libdeldrift_mpi through ctypes, with communicators of mpi4py.

    from mpi4py import MPI
    from deldrift_mpi import Delaunay

    tri = Delaunay(MPI.COMM_WORLD, points)          # the points of this process
    tri.commit(points + velocity * step)            # collective, all or nothing
    rows = tri.cells()                              # own cells, as global ids

Every cell with an own vertex is exactly one of the triangulation of all vertices; docs/MPI.md has more. The library
is found where the linker finds it, or is what DELDRIFT_MPI_LIBRARY names. It has to be built with the MPI of mpi4py.
"""

from __future__ import annotations

import ctypes
import os
from ctypes import POINTER, byref, c_char_p, c_int, c_size_t, c_uint32, c_uint64, c_void_p
from typing import Any, NamedTuple

import numpy as np
from mpi4py import MPI

__all__ = ["Changes", "Delaunay", "DeldriftMpiError", "Report"]

_Comm = c_void_p if MPI._sizeof(MPI.Comm) == ctypes.sizeof(c_void_p) else c_int


class DeldriftMpiError(RuntimeError):
    """A call that one or more processes refused; nothing has changed on any.

    Attributes
    ----------
    status : int
        The deldrift_status.
    process : int
        The rank of the process that refused, -1 if the call was not collective.
    """

    def __init__(self, status: int, process: int, message: str) -> None:
        super().__init__(message)
        self.status = status
        self.process = process


class Options(ctypes.Structure):
    """deldrift_mpi_options."""

    _fields_ = [("struct_size", c_size_t), ("boxes", c_uint32), ("drop_percent", c_uint32), ("local", c_void_p)]


class Report(ctypes.Structure):
    """deldrift_mpi_report: what a commit, a creation or a migration did on this process."""

    _fields_ = [
        (name, c_uint64)
        for name in (
            "timestamp", "rounds", "received", "sent", "dropped", "halo", "messages", "bytes", "collectives",
            "neighbours", "is_spanning", "is_rebuilt",
        )
    ] + [("_reserved", c_uint64 * 4)]


class Changes(NamedTuple):
    """Own cells that have come and gone."""

    created: np.ndarray
    """Rows of global ids, positively oriented."""
    removed: np.ndarray
    """Rows of global ids, in any order."""
    is_anew: bool
    """Whether all own cells are listed as created, and none as removed: at first, and after a migration."""
    created_shifts: np.ndarray | None
    """By created cell and corner multiples of the vectors, counted from the corner of the least id, and of several with
    that id from that of the least multiples; None where the triangulation is not periodic."""
    removed_shifts: np.ndarray | None
    """Likewise for removed cells: the ids and shifts by which each was told as created."""


class _Changes(ctypes.Structure):
    """deldrift_mpi_changes."""

    _fields_ = [
        ("created_count", c_size_t),
        ("created", c_void_p),
        ("created_cells", c_void_p),
        ("removed_count", c_size_t),
        ("removed", c_void_p),
        ("is_anew", c_size_t),
        ("created_shifts", c_void_p),
        ("removed_shifts", c_void_p),
        ("_reserved", c_size_t * 1),
    ]


def _load() -> ctypes.CDLL:
    library = ctypes.CDLL(os.environ.get("DELDRIFT_MPI_LIBRARY", "libdeldrift_mpi.so.0.1"))
    pointer, size, count = c_void_p, c_size_t, POINTER(c_size_t)
    arguments = {
        "create": [_Comm, c_uint32, pointer, pointer, size, POINTER(Options), POINTER(c_void_p)],
        "create_periodic": [
            _Comm, c_uint32, pointer, pointer, size, pointer, size, POINTER(Options), POINTER(c_void_p)
        ],
        "create_weighted": [_Comm, c_uint32, pointer, pointer, pointer, size, POINTER(Options), POINTER(c_void_p)],
        "create_periodic_weighted": [
            _Comm, c_uint32, pointer, pointer, pointer, size, pointer, size, POINTER(Options), POINTER(c_void_p)
        ],
        "cell_shifts": [pointer, pointer, size, count],
        "periods": [pointer, pointer, size, count],
        "stage_insertions": [pointer, pointer, pointer, size],
        "stage_insertions_with_weights": [pointer, pointer, pointer, pointer, size],
        "stage_removals": [pointer, pointer, size],
        "discard": [pointer],
        "commit": [pointer, pointer, size, POINTER(Report)],
        "commit_weighted": [pointer, pointer, pointer, size, POINTER(Report)],
        "commit_vectors": [pointer, pointer, size, pointer, size, POINTER(Report)],
        "count": [pointer, count],
        "vertices": [pointer, pointer, pointer, size, count],
        "local": [pointer, POINTER(c_void_p)],
        "owners": [pointer, pointer, size, count],
        "cells": [pointer, pointer, pointer, size, count],
        "hull_facets": [pointer, pointer, pointer, pointer, size, count],
        "take_changes": [pointer, POINTER(_Changes)],
        "exchange": [pointer, pointer, size, size],
        "partition": [pointer, pointer, size, pointer],
        "migrate": [pointer, pointer, size, pointer, size, POINTER(c_void_p), POINTER(Report)],
        "timestamp": [pointer, POINTER(c_uint64)],
        "last_report": [pointer, POINTER(Report)],
    }
    for name, types in arguments.items():
        function = getattr(library, "deldrift_mpi_" + name)
        function.argtypes = types
        function.restype = c_uint32
    library.deldrift_mpi_destroy.argtypes = [pointer]
    library.deldrift_mpi_destroy.restype = None
    library.deldrift_mpi_last_error.restype = c_char_p
    library.deldrift_mpi_refusing_process.restype = c_int
    # Symbols of the library that it is linked with.
    library.deldrift_copy_cells.argtypes = [pointer, pointer, pointer, size, count]
    library.deldrift_copy_positions.argtypes = [pointer, pointer, size, count]
    library.deldrift_keys.argtypes = [pointer, pointer, size, count]
    library.deldrift_weights.argtypes = [pointer, pointer, size, count]
    library.deldrift_hidden_by_weight.argtypes = [pointer, pointer, pointer, size, count]
    for name in ("copy_cells", "copy_positions", "keys", "weights", "hidden_by_weight"):
        getattr(library, "deldrift_" + name).restype = c_uint32
    library.deldrift_last_error.restype = c_char_p
    return library


_library = _load()


def _check(status: int, is_collective: bool = True) -> None:
    if status:
        message = _library.deldrift_mpi_last_error().decode()
        raise DeldriftMpiError(status, _library.deldrift_mpi_refusing_process() if is_collective else -1, message)


def _check_local(status: int) -> None:
    if status:
        raise DeldriftMpiError(status, -1, _library.deldrift_last_error().decode())


def _address(array: np.ndarray | None) -> int | None:
    return None if array is None else array.ctypes.data


class Delaunay:
    """The triangulation of the vertices of all processes of a communicator. Creating it is collective.

    Parameters
    ----------
    comm : mpi4py.MPI.Intracomm
        A copy of it is used.
    points : (n, 2) or (n, 3) array of float
        The vertices that this process owns; where there are none, an array of shape (0, 2) or (0, 3).
    ids : (n,) array of uint64, optional
        A global id for each, each once in all processes. By default 0, 1, ... through the processes. All give ids,
        or none.
    vectors : (1 to 3, 2 or 3) array of float, optional
        The vectors of a periodic box, the same on all processes.
    weights : (n,) array of float, optional
        A weight for each: then all processes give weights, and the triangulation is the regular one.
    boxes, drop_percent : int, optional
        As in deldrift_mpi_options.
    """

    def __init__(
        self,
        comm: MPI.Intracomm,
        points: Any,
        ids: Any = None,
        *,
        vectors: Any = None,
        weights: Any = None,
        boxes: int = 0,
        drop_percent: int = 0,
    ) -> None:
        self._handle = c_void_p()
        self._is_periodic = vectors is not None
        # What is wrong with the shape of one is told to all: the dimension 0 is refused.
        points = np.ascontiguousarray(points, dtype=np.float64)
        self.dimension = points.shape[1] if points.ndim == 2 else 0
        ids = None if ids is None else np.ascontiguousarray(ids, dtype=np.uint64)
        if ids is not None and ids.shape != points.shape[:1]:
            self.dimension = 0
        weights = None if weights is None else np.ascontiguousarray(weights, dtype=np.float64)
        if weights is not None and weights.shape != points.shape[:1]:
            self.dimension = 0
        options = Options(ctypes.sizeof(Options), boxes, drop_percent, None)
        given = [_Comm.from_address(MPI._addressof(comm)), self.dimension, _address(points)]
        name = "create"
        box = None if vectors is None else np.ascontiguousarray(vectors, dtype=np.float64)
        if weights is not None:
            given.append(_address(weights))
        given += [_address(ids), len(points)]
        if box is not None:
            is_right = box.ndim == 2 and box.shape[1] == self.dimension
            given += [_address(box), len(box) if is_right else 0]
            name += "_periodic"
        if weights is not None:
            name += "_weighted"
        _check(getattr(_library, "deldrift_mpi_" + name)(*given, byref(options), byref(self._handle)))

    def destroy(self) -> None:
        """Frees all. Collective; without it the memory stays until the program ends."""
        _library.deldrift_mpi_destroy(self._handle)
        self._handle = c_void_p()

    def __len__(self) -> int:
        """How many vertices this process owns."""
        count = c_size_t()
        _check(_library.deldrift_mpi_count(self._handle, byref(count)), False)
        return count.value

    @property
    def timestamp(self) -> int:
        """0 at creation, one more at each commit."""
        timestamp = c_uint64()
        _check(_library.deldrift_mpi_timestamp(self._handle, byref(timestamp)), False)
        return timestamp.value

    @property
    def report(self) -> Report:
        """What the creation or the latest commit or migration did."""
        report = Report()
        _check(_library.deldrift_mpi_last_report(self._handle, byref(report)), False)
        return report

    @property
    def ids(self) -> np.ndarray:
        """The global ids of the own vertices, in the order of their list."""
        return self._vertices()[0]

    @property
    def vertices(self) -> np.ndarray:
        """The ids of the own vertices in the triangulation of this process."""
        return self._vertices()[1]

    def _vertices(self) -> tuple[np.ndarray, np.ndarray]:
        count = c_size_t(len(self))
        ids, vertices = np.empty(count.value, np.uint64), np.empty(count.value, np.uint32)
        _check(
            _library.deldrift_mpi_vertices(
                self._handle, _address(ids), _address(vertices), count.value, byref(count)
            ),
            False,
        )
        return ids, vertices

    @property
    def owners(self) -> np.ndarray:
        """For each id of the triangulation of this process the rank of the owner, -1 where there is no vertex."""
        count = c_size_t()
        _check(_library.deldrift_mpi_owners(self._handle, None, 0, byref(count)), False)
        owners = np.empty(count.value, np.int32)
        _check(_library.deldrift_mpi_owners(self._handle, _address(owners), len(owners), byref(count)), False)
        return owners

    @property
    def points(self) -> np.ndarray:
        """The positions of the own vertices; in a periodic box those at home."""
        return self.local_points[self.vertices]

    def _local(self) -> c_void_p:
        local = c_void_p()
        _check(_library.deldrift_mpi_local(self._handle, byref(local)), False)
        return local

    @property
    def local_points(self) -> np.ndarray:
        """The positions of all ids of the triangulation of this process; NaN where there is no vertex."""
        count = c_size_t(len(self.owners))
        points = np.empty((count.value, self.dimension))
        _library.deldrift_copy_positions(self._local(), _address(points), count.value, byref(count))
        return points

    @property
    def local_ids(self) -> np.ndarray:
        """The global ids of all ids of the triangulation of this process; 0 where there is no vertex."""
        count = c_size_t(len(self.owners))
        ids = np.empty(count.value, np.uint64)
        _library.deldrift_keys(self._local(), _address(ids), count.value, byref(count))
        return ids

    @property
    def local_cells(self) -> np.ndarray:
        """The cells of the triangulation of this process, as rows of its ids.

        Those with an own vertex are cells of the whole.
        """
        count = c_size_t()
        _library.deldrift_copy_cells(self._local(), None, None, 0, byref(count))
        cells = np.empty((count.value, self.dimension + 1), np.uint32)
        if _library.deldrift_copy_cells(self._local(), _address(cells), None, len(cells), byref(count)):
            raise MemoryError(_library.deldrift_last_error().decode())
        return cells

    def cells(self) -> np.ndarray:
        """The cells that this process owns, as rows of global ids, positively oriented."""
        return self._own_cells()[0]

    @property
    def own_cells(self) -> np.ndarray:
        """The indices into local_cells of the cells that this process owns."""
        return self._own_cells()[1]

    def _own_cells(self) -> tuple[np.ndarray, np.ndarray]:
        count = c_size_t()
        _check(_library.deldrift_mpi_cells(self._handle, None, None, 0, byref(count)), False)
        rows = np.empty((count.value, self.dimension + 1), np.uint64)
        cells = np.empty(count.value, np.uint32)
        _check(
            _library.deldrift_mpi_cells(self._handle, _address(rows), _address(cells), len(cells), byref(count)), False
        )
        return rows, cells

    def cell_shifts(self) -> np.ndarray:
        """By own cell and corner the multiples of the vectors by which it is translated from where it was given. Collective.

        The corner of the least id is where it was given.
        """
        count = c_size_t(len(self.own_cells))
        shifts = np.empty((count.value, self.dimension + 1, self.dimension), np.int64)
        _check(_library.deldrift_mpi_cell_shifts(self._handle, _address(shifts), count.value, byref(count)))
        return shifts

    def periods(self) -> np.ndarray:
        """By id of the triangulation of this process the multiples by which it is translated from where it was given.

        Collective.
        """
        count = c_size_t(len(self.owners))
        shifts = np.empty((count.value, self.dimension), np.int64)
        _check(_library.deldrift_mpi_periods(self._handle, _address(shifts), count.value, byref(count)))
        return shifts

    def hull_facets(self) -> np.ndarray:
        """The facets of the convex hull of the whole that this process owns, as rows of global ids, seen from outside."""
        count = c_size_t()
        _check(_library.deldrift_mpi_hull_facets(self._handle, None, None, None, 0, byref(count)), False)
        rows = np.empty((count.value, self.dimension), np.uint64)
        _check(
            _library.deldrift_mpi_hull_facets(self._handle, _address(rows), None, None, len(rows), byref(count)), False
        )
        return rows

    def take_changes(self) -> Changes:
        """The own cells that have come and gone since this was last called. Collective in a periodic box."""
        changes = _Changes()
        _check(_library.deldrift_mpi_take_changes(self._handle, byref(changes)), self._is_periodic)

        def rows(address: int | None, count: int, shape: tuple[int, ...], kind: type) -> np.ndarray:
            text = ctypes.string_at(address, 8 * count * int(np.prod(shape))) if count else b""
            return np.frombuffer(text, kind).reshape(count, *shape).copy()

        def ids(address: int | None, count: int) -> np.ndarray:
            return rows(address, count, (self.dimension + 1,), np.uint64)

        def shifts(address: int | None, count: int) -> np.ndarray | None:
            shape = self.dimension + 1, self.dimension
            return rows(address, count, shape, np.int64) if self._is_periodic else None

        created, removed = changes.created_count, changes.removed_count
        return Changes(
            ids(changes.created, created), ids(changes.removed, removed), bool(changes.is_anew),
            shifts(changes.created_shifts, created), shifts(changes.removed_shifts, removed),
        )

    @property
    def weights(self) -> np.ndarray:
        """Weights of the own vertices, in the order of their list."""
        count, local = c_size_t(), self._local()
        _check_local(_library.deldrift_weights(local, None, 0, byref(count)))
        weights = np.empty(count.value)
        _check_local(_library.deldrift_weights(local, _address(weights), len(weights), byref(count)))
        return weights[self.vertices]

    @property
    def hidden_by_weight(self) -> np.ndarray:
        """Places of the own vertices that are hidden by weight, ascending."""
        count, local = c_size_t(), self._local()
        _check_local(_library.deldrift_hidden_by_weight(local, None, None, 0, byref(count)))
        hidden = np.empty(count.value, np.uint32)
        _check_local(_library.deldrift_hidden_by_weight(local, _address(hidden), None, len(hidden), byref(count)))
        return np.flatnonzero(np.isin(self.vertices, hidden))

    def stage_insertions(self, points: Any, ids: Any, weights: Any = None) -> None:
        """Stages vertices of new global ids, which the next commit inserts behind the own ones; of these weights, or 0."""
        points = np.ascontiguousarray(points, dtype=np.float64)
        ids = np.ascontiguousarray(ids, dtype=np.uint64)
        if points.shape != (len(ids), self.dimension):
            raise ValueError(f"points has the shape {points.shape}, and there are {len(ids)} ids")
        if weights is not None:
            weights = np.ascontiguousarray(weights, dtype=np.float64)
            if weights.shape != ids.shape:
                raise ValueError(f"weights has the shape {weights.shape}, and there are {len(ids)} ids")
            given = (_address(points), _address(weights), _address(ids), len(ids))
            _check(_library.deldrift_mpi_stage_insertions_with_weights(self._handle, *given), False)
            return
        _check(
            _library.deldrift_mpi_stage_insertions(self._handle, _address(points), _address(ids), len(ids)), False
        )

    def stage_removals(self, places: Any) -> None:
        """Stages the removal of own vertices, given by their places in the list, by the next commit."""
        places = np.ascontiguousarray(places, dtype=np.uint32)
        _check(_library.deldrift_mpi_stage_removals(self._handle, _address(places), len(places)), False)

    def discard(self) -> None:
        """Forgets what is staged on this process."""
        _check(_library.deldrift_mpi_discard(self._handle), False)

    def commit(self, points: Any = None, *, weights: Any = None, vectors: Any = None) -> Report:
        """Makes new positions of the own vertices, and what is staged, the next timestamp. Collective.

        points: a row for each own vertex, also for those whose removal is staged; None if none moves. weights: a number
        for each; None leaves them as they are. vectors: those of a periodic box from now on; all points have to be given
        then, and nothing may be staged.
        """
        report, count = Report(), 0
        if weights is not None:
            if vectors is not None:
                raise ValueError("vectors and weights are not committed in one call")
            weights = np.ascontiguousarray(weights, dtype=np.float64)
            count = len(weights) if weights.ndim == 1 else len(self) + 1
        if points is not None:
            points = np.ascontiguousarray(points, dtype=np.float64)
            # A wrong shape is refused as a wrong count, by all.
            is_right = points.ndim == 2 and points.shape[1] == self.dimension
            counts = {len(points) if is_right else len(self) + 1} | ({count} if weights is not None else set())
            count = counts.pop() if len(counts) == 1 else len(self) + 1
        if vectors is not None:
            box = np.ascontiguousarray(vectors, dtype=np.float64)
            n_vectors = len(box) if box.ndim == 2 and box.shape[1] == self.dimension else 0
            _check(
                _library.deldrift_mpi_commit_vectors(
                    self._handle, _address(points), count, _address(box), n_vectors, byref(report)
                )
            )
            return report
        if weights is not None:
            given = (_address(points), _address(weights), count)
            _check(_library.deldrift_mpi_commit_weighted(self._handle, *given, byref(report)))
            return report
        _check(_library.deldrift_mpi_commit(self._handle, _address(points), count, byref(report)))
        return report

    def exchange(self, values: Any) -> np.ndarray:
        """Values by id of the triangulation of this process: those of own vertices go to all copies. Collective.

        Gives an array in which the rows of copies are those of their owners.
        """
        values = np.array(values, order="C")
        bytes_of_row = values.dtype.itemsize * int(np.prod(values.shape[1:], dtype=np.int64))
        _check(_library.deldrift_mpi_exchange(self._handle, _address(values), bytes_of_row, len(values)))
        return values

    def partition(self, weights: Any = None) -> np.ndarray:
        """For each own vertex the rank that should own it, so that weights are shared equally. Collective."""
        weights = None if weights is None else np.ascontiguousarray(weights, dtype=np.float64)
        targets = np.empty(len(self), np.int32)
        count = len(self) if weights is None or weights.ndim == 1 and len(weights) == len(self) else len(self) + 1
        _check(_library.deldrift_mpi_partition(self._handle, _address(weights), count, _address(targets)))
        return targets

    def migrate(self, targets: Any, values: Any = None) -> np.ndarray | None:
        """Gives own vertices to the processes of targets, with the rows of values. Collective.

        Gives the rows of the vertices owned afterwards, in the order of their list.
        """
        targets = np.ascontiguousarray(targets, dtype=np.int32)
        received, count, bytes_of_row = c_void_p(), len(targets), 0
        if values is not None:
            values = np.ascontiguousarray(values)
            bytes_of_row = values.dtype.itemsize * int(np.prod(values.shape[1:], dtype=np.int64))
            if len(values) != len(targets):
                count = len(self) + 1
        _check(
            _library.deldrift_mpi_migrate(
                self._handle, _address(targets), count, _address(values), bytes_of_row, byref(received), None
            )
        )
        if values is None:
            return None
        buffer = ctypes.string_at(received, len(self) * bytes_of_row)
        return np.frombuffer(buffer, dtype=values.dtype).reshape(len(self), *values.shape[1:]).copy()
