"""adaptive's triangulation on deldrift: `LearnerND(f, bounds, triangulation_backend=Triangulation)`.

A point is inserted at the cost of the simplices around it. `Delaunay.changes` says which were removed and added: what
adaptive asks of `add_point`.
"""

import adaptive.learner.triangulation
import numpy as np

import deldrift


class Triangulation(adaptive.learner.triangulation.Triangulation):
    """Of points in 2D or 3D."""

    def __init__(self, coords):
        super().__init__(coords)
        self._transform = None
        self._rebuild(None)

    def _rebuild(self, transform):
        """Starts from nothing, in the metric of a transform; gives the simplices removed and added."""
        before = set(self.simplices)
        self._transform = transform
        self._tri = deldrift.Delaunay(self._at(self.vertices))
        self._tri.changes()
        after = rows_of(self._tri.simplices)
        self._replace(before - after, after - before)
        return before - after, after - before

    def _at(self, coords):
        coords = np.asarray(coords, float)
        return coords if self._transform is None else coords @ self._transform

    def _replace(self, removed, added):
        for simplex in removed:
            self.delete_simplex(simplex)
        for simplex in added:
            self.add_simplex(simplex)

    def locate_point(self, point):
        found = int(self._tri.find_simplex(self._at(point)))
        return () if found < 0 else tuple(sorted(self._tri.simplices[found].tolist()))

    def add_point(self, point, simplex=None, transform=None):
        point = tuple(point)
        if simplex and not self.get_reduced_simplex(point, simplex):
            raise ValueError("Point lies outside of the specified simplex.")
        if self._tri.locate(self._at(point)).kinds == 0:
            raise ValueError("Point already in triangulation.")
        self.vertices.append(point)
        self.vertex_to_simplices.append(set())
        if not np.array_equal(transform, self._transform):
            return self._rebuild(transform)
        self._tri.insert(self._at(point))
        changes = self._tri.changes()
        removed, added = rows_of(changes.removed_simplices), rows_of(self._tri.simplices[changes.created])
        self._replace(removed, added)
        return removed, added


def rows_of(simplices):
    return set(map(tuple, np.sort(simplices, axis=1).tolist()))
