"""What the library calls back during long calls, and the exceptions that come out of it.

Python runs the handler of a signal at certain places of its code, and raises there what the handler raises. The entry
of a function is one of them, ahead of any `try` in it: ctypes would drop what is raised there, and leave the answer
unset. So all that C calls here is C's own, up to a generator, which goes on inside a `try`.

PyPy's ctypes puts functions of Python's in front of all callbacks. There signals wait while the library is called, and
are looked for inside the `try`.
"""

from __future__ import annotations

import collections
import ctypes
import functools
import importlib
import operator
import sys
import threading
import time
import weakref
from typing import Any, Callable, Generator, Optional, Union

import numpy as np

from . import _library

pause_signals: Optional[Callable[[], None]] = None
"""Has handlers of signals wait, on PyPy."""
resume_signals: Optional[Callable[[], None]] = None
"""Runs handlers that have waited, here."""

if sys.implementation.name == "pypy":
    _pypy = importlib.import_module("__pypy__").thread

    def _pause() -> None:
        if threading.current_thread() is threading.main_thread():
            _pypy._signals_exit()

    def _resume() -> None:
        if threading.current_thread() is threading.main_thread():
            _pypy._signals_enter()
            # Signals are looked for after other threads had a chance to run.
            time.sleep(0)

    pause_signals, resume_signals = _pause, _resume

SPARE = 32
"""How many threads may get to ask at the same moment, before one of them has made room for another."""

Answers = Generator[Any, Any, None]

# Generators that have stopped where they will be asked: one for each question, as a callback may lead to another. They are
# those of all triangulations, and not freed with one: a generator that is freed within a `try` runs a handler of Python's.
_waiting: "collections.deque[Answers]" = collections.deque()

# By thread what has been raised in the innermost call.
_raised: dict[Optional[int], BaseException] = {}


def _prepare() -> None:
    while len(_waiting) < SPARE:
        answers = _answer()
        next(answers)
        _waiting.append(answers)


def _answer() -> Answers:
    """Answers once whether to cancel, for the callbacks that it is sent a reference to."""
    # Handlers of signals run in the main thread.
    thread, is_waiting, answer = threading.main_thread().ident, True, True
    try:
        reference = yield None
        is_waiting = False
        thread = threading.get_ident()
        if resume_signals is not None:
            resume_signals()
        _prepare()
        callbacks = reference()
        answer = thread in _raised or callbacks is None or callbacks._ask()
        if pause_signals is not None:
            pause_signals()
    except BaseException as error:
        # On PyPy signals wait while the library asks: what is raised before that comes as the generator is freed.
        if is_waiting and (resume_signals is not None or isinstance(error, GeneratorExit)):
            raise
        _raised[thread], answer = error, True
        if pause_signals is not None:
            pause_signals()
    # Not in the `try`: so nothing of Python's runs when the generator is freed.
    yield answer


class Callbacks:
    """A progress callback and a cancel callback, as functions that C can call.

    An exception, KeyboardInterrupt included, cancels the call and is raised when that has returned.
    """

    def __init__(self, progress: Any, cancel: Optional[Callable[[], bool]]) -> None:
        self.progress, self.cancel = progress, cancel
        self._tell = _teller(progress)
        # What was told last, by the user data, which are none.
        self._told: dict[Optional[int], float] = {}
        _prepare()
        # By a weak reference, as there would be a circle.
        ask = operator.methodcaller("send", weakref.ref(self))
        self.on_cancel = _library.CancelCallback(functools.partial(next, map(ask, iter(_waiting.pop, None))))
        self.on_progress = _library.ProgressCallback() if progress is None else _library.ProgressCallback(self._told.__setitem__)

    def _ask(self) -> bool:
        if self._tell is not None:
            self._tell(self._told[None])
        return self.cancel is not None and bool(self.cancel())

    def check(self) -> None:
        """Raises the exception that has cancelled a call of this thread, once."""
        raised = _raised.pop(threading.get_ident(), None) if _raised else None
        if raised is not None:
            try:
                _prepare()
            finally:
                raise raised


class _Question:
    """`question[corners]` is what a generator answers, by C's functions alone."""

    __slots__ = ("send",)

    def __init__(self, send: Callable[[Any], Any]) -> None:
        self.send = send

    __getitem__ = property(operator.attrgetter("send"))


class Asked:
    """A function of the program's that tells whether simplices are too large, as C can call it."""

    def __init__(self, is_too_large: Callable[[np.ndarray], bool]) -> None:
        self._raised: list[BaseException] = []
        self._answers = answers = _answer_each(is_too_large, self._raised)
        next(answers)
        self.callback: Any
        self.user_data: Optional[int] = None
        if resume_signals is None:
            self._question = _Question(answers.send)
            self.callback, self.user_data = _library.TooLargeCallback(operator.getitem), id(self._question)
        else:
            self.callback = _library.TooLargeCallback(lambda _user_data, corners: answers.send(corners))

    def close(self) -> None:
        """Ends the generator here, where what a handler of a signal raises comes out, and not where it is freed."""
        self._answers.close()

    def check(self, callbacks: Optional[Callbacks]) -> None:
        """Raises the exception that has ended the call; in front of one of the other callbacks, if there is."""
        if self._raised:
            try:
                if callbacks is not None:
                    callbacks.check()
            finally:
                raise self._raised[0]


def _answer_each(is_too_large: Callable[[np.ndarray], bool], raised: list[BaseException]) -> Answers:
    answer: Optional[bool] = None
    is_waiting = True
    try:
        while True:
            at = yield answer
            is_waiting = False
            # NumPy drops what is raised in PyPy's ctypes, so that signals still wait here.
            corners = np.array((ctypes.c_double * 6).from_address(at)).reshape(3, 2)
            if resume_signals is not None:
                resume_signals()
            answer = bool(is_too_large(corners))
            if pause_signals is not None:
                pause_signals()
            is_waiting = True
    except GeneratorExit as error:
        if is_waiting:
            return
        raised[:] = [error]
    except BaseException as error:
        if is_waiting and resume_signals is not None:
            raise
        raised[:] = [error]
    if pause_signals is not None:
        pause_signals()
    # After an answer below 0 the library does not ask any more.
    yield -1


def calling(callbacks: Union[Callbacks, Asked, None], function: Any, *arguments: Any) -> int:
    """The status of a call outside of those of a triangulation with callbacks, which may call some."""
    if callbacks is None or pause_signals is None or resume_signals is None:
        return int(function(*arguments))
    pause_signals()
    try:
        return int(function(*arguments))
    finally:
        resume_signals()


def _teller(progress: Any) -> Optional[Callable[[float], None]]:
    """What to call with the part of the work that is done: a function, or the bar of a tqdm that is moved."""
    if progress is None:
        return None
    if isinstance(progress, type) and hasattr(progress, "update"):
        progress = progress(total=100, unit="%")
    if hasattr(progress, "update") and hasattr(progress, "total"):
        bar = progress

        def show(fraction: float) -> None:
            bar.update(fraction * (bar.total or 1) - bar.n)

        return show
    if not callable(progress):
        raise TypeError(f"progress is {progress!r}, and must be a function of the part that is done, or a tqdm")
    tell: Callable[[float], None] = progress
    return tell
