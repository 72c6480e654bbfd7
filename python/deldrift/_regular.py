"""Triangulations of vertices with weights."""

from __future__ import annotations

import ctypes
from typing import Any, Callable, Optional, cast

import numpy as np

from . import _library
from ._arrays import I32, Handle, address, address_if, ids as listed_ids
from ._arrays import keys as given_keys, one_point, points as point_rows
from ._callbacks import calling
from ._core import check, fixed, id_count, make_options
from ._delaunay import Delaunay
from ._errors import Error
from ._library import Report
from ._loading import given_callbacks
from ._scipy import planes
from ._segments import Segments
from ._staging import check_rows, ids_for, move_vertices, positions_of
from ._step import Step
from ._values import expect
from ._weighing import Weighing, name_of, one_weight, weights_of

_create_weighted = _library.function("create_weighted")
_stage_weights = _library.function("stage_weights")
_commit_weighted = _library.function("commit_weighted")
_commit_timestamp = _library.function("commit_timestamp")
_insert_vertex_with_weight = _library.function("insert_vertex_with_weight")


class WeightedStep(Step):
    """Moves, weights, insertions and removals that `Regular.step` commits together."""

    _owner: "Regular"

    def __init__(self, owner: "Regular") -> None:
        super().__init__(owner)
        # Of a call of which a part is staged: the step cannot be committed.
        self._failure: Optional[BaseException] = None

    def _end(self, is_good: bool) -> None:
        failure, self._failure = self._failure, None
        if is_good and failure is not None:
            try:
                raise failure
            finally:
                # Kept in this frame, which it refers to, it would be freed by a collection alone.
                del failure
        super()._end(is_good)

    def move(self, points: Any = None, ids: Any = None, *, weights: Any = None, radii: Any = None) -> None:
        """Moves vertices to new places, gives them other weights, or both.

        Parameters
        ----------
        points : array_like, optional
            A row of coordinates for each vertex; by default all stay.
        ids : array_like of int, optional
            The vertices, each at most once in a step; all by default.
        weights : array_like, optional
            A number for each vertex; by default all keep theirs.
        radii : array_like, optional
            In place of weights: these are their squares.
        """
        self._check_open()
        owner = self._owner
        positions, numbers, listed = _given(points, weights, radii, ids, owner.ndim)
        try:
            with owner._staging as t:
                owner._stage_both(t, positions, numbers, listed, name_of(radii))
        except BaseException as error:
            if positions is not None and numbers is not None:
                self._failure = error
            raise

    def insert(
        self, points: Any, keys: Any = None, *, reuse_ids: bool = False, weights: Any = None, radii: Any = None
    ) -> np.ndarray:
        """Inserts vertices.

        Parameters
        ----------
        points : array_like
            A row of coordinates for each new vertex.
        keys : array_like of int, optional
            A key for each, as those of `Regular`; their ids by default.
        reuse_ids : bool, optional
            Whether vertices get the ids of removed ones, the lowest first, and only then new ones.
        weights : array_like, optional
            A number for each; 0 by default.
        radii : array_like, optional
            In place of weights: these are their squares.

        Returns
        -------
        ndarray of int
            Their ids.
        """
        self._check_open()
        owner = self._owner
        positions = point_rows("points", points, owner.ndim)
        numbers = weights_of(weights, radii)
        expect(name_of(radii), numbers, len(positions), "points")
        new = None
        try:
            new = super().insert(positions, keys, reuse_ids=reuse_ids)
            if numbers is not None:
                with owner._staging as t:
                    owner._check(_stage_weights(t, address(new), address(numbers), len(new)))
        except BaseException as error:
            # Vertices may be staged without their weights, as what a handler of a signal raises comes at any time.
            if numbers is not None and (new is not None or not isinstance(error, (Error, TypeError))):
                self._failure = error
            raise
        return new


