"""Triangulations of points with weights that repeat."""

from __future__ import annotations

import ctypes
from typing import Any, Callable, Optional, cast

import numpy as np

from . import _library
from ._arrays import I32, address, address_if, ids as listed_ids, points as point_rows
from ._core import id_count
from ._errors import WrongCount
from ._library import Report
from ._periodic import PeriodicDelaunay, box_of
from ._values import expect
from ._weighing import Weighing, name_of, weights_of

_create_periodic_weighted = _library.function("create_periodic_weighted")
_commit_weighted = _library.function("commit_weighted")
_move_vertices = _library.function("move_vertices")
_stage_weights = _library.function("stage_weights")
_stage_insertions_with_weights = _library.function("stage_insertions_with_weights")
_stage_vectors = _library.function("stage_vectors")


class PeriodicRegular(Weighing, PeriodicDelaunay):
    """The regular triangulation of points with weights that repeat, and that may change.

    It is to `PeriodicDelaunay` what `Regular` is to `Delaunay`. Who is hidden is decided in all periods at once. Weights
    may be as far apart as they like: one heavy point may hide all others.

    Parameters
    ----------
    points : array_like
        A row of 2 or 3 coordinates for each point, in any period. Row i is vertex i.
    vectors : array_like
        The vectors of the box, as of `PeriodicDelaunay`.
    weights : array_like, optional
        A number for each point, finite, at most 1e114 in magnitude, maybe negative; by default all are 0.
    radii : array_like, optional
        In place of weights, the radius of a ball for each point, from 0 to 1e57: weights are their squares, each
        rounded once.
    algorithm, threads, parts, progress, cancel
        As of `PeriodicDelaunay`.

    Examples
    --------
    >>> import deldrift
    >>> tri = deldrift.PeriodicRegular([[0.1, 0.1], [0.6, 0.7], [0.4, 0.9]], [1, 1], [0.25, 0, 0])
    >>> tri.hidden_by_weight.vertices
    array([], dtype=int32)
    >>> tri.move(weights=[2, 0, 0]).newly_hidden
    2
    >>> tri.voronoi_volumes()
    array([1., 0., 0.])
    """

    def __init__(
        self,
        points: Any,
        vectors: Any,
        weights: Any = None,
        *,
        radii: Any = None,
        algorithm: str = "auto",
        threads: int = 0,
        parts: int = 0,
        progress: Any = None,
        cancel: Optional[Callable[[], bool]] = None,
    ) -> None:
        rows = point_rows("points", points)
        numbers = weights_of(weights, radii)
        expect(name_of(radii), numbers, len(rows), "points")
        arrays = address(rows), address_if(numbers)
        division = threads, parts
        self._make(_create_periodic_weighted, rows, arrays, vectors, algorithm, division, progress, cancel)

    def move(
        self, points: Any = None, ids: Any = None, *, vectors: Any = None, weights: Any = None, radii: Any = None
    ) -> Report:
        """Moves vertices, gives them other weights, changes the box, or any of these, and makes that the next timestamp.

        Parameters
        ----------
        points : array_like, optional
            A row of coordinates for each vertex, in any period; by default all stay. Without `ids` there is one for each id.
        ids : array_like of int, optional
            The vertices that change, each at most once; all by default.
        vectors : array_like, optional
            The new vectors of the box, as many as there are. Points that do not move stay where they are.
        weights : array_like, optional
            A number for each vertex; by default all keep theirs.
        radii : array_like, optional
            In place of weights: these are their squares.

        Returns
        -------
        Report
            What was done, with how many are hidden now.
        """
        positions = None if points is None else point_rows("points", points, self.ndim)
        numbers, what = weights_of(weights, radii), name_of(radii)
        listed = None if ids is None else listed_ids("ids", ids)
        if listed is not None:
            if positions is None and numbers is None:
                raise WrongCount("ids are given, and neither points nor weights", "ids")
            expect("points", positions, len(listed), "ids")
            expect(what, numbers, len(listed), "ids")
        elif positions is not None:
            expect(what, numbers, len(positions), "points")
        box = None if vectors is None else box_of(vectors, self.ndim)

        def change(t: int, report: Report) -> int:
            if box is not None:
                self._check(_stage_vectors(t, address(box), len(box)))
            given = positions if positions is not None else numbers
            if given is None:
                return self._commit(t, report)
            if listed is None:
                if len(given) != id_count(t):
                    entries = what if positions is None else "points"
                    message = f"there are {len(given)} {entries} for {id_count(t)} ids"
                    raise WrongCount(message, entries, None, len(given))
                if self._trial is None:
                    status = _commit_weighted(t, address_if(positions), address_if(numbers), len(given), report)
                    return int(status)
            at = address_if(listed)
            if numbers is not None:
                self._check(_stage_weights(t, at, address(numbers), len(numbers)), vertices="ids")
            if positions is not None:
                self._check(_move_vertices(t, at, address(positions), len(positions)), positions="points", vertices="ids")
            return self._commit(t, report)

        return self._change(change)

    def insert(self, points: Any, *, weights: Any = None, radii: Any = None) -> np.ndarray:
        """Inserts points.

        Parameters
        ----------
        points : array_like
            A row of coordinates for each.
        weights : array_like, optional
            A number for each; 0 by default.
        radii : array_like, optional
            In place of weights: these are their squares.

        Returns
        -------
        ndarray of int
            Their ids.
        """
        positions, numbers = point_rows("points", points, self.ndim), weights_of(weights, radii)
        expect(name_of(radii), numbers, len(positions), "points")
        first = ctypes.c_uint32()

        def change(t: int, report: Report) -> int:
            arrays = address(positions), address_if(numbers), len(positions)
            status = _stage_insertions_with_weights(t, *arrays, first)
            return int(status or self._commit(t, report))

        self._change(change)
        return np.arange(first.value, first.value + len(positions), dtype=I32)

    def copy(self) -> "PeriodicRegular":
        """An independent triangulation that is as this one.

        Returns
        -------
        PeriodicRegular
            After the same calls it has the same simplices. It calls the same callbacks.
        """
        return cast(PeriodicRegular, super().copy())

    def __repr__(self) -> str:
        return f"<deldrift.PeriodicRegular of {self.nvertices} points in {self.ndim}D, {self.nsimplex} simplices>"


PeriodicDelaunay._weighted_kind = PeriodicRegular
