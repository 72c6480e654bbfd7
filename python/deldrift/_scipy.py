"""The attributes and methods of scipy.spatial.Delaunay."""

from __future__ import annotations

import ctypes
from typing import Any, Optional

import numpy as np

from . import _library
from ._arrays import F64, I32, U32, address, answered, places
from ._core import cell_count, fixed, id_count
from ._errors import Busy, InvalidOption, InvalidValue
from ._meeting import Meeting
from ._near import Near

_copy_positions = _library.function("copy_positions")
_hull_facets = _library.function("hull_facets")
_locate_points = _library.function("locate_points")

IN_VERTEX, IN_CELL, OUTSIDE, NO_CELLS = range(4)

EPSILON = np.finfo(np.float64).eps

# Options of qhull that change nothing here: scaling, the point at infinity, triangulated and coplanar output, checks,
# and what is printed.
WITHOUT_EFFECT = frozenset("Qbb Qc Qz Qt Qx Q12 Q14 Q15 Pp Qs Qv Fv Tv".split())


def check_scipy_options(furthest_site: Any, qhull_options: Any) -> None:
    """Refuses what qhull can be asked for and is not Delaunay's triangulation of the points."""
    if furthest_site:
        raise InvalidOption(
            "furthest_site is true, and deldrift has no furthest-site triangulation: use scipy.spatial.Delaunay",
            "furthest_site",
        )
    if qhull_options is None:
        return
    text = qhull_options.decode() if isinstance(qhull_options, bytes) else str(qhull_options)
    for option in text.split():
        if option == "QJ":
            raise InvalidOption(
                "qhull_options has QJ, which moves points at random; deldrift is exact and needs no joggled points: "
                "leave it out",
                "qhull_options",
            )
        if option not in WITHOUT_EFFECT:
            raise InvalidOption(
                f"qhull_options has {option}, which deldrift does not have; options that change no triangulation are "
                + " ".join(sorted(WITHOUT_EFFECT)),
                "qhull_options",
            )


