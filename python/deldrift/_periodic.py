"""Triangulations of points that repeat."""

from __future__ import annotations

import ctypes
from typing import Any, Callable, NamedTuple, Optional, Union, overload

import numpy as np

from . import _library
from ._arrays import F64, I32, Handle, address, address_if, answered, array_of, box_corners, half_space_rows, ids as listed_ids
from ._arrays import mask as mask_of, one_id, places, points as point_rows
from ._callbacks import calling
from ._core import Division, cell_count, check, count_of, fixed, id_count, make_options
from ._errors import WrongCount
from ._geometry import VoronoiCells, VoronoiDerivatives, VoronoiWeightDerivatives, cells_and_facets, vertex_mask
from ._geometry import weight_derivatives
from ._library import Report
from ._loading import given_callbacks, made, of_bytes, of_file
from ._measured import Measured
from ._meeting import Meeting
from ._motion import Changes, changes_of
from ._near import Near
from ._step import Trial
from ._transferring import Transferring
from ._values import Values, as_given, expect, given_values
from ._writing import Path, Writing

_create_periodic = _library.function("create_periodic")
_stage_vectors = _library.function("stage_vectors")
_vectors = _library.function("vectors")
_clone = _library.function("clone")
_star = _library.function("star")
_get_algorithm = _library.function("get_algorithm")
_wrap_positions = _library.function("wrap_positions")
_reduced_vectors = _library.function("reduced_vectors")
_cell_shifts = _library.function("cell_shifts")
_locate_in_period = _library.function("locate_in_period")
_edge_shifts = _library.function("edge_shifts")
_edges = _library.function("edges")
_copy_cells = _library.function("copy_cells")
_copy_positions = _library.function("copy_positions")
_commit_positions = _library.function("commit_positions")
_commit_timestamp = _library.function("commit_timestamp")
_prepare_timestamp = _library.function("prepare_timestamp")
_take_changes = _library.function("take_changes")
_discard_moves = _library.function("discard_moves")
_move_vertices = _library.function("move_vertices")
_stage_insertions = _library.function("stage_insertions")
_stage_removals = _library.function("stage_removals")
_compact = _library.function("compact")
_vertex_count = _library.function("vertex_count")
_memory_bytes = _library.function("memory_bytes")
_timestamp = _library.function("timestamp")
_voronoi_volumes = _library.function("voronoi_volumes")
_voronoi_facets = _library.function("voronoi_facets")
_voronoi_cells_within = _library.function("voronoi_cells_within")
_voronoi_derivatives_within = _library.function("voronoi_derivatives_within")

I64 = np.dtype(np.int64)


class PeriodicLocations(NamedTuple):
    """Where points of a periodic box lie."""

    kinds: np.ndarray
    """0 at a vertex, 1 in a simplex or on its boundary, 2 outside the convex hull, 3 where there are no simplices."""
    indices: np.ndarray
    """The vertex; the simplex; one with a facet on the hull that faces the point; -1."""
    shifts: np.ndarray
    """By which multiples of the vectors the vertex is translated from its point, or the simplex from its own shifts."""


