"""Errors of the library as exceptions, one class for each kind."""

from __future__ import annotations

import enum
import re
from typing import Any, Mapping, Optional, Union

from . import _library

Number = Union[int, float, None]
Index = Union[int, tuple[int, ...], None]
Name = Union[str, tuple[str, tuple[int, ...]]]
"""What Python calls an argument of C's: with an exclamation mark behind it if it is a single one, of which C tells an
index; with the shape of an array of more axes than C knows."""


class Error(Exception):
    """What every exception of deldrift's own is.

    Attributes
    ----------
    argument : str or None
        Name of the argument that is wrong.
    index : int, tuple of int or None
        Which entry of it is wrong, or which row of coordinates; a tuple where the array has more axes.
    value : int, float or None
        The value that is wrong.
    """

    argument: Optional[str]
    index: Index
    value: Number

    def __init__(
        self, message: str, argument: Optional[str] = None, index: Index = None, value: Number = None
    ) -> None:
        super().__init__(message)
        self.message = message
        self.argument, self.index, self.value = argument, index, value

    def __reduce__(self) -> Any:
        return type(self), (self.message, self.argument, self.index, self.value)


class InvalidDimension(Error, ValueError):
    """Points have neither 2 nor 3 coordinates, or a function is not there in this dimension."""


class InvalidShape(Error, ValueError):
    """An array has another shape than it must have, or is masked."""


class NoAxis(InvalidShape, IndexError):
    """A single number was given in place of coordinates; an IndexError too, as in scipy."""


class InvalidOption(Error, ValueError):
    """An option has a value without a meaning, or one that stands for what is not Delaunay's triangulation."""


class InvalidValue(Error, ValueError):
    """A number has no meaning for its argument."""


class NotFinite(Error, ValueError):
    """A coordinate, or a weight, is NaN or infinite."""


class OutOfRange(Error, ValueError):
    """A coordinate is of a magnitude above 1e57, or a weight of one above 1e114."""


class WrongCount(Error, ValueError):
    """An array has another number of entries than it must have."""


class Coincident(Error, ValueError):
    """Two vertices would be at the same place, and coincidence="reject" was asked for."""


class DuplicateMove(Error, ValueError):
    """A vertex is moved twice in one step."""


class StagedVertex(Error, ValueError):
    """The vertex is inserted, or removed, only with the end of the step that is open."""


class ChangesNotTaken(Error, RuntimeError):
    """Something has changed since `changes` was last called, or it never was, or ids have been given anew."""


class Prepared(Error, RuntimeError):
    """A trial has made steps, and the call may not be made before it ends or withdraws them."""


class NoSuchVertex(Error, IndexError):
    """No vertex ever had this id."""


class RemovedVertex(Error, IndexError):
    """The vertex of this id has been removed."""


class NoSuchSimplex(Error, IndexError):
    """There is no simplex of this index."""


class NoSuchSegment(Error, IndexError):
    """No segment of this id is in force, or its removal is staged."""


class AmbiguousSeed(Error, ValueError):
    """A seed is on the boundary of several regions, so that it names none of them."""


class UndecidedRegions(Error, RuntimeError):
    """The sides of a region have no label, or several, where refinement goes by them: see `Delaunay.regions`."""


class Weighted(Error, RuntimeError):
    """The vertices have weights, and the call is not for such: see `Regular`."""


class NotWeighted(Error, RuntimeError):
    """The vertices have no weights, and the call is for those that have: see `Regular`."""


class ConflictKind(enum.IntEnum):
    """Why a segment cannot be an edge; what the field `other` of a conflict has."""

    CROSSING = 0
    """It crosses another segment at a place that is an end of neither: `other` is that segment, of the higher id."""
    ON_SEGMENT = 1
    """A vertex is on it, and is not one of its ends: `other` is that vertex."""
    END_REMOVED = 2
    """An end has been removed, or would be: `other` is the end."""
    ENDS_MEET = 3
    """Both ends would be at the same place: `other` is -1."""


class ConflictError(Error, ValueError):
    """Segments cannot be edges where vertices would be; the triangulation is as it was.

    Attributes
    ----------
    kind : ConflictKind
        That of the first conflict.
    conflicts : ndarray
        All of them: a structured array with the fields `kind`, `segment` and `other`, in ascending order.
    """

    kind: ConflictKind
    conflicts: Any

    def __init__(self, message: str, kind: int, conflicts: Any) -> None:
        super().__init__(message)
        self.kind, self.conflicts = ConflictKind(kind), conflicts

    def __reduce__(self) -> Any:
        return type(self), (self.message, int(self.kind), self.conflicts)


