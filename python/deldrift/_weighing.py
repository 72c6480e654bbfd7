"""What triangulations have whose vertices have weights."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np

from . import _library
from ._arrays import F64, I32, address, floats, one_id, real
from ._core import Core, count_of, fixed, id_count
from ._errors import InvalidShape

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

    def set_weight(self, vertex: int, weight: float) -> None:
        """Gives one vertex another weight at once; the timestamp stays.

        Parameters
        ----------
        vertex : int
            Its id.
        weight : float
            The weight.
        """
        number, given = one_id("vertex", vertex), real("weight", weight)
        with self._changing as t:
            self._check(_set_weight(t, number, given), vertex="vertex!", weight="weight!", weights="weight!")


def numbers_of(values: Any) -> np.ndarray:
    """Weights as a list of doubles."""
    array = floats("weights", values)
    if array.ndim != 1:
        raise InvalidShape(f"weights has the shape {array.shape}, and must be a list", "weights")
    return array
