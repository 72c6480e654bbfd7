"""Segments of the plane, which have to be edges, and what they divide it into."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple, Optional

import numpy as np

from . import _library
from ._arrays import I32, address, array_of, check_output, ids, numbers, one_number, pairs, simplex_ids, whole
from ._arrays import mask as mask_of, points as point_rows
from ._core import PASSING, Core, cell_count, count_of, fixed
from ._errors import InvalidDimension, InvalidShape, InvalidValue, NoSuchSegment, WrongCount

_stage_segments = _library.function("stage_segments")
_stage_segment_removals = _library.function("stage_segment_removals")
_segments = _library.function("segments")
_check_staged = _library.function("check_staged")
_check_passings = _library.function("check_passings")
_stage_splits = _library.function("stage_splits")
_segments_of_cells = _library.function("segments_of_cells")
_cells_of_segments = _library.function("cells_of_segments")
_nesting_levels = _library.function("nesting_levels")
_crossing_numbers = _library.function("crossing_numbers")
_label_cells = _library.function("label_cells")
_update_labels = _library.function("update_labels")
_set_regions = _library.function("set_regions")
_set_segment_sides = _library.function("set_segment_sides")
_regions = _library.function("regions")
_boundary_chains = _library.function("boundary_chains")


class Segments(NamedTuple):
    """Segments, ascending by id."""

    ids: np.ndarray
    """Their ids."""
    ends: np.ndarray
    """Rows of two vertex ids, as they were given."""
    markers: np.ndarray
    """The number that was given with each, 0 by default."""


class Regions(NamedTuple):
    """The labels of regions, which follow them."""

    labels: np.ndarray
    """For each simplex that of its region."""
    undecided: int
    """How many simplices are in regions whose sides have several labels, or that are closed and have none."""


class Splits(NamedTuple):
    """What `Step.split` has staged."""

    vertices: np.ndarray
    """Ids of the vertices where segments cross."""
    pieces: np.ndarray
    """Ids of the pieces, by the ids of their segments, and along each of these."""
    replaced: int
    """How many segments pieces take the place of."""
    rounds: int
    """How often all that were in the way of each other were split. Along each axis a vertex is off its segment by at most
    so many halves of a last place of the segment's greatest coordinates."""


class Chains(NamedTuple):
    """A boundary in closed chains of edges, with the simplices that it bounds on the left."""

    vertices: np.ndarray
    """Where each edge begins: it goes to the vertex of the next one, the last edge of a chain to that of the first."""
    chains: np.ndarray
    """Which chain each edge is in: 0, 1, ..., ascending."""
    segments: np.ndarray
    """The segment at each, the lowest id if there are several; -1 for none."""
    markers: np.ndarray
    """The marker of that segment; 0 for none."""
    simplices: np.ndarray
    """The simplex of the mask beside each."""
    corners: np.ndarray
    """Which of its corners is opposite."""

    def loops(self) -> list[np.ndarray]:
        """The vertices of each chain: counter-clockwise around an outer boundary, clockwise around a hole.

        Returns
        -------
        list of ndarray
            An array of vertex ids for each chain.
        """
        return np.split(self.vertices, np.flatnonzero(np.diff(self.chains)) + 1) if len(self.vertices) else []


NO_SEGMENTS = Segments(fixed(np.empty(0, I32)), fixed(np.empty((0, 2), I32)), fixed(np.empty(0, I32)))