class Regular(Weighing, Delaunay):
    """The regular triangulation of points with weights in the plane or in space, whose points and weights may change.

    It is the weighted Delaunay triangulation, the dual of the power diagram. The power distance of a place x from a
    point at p of weight w is ``|x - p|**2 - w``: for a ball of radius r the weight is r**2. No point is at less power
    distance from the power centre of a simplex than its corners are. So a point of little weight beside heavy ones
    may be a corner of no simplex: `hidden_by_weight` has these. Of points at one place that of the greatest weight,
    and of these the one of the lowest key, represents the place; `coplanar` has the others, with a simplex there,
    which is -1 if the one that represents it is hidden by weight. Where all weights are equal, simplices are those of
    `Delaunay`.

    It has what `Delaunay` has. Circumcentres and alpha masks are those of power spheres, whose squared radii may be
    negative. Voronoi cells are power cells, and natural neighbours theirs; what is near is so by distance, without
    weights. `relocate` takes a place alone: the vertex keeps its weight. Segments, refinement and what is in reach
    raise `Weighted`.

    Parameters
    ----------
    points : array_like
        A row of 2 or 3 coordinates for each point. Row i is vertex i.
    weights : array_like, optional
        A number for each point, finite, at most 1e114 in magnitude, maybe negative; by default all are 0.
    radii : array_like, optional
        In place of weights, the radius of a ball for each point, from 0 to 1e57: weights are their squares, each
        rounded once.
    algorithm, threads, parts, coincidence, progress, cancel, keys
        As of `Delaunay`.

    Examples
    --------
    >>> import deldrift
    >>> tri = deldrift.Regular([[0, 0], [4, 0], [4, 4], [0, 4], [2, 2], [2.5, 2]], [0, 0, 0, 0, 4, 0])
    >>> tri.hidden_by_weight.vertices
    array([5], dtype=int32)
    >>> report = tri.move(weights=[0, 0, 0, 0, 4, 4])
    >>> report.newly_shown, len(tri.simplices)
    (1, 6)
    """

    def __init__(
        self,
        points: Any,
        weights: Any = None,
        *,
        radii: Any = None,
        algorithm: str = "auto",
        threads: int = 0,
        parts: int = 0,
        coincidence: str = "merge",
        progress: Any = None,
        cancel: Optional[Callable[[], bool]] = None,
        keys: Any = None,
    ) -> None:
        rows = point_rows("points", points)
        numbers = weights_of(weights, radii)
        expect(name_of(radii), numbers, len(rows), "points")
        given = given_keys("keys", keys, len(rows))
        callbacks = given_callbacks(progress, cancel)
        options = make_options(algorithm, (threads, parts), coincidence, "ignore", callbacks)
        handle = Handle(callbacks)
        arrays = address(rows), address_if(numbers), address_if(given), len(rows)
        status = calling(callbacks, _create_weighted, rows.shape[1], *arrays, options, handle.made)
        check(status, {"positions": "points"}, callbacks)
        self._start(handle, rows.shape[1], (threads, parts), coincidence, "ignore", callbacks)

    def move(self, points: Any = None, ids: Any = None, *, weights: Any = None, radii: Any = None) -> Report:
        """Moves vertices, gives them other weights, or both, and makes that the next timestamp.

        The simplices, and who is hidden, are then as if they had been computed from nothing.

        Parameters
        ----------
        points : array_like, optional
            A row of coordinates for each vertex; by default all stay. Without `ids` there is one for each id, and rows
            of removed vertices are not read.
        ids : array_like of int, optional
            The vertices that change, each at most once; all by default.
        weights : array_like, optional
            A number for each vertex; by default all keep theirs.
        radii : array_like, optional
            In place of weights: these are their squares.

        Returns
        -------
        Report
            What was done, with how many are hidden now; also `Delaunay.report`.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Regular([[0, 0], [4, 0], [4, 4], [0, 4], [2, 2]], [1, 1, 1, 1, 0])
        >>> tri.move(ids=[4], weights=[-8]).newly_hidden
        1
        >>> tri.move([[1, 1]], ids=[4], weights=[2]).newly_shown
        1
        >>> tri.weights
        array([1., 1., 1., 1., 2.])
        """
        if self._trial is not None:
            with self.step() as step:
                step.move(points, ids, weights=weights, radii=radii)
            return cast(Report, self._last_report)
        positions, numbers, listed = _given(points, weights, radii, ids, self.ndim)
        report = Report()
        if listed is not None:
            self._change_some(positions, numbers, listed, report, name_of(radii))
            return report
        with self._changing as t:
            status = _commit_weighted(
                t, address_if(positions), address_if(numbers), _length(positions, numbers), report
            )
            if status:
                _check_length(t, positions, numbers, name_of(radii))
                self._check(status, positions="points")
            self._last_report = report
        return report

    def _change_some(
        self,
        positions: Optional[np.ndarray],
        numbers: Optional[np.ndarray],
        listed: np.ndarray,
        report: Report,
        what: str,
    ) -> None:
        try:
            with self._changing as t:
                # Until it is committed.
                self._must_discard = True
                self._stage_both(t, positions, numbers, listed, what)
                self._check(_commit_timestamp(t, report))
                self._must_discard = False
                self._last_report = report
        except BaseException:
            if self._must_discard:
                self._settle()
            raise

    def _stage_both(
        self,
        t: int,
        positions: Optional[np.ndarray],
        numbers: Optional[np.ndarray],
        listed: Optional[np.ndarray],
        what: str,
    ) -> None:
        """Stages moves, weights, which messages call so, or both: of vertices in a list, or of all."""
        names = {"positions": "points", "vertices": "ids", "vertex": "ids"}
        if listed is None:
            _check_length(t, positions, numbers, what)
        ids, count = address_if(listed), _length(positions, numbers)
        if numbers is not None:
            self._check(_stage_weights(t, ids, address(numbers), count), **names)
        if positions is not None:
            self._check(move_vertices(t, ids, address(positions), count), **names)

    def step(self) -> WeightedStep:
        """A step: changes that are committed together at the end of a `with` block.

        All or nothing: an exception in the block, or of the commit, leaves the triangulation as it was.

        Returns
        -------
        WeightedStep
            What has `move`, `insert` and `remove`.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Regular([[0, 0], [4, 0], [4, 4], [0, 4]])
        >>> with tri.step() as step:
        ...     step.move(ids=[0], weights=[3])
        ...     new = step.insert([[2, 2], [3, 3]], weights=[5, 1])
        >>> tri.weights[new], tri.report.reweighted
        (array([5., 1.]), 1)
        """
        return WeightedStep(self)

    def insert(
        self, point: Any, key: Optional[int] = None, *, weight: Optional[float] = None, radius: Optional[float] = None
    ) -> int:
        """Inserts one vertex at once; the timestamp stays.

        Parameters
        ----------
        point : array_like
            Where it is.
        key : int, optional
            Its key, as those of `Delaunay`; its id by default. One with a weight as well is for `step`.
        weight : float, optional
            Its weight; 0 by default.
        radius : float, optional
            In place of the weight: that is its square.

        Returns
        -------
        int
            Its id: one above the highest ever given.

        Examples
        --------
        Whom it hides, and whom it shows when it has gone, is in `changes`:

        >>> import deldrift
        >>> tri = deldrift.Regular([[0, 0], [4, 0], [4, 4], [0, 4], [1.5, 2]])
        >>> taken = tri.changes()
        >>> heavy = tri.insert([2, 2], weight=4)
        >>> tri.changes().hidden
        array([4], dtype=int32)
        >>> tri.remove(heavy)
        >>> tri.changes().shown
        array([4], dtype=int32)
        """
        number = one_weight(weight, radius)
        if number is None:
            return super().insert(point, key)
        if key is not None:
            raise TypeError("a key and a weight are both given, which step().insert takes")
        position = one_point("point", point, self.ndim)
        with self._changing as t:
            vertex = ctypes.c_uint32()
            status = _insert_vertex_with_weight(t, address(position), number, vertex)
            self._check(status, position="point!", weight="weight!")
        return vertex.value

    def add_points(self, points: Any, restart: bool = False, *, weights: Any = None, radii: Any = None) -> None:
        """Inserts points, whose ids follow those that have been given.

        Parameters
        ----------
        points : array_like
            A row of coordinates for each.
        restart : bool, optional
            Without an effect: simplices depend on positions, weights and keys alone.
        weights : array_like, optional
            A number for each; 0 by default.
        radii : array_like, optional
            In place of weights: these are their squares.
        """
        with self.step() as step:
            step.insert(points, weights=weights, radii=radii)

    @property
    def segments(self) -> Segments:
        """None, as vertices with weights have no segments."""
        return NO_SEGMENTS

    def _hyperplanes(self) -> np.ndarray:
        lifted = self.lift_points(self.points)
        lifted[:, -1] -= self.paraboloid_scale * self.weights
        return fixed(planes(lifted[self.simplices]))

    def copy(self) -> "Regular":
        """An independent triangulation that is as this one.

        Returns
        -------
        Regular
            After the same calls it has the same simplices. It calls the same callbacks.
        """
        return cast(Regular, super().copy())

    def __repr__(self) -> str:
        return f"<deldrift.Regular of {self.nvertices} points in {self.ndim}D, {self.nsimplex} simplices>"


