"""What meets what, and checks."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np

from . import _library
from ._arrays import I32, address, ids, whole
from ._core import Core, cell_count, fixed, id_count
from ._errors import InvalidValue

_hidden_vertices = _library.function("hidden_vertices")
_cell_of_each_vertex = _library.function("cell_of_each_vertex")
_vertex_neighbours = _library.function("vertex_neighbours")
_vertex_cells = _library.function("vertex_cells")
_mirror_indices = _library.function("mirror_indices")
_cells_around = _library.function("cells_around")
_validate = _library.function("validate")


class Meeting(Core):
    """What meets what, and checks."""

    @property
    def coplanar(self) -> np.ndarray:
        """Points that are in no simplex: rows of the point, a simplex at its place, and the vertex there, int32.

        With exact arithmetic these are the points at the place of one of lower id, and no others.
        """
        return self._once("coplanar", self._hidden)

    def _hidden(self) -> np.ndarray:
        hidden, representatives = self._hidden_vertices()
        rows = np.empty((len(hidden), 3), I32)
        rows[:, 0], rows[:, 1], rows[:, 2] = hidden, self._corner_simplices()[representatives], representatives
        return fixed(rows)

    def _hidden_vertices(self) -> tuple[np.ndarray, np.ndarray]:
        """The hidden vertices, and the one at the place of each that is a corner of simplices."""
        with self._reading as t:
            count = ctypes.c_size_t()
            self._check(_hidden_vertices(t, None, None, 0, count))
            hidden, shown = np.empty(count.value, I32), np.empty(count.value, I32)
            self._check(_hidden_vertices(t, address(hidden), address(shown), len(hidden), count))
        return hidden, shown

    def _corner_simplices(self) -> np.ndarray:
        """A simplex that each id is a corner of, -1 for none."""
        return self._once("corner_simplices", self._simplex_at_each)

    def _simplex_at_each(self) -> np.ndarray:
        with self._reading as t:
            simplices = np.empty(id_count(t), I32)
            count = ctypes.c_size_t()
            self._check(_cell_of_each_vertex(t, address(simplices), len(simplices), count))
        return simplices

    @property
    def vertex_to_simplex(self) -> np.ndarray:
        """For each id a simplex that it is a corner of; for points in `coplanar` the one there; -1 for removed ones."""
        return self._once("vertex_to_simplex", self._simplex_of_each)

    def _simplex_of_each(self) -> np.ndarray:
        of_vertex = self._corner_simplices().copy()
        coplanar = self.coplanar
        of_vertex[coplanar[:, 0]] = coplanar[:, 1]
        return fixed(of_vertex)

    @property
    def vertex_neighbor_vertices(self) -> tuple[np.ndarray, np.ndarray]:
        """The vertices that share an edge with each: `indices[indptr[k]:indptr[k + 1]]`, ascending, for vertex k.

        Where points repeat, one for each edge: several times where edges lead to a vertex in several periods, and twice the
        vertex itself for each edge to itself.
        """
        return self._once("vertex_neighbor_vertices", self._neighbour_lists)

    def _neighbour_lists(self) -> tuple[np.ndarray, np.ndarray]:
        with self._reading as t:
            count = ctypes.c_size_t()
            self._check(_vertex_neighbours(t, None, 0, None, 0, count))
            offsets, entries = np.empty(id_count(t) + 1, I32), np.empty(count.value, I32)
            self._check(_vertex_neighbours(t, address(offsets), len(offsets), address(entries), len(entries), count))
        return fixed(offsets), fixed(entries)

    def vertex_simplices(self) -> tuple[np.ndarray, np.ndarray]:
        """The simplices around each vertex: `indices[indptr[k]:indptr[k + 1]]`, ascending, for vertex k.

        Where points repeat, one for each corner that is the vertex.

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

    def validate(self, level: int = 3) -> None:
        """Checks the triangulation, exactly; raises `Invalid` for a defect.

        Parameters
        ----------
        level : int, optional
            1 checks indices and adjacency, 2 also orientation and hull, 3 also that circumspheres are empty.
        """
        number = whole("level", level)
        if number not in (1, 2, 3):
            raise InvalidValue(f"level is {number}, and must be 1, 2 or 3", "level", None, number)
        with self._reading as t:
            self._check(_validate(t, number))
