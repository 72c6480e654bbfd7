"""Changes of a triangulation: moves, insertions, removals, steps, and what they have changed."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple, Optional, Union, cast, overload

import numpy as np

from . import _library
from ._arrays import I32, address, choice, one_id, one_key, one_point, taken
from ._core import fixed, id_count
from ._errors import InvalidOption
from ._library import Report
from ._staging import Staged, check_rows, ids_for, move_vertices, positions_of
from ._step import Step, Trial
from ._values import Values, as_given, expect, given_values

_commit_positions = _library.function("commit_positions")
_commit_timestamp = _library.function("commit_timestamp")
_relocate_vertex = _library.function("relocate_vertex")
_insert_vertex = _library.function("insert_vertex")
_insert_vertex_with_key = _library.function("insert_vertex_with_key")
_remove_vertex = _library.function("remove_vertex")
_compact = _library.function("compact")
_take_changes = _library.function("take_changes")
_set_algorithm = _library.function("set_algorithm")
_get_algorithm = _library.function("get_algorithm")
_statistics = _library.function("statistics")
_timestamp = _library.function("timestamp")

NONE_LISTED = fixed(np.empty(0, I32))


class Changes(NamedTuple):
    """What has changed since `Delaunay.changes` was last called.

    A simplex is its set of vertices: one that existed before and exists now is in none of the lists, unless its index
    is another one. A program with data for each simplex sets aside those of removed and renumbered ones, writes the
    latter to their new indices, and makes those of created ones.
    """

    created: np.ndarray
    """Indices of simplices that exist and did not, ascending."""
    removed: np.ndarray
    """The indices that simplices had which do not exist any more."""
    removed_simplices: np.ndarray
    """Their vertices, a row for each; -1 for vertices that a compaction has dropped."""
    renumbered_from: np.ndarray
    """The indices that simplices had which have another one."""
    renumbered_to: np.ndarray
    """The indices that they have."""
    stars: np.ndarray
    """Vertices of created and removed simplices, ascending."""
    hidden: np.ndarray
    """Vertices that are hidden and were not: by one of lower id at the same place, or, of `Regular`, by weight."""
    shown: np.ndarray
    """Vertices that were hidden and are not."""


class Motion(Staged):
    """Changes of a triangulation."""

    def move(self, points: Any, ids: Any = None) -> Report:
        """Moves vertices, and makes that the next timestamp.

        The simplices are then those of the new positions, as if they had been computed from nothing.

        Parameters
        ----------
        points : array_like
            A row of coordinates for each vertex. Without `ids` there is one for each id, as in `Delaunay.points`, and
            rows of removed vertices are not read.
        ids : array_like of int, optional
            The vertices that move, each at most once; all by default.

        Returns
        -------
        Report
            What was done; also `Delaunay.report`.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3], [1, 1]])
        >>> tri.move([[3, 2]], ids=[4]).moved
        1
        >>> tri.points[4]
        array([3., 2.])
        """
        if self._trial is not None:
            with self.step() as step:
                step.move(points, ids)
            return cast(Report, self._last_report)
        positions = positions_of(points, self.ndim)
        report = Report()
        if ids is not None:
            self._move_some(positions, ids_for(ids, positions), report)
            return report
        with self._changing as t:
            status = _commit_positions(t, address(positions), len(positions), report)
            if status:
                check_rows(t, len(positions))
                self._check(status, positions="points")
            self._last_report = report
        return report

    def step(self) -> Step:
        """A step: changes that are committed together at the end of a `with` block.

        All or nothing: an exception in the block, or of the commit, leaves the triangulation as it was.

        Returns
        -------
        Step
            What has `move`, `insert`, `remove`, `add_segments`, `remove_segments` and `check`.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3], [1, 1]])
        >>> with tri.step() as step:
        ...     step.move([[3, 2]], ids=[4])
        ...     new = step.insert([[1, 2], [2, 1]])
        ...     step.remove([0])
        >>> new
        array([5, 6], dtype=int32)
        >>> tri.report.inserted, tri.report.removed, tri.report.moved
        (2, 1, 1)
        """
        return Step(self)

    def trial(self) -> Trial:
        """Steps that are tried: at the end of a `with` block they are one timestamp, or, after an exception, have never
        been.

        In the block `move`, `step`, `add_segments` and `remove_segments` make what everything that reads sees, and the
        timestamp stays. `Trial.withdraw` takes all of it back, so that another step can be tried. A step that fails in
        the block is taken back alone.

        Until the end of the block these raise `Prepared`, once a step has been made: `insert`, `remove`, `relocate`,
        `compact`, `refine`, `coarsen`, `changes`, `copy`, `save` and pickling.

        Returns
        -------
        Trial
            What has `withdraw`.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3], [1, 1]])
        >>> x = 4.0
        >>> with tri.trial() as trial:
        ...     while True:
        ...         _ = tri.move([[x, 1]], ids=[4])
        ...         if len(tri.simplices) == 4:
        ...             break
        ...         trial.withdraw()
        ...         x = x / 2
        >>> tri.points[4].tolist(), tri.timestamp
        ([2.0, 1.0], 1)
        """
        return Trial(self)

    def add_segments(self, ends: Any, markers: Any = None) -> np.ndarray:
        """Adds segments between vertices, in 2D, and makes that the next timestamp.

        Each is an edge from now on, and moves with its ends: a change for which that cannot be raises `ConflictError`.

        Parameters
        ----------
        ends : array_like of int
            Rows of two vertex ids, in any order. A segment may be given twice, and many may share a vertex.
        markers : array_like of int, optional
            A number of 32 bits to keep with each, or one for all; 0 by default.

        Returns
        -------
        ndarray of int
            Their ids, which follow those that have been given.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3], [2, 1]])
        >>> tri.add_segments([[0, 2]])
        array([0], dtype=int32)
        >>> try:
        ...     tri.move([[2, 1.5]], ids=[4])
        ... except deldrift.ConflictError as error:
        ...     print(error, "|", error.kind.name, error.conflicts.tolist())
        vertex 4 is on segment 0 | ON_SEGMENT [(1, 0, 4)]
        """
        with self.step() as step:
            added = step.add_segments(ends, markers)
        return added

    def remove_segments(self, ids: Any) -> None:
        """Removes segments, and makes that the next timestamp. Their vertices stay.

        Parameters
        ----------
        ids : array_like of int
            Segments that are in force, each once.
        """
        with self.step() as step:
            step.remove_segments(ids)

    def check(self, points: Any, ids: Any = None) -> np.ndarray:
        """What segments would have against a move, which is not made.

        Parameters
        ----------
        points : array_like
            A row of coordinates for each vertex, as for `move`.
        ids : array_like of int, optional
            The vertices, each at most once; all by default.

        Returns
        -------
        ndarray
            The conflicts: a structured array with the fields `kind` (see `ConflictKind`), `segment` and `other`.
            Without any `move` will not raise `ConflictError`.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3], [2, 1]], segments=[[0, 2]])
        >>> tri.check([[2, 1.5]], ids=[4])["other"]
        array([4], dtype=int32)
        >>> len(tri.check([[1, 2]], ids=[4]))
        0
        """
        with self.step() as step:
            step.move(points, ids)
            conflicts = step.check()
            step._is_kept = False
        return conflicts

    def _move_some(self, positions: np.ndarray, listed: np.ndarray, report: Report) -> None:
        try:
            with self._changing as t:
                # Until it is committed.
                self._must_discard = True
                status = move_vertices(t, address(listed), address(positions), len(listed))
                self._check(status or _commit_timestamp(t, report), positions="points", vertices="ids", vertex="ids")
                self._must_discard = False
                self._last_report = report
        except BaseException:
            if self._must_discard:
                self._settle()
            raise

    def relocate(self, vertex: int, point: Any) -> None:
        """Moves one vertex at once; the timestamp stays.

        Parameters
        ----------
        vertex : int
            Its id.
        point : array_like
            Where it goes.
        """
        number = one_id("vertex", vertex)
        position = one_point("point", point, self.ndim)
        with self._changing as t:
            self._check(_relocate_vertex(t, number, address(position)), vertex="vertex!", position="point!")

    def insert(self, point: Any, key: Optional[int] = None) -> int:
        """Inserts one vertex at once; the timestamp stays.

        Parameters
        ----------
        point : array_like
            Where it is.
        key : int, optional
            Its key, as those of `Delaunay`; its id by default.

        Returns
        -------
        int
            Its id: one above the highest ever given.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3]])
        >>> tri.insert([1, 1])
        4
        """
        position = one_point("point", point, self.ndim)
        number = None if key is None else one_key("key", key)
        with self._changing as t:
            vertex = ctypes.c_uint32()
            if number is None:
                status = _insert_vertex(t, address(position), vertex)
            else:
                status = _insert_vertex_with_key(t, address(position), number, vertex)
            self._check(status, position="point!")
        return vertex.value

    def remove(self, vertex: int) -> None:
        """Removes one vertex at once; the timestamp stays.

        Ids of the others stay, and its own is not given again before `compact`.

        Parameters
        ----------
        vertex : int
            Its id.
        """
        number = one_id("vertex", vertex)
        with self._changing as t:
            self._check(_remove_vertex(t, number), vertex="vertex!")

    @overload
    def compact(self) -> np.ndarray: ...
    @overload
    def compact(self, values: Any) -> tuple[np.ndarray, Values]: ...
    def compact(self, values: Any = None) -> Union[np.ndarray, tuple[np.ndarray, Values]]:
        """Gives vertices the ids 0, 1, ... in the order of those that they have, and frees what removed ones used.

        Parameters
        ----------
        values : array_like or dict of array_like, optional
            Values by vertex id, to be renumbered as well.

        Returns
        -------
        ndarray of int
            The new id of each old one, -1 for removed vertices. With values these follow in a tuple: by the new
            ids.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3]])
        >>> tri.remove(1)
        >>> tri.compact(values=[5, 6, 7, 8])
        (array([ 0, -1,  1,  2], dtype=int32), array([5, 7, 8]))
        """
        given = given_values(values, lambda _, one: np.asarray(one))
        with self._changing as t:
            new_ids = np.empty(id_count(t), I32)
            for name, array in given.items():
                expect(name, array, len(new_ids), "ids")
            count = ctypes.c_size_t()
            self._check(_compact(t, address(new_ids), len(new_ids), count))
        if values is None:
            return new_ids
        return new_ids, as_given(values, [array[new_ids >= 0] for array in given.values()])

    def changes(self) -> Changes:
        """What has changed since this was last called; the first call lists all simplices as created.

        Returns
        -------
        Changes
            Named arrays.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3], [1, 1]])
        >>> len(tri.changes().created)
        4
        >>> _ = tri.move([[3, 2]], ids=[4])
        >>> tri.changes().created
        array([], dtype=int32)
        >>> tri.remove(4)
        >>> changes = tri.changes()
        >>> len(changes.created), len(changes.removed)
        (2, 4)
        """
        with self._taking as t:
            view = _library.ChangesView()
            self._check(_take_changes(t, view))
            return changes_of(view, self.ndim + 1)

    @property
    def report(self) -> Optional[Report]:
        """What the last commit of `move` or a step did; None before the first."""
        return self._last_report

    @property
    def statistics(self) -> Report:
        """What all commits and immediate changes have done, in sum."""
        with self._reading as t:
            report = Report()
            self._check(_statistics(t, report))
        return report

    @property
    def timestamp(self) -> int:
        """The number of the current timestamp: 0 at creation, one more at each commit."""
        with self._reading as t:
            number = ctypes.c_uint64()
            self._check(_timestamp(t, number))
        return number.value

    @property
    def algorithm(self) -> str:
        """The algorithm of commits: "auto", "rebuilding", "placement_flips", "tolerance" or "repair".

        All give the same simplices; they differ in what they cost. It may be changed at any time.
        """
        with self._reading as t:
            number = ctypes.c_uint32()
            self._check(_get_algorithm(t, number))
        return _library.ALGORITHMS[number.value]

    @algorithm.setter
    def algorithm(self, name: str) -> None:
        number = choice("algorithm", name, _library.ALGORITHMS, InvalidOption)
        with self._taking as t:
            self._check(_set_algorithm(t, number))


def changes_of(view: _library.ChangesView, corners: int) -> Changes:
    """Copies of the lists of changes."""
    if not (view.created_count or view.removed_count or view.renumbered_count or view.hidden_count or view.shown_count):
        return NO_CHANGES[corners]

    def listed(start: Optional[int], count: int) -> np.ndarray:
        return taken(start, (count,)) if count else NONE_LISTED

    removed_count = view.removed_count
    return Changes(
        listed(view.created, view.created_count),
        listed(view.removed, removed_count),
        taken(view.removed_vertices, (removed_count, corners)),
        listed(view.renumbered_from, view.renumbered_count),
        listed(view.renumbered_to, view.renumbered_count),
        listed(view.stars, view.star_count),
        listed(view.hidden, view.hidden_count),
        listed(view.shown, view.shown_count),
    )


NO_CHANGES = {
    corners: Changes(
        created=NONE_LISTED,
        removed=NONE_LISTED,
        removed_simplices=fixed(np.empty((0, corners), I32)),
        renumbered_from=NONE_LISTED,
        renumbered_to=NONE_LISTED,
        stars=NONE_LISTED,
        hidden=NONE_LISTED,
        shown=NONE_LISTED,
    )
    for corners in (3, 4)
}
"""What is told where nothing has changed, by the number of corners of a simplex."""
