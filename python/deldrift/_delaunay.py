"""The class of triangulations, and how they are made."""

from __future__ import annotations

import ctypes
from typing import Any, Callable, Optional

import numpy as np

from . import _library
from ._arrays import Handle, address, address_if, keys as given_keys, points as point_rows
from ._asking import Asking
from ._callbacks import calling
from ._core import Division, check, make_options
from ._files import Files
from ._geometry import Geometry
from ._loading import given_callbacks, made, of_bytes, of_file
from ._motion import Motion
from ._refining import Refining
from ._scipy import check_scipy_options
from ._transferring import Transferring
from ._writing import Path

_create = _library.function("create_with_keys")
_clone = _library.function("clone")


SEGMENT_ARGUMENTS = "segments", "segment_markers"


class Delaunay(Motion, Refining, Transferring, Asking, Geometry, Files):
    """The Delaunay triangulation of points in the plane or in space, whose points may move.

    Simplices are exact, and a function of positions and keys alone, which are ids by default: ties between cocircular and
    cospherical points are broken by key. Of points at one place that of the lowest key, and of those that of the lowest id,
    is in simplices, and the others in none (see `coplanar`). Points that do not span the
    dimension have no simplices.

    Parameters
    ----------
    points : array_like
        A row of 2 or 3 coordinates for each point: of any type of real numbers, which are rounded to doubles where they
        are none, in any order of memory, with `__array__` or DLPack. Row i is vertex i.
    incremental : bool, optional
        Without an effect: points can always be added.
    furthest_site : bool, optional
        Must be false.
    qhull_options : str, optional
        Options of qhull that change no triangulation; others raise.
    algorithm : {"auto", "rebuilding", "placement_flips", "tolerance", "repair"}, optional
        How `move` and steps bring the triangulation to new positions. All give the same simplices.
    threads : int, optional
        The most threads that a call may use, 0 for as many as make it faster.
    parts : int, optional
        The most parts into which work is divided where that shows in the order of simplices, 0 for one a thread. With
        any other number the same calls give the same answers, to the last bit, on any number of threads.
    coincidence : {"merge", "reject"}, optional
        Whether points at one place are legal, or raise `Coincident`.
    passing : {"ignore", "tell", "refuse"}, optional
        What happens when a vertex would pass a segment: it is not looked for, or `passings` has those that have passed in
        the last step, or the change raises `PassingError`.
    progress : callable or tqdm, optional
        Called during long calls with the part that is done, from 0 to 1. An exception cancels the call. May be a bar of
        tqdm, or `tqdm.tqdm`.
    cancel : callable, optional
        Called during long calls; when it returns true, the call raises `Cancelled` and has no effect.
    segments : array_like of int, optional
        In 2D: rows of two vertex ids. Each is to be an edge, also when its ends move; the timestamp is then 1, as
        segments are laid by a commit.
    segment_markers : array_like of int, optional
        A number of 32 bits to keep with each segment, or one for all; 0 by default.
    keys : array_like of int, optional
        A key for each point: unsigned numbers of 64 bits, by which ties are broken in place of ids. Points of equal keys
        are in the order of x, then y, then z. So simplices do not depend on the order in which points are given.

    Examples
    --------
    >>> import deldrift
    >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3], [1, 1]])
    >>> len(tri.simplices)
    4
    >>> report = tri.move([[0, 0], [4, 0], [4, 3], [0, 3], [3, 2]])
    >>> report.moved, tri.timestamp
    (1, 1)
    """

    def __init__(
        self,
        points: Any,
        incremental: bool = False,
        furthest_site: bool = False,
        qhull_options: Optional[str] = None,
        *,
        algorithm: str = "auto",
        threads: int = 0,
        parts: int = 0,
        coincidence: str = "merge",
        passing: str = "ignore",
        progress: Any = None,
        cancel: Optional[Callable[[], bool]] = None,
        segments: Any = None,
        segment_markers: Any = None,
        keys: Any = None,
    ) -> None:
        check_scipy_options(furthest_site, qhull_options)
        rows = point_rows("points", points)
        self._create(rows, algorithm, (threads, parts), coincidence, passing, progress, cancel, keys=keys)
        if segments is not None or segment_markers is not None:
            with self.step():
                self._stage_segments(() if segments is None else segments, segment_markers, *SEGMENT_ARGUMENTS)

    def _create(
        self,
        rows: np.ndarray,
        algorithm: str,
        division: Division,
        coincidence: str,
        passing: str,
        progress: Any,
        cancel: Optional[Callable[[], bool]],
        name: str = "points",
        keys: Any = None,
    ) -> None:
        given = given_keys("keys", keys, len(rows))
        callbacks = given_callbacks(progress, cancel)
        options = make_options(algorithm, division, coincidence, passing, callbacks)
        handle = Handle(callbacks)
        status = calling(
            callbacks, _create, rows.shape[1], address(rows), address_if(given), len(rows), options, handle.made
        )
        check(status, {"positions": name}, callbacks)
        self._start(handle, rows.shape[1], division, coincidence, passing, callbacks)

    def add_points(self, points: Any, restart: bool = False) -> None:
        """Inserts points, whose ids follow those that have been given.

        Parameters
        ----------
        points : array_like
            A row of coordinates for each.
        restart : bool, optional
            Without an effect: simplices depend on positions and keys alone.
        """
        with self.step() as step:
            step.insert(points)

    def copy(self) -> "Delaunay":
        """An independent triangulation that is as this one.

        Returns
        -------
        Delaunay
            After the same calls it has the same simplices. It calls the same callbacks.
        """
        handle = Handle(self._callbacks)
        with self._reading as t:
            self._check(_clone(t, handle.made))
        return made(type(self), handle, self._division, self._coincidence, self._passing, self._callbacks)

    def __copy__(self) -> "Delaunay":
        return self.copy()

    def __deepcopy__(self, _memo: Any) -> "Delaunay":
        return self.copy()

    def __reduce__(self) -> Any:
        options = self.algorithm, self._division, self._coincidence, self._passing
        return _unpickled, (type(self), self.tobytes(), *options)

    def __repr__(self) -> str:
        return f"<deldrift.Delaunay of {self.nvertices} points in {self.ndim}D, {self.nsimplex} simplices>"


