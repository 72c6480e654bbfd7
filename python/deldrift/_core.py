"""What all methods of a triangulation use: its handle, which calls may run at once, and arrays lent to NumPy."""

from __future__ import annotations

import ctypes
import weakref
from _thread import allocate_lock as new_lock
from typing import Any, Callable, Mapping, Optional, TypeVar

import numpy as np

from . import _library
from ._arrays import COUNTS_REFERENCES, Handle, Keeper, Lease, Released, Version, address, choice, taken, whole
from ._callbacks import Callbacks, pause_signals, resume_signals
from ._errors import (
    Busy,
    Closed,
    ConflictError,
    ConflictKind,
    InternalError,
    InvalidOption,
    Name,
    PassingError,
    raise_for,
)

Made = TypeVar("Made")

CONFLICT = np.dtype([("kind", np.uint32), ("segment", np.int32), ("other", np.int32)])
"""deldrift_conflict, with -1 for none."""

PASSING = np.dtype([("segment", np.int32), ("vertex", np.int32)])
"""A vertex that passes a segment."""

NO_NAMES: Mapping[str, Name] = {}

FEW = 8
"""Up to how many gates of calls that have read are kept."""

_release_cells = _library.function("release_cells")
_cells = _library.function("cells")
_segment_conflicts = _library.function("segment_conflicts")
_passings = _library.function("passings")
_discard_moves = _library.function("discard_moves")
_withdraw_timestamp = _library.function("withdraw_timestamp")
_id_count = _library.function("id_count")
_cell_count = _library.function("cell_count")


def check(status: int, names: Mapping[str, Name] = NO_NAMES, callbacks: Optional[Callbacks] = None) -> None:
    """Raises what a status stands for, or the exception that a callback has raised."""
    if callbacks is not None:
        callbacks.check()
    if status:
        raise_for(status, names)


Division = tuple[int, int]
"""Into what work is divided: the arguments `threads` and `parts`."""


def make_options(
    algorithm: str, division: Division, coincidence: str, passing: str, callbacks: Optional[Callbacks]
) -> _library.Options:
    """deldrift_options of Python's arguments."""
    options = _library.Options(ctypes.sizeof(_library.Options))
    for name, given, other in zip(("threads", "parts"), division, ("all that pay", "one for each thread")):
        number = whole(name, given)
        if not 0 <= number < 1 << 32:
            raise InvalidOption(f"{name} is {number}, and must be a number of {name}, or 0 for {other}", name, None, number)
        setattr(options, name, number)
    options.algorithm = choice("algorithm", algorithm, _library.ALGORITHMS, InvalidOption)
    options.coincidence = choice("coincidence", coincidence, _library.COINCIDENCES, InvalidOption)
    options.passing = choice("passing", passing, _library.PASSINGS, InvalidOption)
    if callbacks is not None:
        options.progress, options.cancel = callbacks.on_progress, callbacks.on_cancel
    return options


class Block:
    """What a `with` block opens and ends: a step, or a trial."""

    # Whether a trial may have something to publish or withdraw.
    _may_be_prepared = False


class _Use:
    """A call on a triangulation: `with owner._reading as t`.

    Its gate is locked while it runs. Leaving the block is the gate's own `__exit__`, C's: a handler of a signal that raises
    at the entry of a function of Python's cannot keep it from being left.
    """

    __slots__ = ("owner", "gate", "__exit__")

    def __init__(self, owner: "Core") -> None:
        self.owner = owner
        self.gate = gate = new_lock()
        self.__exit__: Any = gate.__exit__ if pause_signals is None or owner._callbacks is None else self._leave

    def _leave(self, *_: Any) -> None:
        """Leaves what has been begun, or not."""
        if self.gate.locked():
            self.gate.release()
        if resume_signals is not None and self.owner._callbacks is not None:
            resume_signals()


class _Reading(_Use):
    """Reads of a triangulation, which may run on several threads at once."""

    __slots__ = ()

    def __enter__(self) -> int:
        owner, gate = self.owner, self.gate
        if pause_signals is not None and owner._callbacks is not None:
            pause_signals()
        try:
            gate.acquire()
            if owner._must_withdraw or owner._must_discard:
                owner._settle()
            with owner._lock:
                if owner._changer.locked():
                    raise Busy(
                        "the triangulation is being changed, by another thread or by the call whose callback this is"
                    )
                if owner._must_withdraw or (owner._must_discard and owner._step is None):
                    raise Busy("a step or trial has failed, and is taken back as soon as other threads have read")
                readers = owner._readers
                if len(readers) > FEW:
                    readers[:] = [reader for reader in readers if reader.locked()]
                readers.append(gate)
            return owner._handle.pointer
        except BaseException:
            self._leave()
            raise