class Segmented(Core):
    """Segments of a triangulation."""

    @property
    def segments(self) -> Segments:
        """The segments in force, ascending by id: `ids`, `ends` and `markers`. Read-only; none in 3D.

        Each is an edge, and the simplices are the constrained Delaunay triangulation: the circle of a triangle has no
        vertex inside that can be seen from the triangle's inside, where segments are opaque. `add_segments`,
        `Step.add_segments` and the argument `segments` of `Delaunay` make them.

        Examples
        --------
        >>> import deldrift
        >>> points = [[0, 0], [4, 0], [4, 3], [0, 3], [2, 1]]
        >>> tri = deldrift.Delaunay(points, segments=[[0, 2]], segment_markers=[7])
        >>> tri.segments
        Segments(ids=array([0], dtype=int32), ends=array([[0, 2]], dtype=int32), markers=array([7], dtype=int32))
        """
        return self._once("segments", self._told_segments) if self.ndim == 2 else NO_SEGMENTS

    def _told_segments(self) -> Segments:
        with self._reading as t:
            count = ctypes.c_size_t()
            self._check(_segments(t, None, None, None, 0, count))
            n = count.value
            told, ends, markers = np.empty(n, I32), np.empty((n, 2), I32), np.empty(n, I32)
            self._check(_segments(t, address(told), address(ends), address(markers), n, count))
        return Segments(fixed(told), fixed(ends), fixed(markers))

    def _check_plane(self, argument: Optional[str] = None) -> None:
        if self.ndim != 2:
            raise InvalidDimension("there are segments in 2D alone, and the triangulation is one of 3D", argument)

    def _stage_segments(self, ends: Any, markers: Any, name: str, name_of_markers: str) -> np.ndarray:
        self._check_plane(name)
        rows = pairs(name, ends)
        values = None if markers is None else numbers(name_of_markers, markers, len(rows), "segments")
        with self._staging as t:
            first = ctypes.c_uint32()
            status = _stage_segments(
                t, address(rows), None if values is None else address(values), len(rows), ctypes.byref(first)
            )
            self._check(status, ends=(name, rows.shape))
        return np.arange(first.value, first.value + len(rows), dtype=I32)

    def _stage_segment_removals(self, segments: Any) -> None:
        self._check_plane("ids")
        listed = ids("ids", segments, NoSuchSegment)
        with self._staging as t:
            self._check(_stage_segment_removals(t, address(listed), len(listed)), segments="ids")

    def _check_staged(self) -> None:
        with self._committing as t:
            self._check(_check_staged(t))

    def _check_passings(self) -> None:
        self._check_plane()
        with self._committing as t:
            self._check(_check_passings(t))

    @property
    def passings(self) -> np.ndarray:
        """The vertices that pass segments in the step that was looked at last: a structured array with the fields
        `segment` and `vertex`, ascending. Read-only; none in 3D.

        With passing="tell" those that have passed in the last change; `Step.passings` tells before.

        Examples
        --------
        >>> import deldrift
        >>> points = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 2]]
        >>> tri = deldrift.Delaunay(points, segments=[[0, 2]], passing="tell")
        >>> tri.points[4].tolist(), tri.passings.tolist()
        ([1.0, 2.0], [])
        >>> report = tri.move(points[:4] + [[2, 1]])
        >>> tri.passings.tolist()
        [(0, 4)]
        """
        if self.ndim != 2:
            return fixed(np.empty(0, PASSING))
        with self._reading:
            return self._told_passings()

    def _stage_splits(self, limit: Any) -> Splits:
        self._check_plane()
        # Of all numbers that there can be of vertices, the greatest means any.
        most = _library.NONE if limit is None else whole("limit", limit)
        if most < 0:
            raise InvalidValue(f"limit is {most}, and must be 0 or more", "limit", None, most)
        report = _library.SplitReport()
        with self._committing as t:
            self._check(_stage_splits(t, min(most, _library.NONE), ctypes.byref(report)))
        return Splits(
            np.arange(report.first_vertex, report.first_vertex + report.inserted, dtype=I32),
            np.arange(report.first_piece, report.first_piece + report.pieces, dtype=I32),
            report.replaced_segments,
            report.rounds,
        )

    def segments_of_cells(self) -> np.ndarray:
        """The segment at each edge of each simplex.

        Returns
        -------
        ndarray of int
            Of the shape of `simplices`: the id of the segment opposite each corner, the lowest one if there are several
            at the edge, -1 if there is none.
        """
        self._check_plane()
        with self._reading as t:
            rows = np.empty((cell_count(t), 3), I32)
            self._check(_segments_of_cells(t, address(rows), len(rows), ctypes.c_size_t()))
        return rows

    def cells_of_segments(self) -> np.ndarray:
        """The simplices on both sides of each segment.

        Returns
        -------
        ndarray of int
            A row for each segment of `segments`: the simplex on the left, as seen from its first end along it, and that
            on the right; -1 for the outside, and for both while there are no simplices.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3]], segments=[[0, 1], [2, 1]])
        >>> tri.cells_of_segments()
        array([[ 0, -1],
               [-1,  0]], dtype=int32)
        """
        self._check_plane()
        with self._reading as t:
            count = count_of(lambda t, count: _segments(t, None, None, None, 0, count), t)
            rows = np.empty((count, 2), I32)
            self._check(_cells_of_segments(t, address(rows), len(rows), ctypes.c_size_t()))
        return rows

    def nesting_levels(self) -> np.ndarray:
        """How many segments at least a way crosses from each simplex to the outside.

        Returns
        -------
        ndarray of int
            0 outside of all closed chains of segments, 1 in a domain, 2 in its holes, 3 in islands in these, and so on.
            A segment with one region on both sides divides nothing.

        Examples
        --------
        >>> import deldrift
        >>> square, hole = [[0, 0], [4, 0], [4, 4], [0, 4]], [[1, 1], [3, 1], [2, 3]]
        >>> segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4]]
        >>> tri = deldrift.Delaunay(square + hole, segments=segments)
        >>> levels = tri.nesting_levels()
        >>> int((levels == 1).sum()), sorted(tri.simplices[levels == 2].tolist()[0])
        (7, [4, 5, 6])
        """
        self._check_plane()
        with self._reading as t:
            levels = np.empty(cell_count(t), I32)
            self._check(_nesting_levels(t, address(levels), len(levels), ctypes.c_size_t()))
        return levels

    def crossing_numbers(self) -> np.ndarray:
        """How many segments at least a way crosses from each simplex to the outside, where each of several at one edge counts.

        Returns
        -------
        ndarray of int
            Odd where the even-odd rule fills: of closed chains, all ways cross as many but for an even number. It differs
            from `nesting_levels` only where an edge has several segments.

        Examples
        --------
        >>> import deldrift
        >>> square, sides = [[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 1], [1, 2], [2, 3], [3, 0]]
        >>> tri = deldrift.Delaunay(square, segments=sides + sides)
        >>> tri.crossing_numbers().tolist(), tri.nesting_levels().tolist()
        ([2, 2], [1, 1])
        """
        self._check_plane()
        with self._reading as t:
            numbers = np.empty(cell_count(t), I32)
            self._check(_crossing_numbers(t, address(numbers), len(numbers), ctypes.c_size_t()))
        return numbers

    def label_cells(self, seeds: Any, labels: Any, other: int = 0) -> np.ndarray:
        """A label for each simplex: that of the first seed in its region.

        A region is what can be reached without crossing a segment. A seed on the boundary of several regions raises
        `AmbiguousSeed`.

        Parameters
        ----------
        seeds : array_like
            Rows of coordinates. One outside of the convex hull labels nothing.
        labels : array_like of int
            The label of each; any numbers of 32 bits.
        other : int, optional
            The label of simplices in whose region no seed is.

        Returns
        -------
        ndarray of int
            A label for each simplex.
        """
        self._check_plane()
        given = array_of("seeds", seeds)
        places = point_rows("seeds", given, 2) if given.size else np.empty((0, 2))
        values = numbers("labels", labels, len(places), "seeds")
        return self._labels_at(places, values, one_number("other", other), "seeds")

    def _labels_at(self, places: np.ndarray, values: np.ndarray, rest: int, name: str) -> np.ndarray:
        with self._reading as t:
            found, count = np.empty(cell_count(t), I32), ctypes.c_size_t()
            status = _label_cells(
                t, address(places), address(values), len(places), rest, address(found), len(found), count
            )
            self._check(status, positions=name, seeds=name)
        return found

    def set_regions(self, labels: Any) -> None:
        """Gives regions labels that follow them: `regions` tells the label of each simplex from then on.

        The sides of segments keep them, and hand them on to pieces: while vertices move, come and go, and through `refine`,
        `coarsen`, `copy`, `tobytes` and `save`, as long as no vertex passes a segment.

        Parameters
        ----------
        labels : array_like of int or None
            A number of 32 bits for each simplex, one for each region: such as `label_cells` or `nesting_levels` gives.
            None takes all labels away.

        Examples
        --------
        >>> import deldrift
        >>> square, free = [[0, 0], [4, 0], [4, 4], [0, 4]], [[3, 1], [3.5, 2]]
        >>> tri = deldrift.Delaunay(square + free, segments=[[0, 2], [0, 1], [1, 2], [2, 3], [3, 0]])
        >>> tri.set_regions(tri.label_cells([[2, 1], [1, 3]], [5, 6]))
        >>> report = tri.refine(greatest_area=0.5, domain="regions")
        >>> labels, undecided = tri.regions()
        >>> bool((labels == tri.label_cells([[2, 1], [1, 3]], [5, 6])).all()), undecided
        (True, 0)
        """
        self._check_plane()
        with self._changing as t:
            if labels is None:
                self._check(_set_regions(t, None, 0))
                return
            values = numbers("labels", labels, cell_count(t), "simplices")
            # Without simplices there are no regions, and no pointer would take labels away from sides.
            if len(values):
                self._check(_set_regions(t, address(values), len(values)))

    def set_segment_sides(self, segments: Any, sides: Any) -> None:
        """Gives the sides of segments labels, as `set_regions` does by those of simplices.

        Parameters
        ----------
        segments : array_like of int
            Ids of segments.
        sides : array_like of int
            For each the label on its left, as seen from its first end along it, and that on its right; -2147483648 for none.
        """
        self._check_plane()
        listed = ids("segments", segments)
        rows = array_of("sides", sides)
        if rows.shape != (len(listed), 2):
            raise InvalidShape(
                f"sides has the shape {rows.shape}, and must have two labels for each of {len(listed)} segments", "sides"
            )
        values = numbers("sides", rows.reshape(-1), 2 * len(listed), "labels")
        with self._changing as t:
            self._check(_set_segment_sides(t, address(listed), address(values), len(listed)))

    def regions(self, other: int = 0) -> Regions:
        """The label of the region of each simplex, as `set_regions` and `set_segment_sides` have given them.

        Parameters
        ----------
        other : int, optional
            The label where the sides of a region have none, or several.

        Returns
        -------
        Regions
            `labels`, and how many are `undecided`: then segments have been added or removed, or vertices have passed some.
        """
        self._check_plane()
        rest = one_number("other", other)
        with self._reading as t:
            labels, undecided = np.empty(cell_count(t), I32), ctypes.c_size_t()
            self._check(_regions(t, rest, address(labels), len(labels), ctypes.c_size_t(), undecided))
        return Regions(labels, undecided.value)

    def update_labels(self, simplices: Any, labels: np.ndarray, other: int = 0) -> int:
        """Computes entries of an array again that `label_cells` or `nesting_levels` gave, or that follows it.

        Each simplex listed gets the label of those that are not listed and that it is reached from without crossing a
        segment. So labels stay with their regions while segments stay, and no vertex passes one.

        Parameters
        ----------
        simplices : array_like of int
            Indices of simplices: those that `changes` tells as created, and those that have been turned over, whose
            rows list the corners in the other order around: these may have come to be beyond a segment.
        labels : ndarray of int32
            Entries of these are written; there must be one for each simplex, or more.
        other : int, optional
            The label of simplices that are reached from the outside of the convex hull alone, from listed ones alone,
            or from several labels.

        Returns
        -------
        int
            How many are reached from listed ones alone, or from several labels: if it is not 0, label anew.

        Examples
        --------
        >>> import deldrift
        >>> square, free = [[0, 0], [4, 0], [4, 4], [0, 4]], [[3, 1], [3.5, 2]]
        >>> tri = deldrift.Delaunay(square + free, segments=[[0, 2]])
        >>> labels, changes = tri.label_cells([[2, 1], [1, 3]], [5, 6]), tri.changes()
        >>> tri.remove(5)
        >>> changes, before = tri.changes(), labels
        >>> labels = before[: tri.nsimplex].copy()
        >>> labels[changes.renumbered_to] = before[changes.renumbered_from]
        >>> tri.update_labels(changes.created, labels)
        0
        >>> bool((labels == tri.label_cells([[2, 1], [1, 3]], [5, 6])).all())
        True
        """
        self._check_plane()
        listed = simplex_ids("simplices", simplices)
        rest, undecided = one_number("other", other), ctypes.c_size_t()
        with self._reading as t:
            check_output("labels", labels, I32, (cell_count(t),))
            status = _update_labels(t, address(listed), len(listed), rest, address(labels), len(labels), undecided)
            self._check(status, cells="simplices")
        return undecided.value

    def boundary_chains(self, mask: Any = None) -> Chains:
        """The boundary of the simplices in a mask, in closed chains of edges.

        Where parts of the mask touch in a vertex, each has a chain of its own: no chain crosses another, or itself.

        Parameters
        ----------
        mask : array_like of bool, optional
            Whether each simplex is in it; all are by default.

        Returns
        -------
        Chains
            Named arrays, with an entry for each edge.

        Examples
        --------
        >>> import deldrift
        >>> points = [[0, 0], [4, 0], [4, 3], [0, 3], [2, 1]]
        >>> tri = deldrift.Delaunay(points, segments=[[1, 0]], segment_markers=[7])
        >>> chains = tri.boundary_chains()
        >>> chains.vertices.tolist(), chains.markers.tolist()
        ([0, 1, 2, 3], [7, 0, 0, 0])
        """
        self._check_plane()
        chosen = None if mask is None else mask_of("mask", mask)
        markers_of = self.segments
        with self._reading as t:
            cells = cell_count(t)
            if chosen is None:
                chosen = np.ones(cells, np.bool_)
            if len(chosen) != cells:
                raise WrongCount(
                    f"mask has {len(chosen)} entries, and there are {cells} simplices", "mask", None, len(chosen)
                )
            count = ctypes.c_size_t()
            nothing = (None,) * 5
            self._check(_boundary_chains(t, address(chosen), cells, *nothing, 0, count))
            n = count.value
            vertices, chains, segments, simplices = (np.empty(n, I32) for _ in range(4))
            corners = np.empty(n, np.uint8)
            arrays = [address(array) for array in (vertices, chains, segments, simplices, corners)]
            self._check(_boundary_chains(t, address(chosen), cells, *arrays, n, count))
        return Chains(vertices, chains, segments, _markers_at(segments, markers_of), simplices, corners)


def _markers_at(segments: np.ndarray, of: Segments) -> np.ndarray:
    """The marker of each of some segments, 0 for -1."""
    markers = np.zeros(len(segments), I32)
    is_one = segments >= 0
    markers[is_one] = of.markers[np.searchsorted(of.ids, segments[is_one])]
    return markers
