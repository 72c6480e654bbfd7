"""Triangulations that the library makes of others, of files and of bytes."""

from __future__ import annotations

import ctypes
from typing import Any, Callable, Optional, TypeVar

import numpy as np

from . import _library
from ._arrays import Handle, address
from ._callbacks import Callbacks, calling
from ._core import Core, Division, check, make_options
from ._errors import InvalidData
from ._writing import Path, file_name

_dimension = _library.function("dimension")
_discard_moves = _library.function("discard_moves")
_load = _library.function("load")
_load_file = _library.function("load_file")
_vectors = _library.function("vectors")
_is_weighted = _library.function("is_weighted")

Kind = TypeVar("Kind", bound=Core)


def given_callbacks(progress: Any, cancel: Optional[Callable[[], bool]]) -> Optional[Callbacks]:
    """What is to be called during long calls, if anything is."""
    if cancel is not None and not callable(cancel):
        raise TypeError(f"cancel is {cancel!r}, and must be a function that tells whether to cancel")
    return None if progress is None and cancel is None else Callbacks(progress, cancel)


def made(
    kind: type[Kind],
    handle: Handle,
    division: Division,
    coincidence: str,
    passing: str,
    callbacks: Optional[Callbacks],
    name: str = "data",
) -> Kind:
    """A triangulation that the library has made; what is staged, which no step would commit, is forgotten."""
    handle.take()
    count = ctypes.c_size_t()
    check(_vectors(handle.pointer, None, 0, count))
    if (count.value > 0) != kind.is_periodic:
        others = "PeriodicDelaunay.load and PeriodicDelaunay.frombytes", "deldrift.load and deldrift.frombytes"
        raise InvalidData(
            f"{name} is {'not ' if kind.is_periodic else ''}of a periodic triangulation: {others[kind.is_periodic]} "
            "make others",
            name,
        )
    is_weighted = ctypes.c_bool()
    check(_is_weighted(handle.pointer, is_weighted))
    if is_weighted.value and not kind.is_weighted and kind._weighted_kind is not None:
        kind = kind._weighted_kind
    check(_discard_moves(handle.pointer))
    ndim = ctypes.c_uint32()
    check(_dimension(handle.pointer, ndim))
    new = kind.__new__(kind)
    new._start(handle, ndim.value, division, coincidence, passing, callbacks)
    return new


def of_file(
    kind: type[Kind],
    path: Path,
    algorithm: str,
    division: Division,
    coincidence: str,
    passing: str,
    progress: Any,
    cancel: Optional[Callable[[], bool]],
) -> Kind:
    """A triangulation of a file."""
    callbacks = given_callbacks(progress, cancel)
    options = make_options(algorithm, division, coincidence, passing, callbacks)
    handle = Handle(callbacks)
    check(calling(callbacks, _load_file, file_name(path), options, handle.made), {}, callbacks)
    return made(kind, handle, division, coincidence, passing, callbacks, "path")


def of_bytes(
    kind: type[Kind],
    data: Any,
    algorithm: str,
    division: Division,
    coincidence: str,
    passing: str,
    progress: Any = None,
    cancel: Optional[Callable[[], bool]] = None,
) -> Kind:
    """A triangulation of bytes."""
    callbacks = given_callbacks(progress, cancel)
    options = make_options(algorithm, division, coincidence, passing, callbacks)
    try:
        buffer = np.frombuffer(data, np.uint8)
    except (TypeError, AttributeError):
        raise TypeError(f"data is a {type(data).__name__}, and must be bytes") from None
    handle = Handle(callbacks)
    check(calling(callbacks, _load, address(buffer), len(buffer), options, handle.made), {}, callbacks)
    return made(kind, handle, division, coincidence, passing, callbacks)