class _Changing(_Use):
    """A call that may not run beside any other."""

    __slots__ = ("is_of_step", "keeps_cells", "is_end")

    def __init__(self, owner: "Core", is_of_step: bool, keeps_cells: bool, is_end: bool = False) -> None:
        self.owner = owner
        self.gate = gate = new_lock()
        self.__exit__ = gate.__exit__ if pause_signals is None or owner._callbacks is None else self._leave
        # Whether it belongs to the step that is open: nothing else may change the triangulation then.
        self.is_of_step = is_of_step
        # Whether it changes no cells, so that arrays of them stay as they are.
        self.keeps_cells = keeps_cells
        # Whether it is the end of a trial or step, whatever its block has left.
        self.is_end = is_end

    def __enter__(self) -> int:
        owner, gate = self.owner, self.gate
        if pause_signals is not None and owner._callbacks is not None:
            pause_signals()
        try:
            gate.acquire()
            if (owner._must_withdraw or owner._must_discard) and not self.is_end:
                owner._settle()
            with owner._lock:
                readers = owner._readers
                if readers:
                    readers[:] = [reader for reader in readers if reader.locked()]
                if readers or owner._changer.locked():
                    raise Busy("the triangulation is in use, by another thread or by the call whose callback this is")
                if not self.is_end:
                    if owner._step is not None and not self.is_of_step:
                        raise Busy("a step of the triangulation is open, and nothing else may change it before that ends")
                    if owner._is_closed:
                        raise Closed("the triangulation was closed, and cannot be changed any more")
                owner._changer = gate
            if self.keeps_cells:
                owner._forget_all_but_cells()
            else:
                owner._leave_views()
            return owner._handle.pointer
        except BaseException:
            self._leave()
            raise


