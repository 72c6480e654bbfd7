"""Triangulations of points that repeat."""

from __future__ import annotations

import ctypes
from typing import Any, Callable, Optional

import numpy as np

from . import _library
from ._arrays import F64, I32, Handle, address, ids as listed_ids, points as point_rows
from ._core import Core, check, count_of, fixed, id_count, make_options
from ._delaunay import _callbacks
from ._errors import WrongCount
from ._library import Report

_create_periodic = _library.function("create_periodic")
_stage_vectors = _library.function("stage_vectors")
_vectors = _library.function("vectors")
_wrap_positions = _library.function("wrap_positions")
_reduced_vectors = _library.function("reduced_vectors")
_cell_shifts = _library.function("cell_shifts")
_edge_shifts = _library.function("edge_shifts")
_edges = _library.function("edges")
_copy_cells = _library.function("copy_cells")
_copy_positions = _library.function("copy_positions")
_commit_positions = _library.function("commit_positions")
_commit_timestamp = _library.function("commit_timestamp")
_discard_moves = _library.function("discard_moves")
_move_vertices = _library.function("move_vertices")
_stage_insertions = _library.function("stage_insertions")
_stage_removals = _library.function("stage_removals")
_vertex_count = _library.function("vertex_count")
_memory_bytes = _library.function("memory_bytes")
_timestamp = _library.function("timestamp")
_voronoi_volumes = _library.function("voronoi_volumes")

I64 = np.dtype(np.int64)


