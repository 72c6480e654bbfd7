"""Refinement of the simplices of a domain of the plane, and coarsening of what it has made."""

from __future__ import annotations

import ctypes
from typing import Any, Callable, Mapping, NamedTuple, Optional

import numpy as np

from . import _library
from ._arrays import F64, I32, address, choice, contiguous, floats, mask as mask_of, numbers, real, whole
from ._callbacks import Asked, calling
from ._core import cell_count, count_of, id_count
from ._errors import InvalidShape, InvalidValue
from ._library import QualityReport
from ._segments import Segmented
from ._values import as_given, entered, expect, given_values

_quality_init = _library.function("quality_init")
_refine = _library.function("refine")
_coarsen = _library.function("coarsen")
_made_vertices = _library.function("made_vertices")
_original_segments = _library.function("original_segments")
_refined_weights = _library.function("refined_weights")
_refined_sizes = _library.function("refined_sizes")
_refined_vertices = _library.function("refined_vertices")

TooLarge = Callable[[np.ndarray], bool]


class MadeVertices(NamedTuple):
    """Vertices that refinement has inserted."""

    vertices: np.ndarray
    """Their ids, ascending."""
    segments: np.ndarray
    """The original segment that each was put on; -1 for none."""


class RefinedWeights(NamedTuple):
    """How values at new vertices follow from those at others."""

    vertices: np.ndarray
    """For each new vertex, in the order of their ids, a row of three vertices."""
    weights: np.ndarray
    """For as many rows their weights, from 0 to 1."""
    ids: np.ndarray
    """The new vertices, ascending."""

    def carried(self, values: np.ndarray) -> np.ndarray:
        """Values by id, with those of the new vertices.

        Parameters
        ----------
        values : ndarray
            A number, or an array of them, for each id that there was.

        Returns
        -------
        ndarray
            As many entries more as there are new ids.
        """
        return entered(values, self.ids, np.einsum("ki,ki...->k...", self.weights, values[self.vertices]))


class _Wanted:
    """Criteria in the arrays that the library reads."""

    def __init__(
        self,
        least_angle: Any,
        greatest_area: Any,
        areas: Any,
        labels: Any,
        sizes: Any,
        is_too_large: Optional[TooLarge],
        mask: Any,
    ) -> None:
        self.least_angle = real("least_angle", least_angle)
        self.greatest_area = real("greatest_area", greatest_area)
        self.areas = None if areas is None else _list_of("areas", areas)
        self.labels = labels
        self.sizes = None if sizes is None else floats("sizes", sizes)
        self.mask = None if mask is None else mask_of("mask", mask)
        if is_too_large is not None and not callable(is_too_large):
            raise TypeError(f"is_too_large is {is_too_large!r}, and must be a function of the corners of a simplex")
        self.is_too_large = is_too_large
        self.names = {name: name + "!" for name in ("least_angle", "greatest_area", "margin", "share", "joins", "growth")}
        if self.sizes is not None and self.sizes.ndim == 0:
            self.names["sizes"] = "sizes!"

    def enter(self, quality: _library.Quality, cells: int, ids: int) -> tuple[Optional[int], int]:
        """Enters all into what the library reads; the mask, and how long it is."""
        expect("mask", self.mask, cells, "simplices")
        if self.labels is not None:
            self.labels = numbers("labels", self.labels, cells, "simplices")
        if self.sizes is not None:
            self.sizes = _by_id("sizes", self.sizes, ids)
        quality.least_angle, quality.greatest_area = self.least_angle, self.greatest_area
        for name, array in ("label", self.labels), ("area", self.areas), ("size", self.sizes):
            if array is not None and len(array):
                setattr(quality, name + "s", address(array))
                setattr(quality, name + "_count", len(array))
        return (None, 0) if self.mask is None else (address(self.mask), cells)


