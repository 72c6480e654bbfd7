"""A step: what is changed together, all or nothing."""

from __future__ import annotations

import ctypes
import functools
from typing import Any, Iterator, TypeVar

import numpy as np

from . import _library
from ._arrays import I32, address, address_if, ids as listed_ids, keys as given_keys, points as point_rows
from ._core import CONFLICT, PASSING, Block, Core
from ._errors import Busy, ConflictError, PassingError
from ._library import Report
from ._segments import Splits
from ._staging import Staged

_stage_insertions = _library.function("stage_insertions_with_keys")
_stage_at_free_ids = _library.function("stage_insertions_at_free_ids")
_stage_removals = _library.function("stage_removals")
_commit_timestamp = _library.function("commit_timestamp")
_prepare_timestamp = _library.function("prepare_timestamp")
_publish_timestamp = _library.function("publish_timestamp")
_withdraw_timestamp = _library.function("withdraw_timestamp")

Opened = TypeVar("Opened", bound="Step")


class _Exit:
    """`__exit__` of a block, of which nothing that a handler of a signal raises can keep the end from being settled.

    Python looks for signals at the entry of a function, ahead of its first line, but not where C goes on with a generator
    that has stopped in a `try`. What is called at the end of the block is `min(False, type, value, traceback, key=...)` with
    such a generator: it gets False, which is the result, and then what `__exit__` gets.
    """

    def __get__(self, block: Any, _kind: Any = None) -> Any:
        if block is None:
            return self
        ending = block._ending()
        next(ending)
        return functools.partial(min, False, key=ending.send)

    def __call__(self, block: "_Block", *error: Any) -> Any:
        return self.__get__(block)(*error)


class _Block(Block):
    """What a `with` block opens and ends."""

    __exit__ = _Exit()

    def __init__(self, owner: Any) -> None:
        self._owner = owner
        self._is_open = False

    def _ending(self) -> Iterator[int]:
        is_ending = False
        try:
            yield 0
            is_ending = True
            kind = yield 0
            self._end(kind is None)
        except GeneratorExit:
            if is_ending:
                raise
            return
        except BaseException:
            owner, self._is_open = self._owner, False
            if owner._step is self:
                owner._step, owner._must_discard = None, True
            if owner._trial is self:
                owner._trial, owner._must_withdraw = None, True
            owner._settle()
            raise
        yield 0
        yield 0
        yield 0

    def _end(self, is_good: bool) -> None:
        """Ends the block, which an exception may have left; what it raises, or leaves open, is settled then."""
        raise NotImplementedError


