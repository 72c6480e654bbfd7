"""The attributes of scipy.spatial.Voronoi in the plane, for programs that take one: pyAFV, and models of tissue.

simulator._voronoi = Diagrams()       # pyAFV: each call moves the points of the one before
"""

import numpy as np

import deldrift


class Voronoi:
    """The Voronoi diagram of a triangulation: vertices are its circumcentres, ridges its edges."""

    def __init__(self, tri):
        self.points = tri.points
        self.vertices, _ = tri.circumcentres()
        cells = np.repeat(np.arange(tri.nsimplex), 3)
        beyond = tri.neighbors.ravel()
        # Each edge once: from the cell of lower index, or from the only one.
        is_first = (beyond < 0) | (cells < beyond)
        ends = np.stack([np.roll(tri.simplices, -1, axis=1), np.roll(tri.simplices, 1, axis=1)], axis=2).reshape(-1, 2)
        self.ridge_points = ends[is_first]
        # scipy has the vertex at infinity first.
        self.ridge_vertices = np.stack([np.minimum(beyond, cells), np.maximum(beyond, cells)], axis=1)[
            is_first
        ].tolist()
        on_hull = np.zeros(tri.npoints, bool)
        on_hull[tri.convex_hull] = True
        self.regions = [tri.star(v, ordered=True).tolist() + ([-1] if on_hull[v] else []) for v in range(tri.npoints)]
        self.point_region = np.arange(tri.npoints)


class Diagrams:
    """Makes diagrams of points that move: called as scipy.spatial.Voronoi is."""

    def __init__(self):
        self.tri = None

    def __call__(self, points, qhull_options=None):
        deldrift.Delaunay(points[:0], qhull_options=qhull_options)
        if self.tri is None or self.tri.npoints != len(points):
            self.tri = deldrift.Delaunay(points)
        else:
            self.tri.move(points)
        return Voronoi(self.tri)
