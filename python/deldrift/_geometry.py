"""Geometry in bulk, and questions about places and vertices."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np

from . import _library
from ._arrays import F64, I32, address, address_if, box_corners, half_space_rows, mask as mask_of
from ._core import count_of, id_count
from ._measured import Measured
from ._scipy import Scipy
from ._errors import WrongCount

_edges = _library.function("edges")
_voronoi_volumes = _library.function("voronoi_volumes")
_voronoi_facets = _library.function("voronoi_facets")
_voronoi_cells_within = _library.function("voronoi_cells_within")
_voronoi_derivatives_within = _library.function("voronoi_derivatives_within")
_voronoi_cells_and_facets = _library.function("voronoi_cells_and_facets")
_voronoi_weight_derivatives = _library.function("voronoi_weight_derivatives")


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


class VoronoiWeightDerivatives(NamedTuple):
    """Areas or volumes of Voronoi cells, and their derivatives by weights."""

    volumes: np.ndarray
    """By vertex id: 0 for hidden vertices, NaN for removed ones."""
    derivatives: np.ndarray
    """For each edge, in the order of `edges`, the derivative of the area or volume of either end by the weight of the
    other one. The derivative by the own weight is minus the sum over the edges of the vertex."""


class Geometry(Measured, Scipy):
    """Geometry in bulk."""

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

    def voronoi_cells(self, box: Any = None, mask: Any = None, *, half_spaces: Any = None) -> VoronoiCells:
        """Areas or volumes, boundaries and centroids of the Voronoi cells of all ids, within a box and half-spaces.

        Parameters
        ----------
        box : (array_like, array_like), optional
            Its corners of least and of greatest coordinates. Without a box cells on the hull are infinite, and there are no
            half-spaces.
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
            given = vertex_mask(chosen, n)
            cells = VoronoiCells(np.full(n, np.nan), np.full(n, np.nan), np.full((n, self.ndim), np.nan))
            count = ctypes.c_size_t()
            rows = (address(array) for array in cells)
            planes = address(planes_given), len(planes_given)
            low_high = address_if(low), address_if(high)
            self._check(_voronoi_cells_within(t, *low_high, *planes, *given, *rows, n, count))
        return cells

    def voronoi_derivatives(self, box: Any = None, mask: Any = None, *, half_spaces: Any = None) -> VoronoiDerivatives:
        """The Voronoi facets of all edges within a box and half-spaces, with derivatives of volumes by positions.

        The derivative of the volume of a cell by the position of its own vertex is minus the sum of those of the other
        cells by that position.

        Parameters
        ----------
        box : (array_like, array_like), optional
            Its corners of least and of greatest coordinates. Without a box facets on the hull are infinite, and there are no
            half-spaces.
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
            given = vertex_mask(chosen, id_count(t))
            n, d = count_of(lambda t, count: _edges(t, None, 0, count), t), self.ndim
            facets = VoronoiDerivatives(np.full(n, np.nan), np.full((n, d), np.nan), np.full((n, 2, d), np.nan))
            count = ctypes.c_size_t()
            rows = (address(array) for array in facets)
            planes = address(planes_given), len(planes_given)
            low_high = address_if(low), address_if(high)
            self._check(_voronoi_derivatives_within(t, *low_high, *planes, *given, *rows, n, count))
        return facets

    def voronoi_cells_and_facets(
        self, box: Any = None, mask: Any = None, *, half_spaces: Any = None
    ) -> tuple[VoronoiCells, VoronoiDerivatives]:
        """What `voronoi_cells` and `voronoi_derivatives` give, in one call, with circumcentres computed once.

        Parameters
        ----------
        box : (array_like, array_like), optional
            As for `voronoi_cells`.
        mask : array_like of bool, optional
            Ids of which the cells are asked for, and the facets of edges with an end there; all are by default.
        half_spaces : array_like, (n, ndim + 1), optional
            As for `voronoi_cells`.

        Returns
        -------
        (VoronoiCells, VoronoiDerivatives)
            Those, to the last bit.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [2, 0], [0, 2], [2, 2], [1, 1]])
        >>> cells, facets = tri.voronoi_cells_and_facets()
        >>> cells.volumes
        array([inf, inf, inf, inf,  2.])
        >>> int((facets.measures < 2).sum())
        4
        """
        low, high = box_corners(box, self.ndim)
        planes = half_space_rows(half_spaces, self.ndim)
        chosen = None if mask is None else mask_of("mask", mask)
        with self._reading as t:
            walls = address_if(low), address_if(high), address(planes), len(planes)
            return cells_and_facets(self._check, t, self.ndim, walls, chosen)

    def voronoi_weight_derivatives(
        self, box: Any = None, mask: Any = None, *, half_spaces: Any = None
    ) -> VoronoiWeightDerivatives:
        """Areas or volumes of the Voronoi cells, and their derivatives by weights.

        With these Newton's method finds weights for which cells have prescribed volumes. Cells of `Regular` are power
        cells; without weights derivatives are those at equal ones.

        Parameters
        ----------
        box : (array_like, array_like), optional
            As for `voronoi_cells`.
        mask : array_like of bool, optional
            Ids of which the cells are asked for, and edges with an end there; all are by default. The others get NaN.
        half_spaces : array_like, (n, ndim + 1), optional
            As for `voronoi_cells`.

        Returns
        -------
        VoronoiWeightDerivatives
            Volumes by id, and a derivative for each edge.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Regular([[1, 1], [3, 1], [1, 3], [3, 3]], [0.5, 0, 0, 0])
        >>> tri.voronoi_weight_derivatives(box=([0, 0], [4, 4])).volumes.tolist()
        [4.5078125, 3.75, 3.75, 3.9921875]
        """
        low, high = box_corners(box, self.ndim)
        planes = half_space_rows(half_spaces, self.ndim)
        chosen = None if mask is None else mask_of("mask", mask)
        with self._reading as t:
            walls = address_if(low), address_if(high), address(planes), len(planes)
            return weight_derivatives(self._check, t, walls, chosen)


def weight_derivatives(check: Any, t: Any, walls: tuple[Any, ...], chosen: Any) -> VoronoiWeightDerivatives:
    """Volumes and their derivatives, within walls, of a mask of vertices or of all."""
    n, n_edges = id_count(t), count_of(lambda t, count: _edges(t, None, 0, count), t)
    given = vertex_mask(chosen, n)
    made = VoronoiWeightDerivatives(np.full(n, np.nan), np.full(n_edges, np.nan))
    to = address(made.volumes), n, ctypes.c_size_t(), address(made.derivatives), n_edges, ctypes.c_size_t()
    check(_voronoi_weight_derivatives(t, *walls, *given, *to))
    return made


def cells_and_facets(
    check: Any, t: Any, d: int, walls: tuple[Any, ...], chosen: Any
) -> tuple[VoronoiCells, VoronoiDerivatives]:
    """Both, within walls, of a mask of vertices or of all."""
    n, n_edges = id_count(t), count_of(lambda t, count: _edges(t, None, 0, count), t)
    given = vertex_mask(chosen, n)
    cells = VoronoiCells(np.full(n, np.nan), np.full(n, np.nan), np.full((n, d), np.nan))
    facets = VoronoiDerivatives(
        np.full(n_edges, np.nan), np.full((n_edges, d), np.nan), np.full((n_edges, 2, d), np.nan)
    )
    of_cells, of_facets = (tuple(address(array) for array in arrays) for arrays in (cells, facets))
    counts = ctypes.c_size_t(), ctypes.c_size_t()
    check(_voronoi_cells_and_facets(t, *walls, *given, *of_cells, n, counts[0], *of_facets, n_edges, counts[1]))
    return cells, facets


def vertex_mask(chosen: Any, n: int) -> tuple[Any, int]:
    """The address and the length of a mask of vertices."""
    if chosen is None:
        return None, 0
    if len(chosen) != n:
        raise WrongCount(f"mask has {len(chosen)} entries, and there are {n} ids", "mask", None, len(chosen))
    return address(chosen), n