class Scipy(Near, Meeting):
    """What scipy.spatial.Delaunay has."""

    furthest_site = False
    """As in scipy; always false."""
    good = None
    """As in scipy without the option QG; always None."""

    @property
    def points(self) -> np.ndarray:
        """The positions of all ids, a row for each; NaN for removed vertices. Read-only."""
        return self._once("points", self._positions)

    def _positions(self) -> np.ndarray:
        with self._reading as t:
            positions = np.empty((id_count(t), self.ndim), F64)
            count = ctypes.c_size_t()
            self._check(_copy_positions(t, address(positions), len(positions), count))
        return fixed(positions)

    @property
    def simplices(self) -> np.ndarray:
        """The triangles or tetrahedra: rows of vertex ids, int32. Read-only.

        Triangles are counter-clockwise. Of a tetrahedron a, b, c, d the determinant of the rows b - a, c - a, d - a is
        positive. So the corners of tetrahedra are in another order than scipy's, which have no orientation, but vertices in
        one order throughout: `simplices_sorted` is for programs that rely on that. The array shows the library's memory without a copy. It keeps what it shows when the triangulation is
        changed: see `deldrift.is_current`.
        """
        return self._cell_arrays()[0]

    @property
    def simplices_sorted(self) -> np.ndarray:
        """The simplices with the corners of each in ascending order, int32, in the order of `simplices`. Read-only.

        So a facet of two simplices has its corners in the same order in both, as in scipy's tetrahedra. Neighbour k of
        `neighbors` is opposite corner k of `simplices`, not of these.

        Examples
        --------
        >>> import deldrift, itertools
        >>> tri = deldrift.Delaunay([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]])
        >>> facets = [facet for row in tri.simplices_sorted.tolist() for facet in itertools.combinations(row, 3)]
        >>> len(facets), len(set(facets))
        (8, 7)
        """
        return self._once("simplices_sorted", lambda: fixed(np.sort(self._cell_arrays()[0], axis=1)))

    @property
    def neighbors(self) -> np.ndarray:
        """For each simplex its neighbours, int32: the k-th is opposite the k-th vertex, -1 on the hull. Read-only."""
        return self._cell_arrays()[1]

    @property
    def npoints(self) -> int:
        """The number of rows of `points`: that of ids, those of removed vertices included."""
        with self._reading as t:
            return id_count(t)

    @property
    def nsimplex(self) -> int:
        """The number of simplices."""
        with self._reading as t:
            return cell_count(t)

    @property
    def min_bound(self) -> np.ndarray:
        """The least coordinates of the points."""
        return self._once("min_bound", lambda: fixed(_bound(np.fmin, self.points)))

    @property
    def max_bound(self) -> np.ndarray:
        """The greatest coordinates of the points."""
        return self._once("max_bound", lambda: fixed(_bound(np.fmax, self.points)))

    @property
    def convex_hull(self) -> np.ndarray:
        """The facets of the convex hull: rows of 2 or 3 vertex ids, int32, seen from outside."""
        return self._once("convex_hull", lambda: fixed(self._hull()))

    def _hull(self) -> np.ndarray:
        with self._reading as t:
            count = ctypes.c_size_t()
            self._check(_hull_facets(t, None, None, None, 0, count))
            facets = np.empty((count.value, self.ndim), I32)
            self._check(_hull_facets(t, address(facets), None, None, len(facets), count))
        return facets

    @property
    def transform(self) -> np.ndarray:
        """Affine maps to barycentric coordinates, of the shape (nsimplex, ndim + 1, ndim).

        For simplex i the first ndim coordinates of x are `transform[i, :ndim] @ (x - transform[i, ndim])`. Rows of
        simplices that are flat up to rounding are NaN.
        """
        return self._once("transform", lambda: fixed(_transforms(self.points, self.simplices)))

    @property
    def paraboloid_scale(self) -> float:
        """The factor by which `lift_points` multiplies."""
        return self._once("paraboloid", lambda: _paraboloid(self.points))[0]

    @property
    def paraboloid_shift(self) -> float:
        """What `lift_points` adds."""
        return self._once("paraboloid", lambda: _paraboloid(self.points))[1]

    def lift_points(self, x: Any) -> np.ndarray:
        """Points on the paraboloid above the plane or space.

        Parameters
        ----------
        x : array_like
            Points; the last axis has the coordinates.

        Returns
        -------
        ndarray
            The points with one coordinate more: that of the paraboloid.
        """
        rows, shape = places("x", x, self.ndim)
        lifted = np.empty((len(rows), self.ndim + 1), F64)
        lifted[:, :-1] = rows
        lifted[:, -1] = self.paraboloid_scale * (rows**2).sum(axis=1) + self.paraboloid_shift
        return lifted.reshape(shape + (self.ndim + 1,))

    @property
    def equations(self) -> np.ndarray:
        """The hyperplanes of the lifted simplices: unit normals, which point down, and offsets."""
        return self._once("equations", self._hyperplanes)

    def _hyperplanes(self) -> np.ndarray:
        corners = self.lift_points(self.points)[self.simplices]
        return fixed(planes(corners))

    def plane_distance(self, xi: Any) -> np.ndarray:
        """How far lifted points are from the hyperplanes of the lifted simplices.

        Parameters
        ----------
        xi : array_like
            Points; the last axis has the coordinates.

        Returns
        -------
        ndarray
            Of the shape of xi, with nsimplex entries on the last axis.
        """
        lifted = self.lift_points(xi)
        equations = self.equations
        distances: np.ndarray = lifted @ equations[:, :-1].T + equations[:, -1]
        return distances

    def find_simplex(
        self, xi: Any, bruteforce: bool = False, tol: Optional[float] = None, *, nan_policy: str = "raise"
    ) -> np.ndarray:
        """The simplices that contain points.

        Parameters
        ----------
        xi : array_like
            Points; the last axis has the coordinates.
        bruteforce : bool, optional
            Without an effect: the answer is exact in any case.
        tol : float, optional
            How far below 0 a barycentric coordinate may be. By default nothing is allowed: a point is in a simplex if
            it is so exactly, boundary included.
        nan_policy : {"raise", "omit"}, optional
            What comes of a point with a coordinate that is NaN or infinite: `NotFinite` is raised, and names it; or, as in
            scipy, it is in no simplex, and the others are answered.

        Returns
        -------
        ndarray of int
            An index for each point, -1 outside the convex hull.

        Examples
        --------
        >>> import deldrift
        >>> tri = deldrift.Delaunay([[0, 0], [4, 0], [0, 4]])
        >>> tri.find_simplex([[1, 1], [2, 2], [3, 3]])
        array([ 0,  0, -1], dtype=int32)
        >>> tri.find_simplex([[1, 1], [float("nan"), 1]], nan_policy="omit")
        array([ 0, -1], dtype=int32)
        """
        rows, shape = places("xi", xi, self.ndim)
        found = answered(rows, nan_policy, lambda some: self._simplices_at(some, shape), -1)
        if tol is not None:
            if not tol >= 0:
                raise InvalidValue(f"tol is {tol}, and must be 0 or more", "tol", None, tol)
            self._accept_near(rows, found, float(tol))
        return found.reshape(shape)

    def _simplices_at(self, rows: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
        with self._reading as t:
            locations = np.empty((len(rows), 2), U32)
            status = _locate_points(t, address(rows), len(rows), None, address(locations))
            self._check(status, positions=("xi", shape))
        kinds, indices = locations[:, 0], locations[:, 1]
        found = np.where(kinds == IN_CELL, indices, _library.NONE).astype(U32).view(I32)
        at_vertices = np.flatnonzero(kinds == IN_VERTEX)
        if len(at_vertices):
            found[at_vertices] = self._corner_simplices()[indices[at_vertices]]
        return found

    def _accept_near(self, rows: np.ndarray, found: np.ndarray, tol: float) -> None:
        """Gives points that were found outside the simplex on the hull whose coordinates of them are least negative."""
        on_hull = np.flatnonzero((self.neighbors < 0).any(axis=1))
        if tol == 0 or not len(on_hull):
            return
        maps = self.transform[on_hull]
        for i in np.flatnonzero((found < 0) & np.isfinite(rows).all(axis=1)):
            coordinates = np.einsum("kij,kj->ki", maps[:, :-1], rows[i] - maps[:, -1])
            least = np.minimum(coordinates.min(axis=1), 1 - coordinates.sum(axis=1))
            best = int(np.argmax(np.where(np.isnan(least), -np.inf, least)))
            if least[best] >= -tol:
                found[i] = on_hull[best]

    def close(self) -> None:
        """Ends changes: `add_points`, `move` and all others raise from now on; what can be read stays."""
        with self._changing:
            if self._trial is not None:
                raise Busy("a trial of the triangulation is open, and has to end before it can be closed")
            self._is_closed = True


def _bound(choose: np.ufunc, positions: np.ndarray) -> np.ndarray:
    if not len(positions):
        return np.full(positions.shape[1], np.nan)
    bound: np.ndarray = choose.reduce(positions, axis=0)
    return bound


def _transforms(positions: np.ndarray, simplices: np.ndarray) -> np.ndarray:
    ndim = positions.shape[1]
    corners = positions[simplices]
    last = corners[:, -1]
    edges = np.swapaxes(corners[:, :-1] - last[:, None], 1, 2)
    transforms = np.empty((len(simplices), ndim + 1, ndim), F64)
    transforms[:, -1] = last
    with np.errstate(all="ignore"):
        cofactors, determinants = _cofactors(edges)
        inverses = cofactors / determinants[:, None, None]
        # Conditions in the 1-norm, as LAPACK's gecon estimates them.
        conditions = np.abs(edges).sum(axis=1).max(axis=1) * np.abs(inverses).sum(axis=1).max(axis=1)
        is_flat = ~(conditions * (1000 * EPSILON) <= 1)
    transforms[:, :-1] = inverses
    transforms[is_flat] = np.nan
    return transforms


def _cofactors(matrices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The adjugates of matrices of 2 or 3 rows, and their determinants."""
    if matrices.shape[1] == 2:
        a, b, c, d = matrices[:, 0, 0], matrices[:, 0, 1], matrices[:, 1, 0], matrices[:, 1, 1]
        return np.stack([d, -b, -c, a], axis=1).reshape(-1, 2, 2), a * d - b * c
    columns = [matrices[:, :, k] for k in range(3)]
    rows = [np.cross(columns[(k + 1) % 3], columns[(k + 2) % 3]) for k in range(3)]
    return np.stack(rows, axis=1), (columns[0] * rows[0]).sum(axis=1)


def _paraboloid(positions: np.ndarray) -> tuple[float, float]:
    """The scale and shift of qhull's options Qbb and Qz, which scipy sets by default.

    Heights go from 0 to the greatest magnitude of a coordinate, which is that of the point at infinity; it is a tenth
    higher than the highest point.
    """
    heights = (positions**2).sum(axis=1)
    heights = heights[~np.isnan(heights)]
    if not len(heights) or not heights.max() > 0:
        return 1.0, 0.0
    scale = float(np.nanmax(np.abs(positions)) / (1.1 * heights.max() - heights.min()))
    return scale, float(-heights.min() * scale)


def planes(corners: np.ndarray) -> np.ndarray:
    """The hyperplane of each row of corners: a unit normal whose last entry is negative, and an offset."""
    spans = corners[:, 1:] - corners[:, :1]
    width = corners.shape[2]
    normals = np.empty((len(corners), width), F64)
    for k in range(width):
        minors = np.delete(spans, k, axis=2)
        normals[:, k] = (-1) ** k * _cofactors(minors)[1]
    with np.errstate(invalid="ignore"):
        normals /= np.sqrt((normals**2).sum(axis=1))[:, None]
    normals *= np.where(normals[:, -1] > 0, -1.0, 1.0)[:, None]
    return np.concatenate([normals, -(normals * corners[:, 0]).sum(axis=1)[:, None]], axis=1)
