"""Arrays that come in, converted where they must be, and arrays of the library that go out without a copy."""

from __future__ import annotations

import ctypes
import functools
import operator
import sys
from typing import Any, Callable, Optional

import numpy as np

from . import _library
from ._errors import (
    InvalidDimension,
    InvalidShape,
    InvalidValue,
    NoAxis,
    NoSuchSimplex,
    NoSuchVertex,
    WrongCount,
    entry,
)

F64 = np.dtype(np.float64)
U32 = np.dtype(np.uint32)
U64 = np.dtype(np.uint64)
I32 = np.dtype(np.int32)

# A view is known to be out of use when nothing refers to it any more, which only counted references tell at once.
COUNTS_REFERENCES = sys.implementation.name == "cpython"


def address(array: np.ndarray) -> int:
    """Where the numbers of a contiguous array are."""
    # The buffer of an array that may be written tells it in a fifth of the time.
    if array.flags.writeable and array.size:
        return ctypes.addressof(ctypes.c_char.from_buffer(array.data))
    start: int = array.__array_interface__["data"][0]
    return start


def address_if(array: Optional[np.ndarray]) -> Optional[int]:
    """Where the numbers of an array are; None for no array."""
    return None if array is None else address(array)


def contiguous(array: np.ndarray, dtype: np.dtype) -> np.ndarray:
    """The array as the library can read it: of a type, contiguous and aligned; itself where it is so."""
    return np.require(array, dtype, ["C", "A"])


def array_of(argument: str, values: Any) -> np.ndarray:
    """Whatever NumPy, or DLPack, makes an array of; an error for masks, which NumPy drops."""
    if isinstance(values, np.ma.MaskedArray) or (
        isinstance(values, (list, tuple)) and any(isinstance(entry, np.ma.MaskedArray) for entry in values)
    ):
        raise InvalidShape(
            f"{argument} is a masked array, of which it is not known what its masked entries are", argument
        )
    if hasattr(values, "__dlpack__") and not hasattr(values, "__array__"):
        values = np.from_dlpack(values)
    return np.asarray(values)


def floats(argument: str, values: Any) -> np.ndarray:
    """Values as contiguous doubles: the array itself where it is so, else a converted copy."""
    if type(values) is np.ndarray and values.dtype is F64:
        flags = values.flags
        if flags.c_contiguous and flags.aligned:
            return values
    array = array_of(argument, values)
    if array.dtype.kind not in "fiub":
        if array.dtype.kind == "O":
            try:
                return contiguous(array.astype(F64), F64)
            except (TypeError, ValueError) as error:
                raise TypeError(f"{argument} has entries that are no numbers: {error}") from None
        raise TypeError(f"{argument} has the type {array.dtype}, and must have real numbers")
    return contiguous(array, F64)


def points(argument: str, values: Any, ndim: Optional[int] = None) -> np.ndarray:
    """Rows of coordinates: of ndim of them, or of 2 or 3."""
    array = floats(argument, values)
    if array.ndim != 2:
        raise InvalidShape(
            f"{argument} has the shape {array.shape}, and must have two dimensions: a row of coordinates for each point",
            argument,
        )
    width = array.shape[1]
    if ndim is None and width not in (2, 3):
        raise InvalidDimension(
            f"{argument} has the shape {array.shape}, and must have rows of 2 or 3 coordinates; scipy.spatial.Delaunay "
            "takes any number",
            argument,
            None,
            width,
        )
    if ndim is not None and width != ndim:
        raise InvalidShape(
            f"{argument} has the shape {array.shape}, and must have rows of {ndim} coordinates", argument, None, width
        )
    return array


def one_point(argument: str, value: Any, ndim: int) -> np.ndarray:
    """The coordinates of one point."""
    array = floats(argument, value)
    if array.shape != (ndim,):
        raise InvalidShape(f"{argument} has the shape {array.shape}, and must be {ndim} coordinates", argument)
    return array


def places(argument: str, values: Any, ndim: int) -> tuple[np.ndarray, tuple[int, ...]]:
    """Points in an array of any shape whose last axis has the coordinates: rows of them, and the other axes."""
    given = array_of(argument, values)
    if given.ndim == 0:
        raise NoAxis(f"{argument} has the shape (), whose last entry must be {ndim}", argument)
    array = floats(argument, given)
    if array.shape[-1] != ndim:
        raise InvalidShape(f"{argument} has the shape {array.shape}, whose last entry must be {ndim}", argument)
    return array.reshape(-1, ndim), array.shape[:-1]


