"""What simplices have, of triangulations of both kinds: sizes, circumscribed balls, and the facets around some of them."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np

from . import _library
from ._arrays import F64, I32, address, check_output, id_rows, ids, mask as mask_of, one_id, real, simplex_ids
from ._core import Core, cell_count, id_count
from ._errors import WrongCount

_circumcentres = _library.function("circumcentres")
_volumes = _library.function("volumes")
_tolerance = _library.function("tolerance")
_find_simplices = _library.function("find_simplices")
_mask_without_flat_cells = _library.function("mask_without_flat_cells")
_mask_by_circumradius = _library.function("mask_by_circumradius")
_mask_boundary = _library.function("mask_boundary")
_hull_facets = _library.function("hull_facets")
_voronoi_changed = _library.function("voronoi_changed")
_update_circumcentres = _library.function("update_circumcentres")
_update_volumes = _library.function("update_volumes")
_update_mask_by_circumradius = _library.function("update_mask_by_circumradius")


class Boundary(NamedTuple):
    """Facets between simplices of a mask and what is outside of it."""

    facets: np.ndarray
    """Rows of 2 or 3 vertex ids, seen from outside."""
    simplices: np.ndarray
    """The simplex of the mask at each."""
    corners: np.ndarray
    """Which of its corners is opposite the facet."""


class Measured(Core):
    """What simplices have, and the facets around some of them."""

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

    def tolerance(self, vertex: int) -> float:
        """How far every vertex may move without a change of simplices at this one: a certified lower bound.

        Parameters
        ----------
        vertex : int
            The id.

        Returns
        -------
        float
            The distance; infinite while there are no simplices.
        """
        number = one_id("vertex", vertex)
        with self._reading as t:
            found = ctypes.c_double()
            self._check(_tolerance(t, number, found), vertex="vertex!")
        return found.value

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

    def simplices_with(self, vertices: Any) -> np.ndarray:
        """Simplices that have given vertices as corners: so it tells which edges, facets or simplices there are.

        Parameters
        ----------
        vertices : array_like of int
            Rows of 1 (a simplex of each vertex), 2 (edges), 3 or, in 3D, 4 ids, in any order.

        Returns
        -------
        ndarray of int
            The index of one for each row, -1 where there is none.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3], [1, 1]])
        >>> tri.simplices_with([[0, 1], [0, 2]]) >= 0
        array([ True, False])
        """
        listed = id_rows("vertices", vertices, range(1, self.ndim + 2))
        found = np.empty(len(listed), I32)
        with self._reading as t:
            status = _find_simplices(t, listed.shape[1], address(listed), len(listed), address(found))
            self._check(status, vertex=("vertices", listed.shape), vertices=("vertices", listed.shape))
        return found

    def circumcentres(self) -> tuple[np.ndarray, np.ndarray]:
        """The circumcentres and squared circumradii of the simplices.

        Returns
        -------
        centres : ndarray
            A row for each simplex, off by at most 1e-9 circumradii; of periodic ones where the corner of the lowest id is
            at its point.
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

    def voronoi_changed(self, moved: Any) -> np.ndarray:
        """Which Voronoi cells have changed, or may have, by the changes that were taken last.

        To be called after `changes`, before the next change; otherwise all are. With the mask `voronoi_cells` gives
        what it gives for all vertices, to the last bit if changes are taken after every commit; in a periodic box but for
        rounding.

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
