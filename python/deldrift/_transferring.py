"""Conservative transfer of means in simplices."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from . import _library
from ._arrays import F64, address, address_if, floats, points as point_rows
from ._core import Core, cell_count
from ._errors import InvalidShape, InvalidValue

_transfer_cells = _library.function("transfer_cells")

ORDERS = (1, 2)


class Transfer(NamedTuple):
    """Means brought over to other simplices, and what was lost and gained on the way."""

    values: np.ndarray
    """For each simplex that there is its mean, or a row of them."""
    lost: np.ndarray
    """The content, mean times volume, of what was where no simplex is any more: a number, or one for each component."""
    gained: np.ndarray
    """The content of simplices where none was."""
    lost_volume: float
    """The area or volume of what was lost, with its sign."""
    gained_volume: float
    """The area or volume of what was gained, with its sign."""
    volume_error: float
    """By how much at most both are off by rounding."""
    turned_over: int
    """Simplices that are gone, and are turned over at the new positions: what they have is counted as negative."""
    uncovered: int
    """Simplices that have come where nothing was: their means are those of a neighbour."""


class Transferring(Core):
    """What brings means over."""

    def transfer_cells(self, values: Any, points: Any = None, *, order: int = 2) -> Transfer:
        """Means in simplices, brought over to the simplices that there are: conservative transfer.

        A mean rides with its simplex while vertices move, and one that lives keeps it; each new one gets the mean,
        over itself, of what is there at the positions of now. The sum of mean times area or volume stays, where the
        hull does; a constant stays to the last bit, and no mean is beyond those around. To be called after `changes`,
        before anything else changes.

        Parameters
        ----------
        values : array_like
            A number, or a row of them, for each simplex that there was when `changes` was called before, in the order
            of `simplices` then.
        points : array_like, optional
            By id, where the vertices were at last: `points` after the last move, before any of them was removed. By
            default where they are, if none of them has been removed. In a periodic box, where they have gone through
            whatever periods.
        order : {1, 2}, optional
            As if values were constant in each simplex, or with a limited gradient in each.

        Returns
        -------
        Transfer
            The means, and what was lost and gained where the hull has changed: what there is, is what was, less `lost`
            and with `gained`.

        Examples
        --------
        >>> import deldrift
        >>> import numpy as np
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 4], [0, 4], [2, 2]])
        >>> changes = tri.changes()
        >>> heat = np.array([1.0, 2.0, 3.0, 4.0])
        >>> float(heat @ tri.volumes())
        40.0
        >>> before = tri.points
        >>> tri.remove(4)
        >>> new = tri.insert([1, 2])
        >>> changes = tri.changes()
        >>> transfer = tri.transfer_cells(heat, before)
        >>> round(float(transfer.values @ tri.volumes()), 12)
        40.0
        """
        given = floats("values", values)
        if given.ndim == 0:
            raise InvalidShape("values is a single number, and must have an entry for each simplex", "values")
        if order not in ORDERS:
            raise InvalidValue(f"order is {order}, and must be 1 or 2", "order", None, order)
        rows = None if points is None else point_rows("points", points, self.ndim)
        shape = given.shape[1:]
        width = int(np.prod(shape, dtype=np.intp))
        lost, gained, report = np.zeros(width, F64), np.zeros(width, F64), _library.TransferReport()
        with self._reading as t:
            count = cell_count(t)
            made = np.empty((max(len(given), count), width), F64)
            made[: len(given)] = given.reshape(len(given), width)
            status = _transfer_cells(
                t,
                address_if(rows),
                0 if rows is None else len(rows),
                ORDERS.index(order),
                address(made),
                len(given),
                width,
                len(made),
                report,
                address(lost),
                address(gained),
            )
            self._check(status, positions="points", value_count="values")
        return Transfer(
            made[:count].reshape((count, *shape)),
            lost.reshape(shape),
            gained.reshape(shape),
            report.lost_volume,
            report.gained_volume,
            report.volume_error,
            report.turned_over,
            report.uncovered,
        )