class Refining(Segmented):
    """Refinement of a triangulation of the plane."""

    def refine(
        self,
        *,
        least_angle: float = 0.0,
        greatest_area: float = 0.0,
        areas: Any = None,
        labels: Any = None,
        sizes: Any = None,
        is_too_large: Optional[TooLarge] = None,
        mask: Any = None,
        domain: str = "nesting",
        keep: str = "none",
        limit: Optional[int] = None,
        is_conforming: bool = False,
        reuse_ids: bool = False,
        values: Any = None,
    ) -> QualityReport:
        """Inserts vertices until simplices are of a quality, in 2D, and makes that the next timestamp.

        Segments at these simplices may be split: pieces take the place of one, with its marker. Simplices stay bad at
        small angles between segments, in gaps between segments that are narrower than 1 / 8,192 of their length, and at
        segments that stay whole. Where all is good already nothing is changed.

        Parameters
        ----------
        least_angle : float, optional
            Of a simplex, in degrees, up to 34; 0 for any.
        greatest_area : float, optional
            Of a simplex; 0 for any.
        areas : array_like, optional
            The greatest area by label, 0 for any: that of label k is `areas[k]`, and other labels have none.
        labels : array_like of int, optional
            A label for each simplex, as `label_cells` gives them; those of `regions` by default.
        sizes : float or array_like, optional
            The greatest length of edges, above 0, by vertex id: no edge is longer than the mean at the corners of its
            simplex. New vertices have what is between.
        is_too_large : callable, optional
            Called with rows of the three corners of a simplex, counter-clockwise; whether it is too large. It has to
            give the same answer for the same corners. An exception in it comes out of the call, which has no effect
            then.
        mask : array_like of bool, optional
            The simplices to refine, which have to end at segments; those of `domain` by default.
        domain : {"nesting", "even-odd", "inside", "regions"}, optional
            Which simplices without a mask: those with an odd nesting level, those with an odd crossing number, all within
            closed chains of segments, or those in regions with a label above 0.
        keep : {"none", "outer", "all"}, optional
            Which segments stay whole: none, those at the boundary of what is refined, or all.
        limit : int, optional
            The greatest number of vertices to insert.
        is_conforming : bool, optional
            Whether segments are split until all these simplices are Delaunay, segments or not: no corner of one is
            inside the circle around a segment at it.
        reuse_ids : bool, optional
            Whether new vertices get the ids of those that earlier timestamps have removed, the lowest first, before new
            ones. Vertices have keys from the first insertion on: the new ones the greatest, the others their ids.
        values : array_like or dict of array_like, optional
            Values by vertex id, to be carried over to the new vertices: linear in each simplex. They may be those from
            before a `coarsen` ahead of this: ids stay, and what it has removed is not used.

        Returns
        -------
        QualityReport
            What was done. `values` has the values by the ids that there are now, and `sizes` the sizes.

        Examples
        --------
        >>> import deldrift
        >>> square = [[0, 1], [1, 2], [2, 3], [3, 0]]
        >>> tri = deldrift.Delaunay([[0, 0], [1, 0], [1, 1], [0, 1]], segments=square)
        >>> report = tri.refine(least_angle=30, greatest_area=0.01, values=tri.points[:, 0])
        >>> report.bad_cells, len(report.values) == tri.npoints, bool(tri.volumes().max() <= 0.01)
        (0, True, True)
        """
        return self._improve(
            _refine,
            [least_angle, greatest_area, areas, labels, sizes, is_too_large, mask],
            {
                "domain": choice("domain", domain, _library.DOMAINS),
                "keeps": choice("keep", keep, _library.KEPT),
                "limit": _library.NO_LIMIT if limit is None else _count("limit", limit),
                "has_weights": 1,
                "is_conforming": bool(is_conforming),
                "reuses_ids": bool(reuse_ids),
            },
            values,
        )

    def coarsen(
        self,
        *,
        least_angle: float = 0.0,
        greatest_area: float = 0.0,
        areas: Any = None,
        labels: Any = None,
        sizes: Any = None,
        is_too_large: Optional[TooLarge] = None,
        mask: Any = None,
        domain: str = "nesting",
        keep: str = "none",
        margin: float = 2.0,
        share: float = 0.9,
        joins: float = 1e-9,
        growth: float = 1.1,
        is_conforming: bool = False,
    ) -> QualityReport:
        """Removes vertices that `refine` has inserted and that are not needed any more, in 2D.

        Those go around which simplices would still be of the quality, by a margin, and pieces of segments are joined
        again. Ids of the others stay. Where none goes nothing is changed; otherwise it is the next timestamp.

        Parameters
        ----------
        least_angle, greatest_area, areas, labels, sizes, is_too_large, mask, domain, keep
            As of `refine`. To be called before it, with what it will be called with.
        margin : float, optional
            By how many degrees the angles of new simplices have to be above the least one, from 0 to 30.
        share : float, optional
            The share of the greatest areas and lengths that new simplices may have, above 0 and at most 1.
        joins : float, optional
            How far the vertex between two pieces may be off the line through their other ends to be removed, as a share
            of the distance of these, from 0 to 1.
        growth : float, optional
            How many times as many vertices as a mesh made anew the mesh may have, 1 or more, or infinite. Where more are
            left, or there may be more as larger simplices are asked for, the next `refine` finds the mesh made anew, and
            takes it if it has fewer by this factor: its report counts what was removed. Not with `sizes`.
        is_conforming : bool, optional
            As of `refine`.

        Returns
        -------
        QualityReport
            What was done.

        Examples
        --------
        >>> import deldrift
        >>> square = [[0, 1], [1, 2], [2, 3], [3, 0]]
        >>> tri = deldrift.Delaunay([[0, 0], [1, 0], [1, 1], [0, 1]], segments=square)
        >>> report = tri.refine(greatest_area=0.01)
        >>> report = tri.coarsen()
        >>> tri.nvertices, len(tri.segments.ids)
        (4, 4)
        """
        return self._improve(
            _coarsen,
            [least_angle, greatest_area, areas, labels, sizes, is_too_large, mask],
            {
                "domain": choice("domain", domain, _library.DOMAINS),
                "keeps": choice("keep", keep, _library.KEPT),
                "margin": real("margin", margin),
                "share": real("share", share),
                "joins": real("joins", joins),
                "growth": real("growth", growth),
                "is_conforming": bool(is_conforming),
            },
            None,
        )

    def _improve(self, call: Any, criteria: list[Any], options: Mapping[str, Any], values: Any) -> QualityReport:
        self._check_plane()
        wanted, given, report = _Wanted(*criteria), given_values(values, floats), QualityReport()
        is_too_large = wanted.is_too_large
        quality = _library.Quality()
        self._check(_quality_init(quality))
        for name, value in options.items():
            setattr(quality, name, value)
        with self._changing as t:
            ids = id_count(t)
            for name, array in given.items():
                expect(name, array, ids, "ids")
            mask, count = wanted.enter(quality, cell_count(t), ids)
            asked = None
            try:
                if is_too_large is not None:
                    asked = Asked(is_too_large)
                    quality.is_too_large, quality.user_data = asked.callback, asked.user_data
                status = calling(None if self._callbacks else asked, call, t, quality, mask, count, report)
            finally:
                if asked is not None:
                    asked.close()
            if asked is not None:
                asked.check(self._callbacks)
            self._check(status, **wanted.names)
        if given:
            rows = self.refined_weights()
            carried = [rows.carried(array) for array in given.values()]
            report.values = as_given(values, carried)
        if wanted.sizes is not None and call is _refine:
            report.sizes = entered(wanted.sizes, self.refined_vertices(), self._told(_refined_sizes, F64))
        return report

    def _told(self, call: Any, kind: Any) -> np.ndarray:
        """What a call tells that fills one array."""
        self._check_plane()
        with self._reading as t:
            n = count_of(lambda t, count: call(t, None, 0, count), t)
            told = np.empty(n, kind)
            self._check(call(t, address(told), n, ctypes.c_size_t()))
        return told

    def made_vertices(self) -> MadeVertices:
        """The vertices that `refine` has inserted and that are there, ascending, in 2D.

        Returns
        -------
        MadeVertices
            `vertices`, and `segments`: the original segment that each was put on, -1 for none.
        """
        self._check_plane()
        with self._reading as t:
            n = count_of(lambda t, count: _made_vertices(t, None, None, 0, count), t)
            made = MadeVertices(np.empty(n, I32), np.empty(n, I32))
            self._check(_made_vertices(t, address(made.vertices), address(made.segments), n, ctypes.c_size_t()))
        return made

    def original_segments(self) -> np.ndarray:
        """For each segment of `segments` the id of the one that `refine` has made it a piece of, in 2D.

        Returns
        -------
        ndarray of int
            Its own id if it is whole. Those of segments of which there are pieces are not in force any more.

        Examples
        --------
        >>> import deldrift
        >>> triangle = [[0, 1], [1, 2], [2, 0]]
        >>> tri = deldrift.Delaunay([[0, 0], [1, 0], [0, 1]], segments=triangle, segment_markers=[5, 6, 7])
        >>> report = tri.refine(greatest_area=0.1)
        >>> bool((tri.original_segments() + 5 == tri.segments.markers).all())
        True
        """
        return self._told(_original_segments, I32)

    def refined_weights(self) -> RefinedWeights:
        """How values at the vertices that the last `refine` inserted follow from those at others, in 2D.

        Returns
        -------
        RefinedWeights
            `vertices` and `weights`, rows of three for each of `ids`; none if the triangulation has been changed since.
        """
        self._check_plane()
        with self._reading as t:
            n = count_of(lambda t, count: _refined_weights(t, None, None, 0, count), t)
            rows = RefinedWeights(np.empty((n, 3), I32), np.empty((n, 3), F64), np.empty(n, I32))
            self._check(_refined_weights(t, address(rows.vertices), address(rows.weights), n, ctypes.c_size_t()))
            self._check(_refined_vertices(t, address(rows.ids), n, ctypes.c_size_t()))
        return rows

    def refined_vertices(self) -> np.ndarray:
        """The vertices that the last `refine` inserted, ascending, in 2D.

        Returns
        -------
        ndarray of int
            None if the triangulation has been changed since.
        """
        return self._told(_refined_vertices, I32)


def _count(argument: str, value: Any) -> int:
    number = whole(argument, value)
    if not 0 <= number <= _library.NO_LIMIT:
        raise InvalidValue(f"{argument} is {number}, and must be a number of vertices", argument, None, number)
    return number


def _list_of(argument: str, values: Any) -> np.ndarray:
    array = floats(argument, values)
    if array.ndim != 1:
        raise InvalidShape(f"{argument} has the shape {array.shape}, and must be a list", argument)
    return array


def _by_id(argument: str, values: np.ndarray, ids: int) -> np.ndarray:
    """A number for each id; a single one stands for all."""
    if values.ndim > 1:
        raise InvalidShape(f"{argument} has the shape {values.shape}, and must be a number or a list", argument)
    if values.ndim == 0:
        return contiguous(np.broadcast_to(values, (ids,)), F64)
    expect(argument, values, ids, "ids")
    return values