class PeriodicDelaunay(Core):
    """The Delaunay triangulation of points that repeat, and that may move.

    Each point is in all places to which sums of multiples of the vectors of the box take it. Of the simplices, one of each
    class of translations of each other is listed. They are exact, and depend neither on the period in which a point is
    given, nor on which vectors of the lattice are given.

    Parameters
    ----------
    points : array_like
        A row of 2 or 3 coordinates for each point, in any period. Row i is vertex i.
    vectors : array_like
        The vectors of the box: up to as many rows as there are dimensions. A number for each dimension stands for a box
        along the axes. Directions that the rows do not span are open.
    algorithm : {"auto", "rebuilding", "placement_flips", "tolerance", "repair"}, optional
        How `move` brings the triangulation to new positions. All give the same simplices.
    threads : int, optional
        The most threads that a call may use, 0 for as many as pay.
    progress : callable or tqdm, optional
        Called during long calls with the part that is done. An exception cancels the call.
    cancel : callable, optional
        Called during long calls; when it returns true, the call raises `Cancelled` and has no effect.

    Examples
    --------
    >>> import deldrift
    >>> tri = deldrift.PeriodicDelaunay([[0.1, 0.1], [0.6, 0.7], [0.4, 0.9]], vectors=[1, 1])
    >>> tri.nsimplex
    6
    >>> bool(abs(tri.voronoi_volumes().sum() - 1) < 1e-12)
    True
    >>> tri.move([[0.2, 0.1], [0.6, 0.7], [0.4, 0.9]], vectors=[[1, 0], [0.25, 1]]).timestamp
    1
    """

    def __init__(
        self,
        points: Any,
        vectors: Any,
        *,
        algorithm: str = "auto",
        threads: int = 0,
        progress: Any = None,
        cancel: Optional[Callable[[], bool]] = None,
    ) -> None:
        rows = point_rows("points", points)
        ndim = rows.shape[1]
        box = _box(vectors, ndim)
        callbacks = _callbacks(progress, cancel)
        options = make_options(algorithm, threads, "merge", "ignore", callbacks)
        pointer = ctypes.c_void_p()
        status = _create_periodic(ndim, address(rows), len(rows), address(box), len(box), options, pointer)
        check(status, {"positions": "points"}, callbacks)
        self._start(Handle(pointer.value or 0, callbacks), ndim, threads, "merge", "ignore", callbacks)

    def __reduce__(self) -> Any:
        # Copies of the attributes would share what the library holds, and destroy it twice.
        raise TypeError("a PeriodicDelaunay can be neither copied nor pickled: make one of its points and vectors")

    @property
    def nvertices(self) -> int:
        """The number of vertices that are there."""
        with self._reading as t:
            return count_of(_vertex_count, t)

    @property
    def nsimplex(self) -> int:
        """The number of simplices that are no translations of each other."""
        return len(self.simplices)

    @property
    def nbytes(self) -> int:
        """The bytes of memory that the library holds for the triangulation."""
        with self._reading as t:
            return count_of(_memory_bytes, t)

    @property
    def timestamp(self) -> int:
        """0 at creation, one more after each change."""
        timestamp = ctypes.c_uint64()
        with self._reading as t:
            self._check(_timestamp(t, timestamp))
        return timestamp.value

    @property
    def report(self) -> Optional[Report]:
        """What the last change did; None before the first."""
        return self._last_report

    @property
    def points(self) -> np.ndarray:
        """By id the positions as they were given, on the grid of the box; NaN for removed vertices."""
        return self._once("points", self._copy_points)

    def _copy_points(self) -> np.ndarray:
        with self._reading as t:
            positions = np.empty((id_count(t), self.ndim), F64)
            self._check(_copy_positions(t, address(positions), len(positions), ctypes.c_size_t()))
        return fixed(positions)

    @property
    def vectors(self) -> np.ndarray:
        """The vectors of the box, a row for each, on the grid of the box."""
        return self._once("vectors", self._copy_vectors)

    def _copy_vectors(self) -> np.ndarray:
        count, rows = ctypes.c_size_t(), np.empty((self.ndim, self.ndim), F64)
        with self._reading as t:
            self._check(_vectors(t, address(rows), self.ndim, count))
        return fixed(rows[: count.value])

    def reduced_vectors(self) -> tuple[np.ndarray, np.ndarray]:
        """The shortest vectors of the lattice of the box.

        Returns
        -------
        vectors : ndarray of float
            A row for each.
        multiples : ndarray of int
            The multiples of the vectors of the box of which each is the sum.
        """
        count = ctypes.c_size_t()
        rows, multiples = np.empty((self.ndim, self.ndim), F64), np.empty((self.ndim, self.ndim), I64)
        with self._reading as t:
            self._check(_reduced_vectors(t, address(rows), address(multiples), None, self.ndim, count))
        return rows[: count.value], multiples[: count.value, : count.value]

    def wrap(self, points: Any, previous: Any = None) -> tuple[np.ndarray, np.ndarray]:
        """Takes points into the box: into the unit cell of the reduced vectors, on the grid of the box.

        Parameters
        ----------
        points : array_like
            Any points, in any period.
        previous : array_like, optional
            A row for each: it goes to the period nearest to that, if this is out of the unit cell by a quarter of it at most.

        Returns
        -------
        places : ndarray of float
            Where they are then.
        shifts : ndarray of int
            By which multiples of the vectors of the box each point is translated from there.
        """
        rows = point_rows("points", points, self.ndim)
        beside = None if previous is None else point_rows("previous", previous, self.ndim)
        if beside is not None and len(beside) != len(rows):
            raise WrongCount(f"there are {len(beside)} rows of previous for {len(rows)} points", "previous", None, len(beside))
        places, shifts = np.empty(rows.shape, F64), np.empty(rows.shape, I64)
        other = None if beside is None else address(beside)
        with self._reading as t:
            status = _wrap_positions(t, address(rows), other, len(rows), address(places), address(shifts))
            self._check(status)
        return places, shifts[:, : len(self.vectors)]

    @property
    def simplices(self) -> np.ndarray:
        """The vertices of each simplex, positively oriented; one may be there in several periods."""
        return self._cells_and_shifts()[0]

    @property
    def neighbors(self) -> np.ndarray:
        """The simplex opposite each corner, -1 on the hull of a box that is open somewhere."""
        return self._cells_and_shifts()[1]

    @property
    def shifts(self) -> np.ndarray:
        """By simplex and corner, by which multiples of the vectors the vertex is translated from its point."""
        return self._cells_and_shifts()[2]

    @property
    def neighbor_shifts(self) -> np.ndarray:
        """By simplex and corner, by which multiples of the vectors the simplex opposite is translated from its own shifts."""
        return self._cells_and_shifts()[3]

    def _cells_and_shifts(self) -> tuple[np.ndarray, ...]:
        return self._once("cells and shifts", self._copy_cells)

    def _copy_cells(self) -> tuple[np.ndarray, ...]:
        count = ctypes.c_size_t()
        with self._reading as t:
            self._check(_copy_cells(t, None, None, 0, count))
            n, width = count.value, self.ndim + 1
            simplices, neighbors = np.empty((n, width), I32), np.empty((n, width), I32)
            shifts, beside = np.empty((n, width, self.ndim), I64), np.empty((n, width, self.ndim), I64)
            self._check(_copy_cells(t, address(simplices), address(neighbors), n, count))
            self._check(_cell_shifts(t, address(shifts), address(beside), n, count))
        rank = len(self.vectors)
        return fixed(simplices), fixed(neighbors), fixed(shifts[..., :rank]), fixed(beside[..., :rank])

    @property
    def corners(self) -> np.ndarray:
        """The places of the corners of each simplex, together as they are in space."""
        places: np.ndarray = self.points[self.simplices] + self.shifts @ self.vectors
        return places

    def edges(self) -> tuple[np.ndarray, np.ndarray]:
        """The edges, one of each class of translations of each other.

        Returns
        -------
        edges : ndarray of int
            Rows of two vertices, the lower id first. A vertex may have edges to itself in other periods.
        shifts : ndarray of int
            For each edge, by which multiples of the vectors the second vertex is translated from its point, where the first
            one is at its own.
        """
        count = ctypes.c_size_t()
        with self._reading as t:
            self._check(_edges(t, None, 0, count))
            n = count.value
            edges, shifts = np.empty((n, 2), I32), np.empty((n, self.ndim), I64)
            self._check(_edges(t, address(edges), n, count))
            self._check(_edge_shifts(t, address(shifts), n, count))
        return edges, shifts[:, : len(self.vectors)]

    def voronoi_volumes(self) -> np.ndarray:
        """By id the area or volume of the Voronoi cell of each vertex.

        Returns
        -------
        ndarray of float
            Their sum is that of the box. 0 for a vertex at the place of one with a lower id, NaN for removed ones, infinite
            for cells without an end, of boxes that are open somewhere.
        """
        with self._reading as t:
            volumes = np.empty(id_count(t), F64)
            self._check(_voronoi_volumes(t, None, None, address(volumes), len(volumes), ctypes.c_size_t()))
        return volumes

    def move(self, points: Any = None, ids: Any = None, *, vectors: Any = None) -> Report:
        """Moves vertices, changes the box, or both, and makes that the next timestamp.

        Parameters
        ----------
        points : array_like, optional
            A row of coordinates for each vertex, in any period. Without `ids` there is one for each id.
        ids : array_like of int, optional
            The vertices that move, each at most once; all by default.
        vectors : array_like, optional
            The new vectors of the box, as many as there are. Points that do not move stay where they are.

        Returns
        -------
        Report
            What was done.
        """
        positions = None if points is None else point_rows("points", points, self.ndim)
        moving = None if ids is None else listed_ids("ids", ids)
        if (positions is None) != (moving is None) and positions is None:
            raise WrongCount("ids are given, and no points", "ids")
        if moving is not None and positions is not None and len(moving) != len(positions):
            raise WrongCount(f"there are {len(positions)} points for {len(moving)} ids", "points", None, len(positions))
        box = None if vectors is None else _box(vectors, self.ndim)

        def change(t: int, report: Report) -> int:
            status = 0
            if box is not None:
                status = _stage_vectors(t, address(box), len(box))
            if status == 0 and positions is not None and moving is None:
                return int(_commit_positions(t, address(positions), len(positions), report))
            if status == 0 and positions is not None and moving is not None:
                status = _move_vertices(t, address(moving), address(positions), len(moving))
            return status or int(_commit_timestamp(t, report))

        return self._change(change)

    def insert(self, points: Any) -> np.ndarray:
        """Inserts points.

        Parameters
        ----------
        points : array_like
            A row of coordinates for each.

        Returns
        -------
        ndarray of int
            Their ids.
        """
        positions, first = point_rows("points", points, self.ndim), ctypes.c_uint32()

        def change(t: int, report: Report) -> int:
            status = _stage_insertions(t, address(positions), len(positions), first)
            return int(status or _commit_timestamp(t, report))

        self._change(change)
        return np.arange(first.value, first.value + len(positions), dtype=I32)

    def remove(self, ids: Any) -> Report:
        """Removes vertices, whose ids are not given again.

        Parameters
        ----------
        ids : array_like of int
            The vertices, each once.

        Returns
        -------
        Report
            What was done.
        """
        going = listed_ids("ids", ids)
        return self._change(
            lambda t, report: int(_stage_removals(t, address(going), len(going)) or _commit_timestamp(t, report))
        )

    def _change(self, change: Callable[[int, Report], int]) -> Report:
        """A change, which has no effect if it fails."""
        report = Report()
        with self._changing as t:
            status = change(t, report)
            if status:
                try:
                    self._check(status, positions="points", vertices="ids")
                finally:
                    check(_discard_moves(t))
            self._last_report = report
        return report

    def __repr__(self) -> str:
        return f"<deldrift.PeriodicDelaunay of {self.nvertices} points in {self.ndim}D, {self.nsimplex} simplices>"


def _box(vectors: Any, ndim: int) -> np.ndarray:
    """The vectors of a box, a row for each."""
    given = np.asarray(vectors)
    if given.shape == (ndim,) and given.dtype.kind in "fiu":
        return np.diag(given.astype(F64))
    return point_rows("vectors", vectors, ndim)
