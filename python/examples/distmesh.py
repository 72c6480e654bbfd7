"""A mesh of a disc with a hole by DistMesh's iteration (Persson and Strang, doi:10.1137/S0036144503429121).

Bars push points apart until lengths are as wanted, and points that leave the shape are put back. The triangulation is
needed at every step; here points move in one triangulation. `python distmesh.py docs/python_distmesh.png` draws it.
"""

import sys

import numpy as np

import deldrift

RADIUS, HOLE = 1.0, 0.35


def distance(points):
    """From the boundary: negative inside."""
    from_centre = np.hypot(*points.T)
    return np.maximum(from_centre - RADIUS, HOLE - from_centre)


def wanted(points):
    """How long bars are to be, relative to each other."""
    return 0.04 + 0.06 * (np.hypot(*points.T) - HOLE)


def start(count=600, seed=1):
    """Points in the shape, where they are wanted more the shorter bars are to be."""
    rng = np.random.default_rng(seed)
    points = rng.uniform(-RADIUS, RADIUS, (40 * count, 2))
    points = points[distance(points) < 0]
    density = 1 / wanted(points) ** 2
    return points[rng.random(len(points)) < density / density.max()][:count]


def inside(points, triangles):
    """The triangles whose centroid is in the shape."""
    return triangles[distance(points[triangles].mean(axis=1)) < -1e-3]


def forces(points, bars):
    """What bars push their ends with."""
    vectors = points[bars[:, 0]] - points[bars[:, 1]]
    lengths = np.hypot(*vectors.T)
    goals = wanted(points[bars].mean(axis=1))
    goals *= 1.2 * np.sqrt((lengths**2).sum() / (goals**2).sum())
    pushes = (np.maximum(goals - lengths, 0) / lengths)[:, None] * vectors
    total = np.zeros_like(points)
    np.add.at(total, bars[:, 0], pushes)
    np.add.at(total, bars[:, 1], -pushes)
    return total


def put_back(points):
    """Points outside, along the gradient of the distance to the boundary."""
    out = distance(points)
    is_out = out > 0
    step = 1e-7
    slopes = [(distance(points + step * axis) - out) / step for axis in np.eye(2)]
    return points - np.where(is_out, out, 0)[:, None] * np.stack(slopes, axis=1)


def bars_of(triangles):
    ends = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    return np.unique(ends, axis=0)


def relax(points, triangulate, steps=80):
    """DistMesh's iteration with any triangulation: a function of positions that gives triangles."""
    for _ in range(steps):
        bars = bars_of(inside(points, triangulate(points)))
        points = put_back(points + 0.2 * forces(points, bars))
    return points


class Moving:
    """Triangles of points that move."""

    def __init__(self, points):
        self.tri = deldrift.Delaunay(points)

    def __call__(self, points):
        self.tri.move(points)
        return self.tri.simplices


def qualities(points, triangles):
    """Twice the inradius over the circumradius: 1 for equilateral triangles."""
    a, b, c = (np.hypot(*(points[triangles[:, i]] - points[triangles[:, j]]).T) for i, j in ((1, 2), (2, 0), (0, 1)))
    return (b + c - a) * (c + a - b) * (a + b - c) / (a * b * c)


def draw(path, before, after):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(10, 5))
    for ax, points in zip(axes, (before, after)):
        triangles = inside(points, deldrift.Delaunay(points).simplices)
        quality = qualities(points, triangles)
        ax.tripcolor(*points.T, triangles, quality, vmin=0, vmax=1, cmap="viridis", edgecolor="white", linewidth=0.4)
        ax.set_title(f"{len(triangles)} triangles, mean quality {quality.mean():.2f}")
        ax.set_aspect("equal")
        ax.axis("off")
    figure.tight_layout()
    figure.savefig(path, dpi=72)


if __name__ == "__main__":
    first = start()
    moving = Moving(first)
    last = relax(first, moving)
    report = moving.tri.statistics
    print(f"{len(first)} points, {report.timestamp} steps, {report.flips} flips, {report.rebuilds} rebuilt")
    if len(sys.argv) > 1:
        draw(sys.argv[1], first, last)