def ids(argument: str, values: Any, missing: type = NoSuchVertex) -> np.ndarray:
    """Ids of vertices, or indices of simplices, as contiguous unsigned numbers of 32 bits."""
    array = array_of(argument, values)
    if array.ndim != 1:
        raise InvalidShape(f"{argument} has the shape {array.shape}, and must be a list", argument)
    return _unsigned(argument, array, missing)


def id_rows(argument: str, values: Any, widths: range) -> np.ndarray:
    """Rows of ids of vertices, of one of some widths."""
    array = array_of(argument, values)
    if array.size == 0 and array.ndim < 2:
        return np.empty((0, widths[0]), U32)
    if array.ndim != 2 or array.shape[1] not in widths:
        most = "two" if widths == PAIRS else f"{widths[0]} to {widths[-1]}"
        width = array.shape[1] if array.ndim == 2 else None
        raise InvalidShape(
            f"{argument} has the shape {array.shape}, and must have rows of {most} ids", argument, None, width
        )
    return _unsigned(argument, array, NoSuchVertex)


def simplex_of_each(argument: str, values: Any, count: int) -> np.ndarray:
    """An index of a simplex, or -1, for each of some points, in an array of any shape, as signed numbers."""
    array = array_of(argument, values)
    if array.size != count:
        raise WrongCount(
            f"{argument} has {array.size} entries, and there are {count} points", argument, None, array.size
        )
    is_none = array == -1
    listed: np.ndarray = _unsigned(argument, np.where(is_none, 0, array), NoSuchSimplex).view(I32)
    listed[is_none] = -1
    return listed


def answered(rows: np.ndarray, nan_policy: Any, ask: Callable[[np.ndarray], np.ndarray], none: float) -> np.ndarray:
    """What `ask` answers for rows of coordinates; with "omit" `none` for those of which one is NaN or infinite."""
    if choice("nan_policy", nan_policy, NAN_POLICIES) == 0:
        return ask(rows)
    is_finite = np.isfinite(rows).all(axis=1)
    if is_finite.all():
        return ask(rows)
    # Others keep their places, so that errors name them.
    answers = ask(np.where(is_finite[:, None], rows, 0.0))
    answers[~is_finite] = none
    return answers


