"""The mesh of a domain of the plane that moves."""

from __future__ import annotations

import re
import warnings
from typing import Any, Callable, Mapping, NamedTuple, Optional

import numpy as np

from ._arrays import array_of, floats, ids as listed_ids, numbers, pairs, points as point_rows, real
from ._core import fixed
from ._delaunay import Delaunay
from ._errors import ConflictError, InvalidOption, InvalidShape, InvalidValue, PassingError
from ._library import QualityReport, Report
from ._mesh_cells import MeshCells
from ._refining import TooLarge
from ._segments import Chains, Segments

# What PyPI's triangle has in its dictionaries and a mesh makes anew.
RESULTS = frozenset({"triangles", "triangle_attributes", "neighbors", "edges", "edge_markers"})
USED = frozenset({"vertices", "segments", "segment_markers", "holes", "regions"})


class _Domain(NamedTuple):
    """Which simplices the domain has at some moment."""

    mask: np.ndarray
    region_of: np.ndarray
    """For each simplex the region, an index; -1 for none."""


class Mesh(MeshCells):
    """The triangles of a domain of the plane, whose vertices may move.

    Segments bound the domain: they are edges, and move with their ends. The triangles are those of the constrained
    Delaunay triangulation that are in the domain. What seeds name is a region, all that can be reached without crossing
    a segment; it moves with its segments, so seeds need not be given again.

    Parameters
    ----------
    vertices : array_like
        Rows of 2 coordinates. Row i is vertex i.
    segments : array_like of int
        Rows of two vertex ids, in any order.
    markers : array_like of int, optional
        A number of 32 bits to keep with each segment, or one for all; 0 by default.
    holes : array_like, optional
        Rows of 2 coordinates, a place in each hole. The domain is then all within closed chains of segments but the
        holes; one outside of all chains has no effect, and is told by a warning. One on the boundary of a region raises
        `AmbiguousSeed`. Without it `keep` says what the domain is.
    regions : array_like, optional
        Rows of 2 coordinates and a label: `labels` has it for all triangles of the region where the place is. Of two in
        one region the first counts. Outside of all chains, and on boundaries, they are as holes there.
    keep : {"nesting", "even-odd"}, optional
        What the domain is without `holes`: the triangles with an odd number of edges that have segments on the way to the
        outside, at least, which is 1 in an outline and 2 in its holes, however often a segment is given; or those with an
        odd number of segments on the way, where each of several at one edge counts, as the even-odd rule has it. They
        differ where chains share sides: a notch that is a chain of its own along a side is part of the domain by
        "nesting", the default, as segments are walls, and is none by "even-odd".
    split : bool, optional
        Whether segments that cross, overlap or have a vertex on them are split, as by `Step.split`: a vertex comes
        where two cross, rounded correctly, with an id behind those of `vertices`, and pieces have the marker of their
        segment. Otherwise they raise `ConflictError`. Moves split nothing.
    degenerate : {"refuse", "drop"}, optional
        What becomes of segments of no length, between a vertex and itself or another one at its place, and of those
        that repeat an earlier one, in either direction. By default the former raise `ConflictError`, and the latter are
        kept, each with its id. With "drop" both are left out; the ids of those that stay have no gaps.
    algorithm, threads, parts, coincidence, passing, progress, cancel
        As of `Delaunay`.

    Examples
    --------
    >>> import deldrift
    >>> square, hole = [[0, 0], [4, 0], [4, 4], [0, 4]], [[1, 1], [2, 1], [2, 2]]
    >>> segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 4]]
    >>> mesh = deldrift.Mesh(square + hole, segments, markers=[1, 1, 1, 1, 2, 2, 2])
    >>> len(mesh.triangles), mesh.boundary.markers.tolist()
    (7, [1, 1, 1, 1, 2, 2, 2])
    >>> report = mesh.move(square + [[2, 1], [3, 2], [2, 2]])
    >>> len(mesh.triangles)
    7
    """

    def __init__(
        self,
        vertices: Any,
        segments: Any,
        markers: Any = None,
        holes: Any = None,
        regions: Any = None,
        *,
        keep: str = "nesting",
        split: bool = False,
        degenerate: str = "refuse",
        algorithm: str = "auto",
        threads: int = 0,
        parts: int = 0,
        coincidence: str = "merge",
        passing: str = "ignore",
        progress: Any = None,
        cancel: Optional[Callable[[], bool]] = None,
    ) -> None:
        if keep not in ("nesting", "even-odd"):
            raise InvalidValue(f"keep is {keep!r}, and must be one of 'nesting', 'even-odd'", "keep")
        if degenerate not in ("refuse", "drop"):
            raise InvalidValue(f"degenerate is {degenerate!r}, and must be one of 'refuse', 'drop'", "degenerate")
        self._keep = keep
        places = None if holes is None else _rows("holes", holes, 2)
        labelled = _rows("regions", regions, 3)
        self._tri = tri = Delaunay.__new__(Delaunay)
        rows = point_rows("vertices", vertices, 2)
        if degenerate == "drop":
            segments, markers = _without_degenerate(rows, segments, markers)
        tri._create(rows, algorithm, (threads, parts), coincidence, passing, progress, cancel, "vertices")
        with tri.step() as step:
            tri._stage_segments(segments, markers, "segments", "markers")
            if split:
                step.split()
        hole_of = None if places is None else self._inside(places, "holes")
        region_of = self._inside(np.ascontiguousarray(labelled[:, :2]), "regions")
        self._has_holes = places is not None
        # Which of the regions given are not in that of another one, nor outside.
        named = np.unique(region_of[region_of >= 0])
        self._named = named.tolist()
        # The last entry is that of triangles without a region.
        self._labels = np.append(labelled[self._named, 2], 0.0)
        # A number for each pair of what is said of a region, which the library keeps: 0 for nothing.
        codes = np.where(region_of >= 0, np.searchsorted(named, region_of) + 1, 0)
        if hole_of is not None:
            codes += np.where(hole_of >= 0, len(self._labels), 0)
        tri.set_regions(codes)

    @classmethod
    def from_triangle(cls, data: Mapping[str, Any], switches: str = "", **options: Any) -> "Mesh":
        """The mesh of a dictionary as PyPI's `triangle` takes and gives it, and as `to_dict` does.

        As there the domain is all within closed chains of segments but the holes. Other attributes, and markers of
        vertices, have no counterpart: they are left out with a warning.

        Parameters
        ----------
        data : dict
            With `vertices`, `segments` and, optionally, `segment_markers`, `holes` and `regions`, which are rows of x, y,
            label and greatest area.
        switches : str, optional
            As of `triangle.triangulate`, those for which the mesh is refined: `q`, with the least angle behind it or 20
            degrees; `a`, with a greatest area behind it, or alone for those of regions; `D` for triangles that are Delaunay
            beside segments, too; `Y` to keep the boundary of the domain whole, and `YY` all segments; `S` with a greatest
            number of new vertices. `p` and `A` are what is done anyway, and others raise.
        **options
            As of `Mesh`: `split`, which Triangle always does, `degenerate`, `algorithm`, `threads`, `parts`,
            `coincidence`, `passing`, `progress` and `cancel`.

        Returns
        -------
        Mesh
            Vertices and segments have the ids of their rows, unless segments are dropped; new ones follow.

        Examples
        --------
        >>> import deldrift
        >>> square = {"vertices": [[0, 0], [4, 0], [4, 4], [0, 4]], "segments": [[0, 1], [1, 2], [2, 3], [3, 0]]}
        >>> len(deldrift.Mesh.from_triangle(square).triangles)
        2
        >>> len(deldrift.Mesh.from_triangle(square, "pq30a0.1").triangles) >= 160
        True
        """
        wanted, has_areas = _switches(switches)
        if not isinstance(data, Mapping):
            raise TypeError(f"data is a {type(data).__name__}, and must be a dictionary as of PyPI's triangle")
        for name in "vertices", "segments":
            if name not in data:
                raise InvalidValue(f"data has no {name!r}, which a mesh needs", "data")
        unused = sorted(map(str, set(data) - USED - RESULTS))
        if unused:
            warnings.warn("from_triangle leaves out what a mesh does not have: " + ", ".join(unused), stacklevel=2)
        regions, areas = data.get("regions"), np.empty(0)
        rows = np.empty(0) if regions is None else floats("regions", regions)
        if rows.size:
            if rows.ndim != 2 or rows.shape[1] != 4:
                raise InvalidShape(
                    f"regions has the shape {rows.shape}, and must have rows of x, y, label and greatest area", "regions"
                )
            regions, areas = rows[:, :3], rows[:, 3]
        markers = data.get("segment_markers")
        if markers is not None:
            column = array_of("segment_markers", markers)
            column = column.reshape(-1) if column.shape[1:] == (1,) else column
            markers = numbers("segment_markers", column, len(pairs("segments", data["segments"])), "segments")
        mesh = cls(data["vertices"], data["segments"], markers, data.get("holes", ()), regions, **options)
        if has_areas:
            # As in Triangle no area is one that is not above 0.
            bounds = np.append(np.where(areas > 0, areas, 0)[mesh._named], 0)
            wanted.update(mesh._selected_by_region(bounds))
        if wanted:
            mesh._tri.refine(**{"mask": mesh.mask, **wanted})
        return mesh

    def _inside(self, places: np.ndarray, argument: str) -> np.ndarray:
        """For each simplex the first of some places that is in its region; -1 outside, and for none."""
        tri = self._tri
        region_of = tri._labels_at(places, np.arange(len(places), dtype=np.int32), -1, argument)
        is_outside = tri.nesting_levels() == 0
        region_of[is_outside] = -1
        # The last entry is that of places outside of the convex hull.
        for k in np.flatnonzero(np.append(is_outside, True)[tri.find_simplex(places)]):
            warnings.warn(
                f"{argument}[{k}] is outside of all closed chains of segments, and has no effect", stacklevel=3
            )
        return region_of

    def _domain(self) -> _Domain:
        levels, codes = self._tri.nesting_levels(), self._tri.regions().labels
        if self._has_holes:
            mask = (levels > 0) & (codes < len(self._labels))
        else:
            mask = (self._tri.crossing_numbers() if self._keep == "even-odd" else levels) % 2 == 1
        return _Domain(fixed(mask), fixed(codes % len(self._labels) - 1))

    def _found(self) -> _Domain:
        return self._tri._once("domain", self._domain)

    @property
    def delaunay(self) -> Delaunay:
        """The constrained Delaunay triangulation, of the whole convex hull: what else can be asked, and steps."""
        return self._tri

    @property
    def points(self) -> np.ndarray:
        """The positions of all vertices, a row for each id. Read-only."""
        return self._tri.points

    @property
    def segments(self) -> Segments:
        """The segments: `ids`, `ends` and `markers`. Read-only."""
        return self._tri.segments

    @property
    def mask(self) -> np.ndarray:
        """Which simplices of `delaunay` are in the domain. Read-only."""
        return self._found().mask

    @property
    def triangles(self) -> np.ndarray:
        """The triangles of the domain: rows of vertex ids, counter-clockwise. Read-only."""
        return self._tri._once("triangles", lambda: fixed(self._tri.simplices[self.mask]))

    @property
    def labels(self) -> np.ndarray:
        """For each of `triangles` the label of its region; 0 where none was given. Read-only."""
        return self._tri._once("labels", lambda: fixed(self._labels[self._found().region_of[self.mask]]))

    @property
    def boundary(self) -> Chains:
        """The boundary of the domain, in closed chains of edges with markers; `simplices` are those of `delaunay`."""
        return self._tri._once("boundary", lambda: self._tri.boundary_chains(self.mask))

    @property
    def passings(self) -> np.ndarray:
        """The vertices that have passed segments in the last move, with passing="tell": see `Delaunay.passings`."""
        return self._tri.passings

    def move(self, points: Any, ids: Any = None) -> Report:
        """Moves vertices, and makes that the next timestamp.

        What counts is where they are at the end: a vertex that has jumped over a segment is on its other side. With
        passing="tell" it is told by `passings`, with passing="refuse" `PassingError` is raised and nothing moves.

        Parameters
        ----------
        points : array_like
            A row of coordinates for each vertex.
        ids : array_like of int, optional
            The vertices that move, each at most once; all by default.

        Returns
        -------
        Report
            What was done. If segments would cross, or a vertex be on one, `ConflictError` is raised and nothing moves.
        """
        return self._tri.move(points, ids)

    def advance(self, points: Any, ids: Any = None, cut: float = 0.5, least: float = 1e-3) -> float:
        """Moves vertices towards places, as far as segments let them: cuts the step while it conflicts, or, with
        passing="refuse", while a vertex would pass a segment.

        Parameters
        ----------
        points : array_like
            A row of coordinates for each vertex: where it is to go, on a straight line.
        ids : array_like of int, optional
            The vertices that move, each at most once; all by default.
        cut : float, optional
            What a step that conflicts is multiplied by, between 0 and 1.
        least : float, optional
            The least part of the step to try.

        Returns
        -------
        float
            The part of the way that was made, 1 for all of it. If even the least part conflicts, `ConflictError` is
            raised, or `PassingError`, and nothing moves.

        Examples
        --------
        >>> import deldrift
        >>> triangle = [[0, 1], [1, 2], [2, 0]]
        >>> mesh = deldrift.Mesh([[0, 0], [4, 0], [0, 4], [1, 1]], triangle)
        >>> mesh.advance([[3, 1]], ids=[3])
        0.5
        >>> mesh.points[3]
        array([2., 1.])
        """
        factor, smallest = real("cut", cut), real("least", least)
        if not 0 < factor < 1:
            raise InvalidValue(f"cut is {factor:g}, and must be between 0 and 1", "cut", None, factor)
        if not 0 < smallest <= 1:
            raise InvalidValue(f"least is {smallest:g}, and must be above 0 and at most 1", "least", None, smallest)
        part, places = 1.0, points
        while True:
            try:
                self._tri.move(places, ids)
                return part
            except (ConflictError, PassingError):
                part *= factor
                if part < smallest:
                    raise
                goals = point_rows("points", points, 2)
                start = self._tri.points if ids is None else self._tri.points[listed_ids("ids", ids)]
                places = start + part * (goals - start)

    def refine(
        self,
        *,
        least_angle: float = 0.0,
        greatest_area: float = 0.0,
        areas: Optional[Mapping[float, float]] = None,
        sizes: Any = None,
        is_too_large: Optional[TooLarge] = None,
        keep: str = "none",
        limit: Optional[int] = None,
        is_conforming: bool = False,
        reuse_ids: bool = False,
        values: Any = None,
    ) -> QualityReport:
        """Inserts vertices until the triangles of the domain are of a quality, and makes that the next timestamp.

        New triangles have the label of the region that they are in. Segments may be split, and pieces take the place of
        one, with its marker; holes and regions stay what they are.

        Parameters
        ----------
        least_angle, greatest_area
            As of `Delaunay.refine`.
        areas : dict, optional
            The greatest area of triangles by the label of their region, 0 for any.
        sizes, is_too_large, keep, limit, is_conforming, reuse_ids, values
            As of `Delaunay.refine`.

        Returns
        -------
        QualityReport
            What was done. `values` has the values by the ids that there are now.

        Examples
        --------
        >>> import deldrift
        >>> square = [[0, 1], [1, 2], [2, 3], [3, 0]]
        >>> mesh = deldrift.Mesh([[0, 0], [4, 0], [4, 4], [0, 4]], square, regions=[[1, 1, 5]])
        >>> report = mesh.refine(least_angle=30, areas={5: 0.1}, values={"x": mesh.points[:, 0]})
        >>> report.inserted == len(mesh.points) - 4, report.bad_cells, len(report.values["x"]) == len(mesh.points)
        (True, 0, True)
        >>> len(mesh.triangles) >= 160, set(mesh.labels.tolist())
        (True, {5.0})
        """
        return self._tri.refine(
            least_angle=least_angle,
            greatest_area=greatest_area,
            sizes=sizes,
            is_too_large=is_too_large,
            keep=keep,
            limit=limit,
            is_conforming=is_conforming,
            reuse_ids=reuse_ids,
            values=values,
            **self._selected(areas),
        )

    def coarsen(
        self,
        *,
        least_angle: float = 0.0,
        greatest_area: float = 0.0,
        areas: Optional[Mapping[float, float]] = None,
        sizes: Any = None,
        is_too_large: Optional[TooLarge] = None,
        keep: str = "none",
        margin: float = 2.0,
        share: float = 0.9,
        joins: float = 1e-9,
        growth: float = 1.1,
        is_conforming: bool = False,
    ) -> QualityReport:
        """Removes vertices that `refine` has inserted and that are not needed any more.

        Parameters
        ----------
        least_angle, greatest_area
            As of `Delaunay.coarsen`.
        areas : dict, optional
            The greatest area of triangles by the label of their region, 0 for any.
        sizes, is_too_large, keep, margin, share, joins, growth, is_conforming
            As of `Delaunay.coarsen`.

        Returns
        -------
        QualityReport
            What was done. Ids of the vertices that stay are as they were.
        """
        return self._tri.coarsen(
            least_angle=least_angle,
            greatest_area=greatest_area,
            sizes=sizes,
            is_too_large=is_too_large,
            keep=keep,
            margin=margin,
            share=share,
            joins=joins,
            growth=growth,
            is_conforming=is_conforming,
            **self._selected(areas),
        )

    def _selected(self, areas: Optional[Mapping[float, float]]) -> dict[str, Any]:
        """The domain as refinement takes it, and the greatest area of each region."""
        if areas is None:
            return {"mask": self.mask}
        if not isinstance(areas, Mapping):
            raise TypeError(f"areas is {areas!r}, and must be a dictionary of areas by label")
        known = self._labels.tolist()
        for label, area in areas.items():
            if label not in known:
                raise InvalidValue(f"areas has the label {label!r}, which no region has", "areas")
            if not real(f"areas[{label!r}]", area) >= 0:
                raise InvalidValue(f"areas[{label!r}] is {area}, and must be 0 or above", "areas", None, area)
        return self._selected_by_region([areas.get(label, 0) for label in known])

    def _selected_by_region(self, areas: Any) -> dict[str, Any]:
        """`areas`: for each region, and at the end for triangles without one."""
        region_of = self._found().region_of
        labels = np.where(region_of < 0, len(self._named), region_of)
        return {"mask": self.mask, "labels": labels, "areas": areas}

    def to_dict(self) -> dict[str, np.ndarray]:
        """The mesh as a dictionary in the manner of PyPI's `triangle`.

        Returns
        -------
        dict of ndarray
            `vertices` (those that are present), `triangles` of the domain, `segments`, `segment_markers`; `holes`, a
            place in each, if there are some; `regions` and `triangle_attributes`, their labels, if there are regions.
            Places are rounded centroids of the largest triangles.
        """
        tri, (mask, region_of) = self._tri, self._found()
        is_present = ~np.isnan(tri.points[:, 0])
        rows = (np.cumsum(is_present) - 1).astype(np.int32)
        segments = tri.segments
        data = {
            "vertices": tri.points[is_present],
            "triangles": rows[self.triangles],
            "segments": rows[segments.ends],
            "segment_markers": segments.markers.reshape(-1, 1).copy(),
        }
        holes = [self._place_in(hole) for hole in self._hole_masks(mask)]
        if holes:
            data["holes"] = np.array(holes)
        of_regions = [(k, region_of == k) for k in range(len(self._named))]
        regions = [(*self._place_in(of), self._labels[k], 0) for k, of in of_regions if of.any()]
        if self._named:
            data["regions"] = np.array(regions, np.float64).reshape(-1, 4)
            data["triangle_attributes"] = self.labels.reshape(-1, 1).copy()
        return data

    def _hole_masks(self, mask: np.ndarray) -> list[np.ndarray]:
        """The simplices of each hole: of each region within chains of segments that is not in the domain."""
        masks, is_left = [], ~mask & (self._tri.nesting_levels() > 0)
        while is_left.any():
            place = np.array([self._place_in(is_left)])
            masks.append(self._tri._labels_at(place, np.zeros(1, np.int32), -1, "holes") == 0)
            is_left &= ~masks[-1]
        return masks

    def _place_in(self, mask: np.ndarray) -> tuple[float, float]:
        """The centroid of the largest simplex of a region."""
        tri = self._tri
        chosen = np.flatnonzero(mask)
        largest = chosen[np.argmax(tri._once("volumes", tri.volumes)[chosen])]
        x, y = tri.points[tri.simplices[largest]].mean(axis=0)
        return float(x), float(y)

    def copy(self) -> "Mesh":
        """An independent mesh that is as this one.

        Returns
        -------
        Mesh
            After the same moves it has the same triangles.
        """
        made = type(self).__new__(type(self))
        made.__dict__.update(self.__getstate__())
        made._tri = self._tri.copy()
        return made

    def __copy__(self) -> "Mesh":
        return self.copy()

    def __deepcopy__(self, _memo: Any) -> "Mesh":
        return self.copy()

    def __repr__(self) -> str:
        return f"<deldrift.Mesh of {len(self.triangles)} triangles within {len(self.segments.ids)} segments>"