class Step(_Block):
    """Moves, insertions, removals and segments that `Delaunay.step` commits together."""

    _owner: Staged

    def __init__(self, owner: Staged) -> None:
        super().__init__(owner)
        # Whether the end of the block commits what is staged.
        self._is_kept = True

    def __enter__(self: Opened) -> Opened:
        owner = self._owner
        try:
            with owner._taking:
                owner._step = self
                self._is_open = True
            return self
        except BaseException:
            if owner._step is self:
                owner._step = None
            self._is_open = False
            raise

    def _end(self, is_good: bool) -> None:
        owner = self._owner
        self._is_open = False
        if is_good and self._is_kept:
            with owner._committing as t:
                report = Report()
                trial = owner._trial
                if trial is None:
                    status = _commit_timestamp(t, report)
                else:
                    trial._may_be_prepared = True
                    status = _prepare_timestamp(t, report)
                owner._check(status)
                owner._last_report = report
            owner._step = None
        else:
            owner._step, owner._must_discard = None, True
            owner._settle()

    def _check_open(self) -> None:
        if not self._is_open:
            raise Busy("the step is not open: use it in `with tri.step() as step`")

    def move(self, points: Any, ids: Any = None) -> None:
        """Moves vertices to new places.

        Parameters
        ----------
        points : array_like
            A row of coordinates for each vertex.
        ids : array_like of int, optional
            The vertices, each at most once in a step; all by default.
        """
        self._check_open()
        self._owner._stage_moves(points, ids)

    def insert(self, points: Any, keys: Any = None, *, reuse_ids: bool = False) -> np.ndarray:
        """Inserts vertices.

        Parameters
        ----------
        points : array_like
            A row of coordinates for each new vertex.
        keys : array_like of int, optional
            A key for each, as those of `Delaunay`; their ids by default.
        reuse_ids : bool, optional
            Whether vertices get the ids of removed ones, the lowest first, and only then new ones. Not where there have
            been segments, or vertices that `refine` has made.

        Returns
        -------
        ndarray of int
            Their ids.
        """
        self._check_open()
        owner = self._owner
        positions = point_rows("points", points, owner.ndim)
        given = given_keys("keys", keys, len(positions))
        count = len(positions)
        with owner._staging as t:
            if reuse_ids:
                vertices = np.empty(count, np.uint32)
                status = _stage_at_free_ids(t, address(positions), address_if(given), count, address(vertices))
                owner._check(status, positions="points")
                return vertices.astype(I32)
            first = ctypes.c_uint32()
            status = _stage_insertions(t, address(positions), address_if(given), count, first)
            owner._check(status, positions="points")
        return np.arange(first.value, first.value + len(positions), dtype=I32)

    def remove(self, ids: Any) -> None:
        """Removes vertices.

        Parameters
        ----------
        ids : array_like of int
            The vertices, each at most once in a step.
        """
        self._check_open()
        owner = self._owner
        vertices = listed_ids("ids", ids)
        with owner._staging as t:
            owner._check(_stage_removals(t, address(vertices), len(vertices)), vertices="ids", vertex="ids")

    def add_segments(self, ends: Any, markers: Any = None) -> np.ndarray:
        """Adds segments between vertices, in 2D: each is an edge from the end of the step on, and moves with its ends.

        Parameters
        ----------
        ends : array_like of int
            Rows of two vertex ids, in any order. Vertices that the step inserts are among them.
        markers : array_like of int, optional
            A number of 32 bits to keep with each, or one for all; 0 by default.

        Returns
        -------
        ndarray of int
            Ids of the segments, which follow those that have been given.
        """
        self._check_open()
        return self._owner._stage_segments(ends, markers, "ends", "markers")

    def remove_segments(self, ids: Any) -> None:
        """Removes segments: they need not be edges any more. Their vertices stay.

        Parameters
        ----------
        ids : array_like of int
            Segments that are in force, each at most once in a step.
        """
        self._check_open()
        self._owner._stage_segment_removals(ids)

    def check(self) -> np.ndarray:
        """What segments would have against the step, as it is staged; nothing is committed, and all stays staged.

        Returns
        -------
        ndarray
            The conflicts: a structured array with the fields `kind` (see `ConflictKind`), `segment` and `other`.
            Without any the end of the step will not raise `ConflictError`. With passing="refuse" `PassingError` is
            raised for vertices that would pass segments, before conflicts are looked for.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3], [2, 1]], segments=[[0, 2]])
        >>> with tri.step() as step:
        ...     step.move([[1, 2]], ids=[4])
        ...     crossing = step.add_segments([[3, 1]])
        ...     conflicts = step.check()
        ...     step.remove_segments([0])
        >>> conflicts.tolist()
        [(0, 0, 1)]
        >>> tri.segments.ids
        array([1], dtype=int32)
        """
        self._check_open()
        try:
            self._owner._check_staged()
        except ConflictError as error:
            conflicts: np.ndarray = error.conflicts
            return conflicts
        return np.empty(0, CONFLICT)

    def split(self, limit: Any = None) -> Splits:
        """Splits segments that would be in the way of each other at the end of the step, as it is staged.

        A segment with a vertex on it is replaced by pieces, and two that cross get a vertex there, whose coordinates are
        rounded correctly. Pieces have the marker and the direction of their segment.

        Parameters
        ----------
        limit : int, optional
            How many vertices may be inserted at most; any number by default. With 0 segments are split only at vertices that
            are there.

        Returns
        -------
        Splits
            What the end of the step will make: `vertices`, `pieces`, the number of segments `replaced`, and `rounds`.
            If more vertices are needed, or an end is removed, or both are at one place, `ConflictError` is raised, and
            the step is as before.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3]])
        >>> with tri.step() as step:
        ...     diagonals = step.add_segments([[0, 2], [1, 3]], markers=[1, 2])
        ...     splits = step.split()
        >>> splits.vertices, tri.points[4]
        (array([4], dtype=int32), array([2. , 1.5]))
        >>> tri.segments.ends.tolist(), tri.segments.markers.tolist()
        ([[0, 4], [4, 2], [1, 4], [4, 3]], [1, 1, 2, 2])
        """
        self._check_open()
        return self._owner._stage_splits(limit)


    def passings(self) -> np.ndarray:
        """Which vertices would pass which segments with the step, as it is staged; nothing is committed, and all stays
        staged.

        Each vertex goes straight from its old place to its new one, and so do the ends of segments. A vertex passes a
        segment if it goes through it and is not back on its side when the step ends, or exactly through an end.

        Returns
        -------
        ndarray
            A structured array with the fields `segment` and `vertex`, ascending.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 4], [0, 4], [1, 2]], segments=[[0, 2]])
        >>> with tri.step() as step:
        ...     step.move([[2, 1]], ids=[4])
        ...     passings = step.passings()
        >>> passings.tolist()
        [(0, 4)]
        """
        self._check_open()
        try:
            self._owner._check_passings()
        except PassingError as error:
            passings: np.ndarray = error.passings
            return passings
        return np.empty(0, PASSING)


class Trial(_Block):
    """Steps that `Delaunay.trial`, or that of a box, makes one timestamp of, or takes back."""

    _owner: Core

    def __enter__(self) -> "Trial":
        owner = self._owner
        try:
            with owner._taking:
                if owner._trial is not None:
                    raise Busy("a trial of the triangulation is open, and has to end before another one")
                owner._trial = self
                self._is_open = True
            return self
        except BaseException:
            if owner._trial is self:
                owner._trial = None
            self._is_open = False
            raise

    def _end(self, is_good: bool) -> None:
        owner = self._owner
        if is_good and self._may_be_prepared:
            with owner._ending as t:
                # Until it is published.
                owner._must_withdraw = True
                status = _publish_timestamp(t)
                owner._must_withdraw = False
                if status != _library.NOT_PREPARED:
                    owner._check(status)
        elif self._may_be_prepared:
            owner._must_withdraw = True
        self._is_open, owner._trial = False, None
        if owner._must_withdraw:
            owner._settle()

    def withdraw(self) -> None:
        """Takes back all steps of the trial: the triangulation is as it was when the block began, and other steps may be
        tried in it."""
        if not self._is_open:
            raise Busy("the trial is not open: use it in `with tri.trial() as trial`")
        owner = self._owner
        if self._may_be_prepared:
            with owner._changing as t:
                owner._check(_withdraw_timestamp(t))
                self._may_be_prepared = False
