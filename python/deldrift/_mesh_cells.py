"""Means in the triangles of a domain, carried through its steps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, Optional

import numpy as np

from ._arrays import floats, points as point_rows
from ._delaunay import Delaunay
from ._errors import ChangesNotTaken, InvalidShape
from ._motion import Changes
from ._transferring import Transfer
from ._values import expect


class _Taken(NamedTuple):
    """The simplices when changes were taken."""

    mask: np.ndarray
    """Which are in the domain."""
    triangles: np.ndarray
    """The rows of these."""
    nearest: np.ndarray
    """For each simplex outside of the domain the nearest one in it, through edges; -1 if there is none."""


class MeshCells:
    """What carries means in triangles of a domain."""

    _tri: Delaunay
    _before: Optional[_Taken] = None
    _taken: Optional[_Taken] = None

    if TYPE_CHECKING:

        @property
        def mask(self) -> np.ndarray: ...

        @property
        def triangles(self) -> np.ndarray: ...

    def changes(self) -> Changes:
        """What has changed in `delaunay` since this was last called, and which of its simplices are `triangles` now.

        Returns
        -------
        Changes
            As of `Delaunay.changes`, of all simplices. For `transfer_cells` call this one, not that. A copy of the mesh
            begins anew.
        """
        mask, triangles = self.mask, self.triangles
        taken = _Taken(mask, triangles, _nearest(mask, self._tri.neighbors))
        changes = self._tri.changes()
        self._before, self._taken = self._taken, taken
        return changes

    def __getstate__(self) -> dict[str, Any]:
        # A copy of the triangulation has no lists of changes.
        return {name: value for name, value in self.__dict__.items() if name not in ("_before", "_taken")}

    def transfer_cells(self, values: Any, points: Any = None, *, order: int = 2) -> Transfer:
        """Means in `triangles`, carried through what has happened between the last two calls of `changes`: moves,
        `coarsen`, `refine` and all else, by conservative transfer.

        A mean rides with its triangle, as with `Delaunay.transfer_cells`. What is beyond the boundary of the domain
        counts as if it had the mean of the nearest triangle: gradients there are less than they should be. With
        `reuse_ids` of `refine` both are to be called between `coarsen` and `refine` as well, as a triangle with the ids
        of one that was would pass for that.

        Parameters
        ----------
        values : array_like
            A number, or a row of them, for each of `triangles` as they were at the first of the two calls.
        points : array_like, optional
            By id, where the vertices were at last: the goals of the last move, or `points` after it, before `coarsen`
            removes any. By default where they are, if none has been removed.
        order : {1, 2}, optional
            As of `Delaunay.transfer_cells`.

        Returns
        -------
        Transfer
            The means in `triangles`. Of `lost` and `gained` one is 0, and the other by how much the content of the
            domain differs, as do `lost_volume` and `gained_volume`: rounding where its boundary stays as it is. Counts
            are of all simplices.

        Examples
        --------
        >>> import deldrift
        >>> import numpy as np
        >>> square = [[0, 1], [1, 2], [2, 3], [3, 0]]
        >>> mesh = deldrift.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], square)
        >>> quality = dict(least_angle=25, greatest_area=0.2)
        >>> report = mesh.refine(**quality)
        >>> changes, goals = mesh.changes(), np.array(mesh.points)
        >>> heat = goals[mesh.triangles].mean(axis=1)[:, 0]
        >>> inside = (goals % 4 != 0).all(axis=1)
        >>> for step in range(10):
        ...     goals[inside] += 0.02 * np.sin(goals[inside, ::-1])
        ...     report = mesh.move(goals)
        ...     report = mesh.coarsen(**quality), mesh.refine(**quality)
        ...     changes = mesh.changes()
        ...     transfer = mesh.transfer_cells(heat, goals)
        ...     heat, goals = transfer.values, np.array(mesh.points)
        ...     inside = (goals % 4 != 0).all(axis=1)
        >>> len(heat) == len(mesh.triangles), bool(abs(transfer.lost - transfer.gained) < 1e-12)
        (True, True)
        """
        given = floats("values", values)
        if given.ndim == 0:
            raise InvalidShape("values is a single number, and must have an entry for each triangle", "values")
        before, now = self._before, self._taken
        if before is None or now is None:
            raise ChangesNotTaken("Mesh.changes has to be called before and after what values are carried through")
        expect("values", given, len(before.triangles), "triangles")
        every = np.zeros((len(before.mask), *given.shape[1:]))
        every[before.mask] = given
        outside = np.flatnonzero(before.nearest >= 0)
        every[outside] = every[before.nearest[outside]]
        places = self._tri.points if points is None else point_rows("points", points, 2)
        transfer = self._tri.transfer_cells(every, None if points is None else places, order=order)
        made = np.ascontiguousarray(transfer.values[now.mask])
        areas = _areas(places[before.triangles]), _areas(self._tri.points[now.triangles])
        content = [np.tensordot(area, mean, 1) for area, mean in zip(areas, (given, made))]
        less, smaller = content[0] - content[1], float(areas[0].sum() - areas[1].sum())
        return transfer._replace(
            values=made,
            lost=np.maximum(less, 0.0),
            gained=np.maximum(-less, 0.0),
            lost_volume=max(smaller, 0.0),
            gained_volume=max(-smaller, 0.0),
        )


def _areas(corners: np.ndarray) -> np.ndarray:
    """With their signs, which are those of triangles that are turned over."""
    (x, y), (z, w) = (np.moveaxis(corners[:, k] - corners[:, 0], 1, 0) for k in (1, 2))
    areas: np.ndarray = (x * w - y * z) / 2
    return areas


def _nearest(mask: np.ndarray, neighbours: np.ndarray) -> np.ndarray:
    """For each simplex outside of the domain the nearest one in it, through edges; -1 for those in it, and for all if
    there is none."""
    # The last entry is that of the neighbour -1, the outside.
    nearest = np.append(np.where(mask, np.arange(len(mask)), -1), len(mask))
    front = np.flatnonzero(mask)
    while len(front):
        beyond, sources = neighbours[front].reshape(-1), np.repeat(nearest[front], neighbours.shape[1])
        is_new = nearest[beyond] < 0
        front, first = np.unique(beyond[is_new], return_index=True)
        nearest[front] = sources[is_new][first]
    return np.where(mask, -1, nearest[:-1])