def _joined(segments: np.ndarray, vertices: np.ndarray) -> np.ndarray:
    """One number for each pair of a segment and a vertex."""
    joined: np.ndarray = segments.astype(np.int64) << 32 | vertices
    return joined


def _without_degenerate(rows: np.ndarray, segments: Any, markers: Any) -> tuple[np.ndarray, Any]:
    """Segments, and their markers, but for those of no length and those that an earlier one is a repetition of."""
    ends = pairs("segments", segments)
    values = None if markers is None else numbers("markers", markers, len(ends), "segments")
    if (ends >= len(rows)).any():  # The library says which one.
        return ends, values
    # Adding zero makes the two zeros one.
    places = np.unique(rows + 0.0, axis=0, return_inverse=True)[1].reshape(-1)
    low, high = np.sort(places[ends], axis=1).T
    first = np.unique(_joined(low, high), return_index=True)[1]
    kept = np.sort(first[low[first] < high[first]])
    return ends[kept], None if values is None else values[kept]


SWITCH = re.compile(r"[pA]|(?P<angle>q)(?P<degrees>[\d.]*)|(?P<area>a)(?P<most>[\d.]*)|(?P<keep>YY?)|S(?P<limit>\d+)|(?P<circles>D)")


def _switches(text: Any) -> tuple[dict[str, Any], bool]:
    """Arguments for refinement, and whether regions have a greatest area, by switches of Triangle's."""
    if not isinstance(text, str):
        raise TypeError(f"switches is {text!r}, and must be a string")
    wanted: dict[str, Any] = {}
    has_areas, at = False, 0
    while at < len(text):
        found = SWITCH.match(text, at)
        if found is None:
            raise InvalidOption(f"switches has {text[at:]!r}, and may have p, A, q, a, D, Y, YY and S", "switches")
        if found["angle"]:
            wanted["least_angle"] = real("switches", found["degrees"] or 20)
        elif found["most"]:
            wanted["greatest_area"] = real("switches", found["most"])
        elif found["area"]:
            has_areas = True
        elif found["keep"]:
            wanted["keep"] = "all" if found["keep"] == "YY" else "outer"
        elif found["limit"]:
            wanted["limit"] = int(found["limit"])
        elif found["circles"]:
            wanted["is_conforming"] = True
        at = found.end()
    return wanted, has_areas


def _rows(argument: str, values: Any, width: int) -> np.ndarray:
    """Rows of some numbers; none for None."""
    array = np.empty(0) if values is None else floats(argument, values)
    if not array.size:
        return np.empty((0, width))
    if array.ndim != 2 or array.shape[1] != width:
        raise InvalidShape(f"{argument} has the shape {array.shape}, and must have rows of {width} numbers", argument)
    return array
