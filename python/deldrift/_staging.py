"""Moves of many vertices, staged for the end of a step."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _library
from ._arrays import address, ids, points
from ._core import id_count
from ._errors import WrongCount
from ._segments import Segmented

move_vertices = _library.function("move_vertices")


class Staged(Segmented):
    """What a step stages on."""

    def _stage_moves(self, values: Any, vertices: Any) -> None:
        positions = positions_of(values, self.ndim)
        if vertices is None:
            with self._staging as t:
                check_rows(t, len(positions))
                self._check(move_vertices(t, None, address(positions), len(positions)), positions="points")
            return
        listed = ids_for(vertices, positions)
        with self._staging as t:
            status = move_vertices(t, address(listed), address(positions), len(listed))
            self._check(status, positions="points", vertices="ids", vertex="ids")


def check_rows(t: int, rows: int) -> None:
    there_are = id_count(t)
    if rows != there_are:
        raise WrongCount(f"points has {rows} rows, and there are {there_are} ids", "points", None, rows)


def positions_of(values: Any, ndim: int) -> np.ndarray:
    return points("points", values, ndim)


def ids_for(values: Any, positions: np.ndarray) -> np.ndarray:
    """The vertices of so many positions."""
    listed = ids("ids", values)
    if len(listed) != len(positions):
        raise WrongCount(
            f"points has {len(positions)} rows, and ids has {len(listed)} entries", "points", None, len(positions)
        )
    return listed
