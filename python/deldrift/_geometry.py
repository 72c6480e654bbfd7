"""Geometry in bulk, and questions about places and vertices."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np

from . import _library
from ._arrays import (
    F64,
    I32,
    address,
    address_if,
    box_corners,
    check_output,
    choice,
    contiguous,
    floats,
    half_space_rows,
    ids,
    mask as mask_of,
    places,
    real,
    simplex_ids,
)
from ._core import cell_count, count_of, id_count
from ._scipy import Scipy
from ._errors import InvalidShape, WrongCount

_mask_without_flat_cells = _library.function("mask_without_flat_cells")
_circumcentres = _library.function("circumcentres")
_volumes = _library.function("volumes")
_mask_by_circumradius = _library.function("mask_by_circumradius")
_mask_boundary = _library.function("mask_boundary")
_hull_facets = _library.function("hull_facets")
_edges = _library.function("edges")
_vertex_cells = _library.function("vertex_cells")
_mirror_indices = _library.function("mirror_indices")
_cells_around = _library.function("cells_around")
_update_circumcentres = _library.function("update_circumcentres")
_update_volumes = _library.function("update_volumes")
_update_mask_by_circumradius = _library.function("update_mask_by_circumradius")
_voronoi_volumes = _library.function("voronoi_volumes")
_voronoi_facets = _library.function("voronoi_facets")
_voronoi_changed = _library.function("voronoi_changed")
_voronoi_cells_within = _library.function("voronoi_cells_within")
_voronoi_derivatives_within = _library.function("voronoi_derivatives_within")
_interpolate = _library.function("interpolate")


class Boundary(NamedTuple):
    """Facets between simplices of a mask and what is outside of it."""

    facets: np.ndarray
    """Rows of 2 or 3 vertex ids, seen from outside."""
    simplices: np.ndarray
    """The simplex of the mask at each."""
    corners: np.ndarray
    """Which of its corners is opposite the facet."""


class VoronoiCells(NamedTuple):
    """What there is of Voronoi cells in a box, by vertex id."""

    volumes: np.ndarray
    """Areas or volumes: 0 for hidden vertices, NaN for removed ones."""
    areas: np.ndarray
    """Lengths or areas of the boundaries."""
    centroids: np.ndarray
    """Rows of coordinates; NaN where the volume is 0."""


class VoronoiDerivatives(NamedTuple):
    """Voronoi facets in a box, in the order of `edges`."""

    measures: np.ndarray
    """Lengths or areas."""
    centroids: np.ndarray
    """Rows of coordinates; NaN where the measure is 0."""
    derivatives: np.ndarray
    """For the edge of i and j the derivative of the volume of the cell of i by the position of j, and that of the cell
    of j by the position of i: of shape (edges, 2, ndim)."""


class Geometry(Scipy):
    """Geometry in bulk."""

    def mask_without_flat(self, tolerance: float) -> np.ndarray:
        """Which simplices are more than what the rounding of a straight or flat side has made.

        Parameters
        ----------
        tolerance : float
            A simplex is flat if its least height is at most this part of its longest edge, such as 1e-9.

        Returns
        -------
        ndarray of bool
            False for simplices along the hull that are flat. `boundary` of it gives the sides as they were meant.
        """
        limit = real("tolerance", tolerance)
        with self._reading as t:
            mask, count = np.empty(cell_count(t), np.bool_), ctypes.c_size_t()
            self._check(_mask_without_flat_cells(t, limit, address(mask), len(mask), count), tolerance="tolerance!")
        return mask

    def volumes(self) -> np.ndarray:
        """The areas or volumes of the simplices, always positive.

        Returns
        -------
        ndarray
            A number for each simplex, with a relative error of at most 1e-9.

        Examples
        --------
        >>> import deldrift
        >>> deldrift.Delaunay([[0, 0], [4, 0], [0, 3]]).volumes()
        array([6.])
        """
        with self._reading as t:
            volumes = np.empty(cell_count(t), F64)
            count = ctypes.c_size_t()
            self._check(_volumes(t, address(volumes), len(volumes), count))
        return volumes

    def circumcentres(self) -> tuple[np.ndarray, np.ndarray]:
        """The circumcentres and squared circumradii of the simplices.

        Returns
        -------
        centres : ndarray
            A row for each simplex, off by at most 1e-9 circumradii.
        squared_radii : ndarray
            A number for each simplex.
        """
        with self._reading as t:
            centres = np.empty((cell_count(t), self.ndim), F64)
            squared_radii = np.empty(len(centres), F64)
            count = ctypes.c_size_t()
            self._check(_circumcentres(t, address(centres), address(squared_radii), len(centres), count))
        return centres, squared_radii

    def alpha_mask(self, squared_radius: float) -> np.ndarray:
        """Which simplices have a circumradius of at most a given one, exactly: those of an alpha shape.

        Parameters
        ----------
        squared_radius : float
            Its square.

        Returns
        -------
        ndarray of bool
            Whether, for each simplex.
        """
        limit = real("squared_radius", squared_radius)
        with self._reading as t:
            mask = np.empty(cell_count(t), np.bool_)
            count = ctypes.c_size_t()
            self._check(
                _mask_by_circumradius(t, limit, address(mask), len(mask), count), squared_radius="squared_radius!"
            )
        return mask

    def boundary(self, mask: Any = None) -> Boundary:
        """The facets between simplices in a mask and those not in it, or the outside.

        Parameters
        ----------
        mask : array_like of bool, optional
            Whether each simplex is in it; all are by default.

        Returns
        -------
        Boundary
            Facets, seen from outside, with the simplex and the corner of each.
        """
        chosen = None if mask is None else mask_of("mask", mask)
        with self._reading as t:
            count = ctypes.c_size_t()
            if chosen is not None and len(chosen) != cell_count(t):
                message = f"mask has {len(chosen)} entries, and there are {cell_count(t)} simplices"
                raise WrongCount(message, "mask", None, len(chosen))

            def fill(facets: Any, cells: Any, corners: Any, capacity: int) -> None:
                if chosen is None:
                    status = _hull_facets(t, facets, cells, corners, capacity, count)
                else:
                    status = _mask_boundary(t, address(chosen), len(chosen), facets, cells, corners, capacity, count)
                self._check(status)

            fill(None, None, None, 0)
            facets = np.empty((count.value, self.ndim), I32)
            cells, corners = np.empty(count.value, I32), np.empty(count.value, np.uint8)
            fill(address(facets), address(cells), address(corners), len(cells))
        return Boundary(facets, cells, corners)

    def edges(self) -> np.ndarray:
        """The edges: rows of two vertex ids, the lower one first, in lexicographic order.

        Returns
        -------
        ndarray of int
            Each edge once.
        """
        with self._reading as t:
            edges = np.empty((count_of(lambda t, count: _edges(t, None, 0, count), t), 2), I32)
            count = ctypes.c_size_t()
            self._check(_edges(t, address(edges), len(edges), count))
        return edges

    def vertex_simplices(self) -> tuple[np.ndarray, np.ndarray]:
        """The simplices around each vertex: `indices[indptr[k]:indptr[k + 1]]`, ascending, for vertex k.

        Returns
        -------
        indptr, indices : ndarray of int
            As of `vertex_neighbor_vertices`.
        """
        with self._reading as t:
            indptr, indices = np.empty(id_count(t) + 1, I32), np.empty(cell_count(t) * (self.ndim + 1), I32)
            count = ctypes.c_size_t()
            self._check(_vertex_cells(t, address(indptr), len(indptr), address(indices), len(indices), count))
        return indptr, indices

    def mirror_indices(self) -> np.ndarray:
        """For each facet the corner of the simplex beyond that is opposite to it, 255 on the hull.

        Returns
        -------
        ndarray of uint8
            Of the shape of `neighbors`.
        """
        with self._reading as t:
            mirrors = np.empty((cell_count(t), self.ndim + 1), np.uint8)
            count = ctypes.c_size_t()
            self._check(_mirror_indices(t, address(mirrors), len(mirrors), count))
        return mirrors

    def simplices_around(self, vertices: Any) -> np.ndarray:
        """The simplices of which at least one of some vertices is a corner.

        Parameters
        ----------
        vertices : array_like of int
            Ids.

        Returns
        -------
        ndarray of int
            Their indices, ascending, each once.
        """
        listed = ids("vertices", vertices)
        with self._reading as t:
            count = ctypes.c_size_t()
            names = {"vertices": "vertices", "vertex": "vertices"}
            self._check(_cells_around(t, address(listed), len(listed), None, 0, count), **names)
            cells = np.empty(count.value, I32)
            self._check(_cells_around(t, address(listed), len(listed), address(cells), len(cells), count), **names)
        return cells

    def update_volumes(self, simplices: Any, volumes: np.ndarray) -> None:
        """Computes entries of an array again that `volumes` gave, or that follows it.

        Parameters
        ----------
        simplices : array_like of int
            Indices of simplices.
        volumes : ndarray of float
            Entries of these are written; there must be one for each simplex, or more.
        """
        listed = simplex_ids("simplices", simplices)
        with self._reading as t:
            check_output("volumes", volumes, F64, (cell_count(t),))
            status = _update_volumes(t, address(listed), len(listed), address(volumes), len(volumes))
            self._check(status, cells="simplices")

    def update_circumcentres(self, simplices: Any, centres: np.ndarray, squared_radii: np.ndarray) -> None:
        """Computes entries of arrays again that `circumcentres` gave, or that follow them.

        Parameters
        ----------
        simplices : array_like of int
            Indices of simplices.
        centres, squared_radii : ndarray of float
            Entries of these are written; there must be one for each simplex, or more.
        """
        listed = simplex_ids("simplices", simplices)
        with self._reading as t:
            cells = cell_count(t)
            check_output("centres", centres, F64, (cells, self.ndim))
            check_output("squared_radii", squared_radii, F64, (cells,))
            capacity = min(len(centres), len(squared_radii))
            status = _update_circumcentres(
                t, address(listed), len(listed), address(centres), address(squared_radii), capacity
            )
            self._check(status, cells="simplices")

    def update_alpha_mask(self, simplices: Any, squared_radius: float, mask: np.ndarray) -> None:
        """Decides entries of a mask again that `alpha_mask` gave for one radius, or that follows it.

        Parameters
        ----------
        simplices : array_like of int
            Indices of simplices.
        squared_radius : float
            The one of the mask.
        mask : ndarray of bool
            Entries of these are written; there must be one for each simplex, or more.
        """
        listed = simplex_ids("simplices", simplices)
        limit = real("squared_radius", squared_radius)
        with self._reading as t:
            check_output("mask", mask, np.dtype(np.bool_), (cell_count(t),))
            status = _update_mask_by_circumradius(t, address(listed), len(listed), limit, address(mask), len(mask))
            self._check(status, cells="simplices", squared_radius="squared_radius!")

    def voronoi_volumes(self, box: Any = None) -> np.ndarray:
        """The areas or volumes of the Voronoi cells of all ids, within a box.

        Parameters
        ----------
        box : (array_like, array_like), optional
            Its corners of least and of greatest coordinates. Without a box cells on the hull are infinite.

        Returns
        -------
        ndarray
            A number for each id: 0 for hidden vertices, NaN for removed ones.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[1, 1], [3, 1], [1, 3], [3, 3]])
        >>> tri.voronoi_volumes(box=([0, 0], [4, 4]))
        array([4., 4., 4., 4.])
        """
        low, high = box_corners(box, self.ndim)
        with self._reading as t:
            volumes = np.empty(id_count(t), F64)
            count = ctypes.c_size_t()
            self._check(_voronoi_volumes(t, address_if(low), address_if(high), address(volumes), len(volumes), count))
        return volumes

    def voronoi_facets(self, box: Any = None) -> np.ndarray:
        """The lengths or areas of the Voronoi facets of all edges, in the order of `edges`, within a box.

        Parameters
        ----------
        box : (array_like, array_like), optional
            Its corners of least and of greatest coordinates. Without a box facets on the hull are infinite.

        Returns
        -------
        ndarray
            A number for each edge.
        """
        low, high = box_corners(box, self.ndim)
        with self._reading as t:
            measures = np.empty(count_of(lambda t, count: _edges(t, None, 0, count), t), F64)
            count = ctypes.c_size_t()
            self._check(_voronoi_facets(t, address_if(low), address_if(high), address(measures), len(measures), count))
        return measures

    def voronoi_changed(self, moved: Any) -> np.ndarray:
        """Which Voronoi cells have changed, or may have, by the changes that were taken last.

        To be called after `changes`, before the next change; otherwise all are. With the mask `voronoi_cells` gives
        what it gives for all vertices, to the last bit if changes are taken after every commit.

        Parameters
        ----------
        moved : array_like of int
            Ids of the vertices that have moved since changes were taken before.

        Returns
        -------
        ndarray of bool
            For each vertex id.

        Examples
        --------
        >>> import deldrift, numpy as np
        >>> tri = deldrift.Delaunay(np.mgrid[:9, :9].reshape(2, -1).T)
        >>> changes = tri.changes()
        >>> report = tri.move([[4.1, 4.2]], ids=[40])
        >>> changes = tri.changes()
        >>> changed = tri.voronoi_changed([40])
        >>> bool(changed[40]), bool(changed[0])
        (True, False)
        """
        listed = ids("moved", moved)
        with self._reading as t:
            mask = np.empty(id_count(t), bool)
            status = _voronoi_changed(t, address(listed), len(listed), address(mask), len(mask), ctypes.c_size_t())
            self._check(status, vertices="moved", vertex="moved")
        return mask

    def voronoi_cells(self, box: Any, mask: Any = None, *, half_spaces: Any = None) -> VoronoiCells:
        """Areas or volumes, boundaries and centroids of the Voronoi cells of all ids, within a box and half-spaces.

        Parameters
        ----------
        box : (array_like, array_like)
            Its corners of least and of greatest coordinates.
        mask : array_like of bool, optional
            Whether the cell of each id is asked for; all are by default. The others get NaN.
        half_spaces : array_like, (n, ndim + 1), optional
            A row each: an outward normal, of any length, and an offset. The half-space is where normal · x is at most
            the offset. There may be hundreds.

        Returns
        -------
        VoronoiCells
            Volumes, areas and centroids. A cell of which nothing is left has 0, 0 and NaN.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[1, 1], [3, 1], [1, 3], [3, 3]])
        >>> tri.voronoi_cells(([0, 0], [4, 4])).areas
        array([8., 8., 8., 8.])
        >>> tri.voronoi_cells(([0, 0], [4, 4]), half_spaces=[[1, 1, 4]]).volumes  # x + y <= 4
        array([4., 2., 2., 0.])
        """
        low, high = box_corners(box, self.ndim)
        planes_given = half_space_rows(half_spaces, self.ndim)
        chosen = None if mask is None else mask_of("mask", mask)
        with self._reading as t:
            n = id_count(t)
            given = self._vertex_mask(chosen, n)
            cells = VoronoiCells(np.full(n, np.nan), np.full(n, np.nan), np.full((n, self.ndim), np.nan))
            count = ctypes.c_size_t()
            rows = (address(array) for array in cells)
            planes = address(planes_given), len(planes_given)
            low_high = address_if(low), address_if(high)
            self._check(_voronoi_cells_within(t, *low_high, *planes, *given, *rows, n, count))
        return cells

    def voronoi_derivatives(self, box: Any, mask: Any = None, *, half_spaces: Any = None) -> VoronoiDerivatives:
        """The Voronoi facets of all edges within a box and half-spaces, with derivatives of volumes by positions.

        The derivative of the volume of a cell by the position of its own vertex is minus the sum of those of the other
        cells by that position.

        Parameters
        ----------
        box : (array_like, array_like)
            Its corners of least and of greatest coordinates.
        mask : array_like of bool, optional
            Edges with an end in it are asked for; all are by default. The others get NaN.
        half_spaces : array_like, (n, ndim + 1), optional
            Rows of an outward normal and an offset, as `voronoi_cells` has them.

        Returns
        -------
        VoronoiDerivatives
            Measures, centroids and derivatives, in the order of `edges`.
        """
        low, high = box_corners(box, self.ndim)
        planes_given = half_space_rows(half_spaces, self.ndim)
        chosen = None if mask is None else mask_of("mask", mask)
        with self._reading as t:
            given = self._vertex_mask(chosen, id_count(t))
            n, d = count_of(lambda t, count: _edges(t, None, 0, count), t), self.ndim
            facets = VoronoiDerivatives(np.full(n, np.nan), np.full((n, d), np.nan), np.full((n, 2, d), np.nan))
            count = ctypes.c_size_t()
            rows = (address(array) for array in facets)
            planes = address(planes_given), len(planes_given)
            low_high = address_if(low), address_if(high)
            self._check(_voronoi_derivatives_within(t, *low_high, *planes, *given, *rows, n, count))
        return facets

    def _vertex_mask(self, chosen: Any, n: int) -> tuple[Any, int]:
        """The address and the length of a mask of vertices."""
        if chosen is None:
            return None, 0
        if len(chosen) != n:
            raise WrongCount(f"mask has {len(chosen)} entries, and there are {n} ids", "mask", None, len(chosen))
        return address(chosen), n

    def interpolate(self, values: Any, xi: Any, method: str = "linear", fill_value: Any = np.nan) -> np.ndarray:
        """Values of the vertices, interpolated at other places.

        Parameters
        ----------
        values : array_like
            A number, or a row of them, for each id. Those of hidden and of removed vertices are not used.
        xi : array_like
            Points; the last axis has the coordinates.
        method : {"linear", "natural"}, optional
            Linear in each simplex, or by natural neighbours (Laplace's, or non-Sibsonian, interpolation).
        fill_value : float or array_like, optional
            What points outside the convex hull get.

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
        results = np.empty((len(rows), width), F64)
        with self._reading as t:
            if len(given) != id_count(t):
                raise WrongCount(
                    f"values has {len(given)} entries, and there are {id_count(t)} ids", "values", None, len(given)
                )
            status = _interpolate(
                t,
                number,
                address(given),
                len(given),
                width,
                address(rows),
                len(rows),
                None,
                address(outside),
                address(results),
            )
            self._check(status, positions="xi", value_count="values")
        return results.reshape(shape + given.shape[1:])


def _fill(argument: str, value: Any, shape: tuple[int, ...]) -> np.ndarray:
    try:
        return contiguous(np.broadcast_to(floats(argument, value), shape), F64).reshape(-1)
    except ValueError:
        raise InvalidShape(
            f"{argument} has the shape {np.shape(value)}, and must be a number or {shape}", argument
        ) from None
