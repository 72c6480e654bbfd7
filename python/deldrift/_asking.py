"""Questions about places, vertices, and the triangulation itself."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple, Optional

import numpy as np

from . import _library
from ._arrays import (
    F64,
    I32,
    address,
    address_if,
    answered,
    floats,
    mask as mask_of,
    one_id,
    places,
    points as point_rows,
    whole,
)
from ._core import check, count_of, id_count
from ._errors import InvalidDimension, InvalidShape, WrongCount
from ._scipy import Scipy

_vertex_count = _library.function("vertex_count")
_memory_bytes = _library.function("memory_bytes")
_keys = _library.function("keys")
_is_present = _library.function("is_present")
_star = _library.function("star")
_ordered_star = _library.function("ordered_star")
_locate_points = _library.function("locate_points")
_cells_in_reach = _library.function("cells_in_reach")
_hull_facets_in_reach = _library.function("hull_facets_in_reach")
_vertices_in_reach = _library.function("vertices_in_reach")
_id_count = _library.function("id_count")
_orientation = _library.function("orientation")
_in_sphere = _library.function("in_sphere")
_in_power_sphere = _library.function("in_power_sphere")
_coincident_representative = _library.function("coincident_representative")


class Locations(NamedTuple):
    """Where points lie."""

    kinds: np.ndarray
    """0 at a vertex, 1 in a simplex or on its boundary, 2 outside the convex hull, 3 where there are no simplices."""
    indices: np.ndarray
    """The vertex; the simplex; one with a facet on the hull that faces the point; -1."""


class Reach(NamedTuple):
    """What a vertex in one of some boxes could change."""

    simplices: np.ndarray
    """The simplices whose circumspheres, with their insides, meet a box: ascending."""
    centres: np.ndarray
    """For each the centre of a ball that certainly has its circumsphere inside."""
    radii: np.ndarray
    """The radius of that ball; infinite where numbers do not suffice."""
    hull_simplices: np.ndarray
    """The simplex of each facet of the convex hull that a place of a box is strictly beyond."""
    hull_corners: np.ndarray
    """Which of its corners is opposite the facet."""


class Asking(Scipy):
    """Questions about places, vertices, and the triangulation itself."""

    @property
    def nvertices(self) -> int:
        """The number of vertices that are present, hidden ones included and removed ones not."""
        with self._reading as t:
            return count_of(_vertex_count, t)

    @property
    def nbytes(self) -> int:
        """The bytes of memory that the library holds for the triangulation."""
        with self._reading as t:
            return count_of(_memory_bytes, t)

    def is_present(self, vertex: int) -> bool:
        """Whether there is a vertex of an id: False if it has been removed, or never was.

        Parameters
        ----------
        vertex : int
            The id.

        Returns
        -------
        bool
            Whether it is there.
        """
        number = whole("vertex", vertex)
        if not 0 <= number < _library.NONE:
            return False
        with self._reading as t:
            present = ctypes.c_bool()
            self._check(_is_present(t, number, present))
        return present.value

    @property
    def keys(self) -> np.ndarray:
        """The key of each id, by which ties are broken: the id unless another was given, and 0 if it was removed."""
        with self._reading as t:
            count = ctypes.c_size_t()
            keys = np.empty(id_count(t), np.uint64)
            self._check(_keys(t, address(keys), len(keys), count))
        return keys

    def representative(self, vertex: int) -> int:
        """The vertex of the lowest key, and then of the lowest id, at the place of one: the corner of simplices there.

        Of `Regular` it is that of the greatest weight, and of these the one of the lowest key. It may be hidden by
        weight.

        Parameters
        ----------
        vertex : int
            The id.

        Returns
        -------
        int
            Its own id, unless the vertex is hidden.
        """
        number = one_id("vertex", vertex)
        with self._reading as t:
            found = ctypes.c_uint32()
            self._check(_coincident_representative(t, number, found), vertex="vertex!")
        return found.value

    def star(self, vertex: int, ordered: bool = False) -> np.ndarray:
        """The simplices that have a vertex as a corner.

        Parameters
        ----------
        vertex : int
            The id; for a hidden vertex that of its representative counts.
        ordered : bool, optional
            Whether they are in the order in which one goes around the vertex, counter-clockwise: in 2D only.

        Returns
        -------
        ndarray of int
            Their indices.
        """
        number = one_id("vertex", vertex)
        if ordered and self.ndim != 2:
            raise InvalidDimension(
                "ordered is true, and only in the plane do simplices around a vertex have an order", "ordered"
            )
        function = _ordered_star if ordered else _star
        with self._reading as t:
            count = ctypes.c_size_t()
            self._check(function(t, number, None, 0, count), vertex="vertex!")
            cells = np.empty(count.value, I32)
            self._check(function(t, number, address(cells), len(cells), count), vertex="vertex!")
        return cells

    def locate(self, xi: Any, *, nan_policy: str = "raise") -> Locations:
        """Where points lie, exactly.

        Parameters
        ----------
        xi : array_like
            Points; the last axis has the coordinates.
        nan_policy : {"raise", "omit"}, optional
            As of `find_simplex`; with "omit" kind and index of points with NaN are -1.

        Returns
        -------
        Locations
            A kind and an index for each.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [0, 4]])
        >>> tri.locate([[4, 0], [1, 1], [3, 3]])
        Locations(kinds=array([0, 1, 2], dtype=int32), indices=array([1, 0, 0], dtype=int32))
        """
        rows, shape = places("xi", xi, self.ndim)

        def ask(rows: np.ndarray) -> np.ndarray:
            locations = np.empty((len(rows), 2), I32)
            with self._reading as t:
                status = _locate_points(t, address(rows), len(rows), None, address(locations))
                self._check(status, positions=("xi", shape))
            return locations

        locations = answered(rows, nan_policy, ask, -1)
        return Locations(locations[:, 0].reshape(shape), locations[:, 1].reshape(shape))

    def _boxes(self, low: Any, high: Any) -> tuple[np.ndarray, np.ndarray]:
        """The corners of boxes, a row for each."""
        (least, rows), (greatest, others) = places("low", low, self.ndim), places("high", high, self.ndim)
        if rows != others:
            of_high, of_low = (*others, self.ndim), (*rows, self.ndim)
            raise InvalidShape(f"high has the shape {of_high}, and low {of_low}", "high")
        return least, greatest

    def _mask_of_vertices(self, t: Any, mask: Any) -> Optional[np.ndarray]:
        """Whether each vertex id is in a mask; None for no mask."""
        if mask is None:
            return None
        chosen, n = mask_of("mask", mask), count_of(_id_count, t)
        if len(chosen) != n:
            raise WrongCount(f"mask has {len(chosen)} entries, and there are {n} vertex ids", "mask", None, len(chosen))
        return chosen

    def simplices_in_reach(self, low: Any, high: Any, mask: Any = None) -> Reach:
        """The simplices and facets of the convex hull that a vertex in one of some boxes could change, exactly.

        With weights the vertex may have any weight up to the greatest that there is, or up to 0.

        Parameters
        ----------
        low, high : array_like
            Corners of least and of greatest coordinates, which may be infinite: of one box, or a row for each.
        mask : array_like of bool, optional
            For each vertex id whether simplices and facets with a corner at its place count; all do by default.

        Returns
        -------
        Reach
            Simplices, with balls that certainly cover their circumspheres, and facets of the hull.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3]])
        >>> reach = tri.simplices_in_reach([-9, 1], [-0.6, 2])
        >>> len(reach.simplices), len(reach.hull_simplices)
        (0, 1)
        >>> len(tri.simplices_in_reach([-9, 1], [-0.5, 2]).simplices)  # It touches the circle.
        2
        """
        least, greatest = self._boxes(low, high)
        with self._reading as t:
            chosen = self._mask_of_vertices(t, mask)
            n_masked = 0 if chosen is None else len(chosen)
            given = (address(least), address(greatest), len(least), address_if(chosen), n_masked)
            count = ctypes.c_size_t()
            self._check(_cells_in_reach(t, *given, None, None, None, 0, count))
            n = count.value
            cells, centres, radii = np.empty(n, I32), np.empty((n, self.ndim), F64), np.empty(n, F64)
            self._check(_cells_in_reach(t, *given, address(cells), address(centres), address(radii), n, count))
            self._check(_hull_facets_in_reach(t, *given, None, None, 0, count))
            n = count.value
            hull, corners = np.empty(n, I32), np.empty(n, np.uint8)
            self._check(_hull_facets_in_reach(t, *given, address(hull), address(corners), n, count))
        return Reach(cells, centres, radii, hull, corners)

    def vertices_in_reach(self, low: Any, high: Any, mask: Any = None) -> tuple[np.ndarray, np.ndarray]:
        """For each of some boxes the vertices of the simplices and hull facets in its reach, hidden ones included.

        Parameters
        ----------
        low, high : array_like
            Corners of least and of greatest coordinates, which may be infinite: of one box, or a row for each.
        mask : array_like of bool, optional
            For each vertex id whether it counts; all do by default.

        Returns
        -------
        offsets : ndarray of int
            Where the list of each box begins, and where the last one ends.
        vertices : ndarray of int
            The lists, each ascending. While there are no simplices, all vertices of the mask for each box.
        """
        least, greatest = self._boxes(low, high)
        with self._reading as t:
            chosen = self._mask_of_vertices(t, mask)
            n_masked = 0 if chosen is None else len(chosen)
            given = (address(least), address(greatest), len(least), address_if(chosen), n_masked)
            count = ctypes.c_size_t()
            self._check(_vertices_in_reach(t, *given, None, None, 0, count))
            offsets, vertices = np.empty(len(least) + 1, np.uintp), np.empty(count.value, I32)
            status = _vertices_in_reach(t, *given, address(vertices), address(offsets), len(vertices), count)
            self._check(status)
        return offsets.astype(np.intp), vertices


def orientation(points: Any) -> int:
    """The orientation of 3 points of the plane or 4 points of space, exactly.

    Parameters
    ----------
    points : array_like
        A row of coordinates for each.

    Returns
    -------
    int
        1 if they are oriented as simplices are (counter-clockwise in the plane), -1 if not, 0 on a line or plane.

    Examples
    --------
    >>> import deldrift
    >>> deldrift.orientation([[0, 0], [1, 0], [0, 1]])
    1
    """
    return _sign(_orientation, points, 1)


def in_sphere(points: Any) -> int:
    """Whether a point is in the circle or sphere through others, exactly.

    Parameters
    ----------
    points : array_like
        A row of coordinates for each of 3 points of the plane or 4 of space, of orientation 1, and of the one that is
        asked about.

    Returns
    -------
    int
        1 inside, -1 outside, 0 on the circle or sphere.

    Examples
    --------
    >>> import deldrift
    >>> deldrift.in_sphere([[0, 0], [1, 0], [0, 1], [1, 1]])
    0
    """
    return _sign(_in_sphere, points, 2)


def in_power_sphere(points: Any, weights: Any) -> int:
    """Whether a point with a weight is in the power circle or power sphere of others, exactly.

    The power of a place x to a point p of weight w is |x - p|^2 - w. The centre of the power sphere has one power to all of
    its points, and a point is inside if the centre has a lower one to it. With equal weights this is `in_sphere`.

    Parameters
    ----------
    points : array_like
        Rows as for `in_sphere`.
    weights : array_like
        A number for each, of magnitude up to 1e114: the square of the radius of a circle or sphere around the point.

    Returns
    -------
    int
        1 inside, -1 outside, 0 on the power circle or power sphere.

    Examples
    --------
    >>> import deldrift
    >>> deldrift.in_power_sphere([[1, 0], [0, 1], [-1, 0], [3, 0]], [0, 0, 0, 8])
    0
    """
    return _sign(_in_power_sphere, points, 2, floats("weights", weights))


def _sign(function: Any, values: Any, more: int, *weights: np.ndarray) -> int:
    rows = point_rows("points", values)
    ndim = rows.shape[1]
    if len(rows) != ndim + more:
        raise WrongCount(
            f"points has {len(rows)} rows, and must have {ndim + more} in {ndim}D", "points", None, len(rows)
        )
    for own in weights:
        if own.ndim != 1:
            raise InvalidShape(f"weights has the shape {own.shape}, and must be a list", "weights")
        if len(own) != len(rows):
            raise WrongCount(f"weights has {len(own)} entries, and there are {len(rows)} points", "weights", None, len(own))
    sign = ctypes.c_int32()
    check(function(ndim, address(rows), *map(address, weights), sign))
    return sign.value
