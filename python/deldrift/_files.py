"""Saving, and other forms of a triangulation."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._errors import InvalidDimension
from ._scipy import Scipy
from ._segments import Segmented
from ._writing import Writing


class Files(Scipy, Segmented, Writing):
    """Saving, and other forms of a triangulation."""

    def to_meshio(self) -> Any:
        """The triangulation as a mesh of meshio, which must be installed.

        Returns
        -------
        meshio.Mesh
            Its points are the vertices that are present; their ids are the point data "vertex". Segments are cells of
            the type "line", behind the simplices: their markers are the cell data "marker", which is 0 for simplices.
        """
        import meshio

        is_present = ~np.isnan(self.points[:, 0])
        rows = np.cumsum(is_present) - 1
        kind = "triangle" if self.ndim == 2 else "tetra"
        cells, data, segments = [(kind, rows[self.simplices])], {}, self.segments
        if len(segments.ids):
            cells.append(("line", rows[segments.ends]))
            data["marker"] = [np.zeros(len(self.simplices), np.int32), segments.markers]
        return meshio.Mesh(
            self.points[is_present], cells, point_data={"vertex": np.flatnonzero(is_present)}, cell_data=data
        )

    def plot(self, ax: Any = None, **style: Any) -> Any:
        """Draws triangles, and segments above them, with matplotlib, which must be installed; in 2D.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where; the current axes by default.
        **style
            What `Axes.triplot` takes, for the triangles. Segments are black lines of a width of 2.

        Returns
        -------
        matplotlib.axes.Axes
            Where it is drawn.
        """
        if self.ndim != 2:
            raise InvalidDimension("plot draws triangles, and the triangulation is one of tetrahedra: see write_vtu")
        if ax is None:
            import matplotlib.pyplot as plt

            ax = plt.gca()
        points = self.points
        if len(self.simplices):
            # matplotlib looks at all points, and cannot take NaN.
            used, rows = np.unique(self.simplices, return_inverse=True)
            ax.triplot(points[used, 0], points[used, 1], rows.reshape(self.simplices.shape), **style)
        ends = self.segments.ends
        if len(ends):
            from matplotlib.collections import LineCollection

            ax.add_collection(LineCollection(points[ends], colors="black", linewidths=2, zorder=3))
            ax.autoscale_view()
        ax.set_aspect("equal")
        return ax
