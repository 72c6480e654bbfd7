"""What triangulations have whose vertices have weights."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple, Optional

import numpy as np

from . import _library
from ._arrays import F64, I32, address, floats, one_id, real
from ._core import Core, count_of, fixed, id_count
from ._errors import InvalidShape, InvalidValue, NotFinite, OutOfRange

_weights = _library.function("weights")
_set_weight = _library.function("set_weight")
_hidden_by_weight = _library.function("hidden_by_weight")


class HiddenByWeight(NamedTuple):
    """Vertices that are hidden by weight."""

    vertices: np.ndarray
    """Their ids, ascending."""
    simplices: np.ndarray
    """For each the simplex at its place, whose power sphere says that it is hidden; -1 where there are no simplices."""


class Weighing(Core):
    """Weights, and who is hidden by them."""

    is_weighted = True
    """Whether points have weights."""

    @property
    def weights(self) -> np.ndarray:
        """The weights of all ids; NaN for removed vertices. Read-only."""
        return self._once("weights", self._copy_weights)

    def _copy_weights(self) -> np.ndarray:
        with self._reading as t:
            weights = np.empty(id_count(t), F64)
            self._check(_weights(t, address(weights), len(weights), ctypes.c_size_t()))
        return fixed(weights)

    @property
    def hidden_by_weight(self) -> HiddenByWeight:
        """The vertices that are corners of no simplex, as others are heavier, each with the simplex at its place."""
        found: HiddenByWeight = self._once("hidden_by_weight", self._list_hidden)
        return found

    def _list_hidden(self) -> HiddenByWeight:
        with self._reading as t:
            count = count_of(lambda t, count: _hidden_by_weight(t, None, None, 0, count), t)
            vertices, simplices = np.empty(count, I32), np.empty(count, I32)
            room = ctypes.c_size_t()
            self._check(_hidden_by_weight(t, address(vertices), address(simplices), count, room))
        return HiddenByWeight(fixed(vertices), fixed(simplices))

    def set_weight(self, vertex: int, weight: Optional[float] = None, *, radius: Optional[float] = None) -> None:
        """Gives one vertex another weight at once; the timestamp stays.

        Parameters
        ----------
        vertex : int
            Its id.
        weight : float, optional
            The weight.
        radius : float, optional
            In place of the weight: that is its square.
        """
        number, given = one_id("vertex", vertex), one_weight(weight, radius)
        if given is None:
            raise TypeError("neither weight nor radius is given")
        with self._changing as t:
            self._check(_set_weight(t, number, given), vertex="vertex!", weight="weight!", weights="weight!")


def weights_of(weights: Any, radii: Any) -> Optional[np.ndarray]:
    """Weights as a list of doubles, given as such or as the radii whose squares they are; None if neither is given."""
    if radii is None:
        return None if weights is None else list_of("weights", weights)
    if weights is not None:
        raise TypeError("weights and radii are both given, and radii say what the weights are")
    given = list_of("radii", radii)
    are_good = (given >= 0) & (given <= MAX_RADIUS)
    if not are_good.all():
        index = int(np.argmin(are_good))
        refuse_radius(f"radii[{index}]", "radii", index, float(given[index]))
    return given * given


def one_weight(weight: Any, radius: Any) -> Optional[float]:
    """The weight of one vertex, given as such or by its radius; None if neither is given."""
    if radius is None:
        return None if weight is None else real("weight", weight)
    if weight is not None:
        raise TypeError("weight and radius are both given, and the radius says what the weight is")
    given = real("radius", radius)
    if not 0 <= given <= MAX_RADIUS:
        refuse_radius("radius", "radius", None, given)
    return given * given


def name_of(radii: Any) -> str:
    """What a message calls the weights that `weights_of` has made."""
    return "weights" if radii is None else "radii"


MAX_RADIUS = 1e57


def refuse_radius(what: str, argument: str, index: Optional[int], value: float) -> None:
    """Raises the error of a radius that is no good."""
    if value < 0 and np.isfinite(value):
        raise InvalidValue(f"{what} is {value:g}, and must be 0 or more", argument, index, value)
    if np.isfinite(value):
        message = f"{what} is {value:g}, and may not exceed {MAX_RADIUS:g}"
        raise OutOfRange(message, argument, index, value)
    raise NotFinite(f"{what} is {value:g}, which is not finite", argument, index, value)


def list_of(argument: str, values: Any) -> np.ndarray:
    """A list of doubles."""
    array = floats(argument, values)
    if array.ndim != 1:
        raise InvalidShape(f"{argument} has the shape {array.shape}, and must be a list", argument)
    return array
