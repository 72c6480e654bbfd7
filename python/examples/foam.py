"""A foam: Voronoi cells in a periodic box, whose points go to the centroids of their cells until they rest (Lloyd).

From random points, cells come to have equal volumes, and less surface. From a body-centred lattice that was disturbed
they find Kelvin's cell again, a truncated octahedron. `python foam.py docs/foam.svg` draws what is in the box.
"""

import itertools
import pathlib
import sys

import numpy as np

import deldrift

KELVIN = 36 * np.pi * 128 / (6 + 12 * np.sqrt(3)) ** 3
"""The isoperimetric quotient of Kelvin's cell with plane facets, 0.753. That of a ball is 1."""


class Foam:
    """The cells: their volumes, their surfaces, and how far their centroids are from their points."""

    def __init__(self, tri):
        self.points, self.vectors = tri.points, tri.vectors
        self.simplices, self.shifts, self.corners = tri.simplices, tri.shifts, tri.corners
        corners = self.corners
        sides = corners[:, 1:] - corners[:, :1]
        squares = (sides**2).sum(axis=2, keepdims=True)
        self.centres = corners[:, 0] + np.linalg.solve(sides, squares / 2)[..., 0]
        # A cell is a sum, with signs, of right-angled tetrahedra: from the point to the middle of an edge, from there
        # to the circumcentre of a triangle at this edge, and on to that of a tetrahedron at this triangle.
        sums = np.zeros((5, len(tri.points)))
        for order in itertools.permutations(range(4)):
            point, second, third, _ = corners[:, order].swapaxes(0, 1)
            to_cell, normal = self.centres - point, np.cross(second - point, third - point)
            to_edge = (second - point) / 2
            to_triangle = to_cell - dots(to_cell, normal) / dots(normal, normal) * normal
            volume = dots(np.cross(to_edge, to_triangle), to_cell) / 6 * round(np.linalg.det(np.eye(4)[list(order)]))
            moment = volume * (to_edge + to_triangle + to_cell) / 4
            parts = np.hstack([volume, 3 * volume / np.sqrt(dots(to_edge, to_edge)), moment])
            sums += [np.bincount(tri.simplices[:, order[0]], part, len(tri.points)) for part in parts.T]
        self.volumes, self.surfaces, self.offsets = sums[0], sums[1], (sums[2:] / sums[0]).T
        self.quotients = 36 * np.pi * self.volumes**2 / self.surfaces**3

    def facets(self):
        """Rows of a cell, its neighbour and the period of that; for each the corners, from the cell's point on."""
        ends = np.array(list(itertools.permutations(range(4), 2))).T
        cells, shifts, places = (at[:, ends] for at in (self.simplices, self.shifts, self.corners))
        rows = np.concatenate([cells.swapaxes(1, 2), shifts[:, 1] - shifts[:, 0]], axis=2).reshape(-1, 5)
        corners = (self.centres[:, None] - places[:, 0]).reshape(-1, 3)
        order = np.lexsort(rows.T)
        starts = np.flatnonzero(np.diff(rows[order], axis=0, prepend=-1).any(axis=1))
        return rows[order[starts]], np.split(corners[order], starts[1:])

    def __str__(self):
        volumes, facets = self.volumes / self.volumes.mean(), len(self.facets()[0]) / len(self.points)
        return f"spread of volumes {volumes.std():.1e}, {facets:.2f} facets, quotient {self.quotients.mean():.5f}"


def dots(a, b):
    return (a * b).sum(axis=1, keepdims=True)


def random_points(count, seed=1):
    return np.random.default_rng(seed).random((count, 3)) * np.cbrt(count)


def body_centred(side, noise=0.1, seed=1):
    """Two points in each of some cubes, which together have a volume of 1 for each point."""
    cubes = np.stack(np.meshgrid(*[np.arange(side)] * 3), axis=-1).reshape(-1, 3)
    points = np.concatenate([cubes, cubes + 0.5])
    return (points + np.random.default_rng(seed).normal(scale=noise, size=points.shape)) * np.cbrt(2)


def relax(points, steps):
    """The foam before and after. One triangulation is moved."""
    tri = deldrift.PeriodicDelaunay(points, [np.cbrt(len(points))] * 3)
    yield Foam(tri)
    for _ in range(steps):
        tri.move(tri.points + Foam(tri).offsets)
    yield Foam(tri)


def outside(foam, view):
    """Facets between cells in the box and others, those in front last: corners, normal, and how many the cell has."""
    multiples = np.floor(foam.points @ np.linalg.inv(foam.vectors))
    home = foam.points - (multiples + 0.5) @ foam.vectors
    rows, polygons = foam.facets()
    counts = np.bincount(rows[:, 0])
    for k in np.argsort(home[rows[:, 0]] @ view):
        cell, other, *period = rows[k]
        normal = foam.points[other] + period @ foam.vectors - foam.points[cell]
        if normal @ view > 0 and (period + multiples[other] != multiples[cell]).any():
            x = np.cross(normal, [0.6, 0.5, 0.4])
            y = np.cross(normal, x) / np.linalg.norm(normal)
            around = np.argsort(np.arctan2(polygons[k] @ y, polygons[k] @ x))
            yield home[cell] + polygons[k][around], normal / np.linalg.norm(normal), counts[cell]


def draw(path, foams):
    """Cells with 14 facets in green, with fewer in blue, with more in red."""
    right, up, view = np.array([[-0.6, 0.8, 0], [-0.48, -0.36, 0.8], [0.64, 0.48, 0.6]])
    lines = [f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='-4.5 -5 {9 * len(foams)} 10' stroke-width='0.04'>"]
    for number, foam in enumerate(foams):
        for corners, normal, count in outside(foam, view):
            colour = [(80, 130, 230), (100, 190, 110), (230, 110, 80)][np.sign(count - 14) + 1]
            fill = "#%02x%02x%02x" % tuple((np.array(colour) * (0.75 + 0.25 * normal @ up)).astype(int))
            at = " ".join(f"{x:.2f},{-y:.2f}" for x, y in corners @ np.array([right, up]).T + [9 * number, 0])
            lines.append(f"<polygon points='{at}' fill='{fill}' stroke='white'/>")
    pathlib.Path(path).write_text("\n".join([*lines, "</svg>\n"]))


if __name__ == "__main__":
    foams = [*relax(random_points(128), 300), *relax(body_centred(4), 100)]
    for name, foam in zip(("random", "after 300 steps", "disturbed", "after 100 steps"), foams):
        print(f"{name}: {foam}")
    print(f"Kelvin's: {KELVIN:.5f}")
    if len(sys.argv) > 1:
        draw(sys.argv[1], [foams[k] for k in (0, 1, 3)])