class PassingError(Error, ValueError):
    """Vertices would pass segments, which passing="refuse" does not accept; the triangulation is as it was.

    Attributes
    ----------
    passings : ndarray
        All of them: a structured array with the fields `segment` and `vertex`, in ascending order.
    """

    passings: Any

    def __init__(self, message: str, passings: Any) -> None:
        super().__init__(message)
        self.passings = passings

    def __reduce__(self) -> Any:
        return type(self), (self.message, self.passings)


class TooMany(Error, OverflowError):
    """There would be more vertices or simplices than 32-bit ids can name."""


class OutOfMemory(Error, MemoryError):
    """Memory has been refused; the triangulation is as it was."""


class Cancelled(Error):
    """The cancel callback returned true; the triangulation is as it was."""


class Invalid(Error):
    """Delaunay.validate has found something wrong: a defect of the library, or memory that was overwritten."""


class Busy(Error, RuntimeError):
    """Another thread, a callback, or an open step uses the triangulation."""


class Closed(Error, RuntimeError):
    """The triangulation was closed, and cannot be changed any more."""


class InvalidData(Error, ValueError):
    """Data are not those of a saved triangulation."""


class FileError(Error, OSError):
    """The system cannot read or write a file."""


class InvalidField(Error, ValueError):
    """A field for write_vtu has no name, one that XML does not have, or is there twice."""


class InternalError(Error, RuntimeError):
    """A defect of the library or of this package; please report the message."""


KINDS = {
    4: InvalidDimension,
    5: InvalidOption,
    6: InvalidValue,
    8: NotFinite,
    9: OutOfRange,
    10: NoSuchVertex,
    11: RemovedVertex,
    12: DuplicateMove,
    13: WrongCount,
    14: Coincident,
    15: TooMany,
    16: TooMany,
    17: OutOfMemory,
    18: Cancelled,
    19: Invalid,
    20: Busy,
    23: NoSuchSimplex,
    24: InvalidValue,
    25: InvalidData,
    26: FileError,
    27: InvalidField,
    28: StagedVertex,
    29: NoSuchSegment,
    34: AmbiguousSeed,
    36: Prepared,
    39: InvalidValue,
    40: ChangesNotTaken,
    41: UndecidedRegions,
    42: Weighted,
    43: NotWeighted,
}
"""Classes by deldrift_status. What is not here comes of a defect, as a pointer of this package that is NULL."""

MESSAGES = {
    42: "the points have weights, and this is for points without alone: see Regular",
    43: "the points have no weights, and this is for points with weights: see Regular",
}
"""What is said of statuses whose messages name what Python has no name for."""

# "positions[12], coordinate 1, is inf", "cells[3] is 99, but ...", "squared_radius is -1", "quality.sizes[3] is 0"
PLACE = re.compile(
    r"(?:quality\.)?(?P<argument>\w+)(?:\[(?P<index>\d+)\])?(?:, coordinate \d+,)? is (?P<value>[^\s,]+)"
)


def _number(text: str) -> Number:
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return None


def entry(flat: int, shape: tuple[int, ...]) -> tuple[str, Index]:
    """An entry of an array of some shape as messages and as exceptions have it, by its number."""
    place = []
    for length in reversed(shape):
        flat, at = divmod(flat, length)
        place.append(at)
    if not place:
        return "", None
    index = tuple(reversed(place))
    return "[" + ", ".join(map(str, index)) + "]", index if len(index) > 1 else index[0]


def raise_for(status: int, names: Mapping[str, Name]) -> None:
    """Raises the exception for a status, with the arguments of C named as those of Python."""
    message = MESSAGES.get(status) or _library.last_error()
    place = PLACE.match(message)
    kind = KINDS.get(status, InternalError)
    if place is None:
        raise kind(message)
    name = names.get(place["argument"], place["argument"])
    argument, shape = (name, None) if isinstance(name, str) else (name[0], name[1] or None)
    # The index 0 that the library tells for a single id has no counterpart in Python.
    if argument.endswith("!"):
        argument, shape = argument.rstrip("!"), ()
    index: Index = int(place["index"]) if place["index"] is not None else None
    rest = message[place.end("argument") :]
    if isinstance(index, int) and shape is not None:
        told, index = entry(index, shape)
        rest = re.sub(r"^\[\d+\]", told, rest)
    if kind is NoSuchSimplex:
        rest = rest.replace(" cells", " simplices")
    raise kind(argument + rest, argument, index, _number(place["value"]))
