"""What is near places, and values there: of open and of periodic triangulations."""

from __future__ import annotations

import ctypes
from typing import Any, Optional

import numpy as np

from . import _library
from ._arrays import F64, I32, address, address_if, answered, choice, contiguous, floats, mask as mask_of, one_point
from ._arrays import places, real, simplex_of_each, whole
from ._core import Core, count_of, id_count
from ._errors import InvalidShape, InvalidValue, WrongCount

_vertex_count = _library.function("vertex_count")
_nearest_vertices = _library.function("nearest_vertices")
_vertices_in_ball = _library.function("vertices_in_ball")
_vertices_in_box = _library.function("vertices_in_box")
_neighbour_lists = _library.function("neighbour_lists")
_conflicts = _library.function("conflicts")
_barycentric = _library.function("barycentric")
_interpolate = _library.function("interpolate")


class Near(Core):
    """What is near places, and values there."""

    def _simplices_at(self, rows: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
        """The simplex that each point is in, -1 where there is none; `shape` is that of the points as they were given."""
        raise NotImplementedError

    def nearest_vertices(self, xi: Any, k: Optional[int] = None, *, nan_policy: str = "raise") -> np.ndarray:
        """The vertices nearest to points, by distance, compared exactly, and at the same distance by id.

        In a periodic box each vertex counts once, by its nearest image.

        Parameters
        ----------
        xi : array_like
            Points; the last axis has the coordinates.
        k : int, optional
            How many for each point. By default the nearest one, without an axis of its own in the result.
        nan_policy : {"raise", "omit"}, optional
            As of `find_simplex`; with "omit" points with NaN get -1.

        Returns
        -------
        ndarray of int
            Their ids, -1 where there are fewer vertices.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3]])
        >>> tri.nearest_vertices([[1, 1], [3, 3]])
        array([0, 2], dtype=int32)
        >>> tri.nearest_vertices([[1, 1], [3, 3]], k=2)
        array([[0, 3],
               [2, 3]], dtype=int32)
        """
        rows, shape = places("xi", xi, self.ndim)
        width = 1 if k is None else whole("k", k)
        if width < 0:
            raise InvalidValue(f"k is {width}, and must be 0 or more", "k", None, width)

        def ask(rows: np.ndarray) -> np.ndarray:
            found = np.empty((len(rows), width), I32)
            with self._reading as t:
                status = _nearest_vertices(t, address(rows), len(rows), width, address(found))
                self._check(status, positions=("xi", shape))
            return found

        found = answered(rows, nan_policy, ask, -1)
        return found.reshape(shape if k is None else shape + (width,))

    def vertices_in_ball(self, centre: Any, squared_radius: float) -> np.ndarray:
        """The vertices whose squared distance from a point is at most a given one, exactly.

        In a periodic box a vertex is listed, once, if any image of it is that near.

        Parameters
        ----------
        centre : array_like
            The point.
        squared_radius : float
            The square of the radius.

        Returns
        -------
        ndarray of int
            Their ids, ascending, hidden ones included.
        """
        position, limit = one_point("centre", centre, self.ndim), real("squared_radius", squared_radius)
        with self._reading as t:
            found, count = np.empty(count_of(_vertex_count, t), I32), ctypes.c_size_t()
            status = _vertices_in_ball(t, address(position), limit, address(found), len(found), count)
            self._check(status, squared_radius="squared_radius!", centre="centre!")
        return np.array(found[: count.value])

    def neighbor_lists(self, squared_radius: Any, half: bool = False, mask: Any = None) -> tuple[np.ndarray, np.ndarray]:
        """For each vertex the others whose squared distance from it is at most a given one, exactly, in one call.

        Parameters
        ----------
        squared_radius : float or array_like of float
            The square of the radius of all lists, or of that of each id.
        half : bool, optional
            Whether each pair comes once, in the list of the lower id: two vertices are a pair if either is in the full list of
            the other.
        mask : array_like of bool, optional
            By id, which vertices have lists; all by default. A half list has all vertices that are near and have none.

        Returns
        -------
        indptr, indices : ndarray of int
            The neighbours of vertex k are ``indices[indptr[k]:indptr[k + 1]]``, ascending, hidden ones included.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [0, 4], [4, 4]])
        >>> indptr, indices = tri.neighbor_lists(16)
        >>> indptr, indices
        (array([0, 2, 4, 6, 8]), array([1, 2, 0, 3, 0, 3, 1, 2], dtype=int32))
        >>> tri.neighbor_lists(16, half=True)[1]
        array([1, 2, 3, 3], dtype=int32)
        """
        return self._lists(squared_radius, half, mask, 0)[:2]

    def _lists(self, squared_radius: Any, half: bool, mask: Any, width: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Lists of neighbours, with rows of so many numbers that say in which period they are."""
        radii = np.atleast_1d(floats("squared_radius", squared_radius))
        if radii.ndim != 1:
            raise InvalidShape(f"squared_radius has the shape {radii.shape}, and must be one number, or one for each id")
        chosen = None if mask is None else mask_of("mask", mask)
        given = (address(radii), len(radii), address_if(chosen), 0 if chosen is None else len(chosen), int(bool(half)))
        with self._reading as t:
            indptr, count = np.empty(id_count(t) + 1, np.intp), ctypes.c_size_t()
            # Memory that is not written to is none.
            room = 32 * count_of(_vertex_count, t) + 32
            while True:
                indices, shifts = np.empty(room, I32), np.empty((room, width), np.int64)
                to = (address(indptr), len(indptr), address(indices), address(shifts) if width else None, room)
                status = _neighbour_lists(t, *given, *to, count)
                if not status or count.value <= room:
                    break
                room = count.value
            self._check(status, squared_radii="squared_radius", radius_count="squared_radius", mask_count="mask")
        return indptr, indices[: count.value], shifts[: count.value]

    def vertices_in_box(self, low: Any, high: Any) -> np.ndarray:
        """The vertices in a box, boundary included.

        In a periodic box a vertex is listed, once, if any image of it is there.

        Parameters
        ----------
        low, high : array_like
            Its corners of least and of greatest coordinates, which may be infinite.

        Returns
        -------
        ndarray of int
            Their ids, ascending, hidden ones included.
        """
        least, greatest = one_point("low", low, self.ndim), one_point("high", high, self.ndim)
        with self._reading as t:
            found, count = np.empty(count_of(_vertex_count, t), I32), ctypes.c_size_t()
            self._check(_vertices_in_box(t, address(least), address(greatest), address(found), len(found), count))
        return np.array(found[: count.value])

    def conflicts(self, point: Any) -> np.ndarray:
        """The simplices that inserting a point would remove: those whose circumsphere has it inside.

        In a periodic box they are those that inserting all images of the point would remove, each once; the point must be in the
        convex hull.

        Parameters
        ----------
        point : array_like
            The point.

        Returns
        -------
        ndarray of int
            Their indices, in no particular order.
        """
        position = one_point("point", point, self.ndim)
        with self._reading as t:
            count = ctypes.c_size_t()
            self._check(_conflicts(t, address(position), None, None, 0, count), position="point!")
            cells = np.empty(count.value, I32)
            self._check(_conflicts(t, address(position), None, address(cells), len(cells), count), position="point!")
        return cells

    def barycentric(self, xi: Any, simplices: Any = None, *, nan_policy: str = "raise") -> np.ndarray:
        """The barycentric coordinates of points, each in a simplex.

        In a periodic box they are those in the translation of the simplex that has the point, NaN where there is none.

        Parameters
        ----------
        xi : array_like
            Points; the last axis has the coordinates.
        simplices : array_like of int, optional
            The simplex of each; by default the one that it is in.
        nan_policy : {"raise", "omit"}, optional
            As of `find_simplex`; with "omit" coordinates of points with NaN are NaN.

        Returns
        -------
        ndarray
            A row for each point: a number for each corner, with the right sign; NaN where the simplex is -1.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [0, 4]])
        >>> tri.barycentric([[1, 1], [4, 4]])
        array([[0.5 , 0.25, 0.25],
               [ nan,  nan,  nan]])
        """
        rows, shape = places("xi", xi, self.ndim)
        given = None if simplices is None else simplex_of_each("simplices", simplices, len(rows))

        def ask(rows: np.ndarray) -> np.ndarray:
            cells = self._simplices_at(rows, shape) if given is None else given
            weights = np.empty((len(rows), self.ndim + 1), F64)
            with self._reading as t:
                status = _barycentric(t, address(rows), address(cells), len(rows), address(weights))
                self._check(status, positions=("xi", shape), cells=("simplices", cells.shape))
            return weights

        return answered(rows, nan_policy, ask, np.nan).reshape(shape + (self.ndim + 1,))

    def interpolate(
        self, values: Any, xi: Any, method: str = "linear", fill_value: Any = np.nan, *, nan_policy: str = "raise"
    ) -> np.ndarray:
        """Values of the vertices, interpolated at other places.

        Parameters
        ----------
        values : array_like
            A number, or a row of them, for each id. Those of hidden and of removed vertices are not used.
        xi : array_like
            Points; the last axis has the coordinates.
        method : {"linear", "natural"}, optional
            Linear in each simplex, or by natural neighbours (Laplace's, or non-Sibsonian, interpolation), which are images
            in a periodic box.
        fill_value : float or array_like, optional
            What points outside the convex hull get.
        nan_policy : {"raise", "omit"}, optional
            As of `find_simplex`; with "omit" points with NaN get NaN.

        Returns
        -------
        ndarray
            Of the shape of xi without its last axis, and with that of a row of values.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [0, 4]])
        >>> tri.interpolate([0, 4, 8], [[1, 1], [5, 5]])
        array([ 3., nan])
        """
        number = choice("method", method, _library.INTERPOLATIONS)
        given = floats("values", values)
        if given.ndim == 0:
            raise InvalidShape("values is a single number, and must have an entry for each id", "values")
        rows, shape = places("xi", xi, self.ndim)
        width = int(np.prod(given.shape[1:], dtype=np.intp))
        outside = _fill("fill_value", fill_value, given.shape[1:])

        def ask(rows: np.ndarray) -> np.ndarray:
            results = np.empty((len(rows), width), F64)
            with self._reading as t:
                if len(given) != id_count(t):
                    raise WrongCount(
                        f"values has {len(given)} entries, and there are {id_count(t)} ids", "values", None, len(given)
                    )
                known, asked = (address(given), len(given), width), (address(rows), len(rows), None)
                status = _interpolate(t, number, *known, *asked, address(outside), address(results))
                self._check(status, positions=("xi", shape), value_count="values")
            return results

        results = answered(rows, nan_policy, ask, np.nan)
        return results.reshape(shape + given.shape[1:])


def _fill(argument: str, value: Any, shape: tuple[int, ...]) -> np.ndarray:
    given = floats(argument, value)
    try:
        return contiguous(np.broadcast_to(given, shape), F64).reshape(-1)
    except ValueError:
        raise InvalidShape(f"{argument} has the shape {given.shape}, and must be a number or {shape}", argument) from None
