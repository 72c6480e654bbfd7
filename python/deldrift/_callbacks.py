"""What the library calls back during long calls, and the exceptions that come out of it."""

from __future__ import annotations

import threading
from typing import Any, Callable, Optional

from . import _library


class Callbacks:
    """A progress callback and a cancel callback, as functions that C can call.

    An exception, KeyboardInterrupt included, cancels the call and is raised when that has returned.
    """

    def __init__(self, progress: Any, cancel: Optional[Callable[[], bool]]) -> None:
        self.progress, self.cancel = progress, cancel
        self._tell = _teller(progress)
        # By thread: several may read one triangulation at once.
        self._raised: dict[int, BaseException] = {}
        self.on_progress = _library.ProgressCallback(self._on_progress)
        self.on_cancel = _library.CancelCallback(self._on_cancel)

    def _on_progress(self, _user_data: Any, fraction: float) -> None:
        try:
            if self._tell is not None:
                self._tell(fraction)
        except BaseException as error:
            self._raised[threading.get_ident()] = error

    def _on_cancel(self, _user_data: Any) -> bool:
        try:
            if threading.get_ident() in self._raised:
                return True
            return self.cancel is not None and bool(self.cancel())
        except BaseException as error:
            self._raised[threading.get_ident()] = error
            return True

    def raised(self) -> Optional[BaseException]:
        """The exception that has cancelled a call of this thread, once."""
        return self._raised.pop(threading.get_ident(), None)


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