class PeriodicDelaunay(Near, Measured, Meeting, Transferring, Writing):
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
        The most threads that a call may use, 0 for as many as make it faster.
    parts : int, optional
        The most parts into which work is divided where that shows in the order of simplices, 0 for one a thread. With
        any other number the same calls give the same answers, to the last bit, on any number of threads.
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

    is_periodic = True
    """Whether points repeat."""

    def __init__(
        self,
        points: Any,
        vectors: Any,
        *,
        algorithm: str = "auto",
        threads: int = 0,
        parts: int = 0,
        progress: Any = None,
        cancel: Optional[Callable[[], bool]] = None,
    ) -> None:
        rows = point_rows("points", points)
        self._make(_create_periodic, rows, (address(rows),), vectors, algorithm, (threads, parts), progress, cancel)

    def _make(
        self,
        create: Callable[..., int],
        rows: np.ndarray,
        arrays: tuple[Any, ...],
        vectors: Any,
        algorithm: str,
        division: Division,
        progress: Any,
        cancel: Optional[Callable[[], bool]],
    ) -> None:
        """Makes the triangulation of what these arrays have for each row of points."""
        ndim = rows.shape[1]
        box = box_of(vectors, ndim)
        callbacks = given_callbacks(progress, cancel)
        options = make_options(algorithm, division, "merge", "ignore", callbacks)
        handle = Handle(callbacks)
        given = ndim, *arrays, len(rows), address(box), len(box), options, handle.made
        check(calling(callbacks, create, *given), {"positions": "points"}, callbacks)
        self._start(handle, ndim, division, "merge", "ignore", callbacks)

    @classmethod
    def load(
        cls,
        path: Path,
        *,
        algorithm: str = "auto",
        threads: int = 0,
        parts: int = 0,
        progress: Any = None,
        cancel: Optional[Callable[[], bool]] = None,
    ) -> "PeriodicDelaunay":
        """Makes a triangulation of a file that `save` has written.

        Parameters
        ----------
        path : str or path
            Of the file.
        algorithm, threads, parts, progress, cancel
            As of `PeriodicDelaunay`; they are not saved.

        Returns
        -------
        PeriodicDelaunay
            As the one that was saved. Simplices have their indices, unless `changes` had been called.
        """
        return of_file(cls, path, algorithm, (threads, parts), "merge", "ignore", progress, cancel)

    @classmethod
    def frombytes(
        cls,
        data: Any,
        *,
        algorithm: str = "auto",
        threads: int = 0,
        parts: int = 0,
        progress: Any = None,
        cancel: Optional[Callable[[], bool]] = None,
    ) -> "PeriodicDelaunay":
        """Makes a triangulation of bytes that `tobytes` gave.

        Parameters
        ----------
        data : bytes-like
            The bytes. Whatever they are, nothing is loaded that is not right, exactly.
        algorithm, threads, parts, progress, cancel
            As of `PeriodicDelaunay`; they are not saved.

        Returns
        -------
        PeriodicDelaunay
            As the one that was saved. Simplices have their indices, unless `changes` had been called.
        """
        return of_bytes(cls, data, algorithm, (threads, parts), "merge", "ignore", progress, cancel)

    def copy(self) -> "PeriodicDelaunay":
        """An independent triangulation that is as this one.

        Returns
        -------
        PeriodicDelaunay
            After the same calls it has the same simplices. It calls the same callbacks.
        """
        handle = Handle(self._callbacks)
        with self._reading as t:
            self._check(_clone(t, handle.made))
        return made(type(self), handle, self._division, self._coincidence, self._passing, self._callbacks)

    def __copy__(self) -> "PeriodicDelaunay":
        return self.copy()

    def __deepcopy__(self, _memo: Any) -> "PeriodicDelaunay":
        return self.copy()

    def __reduce__(self) -> Any:
        with self._reading as t:
            number = ctypes.c_uint32()
            self._check(_get_algorithm(t, number))
        options = _library.ALGORITHMS[number.value], self._division, self._coincidence, self._passing
        return of_bytes, (type(self), self.tobytes(), *options)

    def star(self, vertex: int) -> np.ndarray:
        """The simplices at the place of a vertex: one for each corner that is the vertex, in whatever period.

        Parameters
        ----------
        vertex : int
            The id; for a hidden vertex that of its representative counts.

        Returns
        -------
        ndarray of int
            Their indices.
        """
        number = one_id("vertex", vertex)
        with self._reading as t:
            count = ctypes.c_size_t()
            self._check(_star(t, number, None, 0, count), vertex="vertex!")
            cells = np.empty(count.value, I32)
            self._check(_star(t, number, address(cells), len(cells), count), vertex="vertex!")
        return cells

    @property
    def nvertices(self) -> int:
        """The number of vertices that are there."""
        with self._reading as t:
            return count_of(_vertex_count, t)

    @property
    def nsimplex(self) -> int:
        """The number of simplices that are no translations of each other."""
        with self._reading as t:
            return cell_count(t)

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
        return self._cells()[0]

    @property
    def neighbors(self) -> np.ndarray:
        """The simplex opposite each corner, -1 on the hull of a box that is open somewhere."""
        return self._cells()[1]

    @property
    def shifts(self) -> np.ndarray:
        """By simplex and corner, by which multiples of the vectors the vertex is translated from its point."""
        return self._shifts()[0]

    @property
    def neighbor_shifts(self) -> np.ndarray:
        """By simplex and corner, by which multiples of the vectors the simplex opposite is translated from its own shifts."""
        return self._shifts()[1]

    def _cells(self) -> tuple[np.ndarray, np.ndarray]:
        return self._once("cells", self._copy_cells)

    def _copy_cells(self) -> tuple[np.ndarray, np.ndarray]:
        count = ctypes.c_size_t()
        with self._reading as t:
            self._check(_copy_cells(t, None, None, 0, count))
            n, width = count.value, self.ndim + 1
            simplices, neighbors = np.empty((n, width), I32), np.empty((n, width), I32)
            self._check(_copy_cells(t, address(simplices), address(neighbors), n, count))
        return fixed(simplices), fixed(neighbors)

    def _shifts(self) -> tuple[np.ndarray, np.ndarray]:
        # They have several times as many bytes as the cells, which programs often read alone.
        return self._once("shifts", self._copy_shifts)

    def _copy_shifts(self) -> tuple[np.ndarray, np.ndarray]:
        count = ctypes.c_size_t()
        with self._reading as t:
            n, width = cell_count(t), self.ndim + 1
            shifts, beside = np.empty((n, width, self.ndim), I64), np.empty((n, width, self.ndim), I64)
            self._check(_cell_shifts(t, address(shifts), address(beside), n, count))
        rank = len(self.vectors)
        return fixed(shifts[..., :rank]), fixed(beside[..., :rank])

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

    def neighbor_lists(  # type: ignore[override]
        self, squared_radius: Any, half: bool = False, mask: Any = None
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """For each vertex the images whose squared distance from it is at most a given one, exactly, in one call.

        Parameters
        ----------
        squared_radius : float or array_like of float
            The square of the radius of all lists, or of that of each id. It may be larger than the box.
        half : bool, optional
            Whether each pair comes once, in the list of the lower id.
        mask : array_like of bool, optional
            By id, which vertices have lists; all by default.

        Returns
        -------
        indptr, indices, shifts : ndarray of int
            The neighbours of vertex k are ``indices[indptr[k]:indptr[k + 1]]``, ascending. Each is at its point and the multiples
            of the vectors that are in its row of `shifts`; the vertex itself comes in other periods.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.PeriodicDelaunay([[0.125, 0.5], [0.875, 0.5]], vectors=[1, 1])
        >>> tri.neighbor_lists(0.0625)
        (array([0, 1, 2]), array([1, 0], dtype=int32), array([[-1,  0],
               [ 1,  0]]))
        """
        indptr, indices, shifts = self._lists(squared_radius, half, mask, self.ndim)
        return indptr, indices, shifts[:, : len(self.vectors)]

    def locate(self, xi: Any, *, nan_policy: str = "raise") -> PeriodicLocations:
        """Where points lie, exactly, once they are rounded to the grid of the box as vertices are.

        Parameters
        ----------
        xi : array_like
            Points, in any period; the last axis has the coordinates.
        nan_policy : {"raise", "omit"}, optional
            Whether a point with a coordinate that is NaN or infinite raises `NotFinite`, or gets the kind and index -1.

        Returns
        -------
        PeriodicLocations
            A kind and an index for each, and in which period what is there is.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.PeriodicDelaunay([[0.1, 0.1], [0.6, 0.7], [0.4, 0.9]], vectors=[1, 1])
        >>> tri.locate([5.6, -1.3])
        PeriodicLocations(kinds=array(0, dtype=int32), indices=array(1, dtype=int32), shifts=array([ 5, -2]))
        """
        rows, shape = places("xi", xi, self.ndim)
        answers = answered(rows, nan_policy, lambda some: self._located(some, shape), -1)
        rank = len(self.vectors)
        kinds, indices = (answers[:, column].astype(I32).reshape(shape) for column in range(2))
        shifts = np.where(kinds.reshape(-1)[:, None] < 0, 0, answers[:, 2 : 2 + rank])
        return PeriodicLocations(kinds, indices, shifts.reshape(shape + (rank,)))

    def _located(self, rows: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
        """Rows of a kind, an index, and shifts."""
        locations, shifts = np.empty((len(rows), 2), I32), np.empty((len(rows), self.ndim), I64)
        with self._reading as t:
            status = _locate_in_period(t, address(rows), len(rows), None, address(locations), address(shifts))
            self._check(status, positions=("xi", shape))
        return np.concatenate([locations.astype(I64), shifts], axis=1)

    def _simplices_at(self, rows: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
        kinds, indices = self._located(rows, shape)[:, :2].T
        found = np.where(kinds == 1, indices, -1).astype(I32)
        if (kinds == 0).any():
            simplex_of = np.full(len(self.points), -1, I32)
            simplex_of[self.simplices] = np.arange(len(self.simplices), dtype=I32)[:, None]
            found[kinds == 0] = simplex_of[indices[kinds == 0]]
        return found

    def voronoi_volumes(self, box: Any = None) -> np.ndarray:
        """By id the area or volume of the Voronoi cell of each vertex.

        Parameters
        ----------
        box : (array_like, array_like), optional
            Where walls are, as for `voronoi_cells`.

        Returns
        -------
        ndarray of float
            Their sum is that of the box, or of what walls leave of it. 0 for a vertex at the place of one with a lower id, NaN for
            removed ones, infinite for cells without an end, of boxes that are open somewhere and have no walls there.
        """
        low, high = box_corners(box, self.ndim)
        walls = address_if(low), address_if(high)
        with self._reading as t:
            volumes = np.empty(id_count(t), F64)
            self._check(_voronoi_volumes(t, *walls, address(volumes), len(volumes), ctypes.c_size_t()))
        return volumes

    def voronoi_cells(self, mask: Any = None, *, box: Any = None, half_spaces: Any = None) -> VoronoiCells:
        """Areas or volumes, boundaries and centroids of the Voronoi cells of all ids.

        Parameters
        ----------
        mask : array_like of bool, optional
            Whether the cell of each id is asked for; all are by default. The others get NaN.
        box : (array_like, array_like), optional
            Where walls are that cut cells: the least and the greatest coordinates, -inf and inf along axes along which vectors
            go.
        half_spaces : array_like, (n, ndim + 1), optional
            Walls of any direction that vectors do not cross, a row each: an outward normal, of which the product with each of the
            `vectors` is 0, exactly, and an offset. The half-space is where normal · x is at most the offset.

        Returns
        -------
        VoronoiCells
            Volumes, areas and centroids, these where the vertex is at its point. A cell without an end has volume and area
            infinite, and no centroid, which is NaN.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.PeriodicDelaunay([[2.5, 0.25]], vectors=[1, 1])
        >>> cells = tri.voronoi_cells()
        >>> cells.volumes, cells.areas, cells.centroids
        (array([1.]), array([4.]), array([[2.5 , 0.25]]))
        >>> strip = deldrift.PeriodicDelaunay([[2.5, 0.25]], vectors=[[1, 0]])
        >>> strip.voronoi_cells(box=([-float("inf"), 0], [float("inf"), 2])).volumes
        array([2.])
        """
        low, high = box_corners(box, self.ndim)
        planes = half_space_rows(half_spaces, self.ndim)
        chosen = None if mask is None else mask_of("mask", mask)
        with self._reading as t:
            n = id_count(t)
            given = vertex_mask(chosen, n)
            cells = VoronoiCells(np.full(n, np.nan), np.full(n, np.nan), np.full((n, self.ndim), np.nan))
            rows = (address(array) for array in cells)
            walls = address_if(low), address_if(high), address(planes), len(planes)
            self._check(_voronoi_cells_within(t, *walls, *given, *rows, n, ctypes.c_size_t()))
        return cells

    def voronoi_facets(self, box: Any = None) -> np.ndarray:
        """The lengths or areas of the Voronoi facets of all edges, in the order of `edges`.

        Parameters
        ----------
        box : (array_like, array_like), optional
            Where walls are, as for `voronoi_cells`.

        Returns
        -------
        ndarray of float
            A number for each edge, infinite for a facet without an end.
        """
        low, high = box_corners(box, self.ndim)
        walls = address_if(low), address_if(high)
        with self._reading as t:
            measures = np.empty(count_of(lambda t, count: _edges(t, None, 0, count), t), F64)
            self._check(_voronoi_facets(t, *walls, address(measures), len(measures), ctypes.c_size_t()))
        return measures

    def voronoi_derivatives(self, mask: Any = None, *, box: Any = None, half_spaces: Any = None) -> VoronoiDerivatives:
        """The Voronoi facets of all edges, with derivatives of volumes by positions.

        The derivative of the volume of a cell by the position of another vertex is the sum over the edges between both. That by
        the position of its own vertex is minus the sum of the derivatives of the other cells by that position: an edge from a
        vertex to itself contributes nothing.

        Parameters
        ----------
        mask : array_like of bool, optional
            Edges with an end in it are asked for; all are by default. The others get NaN.
        box : (array_like, array_like), optional
            Where walls are, as for `voronoi_cells`; they stay when points move.
        half_spaces : array_like, (n, ndim + 1), optional
            Walls, as for `voronoi_cells`.

        Returns
        -------
        VoronoiDerivatives
            Measures, centroids and derivatives, in the order of `edges`; centroids are where the first vertex is at its point.
        """
        low, high = box_corners(box, self.ndim)
        planes = half_space_rows(half_spaces, self.ndim)
        chosen = None if mask is None else mask_of("mask", mask)
        with self._reading as t:
            given = vertex_mask(chosen, id_count(t))
            n, d = count_of(lambda t, count: _edges(t, None, 0, count), t), self.ndim
            facets = VoronoiDerivatives(np.full(n, np.nan), np.full((n, d), np.nan), np.full((n, 2, d), np.nan))
            rows = (address(array) for array in facets)
            walls = address_if(low), address_if(high), address(planes), len(planes)
            self._check(_voronoi_derivatives_within(t, *walls, *given, *rows, n, ctypes.c_size_t()))
        return facets

    def voronoi_cells_and_facets(
        self, mask: Any = None, *, box: Any = None, half_spaces: Any = None
    ) -> tuple[VoronoiCells, VoronoiDerivatives]:
        """What `voronoi_cells` and `voronoi_derivatives` give, in one call, with circumcentres computed once.

        Parameters
        ----------
        mask : array_like of bool, optional
            Ids of which the cells are asked for, and the facets of edges with an end there; all are by default.
        box : (array_like, array_like), optional
            Where walls are, as for `voronoi_cells`.
        half_spaces : array_like, (n, ndim + 1), optional
            Walls, as for `voronoi_cells`.

        Returns
        -------
        (VoronoiCells, VoronoiDerivatives)
            Those, to the last bit.
        """
        low, high = box_corners(box, self.ndim)
        planes = half_space_rows(half_spaces, self.ndim)
        chosen = None if mask is None else mask_of("mask", mask)
        with self._reading as t:
            walls = address_if(low), address_if(high), address(planes), len(planes)
            return cells_and_facets(self._check, t, self.ndim, walls, chosen)

    def voronoi_weight_derivatives(
        self, mask: Any = None, *, box: Any = None, half_spaces: Any = None
    ) -> VoronoiWeightDerivatives:
        """Areas or volumes of the Voronoi cells, and their derivatives by weights, at equal ones.

        Parameters
        ----------
        mask : array_like of bool, optional
            Ids of which the cells are asked for, and edges with an end there; all are by default. The others get NaN.
        box : (array_like, array_like), optional
            Where walls are, as for `voronoi_cells`.
        half_spaces : array_like, (n, ndim + 1), optional
            Walls, as for `voronoi_cells`.

        Returns
        -------
        VoronoiWeightDerivatives
            Volumes by id, and a derivative for each edge.
        """
        low, high = box_corners(box, self.ndim)
        planes = half_space_rows(half_spaces, self.ndim)
        chosen = None if mask is None else mask_of("mask", mask)
        with self._reading as t:
            walls = address_if(low), address_if(high), address(planes), len(planes)
            return weight_derivatives(self._check, t, walls, chosen)

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
        box = None if vectors is None else box_of(vectors, self.ndim)

        def change(t: int, report: Report) -> int:
            status = 0
            if box is not None:
                status = _stage_vectors(t, address(box), len(box))
            if status == 0 and positions is not None and moving is None:
                if self._trial is None:
                    return int(_commit_positions(t, address(positions), len(positions), report))
                if len(positions) != id_count(t):
                    raise WrongCount(
                        f"there are {len(positions)} points for {id_count(t)} ids", "points", None, len(positions)
                    )
                status = _move_vertices(t, None, address(positions), len(positions))
            if status == 0 and positions is not None and moving is not None:
                status = _move_vertices(t, address(moving), address(positions), len(moving))
            return status or self._commit(t, report)

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
            return int(status or self._commit(t, report))

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
            lambda t, report: int(_stage_removals(t, address(going), len(going)) or self._commit(t, report))
        )

    def trial(self) -> Trial:
        """Steps that are tried: at the end of a `with` block they are one timestamp, or, after an exception, have never been.

        In the block `move`, `insert` and `remove` make what everything that reads sees, and the timestamp stays.
        `Trial.withdraw` takes all of it back, so that another step can be tried. A step that fails in the block is taken
        back alone. The first step of the block takes a copy of the triangulation.

        Until the end of the block these raise `Prepared`, once a step has been made: `compact`, `changes`, `copy`, `save`
        and pickling.

        Returns
        -------
        Trial
            What has `withdraw`.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.PeriodicDelaunay([[0.1, 0.1], [0.6, 0.7], [0.4, 0.9]], vectors=[1, 1])
        >>> way = 0.25
        >>> with tri.trial() as trial:
        ...     while True:
        ...         _ = tri.move([[0.1 + way, 0.1]], ids=[0])
        ...         if tri.voronoi_volumes().min() > 0.24:
        ...             break
        ...         trial.withdraw()
        ...         way = way / 2
        >>> tri.points[0].round(3).tolist(), tri.timestamp
        ([0.225, 0.1], 1)
        """
        return Trial(self)

    def changes(self) -> Changes:
        """What has changed since this was last called; the first call lists all simplices as created.

        A simplex is its vertices with their shifts from each other. From the first call on those that stay keep their rows
        in `simplices`, unless they are listed as renumbered.

        Returns
        -------
        Changes
            Named arrays.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.PeriodicDelaunay([[0.1, 0.1], [0.6, 0.7], [0.4, 0.9]], vectors=[1, 1])
        >>> len(tri.changes().created)
        6
        >>> _ = tri.remove([2])
        >>> changes = tri.changes()
        >>> len(changes.removed) - len(changes.created)
        2
        """
        with self._taking as t:
            view = _library.ChangesView()
            self._check(_take_changes(t, view))
            return changes_of(view, self.ndim + 1)

    @overload
    def compact(self) -> np.ndarray: ...
    @overload
    def compact(self, values: Any) -> tuple[np.ndarray, Values]: ...
    def compact(self, values: Any = None) -> Union[np.ndarray, tuple[np.ndarray, Values]]:
        """Gives vertices the ids 0, 1, ... in the order of those that they have, and frees what removed ones used.

        Parameters
        ----------
        values : array_like or dict of array_like, optional
            Values by vertex id, to be renumbered as well.

        Returns
        -------
        ndarray of int
            The new id of each old one, -1 for removed vertices. Simplices may have other indices. With
            values these follow in a tuple: by the new ids.
        """
        given = given_values(values, lambda _, one: np.asarray(one))
        with self._changing as t:
            new_ids = np.empty(id_count(t), I32)
            for name, array in given.items():
                expect(name, array, len(new_ids), "ids")
            self._check(_compact(t, address(new_ids), len(new_ids), ctypes.c_size_t()))
        if values is None:
            return new_ids
        return new_ids, as_given(values, [array[new_ids >= 0] for array in given.values()])

    def _commit(self, t: int, report: Report) -> int:
        """Makes what is staged the next timestamp, or, in a trial, a round of it."""
        if self._trial is None:
            return int(_commit_timestamp(t, report))
        self._trial._may_be_prepared = True
        return int(_prepare_timestamp(t, report))

    def _change(self, change: Callable[[int, Report], int]) -> Report:
        """A change, which has no effect if it fails."""
        report = Report()
        with self._changing as t:
            try:
                status = change(t, report)
                self._check(status, positions="points", vertices="ids")
            except BaseException:
                check(_discard_moves(t))
                raise
            self._last_report = report
        return report

    def __repr__(self) -> str:
        return f"<deldrift.PeriodicDelaunay of {self.nvertices} points in {self.ndim}D, {self.nsimplex} simplices>"


def box_of(vectors: Any, ndim: int) -> np.ndarray:
    """The vectors of a box, a row for each."""
    given = array_of("vectors", vectors)
    if given.shape == (ndim,) and given.dtype.kind in "fiu":
        return np.diag(given.astype(F64))
    return point_rows("vectors", given, ndim)