def _unpickled(
    kind: type[Delaunay], data: bytes, algorithm: str, division: Division, coincidence: str, passing: str
) -> Delaunay:
    return of_bytes(kind, data, algorithm, division, coincidence, passing)


def load(
    path: Path,
    *,
    algorithm: str = "auto",
    threads: int = 0,
    parts: int = 0,
    coincidence: str = "merge",
    passing: str = "ignore",
    progress: Any = None,
    cancel: Optional[Callable[[], bool]] = None,
) -> Delaunay:
    """Makes a triangulation of a file that `Delaunay.save` has written.

    Parameters
    ----------
    path : str or path
        Of the file.
    algorithm, threads, parts, coincidence, passing, progress, cancel
        As of `Delaunay`; they are not saved.

    Returns
    -------
    Delaunay
        As the one that was saved, simplices with their indices included.

    Examples
    --------
    >>> import deldrift, os, tempfile
    >>> path = os.path.join(tempfile.mkdtemp(), "square")
    >>> deldrift.Delaunay([[0, 0], [4, 0], [4, 3], [0, 3]]).save(path)
    >>> deldrift.load(path)
    <deldrift.Delaunay of 4 points in 2D, 2 simplices>
    """
    return of_file(Delaunay, path, algorithm, (threads, parts), coincidence, passing, progress, cancel)


def frombytes(
    data: Any,
    *,
    algorithm: str = "auto",
    threads: int = 0,
    parts: int = 0,
    coincidence: str = "merge",
    passing: str = "ignore",
    progress: Any = None,
    cancel: Optional[Callable[[], bool]] = None,
) -> Delaunay:
    """Makes a triangulation of bytes that `Delaunay.tobytes` gave.

    Parameters
    ----------
    data : bytes-like
        The bytes. Whatever they are, nothing is loaded that is not a Delaunay triangulation, exactly.
    algorithm, threads, parts, coincidence, passing, progress, cancel
        As of `Delaunay`; they are not saved.

    Returns
    -------
    Delaunay
        As the one that was saved, simplices with their indices included.
    """
    return of_bytes(Delaunay, data, algorithm, (threads, parts), coincidence, passing, progress, cancel)


def tsearch(tri: Any, xi: Any, *, nan_policy: str = "raise") -> np.ndarray:
    """The simplices that contain points: `tri.find_simplex(xi)`.

    Parameters
    ----------
    tri : Delaunay
        The triangulation.
    xi : array_like
        Points; the last axis has the coordinates.
    nan_policy : {"raise", "omit"}, optional
        As of `Delaunay.find_simplex`.

    Returns
    -------
    ndarray of int
        An index for each point, -1 outside the convex hull.
    """
    found: np.ndarray = tri.find_simplex(xi, nan_policy=nan_policy)
    return found