class Core:
    """The handle of a triangulation."""

    ndim: int
    """The number of dimensions, 2 or 3."""
    is_periodic = False
    """Whether points repeat."""
    is_weighted = False
    """Whether points have weights."""
    # What data with weights become where this class would be made of them, if it would.
    _weighted_kind: Optional[type] = None

    def _start(
        self, handle: Handle, ndim: int, division: Division, coincidence: str, passing: str, callbacks: Optional[Callbacks]
    ) -> None:
        handle.take()
        self._handle = handle
        self.ndim = ndim
        self._division, self._coincidence, self._passing, self._callbacks = division, coincidence, passing, callbacks
        self._lock = new_lock()
        # The gates of calls, of which those that are locked are running: of calls that read, and of the last change.
        self._readers: list[Any] = []
        self._changer = new_lock()
        self._is_closed = False
        # The step and the trial that are open: in a trial steps are rounds of it.
        self._step: Optional[Block] = None
        self._trial: Optional[Block] = None
        # Whether the library has moves staged that no step will commit, and steps prepared that no trial will publish.
        self._must_discard = self._must_withdraw = False
        self._last_report: Optional[_library.Report] = None
        self._version = Version()
        # What has been computed of this version, by name.
        self._cache: dict[str, Any] = {}
        # What keeps the library's memory, and the arrays of it that may be in use.
        self._keeper = Keeper(handle)
        self._leases: list[weakref.ref[Lease]] = []

    # Made for each call: kept, they would be in a circle with their owner, whose memory only a collection would free.
    @property
    def _reading(self) -> _Reading:
        return _Reading(self)

    @property
    def _ending(self) -> _Changing:
        return _Changing(self, True, False, True)

    @property
    def _changing(self) -> _Changing:
        return _Changing(self, False, False)

    @property
    def _taking(self) -> _Changing:
        return _Changing(self, False, True)

    @property
    def _staging(self) -> _Changing:
        return _Changing(self, True, True)

    @property
    def _committing(self) -> _Changing:
        return _Changing(self, True, False)

    def _settle(self) -> None:
        """Takes back what a step or trial has left that has failed: at once, or later where a call is running."""
        try:
            with _Changing(self, True, not self._must_withdraw, True) as t:
                if self._must_withdraw:
                    # Without a prepared timestamp it does nothing.
                    check(_withdraw_timestamp(t))
                    self._must_withdraw = False
                if self._must_discard:
                    check(_discard_moves(t))
                    self._must_discard = False
        except Busy:
            pass

    def _forget_all_but_cells(self) -> None:
        cells = self._cache.get("cells")
        self._cache = {} if cells is None else {"cells": cells}

    def _leave_views(self) -> None:
        """Takes arrays of the library's memory over that are still in use, so that they keep what they show."""
        self._version.is_current = False
        self._version = Version()
        self._cache = {}
        if not self._leases:
            return
        held = [lease for lease in [reference() for reference in self._leases] if lease is not None]
        if held:
            view, released = _library.CellsView(), Released()
            try:
                check(_release_cells(self._handle.pointer, view, released.made))
            finally:
                # Also where a handler of a signal raises as soon as they have been handed over.
                if released.made:
                    self._keeper.owner = released
                    self._keeper, self._leases = Keeper(self._handle), []
            if any(lease.start not in (view.vertices, view.neighbours) for lease in held):
                raise InternalError("the arrays that were handed over are not those that are in use")
        self._leases = []

    def _cell_arrays(self) -> tuple[np.ndarray, np.ndarray]:
        """The arrays of the cells, `simplices` and `neighbors`."""
        cells = self._cache.get("cells")
        if cells is None:
            with self._reading as t:
                view = _library.CellsView()
                check(_cells(t, view))
                shape = (view.count, self.ndim + 1)
                cells = self._lend(view.vertices, shape), self._lend(view.neighbours, shape)
                self._cache["cells"] = cells
        return cells

    def _lend(self, start: Optional[int], shape: tuple[int, ...]) -> np.ndarray:
        """A read-only array of memory of the library, or of a copy where it would not be known how long it is used."""
        if start and COUNTS_REFERENCES:
            lease = Lease(self._version, self._keeper, start, shape)
            self._leases.append(weakref.ref(lease))
            return np.asarray(lease)
        copy = taken(start, shape)
        return np.asarray(Lease(self._version, copy, address(copy), shape))

    def _once(self, name: str, make: Callable[[], Made]) -> Made:
        """What `make` gives, computed once for each version."""
        cache = self._cache
        if name not in cache:
            cache[name] = make()
        made: Made = cache[name]
        return made

    def _check(self, status: int, **names: Name) -> None:
        """`check` with the callbacks of this triangulation, and with its conflicts and passings."""
        if self._callbacks is not None:
            self._callbacks.check()
        if status:
            kind = status - _library.FIRST_CONFLICT
            if 0 <= kind < len(ConflictKind):
                message = _library.last_error()
                raise ConflictError(message, kind, self._told_conflicts())
            if status == _library.PASSES_SEGMENT:
                message = _library.last_error()
                raise PassingError(message, self._told_passings())
            check(status, names)

    def _told_conflicts(self) -> np.ndarray:
        """The conflicts for which the last change, or check, was refused."""
        t, count = self._handle.pointer, ctypes.c_size_t()
        check(_segment_conflicts(t, None, 0, count))
        conflicts = np.empty(count.value, CONFLICT)
        check(_segment_conflicts(t, address(conflicts), len(conflicts), count))
        return fixed(conflicts)

    def _told_passings(self) -> np.ndarray:
        """The vertices that pass segments in the step that was looked at last."""
        t, count = self._handle.pointer, ctypes.c_size_t()
        check(_passings(t, None, None, 0, count))
        segments, vertices = np.empty((2, count.value), np.int32)
        check(_passings(t, address(segments), address(vertices), count.value, count))
        told = np.empty(count.value, PASSING)
        told["segment"], told["vertex"] = segments, vertices
        return fixed(told)


def count_of(function: Any, t: int) -> int:
    """The count that a function tells."""
    count = ctypes.c_size_t()
    check(function(t, count))
    return count.value


def id_count(t: int) -> int:
    """How many ids there are."""
    return count_of(_id_count, t)


def cell_count(t: int) -> int:
    """How many cells there are."""
    return count_of(_cell_count, t)


def fixed(array: np.ndarray) -> np.ndarray:
    """The array, which can only be read from now on."""
    array.flags.writeable = False
    return array