def _unsigned(argument: str, array: np.ndarray, missing: type) -> np.ndarray:
    if array.size == 0:
        return np.empty(array.shape, U32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{argument} has the type {array.dtype}, and must have whole numbers")
    if array.dtype.kind == "i" or array.dtype.itemsize > 4:
        wrong = (array < 0) | (array >= _library.NONE)
        if wrong.any():
            flat = int(np.argmax(wrong))
            value = int(array.reshape(-1)[flat])
            told, index = entry(flat, array.shape)
            raise missing(f"{argument}{told} is {value}, which was never given", argument, index, value)
    return contiguous(array, U32)


PAIRS = range(2, 3)
NAN_POLICIES = "raise", "omit"


def pairs(argument: str, values: Any) -> np.ndarray:
    """Rows of two ids of vertices."""
    return id_rows(argument, values, PAIRS)


def numbers(argument: str, values: Any, count: int, entries: str) -> np.ndarray:
    """Whole numbers of 32 bits with a sign, one for each of some entries; a single one stands for all."""
    array = array_of(argument, values)
    if array.ndim > 1:
        raise InvalidShape(f"{argument} has the shape {array.shape}, and must be a list", argument)
    if array.ndim == 1 and len(array) != count:
        raise WrongCount(
            f"{argument} has {len(array)} entries, and there are {count} {entries}", argument, None, len(array)
        )
    if array.size and array.dtype.kind not in "iu":
        raise TypeError(f"{argument} has the type {array.dtype}, and must have whole numbers")
    range_of = np.iinfo(I32)
    wrong = (array < range_of.min) | (array > range_of.max)
    if wrong.any():
        if array.ndim == 0:
            one_number(argument, array)
        index = int(np.argmax(wrong))
        one_number(argument, array[index], index)
    return contiguous(np.broadcast_to(array, (count,)), I32)


def keys(argument: str, values: Any, count: int) -> Optional[np.ndarray]:
    """Keys of vertices, which are unsigned whole numbers of 64 bits; None stands for the ids."""
    if values is None:
        return None
    array = array_of(argument, values)
    if array.ndim != 1:
        raise InvalidShape(f"{argument} has the shape {array.shape}, and must be a list", argument)
    if len(array) != count:
        raise WrongCount(
            f"{argument} has {len(array)} entries, and there are {count} vertices", argument, None, len(array)
        )
    if array.size and array.dtype.kind == "f" and not hasattr(values, "dtype"):
        # Lists of numbers of which some have more than 63 bits.
        array = np.asarray(values, dtype=object)
    if array.size and array.dtype.kind == "O":
        array = np.array([one_key(f"{argument}[{index}]", value) for index, value in enumerate(array)], U64)
    elif array.size and array.dtype.kind not in "iu":
        raise TypeError(f"{argument} has the type {array.dtype}, and must have whole numbers")
    if array.dtype.kind == "i" and (array < 0).any():
        index = int(np.argmax(array < 0))
        one_key(f"{argument}[{index}]", array[index])
    return contiguous(array, U64)


def one_key(argument: str, value: Any) -> int:
    """The key of a vertex."""
    number = whole(argument, value)
    if not 0 <= number < 1 << 64:
        raise InvalidValue(
            f"{argument} is {number}, and must be an unsigned number of 64 bits", argument.split("[")[0], None, number
        )
    return number


def one_number(argument: str, value: Any, index: Optional[int] = None) -> int:
    """A whole number of 32 bits with a sign."""
    number = whole(argument, value)
    if not -(1 << 31) <= number < 1 << 31:
        place = "" if index is None else f"[{index}]"
        raise InvalidValue(
            f"{argument}{place} is {number}, and must be a number of 32 bits with a sign", argument, index, number
        )
    return number


def mask(argument: str, values: Any) -> np.ndarray:
    """True or false for each simplex or vertex."""
    array = array_of(argument, values)
    if array.ndim != 1:
        raise InvalidShape(f"{argument} has the shape {array.shape}, and must be a list of true and false", argument)
    if array.size == 0:
        return np.empty(0, np.bool_)
    if array.dtype.kind not in "biu":
        raise TypeError(f"{argument} has the type {array.dtype}, and must be a list of true and false")
    return contiguous(array, np.dtype(np.bool_))


def whole(argument: str, value: Any) -> int:
    """A whole number."""
    try:
        return operator.index(value)
    except TypeError:
        raise TypeError(f"{argument} is {value!r}, and must be a whole number") from None


def one_id(argument: str, value: Any) -> int:
    """The id of one vertex."""
    number = whole(argument, value)
    if not 0 <= number < _library.NONE:
        raise NoSuchVertex(f"{argument} is {number}, which was never given", argument, None, number)
    return number


def real(argument: str, value: Any) -> float:
    """A number."""
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{argument} is {value!r}, and must be a number") from None


def simplex_ids(argument: str, values: Any) -> np.ndarray:
    """Indices of simplices."""
    return ids(argument, values, NoSuchSimplex)


def check_output(argument: str, array: Any, dtype: np.dtype, least: tuple[int, ...]) -> None:
    """Raises unless `array` can be written to, with so many entries at least, which are for simplices."""
    if not isinstance(array, np.ndarray) or isinstance(array, np.ma.MaskedArray) or array.dtype != dtype or not array.flags.carray:
        raise TypeError(f"{argument} must be a contiguous, writeable array of {dtype}")
    if array.ndim != len(least) or array.shape[1:] != least[1:]:
        raise InvalidShape(f"{argument} has the shape {array.shape}, and must have {least}", argument)
    if len(array) < least[0]:
        raise WrongCount(
            f"{argument} has {len(array)} entries, and there are {least[0]} simplices", argument, None, len(array)
        )


def box_corners(box: Any, ndim: int) -> tuple[Optional[np.ndarray], Optional[np.ndarray]]:
    """The corners of a box, (low, high), or None twice for no box."""
    if box is None:
        return None, None
    corners = box if isinstance(box, (list, tuple)) else array_of("box", box)
    try:
        low, high = corners
    except (TypeError, ValueError):
        raise InvalidShape("box must be (low, high), two corners", "box") from None
    return one_point("low", low, ndim), one_point("high", high, ndim)


def half_space_rows(half_spaces: Any, ndim: int) -> np.ndarray:
    """Rows of a normal and an offset, or none."""
    if half_spaces is None:
        return np.empty((0, ndim + 1))
    array = floats("half_spaces", half_spaces)
    if array.ndim != 2 or array.shape[1] != ndim + 1:
        raise InvalidShape(
            f"half_spaces has the shape {array.shape}, and must have rows of a normal and an offset, {ndim + 1} numbers",
            "half_spaces",
        )
    return array


def choice(argument: str, value: Any, choices: tuple[str, ...], kind: type = InvalidValue) -> int:
    """The number of a name in a list of them."""
    if value in choices:
        return choices.index(value)
    raise kind(f"{argument} is {value!r}, and must be one of " + ", ".join(map(repr, choices)), argument)


class _Owned:
    """What the library makes and writes the address of to `made`, freed with the last reference.

    What frees it is C's. A function of Python's would be a place where handlers of signals run, and what is raised in a
    `__del__` is lost.
    """

    # Nothing, of C's, where a handler raises before there is anything to free.
    free: Any = int

    def __init__(self, free: Any) -> None:
        self.made = ctypes.c_void_p()
        self.free = functools.partial(free, self.made)

    __del__ = property(operator.attrgetter("free"))


class Handle(_Owned):
    """A triangulation of the library, destroyed with the last reference to it.

    It is there before the call that makes the triangulation, which writes the pointer to `made`: so the triangulation is
    destroyed also where a handler of a signal raises as soon as the call has returned.
    """

    def __init__(self, keep: Any) -> None:
        super().__init__(_library.destroy)
        self.pointer = 0
        # What the callbacks of the library use.
        self.keep = keep

    def take(self) -> None:
        """Takes up what has been made."""
        self.pointer = self.made.value or 0


class Released(_Owned):
    """Arrays of cells that the library hands over, which writes what owns them to `made`; freed with the last reference."""

    def __init__(self) -> None:
        super().__init__(_library.free_cells)


class Keeper:
    """What keeps the memory of leases: the triangulation, until it has handed the memory over."""

    __slots__ = ("owner",)

    def __init__(self, owner: Any) -> None:
        self.owner = owner


class Version:
    """A state of a triangulation between two changes."""

    __slots__ = ("is_current",)

    def __init__(self) -> None:
        self.is_current = True


class Lease:
    """Rows of memory that is not NumPy's to change; the base of all arrays that show it.

    NumPy keeps the base of an array alive with it and with all that is made of it without a copy. So a lease that is
    gone says that nobody looks at the memory any more, and one that is not keeps what owns the memory.
    """

    __slots__ = ("version", "owner", "start", "__array_interface__", "__weakref__")

    def __init__(self, version: Version, owner: Any, start: int, shape: tuple[int, ...]) -> None:
        self.version = version
        self.owner = owner
        self.start = start
        self.__array_interface__ = {"shape": shape, "typestr": I32.str, "data": (start, True), "version": 3}


def taken(start: Optional[int], shape: tuple[int, ...]) -> np.ndarray:
    """A copy of an array of the library's, of ids or indices."""
    if not start:
        return np.empty(shape, I32)
    return np.array(np.asarray(_Memory(start, shape)))


class _Memory:
    """Memory of the library that is read at once."""

    __slots__ = ("__array_interface__",)

    def __init__(self, start: int, shape: tuple[int, ...]) -> None:
        self.__array_interface__ = {"shape": shape, "typestr": I32.str, "data": (start, True), "version": 3}


def is_current(array: np.ndarray) -> bool:
    """Whether an array that a triangulation gave shows it as it is now.

    Parameters
    ----------
    array : ndarray
        `Delaunay.simplices` or `Delaunay.neighbors`, or a slice of them.

    Returns
    -------
    bool
        False if the triangulation has been changed since, or a change has failed. The array still has the numbers of
        before, then.

    Examples
    --------
    >>> import deldrift
    >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3], [1, 1]])
    >>> simplices = tri.simplices
    >>> deldrift.is_current(simplices)
    True
    >>> tri.relocate(4, [3, 2])
    >>> deldrift.is_current(simplices)
    False
    """
    base: Any = array
    while isinstance(base, np.ndarray):
        base = base.base
    if isinstance(base, Lease):
        return base.version.is_current
    raise InvalidValue(
        "array is no array of a triangulation, or a copy, which does not know what it was copied from", "array"
    )