Delaunay._weighted_kind = Regular

NO_SEGMENTS = Segments(fixed(np.empty(0, I32)), fixed(np.empty((0, 2), I32)), fixed(np.empty(0, I32)))


def _given(
    points: Any, weights: Any, radii: Any, ids: Any, ndim: int
) -> tuple[Optional[np.ndarray], Optional[np.ndarray], Optional[np.ndarray]]:
    """Positions, weights and ids of a change, of which at least one of the former has to be given."""
    if points is None and weights is None and radii is None:
        raise TypeError("neither points nor weights are given, and something has to change")
    positions = None if points is None else positions_of(points, ndim)
    numbers = weights_of(weights, radii)
    listed = None
    if positions is not None:
        listed = None if ids is None else ids_for(ids, positions)
        expect(name_of(radii), numbers, len(positions), "rows of points")
    elif ids is not None:
        listed = listed_ids("ids", ids)
        expect(name_of(radii), numbers, len(listed), "ids")
    return positions, numbers, listed


def _length(positions: Optional[np.ndarray], numbers: Optional[np.ndarray]) -> int:
    given = numbers if positions is None else positions
    return 0 if given is None else len(given)


def _check_length(t: int, positions: Optional[np.ndarray], numbers: Optional[np.ndarray], what: str) -> None:
    """Whether there is a row, or a weight, for each id."""
    if positions is not None:
        check_rows(t, len(positions))
    expect(what, numbers, id_count(t), "ids")
